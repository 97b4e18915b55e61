//! Transfer of wear from the multipliers of a contact to the nodes of both flanks, and of worn depths to the gaps.
//!
//! Each multiplier represents a stretch of the slave's flank, as long as its weight, and the stretch of the master that faces it along the slave's
//! normals. While the theoretical contact point passes the stretch of path that a position represents, the contact moves
//! along both flanks, and both stretches with it, but where a kink of a flank holds the pressure ([`super::kinks`]). The wear of the multiplier
//! is spread evenly over them, and its gap is opened by the mean depth on them:
//!
//! ```text
//! h_k ← h_k + M_ik d_i w_i / W_k          g_i ← g_i + Σ_k M_ik h_k / (n_k · n_i)
//! ```
//!
//! d_i: depth of the wear law for the pressure f_i/w_i and the sliding of the multiplier; n: normals of oblique surfaces. Both flanks lose
//! the volume worn in the contact, whatever the nodes, multipliers or positions, and as
//! one rule is the transpose of the other, waves of wear decay or stay, and none grows.
//!
//! Under load the flanks also move along each other. The coupling is that of nodes which face each other on the unloaded
//! teeth; a gap along the slave's normals, opened by displacements of both, is to first order that of the *master's* material
//! there, as the contact moves with the master where the gap has a slope. The slave's material
//! there is offset by the relative movement of both along the flank, towards the tip of the slave
//!
//! ```text
//! t = ± ½ δ (tan α_s − tan α_m)        tan α = ρ/r_b of slave and master; + where the pinion is the slave
//! ```
//!
//! as both flanks turn about their axes, the pinion's by the transmission error δ less its tooth's deflection, the wheel's by its tooth's
//! deflection; half of δ is taken for either. The pitch point is passed earlier by the same amount,
//!
//! ```text
//! (x − C) · n ← (x − C) · n + ½ δ
//! ```
//!
//! Without these two terms the same gear would wear by some δ (0.03 mm) of roll length farther down its root as the driven than as the driving one.
//! At the slave's sharp tip edge, which does not move, the master's material is offset by t.
//!
//! The rule is linearised about new flanks, or about worn ones ([`super::tilted`]): then n_k · n_i is that of the worn flank, and the gaps'
//! difference from the rule at that wear is added to them. A tip edge that wear has tilted by a tenth touches elsewhere on its
//! rounding, where the rule for new flanks is off by a hundredth of the depth.
//!
//! Both flanks slide on each other at
//!
//! ```text
//! ds/dξ = (1/r_b1 + 1/r_b2) |(x − C) · n|
//! ```
//!
//! with C the pitch point and n the slave's normal: on the line of action (x − C)·n = ξ − ξ_C; outside it, where a tip
//! edge touches early, it is the relative velocity of the bodies along the tangent.

use std::collections::BTreeMap;

use nalgebra::{Rotation2, Vector2};
use pulp::Arch;

use super::condensed_pair::CondensedPair;
use super::facing_teeth::FacingTeeth;
use super::flank_nodes::{FlankNodes, Weights};
use super::kinks::pressure_moves_mm;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::prepared::PreparedPosition;
use super::tilted::Worn;
use crate::gear::{Gear, PerGear};
use gearwear_fem::weighted_sum::weighted_sum;

/// Greatest number of parts into which the movement of a contact is divided.
const MOST_PARTS: usize = 24;
/// Lower bound of the cosine between the normals of two flanks in contact.
const LEAST_COSINE: f64 = 0.3;

