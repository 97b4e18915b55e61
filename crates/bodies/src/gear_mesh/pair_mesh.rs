//! Mesh of both gears of a pair, placed in contact.
//!
//! The pinion's axis is the origin and the wheel's lies at (0, a); the pinion turns anticlockwise. At position ξ (radius
//! of curvature of the pinion at the theoretical contact point) the plain involutes of the reference teeth touch:
//!
//! ```text
//! pinion turned by −ψ₁(r_w1) + (ξ − C)/r_b1 from tooth 0 on +y
//! wheel  turned by −ψ₂(r_w2) − (ξ − C)/r_b2, then by half a turn about its axis
//! ```
//!
//! ψ being half the tooth's angle on the working pitch circle, negative as a, r_b2 and all radii of an internal wheel are, whose tooth 0 is on −y. Between modified flanks there is a gap of the material removed there.

use std::ops::Range;

use nalgebra::{Rotation2, Vector2};

use super::whole_gear::{GearMesh, ToothNodes, gear_mesh};
use super::{FlankResolution, LEAST_MODULES, SectorSettings, ToothMeshError, ToothSector, ToothShape, sector};
use crate::gear::{Gear, GearPair, PerGear};
use crate::gear_mesh::settings::{
    AT_KINK, BodySettings, DEPTH_HALF_WIDTHS, FILLET_ELEMENTS, MARGIN_HALF_WIDTHS, rounding_element_mm,
};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// Arc of flank above the start of active profile that the mate's tip edge touches, early contact included, in half-widths.
const TIP_MEETS_HALF_WIDTHS: f64 = 3.0;
/// Distance over which elements grow from there to the usual length, in half-widths: slow enough for the layer of quadrilaterals.
const KINK_REACHES_HALF_WIDTHS: f64 = 3.0;

/// The sectors of both gears.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSectors {
    /// Sectors with the working flank resolved.
    pub fine: PerGear<ToothSector>,
    /// Sectors without.
    pub coarse: PerGear<ToothSector>,
}

/// Meshes one tooth of each gear, fine and coarse. `half_width_mm`: half-width of contact by position, from A to E.
pub fn pair_sectors(
    pair: &GearPair,
    settings: &BodySettings,
    half_width_mm: &dyn Fn(f64) -> f64,
) -> Result<PairSectors, ToothMeshError> {
    let of = |gear, fine| gear_sector(pair, gear, fine, settings, half_width_mm);
    Ok(PairSectors {
        fine: PerGear { pinion: of(Gear::Pinion, true)?, wheel: of(Gear::Wheel, true)? },
        coarse: PerGear { pinion: of(Gear::Pinion, false)?, wheel: of(Gear::Wheel, false)? },
    })
}

/// Meshes one tooth of `gear`, fine or coarse, as [`pair_sectors`] does.
pub fn gear_sector(
    pair: &GearPair,
    gear: Gear,
    fine: bool,
    settings: &BodySettings,
    half_width_mm: &dyn Fn(f64) -> f64,
) -> Result<ToothSector, ToothMeshError> {
    let resolved = ResolvedHalfWidth::new(pair, gear, settings, half_width_mm);
    let flank = FlankResolution {
        half_width_mm: &|rho_mm| resolved.at_rho(rho_mm),
        elements_per_half_width: settings.elements_per_half_width,
        rounding_refinement: settings.rounding_refinement,
        margin_mm: MARGIN_HALF_WIDTHS * resolved.of_contact_mm(pair.active_start_rho_mm(gear)),
        depth_half_widths: DEPTH_HALF_WIDTHS,
    };
    let settings = SectorSettings {
        clamp_radius_mm: settings.clamp_radius_mm[gear],
        fillet_elements: FILLET_ELEMENTS,
        flank: fine.then_some(flank),
    };
    sector(&ToothShape::of(pair, gear), &settings)
}

/// Half-width that elements of a working flank resolve: that of the contact, shortened where the mate's rounded tip edge touches, about the
/// start of active profile, to that on the rounding, and to a third where a linear relief of either gear begins, as the pressure rises
/// there over a small part of the half-width.
struct ResolvedHalfWidth<'a> {
    pair: &'a GearPair,
    gear: Gear,
    half_width_mm: &'a dyn Fn(f64) -> f64,
    /// Arc of flank that the mate's rounded tip edge touches; empty without a rounding.
    tip_arc_mm: Range<f64>,
    /// Half-width on the mate's rounding.
    at_tip_mm: f64,
    /// Arc lengths where linear reliefs begin.
    kinks_mm: Vec<f64>,
    /// Least half-width: near the base circle of an undercut pinion that of the contact falls to nothing.
    floor_mm: f64,
}

impl<'a> ResolvedHalfWidth<'a> {
    fn new(pair: &'a GearPair, gear: Gear, settings: &BodySettings, half_width_mm: &'a dyn Fn(f64) -> f64) -> Self {
        let path = &pair.path;
        let rounding_mm = pair.spec.gears[gear.mate()].modification.tip_rounding_mm;
        // Elements on a very small rounding would be shorter than any may be.
        let least_mm = 2.0 * LEAST_MODULES * pair.spec.normal_module_mm * settings.elements_per_half_width;
        let kinks_mm = Gear::BOTH
            .into_iter()
            .flat_map(|of| pair.kinks(of).map(move |kink| path.rho_mm(gear, path.rho_mm(of, kink.rho_mm))))
            .map(|rho_mm| path.involute[gear].arc_mm(path.involute[gear].on_flank_mm(rho_mm)))
            .collect();
        let mut resolved = Self {
            pair,
            gear,
            half_width_mm,
            tip_arc_mm: 0.0..0.0,
            at_tip_mm: rounding_element_mm(rounding_mm, 1.0, settings.rounding_refinement).max(least_mm),
            kinks_mm,
            floor_mm: least_mm.min(half_width_mm(path.pitch_point_mm.clamp(path.start_mm, path.end_mm))),
        };
        if rounding_mm > 0.0 {
            let start_rho = pair.active_start_rho_mm(gear);
            let start_mm = path.involute[gear].arc_mm(start_rho);
            resolved.tip_arc_mm = start_mm - MARGIN_HALF_WIDTHS * resolved.at_tip_mm
                ..start_mm + TIP_MEETS_HALF_WIDTHS * resolved.of_contact_mm(start_rho);
        }
        resolved
    }

