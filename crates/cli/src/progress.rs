//! Progress of a run: a bar with the remaining time on a terminal, else one line a stage.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use gearwear_physics::observer::Observer;
use indicatif::{ProgressBar, ProgressStyle};

/// Time that an interrupted run has to finish its wear step.
const PATIENCE: Duration = Duration::from_millis(500);

/// Length of the bar: fine enough that each look at a long run sees it move, as its estimate of the remaining time needs.
const PARTS: u64 = 1_000_000;

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

    /// Prints a warning, beside the bar where there is one.
    pub(super) fn warn(&self, text: &str) {
        self.say(&format!("warning: {text}"));
    }

    /// Prints a text, beside the bar where there is one.
    pub(super) fn say(&self, text: &str) {
        match self {
            Display::Bar(bar) => bar.suspend(|| super::say(text)),
            Display::Log(_) | Display::Quiet => super::say(text),
        }
    }
}

/// Time of a stage before its total time is estimated, s.
const JUDGED_AFTER_S: f64 = 2.0;
/// Time after which a stage is announced, s.
const LONG_S: f64 = 20.0;
/// Time until it is announced again, s; half as long again each time.
const SAID_AGAIN_AFTER_S: f64 = 20.0;
/// Latest part of the time so far from which the rest is estimated: the pace changes as flanks wear.
const JUDGED_BY: f64 = 0.5;
/// Greatest number of recorded moments of progress.
const MOST_MARKS: usize = 64;

/// Current stage.
struct Begun {
    name: String,
    start: Instant,
    /// Finished part and time since the start, s, at each recorded moment.
    marks: Vec<(f64, f64)>,
    /// Time of the next announcement, s after the start.
    say_at_s: f64,
}

/// Observer of a run that shows progress and hears interrupts.
pub(super) struct Progress {
    display: Display<Option<Begun>>,
    interrupted: Arc<AtomicBool>,
    start: Instant,
    /// When the interrupt was first noticed.
    first_heard: OnceLock<Instant>,
    /// Warnings printed so far.
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

    /// Warnings among `warnings` that were not printed during the run.
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
                let begun =
                    Begun { name: name.to_owned(), start: Instant::now(), marks: Vec::new(), say_at_s: JUDGED_AFTER_S };
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
        self.display.warn(text);
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

/// Logs the stage that ends, with its time, and starts the next.
fn log_end(stage: &Mutex<Option<Begun>>, next: Option<Begun>) {
    let Ok(mut stage) = stage.lock() else { return };
    if let Some(Begun { name, start, .. }) = std::mem::replace(&mut *stage, next) {
        super::say(&format!("{name}: {:.2} s", start.elapsed().as_secs_f64()));
    }
}

/// Announces the remaining time of a stage of which the part `done` is finished, where the command, begun at `command`, takes long; repeated from
/// time to time, as the pace changes.
fn log_long(stage: &Mutex<Option<Begun>>, done: f64, command: Instant) {
    let Ok(mut stage) = stage.lock() else { return };
    let Some(begun) = stage.as_mut() else { return };
    let elapsed_s = begun.start.elapsed().as_secs_f64();
    mark(&mut begun.marks, (done, elapsed_s));
    if elapsed_s < begun.say_at_s {
        return;
    }
    if let Some(left_s) = left_s(&begun.marks).filter(|left_s| command.elapsed().as_secs_f64() + left_s > LONG_S) {
        begun.say_at_s = (1.5 * elapsed_s).max(elapsed_s + SAID_AGAIN_AFTER_S);
        super::say(&format!("{}: takes some {left_s:.0} s more", begun.name));
    }
}

/// Records a moment of progress; where there are too many, they are thinned evenly over the time so far.
fn mark(marks: &mut Vec<(f64, f64)>, now: (f64, f64)) {
    if marks.len() >= MOST_MARKS {
        let apart_s = 2.0 * now.1 / MOST_MARKS as f64;
        let mut kept_s = f64::NEG_INFINITY;
        marks.retain(|(_, at_s)| {
            let keeps = *at_s >= kept_s + apart_s;
            kept_s = if keeps { *at_s } else { kept_s };
            keeps
        });
    }
    marks.push(now);
}

/// Time left, s, at the pace of the parts finished last; `None` where none was.
fn left_s(marks: &[(f64, f64)]) -> Option<f64> {
    let &(done, now_s) = marks.last()?;
    let late = marks.iter().rev().find(|(_, at_s)| *at_s <= (1.0 - JUDGED_BY) * now_s).or(marks.first())?;
    let (finished, in_s) = (done - late.0, now_s - late.1);
    (finished > 0.0).then(|| in_s / finished * (1.0 - done))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run that is four times as fast from its middle on.
    #[test]
    fn what_is_left_follows_from_what_was_finished_of_late() {
        let mut marks = Vec::new();
        assert_eq!(left_s(&marks), None);
        mark(&mut marks, (0.0, 0.0));
        assert_eq!(left_s(&marks), None);
        mark(&mut marks, (0.05, 2.0));
        assert_eq!(left_s(&marks), Some(38.0));
        marks.clear();
        for k in 1..=400 {
            let now_s = f64::from(k);
            mark(&mut marks, (if now_s <= 100.0 { 1e-3 * now_s } else { 0.1 + 2e-3 * (now_s - 100.0) }, now_s));
        }
        let left = left_s(&marks).unwrap();
        assert!((left - 150.0).abs() < 1e-6 && marks.len() <= MOST_MARKS + 1, "{left}");
    }
}
