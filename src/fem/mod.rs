//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod active_set;
mod compliance_tmp;
pub mod contact;
pub mod elastic;
pub mod element;
mod enhanced_quad;
pub mod equilibrium;
pub mod factor;
pub mod gear;
mod nodal_triangle;
pub mod problem;
pub mod quadrature;
pub mod record;
pub mod rigid_body;
pub mod shape;
pub mod solid;
pub mod stiffness;
mod support;

pub use equilibrium::{SolveError, solve};
