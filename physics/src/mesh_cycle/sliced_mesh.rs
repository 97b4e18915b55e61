//! Observation of the mesh of a sliced pair: one tooth, slice by slice, from its first touch to its last.
//!
//! The positions of one base pitch suffice: tooth k at a position is the reference tooth k base pitches later, and the
//! transmission error is the same in every base pitch.

use super::mesh_orders;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::PositionObservation;
use crate::contact::Footprint;
use gearwear_bodies::gear::path_of_contact::PathOfContact;

/// Observation of a slice in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObservedContact {
    /// Base pitches ahead of the reference tooth.
    pub tooth: i32,
    /// Slice.
    pub slice: usize,
    /// Part of the width of the slice that is in contact.
    pub part_of_width: f64,
    /// Load, N per mm of the whole width of the slice.
    pub line_load_n_per_mm: f64,
    /// Extent and greatest pressure of the contact.
    pub footprint: Footprint,
}

/// Observation at a position of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedSlicedPosition {
    /// Position of the reference tooth in the middle of the face width.
    pub position_mm: f64,
    /// Approach of the gears along the line of action.
    pub transmission_error_mm: f64,
    /// Change of the mean line load with it, N/mm²; `None` where a model does not give it.
    pub stiffness_n_per_mm2: Option<f64>,
    /// Sum of all line loads over the load to be carried, less one.
    pub load_imbalance: f64,
    /// All slices in contact.
    pub contacts: Vec<ObservedContact>,
    /// Place between this position and the next at which slices come or go at once; none where all change steadily.
    pub jump_mm: Option<f64>,
}

/// The mesh of one tooth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SlicedMesh {
    /// Slices over the face width.
    pub slices: usize,
    /// Positions of the tooth in the middle of the face width, evenly spaced, from its first touch to its last.
    pub position_mm: Vec<f64>,
    /// Part of the width of each slice that is in contact at each position, position after position; 0 without contact.
    pub part_of_width: Vec<f64>,
    /// Load of each slice at each position, N per mm of its whole width.
    pub line_load_n_per_mm: Vec<f64>,
    /// Greatest pressure of each slice at each position, MPa.
    pub peak_pressure_mpa: Vec<f64>,
    /// Half-width of the contact of each slice at each position, mm.
    pub half_width_mm: Vec<f64>,
    /// Half-width of the heated strip ([`Footprint::equivalent_half_width_mm`]).
    pub equivalent_half_width_mm: Vec<f64>,
    /// Whether a sharp tip edge cuts off the contact of each slice at each position.
    pub at_sharp_edge: Vec<bool>,
    /// Transmission error at evenly spaced positions of one base pitch, from `first_position_mm` on.
    pub transmission_error_mm: Vec<f64>,
    /// Mesh stiffness there, N/mm²; empty where a model does not give it.
    pub stiffness_n_per_mm2: Vec<f64>,
    /// Part of the way from each of these positions to the next at which slices come or go at once; none where all change steadily.
    pub jumps: Vec<Option<f64>>,
    /// Position of the tooth at the first of these positions.
    pub first_position_mm: f64,
    /// The base pitch.
    pub base_pitch_mm: f64,
    /// Greatest imbalance of loads at any position.
    pub load_imbalance: f64,
}

/// First and last row with a slice in contact, where the first tooth of the rows is `first_tooth`.
fn first_and_last(positions: &[ObservedSlicedPosition], first_tooth: i32) -> [usize; 2] {
    let rows = positions.iter().enumerate().flat_map(|(j, position)| {
        position.contacts.iter().map(move |contact| (contact.tooth - first_tooth) as usize * positions.len() + j)
    });
    rows.fold([usize::MAX, 0], |[first, last], row| [first.min(row), last.max(row)])
}

