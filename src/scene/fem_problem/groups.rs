//! Named groups of a mesh, sets and integers at its cells: their cells and nodes, and the message where a name is unknown.

use std::collections::BTreeMap;

use crate::scene::findings::Findings;
use crate::scene::nearest::nearest;
use gearwear_mesh::{CellKind, Mesh, tag_groups};

/// Greatest number of groups named in a message.
const MOST_NAMED: usize = 20;

/// A cell of the mesh: its block, and its number within the block.
pub(super) type CellRef = (usize, usize);

/// Cells and nodes of a group.
#[derive(Debug, Clone, Default)]
pub(super) struct NamedGroup {
    /// Cells by dimension: points, lines, surfaces, volumes.
    pub cells: [Vec<CellRef>; 4],
    /// Nodes, where it is a set of nodes.
    pub nodes: Vec<usize>,
}

/// All groups of a mesh.
pub(super) struct Groups<'a> {
    mesh: &'a Mesh,
    by_name: BTreeMap<String, NamedGroup>,
}

impl<'a> Groups<'a> {
    /// Collects the groups of `mesh`.
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let mut by_name: BTreeMap<String, NamedGroup> = BTreeMap::new();
        let numbered = tag_groups(mesh);
        let numbered = numbered.iter().map(|group| (&group.name, &group.lists));
        for (name, blocks) in mesh.cell_sets.iter().chain(numbered) {
            let group = by_name.entry(name.clone()).or_default();
            for (block, numbers) in blocks.iter().enumerate() {
                let Some(cells) = mesh.cells.get(block) else { continue };
                let within = numbers.iter().copied().filter(|&cell| cell < cells.len());
                group.cells[usize::from(cells.kind.dimension())].extend(within.map(|cell| (block, cell)));
            }
        }
        for (name, nodes) in &mesh.point_sets {
            by_name.entry(name.clone()).or_default().nodes.extend(nodes);
        }
        Self { mesh, by_name }
    }

    /// The group of this name.
    pub(super) fn get(&self, name: &str) -> Option<&NamedGroup> {
        self.by_name.get(name)
    }

    /// The group that the value of `key` names; reported where there is none.
    pub(super) fn find(&self, name: &str, key: &str, findings: &mut Findings) -> Option<&NamedGroup> {
        let found = self.get(name);
        if found.is_none() {
            let names: Vec<&str> = self.by_name.keys().map(String::as_str).collect();
            findings.not_allowed(key, format!("{name:?}, which the mesh does not have"), self.named());
            if let Some(near) = nearest(name, &names) {
                findings.help(format!("did you mean {near:?}?"));
            }
        }
        found
    }

    /// The mesh's groups in words: `cylinder (1200 surfaces), top (20 lines)`.
    fn named(&self) -> String {
        if self.by_name.is_empty() {
            return "groups of the mesh, of which it has none: give its parts names as physical groups or sets"
                .to_owned();
        }
        let shown = self.by_name.iter().take(MOST_NAMED);
        let mut words: Vec<String> = shown.map(|(name, group)| format!("{name} ({})", group.in_words())).collect();
        if self.by_name.len() > MOST_NAMED {
            words.push(format!("and {} more", self.by_name.len() - MOST_NAMED));
        }
        words.join(", ")
    }

    /// Kind and nodes of a cell.
    pub(super) fn cell(&self, (block, cell): CellRef) -> (CellKind, &'a [usize]) {
        let block = &self.mesh.cells[block];
        let count = block.kind.node_count();
        (block.kind, &block.nodes[cell * count..(cell + 1) * count])
    }
}

impl NamedGroup {
    /// Contents in words: `20 lines`, `1 point and 3 nodes`.
    pub(super) fn in_words(&self) -> String {
        let kinds = ["point", "line", "surface", "volume"];
        let cells = kinds.iter().zip(&self.cells).map(|(kind, cells)| (*kind, cells.len()));
        let counts = cells.chain([("node", self.nodes.len())]).filter(|(_, count)| *count > 0);
        let words: Vec<String> =
            counts.map(|(kind, count)| format!("{count} {kind}{}", if count == 1 { "" } else { "s" })).collect();
        if words.is_empty() { "nothing".to_owned() } else { words.join(" and ") }
    }
}
