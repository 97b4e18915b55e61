//! Runs the samples on all threads and evaluates them.
//!
//! The scene as given is run first: its wear gives the places of the bands, and its verification by finite elements the relative errors
//! e of the fast model. With a factor u of its own, between 0 and 1, the error is part of the samples without further runs:
//!
//! ```text
//! y = y_model (1 + e (2 u − 1))
//! ```
//!
//! One u stands for all outputs, as their errors have one cause. Snapshots, error estimates and verification are left out of the samples;
//! where a life is asked for, their histories have [`MOMENTS`] moments.

use std::time::Instant;

use super::design::{Design, Matrix, ScoreCorrelation};
use super::distribution::Uncertain;
use super::life::{DepthLimit, Growth};
use super::record::{Band, FactorIndices, MODEL_ERROR, OutputRecord, Quantiles, SampleRow, UncertaintyRecord};
use crate::evaluate::output::SummaryOutput;
use crate::report::html::reading::capitalised;
use crate::report::unit;
use crate::runs;
use crate::scene::Resolved;
use crate::scene::loaded::LoadedScene;
use crate::spread::spread;
use crate::varied_scene::{VariedScene, in_words, one_line};
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::reference::sobol_indices::indices;
use gearwear_bodies::reference::statistics::{SHARES, mean, quantile, standard_deviation};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::figures;
use gearwear_physics::results::run::StopReason;
use gearwear_physics::results::worn_pair::{WearProfile, WornPair};

/// Number of moments of a history, evenly over the duration.
const MOMENTS: usize = 20;
/// Greatest number of places of a band over the flank.
const PLACES: usize = 160;
/// Least number of finished points for the results of an interrupted study.
pub const FEWEST_SAMPLES: usize = 8;

/// Question, resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledQuestion {
    pub uncertain: Vec<Uncertain>,
    /// How the keys are correlated, if they are.
    pub correlation: Option<ScoreCorrelation>,
    pub outputs: Vec<SummaryOutput>,
    pub limits: Vec<DepthLimit>,
    /// Points of the sequence.
    pub samples: usize,
    pub seed: u32,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UncertaintyStudyError {
    #[error("the scene as given cannot be run: {0}")]
    Nominal(String),
    #[error("none of {runs} samples has a result; the first says: {first}")]
    AllFailed { runs: usize, first: String },
    #[error("interrupted before {FEWEST_SAMPLES} samples were finished")]
    Interrupted,
}

/// Part of a run that is kept.
struct Ran {
    /// Each with the time until which it is known, where it is a life.
    outputs: Vec<(f64, f64)>,
    growths: Vec<Growth>,
    /// Wear at the places of the bands, for samples A and B only.
    wear_um: Option<PerGear<Vec<f32>>>,
}

type Row = Result<Ran, String>;

/// Inputs of the samples.
struct Samples<'a> {
    question: &'a SampledQuestion,
    varied: &'a VariedScene,
    nominal: &'a WornPair,
    places: &'a PerGear<Vec<f64>>,
    design: Design,
    /// Relative error of the model in each output, then in the depth of each limit; empty where none is known.
    errors: Vec<Option<f64>>,
}

