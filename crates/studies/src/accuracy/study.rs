//! The comparison itself: run every setting, build the reference, measure errors, recommend.

use std::time::Instant;

use super::comparison::{self, ComparedRun};
use super::deep_runs;
use super::front::{FrontPoint, cheapest_within, on_front};
use super::measure::{Windows, errors, peak_pressure_mpa, peak_to_peak};
use super::observed::ObservedRun;
use super::reference::{Correction, Reference};
use super::selection::{AccuracyOptions, CompanionRuns, RefinedSpacing, Selection};
use super::settings::Setting;
use super::sliced_comparison;
use super::timed_run::{Finished, MeasuredSetting, measure};
use crate::accuracy::record::{
    AccuracyRecord, CALIBRATION_FILE, ComparedQuantity, MeasuredError, NotRanked, Recommendation, ReferenceFlank,
    ReferenceRecord, VariantRecord,
};
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::assessment::calibrate::{self, CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::kept_elements::KeptElements;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::contact::settings::MatchCriterion;
use gearwear_physics::observer::{Observer, PartOf};
use gearwear_physics::results::run::StopReason;
use gearwear_physics::simulation::settings::LifeLimits;

/// Least ratio of the numbers of wear steps for an extrapolation.
const LEAST_STEP_RATIO: f64 = 1.2;
/// Limits of a reference on elastic half-planes.
const DOES_NOT_TELL: &str = "The teeth of the reference are three-dimensional finite elements, or plates where the gears cannot be meshed in \
                             space; contact itself is plane in every slice, on half-planes. The errors are those of the contact surface, of \
                             the coupling of slices and of the resolution, not that of half-planes at tip edges and end faces.";

/// Why there is nothing to compare.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AccuracyError {
    /// A run of the reference failed.
    #[error("the reference, {name}: {reason}")]
    Reference { name: String, reason: String },
    #[error("interrupted before the reference was finished")]
    Interrupted,
}

/// Runs every setting that fits the scene and compares them.
///
/// A setting that fails is a row with its failure; an interrupt ends the comparison with what is finished by then.
///
/// # Errors
/// [`AccuracyError`] where the reference is not finished.
pub fn run(
    given: &LoadedScene,
    asked: AccuracyOptions,
    observer: &dyn Observer,
) -> Result<AccuracyRecord, AccuracyError> {
    let start = Instant::now();
    let CalibrationOfRuns { made, wall_s: calibration_s, why_none } = calibration(given, observer)?;
    let mut given = made.map_or_else(|| given.clone(), |made| given.calibrated(made));
    leave_out_stop(&mut given.resolved);
    given.elements = KeptElements::up_to_gb(0.0);
    let (resolved, made) = (&given.resolved, given.files.calibration.as_ref());
    let calibrated: Vec<MatchCriterion> = made.map_or_else(Vec::new, |made| made.foundation.keys().copied().collect());
    let selection = Selection::new(resolved, asked, &calibrated, &why_none);
    let settings = selection.settings.len();
    let count = settings + if resolved.scene.slices.is_some() { deep_runs::RUNS } else { 0 };
    let measured = measure_all(&selection.settings, &given, observer, count);
    let all_measured = measured.len() == settings;
    let second = selection.second_resolution();
    let deep_runs = all_measured.then(|| deep_runs::run(&given, &second, observer, settings, count)).flatten();
    let is_complete = all_measured && deep_runs.is_some() == resolved.scene.slices.is_some();
    let windows = windows(resolved, &measured)?;
    let (reference, runs, spacings) = reference(&selection, &measured, &windows)?;
    let not_ranked = not_ranked(&reference, &spacings, asked.within);
    let at_reference: Vec<Option<ObservedRun>> = measured
        .iter()
        .map(|one| one.finished.as_ref().map(|run| run.observed.at_coordinates_of(&reference.observed)))
        .collect();
    let mut variants: Vec<VariantRecord> = measured.iter().map(|one| one.record.clone()).collect();
    runs.iter().for_each(|&index| variants[index].part_of_reference = true);
    add_errors(&mut variants, &at_reference, &reference, &windows);
    mark_fronts(&mut variants, &reference, &not_ranked);
    keep_shown_curves(&mut variants, &at_reference, &selection.settings, resolved);
    let compared = compared(&selection.settings, &at_reference, &variants);
    let mut recommendations = recommendations(&variants, asked.within);
    recommendations.retain(|one| not_ranked.iter().all(|not| not.quantity != one.quantity));
    Ok(AccuracyRecord {
        recommended_toml: recommended_toml(&recommendations, &selection.settings, resolved),
        calibration_json: made.map(Calibration::to_json),
        calibration_s,
        title: resolved.title().to_owned(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: resolved.scene_hash(),
        stopped: if is_complete { StopReason::Completed } else { StopReason::Interrupted },
        threads: rayon::current_num_threads(),
        within: asked.within,
        recommendations,
        not_ranked,
        comparisons: match resolved.scene.slices {
            Some(own) => sliced_comparison::comparisons(resolved, own, &compared),
            None => comparison::comparisons(resolved, &compared),
        },
        deep_runs,
        reference: reference_record(&selection, &measured, reference, runs, &windows),
        variants,
        left_out: selection.left_out,
        warnings: resolved.warnings.clone(),
        scene_toml: resolved.to_toml(),
        wall_s: start.elapsed().as_secs_f64(),
    })
}

/// Runs with a result, to be compared with each other.
fn compared<'a>(
    settings: &'a [Setting],
    at: &'a [Option<ObservedRun>],
    variants: &[VariantRecord],
) -> Vec<ComparedRun<'a>> {
    let all = settings.iter().zip(at).zip(variants);
    let runs = all.filter_map(|((setting, observed), variant)| {
        Some(ComparedRun { setting, observed: observed.as_ref()?, simulation_s: variant.simulation_s? })
    });
    runs.collect()
}

