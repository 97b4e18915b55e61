//! The stretch of both flanks around the theoretical contact point where they may touch.
//!
//! A strip has samples of the geometric gap in the tangent frame and, for each, its place between the points of
//! both flanks, so that the real gap (geometry plus removed material) is one pass over plain arrays.
//!
//! The load follows from these samples, which are evenly spaced across the contact, with more of them where a modification has a kink; pressure and
//! sliding are observed at the points of the flanks themselves ([`super::observed_points`]). A strip ends exactly where a flank ends, in a tip edge or
//! at the form circle: no pressure acts beyond.

use std::cmp::Ordering;
use std::ops::Range;

use super::Flanks;
use super::coordinates_along::CoordinatesAlong;
use super::flank_motion::{PressureMotion, ROUND_OFF, edge_under_load, on_tangent, tips_mm};
use super::weighted_rows::{RowsOfAnyLength, WeightedRows};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid};
use gearwear_bodies::reference::linear_means::add_means;

/// Points of a gear's grid between which its removed material is interpolated.
///
/// Where the flank ends between two points, only the one within it wears: the last stretch up to the end has lost as much as that point. A straight
/// line to the point beyond would leave a ridge there that carries load and never wears.
fn points_within(flanks: Flanks<'_>, gear: Gear) -> Range<usize> {
    let coordinate_mm = &flanks.grid[gear].coordinate_mm;
    let limits = flanks.geometry.flank_limits_mm(gear);
    let round_off = ROUND_OFF * limits.1;
    let first = coordinate_mm.partition_point(|&at| at < limits.0 - round_off);
    let end = coordinate_mm.partition_point(|&at| at <= limits.1 + round_off);
    // All points where fewer than two lie within.
    if end >= first + 2 { first..end } else { 0..coordinate_mm.len() }
}

/// Removed material of one flank at samples between its points.
#[derive(Debug, Clone)]
pub(super) struct Interpolation {
    /// Indices of the first and of the last but one of [`points_within`].
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

    /// Weights of the points at the samples.
    fn weights(&self, points: usize) -> WeightedRows<f64> {
        let mut rows = RowsOfAnyLength::of_about(self.index.len());
        let samples = self.index.iter().zip(&self.weight);
        samples.for_each(|(index, weight)| rows.push(*index as usize, &[1.0 - weight, *weight]));
        rows.packed(points)
    }

    /// Values at the samples.
    pub(super) fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.index.iter().zip(&self.weight).map(|(&i, &weight)| {
            let ends = &values[i as usize..i as usize + 2];
            ends[0] + weight * (ends[1] - ends[0])
        })
    }
}

/// Weights of the points of a flank in the means over the stretches that pass the samples `along_mm` under a pressure of this motion, where the flank has
/// these coordinates.
fn passing(
    flanks: Flanks<'_>,
    gear: Gear,
    motion: PressureMotion,
    along_mm: &[f64],
    coordinates_mm: &[f64],
) -> WeightedRows<f64> {
    let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
    let mut passing = RowsOfAnyLength::of_about(along_mm.len());
    let within = points_within(flanks, gear);
    let points_mm = &grid.coordinate_mm[within.clone()];
    // All 0 again after every sample.
    let mut sums = vec![0.0; points_mm.len()];
    let between = CoordinatesAlong::new(along_mm, coordinates_mm);
    for (sample_mm, at_mm) in along_mm.iter().zip(coordinates_mm) {
        let passed = motion.passes_mm(&geometry, gear, (*at_mm, *sample_mm), || grid.distance_at_mm(*at_mm));
        let ends = passed.map(|by| {
            let end_mm = on_tangent(gear, *sample_mm) - by;
            let interpolated = between.at(on_tangent(gear, end_mm));
            interpolated.unwrap_or_else(|| geometry.at_along(gear, end_mm, motion.cell.position_mm).0)
        });
        let reached = add_means(points_mm, [ends[0].min(ends[1]), ends[0].max(ends[1])], 1.0, &mut sums);
        passing.push(within.start + reached.start, &sums[reached.clone()]);
        sums[reached].fill(0.0);
    }
    passing.packed(grid.len())
}

