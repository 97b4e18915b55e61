//! Mesh cycle of pairs on the line of action: positions of springs, each with the pairs in mesh, dealt to threads in fixed groups.

use rayon::prelude::*;

use super::collected::Collected;
use super::load_sharing::{EquilibriumError, MeshedPair, PairEquilibrium, balance, settled};
use super::worn_points::{ContactOnPath, WornPoints};
use super::{
    CycleObservation, FlankOverlap, GROUPS, GreatestPressure, LoadingPosition, LostMaterial, MeshCycle,
    PositionObservation, Work, in_series, is_exceeded, kept_wear_to_mpa, note_contact_of_points, note_figures,
    range_mm,
};
use crate::contact::flank_pressure::PressureFigures;
use crate::contact::{ContactSurface, Flanks, PositionCell, Sweep};
use crate::wear::WearModel;
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};

/// A loading position on the line of action, with its state.
struct LineOfActionPosition<'a> {
    cell: PositionCell,
    on_line_of_action: bool,
    place: ContactOnPath<'a>,
    /// Sliding distance of the flanks on each other within the cell, mm.
    sliding_mm: f64,
    /// Pairs in mesh, the reference pair first.
    pairs: Vec<MeshedPair<'a>>,
    equilibrium: PairEquilibrium,
    /// Whether it keeps its wear over the stages of a step.
    keeps_wear: bool,
}

/// Positions that collect wear together.
struct LineOfActionGroup<'a> {
    loaded_positions: Vec<LineOfActionPosition<'a>>,
    collected: Collected,
    points: WornPoints,
    /// Wear per mesh of the positions that keep theirs over the stages of a step.
    kept_mm: PerGear<Vec<f64>>,
}

/// All loading positions of a pair, ready to be evaluated on ever newly worn flanks.
pub struct LineOfActionCycle<'a> {
    groups: Vec<LineOfActionGroup<'a>>,
    line_load_n_per_mm: f64,
    /// Displacement of the bodies that all pairs share, under the whole load, mm.
    bodies_mm: f64,
    flanks: Flanks<'a>,
    /// Whether positions keep their wear over the stages of a step.
    some_keep_wear: bool,
}

impl<'a> LineOfActionCycle<'a> {
    /// Prepares every pair at every position. The wear of the reference pair, the first of each position, is collected.
    pub fn new(
        flanks: Flanks<'a>,
        surface: &dyn ContactSurface,
        positions: &[LoadingPosition],
        line_load_n_per_mm: f64,
    ) -> Self {
        let size = positions.len().div_ceil(GROUPS).max(1);
        let groups = positions
            .par_chunks(size)
            .map(|positions| LineOfActionGroup {
                loaded_positions: positions.iter().map(|p| LineOfActionPosition::new(flanks, surface, p)).collect(),
                collected: Collected::new(flanks.grid.map(|grid| grid.len())),
                points: WornPoints::default(),
                kept_mm: PerGear::default(),
            })
            .collect();
        Self { groups, line_load_n_per_mm, bodies_mm: 0.0, flanks, some_keep_wear: false }
    }

    /// Puts all pairs on gear bodies that yield by `bodies_mm` under the whole load.
    pub(crate) fn on_bodies_that_yield_by(self, bodies_mm: f64) -> Self {
        Self { bodies_mm, ..self }
    }

    fn loaded_positions(&self) -> impl Iterator<Item = &LineOfActionPosition<'a>> {
        self.groups.iter().flat_map(|group| &group.loaded_positions)
    }

    /// Of the reference pair at each position under load.
    fn greatest_pressures_mpa(&self) -> impl Iterator<Item = f64> {
        self.loaded_positions().map(|at| at.pairs[0].contact.footprint().peak_pressure_mpa)
    }
}

