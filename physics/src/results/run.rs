//! Everything a run leaves behind, as plain data in the units of the output files: what the reports read.
//!
//! Field names are the contract's column and key names, so that serialising a record is writing the file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use super::drawing::{GearCircles, PairDrawing};

use super::chemistry::{TemperatureSummary, WearLawSummary};
use super::error::ErrorSummary;
use super::invariant::Invariant;
use super::iso_stiffness::IsoStiffnessSummary;
use super::life::LifeSummary;
use super::lubrication::{FilmRow, LubricationSummary};
pub use super::path_points::PathPoints;
pub use super::reported_by::ReportedBy;
use super::root_stress::RootStressSummary;
use super::torque_curve::{TorqueCurveRow, TorqueCurveSummary};
use gearwear_bodies::gear::{PerGear, flank_surface::FlankSurface, flank_zones::FlankZones};

/// A finished (or interrupted) run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// Content of `summary.json`.
    pub summary: Summary,
    /// The resolved scene as TOML; input files have the names of `inputs`.
    pub scene_toml: String,
    /// Copies of the files that the scene names.
    pub inputs: Vec<InputFile>,
    /// Both flanks, point by point.
    pub flanks: PerGear<FlankRecord>,
    /// One row per snapshot reached.
    pub history: Vec<HistoryRow>,
    /// One row per loading position.
    pub mesh_cycle: Vec<MeshCycleRow>,
    /// Films and friction along the path of contact; empty where nobody asks for them.
    pub film: Vec<FilmRow>,
    /// Each gear's working flank in space.
    pub surface: PerGear<FlankSurface>,
    /// The mesh of one tooth slice by slice; `None` where all sections are alike.
    pub slices: Option<SliceRecord>,
    /// The pair in mesh, to scale.
    pub drawing: PairDrawing,
    /// Transmission error over torque, torque by torque; empty where nobody asks for it.
    #[serde(default)]
    pub torque_curve: Vec<TorqueCurveRow>,
}

