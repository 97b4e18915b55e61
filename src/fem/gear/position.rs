//! The contact of the pair at one position.
//!
//! Every tooth pair that may touch is coupled by mortar on the true profiles in their true places; the multipliers of all
//! pairs, and the pinion's rotation as one more unknown, form one small complementarity problem:
//!
//! ```text
//! g = g⁰ + (B₁ C₁ B₁ᵀ + B₂ C₂ B₂ᵀ) f + B₁ r δ ≥ 0        (B₁ r)ᵀ f = −w        r = ẑ × x / r_b1
//! ```
//!
//! Of the two flanks, one is in contact with its addendum: the wheel's below the pitch point, the pinion's above it. Where its
//! tip edge is sharp, the pressure lives on it, so that multipliers end where the flank ends. Where it is rounded, the
//! pressure lives on the mate, so that normals are those of the smoother surface: normals that turn within the contact
//! would mix the sliding of the surfaces on each other into the gap.
//!
//! C₁, C₂: compliances of the gears on their candidate nodes; δ: transmission error, the pinion's rotation times its base
//! radius; w: torque over base radius and face width. The wheel is held at its clamp circle, the pinion turned at its own.

use std::collections::BTreeMap;

use faer::Mat;
use nalgebra::{Rotation2, Vector2};
use sprs::CsMat;

use super::flank_surface::FlankSurface;
use super::model::hertz_half_width_mm;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::ring::{Between, GearCompliance, ToothForce};
use crate::fem::active_set::{ActiveSetError, Condensed, Log};
use crate::fem::contact::{mortar::Coupling, zones};
use crate::gear::{Gear, GearPair, PerGear};

/// Distance between the flanks within which they may come to touch, in units of line load over E*: an approach is some
/// ten of these.
const FIRST_REACH: f64 = 25.0;
/// Half-widths on either side of the expected contact in which multipliers are looked for first.
const FIRST_WINDOW: f64 = 1.4;
/// How much wider each further look is.
const WIDER: f64 = 1.6;
/// Looks before giving up.
const MOST_LOOKS: usize = 8;
/// Rows at an inner end of the window that must stay without load.
const FREE_ROWS: usize = 3;
/// Parts of a base pitch before A and after E in which contact outside the line of action is looked for.
const OUTSIDE_BASE_PITCHES: f64 = 0.3;

/// The pair with both gears condensed.
pub struct CondensedPair<'a> {
    /// Geometry.
    pub pair: &'a GearPair,
    /// Both gears.
    pub gears: PerGear<GearCompliance>,
    /// Their working flanks.
    pub flanks: PerGear<FlankSurface>,
    /// E*, MPa.
    pub contact_modulus_mpa: f64,
}

/// One tooth pair in contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothPairContact {
    /// 0 the reference pair, +1 the one a base pitch ahead, −1 the one behind.
    pub pair: i32,
    /// Its share of the torque over base radius and face width, N/mm.
    pub line_load_n_per_mm: f64,
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the length of flank under pressure, mm.
    pub half_width_mm: f64,
    /// Radius on the pinion where the pressure's resultant acts, mm.
    pub pinion_radius_mm: f64,
    /// The gear whose flank carries the multipliers.
    pub slave: Gear,
    /// Whether a sharp tip edge carries pressure: its peak then is singular.
    pub at_sharp_edge: bool,
    /// Pressure along the flank: distance from the resultant towards the pinion's tip in mm, MPa.
    pub pressure: Vec<(f64, f64)>,
}

/// Stress along the surface of a tooth's fillets, which is the principal stress there, MPa.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RootStress {
    /// Greatest at the fillet below the working flank: tension.
    pub working_side_mpa: f64,
    /// Least at the other fillet: compression.
    pub back_side_mpa: f64,
}

/// The pair at one position.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionContact {
    /// ξ.
    pub position_mm: f64,
    /// Pairs in contact, by increasing number.
    pub pairs: Vec<ToothPairContact>,
    /// δ, mm.
    pub transmission_error_mm: f64,
    /// |T2/T1| over z2/z1, less 1.
    pub torque_ratio_error: f64,
    /// |Σ line loads / w − 1|.
    pub load_balance: f64,
    /// Largest overlap left at a multiplier, mm.
    pub max_penetration_mm: f64,
    /// Forces on each fine tooth, in its own frame.
    pub forces: PerGear<Vec<ToothForce>>,
    /// Stresses at the fillets of the reference pair's teeth.
    pub root: PerGear<RootStress>,
    /// Iterations of the active set.
    pub log: Log,
    /// Number of multipliers.
    pub multipliers: usize,
    /// Active parts of the flank, to start the next position from.
    pub warm: WarmStart,
}

