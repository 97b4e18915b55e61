//! Progress and interruption of the work.

/// Receiver of progress and warnings, which may also interrupt the work. All methods have defaults, as [`Unwatched`] uses them.
pub trait Observer: Sync {
    /// Beginning of the next stage.
    fn stage(&self, _name: &str) {}

    /// Beginning of run `number` (from 0) of `count`; [`Self::progress`] counts all of them together.
    fn run_of(&self, _number: usize, _count: usize, _name: &str) {}

    /// Progress of the stage, `done` of `total` in the unit of the stage: pinion revolutions, positions, runs.
    fn progress(&self, _done: f64, _total: f64) {}

    /// Progress in numbers of `things`, with further text `beside`.
    fn counted(&self, _done: usize, _total: usize, _things: &'static str, _beside: &str) {}

    /// Warning during the work, which the results contain too.
    fn warning(&self, _text: &str) {}

    /// Announcement of work that needs much time or memory; unlike other warnings, parts of a study give it too, each text once.
    fn announcement(&self, text: &str) {
        self.warning(text);
    }

    /// Whether the user interrupts: the work stops where results so far can be kept.
    fn interrupted(&self) -> bool {
        false
    }

    /// Whether the user interrupts again: the work stops at once.
    fn gives_up(&self) -> bool {
        self.interrupted()
    }
}

/// Observer that ignores progress and does not interrupt.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Observer for Unwatched {}

/// Observer of one run of several, whose progress is a part of the whole.
#[derive(Clone, Copy)]
pub struct PartOf<'a> {
    /// Observer of all runs.
    pub observer: &'a dyn Observer,
    /// Progress before this run, in the unit of `of`.
    pub before: f64,
    /// Share of this run, in the unit of `of`.
    pub share: f64,
    /// Total, in runs or another unit of the caller.
    pub of: f64,
}

impl<'a> PartOf<'a> {
    /// Observer of run `number` (from 0) of `count`.
    pub fn new(observer: &'a dyn Observer, number: usize, count: usize) -> Self {
        Self { observer, before: number as f64, share: 1.0, of: count as f64 }
    }

    /// Observer of the only run.
    pub fn whole(observer: &'a dyn Observer) -> Self {
        Self::new(observer, 0, 1)
    }
}

impl Observer for PartOf<'_> {
    fn progress(&self, done: f64, total: f64) {
        self.observer.progress(self.before + self.share * done / total, self.of);
    }

    fn announcement(&self, text: &str) {
        self.observer.announcement(text);
    }

    fn interrupted(&self) -> bool {
        self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}
