//! The run of a planetary stage: that of each mesh in a folder of its own, and what follows for the stage.
//!
//! | in the folder of the stage | what |
//! |---|---|
//! | `sun-planet/`, `planet-ring/` | the run of each mesh, as that of a pair |
//! | `transmission_error.csv`, `columns.json` | transmission error of the stage |
//! | `scene.toml` | the file as given, beside copies of the files it names |
//! | `report.html` | the page of the stage |
//! | `summary.json` | [`record::PlanetarySummary`], written last |
//!
//! The meshes run one after the other; an interrupted run goes on in the folder of either.

pub mod folder;
mod observed_mesh;
pub mod record;
mod report;
mod transmission_error;

use std::path::{Component, Path};

use self::observed_mesh::ObservedMesh;
use self::record::{
    KinematicSummary, PerGearOfStage, PerMember, PlanetWear, PlanetaryRecord, PlanetarySummary, StageLife,
    StageTransmissionError, StageTransmissionRow,
};
use crate::report::files::remove;
use crate::report::{self as run_report, ReportError, RunFiles, output_files};
use crate::resume::folder as run_folder;
use crate::resume::kept_run::{self, KeptRunError};
use crate::runs;
use crate::scene::planetary::PlanetaryScene;
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use crate::scene::planetary::words;
use crate::scene::short_hash;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::gear::planetary::Member;
use gearwear_physics::assessment::Done;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::{MeshCycleRow, RunRecord, StopReason, Summary};
use gearwear_physics::results::worn_pair::WornPair;

/// Failure of the run of a stage.
#[derive(Debug, thiserror::Error)]
pub enum PlanetaryRunError {
    /// The run of a mesh failed.
    #[error("{}: {source}", mesh.in_words())]
    Mesh {
        /// The mesh.
        mesh: StageMesh,
        /// Its failure.
        source: KeptRunError,
    },
    /// A file of the stage cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
}

/// Runs the stage in memory.
///
/// # Errors
/// The failure of a mesh of which nothing was finished.
pub fn run(
    scene: &PlanetaryScene,
    observer: &dyn Observer,
) -> Result<Done<PlanetaryRecord, PlanetaryRunError>, PlanetaryRunError> {
    of_meshes(scene, observer, |mesh, observer| Ok(runs::run(&scene.meshes[mesh], observer)?))
}

/// Runs the stage in the folder `dir`, with `files` beside the tables of each mesh. Where `goes_on`, runs of meshes that lie there are continued, or read where
/// they are complete; otherwise they are replaced.
///
/// # Errors
/// The failure of a mesh of which nothing was finished; files that cannot be written.
pub fn run_kept(
    scene: &PlanetaryScene,
    dir: &Path,
    files: &RunFiles,
    goes_on: bool,
    observer: &dyn Observer,
) -> Result<Done<PlanetaryRecord, PlanetaryRunError>, PlanetaryRunError> {
    run_report::writable(dir)?;
    run_report::create_folder(dir)?;
    run_report::remove_summary(dir)?;
    place_inputs(scene, dir)?;
    let done = of_meshes(scene, observer, |mesh, observer| {
        let own = dir.join(mesh.folder());
        if !goes_on {
            run_report::remove_summary(&own)?;
            run_folder::remove_checkpoint(&own)?;
            remove(&own, output_files::SCENE)?;
        }
        kept_run::run_with(&scene.meshes[mesh], &folder::of_mesh(files, mesh), &own, observer)
    })?;
    report::write(&done.record, files, dir)?;
    Ok(done)
}

/// Copies the file and the files it names that lie beside or below it, so that the folder holds what the run needs.
fn place_inputs(scene: &PlanetaryScene, dir: &Path) -> Result<(), ReportError> {
    for mesh in StageMesh::BOTH {
        for file in &scene.meshes[mesh].files.as_read {
            let stays_below = Path::new(&file.name).components().all(|part| matches!(part, Component::Normal(_)));
            if stays_below {
                run_folder::place(dir, &file.name, &file.bytes)?;
            }
        }
    }
    run_folder::place(dir, output_files::SCENE, scene.given.text.as_bytes())
}