/// A file that a scene names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InputFile {
    /// Name in the folder of the run.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Summary {
    /// The scene's title.
    pub title: String,
    /// Author and date of the report; null where the scene does not say it.
    pub report: Option<ReportedBy>,
    /// Version of the program.
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene.
    pub scene_hash: String,
    /// Why the run ended.
    pub stopped: StopReason,
    /// Hours reached; `None` where the scene gives no speed.
    pub hours: Option<f64>,
    /// Pinion revolutions reached.
    pub revolutions: f64,
    /// The life to the limits of `operation.stop`; `None` where the scene has none.
    pub life: Option<LifeSummary>,
    /// The stages carried out, in order, with their wall time.
    pub stages: Vec<StageTime>,
    /// The stages left out, with the reason.
    pub left_out: Vec<StageLeftOut>,
    /// Wall time of the whole run until the report is written, s.
    pub wall_s: f64,
    /// Of the pair.
    pub geometry: GeometrySummary,
    /// Of the slices over the face width; `None` where all sections are alike.
    pub helical: Option<HelicalSummary>,
    /// Of the contact at the pitch point with the whole load of the reference phase.
    pub contact: ContactSummary,
    /// Number, from 1, of the phase of the greatest load: `new`, `worn` and `contact` are under that load.
    pub reference_phase: usize,
    /// The phases that the run came to, in order; one where the operation has none of its own.
    pub phases: Vec<PhaseSummary>,
    /// Of the tooth pair as a spring; `None` with finite elements, whose teeth are no springs.
    pub stiffness: Option<StiffnessSummary>,
    /// Stiffness by ISO 6336-1 under the load of the reference phase, whatever the run takes.
    #[serde(default)]
    pub stiffness_iso_6336_1: Option<IsoStiffnessSummary>,
    /// Nominal stress at the roots of each gear by the standards.
    pub root_stress: PerGear<RootStressSummary>,
    /// Of the wear law; `None` where each gear has its own.
    pub wear: Option<WearLawSummary>,
    /// Of the wear law of each gear.
    pub wear_of_gear: PerGear<WearLawSummary>,
    /// Of the contact's temperatures; `None` where nobody asks for them.
    pub temperature: Option<TemperatureSummary>,
    /// Of films, friction and losses; `None` where nobody asks for them.
    pub lubrication: Option<LubricationSummary>,
    /// The mesh cycle of the unworn pair, under the load of the reference phase.
    pub new: CycleSummary,
    /// The mesh cycle of the worn pair, under the same load.
    pub worn: CycleSummary,
    /// Peak-to-peak transmission error over the life of the pair, each load of a spectrum in its own phase; null in results of earlier versions.
    #[serde(default)]
    pub transmission_error_over_life: Option<OverLifeSummary>,
    /// Transmission error over torque; null where `operation.torque_curve_Nm` names no torques.
    #[serde(default)]
    pub transmission_error_over_torque: Option<TorqueCurveSummary>,
    /// Wear of one pinion flank.
    pub pinion: WearSummary,
    /// Wear of one wheel flank.
    pub wheel: WearSummary,
    /// How far what both flanks lose in one mesh is from balance.
    pub wear_balance: WearBalance,
    /// Statements that hold for every run, and whether this one contradicts them.
    #[serde(default)]
    pub invariants: Vec<Invariant>,
    /// Estimated errors.
    pub error: ErrorSummary,
    /// Work done by the simulation.
    pub work: WorkSummary,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// A phase of the operation.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PhaseSummary {
    /// Number, from 1.
    pub number: usize,
    /// How long it was run; `None` without a speed.
    pub hours: Option<f64>,
    /// Duration in pinion revolutions.
    pub revolutions: f64,
    /// Torque on the pinion.
    pub pinion_torque_Nm: f64,
    /// Speed of the pinion, where given.
    pub pinion_speed_rpm: Option<f64>,
    /// Whole torque over base radius and face width.
    pub line_load_N_per_mm: f64,
    /// K/H, where the surface has one.
    pub foundation_MPa_per_mm: Option<f64>,
    /// Hertz's maximum pressure at the pitch point under the whole load.
    pub hertz_peak_pressure_MPa: f64,
    /// Wear coefficient; `None` where each gear has its own.
    pub coefficient_m2_per_N: Option<f64>,
    /// Maximum rise of the contact temperature at its end, by the chosen method; `None` where nobody asks for temperatures.
    pub greatest_rise_K: Option<f64>,
    /// Part of the sliding work at its end that is outside the temperatures for which the wear law holds, where it names some.
    pub work_outside_validity: Option<f64>,
    /// Wear of the pinion in it.
    pub pinion: PhaseWear,
    /// Wear of the wheel in it.
    pub wheel: PhaseWear,
}

/// Wear of a gear in a phase.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PhaseWear {
    /// Wear coefficient of the gear.
    pub coefficient_m2_per_N: f64,
    /// Maximum depth that any place of the active profile lost, the zone of the tip edge apart.
    pub greatest_depth_um: f64,
    /// Maximum depth that any place of the tip edge lost.
    pub tip_edge_depth_um: f64,
    /// Maximum depth that any place below the start of active profile lost.
    pub below_sap_depth_um: f64,
    /// Worn off the whole gear: all teeth, whole width.
    pub worn_volume_mm3: f64,
}

/// Why a wear run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StopReason {
    /// The whole duration was run.
    Completed,
    /// A limit of `operation.stop` was reached: `life` says which, and when.
    LimitReached,
    /// The user interrupted it; what was finished is kept.
    Interrupted,
    /// The tooth pairs found no equilibrium; what was finished is kept.
    NotConverged,
    /// The wear came to the thickness of a tooth, which no result can stand for; what was kept before is that.
    WornThrough,
}

impl StopReason {
    /// Whether the run came to its end: its duration, or a limit that was to end it.
    pub fn is_complete(self) -> bool {
        matches!(self, StopReason::Completed | StopReason::LimitReached)
    }
}

/// A stage and how long it took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageTime {
    /// Name of the stage.
    pub name: String,
    /// Wall time, s.
    pub wall_s: f64,
}

/// A stage that the scene does not need.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StageLeftOut {
    /// Name of the stage.
    pub name: String,
    /// Why it is left out.
    pub reason: String,
}

