//! Rigid motions that no support prevents.
//!
//! A plane body has three rigid motions u(x) = t + ω ẑ × (x − c)/L, with c its centre and L its size, so that all
//! three amplitudes are lengths; of a body of revolution the one along its axis is the only one, as the others strain it. Supports prevent those that would move a held degree of freedom; the free ones are
//! the null space of the held components. A body with free motions is anchored at as many degrees
//! of freedom, and its motions are unknowns of the contact problem, with the balance of
//! the loads along each as equation. In equilibrium the anchors carry no force.
//!
//! Source: C. Farhat and F.-X. Roux, *Int. J. Numer. Meth. Eng.* 32 (1991) 1205–1227 (floating subdomains).

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector2, Vector3};

use super::disjoint_sets::DisjointSets;
use super::elastic::Analysis;
use super::solid::Solid;

/// Relative size of held components below which a motion is free.
const FREE: f64 = 1e-10;

/// Centre c and size L of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyFrame {
    centre_mm: Vector2<f64>,
    size_mm: f64,
}

impl BodyFrame {
    /// Mean of the body's nodes and their greatest distance from it.
    pub(super) fn new(points_mm: &[Vector2<f64>], nodes: &[u32]) -> Self {
        let points = nodes.iter().map(|&node| points_mm[node as usize]);
        let centre_mm = points.clone().sum::<Vector2<f64>>() / nodes.len() as f64;
        let size_mm = points.map(|point| (point - centre_mm).norm()).fold(0.0, f64::max);
        Self { centre_mm, size_mm }
    }

    /// Displacement component of a point per amplitude of both translations and of the rotation.
    pub(super) fn row(&self, point_mm: Vector2<f64>, component: usize) -> Vector3<f64> {
        let arm = (point_mm - self.centre_mm) / self.size_mm;
        if component == 0 { Vector3::new(1.0, 0.0, -arm.y) } else { Vector3::new(0.0, 1.0, arm.x) }
    }
}

/// One free rigid motion of one body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RigidMotion {
    /// Nodes of the body.
    pub nodes: Vec<u32>,
    frame: BodyFrame,
    /// Amplitudes of both translations and the rotation.
    amplitude: Vector3<f64>,
    /// Degree of freedom that anchors the motion.
    pub anchor: u32,
}

impl RigidMotion {
    /// Displacement per amplitude at a point of the body.
    pub(crate) fn at(&self, point_mm: Vector2<f64>) -> Vector2<f64> {
        let arm = (point_mm - self.frame.centre_mm) / self.frame.size_mm;
        Vector2::new(self.amplitude.x - self.amplitude.z * arm.y, self.amplitude.y + self.amplitude.z * arm.x)
    }
}

/// Description of the motion with these amplitudes of `motions`; of several bodies, of the one that moves most.
pub(crate) fn describe(motions: &[RigidMotion], amplitudes: &[f64]) -> String {
    let moving = motions.iter().map(|motion| {
        let own = motions.iter().zip(amplitudes).filter(|(other, _)| other.nodes == motion.nodes);
        let sum: Vector3<f64> = own.map(|(other, amplitude)| *amplitude * other.amplitude).sum();
        (motion.frame, sum)
    });
    let Some((frame, amplitude)) = moving.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) else {
        return "nothing moves freely".to_owned();
    };
    let (x, y) = (frame.centre_mm.x, frame.centre_mm.y);
    let shift = Vector2::new(amplitude.x, amplitude.y);
    // A motion t + ω ẑ × r/L is a rotation about r = L ẑ × t/ω, or a translation where that is far away.
    let arm = frame.size_mm * Vector2::new(-shift.y, shift.x) / amplitude.z;
    if amplitude.z.abs() > 1e-3 * shift.norm() {
        format!("the body around ({x:.4}, {y:.4}) mm turns freely about ({:.4}, {:.4}) mm", x + arm.x, y + arm.y)
    } else {
        let along = shift / shift.norm();
        format!("the body around ({x:.4}, {y:.4}) mm moves freely along ({:.3}, {:.3})", along.x, along.y)
    }
}

/// Nodes of each body, connected through elements, by increasing number.
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

/// Free rigid motions of all bodies of `solid` with the degrees of freedom `held`.
pub(crate) fn free_motions(solid: &Solid, held: &[bool], analysis: Analysis) -> Vec<RigidMotion> {
    bodies(solid).into_iter().flat_map(|nodes| free_motions_of(solid, nodes, held, analysis)).collect()
}

/// Motions (both translations, rotation) that strain a body whatever holds it: of a body of revolution those but along its axis.
pub(super) fn straining(analysis: Analysis) -> &'static [Vector3<f64>] {
    const OF_REVOLUTION: [Vector3<f64>; 2] = [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];
    if analysis == Analysis::Axisymmetric { &OF_REVOLUTION } else { &[] }
}

fn free_motions_of(solid: &Solid, nodes: Vec<u32>, held: &[bool], analysis: Analysis) -> Vec<RigidMotion> {
    let frame = BodyFrame::new(&solid.points_mm, &nodes);
    let dofs = nodes.iter().flat_map(|node| [2 * node, 2 * node + 1]);
    let (held, free): (Vec<_>, Vec<_>) = dofs
        .map(|dof| (dof, frame.row(solid.points_mm[dof as usize / 2], dof as usize % 2)))
        .partition(|(dof, _)| held[*dof as usize]);
    let mut gram = Matrix3::zeros();
    for row in held.iter().map(|(_, row)| row).chain(straining(analysis)) {
        gram += row * row.transpose();
    }
    let eigen = gram.symmetric_eigen();
    let scale = eigen.eigenvalues.amax().max(1.0);
    let mut motions: Vec<Vector3<f64>> =
        (0..3).filter(|&k| eigen.eigenvalues[k] <= FREE * scale).map(|k| eigen.eigenvectors.column(k).into()).collect();
    // Each motion is anchored at the free degree of freedom that it moves most, whose movement is removed from the others.
    let mut anchored = Vec::with_capacity(motions.len());
    for k in 0..motions.len() {
        let own = motions[k];
        let anchor = free.iter().max_by(|(_, a), (_, b)| a.dot(&own).abs().total_cmp(&b.dot(&own).abs()));
        let Some((anchor, row)) = anchor else { break };
        let pivot = row.dot(&own);
        for other in motions.iter_mut().skip(k + 1) {
            *other -= own * (row.dot(other) / pivot);
        }
        anchored.push(RigidMotion { nodes: nodes.clone(), frame, amplitude: own, anchor: *anchor });
    }
    anchored
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
        let along_axis = free_motions(&solid, &held, Analysis::Axisymmetric);
        assert!(along_axis.len() == 2 && along_axis[0].at(solid.points_mm[2]) == Vector2::y());
        assert_eq!(free_motions(&solid, &held, Analysis::PlaneStrain).len(), 6);
        // The first square stands still, the second slides along x only.
        held[0] = true;
        held[1] = true;
        held[3] = true;
        held[2 * 4 + 1] = true;
        held[2 * 5 + 1] = true;
        let left = free_motions(&solid, &held, Analysis::PlaneStrain);
        assert_eq!(left.len(), 1);
        let moved = left[0].at(solid.points_mm[6]);
        assert!(moved.y.abs() < 1e-12 && moved.x.abs() > 0.5, "{moved}");
        assert_eq!(left[0].anchor % 2, 0);
    }
}
