//! The stretch of both flanks around the theoretical contact point where they may touch.
//!
//! A strip carries samples of the geometric gap in the tangent frame and, for each, where it lies between the points of
//! both flanks, so that the real gap (geometry plus removed material) is one pass over plain arrays.
//!
//! These samples are evenly spaced across the contact, with more of them where a modification has a kink, and the load follows from them; pressure and
//! sliding are observed on the points of the flanks themselves ([`super::observed_points`]). Real ends of a strip, where a flank ends in
//! its tip edge (or its involute ends at the form circle), are kept exactly: no pressure acts beyond them.

use std::cmp::Ordering;
use std::ops::Range;

use super::flank_motion::{ROUND_OFF, edge_under_load, on_tangent, passes_to_ends_mm};
use super::{Flanks, PositionCell};
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid};
use crate::reference::linear_means::add_means;

/// The points of a gear's grid between which its removed material is read.
///
/// Where the flank ends between two points, only the one within it wears: on the last stretch up to the end, what is removed is what that point has
/// lost. A straight line to the point beyond would leave a ridge there that carries load and never wears.
fn points_within(flanks: Flanks<'_>, gear: Gear) -> Range<usize> {
    let coordinate_mm = &flanks.grid[gear].coordinate_mm;
    let limits = flanks.geometry.flank_limits_mm(gear);
    let round_off = ROUND_OFF * limits.1;
    let first = coordinate_mm.partition_point(|&at| at < limits.0 - round_off);
    let end = coordinate_mm.partition_point(|&at| at <= limits.1 + round_off);
    // Points too far apart for two of them to lie within are taken as they are.
    if end >= first + 2 { first..end } else { 0..coordinate_mm.len() }
}

/// Removed material of one flank at samples between its points.
#[derive(Debug, Clone)]
pub(super) struct Interpolation {
    /// Index of the first and the last but one of [`points_within`].
    within: [usize; 2],
    index: Vec<u32>,
    weight: Vec<f64>,
}

impl Interpolation {
    pub(super) fn new(flanks: Flanks<'_>, gear: Gear) -> Self {
        let within = points_within(flanks, gear);
        Self { within: [within.start, within.end - 2], index: Vec::new(), weight: Vec::new() }
    }

    pub(super) fn push(&mut self, grid: &FlankGrid, coordinate_mm: f64) {
        // Samples follow each other along the flank.
        let place = match self.index.last() {
            Some(&before) => grid.place_near(before as usize, coordinate_mm),
            None => grid.place(coordinate_mm),
        };
        let index = place.index.clamp(self.within[0], self.within[1]);
        self.weight.push(match place.index.cmp(&index) {
            Ordering::Less => 0.0,
            Ordering::Equal => place.weight,
            Ordering::Greater => 1.0,
        });
        self.index.push(index as u32);
    }

    /// The values at the samples.
    pub(super) fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.index.iter().zip(&self.weight).map(|(&i, &weight)| {
            let ends = &values[i as usize..i as usize + 2];
            ends[0] + weight * (ends[1] - ends[0])
        })
    }
}

/// Removed material of one flank at samples: its mean over the stretch that passes each while the contact stands for its position.
#[derive(Debug, Clone, Default)]
struct PassingMean {
    first: Vec<u32>,
    ends: Vec<u32>,
    weights: Vec<f64>,
}

impl PassingMean {
    /// At the samples `along_mm` in the gear's own direction of the tangent.
    fn new(flanks: Flanks<'_>, gear: Gear, cell: PositionCell, along_mm: impl Iterator<Item = f64>) -> Self {
        let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
        let coordinate_mm = |along: f64| geometry.at_along(gear, along, cell.position_mm).0;
        let mut passing = Self::default();
        let within = points_within(flanks, gear);
        let points_mm = &grid.coordinate_mm[within.clone()];
        // Empty again after every sample.
        let mut sums = vec![0.0; points_mm.len()];
        for along in along_mm {
            let at_mm = coordinate_mm(along);
            let passes = passes_to_ends_mm(&geometry, gear, at_mm, cell, grid.distance_at_mm(at_mm));
            let ends = passes.map(|by| coordinate_mm(along - by));
            let reached = add_means(points_mm, [ends[0].min(ends[1]), ends[0].max(ends[1])], 1.0, &mut sums);
            passing.first.push((within.start + reached.start) as u32);
            passing.weights.extend_from_slice(&sums[reached.clone()]);
            passing.ends.push(passing.weights.len() as u32);
            sums[reached].fill(0.0);
        }
        passing
    }

    fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let mut begin = 0;
        self.first.iter().zip(&self.ends).map(move |(&first, &end)| {
            let weights = &self.weights[begin as usize..end as usize];
            begin = end;
            weights.iter().zip(&values[first as usize..]).map(|(weight, value)| weight * value).sum()
        })
    }
}

/// Extent of the tangent at one position over which both flanks exist, and of the part looked at; mm, positive towards
/// the pinion's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    /// Lower end of what is looked at.
    pub lower_mm: f64,
    /// Upper end.
    pub upper_mm: f64,
    /// Where in it unworn flanks are nearest.
    pub nearest_mm: f64,
    /// Whether each end is where a flank really ends.
    pub ends_are_real: [bool; 2],
    /// Whether it ends there in a sharp edge that may carry load: the wheel's tip or the pinion's corner of undercut below, the pinion's tip or
    /// the wheel's corner above.
    pub ends_are_sharp: [bool; 2],
}

impl Window {
    /// `half_length_mm` to either side of the theoretical contact point, or of the tip edge next to it where the one flank
    /// ends before it, cut where a flank ends.
    pub(crate) fn new(flanks: Flanks<'_>, position_mm: f64, half_length_mm: f64) -> Self {
        let ((lower, upper), at_tips) = common_extent_mm(&flanks.geometry, position_mm);
        let nearest_mm = nearest_mm(&flanks.geometry, position_mm, (lower, upper));
        let (from, to) = (nearest_mm - half_length_mm, nearest_mm + half_length_mm);
        let ends_are_real = [lower >= from, upper <= to];
        let (edges, corners) = (flanks.sharp_edges, flanks.sharp_corners);
        let sharp = [(edges.wheel, corners.pinion), (edges.pinion, corners.wheel)];
        Self {
            lower_mm: lower.max(from),
            upper_mm: upper.min(to),
            nearest_mm,
            ends_are_real,
            ends_are_sharp: [0, 1]
                .map(|end| ends_are_real[end] && if at_tips[end] { sharp[end].0 } else { sharp[end].1 }),
        }
    }

    /// Its length.
    pub(crate) fn length_mm(&self) -> f64 {
        self.upper_mm - self.lower_mm
    }

    /// Both its ends and the places between `intervals` even parts of it.
    pub(crate) fn evenly_mm(&self, intervals: usize) -> Vec<f64> {
        let spacing_mm = self.length_mm() / intervals as f64;
        (0..=intervals).map(|k| self.lower_mm + k as f64 * spacing_mm).collect()
    }

