//! The mesh cycle: load and wear of the tooth pairs while one pair passes from A to E.
//!
//! The cycle is cut into loading positions. At each, all pairs in mesh share the load in equilibrium
//! ([`load_sharing`]); then the pressure of the reference pair sweeps over its flank points and wears them. Positions
//! are independent of each other and are dealt to threads in fixed groups, whose wear is added in order: the result does not depend on the
//! number of threads.

pub mod bent_tooth;
mod collected;
pub mod condensed;
mod condensed_contact;
pub mod coupled_teeth;
mod half_layers;
pub(crate) mod influence;
mod line_of_action;
pub mod load_sharing;
pub(crate) mod local_means;
pub mod mesh_orders;
pub mod over_life;
pub mod pair_in_space;
pub(crate) mod part_of_slice;
pub mod positions;
pub mod settings;
pub mod simplified;
pub mod slice_coupling;
pub(crate) mod sliced;
pub mod sliced_mesh;
pub mod sliced_positions;
pub mod sliced_sharing;
pub mod sliced_teeth;
pub mod spring_along_path;
pub mod tip_contact;
pub mod wearing_pair;
mod worn_points;

use serde::{Deserialize, Serialize};

use crate::contact::flank_pressure::PressureFigures;
use crate::contact::{Flanks, Footprint, PairContact, PositionCell, Sweep};
use crate::wear::WearModel;
use gearwear_bodies::gear::{Gear, PerGear, slices::greatest_over_width};
pub use line_of_action::LineOfActionCycle;
use load_sharing::EquilibriumError;
use sliced_mesh::SlicedMesh;

/// Number of groups of positions that collect wear on their own; fixed, so that sums always run in the same order.
const GROUPS: usize = 8;

/// A tooth pair in mesh: place and stiffness of its teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairInMesh {
    /// Theoretical contact point.
    pub position_mm: f64,
    /// Spring of its teeth, N/mm².
    pub teeth_n_per_mm2: f64,
    /// Approach in its tangent frame over the transmission error, as torque over load and base radius: 1 on the line of action.
    pub lever_ratio: f64,
}

/// One loading position: the reference pair's stretch of the path, and all pairs in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadingPosition {
    /// Position and stretch of the path.
    pub cell: PositionCell,
    /// All pairs in mesh, the reference pair first.
    pub pairs: Vec<PairInMesh>,
    /// Whether it lies between A and E and is a row of the observation.
    pub on_line_of_action: bool,
}

/// Counts of work done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Mesh cycles evaluated at all their positions.
    pub mesh_cycles: u64,
    /// Equilibria solved.
    pub equilibria: u64,
    /// Those of them that were solved at a part of the positions.
    pub partial_equilibria: u64,
    /// Newton iterations in them.
    pub newton_iterations: u64,
    /// Evaluations of a pair's contact.
    pub pair_evaluations: u64,
}

impl Work {
    /// The work of an evaluation at a part of the positions.
    pub(crate) fn of_a_part(self) -> Self {
        Self { mesh_cycles: 0, partial_equilibria: self.equilibria, ..self }
    }

    /// Positions of a mesh cycle.
    pub fn positions_of_cycle(&self) -> u64 {
        (self.equilibria - self.partial_equilibria) / self.mesh_cycles.max(1)
    }
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.mesh_cycles += other.mesh_cycles;
        self.equilibria += other.equilibria;
        self.partial_equilibria += other.partial_equilibria;
        self.newton_iterations += other.newton_iterations;
        self.pair_evaluations += other.pair_evaluations;
    }
}

/// Observation at one position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PositionObservation {
    /// Theoretical contact point of the reference pair.
    pub position_mm: f64,
    /// Approach of the gears along the line of action.
    pub transmission_error_mm: f64,
    /// Change of the whole load with the transmission error, N/mm²: the mesh stiffness of all pairs together, about this load. `None` where a
    /// model does not give it.
    pub stiffness_n_per_mm2: Option<f64>,
    /// Part of the whole load that the reference pair carries.
    pub load_share: f64,
    /// Sum of the loads of all pairs over the load to be carried, less one.
    pub load_imbalance: f64,
    /// The reference pair's contact.
    pub footprint: Footprint,
}

/// The greatest pressure of a mesh cycle, before A and after E included.
///
/// Towards a sharp tip edge under load the pressure of elastic bodies grows without bound, and that of a model with its resolution: contacts that
/// such an edge cuts off are kept apart from those whose pressure is defined.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct GreatestPressure {
    /// Greatest pressure of contacts whose pressure is defined, MPa.
    pub defined_mpa: f64,
    /// Greatest pressure of contacts that a sharp tip edge cuts off, MPa; `None` where there are none.
    pub sharp_edge_mpa: Option<f64>,
}

