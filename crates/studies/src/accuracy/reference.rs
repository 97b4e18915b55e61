//! The reference: the finest run, corrected by what coarser runs say of its own errors.
//!
//! A method of order p that is run with spacings h and r·h gives y(h) = y + C hᵖ and y(rh) = y + C rᵖ hᵖ, hence
//!
//! ```text
//! y − y(h) = (y(h) − y(rh))/(rᵖ − 1)
//! ```
//!
//! The correction is made value by value over the flanks and the path of contact, once for each kind of spacing: size of
//! elements and spacing of points and positions (second order), length of the wear step and width of the slices (first order).
//! The differences are taken at a coarser level of the other spacings, which changes a correction by a correction of it only.
//!
//! What remains uncertain is stated as the size of the whole correction: the error of the finest run itself, measured
//! against the reference. It is an upper bound as long as the corrections have the right sign and magnitude.
//!
//! Source: L. F. Richardson (1911); P. J. Roache, *Verification and Validation in Computational Science* (1998).

use std::collections::BTreeMap;

use super::measure::{Windows, errors};
use super::observed::ObservedRun;
use crate::accuracy::record::ComparedQuantity;

/// Two runs that differ in one spacing only.
#[derive(Debug, Clone, Copy)]
pub struct Correction<'a> {
    /// With the spacing h.
    pub fine: &'a ObservedRun,
    /// With the spacing r h.
    pub coarse: &'a ObservedRun,
    /// r, above 1.
    pub ratio: f64,
    /// p.
    pub order: i32,
}

/// The reference with what remains uncertain of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Curves of the reference.
    pub observed: ObservedRun,
    /// Relative uncertainty of each quantity.
    pub uncertainty: BTreeMap<ComparedQuantity, f64>,
    /// Relative change of every quantity by each correction alone.
    pub parts: Vec<BTreeMap<ComparedQuantity, f64>>,
}

impl Reference {
    /// `finest` with all `corrections`, at the coordinates of `finest`.
    pub fn extrapolated(finest: &ObservedRun, corrections: &[Correction<'_>], windows: &Windows) -> Self {
        let mut observed = finest.clone();
        let mut parts = Vec::with_capacity(corrections.len());
        for correction in corrections {
            let factor = 1.0 / (correction.ratio.powi(correction.order) - 1.0);
            let (fine, coarse) =
                (correction.fine.at_coordinates_of(finest), correction.coarse.at_coordinates_of(finest));
            let corrected = observed.corrected(factor, &fine, &coarse);
            parts.push(errors(&observed, &corrected, windows));
            observed = corrected;
        }
        let uncertainty = errors(finest, &observed, windows);
        Self { observed, uncertainty, parts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::observed::{ObservedCycle, ObservedFlank};
    use gearwear_bodies::gear::{PerGear, flank_zones::FlankZones};
    use gearwear_physics::results::run::PathPoints;

    /// A run whose curves are off from y = 3 + x by `error`(x).
    fn off_by(points: usize, error: impl Fn(f64) -> f64) -> ObservedRun {
        let x: Vec<f64> = (0..=points).map(|i| i as f64 / points as f64).collect();
        let y: Vec<f64> = x.iter().map(|&x| 3.0 + x + error(x)).collect();
        let flank = ObservedFlank {
            radius_mm: x.clone(),
            arc_mm: x.clone(),
            width_mm: vec![0.0],
            wear_um: y.clone(),
            zones: FlankZones {
                active_start_radius_mm: 0.0,
                tip_edge_radius_mm: f64::INFINITY,
                tip_end_radius_mm: f64::INFINITY,
                tip_radius_mm: f64::INFINITY,
                pressure_length_mm: 0.04,
            },
        };
        ObservedRun {
            flanks: PerGear { pinion: flank.clone(), wheel: flank },
            over_width: None,
            cycle: ObservedCycle {
                position_mm: x,
                peak_pressure_mpa: y.clone(),
                half_width_mm: y.clone(),
                transmission_error_um: y.clone(),
                worn_transmission_error_um: y,
            },
        }
    }

    /// Errors 0.01·(h/h₀)² of the elements and 0.02·(Δn/Δn₀) of the step, both straight in x so that interpolation is
    /// exact: the extrapolation finds 3 + x to round-off, and the finest run's errors are what it states as uncertain.
    #[test]
    fn ver_pure_orders_are_extrapolated_away() {
        let run = |points: usize, size: f64, step: f64| {
            off_by(points, move |x| 0.01 * size * size * (1.0 + x) + 0.02 * step * x)
        };
        let finest = run(50, 1.0, 1.0);
        let (long, coarse) = (run(50, 1.0, 4.0), run(25, 1.5, 4.0));
        let corrections = [
            Correction { fine: &finest, coarse: &long, ratio: 4.0, order: 1 },
            Correction { fine: &long, coarse: &coarse, ratio: 1.5, order: 2 },
        ];
        let points = PathPoints { A: 0.0, B: 0.25, C: 0.5, D: 0.75, E: 1.0 };
        let windows = Windows::new(&points, PerGear { pinion: false, wheel: false }, 0.1);
        let found = Reference::extrapolated(&finest, &corrections, &windows);
        for (x, y) in found.observed.cycle.position_mm.iter().zip(&found.observed.cycle.peak_pressure_mpa) {
            assert!((y - 3.0 - x).abs() < 1e-13, "{y} at {x}");
        }
        // At x = 1 the finest run has 4.04 in place of 4.
        assert!((found.uncertainty[&ComparedQuantity::PeakPressure] - 0.01).abs() < 1e-12);
        // 0.02 of 4.04 by the step, then 0.02 of 4.02 by the elements.
        let parts: Vec<f64> = found.parts.iter().map(|part| part[&ComparedQuantity::PeakPressure]).collect();
        assert!((parts[0] - 0.02 / 4.02).abs() < 1e-12 && (parts[1] - 0.02 / 4.0).abs() < 1e-12, "{parts:?}");
    }
}
