//! `gearwear fem` of a gear pair: finite-element contact over the mesh cycle, or at one position.

use gearwear::report::output_files;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use gearwear::report;
use gearwear::report::ReportError;
use gearwear::runs;
use gearwear::scene::blame::SceneFault;
use gearwear::scene::loaded::SceneText;
use gearwear_physics::assessment::Done;
use gearwear_physics::assessment::fem_scene::{FemPairError, FemPairRequest};
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::fem_pair::FemPairStage;
use gearwear_physics::results::fem_pair::{FemPairRecord, FemPairSummary};
use gearwear_physics::results::run::{StageTime, StopReason};

use super::failure::{Failure, InputError};
use super::fem::FemArgs;
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::{figures, print, say, warn};

pub(super) fn run(args: &FemArgs, text: SceneText) -> Result<(), Failure> {
    let resolved = &text.resolve()?;
    warn(&resolved.warnings);
    report::writable(&args.out)?;
    let pool = pool(args.threads)?;
    let interrupted = watch_for_interrupt();
    let progress = Progress::new(args.quiet, Arc::clone(&interrupted));
    let asked = FemPairRequest { position_mm: args.position, full: args.full };
    let done = pool.install(|| -> Result<Done<FemPairRecord, FemPairError>, Failure> {
        let mut done = runs::fem_pair(resolved, asked, &progress).map_err(|error| refused(error, &text))?;
        if done.record.summary.positions > 0 {
            write(&mut done.record, &args.out, &progress)?;
        }
        Ok(done)
    });
    progress.finish();
    let Done { record, failure } = done?;
    if record.summary.positions == 0 {
        say("interrupted before anything was finished");
        return Err(Failure::Interrupted);
    }
    let summary = &record.summary;
    warn(&summary.warnings[resolved.warnings.len()..]);
    if !args.quiet {
        let report = args.out.join(output_files::PAGE);
        print(&format!("{}report: {}\n", table(summary), report.display()))?;
    }
    if summary.stopped != StopReason::Completed {
        say(&format!("{} positions were finished and are kept in {}", summary.positions, args.out.display()));
    }
    match failure {
        Some(failure) => Err(Failure::FemPair(failure)),
        None if summary.stopped == StopReason::Interrupted || interrupted.load(Ordering::Relaxed) => {
            Err(Failure::Interrupted)
        }
        None => Ok(()),
    }
}

/// Failure of the input, at its place, or of the solver.
fn refused(error: FemPairError, text: &SceneText) -> Failure {
    if let Some(scene) = error.in_the_scene(text) {
        return scene.into();
    }
    match error {
        FemPairError::Position { given_mm: found_mm, from_mm, to_mm } => {
            InputError::Position { found_mm, from_mm, to_mm }.into()
        }
        other => Failure::FemPair(other),
    }
}

/// The last stage: the output folder. Its own time is in the summary, which is therefore written last.
fn write(record: &mut FemPairRecord, out: &Path, progress: &Progress) -> Result<(), ReportError> {
    progress.stage(FemPairStage::Report.name());
    let start = Instant::now();
    // Files of an earlier run are about to be replaced: its summary would not be theirs.
    report::remove_summary(out)?;
    report::fem_pair::write_data_and_page(record, out)?;
    let wall_s = start.elapsed().as_secs_f64();
    record.summary.stages.push(StageTime { name: FemPairStage::Report.name().to_owned(), wall_s });
    record.summary.wall_s += wall_s;
    report::write_summary(&record.summary, out).map(drop)
}

/// The main figures, for the terminal.
fn table(summary: &FemPairSummary) -> String {
    let (new, te) = (&summary.new, &summary.new.transmission_error_um);
    let pressure = ("maximum pressure, MPa", figures::or_dash(new.peak_pressure_MPa));
    let rows = match summary.position_mm {
        Some(_) => vec![pressure, ("transmission error, µm", figures::digits(te.max))],
        None => vec![
            pressure,
            ("  its tooth pair at, mm", figures::or_dash(new.peak_pressure_pair_position_mm)),
            ("transmission error, minimum, µm", figures::digits(te.min)),
            ("transmission error, maximum, µm", figures::digits(te.max)),
        ],
    };
    let mut text = format!("{}\n\n", summary.title);
    text.extend(rows.iter().map(|(name, value)| figures::row(name, [value, ""])));
    text.push_str(&figures::row("", ["pinion", "wheel"]));
    if let (Some(pinion), Some(wheel)) = (&summary.root.pinion, &summary.root.wheel) {
        for (name, values) in [
            ("root stress, tension side, MPa", [pinion.tension_MPa, wheel.tension_MPa]),
            ("root stress, other side, MPa", [pinion.compression_MPa, wheel.compression_MPa]),
        ] {
            let [one, other] = values.map(figures::digits);
            text.push_str(&figures::row(name, [&one, &other]));
        }
    }
    text.push_str(&format!(
        "\n{} position{}, {} degrees of freedom, {:.1} active-set iterations per position, computed in {:.2} s\n",
        summary.positions,
        if summary.positions == 1 { "" } else { "s" },
        summary.dofs,
        summary.checks.iterations_per_position,
        summary.wall_s
    ));
    text
}
