//! `gearwear compare RUN RUN …`: finished runs, or scenes that are run first, side by side.

use gearwear::report::output_files;
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use gearwear::report;
use gearwear::runs;
use gearwear::scene::loaded::LoadedScene;
use gearwear_physics::assessment::Done;
use gearwear_physics::results::run::StopReason;
use gearwear_studies::variants;
use gearwear_studies::variants::finished_run::FinishedRun;
use gearwear_studies::variants::record::{VariantRow, VariantsRecord};

use super::failure::{Failure, InputError, in_the_scene};
use super::figures::{digits, or_dash};
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::{print, warn};

/// Most runs side by side.
pub(super) const MOST_RUNS: usize = 6;

/// Runs to compare, and how.
pub(super) struct Variants<'a> {
    /// Folders of runs, or scenes.
    pub runs: Vec<&'a Path>,
    pub out: Option<&'a Path>,
    pub threads: Option<NonZeroUsize>,
    pub quiet: bool,
}

/// Whether something is a run or a scene, and not a measured profile.
pub(super) fn is_run(path: &Path) -> bool {
    path.is_dir() || is_scene(path)
}

fn is_scene(path: &Path) -> bool {
    !path.is_dir() && path.extension().is_some_and(|ending| ending == "toml")
}

pub(super) fn run(asked: &Variants<'_>) -> Result<(), Failure> {
    let names = names(&asked.runs);
    let out = match asked.out {
        Some(out) => out.to_owned(),
        None if is_scene(asked.runs[0]) => return Err(InputError::NoOutForScenes.into()),
        None => asked.runs[0].join("compare").join(&names[1]),
    };
    report::writable(&out)?;
    let progress = Progress::new(asked.quiet, Arc::clone(&watch_for_interrupt()));
    let mut runs = Vec::new();
    for (path, name) in asked.runs.iter().zip(names) {
        let folder = if is_scene(path) {
            run_scene(path, &out.join(&name), asked.threads, &progress)?
        } else {
            path.to_path_buf()
        };
        runs.push(FinishedRun::read(&folder, name).map_err(InputError::RunFolder)?);
    }
    let record = VariantsRecord::new(&runs);
    variants::report::write(&record, &runs, &out)?;
    warn(&record.warnings);
    if !asked.quiet {
        print(&format!("{}report: {}\n", table(&record), out.join(output_files::PAGE).display()))?;
    }
    Ok(())
}

/// Runs a scene into its own folder.
fn run_scene(
    path: &Path,
    folder: &Path,
    threads: Option<NonZeroUsize>,
    progress: &Progress,
) -> Result<PathBuf, Failure> {
    let scene = LoadedScene::open(path)?;
    warn(scene.warnings());
    let done = pool(threads)?.install(|| runs::run(&scene, progress));
    progress.finish();
    let record = done.and_then(Done::complete).map_err(|error| in_the_scene(error, &scene))?;
    gearwear::write(&record, folder)?;
    match record.summary.stopped {
        StopReason::Interrupted => Err(Failure::Interrupted),
        _ => Ok(folder.to_owned()),
    }
}

/// Names of the runs: the shortest last parts of their paths that differ.
fn names(paths: &[&Path]) -> Vec<String> {
    for parts in 1..=4 {
        let names: Vec<String> = paths.iter().map(|path| last_parts(path, parts)).collect();
        let distinct: BTreeSet<&String> = names.iter().filter(|name| !name.is_empty()).collect();
        if distinct.len() == names.len() {
            return names;
        }
    }
    (1..=paths.len()).map(|number| format!("run-{number}")).collect()
}

/// The last `count` parts of a path, joined by hyphens; of a scene without its ending.
fn last_parts(path: &Path, count: usize) -> String {
    let path = if is_scene(path) { path.with_extension("") } else { path.to_owned() };
    let all: Vec<String> = path
        .components()
        .filter(|part| matches!(part, std::path::Component::Normal(_)))
        .map(|part| part.as_os_str().to_string_lossy().into_owned())
        .collect();
    all[all.len().saturating_sub(count)..].join("-")
}

fn line(name: &str, cells: impl Iterator<Item = String>) -> String {
    let cells: String = cells.map(|cell| format!(" {cell:>22}")).collect();
    format!("  {name:57}{cells}\n")
}

fn cell(row: &VariantRow) -> String {
    let (Some(value), Some(difference)) = (row.value, row.difference) else { return or_dash(row.value) };
    let sign = match row.significant {
        Some(true) => "",
        Some(false) => " ≈",
        None => " ?",
    };
    format!("{} ({:+.1} %{sign})", digits(value), 100.0 * difference)
}

/// Findings for the terminal.
fn table(record: &VariantsRecord) -> String {
    let mut text = line("", record.runs.iter().map(|run| run.name.clone()));
    for of_runs in record.figures() {
        text.push_str(&line(&of_runs[0].named(), of_runs.iter().map(cell)));
    }
    text.push_str("\n  ≈ within the errors of both runs together, ? errors not known\n\n");
    format!("{text}{}\n", record.answer.replace(". The", ".\nThe"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_named_by_what_tells_them_apart() {
        for (paths, expected) in [
            (["out/plain", "out/relief"], ["plain", "relief"]),
            (["a/out", "b/out/"], ["a-out", "b-out"]),
            (["plain.toml", "relief.toml"], ["plain", "relief"]),
            (["out", "out"], ["run-1", "run-2"]),
        ] {
            assert_eq!(names(&paths.map(Path::new)), expected);
        }
    }
}