/// Removes limits that end a run early: wear is compared after the whole duration.
fn leave_out_stop(resolved: &mut Resolved) {
    if resolved.file.operation.stop.take().is_some() {
        resolved.scene.operation.stop = LifeLimits::default();
        let warning =
            "operation.stop is left out: all models run the whole duration, so that their wear can be compared";
        resolved.warnings.push(warning.to_owned());
    }
}

/// Runs the settings one after the other, up to an interrupt; `count` is the number of all runs, for the observer.
fn measure_all(
    settings: &[Setting],
    given: &LoadedScene,
    observer: &dyn Observer,
    count: usize,
) -> Vec<MeasuredSetting> {
    let runs = settings.iter().enumerate().map_while(|(number, setting)| {
        observer.run_of(number, count, &setting.name());
        measure(setting, given, &PartOf::new(observer, number, count))
    });
    runs.collect()
}

/// Keeps the curves of runs of the finest resolution on the scene's own slices; the reference's would show them once more.
fn keep_shown_curves(
    variants: &mut [VariantRecord],
    at_reference: &[Option<ObservedRun>],
    settings: &[Setting],
    resolved: &Resolved,
) {
    let finest = settings[0].coarsening;
    for ((variant, observed), setting) in variants.iter_mut().zip(at_reference).zip(settings) {
        let own_slices = setting.slices.map(|s| s.count) == resolved.scene.slices.map(|s| s.count);
        if setting.coarsening == finest && own_slices {
            variant.wear_um = observed.as_ref().map(|o| PerGear::from_fn(|gear| o.flanks[gear].wear_um.clone()));
            let over_width = observed.as_ref().and_then(|o| o.over_width.as_ref());
            variant.root_wear_um = over_width.map(|o| o.root_wear_um.clone());
        }
    }
}

/// Calibration that the runs read.
struct CalibrationOfRuns {
    made: Option<Calibration>,
    wall_s: Option<f64>,
    /// Reason where there is none.
    why_none: String,
}

/// The scene's own calibration, or one made now.
fn calibration(given: &LoadedScene, observer: &dyn Observer) -> Result<CalibrationOfRuns, AccuracyError> {
    if let Some(own) = &given.files.calibration {
        return Ok(CalibrationOfRuns { made: Some(own.clone()), wall_s: None, why_none: String::new() });
    }
    observer.stage("calibration");
    let watch = PartOf::new(observer, 0, usize::MAX);
    let (made, wall_s, why_none) =
        match calibrate::run(given.scene(), CalibrationExtent::FastModel, &given.teeth_in_space, &watch) {
            Ok(done) => (Some(done.calibration), Some(done.wall_s), String::new()),
            Err(CalibrateError::Interrupted) => return Err(AccuracyError::Interrupted),
            Err(error) => (None, None, format!("no calibration: {error}")),
        };
    Ok(CalibrationOfRuns { made, wall_s, why_none })
}

