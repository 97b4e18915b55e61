//! Counts of cases and quantities by verdict.

use super::verdict::Verdict;
use super::words::{counted, time};
use crate::record::ValidationRecord;

/// The counts that every report begins with.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
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
        let mut totals = Self::default();
        for case in &record.cases {
            let verdicts: Vec<Verdict> = case.quantities.iter().map(Verdict::of_quantity).collect();
            let passed = case.passed();
            totals.cases += 1;
            totals.passed += usize::from(passed);
            totals.deviating += usize::from(passed && verdicts.contains(&Verdict::KnownNot));
            totals.missed += usize::from(case.failure.is_none() && !passed);
            totals.could_not_run += usize::from(case.failure.is_some());
            totals.on_estimates += usize::from(!case.rests_on.is_empty());
            totals.quantities += verdicts.len();
            for verdict in verdicts {
                match verdict {
                    Verdict::Holds | Verdict::NowHolds => totals.hold += 1,
                    Verdict::KnownNot => totals.known_not += 1,
                    Verdict::CannotBeCompared => totals.cannot_be_compared += 1,
                    Verdict::Reported => totals.reported += 1,
                    Verdict::CouldNotRun | Verdict::Missed => {}
                }
            }
        }
        totals
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

/// Counts with their names, without those that are 0.
fn listed(counts: &[(usize, &str)]) -> String {
    let some = counts.iter().filter(|(count, _)| *count > 0);
    some.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(", ")
}
