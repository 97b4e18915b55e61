//! Oil, friction and load factors: only where the scene asks for films or losses.

use super::curve;
use crate::scene::file::{PairFile, SceneFile};
use crate::scene::findings::Findings;
use crate::scene::lubrication_file::{LoadFactorsFile, LubricantFile};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::lubrication::settings::{
    BaseOil, FrictionModel, FrictionSettings, FrictionTable, LoadFactors, LubricantSettings, LubricationSettings,
    OilSettings, PressureViscosity, Roughness, ScuffingSettings,
};
use gearwear_physics::thermal::settings::ThermalMaterial;

/// ISO VG and the viscosity at 100 °C, mm²/s, of a mineral oil of viscosity index 95 (ISO 3448, ASTM D2270), to the digits in which that is
/// usual.
const CLASSES: [(u32, f64); 13] = [
    (10, 2.5),
    (15, 3.3),
    (22, 4.2),
    (32, 5.3),
    (46, 6.7),
    (68, 8.6),
    (100, 11.1),
    (150, 14.7),
    (220, 18.8),
    (320, 24.0),
    (460, 30.4),
    (680, 39.0),
    (1000, 49.2),
];
/// Rq over Ra of heights that are spread normally, √(π/2).
const RQ_OVER_RA: f64 = 1.253_314_137_315_5;
/// Pole of the roughness term of Benedict and Kelley's friction, µm.
const ROUGHEST_OF_BENEDICT_KELLEY_UM: f64 = 1.27;

/// Chooses what the tables leave open; `Some(None)` where neither films nor losses are needed.
pub(super) fn choose(
    file: &mut SceneFile,
    material: Option<PerGear<ThermalMaterial>>,
    findings: &mut Findings,
) -> Option<Option<LubricationSettings>> {
    if file.lubricant.is_none() && file.friction.is_none() {
        if file.load_factors.is_some() {
            findings.unused(
                "[load_factors]",
                "only films and losses read it, and there is neither [lubricant] nor [friction]",
            );
        }
        if rough(&file.pair) {
            findings
                .unused("the roughness of the gears", "only films and friction read it, and there is no [lubricant]");
        }
        return Some(None);
    }
    let asked_for_by = if file.lubricant.is_some() { "[lubricant]" } else { "[friction]" };
    if !super::temperature::speed_is_given(&file.operation) {
        findings.missing(&["operation.pinion_speed_rpm"], "a number greater than 0");
        findings.help(format!("{asked_for_by} needs the speed"));
        return None;
    }
    let friction = friction(file, findings);
    let lubricant = match &mut file.lubricant {
        None => Some(None),
        Some(lubricant) => self::lubricant(lubricant, &mut file.pair, material, findings).map(Some),
    };
    let load_factors = load_factors(file.load_factors.get_or_insert_default());
    let (friction, lubricant) = (friction?, lubricant?);
    if let Some(lubricant) = lubricant
        && friction.model == FrictionModel::BenedictKelley
    {
        for gear in Gear::BOTH {
            let ra_um = lubricant.roughness[gear].ra_um.max(lubricant.roughness[gear].run_in_ra_um);
            if ra_um >= ROUGHEST_OF_BENEDICT_KELLEY_UM {
                let key = format!("pair.{}.roughness_Ra_um", gear.name());
                findings.not_allowed(
                    &key,
                    format!("{ra_um} with friction.model = \"benedict-kelley\""),
                    format!("less than {ROUGHEST_OF_BENEDICT_KELLEY_UM}, where that formula has its pole"),
                );
                return None;
            }
        }
    }
    Some(Some(LubricationSettings { lubricant, friction, load_factors }))
}

fn rough(pair: &PairFile) -> bool {
    Gear::BOTH.into_iter().filter_map(|gear| pair.gear(gear)).any(|gear| {
        gear.roughness_Ra_um.is_some() || gear.roughness_run_in_Ra_um.is_some() || gear.roughness_Rq_um.is_some()
    })
}

