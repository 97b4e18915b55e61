//! One run of a case: done as by its command, and read as from its output files.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

use serde::Serialize;

use super::case_file::{CaseCommand, RunSpec};
use super::library::MOST;
use super::members::Member;
use super::soundness;
use super::value::Value;
use crate::invariants::study::{self, SceneRange};
use crate::record::RunOutcome;
use gearwear::fem_problem::{self, FemProblemError};
use gearwear::report;
use gearwear::report::csv_table::{self, Column};
use gearwear::report::slice_table;
use gearwear::report::tables;
use gearwear::runs;
use gearwear::scene::draft::Draft;
use gearwear::scene::fem_problem::FemProblem;
use gearwear::scene::loaded::{self, LoadedScene, NamedFiles, SceneText};
use gearwear::scene::table;
use gearwear::scene::{Problem, Resolved, presets};
use gearwear::varied_scene::in_words;
use gearwear_bodies::gear::Gear;
use gearwear_physics::assessment::RunError;
use gearwear_physics::assessment::calibrate::{self, CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::fem_scene::{self, FemPairError};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::StopReason;

/// Result of a run.
#[derive(Debug, Clone)]
pub struct Executed {
    pub outcome: RunOutcome,
    /// Message of the program, or the reason why the run is not sound.
    pub said: Option<String>,
    /// Results as a group, empty where nothing was finished.
    pub value: Value,
    /// The calibration, of a run that makes one.
    pub calibration: Option<Calibration>,
    pub wall_s: f64,
    /// Work by the name of what was counted.
    pub work: BTreeMap<String, u64>,
}

impl Executed {
    /// Run with results, and the reason where it did not complete or is not sound.
    fn of(value: Value, work: BTreeMap<String, u64>, failure: Option<Failed>, fault: Option<String>) -> Self {
        let fault = fault.map(|fault| Failed(RunOutcome::Unsound, fault));
        let (outcome, said) = match failure.or(fault) {
            Some(Failed(outcome, said)) => (outcome, Some(said)),
            None => (RunOutcome::Sound, None),
        };
        Self { outcome, said, value, calibration: None, wall_s: 0.0, work }
    }

    /// Run without results.
    fn without_result(outcome: RunOutcome, said: String) -> Self {
        let value = Value::group::<&str>([]);
        Self { outcome, said: Some(said), value, calibration: None, wall_s: 0.0, work: BTreeMap::new() }
    }

    /// Value for expressions.
    pub fn as_value(&self) -> Value {
        let mut group = self.value.clone();
        group.add("outcome", Value::Text(self.outcome.name()));
        group.add("message", Value::Text(self.said.clone().unwrap_or_default()));
        group.add("wall_s", Value::Number(self.wall_s));
        let work = self.work.iter().map(|(name, &count)| (name.as_str(), Value::Number(count as f64)));
        group.add("work", Value::group(work));
        group
    }
}

/// Outcome of a run without results, and its message.
struct Failed(RunOutcome, String);

/// Refusal of the input.
fn refused(error: impl ToString) -> Failed {
    Failed(RunOutcome::Refused, error.to_string())
}

/// Failure of the solver.
fn not_converged(error: impl ToString) -> Failed {
    Failed(RunOutcome::NotConverged, error.to_string())
}

fn wrong(problems: Vec<Problem>) -> Failed {
    refused(in_words(&problems))
}

/// One member of a run to carry out.
pub struct MemberRun<'a> {
    pub run: &'a RunSpec,
    pub member: &'a Member,
    /// Folder of the case.
    pub folder: &'a Path,
    /// The calibration that the run names, where it was made.
    pub calibration: Option<&'a Calibration>,
    pub watch: &'a dyn Observer,
}

