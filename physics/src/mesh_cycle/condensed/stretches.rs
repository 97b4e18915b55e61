//! Stretches of the path of contact, each with a position in its middle, that one base pitch of the mesh on finite elements is divided into.
//!
//! They are shorter where a tip edge touches, about A and E, where the contact is narrow, stands still on the edge and runs along the mate; and so about
//! B and D, as a base pitch leads from A to D and from B to E. Edges of internal pairs under load may touch as far as the tip circles of both gears
//! overlap ([`GearPair::tips_meet_mm`]): load comes in and leaves at once there. A stretch ends there, so that sums over positions stay of second order
//! in their distance.
//!
//! Away from tip edges a contact moves half a half-width from one position to the next. Flanks of internal pairs fit each other closely: half a half-width
//! is several times the distance of positions that divide A–E evenly, and wear and pressure beside the start of active profile were off by up to 9 % with
//! it. They move a quarter, and all their distances follow the number of positions asked for: a verification on fewer positions is coarser everywhere, and
//! does not share with the run what its positions do.

use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear_fem::condensed_pair::{CondensedPair, hertz_half_width_mm};

/// Distance of positions.
#[derive(Clone, Copy)]
struct Apart {
    /// Distance in Hertz half-widths at the pitch point: a contact must not move much farther than it is wide.
    half_widths: f64,
    /// Least and greatest distance over that of positions which divide A–E evenly.
    limits: [f64; 2],
}

/// Distance away from the tip edges.
const APART: Apart = Apart { half_widths: 0.5, limits: [0.5, 4.0] };
/// Distance away from the tip edges of an internal pair.
const APART_INSIDE: Apart = Apart { half_widths: 0.25, ..APART };
/// Distance where a tip edge touches, and contact is narrower.
const APART_AT_TIP_EDGES: Apart = Apart { half_widths: 0.15, limits: [0.25, 1.0] };
/// Positions from A to E for which distances in half-widths of an internal pair hold.
const POSITIONS_INSIDE: f64 = 400.0;
/// Length of the path beyond A and E, over the reach of unworn tip edges under the approach at the pitch point.
const AMPLE_APPROACH: f64 = 1.3;
/// Length within A–E on which the tip edge still changes a contact, in Hertz half-widths at the pitch point.
const WITHIN_HALF_WIDTHS: f64 = 2.0;
/// Length outside a place where load comes in at once on which positions are as close as inside, in Hertz half-widths at the pitch point.
const OUTSIDE_JUMP_HALF_WIDTHS: f64 = 0.5;
/// Part of the base pitch within which two places of the path are the same.
const SAME_PLACE: f64 = 1e-9;

impl Apart {
    /// Distances of a pair away from the tip edges and at them, for positions about as close as `positions` from A to E.
    fn of(pair: &GearPair, positions: usize) -> [Self; 2] {
        if !pair.spec.is_internal() {
            return [APART, APART_AT_TIP_EDGES];
        }
        let scale = POSITIONS_INSIDE / positions as f64;
        [APART_INSIDE, APART_AT_TIP_EDGES].map(|own| Self { half_widths: scale * own.half_widths, ..own })
    }

    /// Distance with a half-width, where positions that divide A–E evenly are `even_mm` apart.
    fn mm(self, half_width_mm: f64, even_mm: f64) -> f64 {
        let [least, most] = self.limits;
        (self.half_widths * half_width_mm).clamp(least * even_mm, most * even_mm)
    }
}

/// A base pitch of a pair under load.
pub(super) struct BasePitch<'a> {
    pair: &'a GearPair,
    /// Place of the path where it begins.
    start_mm: f64,
    /// Distance of positions that divide A–E evenly.
    even_mm: f64,
    /// Hertz half-width at the pitch point.
    half_width_mm: f64,
    /// Upper bound of the approach of the teeth.
    approach_mm: f64,
    /// Distance of positions away from the tip edges and at them.
    apart: [Apart; 2],
}

impl<'a> BasePitch<'a> {
    /// The base pitch of a model under a load, for positions about as close as `positions` from A to E.
    pub(super) fn of(model: &CondensedPair<'a>, positions: usize, line_load_n_per_mm: f64) -> Self {
        let (pair, path) = (model.pair, &model.pair.path);
        let approach_mm = model
            .at(path.pitch_point_mm, line_load_n_per_mm, &Default::default())
            .map_or(0.0, |contact| contact.transmission_error_mm);
        Self {
            pair,
            start_mm: model.first_position_mm(),
            even_mm: (path.end_mm - path.start_mm) / (positions - 1) as f64,
            half_width_mm: hertz_half_width_mm(
                pair,
                model.contact_modulus_mpa,
                line_load_n_per_mm,
                path.pitch_point_mm,
            ),
            approach_mm: AMPLE_APPROACH * approach_mm,
            apart: Apart::of(pair, positions),
        }
    }