impl SlicedMesh {
    /// The mesh of the positions of one base pitch, in order (at least one).
    pub fn new(positions: &[ObservedSlicedPosition], slices: usize, base_pitch_mm: f64) -> Self {
        let count = positions.len();
        let teeth = positions.iter().flat_map(|position| &position.contacts).map(|contact| contact.tooth);
        let (first, last) = (teeth.clone().min().unwrap_or(0), teeth.max().unwrap_or(0));
        let rows = (last - first + 1) as usize * count;
        let spacing = base_pitch_mm / count as f64;
        let position_mm: Vec<f64> = (0..rows)
            .map(|row| positions[0].position_mm + f64::from(first) * base_pitch_mm + row as f64 * spacing)
            .collect();
        let zeros = vec![0.0; rows * slices];
        let mut mesh = Self {
            slices,
            position_mm,
            part_of_width: zeros.clone(),
            line_load_n_per_mm: zeros.clone(),
            peak_pressure_mpa: zeros.clone(),
            half_width_mm: zeros.clone(),
            equivalent_half_width_mm: zeros,
            at_sharp_edge: vec![false; rows * slices],
            transmission_error_mm: positions.iter().map(|at| at.transmission_error_mm).collect(),
            stiffness_n_per_mm2: positions.iter().filter_map(|at| at.stiffness_n_per_mm2).collect(),
            jumps: positions.iter().map(|at| at.jump_mm.map(|jump| (jump - at.position_mm) / spacing)).collect(),
            first_position_mm: positions[0].position_mm,
            base_pitch_mm,
            load_imbalance: positions.iter().map(|at| at.load_imbalance.abs()).fold(0.0, f64::max),
        };
        for (j, position) in positions.iter().enumerate() {
            for contact in &position.contacts {
                let row = (contact.tooth - first) as usize * count + j;
                let place = row * slices + contact.slice;
                mesh.part_of_width[place] = contact.part_of_width;
                mesh.line_load_n_per_mm[place] = contact.line_load_n_per_mm;
                mesh.peak_pressure_mpa[place] = contact.footprint.peak_pressure_mpa;
                mesh.half_width_mm[place] = contact.footprint.half_width_mm;
                mesh.equivalent_half_width_mm[place] = contact.footprint.equivalent_half_width_mm;
                mesh.at_sharp_edge[place] = contact.footprint.at_sharp_edge;
            }
        }
        mesh.between(first_and_last(positions, first))
    }

    /// The mesh from row `first` to row `last` alone.
    fn between(mut self, [first, last]: [usize; 2]) -> Self {
        let n = self.slices;
        self.position_mm = self.position_mm[first..=last].to_vec();
        let Self {
            part_of_width, line_load_n_per_mm, peak_pressure_mpa, half_width_mm, equivalent_half_width_mm, ..
        } = &mut self;
        for field in [part_of_width, line_load_n_per_mm, peak_pressure_mpa, half_width_mm, equivalent_half_width_mm] {
            *field = field[first * n..(last + 1) * n].to_vec();
        }
        self.at_sharp_edge = self.at_sharp_edge[first * n..(last + 1) * n].to_vec();
        self
    }

    /// Extends the mesh by the rows of `other`, another mesh of the pair at the same positions; nothing is in contact in them.
    pub fn with_rows_of(&self, other: &Self) -> Self {
        let spacing = self.base_pitch_mm / self.transmission_error_mm.len() as f64;
        let [[first_mm, last_mm], [other_first_mm, other_last_mm]] =
            [self, other].map(|mesh| [mesh.position_mm[0], mesh.position_mm[mesh.position_mm.len() - 1]]);
        let [before, after] = [first_mm - other_first_mm, other_last_mm - last_mm]
            .map(|length_mm| (length_mm / spacing).round().max(0.0) as usize);
        let down = (1..=before).rev().map(|row| first_mm - row as f64 * spacing);
        let up = (1..=after).map(|row| last_mm + row as f64 * spacing);
        let with_rows =
            |field: &Vec<f64>| [&vec![0.0; before * self.slices][..], field, &vec![0.0; after * self.slices]].concat();
        Self {
            position_mm: down.chain(self.position_mm.iter().copied()).chain(up).collect(),
            part_of_width: with_rows(&self.part_of_width),
            line_load_n_per_mm: with_rows(&self.line_load_n_per_mm),
            peak_pressure_mpa: with_rows(&self.peak_pressure_mpa),
            half_width_mm: with_rows(&self.half_width_mm),
            equivalent_half_width_mm: with_rows(&self.equivalent_half_width_mm),
            at_sharp_edge: [
                &vec![false; before * self.slices],
                &*self.at_sharp_edge,
                &vec![false; after * self.slices],
            ]
            .concat(),
            ..self.clone()
        }
    }

