//! What a study found, in words.

use super::proposal::{ChosenValue, ComparedFigure, Edge, Proposal};
use super::record::ImproveRecord;
use gearwear::report::html::number::{figure as shown, percent};

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

/// Share as a percentage with its sign.
pub fn signed(share: f64) -> String {
    let sign = if share > 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(share))
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
        let named = |wanted: Option<bool>| -> Vec<&str> {
            goals.iter().filter(|goal| goal.is_sure == wanted).map(|goal| goal.heading.as_str()).collect()
        };
        let [sure, within, unknown] = [Some(true), Some(false), None].map(named);
        let said = [
            (sure, "more than the errors of both"),
            (within, "within the errors of both, no difference"),
            (unknown, "of unknown error"),
        ];
        let said = said.into_iter().filter(|(names, _)| !names.is_empty());
        said.map(|(names, what)| format!("{}: {what}", names.join(", "))).collect::<Vec<_>>().join("; ")
    }

    /// What tolerances take; empty where none are given.
    pub fn tolerance(&self, goals: &[String]) -> String {
        let worst = goals
            .iter()
            .zip(&self.tolerances_together)
            .filter_map(|(heading, together)| Some(format!("{heading} {}", signed((*together)?))));
        let worst: Vec<String> = worst.collect();
        if worst.is_empty() {
            String::new()
        } else {
            format!("all tolerances together, at worst: {}", worst.join(", "))
        }
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
    /// Headings of the goals.
    pub fn headings(&self) -> Vec<String> {
        self.goals.iter().map(|goal| goal.heading.clone()).collect()
    }

    /// The answer, in a few sentences.
    pub fn answer(&self) -> String {
        let proposals: Vec<String> = self.proposals.iter().map(Proposal::headline).collect();
        format!("{}.", proposals.join(". "))
    }
}
