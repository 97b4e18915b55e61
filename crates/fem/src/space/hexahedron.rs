//! Hexahedra of eight and of twenty nodes on the reference cell [−1, 1]³, with the nodes in the order of VTK:
//!
//! ```text
//! eight     (1 + ξξₐ)(1 + ηηₐ)(1 + ζζₐ)/8
//! twenty    corners   (1 + ξξₐ)(1 + ηηₐ)(1 + ζζₐ)(ξξₐ + ηηₐ + ζζₐ − 2)/8
//!           ξₐ = 0    (1 − ξ²)(1 + ηηₐ)(1 + ζζₐ)/4, and likewise for η and ζ
//! ```
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005), section 4.10.

use std::sync::LazyLock;

use nalgebra::{Matrix3, Vector3};

use crate::quadrature::{GAUSS_2, GAUSS_3};
use gearwear_mesh::CellKind;

/// Greatest number of nodes of an element.
pub(crate) const MOST_NODES: usize = 20;

/// Kind of hexahedron by its number of nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HexahedronKind {
    /// Trilinear, with nodes at the corners.
    Eight,
    /// Quadratic (serendipity), with nodes at the corners and middles of the edges.
    Twenty,
}

/// Coordinates of the nodes on the reference cell, corners first.
const REFERENCE_NODES: [[f64; 3]; MOST_NODES] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
];

/// Corners of the faces, anticlockwise from outside.
const FACES: [[usize; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

/// Ends of the edges, in the order of the middle nodes.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

impl HexahedronKind {
    /// Kind of hexahedron of a kind of cell; `None` for other cells.
    pub fn of_cell(kind: CellKind) -> Option<Self> {
        match kind {
            CellKind::Hexahedron => Some(Self::Eight),
            CellKind::Hexahedron20 => Some(Self::Twenty),
            _ => None,
        }
    }

    /// Kind of cell in a mesh.
    pub fn cell_kind(self) -> CellKind {
        match self {
            Self::Eight => CellKind::Hexahedron,
            Self::Twenty => CellKind::Hexahedron20,
        }
    }

    /// Kind of hexahedron with `count` nodes.
    ///
    /// # Panics
    /// For any other number than 8 and 20.
    pub(crate) fn with_nodes(count: usize) -> Self {
        match count {
            8 => Self::Eight,
            20 => Self::Twenty,
            _ => panic!("no hexahedron has {count} nodes"),
        }
    }

    /// Coordinates of the nodes on the reference cell.
    pub fn reference_nodes(self) -> &'static [[f64; 3]] {
        &REFERENCE_NODES[..self.cell_kind().node_count()]
    }

    /// Gauss–Legendre points for the stiffness: 2 × 2 × 2 or 3 × 3 × 3.
    pub fn rule(self) -> &'static [HexahedronPoint] {
        static EIGHT: LazyLock<Vec<HexahedronPoint>> = LazyLock::new(|| product(HexahedronKind::Eight, &GAUSS_2));
        static TWENTY: LazyLock<Vec<HexahedronPoint>> = LazyLock::new(|| product(HexahedronKind::Twenty, &GAUSS_3));
        match self {
            Self::Eight => &EIGHT,
            Self::Twenty => &TWENTY,
        }
    }
}

/// Corners of the faces of an element, anticlockwise from outside.
pub fn faces(nodes: &[u32]) -> [[u32; 4]; 6] {
    FACES.map(|face| face.map(|corner| nodes[corner]))
}

/// Ends of the edges of an element and, of twenty nodes, the middle nodes.
pub fn edges(nodes: &[u32]) -> impl Iterator<Item = ([u32; 2], Option<u32>)> {
    (8..).zip(EDGES).map(|(middle, ends)| (ends.map(|end| nodes[end]), nodes.get(middle).copied()))
}

