//! `gearwear accuracy`: error against run time of every model that fits a scene.

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;

use gearwear::report;
use gearwear::scene::loaded::LoadedScene;
use gearwear_physics::results::run::StopReason;
use gearwear_studies::accuracy::record::{AccuracyRecord, ComparedQuantity, VariantRecord};
use gearwear_studies::accuracy::selection::AccuracyOptions;
use gearwear_studies::accuracy::study::{self, AccuracyError};

use super::failure::Failure;
use super::figures::{digits, or_dash};
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::{print, say, warn};

#[derive(Debug, clap::Args)]
pub(super) struct AccuracyArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// The folder for the results; files of an earlier comparison are replaced
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The error to stay within, in per cent: the cheapest setting below it is recommended
    #[arg(long, value_name = "PERCENT", default_value_t = 5.0, value_parser = per_cent)]
    within: f64,
    /// Number of threads; default: all cores. Never changes the results, but the times
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Leave the scene's own resolution out: half of its points, positions and steps at most
    #[arg(long)]
    quick: bool,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

fn per_cent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 100.0 => Ok(value),
        _ => Err("allowed: a number above 0 and at most 100".to_owned()),
    }
}

pub(super) fn run(args: &AccuracyArgs) -> Result<(), Failure> {
    let scene = LoadedScene::open(&args.scene)?;
    warn(scene.warnings());
    report::writable(&args.out)?;
    let pool = pool(args.threads)?;
    let progress = Progress::new(args.quiet, Arc::clone(&watch_for_interrupt()));
    let asked = AccuracyOptions { within: args.within / 100.0, quick: args.quick };
    let done = pool.install(|| study::run(&scene, asked, &progress));
    progress.finish();
    let record = done.map_err(|error| match error {
        AccuracyError::Interrupted => {
            say("interrupted before the reference was finished: nothing to compare");
            Failure::Interrupted
        }
        failed => Failure::Accuracy(failed),
    })?;
    gearwear_studies::accuracy::report::write(&record, &args.out)?;
    if !args.quiet {
        let report = args.out.join(output_files::PAGE);
        print(&format!("{}report: {}\n", table(&record), report.display()))?;
    }
    if record.stopped == StopReason::Completed {
        return Ok(());
    }
    say(&format!("interrupted: {} runs were finished and are kept in {}", record.variants.len(), args.out.display()));
    Err(Failure::Interrupted)
}

fn in_percent(error: f64) -> String {
    format!("{} %", digits(100.0 * error))
}

/// Error of a run in `quantity`.
fn error(run: &VariantRecord, quantity: ComparedQuantity) -> Option<String> {
    run.errors.get(&quantity).map(|error| in_percent(error.relative))
}

/// The front of the wear profile and the recommendations, for the terminal.
fn table(record: &AccuracyRecord) -> String {
    let mut text = format!("{}\n\nreference: {}\n\n", record.title, record.reference.how);
    if let Some(open) = &record.reference.does_not_tell {
        text.push_str(&format!("{open}\n\n"));
    }
    let names = record.variants.iter().map(|variant| variant.name.chars().count());
    let width = names.max().unwrap_or(0).max(60);
    text.push_str(&format!(
        "  {:width$}{:>10}{:>12}{:>12}{:>12}\n",
        "Pareto front of the wear profile", "time, s", "profile", "pressure", "trans. err"
    ));
    let mut front: Vec<&VariantRecord> = record
        .variants
        .iter()
        .filter(|v| v.errors.get(&ComparedQuantity::WearProfile).is_some_and(|e| e.on_front))
        .collect();
    front.sort_by(|a, b| a.simulation_s.unwrap_or(0.0).total_cmp(&b.simulation_s.unwrap_or(0.0)));
    for variant in front {
        let [profile, pressure, error] =
            [ComparedQuantity::WearProfile, ComparedQuantity::FlankPressure, ComparedQuantity::TransmissionError]
                .map(|quantity| error(variant, quantity).unwrap_or_else(|| "–".to_owned()));
        let (name, wall_s) = (&variant.name, or_dash(variant.simulation_s));
        text.push_str(&format!("  {name:width$}{wall_s:>10}{profile:>12}{pressure:>12}{error:>12}\n"));
    }
    if !record.recommendations.is_empty() {
        text.push_str(&format!("\nfastest within {}\n", in_percent(record.within)));
    }
    for r in &record.recommendations {
        let Some(variant) = record.variants.get(r.variant) else { continue };
        let found = error(variant, r.quantity).unwrap_or_default();
        let none = if r.is_within { "" } else { "none; closest: " };
        let wall_s = variant.simulation_s.map_or_else(String::new, |s| format!(", {} s", digits(s)));
        text.push_str(&format!("  {:44}{none}{} ({found}{wall_s})\n", r.quantity.title(), variant.name));
    }
    if !record.not_ranked.is_empty() {
        text.push_str(&format!("\nnot ranked: the reference is more uncertain than {}\n", in_percent(record.within)));
    }
    for not in &record.not_ranked {
        let uncertain = in_percent(not.uncertainty);
        text.push_str(&format!("  {:44}{uncertain}; to converge: {}\n", not.quantity.title(), not.remedy));
    }
    let failed: Vec<&VariantRecord> = record.variants.iter().filter(|v| v.failure.is_some()).collect();
    if !failed.is_empty() {
        text.push_str(&format!(
            "\n{} of {} runs have no result; report.html says why\n",
            failed.len(),
            record.variants.len()
        ));
    }
    text.push_str(&format!("\n{} runs in {} s\n", record.variants.len(), digits(record.wall_s)));
    text
}
