//! The mesh cycle on the finite-element model: both gears condensed onto their flanks, contact found from their true, worn profiles.
//!
//! All tooth pairs at a position are in one complementarity problem, coupled through the gear bodies ([`crate::gear_fem`]),
//! and touch wherever their profiles do, also before A and after E, where a tip edge meets its mate outside the line of
//! action. As every tooth of a gear wears alike, the positions of one base pitch tell all: the pairs found there, each at its
//! own place of the path, together are one tooth pair over its whole mesh.
//!
//! What wears are the nodes of both flanks: the load of every multiplier reaches those that it faces while the contact moves on
//! ([`crate::gear_fem::load_transfer`]). Positions are closer together where a tip edge touches, about A and E, for there the contact is
//! narrow, stands still on the edge and runs along the mate; where the number of pairs changes, about B and D, they are closer by that, for
//! a base pitch leads from A to D and from B to E.
//!
//! The couplings of a position are prepared once; from one wear step to the next only the gaps change, and the active set
//! hardly at all.

use rayon::prelude::*;

use super::collected::Collected;
use super::condensed_contact::{ContactPlace, HeatedContactRows, parts_of_rows};
use super::load_sharing::EquilibriumError;
use super::{CycleObservation, GROUPS, GreatestPressure, LostMaterial, MeshCycle, Overlap, PositionObservation, Work};
use crate::contact::Footprint;
use crate::contact::flank_pressure::PressureFigures;
use crate::fem::active_set::ContactEquilibrium;
use crate::gear::{Gear, PerGear, flank_zones::FlankZones};
use crate::gear_fem::condensed_pair::CondensedPair;
use crate::gear_fem::condensed_pair::hertz_half_width_mm;
use crate::gear_fem::flank_nodes::{FlankNodes, Weights};
use crate::gear_fem::load_transfer::LoadTransfer;
use crate::gear_fem::prepared::PreparedPosition;
use crate::gear_fem::tilted::Worn;
use crate::lubrication::running_pair::LoadedPlace;
use crate::reference::{linear_means::value_at, monotone_cubic::MonotoneCubic};
use crate::wear::{SlidingRow, WearModel};

/// How far positions are apart.
#[derive(Clone, Copy)]
struct Apart {
    /// In Hertz half-widths at the pitch point: a contact must not move much farther than it is wide.
    half_widths: f64,
    /// Least and greatest distance over that of positions which divide A–E evenly.
    limits: [f64; 2],
}

/// Away from the tip edges.
const APART: Apart = Apart { half_widths: 0.5, limits: [0.5, 4.0] };
/// Where a tip edge touches, and contact is narrower.
const APART_AT_TIP_EDGES: Apart = Apart { half_widths: 0.15, limits: [0.25, 1.0] };
/// How far the path is looked at beyond A and E, over how far unworn tip edges reach their mates under the approach at the pitch point.
const AMPLE_APPROACH: f64 = 1.3;
/// How far within A–E the tip edge still changes a contact, in Hertz half-widths at the pitch point.
const WITHIN_HALF_WIDTHS: f64 = 2.0;

/// By how much of itself the lever of a tooth pair's load may differ from that on the worn flanks, over the part of the load that other
/// pairs carry: a load share changes by some three times that.
const LEAST_LEVER_CHANGE: f64 = 1e-3;
/// By how much, in rad and over the tilt itself, a tip edge under load may have tilted since.
const LEAST_TILT: (f64, f64) = (0.02, 0.2);
/// By how much of itself the transmission error may differ from that under which what faces what was found.
const LEAST_TURN: f64 = 0.1;
/// Times that a position is made to follow its tilted flanks before its contact is taken as it is.
const MOST_TILTS: usize = 3;

/// One position and how its load reaches the nodes.
struct LoadedPosition {
    prepared: PreparedPosition,
    /// The part of the path that it stands for.
    stretch_mm: (f64, f64),
    /// Of each tooth pair that may touch.
    transfers: Vec<LoadTransfer>,
    /// The transmission error under which that is so, mm; 0 as long as there is none.
    turned_mm: f64,
    /// In which of the windows of `prepared` that was found.
    windows: usize,
    /// The tilt of the worn flanks that it is about; new ones if there is none.
    about_rad: Option<PerGear<Vec<f64>>>,
    found: Option<ContactEquilibrium>,
}

