//! Shape functions of the plane elements on their reference cells.
//!
//! Triangles live on {ξ ≥ 0, η ≥ 0, ξ + η ≤ 1}, quadrilaterals on [−1, 1]². Nodes are the corners anticlockwise, then the
//! middles of the sides in the same order, then the middle of the cell. At a point of the reference cell
//!
//! ```text
//! x(ξ, η) = Σ Nₐ(ξ, η) xₐ        J = ∂x/∂ξ        ∇Nₐ = J⁻ᵀ ∂Nₐ/∂ξ
//! ```
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005),
//! sections 4.6 (serendipity) and 4.7 to 4.8 (Lagrange, triangles).

use nalgebra::{Matrix2, Vector2};

use super::solid::ElementKind;

/// Greatest number of nodes of an element.
pub(crate) const MOST_NODES: usize = 9;

/// Shape functions and their derivatives at one point of the reference cell; entries beyond the element's nodes are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Values Nₐ.
    pub values: [f64; MOST_NODES],
    /// Derivatives ∂Nₐ/∂ξ and ∂Nₐ/∂η.
    pub slopes: [[f64; 2]; MOST_NODES],
}

/// Nodes of the quadrilaterals on the reference cell.
const QUAD_NODES: [[f64; 2]; 9] =
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 0.0]];