/// Geometry of the pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GeometrySummary {
    /// ε_α.
    pub transverse_contact_ratio: f64,
    /// ε_β.
    pub overlap_ratio: f64,
    /// Transverse base pitch p_bt, mm.
    pub base_pitch_mm: f64,
    /// Transverse working pressure angle α_wt, degrees.
    pub working_pressure_angle_deg: f64,
    /// Radius of curvature of the pinion's flank at A–E, mm.
    pub curvature_radius_mm: PathPoints,
    /// Index of the pinion's pitch circle on a flank of 750 points.
    pub pitch_point_index: f64,
    /// Length T1T2 of the line of action between the base circles, mm.
    pub line_of_action_mm: f64,
    /// Circumferential backlash on the working circles, transverse, mm.
    pub backlash_mm: f64,
    /// Diameters and other data of each gear.
    pub gears: PerGear<GearSummary>,
}

/// Diameters and other data of one gear, mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names of ISO 21771 say it")]
pub struct GearSummary {
    pub teeth: u32,
    pub reference_diameter_mm: f64,
    pub base_diameter_mm: f64,
    pub working_pitch_diameter_mm: f64,
    pub tip_diameter_mm: f64,
    pub root_diameter_mm: f64,
    /// Where the involute begins.
    pub root_form_diameter_mm: f64,
    /// Start of active profile (SAP): where contact ends towards the root.
    pub start_of_active_profile_diameter_mm: f64,
    /// Transverse, at the reference circle.
    pub tooth_thickness_mm: f64,
    /// Transverse, at the tip circle.
    pub tip_thickness_mm: f64,
    pub tip_clearance_mm: f64,
    pub undercut: bool,
    /// Where the usable flank ends towards the tip, d_Fa: the tip circle, or where the rounding of the tip edge begins.
    pub tip_form_diameter_mm: f64,
    /// End of active profile towards the tip, d_Na: below the tip circle where the form circle of the mate ends the contact.
    pub end_of_active_profile_diameter_mm: f64,
    /// Specific sliding at the start of active profile, ζ_f; `None` where that lies on the base circle.
    pub specific_sliding_at_root: Option<f64>,
    /// Number of teeth k that the span is measured over; `None` where no number touches the flanks within the face width.
    pub span_teeth: Option<u32>,
    /// Span W_k, thickness allowance included; `None` as its number of teeth.
    pub span_mm: Option<f64>,
    /// Diameter of the measuring balls (pins), 1.728 or 1.92 normal modules; `None` where neither touches the flanks and stands out.
    pub ball_diameter_mm: Option<f64>,
    /// Diametral dimension over two balls, M_dK, thickness allowance included; `None` as their diameter.
    pub dimension_over_balls_mm: Option<f64>,
}

/// The pair slice by slice.
#[allow(non_snake_case, reason = "names that end in their unit, and symbols of the standards")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HelicalSummary {
    /// Slices over the face width.
    pub slices: usize,
    /// Name of their coupling.
    pub coupling: String,
    /// ℓ₁ and ℓ₂ of the coupling: how far a deflection reaches along a tooth; `None` without coupling.
    pub coupling_reach_mm: Option<[f64; 2]>,
    /// How far each shaft's twist lets the teeth give way at the end that is not driven, under the load of the reference phase spread evenly;
    /// none where it is rigid.
    pub shaft_twist_um: PerGear<Option<f64>>,
    /// How much farther each shaft on its bearings lets the teeth give way at the full width than at width 0, along the line of action under the
    /// load of the reference phase spread evenly; none without bearings.
    #[serde(default)]
    pub misalignment_um: PerGear<Option<f64>>,
    /// Helix slope that axes out of parallel make over the face width; none where they are parallel.
    pub slope_of_axes_um: Option<f64>,
    /// β at the reference cylinder.
    pub helix_angle_deg: f64,
    /// β_b.
    pub base_helix_angle_deg: f64,
    /// ε_γ = ε_α + ε_β.
    pub total_contact_ratio: f64,
    /// Place of each slice over the face width.
    pub width_mm: Vec<f64>,
    /// Least, greatest and mean length of all lines of contact together.
    pub line_of_contact_mm: LineOfContactSummary,
    /// Face load factor K_Hβ: greatest over mean of the slices' loads, averaged over the mesh; new.
    pub K_Hbeta_new: f64,
    /// K_Hβ, worn.
    pub K_Hbeta_worn: f64,
    /// The first five mesh orders of the transmission error: amplitudes, new.
    pub mesh_orders_new_um: Vec<f64>,
    /// Amplitudes of the first five mesh orders, worn.
    pub mesh_orders_worn_um: Vec<f64>,
    /// Wear over the face width of each gear.
    pub wear: PerGear<OverWidthSummary>,
}

