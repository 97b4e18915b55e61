//! How many cases and quantities came out in which way.

use super::verdict::Verdict;
use super::words::{counted, time};
use crate::studies::validation::record::{CaseRecord, ValidationRecord};

/// The counts that every report begins with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Totals {
    /// Cases carried out or tried.
    pub(super) cases: usize,
    /// Cases that stand as they say.
    pub(super) passed: usize,
    /// Cases with a quantity that is not as expected.
    pub(super) missed: usize,
    pub(super) could_not_run: usize,
    pub(super) on_estimates: usize,
    pub(super) quantities: usize,
    /// Quantities within their bounds.
    pub(super) hold: usize,
    /// Statements that are known not to hold.
    pub(super) known_not: usize,
    pub(super) cannot_be_compared: usize,
}

impl Totals {
    pub(super) fn of(record: &ValidationRecord) -> Self {
        let cases = |wanted: &dyn Fn(&CaseRecord) -> bool| record.cases.iter().filter(|case| wanted(case)).count();
        let quantities = |wanted: &dyn Fn(Verdict) -> bool| {
            let all = record.cases.iter().flat_map(|case| &case.quantities);
            all.map(Verdict::of_quantity).filter(|&verdict| wanted(verdict)).count()
        };
        Self {
            cases: record.cases.len(),
            passed: cases(&CaseRecord::passed),
            missed: cases(&|case| case.failure.is_none() && !case.passed()),
            could_not_run: cases(&|case| case.failure.is_some()),
            on_estimates: cases(&|case| !case.rests_on.is_empty()),
            quantities: quantities(&|_| true),
            hold: quantities(&|verdict| matches!(verdict, Verdict::Holds | Verdict::NowHolds)),
            known_not: quantities(&|verdict| verdict == Verdict::KnownNot),
            cannot_be_compared: quantities(&|verdict| verdict == Verdict::CannotBeCompared),
        }
    }
}

/// The suite in a few sentences.
pub(super) fn sentence(record: &ValidationRecord) -> String {
    let t = Totals::of(record);
    if t.cases == 0 {
        return "No case was run.".to_owned();
    }
    let verdict = if t.passed == t.cases {
        match t.cases {
            1 => "The case stands as it should.".to_owned(),
            cases => format!("All {cases} cases stand as they should."),
        }
    } else {
        let mut wrong = Vec::new();
        if t.missed > 0 {
            wrong.push(format!("{} missed", t.missed));
        }
        if t.could_not_run > 0 {
            wrong.push(format!("{} could not run", t.could_not_run));
        }
        format!("{} of {} cases stand as they should; {}.", t.passed, t.cases, wrong.join(", "))
    };
    let known = match (t.known_not, t.cannot_be_compared) {
        (0, 0) => String::new(),
        (known, 0) => format!(" {} known not to hold.", counted(known, "is", "are")),
        (0, open) => format!(" {open} cannot be compared."),
        (known, open) => format!(" {} known not to hold, and {open} cannot be compared.", counted(known, "is", "are")),
    };
    format!(
        "{verdict} Of {}, {}.{known} It took {} on {}.",
        counted(t.quantities, "quantity", "quantities"),
        counted(t.hold, "holds", "hold"),
        time(record.wall_s),
        counted(record.threads, "thread", "threads"),
    )
}
