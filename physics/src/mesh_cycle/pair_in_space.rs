//! A pair whose teeth are condensed in space, which couples its slices.
//!
//! The slices of all teeth in contact yield together,
//!
//! ```text
//! u = Tᵀ (U + S g S b) T w          g = (q − q°)/cos β_b
//! ```
//!
//! U is the compliance of both gears in three-dimensional finite elements ([`gearwear_bodies::gear_fem::in_space`]): bending, shear, bodies,
//! neighbouring teeth and free end faces, under loads along the pieces of a line of contact in halves of layers of elements. T brings loads of
//! slices onto those halves, and their deflections back ([`super::half_layers`]). The elements are too coarse close to a line of contact, where a
//! slice is in plane strain: q° is the compliance of the transverse section on the same elements, q that of the same section by the stiffness model
//! and the contact surface, and their difference g the local error of the elements. It counts in the
//! normal section, where the same load per length of the line of contact gives an approach that is 1/cos β_b times as much along the
//! transverse line of action. Elements carry the projection S b of a load on their shape functions over the width, and deflect in these alone: the
//! correction is projected likewise.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::DMatrix;

use super::half_layers::HalfLayers;
use super::influence::Influence;
use super::sliced_positions::{ContactPart, SliceContact};
use crate::contact::PositionCell;
use gearwear_bodies::gear::modification::Modification;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, normal_section::Obliquity, slices::Slices, spec::PairSpec};
use gearwear_bodies::gear_fem::in_space::{DeformedTooth, FlankForces, PlaneSection, SpaceError, TeethInSpace};
use gearwear_bodies::gear_mesh::{
    settings::{SpaceBody, SpaceResolution},
    tooth_section::ExtrudedTooth,
};
use gearwear_bodies::material::contact_modulus_mpa;
use gearwear_fem::elastic::Elastic;
use gearwear_fem::quadrature::GAUSS_3;

/// Reason why a pair has no teeth in space.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PairInSpaceError {
    /// A gear cannot be condensed.
    #[error("{}: {source}", gear.name())]
    Gear {
        /// Gear.
        gear: Gear,
        /// Failure.
        source: Box<SpaceError>,
    },
    /// More teeth touch together than a gear has.
    #[error("{}: {needed} teeth may touch together, but it has {teeth}", gear.name())]
    TooFewTeeth {
        /// Gear.
        gear: Gear,
        /// Number of its teeth.
        teeth: u32,
        /// Number of teeth that may touch together.
        needed: usize,
    },
}

impl PairInSpaceError {
    /// The key of a scene to change.
    pub fn scene_key(&self) -> String {
        match self {
            Self::TooFewTeeth { .. } => "pair.face_width_mm".to_owned(),
            Self::Gear { gear, .. } => format!("fem.clamp_radius_mm.{}", gear.name()),
        }
    }
}

/// Teeth in space and transverse section of one gear.
struct GearInSpace {
    teeth: TeethInSpace,
    section: PlaneSection,
}

/// Teeth in space of both gears.
pub struct PairInSpace {
    gears: Arc<PerGear<GearInSpace>>,
    halves: HalfLayers,
    /// Elements over the face width, before those at its end faces are divided.
    even_layers: usize,
    /// Length before A and after E on which there are teeth for every contact, mm.
    reach_mm: [f64; 2],
}

/// Pairs that were condensed last, shared by scenes derived from one another, most of which have the same teeth.
#[derive(Clone, Default)]
pub struct KeptInSpace(Arc<Mutex<Vec<KeptPair>>>);

/// Number of pairs kept: deep reliefs bring one tooth more together than others.
const KEPT: usize = 2;

/// Teeth in space with the data that they depend on.
struct KeptPair {
    of: (PairSpec, PerGear<Elastic>, PerGear<SpaceBody>, [usize; 2]),
    teeth: Arc<PairInSpace>,
}

/// All are equal: kept teeth are no property of a scene.
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
    /// Teeth of `pair` under a line load, meshed for so many slices; condensed unless kept.
    pub fn condensed(
        &self,
        pair: &GearPair,
        material: PerGear<Elastic>,
        bodies: PerGear<SpaceBody>,
        slices: usize,
        line_load_n_per_mm: f64,
    ) -> Result<Arc<PairInSpace>, PairInSpaceError> {
        // A failure of another thread does not concern this pair.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let resolution = SpaceResolution::of_slices(slices);
        let layers = resolution.even_layers(&pair.spec);
        let reach_mm = pair.ample_tip_reach_mm(line_load_n_per_mm, contact_modulus_mpa(material));
        let together = [layers, teeth_together(pair, reach_mm)];
        let of = (teeth_of(&pair.spec), material, bodies, together);
        if let Some(known) = kept.iter().find(|kept| kept.of == of) {
            return Ok(known.teeth.with_reach(reach_mm));
        }
        let teeth = Arc::new(PairInSpace::new(pair, &material, &bodies, &resolution, reach_mm)?);
        kept.truncate(KEPT - 1);
        kept.insert(0, KeptPair { of, teeth: Arc::clone(&teeth) });
        Ok(teeth)
    }
}