/// All lines of contact together over a mesh, within A–E: contact of tip edges outside it is left out.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LineOfContactSummary {
    /// Least length.
    pub min: f64,
    /// Greatest length.
    pub max: f64,
    /// Mean length, ε_α b / cos β_b.
    pub mean: f64,
}

/// How wear varies over the face width of a flank.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OverWidthSummary {
    /// Maximum depth in the root zone of each slice.
    pub root_wear_um: Vec<f64>,
    /// Maximum depth in the tip zone (the last 2 mm of radius) of each slice.
    pub tip_wear_um: Vec<f64>,
    /// Depth lost at the root by each slice in the first mesh of the unworn pair.
    pub root_wear_first_mesh_um: Vec<f64>,
    /// Depth lost at the tip by each slice in the first mesh of the unworn pair.
    pub tip_wear_first_mesh_um: Vec<f64>,
    /// Maximum less minimum root wear, over its mean.
    pub root_variation: f64,
    /// Maximum less minimum tip wear, over its mean.
    pub tip_variation: f64,
    /// Of root and tip together: greatest less least over the mean of both zones of all slices.
    pub root_tip_variation: f64,
    /// (first slice − last slice) / (first + last) of the root wear, after the first mesh.
    pub root_asymmetry_first_mesh: f64,
    /// Asymmetry of the root wear at the end of the run.
    pub root_asymmetry: f64,
}

/// Contact at the pitch point with the whole load.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ContactSummary {
    /// Name of the surface model.
    pub surface: String,
    /// Whole torque over base radius and face width.
    pub line_load_N_per_mm: f64,
    /// K/H, where the surface has one.
    pub foundation_MPa_per_mm: Option<f64>,
    /// Hertz's half-width a.
    pub hertz_half_width_mm: f64,
    /// Hertz's maximum pressure.
    pub hertz_peak_pressure_MPa: f64,
}

/// Stiffness of a tooth pair per mm of face width.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StiffnessSummary {
    /// Name of the stiffness model.
    pub model: String,
    /// Line load at which the spring of the teeth and the contact surface together have the model's compliance.
    pub reference_line_load_N_per_mm: f64,
    /// Whole pair with flattening, at C and the reference load, as the model states it: of a helical pair, of its transverse section, without what
    /// oblique teeth, end faces and coupling make of its slices.
    pub pair_at_pitch_N_per_mm_um: f64,
    /// Tooth spring alone, at C, likewise.
    pub teeth_at_pitch_N_per_mm_um: f64,
    /// Residual of the split: relative difference between the surface's and the true flattening's share of the
    /// pair's approach at C at half the reference load; `None` where the model states no flattening.
    pub split_remainder_at_half_load: Option<f64>,
}