impl GreatestPressure {
    /// Takes a contact's pressure into account.
    pub fn note(&mut self, pressure_mpa: f64, at_sharp_edge: bool) {
        if at_sharp_edge {
            self.sharp_edge_mpa = Some(self.sharp_edge_mpa.map_or(pressure_mpa, |most| most.max(pressure_mpa)));
        } else {
            self.defined_mpa = self.defined_mpa.max(pressure_mpa);
        }
    }

    /// Takes the pressures of all slices over the face width into account, in their order.
    pub(crate) fn note_slices(&mut self, of_slices: &[Self]) {
        let defined_mpa: Vec<f64> = of_slices.iter().map(|slice| slice.defined_mpa).collect();
        self.note(greatest_over_width(&defined_mpa), false);
        of_slices.iter().filter_map(|slice| slice.sharp_edge_mpa).for_each(|sharp_mpa| self.note(sharp_mpa, true));
    }

    /// Takes the pressures of all `positions` into account.
    pub(crate) fn note_all(&mut self, positions: &[PositionObservation]) {
        positions.iter().for_each(|at| self.note(at.footprint.peak_pressure_mpa, at.footprint.at_sharp_edge));
    }
}

/// Overlap of flanks beside the contact that was found: none if all contact was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlankOverlap {
    /// Depth over the transmission error.
    pub of_transmission_error: f64,
    /// Theoretical contact point of the pair.
    pub position_mm: f64,
}

impl FlankOverlap {
    /// Deeper of two overlaps.
    pub(crate) fn deeper(self, other: Self) -> Self {
        if other.of_transmission_error > self.of_transmission_error { other } else { self }
    }
}

/// Observation of a mesh cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleObservation {
    /// Each position, in order.
    pub positions: Vec<PositionObservation>,
    /// Part of the load that a pair carries at the first and at the last position of its mesh, before A and after E where tip edges are followed;
    /// `None` where pairs have slices, or where single points are followed.
    pub shares_at_ends: Option<[f64; 2]>,
    /// Greatest pressure at any position and of any flank point.
    pub greatest_pressure: GreatestPressure,
    /// Pressure between the tip-edge zones and load of the tip edges; none where the zones of the flanks are not known.
    pub pressure_figures: PressureFigures,
    /// Greatest pressure on each flank point, also at sharp tip edges, MPa.
    pub pressure_mpa: PerGear<Vec<f64>>,
    /// Sliding distance of each flank point while in contact, mm.
    pub sliding_mm: PerGear<Vec<f64>>,
    /// ∫ F ds of a tooth pair over its mesh, also before A and after E: load times sliding distance, which is the volume that a flank loses
    /// over its wear coefficient; N, that is N·mm per mm of the line of contact; with slices, the sum over them. `None` where a model
    /// follows single points.
    pub sliding_work_n: Option<f64>,
    /// The mesh of one tooth slice by slice, where there are slices.
    pub slices: Option<SlicedMesh>,
    /// Deepest overlap of the flanks beside their contacts; `None` where a model does not look at their gap.
    pub deepest_overlap: Option<FlankOverlap>,
    /// Transmission error on both sides of the places where load comes in or leaves at once, mm; none where a model has no positions up to them.
    pub transmission_error_beside_jumps_mm: Vec<f64>,
}

/// Material that flanks have lost, mm: at points, all that lies beside the involute, modifications, deviations of measured flanks and wear; at
/// nodes of meshes, which have the modifications, the deviations and wear.
pub type LostMaterial<'a> = PerGear<&'a [f64]>;

/// A pair in mesh, evaluated over a whole mesh cycle on ever newly worn flanks.
pub trait MeshCycle {
    /// Solves every position on flanks that have lost `lost`, and fills `depth_mm` with the wear of each point in one mesh.
    ///
    /// `stopped` is asked at every position whether to give up.
    fn evaluate(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError>;

    /// Chooses a part of the positions in which waves of wear decay as fast as in any: of those evaluated last, the part that wears deepest. Returns
    /// whether there is one.
    fn choose_part(&mut self) -> bool {
        false
    }

    /// As [`Self::evaluate`], of the part of the positions chosen last; no mesh cycle is counted.
    fn evaluate_part(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate(lost, wear, depth_mm, stopped)
    }

    /// Whether a contact of the last evaluation was so near to severe wear that it may come to it within a wear step; also where the cycle does not know.
    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        wear.out_of_reach_mpa().is_some()
    }

