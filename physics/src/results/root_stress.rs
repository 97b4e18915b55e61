//! Nominal stress at the roots of the teeth by the standards in `summary.json`.

#![allow(non_snake_case, reason = "names that end in their unit, and symbols of the standards")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Nominal root stress of one gear under the load of the reference phase, without load factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RootStressSummary {
    /// ISO 6336-3 Method B: the whole load at the outer point of single pair contact. `None` where no pair carries it alone, or the
    /// rounding of the rack is too sharp or too blunt for the formulas.
    pub iso_6336_3: Option<RootSectionSummary>,
    /// VDI 2736-2: the load at the tip, shared by the contact ratio. `None` for the latter reason.
    pub vdi_2736: Option<RootSectionSummary>,
}

/// The critical section of a tooth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RootSectionSummary {
    /// σ_F0.
    pub nominal_stress_MPa: f64,
    /// Y_F.
    pub form_factor: f64,
    /// Y_S.
    pub stress_correction_factor: f64,
    /// h_F.
    pub moment_arm_mm: f64,
    /// s_Fn, where tangents at 30° touch the fillets.
    pub thickness_mm: f64,
    /// ρ_F there.
    pub fillet_radius_mm: f64,
    /// α_Fe, between the load and the middle line of the tooth's normal.
    pub load_angle_deg: f64,
}