impl MeshCycle for LineOfActionCycle<'_> {
    fn evaluate(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let load = self.line_load_n_per_mm;
        self.groups.par_iter_mut().for_each(|group| group.evaluate(lost, load, wear, stopped));
        Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)
    }

    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        is_exceeded(wear.out_of_reach_mpa(), self.greatest_pressures_mpa())
    }

    fn begin_stages(&mut self, lost: LostMaterial<'_>, wear: &WearModel<'_>) {
        let mild_mpa = kept_wear_to_mpa(wear, self.greatest_pressures_mpa());
        self.some_keep_wear = mild_mpa.is_some();
        if let Some(mild_mpa) = mild_mpa {
            self.groups.par_iter_mut().for_each(|group| group.keep_mild_wear(lost, wear, mild_mpa));
        }
    }

    fn evaluate_stage(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        if !self.some_keep_wear {
            return self.evaluate(lost, wear, depth_mm, stopped);
        }
        let load = self.line_load_n_per_mm;
        self.groups.par_iter_mut().for_each(|group| group.evaluate_stage(lost, load, wear, stopped));
        let work = Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)?;
        Ok(work.of_a_part())
    }

    fn complete_stage(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        if !self.some_keep_wear {
            return Ok(None);
        }
        let load = self.line_load_n_per_mm;
        self.groups.par_iter_mut().for_each(|group| group.complete_stage(lost, load, wear, stopped));
        let work = Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)?;
        Ok(Some(work.of_a_part()))
    }

    fn reset(&mut self) {
        self.groups.par_iter_mut().flat_map(|group| &mut group.loaded_positions).for_each(|loaded| {
            loaded.pairs.iter_mut().for_each(MeshedPair::reset);
        });
    }

    fn peak_to_peak_mm(&self) -> f64 {
        let observed = self.loaded_positions().filter(|loaded| loaded.on_line_of_action);
        range_mm(observed.map(|loaded| loaded.equilibrium.transmission_error_mm))
    }

    fn observe(&mut self, lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError> {
        let removed_mm = lost;
        let zeros = removed_mm.map(|flank| vec![0.0; flank.len()]);
        let ends = [self.loaded_positions().next(), self.loaded_positions().last()];
        let mut observation = CycleObservation {
            positions: Vec::new(),
            shares_at_ends: Some(ends.map(|at| at.map_or(0.0, |at| at.load_share(self.line_load_n_per_mm)))),
            greatest_pressure: GreatestPressure::default(),
            pressure_figures: PressureFigures::default(),
            pressure_mpa: zeros.clone(),
            sliding_mm: zeros,
            sliding_work_n: None,
            slices: None,
            deepest_overlap: self
                .loaded_positions()
                .filter_map(|at| at.overlap(removed_mm, self.bodies_mm))
                .reduce(FlankOverlap::deeper),
            transmission_error_beside_jumps_mm: Vec::new(),
        };
        let mut sliding_work_n = 0.0;
        let mut sweep = Sweep::default();
        for loaded in self.loaded_positions() {
            if loaded.on_line_of_action {
                observation.positions.push(loaded.observe(self.line_load_n_per_mm, self.bodies_mm));
            }
            for gear in Gear::BOTH {
                let (pressure, sliding) = (&mut observation.pressure_mpa[gear], &mut observation.sliding_mm[gear]);
                let contact = &*loaded.pairs[0].contact;
                let greatest_mpa = note_contact_of_points(contact, gear, removed_mm, &mut sweep, pressure, sliding);
                observation.greatest_pressure.note(greatest_mpa, contact.footprint().at_sharp_edge);
            }
            let position_mm = loaded.cell.position_mm;
            let contact = &*loaded.pairs[0].contact;
            note_figures(self.flanks, position_mm, contact, &mut observation.pressure_figures);
            sliding_work_n += loaded.pairs[0].normal_load_n_per_mm() * loaded.sliding_mm;
        }
        observation.sliding_work_n = Some(sliding_work_n);
        observation.greatest_pressure.note_all(&observation.positions);
        Ok(observation)
    }
}

