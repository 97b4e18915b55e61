//! Wanted edge length inside a body, from the edges of its boundary.
//!
//! ```text
//! h(x) = min over boundary nodes b of  h_b + g |x − x_b|,   at most h_max
//! ```
//!
//! with h_b the mean length of the two edges that meet in b: the largest field that agrees with the boundary and grows
//! at most at the rate g (P.-O. Persson, *Mesh size functions for implicit geometries and PDE-based gradient limiting*,
//! Engineering with Computers 22 (2006), for a convex body the exact solution).
//!
//! Nodes that follow one another lie in a circle: none of them is nearer to a place than that is, and circles that are too far off are left out.

use nalgebra::Vector2;

use super::boundary_circles::{BoundaryCircle, circles};

/// Relative reserve for rounding errors in the distance of a circle.
const ROUND_OFF: f64 = 1e-9;

/// Field of wanted edge lengths.
#[derive(Debug, Clone)]
pub(super) struct SizeField {
    nodes: Vec<(Vector2<f64>, f64)>,
    /// Circles around nodes, with the least length there.
    circles: Vec<(BoundaryCircle, f64)>,
    growth: f64,
    greatest_mm: f64,
}

impl SizeField {
    /// Field of a closed boundary, its nodes in order.
    pub(super) fn of_boundary(ring: &[Vector2<f64>], growth: f64, greatest_mm: f64) -> Self {
        let n = ring.len();
        let edges: Vec<f64> = (0..n).map(|k| (ring[(k + 1) % n] - ring[k]).norm()).collect();
        let nodes: Vec<(Vector2<f64>, f64)> =
            (0..n).map(|k| (ring[k], 0.5 * (edges[k] + edges[(k + n - 1) % n]))).collect();
        let with_least = circles(ring).into_iter().map(|circle| {
            let lengths = nodes[circle.nodes.clone()].iter().map(|(_, length)| *length);
            (circle, lengths.fold(f64::INFINITY, f64::min))
        });
        let circles = with_least.collect();
        Self { nodes, circles, growth, greatest_mm }
    }

    /// h at `point`, mm.
    pub(super) fn at_mm(&self, point: Vector2<f64>) -> f64 {
        let bounds = || self.circles.iter().map(|(circle, least)| (self.bound_mm((circle, *least), point), circle));
        let Some((_, first)) = bounds().min_by(|(a, _), (b, _)| a.total_cmp(b)) else { return self.greatest_mm };
        let nearest = self.least_mm(first, point, self.greatest_mm);
        bounds().fold(
            nearest,
            |least, (bound, circle)| {
                if bound > least { least } else { self.least_mm(circle, point, least) }
            },
        )
    }

    /// No node of a circle with the least length `least_mm` makes h at `point` less than this, mm.
    fn bound_mm(&self, (circle, least_mm): (&BoundaryCircle, f64), point: Vector2<f64>) -> f64 {
        least_mm + self.growth * circle.distance(point) - ROUND_OFF * self.greatest_mm
    }

    /// h at `point` by the nodes of a circle, at most `most_mm`.
    fn least_mm(&self, circle: &BoundaryCircle, point: Vector2<f64>, most_mm: f64) -> f64 {
        let nodes = self.nodes[circle.nodes.clone()].iter();
        nodes.fold(most_mm, |least, (node, length)| least.min(length + self.growth * (point - node).norm()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What circles leave out changes no bit: near the boundary and far from it, with short edges beside long ones.
    #[test]
    fn ver_circles_leave_nothing_out() {
        let ring: Vec<Vector2<f64>> = (0..500)
            .map(|k| {
                let turn = std::f64::consts::TAU * (f64::from(k) / 500.0).powi(3);
                Vector2::new(3.0 * turn.cos(), (1.0 + 0.3 * (7.0 * turn).sin()) * turn.sin())
            })
            .collect();
        let field = SizeField::of_boundary(&ring, 0.3, 1.0);
        for k in 0..2000 {
            let turn = 0.7 * f64::from(k);
            let point = 1.7e-3 * f64::from(k) * Vector2::new(turn.cos(), turn.sin());
            let at_all = |least: f64, (node, length): &(Vector2<f64>, f64)| {
                least.min(length + field.growth * (point - node).norm())
            };
            assert_eq!(field.at_mm(point), field.nodes.iter().fold(1.0, at_all), "{point}");
        }
    }
}
