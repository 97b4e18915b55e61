//! Nodes of a working flank as points of the wear profile.
//!
//! Wear is a depth h at every node, linear between them: h(s) = Σ_k h_k N_k(s) with hat functions N_k over the arc length
//! s of the profile, constant beyond its ends. A volume V per face width worn off a stretch [a, b] wears the nodes by
//!
//! ```text
//! h_k ← h_k + m_k V / W_k          m_k = 1/(b − a) ∫ N_k ds over [a, b]          W_k = ∫ N_k ds over the flank
//! ```
//!
//! so that Σ W_k h_k grows by V, whatever the stretch. The mean depth on the stretch is Σ m_k h_k.

use super::flank_surface::MeshedFlank;
use crate::gear::modification::Kink;
use crate::reference::linear_means::{add_means, value_at};

/// Fraction of an edge that the multiplier of a corner loads: ∫ψ of a quadratic edge is 1/6, 4/6 and 1/6 of its length.
const CORNER_SHARE: f64 = 1.0 / 6.0;

/// Nodes to either side over which a slope is taken, an element.
const NODES_TO_A_SIDE: usize = 2;

/// Nodes of one flank, from root to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankNodes {
    /// Distance of each node from the root end along the profile, mm.
    pub along_mm: Vec<f64>,
    /// Length W_k of the profile that each node represents, mm.
    pub share_mm: Vec<f64>,
    /// Number of each local node of the surface in this order.
    pub place: Vec<usize>,
    /// Stretch that the multiplier of each node loads, mm.
    pub loaded_mm: Vec<[f64; 2]>,
    /// Distance of the flank's kinks from the root end, mm.
    pub kinks_mm: Vec<f64>,
}

/// Consecutive nodes and the weight of each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights<'a> {
    /// First node.
    pub first: usize,
    /// Weights m_k of the nodes from the first on.
    pub weights: &'a [f64],
}

impl FlankNodes {
    /// Nodes of `flank` with these kinks.
    pub fn new(flank: &MeshedFlank, kinks: impl Iterator<Item = Kink>) -> Self {
        let count = flank.from_tip_mm.len();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| flank.from_tip_mm[b].total_cmp(&flank.from_tip_mm[a]));
        let length_mm = order.first().map_or(0.0, |&root| flank.from_tip_mm[root]);
        let along_mm: Vec<f64> = order.iter().map(|&node| length_mm - flank.from_tip_mm[node]).collect();
        let mut place = vec![0; count];
        order.iter().enumerate().for_each(|(at, &node)| place[node] = at);
        let share_mm = (0..count)
            .map(|k| {
                let before = if k > 0 { along_mm[k] - along_mm[k - 1] } else { 0.0 };
                let after = if k + 1 < count { along_mm[k + 1] - along_mm[k] } else { 0.0 };
                0.5 * (before + after)
            })
            .collect();
        let mut loaded_mm = along_mm.iter().map(|&at| [at, at]).collect::<Vec<_>>();
        for edge in &flank.surface.edges {
            // Edges run from tip to root.
            let ends = [place[edge.nodes()[1]], place[edge.nodes()[0]]];
            let length = along_mm[ends[1]] - along_mm[ends[0]];
            let corner = if edge.nodes().len() == 3 { CORNER_SHARE } else { 0.5 } * length;
            loaded_mm[ends[0]][1] += corner;
            loaded_mm[ends[1]][0] -= corner;
            if let Some(&middle) = edge.nodes().get(2) {
                loaded_mm[place[middle]] = [along_mm[ends[0]] + corner, along_mm[ends[1]] - corner];
            }
        }
        let kinks_mm = kinks.map(|kink| length_mm - flank.distance_to_tip_mm(kink.rho_mm)).collect();
        Self { along_mm, share_mm, place, loaded_mm, kinks_mm }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.along_mm.len()
    }

    /// Adds `weight` times the m_k of a stretch to `sums`, one entry for each node; returns the range of nodes with weight.
    pub(crate) fn add_means(&self, stretch_mm: [f64; 2], weight: f64, sums: &mut [f64]) -> std::ops::Range<usize> {
        add_means(&self.along_mm, stretch_mm, weight, sums)
    }

    /// Tilt dh/ds of the worn profile at the nodes, s from root to tip, rad: over an element to either side, so that waves
    /// between neighbouring nodes do not count.
    pub fn tilt_rad(&self, depth_mm: &[f64]) -> Vec<f64> {
        (0..self.len())
            .map(|place| {
                let from = place.saturating_sub(NODES_TO_A_SIDE);
                let to = (place + NODES_TO_A_SIDE).min(self.len() - 1);
                (depth_mm[to] - depth_mm[from]) / (self.along_mm[to] - self.along_mm[from])
            })
            .collect()
    }

    /// Depth at a point of the flank, mm.
    pub(crate) fn depth_at_mm(&self, along_mm: f64, depth_mm: &[f64]) -> f64 {
        value_at(&self.along_mm, depth_mm, along_mm)
    }
}
