//! A comparison from beginning to end.

use super::question::Question;
use super::run_folder::RunFolder;
use super::search::{Comparison, FittedCoefficients, Unknown};
pub(crate) use super::simulations::CompareError;
use super::simulations::{Change, Simulations, is_of_both, over_width};
use crate::gear::{GearPair, flank::FlankGrid, slices::Slices};
use crate::measurement::fit::FitStop;
use crate::measurement::interval::CONFIDENCE;
use crate::measurement::roughness::{CUTOFF_MM, mean_deviation, roughness};
use crate::observer::Observer;
use crate::pipeline::RunError;
use crate::results::run::PathPoints;
use crate::scene::Resolved;
use crate::scene::loaded::LoadedScene;
use crate::studies::compare::record::{CompareFigures, CompareRecord, CompareRow, Estimate, FitRecord};

/// mm²/N to m²/N.
const M2_PER_MM2: f64 = 1e-6;
/// Residuals this many times the uncertainty of the heights say that the simulation does not describe the profile.
const NOT_DESCRIBED: f64 = 2.0;

/// Compares what was measured with the run in `folder`, whose scene is `given`; `measured` is the name of the file.
pub(crate) fn run(
    question: &Question,
    folder: &RunFolder,
    given: &LoadedScene,
    measured: &str,
    observer: &dyn Observer,
) -> Result<CompareRecord, CompareError> {
    let resolved = &given.resolved;
    let scene = &resolved.scene;
    let pair = &GearPair::new(&scene.pair).map_err(RunError::from)?;
    let profile = &question.profile;
    let grid = FlankGrid::new(pair, profile.gear, scene.numerics.flank_points);
    let points = grid.len();
    let comparison = Comparison::new(question, pair, grid.arc_mm);
    let mut simulations = Simulations::new(given, profile.gear, question.width_mm, question.revolutions, observer);
    let as_run_um = match &question.as_run_um {
        Some(wear_um) => {
            let slices = Slices::new(pair, wear_um.len() / points);
            over_width(wear_um, &slices.width_mm, points, question.width_mm)
        }
        None => simulations.exactly(Change::NOTHING)?,
    };
    let found = comparison.search(&as_run_um, &mut simulations)?;

    let rows = rows(question, pair, &comparison, &found, &as_run_um);
    let fit = fit(question, resolved, &found, &simulations);
    let figures = figures(question, &rows);
    let warnings = folder.version_warning().into_iter().chain(warnings(&fit, &figures, found.unsettled)).collect();
    let [a, b, c, d, e] = pair.path.points_mm().map(|position| pair.radius_at_mm(profile.gear, position));
    Ok(CompareRecord {
        title: folder.summary.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: resolved.scene_hash(),
        measured: measured.to_owned(),
        gear: profile.gear,
        width_mm: question.width_mm,
        hours: scene.operation.hours(question.revolutions),
        revolutions: question.revolutions,
        form: question.form.name().to_owned(),
        fit,
        figures,
        path_point_radius_mm: PathPoints { A: a, B: b, C: c, D: d, E: e },
        warnings,
        rows,
        scene_toml: resolved.to_toml(),
    })
}

fn rows(
    question: &Question,
    pair: &GearPair,
    comparison: &Comparison<'_>,
    found: &FittedCoefficients,
    as_run_um: &[f64],
) -> Vec<CompareRow> {
    let shift = found.shift_mm();
    let mut shifted = question.profile.clone();
    shifted.arc_mm.iter_mut().for_each(|arc| *arc += shift);
    let radius = shifted.radius_mm(pair);
    let simulated = comparison.simulated_um(&found.wear_um, shift);
    let as_run = comparison.simulated_um(as_run_um, shift);
    let wear = comparison.wear_at_points_um(&found.wear_um, shift);
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
                measured_wear_um: wear[i] - difference_um,
            }
        })
        .collect()
}

