//! The text of the scene.

use std::fmt::Write;

use super::RexsError;
use super::document::{CELSIUS, GPA, J_PER_KGK, KG_PER_M3, MM2_PER_S, NONE, RexsDocument, W_PER_MK};
use super::load::{Load, LoadOfCase};
use super::modifications::{ReliefForm, ReliefStart, RexsEndRelief, RexsRelief};
use super::planetary_unit::PlanetaryUnit;
use super::stage::{Figure, GearData, Gears, RexsStage};

/// Hours and revolutions of a life that the file does not give.
const ASSUMED_HOURS: f64 = 1000.0;
const ASSUMED_REVOLUTIONS: f64 = 1e6;

/// What stands in the scene, by where it comes from: keys by their paths.
#[derive(Debug, Default)]
pub struct Provenance {
    /// As the file says it.
    pub taken: Vec<String>,
    /// Determined by what the file says.
    pub derived: Vec<String>,
    /// Usual values of what the file leaves open.
    pub assumed: Vec<String>,
    /// To be filled in.
    pub required: Vec<String>,
}

pub(super) fn of(
    document: &RexsDocument,
    stage: &RexsStage,
    (gears, planetary): (&Gears, Option<&PlanetaryUnit>),
    load: &Load,
    warnings: &mut Vec<String>,
) -> Result<(String, Provenance), RexsError> {
    let mut text = Text::default();
    let named = planetary.and_then(|unit| unit.component).unwrap_or(stage.component);
    let title = match (named.name.as_str(), planetary) {
        ("", None) => "Cylindrical stage",
        ("", Some(_)) => "Planetary stage",
        (name, _) => name,
    };
    text.line(format!(
        "# From a REXS {} file of {}.",
        document.version,
        or(&document.application, "a program that does not say its name")
    ));
    text.line("# What is ASSUMED, and what a line beginning with # stands for, is not in that file.");
    text.line("# All keys, their ranges and defaults:   gearwear schema");
    text.line(format!("title = {}", quoted(title)));

    text.table(if planetary.is_some() { "planetary" } else { "pair" }, "");
    if let Some(unit) = planetary {
        text.taken("planets", &unit.planets.to_string(), "at equal angles");
        text.assumed("held", "\"ring\"", "or \"carrier\", \"sun\"");
    }
    text.figure("normal_module_mm", gears.normal_module_mm.as_ref());
    text.figure("pressure_angle_deg", gears.pressure_angle_deg.as_ref());
    let helix_deg = gears.helix_angle_deg.value.abs();
    match &gears.helix_angle_deg.how {
        _ if helix_deg == 0.0 => {}
        None => text.number("helix_angle_deg", helix_deg, "positive: width 0 enters the mesh first"),
        Some(how) => text.derived("helix_angle_deg", &rounded(helix_deg), how),
    }
    text.figure("centre_distance_mm", gears.centre_distance_mm.as_ref());
    text.figure("face_width_mm", gears.face_width_mm.as_ref());
    if let Some(factor) = gears.dedendum_factor {
        text.derived("basic_rack", &format!("{{ dedendum_factor = {} }}", rounded(factor)), "of the root diameter");
    }
    let tables = match planetary {
        None => pair_tables(&mut text, gears),
        Some(unit) => stage_tables(&mut text, gears, unit),
    };
    for (table, data) in tables {
        material(&mut text, document, table, data)?;
    }
    operation(&mut text, gears, planetary, load, warnings);
    lubricant(&mut text, document, stage, (gears, planetary.is_some()), load)?;
    text.table("wear", "");
    text.line("law = \"archard\"");
    text.assumed("coefficient_m2_per_N", "1e-18", "steel with a full film; docs/materials.md has k with sources");
    Ok((text.lines, text.provenance))
}