impl MemberRun<'_> {
    pub fn execute(&self) -> Executed {
        if let (Some(name), None) = (&self.run.calibration, self.calibration) {
            let said = format!("the calibration of {name:?} was not made");
            return Executed::without_result(RunOutcome::NotConverged, said);
        }
        let start = Instant::now();
        let done = guarded(|| match self.run.command {
            CaseCommand::Run => self.wear_run(),
            CaseCommand::Fem => self.finite_elements(),
            CaseCommand::Calibrate => self.calibrated(),
            CaseCommand::Invariants => self.random_scenes(),
        });
        let executed = match done {
            Err(said) => Executed::without_result(RunOutcome::Panicked, said),
            Ok(Err(Failed(outcome, said))) => Executed::without_result(outcome, said),
            Ok(Ok(executed)) => executed,
        };
        Executed { wall_s: start.elapsed().as_secs_f64(), ..executed }
    }

    /// The text of the scene: a preset, or a file of the case.
    fn text(&self) -> Result<String, Failed> {
        let name = &self.run.scene;
        match presets::find(name) {
            Some(preset) => Ok(preset.text.to_owned()),
            None => MOST
                .read_to_string(&self.folder.join(name))
                .map_err(|reason| refused(format!("{name}: neither a preset nor a file that can be read: {reason}"))),
        }
    }

    /// The scene file, with the member's keys exchanged.
    fn draft(&self) -> Result<Draft, Failed> {
        let mut draft = Draft::parse(&self.text()?).map_err(wrong)?;
        for key in &self.member.unset {
            draft.remove(key);
        }
        for (key, value) in &self.member.set {
            draft.set(key, value.clone());
        }
        Ok(draft)
    }

    fn resolved(&self, draft: Draft) -> Result<Resolved, Failed> {
        let mut resolved = draft.resolve().map_err(wrong)?;
        // Cases have references of their own: a run is verified only where the case sets `verify`.
        resolved.scene.verify &= self.member.set.iter().any(|(key, _)| key == "numerics.verify");
        Ok(resolved)
    }

    /// The scene with the files it names, and with the calibration, where the run names one.
    fn loaded_scene(&self) -> Result<LoadedScene, Failed> {
        let mut draft = self.draft()?;
        let given = SceneText { name: self.run.scene.clone(), text: draft.to_toml() };
        let Some(calibration) = self.calibration else {
            return LoadedScene::of(self.resolved(draft)?, given, self.folder).map_err(refused);
        };
        draft.set(loaded::CALIBRATION, "calibration.json");
        let files = NamedFiles { calibration: Some(calibration.clone()), ..NamedFiles::default() };
        LoadedScene::with_files(self.resolved(draft)?, given, files).map_err(refused)
    }

    fn wear_run(&self) -> Result<Executed, Failed> {
        let scene = self.loaded_scene()?;
        let done = runs::run(&scene, self.watch).map_err(|error| match &error {
            RunError::Pair(_) | RunError::Stiffness(_) | RunError::FiniteElements(_) => refused(error),
            _ => not_converged(error),
        })?;
        let record = done.record;
        let mut value = Value::group([
            ("summary", tree(&record.summary)?),
            ("history", table(|out| csv_table::table(out, &record.history))?),
            ("mesh_cycle", table(|out| csv_table::table(out, &record.mesh_cycle))?),
        ]);
        for gear in Gear::BOTH {
            let flank = &record.flanks[gear];
            let mut columns = table(|out| csv_table::table(out, tables::flank(flank)))?;
            columns.add("path_point_radius_mm", tree(&flank.path_point_radius_mm)?);
            // The wear at each row of the history, a column a row: `profiles.csv` of one gear.
            let snapshots = flank.snapshot_wear_um.iter().map(|profile| Value::column(profile.iter().copied()));
            columns.add("snapshot_wear_um", Value::List(snapshots.collect()));
            value.add(gear.name(), columns);
        }
        if !record.film.is_empty() {
            value.add("film", table(|out| csv_table::table(out, &record.film))?);
        }
        if let Some(slices) = &record.slices {
            let path = &record.summary.geometry.curvature_radius_mm;
            value.add("slices", table(|out| csv_table::table(out, slice_table::rows(slices, path)))?);
        }
        let work = counts(&tree(&record.summary.work)?);
        let failure = failure(done.failure, record.summary.stopped);
        Ok(Executed::of(value, work, failure, soundness::fault(&record)))
    }

    fn finite_elements(&self) -> Result<Executed, Failed> {
        let mut file: toml::Table = self.text()?.parse().map_err(|error: toml::de::Error| refused(error))?;
        if file.contains_key("pair") {
            return self.finite_element_pair();
        }
        for (key, value) in &self.member.set {
            table::set(&mut file, key, value.clone());
        }
        let problem = FemProblem::from_toml(&file.to_string()).map_err(wrong)?;
        let record = fem_problem::run(&problem, self.folder, self.watch).map_err(|error| match error {
            FemProblemError::Input(problems) => wrong(problems),
            FemProblemError::Memory(said) => not_converged(said),
            FemProblemError::Solve(error) => not_converged(error),
        })?;
        let contact = table(|out| report::fem::contact_table(out, record.contacts()))?;
        let value = Value::group([("summary", tree(&record.summary)?), ("contact", contact)]);
        Ok(Executed::of(value, counts(&tree(&record.summary.work)?), None, None))
    }

    fn finite_element_pair(&self) -> Result<Executed, Failed> {
        let resolved = self.resolved(self.draft()?)?;
        let asked = fem_scene::FemPairRequest { position_mm: self.run.position_mm, full: self.run.full };
        let done = runs::fem_pair(&resolved, asked, self.watch).map_err(|error| match &error {
            FemPairError::Position { .. }
            | FemPairError::Pair(_)
            | FemPairError::Quality { .. }
            | FemPairError::Model(_) => refused(error),
            _ => not_converged(error),
        })?;
        let record = done.record;
        let pressure = table(|out| csv_table::table(out, report::fem_pair::pressure_table::rows(&record.pressure)))?;
        let value = Value::group([
            ("summary", tree(&record.summary)?),
            ("mesh_cycle", table(|out| csv_table::table(out, &record.mesh_cycle))?),
            ("pressure", pressure),
        ]);
        let work = [("iterations", record.summary.iterations as u64), ("positions", record.summary.positions as u64)];
        let failure = failure(done.failure, record.summary.stopped);
        Ok(Executed::of(value, work.map(|(name, count)| (name.to_owned(), count)).into(), failure, None))
    }

    /// Random scenes: their record, and a group `statements` with a group for each of them, by its name with `_` for spaces and hyphens.
    fn random_scenes(&self) -> Result<Executed, Failed> {
        let asked = SceneRange {
            seed: self.whole_number("seed")?,
            first: self.whole_number("first")?,
            count: self.whole_number("count")?,
        };
        let record = study::run(asked, 1, self.watch);
        if record.drawn < record.count {
            return Err(not_converged("interrupted"));
        }
        let mut statements = Value::group::<&str>([]);
        for row in &record.statements {
            statements.add(&row.statement.replace([' ', '-'], "_").replace(',', ""), tree(row)?);
        }
        let value = Value::group([("summary", tree(&record)?), ("statements", statements)]);
        let violations = record.violations.iter().map(|violation| {
            format!("scene {} of seed {}, {}: {}", violation.scene, record.seed, violation.statement, violation.figure)
        });
        let said: Vec<String> = violations.take(5).collect();
        let fault = (!said.is_empty()).then(|| said.join("; "));
        let work = BTreeMap::from([("runs".to_owned(), record.runs)]);
        Ok(Executed::of(value, work, None, fault))
    }

    fn whole_number(&self, key: &str) -> Result<u64, Failed> {
        let given = self.member.set.iter().rev().find(|(name, _)| name == key);
        let number = given.and_then(|(_, value)| value.as_integer()).and_then(|number| u64::try_from(number).ok());
        number
            .ok_or_else(|| refused(format!("{key}: allowed in set of a run of invariants: a whole number, 0 or more")))
    }

    fn calibrated(&self) -> Result<Executed, Failed> {
        let resolved = self.resolved(self.draft()?)?;
        let extent = if self.run.full { CalibrationExtent::Whole } else { CalibrationExtent::FastModel };
        let done =
            calibrate::run(&resolved.scene, extent, &Default::default(), self.watch).map_err(|error| match &error {
                CalibrateError::Pair(_) => refused(error),
                _ => not_converged(error),
            })?;
        let calibration = done.calibration;
        let positions = (calibration.deflection.len() + calibration.single_contact.len()) as u64;
        let value = Value::group([("calibration", tree(&calibration)?)]);
        let work = BTreeMap::from([("loaded positions".to_owned(), positions)]);
        Ok(Executed { calibration: Some(calibration), ..Executed::of(value, work, None, None) })
    }
}

