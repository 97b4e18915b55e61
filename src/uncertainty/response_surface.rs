//! Samples that are read off a response surface of the others.
//!
//! Figures mostly follow the keys smoothly, and a polynomial of a few dozen terms says of a sample what its own run would. Its variables are the values of the
//! keys, of lognormal ones their logarithms; it is fitted to the first samples, of [`FEWEST_RUNS`] runs at least. Each of these is then found without those
//! that share its run, and where the root mean square of what it is missed by is at most [`GREATEST_ERROR`] of the standard deviation, for all figures, the
//! other samples are read off. That is below what quantiles of some thousand samples scatter by, and leaves them and Sobol indices as they are. Samples
//! at which the surface has a leverage above 1, mostly beyond those that it is fitted to, are run (and count for none of these errors where they are left
//! out): there it would carry on what it knows of others. As those that are read off lie farther out than those that it is fitted to, they are missed by up to half
//! as much again.
//!
//! Of the degrees of about the least error the one is taken for which the fewest samples have to be run. Wear at the places of the bands has a surface of its own, of
//! the samples A and B and of any degree that will do; its errors are compared with the greatest standard deviation over the flank.

use std::collections::BTreeSet;

use nalgebra::DMatrix;

use super::distribution::{Distribution, Uncertain};
use super::kept::{Ran, ReadOutput};
use super::sampling::Sampling;
use crate::scene::opened::EachMesh;
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::reference::response_surface::ResponseSurface;
use gearwear_bodies::reference::statistics::standard_deviation;

/// Fewest runs that a surface is fitted to.
const FEWEST_RUNS: usize = 64;
/// Greatest root mean square error, over the standard deviation.
const GREATEST_ERROR: f64 = 0.05;
/// Greatest degree.
const MOST_DEGREE: usize = 8;
/// Fewest samples for each term.
const SAMPLES_PER_TERM: usize = 2;
/// Greatest leverage at a sample that is read off.
const GREATEST_LEVERAGE: f64 = 1.0;
/// Most further runs over those that the surface is fitted to: where more samples are beyond it, twice as many to fit are the better use.
const MOST_FURTHER: usize = 2;
/// Error below which others count alike.
const NEGLIGIBLE_ERROR: f64 = 0.01;
/// Ratio of the errors of two degrees that count alike.
const AS_GOOD: f64 = 1.5;
/// Standard deviation of values that differ by round-off, over the greatest.
const ROUND_OFF: f64 = 1e-9;

/// Surfaces of the samples.
pub(super) struct SampleSurfaces<'a> {
    sampling: &'a Sampling<'a>,
    /// Of all samples.
    variables: &'a [Vec<f64>],
    /// Samples that are run.
    run: BTreeSet<usize>,
    /// A run as its figures are ordered.
    like: Ran,
    figures: Surface,
    wear: Surface,
}

/// Surface of some columns.
struct Surface {
    surface: ResponseSurface,
    /// By sample and column.
    values: DMatrix<f64>,
    /// Root mean square error over the standard deviation, of each column.
    errors: Vec<f64>,
    /// Groups with samples that are not read off, by their index.
    beyond: BTreeSet<usize>,
}

/// Why samples cannot be read off a surface of some columns.
enum Misfit {
    /// Too many samples are beyond those that are run.
    Beyond,
    /// The error of this column is too great.
    Missed { column: usize, error: f64 },
}

impl Misfit {
    /// The reason in words; `name` is that of a column.
    fn of<'n>(&self, name: impl Fn(usize) -> &'n str) -> String {
        match *self {
            Self::Beyond => "too many samples lie beyond those that are run".to_owned(),
            Self::Missed { column, error } => format!(
                "a polynomial of the keys misses {} of samples that are left out by {:.0} % of the standard deviation, more than {:.0} %",
                name(column),
                100.0 * error,
                100.0 * GREATEST_ERROR
            ),
        }
    }
}

/// Samples, in groups that share a run, of which some are run.
struct Groups<'a> {
    all: &'a [Vec<usize>],
    /// Of all samples.
    variables: &'a [Vec<f64>],
    /// Groups that are run, by their index.
    run: &'a BTreeSet<usize>,
}

