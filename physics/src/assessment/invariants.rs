//! Statements that hold for every run, held against this one.
//!
//! | name | statement |
//! |---|---|
//! | `torque-balance` | the loads of all pairs are the load to carry, at every position |
//! | `flanks-overlap-nowhere` | beside the contacts that are found the flanks do not touch, at any position |
//! | `volume-balance` | both flanks of a contact lose the same volume for the same coefficient |
//! | `volume-of-work` | a flank loses k ∫ F ds |
//! | `load-rises-with-approach` | the mesh stiffness is positive |
//! | `wear-raises-transmission-error` | flanks that have lost material are nowhere nearer under the same load |
//! | `transmission-error-continuous` | the transmission error has no jump between neighbouring positions |
//! | `load-share-continuous` | the load of a pair, or of a slice, has no jump between neighbouring positions |
//!
//! # Jumps
//!
//! Under a given load the transmission error δ is a continuous function of the position: a pair that comes in does so through a gap which
//! closes steadily. Samples y_k, h apart, show a jump where one step is greater than both of its neighbours:
//!
//! ```text
//! J_k = |y_k+1 − y_k| − max(|y_k − y_k−1|, |y_k+2 − y_k+1|)
//! ```
//!
//! which is 0 or less where a smooth curve or a kink is resolved. What is steeper than the samples resolve is at most as steep as the gap
//! of the pair that comes in: outside A to E the gap of a tip edge grows with the square of the distance, to δ at the reach s_δ of
//! [`GearPair::tip_reach_mm`], so that
//!
//! ```text
//! |dδ/dξ| ≤ 2 δ/s_δ + slopes of the modifications and of the wear        |dX/dξ| ≤ c_γ/F |dδ/dξ|
//! ```
//!
//! A jump that is more than what [`STEEPER`] times that slope makes over h, and more than [`LEAST_JUMP`], is none of the physics'. Where contact is
//! cut off at A and E, or teeth touch farther outside than tip edges are followed, jumps are the model's, and nothing is said.

use super::left_out_contact::is_beyond_range;
use super::{RunModel, UM_PER_MM};
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::sliced_mesh::SlicedMesh;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::mesh_cycle::{CycleObservation, FlankOverlap, PositionObservation};
use crate::results::invariant::Invariant;
use crate::results::run::WearBalance;
use crate::simulation::wear_run::Outcome;
use gearwear_bodies::gear::Gear;

/// Greatest |Σ loads / load − 1|: equilibria are solved to 1e-10 of the load.
const MOST_IMBALANCE: f64 = 1e-6;
/// Greatest part of the transmission error by which flanks overlap: finite elements let pass 1e-3.
const MOST_OVERLAP: f64 = 2e-3;
/// Greatest difference of volumes of flanks that are resolved: tip edges and reliefs are not.
const MOST_VOLUME_DIFFERENCE: f64 = 0.2;
/// Flank points that a contact needs in its half-width before volumes are held against each other.
const POINTS_IN_HALF_WIDTH: f64 = 2.0;
/// Greatest part of the transmission error by which worn flanks are nearer: a contact's window that has grown has other cells (found: 3e-4
/// on four of 2500 random scenes, on foundations that are coarsely sampled).
const MOST_NEARER: f64 = 1e-3;
/// Greatest part by which worn flanks are nearer on finite elements, whose worn sharp edges begin to carry between two nodes (found: 0.4 %).
const MOST_NEARER_OF_ELEMENTS: f64 = 0.01;
/// Steeper than the gap of a single tip edge: slices and pairs come in together, and their stiffness varies.
const STEEPER: f64 = 3.0;
/// Part of the transmission error, or of the load, up to which a jump is none: what contact windows that grow, and stiffness that varies
/// within a step, make of it.
const LEAST_JUMP: f64 = 0.03;
/// Samples below which nothing is said of jumps.
const FEWEST_SAMPLES: usize = 8;

