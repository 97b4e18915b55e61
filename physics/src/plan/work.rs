//! Work of the stages of a run, counted in the sizes that it grows with, and the time and memory of each unit.
//!
//! Units were measured once, on one thread of a core of some 2.5 GHz; nodes, multipliers, positions and mesh cycles are fitted to those of 147 runs on elements (the
//! preset `fzg-c` with tip roundings from 0 to 0.4 mm under 30 to 600 N·m, and random pairs). Mesh cycles are those of Runge–Kutta–Chebyshev's steps. Their stages grow with the root
//! of the stiffness of wear, its depth over the deflection across the distance of two points, and steps with the depth over the tolerance T:
//!
//! ```text
//! s = 2 h E* / (p Δ)      cycles = c₀ + c₁ √s (1 + 2 h/T)^0.3
//! ```
//!
//! h: mean depth of VDI 2736, half of the greatest or less; p: greatest pressure at the pitch point; Δ: distance of points or nodes.
//! What shows only when the gears wear, such as how often a severe law switches, leaves an estimate.

use super::{
    Plan, StageKind, is_estimated_by_verification, is_finest_in_space, layers_in_space, loads, memory_in_space_gb,
};
use crate::contact::hertz;
use crate::contact::settings::SurfaceKind;
use crate::operation::{
    COARSER, HARDLY_WORN_BULGES, LEAST_HALF_WIDTH_MODULES, ON_HARDLY_WORN_EDGES, Scene, VERIFIED_POSITIONS,
    VERIFIED_TOLERANCE,
};
use crate::simulation::settings::Stepping;
use crate::wear::settings::WearOfPair;
use crate::wear::vdi_2736::mean_wear_mm;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_bodies::gear_mesh::settings::rounding_element_mm;
use gearwear_bodies::material::{Material, contact_modulus_mpa};

/// Ratio of the greatest wear depth to the mean.
const GREATEST_DEPTH: f64 = 2.0;
/// Mean depth where the coefficient is not constant, mm.
const USUAL_DEPTH_MM: f64 = 1e-4;
/// Mesh cycles that finding the step bound takes.
const STEP_BOUND_CYCLES: f64 = 6.0;
/// Time of error estimates over that of the wear run: with severe wear, which runs twice more; in fixed steps, which run on half of the points; in adaptive ones.
const ERROR_ESTIMATES: [f64; 3] = [2.2, 0.8, 0.15];
/// Flank points that take as long as a position on half-planes in slices: all pass through contact, however few the positions. Measured on the preset
/// `helical` with 45 to 185 positions; on other surfaces, and without slices, the time is that of the positions.
const POINTS_OF_POSITION: f64 = 12.0;
/// Positions of the verification of slices, its least number of slices, and its slices over the run's own.
const VERIFIED_SLICES: (f64, f64, f64) = (150.0, 26.0, 1.3);
/// Time of the output, and of that of a flank point of a slice, s.
const OUTPUT_S: [f64; 2] = [0.06, 9e-6];
/// Time of three-dimensional finite elements over the square of the number of elements over the face width, s.
const IN_SPACE_S: f64 = 0.005;
/// Memory of a program that has begun, without and with slices, and of one that has plane finite elements, GB.
const PROGRAM_GB: [f64; 3] = [0.016, 0.035, 0.065];

/// Mesh cycles of a run, or of a verification.
#[derive(Clone, Copy)]
struct CycleCounts {
    /// c₀.
    least: f64,
    /// c₁.
    of_root: f64,
    /// Those with severe wear over those without.
    severe: f64,
    verifies: bool,
}

/// Exponent of the depth over the tolerance in the number of steps.
const STEPS_OF_DEPTH: f64 = 0.3;
/// Mesh cycles from which they grow no more: the wear of flanks that hardly touch is not as stiff as this.
const MOST_CYCLES: f64 = 1000.0;
const ON_POINTS: CycleCounts = CycleCounts { least: 7.0, of_root: 1.35, severe: 2.0, verifies: false };
const ON_ELEMENTS: CycleCounts = CycleCounts { least: 12.3, of_root: 2.8, severe: 2.5, verifies: false };
const OF_VERIFIED_ELEMENTS: CycleCounts = CycleCounts { least: 4.4, of_root: 2.8, severe: 1.0, verifies: true };
const OF_VERIFIED_SLICES: CycleCounts = CycleCounts { least: 5.0, of_root: 2.8, severe: 4.0, verifies: true };

