//! Distribution of the runs of all cases over threads. Each run has one thread, so that its wall time is meaningful; results do not depend on the
//! thread.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::case_file::{CaseCommand, RunSpec};
use super::execution::{Executed, MemberRun};
use super::library::ValidationCase;
use super::members::{Member, members};
use gearwear_physics::calibration::Calibration;
use gearwear_physics::observer::{Observer, PartOf};

/// A run, one or a family, with its members.
#[derive(Debug)]
pub struct Members {
    pub members: Vec<Member>,
    /// Result of each; `None` where the suite was interrupted before.
    pub executed: Vec<Option<Executed>>,
}

impl Members {
    fn not_yet_run(run: &RunSpec) -> Self {
        let members = members(run);
        Self { executed: vec![None; members.len()], members }
    }

    /// Members that ended, each with its result.
    pub(super) fn ended(&self) -> impl Iterator<Item = (&Member, &Executed)> {
        self.members.iter().zip(&self.executed).filter_map(|(member, executed)| Some((member, executed.as_ref()?)))
    }
}

/// One run to carry out, by its indices.
#[derive(Debug, Clone, Copy)]
struct Job {
    case: usize,
    run: usize,
    member: usize,
}

/// Carries out all runs of `cases` on `threads` threads: for each case, each of its runs.
pub fn carry_out(cases: &[&ValidationCase], threads: usize, observer: &dyn Observer) -> Vec<Vec<Members>> {
    let mut all: Vec<Vec<Members>> =
        cases.iter().map(|case| case.file.run.iter().map(Members::not_yet_run).collect()).collect();
    let mut jobs: Vec<Job> = Vec::new();
    for (case, runs) in all.iter().enumerate() {
        for (run, family) in runs.iter().enumerate() {
            jobs.extend((0..family.members.len()).map(|member| Job { case, run, member }));
        }
    }
    let total = jobs.len();
    let (after, mut first): (Vec<Job>, Vec<Job>) =
        jobs.into_iter().partition(|job| cases[job.case].file.run[job.run].calibration.is_some());
    // Long runs first, so that none is left to the end.
    first.sort_by_key(|job| match cases[job.case].file.run[job.run].command {
        CaseCommand::Invariants => 0,
        CaseCommand::Calibrate => 1,
        CaseCommand::Fem => 2,
        CaseCommand::Run => 3,
    });
    let done = AtomicUsize::new(0);
    for jobs in [first, after] {
        let executed = spread(&jobs, threads, |job| {
            if observer.interrupted() {
                return None;
            }
            let (case, family) = (cases[job.case], &all[job.case][job.run]);
            let spec = &case.file.run[job.run];
            let calibration = spec.calibration.as_ref().and_then(|name| made_by(case, &all[job.case], name));
            let member = &family.members[job.member];
            let task =
                MemberRun { run: spec, member, folder: &case.folder, calibration, watch: &PartOf::whole(observer) };
            let executed = task.execute();
            observer.counted(
                done.fetch_add(1, Ordering::Relaxed) + 1,
                total,
                "runs",
                &format!(", the last of {}", case.name),
            );
            // A run that was interrupted has no result.
            (!observer.interrupted()).then_some(executed)
        });
        for (job, executed) in jobs.iter().zip(executed) {
            all[job.case][job.run].executed[job.member] = executed;
        }
    }
    all
}

/// The calibration that the run called `name` of the case made.
fn made_by<'a>(case: &ValidationCase, runs: &'a [Members], name: &str) -> Option<&'a Calibration> {
    let index = case.file.run.iter().position(|run| run.name == name)?;
    runs[index].executed.first()?.as_ref()?.calibration.as_ref()
}

/// Calls `work` for every job on `threads` threads, each with a pool of one thread; results in the order of the jobs.
fn spread<T: Send>(jobs: &[Job], threads: usize, work: impl Fn(&Job) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::with_capacity(jobs.len()));
    let hand_out = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(index) else { return };
            let done = work(job);
            results.lock().unwrap_or_else(PoisonError::into_inner).push((index, done));
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, jobs.len().max(1)) {
            scope.spawn(|| match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
                Ok(pool) => pool.install(hand_out),
                // Without its own pool a run uses the global one: its time is less reliable, its results are the same.
                Err(_) => hand_out(),
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, done)| done).collect()
}
