//! Time and memory that a run will take, from its scene alone: what is said before it begins.
//!
//! Work is counted in the sizes that it grows with: positions, slices, mesh cycles, flank points in a contact. The time of each unit was measured once,
//! on one thread of a core of some 3 GHz. Mesh cycles follow from the mean depth of VDI 2736 over the tolerance of adaptive steps. What shows only when
//! the gears wear, such as how often a severe law switches, leaves an estimate; the example `run_costs` of the validation holds it against random scenes.

use serde::Serialize;

use super::{
    Plan, StageKind, is_estimated_by_verification, is_finest_in_space, memory_in_space_gb, memory_of_slices_gb,
};
use crate::contact::hertz;
use crate::contact::settings::SurfaceKind;
use crate::operation::Scene;
use crate::simulation::settings::Stepping;
use crate::wear::settings::WearOfPair;
use crate::wear::vdi_2736::mean_wear_mm;
use gearwear_bodies::gear::{Gear, GearPair};

/// Time above which a run says at its beginning what it takes, s.
const MUCH_TIME_S: f64 = 20.0;
/// Memory above which it does, GB.
const MUCH_MEMORY_GB: f64 = 1.0;
/// Mesh cycles that the preparation of all positions stands for.
const PREPARATION_CYCLES: f64 = 4.0;
/// Mesh cycles of a run whose depth is not that of a constant coefficient.
const USUAL_CYCLES: f64 = 15.0;
/// Ratio of depth to tolerance from which mesh cycles grow no more: steps are then as long as stability allows.
const DEEP: f64 = 400.0;
/// Mesh cycles with severe wear over those without.
const SEVERE: f64 = 4.0;
/// Part of the wear run that error estimates take, which evaluate half of the points and positions.
const ERROR_ESTIMATES: f64 = 0.7;
/// Tolerance of the steps of a verification, mm.
const VERIFIED_TOLERANCE_MM: f64 = 5e-5;
/// Contacts of a verification over those of the run, in slices: of a run on the finest model, on half as many slices, and of others.
const VERIFIED_CONTACTS: [f64; 2] = [0.5, 1.0];
/// Flank points in a contact that the times of a position are measured with, and the power with which these grow.
const POINTS: (f64, f64) = (20.0, 0.6);
/// Flank points that take as long as a position on half-planes in slices: all pass through contact, however few the positions. Measured on the preset
/// `helical` with 45 to 185 positions; on other surfaces, and without slices, the time is that of the positions.
const POINTS_OF_POSITION: f64 = 12.0;
/// Time of the output of a flank point of a slice, s.
const OUTPUT_S: f64 = 9e-6;
/// Plane finite elements of a pair: time of a model, s, and of a position of the mesh cycle, s; memory, GB.
const PLANE_ELEMENTS: (f64, f64, f64) = (0.12, 60e-6, 0.1);
/// Positions of the mesh cycle of a verification on plane finite elements.
const PLANE_POSITIONS: f64 = 200.0;
/// Time of three-dimensional finite elements over the square of the number of elements over the face width, s.
const IN_SPACE_S: f64 = 0.0042;
/// Memory of a program that has begun, GB.
const PROGRAM_GB: f64 = 0.01;

/// Cost of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunCost {
    /// Time of all stages on one thread, s.
    pub seconds: f64,
    /// Peak memory, GB.
    #[serde(rename = "memory_GB")]
    pub memory_gb: f64,
    /// Time of each stage that takes any, s.
    pub stages: Vec<StageCost>,
}

/// Plan of a run with its cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanAndCost {
    /// Stages, and those left out.
    #[serde(flatten)]
    pub plan: Plan,
    /// Cost of the run.
    pub cost: RunCost,
}

/// Cost of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StageCost {
    /// Kind of stage.
    #[serde(rename = "name")]
    pub kind: StageKind,
    /// Time on one thread, s.
    pub seconds: f64,
}

impl RunCost {
    /// Cost of a run of `scene`, whose gears are `pair`, as `plan` says.
    pub fn of(scene: &Scene, plan: &Plan, pair: &GearPair) -> Self {
        let work = Work::of(scene, pair);
        let all =
            plan.stages.iter().map(|stage| StageCost { kind: stage.kind, seconds: work.seconds(stage.kind, scene) });
        let stages: Vec<StageCost> = all.filter(|stage| stage.seconds > 0.0).collect();
        let elements = if plan.has(StageKind::FiniteElementModel) { PLANE_ELEMENTS.2 } else { 0.0 };
        let in_space = if plan.has(StageKind::TeethInSpace) { memory_in_space_gb(scene) } else { 0.0 };
        let memory_gb = PROGRAM_GB + elements + in_space + memory_of_slices_gb(scene);
        Self { seconds: stages.iter().map(|stage| stage.seconds).sum(), memory_gb, stages }
    }

    /// In words, where it is much.
    pub fn announcement(&self) -> Option<String> {
        if self.seconds <= MUCH_TIME_S && self.memory_gb <= MUCH_MEMORY_GB {
            return None;
        }
        let most = self.stages.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        Some(format!(
            "the run takes some {:.0} s on one thread, {:.0} s of them for the {}, and {:.1} GB; fewer helical.slices, numerics.positions or \
             loads of operation.phases, or numerics.verify = false take less",
            self.seconds,
            most.seconds,
            most.kind.name(),
            self.memory_gb
        ))
    }
}