/// Positions that collect wear together.
struct Group {
    loaded_positions: Vec<LoadedPosition>,
    collected: Collected,
    rows: Rows,
}

/// Buffers for the rows of one contact.
#[derive(Default)]
struct Rows {
    pressure_mpa: Vec<f64>,
    depth_mm: Vec<f64>,
    heated: HeatedContactRows,
}

/// All positions of one base pitch, ready to be evaluated on ever newly worn flanks, whose places are the nodes of the flanks.
pub struct CondensedCycle<'a> {
    model: &'a CondensedPair<'a>,
    line_load_n_per_mm: f64,
    nodes: PerGear<FlankNodes>,
    /// Nominal radii of the nodes, from root to tip.
    radius_mm: PerGear<Vec<f64>>,
    groups: Vec<Group>,
    /// Positions from A to E at which the cycle is observed.
    observation_mm: Vec<f64>,
    /// The parts of the flanks that figures of pressure speak of.
    zones: Option<PerGear<FlankZones>>,
}

impl<'a> CondensedCycle<'a> {
    /// Prepares positions as close as `positions` from A to E ask for.
    pub fn new(model: &'a CondensedPair<'a>, positions: usize, line_load_n_per_mm: f64) -> Self {
        let nodes = model.flank_nodes();
        let radius_mm = PerGear::from_fn(|gear| {
            let local = model.nominal_radius_mm(gear);
            let mut radius_mm = vec![0.0; local.len()];
            nodes[gear].place.iter().zip(local).for_each(|(&place, radius)| radius_mm[place] = radius);
            radius_mm
        });
        let stretches = stretches(model, positions, line_load_n_per_mm);
        let groups = stretches
            .par_chunks(stretches.len().div_ceil(GROUPS))
            .map(|stretches| Group {
                loaded_positions: stretches
                    .iter()
                    .map(|&stretch| LoadedPosition::new(model, stretch, line_load_n_per_mm, nodes.as_ref()))
                    .collect(),
                collected: Collected::new(nodes.as_ref().map(FlankNodes::len)),
                rows: Rows::default(),
            })
            .collect();
        let observation_mm = model.pair.path.evenly_mm(positions);
        Self { model, line_load_n_per_mm, nodes, radius_mm, groups, observation_mm, zones: None }
    }

