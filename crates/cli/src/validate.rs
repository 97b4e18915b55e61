//! `gearwear validate`: the validation suite.

use gearwear::report::output_files;
use std::num::{NonZeroU64, NonZeroUsize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gearwear::report;
use gearwear_validation::invariants;
use gearwear_validation::invariants::study::{self, INVARIANTS, SceneRange};
use gearwear_validation::library::{self, Library};
use gearwear_validation::record::{Tier, ValidationRecord};
use gearwear_validation::{self as validation, against};

use gearwear_files::size_limit::SizeLimit;

use super::counted_progress::CountedProgress;
use super::failure::{Failure, InputError};
use super::run::{thread_count, watch_for_interrupt};
use super::{print, say};

/// Size of an earlier run's validation.json.
const VALIDATION_RECORD: SizeLimit = SizeLimit { of: "a validation.json", megabytes: 64 };

#[derive(Debug, clap::Args)]
pub(super) struct ValidateArgs {
    /// Cases: names of built-in ones, or folders with a case.toml; default: all built-in cases of the tier. The word invariants
    /// alone: random scenes, held against statements that are true of every scene
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// How much to run: smoke takes below 3 minutes on two cores, full below 15, long as long as it takes. With CASEs given,
    /// all of them are run unless a tier is asked for
    #[arg(long, value_name = "TIER", value_parser = tier)]
    tier: Option<Tier>,
    /// The folder for the results; files of an earlier run are replaced
    #[arg(long, value_name = "DIR", required_unless_present_any = ["export", "list"])]
    out: Option<PathBuf>,
    /// With invariants: the seed that the scenes are drawn from. Default: 1
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// With invariants: number of scenes. Default: 1000, with --tier smoke 100
    #[arg(long, value_name = "N")]
    count: Option<NonZeroU64>,
    /// With invariants: number of the first scene of the seed, so that one can be run again, or many on several machines. Default: 0
    #[arg(long, value_name = "N")]
    first: Option<u64>,
    /// An earlier run's validation.json: what got worse or better since, in verdicts, errors and work
    #[arg(long, value_name = "JSON")]
    against: Option<PathBuf>,
    /// Write the built-in cases to this folder, to be read, changed, or completed with measurements; runs nothing
    #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "cases", "tier", "against"])]
    export: Option<PathBuf>,
    /// List the built-in cases with their tiers and requirements; runs nothing
    #[arg(long, conflicts_with_all = ["out", "cases", "against", "export"])]
    list: bool,
    /// Number of threads; default: all cores. Never changes the results, but the times
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor verdicts, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

fn tier(text: &str) -> Result<Tier, String> {
    let found = Tier::ALL.into_iter().find(|tier| tier.name() == text);
    found.ok_or_else(|| format!("allowed: {}", Tier::ALL.map(Tier::name).join(", ")))
}

pub(super) fn run(args: &ValidateArgs) -> Result<(), Failure> {
    if let Some(folder) = &args.export {
        report::create_folder(folder)?;
        library::export(folder).map_err(InputError::ValidationCase)?;
        say(&format!("{} cases are in {}", library::names().len(), folder.join("validation").display()));
        return Ok(());
    }
    if args.cases == [INVARIANTS] {
        return random_scenes(args);
    }
    let of_scenes =
        [("--seed", args.seed.is_some()), ("--count", args.count.is_some()), ("--first", args.first.is_some())];
    if let Some((option, _)) = of_scenes.into_iter().find(|(_, given)| *given) {
        return Err(InputError::OnlyForInvariants { option }.into());
    }
    let library = Library::open(&args.cases).map_err(InputError::ValidationCase)?;
    let tier = library.tier(args.tier, args.cases.is_empty()).map_err(InputError::ValidationCase)?;
    if args.list {
        return list(&library, args.tier);
    }
    let earlier = args.against.as_deref().map(read_earlier).transpose()?;
    let Some(out) = &args.out else { unreachable!("clap demands it") };
    report::writable(out)?;
    let interrupted = watch_for_interrupt();
    let progress = CountedProgress::new(args.quiet, Arc::clone(&interrupted));
    let record = validation::run(&library.cases, tier, thread_count(args.threads), &progress);
    progress.finish();
    let changes = earlier.map(|earlier| against::changes(&earlier, &record));
    validation::report::write(&record, changes.as_ref(), out)?;
    if !args.quiet {
        // As wide as the terminal; `None` where the output goes elsewhere.
        let width = comfy_table::Table::new().width();
        let verdicts = validation::report::terminal(&record, changes.as_ref(), width);
        print(&format!("{verdicts}report: {}\n", out.join(output_files::PAGE).display()))?;
    }
    let missed: Vec<String> = record.cases.iter().filter(|case| !case.passed()).map(|case| case.name.clone()).collect();
    match (record.not_run.is_empty(), missed.is_empty()) {
        (false, _) => {
            say(&format!("interrupted: {} cases were finished and are kept in {}", record.cases.len(), out.display()));
            Err(Failure::Interrupted)
        }
        (true, false) => Err(Failure::Missed { cases: missed }),
        (true, true) => Ok(()),
    }
}

/// Random scenes, held against statements that are true of every scene.
fn random_scenes(args: &ValidateArgs) -> Result<(), Failure> {
    if args.list || args.against.is_some() {
        let option = if args.list { "--list" } else { "--against" };
        return Err(InputError::NotForInvariants { option }.into());
    }
    let Some(out) = &args.out else { unreachable!("clap demands it") };
    let of_tier = SceneRange::of_tier(args.tier);
    let asked = SceneRange {
        seed: args.seed.unwrap_or(of_tier.seed),
        first: args.first.unwrap_or(of_tier.first),
        count: args.count.map_or(of_tier.count, NonZeroU64::get),
    };
    report::writable(out)?;
    let interrupted = watch_for_interrupt();
    let progress = CountedProgress::new(args.quiet, Arc::clone(&interrupted));
    let record = study::run(asked, thread_count(args.threads), &progress);
    progress.finish();
    invariants::report::write(&record, out)?;
    if !args.quiet {
        print(&format!(
            "{}report: {}\n",
            invariants::report::terminal(&record),
            out.join(output_files::PAGE).display()
        ))?;
    }
    if record.drawn < record.count {
        say(&format!("interrupted: {} scenes were finished and are kept in {}", record.drawn, out.display()));
        return Err(Failure::Interrupted);
    }
    let mut names: Vec<&str> = record.violations.iter().map(|violation| violation.statement.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    match names.is_empty() {
        true => Ok(()),
        false => Err(Failure::InvariantsViolated { count: record.violations.len(), names: names.join(", ") }),
    }
}

/// The cases of a tier, or all of them.
fn list(library: &Library, tier: Option<Tier>) -> Result<(), Failure> {
    let mut text = String::new();
    for case in library.cases.iter().filter(|case| tier.is_none_or(|tier| case.file.tier <= tier)) {
        text.push_str(&format!("{:32} {:6} {}\n", case.name, case.file.tier.name(), case.file.requirement));
    }
    print(&text)
}

/// The record of an earlier run.
fn read_earlier(path: &Path) -> Result<ValidationRecord, InputError> {
    let name = path.display().to_string();
    let text = VALIDATION_RECORD
        .read_to_string(path)
        .map_err(|reason| InputError::Unreadable { name: name.clone(), reason })?;
    serde_json::from_str(&text).map_err(|error| InputError::NoValidationRecord {
        name,
        line: error.line(),
        reason: error.to_string(),
    })
}
