//! What became of the suite since an earlier run.
use crate::simulation::validation_record::{Changes, ValidationRecord};

/// The changes.
pub fn changes(old: &ValidationRecord, _new: &ValidationRecord) -> Changes {
    Changes {
        against_version: old.program_version.clone(),
        worse: Vec::new(),
        better: Vec::new(),
        added: Vec::new(),
        gone: Vec::new(),
    }
}