    /// The same with figures of the pressure on these parts of the flanks.
    pub(crate) fn observing(self, zones: PerGear<FlankZones>) -> Self {
        Self { zones: Some(zones), ..self }
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

    /// What `at_nodes` of `gear`'s flank is at the nominal radii `radius_mm`: in straight lines between the nodes, as the wear itself is,
    /// at the tip what it is at the last, and nothing below the first, where the involute ends and their flank with it.
    pub fn at_radii(&self, gear: Gear, at_nodes: &[f64], radius_mm: impl Iterator<Item = f64>) -> Vec<f64> {
        let nodes = &self.radius_mm[gear];
        let at = |radius: f64| if radius < nodes[0] { 0.0 } else { value_at(nodes, at_nodes, radius) };
        radius_mm.map(at).collect()
    }

    fn loaded_positions(&self) -> impl Iterator<Item = &LoadedPosition> {
        self.groups.iter().flat_map(|group| &group.loaded_positions)
    }
}

/// The stretches of one base pitch that positions stand for: short ones where a tip edge touches.
fn stretches(model: &CondensedPair<'_>, positions: usize, line_load_n_per_mm: f64) -> Vec<(f64, f64)> {
    let (pair, path) = (model.pair, &model.pair.path);
    let (start, pitch) = (model.first_position_mm(), path.base_pitch_mm);
    let even = (path.end_mm - path.start_mm) / (positions - 1) as f64;
    let half_width = hertz_half_width_mm(pair, model.contact_modulus_mpa, line_load_n_per_mm, path.pitch_point_mm);
    let within = WITHIN_HALF_WIDTHS * half_width;
    let approach = model
        .at(path.pitch_point_mm, line_load_n_per_mm, &Default::default())
        .map_or(0.0, |contact| contact.transmission_error_mm);
    let [before, after] = pair.tip_reach_mm(AMPLE_APPROACH * approach);
    // Both zones, moved by base pitches to where they begin in this one, and cut at its end.
    let zones = [(path.start_mm - before, path.start_mm + within), (path.end_mm - within, path.end_mm + after)];
    let mut at_edges: Vec<(f64, f64)> = zones
        .into_iter()
        .flat_map(|(from, to)| {
            let length = (to - from).min(pitch);
            let from = (from - start).rem_euclid(pitch);
            [(from, (from + length).min(pitch)), (0.0, from + length - pitch)]
        })
        .filter(|(from, to)| to > from)
        .collect();
    at_edges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut stretches = Vec::new();
    let mut reached = 0.0;
    let mut divide = |reached: &mut f64, to: f64, Apart { half_widths, limits: [least, most] }: Apart| {
        let length = to - *reached;
        if length <= 1e-9 * pitch {
            return;
        }
        let apart = (half_widths * half_width).clamp(least * even, most * even);
        let count = (length / apart - 1e-9).ceil().max(1.0) as usize;
        let at = |k: usize| start + *reached + length * k as f64 / count as f64;
        stretches.extend((0..count).map(|k| (at(k), at(k + 1))));
        *reached = to;
    };
    for (from, to) in at_edges {
        divide(&mut reached, from, APART);
        divide(&mut reached, to, APART_AT_TIP_EDGES);
    }
    divide(&mut reached, pitch, APART);
    stretches
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

    fn reset(&mut self) {
        let (model, nodes) = (self.model, self.nodes.as_ref());
        self.groups.par_iter_mut().flat_map(|group| &mut group.loaded_positions).for_each(|loaded| {
            model.reset(&mut loaded.prepared);
            loaded.found = None;
            if loaded.windows != loaded.prepared.windows() || loaded.about_rad.is_some() || loaded.turned_mm != 0.0 {
                loaded.observe(model, nodes);
            }
        });
    }

    /// Positions from A to E are between those of the base pitch.
    fn observe(&mut self, _lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError> {
        let zeros = || PerGear::from_fn(|gear| vec![0.0; self.nodes[gear].len()]);
        let mut observation = CycleObservation {
            positions: self.along_the_path(),
            shares_at_ends: Some(self.shares_at_ends()),
            greatest_pressure: self.greatest_pressure(),
            pressure_figures: self.pressure_figures(),
            pressure_mpa: zeros(),
            sliding_mm: zeros(),
            sliding_work_n: None,
            slices: None,
            deepest_overlap: self.loaded_positions().filter_map(LoadedPosition::overlap).reduce(Overlap::deeper),
        };
        let mut sliding_work_n = 0.0;
        for loaded in self.loaded_positions() {
            let Some(found) = &loaded.found else { continue };
            for contact in &loaded.transfers {
                for i in 0..contact.len() {
                    let force = found.force[contact.first_row + i];
                    if force <= 0.0 {
                        continue;
                    }
                    sliding_work_n += force * contact.sliding_mm[i];
                    let pressure = force / contact.weight_mm[i];
                    for gear in Gear::BOTH {
                        let Weights { first, weights } = contact.means[gear].row(i);
                        for (k, m) in weights.iter().enumerate().filter(|(_, m)| **m > 0.0) {
                            let greatest = &mut observation.pressure_mpa[gear][first + k];
                            *greatest = greatest.max(pressure);
                            observation.sliding_mm[gear][first + k] +=
                                m * contact.weight_mm[i] / self.nodes[gear].share_mm[first + k] * contact.sliding_mm[i];
                        }
                    }
                }
            }
        }
        observation.sliding_work_n = Some(sliding_work_n);
        Ok(observation)
    }
}

impl CondensedCycle<'_> {
    /// Makes the positions follow the flanks as they are where the last evaluation, on the same `lost`, found that the load acts in
    /// another direction, or on a tip edge worn to another shape, than they were made for. In between they are linear in what is lost,
    /// and so the rate of wear is smooth within a step. Answers what work that took and what each point wears then; nothing, where
    /// there is nothing to follow.
    pub(crate) fn linearise_anew(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Work>, EquilibriumError> {
        let work = self.evaluate_by(|group, step| group.follow_tilt(step), lost, wear, depth_mm, stopped)?;
        Ok((work.newton_iterations > 0).then_some(Work { mesh_cycles: 0, equilibria: 0, ..work }))
    }

    /// Lets each group do its part on flanks that have lost `lost`, and collects what they lose.
    fn evaluate_by(
        &mut self,
        part: impl Fn(&mut Group, &Step<'_>) + Sync,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let tilt_rad = PerGear::from_fn(|gear| self.nodes[gear].tilt_rad(lost.wear_mm[gear]));
        let worn = Worn { depth_mm: lost.wear_mm, tilt_rad: &tilt_rad };
        let step = Step { model: self.model, worn, nodes: self.nodes.as_ref(), wear, stopped };
        self.groups.par_iter_mut().for_each(|group| part(group, &step));
        Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)
    }

    /// Of all pairs found in the base pitch.
    fn greatest_pressure(&self) -> GreatestPressure {
        let mut greatest = GreatestPressure::default();
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            for pair in self.model.tooth_pairs(&loaded.prepared, equilibrium) {
                greatest.note(pair.peak_pressure_mpa, pair.at_sharp_edge);
            }
        }
        greatest
    }

    /// Of all pairs found in the base pitch.
    fn pressure_figures(&self) -> PressureFigures {
        let mut figures = PressureFigures::default();
        let Some(zones) = &self.zones else { return figures };
        for loaded in self.loaded_positions() {
            let Some(found) = &loaded.found else { continue };
            for contact in &loaded.transfers {
                let force = &found.force[contact.first_row..contact.first_row + contact.len()];
                let (parts, cells) = parts_of_rows(contact, force, self.radius_mm(), zones);
                figures.note(parts.figures(&cells));
            }
        }
        figures
    }

    /// Of the pairs found in the base pitch, those that have just come in and those that are about to leave.
    fn shares_at_ends(&self) -> [f64; 2] {
        let mut ends = [(f64::INFINITY, 0.0), (f64::NEG_INFINITY, 0.0)];
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            for pair in self.model.tooth_pairs(&loaded.prepared, equilibrium) {
                let at_mm = loaded.prepared.position_mm + f64::from(pair.pair) * self.model.pair.path.base_pitch_mm;
                let share = pair.line_load_n_per_mm / self.line_load_n_per_mm;
                if at_mm < ends[0].0 {
                    ends[0] = (at_mm, share);
                }
                if at_mm > ends[1].0 {
                    ends[1] = (at_mm, share);
                }
            }
        }
        ends.map(|(_, share)| share)
    }

