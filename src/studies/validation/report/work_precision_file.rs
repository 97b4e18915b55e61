//! `work_precision.json`: error against cost of every setting, by case, so that a service can plot their history.

use serde::Serialize;

use crate::studies::validation::record::{ValidationRecord, WorkPrecisionPoint};

/// The file.
#[derive(Debug, Serialize)]
pub(super) struct WorkPrecisionFile<'a> {
    program_version: &'a str,
    threads: usize,
    cases: Vec<CasePoints<'a>>,
}

#[derive(Debug, Serialize)]
struct CasePoints<'a> {
    case: &'a str,
    title: &'a str,
    points: &'a [WorkPrecisionPoint],
}

impl<'a> WorkPrecisionFile<'a> {
    /// That of `record`: the cases that have such points.
    pub(super) fn of(record: &'a ValidationRecord) -> Self {
        let cases = record.cases.iter().filter(|case| !case.work_precision.is_empty());
        Self {
            program_version: &record.program_version,
            threads: record.threads,
            cases: cases
                .map(|case| CasePoints { case: &case.name, title: &case.title, points: &case.work_precision })
                .collect(),
        }
    }
}
