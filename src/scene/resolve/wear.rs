//! The wear law of each gear and its constants: `[wear]` holds for both gears unless a gear's own table overrides it.

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Table;

use super::curve;
use crate::scene::file::OperationFile;
use crate::scene::findings::Findings;
use crate::scene::problem::number;
use crate::scene::wear_file::{
    AdsorptionFile, FilmFile, FilmLaw, GearWearFile, OxidationFile, WarmFile, WearFile, WearLaw,
};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::lubrication::settings::FilmRatio;
use gearwear_physics::simulation::settings::Operation;
use gearwear_physics::wear::{
    adsorption::AdsorptionConstants,
    oxidation::OxidationConstants,
    settings::{FilmDependence, LawSettings, SevereTransition, WearSettings},
};

// The typical constants of `wear::adsorption` and `wear::oxidation`, in the units of the file.
const MOLECULE_DIAMETER_NM: f64 = 0.3;
const VIBRATION_TIME_PS: f64 = 3.0;
const HEAT_OF_ADSORPTION_KJ_PER_MOL: f64 = 48.0;
const ARRHENIUS_CONSTANT_KG_PER_M2S: f64 = 1e3;
const ACTIVATION_ENERGY_KJ_PER_MOL: f64 = 100.0;
const IRON_KG_PER_M3: f64 = 7870.0;

/// Alternative keys of the coefficient.
const COEFFICIENTS: [&str; 2] = ["coefficient_m2_per_N", "coefficient_mm3_per_Nm"];
/// The names of the laws.
const LAWS: &str = "\"archard\", \"adsorption\" or \"oxidation\"";

/// Inputs of wear laws from other tables of the scene.
#[derive(Clone, Copy)]
pub(super) struct LawInputs {
    /// `[lubricant]`.
    pub has_oil: bool,
    /// `[temperature.tooth]`.
    pub has_tooth_temperature: bool,
}

/// Chooses the wear law of each gear.
pub(super) fn choose(file: &mut WearFile, given: LawInputs, findings: &mut Findings) -> Option<PerGear<WearSettings>> {
    let keys = COEFFICIENTS.map(|name| format!("wear.{name}"));
    let keys = keys.each_ref().map(String::as_str);
    let of_both = coefficient_mm2_per_n(keys, file.coefficient_m2_per_N, file.coefficient_mm3_per_Nm, findings)?;
    let mut wholes = PerGear::from_fn(|gear| whole(file, gear));
    warn_of_unused(file, &wholes, findings);
    if wholes.pinion.law.is_none() && wholes.wheel.law.is_none() {
        findings.missing(&["wear.law"], LAWS);
    }
    if of_both.is_none() && Gear::BOTH.iter().all(|&gear| !gives_coefficient(&wholes[gear])) {
        findings.missing(&keys, "a number greater than 0");
    }
    let [pinion, wheel] = Gear::BOTH.map(|gear| {
        let own = match gear {
            Gear::Pinion => &file.pinion,
            Gear::Wheel => &file.wheel,
        };
        let [film_key, warm_key] = [
            ("film", own.as_ref().is_some_and(|own| own.film.is_some())),
            ("warm", own.as_ref().is_some_and(|own| own.warm.is_some())),
        ]
        .map(|(name, is_own)| if is_own { format!("wear.{}.{name}", gear.name()) } else { format!("wear.{name}") });
        let film = film(&film_key, &mut wholes[gear].film, given.has_oil, findings);
        let warm = match &wholes[gear].warm {
            None => Some(None),
            Some(WarmFile { temperature_C, factor }) => {
                let (values, has_tooth) = (("factor", factor), given.has_tooth_temperature);
                curve::tooth_curve(&warm_key, temperature_C, values, has_tooth, findings).map(Some)
            }
        };
        Some(WearSettings { film: film?, warm: warm?, ..of_gear(&mut wholes[gear], gear, findings)? })
    });
    let settings = PerGear { pinion: pinion?, wheel: wheel? };
    if Gear::BOTH.iter().all(|&gear| settings[gear].coefficient_mm2_per_n <= 0.0) {
        let in_mm3 = wholes.wheel.coefficient_mm3_per_Nm.is_some();
        let key = format!("wear.wheel.{}", COEFFICIENTS[usize::from(in_mm3)]);
        findings.not_allowed(&key, "0 for both gears", "a number greater than 0 for one gear at least");
        return None;
    }
    if file.pinion.is_some() || file.wheel.is_some() {
        *file = WearFile { pinion: Some(wholes.pinion), wheel: Some(wholes.wheel), ..WearFile::default() };
    } else {
        let GearWearFile { severe, film, warm, adsorption, oxidation, .. } = wholes.pinion;
        (file.severe, file.film, file.warm) = (severe, film, warm);
        (file.adsorption, file.oxidation) =
            (adsorption.or(file.adsorption.take()), oxidation.or(file.oxidation.take()));
    }
    Some(settings)
}

