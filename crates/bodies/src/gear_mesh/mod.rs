//! Finite-element mesh of one pitch of a gear: the sector between the cuts through the middles of the two spaces
//! beside a tooth, from the outline down to the circle where the body is clamped.
//!
//! Frame: the gear's axis at the origin, the tooth's centre line on +y. The working flank is the anticlockwise one
//! (x < 0), for both gears. All elements are quadratic; all nodes of the surface, those in the middle of edges included,
//! lie on the true profile: involute less the removed material, root trochoid, arcs of the root, tip and clamp circles,
//! and the true circle of the tip rounding.
//!
//! An internal gear has negative radii and angles in the same equations: its tooth lies on −y, the tip towards +y and the axis, the clamp circle
//! is its outside, and "clockwise" on a cut is x > 0 as on an external gear.
//!
//! A **fine** sector resolves the working flank from a margin below the start of active profile to the tip with a given
//! number of elements in the local half-width of contact: a layer of structured elements on the flank, six-node
//! triangles below it. A **coarse** sector has the same shape without that and with sharp tip edges. Both have the same nodes on both cuts,
//! at radii that depend on the gear alone, so that sectors turned by a pitch join exactly.

mod assembly;
mod boundary_circles;
mod cut;
mod error;
mod interior;
mod layer;
mod neighbours;
mod outline;
pub mod pair_mesh;
mod profile;
pub mod settings;
mod size_field;
mod space_mesh;
mod spacing;
pub mod tooth_section;
mod whole_gear;

use std::ops::Range;

use nalgebra::Vector2;

pub use error::ToothMeshError;
pub use pair_mesh::{gear_sector, pair_mesh, pair_sectors, touching_pairs, turn_rad};
pub use space_mesh::space_mesh;
pub use whole_gear::{GearMesh, gear_mesh};

use crate::gear::{Gear, GearPair, modification::Modification, tooth::Tooth};
use cut::Cut;
use gearwear_mesh::CellKind;
use outline::Outline;
use profile::Profile;

/// Rate at which element lengths grow along the outline and into the body of a fine sector: neighbours differ by a
/// factor of about 1.3.
const GROWTH: f64 = 0.25;
/// Growth rate of a coarse sector.
const COARSE_GROWTH: f64 = 0.4;
/// Longest element, in modules.
const GREATEST_MODULES: f64 = 0.5;

/// Shortest element, in modules.
const LEAST_MODULES: f64 = 2e-4;

/// The gear whose tooth is meshed.
#[derive(Debug, Clone, Copy)]
pub struct ToothShape<'a> {
    /// Circles and curves.
    pub tooth: &'a Tooth,
    /// Deviations from the involute.
    pub modification: &'a Modification,
    /// ρ of the start of active profile, mm.
    pub active_start_rho_mm: f64,
    /// Normal module m_n, mm.
    pub normal_module_mm: f64,
}

/// How a sector is meshed.
#[derive(Clone, Copy)]
pub struct SectorSettings<'a> {
    /// Inner radius of the mesh, where the body is clamped.
    pub clamp_radius_mm: f64,
    /// Elements along each fillet of a fine sector.
    pub fillet_elements: u32,
    /// Resolution of the working flank; `None` for a coarse sector.
    pub flank: Option<FlankResolution<'a>>,
}

/// Resolution of a working flank.
#[derive(Clone, Copy)]
pub struct FlankResolution<'a> {
    /// Half-width of contact by the flank's radius of curvature, mm.
    pub half_width_mm: &'a dyn Fn(f64) -> f64,
    /// Elements per half-width.
    pub elements_per_half_width: f64,
    /// [`BodySettings::rounding_refinement`](settings::BodySettings::rounding_refinement).
    pub rounding_refinement: f64,
    /// Arc length below the start of active profile at which the resolved part begins, mm.
    pub margin_mm: f64,
    /// Depth of the structured layer in half-widths.
    pub depth_half_widths: f64,
}

/// One element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ToothElement {
    /// [`CellKind::Triangle6`] or [`CellKind::Quad8`].
    pub kind: CellKind,
    /// Nodes, of which the first [`CellKind::node_count`] are used.
    nodes: [u32; 8],
}

/// A flank with its tip rounding as a chain of nodes. Equal ones have the same bits, NaN included.
#[derive(Debug, Clone, Default)]
pub struct FlankChain {
    /// Ends and middles of elements alternately, from the end of the fillet to the tip circle.
    pub nodes: Vec<u32>,
    /// Radius of curvature ρ of the involute at each node, mm; NaN on the rounding.
    pub rho_mm: Vec<f64>,
    /// The part on the involute.
    pub involute: Range<usize>,
    /// The part that is resolved, from below the start of active profile to the tip circle; empty where none is.
    pub resolved: Range<usize>,
}

