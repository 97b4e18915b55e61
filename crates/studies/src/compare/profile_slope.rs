//! Profile slope of the flanks before wear, and what it does to the wear coefficients.
//!
//! A flank that leaves manufacture with a slope deviation f_Hα is loaded elsewhere and wears elsewhere: the scene should have it
//! (`profile_slope_deviation_um`). Form removal takes any line out of a profile, so that a slope is not counted as wear, but the wear itself is that of
//! the scene's flank. What the profile says of the slope, with the wear h by the fitted coefficients put back along the line of action:
//!
//! ```text
//! f_Hα = f_scene + f(z − z₀ + h/cos β_b)
//! ```
//!
//! with f the slope of the mean line (ISO 1328-1, [`crate::measurement::deviations`]). Its 95 % half-width, errors independent of one another:
//!
//! ```text
//! δ² = (t σ L/√Σ(x − x̄)²)² + Σ (δθ_i ∂f/∂θ_i)² + Σ (A_w 6 λ_w/(π X) · L/X)²
//! ```
//!
//! of the scatter σ of the heights, the coefficients and the shift θ, and waves of amplitude A and length λ that are fitted along. Where a slope differs from the scene's by
//! more, the coefficients are fitted again with it in the scene, until the slope that is found is the one put in. Whether it is the gear's or of
//! the measurement (clamping, eccentricity, which the mean of teeth around the gear takes away), a worn profile does not tell.

use std::collections::BTreeMap;

use serde::Serialize;

use super::comparison::{Comparison, root_mean_square};
use super::question::{ComparisonQuestion, ProfileQuestion};
use super::record::{Coefficient, CompareRow, FittedValue, ProfileRecord};
use super::search::{CoefficientSearch, FittedCoefficients};
use super::simulations::{CompareError, Simulations};
use super::study;
use super::unknown::Unknown;
use crate::measurement::deviations::{Deviations, Evaluation};
use crate::measurement::fit::FitStop;
use crate::measurement::form::Form;
use crate::measurement::interval;
use gearwear::measured_flank::file::{HeightFrom, ValueKind};
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_physics::assessment::RunError;
use gearwear_physics::observer::Observer;

/// Least slope beside the scene's that is told: the resolution of a gear measuring machine, µm.
const LEAST_UM: f64 = 0.1;
/// Most slopes that are put into the scene, one after another.
const MOST_TRIED: usize = 4;

/// f_Hα of a flank before wear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProfileSlope {
    /// `of_run`: that of the scene.
    pub before_wear_um: FittedValue,
    /// Whether it differs from the scene's by more than its interval.
    pub differs: bool,
    /// Key of the scene for it; null where the flank of the scene is a measured one.
    pub key: Option<String>,
    /// Whether the form that was removed has a line in it, so that no slope counts as wear.
    pub removed_with_form: bool,
}

/// The fit with the slopes that were found in the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitWithSlopes {
    /// Values of keys in the scene.
    pub profile_slopes_um: BTreeMap<String, f64>,
    pub stopped: FitStop,
    pub coefficients: Vec<Coefficient>,
    /// Root mean square of measured less simulated, profile by profile.
    pub difference_um: Vec<f64>,
    /// Logarithm of the likelihood of the profiles with the slopes over that without: Σ n/2 ln(r²/r_with²), of n points that count.
    pub likelihood_gain: f64,
    pub runs: u64,
    pub mesh_cycles: u64,
}

/// Of a profile with the deviations of its flank before wear and of its wear; `None` where heights are not from the involute.
pub(super) fn found(
    comparison: &Comparison<'_>,
    shift: Unknown,
    index: usize,
    fitted: &FittedCoefficients,
    [before_wear, wear]: [Deviations; 2],
) -> Option<ProfileSlope> {
    let (of, pair) = (comparison.of, comparison.pair);
    let ProfileQuestion { profile, form, .. } = of;
    if profile.kind != ValueKind::Height || profile.height_from != HeightFrom::Involute {
        return None;
    }
    let gear = profile.gear;
    let [_, roll_mm] = profile.places_mm(pair);
    let evaluation = Evaluation::of_profile(pair, gear);
    let spec = &pair.spec.gears[gear];
    let (of_run, key) = match &spec.measured_flank {
        Some(_) => (evaluation.deviations(&roll_mm, &profile.unworn_um(pair, 0.0))?.slope_um, None),
        None => (1e3 * spec.modification.profile_slope_mm, Some(key(gear))),
    };
    let half = fitted.uncertainty.as_ref().and_then(|uncertainty| {
        let scatter = uncertainty.scatter[index];
        let of_heights =
            interval::quantile(scatter.degrees_of_freedom)? * scatter.deviation * evaluation.slope_per_height(&roll_mm);
        let of_fitted = fitted.unknowns.iter().zip(&uncertainty.half_widths).filter(|(own, _)| own.is_of(gear));
        let of_fitted = of_fitted.map(|(&own, &half)| match own {
            Unknown::Shift(_) => {
                let at = fitted.of(shift).map_or(0.0, |(shift, _)| shift);
                let slope = |shift: f64| {
                    let wear = comparison.wear_at_points_um(&fitted.wear_um[index], shift);
                    Some(evaluation.deviations(&roll_mm, &wear)?.slope_um)
                };
                Some(0.5 * (slope(at + half)? - slope(at - half)?))
            }
            // Wear goes with its coefficient, and less than with the factor of severe wear.
            Unknown::Coefficient(_) | Unknown::Severe => Some(half * wear.slope_um),
        });
        let of_waves =
            fitted.waves[index].iter().map(|w| Some(w.amplitude_um * evaluation.slope_per_wave(w.length_mm)));
        let all: Option<Vec<f64>> = [Some(of_heights)].into_iter().chain(of_fitted).chain(of_waves).collect();
        Some(all?.iter().map(|error| error * error).sum::<f64>().sqrt())
    });
    let value = of_run + before_wear.slope_um;
    Some(ProfileSlope {
        before_wear_um: FittedValue {
            value,
            low: half.map(|half| value - half),
            high: half.map(|half| value + half),
            of_run,
        },
        differs: half.is_some_and(|half| before_wear.slope_um.abs() > half.max(LEAST_UM)),
        key,
        removed_with_form: *form != Form::None,
    })
}

