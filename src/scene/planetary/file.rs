//! The file of a planetary stage: what a user may write in `[planetary]` and `[operation]`. All other tables are those of a pair.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mesh::StageMesh;
use crate::scene::file::{BasicRackFile, StopFile};
use crate::scene::gear_file::GearFile;
use gearwear_bodies::gear::planetary::Member;

/// What a stage has and a pair has not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageFile {
    /// The stage: sun, planets on a carrier, ring.
    pub planetary: PlanetaryFile,
    /// Load, speed and duration of one member.
    pub operation: StageOperationFile,
}

/// A planetary stage of one sun, equal planets and a ring. Both meshes have the same module, pressure angle, centre distance and face width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlanetaryFile {
    /// Number of planets, 1 to 20.
    #[schemars(range(min = 1, max = 20))]
    pub planets: u32,
    /// Angle of each planet on the carrier in degrees, 0 to below 360, rising from 0 of the first. Default: equal spacing.
    #[schemars(inner(range(min = 0)), extend("items" = { "type": "number", "minimum": 0, "exclusiveMaximum": 360 }))]
    pub planet_angles_deg: Option<Vec<f64>>,
    /// Member that stands still. Default: the ring.
    pub held: Option<MemberFile>,
    /// Load sharing factor K_γ (mesh load factor): load of the planet that carries most over the mean, 1 to the number of planets. Both meshes run under that
    /// load. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub load_sharing_factor: Option<f64>,
    /// Mesh of the stage that a command on one pair takes. Default: both, which run, plan, sweep and uncertainty take.
    pub mesh: Option<StageMesh>,
    /// Normal module m_n in mm, > 0. Required, or transverse_module_mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub normal_module_mm: Option<f64>,
    /// Transverse module m_t in mm, > 0, instead of the normal one.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub transverse_module_mm: Option<f64>,
    /// Normal pressure angle α_n in degrees, 5 to 45. Required, or transverse_pressure_angle_deg.
    #[schemars(range(min = 5, max = 45))]
    pub pressure_angle_deg: Option<f64>,
    /// Transverse pressure angle α_t in degrees, 5 to 45, instead of the normal one.
    #[schemars(range(min = 5, max = 45))]
    pub transverse_pressure_angle_deg: Option<f64>,
    /// Helix angle β at the reference cylinder in degrees, −45 to 45. Default 0.
    #[schemars(range(min = -45, max = 45))]
    pub helix_angle_deg: Option<f64>,
    /// Working centre distance of both meshes in mm, > 0. Required.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub centre_distance_mm: Option<f64>,
    /// Common face width b in mm, > 0. Required.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub face_width_mm: Option<f64>,
    /// Basic rack of the teeth, in factors of the module that is given. Default: profile A of ISO 53.
    pub basic_rack: Option<BasicRackFile>,
    /// The sun.
    pub sun: GearFile,
    /// Each planet; its modifications are on both flanks.
    pub planet: GearFile,
    /// The ring, with internal teeth.
    pub ring: GearFile,
}

/// A member of the stage that turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MemberFile {
    /// The sun.
    Sun,
    /// The carrier of the planets.
    Carrier,
    /// The ring.
    Ring,
}

impl From<MemberFile> for Member {
    fn from(file: MemberFile) -> Self {
        match file {
            MemberFile::Sun => Member::Sun,
            MemberFile::Carrier => Member::Carrier,
            MemberFile::Ring => Member::Ring,
        }
    }
}

/// Load, speed and duration of one member of the stage; those of the others follow without losses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageOperationFile {
    /// Member whose torque, speed and revolutions are given; not the held one. Default: the sun, or the carrier where the sun is held.
    pub member: Option<MemberFile>,
    /// Torque on it in N·m, > 0. Required, unless every phase gives its own.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_Nm: Option<f64>,
    /// Its speed in revolutions per minute, > 0; needed with hours, snapshots_h and temperatures.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed_rpm: Option<f64>,
    /// Duration of the run in hours, > 0. Required, or revolutions.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hours: Option<f64>,
    /// Duration of the run in its revolutions, > 0. Required, or hours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub revolutions: Option<f64>,
    /// Times in hours at which the state is kept, increasing. Default: as of a pair.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }))]
    pub snapshots_h: Option<Vec<f64>>,
    /// The same times in its revolutions.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }))]
    pub snapshots_revolutions: Option<Vec<f64>>,
    /// Limits that end the run of a mesh. Default: none.
    pub stop: Option<StopFile>,
    /// Load spectrum: phases one after the other. Default: one phase.
    pub phases: Option<Vec<StagePhaseFile>>,
}

/// A phase of the run under constant load and speed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StagePhaseFile {
    /// Duration of the phase in hours, > 0. Required, or revolutions.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hours: Option<f64>,
    /// Duration of the phase in revolutions of the member, > 0. Required, or hours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub revolutions: Option<f64>,
    /// Torque on the member in N·m, > 0. Default: operation.torque_Nm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_Nm: Option<f64>,
    /// Speed of the member in revolutions per minute, > 0. Default: operation.speed_rpm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed_rpm: Option<f64>,
    /// Wear coefficient of all gears in m²/N, > 0. Default: that of the wear law.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_m2_per_N: Option<f64>,
    /// The same in mm³/(N·m), > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_mm3_per_Nm: Option<f64>,
}
