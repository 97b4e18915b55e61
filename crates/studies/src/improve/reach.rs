//! What no design does: bounds that hold for all that were tried, in words.

use super::asked::ImproveQuestion;
use super::goal::{ImproveGoal, heading};
use super::kept::{DesignRole, KeptDesign};
use super::search::Outcome;
use gearwear::report::html::number::{figure as shown, percent, significant};

/// Ratio of worn to new transmission error from which it is said to grow.
const GROWS: f64 = 1.05;
const NEW_ERROR: &str = "new.transmission_error_um.peak_to_peak";
const WORN_ERROR: &str = "worn.transmission_error_um.peak_to_peak";

/// Designs of a study as they are judged.
pub struct Tried<'a> {
    pub question: &'a ImproveQuestion,
    pub designs: &'a [KeptDesign],
    /// Outcomes of the designs of the search, in their order.
    pub outcomes: &'a [Option<Outcome>],
    /// The scene as given, verified.
    pub as_given: &'a KeptDesign,
}

impl Tried<'_> {
    /// Figures of the designs of the search within the limits.
    fn allowed(&self) -> impl Iterator<Item = &[Option<f64>]> {
        let searched = self.designs.iter().filter(|design| design.role == DesignRole::Search);
        searched.zip(self.outcomes).filter_map(|(design, outcome)| {
            outcome.as_ref().filter(|outcome| outcome.is_allowed())?;
            design.figures.as_deref().ok()
        })
    }

    /// Verified designs with their errors, the scene as given apart.
    fn verified(&self) -> impl Iterator<Item = &KeptDesign> {
        self.designs.iter().filter(|design| design.role == DesignRole::Verify && design.values.is_some())
    }

    /// Statements, each a sentence.
    pub fn statements(&self) -> Vec<String> {
        let goals = self.question.goals.iter().filter_map(|goal| self.of_goal(goal));
        goals.chain(self.growth()).chain(self.new_against_worn()).collect()
    }

    /// How far a goal comes, by the verified designs.
    fn of_goal(&self, goal: &ImproveGoal) -> Option<String> {
        let value = |design: &KeptDesign| {
            let figures = design.figures.as_deref().ok()?;
            let value = goal.value(|path| self.question.figure(figures, path))?;
            let total = design.total.as_ref()?;
            Some((value, goal.error(|path| self.question.figure(figures, path), total)))
        };
        let (given, given_error) = value(self.as_given)?;
        let better = |a: &(f64, Option<f64>), b: &(f64, Option<f64>)| {
            if goal.is_raised() { b.0.total_cmp(&a.0) } else { a.0.total_cmp(&b.0) }
        };
        let (best, error) = self.verified().filter_map(value).min_by(better)?;
        let gain = if goal.is_raised() { best - given } else { given - best };
        let (lower, below, way) =
            if goal.is_raised() { ("raises", "exceeds", "more") } else { ("lowers", "goes below", "less") };
        let errors = error.zip(given_error).map(|(own, its)| own * best.abs() + its * given.abs());
        Some(match errors {
            Some(errors) if gain <= errors => {
                format!("No design found {lower} the {} by more than the errors of both.", goal.heading())
            }
            _ => format!(
                "No design found {below} {} {} of {}, {} {way} than as given.",
                shown(best),
                goal.unit(),
                goal.heading(),
                percent((gain / given).abs())
            ),
        })
    }

    /// Growth of the transmission error with wear, where every design has it.
    fn growth(&self) -> Option<String> {
        let ratio = |figures: &[Option<f64>]| {
            let [new, worn] = [NEW_ERROR, WORN_ERROR].map(|path| self.question.figure(figures, path));
            Some(worn? / new?).filter(|ratio| ratio.is_finite())
        };
        let least = self.allowed().filter_map(ratio).reduce(f64::min).filter(|least| *least >= GROWS)?;
        let given = ratio(self.as_given.figures.as_deref().ok()?)?;
        Some(format!(
            "The transmission error grows with wear whatever is chosen: {} times at least ({} times as given).",
            significant(least, 3),
            significant(given, 3)
        ))
    }

    /// Whether the design that is quietest when new is so when worn.
    fn new_against_worn(&self) -> Option<String> {
        let both = |figures: &[Option<f64>]| {
            let [new, worn] = [NEW_ERROR, WORN_ERROR].map(|path| self.question.figure(figures, path));
            new.zip(worn)
        };
        let all: Vec<(f64, f64)> = self.allowed().filter_map(both).collect();
        let quietest_new = all.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let quietest_worn = all.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        (quietest_new.1 > GROWS * quietest_worn.1).then(|| {
            format!(
                "The design with the least {} ({} µm) comes to {} µm with wear; the one with the least when worn goes from {} to {} µm.",
                heading(NEW_ERROR),
                shown(quietest_new.0),
                shown(quietest_new.1),
                shown(quietest_worn.0),
                shown(quietest_worn.1)
            )
        })
    }
}
