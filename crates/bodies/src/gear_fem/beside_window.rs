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
//! probes, and linear between them.

use faer::Mat;
use nalgebra::Vector2;
use sprs::{CsMat, TriMat};

use super::condensed_pair::CondensedPair;
use super::facing_teeth::{Direction, FacingTeeth, FlankOverlap, PlacedTeeth};
use super::sandwich::ToothRows;
use crate::gear::{Gear, PerGear};
use gearwear_fem::active_set::ContactEquilibrium;
use gearwear_fem::contact::master_search::LEAST_FACING;

/// Overlap over the transmission error that is tolerated, above the error of interpolation between nodes and probes.
const OVERLOOKED: f64 = 1e-3;
/// Distance of probes in half-widths of contact.
const PROBES_APART: f64 = 0.5;

/// Nodes of a tooth pair's slave beside the window that may come to touch.
pub(super) struct BesideWindow {
    pair: i32,
    slave: Gear,
    tooth: PerGear<usize>,
    /// Nodes from tip to root.
    nodes: Vec<BesideNode>,
    /// Transmission error at which each would touch if rigid and unworn, mm.
    touch_at_mm: Vec<f64>,
    /// Least of these transmission errors.
    first_touch_mm: f64,
    probes: Vec<Probe>,
    /// Greatest overlap of the last solution, mm.
    deepest_mm: f64,
}

struct BesideNode {
    /// Local node of the slave.
    node: usize,
    /// Local nodes of the master to either side of the foot, and their weights.
    foot: [(usize, f64); 2],
    /// Slave's normal in the frame of each tooth.
    normal: PerGear<Vector2<f64>>,
    /// Cosine n_s · −n_m.
    cosine: f64,
    /// Gap g⁰ of the unworn flanks.
    gap_mm: f64,
    /// Change b r of the gap per transmission error.
    by_rotation: f64,
    /// Probes to either side, and their weights.
    probes: [(usize, f64); 2],
}

/// Node at which b C Bᵀ is calculated.
struct Probe {
    /// Number among the nodes.
    at: usize,
    /// Row b C Bᵀ, from its first use on.
    compliance: Option<Vec<f64>>,
    /// Deflection b C Bᵀ f under the force of the current solution.
    yields_mm: Option<f64>,
}

