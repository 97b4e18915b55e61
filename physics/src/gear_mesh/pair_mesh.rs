//! Both gears of a pair as one mesh, placed in contact.
//!
//! The pinion's axis is the origin and the wheel's lies at (0, a); the pinion turns anticlockwise. At position ξ (radius
//! of curvature of the pinion at the theoretical contact point) the plain involutes of the reference teeth touch:
//!
//! ```text
//! pinion turned by −ψ₁(r_w1) + (ξ − C)/r_b1 from tooth 0 on +y
//! wheel  turned by −ψ₂(r_w2) − (ξ − C)/r_b2, then by half a turn about its axis
//! ```
//!
//! ψ being half the tooth's angle on the working pitch circle. Modified flanks leave the gap of what is removed there.

use nalgebra::{Rotation2, Vector2};

use super::whole_gear::{GearMesh, ToothNodes, gear_mesh};
use super::{FlankResolution, LEAST_MODULES, SectorSettings, ToothMeshError, ToothSector, ToothShape, sector};
use crate::gear::{Gear, GearPair, PerGear, modification::ReliefShape};
use crate::gear_mesh::settings::{
    BodySettings, DEPTH_HALF_WIDTHS, FILLET_ELEMENTS, MARGIN_HALF_WIDTHS, rounding_element_mm,
};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// Half-widths of flank above the start of active profile that the mate's tip edge touches, early contact included.
const TIP_MEETS_HALF_WIDTHS: f64 = 3.0;
/// Length of the elements where a linear relief begins, on either flank, over that elsewhere.
const AT_KINK: f64 = 1.0 / 3.0;
/// Half-widths from there over which they grow to that: as slowly as the layer of quadrilaterals bears.
const KINK_REACHES_HALF_WIDTHS: f64 = 3.0;

/// The sectors of both gears.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSectors {
    /// With the working flank resolved.
    pub fine: PerGear<ToothSector>,
    /// Without.
    pub coarse: PerGear<ToothSector>,
}

/// Meshes one tooth of each gear, fine and coarse. `half_width_mm`: half-width of contact by position, from A to E.
pub fn pair_sectors(
    pair: &GearPair,
    settings: &BodySettings,
    half_width_mm: &dyn Fn(f64) -> f64,
) -> Result<PairSectors, ToothMeshError> {
    let both = |fine| -> Result<PerGear<ToothSector>, ToothMeshError> {
        Ok(PerGear {
            pinion: gear_sector(pair, Gear::Pinion, fine, settings, half_width_mm)?,
            wheel: gear_sector(pair, Gear::Wheel, fine, settings, half_width_mm)?,
        })
    };
    Ok(PairSectors { fine: both(true)?, coarse: both(false)? })
}

