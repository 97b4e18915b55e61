//! `gearwear compare`: a measured flank profile against a finished run, or runs side by side ([`super::variants`]).

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::gear::Gear;
use crate::measurement::fit::FitStop;
use crate::measurement::form::Form;
use crate::pipeline::RunError;
use crate::report;
use crate::scene::loaded::SceneText;
use crate::studies::compare::asked::{CompareFault, Prepared};
use crate::studies::compare::question::{Asked, FitKind};
use crate::studies::compare::record::{CompareRecord, Estimate};
use crate::studies::compare::study::CompareError;

use super::failure::{Failure, InputError};
use super::figures::digits;
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::variants::{self, MOST_RUNS, Variants, is_run};
use super::{print, say, warn};

/// Longest shift along the flank, where nothing else is asked, mm.
const SHIFT_WITHIN_MM: f64 = 0.1;

/// What a measured file looks like.
const FILE_HELP: &str = "\
The measured file is CSV. Lines that begin with # come first and say what is measured:
  # gear = pinion                        or wheel
  # hours = 31.75                        or revolutions (of the pinion); left out: the end of the run
  # width_mm = 7.0                       place over the face width; only for runs with slices
  # uncertainty_um = 0.3                 of a height, one standard deviation
  # arc_from = start-of-active-profile   with arc_mm: or base-circle, or tip (towards the root)
  # height_from = involute               or line: heights of a stylus, with the curvature of the tooth
Then column names with units, in any order: radius_mm, arc_mm or roll_angle_deg, and height_um or height_mm (falls
where material is gone) or wear_um or wear_mm (rises there); then a row for each point, from one end to the other.";

#[derive(Debug, clap::Args)]
#[command(after_help = FILE_HELP)]
pub(super) struct Args {
    /// The folder of a finished `gearwear run`; beside other runs a scene too, which is run first
    run: PathBuf,
    /// The measured profile, a CSV file (- reads standard input); or one to five more runs, to be shown side by side
    #[arg(value_name = "MEASURED|RUN", required = true, num_args = 1..MOST_RUNS)]
    with: Vec<PathBuf>,
    /// The gear that was measured, where the file does not say
    #[arg(long, value_name = "GEAR", value_parser = gear)]
    gear: Option<Gear>,
    /// The form removed from the measured and the simulated profile alike; default: cubic of heights, none of
    /// wear depths
    #[arg(long, value_enum)]
    form: Option<Form>,
    /// What is fitted: the wear coefficient k, the factor of severe wear, both, or nothing
    #[arg(long, value_enum, default_value_t = FitKind::K)]
    fit: FitKind,
    /// How far the profile may be shifted along the flank to where it fits best; 0: not at all
    #[arg(long, value_name = "MM", default_value_t = SHIFT_WITHIN_MM, value_parser = length)]
    shift_within: f64,
    /// The folder for the results; default: compare/NAME in RUN, with the name of the measured file or of the second run
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

fn gear(text: &str) -> Result<Gear, String> {
    let named = Gear::BOTH.into_iter().find(|gear| gear.name() == text);
    named.ok_or_else(|| "allowed: pinion or wheel".to_owned())
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("allowed: a length in mm, 0 or more".to_owned()),
    }
}

impl Args {
    /// The measured profile.
    fn measured(&self) -> &Path {
        &self.with[0]
    }

