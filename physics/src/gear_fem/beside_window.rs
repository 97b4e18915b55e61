//! Whether flanks overlap beside the window in which their contact is looked for.
//!
//! Worn flanks touch in more places than one: a tip edge meets the ridge in which the wear of its mate ends while both flanks touch on
//! the line of action. A node of the slave beside the window, whose normal meets the master at a foot, has the gap
//!
//! ```text
//! g = g⁰ + h_s + h_m/(n_s · n_m) + b r δ + b C Bᵀ f
//! ```
//!
//! under the forces f of the window's multipliers, b being the row of B for the node and its foot alone. Nowhere may that be below zero: where
//! it is, the window must reach. Teeth bend away from each other, so that the last term only opens gaps, and matters for those
//! nodes alone that would overlap without it. Beside the contact it changes slowly along the flank: it is found at some of the nodes, the
//! probes, and lies on straight lines between them.

use faer::Mat;
use nalgebra::Vector2;
use sprs::{CsMat, TriMat};

use super::condensed_pair::CondensedPair;
use super::facing_teeth::{Direction, FacingTeeth, Overlap, PlacedTeeth};
use super::prepared::add_sandwich;
use crate::gear::{Gear, PerGear};
use gearwear_fem::active_set::Equilibrium;
use gearwear_fem::contact::master_search::LEAST_FACING;

/// Part of the transmission error by which nodes may overlap: what straight lines between nodes and probes are off by is less.
const OVERLOOKED: f64 = 1e-3;
/// Distance of probes in half-widths of contact.
const PROBES_APART: f64 = 0.5;

/// Nodes of a tooth pair's slave beside the window that may come to touch.
pub(super) struct BesideWindow {
    pair: i32,
    slave: Gear,
    tooth: PerGear<usize>,
    /// From tip to root.
    nodes: Vec<BesideNode>,
    /// The transmission error at which each would touch if rigid and unworn, mm.
    touch_at_mm: Vec<f64>,
    /// The least of these.
    first_touch_mm: f64,
    probes: Vec<Probe>,
    /// How deep the flanks overlap, as last looked at, mm.
    deepest_mm: f64,
}

struct BesideNode {
    /// Local node of the slave.
    node: usize,
    /// Local nodes of the master to either side of the foot, and the part that each has in it.
    foot: [(usize, f64); 2],
    /// The slave's normal in the frame of each tooth.
    normal: PerGear<Vector2<f64>>,
    /// n_s · −n_m.
    cosine: f64,
    /// g⁰.
    gap_mm: f64,
    /// b r.
    by_rotation: f64,
    /// The probes to either side, and the part that each has in it.
    probes: [(usize, f64); 2],
}

/// A node at which b C Bᵀ is found.
struct Probe {
    /// Which of the nodes.
    at: usize,
    /// Once it was needed.
    compliance: Option<Vec<f64>>,
    /// b C Bᵀ f, while it is looked at.
    yields_mm: Option<f64>,
}

