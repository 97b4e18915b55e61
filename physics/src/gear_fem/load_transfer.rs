//! How the load of a contact reaches the nodes of both flanks, and how what these have lost reaches the contact.
//!
//! Each multiplier stands for a stretch of the slave's flank, as long as its weight; along the slave's normals it faces a stretch of
//! the master. While the theoretical contact point passes the stretch of path that a position stands for, the contact moves
//! along both flanks, and both stretches with it. What the multiplier wears is spread evenly over them, and the gap that it sees
//! is opened by the mean depth on them:
//!
//! ```text
//! h_k ← h_k + M_ik d_i w_i / W_k          g_i ← g_i + Σ_k M_ik h_k / (n_k · n_i)
//! ```
//!
//! d_i: depth that the wear law gives for the pressure f_i/w_i and the sliding of the multiplier; n: normals, the factor being that
//! of a surface seen askew. Both flanks lose what the contact gives, whatever the nodes, the multipliers or the positions, and as
//! one rule is the transpose of the other, wear levels out what it can see: waves of wear decay or stay as they are, and none grows.
//!
//! Under load flanks also move along each other. The coupling is that of nodes which face each other in the places of the unloaded
//! teeth; a gap along the slave's normals, opened by displacements of both, is to first order that of the *master's* material
//! there, for where the gap has a slope, what moves the master along it moves the contact with it. The slave's material
//! that has come there lies off by how far both have moved along each other. From there to the tip of the slave that is
//!
//! ```text
//! t = ± ½ δ (tan α_s − tan α_m)        tan α = ρ/r_b of slave and master; + where the pinion is the slave
//! ```
//!
//! for both flanks go about their axes, the pinion's by the transmission error δ less what its tooth bends back, the wheel's by what its tooth is
//! bent on: both must meet, and half of δ is taken for either. By as much the pitch point is passed earlier,
//!
//! ```text
//! (x − C) · n ← (x − C) · n + ½ δ
//! ```
//!
//! Without the two, the same gear would wear by some δ (0.03 mm) of roll length farther down its root where it is driven than where it drives:
//! were the wheel turned back instead of the pinion turned on, the same teeth in the same places would be called a position further on by δ. On the slave's
//! sharp tip edge, which stays where it is, it is the master's material that lies off by t.
//!
//! All this is about the flanks as they are new, or about worn ones ([`super::tilted`]): then n_k · n_i is that of the worn flank, and what
//! the gaps differ by from the rule at that wear is added to them. A tip edge whose wear tilts it by a tenth touches elsewhere on its
//! rounding, where the rule for new flanks is off by a hundredth of the depth.
//!
//! Both flanks slide on each other at
//!
//! ```text
//! ds/dξ = (1/r_b1 + 1/r_b2) |(x − C) · n|
//! ```
//!
//! with C the pitch point and n the slave's normal: on the line of action (x − C)·n = ξ − ξ_C, and outside it, where a tip
//! edge touches early, it is the true relative velocity of the bodies along the tangent.

use nalgebra::{Rotation2, Vector2};

use super::condensed_pair::CondensedPair;
use super::facing_teeth::FacingTeeth;
use super::flank_nodes::{FlankNodes, Weights};
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::prepared::Prepared;
use super::tilted::Worn;
use crate::gear::{Gear, PerGear};
use crate::reference::linear_means::weighted_sum;

/// Most parts into which the movement of a contact is divided.
const MOST_PARTS: usize = 24;
/// Least cosine between the normals of two flanks in contact that is reckoned with.
const LEAST_COSINE: f64 = 0.3;

