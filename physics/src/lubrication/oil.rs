//! An oil: viscosity and density with temperature, viscosity with pressure.
//!
//! Kinematic viscosity ν in mm²/s follows two given ones, at 40 and 100 °C, by Walther's equation,
//!
//! ```text
//! lg lg(ν + c) = A − B lg T        T in K;   c = 0.7 (ASTM D341), 0.8 (DIN 51563)
//! ```
//!
//! density by ρ = ρ₁₅ − 0.7 (θ − 16 °C) kg/m³ and dynamic viscosity by η = ν ρ (ISO/TS 6336-22, 7.3). The pressure–viscosity coefficient α is
//! given, or by one of
//!
//! ```text
//! ISO/TS 6336-22, 7.4   α₃₈ = k η₃₈^n,  α = α₃₈ [1 + 516 (1/(θ + 273) − 1/311)]      η₃₈ in Pa·s, α in 1/Pa
//! Gold et al.           α = s ν^t 10⁻⁹                                                ν in mm²/s
//! ```
//!
//! Far above the temperatures of use these fits become negative (α from about 510 °C on): there is no film then.
//!
//! | base oil | k | n | s | t |
//! |---|---|---|---|---|
//! | mineral | 2.657e-8 | 0.1348 | 9.904 | 0.1390 |
//! | polyalphaolefin | 1.466e-8 | 0.0507 | 7.382 | 0.1335 |
//! | polyglycol | 1.392e-8 | 0.1572 | 5.489 | 0.1485 |
//!
//! Sources: ASTM D341; DIN 51563; ISO/TS 6336-22 (first ISO/TR 15144-1:2014), clause 7; P. W. Gold, A. Schmidt, H. Dicke, J. Loos and
//! C. Assmann, *Viscosity–pressure–temperature behaviour of mineral and synthetic oils*, J. Synth. Lubr. 18 (2001).

use super::settings::{BaseOil, OilSettings, PressureViscosity, PressureViscosityFit, ViscosityFit};

/// 0 °C in K.
const ZERO_CELSIUS_K: f64 = 273.15;
/// Temperature to which the fit of ISO/TS 6336-22 refers, °C.
const REFERENCE_C: f64 = 38.0;

/// Properties of an oil at any temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oil {
    settings: OilSettings,
    intercept: f64,
    slope: f64,
}

fn walther_constant(fit: ViscosityFit) -> f64 {
    match fit {
        ViscosityFit::AstmD341 => 0.7,
        ViscosityFit::Din51563 => 0.8,
    }
}

/// k, n of ISO/TS 6336-22 and s, t of Gold.
fn pressure_constants(base: BaseOil) -> [f64; 4] {
    match base {
        BaseOil::Mineral => [2.657e-8, 0.1348, 9.904, 0.1390],
        BaseOil::Polyalphaolefin => [1.466e-8, 0.0507, 7.382, 0.1335],
        BaseOil::Polyglycol => [1.392e-8, 0.1572, 5.489, 0.1485],
    }
}

impl Oil {
    /// An oil of these data; viscosities above 2 mm²/s, the one at 100 °C the lower.
    pub fn new(settings: OilSettings) -> Self {
        let constant = walther_constant(settings.fit);
        let [cold, hot] = [40.0, 100.0].map(|celsius: f64| (celsius + ZERO_CELSIUS_K).log10());
        let [at_cold, at_hot] = [settings.viscosity_40c_mm2_per_s, settings.viscosity_100c_mm2_per_s]
            .map(|viscosity| (viscosity + constant).log10().log10());
        let slope = (at_cold - at_hot) / (hot - cold);
        Self { settings, intercept: at_cold + slope * cold, slope }
    }

    /// Base oil.
    pub fn base(&self) -> BaseOil {
        self.settings.base
    }

    /// ν, mm²/s.
    pub fn kinematic_viscosity_mm2_per_s(&self, temperature_c: f64) -> f64 {
        let twice = self.intercept - self.slope * (temperature_c + ZERO_CELSIUS_K).log10();
        10f64.powf(10f64.powf(twice)) - walther_constant(self.settings.fit)
    }

    /// ρ, kg/m³.
    pub fn density_kg_per_m3(&self, temperature_c: f64) -> f64 {
        (self.settings.density_15c_kg_per_m3 - 0.7 * (temperature_c - 16.0)).max(0.0)
    }

