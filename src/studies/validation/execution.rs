//! One run of a case, carried out as its command would, and read back as its output files would be.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

use serde::Serialize;

use super::case_file::{Command, RunSpec};
use super::members::Member;
use super::soundness;
use super::value::Value;
use crate::calibration::Calibration;
use crate::gear::Gear;
use crate::observer::Observer;
use crate::pipeline::calibrate::{self, CalibrateError, Extent};
use crate::pipeline::fem_problem::{self, FemProblemError};
use crate::pipeline::fem_scene::{self, FemPairError};
use crate::pipeline::guarded::guarded;
use crate::pipeline::{self, RunError};
use crate::report;
use crate::report::csv_table::{self, Provenance};
use crate::report::slice_table;
use crate::report::tables;
use crate::results::run::StopReason;
use crate::scene::draft::{self, Draft};
use crate::scene::fem_problem::FemProblem;
use crate::scene::loaded::{self, LoadedScene, NamedFiles, SceneText};
use crate::scene::{Problem, Resolved, presets};
use crate::studies::validation::record::RunOutcome;

/// What a run came to.
#[derive(Debug, Clone)]
pub(crate) struct Executed {
    /// How it ended.
    pub outcome: RunOutcome,
    /// What it said, where that is not sound.
    pub said: Option<String>,
    /// What it left behind: a group, empty where nothing was finished.
    pub value: BTreeMap<String, Value>,
    /// The calibration, of a run that makes one.
    pub calibration: Option<Calibration>,
    /// Wall time.
    pub wall_s: f64,
    /// Work by the name of what was counted.
    pub work: BTreeMap<String, u64>,
}

impl Executed {
    /// A run whose calibration was not made.
    pub(crate) fn without_calibration(name: &str) -> Self {
        let said = Some(format!("the calibration of {name:?} was not made"));
        let (value, work) = (BTreeMap::new(), BTreeMap::new());
        Self { outcome: RunOutcome::NotConverged, said, value, calibration: None, wall_s: 0.0, work }
    }

    /// As expressions see it.
    pub(crate) fn as_value(&self) -> Value {
        let mut group = self.value.clone();
        group.insert("outcome".to_owned(), Value::Text(self.outcome.name().to_owned()));
        group.insert("message".to_owned(), Value::Text(self.said.clone().unwrap_or_default()));
        group.insert("wall_s".to_owned(), Value::Number(self.wall_s));
        let work = self.work.iter().map(|(name, &count)| (name.as_str(), Value::Number(count as f64)));
        group.insert("work".to_owned(), Value::group(work));
        Value::Group(group)
    }
}

/// Why a run has nothing to show.
enum Failed {
    /// The input is wrong.
    Refused(String),
    /// The solver says so.
    NotConverged(String),
}

/// What a run left behind, before it is judged.
#[derive(Default)]
struct RunOutput {
    value: BTreeMap<String, Value>,
    fault: Option<String>,
    not_converged: Option<String>,
    calibration: Option<Calibration>,
    work: BTreeMap<String, u64>,
}

/// Carries out one member of `run`, whose files lie in `folder`, with the calibration it names.
pub(crate) fn execute(
    run: &RunSpec,
    member: &Member,
    folder: &Path,
    calibration: Option<&Calibration>,
    watch: &dyn Observer,
) -> Executed {
    let start = Instant::now();
    let work = || match run.command {
        Command::Run => wear_run(run, member, folder, calibration, watch),
        Command::Fem => finite_elements(run, member, folder, watch),
        Command::Calibrate => calibrated(run, member, folder, watch),
    };
    let done = guarded(work);
    let wall_s = start.elapsed().as_secs_f64();
    let nothing = |outcome, said: String| (outcome, Some(said), RunOutput::default());
    let (outcome, said, found) = match done {
        Err(said) => nothing(RunOutcome::Panicked, said),
        Ok(Err(Failed::Refused(said))) => nothing(RunOutcome::Refused, said),
        Ok(Err(Failed::NotConverged(said))) => nothing(RunOutcome::NotConverged, said),
        Ok(Ok(found)) => match (&found.not_converged, &found.fault) {
            (Some(said), _) => (RunOutcome::NotConverged, Some(said.clone()), found),
            (None, Some(said)) => (RunOutcome::Unsound, Some(said.clone()), found),
            (None, None) => (RunOutcome::Sound, None, found),
        },
    };
    Executed { outcome, said, value: found.value, calibration: found.calibration, wall_s, work: found.work }
}

fn refused(problems: Vec<Problem>) -> Failed {
    Failed::Refused(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))
}

