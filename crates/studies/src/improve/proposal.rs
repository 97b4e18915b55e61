//! Proposals: designs of the front that are chosen for a reason, with what they gain and cost against the scene as given.
//!
//! With y_k a goal of a design and b_k that of the scene as given, r_k = y_k / b_k (of a life b_k / y_k). The design that is best in one aspect, such as
//! wear, has the least product of its r_k; the balanced one has the least max r_k: where a design betters every goal, it worsens none. The robust one has the least
//! max r_k with all tolerances at their worst.
//!
//! A difference y − b is sure where it is more than both errors together, |y − b| > e_y |y| + e_b |b|. Tolerances ± t_j of manufacture change a goal by
//! d_j at most, found on the fast model one key at a time; together they change it by Σ d_j at worst.

use serde::Serialize;

use super::asked::ImproveQuestion;
use super::free_key::{FreeKey, FreeRange};
use super::goal::{Aspect, ImproveGoal, heading, unit};
use super::kept::KeptDesign;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::figures;

/// Share of a range from its end within which a value lies on the edge.
const EDGE: f64 = 0.01;

/// A free key of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChosenValue {
    pub key: String,
    /// As text: a number or a word.
    pub value: String,
    /// End of the range that it lies on and that could be wider; null inside.
    pub edge: Option<Edge>,
}

/// End of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    Lower,
    Upper,
}

/// A figure of a verified design beside that of the scene as given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparedFigure {
    /// Path in the summary, or a goal that is a sum.
    pub figure: String,
    pub heading: String,
    pub unit: String,
    pub is_goal: bool,
    /// Whether less is better.
    pub less_is_better: bool,
    pub value: f64,
    pub as_given: f64,
    /// Relative error of the value; null where none is stated.
    pub error: Option<f64>,
    /// Whether the difference is more than both errors; null where one is not known.
    pub is_sure: Option<bool>,
    /// On the fast model.
    pub fast: Option<f64>,
}

/// Change of the goals by a tolerance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sensitivity {
    pub key: String,
    pub tolerance: f64,
    /// Greatest relative change for the worse of each goal; null where it cannot be run.
    pub changes: Vec<Option<f64>>,
}

/// A design that is proposed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Proposal {
    /// "least wear", "balanced".
    pub name: String,
    /// Name of its scene.
    pub file: String,
    /// Number of the design in `improve.csv`.
    pub design: usize,
    pub values: Vec<ChosenValue>,
    /// Goals, then other figures.
    pub figures: Vec<ComparedFigure>,
    /// Each tolerance by itself.
    pub sensitivity: Vec<Sensitivity>,
    /// Of each goal all tolerances together at worst, relative; null where there are none.
    pub tolerances_together: Vec<Option<f64>>,
    #[serde(skip)]
    pub scene_toml: String,
}

impl ComparedFigure {
    /// Relative change against the scene as given; `None` where that is zero.
    pub fn change(&self) -> Option<f64> {
        (self.as_given != 0.0).then(|| (self.value - self.as_given) / self.as_given.abs())
    }

    /// Whether it is better than as given.
    pub fn is_better(&self) -> bool {
        if self.less_is_better { self.value < self.as_given } else { self.value > self.as_given }
    }
}

/// Goals of a verified design as numbers to be lowered.
pub fn goals_of(question: &ImproveQuestion, figures: &[Option<f64>]) -> Option<Vec<f64>> {
    let goal = |goal: &ImproveGoal| {
        let value = goal.value(|path| question.figure(figures, path))?;
        Some(if goal.is_raised() { -value } else { value })
    };
    question.goals.iter().map(goal).collect()
}

/// Ratio r of a goal to be lowered to that as given.
fn ratio(goal: f64, as_given: f64) -> f64 {
    let ratio = if goal < 0.0 { as_given / goal } else { goal / as_given };
    if ratio.is_finite() { ratio } else { 1.0 + goal - as_given }
}