/// Runs each mesh with `run`; the second is not begun where the first does not come to its end.
fn of_meshes(
    scene: &PlanetaryScene,
    observer: &dyn Observer,
    run: impl Fn(StageMesh, &dyn Observer) -> Result<Done, KeptRunError>,
) -> Result<Done<PlanetaryRecord, PlanetaryRunError>, PlanetaryRunError> {
    let mut meshes: PerMesh<Option<RunRecord>> = PerMesh::default();
    let mut failure: Option<PlanetaryRunError> = None;
    for mesh in StageMesh::BOTH {
        match run(mesh, &ObservedMesh { observer, mesh }) {
            Ok(Done { record, failure: of_mesh }) => {
                let ended = record.summary.stopped.is_complete();
                meshes[mesh] = Some(record);
                failure = of_mesh.map(|source| PlanetaryRunError::Mesh { mesh, source: KeptRunError::Run(source) });
                if !ended {
                    break;
                }
            }
            Err(source) if mesh == StageMesh::SunPlanet => return Err(PlanetaryRunError::Mesh { mesh, source }),
            Err(source) => failure = Some(PlanetaryRunError::Mesh { mesh, source }),
        }
    }
    Ok(Done { record: record_of(scene, meshes), failure })
}

/// Part of the run of a mesh that the stage is made of.
#[derive(Clone, Copy)]
struct MeshFindings<'a> {
    summary: &'a Summary,
    mesh_cycle: &'a [MeshCycleRow],
}

impl<'a> MeshFindings<'a> {
    fn of(run: &'a RunRecord) -> Self {
        Self { summary: &run.summary, mesh_cycle: &run.mesh_cycle }
    }
}

/// The stage, of the runs of its meshes.
fn record_of(scene: &PlanetaryScene, meshes: PerMesh<Option<RunRecord>>) -> PlanetaryRecord {
    let (summary, transmission_error) = assembled(scene, meshes.as_ref().map(|run| run.as_ref().map(MeshFindings::of)));
    PlanetaryRecord { summary, scene_toml: scene.given.text.clone(), meshes, transmission_error }
}

/// Summary of the stage, of its meshes as a study of many runs keeps them.
pub fn summary(scene: &PlanetaryScene, meshes: PerMesh<&WornPair>) -> PlanetarySummary {
    assembled(scene, meshes.map(|pair| Some(MeshFindings { summary: &pair.summary, mesh_cycle: &pair.mesh_cycle }))).0
}

/// Summary and transmission error of the stage, of the meshes that were run.
fn assembled(
    scene: &PlanetaryScene,
    meshes: PerMesh<Option<MeshFindings<'_>>>,
) -> (PlanetarySummary, Vec<StageTransmissionRow>) {
    let rows = match (meshes.sun_planet, meshes.planet_ring) {
        (Some(sun), Some(ring)) => transmission_error::rows(&scene.stage.phases(), scene.ring_mesh_phase, sun, ring),
        _ => Vec::new(),
    };
    let of_error = StageTransmissionError {
        new: transmission_error::range(&rows, |row| row.stage_new_um),
        worn: transmission_error::range(&rows, |row| row.stage_worn_um),
    };
    (summary_of(scene, meshes.map(|found| found.map(|found| found.summary.clone())), of_error), rows)
}

fn summary_of(
    scene: &PlanetaryScene,
    meshes: PerMesh<Option<Summary>>,
    transmission_error: StageTransmissionError,
) -> PlanetarySummary {
    let run: Vec<&Summary> = meshes.both().into_iter().flatten().collect();
    let ended = |summary: &&&Summary| summary.stopped.is_complete();
    let stopped = match (run.iter().find(|summary| !ended(summary)), run.len()) {
        (Some(broken), _) => broken.stopped,
        (None, 2) if run.iter().any(|summary| summary.stopped == StopReason::LimitReached) => StopReason::LimitReached,
        (None, 2) => StopReason::Completed,
        // The second was not begun.
        (None, _) => StopReason::NotConverged,
    };
    let turns = revolutions_per_turn(scene);
    let reached = |mesh: StageMesh| meshes[mesh].as_ref().map(|summary| summary.revolutions / turns[mesh]);
    let [first, second] = StageMesh::BOTH.map(reached);
    let warnings = StageMesh::BOTH.into_iter().flat_map(|mesh| {
        let warnings = meshes[mesh].as_ref().map(|summary| summary.warnings.clone()).unwrap_or_default();
        warnings.into_iter().map(move |text| format!("{}: {}", mesh.in_words(), words::of_stage(&text, mesh)))
    });
    let wear = |mesh: StageMesh, gear: Gear| {
        let summary = meshes[mesh].as_ref()?;
        Some(if gear == Gear::Pinion { summary.pinion.clone() } else { summary.wheel.clone() })
    };
    let sun_flank = wear(StageMesh::SunPlanet, Gear::Wheel);
    let ring_flank = wear(StageMesh::PlanetRing, Gear::Pinion);
    PlanetarySummary {
        title: scene.title.clone(),
        program_version: run.first().map(|summary| summary.program_version.clone()).unwrap_or_default(),
        scene_hash: short_hash(scene.given.text.as_bytes()),
        stopped,
        hours: run.iter().filter_map(|summary| summary.hours).reduce(f64::max),
        revolutions: first.into_iter().chain(second).fold(0.0, f64::max),
        life: life(scene, &meshes),
        wall_s: run.iter().map(|summary| summary.wall_s).sum(),
        planetary: kinematics(scene),
        sun: wear(StageMesh::SunPlanet, Gear::Pinion),
        planet: PlanetWear {
            worn_mass_mg: sun_flank
                .as_ref()
                .zip(ring_flank.as_ref())
                .map(|(sun, ring)| sun.worn_mass_mg + ring.worn_mass_mg),
            sun_flank,
            ring_flank,
        },
        ring: wear(StageMesh::PlanetRing, Gear::Wheel),
        transmission_error,
        warnings: warnings.collect(),
        meshes,
    }
}