/// The text of the scene: a preset, or a file of the case.
fn text(run: &RunSpec, folder: &Path) -> Result<String, Failed> {
    match presets::find(&run.scene) {
        Some(preset) => Ok(preset.text.to_owned()),
        None => fs::read_to_string(folder.join(&run.scene)).map_err(|reason| {
            Failed::Refused(format!("{}: neither a preset nor a file that can be read: {reason}", run.scene))
        }),
    }
}

/// The scene of a member.
fn scene(run: &RunSpec, member: &Member, folder: &Path) -> Result<Resolved, Failed> {
    resolved(draft(run, member, folder)?, member)
}

/// The scene of a member with the files it names, which lie in `folder`, and with `calibration`, where the run names one.
fn loaded_scene(
    run: &RunSpec,
    member: &Member,
    folder: &Path,
    calibration: Option<&Calibration>,
) -> Result<LoadedScene, Failed> {
    let mut draft = draft(run, member, folder)?;
    let refused = |error: &dyn Display| Failed::Refused(error.to_string());
    let given = SceneText { name: run.scene.clone(), text: draft.to_toml() };
    let Some(calibration) = calibration else {
        return LoadedScene::of(resolved(draft, member)?, given, folder).map_err(|error| refused(&error));
    };
    draft.set(loaded::CALIBRATION, "calibration.json");
    let files = NamedFiles { calibration: Some(calibration.clone()), ..NamedFiles::default() };
    LoadedScene::with_files(resolved(draft, member)?, given, files).map_err(|error| refused(&error))
}

/// The scene file of a member.
fn draft(run: &RunSpec, member: &Member, folder: &Path) -> Result<Draft, Failed> {
    let mut draft = Draft::parse(&text(run, folder)?).map_err(refused)?;
    for key in &member.unset {
        draft.remove(key);
    }
    for (key, value) in &member.set {
        draft.set(key, value.clone());
    }
    Ok(draft)
}

fn resolved(draft: Draft, member: &Member) -> Result<Resolved, Failed> {
    let mut resolved = draft.resolve().map_err(refused)?;
    // A case holds a run against a reference of its own; one that is about verification asks for it.
    resolved.scene.verify &= member.set.iter().any(|(key, _)| key == "numerics.verify");
    Ok(resolved)
}

/// The tree of anything that can be written as JSON.
fn tree(summary: &impl Serialize) -> Result<Value, Failed> {
    let json = serde_json::to_value(summary).map_err(|error| Failed::NotConverged(error.to_string()))?;
    Ok(Value::of_json(json))
}

/// Whole numbers of a group, as counts of work.
fn counts(value: &Value) -> BTreeMap<String, u64> {
    let Value::Group(entries) = value else { return BTreeMap::new() };
    let count = |(name, value): (&String, &Value)| match value {
        Value::Number(number) if *number >= 0.0 => Some((name.clone(), *number as u64)),
        _ => None,
    };
    entries.iter().filter_map(count).collect()
}

