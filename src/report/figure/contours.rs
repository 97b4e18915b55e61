//! Contours of values on a rectangular raster: areas between levels and lines at them.
//!
//! Each cell is parted into four triangles about its middle, where the value is the mean of the corners; within a triangle values are linear. Cells
//! between two levels are drawn whole, as one rectangle where they lie side by side.

use super::axis::round_step;
use crate::report::chart::Rows;
use crate::report::html::number::to_digits;

/// Levels for a range, about so many.
const ABOUT: f64 = 14.0;

type Place = [f64; 2];
pub(super) type Corner = (Place, f64);

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
    let mut bands = vec![Vec::new(); levels.len().saturating_sub(1)];
    for j in 1..values.len() {
        // The rectangle that goes on: its band, and the column where it begins.
        let mut run: Option<(usize, usize)> = None;
        for i in 1..=values[j].len() {
            let corners = (i < values[j].len()).then(|| corners(x, y, values, i, j));
            let whole = corners.and_then(|corners| band_of(&corners, levels));
            if let Some((band, first)) = run.filter(|(band, _)| Some(*band) != whole) {
                bands[band].push(vec![[x[first], y[j - 1]], [x[i - 1], y[j - 1]], [x[i - 1], y[j]], [x[first], y[j]]]);
                run = None;
            }
            match (whole, corners) {
                (Some(band), _) => run = run.or(Some((band, i - 1))),
                (None, Some(corners)) => add_parts(&mut bands, &parted(&corners), levels),
                (None, None) => {}
            }
        }
    }
    bands
}

/// The band in which all corners of a cell lie.
fn band_of(corners: &[Corner; 4], levels: &[f64]) -> Option<usize> {
    let within = |ends: &[f64]| corners.iter().all(|(_, value)| (ends[0]..=ends[1]).contains(value));
    levels.windows(2).position(within)
}

/// Adds the parts of triangles between each level and the next.
fn add_parts(bands: &mut [Vec<Vec<Place>>], triangles: &[[Corner; 3]], levels: &[f64]) {
    for (band, ends) in bands.iter_mut().zip(levels.windows(2)) {
        let within = triangles.iter().map(|triangle| clipped(&clipped(triangle, ends[0], 1.0), ends[1], -1.0));
        band.extend(
            within.filter(|corners| corners.len() > 2).map(|corners| corners.iter().map(|(place, _)| *place).collect()),
        );
    }
}

/// Pieces of the line at `level` through `triangles`.
pub(super) fn lines(triangles: &[[Corner; 3]], level: f64) -> Vec<[Place; 2]> {
    let crossing = |triangle: &[Corner; 3]| {
        let sides = [(0, 1), (1, 2), (2, 0)].into_iter();
        let places: Vec<Place> = sides
            .filter(|&(a, b)| (triangle[a].1 < level) != (triangle[b].1 < level))
            .map(|(a, b)| between(triangle[a], triangle[b], level).0)
            .collect();
        <[Place; 2]>::try_from(places).ok()
    };
    triangles.iter().filter_map(crossing).collect()
}

/// Triangles of all cells.
pub(super) fn triangles(x: &[f64], y: &[f64], values: &Rows) -> Vec<[Corner; 3]> {
    let cells = (1..values.len()).flat_map(|j| (1..values[j].len()).map(move |i| (i, j)));
    cells.flat_map(|(i, j)| parted(&corners(x, y, values, i, j))).collect()
}

/// Corners of the cell before column `i` and row `j`, once round.
fn corners(x: &[f64], y: &[f64], values: &Rows, i: usize, j: usize) -> [Corner; 4] {
    [(i - 1, j - 1), (i, j - 1), (i, j), (i - 1, j)].map(|(i, j)| ([x[i], y[j]], values[j][i]))
}

/// Triangles of a cell; none where a corner has no value.
fn parted(corners: &[Corner; 4]) -> Vec<[Corner; 3]> {
    let mean = corners.iter().map(|(_, value)| value).sum::<f64>() / 4.0;
    if !mean.is_finite() {
        return Vec::new();
    }
    let ([before, _, after, _], half) = (corners.map(|(place, _)| place), [0, 1]);
    let middle = (half.map(|axis| before[axis].midpoint(after[axis])), mean);
    (0..4).map(|side| [corners[side], corners[(side + 1) % 4], middle]).collect()
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

    fn area(corners: &[Place]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum::<f64>().abs()
    }

    /// z = x over the unit square: the band from 0.25 to 0.5 has a quarter of its area, the line at 0.5 the length 1.
    #[test]
    fn bands_and_lines_of_a_plane() {
        let (places, values) = ([0.0, 1.0], vec![vec![0.0, 1.0], vec![0.0, 1.0]]);
        let bands = bands(&places, &places, &values, &[0.0, 0.25, 0.5, 1.0]);
        let areas: Vec<f64> = bands.iter().map(|band| band.iter().map(|corners| area(corners)).sum()).collect();
        assert!(areas.iter().zip([0.25, 0.25, 0.5]).all(|(found, exact)| (found - exact).abs() < 1e-12), "{areas:?}");
        let line = lines(&triangles(&places, &places, &values), 0.3);
        let length: f64 = line.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length - 1.0).abs() < 1e-12 && line.iter().flatten().all(|place| (place[0] - 0.3).abs() < 1e-12));
        assert_eq!(
            levels(0.0, 1.0),
            [0.0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5, 0.6000000000000001, 0.7000000000000001, 0.8, 0.9, 1.0]
        );
    }

    /// z = 1 − |x| − |y| where that is positive, and 0 beyond, at 41 × 41 places: bands cover the square once, and cells between two levels are few rectangles.
    #[test]
    fn bands_cover_the_square_once_with_few_polygons() {
        let places: Vec<f64> = (0..41).map(|i| -2.0 + 0.1 * f64::from(i)).collect();
        let row = |y: &f64| places.iter().map(|x| (1.0 - x.abs() - y.abs()).max(0.0)).collect();
        let values: Rows = places.iter().map(row).collect();
        let bands = bands(&places, &places, &values, &[0.0, 0.25, 0.5, 0.75, 1.0]);
        let whole: f64 = bands.iter().flatten().map(|corners| area(corners)).sum();
        assert!((whole - 16.0).abs() < 1e-9, "{whole}");
        let polygons = bands.iter().map(Vec::len).sum::<usize>();
        assert!(polygons < 40 * 40 / 2, "{polygons}");
    }
}
