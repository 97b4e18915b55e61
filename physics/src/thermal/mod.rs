//! Friction heat and the temperature of the contact.
//!
//! A tooth pair that carries the line load w over a strip of half-width a, and slides at v_s, turns the heat
//!
//! ```text
//! q = μ p v_s          on average   q̄ = μ w v_s/(2a)
//! ```
//!
//! per area and time into a rise of the temperature of both surfaces above their bulk. Each body takes the part δ of it
//! ([`partition`]); the strip is a band of heat that moves over it at U: the sliding speed in the thesis, or the speed of the body's own
//! surface through the contact.
//!
//! | method | module | rise along the strip |
//! |---|---|---|
//! | transient heat equation | [`heat_equation`] | of the actual pressure, by finite differences |
//! | Williams | [`williams`] | with the root of the distance from the inlet, under q̄ |
//! | Tian and Kennedy | [`tian_kennedy`] | greatest value everywhere, under q̄ |
//!
//! The shares follow from the rises by the same method for an even band. Material enters a strip of the pinion's flank from the side
//! of its tip and of the wheel's from that of its root, which is the same side in space.
//!
//! Units: mm, N, s, K; a flux in N/(mm·s) is 1000 W/m².

pub mod band;
pub mod heat_equation;
pub(crate) mod partition;
pub(crate) mod peclet;
pub mod settings;
pub mod tian_kennedy;
pub mod tooth;
pub mod williams;

use band::HeatedBand;
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use heat_equation::Passage;
use settings::{HeatSettings, TemperatureMethod};

/// Friction heat of a pair in mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactHeat {
    /// Settings of the scene.
    pub settings: HeatSettings,
    /// Speed of the theoretical contact point along the line of action, r_b ω, mm/s.
    pub speed_mm_per_s: f64,
    passage: Passage,
}

/// Speeds of the surfaces at a contact over that of the theoretical contact point along the line of action.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpeedRatios {
    /// Sliding speed.
    pub sliding: f64,
    /// Speed of each gear's surface through the contact.
    pub rolling: PerGear<f64>,
}

/// The strip of a contact as a source of heat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatedStrip {
    /// Speeds of the surfaces.
    pub ratios: SpeedRatios,
    /// Load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// Half-width of the contact, mm.
    pub half_width_mm: f64,
    /// μ.
    pub friction_coefficient: f64,
}

impl SpeedRatios {
    /// Mean ratios over a stretch of the path, so that the sliding distance over the speed is the time that the contact takes, also where sliding
    /// stops in between; ratios at the place itself where the stretch has no length.
    pub fn over(geometry: &dyn ConjugateFlanks, from_mm: f64, to_mm: f64) -> Self {
        let length = to_mm - from_mm;
        let middle = 0.5 * (from_mm + to_mm);
        let rolling = PerGear::from_fn(|gear| geometry.rolling_ratio(gear, middle));
        let sliding = if length > 0.0 {
            geometry.sliding_mm(from_mm, to_mm) / length
        } else {
            (rolling.pinion - rolling.wheel).abs()
        };
        Self { sliding, rolling }
    }
}

impl ContactHeat {
    /// Heat of a pair whose contact point moves along the line of action at `speed_mm_per_s` (r_b ω).
    pub fn new(settings: HeatSettings, speed_mm_per_s: f64) -> Self {
        Self { settings, speed_mm_per_s, passage: Passage::default() }
    }

    /// The heated strip of a contact, by the method of the scene.
    pub fn band(&self, strip: &HeatedStrip) -> HeatedBand<'_> {
        self.band_by(self.settings.method, strip)
    }

    /// The heated strip of a contact, by any method.
    pub(crate) fn band_by(&self, method: TemperatureMethod, strip: &HeatedStrip) -> HeatedBand<'_> {
        HeatedBand::new(self, method, strip)
    }

    /// Sliding speed in a contact, mm/s.
    pub(crate) fn sliding_speed_mm_per_s(&self, ratios: &SpeedRatios) -> f64 {
        self.speed_mm_per_s * ratios.sliding
    }
}

/// Whether material of `gear` enters a contact at the tip side of a row of points.
fn enters_at_tip_side(gear: Gear) -> bool {
    gear == Gear::Pinion
}