    /// Begins the stages of a wear step on flanks that have lost `lost`, after an evaluation on them. Where some positions wear severely, the others may
    /// keep their wear per mesh over the stages: that of mild wear hardly changes in a step that severe wear allows, and what it does change is found
    /// at the end of the step, and is in its error.
    fn begin_stages(&mut self, _lost: LostMaterial<'_>, _wear: &WearModel<'_>) {}

    /// As [`Self::evaluate`], in a stage of the step begun last; no mesh cycle is counted where positions keep their wear.
    fn evaluate_stage(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate(lost, wear, depth_mm, stopped)
    }

    /// As [`Self::evaluate_stage`], at the end of the step: also contacts that come up elsewhere within the step are found.
    fn evaluate_end(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate_stage(lost, wear, depth_mm, stopped)
    }

    /// After [`Self::evaluate_end`] on the same `lost`: evaluates the positions that keep their wear over the stages too, and fills `depth_mm` with the wear
    /// of all. Returns the work; nothing where none does.
    fn complete_stage(
        &mut self,
        _lost: LostMaterial<'_>,
        _wear: &WearModel<'_>,
        _depth_mm: &mut PerGear<Vec<f64>>,
        _stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        Ok(None)
    }

    /// Makes positions anew where the last evaluation, on the same `lost`, found that the load acts in another direction, or on a tip edge worn to
    /// another shape, than they were made for. In between they are linear in what is lost, and the rate of wear is smooth within a
    /// step. Fills `depth_mm` with the wear of each point and returns the work; nothing where no position changes.
    fn linearise_anew(
        &mut self,
        _lost: LostMaterial<'_>,
        _wear: &WearModel<'_>,
        _depth_mm: &mut PerGear<Vec<f64>>,
        _stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        Ok(None)
    }

    /// Returns to the state before any evaluation: the next one depends only on what the flanks have lost, to the bit.
    fn reset(&mut self);

    /// Greatest less least transmission error of the last evaluation, mm.
    fn peak_to_peak_mm(&self) -> f64;

    /// Observation of the last evaluation, on the same `lost`.
    fn observe(&mut self, lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError>;
}

/// Raises `pressure_mpa` at the points of a flank to that of `contact`, and adds the sliding distance in it to `sliding_mm`. Returns the greatest
/// pressure on any of them.
fn note_contact_of_points(
    contact: &dyn PairContact,
    gear: Gear,
    removed_mm: PerGear<&[f64]>,
    sweep: &mut Sweep,
    pressure_mpa: &mut [f64],
    sliding_mm: &mut [f64],
) -> f64 {
    contact.sweep(gear, removed_mm, sweep);
    let range = sweep.first_point..sweep.first_point + sweep.sliding_mm.len();
    let contacts = contact.contact_of_points(gear, removed_mm);
    let points = pressure_mpa[range.clone()].iter_mut().zip(&mut sliding_mm[range]);
    let mut most_mpa = 0.0_f64;
    for ((greatest, slid), (at, &sliding)) in points.zip(contacts.iter().zip(&sweep.sliding_mm)) {
        if sliding > 0.0 {
            *greatest = greatest.max(at.pressure_mpa);
            *slid += sliding * at.contact_fraction;
            most_mpa = most_mpa.max(at.pressure_mpa);
        }
    }
    most_mpa
}

/// Takes the pressure of a contact into account, where the zones of the flanks are known.
fn note_figures(flanks: Flanks<'_>, position_mm: f64, contact: &dyn PairContact, figures: &mut PressureFigures) {
    if let Some(parts) = flanks.parts {
        parts.note(&flanks.geometry, position_mm, &contact.pressed_cells(), figures);
    }
}

/// Whether any of these pressures is above the limit, where there is one.
fn is_exceeded(limit_mpa: Option<f64>, mut pressures_mpa: impl Iterator<Item = f64>) -> bool {
    limit_mpa.is_some_and(|limit_mpa| pressures_mpa.any(|at_mpa| at_mpa > limit_mpa))
}

/// Pressure up to which positions of these pressures keep their wear over the stages of a step, MPa; `None` where all under load are above it, and where
/// none is: without a severe one among them they have nothing to wait for.
fn kept_wear_to_mpa(wear: &WearModel<'_>, pressures_mpa: impl Iterator<Item = f64>) -> Option<f64> {
    let mild_mpa = wear.surely_mild_mpa()?;
    let (mut is_any_mild, mut is_any_severe) = (false, false);
    for at_mpa in pressures_mpa.filter(|at_mpa| *at_mpa > 0.0) {
        is_any_severe |= at_mpa > mild_mpa;
        is_any_mild |= at_mpa <= mild_mpa;
    }
    (is_any_mild && is_any_severe).then_some(mild_mpa)
}

/// Least and greatest of `values_mm`.
fn extremes_mm(values_mm: impl Iterator<Item = f64>) -> (f64, f64) {
    values_mm.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), mm| (low.min(mm), high.max(mm)))
}

