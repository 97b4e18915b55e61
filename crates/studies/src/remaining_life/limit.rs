//! Limit of wear that ends the life of a gear.

use std::str::FromStr;

use serde::Serialize;

use super::wear_curve::WearQuantity;
use gearwear_bodies::gear::Gear;

const QUANTITIES: [WearQuantity; 3] = [WearQuantity::PeakDepth, WearQuantity::Mass, WearQuantity::Volume];

/// Wear of a gear at which its life ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WearLimit {
    /// Main figure: `pinion.peak_wear_um`, …
    pub figure: String,
    pub value: f64,
    #[serde(skip)]
    pub gear: Gear,
    #[serde(skip)]
    pub quantity: WearQuantity,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("found {given:?}; allowed: FIGURE=VALUE with a value above 0 and one of {}, such as pinion.peak_wear_um=50", figures().join(", "))]
pub struct LimitError {
    given: String,
}

fn figures() -> Vec<String> {
    let of = |gear: Gear| QUANTITIES.map(|quantity| format!("{}.{}", gear.name(), quantity.figure()));
    Gear::BOTH.map(of).concat()
}

impl WearLimit {
    pub fn new(gear: Gear, quantity: WearQuantity, value: f64) -> Self {
        Self { figure: format!("{}.{}", gear.name(), quantity.figure()), value, gear, quantity }
    }
}

impl FromStr for WearLimit {
    type Err = LimitError;

    fn from_str(given: &str) -> Result<Self, LimitError> {
        let refused = || LimitError { given: given.to_owned() };
        let (figure, value) = given.split_once('=').ok_or_else(refused)?;
        let value = value.trim().parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
        let (gear, name) = figure.trim().split_once('.').ok_or_else(refused)?;
        let gear = Gear::BOTH.into_iter().find(|known| known.name() == gear).ok_or_else(refused)?;
        let quantity = QUANTITIES.into_iter().find(|quantity| quantity.figure() == name).ok_or_else(refused)?;
        Ok(Self::new(gear, quantity, value.ok_or_else(refused)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_main_figures_of_a_gear() {
        let limit: WearLimit = "wheel.worn_mass_mg = 1200".parse().unwrap();
        assert_eq!(limit, WearLimit::new(Gear::Wheel, WearQuantity::Mass, 1200.0));
        for given in
            ["pinion.peak_wear_um", "pinion.peak_wear_um=0", "pinion.root_wear_um=1", "sun.peak_wear_um=1", "=1"]
        {
            let error = given.parse::<WearLimit>().unwrap_err().to_string();
            assert!(error.contains("allowed: ") && error.contains("pinion.worn_mass_mg"), "{error}");
        }
    }
}
