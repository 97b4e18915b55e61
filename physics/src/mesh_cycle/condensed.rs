//! The mesh cycle on the finite-element model: both gears condensed onto their flanks, contact found from their true, worn profiles.
//!
//! All tooth pairs at a position are in one complementarity problem, coupled through the gear bodies ([`gearwear_bodies::gear_fem`]), and touch wherever
//! their profiles do, also before A and after E, where a tip edge meets its mate outside the line of action. As every tooth of a gear wears alike, one
//! base pitch of positions suffices: the pairs found there, each at its own place of the path, together are one tooth pair over its whole mesh.
//!
//! Wear is that of the nodes of both flanks: the load of every multiplier reaches those that it faces while the contact moves on
//! ([`gearwear_bodies::gear_fem::load_transfer`]). [`stretches`] says where positions are.
//!
//! The couplings of a position are prepared once; from one wear step to the next only the gaps change, and hardly the active set.

mod observation;
mod stretches;
mod unworn_wear;
mod wearing_elements;

use rayon::prelude::*;

pub use self::unworn_wear::unworn_wear_mm;
pub use self::wearing_elements::WearingElements;

use self::wearing_elements::IdlePositions;
use super::collected::Collected;
use super::condensed_contact::{CondensedContactPlace, HeatedContactRows, equivalent_half_width_mm};
use super::load_sharing::EquilibriumError;
use super::{CycleObservation, FlankOverlap, LostMaterial, MeshCycle, Work, is_exceeded, kept_wear_to_mpa};
use crate::lubrication::running_pair::LoadedPlace;
use crate::wear::{SlidingRow, WearModel};
use gearwear_bodies::gear::{Gear, PerGear, flank_zones::FlankZones};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_nodes::FlankNodes;
use gearwear_bodies::gear_fem::load_transfer::LoadTransfer;
use gearwear_bodies::gear_fem::prepared::PreparedPosition;
use gearwear_bodies::gear_fem::tilted::Worn;
use gearwear_bodies::reference::linear_means::value_at;
use gearwear_fem::active_set::ContactEquilibrium;

/// Relative difference of the lever of a tooth pair's load from that on the worn flanks, over the part of the load that other pairs carry, that is
/// followed: a load share changes by some three times that.
const LEAST_LEVER_CHANGE: f64 = 1e-3;
/// Change of the tilt of a tip edge under load that is followed: rad, and over the tilt itself.
const LEAST_TILT: (f64, f64) = (0.02, 0.2);
/// Relative change of the transmission error that is followed in the load transfers.
const LEAST_TURN: f64 = 0.1;
/// Greatest number of times that a position follows its tilted flanks in an evaluation.
const MOST_TILTS: usize = 3;

/// A position, with the transfer of its load to the nodes.
struct CondensedPosition {
    prepared: PreparedPosition,
    /// Stretch of the path.
    stretch_mm: (f64, f64),
    /// Load transfer of each tooth pair that may touch.
    transfers: Vec<LoadTransfer>,
    /// Transmission error for which the transfers were found, mm: at first that of unworn flanks.
    turned_mm: f64,
    /// Number of the windows of `prepared` for which they were found.
    windows: usize,
    found: Option<ContactEquilibrium>,
    /// Whether it keeps its wear over the stages of a step.
    keeps_wear: bool,
}

/// Positions that collect wear together.
struct CondensedGroup {
    loaded_positions: Vec<CondensedPosition>,
    collected: Collected,
    rows: ContactRows,
    /// Wear per mesh of the positions that keep theirs over the stages of a step.
    kept_mm: PerGear<Vec<f64>>,
}

/// Buffers for the rows of one contact.
#[derive(Default)]
struct ContactRows {
    pressure_mpa: Vec<f64>,
    depth_mm: Vec<f64>,
    heated: HeatedContactRows,
}