    /// The reference pair from A to E, from the pairs found in the base pitch.
    fn along_the_path(&self) -> Vec<PositionObservation> {
        let (path, load) = (&self.model.pair.path, self.line_load_n_per_mm);
        let mut found: Vec<PositionObservation> = Vec::new();
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            let at = loaded.prepared.position_mm;
            let pairs = self.model.tooth_pairs(&loaded.prepared, equilibrium);
            let total: f64 = pairs.iter().map(|pair| pair.line_load_n_per_mm).sum();
            let first = ((path.start_mm - at) / path.base_pitch_mm).floor() as i32;
            let last = ((path.end_mm - at) / path.base_pitch_mm).ceil() as i32;
            found.extend((first..=last).map(|ahead| {
                let pair = pairs.iter().find(|pair| pair.pair == ahead);
                PositionObservation {
                    position_mm: at + f64::from(ahead) * path.base_pitch_mm,
                    transmission_error_mm: equilibrium.rigid[0],
                    stiffness_n_per_mm2: equilibrium.resistance.first().copied(),
                    load_share: pair.map_or(0.0, |pair| pair.line_load_n_per_mm / load),
                    load_imbalance: total / load - 1.0,
                    footprint: pair.map_or_else(Footprint::default, |pair| Footprint {
                        peak_pressure_mpa: pair.peak_pressure_mpa,
                        half_width_mm: pair.half_width_mm,
                        at_sharp_edge: pair.at_sharp_edge,
                    }),
                }
            }));
        }
        found.sort_by(|a, b| a.position_mm.total_cmp(&b.position_mm));
        let places: Vec<f64> = found.iter().map(|at| at.position_mm).collect();
        let course = |of: &dyn Fn(&PositionObservation) -> f64| -> Vec<f64> {
            let values: Vec<f64> = found.iter().map(of).collect();
            let curve = MonotoneCubic::new(&places, &values);
            self.observation_mm.iter().map(|&at| curve.at(at)).collect()
        };
        let transmission_error = course(&|at| at.transmission_error_mm);
        let stiffness = course(&|at| at.stiffness_n_per_mm2.unwrap_or_default());
        let (share, imbalance) = (course(&|at| at.load_share), course(&|at| at.load_imbalance));
        let (peak, half_width) =
            (course(&|at| at.footprint.peak_pressure_mpa), course(&|at| at.footprint.half_width_mm));
        // Between two positions of which one is at a sharp edge, what is in between is too.
        let at_sharp_edge = |at_mm: f64| {
            let after = places.partition_point(|&place| place < at_mm);
            found[after.saturating_sub(1)..(after + 1).min(found.len())].iter().any(|at| at.footprint.at_sharp_edge)
        };
        (0..self.observation_mm.len())
            .map(|k| PositionObservation {
                position_mm: self.observation_mm[k],
                transmission_error_mm: transmission_error[k],
                stiffness_n_per_mm2: Some(stiffness[k]),
                load_share: share[k],
                load_imbalance: imbalance[k],
                footprint: Footprint {
                    peak_pressure_mpa: peak[k],
                    half_width_mm: half_width[k],
                    at_sharp_edge: at_sharp_edge(self.observation_mm[k]),
                },
            })
            .collect()
    }
}

