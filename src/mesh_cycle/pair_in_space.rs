//! A pair whose teeth are condensed in space: what couples its slices where that is asked for.
//!
//! The slices of all teeth in contact yield together,
//!
//! ```text
//! u_a = Σ_b U_ab w_b + (q_a − q°_a/cos β_b) w_a
//! ```
//!
//! U is the compliance of both gears in three-dimensional finite elements ([`crate::fem::gear::in_space`]): bending, shear, bodies,
//! neighbouring teeth and free end faces. Its elements are too coarse for what happens close to a line of contact. There, a slice is in
//! plane strain: q° is the compliance of the transverse section on the same elements, q that of the same section as the stiffness model
//! and the contact surface have it, so that their difference is what the elements make wrong, and it is local. Both count in the
//! normal section, where the same load per length of the line of contact gives an approach that is 1/cos β_b times as much along the
//! transverse line of action.

use super::sliced_positions::SliceContact;
use crate::fem::elastic::Elastic;
use crate::fem::gear::in_space::{FlankForces, PlaneSection, SpaceError, TeethInSpace};
use crate::fem::quadrature::GAUSS_3;
use crate::gear::{Gear, GearPair, PerGear, slices::Slices};
use crate::gear_mesh::tooth_section::{ExtrudedTooth, SectionDivisions, ToothSection};

/// Length of an element over the face width, in normal modules.
const LAYER_MODULES: f64 = 0.32;
/// Least and greatest number of them.
const LAYERS: [usize; 2] = [6, 24];

/// Why a pair has no teeth in space.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PairInSpaceError {
    /// The teeth of a gear.
    #[error("{}: {source}", gear.name())]
    Gear {
        /// Whose.
        gear: Gear,
        /// Why.
        source: Box<SpaceError>,
    },
    /// More teeth touch together than a gear has.
    #[error("{}: {needed} teeth may touch together, but it has {teeth}", gear.name())]
    TooFewTeeth {
        /// Whose.
        gear: Gear,
        /// It has.
        teeth: u32,
        /// May touch.
        needed: usize,
    },
}

/// One gear.
struct GearInSpace {
    teeth: TeethInSpace,
    section: PlaneSection,
}

/// Both gears.
pub(crate) struct PairInSpace {
    gears: PerGear<GearInSpace>,
}

/// What couples the contacts of a phase.
pub(crate) struct Influence {
    /// Compliance between all of them by line load, mm²/N, row by row.
    pub mm2_per_n: Vec<f64>,
    /// What finite elements alone give on the diagonal, mm²/N.
    pub of_elements: Vec<f64>,
}

impl PairInSpace {
    /// Condenses both gears, clamped at `clamp_radius_mm`.
    pub(crate) fn new(
        pair: &GearPair,
        material: &PerGear<Elastic>,
        clamp_radius_mm: &PerGear<f64>,
    ) -> Result<Self, PairInSpaceError> {
        let face_width_mm = pair.spec.face_width_mm;
        let layers = (face_width_mm / (LAYER_MODULES * pair.spec.normal_module_mm)).ceil() as usize;
        let layers = layers.clamp(LAYERS[0], LAYERS[1]);
        let tan_base_helix = pair.base_helix_angle_rad().tan();
        let needed = teeth_together(pair);
        let gears = PerGear::try_in_parallel(|gear| {
            let tooth = &pair.teeth[gear];
            if needed > tooth.teeth as usize {
                return Err(PairInSpaceError::TooFewTeeth { gear, teeth: tooth.teeth, needed });
            }
            // Forward on the path of contact is anticlockwise for the pinion.
            let forward = match gear {
                Gear::Pinion => 1.0,
                Gear::Wheel => -1.0,
            };
            let twist = -forward * tan_base_helix / tooth.involute.base_radius_mm;
            let section = ToothSection::new(tooth, clamp_radius_mm[gear], SectionDivisions::USUAL);
            let build = || {
                let plane = PlaneSection::new(tooth, &section, material[gear])?;
                let mesh = ExtrudedTooth::new(section.clone(), face_width_mm, layers, twist);
                let teeth = TeethInSpace::new(tooth, mesh, material[gear], needed)?;
                Ok(GearInSpace { teeth, section: plane })
            };
            build().map_err(|source| PairInSpaceError::Gear { gear, source: Box::new(source) })
        })?;
        Ok(Self { gears })
    }

    /// Nodes of a working flank of each gear.
    pub(crate) fn flank_nodes(&self) -> PerGear<usize> {
        PerGear::from_fn(|gear| self.gears[gear].teeth.flank_nodes())
    }

    /// The coupling of `contacts`, where the transverse section has the compliance `section_mm2_per_n`, flattening included or not.
    pub(crate) fn influence(
        &self,
        pair: &GearPair,
        slices: &Slices,
        contacts: &[SliceContact],
        section_mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Influence {
        let count = contacts.len();
        let base_helix = pair.base_helix_angle_rad();
        let [furthest_before, furthest_after] = pair.farthest_touch_mm();
        let (first_mm, last_mm) = (pair.path.start_mm - furthest_before, pair.path.end_mm + furthest_after);
        let mut of_section = vec![0.0; count];
        let mut forces: Vec<PerGear<FlankForces>> = Vec::with_capacity(count);
        for (contact, of_section) in contacts.iter().zip(&mut of_section) {
            let mut loads = PerGear::from_fn(|_| FlankForces::new());
            for (place, weight) in GAUSS_3 {
                let from_middle_mm = 0.5 * place * slices.slice_width_mm;
                let at_mm = contact.cell.position_mm - from_middle_mm * base_helix.tan();
                let touch = pair.touch(at_mm.clamp(first_mm, last_mm));
                for gear in Gear::BOTH {
                    let radius_mm = pair.teeth[gear].involute.radius_mm(touch.rho_mm[gear]);
                    let z_mm = slices.width_mm[contact.slice] + from_middle_mm;
                    let GearInSpace { teeth, section } = &self.gears[gear];
                    teeth.add_load(radius_mm, z_mm, 0.5 * weight, &mut loads[gear]);
                    *of_section += 0.5 * weight * section.mm2_per_n(radius_mm);
                }
            }
            forces.push(loads);
        }
        let mut mm2_per_n = vec![0.0; count * count];
        for a in 0..count {
            for b in 0..=a {
                let pitches = contacts[b].tooth - contacts[a].tooth;
                let of = |gear: Gear, anticlockwise| {
                    self.gears[gear].teeth.mm_per_n(&forces[a][gear], &forces[b][gear], anticlockwise)
                };
                let value = slices.slice_width_mm * (of(Gear::Pinion, pitches) + of(Gear::Wheel, -pitches));
                mm2_per_n[a * count + b] = value;
                mm2_per_n[b * count + a] = value;
            }
        }
        let of_elements = (0..count).map(|a| mm2_per_n[a * (count + 1)]).collect();
        for (a, contact) in contacts.iter().enumerate() {
            mm2_per_n[a * (count + 1)] += section_mm2_per_n(contact) - of_section[a] / base_helix.cos();
        }
        Influence { mm2_per_n, of_elements }
    }
}

/// Most teeth of a gear that touch at any phase, tip edges included.
fn teeth_together(pair: &GearPair) -> usize {
    let path = &pair.path;
    let over_width_mm = pair.spec.face_width_mm * pair.base_helix_angle_rad().tan().abs();
    let length_mm = path.end_mm - path.start_mm + pair.farthest_touch_mm().iter().sum::<f64>() + over_width_mm;
    (length_mm / path.base_pitch_mm) as usize + 1
}