/// The mesh of one pitch. Chains alternate between ends and middles of elements.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothSector {
    /// Nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Elements.
    pub cells: Vec<ToothElement>,
    /// The flank that touches the mate, x < 0.
    pub working_flank: FlankChain,
    /// The other flank.
    pub back_flank: FlankChain,
    /// Fillet below the working flank, from the root arc up.
    pub working_fillet: Vec<u32>,
    /// Fillet below the other flank, from the root arc up.
    pub back_fillet: Vec<u32>,
    /// Arc of the root circle beside the working fillet, from the cut; empty where the fillets of a space meet.
    pub working_root_arc: Vec<u32>,
    /// Arc of the root circle beside the other fillet, from the cut.
    pub back_root_arc: Vec<u32>,
    /// Tip land, from the working flank to the other; empty where the roundings meet.
    pub tip_land: Vec<u32>,
    /// Cut on the working flank's side by increasing radius: node for node the right cut turned by a pitch.
    pub left_cut: Vec<u32>,
    /// Cut on the other side by increasing radius.
    pub right_cut: Vec<u32>,
    /// Clamp circle, from the left cut to the right one.
    pub clamp: Vec<u32>,
}

impl SectorSettings<'_> {
    fn growth(&self) -> f64 {
        if self.flank.is_some() { GROWTH } else { COARSE_GROWTH }
    }
}

impl ToothElement {
    fn triangle(corners: [u32; 3], middles: [u32; 3]) -> Self {
        let ([a, b, c], [ab, bc, ca]) = (corners, middles);
        Self { kind: CellKind::Triangle6, nodes: [a, b, c, ab, bc, ca, 0, 0] }
    }

    /// The cell with node `k` renumbered to `ids[k]`.
    fn renumbered(&self, ids: &[u32]) -> Self {
        let mut nodes = [0; 8];
        for (new, &old) in nodes.iter_mut().zip(self.nodes()) {
            *new = ids[old as usize];
        }
        Self { kind: self.kind, nodes }
    }

    /// Nodes, corners first.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.node_count()]
    }
}

impl PartialEq for FlankChain {
    fn eq(&self, other: &Self) -> bool {
        fn bits(chain: &FlankChain) -> impl Iterator<Item = u64> {
            chain.rho_mm.iter().map(|rho| rho.to_bits())
        }
        self.nodes == other.nodes
            && self.involute == other.involute
            && self.resolved == other.resolved
            && bits(self).eq(bits(other))
    }
}

impl FlankChain {
    /// The nodes of the resolved part with their radii of curvature.
    pub fn resolved_nodes(&self) -> (&[u32], &[f64]) {
        (&self.nodes[self.resolved.clone()], &self.rho_mm[self.resolved.clone()])
    }
}

impl ToothSector {
    /// Number of degrees of freedom.
    pub fn dofs(&self) -> usize {
        2 * self.points_mm.len()
    }
}

impl<'a> ToothShape<'a> {
    /// The tooth of one gear of `pair`.
    pub fn of(pair: &'a GearPair, gear: Gear) -> Self {
        Self {
            tooth: &pair.teeth[gear],
            modification: &pair.spec.gears[gear].modification,
            active_start_rho_mm: pair.active_start_rho_mm(gear),
            normal_module_mm: pair.spec.normal_module_mm,
        }
    }
}

/// Meshes one pitch of a gear.
///
/// # Errors
/// [`ToothMeshError`] where the clamp circle, the resolution or the shape of the tooth leave no mesh.
pub fn sector(shape: &ToothShape, settings: &SectorSettings) -> Result<ToothSector, ToothMeshError> {
    check(settings)?;
    // A coarse tooth is never in contact: a rounded tip edge would only add nodes.
    let rounding_mm = if settings.flank.is_none() { 0.0 } else { shape.modification.tip_rounding_mm };
    let profile = Profile::new(shape.tooth, shape.modification, shape.active_start_rho_mm)?.rounded(rounding_mm)?;
    let outline = Outline::new(shape, settings, &profile)?;
    let cut = Cut::new(shape, settings.clamp_radius_mm, outline.at_cut_mm)?;
    assembly::assemble(shape, settings, &outline, &cut)
}

fn check(settings: &SectorSettings) -> Result<(), ToothMeshError> {
    let mut positive = vec![("fillet_elements", f64::from(settings.fillet_elements))];
    if let Some(flank) = &settings.flank {
        positive.push(("elements_per_half_width", flank.elements_per_half_width));
        positive.push(("depth_half_widths", flank.depth_half_widths));
    }
    match positive.into_iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        Some((what, value)) => Err(ToothMeshError::NotPositive { what, value }),
        None => Ok(()),
    }
}
