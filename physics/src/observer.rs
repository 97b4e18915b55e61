//! Who watches the work, and may stop it.

/// Told how far the work has come; says whether to go on. Everything may be left out: [`Unwatched`] does.
pub trait Observer: Sync {
    /// The next stage begins.
    fn stage(&self, _name: &str) {}

    /// The run `number` (from 0) of `count` begins; [`Self::progress`] counts all of them together.
    fn run_of(&self, _number: usize, _count: usize, _name: &str) {}

    /// `done` of `total` of the stage is finished, in a unit of its own: pinion revolutions, positions, runs.
    fn progress(&self, _done: f64, _total: f64) {}

    /// `done` of `total` `things` are finished; `beside` is what else is to be said.
    fn counted(&self, _done: usize, _total: usize, _things: &'static str, _beside: &str) {}

    /// Something the user should know before the work is done; the results say it too.
    fn warning(&self, _text: &str) {}

    /// What begins now takes much time or memory; unlike other warnings said of the parts of a study too, the same once.
    fn announcement(&self, text: &str) {
        self.warning(text);
    }

    /// Whether the user wants it to stop: it does where what is finished can be kept.
    fn interrupted(&self) -> bool {
        false
    }

    /// Whether the user has waited for that long enough: it then stops at once.
    fn gives_up(&self) -> bool {
        self.interrupted()
    }
}

/// Nobody watches, nobody interrupts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Observer for Unwatched {}

/// One run of several: hears an interrupt, and its progress counts as a part of all.
#[derive(Clone, Copy)]
pub struct PartOf<'a> {
    /// Of all the runs.
    pub observer: &'a dyn Observer,
    /// What was finished before it, in the unit of `of`.
    pub before: f64,
    /// Its own share, in the unit of `of`.
    pub share: f64,
    /// All of it, in runs or whatever the caller counts.
    pub of: f64,
}

impl<'a> PartOf<'a> {
    /// The run `number` (from 0) of `count`.
    pub fn new(observer: &'a dyn Observer, number: usize, count: usize) -> Self {
        Self { observer, before: number as f64, share: 1.0, of: count as f64 }
    }

    /// The only one whose progress counts.
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
