//! Settings of the wear laws.

use super::adsorption::{Adsorption, AdsorptionConstants};
use super::archard::Archard;
use super::oxidation::{Oxidation, OxidationConstants};
use super::{LawConstants, WearLaw};
use crate::lubrication::settings::FilmRatio;
use crate::thermal::tooth::TemperatureCurve;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::linear_means::value_at;

/// The transition from mild to severe wear (thesis eq 26).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SevereTransition {
    /// Local pressure above which wear is severe, MPa.
    pub above_mpa: f64,
    /// Factor on the wear coefficient there.
    pub factor: f64,
    /// Pressure over which the factor rises from 1, half of it to either side of `above_mpa`, MPa; 0: at once, as in the thesis.
    pub band_mpa: f64,
}

impl SevereTransition {
    /// Band over its limit where a scene names none.
    pub const DEFAULT_BAND: f64 = 0.05;
    /// Least band over its limit that adaptive steps follow.
    pub const LEAST_BAND: f64 = 0.02;

    /// Pressure from which on wear is faster than mild, MPa.
    pub fn begins_mpa(self) -> f64 {
        self.above_mpa - 0.5 * self.band_mpa
    }

    /// A transition at `part` of this one's limit, over a band as wide in MPa.
    pub fn with_limit(self, part: f64) -> Self {
        Self { above_mpa: part * self.above_mpa, ..self }
    }

    /// The transition as adaptive steps follow it: over a band of at least [`Self::LEAST_BAND`], within which the rate is continuous.
    pub(crate) fn continuous(self) -> Self {
        Self { band_mpa: self.band_mpa.max(Self::LEAST_BAND * self.above_mpa), ..self }
    }
}

/// Dependence of wear on the oil film: a factor on the wear coefficient.
///
/// Source of the form that [`FilmDependence::priest_taylor`] gives: M. Priest and C. M. Taylor, *Automobile engine tribology – approaching the
/// surface* (Wear 241, 2000).
#[derive(Debug, Clone, PartialEq)]
pub struct FilmDependence {
    /// Definition of λ.
    pub ratio: FilmRatio,
    /// λ, rising; two at least.
    pub lambda: Vec<f64>,
    /// Factor at each: linear between them, constant beyond.
    pub factor: Vec<f64>,
}

impl FilmDependence {
    /// 1 below λ = 0.5, (2/7)(4 − λ) up to 4, none above.
    pub fn priest_taylor(ratio: FilmRatio) -> Self {
        Self { ratio, lambda: vec![0.5, 4.0], factor: vec![1.0, 0.0] }
    }

    /// The factor under a film.
    pub fn factor_at(&self, lambda: f64) -> f64 {
        value_at(&self.lambda, &self.factor, lambda)
    }
}

/// A law with its own constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawSettings {
    /// The generalised Archard law.
    Archard,
    /// Wear of what an adsorbed film leaves unprotected.
    Adsorption(AdsorptionConstants),
    /// Wear of an oxide that grows linearly.
    Oxidation(OxidationConstants),
}

impl LawSettings {
    /// Name in scenes and reports.
    pub fn name(&self) -> &'static str {
        match self {
            LawSettings::Archard => "archard",
            LawSettings::Adsorption(_) => "adsorption",
            LawSettings::Oxidation(_) => "oxidation",
        }
    }

    /// Whether the coefficient depends on sliding speed or contact temperature: the scene then needs a speed, and the plan computes temperatures.
    pub fn reads_temperature(&self) -> bool {
        match self {
            LawSettings::Archard => Archard::READS_CONDITIONS,
            LawSettings::Adsorption(_) => Adsorption::READS_CONDITIONS,
            LawSettings::Oxidation(_) => Oxidation::READS_CONDITIONS,
        }
    }

    /// Contact temperatures between which the law holds, °C; none where it has no bounds.
    pub fn valid_temperature_c(&self) -> Option<[f64; 2]> {
        match self {
            LawSettings::Archard => None,
            LawSettings::Adsorption(_) => AdsorptionConstants::VALID_TEMPERATURE_C,
            LawSettings::Oxidation(_) => OxidationConstants::VALID_TEMPERATURE_C,
        }
    }

    /// Keys of the constants that have the program's typical value, which is an order of magnitude and not measured.
    pub fn typical_constants(&self) -> Vec<&'static str> {
        match self {
            LawSettings::Archard => Vec::new(),
            LawSettings::Adsorption(own) => own.typical(),
            LawSettings::Oxidation(own) => own.typical(),
        }
    }
}

/// The wear law with its constants.
#[derive(Debug, Clone, PartialEq)]
pub struct WearSettings {
    /// Law.
    pub law: LawSettings,
    /// Wear coefficient: k of the generalised Archard law, k_r of the others, mm²/N (1e-17 m²/N is 1e-11 mm²/N).
    pub coefficient_mm2_per_n: f64,
    /// Mild-to-severe transition, where asked for; [`Self::severe_transition`] is the one that changes wear.
    pub severe: Option<SevereTransition>,
    /// Dependence on the oil film, where asked for.
    pub film: Option<FilmDependence>,
    /// Factor on the coefficient over the temperature of the flanks, where asked for.
    pub warm: Option<TemperatureCurve>,
}

