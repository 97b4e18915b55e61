//! Combinations of a plot: along one key or over two, with the other keys at their best.

use crate::evaluate::figure::StudyFigure;
use crate::sweep::record::{SweepAxis, SweepRecord, SweepRow};

/// Greatest number of values of a key in a plot: more exceed the pixels of a screen.
const MOST_SHOWN: usize = 200;

/// A varied key of a plot.
pub(super) struct ShownAxis<'a> {
    pub at: usize,
    pub axis: &'a SweepAxis,
    pub shown: Vec<usize>,
}

impl ShownAxis<'_> {
    pub(super) fn values(&self) -> Vec<f64> {
        self.shown.iter().map(|&index| self.axis.value(index)).collect()
    }
}

/// The axes that have more than one value.
pub(super) fn varied(record: &SweepRecord) -> Vec<ShownAxis<'_>> {
    let axes = record.identity.axes.iter().enumerate().filter(|(_, axis)| axis.count > 1);
    axes.map(|(at, axis)| ShownAxis { at, axis, shown: thinned(axis.count) }).collect()
}

/// Indices of at most [`MOST_SHOWN`] of `count` values, evenly spread, both ends included.
fn thinned(count: usize) -> Vec<usize> {
    let shown = count.min(MOST_SHOWN);
    (0..shown).map(|i| i * (count - 1) / (shown - 1).max(1)).collect()
}

/// The row of the combination that has these values on the shown axes and those of `others` everywhere else.
pub(super) fn row<'a>(
    record: &'a SweepRecord,
    others: &SweepRow,
    shown: &[(&ShownAxis<'_>, usize)],
) -> Option<&'a SweepRow> {
    let mut digits = record.identity.digits(others.index);
    for (axis, value) in shown {
        digits[axis.at] = *value;
    }
    let index = record.identity.axes.iter().zip(digits).fold(0, |index, (axis, digit)| index * axis.count + digit);
    // Rows stand in the order of the combinations, and none is missing in a whole sweep.
    record.rows.get(index).filter(|row| row.index == index)
}

/// Least and greatest value of a figure; `None` where no row has it.
pub(super) fn range(record: &SweepRecord, figure: &StudyFigure) -> Option<(f64, f64)> {
    let values = record.rows.iter().filter_map(|row| row.figure(figure));
    values.fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((value.min(low), value.max(high))),
    })
}

/// Whether a figure differs between combinations by more than rounding.
pub(super) fn differs(record: &SweepRecord, figure: &StudyFigure) -> bool {
    range(record, figure).is_some_and(|(low, high)| high - low > 1e-9 * high.abs().max(low.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_values_are_thinned_evenly() {
        assert_eq!(thinned(3), [0, 1, 2]);
        assert_eq!(thinned(1), [0]);
        let many = thinned(1999);
        assert_eq!((many.len(), many[0], many[MOST_SHOWN - 1]), (MOST_SHOWN, 0, 1998));
        assert!(many.windows(2).all(|pair| [10, 11].contains(&(pair[1] - pair[0]))));
    }
}
