//! The files of the validation suite, written from its [`ValidationRecord`] alone.
//!
//! | file | for |
//! |---|---|
//! | `report.html` | readers: what holds, by what margin, what it cost, what rests on estimates |
//! | `junit.xml` | services that collect test results; with the feature `program` |
//! | `summary.md` | the summary or a comment of a CI service, as Markdown |
//! | `work_precision.json` | plots of the history of error against run time |
//! | `validation.json` | the next run, to be compared with: the whole record but its plots |

mod case_figures;
mod case_section;
mod junit;
mod markdown;
mod markup;
mod overview;
mod page;
mod stability_map;
#[cfg(test)]
mod synthetic;
mod targets_table;
mod terminal;
#[cfg(test)]
mod tests;
mod totals;
mod verdict;
mod words;
mod work_precision_figures;

use std::path::{Path, PathBuf};

pub use self::terminal::terminal;
use crate::record::{Changes, ValidationRecord, WorkPrecisionPoint};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};
use serde::Serialize;

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "validation.json";
const JUNIT: &str = "junit.xml";
const SUMMARY: &str = "summary.md";
const WORK_PRECISION: &str = "work_precision.json";

/// Writes all files of `record` into `dir`, which is made if need be; returns their paths in the order written.
pub fn write(record: &ValidationRecord, changes: Option<&Changes>, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    Ok(vec![
        place(dir, gearwear::report::output_files::PAGE, |out| out.write_all(page::page(record, changes).as_bytes()))?,
        place(dir, JUNIT, |out| junit::write(out, record))?,
        place(dir, SUMMARY, |out| out.write_all(markdown::text(record, changes).as_bytes()))?,
        place(dir, WORK_PRECISION, |out| write_json(out, &work_precision(record)))?,
        place(dir, LAST, |out| write_json(out, record))?,
    ])
}

/// `work_precision.json`: error against cost of every setting, by case, so that a service can plot their history.
fn work_precision(record: &ValidationRecord) -> impl Serialize {
    #[derive(Serialize)]
    struct File<'a> {
        program_version: &'a str,
        threads: usize,
        cases: Vec<CasePoints<'a>>,
    }
    #[derive(Serialize)]
    struct CasePoints<'a> {
        case: &'a str,
        title: &'a str,
        points: &'a [WorkPrecisionPoint],
    }
    let cases = record.cases.iter().filter(|case| !case.work_precision.is_empty());
    let cases =
        cases.map(|case| CasePoints { case: &case.name, title: &case.title, points: &case.work_precision }).collect();
    File { program_version: &record.program_version, threads: record.threads, cases }
}
