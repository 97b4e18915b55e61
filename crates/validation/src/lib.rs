//! The validation suite: every claim of the program compared with its reference, with its cost.
//!
//! A case is a folder of data with a file `case.toml` ([`case_file`]); adding one adds no code. [`library`] finds cases, built in or
//! on disk; [`schedule`] hands their runs to the threads; [`execution`] carries each out and reads it back
//! under the names of its output files (and, of each flank, `snapshot_wear_um[row of the history]` and `path_point_radius_mm.A` to
//! `.E`); [`judge`] holds quantities, which are expressions over those names ([`expression`]), against
//! references and bounds; [`drawing`] evaluates plots. The result is a plain record that reports are written from.
#![allow(
    rustdoc::private_intra_doc_links,
    reason = "the documentation is read by those who work on it, private items with it"
)]
#![allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]

pub mod against;
pub mod case_file;
mod check;
pub mod column;
mod data_file;
pub mod drawing;
pub mod execution;
pub mod expression;
mod family;
pub mod found;
pub mod invariants;
pub mod judge;
pub mod library;
mod members;
pub mod profile;
pub mod record;
pub mod report;
pub mod schedule;
pub mod soundness;
pub mod syntax;
mod value;

use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

use crate::record::{CaseRecord, CaseRun, RunOutcome, Tier, ValidationRecord, written};
use expression::Evaluator;
use gearwear_physics::observer::Observer;
use library::ValidationCase;
use schedule::Members;

/// Carries out the cases of `tier` (all of them where there is none) on `threads` threads.
pub fn run(cases: &[ValidationCase], tier: Option<Tier>, threads: usize, observer: &dyn Observer) -> ValidationRecord {
    let start = Instant::now();
    let chosen: Vec<&ValidationCase> =
        cases.iter().filter(|case| tier.is_none_or(|tier| case.file.tier <= tier)).collect();
    let executed = schedule::carry_out(&chosen, threads, observer);
    let (finished, left_out): (Vec<_>, Vec<_>) = chosen
        .iter()
        .zip(&executed)
        .partition(|(_, runs)| runs.iter().all(|run| run.executed.iter().all(Option::is_some)));
    let mut cases: Vec<CaseRecord> = finished.into_iter().map(|(case, runs)| record(case, runs)).collect();
    cases.sort_by(|a, b| (&a.group, &a.name).cmp(&(&b.group, &b.name)));
    ValidationRecord {
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        tier,
        threads,
        not_run: left_out.into_iter().map(|(case, _)| case.name.clone()).collect(),
        cases,
        wall_s: start.elapsed().as_secs_f64(),
    }
}

/// Record of a case with everything judged.
fn record(case: &ValidationCase, runs: &[Members]) -> CaseRecord {
    let file = &case.file;
    let runs_of_case: Vec<CaseRun> = file.run.iter().zip(runs).map(|(spec, family)| of_run(spec, family)).collect();
    let mut record = CaseRecord {
        name: case.name.clone(),
        title: file.title.clone(),
        group: file.group.clone(),
        targets: file.targets.clone(),
        requirement: file.requirement.clone(),
        kind: file.kind,
        tier: file.tier,
        says: file.says.clone(),
        rests_on: file.rests_on.clone(),
        wall_s: runs_of_case.iter().map(|run| run.wall_s).sum(),
        work: together(runs_of_case.iter().map(|run| &run.work)),
        runs: runs_of_case,
        quantities: file.run.iter().zip(runs).map(|(spec, family)| judge::endings(&spec.name, family)).collect(),
        ..CaseRecord::default()
    };
    record.failure = fill(&mut record, case, runs).err().map(|error| error.to_string());
    record
}

/// Judges the quantities of a case and makes its plots.
fn fill(record: &mut CaseRecord, case: &ValidationCase, runs: &[Members]) -> Result<(), Box<dyn Error>> {
    let file = &case.file;
    let by_name: BTreeMap<&str, &Members> = file.run.iter().map(|spec| spec.name.as_str()).zip(runs).collect();
    // Outcomes come first, so that a failed case has them.
    for spec in &file.stability {
        if let Some(family) = by_name.get(spec.family.as_str()) {
            record.stability.extend(drawing::stability(spec, family)?);
        }
    }
    let mut e = Evaluator::default();
    let mut absent = BTreeMap::new();
    for spec in &file.data {
        match data_file::read(spec, &case.folder)? {
            Some(columns) => e.name(&spec.name, &columns),
            None => {
                absent.insert(spec.name.as_str(), spec.missing.as_deref().unwrap_or_default());
            }
        }
    }
    let (families, single): (Vec<_>, Vec<_>) = file.run.iter().zip(runs).partition(|(spec, _)| spec.is_family());
    for (spec, members) in single {
        if let [Some(executed)] = members.executed.as_slice() {
            e.name(&spec.name, &executed.as_value());
        }
    }
    for (spec, members) in families {
        let columns = family::columns(members, &spec.take, &mut e)?;
        e.name(&spec.name, &columns);
    }
    for definition in &file.define {
        let value = e.value(&definition.value)?;
        e.name(&definition.name, &value);
    }
    for spec in &file.quantity {
        let judged = judge::judge(spec, &absent, &mut e);
        record.quantities.push(judged.map_err(|error| format!("{}: {error}", spec.name))?);
    }
    for spec in &file.work_precision {
        if let Some(family) = by_name.get(spec.family.as_str()) {
            record.work_precision.extend(drawing::work_precision(spec, family, &mut e)?);
        }
    }
    for spec in &file.plot {
        record.plots.push(drawing::plot(spec, &absent, &by_name, &mut e)?);
    }
    Ok(())
}

fn of_run(spec: &case_file::RunSpec, family: &Members) -> CaseRun {
    let executed: Vec<_> = family.executed.iter().flatten().collect();
    let mut outcomes: BTreeMap<RunOutcome, usize> = BTreeMap::new();
    for run in &executed {
        *outcomes.entry(run.outcome).or_default() += 1;
    }
    CaseRun {
        name: spec.name.clone(),
        command: written(spec.command),
        members: executed.len(),
        outcomes,
        wall_s: executed.iter().map(|run| run.wall_s).sum(),
        work: together(executed.iter().map(|run| &run.work)),
    }
}

/// Work counts, added by their names.
fn together<'a>(counts: impl Iterator<Item = &'a BTreeMap<String, u64>>) -> BTreeMap<String, u64> {
    let mut all = BTreeMap::new();
    for (name, count) in counts.flatten() {
        *all.entry(name.clone()).or_insert(0) += count;
    }
    all
}
