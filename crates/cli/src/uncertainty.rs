//! `gearwear uncertainty`: quantiles and Sobol indices of uncertain keys.

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gearwear::journal::{self, Journal, JournalError};
use gearwear::report;
use gearwear::scene::opened::OpenedScene;
use gearwear::uncertainty::asked::{UncertaintyFault, UncertaintyQuestion};
use gearwear::uncertainty::kept::SampledStudy;
use gearwear::uncertainty::record::UncertaintyRecord;
use gearwear::uncertainty::report as report_of_study;
use gearwear::uncertainty::sampled_run::{SampledQuestion, UncertaintyStudyError};
use gearwear::uncertainty::study::PreparedStudy;

use super::counted_progress::CountedProgress;
use super::failure::{Failure, InputError};
use super::figures::{digits, or_dash, two_digits};
use super::run::{thread_count, watch_for_interrupt};
use super::{print, say, warn};

#[derive(Debug, clap::Args)]
pub(super) struct UncertaintyArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// A key of the scene, and its distribution: normal:MEAN:SD, lognormal:MEDIAN:FACTOR (68 % of the values lie from MEDIAN/FACTOR to
    /// MEDIAN·FACTOR), uniform:LOW:HIGH, triangular:LOW:MODE:HIGH; about the scene's own value ±40%, normal:10% and lognormal:FACTOR.
    /// Keys that have the same value: pair.{pinion,wheel}.tip_rounding_mm. What is usual by a word: coefficient (lognormal:1.5) or
    /// coefficient:REGIME (as compare --prior), torque (±5%), class:N (profile and helix slopes of ISO 1328-1). May be given several times
    #[arg(long, value_name = "KEY=DISTRIBUTION", required = true)]
    uncertain: Vec<String>,
    /// Correlation of two uncertain keys, of their normal scores. May be given several times; pairs that are not given are independent
    #[arg(long, value_name = "KEY:KEY=R")]
    correlation: Vec<String>,
    /// The folder for the results; the same study goes on where it was stopped, another one is refused
    #[arg(long, value_name = "DIR", required_unless_present = "resume")]
    out: Option<PathBuf>,
    /// Go on with the study in this folder, which must have one
    #[arg(long, value_name = "DIR", conflicts_with = "out")]
    resume: Option<PathBuf>,
    /// Points of the Sobol sequence, best a power of two; each takes two runs and one more for every uncertain key
    #[arg(long, value_name = "N", default_value_t = UncertaintyQuestion::default().samples)]
    samples: usize,
    /// Another seed scrambles the sequence in another way
    #[arg(long, value_name = "S", default_value_t = UncertaintyQuestion::default().seed)]
    seed: u32,
    /// Figures to keep, as paths in summary.json, separated by commas; default: greatest wear and tip-edge wear of both gears, transmission
    /// error peak to peak, worn
    #[arg(long, value_name = "PATH,…", value_delimiter = ',')]
    outputs: Vec<String>,
    /// Ask for the life until a depth of wear is reached, such as pinion.peak_wear_um=10. May be given several times
    #[arg(long, value_name = "FIGURE=VALUE")]
    limit: Vec<String>,
    /// Run the samples on the contact surface of the scene; left out: on a calibrated Winkler foundation, where its figures differ
    /// by at most 5 %
    #[arg(long)]
    own_surface: bool,
    /// Run all samples; left out: those that a response surface of the others gives, with at most 5 % of the standard deviation as error
    #[arg(long)]
    run_all: bool,
    /// Number of threads; default: all cores. Never changes the results, but the times
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn run(args: &UncertaintyArgs) -> Result<(), Failure> {
    let scene = OpenedScene::open(&args.scene)?;
    warn(scene.warnings());
    let asked = UncertaintyQuestion {
        uncertain: args.uncertain.clone(),
        correlation: args.correlation.clone(),
        outputs: args.outputs.clone(),
        limits: args.limit.clone(),
        samples: args.samples,
        seed: args.seed,
        on_own_surface: args.own_surface,
        run_all: args.run_all,
    };
    let question = SampledQuestion::of(&scene, &asked)?;
    asked.notes().iter().for_each(|note| say(&format!("note: {note}")));
    let out = folder(args)?;
    let interrupted = watch_for_interrupt();
    if !args.quiet {
        say(&format!("{} samples of {} uncertain keys", question.samples, question.uncertain.len()));
    }
    let progress = CountedProgress::new(args.quiet, Arc::clone(&interrupted));
    let prepared = PreparedStudy::new(&scene, &question, &progress).map_err(UncertaintyFault::Study)?;
    let study = prepared.study().map_err(UncertaintyFault::Scene)?;
    let mut journal = Journal::open(out, study).map_err(|error| of_journal(args, error))?;
    report_of_study::begin(out)?;
    if !(args.quiet || journal.contents.rows.is_empty()) {
        say(&format!("goes on: {} runs were finished before", journal.contents.rows.len()));
    }
    if !args.quiet
        && let Some(seconds) = prepared.seconds_left(&journal, thread_count(args.threads), &progress)
    {
        let fewer = if question.run_all { "" } else { "; a response surface may do with fewer" };
        say(&format!("the runs take some {} s, the machine as busy as now{fewer}", two_digits(seconds)));
    }
    let mut not_written = None;
    let record = prepared.run(&mut journal, thread_count(args.threads), &progress, |record| {
        progress.say(&earlier(record));
        not_written = report_of_study::write(record, out).err();
    });
    progress.finish();
    let record = record.map_err(UncertaintyFault::Study)?;
    if let Some(error) = not_written {
        return Err(error.into());
    }
    report_of_study::write(&record, out)?;
    if !args.quiet {
        print(&table(&record, out))?;
    }
    if record.runs < record.runs_asked {
        say(&format!(
            "interrupted: figures of {} of {} samples; finished runs are kept, and --resume {} goes on",
            record.runs,
            record.runs_asked,
            out.display()
        ));
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Folder of the study; one that is resumed has a study.
fn folder(args: &UncertaintyArgs) -> Result<&Path, Failure> {
    if let Some(resumed) = &args.resume {
        journal::read::<SampledStudy>(resumed).map_err(|error| of_journal(args, error))?;
    }
    let out = args.resume.as_deref().or(args.out.as_deref()).unwrap_or(Path::new(""));
    report::writable(out)?;
    Ok(out)
}

fn of_journal(args: &UncertaintyArgs, error: JournalError) -> InputError {
    InputError::Journal { option: if args.resume.is_some() { "--resume" } else { "--out" }, error }
}

impl From<UncertaintyFault> for Failure {
    fn from(fault: UncertaintyFault) -> Self {
        match fault {
            UncertaintyFault::Scene(error) => Failure::Scene(error),
            UncertaintyFault::Study(error @ UncertaintyStudyError::Interrupted) => {
                say(&format!("{error}: nothing to write; finished runs are kept, and the same command goes on"));
                Failure::Interrupted
            }
            UncertaintyFault::Study(UncertaintyStudyError::AllFailed { runs, first }) => {
                Failure::NoSample { count: runs, error: first }
            }
            wrong => InputError::Uncertainty(wrong).into(),
        }
    }
}

/// First figures of a study that goes on, for the terminal.
fn earlier(record: &UncertaintyRecord) -> String {
    let shown = record.outputs.iter().map(|output| {
        let [low, middle, high] = [output.quantiles.p05, output.quantiles.p50, output.quantiles.p95].map(or_dash);
        format!("\n  {:42}{low:>12}{middle:>12}{high:>12} {}", output.output, output.unit)
    });
    let shown: String = shown.collect();
    format!(
        "5, 50 and 95 % of {} of {} points, after {} s:{shown}",
        record.samples,
        record.samples_asked,
        digits(record.wall_s)
    )
}

/// Quantiles and indices, for the terminal.
fn table(record: &UncertaintyRecord, out: &Path) -> String {
    let read_off = record
        .response_surface
        .map_or_else(String::new, |of| format!(" ({} of them read off a response surface of the others)", of.read_off));
    let mut text = format!(
        "{}\n\n{} points, {} samples{read_off}, {} failed, in {} s\n\n  {:42}{:>12}{:>12}{:>12}{:>12}\n",
        record.title,
        record.samples,
        record.runs,
        record.failed,
        digits(record.wall_s),
        "",
        "as given",
        "5 %",
        "50 %",
        "95 %"
    );
    for output in &record.outputs {
        let [p05, _, p50, _, p95] = output.quantiles.all();
        let [given, low, middle, high] = [output.nominal, p05, p50, p95].map(or_dash);
        text.push_str(&format!("  {:42}{given:>12}{low:>12}{middle:>12}{high:>12} {}\n", output.output, output.unit));
        if let Some(censored) = output.censored.filter(|&part| part > 0.0) {
            let part = digits(100.0 * censored);
            text.push_str(&format!("    {part} % of the samples do not come to the limit within their duration\n"));
        }
    }
    text.push_str(&format!("\n  {:42}{:>12}{:>12}\n", "Sobol indices", "first order", "total"));
    for output in &record.outputs {
        let because = output.no_indices_because.as_ref().map_or_else(String::new, |because| format!(": {because}"));
        text.push_str(&format!("  {}{because}\n", output.output));
        for one in output.indices.iter().flatten() {
            let (first, total) = (one.first.value, one.total.value);
            text.push_str(&format!("    {:40}{first:>12.3}{total:>12.3}\n", one.factor));
        }
    }
    if let Some(first) = &record.first_failure {
        text.push_str(&format!("\nthe first failure: {first}\n"));
    }
    text.push_str(&format!("\nerror of the fast model: {}\n", record.model_error_how));
    text.push_str(&format!("report: {}\n", out.join(output_files::PAGE).display()));
    text
}
