//! `gearwear calibrate`: tooth stiffness and K/H from finite elements.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use gearwear::report;
use gearwear::scene::blame::SceneFault;
use gearwear::scene::loaded::SceneText;
use gearwear_physics::assessment::calibrate::{self, CalibrateError, Calibrated, CalibrationExtent};
use gearwear_physics::contact::settings::MatchCriterion;
use gearwear_physics::mesh_cycle::pair_in_space::KeptInSpace;
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::calibration::CalibrationStage;
use gearwear_physics::results::reported_by::ReportedBy;

use super::failure::{Failure, InputError};
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::{figures, print, say, warn};

#[derive(Debug, clap::Args)]
pub(super) struct CalibrateArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// The calibration file, JSON; a page of the same name with the ending .html is written beside it
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    // The calibration file that the scene names may not exist yet: this command writes it.
    let text = SceneText::read(&args.scene)?;
    let resolved = &text.resolve()?;
    warn(&resolved.warnings);
    warn(resolved.scene.plane_section_warning().as_slice());
    warn(resolved.scene.one_load_warning().as_slice());
    check_out(&args.out)?;
    let pool = pool(args.threads)?;
    let progress = Progress::new(args.quiet, watch_for_interrupt());
    let done = pool.install(|| -> Result<Calibrated, Failure> {
        let done = calibrate::run(&resolved.scene, CalibrationExtent::Whole, &KeptInSpace::default(), &progress)
            .map_err(|error| refused(error, &text))?;
        progress.stage(CalibrationStage::Report.name());
        let byline = ReportedBy::line_of_scene(&resolved.to_toml());
        report::calibration::write(&done.calibration, &done.stages, [resolved.title(), &byline], &args.out)?;
        Ok(done)
    });
    progress.finish();
    let done = match done {
        Err(Failure::Interrupted) => {
            say("interrupted; nothing was written");
            return Err(Failure::Interrupted);
        }
        other => other?,
    };
    if !args.quiet {
        print(&table(resolved.title(), &done, &args.out))?;
    }
    Ok(())
}

/// Checks that the files can be written, before any work.
fn check_out(out: &Path) -> Result<(), Failure> {
    let what = if out.is_dir() {
        "which is a folder"
    } else if out.file_name().is_none() {
        "which names no file"
    } else if out == report::calibration::page_beside(out) {
        "whose ending is that of the page beside it"
    } else {
        return Ok(report::writable(report::calibration::folder(out))?);
    };
    Err(InputError::CalibrationOut { name: out.display().to_string(), what }.into())
}

/// Failure of the input, at its place, or of the solver.
fn refused(error: CalibrateError, text: &SceneText) -> Failure {
    if let Some(scene) = error.in_the_scene(text) {
        return scene.into();
    }
    match error {
        CalibrateError::Interrupted => Failure::Interrupted,
        other => Failure::Calibrate(other),
    }
}

/// The main figures, for the terminal.
fn table(title: &str, done: &Calibrated, out: &Path) -> String {
    let calibration = &done.calibration;
    let mut text = format!("{title}\n\n{}", figures::row("stiffness of the pair, N/(mm·µm)", ["fem", "W.-B."]));
    for (name, at) in ["A", "B", "C", "D", "E"].iter().zip(&calibration.deflection_at_points) {
        if let Some(at) = at {
            let values = [at.pair_n_per_mm_um(), at.weber_banaschek_n_per_mm_um()].map(figures::digits);
            text.push_str(&figures::row(&format!("  at {name}"), [&values[0], &values[1]]));
        }
    }
    text.push_str(&figures::row("maximum error of K/H, %", ["fitted", "held out"]));
    for criterion in MatchCriterion::ALL {
        if let Some(fit) = calibration.foundation_fit.get(&criterion) {
            let values = [&fit.fitted, &fit.held_out].map(|errors| figures::digits(100.0 * errors.worst_matched));
            text.push_str(&figures::row(&format!("  in the {}", criterion.name()), [&values[0], &values[1]]));
        }
    }
    if let Some(fit) = &calibration.slices {
        let values = [fit.compliance.teeth, 100.0 * fit.residual].map(figures::digits);
        text.push_str(&figures::row("slices, fitted to 3-D finite elements", ["teeth ×", "residual, %"]));
        text.push_str(&figures::row("  compliance", [&values[0], &values[1]]));
    }
    let page = report::calibration::page_beside(out);
    text.push_str(&format!(
        "\ncomputed in {:.2} s\ncalibration: {}\nreport: {}\n",
        done.wall_s,
        out.display(),
        page.display()
    ));
    text
}