/// What teeth in space depend on of a pair: sections are meshed without modifications, and contact ends at the roundings of the tips.
fn teeth_of(pair: &PairSpec) -> PairSpec {
    let mut teeth = pair.on_rigid_parallel_shafts();
    for gear in Gear::BOTH {
        let tip_rounding_mm = teeth.gears[gear].modification.tip_rounding_mm;
        teeth.gears[gear].modification = Modification { tip_rounding_mm, ..Modification::default() };
    }
    teeth
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
            PlaneSection::new(tooth, &mesh.section, material[gear])
                .and_then(|section| {
                    Ok(GearInSpace { section, teeth: TeethInSpace::new(tooth, mesh, material[gear], needed)? })
                })
                .map_err(|source| PairInSpaceError::Gear { gear, source: Box::new(source) })
        })?;
        let halves = HalfLayers::new(&gears.pinion.teeth.layer_ends_mm());
        Ok(Self { gears: Arc::new(gears), halves, even_layers: resolution.even_layers(&pair.spec), reach_mm })
    }

    /// Whether both have the teeth that were condensed once.
    pub fn shares_teeth_with(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.gears, &other.gears)
    }

    /// The same teeth for contact up to another reach, for which there are as many.
    fn with_reach(self: &Arc<Self>, reach_mm: [f64; 2]) -> Arc<Self> {
        if self.reach_mm == reach_mm {
            return Arc::clone(self);
        }
        let (gears, halves) = (Arc::clone(&self.gears), self.halves.clone());
        Arc::new(Self { gears, halves, even_layers: self.even_layers, reach_mm })
    }

    /// Length before A and after E on which contact may be looked for, mm.
    pub fn reach_mm(&self) -> [f64; 2] {
        self.reach_mm
    }

    /// Fewest slices, at least `least`, whose ends coincide with those of elements over the face width.
    pub fn slices_from(&self, least: usize) -> usize {
        least.next_multiple_of(self.even_layers)
    }

    /// Integration points of a contact on each flank: radius, place over the face width, and weight.
    fn points(&self, pair: &GearPair, slices: &Slices, contact: &SliceContact) -> PerGear<Vec<(f64, f64, f64)>> {
        let layer_ends_mm = self.gears.pinion.teeth.layer_ends_mm();
        let base_helix = pair.base_helix_angle_rad();
        let mut points = PerGear::from_fn(|_| Vec::new());
        for (z_mm, weight) in points_of_slice(contact.slice, slices.count(), &layer_ends_mm) {
            let from_middle_mm = z_mm - slices.width_mm[contact.slice];
            let at_mm = contact.cell.position_mm - from_middle_mm * base_helix.tan();
            let touch = pair.touch(on_flanks_mm(pair, at_mm));
            for gear in Gear::BOTH {
                points[gear].push((pair.teeth[gear].involute.radius_mm(touch.rho_mm[gear]), z_mm, weight));
            }
        }
        points
    }

    /// Load of a contact, 1 N in all, as forces on both flanks.
    fn forces(&self, points: &PerGear<Vec<(f64, f64, f64)>>) -> PerGear<FlankForces> {
        PerGear::from_fn(|gear| self.gears[gear].teeth.load(points[gear].iter().copied()))
    }

    /// Reference teeth of both gears, deformed by `contacts`, each with its load, N.
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
            let anticlockwise = if gear == Gear::Pinion { 1 } else { -1 };
            let loads: Vec<(i32, f64, FlankForces)> = contacts
                .iter()
                .zip(&forces)
                .map(|((contact, load_n), forces)| (anticlockwise * contact.tooth, *load_n, forces[gear].clone()))
                .collect();
            let deformed = self.gears[gear].teeth.deformed(&pair.teeth[gear], material[gear], &loads);
            deformed.map_err(|source| PairInSpaceError::Gear { gear, source: Box::new(source) })
        })
    }

    /// Coupling of `contacts`, tooth by tooth, where the transverse section has the compliance `section_mm2_per_n` without its surface.
    pub fn influence(
        &self,
        pair: &GearPair,
        slices: &Slices,
        contacts: &[SliceContact],
        section_mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Influence {
        let mut lines: Vec<LoadedLine> = Vec::new();
        for of_tooth in contacts.chunk_by(|a, b| a.tooth == b.tooth) {
            let first = lines.last().map_or(0, |line| line.first + line.pieces.len());
            lines.push(self.line(pair, slices, of_tooth, first));
        }
        let pieces: Vec<&LinePiece> = lines.iter().flat_map(|line| &line.pieces).collect();
        let mut mm_per_n = self.of_elements(&pieces);
        let parts: Vec<&[(usize, f64)]> = lines.iter().flat_map(|line| &line.parts).map(Vec::as_slice).collect();
        let (count, width_mm) = (contacts.len(), slices.slice_width_mm);
        let of_teeth = (0..count).map(|a| width_mm * between_parts(&mm_per_n, parts[a], parts[a])).collect();
        for line in &lines {
            self.correct(line, pair.obliquity(), &section_mm2_per_n, &mut mm_per_n);
        }
        let mm2_per_n = (0..count * count)
            .map(|k| width_mm * between_parts(&mm_per_n, parts[k / count], parts[k % count]))
            .collect();
        Influence { mm2_per_n, of_teeth }
    }

    /// Line of contact of a tooth on the halves of layers that its contacts load; the first of its pieces has the number `first` among all.
    fn line(&self, pair: &GearPair, slices: &Slices, of_tooth: &[SliceContact], first: usize) -> LoadedLine {
        let mut parts: Vec<Vec<(usize, f64)>> = of_tooth
            .iter()
            .map(|contact| {
                let from = contact.slice as f64;
                self.halves.parts(from * slices.slice_width_mm, (from + 1.0) * slices.slice_width_mm)
            })
            .collect();
        let loaded = parts.iter().flatten().map(|(half, _)| *half);
        let halves = loaded.clone().min().unwrap_or(0)..loaded.max().map_or(0, |last| last + 1);
        parts.iter_mut().flatten().for_each(|(half, _)| *half = *half - halves.start + first);
        let pieces = halves.clone().map(|half| self.piece(pair, slices, of_tooth, half)).collect();
        LoadedLine { first, halves, pieces, parts }
    }

    /// Line of contact of a tooth in one half of a layer, straight on from the contact nearest there.
    fn piece(&self, pair: &GearPair, slices: &Slices, of_tooth: &[SliceContact], half: usize) -> LinePiece {
        let middle_mm = self.halves.middle_mm(half);
        let nearest = of_tooth
            .iter()
            .min_by(|a, b| {
                let [a, b] = [a, b].map(|contact| (slices.width_mm[contact.slice] - middle_mm).abs());
                a.total_cmp(&b)
            })
            .expect("a tooth in contact");
        let line = StraightLine {
            position_mm: nearest.cell.position_mm,
            z_mm: slices.width_mm[nearest.slice],
            tan_base_helix: pair.base_helix_angle_rad().tan(),
        };
        let points = self.halves.points(half).map(|(z_mm, weight)| {
            let touch = pair.touch(on_flanks_mm(pair, line.at_mm(z_mm)));
            (PerGear::from_fn(|gear| pair.teeth[gear].involute.radius_mm(touch.rho_mm[gear])), z_mm, weight)
        });
        let position_mm = on_flanks_mm(pair, line.at_mm(middle_mm));
        let cell = PositionCell { position_mm, lower_mm: position_mm, upper_mm: position_mm };
        LinePiece {
            contact: SliceContact { cell, part: ContactPart::WHOLE, ..*nearest },
            forces: PerGear::from_fn(|gear| {
                let of_gear = points.iter().map(|(radius_mm, z_mm, weight)| (radius_mm[gear], *z_mm, *weight));
                self.gears[gear].teeth.load(of_gear)
            }),
            section_mm2_per_n: Gear::BOTH
                .map(|gear| -> f64 {
                    let section = &self.gears[gear].section;
                    points.iter().map(|(radius_mm, _, weight)| weight * section.mm2_per_n(radius_mm[gear])).sum()
                })
                .iter()
                .sum(),
        }
    }

    /// Compliance of the elements between all pieces, mm/N.
    fn of_elements(&self, pieces: &[&LinePiece]) -> DMatrix<f64> {
        let mut mm_per_n = DMatrix::zeros(pieces.len(), pieces.len());
        for (a, own) in pieces.iter().enumerate() {
            for (b, other) in pieces[..=a].iter().enumerate() {
                let pitches = other.contact.tooth - own.contact.tooth;
                let [pinion, wheel] =
                    [(Gear::Pinion, pitches), (Gear::Wheel, -pitches)].map(|(gear, anticlockwise)| {
                        self.gears[gear].teeth.mm_per_n(&own.forces[gear], &other.forces[gear], anticlockwise)
                    });
                let value = pinion + wheel;
                mm_per_n[(a, b)] = value;
                mm_per_n[(b, a)] = value;
            }
        }
        mm_per_n
    }

    /// Corrects the local error of the elements along a line of contact.
    fn correct(
        &self,
        line: &LoadedLine,
        obliquity: Obliquity,
        section_mm2_per_n: impl Fn(&SliceContact) -> f64,
        mm_per_n: &mut DMatrix<f64>,
    ) {
        let own: Vec<f64> = line
            .pieces
            .iter()
            .map(|piece| section_mm2_per_n(&piece.contact) - obliquity.transverse_mm(piece.section_mm2_per_n))
            .collect();
        // Halves without a piece have the error of the nearest one.
        let halves = line.halves.start..=line.halves.end - 1;
        let of_halves: Vec<f64> = (0..self.halves.count())
            .map(|half| own[half.clamp(*halves.start(), *halves.end()) - halves.start()])
            .collect();
        let seen = self.halves.seen_of(&of_halves, line.halves.clone());
        let count = own.len();
        for (k, value) in seen.into_iter().enumerate() {
            mm_per_n[(line.first + k / count, line.first + k % count)] += value;
        }
    }
}

