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
//!
//! Where a linear relief begins, the flank has a kink, and the pressure a peak that stays on it, while the contact carries its pressure along over the stretch
//! between two positions: the ridge of lightly worn flanks there is too low by an error of first order in their distance (20 % of a ridge of 0.06 µm;
//! wear of some µm rounds the kink). While a contact passes over a kink, distances follow the number of positions, too: a
//! verification on two thirds of them has 1.5 times the error, and differs from the run by half of what the run errs.

use std::ops::Range;

use gearwear_bodies::gear::modification::ReliefShape;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_bodies::gear_fem::condensed_pair::{CondensedPair, hertz_half_width_mm};

/// Distance of positions.
#[derive(Clone, Copy, PartialEq)]
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
/// Positions from A to E for which distances in half-widths hold, of an internal pair, and at kinks.
const POSITIONS: f64 = 400.0;
/// Length of the path beyond A and E, over the reach of unworn tip edges under the approach at the pitch point.
const AMPLE_APPROACH: f64 = 1.3;
/// Length within A–E on which the tip edge still changes a contact, in Hertz half-widths at the pitch point.
const WITHIN_HALF_WIDTHS: f64 = 2.0;
/// Length outside a place where load comes in at once on which positions are as close as inside, in Hertz half-widths at the pitch point.
const OUTSIDE_JUMP_HALF_WIDTHS: f64 = 0.5;
/// Part of the base pitch within which two places of the path are the same.
const SAME_PLACE: f64 = 1e-9;

/// Distances of positions by what touches.
#[derive(Clone, Copy)]
struct Distances {
    /// Away from tip edges and kinks.
    away: Apart,
    /// While a contact passes over a kink.
    at_kinks: Apart,
    /// At tip edges.
    at_tip_edges: Apart,
}

impl Distances {
    /// Distances of a pair, for positions about as close as `positions` from A to E.
    fn of(pair: &GearPair, positions: usize) -> Self {
        let scale = POSITIONS / positions as f64;
        let (own, scale_away) = if pair.spec.is_internal() { (APART_INSIDE, scale) } else { (APART, 1.0) };
        let scaled = |own: Apart, scale: f64| Apart { half_widths: scale * own.half_widths, ..own };
        Self {
            away: scaled(own, scale_away),
            at_kinks: scaled(own, scale),
            at_tip_edges: scaled(APART_AT_TIP_EDGES, scale_away),
        }
    }
}

impl Apart {
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
    distances: Distances,
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
            distances: Distances::of(pair, positions),
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

    /// Places of the path while a contact passes over the beginning of a linear relief.
    fn kinks_mm(&self) -> Vec<Range<f64>> {
        let path = &self.pair.path;
        let of_gear = |gear: Gear| {
            let linear = self.pair.begins_of_reliefs(gear).filter(|&(_, shape)| shape == ReliefShape::Linear);
            linear.map(move |(rho_mm, _)| {
                let place = path.rho_mm(gear, rho_mm);
                // A half-width of flank, on which a contact moves by ρ/r_b of its way on the path.
                let passes = self.half_width_mm * (path.involute[gear].base_radius_mm / rho_mm).abs();
                place - passes..place + passes
            })
        };
        Gear::BOTH.into_iter().flat_map(of_gear).collect()
    }

