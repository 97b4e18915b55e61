//! Load and approach of a tooth pair in contact, prepared for many loads.
//!
//! The approach s of a contact under the line load w is that of the teeth, q w, and the flattening of both surfaces in closed form
//! ([`gearwear_bodies::reference::flattening`]). With the half-width a² = α w, α = 4 R / (π E*), and the depths t of both bodies b, that
//! is for a < t
//!
//! ```text
//! s(w) = w [ Q − ½ Φ ln w + P(w) ]        Φ = Σ F_b,   F_b = (2/π) (1 − ν²)/E
//! Q    = q + Σ F_b (ln 2t_b − ½ ln α − ½ κ_b)           κ_b = ν/(1 − ν)
//! P(w) = Σ F_b r_b(x_b w)                               x_b = α/t_b²
//! r(x) = ln ½(1 + √(1 + x)) − κ/(1 + √(1 + x)) + κ/2    x = (a/t)²
//! ```
//!
//! exactly. r is small and smooth, and a polynomial of the fourth degree takes its place: that through the Chebyshev points of
//! [0, X], whose constant joins Q and whose other coefficients make P(w) = A₁ w + A₂ w² + A₃ w³ + A₄ w⁴. The nearest branch
//! point is x = −1, so that it is wrong by about r ρ⁻⁵ with ρ ≈ 4/X: of the flattening, 1e-9 and far below for X = 0.1, 1e-7 for
//! 0.3 and 2e-5 for 1, where the strip is as wide as the tooth and the closed form itself says little. X is the least of [`RANGES`] that
//! holds [`AMPLE_LOADS`] times the whole line load.
//!
//! Of an oblique line of contact R is that of the normal section, and s along the transverse line of action: 1/cos β_b of the flattening.
//!
//! Depths are smooth along the path of contact and cost an arc tangent each; they are tabulated and interpolated by cubics.

use std::f64::consts::{LN_2, PI};

use gearwear_bodies::gear::{
    Gear, GearPair, PerGear, conjugate::ConjugateFlanks, normal_section::Obliquity, path_of_contact::PathOfContact,
};
use gearwear_bodies::material::{Material, contact_modulus_mpa};

/// X: ranges of (a/t)² with a polynomial each.
pub const RANGES: [f64; 4] = [0.03, 0.1, 0.3, 1.0];
/// Loads up to this many times the whole line load are in the range of every contact, if any range holds them.
pub const AMPLE_LOADS: f64 = 3.0;

/// Places along the path where depths are computed.
const TABLE: usize = 512;

/// Closed form of a contact for loads up to `greatest_load_n_per_mm`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForm {
    /// Q without the teeth's q, mm²/N.
    pub surface_mm2_per_n: f64,
    /// A_k, mm²/N over a load to the power of k.
    pub series: [f64; 4],
    /// α, mm³/N: half-width squared over load.
    pub square_half_width: f64,
    /// Greatest load of the series, N/mm.
    pub greatest_load_n_per_mm: f64,
}

/// Closed forms of the contacts of a pair of gears.
pub struct ContactForms<'a> {
    path: &'a PathOfContact,
    obliquity: Obliquity,
    /// F of each gear, mm²/N.
    factor: [f64; 2],
    poisson: [f64; 2],
    contact_modulus_mpa: f64,
    /// r of each gear in every range.
    fits: [[[f64; 5]; RANGES.len()]; 2],
    /// Load for which ranges are chosen, N/mm.
    ample_load_n_per_mm: f64,
    /// Σ F ln t, 1/t₁², 1/t₂² at evenly spaced places from A to E.
    table: Vec<[f64; 3]>,
}

