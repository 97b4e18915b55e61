//! Tells the user how far a run is: a bar with the remaining time on a terminal, one line a stage elsewhere.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use crate::observer::Observer;
use indicatif::{ProgressBar, ProgressStyle};

/// How long an interrupted run may take to finish its wear step.
const PATIENCE: Duration = Duration::from_millis(500);

/// Parts of the bar.
const PARTS: u64 = 1000;

/// How progress is shown: a bar on a terminal, elsewhere a log, which remembers something.
pub(super) enum Display<L> {
    Quiet,
    Log(Mutex<L>),
    Bar(ProgressBar),
}

impl<L> Display<L> {
    pub(super) fn new(quiet: bool, log: L) -> Self {
        match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Display::Quiet,
            (false, true) => Display::Bar(bar()),
            (false, false) => Display::Log(Mutex::new(log)),
        }
    }
}

/// A stage takes this long before how long it takes in all is judged by.
const JUDGED_AFTER_S: f64 = 2.0;
/// What takes longer is said, s.
const LONG_S: f64 = 20.0;

/// The stage that was begun last.
struct Begun {
    name: String,
    start: Instant,
    /// Its progress when that was first told, and when.
    first: Option<(f64, Instant)>,
    /// Whether it was said how long it takes.
    is_said: bool,
}

/// Watches a run for the user, who may interrupt it.
pub(super) struct Progress {
    display: Display<Option<Begun>>,
    interrupted: Arc<AtomicBool>,
    start: Instant,
    /// When the interrupt was first noticed.
    first_heard: OnceLock<Instant>,
    /// Warnings given so far.
    told: Mutex<Vec<String>>,
}

impl Progress {
    /// A bar on a terminal, a log elsewhere, nothing where `quiet`; `interrupted` is set when the user wants to stop.
    pub(super) fn new(quiet: bool, interrupted: Arc<AtomicBool>) -> Self {
        Self {
            display: Display::new(quiet, None),
            interrupted,
            start: Instant::now(),
            first_heard: OnceLock::new(),
            told: Mutex::default(),
        }
    }

    /// Those of `warnings` that have not been given during the run.
    pub(super) fn not_yet_told(&self, warnings: &[String]) -> Vec<String> {
        let told = self.told.lock().map(|told| told.clone()).unwrap_or_default();
        warnings.iter().filter(|warning| !told.contains(warning)).cloned().collect()
    }

    pub(super) fn finish(&self) {
        match &self.display {
            Display::Quiet => {}
            Display::Log(stage) => log_end(stage, None),
            Display::Bar(bar) => bar.finish_and_clear(),
        }
    }
}

impl Observer for Progress {
    fn stage(&self, name: &str) {
        match &self.display {
            Display::Quiet => {}
            Display::Log(stage) => {
                let begun = Begun { name: name.to_owned(), start: Instant::now(), first: None, is_said: false };
                log_end(stage, Some(begun));
            }
            Display::Bar(bar) => {
                bar.reset();
                bar.set_message(name.to_owned());
            }
        }
    }

    fn run_of(&self, number: usize, count: usize, name: &str) {
        match &self.display {
            Display::Quiet => {}
            Display::Log(_) => self.stage(&format!("{} of {count}: {name}", number + 1)),
            Display::Bar(bar) => bar.set_message(format!("{} of {count}", number + 1)),
        }
    }

    fn progress(&self, done: f64, total: f64) {
        if total <= 0.0 {
            return;
        }
        match &self.display {
            Display::Quiet => {}
            Display::Log(stage) => log_long(stage, done / total, self.start),
            Display::Bar(bar) => bar.set_position((done / total * PARTS as f64) as u64),
        }
    }

    fn warning(&self, text: &str) {
        if let Ok(mut told) = self.told.lock() {
            if told.iter().any(|other| other == text) {
                return;
            }
            told.push(text.to_owned());
        }
        let say = || super::say(&format!("warning: {text}"));
        match &self.display {
            Display::Bar(bar) => bar.suspend(say),
            Display::Log(_) | Display::Quiet => say(),
        }
    }

    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    fn gives_up(&self) -> bool {
        self.interrupted() && self.first_heard.get_or_init(Instant::now).elapsed() > PATIENCE
    }
}

/// The bar, with the remaining time.
fn bar() -> ProgressBar {
    let bar = ProgressBar::new(PARTS);
    let style = ProgressStyle::with_template("{msg:20} [{bar:40}] {percent:>3} %  {elapsed} so far, {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// Logs the stage that ends, with its time, and remembers the next.
fn log_end(stage: &Mutex<Option<Begun>>, next: Option<Begun>) {
    let Ok(mut stage) = stage.lock() else { return };
    if let Some(Begun { name, start, .. }) = std::mem::replace(&mut *stage, next) {
        super::say(&format!("{name}: {:.2} s", start.elapsed().as_secs_f64()));
    }
}

/// Says once of a stage, of which the part `done` is finished, what it takes more where the command, begun at `command`, takes long with it.
fn log_long(stage: &Mutex<Option<Begun>>, done: f64, command: Instant) {
    let Ok(mut stage) = stage.lock() else { return };
    let Some(begun) = stage.as_mut().filter(|begun| !begun.is_said) else { return };
    let (before, start) = *begun.first.get_or_insert_with(|| (done, Instant::now()));
    let elapsed_s = start.elapsed().as_secs_f64();
    if elapsed_s < JUDGED_AFTER_S {
        return;
    }
    if let Some(left_s) =
        left_s(elapsed_s, done - before, 1.0 - done).filter(|left_s| command.elapsed().as_secs_f64() + left_s > LONG_S)
    {
        begun.is_said = true;
        super::say(&format!("{}: takes some {left_s:.0} s more", begun.name));
    }
}

/// What is left takes as long for each part as what is finished took; `None` where nothing is.
fn left_s(elapsed_s: f64, finished: f64, left: f64) -> Option<f64> {
    (finished > 0.0).then(|| elapsed_s / finished * left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_is_finished() {
        assert_eq!(left_s(2.0, 0.05, 0.95), Some(38.0));
        assert_eq!(left_s(2.0, 0.0, 1.0), None);
    }
}
