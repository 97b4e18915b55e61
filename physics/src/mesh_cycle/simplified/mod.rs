//! The simplified model of helical gears: wear kept at the contact points themselves, for speed.
//!
//! With Hertz's mean pressure the model is pointwise. Slice i of tooth k at a position of the mesh ([`crate::mesh_cycle::sliced_positions`]) touches
//! at the same point of the pinion's flank and of the wheel's in every mesh: gap, load and wear are rows with one entry for each contact,
//!
//! ```text
//! g = C1 + C2 + h1 + h2         s(w) + g = δ for every contact, Σ w = F         dh = law(p = w/(2a), s = 2a |ζ|)
//! ```
//!
//! with the modifications C at the contact point, a² = 4 w R/(π E*) and the specific sliding ζ. It is the same model as
//! [`crate::contact::hertz_mean`] on [`crate::mesh_cycle::sliced`], which interpolates the worn flanks between points evenly
//! spaced in radius; both agree within the error of that.
//!
//! | module | what |
//! |---|---|
//! | [`closed_form`] | approach of a contact under its load, prepared |
//! | [`loaded_position`] | equilibrium of a position from one wear step to the next |
//! | [`exact`] | the general solver, where that one fails |
//! | [`batch`] | rows of contacts, from equilibrium to wear |
//! | [`on_flanks`] | interpolation to the points of the flanks, for snapshots |
//!
//! Source: S. Andersson (1975) and the thesis, section 3.4 and paper E.

pub(crate) mod batch;
pub mod closed_form;
pub(crate) mod exact;
pub(crate) mod lanes;
pub(crate) mod loaded_position;
pub(crate) mod on_flanks;

use rayon::prelude::*;

use super::wearing_pair::WearingPair;
use crate::contact::{
    Footprint, PressedCell,
    flank_pressure::{FlankParts, PressureFigures},
};
use crate::mesh_cycle::over_life::PeakToPeakOverLife;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::mesh_cycle::{
    CycleObservation, GreatestPressure, PositionObservation, Work,
    load_sharing::EquilibriumError,
    range_mm,
    sliced_mesh::{ObservedContact, ObservedSlicedPosition, SlicedMesh},
    sliced_positions::{ContactPart, SlicedPosition},
};
use crate::wear::WearModel;
use crate::wear::stepping::{greater_or_nan, greatest};
use batch::Batch;
use closed_form::ContactForms;
use exact::SlicesInSeries;
use gearwear_bodies::gear::{Gear, PerGear, flank::FlankGrid};
use on_flanks::{FlankPoints, Knot};

/// Contacts of a batch, about 0.1 ms of work: handing it to another thread costs little against that.
const BATCH: usize = 16_000;

/// Contacts of each slice in the order of the path.
fn knots(batches: &[Batch], slices: usize) -> Vec<Vec<Knot>> {
    let mut knots = vec![Vec::new(); slices];
    let positions = batches
        .iter()
        .enumerate()
        .flat_map(|(number, batch)| (0..batch.loaded_positions.len()).map(move |loaded| (number, batch, loaded)));
    for (number, batch, loaded) in positions {
        let jumps = batch.positions[loaded].jumps;
        for (contact, lane, _) in batch.contacts(loaded) {
            let (position_mm, upper_mm) = (contact.cell.position_mm, contact.cell.upper_mm);
            knots[contact.slice].push(Knot { position_mm, upper_mm, jumps, at: (number, lane) });
        }
    }
    for of_slice in &mut knots {
        of_slice.sort_by(|a, b| a.position_mm.total_cmp(&b.position_mm));
    }
    knots
}

/// A pair that wears by the simplified model.
pub(crate) struct SimplifiedPair<'a> {
    springs: SlicesInSeries<'a>,
    grid: PerGear<&'a FlankGrid>,
    batches: Vec<Batch>,
    /// Meshes that the flanks have been through since the last evaluation.
    meshes: PerGear<f64>,
    /// Number of observed positions from A to E.
    positions: usize,
    /// Displacement of the bodies that all pairs share, under the whole load, mm.
    bodies_mm: f64,
    flank_points: FlankPoints,
    /// Contacts of each slice in the order of the path.
    knots: Vec<Vec<Knot>>,
    parts: FlankParts,
}

