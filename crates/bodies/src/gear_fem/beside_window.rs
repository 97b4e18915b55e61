//! Overlap of flanks beside the window that has multipliers.
//!
//! Worn flanks may touch in two places: a tip edge at the ridge where the wear of its mate ends, and both flanks on
//! the line of action. A node of the slave beside the window, whose normal intersects the master at a foot, has the gap
//!
//! ```text
//! g = g⁰ + h_s + h_m/(n_s · n_m) + b r δ + b C Bᵀ f
//! ```
//!
//! under the forces f of the window's multipliers, b being the row of B for the node and its foot. Where it is negative,
//! the window must be extended. Teeth deflect away from each other, so that the last term only opens gaps, and matters for those
//! nodes alone that would overlap without it. It changes slowly along the flank: it is calculated at some of the nodes, the
//! probes, and linear between them. As wear only opens gaps too, nodes between two probes are looked at one by one only where one of them may overlap
//! without wear.

use std::ops::Range;

use faer::Mat;
use nalgebra::{Rotation2, Vector2};
use sprs::{CsMat, TriMat};

use super::condensed_pair::CondensedPair;
use super::facing_teeth::{Direction, FacingTeeth, FlankOverlap, PlacedTeeth};
use super::sandwich::{CarriedRows, ToothRows};
use crate::gear::{Gear, PerGear};
use gearwear_fem::active_set::ContactEquilibrium;
use gearwear_fem::contact::master_search::LEAST_FACING;
use gearwear_fem::weighted_sum::weighted_sum;

/// Overlap over the transmission error that is tolerated, above the error of interpolation between nodes and probes.
const OVERLOOKED: f64 = 1e-3;
/// Distance of probes in half-widths of contact.
const PROBES_APART: f64 = 0.5;

/// Nodes of a tooth pair's slave beside the window that may come to touch.
pub(super) struct BesideWindow {
    pair: i32,
    slave: Gear,
    tooth: PerGear<usize>,
    /// Turn from the frame of the master's tooth to that of the slave's.
    turn: Rotation2<f64>,
    /// Nodes from tip to root.
    nodes: Vec<BesideNode>,
    /// Least transmission error at which one would touch if rigid and unworn, mm.
    first_touch_mm: f64,
    probes: Vec<Probe>,
    /// Nodes from each probe to the next.
    spans: Vec<Span>,
    /// Greatest overlap of the last solution, mm.
    deepest_mm: f64,
}

struct BesideNode {
    /// Local node of the slave.
    node: u32,
    /// Local nodes of the master to either side of the foot.
    foot: [u32; 2],
    /// Weight of the second of them.
    second_part: f64,
    /// Cosine n_s · −n_m.
    cosine: f64,
    /// Gap g⁰ of the unworn flanks.
    gap_mm: f64,
    /// Change b r of the gap per transmission error.
    by_rotation: f64,
    /// Weight of the probe after the node.
    next_probe_part: f64,
}

/// Nodes between two probes.
struct Span {
    nodes: Range<usize>,
    /// Least gap g⁰, and least change b r per transmission error.
    least_gap_mm: f64,
    least_by_rotation: f64,
}

/// Node at which b C Bᵀ is calculated.
struct Probe {
    /// Number among the nodes.
    at: usize,
    /// Row b C Bᵀ, from its first use on.
    compliance: Option<Vec<f64>>,
    /// Least entry of it for the multipliers of each tooth pair.
    least: Vec<f64>,
    /// Deflection b C Bᵀ f under the force of the current solution.
    yields_mm: Option<f64>,
}