    /// Stretches from the beginning to the end: short ones where a tip edge touches, and none across a place where load comes in at once.
    pub(super) fn stretches_mm(&self) -> Vec<(f64, f64)> {
        let path = &self.pair.path;
        let (start, pitch, Distances { away, at_kinks, at_tip_edges }) =
            (self.start_mm, path.base_pitch_mm, self.distances);
        let within = WITHIN_HALF_WIDTHS * self.half_width_mm;
        let outside = OUTSIDE_JUMP_HALF_WIDTHS * self.half_width_mm;
        let [before, after] = self.pair.tip_reach_mm(self.approach_mm);
        let [first, last] = self.jumps_mm();
        let cuts = self.cuts_mm();
        let before = first.map_or(before, |jump| jump + outside);
        let after = last.map_or(after, |jump| jump + outside);
        let edges = [path.start_mm - before..path.start_mm + within, path.end_mm - within..path.end_mm + after];
        let edges = within_pitch(edges, start, pitch);
        let kinks = if at_kinks == away { Vec::new() } else { within_pitch(self.kinks_mm(), start, pitch) };
        let mut ends: Vec<f64> = edges.iter().chain(&kinks).flat_map(|zone| [zone.start, zone.end]).collect();
        ends.push(pitch);
        ends.sort_by(f64::total_cmp);
        let mut stretches = Vec::new();
        let mut reached = 0.0;
        for to in ends {
            if to - reached <= SAME_PLACE * pitch {
                continue;
            }
            let is_in = |zones: &[Range<f64>]| zones.iter().any(|zone| zone.contains(&f64::midpoint(reached, to)));
            let apart = match (is_in(&edges), is_in(&kinks)) {
                (true, _) => at_tip_edges,
                (false, true) => at_kinks,
                (false, false) => away,
            };
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

/// Zones of the path moved by base pitches to where they begin in the one from `start` on, cut at its end and where they overlap, in order.
fn within_pitch(zones: impl IntoIterator<Item = Range<f64>>, start: f64, pitch: f64) -> Vec<Range<f64>> {
    let parts = zones.into_iter().flat_map(|zone| {
        let length = (zone.end - zone.start).min(pitch);
        let from = (zone.start - start).rem_euclid(pitch);
        [from..(from + length).min(pitch), 0.0..from + length - pitch]
    });
    let mut parts: Vec<Range<f64>> = parts.collect();
    parts.sort_by(|a, b| a.start.total_cmp(&b.start));
    let mut reached = 0.0;
    for part in &mut parts {
        part.start = part.start.max(reached);
        reached = reached.max(part.end);
    }
    parts.retain(|part| part.end > part.start);
    parts
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
        modification::Relief,
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
        BasePitch { pair, start_mm, even_mm, half_width_mm, approach_mm, distances: Distances::of(pair, positions) }
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
        let Distances { away, at_kinks, .. } = base_pitch.distances;
        let [away, at_kinks] = [away, at_kinks].map(|apart| apart.mm(base_pitch.half_width_mm, base_pitch.even_mm));
        let longest = if base_pitch.kinks_mm().is_empty() { away } else { away.max(at_kinks) };
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
        let apart = base_pitch.distances.at_tip_edges.mm(base_pitch.half_width_mm, base_pitch.even_mm);
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
            let Distances { away, at_tip_edges, .. } = base_pitch.distances;
            [away, at_tip_edges].map(|apart| apart.mm(base_pitch.half_width_mm, base_pitch.even_mm))
        });
        for (run, verification) in run.into_iter().zip(verification) {
            assert!((verification / run - 1.5).abs() < 0.01, "{run} {verification}");
        }
    }

    /// While a contact passes over the beginning of a linear relief, and only then, stretches of a verification on two thirds of the positions are half as long
    /// again as those of the run; a parabolic relief has no kink.
    #[test]
    fn ver_stretches_at_kinks_follow_the_number_of_positions() {
        let relieved = |shape| {
            let relief = Some(Relief { amount_mm: 0.02, length_mm: 3.0, shape });
            let mut spec = pair(false).spec;
            spec.gears.pinion.modification.tip_relief = relief;
            GearPair::new(&spec).unwrap()
        };
        let middles = |pair: &GearPair, positions| {
            let base_pitch = with_positions(pair, positions, 0.02);
            let stretches = base_pitch.stretches_mm();
            assert_tiled(&base_pitch, &stretches);
            let zone = base_pitch.kinks_mm().first().cloned();
            (stretches, zone)
        };
        let [linear, parabolic] = [ReliefShape::Linear, ReliefShape::Parabolic].map(relieved);
        let pitch = linear.path.base_pitch_mm;
        let ((run, zone), (verification, _)) = (middles(&linear, 400), middles(&linear, 267));
        let zone = zone.unwrap();
        // The edge of the tip relief of 3 mm, by its radius of curvature.
        let kink_mm = linear.teeth.pinion.edge_rho_mm() - 3.0;
        assert!((zone.start.midpoint(zone.end) - kink_mm).abs() < 1e-9, "{zone:?} {kink_mm}");
        // At its ends the contact has moved by a half-width along the flank, by lengths s = ρ²/(2 r_b) of the involute, whose curvature changes by a few per cent.
        let along_mm = |rho_mm: f64| rho_mm.powi(2) / (2.0 * linear.path.involute.pinion.base_radius_mm);
        let half_width_mm = with_positions(&linear, 400, 0.02).half_width_mm;
        for end_mm in [zone.start, zone.end] {
            let moved_mm = (along_mm(end_mm) - along_mm(kink_mm)).abs();
            assert!((moved_mm / half_width_mm - 1.0).abs() < 0.05, "{moved_mm} {half_width_mm}");
        }
        let longest_in = |stretches: &[(f64, f64)]| {
            let in_zone = stretches
                .iter()
                .filter(|(from, to)| (from.midpoint(*to) - zone.start).rem_euclid(pitch) < zone.end - zone.start);
            in_zone.map(|(from, to)| to - from).fold(0.0, f64::max)
        };
        let ratio = longest_in(&verification) / longest_in(&run);
        // Each zone is divided evenly, into a dozen of the run's.
        assert!((ratio / 1.5 - 1.0).abs() < 0.2, "{ratio}");
        assert_eq!(middles(&parabolic, 267).1, None);
        assert_eq!(middles(&parabolic, 267).0, middles(&pair(false), 267).0);
        assert_eq!(run, middles(&pair(false), 400).0);
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