/// Tables of both gears of a pair; their names with their data.
fn pair_tables<'a>(text: &mut Text, gears: &'a Gears) -> Vec<(&'static str, &'a GearData<'a>)> {
    let tables = vec![("pinion", &gears.pinion), ("wheel", &gears.wheel)];
    for &(table, data) in &tables {
        let drives = gears.roles.how.as_ref().filter(|_| table == "pinion");
        let drives = drives.map_or("drives".to_owned(), |how| format!("drives: {how}"));
        text.table(&format!("pair.{table}"), if table == "pinion" { &drives } else { "" });
        if let (Some(how), "pinion") = (&gears.roles.how, table) {
            let provenance = &mut text.provenance;
            let list = if gears.roles.is_assumed { &mut provenance.assumed } else { &mut provenance.derived };
            list.push(format!("which gear is pair.pinion ({how})"));
        }
        gear(text, data);
    }
    tables
}

/// Tables of the gears of a planetary stage; their names with their data.
fn stage_tables<'a>(
    text: &mut Text,
    gears: &'a Gears,
    unit: &'a PlanetaryUnit,
) -> Vec<(&'static str, &'a GearData<'a>)> {
    let (sun, planet) = if unit.sun_drives { (&gears.pinion, &gears.wheel) } else { (&gears.wheel, &gears.pinion) };
    let tables = vec![("sun", sun), ("planet", planet), ("ring", &unit.ring)];
    for &(table, data) in &tables {
        text.table(&format!("planetary.{table}"), "");
        gear(text, data);
    }
    tables
}

/// Radius of an edge that is broken as usual, mm.
const BROKEN_EDGE_MM: f64 = 0.1;

/// The table of a relief in a scene, and what is to be said of it.
fn relief(relief: &RexsRelief) -> (String, &'static str) {
    let start = match relief.start {
        ReliefStart::Diameter(diameter_mm) => format!("begins_at_diameter_mm = {}", rounded(diameter_mm)),
        ReliefStart::RollLength(length_mm) => format!("length_mm = {}", rounded(length_mm)),
    };
    let (shape, remark) = shape(relief.form);
    (format!("{{ amount_um = {}, {start}{shape} }}", rounded(relief.amount_um)), remark)
}