/// Sizes that the work of a scene grows with.
struct Work {
    /// Positions of the mesh cycle, of all loads.
    positions: f64,
    /// Flank points, of all loads.
    points: f64,
    mesh_cycles: f64,
    /// Mesh cycles of the verification, whose steps are adaptive.
    verified_cycles: f64,
    slices: Option<f64>,
    /// Flank points in a contact at the pitch point, with [`POINTS`].
    of_points: f64,
}

impl Work {
    fn of(scene: &Scene, pair: &GearPair) -> Self {
        let load = pair.line_load_n_per_mm(scene.operation.torque_range_n_mm()[1]);
        let at_pitch = hertz::flattening(&pair.normal_section(), &scene.material, pair.path.pitch_point_mm);
        let contact = at_pitch.contact.loaded(load);
        let flank_mm = pair.teeth.pinion.involute.arc_mm(pair.teeth.pinion.tip_rho_mm());
        let points = 2.0 * contact.half_width_mm / flank_mm * scene.numerics.flank_points as f64;
        let severe = scene.wear.is_severe_under(contact.peak_pressure_mpa, 0.5);
        let more = if severe { SEVERE } else { 1.0 };
        Self {
            positions: scene.numerics.positions as f64 * super::loads(scene),
            points: scene.numerics.flank_points as f64 * super::loads(scene),
            mesh_cycles: mesh_cycles(scene, pair, more),
            verified_cycles: more * adaptive_cycles(scene, pair, VERIFIED_TOLERANCE_MM) + PREPARATION_CYCLES,
            slices: scene.slices.map(|slices| slices.count as f64),
            of_points: (points / POINTS.0).max(0.5).powf(POINTS.1),
        }
    }

    /// Time of a stage, s.
    fn seconds(&self, kind: StageKind, scene: &Scene) -> f64 {
        let cycles = self.mesh_cycles + PREPARATION_CYCLES;
        let (model_s, position_s, _) = PLANE_ELEMENTS;
        match kind {
            StageKind::FiniteElementModel | StageKind::FiniteElementCalibration => model_s,
            StageKind::TeethInSpace => IN_SPACE_S * (super::layers_in_space(scene) as f64).powi(2),
            StageKind::StepBound => self.wear_run(scene.contact.surface, PREPARATION_CYCLES),
            StageKind::Simulation => self.wear_run(scene.contact.surface, cycles),
            StageKind::ErrorEstimates if is_estimated_by_verification(scene) => 0.0,
            StageKind::ErrorEstimates => ERROR_ESTIMATES * self.seconds(StageKind::Simulation, scene),
            StageKind::Verification if self.slices.is_some() => {
                let [of_finest, of_others] = VERIFIED_CONTACTS;
                let contacts = if is_finest_in_space(scene) { of_finest } else { of_others };
                contacts * self.wear_run(SurfaceKind::HalfSpace, self.verified_cycles)
            }
            StageKind::Verification => position_s * PLANE_POSITIONS * self.verified_cycles + model_s,
            StageKind::Report => {
                OUTPUT_S * scene.numerics.flank_points as f64 * self.slices.map_or(0.0, |slices| 2.0 * slices)
            }
            _ => 0.0,
        }
    }

    /// Time of a wear run on a surface, s.
    fn wear_run(&self, surface: SurfaceKind, cycles: f64) -> f64 {
        let positions = match surface {
            SurfaceKind::HalfSpace if self.slices.is_some() => self.positions + self.points / POINTS_OF_POSITION,
            _ => self.positions,
        };
        let evaluations = positions * cycles;
        let [plane_us, of_slice_us] = match surface {
            SurfaceKind::Fem => return PLANE_ELEMENTS.1 * evaluations,
            SurfaceKind::HalfSpace => [8.0, 10.0],
            SurfaceKind::Winkler => [3.0, 8.0],
            SurfaceKind::Hertz => [2.5, 8.0],
            SurfaceKind::HertzMean => [1.0, 0.1],
        };
        1e-6 * self.of_points * evaluations * self.slices.map_or(plane_us, |slices| of_slice_us * slices)
    }
}

/// Mesh cycles of a wear run; `of_severe`: those of adaptive steps over those without severe wear.
fn mesh_cycles(scene: &Scene, pair: &GearPair, of_severe: f64) -> f64 {
    let snapshots = scene.operation.snapshots_revolutions.len() as f64;
    match scene.numerics.stepping {
        Stepping::Fixed { revolutions } => (scene.operation.pinion_revolutions / revolutions).ceil() + snapshots,
        Stepping::Adaptive { tolerance_mm } => {
            (of_severe * adaptive_cycles(scene, pair, tolerance_mm)).max(2.0 * snapshots)
        }
    }
}

/// Mesh cycles of adaptive steps without severe wear.
fn adaptive_cycles(scene: &Scene, pair: &GearPair, tolerance_mm: f64) -> f64 {
    let depth = Gear::BOTH.map(|gear| {
        let stretches = scene.steady_wear(gear, scene.operation.pinion_revolutions)?;
        Some(mean_wear_mm(pair, gear, stretches.into_iter()))
    });
    let of_depth = |depth: f64| 10.0 + 3.0 * (depth / tolerance_mm).min(DEEP).sqrt();
    let [pinion, wheel] = depth.map(|depth| depth.map_or(USUAL_CYCLES, of_depth));
    pinion.max(wheel)
}
