//! What is given of a gear pair: the data of a drawing, before anything is derived.
//!
//! Profile shifts and rack factors are coefficients of the *normal* module (ISO 21771).

use super::{modification::Modification, per_gear::PerGear};

/// The basic rack that generates the teeth (ISO 53), as factors of the normal module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasicRack {
    /// Addendum factor h_aP*.
    pub addendum_factor: f64,
    /// Dedendum factor h_fP*.
    pub dedendum_factor: f64,
    /// Root fillet radius factor ρ_fP*.
    pub fillet_radius_factor: f64,
}

impl Default for BasicRack {
    /// Profile A of ISO 53: 1.0, 1.25, 0.38.
    fn default() -> Self {
        Self { addendum_factor: 1.0, dedendum_factor: 1.25, fillet_radius_factor: 0.38 }
    }
}

/// One gear as given.
#[derive(Debug, Clone, PartialEq)]
pub struct GearSpec {
    /// Number of teeth z.
    pub teeth: u32,
    /// Profile shift coefficient x, of the normal module.
    pub profile_shift: f64,
    /// Tip diameter d_a in mm; `None`: from the rack with addendum shortening (full tip clearance kept).
    pub tip_diameter_mm: Option<f64>,
    /// Tooth thickness allowance E_sn in mm in the normal section; negative thins the tooth.
    pub tooth_thickness_allowance_mm: f64,
    /// Bore diameter in mm, where the gear has a bore that matters.
    pub bore_diameter_mm: Option<f64>,
    /// Deliberate deviations from the involute.
    pub modification: Modification,
}

/// The pair as given.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSpec {
    /// Normal module m_n in mm.
    pub normal_module_mm: f64,
    /// Normal pressure angle α_n in rad.
    pub normal_pressure_angle_rad: f64,
    /// Helix angle β at the reference cylinder in rad.
    pub helix_angle_rad: f64,
    /// Working centre distance a_w in mm.
    pub centre_distance_mm: f64,
    /// Common face width b in mm.
    pub face_width_mm: f64,
    /// The generating rack, the same for both gears.
    pub rack: BasicRack,
    /// The gears.
    pub gears: PerGear<GearSpec>,
}
