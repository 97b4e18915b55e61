//! The mesh cycle of a pair whose transverse sections differ: helical, or modified over the face width.
//!
//! The face width is cut into slices, each a thin spur pair in its own transverse section. At every position of one base pitch
//! ([`super::sliced_positions`]) all slices of all teeth in contact are in equilibrium under one approach of the rigid hubs:
//!
//! ```text
//! Σ w_ki Δz = F                δ = touch_ki + s_ki(w_ki) + u_ki
//! ```
//!
//! with the deflection u of the teeth slice by slice (u = q w: thin independent teeth), coupled along each tooth
//! ([`super::slice_coupling`]), or of all teeth together ([`super::pair_in_space`]). For a slice that the line of contact has entered in part,
//! w is the load of that part over the width of the slice ([`super::part_of_slice`]). The pressure of every contact sweeps over the points of its slice
//! and wears them.

use rayon::prelude::*;

use super::collected::Collected;
use super::coupled_teeth::CoupledTeeth;
use super::load_sharing::{EquilibriumError, MeshedPair, PairEquilibrium, balance, settled};
use super::part_of_slice::PartOfSlice;
use super::sliced_mesh::{ObservedContact, ObservedSlicedPosition, SlicedMesh};
use super::sliced_positions::{ContactPart, SliceContact, SlicedPosition};
use super::sliced_sharing::balance_on_teeth;
use super::sliced_teeth::SlicedTeeth;
use super::spring_along_path::SpringAlongPath;
use super::worn_points::{ContactOnPath, WornPoints};
use super::{
    CycleObservation, FlankOverlap, GROUPS, GreatestPressure, LostMaterial, MeshCycle, PositionObservation, Work,
    in_series, is_exceeded, note_contact_of_points, note_figures, range_mm,
};
use crate::contact::flank_pressure::PressureFigures;
use crate::contact::{ContactSurface, Flanks, Sweep};
use crate::wear::WearModel;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, path_of_contact::PathOfContact};

/// Compliance of the teeth of a slice, and lever of its load.
pub(crate) struct SliceSprings<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// Compliance of the teeth.
    pub along_path: &'a SpringAlongPath,
    /// Approach in its tangent frame over the transmission error, as torque over load and base radius: 1 on the line of action.
    pub lever_ratio: &'a (dyn Fn(f64) -> f64 + Sync),
}

/// A position of the mesh with all slices in contact, and their state.
struct LoadedSlices<'a> {
    position_mm: f64,
    /// [`SlicedPosition::jump_mm`].
    jump_mm: Option<f64>,
    contacts: Vec<SliceContact>,
    pairs: Vec<MeshedPair<'a>>,
    /// Place of each contact.
    places: Vec<ContactOnPath<'a>>,
    /// Sliding distance of the load of each contact, counted over the whole slice, mm.
    sliding_mm: Vec<f64>,
    /// Teeth of the contacts, where slices are coupled.
    teeth: Option<CoupledTeeth>,
    equilibrium: PairEquilibrium,
}

/// Place of the greatest of some depths, the last of equals; 0 where there are none.
fn place_of_greatest(depths_mm: impl Iterator<Item = f64>) -> usize {
    depths_mm.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(place, _)| place)
}

/// Figures of the pressure of slices.
struct SlicedFigures {
    /// Whole slices.
    of_slices: Vec<PressureFigures>,
    /// All parts of slices together.
    of_parts: PressureFigures,
}

impl SlicedFigures {
    /// Figures of no contact.
    fn new(slices: usize) -> Self {
        Self { of_slices: vec![PressureFigures::default(); slices], of_parts: PressureFigures::default() }
    }

    /// Takes other figures of the same slices into account.
    fn note(&mut self, other: &Self) {
        self.of_parts.note(other.of_parts);
        self.of_slices.iter_mut().zip(&other.of_slices).for_each(|(slice, other)| slice.note(*other));
    }
}

/// Positions that collect wear together.
struct SlicedGroup<'a> {
    loaded_positions: Vec<LoadedSlices<'a>>,
    collected: Collected,
    points: WornPoints,
}

/// All positions of a sliced pair, ready to be evaluated on ever newly worn flanks.
pub(crate) struct SlicedCycle<'a> {
    groups: Vec<SlicedGroup<'a>>,
    /// Index of the group that probes of fast waves evaluate alone.
    part: usize,
    sliced: &'a SlicedTeeth,
    path: &'a PathOfContact,
    flanks: Flanks<'a>,
    /// Points of a slice of each flank.
    points: PerGear<usize>,
    /// Number of observed positions from A to E.
    positions: usize,
    line_load_n_per_mm: f64,
    /// Displacement of the bodies that all pairs share, under the whole load, mm.
    bodies_mm: f64,
}

