//! The comparison itself: run every setting, build the reference, measure errors, recommend.

use std::time::Instant;

use super::comparison::{self, Run};
use super::deep_runs;
use super::front::{Point, cheapest_within, on_front};
use super::measure::{Windows, errors, peak_pressure_mpa, peak_to_peak};
use super::observed::Observed;
use super::reference::{Correction, Reference};
use super::selection::{Asked, Companions, Selection, Spacing};
use super::settings::Setting;
use super::sliced_comparison;
use super::timed_run::{Finished, Measured, measure};
use crate::assessment::calibrate::{self, CalibrateError, CalibrationExtent};
use crate::calibration::Calibration;
use crate::contact::settings::MatchCriterion;
use crate::gear::{Gear, PerGear};
use crate::observer::{Observer, PartOf};
use crate::results::run::StopReason;
use crate::scene::Resolved;
use crate::scene::loaded::LoadedScene;
use crate::simulation::settings::LifeLimits;
use crate::studies::accuracy::record::{
    AccuracyRecord, CALIBRATION_FILE, MeasuredError, NotRanked, Quantity, Recommendation, ReferenceFlank,
    ReferenceRecord, VariantRecord,
};

/// Least ratio of the wear steps taken of which anything is learned.
const LEAST_STEP_RATIO: f64 = 1.2;
/// What a reference on half-planes leaves open.
const DOES_NOT_TELL: &str = "The teeth of the reference are three-dimensional finite elements, or plates where these cannot be had; contact \
                             itself is plane in every slice, on half-planes. The errors are those of the contact surface, of the coupling of \
                             slices and of the resolution; what half-planes themselves leave out at tip edges and end faces they do not tell.";

