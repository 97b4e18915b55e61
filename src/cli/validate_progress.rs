//! Tells the user how far the validation suite is: a bar on a terminal, a line now and then elsewhere.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use gearwear::simulation::wear_run::Progress;
use gearwear::validation::schedule::Observer;
use indicatif::ProgressBar;

use super::{progress, say};

/// Time between two lines of the log.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// How progress is shown.
enum Display {
    Quiet,
    Log { last: Mutex<Instant> },
    Bar(ProgressBar),
}

/// Watches the suite for the user, who may interrupt it.
pub struct ValidateProgress {
    display: Display,
    interrupted: Arc<AtomicBool>,
}

impl ValidateProgress {
    /// A bar on a terminal, a log elsewhere, nothing where `quiet`; `interrupted` is set when the user wants to stop.
    pub fn new(quiet: bool, interrupted: Arc<AtomicBool>) -> Self {
        let display = if quiet {
            Display::Quiet
        } else if std::io::stderr().is_terminal() {
            Display::Bar(progress::bar())
        } else {
            Display::Log { last: Mutex::new(Instant::now()) }
        };
        Self { display, interrupted }
    }

    /// Ends the display.
    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

impl Progress for ValidateProgress {
    fn progress(&self, _done: f64, _total: f64) {}

    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    fn gives_up(&self) -> bool {
        self.interrupted()
    }
}

impl Observer for ValidateProgress {
    fn run(&self, done: usize, total: usize, case: &str) {
        match &self.display {
            Display::Quiet => {}
            Display::Log { last } => {
                let Ok(mut last) = last.lock() else { return };
                if done == total || last.elapsed() >= BETWEEN_LINES {
                    *last = Instant::now();
                    say(&format!("{done} of {total} runs, the last of {case}"));
                }
            }
            Display::Bar(bar) => {
                bar.set_length(total as u64);
                bar.set_position(done as u64);
                bar.set_message(format!("{done} of {total} runs: {case}"));
            }
        }
    }
}