/// Turns of each mesh's pinion on the carrier in one revolution of the given member.
pub fn revolutions_per_turn(scene: &PlanetaryScene) -> PerMesh<f64> {
    let stage = &scene.stage;
    let sun = stage.sun_turns_relative_to_carrier(scene.member).unwrap_or(1.0);
    PerMesh { sun_planet: sun, planet_ring: sun * f64::from(stage.sun_teeth) / f64::from(stage.planet_teeth) }
}

/// The shorter life; `None` without limits.
fn life(scene: &PlanetaryScene, meshes: &PerMesh<Option<Summary>>) -> Option<StageLife> {
    let turns = revolutions_per_turn(scene);
    let lives = StageMesh::BOTH.into_iter().filter_map(|mesh| Some((mesh, meshes[mesh].as_ref()?.life.as_ref()?)));
    let lives: Vec<_> = lives.collect();
    let none = StageLife { mesh: None, gear: None, hours: None, revolutions: None };
    let reached = lives.iter().filter_map(|(mesh, life)| Some((*mesh, *life, life.revolutions? / turns[*mesh])));
    let shortest = reached.min_by(|a, b| a.2.total_cmp(&b.2));
    (!lives.is_empty()).then_some(match shortest {
        None => none,
        Some((mesh, life, revolutions)) => StageLife {
            mesh: Some(mesh.table().to_owned()),
            gear: life.gear.map(|gear| mesh.gears()[gear as usize].to_owned()),
            hours: life.hours,
            revolutions: Some(revolutions),
        },
    })
}

fn kinematics(scene: &PlanetaryScene) -> KinematicSummary {
    let stage = &scene.stage;
    let planets = stage.planets() as f64;
    let ratio = |of| stage.speed(of, scene.member).unwrap_or(0.0);
    let speed_ratio = PerMember { sun: ratio(Member::Sun), carrier: ratio(Member::Carrier), ring: ratio(Member::Ring) };
    let turns = revolutions_per_turn(scene);
    let phases = scene.meshes.sun_planet.scene().operation.phases.iter();
    let greatest = phases.max_by(|a, b| a.pinion_torque_n_mm.total_cmp(&b.pinion_torque_n_mm));
    let member_rpm = greatest.and_then(|phase| phase.pinion_speed_rpm).map(|rpm| rpm / turns.sun_planet);
    // The run has the load of the planet that carries most.
    let of_mesh = greatest.map_or(0.0, |phase| 1e-3 * phase.pinion_torque_n_mm);
    let sun_torque = of_mesh * planets / scene.load_sharing_factor;
    KinematicSummary {
        teeth: PerGearOfStage { sun: stage.sun_teeth, planet: stage.planet_teeth, ring: stage.ring_teeth },
        planets: stage.planets(),
        planet_angles_deg: stage.planet_angles_rad.iter().map(|angle| angle.to_degrees()).collect(),
        held: stage.held.name().to_owned(),
        member: scene.member.name().to_owned(),
        speed_rpm: member_rpm.map(|rpm| PerMember {
            sun: rpm * speed_ratio.sun,
            carrier: rpm * speed_ratio.carrier,
            ring: rpm * speed_ratio.ring,
        }),
        speed_ratio,
        torque_Nm: PerMember {
            sun: sun_torque,
            carrier: sun_torque / stage.sun_torque(Member::Carrier),
            ring: sun_torque / stage.sun_torque(Member::Ring),
        },
        load_sharing_factor: scene.load_sharing_factor,
        meshes_per_revolution: PerGearOfStage {
            sun: planets * turns.sun_planet,
            planet: turns.planet_ring,
            ring: planets * turns.sun_planet * f64::from(stage.sun_teeth) / f64::from(stage.ring_teeth),
        },
        planet_clearance_mm: scene.planet_clearance_mm,
        mesh_phase: stage.phases(),
        ring_mesh_phase: scene.ring_mesh_phase,
    }
}
