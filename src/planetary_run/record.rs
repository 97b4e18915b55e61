//! What the run of a planetary stage leaves behind, in the units of the files.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear_physics::results::run::{RangeSummary, RunRecord, StopReason, Summary, WearSummary};

/// Runs of both meshes and what follows for the stage.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetaryRecord {
    /// Content of `summary.json`.
    pub summary: PlanetarySummary,
    /// The file as given.
    pub scene_toml: String,
    /// Run of each mesh; `None` where it was not begun.
    pub meshes: PerMesh<Option<RunRecord>>,
    /// Transmission error over one base pitch; empty where it is not known.
    pub transmission_error: Vec<StageTransmissionRow>,
}

/// `summary.json` of a planetary stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlanetarySummary {
    /// Title.
    pub title: String,
    /// Version of the program.
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the file as given.
    pub scene_hash: String,
    /// How the run of the mesh ended that ended worst.
    pub stopped: StopReason,
    /// Hours reached; `None` where the file gives no speed.
    pub hours: Option<f64>,
    /// Revolutions reached, of the member whose torque is given.
    pub revolutions: f64,
    /// Life of the stage: the shorter one of both meshes; `None` without limits.
    pub life: Option<StageLife>,
    /// Wall time of both runs, s.
    pub wall_s: f64,
    /// Kinematics and assembly.
    pub planetary: KinematicSummary,
    /// Wear of one flank of the sun.
    pub sun: Option<WearSummary>,
    /// Wear of both flanks of a planet.
    pub planet: PlanetWear,
    /// Wear of one flank of the ring.
    pub ring: Option<WearSummary>,
    /// Transmission error of the stage at the sun's base circle, carrier and ring in their places.
    pub transmission_error: StageTransmissionError,
    /// Summary of the run of each mesh; of sun and planet, pinion and wheel are these, and of planet and ring likewise.
    #[serde(flatten)]
    pub meshes: PerMesh<Option<Summary>>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// Wear of a planet.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct PlanetWear {
    /// Flank that meets the sun.
    pub sun_flank: Option<WearSummary>,
    /// Flank that meets the ring.
    pub ring_flank: Option<WearSummary>,
    /// Worn off one planet, both flanks of all teeth.
    pub worn_mass_mg: Option<f64>,
}

/// Life to the limits of `operation.stop`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageLife {
    /// Mesh that came to a limit first, `sun_planet` or `planet_ring`; `None` where neither did.
    pub mesh: Option<String>,
    /// Gear that did: `sun`, `planet` or `ring`.
    pub gear: Option<String>,
    /// Hours until then; `None` where no limit was reached, or the file gives no speed.
    pub hours: Option<f64>,
    /// Revolutions of the given member until then.
    pub revolutions: Option<f64>,
}

/// Kinematics, loads and assembly of the stage.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct KinematicSummary {
    /// Teeth of sun, planet and ring.
    pub teeth: PerGearOfStage<u32>,
    /// Number of planets.
    pub planets: usize,
    /// Angle of each planet on the carrier.
    pub planet_angles_deg: Vec<f64>,
    /// Member that stands still.
    pub held: String,
    /// Member whose torque, speed and revolutions the file gives.
    pub member: String,
    /// Speed of each member over that of the given one.
    pub speed_ratio: PerMember<f64>,
    /// Speed of each member, under the reference load; `None` where the file gives no speed.
    pub speed_rpm: Option<PerMember<f64>>,
    /// Torque on each member under the reference load, without losses: without sign.
    pub torque_Nm: PerMember<f64>,
    /// K_γ.
    pub load_sharing_factor: f64,
    /// Meshes of a tooth of each gear in one revolution of the given member: of the sun, of either flank of a planet, of the ring.
    pub meshes_per_revolution: PerGearOfStage<f64>,
    /// Least distance between the tip circles of neighbouring planets; `None` of one planet.
    pub planet_clearance_mm: Option<f64>,
    /// Base pitches by which each planet's mesh with the sun is ahead of that of the first.
    pub mesh_phase: Vec<f64>,
    /// Base pitches by which a planet's mesh with the ring is ahead of that with the sun.
    pub ring_mesh_phase: f64,
}

/// One of each gear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PerGearOfStage<T> {
    pub sun: T,
    pub planet: T,
    pub ring: T,
}

/// One of each member.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PerMember<T> {
    pub sun: T,
    pub carrier: T,
    pub ring: T,
}

/// Transmission error of the stage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageTransmissionError {
    /// New; `None` where a mesh was not run, or its path of contact is shorter than a base pitch.
    pub new: Option<RangeSummary>,
    /// Worn.
    pub worn: Option<RangeSummary>,
}

/// A row of `transmission_error.csv`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageTransmissionRow {
    /// place within the mesh of the first planet with the sun, in base pitches; 0 where contact passes the pitch point
    pub mesh_phase: f64,
    /// transmission error of sun and first planet, new
    pub sun_planet_new_um: f64,
    /// the same of first planet and ring
    pub planet_ring_new_um: f64,
    /// mean of all planets, of both meshes together, at the base circle of the sun, new
    pub stage_new_um: f64,
    /// transmission error of sun and first planet, worn
    pub sun_planet_worn_um: f64,
    /// the same of first planet and ring
    pub planet_ring_worn_um: f64,
    /// mean of all planets, worn
    pub stage_worn_um: f64,
}

impl PlanetarySummary {
    /// Names of the flanks in words, with the wear of those that were run.
    pub fn flanks(&self) -> [(&'static str, Option<&WearSummary>); 4] {
        [
            ("sun", self.sun.as_ref()),
            ("planet, towards the sun", self.planet.sun_flank.as_ref()),
            ("planet, towards the ring", self.planet.ring_flank.as_ref()),
            ("ring", self.ring.as_ref()),
        ]
    }

    /// Summary of the run of a mesh.
    pub fn mesh(&self, mesh: StageMesh) -> Option<&Summary> {
        self.meshes[mesh].as_ref()
    }
}
