//! The text of the scene.

use std::fmt::Write;

use super::RexsError;
use super::document::{CELSIUS, GPA, J_PER_KGK, KG_PER_M3, MM2_PER_S, NONE, RexsDocument, W_PER_MK};
use super::load::Load;
use super::modifications::{ReliefStart, RexsEndRelief, RexsRelief};
use super::stage::{GearData, Gears, RexsStage};

/// Hours and revolutions of a life that the file does not give.
const ASSUMED_HOURS: f64 = 1000.0;
const ASSUMED_REVOLUTIONS: f64 = 1e6;

pub(super) fn of(
    document: &RexsDocument,
    stage: &RexsStage,
    gears: &Gears,
    load: &Load,
    warnings: &mut Vec<String>,
) -> Result<String, RexsError> {
    let mut text = Text::default();
    let title = if stage.component.name.is_empty() { "Cylindrical stage" } else { &stage.component.name };
    text.line(format!(
        "# From a REXS {} file of {}.",
        document.version,
        or(&document.application, "a program that does not say its name")
    ));
    text.line("# What is ASSUMED, and what a line beginning with # stands for, is not in that file.");
    text.line("# All keys, their ranges and defaults:   gearwear schema");
    text.line(format!("title = {}", quoted(title)));

    text.line("\n[pair]");
    text.number("normal_module_mm", gears.normal_module_mm, "");
    text.number("pressure_angle_deg", gears.pressure_angle_deg, "");
    if gears.helix_angle_deg != 0.0 {
        text.number("helix_angle_deg", gears.helix_angle_deg.abs(), "positive: width 0 enters the mesh first");
    }
    text.number("centre_distance_mm", gears.centre_distance_mm, "");
    text.number("face_width_mm", gears.face_width_mm, "");
    if let Some(factor) = gears.dedendum_factor {
        text.line(format!("basic_rack = {{ dedendum_factor = {} }}   # of the root diameter", rounded(factor)));
    }
    for (table, data) in [("pinion", &gears.pinion), ("wheel", &gears.wheel)] {
        gear(&mut text, table, data);
    }
    for (table, data) in [("pinion", &gears.pinion), ("wheel", &gears.wheel)] {
        material(&mut text, document, table, data)?;
    }
    operation(&mut text, load, warnings);
    lubricant(&mut text, document, stage, gears, load)?;
    text.line("\n[wear]");
    text.line("law = \"archard\"");
    text.line(
        "coefficient_m2_per_N = 1e-18      # ASSUMED: steel with a full film; docs/materials.md has k with sources",
    );
    Ok(text.0)
}

/// The table of a relief in a scene.
fn relief(relief: &RexsRelief) -> String {
    let start = match relief.start {
        ReliefStart::Diameter(diameter_mm) => format!("begins_at_diameter_mm = {}", rounded(diameter_mm)),
        ReliefStart::RollLength(length_mm) => format!("length_mm = {}", rounded(length_mm)),
    };
    format!("{{ amount_um = {}, {start}{} }}", rounded(relief.amount_um), shape(relief.parabolic))
}

fn gear(text: &mut Text, table: &str, data: &GearData) {
    text.line(format!("\n[pair.{table}]{}", if table == "pinion" { "                     # drives" } else { "" }));
    text.line(format!("# {}", data.component.label()));
    text.line(format!("teeth = {}", data.teeth));
    text.number("profile_shift", data.profile_shift, "");
    if let Some(tip_mm) = data.tip_diameter_mm {
        text.number("tip_diameter_mm", tip_mm, "");
    }
    if let Some(allowance_um) = data.thickness_allowance_um {
        text.number("tooth_thickness_allowance_um", allowance_um, "");
    }
    match data.tip_chamfer_mm {
        Some(chamfer_mm) => {
            text.number("tip_rounding_mm", chamfer_mm, "ASSUMED: a rounding of the size of the file’s chamfer")
        }
        None => text.line("tip_rounding_mm = 0.1             # ASSUMED: a broken edge; a sharp one has no pressure"),
    }
    if let Some(roughness_um) = data.roughness_Ra_um {
        text.number("roughness_Ra_um", roughness_um, "");
    }
    let modifications = &data.modifications;
    if let Some(tip) = &modifications.tip_relief {
        text.line(format!("tip_relief = {}", relief(tip)));
    }
    if let Some(root) = &modifications.root_relief {
        text.line(format!("root_relief = {}", relief(root)));
    }
    if let Some(RexsEndRelief { amount_um, length_mm, parabolic }) = &modifications.end_relief {
        let (amount, length) = (rounded(*amount_um), rounded(*length_mm));
        text.line(format!("end_relief = {{ amount_um = {amount}, length_mm = {length}{} }}", shape(*parabolic)));
    }
    if let Some(height_um) = modifications.profile_crowning_um {
        text.number("profile_crowning_um", height_um, "");
    }
    if let Some(height_um) = modifications.lead_crowning_um {
        text.number("lead_crowning_um", height_um, "");
    }
}

