//! Work-equivalent nodal forces of distributed loads.
//!
//! ```text
//! Fₐ = ∫ Nₐ t ds over edges        Fₐ = ∫ Nₐ f dA over elements
//! ```
//!
//! t is the traction in MPa on the surface of straight or curved edges; f the force per volume in N/mm³. Edges
//! have the body on their left, so the outward normal is the tangent turned right, and a pressure p is t = −p n. Forces in
//! N per mm of thickness are added to given ones.
//!
//! ds and dA are areas and volumes with the thickness of [`Analysis::thickness_mm`]: of bodies of revolution forces are those of the whole
//! circumference, N.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005),
//! section 2.3.

use nalgebra::Vector2;

use super::elastic::Analysis;
use super::problem::Edge;
use super::quadrature::GAUSS_4;
use super::quadrature::load_rule;
use super::shape::along_edge;
use super::solid::Solid;

/// Point of integration on an edge.
struct EdgeIntegrationPoint {
    at_mm: Vector2<f64>,
    /// Tangent times the weighted length of the point, mm.
    tangent_mm: Vector2<f64>,
    /// Shape functions of the ends and the middle.
    shape: [f64; 3],
}

/// Points of integration of an edge: four, exact for polynomials of degree 7 in the parameter.
fn edge_points<'a>(solid: &'a Solid, edge: &'a Edge) -> impl Iterator<Item = EdgeIntegrationPoint> + 'a {
    let nodes_mm = edge_nodes(edge).map(|node| solid.points_mm[node as usize]);
    GAUSS_4.iter().map(move |(s, weight)| {
        let (shape, slope) = along_edge(edge.middle.is_some(), *s);
        let [at_mm, tangent_mm] =
            [shape, slope].map(|factors| nodes_mm.iter().zip(factors).map(|(x, f)| x * f).sum::<Vector2<f64>>());
        EdgeIntegrationPoint { at_mm, tangent_mm: tangent_mm * *weight, shape }
    })
}

/// Ends and middle of an edge; a linear edge repeats an end, with a third shape function of zero.
fn edge_nodes(edge: &Edge) -> [u32; 3] {
    [edge.ends[0], edge.ends[1], edge.middle.unwrap_or(edge.ends[0])]
}

fn add(forces_n_per_mm: &mut [f64], node: u32, force: Vector2<f64>) {
    forces_n_per_mm[2 * node as usize] += force.x;
    forces_n_per_mm[2 * node as usize + 1] += force.y;
}

/// Adds the forces of a traction `traction_mpa(x, n)` on `edges`; x in mm, n the outward unit normal.
///
/// # Panics
/// Where there is not one force for each degree of freedom.
pub fn add_traction(
    solid: &Solid,
    edges: &[Edge],
    analysis: Analysis,
    traction_mpa: impl Fn(Vector2<f64>, Vector2<f64>) -> Vector2<f64>,
    forces_n_per_mm: &mut [f64],
) {
    assert_eq!(forces_n_per_mm.len(), solid.dofs(), "one force for each degree of freedom");
    for edge in edges {
        for EdgeIntegrationPoint { at_mm, tangent_mm, shape } in edge_points(solid, edge) {
            let length_mm = tangent_mm.norm();
            let normal = Vector2::new(tangent_mm.y, -tangent_mm.x) / length_mm;
            let force = traction_mpa(at_mm, normal) * (length_mm * analysis.thickness_mm(at_mm.x));
            for (node, share) in edge_nodes(edge).into_iter().zip(shape) {
                add(forces_n_per_mm, node, force * share);
            }
        }
    }
}

/// Adds the force `resultant_n_per_mm`, spread evenly over the area of `edges`.
///
/// # Panics
/// Where there is not one force for each degree of freedom.
pub fn add_spread_force(
    solid: &Solid,
    edges: &[Edge],
    analysis: Analysis,
    resultant_n_per_mm: Vector2<f64>,
    forces_n_per_mm: &mut [f64],
) {
    let points = edges.iter().flat_map(|edge| edge_points(solid, edge));
    let area: f64 = points.map(|point| point.tangent_mm.norm() * analysis.thickness_mm(point.at_mm.x)).sum();
    let traction = resultant_n_per_mm / area;
    add_traction(solid, edges, analysis, |_, _| traction, forces_n_per_mm);
}

/// Adds the forces of a force per volume `force_n_per_mm3(x)`, x in mm, on all elements.
///
/// # Panics
/// Where there is not one force for each degree of freedom.
pub fn add_body_force(
    solid: &Solid,
    analysis: Analysis,
    force_n_per_mm3: impl Fn(Vector2<f64>) -> Vector2<f64>,
    forces_n_per_mm: &mut [f64],
) {
    assert_eq!(forces_n_per_mm.len(), solid.dofs(), "one force for each degree of freedom");
    let mut nodes_mm = Vec::new();
    for element in &solid.elements {
        nodes_mm.clear();
        nodes_mm.extend(element.nodes().iter().map(|node| solid.points_mm[*node as usize]));
        for point in &load_rule(element.kind).points {
            let area_mm2 = point.weight * point.shape.jacobian(&nodes_mm).determinant();
            let at_mm = point.shape.point(&nodes_mm);
            let force = force_n_per_mm3(at_mm) * (area_mm2 * analysis.thickness_mm(at_mm.x));
            for (node, share) in element.nodes().iter().zip(point.shape.values) {
                add(forces_n_per_mm, *node, force * share);
            }
        }
    }
}
