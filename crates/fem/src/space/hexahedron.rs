//! The hexahedra of eight and of twenty nodes on the reference cell [−1, 1]³, with the nodes in the order of VTK:
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

/// Most nodes that an element has.
pub(crate) const MOST_NODES: usize = 20;

/// A hexahedron by its nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HexahedronKind {
    /// Trilinear: the corners.
    Eight,
    /// Quadratic (serendipity): the corners and the middles of the edges.
    Twenty,
}

/// Where the nodes lie on the reference cell; those of the element of eight come first.
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

/// Ends of the edges, in the order of the middles of the element of twenty nodes.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

impl HexahedronKind {
    /// The element of a kind of cell, where it is one.
    pub fn of_cell(kind: CellKind) -> Option<Self> {
        match kind {
            CellKind::Hexahedron => Some(Self::Eight),
            CellKind::Hexahedron20 => Some(Self::Twenty),
            _ => None,
        }
    }

    /// The kind of cell that such an element is in a mesh.
    pub fn cell_kind(self) -> CellKind {
        match self {
            Self::Eight => CellKind::Hexahedron,
            Self::Twenty => CellKind::Hexahedron20,
        }
    }

    /// The element with so many nodes.
    ///
    /// # Panics
    /// Where there is none.
    pub(crate) fn with_nodes(count: usize) -> Self {
        match count {
            8 => Self::Eight,
            20 => Self::Twenty,
            _ => panic!("no hexahedron has {count} nodes"),
        }
    }

    /// Where its nodes lie on the reference cell.
    pub fn reference_nodes(self) -> &'static [[f64; 3]] {
        &REFERENCE_NODES[..self.cell_kind().node_count()]
    }

    /// Points of Gauss and Legendre that integrate its stiffness: 2 × 2 × 2, or 3 × 3 × 3.
    pub fn rule(self) -> &'static [IntegrationPoint] {
        static EIGHT: LazyLock<Vec<IntegrationPoint>> = LazyLock::new(|| product(HexahedronKind::Eight, &GAUSS_2));
        static TWENTY: LazyLock<Vec<IntegrationPoint>> = LazyLock::new(|| product(HexahedronKind::Twenty, &GAUSS_3));
        match self {
            Self::Eight => &EIGHT,
            Self::Twenty => &TWENTY,
        }
    }
}

/// The faces of an element by their corners, anticlockwise from outside.
pub fn faces(nodes: &[u32]) -> [[u32; 4]; 6] {
    FACES.map(|face| face.map(|corner| nodes[corner]))
}

/// The edges of an element: the ends, and the middle of those of the element of twenty nodes.
pub fn edges(nodes: &[u32]) -> impl Iterator<Item = ([u32; 2], Option<u32>)> {
    (8..).zip(EDGES).map(|(middle, ends)| (ends.map(|end| nodes[end]), nodes.get(middle).copied()))
}

/// Whether the determinant of the Jacobian is positive at the nodes and at the points of integration.
pub fn is_sound(nodes_mm: &[Vector3<f64>]) -> bool {
    let kind = HexahedronKind::with_nodes(nodes_mm.len());
    let at_nodes = kind.reference_nodes().iter().map(|at| Shape::at(kind, *at));
    at_nodes
        .chain(kind.rule().iter().map(|point| point.shape))
        .all(|shape| shape.jacobian(nodes_mm).determinant() > 0.0)
}

/// A point of integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegrationPoint {
    /// (ξ, η, ζ).
    pub at: [f64; 3],
    /// Its weight; the weights add up to 8.
    pub weight: f64,
    /// Shape functions there.
    pub shape: Shape,
}

fn product(kind: HexahedronKind, line: &[(f64, f64)]) -> Vec<IntegrationPoint> {
    let each = || line.iter();
    each()
        .flat_map(|z| each().flat_map(move |y| each().map(move |x| (x, y, z))))
        .map(|((x, f), (y, g), (z, h))| {
            let at = [*x, *y, *z];
            IntegrationPoint { at, weight: f * g * h, shape: Shape::at(kind, at) }
        })
        .collect()
}

/// Shape functions and their derivatives at a point of the reference cell; entries beyond the element's nodes are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Nₐ.
    pub values: [f64; MOST_NODES],
    /// ∂Nₐ/∂ξ, ∂Nₐ/∂η, ∂Nₐ/∂ζ.
    pub slopes: [[f64; 3]; MOST_NODES],
}

impl Shape {
    /// Of an element at (ξ, η, ζ).
    pub fn at(kind: HexahedronKind, at: [f64; 3]) -> Self {
        let mut shape = Self { values: [0.0; MOST_NODES], slopes: [[0.0; 3]; MOST_NODES] };
        for (a, node) in kind.reference_nodes().iter().enumerate() {
            // Along each direction a factor and its slope: 1 + xxₐ, or 1 − x² where the node is in the middle.
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

    /// x = Σ Nₐ xₐ.
    pub fn point(&self, nodes_mm: &[Vector3<f64>]) -> Vector3<f64> {
        nodes_mm.iter().zip(&self.values).map(|(x, n)| x * *n).sum()
    }

    /// J with J_ik = ∂x_i/∂ξ_k.
    pub fn jacobian(&self, nodes_mm: &[Vector3<f64>]) -> Matrix3<f64> {
        nodes_mm.iter().zip(&self.slopes).map(|(x, slope)| x * Vector3::from(*slope).transpose()).sum()
    }

    /// ∇Nₐ, 1/mm, and the determinant of the Jacobian, mm³; gradients are of use only where that is positive.
    pub fn gradients(&self, nodes_mm: &[Vector3<f64>]) -> ([Vector3<f64>; MOST_NODES], f64) {
        let jacobian = self.jacobian(nodes_mm);
        let determinant = jacobian.determinant();
        let inverse = jacobian.try_inverse().unwrap_or_default().transpose();
        (self.slopes.map(|slope| inverse * Vector3::from(slope)), determinant)
    }
}
