//! Friction heat and the temperature of the contact.

pub mod settings;

use settings::HeatSettings;

/// Friction heat of a pair in mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactHeat {
    /// What is asked for.
    pub settings: HeatSettings,
    /// Speed of the theoretical contact point along the line of action, r_b ω, mm/s.
    pub speed_mm_per_s: f64,
}
