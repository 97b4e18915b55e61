//! Building blocks of finite-element problems: supports, pressures on parts of edges, other units, fits of fields.

#![allow(dead_code, reason = "each test takes what it needs")]

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::problem::{ContactPair, Edge, Held, Problem};
use gearwear_fem::solid::Solid;
use nalgebra::{Matrix2, Matrix3, Vector2};

/// Points and weights of Gauss's rule over −1 to 1, exact to degree 5.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// A plane-strain problem of `solid` without supports, loads and contacts.
pub fn problem(solid: Solid, materials: &[(f64, f64)]) -> Problem {
    let material = |&(young_modulus_mpa, poisson_ratio): &(f64, f64)| Elastic { young_modulus_mpa, poisson_ratio };
    Problem {
        analysis: Analysis::PlaneStrain,
        forces_n_per_mm: vec![0.0; solid.dofs()],
        materials: materials.iter().map(material).collect(),
        solid,
        ..Problem::default()
    }
}

/// Holds one component of all `nodes` at `displacement_mm`, of nodes that are not held yet.
pub fn hold(problem: &mut Problem, nodes: &[u32], component: u32, displacement_mm: f64) {
    for node in nodes {
        let dof = 2 * node + component;
        if problem.held.iter().all(|held| held.dof != dof) {
            problem.held.push(Held { dof, displacement_mm });
        }
    }
}

/// A force on one node.
pub fn push(problem: &mut Problem, node: u32, force: Vector2<f64>) {
    problem.forces_n_per_mm[2 * node as usize] += force.x;
    problem.forces_n_per_mm[2 * node as usize + 1] += force.y;
}

pub fn pair(slave: &[Edge], master: &[Edge]) -> ContactPair {
    ContactPair { slave: slave.to_vec(), master: master.to_vec() }
}

/// Consistent nodal forces of `pressure` on the part of straight `edges` where `along · x` lies between `from` and `to`.
pub fn press(problem: &mut Problem, edges: &[Edge], pressure: f64, along: Vector2<f64>, (from, to): (f64, f64)) {
    for edge in edges {
        let ends = edge.ends.map(|node| problem.solid.points_mm[node as usize]);
        let places = ends.map(|point| along.dot(&point));
        let xi = |place: f64| (2.0 * (place - places[0]) / (places[1] - places[0]) - 1.0).clamp(-1.0, 1.0);
        let (low, high) = (xi(from).min(xi(to)), xi(from).max(xi(to)));
        let tangent = 0.5 * (ends[1] - ends[0]);
        // The body lies on the left of its edges: −(t_y, −t_x) points into it, and its length is dγ/dξ.
        let inward = Vector2::new(-tangent.y, tangent.x);
        for (x, w) in GAUSS {
            let xi = 0.5 * (low + high) + 0.5 * (high - low) * x;
            let shape = match edge.middle {
                None => [0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0],
                Some(_) => [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi],
            };
            for (node, n) in edge.ends.into_iter().chain(edge.middle).zip(shape) {
                push(problem, node, 0.5 * (high - low) * w * n * pressure * inward);
            }
        }
    }
}

/// The same problem in other units: lengths, forces per length and stresses times these factors.
pub fn in_units(problem: &Problem, length: f64, force: f64, stress: f64) -> Problem {
    let mut other = problem.clone();
    other.solid.points_mm.iter_mut().for_each(|point| *point *= length);
    other.held.iter_mut().for_each(|held| held.displacement_mm *= length);
    other.forces_n_per_mm.iter_mut().for_each(|value| *value *= force);
    other.materials.iter_mut().for_each(|material| material.young_modulus_mpa *= stress);
    other
}

/// The node nearest to a point.
pub fn nearest(solid: &Solid, point: Vector2<f64>) -> u32 {
    let distance = |node: &u32| (solid.points_mm[*node as usize] - point).norm();
    (0..solid.points_mm.len() as u32).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("a mesh has nodes")
}

/// Displacement of a node.
pub fn moved(displacement: &[f64], node: u32) -> Vector2<f64> {
    Vector2::new(displacement[2 * node as usize], displacement[2 * node as usize + 1])
}

/// The linear field u = u₀ + H x that fits the displacements of `nodes` best: H, and the greatest deviation.
pub fn linear_fit(solid: &Solid, displacement: &[f64], nodes: std::ops::Range<u32>) -> (Matrix2<f64>, f64) {
    let row = |node: u32| {
        let point = solid.points_mm[node as usize];
        nalgebra::Vector3::new(1.0, point.x, point.y)
    };
    let gram: Matrix3<f64> = nodes.clone().map(|node| row(node) * row(node).transpose()).sum();
    let inverse = gram.try_inverse().expect("nodes span the plane");
    let fit = [0, 1].map(|component| {
        inverse
            * nodes.clone().map(|node| row(node) * moved(displacement, node)[component]).sum::<nalgebra::Vector3<f64>>()
    });
    let deviation = |node: u32| {
        let fitted = Vector2::new(fit[0].dot(&row(node)), fit[1].dot(&row(node)));
        (moved(displacement, node) - fitted).norm()
    };
    let h = Matrix2::new(fit[0].y, fit[0].z, fit[1].y, fit[1].z);
    (h, nodes.map(deviation).fold(0.0, f64::max))
}

/// Merges nodes closer than `tolerance_mm`, as at the seam of a closed ring; returns the new number of each old node.
pub fn weld(solid: &mut Solid, tolerance_mm: f64) -> Vec<u32> {
    let old = std::mem::take(&mut solid.points_mm);
    let mut order: Vec<usize> = (0..old.len()).collect();
    order.sort_by(|&a, &b| old[a].x.total_cmp(&old[b].x));
    let mut twin: Vec<usize> = (0..old.len()).collect();
    for (i, &a) in order.iter().enumerate() {
        for &b in order[i + 1..].iter().take_while(|&&b| old[b].x - old[a].x < tolerance_mm) {
            if (old[a] - old[b]).norm() < tolerance_mm {
                let first = twin[a].min(twin[b]);
                (twin[a], twin[b]) = (first, first);
            }
        }
    }
    let mut number = vec![0; old.len()];
    for (node, point) in old.iter().enumerate() {
        if twin[node] == node {
            number[node] = solid.points_mm.len() as u32;
            solid.points_mm.push(*point);
        } else {
            number[node] = number[twin[node]];
        }
    }
    for element in &mut solid.elements {
        let nodes: Vec<u32> = element.nodes().iter().map(|&node| number[node as usize]).collect();
        *element = gearwear_fem::solid::Element::new(element.kind, &nodes, element.material);
    }
    number
}

/// The same edges after [`weld`].
pub fn renumbered(edges: &[Edge], number: &[u32]) -> Vec<Edge> {
    let new = |node: u32| number[node as usize];
    edges.iter().map(|edge| Edge { ends: edge.ends.map(new), middle: edge.middle.map(new) }).collect()
}

/// Evenly spaced lines.
pub fn even(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect()
}

/// Lines from `low` to `high` that are `step` apart near `centre` (over `even` on either side) and grow away from it.
pub fn graded_around(low: f64, high: f64, centre: f64, step: f64, even: f64) -> Vec<f64> {
    let mut lines: Vec<f64> = super::grid::graded(centre, low, step, even, 1.3).into_iter().rev().collect();
    lines.extend(super::grid::graded(centre, high, step, even, 1.3).into_iter().skip(1));
    lines
}
