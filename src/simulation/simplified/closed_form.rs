//! Load and approach of a tooth pair in contact, prepared for many loads.
//!
//! The approach s of a contact under the line load w is that of the teeth, q w, and the flattening of both surfaces in closed form
//! ([`crate::reference::flattening`]). With the half-width a² = α w, α = 4 R / (π E*), and the depths t of both bodies b, that
//! is for a < t
//!
//! ```text
//! s(w) = w [ Q − ½ Φ ln w + P(w) ]        Φ = Σ F_b,   F_b = (2/π) (1 − ν²)/E
//! Q    = q + Σ F_b (ln 2t_b − ½ ln α − ½ κ_b)           κ_b = ν/(1 − ν)
//! P(w) = A₁ w + A₂ w² + A₃ w³ + A₄ w⁴                   A_k = Σ F_b c_k x_b^k,   x_b = α/t_b²
//! ```
//!
//! with the series of ln ½(1 + √(1 + x)) and of 1/(1 + √(1 + x)),
//!
//! ```text
//! c₁ = 1/4 + κ/8    c₂ = −3/32 − κ/16    c₃ = 5/96 + 5κ/128    c₄ = −35/1024 − 7κ/256
//! ```
//!
//! The first term left out is below 0.045 x⁵: x w = (a/t)² may be up to [`GREATEST_SQUARE`].
//!
//! Depths are smooth along the path of contact and cost an arc tangent each; they are tabulated and interpolated by cubics.

use std::f64::consts::{LN_2, PI};

use crate::contact::{hertz::contact_modulus_mpa, settings::Material};
use crate::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, path_of_contact::PathOfContact};

/// Greatest (a/t)² of the series: what is left out is then below 1e-9 of the flattening.
pub const GREATEST_SQUARE: f64 = 0.03;

/// Places along the path where depths are computed.
const TABLE: usize = 256;

/// A contact, ready for any load up to `greatest_load_n_per_mm`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForm {
    /// Q without the teeth's q, mm²/N.
    pub surface_mm2_per_n: f64,
    /// A_k, mm²/N over a load to the power of k.
    pub series: [f64; 4],
    /// α, mm³/N: half-width squared over load.
    pub square_half_width: f64,
    /// Load up to which the series holds, N/mm.
    pub greatest_load_n_per_mm: f64,
}

/// The contacts of a pair of gears.
pub struct ContactForms<'a> {
    path: &'a PathOfContact,
    /// F of each gear, mm²/N.
    factor: [f64; 2],
    poisson: [f64; 2],
    contact_modulus_mpa: f64,
    /// Σ F ln t, 1/t₁², 1/t₂² at evenly spaced places from A to E.
    table: Vec<[f64; 3]>,
}

impl<'a> ContactForms<'a> {
    /// Of a pair.
    pub fn new(pair: &'a GearPair, material: &PerGear<Material>) -> Self {
        let constants = Gear::BOTH.map(|gear| material[gear]);
        let factor = constants.map(|own| 2.0 / PI * (1.0 - own.poisson_ratio.powi(2)) / own.young_modulus_mpa);
        let table = pair.path.evenly_mm(TABLE).into_iter().map(|at| {
            let depth = Gear::BOTH.map(|gear| pair.depth_mm(gear, at));
            [factor[0] * depth[0].ln() + factor[1] * depth[1].ln(), depth[0].powi(-2), depth[1].powi(-2)]
        });
        Self {
            path: &pair.path,
            factor,
            poisson: constants.map(|own| own.poisson_ratio / (1.0 - own.poisson_ratio)),
            contact_modulus_mpa: contact_modulus_mpa(material),
            table: table.collect(),
        }
    }

    /// Φ, mm²/N.
    pub fn log_compliance_mm2_per_n(&self) -> f64 {
        self.factor[0] + self.factor[1]
    }

    /// The contact with its theoretical contact point at `position_mm`, from A to E.
    pub fn at(&self, position_mm: f64) -> ContactForm {
        let [log_depths, inverse_squares @ ..] = self.between(position_mm);
        let whole = self.path.line_of_action_mm;
        let relative_radius_mm = position_mm * (whole - position_mm) / whole;
        let square_half_width = 4.0 * relative_radius_mm / (PI * self.contact_modulus_mpa);
        let to_load = 0.5 * square_half_width.ln();
        let (mut surface_mm2_per_n, mut series, mut greatest) = (log_depths, [0.0; 4], 0.0_f64);
        for body in 0..2 {
            let (factor, kappa) = (self.factor[body], self.poisson[body]);
            let x = square_half_width * inverse_squares[body];
            surface_mm2_per_n += factor * (LN_2 - to_load - 0.5 * kappa);
            series[0] += factor * x * (0.25 + kappa / 8.0);
            series[1] -= factor * x * x * (3.0 / 32.0 + kappa / 16.0);
            series[2] += factor * x * x * x * (5.0 / 96.0 + 5.0 * kappa / 128.0);
            series[3] -= factor * (x * x) * (x * x) * (35.0 / 1024.0 + 7.0 * kappa / 256.0);
            greatest = greatest.max(x);
        }
        let greatest_load_n_per_mm = GREATEST_SQUARE / greatest;
        ContactForm { surface_mm2_per_n, series, square_half_width, greatest_load_n_per_mm }
    }

    /// The cubic through the four nearest places of the table.
    fn between(&self, position_mm: f64) -> [f64; 3] {
        let (start, end) = (self.path.start_mm, self.path.end_mm);
        let place = (position_mm - start) / (end - start) * (TABLE - 1) as f64;
        let first = (place as usize).clamp(1, TABLE - 3) - 1;
        let s = place - (first + 1) as f64;
        let weights = [
            -s * (s - 1.0) * (s - 2.0) / 6.0,
            (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
            -(s + 1.0) * s * (s - 2.0) / 2.0,
            (s + 1.0) * s * (s - 1.0) / 6.0,
        ];
        let mut sum = [0.0; 3];
        for (weight, node) in weights.iter().zip(&self.table[first..first + 4]) {
            for (sum, value) in sum.iter_mut().zip(node) {
                *sum += weight * value;
            }
        }
        sum
    }
}
