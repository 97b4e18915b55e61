//! A measured profile beside simulated ones.
//!
//! ```text
//! r = P [z − z₀(s + d) + h(s + d)/cos β_b]
//! ```
//!
//! with the measured heights z at arc lengths s, the unworn flank z₀, the simulated wear depth h, the shift d along the flank, and the
//! projection P that removes the form.

use super::question::ProfileQuestion;
use crate::measurement::form::FormRemoval;
use gearwear_bodies::gear::{GearPair, flank::FlankGrid};
use gearwear_physics::simulation::settings::Numerics;

/// Number of shifts tried on either side for the start of a search.
const SHIFTS_TRIED: i32 = 15;

/// Measured heights and the flank they are compared on.
pub(super) struct Comparison<'a> {
    pub of: &'a ProfileQuestion,
    pub pair: &'a GearPair,
    pub removal: FormRemoval,
    /// Arc length of each point of the wear profiles.
    grid_arc_mm: Vec<f64>,
    /// P z.
    pub measured_um: Vec<f64>,
}

/// Greatest wear depth of a search, in modules: beyond it no model is valid, and runs soon wear teeth through.
const DEEPEST_MODULES: f64 = 0.3;
/// Bounds of the upper end of a search for a factor.
const GREATEST_FACTOR: [f64; 2] = [4.0, 1e3];

/// Start of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beginning {
    /// d.
    pub shift_mm: f64,
    /// Factor on the wear.
    pub factor: f64,
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

impl<'a> Comparison<'a> {
    /// Comparison of a profile with wear at the flank points of a run.
    pub(super) fn new(of: &'a ProfileQuestion, pair: &'a GearPair, numerics: &Numerics) -> Self {
        let Numerics { flank_points, point_spacing, .. } = *numerics;
        let grid_arc_mm = FlankGrid::new(pair, of.profile.gear, flank_points, point_spacing).arc_mm;
        let removal = FormRemoval::new(of.form, &of.form.places_mm(&of.profile, pair));
        let mut measured_um = of.profile.height_um.clone();
        removal.remove(&mut measured_um);
        Self { of, pair, removal, grid_arc_mm, measured_um }
    }

    /// Number of flank points of a wear profile.
    pub(super) fn flank_points(&self) -> usize {
        self.grid_arc_mm.len()
    }

    /// Upper end of the search for the factor on `wear_um`.
    pub(super) fn greatest_factor(&self, wear_um: &[f64]) -> f64 {
        let deepest_mm = 1e-3 * wear_um.iter().copied().fold(0.0, f64::max);
        let [least, most] = GREATEST_FACTOR;
        (DEEPEST_MODULES * self.pair.spec.normal_module_mm / deepest_mm).clamp(least, most)
    }

    /// Wear depth at the measured points, shifted.
    pub(super) fn wear_at_points_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let grid = &self.grid_arc_mm;
        let wear = self.of.profile.arc_mm.iter().map(|arc| {
            let after = grid.partition_point(|&s| s <= arc + shift_mm).clamp(1, grid.len() - 1);
            let t = ((arc + shift_mm - grid[after - 1]) / (grid[after] - grid[after - 1])).clamp(0.0, 1.0);
            wear_um[after - 1] + t * (wear_um[after] - wear_um[after - 1])
        });
        wear.collect()
    }

    /// P (z₀ − h): the simulated profile, form removed.
    pub(super) fn simulated_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let mut heights = self.of.profile.unworn_um(self.pair, shift_mm);
        let wear = self.wear_at_points_um(wear_um, shift_mm);
        let scale = self.of.profile.over_normal(self.pair);
        heights.iter_mut().zip(&wear).for_each(|(height, wear)| *height -= scale * wear);
        self.removal.remove(&mut heights);
        heights
    }

    /// r.
    pub(super) fn residuals_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let simulated = self.simulated_um(wear_um, shift_mm);
        self.measured_um.iter().zip(simulated).map(|(measured, simulated)| measured - simulated).collect()
    }

    /// The shift of at most `within_mm` with which `wear_um`, times a factor of `factors` where that is open, fits best.
    pub(super) fn begin(&self, wear_um: &[f64], within_mm: f64, factors: Option<[f64; 2]>) -> Beginning {
        let tried = if within_mm > 0.0 { SHIFTS_TRIED } else { 0 };
        let nothing = vec![0.0; wear_um.len()];
        let mut best = (f64::INFINITY, 0.0, 1.0);
        for step in -tried..=tried {
            let shift = within_mm * f64::from(step) / f64::from(tried.max(1));
            // r = a + κ b: a without wear, b the contribution of the wear.
            let (a, whole) = (self.residuals_um(&nothing, shift), self.residuals_um(wear_um, shift));
            let b: Vec<f64> = whole.iter().zip(&a).map(|(w, a)| w - a).collect();
            let factor = factors.map_or(1.0, |[least, most]| (-dot(&a, &b) / dot(&b, &b)).clamp(least, most));
            let factor = if factor.is_finite() { factor } else { 1.0 };
            let square = dot(&a, &a) + 2.0 * factor * dot(&a, &b) + factor * factor * dot(&b, &b);
            // Of equal sums of squares the least shift is taken.
            if square < best.0 * (1.0 - 1e-12) || square <= best.0 && shift.abs() < f64::abs(best.1) {
                best = (square, shift, factor);
            }
        }
        let (_, shift_mm, factor) = best;
        Beginning { shift_mm, factor }
    }
}

pub(super) fn root_mean_square(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|v| v * v).sum::<f64>() / count).sqrt()
}
