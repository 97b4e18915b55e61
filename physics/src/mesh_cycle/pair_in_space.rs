//! A pair whose teeth are condensed in space: what couples its slices where that is asked for.
//!
//! The slices of all teeth in contact yield together,
//!
//! ```text
//! u = Tᵀ (U + S g S b) T w          g = (q − q°)/cos β_b
//! ```
//!
//! U is the compliance of both gears in three-dimensional finite elements ([`crate::gear_fem::in_space`]): bending, shear, bodies,
//! neighbouring teeth and free end faces, under loads along the pieces of a line of contact in halves of layers of elements. T brings loads of
//! slices onto those halves, and their deflections back ([`super::half_layers`]): what elements see of a load depends on where in one it lies, and
//! only halves are alike. The elements are too coarse for what happens close to a line of contact. There, a slice is in
//! plane strain: q° is the compliance of the transverse section on the same elements, q that of the same section as the stiffness model
//! and the contact surface have it, so that their difference g is what the elements make wrong, and it is local. It counts in the
//! normal section, where the same load per length of the line of contact gives an approach that is 1/cos β_b times as much along the
//! transverse line of action. The elements see of a load its projection S b on their shape functions over the width alone, and show of what they
//! deflect no more: they are corrected for that.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::DMatrix;

use super::half_layers::HalfLayers;
use super::influence::Influence;
use super::sliced_positions::{ContactPart, SliceContact};
use crate::contact::PositionCell;
use crate::gear::{Gear, GearPair, PerGear, normal_section::Obliquity, slices::Slices, spec::PairSpec};
use crate::gear_fem::in_space::{DeformedTooth, FlankForces, PlaneSection, SpaceError, TeethInSpace};
use crate::gear_mesh::{
    settings::{SpaceBody, SpaceResolution},
    tooth_section::ExtrudedTooth,
};
use crate::material::contact_modulus_mpa;
use gearwear_fem::elastic::Elastic;
use gearwear_fem::quadrature::GAUSS_3;

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

impl PairInSpaceError {
    /// The key of a scene to change.
    pub fn scene_key(&self) -> String {
        match self {
            Self::TooFewTeeth { .. } => "pair.face_width_mm".to_owned(),
            Self::Gear { gear, .. } => format!("fem.clamp_radius_mm.{}", gear.name()),
        }
    }
}

/// One gear.
struct GearInSpace {
    teeth: TeethInSpace,
    section: PlaneSection,
}

/// Both gears.
pub struct PairInSpace {
    gears: PerGear<GearInSpace>,
    halves: HalfLayers,
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
        let reach_mm = pair.ample_tip_reach_mm(line_load_n_per_mm, contact_modulus_mpa(material));
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
        let halves = HalfLayers::new(&gears.pinion.teeth.layer_ends_mm());
        Ok(Self { gears, halves, even_layers: resolution.even_layers(&pair.spec), reach_mm })
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

