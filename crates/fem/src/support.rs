//! Whether every body is held: rigid motions that the supports leave free.
//!
//! A stiffness factorises only where no part of the solid can move without strain. Rounding decides whether a factorisation
//! notices that, so it is found beforehand. Elements that share an edge are one *part*; a part moves rigidly in three ways,
//!
//! ```text
//! u = c_x − ω (y − y₀),    v = c_y + ω (x − x₀)
//! ```
//!
//! A held degree of freedom fixes one combination of them, and a node at which parts touch like a hinge equates two
//! combinations of each. The solid is held when these conditions leave no motion: when the sum of their squares is positive
//! definite over the motions of all parts that hang together.

use nalgebra::{DMatrix, Vector2};

use super::disjoint_sets::DisjointSets;
use super::solid::{ElementKind, Solid};

/// Least eigenvalue of the sum of squares, relative to the greatest, that counts as held. With lengths relative to the size
/// of the part it is of the order of the squared fraction of the part that its supports span.
const LEAST_HOLD: f64 = 1e-13;

/// The parts of a solid, and the hinges between them.
#[derive(Debug, Clone)]
pub(super) struct RigidParts {
    points_mm: Vec<Vector2<f64>>,
    /// For each node the parts it belongs to, in rising order; most have one, hinges more, loose nodes none.
    parts_of_node: Vec<NodeParts>,
    count: usize,
}

/// Parts of one node.
#[derive(Debug, Clone, PartialEq)]
enum NodeParts {
    None,
    One(u32),
    Hinge(Vec<u32>),
}

/// A body that can move without strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loose {
    /// The lowest of its nodes.
    pub node: u32,
    /// Held degrees of freedom that it has nevertheless.
    pub held: usize,
}

impl RigidParts {
    pub(super) fn new(solid: &Solid) -> Self {
        let nodes = solid.points_mm.len();
        let mut sets = DisjointSets::new(solid.elements.len());
        let (start, around) = elements_around_nodes(solid);
        let of = |node: u32| &around[start[node as usize]..start[node as usize + 1]];
        for (number, element) in (0..).zip(&solid.elements) {
            let corners = corners(element.kind);
            for a in 0..corners {
                let (p, q) = (element.nodes()[a], element.nodes()[(a + 1) % corners]);
                for other in of(p).iter().filter(|other| **other < number) {
                    if solid.elements[*other as usize].nodes().contains(&q) {
                        sets.join(number, *other);
                    }
                }
            }
        }
        let (part, count) = sets.numbered();
        let parts_of_node = (0..nodes as u32)
            .map(|node| {
                let mut parts: Vec<u32> = of(node).iter().map(|element| part[*element as usize]).collect();
                parts.sort_unstable();
                parts.dedup();
                match parts.as_slice() {
                    [] => NodeParts::None,
                    [one] => NodeParts::One(*one),
                    _ => NodeParts::Hinge(parts),
                }
            })
            .collect();
        Self { points_mm: solid.points_mm.clone(), parts_of_node, count }
    }

    /// Whether any element has the node.
    pub(super) fn has(&self, node: usize) -> bool {
        self.parts_of_node[node] != NodeParts::None
    }

    /// The first body that `held` (one entry for each degree of freedom) does not hold.
    pub(super) fn loose(&self, held: &[bool]) -> Option<Loose> {
        // Bodies: parts joined by hinges.
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
        let mut loose: Vec<Loose> = parts_of_body
            .iter()
            .zip(&nodes_of_body)
            .filter_map(|(parts, nodes)| self.loose_body(parts, nodes, held))
            .collect();
        loose.sort_by_key(|loose| loose.node);
        loose.first().copied()
    }

    /// Whether one body is loose; `parts` and `nodes` in rising order.
    fn loose_body(&self, parts: &[u32], nodes: &[u32], held: &[bool]) -> Option<Loose> {
        let at = |node: u32| self.points_mm[node as usize];
        let centre = nodes.iter().map(|node| at(*node)).sum::<Vector2<f64>>() / nodes.len() as f64;
        let size = nodes.iter().map(|node| (at(*node) - centre).norm()).fold(0.0, f64::max);
        let place = |part: u32| 3 * parts.partition_point(|other| *other < part);
        let motion = |node: u32, component: usize| {
            let arm = (at(node) - centre) / size;
            if component == 0 { [1.0, 0.0, -arm.y] } else { [0.0, 1.0, arm.x] }
        };
        let mut squares = DMatrix::<f64>::zeros(3 * parts.len(), 3 * parts.len());
        let mut fix = |condition: &[(usize, f64)]| {
            for (i, f) in condition {
                for (k, g) in condition {
                    squares[(*i, *k)] += f * g;
                }
            }
        };
        let entries = |part: u32, row: [f64; 3], sign: f64| [0, 1, 2].map(|i| (place(part) + i, sign * row[i]));
        let mut fixed = 0;
        for node in nodes {
            for component in 0..2 {
                let row = motion(*node, component);
                let first = match &self.parts_of_node[*node as usize] {
                    NodeParts::None => continue,
                    NodeParts::One(part) => *part,
                    NodeParts::Hinge(parts) => {
                        for pair in parts.windows(2) {
                            fix(&[entries(pair[0], row, 1.0), entries(pair[1], row, -1.0)].concat());
                        }
                        parts[0]
                    }
                };
                if held[2 * *node as usize + component] {
                    fixed += 1;
                    fix(&entries(first, row, 1.0));
                }
            }
        }
        let eigenvalues = squares.symmetric_eigenvalues();
        let held_fast = eigenvalues.min() > LEAST_HOLD * eigenvalues.max();
        if held_fast { None } else { Some(Loose { node: nodes[0], held: fixed }) }
    }
}

fn corners(kind: ElementKind) -> usize {
    match kind {
        ElementKind::Triangle3 | ElementKind::Triangle6 => 3,
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => 4,
    }
}

/// For each node where its elements start, and the elements.
fn elements_around_nodes(solid: &Solid) -> (Vec<usize>, Vec<u32>) {
    let nodes = solid.points_mm.len();
    let mut start = vec![0usize; nodes + 1];
    for node in solid.elements.iter().flat_map(|element| element.nodes()) {
        start[*node as usize + 1] += 1;
    }
    for node in 0..nodes {
        start[node + 1] += start[node];
    }
    let mut next = start.clone();
    let mut around = vec![0; start[nodes]];
    for (number, element) in (0..).zip(&solid.elements) {
        for node in element.nodes() {
            around[next[*node as usize]] = number;
            next[*node as usize] += 1;
        }
    }
    (start, around)
}
