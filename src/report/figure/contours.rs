//! Contours of values on a rectangular raster: areas between levels and lines at them.
//!
//! Each cell is parted into four triangles about its middle, where the value is the mean of the corners; within a triangle values are linear.

use super::axis::round_step;
use crate::report::chart::Rows;
use crate::report::html::number::to_digits;

/// Levels for a range, about so many.
const ABOUT: f64 = 14.0;

type Place = [f64; 2];
type Corner = (Place, f64);

/// Round levels within the range, and its ends.
pub(super) fn levels(low: f64, high: f64) -> Vec<f64> {
    let step = if high > low { round_step((high - low) / ABOUT) } else { 0.0 };
    let inner = (1..).map(|i| ((low / step).floor() + f64::from(i)) * step);
    let inner = inner.take_while(|level| step > 0.0 && *level < high - 1e-9 * (high - low));
    [low].into_iter().chain(inner.filter(|level| *level > low)).chain([high]).collect()
}

/// A level as it stands on its line.
pub(super) fn label(level: f64, levels: &[f64]) -> String {
    let step = levels.get(1).zip(levels.get(2)).map_or(1.0, |(a, b)| b - a);
    let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    match decimals {
        0..=5 if level.abs() < 1e6 => format!("{level:.decimals$}").replace('-', "−"),
        _ => to_digits(level, 3).to_string().replace('-', "−"),
    }
}

/// Polygons between each level and the next.
pub(super) fn bands(x: &[f64], y: &[f64], values: &Rows, levels: &[f64]) -> Vec<Vec<Vec<Place>>> {
    let triangles = triangles(x, y, values);
    let band = |ends: &[f64]| {
        let within = triangles.iter().map(|triangle| clipped(&clipped(triangle, ends[0], 1.0), ends[1], -1.0));
        within
            .filter(|corners| corners.len() > 2)
            .map(|corners| corners.iter().map(|(place, _)| *place).collect())
            .collect()
    };
    levels.windows(2).map(band).collect()
}

/// Pieces of the line at `level`.
pub(super) fn lines(x: &[f64], y: &[f64], values: &Rows, level: f64) -> Vec<[Place; 2]> {
    let crossing = |triangle: &[Corner; 3]| {
        let sides = [(0, 1), (1, 2), (2, 0)].into_iter();
        let places: Vec<Place> = sides
            .filter(|&(a, b)| (triangle[a].1 < level) != (triangle[b].1 < level))
            .map(|(a, b)| between(triangle[a], triangle[b], level).0)
            .collect();
        <[Place; 2]>::try_from(places).ok()
    };
    triangles(x, y, values).iter().filter_map(crossing).collect()
}

fn triangles(x: &[f64], y: &[f64], values: &Rows) -> Vec<[Corner; 3]> {
    let mut all = Vec::new();
    for j in 1..values.len() {
        for i in 1..values[j].len() {
            let corner = |i: usize, j: usize| ([x[i], y[j]], values[j][i]);
            let corners = [corner(i - 1, j - 1), corner(i, j - 1), corner(i, j), corner(i - 1, j)];
            let mean = corners.iter().map(|(_, value)| value).sum::<f64>() / 4.0;
            if !mean.is_finite() {
                continue;
            }
            let middle = ([x[i - 1].midpoint(x[i]), y[j - 1].midpoint(y[j])], mean);
            all.extend((0..4).map(|side| [corners[side], corners[(side + 1) % 4], middle]));
        }
    }
    all
}

/// The part of a polygon whose values are not below `level`, or with a `sign` of −1 not above it.
fn clipped(corners: &[Corner], level: f64, sign: f64) -> Vec<Corner> {
    let is_in = |corner: &Corner| sign * (corner.1 - level) >= 0.0;
    let mut kept = Vec::new();
    for (number, corner) in corners.iter().enumerate() {
        let next = corners[(number + 1) % corners.len()];
        if is_in(corner) {
            kept.push(*corner);
        }
        if is_in(corner) != is_in(&next) {
            kept.push(between(*corner, next, level));
        }
    }
    kept
}

/// The place of `level` between two corners on either side of it.
fn between(from: Corner, to: Corner, level: f64) -> Corner {
    let share = (level - from.1) / (to.1 - from.1);
    ([0, 1].map(|axis| from.0[axis] + share * (to.0[axis] - from.0[axis])), level)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z = x over the unit square: the band from 0.25 to 0.5 has a quarter of its area, the line at 0.5 the length 1.
    #[test]
    fn bands_and_lines_of_a_plane() {
        let (places, values) = ([0.0, 1.0], vec![vec![0.0, 1.0], vec![0.0, 1.0]]);
        let area = |corners: &Vec<Place>| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum::<f64>().abs()
        };
        let bands = bands(&places, &places, &values, &[0.0, 0.25, 0.5, 1.0]);
        let areas: Vec<f64> = bands.iter().map(|band| band.iter().map(area).sum()).collect();
        assert!(areas.iter().zip([0.25, 0.25, 0.5]).all(|(found, exact)| (found - exact).abs() < 1e-12), "{areas:?}");
        let line = lines(&places, &places, &values, 0.3);
        let length: f64 = line.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length - 1.0).abs() < 1e-12 && line.iter().flatten().all(|place| (place[0] - 0.3).abs() < 1e-12));
        assert_eq!(
            levels(0.0, 1.0),
            [0.0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5, 0.6000000000000001, 0.7000000000000001, 0.8, 0.9, 1.0]
        );
    }
}
