//! Runs the samples on all threads and evaluates them.
//!
//! The scene as given is run first: its wear gives the places of the bands, and its verification by finite elements its relative errors e. To
//! these the difference d of a fast model is added, where the samples are run on one ([`super::fast_model`]). With a factor u of its own,
//! between 0 and 1, the error is part of the samples without further runs:
//!
//! ```text
//! y = y_model (1 + (e + d) (2 u − 1))
//! ```
//!
//! One u stands for all outputs, as their errors have one cause. Once a [response surface](super::response_surface) says what the other runs would, it
//! stands for them. Finished runs are kept in a journal, and a study that was stopped goes on with those that are missing.

use std::collections::BTreeSet;
use std::time::Instant;

use super::bands::{Places, bands, places_of, wear_at};
use super::design::Matrix;
use super::fast_model::{SampledScene, SampledSurface};
use super::kept::{KeptRun, Ran, SampledStudy};
use super::record::{
    FactorIndices, MODEL_ERROR, OutputRecord, Quantiles, ReadOffSamples, SampleRow, UncertaintyRecord,
};
use super::response_surface::{self, SampleSurfaces};
use super::sampled_run::{FEWEST_SAMPLES, SampledQuestion, UncertaintyStudyError, outputs_of, run_of};
use super::sampling::{INDEPENDENT, Sampling};
use super::shared_runs;
use crate::evaluate::figure;
use crate::journal::{Journal, RowKeeper};
use crate::report::html::reading::capitalised;
use crate::runs;
use crate::scene::loaded::SceneError;
use crate::scene::opened::{EachMesh, OpenedScene};
use crate::spread::{seconds_of_a_run, spread};
use crate::varied_scene::{StudiedRun, VariedScene};
use gearwear_bodies::reference::sobol_indices::indices;
use gearwear_bodies::reference::statistics::{SHARES, mean, quantile, standard_deviation};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;

type Row = Result<Ran, String>;

/// Fewest runs for each that is timed before.
const RUNS_PER_TIMED: usize = 10;

/// Inputs of the samples.
struct Samples<'a> {
    question: &'a SampledQuestion,
    sampling: &'a Sampling<'a>,
    varied: &'a VariedScene,
    nominal: &'a StudiedRun,
    places: &'a Places,
    /// Relative error of the scene as given in each output, then in the depth of each limit; `None` where it is not known.
    errors: Vec<Option<f64>>,
    /// Factor to the figures of a fast model; empty where the samples are not on one.
    corrections: &'a [f64],
    /// Relative difference that is left then; empty likewise.
    differences: &'a [f64],
    /// Bound of the relative error that the samples vary, of each figure; `None` where none is known.
    bounds: Vec<Option<f64>>,
}

