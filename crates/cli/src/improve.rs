//! `gearwear improve`: designs that are better, verified on finite elements.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gearwear::journal::{Journal, JournalError};
use gearwear::report::{self, output_files};
use gearwear::scene::loaded::LoadedScene;
use gearwear_studies::improve::asked::ImproveError;
use gearwear_studies::improve::proposal::{ComparedFigure, Proposal};
use gearwear_studies::improve::record::ImproveRecord;
use gearwear_studies::improve::report as report_of_study;
use gearwear_studies::improve::study::PreparedImprove;
use gearwear_studies::improve::words::signed;

use super::counted_progress::CountedProgress;
use super::failure::{Failure, InputError};
use super::figures::{digits, two_digits};
use super::run::{thread_count, watch_for_interrupt};
use super::{print, say, warn};

#[derive(Debug, clap::Args)]
pub(super) struct ImproveArgs {
    /// The scene file; - reads standard input. Its table [improve] says what is free and what is wanted; without it tip reliefs are chosen
    /// for least wear of both gears and least transmission error over life
    scene: PathBuf,
    /// The folder for the results; a study that was stopped goes on where it was, another one is refused
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Number of threads; default: all cores. Never changes the results, but the times
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn run(args: &ImproveArgs) -> Result<(), Failure> {
    let scene = LoadedScene::open(&args.scene)?;
    warn(scene.warnings());
    let interrupted = watch_for_interrupt();
    let progress = CountedProgress::new(args.quiet, Arc::clone(&interrupted));
    let prepared = PreparedImprove::new(&scene, &progress)?;
    if !args.quiet {
        let free: Vec<String> = prepared.free().iter().map(|one| format!("  {}", one.as_given())).collect();
        let time = prepared.seconds_at_most(thread_count(args.threads), &progress);
        let time = time.map_or_else(String::new, |seconds| {
            format!(", some {} s with their verification, the machine as busy as now", two_digits(seconds))
        });
        let designs = prepared.evaluations();
        say(&format!("free:\n{}\nat most {designs} designs on the fast model{time}", free.join("\n")));
    }
    let identity = prepared.identity()?;
    report::writable(&args.out)?;
    let mut journal = Journal::open(&args.out, identity).map_err(ImproveError::Journal)?;
    report_of_study::begin(&args.out)?;
    if !(args.quiet || journal.contents.rows.is_empty()) {
        say(&format!("goes on: {} designs were finished before", journal.contents.rows.len()));
    }
    let record = prepared.run(&mut journal, thread_count(args.threads), &progress);
    progress.finish();
    let record = record?;
    report_of_study::write(&record, &args.out)?;
    if !args.quiet {
        print(&answer(&record, &args.out))?;
    }
    Ok(())
}

impl From<ImproveError> for Failure {
    fn from(error: ImproveError) -> Self {
        match error {
            ImproveError::Scene(error) => Failure::Scene(error),
            ImproveError::Interrupted => {
                say("interrupted: finished designs are kept, and the same command goes on");
                Failure::Interrupted
            }
            ImproveError::Base(_) | ImproveError::NoDesign { .. } | ImproveError::NotWithinLimits { .. } => {
                Failure::NoProposal { why: error.to_string() }
            }
            ImproveError::Journal(error) => of_journal(error).into(),
            ImproveError::Report(error) => error.into(),
        }
    }
}

fn of_journal(error: JournalError) -> InputError {
    InputError::Journal { option: "--out", error }
}

/// Answer for the terminal.
fn answer(record: &ImproveRecord, out: &Path) -> String {
    let mut text = format!(
        "{}\n\n{} designs on the fast model, of which {} on the front, in {} s; {}\n",
        record.title,
        record.searched,
        record.front.len(),
        digits(record.wall_s),
        record.stopped
    );
    for proposal in &record.proposals {
        let first = record.proposals.first().filter(|first| first.name != proposal.name);
        text.push_str(&proposed(proposal, first));
    }
    text.push_str("\nwhat no design does\n");
    record.bounds.iter().for_each(|bound| text.push_str(&format!("  {bound}\n")));
    text.push_str(&format!("\nreport: {}\n", out.join(output_files::PAGE).display()));
    text
}

/// A proposal, beside the `first` of them.
fn proposed(proposal: &Proposal, first: Option<&Proposal>) -> String {
    let mut text = format!("\n{}: gearwear run {}\n", proposal.name, proposal.file);
    for value in &proposal.values {
        let edge = if value.edge.is_some() { "   end of the range: a wider one may have a better design" } else { "" };
        text.push_str(&format!("  {:50}{:>12}{edge}\n", value.key, value.value));
    }
    text.push_str(&format!("  {:50}{:>12}{:>12}{:>12}\n", "", "as given", "proposed", "change"));
    let shown = |figure: &&ComparedFigure| figure.is_goal || figure.is_changed();
    for figure in proposal.figures.iter().filter(shown) {
        let error = figure.error.map_or_else(String::new, |error| format!("  ± {} %", two_digits(100.0 * error)));
        let equal = if figure.is_changed() { "" } else { "  within the errors" };
        let unit = if figure.unit.is_empty() { String::new() } else { format!(", {}", figure.unit) };
        text.push_str(&format!(
            "  {:50}{:>12}{:>12}{:>12}{error}{equal}\n",
            format!("{}{unit}", figure.heading),
            digits(figure.as_given),
            digits(figure.value),
            figure.change().map_or_else(|| "–".to_owned(), signed)
        ));
    }
    let tolerance = proposal.tolerance();
    if !tolerance.is_empty() {
        text.push_str(&format!("  {tolerance}\n"));
    }
    if let Some(first) = first {
        text.push_str(&format!("  {}\n", proposal.against(first)));
    }
    text
}
