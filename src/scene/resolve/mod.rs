//! From the text of a scene file to a scene with every choice made.
//!
//! In order: TOML, shape (names, types, ranges), preset, defaults and what keys say about each other, units, and last
//! the gear pair itself. Each step reports all it finds and passes on what is sound.

mod centre_distance;
mod contact_size;
mod curve;
mod fem;
mod geometry;
mod internal_geometry;
mod lubrication;
mod material;
mod modifications;
mod operation;
mod pair;
mod settings;
mod slices;
mod temperature;
mod wear;

use toml::{Table, Value};

use super::file::{NumericsFile, PairFile, SceneFile};
use super::findings::Findings;
use super::problem::{Problem, ProblemKind};
use super::resolve::settings::StiffnessInputs;
use super::schema::{Node, schema};
use super::shape::{self, FileShape};
use super::{Resolved, internal, planetary, presets, table, text, unit_slip};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear_mesh::settings::{Body, BodySettings, NO_WEBS};
use gearwear_physics::contact::settings::{ContactSettings, SurfaceKind};
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::operation::Scene;
use gearwear_physics::simulation::settings::{Numerics, Operation};
use gearwear_physics::wear::settings::WearOfPair;

/// Keys of other files, each with the command that reads them.
const OF_OTHER_FILES: &[(&str, &str)] =
    &[("mesh", "a gear pair, [pair]; gearwear fem runs a problem with a mesh of its own")];

/// Resolves the text of a scene file.
pub(super) fn resolve(text: &str) -> Result<Resolved, Vec<Problem>> {
    let (table, findings) = text::parse(text)?;
    resolve_table(table, findings)
}

/// Resolves a parsed scene file; `findings` know where its keys stand.
pub(super) fn resolve_table(table: Table, mut findings: Findings) -> Result<Resolved, Vec<Problem>> {
    if table.contains_key("planetary") {
        return planetary::resolve_mesh(&table, findings);
    }
    let table = internal::with_positive_numbers(table, &mut findings);
    let format = FileShape { root: Node::root(schema()), of_other_files: OF_OTHER_FILES };
    let sound = with_preset(shape::check(format, &table, &mut findings));
    // Slips of unit are looked for in the file as it is, since they may exceed the allowed range.
    let slips = unit_slip::find(&with_preset(table));

    let resolved = text::typed::<SceneFile>(sound, &mut findings).and_then(|file| choose(file, &mut findings));
    let mut resolved = resolved.filter(|_| findings.problems.is_empty());
    let mut of_contact = false;
    if let Some((scene, file)) = &mut resolved
        && let Some(pair) = geometry::check(&scene.pair, scene.slices, &mut findings)
    {
        if let Some(warning) = settings::leave_elements_out(scene, &pair) {
            findings.warnings.push(warning);
        }
        contact_size::check(scene, &pair, &mut findings);
        settings::positions(scene, file.numerics.get_or_insert_default(), &pair);
        of_contact = !findings.problems.is_empty();
        operation::check_stop(&scene.operation.stop, &pair, &mut findings);
    }
    let slips = slips.into_iter().filter(|slip| findings.is_in_file(&slip.key));
    match resolved {
        Some((scene, file)) if findings.problems.is_empty() => {
            let mut warnings: Vec<String> = slips.map(|slip| slip.warning()).collect();
            warnings.append(&mut findings.warnings);
            Ok(Resolved { scene, file, warnings })
        }
        _ => {
            let slips: Vec<_> = slips.collect();
            let mut problems = findings.in_order();
            for problem in &mut problems {
                let geometry = matches!(problem.kind, ProblemKind::Geometry(_));
                for slip in &slips {
                    if slip.key == problem.key && !geometry {
                        problem.add_help(&slip.question());
                    } else if of_contact || geometry && slip.key.starts_with("pair.") {
                        problem.add_help(&slip.warning());
                    }
                }
            }
            Err(problems)
        }
    }
}

/// Scene with the values of its preset, if any, where the file has none.
fn with_preset(mut scene: Table) -> Table {
    let Some(Value::Table(pair)) = scene.get_mut("pair") else { return scene };
    let preset = pair.get("preset").and_then(Value::as_str).and_then(presets::find);
    if let Some(preset) = preset {
        pair.remove("preset");
        // Keys of the file also replace alternative keys of the preset.
        let mut below = Table::from_iter([("pair".to_owned(), Value::Table(preset.pair()))]);
        for key in table::keys_of(pair, "pair") {
            for other in table::other_ways_to_say(&key) {
                table::remove(&mut below, &other);
            }
        }
        let Some(Value::Table(below)) = below.remove("pair") else { return scene };
        lay_below(pair, below);
    }
    scene
}

/// Adds the keys of `below` that `above` does not have.
fn lay_below(above: &mut Table, below: Table) {
    for (key, value) in below {
        match (above.get_mut(&key), value) {
            (None, value) => {
                above.insert(key, value);
            }
            (Some(Value::Table(above)), Value::Table(below)) => lay_below(above, below),
            (Some(_), _) => {}
        }
    }
}

/// Refuses bodies that do not fit the coupling of the slices, and warns of webs that the run does not use.
fn check_bodies(
    fem: Option<BodySettings>,
    slices: Option<SliceSettings>,
    is_calibrated: bool,
    findings: &mut Findings,
) {
    let in_space = slices.is_some_and(|slices| slices.coupling == Coupling::Fem);
    if in_space && fem.is_some_and(|fem| fem.body != Body::Ring) {
        findings.not_allowed("fem.body", "\"sector\" with helical.coupling = \"fem\"", "\"ring\"");
    }
    if fem.is_some_and(|fem| fem.web != NO_WEBS) && !in_space && !is_calibrated {
        findings.warnings.push(
            "fem.web: the wear simulation does not see it; helical.coupling = \"fem\" and calibrations of such a pair do"
                .to_owned(),
        );
    }
}