/// Compliance between two loads that have these parts of pieces, mm/N.
fn between_parts(mm_per_n: &DMatrix<f64>, one: &[(usize, f64)], other: &[(usize, f64)]) -> f64 {
    let of_pieces = one
        .iter()
        .map(|(piece, part)| part * other.iter().map(|(other, part)| part * mm_per_n[(*piece, *other)]).sum::<f64>());
    of_pieces.sum()
}

/// A straight line of contact through a position at a place over the face width.
struct StraightLine {
    position_mm: f64,
    z_mm: f64,
    tan_base_helix: f64,
}

impl StraightLine {
    /// Position at another place over the face width.
    fn at_mm(&self, z_mm: f64) -> f64 {
        self.position_mm - (z_mm - self.z_mm) * self.tan_base_helix
    }
}

/// The line of contact of a tooth, on halves of layers.
struct LoadedLine {
    /// Number of the first piece among those of all lines.
    first: usize,
    /// Loaded halves.
    halves: Range<usize>,
    /// The line in each of them.
    pieces: Vec<LinePiece>,
    /// Pieces, by their number among those of all lines, and their parts of the load of each contact.
    parts: Vec<Vec<(usize, f64)>>,
}

/// A line of contact in half a layer.
struct LinePiece {
    /// Contact at the middle.
    contact: SliceContact,
    /// Load, 1 N in all, on both flanks.
    forces: PerGear<FlankForces>,
    /// Compliance of the transverse sections of both gears on the same elements, mean over the piece, mm²/N.
    section_mm2_per_n: f64,
}

