//! Inequalities: the sign of the effect of more load, more removed material or a longer duration.

use toml::Table;

use crate::invariants::comparison::{Bounds, Follows, Measured, compare};
use crate::invariants::relation::{POINTS, POSITIONS, RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{gives, number, scaled, value, with};
use crate::invariants::traits_of_scene::{
    has_fixed_steps, is_hard_severe, is_sliced, takes_stable_steps, touches_beyond_range,
};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::RunRecord;

use super::SOLVED;

/// Relative effect of the cells of contact windows on the transmission error.
const OF_CELLS: f64 = 2e-3;
/// Relative change of a torque that leaves only its last bits in doubt, which depend on the order of operations.
const LAST_BITS: f64 = 1.0 + 1e-12;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "last bits",
        states: "The last bits of the torque change no figure: every figure is a continuous function of the load.",
        bound: "1e-6 of the greatest value, a million times the change",
        is_rare: false,
        check: last_bits,
    },
    SceneRelation {
        name: "more load, more approach",
        states: "A tenth more torque raises the transmission error of the new pair at every position.",
        bound: "0.2 % of the greatest: gaps with the kink of a relief or a rounding are sampled at other cells of a contact's window",
        is_rare: false,
        check: more_load,
    },
    SceneRelation {
        name: "relief opens the gap",
        states: "Material removed at the tips raises the transmission error of the new pair, or leaves it, at every position.",
        bound: "0.2 % of the greatest: gaps with the kink of a relief or a rounding are sampled at other cells of a contact's window; where flank points or the \
                positions between which rows of finite elements lie are too few, four or sixteen times as many",
        is_rare: false,
        check: relief_opens,
    },
    SceneRelation {
        name: "longer is deeper",
        states: "Half of the duration wears no point deeper than the whole.",
        bound: "rounding",
        is_rare: false,
        check: longer,
    },
];

fn last_bits(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if is_hard_severe(table) || !has_fixed_steps(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| if key == "pinion_torque_Nm" { LAST_BITS } else { 1.0 });
    subject.beside(other, |record| compare(subject.record, record, &Follows::default(), Bounds::all(SOLVED)))
}

/// Greatest decrease of the transmission error of the new pair at a position, over its greatest value.
fn less_error(first: &RunRecord, other: &RunRecord) -> Vec<Measured> {
    let [mine, theirs] = [first, other].map(|of| of.mesh_cycle.iter().map(|row| row.transmission_error_new_um));
    let greatest = mine.clone().map(f64::abs).fold(0.0, f64::max);
    let less = mine.zip(theirs).map(|(a, b)| (a - b) / greatest);
    vec![Measured::new("new transmission error", less.fold(0.0, f64::max), OF_CELLS)]
}

fn more_load(subject: &Subject<'_>) -> RelationOutcome {
    // Loads jump at the end of the range of tip edges, which grows with the load.
    if touches_beyond_range(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(subject.table, &|key| if key == "pinion_torque_Nm" { 1.1 } else { 1.0 });
    subject.beside(other, |record| less_error(subject.record, record))
}

fn relief_opens(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    let (Some(width), false) = (number(table, "pair.face_width_mm"), is_sliced(table)) else {
        return RelationOutcome::NotOfThisScene;
    };
    subject.refined(&[POINTS, POSITIONS], |table| relieved(table, width), less_error)
}

/// The scene with more tip relief, or some where it has none, for a face width in mm.
fn relieved(table: &Table, width: f64) -> Table {
    let mut other = table.clone();
    for gear in Gear::BOTH {
        let [amount, length] = ["amount_um", "length_mm"].map(|key| format!("pair.{}.tip_relief.{key}", gear.name()));
        if gives(table, &amount) {
            other = with(&other, &amount, 1.5 * number(table, &amount).unwrap_or_default());
        } else {
            other = with(&other, &amount, 0.5 * width);
            other = with(&other, &length, 0.05 * width);
        }
    }
    other
}

fn longer(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if value(table, "operation.phases").is_some() || !has_fixed_steps(table) {
        return RelationOutcome::NotOfThisScene;
    }
    let Some(revolutions) = number(table, "operation.pinion_revolutions") else {
        return RelationOutcome::NotOfThisScene;
    };
    let other = with(table, "operation.pinion_revolutions", 0.5 * revolutions);
    let other = with(&other, "operation.snapshots_revolutions", vec![0.5 * revolutions]);
    subject.beside(other, |record| {
        let of_gears = Gear::BOTH.map(|gear| {
            let (whole, half) = (&subject.record.flanks[gear].wear_um, &record.flanks[gear].wear_um);
            let greatest = whole.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            let deeper = whole.iter().zip(half).map(|(whole, half)| (half - whole) / greatest).fold(0.0, f64::max);
            Measured::new(format!("wear of the {}", gear.name()), deeper, 1e-9)
        });
        of_gears.into()
    })
}
