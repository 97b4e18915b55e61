//! `gearwear run` of a planetary stage: both meshes one after the other, then the stage.

use std::path::Path;
use std::sync::Arc;

use gearwear::planetary_run::record::{PlanetaryRecord, PlanetarySummary};
use gearwear::planetary_run::{self, PlanetaryRunError};
use gearwear::report::output_files;
use gearwear::resume::kept_run::KeptRunError;
use gearwear::scene::blame::SceneFault;
use gearwear::scene::planetary::PlanetaryScene;
use gearwear::scene::planetary::mesh::StageMesh;
use gearwear_physics::assessment::Done;
use gearwear_physics::results::invariant::Invariant;
use gearwear_physics::results::run::{StopReason, WearSummary};

use super::failure::{Failure, InputError};
use super::figures::digits;
use super::progress::Progress;
use super::run::{RunArgs, pool, watch_for_interrupt};
use super::{print, say, warn};

/// Room for the name of a row.
const NAME: usize = 36;
/// Room for a column.
const COLUMN: usize = 16;

/// Runs `scene` in the folder `out`, from what lies there where it `goes_on`.
pub(super) fn run(scene: &PlanetaryScene, out: &Path, goes_on: bool, args: &RunArgs) -> Result<(), Failure> {
    warn(&scene.warnings);
    let pool = pool(args.threads)?;
    let interrupted = watch_for_interrupt();
    let progress = Progress::new(args.quiet, Arc::clone(&interrupted));
    let done = pool.install(|| planetary_run::run_kept(scene, out, &args.files(), goes_on, &progress));
    progress.finish();
    let Done { record, failure } = done.map_err(|error| failure_of(error, scene))?;
    warn(&progress.not_yet_told(&new_warnings(scene, &record)));
    if !args.quiet {
        let shown = if args.no_report { out.to_owned() } else { out.join(output_files::PAGE) };
        print(&format!("{}\nreport: {}\n", table(&record.summary), shown.display()))?;
    }
    if let Some(failure) = failure {
        return Err(failure_of(failure, scene));
    }
    if record.summary.stopped == StopReason::Interrupted {
        say(&format!("interrupted; gearwear run --resume {} continues it", out.display()));
        return Err(Failure::Interrupted);
    }
    let runs = record.summary.meshes.both().into_iter().flatten();
    let violations: Vec<String> =
        runs.flat_map(|summary| summary.invariants.iter().filter_map(Invariant::violation)).collect();
    if violations.is_empty() { Ok(()) } else { Err(Failure::Violated { violations }) }
}

/// Warnings that the runs add to those of the scene.
fn new_warnings(scene: &PlanetaryScene, record: &PlanetaryRecord) -> Vec<String> {
    record.summary.warnings.iter().filter(|warning| !scene.warnings.contains(warning)).cloned().collect()
}

/// Failure of a mesh, at its place in the file of the stage where it is one of the scene.
fn failure_of(error: PlanetaryRunError, scene: &PlanetaryScene) -> Failure {
    let (mesh, source) = match error {
        PlanetaryRunError::Mesh { mesh, source } => (mesh, source),
        PlanetaryRunError::Report(error) => return error.into(),
    };
    match source {
        KeptRunError::Folder(error) => InputError::Resume(Box::new(error)).into(),
        KeptRunError::NothingLeft { folder } => InputError::NothingLeft { folder }.into(),
        KeptRunError::Result(error) => InputError::Result(Box::new(error)).into(),
        KeptRunError::Report(error) => error.into(),
        KeptRunError::Run(error) => match error.in_the_scene(&scene.meshes[mesh].given) {
            Some(of_mesh) => Failure::Scene(scene.told_of_stage(mesh, of_mesh.problems)),
            None => Failure::Run(error),
        },
    }
}

fn row(name: &str, values: [String; 4]) -> String {
    let values: String = values.iter().map(|value| format!("{value:>COLUMN$}")).collect();
    format!("{}\n", format!("  {name:NAME$}{values}").trim_end())
}

/// Main figures.
fn table(s: &PlanetarySummary) -> String {
    let flanks = [s.sun.as_ref(), s.planet.sun_flank.as_ref(), s.planet.ring_flank.as_ref(), s.ring.as_ref()];
    let known = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), digits);
    let of = |value: fn(&WearSummary) -> f64| flanks.map(|wear| known(wear.map(value)));
    let names = ["sun", "planet (sun)", "planet (ring)", "ring"].map(str::to_owned);
    let mut text = format!("{}\n\n{}", s.title, row("", names));
    text.push_str(&row("maximum wear, µm", of(|wear| wear.peak_wear_um)));
    let error = |mesh: StageMesh| {
        let total = s.mesh(mesh).map(|summary| &summary.error.total.peak_wear);
        let both = total.map_or([None; 2], |total| [total.pinion, total.wheel]);
        both.map(|error| error.map_or_else(|| "–".to_owned(), |error| format!("± {}", digits(100.0 * error))))
    };
    let [[sun, planet], [of_ring, ring]] = StageMesh::BOTH.map(error);
    text.push_str(&row("  error of the computation, %", [sun, planet, of_ring, ring]));
    text.push_str(&row("worn mass, mg", of(|wear| wear.worn_mass_mg)));
    text.push_str(&row("", ["sun-planet", "planet-ring", "stage", ""].map(str::to_owned)));
    for (name, is_worn) in [("transmission error new, µm p-p", false), ("transmission error worn, µm p-p", true)] {
        let of_mesh = |mesh: StageMesh| {
            let summary = s.mesh(mesh)?;
            let cycle = if is_worn { &summary.worn } else { &summary.new };
            Some(cycle.transmission_error_um.peak_to_peak)
        };
        let of_stage = if is_worn { &s.transmission_error.worn } else { &s.transmission_error.new };
        let [sun, ring] = StageMesh::BOTH.map(|mesh| known(of_mesh(mesh)));
        text.push_str(&row(name, [sun, ring, known(of_stage.as_ref().map(|range| range.peak_to_peak)), String::new()]));
    }
    for (name, is_worn) in [("flank pressure new, MPa", false), ("flank pressure worn, MPa", true)] {
        let of_mesh = |mesh: StageMesh| {
            let summary = s.mesh(mesh)?;
            Some(if is_worn { summary.worn.flank_pressure_MPa } else { summary.new.flank_pressure_MPa })
        };
        let [sun, ring] = StageMesh::BOTH.map(|mesh| known(of_mesh(mesh)));
        text.push_str(&row(name, [sun, ring, String::new(), String::new()]));
    }
    let hours = s.hours.map_or_else(String::new, |hours| format!(" ({} h)", digits(hours)));
    text.push_str(&format!(
        "\n{} revolutions of the {}{hours}, computed in {:.2} s\n",
        digits(s.revolutions),
        s.planetary.member,
        s.wall_s
    ));
    text
}
