//! Two runs beside each other, figure by figure, where one follows from the other.

use serde::Serialize;
use serde_json::Value;

use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::linear_means::value_at;
use gearwear_physics::results::run::{FlankRecord, MeshCycleRow, RunRecord, Summary};

/// A difference with what is allowed.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Name of the figure compared.
    pub figure: String,
    /// Difference, relative to the greatest value of the figure.
    pub value: f64,
    pub bound: f64,
}

impl Measured {
    pub(super) fn new(figure: impl Into<String>, value: f64, bound: f64) -> Self {
        Self { figure: figure.into(), value, bound }
    }

    /// Difference over its bound; infinite where it is not a number.
    pub(super) fn used(&self) -> f64 {
        if self.value.is_nan() { f64::INFINITY } else { self.value / self.bound }
    }
}

/// How the figures of the other run follow from those of the first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Follows {
    /// Wear depth of the other run over that of the first, of each gear of the first.
    pub depth: PerGear<f64>,
    /// Pressure.
    pub pressure: f64,
    /// Transmission error.
    pub error: f64,
    /// Worn volume over the depth's.
    pub area: f64,
    /// The gears have changed places, and the mesh runs from E to A.
    pub exchanged: bool,
    /// Whether values at a position of one run may be at another in the other run, at most one transmission error away.
    pub lags: bool,
    /// The face width runs the other way.
    pub mirrored: bool,
}

impl Follows {
    /// A column of the other run's points in the order of the flank `mine`.
    fn ordered(&self, mine: &FlankRecord, column: &[f64]) -> Vec<f64> {
        if self.mirrored { mirrored(column, mine.width_mm.len()) } else { column.to_vec() }
    }
}

impl Default for Follows {
    fn default() -> Self {
        let depth = PerGear { pinion: 1.0, wheel: 1.0 };
        Self { depth, pressure: 1.0, error: 1.0, area: 1.0, exchanged: false, lags: false, mirrored: false }
    }
}

/// Bounds of relative differences.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    /// Of wear depth at any point.
    pub wear: f64,
    /// Of worn volume.
    pub volume: f64,
    /// Of the pressure at any point.
    pub pressure: f64,
    /// Of transmission error and load share at any position.
    pub cycle: f64,
    /// Least bound of worn figures, where both runs take the same number of adaptive steps, whose lengths differ.
    pub least_of_worn: f64,
    /// Tolerance of adaptive steps on the depth at any point, µm, where the two runs may take other steps.
    pub tolerance_um: Option<f64>,
}

impl Bounds {
    pub(super) const fn all(bound: f64) -> Self {
        Self { wear: bound, volume: bound, pressure: bound, cycle: bound, least_of_worn: 0.0, tolerance_um: None }
    }

    /// Bounds on worn figures, beside `record`. The tolerance of adaptive steps opens the gap of both flanks and so moves the
    /// transmission error, and the load shares by as much of themselves; it bounds no pressure at a point where contact begins.
    fn of_worn(self, record: &RunRecord) -> Self {
        let Some(tolerance_um) = self.tolerance_um else {
            let Self { wear, volume, pressure, cycle, .. } = self;
            let [wear, volume, pressure, cycle] =
                [wear, volume, pressure, cycle].map(|bound| bound.max(self.least_of_worn));
            return Self { wear, volume, pressure, cycle, ..self };
        };
        let mut bounds = Self { pressure: f64::INFINITY, ..self };
        for gear in Gear::BOTH {
            let wear_um = &record.flanks[gear].wear_um;
            let greatest = wear_um.iter().copied().fold(0.0, f64::max);
            let mean = wear_um.iter().sum::<f64>() / wear_um.len() as f64;
            bounds.wear = bounds.wear.max(share_of(tolerance_um, greatest));
            bounds.volume = bounds.volume.max(share_of(tolerance_um, mean));
        }
        let error = record.mesh_cycle.iter().map(|row| row.transmission_error_worn_um.abs()).fold(0.0, f64::max);
        bounds.cycle = bounds.cycle.max(2.0 * share_of(tolerance_um, error));
        bounds
    }
}