/// Contact at the pitch point under the greatest load, and the wear that is expected.
struct PitchContact {
    half_width_mm: f64,
    /// Greatest pressure over E*.
    strain: f64,
    /// Mean wear depth of the gear that wears more, mm.
    depth_mm: f64,
    /// Tolerance of adaptive steps, and of those of a verification, mm.
    tolerances_mm: [f64; 2],
    is_severe: bool,
}

/// Sizes that the work of a scene grows with.
pub(super) struct Work {
    contact: PitchContact,
    /// Positions of the mesh cycle, of all loads.
    positions: f64,
    /// Flank points, of all loads.
    points: f64,
    /// Distance of flank points, mm.
    point_mm: f64,
    /// Number of loads.
    loads: f64,
    slices: Option<f64>,
    mesh_cycles: f64,
    /// Finite elements of the run, and of its verification.
    elements: [PlaneElements; 2],
}

/// Work on plane finite elements.
struct PlaneElements {
    /// Nodes of the flanks of both gears.
    nodes: [f64; 2],
    /// Multipliers of a position, root of their mean square.
    multipliers: f64,
    /// Positions in a base pitch, of all loads.
    positions: f64,
    /// Of adaptive steps.
    mesh_cycles: f64,
    /// Whether they are not those of the scene.
    are_own: bool,
}

impl PitchContact {
    fn of(scene: &Scene, pair: &GearPair) -> Self {
        let load = pair.line_load_n_per_mm(scene.operation.torque_range_n_mm()[1]);
        let at_pitch = hertz::flattening(&pair.normal_section(), &scene.material, pair.path.pitch_point_mm);
        let contact = at_pitch.contact.loaded(load);
        let depth_mm = Gear::BOTH.map(|gear| {
            let stretches = scene.steady_wear(gear, scene.operation.pinion_revolutions)?;
            Some(mean_wear_mm(pair, gear, stretches.into_iter()))
        });
        let deepest_mm = depth_mm.into_iter().flatten().fold(0.0, f64::max);
        let depth_mm = if deepest_mm > 0.0 { deepest_mm } else { USUAL_DEPTH_MM };
        let verifying_mm = VERIFIED_TOLERANCE * GREATEST_DEPTH * depth_mm;
        Self {
            half_width_mm: contact.half_width_mm,
            strain: contact.peak_pressure_mpa / contact_modulus_mpa(scene.material.map(Material::elastic)),
            depth_mm,
            tolerances_mm: match scene.numerics.stepping {
                Stepping::Adaptive { tolerance_mm } => [tolerance_mm, verifying_mm],
                Stepping::Fixed { .. } => [verifying_mm; 2],
            },
            is_severe: scene.wear.is_severe_under(contact.peak_pressure_mpa, 0.5),
        }
    }

    /// Mesh cycles of adaptive steps where points or nodes are `apart_mm` apart.
    fn cycles(&self, CycleCounts { least, of_root, severe, verifies }: CycleCounts, apart_mm: f64) -> f64 {
        let greatest_mm = GREATEST_DEPTH * self.depth_mm;
        let stages = (greatest_mm / (self.strain * apart_mm)).sqrt();
        let steps = (1.0 + greatest_mm / self.tolerances_mm[usize::from(verifies)]).powf(STEPS_OF_DEPTH);
        let cycles = (least + of_root * stages * steps) * if self.is_severe { severe } else { 1.0 };
        cycles.min(MOST_CYCLES)
    }
}

