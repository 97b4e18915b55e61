//! Contact of the pair at one position.
//!
//! Every tooth pair that may touch is coupled by mortar on the true profiles in their true places; the multipliers of all
//! pairs, and the pinion's rotation as one more unknown, form one small complementarity problem:
//!
//! ```text
//! g = g⁰ + (B₁ C₁ B₁ᵀ + B₂ C₂ B₂ᵀ) f + B₁ r δ ≥ 0        (B₁ r)ᵀ f = −w        r = ẑ × x / r_b1
//! ```
//!
//! C₁, C₂: compliances of the gears on their candidate nodes; δ: transmission error, the pinion's rotation times its base
//! radius; w: torque over base radius and face width. The wheel is held and the pinion turned at its clamp circle.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use sprs::CsMat;

use super::condensed_pair::CondensedPair;
use super::facing_teeth::FacingTeeth;
use super::flank_surface::MeshedFlank;
use super::prepared::PreparedPosition;
use super::ring::ToothForce;
use crate::gear::{Gear, PerGear};
use gearwear_fem::active_set::{ActiveSetError, ActiveSetLog, ContactEquilibrium};
use gearwear_fem::contact::zones;

/// One tooth pair in contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothPairContact {
    /// Number of the pair: 0 the reference pair, +1 a base pitch ahead, −1 behind.
    pub pair: i32,
    /// Line load, its torque over base radius and face width, N/mm.
    pub line_load_n_per_mm: f64,
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the length of flank under pressure, mm.
    pub half_width_mm: f64,
    /// Radius on the pinion of the pressure's resultant, mm.
    pub pinion_radius_mm: f64,
    /// Gear whose flank has the multipliers.
    pub slave: Gear,
    /// Whether a sharp tip edge carries pressure, whose peak is singular.
    pub at_sharp_edge: bool,
    /// Pressure along the flank, MPa, by the distance from the resultant towards the pinion's tip, mm.
    pub pressure: Vec<(f64, f64)>,
}

/// Principal stress along the surface of a tooth's fillets, MPa.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RootStress {
    /// Greatest tension at the fillet below the working flank.
    pub working_side_mpa: f64,
    /// Greatest compression at the other fillet, negative.
    pub back_side_mpa: f64,
}

/// Contact of the pair at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionContact {
    /// Position ξ, mm.
    pub position_mm: f64,
    /// Pairs in contact, by increasing number.
    pub pairs: Vec<ToothPairContact>,
    /// Transmission error δ, mm.
    pub transmission_error_mm: f64,
    /// Error of the torque ratio, |T2/T1| over z2/z1 less 1.
    pub torque_ratio_error: f64,
    /// Error of the load balance, |Σ line loads / w − 1|.
    pub load_balance: f64,
    /// Largest penetration at a multiplier, mm.
    pub max_penetration_mm: f64,
    /// Forces on each fine tooth, in its own frame.
    pub forces: PerGear<Vec<ToothForce>>,
    /// Stresses at the fillets of the reference pair's teeth.
    pub root: PerGear<RootStress>,
    /// Iterations of the active set.
    pub log: ActiveSetLog,
    /// Number of multipliers.
    pub multipliers: usize,
    /// Active parts of the flank, to start the next position from.
    pub warm: WarmStart,
}

/// Loaded stretch of each pair, by its number: both ends from the expected contact towards the pinion's tip, mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WarmStart(Vec<(i32, f64, f64)>);

impl<'a> CondensedPair<'a> {
    /// Solves at `position_mm` under `line_load_n_per_mm`.
    pub fn at(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        warm: &WarmStart,
    ) -> Result<PositionContact, ActiveSetError> {
        self.solve_from(self.untouched(self.most_beside(), position_mm, line_load_n_per_mm), warm)
    }

    /// Solves as [`Self::at`] does, but with the reference pair alone, which carries the whole load.
    pub fn at_alone(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        warm: &WarmStart,
    ) -> Result<PositionContact, ActiveSetError> {
        self.solve_from(self.untouched(0, position_mm, line_load_n_per_mm), warm)
    }