/// Law of `gear` from `[wear]` and its own table together; constants of its own law only.
fn whole(file: &WearFile, gear: Gear) -> GearWearFile {
    let own = match gear {
        Gear::Pinion => &file.pinion,
        Gear::Wheel => &file.wheel,
    };
    let own = own.clone().unwrap_or_default();
    let law = own.law.or(file.law);
    let coefficients = match gives_coefficient(&own) {
        true => [own.coefficient_m2_per_N, own.coefficient_mm3_per_Nm],
        false => [file.coefficient_m2_per_N, file.coefficient_mm3_per_Nm],
    };
    GearWearFile {
        law,
        coefficient_m2_per_N: coefficients[0],
        coefficient_mm3_per_Nm: coefficients[1],
        severe: own.severe.or(file.severe.clone()),
        film: own.film.or(file.film.clone()),
        warm: own.warm.or(file.warm.clone()),
        adsorption: (law == Some(WearLaw::Adsorption)).then(|| overlaid(own.adsorption, &file.adsorption)),
        oxidation: (law == Some(WearLaw::Oxidation)).then(|| overlaid(own.oxidation, &file.oxidation)),
    }
}

/// Constants of a law of one gear: each key of `own`, otherwise of `both`.
fn overlaid<T: Clone + Default + Serialize + DeserializeOwned>(own: Option<T>, both: &Option<T>) -> T {
    let Some(own) = own else { return both.clone().unwrap_or_default() };
    let table = |of: &T| Table::try_from(of).expect("constants are a table");
    let mut keys = both.as_ref().map(table).unwrap_or_default();
    keys.extend(table(&own));
    keys.try_into().expect("their keys are known")
}

fn gives_coefficient(of: &GearWearFile) -> bool {
    of.coefficient_m2_per_N.is_some() || of.coefficient_mm3_per_Nm.is_some()
}

/// The law of one gear, whose defaults are written into its table.
fn of_gear(file: &mut GearWearFile, gear: Gear, findings: &mut Findings) -> Option<WearSettings> {
    let table = format!("wear.{}", gear.name());
    let keys = COEFFICIENTS.map(|name| format!("{table}.{name}"));
    let keys = keys.each_ref().map(String::as_str);
    let given = coefficient_mm2_per_n(keys, file.coefficient_m2_per_N, file.coefficient_mm3_per_Nm, findings)?;
    if file.law.is_none() {
        findings.missing(&[&format!("{table}.law"), "wear.law"], LAWS);
    }
    if given.is_none() {
        let [m2, mm3] = COEFFICIENTS.map(|name| format!("wear.{name}"));
        findings.missing(&[keys[0], keys[1], &m2, &mm3], "a number, 0 or more");
    }
    let (law, coefficient_mm2_per_n) = (file.law?, given?);
    let law = match law {
        WearLaw::Archard => LawSettings::Archard,
        WearLaw::Adsorption => LawSettings::Adsorption(adsorption(file.adsorption.get_or_insert_default())),
        WearLaw::Oxidation => LawSettings::Oxidation(oxidation(file.oxidation.get_or_insert_default())),
    };
    let severe = file.severe.as_mut().map(|severe| SevereTransition {
        above_mpa: severe.above_MPa,
        factor: severe.factor,
        band_mpa: *severe.band_MPa.get_or_insert(SevereTransition::DEFAULT_BAND * severe.above_MPa),
    });
    Some(WearSettings { law, coefficient_mm2_per_n, severe, film: None, warm: None })
}