/// One tooth pair's contact at a position.
#[derive(Debug, Clone)]
pub(crate) struct LoadTransfer {
    /// Base pitches by which the pair is ahead of the reference pair.
    pub pair: i32,
    /// The gear whose flank has the multipliers.
    pub slave: Gear,
    /// Its first row among the multipliers of the position.
    pub first_row: usize,
    /// w_i of each row, mm.
    pub weight_mm: Vec<f64>,
    /// How far the flanks slide on each other at each row, mm.
    pub sliding_mm: Vec<f64>,
    /// Distance of each row along the profile from the first one, towards the pinion's tip, mm.
    pub along_mm: Vec<f64>,
    /// M for each gear.
    pub means: PerGear<Means>,
    /// What the gap of each row differs by from the rule at the wear that it is about, mm.
    beyond_rule_mm: Vec<f64>,
    /// How far the slave's material lies off what the rows faced in the places of the unloaded teeth, towards its tip, mm.
    slave_off_mm: f64,
}

/// M_ik of one flank: row by row, consecutive nodes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Means {
    first: Vec<usize>,
    ends: Vec<usize>,
    weights: Vec<f64>,
    /// 1/(n_k · n_i) of each row.
    askew: Vec<f64>,
}

impl Means {
    fn push(&mut self, reached: std::ops::Range<usize>, sums: &mut [f64], askew: f64) {
        self.first.push(reached.start);
        self.weights.extend_from_slice(&sums[reached.clone()]);
        sums[reached].fill(0.0);
        self.ends.push(self.weights.len());
        self.askew.push(askew);
    }

    /// M_ik of row `i`.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> Weights<'_> {
        let begin = if i > 0 { self.ends[i - 1] } else { 0 };
        Weights { first: self.first[i], weights: &self.weights[begin..self.ends[i]] }
    }

    /// How far depths at the nodes open the gap of row `i`, mm.
    fn opening_mm(&self, i: usize, depth_mm: &[f64]) -> f64 {
        let Weights { first, weights } = self.row(i);
        self.askew[i] * weighted_sum(weights, &depth_mm[first..])
    }
}

impl LoadTransfer {
    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.weight_mm.len()
    }

    /// Adds to the gaps of the position's rows what flanks that have lost `depth_mm` at their nodes open them by. Where the coupling is
    /// that of flanks tilted by `tilt_rad` at a row ([`super::tilted`]), it opens them by what material of the slave is off along that tilt already.
    pub(crate) fn open_gaps(&self, depth_mm: PerGear<&[f64]>, tilt_rad: impl Fn(usize) -> f64, gap_mm: &mut [f64]) {
        for (i, gap) in gap_mm[self.first_row..self.first_row + self.len()].iter_mut().enumerate() {
            let opening_mm = |gear: Gear| self.means[gear].opening_mm(i, depth_mm[gear]);
            let by_tilt_mm = tilt_rad(self.first_row + i) * self.slave_off_mm;
            *gap += opening_mm(Gear::Pinion) + opening_mm(Gear::Wheel) + self.beyond_rule_mm[i] - by_tilt_mm;
        }
    }

    /// Means over a load of `force` on the rows of what each node of `gear` is; 0 without load.
    pub(crate) fn mean_on<const N: usize>(
        &self,
        gear: Gear,
        force: &[f64],
        at_node: impl Fn(usize) -> [f64; N],
    ) -> [f64; N] {
        let (mut sums, mut whole) = ([0.0; N], 0.0);
        for (i, &force) in force.iter().enumerate().filter(|(_, force)| **force > 0.0) {
            let Weights { first, weights } = self.means[gear].row(i);
            whole += force;
            for (k, m) in weights.iter().enumerate().filter(|(_, m)| **m > 0.0) {
                let own = at_node(first + k);
                sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += force * m * own);
            }
        }
        if whole > 0.0 { sums.map(|sum| sum / whole) } else { sums }
    }

    /// Adds to the depths at the nodes of a flank what the rows lose: `depth_mm` each.
    pub(crate) fn wear_nodes(&self, gear: Gear, nodes: &FlankNodes, depth_mm: &[f64], sums_mm: &mut [f64]) {
        for (i, (depth, weight)) in depth_mm.iter().zip(&self.weight_mm).enumerate() {
            if *depth == 0.0 {
                continue;
            }
            let volume = depth * weight;
            let Weights { first, weights } = self.means[gear].row(i);
            let reached = sums_mm[first..].iter_mut().zip(&nodes.share_mm[first..]).zip(weights);
            for ((sum, share), m) in reached {
                *sum += m * volume / share;
            }
        }
    }
}