/// The material that a reference names of the gear, or of the shaft that carries it.
fn material(text: &mut Text, document: &RexsDocument, table: &str, data: &GearData) -> Result<(), RexsError> {
    let own = document.material_of(data.component);
    let material = own.or_else(|| document.material_of(document.shaft_of(data.component)?));
    let Some(material) = material else { return Ok(()) };
    let modulus_GPa = material.number("elastic_modulus", GPA)?;
    let ratio = material.number("poisson_ratio", NONE)?;
    let density = material.number("density", KG_PER_M3)?;
    let conductivity = material.number("thermal_conductivity", W_PER_MK)?;
    let capacity = material.number("thermal_capacity", J_PER_KGK)?;
    text.line(format!("\n[material.{table}]                 # {}", material.label()));
    for (key, value) in [
        ("young_modulus_GPa", modulus_GPa),
        ("poisson_ratio", ratio),
        ("density_kg_per_m3", density),
        ("thermal_conductivity_W_per_mK", conductivity),
    ] {
        if let Some(value) = value {
            text.number(key, value, "");
        }
    }
    if let (Some(conductivity), Some(capacity), Some(density)) = (conductivity, capacity, density) {
        text.number("thermal_diffusivity_m2_per_s", conductivity / (capacity * density), "");
    }
    Ok(())
}

fn operation(text: &mut Text, load: &Load, warnings: &mut Vec<String>) {
    text.line("\n[operation]");
    let speeds = load.cases.iter().all(|case| case.speed_rpm.is_some());
    let (key, whole, assumed) = match (speeds, load.hours) {
        (true, Some(hours)) => ("hours", hours, ""),
        (true, None) => ("hours", ASSUMED_HOURS, "ASSUMED: the file does not say how long"),
        (false, _) => {
            ("pinion_revolutions", ASSUMED_REVOLUTIONS, "ASSUMED: the file does not say how long, or how fast")
        }
    };
    if load.cases.iter().any(|case| case.torque_Nm.is_none()) {
        warnings
            .push("the file does not give the torque of the driving gear: write operation.pinion_torque_Nm".to_owned());
        text.line("# pinion_torque_Nm =               # REQUIRED: the file does not give it for this gear");
    }
    let many = load.cases.len() > 1;
    if many && !assumed.is_empty() {
        text.line(format!("# {key} of the phases: {} in all, {assumed}", rounded(whole)));
    }
    for case in &load.cases {
        if many {
            text.line("\n[[operation.phases]]");
        }
        if let Some(torque_Nm) = case.torque_Nm {
            text.number("pinion_torque_Nm", torque_Nm, "");
        }
        if let Some(speed_rpm) = case.speed_rpm {
            text.number("pinion_speed_rpm", speed_rpm, "");
        }
        text.number(key, whole * case.fraction, if many { "" } else { assumed });
    }
}

/// The oil, where the file gives all that films need; otherwise as remarks.
fn lubricant(
    text: &mut Text,
    document: &RexsDocument,
    stage: &RexsStage,
    gears: &Gears,
    load: &Load,
) -> Result<(), RexsError> {
    let Some(oil) = document.components.iter().find(|component| component.kind == "lubricant") else { return Ok(()) };
    let viscosities = (
        oil.number("viscosity_at_40_degree_celsius", MM2_PER_S)?,
        oil.number("viscosity_at_100_degree_celsius", MM2_PER_S)?,
    );
    let (Some(at_40C), Some(at_100C)) = viscosities else { return Ok(()) };
    let said = document.load_cases.iter().flatten().chain(&document.components);
    let in_place = said.filter(|said| said.id == stage.component.id || said.kind == "gear_casing");
    let mut temperature = in_place.map(|component| component.number("temperature_lubricant", CELSIUS));
    let temperature_C = temperature.find_map(Result::transpose).transpose()?;
    let speeds = load.cases.iter().all(|case| case.speed_rpm.is_some());
    let rough = gears.pinion.roughness_Ra_um.is_some() && gears.wheel.roughness_Ra_um.is_some();
    let mark = if speeds && rough && temperature_C.is_some() { "" } else { "# " };
    text.line(if mark.is_empty() {
        ""
    } else {
        "\n# For films and losses, which need the speed, the temperature of the oil and roughness_Ra_um of both gears:"
    });
    text.line(format!("{mark}[lubricant]"));
    text.line(format!("{mark}viscosity_40C_mm2_per_s = {}", rounded(at_40C)));
    text.line(format!("{mark}viscosity_100C_mm2_per_s = {}", rounded(at_100C)));
    if let Some(density) = oil.number("density_at_15_degree_celsius", KG_PER_M3)? {
        text.line(format!("{mark}density_15C_kg_per_m3 = {}", rounded(density)));
    }
    text.line(format!("{mark}temperature_C = {}", temperature_C.map(rounded).unwrap_or_default()));
    Ok(())
}

/// Lines of a TOML file.
#[derive(Default)]
struct Text(String);

impl Text {
    fn line(&mut self, line: impl AsRef<str>) {
        self.0.push_str(line.as_ref());
        self.0.push('\n');
    }

    fn number(&mut self, key: &str, value: f64, remark: &str) {
        let setting = format!("{key} = {}", rounded(value));
        let _ = if remark.is_empty() {
            writeln!(self.0, "{setting}")
        } else {
            writeln!(self.0, "{setting:<33} # {remark}")
        };
    }
}

/// Twelve digits, so that 0.1 mm is 100 µm again.
pub(super) fn rounded(value: f64) -> String {
    let short: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    format!("{short:?}")
}

fn shape(parabolic: bool) -> &'static str {
    if parabolic { ", shape = \"parabolic\"" } else { "" }
}

fn or<'a>(text: &'a str, other: &'a str) -> &'a str {
    if text.is_empty() { other } else { text }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