/// What the evaluation of a wear step is made of.
struct Step<'a> {
    model: &'a CondensedPair<'a>,
    worn: Worn<'a>,
    nodes: PerGear<&'a FlankNodes>,
    wear: &'a WearModel<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
}

impl Group {
    fn evaluate(&mut self, step: &Step<'_>) {
        self.collected.clear();
        for loaded in &mut self.loaded_positions {
            let solved = if (step.stopped)() { Err(EquilibriumError::Interrupted) } else { loaded.solve(step) };
            if !self.collected.take(solved) {
                return;
            }
            loaded.wear(step, &mut self.rows, &mut self.collected.depth_mm);
        }
    }

    /// Lets the positions follow the tilt of the worn flanks.
    fn follow_tilt(&mut self, step: &Step<'_>) {
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

impl LoadedPosition {
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
            about_rad: None,
            found: None,
        };
        loaded.observe(model, nodes);
        loaded
    }

    /// The load's way to the nodes of new flanks, in the window as it is now.
    fn observe(&mut self, model: &CondensedPair<'_>, nodes: PerGear<&FlankNodes>) {
        self.transfers = model.load_transfers(&self.prepared, self.stretch_mm, 0.0, nodes, None);
        (self.turned_mm, self.windows, self.about_rad) = (0.0, self.prepared.windows(), None);
    }

    fn overlap(&self) -> Option<Overlap> {
        let of_transmission_error = self.prepared.overlap_beside_mm() / self.found.as_ref()?.rigid[0];
        Some(Overlap { of_transmission_error, position_mm: self.prepared.position_mm })
    }

    fn solve(&mut self, step: &Step<'_>) -> Result<Work, EquilibriumError> {
        let (is_new, windows) = (self.found.is_none(), self.windows);
        let mut work = self.solve_linearised(step)?;
        if is_new || windows != self.windows {
            work += self.follow_tilt(step)?;
        }
        Ok(Work { equilibria: 1, ..work })
    }

    /// Follows the tilt of the worn flanks, and finds the contact again as long as that moves it; answers the work that took.
    fn follow_tilt(&mut self, step: &Step<'_>) -> Result<Work, EquilibriumError> {
        let mut work = Work::default();
        for _ in 0..MOST_TILTS {
            if !self.is_tilted_anew(step) {
                break;
            }
            work += self.solve_linearised(step)?;
        }
        Ok(work)
    }

