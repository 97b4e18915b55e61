//! Everything that finite-element contact of a gear pair leaves behind, as plain data in the units of the output files:
//! what its report reads.
//!
//! Field names are the contract's column and key names, so that serialising a record is writing the file.

#![allow(non_snake_case, reason = "the contract's key and column names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fem_problem::NodalStress;
use super::root_stress::RootStressSummary;
use super::run::{ContactSummary, GeometrySummary, PathPoints, RangeSummary, StageTime, StopReason};
use gearwear_bodies::gear::PerGear;
use gearwear_fem::solid::Element;
use gearwear_mesh::quality::MeshQuality;

/// A finished (or interrupted) computation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FemPairRecord {
    /// Content of `summary.json`.
    pub summary: FemPairSummary,
    /// The resolved scene as TOML.
    pub scene_toml: String,
    /// One row per position and tooth pair in contact.
    pub mesh_cycle: Vec<FemCycleRow>,
    /// Pressure along the flank: at the position asked for, or at A–E.
    pub pressure: Vec<PressureCurve>,
    /// The teeth in contact with displacement and stress, at the position asked for, or at C.
    pub solution: Option<PairSolution>,
}

/// `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FemPairSummary {
    /// The scene's title.
    pub title: String,
    /// Version of the program.
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene.
    pub scene_hash: String,
    /// Why it ended.
    pub stopped: StopReason,
    /// The position asked for; `None`: the whole mesh cycle.
    pub position_mm: Option<f64>,
    /// Positions solved, the points A–E of a mesh cycle not counted.
    pub positions: usize,
    /// Degrees of freedom of both gears as modelled, supports included.
    pub dofs: usize,
    /// Elements of both gears as modelled.
    pub elements: usize,
    /// Iterations of the active set at all positions together.
    pub iterations: usize,
    /// The stages carried out, in order, with their wall time.
    pub stages: Vec<StageTime>,
    /// Wall time until the report is written, s.
    pub wall_s: f64,
    /// Wall time of a position, s.
    pub wall_per_position_s: Option<f64>,
    /// Of the pair.
    pub geometry: GeometrySummary,
    /// Of Hertz's contact at the pitch point with the whole load.
    pub contact: ContactSummary,
    /// Model, and how fine it is.
    pub model: ModelSummary,
    /// The mesh cycle of the unworn pair.
    pub new: FemCycleSummary,
    /// The reference pair at the points A–E; `None` where one position was asked for.
    pub points: Option<PathPointsSummary>,
    /// Stress at the roots of the reference pair's teeth; `None` where no position was solved.
    pub root: PerGear<Option<RootSummary>>,
    /// Nominal stress there by the standards.
    pub root_stress: PerGear<RootStressSummary>,
    /// How well equilibrium was met.
    pub checks: ChecksSummary,
    /// The whole model without condensation against the condensed one, position by position; `None` where not asked for.
    pub full: Option<Vec<FullModelSummary>>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// The finite-element model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelSummary {
    /// `ring` or `sector`.
    pub body: String,
    /// Teeth of the sector, where it is one.
    pub sector_teeth: Option<u32>,
    /// Support of the sides of the sector, where it is one.
    pub sector_sides: Option<String>,
    /// Elements along Hertz's half-width under the whole load.
    pub elements_per_half_width: f64,
    /// Each gear.
    pub gears: PerGear<GearModelSummary>,
}

/// The finite-element model of one gear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GearModelSummary {
    /// Radius where a body is held (wheel) or turned (pinion) rigidly.
    pub clamp_radius_mm: f64,
    /// Degrees of freedom as modelled, supports included.
    pub dofs: usize,
    /// Elements as modelled.
    pub elements: usize,
    /// Teeth whose working flank is resolved.
    pub resolved_teeth: u32,
    /// Degrees of freedom of one of them.
    pub resolved_tooth_dofs: usize,
    /// Nodes of a working flank that may carry load: what a tooth is condensed onto.
    pub candidates: usize,
    /// The worst elements.
    pub quality: MeshQuality,
}

/// The mesh cycle in figures: the same keys as a wear run's, and more.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FemCycleSummary {
    /// Maximum pressure where no sharp tip edge carries load; `None` where one does everywhere.
    pub peak_pressure_MPa: Option<f64>,
    /// Position of the reference pair there.
    pub peak_pressure_position_mm: Option<f64>,
    /// Number of the tooth pair there.
    pub peak_pressure_pair: Option<i32>,
    /// Position of that pair itself.
    pub peak_pressure_pair_position_mm: Option<f64>,
    /// Radius on the pinion there.
    pub peak_pressure_pinion_radius_mm: Option<f64>,
    /// Maximum pressure found at a sharp tip edge: it grows with every refinement.
    pub sharp_edge_pressure_MPa: Option<f64>,
    /// Maximum pressure of the reference pair at C.
    pub pitch_pressure_MPa: Option<f64>,
    /// Hertz's pressure at C under the load the pair carries there.
    pub pitch_hertz_pressure_MPa: Option<f64>,
    /// Loaded transmission error.
    pub transmission_error_um: RangeSummary,
}

/// Load and pressure of the reference pair at A–E.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PathPointsSummary {
    /// Share of the whole load; 0 where it carries none.
    pub load_share: PathPoints,
    /// Maximum pressure; 0 where it carries none.
    pub peak_pressure_MPa: PathPoints,
    /// Hertz's pressure under the load it carries.
    pub hertz_pressure_MPa: PathPoints,
    /// Loaded transmission error.
    pub transmission_error_um: PathPoints,
}

