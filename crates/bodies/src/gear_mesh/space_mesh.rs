//! One pitch of each gear over the face width as one mesh, placed in contact.
//!
//! Frame: that of [`super::pair_mesh`] in the middle of the face width, the axes along z; the face width begins at z = 0.

use std::collections::BTreeMap;

use super::pair_mesh::in_place;
use super::tooth_section::ExtrudedTooth;
use crate::gear::{Gear, GearPair, PerGear};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// The reference teeth of `pair` in contact at `position_mm`. Cell sets: each gear; point sets: its working flank, its clamp
/// circle and both cuts.
pub fn space_mesh(pair: &GearPair, teeth: &PerGear<ExtrudedTooth>, position_mm: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for gear in Gear::BOTH {
        let (tooth, place, name) = (&teeth[gear], in_place(pair, gear, position_mm), gear.name());
        let first = mesh.points.len();
        mesh.points.extend(tooth.points_mm.iter().map(|point| {
            let placed = place(point.xy());
            [placed.x, placed.y, point.z]
        }));
        let [right, left] = &tooth.section.cuts;
        for (set, nodes) in
            [("flank", &tooth.section.flank), ("clamp", &tooth.section.clamp), ("right_cut", right), ("left_cut", left)]
        {
            let mut nodes: Vec<usize> = tooth.over(nodes).into_iter().map(|node| first + node as usize).collect();
            nodes.sort_unstable();
            mesh.point_sets.insert(format!("{name}_{set}"), nodes);
        }
        let nodes = tooth.hexahedra.iter().flatten().map(|node| first + *node as usize).collect();
        mesh.cells.push(CellBlock::new(CellKind::Hexahedron20, nodes));
    }
    let [pinion, wheel] = [0, 1].map(|block| (0..mesh.cells[block].len()).collect());
    mesh.cell_sets = BTreeMap::from([
        (Gear::Pinion.name().to_owned(), vec![pinion, Vec::new()]),
        (Gear::Wheel.name().to_owned(), vec![Vec::new(), wheel]),
    ]);
    mesh
}