/// Invariants of a run, in the order of the table above.
pub(super) fn of_run(model: &RunModel<'_>, outcome: &Outcome, balance: &WearBalance) -> Vec<Invariant> {
    let states = [("new", &outcome.new), ("worn", &outcome.worn)];
    let is_resolved = are_resolved(model, outcome);
    // Transitions, films and temperatures differ at single points of both flanks: only a coefficient that is one says how volumes compare.
    let both = balance.new.filter(|_| balance.work_new.is_some());
    vec![
        torque_balance(&states),
        overlap_nowhere(&states),
        volumes(
            "volume-balance",
            both.filter(|_| is_resolved),
            "difference of the volumes that both flanks lose in one mesh for the same coefficient, over the greater",
        ),
        volumes(
            "volume-of-work",
            balance.work_new.filter(|_| is_resolved),
            "difference of the volume that a flank loses in one mesh from its coefficient times load and sliding distance, over that",
        ),
        rises(&states),
        nearer(model, outcome),
        continuous_error(model, outcome, &states),
        continuous_load(model, outcome, &states),
    ]
}

/// Warnings of violated invariants.
pub(super) fn warnings(invariants: &[Invariant]) -> impl Iterator<Item = String> {
    invariants
        .iter()
        .filter_map(Invariant::violation)
        .map(|violation| format!("the run contradicts itself: {violation}"))
}

/// A value with its place.
type Found = (f64, String);

/// The greatest of `found`; a value that is no number is the greatest.
fn greatest(found: impl IntoIterator<Item = Found>) -> Option<Found> {
    found.into_iter().reduce(|most, next| if next.0.is_nan() || next.0 > most.0 { next } else { most })
}

fn at(when: &str, position_mm: f64) -> String {
    format!("{when}, at {position_mm:.4} mm of the pinion's radius of curvature")
}

fn torque_balance(states: &[(&str, &Snapshot); 2]) -> Invariant {
    let of = |(when, state): &(&str, &Snapshot)| {
        let found = |position: &PositionObservation| (position.load_imbalance.abs(), at(when, position.position_mm));
        greatest(state.cycle.positions.iter().map(found))
    };
    let (value, place) = greatest(states.iter().filter_map(of)).unwrap_or_default();
    let how = "loads of all pairs together less the load to carry, over that";
    Invariant::judged("torque-balance", value, MOST_IMBALANCE, Some(place), how)
}

fn overlap_nowhere(states: &[(&str, &Snapshot); 2]) -> Invariant {
    let name = "flanks-overlap-nowhere";
    let of = |(when, state): &(&str, &Snapshot)| {
        let FlankOverlap { of_transmission_error, position_mm } = state.cycle.deepest_overlap?;
        Some((of_transmission_error, at(when, position_mm)))
    };
    match greatest(states.iter().filter_map(of)) {
        Some((value, place)) => {
            let how = "how deep flanks overlap beside the contacts found, over the transmission error";
            Invariant::judged(name, value, MOST_OVERLAP, Some(place), how)
        }
        None => Invariant::not_judged(name, "the model does not look at the gap of the flanks"),
    }
}

/// Whether Hertz's contact at C is at least as wide as positions are apart, and its half-width [`POINTS_IN_HALF_WIDTH`] times as wide as flank points of
/// either gear are. Loads of positions farther apart do not tell what relief and tip edges make of them between: with 24 positions, 2.5 to 3.1 half-widths
/// apart, volumes are up to 26 % off the work of sliding, with 48 up to 13 %, with 96 up to 5 %.
fn are_resolved(model: &RunModel<'_>, outcome: &Outcome) -> bool {
    let half_width_mm = model.at_pitch.contact.loaded(model.reference().line_load_n_per_mm).half_width_mm;
    let [first, second, ..] = &outcome.new.cycle.positions[..] else { return false };
    if second.position_mm - first.position_mm > 2.0 * half_width_mm {
        return false;
    }
    Gear::BOTH.into_iter().all(|gear| {
        let (grid, start) = (&outcome.grid[gear], model.pair.active_start_rho_mm(gear));
        let apart = grid.arc_mm.windows(2).zip(&grid.coordinate_mm).filter(|(_, rho)| **rho >= start);
        apart.map(|(two, _)| two[1] - two[0]).fold(0.0, f64::max) * POINTS_IN_HALF_WIDTH <= half_width_mm
    })
}

