//! Verification of the plane finite elements, their assembly, factorisation, loads and stresses.

mod factor;
mod meshes;
mod patch;