    /// Both its ends and all places between them that are whole multiples of `spacing_mm` from where unworn flanks are nearest, which a longer window has
    /// too: what a contact carries is the same in both. And the points of both flanks where a modification has a kink that these places would miss by
    /// `missed_mm` or more: between two places, h apart, a course that turns by κ lies up to κ h/4 beside the straight line.
    pub(crate) fn with_kinks_mm(
        &self,
        flanks: Flanks<'_>,
        position_mm: f64,
        spacing_mm: f64,
        missed_mm: f64,
    ) -> Vec<f64> {
        let multiple = |end_mm: f64| (end_mm - self.nearest_mm) / spacing_mm;
        let first = (multiple(self.lower_mm) + SAME_PLACE).floor() as i64 + 1;
        let last = (multiple(self.upper_mm) - SAME_PLACE).ceil() as i64 - 1;
        let within = (first..=last).map(|k| self.nearest_mm + k as f64 * spacing_mm);
        let mut places_mm: Vec<f64> =
            std::iter::once(self.lower_mm).chain(within).chain(std::iter::once(self.upper_mm)).collect();
        let Some(modification_mm) = flanks.modification_mm else { return places_mm };
        for gear in Gear::BOTH {
            let (grid, removed_mm) = (flanks.grid[gear], modification_mm[gear]);
            let place =
                |end_mm: f64| grid.place(flanks.geometry.at_along(gear, on_tangent(gear, end_mm), position_mm).0).index;
            let (low, high) = (place(self.lower_mm), place(self.upper_mm));
            let within = low.min(high).max(1)..(low.max(high) + 1).min(grid.len() - 2) + 1;
            let along_mm =
                |i: usize| flanks.geometry.in_tangent_frame(gear, grid.coordinate_mm[i], position_mm).along_mm;
            for i in within.filter(|&i| removed_mm[i - 1] != removed_mm[i] || removed_mm[i] != removed_mm[i + 1]) {
                let at_mm = [i - 1, i, i + 1].map(along_mm);
                let slope = |k: usize| (removed_mm[i + k] - removed_mm[i + k - 1]) / (at_mm[k + 1] - at_mm[k]);
                let (turn, place_mm) = ((slope(1) - slope(0)).abs(), on_tangent(gear, at_mm[1]));
                let apart_mm = SAME_PLACE * spacing_mm;
                let is_within = self.lower_mm + apart_mm < place_mm && place_mm < self.upper_mm - apart_mm;
                if is_within && 0.25 * turn * spacing_mm >= missed_mm {
                    places_mm.push(place_mm);
                }
            }
        }
        places_mm.sort_by(f64::total_cmp);
        places_mm.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE * spacing_mm);
        places_mm
    }

    /// Whether a sharp tip edge cuts off a contact that presses on these of the ends.
    pub(crate) fn is_sharp_where(&self, pressed: [bool; 2]) -> bool {
        self.ends_are_sharp.iter().zip(pressed).any(|(sharp, pressed)| *sharp && pressed)
    }
}

/// Where along the tangent both flanks exist, before A and after E beside the theoretical contact point; and whether it is a tip edge that
/// ends it there, the wheel's below and the pinion's above.
pub(super) fn common_extent_mm(geometry: &dyn ConjugateFlanks, position_mm: f64) -> ((f64, f64), [bool; 2]) {
    let along = |gear: Gear, coordinate| geometry.in_tangent_frame(gear, coordinate, position_mm).along_mm;
    let (p, w) = (geometry.flank_limits_mm(Gear::Pinion), geometry.flank_limits_mm(Gear::Wheel));
    // The wheel's tangent coordinate runs the other way. At A and E, where one limit is the contact point itself,
    // round-off must not put it outside.
    let round_off = ROUND_OFF * p.1.max(w.1);
    let [lowers, uppers] =
        [[along(Gear::Pinion, p.0), -along(Gear::Wheel, w.1)], [along(Gear::Pinion, p.1), -along(Gear::Wheel, w.0)]];
    let (lower, upper) = (lowers[0].max(lowers[1]), uppers[0].min(uppers[1]));
    let extent = (
        if lower < round_off { lower.min(0.0) } else { lower },
        if upper > -round_off { upper.max(0.0) } else { upper },
    );
    (extent, [lowers[1] >= lowers[0], uppers[0] <= uppers[1]])
}

/// Where within the extent of [`common_extent_mm`] unworn flanks are nearest: at the theoretical contact point, or at the edge beside it where a
/// flank has not begun or has ended. Before T1 and after T2 the corner of an undercut flank may lie on the other side of that point.
pub(super) fn nearest_mm(geometry: &dyn ConjugateFlanks, position_mm: f64, (lower_mm, upper_mm): (f64, f64)) -> f64 {
    match edge_under_load(geometry, position_mm) {
        Some(edge) => {
            if edge.is_before {
                lower_mm
            } else {
                upper_mm
            }
        }
        None => 0.0_f64.min(upper_mm).max(lower_mm),
    }
}

