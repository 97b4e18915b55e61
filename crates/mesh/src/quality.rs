//! Shape quality of the plane cells of a mesh.
//!
//! The map x(ξ, η) = Σ N_k(ξ, η) x_k of a cell has the Jacobian determinant J = det ∂x/∂(ξ, η). From J and the tangents
//! ∂x/∂ξ, ∂x/∂η at the corners and at the integration points follow
//!
//! ```text
//! Jacobian ratio    min J / max J           1 where sides are straight and opposite ones parallel; ≤ 0: inverted
//! scaled Jacobian   min over corners of sin(corner angle), over sin 60° in triangles: 1 is ideal, ≤ 0: inverted
//! aspect ratio      longest side over shortest height (triangle, over 2/√3: 1 when equilateral),
//!                   longest over shortest distance of opposite sides' middles (quadrilateral)
//! ```
//!
//! Angles are those between the curved sides at the corners.
//!
//! Source: P. Knupp et al., *The Verdict geometric quality library*, Sandia report SAND2007-1751; integration points of
//! the rules used by the elements: three points in six-node triangles, 3 × 3 Gauss points in quadratic quadrilaterals.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::{CellKind, Mesh};

/// Quality of one cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CellQuality {
    /// Ratio of the least to the greatest Jacobian determinant; not positive where the cell is inverted.
    pub jacobian_ratio: f64,
    /// Least sine of a corner's angle, over that of the ideal cell.
    pub scaled_jacobian: f64,
    /// Aspect ratio, ideally 1.
    pub aspect_ratio: f64,
    /// Least angle at a corner.
    pub least_angle_deg: f64,
    /// Greatest angle at a corner.
    pub greatest_angle_deg: f64,
}

/// Worst value of a measure and its cell.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Worst value.
    pub value: f64,
    /// Block of the mesh and number of the cell in it.
    pub cell: [usize; 2],
    /// Centre of the cell's corners, mm.
    pub at_mm: [f64; 2],
}

/// Quality of all plane cells of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshQuality {
    /// Number of plane cells.
    pub cells: usize,
    /// Least Jacobian ratio.
    pub jacobian_ratio: Worst,
    /// Least scaled Jacobian.
    pub scaled_jacobian: Worst,
    /// Greatest aspect ratio.
    pub aspect_ratio: Worst,
    /// Least angle.
    pub least_angle_deg: Worst,
    /// Greatest angle.
    pub greatest_angle_deg: Worst,
}

/// Error of a mesh without quality.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QualityError {
    /// A cell is folded, or its nodes run clockwise.
    #[error(
        "cell {} of block {} near ({:.4}, {:.4}) mm is inverted: its Jacobian ratio is {:.3}",
        .0.cell[1], .0.cell[0], .0.at_mm[0], .0.at_mm[1], .0.value
    )]
    Inverted(Worst),
    /// There are no plane cells.
    #[error("the mesh has no plane cells")]
    NoPlaneCells,
}

/// Quality of all plane cells of `mesh`.
///
/// # Errors
/// [`QualityError`] for the worst inverted cell, or where there are no plane cells.
pub fn of_mesh(mesh: &Mesh) -> Result<MeshQuality, QualityError> {
    let mut all = Vec::new();
    let mut nodes = Vec::with_capacity(9);
    for (block, cells) in mesh.cells.iter().enumerate() {
        for (number, cell) in cells.iter().enumerate() {
            nodes.clear();
            nodes.extend(cell.iter().map(|&node| Vector2::new(mesh.points[node][0], mesh.points[node][1])));
            let Some(quality) = of_cell(cells.kind, &nodes) else { break };
            let corners = &nodes[..corner_count(cells.kind)];
            let centre = corners.iter().sum::<Vector2<f64>>() / corners.len() as f64;
            all.push((quality, [block, number], centre));
        }
    }
    let summary = MeshQuality {
        cells: all.len(),
        jacobian_ratio: worst(&all, |quality| quality.jacobian_ratio, f64::lt)?,
        scaled_jacobian: worst(&all, |quality| quality.scaled_jacobian, f64::lt)?,
        aspect_ratio: worst(&all, |quality| quality.aspect_ratio, f64::gt)?,
        least_angle_deg: worst(&all, |quality| quality.least_angle_deg, f64::lt)?,
        greatest_angle_deg: worst(&all, |quality| quality.greatest_angle_deg, f64::gt)?,
    };
    if summary.jacobian_ratio.value > 0.0 { Ok(summary) } else { Err(QualityError::Inverted(summary.jacobian_ratio)) }
}