/// What a slave's node meets on the master.
#[derive(Debug, Clone, Copy)]
struct Foot {
    /// Distance from the master's root end, mm.
    along_mm: f64,
    /// Across the gap, mm.
    gap_mm: f64,
    /// n · −n_m; on a worn flank over that of its normal with the new one's.
    cosine: f64,
}

/// A position, what it stands for, and how far the pinion has turned on there under load.
#[derive(Debug, Clone, Copy)]
struct Passing {
    position_mm: f64,
    /// Part of the path.
    stretch_mm: (f64, f64),
    /// Transmission error.
    turned_mm: f64,
}

impl CondensedPair<'_> {
    /// The nodes of both working flanks.
    pub(crate) fn flank_nodes(&self) -> PerGear<FlankNodes> {
        self.flanks.as_ref().map(FlankNodes::new)
    }

    /// Radius of the nominal flank point that each local node of a gear's flank stands for, mm.
    pub fn nominal_radius_mm(&self, gear: Gear) -> Vec<f64> {
        let points = self.flanks[gear].surface.points_mm.iter();
        points.map(|&point| self.pair.teeth[gear].nominal_radius_mm(point)).collect()
    }

    /// How each tooth pair that may touch at a position hands its load over, with the position standing for the path from
    /// `stretch_mm.0` to `stretch_mm.1`, under the transmission error `turned_mm`; about the `worn` flanks where there are such.
    pub(crate) fn load_transfers(
        &self,
        prepared: &Prepared,
        stretch_mm: (f64, f64),
        turned_mm: f64,
        nodes: PerGear<&FlankNodes>,
        worn: Option<Worn<'_>>,
    ) -> Vec<LoadTransfer> {
        let passing = Passing { position_mm: prepared.position_mm, stretch_mm, turned_mm };
        prepared.facings.iter().map(|facing| self.load_transfer(passing, facing, nodes, worn)).collect()
    }

    fn load_transfer(
        &self,
        passing: Passing,
        facing: &FacingTeeth,
        nodes: PerGear<&FlankNodes>,
        worn: Option<Worn<'_>>,
    ) -> LoadTransfer {
        let Passing { position_mm, stretch_mm, turned_mm } = passing;
        let slave = facing.slave;
        let (own, mate) = (nodes[slave], nodes[slave.mate()]);
        let feet = self.feet(position_mm, facing, nodes, worn);
        let beyond_rule_mm = match worn {
            Some(Worn { depth_mm, .. }) => {
                let unworn = self.feet(position_mm, facing, nodes, None);
                let beyond = |node: &usize| {
                    let place = own.place[*node];
                    let (Some(from), Some(to)) = (unworn.get(&place), feet.get(&place)) else { return 0.0 };
                    let mates_mm = mate.depth_at_mm(to.along_mm, depth_mm[slave.mate()]);
                    to.gap_mm - from.gap_mm - depth_mm[slave][place] - mates_mm / to.cosine.max(LEAST_COSINE)
                };
                facing.coupling.nodes.iter().map(beyond).collect()
            }
            None => vec![0.0; facing.coupling.len()],
        };
        let (moved, off_mm) = self.off_mm(passing, facing);
        let mut moves = PerGear::from_fn(|gear| self.contact_moves_mm(position_mm, stretch_mm, facing.pair, gear));
        moves[moved].iter_mut().for_each(|end| *end += off_mm);
        let mut sums = PerGear::from_fn(|gear| vec![0.0; nodes[gear].len()]);
        let mut means: PerGear<Means> = PerGear::default();
        let (mut sliding_mm, mut along_mm) = (Vec::new(), Vec::new());
        let towards_pinion_tip = if slave == Gear::Pinion { 1.0 } else { -1.0 };
        let turn_per_mm = self.pair.path.relative_turn_per_mm();
        for &node in &facing.coupling.nodes {
            let place = own.place[node];
            let loaded = own.loaded_mm[place];
            let reached = spread(own, loaded, moves[slave], &mut sums[slave]);
            means[slave].push(reached, &mut sums[slave], 1.0);
            let faced = faced_mm(own, &feet, place, loaded);
            let reached = spread(mate, faced, moves[slave.mate()], &mut sums[slave.mate()]);
            let cosine = feet.get(&place).map_or(1.0, |foot| foot.cosine).max(LEAST_COSINE);
            means[slave.mate()].push(reached, &mut sums[slave.mate()], 1.0 / cosine);
            along_mm.push(towards_pinion_tip * own.along_mm[place]);
            let lever_mm = self.lever_mm(position_mm, facing, node) + 0.5 * turned_mm;
            sliding_mm.push(turn_per_mm * slid_mm(lever_mm, position_mm, stretch_mm));
        }
        let first = along_mm.iter().copied().fold(f64::INFINITY, f64::min);
        along_mm.iter_mut().for_each(|at| *at -= first);
        LoadTransfer {
            pair: facing.pair,
            slave,
            first_row: facing.first_row,
            weight_mm: facing.coupling.weight_mm.clone(),
            sliding_mm,
            along_mm,
            means,
            beyond_rule_mm,
            slave_off_mm: if moved == slave { off_mm } else { 0.0 },
        }
    }

    /// (x − C)·n at a node of the slave, n away from the pinion, mm.
    fn lever_mm(&self, position_mm: f64, facing: &FacingTeeth, node: usize) -> f64 {
        let (slave, surface) = (facing.slave, &self.flanks[facing.slave].surface);
        let in_place = in_place_mm(self.pair, slave, position_mm, facing.pair, surface.points_mm[node]);
        let pitch_point = Vector2::new(0.0, self.pair.working_pitch_radius_mm(Gear::Pinion));
        let angle_rad = tooth_angle_rad(self.pair, slave, position_mm, facing.pair);
        let along_normal = (in_place - pitch_point).dot(&(Rotation2::new(angle_rad) * surface.normals[node]));
        // The pinion's normal looks along the line of action, the wheel's against it.
        if slave == Gear::Pinion { along_normal } else { -along_normal }
    }

    /// Where the slave's nodes in the window meet the master, by their place on the slave's flank; `worn` or new.
    fn feet(
        &self,
        position_mm: f64,
        facing: &FacingTeeth,
        nodes: PerGear<&FlankNodes>,
        worn: Option<Worn<'_>>,
    ) -> std::collections::BTreeMap<usize, Foot> {
        let (slave, master) = (facing.slave, facing.slave.mate());
        let angle_rad = |gear| tooth_angle_rad(self.pair, gear, position_mm, facing.pair);
        let turn = Rotation2::new(angle_rad(master) - angle_rad(slave));
        let to_slave = Rotation2::new(-angle_rad(slave));
        let moved = to_slave * (axis_mm(self.pair, master) - axis_mm(self.pair, slave));
        let of_window = |gear: Gear| {
            let edges = &self.flanks[gear].surface.edges[facing.edges[gear].clone()];
            let mut window: Vec<usize> = edges.iter().flat_map(|edge| edge.nodes().iter().copied()).collect();
            window.sort_by_key(|&node| nodes[gear].place[node]);
            window.dedup();
            window
        };
        let (own, mate) = (&self.flanks[slave].surface, &self.flanks[master].surface);
        let depth_mm = |gear: Gear, place: usize| worn.map_or(0.0, |worn| worn.depth_mm[gear][place]);
        let mates: Vec<_> = of_window(master)
            .into_iter()
            .map(|node| {
                let (place, normal) = (nodes[master].place[node], mate.normals[node]);
                let along_mm = nodes[master].along_mm[place];
                let point = mate.points_mm[node] - depth_mm(master, place) * normal;
                // As long as 1/(n · n_worn).
                let slope = worn.map_or(0.0, |worn| worn.tilt_rad[master][place]);
                let worn_normal = normal + slope * Vector2::new(normal.y, -normal.x);
                (turn * point + moved, turn * worn_normal, along_mm)
            })
            .collect();
        let mut feet = std::collections::BTreeMap::new();
        for node in of_window(slave) {
            let (place, normal) = (nodes[slave].place[node], own.normals[node]);
            let point = own.points_mm[node] - depth_mm(slave, place) * normal;
            let beside = |k: usize| (mates[k].0 - point).perp(&normal);
            let mut nearest: Option<Foot> = None;
            let mut before = beside(0);
            for k in 0..mates.len() - 1 {
                let after = beside(k + 1);
                if (before <= 0.0) != (after <= 0.0) {
                    let t = before / (before - after);
                    let ((x0, n0, s0), (x1, n1, s1)) = (mates[k], mates[k + 1]);
                    let gap_mm = (x0 + t * (x1 - x0) - point).dot(&normal);
                    let length = n0.norm() + t * (n1.norm() - n0.norm());
                    let cosine = -(n0 + t * (n1 - n0)).normalize().dot(&normal) * length;
                    if cosine > 0.0 && nearest.is_none_or(|foot: Foot| gap_mm.abs() < foot.gap_mm.abs()) {
                        nearest = Some(Foot { along_mm: s0 + t * (s1 - s0), gap_mm, cosine });
                    }
                }
                before = after;
            }
            feet.extend(nearest.map(|foot| (place, foot)));
        }
        feet
    }

    /// How far material of one of the flanks, and of which, lies off what faced its mate's in the places of the unloaded teeth, towards its
    /// tip, mm.
    fn off_mm(&self, passing: Passing, facing: &FacingTeeth) -> (Gear, f64) {
        let (path, slave) = (&self.pair.path, facing.slave);
        let own_mm = passing.position_mm + f64::from(facing.pair) * path.base_pitch_mm;
        let slope = |gear: Gear| path.rho_mm(gear, own_mm) / path.involute[gear].base_radius_mm;
        let sign = if slave == Gear::Pinion { 0.5 } else { -0.5 };
        let off_mm = sign * passing.turned_mm * (slope(slave) - slope(slave.mate()));
        // The two flanks run against each other.
        (if self.is_on_tip_edge(slave, own_mm) { slave.mate() } else { slave }, off_mm)
    }

    /// Whether a gear touches with its tip edge, with the theoretical contact point of its pair at `own_mm`.
    fn is_on_tip_edge(&self, gear: Gear, own_mm: f64) -> bool {
        self.pair.path.rho_mm(gear, own_mm) > self.involute_end_mm(gear)
    }

    /// How far the contact of a tooth pair moves along `gear`'s flank while the theoretical contact point passes `stretch_mm`, mm: to
    /// the root's side and to the tip's side of where it is at `position_mm`.
    fn contact_moves_mm(&self, position_mm: f64, stretch_mm: (f64, f64), pair: i32, gear: Gear) -> [f64; 2] {
        let path = &self.pair.path;
        let involute = path.involute[gear];
        let ahead_mm = f64::from(pair) * path.base_pitch_mm;
        let own_mm = position_mm + ahead_mm;
        let edge = self.edge_passed(own_mm);
        let arc = |at_mm: f64| match edge {
            Some(edge) if edge.gear != gear => involute.arc_mm(self.rho_at_edge_mm(edge, at_mm, pair)),
            _ => involute.arc_mm(path.rho_mm(gear, at_mm + ahead_mm)),
        };
        // On its own edge the contact stands still.
        let on_corner = edge.is_some_and(|edge| edge.gear == gear && edge.at_root);
        if on_corner || self.is_on_tip_edge(gear, own_mm) {
            return [0.0, 0.0];
        }
        let here = arc(position_mm);
        let (a, b) = (arc(stretch_mm.0) - here, arc(stretch_mm.1) - here);
        [a.min(b), a.max(b)]
    }

    /// ρ where the involute of a gear's flank ends: at its tip circle or where the rounding begins.
    fn involute_end_mm(&self, gear: Gear) -> f64 {
        // NaN on a rounding: never greater.
        self.flanks[gear].rho_mm.iter().copied().fold(0.0, f64::max)
    }
}