/// Meshes one tooth of `gear`, fine or coarse, as [`pair_sectors`] does. Where the mate's rounded tip edge touches a fine
/// one, about the start of active profile, elements are as short as on that rounding; where a linear relief begins, and on the mate's flank
/// where that meets it, they are a third as long as elsewhere, for the pressure rises there over a small part of the half-width.
pub fn gear_sector(
    pair: &GearPair,
    gear: Gear,
    fine: bool,
    settings: &BodySettings,
    half_width_mm: &dyn Fn(f64) -> f64,
) -> Result<ToothSector, ToothMeshError> {
    let involute = pair.path.involute[gear];
    let start_rho = pair.active_start_rho_mm(gear);
    let on_flank = |rho_mm: f64| {
        // The other gear's radius of curvature gives the position, and the other way round.
        let position_mm = pair.path.rho_mm(gear, rho_mm);
        half_width_mm(position_mm.clamp(pair.path.start_mm, pair.path.end_mm))
    };
    let met_by_tip_mm = involute.arc_mm(start_rho) + TIP_MEETS_HALF_WIDTHS * on_flank(start_rho);
    let rounding_mm = pair.spec.gears[gear.mate()].modification.tip_rounding_mm;
    // Elements on a very small rounding would be shorter than any may be.
    let least_mm = 2.0 * LEAST_MODULES * pair.spec.normal_module_mm * settings.elements_per_half_width;
    // Where contact begins near the base circle of an undercut pinion the half-width falls to nothing.
    let floor_mm = least_mm.min(half_width_mm(pair.path.pitch_point_mm.clamp(pair.path.start_mm, pair.path.end_mm)));
    let at_tip_mm = rounding_element_mm(rounding_mm, 1.0, settings.rounding_refinement).max(least_mm);
    let met_from_mm = involute.arc_mm(start_rho) - MARGIN_HALF_WIDTHS * at_tip_mm;
    let kinks_mm: Vec<f64> = Gear::BOTH
        .into_iter()
        .flat_map(|of| pair.begins_of_reliefs(of).map(move |(rho_mm, shape)| (of, rho_mm, shape)))
        .filter(|&(_, _, shape)| shape == ReliefShape::Linear)
        .map(|(of, rho_mm, _)| pair.path.rho_mm(gear, pair.path.rho_mm(of, rho_mm)))
        .map(|rho_mm| involute.arc_mm(rho_mm.max(0.0)))
        .collect();
    let by_rho = |rho_mm: f64| {
        let (arc_mm, half_width_mm) = (involute.arc_mm(rho_mm), on_flank(rho_mm));
        let at_tip = rounding_mm > 0.0 && (met_from_mm..met_by_tip_mm).contains(&arc_mm);
        let away_mm = kinks_mm.iter().map(|kink_mm| (arc_mm - kink_mm).abs()).fold(f64::INFINITY, f64::min);
        let of_tip_mm = if at_tip { at_tip_mm } else { f64::INFINITY };
        let of_kink = (AT_KINK + (1.0 - AT_KINK) * away_mm / (KINK_REACHES_HALF_WIDTHS * half_width_mm)).min(1.0);
        (of_kink * half_width_mm).min(of_tip_mm).max(floor_mm)
    };
    let flank = FlankResolution {
        half_width_mm: &by_rho,
        elements_per_half_width: settings.elements_per_half_width,
        rounding_refinement: settings.rounding_refinement,
        margin_mm: MARGIN_HALF_WIDTHS * on_flank(start_rho),
        depth_half_widths: DEPTH_HALF_WIDTHS,
    };
    let settings = SectorSettings {
        clamp_radius_mm: settings.clamp_radius_mm[gear],
        fillet_elements: FILLET_ELEMENTS,
        flank: fine.then_some(flank),
    };
    sector(&ToothShape::of(pair, gear), &settings)
}

/// Numbers of the tooth pairs that may touch while the reference pair runs from A to E: 0 that pair itself, +1 the one a
/// base pitch ahead, −1 the one behind …; under a load that closes gaps of tip edges up to `reach_mm` before A and after E
/// ([`GearPair::ample_tip_reach_mm`]).
pub fn touching_pairs(pair: &GearPair, reach_mm: [f64; 2]) -> Vec<i32> {
    let early = reach_mm[0].max(reach_mm[1]) / pair.path.base_pitch_mm;
    let beside = (pair.path.contact_ratio() + early).floor().max(1.0) as i32;
    (-beside..=beside).collect()
}

/// Turn of a gear from tooth 0 on +y to contact at `position_mm`, anticlockwise in the gear's own frame, rad.
pub fn turn_rad(pair: &GearPair, gear: Gear, position_mm: f64) -> f64 {
    let tooth = &pair.teeth[gear];
    let on_pitch_circle = tooth.half_angle_rad(pair.working_pitch_radius_mm(gear));
    let rolled = (position_mm - pair.path.pitch_point_mm) / tooth.involute.base_radius_mm;
    match gear {
        Gear::Pinion => rolled - on_pitch_circle,
        Gear::Wheel => -rolled - on_pitch_circle,
    }
}

/// A point of a gear's own frame, in the frame of the pair with the reference pair in contact at `position_mm`.
pub fn in_place(pair: &GearPair, gear: Gear, position_mm: f64) -> impl Fn(Vector2<f64>) -> Vector2<f64> {
    let turn = Rotation2::new(turn_rad(pair, gear, position_mm));
    let centre_distance_mm = pair.spec.centre_distance_mm;
    move |point| {
        let turned = turn * point;
        match gear {
            Gear::Pinion => turned,
            // The wheel looks down on the pinion.
            Gear::Wheel => Vector2::new(-turned.x, centre_distance_mm - turned.y),
        }
    }
}