/// The scene of the recommended run of the wear profile, with errors estimated again.
fn recommended_toml(recommendations: &[Recommendation], settings: &[Setting], resolved: &Resolved) -> Option<String> {
    let chosen = recommendations.iter().find(|r| r.quantity == ComparedQuantity::WearProfile)?;
    let mut file = settings.get(chosen.variant)?.scene(resolved, Some(CALIBRATION_FILE)).ok()?.file;
    file.numerics.get_or_insert_default().error_estimate = Some(true);
    Some(file.to_toml())
}

/// Result of a run that the reference needs.
fn finished(measured: &[MeasuredSetting], index: usize) -> Result<&Finished, AccuracyError> {
    let one = measured.get(index).ok_or(AccuracyError::Interrupted)?;
    one.finished.as_ref().ok_or_else(|| AccuracyError::Reference {
        name: one.record.name.clone(),
        reason: one.record.failure.clone().unwrap_or_default(),
    })
}

fn windows(resolved: &Resolved, measured: &[MeasuredSetting]) -> Result<Windows, AccuracyError> {
    let summary = &finished(measured, 0)?.summary;
    let sharp = PerGear::from_fn(|gear| resolved.scene.pair.is_tip_sharp(gear));
    Ok(Windows::new(&summary.geometry.curvature_radius_mm, sharp, summary.contact.hertz_half_width_mm))
}

/// The reference, the indices of the runs it was made from, and what each of its corrections is for.
fn reference(
    selection: &Selection,
    measured: &[MeasuredSetting],
    windows: &Windows,
) -> Result<(Reference, Vec<usize>, Vec<RefinedSpacing>), AccuracyError> {
    let finest = &finished(measured, 0)?.observed;
    let (mut corrections, mut spacings) = (Vec::new(), Vec::new());
    let mut runs = vec![0];
    for &CompanionRuns { fine, coarse, spacing } in &selection.companions {
        let (fine_run, coarse_run) = (finished(measured, fine)?, finished(measured, coarse)?);
        let [fine_steps, coarse_steps] = [fine_run, coarse_run].map(|run| run.summary.work.wear_steps as f64);
        let (ratio, order) = match spacing {
            RefinedSpacing::Elements(ratio) | RefinedSpacing::Points(ratio) => (ratio, 2),
            RefinedSpacing::Slices(ratio) => (ratio, 1),
            RefinedSpacing::Step => (fine_steps / coarse_steps, 1),
        };
        runs.extend([fine, coarse]);
        if ratio >= LEAST_STEP_RATIO {
            corrections.push(Correction { fine: &fine_run.observed, coarse: &coarse_run.observed, ratio, order });
            spacings.push(spacing);
        }
    }
    runs.sort_unstable();
    runs.dedup();
    Ok((Reference::extrapolated(finest, &corrections, windows), runs, spacings))
}

/// Quantities of which `reference` is more uncertain than the error wanted.
fn not_ranked(reference: &Reference, spacings: &[RefinedSpacing], within: f64) -> Vec<NotRanked> {
    let uncertain = reference.uncertainty.iter().filter(|(_, uncertainty)| **uncertainty > within);
    let not_ranked = uncertain.map(|(&quantity, &uncertainty)| {
        let remedy = remedies(reference, spacings, quantity);
        NotRanked { quantity, uncertainty, remedy }
    });
    not_ranked.collect()
}

/// Remedies for the corrections that contribute most to the uncertainty of `quantity`, the greatest first.
fn remedies(reference: &Reference, spacings: &[RefinedSpacing], quantity: ComparedQuantity) -> String {
    let parts = reference.parts.iter().map(|part| part.get(&quantity).copied().unwrap_or(0.0));
    let mut parts: Vec<(f64, RefinedSpacing)> = parts.zip(spacings.iter().copied()).collect();
    parts.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let greatest = parts.first().map_or(0.0, |(part, _)| *part);
    // Reducing a part below a third of the greatest would not help.
    let remedies = parts.iter().filter(|(part, _)| *part > 0.0 && 3.0 * part >= greatest);
    remedies.map(|(_, spacing)| spacing.remedy()).collect::<Vec<_>>().join("; ")
}