/// Weights in the means over cells of two intervals between samples each, from those at the samples.
fn means_of_cells(samples: &WeightedRows<f64>, points: usize) -> WeightedRows<f64> {
    let mut cells = RowsOfAnyLength::of_about(samples.count() / 2);
    let mut sums = Vec::new();
    for k in (0..samples.count() - 2).step_by(2) {
        let of_cell = [k, k + 1, k + 2].map(|k| samples.row(k));
        let first = of_cell.iter().map(|(first, _)| *first).min().unwrap_or_default();
        let end = of_cell.iter().map(|(first, weights)| first + weights.len()).max().unwrap_or_default();
        sums.clear();
        sums.resize(end - first, 0.0);
        for ((from, weights), part) in of_cell.into_iter().zip(OF_CELL) {
            sums[from - first..].iter_mut().zip(weights).for_each(|(sum, weight)| *sum += part * weight);
        }
        cells.push(first, &sums);
    }
    cells.packed(points)
}

/// Weights of begin, middle and end of a cell in its mean.
const OF_CELL: [f64; 3] = [0.25, 0.5, 0.25];

/// Part of the tangent at one position in which a contact is looked for; mm from the theoretical contact point, positive towards the pinion's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactWindow {
    /// Lower end.
    pub lower_mm: f64,
    /// Upper end.
    pub upper_mm: f64,
    /// Place where unworn flanks are nearest.
    pub nearest_mm: f64,
    /// Whether a flank ends at each end.
    pub ends_are_real: [bool; 2],
    /// Whether a flank ends there in a sharp edge that may carry load: the wheel's tip or the pinion's corner of undercut below, the pinion's tip or
    /// the wheel's corner of undercut above.
    pub ends_are_sharp: [bool; 2],
}

/// Least length of a window, mm.
const LEAST_LENGTH_MM: f64 = 1e-6;

impl ContactWindow {
    /// A window of `half_length_mm` to either side of the theoretical contact point, or of the edge beside it where one flank
    /// ends before that point, cut where a flank ends; of [`LEAST_LENGTH_MM`] where the flanks do not face each other, past the tips of both gears.
    pub(crate) fn new(flanks: Flanks<'_>, position_mm: f64, half_length_mm: f64) -> Self {
        let ((lower, upper), at_tips) = common_extent_mm(&flanks.geometry, position_mm);
        let nearest_mm = nearest_mm(&flanks.geometry, position_mm, (lower, upper));
        let (from, to) = (nearest_mm - half_length_mm, nearest_mm + half_length_mm);
        let ends_are_real = [lower >= from, upper <= to];
        let (edges, corners) = (flanks.sharp_edges, flanks.sharp_corners);
        let sharp = [(edges.wheel, corners.pinion), (edges.pinion, corners.wheel)];
        let lower_mm = lower.max(from);
        Self {
            lower_mm,
            upper_mm: upper.min(to).max(lower_mm + LEAST_LENGTH_MM),
            nearest_mm,
            ends_are_real,
            ends_are_sharp: [0, 1]
                .map(|end| ends_are_real[end] && if at_tips[end] { sharp[end].0 } else { sharp[end].1 }),
        }
    }

    /// Length, mm.
    pub(crate) fn length_mm(&self) -> f64 {
        self.upper_mm - self.lower_mm
    }

    /// Ends of `intervals` even parts of the window.
    pub(crate) fn evenly_mm(&self, intervals: usize) -> Vec<f64> {
        let spacing_mm = self.length_mm() / intervals as f64;
        (0..=intervals).map(|k| self.lower_mm + k as f64 * spacing_mm).collect()
    }

