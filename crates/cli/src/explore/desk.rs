//! Where questions are answered: one fast answer and one of finite elements at a time, of which a newer one takes the place.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use gearwear::explore::answer::{Answer, Band};
use gearwear::explore::{ExploreError, Model, Session, Setting};
use gearwear_physics::observer::Observer;

use crate::failure::InputError;

/// Longest time that an answer may take: of the fast model, of finite elements.
const LONGEST: [Duration; 2] = [Duration::from_secs(20), Duration::from_secs(120)];

/// Answers of one kind, on threads of their own.
struct Counter {
    newest: AtomicU64,
    busy: Mutex<()>,
    pool: rayon::ThreadPool,
    longest: Duration,
}

/// Answers for a session.
pub(super) struct Desk {
    session: Session,
    fast: Counter,
    elements: Counter,
    /// Differences of the finite elements of the scene as opened.
    as_opened: OnceLock<Band>,
    interrupted: Arc<AtomicBool>,
}

/// Observer of an answer: it stops where a newer question has come, or too much time has passed.
struct Newest<'a> {
    counter: &'a Counter,
    number: u64,
    until: Instant,
    interrupted: &'a AtomicBool,
}

impl Observer for Newest<'_> {
    fn interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
            || self.counter.newest.load(Ordering::Relaxed) != self.number
            || Instant::now() > self.until
    }
}

impl Counter {
    fn new(threads: usize, longest: Duration) -> Result<Self, InputError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(Self { newest: AtomicU64::new(0), busy: Mutex::new(()), pool, longest })
    }

    /// Takes the place of the questions before; its number.
    fn draw_number(&self) -> u64 {
        self.newest.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Carries out `work` when the answers before it are done.
    fn answer<R: Send>(
        &self,
        interrupted: &AtomicBool,
        work: impl FnOnce(&dyn Observer) -> Result<R, ExploreError> + Send,
    ) -> Result<R, ExploreError> {
        let number = self.draw_number();
        let _busy = self.busy.lock().unwrap_or_else(PoisonError::into_inner);
        let newest = Newest { counter: self, number, until: Instant::now() + self.longest, interrupted };
        if newest.interrupted() {
            return Err(ExploreError::Interrupted);
        }
        self.pool.install(|| work(&newest))
    }
}

impl Desk {
    pub(super) fn new(session: Session, threads: usize, interrupted: Arc<AtomicBool>) -> Result<Self, InputError> {
        let [fast, elements] = LONGEST.map(|longest| Counter::new(threads, longest));
        Ok(Self { session, fast: fast?, elements: elements?, as_opened: OnceLock::new(), interrupted })
    }

    pub(super) fn session(&self) -> &Session {
        &self.session
    }

    /// Answer with `model`. A question to the fast model ends that of finite elements: the pair is being turned.
    pub(super) fn answer(&self, setting: &Setting, model: Model) -> Result<Answer, ExploreError> {
        let (session, interrupted) = (&self.session, &*self.interrupted);
        if model != Model::FiniteElements {
            self.elements.draw_number();
            return self.fast.answer(interrupted, |observer| session.answer(setting, Model::Fast, observer));
        }
        if session.compares_each_answer() {
            return self.elements.answer(interrupted, |observer| session.verified_answer(setting, observer));
        }
        let answer = self.elements.answer(interrupted, |observer| session.answer(setting, model, observer))?;
        Ok(self.as_opened.get().map_or(answer.clone(), |band| answer.with_band(band)))
    }

    /// Differences of the finite elements of the scene as opened, computed once.
    pub(super) fn band(&self) -> Result<Band, ExploreError> {
        if let Some(band) = self.as_opened.get() {
            return Ok(band.clone());
        }
        let band = self.elements.answer(&self.interrupted, |observer| self.session.band(&Setting::new(), observer))?;
        Ok(self.as_opened.get_or_init(|| band).clone())
    }
}