/// Quality, number and centre of a cell.
type Judged = (CellQuality, [usize; 2], Vector2<f64>);

/// First cell with the worst value of a measure.
fn worst(
    cells: &[Judged],
    measure: fn(&CellQuality) -> f64,
    is_worse: fn(&f64, &f64) -> bool,
) -> Result<Worst, QualityError> {
    let each = cells.iter().map(|(of, cell, at)| Worst { value: measure(of), cell: *cell, at_mm: (*at).into() });
    let worst = each.reduce(|worst, other| if is_worse(&other.value, &worst.value) { other } else { worst });
    worst.ok_or(QualityError::NoPlaneCells)
}

/// Quality of a cell with `nodes`; `None` for other than plane cells.
pub fn of_cell(kind: CellKind, nodes: &[Vector2<f64>]) -> Option<CellQuality> {
    let places = places(kind)?;
    let corners = corner_count(kind);
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut quality = CellQuality {
        jacobian_ratio: 0.0,
        scaled_jacobian: f64::INFINITY,
        aspect_ratio: if corners == 3 { triangle_aspect(nodes) } else { quad_aspect(nodes) },
        least_angle_deg: f64::INFINITY,
        greatest_angle_deg: f64::NEG_INFINITY,
    };
    for (number, &place) in places.iter().enumerate() {
        let [d_xi, d_eta] = tangents(kind, nodes, place);
        let jacobian = d_xi.perp(&d_eta);
        least = least.min(jacobian);
        greatest = greatest.max(jacobian);
        if number < corners {
            let [next, last] = corner_tangents(corners, number, d_xi, d_eta);
            let (cross, dot) = (next.perp(&last), next.dot(&last));
            // Angles of folded corners are above 180°.
            let angle = cross.atan2(dot).to_degrees();
            let angle = if angle < 0.0 { angle + 360.0 } else { angle };
            let ideal = if corners == 3 { 0.75f64.sqrt() } else { 1.0 };
            let sine = cross / (next.norm() * last.norm()) / ideal;
            quality.scaled_jacobian = quality.scaled_jacobian.min(sine);
            quality.least_angle_deg = quality.least_angle_deg.min(angle);
            quality.greatest_angle_deg = quality.greatest_angle_deg.max(angle);
        }
    }
    // The ratio of negative determinants is positive.
    quality.jacobian_ratio = if greatest > 0.0 { least / greatest } else { f64::NEG_INFINITY };
    Some(quality)
}

fn corner_count(kind: CellKind) -> usize {
    if matches!(kind, CellKind::Triangle | CellKind::Triangle6) { 3 } else { 4 }
}

/// Corners, then integration points on the reference cell.
fn places(kind: CellKind) -> Option<&'static [[f64; 2]]> {
    /// Abscissa √(3/5) of the three-point Gauss rule.
    const G: f64 = 0.774_596_669_241_483_4;
    /// Abscissa 1/√3 of the two-point Gauss rule.
    const H: f64 = 0.577_350_269_189_625_8;
    const S: f64 = 1.0 / 6.0;
    const T: f64 = 2.0 / 3.0;
    match kind {
        CellKind::Triangle | CellKind::Triangle6 => Some(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [S, S], [T, S], [S, T]]),
        CellKind::Quad => {
            Some(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-H, -H], [H, -H], [H, H], [-H, H]])
        }
        CellKind::Quad8 | CellKind::Quad9 => Some(&[
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
            [-G, -G],
            [0.0, -G],
            [G, -G],
            [-G, 0.0],
            [0.0, 0.0],
            [G, 0.0],
            [-G, G],
            [0.0, G],
            [G, G],
        ]),
        _ => None,
    }
}

/// Tangents ∂x/∂ξ and ∂x/∂η.
fn tangents(kind: CellKind, nodes: &[Vector2<f64>], place: [f64; 2]) -> [Vector2<f64>; 2] {
    let mut sums = [Vector2::zeros(), Vector2::zeros()];
    for (k, node) in nodes.iter().enumerate() {
        let [d_xi, d_eta] = shape_derivatives(kind, k, place);
        sums[0] += d_xi * node;
        sums[1] += d_eta * node;
    }
    sums
}