impl Work {
    pub(super) fn of(scene: &Scene, pair: &GearPair) -> Self {
        let contact = PitchContact::of(scene, pair);
        let point_mm = flank_mm(pair, Gear::Pinion) / scene.numerics.flank_points as f64;
        let snapshots = scene.operation.snapshots_revolutions.len() as f64;
        let loads = loads(scene);
        let fixed = match scene.numerics.stepping {
            Stepping::Fixed { revolutions } => {
                Some((scene.operation.pinion_revolutions / revolutions).ceil() + snapshots)
            }
            Stepping::Adaptive { .. } => None,
        };
        let elements = [false, true].map(|verifies| PlaneElements::of(scene, pair, &contact, verifies));
        let adaptive = match scene.contact.surface {
            SurfaceKind::Fem => elements[0].mesh_cycles,
            _ => contact.cycles(ON_POINTS, point_mm),
        };
        Self {
            mesh_cycles: fixed.unwrap_or(adaptive.max(2.0 * snapshots)),
            contact,
            positions: scene.numerics.positions as f64 * loads,
            points: scene.numerics.flank_points as f64 * loads,
            point_mm,
            loads,
            slices: scene.slices.map(|slices| slices.count as f64),
            elements,
        }
    }

    /// Time of a stage, s.
    pub(super) fn seconds(&self, kind: StageKind, scene: &Scene) -> f64 {
        let [own, verifying] = &self.elements;
        let surface = scene.contact.surface;
        let positions = match surface {
            SurfaceKind::HalfSpace if self.slices.is_some() => self.positions + self.points / POINTS_OF_POSITION,
            _ => self.positions,
        };
        let contacts = positions * self.slices.unwrap_or(1.0);
        match kind {
            StageKind::FiniteElementModel | StageKind::FiniteElementCalibration => own.model_s(),
            StageKind::TeethInSpace => IN_SPACE_S * (layers_in_space(scene) as f64).powi(2),
            StageKind::StepBound => self.wear_run(surface, contacts, STEP_BOUND_CYCLES),
            StageKind::Simulation => self.wear_run(surface, contacts, self.mesh_cycles),
            StageKind::ErrorEstimates if is_estimated_by_verification(scene) => 0.0,
            StageKind::ErrorEstimates => {
                let [severe, fixed, adaptive] = ERROR_ESTIMATES;
                let over_run = match scene.numerics.stepping {
                    _ if scene.wear.may_be_severe() => severe,
                    Stepping::Fixed { .. } => fixed,
                    Stepping::Adaptive { .. } => adaptive,
                };
                over_run * self.seconds(StageKind::Simulation, scene)
            }
            StageKind::Verification => match self.verified_slices(scene) {
                Some(verified) => {
                    let contacts = VERIFIED_SLICES.0 * self.loads * verified;
                    let cycles = self.contact.cycles(OF_VERIFIED_SLICES, self.point_mm);
                    self.wear_run(SurfaceKind::HalfSpace, contacts, cycles)
                }
                None => {
                    verifying.wear_run_s(verifying.mesh_cycles)
                        + if verifying.are_own { verifying.model_s() } else { 0.0 }
                }
            },
            StageKind::Report => {
                let [least, of_point] = OUTPUT_S;
                let slices = self.slices.unwrap_or_default();
                least + 2.0 * of_point * slices * scene.numerics.flank_points as f64
            }
            _ => 0.0,
        }
    }

    /// Slices of a verification; none of a plane one.
    fn verified_slices(&self, scene: &Scene) -> Option<f64> {
        let (_, least, over_own) = VERIFIED_SLICES;
        let own = self.slices?;
        Some(if is_finest_in_space(scene) { over_own * own } else { own.max(least) })
    }

    /// Flank points in a contact at the pitch point.
    fn in_contact(&self) -> f64 {
        2.0 * self.contact.half_width_mm / self.point_mm
    }

