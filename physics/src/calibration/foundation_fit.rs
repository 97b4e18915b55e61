//! K/H as a curve over position and load, fitted to finite elements, with its error at fitted and at held-out points.
//!
//! At each fitted position
//!
//! ```text
//! ln K/H = ln K(ξ) − m(ξ) ln(w/w_ref)
//! ```
//!
//! by least squares over the fitted loads, with m from 0 to below 1: springs soften with the load, and the load still determines the approach. Where the
//! edge of a small tooth cuts into the strip the points themselves may have a greater m. Hertz has m = ½ for half-width and peak pressure at every
//! position. One K/H meets one criterion: a foundation with the half-width of an elliptic pressure peaks 3π/8 = 1.178 times as high, one
//! with its peak is 1.178 times as wide, and the approach of either is about a third of the true one. Every row reports all three.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::single_contact::{Purpose, SingleContact, TouchFigures};
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
    /// Whether the fit was made to this point.
    pub fitted: bool,
    /// K/H that matches finite elements, MPa/mm.
    pub fem_mpa_per_mm: f64,
    /// K/H of Hertz in closed form, MPa/mm.
    pub hertz_mpa_per_mm: f64,
    /// K/H of the curve, MPa/mm.
    pub curve_mpa_per_mm: f64,
    /// Half-width of the foundation over that of finite elements, less 1.
    pub half_width_error: f64,
    /// Peak pressure of the foundation over that of finite elements, less 1.
    pub peak_pressure_error: f64,
    /// Approach of the foundation over that of finite elements, less 1.
    pub approach_error: f64,
}

/// Errors over some rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FitErrors {
    /// Greatest magnitude of the error in the matched quantity.
    pub worst_matched: f64,
    /// Root mean square of the error in the matched quantity.
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
    /// Errors at fitted points.
    pub fitted: FitErrors,
    /// Errors at held-out points.
    pub held_out: FitErrors,
    /// All points.
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
    let (first, last) =
        (continued_mpa_per_mm(curve, start_mm, [0, 1]), continued_mpa_per_mm(curve, end_mm, [n - 1, n - 2]));
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

/// K/H at a position on the straight line of ln K through two points of the curve.
fn continued_mpa_per_mm(curve: &FoundationCurve, at_mm: f64, [k, j]: [usize; 2]) -> f64 {
    let (k_mpa_per_mm, position_mm) = (&curve.mpa_per_mm, &curve.position_mm);
    let slope = (k_mpa_per_mm[j] / k_mpa_per_mm[k]).ln() / (position_mm[j] - position_mm[k]);
    (k_mpa_per_mm[k].ln() + slope * (at_mm - position_mm[k])).exp()
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
    let [fitted, held_out] =
        [true, false].map(|fitted| FitErrors::of(criterion, rows.iter().filter(|row| row.fitted == fitted)));
    FoundationFit { fitted, held_out, rows }
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
    let foundation = TouchFigures::of_foundation(curve_mpa_per_mm, radius, w);
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
        Self {
            worst_matched: rows.clone().map(|row| row.matched_error(criterion).abs()).fold(0.0, f64::max),
            rms_matched: (rows.clone().map(|row| row.matched_error(criterion).powi(2)).sum::<f64>() / count).sqrt(),
            mean_half_width: rows.clone().map(|row| row.half_width_error).sum::<f64>() / count,
            mean_peak_pressure: rows.clone().map(|row| row.peak_pressure_error).sum::<f64>() / count,
            mean_approach: rows.clone().map(|row| row.approach_error).sum::<f64>() / count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The line of points on a line; where they rise or fall too steeply, the nearest line that is allowed.
    #[test]
    fn ver_lines_are_held_within_their_bounds() {
        for (slope, expected) in [(-0.5, -0.5), (0.2, 0.0), (-1.5, -STEEPEST)] {
            let (intercept, found) = line(&[(-1.0, 3.0 - slope), (0.0, 3.0), (1.0, 3.0 + slope)]);
            assert!(
                (found - expected).abs() < 1e-15 && (intercept - 3.0).abs() < 1e-15,
                "{slope}: {found} {intercept}"
            );
        }
    }
}