impl<'a> ContactForms<'a> {
    /// Closed forms of a pair under a whole line load.
    pub fn new(pair: &'a GearPair, material: &PerGear<Material>, line_load_n_per_mm: f64) -> Self {
        let constants = Gear::BOTH.map(|gear| material[gear]);
        let obliquity = pair.obliquity();
        let factor = constants.map(|own| obliquity.transverse_mm(own.elastic().half_plane_mm2_per_n()));
        let table = pair.path.evenly_mm(TABLE).into_iter().map(|at| {
            let depth = Gear::BOTH.map(|gear| pair.depth_mm(gear, at));
            [factor[0] * depth[0].ln() + factor[1] * depth[1].ln(), depth[0].powi(-2), depth[1].powi(-2)]
        });
        let poisson = constants.map(|own| own.poisson_ratio / (1.0 - own.poisson_ratio));
        Self {
            path: &pair.path,
            obliquity,
            factor,
            poisson,
            fits: poisson.map(|kappa| RANGES.map(|range| fit(|x| rest(x, kappa), range))),
            ample_load_n_per_mm: AMPLE_LOADS * line_load_n_per_mm,
            contact_modulus_mpa: contact_modulus_mpa(material.map(Material::elastic)),
            table: table.collect(),
        }
    }

    /// Φ, mm²/N.
    pub fn log_compliance_mm2_per_n(&self) -> f64 {
        self.factor[0] + self.factor[1]
    }

    /// Closed form with the theoretical contact point at `position_mm`, from A to E.
    pub fn at(&self, position_mm: f64) -> ContactForm {
        let [log_depths, inverse_squares @ ..] = self.between(position_mm);
        let whole = self.path.line_of_action_mm;
        let relative_radius_mm = self.obliquity.normal_radius_mm(position_mm * (whole - position_mm) / whole);
        let square_half_width = 4.0 * relative_radius_mm / (PI * self.contact_modulus_mpa);
        let to_load = 0.5 * square_half_width.ln();
        let (mut surface_mm2_per_n, mut series) = (log_depths, [0.0; 4]);
        let mut greatest_load_n_per_mm = f64::INFINITY;
        for (body, inverse_square) in inverse_squares.into_iter().enumerate() {
            let factor = self.factor[body];
            let x = square_half_width * inverse_square;
            let ample = x * self.ample_load_n_per_mm;
            let range = RANGES.iter().position(|&range| range >= ample).unwrap_or(RANGES.len() - 1);
            let [constant, coefficients @ ..] = self.fits[body][range];
            surface_mm2_per_n += factor * (LN_2 - to_load - 0.5 * self.poisson[body] + constant);
            let (per_load, mut power) = (x / RANGES[range], factor);
            for (sum, coefficient) in series.iter_mut().zip(coefficients) {
                power *= per_load;
                *sum += power * coefficient;
            }
            greatest_load_n_per_mm = greatest_load_n_per_mm.min(1.0 / per_load);
        }
        ContactForm { surface_mm2_per_n, series, square_half_width, greatest_load_n_per_mm }
    }

    /// Cubic interpolation between the four nearest places of the table.
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

/// r(x), without cancellation for small x.
fn rest(x: f64, kappa: f64) -> f64 {
    let root = (1.0 + x).sqrt();
    let less_one = x / (1.0 + root);
    (0.5 * less_one).ln_1p() + 0.5 * kappa * less_one / (1.0 + root)
}

/// Polynomial in x/`range` through `of` at the Chebyshev points of [0, `range`]: Newton's divided differences, multiplied
/// out.
fn fit(of: impl Fn(f64) -> f64, range: f64) -> [f64; 5] {
    let points: [f64; 5] = std::array::from_fn(|k| 0.5 - 0.5 * ((2 * k + 1) as f64 * PI / 10.0).cos());
    let mut differences = points.map(|point| of(range * point));
    for order in 1..5 {
        for k in (order..5).rev() {
            differences[k] = (differences[k] - differences[k - 1]) / (points[k] - points[k - order]);
        }
    }
    let mut coefficients = [0.0; 5];
    for k in (0..5).rev() {
        // p ← p · (x − x_k) + difference
        for power in (1..5).rev() {
            coefficients[power] = coefficients[power - 1] - points[k] * coefficients[power];
        }
        coefficients[0] = differences[k] - points[k] * coefficients[0];
    }
    coefficients
}
