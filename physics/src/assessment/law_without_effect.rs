//! Warns where a part of the wear law that the scene asks for changes nothing, so that nobody takes its absence for an answer.

use super::RunModel;
use crate::lubrication::settings::FilmRatio;
use crate::results::lubrication::FilmSummary;
use crate::simulation::wear_run::Outcome;
use crate::wear::settings::SevereTransition;
use gearwear_bodies::gear::Gear;

/// Mean factor of the film that differs from 1 by less is one that changes nothing.
const FILM_UNCHANGED: f64 = 1e-3;

/// A line for each part of the law of each gear that changed nothing; one line where both gears say the same.
pub(super) fn warnings(model: &RunModel<'_>, outcome: &Outcome, film: Option<&FilmSummary>) -> Vec<String> {
    let of_gears = Gear::BOTH.into_iter().flat_map(|gear| {
        let severe = never_severe(model, outcome, gear);
        severe.into_iter().chain(film.and_then(|film| never_thick(model, film, gear)))
    });
    let mut lines: Vec<String> = Vec::new();
    for line in of_gears {
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

/// Severe wear whose limit no contact reached.
fn never_severe(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> Option<String> {
    let phases = model.scene.operation.phases.iter();
    let begins_mpa = phases.filter_map(|phase| model.scene.wear_in(phase)[gear].severe_transition());
    let begins_mpa = begins_mpa.map(SevereTransition::begins_mpa).reduce(f64::min)?;
    let greatest_mpa = outcome.greatest_pressure_mpa();
    (greatest_mpa < begins_mpa).then(|| {
        format!(
            "wear.severe changed nothing: pressure is {greatest_mpa:.0} MPa at most, and wear begins to be severe at {begins_mpa:.0} MPa"
        )
    })
}

/// A film that was nowhere thick enough to take wear off the gear, with λ as the law reads it.
fn never_thick(model: &RunModel<'_>, film: &FilmSummary, gear: Gear) -> Option<String> {
    let (new, worn) = (film.wear_factor_new?[gear], film.wear_factor_worn?[gear]);
    let is_unchanged = [new, worn].iter().all(|factor| (factor - 1.0).abs() < FILM_UNCHANGED);
    let ratio = model.scene.wear[gear].film.as_ref().filter(|_| is_unchanged)?.ratio;
    let [new, worn] = match ratio {
        FilmRatio::Iso633622 => [film.lambda_new, film.lambda_worn],
        FilmRatio::Composite => [film.composite_lambda_new?, film.composite_lambda_worn?],
    };
    Some(format!(
        "wear.film changed nothing: between the tip edges λ is {:.2} at most on new flanks and {:.2} on worn ones, where its factor on the wear \
         coefficient is 1",
        new.max, worn.max
    ))
}
