//! The working cycle on the finite-element model: both gears condensed onto their flanks, contact found from their true,
//! worn profiles.
//!
//! All tooth pairs at a position are in one complementarity problem, coupled through the gear bodies ([`crate::fem::gear`]),
//! and touch wherever their profiles do, also before A and after E, where a tip edge meets its mate outside the line of
//! action. As every tooth of a gear wears alike, the positions of one base pitch tell all: the pairs found there, each at its
//! own place of the path, together are one tooth pair over its whole mesh. Positions are as far apart as those that divide
//! A–E evenly, rounded to a whole number in a base pitch, and the sum over them is that of a periodic function.
//!
//! The couplings of a position are prepared once; from one wear step to the next only the gaps change, and the active set
//! hardly at all.

use rayon::prelude::*;

use super::collected::Collected;
use super::load_sharing::EquilibriumError;
use super::{CycleObservation, GROUPS, LostMaterial, MeshCycle, PositionObservation, Work};
use crate::contact::{Flanks, Footprint};
use crate::fem::gear::observed_flank::{FlankPoints, ObservedFlank};
use crate::fem::gear::position::CondensedPair;
use crate::fem::gear::prepared::{NodalWear, Prepared};
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use crate::thermal::{ContactHeat, SpeedRatios};
use crate::wear::{
    Rubbing, WearModel,
    heated_row::{HeatedContact, HeatedRow, RowOfPoints},
};

/// One position and how the flank points read it.
struct Station {
    prepared: Prepared,
    /// Of each tooth pair that may touch.
    observed: Vec<PerGear<RubbedFlank>>,
    /// For how many looks that holds.
    looks: usize,
    /// Pressures at the multipliers in the last equilibrium.
    nodal_mpa: Vec<f64>,
}

/// The points of one flank that a tooth pair may rub at a position.
struct RubbedFlank {
    points: ObservedFlank,
    /// How far each slides, mm.
    sliding_mm: Vec<f64>,
    /// Distance of the points along the flank, mm.
    spacing_mm: f64,
    /// How fast both surfaces move through the contact.
    rolling: PerGear<f64>,
}

impl RubbedFlank {
    /// The contact whose pressures these points feel, as a source of heat: its half-width is that of Hertz's ellipse with the same
    /// second moment.
    fn heated<'a>(&self, gear: Gear, heat: &'a ContactHeat, pressure_mpa: &[f64], length_mm: f64) -> HeatedContact<'a> {
        let (mut sum, mut first, mut second, mut slid) = (0.0, 0.0, 0.0, 0.0);
        for (k, (pressure, sliding)) in pressure_mpa.iter().zip(&self.sliding_mm).enumerate() {
            let place = k as f64 * self.spacing_mm;
            sum += pressure;
            first += pressure * place;
            second += pressure * place * place;
            slid += pressure * sliding;
        }
        if sum <= 0.0 {
            return HeatedContact { heat, ratios: SpeedRatios::default(), line_load_n_per_mm: 0.0, half_width_mm: 0.0 };
        }
        // Each point stands for its spacing; the mean over the stretch, during which the contact moves along, spreads the pressure.
        let moved_mm = self.rolling[gear] * length_mm;
        let variance = second / sum - (first / sum).powi(2) + (self.spacing_mm.powi(2) - moved_mm.powi(2)) / 12.0;
        let least = self.spacing_mm.powi(2) / 12.0;
        HeatedContact {
            heat,
            ratios: SpeedRatios { sliding: slid / sum / length_mm, rolling: self.rolling },
            line_load_n_per_mm: sum * self.spacing_mm,
            half_width_mm: 2.0 * variance.max(least).sqrt(),
        }
    }
}

/// Positions that collect wear together.
struct Group {
    stations: Vec<Station>,
    collected: Collected,
    pressure_mpa: Vec<f64>,
    heated: HeatedRow,
}

/// All positions of one base pitch, ready to be evaluated on ever newly worn flanks.
pub struct CondensedCycle<'a> {
    model: &'a CondensedPair<'a>,
    line_load_n_per_mm: f64,
    /// Nominal radii of the flank points.
    radius_mm: PerGear<Vec<f64>>,
    /// Nominal radii of the flanks' nodes.
    node_radius_mm: PerGear<Vec<f64>>,
    groups: Vec<Group>,
    /// Positions from A to E at which the cycle is observed; prepared when first asked for.
    observation_mm: Vec<f64>,
    observation: Vec<Prepared>,
}

