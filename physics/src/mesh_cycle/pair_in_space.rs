//! A pair whose teeth are condensed in space: what couples its slices where that is asked for.
//!
//! The slices of all teeth in contact yield together,
//!
//! ```text
//! u = U w + ½ (g P + P g) w          g = (q − q°)/cos β_b
//! ```
//!
//! U is the compliance of both gears in three-dimensional finite elements ([`crate::fem::gear::in_space`]): bending, shear, bodies,
//! neighbouring teeth and free end faces. Its elements are too coarse for what happens close to a line of contact. There, a slice is in
//! plane strain: q° is the compliance of the transverse section on the same elements, q that of the same section as the stiffness model
//! and the contact surface have it, so that their difference g is what the elements make wrong, and it is local. It counts in the
//! normal section, where the same load per length of the line of contact gives an approach that is 1/cos β_b times as much along the
//! transverse line of action. The elements see of a load its projection P on their shape functions over the width alone, and are
//! corrected for no more.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::DMatrix;

use super::influence::Influence;
use super::sliced_positions::SliceContact;
use crate::fem::elastic::{self, Elastic};
use crate::fem::gear::in_space::{DeformedTooth, FlankForces, PlaneSection, SpaceError, TeethInSpace};
use crate::fem::quadrature::GAUSS_3;
use crate::fem::shape::along_edge;
use crate::gear::{Gear, GearPair, PerGear, slices::Slices, spec::PairSpec};
use crate::gear_mesh::{
    settings::{SpaceBody, SpaceResolution},
    tooth_section::ExtrudedTooth,
};

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
pub struct PairInSpace {
    gears: PerGear<GearInSpace>,
    /// Elements over the face width, before those at its end faces are divided.
    even_layers: usize,
    /// How far before A and after E there are teeth for every contact.
    reach_mm: [f64; 2],
}

/// The pair that was condensed last, shared by the scenes that were made of one another: most of them have the same teeth.
#[derive(Clone, Default)]
pub struct KeptInSpace(Arc<Mutex<Option<Kept>>>);

/// Both gears, and what they are made of.
struct Kept {
    of: (PairSpec, PerGear<Elastic>, PerGear<SpaceBody>, [usize; 2]),
    teeth: Arc<PairInSpace>,
}

/// What is kept says nothing of a scene.
impl PartialEq for KeptInSpace {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for KeptInSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("KeptInSpace")
    }
}

impl KeptInSpace {
    /// The teeth of `pair` under a line load, meshed for so many slices, condensed unless they are kept.
    pub fn condensed(
        &self,
        pair: &GearPair,
        material: PerGear<Elastic>,
        bodies: PerGear<SpaceBody>,
        slices: usize,
        line_load_n_per_mm: f64,
    ) -> Result<Arc<PairInSpace>, PairInSpaceError> {
        // Another thread may have failed at its pair: that says nothing of this one.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let resolution = SpaceResolution::of_slices(slices);
        let layers = resolution.even_layers(&pair.spec);
        let reach_mm = pair.ample_tip_reach_mm(line_load_n_per_mm, elastic::contact_modulus_mpa(&material));
        let together = [layers, teeth_together(pair, reach_mm)];
        let of = (pair.spec.on_rigid_parallel_shafts(), material, bodies, together);
        if let Some(Kept { teeth, .. }) = kept.as_ref().filter(|kept| kept.of == of) {
            return Ok(Arc::clone(teeth));
        }
        let teeth = Arc::new(PairInSpace::new(pair, &material, &bodies, &resolution, reach_mm)?);
        *kept = Some(Kept { of, teeth: Arc::clone(&teeth) });
        Ok(teeth)
    }
}

impl PairInSpace {
    /// Condenses both gears with their bodies, for contact up to `reach_mm` before A and after E.
    pub fn new(
        pair: &GearPair,
        material: &PerGear<Elastic>,
        bodies: &PerGear<SpaceBody>,
        resolution: &SpaceResolution,
        reach_mm: [f64; 2],
    ) -> Result<Self, PairInSpaceError> {
        let needed = teeth_together(pair, reach_mm);
        for gear in Gear::BOTH {
            let teeth = pair.teeth[gear].teeth;
            if needed > teeth as usize {
                return Err(PairInSpaceError::TooFewTeeth { gear, teeth, needed });
            }
        }
        let gears = PerGear::try_in_parallel(|gear| {
            let tooth = &pair.teeth[gear];
            let mesh = ExtrudedTooth::of_gear(pair, gear, bodies, resolution);
            let build = || {
                let section = PlaneSection::new(tooth, &mesh.section, material[gear])?;
                Ok(GearInSpace { section, teeth: TeethInSpace::new(tooth, mesh, material[gear], needed)? })
            };
            build().map_err(|source| PairInSpaceError::Gear { gear, source: Box::new(source) })
        })?;
        Ok(Self { gears, even_layers: resolution.even_layers(&pair.spec), reach_mm })
    }