/// Material that the flanks of a slice have lost.
fn of_slice(field: PerGear<&[f64]>, points: PerGear<usize>, slice: usize) -> PerGear<&[f64]> {
    PerGear::from_fn(|gear| &field[gear][slice * points[gear]..(slice + 1) * points[gear]])
}

impl<'a> SlicedCycle<'a> {
    /// Prepares every contact at the positions `sliced_positions`; `positions` from A to E are observed.
    #[allow(clippy::too_many_arguments, reason = "each of them is a part of the physics")]
    pub(crate) fn new(
        flanks: Flanks<'a>,
        surface: &dyn ContactSurface,
        sliced: &'a SlicedTeeth,
        sliced_positions: &[SlicedPosition],
        springs: &SliceSprings<'_>,
        path: &'a PathOfContact,
        positions: usize,
        line_load_n_per_mm: f64,
    ) -> Self {
        let points = flanks.grid.map(|grid| grid.len());
        let slices = sliced.slices.count();
        let groups = sliced_positions
            .par_chunks(sliced_positions.len().div_ceil(GROUPS).max(1))
            .map(|chunk| SlicedGroup {
                loaded_positions: chunk
                    .iter()
                    .map(|position| LoadedSlices::new(flanks, surface, sliced, position, springs))
                    .collect(),
                collected: Collected::new(points.map(|points| slices * points)),
                points: WornPoints::default(),
            })
            .collect();
        Self { groups, part: 0, sliced, path, flanks, points, positions, line_load_n_per_mm, bodies_mm: 0.0 }
    }

    /// Puts the pair on gear bodies that yield by `bodies_mm` under the whole load.
    pub(crate) fn on_bodies_that_yield_by(self, bodies_mm: f64) -> Self {
        Self { bodies_mm, ..self }
    }

    /// The mesh of one tooth by the last evaluation.
    fn mesh(&self) -> SlicedMesh {
        let slices = self.sliced.slices.count();
        let loaded = self.groups.iter().flat_map(|group| &group.loaded_positions);
        let observed = loaded.map(|loaded| loaded.observe(slices, self.line_load_n_per_mm, self.bodies_mm));
        SlicedMesh::new(&observed.collect::<Vec<_>>(), slices, self.path.base_pitch_mm)
    }

    /// The tooth as a whole from A to E.
    fn along_path(&self, mesh: &SlicedMesh) -> Vec<PositionObservation> {
        mesh.along_path(self.path, self.positions, self.line_load_n_per_mm)
    }

    /// Sum of all line loads: the mean line load in every slice.
    fn sum_of_line_loads(&self) -> f64 {
        self.line_load_n_per_mm * self.sliced.slices.count() as f64
    }
}