/// Where each pair was loaded: its number and the stretch from the expected contact towards the pinion's tip, mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WarmStart(Vec<(i32, f64, f64)>);

/// How far around the expected contact multipliers are looked for.
struct Window {
    line_load_n_per_mm: f64,
    half_widths: f64,
    reach_mm: f64,
}

/// A tooth pair prepared for contact.
struct Facing {
    pair: i32,
    slave: Gear,
    /// Places of its teeth among the fine ones.
    tooth: PerGear<usize>,
    coupling: Coupling,
    /// B for each gear, in its own tooth's frame.
    operator: PerGear<CsMat<f64>>,
    /// Expected contact from the slave's tip end, mm.
    expected_mm: f64,
    /// The pinion's axis in the frame of the slave's tooth.
    pinion_axis_mm: Vector2<f64>,
    /// Whether the window's ends are inner ones: towards the tip, towards the root.
    inner_ends: (bool, bool),
    first_row: usize,
}

impl<'a> CondensedPair<'a> {
    /// Solves at `position_mm` under `line_load_n_per_mm`.
    ///
    /// # Errors
    /// See [`ActiveSetError`].
    pub fn at(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        warm: &WarmStart,
    ) -> Result<PositionContact, ActiveSetError> {
        self.among((self.gears.pinion.teeth() / 2) as i32, position_mm, line_load_n_per_mm, warm)
    }

    /// Solves as [`Self::at`] does, but with the reference pair alone in contact: it carries the whole load.
    ///
    /// # Errors
    /// See [`ActiveSetError`].
    pub fn at_alone(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        warm: &WarmStart,
    ) -> Result<PositionContact, ActiveSetError> {
        self.among(0, position_mm, line_load_n_per_mm, warm)
    }

    /// Solves with the reference pair and `beside` pairs on either side of it.
    fn among(
        &self,
        beside: i32,
        position_mm: f64,
        line_load_n_per_mm: f64,
        warm: &WarmStart,
    ) -> Result<PositionContact, ActiveSetError> {
        let mut window = Window {
            line_load_n_per_mm,
            half_widths: FIRST_WINDOW,
            reach_mm: FIRST_REACH * line_load_n_per_mm / self.contact_modulus_mpa,
        };
        for _ in 1..MOST_LOOKS {
            let facings = self.facings(beside, position_mm, &window);
            let condensed = self.condensed(&facings, line_load_n_per_mm);
            let start = start(&facings, &self.flanks, warm);
            match condensed.solve(start.as_deref()) {
                Ok(found) if !facings.iter().any(|facing| is_cramped(facing, &found.force, self)) => {
                    return Ok(self.read(position_mm, line_load_n_per_mm, &facings, found));
                }
                // Flanks far relieved touch elsewhere, and later.
                Ok(_) | Err(ActiveSetError::NoContact { .. }) => {
                    window.half_widths *= WIDER;
                    window.reach_mm *= WIDER;
                }
                Err(error) => return Err(error),
            }
        }
        let facings = self.facings(beside, position_mm, &window);
        let found = self.condensed(&facings, line_load_n_per_mm).solve(None)?;
        Ok(self.read(position_mm, line_load_n_per_mm, &facings, found))
    }

    fn facings(&self, beside: i32, position_mm: f64, window: &Window) -> Vec<Facing> {
        let mut first_row = 0;
        (-beside..=beside)
            .filter_map(|pair| {
                let mut facing = self.facing(position_mm, pair, window)?;
                facing.first_row = first_row;
                first_row += facing.coupling.len();
                Some(facing)
            })
            .collect()
    }

