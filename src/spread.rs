//! Many runs on several threads, one run a thread.
//!
//! Each run is done by one thread. With many runs no thread waits, and results depend neither on the number of threads nor on the order in which runs
//! finish.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

use gearwear_physics::observer::Observer;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpreadOutcome {
    Completed,
    Interrupted,
}

/// Observer of one run: the run stops when the study does.
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

/// Calls `work` for each of `tasks` on `threads` threads and passes each result to `keep`, one at a time, in the order of completion. `work` gives
/// `None` where it was interrupted; where `keep` returns false, everything stops.
pub fn spread<T: Sync, R>(
    tasks: &[T],
    threads: usize,
    observer: &dyn Observer,
    work: impl Fn(&T, &dyn Observer) -> Option<R> + Sync,
    keep: impl FnMut(R) -> bool + Send,
) -> SpreadOutcome {
    let next = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let kept = Mutex::new((0, keep));
    let within = Within { observer, stopped: &stopped };
    let take = || {
        while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
            if within.interrupted() {
                break;
            }
            let Some(result) = work(task, &within) else { break };
            // A panic with the lock held leaves what was kept before it.
            let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
            if !(kept.1)(result) {
                stopped.store(true, Ordering::Relaxed);
                break;
            }
            kept.0 += 1;
        }
    };
    thread::scope(|scope| {
        for _ in 0..threads.min(tasks.len()) {
            scope.spawn(|| {
                // Parallel parts of a run stay on this thread; the global pool would give the same results.
                let _own = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
                take();
            });
        }
    });
    let (count, _) = kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    if count == tasks.len() { SpreadOutcome::Completed } else { SpreadOutcome::Interrupted }
}

/// Time of a run where each of `threads` threads does one, over their number, s: with all that the machine does besides. `None` where it was interrupted.
pub fn seconds_of_a_run(
    threads: usize,
    observer: &dyn Observer,
    run: impl Fn(&dyn Observer) -> Option<()> + Sync,
) -> Option<f64> {
    let begun = Instant::now();
    let ended = spread(&vec![(); threads], threads, observer, |(), within| run(within), |()| true);
    (ended == SpreadOutcome::Completed).then(|| begun.elapsed().as_secs_f64() / threads as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_physics::observer::Unwatched;

    #[test]
    fn all_tasks_are_done_once_and_a_refusal_stops_them() {
        let tasks: Vec<usize> = (0..50).collect();
        for threads in [1, 3] {
            let mut found = Vec::new();
            let ended = spread(
                &tasks,
                threads,
                &Unwatched,
                |&task, _| Some(task * task),
                |square| {
                    found.push(square);
                    true
                },
            );
            found.sort_unstable();
            assert_eq!(
                (ended, found),
                (SpreadOutcome::Completed, tasks.iter().map(|task| task * task).collect::<Vec<_>>())
            );
            let mut count = 0;
            let ended = spread(
                &tasks,
                threads,
                &Unwatched,
                |&task, _| Some(task),
                |_| {
                    count += 1;
                    count < 5
                },
            );
            assert_eq!((ended, count), (SpreadOutcome::Interrupted, 5));
        }
    }
}
