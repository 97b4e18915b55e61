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
//!
//! The line of contact is oblique, so that it enters a slice gradually: over its width Δz, ξ_ki varies by Δa = Δz tan β_b, and the part
//!
//! ```text
//! f(ξ_ki) = |[ξ_ki − Δa/2, ξ_ki + Δa/2] ∩ [A, E]| / Δa
//! ```
//!
//! of the slice is in contact ([`SliceEnds::Gradual`]). A phase has the mean of f over its stretch: load, stiffness and wear then grow and fall
//! without a jump, and the lines of contact keep their length exactly. Where the middle of a slice is before A or after E, the part of
//! it that is in contact is not: its stretch is folded back at A or E. Since f is the indicator of [A, E] averaged over Δa, what is folded there
//! adds to 1 with what is not, ∫ f over all ξ_ki that stand for a place of the path is 1 at every place, and every place is worn as often as
//! any other.

use std::collections::BTreeSet;

use crate::contact::PositionCell;
use crate::gear::{path_of_contact::PathOfContact, slices::Slices};

/// Distances along the path are compared to this part of the base pitch.
const SAME_PLACE: f64 = 1e-9;

/// A slice of which no more than this part is in contact carries nothing.
const LEAST_PART: f64 = 1e-9;

/// Where more than this part of all contacts comes or goes at once, loads jump; where less does, they change as from any position to the next.
const JUMP: f64 = 0.05;

/// A slice of a tooth in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceContact {
    /// Which tooth: k base pitches ahead of the reference tooth.
    pub tooth: i32,
    /// Which slice.
    pub slice: usize,
    /// Where its theoretical contact point is, and the stretch of the path that stands for.
    pub cell: PositionCell,
    /// How much of the slice that is.
    pub part: ContactPart,
}

/// How much of the width of a slice is in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPart {
    /// Part of its width, as mean over the phase: above 0, and 1 at most.
    pub of_width: f64,
    /// Part of its width that passes the stretch of the contact: another one only where the stretch is folded in itself.
    pub of_passage: f64,
}

impl ContactPart {
    /// The whole width.
    pub const WHOLE: Self = Self { of_width: 1.0, of_passage: 1.0 };
}

/// How slices come into contact, and leave it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SliceEnds {
    /// All at once, at A and E.
    AtOnce,
    /// As the line of contact enters them at A and leaves them at E; all at once where it does so between two positions.
    Gradual,
    /// By first touch, at most so far before A and after E, mm.
    Beyond([f64; 2]),
}

/// A place of the gears and everything that touches there.
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

/// Phases of one base pitch, no farther apart than `positions` (≥ 2) from A to E would be. Where slices come into contact all at once,
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
        let position = |&position_mm: &f64| {
            let contacts = passage.parts(position_mm, 0.5 * spacing, varies_mm);
            SlicedPosition { position_mm, contacts, jumps: false, jump_mm: None }
        };
        return places.iter().map(position).collect();
    }
    // Where each place's contacts are decided, and where its stretch begins and ends.
    let Zones { decided_at, bounds, one_change } = if passage.by_first_touch {
        let bounds = places.iter().map(|place| [place - 0.5 * spacing, place + 0.5 * spacing]).collect();
        Zones { decided_at: places.clone(), bounds, one_change: vec![false; count] }
    } else {
        zones(&places, pitch, &passage.changes_mm(path.start_mm))
    };
    let mut phases: Vec<SlicedPosition> = (0..count)
        .map(|j| {
            let neighbour = |step: i32| {
                let k = j as i32 + step;
                let turns = k.div_euclid(count as i32);
                decided_at[k.rem_euclid(count as i32) as usize] + f64::from(turns) * pitch
            };
            let contacts = passage.contacts(bounds[j], [neighbour(-1), decided_at[j], neighbour(1)]);
            SlicedPosition { position_mm: places[j], contacts, jumps: false, jump_mm: None }
        })
        .collect();
    if !passage.by_first_touch {
        for (j, jumps) in jumps(&phases).into_iter().enumerate() {
            phases[j].jumps = jumps;
            phases[j].jump_mm = (jumps && one_change[j]).then_some(bounds[j][1]);
        }
    }
    phases
}

/// Whether slices come or go at once between each of the `phases` of a base pitch and the next.
fn jumps(phases: &[SlicedPosition]) -> Vec<bool> {
    let of = |phase: &SlicedPosition, ahead: i32| -> BTreeSet<(i32, usize)> {
        phase.contacts.iter().map(|contact| (contact.tooth - ahead, contact.slice)).collect()
    };
    let after = |index: usize| {
        // The first phase comes again a base pitch later, when each tooth is where the one ahead of it was.
        let (next, ahead) = if index + 1 < phases.len() { (index + 1, 0) } else { (0, 1) };
        let (before, after) = (of(&phases[index], 0), of(&phases[next], ahead));
        let changed = before.symmetric_difference(&after).count();
        changed as f64 > JUMP * before.len().max(after.len()) as f64
    };
    (0..phases.len()).map(after).collect()
}