/// The wear laws of both gears.
pub trait WearOfPair {
    /// Whether both gears wear by the same law with the same constants and coefficient.
    fn are_alike(&self) -> bool;

    /// Whether wear of either gear may be severe.
    fn may_be_severe(&self) -> bool;

    /// Greatest factor of severe wear under this maximum pressure, MPa; none where neither gear wears severely.
    fn severe_factor_under(&self, peak_pressure_mpa: f64) -> Option<f64>;

    /// Whether wear of either gear is faster than mild under this maximum pressure, MPa, or would be with limits of `part` of their own.
    fn is_severe_under(&self, peak_pressure_mpa: f64, part: f64) -> bool;

    /// Laws with another transition in place of each gear's own.
    fn with_severe(&self, of: impl Fn(SevereTransition) -> Option<SevereTransition>) -> Self;
}

impl WearOfPair for PerGear<WearSettings> {
    fn are_alike(&self) -> bool {
        let [pinion, wheel] =
            Gear::BOTH.map(|gear| WearSettings { severe: self[gear].severe_transition(), ..self[gear].clone() });
        pinion == wheel
    }

    fn may_be_severe(&self) -> bool {
        Gear::BOTH.into_iter().any(|gear| self[gear].severe_transition().is_some())
    }

    fn severe_factor_under(&self, peak_pressure_mpa: f64) -> Option<f64> {
        let wearing = Gear::BOTH.into_iter().map(|gear| &self[gear]).filter(|own| own.coefficient_mm2_per_n > 0.0);
        let severe = wearing
            .filter_map(WearSettings::severe_transition)
            .filter(|severe| severe.factor_at(peak_pressure_mpa) > 1.0);
        severe.map(|severe| severe.factor).reduce(f64::max)
    }

    fn is_severe_under(&self, peak_pressure_mpa: f64, part: f64) -> bool {
        self.with_severe(|own| Some(own.with_limit(part))).severe_factor_under(peak_pressure_mpa).is_some()
    }

    fn with_severe(&self, of: impl Fn(SevereTransition) -> Option<SevereTransition>) -> Self {
        self.as_ref().map(|own| WearSettings { severe: own.severe.and_then(&of), ..own.clone() })
    }
}

impl WearSettings {
    /// The generalised Archard law without a transition.
    pub fn archard(coefficient_mm2_per_n: f64) -> Self {
        Self { law: LawSettings::Archard, coefficient_mm2_per_n, severe: None, film: None, warm: None }
    }

    /// The transition to severe wear, where there is one: a factor of 1 is none.
    pub fn severe_transition(&self) -> Option<SevereTransition> {
        self.severe.filter(|severe| severe.factor != 1.0)
    }

    /// The coefficient, mm²/N, where it is the same at every pressure, temperature and film.
    pub fn constant_coefficient_mm2_per_n(&self) -> Option<f64> {
        (self.law == LawSettings::Archard && self.severe_transition().is_none() && self.film.is_none())
            .then_some(self.coefficient_mm2_per_n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::settings::Stepping;

    /// A factor of 1 is no severe wear: neither the resolution nor the coefficient depends on it.
    #[test]
    fn ver_a_severe_factor_of_one_is_none() {
        for (factor, is_severe) in [(1.0, false), (0.5, true), (2.0, true)] {
            let severe = Some(SevereTransition { above_mpa: 100.0, factor, band_mpa: 5.0 });
            let own = WearSettings { severe, ..WearSettings::archard(1e-11) };
            assert_eq!(own.severe_transition().is_some(), is_severe, "{factor}");
            assert_eq!(own.constant_coefficient_mm2_per_n().is_none(), is_severe, "{factor}");
            let both = PerGear { pinion: WearSettings::archard(1e-11), wheel: own };
            assert_eq!((both.may_be_severe(), both.are_alike()), (is_severe, !is_severe), "{factor}");
        }
    }

    /// Adaptive steps follow an abrupt transition, or one over a narrow band, over 2 % of its limit; Euler's method follows it as it is.
    #[test]
    fn ver_adaptive_steps_follow_a_band() {
        let (adaptive, euler) = (Stepping::Adaptive { tolerance_mm: 5e-5 }, Stepping::Fixed { revolutions: 1000.0 });
        for (band_mpa, followed_mpa) in [(0.0, 40.0), (39.0, 40.0), (41.0, 41.0), (100.0, 100.0)] {
            let own = SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa };
            assert_eq!(adaptive.followed(own), SevereTransition { band_mpa: followed_mpa, ..own });
            assert_eq!(euler.followed(own), own);
        }
    }

    /// Priest and Taylor: k₀ for λ < 0.5, (2/7) k₀ (4 − λ) from 0.5 to 4, none above.
    #[test]
    fn ver_priest_and_taylor() {
        let film = FilmDependence::priest_taylor(FilmRatio::Composite);
        for lambda in [0.0, 0.3, 0.5, 1.0, 2.25, 3.9, 4.0, 7.0] {
            let expected = if lambda < 0.5 { 1.0 } else { (2.0_f64 / 7.0 * (4.0 - lambda)).max(0.0) };
            assert!((film.factor_at(lambda) - expected).abs() < 1e-14, "{lambda}");
        }
    }
}