    fn facing(&self, position_mm: f64, pair: i32, window: &Window) -> Option<Facing> {
        let path = &self.pair.path;
        let own_mm = position_mm + f64::from(pair) * path.base_pitch_mm;
        let outside_mm = OUTSIDE_BASE_PITCHES * path.base_pitch_mm;
        if own_mm < path.start_mm - outside_mm || own_mm > path.end_mm + outside_mm {
            return None;
        }
        let addendum = if own_mm <= path.pitch_point_mm { Gear::Wheel } else { Gear::Pinion };
        let slave = if self.flanks[addendum].sharp { addendum } else { addendum.mate() };
        let master = slave.mate();
        let expected = self.expected_from_tip_mm(position_mm, pair, own_mm);
        let half_width_mm = hertz_half_width_mm(self.pair, self.contact_modulus_mpa, window.line_load_n_per_mm, own_mm);
        let window_mm = window.half_widths * half_width_mm;
        let edges = PerGear::from_fn(|gear| {
            // The master must be met over the whole of the slave's window, also where it is seen a little askew.
            let window = if gear == slave { window_mm } else { 1.3 * window_mm };
            self.flanks[gear].edges_between(expected[gear] - window, expected[gear] + window)
        });
        let inner_ends = (edges[slave].start > 0, edges[slave].end < self.flanks[slave].surface.edges.len());
        // Both in the frame of the slave's tooth.
        let angle_rad = |gear| tooth_angle_rad(self.pair, gear, position_mm, pair);
        let from_slave = |point: Vector2<f64>| Rotation2::new(-angle_rad(slave)) * (point - axis_mm(self.pair, slave));
        let turn = Rotation2::new(angle_rad(master) - angle_rad(slave));
        let master_axis_mm = from_slave(axis_mm(self.pair, master));
        let slave_part = self.flanks[slave].surface.part(edges[slave].clone());
        let master_part =
            self.flanks[master].surface.part(edges[master].clone()).placed(|x| turn * x + master_axis_mm, |n| turn * n);
        let coupling = Coupling::new(&slave_part, &master_part, window.reach_mm);
        if coupling.is_empty() {
            return None;
        }
        let of_master = turned(&coupling.master, turn.inverse());
        let operator = match slave {
            Gear::Pinion => PerGear { pinion: coupling.slave.clone(), wheel: of_master },
            Gear::Wheel => PerGear { pinion: of_master, wheel: coupling.slave.clone() },
        };
        let middle = (self.gears.pinion.teeth() / 2) as i32;
        // The pair ahead is the next anticlockwise tooth of the pinion, and the next clockwise one of the wheel.
        let tooth = PerGear { pinion: (middle + pair) as usize, wheel: (middle - pair) as usize };
        Some(Facing {
            pair,
            slave,
            tooth,
            coupling,
            operator,
            expected_mm: expected[slave],
            pinion_axis_mm: from_slave(axis_mm(self.pair, Gear::Pinion)),
            inner_ends,
            first_row: 0,
        })
    }

    /// Where contact is expected on each flank, from its tip end: on the line of action, or before A and after E at the
    /// mate's tip.
    fn expected_from_tip_mm(&self, position_mm: f64, pair: i32, own_mm: f64) -> PerGear<f64> {
        let path = &self.pair.path;
        // The flank of `gear` at the radius that the mate's tip end has from its axis.
        let at_mates_tip = |gear: Gear| {
            let mate = &self.flanks[gear.mate()];
            let tip = mate.surface.points_mm[mate.tip_node()];
            let tip = in_place_mm(self.pair, gear.mate(), position_mm, pair, tip);
            let radius_mm = (tip - axis_mm(self.pair, gear)).norm();
            self.flanks[gear].from_tip_at_mm(path.involute[gear].curvature_radius_mm(radius_mm))
        };
        if own_mm < path.start_mm {
            PerGear { pinion: at_mates_tip(Gear::Pinion), wheel: 0.0 }
        } else if own_mm > path.end_mm {
            PerGear { pinion: 0.0, wheel: at_mates_tip(Gear::Wheel) }
        } else {
            PerGear::from_fn(|gear| self.flanks[gear].from_tip_at_mm(path.rho_mm(gear, own_mm)))
        }
    }

    fn condensed(&self, facings: &[Facing], line_load_n_per_mm: f64) -> Condensed {
        let rows = facings.iter().map(|facing| facing.coupling.len()).sum();
        let mut compliance = Mat::zeros(rows, rows);
        let mut rigid = Mat::zeros(rows, 1);
        let mut gap_mm = Vec::with_capacity(rows);
        for (a, facing) in facings.iter().enumerate() {
            gap_mm.extend_from_slice(&facing.coupling.gap_mm);
            for (i, change) in self.by_rotation(facing).enumerate() {
                rigid[(facing.first_row + i, 0)] = change;
            }
            for other in &facings[..=a] {
                let places = (facing.first_row, other.first_row);
                for gear in Gear::BOTH {
                    let between = self.gears[gear].between(other.tooth[gear], facing.tooth[gear]);
                    add_sandwich(&mut compliance, places, &facing.operator[gear], between, &other.operator[gear]);
                }
            }
        }
        for i in 0..rows {
            for j in i + 1..rows {
                compliance[(i, j)] = compliance[(j, i)];
            }
        }
        Condensed { compliance, gap_mm, rigid, rigid_load: vec![-line_load_n_per_mm] }
    }