impl CondensedPair<'_> {
    /// Nodes of the slave beside the window within `reach_mm` of the master.
    pub(super) fn beside_window(&self, placed: &PlacedTeeth, reach_mm: f64) -> BesideWindow {
        let PlacedTeeth { pair, slave, tooth, half_width_mm, ref edges, turn, .. } = *placed;
        let (own, mate) = (&self.flanks[slave], &self.flanks[slave.mate()]);
        let master: Vec<(usize, Vector2<f64>)> = mate
            .tip_to_root()
            .map(|node| (node, turn * mate.surface.points_mm[node] + placed.master_axis_mm))
            .collect();
        let mut in_window = vec![false; own.surface.points_mm.len()];
        for edge in &own.surface.edges[edges[slave].clone()] {
            edge.nodes().iter().for_each(|&node| in_window[node] = true);
        }
        let mut after = master.len();
        let mut nodes: Vec<BesideNode> = own
            .tip_to_root()
            .filter(|&node| !in_window[node])
            .filter_map(|node| {
                after = node_after_foot(after, &master, own.surface.points_mm[node], own.surface.normals[node]);
                self.beside_node(placed, node, &master, after, reach_mm)
            })
            .collect();
        let along_mm: Vec<f64> = nodes.iter().map(|at| own.from_tip_mm[at.node as usize]).collect();
        let probes = probes(&along_mm, PROBES_APART * half_width_mm);
        for ends in probes.windows(2) {
            let [from_mm, to_mm] = [along_mm[ends[0]], along_mm[ends[1]]];
            for at in ends[0]..ends[1] {
                let t = (along_mm[at] - from_mm) / (to_mm - from_mm);
                nodes[at].next_probe_part = t;
            }
        }
        // A node that rotation does not bring nearer never touches.
        let nearing = nodes.iter().filter(|at| at.by_rotation < 0.0);
        let first_touch_mm = nearing.map(|at| -at.gap_mm / at.by_rotation).fold(f64::INFINITY, f64::min);
        let spans = (0..probes.len())
            .map(|k| Span::new(&nodes, probes[k]..probes.get(k + 1).map_or(nodes.len(), |next| *next)));
        let spans = spans.collect();
        let probes =
            probes.into_iter().map(|at| Probe { at, compliance: None, least: Vec::new(), yields_mm: None }).collect();
        BesideWindow { pair, slave, tooth, turn, nodes, first_touch_mm, probes, spans, deepest_mm: 0.0 }
    }

    /// Slave's node beside the window with its foot before the node `after` of the `master`'s, from tip to root; `None` where there is none within reach.
    fn beside_node(
        &self,
        placed: &PlacedTeeth,
        node: usize,
        master: &[(usize, Vector2<f64>)],
        after: usize,
        reach_mm: f64,
    ) -> Option<BesideNode> {
        let (own, mate) = (&self.flanks[placed.slave].surface, &self.flanks[placed.slave.mate()].surface);
        let (point, normal) = (own.points_mm[node], own.normals[node]);
        let ((first, from), (second, to)) = (*master.get(after.checked_sub(1)?)?, *master.get(after)?);
        let [before, after] = [from, to].map(|place| (place - point).perp(&normal));
        let t = before / (before - after);
        let gap_mm = (from + t * (to - from) - point).dot(&normal);
        let in_masters = placed.turn.inverse() * normal;
        let normal_there = (mate.normals[first] + t * (mate.normals[second] - mate.normals[first])).normalize();
        let cosine = -normal_there.dot(&in_masters);
        if gap_mm.abs() > reach_mm || cosine <= LEAST_FACING {
            return None;
        }
        let mut beside = BesideNode {
            node: node as u32,
            foot: [first as u32, second as u32],
            second_part: t,
            cosine,
            gap_mm,
            by_rotation: 0.0,
            next_probe_part: 0.0,
        };
        let on_pinion = if placed.slave == Gear::Pinion { normal } else { in_masters };
        let of_pinion = beside.entries(placed.slave == Gear::Pinion, on_pinion);
        beside.by_rotation = of_pinion.map(|(column, b)| b * self.rotation(column, Direction::AcrossFlank)).sum();
        Some(beside)
    }

    /// Part of the flanks that overlaps beside the window of `facings` in the solution `found`; `depth_mm` is the wear at the local nodes of a
    /// gear's flank.
    pub(super) fn overlap(
        &self,
        beside: &mut BesideWindow,
        facings: &[FacingTeeth],
        found: &ContactEquilibrium,
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Option<FlankOverlap> {
        let turned_mm = found.rigid[0];
        beside.deepest_mm = 0.0;
        // Bounds of the spans hold for gears that are turned towards one another.
        if turned_mm <= beside.first_touch_mm.max(0.0) {
            return None;
        }
        let unknown = beside.probes_without_compliance(turned_mm);
        if !unknown.is_empty() {
            self.find_compliance(beside, &unknown, facings);
        }
        beside.probes.iter_mut().for_each(|probe| probe.yields_mm = None);
        let mut from_tip_mm: Option<PerGear<[f64; 2]>> = None;
        let loads: Vec<f64> = facings.iter().map(|facing| found.force[facing.rows()].iter().sum()).collect();
        for (at, unworn_mm) in beside.overlapping(turned_mm, &found.force, &loads) {
            let gap_mm = unworn_mm + beside.worn_mm(at, depth_mm);
            beside.deepest_mm = beside.deepest_mm.max(-gap_mm);
            if gap_mm >= -OVERLOOKED * turned_mm {
                continue;
            }
            let at = &beside.nodes[at];
            let along_mm = PerGear::from_fn(|gear| {
                let along_mm = &self.flanks[gear].from_tip_mm;
                if gear == beside.slave { along_mm[at.node as usize] } else { at.at_foot(|node| along_mm[node]) }
            });
            let ends_mm = from_tip_mm.get_or_insert(along_mm.map(|along_mm| [along_mm; 2]));
            for gear in Gear::BOTH {
                let [from_mm, to_mm] = ends_mm[gear];
                ends_mm[gear] = [from_mm.min(along_mm[gear]), to_mm.max(along_mm[gear])];
            }
        }
        from_tip_mm.map(|from_tip_mm| FlankOverlap { pair: beside.pair, from_tip_mm })
    }

    /// Calculates b C Bᵀ at these probes.
    fn find_compliance(&self, beside: &mut BesideWindow, probes: &[usize], facings: &[FacingTeeth]) {
        let rows = facings.iter().map(|facing| facing.coupling.len()).sum();
        let mut compliance = Mat::zeros(probes.len(), rows);
        for gear in Gear::BOTH {
            let operator = self.operator(beside, probes, gear);
            let carried = CarriedRows::new(&self.gears[gear], &operator);
            let own = ToothRows::new(&self.gears[gear], beside.tooth[gear], 0, &carried);
            for other in self.tooth_rows(facings, gear) {
                own.add_product(&other, &mut compliance);
            }
        }
        for (row, &probe) in probes.iter().enumerate() {
            let compliance: Vec<f64> = compliance.row(row).iter().copied().collect();
            let of_pair = |facing: &FacingTeeth| &compliance[facing.rows()];
            let least = facings.iter().map(|facing| of_pair(facing).iter().copied().fold(f64::INFINITY, f64::min));
            beside.probes[probe].least = least.collect();
            beside.probes[probe].compliance = Some(compliance);
        }
    }

    /// Rows of B of these probes.
    fn operator(&self, beside: &BesideWindow, probes: &[usize], gear: Gear) -> CsMat<f64> {
        let is_slave = gear == beside.slave;
        let mut triplets = TriMat::new((probes.len(), 2 * self.flanks[gear].surface.points_mm.len()));
        for (row, &probe) in probes.iter().enumerate() {
            let node = &beside.nodes[beside.probes[probe].at];
            let normal = self.flanks[beside.slave].surface.normals[node.node as usize];
            let normal = if is_slave { normal } else { beside.turn.inverse() * normal };
            node.entries(is_slave, normal).for_each(|(column, b)| triplets.add_triplet(row, column, b));
        }
        triplets.to_csr()
    }
}