/// All positions of one base pitch, ready to be evaluated on ever newly worn flanks, whose places are the nodes of the flanks.
pub struct CondensedCycle<'a> {
    model: &'a CondensedPair<'a>,
    /// Elements that keep the positions for the next cycle; none of a cycle of its own.
    elements: Option<&'a WearingElements<'a>>,
    line_load_n_per_mm: f64,
    nodes: PerGear<FlankNodes>,
    /// Nominal radii of the nodes, from root to tip.
    radius_mm: PerGear<Vec<f64>>,
    groups: Vec<CondensedGroup>,
    /// Positions before which load comes in or leaves at once, by their place in the base pitch.
    after_jumps: Vec<usize>,
    /// Positions from A to E at which the cycle is observed.
    observation_mm: Vec<f64>,
    /// Zones of the flanks, for figures of the pressure.
    zones: Option<PerGear<FlankZones>>,
    /// Whether positions keep their wear over the stages of a step.
    some_keep_wear: bool,
}

impl<'a> CondensedCycle<'a> {
    /// Prepares positions about as close as `positions` from A to E.
    pub fn new(model: &'a CondensedPair<'a>, positions: usize, line_load_n_per_mm: f64) -> Self {
        Self::with(model, positions, line_load_n_per_mm, None)
    }

    /// As [`Self::new`], with positions that were prepared already.
    fn with(
        model: &'a CondensedPair<'a>,
        positions: usize,
        line_load_n_per_mm: f64,
        prepared: Option<IdlePositions>,
    ) -> Self {
        let nodes = model.flank_nodes();
        let radius_mm = nominal_radii_mm(model, nodes.as_ref());
        let asked = (positions, line_load_n_per_mm);
        let IdlePositions { groups, after_jumps, .. } =
            prepared.unwrap_or_else(|| IdlePositions::prepare(model, asked, nodes.as_ref()));
        Self {
            model,
            elements: None,
            line_load_n_per_mm,
            nodes,
            radius_mm,
            groups,
            after_jumps,
            observation_mm: model.pair.path.evenly_mm(positions),
            zones: None,
            some_keep_wear: false,
        }
    }

    /// Adds figures of the pressure by the zones of the flanks.
    pub(crate) fn observing(mut self, zones: PerGear<FlankZones>) -> Self {
        self.zones = Some(zones);
        self
    }

    /// The nodes of both flanks.
    pub fn nodes(&self) -> PerGear<&FlankNodes> {
        self.nodes.as_ref()
    }

    /// Nominal radii of the nodes, from root to tip.
    pub fn radius_mm(&self) -> PerGear<&[f64]> {
        self.radius_mm.as_ref().map(Vec::as_slice)
    }

    /// Number of positions in a base pitch.
    pub fn positions(&self) -> usize {
        self.loaded_positions().count()
    }

    fn loaded_positions(&self) -> impl Iterator<Item = &CondensedPosition> {
        self.groups.iter().flat_map(|group| &group.loaded_positions)
    }

    /// Of each position under load.
    fn greatest_pressures_mpa(&self) -> impl Iterator<Item = f64> {
        self.loaded_positions().map(CondensedPosition::greatest_pressure_mpa)
    }
}

impl Drop for CondensedCycle<'_> {
    fn drop(&mut self) {
        // What a panic has left half done is not kept.
        if let Some(elements) = self.elements.filter(|_| !std::thread::panicking()) {
            let (groups, after_jumps) = (std::mem::take(&mut self.groups), std::mem::take(&mut self.after_jumps));
            elements.keep(IdlePositions {
                asked: (self.observation_mm.len(), self.line_load_n_per_mm),
                groups,
                after_jumps,
            });
        }
    }
}