    /// How far before A and after E contact may be looked for, mm of path.
    pub fn reach_mm(&self) -> [f64; 2] {
        self.reach_mm
    }

    /// The fewest slices, no fewer than `least`, that the elements over the face width end with.
    pub fn slices_from(&self, least: usize) -> usize {
        least.next_multiple_of(self.even_layers)
    }

    /// Points of integration of a contact on each flank: radius, place over the face width, and weight.
    fn points(&self, pair: &GearPair, slices: &Slices, contact: &SliceContact) -> PerGear<Vec<(f64, f64, f64)>> {
        let layer_ends_mm = self.gears.pinion.teeth.layer_ends_mm();
        let base_helix = pair.base_helix_angle_rad();
        let [furthest_before, furthest_after] = pair.farthest_touch_mm();
        let (first_mm, last_mm) = (pair.path.start_mm - furthest_before, pair.path.end_mm + furthest_after);
        let mut points = PerGear::from_fn(|_| Vec::new());
        for (_, z_mm, weight) in points_of_slice(contact.slice, slices.count(), &layer_ends_mm) {
            let from_middle_mm = z_mm - slices.width_mm[contact.slice];
            let at_mm = contact.cell.position_mm - from_middle_mm * base_helix.tan();
            let touch = pair.touch(at_mm.clamp(first_mm, last_mm));
            for gear in Gear::BOTH {
                points[gear].push((pair.teeth[gear].involute.radius_mm(touch.rho_mm[gear]), z_mm, weight));
            }
        }
        points
    }

    /// The load of a contact, 1 N in all, as forces on both flanks.
    fn forces(&self, points: &PerGear<Vec<(f64, f64, f64)>>) -> PerGear<FlankForces> {
        PerGear::from_fn(|gear| self.gears[gear].teeth.load(points[gear].iter().copied()))
    }

    /// The reference teeth of both gears, deformed by `contacts`, each with its load, N.
    pub fn deformed(
        &self,
        pair: &GearPair,
        material: &PerGear<Elastic>,
        slices: &Slices,
        contacts: &[(SliceContact, f64)],
    ) -> Result<PerGear<DeformedTooth>, PairInSpaceError> {
        let forces: Vec<PerGear<FlankForces>> =
            contacts.iter().map(|(contact, _)| self.forces(&self.points(pair, slices, contact))).collect();
        PerGear::try_in_parallel(|gear| {
            // A tooth ahead on the path of contact is anticlockwise on the pinion.
            let anticlockwise = |ahead: i32| if gear == Gear::Pinion { ahead } else { -ahead };
            let loads: Vec<(i32, f64, FlankForces)> = contacts
                .iter()
                .zip(&forces)
                .map(|((contact, load_n), forces)| (anticlockwise(contact.tooth), *load_n, forces[gear].clone()))
                .collect();
            let deformed = self.gears[gear].teeth.deformed(&pair.teeth[gear], material[gear], &loads);
            deformed.map_err(|source| PairInSpaceError::Gear { gear, source: Box::new(source) })
        })
    }

    /// P: what the elements see of the loads of `count` slices, row by row.
    pub fn seen(&self, count: usize) -> Vec<f64> {
        projection(count, &self.gears.pinion.teeth.layer_ends_mm())
    }

