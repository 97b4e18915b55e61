//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod elastic;
pub mod element;
mod enhanced_quad;
pub mod factor;
pub mod loads;
mod nodal_triangle;
pub mod problem;
mod projected_volume;
pub mod quadrature;
pub mod shape;
pub mod solid;
mod sparse_solve;
pub mod stiffness;
pub mod stress;
mod support;
