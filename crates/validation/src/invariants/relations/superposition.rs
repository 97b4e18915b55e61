//! Wear so small that it changes no contact adds up.

use toml::{Table, Value};

use crate::invariants::comparison::{Bounds, Follows, Measured, compare, difference};
use crate::invariants::relation::{RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{number, phases, scaled, with};
use crate::invariants::traits_of_scene::{has_finite_elements, has_fixed_steps, has_one_coefficient, is_sliced};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::results::run::RunRecord;

/// Factor on the wear coefficients: wear of at most 2e-3 modules becomes 2e-12 modules, whose relative effect on contact is as small.
const SMALL: f64 = 1e-9;
/// Remaining effect of wear on contact: a depth of 2e-12 modules, up to a hundred times as deep where wear is severe, beside an approach
/// of 1e-4 modules and more; and ten times that where a severe rate rises over a band of a few hundredths of the pressure.
const FEEDBACK: f64 = 2e-5;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "phases add up",
        states: "Wear so small that it changes no contact: that of a load spectrum is the sum of what each phase wears by itself.",
        bound: "effect of the wear left on the contact, 2e-5",
        is_rare: true,
        check: phases_add_up,
    },
    SceneRelation {
        name: "coefficient of one gear",
        states: "Twice the coefficient of the wheel alone, wear being that small: twice its wear, and the pinion's as before.",
        bound: "effect of the wear left on the contact, 2e-5",
        is_rare: false,
        check: of_one_gear,
    },
];

/// The scene with wear too small to change the contact.
fn hardly_worn(table: &Table) -> Table {
    scaled(table, &|key| match key {
        "coefficient_m2_per_N" | "coefficient_mm3_per_Nm" => SMALL,
        _ => 1.0,
    })
}

fn phases_add_up(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    // Finite elements are as fine as the greatest load of all phases asks.
    let Some(all) = phases(table).filter(|_| has_fixed_steps(table) && !has_finite_elements(table)) else {
        return RelationOutcome::NotOfThisScene;
    };
    // Slices are as stiff in all phases as in that of the greatest load.
    if is_sliced(table) && number(table, "temperature.tooth.ambient_temperature_C").is_some() {
        return RelationOutcome::NotOfThisScene;
    }
    let whole = hardly_worn(table);
    let mut alone: Vec<RunRecord> = Vec::new();
    for phase in all {
        let scene = only(&whole, phase);
        match (subject.run)(&scene) {
            Ok(record) => alone.push(record),
            Err(how) => return RelationOutcome::Ended { scene, how },
        }
    }
    subject.beside(whole, |together| {
        let of_gears = Gear::BOTH.map(|gear| {
            let mut sum = vec![0.0; together.flanks[gear].wear_um.len()];
            for record in &alone {
                sum.iter_mut().zip(&record.flanks[gear].wear_um).for_each(|(sum, wear)| *sum += wear);
            }
            let value = difference(&sum, &together.flanks[gear].wear_um, 1.0);
            Measured::new(format!("wear of the {}", gear.name()), value, FEEDBACK)
        });
        of_gears.into()
    })
}

/// The scene with one of its phases alone.
fn only(table: &Table, phase: &Value) -> Table {
    let duration = phase.get("pinion_revolutions").and_then(Value::as_float).unwrap_or_default();
    let scene = with(table, "operation.phases", Value::Array(vec![phase.clone()]));
    with(&scene, "operation.snapshots_revolutions", Value::Array(vec![Value::Float(duration)]))
}

fn of_one_gear(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !has_fixed_steps(table) || !has_one_coefficient(table) {
        return RelationOutcome::NotOfThisScene;
    }
    let keys = ["coefficient_m2_per_N", "coefficient_mm3_per_Nm"];
    let given = keys.into_iter().find_map(|key| Some((key, number(table, &format!("wear.{key}"))?)));
    let Some((key, coefficient)) = given else { return RelationOutcome::NotOfThisScene };
    let one = hardly_worn(table);
    let other = with(&one, &format!("wear.wheel.{key}"), 2.0 * SMALL * coefficient);
    let follows = Follows { depth: PerGear { pinion: 1.0, wheel: 2.0 }, ..Follows::default() };
    let bounds = Bounds::all(FEEDBACK);
    subject.two(one, other, |one, other| compare(one, other, &follows, bounds))
}
