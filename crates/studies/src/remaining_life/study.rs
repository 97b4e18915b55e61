//! Wear coefficient and remaining life of each gear, after each measurement.

use super::asked::LifeError;
use super::limit::WearLimit;
use super::measurement::{ToothValues, WearMeasurement, relative_sigmas};
use super::other_gear::{CoefficientSource, OtherGear};
use super::record::{
    BandPoint, GearLife, Interval, LifeRecord, LifeUpdate, MeasurementRecord, Prediction, RemainingLife,
};
use super::regime::CoefficientPrior;
use super::wear_curve::{SimulatedWear, WearCurve, WearNeeded, WearQuantity, simulated_wear};
use super::wear_process::{ExposureMeasurement, FactorPrior, Posterior};
use super::wear_table::WearKind;
use crate::compare::question::is_of_both;
use crate::compare::record::ProfileRecord;
use crate::compare::run_folder::RunFolder;
use crate::compare::study::CompareError;
use crate::measurement::fit::FitStop;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::reference::statistics::HALF_WIDTH_95;
use gearwear_physics::observer::Observer;
use rayon::prelude::*;

/// mm²/N to m²/N.
const M2_PER_MM2: f64 = 1e-6;
/// Probability below, or above, which a measurement was not to be expected.
const UNEXPECTED: f64 = 0.0025;
/// Logarithm of the ratio of the gears' coefficients, beside that of the run, from which the run is made again with it.
const SAME_RATIO: f64 = 0.1;
/// Points of a band.
const BAND_POINTS: usize = 60;

/// Measurements with limits, checked against the run.
#[derive(Debug)]
pub struct LifeQuestion {
    /// Name of the table.
    pub measured: String,
    /// By gear and time.
    pub measurements: Vec<WearMeasurement>,
    pub limits: Vec<WearLimit>,
    pub prior: Option<CoefficientPrior>,
    /// Whether the coefficient of the gear without measurements was given.
    pub has_other_k: bool,
}

/// A measurement with the values of its teeth; of profiles exposures in revolutions.
struct Valued<'a> {
    of: &'a WearMeasurement,
    values: ToothValues,
    warnings: Vec<String>,
}

/// All that one gear's evaluation needs.
struct GearCase<'a> {
    gear: Gear,
    /// m²/N.
    coefficient_of_run: f64,
    /// Of the run, in revolutions of the pinion.
    duration: f64,
    pinion_speed_rpm: Option<f64>,
    prior: CoefficientPrior,
    curve: &'a WearCurve,
    valued: Vec<&'a Valued<'a>>,
    limit: Option<(WearLimit, f64)>,
}

/// Evaluates the measurements of `question` with the run in `folder`, whose scene is `given`.
///
/// # Errors
/// Runs that fail, a profile that gives no coefficient.
pub fn run(
    question: &LifeQuestion,
    folder: &RunFolder,
    given: &LoadedScene,
    pair: &GearPair,
    observer: &dyn Observer,
) -> Result<LifeRecord, LifeError> {
    let valued: Vec<Valued<'_>> =
        question.measurements.iter().map(|of| valued(of, observer)).collect::<Result<_, _>>()?;
    let needed = needed(question, &valued, folder, given);
    let exposure = valued.iter().filter(|of| of.of.kind == WearKind::Profile).map(|of| of.values.mean());
    let exposure = exposure.fold(0.0, f64::max);
    let mut simulated = simulated_wear(given, pair, 1.0, &needed, exposure, observer)?;
    let mut gears = evaluated(question, given, &simulated, &valued);
    let ratio = coefficient_ratio(&gears, question, given);
    if ratio.ln().abs() > SAME_RATIO {
        let again = simulated_wear(given, pair, ratio, &needed, exposure, observer)?;
        simulated = SimulatedWear {
            runs: simulated.runs + again.runs,
            mesh_cycles: simulated.mesh_cycles + again.mesh_cycles,
            ..again
        };
        gears = evaluated(question, given, &simulated, &valued);
    }
    let of_profiles = valued.iter().flat_map(|of| of.warnings.iter().cloned());
    let warnings =
        folder.version_warning().into_iter().chain(of_profiles).chain(gears.iter().flat_map(warnings)).collect();
    Ok(LifeRecord {
        title: folder.summary.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: given.resolved.scene_hash(),
        measured: question.measured.clone(),
        other_gear: other_gear(&gears, question, given),
        gears,
        runs: simulated.runs,
        mesh_cycles: simulated.mesh_cycles,
        warnings,
        scene_toml: given.resolved.to_toml(),
    })
}

