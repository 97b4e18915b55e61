//! Working flank of a meshed tooth as a contact surface, with a coordinate along the profile.

use std::ops::Range;

use gearwear_fem::contact::surface::Surface;
use gearwear_fem::problem::Edge;
use nalgebra::Vector2;

/// Flank of one tooth in the tooth's own frame, from the tip (first edge) to the root (last edge).
#[derive(Debug, Clone)]
pub struct MeshedFlank {
    /// Contact surface; its local node numbers are those of the candidates.
    pub surface: Surface,
    /// Distance of each local node from the tip end along the profile, mm.
    pub from_tip_mm: Vec<f64>,
    /// ρ of each local node, mm; NaN on a tip rounding.
    pub rho_mm: Vec<f64>,
    /// Whether the tip end is a sharp edge.
    pub sharp: bool,
}

impl MeshedFlank {
    /// Flank along `chain` (ends and middles of edges alternately, from root to tip) with ρ at each of its nodes.
    pub fn new(chain: &[u32], rho_mm: &[f64], points_mm: &[Vector2<f64>], sharp: bool) -> Self {
        let surface = Surface::new(&edges(chain), points_mm);
        let places = surface.mesh_nodes.iter().map(|node| chain.iter().position(|other| other == node));
        let rho_mm = places.map(|place| place.map_or(f64::NAN, |place| rho_mm[place])).collect();
        let path: Vec<usize> = surface.paths().into_iter().next().unwrap_or_default();
        let along = surface.along_mm(&path);
        let mut from_tip_mm = vec![0.0; surface.points_mm.len()];
        for (&node, along) in path.iter().zip(along) {
            from_tip_mm[node] = along;
        }
        Self { surface, from_tip_mm, rho_mm, sharp }
    }

    /// Local number of the node at the tip end.
    pub fn tip_node(&self) -> usize {
        self.surface.edges.first().map_or(0, |edge| edge.nodes()[0])
    }

    /// Local number of the node at the root end.
    pub fn root_node(&self) -> usize {
        self.surface.edges.last().map_or(0, |edge| edge.nodes()[1])
    }

    /// Greatest distance of neighbouring nodes of the involute from `rho_mm` outwards, mm: below the active profile elements are larger.
    pub(crate) fn farthest_nodes_mm(&self, rho_mm: f64) -> f64 {
        let nodes = || self.tip_to_root().filter(|&node| self.rho_mm[node] >= rho_mm);
        let apart_mm = nodes().zip(nodes().skip(1)).map(|(one, next)| self.from_tip_mm[next] - self.from_tip_mm[one]);
        apart_mm.fold(0.0, f64::max)
    }

    /// Local numbers of the nodes from tip to root.
    pub(crate) fn tip_to_root(&self) -> impl Iterator<Item = usize> {
        let before_ends = self.surface.edges.iter().flat_map(|edge| {
            let nodes = edge.nodes();
            std::iter::once(nodes[0]).chain(nodes.get(2).copied())
        });
        before_ends.chain(std::iter::once(self.root_node()))
    }

    /// Distance from the tip end of the point with radius of curvature `rho_mm`, within the surface, mm.
    pub(crate) fn distance_to_tip_mm(&self, rho_mm: f64) -> f64 {
        let mut nearest = (f64::INFINITY, 0.0);
        for (&own, &along) in self.rho_mm.iter().zip(&self.from_tip_mm) {
            // NaN on a rounding is never nearer.
            if (own - rho_mm).abs() < nearest.0 {
                nearest = ((own - rho_mm).abs(), along);
            }
        }
        nearest.1
    }

    /// Edges that overlap the stretch from `from_mm` to `to_mm` from the tip end; at least one.
    pub(crate) fn edges_between(&self, from_mm: f64, to_mm: f64) -> Range<usize> {
        let edges = &self.surface.edges;
        let first = edges.partition_point(|edge| self.from_tip_mm[edge.nodes()[1]] <= from_mm);
        let last = edges.partition_point(|edge| self.from_tip_mm[edge.nodes()[0]] < to_mm);
        let first = first.min(edges.len().saturating_sub(1));
        first..last.max(first + 1).min(edges.len())
    }
}

/// Edges from tip to root along `chain` (from root to tip); the tooth of a flank at x < 0 lies on their left.
pub(crate) fn edges(chain: &[u32]) -> Vec<Edge> {
    (0..chain.len() / 2)
        .rev()
        .map(|k| Edge { ends: [chain[2 * k + 2], chain[2 * k]], middle: Some(chain[2 * k + 1]) })
        .collect()
}
