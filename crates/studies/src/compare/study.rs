//! A comparison from beginning to end.

use super::comparison::{Comparison, root_mean_square};
use super::profile_slope::{self, NotTried};
use super::question::{ComparisonQuestion, FittedGears, ProfileQuestion, is_of_both};
use super::record::{
    Coefficient, CoefficientCorrelation, CompareFigures, CompareRecord, CompareRow, FitRecord, FittedValue,
    LeadDeviations, ProfileDeviations, ProfileRecord,
};
use super::run_folder::RunFolder;
use super::search::{CoefficientSearch, FittedCoefficients};
pub use super::simulations::CompareError;
use super::simulations::{CoefficientChange, Simulations, over_width};
use super::unknown::Unknown;
use crate::measurement::deviations::Evaluation;
use crate::measurement::fit::FitStop;
use crate::measurement::interval::CONFIDENCE;
use crate::measurement::roughness::{CUTOFF_MM, mean_deviation, roughness};
use gearwear::measured_flank::file::HeightFrom;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, slices::Slices};
use gearwear_physics::assessment::RunError;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::PathPoints;

/// mm²/N to m²/N.
const M2_PER_MM2: f64 = 1e-6;
/// Ratio of residuals to the uncertainty of the heights above which the simulation does not describe the profile.
const NOT_DESCRIBED: f64 = 2.0;

/// Compares the measured profiles with the run in `folder`, whose scene is `given`.
pub fn run(
    question: &ComparisonQuestion,
    folder: &RunFolder,
    given: &LoadedScene,
    observer: &dyn Observer,
) -> Result<CompareRecord, CompareError> {
    let resolved = &given.resolved;
    let scene = &resolved.scene;
    let pair = &GearPair::new(&scene.pair).map_err(RunError::from)?;
    let comparisons: Vec<Comparison<'_>> =
        question.profiles.iter().map(|of| Comparison::new(of, pair, &scene.numerics)).collect();
    let mut simulations = Simulations::new(given, question, observer);
    let kept: Option<Vec<_>> = comparisons.iter().map(|one| as_kept(one, pair)).collect();
    let as_run_um = match kept {
        Some(kept) => kept,
        None => simulations.exactly(CoefficientChange::NOTHING)?,
    };
    let found = CoefficientSearch::new(question, &comparisons).run(&as_run_um, &mut simulations)?;

    let profiles = comparisons.iter().enumerate().map(|(index, comparison)| {
        let rows = rows(question, pair, comparison, [&found.wear_um[index], &as_run_um[index]], &found);
        profile(question, resolved, comparison, (index, rows), &found)
    });
    let profiles: Vec<ProfileRecord> = profiles.collect();
    let fit = fit(question, resolved, &found, &profiles, &simulations);
    let sloped = profile_slope::fit_with_slopes(question, given, &profiles, &found, observer)?;
    let mut warnings: Vec<String> =
        folder.version_warning().into_iter().chain(warnings(&fit, &profiles, found.unsettled)).collect();
    if let Err(NotTried::Refused(why)) = &sloped {
        warnings.push(format!("what the slopes of the profiles before wear move is not known: {why}"));
    }
    Ok(CompareRecord {
        title: folder.summary.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: resolved.scene_hash(),
        fit,
        with_profile_slopes: sloped.ok(),
        profiles,
        warnings,
        scene_toml: resolved.to_toml(),
    })
}

/// Wear that the run recorded at the time of the measurement.
fn as_kept(comparison: &Comparison<'_>, pair: &GearPair) -> Option<Vec<f64>> {
    let (of, points) = (comparison.of, comparison.flank_points());
    let wear_um = of.as_run_um.as_ref()?;
    let slices = Slices::new(pair, wear_um.len() / points);
    Some(over_width(wear_um, &slices.width_mm, points, of.width_mm))
}

