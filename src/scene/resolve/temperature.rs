//! Contact temperatures: only where the wear law reads them or the scene asks for them.

use super::material::Materials;
use crate::scene::file::{OperationFile, SceneFile};
use crate::scene::findings::Findings;
use crate::scene::wear_file::{ToothLubrication, ToothTemperatureFile, WearFile};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::material::Material;
use gearwear_physics::thermal::settings::{ABSOLUTE_ZERO_C, HeatSettings};
use gearwear_physics::thermal::tooth::{DRY_ON_METAL, DRY_ON_PLASTIC, IN_OIL, ToothCoefficients, ToothHeatSettings};
use gearwear_physics::wear::settings::{LawSettings, WearSettings};

const FRICTION_COEFFICIENT: f64 = 0.1;
const BULK_TEMPERATURE_C: f64 = 90.0;

/// Chooses what `[temperature]` leaves open; `Some(None)` where temperatures are not needed.
pub(super) fn choose(
    file: &mut SceneFile,
    materials: Option<&Materials>,
    laws: Option<PerGear<LawSettings>>,
    findings: &mut Findings,
) -> Option<Option<HeatSettings>> {
    let (materials, laws) = (materials?, laws?);
    let reads = Gear::BOTH.into_iter().find(|&gear| laws[gear].reads_temperature());
    if file.temperature.is_none() && reads.is_none() {
        return Some(None);
    }
    let asked_for_by = match reads {
        Some(_) if laws.pinion.name() == laws.wheel.name() => format!("wear.law = {:?}", laws.pinion.name()),
        Some(gear) => format!("wear.{}.law = {:?}", gear.name(), laws[gear].name()),
        None => "[temperature]".to_owned(),
    };
    if !speed_is_given(&file.operation) {
        findings.missing(&["operation.pinion_speed_rpm"], "a number greater than 0");
        findings.help(format!("{asked_for_by} needs the speed"));
        return None;
    }
    let has_mesh_friction = file.friction.is_some() || file.lubricant.is_some();
    let oil_c = file.lubricant.as_ref().and_then(|lubricant| lubricant.temperature_C);
    let file = file.temperature.get_or_insert_default();
    let tooth = match &mut file.tooth {
        None => None,
        Some(tooth) => {
            if file.friction_coefficient.is_none() && !has_mesh_friction {
                findings.missing(&["temperature.friction_coefficient"], "a number greater than 0, at most 2");
                findings.help("[temperature.tooth] needs it; dry plastic on steel has about 0.2, in oil 0.04");
            }
            let chosen = tooth_heat(tooth, &materials.elastic, findings)?;
            Some(ToothHeatSettings { is_bulk: file.bulk_temperature_C.is_none(), ..chosen })
        }
    };
    let is_bulk_of_mesh = tooth.is_none() && file.bulk_temperature_C.is_none() && oil_c.is_some();
    let bulk_c = match (tooth, oil_c) {
        (Some(tooth), _) if tooth.is_bulk => tooth.ambient_c,
        (_, Some(oil_c)) if is_bulk_of_mesh => oil_c,
        _ => *file.bulk_temperature_C.get_or_insert(BULK_TEMPERATURE_C),
    };
    if !has_mesh_friction {
        file.friction_coefficient.get_or_insert(FRICTION_COEFFICIENT);
    }
    Some(Some(HeatSettings {
        method: *file.method.get_or_insert_default(),
        velocity: *file.velocity.get_or_insert_default(),
        partition: *file.partition.get_or_insert_default(),
        friction_coefficient: file.friction_coefficient,
        bulk_temperature_k: bulk_c - ABSOLUTE_ZERO_C,
        is_bulk_of_mesh,
        tooth,
        material: materials.thermal,
    }))
}

fn tooth_heat(
    file: &mut ToothTemperatureFile,
    material: &PerGear<Material>,
    findings: &mut Findings,
) -> Option<ToothHeatSettings> {
    if file.ambient_temperature_C.is_none() {
        findings.missing(&["temperature.tooth.ambient_temperature_C"], "a number from -60 to 250");
    }
    let coefficients = tooth_coefficients(file, material, findings);
    let resistance = *file.housing_resistance_K_m2_per_W.get_or_insert(0.0);
    let housing_k_per_w = match file.housing_area_m2 {
        Some(area) => Some(resistance / area),
        None if resistance == 0.0 => Some(0.0),
        None => {
            findings.missing(&["temperature.tooth.housing_area_m2"], "a number greater than 0, at most 100");
            findings.help("temperature.tooth.housing_resistance_K_m2_per_W needs it");
            None
        }
    };
    Some(ToothHeatSettings {
        ambient_c: file.ambient_temperature_C?,
        coefficients: coefficients?,
        housing_k_per_w: housing_k_per_w?,
        of: with_tooth_temperature(material),
        duty_cycle: *file.duty_cycle.get_or_insert(1.0),
        is_bulk: false,
    })
}

