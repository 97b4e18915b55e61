//! What is asked of the wear law.

use super::{adsorption::AdsorptionConstants, oxidation::OxidationConstants};

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

/// Which law, with its own constants.
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
    /// Its name in scenes and reports.
    pub fn name(&self) -> &'static str {
        match self {
            LawSettings::Archard => "archard",
            LawSettings::Adsorption(_) => "adsorption",
            LawSettings::Oxidation(_) => "oxidation",
        }
    }
}

/// The wear law with its constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearSettings {
    /// Which law.
    pub law: LawSettings,
    /// Wear coefficient: k of the generalised Archard law, k_r of the others, mm²/N (1e-17 m²/N is 1e-11 mm²/N).
    pub coefficient_mm2_per_n: f64,
    /// Mild-to-severe transition, where asked for.
    pub severe: Option<SevereTransition>,
}

impl WearSettings {
    /// The generalised Archard law without a transition.
    pub fn archard(coefficient_mm2_per_n: f64) -> Self {
        Self { law: LawSettings::Archard, coefficient_mm2_per_n, severe: None }
    }
}
