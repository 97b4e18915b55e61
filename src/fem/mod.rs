//! Finite elements: plane elements and hexahedra, assembly, factorisation, contact of plane meshes.

pub(crate) mod active_set;
pub(crate) mod contact;
pub(crate) mod disjoint_sets;
pub(crate) mod elastic;
pub(crate) mod element;
mod enhanced_quad;
pub(crate) mod equilibrium;
pub(crate) mod factor;
pub(crate) mod gear;
pub(crate) mod loads;
pub(crate) mod locate;
pub(crate) mod nodal_fields;
mod nodal_triangle;
pub(crate) mod node_matrix;
pub(crate) mod problem;
mod projected_volume;
pub(crate) mod quadrature;
pub(crate) mod rigid_body;
pub(crate) mod shape;
pub(crate) mod solid;
pub(crate) mod space;
mod sparse_solve;
pub(crate) mod stiffness;
pub(crate) mod stress;
mod support;

pub(crate) use equilibrium::{SolveError, solve};
