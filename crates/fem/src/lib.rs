//! Finite elements: plane elements and hexahedra, assembly, factorisation, contact of plane meshes.

pub mod active_set;
mod axisymmetric;
pub mod contact;
pub mod disjoint_sets;
pub mod dissection;
pub mod elastic;
pub mod element;
mod enhanced_quad;
pub mod equilibrium;
pub mod factor;
pub mod field_raster;
mod incidence;
pub mod loads;
pub mod locate;
pub mod nodal_fields;
mod nodal_triangle;
pub mod node_matrix;
pub mod problem;
mod projected_volume;
pub mod quadrature;
pub mod rigid_body;
pub mod shape;
pub mod solid;
pub mod space;
mod sparse_solve;
pub mod stiffness;
pub mod stress;
mod support;
pub mod weighted_sum;

pub use equilibrium::{SolveError, solve};