    fn solve_from(&self, mut prepared: PreparedPosition, warm: &WarmStart) -> Result<PositionContact, ActiveSetError> {
        prepared.active = start(&prepared.facings, &self.flanks, warm);
        let found = self.solve(&mut prepared, &mut |_, _| {}, &|_, _| 0.0)?;
        Ok(self.read(&prepared, found))
    }

    /// Each tooth pair in contact.
    pub fn tooth_pairs(&self, prepared: &PreparedPosition, found: &ContactEquilibrium) -> Vec<ToothPairContact> {
        let loaded = prepared.facings.iter().filter_map(|facing| {
            let force = &found.force[facing.first_row..facing.first_row + facing.coupling.len()];
            force.iter().any(|f| *f > 0.0).then(|| self.tooth_pair(prepared, facing, force).0)
        });
        loaded.collect()
    }

    /// The figures of a solution.
    pub fn read(&self, prepared: &PreparedPosition, found: ContactEquilibrium) -> PositionContact {
        let PreparedPosition { position_mm, ref facings, .. } = *prepared;
        let line_load_n_per_mm = prepared.line_load_n_per_mm();
        let mut forces = self.gears.as_ref().map(|gear| vec![ToothForce::new(); gear.teeth()]);
        let mut pairs = Vec::new();
        let mut warm = Vec::new();
        for facing in facings {
            let force = &found.force[facing.first_row..facing.first_row + facing.coupling.len()];
            if force.iter().all(|f| *f <= 0.0) {
                continue;
            }
            for gear in Gear::BOTH {
                forces[gear][facing.tooth[gear]] = transpose_times(&facing.operator[gear], force);
            }
            let (contact, stretch) = self.tooth_pair(prepared, facing, force);
            warm.push((facing.pair, stretch.0, stretch.1));
            pairs.push(contact);
        }
        let torque = PerGear::from_fn(|gear| {
            let points = &self.flanks[gear].surface.points_mm;
            forces[gear].iter().map(|tooth| moment(points, tooth)).sum::<f64>()
        });
        let ratio = f64::from(self.pair.teeth.wheel.teeth) / f64::from(self.pair.teeth.pinion.teeth);
        let total: f64 = pairs.iter().map(|pair| pair.line_load_n_per_mm).sum();
        PositionContact {
            position_mm,
            pairs,
            transmission_error_mm: found.rigid[0],
            torque_ratio_error: (torque.wheel / torque.pinion).abs() / ratio - 1.0,
            load_balance: (total / line_load_n_per_mm - 1.0).abs(),
            max_penetration_mm: found.gap_mm.iter().fold(0.0, |most, gap| most.max(-gap)),
            root: PerGear::from_fn(|gear| self.root_stress(gear, &forces[gear])),
            forces,
            multipliers: found.gap_mm.len(),
            log: found.log,
            warm: WarmStart(warm),
        }
    }

    fn root_stress(&self, gear: Gear, forces: &[ToothForce]) -> RootStress {
        let compliance = &self.gears[gear];
        let probed = compliance.probed_mpa(compliance.teeth() / 2, forces);
        let (working, back) = probed.split_at(compliance.sector.sector.working_side_probes);
        RootStress {
            working_side_mpa: working.iter().copied().fold(0.0, f64::max),
            back_side_mpa: back.iter().copied().fold(0.0, f64::min),
        }
    }