/// Key of the slope of a gear in a scene.
fn key(gear: Gear) -> String {
    format!("pair.{}.profile_slope_deviation_um", gear.name())
}

/// What kept the slopes from being tried.
pub(super) enum NotTried {
    /// No slope differs, or nothing is fitted that depends on one.
    NothingToTry,
    /// The scene with it is refused.
    Refused(String),
}

/// Fits the coefficients again with the slopes of `profiles` in the scene, from what was `fitted` without on; a slope that is then found to differ takes its place.
///
/// # Errors
/// A run that is interrupted. One that fails leaves the slopes untried.
pub(super) fn fit_with_slopes(
    question: &ComparisonQuestion,
    given: &LoadedScene,
    profiles: &[ProfileRecord],
    fitted: &FittedCoefficients,
    observer: &dyn Observer,
) -> Result<Result<FitWithSlopes, NotTried>, CompareError> {
    let mut slopes = PerGear::from_fn(|gear| {
        let of_gear = profiles.iter().find(|of| of.gear == gear)?;
        of_gear.profile_slope.as_ref().filter(|slope| slope.differs && slope.key.is_some()).map(rounded)
    });
    let is_fitted = fitted.stop == FitStop::Converged && (question.fit.coefficient() || question.fit.severe());
    if !question.tries_slopes || !is_fitted || Gear::BOTH.iter().all(|&gear| slopes[gear].is_none()) {
        return Ok(Err(NotTried::NothingToTry));
    }
    let mut fitted = fitted.clone();
    let (mut tried, mut runs, mut mesh_cycles) = (0, 0, 0);
    loop {
        tried += 1;
        let values = Gear::BOTH.into_iter().filter_map(|gear| Some((key(gear), slopes[gear]?)));
        let profile_slopes_um: BTreeMap<String, f64> = values.collect();
        let changes = profile_slopes_um.iter().map(|(key, value)| (key.clone(), Some(toml::Value::from(*value))));
        let sloped = match given.with_all(changes) {
            Ok(sloped) => sloped,
            Err(error) => return Ok(Err(NotTried::Refused(error.to_string()))),
        };
        let pair = &match GearPair::new(&sloped.resolved.scene.pair) {
            Ok(pair) => pair,
            Err(error) => return Ok(Err(NotTried::Refused(RunError::from(error).to_string()))),
        };
        let numerics = &sloped.resolved.scene.numerics;
        let comparisons: Vec<Comparison<'_>> =
            question.profiles.iter().map(|of| Comparison::new(of, pair, numerics)).collect();
        let mut simulations = Simulations::new(&sloped, question, observer);
        simulations.name = "with the profile slope, run";
        fitted = match CoefficientSearch::again(question, &comparisons, &fitted, &mut simulations) {
            Ok(fitted) => fitted,
            Err(CompareError::Interrupted) => return Err(CompareError::Interrupted),
            Err(CompareError::Run(error)) => return Ok(Err(NotTried::Refused(error.to_string()))),
        };
        (runs, mesh_cycles) = (runs + simulations.runs, mesh_cycles + simulations.mesh_cycles);
        let (mut difference_um, mut likelihood_gain) = (Vec::new(), 0.0);
        let mut is_settled = true;
        for (index, comparison) in comparisons.iter().enumerate() {
            let rows: Vec<CompareRow> = study::rows(question, pair, comparison, [&fitted.wear_um[index]; 2], &fitted);
            let difference = root_mean_square(rows.iter().map(|row| row.difference_um));
            let without = &profiles[index];
            likelihood_gain +=
                without.effective_points.unwrap_or_default() * (without.figures.difference_um / difference).ln();
            difference_um.push(difference);
            let deviations = study::deviations(comparison.of, pair, &rows);
            let both = deviations.and_then(|of| Some([of.before_wear?, of.wear?]));
            let gear = comparison.of.profile.gear;
            let slope = both.and_then(|both| found(comparison, question.shift_of(gear), index, &fitted, both));
            if let (Some(slope), true) = (slope.filter(|slope| slope.differs), slopes[gear].is_some()) {
                is_settled = false;
                slopes[gear] = Some(rounded(&slope));
            }
        }
        if is_settled || tried == MOST_TRIED {
            return Ok(Ok(FitWithSlopes {
                profile_slopes_um,
                stopped: fitted.stop,
                coefficients: study::coefficients(question, &sloped.resolved, &fitted),
                difference_um,
                likelihood_gain,
                runs,
                mesh_cycles,
            }));
        }
    }
}

/// A slope as it is put into a scene, to 0.01 µm.
fn rounded(slope: &ProfileSlope) -> f64 {
    (100.0 * slope.before_wear_um.value).round() / 100.0
}