/// Adds the means over `stretch_mm` while it moves by `moves_mm` to either side; answers the nodes that they reach.
fn spread(nodes: &FlankNodes, stretch_mm: [f64; 2], moves_mm: [f64; 2], sums: &mut [f64]) -> std::ops::Range<usize> {
    let (length, way) = (stretch_mm[1] - stretch_mm[0], moves_mm[1] - moves_mm[0]);
    let parts = ((2.0 * way / length.max(1e-9)).ceil()).clamp(1.0, MOST_PARTS as f64) as usize;
    let mut reached: Option<std::ops::Range<usize>> = None;
    for part in 0..parts {
        let moved = moves_mm[0] + way * (part as f64 + 0.5) / parts as f64;
        // The last parts of a long way are as long as the way between them.
        let wider = 0.5 * (way / parts as f64 - length).max(0.0);
        let stretch = [stretch_mm[0] + moved - wider, stretch_mm[1] + moved + wider];
        let range = nodes.add_means(stretch, 1.0 / parts as f64, sums);
        reached = Some(match reached {
            Some(before) => before.start.min(range.start)..before.end.max(range.end),
            None => range,
        });
    }
    reached.unwrap_or(0..0)
}

/// The stretch of the master that `loaded_mm` of the slave, around its node at `place`, faces.
fn faced_mm(
    own: &FlankNodes,
    feet: &std::collections::BTreeMap<usize, Foot>,
    place: usize,
    loaded_mm: [f64; 2],
) -> [f64; 2] {
    // FacingTeeth flanks run against each other at equal lengths, but for their curvature.
    let foot = |(&k, foot): (&usize, &Foot)| (own.along_mm[k], foot.along_mm);
    let is_beside = |(k, _): &(&usize, &Foot)| place.abs_diff(**k) == 1;
    let (next_before, next_after) = (feet.range(..place).next_back(), feet.range(place + 1..).next());
    let (before, after) = (next_before.filter(is_beside).map(foot), next_after.filter(is_beside).map(foot));
    // Beyond the end of the master: as far from the nearest foot.
    let nearest = || match (next_before, next_after) {
        (Some(before), Some(after)) => Some(if place - before.0 <= after.0 - place { before } else { after }),
        (before, after) => before.or(after),
    };
    let here = feet.get_key_value(&place).or_else(nearest).map(foot);
    let Some((at, met)) = here else { return [0.0; 2] };
    let slope = |other: Option<(f64, f64)>| match other {
        Some((other_at, other_met)) if other_at != at => (other_met - met) / (other_at - at),
        _ => -1.0,
    };
    let down = slope(before.or(after));
    let up = slope(after.or(before));
    let ends = [met + (loaded_mm[0] - at) * down, met + (loaded_mm[1] - at) * up];
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// ∫ |(x − C) · n| dξ over the stretch, on which the lever changes as ξ does, mm².
fn slid_mm(lever_mm: f64, position_mm: f64, stretch_mm: (f64, f64)) -> f64 {
    let at = |end: f64| lever_mm + end - position_mm;
    let half_square = |x: f64| 0.5 * x * x.abs();
    half_square(at(stretch_mm.1)) - half_square(at(stretch_mm.0))
}