/// The mesh of both gears in contact at `position_mm`, `fine` teeth resolved (those of [`touching_pairs`]). Its sets name
/// the bodies (`pinion`, `wheel`) and their surfaces (`pinion-flanks`, `-fillets`, `-roots`, `-tips`, `-clamp`, for a
/// sector `-sides`, and the working flank of each resolved tooth: `pinion-flank-0`, `pinion-flank+1` …). Lines have the
/// body on their left.
pub fn pair_mesh(
    pair: &GearPair,
    settings: &BodySettings,
    sectors: &PairSectors,
    fine: &[i32],
    position_mm: f64,
) -> Result<Mesh, ToothMeshError> {
    let mut blocks = Blocks::default();
    for gear in Gear::BOTH {
        let of_gear = [&sectors.fine[gear], &sectors.coarse[gear]];
        let mesh = gear_mesh(gear, pair.teeth[gear].teeth, settings.body, fine, of_gear)?;
        let place = in_place(pair, gear, position_mm);
        blocks.add(gear, &mesh, place);
    }
    Ok(blocks.mesh)
}

/// Where each block of the mesh stands.
const TRIANGLES: usize = 0;
const QUADS: usize = 1;
const LINES: usize = 2;

struct Blocks {
    mesh: Mesh,
}

impl Default for Blocks {
    fn default() -> Self {
        let block = |kind| CellBlock { kind, nodes: Vec::new() };
        let cells = [CellKind::Triangle6, CellKind::Quad8, CellKind::Line3].map(block).to_vec();
        Self { mesh: Mesh { cells, ..Mesh::default() } }
    }
}

impl Blocks {
    fn add(&mut self, gear: Gear, own: &GearMesh, place: impl Fn(Vector2<f64>) -> Vector2<f64>) {
        let (offset, name) = (self.mesh.points.len(), gear.name());
        self.mesh.points.extend(own.points_mm.iter().map(|&point| {
            let point = place(point);
            [point.x, point.y, 0.0]
        }));
        for cell in &own.cells {
            let block = if cell.kind == CellKind::Quad8 { QUADS } else { TRIANGLES };
            self.push(name, block, cell.nodes(), offset);
        }
        for tooth in &own.teeth {
            self.add_surfaces(name, tooth, offset);
        }
        if let [clockwise, anticlockwise] = &own.sides[..] {
            let sides = format!("{name}-sides");
            self.lines(&[&sides], clockwise, Along::Chain, offset);
            self.lines(&[&sides], anticlockwise, Along::Against, offset);
        }
    }

    fn add_surfaces(&mut self, name: &str, tooth: &ToothNodes, offset: usize) {
        let set = |part: &str| format!("{name}-{part}");
        let own_flank = match tooth.index {
            0 => set("flank-0"),
            index => set(&format!("flank{index:+}")),
        };
        let (flanks, fillets, roots) = (set("flanks"), set("fillets"), set("roots"));
        let working: &[&str] = if tooth.fine { &[&flanks, &own_flank] } else { &[&flanks] };
        self.lines(working, &tooth.working_flank.nodes, Along::Against, offset);
        self.lines(&[&flanks], &tooth.back_flank.nodes, Along::Chain, offset);
        for (set, [on_working_side, on_other_side]) in [(&fillets, &tooth.fillets), (&roots, &tooth.root_arcs)] {
            self.lines(&[set], on_working_side, Along::Against, offset);
            self.lines(&[set], on_other_side, Along::Chain, offset);
        }
        self.lines(&[&set("tips")], &tooth.tip_land, Along::Against, offset);
        self.lines(&[&set("clamp")], &tooth.clamp, Along::Chain, offset);
    }

    /// The edges of a chain, all in `sets`.
    fn lines(&mut self, sets: &[&str], chain: &[u32], along: Along, offset: usize) {
        for edge in chain.windows(3).step_by(2) {
            let (first, last) = match along {
                Along::Chain => (edge[0], edge[2]),
                Along::Against => (edge[2], edge[0]),
            };
            let number = self.mesh.cells[LINES].len();
            self.mesh.cells[LINES].nodes.extend([first, last, edge[1]].map(|node| node as usize + offset));
            for set in sets {
                self.name(set, LINES, number);
            }
        }
    }

    fn push(&mut self, set: &str, block: usize, nodes: &[u32], offset: usize) {
        let number = self.mesh.cells[block].len();
        self.mesh.cells[block].nodes.extend(nodes.iter().map(|&node| node as usize + offset));
        self.name(set, block, number);
    }

    fn name(&mut self, set: &str, block: usize, number: usize) {
        let blocks = self.mesh.cells.len();
        let cells = self.mesh.cell_sets.entry(set.to_owned()).or_insert_with(|| vec![Vec::new(); blocks]);
        cells[block].push(number);
    }
}

/// Direction of lines on a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Along {
    /// That of the chain, the body on its left.
    Chain,
    /// The opposite one.
    Against,
}
