//! Circles around stretches of a closed boundary, by which what is far from a place is left out.

use std::ops::Range;

use nalgebra::Vector2;

/// Nodes in a circle.
const NODES: usize = 16;

/// Circle around nodes of a boundary that follow one another, and around the edges from each to the next.
#[derive(Debug, Clone)]
pub(super) struct BoundaryCircle {
    /// Numbers of the nodes.
    pub nodes: Range<usize>,
    centre: Vector2<f64>,
    radius: f64,
}

impl BoundaryCircle {
    /// Distance of `point` from the circle, negative within it.
    pub(super) fn distance(&self, point: Vector2<f64>) -> f64 {
        (point - self.centre).norm() - self.radius
    }
}

/// Circles around all nodes of the closed boundary through `ring`.
pub(super) fn circles(ring: &[Vector2<f64>]) -> Vec<BoundaryCircle> {
    let starts = (0..ring.len()).step_by(NODES);
    let of_nodes = starts.map(|start| {
        let nodes = start..(start + NODES).min(ring.len());
        // The last edge ends at the first node of the next circle.
        let points = || nodes.clone().chain([nodes.end % ring.len()]).map(|node| ring[node]);
        let centre = points().sum::<Vector2<f64>>() / (nodes.len() + 1) as f64;
        let radius = points().map(|point| (point - centre).norm()).fold(0.0, f64::max);
        BoundaryCircle { nodes, centre, radius }
    });
    of_nodes.collect()
}