/// Transfer between the multipliers of one tooth pair at a position and the nodes of its flanks.
#[derive(Debug, Clone)]
pub struct LoadTransfer {
    /// Number of the pair: base pitches ahead of the reference pair.
    pub pair: i32,
    /// Gear whose flank has the multipliers.
    pub slave: Gear,
    /// First row of the pair among the multipliers of the position.
    pub first_row: usize,
    /// Weight w_i of each row, mm.
    pub weight_mm: Vec<f64>,
    /// Sliding distance of each row, mm.
    pub sliding_mm: Vec<f64>,
    /// Distance of each row along the profile from the first one, towards the pinion's tip, mm.
    pub along_mm: Vec<f64>,
    /// Matrix M for each gear.
    pub means: PerGear<StretchMeans>,
    /// Gap of each row on new flanks, along the slave's normal, mm; none where the mate does not face it.
    unworn_gap_mm: Vec<Option<f64>>,
    /// Difference of each row's gap from the linear rule at the wear about which it is linearised, mm.
    beyond_rule_mm: Vec<f64>,
    /// Mean tilt of the mate's flank at each row, about which it is linearised, rad; none for new flanks.
    about_rad: Option<Vec<f64>>,
    /// Offset t of the slave's material under load, towards its tip, mm.
    slave_off_mm: f64,
}

/// M_ik of one flank: row by row, consecutive nodes.
#[derive(Debug, Clone, Default)]
pub struct StretchMeans {
    first: Vec<usize>,
    ends: Vec<usize>,
    weights: Vec<f64>,
    /// Factor 1/(n_k · n_i) of each row.
    askew: Vec<f64>,
}

impl StretchMeans {
    fn push(&mut self, reached: std::ops::Range<usize>, sums: &mut [f64], askew: f64) {
        self.first.push(reached.start);
        self.weights.extend_from_slice(&sums[reached.clone()]);
        sums[reached].fill(0.0);
        self.ends.push(self.weights.len());
        self.askew.push(askew);
    }

    /// Weights M_ik of row `i`.
    #[inline(always)]
    pub fn row(&self, i: usize) -> Weights<'_> {
        let begin = if i > 0 { self.ends[i - 1] } else { 0 };
        Weights { first: self.first[i], weights: &self.weights[begin..self.ends[i]] }
    }

    /// Mean of nodal values of row `i`.
    #[inline(always)]
    fn mean(&self, i: usize, at_nodes: &[f64]) -> f64 {
        let Weights { first, weights } = self.row(i);
        weighted_sum(weights, &at_nodes[first..])
    }

    /// Opening of the gap of row `i` by depths at the nodes, mm.
    #[inline(always)]
    fn opening_mm(&self, i: usize, depth_mm: &[f64]) -> f64 {
        self.askew[i] * self.mean(i, depth_mm)
    }
}

impl LoadTransfer {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.weight_mm.len()
    }

    /// Opens the gaps of the position's rows by the wear `depth_mm` at the nodes. A coupling of flanks tilted by `tilt_rad` at a row
    /// ([`super::tilted`]) contains the opening by the slave's offset along that tilt already.
    pub fn open_gaps(&self, depth_mm: PerGear<&[f64]>, tilt_rad: impl Fn(usize) -> f64, gap_mm: &mut [f64]) {
        self.open_gaps_of(|_| true, depth_mm, tilt_rad, gap_mm);
    }

    /// As [`Self::open_gaps`], of the rows of the position that are asked for.
    pub fn open_gaps_of(
        &self,
        is_asked: impl Fn(usize) -> bool,
        depth_mm: PerGear<&[f64]>,
        tilt_rad: impl Fn(usize) -> f64,
        gap_mm: &mut [f64],
    ) {
        let gap_mm = &mut gap_mm[self.first_row..self.first_row + self.len()];
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for (i, gap) in gap_mm.iter_mut().enumerate() {
                    if !is_asked(self.first_row + i) {
                        continue;
                    }
                    let [pinion_mm, wheel_mm] = Gear::BOTH.map(
                        #[inline(always)]
                        |gear| self.means[gear].opening_mm(i, depth_mm[gear]),
                    );
                    let by_tilt_mm = tilt_rad(self.first_row + i) * self.slave_off_mm;
                    *gap += pinion_mm + wheel_mm + self.beyond_rule_mm[i] - by_tilt_mm;
                }
            },
        );
    }

    /// Whether it is linearised about worn flanks.
    pub fn is_about_worn(&self) -> bool {
        self.about_rad.is_some()
    }

    /// Means under the load `force` of the rows on the mate's flank, tilted by `tilt_rad` at the nodes: of the change of its tilt since the rule was
    /// linearised, and of the tilt, rad; 0 without load.
    pub fn mates_turn_and_tilt_rad(&self, force: &[f64], tilt_rad: &PerGear<Vec<f64>>) -> [f64; 2] {
        let mate = self.slave.mate();
        let (mut turn, mut tilt, mut whole) = (0.0, 0.0, 0.0);
        for (i, &force) in force.iter().enumerate().filter(|(_, force)| **force > 0.0) {
            let now = self.means[mate].mean(i, &tilt_rad[mate]);
            let about = self.about_rad.as_ref().map_or(0.0, |about| about[i]);
            whole += force;
            turn += force * (now - about).abs();
            tilt += force * now.abs();
        }
        if whole > 0.0 { [turn / whole, tilt / whole] } else { [0.0; 2] }
    }

    /// Adds the wear of the rows, `depth_mm` each, to the depths at the nodes of a flank.
    pub fn wear_nodes(&self, gear: Gear, nodes: &FlankNodes, depth_mm: &[f64], sums_mm: &mut [f64]) {
        Arch::new().dispatch(
            #[inline(always)]
            || {
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
            },
        );
    }
}

