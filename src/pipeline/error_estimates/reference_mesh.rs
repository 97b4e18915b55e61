//! The contact model as a whole, against the finite-element mesh that a calibration holds.
//!
//! A calibration stores what one mesh of the unworn flanks wears by finite elements, contact outside the line of action
//! included, at some loads. Around the place of the run's greatest wear, two half-widths of contact to either side, where the
//! wear of one mesh is spread over the strip and does not hang on a single point,
//!
//! ```text
//! surface model    |∫ h ds − ∫ h_fem ds| / ∫ h_fem ds        h: depth lost in the first mesh
//! ```
//!
//! It judges pressure, load sharing, tooth stiffness and tip contact together, as they are at the beginning of the run.

use super::Estimate;
use crate::calibration::wear_reference::WearReference;
use crate::gear::{Gear, flank::FlankGrid};
use crate::pipeline::Model;
use crate::simulation::figures::WearFigures;
use crate::simulation::wear_run::Outcome;

/// Half-widths of contact to either side that are compared.
const HALF_WIDTHS: f64 = 2.0;
/// Loads beyond the reference's by less than this part count as its own.
const SAME_LOAD: f64 = 0.01;

/// The estimate; `None` where the run cannot be held against a reference.
pub(super) fn estimate(model: &Model<'_>, outcome: &Outcome) -> Option<Estimate> {
    let references = &model.calibration?.wear_reference;
    if model.scene.wear.severe.is_some() {
        return None;
    }
    let involute = model.pair.teeth.pinion.involute;
    let grid = &outcome.grid.pinion;
    let reference = at_load(references, model.first().line_load_n_per_mm, grid, |rho| involute.radius_mm(rho))?;
    let peak = WearFigures::at(model.pair, Gear::Pinion, outcome, &outcome.worn).peak_radius_mm;
    let peak_arc_mm = involute.arc_mm(involute.curvature_radius_mm(peak));
    let reach_mm = HALF_WIDTHS * model.at_pitch.contact.loaded(model.first().line_load_n_per_mm).half_width_mm;
    let near = |i: &usize| (grid.arc_mm[*i] - peak_arc_mm).abs() <= reach_mm;
    let sum = |of: &dyn Fn(usize) -> f64| (0..grid.len()).filter(near).map(|i| of(i) * grid.share_mm(i)).sum::<f64>();
    let own = sum(&|i| outcome.new.depth_per_mesh_mm.pinion[i]) / model.scene.wear.coefficient_mm2_per_n;
    let fem = sum(&|i| reference[i]);
    let relative = if fem > 0.0 { (own - fem).abs() / fem } else { return None };
    Some(Estimate {
        relative: Some(relative),
        how:
            "wear of the unworn pinion in one mesh, within two half-widths of the place of greatest wear, against the \
              finite elements of the calibration: contact surface, tooth stiffness and tip contact together"
                .to_owned(),
    })
}

/// h/k of the reference at the points of `grid` under `line_load`, in straight lines between loads and points.
fn at_load(
    references: &[WearReference],
    line_load: f64,
    grid: &FlankGrid,
    radius_mm: impl Fn(f64) -> f64,
) -> Option<Vec<f64>> {
    let mut sorted: Vec<&WearReference> = references.iter().collect();
    sorted.sort_by(|a, b| a.line_load_n_per_mm.total_cmp(&b.line_load_n_per_mm));
    let load = |k: usize| sorted[k].line_load_n_per_mm;
    let last = sorted.len().checked_sub(1)?;
    if line_load < (1.0 - SAME_LOAD) * load(0) || line_load > (1.0 + SAME_LOAD) * load(last) {
        return None;
    }
    let after = sorted.partition_point(|reference| reference.line_load_n_per_mm < line_load).min(last);
    let before = after.saturating_sub(1);
    let weight = if load(after) > load(before) {
        ((line_load - load(before)) / (load(after) - load(before))).clamp(0.0, 1.0)
    } else {
        1.0
    };
    let at = |k: usize, radius: f64| {
        let flank = &sorted[k].flanks.pinion;
        interpolated(&flank.radius_mm, &flank.depth_per_coefficient_n_per_mm, radius)
    };
    grid.coordinate_mm
        .iter()
        .map(|&rho| {
            let radius = radius_mm(rho);
            let (low, high) = (at(before, radius)?, at(after, radius)?);
            Some(low + weight * (high - low))
        })
        .collect()
}

/// Value at `x` between the increasing `places`; beyond their ends, the value there; none where they do not fit each other.
fn interpolated(places: &[f64], values: &[f64], x: f64) -> Option<f64> {
    if places.len() < 2 || places.len() != values.len() {
        return None;
    }
    let after = places.partition_point(|&place| place <= x).clamp(1, places.len() - 1);
    let weight = ((x - places[after - 1]) / (places[after] - places[after - 1])).clamp(0.0, 1.0);
    Some(values[after - 1] + weight * (values[after] - values[after - 1]))
}
