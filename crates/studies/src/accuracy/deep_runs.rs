//! The models run to a greater depth, with the scene's number of wear steps and with fewer.
//!
//! Euler's explicit step is stable while what a point loses in one step does not relieve it of more than its load: with K the
//! pressure that a depth takes off the surface, Δn k K s < 2. Surfaces that read the worn gap have a K, the stiffer the shorter
//! the waves they resolve; surfaces that only know the gap at the theoretical contact point have none. Where the bound is passed,
//! wear alternates from step to step and spikes grow out of the profile.
//!
//! Whether a run has oscillated is not read off its profile alone, which has jumps of its own where the load changes. Each model
//! is run twice, with the number of steps of the scene and with a [`FEWER_STEPS`]th of it, to [`DEEPER`] times the scene's
//! revolutions: the error of Euler's method is of first order in the step and changes the greatest depth by some per cent; spikes
//! change it by far more. A run is called stable where both gears' greatest depths change by less than [`STABLE_WITHIN`].

use super::measure::{profile_error, ratio, relative_difference};
use super::observed::{ObservedFlank, ObservedRun};
use super::settings::{Coarsening, Setting, SurfaceSetting, coupling_name, euler_revolutions};
use super::timed_run::{Finished, measure};
use crate::accuracy::record::{DeepRow, DeepRun, DeepRuns};
use gearwear::scene::file::StepFile;
use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::{Problem, Resolved};
use gearwear::varied_scene::in_words;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::contact::settings::{Foundation, MatchCriterion};
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::observer::{Observer, PartOf};

/// Factor on the scene's revolutions.
const DEEPER: f64 = 10.0;
/// Divisor of the scene's number of wear steps.
const FEWER_STEPS: u32 = 10;
/// Greatest relative change of the greatest depth of a stable run.
const STABLE_WITHIN: f64 = 0.1;
/// Least ratio of the numbers of steps for a judgement of stability.
const LEAST_STEP_RATIO: f64 = 2.0;
/// Models that are run, the baseline first.
const MODELS: [(SurfaceSetting, Coupling); 5] = [
    (SurfaceSetting::HalfSpace, Coupling::Slicing),
    (SurfaceSetting::Winkler(Foundation::Matched(MatchCriterion::HalfWidth)), Coupling::Slicing),
    (SurfaceSetting::Hertz, Coupling::Slicing),
    (SurfaceSetting::HertzMean, Coupling::Slicing),
    (SurfaceSetting::HertzMean, Coupling::None),
];

/// Number of runs of the comparison.
pub(super) const RUNS: usize = 2 * MODELS.len();

/// Runs the models that `like`, a setting with slices, stands beside; `first` of `count` runs are done. `None` without slices, or
/// where the user interrupted it.
pub(super) fn run(
    given: &LoadedScene,
    like: &Setting,
    observer: &dyn Observer,
    first: usize,
    count: usize,
) -> Option<DeepRuns> {
    let slices = given.scene().slices?;
    let deeper = deeper(&given.resolved).map(|resolved| LoadedScene { resolved, ..given.clone() });
    let mut rows = Vec::new();
    let mut baseline: Option<ObservedRun> = None;
    for (index, (surface, coupling)) in MODELS.into_iter().enumerate() {
        let slices = Some(SliceSettings { coupling, ..slices });
        let model = Setting { surface, tip_contact: surface.may_follow_tip(), slices, ..like.clone() };
        let mut row = DeepRow::of(format!("{} · {}", model.surface_name(), coupling_name(coupling)));
        let base = match &deeper {
            Ok(base) => base,
            Err(problems) => {
                rows.push(DeepRow { failure: Some(in_words(problems)), ..row });
                continue;
            }
        };
        let mut usual = None;
        for (number, step) in [1, FEWER_STEPS].into_iter().enumerate() {
            let number = first + 2 * index + number;
            observer.run_of(number, count, &format!("{DEEPER} times the revolutions: {}, steps {step}", row.name));
            let setting = Setting { coarsening: Coarsening { step, ..like.coarsening }, ..model.clone() };
            let measured = measure(&setting, base, &PartOf::new(observer, number, count))?;
            row.failure = row.failure.or(measured.record.failure);
            let finished = measured.finished.zip(measured.record.simulation_s);
            let deep_run = finished.as_ref().map(|(run, simulation_s)| deep_run(run, *simulation_s));
            if step == 1 {
                row.usual = deep_run;
                usual = finished.map(|(run, _)| run.observed);
            } else {
                row.fewer_steps = deep_run;
            }
        }
        row.wear_profile = usual.as_ref().zip(baseline.as_ref()).map(|(own, baseline)| {
            let own = own.at_coordinates_of(baseline);
            larger(|gear| profile_error(&own.flanks[gear], &baseline.flanks[gear]))
        });
        if index == 0 {
            baseline = usual;
        }
        judge_stability(&mut row);
        rows.push(row);
    }
    let stiffness = like.stiffness.as_ref().map_or("", |stiffness| &stiffness.name);
    Some(DeepRuns {
        common: format!(
            "{DEEPER} times the scene's revolutions, {} slices, stiffness {stiffness}, points and positions 1/{} of the scene's",
            slices.count, like.coarsening.spacing
        ),
        revolutions_factor: DEEPER,
        baseline: rows.first().map_or_else(String::new, |row| row.name.clone()),
        stable_within: STABLE_WITHIN,
        rows,
    })
}

