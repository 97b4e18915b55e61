//! Phases of the mesh of a sliced pair: which slices of which teeth touch while the gears turn by one base pitch.
//!
//! Every tooth of a gear passes through the same mesh, one base pitch after the other, so one base pitch of phases tells all:
//! tooth k stands where the reference tooth 0 stands k base pitches later. With ξ the position of tooth 0 in the middle of the
//! face width, slice i of tooth k has its theoretical contact point at
//!
//! ```text
//! ξ_ki = ξ + k p_bt + (b/2 − z_i) tan β_b         in contact while  A ≤ ξ_ki ≤ E
//! ```
//!
//! Phases divide the base pitch evenly. Each stands for the stretch halfway to its neighbours, cut where a slice enters or
//! leaves, so that no stretch spans a jump of the load; the first and the last stretch of a slice end at A and E whatever lies
//! between, so that the stretches of every slice cover A–E without gap. Summed over all slices, their length is that of all
//! lines of contact,
//!
//! ```text
//! Σ Δξ Δz / (p_bt cos β_b) = ε_α b / cos β_b
//! ```

use crate::contact::PositionCell;
use crate::gear::{path_of_contact::PathOfContact, slices::Slices};

/// Distances along the path are compared to this part of the base pitch.
const SAME_PLACE: f64 = 1e-9;

/// A slice of a tooth in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SliceContact {
    /// Which tooth: k base pitches ahead of the reference tooth.
    pub tooth: i32,
    /// Which slice.
    pub slice: usize,
    /// Where its theoretical contact point is, and the stretch of the path that stands for.
    pub cell: PositionCell,
}

/// A place of the gears and everything that touches there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SlicedPosition {
    /// Position of the reference tooth in the middle of the face width: from A on, less than a base pitch.
    pub position_mm: f64,
    /// The contacts, tooth by tooth and slice by slice.
    pub contacts: Vec<SliceContact>,
}

/// Phases of one base pitch, no farther apart than `positions` (≥ 2) from A to E would be. With `beyond_mm`, slices may touch so
/// far before A and after E, where they begin and end without a jump, and no stretch is cut.
pub(crate) fn sliced_positions(
    path: &PathOfContact,
    slices: &Slices,
    positions: usize,
    beyond_mm: Option<[f64; 2]>,
) -> Vec<SlicedPosition> {
    let pitch = path.base_pitch_mm;
    let count = (((positions - 1) as f64 / path.contact_ratio() * (1.0 - SAME_PLACE)).ceil() as usize).max(1);
    let [before, after] = beyond_mm.unwrap_or_default();
    let passage = SlicePassage {
        first_mm: path.start_mm - before,
        last_mm: path.end_mm + after,
        pitch_mm: pitch,
        ahead_mm: &slices.ahead_mm,
    };
    let spacing = pitch / count as f64;
    let places: Vec<f64> = (0..count).map(|j| path.start_mm + (j as f64 + 0.5) * spacing).collect();
    // Where each place's contacts are decided, and where its stretch begins and ends.
    let (decided_at, bounds) = if beyond_mm.is_some() {
        let bounds = places.iter().map(|place| [place - 0.5 * spacing, place + 0.5 * spacing]).collect();
        (places.clone(), bounds)
    } else {
        zones(&places, pitch, &passage.changes_mm(path.start_mm))
    };
    (0..count)
        .map(|j| {
            let neighbour = |step: i32| {
                let k = j as i32 + step;
                let turns = k.div_euclid(count as i32);
                decided_at[k.rem_euclid(count as i32) as usize] + f64::from(turns) * pitch
            };
            let contacts = passage.contacts(bounds[j], [neighbour(-1), decided_at[j], neighbour(1)]);
            SlicedPosition { position_mm: places[j], contacts }
        })
        .collect()
}

/// How slices go through the mesh.
struct SlicePassage<'a> {
    /// First touch of a slice.
    first_mm: f64,
    /// Its last.
    last_mm: f64,
    pitch_mm: f64,
    ahead_mm: &'a [f64],
}

impl SlicePassage<'_> {
    /// Positions of the reference tooth, from `start_mm` on within a base pitch, at which a slice enters or leaves; in order.
    fn changes_mm(&self, start_mm: f64) -> Vec<f64> {
        let mut changes: Vec<f64> = self
            .ahead_mm
            .iter()
            .flat_map(|ahead| [self.first_mm - ahead, self.last_mm - ahead])
            .map(|at| start_mm + (at - start_mm).rem_euclid(self.pitch_mm))
            .collect();
        changes.sort_by(f64::total_cmp);
        changes.dedup_by(|a, b| (*a - *b).abs() <= 2.0 * SAME_PLACE * self.pitch_mm);
        changes
    }

    fn touches(&self, at_mm: f64) -> bool {
        (self.first_mm..=self.last_mm).contains(&at_mm)
    }

    /// The contacts in the stretch of the reference tooth that has `bounds`; `decided_at` are the places where it is decided who
    /// touches in the stretch before, here, and after.
    fn contacts(&self, bounds: [f64; 2], decided_at: [f64; 3]) -> Vec<SliceContact> {
        let [before, here, after] = decided_at;
        let reach = self.ahead_mm.iter().fold(0.0, |reach: f64, ahead| reach.max(ahead.abs()));
        let first_tooth = ((self.first_mm - here - reach) / self.pitch_mm).floor() as i32;
        let last_tooth = ((self.last_mm - here + reach) / self.pitch_mm).ceil() as i32;
        let mut contacts = Vec::new();
        for tooth in first_tooth..=last_tooth {
            for (slice, ahead) in self.ahead_mm.iter().enumerate() {
                let shift = f64::from(tooth) * self.pitch_mm + ahead;
                if !self.touches(here + shift) {
                    continue;
                }
                let lower_mm = if self.touches(before + shift) { bounds[0] + shift } else { self.first_mm };
                let upper_mm = if self.touches(after + shift) { bounds[1] + shift } else { self.last_mm };
                // A contact stands in the middle of its stretch, so that what a cut stretch wears is of second order too.
                let position_mm = lower_mm.midpoint(upper_mm);
                contacts.push(SliceContact { tooth, slice, cell: PositionCell { position_mm, lower_mm, upper_mm } });
            }
        }
        contacts
    }
}

/// For each of the evenly spaced `places` of a period: the middle of the zone between `changes` that holds it, and the bounds of
/// its stretch: halfway to the next place, or the change where that place's zone begins.
fn zones(places: &[f64], period: f64, changes: &[f64]) -> (Vec<f64>, Vec<[f64; 2]>) {
    let count = places.len() as i32;
    let place = |j: i32| places[j.rem_euclid(count) as usize] + f64::from(j.div_euclid(count)) * period;
    // The zone of a place as the change where it begins, with its number, which grows over periods.
    let zone = |j: i32| {
        let (turns, within) = (j.div_euclid(count), places[j.rem_euclid(count) as usize]);
        let after = changes.partition_point(|&change| change < within - SAME_PLACE * period) as i32;
        after - 1 + turns * changes.len() as i32
    };
    let change = |number: i32| {
        let many = changes.len() as i32;
        changes[number.rem_euclid(many) as usize] + f64::from(number.div_euclid(many)) * period
    };
    let bound_after = |j: i32| {
        if zone(j) == zone(j + 1) { place(j).midpoint(place(j + 1)) } else { change(zone(j + 1)) }
    };
    let middles = (0..count).map(|j| change(zone(j)).midpoint(change(zone(j) + 1))).collect();
    let bounds = (0..count).map(|j| [bound_after(j - 1), bound_after(j)]).collect();
    (middles, bounds)
}