/// `part` over `whole`; 0 where there is no whole.
fn share_of(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// All figures that two runs have in common.
pub(super) fn compare(first: &RunRecord, other: &RunRecord, follows: &Follows, bounds: Bounds) -> Vec<Measured> {
    let mut found = compare_new(first, other, follows, bounds);
    let of_worn = bounds.of_worn(first);
    for gear in Gear::BOTH {
        let theirs = if follows.exchanged { gear.mate() } else { gear };
        let (mine, other_flank) = (&first.flanks[gear], &other.flanks[theirs]);
        let (name, depth) = (gear.name(), follows.depth[gear]);
        let wear = difference(&mine.wear_um, &follows.ordered(mine, &other_flank.wear_um), depth);
        found.push(Measured::new(format!("wear of the {name}"), wear, of_worn.wear));
        let pressure_mpa = follows.ordered(mine, &other_flank.pressure_worn_MPa);
        let worn = difference(&mine.pressure_worn_MPa, &pressure_mpa, follows.pressure);
        found.push(Measured::new(format!("pressure on the worn {name}"), worn, of_worn.pressure));
        let [mine, others] = [(first, gear), (other, theirs)].map(|(of, gear)| worn_volume_mm3(&of.summary, gear));
        let volumes = difference(&[mine], &[others], depth * follows.area);
        found.push(Measured::new(format!("worn volume of the {name}"), volumes, of_worn.volume));
    }
    let error: ColumnOfCycle = |row| row.transmission_error_worn_um;
    found.extend(cycles(first, other, follows, ("worn", error, |row| row.load_share_worn), of_worn.cycle));
    found
}

pub(super) fn worn_volume_mm3(summary: &Summary, gear: Gear) -> f64 {
    match gear {
        Gear::Pinion => summary.pinion.worn_volume_mm3,
        Gear::Wheel => summary.wheel.worn_volume_mm3,
    }
}

/// Figures of the new pair, which depend on no wear step.
pub(super) fn compare_new(first: &RunRecord, other: &RunRecord, follows: &Follows, bounds: Bounds) -> Vec<Measured> {
    let pressures = Gear::BOTH.map(|gear| {
        let theirs = if follows.exchanged { gear.mate() } else { gear };
        let mine = &first.flanks[gear];
        let pressure_mpa = follows.ordered(mine, &other.flanks[theirs].pressure_new_MPa);
        let new = difference(&mine.pressure_new_MPa, &pressure_mpa, follows.pressure);
        Measured::new(format!("pressure on the new {}", gear.name()), new, bounds.pressure)
    });
    let error: ColumnOfCycle = |row| row.transmission_error_new_um;
    let cycles = cycles(first, other, follows, ("new", error, |row| row.load_share_new), bounds.cycle);
    pressures.into_iter().chain(cycles).collect()
}

/// A column of the mesh cycle.
type ColumnOfCycle = fn(&MeshCycleRow) -> f64;

/// Transmission error and load share of the mesh, new or worn.
fn cycles(
    first: &RunRecord,
    other: &RunRecord,
    follows: &Follows,
    (state, error, share): (&str, ColumnOfCycle, ColumnOfCycle),
    bound: f64,
) -> [Measured; 2] {
    let position_mm: Vec<f64> = first.mesh_cycle.iter().map(|row| row.position_mm).collect();
    let errors =
        first.mesh_cycle.iter().flat_map(|row| [row.transmission_error_new_um, row.transmission_error_worn_um]);
    let lag_mm = 1e-3 * errors.map(f64::abs).fold(0.0, f64::max);
    // The transmission error repeats itself with every tooth.
    let pitch_mm = Some(first.summary.geometry.base_pitch_mm);
    let columns: [(&str, f64, ColumnOfCycle, Option<f64>); 2] =
        [("transmission error", follows.error, error, pitch_mm), ("load share", 1.0, share, None)];
    columns.map(|(name, factor, of, period_mm)| {
        let mine: Vec<f64> = first.mesh_cycle.iter().map(of).collect();
        let mut theirs: Vec<f64> = other.mesh_cycle.iter().map(of).collect();
        if follows.exchanged {
            theirs.reverse();
        }
        if follows.lags && mine.len() == theirs.len() {
            let around = repeated(&position_mm, &mine, period_mm);
            theirs = nearest(&position_mm, lag_mm, (&mine, &around), factor, &theirs);
        }
        Measured::new(format!("{state} {name}"), difference(&mine, &theirs, factor), bound)
    })
}

/// Positions with the values of a column there.
type Course = (Vec<f64>, Vec<f64>);

/// A column with its period before the first and after the last position, if it has one.
fn repeated(position_mm: &[f64], column: &[f64], period_mm: Option<f64>) -> Course {
    let own = position_mm.iter().copied().zip(column.iter().copied());
    let (Some(period_mm), Some(&first), Some(&last)) = (period_mm, position_mm.first(), position_mm.last()) else {
        return own.unzip();
    };
    let before = own.clone().map(|(at, value)| (at - period_mm, value)).filter(|(at, _)| *at < first);
    let after = own.clone().map(|(at, value)| (at + period_mm, value)).filter(|(at, _)| *at > last);
    before.chain(own).chain(after).unzip()
}

/// For each position, the value of `mine` times `factor` plus the remaining difference to `theirs`, where `theirs` may be any value of the course
/// `around` within `lag_mm`; `None` where that reaches beyond the course.
fn nearest(
    position_mm: &[f64],
    lag_mm: f64,
    (mine, around): (&[f64], &Course),
    factor: f64,
    theirs: &[f64],
) -> Vec<f64> {
    let (places_mm, values) = around;
    let (Some(&first), Some(&last)) = (places_mm.first(), places_mm.last()) else { return theirs.to_vec() };
    let left = position_mm.iter().zip(mine).zip(theirs).map(|((&at, &own), &their)| {
        if at - lag_mm < first || at + lag_mm > last {
            return factor * own;
        }
        let between = places_mm.iter().zip(values).filter(|(place, _)| (*place - at).abs() < lag_mm);
        let ends = [at - lag_mm, at + lag_mm].map(|end| value_at(places_mm, values, end));
        let within = between.map(|(_, &value)| value).chain(ends).map(|value| factor * value);
        let (least, most) = within.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        factor * own + their - their.max(least).min(most)
    });
    left.collect()
}

/// Greatest |theirs − factor · mine| over the greatest of both; infinite where the lengths differ.
pub(super) fn difference(mine: &[f64], theirs: &[f64], factor: f64) -> f64 {
    if mine.len() != theirs.len() {
        return f64::INFINITY;
    }
    let pairs = mine.iter().map(|x| factor * x).zip(theirs);
    let greatest = pairs.clone().map(|(x, y)| x.abs().max(y.abs())).fold(0.0, f64::max);
    let apart = pairs
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, |most, next| if next.is_nan() { next } else { f64::max(most, next) });
    if greatest > 0.0 { apart / greatest } else { apart }
}

