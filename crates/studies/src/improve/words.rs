//! What a study found, in words.

use super::proposal::{ChosenValue, ComparedFigure, Edge, Proposal, Sensitivity, is_sure};
use super::record::ImproveRecord;
use gearwear::report::html::number::{change, figure as shown};

/// Change below which a figure whose error is not known counts as the same.
const UNKNOWN_ERROR: f64 = 0.02;

impl ComparedFigure {
    /// Whether it counts as changed: by more than the errors, or where they are not known by [`UNKNOWN_ERROR`].
    pub fn is_changed(&self) -> bool {
        self.is_sure.unwrap_or_else(|| self.change().is_none_or(|change| change.abs() > UNKNOWN_ERROR))
            && self.value != self.as_given
    }

    /// "maximum wear of the pinion −21.3 % (5.104 to 4.017 µm)".
    pub fn in_words(&self) -> String {
        let change = self.change().map_or_else(String::new, |change| format!(" {}", signed(change)));
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        format!("{}{change} ({} to {}{unit})", self.heading, shown(self.as_given), shown(self.value))
    }
}

/// Share as a percentage with its sign, to a tenth of a per cent at most.
pub fn signed(share: f64) -> String {
    change(1.0, 1.0 + share)
}

impl ChosenValue {
    /// "pair.pinion.tip_relief.amount_um = 12.5".
    pub fn in_words(&self) -> String {
        format!("{} = {}", self.key, self.value)
    }
}

impl Proposal {
    /// Goals that it betters; then other figures.
    pub fn gains(&self) -> Vec<&ComparedFigure> {
        self.figures.iter().filter(|figure| figure.is_better() && figure.is_changed()).collect()
    }

    /// Goals and other figures that it worsens.
    pub fn costs(&self) -> Vec<&ComparedFigure> {
        self.figures.iter().filter(|figure| !figure.is_better() && figure.is_changed()).collect()
    }

    /// Goals whose difference to the scene as given is no more than the errors.
    pub fn same(&self) -> Vec<&ComparedFigure> {
        self.figures.iter().filter(|figure| figure.is_goal && !figure.is_changed()).collect()
    }

    /// How sure the differences of the goals are.
    pub fn sureness(&self) -> String {
        let goals: Vec<&ComparedFigure> = self.figures.iter().filter(|figure| figure.is_goal).collect();
        if goals.iter().all(|goal| goal.is_sure == Some(true)) {
            return "All goals differ by more than the errors".to_owned();
        }
        let named = |wanted: Option<bool>| -> Vec<&str> {
            goals.iter().filter(|goal| goal.is_sure == wanted).map(|goal| goal.heading.as_str()).collect()
        };
        let [within, unknown] = [Some(false), None].map(named);
        let said = [(within, "within the errors, no difference"), (unknown, "its error is not known")];
        let said = said.into_iter().filter(|(names, _)| !names.is_empty());
        capitalised(&said.map(|(names, what)| format!("{}: {what}", names.join(", "))).collect::<Vec<_>>().join("; "))
    }

    /// Goals whose gain the tolerances take at worst.
    pub fn lost_to_tolerances(&self) -> Vec<&str> {
        let goals = self.figures.iter().filter(|figure| figure.is_goal).zip(&self.tolerances_together);
        let lost = goals.filter_map(|(goal, together)| {
            let gain = (goal.as_given - goal.value).abs() / goal.value.abs();
            (goal.is_better() && goal.is_changed() && (*together)? > gain).then_some(goal.heading.as_str())
        });
        lost.collect()
    }

    /// What tolerances take, and the key that takes most; empty where none are given.
    pub fn tolerance(&self) -> String {
        let goals = self.figures.iter().filter(|figure| figure.is_goal);
        let worst = goals.zip(&self.tolerances_together).enumerate().filter_map(|(place, (goal, together))| {
            let together = (*together)?;
            // A life gets shorter.
            let change = if goal.less_is_better { together } else { -together };
            let by = |one: &Sensitivity| one.changes[place].unwrap_or_default();
            let most = self.sensitivity.iter().max_by(|a, b| by(a).total_cmp(&by(b)));
            let most = most.filter(|one| 2.0 * by(one) > together && self.sensitivity.len() > 1);
            let by = most.map_or_else(String::new, |one| format!(", mostly by {}", one.key));
            let unit = if goal.unit.is_empty() { String::new() } else { format!(" {}", goal.unit) };
            let value = shown(goal.value * (1.0 + change));
            Some(format!("{} {} (to {value}{unit}{by})", goal.heading, signed(change)))
        });
        let worst: Vec<String> = worst.collect();
        if worst.is_empty() {
            String::new()
        } else {
            format!("all tolerances together, at worst: {}", worst.join(", "))
        }
    }

    /// Goals against those of another proposal, where they differ by more than the errors of both, and where they do not.
    pub fn against(&self, other: &Self) -> String {
        let [own, its] = [self, other].map(|proposal| proposal.figures.iter().filter(|figure| figure.is_goal));
        let compared = own.zip(its).map(|(own, its)| {
            let change = if its.value == 0.0 { String::new() } else { signed(own.value / its.value - 1.0) };
            let judged = match is_sure((own.value, own.error), (its.value, its.error)) {
                Some(true) => "",
                Some(false) => " (within the errors)",
                None => " (errors not known)",
            };
            format!("{} {change}{judged}", own.heading)
        });
        format!("against {}: {}", other.name, compared.collect::<Vec<_>>().join(", "))
    }

    /// Values on the ends of their ranges.
    pub fn edges(&self) -> Vec<String> {
        let of = |value: &ChosenValue| {
            let end = match value.edge? {
                Edge::Lower => "lower",
                Edge::Upper => "upper",
            };
            Some(format!("{} is on the {end} end of its range", value.in_words()))
        };
        self.values.iter().filter_map(of).collect()
    }

    /// First sentence: gain and cost in the goals.
    pub fn headline(&self) -> String {
        let goals = |figures: Vec<&ComparedFigure>| -> Vec<String> {
            let goals = figures.into_iter().filter(|figure| figure.is_goal);
            goals.map(|goal| format!("{} {}", goal.heading, goal.change().map_or_else(String::new, signed))).collect()
        };
        let (gains, costs, same) = (goals(self.gains()), goals(self.costs()), self.same().len());
        let mut parts = gains;
        parts.extend(costs);
        if parts.is_empty() && same > 0 {
            parts.push("no difference to the scene as given".to_owned());
        }
        format!("{}: {}", capitalised(&self.name), parts.join(", "))
    }
}

fn capitalised(text: &str) -> String {
    gearwear::report::html::reading::capitalised(text)
}

impl ImproveRecord {
    /// The answer, in a few sentences.
    pub fn answer(&self) -> String {
        let proposals: Vec<String> = self.proposals.iter().map(Proposal::headline).collect();
        format!("{}.", proposals.join(". "))
    }
}
