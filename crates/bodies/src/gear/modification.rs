//! Modifications of the flank, deliberate deviations from the involute.
//!
//! Amounts are of material removed along the flank normal; [`super::removed_material`] calculates the field of removed material. Lengths are
//! roll lengths: differences of the radius of curvature ρ of the transverse
//! involute, which are lengths along the path of contact (ISO 21771-1, profile modifications). Helix modifications (ISO 21771-1) are functions of
//! the axial coordinate z from 0 to b, constant from root to tip.

/// Shape of a relief from its start to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ReliefShape {
    /// In proportion to the roll length from the start.
    #[default]
    Linear,
    /// With the square of the roll length from the start: no kink where it begins.
    Parabolic,
}

/// Tip or root relief.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relief {
    /// Amount at the tip circle (tip relief) or at the start of active profile (root relief), mm.
    pub amount_mm: f64,
    /// Roll length over which it runs out, mm.
    pub length_mm: f64,
    /// Shape of the relief.
    pub shape: ReliefShape,
}

/// Place where a flank turns at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// Radius of curvature of the involute there, mm.
    pub rho_mm: f64,
    /// Angle between both sides, rad.
    pub angle_rad: f64,
}

/// Relief towards both ends of the face width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndRelief {
    /// Amount at the end faces, mm.
    pub amount_mm: f64,
    /// Part of the face width over which it runs out at either end, mm.
    pub length_mm: f64,
    /// Shape of the relief.
    pub shape: ReliefShape,
}

/// All modifications of one flank; the default is the plain involute.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Modification {
    /// Relief towards the tip.
    pub tip_relief: Option<Relief>,
    /// Relief towards the root.
    pub root_relief: Option<Relief>,
    /// Height of the profile crowning (parabola over the active profile, nothing removed at its middle), mm.
    pub profile_crowning_mm: f64,
    /// Profile-slope deviation f_Hα over the active profile, mm: positive, material is missing at its start; negative, at the tip.
    pub profile_slope_mm: f64,
    /// Radius of the rounding of the tip edge, mm.
    pub tip_rounding_mm: f64,
    /// Height of the lead crowning (parabola over the face width, nothing removed at its middle), mm.
    pub lead_crowning_mm: f64,
    /// Relief towards both ends of the face width.
    pub end_relief: Option<EndRelief>,
    /// Helix-slope deviation over the face width, mm: positive, material is missing at width b; negative, at width 0.
    pub helix_slope_mm: f64,
}

impl Modification {
    /// Whether it changes the profile, apart from the rounding of the tip edge.
    pub fn has_profile_modification(&self) -> bool {
        let over_the_profile = self.profile_crowning_mm != 0.0 || self.profile_slope_mm != 0.0;
        self.tip_relief.is_some() || self.root_relief.is_some() || over_the_profile
    }

    /// Whether it varies over the face width.
    pub fn varies_over_width(&self) -> bool {
        self.lead_crowning_mm != 0.0 || self.end_relief.is_some() || self.helix_slope_mm != 0.0
    }
}