impl Samples<'_> {
    /// Runs of a point.
    fn matrices(&self) -> Vec<Matrix> {
        let mixed = match self.question.correlation {
            None => self.question.uncertain.len(),
            Some(_) => 0,
        };
        [Matrix::A, Matrix::B].into_iter().chain((0..mixed).map(Matrix::Mixed)).collect()
    }

    fn has_model_error(&self) -> bool {
        self.design.factors > self.question.uncertain.len()
    }

    fn values(&self, point: usize, matrix: Matrix) -> Vec<f64> {
        let u = self.design.sample(point, matrix);
        self.question.uncertain.iter().zip(u).map(|(one, u)| one.distribution.quantile(u)).collect()
    }

    fn run(&self, point: usize, matrix: Matrix, observer: &dyn Observer) -> Option<Row> {
        let values = self.values(point, matrix);
        let run = guarded(|| -> Result<WornPair, String> {
            let keys = self.question.uncertain.iter().map(|one| one.key.as_str());
            let values = values.iter().map(|&value| toml::Value::Float(value));
            worn(self.varied, keys.zip(values), !self.question.limits.is_empty(), observer)
        });
        match run.unwrap_or_else(|said| Err(format!("a defect of the program: {said}"))) {
            Ok(found) if found.summary.stopped == StopReason::Interrupted => None,
            Ok(found) => Some(self.kept(&found, matrix)),
            Err(_) if observer.interrupted() => None,
            Err(error) => Some(Err(one_line(&error))),
        }
    }

    fn kept(&self, found: &WornPair, matrix: Matrix) -> Row {
        Ok(Ran {
            outputs: outputs_of(self.question, found)?,
            growths: self.question.limits.iter().map(|limit| limit.growth(&found.history)).collect(),
            wear_um: matches!(matrix, Matrix::A | Matrix::B)
                .then(|| PerGear::from_fn(|gear| at(&found.flanks[gear], &self.places[gear]))),
        })
    }

    /// 1 + e (2 u − 1) of each output and limit.
    fn times(&self, point: usize, matrix: Matrix) -> (Option<f64>, Vec<f64>) {
        let u = self.has_model_error().then(|| self.design.sample(point, matrix)[self.design.factors - 1]);
        let place = u.map(|u| 2.0 * u - 1.0);
        (place, self.errors.iter().map(|error| 1.0 + error.unwrap_or(0.0) * place.unwrap_or(0.0)).collect())
    }

    /// The outputs and lives of a run as those of a sample, the error of the model included, and until when each is known.
    fn figures(&self, ran: &Ran, point: usize, matrix: Matrix) -> Vec<(f64, f64)> {
        let (_, times) = self.times(point, matrix);
        let (of_outputs, of_limits) = times.split_at(self.question.outputs.len());
        let outputs = ran.outputs.iter().zip(of_outputs).map(|((value, until), times)| (value * times, until * times));
        let limits = self.question.limits.iter().zip(&ran.growths).zip(of_limits);
        outputs.chain(limits.map(|((limit, growth), times)| limit.life(growth, *times))).collect()
    }

    /// Figure number `figure` of a sample, and until when it is known; `None` where its run has none.
    fn figure(&self, rows: &[&[Row]], point: usize, matrix: Matrix, figure: usize) -> Option<(f64, f64)> {
        let row = match matrix {
            Matrix::B => 1,
            Matrix::Mixed(factor) if factor < self.question.uncertain.len() => 2 + factor,
            // The error of the model takes no runs of its own: those of A stand for them.
            Matrix::A | Matrix::Mixed(_) => 0,
        };
        let ran = rows[point].get(row)?.as_ref().ok()?;
        Some(self.figures(ran, point, matrix)[figure]).filter(|(value, _)| !value.is_nan())
    }
}

impl Samples<'_> {
    fn row(&self, point: usize, matrix: Matrix, row: &Row) -> SampleRow {
        let question = self.question;
        SampleRow {
            point,
            matrix: match matrix {
                Matrix::A => "A".to_owned(),
                Matrix::B => "B".to_owned(),
                Matrix::Mixed(factor) => question.uncertain[factor].key.clone(),
            },
            values: self.values(point, matrix),
            model_error: self.times(point, matrix).0,
            outputs: match row {
                Ok(ran) => {
                    let figures = self.figures(ran, point, matrix);
                    figures.into_iter().map(|(value, _)| Some(value).filter(|value| value.is_finite())).collect()
                }
                Err(_) => vec![None; question.outputs.len() + question.limits.len()],
            },
            error: row.as_ref().err().cloned(),
        }
    }
}

/// Runs the scene with these values.
fn worn<'a>(
    varied: &VariedScene,
    values: impl IntoIterator<Item = (&'a str, toml::Value)>,
    with_history: bool,
    observer: &dyn Observer,
) -> Result<WornPair, String> {
    let mut resolved = varied.resolved(values).map_err(|problems| in_words(&problems))?;
    varied.inputs_belong_to(&resolved)?;
    if with_history {
        take_moments(&mut resolved);
    }
    varied.carry_out(resolved, observer, runs::worn_pair)
}

/// Sets [`MOMENTS`] moments of the history, evenly over the duration.
fn take_moments(resolved: &mut Resolved) {
    let operation = &mut resolved.scene.operation;
    let moments = (1..=MOMENTS).map(|number| operation.pinion_revolutions * number as f64 / MOMENTS as f64);
    operation.snapshots_revolutions = moments.collect();
}