pub(super) fn rows(
    question: &ComparisonQuestion,
    pair: &GearPair,
    comparison: &Comparison<'_>,
    [wear_um, as_run_um]: [&[f64]; 2],
    found: &FittedCoefficients,
) -> Vec<CompareRow> {
    let gear = comparison.of.profile.gear;
    let shift = found.of(question.shift_of(gear)).map_or(0.0, |(shift, _)| shift);
    let mut shifted = comparison.of.profile.clone();
    shifted.arc_mm.iter_mut().for_each(|arc| *arc += shift);
    let radius = shifted.radius_mm(pair);
    let scale = comparison.of.profile.over_normal(comparison.pair);
    let simulated = comparison.simulated_um(wear_um, shift);
    let as_run = comparison.simulated_um(as_run_um, shift);
    let wear = comparison.wear_at_points_um(wear_um, shift);
    (0..radius.len())
        .map(|i| {
            let difference_um = comparison.measured_um[i] - simulated[i];
            CompareRow {
                radius_mm: radius[i],
                arc_mm: shifted.arc_mm[i],
                measured_um: comparison.measured_um[i],
                simulated_um: simulated[i],
                difference_um,
                as_run_um: as_run[i],
                wear_um: wear[i],
                measured_wear_um: wear[i] - difference_um / scale,
                gear,
            }
        })
        .collect()
}

fn profile(
    question: &ComparisonQuestion,
    resolved: &Resolved,
    comparison: &Comparison<'_>,
    (index, rows): (usize, Vec<CompareRow>),
    found: &FittedCoefficients,
) -> ProfileRecord {
    let (of, pair) = (comparison.of, comparison.pair);
    let gear = of.profile.gear;
    let scatter = found.uncertainty.as_ref().map(|u| u.scatter[index]);
    let deviations = deviations(of, pair, &rows);
    let both = deviations.and_then(|of| Some([of.before_wear?, of.wear?]));
    let [a, b, c, d, e] = pair.path.points_mm().map(|position| pair.radius_at_mm(gear, position));
    ProfileRecord {
        measured: of.measured.clone(),
        gear,
        width_mm: of.width_mm,
        hours: resolved.scene.operation.hours(of.revolutions),
        revolutions: of.revolutions,
        form: of.form.name().to_owned(),
        shift_mm: found.of(question.shift_of(gear)).map(|(value, half)| FittedValue {
            value,
            low: half.map(|h| value - h),
            high: half.map(|h| value + h),
            of_run: 0.0,
        }),
        points: rows.len(),
        effective_points: scatter.map(|s| s.effective_points),
        degrees_of_freedom: scatter.map(|s| s.degrees_of_freedom),
        figures: figures(of, &rows),
        teeth: of.profile.teeth_um.len().max(1),
        waves: found.waves[index].clone(),
        profile_slope: both
            .and_then(|both| profile_slope::found(comparison, question.shift_of(gear), index, found, both)),
        deviations,
        leads: leads(of, pair),
        path_point_radius_mm: PathPoints { A: a, B: b, C: c, D: d, E: e },
        rows,
    }
}

fn fit(
    question: &ComparisonQuestion,
    resolved: &Resolved,
    found: &FittedCoefficients,
    profiles: &[ProfileRecord],
    simulations: &Simulations<'_>,
) -> FitRecord {
    let coefficient = PerGear::from_fn(|gear| M2_PER_MM2 * resolved.scene.wear[gear].coefficient_mm2_per_n);
    let ratio = coefficient.pinion / coefficient.wheel;
    let [pinion, wheel] = Gear::BOTH.map(|gear| Unknown::Coefficient(Some(gear)));
    let parameters = &found.unknowns;
    FitRecord {
        stopped: found.stop,
        blamed: found.blamed,
        coefficients: coefficients(question, resolved, found),
        coefficient_ratio: found.difference(pinion, wheel).map(|logarithm| estimate(logarithm, ratio, ratio)),
        severe_factor: found.of(Unknown::Severe).map(|log| estimate(log, simulations.severe_factor(), 1.0)),
        correlation: found
            .uncertainty
            .as_ref()
            .filter(|_| parameters.len() > 1)
            .map(|u| CoefficientCorrelation { parameters: parameters.clone(), matrix: u.correlation.clone() }),
        runs: simulations.runs,
        mesh_cycles: simulations.mesh_cycles,
        how: how(question, found, profiles),
    }
}

/// The fitted wear coefficients, over those of `resolved`.
pub(super) fn coefficients(
    question: &ComparisonQuestion,
    resolved: &Resolved,
    found: &FittedCoefficients,
) -> Vec<Coefficient> {
    let all = whose(question, resolved).into_iter().filter_map(|(unknown, gear)| {
        let logarithm = found.of(unknown)?;
        let own = gear.unwrap_or(question.profiles[0].profile.gear);
        let of_run = M2_PER_MM2 * resolved.scene.wear[own].coefficient_mm2_per_n;
        let (factor, value) = (estimate(logarithm, 1.0, 1.0), estimate(logarithm, of_run, of_run));
        Some(Coefficient { gear, factor, coefficient_m2_per_N: value })
    });
    all.collect()
}

