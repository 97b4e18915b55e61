//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod elastic;
pub mod element;
mod enhanced_quad;
pub mod factor;
mod nodal_triangle;
pub mod problem;
pub mod quadrature;
pub mod shape;
pub mod solid;
pub mod stiffness;
mod support;
