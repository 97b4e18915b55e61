//! What the tests share: solving a small problem, measuring its error.

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::factor::Factor;
use gearwear_fem::problem::Edge;
use gearwear_fem::quadrature::load_rule;
use gearwear_fem::solid::Solid;
use gearwear_fem::stiffness::Stiffness;
use nalgebra::Vector2;

pub const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };

pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// A displacement field at the nodes.
pub fn field(solid: &Solid, of: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Vec<f64> {
    solid.points_mm.iter().flat_map(|x| <[f64; 2]>::from(of(*x))).collect()
}

/// Nodes of edges, each once.
pub fn nodes_of<'a>(edges: impl IntoIterator<Item = &'a Edge>) -> Vec<u32> {
    let mut nodes: Vec<u32> = edges.into_iter().flat_map(|edge| edge.ends.into_iter().chain(edge.middle)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// (degree of freedom, mm) of both components of `nodes`.
pub fn hold(nodes: &[u32], displacement_mm: &[f64]) -> Vec<(u32, f64)> {
    nodes.iter().flat_map(|node| [2 * node, 2 * node + 1]).map(|dof| (dof, displacement_mm[dof as usize])).collect()
}

/// Displacements under `forces` with `given` displacements.
pub fn solve(
    solid: &Solid,
    material: Elastic,
    analysis: Analysis,
    given: &[(u32, f64)],
    mut forces: Vec<f64>,
) -> Vec<f64> {
    let stiffness = Stiffness::new(solid, &[material], analysis).unwrap();
    let mut held = vec![false; solid.dofs()];
    for (dof, _) in given {
        held[*dof as usize] = true;
    }
    let factor = Factor::new(&stiffness, &held).unwrap();
    factor.subtract_held(stiffness.matrix(), given, &mut forces);
    factor.solve(1, &mut forces);
    for (dof, value) in given {
        forces[*dof as usize] = *value;
    }
    forces
}

/// √(∫ |u − u_h|² dA / ∫ |u|² dA).
pub fn l2_error(solid: &Solid, displacement_mm: &[f64], exact: impl Fn(Vector2<f64>) -> Vector2<f64>) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for element in &solid.elements {
        let nodes_mm: Vec<_> = element.nodes().iter().map(|node| solid.points_mm[*node as usize]).collect();
        for point in &load_rule(element.kind).points {
            let area = point.weight * point.shape.jacobian(&nodes_mm).determinant();
            let mut u = Vector2::zeros();
            for (node, n) in element.nodes().iter().zip(point.shape.values) {
                let dof = 2 * *node as usize;
                u += Vector2::new(displacement_mm[dof], displacement_mm[dof + 1]) * n;
            }
            let exact = exact(point.shape.point(&nodes_mm));
            error += area * (u - exact).norm_squared();
            norm += area * exact.norm_squared();
        }
    }
    (error / norm).sqrt()
}

/// Slope of log e over log h by least squares, for meshes each of half the size of the one before.
pub fn order(errors: &[f64]) -> f64 {
    let count = errors.len() as f64;
    let middle = (count - 1.0) / 2.0;
    let (mut above, mut below) = (0.0, 0.0);
    for (i, error) in errors.iter().enumerate() {
        let x = i as f64 - middle;
        above -= x * error.log2();
        below += x * x;
    }
    above / below
}

/// Numbers in three digits, for the protocol of a test.
pub fn figures(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.2e}")).collect::<Vec<_>>().join(" ")
}