impl LineOfActionGroup<'_> {
    fn evaluate(
        &mut self,
        removed_mm: PerGear<&[f64]>,
        line_load: f64,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        self.collected.clear();
        self.evaluate_those(|_| true, |loaded| loaded.solve(removed_mm, line_load), removed_mm, wear, stopped);
    }

    /// As [`Self::evaluate`], but for positions that keep their wear.
    fn evaluate_stage(
        &mut self,
        removed_mm: PerGear<&[f64]>,
        line_load: f64,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        self.collected.begin_from(&self.kept_mm);
        self.evaluate_those(
            |loaded| !loaded.keeps_wear,
            |loaded| loaded.solve(removed_mm, line_load),
            removed_mm,
            wear,
            stopped,
        );
    }

    /// Evaluates the positions that keep their wear, after [`Self::evaluate_stage`], and collects the wear of all.
    fn complete_stage(
        &mut self,
        removed_mm: PerGear<&[f64]>,
        line_load: f64,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        self.collected.clear();
        let solve_kept = |loaded: &mut LineOfActionPosition<'_>| {
            if loaded.keeps_wear { loaded.solve(removed_mm, line_load) } else { Ok(Work::default()) }
        };
        self.evaluate_those(|_| true, solve_kept, removed_mm, wear, stopped);
    }

    /// Collects the wear of some of the positions.
    fn evaluate_those(
        &mut self,
        are_asked: impl Fn(&LineOfActionPosition<'_>) -> bool,
        solve: impl Fn(&mut LineOfActionPosition<'_>) -> Result<Work, EquilibriumError>,
        removed_mm: PerGear<&[f64]>,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        for loaded in self.loaded_positions.iter_mut().filter(|loaded| are_asked(loaded)) {
            let solved = if stopped() { Err(EquilibriumError::Interrupted) } else { solve(loaded) };
            if !self.collected.take(solved) {
                return;
            }
            let contact = (&loaded.pairs[0], &loaded.place);
            self.points.wear(wear, contact, removed_mm, PerGear::default(), &mut self.collected.depth_mm);
        }
    }

    /// Keeps the wear of the positions whose pressure is nowhere above `mild_mpa`.
    fn keep_mild_wear(&mut self, removed_mm: PerGear<&[f64]>, wear: &WearModel<'_>, mild_mpa: f64) {
        self.kept_mm = self.collected.depth_mm.as_ref().map(|depth_mm| vec![0.0; depth_mm.len()]);
        for loaded in &mut self.loaded_positions {
            loaded.keeps_wear = loaded.pairs[0].contact.footprint().peak_pressure_mpa <= mild_mpa;
            if loaded.keeps_wear {
                let contact = (&loaded.pairs[0], &loaded.place);
                self.points.wear(wear, contact, removed_mm, PerGear::default(), &mut self.kept_mm);
            }
        }
    }
}

impl<'a> LineOfActionPosition<'a> {
    fn new(flanks: Flanks<'a>, surface: &dyn ContactSurface, position: &LoadingPosition) -> Self {
        let pairs = position
            .pairs
            .iter()
            .enumerate()
            .map(|(k, pair)| {
                let cell = (k == 0).then_some(position.cell);
                let contact = surface.pair(flanks, pair.position_mm, cell);
                MeshedPair::on_lever(contact, pair.teeth_n_per_mm2, pair.lever_ratio, flanks.geometry.obliquity)
            })
            .collect();
        let (cell, on_line_of_action) = (position.cell, position.on_line_of_action);
        let place = ContactOnPath::new(flanks, cell);
        let sliding_mm = flanks.geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
        Self {
            cell,
            on_line_of_action,
            place,
            sliding_mm,
            pairs,
            equilibrium: PairEquilibrium::default(),
            keeps_wear: false,
        }
    }

    /// Equilibrium on the flanks as they are now.
    fn solve(&mut self, removed_mm: PerGear<&[f64]>, line_load: f64) -> Result<Work, EquilibriumError> {
        let at = self.cell.position_mm;
        let (equilibrium, work) = settled(&mut self.pairs, |_| removed_mm, |pairs| balance(pairs, line_load, at))?;
        self.equilibrium = equilibrium;
        Ok(work)
    }

    fn observe(&self, line_load: f64, bodies_mm: f64) -> PositionObservation {
        let reference = &self.pairs[0];
        let total: f64 = self.pairs.iter().map(|pair| pair.response.line_load_n_per_mm).sum();
        PositionObservation {
            position_mm: self.cell.position_mm,
            transmission_error_mm: self.equilibrium.transmission_error_mm + bodies_mm,
            stiffness_n_per_mm2: Some(in_series(self.equilibrium.n_per_mm2, bodies_mm / line_load)),
            load_share: self.load_share(line_load),
            load_imbalance: total / line_load - 1.0,
            footprint: reference.contact.footprint(),
        }
    }

    /// Part of the load that the reference pair carries.
    fn load_share(&self, line_load: f64) -> f64 {
        self.pairs[0].response.line_load_n_per_mm / line_load
    }

    /// Overlap of the flanks of the reference pair.
    fn overlap(&self, removed_mm: PerGear<&[f64]>, bodies_mm: f64) -> Option<FlankOverlap> {
        let overlap_mm = self.pairs[0].contact.overlap_beside_mm(removed_mm)?;
        let of_transmission_error = overlap_mm / (self.equilibrium.transmission_error_mm + bodies_mm);
        Some(FlankOverlap { of_transmission_error, position_mm: self.cell.position_mm })
    }
}