    /// Change of each gap of a pair per transmission error.
    fn by_rotation<'b>(&'b self, facing: &'b Facing) -> impl Iterator<Item = f64> + 'b {
        let turned = |row: sprs::CsVecView<'_, f64>| row.iter().map(|(column, b)| b * self.rotation(column)).sum();
        facing.operator.pinion.outer_iterator().map(turned)
    }

    /// Displacement of a candidate column of the pinion per transmission error.
    fn rotation(&self, column: usize) -> f64 {
        let point = self.flanks.pinion.surface.points_mm[column / 2];
        let r_b = self.pair.path.involute.pinion.base_radius_mm;
        if column.is_multiple_of(2) { -point.y / r_b } else { point.x / r_b }
    }

    fn read(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        facings: &[Facing],
        found: crate::fem::active_set::Equilibrium,
    ) -> PositionContact {
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
            let (contact, stretch) = self.tooth_pair(facing, force);
            warm.push((facing.pair, stretch.0, stretch.1));
            pairs.push(contact);
        }
        let torque = PerGear::from_fn(|gear| {
            let points = &self.flanks[gear].surface.points_mm;
            let moment = |tooth: &ToothForce| -> f64 {
                let arm = |column: usize| {
                    let x = points[column / 2];
                    if column.is_multiple_of(2) { -x.y } else { x.x }
                };
                tooth.iter().map(|&(column, f)| arm(column) * f).sum()
            };
            forces[gear].iter().map(moment).sum::<f64>()
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

    /// One pair's figures and the loaded stretch, from the expected contact towards the pinion's tip.
    fn tooth_pair(&self, facing: &Facing, force: &[f64]) -> (ToothPairContact, (f64, f64)) {
        let (flank, coupling) = (&self.flanks[facing.slave], &facing.coupling);
        let mut rows: Vec<usize> = (0..coupling.len()).collect();
        let place = |row: usize| facing.towards_pinion_tip_mm(flank, coupling.nodes[row]);
        rows.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
        let along: Vec<f64> = rows.iter().map(|&row| place(row)).collect();
        let pressure: Vec<f64> = rows.iter().map(|&row| (force[row] / coupling.weight_mm[row]).max(0.0)).collect();
        let zones = zones::zones(&along, &pressure);
        let half_width_mm = zones.iter().map(|zone| 0.5 * zone.width_mm()).fold(0.0, f64::max);
        let total: f64 = force.iter().sum();
        let mean = |of: &dyn Fn(usize) -> f64| -> f64 {
            force.iter().enumerate().map(|(row, f)| f * of(row)).sum::<f64>() / total
        };
        let centre_mm = mean(&place);
        let radius = |row: usize| (flank.surface.points_mm[coupling.nodes[row]] - facing.pinion_axis_mm).norm();
        let stretch = zones.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), zone| {
            (low.min(zone.from_mm), high.max(zone.to_mm))
        });
        let contact = ToothPairContact {
            pair: facing.pair,
            line_load_n_per_mm: self.by_rotation(facing).zip(force).map(|(change, f)| -f * change).sum(),
            peak_pressure_mpa: pressure.iter().copied().fold(0.0, f64::max),
            half_width_mm,
            pinion_radius_mm: mean(&radius),
            slave: facing.slave,
            at_sharp_edge: self.is_at_sharp_edge(facing, force),
            pressure: along.iter().zip(&pressure).map(|(along, p)| (along - centre_mm, *p)).collect(),
        };
        (contact, stretch)
    }

    fn is_at_sharp_edge(&self, facing: &Facing, force: &[f64]) -> bool {
        Gear::BOTH.into_iter().any(|gear| {
            let (operator, flank) = (&facing.operator[gear], &self.flanks[gear]);
            let tip = flank.tip_node();
            let at_tip = |row: sprs::CsVecView<'_, f64>| row.iter().any(|(column, b)| column / 2 == tip && *b != 0.0);
            flank.sharp && operator.outer_iterator().zip(force).any(|(row, f)| *f > 0.0 && at_tip(row))
        })
    }
}