/// How slices go through the mesh.
struct SlicePassage<'a> {
    /// First touch of a slice.
    first_mm: f64,
    /// Its last.
    last_mm: f64,
    /// Whether it begins there without load.
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

    /// The contacts in the stretch of the reference tooth that has `bounds`; `decided_at` are the places where it is decided who
    /// touches in the stretch before, here, and after.
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
                // A contact stands in the middle of its stretch, so that what a cut stretch wears is of second order too; one that begins by first touch stands
                // where it is, since how far it has come decides what it carries.
                let position_mm = if self.by_first_touch { here + shift } else { lower_mm.midpoint(upper_mm) };
                let cell = PositionCell { position_mm, lower_mm, upper_mm };
                contacts.push(SliceContact { tooth, slice, cell, part: ContactPart::WHOLE });
            }
        }
        contacts
    }

    /// Teeth that may have a slice in contact with the reference tooth at `at_mm`, where slices reach so far beyond their middles.
    fn teeth_near(&self, at_mm: f64, beyond_middle_mm: f64) -> std::ops::RangeInclusive<i32> {
        let reach = self.ahead_mm.iter().fold(0.0, |reach: f64, ahead| reach.max(ahead.abs())) + beyond_middle_mm;
        let first_tooth = ((self.first_mm - at_mm - reach) / self.pitch_mm).floor() as i32;
        let last_tooth = ((self.last_mm - at_mm + reach) / self.pitch_mm).ceil() as i32;
        first_tooth..=last_tooth
    }

    /// The contacts in the stretch `half_mm` to either side of the reference tooth at `at_mm`, each of the part of its slice over which the
    /// line of contact has entered and not left; the place of the contact varies by `varies_mm` over the width of a slice.
    fn parts(&self, at_mm: f64, half_mm: f64, varies_mm: f64) -> Vec<SliceContact> {
        let (first, last) = (self.first_mm, self.last_mm);
        // ∫ f from far before A.
        let integral = |x: f64| {
            // ∫ of the ramp from 0 to 1 over Δa around `middle`.
            let ramp = |middle: f64| {
                let along = (x - middle + 0.5 * varies_mm).max(0.0);
                if along < varies_mm { 0.5 * along * along / varies_mm } else { along - 0.5 * varies_mm }
            };
            ramp(first) - ramp(last)
        };
        let mut contacts = Vec::new();
        for tooth in self.teeth_near(at_mm, 0.5 * varies_mm + half_mm) {
            for (slice, ahead) in self.ahead_mm.iter().enumerate() {
                let middle = at_mm + f64::from(tooth) * self.pitch_mm + ahead;
                let in_contact_mm = integral(middle + half_mm) - integral(middle - half_mm);
                let of_width = (in_contact_mm / (2.0 * half_mm)).min(1.0);
                if of_width <= LEAST_PART {
                    continue;
                }
                let [lower_mm, upper_mm] = self.folded([middle - half_mm, middle + half_mm]);
                let of_passage = in_contact_mm / (upper_mm - lower_mm);
                let cell = PositionCell { position_mm: lower_mm.midpoint(upper_mm), lower_mm, upper_mm };
                // What is left of rounding makes no part of a whole.
                let is_whole = of_width > 1.0 - LEAST_PART;
                let part = if is_whole { ContactPart::WHOLE } else { ContactPart { of_width, of_passage } };
                contacts.push(SliceContact { tooth, slice, cell, part });
            }
        }
        contacts
    }

    /// The stretch between A and E that `stretch` covers, folded back there.
    fn folded(&self, stretch: [f64; 2]) -> [f64; 2] {
        let (first, length) = (self.first_mm, self.last_mm - self.first_mm);
        let fold = |x: f64| {
            let within = (x - first).rem_euclid(2.0 * length);
            first + if within > length { 2.0 * length - within } else { within }
        };
        let (begin, end) = (fold(stretch[0]), fold(stretch[1]));
        let (low, high) = (begin.min(end), begin.max(end));
        // An end of the path inside the stretch is the end of what it covers.
        let holds = |place: f64| stretch[0] < place && place < stretch[1];
        [if holds(first) { first } else { low }, if holds(self.last_mm) { self.last_mm } else { high }]
    }
}

/// What changes of the contacts make of each place.
struct Zones {
    /// The middle of the zone between changes that holds it, where it is decided who touches.
    decided_at: Vec<f64>,
    /// The bounds of its stretch: halfway to the next place, or the change where that place's zone begins.
    bounds: Vec<[f64; 2]>,
    /// Whether one change lies between it and the next.
    one_change: Vec<bool>,
}

/// The zones between `changes` of the evenly spaced `places` of a period.
fn zones(places: &[f64], period: f64, changes: &[f64]) -> Zones {
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
    Zones {
        decided_at: (0..count).map(|j| change(zone(j)).midpoint(change(zone(j) + 1))).collect(),
        bounds: (0..count).map(|j| [bound_after(j - 1), bound_after(j)]).collect(),
        one_change: (0..count).map(|j| zone(j + 1) == zone(j) + 1).collect(),
    }
}
