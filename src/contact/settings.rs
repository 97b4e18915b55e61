//! What is asked of the contact surface.

use serde::{Deserialize, Serialize};

/// The model of the surfaces in contact, from cheap to true.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceKind {
    /// Independent springs of stiffness K/H against the worn gap.
    #[default]
    Winkler,
    /// Hertz's elliptic pressure, swept over the flank points.
    Hertz,
    /// Hertz's mean pressure with closed-form sliding distances.
    HertzMean,
}

/// What a Winkler bed shares with Hertz at the pitch point under the whole load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MatchCriterion {
    /// The half-width of the contact strip.
    #[default]
    HalfWidth,
    /// The greatest pressure.
    PeakPressure,
    /// The approach of the two bodies.
    Approach,
}

/// Where the stiffness K/H of the elastic foundation comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Foundation {
    /// Given by hand, MPa/mm.
    Given {
        /// K/H in MPa/mm.
        foundation_mpa_per_mm: f64,
    },
    /// Matched to Hertz at the pitch point.
    Matched(MatchCriterion),
}

/// The contact settings of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSettings {
    /// The surface model.
    pub surface: SurfaceKind,
    /// K/H; read by `winkler` alone.
    pub foundation: Foundation,
}

/// Linear elastic, isotropic material of one gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E, MPa.
    pub young_modulus_mpa: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
    /// Density, kg/m³; used for the worn mass.
    pub density_kg_per_m3: f64,
}