/// A sample that surfaces are fitted to.
struct FittedSample {
    /// Index of its group.
    group: usize,
    number: usize,
    /// By column.
    values: Vec<f64>,
}

impl<'a> SampleSurfaces<'a> {
    /// Surfaces fitted to the samples A and B of the first `points` and those that share runs with them, of which `ran` is all that is kept. `variables` are those
    /// of all samples.
    ///
    /// # Errors
    /// Why samples cannot be read off.
    pub(super) fn fit<'r>(
        sampling: &'a Sampling<'a>,
        variables: &'a [Vec<f64>],
        groups: &[Vec<usize>],
        points: usize,
        ran: impl Fn(usize) -> Option<&'r Result<Ran, String>>,
    ) -> Result<Self, String> {
        let is_first = |group: &Vec<usize>| group.iter().any(|&number| sampling.is_independent(number, points));
        let first: BTreeSet<usize> = (0..groups.len()).filter(|&group| is_first(&groups[group])).collect();
        if first.len() < FEWEST_RUNS {
            return Err(too_few());
        }
        // A group of points may go on beyond the last one asked for.
        let of_group = |&group: &usize| groups[group].iter().map(move |&number| (group, number));
        let numbers = first.iter().flat_map(of_group).filter(|(_, number)| *number < variables.len());
        let kept: Option<Vec<(usize, usize, &Ran)>> =
            numbers.map(|(group, number)| Some((group, number, ran(number)?.as_ref().ok()?))).collect();
        let kept = kept.ok_or("some samples failed")?;
        let like = kept[0].2.clone();
        let groups_run = Groups { all: groups, variables, run: &first };
        let with_figures =
            kept.iter().map(|&(group, number, ran)| Some(FittedSample { group, number, values: figures(ran, &like)? }));
        let with_figures: Option<Vec<FittedSample>> = with_figures.collect();
        let with_figures = with_figures.ok_or("some samples have figures that others do not have")?;
        let figures = groups_run
            .surface(&with_figures, |_| true, deviations, AS_GOOD)
            .map_err(|misfit| misfit.of(|column| name(sampling, &like, column)))?;
        let with_wear = kept.iter().filter_map(|&(group, number, ran)| {
            Some(FittedSample { group, number, values: columns_of(ran.wear_um.as_ref()?) })
        });
        let with_wear: Vec<FittedSample> = with_wear.collect();
        let flanks = flanks_of(like.wear_um.as_ref());
        let wear = groups_run
            .surface(
                &with_wear,
                |number| sampling.is_independent(number, usize::MAX),
                |values| greatest_by_flank(deviations(values), &flanks),
                f64::INFINITY,
            )
            .map_err(|misfit| misfit.of(|_| "the wear over the flanks"))?;
        let run: BTreeSet<usize> = first.iter().chain(&figures.beyond).chain(&wear.beyond).copied().collect();
        let run: BTreeSet<usize> = run.into_iter().flat_map(|group| groups[group].iter().copied()).collect();
        if (0..variables.len()).all(|number| run.contains(&number)) {
            return Err("no sample is left that would not be run".to_owned());
        }
        Ok(Self { sampling, variables, run, like, figures, wear })
    }

    /// Whether a sample is read off, and not run.
    pub(super) fn reads_off(&self, number: usize) -> bool {
        !self.run.contains(&number)
    }

    /// A sample that is read off.
    pub(super) fn read_off(&self, number: usize) -> Result<Ran, String> {
        let place = &self.variables[number];
        let no_number = || "the response surface has no value".to_owned();
        let mut values = self.figures.surface.at(place, &self.figures.values).ok_or_else(no_number)?.into_iter();
        let mut next = || values.next().unwrap_or(f64::NAN);
        let outputs =
            self.like.outputs.iter().map(|output| ReadOutput { value: output.value.map(|_| next()), ..*output });
        let outputs = outputs.collect();
        let growths =
            self.like.growths.iter().map(|growth| growth.iter().map(|_| (next(), next())).collect()).collect();
        let is_worn = self.sampling.is_independent(number, usize::MAX);
        let wear_um = match self.like.wear_um.as_ref().filter(|_| is_worn) {
            None => None,
            Some(like) => {
                let worn = self.wear.surface.at(place, &self.wear.values).ok_or_else(no_number)?;
                let mut worn = worn.into_iter().map(|value| value as f32);
                Some(like.as_ref().map(|of| of.as_ref().map(|flank| worn.by_ref().take(flank.len()).collect())))
            }
        };
        Ok(Ran { outputs, growths, wear_um })
    }

    /// Root mean square error of each output and of the depths of each limit at the end, over the standard deviation.
    pub(super) fn errors(&self) -> Vec<Option<f64>> {
        let mut errors = self.figures.errors.iter().copied();
        let outputs =
            self.like.outputs.iter().map(|output| output.value.and_then(|_| errors.next())).collect::<Vec<_>>();
        let limits = self.like.growths.iter().map(|growth| errors.by_ref().take(2 * growth.len()).last());
        outputs.into_iter().chain(limits).collect()
    }

    /// Total degree of the surface of the figures and of that of the wear.
    pub(super) fn degrees(&self) -> [usize; 2] {
        [&self.figures, &self.wear].map(|surface| surface.surface.degree())
    }
}

