//! Bodies in space that the supports do not hold: refused before the solver meets a singular matrix.
//!
//! Elements that share faces are one *part*, which moves rigidly in six ways: along x, y, z, and turning about its centre c, scaled
//! with its size L. Every held degree of freedom is one equation for their amplitudes q, and every node at which parts touch like a
//! hinge or a ball are three for each pair,
//!
//! ```text
//! e · u(x) = 0        e · (u₁(x) − u₂(x)) = 0        u(x) = t + ω × (x − c)/L        q = (t, ω)
//! ```
//!
//! The null space of the sum of the outer products of their coefficients, over the parts that hang together, are the motions that
//! nothing resists.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, SymmetricEigen, Vector3};

use super::meshed_groups::place;
use super::space_bodies::SpaceBodies;
use crate::scene::findings::Findings;
use gearwear_fem::disjoint_sets::DisjointSets;
use gearwear_fem::problem::Held;

/// Ratio of the sum of squared equations to the greatest, below which a motion is free.
const FREE: f64 = 1e-10;
/// Greatest number of connected parts that are checked; above it the check is left to the solver.
const MOST_PARTS: usize = 100;
/// Degrees of freedom of a part.
const WAYS: usize = 6;

/// Elements joined by faces.
struct JoinedParts {
    /// For each node the parts it belongs to, in rising order.
    of_node: Vec<Vec<u32>>,
    /// The body of each.
    body: Vec<u16>,
    centre_mm: Vec<Vector3<f64>>,
    size_mm: Vec<f64>,
}

/// Connected parts, with the coefficients of the equations that hold them.
#[derive(Default)]
struct Cluster {
    members: Vec<u32>,
    equations: Vec<Vec<(u32, [f64; WAYS])>>,
}

/// Refuses bodies that can move.
pub(super) fn check(bodies: &SpaceBodies, held: &[Held], findings: &mut Findings) {
    let parts = JoinedParts::of(bodies);
    for cluster in parts.clusters(bodies, held) {
        if cluster.members.len() <= MOST_PARTS {
            check_cluster(&parts, &cluster, findings);
        }
    }
}

fn check_cluster(parts: &JoinedParts, Cluster { members, equations }: &Cluster, findings: &mut Findings) {
    let first_of: BTreeMap<u32, usize> = members.iter().enumerate().map(|(i, &part)| (part, WAYS * i)).collect();
    let mut gram = DMatrix::<f64>::zeros(WAYS * members.len(), WAYS * members.len());
    for equation in equations {
        let entries = equation.iter().flat_map(|(part, motion)| (first_of[part]..).zip(*motion));
        for (i, a) in entries.clone() {
            entries.clone().for_each(|(k, b)| gram[(i, k)] += a * b);
        }
    }
    let eigen = SymmetricEigen::new(gram);
    let limit = FREE * eigen.eigenvalues.amax();
    let free: Vec<usize> = (0..eigen.eigenvalues.len()).filter(|&i| eigen.eigenvalues[i] <= limit).collect();
    let share = |part: u32| -> f64 {
        let rows = first_of[&part]..first_of[&part] + WAYS;
        free.iter().flat_map(|&i| rows.clone().map(move |row| (row, i))).map(|at| eigen.eigenvectors[at].powi(2)).sum()
    };
    // Tolerance for round-off, so that of equal ones the first is named.
    let most = members.iter().copied().reduce(|a, b| if share(b) > share(a) * (1.0 + 1e-6) { b } else { a });
    let (Some(part), false) = (most, free.is_empty()) else { return };
    let motion = match free.as_slice() {
        [only] => parts.in_words(part, |way| eigen.eigenvectors[(first_of[&part] + way, *only)]),
        several if several.len() == WAYS * members.len() => "nothing holds".to_owned(),
        several => format!("can move in {} ways that nothing resists", several.len()),
    };
    let body = parts.body[part as usize];
    findings.not_allowed(&format!("body[{body}]"), format!("a body that {motion}"), "supports that hold every body");
    findings.help("hold it in one more direction with [[fixed]], or on a plane of symmetry");
}