/// Measures every run against the reference.
fn add_errors(variants: &mut [VariantRecord], at: &[Option<ObservedRun>], reference: &Reference, windows: &Windows) {
    for (variant, observed) in variants.iter_mut().zip(at) {
        let all = observed.as_ref().map(|observed| errors(observed, &reference.observed, windows));
        let measured = all.into_iter().flatten().filter(|(_, relative)| !relative.is_nan());
        let measured = measured.map(|(quantity, relative)| (quantity, MeasuredError { relative, on_front: false }));
        variant.errors.extend(measured);
    }
}

/// Marks the runs on the Pareto front of each ranked quantity.
fn mark_fronts(variants: &mut [VariantRecord], reference: &Reference, not_ranked: &[NotRanked]) {
    for quantity in ComparedQuantity::ALL.into_iter().filter(|&q| not_ranked.iter().all(|one| one.quantity != q)) {
        mark_front(variants, quantity, reference.uncertainty.get(&quantity).copied().unwrap_or(0.0));
    }
}

/// Marks the runs on the Pareto front of `quantity`.
fn mark_front(variants: &mut [VariantRecord], quantity: ComparedQuantity, uncertainty: f64) {
    let front = on_front(&points(variants, quantity), uncertainty);
    for (variant, on_front) in variants.iter_mut().zip(front) {
        variant.errors.entry(quantity).and_modify(|error| error.on_front = on_front);
    }
}

/// Run time and error of every run; not a number where it has none.
fn points(variants: &[VariantRecord], quantity: ComparedQuantity) -> Vec<FrontPoint> {
    let points = variants.iter().map(|variant| FrontPoint {
        wall_s: variant.simulation_s.unwrap_or(f64::NAN),
        error: variant.errors.get(&quantity).map_or(f64::NAN, |error| error.relative),
    });
    points.collect()
}

fn recommendations(variants: &[VariantRecord], within: f64) -> Vec<Recommendation> {
    let all = ComparedQuantity::ALL.into_iter().filter_map(|quantity| {
        let (variant, is_within) = cheapest_within(&points(variants, quantity), within)?;
        Some(Recommendation { quantity, variant, is_within })
    });
    all.collect()
}

fn reference_record(
    selection: &Selection,
    measured: &[MeasuredSetting],
    reference: Reference,
    runs: Vec<usize>,
    windows: &Windows,
) -> ReferenceRecord {
    let parts: Vec<String> = selection
        .companions
        .iter()
        .map(|companions| match companions.spacing {
            RefinedSpacing::Elements(ratio) => format!("size of elements, second order, ratio {ratio:.3}"),
            RefinedSpacing::Points(ratio) => {
                format!("spacing of flank points and positions, second order, ratio {ratio}")
            }
            RefinedSpacing::Slices(ratio) => format!("width of the slices, first order, ratio {ratio}"),
            RefinedSpacing::Step => "length of the wear step, first order".to_owned(),
        })
        .collect();
    let how = format!(
        "{}, extrapolated by Richardson's method in {}; the uncertainty stated is the size of the whole correction",
        measured[0].record.name,
        if parts.is_empty() { "nothing".to_owned() } else { parts.join("; ") }
    );
    let points = measured[0].finished.as_ref().map(|run| run.path_point_radius_mm);
    let Reference { observed, uncertainty, .. } = reference;
    ReferenceRecord {
        how,
        does_not_tell: observed.over_width.is_some().then(|| DOES_NOT_TELL.to_owned()),
        uncertainty,
        runs,
        peak_wear_um: PerGear::from_fn(|gear| observed.flanks[gear].peak_wear_um()),
        peak_pressure_mpa: peak_pressure_mpa(&observed.cycle, windows),
        transmission_error_peak_to_peak_um: [
            peak_to_peak(&observed.cycle.transmission_error_um),
            peak_to_peak(&observed.cycle.worn_transmission_error_um),
        ],
        flanks: PerGear::from_fn(|gear: Gear| ReferenceFlank {
            radius_mm: observed.flanks[gear].radius_mm.clone(),
            width_mm: observed.flanks[gear].width_mm.clone(),
            wear_um: observed.flanks[gear].wear_um.clone(),
            root_wear_um: observed.over_width.as_ref().map_or_else(Vec::new, |o| o.root_wear_um[gear].clone()),
            path_point_radius_mm: points.map(|points| points[gear]),
        }),
    }
}