/// `unit` times the number of a logarithm, given with half the width of its interval.
fn estimate((value, half): (f64, Option<f64>), of_run: f64, unit: f64) -> FittedValue {
    let [value, low, high] = [Some(0.0), half.map(|half| -half), half].map(|by| by.map(|by| unit * (value + by).exp()));
    FittedValue { value: value.unwrap_or(f64::NAN), low, high, of_run }
}

/// Unknown wear coefficients, each with its gear; `None` for both where they have one law.
fn whose(question: &ComparisonQuestion, resolved: &Resolved) -> Vec<(Unknown, Option<Gear>)> {
    match question.fitted {
        FittedGears::Each => Gear::BOTH.map(|gear| (Unknown::Coefficient(Some(gear)), Some(gear))).into(),
        FittedGears::Alone(gear) => vec![(Unknown::Coefficient(None), Some(gear))],
        FittedGears::Together if is_of_both(&resolved.scene) => vec![(Unknown::Coefficient(None), None)],
        FittedGears::Together => Gear::BOTH.map(|gear| (Unknown::Coefficient(None), Some(gear))).into(),
    }
}

/// Effective number of points: "20 of 150 points".
fn counted(of: &ProfileRecord) -> Option<String> {
    Some(format!("{:.0} of {} points", of.effective_points?, of.points))
}

/// How the intervals were obtained, or why there are none.
fn how(question: &ComparisonQuestion, found: &FittedCoefficients, profiles: &[ProfileRecord]) -> String {
    let confidence = 100.0 * CONFIDENCE;
    let how = match profiles {
        _ if found.unknowns.is_empty() => "nothing was fitted".to_owned(),
        _ if found.uncertainty.is_none() => {
            "no interval: by the autocorrelation of the residuals too few points count, or a value is not determined or at its bound"
                .to_owned()
        }
        [one] => format!(
            "{confidence:.0} % interval from the scatter of the residuals (Student's t, {:.0} degrees of freedom): by their \
             autocorrelation {} count",
            one.degrees_of_freedom.unwrap_or_default(),
            counted(one).unwrap_or_default()
        ),
        several => {
            let counts: Vec<String> =
                several.iter().filter_map(|of| Some(format!("{} of the {}", counted(of)?, of.gear.name()))).collect();
            format!(
                "{confidence:.0} % intervals from the scatter of the residuals, each profile with its own (Student's t, degrees \
                 of freedom after Welch and Satterthwaite): by their autocorrelation {} count",
                counts.join(" and ")
            )
        }
    };
    let how = with_waves(how, profiles);
    match question.fitted {
        FittedGears::Alone(gear) if question.fit.coefficient() => format!(
            "{how}; the gears wear by different laws: what is fitted is that of the {} alone, and that of the {} is as in the run",
            gear.name(),
            gear.mate().name()
        ),
        _ => how,
    }
}

/// Deviations of the measured profile, without its wear, and of the wear.
pub(super) fn deviations(of: &ProfileQuestion, pair: &GearPair, rows: &[CompareRow]) -> Option<ProfileDeviations> {
    let profile = &of.profile;
    if profile.height_from == HeightFrom::Line {
        return None;
    }
    let evaluation = Evaluation::of_profile(pair, profile.gear);
    let [_, roll_mm] = profile.places_mm(pair);
    let design_um = profile.unworn_um(pair, 0.0);
    // Deviations are along the transverse line of action.
    let of_normal = pair.obliquity().transverse_mm(1.0);
    let of_heights = of_normal / profile.over_normal(pair);
    let wear: Vec<f64> = rows.iter().map(|row| -of_normal * row.wear_um).collect();
    let points = profile.height_um.iter().zip(&design_um);
    let measured: Vec<f64> = points.map(|(height, design)| of_heights * (height - design)).collect();
    let before: Vec<f64> = measured.iter().zip(&wear).map(|(height, wear)| height - wear).collect();
    let [measured, before_wear, wear] =
        [measured, before, wear].map(|heights| evaluation.deviations(&roll_mm, &heights));
    Some(ProfileDeviations { measured, before_wear, wear })
}

