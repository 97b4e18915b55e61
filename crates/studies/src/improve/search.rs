//! Front of a problem whose evaluation is dear: a few hundred of them, in batches.
//!
//! The space is the unit cube. A scrambled Sobol sequence is evaluated first. Then, batch by batch,
//!
//! 1. interpolants by radial basis functions stand for goals and limits ([`RadialBasis`]),
//! 2. NSGA-II finds the front of the interpolants (crate `heuropt`),
//! 3. of its points those are evaluated that promise the least of each goal, and those furthest from what is known of the front.
//!
//! The search is settled where [`SETTLED_AFTER`] batches in a row find no point that improves on the front by more than [`SAME`] of a goal. It depends on
//! problem and seed alone: a batch has [`BATCH`] points, whatever evaluates them.
//!
//! Source: K. Deb et al., *A fast and elitist multiobjective genetic algorithm: NSGA-II*, IEEE Transactions on Evolutionary Computation 6 (2002)
//! 182–197; T. Akhtar, C. A. Shoemaker, *Multi objective optimization of computationally expensive multi-modal functions with RBF surrogates and
//! multi-rule selection*, Journal of Global Optimization 64 (2016) 17–32.

use gearwear::uncertainty::design::{Design, Matrix};
use gearwear_bodies::reference::radial_basis::RadialBasis;
use gearwear_bodies::reference::statistics::extent;
use heuropt::prelude::{
    CompositeVariation, Evaluation, Initializer, Nsga2, Nsga2Config, Objective, ObjectiveSpace, Optimizer,
    PolynomialMutation, Problem, RealBounds, Rng, SimulatedBinaryCrossover, Variation, rng_from_seed,
};

/// Points that are evaluated together.
pub const BATCH: usize = 8;
/// Batches without an improvement after which the front is settled.
pub const SETTLED_AFTER: usize = 4;
/// Relative difference of a goal below which two points are the same.
pub const SAME: f64 = 0.005;

/// Population and generations of NSGA-II on the interpolants.
const POPULATION: usize = 48;
const GENERATIONS: usize = 40;
/// Smoothing of the interpolants: the values have the noise of coarse positions.
const SMOOTHING: f64 = 1e-4;
/// Distribution index of the mutation that looks around known points.
const NEAR: f64 = 10.0;

/// Space and goals of a search.
pub struct SearchProblem<'a> {
    pub dimensions: usize,
    pub goals: usize,
    /// Nearest point that can be evaluated: keys take words, whole numbers and few decimals.
    pub snapped: &'a (dyn Fn(&[f64]) -> Vec<f64> + Sync),
}

/// Extent of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SearchSettings {
    /// Greatest number of evaluations.
    pub evaluations: usize,
    pub seed: u32,
}

/// Goals of a point, each to be least, and how far it is beyond each limit (not above 0: within).
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub goals: Vec<f64>,
    pub excess: Vec<f64>,
}

/// Point that was evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluated {
    pub at: Vec<f64>,
    /// `None` where it cannot be evaluated.
    pub outcome: Option<Outcome>,
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchStop {
    /// The last batches did not improve on the front.
    Settled,
    /// All evaluations are spent.
    Evaluations,
    /// No further point can be evaluated.
    Exhausted,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchRecord {
    /// In the order of evaluation.
    pub points: Vec<Evaluated>,
    pub stopped: SearchStop,
}

impl Outcome {
    pub fn is_allowed(&self) -> bool {
        self.excess.iter().all(|excess| *excess <= 0.0)
    }

    /// Sum of what is beyond limits.
    fn violation(&self) -> f64 {
        self.excess.iter().map(|excess| excess.max(0.0)).sum()
    }
}

/// Whether `one` is at least as good as `other` in every goal.
fn is_as_good(one: &[f64], other: &[f64]) -> bool {
    one.iter().zip(other).all(|(one, other)| one <= other)
}

/// Places of the points within the limits that no other is better than; of equal ones the first.
pub fn front<'a>(outcomes: impl IntoIterator<Item = Option<&'a Outcome>>) -> Vec<usize> {
    let allowed: Vec<(usize, &Outcome)> = outcomes
        .into_iter()
        .enumerate()
        .filter_map(|(place, outcome)| Some((place, outcome.filter(|outcome| outcome.is_allowed())?)))
        .collect();
    let is_behind = |place: usize, goals: &[f64]| {
        allowed
            .iter()
            .any(|(other, outcome)| is_as_good(&outcome.goals, goals) && (outcome.goals != goals || *other < place))
    };
    allowed.iter().filter(|(place, outcome)| !is_behind(*place, &outcome.goals)).map(|(place, _)| *place).collect()
}

