//! Material of each gear: how it deforms and conducts heat.

use super::temperature;
use crate::gear::{Gear, PerGear};
use crate::material::Material;
use crate::scene::file::{GearMaterialFile, MaterialFile, ModulusCurveFile};
use crate::scene::findings::Findings;
use crate::scene::material_presets::MaterialPreset;
use crate::thermal::settings::ThermalMaterial;
use crate::thermal::tooth::TemperatureCurve;

/// Room temperature, °C.
const ROOM_C: f64 = 23.0;

/// The materials of both gears.
pub(super) struct Materials {
    /// How they deform, for now as at room temperature.
    pub elastic: PerGear<Material>,
    /// How they conduct heat.
    pub thermal: PerGear<ThermalMaterial>,
    /// How Young's modulus follows the temperature of the teeth, MPa; none where it is given.
    pub modulus: PerGear<Option<TemperatureCurve>>,
}

/// Chooses what `[material]` leaves open.
pub(super) fn choose(
    file: &mut Option<MaterialFile>,
    has_tooth_temperature: bool,
    findings: &mut Findings,
) -> Option<Materials> {
    let given = file.take().unwrap_or_default();
    let both = GearMaterialFile {
        preset: given.preset,
        young_modulus_GPa: given.young_modulus_GPa,
        young_modulus_curve: given.young_modulus_curve,
        poisson_ratio: given.poisson_ratio,
        density_kg_per_m3: given.density_kg_per_m3,
        thermal_conductivity_W_per_mK: given.thermal_conductivity_W_per_mK,
        thermal_diffusivity_m2_per_s: given.thermal_diffusivity_m2_per_s,
    };
    let mut sound = true;
    for (gear, of_gear) in [("pinion", &given.pinion), ("wheel", &given.wheel)] {
        let Some(own) = of_gear else { continue };
        let keys = ["material.preset".to_owned(), format!("material.{gear}.preset")];
        sound &= !findings.said_twice(&[(&keys[0], both.preset.is_some()), (&keys[1], own.preset.is_some())]);
        for (name, common, own) in [
            ("young_modulus_GPa", both.young_modulus_GPa, own.young_modulus_GPa),
            ("poisson_ratio", both.poisson_ratio, own.poisson_ratio),
            ("density_kg_per_m3", both.density_kg_per_m3, own.density_kg_per_m3),
            ("thermal_conductivity_W_per_mK", both.thermal_conductivity_W_per_mK, own.thermal_conductivity_W_per_mK),
            ("thermal_diffusivity_m2_per_s", both.thermal_diffusivity_m2_per_s, own.thermal_diffusivity_m2_per_s),
        ] {
            let keys = [format!("material.{name}"), format!("material.{gear}.{name}")];
            sound &= !findings.said_twice(&[(&keys[0], common.is_some()), (&keys[1], own.is_some())]);
        }
        let curves = [both.young_modulus_curve.is_some(), own.young_modulus_curve.is_some()];
        let keys = ["material.young_modulus_curve".to_owned(), format!("material.{gear}.young_modulus_curve")];
        sound &= !findings.said_twice(&[(&keys[0], curves[0]), (&keys[1], curves[1])]);
    }
    for (table, of) in [
        ("material", Some(&both)),
        ("material.pinion", given.pinion.as_ref()),
        ("material.wheel", given.wheel.as_ref()),
    ] {
        let Some(of) = of else { continue };
        let keys = ["young_modulus_GPa", "young_modulus_curve"].map(|name| format!("{table}.{name}"));
        let said = [of.young_modulus_GPa.is_some(), of.young_modulus_curve.is_some()];
        sound &= !findings.said_twice(&[(&keys[0], said[0]), (&keys[1], said[1])]);
    }
    let keys = PerGear::from_fn(|gear| {
        let is_own = match gear {
            Gear::Pinion => &given.pinion,
            Gear::Wheel => &given.wheel,
        };
        let is_own = is_own.as_ref().is_some_and(|own| own.young_modulus_curve.is_some());
        if is_own {
            format!("material.{}.young_modulus_curve", gear.name())
        } else {
            "material.young_modulus_curve".to_owned()
        }
    });
    let whole = |own: Option<GearMaterialFile>| {
        let given = over(own.unwrap_or_default(), &both);
        let below = given.preset.unwrap_or(MaterialPreset::Steel).properties();
        over(given, &below)
    };
    let (pinion, wheel) = (whole(given.pinion), whole(given.wheel));
    let curve = |file: &GearMaterialFile, key: &str, findings: &mut Findings| match &file.young_modulus_curve {
        None => Some(None),
        Some(curve) => modulus_curve(curve, key, has_tooth_temperature, findings).map(Some),
    };
    let [of_pinion, of_wheel] = [curve(&pinion, &keys.pinion, findings), curve(&wheel, &keys.wheel, findings)];
    let curves = PerGear { pinion: of_pinion?, wheel: of_wheel? };
    let chosen = PerGear {
        pinion: properties(&pinion, curves.pinion.as_ref())?,
        wheel: properties(&wheel, curves.wheel.as_ref())?,
    };
    *file = Some(MaterialFile { pinion: Some(pinion), wheel: Some(wheel), ..MaterialFile::default() });
    sound.then_some(Materials {
        elastic: chosen.map(|(elastic, _)| elastic),
        thermal: chosen.map(|(_, thermal)| thermal),
        modulus: curves,
    })
}

fn over(above: GearMaterialFile, below: &GearMaterialFile) -> GearMaterialFile {
    GearMaterialFile {
        preset: above.preset.or(below.preset),
        // One stands for the other.
        young_modulus_GPa: above
            .young_modulus_GPa
            .or(below.young_modulus_GPa.filter(|_| above.young_modulus_curve.is_none())),
        young_modulus_curve: above
            .young_modulus_curve
            .or(below.young_modulus_curve.clone().filter(|_| above.young_modulus_GPa.is_none())),
        poisson_ratio: above.poisson_ratio.or(below.poisson_ratio),
        density_kg_per_m3: above.density_kg_per_m3.or(below.density_kg_per_m3),
        thermal_conductivity_W_per_mK: above.thermal_conductivity_W_per_mK.or(below.thermal_conductivity_W_per_mK),
        thermal_diffusivity_m2_per_s: above.thermal_diffusivity_m2_per_s.or(below.thermal_diffusivity_m2_per_s),
    }
}

/// E over temperature, MPa.
fn modulus_curve(
    file: &ModulusCurveFile,
    key: &str,
    has_tooth_temperature: bool,
    findings: &mut Findings,
) -> Option<TemperatureCurve> {
    let values = ("young_modulus_GPa", &file.young_modulus_GPa);
    let in_gpa = temperature::tooth_curve(key, &file.temperature_C, values, has_tooth_temperature, findings)?;
    Some(TemperatureCurve { value: in_gpa.value.into_iter().map(|gpa| 1e3 * gpa).collect(), ..in_gpa })
}

fn properties(file: &GearMaterialFile, curve: Option<&TemperatureCurve>) -> Option<(Material, ThermalMaterial)> {
    let elastic = Material {
        young_modulus_mpa: match curve {
            Some(curve) => curve.at(ROOM_C),
            None => 1e3 * file.young_modulus_GPa?,
        },
        poisson_ratio: file.poisson_ratio?,
        density_kg_per_m3: file.density_kg_per_m3?,
    };
    let thermal = ThermalMaterial {
        conductivity_n_per_s_k: file.thermal_conductivity_W_per_mK?,
        diffusivity_mm2_per_s: 1e6 * file.thermal_diffusivity_m2_per_s?,
    };
    Some((elastic, thermal))
}
