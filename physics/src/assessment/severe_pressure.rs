//! Check that the pressure which decides on severe wear is that of elastic contact.
//!
//! A Winkler foundation under line load w carries p₀ = 3w/(4a) over a³ = 3wR/(2 K/H), elastic bodies Hertz's 2w/(π a_H): with K/H matched on
//! the half-width its pressure is 3π/8 = 1.178 of that. The mean pressure of `hertz-mean` is π/4 of it.

use std::f64::consts::FRAC_PI_4;

use super::RunModel;
use crate::contact::{foundation, settings::SurfaceKind};
use crate::simulation::wear_run::Outcome;
use crate::wear::settings::WearOfPair;

/// Difference from the elastic pressure that is not warned of: a limit is not known so well.
const LITTLE: f64 = 0.02;

/// Pressure of the surface at the pitch point under the greatest load, over Hertz's; none where the surface is elastic.
fn over_elastic(model: &RunModel<'_>, outcome: &Outcome) -> Option<f64> {
    let line_load = model.reference().line_load_n_per_mm;
    let hertz = model.at_pitch.contact.loaded(line_load);
    match model.scene.contact.surface {
        SurfaceKind::HertzMean => Some(FRAC_PI_4),
        SurfaceKind::Winkler => {
            let mpa_per_mm = model.foundations_mpa_per_mm[outcome.reference_phase]?;
            let half_width =
                foundation::half_width_mm(mpa_per_mm, model.at_pitch.contact.relative_radius_mm(), line_load);
            Some(0.75 * line_load / half_width / hertz.peak_pressure_mpa)
        }
        SurfaceKind::Hertz | SurfaceKind::HalfSpace | SurfaceKind::Fem => None,
    }
}

/// Warns where wear is severe, or would be under the elastic pressure, and the surface has another one.
pub(super) fn warning(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    let ratio = over_elastic(model, outcome).filter(|ratio| (ratio - 1.0).abs() > LITTLE)?;
    let greatest_mpa = outcome.greatest_pressure_mpa();
    model.scene.wear.is_severe_under(greatest_mpa.max(greatest_mpa / ratio), 1.0).then(|| {
        let (off, side) = (100.0 * (ratio - 1.0).abs(), if ratio > 1.0 { "above" } else { "below" });
        format!(
            "wear.severe.above_MPa: where wear is severe is decided by the pressure of contact.surface, which at the pitch point is {off:.0} % {side} that of \
             elastic contact; surface = \"half-space\" has the elastic one, \"winkler\" with match = \"peak-pressure\" nearly"
        )
    })
}