/// Distance of the points at the theoretical contact point on the flank where they are closer.
pub(crate) fn point_distance_mm(flanks: Flanks<'_>, position_mm: f64) -> f64 {
    let of = |gear: Gear| flanks.grid[gear].distance_at_mm(flanks.geometry.contact_coordinate_mm(gear, position_mm));
    of(Gear::Pinion).min(of(Gear::Wheel))
}

/// Places nearer to each other than this part of the samples' distance are one.
const SAME_PLACE: f64 = 1e-6;

/// Samples across the candidate contact.
#[derive(Debug, Clone)]
pub(crate) struct Strip {
    /// What the samples cover.
    pub window: Window,
    /// Where the samples are, mm.
    pub along_mm: Vec<f64>,
    /// Geometric gap at each sample, mm.
    pub geometric_gap_mm: Vec<f64>,
    /// Gap of flanks that have lost nothing, modifications neither, at both ends, mm.
    unmodified_at_ends_mm: [f64; 2],
    removed: Removed,
}

/// How the removed material is read at the samples.
#[derive(Debug, Clone)]
enum Removed {
    /// At the place of each.
    Here(PerGear<Interpolation>),
    /// As it passes each.
    Passing(PerGear<PassingMean>),
}

impl Strip {
    /// Samples at `along_mm`, in order, the first and the last at the ends of `window`. Where the pressure stands still while the flanks pass
    /// under it during a cell, `passed_during`, each sample sees the mean wear of what passes it, as all that passes it feels its pressure:
    /// seen at one place alone, a wave of wear as long as the positions are apart would meet each of them alike, and grow.
    pub(crate) fn new(
        flanks: Flanks<'_>,
        position_mm: f64,
        window: Window,
        along_mm: Vec<f64>,
        passed_during: Option<PositionCell>,
    ) -> Self {
        let mut geometric_gap_mm = vec![0.0; along_mm.len()];
        let here = PerGear::from_fn(|gear| {
            let mut here = Interpolation::new(flanks, gear);
            for (&along, gap) in along_mm.iter().zip(&mut geometric_gap_mm) {
                let (coordinate, drop) = flanks.geometry.at_along(gear, on_tangent(gear, along), position_mm);
                *gap += drop;
                here.push(flanks.grid[gear], coordinate);
            }
            here
        });
        let unmodified_at_ends_mm = [0, geometric_gap_mm.len() - 1].map(|end| geometric_gap_mm[end]);
        let (Some(modification_mm), Some(cell)) = (flanks.modification_mm, passed_during) else {
            return Self { window, along_mm, geometric_gap_mm, unmodified_at_ends_mm, removed: Removed::Here(here) };
        };
        let passing = PerGear::from_fn(|gear| {
            let passing = PassingMean::new(flanks, gear, cell, along_mm.iter().map(|&along| on_tangent(gear, along)));
            // A modification stays what it is at the sample.
            let beside = here[gear].of(modification_mm[gear]).zip(passing.of(modification_mm[gear]));
            geometric_gap_mm.iter_mut().zip(beside).for_each(|(gap, (here, mean))| *gap += here - mean);
            passing
        });
        Self { window, along_mm, geometric_gap_mm, unmodified_at_ends_mm, removed: Removed::Passing(passing) }
    }

    /// Distance of samples that are evenly spaced.
    pub(crate) fn spacing_mm(&self) -> f64 {
        self.window.length_mm() / (self.along_mm.len() - 1) as f64
    }

    /// The gap with `removed_mm` of material gone, into `gap_mm`, and its least value.
    pub(crate) fn gap_mm(&self, removed_mm: PerGear<&[f64]>, gap_mm: &mut Vec<f64>) -> f64 {
        match &self.removed {
            Removed::Here(here) => self.opened_mm(Gear::BOTH.map(|gear| here[gear].of(removed_mm[gear])), gap_mm),
            Removed::Passing(passing) => {
                self.opened_mm(Gear::BOTH.map(|gear| passing[gear].of(removed_mm[gear])), gap_mm)
            }
        }
    }