/// One mesh cycle in figures. Maximum pressures of whole slices leave 1/40 of the face width out at either end face.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct CycleSummary {
    /// Maximum pressure at a single point, the tip edges' roundings and the kinks of linear reliefs included: there it depends on the
    /// resolution. Not of that which a sharp tip edge cuts off.
    pub peak_pressure_MPa: f64,
    /// Maximum pressure found at a mathematically sharp tip edge under load, which grows with every refinement; `None` where there is none.
    pub sharp_edge_pressure_MPa: Option<f64>,
    /// Maximum pressure between the tip-edge zones of both flanks, as a mean over 0.04 mm of profile, at most 0.4 Hertz half-widths.
    pub flank_pressure_MPa: f64,
    /// Greatest line load of a contact that reaches a tip edge or its rounding; 0 where none does.
    pub tip_edge_line_load_N_per_mm: f64,
    /// Pressure of such a contact in the tip-edge zones as a mean over 0.04 mm of profile, the greatest; 0 where there is none.
    pub tip_edge_mean_pressure_MPa: f64,
    /// Maximum pressure with the theoretical contact point at C.
    pub pitch_pressure_MPa: f64,
    /// Loaded transmission error over the cycle.
    pub transmission_error_um: RangeSummary,
    /// Amplitudes of the first mesh orders of the transmission error; empty where the positions do not reach over a base pitch.
    #[serde(default)]
    pub mesh_orders_um: Vec<f64>,
    /// Greatest |Σ loads of the pairs / load to carry − 1| at any position.
    pub load_imbalance: f64,
}

/// Difference of what both flanks lose in one mesh, relative to the greater: what one flank of a contact loses the other does too,
/// where both wear by the same coefficient.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct WearBalance {
    /// The unworn pair; `None` where the wear laws of the gears do not say how the volumes compare.
    pub new: Option<f64>,
    /// The worn one.
    pub worn: Option<f64>,
    /// Why they are not compared, where they are not.
    pub not_compared: Option<String>,
    /// How far what a flank of the unworn pair loses in one mesh is from its coefficient times load and sliding distance, k ∫ F ds, relative
    /// to that: the gear for which it is farther. `None` where a law does not say so by its coefficient alone, or where no gear wears.
    pub work_new: Option<f64>,
    /// Difference of the worn pair from k ∫ F ds.
    pub work_worn: Option<f64>,
}

/// Extremes and their difference.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct RangeSummary {
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Difference.
    pub peak_to_peak: f64,
}

/// Wear of a gear. Maxima over the face width leave 1/40 of it out at either end face, whatever the number of slices.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct WearSummary {
    /// Maximum wear depth on the active profile, the zone of the tip edge apart.
    pub peak_wear_um: f64,
    /// Radius where it is.
    pub peak_wear_radius_mm: f64,
    /// Maximum wear depth at the tip edge: within three Hertz half-widths at C, at most 0.15 modules, of the edge or of its rounding.
    pub tip_edge_wear_um: f64,
    /// Radius where it is.
    pub tip_edge_wear_radius_mm: f64,
    /// Maximum wear depth below the start of active profile.
    pub below_sap_wear_um: f64,
    /// Radius where it is.
    pub below_sap_wear_radius_mm: f64,
    /// Maximum wear depth in the first 2 mm of radius above the start of active profile.
    pub root_wear_um: f64,
    /// Wear depth at the working pitch circle.
    pub pitch_wear_um: f64,
    /// Worn off the whole gear: all teeth, whole width.
    pub worn_volume_mm3: f64,
    /// Worn off the whole gear: all teeth, whole width.
    pub worn_mass_mg: f64,
    /// Mass of the new gear as a disc as wide as its teeth, less the bore; of a ring up to the outside of its rim, without webs.
    #[serde(default)]
    pub mass_kg: f64,
    /// Normal tooth thickness left at the tip cylinder, reliefs and roundings not taken off: `tip_edge_wear_um` is.
    pub normal_tip_thickness_mm: f64,
    /// Mean wear W_m of VDI 2736-2, of an unchanged flank; `None` where neither gear is a plastic, or the wear law is more than a coefficient.
    #[serde(default)]
    pub vdi_2736_mean_wear_um: Option<f64>,
    /// Maximum wear depth over W_m.
    #[serde(default)]
    pub peak_over_vdi_2736_mean_wear: Option<f64>,
}