impl JoinedParts {
    fn of(bodies: &SpaceBodies) -> Self {
        let solid = &bodies.solid;
        let mut sets = DisjointSets::new(solid.elements.len());
        bodies.faces.values().flat_map(|around| around.windows(2)).for_each(|pair| sets.join(pair[0], pair[1]));
        let (part_of_element, count) = sets.numbered();
        let mut of_node = vec![Vec::new(); solid.points_mm.len()];
        let mut body = vec![0; count];
        for (element, &part) in solid.elements.iter().zip(&part_of_element).rev() {
            body[part as usize] = element.body;
            element.nodes.iter().for_each(|&node| of_node[node as usize].push(part));
        }
        for parts in &mut of_node {
            parts.sort_unstable();
            parts.dedup();
        }
        let mut parts = Self { of_node, body, centre_mm: vec![Vector3::zeros(); count], size_mm: vec![0.0; count] };
        let mut nodes = vec![0.0; count];
        for (point, of_node) in solid.points_mm.iter().zip(&parts.of_node) {
            for &part in of_node {
                parts.centre_mm[part as usize] += point;
                nodes[part as usize] += 1.0;
            }
        }
        parts.centre_mm.iter_mut().zip(nodes).for_each(|(sum, nodes)| *sum /= nodes);
        for (point, of_node) in solid.points_mm.iter().zip(&parts.of_node) {
            for &part in of_node {
                let size = &mut parts.size_mm[part as usize];
                *size = size.max((point - parts.centre_mm[part as usize]).norm());
            }
        }
        parts
    }

    /// Parts that share nodes, each with its equations.
    fn clusters(&self, bodies: &SpaceBodies, held: &[Held]) -> Vec<Cluster> {
        let mut sets = DisjointSets::new(self.body.len());
        for pair in self.of_node.iter().flat_map(|parts| parts.windows(2)) {
            sets.join(pair[0], pair[1]);
        }
        let (cluster, count) = sets.numbered();
        let mut clusters: Vec<Cluster> = (0..count).map(|_| Cluster::default()).collect();
        (0..).zip(&cluster).for_each(|(part, &of)| clusters[of as usize].members.push(part));
        for (parts, at_mm) in self.of_node.iter().zip(&bodies.solid.points_mm) {
            for pair in parts.windows(2) {
                for k in 0..3 {
                    let along = Vector3::ith(k, 1.0);
                    let equation =
                        [(pair[0], along), (pair[1], -along)].map(|(part, e)| (part, self.motion(part, at_mm, e)));
                    clusters[cluster[pair[0] as usize] as usize].equations.push(equation.to_vec());
                }
            }
        }
        for held in held {
            let (node, component) = ((held.dof / 3) as usize, (held.dof % 3) as usize);
            let part = self.of_node[node][0];
            let motion = self.motion(part, &bodies.solid.points_mm[node], Vector3::ith(component, 1.0));
            clusters[cluster[part as usize] as usize].equations.push(vec![(part, motion)]);
        }
        clusters
    }

    /// The amplitudes' parts in the displacement of `at_mm` along `direction`.
    fn motion(&self, part: u32, at_mm: &Vector3<f64>, direction: Vector3<f64>) -> [f64; WAYS] {
        let turn = ((at_mm - self.centre_mm[part as usize]) / self.size_mm[part as usize]).cross(&direction);
        [direction.x, direction.y, direction.z, turn.x, turn.y, turn.z]
    }

    /// A motion in words: a turn has an axis, through c + L (ω × t)/ω² along ω.
    fn in_words(&self, part: u32, q: impl Fn(usize) -> f64) -> String {
        let (shift, turn) = (Vector3::new(q(0), q(1), q(2)), Vector3::new(q(3), q(4), q(5)));
        if turn.norm() > 1e-6 * shift.norm() {
            let (centre, size) = (self.centre_mm[part as usize], self.size_mm[part as usize]);
            let through = centre + turn.cross(&shift) * (size / turn.norm_squared());
            let through = through.map(|x| (x * 1e4).round() / 1e4 + 0.0);
            return format!("can turn about the axis along {} through {}", axis(turn), place(through.as_slice()));
        }
        format!("can move along {}", axis(shift))
    }
}

/// `x`, or the components of a direction along no axis.
fn axis(of: Vector3<f64>) -> String {
    let e = of.normalize();
    match ["x", "y", "z"].iter().zip(e.iter()).find(|(_, along)| along.abs() > 1.0 - 1e-9) {
        Some((name, _)) => (*name).to_owned(),
        None => format!("({:.3}, {:.3}, {:.3})", e.x, e.y, e.z),
    }
}