/// Judges the stability by the change of the greatest depths, where the numbers of steps differ by at least [`LEAST_STEP_RATIO`].
fn judge_stability(row: &mut DeepRow) {
    if let (Some(usual), Some(fewer)) = (&row.usual, &row.fewer_steps)
        && usual.wear_steps as f64 >= LEAST_STEP_RATIO * fewer.wear_steps as f64
    {
        let change = larger(|gear| relative_difference(fewer.peak_wear_um[gear], usual.peak_wear_um[gear]));
        row.peak_wear_change = Some(change);
        row.stable = Some(change <= STABLE_WITHIN);
    }
}

/// The scene run to a greater depth with the same number of wear steps.
fn deeper(resolved: &Resolved) -> Result<Resolved, Vec<Problem>> {
    let mut file = resolved.file.clone();
    let operation = &mut file.operation;
    operation.hours = None;
    operation.pinion_revolutions = Some(DEEPER * resolved.scene.operation.pinion_revolutions);
    if let Some(phases) = &mut operation.phases {
        operation.pinion_revolutions = None;
        for phase in phases {
            phase.hours = phase.hours.map(|hours| DEEPER * hours);
            phase.pinion_revolutions = phase.pinion_revolutions.map(|revolutions| DEEPER * revolutions);
        }
    }
    operation.snapshots_h = None;
    // Only the end of the run is a snapshot: any other shortens the step before it.
    operation.snapshots_revolutions = Some(vec![DEEPER * resolved.scene.operation.pinion_revolutions]);
    file.numerics.get_or_insert_default().step = Some(StepFile::fixed(DEEPER * euler_revolutions(&resolved.scene)));
    Resolved::from_toml(&file.to_toml())
}

fn larger(of: impl Fn(Gear) -> f64) -> f64 {
    of(Gear::Pinion).max(of(Gear::Wheel))
}

fn deep_run(finished: &Finished, simulation_s: f64) -> DeepRun {
    let flanks = &finished.observed.flanks;
    DeepRun {
        wear_steps: finished.summary.work.wear_steps,
        simulation_s,
        peak_wear_um: PerGear::from_fn(|gear| flanks[gear].peak_wear_um()),
        roughness: PerGear::from_fn(|gear| roughness(&flanks[gear])),
        warned: finished.summary.warnings.iter().any(|warning| warning.starts_with("numerics.step")),
    }
}

/// ‖h − S h‖/‖h‖ where S averages each point with its neighbours on the same slice, (1/4, 1/2, 1/4): of a depth that alternates
/// from point to point nothing is left by S.
fn roughness(flank: &ObservedFlank) -> f64 {
    let (jumps, size) = flank.slices().fold((0.0, 0.0), |(jumps, size), slice| {
        let differences = slice.windows(3).map(|h| 0.5 * h[1] - 0.25 * (h[0] + h[2]));
        (jumps + differences.map(|d| d * d).sum::<f64>(), size + slice.iter().map(|h| h * h).sum::<f64>())
    });
    ratio(jumps.sqrt(), size.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::flank_zones::FlankZones;

    /// On a depth of 3 an alternation of 1 leaves ‖±1‖/‖3 ± 1‖ = √(1/10) but for the two ends; a straight profile leaves nothing.
    #[test]
    fn ver_the_roughness_of_an_alternating_profile() {
        let mut flank = ObservedFlank {
            radius_mm: vec![0.0; 1000],
            arc_mm: vec![0.0; 1000],
            width_mm: vec![1.0, 2.0],
            wear_um: (0..2000).map(|i| 3.0 + if i % 2 == 0 { 1.0 } else { -1.0 }).collect(),
            zones: FlankZones {
                active_start_radius_mm: 0.0,
                tip_edge_radius_mm: f64::INFINITY,
                tip_end_radius_mm: f64::INFINITY,
                tip_radius_mm: f64::INFINITY,
                pressure_length_mm: 0.04,
            },
        };
        assert!((roughness(&flank) - f64::sqrt(0.1 * 998.0 / 1000.0)).abs() < 1e-14);
        flank.wear_um = (0..2000).map(|i| f64::from(i % 1000)).collect();
        assert!(roughness(&flank) < 1e-14);
    }
}