impl Groups<'_> {
    /// Surface of the columns of `fitted`, group by group, for those of all samples that `are_asked`; of the degrees for which few enough are beyond it, and
    /// whose error is at most `as_good` times the least, that with the fewest beyond. `scales` are what errors of the columns are compared with.
    fn surface(
        &self,
        fitted: &[FittedSample],
        are_asked: impl Fn(usize) -> bool,
        scales: impl Fn(&DMatrix<f64>) -> Vec<f64>,
        as_good: f64,
    ) -> Result<Surface, Misfit> {
        let width = fitted.first().map_or(0, |sample| sample.values.len());
        let values = DMatrix::from_fn(fitted.len(), width, |row, column| fitted[row].values[column]);
        let scales = scales(&values);
        let places: Vec<Vec<f64>> = fitted.iter().map(|sample| self.variables[sample.number].clone()).collect();
        let mut rows = 0..;
        let by_group = fitted.chunk_by(|one, other| one.group == other.group);
        let together: Vec<Vec<usize>> = by_group.map(|group| rows.by_ref().take(group.len()).collect()).collect();
        let mut found: Vec<(ResponseSurface, Vec<f64>, BTreeSet<usize>)> = Vec::new();
        for degree in 1..=MOST_DEGREE {
            let Some(surface) = ResponseSurface::new(&places, degree) else { break };
            if SAMPLES_PER_TERM * surface.terms() > places.len() {
                break;
            }
            let Some(errors) = errors(&surface, &together, &values, &scales) else { break };
            let is_beyond = |&number: &usize| {
                let variables = self.variables.get(number).filter(|_| are_asked(number));
                variables.is_some_and(|variables| surface.leverage(variables) > GREATEST_LEVERAGE)
            };
            let others = (0..self.all.len()).filter(|group| !self.run.contains(group));
            let beyond: BTreeSet<usize> = others.filter(|&group| self.all[group].iter().any(is_beyond)).collect();
            if beyond.len() <= MOST_FURTHER * self.run.len() {
                found.push((surface, errors, beyond));
            }
        }
        let greatest = found.iter().map(|(_, errors, _)| greatest_of(errors));
        let Some((least, column)) = greatest.min_by(|one, other| one.0.total_cmp(&other.0)) else {
            return Err(Misfit::Beyond);
        };
        let good_enough = GREATEST_ERROR.min(NEGLIGIBLE_ERROR.max(as_good * least));
        let good = found.into_iter().filter(|(_, errors, _)| greatest_of(errors).0 <= good_enough);
        let (surface, errors, beyond) =
            good.min_by_key(|(_, _, beyond)| beyond.len()).ok_or(Misfit::Missed { column, error: least })?;
        Ok(Surface { surface, values, errors, beyond })
    }
}

/// The greatest of the errors, and the column that has it.
fn greatest_of(errors: &[f64]) -> (f64, usize) {
    let errors = errors.iter().copied().zip(0..);
    errors.max_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or_default()
}

/// Why few runs have no surface.
pub(super) fn too_few() -> String {
    format!("the samples take fewer than {FEWEST_RUNS} runs")
}

