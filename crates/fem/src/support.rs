//! Check for rigid motions that the supports leave free.
//!
//! A stiffness can be factorised only where no part of the solid can move without strain. As rounding may hide that in a
//! factorisation, it is checked before. Elements that share an edge are one *part*; a part has three rigid motions,
//!
//! ```text
//! u = c_x − ω (y − y₀),    v = c_y + ω (x − x₀)
//! ```
//!
//! A held degree of freedom fixes one combination of them, and a node that parts share as a hinge equates two
//! combinations of each. The solid is held where these conditions leave no motion: where the sum of their squares is positive
//! definite over the motions of all connected parts.

use nalgebra::{DMatrix, Vector2, Vector3};

use super::disjoint_sets::DisjointSets;
use super::elastic::Analysis;
use super::incidence::Incidence;
use super::rigid_body::{BodyFrame, straining};
use super::solid::{ElementKind, Solid};

/// Least ratio of the least to the greatest eigenvalue of the sum of squares. With lengths relative to the size
/// of the part the ratio is of the order of the squared fraction of the part that its supports span.
const LEAST_HOLD: f64 = 1e-13;

/// Parts of a solid, and the hinges between them.
#[derive(Debug, Clone)]
pub(super) struct RigidParts {
    points_mm: Vec<Vector2<f64>>,
    /// Parts of each node.
    parts_of_node: Vec<NodeParts>,
    count: usize,
    analysis: Analysis,
}

/// Parts that a node belongs to, in rising order.
#[derive(Debug, Clone, PartialEq)]
enum NodeParts {
    None,
    One(u32),
    Hinge(Vec<u32>),
}

/// Body that can move without strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loose {
    /// Lowest node.
    pub node: u32,
    /// Number of held degrees of freedom.
    pub held: usize,
}

impl RigidParts {
    pub(super) fn new(solid: &Solid, analysis: Analysis) -> Self {
        let nodes = solid.points_mm.len();
        let mut sets = DisjointSets::new(solid.elements.len());
        let around = Incidence::new(nodes, || solid.elements.iter().map(|element| element.nodes()));
        for (number, element) in (0..).zip(&solid.elements) {
            let corners = corners(element.kind);
            for a in 0..corners {
                let (p, q) = (element.nodes()[a], element.nodes()[(a + 1) % corners]);
                for other in around.of(p as usize).iter().filter(|other| **other < number) {
                    if solid.elements[*other as usize].nodes().contains(&q) {
                        sets.join(number, *other);
                    }
                }
            }
        }
        let (part, count) = sets.numbered();
        let parts_of_node = (0..nodes)
            .map(|node| {
                let mut parts: Vec<u32> = around.of(node).iter().map(|element| part[*element as usize]).collect();
                parts.sort_unstable();
                parts.dedup();
                match parts.as_slice() {
                    [] => NodeParts::None,
                    [one] => NodeParts::One(*one),
                    _ => NodeParts::Hinge(parts),
                }
            })
            .collect();
        Self { points_mm: solid.points_mm.clone(), parts_of_node, count, analysis }
    }

    /// Whether the node belongs to an element.
    pub(super) fn has(&self, node: usize) -> bool {
        self.parts_of_node[node] != NodeParts::None
    }

    /// First body, by its lowest node, that `held` (one entry for each degree of freedom) does not hold.
    pub(super) fn loose(&self, held: &[bool]) -> Option<Loose> {
        // Bodies are parts joined by hinges.
        let mut sets = DisjointSets::new(self.count);
        for parts in &self.parts_of_node {
            if let NodeParts::Hinge(parts) = parts {
                for pair in parts.windows(2) {
                    sets.join(pair[0], pair[1]);
                }
            }
        }
        let (body, bodies) = sets.numbered();
        let mut parts_of_body: Vec<Vec<u32>> = vec![Vec::new(); bodies];
        for (part, body) in (0..).zip(&body) {
            parts_of_body[*body as usize].push(part);
        }
        let mut nodes_of_body: Vec<Vec<u32>> = vec![Vec::new(); bodies];
        for (node, parts) in (0..).zip(&self.parts_of_node) {
            match parts {
                NodeParts::None => {}
                NodeParts::One(part) => nodes_of_body[body[*part as usize] as usize].push(node),
                NodeParts::Hinge(parts) => nodes_of_body[body[parts[0] as usize] as usize].push(node),
            }
        }
        let bodies = parts_of_body.iter().zip(&nodes_of_body);
        bodies.filter_map(|(parts, nodes)| self.loose_body(parts, nodes, held)).min_by_key(|loose| loose.node)
    }

    /// Body of these `parts` and `nodes`, in rising order, where it is loose.
    fn loose_body(&self, parts: &[u32], nodes: &[u32], held: &[bool]) -> Option<Loose> {
        let frame = BodyFrame::new(&self.points_mm, nodes);
        let mut conditions = Conditions { parts, squares: DMatrix::zeros(3 * parts.len(), 3 * parts.len()) };
        let mut fixed = 0;
        for part in parts {
            straining(self.analysis).iter().for_each(|motion| conditions.add(&[(*part, 1.0)], *motion));
        }
        for node in nodes {
            for component in 0..2 {
                let row = frame.row(self.points_mm[*node as usize], component);
                let first = match &self.parts_of_node[*node as usize] {
                    NodeParts::None => continue,
                    NodeParts::One(part) => *part,
                    NodeParts::Hinge(parts) => {
                        for pair in parts.windows(2) {
                            conditions.add(&[(pair[0], 1.0), (pair[1], -1.0)], row);
                        }
                        parts[0]
                    }
                };
                if held[2 * *node as usize + component] {
                    fixed += 1;
                    conditions.add(&[(first, 1.0)], row);
                }
            }
        }
        let squares = conditions.squares;
        let eigenvalues = squares.symmetric_eigenvalues();
        let held_fast = eigenvalues.min() > LEAST_HOLD * eigenvalues.max();
        if held_fast { None } else { Some(Loose { node: nodes[0], held: fixed }) }
    }
}

/// Sum of squares of the conditions on the motions of a body's parts.
struct Conditions<'a> {
    parts: &'a [u32],
    squares: DMatrix<f64>,
}

impl Conditions<'_> {
    /// Adds the condition that the combinations `row` of the motions of parts, with signs, add up to zero.
    fn add(&mut self, parts: &[(u32, f64)], row: Vector3<f64>) {
        for (p, f) in parts {
            for (q, g) in parts {
                let [p, q] = [p, q].map(|part| 3 * self.parts.partition_point(|other| other < part));
                let mut block = self.squares.fixed_view_mut::<3, 3>(p, q);
                block += (*f * row) * (*g * row).transpose();
            }
        }
    }
}

fn corners(kind: ElementKind) -> usize {
    match kind {
        ElementKind::Triangle3 | ElementKind::Triangle6 => 3,
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => 4,
    }
}
