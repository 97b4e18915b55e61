//! Limits of the service life of a pair, and the moment of a run when one of them is reached.
//!
//! ```text
//! wear             h_max            ≥ limit       greatest wear depth on the active profile of either gear
//! tip thickness    s_an             ≤ limit       normal tooth thickness at the tip cylinder of either gear
//!
//! s_an = cos β_a (s_a − h_tip / cos α_a)          tan β_a = tan β r_a / r
//! ```
//!
//! s_a is the transverse tooth thickness at the tip cylinder, reliefs and roundings not taken off, α_a the transverse pressure angle there, h_tip
//! the greatest depth of the tip-edge zone: removed along the normal, it takes h_tip / cos α_a off the arc. One flank wears.
//!
//! Limits are looked at where a wear step ends. Within the step that passes one, the wear of each place is
//!
//! ```text
//! Euler's method      h(θ) = h₀ + θ (h₁ − h₀)                                    which is a step shortened to θ Δn
//! adaptive steps      the cubic with depth and rate of both ends (Hermite)       off by O(Δn⁴), where the step itself is by O(Δn³)
//! ```
//!
//! held between the depths of the ends. The least θ at which a limit is reached is found by halving, to the last bits; the pair is evaluated
//! there, and the run ends with that state. So the limit is met exactly, and the life is wrong by what the steps are.
//!
//! Source: ISO 21771, sections 4 and 5 (tooth thickness at a circle, helix angle at a circle); E. Hairer, S. P. Nørsett and
//! G. Wanner, *Solving Ordinary Differential Equations I* (1993), section II.6 (dense output).

use super::figures::WearFigures;
use super::settings::LifeLimits;
use crate::mesh_cycle::wearing_pair::WearingPair;
use crate::results::life::LifeLimit;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank::FlankGrid, flank_zones::FlankZones};

/// Halvings of the last step: to the last bit of θ.
const HALVINGS: u32 = 52;

/// The limit that a run came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LimitReached {
    /// Kind of limit.
    pub limit: LifeLimit,
    /// Gear that reached it.
    pub gear: Gear,
}

/// The limits with the flanks that they are of.
#[derive(Clone, Copy)]
pub(super) struct LimitsOfPair<'a> {
    pub limits: LifeLimits,
    pub pair: &'a GearPair,
    /// Meshes of a tooth of each gear per turn of the pinion.
    pub meshes: PerGear<f64>,
    pub grid: &'a PerGear<FlankGrid>,
    pub zones: &'a PerGear<FlankZones>,
}

impl LimitsOfPair<'_> {
    /// The limit that flanks which have lost `wear_mm` at their points have reached, if they have.
    fn reached(&self, wear_mm: &PerGear<Vec<f64>>) -> Option<LimitReached> {
        Gear::BOTH.into_iter().find_map(|gear| {
            let own = WearFigures::new(self.pair, gear, &self.grid[gear], &self.zones[gear], &wear_mm[gear]);
            let thickness_mm = self.pair.normal_tip_thickness_mm(gear, own.tip_edge.depth_mm);
            let limit = if self.limits.wear_mm.is_some_and(|limit| own.peak_mm >= limit) {
                LifeLimit::Wear
            } else if self.limits.tip_thickness_mm.is_some_and(|limit| thickness_mm <= limit) {
                LifeLimit::TipThickness
            } else {
                return None;
            };
            Some(LimitReached { limit, gear })
        })
    }
}

/// A pair where a wear step begins.
pub(super) struct StepBeginning {
    revolutions: f64,
    wear_mm: PerGear<Vec<f64>>,
    /// In one mesh of each gear's teeth.
    depth_mm: PerGear<Vec<f64>>,
}

/// Where within a step a limit is reached.
pub(super) struct LimitWithin {
    pub reached: LimitReached,
    pub revolutions: f64,
}

impl StepBeginning {
    /// State of `pair`, which is evaluated.
    pub(super) fn of(pair: &dyn WearingPair, revolutions: f64) -> Self {
        let wear_mm = pair.wear_mm();
        let mut depth_mm = wear_mm.clone();
        pair.depth_mm(&mut depth_mm);
        Self { revolutions, wear_mm, depth_mm }
    }

    /// Where a limit is reached in the step from here that ends with `pair` as it is, after `revolutions`; the pair has then lost what
    /// it has there, and otherwise what it had. With `smooth` steps the rates of both ends tell the course between them.
    pub(super) fn limit_within(
        &self,
        limits: &LimitsOfPair<'_>,
        pair: &mut dyn WearingPair,
        revolutions: f64,
        smooth: bool,
    ) -> Option<LimitWithin> {
        let mut reached = limits.reached(&pair.wear_at_points_mm())?;
        let end_mm = pair.wear_mm();
        let mut end_depth_mm = end_mm.clone();
        pair.depth_mm(&mut end_depth_mm);
        let length = revolutions - self.revolutions;
        let between = |part: f64| {
            PerGear::from_fn(|gear| {
                let (from, to) = (&self.wear_mm[gear], &end_mm[gear]);
                let (first, last) = (&self.depth_mm[gear], &end_depth_mm[gear]);
                let meshes = length * limits.meshes[gear];
                let at = |i: usize| {
                    let slopes = if smooth { [meshes * first[i], meshes * last[i]] } else { [to[i] - from[i]; 2] };
                    hermite(from[i], to[i], slopes, part).clamp(from[i].min(to[i]), to[i].max(from[i]))
                };
                (0..from.len()).map(at).collect::<Vec<f64>>()
            })
        };
        let (mut before, mut after) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            pair.set_wear_mm(&between(middle));
            match limits.reached(&pair.wear_at_points_mm()) {
                Some(limit) => (after, reached) = (middle, limit),
                None => before = middle,
            }
        }
        pair.set_wear_mm(&between(after));
        Some(LimitWithin { reached, revolutions: self.revolutions + after * length })
    }
}

/// The cubic from `from` to `to` whose slopes over the whole way are these at its ends, after `part` of it.
fn hermite(from: f64, to: f64, [first, last]: [f64; 2], part: f64) -> f64 {
    let rest = 1.0 - part;
    from + part * part * (3.0 - 2.0 * part) * (to - from) + part * rest * (rest * first - part * last)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic polynomial is its own: x³ − 2x² + x + 1, with the slopes 1 and 0.
    #[test]
    fn ver_cubics_are_kept() {
        for part in [0.0, 0.25, 0.7, 1.0] {
            let cubic = part * (part * (part - 2.0) + 1.0) + 1.0;
            let found = hermite(1.0, 1.0, [1.0, 0.0], part);
            assert!((found - cubic).abs() < 1e-15, "{part}: {found} and {cubic}");
        }
        assert_eq!(hermite(1.0, 3.0, [2.0, 2.0], 0.25), 1.5);
    }
}
