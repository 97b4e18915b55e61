//! A pair with its wear: the state that the steps of a wear run change.
//!
//! Wear is kept at the flank points by most models, at the nodes of the flanks by finite elements ([`OnFlankPlaces`]), and at the contact points by the
//! simplified model of helical gears ([`super::simplified`]).

use std::borrow::Cow;

use super::CycleObservation;
use super::local_means::LocalMeans;
use crate::mesh_cycle::over_life::PeakToPeakOverLife;
use crate::mesh_cycle::{LostMaterial, MeshCycle, Work, condensed::at_radii, load_sharing::EquilibriumError};
use crate::wear::WearModel;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_fem::weighted_sum::weighted_sum;
use serde::{Deserialize, Serialize};

/// State kept at a snapshot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Pinion revolutions so far.
    pub revolutions: f64,
    /// Wear depth of each flank point, slice after slice.
    pub wear_mm: PerGear<Vec<f64>>,
    /// Depth that each flank point loses in the next mesh.
    pub depth_per_mesh_mm: PerGear<Vec<f64>>,
    /// Loss of the nodes where flanks are finite elements: flank points lie on the involute, and do not show the wear of tip roundings.
    pub lost_at_nodes: Option<PerGear<LostArea>>,
    /// Mesh cycle of the present flanks.
    pub cycle: CycleObservation,
    /// Transmission error from the beginning of the run to this state; none of a state outside a run.
    pub over_life: PeakToPeakOverLife,
}

impl Snapshot {
    /// Greatest wear depth of any flank point of a gear.
    pub fn deepest_mm(&self, gear: Gear) -> f64 {
        self.wear_mm[gear].iter().copied().fold(0.0, f64::max)
    }

    /// Wear of each flank point of a gear since the snapshot `before`, slice after slice, mm.
    pub fn lost_since_mm(&self, before: &Self, gear: Gear) -> Vec<f64> {
        self.wear_mm[gear].iter().zip(&before.wear_mm[gear]).map(|(now, before)| now - before).collect()
    }
}

/// ∫ h ds over a flank.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LostArea {
    /// Loss so far, mm².
    pub wear_mm2: f64,
    /// Loss in the next mesh, mm².
    pub per_mesh_mm2: f64,
}

/// A pair that wears.
pub(crate) trait WearingPair {
    /// Solves one mesh cycle on the present flanks, and keeps the depth that they lose in one mesh by `wear`. `stopped` is asked now
    /// and then whether to give up.
    fn evaluate(&mut self, wear: &WearModel<'_>, stopped: &(dyn Fn() -> bool + Sync))
    -> Result<Work, EquilibriumError>;

    /// Chooses a part of the positions ([`MeshCycle::choose_part`]). Returns whether there is one.
    fn choose_part(&mut self) -> bool {
        false
    }

    /// As [`Self::evaluate`], of the part of the positions chosen last.
    fn evaluate_part(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate(wear, stopped)
    }

    /// Whether wear may be severe within a step after the last evaluation ([`MeshCycle::may_wear_severely`]).
    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        wear.out_of_reach_mpa().is_some()
    }