/// Stress along the fillets of one tooth over the positions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RootSummary {
    /// Maximum principal stress at the fillet below the working flank.
    pub tension_MPa: f64,
    /// Position of the reference pair there.
    pub tension_position_mm: f64,
    /// Minimum principal stress at the fillet on the other side.
    pub compression_MPa: f64,
    /// Position of the reference pair there.
    pub compression_position_mm: f64,
}

/// How well equilibrium was met, worst over the positions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChecksSummary {
    /// z2/z1.
    pub tooth_ratio: f64,
    /// | |T2/T1| / (z2/z1) − 1 |, greatest.
    pub torque_ratio_error: f64,
    /// Position where it is greatest.
    pub torque_ratio_error_position_mm: f64,
    /// Error where every contact lies on the line of action; `None` where no position is so.
    pub torque_ratio_error_on_line: Option<f64>,
    /// Meaning of it.
    pub torque_ratio: String,
    /// |Σ line loads of the pairs / whole line load − 1|.
    pub load_imbalance: f64,
    /// Largest overlap left at a multiplier.
    pub max_penetration_um: f64,
    /// Mean number of iterations of the active set at a position.
    pub iterations_per_position: f64,
    /// Most at one position.
    pub most_iterations: usize,
    /// Cycles of the active set that were broken.
    pub cycles_broken: usize,
}

/// The whole model without condensation at one position, and how far it is from the condensed one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FullModelSummary {
    /// The position.
    pub position_mm: f64,
    /// Degrees of freedom of both gears in one model.
    pub dofs: usize,
    /// Loaded transmission error.
    pub transmission_error_um: f64,
    /// Difference to the condensed model, relative.
    pub transmission_error_difference: f64,
    /// Maximum difference of a pair's line load, over that of the whole torque.
    pub line_load_difference: f64,
    /// Maximum difference of a pair's peak pressure, relative.
    pub peak_pressure_difference: f64,
    /// Largest unbalanced nodal force over the largest nodal force.
    pub residual: f64,
    /// Active-set iterations.
    pub iterations: usize,
    /// Wall time, s.
    pub wall_s: f64,
}

/// A row of `mesh_cycle.csv`: one tooth pair in contact at one position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FemCycleRow {
    /// radius of curvature of the pinion's flank at the theoretical contact point of the reference pair, from A to E
    pub position_mm: f64,
    /// tooth pair: 0 the reference pair, 1 the one a base pitch ahead, -1 the one behind
    pub pair: i32,
    /// the pair's part of the torque over base radius and face width
    pub line_load_N_per_mm: f64,
    /// greatest contact pressure of the pair
    pub peak_pressure_MPa: f64,
    /// half the length of flank under pressure
    pub half_width_mm: f64,
    /// of the gear pair at this position, along the line of action, positive under load
    pub transmission_error_um: f64,
    /// line load over that of the whole torque
    pub load_share: f64,
    /// Hertz's maximum pressure of the pair's line load on the unmodified involutes there
    pub hertz_pressure_MPa: f64,
    /// Hertz's half-width of the same
    pub hertz_half_width_mm: f64,
    /// radius on the pinion where the resultant of the pressure acts
    pub pinion_radius_mm: f64,
    /// whether a sharp tip edge carries pressure: the peak then is singular and grows with refinement
    pub at_sharp_edge: bool,
    /// maximum principal stress at the pinion's fillet below the working flank, reference pair, at this position
    pub pinion_root_tension_MPa: f64,
    /// minimum principal stress at the pinion's other fillet
    pub pinion_root_compression_MPa: f64,
    /// maximum principal stress at the wheel's fillet below the working flank
    pub wheel_root_tension_MPa: f64,
    /// minimum principal stress at the wheel's other fillet
    pub wheel_root_compression_MPa: f64,
    /// |T2/T1| at this position
    pub torque_ratio: f64,
    /// active-set iterations at this position
    pub iterations: usize,
    /// radius of curvature of the pinion's flank at the theoretical contact point of this pair: before A or after E where a tip edge touches
    pub pair_position_mm: f64,
}

/// Pressure of one tooth pair along the flank that carries the multipliers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PressureCurve {
    /// `A` to `E`; `None` where the position was asked for.
    pub point: Option<String>,
    /// Row of `mesh_cycle.csv`.
    pub row: FemCycleRow,
    /// Distance from the resultant along the flank towards the pinion's tip, mm.
    pub along_mm: Vec<f64>,
    /// Pressure there, MPa.
    pub pressure_MPa: Vec<f64>,
}

/// The teeth in contact with displacement and stress; the pinion's axis is the origin and the wheel's lies on +y.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairSolution {
    /// The position, mm.
    pub position_mm: f64,
    /// Nodes before deformation, mm.
    pub points_mm: Vec<[f64; 2]>,
    /// Elements; the material is 0 for the pinion and 1 for the wheel.
    pub elements: Vec<Element>,
    /// Number of the tooth pair of each element's tooth.
    pub pair_of_element: Vec<i32>,
    /// Displacement of each node, mm; the pinion's holds its rotation by the transmission error.
    pub displacement_mm: Vec<[f64; 2]>,
    /// Stress of each node.
    pub stress: Vec<NodalStress>,
    /// The contacts, by increasing number of the pair.
    pub contacts: Vec<ContactPlace>,
}

/// Where a tooth pair touches.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactPlace {
    /// Number of the pair.
    pub pair: i32,
    /// Where the resultant acts, after deformation, mm.
    pub at_mm: [f64; 2],
    /// Half-width, mm.
    pub half_width_mm: f64,
    /// Maximum pressure.
    pub peak_pressure_MPa: f64,
    /// Whether a sharp tip edge carries pressure.
    pub at_sharp_edge: bool,
}
