//! Keys at values that must change nothing, and keys that say the same in two ways.

use toml::{Table, Value};

use super::ROUNDING;
use super::resolution::volumes_and_error;
use crate::invariants::comparison::{Bounds, Follows, Measured, compare, summaries};
use crate::invariants::relation::{POSITIONS, RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{gives, number, value, with};
use crate::invariants::traits_of_scene::{
    follows_tip_edges, has_finite_elements, has_heat_or_oil, has_one_coefficient, is_severe, is_sliced,
    takes_stable_steps,
};
use gearwear_physics::results::run::RunRecord;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "resolved scene again",
        states: "The resolved scene that a run writes gives the same run.",
        bound: "none: the same bits",
        is_rare: false,
        check: resolved_again,
    },
    SceneRelation {
        name: "neutral film",
        states: "A factor of 1 at every film changes nothing.",
        bound: "rounding",
        is_rare: true,
        check: neutral_film,
    },
    SceneRelation {
        name: "neutral temperature factor",
        states: "A factor of 1 at every temperature of the teeth, and a modulus that does not depend on it, change nothing.",
        bound: "rounding",
        is_rare: true,
        check: neutral_warm,
    },
    SceneRelation {
        name: "neutral severe wear",
        states: "Severe wear with a factor of 1 changes nothing.",
        bound: "rounding",
        is_rare: false,
        check: neutral_severe,
    },
    SceneRelation {
        name: "law of each gear",
        states: "A law written for each gear, with the coefficient of both, changes nothing.",
        bound: "rounding",
        is_rare: false,
        check: law_of_each_gear,
    },
    SceneRelation {
        name: "half of the pinion by a factor",
        states: "A factor of ½ on the pinion at every film is half of its wear coefficient.",
        bound: "rounding",
        is_rare: true,
        check: half_of_pinion,
    },
    SceneRelation {
        name: "half of the wheel by a factor",
        states: "A factor of ½ on the wheel at every film or temperature is half of its wear coefficient.",
        bound: "rounding",
        is_rare: true,
        check: half_of_wheel,
    },
    SceneRelation {
        name: "half by severe wear",
        states: "Severe wear at any pressure with a factor of ½ on one gear is half of its wear coefficient.",
        bound: "rounding",
        is_rare: false,
        check: half_severe,
    },
    SceneRelation {
        name: "slices of a spur pair",
        states: "A pair without slices is any of its slices: a lead crowning of a millionth of a micrometre changes nothing.",
        bound: "positions of slices lie over one base pitch, others than those from A to E: 15 % of the volume, 5 % of the transmission error; \
                where they are too few for narrow contacts, four or sixteen times as many",
        is_rare: false,
        check: slices,
    },
];

/// Relative effect of other positions on the least and the greatest transmission error.
const OF_POSITIONS: f64 = 0.05;

/// Differences of all figures of two runs that must be the same.
fn alike(one: &RunRecord, other: &RunRecord, bound: f64, besides: &[&str]) -> Vec<Measured> {
    let (value, path) = summaries(&one.summary, &other.summary, besides);
    let mut found = compare(one, other, &Follows::default(), Bounds::all(bound));
    found.push(Measured::new(format!("summary, {path}"), value, bound));
    found
}

fn resolved_again(subject: &Subject<'_>) -> RelationOutcome {
    let Ok(other) = subject.record.scene_toml.parse::<Table>() else { return RelationOutcome::NotOfThisScene };
    subject.beside(other, |record| alike(subject.record, record, f64::MIN_POSITIVE, &[]))
}

fn numbers<const N: usize>(of: [f64; N]) -> Value {
    Value::Array(of.map(Value::Float).into())
}

fn neutral_film(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !gives(table, "lubricant")
        || ["wear", "wear.pinion", "wear.wheel"].iter().any(|of| gives(table, &format!("{of}.film")))
    {
        return RelationOutcome::NotOfThisScene;
    }
    let other = with(table, "wear.film.lambda", numbers([0.0, 1000.0]));
    let other = with(&other, "wear.film.factor", numbers([1.0, 1.0]));
    subject.beside(other, |record| {
        alike(
            subject.record,
            record,
            ROUNDING,
            &["wear", "lubrication", "pinion.vdi", "wheel.vdi", "pinion.peak_over", "wheel.peak_over"],
        )
    })
}

fn neutral_warm(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    let has_factor = ["wear", "wear.pinion", "wear.wheel"].iter().any(|of| gives(table, &format!("{of}.warm")));
    if !gives(table, "temperature.tooth") || has_factor {
        return RelationOutcome::NotOfThisScene;
    }
    let mut other = with(table, "wear.warm.temperature_C", numbers([0.0, 200.0]));
    other = with(&other, "wear.warm.factor", numbers([1.0, 1.0]));
    for gear in ["pinion", "wheel"] {
        let key = format!("material.{gear}.young_modulus_GPa");
        if let Some(modulus) = number(table, &key) {
            if let Some(of_gear) =
                other.get_mut("material").and_then(|all| all.get_mut(gear)).and_then(Value::as_table_mut)
            {
                of_gear.remove("young_modulus_GPa");
            }
            let curve = format!("material.{gear}.young_modulus_curve");
            other = with(&other, &format!("{curve}.temperature_C"), numbers([0.0, 200.0]));
            other = with(&other, &format!("{curve}.young_modulus_GPa"), numbers([modulus, modulus]));
        }
    }
    subject.beside(other, |record| alike(subject.record, record, ROUNDING, &["wear", "temperature"]))
}