/// Deviations of the leads of the flanks of a profile.
fn leads(of: &ProfileQuestion, pair: &GearPair) -> Vec<LeadDeviations> {
    let evaluation = Evaluation::of_lead(pair, of.profile.gear);
    let leads = of.profile.leads.iter().map(|lead| {
        let (places, heights): (Vec<f64>, Vec<f64>) = lead.points.iter().map(|at| (at.place, at.height_um)).unzip();
        LeadDeviations { tooth: lead.tooth, measured: evaluation.deviations(&places, &heights) }
    });
    leads.collect()
}

/// With the waves that are fitted along, and the teeth whose mean a profile is.
fn with_waves(mut how: String, profiles: &[ProfileRecord]) -> String {
    for of in profiles {
        let whose = if profiles.len() > 1 { format!(" of the {}", of.gear.name()) } else { String::new() };
        let lengths: Vec<String> = of.waves.iter().map(|wave| format!("{:.2}", wave.length_mm)).collect();
        if !lengths.is_empty() {
            how.push_str(&format!("; waves{whose} of {} mm are fitted along", lengths.join(", ")));
        }
        if of.teeth > 1 {
            how.push_str(&format!("; the profile{whose} is the mean of {} teeth, whose scatter counts too", of.teeth));
        }
    }
    how
}

fn figures(of: &ProfileQuestion, rows: &[CompareRow]) -> CompareFigures {
    let arc = &of.profile.arc_mm;
    let measured: Vec<f64> = rows.iter().map(|row| row.measured_um).collect();
    let simulated: Vec<f64> = rows.iter().map(|row| row.simulated_um).collect();
    let worst = rows.iter().max_by(|a, b| a.difference_um.abs().total_cmp(&b.difference_um.abs()));
    CompareFigures {
        mean_deviation_um: mean_deviation(arc, &measured),
        simulated_mean_deviation_um: mean_deviation(arc, &simulated),
        roughness_um: roughness(arc, &measured, CUTOFF_MM),
        cutoff_mm: CUTOFF_MM,
        as_run_difference_um: root_mean_square(rows.iter().map(|row| row.measured_um - row.as_run_um)),
        difference_um: root_mean_square(rows.iter().map(|row| row.difference_um)),
        greatest_difference_um: worst.map_or(0.0, |row| row.difference_um.abs()),
        greatest_difference_radius_mm: worst.map_or(0.0, |row| row.radius_mm),
        uncertainty_um: of.uncertainty_um,
    }
}

fn warnings(fit: &FitRecord, profiles: &[ProfileRecord], unsettled: Option<f64>) -> Vec<String> {
    let mut warnings = Vec::new();
    let blamed = fit.blamed.map_or_else(|| "a value".to_owned(), Unknown::name);
    match fit.stopped {
        FitStop::Converged => {}
        FitStop::AtBound if matches!(fit.blamed, Some(Unknown::Shift(_))) => {
            warnings.push(format!(
                "{blamed} is as long as it may be: allow more with --shift-within, or check where the file's arc begins"
            ));
        }
        FitStop::AtBound => {
            warnings.push(format!("{blamed} is at the end of what is searched: the profile does not give it"))
        }
        FitStop::Undetermined => {
            warnings.push(format!("{blamed} has no effect on the profile, which therefore does not give it"))
        }
        FitStop::MaxIterations => {
            warnings.push("the fit did not converge: its values are those of the best run".to_owned())
        }
        FitStop::NotFinite => warnings.push("the residuals are not numbers: nothing was fitted".to_owned()),
    }
    if let Some(step) = unsettled {
        warnings.push(format!(
            "the last run would still move the fit by {step:.2} of a standard deviation: the wear of this scene does not change smoothly \
             with what is fitted (an abrupt transition to severe wear, or wear steps beyond the stable one): a run with wear.severe.band_MPa and \
             numerics.step = \"adaptive\" does"
        ));
    }
    warnings.extend(profiles.iter().filter_map(|of| not_described(of, profiles.len() > 1)));
    warnings
}

/// Warning about a profile whose residuals its uncertainty does not explain, with its gear where there are others.
fn not_described(of: &ProfileRecord, name_gear: bool) -> Option<String> {
    let difference_um = of.figures.difference_um;
    let uncertainty_um = of.figures.uncertainty_um.filter(|u| difference_um > NOT_DESCRIBED * u)?;
    let whose = if name_gear { format!(" of the {}’s profile", of.gear.name()) } else { String::new() };
    Some(format!(
        "the difference{whose}, {difference_um:.3} µm (root mean square), is {:.1} times the uncertainty of the heights: the simulation does not \
         describe all of the profile, and the interval does not say how far off it is",
        difference_um / uncertainty_um
    ))
}