/// Column with its slices in reverse order.
fn mirrored(column: &[f64], slices: usize) -> Vec<f64> {
    let points = (column.len() / slices.max(1)).max(1);
    column.chunks(points).rev().flatten().copied().collect()
}

/// Greatest relative difference of the numbers of two summaries, with its path. Times, hashes, work counts and paths that begin with one of `besides`
/// are left out; differing texts and numbers that one summary lacks count as infinite.
pub(super) fn summaries(first: &impl Serialize, other: &impl Serialize, besides: &[&str]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    if let (Ok(first), Ok(other)) = (serde_json::to_value(first), serde_json::to_value(other)) {
        walk(&first, &other, "", besides, &mut worst);
    }
    worst
}

/// Figures that are relative differences themselves: where runs are alike they are rounding.
const RELATIVE: [&str; 5] =
    ["load_imbalance", "split_remainder_at_half_load", "variation", "asymmetry", "asymmetry_first_mesh"];

/// Figures that differ between runs that are alike.
const NOT_COMPARED: [&str; 10] =
    ["stages", "wall_s", "scene_hash", "title", "work", "warnings", "left_out", "report", "invariants", "error"];

fn walk(first: &Value, other: &Value, path: &str, besides: &[&str], worst: &mut (f64, String)) {
    if NOT_COMPARED.contains(&path) || besides.iter().any(|besides| path.starts_with(besides)) {
        return;
    }
    match (first, other) {
        (Value::Object(mine), Value::Object(theirs)) => {
            for (name, value) in mine {
                let below = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                walk(value, theirs.get(name).unwrap_or(&Value::Null), &below, besides, worst);
            }
        }
        (Value::Array(mine), Value::Array(theirs)) if mine.len() == theirs.len() => {
            let greatest = mine.iter().chain(theirs).filter_map(Value::as_f64).map(f64::abs).reduce(f64::max);
            for (index, (mine, theirs)) in mine.iter().zip(theirs).enumerate() {
                let path = format!("{path}.{}", index + 1);
                match (mine.as_f64(), theirs.as_f64(), greatest) {
                    // Numbers of a row have the same unit: differences are relative to the greatest of them.
                    (Some(mine), Some(theirs), Some(greatest)) if mine != theirs => {
                        note((mine - theirs).abs() / greatest, &path, worst);
                    }
                    _ => walk(mine, theirs, &path, besides, worst),
                }
            }
        }
        (Value::Number(mine), Value::Number(theirs)) => {
            let [mine, theirs] = [mine, theirs].map(|number| number.as_f64().unwrap_or(f64::NAN));
            let apart = match RELATIVE.iter().any(|relative| path.ends_with(relative)) {
                true => (mine - theirs).abs(),
                false => difference(&[mine], &[theirs], 1.0),
            };
            note(apart, path, worst);
        }
        (mine, theirs) if mine == theirs => {}
        _ => *worst = (f64::INFINITY, path.to_owned()),
    }
}