    /// The coupling of `contacts`, where the transverse section has the compliance `section_mm2_per_n` beside its surface; `seen` is that of
    /// these slices.
    pub fn influence(
        &self,
        pair: &GearPair,
        slices: &Slices,
        seen: &[f64],
        contacts: &[SliceContact],
        section_mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Influence {
        let count = contacts.len();
        let base_helix = pair.base_helix_angle_rad();
        let mut of_section = Vec::with_capacity(count);
        let mut forces: Vec<PerGear<FlankForces>> = Vec::with_capacity(count);
        for contact in contacts {
            let points = self.points(pair, slices, contact);
            let of_gear = |gear: Gear| -> f64 {
                let section = &self.gears[gear].section;
                points[gear].iter().map(|(radius_mm, _, weight)| weight * section.mm2_per_n(*radius_mm)).sum()
            };
            of_section.push(of_gear(Gear::Pinion) + of_gear(Gear::Wheel));
            forces.push(self.forces(&points));
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
        let of_teeth = (0..count).map(|a| mm2_per_n[a * (count + 1)]).collect();
        let wrong: Vec<f64> = contacts
            .iter()
            .zip(&of_section)
            .map(|(contact, of_section)| section_mm2_per_n(contact) - of_section / base_helix.cos())
            .collect();
        for a in 0..count {
            for b in (0..count).filter(|b| contacts[*b].tooth == contacts[a].tooth) {
                let seen = seen[contacts[a].slice * slices.count() + contacts[b].slice];
                mm2_per_n[a * count + b] += 0.5 * (wrong[a] + wrong[b]) * seen;
            }
        }
        Influence { mm2_per_n, of_teeth }
    }
}

/// Points of integration of one of `count` slices, three on each piece that lies in one layer: its layer, its place over the face width, mm, and its
/// weight, 1 in all.
fn points_of_slice(slice: usize, count: usize, layer_ends_mm: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> + '_ {
    let width_mm = layer_ends_mm[layer_ends_mm.len() - 1] / count as f64;
    let (first, last) = (slice as f64 * width_mm, (slice + 1) as f64 * width_mm);
    let pieces = layer_ends_mm.windows(2).enumerate().map(move |(k, ends)| (k, first.max(ends[0]), last.min(ends[1])));
    // What is left of rounding makes no piece.
    pieces.filter(move |(_, from, to)| to - from > 1e-9 * width_mm).flat_map(move |(layer, from, to)| {
        GAUSS_3.into_iter().map(move |(s, weight)| {
            (layer, 0.5 * ((from + to) + (to - from) * s), 0.5 * weight * (to - from) / width_mm)
        })
    })
}

/// The projection of `count` loads, each even over its slice, on the quadratic shape functions of layers that end there, averaged over the slices;
/// row by row.
fn projection(count: usize, layer_ends_mm: &[f64]) -> Vec<f64> {
    let layers = layer_ends_mm.len() - 1;
    let nodes = 2 * layers + 1;
    let mut mass = DMatrix::<f64>::zeros(nodes, nodes);
    let length_mm = |layer: usize| layer_ends_mm[layer + 1] - layer_ends_mm[layer];
    for layer in 0..layers {
        for (s, weight) in GAUSS_3 {
            let ([start, end, middle], _) = along_edge(true, s);
            let values = [start, middle, end];
            for (i, f) in values.iter().enumerate() {
                for (j, g) in values.iter().enumerate() {
                    mass[(2 * layer + i, 2 * layer + j)] += 0.5 * length_mm(layer) * weight * f * g;
                }
            }
        }
    }
    let width_mm = layer_ends_mm[layers] / count as f64;
    let mut means = DMatrix::<f64>::zeros(nodes, count);
    for slice in 0..count {
        for (layer, at_mm, weight) in points_of_slice(slice, count, layer_ends_mm) {
            let place = (at_mm - layer_ends_mm[layer]) / length_mm(layer);
            let ([start, end, middle], _) = along_edge(true, 2.0 * place - 1.0);
            for (i, value) in [start, middle, end].into_iter().enumerate() {
                means[(2 * layer + i, slice)] += weight * value;
            }
        }
    }
    // The mass of independent functions is positive definite.
    let solved = mass.cholesky().expect("the functions are independent").solve(&means);
    let product = means.transpose() * solved * width_mm;
    (0..count * count).map(|k| product[(k / count, k % count)]).collect()
}

/// Most teeth of a gear that touch at any phase, tip edges included, which do so up to `reach_mm` before A and after E.
fn teeth_together(pair: &GearPair, reach_mm: [f64; 2]) -> usize {
    let path = &pair.path;
    let over_width_mm = pair.spec.face_width_mm * pair.base_helix_angle_rad().tan().abs();
    let length_mm = path.end_mm - path.start_mm + reach_mm.iter().sum::<f64>() + over_width_mm;
    (length_mm / path.base_pitch_mm) as usize + 1
}