/// Volumes of the unworn pair: what Euler steps that are too long make of worn flanks is told elsewhere.
fn volumes(name: &str, found: Option<f64>, how: &str) -> Invariant {
    match found {
        Some(value) => Invariant::judged(name, value, MOST_VOLUME_DIFFERENCE, Some("new".to_owned()), how),
        None => Invariant::not_judged(
            name,
            "the wear laws do not say how the volumes compare, or a contact is narrower than four flank points or the distance of positions",
        ),
    }
}

fn rises(states: &[(&str, &Snapshot); 2]) -> Invariant {
    let name = "load-rises-with-approach";
    let of = |(when, state): &(&str, &Snapshot)| {
        let stiffness = |position: &PositionObservation| {
            Some((-position.stiffness_n_per_mm2? / UM_PER_MM, at(when, position.position_mm)))
        };
        greatest(state.cycle.positions.iter().filter_map(stiffness))
    };
    match greatest(states.iter().filter_map(of)) {
        Some((value, place)) => {
            Invariant::judged(name, value, 0.0, Some(place), "mesh stiffness with its sign turned, N/(mm·µm)")
        }
        None => Invariant::not_judged(name, "the model does not give its mesh stiffness"),
    }
}

/// Worn flanks against new ones under the same load.
fn nearer(model: &RunModel<'_>, outcome: &Outcome) -> Invariant {
    let name = "wear-raises-transmission-error";
    let (new, worn) = (&outcome.new.cycle.positions, &outcome.worn.cycle.positions);
    if !outcome.stop.is_complete() || new.len() != worn.len() {
        return Invariant::not_judged(name, "the run did not come to its end");
    }
    let found = new.iter().zip(worn).map(|(new, worn)| {
        let by = (new.transmission_error_mm - worn.transmission_error_mm) / new.transmission_error_mm.abs();
        (by, at("worn", new.position_mm))
    });
    let (value, place) = greatest(found).unwrap_or_default();
    let how = "transmission error of the new flanks less that of the worn ones under the same load, over the former";
    let bound = if model.scene.contact.surface == SurfaceKind::Fem { MOST_NEARER_OF_ELEMENTS } else { MOST_NEARER };
    Invariant::judged(name, value, bound, Some(place), how)
}