/// Root mean square of what samples are missed by without those that share their run, over `scales`, of each column.
fn errors(
    surface: &ResponseSurface,
    together: &[Vec<usize>],
    values: &DMatrix<f64>,
    scales: &[f64],
) -> Option<Vec<f64>> {
    let left_out = surface.left_out(together, values)?;
    let inside: Vec<usize> = (0..values.nrows()).filter(|&row| left_out.leverage[row] <= GREATEST_LEVERAGE).collect();
    let of_columns = left_out.errors.column_iter().zip(scales).map(|(errors, &scale)| {
        let squares: f64 = inside.iter().map(|&row| errors[row] * errors[row]).sum();
        let error = (squares / inside.len() as f64).sqrt();
        if scale > 0.0 { error / scale } else { 0.0 }
    });
    (!inside.is_empty()).then(|| of_columns.collect())
}

/// Variables of all samples.
pub(super) fn variables(sampling: &Sampling<'_>) -> Vec<Vec<f64>> {
    let variable = |(one, value): (&Uncertain, f64)| match one.distribution {
        Distribution::Lognormal { .. } => value.ln(),
        Distribution::Normal { .. } | Distribution::Uniform { .. } | Distribution::Triangular { .. } => value,
    };
    let of_sample = |number| sampling.question.uncertain.iter().zip(sampling.values(number)).map(variable).collect();
    (0..sampling.total()).map(of_sample).collect()
}

/// Figures of a run in a row, of one that has the same as another.
fn figures(ran: &Ran, like: &Ran) -> Option<Vec<f64>> {
    let outputs = ran.outputs.iter().zip(&like.outputs);
    let growths = ran.growths.iter().zip(&like.growths);
    let is_alike = outputs.clone().all(|(own, other)| {
        own.value.is_some() == other.value.is_some() && own.at_least.is_none() && other.at_least.is_none()
    }) && growths.clone().all(|(own, other)| own.len() == other.len());
    let values = ran.outputs.iter().filter_map(|output| output.value);
    let growths = ran.growths.iter().flatten().flat_map(|&(time, depth)| [time, depth]);
    is_alike.then(|| values.chain(growths).collect())
}

/// Name of the figure of a column.
fn name<'a>(sampling: &Sampling<'a>, like: &Ran, column: usize) -> &'a str {
    let outputs = sampling.question.outputs.iter().zip(&like.outputs).filter(|(_, output)| output.value.is_some());
    let outputs = outputs.map(|(output, _)| output.path.as_str());
    let limits = sampling.question.limits.iter().zip(&like.growths);
    let limits = limits.flat_map(|(limit, growth)| std::iter::repeat_n(limit.output, 2 * growth.len()));
    outputs.chain(limits).nth(column).unwrap_or_default()
}

/// Wear of all flanks in a row.
fn columns_of(wear_um: &EachMesh<PerGear<Vec<f32>>>) -> Vec<f64> {
    let flanks = wear_um.all().into_iter().flat_map(|of| [&of.pinion, &of.wheel]);
    flanks.flatten().map(|&wear| f64::from(wear)).collect()
}

/// Number of places of each flank.
fn flanks_of(wear_um: Option<&EachMesh<PerGear<Vec<f32>>>>) -> Vec<usize> {
    let meshes = wear_um.into_iter().flat_map(EachMesh::all);
    meshes.flat_map(|of| [of.pinion.len(), of.wheel.len()]).collect()
}

/// Standard deviation of each column; 0 where it varies by round-off alone.
fn deviations(values: &DMatrix<f64>) -> Vec<f64> {
    let of_columns = values.column_iter().map(|column| {
        let deviation = standard_deviation(column.as_slice()).unwrap_or(0.0);
        if deviation > ROUND_OFF * column.amax() { deviation } else { 0.0 }
    });
    of_columns.collect()
}