/// Whether the determinant of the Jacobian is positive at the nodes and at the integration points.
pub fn is_sound(nodes_mm: &[Vector3<f64>]) -> bool {
    let kind = HexahedronKind::with_nodes(nodes_mm.len());
    let at_nodes = kind.reference_nodes().iter().map(|at| HexahedronShape::at(kind, *at));
    at_nodes
        .chain(kind.rule().iter().map(|point| point.shape))
        .all(|shape| shape.jacobian(nodes_mm).determinant() > 0.0)
}

/// Integration point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HexahedronPoint {
    /// Coordinates (ξ, η, ζ).
    pub at: [f64; 3],
    /// Weight; the weights add up to 8.
    pub weight: f64,
    /// Shape functions at the point.
    pub shape: HexahedronShape,
}

/// Integration points at all combinations of the abscissae `line`, ξ fastest.
fn product(kind: HexahedronKind, line: &[(f64, f64)]) -> Vec<HexahedronPoint> {
    let mut points = Vec::with_capacity(line.len().pow(3));
    for (z, h) in line {
        for (y, g) in line {
            for (x, f) in line {
                let at = [*x, *y, *z];
                points.push(HexahedronPoint { at, weight: f * g * h, shape: HexahedronShape::at(kind, at) });
            }
        }
    }
    points
}

/// Shape functions and their derivatives at a point of the reference cell; entries beyond the element's nodes are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HexahedronShape {
    /// Values Nₐ.
    pub values: [f64; MOST_NODES],
    /// Derivatives ∂Nₐ/∂ξ, ∂Nₐ/∂η, ∂Nₐ/∂ζ.
    pub slopes: [[f64; 3]; MOST_NODES],
}

impl HexahedronShape {
    /// Shape functions of an element at (ξ, η, ζ).
    pub fn at(kind: HexahedronKind, at: [f64; 3]) -> Self {
        let mut shape = Self { values: [0.0; MOST_NODES], slopes: [[0.0; 3]; MOST_NODES] };
        for (a, node) in kind.reference_nodes().iter().enumerate() {
            // Factor and slope along each direction: 1 + xxₐ, or 1 − x² for a middle node.
            let factor = [0, 1, 2].map(|k| {
                let (x, n) = (at[k], node[k]);
                if n == 0.0 { (1.0 - x * x, -2.0 * x) } else { (1.0 + x * n, n) }
            });
            let [(f, df), (g, dg), (h, dh)] = factor;
            let product = f * g * h;
            let slopes = [df * g * h, f * dg * h, f * g * dh];
            (shape.values[a], shape.slopes[a]) = match kind {
                HexahedronKind::Twenty if a < 8 => {
                    let sum = at.iter().zip(node).map(|(x, n)| x * n).sum::<f64>() - 2.0;
                    (0.125 * product * sum, [0, 1, 2].map(|k| 0.125 * (slopes[k] * sum + product * node[k])))
                }
                HexahedronKind::Twenty => (0.25 * product, slopes.map(|slope| 0.25 * slope)),
                HexahedronKind::Eight => (0.125 * product, slopes.map(|slope| 0.125 * slope)),
            };
        }
        shape
    }

    /// Point x = Σ Nₐ xₐ.
    pub fn point(&self, nodes_mm: &[Vector3<f64>]) -> Vector3<f64> {
        nodes_mm.iter().zip(&self.values).map(|(x, n)| x * *n).sum()
    }

    /// Jacobian J_ik = ∂x_i/∂ξ_k.
    pub fn jacobian(&self, nodes_mm: &[Vector3<f64>]) -> Matrix3<f64> {
        nodes_mm.iter().zip(&self.slopes).map(|(x, slope)| x * Vector3::from(*slope).transpose()).sum()
    }

    /// Gradients ∇Nₐ, 1/mm, and the determinant of J, mm³; the gradients are valid where it is positive.
    pub fn gradients(&self, nodes_mm: &[Vector3<f64>]) -> ([Vector3<f64>; MOST_NODES], f64) {
        let jacobian = self.jacobian(nodes_mm);
        let determinant = jacobian.determinant();
        let inverse = jacobian.try_inverse().unwrap_or_default().transpose();
        (self.slopes.map(|slope| inverse * Vector3::from(slope)), determinant)
    }
}
