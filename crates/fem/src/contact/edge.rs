//! Shape functions of a surface edge, linear or quadratic, over ξ from −1 to 1.
//!
//! ```text
//! linear      N = (1 − ξ)/2, (1 + ξ)/2
//! quadratic   N = ξ(ξ − 1)/2, ξ(ξ + 1)/2, 1 − ξ²          ends, middle
//! ```

use nalgebra::Vector2;

use crate::problem::Edge;

/// Greatest number of nodes of an edge.
pub(crate) const MOST_NODES: usize = 3;

impl Edge {
    /// Number of its nodes: 2 or 3.
    pub fn node_count(&self) -> usize {
        if self.middle.is_some() { 3 } else { 2 }
    }

    /// Its nodes: ends, middle.
    pub fn nodes(&self) -> impl Iterator<Item = u32> {
        self.ends.into_iter().chain(self.middle)
    }
}

/// Shape functions at ξ; unused places are zero.
pub(crate) fn shape(nodes: usize, xi: f64) -> [f64; MOST_NODES] {
    match nodes {
        2 => [0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0],
        _ => [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi],
    }
}

/// Their derivatives by ξ.
pub(crate) fn shape_derivative(nodes: usize, xi: f64) -> [f64; MOST_NODES] {
    match nodes {
        2 => [-0.5, 0.5, 0.0],
        _ => [xi - 0.5, xi + 0.5, -2.0 * xi],
    }
}

/// ξ of each node.
pub(crate) fn node_place(local: usize) -> f64 {
    [-1.0, 1.0, 0.0][local]
}

/// Σ N_i v_i.
pub(crate) fn interpolate(shape: &[f64; MOST_NODES], values: &[Vector2<f64>]) -> Vector2<f64> {
    values.iter().zip(shape).fold(Vector2::zeros(), |sum, (value, n)| sum + value * *n)
}

/// Quarter turn clockwise: from a tangent with the body on its left to the outward normal.
pub(crate) fn outward(tangent: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(tangent.y, -tangent.x)
}
