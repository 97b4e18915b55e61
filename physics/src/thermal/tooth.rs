//! Temperature of the teeth of plastic gears, VDI 2736-2.
//!
//! ```text
//! θ = θ_0 + P μ H_V [k_θ/(b z (v_t m_n)^0.75) + R_λG/A_G] ED^0.64
//! ```
//!
//! θ_0 °C of the surroundings, P W through the pinion, μ, H_V the loss factor, b mm, z teeth of the gear itself, v_t m/s at the working
//! pitch circle, m_n mm, R_λG K·m²/W of the housing and A_G m² of its surface, ED the part of the time under load. k_θ in
//! K·(m/s)^0.75·mm^1.75/W is another for flank and root: dry, 6300 and 895 of a plastic gear on steel, 9000 and 2148 of two plastic gears,
//! and 0 in oil, which carries the heat away.
//!
//! Sources: VDI 2736-2:2014, equation 9, after H. Hachmann and E. Strickle (1966); k_θ as in the public program GEARpie, that in oil as in the
//! report of `validation/plastic-pair`. Public values of grease were not found.
//!
//! The guideline speaks of the plastic gear alone: a metal gear beside it conducts the heat away, and has no temperature here.
//!
//! Limits: a steady mean of both gears' loss; in dry running an error of tens of kelvins is usual.

use gearwear_bodies::gear::PerGear;
use gearwear_bodies::reference::linear_means::value_at;

/// k_θ of flank and root of a plastic gear on a metal one, dry.
pub const DRY_ON_METAL: ToothCoefficients = ToothCoefficients { flank: 6300.0, root: 895.0 };
/// k_θ of flank and root of two plastic gears, dry.
pub const DRY_ON_PLASTIC: ToothCoefficients = ToothCoefficients { flank: 9000.0, root: 2148.0 };
/// k_θ of flank and root in oil.
pub const IN_OIL: ToothCoefficients = ToothCoefficients { flank: 0.0, root: 0.0 };

/// k_θ, K·(m/s)^0.75·mm^1.75/W.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothCoefficients {
    /// Of the flank.
    pub flank: f64,
    /// Of the root.
    pub root: f64,
}

/// Settings of the temperature of the teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothHeatSettings {
    /// θ_0, °C.
    pub ambient_c: f64,
    /// k_θ.
    pub coefficients: ToothCoefficients,
    /// R_λG/A_G, K/W.
    pub housing_k_per_w: f64,
    /// ED.
    pub duty_cycle: f64,
    /// Gears that have this temperature: the plastic ones where there are any.
    pub of: PerGear<bool>,
    /// Whether contact temperatures are counted from the temperature of the flanks.
    pub is_bulk: bool,
}

/// A gear whose teeth get warm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WarmGear {
    /// z.
    pub teeth: u32,
    /// b, mm.
    pub face_width_mm: f64,
    /// v_t, m/s.
    pub pitch_velocity_m_per_s: f64,
    /// m_n, mm.
    pub normal_module_mm: f64,
}

/// A quantity that depends on the temperature of the teeth: linear between its points, constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct TemperatureCurve {
    /// Temperatures, °C, rising; two at least.
    pub temperature_c: Vec<f64>,
    /// Value at each.
    pub value: Vec<f64>,
}

impl TemperatureCurve {
    /// Value at a temperature.
    pub fn at(&self, temperature_c: f64) -> f64 {
        value_at(&self.temperature_c, &self.value, temperature_c)
    }

    /// Whether a temperature lies between the points.
    pub fn covers(&self, temperature_c: f64) -> bool {
        let [first, .., last] = self.temperature_c.as_slice() else { return false };
        (first..=last).contains(&&temperature_c)
    }
}

/// Temperatures of the teeth of a gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothTemperatures {
    /// θ of the flank, °C.
    pub flank_c: f64,
    /// θ of the root, °C.
    pub root_c: f64,
}

impl ToothTemperatures {
    /// Mean of flank and root, °C.
    pub fn mean_c(&self) -> f64 {
        0.5 * (self.flank_c + self.root_c)
    }
}

impl ToothHeatSettings {
    /// Temperatures of `gear` where the mesh loses P μ H_V = `loss_w`.
    pub fn temperatures(&self, gear: &WarmGear, loss_w: f64) -> ToothTemperatures {
        let speed = (gear.pitch_velocity_m_per_s * gear.normal_module_mm).powf(0.75);
        let into_air = gear.face_width_mm * f64::from(gear.teeth) * speed;
        let [flank_c, root_c] = [self.coefficients.flank, self.coefficients.root].map(|coefficient| {
            self.ambient_c + loss_w * (coefficient / into_air + self.housing_k_per_w) * self.duty_cycle.powf(0.64)
        });
        ToothTemperatures { flank_c, root_c }
    }
}
