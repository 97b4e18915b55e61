//! Runs what is missing of a sweep on all threads, one combination a thread.
//!
//! A combination is run by one thread from beginning to end: with many combinations that loses nothing to waiting, and a row
//! depends neither on the number of threads nor on the order in which they finish.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::combination::Sweep;
use super::journal::{Journal, JournalError};
use crate::pipeline;
use crate::plan::StageKind;
use crate::simulation::sweep_record::{Shard, SweepRow};
use crate::simulation::wear_run;

/// Told of rows as they are finished; says whether to go on.
pub trait Observer: Sync {
    /// `done` of `total` combinations are finished, those of an earlier start included; `failed` of them have an error.
    fn row(&self, done: usize, total: usize, failed: usize);

    /// Whether the user wants it to stop: rows that are finished are kept, the others are given up.
    fn interrupted(&self) -> bool;
}

/// How a sweep ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// Every combination has its row.
    Completed,
    /// The user interrupted it.
    Interrupted,
}

/// The combinations of a part of a sweep, in order: every `of`-th, beginning with `number`; `None`: all.
pub fn part(combinations: usize, shard: Option<Shard>) -> impl Iterator<Item = usize> {
    let (first, step) = shard.map_or((0, 1), |shard| (shard.number.saturating_sub(1), shard.of.max(1)));
    (first..combinations).step_by(step)
}

/// A run within a sweep: it stops when the sweep does.
struct Within<'a> {
    observer: &'a dyn Observer,
    stopped: &'a AtomicBool,
}

impl wear_run::Progress for Within<'_> {
    fn progress(&self, _done: f64, _total: f64) {}

    fn interrupted(&self) -> bool {
        self.stopped.load(Ordering::Relaxed) || self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.interrupted()
    }
}

impl pipeline::Observer for Within<'_> {
    fn stage(&self, _kind: StageKind) {}
}

/// What the threads share.
struct Kept<'a> {
    journal: &'a mut Journal,
    /// Rows with an error.
    failed: usize,
    /// Why no row can be kept any more.
    error: Option<JournalError>,
}

impl Kept<'_> {
    /// Keeps a finished row, if rows can still be kept: what follows a line that was not written whole could not be read again.
    fn keep(&mut self, row: SweepRow) -> bool {
        if self.error.is_none() {
            self.failed += usize::from(row.error.is_some());
            self.error = self.journal.append(row).err();
        }
        self.error.is_none()
    }
}

/// Runs the combinations of `shard` that `journal` does not hold yet, on `threads` threads.
///
/// # Errors
/// A row that cannot be kept; the rows before it are.
pub fn run(
    sweep: &Sweep,
    shard: Option<Shard>,
    journal: &mut Journal,
    threads: usize,
    observer: &dyn Observer,
) -> Result<Ended, JournalError> {
    let all: Vec<usize> = part(sweep.identity.combinations(), shard).collect();
    let missing: Vec<usize> = all.iter().copied().filter(|index| !journal.rows.contains_key(index)).collect();
    let failed_before = journal.rows.values().filter(|row| row.error.is_some()).count();
    observer.row(journal.rows.len(), all.len(), failed_before);

    let next = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let kept = Mutex::new(Kept { journal, failed: failed_before, error: None });
    let within = Within { observer, stopped: &stopped };
    let work = || {
        while let Some(&index) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
            if wear_run::Progress::interrupted(&within) {
                break;
            }
            let Some(row) = sweep.row(index, &within) else { break };
            // Nothing panics with the lock held that would leave the journal half changed: it only appends.
            let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
            if !kept.keep(row) {
                stopped.store(true, Ordering::Relaxed);
                break;
            }
            observer.row(kept.journal.rows.len(), all.len(), kept.failed);
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.min(missing.len()) {
            scope.spawn(|| on_one_thread(work));
        }
    });
    let Kept { journal, error, .. } = kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    match error {
        Some(reason) => Err(reason),
        None if all.iter().all(|index| journal.rows.contains_key(index)) => Ok(Ended::Completed),
        None => Ok(Ended::Interrupted),
    }
}

/// Does `work` with everything in it that is parallel on this thread alone.
fn on_one_thread(work: impl Fn()) {
    // Without a pool of its own, its parallel parts would use the program's, which gives the same results.
    let _own = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
    work();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parts of a sweep are disjoint, and together all of it.
    #[test]
    fn shards_take_turns() {
        let of = |number| part(10, Some(Shard { number, of: 4 })).collect::<Vec<_>>();
        assert_eq!([of(1), of(2), of(3), of(4)], [vec![0, 4, 8], vec![1, 5, 9], vec![2, 6], vec![3, 7]]);
        assert_eq!(part(3, None).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(part(2, Some(Shard { number: 3, of: 3 })).count(), 0);
    }
}
