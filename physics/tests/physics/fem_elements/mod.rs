//! Verification of the plane finite elements, their assembly, factorisation, loads and stresses.

mod closed_forms;
mod common;
mod convergence;
mod factor;
mod faults;
mod meshes;
mod patch;