impl<'a> CondensedCycle<'a> {
    /// Prepares positions as far apart as `positions` from A to E.
    pub fn new(model: &'a CondensedPair<'a>, flanks: Flanks<'_>, positions: usize, line_load_n_per_mm: f64) -> Self {
        let path = &model.pair.path;
        let radius_mm = PerGear::from_fn(|gear| {
            let involute = model.pair.teeth[gear].involute;
            flanks.grid[gear].coordinate_mm.iter().map(|&rho| involute.radius_mm(rho)).collect::<Vec<f64>>()
        });
        let spacing = (path.end_mm - path.start_mm) / (positions - 1) as f64;
        let in_a_pitch = (path.base_pitch_mm / spacing).round().max(1.0) as usize;
        let length_mm = path.base_pitch_mm / in_a_pitch as f64;
        let pitch_mm: Vec<f64> = (0..in_a_pitch).map(|j| path.start_mm + j as f64 * length_mm).collect();
        let node_radius_mm = PerGear::from_fn(|gear| model.nominal_radius_mm(gear));
        let points = flank_points(&radius_mm, &node_radius_mm);
        let groups = pitch_mm
            .par_chunks(in_a_pitch.div_ceil(GROUPS))
            .map(|positions| Group {
                stations: positions
                    .iter()
                    .map(|&at| Station::new(model, model.prepare(at, line_load_n_per_mm), points, length_mm))
                    .collect(),
                collected: Collected::new(radius_mm.as_ref().map(Vec::len)),
                pressure_mpa: Vec::new(),
                heated: HeatedRow::default(),
            })
            .collect();
        let observation_mm = path.evenly_mm(positions);
        Self { model, line_load_n_per_mm, radius_mm, node_radius_mm, groups, observation_mm, observation: Vec::new() }
    }

    /// Stretch of the path that each position stands for.
    fn length_mm(&self) -> f64 {
        let positions: usize = self.groups.iter().map(|group| group.stations.len()).sum();
        self.model.pair.path.base_pitch_mm / positions as f64
    }

    /// Wear at the nodes of both flanks.
    fn nodal_wear(&self, wear_mm: PerGear<&[f64]>) -> NodalWear {
        PerGear::from_fn(|gear| {
            let (radius, wear) = (&self.radius_mm[gear], wear_mm[gear]);
            self.node_radius_mm[gear].iter().map(|&node| interpolated(radius, wear, node)).collect()
        })
    }
}

/// The points of both flanks.
fn flank_points<'a>(
    radius_mm: &'a PerGear<Vec<f64>>,
    node_radius_mm: &'a PerGear<Vec<f64>>,
) -> PerGear<FlankPoints<'a>> {
    PerGear::from_fn(|gear| FlankPoints { radius_mm: &radius_mm[gear], node_radius_mm: &node_radius_mm[gear] })
}

/// Value at `x` of what is given at the evenly spaced, increasing `places`; beyond their ends, the value there.
///
/// A cubic on each interval, with the harmonic mean of the neighbouring slopes at its ends where they agree in sign: without
/// kinks, which elastic surfaces would answer with peaks of pressure, and without overshoot.
///
/// Source: F. N. Fritsch and J. Butland, *SIAM J. Sci. Stat. Comput.* 5 (1984) 300.
fn interpolated(places: &[f64], values: &[f64], x: f64) -> f64 {
    let last = places.len() - 1;
    let after = places.partition_point(|&place| place <= x).clamp(1, last);
    let before = after - 1;
    let h = places[after] - places[before];
    let t = ((x - places[before]) / h).clamp(0.0, 1.0);
    let rise = |i: usize| values[i + 1] - values[i];
    let slope = |i: usize| match (i, i == last) {
        (0, _) => rise(0),
        (_, true) => rise(last - 1),
        _ if rise(i - 1) * rise(i) > 0.0 => 2.0 * rise(i - 1) * rise(i) / (rise(i - 1) + rise(i)),
        _ => 0.0,
    };
    let (a, b) = (slope(before), slope(after));
    let d = rise(before);
    values[before] + t * (a + t * ((3.0 * d - 2.0 * a - b) + t * (a + b - 2.0 * d)))
}