impl<'a> SimplifiedPair<'a> {
    /// Unworn flanks with their modifications in contact at `sliced_positions`; `positions` from A to E are observed, on gear bodies that yield by
    /// `bodies_mm` under the whole load.
    pub(crate) fn new(
        springs: SlicesInSeries<'a>,
        mut sliced_positions: Vec<SlicedPosition>,
        grid: PerGear<&'a FlankGrid>,
        modification_mm: &PerGear<Vec<f64>>,
        positions: usize,
        bodies_mm: f64,
        parts: FlankParts,
    ) -> Self {
        let line_load = springs.line_load_n_per_mm / springs.sliced.slices.count() as f64;
        let forms = ContactForms::new(springs.pair, springs.material, line_load);
        let path = &springs.pair.path;
        let plain = Gear::BOTH.iter().all(|&gear| modification_mm[gear].iter().all(|&removed| removed == 0.0));
        let contacts: usize = sliced_positions.iter().map(|position| position.contacts.len()).sum();
        let size = sliced_positions.len().div_ceil(contacts.div_ceil(BATCH).max(1)).max(1);
        let mut batches = Vec::new();
        while !sliced_positions.is_empty() {
            let rest = sliced_positions.split_off(size.min(sliced_positions.len()));
            batches.push(Batch::new(sliced_positions, &forms, &springs, |contact| {
                if plain {
                    return 0.0;
                }
                let of_gears = PerGear::from_fn(|gear| {
                    let points = grid[gear].len();
                    let own = &modification_mm[gear][contact.slice * points..(contact.slice + 1) * points];
                    grid[gear].value_at(own, path.rho_mm(gear, contact.cell.position_mm))
                });
                springs.pair.obliquity().transverse_mm(of_gears.sum())
            }));
            sliced_positions = rest;
        }
        let meshes = PerGear { pinion: 0.0, wheel: 0.0 };
        let flank_points = FlankPoints::new(springs.pair, grid);
        let knots = knots(&batches, springs.sliced.slices.count());
        Self { springs, grid, batches, meshes, positions, bodies_mm, flank_points, knots, parts }
    }

    /// Figures of the pressure of all contacts.
    fn pressure_figures(&self) -> PressureFigures {
        let mut figures = PressureFigures::default();
        let mut of_slices = vec![PressureFigures::default(); self.knots.len()];
        for batch in &self.batches {
            for index in 0..batch.loaded_positions.len() {
                for (contact, _, state) in batch.contacts(index) {
                    let cells = PressedCell::even(state.half_width_mm, state.pressure_mpa);
                    let is_whole = contact.part == ContactPart::WHOLE;
                    let figures = if is_whole { &mut of_slices[contact.slice] } else { &mut figures };
                    self.parts.note(self.springs.pair, contact.cell.position_mm, &cells, figures);
                }
            }
        }
        figures.note_slices(&of_slices);
        figures
    }

    /// The tooth as a whole from A to E.
    fn along_path(&self, mesh: &SlicedMesh) -> Vec<PositionObservation> {
        let line_load = self.springs.line_load_n_per_mm / self.knots.len() as f64;
        mesh.along_path(&self.springs.pair.path, self.positions, line_load)
    }

    /// The mesh of one tooth.
    fn mesh(&self) -> SlicedMesh {
        let load = self.springs.line_load_n_per_mm;
        let mut observed = Vec::new();
        for batch in &self.batches {
            for (index, loaded) in batch.loaded_positions.iter().enumerate() {
                let contacts: Vec<ObservedContact> = batch
                    .contacts(index)
                    .map(|(contact, _, state)| ObservedContact {
                        part_of_width: contact.part.of_width,
                        tooth: contact.tooth,
                        slice: contact.slice,
                        line_load_n_per_mm: state.line_load_n_per_mm,
                        footprint: Footprint {
                            peak_pressure_mpa: state.pressure_mpa,
                            half_width_mm: state.half_width_mm,
                            equivalent_half_width_mm: state.half_width_mm,
                            at_sharp_edge: false,
                        },
                    })
                    .collect();
                let total: f64 = contacts.iter().map(|contact| contact.line_load_n_per_mm).sum();
                observed.push(ObservedSlicedPosition {
                    position_mm: loaded.position_mm,
                    transmission_error_mm: loaded.transmission_error_mm + self.bodies_mm,
                    stiffness_n_per_mm2: None,
                    load_imbalance: total / load - 1.0,
                    contacts,
                    jump_mm: batch.positions[index].jump_mm,
                });
            }
        }
        SlicedMesh::new(&observed, self.springs.sliced.slices.count(), self.springs.pair.path.base_pitch_mm)
    }
}