/// Place nearest to `at_mm` at which flanks may touch.
fn on_flanks_mm(pair: &GearPair, at_mm: f64) -> f64 {
    let [furthest_before, furthest_after] = pair.farthest_touch_mm();
    at_mm.clamp(pair.path.start_mm - furthest_before, pair.path.end_mm + furthest_after)
}

/// Integration points of one of `count` slices, three on each piece that lies in one layer: place over the face width, mm, and
/// weight, 1 in all.
fn points_of_slice(slice: usize, count: usize, layer_ends_mm: &[f64]) -> impl Iterator<Item = (f64, f64)> + '_ {
    let width_mm = layer_ends_mm[layer_ends_mm.len() - 1] / count as f64;
    let (first, last) = (slice as f64 * width_mm, (slice + 1) as f64 * width_mm);
    let pieces = layer_ends_mm.windows(2).map(move |ends| (first.max(ends[0]), last.min(ends[1])));
    // Rounding errors make no piece.
    pieces.filter(move |(from, to)| to - from > 1e-9 * width_mm).flat_map(move |(from, to)| {
        GAUSS_3
            .into_iter()
            .map(move |(s, weight)| (0.5 * ((from + to) + (to - from) * s), 0.5 * weight * (to - from) / width_mm))
    })
}

/// Greatest number of teeth of a gear that touch together, with tip edges that do so up to `reach_mm` before A and after E.
fn teeth_together(pair: &GearPair, reach_mm: [f64; 2]) -> usize {
    let path = &pair.path;
    let over_width_mm = pair.spec.face_width_mm * pair.base_helix_angle_rad().tan().abs();
    let length_mm = path.end_mm - path.start_mm + reach_mm.iter().sum::<f64>() + over_width_mm;
    (length_mm / path.base_pitch_mm) as usize + 1
}