impl MeshCycle for CondensedCycle<'_> {
    fn evaluate(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let nodal_wear = self.nodal_wear(lost.wear_mm);
        let length_mm = self.length_mm();
        let points = flank_points(&self.radius_mm, &self.node_radius_mm);
        let step = Step { model: self.model, nodal_wear: &nodal_wear, points, length_mm, wear, stopped };
        self.groups.par_iter_mut().for_each(|group| group.evaluate(&step));
        Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)
    }

    fn forget(&mut self) {
        let (model, length_mm) = (self.model, self.length_mm());
        let points = flank_points(&self.radius_mm, &self.node_radius_mm);
        self.groups.par_iter_mut().flat_map(|group| &mut group.stations).for_each(|station| {
            model.forget(&mut station.prepared);
            if station.looks != station.prepared.looks() {
                station.look(model, points, length_mm);
            }
        });
        self.observation.par_iter_mut().for_each(|prepared| model.forget(prepared));
    }

    fn observe(&mut self, lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError> {
        let wear = self.nodal_wear(lost.wear_mm);
        let (model, load) = (self.model, self.line_load_n_per_mm);
        if self.observation.is_empty() {
            self.observation = self.observation_mm.par_iter().map(|&at| model.prepare(at, load)).collect();
        }
        let positions =
            self.observation.par_iter_mut().map(|at| observe_position(model, at, &wear)).collect::<Vec<_>>();
        let zeros = || PerGear::from_fn(|gear| vec![0.0; self.radius_mm[gear].len()]);
        let mut observation = CycleObservation {
            positions: positions.into_iter().collect::<Result<_, _>>()?,
            pressure_mpa: zeros(),
            sliding_mm: zeros(),
            slices: None,
        };
        for station in self.groups.iter().flat_map(|group| &group.stations) {
            for pair in &station.observed {
                for gear in Gear::BOTH {
                    let RubbedFlank { points, sliding_mm: sliding, .. } = &pair[gear];
                    let first = points.first_point;
                    for (k, pressure) in points.greatest_mpa(&station.nodal_mpa).enumerate() {
                        if pressure > 0.0 {
                            let greatest = &mut observation.pressure_mpa[gear][first + k];
                            *greatest = greatest.max(pressure);
                            observation.sliding_mm[gear][first + k] += sliding[k];
                        }
                    }
                }
            }
        }
        Ok(observation)
    }
}

/// What the evaluation of a wear step is made of.
struct Step<'a> {
    model: &'a CondensedPair<'a>,
    nodal_wear: &'a NodalWear,
    points: PerGear<FlankPoints<'a>>,
    length_mm: f64,
    wear: &'a WearModel<'a>,
    stopped: &'a (dyn Fn() -> bool + Sync),
}

impl Group {
    fn evaluate(&mut self, step: &Step<'_>) {
        self.collected.clear();
        for station in &mut self.stations {
            let solved = if (step.stopped)() { Err(EquilibriumError::Interrupted) } else { station.solve(step) };
            if !self.collected.take(solved) {
                return;
            }
            for pair in &station.observed {
                for gear in Gear::BOTH {
                    let flank = &pair[gear];
                    let (points, sliding) = (&flank.points, &flank.sliding_mm);
                    self.pressure_mpa.clear();
                    self.pressure_mpa.extend(points.pressure_mpa(&station.nodal_mpa));
                    let range = points.first_point..points.first_point + sliding.len();
                    let (row, pressure) = (&mut self.heated, &self.pressure_mpa);
                    let surroundings = step.wear.heat_of_law().map(|heat| {
                        let contact = flank.heated(gear, heat, pressure, step.length_mm);
                        let points = RowOfPoints { gear, spacing_mm: flank.spacing_mm, pressure_mpa: pressure };
                        row.across_sliding(&contact, points, sliding, step.length_mm / heat.speed_mm_per_s)
                    });
                    let rubbing = Rubbing { pressure_mpa: pressure, sliding_mm: sliding, surroundings };
                    step.wear.law.add_depth(&rubbing, &mut self.collected.depth_mm[gear][range]);
                }
            }
        }
    }
}

