//! Statements that hold for every run, whatever its scene, as they were found to hold or not.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A statement that holds for every run, held against this one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Invariant {
    /// Name of the statement.
    pub name: String,
    /// Whether the run contradicts it: an error of the program, or of a resolution far too coarse.
    pub violated: bool,
    /// Greatest deviation found; `None` where the run has nothing to hold against it, which `how` explains.
    pub value: Option<f64>,
    /// Greatest deviation that physics and the resolution of the run allow.
    pub bound: Option<f64>,
    /// Where the deviation is greatest.
    pub place: Option<String>,
    /// Statement in words, with what the deviation is relative to.
    pub how: String,
}

impl Invariant {
    /// A statement held against the greatest deviation `value`, at `place`. A deviation that is no number violates it.
    pub fn judged(name: &str, value: f64, bound: f64, place: Option<String>, how: &str) -> Self {
        let holds = value <= bound;
        Self {
            name: name.to_owned(),
            violated: !holds,
            value: Some(value),
            bound: Some(bound),
            place,
            how: how.to_owned(),
        }
    }

    /// A statement that the run has nothing to hold against, for the reason in `how`.
    pub fn not_judged(name: &str, how: &str) -> Self {
        Self { name: name.to_owned(), violated: false, value: None, bound: None, place: None, how: how.to_owned() }
    }

    /// Violation on one line; `None` where there is none.
    pub fn violation(&self) -> Option<String> {
        let value = self.value.filter(|_| self.violated)?;
        let place = self.place.as_ref().map_or_else(String::new, |place| format!(", {place}"));
        let bound = self.bound.unwrap_or(f64::NAN);
        Some(format!("{}: found {value:.3e}, allowed {bound:.3e}{place} ({})", self.name, self.how))
    }
}
