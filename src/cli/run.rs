//! `gearwear run`: the wear simulation of a scene.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gearwear::pipeline::{self, Request};
use gearwear::plan::Plan;
use gearwear::simulation::record::{RunRecord, StopReason};

use super::failure::{Failure, InputError};
use super::progress::Progress;
use super::{figures, scene_source, stdout, warn};

/// The exit status after an interrupt: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// Arguments of `run`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// The folder for the results; files of an earlier run are replaced
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub fn run(args: &Args) -> Result<(), Failure> {
    let resolved = scene_source::resolve(&args.scene)?;
    warn(&resolved.warnings);
    let plan = Plan::of(&resolved.scene);
    prepare(&args.out)?;
    // No number of threads (0) means all cores.
    let threads = args.threads.map_or(0, NonZeroUsize::get);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(InputError::from)?;

    let interrupted = watch_for_interrupt();
    let progress = Progress::new(args.quiet, Arc::clone(&interrupted));
    let request = Request { resolved: &resolved, plan: &plan, out: &args.out };
    let record = pool.install(|| pipeline::run(&request, &progress));
    progress.finish();
    let record = record.map_err(|error| {
        if interrupted.load(Ordering::Relaxed) {
            eprintln!("interrupted before anything was finished: {error}");
            Failure::Interrupted
        } else {
            Failure::Solver(error)
        }
    })?;
    if !args.quiet {
        let report = args.out.join("report.html");
        stdout::print(&format!("{}report: {}\n", figures::table(&record.summary), report.display()))?;
    }
    match record.summary.stopped {
        StopReason::Completed => Ok(()),
        StopReason::Interrupted => {
            say_what_is_kept(&record, resolved.scene.operation.snapshots_revolutions.len(), &args.out);
            Err(Failure::Interrupted)
        }
    }
}

/// Makes the output folder if need be, and makes sure that it can be written, before any work starts.
fn prepare(out: &Path) -> Result<(), InputError> {
    if out.exists() && !out.is_dir() {
        return Err(InputError::OutIsAFile { path: out.to_owned() });
    }
    fs::create_dir_all(out)
        .and_then(|()| tempfile::tempfile_in(out).map(drop))
        .map_err(|reason| InputError::OutNotWritable { path: out.to_owned(), reason })
}

/// A flag that the first Ctrl-C sets; a second one ends the program at once.
fn watch_for_interrupt() -> Arc<AtomicBool> {
    let flag = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&flag);
    let handler = ctrlc::set_handler(move || {
        if seen.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    if let Err(error) = handler {
        eprintln!("warning: Ctrl-C will not keep what is finished: {error}");
    }
    flag
}

fn say_what_is_kept(record: &RunRecord, snapshots: usize, out: &Path) {
    eprintln!(
        "interrupted at {:.0} pinion revolutions: {} of {snapshots} snapshots were reached; what was finished is kept in {}",
        record.summary.revolutions,
        record.history.len(),
        out.display()
    );
}