/// Derivatives ∂N_k/∂ξ and ∂N_k/∂η.
fn shape_derivatives(kind: CellKind, k: usize, [xi, eta]: [f64; 2]) -> [f64; 2] {
    /// Nodes of a quadrilateral on the reference cell.
    const QUAD: [[f64; 2]; 9] = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [0.0, -1.0],
        [1.0, 0.0],
        [0.0, 1.0],
        [-1.0, 0.0],
        [0.0, 0.0],
    ];
    match kind {
        CellKind::Triangle => [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]][k],
        CellKind::Triangle6 => {
            let zeta = 1.0 - xi - eta;
            // N = λ (2λ − 1) at corners, 4 λ_a λ_b between them.
            [
                [1.0 - 4.0 * zeta, 1.0 - 4.0 * zeta],
                [4.0 * xi - 1.0, 0.0],
                [0.0, 4.0 * eta - 1.0],
                [4.0 * (zeta - xi), -4.0 * xi],
                [4.0 * eta, 4.0 * xi],
                [-4.0 * eta, 4.0 * (zeta - eta)],
            ][k]
        }
        CellKind::Quad => {
            let [a, b] = QUAD[k];
            [0.25 * a * (1.0 + b * eta), 0.25 * b * (1.0 + a * xi)]
        }
        CellKind::Quad8 => {
            let [a, b] = QUAD[k];
            match k {
                // N = ¼ (1 + aξ)(1 + bη)(aξ + bη − 1)
                0..=3 => [
                    0.25 * a * (1.0 + b * eta) * (2.0 * a * xi + b * eta),
                    0.25 * b * (1.0 + a * xi) * (a * xi + 2.0 * b * eta),
                ],
                // N = ½ (1 − ξ²)(1 + bη)
                4 | 6 => [-xi * (1.0 + b * eta), 0.5 * b * (1.0 - xi * xi)],
                // N = ½ (1 + aξ)(1 − η²)
                _ => [0.5 * a * (1.0 - eta * eta), -eta * (1.0 + a * xi)],
            }
        }
        _ => {
            let [a, b] = QUAD[k];
            [lagrange_slope(a, xi) * lagrange(b, eta), lagrange(a, xi) * lagrange_slope(b, eta)]
        }
    }
}

/// Quadratic Lagrange polynomial of the node at −1, 0 or 1.
fn lagrange(node: f64, x: f64) -> f64 {
    if node == 0.0 { 1.0 - x * x } else { 0.5 * x * (x + node) }
}

fn lagrange_slope(node: f64, x: f64) -> f64 {
    if node == 0.0 { -2.0 * x } else { x + 0.5 * node }
}

/// Tangents from a corner along the sides to the next and to the previous corner.
fn corner_tangents(corners: usize, corner: usize, d_xi: Vector2<f64>, d_eta: Vector2<f64>) -> [Vector2<f64>; 2] {
    match (corners, corner) {
        (3, 0) => [d_xi, d_eta],
        (3, 1) => [d_eta - d_xi, -d_xi],
        (3, _) => [-d_eta, d_xi - d_eta],
        (_, 0) => [d_xi, d_eta],
        (_, 1) => [d_eta, -d_xi],
        (_, 2) => [-d_xi, -d_eta],
        _ => [-d_eta, d_xi],
    }
}

fn triangle_aspect(nodes: &[Vector2<f64>]) -> f64 {
    let sides = [nodes[1] - nodes[0], nodes[2] - nodes[1], nodes[0] - nodes[2]];
    let longest = sides.iter().map(|side| side.norm()).fold(0.0, f64::max);
    // Shortest height = 2 area / longest side.
    0.75f64.sqrt() * longest * longest / sides[0].perp(&-sides[2]).abs()
}