impl MeshCycle for CondensedCycle<'_> {
    fn evaluate(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.evaluate_by(|group, step| group.evaluate(step), lost, wear, depth_mm, stopped)
    }

    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        is_exceeded(wear.out_of_reach_mpa(), self.greatest_pressures_mpa())
    }

    fn begin_stages(&mut self, lost: LostMaterial<'_>, wear: &WearModel<'_>) {
        let mild_mpa = kept_wear_to_mpa(wear, self.greatest_pressures_mpa());
        self.some_keep_wear = mild_mpa.is_some();
        if let Some(mild_mpa) = mild_mpa {
            self.for_each_group(|group, step| group.keep_mild_wear(step, mild_mpa), lost, wear, &|| false);
        }
    }

    fn evaluate_stage(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let keep = self.some_keep_wear;
        let work = self.evaluate_by(|group, step| group.evaluate_stage(step, keep), lost, wear, depth_mm, stopped)?;
        Ok(if keep { work.of_a_part() } else { work })
    }

    fn evaluate_end(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        if !self.some_keep_wear {
            return self.evaluate(lost, wear, depth_mm, stopped);
        }
        let work = self.evaluate_by(|group, step| group.evaluate_end(step), lost, wear, depth_mm, stopped)?;
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
        let work = self.evaluate_by(|group, step| group.complete_stage(step), lost, wear, depth_mm, stopped)?;
        Ok(Some(work.of_a_part()))
    }

    fn linearise_anew(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        let work = self.evaluate_by(|group, step| group.follow_tilt(step), lost, wear, depth_mm, stopped)?;
        Ok((work.newton_iterations > 0).then_some(Work { mesh_cycles: 0, equilibria: 0, ..work }))
    }

    fn reset(&mut self) {
        let (model, nodes) = (self.model, self.nodes.as_ref());
        self.groups.iter_mut().for_each(|group| group.collected.clear());
        self.groups.par_iter_mut().flat_map(|group| &mut group.loaded_positions).for_each(|loaded| {
            model.reset(&mut loaded.prepared);
            loaded.found = None;
            let is_about_worn = loaded.transfers.iter().any(LoadTransfer::is_about_worn);
            let is_moved = loaded.turned_mm != loaded.prepared.unworn_transmission_error_mm();
            if loaded.windows != loaded.prepared.windows() || is_about_worn || is_moved {
                loaded.observe(model, nodes);
            }
        });
    }

    fn peak_to_peak_mm(&self) -> f64 {
        self.range_of_transmission_error_mm()
    }

    fn observe(&mut self, _lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError> {
        Ok(self.observation())
    }
}

impl CondensedCycle<'_> {
    /// Evaluates all groups by `part` on flanks that have lost `lost`, and collects their wear.
    fn evaluate_by(
        &mut self,
        part: impl Fn(&mut CondensedGroup, &WearEvaluation<'_>) + Sync,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        self.for_each_group(part, lost, wear, stopped);
        Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)
    }

    /// Does `part` in all groups on flanks that have lost `lost`.
    fn for_each_group(
        &mut self,
        part: impl Fn(&mut CondensedGroup, &WearEvaluation<'_>) + Sync,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        let tilt_rad = PerGear::from_fn(|gear| self.nodes[gear].tilt_rad(lost[gear]));
        let worn = Worn { depth_mm: lost, tilt_rad: &tilt_rad };
        let step = WearEvaluation { model: self.model, worn, nodes: self.nodes.as_ref(), wear, stopped };
        self.groups.par_iter_mut().for_each(|group| part(group, &step));
    }
}

/// Nominal radii of the nodes of both flanks, from root to tip.
pub(crate) fn nominal_radii_mm(model: &CondensedPair<'_>, nodes: PerGear<&FlankNodes>) -> PerGear<Vec<f64>> {
    PerGear::from_fn(|gear| {
        let local = model.nominal_radius_mm(gear);
        let mut radius_mm = vec![0.0; local.len()];
        nodes[gear].place.iter().zip(local).for_each(|(&place, radius)| radius_mm[place] = radius);
        radius_mm
    })
}

/// Values at the nominal radii `radius_mm` of a flank from those at its nodes, whose nominal radii are `nodes_mm`: linear between the nodes, that of the
/// last node beyond it, and 0 below the first, where the involute ends.
pub fn at_radii(nodes_mm: &[f64], at_nodes: &[f64], radius_mm: impl Iterator<Item = f64>) -> Vec<f64> {
    radius_mm.map(|radius| if radius < nodes_mm[0] { 0.0 } else { value_at(nodes_mm, at_nodes, radius) }).collect()
}

/// Model, worn flanks and laws of an evaluation.
struct WearEvaluation<'a> {
    model: &'a CondensedPair<'a>,
    worn: Worn<'a>,
    nodes: PerGear<&'a FlankNodes>,
    wear: &'a WearModel<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
}

