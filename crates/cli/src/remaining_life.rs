//! `gearwear compare RUN --history TABLE`: wear coefficient and remaining life by measurements at several times.

use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;

use gearwear::report::{self, output_files};
use gearwear::scene::loaded::SceneText;
use gearwear_studies::compare::study::CompareError;
use gearwear_studies::remaining_life::asked::{LifeError, LifeFault, LifeOptions, PreparedLife};
use gearwear_studies::remaining_life::other_gear::{CoefficientSource, comparisons_in};
use gearwear_studies::remaining_life::record::{GearLife, INTERVAL_OF_K, Interval, LifeRecord, LifeUpdate};
use gearwear_studies::remaining_life::wear_curve::WearCurveError;

use super::failure::{Failure, InputError};
use super::figures::digits;
use super::progress::Progress;
use super::run::{pool, watch_for_interrupt};
use super::{print, say, warn};

/// Run, table and where the results go.
pub(super) struct LifeQuestion<'a> {
    pub run: &'a Path,
    pub table: &'a Path,
    pub options: LifeOptions,
    pub out: &'a Path,
    pub threads: Option<NonZeroUsize>,
    pub quiet: bool,
}

pub(super) fn run(asked: &LifeQuestion<'_>) -> Result<(), Failure> {
    let table = SceneText::read_foreign(asked.table)?;
    let prepared = PreparedLife::open(asked.run, &table, &asked.options)?;
    report::writable(asked.out)?;
    let pool = pool(asked.threads)?;
    let progress = Progress::new(asked.quiet, Arc::clone(&watch_for_interrupt()));
    let done = pool.install(|| prepared.carry_out(&progress));
    progress.finish();
    let record = done?;
    gearwear_studies::remaining_life::report::write(&record, asked.out)?;
    if !asked.quiet {
        let page = asked.out.join(output_files::PAGE);
        print(&format!("{}report: {}\n", findings(&record, asked.run), page.display()))?;
    }
    warn(&record.warnings);
    Ok(())
}

impl From<LifeFault> for Failure {
    fn from(fault: LifeFault) -> Self {
        match fault {
            LifeFault::Load(error) => error.into(),
            LifeFault::RunFolder(error) => InputError::RunFolder(error).into(),
            LifeFault::Table { .. } => InputError::WearTable(fault.to_string()).into(),
            LifeFault::Pair(error) => Failure::Run(error.into()),
        }
    }
}

impl From<LifeError> for Failure {
    fn from(error: LifeError) -> Self {
        match error {
            LifeError::Curve(WearCurveError::Run(CompareError::Interrupted)) => {
                say("interrupted before the measurements were evaluated");
                Failure::Interrupted
            }
            LifeError::Curve(WearCurveError::Run(CompareError::Run(error))) => Failure::Run(error),
            LifeError::Curve(beyond @ WearCurveError::BeyondRun { .. }) => {
                InputError::WearBeyondRun(beyond.to_string()).into()
            }
            LifeError::Profile { .. } => Failure::NotFitted { why: error.to_string() },
        }
    }
}

/// Findings for the terminal.
fn findings(record: &LifeRecord, run: &Path) -> String {
    let mut text = format!("{}\n", record.headline());
    for of in &record.gears {
        text.push_str(&of_gear(of));
    }
    text.push_str(&format!("\n{INTERVAL_OF_K}\n"));
    if let Some(other) = &record.other_gear {
        text.push_str(&format!("{}\n", other.in_words(&digits(other.coefficient_m2_per_N))));
        if other.source != CoefficientSource::Given {
            for fitted in comparisons_in(run, other.gear, &record.scene_hash) {
                text.push_str(&format!("Fitted k of the {}: --other-k {}\n", other.gear.name(), fitted.display()));
            }
        }
    }
    let runs = if record.runs == 1 { "run" } else { "runs" };
    text.push_str(&format!(
        "\nintervals 95 %; prior and method: docs/compare.md; {} {runs} of the scene ({} mesh cycles)\n",
        record.runs, record.mesh_cycles
    ));
    text
}

fn of_gear(of: &GearLife) -> String {
    let (prior, gear) = (&of.prior, of.gear.name());
    let mut text = format!(
        "\n{gear}: k of the run {} m²/N, before any measurement {} to {}\n",
        digits(of.coefficient_of_run_m2_per_N),
        digits(prior.low_m2_per_N),
        digits(prior.high_m2_per_N)
    );
    let has_speed = of.measurements.iter().all(|one| one.hours.is_some());
    let time = if has_speed { "hours" } else { "revolutions" };
    let mut heads = vec!["after", time, "k, m²/N", "95 % from", "to"];
    if let Some(limit) = &of.limit {
        text.push_str(&format!("{time} left until {} = {}\n", limit.figure, digits(limit.value)));
        heads.extend(["left", "95 % from", "to"]);
    }
    text.push_str(&line(&heads.into_iter().map(str::to_owned).collect::<Vec<_>>()));
    for update in of.updates.iter().skip(1) {
        text.push_str(&line(&cells(update)));
    }
    let Some((last, life)) = of.updates.last().and_then(|last| Some((last, last.life?))) else { return text };
    let (at, left, total) = match (last.hours, life.remaining_hours, life.total_hours) {
        (Some(at), Some(left), Some(total)) => (at, left, total),
        _ => (last.revolutions, life.remaining_revolutions, life.total_revolutions),
    };
    text.push_str(&format!(
        "  life in all: {} {time}, 95 % {}: {} until the last measurement and {} left, 95 % {}\n",
        digits(total.median),
        from_to(total),
        digits(at),
        digits(left.median),
        from_to(left)
    ));
    if life.passed >= 0.025 {
        text.push_str(&format!("  the limit has been passed with a probability of {:.0} %\n", 100.0 * life.passed));
    }
    text
}

/// "152.4 to 255.4".
fn from_to(interval: Interval) -> String {
    format!("{} to {}", digits(interval.low), digits(interval.high))
}

fn cells(update: &LifeUpdate) -> Vec<String> {
    let k = update.coefficient_m2_per_N;
    let time = update.hours.unwrap_or(update.revolutions);
    let mut cells =
        vec![update.measurements.to_string(), digits(time), digits(k.median), digits(k.low), digits(k.high)];
    if let Some(life) = &update.life {
        let left = life.remaining_hours.unwrap_or(life.remaining_revolutions);
        cells.extend([left.median, left.low, left.high].map(digits));
    }
    cells
}

fn line(cells: &[String]) -> String {
    let first = format!("  {:>5}", cells[0]);
    let others: String = cells[1..].iter().map(|cell| format!("{cell:>12}")).collect();
    format!("{first}{others}\n")
}