    /// Distance before A and after E of the places where load comes in or leaves at once.
    fn jumps_mm(&self) -> [Option<f64>; 2] {
        self.pair.tips_meet_mm(self.approach_mm)
    }

    /// Distance from the beginning of the base pitch of the places where load comes in or leaves at once.
    fn cuts_mm(&self) -> [Option<f64>; 2] {
        let path = &self.pair.path;
        let [first, last] = self.jumps_mm();
        let jumps = [first.map(|before| path.start_mm - before), last.map(|after| path.end_mm + after)];
        jumps.map(|jump| jump.map(|place| (place - self.start_mm).rem_euclid(path.base_pitch_mm)))
    }

    /// Indices of the stretches at whose beginning load comes in or leaves at once.
    pub(super) fn after_jumps(&self, stretches: &[(f64, f64)]) -> Vec<usize> {
        let (pitch, cuts) = (self.pair.path.base_pitch_mm, self.cuts_mm());
        let begins_at = |place: f64, cut: f64| {
            let ahead = (place - self.start_mm - cut).rem_euclid(pitch);
            ahead.min(pitch - ahead) <= 2.0 * SAME_PLACE * pitch
        };
        (0..stretches.len())
            .filter(|&index| cuts.into_iter().flatten().any(|cut| begins_at(stretches[index].0, cut)))
            .collect()
    }

    /// Stretches from the beginning to the end: short ones where a tip edge touches, and none across a place where load comes in at once.
    pub(super) fn stretches_mm(&self) -> Vec<(f64, f64)> {
        let path = &self.pair.path;
        let (start, pitch, [away, at_tip_edges]) = (self.start_mm, path.base_pitch_mm, self.apart);
        let within = WITHIN_HALF_WIDTHS * self.half_width_mm;
        let outside = OUTSIDE_JUMP_HALF_WIDTHS * self.half_width_mm;
        let [before, after] = self.pair.tip_reach_mm(self.approach_mm);
        let [first, last] = self.jumps_mm();
        let cuts = self.cuts_mm();
        let before = first.map_or(before, |jump| jump + outside);
        let after = last.map_or(after, |jump| jump + outside);
        // Both stretches at tip edges, moved by base pitches to where they begin in this one, and cut at its end.
        let zones = [(path.start_mm - before, path.start_mm + within), (path.end_mm - within, path.end_mm + after)];
        let mut at_edges: Vec<(f64, f64)> = zones
            .into_iter()
            .flat_map(|(from, to)| {
                let length = (to - from).min(pitch);
                let from = (from - start).rem_euclid(pitch);
                [(from, (from + length).min(pitch)), (0.0, from + length - pitch)]
            })
            .filter(|(from, to)| to > from)
            .collect();
        at_edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = at_edges.into_iter().flat_map(|(from, to)| [(from, away), (to, at_tip_edges)]);
        let mut stretches = Vec::new();
        let mut reached = 0.0;
        for (to, apart) in ends.chain([(pitch, away)]) {
            let length = to - reached;
            if length <= SAME_PLACE * pitch {
                continue;
            }
            let apart = apart.mm(self.half_width_mm, self.even_mm);
            for (reached, to) in cut((reached, to), cuts, SAME_PLACE * pitch) {
                let length = to - reached;
                let count = (length / apart - 1e-9).ceil().max(1.0) as usize;
                let ends =
                    (0..=count).map(|k| start + reached + length * k as f64 / count as f64).collect::<Vec<f64>>();
                stretches.extend(ends.windows(2).map(|ends| (ends[0], ends[1])));
            }
            reached = to;
        }
        stretches
    }
}