/// Why loads of the model jump, if they do: it does not follow tip edges into contact, or not as far as they touch.
fn jumps_by_itself(model: &RunModel<'_>, outcome: &Outcome) -> Option<&'static str> {
    let contact = model.scene.contact;
    let follows = match contact.surface {
        SurfaceKind::Fem => true,
        SurfaceKind::Winkler | SurfaceKind::HalfSpace => contact.tip_contact,
        SurfaceKind::Hertz | SurfaceKind::HertzMean => false,
    };
    // What overlaps by less makes no jump that is judged.
    let (_, most_mm) = outcome.new.cycle.transmission_error_mm();
    match follows {
        false => Some("the model cuts contact off at A and E, where its loads jump"),
        true if is_beyond_range(model, outcome, LEAST_JUMP * most_mm) => {
            Some("teeth touch farther outside A to E than the run follows them, where its loads jump")
        }
        true => None,
    }
}

/// The steepest that the transmission error is, mm of it per mm of the path.
fn steepest(model: &RunModel<'_>, outcome: &Outcome, state: &Snapshot) -> f64 {
    let pair = model.pair;
    let (_, most_mm) = state.cycle.transmission_error_mm();
    let reach_mm = pair.tip_reach_mm(most_mm);
    let least_mm = reach_mm[0].min(reach_mm[1]).max(pair.path.base_pitch_mm / UM_PER_MM);
    let slopes = Gear::BOTH.map(|gear| {
        let rho = &outcome.grid[gear].coordinate_mm;
        let (from, to) = (pair.active_start_rho_mm(gear), pair.rounding_start_rho_mm(gear));
        let removed = outcome.modification_mm[gear].chunks_exact(rho.len());
        let steps = removed.zip(state.wear_mm[gear].chunks_exact(rho.len())).flat_map(|(modified, worn)| {
            (1..rho.len())
                .filter(|&k| rho[k - 1] >= from && rho[k] <= to)
                .map(move |k| ((modified[k] + worn[k] - modified[k - 1] - worn[k - 1]) / (rho[k] - rho[k - 1])).abs())
        });
        steps.fold(0.0, f64::max)
    });
    2.0 * most_mm / least_mm + slopes[0] + slopes[1]
}

/// The greatest jump between samples, and the index of the sample before it. Around a cycle the last sample is before the first.
fn greatest_jump(samples: &[f64], is_cycle: bool) -> Option<(f64, usize)> {
    let n = samples.len();
    if n < FEWEST_SAMPLES {
        return None;
    }
    let steps: Vec<f64> =
        (0..if is_cycle { n } else { n - 1 }).map(|k| (samples[(k + 1) % n] - samples[k]).abs()).collect();
    let m = steps.len();
    let neighbour = |k: Option<usize>| k.and_then(|k| steps.get(k)).copied().unwrap_or(0.0);
    let jump = |k: usize| {
        let (before, after) = match is_cycle {
            true => (Some((k + m - 1) % m), Some((k + 1) % m)),
            false => (k.checked_sub(1), Some(k + 1)),
        };
        (steps[k] - neighbour(before).max(neighbour(after)), k)
    };
    // The first and the last step of a row that is no cycle have one neighbour: what a jump is there cannot be told.
    let inside = if is_cycle { 0..m } else { 1..m - 1 };
    inside.map(jump).max_by(|a, b| a.0.total_cmp(&b.0))
}

fn continuous_error(model: &RunModel<'_>, outcome: &Outcome, states: &[(&str, &Snapshot); 2]) -> Invariant {
    let name = "transmission-error-continuous";
    if let Some(why) = jumps_by_itself(model, outcome) {
        return Invariant::not_judged(name, why);
    }
    let of = |(when, state): &(&str, &Snapshot)| {
        let (samples, spacing_mm, first_mm, is_cycle) = errors(&state.cycle)?;
        let (jump_mm, k) = greatest_jump(&samples, is_cycle)?;
        let (_, most_mm) = state.cycle.transmission_error_mm();
        let allowed_mm = (STEEPER * steepest(model, outcome, state) * spacing_mm).max(LEAST_JUMP * most_mm);
        Some((jump_mm / allowed_mm, jump_mm, allowed_mm, at(when, first_mm + spacing_mm * k as f64)))
    };
    let how =
        "step of the transmission error from one position to the next less the greater of the steps beside it, µm";
    judged_jump(name, states.iter().filter_map(of), UM_PER_MM, how)
}

/// The worst of jumps, each over what is allowed, itself, what is allowed, and its place.
fn judged_jump(name: &str, found: impl Iterator<Item = (f64, f64, f64, String)>, unit: f64, how: &str) -> Invariant {
    match found.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((_, jump, allowed, place)) => Invariant::judged(name, jump * unit, allowed * unit, Some(place), how),
        None => Invariant::not_judged(name, "too few positions"),
    }
}

/// Samples of the transmission error, their distance, the first position, and whether they are one turn of a cycle.
fn errors(cycle: &CycleObservation) -> Option<(Vec<f64>, f64, f64, bool)> {
    if let Some(mesh) = &cycle.slices {
        let samples = mesh.transmission_error_mm.clone();
        return Some((samples, spacing_mm(mesh), mesh.first_position_mm, true));
    }
    let [first, second] = cycle.positions.first_chunk()?;
    let samples = cycle.positions.iter().map(|position| position.transmission_error_mm).collect();
    Some((samples, second.position_mm - first.position_mm, first.position_mm, false))
}