impl CondensedPair<'_> {
    /// Nodes of the slave beside the window within `reach_mm` of the master.
    pub(super) fn beside_window(&self, placed: &PlacedTeeth, reach_mm: f64) -> BesideWindow {
        let PlacedTeeth { pair, slave, tooth, half_width_mm, ref edges, .. } = *placed;
        let (own, mate) = (&self.flanks[slave], &self.flanks[slave.mate()]);
        let master: Vec<(usize, Vector2<f64>)> = mate
            .tip_to_root()
            .map(|node| (node, placed.turn * mate.surface.points_mm[node] + placed.master_axis_mm))
            .collect();
        let mut in_window = vec![false; own.surface.points_mm.len()];
        for edge in &own.surface.edges[edges[slave].clone()] {
            edge.nodes().iter().for_each(|&node| in_window[node] = true);
        }
        let mut nodes: Vec<BesideNode> = own
            .tip_to_root()
            .filter(|&node| !in_window[node])
            .filter_map(|node| self.beside_node(placed, node, &master, reach_mm))
            .collect();
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
        // A node that rotation does not bring nearer never touches.
        let touch_at_mm: Vec<f64> = nodes
            .iter()
            .map(|at| if at.by_rotation < 0.0 { -at.gap_mm / at.by_rotation } else { f64::INFINITY })
            .collect();
        let first_touch_mm = touch_at_mm.iter().copied().fold(f64::INFINITY, f64::min);
        BesideWindow { pair, slave, tooth, nodes, touch_at_mm, first_touch_mm, probes, deepest_mm: 0.0 }
    }

    /// Slave's node beside the window with its foot on the `master`'s nodes, from tip to root; `None` where there is none within reach.
    fn beside_node(
        &self,
        placed: &PlacedTeeth,
        node: usize,
        master: &[(usize, Vector2<f64>)],
        reach_mm: f64,
    ) -> Option<BesideNode> {
        let (own, mate) = (&self.flanks[placed.slave].surface, &self.flanks[placed.slave.mate()].surface);
        let (point, normal) = (own.points_mm[node], own.normals[node]);
        // From tip to root the master runs against the slave.
        let after = master.partition_point(|(_, place)| (place - point).perp(&normal) < 0.0);
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
        let normal = PerGear::from_fn(|gear| if gear == placed.slave { normal } else { in_masters });
        let (foot, probes) = ([(first, 1.0 - t), (second, t)], [(0, 1.0), (0, 0.0)]);
        let mut beside = BesideNode { node, foot, normal, cosine, gap_mm, by_rotation: 0.0, probes };
        let of_pinion = beside.entries(placed.slave, Gear::Pinion);
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
        from_tip_mm.map(|from_tip_mm| FlankOverlap { pair: beside.pair, from_tip_mm })
    }

    /// Calculates b C Bᵀ at these probes.
    fn find_compliance(&self, beside: &mut BesideWindow, probes: &[usize], facings: &[FacingTeeth]) {
        let rows = facings.iter().map(|facing| facing.coupling.len()).sum();
        let mut compliance = Mat::zeros(probes.len(), rows);
        for gear in Gear::BOTH {
            let operator = beside.operator(probes, gear, self.flanks[gear].surface.points_mm.len());
            let own = ToothRows::new(&self.gears[gear], beside.tooth[gear], 0, &operator);
            let operators: Vec<&CsMat<f64>> = facings.iter().map(|facing| &facing.operator[gear]).collect();
            for other in self.tooth_rows(facings, gear, &operators) {
                own.add_product(&other, &mut compliance);
            }
        }
        for (row, &probe) in probes.iter().enumerate() {
            beside.probes[probe].compliance = Some(compliance.row(row).iter().copied().collect());
        }
    }
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

    /// Nodes that would overlap if the teeth were rigid, and their gaps.
    fn overlapping(&self, turned_mm: f64, depth_mm: &dyn Fn(Gear, usize) -> f64) -> Vec<(usize, f64)> {
        let (slave, master) = (self.slave, self.slave.mate());
        let may_touch = self.nodes.iter().enumerate().filter(|(at, _)| self.touch_at_mm[*at] < turned_mm);
        let gaps = may_touch.map(|(at, node)| {
            let mates_mm = node.at_foot(|node| depth_mm(master, node));
            let worn_mm = depth_mm(slave, node.node) + mates_mm / node.cosine;
            (at, node.gap_mm + worn_mm + node.by_rotation * turned_mm)
        });
        gaps.filter(|(_, gap_mm)| *gap_mm < 0.0).collect()
    }

    /// Probes around these nodes whose compliance is not known yet.
    fn probes_without_compliance(&self, overlapping: &[(usize, f64)]) -> Vec<usize> {
        let around = overlapping.iter().flat_map(|(at, _)| self.nodes[*at].probes.map(|(probe, _)| probe));
        let mut unknown: Vec<usize> = around.filter(|probe| self.probes[*probe].compliance.is_none()).collect();
        unknown.sort_unstable();
        unknown.dedup();
        unknown
    }

    /// Opening of the gap at a node by the deflection under `force`, mm.
    fn yields_mm(&mut self, at: usize, force: &[f64]) -> f64 {
        let parts = self.nodes[at].probes.map(|(probe, part)| {
            let Probe { compliance, yields_mm, .. } = &mut self.probes[probe];
            let products = compliance.iter().flatten().zip(force).map(|(c, force)| c * force);
            part * *yields_mm.get_or_insert_with(|| products.sum())
        });
        parts.iter().sum()
    }

    /// Rows of B of these probes.
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
    /// Value at the foot, interpolated between the master's local nodes.
    fn at_foot(&self, of: impl Fn(usize) -> f64) -> f64 {
        self.foot.iter().map(|&(node, part)| part * of(node)).sum()
    }

    /// Columns and entries of b for displacements of `gear`.
    fn entries(&self, slave: Gear, gear: Gear) -> impl Iterator<Item = (usize, f64)> {
        let normal = self.normal[gear];
        let parts = if gear == slave { [(self.node, -1.0), (self.node, 0.0)] } else { self.foot };
        let loaded = parts.into_iter().filter(|(_, part)| *part != 0.0);
        loaded.flat_map(move |(node, part)| [(2 * node, part * normal.x), (2 * node + 1, part * normal.y)])
    }
}
