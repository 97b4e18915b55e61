//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod active_set;
pub mod contact;
pub mod elastic;
pub mod equilibrium;
pub mod gear;
pub mod problem;
pub mod rigid_body;
pub mod solid;