    /// Mean load of each slice over the mesh, all teeth together, N per mm of face width.
    pub(crate) fn mean_line_loads_n_per_mm(&self) -> Vec<f64> {
        let positions = self.transmission_error_mm.len() as f64;
        let rows = self.line_load_n_per_mm.chunks_exact(self.slices);
        let mut sums = vec![0.0; self.slices];
        for row in rows {
            sums.iter_mut().zip(row).for_each(|(sum, load)| *sum += load / positions);
        }
        sums
    }

    /// Face load factor K_Hβ: the greatest load of any slice over the mean of all, both averaged over the mesh (ISO 6336-1, 7).
    pub fn face_load_factor(&self) -> f64 {
        let loads = self.mean_line_loads_n_per_mm();
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        loads.iter().copied().fold(0.0, f64::max) / mean
    }

    /// Amplitudes of the first `count` mesh orders of the transmission error, mm.
    pub fn mesh_orders_mm(&self, count: usize) -> Vec<f64> {
        mesh_orders::of_even(&self.transmission_error_mm, count)
    }

    /// Greatest change of the transmission error from one position to the next, mm.
    pub fn greatest_step_mm(&self) -> f64 {
        let errors = &self.transmission_error_mm;
        let next = errors.iter().cycle().skip(1);
        errors.iter().zip(next).map(|(here, there)| (there - here).abs()).fold(0.0, f64::max)
    }

    /// The tooth as a whole at `count` positions of its middle from A to E, between those observed: all slices together under the
    /// whole line load `line_load_n_per_mm`.
    pub fn along_path(&self, path: &PathOfContact, count: usize, line_load_n_per_mm: f64) -> Vec<PositionObservation> {
        path.evenly_mm(count).into_iter().map(|at| self.at(at, line_load_n_per_mm)).collect()
    }

    fn at(&self, position_mm: f64, line_load_n_per_mm: f64) -> PositionObservation {
        let count = self.transmission_error_mm.len();
        let spacing = self.base_pitch_mm / count as f64;
        let first_row = ((self.position_mm[0] - self.first_position_mm) / spacing).round();
        let line = self.line_at((position_mm - self.first_position_mm) / spacing, first_row);
        let load = |row: usize| self.line_load_n_per_mm[self.slices_of(row)].iter().sum::<f64>() / self.slices as f64;
        PositionObservation {
            position_mm,
            transmission_error_mm: line.in_base_pitch(&self.transmission_error_mm),
            stiffness_n_per_mm2: (self.stiffness_n_per_mm2.len() == count)
                .then(|| line.in_base_pitch(&self.stiffness_n_per_mm2)),
            load_share: self.over_rows(line, first_row, load) / line_load_n_per_mm,
            load_imbalance: self.load_imbalance,
            footprint: Footprint {
                peak_pressure_mpa: self.over_rows(line, first_row, |row| self.greatest(&self.peak_pressure_mpa, row)),
                half_width_mm: self.over_rows(line, first_row, |row| self.greatest(&self.half_width_mm, row)),
                equivalent_half_width_mm: self
                    .over_rows(line, first_row, |row| self.greatest(&self.equivalent_half_width_mm, row)),
                at_sharp_edge: self.over_rows(line, first_row, |row| f64::from(u8::from(self.is_sharp(row)))) > 0.0,
            },
        }
    }

    /// Range of the slices of a row.
    fn slices_of(&self, row: usize) -> Range<usize> {
        row * self.slices..(row + 1) * self.slices
    }

    /// Greatest value of a field over the slices of a row.
    fn greatest(&self, field: &[f64], row: usize) -> f64 {
        field[self.slices_of(row)].iter().copied().fold(0.0, f64::max)
    }

    /// Whether the greatest pressure of a row is that of a slice at a sharp edge, and not defined.
    fn is_sharp(&self, row: usize) -> bool {
        let slices = self.slices_of(row);
        let most = slices.max_by(|&a, &b| self.peak_pressure_mpa[a].total_cmp(&self.peak_pressure_mpa[b]));
        most.is_some_and(|place| self.at_sharp_edge[place])
    }