fn friction(file: &mut SceneFile, findings: &mut Findings) -> Option<FrictionSettings> {
    let has_oil = file.lubricant.is_some();
    let friction = file.friction.get_or_insert_default();
    let by_default = if friction.table.is_some() { FrictionModel::Table } else { FrictionModel::default() };
    let model = *friction.model.get_or_insert(by_default);
    match (model, friction.coefficient) {
        (FrictionModel::Constant, None) => {
            findings.missing(&["friction.coefficient"], "a number greater than 0, at most 2");
            findings.help("friction.model = \"constant\" needs it");
            return None;
        }
        (FrictionModel::Constant, Some(_)) | (_, None) => {}
        (_, Some(_)) => {
            findings.unused("friction.coefficient", "only friction.model = \"constant\" reads it");
        }
    }
    let table = match (model, &friction.table) {
        (FrictionModel::Table, given) => {
            let given = given.clone().unwrap_or_default();
            let [slide_to_roll_ratio, coefficient] = curve::choose(
                ("friction.table.slide_to_roll_ratio", &given.slide_to_roll_ratio),
                ("friction.table.coefficient", &given.coefficient),
                findings,
            )?;
            Some(FrictionTable { slide_to_roll_ratio, coefficient })
        }
        (_, None) => None,
        (_, Some(_)) => {
            findings.unused("[friction.table]", "only friction.model = \"table\" reads it");
            None
        }
    };
    if !matches!(model, FrictionModel::Constant | FrictionModel::Table) && !has_oil {
        findings.missing(&["lubricant.temperature_C"], "a number from -60 to 250");
        findings.help(format!(
            "friction.model = {:?} needs the table [lubricant]; \"constant\" and \"table\" do without",
            model.name()
        ));
        return None;
    }
    Some(FrictionSettings { model, coefficient: friction.coefficient, table })
}

fn lubricant(
    file: &mut LubricantFile,
    pair: &mut PairFile,
    material: Option<PerGear<ThermalMaterial>>,
    findings: &mut Findings,
) -> Option<LubricantSettings> {
    let oil = oil(file, findings);
    if file.temperature_C.is_none() {
        findings.missing(&["lubricant.temperature_C"], "a number from -60 to 250");
    }
    let supply = *file.supply.get_or_insert_default();
    let central_film = *file.central_film.get_or_insert_default();
    let roughness = PerGear::from_fn(|gear| roughness(pair, gear, findings));
    let (oil, temperature_c, material) = (oil?, file.temperature_C?, material?);
    Some(LubricantSettings {
        oil,
        temperature_c,
        bulk_temperature_c: file.bulk_temperature_C,
        supply,
        central_film,
        lubricant_factor: file.lubricant_factor,
        permissible_lambda: file.permissible_lambda,
        scuffing: ScuffingSettings {
            fzg_load_stage: file.fzg_scuffing_load_stage,
            structural_factor: *file.structural_factor.get_or_insert(1.0),
            relative_run_in: *file.relative_run_in.get_or_insert(1.0),
        },
        roughness: PerGear { pinion: roughness.pinion?, wheel: roughness.wheel? },
        // λ/√κ is √(λ ρ c).
        thermal_contact_w_s05_per_m2_k: material
            .map(|heat| heat.conductivity_n_per_s_k / (1e-6 * heat.diffusivity_mm2_per_s).sqrt()),
    })
}

