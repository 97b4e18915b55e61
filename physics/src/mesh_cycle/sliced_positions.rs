//! Positions of the mesh of a sliced pair, with the slices of all teeth in contact, while the gears turn by one base pitch.
//!
//! Every tooth of a gear passes through the same mesh, one base pitch after the other: tooth k stands where the reference tooth 0 stands k base
//! pitches later, and one base pitch of positions suffices. With ξ the position of tooth 0 in the middle of the
//! face width, slice i of tooth k has its theoretical contact point at
//!
//! ```text
//! ξ_ki = ξ + k p_bt + (b/2 − z_i) tan β_b         in contact while  A ≤ ξ_ki ≤ E
//! ```
//!
//! Positions divide the base pitch evenly. Each represents the stretch halfway to its neighbours, cut where a slice enters or
//! leaves, so that no stretch spans a jump of the load; the first and the last stretch of a slice end at A and E, so that the
//! stretches of every slice cover A–E without gap. Summed over all slices, their length is that of all
//! lines of contact,
//!
//! ```text
//! Σ Δξ Δz / (p_bt cos β_b) = ε_α b / cos β_b
//! ```
//!
//! The line of contact is oblique, so that it enters a slice gradually: over its width Δz, ξ_ki varies by Δa = Δz tan β_b, and the part
//!
//! ```text
//! f(ξ_ki) = |[ξ_ki − Δa/2, ξ_ki + Δa/2] ∩ [A, E]| / Δa
//! ```
//!
//! of the slice is in contact ([`SliceEnds::Gradual`]). A position has the mean of f over its stretch: load, stiffness and wear then grow and fall
//! without a jump, and the lines of contact keep their length exactly. Where the middle of a slice is before A or after E, the part of
//! it in contact is not: its stretch is folded back at A or E. As f is the indicator of [A, E] averaged over Δa, folded and other stretches
//! add to 1: ∫ f over all ξ_ki that represent a place of the path is 1, and all places are worn equally often.

use std::collections::BTreeSet;

use crate::contact::PositionCell;
use gearwear_bodies::gear::{path_of_contact::PathOfContact, slices::Slices};

/// Part of the base pitch within which two places of the path are the same.
const SAME_PLACE: f64 = 1e-9;

/// Part of a slice in contact up to which it carries nothing.
const LEAST_PART: f64 = 1e-9;

/// Part of all contacts that comes or goes at once above which loads jump.
const JUMP: f64 = 0.05;

/// A slice of a tooth in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceContact {
    /// Tooth: k base pitches ahead of the reference tooth.
    pub tooth: i32,
    /// Slice.
    pub slice: usize,
    /// Theoretical contact point, and its stretch of the path.
    pub cell: PositionCell,
    /// Part of the slice in contact.
    pub part: ContactPart,
}

/// Part of the width of a slice that is in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPart {
    /// Mean part of the width over the stretch: above 0, at most 1.
    pub of_width: f64,
    /// Part of the width that passes the stretch of the contact: another one only where the stretch is folded in itself.
    pub of_passage: f64,
}

impl ContactPart {
    /// The whole width.
    pub const WHOLE: Self = Self { of_width: 1.0, of_passage: 1.0 };
}

/// Begin and end of the contact of slices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SliceEnds {
    /// All at once, at A and E.
    AtOnce,
    /// Gradually, as the line of contact enters them at A and leaves them at E; all at once where it does so between two positions.
    Gradual,
    /// By first touch, at most so far before A and after E, mm.
    Beyond([f64; 2]),
}

/// A position of the gears with all slices in contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SlicedPosition {
    /// Position of the reference tooth in the middle of the face width: from A on, less than a base pitch.
    pub position_mm: f64,
    /// The contacts, tooth by tooth and slice by slice.
    pub contacts: Vec<SliceContact>,
    /// Whether slices come or go at once between here and the next position.
    pub jumps: bool,
    /// Where they do, if all in one place.
    pub jump_mm: Option<f64>,
}