impl CondensedGroup {
    /// A group without positions.
    fn new(nodes: PerGear<&FlankNodes>) -> Self {
        let collected = Collected::new(nodes.map(FlankNodes::len));
        Self { loaded_positions: Vec::new(), collected, rows: ContactRows::default(), kept_mm: PerGear::default() }
    }

    fn evaluate(&mut self, step: &WearEvaluation<'_>) {
        self.collected.clear();
        self.evaluate_those(|_| true, CondensedPosition::solve, step);
    }

    /// As [`Self::evaluate`], but for positions that keep their wear where they are to `keep` it, and contacts are looked for where they were alone.
    fn evaluate_stage(&mut self, step: &WearEvaluation<'_>, keep: bool) {
        match keep {
            true => self.collected.begin_from(&self.kept_mm),
            false => self.collected.clear(),
        }
        self.evaluate_those(|loaded| !(keep && loaded.keeps_wear), CondensedPosition::solve_again, step);
    }

    /// As [`Self::evaluate`], but for positions that keep their wear.
    fn evaluate_end(&mut self, step: &WearEvaluation<'_>) {
        self.collected.begin_from(&self.kept_mm);
        self.evaluate_those(|loaded| !loaded.keeps_wear, CondensedPosition::solve, step);
    }

    /// Keeps the wear of the positions whose pressure is nowhere above `mild_mpa`.
    fn keep_mild_wear(&mut self, step: &WearEvaluation<'_>, mild_mpa: f64) {
        self.kept_mm = self.collected.depth_mm.as_ref().map(|depth_mm| vec![0.0; depth_mm.len()]);
        for loaded in &mut self.loaded_positions {
            loaded.keeps_wear = loaded.greatest_pressure_mpa() <= mild_mpa;
            if loaded.keeps_wear {
                loaded.wear(step, &mut self.rows, &mut self.kept_mm);
            }
        }
    }

    /// Evaluates the positions that keep their wear, after [`Self::evaluate_end`], and collects the wear of all.
    fn complete_stage(&mut self, step: &WearEvaluation<'_>) {
        self.collected.clear();
        let solve_kept = |loaded: &mut CondensedPosition, step: &WearEvaluation<'_>| {
            if loaded.keeps_wear { loaded.solve(step) } else { Ok(Work::default()) }
        };
        self.evaluate_those(|_| true, solve_kept, step);
    }

    /// Collects the wear of some of the positions, up to the first failure. Returns whether there was none.
    fn evaluate_those(
        &mut self,
        are_asked: impl Fn(&CondensedPosition) -> bool,
        solve: impl Fn(&mut CondensedPosition, &WearEvaluation<'_>) -> Result<Work, EquilibriumError>,
        step: &WearEvaluation<'_>,
    ) -> bool {
        for loaded in self.loaded_positions.iter_mut().filter(|loaded| are_asked(loaded)) {
            let solved = if (step.stopped)() { Err(EquilibriumError::Interrupted) } else { solve(loaded, step) };
            if !self.collected.take(solved) {
                return false;
            }
            loaded.wear(step, &mut self.rows, &mut self.collected.depth_mm);
        }
        true
    }

    /// Lets the positions follow the tilt of the worn flanks.
    fn follow_tilt(&mut self, step: &WearEvaluation<'_>) {
        let followed = self.loaded_positions.iter_mut().try_fold(Work::default(), |mut work, loaded| {
            work += if (step.stopped)() { Err(EquilibriumError::Interrupted) } else { loaded.follow_tilt(step) }?;
            Ok(work)
        });
        if followed == Ok(Work::default()) {
            return self.collected.keep();
        }
        self.collected.clear();
        if self.collected.take(followed) {
            for loaded in &self.loaded_positions {
                loaded.wear(step, &mut self.rows, &mut self.collected.depth_mm);
            }
        }
    }
}

impl CondensedPosition {
    fn new(
        model: &CondensedPair<'_>,
        stretch_mm: (f64, f64),
        line_load_n_per_mm: f64,
        nodes: PerGear<&FlankNodes>,
    ) -> Self {
        let prepared = model.prepare(stretch_mm.0.midpoint(stretch_mm.1), line_load_n_per_mm);
        let mut loaded = Self {
            prepared,
            stretch_mm,
            transfers: Vec::new(),
            turned_mm: 0.0,
            windows: 0,
            found: None,
            keeps_wear: false,
        };
        loaded.observe(model, nodes);
        loaded
    }