fn gear(text: &mut Text, data: &GearData) {
    text.line(format!("# {}", data.component.label()));
    match data.teeth {
        Some(teeth) => text.taken("teeth", &teeth.to_string(), ""),
        None => text.required("teeth"),
    }
    text.figure("profile_shift", data.profile_shift.as_ref());
    if let Some(tip_mm) = data.tip_diameter_mm {
        text.number("tip_diameter_mm", tip_mm, "");
    }
    if let Some(allowance_um) = data.thickness_allowance_um {
        text.number("tooth_thickness_allowance_um", allowance_um, "");
    }
    match data.tip_chamfer_mm {
        Some(chamfer_mm) => {
            text.number("tip_chamfer_mm", chamfer_mm, "");
            text.assumed("tip_chamfer_deg", "45.0", "the file has no angle of the chamfer");
            text.assumed(
                "tip_rounding_mm",
                &rounded(chamfer_mm.min(BROKEN_EDGE_MM)),
                "of the chamfer’s edge; a sharp one has no pressure",
            );
        }
        None => text.assumed("tip_rounding_mm", &rounded(BROKEN_EDGE_MM), "a broken edge; a sharp one has no pressure"),
    }
    if let Some(roughness_um) = data.roughness_Ra_um {
        text.number("roughness_Ra_um", roughness_um, "");
    }
    let modifications = &data.modifications;
    for (key, part) in [("tip_relief", &modifications.tip_relief), ("root_relief", &modifications.root_relief)] {
        if let Some((value, remark)) = part.as_ref().map(relief) {
            text.taken(key, &value, remark);
        }
    }
    if let Some(RexsEndRelief { amount_um, length_mm, form }) = &modifications.end_relief {
        let (amount, length, (shape, remark)) = (rounded(*amount_um), rounded(*length_mm), shape(*form));
        text.taken("end_relief", &format!("{{ amount_um = {amount}, length_mm = {length}{shape} }}"), remark);
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
    text.table(&format!("material.{table}"), &material.label());
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

/// Keys of an operation: of a pair's, or of a planetary stage's.
struct OperationKeys {
    torque: &'static str,
    speed: &'static str,
    revolutions: &'static str,
}

const OF_PAIR: OperationKeys =
    OperationKeys { torque: "pinion_torque_Nm", speed: "pinion_speed_rpm", revolutions: "pinion_revolutions" };
const OF_STAGE: OperationKeys = OperationKeys { torque: "torque_Nm", speed: "speed_rpm", revolutions: "revolutions" };

fn operation(
    text: &mut Text,
    gears: &Gears,
    planetary: Option<&PlanetaryUnit>,
    load: &Load,
    warnings: &mut Vec<String>,
) {
    text.table("operation", "");
    let keys = if planetary.is_some() { OF_STAGE } else { OF_PAIR };
    match planetary {
        None => meshes(text, gears),
        Some(_) => text.line("member = \"sun\""),
    }
    let cases: Vec<(Option<Figure>, Option<Figure>, f64)> = load
        .cases
        .iter()
        .map(|case| match planetary {
            None => (case.torque_Nm.clone(), case.speed_rpm.clone(), case.fraction),
            Some(unit) => (sun_torque(gears, unit, case), sun_speed(unit, case), case.fraction),
        })
        .collect();
    let speeds = cases.iter().all(|(_, speed, _)| speed.is_some());
    let (key, whole, assumed) = match (speeds, load.hours) {
        (true, Some(hours)) => ("hours", hours, ""),
        (true, None) => ("hours", ASSUMED_HOURS, "the file does not say how long"),
        (false, _) => (keys.revolutions, ASSUMED_REVOLUTIONS, "the file does not say how long, or how fast"),
    };
    if cases.iter().any(|(torque, _, _)| torque.is_none()) {
        warnings
            .push(format!("the file does not give the torque of the driving gear: write operation.{}", keys.torque));
        text.required(keys.torque);
    }
    let many = cases.len() > 1;
    if many && !assumed.is_empty() {
        text.line(format!("# {key} of the phases: {} in all, ASSUMED: {assumed}", rounded(whole)));
    }
    for (torque, speed, fraction) in &cases {
        if many {
            text.line("\n[[operation.phases]]");
        }
        for (key, figure) in [(keys.torque, torque), (keys.speed, speed)] {
            if figure.is_some() {
                text.figure(key, figure.as_ref());
            }
        }
        let value = rounded(whole * fraction);
        match assumed {
            "" => text.taken(key, &value, ""),
            _ if many => text.line(format!("{key} = {value}")),
            why => text.assumed(key, &value, why),
        }
    }
    if many && !assumed.is_empty() {
        text.provenance.assumed.push(format!("operation.phases.{key}"));
    }
}

/// Torque on the sun: that of one mesh, of all its planets.
fn sun_torque(gears: &Gears, unit: &PlanetaryUnit, case: &LoadOfCase) -> Option<Figure> {
    let of_mesh = case.torque_Nm.as_ref()?;
    let to_sun = match unit.sun_drives {
        true => 1.0,
        false => f64::from(gears.wheel.teeth?) / f64::from(gears.pinion.teeth?),
    };
    let value = of_mesh.value * to_sun * unit.planets as f64;
    Some(Figure::derived(value, "that of one mesh times the planets, which share alike"))
}

/// Speed of the sun; unknown where the file gives that of a planet.
fn sun_speed(unit: &PlanetaryUnit, case: &LoadOfCase) -> Option<Figure> {
    case.speed_rpm.clone().filter(|_| unit.sun_drives)
}

/// On how many mates each gear runs, where one has several.
fn meshes(text: &mut Text, gears: &Gears) {
    let mates = [&gears.roles.mates.pinion, &gears.roles.mates.wheel];
    let [of_pinion, of_wheel] = mates.map(|mates| mates.len().max(1));
    if of_pinion == 1 && of_wheel == 1 {
        return;
    }
    for (name, mates) in ["pinion", "wheel"].into_iter().zip(mates).filter(|(_, mates)| mates.len() > 1) {
        text.line(format!("# the {name} runs on {}; the torque is that of one mesh", mates.join(", ")));
    }
    let value = format!("{{ pinion = {of_pinion}, wheel = {of_wheel} }}");
    text.derived("meshes_per_revolution", &value, "counted in the file");
    if gears.roles.is_planetary {
        text.line("# revolutions and speed are those against the planet carrier: where that turns, the difference of both speeds");
    }
}

/// The oil, where the file gives all that films need; otherwise as remarks.
fn lubricant(
    text: &mut Text,
    document: &RexsDocument,
    stage: &RexsStage,
    (gears, is_planetary): (&Gears, bool),
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
    // The mesh with the ring asks for the temperature of the teeth too.
    let mark = if speeds && rough && temperature_C.is_some() && !is_planetary { "" } else { "# " };
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

/// Lines of a TOML file, and where what they say comes from.
#[derive(Default)]
struct Text {
    lines: String,
    /// Path of the table that the lines are in.
    table: String,
    provenance: Provenance,
}

impl Text {
    fn line(&mut self, line: impl AsRef<str>) {
        self.lines.push_str(line.as_ref());
        self.lines.push('\n');
    }

    /// Begins a table.
    fn table(&mut self, path: &str, remark: &str) {
        self.table = path.to_owned();
        let head = format!("[{path}]");
        self.lines.push('\n');
        self.setting(&head, remark);
    }

    fn setting(&mut self, setting: &str, remark: &str) {
        let _ = if remark.is_empty() {
            writeln!(self.lines, "{setting}")
        } else {
            writeln!(self.lines, "{setting:<33} # {remark}")
        };
    }

    fn path(&self, key: &str) -> String {
        format!("{}.{key}", self.table)
    }

    /// A value as the file has it.
    fn taken(&mut self, key: &str, value: &str, remark: &str) {
        let path = self.path(key);
        if !self.provenance.taken.contains(&path) {
            self.provenance.taken.push(path);
        }
        self.setting(&format!("{key} = {value}"), remark);
    }

    fn number(&mut self, key: &str, value: f64, remark: &str) {
        self.taken(key, &rounded(value), remark);
    }

    /// A value that follows from what the file has.
    fn derived(&mut self, key: &str, value: &str, how: &str) {
        let entry = format!("{} ({how})", self.path(key));
        if !self.provenance.derived.contains(&entry) {
            self.provenance.derived.push(entry);
        }
        self.setting(&format!("{key} = {value}"), &format!("derived: {how}"));
    }

    fn assumed(&mut self, key: &str, value: &str, why: &str) {
        let path = self.path(key);
        self.provenance.assumed.push(path);
        self.setting(&format!("{key} = {value}"), &format!("ASSUMED: {why}"));
    }

    /// A key to be filled in.
    fn required(&mut self, key: &str) {
        let path = self.path(key);
        self.provenance.required.push(path);
        self.setting(&format!("# {key} ="), "REQUIRED: the file does not give it");
    }

    fn figure(&mut self, key: &str, figure: Option<&Figure>) {
        match figure {
            Some(Figure { value, how: None }) => self.number(key, *value, ""),
            Some(Figure { value, how: Some(how) }) => self.derived(key, &rounded(*value), how),
            None => self.required(key),
        }
    }
}

/// Twelve digits, so that 0.1 mm is 100 µm again.
pub(super) fn rounded(value: f64) -> String {
    let short: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    format!("{short:?}")
}

/// The shape in a scene, and what is to be said of it.
fn shape(form: ReliefForm) -> (&'static str, &'static str) {
    const PARABOLIC: &str = ", shape = \"parabolic\"";
    match form {
        ReliefForm::Linear => ("", ""),
        ReliefForm::Parabolic => (PARABOLIC, ""),
        ReliefForm::Circular => (PARABOLIC, "circular in the file, which is parabolic to first order"),
    }
}

fn or<'a>(text: &'a str, other: &'a str) -> &'a str {
    if text.is_empty() { other } else { text }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}