/// Parts of a stretch between the cuts that lie within it, farther than `least` from its ends and from each other.
fn cut((from, to): (f64, f64), cuts: [Option<f64>; 2], least: f64) -> Vec<(f64, f64)> {
    let mut places: Vec<f64> = cuts.into_iter().flatten().filter(|&at| at > from + least && at < to - least).collect();
    places.sort_by(f64::total_cmp);
    let mut parts = Vec::new();
    let mut reached = from;
    for place in places.into_iter().chain([to]) {
        if place - reached > least {
            parts.push((reached, place));
            reached = place;
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::{
        PerGear,
        ring_fillet::RingSpec,
        spec::{AxisParallelism, BasicRack, GearSpec, PairSpec},
    };

    fn gear(teeth: u32, profile_shift: f64) -> GearSpec {
        GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: None,
            tip_chamfer: None,
            tooth_thickness_allowance_mm: -0.05,
            bore_diameter_mm: None,
            modification: Default::default(),
            measured_flank: None,
            shaft: None,
            ring: None,
        }
    }

    /// An approach by which tips of an internal pair touch until their circles part, mm.
    const AMPLE_MM: f64 = 100.0;

    /// 20 teeth, module 3 mm, at zero sum of shifts, with a wheel of 60, whose internal teeth are short enough not to interfere.
    fn pair(is_internal: bool) -> GearPair {
        let ring = is_internal.then(RingSpec::default);
        let wheel = GearSpec { ring, tip_diameter_mm: is_internal.then_some(-176.2), ..gear(60, -0.3) };
        let teeth = 20.0 + wheel.z();
        let gears = PerGear { pinion: gear(20, 0.3), wheel };
        GearPair::new(&PairSpec {
            normal_module_mm: 3.0,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 0.0,
            centre_distance_mm: 1.5 * teeth,
            face_width_mm: 20.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears,
        })
        .unwrap()
    }

    /// A base pitch with 400 positions on A–E, and half-widths as wide as 8 of these are apart.
    fn base_pitch(pair: &GearPair, approach_mm: f64) -> BasePitch<'_> {
        with_positions(pair, 400, approach_mm)
    }

    /// The same with another number of positions.
    fn with_positions(pair: &GearPair, positions: usize, approach_mm: f64) -> BasePitch<'_> {
        let path = &pair.path;
        let length_mm = path.end_mm - path.start_mm;
        let even_mm = length_mm / (positions - 1) as f64;
        let start_mm = path.start_mm.midpoint(path.end_mm) - 0.5 * path.base_pitch_mm;
        let half_width_mm = 8.0 / 399.0 * length_mm;
        BasePitch { pair, start_mm, even_mm, half_width_mm, approach_mm, apart: Apart::of(pair, positions) }
    }

    /// Distance of a place of the path to the nearest end of a stretch, base pitches apart from it.
    fn to_nearest_end(base_pitch: &BasePitch<'_>, stretches: &[(f64, f64)], place_mm: f64) -> f64 {
        let pitch = base_pitch.pair.path.base_pitch_mm;
        let distances = stretches.iter().map(|&(from, _)| {
            let ahead = (place_mm - from).rem_euclid(pitch);
            ahead.min(pitch - ahead)
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Each stretch begins where the one before it ends, from the beginning of the base pitch to its end.
    #[track_caller]
    fn assert_tiled(base_pitch: &BasePitch<'_>, stretches: &[(f64, f64)]) {
        let pitch = base_pitch.pair.path.base_pitch_mm;
        assert_eq!(stretches[0].0, base_pitch.start_mm);
        for two in stretches.windows(2) {
            assert!((two[0].1 - two[1].0).abs() < 1e-12 * pitch, "{two:?}");
        }
        assert!((stretches[stretches.len() - 1].1 - base_pitch.start_mm - pitch).abs() < 1e-12 * pitch);
        let longest = base_pitch.apart[0].mm(base_pitch.half_width_mm, base_pitch.even_mm);
        assert!(stretches.iter().all(|(from, to)| to > from && to - from < longest * (1.0 + 1e-9)));
    }

    /// Stretches about A and E are no longer than the distance of positions at tip edges; somewhere else, where there is that, they are longer.
    #[track_caller]
    fn assert_short_about_tip_edges(base_pitch: &BasePitch<'_>, stretches: &[(f64, f64)], beyond_mm: [f64; 2]) {
        let path = &base_pitch.pair.path;
        let within = WITHIN_HALF_WIDTHS * base_pitch.half_width_mm;
        let ends =
            [(path.start_mm - beyond_mm[0], within + beyond_mm[0]), (path.end_mm - within, within + beyond_mm[1])];
        let is_at_edge = |place_mm: f64| {
            ends.iter().any(|&(from, length)| (place_mm - from).rem_euclid(path.base_pitch_mm) < length)
        };
        let (at_edges, elsewhere): (Vec<_>, Vec<_>) =
            stretches.iter().partition(|(from, to)| is_at_edge(from.midpoint(*to)));
        let longest = |of: &[(f64, f64)]| of.iter().map(|(from, to)| to - from).fold(0.0, f64::max);
        let apart = base_pitch.apart[1].mm(base_pitch.half_width_mm, base_pitch.even_mm);
        assert!(longest(&at_edges) <= apart * (1.0 + 1e-9), "{} {apart}", longest(&at_edges));
        assert!(elsewhere.is_empty() || longest(&elsewhere) > 1.5 * apart, "{} {apart}", longest(&elsewhere));
    }

    /// Under a load by which the tips of an internal pair touch until their circles part, stretches end there.
    #[test]
    fn ver_stretches_of_an_internal_pair_end_at_its_jumps() {
        let pair = pair(true);
        let base_pitch = base_pitch(&pair, AMPLE_MM);
        let [Some(before), Some(after)] = base_pitch.jumps_mm() else { panic!("tips of this pair meet") };
        let stretches = base_pitch.stretches_mm();
        assert_tiled(&base_pitch, &stretches);
        for jump_mm in [pair.path.start_mm - before, pair.path.end_mm + after] {
            let off = to_nearest_end(&base_pitch, &stretches, jump_mm);
            assert!(off < 1e-9 * pair.path.base_pitch_mm, "{off}");
        }
        assert_eq!(base_pitch.after_jumps(&stretches).len(), 2);
        let outside = OUTSIDE_JUMP_HALF_WIDTHS * base_pitch.half_width_mm;
        assert_short_about_tip_edges(&base_pitch, &stretches, [before + outside, after + outside]);
        // Under a load that lets the teeth part before, none does.
        let base_pitch = with_positions(&pair, 400, 1e-4);
        assert_eq!(base_pitch.jumps_mm(), [None; 2]);
        let stretches = base_pitch.stretches_mm();
        assert_tiled(&base_pitch, &stretches);
        for jump_mm in [pair.path.start_mm - before, pair.path.end_mm + after] {
            assert!(to_nearest_end(&base_pitch, &stretches, jump_mm) > 1e-6 * pair.path.base_pitch_mm);
        }
    }

    /// Tips of an external pair part long before their circles do.
    #[test]
    fn ver_no_stretch_of_an_external_pair_is_cut() {
        let pair = pair(false);
        let base_pitch = base_pitch(&pair, 0.02);
        assert_eq!(base_pitch.jumps_mm(), [None; 2]);
        let stretches = base_pitch.stretches_mm();
        assert_tiled(&base_pitch, &stretches);
        assert_eq!(base_pitch.after_jumps(&stretches), [0; 0]);
        assert_short_about_tip_edges(&base_pitch, &stretches, pair.tip_reach_mm(0.02));
    }

    /// A verification of an internal pair on two thirds of the positions has stretches half as long again, at tip edges and away from them.
    #[test]
    fn ver_stretches_of_an_internal_pair_follow_the_number_of_positions() {
        let pair = pair(true);
        let [run, verification] = [400, 267].map(|positions| {
            let base_pitch = with_positions(&pair, positions, AMPLE_MM);
            base_pitch.apart.map(|apart| apart.mm(base_pitch.half_width_mm, base_pitch.even_mm))
        });
        for (run, verification) in run.into_iter().zip(verification) {
            assert!((verification / run - 1.5).abs() < 0.01, "{run} {verification}");
        }
    }

    /// Parts tile the stretch; cuts at its ends, outside it and at the same place as another make no part.
    #[test]
    fn ver_parts_of_a_stretch_lie_between_the_cuts() {
        let parts = |cuts| cut((1.0, 3.0), cuts, 1e-9);
        assert_eq!(parts([None; 2]), [(1.0, 3.0)]);
        assert_eq!(parts([Some(2.5), Some(1.5)]), [(1.0, 1.5), (1.5, 2.5), (2.5, 3.0)]);
        assert_eq!(parts([Some(0.5), Some(2.0)]), [(1.0, 2.0), (2.0, 3.0)]);
        assert_eq!(parts([Some(1.0), Some(3.0)]), [(1.0, 3.0)]);
        assert_eq!(parts([Some(2.0), Some(2.0 + 1e-12)]), [(1.0, 2.0), (2.0, 3.0)]);
    }
}