/// The table that `write` writes.
fn table(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Value, Failed> {
    let mut bytes = Vec::new();
    write(&mut bytes).map_err(|error| Failed::NotConverged(error.to_string()))?;
    Value::of_csv(&bytes).map_err(|error| Failed::NotConverged(error.to_string()))
}

/// The wear at each row of the history, a column a row: `profiles.csv` of one gear.
fn snapshots(wear_um: &[Vec<f64>]) -> Value {
    Value::List(wear_um.iter().map(|profile| Value::column(profile.iter().copied())).collect())
}

fn of_stop(stop: StopReason) -> Option<String> {
    match stop {
        StopReason::Completed => None,
        StopReason::Interrupted => Some("interrupted".to_owned()),
        StopReason::NotConverged => Some("the run did not converge".to_owned()),
    }
}

fn wear_run(
    run: &RunSpec,
    member: &Member,
    folder: &Path,
    calibration: Option<&Calibration>,
    watch: &dyn Observer,
) -> Result<RunOutput, Failed> {
    let scene = loaded_scene(run, member, folder, calibration)?;
    let done = pipeline::run(&scene, watch).map_err(|error| match &error {
        RunError::Pair(_) | RunError::Stiffness(_) | RunError::FiniteElements(_) => Failed::Refused(error.to_string()),
        _ => Failed::NotConverged(error.to_string()),
    })?;
    let record = done.record;
    let provenance = Provenance::of_scene(&record.summary.program_version, &record.summary.scene_hash);
    let summary = tree(&record.summary)?;
    let work = tree(&record.summary.work)?;
    let mut value = BTreeMap::from([
        ("summary".to_owned(), summary),
        ("history".to_owned(), table(|out| csv_table::table(out, provenance, &record.history))?),
        ("mesh_cycle".to_owned(), table(|out| csv_table::table(out, provenance, &record.mesh_cycle))?),
    ]);
    for gear in Gear::BOTH {
        let flank = &record.flanks[gear];
        let mut columns = table(|out| tables::flank(out, provenance, flank))?;
        columns.add("path_point_radius_mm", tree(&flank.path_point_radius_mm)?);
        columns.add("snapshot_wear_um", snapshots(&flank.snapshot_wear_um));
        value.insert(gear.name().to_owned(), columns);
    }
    if let Some(slices) = &record.slices {
        let path = &record.summary.geometry.curvature_radius_mm;
        value.insert("slices".to_owned(), table(|out| slice_table::slices(out, provenance, slices, path))?);
    }
    Ok(RunOutput {
        value,
        fault: soundness::fault(&record),
        not_converged: done.failure.map(|failure| failure.to_string()).or_else(|| of_stop(record.summary.stopped)),
        calibration: None,
        work: counts(&work),
    })
}

fn finite_elements(run: &RunSpec, member: &Member, folder: &Path, watch: &dyn Observer) -> Result<RunOutput, Failed> {
    let given = text(run, folder)?;
    let mut file: toml::Table = given.parse().map_err(|error: toml::de::Error| Failed::Refused(error.to_string()))?;
    if file.contains_key("pair") {
        return finite_element_pair(run, member, folder, watch);
    }
    for (key, value) in &member.set {
        draft::set(&mut file, key, value.clone());
    }
    let problem = FemProblem::from_toml(&file.to_string()).map_err(refused)?;
    let record = fem_problem::run(&problem, folder, watch).map_err(|error| match error {
        FemProblemError::Input(problems) => refused(problems),
        FemProblemError::Solve(error) => Failed::NotConverged(error.to_string()),
    })?;
    let provenance = Provenance::of_problem(&record.summary.program_version, &record.summary.problem_hash);
    let contact = table(|out| report::fem::contact_table(out, provenance, &record.contacts))?;
    let work = counts(&tree(&record.summary.work)?);
    Ok(RunOutput {
        value: BTreeMap::from([("summary".to_owned(), tree(&record.summary)?), ("contact".to_owned(), contact)]),
        work,
        ..RunOutput::default()
    })
}

fn finite_element_pair(
    run: &RunSpec,
    member: &Member,
    folder: &Path,
    watch: &dyn Observer,
) -> Result<RunOutput, Failed> {
    let resolved = scene(run, member, folder)?;
    let asked = fem_scene::Asked { position_mm: run.position_mm, full: run.full };
    let done = fem_scene::run(&resolved, asked, watch).map_err(|error| match &error {
        FemPairError::Position { .. }
        | FemPairError::Pair(_)
        | FemPairError::Quality { .. }
        | FemPairError::Model(_) => Failed::Refused(error.to_string()),
        _ => Failed::NotConverged(error.to_string()),
    })?;
    let record = done.record;
    let provenance = Provenance::of_scene(&record.summary.program_version, &record.summary.scene_hash);
    let mesh_cycle = table(|out| csv_table::table(out, provenance, &record.mesh_cycle))?;
    let pressure = table(|out| report::fem_pair::pressure_table::pressure(out, provenance, &record.pressure))?;
    let work = [("iterations", record.summary.iterations as u64), ("positions", record.summary.positions as u64)];
    Ok(RunOutput {
        value: BTreeMap::from([
            ("summary".to_owned(), tree(&record.summary)?),
            ("mesh_cycle".to_owned(), mesh_cycle),
            ("pressure".to_owned(), pressure),
        ]),
        not_converged: done.failure.map(|failure| failure.to_string()).or_else(|| of_stop(record.summary.stopped)),
        work: work.map(|(name, count)| (name.to_owned(), count)).into(),
        ..RunOutput::default()
    })
}

fn calibrated(run: &RunSpec, member: &Member, folder: &Path, watch: &dyn Observer) -> Result<RunOutput, Failed> {
    let resolved = scene(run, member, folder)?;
    let extent = if run.full { Extent::Whole } else { Extent::FastModel };
    let done = calibrate::run(&resolved.scene, extent, watch).map_err(|error| match &error {
        CalibrateError::Pair(_) => Failed::Refused(error.to_string()),
        _ => Failed::NotConverged(error.to_string()),
    })?;
    let calibration = done.calibration;
    let positions = (calibration.deflection.len() + calibration.single_contact.len()) as u64;
    Ok(RunOutput {
        value: BTreeMap::from([("calibration".to_owned(), tree(&calibration)?)]),
        work: BTreeMap::from([("loaded positions".to_owned(), positions)]),
        calibration: Some(calibration),
        ..RunOutput::default()
    })
}