impl WearingPair for SimplifiedPair<'_> {
    fn evaluate(
        &mut self,
        wear: &WearModel<'_>,
        stopped: &(dyn Fn() -> bool + Sync),
    ) -> Result<Work, EquilibriumError> {
        let (meshes, springs) = (self.meshes, &self.springs);
        match self.batches.as_mut_slice() {
            [batch] => batch.evaluate(meshes, springs, wear, stopped),
            batches => batches.par_iter_mut().for_each(|batch| batch.evaluate(meshes, springs, wear, stopped)),
        }
        self.meshes = PerGear { pinion: 0.0, wheel: 0.0 };
        let mut work = Work { mesh_cycles: 1, ..Work::default() };
        for batch in &self.batches {
            work += batch.outcome()?;
        }
        Ok(work)
    }

    fn wear_for(&mut self, meshes: PerGear<f64>) {
        for gear in Gear::BOTH {
            self.meshes[gear] += meshes[gear];
        }
    }

    fn reset(&mut self) {
        // Gaps summed step by step differ in their last bits from gaps of the whole wear.
        let wear_mm = self.wear_mm();
        self.set_wear_mm(&wear_mm);
        self.batches.iter_mut().for_each(Batch::reset);
    }

    fn wear_mm(&self) -> PerGear<Vec<f64>> {
        PerGear::from_fn(|gear| {
            let rows = self.batches.iter().flat_map(|batch| batch.rows(gear));
            rows.map(|[wear, depth]| wear + self.meshes[gear] * depth).collect()
        })
    }

    fn greatest_mean_mm(&self, row: PerGear<&[f64]>) -> f64 {
        // Contact points are a position apart.
        greater_or_nan(greatest(row.pinion), greatest(row.wheel))
    }

    fn mean_about_mm(&self, _: Gear, place: usize, row: &[f64]) -> f64 {
        row[place]
    }

    fn wear_at_points_mm(&self) -> PerGear<Vec<f64>> {
        PerGear::from_fn(|gear| {
            let points = self.grid[gear].len();
            let mut wear_mm = vec![0.0; self.knots.len() * points];
            for (knots, own_mm) in self.knots.iter().zip(wear_mm.chunks_exact_mut(points)) {
                let lanes = knots.iter().map(|knot| self.batches[knot.at.0].of_lane(gear, knot.at.1));
                let values: Vec<[f64; 1]> = lanes.map(|[wear, depth]| [wear + self.meshes[gear] * depth]).collect();
                self.flank_points.bring(gear, knots, &values, |point, part, [wear]| own_mm[point] = part * wear);
            }
            wear_mm
        })
    }

    fn set_wear_mm(&mut self, wear_mm: &PerGear<Vec<f64>>) {
        self.meshes = PerGear { pinion: 0.0, wheel: 0.0 };
        let mut rest = wear_mm.as_ref().map(Vec::as_slice);
        for batch in &mut self.batches {
            let parts = rest.map(|rest| rest.split_at(batch.lanes()));
            batch.set_wear_mm(parts.map(|(own, _)| own));
            rest = parts.map(|(_, rest)| rest);
        }
    }

    fn depth_mm(&self, depth_mm: &mut PerGear<Vec<f64>>) {
        for gear in Gear::BOTH {
            depth_mm[gear].clear();
            for batch in &self.batches {
                depth_mm[gear].extend(batch.rows(gear).map(|[_, depth]| depth));
            }
        }
    }

    fn peak_to_peak_mm(&self) -> f64 {
        range_mm(self.along_path(&self.mesh()).iter().map(|at| at.transmission_error_mm))
    }

    fn snapshot(&mut self, revolutions: f64) -> Result<Snapshot, EquilibriumError> {
        let points = self.grid.map(|grid| grid.len());
        let zeros = points.map(|points| vec![0.0; self.knots.len() * points]);
        let [mut wear_mm, mut depth_mm, mut pressure_mpa, mut sliding_mm] =
            [zeros.clone(), zeros.clone(), zeros.clone(), zeros];
        let mut values: PerGear<Vec<[f64; 4]>> = PerGear::from_fn(|_| Vec::new());
        for (slice, knots) in self.knots.iter().enumerate() {
            for gear in Gear::BOTH {
                values[gear].clear();
            }
            for knot in knots {
                let (batch, lane) = (&self.batches[knot.at.0], knot.at.1);
                let state = batch.contact(lane);
                for gear in Gear::BOTH {
                    let [wear, depth] = batch.of_lane(gear, lane);
                    values[gear].push([wear, depth, state.sliding_mm[gear], state.pressure_mpa]);
                }
            }
            for gear in Gear::BOTH {
                let first = slice * points[gear];
                self.flank_points.bring(gear, knots, &values[gear], |point, part, [wear, depth, sliding, pressure]| {
                    let at = first + point;
                    wear_mm[gear][at] = part * wear;
                    depth_mm[gear][at] = part * depth;
                    sliding_mm[gear][at] = part * sliding;
                    pressure_mpa[gear][at] = pressure;
                });
            }
        }
        let mesh = self.mesh();
        let positions = self.along_path(&mesh);
        let mut of_slices = vec![GreatestPressure::default(); mesh.slices];
        // Closed forms have no tip edges.
        for (place, &pressure) in mesh.peak_pressure_mpa.iter().enumerate() {
            of_slices[place % mesh.slices].note(pressure, false);
        }
        for gear in Gear::BOTH {
            for (slice, felt) in of_slices.iter_mut().zip(pressure_mpa[gear].chunks_exact(points[gear])) {
                felt.iter().for_each(|&pressure| slice.note(pressure, false));
            }
        }
        let mut greatest_pressure = GreatestPressure::default();
        greatest_pressure.note_slices(&of_slices);
        let cycle = CycleObservation {
            positions,
            shares_at_ends: None,
            greatest_pressure,
            pressure_figures: self.pressure_figures(),
            pressure_mpa,
            sliding_mm,
            sliding_work_n: None,
            slices: Some(mesh),
            deepest_overlap: None,
            transmission_error_beside_jumps_mm: Vec::new(),
        };
        let over_life = PeakToPeakOverLife::default();
        Ok(Snapshot { revolutions, wear_mm, depth_per_mesh_mm: depth_mm, lost_at_nodes: None, cycle, over_life })
    }
}