fn choose_numerics(
    file: &mut Option<NumericsFile>,
    contact: Option<ContactSettings>,
    slices: Option<SliceSettings>,
    is_severe: bool,
    operation: &Operation,
    findings: &mut Findings,
) -> Option<Numerics> {
    let surface = contact.map(|contact| contact.surface);
    let finely_resolved = matches!(surface, Some(SurfaceKind::Fem | SurfaceKind::HalfSpace));
    // The life may be a small part of the duration.
    let adaptive = finely_resolved || is_severe || operation.stop.are_set();
    let tip_contact = contact.is_some_and(|contact| contact.tip_contact);
    let most_positions = match settings::are_in_slices(contact, slices) {
        true => *settings::POSITIONS_IN_SLICES.end(),
        false => settings::POSITIONS,
    };
    let duration = operation.pinion_revolutions;
    let numerics = settings::numerics(file, duration, adaptive, tip_contact, most_positions, findings);
    if let (Some(numerics), Some(surface)) = (&numerics, surface) {
        settings::memory(numerics, surface, slices.map_or(1, |slices| slices.count), findings);
    }
    numerics
}

/// Title of a scene that gives none, with the module as the file gives it.
fn default_title(file: &PairFile, pair: &PairSpec) -> String {
    let module = match file.transverse_module_mm {
        Some(transverse) => format!("transverse module {transverse}"),
        None => format!("module {}", pair.normal_module_mm),
    };
    format!("Gear pair {}/{}, {module} mm", pair.gears.pinion.teeth, pair.gears.wheel.teeth)
}

/// Makes every choice the file leaves open, and writes it into the file.
fn choose(mut file: SceneFile, findings: &mut Findings) -> Option<(Scene, SceneFile)> {
    internal::check_keys(&file, findings);
    let pair = pair::choose(&mut file.pair, findings);
    if let Some(pair) = pair.as_ref().filter(|pair| pair.is_internal()) {
        internal::check_model(&file, pair, findings);
    }
    let has_tooth_temperature = file.temperature.as_ref().is_some_and(|of| of.tooth.is_some());
    let materials = material::choose(&mut file.material, has_tooth_temperature, findings);
    let operation = operation::choose(&mut file.operation, findings);
    let alike = pair.as_ref().is_none_or(|pair| pair.is_alike_over_width() && !slices::has_web(file.fem.as_ref()));
    let contact = settings::contact(&mut file.contact, file.stiffness.as_ref(), alike, findings);
    let surface_by_default = file.contact.as_ref().is_none_or(|contact| contact.surface.is_none());
    let calibration_file = file.contact.as_ref().and_then(|contact| contact.calibration.clone());
    let surface = contact.map(|contact| contact.surface);
    let slices = pair.as_ref().and_then(|pair| slices::choose(&mut file, pair, surface, findings));
    let coupling_by_default = file.helical.as_ref().is_none_or(|helical| helical.coupling.is_none());
    let coupling = slices.map(|slices| slices.coupling);
    let inputs = StiffnessInputs { surface, calibrated: calibration_file.is_some(), coupling };
    let stiffness = settings::stiffness(&mut file.stiffness, inputs, findings);
    let stiffness_by_default = file.stiffness.as_ref().is_none_or(|stiffness| stiffness.model.is_none());
    let stiffness_curve_file = file.stiffness.as_ref().and_then(|stiffness| stiffness.curve.clone());
    let inputs = wear::LawInputs { has_oil: file.lubricant.is_some(), has_tooth_temperature };
    let wear = wear::choose(&mut file.wear, inputs, findings);
    if let (Some(operation), Some(wear)) = (&operation, &wear) {
        wear::check_phases(&file.operation, operation, wear, findings);
    }
    let thermal = materials.as_ref().map(|materials| materials.thermal);
    let laws = wear.as_ref().map(|wear| wear.as_ref().map(|own| own.law));
    let heat = temperature::choose(&mut file, materials.as_ref(), laws, findings);
    if let (true, Some(materials), Some(wear)) = (has_tooth_temperature, &materials, &wear) {
        temperature::check_followers(&file.wear, materials, wear, findings);
    }
    let lubrication = lubrication::choose(&mut file, thermal, findings);
    let fem = pair.as_ref().and_then(|pair| fem::choose(&mut file.fem, file.pair.wheel.as_mut(), pair, findings));
    check_bodies(fem, slices, calibration_file.is_some(), findings);
    let (pair, operation, materials) = (pair?, operation?, materials?);
    let is_severe = wear.as_ref().is_some_and(|wear| wear.may_be_severe());
    let numerics = choose_numerics(&mut file.numerics, contact, slices, is_severe, &operation, findings);
    let verify = *file.numerics.get_or_insert_default().verify.get_or_insert(true);
    if !verify {
        findings.warnings.push("numerics.verify is false: the error against finite elements is unknown".to_owned());
    }
    file.title.get_or_insert_with(|| default_title(&file.pair, &pair));
    let wear_elements_per_half_width =
        fem::wear_elements_per_half_width(file.fem.as_ref(), is_severe, pair.is_internal());
    let mut scene = Scene {
        pair,
        material: materials.elastic,
        modulus: materials.modulus,
        operation,
        contact: contact?,
        surface_by_default,
        calibration_file,
        stiffness: stiffness?,
        stiffness_by_default,
        stiffness_curve_file,
        fem: fem?,
        wear_elements_per_half_width,
        slices,
        coupling_by_default,
        heat: heat?,
        lubrication: lubrication?,
        wear: wear?,
        numerics: numerics?,
        verify,
    };
    scene.warm_up();
    Some((scene, file))
}
