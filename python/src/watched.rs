//! Work on threads of its own, while the thread that asked for it listens to Python.
//!
//! The interpreter is free meanwhile. Every call makes its own pool of threads and ends it, so that nothing is shared with a forked process.
//! A signal, such as that of Ctrl-C, stops the work: it is asked to end, waited for as long as patience lasts, and then left to end alone.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use gearwear::Observer;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::errors;

/// How often signals are looked for.
const INTERVAL: Duration = Duration::from_millis(50);
/// How long stopped work may take to end.
const PATIENCE: Duration = Duration::from_millis(500);

/// How far the work is, and whether it shall stop.
#[derive(Default)]
struct Watch {
    stopped: AtomicBool,
    /// Name of the stage, and the part of it that is done.
    state: Mutex<(String, f64)>,
}

impl Watch {
    fn change(&self, change: impl FnOnce(&mut (String, f64))) {
        if let Ok(mut state) = self.state.lock() {
            change(&mut state);
        }
    }
}

impl Observer for Watch {
    fn stage(&self, name: &str) {
        self.change(|state| *state = (name.to_owned(), 0.0));
    }

    fn run_of(&self, number: usize, count: usize, name: &str) {
        self.change(|(stage, _)| *stage = format!("{} of {count}: {name}", number + 1));
    }

    fn progress(&self, done: f64, total: f64) {
        self.change(|(_, part)| *part = if total > 0.0 { done / total } else { 0.0 });
    }

    fn counted(&self, done: usize, total: usize, things: &'static str, _: &str) {
        self.stage(things);
        self.progress(done as f64, total as f64);
    }

    fn interrupted(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// So many threads, at most as many as there are cores; 0: all of them.
pub(crate) fn cores(threads: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    if threads == 0 { cores } else { threads.min(cores) }
}

/// Does `work` on `threads` threads, at most as many as there are cores; 0: all of them. `progress` is called with the name of the stage and
/// the part of it that is done.
pub(crate) fn watched<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    progress: Option<Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Observer) -> T + Send + 'static,
) -> PyResult<T> {
    let threads = cores(threads);
    let watch = Arc::new(Watch::default());
    let (send, mut receive) = mpsc::channel();
    let worker = {
        let watch = Arc::clone(&watch);
        move || {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            // Nobody listens any more where the work was stopped.
            let _ = send.send(pool.map(|pool| pool.install(|| work(&*watch))));
        }
    };
    std::thread::Builder::new().name("gearwear".to_owned()).spawn(worker)?;
    let mut told = None;
    loop {
        let received;
        (receive, received) = py.detach(move || {
            let received = receive.recv_timeout(INTERVAL);
            (receive, received)
        });
        match received {
            Ok(done) => return done.map_err(|error| PyOSError::new_err(format!("threads: {error}"))),
            Err(RecvTimeoutError::Disconnected) => return Err(errors::of_thread()),
            Err(RecvTimeoutError::Timeout) => {}
        }
        let heard = py.check_signals().and_then(|()| tell(progress.as_ref(), &watch, &mut told));
        if let Err(error) = heard {
            watch.stopped.store(true, Ordering::Relaxed);
            py.detach(move || drop(receive.recv_timeout(PATIENCE)));
            return Err(error);
        }
    }
}

/// Tells `progress` how far the work is, where that has changed.
fn tell(progress: Option<&Bound<'_, PyAny>>, watch: &Watch, told: &mut Option<(String, f64)>) -> PyResult<()> {
    let Some(progress) = progress else { return Ok(()) };
    let state = watch.state.lock().map(|state| state.clone()).ok();
    if state == *told {
        return Ok(());
    }
    *told = state;
    match told {
        Some((stage, part)) => progress.call1((stage.as_str(), *part)).map(drop),
        None => Ok(()),
    }
}