/// Each output with the time until which it is known: a life to a limit that is not reached is infinite.
fn outputs_of(question: &SampledQuestion, found: &WornPair) -> Result<Vec<(f64, f64)>, String> {
    let summary = serde_json::to_value(&found.summary).map_err(|error| error.to_string())?;
    let outputs = question.outputs.iter().map(|output| match (output.of(&summary), output.at_least(&summary)) {
        (None, Some(at_least)) => (f64::INFINITY, at_least),
        (value, _) => (value.unwrap_or(f64::NAN), value.unwrap_or(f64::NAN)),
    });
    Ok(outputs.collect())
}

/// Wear at these radii, even between the points; 0 outside them.
fn at(profile: &WearProfile, radii: &[f64]) -> Vec<f32> {
    let (radius, wear) = (&profile.radius_mm, &profile.wear_um);
    let values = radii.iter().map(|&r| {
        let above = radius.partition_point(|&point| point < r);
        let value = match (above.checked_sub(1), radius.get(above)) {
            (Some(below), Some(&high)) => {
                let part = (r - radius[below]) / (high - radius[below]);
                wear[below] + part * (wear[above] - wear[below])
            }
            (None, Some(&high)) if high == r => wear[above],
            _ => 0.0,
        };
        value as f32
    });
    values.collect()
}

/// Places of a band: points of the active profile, thinned.
fn places(profile: &WearProfile) -> Vec<f64> {
    let [low, high] = profile.active_mm;
    let active: Vec<f64> = profile.radius_mm.iter().copied().filter(|r| (low..=high).contains(r)).collect();
    let every = active.len().div_ceil(PLACES).max(1);
    active.into_iter().step_by(every).collect()
}

/// Runs the study; where it is interrupted, of the points that were finished.
pub fn run(
    scene: &LoadedScene,
    question: &SampledQuestion,
    threads: usize,
    observer: &dyn Observer,
) -> Result<UncertaintyRecord, UncertaintyStudyError> {
    let start = Instant::now();
    let varied =
        VariedScene::new(scene, false).map_err(|problems| UncertaintyStudyError::Nominal(in_words(&problems)))?;
    let nominal = nominal(scene, &varied, question, observer)?;
    let total = &nominal.summary.error.total;
    let paths = question.outputs.iter().map(|output| output.path.as_str());
    let known = paths.chain(question.limits.iter().map(|limit| limit.output)).map(figures::find);
    let errors: Vec<Option<f64>> = known.map(|figure| figure?.error(total)).collect();
    let factors = question.uncertain.len() + usize::from(errors.iter().any(Option::is_some));
    let places = PerGear::from_fn(|gear| places(&nominal.flanks[gear]));
    let correlation = question.correlation.as_ref().map(|correlation| correlation.lower.clone());
    let design = Design { factors, seed: question.seed, correlation };
    let samples = Samples { question, varied: &varied, nominal: &nominal, places: &places, design, errors };

    let matrices = samples.matrices();
    let tasks: Vec<(usize, usize)> =
        (0..question.samples).flat_map(|point| (0..matrices.len()).map(move |matrix| (point, matrix))).collect();
    let mut rows: Vec<Option<Row>> = tasks.iter().map(|_| None).collect();
    let (mut done, mut failed) = (0, 0);
    spread(
        &tasks,
        threads.max(1),
        observer,
        |&(point, matrix), within| Some(((point, matrix), samples.run(point, matrices[matrix], within)?)),
        |((point, matrix), row)| {
            done += 1;
            failed += usize::from(row.is_err());
            let beside = if failed == 0 { String::new() } else { format!(", {failed} failed") };
            observer.counted(done, tasks.len(), "samples", &beside);
            rows[point * matrices.len() + matrix] = Some(row);
            true
        },
    );
    let whole: Vec<Row> = rows.into_iter().map_while(|row| row).collect();
    let points = whole.len() / matrices.len();
    if points < question.samples.min(FEWEST_SAMPLES) {
        return Err(UncertaintyStudyError::Interrupted);
    }
    let rows: Vec<&[Row]> = whole.chunks_exact(matrices.len()).collect();
    record(scene, &samples, &matrices, &rows, threads, start)
}