/// Positions of one base pitch, no farther apart than `positions` (≥ 2) from A to E. Where slices come into contact all at once,
/// stretches are cut.
pub fn sliced_positions(
    path: &PathOfContact,
    slices: &Slices,
    positions: usize,
    ends: SliceEnds,
) -> Vec<SlicedPosition> {
    let pitch = path.base_pitch_mm;
    let count = (((positions - 1) as f64 / path.contact_ratio() * (1.0 - SAME_PLACE)).ceil() as usize).max(1);
    let [before, after] = if let SliceEnds::Beyond(beyond_mm) = ends { beyond_mm } else { [0.0; 2] };
    let passage = SlicePassage {
        first_mm: path.start_mm - before,
        last_mm: path.end_mm + after,
        by_first_touch: matches!(ends, SliceEnds::Beyond(_)),
        pitch_mm: pitch,
        ahead_mm: &slices.ahead_mm,
    };
    let spacing = pitch / count as f64;
    let places: Vec<f64> = (0..count).map(|j| path.start_mm + (j as f64 + 0.5) * spacing).collect();
    let varies_mm = slices.ahead_varies_mm;
    if ends == SliceEnds::Gradual && varies_mm >= spacing {
        let positions = places.iter().map(|&position_mm| {
            let contacts = passage.parts(position_mm, 0.5 * spacing, varies_mm);
            SlicedPosition { position_mm, contacts, jumps: false, jump_mm: None }
        });
        return positions.collect();
    }
    let Zones { decided_at, bounds, one_change } = if passage.by_first_touch {
        let bounds = places.iter().map(|place| [place - 0.5 * spacing, place + 0.5 * spacing]).collect();
        Zones { decided_at: places.clone(), bounds, one_change: vec![false; count] }
    } else {
        let changes = passage.changes_mm(path.start_mm);
        PeriodicPlaces { places: &places, period: pitch, changes: &changes }.zones()
    };
    let mut positions: Vec<SlicedPosition> = (0..count)
        .map(|j| {
            let around = [-1, 0, 1].map(|step| {
                let k = j as i32 + step;
                let turns = k.div_euclid(count as i32);
                decided_at[k.rem_euclid(count as i32) as usize] + f64::from(turns) * pitch
            });
            let contacts = passage.contacts(bounds[j], around);
            SlicedPosition { position_mm: places[j], contacts, jumps: false, jump_mm: None }
        })
        .collect();
    if !passage.by_first_touch {
        for (j, jumps) in jumps(&positions).into_iter().enumerate() {
            positions[j].jumps = jumps;
            positions[j].jump_mm = (jumps && one_change[j]).then_some(bounds[j][1]);
        }
    }
    positions
}

/// Whether slices come or go at once between each of the `positions` of a base pitch and the next.
fn jumps(positions: &[SlicedPosition]) -> Vec<bool> {
    let after = (0..positions.len()).map(|index| {
        // The first position comes again a base pitch later, when each tooth is where the one ahead of it was.
        let (next, ahead) = if index + 1 < positions.len() { (index + 1, 0) } else { (0, 1) };
        let [before, after] = [(index, 0), (next, ahead)].map(|(at, ahead)| -> BTreeSet<(i32, usize)> {
            positions[at].contacts.iter().map(|contact| (contact.tooth - ahead, contact.slice)).collect()
        });
        let changed = before.symmetric_difference(&after).count();
        changed as f64 > JUMP * before.len().max(after.len()) as f64
    });
    after.collect()
}

/// Passage of slices through the mesh.
struct SlicePassage<'a> {
    /// First touch of a slice.
    first_mm: f64,
    /// Last touch of a slice.
    last_mm: f64,
    /// Whether contact begins there without load.
    by_first_touch: bool,
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

    /// Contacts in the stretch of the reference tooth within `bounds`; `decided_at` are the places at which contact is decided for the
    /// stretch before, this one, and the one after.
    fn contacts(&self, bounds: [f64; 2], decided_at: [f64; 3]) -> Vec<SliceContact> {
        let [before, here, after] = decided_at;
        let mut contacts = Vec::new();
        for tooth in self.teeth_near(here, 0.0) {
            for (slice, ahead) in self.ahead_mm.iter().enumerate() {
                let shift = f64::from(tooth) * self.pitch_mm + ahead;
                if !self.touches(here + shift) {
                    continue;
                }
                let lower_mm = if self.touches(before + shift) { bounds[0] + shift } else { self.first_mm };
                let upper_mm = if self.touches(after + shift) { bounds[1] + shift } else { self.last_mm };
                // A contact stands in the middle of its stretch, so that the wear of a cut stretch is of second order too; one that begins by first touch
                // stands at its own place, which decides its load.
                let position_mm = if self.by_first_touch { here + shift } else { lower_mm.midpoint(upper_mm) };
                let cell = PositionCell { position_mm, lower_mm, upper_mm };
                contacts.push(SliceContact { tooth, slice, cell, part: ContactPart::WHOLE });
            }
        }
        contacts
    }

    /// Teeth that may have a slice in contact with the reference tooth at `at_mm`, where slices reach by `beyond_middle_mm` beyond their middles.
    fn teeth_near(&self, at_mm: f64, beyond_middle_mm: f64) -> std::ops::RangeInclusive<i32> {
        let reach = self.ahead_mm.iter().fold(0.0, |reach: f64, ahead| reach.max(ahead.abs())) + beyond_middle_mm;
        let first_tooth = ((self.first_mm - at_mm - reach) / self.pitch_mm).floor() as i32;
        let last_tooth = ((self.last_mm - at_mm + reach) / self.pitch_mm).ceil() as i32;
        first_tooth..=last_tooth
    }

    /// Contacts in the stretch `half_mm` to either side of the reference tooth at `at_mm`, each of the part of its slice that the
    /// line of contact has entered and not left; the place of the contact varies by `varies_mm` over the width of a slice.
    fn parts(&self, at_mm: f64, half_mm: f64, varies_mm: f64) -> Vec<SliceContact> {
        let mut contacts = Vec::new();
        for tooth in self.teeth_near(at_mm, 0.5 * varies_mm + half_mm) {
            for (slice, ahead) in self.ahead_mm.iter().enumerate() {
                let middle = at_mm + f64::from(tooth) * self.pitch_mm + ahead;
                let [begin_mm, end_mm] = [middle - half_mm, middle + half_mm].map(|x| {
                    ramp_integral_mm(x - self.first_mm, varies_mm) - ramp_integral_mm(x - self.last_mm, varies_mm)
                });
                let in_contact_mm = end_mm - begin_mm;
                let of_width = (in_contact_mm / (2.0 * half_mm)).min(1.0);
                if of_width <= LEAST_PART {
                    continue;
                }
                let [lower_mm, upper_mm] = self.folded([middle - half_mm, middle + half_mm]);
                let of_passage = in_contact_mm / (upper_mm - lower_mm);
                let cell = PositionCell { position_mm: lower_mm.midpoint(upper_mm), lower_mm, upper_mm };
                // Rounding errors make no part of a whole.
                let is_whole = of_width > 1.0 - LEAST_PART;
                let part = if is_whole { ContactPart::WHOLE } else { ContactPart { of_width, of_passage } };
                contacts.push(SliceContact { tooth, slice, cell, part });
            }
        }
        contacts
    }

    /// Stretch between A and E that `stretch` covers, folded back at both.
    fn folded(&self, stretch: [f64; 2]) -> [f64; 2] {
        let (first, length) = (self.first_mm, self.last_mm - self.first_mm);
        let [begin, end] = stretch.map(|x| {
            let within = (x - first).rem_euclid(2.0 * length);
            first + if within > length { 2.0 * length - within } else { within }
        });
        let (low, high) = (begin.min(end), begin.max(end));
        // The stretch covers an end of the path that lies inside it.
        let [holds_first, holds_last] = [first, self.last_mm].map(|place| stretch[0] < place && place < stretch[1]);
        [if holds_first { first } else { low }, if holds_last { self.last_mm } else { high }]
    }
}

