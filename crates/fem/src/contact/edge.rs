//! Linear and quadratic edges of a surface, with nodes at ξ = −1, 1 and, in the middle, 0.

use nalgebra::Vector2;

use crate::problem::Edge;
use crate::shape::along_edge;

/// Greatest number of nodes of an edge.
pub(crate) const MOST_NODES: usize = 3;

impl Edge {
    /// Number of nodes, 2 or 3.
    pub fn node_count(&self) -> usize {
        if self.middle.is_some() { 3 } else { 2 }
    }

    /// Nodes: ends, middle.
    pub fn nodes(&self) -> impl Iterator<Item = u32> {
        self.ends.into_iter().chain(self.middle)
    }
}

/// Shape functions at ξ; unused entries are zero.
pub(crate) fn shape(nodes: usize, xi: f64) -> [f64; MOST_NODES] {
    along_edge(nodes == 3, xi).0
}

/// Derivatives of the shape functions by ξ.
pub(crate) fn shape_derivative(nodes: usize, xi: f64) -> [f64; MOST_NODES] {
    along_edge(nodes == 3, xi).1
}

/// Coordinate ξ of a node.
pub(crate) fn node_place(local: usize) -> f64 {
    [-1.0, 1.0, 0.0][local]
}

/// Sum Σ N_i v_i.
pub(crate) fn interpolate(shape: &[f64; MOST_NODES], values: &[Vector2<f64>]) -> Vector2<f64> {
    values.iter().zip(shape).fold(Vector2::zeros(), |sum, (value, n)| sum + value * *n)
}

/// Outward normal of a tangent with the body on its left, by a quarter turn clockwise.
pub(crate) fn outward(tangent: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(tangent.y, -tangent.x)
}