/// Gears of whose teeth VDI 2736-2 has a temperature: the plastic ones; of two metal gears both, whose coefficients the user gives.
pub(super) fn with_tooth_temperature(material: &PerGear<Material>) -> PerGear<bool> {
    let plastic = material.map(|body| body.is_plastic());
    if plastic.pinion || plastic.wheel { plastic } else { PerGear { pinion: true, wheel: true } }
}

/// Refuses dependence on the tooth temperature where there is none.
pub(super) fn check_followers(
    file: &WearFile,
    materials: &Materials,
    wear: &PerGear<WearSettings>,
    findings: &mut Findings,
) {
    let has_temperature = with_tooth_temperature(&materials.elastic);
    let own_wear = PerGear { pinion: file.pinion.as_ref(), wheel: file.wheel.as_ref() };
    for gear in Gear::BOTH.into_iter().filter(|&gear| !has_temperature[gear]) {
        let (name, mate) = (gear.name(), gear.mate().name());
        let found = format!(
            "given for the {name}, of metal beside a plastic {mate}, of whose teeth VDI 2736-2 has no temperature"
        );
        if materials.modulus[gear].is_some() {
            findings.not_allowed(
                &format!("material.{name}.young_modulus_curve"),
                found.clone(),
                format!("material.{name}.young_modulus_GPa"),
            );
        }
        if own_wear[gear].is_some_and(|own| own.warm.is_some()) {
            findings.not_allowed(&format!("wear.{name}.warm"), found, format!("wear.{mate}.warm"));
        } else if wear[gear].warm.is_some() && wear[gear].coefficient_mm2_per_n > 0.0 {
            findings.warnings.push(format!(
                "wear.warm: the {name}, of metal, keeps its coefficient: VDI 2736-2 has the temperature of the plastic {mate} alone"
            ));
        }
    }
}

/// k_θ as given, or by the lubrication of the pair.
fn tooth_coefficients(
    file: &ToothTemperatureFile,
    material: &PerGear<Material>,
    findings: &mut Findings,
) -> Option<ToothCoefficients> {
    let keys = ["lubrication", "flank_heat_coefficient", "root_heat_coefficient"];
    let [lubrication, flank, root] = keys.map(|key| format!("temperature.tooth.{key}"));
    let (of_flank, of_root) = (file.flank_heat_coefficient, file.root_heat_coefficient);
    let one = if of_flank.is_some() { &flank } else { &root };
    if findings.said_twice(&[(&lubrication, file.lubrication.is_some()), (one, of_flank.or(of_root).is_some())]) {
        return None;
    }
    let plastic = material.map(|body| body.is_plastic());
    match (file.lubrication, of_flank, of_root) {
        (None, Some(flank), Some(root)) => Some(ToothCoefficients { flank, root }),
        (None, None, None) => {
            findings.missing(&[&lubrication, &flank], "\"dry\" or \"oil\"");
            None
        }
        (None, given, _) => {
            let lacking = if given.is_some() { &root } else { &flank };
            findings.missing(&[lacking], "a number from 0 to 50000");
            findings.help("flank and root have coefficients of their own");
            None
        }
        (Some(ToothLubrication::Oil), ..) => Some(IN_OIL),
        (Some(ToothLubrication::Dry), ..) if plastic.pinion && plastic.wheel => Some(DRY_ON_PLASTIC),
        (Some(ToothLubrication::Dry), ..) if plastic.pinion || plastic.wheel => Some(DRY_ON_METAL),
        (Some(ToothLubrication::Dry), ..) => {
            findings.not_allowed(&lubrication, "\"dry\" with two gears of metal", "\"oil\"");
            findings.help("the coefficients are those of plastic gears; others may be given as flank_heat_coefficient and root_heat_coefficient");
            None
        }
    }
}

/// Whether every phase has a speed.
pub(super) fn speed_is_given(operation: &OperationFile) -> bool {
    let phases = operation.phases.as_ref();
    operation.pinion_speed_rpm.is_some()
        || phases.is_some_and(|phases| phases.iter().all(|phase| phase.pinion_speed_rpm.is_some()))
}