impl CondensedPair<'_> {
    /// What of the slave lies beside the window within `reach_mm` of the master.
    pub(super) fn beside_window(&self, placed: &PlacedTeeth, reach_mm: f64) -> BesideWindow {
        let PlacedTeeth { pair, slave, tooth, half_width_mm, ref edges, turn, master_axis_mm, .. } = *placed;
        let (own, mate) = (&self.flanks[slave], &self.flanks[slave.mate()]);
        let master: Vec<(usize, Vector2<f64>)> =
            mate.tip_to_root().map(|node| (node, turn * mate.surface.points_mm[node] + master_axis_mm)).collect();
        let mut in_window = vec![false; own.surface.points_mm.len()];
        for edge in &own.surface.edges[edges[slave].clone()] {
            edge.nodes().iter().for_each(|&node| in_window[node] = true);
        }
        let beside = |node: usize| {
            let (point, normal) = (own.surface.points_mm[node], own.surface.normals[node]);
            // From tip to root the master runs against the slave.
            let past = |place: &Vector2<f64>| (place - point).perp(&normal);
            let after = master.partition_point(|(_, place)| past(place) < 0.0);
            let ((first, from), (second, to)) = (*master.get(after.checked_sub(1)?)?, *master.get(after)?);
            let t = past(&from) / (past(&from) - past(&to));
            let gap_mm = (from + t * (to - from) - point).dot(&normal);
            let normals = &mate.surface.normals;
            let in_masters = turn.inverse() * normal;
            let cosine = -(normals[first] + t * (normals[second] - normals[first])).normalize().dot(&in_masters);
            if gap_mm.abs() > reach_mm || cosine <= LEAST_FACING {
                return None;
            }
            let normal = match slave {
                Gear::Pinion => PerGear { pinion: normal, wheel: in_masters },
                Gear::Wheel => PerGear { pinion: in_masters, wheel: normal },
            };
            let foot = [(first, 1.0 - t), (second, t)];
            let mut beside =
                BesideNode { node, foot, normal, cosine, gap_mm, by_rotation: 0.0, probes: [(0, 1.0), (0, 0.0)] };
            let of_pinion = beside.entries(slave, Gear::Pinion);
            beside.by_rotation = of_pinion.map(|(column, b)| b * self.rotation(column, Direction::AcrossFlank)).sum();
            Some(beside)
        };
        let mut nodes: Vec<BesideNode> =
            own.tip_to_root().filter(|&node| !in_window[node]).filter_map(beside).collect();
        let along_mm: Vec<f64> = nodes.iter().map(|at| own.from_tip_mm[at.node]).collect();
        let probes = probes(&along_mm, PROBES_APART * half_width_mm);
        for (after, ends) in probes.windows(2).enumerate() {
            let [from_mm, to_mm] = [along_mm[ends[0]], along_mm[ends[1]]];
            for at in ends[0]..=ends[1] {
                let t = (along_mm[at] - from_mm) / (to_mm - from_mm);
                nodes[at].probes = [(after, 1.0 - t), (after + 1, t)];
            }
        }
        let probes = probes.into_iter().map(|at| Probe { at, compliance: None, yields_mm: None }).collect();
        // A node that turning does not bring nearer never touches.
        let touch_at_mm =
            |at: &BesideNode| if at.by_rotation < 0.0 { -at.gap_mm / at.by_rotation } else { f64::INFINITY };
        let touch_at_mm: Vec<f64> = nodes.iter().map(touch_at_mm).collect();
        let first_touch_mm = touch_at_mm.iter().copied().fold(f64::INFINITY, f64::min);
        BesideWindow { pair, slave, tooth, nodes, touch_at_mm, first_touch_mm, probes, deepest_mm: 0.0 }
    }

    /// Where the flanks overlap beside the window of `facings`, in which `found` holds them apart; `depth_mm` is what the local nodes of a
    /// gear's flank have lost.
    pub(super) fn overlap(
        &self,
        beside: &mut BesideWindow,
        facings: &[FacingTeeth],
        found: &Equilibrium,
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Option<Overlap> {
        let turned_mm = found.rigid[0];
        beside.deepest_mm = 0.0;
        if turned_mm <= beside.first_touch_mm {
            return None;
        }
        let overlapping = beside.overlapping(turned_mm, depth_mm);
        let unknown = beside.probes_without_compliance(&overlapping);
        if !unknown.is_empty() {
            self.find_compliance(beside, &unknown, facings);
        }
        beside.probes.iter_mut().for_each(|probe| probe.yields_mm = None);
        let mut from_tip_mm: Option<PerGear<[f64; 2]>> = None;
        for (at, if_rigid_mm) in overlapping {
            let gap_mm = if_rigid_mm + beside.yields_mm(at, &found.force);
            beside.deepest_mm = beside.deepest_mm.max(-gap_mm);
            if gap_mm >= -OVERLOOKED * turned_mm {
                continue;
            }
            let at = &beside.nodes[at];
            let along_mm = PerGear::from_fn(|gear| {
                let along_mm = &self.flanks[gear].from_tip_mm;
                if gear == beside.slave { along_mm[at.node] } else { at.at_foot(|node| along_mm[node]) }
            });
            let ends_mm = from_tip_mm.get_or_insert(along_mm.map(|along_mm| [along_mm; 2]));
            for gear in Gear::BOTH {
                let [from_mm, to_mm] = ends_mm[gear];
                ends_mm[gear] = [from_mm.min(along_mm[gear]), to_mm.max(along_mm[gear])];
            }
        }
        from_tip_mm.map(|from_tip_mm| Overlap { pair: beside.pair, from_tip_mm })
    }

    /// Finds b C Bᵀ at these probes.
    fn find_compliance(&self, beside: &mut BesideWindow, probes: &[usize], facings: &[FacingTeeth]) {
        let rows = facings.iter().map(|facing| facing.coupling.len()).sum();
        let mut compliance = Mat::zeros(probes.len(), rows);
        for gear in Gear::BOTH {
            let operator = beside.operator(probes, gear, self.flanks[gear].surface.points_mm.len());
            for facing in facings {
                let between = self.gears[gear].between(facing.tooth[gear], beside.tooth[gear]);
                let places = (0, facing.first_row);
                add_sandwich(&mut compliance, places, &operator, between, &facing.operator[gear], false);
            }
        }
        for (row, &probe) in probes.iter().enumerate() {
            beside.probes[probe].compliance = Some(compliance.row(row).iter().copied().collect());
        }
    }
}