    /// The coupling of `contacts`, tooth by tooth, where the transverse section has the compliance `section_mm2_per_n` beside its surface.
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
        let between = |mm_per_n: &DMatrix<f64>, a: usize, b: usize| -> f64 {
            let of_piece =
                |piece: usize| parts[b].iter().map(|(other, part)| part * mm_per_n[(piece, *other)]).sum::<f64>();
            width_mm * parts[a].iter().map(|(piece, part)| part * of_piece(*piece)).sum::<f64>()
        };
        let of_teeth = (0..count).map(|a| between(&mm_per_n, a, a)).collect();
        for line in &lines {
            self.correct(line, pair.obliquity(), &section_mm2_per_n, &mut mm_per_n);
        }
        let mm2_per_n = (0..count * count).map(|k| between(&mm_per_n, k / count, k % count)).collect();
        Influence { mm2_per_n, of_teeth }
    }

    /// The line of contact of a tooth on the halves of layers that its contacts load; the first of its pieces is the `first` of all.
    fn line(&self, pair: &GearPair, slices: &Slices, of_tooth: &[SliceContact], first: usize) -> LoadedLine {
        let of_contact = |contact: &SliceContact| {
            let from = contact.slice as f64;
            self.halves.parts(from * slices.slice_width_mm, (from + 1.0) * slices.slice_width_mm)
        };
        let mut parts: Vec<Vec<(usize, f64)>> = of_tooth.iter().map(of_contact).collect();
        let loaded = || parts.iter().flatten().map(|(half, _)| *half);
        let halves = loaded().min().unwrap_or(0)..loaded().max().map_or(0, |last| last + 1);
        parts.iter_mut().flatten().for_each(|(half, _)| *half = *half - halves.start + first);
        let pieces = halves.clone().map(|half| self.piece(pair, slices, of_tooth, half)).collect();
        LoadedLine { first, halves, pieces, parts }
    }

    /// The line of contact of a tooth in one half of a layer, straight on from its contact nearest there.
    fn piece(&self, pair: &GearPair, slices: &Slices, of_tooth: &[SliceContact], half: usize) -> LinePiece {
        let middle_mm = self.halves.middle_mm(half);
        let from_middle = |contact: &&SliceContact| (slices.width_mm[contact.slice] - middle_mm).abs();
        let nearest =
            of_tooth.iter().min_by(|a, b| from_middle(a).total_cmp(&from_middle(b))).expect("a tooth in contact");
        let tan_base_helix = pair.base_helix_angle_rad().tan();
        let at_mm = |z_mm: f64| nearest.cell.position_mm - (z_mm - slices.width_mm[nearest.slice]) * tan_base_helix;
        let points = self.halves.points(half).map(|(z_mm, weight)| {
            let touch = pair.touch(on_flanks_mm(pair, at_mm(z_mm)));
            let radius_mm = |gear: Gear| pair.teeth[gear].involute.radius_mm(touch.rho_mm[gear]);
            (PerGear::from_fn(radius_mm), z_mm, weight)
        });
        let of_gear = |gear: Gear, section: &PlaneSection| -> f64 {
            points.iter().map(|(radius_mm, _, weight)| weight * section.mm2_per_n(radius_mm[gear])).sum()
        };
        let position_mm = on_flanks_mm(pair, at_mm(middle_mm));
        let cell = PositionCell { position_mm, lower_mm: position_mm, upper_mm: position_mm };
        LinePiece {
            contact: SliceContact { cell, part: ContactPart::WHOLE, ..*nearest },
            forces: PerGear::from_fn(|gear| {
                let of_gear = points.iter().map(|(radius_mm, z_mm, weight)| (radius_mm[gear], *z_mm, *weight));
                self.gears[gear].teeth.load(of_gear)
            }),
            section_mm2_per_n: Gear::BOTH.map(|gear| of_gear(gear, &self.gears[gear].section)).iter().sum(),
        }
    }

    /// How far the pieces yield under 1 N on each other, mm/N.
    fn of_elements(&self, pieces: &[&LinePiece]) -> DMatrix<f64> {
        let mut mm_per_n = DMatrix::zeros(pieces.len(), pieces.len());
        for (a, own) in pieces.iter().enumerate() {
            for (b, other) in pieces[..=a].iter().enumerate() {
                let pitches = other.contact.tooth - own.contact.tooth;
                let of = |gear: Gear, anticlockwise| {
                    self.gears[gear].teeth.mm_per_n(&own.forces[gear], &other.forces[gear], anticlockwise)
                };
                let value = of(Gear::Pinion, pitches) + of(Gear::Wheel, -pitches);
                mm_per_n[(a, b)] = value;
                mm_per_n[(b, a)] = value;
            }
        }
        mm_per_n
    }

    /// Exchanges what the elements make of the neighbourhood of a line of contact for what is known of it.
    fn correct(
        &self,
        line: &LoadedLine,
        obliquity: Obliquity,
        section_mm2_per_n: impl Fn(&SliceContact) -> f64,
        mm_per_n: &mut DMatrix<f64>,
    ) {
        let wrong =
            |piece: &LinePiece| section_mm2_per_n(&piece.contact) - obliquity.transverse_mm(piece.section_mm2_per_n);
        let own: Vec<f64> = line.pieces.iter().map(wrong).collect();
        // Where the line has no piece, that of the nearest.
        let of_half = |half: usize| own[half.clamp(line.halves.start, line.halves.end - 1) - line.halves.start];
        let of_halves: Vec<f64> = (0..self.halves.count()).map(of_half).collect();
        let seen = self.halves.seen_of(&of_halves, line.halves.clone());
        let count = own.len();
        for (k, value) in seen.into_iter().enumerate() {
            mm_per_n[(line.first + k / count, line.first + k % count)] += value;
        }
    }
}

/// The line of contact of a tooth, on halves of layers.
struct LoadedLine {
    /// Number of its first piece among those of all lines.
    first: usize,
    /// Halves that it loads.
    halves: Range<usize>,
    /// The line in each of them.
    pieces: Vec<LinePiece>,
    /// For each of its contacts the pieces, by their number among those of all lines, that have parts of its load.
    parts: Vec<Vec<(usize, f64)>>,
}

/// A line of contact in half a layer.
struct LinePiece {
    /// A contact at its middle.
    contact: SliceContact,
    /// Its load, 1 N in all, on both flanks.
    forces: PerGear<FlankForces>,
    /// Compliance of the transverse sections of both gears on the same elements, mean over the piece, mm²/N.
    section_mm2_per_n: f64,
}

/// The place between those where flanks may touch that is nearest to `at_mm`.
fn on_flanks_mm(pair: &GearPair, at_mm: f64) -> f64 {
    let [furthest_before, furthest_after] = pair.farthest_touch_mm();
    at_mm.clamp(pair.path.start_mm - furthest_before, pair.path.end_mm + furthest_after)
}

/// Points of integration of one of `count` slices, three on each piece that lies in one layer: its place over the face width, mm, and its
/// weight, 1 in all.
fn points_of_slice(slice: usize, count: usize, layer_ends_mm: &[f64]) -> impl Iterator<Item = (f64, f64)> + '_ {
    let width_mm = layer_ends_mm[layer_ends_mm.len() - 1] / count as f64;
    let (first, last) = (slice as f64 * width_mm, (slice + 1) as f64 * width_mm);
    let pieces = layer_ends_mm.windows(2).map(move |ends| (first.max(ends[0]), last.min(ends[1])));
    // What is left of rounding makes no piece.
    pieces.filter(move |(from, to)| to - from > 1e-9 * width_mm).flat_map(move |(from, to)| {
        GAUSS_3
            .into_iter()
            .map(move |(s, weight)| (0.5 * ((from + to) + (to - from) * s), 0.5 * weight * (to - from) / width_mm))
    })
}

/// Most teeth of a gear that touch at any phase, tip edges included, which do so up to `reach_mm` before A and after E.
fn teeth_together(pair: &GearPair, reach_mm: [f64; 2]) -> usize {
    let path = &pair.path;
    let over_width_mm = pair.spec.face_width_mm * pair.base_helix_angle_rad().tan().abs();
    let length_mm = path.end_mm - path.start_mm + reach_mm.iter().sum::<f64>() + over_width_mm;
    (length_mm / path.base_pitch_mm) as usize + 1
}
