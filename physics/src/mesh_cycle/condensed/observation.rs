//! Observation of the mesh cycle on the finite-element model: the reference pair from A to E, pressures and sliding, from the pairs found in one base
//! pitch.

use super::{CondensedCycle, CondensedPosition};
use crate::contact::Footprint;
use crate::contact::flank_pressure::PressureFigures;
use crate::mesh_cycle::condensed_contact::parts_of_rows;
use crate::mesh_cycle::{CycleObservation, FlankOverlap, GreatestPressure, PositionObservation, range_mm};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::gear_fem::flank_nodes::Weights;
use gearwear_bodies::reference::monotone_cubic::MonotoneCubic;

impl CondensedCycle<'_> {
    /// Observation of the last evaluation: positions from A to E are between those of the base pitch.
    pub(super) fn observation(&self) -> CycleObservation {
        let zeros = PerGear::from_fn(|gear| vec![0.0; self.nodes[gear].len()]);
        let mut observation = CycleObservation {
            positions: self.along_the_path(),
            shares_at_ends: Some(self.shares_at_ends()),
            greatest_pressure: self.greatest_pressure(),
            pressure_figures: self.pressure_figures(),
            pressure_mpa: zeros.clone(),
            sliding_mm: zeros,
            sliding_work_n: None,
            slices: None,
            deepest_overlap: self
                .loaded_positions()
                .filter_map(CondensedPosition::overlap)
                .reduce(FlankOverlap::deeper),
            transmission_error_beside_jumps_mm: self.beside_jumps_mm(),
        };
        let mut sliding_work_n = 0.0;
        for loaded in self.loaded_positions() {
            let Some(found) = &loaded.found else { continue };
            for contact in &loaded.transfers {
                for i in 0..contact.len() {
                    let force = found.force[contact.first_row + i];
                    if force <= 0.0 {
                        continue;
                    }
                    sliding_work_n += force * contact.sliding_mm[i];
                    let pressure = force / contact.weight_mm[i];
                    for gear in Gear::BOTH {
                        let Weights { first, weights } = contact.means[gear].row(i);
                        for (k, m) in weights.iter().enumerate().filter(|(_, m)| **m > 0.0) {
                            let greatest = &mut observation.pressure_mpa[gear][first + k];
                            *greatest = greatest.max(pressure);
                            observation.sliding_mm[gear][first + k] +=
                                m * contact.weight_mm[i] / self.nodes[gear].share_mm[first + k] * contact.sliding_mm[i];
                        }
                    }
                }
            }
        }
        observation.sliding_work_n = Some(sliding_work_n);
        observation
    }

    /// Greatest pressure of all pairs found in the base pitch.
    fn greatest_pressure(&self) -> GreatestPressure {
        let mut greatest = GreatestPressure::default();
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            for pair in self.model.tooth_pairs(&loaded.prepared, equilibrium) {
                greatest.note(pair.peak_pressure_mpa, pair.at_sharp_edge);
            }
        }
        greatest
    }

    /// Figures of the pressure of all pairs found in the base pitch.
    fn pressure_figures(&self) -> PressureFigures {
        let mut figures = PressureFigures::default();
        let Some(zones) = &self.zones else { return figures };
        for loaded in self.loaded_positions() {
            let Some(found) = &loaded.found else { continue };
            for contact in &loaded.transfers {
                let force = &found.force[contact.first_row..contact.first_row + contact.len()];
                let (parts, cells) = parts_of_rows(contact, force, self.radius_mm(), zones);
                parts.note(&cells, &mut figures);
            }
        }
        figures
    }

    /// Transmission error on both sides of the places where load comes in or leaves at once, mm: linear from the two positions on that side, for the
    /// error rises up to a jump, and the position next to it is half a stretch away.
    fn beside_jumps_mm(&self) -> Vec<f64> {
        let at: Vec<&CondensedPosition> = self.loaded_positions().collect();
        let error_mm = |index: usize| at[index].found.as_ref().map(|found| found.rigid[0]);
        let length_mm = |index: usize| at[index].stretch_mm.1 - at[index].stretch_mm.0;
        let (before, after) = (|index: usize| (index + at.len() - 1) % at.len(), |index: usize| (index + 1) % at.len());
        let begins_at_jump = |index: usize| self.after_jumps.contains(&index);
        // At the end of the stretch of the position `near` that is away from the position `far`, between which may be another jump.
        let at_end_mm = |near: usize, far: usize, jumps_between: bool| {
            let (near_mm, far_mm) = (error_mm(near)?, error_mm(far)?);
            let of_stretches = [(near_mm, length_mm(near)), (far_mm, length_mm(far))];
            Some(if jumps_between { near_mm } else { linear_to_end(of_stretches) })
        };
        let both_sides = self.after_jumps.iter().flat_map(|&jump| {
            let last = before(jump);
            [
                at_end_mm(last, before(last), begins_at_jump(last)),
                at_end_mm(jump, after(jump), begins_at_jump(after(jump))),
            ]
        });
        both_sides.flatten().collect()
    }

    /// Greatest less least transmission error, mm.
    pub(super) fn range_of_transmission_error_mm(&self) -> f64 {
        let mut found: Vec<(f64, f64)> = Vec::new();
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            found.extend(self.places_mm(loaded).map(|(_, place_mm)| (place_mm, equilibrium.rigid[0])));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (places, errors_mm): (Vec<f64>, Vec<f64>) = found.into_iter().unzip();
        let course = MonotoneCubic::new(&places, &errors_mm);
        let errors_mm = self.observation_mm.iter().map(|&position_mm| course.at(position_mm));
        range_mm(errors_mm.chain(self.beside_jumps_mm()))
    }

    /// Load shares of the first and the last pair along the path.
    fn shares_at_ends(&self) -> [f64; 2] {
        let mut ends = [(f64::INFINITY, 0.0), (f64::NEG_INFINITY, 0.0)];
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            for pair in self.model.tooth_pairs(&loaded.prepared, equilibrium) {
                let at_mm = loaded.prepared.position_mm + f64::from(pair.pair) * self.model.pair.path.base_pitch_mm;
                let share = pair.line_load_n_per_mm / self.line_load_n_per_mm;
                if at_mm < ends[0].0 {
                    ends[0] = (at_mm, share);
                }
                if at_mm > ends[1].0 {
                    ends[1] = (at_mm, share);
                }
            }
        }
        ends.map(|(_, share)| share)
    }

    /// Number of each pair that is on the path or beside its ends where the reference pair is at a position, and its own place, mm.
    fn places_mm(&self, loaded: &CondensedPosition) -> impl Iterator<Item = (i32, f64)> + use<> {
        let (at_mm, path) = (loaded.prepared.position_mm, &self.model.pair.path);
        let (start_mm, end_mm, base_pitch_mm) = (path.start_mm, path.end_mm, path.base_pitch_mm);
        let first = ((start_mm - at_mm) / base_pitch_mm).floor() as i32;
        let last = ((end_mm - at_mm) / base_pitch_mm).ceil() as i32;
        (first..=last).map(move |ahead| (ahead, at_mm + f64::from(ahead) * base_pitch_mm))
    }

    /// The reference pair from A to E, from the pairs found in the base pitch.
    fn along_the_path(&self) -> Vec<PositionObservation> {
        let load = self.line_load_n_per_mm;
        let mut found: Vec<PositionObservation> = Vec::new();
        for loaded in self.loaded_positions() {
            let Some(equilibrium) = &loaded.found else { continue };
            let pairs = self.model.tooth_pairs(&loaded.prepared, equilibrium);
            let total: f64 = pairs.iter().map(|pair| pair.line_load_n_per_mm).sum();
            found.extend(self.places_mm(loaded).map(|(ahead, position_mm)| {
                let pair = pairs.iter().find(|pair| pair.pair == ahead);
                PositionObservation {
                    position_mm,
                    transmission_error_mm: equilibrium.rigid[0],
                    stiffness_n_per_mm2: equilibrium.resistance.first().copied(),
                    load_share: pair.map_or(0.0, |pair| pair.line_load_n_per_mm / load),
                    load_imbalance: total / load - 1.0,
                    footprint: pair.map_or_else(Footprint::default, |pair| Footprint {
                        peak_pressure_mpa: pair.peak_pressure_mpa,
                        half_width_mm: pair.half_width_mm,
                        equivalent_half_width_mm: loaded.equivalent_half_width_mm(ahead, equilibrium),
                        at_sharp_edge: pair.at_sharp_edge,
                    }),
                }
            }));
        }
        found.sort_by(|a, b| a.position_mm.total_cmp(&b.position_mm));
        let places: Vec<f64> = found.iter().map(|at| at.position_mm).collect();
        let figures: [fn(&PositionObservation) -> f64; 7] = [
            |at| at.transmission_error_mm,
            |at| at.stiffness_n_per_mm2.unwrap_or_default(),
            |at| at.load_share,
            |at| at.load_imbalance,
            |at| at.footprint.peak_pressure_mpa,
            |at| at.footprint.half_width_mm,
            |at| at.footprint.equivalent_half_width_mm,
        ];
        let values = figures.map(|figure| found.iter().map(figure).collect::<Vec<f64>>());
        let courses = values.each_ref().map(|values| MonotoneCubic::new(&places, values));
        let observed = self.observation_mm.iter().map(|&position_mm| {
            let [
                transmission_error_mm,
                stiffness,
                load_share,
                load_imbalance,
                peak_pressure_mpa,
                half_width_mm,
                equivalent_half_width_mm,
            ] = courses.each_ref().map(|course| course.at(position_mm));
            // Between two positions of which one is at a sharp edge, all counts as at a sharp edge.
            let after = places.partition_point(|&place| place < position_mm);
            let around = &found[after.saturating_sub(1)..(after + 1).min(found.len())];
            let at_sharp_edge = around.iter().any(|at| at.footprint.at_sharp_edge);
            PositionObservation {
                position_mm,
                transmission_error_mm,
                stiffness_n_per_mm2: Some(stiffness),
                load_share,
                load_imbalance,
                footprint: Footprint { peak_pressure_mpa, half_width_mm, equivalent_half_width_mm, at_sharp_edge },
            }
        });
        observed.collect()
    }
}

/// Value at the end of the first of two neighbouring stretches that is away from the second, linear from those in the middle of each; a stretch is its value
/// with its length.
fn linear_to_end([(near, near_length), (far, far_length)]: [(f64, f64); 2]) -> f64 {
    near + (near - far) * near_length / (near_length + far_length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear course is found at the end of stretches of any lengths: 1 + 2 x at x = 0, from stretches that end at 0, 0.3 and 0.8.
    #[test]
    fn ver_linear_courses_are_carried_to_a_jump() {
        let course = |x: f64| 1.0 + 2.0 * x;
        let found = linear_to_end([(course(0.15), 0.3), (course(0.55), 0.5)]);
        assert!((found - course(0.0)).abs() < 1e-12, "{found}");
    }
}
