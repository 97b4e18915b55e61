//! Coefficients that a comparison can fit, by name.

use serde::{Serialize, Serializer};

use gearwear_bodies::gear::Gear;

/// A parameter of the fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// ln κ, the logarithm of the factor on the wear coefficients; of one gear where each has its own.
    Coefficient(Option<Gear>),
    /// ln C, the logarithm of the factor of severe wear.
    Severe,
    /// d, the shift of a profile along the flank, mm; with the gear where profiles of both are fitted.
    Shift(Option<Gear>),
}

impl Unknown {
    /// Name in a sentence.
    pub fn name(self) -> String {
        match self {
            Unknown::Coefficient(None) => "the wear coefficient".to_owned(),
            Unknown::Coefficient(Some(gear)) => format!("the wear coefficient of the {}", gear.name()),
            Unknown::Severe => "the severe factor".to_owned(),
            Unknown::Shift(None) => "the shift".to_owned(),
            Unknown::Shift(Some(gear)) => format!("the shift of the {}’s profile", gear.name()),
        }
    }

    /// Whether the profile of `gear` depends on it.
    pub(super) fn is_of(self, gear: Gear) -> bool {
        match self {
            Unknown::Coefficient(own) | Unknown::Shift(own) => own.is_none_or(|own| own == gear),
            Unknown::Severe => true,
        }
    }

    /// Short name in results.
    pub fn key(self) -> String {
        let (name, gear) = match self {
            Unknown::Coefficient(gear) => ("k", gear),
            Unknown::Severe => ("severe", None),
            Unknown::Shift(gear) => ("shift", gear),
        };
        gear.map_or_else(|| name.to_owned(), |gear| format!("{name}.{}", gear.name()))
    }
}

impl Serialize for Unknown {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.key())
    }
}
