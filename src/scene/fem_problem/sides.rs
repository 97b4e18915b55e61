//! The sides of the elements: which of them lie on the surface, and on which side of each its body lies.

use std::collections::BTreeMap;

use gearwear_fem::problem::Edge;
use gearwear_fem::solid::{Element, ElementKind, Solid};

/// A side that one or two elements have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodySide {
    /// Along the first of them, which lies on its left.
    pub edge: Edge,
    /// The elements.
    pub elements: [Option<usize>; 2],
    /// How many there are: two, unless the mesh is not conforming.
    pub count: usize,
}

/// All sides of a solid, by their ends.
pub(super) struct Sides {
    by_ends: BTreeMap<[u32; 2], BodySide>,
}

impl Sides {
    /// Collects the sides of all elements.
    pub(super) fn of(solid: &Solid) -> Self {
        let mut by_ends: BTreeMap<[u32; 2], BodySide> = BTreeMap::new();
        for (number, element) in solid.elements.iter().enumerate() {
            for edge in edges(element) {
                by_ends
                    .entry(sorted(edge.ends))
                    .and_modify(|side| {
                        side.elements[1].get_or_insert(number);
                        side.count += 1;
                    })
                    .or_insert(BodySide { edge, elements: [Some(number), None], count: 1 });
            }
        }
        Self { by_ends }
    }

    /// The side between two nodes, in either order.
    pub(super) fn find(&self, ends: [u32; 2]) -> Option<&BodySide> {
        self.by_ends.get(&sorted(ends))
    }

    /// The sides of one element only, in the order of their nodes: the surface.
    pub(super) fn surface(&self) -> impl Iterator<Item = &BodySide> {
        self.by_ends.values().filter(|side| side.is_on_surface())
    }
}

impl BodySide {
    /// Whether no second element lies behind it.
    pub(super) fn is_on_surface(&self) -> bool {
        self.count == 1
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Corners of an element.
pub(super) fn corners(kind: ElementKind) -> usize {
    match kind {
        ElementKind::Triangle3 | ElementKind::Triangle6 => 3,
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => 4,
    }
}

/// The sides of an element, itself on the left of each.
pub(super) fn edges(element: &Element) -> impl Iterator<Item = Edge> + '_ {
    let nodes = element.nodes();
    let corners = corners(element.kind);
    (0..corners)
        .map(move |i| Edge { ends: [nodes[i], nodes[(i + 1) % corners]], middle: nodes.get(corners + i).copied() })
}
