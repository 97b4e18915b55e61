//! Mesh of a whole gear, or of a sector of several teeth, from the sectors of single teeth.
//!
//! Sectors are turned by multiples of the pitch; neighbours share the nodes of the cut. Tooth 0 stays on
//! +y; teeth are numbered in the sense of rotation of the gear, which differs between pinion and wheel.

use std::f64::consts::PI;

use nalgebra::{Rotation2, Vector2};

use super::{FlankChain, ToothElement, ToothMeshError, ToothSector};
use crate::gear::Gear;
use crate::gear_mesh::settings::Body;

/// The mesh of a gear in its own frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GearMesh {
    /// Nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Elements, tooth by tooth.
    pub cells: Vec<ToothElement>,
    /// The teeth, from the side of the back flanks to that of the working flanks: anticlockwise of an external gear.
    pub teeth: Vec<ToothNodes>,
    /// Cut sides of a sector by increasing radius, the clockwise one first; empty for a ring.
    pub sides: Vec<Vec<u32>>,
}

/// One tooth of a gear: chains of nodes in the orders of [`ToothSector`].
#[derive(Debug, Clone, PartialEq)]
pub struct ToothNodes {
    /// Number of the tooth: 0 in the reference pair, +1 ahead of it, −1 behind it …
    pub index: i32,
    /// Whether its working flank is resolved.
    pub fine: bool,
    /// The flank that touches the mate.
    pub working_flank: FlankChain,
    /// The other flank.
    pub back_flank: FlankChain,
    /// Fillet below the working flank, then below the other.
    pub fillets: [Vec<u32>; 2],
    /// Root arc beside the working fillet, then beside the other.
    pub root_arcs: [Vec<u32>; 2],
    /// Tip land.
    pub tip_land: Vec<u32>,
    /// Part of the clamp circle below it, clockwise.
    pub clamp: Vec<u32>,
}

/// Sense of rotation in the gear's own frame: the pinion turns anticlockwise (+1), the wheel clockwise (−1).
fn sense(gear: Gear) -> i32 {
    match gear {
        Gear::Pinion => 1,
        Gear::Wheel => -1,
    }
}

/// Builds `gear` with `z` teeth, negative of an internal one, from its sectors: those numbered in `fine` from the fine one.
///
/// # Errors
/// [`ToothMeshError::SectorTeeth`] where a sector's number of teeth is even or more than the gear has.
pub fn gear_mesh(
    gear: Gear,
    z: f64,
    body: Body,
    fine: &[i32],
    sectors: [&ToothSector; 2],
) -> Result<GearMesh, ToothMeshError> {
    let teeth = z.abs() as u32;
    let (count, closed) = match body {
        Body::Ring => (teeth, true),
        Body::Sector { teeth: sector_teeth, .. } if sector_teeth % 2 == 1 && sector_teeth <= teeth => {
            // A sector of all teeth has no cuts.
            (sector_teeth, sector_teeth == teeth)
        }
        Body::Sector { teeth: sector_teeth, .. } => return Err(ToothMeshError::SectorTeeth { sector_teeth, teeth }),
    };
    let [fine_sector, coarse_sector] = sectors;
    let mut mesh = GearMesh::default();
    let (mut first_cut, mut last_cut): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
    for place in 0..count {
        // Pitches towards the working flank of the tooth on the axis y, anticlockwise of an external gear.
        let steps = place as i32 - (count as i32 - 1) / 2;
        let index = sense(gear) * steps;
        let is_fine = fine.contains(&index);
        let sector = if is_fine { fine_sector } else { coarse_sector };
        let mut shared: Vec<Option<u32>> = vec![None; sector.points_mm.len()];
        if place > 0 {
            share(&mut shared, &sector.right_cut, &last_cut);
        }
        if closed && place + 1 == count && place > 0 {
            share(&mut shared, &sector.left_cut, &first_cut);
        }
        let turn = Rotation2::new(2.0 * PI * f64::from(steps) / z);
        let ids = mesh.add(sector, &shared, turn);
        if place == 0 {
            first_cut = renumbered(&sector.right_cut, &ids);
        }
        last_cut = renumbered(&sector.left_cut, &ids);
        mesh.teeth.push(ToothNodes::new(index, is_fine, sector, &ids));
    }
    if !closed {
        mesh.sides = vec![first_cut, last_cut];
    }
    Ok(mesh)
}

/// Takes the nodes of a neighbour's cut for those of the own one.
fn share(shared: &mut [Option<u32>], own: &[u32], of_neighbour: &[u32]) {
    for (&own, &other) in own.iter().zip(of_neighbour) {
        shared[own as usize] = Some(other);
    }
}

fn renumbered(nodes: &[u32], ids: &[u32]) -> Vec<u32> {
    nodes.iter().map(|&node| ids[node as usize]).collect()
}

impl GearMesh {
    /// Adds a sector turned by `turn`, except for the nodes it shares; returns the numbers of its nodes.
    fn add(&mut self, sector: &ToothSector, shared: &[Option<u32>], turn: Rotation2<f64>) -> Vec<u32> {
        let ids: Vec<u32> = sector
            .points_mm
            .iter()
            .zip(shared)
            .map(|(&point, shared)| shared.unwrap_or_else(|| super::layer::add(&mut self.points_mm, turn * point)))
            .collect();
        self.cells.extend(sector.cells.iter().map(|cell| cell.renumbered(&ids)));
        ids
    }
}

impl FlankChain {
    fn renumbered(&self, ids: &[u32]) -> Self {
        Self { nodes: renumbered(&self.nodes, ids), ..self.clone() }
    }
}

impl ToothNodes {
    fn new(index: i32, fine: bool, sector: &ToothSector, ids: &[u32]) -> Self {
        Self {
            index,
            fine,
            working_flank: sector.working_flank.renumbered(ids),
            back_flank: sector.back_flank.renumbered(ids),
            fillets: [&sector.working_fillet, &sector.back_fillet].map(|nodes| renumbered(nodes, ids)),
            root_arcs: [&sector.working_root_arc, &sector.back_root_arc].map(|nodes| renumbered(nodes, ids)),
            tip_land: renumbered(&sector.tip_land, ids),
            clamp: renumbered(&sector.clamp, ids),
        }
    }
}