/// Reasons to propose a design of a front, whose `goals` are to be lowered, with its place on the front. `tolerances` are the relative changes for the
/// worse of each design's goals by all tolerances together; none where they are not known.
pub fn reasons(
    goals: &[ImproveGoal],
    front: &[Vec<f64>],
    as_given: &[f64],
    tolerances: &[Vec<Option<f64>>],
) -> Vec<(String, usize)> {
    let ratios: Vec<Vec<f64>> =
        front.iter().map(|own| own.iter().zip(as_given).map(|(goal, given)| ratio(*goal, *given)).collect()).collect();
    let mut aspects: Vec<Aspect> = goals.iter().map(ImproveGoal::aspect).collect();
    aspects.sort();
    aspects.dedup();
    let of_aspect = |aspect: Aspect| goals.iter().enumerate().filter(move |(_, goal)| goal.aspect() == aspect);
    let mut reasons: Vec<(String, usize)> = Vec::new();
    for aspect in aspects {
        // Of equal ones that with less of everything.
        let measure = |place: usize| {
            let own: f64 = of_aspect(aspect).map(|(goal, _)| ratios[place][goal].max(f64::MIN_POSITIVE).ln()).sum();
            (own, ratios[place].iter().sum::<f64>())
        };
        let best = (0..front.len()).min_by(|a, b| {
            let (a, b) = (measure(*a), measure(*b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        reasons.extend(best.map(|best| (name_of(aspect, of_aspect(aspect).map(|(_, goal)| goal)), best)));
    }
    if goals.len() > 1 {
        let worst = |place: usize| ratios[place].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let best = (0..front.len()).min_by(|a, b| worst(*a).total_cmp(&worst(*b)));
        reasons.extend(best.map(|best| ("balanced".to_owned(), best)));
    }
    let at_worst = |place: usize| -> Option<f64> {
        let changes = tolerances.get(place)?.iter().zip(&front[place]).zip(as_given);
        let ratios = changes.map(|((change, goal), given)| Some(ratio(goal + (*change)? * goal.abs(), *given)));
        ratios.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    };
    let known = (0..front.len()).filter_map(|place| Some((place, at_worst(place)?)));
    let robust = known.min_by(|a, b| a.1.total_cmp(&b.1));
    reasons.extend(robust.map(|(place, _)| ("robust".to_owned(), place)));
    // One design for several reasons is one proposal.
    let mut merged: Vec<(String, usize)> = Vec::new();
    for (name, place) in reasons {
        match merged.iter_mut().find(|(_, other)| *other == place) {
            Some((names, _)) => *names = format!("{names} and {name}"),
            None => merged.push((name, place)),
        }
    }
    merged
}

fn name_of<'a>(aspect: Aspect, mut goals: impl Iterator<Item = &'a ImproveGoal>) -> String {
    match aspect {
        Aspect::Wear => "least wear".to_owned(),
        Aspect::TransmissionError => {
            let of_life = |path: &str| path.contains("worn") || path.contains("over_life");
            let is_worn = goals.any(|goal| goal.terms.iter().any(|(_, figure)| of_life(&figure.path)));
            if is_worn { "quietest over life" } else { "quietest when new" }.to_owned()
        }
        Aspect::Pressure => "least pressure".to_owned(),
        Aspect::Life => "longest life".to_owned(),
        Aspect::Other => goals.next().map_or_else(|| "least".to_owned(), |goal| format!("least {}", goal.heading())),
    }
}

/// Name of the scene of a proposal.
pub fn file_of(name: &str) -> String {
    format!("proposal-{}.toml", name.replace(' ', "-"))
}

/// Values of a design.
pub fn values_of(free: &[FreeKey], values: &[f64]) -> Vec<ChosenValue> {
    let of_key = |(one, value): (&FreeKey, &f64)| {
        let share = one.share(*value);
        let edge = match one.range {
            FreeRange::Words(_) => None,
            FreeRange::Between { .. } if share <= EDGE && one.goes_beyond(0.0) => Some(Edge::Lower),
            FreeRange::Between { .. } if share >= 1.0 - EDGE && one.goes_beyond(1.0) => Some(Edge::Upper),
            FreeRange::Between { .. } => None,
        };
        ChosenValue { key: one.key.clone(), value: one.said(*value), edge }
    };
    free.iter().zip(values).map(of_key).collect()
}

/// Whether two values with these relative errors differ by more than both together; `None` where one error is not known.
pub fn is_sure((value, error): (f64, Option<f64>), (other, its): (f64, Option<f64>)) -> Option<bool> {
    Some((value - other).abs() > error? * value.abs() + its? * other.abs())
}

/// Goals and other figures of a verified `design` beside those of the scene as given; `fast` are those of the design on the fast model.
pub fn compared(
    question: &ImproveQuestion,
    (design, as_given): (&KeptDesign, &KeptDesign),
    fast: &[Option<f64>],
) -> Vec<ComparedFigure> {
    let none = TotalError::none("");
    let of = |kept: &KeptDesign| (kept.figures.clone().unwrap_or_default(), kept.total.clone().unwrap_or(none.clone()));
    let ((own, own_total), (given, given_total)) = (of(design), of(as_given));
    let goals = question.goals.iter().filter_map(|goal| {
        let [value, base] = [&own, &given].map(|from| goal.value(|path| question.figure(from, path)));
        let (value, as_given) = (value?, base?);
        let [error, its] = [(&own, &own_total), (&given, &given_total)]
            .map(|(from, total)| goal.error(|path| question.figure(from, path), total));
        Some(ComparedFigure {
            figure: goal.to_string(),
            heading: goal.heading(),
            unit: goal.unit().to_owned(),
            is_goal: true,
            less_is_better: !goal.is_raised(),
            value,
            as_given,
            error,
            is_sure: is_sure((value, error), (as_given, its)),
            fast: goal.value(|path| question.figure(fast, path)),
        })
    });
    let named: Vec<String> = question.goals.iter().map(ToString::to_string).collect();
    let others = question.figures.iter().filter(|figure| !named.contains(&figure.path)).filter_map(|figure| {
        let path = figure.path.as_str();
        let (value, as_given) = (question.figure(&own, path)?, question.figure(&given, path)?);
        let known = figures::find(path);
        let [error, its] = [&own_total, &given_total].map(|total| known?.error(total));
        Some(ComparedFigure {
            figure: path.to_owned(),
            heading: heading(path),
            unit: unit(path).unwrap_or_default().to_owned(),
            is_goal: false,
            less_is_better: !path.starts_with("life."),
            value,
            as_given,
            error,
            is_sure: is_sure((value, error), (as_given, its)),
            fast: question.figure(fast, path),
        })
    });
    goals.chain(others).collect()
}

/// Greatest relative change for the worse of each goal, from `at` to designs at the tolerance of a key.
pub fn worsening(at: &[f64], beside: &[Option<Vec<f64>>]) -> Vec<Option<f64>> {
    (0..at.len())
        .map(|goal| {
            let changes = beside.iter().map(|goals| Some((goals.as_ref()?[goal] - at[goal]) / at[goal].abs()));
            changes.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max).map(|worst| worst.max(0.0))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goals(paths: &[&str]) -> Vec<ImproveGoal> {
        paths.iter().map(|path| path.parse().unwrap()).collect()
    }

    #[test]
    fn designs_are_proposed_for_a_reason() {
        let goals = goals(&["pinion.peak_wear_um", "wheel.peak_wear_um", "worn.transmission_error_um.peak_to_peak"]);
        let front = [vec![4.0, 2.0, 9.0], vec![5.0, 2.5, 4.0], vec![4.2, 2.2, 5.5]];
        let named = reasons(&goals, &front, &[5.0, 2.5, 6.0], &[]);
        let expected = [("least wear", 0), ("quietest over life", 1), ("balanced", 2)];
        assert_eq!(named, expected.map(|(name, place)| (name.to_owned(), place)));
        let one = reasons(&goals, &front[..1], &[5.0, 2.5, 6.0], &[]);
        assert_eq!(one, [("least wear and quietest over life and balanced".to_owned(), 0)]);
        assert_eq!(file_of(&named[1].0), "proposal-quietest-over-life.toml");
    }

    /// Lives are raised: as goals to be lowered they are negative.
    #[test]
    fn the_longest_life_is_the_least_of_its_negative() {
        let named = reasons(&goals(&["life.hours"]), &[vec![-100.0], vec![-200.0]], &[-150.0], &[]);
        assert_eq!(named, [("longest life".to_owned(), 1)]);
    }

    /// Greatest ratios with tolerances: 1.2 · 9/6 = 1.8, 1.5 · 5/5 = 1.5 and 1.2 · 4.2/5 = 1.008; the last is least. A design whose tolerances cannot be run is none.
    #[test]
    fn ver_the_robust_design_is_best_at_its_worst() {
        let goals = goals(&["pinion.peak_wear_um", "worn.transmission_error_um.peak_to_peak"]);
        let front = [vec![4.0, 9.0], vec![5.0, 4.0], vec![4.2, 5.5], vec![4.1, 5.6]];
        let changes = [[0.1, 0.2], [0.5, 0.1], [0.2, 0.1]].map(|own| own.map(Some).to_vec());
        let changes = [changes.to_vec(), vec![vec![Some(0.0), None]]].concat();
        let named = reasons(&goals, &front, &[5.0, 6.0], &changes);
        assert_eq!(named.iter().find(|(name, _)| name.contains("robust")).map(|(_, place)| *place), Some(2));
        // At its worst a long life is shorter.
        let lives = reasons(
            &self::goals(&["life.hours"]),
            &[vec![-200.0], vec![-190.0]],
            &[-150.0],
            &[vec![Some(0.4)], vec![Some(0.1)]],
        );
        assert_eq!(lives, [("longest life".to_owned(), 0), ("robust".to_owned(), 1)]);
    }

    #[test]
    fn ver_tolerances_are_taken_at_their_worst() {
        let beside = [Some(vec![2.2, 3.0]), Some(vec![1.9, 4.4])];
        let found = worsening(&[2.0, 4.0], &beside);
        assert!((found[0].unwrap() - 0.1).abs() < 1e-12 && (found[1].unwrap() - 0.1).abs() < 1e-12, "{found:?}");
        assert_eq!(worsening(&[2.0], &[None]), [None]);
    }

    #[test]
    fn values_at_the_ends_of_ranges_are_told() {
        let free: Vec<FreeKey> = ["pair.pinion.tip_relief.amount_um = 0:40", "pair.pinion.tip_relief.length_mm = 1:5"]
            .iter()
            .map(|text| text.parse().unwrap())
            .collect();
        let edges: Vec<Option<Edge>> = values_of(&free, &[40.0, 2.0]).iter().map(|value| value.edge).collect();
        assert_eq!(edges, [Some(Edge::Upper), None]);
    }
}