/// Work done by the wear simulation alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct WorkSummary {
    /// Wear steps taken.
    pub wear_steps: u64,
    /// Trial steps that were not taken: their error was too large, or the pair had no equilibrium at their end.
    pub rejected_steps: u64,
    /// Mesh cycles evaluated in wear steps, rejected ones included.
    pub stages: u64,
    /// Mesh cycles evaluated to learn how stiff the wear is: spectral radius, length of the first step.
    pub jacobian_probes: u64,
    /// Mesh cycles evaluated before the run, to learn how long a step of Euler's method may be; not among those of the run.
    pub stability_probes: u64,
    /// Mesh cycles evaluated in all: with Euler's method one per wear step, and one at the end.
    pub mesh_cycles: u64,
    /// Equilibria solved: mesh cycles × positions.
    pub equilibria: u64,
    /// Newton iterations in all equilibria together.
    pub newton_iterations: u64,
    /// Evaluations of a tooth pair's contact.
    pub pair_evaluations: u64,
}

/// One flank: slices one after the other over the face width (one where all sections are alike), each from root to tip.
///
/// Radius and roll angle have one value a point; the other fields of the flank one a point and slice, slice after slice.
#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlankRecord {
    /// Distance from the gear's axis, from base circle to tip circle, or from form circle to tip circle of an internal gear.
    pub radius_mm: Vec<f64>,
    /// Roll angle ρ/r_b of the transverse involute.
    pub roll_angle_deg: Vec<f64>,
    /// Place of each slice over the face width: its middle.
    pub width_mm: Vec<f64>,
    /// Material removed by the modifications.
    pub removed_um: Vec<f64>,
    /// Distance the point slides against the other flank during one mesh, new.
    pub sliding_mm_per_mesh: Vec<f64>,
    /// Wear depth at the end of the run.
    pub wear_um: Vec<f64>,
    /// Wear depth by the finite elements that verify the run; none without verification. Not a column of its own.
    pub verified_wear_um: Option<Vec<f64>>,
    /// Maximum pressure during one mesh, new.
    pub pressure_new_MPa: Vec<f64>,
    /// Maximum pressure during one mesh, worn.
    pub pressure_worn_MPa: Vec<f64>,
    /// Wear depth at each snapshot of the history.
    pub snapshot_wear_um: Vec<Vec<f64>>,
    /// Maximum pressure during one mesh at each snapshot of the history. No column.
    pub snapshot_pressure_MPa: Vec<Vec<f64>>,
    /// Radii worth marking: start of active profile (A on the pinion, E on the wheel) to tip.
    pub path_point_radius_mm: PathPoints,
    /// Zones of the flank, of which figures speak.
    pub zones: FlankZones,
}

impl FlankRecord {
    /// Number of the first point, from the root, that is not below `radius_mm`; towards the tip of an internal gear the radius falls.
    pub fn first_from(&self, radius_mm: f64) -> usize {
        match self.is_internal() {
            true => self.radius_mm.partition_point(|&radius| radius > radius_mm),
            false => self.radius_mm.partition_point(|&radius| radius < radius_mm),
        }
    }

    /// Whether the radius falls from root to tip.
    pub fn is_internal(&self) -> bool {
        self.radius_mm.first() > self.radius_mm.last()
    }
}

/// A row of `history.csv`.
#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HistoryRow {
    /// running time; empty where the scene gives no speed
    pub hours: Option<f64>,
    /// of the pinion
    pub revolutions: f64,
    /// maximum wear depth on the pinion's active profile, its tip edge apart
    pub pinion_peak_wear_um: f64,
    /// maximum wear depth in the first 2 mm of radius above the start of active profile
    pub pinion_root_wear_um: f64,
    /// wear depth at the working pitch circle
    pub pinion_pitch_wear_um: f64,
    /// the same of the wheel
    pub wheel_peak_wear_um: f64,
    /// maximum pressure at a single point during one mesh, sharp tip edges under load apart
    pub peak_pressure_MPa: f64,
    /// of the loaded pair, along the line of action
    pub transmission_error_peak_to_peak_um: f64,
    /// radius of the maximum wear depth on the active profile
    pub pinion_peak_wear_radius_mm: f64,
    /// wear depth at the start of active profile
    pub pinion_sap_wear_um: f64,
    /// growth there per million pinion revolutions
    pub pinion_sap_wear_rate_um_per_Mrev: f64,
    /// number of the phase of the operation, from 1; at the end of one, that one
    pub phase: usize,
    /// maximum pressure found at a sharp tip edge under load, which grows with every refinement; empty where there is
    /// none
    pub sharp_edge_pressure_MPa: Option<f64>,
    /// maximum wear depth at the pinion's tip edge
    pub pinion_tip_edge_wear_um: f64,
    /// the same of the wheel
    pub wheel_tip_edge_wear_um: f64,
    /// maximum wear depth below the pinion's start of active profile
    pub pinion_below_sap_wear_um: f64,
    /// the same of the wheel
    pub wheel_below_sap_wear_um: f64,
    /// maximum pressure between the tip-edge zones
    pub flank_pressure_MPa: f64,
    /// greatest line load of a contact that reaches a tip edge
    pub tip_edge_line_load_N_per_mm: f64,
}

