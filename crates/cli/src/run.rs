//! `gearwear run`: the wear simulation of a scene.

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use gearwear::report;
use gearwear::report::{ReportError, RunFiles};
use gearwear::resume::keeper::FolderKeeper;
use gearwear::resume::{folder, result};
use gearwear::runs;
use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::opened::OpenedScene;
use gearwear_physics::assessment::{Done, Resumption, RunError};
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::StageKind;
use gearwear_physics::results::invariant::Invariant;
use gearwear_physics::results::run::{RunRecord, StageTime, StopReason};
use gearwear_physics::simulation::settings::Operation;

use super::begun_run::{self, BegunRun, MadeFolder};
use super::failure::{Failure, InputError, in_the_scene};
use super::progress::Progress;
use super::{figures, planetary, print, say, warn};

/// The exit status after an interrupt: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// The scene file; - reads standard input. May be left out with --resume
    #[arg(required_unless_present = "resume")]
    scene: Option<PathBuf>,
    /// The folder for the results; files of an earlier run are replaced
    #[arg(long, value_name = "DIR", required_unless_present = "resume")]
    out: Option<PathBuf>,
    /// Go on with the run in this folder from its last checkpoint, to the same results as without a break
    #[arg(long, value_name = "DIR", conflicts_with = "out")]
    resume: Option<PathBuf>,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    pub(super) threads: Option<NonZeroUsize>,
    /// Write no report.html, the data files alone
    #[arg(long)]
    pub(super) no_report: bool,
    /// Write results.xlsx too, a workbook with a sheet per table
    #[arg(long)]
    workbook: bool,
    /// Write flank.pvd too: both flanks in space at the beginning and at every snapshot, for ParaView
    #[arg(long)]
    series: bool,
    /// Write each plot of the page into this folder too, as SVG and PNG; files of the same names are replaced
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    pub(super) quiet: bool,
}

impl RunArgs {
    /// Files that are asked for beside the tables.
    pub(super) fn files(&self) -> RunFiles {
        RunFiles { page: !self.no_report, workbook: self.workbook, series: self.series, figures: self.figures.clone() }
    }
}

pub(super) fn run(args: &RunArgs) -> Result<(), Failure> {
    let pool = pool(args.threads)?;
    if let Some(figures) = &args.figures {
        report::writable(figures)?;
    }
    let (file, out, goes_on) = match (&args.scene, &args.out, &args.resume) {
        (scene, _, Some(folder)) => (begun_run::scene_to_resume(scene.as_deref(), folder)?, folder, true),
        (Some(scene), Some(out), None) => (scene.clone(), out, false),
        (_, _, None) => unreachable!("clap demands both"),
    };
    let begun = match (OpenedScene::open(&file)?, goes_on) {
        (OpenedScene::Planetary(stage), _) => return planetary::run(&stage, out, goes_on, args),
        (OpenedScene::Pair(scene), false) => begun_run::begin(*scene, out)?,
        (OpenedScene::Pair(scene), true) => match begun_run::resume(*scene, out)? {
            Some(begun) => begun,
            None => {
                say(&format!("the run in {} is complete: nothing is left to do", out.display()));
                return Ok(());
            }
        },
    };
    let BegunRun { scene, out, identity, from, made } = begun;
    let resolved = &scene.resolved;
    warn(&resolved.warnings);
    if let Some(from) = from.as_ref().filter(|_| !args.quiet) {
        let whole = resolved.scene.operation.pinion_revolutions;
        say(&format!("continues at {:.0} of {whole:.0} pinion revolutions", from.revolutions));
    }

    let interrupted = watch_for_interrupt();
    let progress = Progress::new(args.quiet, Arc::clone(&interrupted));
    // The summary is written last: where it exists, the folder is complete and of one run.
    report::remove_summary(&out)?;
    let keeper = FolderKeeper::new(&out, &identity, &resolved.warnings);
    let done = pool.install(|| -> Result<Done, Failure> {
        let resumption = Resumption { from, keeper: &keeper };
        let mut done = runs::run_from(&scene, resumption, &progress)?;
        write(&mut done.record, &out, args, &progress)?;
        if done.record.summary.stopped != StopReason::Interrupted {
            folder::remove_checkpoint(&out)?;
        }
        Ok(done)
    });
    progress.finish();
    if let Some((path, error)) = keeper.failure() {
        say(&format!("warning: the last checkpoint, {}, could not be written: {error}", path.display()));
    }
    if matches!(done, Err(Failure::Run(_))) && interrupted.load(Ordering::Relaxed) {
        say(&format!("interrupted before anything was finished; {}", how_to_go_on(&out)));
        return Err(Failure::Interrupted);
    }
    let Done { record, failure } = done.map_err(|failure| match failure {
        Failure::Run(error) => refused(error, &scene, made.as_ref()),
        other => other,
    })?;
    warn(&progress.not_yet_told(&record.summary.warnings[resolved.warnings.len()..]));
    finish(args, &record, failure, &resolved.scene.operation, &out)
}

