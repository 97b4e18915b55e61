//! Wear of the surface that an adsorbed film leaves bare.
//!
//! A molecule of the lubricant stays on the surface for the time t₀ exp(E/(R T)); while an asperity slides over its place, the
//! part α of the contact is bare and wears:
//!
//! ```text
//! dh = k_r p α ds        α = 1 − exp(−X/(v t₀) · exp(−E/(R T)))
//! ```
//!
//! Source: E. P. Kingsbury (1958); S. Wu and H. S. Cheng (1991, 1993); the thesis, equations 13–19.

use super::{ContactConditions, LawConstants, LocalContact, WearLaw};

/// R, J/(mol·K).
pub(super) const MOLAR_GAS_CONSTANT: f64 = 8.314_462_618;

/// Constants of the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdsorptionConstants {
    /// X, mm.
    pub molecule_diameter_mm: f64,
    /// t₀, s.
    pub vibration_time_s: f64,
    /// E, J/mol.
    pub heat_of_adsorption_j_per_mol: f64,
}

/// dh = k_r α p ds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adsorption {
    /// k_r of a bare surface, mm²/N.
    pub coefficient_mm2_per_n: f64,
    /// Constants of the film.
    pub constants: AdsorptionConstants,
}

impl AdsorptionConstants {
    /// Orders of magnitude for a fatty acid or ester on steel (Kingsbury; Wu and Cheng), not the constants of any lubricant.
    pub const TYPICAL: Self =
        Self { molecule_diameter_mm: 0.3 / 1e6, vibration_time_s: 3.0 / 1e12, heat_of_adsorption_j_per_mol: 48e3 };

    /// α, 0 to 1: the part of the contact that the film leaves unprotected.
    pub fn unprotected(&self, ContactConditions { sliding_speed_mm_per_s, temperature_k }: ContactConditions) -> f64 {
        if sliding_speed_mm_per_s <= 0.0 {
            // Every molecule leaves before an asperity has passed its place.
            return 1.0;
        }
        let stays =
            self.vibration_time_s * (self.heat_of_adsorption_j_per_mol / (MOLAR_GAS_CONSTANT * temperature_k)).exp();
        -(-self.molecule_diameter_mm / (sliding_speed_mm_per_s * stays)).exp_m1()
    }
}

impl LawConstants for AdsorptionConstants {
    fn typical(&self) -> Vec<&'static str> {
        let typical = Self::TYPICAL;
        let keys = [
            ("molecule_diameter_nm", self.molecule_diameter_mm == typical.molecule_diameter_mm),
            ("vibration_time_ps", self.vibration_time_s == typical.vibration_time_s),
            (
                "heat_of_adsorption_kJ_per_mol",
                self.heat_of_adsorption_j_per_mol == typical.heat_of_adsorption_j_per_mol,
            ),
        ];
        keys.into_iter().filter(|(_, is_typical)| *is_typical).map(|(key, _)| key).collect()
    }
}

impl WearLaw for Adsorption {
    const READS_CONDITIONS: bool = true;

    fn coefficient_mm2_per_n(&self, at: &LocalContact) -> f64 {
        let unprotected = at.conditions.map_or(1.0, |conditions| self.constants.unprotected(conditions));
        self.coefficient_mm2_per_n * unprotected
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wear::{FlankWear, SlidingRow, WithFactors};

    /// Thesis eq 19 at 250 mm/s, 120 °C, 1000 MPa over 0.5 mm, by hand: t₀ exp(E/(R T)) = 3e-12 · exp(14.684 …).
    #[test]
    fn ver_equation_19() {
        let law = Adsorption { coefficient_mm2_per_n: 1e-7, constants: AdsorptionConstants::TYPICAL };
        let own = ContactConditions { sliding_speed_mm_per_s: 250.0, temperature_k: 393.15 };
        let stays = 3e-12 * (48e3 / (8.314_462_618 * 393.15_f64)).exp();
        let expected = 1e-7 * 1000.0 * (1.0 - (-3e-7 / (250.0 * stays)).exp()) * 0.5;
        let mut depth = [0.0];
        let row = SlidingRow {
            pressure_mpa: &[1000.0],
            sliding_mm: &[0.5],
            conditions: Some(&[own]),
            lambda: None,
            is_continuous: false,
        };
        WithFactors::none(law).add_depth(&row, &mut depth);
        assert!((depth[0] / expected - 1.0).abs() < 1e-12, "{} {expected}", depth[0]);
    }

    /// α at a speed and a temperature.
    fn at(constants: AdsorptionConstants, sliding_speed_mm_per_s: f64, temperature_k: f64) -> f64 {
        constants.unprotected(ContactConditions { sliding_speed_mm_per_s, temperature_k })
    }

    /// α = 1 − e⁻¹ where a molecule stays as long as an asperity needs for its diameter; all of the surface is bare when hot or
    /// still, none when cold.
    #[test]
    fn ver_limits() {
        let constants = AdsorptionConstants {
            vibration_time_s: 1e-6,
            heat_of_adsorption_j_per_mol: 0.0,
            ..AdsorptionConstants::TYPICAL
        };
        assert!((at(constants, 0.3, 300.0) - (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
        let typical = AdsorptionConstants::TYPICAL;
        assert_eq!(at(typical, 0.0, 300.0), 1.0);
        assert_eq!(at(typical, 1.0, 0.05), 0.0);
        assert!(at(typical, 100.0, 400.0) > at(typical, 100.0, 380.0));
        assert!(at(typical, 200.0, 400.0) < at(typical, 100.0, 400.0));
    }
}