    /// Time of a wear run on so many contacts, s.
    fn wear_run(&self, surface: SurfaceKind, contacts: f64, cycles: f64) -> f64 {
        let (prepared_us, cycle_us) = match (surface, self.slices.is_some()) {
            (SurfaceKind::Fem, _) => return self.elements[0].wear_run_s(cycles),
            (SurfaceKind::HalfSpace, false) => (160.0, 16.0),
            (SurfaceKind::HalfSpace, true) => (95.0, 11.0),
            (SurfaceKind::Winkler, false) => (95.0, 5.5),
            (SurfaceKind::Winkler, true) => (50.0, 6.5),
            (SurfaceKind::Hertz, false) => (45.0, 4.0),
            (SurfaceKind::Hertz, true) => (28.0, 6.5),
            (SurfaceKind::HertzMean, false) => (25.0, 0.6),
            (SurfaceKind::HertzMean, true) => (0.8, 0.3),
        };
        // Measured with 20 points in contact.
        let of_points = ((10.0 + self.in_contact()) / 30.0).powf(0.6);
        1e-6 * of_points * contacts * (prepared_us + cycles * cycle_us)
    }

    /// Peak memory, GB.
    pub(super) fn memory_gb(&self, scene: &Scene, plan: &Plan) -> f64 {
        let [without, with_slices, with_elements] = PROGRAM_GB;
        let [own, verifying] = &self.elements;
        let plane = if plan.has(StageKind::FiniteElementModel) { with_elements + own.model_gb() } else { without };
        let is_verified = plan.has(StageKind::Verification);
        let Some(slices) = self.slices else {
            let own = if scene.contact.surface == SurfaceKind::Fem { own.positions_gb(self.loads) } else { 0.0 };
            return plane + own.max(if is_verified { verifying.positions_gb(self.loads) } else { 0.0 });
        };
        let own = self.sliced_gb(scene.contact.surface, slices, self.positions / self.loads);
        let contacts = match self.verified_slices(scene).filter(|_| is_verified) {
            Some(verified) => own.max(self.sliced_gb(SurfaceKind::HalfSpace, verified, VERIFIED_SLICES.0)),
            None => own,
        };
        let [sectors, coupled] = if plan.has(StageKind::TeethInSpace) { memory_in_space_gb(scene) } else { [0.0; 2] };
        // Sectors are condensed before the contacts are prepared.
        plane.max(with_slices + sectors.max(contacts + coupled))
    }

    /// Memory of the contacts of so many slices at positions of one load, and of the points of their flanks, GB.
    fn sliced_gb(&self, surface: SurfaceKind, slices: f64, positions: f64) -> f64 {
        let (contact_kb, in_contact_kb, point_kb) = match surface {
            SurfaceKind::HalfSpace => (4.7, 0.17, 3.3),
            SurfaceKind::Winkler => (5.7, 0.36, 2.1),
            SurfaceKind::Hertz => (5.0, 0.15, 1.8),
            SurfaceKind::HertzMean | SurfaceKind::Fem => (0.5, 0.0, 1.1),
        };
        let of_contacts_kb = positions * (contact_kb + in_contact_kb * self.in_contact());
        1e-6 * slices * (of_contacts_kb + point_kb * self.points / self.loads)
    }
}

