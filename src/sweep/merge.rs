//! Merges shards of a sweep.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::journal::{self, JournalContents, JournalError, Kept};
use crate::sweep::record::{SweepPart, SweepRow};

/// Greatest number of missing combinations named in a message.
const MOST_NAMED: usize = 5;

/// Errors of a merge.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    #[error(transparent)]
    Journal(#[from] JournalError),
    #[error("{} and {} are not parts of one sweep: {}", first.display(), other.display(), differences.join("; "))]
    OtherSweep {
        first: PathBuf,
        /// The folder of another sweep.
        other: PathBuf,
        /// Differences, in the first and in the other.
        differences: Vec<String>,
    },
    #[error("{} has another result than an earlier folder for {combination}", folder.display())]
    Contradiction { folder: PathBuf, combination: String },
    #[error("{count} of {combinations} combinations are missing: {}{}", named.join("; "), if named.len() < *count { "; …" } else { "" })]
    Incomplete {
        count: usize,
        combinations: usize,
        /// The first of them, in words.
        named: Vec<String>,
        /// Shards that were started and are not finished, in words.
        unfinished: Vec<String>,
    },
}

/// The whole sweep from the journals in `folders`, in any order.
///
/// Parts may overlap, where their results are the same.
pub fn merge(folders: &[PathBuf]) -> Result<JournalContents<SweepPart>, MergeError> {
    let parts: Vec<(&Path, JournalContents<SweepPart>)> = folders
        .iter()
        .map(|folder| Ok((folder.as_path(), journal::read(folder)?)))
        .collect::<Result<_, JournalError>>()?;
    let Some((first, JournalContents { study: SweepPart { identity, .. }, .. })) = parts.first() else {
        return Err(JournalError::NoStudy { folder: PathBuf::new(), kind: SweepPart::KIND }.into());
    };
    let mut rows: BTreeMap<usize, SweepRow> = BTreeMap::new();
    for (folder, part) in &parts {
        let differences = identity.differences(&part.study.identity);
        if !differences.is_empty() {
            let (first, other) = (first.to_path_buf(), folder.to_path_buf());
            return Err(MergeError::OtherSweep { first, other, differences });
        }
        for (&index, row) in &part.rows {
            match rows.get(&index) {
                Some(known) if !known.same_result(row) => {
                    let combination = identity.in_words(index);
                    return Err(MergeError::Contradiction { folder: folder.to_path_buf(), combination });
                }
                Some(known) if known.verification.is_some() => {}
                _ => {
                    rows.insert(index, row.clone());
                }
            }
        }
    }
    let combinations = identity.combinations();
    let missing: Vec<usize> = (0..combinations).filter(|index| !rows.contains_key(index)).collect();
    if missing.is_empty() {
        return Ok(JournalContents { study: SweepPart { identity: identity.clone(), shard: None }, rows });
    }
    let unfinished = parts.iter().filter_map(|(folder, part)| {
        let own: Vec<usize> = super::study::part(combinations, part.study.shard).collect();
        (part.rows.len() < own.len()).then(|| format!("{} ({} of {})", folder.display(), part.rows.len(), own.len()))
    });
    Err(MergeError::Incomplete {
        count: missing.len(),
        combinations,
        named: missing.iter().take(MOST_NAMED).map(|&index| identity.in_words(index)).collect(),
        unfinished: unfinished.collect(),
    })
}