impl Facing {
    /// Distance of a node of the slave from the expected contact, towards the pinion's tip.
    fn towards_pinion_tip_mm(&self, slave: &FlankSurface, node: usize) -> f64 {
        let from_tip_mm = slave.from_tip_mm[node] - self.expected_mm;
        if self.slave == Gear::Pinion { -from_tip_mm } else { from_tip_mm }
    }
}

/// Whether load comes close to an inner end of the window, so that it may have been cut off.
fn is_cramped(facing: &Facing, force: &[f64], pair: &CondensedPair<'_>) -> bool {
    let from_tip = |row: usize| pair.flanks[facing.slave].from_tip_mm[facing.coupling.nodes[row]];
    let mut rows: Vec<usize> = (0..facing.coupling.len()).collect();
    rows.sort_by(|&a, &b| from_tip(a).total_cmp(&from_tip(b)));
    let loaded = |row: &usize| force[facing.first_row + row] > 0.0;
    let cramped_at = |inner: bool, mut end: Box<dyn Iterator<Item = &usize> + '_>| inner && end.any(loaded);
    cramped_at(facing.inner_ends.0, Box::new(rows.iter().take(FREE_ROWS)))
        || cramped_at(facing.inner_ends.1, Box::new(rows.iter().rev().take(FREE_ROWS)))
}

/// The active set expected from the position before.
fn start(facings: &[Facing], flanks: &PerGear<FlankSurface>, warm: &WarmStart) -> Option<Vec<bool>> {
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

/// B with each pair of columns turned into another frame.
fn turned(operator: &CsMat<f64>, turn: Rotation2<f64>) -> CsMat<f64> {
    let mut triplets = sprs::TriMat::new(operator.shape());
    for (i, row) in operator.outer_iterator().enumerate() {
        for (column, value) in row.iter() {
            let unit = if column.is_multiple_of(2) { Vector2::x() } else { Vector2::y() };
            let image = turn * (*value * unit);
            triplets.add_triplet(i, column - column % 2, image.x);
            triplets.add_triplet(i, column - column % 2 + 1, image.y);
        }
    }
    triplets.to_csr()
}

/// Adds `left · Cᵀ · rightᵀ` at `places` of `sum`; `compliance` is C, a row for a column of `right`.
fn add_sandwich(
    sum: &mut Mat<f64>,
    places: (usize, usize),
    left: &CsMat<f64>,
    compliance: Between<'_>,
    right: &CsMat<f64>,
) {
    let (left_columns, left_place) = used_columns(left);
    let (right_columns, right_place) = used_columns(right);
    // Each entry of C is read once, into columns that lie together.
    let width = right_columns.len();
    let gathered = compliance.gathered(&right_columns, &left_columns);
    let mut carried = vec![0.0; width];
    for (i, row) in left.outer_iterator().enumerate() {
        carried.fill(0.0);
        for (k, value) in row.iter() {
            let column = &gathered[left_place[k] * width..][..width];
            for (sum, c) in carried.iter_mut().zip(column) {
                *sum += value * c;
            }
        }
        for (j, other) in right.outer_iterator().enumerate() {
            let product: f64 = other.iter().map(|(column, value)| value * carried[right_place[column]]).sum();
            sum[(places.0 + i, places.1 + j)] += product;
        }
    }
}

/// The columns that hold anything, and the place of each among them.
fn used_columns(operator: &CsMat<f64>) -> (Vec<usize>, Vec<usize>) {
    let mut used = operator.indices().to_vec();
    used.sort_unstable();
    used.dedup();
    let mut place = vec![usize::MAX; operator.cols()];
    for (k, &column) in used.iter().enumerate() {
        place[column] = k;
    }
    (used, place)
}

/// Bᵀ f.
fn transpose_times(operator: &CsMat<f64>, force: &[f64]) -> ToothForce {
    let mut sums = BTreeMap::new();
    for (row, f) in operator.outer_iterator().zip(force) {
        for (column, value) in row.iter().filter(|_| *f != 0.0) {
            *sums.entry(column).or_insert(0.0) += value * f;
        }
    }
    sums.into_iter().collect()
}