impl Station {
    fn new(model: &CondensedPair<'_>, prepared: Prepared, points: PerGear<FlankPoints<'_>>, length_mm: f64) -> Self {
        let mut station = Self { prepared, observed: Vec::new(), looks: 0, nodal_mpa: Vec::new() };
        station.look(model, points, length_mm);
        station
    }

    /// Reads anew which points are near the contact.
    fn look(&mut self, model: &CondensedPair<'_>, points: PerGear<FlankPoints<'_>>, length_mm: f64) {
        let path = &model.pair.path;
        let turn = path.relative_turn_per_mm();
        let rubbed = |gear: Gear, own: ObservedFlank, rolling: PerGear<f64>| {
            let sliding_mm = own.sliding_mm(turn, length_mm);
            let radii = points[gear].radius_mm;
            let last = (own.first_point + sliding_mm.len()).min(radii.len()).saturating_sub(1);
            let first = own.first_point.min(last);
            // The arc of an involute from its base circle on is (r² − r_b²)/(2 r_b).
            let arc = (radii[last].powi(2) - radii[first].powi(2)) / (2.0 * path.involute[gear].base_radius_mm);
            let spacing_mm = if last > first { arc / (last - first) as f64 } else { 0.0 };
            RubbedFlank { points: own, sliding_mm, spacing_mm, rolling }
        };
        let pairs = model.observed_pairs(&self.prepared, length_mm, points);
        self.observed = pairs
            .into_iter()
            .map(|(pair, PerGear { pinion, wheel })| {
                // Before A and after E, surfaces roll about as fast as there.
                let own_mm = self.prepared.position_mm + f64::from(pair) * path.base_pitch_mm;
                let at_mm = own_mm.clamp(path.start_mm, path.end_mm);
                let rolling = PerGear::from_fn(|gear| model.pair.rolling_ratio(gear, at_mm));
                PerGear { pinion: rubbed(Gear::Pinion, pinion, rolling), wheel: rubbed(Gear::Wheel, wheel, rolling) }
            })
            .collect();
        self.looks = self.prepared.looks();
    }

    fn solve(&mut self, step: &Step<'_>) -> Result<Work, EquilibriumError> {
        let position_mm = self.prepared.position_mm;
        let found = step
            .model
            .solve(&mut self.prepared, Some(step.nodal_wear))
            .map_err(|source| EquilibriumError::Contact { position_mm, source })?;
        if self.looks != self.prepared.looks() {
            self.look(step.model, step.points, step.length_mm);
        }
        self.prepared.nodal_pressure_mpa(&found.force, &mut self.nodal_mpa);
        let iterations = found.log.steps.len() as u64;
        Ok(Work {
            mesh_cycles: 0,
            equilibria: 1,
            newton_iterations: iterations,
            pair_evaluations: iterations * self.prepared.tooth_pairs() as u64,
        })
    }
}

/// The reference pair at one position of the path.
fn observe_position(
    model: &CondensedPair<'_>,
    prepared: &mut Prepared,
    wear: &NodalWear,
) -> Result<PositionObservation, EquilibriumError> {
    let (position_mm, load) = (prepared.position_mm, prepared.line_load_n_per_mm());
    let found =
        model.solve(prepared, Some(wear)).map_err(|source| EquilibriumError::Contact { position_mm, source })?;
    let pairs = model.tooth_pairs(prepared, &found);
    let total: f64 = pairs.iter().map(|pair| pair.line_load_n_per_mm).sum();
    let reference = pairs.iter().find(|pair| pair.pair == 0);
    Ok(PositionObservation {
        position_mm,
        transmission_error_mm: found.rigid[0],
        load_share: reference.map_or(0.0, |pair| pair.line_load_n_per_mm / load),
        load_imbalance: total / load - 1.0,
        footprint: reference.map_or_else(Footprint::default, |pair| Footprint {
            peak_pressure_mpa: pair.peak_pressure_mpa,
            half_width_mm: pair.half_width_mm,
        }),
    })
}