/// The scene as given, verified where it does not refuse that.
fn nominal(
    scene: &LoadedScene,
    varied: &VariedScene,
    question: &SampledQuestion,
    observer: &dyn Observer,
) -> Result<WornPair, UncertaintyStudyError> {
    observer.stage("the scene as given");
    let run = guarded(|| -> Result<WornPair, String> {
        let mut resolved = varied.resolved([]).map_err(|problems| in_words(&problems))?;
        resolved.scene.verify = scene.scene().verify;
        if !question.limits.is_empty() {
            take_moments(&mut resolved);
        }
        varied.carry_out(resolved, observer, runs::worn_pair)
    });
    let run = run.unwrap_or_else(|said| Err(format!("a defect of the program: {said}")));
    match run {
        Ok(found) if found.summary.stopped == StopReason::Interrupted => Err(UncertaintyStudyError::Interrupted),
        Ok(found) => Ok(found),
        Err(_) if observer.interrupted() => Err(UncertaintyStudyError::Interrupted),
        Err(error) => Err(UncertaintyStudyError::Nominal(one_line(&error))),
    }
}

fn record(
    scene: &LoadedScene,
    samples: &Samples<'_>,
    matrices: &[Matrix],
    rows: &[&[Row]],
    threads: usize,
    start: Instant,
) -> Result<UncertaintyRecord, UncertaintyStudyError> {
    let question = samples.question;
    let mut failures = rows.iter().flat_map(|row| row.iter()).filter_map(|row| row.as_ref().err());
    let (runs, failed) = (rows.iter().map(|row| row.len()).sum(), failures.clone().count());
    let first_failure = failures.next().cloned();
    if let (true, Some(first)) = (failed == runs, &first_failure) {
        return Err(UncertaintyStudyError::AllFailed { runs, first: first.clone() });
    }
    let figures = question.outputs.len() + question.limits.len();
    Ok(UncertaintyRecord {
        title: scene.resolved.title().to_owned(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: scene.resolved.scene_hash(),
        uncertain: question.uncertain.clone(),
        limits: question.limits.clone(),
        correlation: question
            .correlation
            .as_ref()
            .map(|correlation| correlation.matrix.row_iter().map(|row| row.iter().copied().collect()).collect()),
        seed: question.seed,
        samples_asked: question.samples,
        samples: rows.len(),
        runs,
        failed,
        first_failure,
        model_error_how: samples.nominal.summary.error.total.how.clone(),
        outputs: (0..figures).map(|figure| output_record(samples, rows, figure)).collect(),
        bands: PerGear::from_fn(|gear| {
            let ran = rows.iter().flat_map(|row| &row[..2]).filter_map(|row| row.as_ref().ok()?.wear_um.as_ref());
            let wear: Vec<&[f32]> = ran.map(|wear| wear[gear].as_slice()).collect();
            band(&samples.places[gear], &samples.nominal.flanks[gear], &wear)
        }),
        threads,
        wall_s: start.elapsed().as_secs_f64(),
        scene_toml: scene.given.text.clone(),
        rows: sample_rows(samples, matrices, rows),
    })
}

/// Name, meaning and unit of a figure, or of the life to a limit.
fn named(samples: &Samples<'_>, figure: usize) -> [String; 3] {
    let outputs = &samples.question.outputs;
    let limit = figure.checked_sub(outputs.len()).map(|number| &samples.question.limits[number]);
    let name = limit.map_or_else(|| outputs[figure].path.as_str(), |limit| limit.output);
    let known = figures::find(name);
    let heading = known.map_or_else(|| name.to_owned(), |known| capitalised(&known.heading));
    let Some(limit) = limit else { return [name.to_owned(), heading, unit::of(name).unwrap_or_default().to_owned()] };
    let unit = if samples.nominal.summary.hours.is_some() { "h" } else { "revolutions" };
    let depth_um = limit.depth_um;
    [format!("life.{name}={depth_um}"), format!("Life until {depth_um} µm: {heading}"), unit.to_owned()]
}

fn output_record(samples: &Samples<'_>, rows: &[&[Row]], figure: usize) -> OutputRecord {
    let question = samples.question;
    let limit = figure.checked_sub(question.outputs.len()).map(|number| &question.limits[number]);
    let known: Vec<(f64, f64)> = (0..rows.len())
        .flat_map(|point| [Matrix::A, Matrix::B].map(|matrix| samples.figure(rows, point, matrix, figure)))
        .flatten()
        .collect();
    let mut sorted: Vec<f64> = known.iter().map(|known| known.0).collect();
    sorted.sort_by(f64::total_cmp);
    let censored = known.iter().filter(|(value, _)| value.is_infinite());
    // A life known only to be longer than t gives no quantiles above t.
    let until = censored.clone().map(|known| known.1).fold(f64::INFINITY, f64::min);
    let censored = censored.count();
    let [p05, p25, p50, p75, p95] =
        SHARES.map(|share| quantile(&sorted, share).filter(|value| censored == 0 || *value <= until));
    let complete = censored == 0 && !sorted.is_empty();
    let [output, meaning, unit] = named(samples, figure);
    let is_life = limit.is_some() || output.starts_with("life.");
    let nominal = match limit {
        None => outputs_of(question, samples.nominal).ok().map(|values| values[figure].0),
        Some(limit) => Some(limit.life(&limit.growth(&samples.nominal.history), 1.0).0),
    };
    let found = match (&question.correlation, censored) {
        (Some(_), _) => Err("the keys are correlated: no part of the variance belongs to one of them".to_owned()),
        (None, 1..) => Err("some lives are longer than their duration".to_owned()),
        (None, 0) => factor_indices(samples, rows, figure),
    };
    OutputRecord {
        output,
        meaning,
        unit,
        nominal: nominal.filter(|value| value.is_finite()),
        model_error: samples.errors[figure],
        samples: sorted.len(),
        censored: is_life.then(|| censored as f64 / sorted.len().max(1) as f64),
        mean: complete.then(|| mean(sorted.iter().copied())),
        standard_deviation: complete.then(|| standard_deviation(&sorted)).flatten(),
        quantiles: Quantiles { p05, p25, p50, p75, p95 },
        no_indices_because: found.as_ref().err().cloned(),
        indices: found.ok(),
        sorted,
    }
}

/// Indices of a figure, over the points all of whose runs have it.
fn factor_indices(samples: &Samples<'_>, rows: &[&[Row]], figure: usize) -> Result<Vec<FactorIndices>, String> {
    let factors = samples.design.factors;
    let (mut a, mut b) = (Vec::new(), Vec::new());
    let mut mixed = vec![Vec::new(); factors];
    for point in 0..rows.len() {
        let matrices = [Matrix::A, Matrix::B].into_iter().chain((0..factors).map(Matrix::Mixed));
        let values: Option<Vec<f64>> =
            matrices.map(|matrix| Some(samples.figure(rows, point, matrix, figure)?.0)).collect();
        if let Some([of_a, of_b, of_mixed @ ..]) = values.as_deref() {
            a.push(*of_a);
            b.push(*of_b);
            mixed.iter_mut().zip(of_mixed).for_each(|(all, value)| all.push(*value));
        }
    }
    let seed = u64::from(samples.question.seed).wrapping_add(figure as u64);
    let found = indices(&a, &b, &mixed, seed).ok_or_else(|| match a.len() {
        0 | 1 => "too few samples have it".to_owned(),
        _ => "it does not vary".to_owned(),
    })?;
    let names = samples.question.uncertain.iter().map(|one| one.key.as_str()).chain([MODEL_ERROR]);
    let both = found.first.into_iter().zip(found.total);
    Ok(names.zip(both).map(|(name, (first, total))| FactorIndices { factor: name.to_owned(), first, total }).collect())
}

fn band(places: &[f64], nominal: &WearProfile, wear: &[&[f32]]) -> Band {
    let mut quantiles_um = [const { Vec::new() }; 5];
    for place in 0..places.len() {
        let mut values: Vec<f64> = wear.iter().map(|wear| f64::from(wear[place])).collect();
        values.sort_by(f64::total_cmp);
        for (all, share) in quantiles_um.iter_mut().zip(SHARES) {
            all.push(quantile(&values, share).unwrap_or(f64::NAN));
        }
    }
    let nominal_um = at(nominal, places).into_iter().map(f64::from).collect();
    Band { radius_mm: places.to_vec(), nominal_um, quantiles_um }
}

fn sample_rows(samples: &Samples<'_>, matrices: &[Matrix], rows: &[&[Row]]) -> Vec<SampleRow> {
    let mut sample_rows = Vec::new();
    for (point, row) in rows.iter().enumerate() {
        sample_rows.extend(matrices.iter().zip(*row).map(|(&matrix, row)| samples.row(point, matrix, row)));
    }
    sample_rows
}
