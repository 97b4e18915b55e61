//! Tasks left of a sweep, and their execution on all threads, one combination a thread.
//!
//! A combination is run by one thread from beginning to end: with many combinations that loses nothing to waiting, and a row
//! depends neither on the number of threads nor on the order in which they finish. Where the sweep is verified, the same is done once
//! more with the rows that are chosen for it, which are known when all rows are.

use std::collections::BTreeMap;

use super::combination::{Sweep, SweepTask};
use crate::journal::{Journal, JournalError, RowKeeper};
use crate::spread::{SpreadOutcome, spread};
use crate::sweep::record::{Shard, SweepPart, SweepRow};
use crate::sweep::verification::chosen;
use gearwear_physics::observer::Observer;

/// The combinations of a part of a sweep, in order: every `of`-th, beginning with `number`; `None`: all.
pub fn part(combinations: usize, shard: Option<Shard>) -> impl Iterator<Item = usize> {
    let (first, step) = shard.map_or((0, 1), |shard| (shard.number.saturating_sub(1), shard.of.max(1)));
    (first..combinations).step_by(step)
}

/// Tasks that can be done now: the missing combinations of `shard`; where none is missing, of a whole sweep that asks for it, the chosen rows
/// that are not verified yet.
pub fn tasks(sweep: &Sweep, shard: Option<Shard>, rows: &BTreeMap<usize, SweepRow>) -> Vec<SweepTask> {
    let all = part(sweep.identity.combinations(), shard);
    let missing: Vec<SweepTask> = all.filter(|index| !rows.contains_key(index)).map(SweepTask::Run).collect();
    if !missing.is_empty() || !sweep.identity.verify || shard.is_some() {
        return missing;
    }
    let open = chosen(&sweep.identity, rows.values()).into_iter().filter_map(|(index, chosen)| {
        let row = rows.get(&index).filter(|row| row.verification.is_none())?;
        Some(SweepTask::Verify { row: Box::new(row.clone()), chosen })
    });
    open.collect()
}

/// Does what is left of `shard`, whose finished rows `journal` holds, on `threads` threads.
///
/// # Errors
/// A row that cannot be kept; the rows before it are.
pub fn run(
    sweep: &Sweep,
    shard: Option<Shard>,
    journal: &mut Journal<SweepPart>,
    threads: usize,
    observer: &dyn Observer,
) -> Result<SpreadOutcome, JournalError> {
    loop {
        let rows = &journal.contents.rows;
        let tasks = tasks(sweep, shard, rows);
        let (things, total, mut failed) = match tasks.first() {
            None => return Ok(SpreadOutcome::Completed),
            Some(SweepTask::Run(_)) => {
                let failed = rows.values().filter(|row| row.error.is_some()).count();
                ("combinations", part(sweep.identity.combinations(), shard).count(), failed)
            }
            Some(SweepTask::Verify { .. }) => ("verified", chosen(&sweep.identity, rows.values()).len(), 0),
        };
        let mut done = total - tasks.len();
        observer.counted(done, total, things, &with_failed(failed));
        let tell = |row: &SweepRow| {
            done += 1;
            failed += usize::from(row.error.is_some());
            observer.counted(done, total, things, &with_failed(failed));
        };
        let mut kept = RowKeeper { journal, tell, error: None };
        let ended = spread(&tasks, threads, observer, |task, within| sweep.row_of(task, within), |row| kept.keep(row));
        if let Some(error) = kept.error {
            return Err(error);
        }
        if ended == SpreadOutcome::Interrupted {
            return Ok(ended);
        }
    }
}

fn with_failed(failed: usize) -> String {
    if failed == 0 { String::new() } else { format!(", {failed} failed") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parts of a sweep are disjoint, and together all of it.
    #[test]
    fn shards_take_turns() {
        let parts = [1, 2, 3, 4].map(|number| part(10, Some(Shard { number, of: 4 })).collect::<Vec<_>>());
        assert_eq!(parts, [vec![0, 4, 8], vec![1, 5, 9], vec![2, 6], vec![3, 7]]);
        assert_eq!(part(3, None).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(part(2, Some(Shard { number: 3, of: 3 })).count(), 0);
    }
}