fn spacing_mm(mesh: &SlicedMesh) -> f64 {
    mesh.base_pitch_mm / mesh.transmission_error_mm.len() as f64
}

/// Load over mean load: of the pair, or of each slice of it.
fn continuous_load(model: &RunModel<'_>, outcome: &Outcome, states: &[(&str, &Snapshot); 2]) -> Invariant {
    let name = "load-share-continuous";
    if let Some(why) = jumps_by_itself(model, outcome) {
        return Invariant::not_judged(name, why);
    }
    let load = model.reference().line_load_n_per_mm;
    let of = |(when, state): &(&str, &Snapshot)| {
        let (jump, position_mm, spacing_mm) = match &state.cycle.slices {
            Some(mesh) => slice_jump(mesh, load)?,
            None => {
                let positions = &state.cycle.positions;
                let shares: Vec<f64> = positions.iter().map(|position| position.load_share).collect();
                let (jump, k) = greatest_jump(&shares, false)?;
                (jump, positions[k].position_mm, positions[1].position_mm - positions[0].position_mm)
            }
        };
        let stiffness = state.cycle.positions.iter().filter_map(|position| position.stiffness_n_per_mm2);
        let stiffest = stiffness.fold(load / state.cycle.transmission_error_mm().0, f64::max);
        let allowed = (STEEPER * steepest(model, outcome, state) * spacing_mm * stiffest / load).max(LEAST_JUMP);
        Some((jump / allowed, jump, allowed, at(when, position_mm)))
    };
    let how = "step of a pair's share of the load, or of a slice's load over the mean, from one position to the next less the greater of the \
               steps beside it";
    judged_jump(name, states.iter().filter_map(of), 1.0, how)
}

/// The greatest jump of any slice's load over `load`, where it is, and how far positions are apart. No slice is loaded before the first row and after the last.
fn slice_jump(mesh: &SlicedMesh, load: f64) -> Option<(f64, f64, f64)> {
    let of_slice = |slice: usize| {
        let loads = mesh.line_load_n_per_mm.iter().skip(slice).step_by(mesh.slices).map(|at| at / load);
        let padded: Vec<f64> = [0.0, 0.0].into_iter().chain(loads).chain([0.0, 0.0]).collect();
        let (jump, k) = greatest_jump(&padded, false)?;
        Some((jump, mesh.position_mm[k.saturating_sub(2).min(mesh.position_mm.len() - 1)]))
    };
    let (jump, position_mm) = (0..mesh.slices).filter_map(of_slice).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((jump, position_mm, spacing_mm(mesh)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kink, a steep stretch of two steps and a smooth wave are no jumps; a step of one sample is, by its whole height.
    #[test]
    fn ver_jumps_are_told_from_kinks_and_steep_stretches() {
        let kink: Vec<f64> = (0..20).map(|k| (f64::from(k) - 9.5).abs()).collect();
        let steep: Vec<f64> = (0..20).map(|k| (f64::from(k) - 8.0).clamp(0.0, 2.0)).collect();
        let wave: Vec<f64> = (0..20).map(|k| (f64::from(k) / 3.0).sin()).collect();
        for smooth in [&kink, &steep, &wave] {
            assert!(greatest_jump(smooth, false).unwrap().0 <= 0.05, "{smooth:?}");
        }
        let step: Vec<f64> = (0..20).map(|k| if k > 12 { 5.0 } else { 2.0 }).collect();
        assert_eq!(greatest_jump(&step, false), Some((3.0, 12)));
        // Round a cycle the step back is one too.
        assert_eq!(greatest_jump(&step, true).unwrap().0, 3.0);
        assert_eq!(greatest_jump(&step[..5], true), None);
    }
}
