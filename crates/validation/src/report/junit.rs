//! `junit.xml`: a suite for each case, a test for each quantity, for the services that collect test results.
//!
//! What is not as expected is a failure, and a case that could not run an error. A number that has nothing to be compared
//! with counts as skipped, with what is missing; a case is never skipped. Work and wall time are properties of the suite.

use std::io::{self, Write};
use std::time::Duration;

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::verdict::Verdict;
use super::words;
use crate::record::{CaseRecord, QuantityRecord, ValidationRecord};

/// The test of a case as a whole.
const RUNS: &str = "the case runs to its end";

pub(super) fn write(out: &mut dyn Write, record: &ValidationRecord) -> io::Result<()> {
    let mut report = Report::new("gearwear validate");
    report.set_time(duration(record.wall_s));
    report.add_test_suites(record.cases.iter().map(suite));
    report.add_test_suites(record.not_run.iter().map(|name| {
        let mut suite = TestSuite::new(name.as_str());
        suite.add_test_case(test(RUNS, name, non_success(NonSuccessKind::Error, "interrupted before it")));
        suite
    }));
    report.serialize(out).map_err(io::Error::other)
}

fn suite(case: &CaseRecord) -> TestSuite {
    let mut suite = TestSuite::new(case.name.as_str());
    suite.set_time(duration(case.wall_s));
    let kind = case.kind.title();
    let facts = [
        ("title", case.title.as_str()),
        ("group", &case.group),
        ("requirement", &case.requirement),
        ("kind", &kind),
        ("tier", case.tier.name()),
    ];
    suite.add_properties(facts.into_iter().chain(case.targets.iter().map(|target| ("target", target.as_str()))));
    suite.add_properties(case.rests_on.iter().map(|estimate| ("rests on an estimate", estimate.as_str())));
    suite.add_property(("wall_s", case.wall_s.to_string().as_str()));
    for (name, count) in &case.work {
        suite.add_property((format!("work: {name}").as_str(), count.to_string().as_str()));
    }
    if let Some(failure) = &case.failure {
        suite.add_test_case(test(RUNS, &case.name, non_success(NonSuccessKind::Error, failure)));
    } else if case.quantities.is_empty() {
        suite.add_test_case(test(RUNS, &case.name, TestCaseStatus::success()));
    }
    suite.add_test_cases(case.quantities.iter().map(|quantity| quantity_test(case, quantity)));
    suite
}

fn quantity_test(case: &CaseRecord, quantity: &QuantityRecord) -> TestCase {
    let said = words::deviation(quantity);
    let verdict = Verdict::of_quantity(quantity);
    let status = match verdict {
        Verdict::CouldNotRun | Verdict::Missed | Verdict::NowHolds => non_success(NonSuccessKind::Failure, &said),
        Verdict::CannotBeCompared => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(said.as_str());
            status
        }
        Verdict::KnownNot | Verdict::Holds | Verdict::Reported => TestCaseStatus::success(),
    };
    let mut test = test(&quantity.name, &case.name, status);
    test.set_system_out(format!("{}: {said}", verdict.word()));
    test
}

fn test(name: &str, case: &str, status: TestCaseStatus) -> TestCase {
    let mut test = TestCase::new(name, status);
    test.set_classname(case);
    test
}

fn non_success(kind: NonSuccessKind, message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_message(message);
    status
}

/// Duration; zero where `wall_s` is not a valid time.
fn duration(wall_s: f64) -> Duration {
    Duration::try_from_secs_f64(wall_s).unwrap_or_default()
}