/// Searches the front of `problem`; `evaluate` gives the outcomes of a batch.
///
/// # Errors
/// What `evaluate` returns.
pub fn search<E>(
    problem: &SearchProblem<'_>,
    settings: SearchSettings,
    mut evaluate: impl FnMut(&[Vec<f64>]) -> Result<Vec<Option<Outcome>>, E>,
) -> Result<SearchRecord, E> {
    let mut state = Search { problem, settings, points: Vec::new() };
    let mut quiet = 0;
    let mut batch = state.first();
    loop {
        let room = settings.evaluations - state.points.len();
        batch.truncate(room);
        if batch.is_empty() {
            let stopped = if room == 0 { SearchStop::Evaluations } else { SearchStop::Exhausted };
            return Ok(SearchRecord { points: state.points, stopped });
        }
        let before = state.points.len();
        let outcomes = evaluate(&batch)?;
        state.points.extend(batch.into_iter().zip(outcomes).map(|(at, outcome)| Evaluated { at, outcome }));
        quiet = if before > 0 && !state.improves(before) { quiet + 1 } else { 0 };
        if quiet == SETTLED_AFTER {
            return Ok(SearchRecord { points: state.points, stopped: SearchStop::Settled });
        }
        batch = state.next();
    }
}

struct Search<'a> {
    problem: &'a SearchProblem<'a>,
    settings: SearchSettings,
    points: Vec<Evaluated>,
}

impl Search<'_> {
    /// Points of the Sobol sequence: at least so many that they determine an interpolant.
    fn first(&self) -> Vec<Vec<f64>> {
        let d = self.problem.dimensions;
        let count = (4 * d).max(2 * BATCH).min(self.settings.evaluations);
        let design = Design { factors: d, seed: self.settings.seed, correlation: None };
        let mut points = Vec::new();
        for number in 0..count {
            self.add_new(&mut points, &design.sample(number, Matrix::A));
        }
        points
    }

    /// Whether a point after the first `before` is better in a goal, by more than [`SAME`], than each of these that is as good in all others.
    fn improves(&self, before: usize) -> bool {
        let (old, new) = self.points.split_at(before);
        let old: Vec<&Outcome> =
            old.iter().filter_map(|point| point.outcome.as_ref().filter(|outcome| outcome.is_allowed())).collect();
        let mut new = new.iter().filter_map(|point| point.outcome.as_ref().filter(|outcome| outcome.is_allowed()));
        new.any(|outcome| {
            let goals: Vec<f64> = outcome.goals.iter().map(|goal| goal + SAME * goal.abs()).collect();
            !old.iter().any(|old| is_as_good(&old.goals, &goals))
        })
    }

    /// Adds the point nearest to `at`, unless it is there or was evaluated.
    fn add_new(&self, batch: &mut Vec<Vec<f64>>, at: &[f64]) -> bool {
        let at = (self.problem.snapped)(at);
        let is_new = !batch.contains(&at) && self.points.iter().all(|point| point.at != at);
        if is_new {
            batch.push(at);
        }
        is_new
    }

    /// Next points to be evaluated.
    fn next(&self) -> Vec<Vec<f64>> {
        let mut rng = rng_from_seed((u64::from(self.settings.seed) << 32) + self.points.len() as u64);
        let mut batch = Vec::new();
        if let Some(surrogate) = Surrogate::of(self) {
            let candidates = surrogate.candidates(self, &mut rng);
            surrogate.choose(self, candidates, &mut batch);
        }
        self.fill_up(&mut batch, &mut rng);
        batch
    }

    /// Known front, or all points where none is within the limits.
    fn known(&self) -> Vec<&Evaluated> {
        let front = front(self.points.iter().map(|point| point.outcome.as_ref()));
        if front.is_empty() {
            return self.points.iter().filter(|point| point.outcome.is_some()).collect();
        }
        front.into_iter().map(|place| &self.points[place]).collect()
    }

    /// Fills the batch with points near those of the front.
    fn fill_up(&self, batch: &mut Vec<Vec<f64>>, rng: &mut Rng) {
        let known = self.known();
        let mut near = PolynomialMutation::new(vec![(0.0, 1.0); self.problem.dimensions], NEAR, 1.0);
        // In a space of few points there may be no further ones.
        for point in known.iter().cycle().take(8 * BATCH) {
            if batch.len() >= BATCH {
                return;
            }
            for at in near.vary(std::slice::from_ref(&point.at), rng) {
                self.add_new(batch, &at);
            }
        }
    }
}

