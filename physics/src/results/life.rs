//! The life of a pair: how long it ran until it came to a limit of `operation.stop`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::Gear;

/// A limit that ends a life.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LifeLimit {
    /// The greatest wear depth on the active profile of either gear.
    Wear,
    /// The normal tooth thickness at the tip that wear has left of either gear.
    TipThickness,
}

/// The life to the limits of `operation.stop`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LifeSummary {
    /// The limit that was reached first, and ended the run; `None` where none was.
    pub reached: Option<LifeLimit>,
    /// The gear that came to it.
    pub gear: Option<Gear>,
    /// Hours until then; `None` where no limit was reached, or the scene gives no speed.
    pub hours: Option<f64>,
    /// Life in pinion revolutions.
    pub revolutions: Option<f64>,
    /// Why there is no life, where no limit was reached.
    pub not_reached: Option<String>,
    /// The limit of the wear depth, where there is one.
    pub wear_limit_um: Option<f64>,
    /// The limit of the normal tip thickness, where there is one.
    pub tip_thickness_limit_mm: Option<f64>,
}

impl LifeSummary {
    /// In one sentence, where `duration` says how long the run was.
    pub fn in_words(&self, duration: &str) -> String {
        let limit = match (self.reached, self.wear_limit_um, self.tip_thickness_limit_mm) {
            (Some(LifeLimit::Wear), Some(limit), _) => format!("{limit} µm of wear"),
            (Some(LifeLimit::TipThickness), _, Some(limit)) => format!("{limit} mm left of the tip thickness"),
            _ => {
                let reason = self.not_reached.as_deref().unwrap_or_default();
                return format!("The life is longer than the run: {reason}.");
            }
        };
        let gear = self.gear.map_or("pair", Gear::name);
        format!("The life is {duration}: the {gear} then has {limit}, the limit of operation.stop.")
    }
}
