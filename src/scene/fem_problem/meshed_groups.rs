//! The named groups of a mesh on its bodies: where supports, loads and contacts are.

use std::collections::BTreeSet;

use super::bodies::Meshed;
use super::groups::Groups;
use super::sides::{Side, Sides};
use crate::scene::findings::Findings;

/// Groups, bodies and the sides of their elements: where the other tables of a problem look.
#[derive(Clone, Copy)]
pub(super) struct MeshedGroups<'a> {
    /// The groups.
    pub groups: &'a Groups<'a>,
    /// The bodies.
    pub meshed: &'a Meshed,
    /// The sides of their elements.
    pub sides: &'a Sides,
}

impl MeshedGroups<'_> {
    /// The nodes of bodies in the group that `key` names, in increasing order; reported where there are none, or where the
    /// name stands for cells of several dimensions, of which one was meant.
    pub(super) fn nodes(&self, name: &str, key: &str, findings: &mut Findings) -> Vec<u32> {
        let Some(group) = self.groups.find(name, key, findings) else { return Vec::new() };
        if group.cells.iter().filter(|cells| !cells.is_empty()).count() > 1 {
            let found = format!("{name:?}, which holds {}", group.in_words());
            findings.not_allowed(key, found, "a group of points, of lines or of surfaces, not of both");
            return Vec::new();
        }
        let mut nodes: BTreeSet<u32> = group.nodes.iter().filter_map(|&node| self.meshed.node(node)).collect();
        for &cell in group.cells.iter().flatten() {
            let (_, own) = self.groups.cell(cell);
            nodes.extend(own.iter().filter_map(|&node| self.meshed.node(node)));
            // A line of two nodes along a quadratic element holds the middle node too.
            if let Some(middle) = self.line_side(own).and_then(|side| side.edge.middle) {
                nodes.insert(middle);
            }
        }
        if nodes.is_empty() {
            let found = format!("{name:?}, of which no node belongs to a body");
            findings.not_allowed(key, found, "a group on one of the bodies");
        }
        nodes.into_iter().collect()
    }

    /// The side of an element along the line on these nodes of the mesh (ends, middle).
    pub(super) fn line_side(&self, line: &[usize]) -> Option<&Side> {
        let ends = [self.meshed.node(*line.first()?)?, self.meshed.node(*line.get(1)?)?];
        let side = self.sides.find(ends)?;
        match line.get(2) {
            Some(&middle) => side.edge.middle.is_some_and(|own| Some(own) == self.meshed.node(middle)).then_some(side),
            None => Some(side),
        }
    }
}