    fn opened_mm(&self, [pinion, wheel]: [impl Iterator<Item = f64>; 2], gap_mm: &mut Vec<f64>) -> f64 {
        gap_mm.resize(self.geometric_gap_mm.len(), 0.0);
        let mut least = f64::INFINITY;
        for (((gap, geometric), pinion), wheel) in gap_mm.iter_mut().zip(&self.geometric_gap_mm).zip(pinion).zip(wheel)
        {
            *gap = geometric + pinion + wheel;
            if *gap < least {
                least = *gap;
            }
        }
        least
    }

    /// Whether flanks pressed together by `approach_mm`, and that have lost at least `removed_mm` wherever they may touch, can touch
    /// beyond an end of the window that is not real, where their surfaces have sunk by `sunk_mm`: what else is removed only widens the gap. A
    /// modification at the end itself says nothing of what lies beyond, where a rounding or a relief may not have begun.
    pub(crate) fn may_touch_beyond(&self, approach_mm: f64, removed_mm: f64, sunk_mm: [f64; 2]) -> bool {
        let ends = self.unmodified_at_ends_mm.into_iter().zip(sunk_mm).zip(self.window.ends_are_real);
        ends.into_iter().any(|((gap, sunk), real)| !real && gap + sunk + removed_mm < approach_mm)
    }
}

/// Parts in which the stretch from an end of a window to where a flank ends is looked at.
const PARTS_BESIDE: usize = 64;

/// Places along the tangent beside a window, each with the gap of flanks that have lost `removed_mm`, mm: all at which flanks pressed together by
/// `approach_mm` can touch. Unworn flanks part ever farther with the distance from their contact; where they alone are that far apart, so are all
/// farther on.
pub(crate) fn gaps_beside_mm(
    flanks: Flanks<'_>,
    position_mm: f64,
    window: Window,
    approach_mm: f64,
    removed_mm: PerGear<&[f64]>,
) -> Vec<(f64, f64)> {
    let ((lowest_mm, highest_mm), _) = common_extent_mm(&flanks.geometry, position_mm);
    let mut places = Vec::new();
    let sides = [(window.lower_mm, lowest_mm.min(window.lower_mm)), (window.upper_mm, highest_mm.max(window.upper_mm))];
    for (from_mm, to_mm) in sides.into_iter().filter(|(from_mm, to_mm)| from_mm != to_mm) {
        let first = places.len();
        let mut here: Option<PerGear<Interpolation>> = None;
        for part in 0..=PARTS_BESIDE {
            let along_mm = from_mm + (to_mm - from_mm) * part as f64 / PARTS_BESIDE as f64;
            let on_flank =
                PerGear::from_fn(|gear| flanks.geometry.at_along(gear, on_tangent(gear, along_mm), position_mm));
            let unworn_mm = on_flank.pinion.1 + on_flank.wheel.1;
            if unworn_mm >= approach_mm {
                break;
            }
            let here = here.get_or_insert_with(|| PerGear::from_fn(|gear| Interpolation::new(flanks, gear)));
            Gear::BOTH.into_iter().for_each(|gear| here[gear].push(flanks.grid[gear], on_flank[gear].0));
            places.push((along_mm, unworn_mm));
        }
        let Some(here) = here else { continue };
        for gear in Gear::BOTH {
            let removed = here[gear].of(removed_mm[gear]);
            places[first..].iter_mut().zip(removed).for_each(|((_, gap), removed)| *gap += removed);
        }
    }
    places
}

/// Flanks are searched this much farther than parabolas of their relative curvature would touch.
const AMPLE_REACH: f64 = 1.25;
/// Part of what both flanks have in common along the tangent that is looked at in any case.
const LEAST_REACH: f64 = 1e-3;