/// Number of the `master`'s node after the foot of the normal at a point of the slave: as from tip to root the master runs against the slave, not far from
/// that of the slave's node before, `near`.
fn node_after_foot(near: usize, master: &[(usize, Vector2<f64>)], point: Vector2<f64>, normal: Vector2<f64>) -> usize {
    let is_before_foot = |(_, place): &(usize, Vector2<f64>)| (place - point).perp(&normal) < 0.0;
    let passed = master[near..].iter().take_while(|node| is_before_foot(node)).count();
    let back = master[..near + passed].iter().rev().take_while(|node| !is_before_foot(node)).count();
    near + passed - back
}

/// Numbers of the probes among nodes at `along_mm`: the first, the last, and as few between as leave no greater distance than `apart_mm`
/// except over the window.
fn probes(along_mm: &[f64], apart_mm: f64) -> Vec<usize> {
    let mut probes: Vec<usize> = Vec::new();
    for (at, here_mm) in along_mm.iter().enumerate() {
        let within_reach = probes.last().zip(along_mm.get(at + 1)).is_some_and(|(&last, next_mm)| {
            [here_mm, next_mm].into_iter().all(|to_mm| to_mm - along_mm[last] <= apart_mm)
        });
        if !within_reach {
            probes.push(at);
        }
    }
    probes
}

impl BesideWindow {
    /// Greatest overlap of the last solution, mm.
    pub(super) fn deepest_mm(&self) -> f64 {
        self.deepest_mm
    }

    /// Nodes that would overlap without wear, and their gaps then, under `force` on the multipliers, whose sums for each tooth pair are the `loads`.
    fn overlapping(&mut self, turned_mm: f64, force: &[f64], loads: &[f64]) -> Vec<(usize, f64)> {
        let mut overlapping = Vec::new();
        for span in 0..self.spans.len() {
            let rigid_mm = self.spans[span].least_mm(turned_mm);
            if rigid_mm >= 0.0 {
                continue;
            }
            let after = (span + 1).min(self.probes.len() - 1);
            let least_mm = [span, after].map(|probe| weighted_sum(&self.probes[probe].least, loads));
            if rigid_mm + least_mm[0].min(least_mm[1]) >= 0.0 {
                continue;
            }
            let yields_mm = [span, after].map(|probe| self.probes[probe].yields_mm(force));
            if rigid_mm + yields_mm[0].min(yields_mm[1]) >= 0.0 {
                continue;
            }
            let first = self.spans[span].nodes.start;
            for (k, node) in self.nodes[self.spans[span].nodes.clone()].iter().enumerate() {
                let part = node.next_probe_part;
                let yields_mm = (1.0 - part) * yields_mm[0] + part * yields_mm[1];
                let gap_mm = node.gap_mm + node.by_rotation * turned_mm + yields_mm;
                if gap_mm < 0.0 {
                    overlapping.push((first + k, gap_mm));
                }
            }
        }
        overlapping
    }

