//! The files of the validation suite, written from its [`ValidationRecord`] alone.
use std::path::{Path, PathBuf};

use super::{ReportError, create_folder, place, summary};
use crate::simulation::validation_record::{Changes, ValidationRecord};

/// Writes all files of `record` into `dir`.
pub fn write(record: &ValidationRecord, _: Option<&Changes>, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    Ok(vec![place(dir, "validation.json", |out| summary::write(out, record))?])
}

/// For the terminal.
pub fn terminal(record: &ValidationRecord, _: Option<&Changes>, _: Option<u16>) -> String {
    let mut text = String::new();
    for case in &record.cases {
        text.push_str(&format!(
            "{} {} {:.2} s {:?}\n",
            if case.passed() { "ok    " } else { "MISSED" },
            case.name,
            case.wall_s,
            case.failure
        ));
        for q in &case.quantities {
            text.push_str(&format!(
                "    {} {} = {:?} {} {:?} share {:?} {}\n",
                q.standing.title(),
                q.name,
                q.value,
                q.unit,
                q.criterion,
                q.share,
                q.remark.as_deref().unwrap_or("")
            ));
        }
    }
    text
}
