//! Runs what is missing of a sweep on all threads, one combination a thread.
//!
//! A combination is run by one thread from beginning to end: with many combinations that loses nothing to waiting, and a row
//! depends neither on the number of threads nor on the order in which they finish. Where the sweep is verified, the same is done once
//! more with the rows that are chosen for it, which are known when all rows are.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::combination::Sweep;
use super::journal::{Journal, JournalError};
use crate::observer::Observer;
use crate::studies::sweep::record::{Shard, SweepRow};
use crate::studies::sweep::verification::{Chosen, chosen};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ended {
    Completed,
    Interrupted,
}

/// The combinations of a part of a sweep, in order: every `of`-th, beginning with `number`; `None`: all.
pub(crate) fn part(combinations: usize, shard: Option<Shard>) -> impl Iterator<Item = usize> {
    let (first, step) = shard.map_or((0, 1), |shard| (shard.number.saturating_sub(1), shard.of.max(1)));
    (first..combinations).step_by(step)
}

/// A run within a sweep: it stops when the sweep does.
struct Within<'a> {
    observer: &'a dyn Observer,
    stopped: &'a AtomicBool,
}

impl Observer for Within<'_> {
    fn announcement(&self, text: &str) {
        self.observer.announcement(text);
    }

    fn interrupted(&self) -> bool {
        self.stopped.load(Ordering::Relaxed) || self.observer.interrupted()
    }
}

/// What the threads share.
struct Kept<'a, F> {
    journal: &'a mut Journal,
    count: usize,
    tell: F,
    /// Why no row can be kept any more.
    error: Option<JournalError>,
}

impl<F: FnMut(&SweepRow)> Kept<'_, F> {
    /// Keeps a finished row, if rows can still be kept: what follows a line that was not written whole could not be read again.
    fn keep(&mut self, row: SweepRow) -> bool {
        if self.error.is_some() {
            return false;
        }
        let index = row.index;
        self.error = self.journal.append(row).err();
        if let (None, Some(row)) = (&self.error, self.journal.contents.rows.get(&index)) {
            self.count += 1;
            (self.tell)(row);
        }
        self.error.is_none()
    }
}

/// Runs the combinations of `shard` that `journal` does not hold yet, on `threads` threads; of a whole sweep that asks for it,
/// verifies the rows that are chosen.
///
/// # Errors
/// A row that cannot be kept; the rows before it are.
pub(crate) fn run(
    sweep: &Sweep,
    shard: Option<Shard>,
    journal: &mut Journal,
    threads: usize,
    observer: &dyn Observer,
) -> Result<Ended, JournalError> {
    let all: Vec<usize> = part(sweep.identity.combinations(), shard).collect();
    let missing: Vec<usize> = all.iter().copied().filter(|index| !journal.contents.rows.contains_key(index)).collect();
    let mut done = journal.contents.rows.len();
    let mut failed = journal.contents.rows.values().filter(|row| row.error.is_some()).count();
    observer.counted(done, all.len(), "combinations", &with_failed(failed));
    let tell = |row: &SweepRow| {
        done += 1;
        failed += usize::from(row.error.is_some());
        observer.counted(done, all.len(), "combinations", &with_failed(failed));
    };
    let ended = spread(&missing, journal, threads, observer, |&index, within| sweep.row(index, within), tell)?;
    match ended {
        Ended::Completed if sweep.identity.verify && shard.is_none() => verify(sweep, journal, threads, observer),
        _ => Ok(ended),
    }
}

fn with_failed(failed: usize) -> String {
    if failed == 0 { String::new() } else { format!(", {failed} failed") }
}

/// Verifies those of the chosen rows that are not yet.
fn verify(
    sweep: &Sweep,
    journal: &mut Journal,
    threads: usize,
    observer: &dyn Observer,
) -> Result<Ended, JournalError> {
    let chosen = chosen(&sweep.identity, journal.contents.rows.values());
    let of_row = |(index, chosen): (&usize, &Chosen)| Some((journal.contents.rows.get(index)?.clone(), *chosen));
    let due: Vec<(SweepRow, Chosen)> =
        chosen.iter().filter_map(of_row).filter(|(row, _)| row.verification.is_none()).collect();
    let mut done = chosen.len() - due.len();
    observer.counted(done, chosen.len(), "verified", "");
    let tell = |_: &SweepRow| {
        done += 1;
        observer.counted(done, chosen.len(), "verified", "");
    };
    spread(&due, journal, threads, observer, |(row, chosen), within| sweep.verified(row, *chosen, within), tell)
}

/// Does `work` for each of `tasks` on all threads, keeps the rows it comes to in `journal`, and tells of each.
fn spread<T: Sync>(
    tasks: &[T],
    journal: &mut Journal,
    threads: usize,
    observer: &dyn Observer,
    work: impl Fn(&T, &Within<'_>) -> Option<SweepRow> + Sync,
    tell: impl FnMut(&SweepRow) + Send,
) -> Result<Ended, JournalError> {
    let next = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let kept = Mutex::new(Kept { journal, count: 0, tell, error: None });
    let within = Within { observer, stopped: &stopped };
    let take = || {
        while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
            if within.interrupted() {
                break;
            }
            let Some(row) = work(task, &within) else { break };
            // Nothing panics with the lock held that would leave the journal half changed: it only appends.
            if !kept.lock().unwrap_or_else(PoisonError::into_inner).keep(row) {
                stopped.store(true, Ordering::Relaxed);
                break;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.min(tasks.len()) {
            scope.spawn(|| {
                // What is parallel in it runs on this thread alone. Without a pool of its own it would use the program's, which gives
                // the same results.
                let _own = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
                take();
            });
        }
    });
    let Kept { count, error, .. } = kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    match error {
        Some(reason) => Err(reason),
        None if count == tasks.len() => Ok(Ended::Completed),
        None => Ok(Ended::Interrupted),
    }
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