    /// Finds the load transfers to the nodes of new flanks, in the present windows.
    fn observe(&mut self, model: &CondensedPair<'_>, nodes: PerGear<&FlankNodes>) {
        self.turned_mm = self.prepared.unworn_transmission_error_mm();
        self.transfers = model.load_transfers(&self.prepared, self.stretch_mm, self.turned_mm, nodes);
        self.windows = self.prepared.windows();
    }

    /// Greatest pressure on any multiplier, MPa.
    fn greatest_pressure_mpa(&self) -> f64 {
        let Some(found) = &self.found else { return 0.0 };
        let of_contacts = self.transfers.iter().flat_map(|contact| {
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            force.iter().zip(&contact.weight_mm).map(|(force, weight)| force / weight)
        });
        of_contacts.fold(0.0, f64::max)
    }

    fn overlap(&self) -> Option<FlankOverlap> {
        let of_transmission_error = self.prepared.overlap_beside_mm() / self.found.as_ref()?.rigid[0];
        Some(FlankOverlap { of_transmission_error, position_mm: self.prepared.position_mm })
    }

    fn solve(&mut self, step: &WearEvaluation<'_>) -> Result<Work, EquilibriumError> {
        let (is_new, windows) = (self.found.is_none(), self.windows);
        let mut work = self.solve_linearised(step)?;
        if is_new || windows != self.windows {
            work += self.follow_tilt(step)?;
        }
        Ok(Work { equilibria: 1, ..work })
    }

    /// Solves within a wear step: where the contact is still where it was, without looking for others.
    fn solve_again(&mut self, step: &WearEvaluation<'_>) -> Result<Work, EquilibriumError> {
        let Self { prepared, transfers, found, .. } = self;
        let opening = |prepared: &PreparedPosition, asked: &[bool], gap_mm: &mut [f64]| {
            for contact in transfers.iter() {
                contact.open_gaps_of(|row| asked[row], step.worn.depth_mm, |row| prepared.tilt_rad(row), gap_mm);
            }
        };
        if found.as_mut().is_some_and(|found| prepared.solve_again(found, opening)) {
            let pair_evaluations = prepared.tooth_pairs() as u64;
            return Ok(Work { equilibria: 1, newton_iterations: 1, pair_evaluations, ..Work::default() });
        }
        self.solve(step)
    }

    /// Follows the tilt of the worn flanks, and finds the contact again as long as that changes it.
    fn follow_tilt(&mut self, step: &WearEvaluation<'_>) -> Result<Work, EquilibriumError> {
        let mut work = Work::default();
        for _ in 0..MOST_TILTS {
            if !self.is_tilted_anew(step) {
                break;
            }
            work += self.solve_linearised(step)?;
        }
        Ok(work)
    }

    /// Finds the contact on the present flanks, in the directions that the position was made for.
    fn solve_linearised(&mut self, step: &WearEvaluation<'_>) -> Result<Work, EquilibriumError> {
        let position_mm = self.prepared.position_mm;
        let Self { prepared, stretch_mm, transfers, turned_mm, windows, .. } = self;
        let opening = &mut |prepared: &PreparedPosition, gap_mm: &mut [f64]| {
            if *windows != prepared.windows() {
                *transfers = step.model.load_transfers(prepared, *stretch_mm, *turned_mm, step.nodes);
                *windows = prepared.windows();
            }
            for contact in transfers.iter() {
                contact.open_gaps(step.worn.depth_mm, |row| prepared.tilt_rad(row), gap_mm);
            }
        };
        let solved =
            step.model.solve(prepared, opening, &|gear, node| step.worn.depth_mm[gear][step.nodes[gear].place[node]]);
        let found = solved.map_err(|source| EquilibriumError::Contact { position_mm, source })?;
        let newton_iterations = found.log.steps.len() as u64;
        let pair_evaluations = newton_iterations * prepared.tooth_pairs() as u64;
        self.found = Some(found);
        Ok(Work { newton_iterations, pair_evaluations, ..Work::default() })
    }

