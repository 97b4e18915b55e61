//! `gearwear sweep`: the scene's run for all combinations of some varied keys, and `gearwear sweep merge`.

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use gearwear::evaluate::figure;
use gearwear::journal::{self, JournalContents, JournalError, Kept};
use gearwear::report;
use gearwear::scene::draft::Draft;
use gearwear::scene::loaded::SceneText;
use gearwear::scene::opened::OpenedScene;
use gearwear::sweep::asked::SweepQuestion;
use gearwear::sweep::axis::{self, AxisError};
use gearwear::sweep::combination::Sweep;
use gearwear::sweep::goal::Optimum;
use gearwear::sweep::merge::merge;
use gearwear::sweep::record::{Shard, SweepPart, SweepRecord};
use gearwear::sweep::unfinished::UnfinishedSweep;
use gearwear::sweep::verification::{SweepVerification, intention};

use super::counted_progress::CountedProgress;
use super::failure::{Failure, InputError};
use super::figures::{digits, two_digits};
use super::run::{thread_count, watch_for_interrupt};
use super::{print, say, warn};

#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(super) struct SweepArgs {
    #[command(flatten)]
    run: Option<SweepRunArgs>,
    #[command(subcommand)]
    part: Option<SweepSubcommand>,
}

/// A sweep to run.
#[derive(Debug, clap::Args)]
pub(super) struct SweepRunArgs {
    /// The scene file; - reads standard input
    #[arg(required = true)]
    scene: PathBuf,
    /// A key of the scene, and its values: COUNT of them evenly from FROM to TO, both included, by equal ratios with :log after
    /// it, or a list, KEY=VALUE,VALUE,… of numbers or words. Keys that have the same value: pair.{pinion,wheel}.teeth; of
    /// phases: operation.phases.2.hours. May be given several times: all combinations are run
    #[arg(long, value_name = "KEY=FROM:TO:COUNT", required = true)]
    vary: Vec<String>,
    /// The figure that is to be least, a column of sweep.csv: its best combination is verified by finite elements, and those
    /// that are as good within its error are named
    #[arg(long, value_name = "FIGURE")]
    best: Option<String>,
    /// A limit that the best combination keeps to: FIGURE<=VALUE or FIGURE>=VALUE. May be given several times
    #[arg(long, value_name = "FIGURE<=VALUE", requires = "best")]
    subject_to: Vec<String>,
    /// Columns beside the main figures, as paths in summary.json, separated by commas
    #[arg(long, value_name = "PATH,…", value_delimiter = ',')]
    outputs: Vec<String>,
    /// The folder for the results; a sweep that was stopped goes on where it was
    #[arg(long, value_name = "DIR", required = true)]
    out: PathBuf,
    /// Run only part I of N, every N-th combination; each part into a folder of its own, merged afterwards
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Number of threads; default: all cores. Never changes the results, but the times
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Estimate the errors of each combination, which costs extra runs and warns where they are large
    #[arg(long)]
    error_estimate: bool,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

#[derive(Debug, clap::Subcommand)]
enum SweepSubcommand {
    /// Make one sweep from the folders of its shards
    Merge(MergeArgs),
}

/// Shards to merge.
#[derive(Debug, clap::Args)]
pub(super) struct MergeArgs {
    /// The folders of the shards, in any order
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// The folder for the results of the whole sweep
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Show no figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

fn shard(text: &str) -> Result<Shard, String> {
    let parsed = text
        .split_once('/')
        .and_then(|(number, of)| Some(Shard { number: number.trim().parse().ok()?, of: of.trim().parse().ok()? }));
    match parsed {
        Some(shard) if (1..=shard.of).contains(&shard.number) && shard.of <= axis::MOST_COMBINATIONS => Ok(shard),
        _ => Err("allowed: I/N with I from 1 to N, such as 3/10".to_owned()),
    }
}

pub(super) fn run(args: &SweepArgs) -> Result<(), Failure> {
    match (&args.part, &args.run) {
        (Some(SweepSubcommand::Merge(args)), _) => merge_shards(args),
        (None, Some(args)) => run_sweep(args),
        (None, None) => Err(InputError::Vary(AxisError::Form { given: String::new() }).into()),
    }
}

fn run_sweep(args: &SweepRunArgs) -> Result<(), Failure> {
    let scene = OpenedScene::open(&args.scene)?;
    warn(scene.warnings());
    let question = SweepQuestion {
        vary: args.vary.clone(),
        best: args.best.clone(),
        subject_to: args.subject_to.clone(),
        error_estimate: args.error_estimate,
        outputs: args.outputs.clone(),
    };
    let sweep = Sweep::of(&scene, &question)?;
    question.notes().iter().for_each(|note| say(&format!("note: {note}")));
    warn(&sweep.warnings());
    let mut unfinished = UnfinishedSweep::begin_part(&sweep, Some(&args.out), args.shard)?;
    let threads = thread_count(args.threads);
    let interrupted = watch_for_interrupt();
    let total = unfinished.combinations();
    if !args.quiet {
        say(&begun(&sweep, args, total, unfinished.finished()));
    }
    let progress = CountedProgress::new(args.quiet, Arc::clone(&interrupted));
    let completed = unfinished.run(threads, &progress);
    progress.finish();
    if !completed? {
        let (finished, out) = (unfinished.finished(), args.out.display());
        let verified = match unfinished.verified() {
            0 => String::new(),
            verified => format!(", {verified} of them verified,"),
        };
        say(&format!(
            "interrupted: {finished} of {total} combinations are finished{verified} and kept in {out}; the same command continues there"
        ));
        return Err(Failure::Interrupted);
    }
    finish(&unfinished.finish()?, &args.out, args.quiet)
}

/// Description of the sweep about to be run.
fn begun(sweep: &Sweep, args: &SweepRunArgs, total: usize, finished: usize) -> String {
    let part = args.shard.map_or_else(String::new, |shard| {
        format!(", shard {}/{} of {}", shard.number, shard.of, sweep.identity.combinations())
    });
    let before = if finished > 0 { format!(", {finished} of them finished before") } else { String::new() };
    let estimates = if args.error_estimate {
        String::new()
    } else {
        "; errors are not estimated (--error-estimate does it)".to_owned()
    };
    let verification = match (sweep.identity.verify, args.shard) {
        (true, None) => format!("; finite elements then verify {}", intention(&sweep.identity)),
        (true, Some(_)) => {
            "; finite elements verify none of a shard: the best of all rows are known when it is merged".to_owned()
        }
        (false, _) => {
            "; none is verified by finite elements (numerics.verify = true in the scene does it for a few)".to_owned()
        }
    };
    format!("{total} combinations{part}{before}{estimates}{verification}")
}

fn merge_shards(args: &MergeArgs) -> Result<(), Failure> {
    let out = args.out.canonicalize().ok();
    let mut folders = args.folders.iter();
    if let Some(folder) = folders.find(|folder| out.is_some() && folder.canonicalize().ok() == out) {
        return Err(InputError::MergeIntoShard { name: folder.display().to_string() }.into());
    }
    let start = Instant::now();
    let whole = merge(&args.folders).map_err(InputError::Merge)?;
    let scene_toml = scene_of(&whole, &args.folders)?;
    report::writable(&args.out)?;
    not_another_sweep(&whole, &args.out).map_err(of_journal)?;
    journal::write(&args.out, &whole)
        .map_err(|source| of_journal(JournalError::Open { path: args.out.join(journal::FILE_NAME), source }))?;
    let record = SweepRecord {
        identity: whole.study.identity,
        shard: None,
        scene_toml,
        rows: whole.rows.into_values().collect(),
        threads: 0,
        wall_s: start.elapsed().as_secs_f64(),
    };
    gearwear::sweep::report::write(&record, &args.out)?;
    finish(&record, &args.out, args.quiet)
}

fn of_journal(error: JournalError) -> InputError {
    InputError::Journal { option: "--out", error }
}

/// Checks that rows in `out` are of this sweep, as they will be replaced.
fn not_another_sweep(whole: &JournalContents<SweepPart>, out: &Path) -> Result<(), JournalError> {
    let differences = match journal::read::<SweepPart>(out) {
        Ok(found) => found.study.identity.differences(&whole.study.identity),
        Err(JournalError::NoStudy { .. }) => Vec::new(),
        Err(error) => return Err(error),
    };
    if differences.is_empty() {
        return Ok(());
    }
    Err(JournalError::OtherStudy { path: out.join(journal::FILE_NAME), kind: SweepPart::KIND, differences })
}

/// The scene of the sweep, from the first folder that has it.
fn scene_of(whole: &JournalContents<SweepPart>, folders: &[PathBuf]) -> Result<String, InputError> {
    let scenes = folders.iter().map(|folder| folder.join(output_files::SCENE));
    let mut texts = scenes.filter_map(|scene| SceneText::read(&scene).ok().map(|scene| scene.text));
    texts
        .find(|text| Draft::parse(text).is_ok_and(|draft| draft.hash() == whole.study.identity.given_hash))
        .ok_or(InputError::MergeWithoutScene)
}

/// Prints the result.
fn finish(record: &SweepRecord, out: &Path, quiet: bool) -> Result<(), Failure> {
    if !quiet {
        print(&table(record, out))?;
    }
    let first_error = record.rows.iter().find_map(|row| row.error.clone());
    match first_error {
        // All combinations of a shard may be invalid scenes.
        Some(error) if record.shard.is_none() && record.failed() == record.rows.len() => {
            Err(Failure::NoCombination { count: record.rows.len(), error })
        }
        _ => Ok(()),
    }
}

/// The best combinations, for the terminal.
fn table(record: &SweepRecord, out: &Path) -> String {
    let summary = record.summary();
    let mut text = format!(
        "{}\n\n{} combinations, {} without a result, in {} s\n",
        record.identity.title,
        record.rows.len(),
        summary.failed,
        digits(record.wall_s)
    );
    if !summary.best.is_empty() {
        text.push_str("\nleast of\n");
    }
    let kind = record.identity.kind;
    // Of a stage the first words alone: sweep.json and the page have all.
    let is_listed = |name: &str| kind.is_pair() || figure::find(kind, name).is_some_and(|figure| figure.in_headline());
    for best in summary.best.iter().filter(|best| is_listed(best.figure)) {
        let place = record.identity.in_words(best.index);
        let edge =
            if best.on_edge.is_empty() { String::new() } else { format!("   end of {}", best.on_edge.join(", ")) };
        text.push_str(&format!("  {:42}{:>12}   {place}{edge}\n", best.figure, digits(best.value)));
    }
    if let Some(goal) = &record.identity.goal {
        text.push_str(
            &summary.optimum.as_ref().map_or_else(
                || format!("\nno combination has {}\n", goal.in_words()),
                |optimum| found(record, optimum),
            ),
        );
    }
    if let Some(verification) = &summary.verification {
        text.push_str(&verified(record, verification));
    }
    let file = out.join(if record.shard.is_none() { output_files::PAGE } else { "sweep.csv" });
    text.push_str(&format!("\n{}: {}\n", if record.shard.is_none() { "report" } else { "table" }, file.display()));
    if cfg!(not(feature = "parquet")) && record.shard.is_none() {
        text.push_str("no sweep.parquet: this program was built with --no-default-features\n");
    }
    text
}

/// Optimum, and the combinations that equal it within the error, for the terminal.
fn found(record: &SweepRecord, optimum: &Optimum) -> String {
    let place = record.identity.in_words(optimum.index);
    let mut text = format!("\nleast {}: {} at {place}\n", optimum.goal.in_words(), digits(optimum.value));
    text.push_str(&match (&optimum.error, &optimum.plateau, &optimum.plateau_keys) {
        (Some(error), Some(plateau), Some(keys)) => format!(
            "  {} of {} combinations cannot be told from it within its error of {} %: {}\n",
            plateau.len(),
            optimum.within_limits,
            two_digits(100.0 * error),
            keys.join("; ")
        ),
        _ => format!(
            "  the number of equivalent combinations is not known: {}\n",
            optimum.why_no_error.as_deref().unwrap_or_default()
        ),
    });
    text
}

/// Verification of the chosen rows by finite elements, for the terminal.
fn verified(record: &SweepRecord, verification: &SweepVerification<'_>) -> String {
    let SweepVerification { intention, chosen, verified, unanswered, open, .. } = verification;
    let mut text = format!("\nverified by finite elements: {verified} of {chosen} chosen\n  {intention}\n");
    if !verification.worst.is_empty() {
        text.push_str("maximum difference of all, %\n");
    }
    for worst in &verification.worst {
        let place = record.identity.in_words(worst.index);
        text.push_str(&format!("  {:42}{:>12}   {place}\n", worst.title, two_digits(100.0 * worst.value)));
    }
    if let Some(reason) = verification.first_reason() {
        text.push_str(&format!("  {unanswered} without an answer, the first {reason}\n"));
    }
    if *open > 0 {
        text.push_str(&format!(
            "  {open} are not verified yet: gearwear sweep of the same scene and keys with this --out does it\n"
        ));
    }
    text
}
