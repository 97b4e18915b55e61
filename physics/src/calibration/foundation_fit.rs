//! K/H as a curve over position and load, fitted to finite elements, with the error it has where it was not fitted.
//!
//! At each fitted position
//!
//! ```text
//! ln K/H = ln K(ξ) − m(ξ) ln(w/w_ref)
//! ```
//!
//! by least squares over the fitted loads, with m held from 0 to below 1: springs soften with the load, and not so much that it has no
//! answer. Where the edge of a small tooth cuts into the strip the points themselves may ask for more. Hertz has m = ½ for half-width and peak pressure, whatever the position. One
//! K/H meets one criterion: a foundation that has the half-width of an elliptic pressure peaks 3π/8 = 1.178 times as high, one
//! that has its peak is 1.178 times as wide, and the approach of either is about a third of the true one. Every row
//! therefore reports all three.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::single_contact::{Purpose, SingleContact, Touch};
use crate::contact::{foundation::FoundationCurve, settings::MatchCriterion};

/// Greatest m.
const STEEPEST: f64 = 0.95;

/// The fitted foundation against finite elements at one position and load; errors relative to finite elements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitRow {
    /// ξ, mm.
    pub position_mm: f64,
    /// w, N/mm.
    pub line_load_n_per_mm: f64,
    /// Whether the fit was made on it.
    pub fitted: bool,
    /// K/H that finite elements ask for, MPa/mm.
    pub fem_mpa_per_mm: f64,
    /// K/H of Hertz in closed form, MPa/mm.
    pub hertz_mpa_per_mm: f64,
    /// K/H of the curve, MPa/mm.
    pub curve_mpa_per_mm: f64,
    /// Half-width of the foundation over that of finite elements, less 1.
    pub half_width_error: f64,
    /// The same of the peak pressure.
    pub peak_pressure_error: f64,
    /// The same of the approach.
    pub approach_error: f64,
}

/// Errors over some rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitErrors {
    /// Greatest magnitude of the error in the matched quantity.
    pub worst_matched: f64,
    /// Root mean square of the same.
    pub rms_matched: f64,
    /// Mean error of the half-width.
    pub mean_half_width: f64,
    /// Mean error of the peak pressure.
    pub mean_peak_pressure: f64,
    /// Mean error of the approach.
    pub mean_approach: f64,
}

/// The fit for one criterion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundationFit {
    /// On the points it was made on.
    pub fitted: FitErrors,
    /// On those held out.
    pub held_out: FitErrors,
    /// All of them.
    pub rows: Vec<FitRow>,
}

impl FitRow {
    /// Error of the quantity that `criterion` matches.
    pub fn matched_error(&self, criterion: MatchCriterion) -> f64 {
        match criterion {
            MatchCriterion::HalfWidth => self.half_width_error,
            MatchCriterion::PeakPressure => self.peak_pressure_error,
            MatchCriterion::Approach => self.approach_error,
        }
    }
}

/// Fits the curve of `criterion` to the fitted points, and continues it to the ends of the path, A and E.
pub fn fit(
    criterion: MatchCriterion,
    contacts: &[SingleContact],
    reference_n_per_mm: f64,
    ends_mm: (f64, f64),
) -> FoundationCurve {
    let mut curve = FoundationCurve {
        position_mm: Vec::new(),
        mpa_per_mm: Vec::new(),
        load_exponent: Vec::new(),
        reference_line_load_n_per_mm: reference_n_per_mm,
    };
    for at in contacts.chunk_by(|a, b| a.position_mm == b.position_mm) {
        let points: Vec<(f64, f64)> = at
            .iter()
            .filter(|contact| contact.purpose == Purpose::Fitted)
            .map(|c| ((c.line_load_n_per_mm / reference_n_per_mm).ln(), c.mpa_per_mm(criterion).ln()))
            .collect();
        if points.len() > 1 {
            let (intercept, slope) = line(&points);
            curve.position_mm.push(at[0].position_mm);
            curve.mpa_per_mm.push(intercept.exp());
            curve.load_exponent.push(-slope);
        }
    }
    continue_to(&mut curve, ends_mm);
    curve
}