    /// Makes the position anew for its worn flanks where the load acts in another direction, on a tip edge worn to another shape, or under another
    /// transmission error than it was made for. Returns whether it did.
    fn is_tilted_anew(&mut self, step: &WearEvaluation<'_>) -> bool {
        let Some(found) = &self.found else { return false };
        let tilt_rad =
            self.prepared.mean_tilts(&found.force, |gear, node| step.worn.tilt_rad[gear][step.nodes[gear].place[node]]);
        let turns = self.prepared.lever_change(&found.force, &tilt_rad) > LEAST_LEVER_CHANGE;
        if turns {
            step.model.tilt(&mut self.prepared, tilt_rad);
        }
        let turned_mm = found.rigid[0];
        let moves = (turned_mm - self.turned_mm).abs() > LEAST_TURN * turned_mm.abs();
        if moves {
            self.turned_mm = turned_mm;
        }
        let mut reshapes = false;
        for contact in &mut self.transfers {
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            let [turn, tilt] = contact.mates_turn_and_tilt_rad(force, step.worn.tilt_rad);
            let is_reshaped = turn > LEAST_TILT.0.max(LEAST_TILT.1 * tilt);
            reshapes |= is_reshaped;
            if is_reshaped || moves {
                let worn = (is_reshaped || contact.is_about_worn()).then_some(step.worn);
                let (prepared, stretch_mm, turned_mm) = (&self.prepared, self.stretch_mm, self.turned_mm);
                *contact = step.model.load_transfer_anew(contact, prepared, stretch_mm, turned_mm, step.nodes, worn);
            }
        }
        turns || reshapes || moves
    }

    /// Half-width of the heated strip of a tooth pair, mm; 0 without load.
    fn equivalent_half_width_mm(&self, pair: i32, found: &ContactEquilibrium) -> f64 {
        let contact = self.transfers.iter().find(|contact| contact.pair == pair);
        contact.map_or(0.0, |contact| {
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            equivalent_half_width_mm(contact, force.iter().copied())
        })
    }

    /// Adds the wear of the nodes of both flanks.
    fn wear(&self, step: &WearEvaluation<'_>, rows: &mut ContactRows, depth_mm: &mut PerGear<Vec<f64>>) {
        let Some(found) = &self.found else { return };
        for contact in &self.transfers {
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            if force.iter().all(|f| *f <= 0.0) {
                continue;
            }
            rows.pressure_mpa.clear();
            rows.pressure_mpa.extend(force.iter().zip(&contact.weight_mm).map(|(force, weight)| force / weight));
            let place = CondensedContactPlace { model: step.model, contact, stretch_mm: self.stretch_mm };
            let pressed = force.iter().zip(&contact.weight_mm).filter(|(force, _)| **force > 0.0);
            let loaded = LoadedPlace {
                position_mm: place.position_mm(),
                line_load_n_per_mm: force.iter().sum(),
                peak_pressure_mpa: rows.pressure_mpa.iter().copied().fold(0.0, f64::max),
                half_width_mm: 0.5 * pressed.map(|(_, weight_mm)| weight_mm).sum::<f64>(),
            };
            let lambdas = step.wear.lambdas(&loaded);
            for gear in Gear::BOTH {
                let conditions = step.wear.heat_of_law(gear).map(|heat| {
                    let friction_coefficient = step.wear.friction(heat, &loaded);
                    rows.heated.conditions(heat, place, gear, &rows.pressure_mpa, friction_coefficient)
                });
                let sliding_row = SlidingRow {
                    pressure_mpa: &rows.pressure_mpa,
                    sliding_mm: &contact.sliding_mm,
                    conditions,
                    lambda: lambdas[gear],
                    is_continuous: true,
                };
                rows.depth_mm.clear();
                rows.depth_mm.resize(contact.len(), 0.0);
                step.wear.laws[gear].add_depth(&sliding_row, &mut rows.depth_mm);
                contact.wear_nodes(gear, step.nodes[gear], &rows.depth_mm, &mut depth_mm[gear]);
            }
        }
    }
}