/// The greatest on each flank, for all its places.
fn greatest_by_flank(deviations: Vec<f64>, flanks: &[usize]) -> Vec<f64> {
    let mut left = deviations.as_slice();
    let of_flanks = flanks.iter().flat_map(|&places| {
        let (own, others) = left.split_at(places.min(left.len()));
        left = others;
        std::iter::repeat_n(own.iter().copied().fold(0.0, f64::max), own.len())
    });
    of_flanks.collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::evaluate::output::SummaryOutput;
    use crate::scene::opened::SceneKind;
    use crate::uncertainty::distribution::parse_all;
    use crate::uncertainty::sampled_run::SampledQuestion;

    const POINTS: usize = 256;

    fn question() -> SampledQuestion {
        let given = ["wear.coefficient_m2_per_N=lognormal:2e-17:1.5", "operation.pinion_torque_Nm=normal:300:15"];
        SampledQuestion {
            kind: SceneKind::Pair,
            uncertain: parse_all(given, |_| None).unwrap(),
            correlation: None,
            outputs: vec![SummaryOutput::find("pinion.peak_wear_um").unwrap()],
            limits: Vec::new(),
            samples: POINTS,
            seed: 1,
            on_own_surface: false,
            run_all: false,
        }
    }

    /// Runs whose figure and wear are `model` of the logarithm of k over its median, and of the torque over its mean.
    fn runs(sampling: &Sampling<'_>, mut model: impl FnMut([f64; 2]) -> f64) -> BTreeMap<usize, Result<Ran, String>> {
        let run = |number: usize| {
            let values = sampling.values(number);
            let value = model([(values[0] / 2e-17).ln(), values[1] / 300.0]);
            let wear = PerGear { pinion: vec![value as f32, 0.0], wheel: vec![0.5 * value as f32] };
            let wear_um = sampling.is_independent(number, usize::MAX).then_some(EachMesh::Pair(wear));
            let outputs = vec![ReadOutput { value: Some(value), at_least: None }];
            (number, Ok(Ran { outputs, growths: Vec::new(), wear_um }))
        };
        (0..sampling.total()).map(run).collect()
    }

    /// Samples that share runs as their coefficients alone differ: A with AB of the coefficient, B with AB of the torque.
    fn pairs() -> Vec<Vec<usize>> {
        (0..POINTS).flat_map(|point| [vec![4 * point, 4 * point + 2], vec![4 * point + 1, 4 * point + 3]]).collect()
    }

    fn fit<'a>(
        (sampling, variables): (&'a Sampling<'a>, &'a [Vec<f64>]),
        points: usize,
        runs: &BTreeMap<usize, Result<Ran, String>>,
    ) -> Result<SampleSurfaces<'a>, String> {
        SampleSurfaces::fit(sampling, variables, &pairs(), points, |number| runs.get(&number))
    }

    /// Wear that goes as a power of coefficient and load.
    fn wear([ln_k, torque]: [f64; 2]) -> f64 {
        8.0 * (0.8 * ln_k).exp() * torque.powf(0.6)
    }

    /// Samples are read off as they would be run, with wear at the places where that is kept; those beyond the ones that are fitted are run.
    #[test]
    fn ver_smooth_figures_are_read_off() {
        let question = question();
        let sampling = Sampling::of(&question);
        let variables = variables(&sampling);
        let runs = runs(&sampling, wear);
        let surfaces = fit((&sampling, &variables), 32, &runs).unwrap();
        assert!((128..512).contains(&surfaces.run.len()), "{} of 1024 are run", surfaces.run.len());
        assert!((0..4 * 32).all(|number| surfaces.run.contains(&number)));
        let (mut missed, mut missed_values) = (Vec::new(), Vec::new());
        for number in (0..sampling.total()).filter(|&number| surfaces.reads_off(number)) {
            let (found, run) = (surfaces.read_off(number).unwrap(), runs[&number].as_ref().unwrap());
            let [value, expected] = [&found, run].map(|ran| ran.outputs[0].value.unwrap());
            assert!((value / expected - 1.0).abs() < 0.03, "{number}: {value} for {expected}");
            missed_values.push(value - expected);
            assert_eq!(found.wear_um.is_some(), number % 4 < 2);
            if let Some(EachMesh::Pair(worn)) = found.wear_um {
                let [pinion, unworn, wheel] = [worn.pinion[0], worn.pinion[1], worn.wheel[0]].map(f64::from);
                assert!(unworn.abs() < 1e-9 && (wheel / (0.5 * pinion) - 1.0).abs() < 1e-6, "{number}");
                missed.push(pinion - expected);
            }
        }
        let all = runs.values().filter_map(|run| run.as_ref().ok()?.outputs[0].value).collect::<Vec<f64>>();
        let [missed, missed_values, all] =
            [missed, missed_values, all].map(|values| standard_deviation(&values).unwrap());
        assert!(missed < 0.05 * all && missed_values < 0.01 * all, "{missed} and {missed_values} for {all}");
        assert!(surfaces.errors()[0].unwrap() < 0.01 && surfaces.errors().len() == 1);
    }

    /// What is said of the error is about what samples are missed by that are read off, in both directions: here by scatter of 3 % of the standard deviation,
    /// of which samples that share a run have the same. With the fewest runs it is too low by a fifth on average: 1.2 times it was found.
    #[test]
    fn ver_the_error_is_that_of_samples_that_are_read_off() {
        let question = question();
        let sampling = Sampling::of(&question);
        let variables = variables(&sampling);
        let smooth = runs(&sampling, wear);
        let of = |runs: &BTreeMap<usize, Result<Ran, String>>, number: usize| {
            runs[&number].as_ref().unwrap().outputs[0].value.unwrap()
        };
        let all: Vec<f64> = (0..sampling.total()).map(|number| of(&smooth, number)).collect();
        let deviation = standard_deviation(&all).unwrap();
        // Points, and what found over said may be of a seed and on average.
        let cases = [(32, 0.7..1.6, 0.9..1.3), (64, 0.8..1.25, 0.9..1.15)];
        for (points, of_seed, on_average) in cases {
            let mut ratios = Vec::new();
            for seed in 1..=24 {
                let mut scattered = smooth.clone();
                let mut random = fastrand::Rng::with_seed(seed);
                for pair in pairs() {
                    let beside = 0.03 * deviation * (random.f64() + random.f64() + random.f64() - 1.5) * 2.0;
                    for number in pair {
                        let ran = scattered.get_mut(&number).unwrap().as_mut().unwrap();
                        ran.outputs[0].value = ran.outputs[0].value.map(|value| value + beside);
                    }
                }
                let surfaces = fit((&sampling, &variables), points, &scattered).unwrap();
                let missed: Vec<f64> = (0..sampling.total())
                    .filter(|&number| surfaces.reads_off(number))
                    .map(|number| surfaces.read_off(number).unwrap().outputs[0].value.unwrap() - of(&scattered, number))
                    .collect();
                let missed = (missed.iter().map(|error| error * error).sum::<f64>() / missed.len() as f64).sqrt();
                let said = surfaces.errors()[0].unwrap() * deviation;
                assert!(of_seed.contains(&(missed / said)), "{points} points, seed {seed}: {missed} for {said}");
                ratios.push(missed / said);
            }
            let ratio = ratios.iter().sum::<f64>() / ratios.len() as f64;
            println!("{points} points: {ratio:.3} of {ratios:.2?}");
            assert!(on_average.contains(&ratio), "{points} points: {ratio}");
        }
    }

    /// What does not follow the keys smoothly is not read off, nor is what some samples do not have, nor what too few runs are known of.
    #[test]
    fn other_figures_are_run() {
        let question = question();
        let sampling = Sampling::of(&question);
        let variables = variables(&sampling);
        let because = |runs: &BTreeMap<usize, Result<Ran, String>>, points: usize| {
            fit((&sampling, &variables), points, runs).err().unwrap_or_default()
        };
        let jumps = runs(&sampling, |at| wear(at) + if at[1] > 1.02 { 3.0 } else { 0.0 });
        assert!(because(&jumps, 64).contains("misses pinion.peak_wear_um of samples that are left out by"));
        let mut random = fastrand::Rng::with_seed(1);
        let scatters = runs(&sampling, |at| wear(at) + 3.0 * random.f64());
        assert!(because(&scatters, 128).contains("more than 5 %"), "{}", because(&scatters, 128));
        let smooth = runs(&sampling, wear);
        assert!(because(&smooth, 16).contains("fewer than 64 runs"));
        let mut failed = smooth.clone();
        failed.insert(7, Err("no equilibrium".to_owned()));
        assert!(because(&failed, 32).contains("failed"));
        let mut longer = smooth;
        let ran = longer.get_mut(&9).unwrap().as_mut().unwrap();
        ran.outputs[0] = ReadOutput { value: None, at_least: Some(100.0) };
        assert!(because(&longer, 32).contains("others do not have"));
    }
}