/// Greatest less least of `values_mm`; 0 without any.
fn range_mm(values_mm: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = extremes_mm(values_mm);
    (high - low).max(0.0)
}

/// Stiffness of springs of `n_per_mm2` on bodies of the compliance `mm2_per_n`, N/mm².
fn in_series(n_per_mm2: f64, mm2_per_n: f64) -> f64 {
    n_per_mm2 / (1.0 + n_per_mm2 * mm2_per_n)
}

impl CycleObservation {
    /// Greatest pressure anywhere on either flank, at any position, also before A and after E and at sharp tip edges, MPa.
    pub fn peak_pressure_mpa(&self) -> f64 {
        let GreatestPressure { defined_mpa, sharp_edge_mpa } = self.greatest_pressure;
        sharp_edge_mpa.map_or(defined_mpa, |sharp| sharp.max(defined_mpa))
    }

    /// Least and greatest transmission error, mm.
    pub fn transmission_error_mm(&self) -> (f64, f64) {
        extremes_mm(self.transmission_errors_mm())
    }

    /// Greatest less least transmission error, mm.
    pub fn peak_to_peak_mm(&self) -> f64 {
        range_mm(self.transmission_errors_mm())
    }

    /// Transmission error at all positions, and beside the jumps between them, mm.
    fn transmission_errors_mm(&self) -> impl Iterator<Item = f64> {
        let beside_jumps = self.transmission_error_beside_jumps_mm.iter().copied();
        self.positions.iter().map(|at| at.transmission_error_mm).chain(beside_jumps)
    }

    /// Amplitudes of the first `count` mesh orders of the transmission error, mm; none where the positions do not reach over a base pitch.
    pub fn mesh_orders_mm(&self, base_pitch_mm: f64, count: usize) -> Vec<f64> {
        if let Some(slices) = &self.slices {
            return slices.mesh_orders_mm(count);
        }
        let (positions, errors): (Vec<f64>, Vec<f64>) =
            self.positions.iter().map(|at| (at.position_mm, at.transmission_error_mm)).unzip();
        mesh_orders::of_positions(&positions, &errors, base_pitch_mm, count)
    }

    /// Greatest pressure with the reference pair at `position_mm`, linear between the observations on either side, MPa.
    pub fn peak_pressure_at_mpa(&self, position_mm: f64) -> f64 {
        let after = self.positions.partition_point(|p| p.position_mm <= position_mm).clamp(1, self.positions.len() - 1);
        let (low, high) = (&self.positions[after - 1], &self.positions[after]);
        let weight = (position_mm - low.position_mm) / (high.position_mm - low.position_mm);
        let (low, high) = (low.footprint.peak_pressure_mpa, high.footprint.peak_pressure_mpa);
        low + weight.clamp(0.0, 1.0) * (high - low)
    }

    /// The observation nearest to `position_mm`.
    pub fn nearest(&self, position_mm: f64) -> Option<&PositionObservation> {
        self.positions.iter().min_by(|a, b| {
            let [a, b] = [a, b].map(|at| (at.position_mm - position_mm).abs());
            a.total_cmp(&b)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wear::settings::{SevereTransition, WearSettings};

    /// Mild positions wait for severe ones: not where all under load are alike, with or without others that carry nothing.
    #[test]
    fn wear_is_kept_beside_severe_wear_alone() {
        let kept_mpa = |severe, pressures_mpa: &[f64]| {
            let law = crate::wear::of(&WearSettings { severe, ..WearSettings::archard(1e-11) });
            kept_wear_to_mpa(&WearModel::cold(law.as_ref()), pressures_mpa.iter().copied())
        };
        let severe = Some(SevereTransition { above_mpa: 1050.0, factor: 10.0, band_mpa: 100.0 });
        for pressures_mpa in [&[][..], &[0.0, 900.0], &[0.0, 990.0, 1200.0]] {
            assert_eq!(kept_mpa(severe, pressures_mpa), None, "{pressures_mpa:?}");
        }
        // 97 % of the pressure at which severe wear begins.
        assert_eq!(kept_mpa(severe, &[1200.0, 0.0, 969.0, 1100.0]), Some(970.0));
        assert_eq!(kept_mpa(None, &[1200.0, 900.0]), None);
    }
}