/// The least that both flanks together have lost wherever they can touch when pressed together by `approach_mm`: as far as they are nearer than
/// that unworn.
pub(crate) fn least_removed_mm(
    flanks: Flanks<'_>,
    position_mm: f64,
    approach_mm: f64,
    removed_mm: PerGear<&[f64]>,
) -> f64 {
    let ((lowest_mm, highest_mm), _) = common_extent_mm(&flanks.geometry, position_mm);
    let on_flank = |gear: Gear, along_mm: f64| flanks.geometry.at_along(gear, on_tangent(gear, along_mm), position_mm);
    let unworn_mm = |along_mm: f64| Gear::BOTH.into_iter().map(|gear| on_flank(gear, along_mm).1).sum::<f64>();
    let centre_mm = nearest_mm(&flanks.geometry, position_mm, (lowest_mm, highest_mm));
    let of_parabola_mm = (2.0 * flanks.geometry.relative_radius_mm(position_mm).max(0.0) * approach_mm).sqrt();
    let first_mm = (AMPLE_REACH * of_parabola_mm).max(LEAST_REACH * (highest_mm - lowest_mm));
    // Outside A to E flanks part otherwise than the parabola of their contact.
    let reached_mm = |outwards: f64| {
        let mut by_mm = first_mm;
        loop {
            let at_mm = (centre_mm + outwards * by_mm).min(highest_mm).max(lowest_mm);
            if at_mm == lowest_mm || at_mm == highest_mm || unworn_mm(at_mm) >= approach_mm {
                return at_mm;
            }
            by_mm *= 1.5;
        }
    };
    let ends_mm = [reached_mm(-1.0), reached_mm(1.0)];
    let least = |gear: Gear| {
        let coordinate_mm = &flanks.grid[gear].coordinate_mm;
        let at_mm = ends_mm.map(|along_mm| on_flank(gear, along_mm).0);
        // The next point on either side counts too: what is removed is linear in between.
        let first = coordinate_mm.partition_point(|&at| at < at_mm[0].min(at_mm[1])).saturating_sub(1);
        let end = (coordinate_mm.partition_point(|&at| at <= at_mm[0].max(at_mm[1])) + 1).min(coordinate_mm.len());
        removed_mm[gear][first.min(end - 1)..end].iter().copied().fold(f64::INFINITY, f64::min)
    };
    least(Gear::Pinion) + least(Gear::Wheel)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::contact::ContactSurface;
    use crate::contact::half_space::HalfSpace;
    use crate::contact::winkler::{Winkler, WinklerFoundation};
    use crate::gear::GearPair;
    use crate::gear::flank::PointSpacing;
    use crate::gear::modification::Modification;
    use crate::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};
    use crate::material::Material;

    /// The plastic pair of `validation/plastic-ridge`, whose contact reaches the wheel's root form circle.
    fn pair() -> GearPair {
        pair_of(3.0, 114.74, [(19, 0.35), (57, -0.1)])
    }

    /// A pair of so many teeth and such profile shifts.
    pub(in crate::contact) fn pair_of(
        normal_module_mm: f64,
        centre_distance_mm: f64,
        teeth_and_shifts: [(u32, f64); 2],
    ) -> GearPair {
        let gear = |(teeth, profile_shift)| GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: None,
            tooth_thickness_allowance_mm: -0.06,
            bore_diameter_mm: None,
            modification: Modification::default(),
            shaft: None,
        };
        let spec = PairSpec {
            normal_module_mm,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 0.0,
            centre_distance_mm,
            face_width_mm: 30.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears: PerGear { pinion: gear(teeth_and_shifts[0]), wheel: gear(teeth_and_shifts[1]) },
        };
        GearPair::new(&spec).expect("the pair of the test exists")
    }

    /// Points beyond the end of a flank never wear. Flanks that have lost the same at all points within are opened by that up to their ends,
    /// whether their material is read at a place or as it passes.
    #[test]
    fn ver_flanks_are_worn_up_to_their_ends() {
        let pair = pair();
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let unmodified = grid.as_ref().map(|grid| vec![0.0; grid.len()]);
        let worn_mm = PerGear::from_fn(|gear| {
            let (from, to) = pair.flank_limits_mm(gear);
            let depth_mm = |rho: &f64| if (from..=to).contains(rho) { 0.05 } else { 0.0 };
            grid[gear].coordinate_mm.iter().map(depth_mm).collect::<Vec<f64>>()
        });
        let modification_mm = Some(unmodified.as_ref().map(Vec::as_slice));
        let flanks = Flanks { modification_mm, ..Flanks::of_gears(&pair, grid.as_ref()) };
        let mut ends_at_root_form = 0;
        for k in 0..=40 {
            let position_mm = pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * f64::from(k) / 40.0;
            let window = Window::new(flanks, position_mm, f64::INFINITY);
            let (_, at_tips) = common_extent_mm(&flanks.geometry, position_mm);
            ends_at_root_form += at_tips.into_iter().filter(|at_tip| !at_tip).count();
            let cell = PositionCell { position_mm, lower_mm: position_mm - 0.1, upper_mm: position_mm + 0.1 };
            for passed_during in [None, Some(cell)] {
                let strip = Strip::new(flanks, position_mm, window, window.evenly_mm(400), passed_during);
                let mut gap_mm = Vec::new();
                strip.gap_mm(worn_mm.as_ref().map(Vec::as_slice), &mut gap_mm);
                for (gap, geometric) in gap_mm.iter().zip(&strip.geometric_gap_mm) {
                    assert!((gap - geometric - 0.1).abs() < 1e-12, "at {position_mm} mm: {gap} {geometric}");
                }
            }
        }
        assert!(ends_at_root_form > 10, "{ends_at_root_form}");
    }

    /// Unworn flanks are nowhere nearer than where it is said, by a search of 1000 places: also far before A, where the corner of the undercut pinion has passed the
    /// theoretical contact point to its other side.
    #[test]
    fn ver_unworn_flanks_are_nearest_where_they_touch_or_at_their_edge() {
        let pair = pair_of(6.81, 152.02, [(11, -0.06334), (34, -0.1643)]);
        let (mut beyond, [before_mm, after_mm]) = (0, pair.farthest_touch_mm());
        for k in 0..=60 {
            let (from_mm, to_mm) = (pair.path.start_mm - before_mm, pair.path.end_mm + after_mm);
            let position_mm = from_mm + (to_mm - from_mm) * f64::from(k) / 60.0;
            let (extent_mm, _) = common_extent_mm(&pair, position_mm);
            let gap_mm = |along_mm: f64| -> f64 {
                Gear::BOTH.map(|gear| pair.at_along(gear, on_tangent(gear, along_mm), position_mm).1).iter().sum()
            };
            let nearest_mm = nearest_mm(&pair, position_mm, extent_mm);
            beyond += i32::from(nearest_mm < -1e-3);
            for part in 0..=1000 {
                let along_mm = extent_mm.0 + (extent_mm.1 - extent_mm.0) * f64::from(part) / 1000.0;
                let deeper_mm = gap_mm(nearest_mm) - gap_mm(along_mm);
                assert!(deeper_mm < 1e-9, "{position_mm}: {along_mm} {nearest_mm} {deeper_mm}");
            }
        }
        assert!(beyond > 3, "{beyond}");
    }

    /// Flanks that have lost the less the farther from the line of action, from before A to after E: nothing at which they touch when pressed together has lost
    /// less than what is said, by a search of 4000 places.
    #[test]
    fn ver_what_is_lost_where_flanks_touch_is_found_as_far_as_they_do() {
        // A plastic pair, and a wheel that is undercut, whose flank begins near the base circle.
        for pair in [pair(), pair_of(5.407, 127.4, [(37, 0.02266), (10, 0.0)])] {
            let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 3000, PointSpacing::Graded));
            let flanks = Flanks::of_gears(&pair, grid.as_ref());
            for k in -4..=44 {
                let position_mm = pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * f64::from(k) / 40.0;
                let removed_mm = PerGear::from_fn(|gear| {
                    let here_mm = pair.contact_coordinate_mm(gear, position_mm);
                    let lost_mm = |at: &f64| 1.0 / (1.0 + (at - here_mm).abs());
                    grid[gear].coordinate_mm.iter().map(lost_mm).collect::<Vec<f64>>()
                });
                let ((lowest_mm, highest_mm), _) = common_extent_mm(&flanks.geometry, position_mm);
                for approach_mm in [0.005, 0.05, 0.3] {
                    let mut least_mm = [f64::INFINITY; 2];
                    for part in 0..=4000 {
                        let along_mm = lowest_mm + (highest_mm - lowest_mm) * f64::from(part) / 4000.0;
                        let on_flank =
                            Gear::BOTH.map(|gear| pair.at_along(gear, on_tangent(gear, along_mm), position_mm));
                        if on_flank[0].1 + on_flank[1].1 >= approach_mm {
                            continue;
                        }
                        for (least, (gear, (at_mm, _))) in least_mm.iter_mut().zip(Gear::BOTH.into_iter().zip(on_flank))
                        {
                            let here_mm = pair.contact_coordinate_mm(gear, position_mm);
                            *least = least.min(1.0 / (1.0 + (at_mm - here_mm).abs()));
                        }
                    }
                    let found_mm =
                        least_removed_mm(flanks, position_mm, approach_mm, removed_mm.as_ref().map(Vec::as_slice));
                    let most_mm = least_mm[0] + least_mm[1] + 1e-9;
                    assert!(found_mm <= most_mm, "at {position_mm} mm by {approach_mm} mm: {found_mm}, {most_mm} mm");
                }
            }
        }
    }

    /// The pinion's tip on a ridge below the wear of the wheel, beside the line of action: seen as an overlap as long as the window does not reach
    /// there, and gone once it does.
    #[test]
    fn ver_windows_grow_until_flanks_overlap_nowhere() {
        let pair = pair();
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let position_mm = 15.5;
        let whole = Window::new(flanks, position_mm, f64::INFINITY);
        let ridge_mm =
            *Strip::new(flanks, position_mm, whole, whole.evenly_mm(8), None).geometric_gap_mm.last().unwrap();
        // Rigid flanks would overlap by 0.02 mm on the line of action and by 0.01 mm on the ridge.
        let approach_mm = ridge_mm + 0.01;
        let above_ridge_mm = pair.flank_limits_mm(Gear::Wheel).0 + 0.5;
        let depth_mm = |rho: &f64| if *rho > above_ridge_mm { ridge_mm - 0.01 } else { 0.0 };
        let worn_mm = PerGear {
            pinion: vec![0.0; grid.pinion.len()],
            wheel: grid.wheel.coordinate_mm.iter().map(depth_mm).collect::<Vec<f64>>(),
        };
        let worn_mm = worn_mm.as_ref().map(Vec::as_slice);
        let material = |young_modulus_mpa| Material { young_modulus_mpa, poisson_ratio: 0.35, density_kg_per_m3: 1e3 };
        let half_space = HalfSpace {
            material: PerGear { pinion: material(206e3), wheel: material(2.8e3) },
            expected_line_load_n_per_mm: 20.0,
        };
        let springs =
            Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm: 500.0 }, expected_line_load_n_per_mm: 20.0 };
        for surface in [&half_space as &dyn ContactSurface, &springs] {
            let mut contact = surface.pair(flanks, position_mm, None);
            let mut overlaps_mm = Vec::new();
            for windows in 1.. {
                contact.set_removed(worn_mm);
                contact.load_at(approach_mm - contact.touch_mm());
                let suffices = contact.window_suffices();
                overlaps_mm.push(contact.overlap_beside_mm(worn_mm).unwrap());
                if suffices {
                    break;
                }
                assert!(windows < 20, "{overlaps_mm:?}");
                contact.widen();
            }
            assert!(overlaps_mm[0] > 5e-3 && *overlaps_mm.last().unwrap() == 0.0, "{overlaps_mm:?}");
        }
    }
}
