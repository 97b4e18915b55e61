//! Plane finite elements: elements, assembly, factorisation, contact of meshes.

pub mod elastic;
pub mod problem;
pub mod record;
pub mod solid;