/// Continues the curve to A and E in straight lines of ln K.
fn continue_to(curve: &mut FoundationCurve, (start_mm, end_mm): (f64, f64)) {
    let n = curve.position_mm.len();
    if n < 2 {
        return;
    }
    let ln_k = |at: f64, k: usize, j: usize| {
        let (from, slope) = (
            curve.mpa_per_mm[k].ln(),
            (curve.mpa_per_mm[j] / curve.mpa_per_mm[k]).ln() / (curve.position_mm[j] - curve.position_mm[k]),
        );
        (from + slope * (at - curve.position_mm[k])).exp()
    };
    let (first, last) = (ln_k(start_mm, 0, 1), ln_k(end_mm, n - 1, n - 2));
    if start_mm < curve.position_mm[0] {
        curve.position_mm.insert(0, start_mm);
        curve.mpa_per_mm.insert(0, first);
        curve.load_exponent.insert(0, curve.load_exponent[0]);
    }
    if end_mm > curve.position_mm[curve.position_mm.len() - 1] {
        curve.position_mm.push(end_mm);
        curve.mpa_per_mm.push(last);
        curve.load_exponent.push(curve.load_exponent[curve.load_exponent.len() - 1]);
    }
}

/// Intercept and slope of the line that fits best, of those that fall by 0 to [`STEEPEST`].
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xx, xy) = points
        .iter()
        .fold((0.0, 0.0), |(xx, xy), point| (xx + (point.0 - x).powi(2), xy + (point.0 - x) * (point.1 - y)));
    let slope = (xy / xx).clamp(-STEEPEST, 0.0);
    (y - slope * x, slope)
}

/// The curve against all points away from the edges.
pub fn compare(criterion: MatchCriterion, curve: &FoundationCurve, contacts: &[SingleContact]) -> FoundationFit {
    let rows: Vec<FitRow> =
        contacts.iter().filter(|c| c.purpose != Purpose::AtEdge).map(|c| row(criterion, curve, c)).collect();
    let errors = |fitted: bool| FitErrors::of(criterion, rows.iter().filter(|row| row.fitted == fitted));
    FoundationFit { fitted: errors(true), held_out: errors(false), rows }
}

/// Curves and fits of all criteria.
pub fn all(
    contacts: &[SingleContact],
    reference_n_per_mm: f64,
    ends_mm: (f64, f64),
) -> (BTreeMap<MatchCriterion, FoundationCurve>, BTreeMap<MatchCriterion, FoundationFit>) {
    let curves: BTreeMap<_, _> =
        MatchCriterion::ALL.into_iter().map(|c| (c, fit(c, contacts, reference_n_per_mm, ends_mm))).collect();
    let fits = curves.iter().map(|(&criterion, curve)| (criterion, compare(criterion, curve, contacts))).collect();
    (curves, fits)
}

fn row(criterion: MatchCriterion, curve: &FoundationCurve, contact: &SingleContact) -> FitRow {
    let (w, radius, fem) = (contact.line_load_n_per_mm, contact.relative_radius_mm, &contact.fem);
    let curve_mpa_per_mm = curve.at_mpa_per_mm(contact.position_mm, w);
    let foundation = Touch::of_foundation(curve_mpa_per_mm, radius, w);
    FitRow {
        position_mm: contact.position_mm,
        line_load_n_per_mm: w,
        fitted: contact.purpose == Purpose::Fitted,
        fem_mpa_per_mm: contact.mpa_per_mm(criterion),
        hertz_mpa_per_mm: contact.hertz_mpa_per_mm(criterion),
        curve_mpa_per_mm,
        half_width_error: foundation.half_width_mm / fem.half_width_mm - 1.0,
        peak_pressure_error: foundation.peak_pressure_mpa / fem.peak_pressure_mpa - 1.0,
        approach_error: foundation.approach_mm / fem.approach_mm - 1.0,
    }
}

impl FitErrors {
    fn of<'a>(criterion: MatchCriterion, rows: impl Iterator<Item = &'a FitRow> + Clone) -> Self {
        let count = rows.clone().count().max(1) as f64;
        let mean = |of: &dyn Fn(&FitRow) -> f64| rows.clone().map(of).sum::<f64>() / count;
        Self {
            worst_matched: rows.clone().map(|row| row.matched_error(criterion).abs()).fold(0.0, f64::max),
            rms_matched: mean(&|row| row.matched_error(criterion).powi(2)).sqrt(),
            mean_half_width: mean(&|row| row.half_width_error),
            mean_peak_pressure: mean(&|row| row.peak_pressure_error),
            mean_approach: mean(&|row| row.approach_error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a line give it back; rising ones and such that fall too steeply the nearest line that is allowed.
    #[test]
    fn ver_lines_are_held_within_their_bounds() {
        let of_slope = |slope: f64| line(&[(-1.0, 3.0 - slope), (0.0, 3.0), (1.0, 3.0 + slope)]);
        for (slope, expected) in [(-0.5, -0.5), (0.2, 0.0), (-1.5, -STEEPEST)] {
            let (intercept, found) = of_slope(slope);
            assert!(
                (found - expected).abs() < 1e-15 && (intercept - 3.0).abs() < 1e-15,
                "{slope}: {found} {intercept}"
            );
        }
    }
}