    /// Figures of one pair and its loaded stretch, from the expected contact towards the pinion's tip.
    fn tooth_pair(
        &self,
        prepared: &PreparedPosition,
        facing: &FacingTeeth,
        force: &[f64],
    ) -> (ToothPairContact, (f64, f64)) {
        let (flank, coupling) = (&self.flanks[facing.slave], &facing.coupling);
        let mut rows: Vec<usize> = (0..coupling.len()).collect();
        let place: Vec<f64> = coupling.nodes.iter().map(|&node| facing.towards_pinion_tip_mm(flank, node)).collect();
        rows.sort_by(|&a, &b| place[a].total_cmp(&place[b]));
        let along: Vec<f64> = rows.iter().map(|&row| place[row]).collect();
        let pressure: Vec<f64> = rows.iter().map(|&row| (force[row] / coupling.weight_mm[row]).max(0.0)).collect();
        let zones = zones::zones(&along, &pressure);
        let half_width_mm = zones.iter().map(|zone| 0.5 * zone.width_mm()).fold(0.0, f64::max);
        let radii = coupling.nodes.iter().map(|&node| (flank.surface.points_mm[node] - facing.pinion_axis_mm).norm());
        let centre_mm = weighted_mean(force, place.iter().copied());
        let stretch = zones.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), zone| {
            (low.min(zone.from_mm), high.max(zone.to_mm))
        });
        let contact = ToothPairContact {
            pair: facing.pair,
            line_load_n_per_mm: prepared.carried_n_per_mm(facing.first_row, force),
            peak_pressure_mpa: pressure.iter().copied().fold(0.0, f64::max),
            half_width_mm,
            pinion_radius_mm: weighted_mean(force, radii),
            slave: facing.slave,
            at_sharp_edge: self.is_at_sharp_edge(facing, force),
            pressure: along.iter().zip(&pressure).map(|(along, p)| (along - centre_mm, *p)).collect(),
        };
        (contact, stretch)
    }

    fn is_at_sharp_edge(&self, facing: &FacingTeeth, force: &[f64]) -> bool {
        Gear::BOTH.into_iter().any(|gear| {
            let (operator, flank) = (&facing.operator[gear], &self.flanks[gear]);
            flank.sharp && is_loaded(operator, force, flank.tip_node())
                || self.pair.teeth[gear].undercut && is_loaded(operator, force, flank.root_node())
        })
    }
}

/// Whether `force` on the rows of a coupling matrix loads a node.
fn is_loaded(operator: &CsMat<f64>, force: &[f64], node: usize) -> bool {
    let mut loaded = operator.outer_iterator().zip(force).filter(|(_, f)| **f > 0.0);
    loaded.any(|(row, _)| row.iter().any(|(column, b)| column / 2 == node && *b != 0.0))
}

/// Moment of forces on the nodes `points` of a tooth about the gear's axis.
fn moment(points: &[Vector2<f64>], forces: &ToothForce) -> f64 {
    let moments = forces.iter().map(|&(column, f)| {
        let x = points[column / 2];
        (if column.is_multiple_of(2) { -x.y } else { x.x }) * f
    });
    moments.sum()
}

/// Mean of `values`, weighted by `force`.
fn weighted_mean(force: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    force.iter().zip(values).map(|(f, value)| f * value).sum::<f64>() / force.iter().sum::<f64>()
}

/// Active set expected from the previous position.
fn start(facings: &[FacingTeeth], flanks: &PerGear<MeshedFlank>, warm: &WarmStart) -> Option<Vec<bool>> {
    if warm.0.is_empty() {
        return None;
    }
    let mut active = Vec::new();
    for facing in facings {
        let before = warm.0.iter().find(|(pair, ..)| *pair == facing.pair);
        active.extend(facing.coupling.nodes.iter().map(|&node| {
            let offset = facing.towards_pinion_tip_mm(&flanks[facing.slave], node);
            before.is_some_and(|(_, low, high)| (*low..=*high).contains(&offset))
        }));
    }
    Some(active)
}

/// Nodal forces Bᵀ f.
fn transpose_times(operator: &CsMat<f64>, force: &[f64]) -> ToothForce {
    let mut sums = BTreeMap::new();
    for (row, f) in operator.outer_iterator().zip(force) {
        for (column, value) in row.iter().filter(|_| *f != 0.0) {
            *sums.entry(column).or_insert(0.0) += value * f;
        }
    }
    sums.into_iter().collect()
}