impl MeshCycle for SlicedCycle<'_> {
    fn evaluate(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let (load, points) = (self.sum_of_line_loads(), self.points);
        self.groups.par_iter_mut().for_each(|group| {
            group.evaluate(lost, points, load, wear, stopped);
        });
        Collected::sum(self.groups.iter().map(|group| &group.collected), depth_mm)
    }

    fn may_wear_severely(&self, wear: &WearModel<'_>) -> bool {
        let pairs = self.groups.iter().flat_map(|group| &group.loaded_positions).flat_map(|loaded| &loaded.pairs);
        is_exceeded(wear.out_of_reach_mpa(), pairs.map(|pair| pair.contact.footprint().peak_pressure_mpa))
    }

    fn choose_part(&mut self) -> bool {
        // Contacts are shorter than the stretch of the path on which a group has each slice, and all groups have slices at tip edges.
        self.part = place_of_greatest(self.groups.iter().map(|group| group.collected.deepest_mm()));
        self.groups.len() > 1
    }

    fn evaluate_part(
        &mut self,
        lost: LostMaterial<'_>,
        wear: &WearModel<'_>,
        depth_mm: &mut PerGear<Vec<f64>>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let (load, points) = (self.sum_of_line_loads(), self.points);
        let group = &mut self.groups[self.part];
        group.evaluate(lost, points, load, wear, stopped);
        let work = Collected::sum(std::iter::once(&group.collected), depth_mm)?;
        Ok(work.of_a_part())
    }

    fn reset(&mut self) {
        self.groups.par_iter_mut().flat_map(|group| &mut group.loaded_positions).for_each(|loaded| {
            loaded.pairs.iter_mut().for_each(MeshedPair::reset);
            loaded.teeth.iter_mut().for_each(CoupledTeeth::straighten);
        });
    }

    fn peak_to_peak_mm(&self) -> f64 {
        range_mm(self.along_path(&self.mesh()).iter().map(|at| at.transmission_error_mm))
    }

    fn observe(&mut self, lost: LostMaterial<'_>) -> Result<CycleObservation, EquilibriumError> {
        let removed_mm = lost;
        let slices = self.sliced.slices.count();
        let mut pressure_mpa = removed_mm.map(|flank| vec![0.0; flank.len()]);
        let mut sliding_mm = pressure_mpa.clone();
        let mut sweep = Sweep::default();
        let mut greatest_pressure = GreatestPressure::default();
        let mut sliding_work_n = 0.0;
        let mut of_slices = vec![GreatestPressure::default(); slices];
        let (points, bodies_mm, flanks) = (self.points, self.bodies_mm, self.flanks);
        let of_groups: Vec<(Option<FlankOverlap>, SlicedFigures)> = self
            .groups
            .par_iter_mut()
            .map(|group| (group.deepest_overlap(removed_mm, points, bodies_mm), group.figures(flanks, slices)))
            .collect();
        let deepest_overlap = of_groups.iter().filter_map(|(overlap, _)| *overlap).reduce(FlankOverlap::deeper);
        let mut figures = SlicedFigures::new(slices);
        of_groups.iter().for_each(|(_, of_group)| figures.note(of_group));
        for loaded in self.groups.iter().flat_map(|group| &group.loaded_positions) {
            for ((contact, pair), sliding) in loaded.contacts.iter().zip(&loaded.pairs).zip(&loaded.sliding_mm) {
                let own = of_slice(removed_mm, self.points, contact.slice);
                let footprint = pair.contact.footprint();
                // The pressure of a part of a slice is that at the end of the line of contact, not in the middle of the slice.
                let is_whole = contact.part == ContactPart::WHOLE;
                let greatest = if is_whole { &mut of_slices[contact.slice] } else { &mut greatest_pressure };
                if (self.path.start_mm..=self.path.end_mm).contains(&contact.cell.position_mm) {
                    greatest.note(footprint.peak_pressure_mpa, footprint.at_sharp_edge);
                }
                for gear in Gear::BOTH {
                    let range = contact.slice * self.points[gear]..(contact.slice + 1) * self.points[gear];
                    let (pressure, sliding) = (&mut pressure_mpa[gear][range.clone()], &mut sliding_mm[gear][range]);
                    let greatest_mpa = note_contact_of_points(&*pair.contact, gear, own, &mut sweep, pressure, sliding);
                    greatest.note(greatest_mpa, footprint.at_sharp_edge);
                }
                sliding_work_n += pair.normal_load_n_per_mm() * sliding;
            }
        }
        let mesh = self.mesh();
        let positions = self.along_path(&mesh);
        greatest_pressure.note_slices(&of_slices);
        let mut pressure_figures = figures.of_parts;
        pressure_figures.note_slices(&figures.of_slices);
        Ok(CycleObservation {
            positions,
            shares_at_ends: None,
            greatest_pressure,
            pressure_figures,
            pressure_mpa,
            sliding_mm,
            sliding_work_n: Some(sliding_work_n),
            slices: Some(mesh),
            deepest_overlap,
            transmission_error_beside_jumps_mm: Vec::new(),
        })
    }
}

impl SlicedGroup<'_> {
    fn evaluate(
        &mut self,
        removed_mm: PerGear<&[f64]>,
        points: PerGear<usize>,
        load: f64,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) {
        self.collected.clear();
        for loaded in &mut self.loaded_positions {
            let solved =
                if stopped() { Err(EquilibriumError::Interrupted) } else { loaded.solve(removed_mm, points, load) };
            if !self.collected.take(solved) {
                return;
            }
            let contacts = loaded.contacts.iter().zip(&loaded.places);
            for ((contact, place), pair) in contacts.zip(&loaded.pairs) {
                let own = of_slice(removed_mm, points, contact.slice);
                let first = points.map(|points| contact.slice * points);
                self.points.wear(wear, (pair, place), own, first, &mut self.collected.depth_mm);
            }
        }
    }

    /// Figures of the pressure of all contacts.
    fn figures(&self, flanks: Flanks<'_>, slices: usize) -> SlicedFigures {
        let mut figures = SlicedFigures::new(slices);
        for (contact, pair) in self.loaded_positions.iter().flat_map(|loaded| loaded.contacts.iter().zip(&loaded.pairs))
        {
            let is_whole = contact.part == ContactPart::WHOLE;
            let of = if is_whole { &mut figures.of_slices[contact.slice] } else { &mut figures.of_parts };
            note_figures(flanks, contact.cell.position_mm, &*pair.contact, of);
        }
        figures
    }

    /// Deepest overlap of flanks beside the windows.
    fn deepest_overlap(
        &self,
        removed_mm: PerGear<&[f64]>,
        points: PerGear<usize>,
        bodies_mm: f64,
    ) -> Option<FlankOverlap> {
        let of_positions = self.loaded_positions.iter().flat_map(|loaded| {
            let transmission_error_mm = loaded.equilibrium.transmission_error_mm + bodies_mm;
            loaded.contacts.iter().zip(&loaded.pairs).filter_map(move |(contact, pair)| {
                let own = of_slice(removed_mm, points, contact.slice);
                pair.contact.overlap_beside_mm(own).map(|overlap_mm| FlankOverlap {
                    of_transmission_error: overlap_mm / transmission_error_mm,
                    position_mm: contact.cell.position_mm,
                })
            })
        });
        of_positions.reduce(FlankOverlap::deeper)
    }
}

