//! One pitch of each gear over the face width as one mesh, placed in contact.
//!
//! Place and frame are those of [`super::pair_mesh`] in the middle of the face width; the axes are along z, and the face width is from
//! z = 0 on.

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
        let numbered = |nodes: Vec<u32>| nodes.into_iter().map(|node| first + node as usize).collect::<Vec<_>>();
        let [right, left] = &tooth.section.cuts;
        for (set, nodes) in
            [("flank", &tooth.section.flank), ("clamp", &tooth.section.clamp), ("right_cut", right), ("left_cut", left)]
        {
            let mut nodes = numbered(tooth.over(nodes));
            nodes.sort_unstable();
            mesh.point_sets.insert(format!("{name}_{set}"), nodes);
        }
        let nodes = numbered(tooth.hexahedra.iter().flatten().copied().collect());
        mesh.cells.push(CellBlock { kind: CellKind::Hexahedron20, nodes });
    }
    let all = |block: usize| (0..mesh.cells[block].len()).collect::<Vec<_>>();
    mesh.cell_sets = BTreeMap::from([
        (Gear::Pinion.name().to_owned(), vec![all(0), Vec::new()]),
        (Gear::Wheel.name().to_owned(), vec![Vec::new(), all(1)]),
    ]);
    mesh
}