fn neutral_severe(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    let has_severe = ["wear", "wear.pinion", "wear.wheel"].iter().any(|of| gives(table, &format!("{of}.severe")));
    if has_severe {
        return RelationOutcome::NotOfThisScene;
    }
    let above = 0.5 * subject.record.summary.contact.hertz_peak_pressure_MPa;
    let mut other = with(table, "wear.severe.above_MPa", above);
    other = with(&other, "wear.severe.factor", 1.0);
    other = with(&other, "wear.severe.band_MPa", 0.1 * above);
    subject.beside(other, |record| {
        alike(
            subject.record,
            record,
            ROUNDING,
            &["wear", "pinion.vdi", "wheel.vdi", "pinion.peak_over", "wheel.peak_over"],
        )
    })
}

fn law_of_each_gear(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !has_one_coefficient(table) {
        return RelationOutcome::NotOfThisScene;
    }
    let mut other = table.clone();
    for (key, of_both) in [
        ("law", "wear.law"),
        ("coefficient_m2_per_N", "wear.coefficient_m2_per_N"),
        ("coefficient_mm3_per_Nm", "wear.coefficient_mm3_per_Nm"),
    ] {
        if let Some(given) = value(table, of_both) {
            for gear in ["pinion", "wheel"] {
                other = with(&other, &format!("wear.{gear}.{key}"), given.clone());
            }
        }
    }
    subject.beside(other, |record| alike(subject.record, record, ROUNDING, &["wear", "phases", "error"]))
}

fn half_of_pinion(subject: &Subject<'_>) -> RelationOutcome {
    half(subject, "pinion")
}

fn half_of_wheel(subject: &Subject<'_>) -> RelationOutcome {
    half(subject, "wheel")
}

/// Halves the wear in two ways: by a factor over film or temperature, and by the coefficient.
fn half(subject: &Subject<'_>, gear: &str) -> RelationOutcome {
    let table = subject.table;
    let own = format!("wear.{gear}");
    let by_factor = if gives(table, "lubricant") && !gives(table, "wear.film") {
        let scene = with(table, &format!("{own}.film.lambda"), numbers([0.0, 1000.0]));
        with(&scene, &format!("{own}.film.factor"), numbers([0.5, 0.5]))
    } else if gear == "wheel" && gives(table, "temperature.tooth") && !gives(table, "wear.warm") {
        let scene = with(table, &format!("{own}.warm.temperature_C"), numbers([0.0, 200.0]));
        with(&scene, &format!("{own}.warm.factor"), numbers([0.5, 0.5]))
    } else {
        return RelationOutcome::NotOfThisScene;
    };
    against_half(subject, table, &own, by_factor)
}

/// Halves the wear by the severe factor, where wear is severe at any pressure.
fn half_severe(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if is_severe(table) {
        return RelationOutcome::NotOfThisScene;
    }
    // Severe wear has finer elements by default.
    let table = &match has_finite_elements(table) {
        true => with(table, "fem.elements_per_half_width", 3.0),
        false => table.clone(),
    };
    let is_even = number(table, "numerics.flank_points").is_some_and(|points| points % 2.0 == 0.0);
    let own = if is_even { "wear.pinion" } else { "wear.wheel" };
    let by_factor = with(table, &format!("{own}.severe.above_MPa"), 1e-9);
    against_half(subject, table, own, with(&by_factor, &format!("{own}.severe.factor"), 0.5))
}

/// The scene `by_factor` against `table` with half of the coefficient in the table `own` of a gear's law.
fn against_half(subject: &Subject<'_>, table: &Table, own: &str, by_factor: Table) -> RelationOutcome {
    let keys = ["coefficient_m2_per_N", "coefficient_mm3_per_Nm"];
    let given = keys.into_iter().find_map(|key| Some((key, number(table, &format!("wear.{key}"))?)));
    let Some((key, coefficient)) = given.filter(|_| has_one_coefficient(table)) else {
        return RelationOutcome::NotOfThisScene;
    };
    let by_coefficient = with(table, &format!("{own}.{key}"), 0.5 * coefficient);
    subject.two(by_coefficient, by_factor, |one, other| {
        compare(one, other, &Follows::default(), Bounds::all(1e2 * ROUNDING))
    })
}

fn slices(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    // Jumps of the contact at A and E depend on the positions, and the simplified model is another model.
    let is_another =
        has_finite_elements(table) || is_severe(table) || has_heat_or_oil(table) || !follows_tip_edges(table);
    if is_sliced(table) || is_another || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    subject.refined(
        &[POSITIONS],
        |table| with(table, "pair.pinion.lead_crowning_um", 1e-6),
        |one, other| volumes_and_error(one, other, OF_POSITIONS),
    )
}
