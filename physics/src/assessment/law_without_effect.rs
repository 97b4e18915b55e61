//! Warns where a part of the wear law that the scene asks for changes nothing, so that nobody takes its absence for an answer.

use super::RunModel;
use crate::results::lubrication::FilmSummary;
use crate::simulation::wear_run::Outcome;
use gearwear_bodies::gear::Gear;

/// Mean factor of the film that differs from 1 by less is one that changes nothing.
const FILM_UNCHANGED: f64 = 1e-3;

/// A line for each part of the law of each gear that changed nothing; one line where both gears say the same.
pub(super) fn warnings(model: &RunModel<'_>, outcome: &Outcome, film: Option<&FilmSummary>) -> Vec<String> {
    let [pinion, wheel] = Gear::BOTH.map(|gear| {
        let severe = never_severe(model, outcome, gear);
        severe.into_iter().chain(film.and_then(|film| never_thick(film, gear))).collect::<Vec<String>>()
    });
    let of_wheel: Vec<String> = wheel.into_iter().filter(|line| !pinion.contains(line)).collect();
    [pinion, of_wheel].concat()
}

/// Severe wear whose limit no contact reached.
fn never_severe(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> Option<String> {
    let greatest_mpa = [&outcome.new]
        .into_iter()
        .chain(&outcome.snapshots)
        .map(|state| state.cycle.peak_pressure_mpa())
        .fold(0.0, f64::max);
    let least_mpa = model.scene.operation.phases.iter().filter_map(|phase| {
        let severe = model.scene.wear_in(phase)[gear].severe_transition()?;
        Some(severe.above_mpa - 0.5 * severe.band_mpa)
    });
    let least_mpa = least_mpa.reduce(f64::min).filter(|least_mpa| greatest_mpa < *least_mpa)?;
    Some(format!(
        "wear.severe changed nothing: pressure is {greatest_mpa:.0} MPa at most, and wear begins to be severe at {least_mpa:.0} MPa"
    ))
}

/// A film that was nowhere thick enough to take wear off the gear.
fn never_thick(film: &FilmSummary, gear: Gear) -> Option<String> {
    let (new, worn) = (film.wear_factor_new?[gear], film.wear_factor_worn?[gear]);
    let is_unchanged = [new, worn].iter().all(|factor| (factor - 1.0).abs() < FILM_UNCHANGED);
    // λ is that of the law where flanks have a composite roughness.
    is_unchanged.then(|| {
        format!(
            "wear.film changed nothing: between the tip edges λ is {:.2} at most on new flanks and {:.2} on worn ones, where its factor on the wear \
             coefficient is 1",
            film.lambda_new.max, film.lambda_worn.max
        )
    })
}
