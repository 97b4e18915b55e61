//! Pairs with an internal wheel: both spellings made one, and what the model does not have of them.
//!
//! A wheel is internal with `internal = true` and positive numbers, or with a negative number of teeth, and then diameters and centre distance that
//! are all positive (ISO 21771) or all negative (DIN 3960). The profile shift has the same sign in all: positive towards the tips. Before the file is
//! checked, the second spelling is rewritten as the first.

use toml::{Table, Value};

use super::file::{SceneFile, StiffnessModel};
use super::findings::Findings;
use super::problem::number;
use super::table;
use gearwear_bodies::gear::spec::PairSpec;

const TEETH: &str = "pair.wheel.teeth";
const INTERNAL: &str = "pair.wheel.internal";

/// Keys of lengths that are negative beside a negative number of teeth.
const LENGTHS: [&str; 5] = [
    "pair.centre_distance_mm",
    "pair.wheel.tip_diameter_mm",
    "pair.wheel.root_diameter_mm",
    "pair.wheel.tip_relief.begins_at_diameter_mm",
    "pair.wheel.root_relief.begins_at_diameter_mm",
];

/// Number at the path `key` of `table`.
fn number_at(table: &Table, key: &str) -> Option<f64> {
    let value = table::at(table, key)?;
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

/// Rewrites a wheel with a negative number of teeth as one with `internal = true` and positive numbers.
pub(super) fn with_positive_numbers(mut table: Table, findings: &mut Findings) -> Table {
    let Some(Value::Integer(teeth @ ..=-1)) = table::at(&table, TEETH) else { return table };
    let teeth = teeth.saturating_abs();
    if table::at(&table, INTERNAL).and_then(Value::as_bool) == Some(false) {
        findings.not_allowed(INTERNAL, "false with a negative number of teeth, that of an internal wheel", "true");
    }
    let given: Vec<(&str, f64)> = LENGTHS.into_iter().filter_map(|key| Some((key, number_at(&table, key)?))).collect();
    if let [(first_key, first), others @ ..] = given.as_slice()
        && let Some((key, odd)) = others.iter().find(|(_, other)| (*other < 0.0) != (*first < 0.0))
    {
        let sign = if *first < 0.0 { "negative" } else { "positive" };
        findings.not_allowed(key, number(*odd), format!("a {sign} number, as {first_key} is {}", number(*first)));
        findings.help(
            "beside a negative number of teeth, diameters and centre distance are all positive (ISO 21771) or all negative (DIN 3960)",
        );
    }
    table::set(&mut table, TEETH, teeth);
    table::set(&mut table, INTERNAL, true);
    for (key, length) in given {
        table::set(&mut table, key, length.abs());
    }
    table
}

/// Reports keys of internal teeth on gears with external ones.
pub(super) fn check_keys(file: &SceneFile, findings: &mut Findings) {
    for (name, gear) in [("pinion", &file.pair.pinion), ("wheel", &file.pair.wheel)] {
        let Some(gear) = gear else { continue };
        let is_internal = gear.internal == Some(true);
        if name == "pinion" && is_internal {
            findings.not_allowed("pair.pinion.internal", "true", "false: the internal gear of a pair is the wheel");
            return;
        }
        let generated = "left out: the basic rack generates external teeth";
        let of_internal_teeth = [
            ("root_diameter_mm", gear.root_diameter_mm.is_some(), generated),
            ("cutter", gear.cutter.is_some(), generated),
            ("rim_pins", gear.rim_pins.is_some(), "left out: external gears are held below their teeth"),
            (
                "rim_thickness_mm",
                gear.rim_thickness_mm.is_some(),
                "left out: fem.clamp_radius_mm says where external gears are held, fem.web which rim they have",
            ),
        ];
        for (key, given, allowed) in of_internal_teeth {
            if given && !is_internal {
                findings.not_allowed(&format!("pair.{name}.{key}"), "given for external teeth", allowed);
            }
        }
        if gear.root_diameter_mm.is_some() && gear.cutter.is_some() {
            findings.said_twice(&[("pair.wheel.root_diameter_mm", true), ("pair.wheel.cutter", true)]);
        }
    }
}

/// Reports what the scene asks for and the model does not have of internal pairs.
pub(super) fn check_model(file: &SceneFile, pair: &PairSpec, findings: &mut Findings) {
    const RIM: &str = "pair.wheel.rim_thickness_mm says how far from its teeth an internal wheel is held";
    let stiffness = file.stiffness.as_ref().and_then(|stiffness| stiffness.model);
    let tooth_temperature = file.temperature.as_ref().is_some_and(|temperature| temperature.tooth.is_some());
    let models = "\"fem\", the default, \"weber-banaschek\", \"iso6336\" or \"constant\"";
    let of_external = |model| matches!(model, StiffnessModel::Simon | StiffnessModel::WangCheng);
    let fem = file.fem.as_ref();
    let clamped = fem.and_then(|fem| fem.clamp_radius_mm.as_ref()).is_some_and(|radii| radii.wheel.is_some());
    let on_web = fem.and_then(|fem| fem.web.as_ref()).is_some_and(|webs| webs.wheel.is_some());
    let bore = file.pair.wheel.as_ref().is_some_and(|wheel| wheel.bore_diameter_mm.is_some());
    // Key, whether it is given, what is allowed instead, and why.
    let asked = [
        ("stiffness.model", stiffness.is_some_and(of_external), models, "the other models hold for external teeth"),
        ("fem.clamp_radius_mm.wheel", clamped, "left out", RIM),
        ("fem.web.wheel", on_web, "left out", RIM),
        (
            "pair.wheel.shaft",
            pair.gears.wheel.shaft.is_some(),
            "left out",
            "the shaft of an internal wheel is not in the model",
        ),
        (
            "lubricant.bulk_temperature_C",
            file.lubricant.as_ref().is_some_and(|oil| oil.bulk_temperature_C.is_none()),
            "the temperature of the teeth",
            "ISO/TS 6336-22 estimates it from the centre distance of external gears",
        ),
        ("temperature.tooth", tooth_temperature, "left out", "VDI 2736-2 has the temperatures of external teeth"),
        ("pair.wheel.bore_diameter_mm", bore, "left out", "an internal wheel has no bore below its teeth"),
    ];
    for (key, given, instead, because) in asked {
        if given {
            let found = if key.starts_with("lubricant") { "nothing for" } else { "given for" };
            findings.not_allowed(key, format!("{found} a pair with an internal wheel"), instead);
            findings.help(because);
        }
    }
}
