//! Time: coefficients and mates against duration, phases cut in two, speeds that nothing reads.

use toml::Value;

use super::ROUNDING;
use crate::invariants::comparison::{Bounds, Follows, Measured, compare, summaries};
use crate::invariants::relation::{RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{gives, phases, scaled, value, with};
use crate::invariants::traits_of_scene::{has_fixed_steps, has_heat_or_oil, is_hard_severe, takes_stable_steps};

const FASTER: f64 = 3.7;
const MATES: i64 = 3;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "coefficient and duration",
        states: "Wear coefficients times c and the duration over c: the same wear.",
        bound: "rounding, in steps of the same number",
        is_rare: false,
        check: faster,
    },
    SceneRelation {
        name: "mates and duration",
        states: "Each gear with three mates and the duration over three: the same wear.",
        bound: "rounding, in steps of the same number",
        is_rare: false,
        check: mates,
    },
    SceneRelation {
        name: "phases cut in two",
        states: "The last phase cut into two halves of the same load, at the end of a step: the same wear.",
        bound: "each phase begins with contact windows of its own, and a window that has grown has other cells: 0.2 % of the volume, 2 % of the wear \
                and 20 % of the pressure at a point, 1 % of the transmission error",
        is_rare: false,
        check: cut_in_two,
    },
    SceneRelation {
        name: "speed that nothing reads",
        states: "Without heat and oil, a run over given revolutions does not depend on the speed.",
        bound: "none: the same bits",
        is_rare: false,
        check: speed,
    },
];

fn faster(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !has_fixed_steps(table) || is_hard_severe(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| match key {
        "coefficient_m2_per_N" | "coefficient_mm3_per_Nm" => FASTER,
        "pinion_revolutions" | "revolutions" | "snapshots_revolutions" => 1.0 / FASTER,
        _ => 1.0,
    });
    subject.beside(other, |record| compare(subject.record, record, &Follows::default(), Bounds::all(1e2 * ROUNDING)))
}

fn mates(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    // Mates warm the teeth that they run on.
    let is_warm = gives(table, "temperature.tooth");
    if is_warm || !has_fixed_steps(table) || is_hard_severe(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let mut other = scaled(table, &|key| match key {
        "pinion_revolutions" | "revolutions" | "snapshots_revolutions" => 1.0 / MATES as f64,
        _ => 1.0,
    });
    for gear in ["pinion", "wheel"] {
        other = with(&other, &format!("operation.meshes_per_revolution.{gear}"), MATES);
    }
    subject.beside(other, |record| compare(subject.record, record, &Follows::default(), Bounds::all(1e2 * ROUNDING)))
}

fn cut_in_two(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !has_fixed_steps(table) || is_hard_severe(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let mut all = match phases(table) {
        Some(phases) => phases.clone(),
        None => {
            let duration = value(table, "operation.pinion_revolutions").cloned();
            let phase = duration.map(|duration| toml::Table::from_iter([("pinion_revolutions".to_owned(), duration)]));
            phase.map(Value::Table).into_iter().collect()
        }
    };
    let Some(Value::Table(mut last)) = all.pop() else { return RelationOutcome::NotOfThisScene };
    let Some(duration) = last.get("pinion_revolutions").and_then(Value::as_float) else {
        return RelationOutcome::NotOfThisScene;
    };
    last.insert("pinion_revolutions".to_owned(), Value::Float(0.5 * duration));
    all.extend([Value::Table(last.clone()), Value::Table(last)]);
    let other = with(table, "operation.phases", Value::Array(all));
    let bounds = Bounds { wear: 0.02, volume: 2e-3, pressure: 0.2, cycle: 0.01, ..Bounds::all(0.0) };
    subject.beside(other, |record| compare(subject.record, record, &Follows::default(), bounds))
}

fn speed(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if has_heat_or_oil(table) {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| if key == "pinion_speed_rpm" { 2.3 } else { 1.0 });
    subject.beside(other, |record| {
        let besides = ["hours", "phases"];
        let (value, path) = summaries(&subject.record.summary, &record.summary, &besides);
        let mut found = compare(subject.record, record, &Follows::default(), Bounds::all(f64::MIN_POSITIVE));
        found.push(Measured::new(format!("summary, {path}"), value, f64::MIN_POSITIVE));
        found
    })
}