    /// Begins the stages of a wear step after an evaluation on the same flanks ([`MeshCycle::begin_stages`]).
    fn begin_stages(&mut self, _wear: &WearModel<'_>) {}

    /// As [`Self::evaluate`], in a stage of the step begun last.
    fn evaluate_stage(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate(wear, stopped)
    }

    /// As [`Self::evaluate_stage`], at the end of the step ([`MeshCycle::evaluate_end`]).
    fn evaluate_end(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate_stage(wear, stopped)
    }

    /// After [`Self::evaluate_end`] on the same flanks: evaluates the positions that keep their wear over the stages too. Returns the work; nothing where none
    /// does.
    fn complete_stage(
        &mut self,
        _wear: &WearModel<'_>,
        _stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        Ok(None)
    }

    /// Makes positions anew that are linear in what is lost ([`MeshCycle::linearise_anew`]), after an evaluation on the same flanks.
    fn linearise_anew(
        &mut self,
        _wear: &WearModel<'_>,
        _stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        Ok(None)
    }

    /// Lets the flanks lose that depth in so many meshes of each gear's teeth.
    fn wear_for(&mut self, meshes: PerGear<f64>);

    /// Returns to the state before any evaluation, on the present flanks: the next evaluation finds the same bits as that of a new pair with the same
    /// wear. Otherwise its last bits depend on where the last one ended.
    fn reset(&mut self);

    /// Greatest mean magnitude along the flanks ([`LocalMeans`]) of a row of depths at the places, mm.
    fn greatest_mean_mm(&self, row: PerGear<&[f64]>) -> f64;

    /// Mean about one place of a gear, over the same length, of a row of depths at its places, mm.
    fn mean_about_mm(&self, gear: Gear, place: usize, row: &[f64]) -> f64;

    /// Wear of each place at which the model keeps it, mm: as many places as in [`Self::set_wear_mm`] and [`Self::depth_mm`].
    fn wear_mm(&self) -> PerGear<Vec<f64>>;

    /// Wear of each flank point, slice after slice, mm.
    fn wear_at_points_mm(&self) -> PerGear<Vec<f64>>;

    /// Sets the wear of each place, mm.
    fn set_wear_mm(&mut self, wear_mm: &PerGear<Vec<f64>>);

    /// Depth that each place loses in one mesh by the last evaluation, mm.
    fn depth_mm(&self, depth_mm: &mut PerGear<Vec<f64>>);

    /// Greatest less least transmission error of the last evaluation, mm.
    fn peak_to_peak_mm(&self) -> f64;

    /// The state that the last evaluation found.
    fn snapshot(&mut self, revolutions: f64) -> Result<Snapshot, EquilibriumError>;
}

/// Flanks as rows of places that a mesh cycle wears: flank points, slice after slice, or the nodes of finite elements.
pub(crate) struct OnFlankPlaces<'a> {
    cycle: Box<dyn MeshCycle + 'a>,
    means: LocalMeans,
    /// What the places had lost before the first mesh, as far as the cycle knows nothing of it: modifications of flank points, deviations of measured
    /// flanks at nodes.
    before_mm: Cow<'a, PerGear<Vec<f64>>>,
    /// That and the wear.
    lost_mm: PerGear<Vec<f64>>,
    wear_mm: PerGear<Vec<f64>>,
    depth_mm: PerGear<Vec<f64>>,
    /// The flank points where places are nodes.
    between_nodes: Option<PointsBetweenNodes>,
}

/// Flank points of flanks that wear at their nodes; values are interpolated.
pub(crate) struct PointsBetweenNodes {
    /// Nominal radii of the flank points.
    pub radius_mm: PerGear<Vec<f64>>,
    /// Nominal radii of the nodes, from root to tip.
    pub node_radius_mm: PerGear<Vec<f64>>,
    /// Length of the flank that each node stands for.
    pub node_share_mm: PerGear<Vec<f64>>,
}

impl PointsBetweenNodes {
    /// Values at the flank points, from those at the nodes.
    fn values(&self, at_nodes: &PerGear<Vec<f64>>) -> PerGear<Vec<f64>> {
        PerGear::from_fn(|gear| {
            at_radii(&self.node_radius_mm[gear], &at_nodes[gear], self.radius_mm[gear].iter().copied())
        })
    }
}

impl<'a> OnFlankPlaces<'a> {
    /// Unworn flanks that lost `before_mm` before the first mesh.
    pub(crate) fn new(
        cycle: Box<dyn MeshCycle + 'a>,
        means: LocalMeans,
        before_mm: Cow<'a, PerGear<Vec<f64>>>,
        between_nodes: Option<PointsBetweenNodes>,
    ) -> Self {
        let wear_mm = PerGear::from_fn(|gear| vec![0.0; before_mm[gear].len()]);
        let lost_mm = before_mm.as_ref().clone();
        Self { cycle, means, before_mm, lost_mm, depth_mm: wear_mm.clone(), wear_mm, between_nodes }
    }