/// Dependence of wear on the film in the table `key`; `Some(None)` where there is none.
fn film(
    key: &str,
    file: &mut Option<FilmFile>,
    has_oil: bool,
    findings: &mut Findings,
) -> Option<Option<FilmDependence>> {
    let Some(file) = file else { return Some(None) };
    let is_table = file.lambda.is_some() || file.factor.is_some();
    let (lambda_key, factor_key) = (format!("{key}.lambda"), format!("{key}.factor"));
    let law = match file.law {
        Some(law) => law,
        None if is_table => *file.law.insert(FilmLaw::Table),
        None => {
            findings.missing(&[&format!("{key}.law")], "\"priest-taylor\", \"table\" or \"none\"");
            return None;
        }
    };
    if is_table && law != FilmLaw::Table {
        findings.unused(&format!("{key}.lambda and factor"), &format!("only {key}.law = \"table\" reads them"));
    }
    if law == FilmLaw::None {
        return Some(None);
    }
    let ratio = *file.ratio.get_or_insert(FilmRatio::Composite);
    let film = match law {
        FilmLaw::PriestTaylor => FilmDependence::priest_taylor(ratio),
        _ => {
            let [lambda, factor] = curve::choose((&lambda_key, &file.lambda), (&factor_key, &file.factor), findings)?;
            FilmDependence { ratio, lambda, factor }
        }
    };
    if film.factor.iter().all(|&factor| factor <= 0.0) {
        findings.not_allowed(&factor_key, "0 at every film", "a number greater than 0 at one at least");
        return None;
    }
    if !has_oil {
        findings.missing(&["lubricant.temperature_C"], "a number from -60 to 250");
        findings.help(format!("[{key}] needs the table [lubricant]"));
        return None;
    }
    Some(Some(film))
}

/// Warns of constants of laws by which no gear that they are given for wears.
fn warn_of_unused(file: &WearFile, wholes: &PerGear<GearWearFile>, findings: &mut Findings) {
    let own = [(&[Gear::Pinion][..], "wear.pinion", &file.pinion), (&[Gear::Wheel], "wear.wheel", &file.wheel)].map(
        |(used, table, own)| Some((used, table, own.as_ref()?.adsorption.is_some(), own.as_ref()?.oxidation.is_some())),
    );
    let both = (&Gear::BOTH[..], "wear", file.adsorption.is_some(), file.oxidation.is_some());
    for (used, table, adsorption, oxidation) in [Some(both)].into_iter().chain(own).flatten() {
        for (law, name, given) in
            [(WearLaw::Adsorption, "adsorption", adsorption), (WearLaw::Oxidation, "oxidation", oxidation)]
        {
            if given && used.iter().all(|&gear| wholes[gear].law != Some(law)) {
                findings.warnings.push(format!("[{table}.{name}] is not used: only {table}.law = \"{name}\" reads it"));
            }
        }
    }
}

/// Checks the coefficients of phases against the law of each gear.
pub(super) fn check_phases(
    file: &OperationFile,
    operation: &Operation,
    wear: &PerGear<WearSettings>,
    findings: &mut Findings,
) {
    let differ = wear.pinion.coefficient_mm2_per_n != wear.wheel.coefficient_mm2_per_n;
    for (index, (given, phase)) in file.phases.iter().flatten().zip(&operation.phases).enumerate() {
        let [in_m2, in_mm3] = COEFFICIENTS.map(|name| format!("operation.phases[{index}].{name}"));
        let own = [&given.pinion, &given.wheel].map(|gear| {
            gear.as_ref().is_some_and(|own| own.coefficient_m2_per_N.or(own.coefficient_mm3_per_Nm).is_some())
        });
        if let Some(found) = given.coefficient_m2_per_N.or(given.coefficient_mm3_per_Nm)
            && differ
            && own != [true; 2]
        {
            let allowed =
                "one for each gear, in its pinion and wheel, since those of [wear.pinion] and [wear.wheel] differ";
            let key = if given.coefficient_m2_per_N.is_none() { &in_mm3 } else { &in_m2 };
            findings.not_allowed(key, number(found), allowed);
        }
        let coefficients =
            Gear::BOTH.map(|gear| phase.coefficient_mm2_per_n[gear].unwrap_or(wear[gear].coefficient_mm2_per_n));
        if coefficients.iter().all(|&coefficient| coefficient <= 0.0) {
            let allowed = "a number greater than 0 for one gear at least";
            findings.not_allowed(&in_m2, "0 for both gears", allowed);
        }
    }
}

/// Coefficient in one of two units; `Some(None)` where it is not given.
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
