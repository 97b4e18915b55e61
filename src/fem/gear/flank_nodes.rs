//! The nodes of a working flank as places that wear: where they are along the profile, and how much of it each stands for.
//!
//! Wear is a depth h at every node, in straight lines between them: h(s) = Σ_k h_k N_k(s) with hat functions N_k over the length
//! s of the profile, beyond whose ends it goes on as at them. A volume V per face width on a stretch [a, b] wears the nodes by
//!
//! ```text
//! h_k ← h_k + m_k V / W_k          m_k = 1/(b − a) ∫ N_k ds over [a, b]          W_k = ∫ N_k ds over the flank
//! ```
//!
//! so that Σ W_k h_k grows by V, whatever the stretch; and the mean depth on the stretch is Σ m_k h_k.

use super::flank_surface::FlankSurface;

/// The part of an edge from a corner node that the corner's multiplier carries: ∫ψ of a quadratic edge is 1/6, 4/6 and 1/6 of it.
const CORNER_SHARE: f64 = 1.0 / 6.0;

/// Nodes to either side over which a slope is taken: those of an edge.
const NODES_TO_A_SIDE: usize = 2;

/// Nodes of one flank, from root to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankNodes {
    /// Distance of each from the root end along the profile, mm.
    pub along_mm: Vec<f64>,
    /// W_k, mm.
    pub share_mm: Vec<f64>,
    /// Place of each local node of the surface in this order.
    pub place: Vec<usize>,
    /// The stretch that the multiplier of each node loads, mm.
    pub loaded_mm: Vec<[f64; 2]>,
}

/// Consecutive nodes and the weight of each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights<'a> {
    /// The first node.
    pub first: usize,
    /// m_k of it and those after it.
    pub weights: &'a [f64],
}