impl<'a> LoadedSlices<'a> {
    fn new(
        flanks: Flanks<'a>,
        surface: &dyn ContactSurface,
        sliced: &SlicedTeeth,
        position: &SlicedPosition,
        springs: &SliceSprings<'_>,
    ) -> Self {
        let contacts = &position.contacts;
        let teeth =
            sliced.coupled_teeth(springs.pair, contacts, |contact| sliced.mm2_per_n(contact, springs.along_path));
        let pairs = contacts
            .iter()
            .map(|contact| {
                let position_mm = contact.cell.position_mm;
                let touching = surface.pair(flanks, position_mm, Some(contact.cell));
                let touching = PartOfSlice::of(touching, contact.part);
                // Coupled teeth are not part of the pair.
                let teeth_n_per_mm2 = match &teeth {
                    Some(_) => f64::INFINITY,
                    None => contact.part.of_width / sliced.mm2_per_n(contact, springs.along_path),
                };
                MeshedPair::on_lever(
                    touching,
                    teeth_n_per_mm2,
                    (springs.lever_ratio)(position_mm),
                    flanks.geometry.obliquity,
                )
            })
            .collect();
        Self {
            position_mm: position.position_mm,
            jump_mm: position.jump_mm,
            contacts: contacts.clone(),
            pairs,
            places: contacts
                .iter()
                .map(|contact| ContactOnPath::new(flanks, contact.cell).of_part(contact.part.of_width))
                .collect(),
            sliding_mm: contacts
                .iter()
                .map(|SliceContact { cell, part, .. }| {
                    let slid_mm = flanks.geometry.sliding_mm(cell.lower_mm, cell.upper_mm);
                    part.of_passage / part.of_width * slid_mm
                })
                .collect(),
            teeth,
            equilibrium: PairEquilibrium::default(),
        }
    }

    /// Equilibrium on the flanks as they are now.
    fn solve(
        &mut self,
        removed_mm: PerGear<&[f64]>,
        points: PerGear<usize>,
        load: f64,
    ) -> Result<Work, EquilibriumError> {
        let Self { position_mm, contacts, pairs, teeth, .. } = self;
        let removed_mm = |k: usize| of_slice(removed_mm, points, contacts[k].slice);
        let (equilibrium, work) = settled(pairs, removed_mm, |pairs| match teeth {
            None => balance(pairs, load, *position_mm),
            Some(teeth) => balance_on_teeth(pairs, teeth, load, *position_mm),
        })?;
        self.equilibrium = equilibrium;
        Ok(work)
    }

    /// Observation under a mean load of `line_load_n_per_mm` over the `slices`.
    fn observe(&self, slices: usize, line_load_n_per_mm: f64, bodies_mm: f64) -> ObservedSlicedPosition {
        let total: f64 = self.pairs.iter().map(|pair| pair.response.line_load_n_per_mm).sum();
        let of_teeth_n_per_mm2 = self.equilibrium.n_per_mm2 / slices as f64;
        let contacts = self.contacts.iter().zip(&self.pairs).map(|(contact, pair)| ObservedContact {
            tooth: contact.tooth,
            slice: contact.slice,
            part_of_width: contact.part.of_width,
            line_load_n_per_mm: pair.response.line_load_n_per_mm,
            footprint: pair.contact.footprint(),
        });
        ObservedSlicedPosition {
            position_mm: self.position_mm,
            transmission_error_mm: self.equilibrium.transmission_error_mm + bodies_mm,
            stiffness_n_per_mm2: Some(in_series(of_teeth_n_per_mm2, bodies_mm / line_load_n_per_mm)),
            load_imbalance: total / (line_load_n_per_mm * slices as f64) - 1.0,
            contacts: contacts.collect(),
            jump_mm: self.jump_mm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The part that stands for all in probes of the fastest decay is the one that wears deepest, wherever it is.
    #[test]
    fn ver_the_part_that_wears_deepest_is_chosen() {
        for (depths_mm, deepest) in [([3.0, 1.0, 2.0], 0), ([1.0, 3.0, 2.0], 1), ([2.0, 1.0, 3.0], 2)] {
            assert_eq!(place_of_greatest(depths_mm.into_iter()), deepest, "{depths_mm:?}");
        }
    }
}