    /// Values at the flank points.
    fn at_points(&self, at_places: &PerGear<Vec<f64>>) -> PerGear<Vec<f64>> {
        self.between_nodes.as_ref().map_or_else(|| at_places.clone(), |points| points.values(at_places))
    }

    /// Sets what the flanks have lost from their wear.
    fn lose_wear(&mut self) {
        for gear in Gear::BOTH {
            let places = self.before_mm[gear].iter().zip(&self.wear_mm[gear]);
            self.lost_mm[gear].iter_mut().zip(places).for_each(|(lost, (before, wear))| *lost = before + wear);
        }
    }
}

/// Lost material, borrowed.
fn lost(lost_mm: &PerGear<Vec<f64>>) -> LostMaterial<'_> {
    lost_mm.as_ref().map(Vec::as_slice)
}

impl WearingPair for OnFlankPlaces<'_> {
    fn evaluate(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.cycle.evaluate(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn choose_part(&mut self) -> bool {
        self.cycle.choose_part()
    }

    fn evaluate_part(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.cycle.evaluate_part(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        self.cycle.may_wear_severely(wear)
    }

    fn begin_stages(&mut self, wear: &WearModel<'_>) {
        self.cycle.begin_stages(lost(&self.lost_mm), wear);
    }

    fn evaluate_stage(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.cycle.evaluate_stage(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn evaluate_end(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.cycle.evaluate_end(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn complete_stage(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        self.cycle.complete_stage(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn linearise_anew(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        self.cycle.linearise_anew(lost(&self.lost_mm), wear, &mut self.depth_mm, stopped)
    }

    fn wear_for(&mut self, meshes: PerGear<f64>) {
        for gear in Gear::BOTH {
            let places = self.wear_mm[gear].iter_mut().zip(&self.depth_mm[gear]);
            places.for_each(|(wear, depth)| *wear += meshes[gear] * depth);
        }
        self.lose_wear();
    }

    fn reset(&mut self) {
        self.cycle.reset();
    }

    fn wear_mm(&self) -> PerGear<Vec<f64>> {
        self.wear_mm.clone()
    }

    fn greatest_mean_mm(&self, row: PerGear<&[f64]>) -> f64 {
        self.means.greatest_mm(row)
    }

    fn mean_about_mm(&self, gear: Gear, place: usize, row: &[f64]) -> f64 {
        self.means.about_mm(gear, place, row)
    }

    fn wear_at_points_mm(&self) -> PerGear<Vec<f64>> {
        self.at_points(&self.wear_mm)
    }

    fn set_wear_mm(&mut self, wear_mm: &PerGear<Vec<f64>>) {
        self.wear_mm.clone_from(wear_mm);
        self.lose_wear();
    }

    fn depth_mm(&self, depth_mm: &mut PerGear<Vec<f64>>) {
        depth_mm.clone_from(&self.depth_mm);
    }

    fn peak_to_peak_mm(&self) -> f64 {
        self.cycle.peak_to_peak_mm()
    }

    fn snapshot(&mut self, revolutions: f64) -> Result<Snapshot, EquilibriumError> {
        let mut cycle = self.cycle.observe(lost(&self.lost_mm))?;
        let lost_at_nodes = self.between_nodes.as_ref().map(|points| {
            cycle.pressure_mpa = points.values(&cycle.pressure_mpa);
            cycle.sliding_mm = points.values(&cycle.sliding_mm);
            PerGear::from_fn(|gear| LostArea {
                wear_mm2: weighted_sum(&points.node_share_mm[gear], &self.wear_mm[gear]),
                per_mesh_mm2: weighted_sum(&points.node_share_mm[gear], &self.depth_mm[gear]),
            })
        });
        Ok(Snapshot {
            revolutions,
            wear_mm: self.at_points(&self.wear_mm),
            depth_per_mesh_mm: self.at_points(&self.depth_mm),
            lost_at_nodes,
            cycle,
            over_life: PeakToPeakOverLife::default(),
        })
    }
}
