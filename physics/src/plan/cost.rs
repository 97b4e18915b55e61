//! Time and memory that a run will take, from its scene alone: what is announced before it begins.
//!
//! Work is counted in the sizes that it grows with (positions, slices, points in a contact, wear steps), and times of each were measured once, on one
//! thread of a core of some 3 GHz ([`SECONDS`]). The number of wear steps follows from the depth that VDI 2736 expects over the tolerance. What the
//! program cannot know before it runs, such as how often a severe law switches, leaves the announcement within a factor of two or so of most runs.

use crate::contact::hertz;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::settings::Coupling;
use crate::operation::Scene;
use crate::plan::{Plan, StageKind, memory_in_space_gb, memory_of_slices_gb};
use crate::simulation::settings::Stepping;
use crate::wear::settings::WearOfPair;
use crate::wear::vdi_2736::{SteadyWear, mean_wear_mm};
use gearwear_bodies::gear::{Gear, GearPair, PairError};

/// Work of a scene.
struct Work {
    /// Positions of the mesh cycle on springs, of all loads.
    positions: f64,
    /// Mesh cycles of the wear run.
    mesh_cycles: f64,
    slices: f64,
    /// Flank points in a contact under the whole load at the pitch point.
    points_in_contact: f64,
    /// Nodes of the finite elements of both flanks.
    nodes: f64,
}

/// Cost of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunCost {
    /// Time of each stage on one thread, s.
    pub parts: Vec<(StageKind, f64)>,
    /// Time of all, s.
    pub seconds: f64,
    /// Peak memory, GB.
    pub memory_gb: f64,
    pub debug: Vec<f64>,
}

impl RunCost {
    /// Cost of a run of `scene`.
    ///
    /// # Errors
    /// A pair that cannot exist.
    pub fn of(scene: &Scene) -> Result<Self, PairError> {
        let pair = GearPair::new(&scene.pair)?;
        let plan = Plan::of(scene);
        let work = Work::of(scene, &pair);
        let parts: Vec<(StageKind, f64)> =
            plan.stages.iter().map(|stage| (stage.kind, work.seconds(stage.kind, scene))).collect();
        Ok(Self {
            seconds: parts.iter().map(|(_, seconds)| seconds).sum(),
            memory_gb: work.memory_gb(scene, &plan),
            parts,
            debug: vec![
                work.positions,
                work.mesh_cycles,
                work.slices,
                work.points_in_contact,
                work.nodes,
                scene.wear.severe_factor_under(1e9).unwrap_or(1.0),
                scene.operation.snapshots_revolutions.len() as f64,
            ],
        })
    }
}

impl Work {
    fn of(scene: &Scene, pair: &GearPair) -> Self {
        let load = pair.line_load_n_per_mm(scene.operation.torque_range_n_mm()[1]);
        let at_pitch = hertz::flattening(&pair.normal_section(), &scene.material, pair.path.pitch_point_mm);
        let half_width_mm = at_pitch.contact.loaded(load).half_width_mm;
        let flank_mm: f64 = pair.teeth.pinion.involute.arc_mm(pair.teeth.pinion.tip_rho_mm());
        let element_mm = half_width_mm / scene.wear_elements_per_half_width;
        let nodes = Gear::BOTH.map(|gear| {
            let tooth = &pair.teeth[gear];
            let active_mm = tooth.tip_radius_mm - pair.active_start_radius_mm(gear);
            let rounding = scene.pair.tip_rounding_mm(gear).max(0.1 * half_width_mm);
            active_mm / element_mm + 40.0 * half_width_mm / rounding
        });
        Self {
            positions: scene.numerics.positions as f64 * scene.operation.phases.len() as f64,
            mesh_cycles: mesh_cycles(scene, pair),
            slices: scene.slices.map_or(1.0, |slices| slices.count as f64),
            points_in_contact: 2.0 * half_width_mm / flank_mm * scene.numerics.flank_points as f64,
            nodes: nodes.iter().sum(),
        }
    }

    /// Time of a stage, s.
    fn seconds(&self, kind: StageKind, scene: &Scene) -> f64 {
        let per_position = 1e-6 * self.points_in_contact.max(10.0);
        match kind {
            StageKind::FiniteElementModel => 1e-6 * self.nodes.powi(2),
            StageKind::Simulation => per_position * self.positions * self.slices * self.mesh_cycles,
            _ => 0.0,
        }
    }

    fn memory_gb(&self, scene: &Scene, plan: &Plan) -> f64 {
        let in_space = if plan.has(StageKind::TeethInSpace) { memory_in_space_gb(scene) } else { 0.0 };
        0.03 + in_space + memory_of_slices_gb(scene)
    }
}

/// Mesh cycles of a wear run.
fn mesh_cycles(scene: &Scene, pair: &GearPair) -> f64 {
    match scene.numerics.stepping {
        Stepping::Fixed { revolutions } => (scene.operation.pinion_revolutions / revolutions).ceil(),
        Stepping::Adaptive { tolerance_mm } => {
            let depth = Gear::BOTH.map(|gear| depth_mm(scene, pair, gear));
            let over_tolerance = depth[0].max(depth[1]) / tolerance_mm;
            10.0 + 3.0 * over_tolerance.sqrt()
        }
    }
}

/// Mean wear depth that VDI 2736 expects of a gear with the coefficients of its phases.
fn depth_mm(scene: &Scene, pair: &GearPair, gear: Gear) -> f64 {
    let mut begin = 0.0;
    let stretches = scene.operation.phases.iter().map(|phase| {
        let revolutions = phase.end_revolutions - begin;
        begin = phase.end_revolutions;
        let coefficient_mm2_per_n = scene.wear_in(phase)[gear].coefficient_mm2_per_n;
        SteadyWear { coefficient_mm2_per_n, pinion_torque_n_mm: phase.pinion_torque_n_mm, revolutions }
    });
    mean_wear_mm(pair, gear, stretches)
}