/// Prints the main figures, or what is kept of a run that ended early; the failure of the run, if any.
fn finish(
    args: &RunArgs,
    record: &RunRecord,
    failure: Option<RunError>,
    operation: &Operation,
    out: &Path,
) -> Result<(), Failure> {
    if !args.quiet {
        let (name, path) = match args.no_report {
            true => ("results", out.to_owned()),
            false => ("report", out.join(output_files::PAGE)),
        };
        print(&format!("{}{name}: {}\n", figures::table(&record.summary), path.display()))?;
    }
    if !record.summary.stopped.is_complete() {
        say_what_is_kept(record, operation, out);
    }
    match failure {
        Some(failure) => Err(Failure::Run(failure)),
        None if record.summary.stopped == StopReason::Interrupted => Err(Failure::Interrupted),
        None => {
            let violations: Vec<String> = record.summary.invariants.iter().filter_map(Invariant::violation).collect();
            if violations.is_empty() { Ok(()) } else { Err(Failure::Violated { violations }) }
        }
    }
}

/// Failure of a run of which nothing was finished; the folder made for a scene that allows no run, or none in this memory, is removed.
fn refused(error: RunError, scene: &LoadedScene, made: Option<&MadeFolder>) -> Failure {
    let failure = in_the_scene(error, scene);
    let none_begins = matches!(failure, Failure::Scene(_) | Failure::Run(RunError::Memory { .. }));
    if let Some(made) = made.filter(|_| none_begins) {
        made.abandon();
    }
    failure
}

/// The last stage: the output folder. Its own time is in the summary, which is therefore written last.
fn write(record: &mut RunRecord, out: &Path, args: &RunArgs, progress: &Progress) -> Result<(), ReportError> {
    progress.stage(StageKind::Report.name());
    let start = Instant::now();
    report::write_files(record, &args.files(), out)?;
    let wall_s = start.elapsed().as_secs_f64();
    record.summary.stages.push(StageTime { name: StageKind::Report.name().to_owned(), wall_s });
    record.summary.wall_s += wall_s;
    result::write(record, out)?;
    report::write_summary(&record.summary, out).map(drop)
}

/// Number of threads: as asked for, at most all cores, which is the default.
pub(super) fn thread_count(asked: Option<NonZeroUsize>) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    asked.map_or(cores, NonZeroUsize::get).min(cores)
}

/// Pool of the threads asked for.
pub(super) fn pool(asked: Option<NonZeroUsize>) -> Result<rayon::ThreadPool, InputError> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(thread_count(asked)).build()?)
}

/// A flag that the first Ctrl-C sets; a second one ends the program at once.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&flag);
    let handler = ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    if let Err(error) = handler {
        say(&format!("warning: Ctrl-C will not keep what is finished: {error}"));
    }
    flag
}

fn say_what_is_kept(record: &RunRecord, operation: &Operation, out: &Path) {
    let planned = &operation.snapshots_revolutions;
    let reached = record.history.iter().filter(|row| planned.contains(&row.revolutions)).count();
    let stopped = match record.summary.stopped {
        StopReason::NotConverged | StopReason::WornThrough => "the last state kept is that",
        StopReason::Interrupted | StopReason::Completed | StopReason::LimitReached => "interrupted",
    };
    say(&format!(
        "{stopped} at {:.0} pinion revolutions: {reached} of {} snapshots were reached; what was finished is kept in {}",
        record.summary.revolutions,
        planned.len(),
        out.display()
    ));
    if record.summary.stopped == StopReason::Interrupted {
        say(&how_to_go_on(out));
    }
}

fn how_to_go_on(out: &Path) -> String {
    let how = if out.join(folder::CHECKPOINT).exists() {
        "continues it"
    } else {
        "starts it again: it has no checkpoint yet"
    };
    format!("gearwear run --resume {} {how}", out.display())
}