/// Value of anything that serialises to JSON.
fn tree(summary: &impl Serialize) -> Result<Value, Failed> {
    serde_json::to_value(summary).map(Value::of_json).map_err(not_converged)
}

/// Numbers of a group as work counts.
fn counts(value: &Value) -> BTreeMap<String, u64> {
    let Value::Group(entries) = value else { return BTreeMap::new() };
    entries
        .iter()
        .filter_map(|(name, value)| match value {
            Value::Number(number) if *number >= 0.0 => Some((name.clone(), *number as u64)),
            _ => None,
        })
        .collect()
}

/// Columns of the table that `write` writes.
fn table(write: impl FnOnce(&mut dyn Write) -> io::Result<Vec<Column>>) -> Result<Value, Failed> {
    let mut bytes = Vec::new();
    write(&mut bytes).map_err(not_converged)?;
    Value::of_csv(&bytes).map_err(not_converged)
}

/// Reason why a run did not converge or was stopped.
fn failure(failure: Option<impl ToString>, stop: StopReason) -> Option<Failed> {
    let (outcome, said) = match stop {
        StopReason::Completed | StopReason::LimitReached => return failure.map(not_converged),
        StopReason::Interrupted => (RunOutcome::NotConverged, "interrupted"),
        StopReason::NotConverged => (RunOutcome::NotConverged, "the run did not converge"),
        StopReason::WornThrough => (RunOutcome::WornThrough, "a tooth is worn through"),
    };
    Some(Failed(outcome, failure.map_or_else(|| said.to_owned(), |failure| failure.to_string())))
}