    /// Half-width of the contact by the flank's radius of curvature.
    fn of_contact_mm(&self, rho_mm: f64) -> f64 {
        // Radii of curvature of pinion and wheel add up to the same length: `rho_mm` of a gear's ρ is the position.
        let position_mm = self.pair.path.rho_mm(self.gear, rho_mm);
        (self.half_width_mm)(position_mm.clamp(self.pair.path.start_mm, self.pair.path.end_mm))
    }

    /// Resolved half-width by the flank's radius of curvature.
    fn at_rho(&self, rho_mm: f64) -> f64 {
        let (arc_mm, half_width_mm) = (self.pair.path.involute[self.gear].arc_mm(rho_mm), self.of_contact_mm(rho_mm));
        let away_mm = self.kinks_mm.iter().map(|kink_mm| (arc_mm - kink_mm).abs()).fold(f64::INFINITY, f64::min);
        let of_tip_mm = if self.tip_arc_mm.contains(&arc_mm) { self.at_tip_mm } else { f64::INFINITY };
        let of_kink = (AT_KINK + (1.0 - AT_KINK) * away_mm / (KINK_REACHES_HALF_WIDTHS * half_width_mm)).min(1.0);
        (of_kink * half_width_mm).min(of_tip_mm).max(self.floor_mm)
    }
}

/// Numbers of the tooth pairs that may touch while the reference pair runs from A to E: 0 the reference pair, +1 the pair a
/// base pitch ahead, −1 the pair behind … Tip edges touch up to `reach_mm` before A and after E under load
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

/// Map from a gear's own frame to that of the pair with the reference pair in contact at `position_mm`.
pub fn in_place(pair: &GearPair, gear: Gear, position_mm: f64) -> impl Fn(Vector2<f64>) -> Vector2<f64> {
    let turn = Rotation2::new(turn_rad(pair, gear, position_mm));
    let centre_distance_mm = pair.spec.centre_distance_mm;
    move |point| {
        let turned = turn * point;
        match gear {
            Gear::Pinion => turned,
            // Half a turn about the wheel's axis.
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
        let mesh = gear_mesh(gear, pair.teeth[gear].z(), settings.body, fine, of_gear)?;
        blocks.add(gear, &mesh, in_place(pair, gear, position_mm));
    }
    Ok(blocks.mesh)
}

// Numbers of the blocks of the mesh.
const TRIANGLES: usize = 0;
const QUADS: usize = 1;
const LINES: usize = 2;

struct Blocks {
    mesh: Mesh,
}

impl Default for Blocks {
    fn default() -> Self {
        let kinds = [CellKind::Triangle6, CellKind::Quad8, CellKind::Line3];
        let cells = kinds.map(|kind| CellBlock::new(kind, Vec::new())).to_vec();
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
        let own_flank = match tooth.index {
            0 => format!("{name}-flank-0"),
            index => format!("{name}-flank{index:+}"),
        };
        let [flanks, fillets, roots, tips, clamp] =
            ["flanks", "fillets", "roots", "tips", "clamp"].map(|part| format!("{name}-{part}"));
        let working: &[&str] = if tooth.fine { &[&flanks, &own_flank] } else { &[&flanks] };
        self.lines(working, &tooth.working_flank.nodes, Along::Against, offset);
        self.lines(&[&flanks], &tooth.back_flank.nodes, Along::Chain, offset);
        for (set, [on_working_side, on_other_side]) in [(&fillets, &tooth.fillets), (&roots, &tooth.root_arcs)] {
            self.lines(&[set], on_working_side, Along::Against, offset);
            self.lines(&[set], on_other_side, Along::Chain, offset);
        }
        self.lines(&[&tips], &tooth.tip_land, Along::Against, offset);
        self.lines(&[&clamp], &tooth.clamp, Along::Chain, offset);
    }

    /// Adds the edges of a chain to the mesh and to all `sets`.
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

    /// Adds an element to a block and to `set`.
    fn push(&mut self, set: &str, block: usize, nodes: &[u32], offset: usize) {
        let number = self.mesh.cells[block].len();
        self.mesh.cells[block].nodes.extend(nodes.iter().map(|&node| node as usize + offset));
        self.name(set, block, number);
    }

    /// Adds cell `number` of a block to `set`.
    fn name(&mut self, set: &str, block: usize, number: usize) {
        let blocks = self.mesh.cells.len();
        let cells = self.mesh.cell_sets.entry(set.to_owned()).or_insert_with(|| vec![Vec::new(); blocks]);
        cells[block].push(number);
    }
}

/// Direction of lines along a chain, the body on their left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Along {
    /// Direction of the chain.
    Chain,
    /// Opposite direction.
    Against,
}