/// Point of the master on the normal of a slave's node.
#[derive(Debug, Clone, Copy)]
struct Foot {
    /// Distance from the master's root end, mm.
    along_mm: f64,
    /// Gap along the normal, mm.
    gap_mm: f64,
    /// Cosine n · −n_m; on a worn flank over that of its normal with the new one's.
    cosine: f64,
}

impl Foot {
    /// Opening of the gap by wear according to the linear rule, mm.
    fn linear_opening_mm(&self, place: usize, slave: Gear, mate: &FlankNodes, worn: Worn<'_>) -> f64 {
        let mates_mm = mate.depth_at_mm(self.along_mm, worn.depth_mm[slave.mate()]);
        worn.depth_mm[slave][place] + mates_mm / self.cosine.max(LEAST_COSINE)
    }
}

/// Feet of the slave's nodes by their number on its flank.
type Feet = BTreeMap<usize, Foot>;

/// Stretch of path that a position represents.
#[derive(Debug, Clone, Copy)]
struct Passing {
    position_mm: f64,
    stretch_mm: (f64, f64),
    /// Transmission error.
    turned_mm: f64,
}

impl CondensedPair<'_> {
    /// Nodes of both working flanks.
    pub fn flank_nodes(&self) -> PerGear<FlankNodes> {
        PerGear::from_fn(|gear| FlankNodes::new(&self.flanks[gear], self.pair.kinks(gear)))
    }

    /// Radius of the nominal flank point of each local node of a gear's flank, mm.
    pub fn nominal_radius_mm(&self, gear: Gear) -> Vec<f64> {
        let points = self.flanks[gear].surface.points_mm.iter();
        points.map(|&point| self.pair.teeth[gear].nominal_radius_mm(point)).collect()
    }

    /// Load transfer of each tooth pair that may touch at a position, which represents the path from
    /// `stretch_mm.0` to `stretch_mm.1`, under the transmission error `turned_mm`, on new flanks.
    pub fn load_transfers(
        &self,
        prepared: &PreparedPosition,
        stretch_mm: (f64, f64),
        turned_mm: f64,
        nodes: PerGear<&FlankNodes>,
    ) -> Vec<LoadTransfer> {
        let passing = Passing { position_mm: prepared.position_mm, stretch_mm, turned_mm };
        prepared.facings.iter().map(|facing| self.load_transfer(passing, facing, nodes, None)).collect()
    }

    /// Load transfer `known` of one of the tooth pairs under another transmission error, linearised about `worn` flanks where given.
    pub fn load_transfer_anew(
        &self,
        known: &LoadTransfer,
        prepared: &PreparedPosition,
        stretch_mm: (f64, f64),
        turned_mm: f64,
        nodes: PerGear<&FlankNodes>,
        worn: Option<Worn<'_>>,
    ) -> LoadTransfer {
        let passing = Passing { position_mm: prepared.position_mm, stretch_mm, turned_mm };
        let facing = prepared.facings.iter().find(|facing| facing.pair == known.pair);
        let facing = facing.expect("the load transfer is one of the position");
        self.load_transfer(passing, facing, nodes, worn.map(|worn| (worn, known.unworn_gap_mm.clone())))
    }

    /// On `worn` flanks the gaps of the rows on new ones are known.
    fn load_transfer(
        &self,
        passing: Passing,
        facing: &FacingTeeth,
        nodes: PerGear<&FlankNodes>,
        worn: Option<(Worn<'_>, Vec<Option<f64>>)>,
    ) -> LoadTransfer {
        let Passing { position_mm, stretch_mm, turned_mm } = passing;
        let slave = facing.slave;
        let (own, mate) = (nodes[slave], nodes[slave.mate()]);
        let feet = self.feet(position_mm, facing, nodes, worn.as_ref().map(|(worn, _)| *worn));
        let of_rows = || facing.coupling.nodes.iter().map(|node| (own.place[*node], feet.get(&own.place[*node])));
        let mut beyond_rule_mm = vec![0.0; facing.coupling.len()];
        let (worn, unworn_gap_mm) = match worn {
            Some((worn, unworn_gap_mm)) => {
                for ((beyond, unworn), (place, foot)) in beyond_rule_mm.iter_mut().zip(&unworn_gap_mm).zip(of_rows()) {
                    if let (Some(unworn), Some(foot)) = (unworn, foot) {
                        *beyond = foot.gap_mm - unworn - foot.linear_opening_mm(place, slave, mate, worn);
                    }
                }
                (Some(worn), unworn_gap_mm)
            }
            None => (None, of_rows().map(|(_, foot)| foot.map(|foot| foot.gap_mm)).collect()),
        };
        let (moved, off_mm) = self.off_mm(passing, facing);
        let contact_mm = PerGear::from_fn(|gear| self.contact_moves_mm(position_mm, stretch_mm, facing.pair, gear));
        let kinks_mm = nodes.map(|nodes| nodes.kinks_mm.as_slice());
        let mut sums = PerGear::from_fn(|gear| vec![0.0; nodes[gear].len()]);
        let mut means: PerGear<StretchMeans> = PerGear::default();
        let (mut sliding_mm, mut along_mm) = (Vec::new(), Vec::new());
        let towards_pinion_tip = if slave == Gear::Pinion { 1.0 } else { -1.0 };
        let turn_per_mm = self.pair.path.relative_turn_per_mm();
        for (&node, ends) in facing.coupling.nodes.iter().zip(&facing.coupling.ends) {
            let place = own.place[node];
            let [one, other] = ends.map(|node| own.loaded_mm[own.place[node]]);
            let loaded = [one[0].min(other[0]), one[1].max(other[1])];
            let faced = faced_mm(own, &feet, place, loaded);
            let mut at_mm = PerGear::from_fn(|_| loaded[0].midpoint(loaded[1]));
            at_mm[slave.mate()] = faced[0].midpoint(faced[1]);
            let mut moves = pressure_moves_mm(contact_mm, kinks_mm, at_mm, facing.half_width_mm);
            moves[moved].iter_mut().for_each(|end| *end += off_mm);
            let reached = spread(own, loaded, moves[slave], &mut sums[slave]);
            means[slave].push(reached, &mut sums[slave], 1.0);
            let reached = spread(mate, faced, moves[slave.mate()], &mut sums[slave.mate()]);
            let cosine = feet.get(&place).map_or(1.0, |foot| foot.cosine).max(LEAST_COSINE);
            means[slave.mate()].push(reached, &mut sums[slave.mate()], 1.0 / cosine);
            along_mm.push(towards_pinion_tip * own.along_mm[place]);
            let lever_mm = self.lever_mm(position_mm, facing, node) + 0.5 * turned_mm;
            sliding_mm.push(turn_per_mm * slid_mm(lever_mm, position_mm, stretch_mm));
        }
        let first = along_mm.iter().copied().fold(f64::INFINITY, f64::min);
        along_mm.iter_mut().for_each(|at| *at -= first);
        let about_rad = worn.map(|worn| {
            let (means, tilt_rad) = (&means[slave.mate()], &worn.tilt_rad[slave.mate()]);
            (0..facing.coupling.len()).map(|i| means.mean(i, tilt_rad)).collect()
        });
        LoadTransfer {
            pair: facing.pair,
            slave,
            first_row: facing.first_row,
            weight_mm: facing.coupling.weight_mm.clone(),
            sliding_mm,
            along_mm,
            means,
            unworn_gap_mm,
            beyond_rule_mm,
            about_rad,
            slave_off_mm: if moved == slave { off_mm } else { 0.0 },
        }
    }

    /// Lever (x − C)·n at a node of the slave, n away from the pinion, mm.
    fn lever_mm(&self, position_mm: f64, facing: &FacingTeeth, node: usize) -> f64 {
        let (slave, surface) = (facing.slave, &self.flanks[facing.slave].surface);
        let in_place = in_place_mm(self.pair, slave, position_mm, facing.pair, surface.points_mm[node]);
        let pitch_point = Vector2::new(0.0, self.pair.working_pitch_radius_mm(Gear::Pinion));
        let angle_rad = tooth_angle_rad(self.pair, slave, position_mm, facing.pair);
        let along_normal = (in_place - pitch_point).dot(&(Rotation2::new(angle_rad) * surface.normals[node]));
        // The pinion's normal points along the line of action, the wheel's against it.
        if slave == Gear::Pinion { along_normal } else { -along_normal }
    }

    /// Feet of the slave's nodes in the window on the master, by their number on the slave's flank; of `worn` flanks or new ones.
    fn feet(
        &self,
        position_mm: f64,
        facing: &FacingTeeth,
        nodes: PerGear<&FlankNodes>,
        worn: Option<Worn<'_>>,
    ) -> Feet {
        let (slave, master) = (facing.slave, facing.slave.mate());
        let angle_rad = PerGear::from_fn(|gear| tooth_angle_rad(self.pair, gear, position_mm, facing.pair));
        let turn = Rotation2::new(angle_rad[master] - angle_rad[slave]);
        let to_slave = Rotation2::new(-angle_rad[slave]);
        let moved = to_slave * (axis_mm(self.pair, master) - axis_mm(self.pair, slave));
        let masters: Vec<MasterNode> = self
            .nodes_in_window(facing, nodes, master)
            .into_iter()
            .map(|node| {
                let place = nodes[master].place[node];
                let (point, normal) = self.worn_node_mm(master, node, place, worn);
                // Of length 1/(n · n_worn).
                let slope = worn.map_or(0.0, |worn| worn.tilt_rad[master][place]);
                let worn_normal = normal + slope * Vector2::new(normal.y, -normal.x);
                let along_mm = nodes[master].along_mm[place];
                MasterNode { point_mm: turn * point + moved, normal: turn * worn_normal, along_mm }
            })
            .collect();
        let mut feet = Feet::new();
        for node in self.nodes_in_window(facing, nodes, slave) {
            let place = nodes[slave].place[node];
            let (point, normal) = self.worn_node_mm(slave, node, place, worn);
            feet.extend(foot(&masters, point, normal).map(|foot| (place, foot)));
        }
        feet
    }

    /// Local nodes of a gear's flank in the window, from root to tip.
    fn nodes_in_window(&self, facing: &FacingTeeth, nodes: PerGear<&FlankNodes>, gear: Gear) -> Vec<usize> {
        let edges = &self.flanks[gear].surface.edges[facing.edges[gear].clone()];
        let mut window: Vec<usize> = edges.iter().flat_map(|edge| edge.nodes().iter().copied()).collect();
        window.sort_by_key(|&node| nodes[gear].place[node]);
        window.dedup();
        window
    }

    /// Worn place of a local node and its normal on the new flank.
    fn worn_node_mm(
        &self,
        gear: Gear,
        node: usize,
        place: usize,
        worn: Option<Worn<'_>>,
    ) -> (Vector2<f64>, Vector2<f64>) {
        let (surface, depth_mm) = (&self.flanks[gear].surface, worn.map_or(0.0, |worn| worn.depth_mm[gear][place]));
        (surface.points_mm[node] - depth_mm * surface.normals[node], surface.normals[node])
    }

    /// Gear whose material is offset along its flank under load, and the offset t towards its tip, mm.
    fn off_mm(&self, passing: Passing, facing: &FacingTeeth) -> (Gear, f64) {
        let (path, slave) = (&self.pair.path, facing.slave);
        let own_mm = passing.position_mm + f64::from(facing.pair) * path.base_pitch_mm;
        let slope = PerGear::from_fn(|gear| path.rho_mm(gear, own_mm) / path.involute[gear].base_radius_mm);
        let sign = if slave == Gear::Pinion { 0.5 } else { -0.5 };
        let off_mm = sign * passing.turned_mm * (slope[slave] - slope[slave.mate()]);
        (if self.is_on_tip_edge(slave, own_mm) { slave.mate() } else { slave }, off_mm)
    }

    /// Whether a gear touches with its tip edge where the theoretical contact point of its pair is at `own_mm`.
    fn is_on_tip_edge(&self, gear: Gear, own_mm: f64) -> bool {
        self.pair.path.rho_mm(gear, own_mm) > self.involute_end_mm(gear)
    }

    /// Movement of the contact of a tooth pair along `gear`'s flank, towards the tip, from its place at `position_mm` to those at the
    /// beginning and the end of `stretch_mm`, mm.
    fn contact_moves_mm(&self, position_mm: f64, stretch_mm: (f64, f64), pair: i32, gear: Gear) -> [f64; 2] {
        let path = &self.pair.path;
        let ahead_mm = f64::from(pair) * path.base_pitch_mm;
        let own_mm = position_mm + ahead_mm;
        let edge = self.edge_passed(own_mm);
        // The contact does not move on the gear's own edge.
        let on_corner = edge.is_some_and(|edge| edge.gear == gear && edge.at_root);
        if on_corner || self.is_on_tip_edge(gear, own_mm) {
            return [0.0, 0.0];
        }
        let [here, first, last] = [position_mm, stretch_mm.0, stretch_mm.1].map(|at_mm| {
            let rho_mm = match edge {
                Some(edge) if edge.gear != gear => self.rho_at_edge_mm(edge, at_mm, pair),
                _ => path.rho_mm(gear, at_mm + ahead_mm),
            };
            path.involute[gear].arc_mm(rho_mm)
        });
        [first - here, last - here]
    }

    /// ρ where the involute of a gear's flank ends, at its tip circle or where the rounding begins.
    fn involute_end_mm(&self, gear: Gear) -> f64 {
        // NaN on a rounding is never greater.
        self.flanks[gear].rho_mm.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Node of the master in the frame of the slave's tooth.
struct MasterNode {
    point_mm: Vector2<f64>,
    normal: Vector2<f64>,
    along_mm: f64,
}

/// Nearest foot of `point` along its `normal` on the line through the nodes of the master.
fn foot(masters: &[MasterNode], point: Vector2<f64>, normal: Vector2<f64>) -> Option<Foot> {
    let mut nearest: Option<Foot> = None;
    let mut after = (masters.first()?.point_mm - point).perp(&normal);
    for nodes in masters.windows(2) {
        let [a, b] = [&nodes[0], &nodes[1]];
        let before = after;
        after = (b.point_mm - point).perp(&normal);
        if (before <= 0.0) == (after <= 0.0) {
            continue;
        }
        let t = before / (before - after);
        let gap_mm = (a.point_mm + t * (b.point_mm - a.point_mm) - point).dot(&normal);
        let length = a.normal.norm() + t * (b.normal.norm() - a.normal.norm());
        let cosine = -(a.normal + t * (b.normal - a.normal)).normalize().dot(&normal) * length;
        if cosine > 0.0 && nearest.is_none_or(|foot: Foot| gap_mm.abs() < foot.gap_mm.abs()) {
            nearest = Some(Foot { along_mm: a.along_mm + t * (b.along_mm - a.along_mm), gap_mm, cosine });
        }
    }
    nearest
}

/// Adds the means over `stretch_mm` while it moves from one of `moves_mm` to the other; returns the range of nodes with weight.
fn spread(nodes: &FlankNodes, stretch_mm: [f64; 2], moves_mm: [f64; 2], sums: &mut [f64]) -> std::ops::Range<usize> {
    let moves_mm = [moves_mm[0].min(moves_mm[1]), moves_mm[0].max(moves_mm[1])];
    let (length, way) = (stretch_mm[1] - stretch_mm[0], moves_mm[1] - moves_mm[0]);
    let parts = ((2.0 * way / length.max(1e-9)).ceil()).clamp(1.0, MOST_PARTS as f64) as usize;
    if parts as f64 * length <= way {
        // Parts of a long way join without overlap: all of them are one stretch.
        let middle_mm = stretch_mm[0].midpoint(stretch_mm[1]);
        return nodes.add_means([middle_mm + moves_mm[0], middle_mm + moves_mm[1]], 1.0, sums);
    }
    let mut reached: Option<std::ops::Range<usize>> = None;
    for part in 0..parts {
        let moved = moves_mm[0] + way * (part as f64 + 0.5) / parts as f64;
        let range = nodes.add_means(stretch_mm.map(|end| end + moved), 1.0 / parts as f64, sums);
        reached = Some(match reached {
            Some(before) => before.start.min(range.start)..before.end.max(range.end),
            None => range,
        });
    }
    reached.unwrap_or(0..0)
}

/// Stretch of the master that faces `loaded_mm` of the slave around its node at `place`.
fn faced_mm(own: &FlankNodes, feet: &Feet, place: usize, loaded_mm: [f64; 2]) -> [f64; 2] {
    let (before, after) = (feet.range(..place).next_back(), feet.range(place + 1..).next());
    // Beyond the end of the master, extrapolation from the nearest foot.
    let nearest = match (before, after) {
        (Some(before), Some(after)) => Some(if place - before.0 <= after.0 - place { before } else { after }),
        _ => before.or(after),
    };
    let Some((&here, foot)) = feet.get_key_value(&place).or(nearest) else { return [0.0; 2] };
    let (at, met) = (own.along_mm[here], foot.along_mm);
    let [before, after] = [before, after].map(|beside| {
        let (&k, foot) = beside.filter(|(k, _)| place.abs_diff(**k) == 1)?;
        // The flanks run in opposite directions: −1 but for their curvature.
        Some(if own.along_mm[k] == at { -1.0 } else { (foot.along_mm - met) / (own.along_mm[k] - at) })
    });
    let (down, up) = (before.or(after).unwrap_or(-1.0), after.or(before).unwrap_or(-1.0));
    let ends = [met + (loaded_mm[0] - at) * down, met + (loaded_mm[1] - at) * up];
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// ∫ |(x − C) · n| dξ over the stretch, along which the lever changes as ξ does, mm².
fn slid_mm(lever_mm: f64, position_mm: f64, stretch_mm: (f64, f64)) -> f64 {
    let [first, last] = [stretch_mm.0, stretch_mm.1].map(|end| {
        let x = lever_mm + end - position_mm;
        0.5 * x * x.abs()
    });
    last - first
}