    /// Value on `line` of a quantity of rows, the first of which is `first_row`; 0 in other rows.
    fn over_rows(&self, line: Line, first_row: f64, of_row: impl Fn(usize) -> f64) -> f64 {
        let rows = self.position_mm.len() as f64;
        line.value(|index| {
            let row = index - first_row;
            if row >= 0.0 && row < rows { of_row(row as usize) } else { 0.0 }
        })
    }

    /// The interpolation that holds at `place`, counted in positions from the first one on, of a tooth with rows from `first_row` on: linear between the
    /// positions around it, or where slices come or go at once between these, constant from the one on its side of the jump, so that the jump stays sharp.
    /// A tooth that touches from a jump to another touches at both.
    fn line_at(&self, place: f64, first_row: f64) -> Line {
        let (before, part) = (place.floor(), place - place.floor());
        let count = self.jumps.len();
        let Some(jump) = self.jumps[before.rem_euclid(count as f64) as usize % count] else {
            return Line { from: before, along: part };
        };
        let is_before = if (part - jump).abs() <= SAME_PLACE { before >= first_row } else { part < jump };
        Line { from: if is_before { before } else { before + 1.0 }, along: 0.0 }
    }
}

/// Part of the distance of positions within which two places are the same.
const SAME_PLACE: f64 = 1e-6;

/// Linear interpolation between a position and the next.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Line {
    /// Index of the position.
    from: f64,
    /// Part of the way to the next.
    along: f64,
}

impl Line {
    /// Value on the line of a quantity given by the index of the position.
    fn value(&self, at: impl Fn(f64) -> f64) -> f64 {
        let from = at(self.from);
        if self.along == 0.0 { from } else { from + self.along * (at(self.from + 1.0) - from) }
    }

    /// Value on the line of a quantity with the period of the base pitch.
    fn in_base_pitch(&self, values: &[f64]) -> f64 {
        self.value(|index| values[index.rem_euclid(values.len() as f64) as usize % values.len()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mesh that is in contact from one position to another, of four in a base pitch of 2 mm, with one slice.
    fn mesh(first: i32, last: i32) -> SlicedMesh {
        let positions = [0, 1, 2, 3].map(|j: i32| {
            let in_contact = (first..=last).filter(|row| row.rem_euclid(4) == j);
            let contacts = in_contact.map(|row| ObservedContact {
                tooth: row.div_euclid(4),
                slice: 0,
                part_of_width: 1.0,
                line_load_n_per_mm: f64::from(row),
                footprint: Footprint {
                    peak_pressure_mpa: 1.0,
                    half_width_mm: 0.1,
                    equivalent_half_width_mm: 0.1,
                    at_sharp_edge: true,
                },
            });
            ObservedSlicedPosition {
                position_mm: 10.0 + 0.5 * f64::from(j),
                transmission_error_mm: 0.01,
                stiffness_n_per_mm2: None,
                jump_mm: None,
                load_imbalance: 0.0,
                contacts: contacts.collect(),
            }
        });
        SlicedMesh::new(&positions, 1, 2.0)
    }

    /// Worn teeth touch over other rows than new ones: each mesh gets those of the other, without contact.
    #[test]
    fn meshes_have_each_others_rows() {
        let (new, worn) = (mesh(-3, 6), mesh(-1, 9));
        let [new, worn] = [new.with_rows_of(&worn), worn.with_rows_of(&new)];
        fn of(value: fn(i32) -> f64) -> Vec<f64> {
            (-3..=9).map(value).collect()
        }
        assert_eq!((&new.position_mm, &worn.position_mm), (&of(|row| 10.0 + 0.5 * f64::from(row)), &new.position_mm));
        assert_eq!(new.line_load_n_per_mm, of(|row| if row > 6 { 0.0 } else { f64::from(row) }));
        assert_eq!(worn.line_load_n_per_mm, of(|row| if row < -1 { 0.0 } else { f64::from(row) }));
        for mesh in [&new, &worn] {
            let lengths = [&mesh.part_of_width, &mesh.peak_pressure_mpa, &mesh.half_width_mm].map(Vec::len);
            assert_eq!((lengths, mesh.at_sharp_edge.len()), ([13; 3], 13));
        }
    }
}
