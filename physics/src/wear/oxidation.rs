//! Wear of an oxide that grows linearly.
//!
//! Iron turns into Fe₂O₃ at the rate A_l exp(−Q_l/(R T)) of oxygen per area; the oxide that grows in a contact is rubbed off in it:
//!
//! ```text
//! dh = k_r p · A_l/(v ρ_Fe) · m · exp(−Q_l/(R T)) ds
//! ```
//!
//! with m the mass of iron per mass of oxygen. In Fe₂O₃ that is 4 M_Fe/(3 M_O₂) = 2.327: so the uptake of oxygen, in kg/(m² s), gives
//! the depth of iron that is consumed. The thesis's equation 21 prints 3 M_O₂/(4 M_Fe) = 0.430, its inverse, which no balance
//! of masses gives; it is 5.4 times less and can be chosen ([`MassRatio`]).
//!
//! Source: T. F. J. Quinn (1962); the thesis, equations 20–25, which hold for contact temperatures of about 200 to 400 °C.

use super::{ContactConditions, LawConstants, LocalContact, WearLaw, adsorption::MOLAR_GAS_CONSTANT};

/// M_Fe, g/mol.
const IRON: f64 = 55.845;
/// M_O₂, g/mol.
const OXYGEN: f64 = 31.998;

/// Mass of iron per mass of oxygen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MassRatio {
    /// 4 M_Fe/(3 M_O₂), by the stoichiometry of Fe₂O₃.
    #[default]
    Stoichiometric,
    /// 3 M_O₂/(4 M_Fe), as the thesis prints it, 5.4 times less.
    Thesis,
}

impl MassRatio {
    /// m.
    pub fn value(self) -> f64 {
        let iron_per_oxygen = 4.0 * IRON / (3.0 * OXYGEN);
        match self {
            MassRatio::Stoichiometric => iron_per_oxygen,
            MassRatio::Thesis => 1.0 / iron_per_oxygen,
        }
    }
}

/// Constants of the reaction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OxidationConstants {
    /// A_l: oxygen taken up per area and time, kg/(m²·s).
    pub arrhenius_constant_kg_per_m2_s: f64,
    /// Q_l, J/mol.
    pub activation_energy_j_per_mol: f64,
    /// ρ_Fe, kg/m³.
    pub density_kg_per_m3: f64,
    /// m.
    pub mass_ratio: MassRatio,
}

/// dh = k_r p · (depth of iron that oxidises while sliding ds).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oxidation {
    /// k_r: part of the area that is in real contact, over the pressure, mm²/N.
    pub coefficient_mm2_per_n: f64,
    /// Constants of the reaction.
    pub constants: OxidationConstants,
}

impl OxidationConstants {
    /// Orders of magnitude for iron, not the constants of any steel: they differ by many powers of ten between static and rubbed
    /// surfaces. The density is that of iron.
    pub const TYPICAL: Self = Self {
        arrhenius_constant_kg_per_m2_s: 1e3,
        activation_energy_j_per_mol: 100e3,
        density_kg_per_m3: 7870.0,
        mass_ratio: MassRatio::Stoichiometric,
    };

    /// Speed at which the surface turns into oxide, mm/s.
    pub fn growth_mm_per_s(&self, temperature_k: f64) -> f64 {
        let uptake = self.arrhenius_constant_kg_per_m2_s
            * (-self.activation_energy_j_per_mol / (MOLAR_GAS_CONSTANT * temperature_k)).exp();
        1e3 * uptake * self.mass_ratio.value() / self.density_kg_per_m3
    }
}

impl LawConstants for OxidationConstants {
    // The thesis, equation 21.
    const VALID_TEMPERATURE_C: Option<[f64; 2]> = Some([200.0, 400.0]);

    fn typical(&self) -> Vec<&'static str> {
        let typical = Self::TYPICAL;
        let arrhenius = self.arrhenius_constant_kg_per_m2_s == typical.arrhenius_constant_kg_per_m2_s;
        let energy = self.activation_energy_j_per_mol == typical.activation_energy_j_per_mol;
        let keys = [("arrhenius_constant_kg_per_m2s", arrhenius), ("activation_energy_kJ_per_mol", energy)];
        keys.into_iter().filter(|(_, is_typical)| *is_typical).map(|(key, _)| key).collect()
    }
}

impl WearLaw for Oxidation {
    const READS_CONDITIONS: bool = true;

    fn coefficient_mm2_per_n(&self, at: &LocalContact) -> f64 {
        match at.conditions {
            // Speeds are means over the distance that a point slides, so that ds/v is the time it takes: none without sliding.
            Some(ContactConditions { sliding_speed_mm_per_s, temperature_k }) if sliding_speed_mm_per_s > 0.0 => {
                self.coefficient_mm2_per_n * self.constants.growth_mm_per_s(temperature_k) / sliding_speed_mm_per_s
            }
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wear::{FlankWear, SlidingRow, WithFactors};

    fn depth(mass_ratio: MassRatio, sliding_mm: f64, sliding_speed_mm_per_s: f64) -> f64 {
        let constants = OxidationConstants { mass_ratio, ..OxidationConstants::TYPICAL };
        let law = Oxidation { coefficient_mm2_per_n: 1.5e-4, constants };
        let own = ContactConditions { sliding_speed_mm_per_s, temperature_k: 573.15 };
        let mut depth = [0.0];
        let row = SlidingRow {
            pressure_mpa: &[1000.0],
            sliding_mm: &[sliding_mm],
            conditions: Some(&[own]),
            lambda: None,
            is_continuous: false,
        };
        WithFactors::none(law).add_depth(&row, &mut depth);
        depth[0]
    }

    /// Thesis eq 24 at 0.25 m/s, 300 °C, 1000 MPa over 0.5 mm, in SI, with the mass ratio of eq 21 as printed and as by the
    /// stoichiometry of Fe₂O₃: 5.4 times apart.
    #[test]
    fn ver_equation_24() {
        let (iron, oxygen) = (55.845, 31.998);
        for (ratio, m) in
            [(MassRatio::Stoichiometric, 4.0 * iron / (3.0 * oxygen)), (MassRatio::Thesis, 3.0 * oxygen / (4.0 * iron))]
        {
            let rate = 1e3 / (0.25 * 7870.0) * m * (-100e3 / (8.314_462_618 * 573.15_f64)).exp();
            let expected_m = 1.5e-10 * 1e9 * rate * 0.5e-3;
            let found = depth(ratio, 0.5, 250.0);
            assert!((found / (1e3 * expected_m) - 1.0).abs() < 1e-12, "{found} {expected_m}");
        }
        let apart = depth(MassRatio::Stoichiometric, 0.5, 250.0) / depth(MassRatio::Thesis, 0.5, 250.0);
        assert!((apart - 5.4).abs() < 0.05, "{apart}");
    }

    /// ds/v is time: the slower the surfaces slide, the less far they do in it.
    #[test]
    fn ver_wear_goes_with_time() {
        let [fast, slow] = [(0.5, 250.0), (0.5e-9, 250e-9)].map(|(ds, v)| depth(MassRatio::Stoichiometric, ds, v));
        assert!((fast / slow - 1.0).abs() < 1e-12);
        assert_eq!(depth(MassRatio::Stoichiometric, 0.0, 0.0), 0.0);
    }
}