/// Which of the nodes at `along_mm` are probes: the first, the last, and as few between as leave none farther apart than `apart_mm`, but
/// for the window.
fn probes(along_mm: &[f64], apart_mm: f64) -> Vec<usize> {
    let mut probes: Vec<usize> = Vec::new();
    for (at, &here_mm) in along_mm.iter().enumerate() {
        let too_far = |from_mm: f64, to_mm: Option<&f64>| to_mm.is_none_or(|to_mm| to_mm - from_mm > apart_mm);
        match probes.last() {
            Some(&last)
                if !too_far(along_mm[last], along_mm.get(at + 1)) && !too_far(along_mm[last], Some(&here_mm)) => {}
            _ => probes.push(at),
        }
    }
    probes
}

impl BesideWindow {
    /// How deep the flanks overlap, as last looked at, mm.
    pub(super) fn deepest_mm(&self) -> f64 {
        self.deepest_mm
    }

    /// Nodes that would overlap if the flanks were rigid, and their gaps.
    fn overlapping(&self, turned_mm: f64, depth_mm: &dyn Fn(Gear, usize) -> f64) -> Vec<(usize, f64)> {
        let (slave, master) = (self.slave, self.slave.mate());
        let if_rigid_mm = |(at, node): (usize, &BesideNode)| {
            let mates_mm = node.at_foot(|node| depth_mm(master, node));
            let worn_mm = depth_mm(slave, node.node) + mates_mm / node.cosine;
            let gap_mm = node.gap_mm + worn_mm + node.by_rotation * turned_mm;
            (gap_mm < 0.0).then_some((at, gap_mm))
        };
        let may_touch = self.nodes.iter().enumerate().filter(|(at, _)| self.touch_at_mm[*at] < turned_mm);
        may_touch.filter_map(if_rigid_mm).collect()
    }

    /// The probes around these nodes where it is not known how far the flanks give way.
    fn probes_without_compliance(&self, overlapping: &[(usize, f64)]) -> Vec<usize> {
        let around = overlapping.iter().flat_map(|(at, _)| self.nodes[*at].probes.map(|(probe, _)| probe));
        let mut unknown: Vec<usize> = around.filter(|probe| self.probes[*probe].compliance.is_none()).collect();
        unknown.sort_unstable();
        unknown.dedup();
        unknown
    }

    /// How far the flanks give way at a node under `force`, mm.
    fn yields_mm(&mut self, at: usize, force: &[f64]) -> f64 {
        let mut at_probe = |(probe, part): (usize, f64)| {
            let Probe { compliance, yields_mm, .. } = &mut self.probes[probe];
            let products = compliance.iter().flatten().zip(force).map(|(c, force)| c * force);
            part * *yields_mm.get_or_insert_with(|| products.sum())
        };
        self.nodes[at].probes.map(&mut at_probe).iter().sum()
    }

    /// B of these probes.
    fn operator(&self, probes: &[usize], gear: Gear, flank_nodes: usize) -> CsMat<f64> {
        let mut triplets = TriMat::new((probes.len(), 2 * flank_nodes));
        for (row, &probe) in probes.iter().enumerate() {
            for (column, b) in self.nodes[self.probes[probe].at].entries(self.slave, gear) {
                triplets.add_triplet(row, column, b);
            }
        }
        triplets.to_csr()
    }
}

impl BesideNode {
    /// Mean at the foot of what the master's local nodes have.
    fn at_foot(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.foot.iter().map(|&(node, part)| part * of(node)).sum()
    }

    /// b for displacements of `gear`: column and entry.
    fn entries(&self, slave: Gear, gear: Gear) -> impl Iterator<Item = (usize, f64)> {
        let normal = self.normal[gear];
        let parts = if gear == slave { [(self.node, -1.0), (self.node, 0.0)] } else { self.foot };
        let entries = move |(node, part): (usize, f64)| [(2 * node, part * normal.x), (2 * node + 1, part * normal.y)];
        parts.into_iter().filter(|(_, part)| *part != 0.0).flat_map(entries)
    }
}