    /// η, mPa·s.
    pub fn viscosity_milli_pa_s(&self, temperature_c: f64) -> f64 {
        1e-3 * self.kinematic_viscosity_mm2_per_s(temperature_c) * self.density_kg_per_m3(temperature_c)
    }

    /// α, 1/GPa.
    pub fn pressure_viscosity_per_gpa(&self, temperature_c: f64) -> f64 {
        let [factor, exponent, gold_factor, gold_exponent] = pressure_constants(self.settings.base);
        match self.settings.pressure_viscosity {
            PressureViscosity::Given { per_gpa } => per_gpa,
            PressureViscosity::Fit(PressureViscosityFit::Gold) => {
                gold_factor * self.kinematic_viscosity_mm2_per_s(temperature_c).powf(gold_exponent)
            }
            PressureViscosity::Fit(PressureViscosityFit::Iso633622) => {
                let at_reference = factor * (1e-3 * self.viscosity_milli_pa_s(REFERENCE_C)).powf(exponent);
                (1e9 * at_reference * (1.0 + 516.0 * (1.0 / (temperature_c + 273.0) - 1.0 / 311.0))).max(0.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oil of the reports of stages 2 and 3: VG 220, ν₁₀₀ = 19 mm²/s, ρ₁₅ = 890 kg/m³.
    fn of_reports() -> OilSettings {
        OilSettings {
            viscosity_40c_mm2_per_s: 220.0,
            viscosity_100c_mm2_per_s: 19.0,
            fit: ViscosityFit::AstmD341,
            base: BaseOil::Mineral,
            density_15c_kg_per_m3: 890.0,
            pressure_viscosity: PressureViscosity::Fit(PressureViscosityFit::Iso633622),
        }
    }

    /// Flashes at tip edges under load are hotter than any oil: its film is 0, and no NaN.
    #[test]
    fn prop_hot_oil_has_no_film() {
        let oil = Oil::new(of_reports());
        for celsius in [600.0, 1400.0, 1e5] {
            assert_eq!(oil.pressure_viscosity_per_gpa(celsius) * oil.viscosity_milli_pa_s(celsius), 0.0);
        }
    }

    #[test]
    fn ver_viscosity_passes_through_both_that_are_given() {
        for fit in [ViscosityFit::AstmD341, ViscosityFit::Din51563] {
            let oil = Oil::new(OilSettings { fit, ..of_reports() });
            assert!((oil.kinematic_viscosity_mm2_per_s(40.0) / 220.0 - 1.0).abs() < 1e-9);
            assert!((oil.kinematic_viscosity_mm2_per_s(100.0) / 19.0 - 1.0).abs() < 1e-9);
        }
    }

    /// KISSsoft 03/2017, report of stage 3 of the NREL 5 MW drivetrain (repository gfsReboucas/Drivetrain): η at 80 °C and at the bulk
    /// temperature of 85.02 °C, and α₃₈ = 0.02162 in 1/MPa.
    #[test]
    fn val_oil_of_the_report_of_stage_3() {
        let oil = Oil::new(of_reports());
        assert!((oil.viscosity_milli_pa_s(80.0) - 30.09).abs() < 0.005);
        assert!((oil.viscosity_milli_pa_s(85.02) - 25.2).abs() < 0.055);
        assert!((oil.pressure_viscosity_per_gpa(38.0) - 21.62).abs() < 0.005);
    }

    /// GEARpie's report of C14: its oil M32 (A = 9.5259, B = 3.7449 in Walther's equation) has 15.12 mm²/s at 60 °C.
    #[test]
    fn val_walther_between_40_and_100_c() {
        let [viscosity_40c_mm2_per_s, viscosity_100c_mm2_per_s] = [40.0, 100.0]
            .map(|celsius: f64| 10f64.powf(10f64.powf(9.5259 - 3.7449 * (celsius + 273.15).log10())) - 0.7);
        let oil = Oil::new(OilSettings { viscosity_40c_mm2_per_s, viscosity_100c_mm2_per_s, ..of_reports() });
        assert!((oil.kinematic_viscosity_mm2_per_s(60.0) - 15.12).abs() < 0.005);
    }
}
