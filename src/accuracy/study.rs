//! The comparison itself: run every setting, build the reference, measure errors, recommend.

use std::time::Instant;

use super::comparison::{self, Run};
use super::front::{Point, cheapest_within, on_front};
use super::measure::{Windows, errors, greatest, peak_pressure_mpa, peak_to_peak};
use super::observed::Observed;
use super::reference::{Correction, Reference};
use super::selection::{Asked, Companions, Selection, Spacing};
use super::settings::Setting;
use crate::calibration::Calibration;
use crate::contact::settings::MatchCriterion;
use crate::gear::{Gear, PerGear};
use crate::pipeline::calibrate::{self, CalibrateError, Extent};
use crate::pipeline::{self, Done, RunError, inputs::Inputs};
use crate::plan::calibration::CalibrationStage;
use crate::plan::{Plan, StageKind};
use crate::scene::Resolved;
use crate::simulation::accuracy_record::{
    AccuracyRecord, CALIBRATION_FILE, MeasuredError, Quantity, Recommendation, ReferenceFlank, ReferenceRecord,
    VariantRecord,
};
use crate::simulation::record::{RunRecord, StopReason};
use crate::simulation::wear_run::Progress;

/// Runs shorter than this are repeated, and their least time counts.
const LONG_ENOUGH_S: f64 = 0.2;
/// Repeats at the most.
const MOST_REPEATS: u32 = 20;
/// Least ratio of the wear steps taken of which anything is learned.
const LEAST_STEP_RATIO: f64 = 1.2;

/// Told what is run; says whether to go on.
pub trait Observer: Progress {
    /// The calibration begins.
    fn calibration(&self);

    /// The run `number` of `count` begins.
    fn variant(&self, number: usize, count: usize, name: &str);
}

/// Why there is nothing to compare.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AccuracyError {
    /// A run of the reference failed.
    #[error("the reference, {name}: {reason}")]
    Reference {
        /// Which run.
        name: String,
        /// Why.
        reason: String,
    },
    /// The user interrupted before the reference was finished.
    #[error("interrupted before the reference was finished")]
    Interrupted,
}

/// What one setting came to.
struct Measured {
    record: VariantRecord,
    run: Option<(RunRecord, Observed)>,
}

/// Hears an interrupt and scales the progress of one run into that of all.
struct Within<'a> {
    observer: &'a dyn Observer,
    number: usize,
    count: usize,
}

impl Progress for Within<'_> {
    fn progress(&self, done: f64, total: f64) {
        self.observer.progress(self.number as f64 + done / total, self.count as f64);
    }

    fn interrupted(&self) -> bool {
        self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}

impl calibrate::Observer for Within<'_> {
    fn stage(&self, _stage: CalibrationStage) {}
}

impl pipeline::Observer for Within<'_> {
    fn stage(&self, _kind: StageKind) {}
}

