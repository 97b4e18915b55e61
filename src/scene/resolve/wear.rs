//! The wear law and its constants.

use crate::scene::findings::Findings;
use crate::scene::wear_file::{AdsorptionFile, OxidationFile, WearFile, WearLaw};
use crate::wear::{
    adsorption::AdsorptionConstants,
    oxidation::OxidationConstants,
    settings::{LawSettings, SevereTransition, WearSettings},
};

// The typical constants of `wear::adsorption` and `wear::oxidation`, in the units of the file.
const MOLECULE_DIAMETER_NM: f64 = 0.3;
const VIBRATION_TIME_PS: f64 = 3.0;
const HEAT_OF_ADSORPTION_KJ_PER_MOL: f64 = 48.0;
const ARRHENIUS_CONSTANT_KG_PER_M2S: f64 = 1e3;
const ACTIVATION_ENERGY_KJ_PER_MOL: f64 = 100.0;
const IRON_KG_PER_M3: f64 = 7870.0;

/// Chooses the wear law.
pub(super) fn choose(file: &mut WearFile, findings: &mut Findings) -> Option<WearSettings> {
    let keys = ["wear.coefficient_m2_per_N", "wear.coefficient_mm3_per_Nm"];
    let given = coefficient_mm2_per_n(keys, file.coefficient_m2_per_N, file.coefficient_mm3_per_Nm, findings)?;
    let Some(coefficient_mm2_per_n) = given else {
        findings.missing(&keys, "a number greater than 0");
        return None;
    };
    for (key, used, given) in [
        ("wear.adsorption", file.law == WearLaw::Adsorption, file.adsorption.is_some()),
        ("wear.oxidation", file.law == WearLaw::Oxidation, file.oxidation.is_some()),
    ] {
        if given && !used {
            let law = key.trim_start_matches("wear.");
            findings.warnings.push(format!("[{key}] is not used: only wear.law = \"{law}\" reads it"));
        }
    }
    let law = match file.law {
        WearLaw::Archard => LawSettings::Archard,
        WearLaw::Adsorption => LawSettings::Adsorption(adsorption(file.adsorption.get_or_insert_default())),
        WearLaw::Oxidation => LawSettings::Oxidation(oxidation(file.oxidation.get_or_insert_default())),
    };
    let severe = file.severe.as_mut().map(|severe| SevereTransition {
        above_mpa: severe.above_MPa,
        factor: severe.factor,
        band_mpa: *severe.band_MPa.get_or_insert(0.0),
    });
    Some(WearSettings { law, coefficient_mm2_per_n, severe })
}

/// A coefficient said in one of two units; `Some(None)` where in neither.
pub(super) fn coefficient_mm2_per_n(
    keys: [&str; 2],
    m2_per_n: Option<f64>,
    mm3_per_nm: Option<f64>,
    findings: &mut Findings,
) -> Option<Option<f64>> {
    if findings.said_twice(&[(keys[0], m2_per_n.is_some()), (keys[1], mm3_per_nm.is_some())]) {
        return None;
    }
    Some(m2_per_n.map(|k| 1e6 * k).or(mm3_per_nm.map(|k| 1e-3 * k)))
}

fn adsorption(file: &mut AdsorptionFile) -> AdsorptionConstants {
    AdsorptionConstants {
        molecule_diameter_mm: *file.molecule_diameter_nm.get_or_insert(MOLECULE_DIAMETER_NM) / 1e6,
        vibration_time_s: *file.vibration_time_ps.get_or_insert(VIBRATION_TIME_PS) / 1e12,
        heat_of_adsorption_j_per_mol: 1e3
            * *file.heat_of_adsorption_kJ_per_mol.get_or_insert(HEAT_OF_ADSORPTION_KJ_PER_MOL),
    }
}

fn oxidation(file: &mut OxidationFile) -> OxidationConstants {
    OxidationConstants {
        arrhenius_constant_kg_per_m2_s: *file
            .arrhenius_constant_kg_per_m2s
            .get_or_insert(ARRHENIUS_CONSTANT_KG_PER_M2S),
        activation_energy_j_per_mol: 1e3
            * *file.activation_energy_kJ_per_mol.get_or_insert(ACTIVATION_ENERGY_KJ_PER_MOL),
        density_kg_per_m3: *file.density_kg_per_m3.get_or_insert(IRON_KG_PER_M3),
        mass_ratio: *file.mass_ratio.get_or_insert_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_the_typical_constants() {
        assert_eq!(adsorption(&mut AdsorptionFile::default()), AdsorptionConstants::TYPICAL);
        assert_eq!(oxidation(&mut OxidationFile::default()), OxidationConstants::TYPICAL);
    }
}