/// Nodes of the triangles on the reference cell.
const TRIANGLE_NODES: [[f64; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

/// Coordinates of the nodes of an element on its reference cell.
pub(crate) fn reference_nodes(kind: ElementKind) -> &'static [[f64; 2]] {
    match kind {
        ElementKind::Triangle3 => &TRIANGLE_NODES[..3],
        ElementKind::Triangle6 => &TRIANGLE_NODES,
        ElementKind::Quad4 => &QUAD_NODES[..4],
        ElementKind::Quad8 => &QUAD_NODES[..8],
        ElementKind::Quad9 => &QUAD_NODES,
    }
}

impl Shape {
    /// Shape functions of an element at (ξ, η).
    pub fn at(kind: ElementKind, [xi, eta]: [f64; 2]) -> Self {
        let mut shape = Self { values: [0.0; MOST_NODES], slopes: [[0.0; 2]; MOST_NODES] };
        match kind {
            ElementKind::Triangle3 => shape.linear_triangle(xi, eta),
            ElementKind::Triangle6 => shape.quadratic_triangle(xi, eta),
            ElementKind::Quad4 => shape.bilinear(xi, eta),
            ElementKind::Quad8 => shape.serendipity(xi, eta),
            ElementKind::Quad9 => shape.biquadratic(xi, eta),
        }
        shape
    }

    fn linear_triangle(&mut self, xi: f64, eta: f64) {
        self.set(0, 1.0 - xi - eta, [-1.0, -1.0]);
        self.set(1, xi, [1.0, 0.0]);
        self.set(2, eta, [0.0, 1.0]);
    }

    /// Corners L(2L − 1), sides 4 L L', with the area coordinates L.
    fn quadratic_triangle(&mut self, xi: f64, eta: f64) {
        let area = [1.0 - xi - eta, xi, eta];
        let slope = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
        for a in 0..3 {
            let b = (a + 1) % 3;
            let rise = 4.0 * area[a] - 1.0;
            self.set(a, area[a] * (2.0 * area[a] - 1.0), slope[a].map(|d| rise * d));
            self.set(
                3 + a,
                4.0 * area[a] * area[b],
                [0, 1].map(|i| 4.0 * (area[a] * slope[b][i] + area[b] * slope[a][i])),
            );
        }
    }

    fn bilinear(&mut self, xi: f64, eta: f64) {
        for (a, [x, y]) in QUAD_NODES[..4].iter().enumerate() {
            let (f, g) = (1.0 + x * xi, 1.0 + y * eta);
            self.set(a, 0.25 * f * g, [0.25 * x * g, 0.25 * y * f]);
        }
    }

    /// Corners (1 + ξξₐ)(1 + ηηₐ)(ξξₐ + ηηₐ − 1)/4, sides (1 − ξ²)(1 + ηηₐ)/2 and (1 + ξξₐ)(1 − η²)/2.
    fn serendipity(&mut self, xi: f64, eta: f64) {
        for (a, [x, y]) in QUAD_NODES[..4].iter().enumerate() {
            let (f, g, h) = (1.0 + x * xi, 1.0 + y * eta, x * xi + y * eta - 1.0);
            self.set(a, 0.25 * f * g * h, [0.25 * x * g * (h + f), 0.25 * y * f * (h + g)]);
        }
        for (a, [x, y]) in QUAD_NODES.iter().enumerate().take(8).skip(4) {
            if *x == 0.0 {
                let (f, g) = (1.0 - xi * xi, 1.0 + y * eta);
                self.set(a, 0.5 * f * g, [-xi * g, 0.5 * y * f]);
            } else {
                let (f, g) = (1.0 + x * xi, 1.0 - eta * eta);
                self.set(a, 0.5 * f * g, [0.5 * x * g, -eta * f]);
            }
        }
    }

    fn biquadratic(&mut self, xi: f64, eta: f64) {
        for (a, [x, y]) in QUAD_NODES.iter().enumerate() {
            let ((f, df), (g, dg)) = (quadratic(*x, xi), quadratic(*y, eta));
            self.set(a, f * g, [df * g, f * dg]);
        }
    }

    fn set(&mut self, node: usize, value: f64, slope: [f64; 2]) {
        self.values[node] = value;
        self.slopes[node] = slope;
    }

    /// Point x = Σ Nₐ xₐ.
    pub fn point(&self, corners_mm: &[Vector2<f64>]) -> Vector2<f64> {
        corners_mm.iter().zip(&self.values).map(|(x, n)| x * *n).sum()
    }

    /// Jacobian J_ik = ∂x_i/∂ξ_k.
    pub fn jacobian(&self, nodes_mm: &[Vector2<f64>]) -> Matrix2<f64> {
        let mut j = [[0.0; 2]; 2];
        for (x, d) in nodes_mm.iter().zip(&self.slopes) {
            j[0][0] += x.x * d[0];
            j[0][1] += x.x * d[1];
            j[1][0] += x.y * d[0];
            j[1][1] += x.y * d[1];
        }
        Matrix2::new(j[0][0], j[0][1], j[1][0], j[1][1])
    }

    /// Gradients ∇Nₐ, 1/mm, and the determinant of J, mm²; the gradients are valid where it is positive.
    pub fn gradients(&self, nodes_mm: &[Vector2<f64>]) -> ([[f64; 2]; MOST_NODES], f64) {
        let j = self.jacobian(nodes_mm);
        let determinant = j.m11 * j.m22 - j.m12 * j.m21;
        let inverse = 1.0 / determinant;
        let gradients = self.slopes.map(|[r, s]| {
            // J⁻ᵀ [r, s]
            [(j.m22 * r - j.m21 * s) * inverse, (j.m11 * s - j.m12 * r) * inverse]
        });
        (gradients, determinant)
    }
}

/// Quadratic Lagrange polynomial of the node at −1, 0 or 1, and its derivative.
fn quadratic(node: f64, x: f64) -> (f64, f64) {
    if node == 0.0 { (1.0 - x * x, -2.0 * x) } else { (0.5 * x * (x + node), x + 0.5 * node) }
}

/// Shape functions of the ends and, on a quadratic edge, of the middle at s from −1 to 1, and their derivatives d/ds.
pub fn along_edge(quadratic_edge: bool, s: f64) -> ([f64; 3], [f64; 3]) {
    if quadratic_edge {
        ([0.5 * s * (s - 1.0), 0.5 * s * (s + 1.0), 1.0 - s * s], [s - 0.5, s + 0.5, -2.0 * s])
    } else {
        ([0.5 * (1.0 - s), 0.5 * (1.0 + s), 0.0], [-0.5, 0.5, 0.0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [ElementKind; 5] =
        [ElementKind::Triangle3, ElementKind::Triangle6, ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9];

    #[test]
    fn ver_shape_functions_are_one_at_their_node_and_sum_to_one() {
        for kind in KINDS {
            for (a, at) in reference_nodes(kind).iter().enumerate() {
                let shape = Shape::at(kind, *at);
                for (b, value) in shape.values.iter().enumerate() {
                    assert_eq!(*value, f64::from(u8::from(a == b)), "{kind:?} {a} {b}");
                }
            }
            let shape = Shape::at(kind, [0.21, 0.34]);
            assert!((shape.values.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{kind:?}");
        }
    }

    /// Central differences of quadratics and of their products are exact up to h², here 1e-10.
    #[test]
    fn ver_slopes_are_the_derivatives_of_the_values() {
        const H: f64 = 1e-5;
        for kind in KINDS {
            let at = [0.21, 0.34];
            let slopes = Shape::at(kind, at).slopes;
            for i in 0..2 {
                let (mut ahead, mut behind) = (at, at);
                ahead[i] += H;
                behind[i] -= H;
                let (ahead, behind) = (Shape::at(kind, ahead), Shape::at(kind, behind));
                for (a, slope) in slopes.iter().enumerate() {
                    let difference = (ahead.values[a] - behind.values[a]) / (2.0 * H);
                    assert!((difference - slope[i]).abs() < 1e-9, "{kind:?} {a} {i}");
                }
            }
        }
    }
}
