//! Least value of a figure over a sweep, and how far it is one: on the end of a range a wider one may have less, and within the error its neighbours
//! are as good.
//!
//! Neighbours differ by one step of one key. With the relative error e of the least value y one with z is as good where z (1 − e) ≤ y (1 + e).

use super::record::{SweepAxis, SweepRecord, SweepRow};
use crate::evaluate::figure::StudyFigure;
use crate::scene::key::{NumberKey, linked_keys};

/// Least value of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum<'a> {
    pub row: &'a SweepRow,
    pub value: f64,
    /// Keys on an end of their range beyond which there are further values.
    pub on_edge: Vec<&'a str>,
    /// Neighbours with a value.
    pub neighbours: usize,
    /// Of these those that are as good within the error; `None` where no verified combination states one.
    pub as_good: Option<usize>,
}

impl SweepRecord {
    /// Least value of `figure`; `None` where no combination has it.
    pub fn minimum(&self, figure: &StudyFigure) -> Option<Minimum<'_>> {
        let (row, value) = self.least(figure)?;
        let identity = &self.identity;
        let digits = identity.digits(row.index);
        let ends = identity.axes.iter().zip(&digits).filter(|(axis, digit)| is_edge(axis, **digit));
        let on_edge = ends.map(|(axis, _)| axis.key.as_str()).collect();
        let value_at = |index: usize| {
            let place = self.rows.binary_search_by_key(&index, |row| row.index).ok()?;
            self.rows[place].figure(figure)
        };
        let mut step = identity.combinations();
        let mut beside = Vec::new();
        for (axis, digit) in identity.axes.iter().zip(&digits) {
            step /= axis.count;
            beside.extend((*digit > 0).then(|| row.index - step));
            beside.extend((digit + 1 < axis.count).then(|| row.index + step));
        }
        let others: Vec<f64> = beside.into_iter().filter_map(value_at).collect();
        let errors = self.rows.iter().filter_map(|row| figure.error(&row.verification.as_ref()?.total));
        let as_good = errors
            .reduce(f64::max)
            .map(|e| others.iter().filter(|other| **other * (1.0 - e) <= value * (1.0 + e)).count());
        Some(Minimum { row, value, on_edge, neighbours: others.len(), as_good })
    }
}

/// Whether a value is the first or the last of its range, beyond which the key allows others.
fn is_edge(axis: &SweepAxis, digit: usize) -> bool {
    let step = (axis.to - axis.from) / (axis.count.max(2) - 1) as f64;
    let beyond = match digit {
        _ if axis.words().is_some() || axis.count < 2 => return false,
        0 => axis.from - step,
        last if last + 1 == axis.count => axis.to + step,
        _ => return false,
    };
    let allows = |key: &String| NumberKey::find(key).is_ok_and(|key| key.holds(beyond));
    linked_keys(&axis.key).iter().all(allows)
}

impl Minimum<'_> {
    /// Remark in words; empty where there is none.
    pub fn remark(&self) -> String {
        let edge = (!self.on_edge.is_empty()).then(|| format!("on the end of {}", self.on_edge.join(" and ")));
        let as_good = self
            .as_good
            .filter(|count| *count > 0)
            .map(|count| format!("{count} of {} neighbours as good within the error", self.neighbours));
        edge.into_iter().chain(as_good).collect::<Vec<_>>().join("; ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::figure;
    use crate::scene::opened::{EachMesh, SceneKind};
    use crate::sweep::record::{AxisSpacing, SweepIdentity};
    use crate::sweep::verification::{Chosen, RowVerification};
    use gearwear_physics::results::error::TotalError;

    /// Two keys of three values; the wear of each combination.
    fn record(wear: [f64; 9], error: Option<f64>) -> SweepRecord {
        let axis = |key: &str, from: f64| SweepAxis {
            key: key.to_owned(),
            from,
            to: from + 2.0,
            count: 3,
            whole: false,
            spacing: AxisSpacing::Even,
        };
        let axes = vec![axis("pair.pinion.tip_relief.amount_um", 0.0), axis("pair.face_width_mm", 10.0)];
        let identity = SweepIdentity { axes, ..SweepIdentity::default() };
        let rows = wear.into_iter().enumerate().map(|(index, wear)| {
            let mut total = TotalError::none("");
            total.peak_wear.pinion = error;
            SweepRow {
                index,
                values: identity.values(index),
                figures: vec![Some(wear); figure::in_sweeps(SceneKind::Pair).len()],
                verification: error.map(|_| RowVerification {
                    chosen: Chosen::default(),
                    total: EachMesh::Pair(total),
                    wall_s: 0.0,
                }),
                ..SweepRow::default()
            }
        });
        let rows = rows.collect();
        SweepRecord { identity, shard: None, scene_toml: String::new(), rows, threads: 1, wall_s: 0.0 }
    }

    /// A relief of nothing is no end that could be passed, a face width is.
    #[test]
    fn ver_ends_and_neighbours_of_a_minimum() {
        let figure = figure::find(SceneKind::Pair, "pinion.peak_wear_um").unwrap();
        let inside = record([9.0, 8.0, 9.0, 7.0, 5.0, 7.0, 9.0, 5.1, 9.0], Some(0.02));
        let found = inside.minimum(figure).unwrap();
        assert_eq!((found.row.index, found.neighbours, found.as_good), (4, 4, Some(1)));
        assert_eq!(found.remark(), "1 of 4 neighbours as good within the error");
        let corner = record([9.0, 8.0, 1.0, 7.0, 5.0, 7.0, 9.0, 5.0, 9.0], None);
        let found = corner.minimum(figure).unwrap();
        assert_eq!((found.row.index, found.neighbours, found.as_good), (2, 2, None));
        assert_eq!(found.remark(), "on the end of pair.face_width_mm");
    }
}