    /// Finds the contact on the flanks as they are, in the directions that the position was made for.
    fn solve_linearised(&mut self, step: &Step<'_>) -> Result<Work, EquilibriumError> {
        let position_mm = self.prepared.position_mm;
        let Self { prepared, stretch_mm, transfers, turned_mm, windows, about_rad, .. } = self;
        let mut opening = |prepared: &PreparedPosition, gap_mm: &mut [f64]| {
            if *windows != prepared.windows() {
                *transfers = step.model.load_transfers(prepared, *stretch_mm, *turned_mm, step.nodes, None);
                (*windows, *about_rad) = (prepared.windows(), None);
            }
            for contact in transfers.iter() {
                contact.open_gaps(step.worn.depth_mm, |row| prepared.tilt_rad(row), gap_mm);
            }
        };
        let depth_mm = |gear: Gear, node: usize| step.worn.depth_mm[gear][step.nodes[gear].place[node]];
        let solved = step.model.solve(prepared, &mut opening, &depth_mm);
        let found = solved.map_err(|source| EquilibriumError::Contact { position_mm, source })?;
        let newton_iterations = found.log.steps.len() as u64;
        let pair_evaluations = newton_iterations * prepared.tooth_pairs() as u64;
        self.found = Some(found);
        Ok(Work { newton_iterations, pair_evaluations, ..Work::default() })
    }

    /// Makes the position for its worn flanks where the load acts in another direction, on a tip edge worn to another shape, or under another
    /// transmission error than it was made for; answers whether that was so.
    fn is_tilted_anew(&mut self, step: &Step<'_>) -> bool {
        let Some(found) = &self.found else { return false };
        let tilt_rad = |gear: Gear, node: usize| step.worn.tilt_rad[gear][step.nodes[gear].place[node]];
        let tilt_rad = self.prepared.mean_tilts(&found.force, tilt_rad);
        let turns = self.prepared.lever_change(&found.force, &tilt_rad) > LEAST_LEVER_CHANGE;
        if turns {
            step.model.tilt(&mut self.prepared, tilt_rad);
        }
        let reshapes = self.has_reshaped(step, found);
        let turned_mm = found.rigid[0];
        let moves = (turned_mm - self.turned_mm).abs() > LEAST_TURN * turned_mm.abs();
        if reshapes {
            self.about_rad = Some(step.worn.tilt_rad.clone());
        }
        if reshapes || moves {
            let worn = self.about_rad.is_some().then_some(step.worn);
            let (prepared, stretch_mm) = (&self.prepared, self.stretch_mm);
            self.transfers = step.model.load_transfers(prepared, stretch_mm, turned_mm, step.nodes, worn);
            self.turned_mm = turned_mm;
        }
        turns || reshapes || moves
    }

    /// Whether a tip edge under load has another shape.
    fn has_reshaped(&self, step: &Step<'_>, found: &ContactEquilibrium) -> bool {
        self.transfers.iter().any(|contact| {
            let mate = contact.slave.mate();
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            let [turn, tilt] = contact.mean_on(mate, force, |place| {
                let now = step.worn.tilt_rad[mate][place];
                let known = self.about_rad.as_ref().map_or(0.0, |about| about[mate][place]);
                [(now - known).abs(), now.abs()]
            });
            turn > LEAST_TILT.0.max(LEAST_TILT.1 * tilt)
        })
    }

    /// Adds what the nodes of both flanks lose.
    fn wear(&self, step: &Step<'_>, rows: &mut Rows, depth_mm: &mut PerGear<Vec<f64>>) {
        let Some(found) = &self.found else { return };
        for contact in &self.transfers {
            let force = &found.force[contact.first_row..contact.first_row + contact.len()];
            if force.iter().all(|f| *f <= 0.0) {
                continue;
            }
            rows.pressure_mpa.clear();
            rows.pressure_mpa.extend(force.iter().zip(&contact.weight_mm).map(|(force, weight)| force / weight));
            let place = ContactPlace { model: step.model, contact, stretch_mm: self.stretch_mm };
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
                };
                rows.depth_mm.clear();
                rows.depth_mm.resize(contact.len(), 0.0);
                step.wear.laws[gear].add_depth(&sliding_row, &mut rows.depth_mm);
                contact.wear_nodes(gear, step.nodes[gear], &rows.depth_mm, &mut depth_mm[gear]);
            }
        }
    }
}
