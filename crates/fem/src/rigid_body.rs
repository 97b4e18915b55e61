//! Rigid motions that no support prevents.
//!
//! A plane body moves rigidly in three ways, u(x) = t + ω ẑ × (x − c)/L, with c its centre and L its size, so that all
//! three amplitudes are lengths. Supports prevent those that would move a held degree of freedom; what is left is found as
//! the null space of the held components. Such a body has no unique answer to its loads: it is anchored at as many degrees
//! of freedom as motions are left, and the motions join the contact problem as unknowns of their own, with the balance of
//! the loads along each as equation. In equilibrium the anchors carry nothing.
//!
//! Source: C. Farhat and F.-X. Roux, *Int. J. Numer. Meth. Eng.* 32 (1991) 1205–1227 (floating subdomains).

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector2, Vector3};

use super::disjoint_sets::DisjointSets;
use super::solid::Solid;

/// Motions whose held components are below this part of the others' are free.
const FREE: f64 = 1e-10;

/// One free rigid motion of one body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RigidMotion {
    /// The body's nodes.
    pub nodes: Vec<u32>,
    centre_mm: Vector2<f64>,
    size_mm: f64,
    /// Both translations and the rotation.
    amplitude: Vector3<f64>,
    /// The degree of freedom that anchors it.
    pub anchor: u32,
}

impl RigidMotion {
    /// Displacement per amplitude at a point of the body.
    pub(crate) fn at(&self, point_mm: Vector2<f64>) -> Vector2<f64> {
        let arm = (point_mm - self.centre_mm) / self.size_mm;
        Vector2::new(self.amplitude.x - self.amplitude.z * arm.y, self.amplitude.y + self.amplitude.z * arm.x)
    }
}

/// In words: which body moves how with these amplitudes of the `motions`; of several bodies, the one that moves most.
pub(crate) fn describe(motions: &[RigidMotion], amplitudes: &[f64]) -> String {
    let sum_of = |body: &[u32]| -> Vector3<f64> {
        let own = motions.iter().zip(amplitudes).filter(|(motion, _)| motion.nodes == body);
        own.map(|(motion, amplitude)| *amplitude * motion.amplitude).sum()
    };
    let moving = motions.iter().map(|motion| (motion, sum_of(&motion.nodes)));
    let Some((body, amplitude)) = moving.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) else {
        return "nothing moves freely".to_owned();
    };
    let (x, y) = (body.centre_mm.x, body.centre_mm.y);
    let shift = Vector2::new(amplitude.x, amplitude.y);
    // A motion t + ω ẑ × r/L turns about the point r = L ẑ × t/ω, and is a shift where that is far away.
    let arm = body.size_mm * Vector2::new(-shift.y, shift.x) / amplitude.z;
    if amplitude.z.abs() > 1e-3 * shift.norm() {
        format!("the body around ({x:.4}, {y:.4}) mm turns freely about ({:.4}, {:.4}) mm", x + arm.x, y + arm.y)
    } else {
        let along = shift / shift.norm();
        format!("the body around ({x:.4}, {y:.4}) mm moves freely along ({:.3}, {:.3})", along.x, along.y)
    }
}

/// The nodes of each body: those connected through elements, by increasing number.
pub(crate) fn bodies(solid: &Solid) -> Vec<Vec<u32>> {
    let mut sets = DisjointSets::new(solid.points_mm.len());
    let mut used = vec![false; solid.points_mm.len()];
    for nodes in solid.elements.iter().map(|element| element.nodes()) {
        for &node in nodes {
            used[node as usize] = true;
            sets.join(nodes[0], node);
        }
    }
    let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for node in (0..used.len() as u32).filter(|&node| used[node as usize]) {
        groups.entry(sets.root(node)).or_default().push(node);
    }
    groups.into_values().collect()
}

/// The free rigid motions of all bodies of `solid` with the degrees of freedom `held`.
pub(crate) fn free_motions(solid: &Solid, held: &[bool]) -> Vec<RigidMotion> {
    bodies(solid).into_iter().flat_map(|nodes| free_motions_of(solid, nodes, held)).collect()
}

fn free_motions_of(solid: &Solid, nodes: Vec<u32>, held: &[bool]) -> Vec<RigidMotion> {
    let point = |node: u32| solid.points_mm[node as usize];
    let centre_mm = nodes.iter().map(|&node| point(node)).sum::<Vector2<f64>>() / nodes.len() as f64;
    let size_mm = nodes.iter().map(|&node| (point(node) - centre_mm).norm()).fold(0.0, f64::max);
    let row = |node: u32, component: usize| {
        let arm = (point(node) - centre_mm) / size_mm;
        if component == 0 { Vector3::new(1.0, 0.0, -arm.y) } else { Vector3::new(0.0, 1.0, arm.x) }
    };
    let mut gram = Matrix3::zeros();
    let components = || nodes.iter().flat_map(|&node| [(node, 0), (node, 1)]);
    for (node, component) in components() {
        if held[2 * node as usize + component] {
            let row = row(node, component);
            gram += row * row.transpose();
        }
    }
    let eigen = gram.symmetric_eigen();
    let scale = eigen.eigenvalues.amax().max(1.0);
    let mut motions: Vec<Vector3<f64>> =
        (0..3).filter(|&k| eigen.eigenvalues[k] <= FREE * scale).map(|k| eigen.eigenvectors.column(k).into()).collect();
    // Anchor each motion where it moves most among those still free, and take that movement out of the others.
    let mut anchored = Vec::with_capacity(motions.len());
    for k in 0..motions.len() {
        let own = motions[k];
        let anchor = components()
            .filter(|&(node, component)| !held[2 * node as usize + component])
            .max_by(|a, b| row(a.0, a.1).dot(&own).abs().total_cmp(&row(b.0, b.1).dot(&own).abs()));
        let Some((node, component)) = anchor else { break };
        let pivot = row(node, component).dot(&own);
        for other in motions.iter_mut().skip(k + 1) {
            *other -= own * (row(node, component).dot(other) / pivot);
        }
        anchored.push((own, 2 * node + component as u32));
    }
    anchored
        .into_iter()
        .map(|(amplitude, anchor)| RigidMotion { nodes: nodes.clone(), centre_mm, size_mm, amplitude, anchor })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Element, ElementKind};

    fn two_squares() -> Solid {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let points_mm =
            (0..2).flat_map(|k| corners.map(|[x, y]| Vector2::new(x, y + 2.0 * f64::from(k)))).collect::<Vec<_>>();
        let elements = [[0, 1, 2, 3], [4, 5, 6, 7]].map(|nodes| Element::new(ElementKind::Quad4, &nodes, 0)).to_vec();
        Solid { points_mm, elements }
    }

    #[test]
    fn ver_supports_take_away_motions() {
        let solid = two_squares();
        assert_eq!(bodies(&solid).len(), 2);
        let mut held = vec![false; solid.dofs()];
        assert_eq!(free_motions(&solid, &held).len(), 6);
        // The first square stands still, the second slides along x only.
        held[0] = true;
        held[1] = true;
        held[3] = true;
        held[2 * 4 + 1] = true;
        held[2 * 5 + 1] = true;
        let left = free_motions(&solid, &held);
        assert_eq!(left.len(), 1);
        let moved = left[0].at(solid.points_mm[6]);
        assert!(moved.y.abs() < 1e-12 && moved.x.abs() > 0.5, "{moved}");
        assert_eq!(left[0].anchor % 2, 0);
    }
}
