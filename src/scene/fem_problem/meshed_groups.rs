//! The named groups of a mesh on its bodies: where supports, loads and contacts are.

use std::collections::{BTreeMap, BTreeSet};

use super::file::Component;
use super::groups::Groups;
use super::owned_cells::BodyNodes;
use crate::scene::findings::Findings;
use crate::scene::problem::number;

/// The bodies of a problem, as supports and loads see them.
pub(super) trait MeshedBodies {
    /// Directions in which a node moves.
    const DIRECTIONS: usize;
    /// The cells over which a force is spread: `lines`.
    const CARRIER: &'static str;
    /// Name of such a cell in relation to an element: its `side`.
    const PART: &'static str;
    /// The cells that are: `lines along the elements of a body`.
    const PARTS: &'static str;

    /// Nodes of the bodies.
    fn nodes(&self) -> &BodyNodes;

    /// The middle nodes that quadratic elements have along a cell on these nodes of the mesh, which may be linear.
    fn middles(&self, cell: &[usize]) -> Vec<u32>;

    /// The share that each node takes of a force spread evenly over cells on these nodes of the mesh; together 1. `None` where one of them
    /// is no part of an element.
    fn spread<'m>(&self, cells: impl Iterator<Item = &'m [usize]>) -> Option<BTreeMap<u32, f64>>;
}

/// Groups and bodies of a problem.
pub(super) struct MeshedGroups<'a, B> {
    /// The groups.
    pub groups: &'a Groups<'a>,
    /// The bodies.
    pub bodies: &'a B,
}

impl<B: MeshedBodies> MeshedGroups<'_, B> {
    /// The nodes of bodies in the group that `key` names, in increasing order; reported where there are none, or where the
    /// name stands for cells of several dimensions, of which one was meant.
    pub(super) fn nodes(&self, name: &str, key: &str, findings: &mut Findings) -> Vec<u32> {
        let Some(group) = self.groups.find(name, key, findings) else { return Vec::new() };
        if group.cells.iter().filter(|cells| !cells.is_empty()).count() > 1 {
            let found = format!("{name:?}, which holds {}", group.in_words());
            findings.not_allowed(key, found, "a group of points, of lines or of surfaces, not of both");
            return Vec::new();
        }
        let numbers = self.bodies.nodes();
        let mut nodes: BTreeSet<u32> = group.nodes.iter().filter_map(|&node| numbers.node(node)).collect();
        for &cell in group.cells.iter().flatten() {
            let (_, own) = self.groups.cell(cell);
            nodes.extend(own.iter().filter_map(|&node| numbers.node(node)));
            // A line of two nodes along a quadratic element holds the middle node too.
            nodes.extend(self.bodies.middles(own));
        }
        if nodes.is_empty() {
            let found = format!("{name:?}, of which no node belongs to a body");
            findings.not_allowed(key, found, "a group on one of the bodies");
        }
        nodes.into_iter().collect()
    }

    /// Where a node lies, in words: `x = 1, y = 2`.
    pub(super) fn place(&self, node: u32) -> String {
        place(&self.bodies.nodes().points_mm[node as usize][..B::DIRECTIONS])
    }
}

/// Coordinates in words.
pub(super) fn place(at_mm: &[f64]) -> String {
    let words = Component::ALL.iter().zip(at_mm).map(|(along, value)| format!("{} = {}", along.name(), number(*value)));
    words.collect::<Vec<_>>().join(", ")
}

impl<B> Clone for MeshedGroups<'_, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B> Copy for MeshedGroups<'_, B> {}