/// Interpolants of goals and limits.
struct Surrogate {
    basis: RadialBasis,
    goals: usize,
    /// Width of the known front in each goal.
    scale: Vec<f64>,
}

impl Surrogate {
    fn of(search: &Search<'_>) -> Option<Self> {
        let goals = search.problem.goals;
        let known: Vec<&Outcome> = search.points.iter().filter_map(|point| point.outcome.as_ref()).collect();
        let fails = known.len() < search.points.len();
        let worst: Vec<f64> =
            (0..goals).map(|goal| extent(known.iter().map(|outcome| outcome.goals[goal]))[1]).collect();
        let limits = known.first()?.excess.len();
        // What cannot be evaluated is a limit of its own, beside goals that are no better than any other.
        let values: Vec<Vec<f64>> = search
            .points
            .iter()
            .map(|point| {
                let (goals, excess, failed) = match &point.outcome {
                    Some(outcome) => (outcome.goals.clone(), outcome.excess.clone(), -1.0),
                    None => (worst.clone(), vec![0.0; limits], 1.0),
                };
                goals.into_iter().chain(excess).chain(fails.then_some(failed)).collect()
            })
            .collect();
        let at: Vec<Vec<f64>> = search.points.iter().map(|point| point.at.clone()).collect();
        let basis = RadialBasis::through(&at, &values, SMOOTHING)?;
        let front: Vec<&Outcome> = search.known().into_iter().filter_map(|point| point.outcome.as_ref()).collect();
        let scale = (0..goals).map(|goal| {
            let [least, greatest] = extent(front.iter().map(|outcome| outcome.goals[goal]));
            (greatest - least).max(SAME * least.abs()).max(f64::MIN_POSITIVE)
        });
        Some(Self { basis, goals, scale: scale.collect() })
    }

    fn at(&self, x: &[f64]) -> Outcome {
        let mut goals = self.basis.at(x);
        let excess = goals.split_off(self.goals);
        Outcome { goals, excess }
    }

    /// Front of the interpolants: points that can be evaluated and were not, with their goals over the scale.
    fn candidates(&self, search: &Search<'_>, rng: &mut Rng) -> Vec<(Vec<f64>, Vec<f64>)> {
        let bounds = vec![(0.0, 1.0); search.problem.dimensions];
        let known = search.known().into_iter().map(|point| point.at.clone()).take(POPULATION / 2).collect();
        let mut nsga = Nsga2::new(
            Nsga2Config {
                population_size: POPULATION,
                generations: GENERATIONS,
                seed: u64::from(search.settings.seed) + search.points.len() as u64,
            },
            Seeded { known, others: RealBounds::new(bounds.clone()) },
            CompositeVariation {
                crossover: SimulatedBinaryCrossover::new(bounds.clone(), 15.0, 0.9),
                mutation: PolynomialMutation::new(bounds, 20.0, 1.0 / search.problem.dimensions as f64),
            },
        );
        let found = nsga.run(&OnSurrogate { surrogate: self, snapped: search.problem.snapped });
        let mut points = Vec::new();
        for candidate in &found.pareto_front {
            search.add_new(&mut points, &candidate.decision);
        }
        // Those beside each other on the front of few points help where it is short.
        if points.len() < BATCH {
            search.fill_up(&mut points, rng);
        }
        let with_goals = |at: Vec<f64>| {
            let goals = self.scaled(&self.at(&at).goals);
            (at, goals)
        };
        points.into_iter().map(with_goals).collect()
    }

    fn scaled(&self, goals: &[f64]) -> Vec<f64> {
        goals.iter().zip(&self.scale).map(|(goal, scale)| goal / scale).collect()
    }