fn oil(file: &mut LubricantFile, findings: &mut Findings) -> Option<OilSettings> {
    let viscosities = viscosities(file, findings);
    let base = *file.base.get_or_insert_default();
    let usual_density = match base {
        BaseOil::Mineral => 890.0,
        BaseOil::Polyalphaolefin => 850.0,
        BaseOil::Polyglycol => 1050.0,
    };
    let density_15c_kg_per_m3 = *file.density_15C_kg_per_m3.get_or_insert(usual_density);
    let fit_and_value = [
        ("lubricant.pressure_viscosity", file.pressure_viscosity.is_some()),
        ("lubricant.pressure_viscosity_per_GPa", file.pressure_viscosity_per_GPa.is_some()),
    ];
    let twice = findings.said_twice(&fit_and_value);
    let pressure_viscosity = match file.pressure_viscosity_per_GPa {
        Some(per_gpa) => PressureViscosity::Given { per_gpa },
        None => PressureViscosity::Fit(*file.pressure_viscosity.get_or_insert_default()),
    };
    let fit = *file.viscosity_fit.get_or_insert_default();
    let [viscosity_40c_mm2_per_s, viscosity_100c_mm2_per_s] = viscosities.filter(|_| !twice)?;
    Some(OilSettings {
        viscosity_40c_mm2_per_s,
        viscosity_100c_mm2_per_s,
        fit,
        base,
        density_15c_kg_per_m3,
        pressure_viscosity,
    })
}

/// ν₄₀ and ν₁₀₀, mm²/s.
fn viscosities(file: &mut LubricantFile, findings: &mut Findings) -> Option<[f64; 2]> {
    let keys = [
        ("lubricant.viscosity_class", file.viscosity_class.is_some()),
        ("lubricant.viscosity_40C_mm2_per_s", file.viscosity_40C_mm2_per_s.is_some()),
    ];
    if findings.said_twice(&keys) {
        return None;
    }
    if let Some(class) = file.viscosity_class.take() {
        let Some((_, usual)) = CLASSES.iter().find(|(number, _)| *number == class) else {
            let classes: Vec<String> = CLASSES.iter().map(|(number, _)| number.to_string()).collect();
            findings.not_allowed("lubricant.viscosity_class", class.to_string(), classes.join(", "));
            return None;
        };
        file.viscosity_40C_mm2_per_s = Some(f64::from(class));
        if file.viscosity_100C_mm2_per_s.is_none() {
            file.viscosity_100C_mm2_per_s = Some(*usual);
            findings.warnings.push(format!(
                "lubricant.viscosity_class = {class}: {usual} mm²/s at 100 °C as of a mineral oil of viscosity index 95; give \
                 lubricant.viscosity_100C_mm2_per_s of the oil itself"
            ));
        }
    }
    let Some(cold) = file.viscosity_40C_mm2_per_s else {
        findings.missing(&["lubricant.viscosity_class", "lubricant.viscosity_40C_mm2_per_s"], "a class of ISO VG");
        return None;
    };
    let Some(hot) = file.viscosity_100C_mm2_per_s else {
        findings.missing(&["lubricant.viscosity_100C_mm2_per_s"], "a number from 1 to 10000");
        return None;
    };
    if hot >= cold {
        findings.not_allowed(
            "lubricant.viscosity_100C_mm2_per_s",
            format!("{hot}, with {cold} at 40 °C"),
            format!("less than {cold}: oil thins when it gets warm"),
        );
        return None;
    }
    Some([cold, hot])
}

fn roughness(pair: &mut PairFile, gear: Gear, findings: &mut Findings) -> Option<Roughness> {
    let name = gear.name();
    let own = match gear {
        Gear::Pinion => pair.pinion.get_or_insert_default(),
        Gear::Wheel => pair.wheel.get_or_insert_default(),
    };
    let Some(ra_um) = own.roughness_Ra_um else {
        findings.missing(&[&format!("pair.{name}.roughness_Ra_um")], "a number greater than 0, at most 50");
        findings.help("[lubricant] asks for films, which are compared with the roughness of the flanks");
        return None;
    };
    Some(Roughness {
        ra_um,
        run_in_ra_um: *own.roughness_run_in_Ra_um.get_or_insert(ra_um),
        rq_um: *own.roughness_Rq_um.get_or_insert(RQ_OVER_RA * ra_um),
    })
}

fn load_factors(file: &mut LoadFactorsFile) -> LoadFactors {
    LoadFactors {
        application: *file.application.get_or_insert(1.0),
        dynamic: *file.dynamic.get_or_insert(1.0),
        transverse: *file.transverse.get_or_insert(1.0),
        face: *file.face.get_or_insert(1.0),
    }
}
