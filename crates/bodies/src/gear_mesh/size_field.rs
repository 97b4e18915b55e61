//! Wanted edge length inside a body, from the edges of its boundary.
//!
//! ```text
//! h(x) = min over boundary nodes b of  h_b + g |x − x_b|,   at most h_max
//! ```
//!
//! with h_b the mean length of the two edges that meet in b: the largest field that agrees with the boundary and grows
//! at most at the rate g (P.-O. Persson, *Mesh size functions for implicit geometries and PDE-based gradient limiting*,
//! Engineering with Computers 22 (2006), for a convex body the exact solution).

use nalgebra::Vector2;

/// Field of wanted edge lengths.
#[derive(Debug, Clone)]
pub(super) struct SizeField {
    nodes: Vec<(Vector2<f64>, f64)>,
    growth: f64,
    greatest_mm: f64,
}

impl SizeField {
    /// Field of a closed boundary, its nodes in order.
    pub(super) fn of_boundary(ring: &[Vector2<f64>], growth: f64, greatest_mm: f64) -> Self {
        let n = ring.len();
        let edges: Vec<f64> = (0..n).map(|k| (ring[(k + 1) % n] - ring[k]).norm()).collect();
        let nodes = (0..n).map(|k| (ring[k], 0.5 * (edges[k] + edges[(k + n - 1) % n]))).collect();
        Self { nodes, growth, greatest_mm }
    }

    /// h at `point`, mm.
    pub(super) fn at_mm(&self, point: Vector2<f64>) -> f64 {
        self.nodes
            .iter()
            .fold(self.greatest_mm, |least, (node, length)| least.min(length + self.growth * (point - node).norm()))
    }
}