    /// Opening of the gap at a node by wear, mm.
    fn worn_mm(&self, at: usize, depth_mm: &dyn Fn(Gear, usize) -> f64) -> f64 {
        let node = &self.nodes[at];
        depth_mm(self.slave, node.node as usize) + node.at_foot(|node| depth_mm(self.slave.mate(), node)) / node.cosine
    }

    /// Forgets the compliances that were found: found again, probe by probe or many at once, they may differ in their last bits.
    pub(super) fn forget(&mut self) {
        self.probes.iter_mut().for_each(|probe| probe.compliance = None);
    }

    /// Probes whose compliance is not known yet, around nodes that would overlap if the teeth were rigid and unworn.
    fn probes_without_compliance(&self, turned_mm: f64) -> Vec<usize> {
        let overlapping = self.spans.iter().enumerate().filter(|(_, span)| span.least_mm(turned_mm) < 0.0);
        let around = overlapping.flat_map(|(span, _)| [span, (span + 1).min(self.probes.len() - 1)]);
        let mut unknown: Vec<usize> = around.filter(|probe| self.probes[*probe].compliance.is_none()).collect();
        unknown.dedup();
        unknown
    }
}

impl Span {
    fn new(nodes: &[BesideNode], range: Range<usize>) -> Self {
        let least = |of: fn(&BesideNode) -> f64| nodes[range.clone()].iter().map(of).fold(f64::INFINITY, f64::min);
        let (least_gap_mm, least_by_rotation) = (least(|node| node.gap_mm), least(|node| node.by_rotation));
        Self { nodes: range, least_gap_mm, least_by_rotation }
    }

    /// Lower bound of the gaps if the teeth were rigid and unworn, mm; `turned_mm` ≥ 0.
    fn least_mm(&self, turned_mm: f64) -> f64 {
        self.least_gap_mm + self.least_by_rotation * turned_mm
    }
}

impl Probe {
    /// Opening of the gap by the deflection under `force`, mm.
    fn yields_mm(&mut self, force: &[f64]) -> f64 {
        let compliance = self.compliance.as_deref().unwrap_or_default();
        *self.yields_mm.get_or_insert_with(|| weighted_sum(compliance, force))
    }
}

impl BesideNode {
    /// Value at the foot, interpolated between the master's local nodes.
    fn at_foot(&self, of: impl Fn(usize) -> f64) -> f64 {
        let [first, second] = self.foot.map(|node| of(node as usize));
        (1.0 - self.second_part) * first + self.second_part * second
    }

    /// Columns and entries of b for displacements of the slave or of the master, in whose frame the slave's `normal` is given.
    fn entries(&self, is_slave: bool, normal: Vector2<f64>) -> impl Iterator<Item = (usize, f64)> {
        let parts = match is_slave {
            true => [(self.node, -1.0), (self.node, 0.0)],
            false => [(self.foot[0], 1.0 - self.second_part), (self.foot[1], self.second_part)],
        };
        let loaded = parts.into_iter().map(|(node, part)| (node as usize, part)).filter(|(_, part)| *part != 0.0);
        loaded.flat_map(move |(node, part)| [(2 * node, part * normal.x), (2 * node + 1, part * normal.y)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Feet of an arc on a polyline that runs against it are those found by bisection, wherever the search begins; beyond both ends too.
    #[test]
    fn ver_feet_are_found_from_any_other() {
        let master: Vec<(usize, Vector2<f64>)> =
            (0..9).map(|k| (k, Vector2::new(0.3 * f64::from(k as i32 - 4), 0.01))).collect();
        for angle_rad in (-20..=20).map(|k| 0.1 * f64::from(k)) {
            let (point, normal) =
                (Vector2::new(angle_rad, -0.1 * angle_rad * angle_rad), Vector2::new(0.1 * angle_rad, 1.0));
            let bisected = master.partition_point(|(_, place)| (place - point).perp(&normal) < 0.0);
            for near in 0..=master.len() {
                assert_eq!(node_after_foot(near, &master, point, normal), bisected, "{angle_rad} from {near}");
            }
        }
    }
}
