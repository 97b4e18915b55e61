//! Many values as a picture of few cells.
//!
//! A screen shows some hundred cells along a picture; a flank has more points. Neighbours are put together, and a cell shows
//! the greatest of its values, so that no peak is lost.

use std::ops::Range;

use crate::report::html::active_flank::ActiveFlank;
use crate::report::html::number::to_digits;
use gearwear_physics::results::run::FlankRecord;

/// Cells at most from root to tip, or along the path.
pub(crate) const MOST_ALONG: usize = 120;
/// Cells at most over the face width.
pub(crate) const MOST_ACROSS: usize = 60;
/// Significant digits of a value in a picture.
const DIGITS: usize = 4;

/// One direction of a picture: its cells, and where each begins and ends.
pub(crate) struct Cells {
    pub groups: Vec<Range<usize>>,
    /// Where the cells begin, and where the last ends.
    pub edges: Vec<f64>,
}

impl Cells {
    /// The ascending `places` in at most `most` (≥ 1) cells; each place reaches halfway to its neighbours.
    pub(crate) fn new(places: &[f64], most: usize) -> Self {
        let count = places.len();
        let cells = count.min(most);
        let groups: Vec<_> = (0..cells).map(|cell| cell * count / cells..(cell + 1) * count / cells).collect();
        let starts = groups.iter().map(|group| Self::start_of(places, group.start));
        let edges = if cells == 0 { Vec::new() } else { starts.chain([Self::start_of(places, count)]).collect() };
        Self { groups, edges }
    }

    /// Where the place `index` begins; beyond the last place, where that ends.
    fn start_of(places: &[f64], index: usize) -> f64 {
        match (index.checked_sub(1).and_then(|before| places.get(before)), places.get(index)) {
            (Some(before), Some(at)) => before.midpoint(*at),
            (None, Some(first)) => first - 0.5 * places.get(1).map_or(0.0, |second| second - first),
            (before, None) => {
                let last = before.copied().unwrap_or_default();
                last + 0.5 * places.len().checked_sub(2).map_or(0.0, |second| last - places[second])
            }
        }
    }

    /// Slices over the face width `face_width_mm`, from their middles.
    fn over_width(middles_mm: &[f64], face_width_mm: f64) -> Self {
        let mut cells = Self::new(middles_mm, MOST_ACROSS);
        if let [first, .., last] = cells.edges.as_mut_slice() {
            (*first, *last) = (0.0, face_width_mm);
        }
        cells
    }

    pub(crate) fn middles(&self) -> Vec<f64> {
        self.edges.windows(2).map(|edge| edge[0].midpoint(edge[1])).collect()
    }
}

/// A picture of something given slice by slice.
pub(crate) struct SlicedRaster {
    /// From root to tip, from tip to root of an internal gear, or along the path.
    pub along: Cells,
    pub across: Cells,
}

impl SlicedRaster {
    /// Of the active part of `flank`.
    pub(crate) fn of_flank(flank: &FlankRecord, face_width_mm: f64) -> Self {
        let first = ActiveFlank::of(flank).first.min(flank.radius_mm.len());
        let mut along = Cells::new(&flank.radius_mm[first..], MOST_ALONG);
        for group in &mut along.groups {
            *group = group.start + first..group.end + first;
        }
        if flank.is_internal() {
            // Pictures have rising radii.
            along.groups.reverse();
            along.edges.reverse();
        }
        Self { along, across: Cells::over_width(&flank.width_mm, face_width_mm) }
    }

    /// Of `position_mm` along the path and the slices at `width_mm`.
    pub(crate) fn of_path(position_mm: &[f64], width_mm: &[f64], face_width_mm: f64) -> Self {
        Self { along: Cells::new(position_mm, MOST_ALONG), across: Cells::over_width(width_mm, face_width_mm) }
    }

    /// The cells' values, `at` (along, slice): for each cell along, those over the face width.
    pub(crate) fn rows(&self, at: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
        let cell = |along: &Range<usize>, across: &Range<usize>| {
            let all = along.clone().flat_map(|i| across.clone().map(move |slice| (i, slice)));
            to_digits(all.map(|(i, slice)| at(i, slice)).fold(f64::NEG_INFINITY, f64::max), DIGITS)
        };
        self.along
            .groups
            .iter()
            .map(|along| self.across.groups.iter().map(|across| cell(along, across)).collect())
            .collect()
    }

    /// The same for each cell over the face width: those along.
    pub(crate) fn columns(&self, at: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
        let rows = self.rows(at);
        (0..self.across.groups.len()).map(|slice| rows.iter().map(|row| row[slice]).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_places_have_a_cell_each() {
        let cells = Cells::new(&[1.0, 2.0, 4.0], 10);
        assert_eq!((cells.groups, cells.edges), (vec![0..1, 1..2, 2..3], vec![0.5, 1.5, 3.0, 5.0]));
        assert!(Cells::new(&[], 10).edges.is_empty());
    }

    /// Every place is in one cell, and none is empty.
    #[test]
    fn many_places_share_cells() {
        let places: Vec<f64> = (0..751).map(f64::from).collect();
        let cells = Cells::new(&places, 200);
        assert_eq!((cells.groups.len(), cells.edges.len()), (200, 201));
        assert!(cells.groups.windows(2).all(|pair| pair[0].end == pair[1].start && !pair[0].is_empty()));
        assert_eq!((cells.groups[0].start, cells.groups[199].end), (0, 751));
    }

    /// A peak at one of many points shows, whatever is put together.
    #[test]
    fn peaks_survive() {
        let position: Vec<f64> = (0..1000).map(f64::from).collect();
        let raster = SlicedRaster::of_path(&position, &[0.5, 1.5], 2.0);
        let rows = raster.rows(|i, slice| if (i, slice) == (373, 1) { 7.0 } else { 0.0 });
        assert_eq!(rows.iter().flatten().filter(|&&value| value == 7.0).count(), 1);
        let columns = raster.columns(|i, slice| if (i, slice) == (373, 1) { 7.0 } else { 0.0 });
        assert_eq!((columns[0].iter().sum::<f64>(), columns[1].iter().sum::<f64>()), (0.0, 7.0));
        assert_eq!(raster.across.edges, [0.0, 1.0, 2.0]);
    }
}