/// A row of `mesh_cycle.csv`: the reference pair at one loading position.
#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MeshCycleRow {
    /// radius of curvature of the pinion's flank at the theoretical contact point
    pub position_mm: f64,
    /// share of the whole load that the pair carries, new
    pub load_share_new: f64,
    /// the same, worn
    pub load_share_worn: f64,
    /// maximum pressure of the pair, new
    pub peak_pressure_new_MPa: f64,
    /// the same, worn
    pub peak_pressure_worn_MPa: f64,
    /// half the extent of the contact strip, new
    pub half_width_mm: f64,
    /// approach along the line of action, positive under load, new
    pub transmission_error_new_um: f64,
    /// the same, worn
    pub transmission_error_worn_um: f64,
    /// maximum rise of the contact above the bulk by the chosen method, new; empty where not computed
    pub temperature_rise_K: Option<f64>,
    /// half the extent of the contact strip, worn
    pub half_width_worn_mm: f64,
    /// the rise by the transient heat equation, new; empty where not computed
    pub temperature_rise_heat_equation_K: Option<f64>,
    /// the same by Williams
    pub temperature_rise_williams_K: Option<f64>,
    /// the same by Tian and Kennedy
    pub temperature_rise_tian_kennedy_K: Option<f64>,
    /// Peclet number of the pinion's surface, new; empty where not computed
    pub peclet_pinion: Option<f64>,
    /// the same of the wheel's
    pub peclet_wheel: Option<f64>,
    /// whether a sharp tip edge cuts the contact off: its peak pressure is not defined, new
    pub at_sharp_edge_new: bool,
    /// the same, worn
    pub at_sharp_edge_worn: bool,
    /// rotation of the pinion from where its pair touches in the pitch point
    pub pinion_rotation_deg: f64,
    /// mesh stiffness of all pairs in contact about this load, per mm of face width: change of the load with the transmission error, new; empty where
    /// the model does not give it
    pub mesh_stiffness_new_N_per_mm_um: Option<f64>,
    /// the same, worn
    pub mesh_stiffness_worn_N_per_mm_um: Option<f64>,
}

/// Peak-to-peak transmission error from the beginning of a run to its end.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OverLifeSummary {
    /// Mean over the revolutions.
    pub mean_um: f64,
    /// Maximum of all wear steps.
    pub max_um: f64,
}

/// The mesh of one tooth slice by slice, from its first touch to its last.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SliceRecord {
    /// Place of each slice over the face width.
    pub width_mm: Vec<f64>,
    /// How far the theoretical contact point of each slice is ahead of that in the middle of the face width.
    pub ahead_mm: Vec<f64>,
    /// Position of the tooth in the middle of the face width: the pinion's radius of curvature, also before A and after E.
    pub position_mm: Vec<f64>,
    /// Load of each slice at each position, position after position, N per mm of face width; new.
    pub line_load_new_N_per_mm: Vec<f64>,
    /// Load of each slice at each position, worn.
    pub line_load_worn_N_per_mm: Vec<f64>,
    /// Maximum pressure of each slice at each position, new.
    pub peak_pressure_new_MPa: Vec<f64>,
    /// Maximum pressure of each slice at each position, worn.
    pub peak_pressure_worn_MPa: Vec<f64>,
    /// Whether a sharp tip edge cuts off the contact of each slice at each position, new.
    pub at_sharp_edge_new: Vec<bool>,
    /// Sharp tip edges at each position, worn.
    pub at_sharp_edge_worn: Vec<bool>,
}