/// Why there is nothing to compare.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum AccuracyError {
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
pub(crate) fn run(given: &LoadedScene, asked: Asked, observer: &dyn Observer) -> Result<AccuracyRecord, AccuracyError> {
    let start = Instant::now();
    let calibration = calibration(given, observer)?;
    let mut given = calibration.made.map_or_else(|| given.clone(), |made| given.calibrated(made));
    if given.resolved.file.operation.stop.take().is_some() {
        given.resolved.scene.operation.stop = LifeLimits::default();
        let warning =
            "operation.stop is left out: all models run the whole duration, so that their wear can be compared";
        given.resolved.warnings.push(warning.to_owned());
    }
    let given = &given;
    let (resolved, made) = (&given.resolved, given.files.calibration.as_ref());
    let calibrated: Vec<MatchCriterion> = made.map_or_else(Vec::new, |made| made.foundation.keys().copied().collect());
    let selection = Selection::new(resolved, asked, &calibrated, &calibration.why_none);
    let settings = selection.settings.len();
    let count = settings + if resolved.scene.slices.is_some() { deep_runs::RUNS } else { 0 };
    let mut measured: Vec<Measured> = Vec::with_capacity(settings);
    for (number, setting) in selection.settings.iter().enumerate() {
        observer.run_of(number, count, &setting.name());
        match measure(setting, given, &PartOf::new(observer, number, count)) {
            Some(one) => measured.push(one),
            None => break,
        }
    }
    let all_measured = measured.len() == settings;
    let deep = || deep_runs::run(given, &selection.second_resolution(), observer, settings, count);
    let deep_runs = all_measured.then(deep).flatten();
    let is_complete = all_measured && deep_runs.is_some() == resolved.scene.slices.is_some();
    let stopped = if is_complete { StopReason::Completed } else { StopReason::Interrupted };
    let windows = windows(resolved, &measured)?;
    let (reference, runs, spacings) = reference(&selection, &measured, &windows)?;
    let not_ranked = not_ranked(&reference, &spacings, asked.within);
    let at_reference: Vec<Option<Observed>> = measured
        .iter()
        .map(|one| one.finished.as_ref().map(|run| run.observed.at_coordinates_of(&reference.observed)))
        .collect();
    let mut variants: Vec<VariantRecord> = measured.iter().map(|one| one.record.clone()).collect();
    for &index in &runs {
        variants[index].part_of_reference = true;
    }
    add_errors(&mut variants, &at_reference, &reference, &windows);
    for quantity in Quantity::ALL.into_iter().filter(|&q| not_ranked.iter().all(|one| one.quantity != q)) {
        mark_front(&mut variants, quantity, reference.uncertainty.get(&quantity).copied().unwrap_or(0.0));
    }
    let finest = selection.settings[0].coarsening;
    for ((variant, observed), setting) in variants.iter_mut().zip(&at_reference).zip(&selection.settings) {
        // The reference's own slices would show the same curves once more.
        let own_slices = setting.slices.map(|s| s.count) == resolved.scene.slices.map(|s| s.count);
        if setting.coarsening == finest && own_slices {
            variant.wear_um = observed.as_ref().map(|o| PerGear::from_fn(|gear| o.flanks[gear].wear_um.clone()));
            let over_width = observed.as_ref().and_then(|o| o.over_width.as_ref());
            variant.root_wear_um = over_width.map(|o| o.root_wear_um.clone());
        }
    }
    let compared: Vec<Run<'_>> = selection
        .settings
        .iter()
        .zip(&at_reference)
        .zip(&variants)
        .filter_map(|((setting, observed), variant)| {
            Some(Run { setting, observed: observed.as_ref()?, simulation_s: variant.simulation_s? })
        })
        .collect();
    let mut recommendations = recommendations(&variants, asked.within);
    recommendations.retain(|one| not_ranked.iter().all(|not| not.quantity != one.quantity));
    Ok(AccuracyRecord {
        recommended_toml: recommended_toml(&recommendations, &selection.settings, resolved),
        calibration_json: made.map(Calibration::to_json),
        calibration_s: calibration.wall_s,
        title: resolved.title().to_owned(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: resolved.scene_hash(),
        stopped,
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

/// The calibration that the runs read.
struct Calibrated {
    made: Option<Calibration>,
    wall_s: Option<f64>,
    /// Why there is none.
    why_none: String,
}

/// The scene's own, or one made now.
fn calibration(given: &LoadedScene, observer: &dyn Observer) -> Result<Calibrated, AccuracyError> {
    if let Some(own) = &given.files.calibration {
        return Ok(Calibrated { made: Some(own.clone()), wall_s: None, why_none: String::new() });
    }
    observer.stage("calibration");
    match calibrate::run(
        given.scene(),
        CalibrationExtent::FastModel,
        &given.teeth_in_space,
        &PartOf::new(observer, 0, usize::MAX),
    ) {
        Ok(done) => Ok(Calibrated { made: Some(done.calibration), wall_s: Some(done.wall_s), why_none: String::new() }),
        Err(CalibrateError::Interrupted) => Err(AccuracyError::Interrupted),
        Err(error) => Ok(Calibrated { made: None, wall_s: None, why_none: format!("no calibration: {error}") }),
    }
}

/// The scene of the recommended run of the wear profile, with errors estimated again.
fn recommended_toml(recommendations: &[Recommendation], settings: &[Setting], resolved: &Resolved) -> Option<String> {
    let chosen = recommendations.iter().find(|r| r.quantity == Quantity::WearProfile)?;
    let mut file = settings.get(chosen.variant)?.scene(resolved, Some(CALIBRATION_FILE)).ok()?.file;
    file.numerics.get_or_insert_default().error_estimate = Some(true);
    Some(file.to_toml())
}

/// A run of the reference, which must be there.
fn finished(measured: &[Measured], index: usize) -> Result<&Finished, AccuracyError> {
    let one = measured.get(index).ok_or(AccuracyError::Interrupted)?;
    one.finished.as_ref().ok_or_else(|| AccuracyError::Reference {
        name: one.record.name.clone(),
        reason: one.record.failure.clone().unwrap_or_default(),
    })
}

fn windows(resolved: &Resolved, measured: &[Measured]) -> Result<Windows, AccuracyError> {
    let summary = &finished(measured, 0)?.summary;
    let sharp = PerGear::from_fn(|gear| resolved.scene.pair.is_tip_sharp(gear));
    Ok(Windows::new(&summary.geometry.curvature_radius_mm, sharp, summary.contact.hertz_half_width_mm))
}

/// The reference, the indices of the runs it was made from, and what each of its corrections is for.
fn reference(
    selection: &Selection,
    measured: &[Measured],
    windows: &Windows,
) -> Result<(Reference, Vec<usize>, Vec<Spacing>), AccuracyError> {
    let finest = &finished(measured, 0)?.observed;
    let (mut corrections, mut spacings) = (Vec::new(), Vec::new());
    let mut runs = vec![0];
    for &Companions { fine, coarse, spacing } in &selection.companions {
        let (fine_run, coarse_run) = (finished(measured, fine)?, finished(measured, coarse)?);
        let steps = |run: &Finished| run.summary.work.wear_steps as f64;
        let (ratio, order) = match spacing {
            Spacing::Elements(ratio) | Spacing::Points(ratio) => (ratio, 2),
            Spacing::Slices(ratio) => (ratio, 1),
            Spacing::Step => (steps(fine_run) / steps(coarse_run), 1),
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

/// The quantities of which `reference` is more uncertain than the error wanted.
fn not_ranked(reference: &Reference, spacings: &[Spacing], within: f64) -> Vec<NotRanked> {
    let of = |(&quantity, &uncertainty): (&Quantity, &f64)| {
        if uncertainty <= within {
            return None;
        }
        let part = |index: usize| reference.parts[index].get(&quantity).copied().unwrap_or(0.0);
        let mut by: Vec<usize> = (0..spacings.len()).collect();
        by.sort_by(|&a, &b| part(b).total_cmp(&part(a)));
        let greatest = by.first().map_or(0.0, |&index| part(index));
        // What is less than a third of the greatest part would not help.
        by.retain(|&index| part(index) > 0.0 && 3.0 * part(index) >= greatest);
        let remedies: Vec<&str> = by.iter().map(|&index| spacings[index].remedy()).collect();
        Some(NotRanked { quantity, uncertainty, remedy: remedies.join("; ") })
    };
    reference.uncertainty.iter().filter_map(of).collect()
}

/// Measures every run against the reference.
fn add_errors(variants: &mut [VariantRecord], at: &[Option<Observed>], reference: &Reference, windows: &Windows) {
    for (variant, observed) in variants.iter_mut().zip(at) {
        let all = observed.as_ref().map(|observed| errors(observed, &reference.observed, windows));
        let measured = all.into_iter().flatten().filter(|(_, relative)| !relative.is_nan());
        let measured = measured.map(|(quantity, relative)| (quantity, MeasuredError { relative, on_front: false }));
        variant.errors.extend(measured);
    }
}

/// Marks the runs on the Pareto front of `quantity`.
fn mark_front(variants: &mut [VariantRecord], quantity: Quantity, uncertainty: f64) {
    let front = on_front(&points(variants, quantity), uncertainty);
    for (variant, on_front) in variants.iter_mut().zip(front) {
        variant.errors.entry(quantity).and_modify(|error| error.on_front = on_front);
    }
}

/// Run time and error of every run; not a number where it has none.
fn points(variants: &[VariantRecord], quantity: Quantity) -> Vec<Point> {
    let point = |variant: &VariantRecord| Point {
        wall_s: variant.simulation_s.unwrap_or(f64::NAN),
        error: variant.errors.get(&quantity).map_or(f64::NAN, |error| error.relative),
    };
    variants.iter().map(point).collect()
}

fn recommendations(variants: &[VariantRecord], within: f64) -> Vec<Recommendation> {
    let of = |quantity| {
        let (variant, is_within) = cheapest_within(&points(variants, quantity), within)?;
        Some(Recommendation { quantity, variant, is_within })
    };
    Quantity::ALL.into_iter().filter_map(of).collect()
}

fn reference_record(
    selection: &Selection,
    measured: &[Measured],
    reference: Reference,
    runs: Vec<usize>,
    windows: &Windows,
) -> ReferenceRecord {
    let parts: Vec<String> = selection
        .companions
        .iter()
        .map(|companions| match companions.spacing {
            Spacing::Elements(ratio) => format!("size of elements, second order, ratio {ratio:.3}"),
            Spacing::Points(ratio) => format!("spacing of flank points and positions, second order, ratio {ratio}"),
            Spacing::Slices(ratio) => format!("width of the slices, first order, ratio {ratio}"),
            Spacing::Step => "length of the wear step, first order".to_owned(),
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