/// Runs every setting that fits the scene and compares them.
///
/// A setting that fails is a row with its failure; an interrupt ends the comparison with what is finished by then.
///
/// # Errors
/// [`AccuracyError`] where the reference is not finished.
pub fn run(
    resolved: &Resolved,
    inputs: &Inputs,
    asked: Asked,
    observer: &dyn Observer,
) -> Result<AccuracyRecord, AccuracyError> {
    let start = Instant::now();
    let calibration = calibration(resolved, inputs, observer)?;
    let inputs = &Inputs { calibration: calibration.made, ..inputs.clone() };
    let calibrated: Vec<MatchCriterion> =
        inputs.calibration.as_ref().map_or_else(Vec::new, |made| made.foundation.keys().copied().collect());
    let selection = Selection::new(resolved, asked, &calibrated, &calibration.why_none);
    let count = selection.settings.len();
    let mut measured: Vec<Measured> = Vec::with_capacity(count);
    for (number, setting) in selection.settings.iter().enumerate() {
        observer.variant(number, count, &setting.name());
        match measure(setting, resolved, inputs, &Within { observer, number, count }) {
            Some(one) => measured.push(one),
            None => break,
        }
    }
    let stopped = if measured.len() == count { StopReason::Completed } else { StopReason::Interrupted };
    let windows = windows(resolved, &measured)?;
    let (reference, runs) = reference(&selection, &measured, &windows)?;
    let at_reference: Vec<Option<Observed>> = measured
        .iter()
        .map(|one| one.run.as_ref().map(|(_, observed)| observed.at_coordinates_of(&reference.observed)))
        .collect();
    let mut variants: Vec<VariantRecord> = measured.iter().map(|one| one.record.clone()).collect();
    for &index in &runs {
        variants[index].part_of_reference = true;
    }
    add_errors(&mut variants, &at_reference, &reference, &windows);
    let finest = selection.settings[0].coarsening;
    for ((variant, observed), setting) in variants.iter_mut().zip(&at_reference).zip(&selection.settings) {
        if setting.coarsening == finest {
            variant.wear_um = observed.as_ref().map(|o| PerGear::from_fn(|gear| o.flanks[gear].wear_um.clone()));
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
    let recommendations = recommendations(&variants, asked.within);
    Ok(AccuracyRecord {
        recommended_toml: recommended_toml(&recommendations, &selection.settings, resolved),
        calibration_json: inputs.calibration.as_ref().map(Calibration::to_json),
        calibration_s: calibration.wall_s,
        title: resolved.scene.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: resolved.scene_hash(),
        stopped,
        threads: rayon::current_num_threads(),
        within: asked.within,
        recommendations,
        comparisons: comparison::comparisons(resolved, &compared),
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
fn calibration(resolved: &Resolved, inputs: &Inputs, observer: &dyn Observer) -> Result<Calibrated, AccuracyError> {
    if let Some(given) = &inputs.calibration {
        return Ok(Calibrated { made: Some(given.clone()), wall_s: None, why_none: String::new() });
    }
    observer.calibration();
    match calibrate::run(&resolved.scene, Extent::FastModel, &Within { observer, number: 0, count: usize::MAX }) {
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

/// Runs one setting, a short one several times; `None` where the user interrupted it.
fn measure(setting: &Setting, base: &Resolved, inputs: &Inputs, observer: &Within<'_>) -> Option<Measured> {
    if observer.interrupted() {
        return None;
    }
    let mut record = VariantRecord {
        name: setting.name(),
        settings: setting.record(&base.scene),
        simulation_s: None,
        setup_s: None,
        repeats: 0,
        work: None,
        peak_wear_um: None,
        errors: Default::default(),
        failure: None,
        part_of_reference: false,
        wear_um: None,
    };
    let failed = |record: VariantRecord, failure: String| {
        Some(Measured { record: VariantRecord { failure: Some(failure), ..record }, run: None })
    };
    let resolved = match setting.scene(base, Some(CALIBRATION_FILE)) {
        Ok(resolved) => resolved,
        Err(problems) => {
            let all: Vec<String> = problems.iter().map(ToString::to_string).collect();
            return failed(record, all.join("; "));
        }
    };
    record.settings = setting.record(&resolved.scene);
    let plan = Plan::of(&resolved.scene);
    let mut kept = None;
    let mut spent_s = 0.0;
    while record.repeats == 0 || (spent_s < LONG_ENOUGH_S && record.repeats < MOST_REPEATS) {
        let done = match pipeline::run(&resolved, &plan, inputs, observer) {
            Ok(Done { record: done, failure: None }) if done.summary.stopped == StopReason::Completed => done,
            Ok(Done { failure: Some(failure), .. }) => return failed(record, failure.to_string()),
            Ok(_) => return None,
            Err(_) if observer.interrupted() => return None,
            Err(failure) => return failed(record, RunError::to_string(&failure)),
        };
        let (simulation_s, setup_s) = times(&done);
        record.repeats += 1;
        spent_s += simulation_s;
        record.simulation_s = Some(record.simulation_s.map_or(simulation_s, |least: f64| least.min(simulation_s)));
        record.setup_s = Some(record.setup_s.map_or(setup_s, |least: f64| least.min(setup_s)));
        kept = Some(done);
    }
    let run = kept?;
    record.work = Some(run.summary.work);
    record.peak_wear_um =
        Some(PerGear { pinion: run.summary.pinion.peak_wear_um, wheel: run.summary.wheel.peak_wear_um });
    let observed = Observed::of(&run);
    Some(Measured { record, run: Some((run, observed)) })
}

/// Wall times of the wear run and of everything before it, s.
fn times(run: &RunRecord) -> (f64, f64) {
    let simulation = StageKind::Simulation.name();
    run.summary.stages.iter().fold((0.0, 0.0), |(simulation_s, setup_s), stage| {
        if stage.name == simulation {
            (simulation_s + stage.wall_s, setup_s)
        } else {
            (simulation_s, setup_s + stage.wall_s)
        }
    })
}

/// A run of the reference, which must be there.
fn finished(measured: &[Measured], index: usize) -> Result<&(RunRecord, Observed), AccuracyError> {
    let one = measured.get(index).ok_or(AccuracyError::Interrupted)?;
    one.run.as_ref().ok_or_else(|| AccuracyError::Reference {
        name: one.record.name.clone(),
        reason: one.record.failure.clone().unwrap_or_default(),
    })
}

fn windows(resolved: &Resolved, measured: &[Measured]) -> Result<Windows, AccuracyError> {
    let summary = &finished(measured, 0)?.0.summary;
    let sharp = PerGear::from_fn(|gear| resolved.scene.pair.gears[gear].modification.tip_rounding_mm == 0.0);
    Ok(Windows::new(&summary.geometry.curvature_radius_mm, sharp, summary.contact.hertz_half_width_mm))
}

/// The reference, and the indices of the runs it was made from.
fn reference(
    selection: &Selection,
    measured: &[Measured],
    windows: &Windows,
) -> Result<(Reference, Vec<usize>), AccuracyError> {
    let finest = &finished(measured, 0)?.1;
    let mut corrections = Vec::new();
    let mut runs = vec![0];
    for &Companions { fine, coarse, spacing } in &selection.companions {
        let ((fine_run, fine_observed), (coarse_run, coarse_observed)) =
            (finished(measured, fine)?, finished(measured, coarse)?);
        let steps = |run: &RunRecord| run.summary.work.wear_steps as f64;
        let (ratio, order) = match spacing {
            Spacing::Elements(ratio) | Spacing::Points(ratio) => (ratio, 2),
            Spacing::Step => (steps(fine_run) / steps(coarse_run), 1),
        };
        runs.extend([fine, coarse]);
        if ratio >= LEAST_STEP_RATIO {
            corrections.push(Correction { fine: fine_observed, coarse: coarse_observed, ratio, order });
        }
    }
    runs.sort_unstable();
    runs.dedup();
    Ok((Reference::extrapolated(finest, &corrections, windows), runs))
}

/// Measures every run against the reference, and marks the fronts.
fn add_errors(variants: &mut [VariantRecord], at: &[Option<Observed>], reference: &Reference, windows: &Windows) {
    let all: Vec<_> =
        at.iter().map(|observed| observed.as_ref().map(|o| errors(o, &reference.observed, windows))).collect();
    for quantity in Quantity::ALL {
        let points: Vec<Point> = variants
            .iter()
            .zip(&all)
            .map(|(variant, errors)| Point {
                wall_s: variant.simulation_s.unwrap_or(f64::NAN),
                error: errors.as_ref().map_or(f64::NAN, |errors| errors[&quantity]),
            })
            .collect();
        let front = on_front(&points, reference.uncertainty[&quantity]);
        for ((variant, point), on_front) in variants.iter_mut().zip(points).zip(front) {
            if !point.error.is_nan() {
                variant.errors.insert(quantity, MeasuredError { relative: point.error, on_front });
            }
        }
    }
}

fn recommendations(variants: &[VariantRecord], within: f64) -> Vec<Recommendation> {
    Quantity::ALL
        .into_iter()
        .filter_map(|quantity| {
            let points: Vec<Point> = variants
                .iter()
                .map(|variant| Point {
                    wall_s: variant.simulation_s.unwrap_or(f64::NAN),
                    error: variant.errors.get(&quantity).map_or(f64::NAN, |error| error.relative),
                })
                .collect();
            let (variant, is_within) = cheapest_within(&points, within)?;
            Some(Recommendation { quantity, variant, is_within })
        })
        .collect()
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
            Spacing::Step => "length of the wear step, first order".to_owned(),
        })
        .collect();
    let how = format!(
        "{}, extrapolated by Richardson's method in {}; the uncertainty stated is the size of the whole correction",
        measured[0].record.name,
        if parts.is_empty() { "nothing".to_owned() } else { parts.join("; ") }
    );
    let points =
        PerGear::from_fn(|gear| measured[0].run.as_ref().map(|(record, _)| record.flanks[gear].path_point_radius_mm));
    let Reference { observed, uncertainty } = reference;
    ReferenceRecord {
        how,
        uncertainty,
        runs,
        peak_wear_um: PerGear::from_fn(|gear| greatest(&observed.flanks[gear].wear_um)),
        peak_pressure_mpa: peak_pressure_mpa(&observed.cycle, windows),
        transmission_error_peak_to_peak_um: [
            peak_to_peak(&observed.cycle.transmission_error_um),
            peak_to_peak(&observed.cycle.worn_transmission_error_um),
        ],
        flanks: PerGear::from_fn(|gear: Gear| ReferenceFlank {
            radius_mm: observed.flanks[gear].radius_mm.clone(),
            wear_um: observed.flanks[gear].wear_um.clone(),
            path_point_radius_mm: points[gear],
        }),
    }
}