    /// Chooses the candidates with the least of each goal, then those furthest from the known front and from each other, in the goals; the last is
    /// the one furthest from all points in the space.
    fn choose(&self, search: &Search<'_>, mut candidates: Vec<(Vec<f64>, Vec<f64>)>, batch: &mut Vec<Vec<f64>>) {
        let known = search.known().into_iter().filter_map(|point| point.outcome.as_ref());
        let mut near: Vec<Vec<f64>> = known.map(|outcome| self.scaled(&outcome.goals)).collect();
        for goal in 0..self.goals {
            let least = extent(near.iter().map(|goals| goals[goal]))[0];
            let best = (0..candidates.len()).min_by(|a, b| candidates[*a].1[goal].total_cmp(&candidates[*b].1[goal]));
            if let Some(best) = best.filter(|best| candidates[*best].1[goal] < least) {
                let (at, goals) = candidates.swap_remove(best);
                batch.push(at);
                near.push(goals);
            }
        }
        while batch.len() + 1 < BATCH {
            let Some(best) = furthest(&candidates, |(_, goals)| goals, &near) else { return };
            let (at, goals) = candidates.swap_remove(best);
            batch.push(at);
            near.push(goals);
        }
        let all: Vec<Vec<f64>> = search.points.iter().map(|point| &point.at).chain(&*batch).cloned().collect();
        if let Some(best) = furthest(&candidates, |(at, _)| at, &all) {
            batch.push(candidates.swap_remove(best).0);
        }
    }
}

/// Place of the candidate whose nearest one of `others` is furthest away.
fn furthest<C>(candidates: &[C], of: impl Fn(&C) -> &Vec<f64>, others: &[Vec<f64>]) -> Option<usize> {
    let nearest = |candidate: &C| {
        let squares = others.iter().map(|other| {
            let parts = of(candidate).iter().zip(other);
            parts.map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
        });
        squares.fold(f64::INFINITY, f64::min)
    };
    let distances: Vec<f64> = candidates.iter().map(nearest).collect();
    // Of equal ones the first.
    (0..distances.len()).rev().max_by(|a, b| distances[*a].total_cmp(&distances[*b]))
}

/// First population: known points, then random ones.
struct Seeded {
    known: Vec<Vec<f64>>,
    others: RealBounds,
}

impl Initializer<Vec<f64>> for Seeded {
    fn initialize(&mut self, size: usize, rng: &mut Rng) -> Vec<Vec<f64>> {
        let mut points = self.known.clone();
        points.truncate(size);
        points.extend(self.others.initialize(size - points.len(), rng));
        points
    }
}

/// Problem of NSGA-II: the interpolants at points that can be evaluated.
struct OnSurrogate<'a> {
    surrogate: &'a Surrogate,
    snapped: &'a (dyn Fn(&[f64]) -> Vec<f64> + Sync),
}