/// Values of a measurement; of profiles what their comparisons with the run find.
fn valued<'a>(of: &'a WearMeasurement, observer: &dyn Observer) -> Result<Valued<'a>, LifeError> {
    if of.kind != WearKind::Profile {
        let sigmas = of.values.iter().zip(&of.sigmas).map(|(value, sigma)| sigma.unwrap_or(0.0) / value);
        let values = ToothValues { values: of.values.clone(), relative_sigmas: sigmas.collect() };
        return Ok(Valued { of, values, warnings: Vec::new() });
    }
    let mut values = ToothValues { values: Vec::new(), relative_sigmas: Vec::new() };
    let mut warnings = Vec::new();
    for profile in &of.profiles {
        let refused = |why: String| LifeError::Profile { file: profile.file.clone(), why };
        let record = profile.comparison.carry_out(observer).map_err(|error| match error {
            CompareError::Interrupted => LifeError::Curve(CompareError::Interrupted.into()),
            CompareError::Run(error) => refused(error.to_string()),
        })?;
        if let Some(slope) = record.profiles.first().and_then(ProfileRecord::other_slope) {
            let file = &profile.file;
            warnings
                .push(format!("{file}: f_Hα before wear is {slope}: gearwear compare RUN {file} says what that moves"));
        }
        let factor = record.fit.coefficients.first().map(|own| own.factor);
        let factor = factor.filter(|_| record.fit.stopped == FitStop::Converged);
        let factor = factor.ok_or_else(|| refused(record.warnings.join("; ")))?;
        let (Some(low), Some(high)) = (factor.low, factor.high) else { return Err(refused(record.fit.how.clone())) };
        values.values.push(factor.value * of.revolutions);
        values.relative_sigmas.push(0.5 * (high / low).ln() / HALF_WIDTH_95);
    }
    Ok(Valued { of, values, warnings })
}