impl PlaneElements {
    fn of(scene: &Scene, pair: &GearPair, contact: &PitchContact, verifies: bool) -> Self {
        let is_coarser = verifies && scene.contact.surface == SurfaceKind::Fem;
        let coarser = if is_coarser { COARSER } else { 1.0 };
        let in_half_width = scene.wear_elements_per_half_width / coarser;
        let positions = match (is_coarser, verifies) {
            (false, true) => VERIFIED_POSITIONS as f64,
            _ => scene.numerics.positions as f64 / coarser,
        };
        let half_width_mm = if scene.contact.surface == SurfaceKind::Fem {
            // a² is proportional to the load.
            contact.half_width_mm * (scene.meshed_torque_n_mm() / scene.operation.torque_range_n_mm()[1]).sqrt()
        } else {
            // Narrower contact is meshed as this.
            contact.half_width_mm.max(LEAST_HALF_WIDTH_MODULES * pair.spec.normal_module_mm)
        };
        let rounding_mm = Gear::BOTH.map(|gear| pair.spec.tip_rounding_mm(gear));
        let rounded = || rounding_mm.into_iter().filter(|rounding| *rounding > 0.0);
        let on_rounding_mm = |refinement: f64| {
            rounded().map(move |rounding| (rounding, rounding_element_mm(rounding, in_half_width, refinement)))
        };
        let is_hardly_worn = on_rounding_mm(1.0)
            .any(|(radius, element)| contact.depth_mm < HARDLY_WORN_BULGES * element.powi(2) / (8.0 * radius));
        let refinement = if verifies && is_hardly_worn { ON_HARDLY_WORN_EDGES } else { 1.0 };
        let shortest_mm =
            on_rounding_mm(refinement).map(|(_, element)| element).fold(half_width_mm / in_half_width, f64::min);
        // Elements of a rounding reach over the flank that it touches, as far as the contact is wide; they grow away from it, so that sharper roundings ask
        // for no more of them in the end.
        let of_rounding = |rounding_mm: f64, enough: f64| {
            if rounding_mm > 0.0 { -(-half_width_mm / (enough * rounding_mm)).exp_m1() } else { 0.0 }
        };
        let [pinion, wheel] = rounding_mm;
        let nodes = [(Gear::Pinion, pinion, wheel), (Gear::Wheel, wheel, pinion)].map(|(gear, own, mate)| {
            let of_flank = 8.2 + 1.59 * flank_mm(pair, gear) / half_width_mm;
            let of_own = if own > 0.0 { 8.3 * refinement } else { 0.0 };
            in_half_width * (of_flank + of_own + 343.0 * of_rounding(mate, 15.0 / refinement))
        });
        let even_mm = (pair.path.end_mm - pair.path.start_mm) / positions;
        let [away_mm, edges_mm] = [(0.5, 0.5, 4.0), (0.15, 0.25, 1.0)]
            .map(|(part, least, most)| (part * half_width_mm).max(least * even_mm).min(most * even_mm));
        let pitch_mm = pair.path.base_pitch_mm;
        let of_edges_mm = pitch_mm.min(8.0 * half_width_mm);
        // Positions at tip edges have the more multipliers, and are the more of all the wider the contact is.
        let over_pitch = half_width_mm / pitch_mm;
        let enough = 2.9 * refinement.powf(-0.4);
        let at_edges: f64 = rounding_mm.into_iter().map(|rounding_mm| of_rounding(rounding_mm, enough)).sum();
        let of_edges = 1.03e6 * refinement.powf(0.86) * at_edges * over_pitch.powf(1.33);
        let mean_square = 1220.0 + of_edges + 12_900.0 * over_pitch;
        Self {
            nodes,
            multipliers: in_half_width / 3.0 * mean_square.sqrt(),
            positions: 1.19 * loads(scene) * ((pitch_mm - of_edges_mm) / away_mm + of_edges_mm / edges_mm),
            mesh_cycles: contact.cycles(if verifies { OF_VERIFIED_ELEMENTS } else { ON_ELEMENTS }, shortest_mm),
            are_own: refinement > 1.0 || is_coarser,
        }
    }

    /// Time to mesh and to condense both gears, s.
    fn model_s(&self) -> f64 {
        self.nodes.iter().map(|nodes| 0.013 + 1e-4 * nodes + 8e-8 * nodes * nodes).sum()
    }

    /// Time of a wear run, its preparation included, s.
    fn wear_run_s(&self, cycles: f64) -> f64 {
        let squared = self.multipliers.powi(2);
        1e-6 * self.positions * (330.0 + 0.07 * squared + cycles * (10.0 + 0.0023 * squared))
    }

    /// Memory of the condensed gears, GB.
    fn model_gb(&self) -> f64 {
        6.7e-8 * self.nodes.iter().map(|nodes| nodes * nodes).sum::<f64>()
    }

    /// Memory of the positions of one of so many loads, GB: some three matrices of the multipliers each.
    fn positions_gb(&self, loads: f64) -> f64 {
        2.3e-8 * self.positions / loads * self.multipliers.powi(2)
    }
}

/// Length of a flank along its involute, mm.
fn flank_mm(pair: &GearPair, gear: Gear) -> f64 {
    pair.teeth[gear].involute.arc_mm(pair.teeth[gear].tip_rho_mm())
}
