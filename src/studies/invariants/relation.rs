//! A relation between a scene and another one made from it, of which physics says how their results follow from each other.

use toml::Table;

use super::carried_out::Ended;
use super::comparison::Measured;
use crate::results::run::RunRecord;

/// A relation of the suite.
#[derive(Clone, Copy)]
pub(crate) struct Relation {
    pub name: &'static str,
    /// What must be so, in a sentence.
    pub states: &'static str,
    /// Why the bound is what it is.
    pub bound: &'static str,
    /// Whether so few scenes can be held against it that each is.
    pub is_rare: bool,
    pub check: fn(&Subject<'_>) -> Verdict,
}

/// A scene that has run.
pub(crate) struct Subject<'a> {
    pub table: &'a Table,
    pub record: &'a RunRecord,
    /// Runs another one.
    pub run: &'a dyn Fn(&Table) -> Result<RunRecord, Ended>,
}

/// What a relation came to on a scene.
pub(crate) enum Verdict {
    /// It says nothing of such a scene.
    NotOfThisScene,
    /// The other scene did not run to its end.
    Ended { scene: Table, how: Ended },
    /// Differences found, with the other scene.
    Measured { scene: Table, figures: Vec<Measured> },
}

impl Subject<'_> {
    /// Runs the scene `other` and judges its record.
    pub(super) fn beside(&self, other: Table, judge: impl FnOnce(&RunRecord) -> Vec<Measured>) -> Verdict {
        match (self.run)(&other) {
            Ok(record) => Verdict::Measured { figures: judge(&record), scene: other },
            Err(how) => Verdict::Ended { scene: other, how },
        }
    }

    /// Runs two scenes and judges both.
    pub(super) fn two(
        &self,
        one: Table,
        other: Table,
        judge: impl FnOnce(&RunRecord, &RunRecord) -> Vec<Measured>,
    ) -> Verdict {
        match (self.run)(&one) {
            Ok(first) => self.beside(other, |second| judge(&first, second)),
            Err(how) => Verdict::Ended { scene: one, how },
        }
    }
}
