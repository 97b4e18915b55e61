//! Settings of the contact surface.

use serde::{Deserialize, Serialize};

/// Model of the surfaces in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceKind {
    /// Winkler foundation of stiffness K/H against the worn gap.
    #[default]
    Winkler,
    /// Hertz's elliptic pressure on the nominal curvature, swept over the flank points.
    Hertz,
    /// Hertz's mean pressure with closed-form sliding distances; its wear has cusps where the number of tooth pairs in
    /// mesh changes.
    HertzMean,
    /// Two elastic half-planes against the worn gap.
    HalfSpace,
    /// Both gears as finite elements, condensed onto their flanks, against the worn gap; contact is found from the true
    /// profiles, also outside the line of action.
    Fem,
}

impl SurfaceKind {
    /// All surfaces, from the simplest to the most exact.
    pub const ALL: [Self; 5] = [Self::HertzMean, Self::Hertz, Self::Winkler, Self::HalfSpace, Self::Fem];

    /// Name in scenes and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Winkler => "winkler",
            Self::Hertz => "hertz",
            Self::HertzMean => "hertz-mean",
            Self::HalfSpace => "half-space",
            Self::Fem => "fem",
        }
    }
}

/// Quantity that a Winkler foundation has in common with Hertz's contact at the pitch point under the whole load, or, calibrated, with the
/// finite-element contact everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MatchCriterion {
    /// The half-width of the contact strip.
    #[default]
    HalfWidth,
    /// The maximum pressure.
    PeakPressure,
    /// The approach of the two bodies.
    Approach,
}

impl MatchCriterion {
    /// All criteria.
    pub const ALL: [Self; 3] = [Self::HalfWidth, Self::PeakPressure, Self::Approach];

    /// Name in scenes and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::HalfWidth => "half-width",
            Self::PeakPressure => "peak-pressure",
            Self::Approach => "approach",
        }
    }
}

/// Source of the stiffness K/H of the Winkler foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Foundation {
    /// Given by hand, MPa/mm.
    Given {
        /// K/H in MPa/mm.
        foundation_mpa_per_mm: f64,
    },
    /// Matched to Hertz at the pitch point.
    Matched(MatchCriterion),
    /// Matched to the finite-element contact at every position and load, from a calibration.
    Calibrated(MatchCriterion),
}

/// The contact settings of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSettings {
    /// Surface.
    pub surface: SurfaceKind,
    /// K/H; read by `winkler` alone.
    pub foundation: Foundation,
    /// Whether tip edges are followed into contact before A and after E on `winkler` and `half-space`; on `fem` they always are.
    pub tip_contact: bool,
}