/// Keeps the worst difference with its path.
fn note(apart: f64, path: &str, worst: &mut (f64, String)) {
    if apart.is_nan() || apart > worst.0 {
        *worst = (apart, path.to_owned());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_relative_to_the_greatest_value() {
        assert_eq!(difference(&[1.0, 4.0], &[2.0, 8.0], 2.0), 0.0);
        assert_eq!(difference(&[1.0, 4.0], &[2.0, 4.0], 1.0), 0.25);
        assert_eq!(difference(&[0.0], &[0.0], 1.0), 0.0);
        assert!(difference(&[1.0], &[f64::NAN], 1.0).is_nan());
        assert_eq!(difference(&[1.0], &[], 1.0), f64::INFINITY);
        assert_eq!(mirrored(&[1.0, 2.0, 3.0, 4.0], 2), [3.0, 4.0, 1.0, 2.0]);
    }

    #[test]
    fn what_lags_is_held_against_what_is_near() {
        // Within 0.5 mm of each position the column takes 0…0.5, 0.5…2, 2…3 and 3.
        let (position_mm, mine) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 3.0, 3.0]);
        // A period of 2.5 has 0 half a millimetre after 2, and 3 half a millimetre before 0: between these and the ends are 0…1.5 and 1.5…3.
        assert_eq!(repeated(&position_mm, &mine, Some(2.5)).0, [-2.5, -1.5, -0.5, 0.0, 1.0, 2.0, 3.0, 3.5, 4.5, 5.5]);
        for (period_mm, theirs, left) in [
            (None, [0.5, 0.5, 2.0, 3.0], [0.0, 1.0, 3.0, 3.0]),
            // Beyond both ends the column is not known.
            (None, [1.0, 2.5, 1.0, 3.5], [0.0, 1.5, 2.0, 3.0]),
            (Some(2.5), [1.0, 0.5, 2.0, 1.0], [0.0, 1.0, 3.0, 3.0]),
            (Some(2.5), [3.5, 2.5, 1.0, 0.5], [0.5, 1.5, 2.0, 2.5]),
        ] {
            let around = repeated(&position_mm, &mine, period_mm);
            assert_eq!(nearest(&position_mm, 0.5, (&mine, &around), 1.0, &theirs), left);
        }
    }

    #[test]
    fn summaries_are_compared_number_by_number() {
        let first = serde_json::json!({ "a": { "b": [1.0, 2.0], "c": null }, "wall_s": 3.0 });
        let other = serde_json::json!({ "a": { "b": [1.0, 2.5], "c": null }, "wall_s": 4.0 });
        assert_eq!(summaries(&first, &other, &[]), (0.2, "a.b.2".to_owned()));
        assert_eq!(summaries(&first, &other, &["a.b"]).0, 0.0);
        let [first, other] = [1.0, 2.0].map(|least| serde_json::json!({ "mesh_orders_um": [1e-6 * least, 2.0] }));
        assert_eq!(summaries(&first, &other, &[]), (5e-7, "mesh_orders_um.1".to_owned()));
        let [first, other] = [1e-16, -1e-16].map(|rounding| serde_json::json!({ "root_asymmetry": rounding }));
        assert_eq!(summaries(&first, &other, &[]).0, 2e-16);
    }
}