    /// Both ends; all places between them that are whole multiples of `spacing_mm` from where unworn flanks are nearest, so that a contact carries the same
    /// load in windows of all lengths; and the points of both flanks where a modification has a kink that these places would miss by
    /// `missed_mm` or more: between two places, h apart, a course that turns by κ lies up to κ h/4 beside the straight line.
    pub(crate) fn with_kinks_mm(
        &self,
        flanks: Flanks<'_>,
        position_mm: f64,
        spacing_mm: f64,
        missed_mm: f64,
    ) -> Vec<f64> {
        let [lower, upper] = [self.lower_mm, self.upper_mm].map(|end_mm| (end_mm - self.nearest_mm) / spacing_mm);
        let (first, last) = ((lower + SAME_PLACE).floor() as i64 + 1, (upper - SAME_PLACE).ceil() as i64 - 1);
        let within = (first..=last).map(|k| self.nearest_mm + k as f64 * spacing_mm);
        let mut places_mm: Vec<f64> =
            std::iter::once(self.lower_mm).chain(within).chain(std::iter::once(self.upper_mm)).collect();
        let Some(modification_mm) = flanks.modification_mm else { return places_mm };
        for gear in Gear::BOTH {
            let (geometry, grid, removed_mm) = (flanks.geometry, flanks.grid[gear], modification_mm[gear]);
            let [low, high] = [self.lower_mm, self.upper_mm]
                .map(|end_mm| grid.place(geometry.at_along(gear, on_tangent(gear, end_mm), position_mm).0).index);
            let within = low.min(high).max(1)..(low.max(high) + 1).min(grid.len() - 2) + 1;
            for i in within.filter(|&i| removed_mm[i - 1] != removed_mm[i] || removed_mm[i] != removed_mm[i + 1]) {
                let at_mm = [i - 1, i, i + 1]
                    .map(|i| geometry.in_tangent_frame(gear, grid.coordinate_mm[i], position_mm).along_mm);
                let slopes = [0, 1].map(|k| (removed_mm[i + k] - removed_mm[i + k - 1]) / (at_mm[k + 1] - at_mm[k]));
                let (turn, place_mm) = ((slopes[1] - slopes[0]).abs(), on_tangent(gear, at_mm[1]));
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

    /// Whether a sharp edge cuts off a contact that presses on these of the ends.
    pub(crate) fn is_sharp_where(&self, pressed: [bool; 2]) -> bool {
        self.ends_are_sharp.iter().zip(pressed).any(|(sharp, pressed)| *sharp && pressed)
    }
}

/// Extent of the tangent over which both flanks exist, before A and after E beside the theoretical contact point; and whether a tip edge
/// ends it, the wheel's below and the pinion's above.
pub(super) fn common_extent_mm(geometry: &dyn ConjugateFlanks, position_mm: f64) -> ((f64, f64), [bool; 2]) {
    // At A and E, where one limit is the contact point itself, rounding errors must not put it outside.
    let limits = Gear::BOTH.map(|gear| geometry.flank_limits_mm(gear));
    let round_off = ROUND_OFF * limits[0].1.max(limits[1].1);
    let [pinion, wheel] = Gear::BOTH.map(|gear| {
        let (root, tip) = limits[gear as usize];
        [root, tip].map(|at| on_tangent(gear, geometry.in_tangent_frame(gear, at, position_mm).along_mm))
    });
    let (lowers, uppers) = ([pinion[0], wheel[1]], [pinion[1], wheel[0]]);
    let (lower, upper) = (lowers[0].max(lowers[1]), uppers[0].min(uppers[1]));
    let extent = (
        if lower < round_off { lower.min(0.0) } else { lower },
        if upper > -round_off { upper.max(0.0) } else { upper },
    );
    (extent, [lowers[1] >= lowers[0], uppers[0] <= uppers[1]])
}

/// Place within the extent of [`common_extent_mm`] where unworn flanks are nearest: the theoretical contact point, or the edge beside it where a
/// flank has not begun or has ended. Before T1 and after T2 the corner of an undercut flank may lie on the other side of that point.
pub(super) fn nearest_mm(geometry: &dyn ConjugateFlanks, position_mm: f64, (lower_mm, upper_mm): (f64, f64)) -> f64 {
    match edge_under_load(geometry, tips_mm(geometry), position_mm) {
        Some(edge) if edge.is_before => lower_mm,
        Some(_) => upper_mm,
        None => 0.0_f64.min(upper_mm).max(lower_mm),
    }
}

/// Distance of the points at the theoretical contact point, on the flank whose points are closer.
pub(crate) fn point_distance_mm(flanks: Flanks<'_>, position_mm: f64) -> f64 {
    let [pinion, wheel] = Gear::BOTH
        .map(|gear| flanks.grid[gear].distance_at_mm(flanks.geometry.contact_coordinate_mm(gear, position_mm)));
    pinion.min(wheel)
}

/// Part of the samples' distance within which two places are one.
const SAME_PLACE: f64 = 1e-6;

/// Samples across the candidate contact.
#[derive(Debug, Clone)]
pub(crate) struct Strip {
    /// Window of the samples.
    pub window: ContactWindow,
    /// Places of the samples, mm.
    pub along_mm: Vec<f64>,
    /// Geometric gap at each sample, mm.
    pub geometric_gap_mm: Vec<f64>,
    /// Gap of unworn flanks without modifications at both ends, mm.
    unmodified_at_ends_mm: [f64; 2],
    removed: Removed,
}

/// Removed material at the samples.
#[derive(Debug, Clone)]
enum Removed {
    /// Value at the place of each sample.
    Here(PerGear<Interpolation>),
    /// Mean of the material that passes each sample, or over a cell.
    Weighted(PerGear<WeightedRows<f64>>),
}

impl Strip {
    /// Samples at `along_mm`, in order, the first and the last at the ends of `window`. Where flanks pass under a pressure of
    /// the motion `passed_under`, each sample has the mean wear of the flank that passes it, all of which feels its pressure:
    /// with the wear of one place alone, a wave of wear as long as the distance of the positions would meet each of them alike, and grow.
    pub(crate) fn new(
        flanks: Flanks<'_>,
        position_mm: f64,
        window: ContactWindow,
        along_mm: Vec<f64>,
        passed_under: Option<PressureMotion>,
    ) -> Self {
        let mut geometric_gap_mm = vec![0.0; along_mm.len()];
        let coordinates_mm = PerGear::from_fn(|gear| -> Vec<f64> {
            let places =
                along_mm.iter().map(|&along| flanks.geometry.at_along(gear, on_tangent(gear, along), position_mm));
            let places = places.zip(&mut geometric_gap_mm).map(|((coordinate, drop), gap)| {
                *gap += drop;
                coordinate
            });
            places.collect()
        });
        let here = PerGear::from_fn(|gear| {
            let mut here = Interpolation::new(flanks, gear);
            coordinates_mm[gear].iter().for_each(|coordinate| here.push(flanks.grid[gear], *coordinate));
            here
        });
        let unmodified_at_ends_mm = [0, geometric_gap_mm.len() - 1].map(|end| geometric_gap_mm[end]);
        let (Some(modification_mm), Some(motion)) = (flanks.modification_mm, passed_under) else {
            return Self { window, along_mm, geometric_gap_mm, unmodified_at_ends_mm, removed: Removed::Here(here) };
        };
        let passing = PerGear::from_fn(|gear| {
            let passing = passing(flanks, gear, motion, &along_mm, &coordinates_mm[gear]);
            // A modification counts as at the sample.
            let mut means = vec![0.0; along_mm.len()];
            passing.add_products(0, modification_mm[gear], &mut means);
            let beside = here[gear].of(modification_mm[gear]).zip(means);
            geometric_gap_mm.iter_mut().zip(beside).for_each(|(gap, (here, mean))| *gap += here - mean);
            passing
        });
        Self { window, along_mm, geometric_gap_mm, unmodified_at_ends_mm, removed: Removed::Weighted(passing) }
    }

    /// Strip with a sample for each cell of two intervals instead: gap and removed material are ¼, ½ and ¼ of those at its begin, middle and end,
    /// and the gap is counted from `lower_mm` below. The flanks have so many points.
    pub(crate) fn over_cells(self, points: PerGear<usize>, lower_mm: f64) -> Self {
        let gaps = self.geometric_gap_mm.windows(3).step_by(2);
        let mean = |gap: &[f64]| gap.iter().zip(OF_CELL).map(|(gap, part)| part * gap).sum::<f64>();
        let geometric_gap_mm = gaps.map(|gap| mean(gap) - lower_mm).collect();
        let along_mm = self.along_mm.iter().copied().skip(1).step_by(2).collect();
        let removed = Removed::Weighted(PerGear::from_fn(|gear| match &self.removed {
            Removed::Here(here) => means_of_cells(&here[gear].weights(points[gear]), points[gear]),
            Removed::Weighted(rows) => means_of_cells(&rows[gear], points[gear]),
        }));
        Self { along_mm, geometric_gap_mm, removed, ..self }
    }

    /// Distance of evenly spaced samples.
    pub(crate) fn spacing_mm(&self) -> f64 {
        self.window.length_mm() / (self.along_mm.len() - 1) as f64
    }

    /// Fills `gap_mm` with the gap of flanks that have lost `removed_mm`. Returns the least gap.
    pub(crate) fn gap_mm(&self, removed_mm: PerGear<&[f64]>, gap_mm: &mut Vec<f64>) -> f64 {
        gap_mm.clear();
        gap_mm.extend_from_slice(&self.geometric_gap_mm);
        for gear in Gear::BOTH {
            match &self.removed {
                Removed::Here(here) => {
                    gap_mm.iter_mut().zip(here[gear].of(removed_mm[gear])).for_each(|(gap, removed)| *gap += removed);
                }
                Removed::Weighted(rows) => rows[gear].add_products(0, removed_mm[gear], gap_mm),
            }
        }
        least(gap_mm)
    }

    /// Whether flanks pressed together by `approach_mm`, which have lost at least `removed_mm` wherever they may touch, can touch
    /// beyond an end of the window where no flank ends and the surfaces have sunk by `sunk_mm`. Modifications do not count: they may differ beyond the
    /// end.
    pub(crate) fn may_touch_beyond(&self, approach_mm: f64, removed_mm: f64, sunk_mm: [f64; 2]) -> bool {
        let ends = self.unmodified_at_ends_mm.into_iter().zip(sunk_mm).zip(self.window.ends_are_real);
        ends.into_iter().any(|((gap, sunk), real)| !real && gap + sunk + removed_mm < approach_mm)
    }
}

/// Least of some values, in partial minima.
fn least(values: &[f64]) -> f64 {
    const LANES: usize = 8;
    let lesser = |one: f64, other: f64| if other < one { other } else { one };
    let mut minima = [f64::INFINITY; LANES];
    let chunks = values.chunks_exact(LANES);
    let rest = chunks.remainder();
    chunks.for_each(|chunk| minima.iter_mut().zip(chunk).for_each(|(least, value)| *least = lesser(*least, *value)));
    minima.iter().chain(rest).copied().fold(f64::INFINITY, lesser)
}

/// Number of parts of the stretch from an end of a window to the end of a flank.
const PARTS_BESIDE: usize = 64;

/// Places along the tangent beside a window at which flanks pressed together by `approach_mm` can touch, each with the gap of flanks that have lost
/// `removed_mm`, mm. The gap of unworn flanks grows with the distance from their contact: beyond the place where it is `approach_mm` none can touch.
pub(crate) fn gaps_beside_mm(
    flanks: Flanks<'_>,
    position_mm: f64,
    window: ContactWindow,
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

/// Length of flank that is searched, over that on which parabolas of the relative curvature touch.
const AMPLE_REACH: f64 = 1.25;
/// Least part of the common extent of both flanks that is searched.
const LEAST_REACH: f64 = 1e-3;

/// Least loss of both flanks together wherever they can touch when pressed together by `approach_mm`: where the unworn gap is less than that.
pub(crate) fn least_removed_mm(
    flanks: Flanks<'_>,
    position_mm: f64,
    approach_mm: f64,
    removed_mm: PerGear<&[f64]>,
) -> f64 {
    let ((lowest_mm, highest_mm), _) = common_extent_mm(&flanks.geometry, position_mm);
    let centre_mm = nearest_mm(&flanks.geometry, position_mm, (lowest_mm, highest_mm));
    let of_parabola_mm = (2.0 * flanks.geometry.relative_radius_mm(position_mm).max(0.0) * approach_mm).sqrt();
    let first_mm = (AMPLE_REACH * of_parabola_mm).max(LEAST_REACH * (highest_mm - lowest_mm));
    // Outside A to E the gap is not the parabola of the contact.
    let ends_mm = [-1.0, 1.0].map(|outwards| {
        let mut by_mm = first_mm;
        loop {
            let at_mm = (centre_mm + outwards * by_mm).min(highest_mm).max(lowest_mm);
            if at_mm == lowest_mm || at_mm == highest_mm || unworn_gap_mm(flanks, at_mm, position_mm) >= approach_mm {
                return at_mm;
            }
            by_mm *= 1.5;
        }
    });
    let [pinion, wheel] = Gear::BOTH.map(|gear| {
        let coordinate_mm = &flanks.grid[gear].coordinate_mm;
        let at_mm = ends_mm.map(|along_mm| flanks.geometry.at_along(gear, on_tangent(gear, along_mm), position_mm).0);
        // The next point on either side counts too: removed material is linear in between.
        let first = coordinate_mm.partition_point(|&at| at < at_mm[0].min(at_mm[1])).saturating_sub(1);
        let end = (coordinate_mm.partition_point(|&at| at <= at_mm[0].max(at_mm[1])) + 1).min(coordinate_mm.len());
        removed_mm[gear][first.min(end - 1)..end].iter().copied().fold(f64::INFINITY, f64::min)
    });
    pinion + wheel
}

/// Gap of unworn flanks at a place along the tangent.
fn unworn_gap_mm(flanks: Flanks<'_>, along_mm: f64, position_mm: f64) -> f64 {
    let gaps = Gear::BOTH.map(|gear| flanks.geometry.at_along(gear, on_tangent(gear, along_mm), position_mm).1);
    gaps.into_iter().sum()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::contact::half_space::HalfSpace;
    use crate::contact::winkler::{Winkler, WinklerFoundation};
    use crate::contact::{ContactSurface, PositionCell};
    use gearwear_bodies::gear::GearPair;
    use gearwear_bodies::gear::flank::PointSpacing;
    use gearwear_bodies::gear::modification::Modification;
    use gearwear_bodies::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};
    use gearwear_bodies::material::Material;

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
        let [pinion, wheel] = teeth_and_shifts.map(|(teeth, profile_shift)| GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: None,
            tooth_thickness_allowance_mm: -0.06,
            bore_diameter_mm: None,
            modification: Modification::default(),
            measured_flank: None,
            shaft: None,
            ring: None,
            tip_chamfer: None,
        });
        let spec = PairSpec {
            normal_module_mm,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 0.0,
            centre_distance_mm,
            face_width_mm: 30.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears: PerGear { pinion, wheel },
        };
        GearPair::new(&spec).expect("the pair of the test exists")
    }

    /// Points beyond the end of a flank never wear. Flanks that have lost the same at all points within are opened by as much up to their ends,
    /// with the material at each sample and with the mean that passes it.
    #[test]
    fn ver_flanks_are_worn_up_to_their_ends() {
        let pair = pair();
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let unmodified = grid.as_ref().map(|grid| vec![0.0; grid.len()]);
        let worn_mm = PerGear::from_fn(|gear| {
            let (from, to) = pair.flank_limits_mm(gear);
            let rhos_mm = grid[gear].coordinate_mm.iter();
            rhos_mm.map(|rho| if (from..=to).contains(rho) { 0.05 } else { 0.0 }).collect::<Vec<f64>>()
        });
        let modification_mm = Some(unmodified.as_ref().map(Vec::as_slice));
        let flanks = Flanks { modification_mm, ..Flanks::of_gears(&pair, grid.as_ref()) };
        let mut ends_at_root_form = 0;
        for k in 0..=40 {
            let position_mm = pair.path.start_mm + (pair.path.end_mm - pair.path.start_mm) * f64::from(k) / 40.0;
            let window = ContactWindow::new(flanks, position_mm, f64::INFINITY);
            let (_, at_tips) = common_extent_mm(&flanks.geometry, position_mm);
            ends_at_root_form += at_tips.into_iter().filter(|at_tip| !at_tip).count();
            let cell = PositionCell { position_mm, lower_mm: position_mm - 0.1, upper_mm: position_mm + 0.1 };
            for passed_under in [None, Some(PressureMotion::new(flanks, cell, 0.2))] {
                let strip = Strip::new(flanks, position_mm, window, window.evenly_mm(400), passed_under);
                let mut gap_mm = Vec::new();
                strip.gap_mm(worn_mm.as_ref().map(Vec::as_slice), &mut gap_mm);
                for (gap, geometric) in gap_mm.iter().zip(&strip.geometric_gap_mm) {
                    assert!((gap - geometric - 0.1).abs() < 1e-12, "at {position_mm} mm: {gap} {geometric}");
                }
            }
        }
        assert!(ends_at_root_form > 10, "{ends_at_root_form}");
    }

    /// Unworn flanks are nowhere nearer than at [`nearest_mm`], by a search of 1000 places: also far before A, where the corner of the undercut pinion
    /// has passed the theoretical contact point.
    #[test]
    fn ver_unworn_flanks_are_nearest_where_they_touch_or_at_their_edge() {
        let pair = pair_of(6.81, 152.02, [(11, -0.06334), (34, -0.1643)]);
        let (mut beyond, [before_mm, after_mm]) = (0, pair.farthest_touch_mm());
        for k in 0..=60 {
            let (from_mm, to_mm) = (pair.path.start_mm - before_mm, pair.path.end_mm + after_mm);
            let position_mm = from_mm + (to_mm - from_mm) * f64::from(k) / 60.0;
            let (extent_mm, _) = common_extent_mm(&pair, position_mm);
            let nearest_mm = nearest_mm(&pair, position_mm, extent_mm);
            beyond += i32::from(nearest_mm < -1e-3);
            for part in 0..=1000 {
                let along_mm = extent_mm.0 + (extent_mm.1 - extent_mm.0) * f64::from(part) / 1000.0;
                let [nearest_gap_mm, gap_mm] = [nearest_mm, along_mm].map(|along_mm| -> f64 {
                    Gear::BOTH.map(|gear| pair.at_along(gear, on_tangent(gear, along_mm), position_mm).1).iter().sum()
                });
                let deeper_mm = nearest_gap_mm - gap_mm;
                assert!(deeper_mm < 1e-9, "{position_mm}: {along_mm} {nearest_mm} {deeper_mm}");
            }
        }
        assert!(beyond > 3, "{beyond}");
    }

    /// Flanks that have lost the less the farther from the line of action, from before A to after E: no place at which they touch when pressed together
    /// has lost less than [`least_removed_mm`], by a search of 4000 places.
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
                    let places_mm = grid[gear].coordinate_mm.iter();
                    places_mm.map(|at| 1.0 / (1.0 + (at - here_mm).abs())).collect::<Vec<f64>>()
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

    /// The pinion's tip on a ridge below the wear of the wheel, beside the line of action: an overlap beside the window as long as it does not reach
    /// there, and none once it does.
    #[test]
    fn ver_windows_grow_until_flanks_overlap_nowhere() {
        let pair = pair();
        let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 300, PointSpacing::Graded));
        let flanks = Flanks::of_gears(&pair, grid.as_ref());
        let position_mm = 15.5;
        let whole = ContactWindow::new(flanks, position_mm, f64::INFINITY);
        let ridge_mm =
            *Strip::new(flanks, position_mm, whole, whole.evenly_mm(8), None).geometric_gap_mm.last().unwrap();
        // Rigid flanks would overlap by 0.02 mm on the line of action and by 0.01 mm on the ridge.
        let approach_mm = ridge_mm + 0.01;
        let above_ridge_mm = pair.flank_limits_mm(Gear::Wheel).0 + 0.5;
        let rhos_mm = grid.wheel.coordinate_mm.iter();
        let worn_mm = PerGear {
            pinion: vec![0.0; grid.pinion.len()],
            wheel: rhos_mm.map(|rho| if *rho > above_ridge_mm { ridge_mm - 0.01 } else { 0.0 }).collect::<Vec<f64>>(),
        };
        let worn_mm = worn_mm.as_ref().map(Vec::as_slice);
        let material = PerGear { pinion: 206e3, wheel: 2.8e3 }.map(|young_modulus_mpa| Material {
            young_modulus_mpa,
            poisson_ratio: 0.35,
            density_kg_per_m3: 1e3,
        });
        let half_space = HalfSpace { material, expected_line_load_n_per_mm: 20.0 };
        let springs =
            Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm: 500.0 }, expected_line_load_n_per_mm: 20.0 };
        for surface in [&half_space as &dyn ContactSurface, &springs] {
            let mut contact = surface.pair(flanks, position_mm, None);
            let mut overlaps_mm = Vec::new();
            for windows in 1.. {
                contact.set_removed(worn_mm);
                contact.load_at(approach_mm - contact.touch_mm());
                let suffices = contact.window_suffices(worn_mm);
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
