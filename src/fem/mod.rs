//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod active_set;
pub mod contact;
pub mod elastic;
pub mod element;
mod enhanced_quad;
pub mod equilibrium;
pub mod factor;
pub mod gear;
pub mod loads;
pub mod locate;
mod nodal_triangle;
pub mod problem;
mod projected_volume;
pub mod quadrature;
pub mod rigid_body;
pub mod shape;
pub mod solid;
mod sparse_solve;
pub mod stiffness;
pub mod stress;
mod support;

pub use equilibrium::{SolveError, solve};
