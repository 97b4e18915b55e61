//! Regimes of the transition diagram of lubricated sliding contacts.
//!
//! | regime | k, mm³/(N·m) | what wears |
//! |---|---|---|
//! | I | below 1e-9 | mild, mostly oxidation, under a film that carries part of the load |
//! | II | 1e-8 to 1e-6 | boundary lubrication: oxidation, some adhesion |
//! | III | above 1e-5 | scuffing: adhesion of unprotected asperities |
//!
//! Between two regimes the diagram leaves a power of ten, which has a name of its own here.
//!
//! Source: A. W. J. de Gee, A. Begelinger and G. Salomon, *Mixed Lubrication and Lubricated Wear* (11th Leeds–Lyon symposium,
//! 1985), the diagram of the International Research Group on wear (IRG); the thesis, section 3 and figure 8.

/// 1 mm²/N in mm³/(N·m).
pub const MM3_PER_NM: f64 = 1e3;
/// Relative distance from a bound within which a coefficient is on it.
const ROUND_OFF: f64 = 1e-9;

/// Regime of a wear coefficient in the diagram.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
pub enum Regime {
    /// Below 1e-9 mm³/(N·m).
    #[serde(rename = "I")]
    One,
    /// 1e-9 to 1e-8.
    #[serde(rename = "between I and II")]
    OneToTwo,
    /// 1e-8 to 1e-6.
    #[serde(rename = "II")]
    Two,
    /// 1e-6 to 1e-5.
    #[serde(rename = "between II and III")]
    TwoToThree,
    /// Above 1e-5.
    #[serde(rename = "III")]
    Three,
}

impl Regime {
    /// Regime of a wear coefficient.
    pub fn of(coefficient_mm2_per_n: f64) -> Self {
        let k = MM3_PER_NM * coefficient_mm2_per_n;
        match k {
            k if k < 1e-9 * (1.0 - ROUND_OFF) => Regime::One,
            k if k < 1e-8 * (1.0 - ROUND_OFF) => Regime::OneToTwo,
            k if k <= 1e-6 * (1.0 + ROUND_OFF) => Regime::Two,
            k if k <= 1e-5 * (1.0 + ROUND_OFF) => Regime::TwoToThree,
            _ => Regime::Three,
        }
    }

    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Regime::One => "I",
            Regime::OneToTwo => "between I and II",
            Regime::Two => "II",
            Regime::TwoToThree => "between II and III",
            Regime::Three => "III",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bounds of the thesis, section 3. 1e-17 m²/N is 1e-8 mm³/(N·m): on the lower bound of regime II.
    #[test]
    fn ver_bounds_of_the_regimes() {
        for (k_mm3_per_nm, name) in
            [(1e-10, "I"), (3e-9, "between I and II"), (3e-7, "II"), (3e-6, "between II and III"), (2e-5, "III")]
        {
            assert_eq!(Regime::of(k_mm3_per_nm / MM3_PER_NM).name(), name);
        }
        assert_eq!(Regime::of(1e6 * 1e-17), Regime::Two);
    }
}