impl FlankNodes {
    /// Of `flank`.
    pub fn new(flank: &FlankSurface) -> Self {
        let count = flank.from_tip_mm.len();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| flank.from_tip_mm[b].total_cmp(&flank.from_tip_mm[a]));
        let length_mm = order.first().map_or(0.0, |&root| flank.from_tip_mm[root]);
        let along_mm: Vec<f64> = order.iter().map(|&node| length_mm - flank.from_tip_mm[node]).collect();
        let mut place = vec![0; count];
        order.iter().enumerate().for_each(|(at, &node)| place[node] = at);
        let before = |k: usize| if k > 0 { along_mm[k] - along_mm[k - 1] } else { 0.0 };
        let after = |k: usize| if k + 1 < count { along_mm[k + 1] - along_mm[k] } else { 0.0 };
        let share_mm = (0..count).map(|k| 0.5 * (before(k) + after(k))).collect();
        let mut loaded_mm = along_mm.iter().map(|&at| [at, at]).collect::<Vec<_>>();
        for edge in &flank.surface.edges {
            // From the tip's side to the root's.
            let ends = [place[edge.nodes()[1]], place[edge.nodes()[0]]];
            let length = along_mm[ends[1]] - along_mm[ends[0]];
            let corner = if edge.nodes().len() == 3 { CORNER_SHARE } else { 0.5 } * length;
            loaded_mm[ends[0]][1] += corner;
            loaded_mm[ends[1]][0] -= corner;
            if let Some(&middle) = edge.nodes().get(2) {
                loaded_mm[place[middle]] = [along_mm[ends[0]] + corner, along_mm[ends[1]] - corner];
            }
        }
        Self { along_mm, share_mm, place, loaded_mm }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.along_mm.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.along_mm.is_empty()
    }

    /// Adds to `sums`, a row for all nodes, `weight` times the m_k of the stretch from `from_mm` to `to_mm`; answers the nodes that
    /// it reaches.
    pub fn add_means(&self, [from_mm, to_mm]: [f64; 2], weight: f64, sums: &mut [f64]) -> std::ops::Range<usize> {
        let last = self.len() - 1;
        let (low, high) = (self.along_mm[0], self.along_mm[last]);
        let interval = |at: f64| self.along_mm.partition_point(|&x| x <= at).clamp(1, last) - 1;
        let length = to_mm - from_mm;
        if length <= 1e-12 * (high - low) {
            let at = from_mm.clamp(low, high);
            let k = interval(at);
            let t = (at - self.along_mm[k]) / (self.along_mm[k + 1] - self.along_mm[k]);
            sums[k] += weight * (1.0 - t);
            sums[k + 1] += weight * t;
            return k..k + 2;
        }
        let per_length = weight / length;
        let (from, to) = (from_mm.clamp(low, high), to_mm.clamp(low, high));
        sums[0] += per_length * (low.min(to_mm) - from_mm.min(low));
        sums[last] += per_length * (to_mm.max(high) - high.max(from_mm));
        let first = interval(from);
        let mut k = first;
        while k < last && (self.along_mm[k] < to || k == first) {
            let (a, b) = (self.along_mm[k], self.along_mm[k + 1]);
            let (x0, x1) = (from.max(a), to.min(b));
            if x1 > x0 {
                let right = (0.5 * (x0 + x1) - a) / (b - a);
                sums[k] += per_length * (x1 - x0) * (1.0 - right);
                sums[k + 1] += per_length * (x1 - x0) * right;
            }
            k += 1;
        }
        let begin = if from_mm < low { 0 } else { first };
        let end = if to_mm > high { last } else { k.min(last) };
        begin..end + 1
    }

    /// How far depths at the nodes tilt the profile there, rad: dh/ds from root to tip, over an element to either side, so that waves
    /// between neighbouring nodes are no tilt.
    pub fn tilt_rad(&self, depth_mm: &[f64]) -> Vec<f64> {
        let slope = |place: usize| {
            let (from, to) = (place.saturating_sub(NODES_TO_A_SIDE), (place + NODES_TO_A_SIDE).min(self.len() - 1));
            (depth_mm[to] - depth_mm[from]) / (self.along_mm[to] - self.along_mm[from])
        };
        (0..self.len()).map(slope).collect()
    }

    /// Depth at a place of the flank, mm.
    pub fn depth_at_mm(&self, along_mm: f64, depth_mm: &[f64]) -> f64 {
        let k = self.along_mm.partition_point(|&x| x <= along_mm).clamp(1, self.len() - 1);
        let t = ((along_mm - self.along_mm[k - 1]) / (self.along_mm[k] - self.along_mm[k - 1])).clamp(0.0, 1.0);
        (1.0 - t) * depth_mm[k - 1] + t * depth_mm[k]
    }

    /// ∫ h ds of depths at the nodes, mm².
    pub fn integral_mm2(&self, depth_mm: &[f64]) -> f64 {
        self.share_mm.iter().zip(depth_mm).map(|(share, depth)| share * depth).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(along_mm: Vec<f64>) -> FlankNodes {
        let count = along_mm.len();
        let share = |k: usize| {
            let before = if k > 0 { along_mm[k] - along_mm[k - 1] } else { 0.0 };
            let after = if k + 1 < count { along_mm[k + 1] - along_mm[k] } else { 0.0 };
            0.5 * (before + after)
        };
        FlankNodes {
            share_mm: (0..count).map(share).collect(),
            place: (0..count).collect(),
            loaded_mm: along_mm.iter().map(|&at| [at, at]).collect(),
            along_mm,
        }
    }

    /// The mean of a linear depth over any stretch of the flank is the depth in its middle, weights add up to one, and only the
    /// nodes that are named have one.
    #[test]
    fn ver_means_of_linear_depths() {
        let nodes = nodes(vec![0.0, 0.3, 0.4, 0.9, 1.0, 1.7]);
        for (from, to) in [(0.0, 1.7), (0.05, 0.1), (0.2, 0.95), (0.4, 0.4), (1.6999, 1.7), (0.3, 0.9)] {
            let mut sums = vec![0.0; nodes.len()];
            let reached = nodes.add_means([from, to], 2.0, &mut sums);
            let total: f64 = sums.iter().sum();
            let mean: f64 = sums.iter().zip(&nodes.along_mm).map(|(m, at)| m * at).sum();
            assert!((total - 2.0).abs() < 1e-14 && (mean - (from + to)).abs() < 1e-14, "{from} {to} {sums:?}");
            assert!(sums.iter().enumerate().all(|(k, m)| *m == 0.0 || reached.contains(&k)), "{reached:?} {sums:?}");
        }
    }

    /// What would fall beyond an end falls on its node.
    #[test]
    fn ver_ends_keep_what_falls_beyond() {
        let nodes = nodes(vec![0.0, 0.5, 1.0]);
        for stretch in [[-0.4, 0.2], [0.9, 1.3], [-2.0, -1.0], [1.5, 2.0], [-1.0, 2.0]] {
            let mut sums = vec![0.0; 3];
            nodes.add_means(stretch, 1.0, &mut sums);
            assert!((sums.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{stretch:?} {sums:?}");
            assert!(sums.iter().all(|m| *m >= 0.0));
        }
    }
}