    /// The runs to be shown side by side; none where there is a measured profile.
    fn variants(&self) -> Option<Variants<'_>> {
        let runs: Vec<&Path> = [&self.run].into_iter().chain(&self.with).map(PathBuf::as_path).collect();
        let wanted = self.with.len() > 1 || is_run(self.measured());
        wanted.then_some(Variants { runs, out: self.out.as_deref(), threads: self.threads, quiet: self.quiet })
    }

    /// Where the results go.
    fn out(&self) -> PathBuf {
        let name = self.measured().file_stem().filter(|stem| *stem != "-").unwrap_or("measured".as_ref());
        self.out.clone().unwrap_or_else(|| self.run.join("compare").join(name))
    }
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if let Some(variants) = args.variants() {
        return match (args.gear, args.form) {
            (Some(_), _) => Err(InputError::OnlyForMeasured { option: "--gear" }.into()),
            (_, Some(_)) => Err(InputError::OnlyForMeasured { option: "--form" }.into()),
            _ => variants::run(&variants),
        };
    }
    let text = SceneText::read(args.measured())?;
    let asked = Asked { gear: args.gear, form: args.form, fit: args.fit, shift_within_mm: args.shift_within };
    let prepared = Prepared::open(&args.run, &text, &asked)?;
    let out = args.out();
    report::writable(&out)?;

    let pool = pool(args.threads)?;
    let progress = Progress::new(args.quiet, Arc::clone(&watch_for_interrupt()));
    let done = pool.install(|| prepared.carry_out(&progress));
    progress.finish();
    let record = done.map_err(|error| match error {
        CompareError::Interrupted => {
            say("interrupted before the comparison was finished");
            Failure::Interrupted
        }
        CompareError::Run(error) => Failure::Run(error),
    })?;
    crate::studies::compare::report::write(&record, &out)?;
    if !args.quiet {
        let report = out.join("report.html");
        print(&format!("{}report: {}\n", table(&record), report.display()))?;
    }
    if record.fit.stopped == FitStop::Converged {
        warn(&record.warnings);
        return Ok(());
    }
    let why = format!("{}; what was compared is kept in {}", record.warnings.join("; "), out.display());
    Err(Failure::NotFitted { why })
}

impl From<CompareFault> for Failure {
    fn from(fault: CompareFault) -> Self {
        match fault {
            CompareFault::Load(error) => error.into(),
            CompareFault::RunFolder(error) => InputError::RunFolder(error).into(),
            CompareFault::Measured { name, error } => InputError::Measured { name, error }.into(),
            CompareFault::Pair(error) => Failure::Run(RunError::from(error)),
        }
    }
}

/// What was found, for the terminal.
fn table(record: &CompareRecord) -> String {
    let (fit, f) = (&record.fit, &record.figures);
    let mut text = format!("{} – {}\n\n", record.title, record.measured);
    let line = |name: &str, cells: [&str; 4]| {
        format!("  {name:44}{:>12}{:>12}{:>12}{:>12}\n", cells[0], cells[1], cells[2], cells[3])
    };
    let mut estimate = |name: &str, estimate: &Option<Estimate>, head: bool| {
        let Some(e) = estimate else { return };
        if head {
            text.push_str(&line("", ["run", "fitted", "95 % from", "to"]));
        }
        let end = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), digits);
        text.push_str(&line(name, [&digits(e.of_run), &digits(e.value), &end(e.low), &end(e.high)]));
    };
    estimate("wear coefficient k, m²/N", &fit.coefficient_m2_per_N, true);
    estimate("factor of severe wear", &fit.severe_factor, fit.coefficient_m2_per_N.is_none());
    let is_first = fit.coefficient_m2_per_N.is_none() && fit.severe_factor.is_none();
    estimate("shift towards the tip, mm", &fit.shift_mm, is_first);
    text.push_str(&format!("\n  {}\n\n", fit.how));
    for (name, value) in [
        ("arithmetic mean deviation, measured, µm", Some(f.mean_deviation_um)),
        ("  the same, simulated", Some(f.simulated_mean_deviation_um)),
        ("Ra, cutoff 0.8 mm, measured, µm", f.roughness_um),
        ("difference as run, root mean square, µm", Some(f.as_run_difference_um)),
        ("  after the fit", Some(f.difference_um)),
    ] {
        text.push_str(&format!("  {name:44}{:>12}\n", value.map_or_else(|| "–".to_owned(), digits)));
    }
    let runs = if fit.runs == 1 { "run" } else { "runs" };
    text.push_str(&format!(
        "\nform {}, {} {runs} of the scene ({} mesh cycles)\n",
        record.form, fit.runs, fit.mesh_cycles
    ));
    text
}
