//! Stiffness by ISO 6336-1 in `summary.json`.

#![allow(non_snake_case, reason = "names that end in their unit")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Stiffness by ISO 6336-1 Method B, of solid gears, per mm of face width.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IsoStiffnessSummary {
    /// c', of one tooth pair.
    pub single_N_per_mm_um: f64,
    /// c_γα, of all pairs in mesh, for dynamics and load sharing.
    pub mesh_alpha_N_per_mm_um: f64,
    /// c_γβ, of all pairs in mesh, for the load distribution over the face width.
    pub mesh_beta_N_per_mm_um: f64,
}