impl Samples<'_> {
    fn has_model_error(&self) -> bool {
        self.bounds.iter().any(Option::is_some)
    }

    /// Runs of `groups`, which share a run each, those with any of the samples `now` of which the journal does not have all. `in_all` are the samples that are to
    /// be run, as far as that is known.
    fn run_groups(
        &self,
        groups: &[Vec<usize>],
        (now, in_all): (impl Fn(usize) -> bool, impl Fn(usize) -> bool),
        journal: &mut Journal<SampledStudy>,
        threads: usize,
        observer: &dyn Observer,
    ) -> Result<(), UncertaintyStudyError> {
        let rows = &journal.contents.rows;
        let asked: BTreeSet<usize> = (0..self.sampling.total()).filter(|&number| in_all(number)).collect();
        let mut left: BTreeSet<usize> = asked.iter().copied().filter(|number| !rows.contains_key(number)).collect();
        // A journal that ended within a group has some of its samples, and a response surface is fitted to all of them.
        let is_asked = |group: &&Vec<usize>| {
            group.iter().any(|&number| now(number)) && group.iter().any(|number| left.contains(number))
        };
        let tasks: Vec<&Vec<usize>> = groups.iter().filter(is_asked).collect();
        let has_failed = |row: &KeptRun| row.ran.is_err() && asked.contains(&row.number);
        let mut failed: BTreeSet<usize> = rows.values().filter(|row| has_failed(row)).map(|row| row.number).collect();
        let tell = |row: &KeptRun| {
            left.remove(&row.number);
            if has_failed(row) {
                failed.insert(row.number);
            }
            let beside = if failed.is_empty() { String::new() } else { format!(", {} failed", failed.len()) };
            observer.counted(asked.len() - left.len(), asked.len(), "samples", &beside);
        };
        let mut kept = RowKeeper { journal, tell, error: None };
        let run = |group: &&Vec<usize>, within: &dyn Observer| self.run_group(group, within);
        spread(&tasks, threads.max(1), observer, run, |rows| rows.into_iter().all(|row| kept.keep(row)));
        kept.error.map_or(Ok(()), |error| Err(error.into()))
    }

    /// Runs with these numbers, in one where they can share it; `None` where it was interrupted.
    fn run_group(&self, group: &[usize], observer: &dyn Observer) -> Option<Vec<KeptRun>> {
        // The curve is of the flanks at the end of a run alone.
        let shares = group.len() > 1 && !self.question.reads_torque_curve();
        if let Some(pairs) = shares.then(|| self.shared_run(group, observer)).flatten() {
            let both = group.iter().zip(pairs);
            return Some(both.map(|(&number, pair)| KeptRun { number, ran: self.kept(&pair, number) }).collect());
        }
        let alone = group.iter().map(|&number| Some(KeptRun { number, ran: self.run(number, observer)? }));
        alone.collect()
    }

    /// The runs of samples that differ in their wear coefficients alone; `None` where each has to be run by itself.
    fn shared_run(&self, group: &[usize], observer: &dyn Observer) -> Option<Vec<StudiedRun>> {
        let scenes =
            group.iter().map(|&number| self.varied.resolved(self.keys_with(&self.sampling.values(number))).ok());
        let scenes = scenes.collect::<Option<Vec<_>>>()?;
        let (run, revolutions) = shared_runs::shared(&scenes)?;
        self.varied.inputs_belong_to(&run).ok()?;
        let found = guarded(|| {
            self.varied.carry_out(&run, observer, |mesh, scene, observer| {
                let revolutions = revolutions.of(mesh).map_or(&[][..], Vec::as_slice);
                runs::worn_pairs(scene, revolutions, observer)
            })
        });
        let mut found = found.ok()?.ok()?.map(Vec::into_iter);
        let runs = scenes.iter().map(|scene| {
            let pairs = EachMesh::for_each(scene.kind(), |mesh| found.of_mut(mesh)?.next())?;
            StudiedRun::of(scene, pairs)
        });
        runs.collect()
    }

    /// The uncertain keys with these values.
    fn keys_with(&self, values: &[f64]) -> impl Iterator<Item = (&str, toml::Value)> {
        let keys = self.question.uncertain.iter().map(|one| one.key.as_str());
        keys.zip(values.iter().map(|&value| toml::Value::Float(value)).collect::<Vec<_>>())
    }

    fn run(&self, number: usize, observer: &dyn Observer) -> Option<Row> {
        let values = self.sampling.values(number);
        match run_of(self.varied, self.keys_with(&values), self.question, false, observer) {
            Ok(found) => Some(self.kept(&found, number)),
            Err(UncertaintyStudyError::Interrupted) => None,
            Err(UncertaintyStudyError::Run(reason)) => Some(Err(reason)),
            Err(other) => Some(Err(other.to_string())),
        }
    }

    fn kept(&self, found: &StudiedRun, number: usize) -> Row {
        let keeps_wear = self.sampling.is_independent(number, usize::MAX);
        Ok(Ran {
            outputs: outputs_of(self.question, found)?,
            growths: self.question.limits.iter().map(|limit| limit.growth(found)).collect(),
            wear_um: keeps_wear.then(|| wear_at(self.places, found)).flatten(),
        })
    }

    /// c (1 + (e + d) (2 u − 1)) of each output and limit.
    fn times(&self, point: usize, matrix: Matrix) -> (Option<f64>, Vec<f64>) {
        let u =
            self.has_model_error().then(|| self.sampling.design.sample(point, matrix)[self.question.uncertain.len()]);
        let place = u.map(|u| 2.0 * u - 1.0);
        let corrections = self.corrections.iter().copied().chain(std::iter::repeat(1.0));
        let of_each = self.bounds.iter().zip(corrections);
        (
            place,
            of_each
                .map(|(bound, correction)| correction * (1.0 + bound.unwrap_or(0.0) * place.unwrap_or(0.0)))
                .collect(),
        )
    }

    /// The outputs and lives of a run as those of a sample, the error of the model included, and until when each is known.
    fn figures(&self, ran: &Ran, point: usize, matrix: Matrix) -> Vec<(f64, f64)> {
        let (_, times) = self.times(point, matrix);
        let (of_outputs, of_limits) = times.split_at(self.question.outputs.len());
        let outputs = ran.outputs.iter().zip(of_outputs).map(|(output, times)| output.times(*times));
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
    fn row(&self, number: usize, row: &Row, is_read_off: bool) -> SampleRow {
        let question = self.question;
        let (point, matrix) = self.sampling.of_number(number);
        SampleRow {
            point,
            matrix: match matrix {
                Matrix::A => "A".to_owned(),
                Matrix::B => "B".to_owned(),
                Matrix::Mixed(factor) => question.uncertain[factor].key.clone(),
            },
            values: self.sampling.values(number),
            is_read_off,
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

/// Bounds e + d of errors, of those that are known.
fn bounds(errors: &[Option<f64>], differences: &[f64]) -> Vec<Option<f64>> {
    let of_each = errors.iter().enumerate().map(|(figure, error)| match (error, differences.get(figure)) {
        (None, None) => None,
        (error, difference) => Some(error.unwrap_or(0.0) + difference.copied().unwrap_or(0.0)),
    });
    of_each.collect()
}

/// A study whose scene as given is run, and the surface of its samples chosen.
pub struct PreparedStudy<'a> {
    scene: &'a OpenedScene,
    sampling: Sampling<'a>,
    nominal: StudiedRun,
    sampled: SampledScene,
    places: Places,
    begun: Instant,
}

impl<'a> PreparedStudy<'a> {
    /// Prepares the study of `question` on `scene`.
    ///
    /// # Errors
    /// A scene that cannot be run.
    pub fn new(
        scene: &'a OpenedScene,
        question: &'a SampledQuestion,
        observer: &dyn Observer,
    ) -> Result<Self, UncertaintyStudyError> {
        let begun = Instant::now();
        let given = SampledScene::as_given(scene, question, String::new())?;
        let sampling = Sampling::of(question);
        observer.stage("the scene as given");
        let nominal = run_of(&given.varied, [], question, scene.verifies(), observer)?;
        let runs = sampling.groups(&given.varied).len();
        let sampled = SampledScene::choose(scene, given, question, (&nominal, runs), observer)?;
        let places = places_of(&nominal);
        Ok(Self { scene, sampling, nominal, sampled, places, begun })
    }

    /// Study that a journal keeps the runs of.
    ///
    /// # Errors
    /// A scene whose text cannot be read again.
    pub fn study(&self) -> Result<SampledStudy, SceneError> {
        let places = self.places.as_ref().map(|of| of.as_ref().map(Vec::len));
        SampledStudy::of(self.scene, self.sampling.question, &self.sampled.surface.surface, places)
    }

    /// Time that the runs which `journal` does not have take on `threads` threads, s, by runs of the scene as given, one on each thread; `None` where
    /// these would take more than a tenth of it, or fail.
    pub fn seconds_left(
        &self,
        journal: &Journal<SampledStudy>,
        threads: usize,
        observer: &dyn Observer,
    ) -> Option<f64> {
        let rows = &journal.contents.rows;
        let groups = self.sampling.groups(&self.sampled.varied);
        let left = groups.iter().filter(|group| group.iter().any(|number| !rows.contains_key(number))).count();
        if left < RUNS_PER_TIMED * threads {
            return None;
        }
        let of_a_run = seconds_of_a_run(threads, observer, |within| {
            run_of(&self.sampled.varied, [], self.sampling.question, false, within).ok().map(|_| ())
        });
        of_a_run.map(|seconds| left as f64 * seconds)
    }

    /// Runs what `journal` does not have of the study, and evaluates it; where it is interrupted, the points that were finished. Each time that twice
    /// as many points are finished, `earlier` gets the record of those.
    ///
    /// # Errors
    /// No finished sample, a journal that cannot be written.
    pub fn run(
        self,
        journal: &mut Journal<SampledStudy>,
        threads: usize,
        observer: &dyn Observer,
        mut earlier: impl FnMut(&UncertaintyRecord),
    ) -> Result<UncertaintyRecord, UncertaintyStudyError> {
        let Self { scene, sampling, nominal, sampled, places, begun } = self;
        let question = sampling.question;
        let totals = nominal.total_errors();
        let paths = question.outputs.iter().map(|output| output.path.as_str());
        let known =
            paths.chain(question.limits.iter().map(|limit| limit.output)).map(|name| figure::find(question.kind, name));
        let errors: Vec<Option<f64>> = known.map(|figure| figure?.error(&totals)).collect();
        let samples = Samples {
            question,
            sampling: &sampling,
            varied: &sampled.varied,
            nominal: &nominal,
            places: &places,
            bounds: bounds(&errors, &sampled.differences),
            errors,
            corrections: &sampled.corrections,
            differences: &sampled.differences,
        };
        let groups = sampling.groups(&sampled.varied);
        // Of each point A and B at least, from the first on.
        let finished = |journal: &Journal<SampledStudy>, most: usize, surfaces: Surfaces<'_, '_>| -> Vec<Vec<Row>> {
            let row = |number: usize| match surfaces {
                Ok(surfaces) if surfaces.reads_off(number) => Some(surfaces.read_off(number)),
                _ => journal.contents.rows.get(&number).map(|kept| kept.ran.clone()),
            };
            let of_point = |point: usize| sampling.of_point(point).map_while(row).collect::<Vec<Row>>();
            (0..most).map(of_point).take_while(|rows| rows.len() >= INDEPENDENT).collect()
        };
        let evaluated = |whole: &[Vec<Row>], surfaces: Surfaces<'_, '_>| {
            let rows: Vec<&[Row]> = whole.iter().map(Vec::as_slice).collect();
            let surface = sampled.surface.clone();
            let record = record(scene, &samples, &rows, surfaces)?;
            Ok(UncertaintyRecord { surface, threads, wall_s: begun.elapsed().as_secs_f64(), ..record })
        };
        // Quantiles first, of twice as many points each time; what Sobol indices need besides comes last. A response surface ends both.
        let (variables, because) = match question.run_all {
            true => (Vec::new(), "all samples are asked to be run".to_owned()),
            false => (response_surface::variables(&sampling), response_surface::too_few()),
        };
        let mut surfaces = Err(because);
        let before = finished(journal, question.samples, surfaces.as_ref()).len();
        let doubled = std::iter::successors(Some(FEWEST_SAMPLES), |points| points.checked_mul(2));
        let stages = doubled.take_while(|points| *points < question.samples).chain([question.samples]);
        for points in stages {
            let now = |number: usize| sampling.is_independent(number, points);
            samples.run_groups(&groups, (now, |_| true), journal, threads, observer)?;
            let whole = finished(journal, points, surfaces.as_ref());
            let is_last = points == question.samples && sampling.matrices.len() == INDEPENDENT;
            if whole.len() < points || is_last {
                break;
            }
            if points > before && whole.iter().flatten().any(Result::is_ok) {
                earlier(&evaluated(&whole, surfaces.as_ref())?);
            }
            if !question.run_all {
                let rows = &journal.contents.rows;
                let ran = |number: usize| Some(&rows.get(&number)?.ran);
                surfaces = SampleSurfaces::fit(&sampling, &variables, &groups, points, ran);
            }
            if surfaces.is_ok() {
                break;
            }
        }
        let is_run = |number: usize| !is_read_off(surfaces.as_ref(), number);
        samples.run_groups(&groups, (is_run, is_run), journal, threads, observer)?;
        let whole = finished(journal, question.samples, surfaces.as_ref());
        if whole.len() < question.samples.min(FEWEST_SAMPLES) {
            return Err(UncertaintyStudyError::Interrupted);
        }
        evaluated(&whole, surfaces.as_ref())
    }
}

/// Surfaces that samples are read off, or why there are none.
type Surfaces<'s, 'q> = Result<&'s SampleSurfaces<'q>, &'s String>;

fn is_read_off(surfaces: Surfaces<'_, '_>, number: usize) -> bool {
    surfaces.is_ok_and(|surfaces| surfaces.reads_off(number))
}

fn record(
    scene: &OpenedScene,
    samples: &Samples<'_>,
    rows: &[&[Row]],
    surfaces: Surfaces<'_, '_>,
) -> Result<UncertaintyRecord, UncertaintyStudyError> {
    let question = samples.question;
    let mut failures = rows.iter().flat_map(|row| row.iter()).filter_map(|row| row.as_ref().err());
    let (runs, failed) = (rows.iter().map(|row| row.len()).sum(), failures.clone().count());
    let first_failure = failures.next().cloned();
    if let (true, Some(first)) = (failed == runs, &first_failure) {
        return Err(UncertaintyStudyError::AllFailed { runs, first: first.clone() });
    }
    let figures = question.outputs.len() + question.limits.len();
    let numbered = rows.iter().enumerate().flat_map(|(point, rows)| samples.sampling.of_point(point).zip(*rows));
    let of_samples: Vec<SampleRow> =
        numbered.map(|(number, row)| samples.row(number, row, is_read_off(surfaces, number))).collect();
    let errors = surfaces.map(SampleSurfaces::errors).unwrap_or_default();
    let output = |figure: usize| OutputRecord {
        response_surface_error: errors.get(figure).copied().flatten(),
        ..output_record(samples, rows, figure)
    };
    Ok(UncertaintyRecord {
        title: scene.title().to_owned(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: scene.scene_hash(),
        uncertain: question.uncertain.clone(),
        limits: question.limits.clone(),
        correlation: question
            .correlation
            .as_ref()
            .map(|correlation| correlation.matrix.row_iter().map(|row| row.iter().copied().collect()).collect()),
        seed: question.seed,
        samples_asked: question.samples,
        runs_asked: samples.sampling.total(),
        samples: rows.len(),
        runs,
        failed,
        first_failure,
        model_error_how: figure::how(&samples.nominal.total_errors()),
        outputs: (0..figures).map(output).collect(),
        bands: {
            let ran = rows.iter().flat_map(|row| &row[..INDEPENDENT]).filter_map(|row| row.as_ref().ok());
            bands(samples.places, samples.nominal, ran.filter_map(|ran| ran.wear_um.as_ref()))
        },
        threads: 0,
        wall_s: 0.0,
        surface: SampledSurface::default(),
        response_surface: surfaces.ok().map(|surfaces| {
            let [degree, wear_degree] = surfaces.degrees();
            let read_off = of_samples.iter().filter(|row| row.is_read_off).count();
            ReadOffSamples { run: runs - read_off, read_off, degree, wear_degree }
        }),
        no_response_surface_because: surfaces.err().cloned(),
        scene_toml: scene.given().text.clone(),
        rows: of_samples,
    })
}

/// Name, meaning and unit of a figure, or of the life to a limit.
fn named(samples: &Samples<'_>, figure: usize) -> [String; 3] {
    let outputs = &samples.question.outputs;
    let limit = figure.checked_sub(outputs.len()).map(|number| &samples.question.limits[number]);
    let name = limit.map_or_else(|| outputs[figure].path.as_str(), |limit| limit.output);
    let kind = samples.question.kind;
    let known = figure::find(kind, name);
    let heading = known.map_or_else(|| name.to_owned(), |known| capitalised(&known.heading));
    let Some(limit) = limit else {
        return [name.to_owned(), heading, figure::unit_of(kind, name).unwrap_or_default().to_owned()];
    };
    let unit = if samples.nominal.summary().hours().is_some() { "h" } else { "revolutions" };
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
    let is_life = limit.is_some() || question.outputs[figure].is_life();
    let nominal = match limit {
        None => outputs_of(question, samples.nominal).ok().map(|values| values[figure].times(1.0).0),
        Some(limit) => Some(limit.life(&limit.growth(samples.nominal), 1.0).0),
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
        surface_correction: samples.corrections.get(figure).copied(),
        surface_difference: samples.differences.get(figure).copied(),
        response_surface_error: None,
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
    let factors = samples.question.uncertain.len() + usize::from(samples.has_model_error());
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
