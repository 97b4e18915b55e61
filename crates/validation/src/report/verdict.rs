//! Verdict of a case or a quantity, with its word and sign.
//!
//! The record keeps apart what *holds* (physics) and what is *as expected* (the exit status). Readers need one word for
//! both: a statement that does not hold and is not expected to is no news, the same one holding all of a sudden is.

use crate::record::{CaseRecord, Criterion, QuantityRecord, Standing};

/// Verdict of a case or a quantity, the most urgent first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Verdict {
    /// The case could not be carried out to its end.
    CouldNotRun,
    /// Does not hold, or cannot be compared, against expectation.
    Missed,
    /// Holds against expectation.
    NowHolds,
    /// Does not hold, as the case says.
    KnownNot,
    /// There is nothing to compare with, as the case says.
    CannotBeCompared,
    /// Holds, as expected.
    Holds,
    /// A number that nothing is compared with.
    Reported,
}

impl Verdict {
    /// All of them, the most urgent first.
    pub(super) const ALL: [Self; 7] = [
        Self::CouldNotRun,
        Self::Missed,
        Self::NowHolds,
        Self::KnownNot,
        Self::CannotBeCompared,
        Self::Holds,
        Self::Reported,
    ];

    pub(super) fn of_quantity(quantity: &QuantityRecord) -> Self {
        // Reported only: no comparison was asked for.
        let is_only_reported =
            quantity.criterion == Criterion::Reported && quantity.value.is_some() && quantity.remark.is_none();
        match (quantity.as_expected(), quantity.standing) {
            (true, Standing::Holds) => Self::Holds,
            (true, Standing::Fails) => Self::KnownNot,
            (true, Standing::CannotBeCompared) if is_only_reported => Self::Reported,
            (true, Standing::CannotBeCompared) => Self::CannotBeCompared,
            (false, Standing::Holds) => Self::NowHolds,
            (false, Standing::Fails | Standing::CannotBeCompared) => Self::Missed,
        }
    }

    /// Verdict of a case: the most urgent of its quantities.
    pub(super) fn of_case(case: &CaseRecord) -> Self {
        if case.failure.is_some() {
            return Self::CouldNotRun;
        }
        Self::of_quantities(&case.quantities.iter().collect::<Vec<_>>())
    }

    /// Verdict of several quantities: the most urgent of theirs.
    pub(super) fn of_quantities(quantities: &[&QuantityRecord]) -> Self {
        let each: Vec<Self> = quantities.iter().map(|quantity| Self::of_quantity(quantity)).collect();
        let worst = each.iter().min().copied().unwrap_or(Self::Reported);
        // A quantity that cannot be compared does not decide the verdict of a case with one that holds.
        if worst == Self::CannotBeCompared && each.contains(&Self::Holds) { Self::Holds } else { worst }
    }

    pub(super) fn word(self) -> &'static str {
        self.shown()[0]
    }

    /// A sign of one letter, told apart without colour.
    pub(super) fn sign(self) -> &'static str {
        self.shown()[1]
    }

    /// Name in the page's style sheet and script.
    pub(super) fn class(self) -> &'static str {
        self.shown()[2]
    }

    /// Word, sign and class.
    fn shown(self) -> [&'static str; 3] {
        match self {
            Self::CouldNotRun => ["could not run", "‼", "could-not-run"],
            Self::Missed => ["missed", "✗", "missed"],
            Self::NowHolds => ["holds unexpectedly", "↑", "now-holds"],
            Self::KnownNot => ["known not to hold", "≠", "known-not"],
            Self::CannotBeCompared => ["cannot be compared", "?", "not-comparable"],
            Self::Holds => ["holds", "✓", "holds"],
            Self::Reported => ["reported", "·", "reported"],
        }
    }

    /// Whether it fails the suite.
    pub(super) fn is_failure(self) -> bool {
        matches!(self, Self::CouldNotRun | Self::Missed | Self::NowHolds)
    }
}