impl Problem for OnSurrogate<'_> {
    type Decision = Vec<f64>;

    fn objectives(&self) -> ObjectiveSpace {
        ObjectiveSpace::new((0..self.surrogate.goals).map(|goal| Objective::minimize(goal.to_string())).collect())
    }

    fn evaluate(&self, decision: &Vec<f64>) -> Evaluation {
        let outcome = self.surrogate.at(&(self.snapped)(decision));
        let violation = outcome.violation();
        Evaluation::constrained(outcome.goals, violation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn unsnapped(at: &[f64]) -> Vec<f64> {
        at.to_vec()
    }

    fn found(
        dimensions: usize,
        goals: usize,
        settings: SearchSettings,
        of: impl Fn(&[f64]) -> Option<Outcome>,
    ) -> SearchRecord {
        let problem = SearchProblem { dimensions, goals, snapped: &unsnapped };
        let evaluated = search(&problem, settings, |batch: &[Vec<f64>]| {
            Ok::<_, Infallible>(batch.iter().map(|at| of(at)).collect())
        });
        evaluated.unwrap_or_else(|never| match never {})
    }

    const SETTINGS: SearchSettings = SearchSettings { evaluations: 120, seed: 1 };

    /// f₁ = |x − a|², f₂ = |x − b|²: the front is the line from a to b, √f₁ + √f₂ = |a − b|.
    fn distances(x: &[f64]) -> Option<Outcome> {
        let square = |to: f64| x.iter().map(|x| (x - to) * (x - to)).sum::<f64>();
        Some(Outcome { goals: vec![square(0.3), square(0.7)], excess: Vec::new() })
    }

    #[test]
    fn ver_the_front_of_two_distances_is_their_line() {
        let record = found(4, 2, SETTINGS, distances);
        assert!(record.points.len() <= SETTINGS.evaluations);
        let front = front(record.points.iter().map(|point| point.outcome.as_ref()));
        assert!(front.len() >= 15, "{}", front.len());
        let of = |place: usize| &record.points[place].outcome.as_ref().unwrap().goals;
        let sums: Vec<f64> = front.iter().map(|&place| (of(place)[0].sqrt() + of(place)[1].sqrt()) / 0.8).collect();
        let close = sums.iter().filter(|sum| **sum < 1.05).count();
        assert!(close >= 10, "{sums:?}");
        for goal in 0..2 {
            let least = extent(front.iter().map(|&place| of(place)[goal]))[0];
            assert!(least < 0.003, "{least}");
        }
    }

    /// ZDT1 in five dimensions: f₂ = g (1 − √(f₁/g)), g = 1 + 9 Σ x_i/(d − 1); the front has g = 1. Source: E. Zitzler, K. Deb, L. Thiele,
    /// *Comparison of multiobjective evolutionary algorithms*, Evolutionary Computation 8 (2000) 173–195.
    #[test]
    fn ver_the_front_of_zdt1() {
        let record = found(5, 2, SearchSettings { evaluations: 160, seed: 3 }, |x| {
            let g = 1.0 + 9.0 * x[1..].iter().sum::<f64>() / (x.len() - 1) as f64;
            Some(Outcome { goals: vec![x[0], g * (1.0 - (x[0] / g).sqrt())], excess: Vec::new() })
        });
        let front = front(record.points.iter().map(|point| point.outcome.as_ref()));
        let beyond = front.iter().filter_map(|&place| record.points[place].outcome.as_ref());
        let beyond: Vec<f64> = beyond.map(|outcome| outcome.goals[1] - 1.0 + outcome.goals[0].sqrt()).collect();
        assert!(beyond.len() >= 10 && beyond.iter().all(|beyond| *beyond < 0.1), "{beyond:?}");
    }

    /// Least of one goal within a limit, where a part of the space cannot be evaluated: (x − 0.8)² + y² with x ≤ 0.6 is least at (0.6, 0).
    #[test]
    fn ver_a_limit_and_points_without_an_outcome() {
        let record = found(2, 1, SETTINGS, |x| {
            let outcome = Outcome { goals: vec![(x[0] - 0.8).powi(2) + x[1] * x[1]], excess: vec![x[0] / 0.6 - 1.0] };
            (x[1] < 0.9).then_some(outcome)
        });
        let front = front(record.points.iter().map(|point| point.outcome.as_ref()));
        let best = &record.points[front[0]];
        assert!((best.at[0] - 0.6).abs() < 0.01 && best.at[1] < 0.03, "{best:?}");
        assert_eq!((front.len(), record.stopped), (1, SearchStop::Settled));
    }

    #[test]
    fn the_same_seed_finds_the_same() {
        assert_eq!(found(3, 2, SETTINGS, distances), found(3, 2, SETTINGS, distances));
        let other = found(3, 2, SearchSettings { seed: 2, ..SETTINGS }, distances);
        assert_ne!(found(3, 2, SETTINGS, distances), other);
    }

    /// Two words and a whole number make six points.
    #[test]
    fn a_space_of_few_points_is_exhausted() {
        let snapped = |at: &[f64]| vec![at[0].round(), (2.0 * at[1]).round() / 2.0];
        let problem = SearchProblem { dimensions: 2, goals: 2, snapped: &snapped };
        let record = search(&problem, SETTINGS, |batch: &[Vec<f64>]| {
            Ok::<_, Infallible>(batch.iter().map(|at| distances(at)).collect())
        });
        let record = record.unwrap_or_else(|never| match never {});
        assert!(record.points.len() <= 6 && record.stopped != SearchStop::Evaluations, "{record:?}");
    }

    #[test]
    fn fronts_have_the_first_of_equal_points() {
        let outcome = |goals: [f64; 2], excess: f64| Outcome { goals: goals.to_vec(), excess: vec![excess] };
        let all = [
            Some(outcome([1.0, 2.0], 0.0)),
            Some(outcome([1.0, 2.0], 0.0)),
            Some(outcome([2.0, 2.0], -1.0)),
            None,
            Some(outcome([0.0, 0.0], 0.1)),
            Some(outcome([3.0, 1.0], 0.0)),
        ];
        assert_eq!(front(all.iter().map(Option::as_ref)), [0, 5]);
    }
}
