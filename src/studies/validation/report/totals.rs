//! How many cases and quantities came out in which way.

use super::verdict::Verdict;
use super::words::{counted, time};
use crate::studies::validation::record::{CaseRecord, ValidationRecord};

/// The counts that every report begins with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Totals {
    /// Cases carried out or tried.
    pub(super) cases: usize,
    /// Cases that are as expected.
    pub(super) passed: usize,
    /// Number of cases with a statement that is known not to hold.
    pub(super) deviating: usize,
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
    /// Numbers that nothing is compared with.
    pub(super) reported: usize,
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
            deviating: cases(&|case| {
                let known_not = |quantity| Verdict::of_quantity(quantity) == Verdict::KnownNot;
                case.passed() && case.quantities.iter().any(known_not)
            }),
            missed: cases(&|case| case.failure.is_none() && !case.passed()),
            could_not_run: cases(&|case| case.failure.is_some()),
            on_estimates: cases(&|case| !case.rests_on.is_empty()),
            quantities: quantities(&|_| true),
            hold: quantities(&|verdict| matches!(verdict, Verdict::Holds | Verdict::NowHolds)),
            known_not: quantities(&|verdict| verdict == Verdict::KnownNot),
            cannot_be_compared: quantities(&|verdict| verdict == Verdict::CannotBeCompared),
            reported: quantities(&|verdict| verdict == Verdict::Reported),
        }
    }
}

/// The suite in a few sentences.
pub(super) fn sentence(record: &ValidationRecord) -> String {
    let t = Totals::of(record);
    if t.cases == 0 {
        return "No case was run.".to_owned();
    }
    let deviate = if t.deviating == 1 { "contains documented deviations" } else { "contain documented deviations" };
    let cases = listed(&[
        (t.passed - t.deviating, "pass"),
        (t.deviating, deviate),
        (t.missed, "missed"),
        (t.could_not_run, "could not run"),
    ]);
    let failed = t.quantities - t.hold - t.known_not - t.cannot_be_compared - t.reported;
    let quantities = listed(&[
        (t.hold, if t.hold == 1 { "holds" } else { "hold" }),
        (failed, "missed"),
        (t.known_not, if t.known_not == 1 { "is known not to hold" } else { "are known not to hold" }),
        (t.cannot_be_compared, "cannot be compared"),
        (t.reported, if t.reported == 1 { "is reported alone" } else { "are reported alone" }),
    ]);
    format!(
        "Of {}, {cases}. Of {}, {quantities}. It took {} on {}.",
        counted(t.cases, "case", "cases"),
        counted(t.quantities, "quantity", "quantities"),
        time(record.wall_s),
        counted(record.threads, "thread", "threads"),
    )
}

/// Counts with what they are of; those of nothing are left out.
fn listed(counts: &[(usize, &str)]) -> String {
    let some = counts.iter().filter(|(count, _)| *count > 0);
    some.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(", ")
}