fn fit(
    question: &Question,
    resolved: &Resolved,
    found: &FittedCoefficients,
    simulations: &Simulations<'_>,
) -> FitRecord {
    let of_logarithm = |unknown, of_run: f64, unit: f64| {
        let (value, half) = found.of(unknown)?;
        let at = |by: f64| unit * (value + by).exp();
        Some(Estimate { value: at(0.0), low: half.map(|h| at(-h)), high: half.map(at), of_run })
    };
    let coefficient = M2_PER_MM2 * resolved.scene.wear[question.profile.gear].coefficient_mm2_per_n;
    let points = question.profile.arc_mm.len();
    let how = match &found.uncertainty {
        Some(u) => format!(
            "{:.0} % interval from the scatter of the residuals (Student's t, {:.0} degrees of freedom): by their autocorrelation \
             {:.0} of {points} points count",
            100.0 * CONFIDENCE,
            u.degrees_of_freedom,
            u.effective_points
        ),
        None if found.unknowns.is_empty() => "nothing was fitted".to_owned(),
        None => {
            "no interval: by the autocorrelation of the residuals too few points count, or a value is not determined or at its bound"
                .to_owned()
        }
    };
    let gear = question.profile.gear;
    let how = match question.fit.coefficient() && !is_of_both(&resolved.scene) {
        true => format!(
            "{how}; the gears wear by different laws: what is fitted is that of the {} alone, and that of the {} is as in the run",
            gear.name(),
            gear.mate().name()
        ),
        false => how,
    };
    FitRecord {
        stopped: found.stop,
        blamed: found.blamed.map(|unknown| name(unknown).to_owned()),
        coefficient_factor: of_logarithm(Unknown::Coefficient, 1.0, 1.0),
        coefficient_m2_per_N: of_logarithm(Unknown::Coefficient, coefficient, coefficient),
        severe_factor: of_logarithm(Unknown::Severe, simulations.severe_factor(), 1.0),
        shift_mm: found.of(Unknown::Shift).map(|(value, half)| Estimate {
            value,
            low: half.map(|h| value - h),
            high: half.map(|h| value + h),
            of_run: 0.0,
        }),
        points,
        effective_points: found.uncertainty.as_ref().map(|u| u.effective_points),
        degrees_of_freedom: found.uncertainty.as_ref().map(|u| u.degrees_of_freedom),
        runs: simulations.runs,
        mesh_cycles: simulations.mesh_cycles,
        how,
    }
}

fn name(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::Coefficient => "the wear coefficient",
        Unknown::Severe => "the severe factor",
        Unknown::Shift => "the shift",
    }
}

fn figures(question: &Question, rows: &[CompareRow]) -> CompareFigures {
    let arc = &question.profile.arc_mm;
    let column = |of: fn(&CompareRow) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let rms = |values: &[f64]| (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
    let measured = column(|row| row.measured_um);
    let worst = rows.iter().max_by(|a, b| a.difference_um.abs().total_cmp(&b.difference_um.abs()));
    CompareFigures {
        mean_deviation_um: mean_deviation(arc, &measured),
        simulated_mean_deviation_um: mean_deviation(arc, &column(|row| row.simulated_um)),
        roughness_um: roughness(arc, &measured, CUTOFF_MM),
        cutoff_mm: CUTOFF_MM,
        as_run_difference_um: rms(&column(|row| row.measured_um - row.as_run_um)),
        difference_um: rms(&column(|row| row.difference_um)),
        greatest_difference_um: worst.map_or(0.0, |row| row.difference_um.abs()),
        greatest_difference_radius_mm: worst.map_or(0.0, |row| row.radius_mm),
        uncertainty_um: question.uncertainty_um,
    }
}

fn warnings(fit: &FitRecord, figures: &CompareFigures, unsettled: Option<f64>) -> Vec<String> {
    let mut warnings = Vec::new();
    let blamed = fit.blamed.as_deref().unwrap_or("a value");
    match fit.stopped {
        FitStop::Converged => {}
        FitStop::AtBound if blamed == name(Unknown::Shift) => {
            warnings.push("the shift is as long as it may be: allow more with --shift-within, or check where the file's arc begins".to_owned());
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
    if let Some(uncertainty) = figures.uncertainty_um.filter(|u| figures.difference_um > NOT_DESCRIBED * u) {
        warnings.push(format!(
            "the difference, {:.3} µm (root mean square), is {:.1} times the uncertainty of the heights: the simulation does not \
             describe all of the profile, and the interval does not say how far off it is",
            figures.difference_um,
            figures.difference_um / uncertainty
        ));
    }
    warnings
}