/// Wear that the run has to come to, and that of the scene's own run, had it gone on for its whole duration.
fn needed(
    question: &LifeQuestion,
    valued: &[Valued<'_>],
    folder: &RunFolder,
    given: &LoadedScene,
) -> Vec<(WearNeeded, f64)> {
    let of_limits = question.limits.iter().map(|limit| (limit.gear, limit.quantity, limit.value));
    let of_values = valued.iter().filter_map(|of| {
        Some((of.of.gear, WearQuantity::of_kind(of.of.kind)?, of.values.values.iter().copied().fold(0.0, f64::max)))
    });
    let duration = given.resolved.scene.operation.pinion_revolutions;
    let needed = of_limits.chain(of_values).map(|(gear, quantity, value)| {
        let of_run = folder.number(&format!("{}.{}", gear.name(), quantity.figure())).unwrap_or(0.0);
        (WearNeeded { gear, quantity, value }, of_run * duration / folder.summary.revolutions)
    });
    needed.collect()
}

/// Each measured gear, evaluated.
fn evaluated(
    question: &LifeQuestion,
    given: &LoadedScene,
    simulated: &SimulatedWear,
    valued: &[Valued<'_>],
) -> Vec<GearLife> {
    let scene = &given.resolved.scene;
    let phase = &scene.operation.phases[0];
    let gears = Gear::BOTH.into_iter().filter_map(|gear| {
        let valued: Vec<&Valued<'_>> = valued.iter().filter(|of| of.of.gear == gear).collect();
        let coefficient_of_run = M2_PER_MM2 * scene.wear_in(phase)[gear].coefficient_mm2_per_n;
        let curve = &simulated.curves[gear];
        let limits = question.limits.iter().filter(|limit| limit.gear == gear);
        let limits = limits.filter_map(|limit| Some((limit.clone(), curve.exposure_of(limit.quantity, limit.value)?)));
        let case = GearCase {
            gear,
            coefficient_of_run,
            duration: scene.operation.pinion_revolutions,
            pinion_speed_rpm: phase.pinion_speed_rpm,
            prior: question.prior.clone().unwrap_or_else(|| CoefficientPrior::about_run(coefficient_of_run)),
            curve,
            limit: limits.min_by(|(_, a), (_, b)| a.total_cmp(b)),
            valued,
        };
        (!case.valued.is_empty()).then(|| case.evaluated())
    });
    gears.collect()
}

/// Coefficient of the wheel over that of the pinion, both over those of the run; a gear that was not measured keeps its own, unless both wear by one
/// law.
fn coefficient_ratio(gears: &[GearLife], question: &LifeQuestion, given: &LoadedScene) -> f64 {
    let factor = |gear: Gear| {
        let of = gears.iter().find(|of| of.gear == gear)?;
        Some(of.updates.last()?.coefficient_m2_per_N.median / of.coefficient_of_run_m2_per_N)
    };
    let factors = PerGear::from_fn(factor);
    match (factors.pinion, factors.wheel) {
        (Some(pinion), Some(wheel)) => wheel / pinion,
        _ if is_of_both(&given.resolved.scene) && !question.has_other_k => 1.0,
        (pinion, wheel) => wheel.unwrap_or(1.0) / pinion.unwrap_or(1.0),
    }
}

/// The gear that was not measured, with the coefficient that the last evaluation has of it.
fn other_gear(gears: &[GearLife], question: &LifeQuestion, given: &LoadedScene) -> Option<OtherGear> {
    let [one] = gears else { return None };
    let gear = one.gear.mate();
    let scene = &given.resolved.scene;
    let of_scene = M2_PER_MM2 * scene.wear_in(&scene.operation.phases[0])[gear].coefficient_mm2_per_n;
    let (coefficient, source) = match (question.has_other_k, is_of_both(scene)) {
        (true, _) => (of_scene, CoefficientSource::Given),
        (false, true) => (one.updates.last()?.coefficient_m2_per_N.median, CoefficientSource::MeasuredGear),
        (false, false) => (of_scene, CoefficientSource::Run),
    };
    Some(OtherGear { gear, coefficient_m2_per_N: coefficient, source })
}

impl GearCase<'_> {
    fn evaluated(&self) -> GearLife {
        let factor_prior = self.prior.of_factor(self.coefficient_of_run);
        let counts: Vec<usize> = (0..=self.valued.len()).collect();
        let updates = counts.into_par_iter().map(|count| self.update(factor_prior, count)).collect();
        let first = WearQuantity::of_kind(self.valued[0].of.kind).unwrap_or(WearQuantity::PeakDepth);
        let shown = self.limit.as_ref().map_or(first, |(limit, _)| limit.quantity);
        let sigmas = self.relative_sigmas(self.valued.len());
        let measurements =
            self.valued.iter().zip(sigmas).map(|(of, sigma)| self.measurement(of, sigma, shown)).collect();
        let posterior = Posterior::new(factor_prior, &self.exposures(self.valued.len()));
        GearLife {
            gear: self.gear,
            coefficient_of_run_m2_per_N: self.coefficient_of_run,
            prior: self.prior.clone(),
            limit: self.limit.as_ref().map(|(limit, _)| limit.clone()),
            measurements,
            updates,
            shown,
            band: self.band(&posterior, shown),
            simulated: self.simulated(&posterior, shown),
        }
    }

    /// Exposure of a measurement, in revolutions.
    fn exposure(&self, of: &Valued<'_>) -> f64 {
        match WearQuantity::of_kind(of.of.kind) {
            Some(quantity) => self.curve.exposure_of(quantity, of.values.mean()).unwrap_or(self.curve.end()),
            None => of.values.mean(),
        }
    }

    /// Known relative standard deviations of the values of the first `count` measurements, as they alone tell them.
    fn relative_sigmas(&self, count: usize) -> Vec<f64> {
        let values: Vec<ToothValues> = self.valued[..count].iter().map(|of| of.values.clone()).collect();
        relative_sigmas(&values)
    }

    /// Exposures of the first `count` measurements.
    fn exposures(&self, count: usize) -> Vec<ExposureMeasurement> {
        let all = self.valued.iter().zip(self.relative_sigmas(count));
        all.map(|(of, sigma)| self.measured_exposure(of, sigma)).collect()
    }

    fn measured_exposure(&self, of: &Valued<'_>, sigma: f64) -> ExposureMeasurement {
        let exposure = self.exposure(of);
        let elasticity =
            WearQuantity::of_kind(of.of.kind).map_or(1.0, |quantity| self.curve.elasticity(quantity, exposure));
        ExposureMeasurement {
            revolutions: of.of.revolutions / self.duration,
            exposure: exposure / self.duration,
            relative_sigma: elasticity * sigma,
        }
    }

    fn update(&self, prior: FactorPrior, count: usize) -> LifeUpdate {
        let posterior = Posterior::new(prior, &self.exposures(count));
        let at = |probability: f64| self.coefficient_of_run * posterior.factor_quantile(probability);
        let [wander, scatter] = posterior.scatter_medians();
        let revolutions = count.checked_sub(1).map_or(0.0, |last| self.valued[last].of.revolutions);
        LifeUpdate {
            measurements: count,
            hours: self.hours(revolutions),
            revolutions,
            coefficient_m2_per_N: interval(at),
            coefficient_quartiles_m2_per_N: [0.25, 0.75].map(at),
            wander,
            scatter,
            life: self.limit.as_ref().map(|(_, exposure)| self.remaining(&posterior, exposure / self.duration)),
            later: (count..self.valued.len()).map(|index| self.prediction(&posterior, index)).collect(),
        }
    }

    fn remaining(&self, posterior: &Posterior, limit: f64) -> RemainingLife {
        let remaining = interval(|probability| self.duration * posterior.remaining_quantile(limit, probability));
        let hours = |revolutions: f64| self.hours(revolutions);
        let in_hours = || {
            Some(Interval {
                median: hours(remaining.median)?,
                low: hours(remaining.low)?,
                high: hours(remaining.high)?,
            })
        };
        let at = self.duration * posterior.revolutions;
        let passed = if posterior.revolutions > 0.0 { posterior.life_below(posterior.revolutions, limit) } else { 0.0 };
        let remaining_hours = in_hours();
        RemainingLife {
            passed,
            remaining_revolutions: remaining,
            remaining_hours,
            total_revolutions: remaining.plus(at),
            total_hours: remaining_hours.and_then(|remaining| Some(remaining.plus(hours(at)?))),
        }
    }

    /// What is expected of a measurement that is not among those of `posterior`.
    fn prediction(&self, posterior: &Posterior, index: usize) -> Prediction {
        let of = self.valued[index];
        let given: f64 = of.values.relative_sigmas.iter().map(|sigma| sigma * sigma).sum::<f64>();
        let found = self.measured_exposure(of, given.sqrt() / of.values.values.len() as f64);
        let quantity = WearQuantity::of_kind(of.of.kind).unwrap_or(WearQuantity::PeakDepth);
        let expected = posterior.measured(found.revolutions, found.relative_sigma);
        let at = |probability: f64| self.curve.value_at(quantity, self.duration * expected.quantile(probability));
        Prediction {
            measurement: index + 1,
            median: at(0.5),
            low: at(0.025),
            high: at(0.975),
            below_found: expected.below(found.exposure),
        }
    }

    fn measurement(&self, of: &Valued<'_>, sigma: f64, shown: WearQuantity) -> MeasurementRecord {
        let exposure = self.exposure(of);
        let value = match WearQuantity::of_kind(of.of.kind) {
            Some(_) => of.values.mean(),
            None => self.curve.value_at(WearQuantity::PeakDepth, exposure).unwrap_or(f64::NAN),
        };
        MeasurementRecord {
            lines: of.of.lines.clone(),
            hours: self.hours(of.of.revolutions),
            revolutions: of.of.revolutions,
            kind: of.of.kind,
            value,
            sigma: sigma * value,
            count: of.values.values.len(),
            mean_coefficient_m2_per_N: self.coefficient_of_run * exposure / of.of.revolutions,
            shown: self.curve.value_at(shown, exposure),
        }
    }

    /// Wear from the last measurement on, until the limit is passed with the greatest probability, or as long again.
    fn band(&self, posterior: &Posterior, shown: WearQuantity) -> Vec<BandPoint> {
        let begin = posterior.revolutions;
        let end = match &self.limit {
            Some((_, exposure)) => begin + posterior.remaining_quantile(exposure / self.duration, 0.975),
            None => 2.0 * begin,
        };
        let end = end.clamp(1.1 * begin, 10.0 * begin);
        let points = (0..=BAND_POINTS).map(|i| {
            let revolutions = begin + (end - begin) * i as f64 / BAND_POINTS as f64;
            let at = |probability: f64| {
                self.curve.value_at(shown, self.duration * posterior.exposure_quantile(revolutions, probability))
            };
            BandPoint { revolutions: self.duration * revolutions, low: at(0.025), median: at(0.5), high: at(0.975) }
        });
        points.collect()
    }

    /// Wear of the run with the median coefficient up to the last measurement.
    fn simulated(&self, posterior: &Posterior, shown: WearQuantity) -> Vec<(f64, Option<f64>)> {
        let (factor, end) = (posterior.factor_quantile(0.5), self.duration * posterior.revolutions);
        let times = (0..=BAND_POINTS).map(|i| end * i as f64 / BAND_POINTS as f64);
        times.map(|revolutions| (revolutions, self.curve.value_at(shown, factor * revolutions))).collect()
    }

    fn hours(&self, revolutions: f64) -> Option<f64> {
        self.pinion_speed_rpm.map(|rpm| revolutions / (60.0 * rpm))
    }
}

fn interval(at: impl Fn(f64) -> f64) -> Interval {
    Interval { median: at(0.5), low: at(0.025), high: at(0.975) }
}

/// Measurements that the ones before did not lead to expect.
fn warnings(of: &GearLife) -> Vec<String> {
    let gear = of.gear.name();
    let next = of.updates.iter().skip(1).filter_map(|update| update.later.first());
    let unexpected = next.filter(|later| !(UNEXPECTED..=1.0 - UNEXPECTED).contains(&later.below_found));
    let mut warnings: Vec<String> = unexpected
        .map(|later| {
            let number = later.measurement;
            let more = if later.below_found > 0.5 { "more" } else { "less" };
            format!(
                "measurement {number} of the {gear} (line {}) finds {more} wear than those before it let expect: where its wear rate has changed, intervals that rest on \
                 what was before do not hold",
                of.measurements[number - 1].lines[0]
            )
        })
        .collect();
    let Some(last) = of.updates.last() else { return warnings };
    let (prior, k) = (&of.prior, last.coefficient_m2_per_N);
    if k.high < prior.low_m2_per_N || k.low > prior.high_m2_per_N {
        warnings.push(format!(
            "the wear coefficient of the {gear}, {:.2e} m²/N, is outside of what was expected before any measurement, {:.1e} to {:.1e}: another --prior",
            k.median, prior.low_m2_per_N, prior.high_m2_per_N
        ));
    }
    warnings
}