/// ∫ up to `x_mm` of the ramp that rises from 0 to 1 over `varies_mm` around 0.
fn ramp_integral_mm(x_mm: f64, varies_mm: f64) -> f64 {
    let along = (x_mm + 0.5 * varies_mm).max(0.0);
    if along < varies_mm { 0.5 * along * along / varies_mm } else { along - 0.5 * varies_mm }
}

/// Zones between changes of the contacts, for each place.
struct Zones {
    /// Middle of the zone of the place, where contact is decided.
    decided_at: Vec<f64>,
    /// Bounds of the stretch: halfway to the next place, or the change where the zone of that place begins.
    bounds: Vec<[f64; 2]>,
    /// Whether one change lies between the place and the next.
    one_change: Vec<bool>,
}

/// Evenly spaced places of a period, and the changes of the contacts in it; places, zones and changes are numbered on over periods.
struct PeriodicPlaces<'a> {
    places: &'a [f64],
    period: f64,
    changes: &'a [f64],
}

impl PeriodicPlaces<'_> {
    fn place(&self, j: i32) -> f64 {
        let count = self.places.len() as i32;
        self.places[j.rem_euclid(count) as usize] + f64::from(j.div_euclid(count)) * self.period
    }

    /// Zone of a place, by the number of the change where it begins.
    fn zone(&self, j: i32) -> i32 {
        let count = self.places.len() as i32;
        let (turns, within) = (j.div_euclid(count), self.places[j.rem_euclid(count) as usize]);
        let after = self.changes.partition_point(|&change| change < within - SAME_PLACE * self.period) as i32;
        after - 1 + turns * self.changes.len() as i32
    }

    fn change(&self, number: i32) -> f64 {
        let many = self.changes.len() as i32;
        self.changes[number.rem_euclid(many) as usize] + f64::from(number.div_euclid(many)) * self.period
    }

    fn bound_after(&self, j: i32) -> f64 {
        let zone_after = self.zone(j + 1);
        if self.zone(j) == zone_after { self.place(j).midpoint(self.place(j + 1)) } else { self.change(zone_after) }
    }

    fn zones(&self) -> Zones {
        let places = 0..self.places.len() as i32;
        let zones = places.clone().map(|j| self.zone(j));
        Zones {
            decided_at: zones.map(|zone| self.change(zone).midpoint(self.change(zone + 1))).collect(),
            bounds: places.clone().map(|j| [self.bound_after(j - 1), self.bound_after(j)]).collect(),
            one_change: places.map(|j| self.zone(j + 1) == self.zone(j) + 1).collect(),
        }
    }
}
