//! Material of each gear: elastic and thermal.

use super::curve;
use crate::scene::file::{GearMaterialFile, MaterialFile, MaterialPreset, ModulusCurveFile};
use crate::scene::findings::Findings;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::material::Material;
use gearwear_physics::thermal::settings::ThermalMaterial;
use gearwear_physics::thermal::tooth::TemperatureCurve;

/// Room temperature, °C.
const ROOM_C: f64 = 23.0;

/// The materials of both gears.
pub(super) struct Materials {
    /// Elastic materials, at first at room temperature.
    pub elastic: PerGear<Material>,
    /// Thermal materials.
    pub thermal: PerGear<ThermalMaterial>,
    /// Young's modulus over the temperature of the teeth, MPa; `None` where it is a constant.
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
    let sound = is_said_once(&both, [given.pinion.as_ref(), given.wheel.as_ref()], findings);
    let of_gears = [(Gear::Pinion, given.pinion), (Gear::Wheel, given.wheel)].map(|(gear, own)| {
        let table = match &own {
            Some(own) if own.young_modulus_curve.is_some() => format!("material.{}", gear.name()),
            _ => "material".to_owned(),
        };
        let own = over(own.unwrap_or_default(), &both);
        let preset = own.preset.unwrap_or(MaterialPreset::Steel).properties();
        let whole = over(own, &preset);
        let curve = match &whole.young_modulus_curve {
            None => Some(None),
            Some(curve) => {
                let key = format!("{table}.young_modulus_curve");
                modulus_curve(curve, &key, has_tooth_temperature, findings).map(Some)
            }
        };
        (whole, curve)
    });
    let [(pinion, of_pinion), (wheel, of_wheel)] = of_gears;
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

/// Whether no constant is given twice: for both gears and for one of them, or as a value and as a curve.
fn is_said_once(both: &GearMaterialFile, own: [Option<&GearMaterialFile>; 2], findings: &mut Findings) -> bool {
    let mut sound = true;
    for (gear, own) in ["pinion", "wheel"].into_iter().zip(own) {
        let Some(own) = own else { continue };
        for ((name, of_both), (_, of_own)) in given_constants(both).into_iter().zip(given_constants(own)) {
            let keys = [format!("material.{name}"), format!("material.{gear}.{name}")];
            sound &= !findings.said_twice(&[(&keys[0], of_both), (&keys[1], of_own)]);
        }
    }
    let tables = ["material", "material.pinion", "material.wheel"];
    for (table, of) in tables.into_iter().zip([Some(both), own[0], own[1]]) {
        let Some(of) = of else { continue };
        let keys = ["young_modulus_GPa", "young_modulus_curve"].map(|name| format!("{table}.{name}"));
        let said = [of.young_modulus_GPa.is_some(), of.young_modulus_curve.is_some()];
        sound &= !findings.said_twice(&[(&keys[0], said[0]), (&keys[1], said[1])]);
    }
    sound
}

/// Names of the constants, and whether each is given.
fn given_constants(of: &GearMaterialFile) -> [(&'static str, bool); 7] {
    [
        ("preset", of.preset.is_some()),
        ("young_modulus_GPa", of.young_modulus_GPa.is_some()),
        ("poisson_ratio", of.poisson_ratio.is_some()),
        ("density_kg_per_m3", of.density_kg_per_m3.is_some()),
        ("thermal_conductivity_W_per_mK", of.thermal_conductivity_W_per_mK.is_some()),
        ("thermal_diffusivity_m2_per_s", of.thermal_diffusivity_m2_per_s.is_some()),
        ("young_modulus_curve", of.young_modulus_curve.is_some()),
    ]
}

fn over(above: GearMaterialFile, below: &GearMaterialFile) -> GearMaterialFile {
    GearMaterialFile {
        preset: above.preset.or(below.preset),
        // Young's modulus is a constant or a curve: giving one replaces the other.
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

/// Young's modulus over temperature, MPa.
fn modulus_curve(
    file: &ModulusCurveFile,
    key: &str,
    has_tooth_temperature: bool,
    findings: &mut Findings,
) -> Option<TemperatureCurve> {
    let values = ("young_modulus_GPa", &file.young_modulus_GPa);
    let in_gpa = curve::tooth_curve(key, &file.temperature_C, values, has_tooth_temperature, findings)?;
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
