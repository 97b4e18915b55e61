//! Wear of what an adsorbed film leaves unprotected.
//!
//! A molecule of the lubricant stays on the surface for the time t₀ exp(E/(R T)); while an asperity slides over its place, the
//! part α of the contact is bare and wears:
//!
//! ```text
//! dh = k_r p α ds        α = 1 − exp(−X/(v t₀) · exp(−E/(R T)))
//! ```
//!
//! Source: E. P. Kingsbury (1958); S. Wu and H. S. Cheng (1991, 1993); the thesis, equations 13–19.

use super::{Surroundings, WearLaw};

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
    /// k_r: of a bare surface, mm²/N.
    pub coefficient_mm2_per_n: f64,
    /// Of the film.
    pub constants: AdsorptionConstants,
}

impl AdsorptionConstants {
    /// α, 0 to 1: the part of the contact that the film leaves unprotected.
    pub fn unprotected(&self, Surroundings { sliding_speed_mm_per_s, temperature_k }: Surroundings) -> f64 {
        let stays =
            self.vibration_time_s * (self.heat_of_adsorption_j_per_mol / (MOLAR_GAS_CONSTANT * temperature_k)).exp();
        -(-self.molecule_diameter_mm / (sliding_speed_mm_per_s * stays)).exp_m1()
    }
}

impl WearLaw for Adsorption {
    const READS_SURROUNDINGS: bool = true;

    fn coefficient_mm2_per_n(&self, surroundings: Option<Surroundings>) -> f64 {
        let unprotected = surroundings.map_or(1.0, |surroundings| self.constants.unprotected(surroundings));
        self.coefficient_mm2_per_n * unprotected
    }

    fn greatest_coefficient_mm2_per_n(&self) -> f64 {
        self.coefficient_mm2_per_n
    }
}
