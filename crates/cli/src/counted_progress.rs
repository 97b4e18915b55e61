//! Progress of a number of runs: a bar on a terminal, else a line from time to time, with the remaining time.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use gearwear_physics::observer::Observer;

use super::progress::Display;
use super::say;

/// Time between two lines of the log.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// State of the log.
struct ProgressLog {
    counted: Option<Counted>,
    last: Instant,
}

/// Things being counted.
struct Counted {
    things: &'static str,
    /// Start of the first run of this command.
    start: Instant,
    /// Number of runs finished by earlier commands.
    before: usize,
}

/// Observer of runs that shows progress and hears interrupts.
pub(super) struct CountedProgress {
    display: Display<ProgressLog>,
    interrupted: Arc<AtomicBool>,
    /// Announcements made so far.
    announced: Mutex<Vec<String>>,
}

impl CountedProgress {
    /// A bar on a terminal, a log elsewhere, nothing where `quiet`; `interrupted` is set when the user wants to stop.
    pub(super) fn new(quiet: bool, interrupted: Arc<AtomicBool>) -> Self {
        let log = ProgressLog { counted: None, last: Instant::now() };
        Self { display: Display::new(quiet, log), interrupted, announced: Mutex::default() }
    }

    /// Prints a text, but where it is quiet.
    pub(super) fn say(&self, text: &str) {
        if !matches!(self.display, Display::Quiet) {
            self.display.say(text);
        }
    }

    pub(super) fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

impl Observer for CountedProgress {
    fn counted(&self, done: usize, total: usize, things: &'static str, beside: &str) {
        match &self.display {
            Display::Quiet => {}
            Display::Log(log) => {
                let Ok(mut log) = log.lock() else { return };
                let now = Instant::now();
                let of_this_start = log.counted.take().filter(|counted| counted.things == things);
                let counted = of_this_start.unwrap_or(Counted { things, start: now, before: done });
                let (elapsed, finished) = (now.duration_since(counted.start), done.saturating_sub(counted.before));
                log.counted = Some(counted);
                if done < total && now.duration_since(log.last) < BETWEEN_LINES {
                    return;
                }
                log.last = now;
                let left = remaining_s(elapsed.as_secs_f64(), finished, total - done);
                say(&format!("{done} of {total} {things}{beside}{left}"));
            }
            Display::Bar(bar) => {
                if bar.length() != Some(total as u64) || (done as u64) < bar.position() {
                    // Another count begins here; runs of an earlier command took no time of this one.
                    bar.set_length(total as u64);
                    bar.set_position(done as u64);
                    bar.reset_eta();
                }
                bar.set_position(done as u64);
                bar.set_message(format!("{done} of {total} {things}{beside}"));
            }
        }
    }

    fn announcement(&self, text: &str) {
        let Ok(mut announced) = self.announced.lock() else { return };
        if announced.iter().all(|other| other != text) {
            announced.push(text.to_owned());
            self.display.warn(text);
        }
    }

    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }
}

/// The remaining time, from what the finished ones took; empty at the ends.
fn remaining_s(elapsed_s: f64, finished: usize, left: usize) -> String {
    if finished == 0 || left == 0 {
        return String::new();
    }
    format!(", {:.0} s left", elapsed_s / finished as f64 * left as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_remaining_time_follows_from_what_is_finished() {
        assert_eq!(remaining_s(10.0, 20, 60), ", 30 s left");
        assert_eq!(remaining_s(0.1, 0, 60), "");
        assert_eq!(remaining_s(10.0, 20, 0), "");
    }
}