fn quad_aspect(nodes: &[Vector2<f64>]) -> f64 {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| 0.5 * (nodes[k] + nodes[(k + 1) % 4]));
    let across = [(a - c).norm(), (b - d).norm()];
    across[0].max(across[1]) / across[0].min(across[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(nodes: &[[f64; 2]]) -> Vec<Vector2<f64>> {
        nodes.iter().map(|&node| node.into()).collect()
    }

    /// Straight-sided nodes of a cell of `kind` through its corners.
    fn with_middles(kind: CellKind, corners: &[[f64; 2]]) -> Vec<Vector2<f64>> {
        let mut nodes = points(corners);
        let n = corners.len();
        if kind.node_count() > n {
            nodes.extend((0..n).map(|k| 0.5 * (nodes[k] + nodes[(k + 1) % n])).collect::<Vec<_>>());
        }
        if kind == CellKind::Quad9 {
            nodes.push(nodes[..4].iter().sum::<Vector2<f64>>() / 4.0);
        }
        nodes
    }

    #[test]
    fn ver_ideal_cells_are_ideal() {
        let triangle = [[0.0, 0.0], [2.0, 0.0], [1.0, 3f64.sqrt()]];
        let square = [[1.0, 1.0], [4.0, 1.0], [4.0, 4.0], [1.0, 4.0]];
        for (kind, corners, angle) in [
            (CellKind::Triangle, &triangle[..], 60.0),
            (CellKind::Triangle6, &triangle[..], 60.0),
            (CellKind::Quad, &square[..], 90.0),
            (CellKind::Quad8, &square[..], 90.0),
            (CellKind::Quad9, &square[..], 90.0),
        ] {
            let quality = of_cell(kind, &with_middles(kind, corners)).unwrap();
            for (value, ideal) in [
                (quality.jacobian_ratio, 1.0),
                (quality.scaled_jacobian, 1.0),
                (quality.aspect_ratio, 1.0),
                (quality.least_angle_deg / angle, 1.0),
                (quality.greatest_angle_deg / angle, 1.0),
            ] {
                assert!((value - ideal).abs() < 1e-12, "{kind:?}: {quality:?}");
            }
        }
        assert_eq!(of_cell(CellKind::Line3, &points(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]])), None);
    }

    /// A trapezium's Jacobian varies linearly with its width: J ∝ 2 at the long side, 1 at the short one.
    #[test]
    fn ver_a_trapezium_and_a_right_triangle() {
        let trapezium = with_middles(CellKind::Quad8, &[[0.0, 0.0], [2.0, 0.0], [1.5, 1.0], [0.5, 1.0]]);
        let quality = of_cell(CellKind::Quad8, &trapezium).unwrap();
        assert!((quality.jacobian_ratio - 0.5).abs() < 1e-12, "{quality:?}");
        assert!((quality.least_angle_deg - 2f64.atan().to_degrees()).abs() < 1e-10, "{quality:?}");
        // Legs 3 and 4: heights 4·3/5 on the longest side; angles atan 3/4 and 90°.
        let right = with_middles(CellKind::Triangle6, &[[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]);
        let quality = of_cell(CellKind::Triangle6, &right).unwrap();
        assert!((quality.aspect_ratio - 5.0 / 2.4 * 0.75f64.sqrt()).abs() < 1e-12, "{quality:?}");
        assert!((quality.least_angle_deg - 0.75f64.atan().to_degrees()).abs() < 1e-10, "{quality:?}");
        assert!((quality.greatest_angle_deg - 90.0).abs() < 1e-10, "{quality:?}");
    }

    #[test]
    fn inverted_cells_are_named_with_their_place() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let clockwise: Vec<_> = square.iter().rev().copied().collect();
        assert!(of_cell(CellKind::Quad, &points(&clockwise)).unwrap().jacobian_ratio < 0.0);
        // A middle node dragged beyond a quarter of the side folds the corner over.
        let mut folded = with_middles(CellKind::Triangle6, &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        folded[3] = Vector2::new(0.2, 0.0);
        assert!(of_cell(CellKind::Triangle6, &folded).unwrap().jacobian_ratio < 0.0);

        let mut mesh = Mesh {
            points: square.iter().chain(&[[2.0, 0.0], [2.0, 1.0]]).map(|p| [p[0], p[1], 0.0]).collect(),
            cells: vec![super::super::CellBlock::new(CellKind::Quad, vec![0, 1, 2, 3, 1, 2, 5, 4])],
            ..Mesh::default()
        };
        match of_mesh(&mesh) {
            Err(QualityError::Inverted(worst)) => assert_eq!((worst.cell, worst.at_mm), ([0, 1], [1.5, 0.5])),
            other => panic!("{other:?}"),
        }
        mesh.cells.clear();
        assert_eq!(of_mesh(&mesh), Err(QualityError::NoPlaneCells));
    }
}
