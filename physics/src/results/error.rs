//! Error that a run states of itself: how far it is from the same wear simulation with finite elements, and the estimates of its companions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How far the run is from the same wear simulation with finite elements, whose own uncertainty is added; relative. `None`: not known, and `how` says
/// why.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct TotalError {
    /// Of the wear over each flank, root mean square over that of the flank.
    pub profile: ErrorPerGear,
    /// Of each gear's maximum wear.
    pub peak_wear: ErrorPerGear,
    /// Of each gear's maximum wear of the tip edge.
    pub tip_edge_wear: ErrorPerGear,
    /// Of the worn pair.
    pub transmission_error_peak_to_peak: Option<f64>,
    /// Of the new pair.
    #[serde(default)]
    pub transmission_error_peak_to_peak_new: Option<f64>,
    /// Of the mean over the life of the pair.
    #[serde(default)]
    pub transmission_error_over_life: Option<f64>,
    /// Of the maximum pressure of the worn pair at positions between the tip edges, root mean square.
    pub pressure_between_tips: Option<f64>,
    /// Of the maximum pressure between the tip-edge zones.
    #[serde(default)]
    pub flank_pressure: ErrorNewAndWorn,
    /// How it was obtained, or why it was not.
    pub how: String,
}

/// A relative error of each gear.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ErrorPerGear {
    /// The pinion's.
    pub pinion: Option<f64>,
    /// The wheel's.
    pub wheel: Option<f64>,
}

/// A relative error on new and on worn flanks.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ErrorNewAndWorn {
    /// At the beginning.
    pub new: Option<f64>,
    /// At the end.
    pub worn: Option<f64>,
}

impl TotalError {
    /// An error that is not known, for this reason.
    pub fn none(reason: &str) -> Self {
        Self { how: format!("not verified: {reason}"), ..Self::default() }
    }
}

/// Relative error estimates of the peak wear; `None`: not estimated.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct ErrorSummary {
    /// Against the same wear simulation with finite elements.
    pub total: TotalError,
    /// From the spacing of flank points and positions.
    pub discretisation: Option<f64>,
    /// From the length of the wear step.
    pub wear_step: Option<f64>,
    /// From the contact surface and the stiffness of the teeth: difference from the same wear simulation with finite elements; of both gears the larger.
    pub surface_model: Option<f64>,
    /// Difference of the volumes that the whole run takes from all teeth of pinion and wheel, relative to the greater: what one flank of a
    /// contact loses the other does too. `None` where nothing wears.
    pub volume_balance: Option<f64>,
    /// Between an abrupt transition to severe wear and one over a band; `None` where no wear is severe. Not an error but a choice of the scene.
    pub severe_switch: Option<f64>,
    /// The wear with limits of severe wear a tenth lower and higher than the scene's; `None` where no wear is severe, or would be with the lower one. Not an
    /// error either: how well the limit is known is the scene's matter.
    #[serde(default)]
    pub severe_limit: Option<SevereLimit>,
    /// Cost of the estimates but `severe_limit` over that of the run itself, counted in equilibria weighted by their time.
    pub companions_cost: Option<f64>,
    /// How each was obtained, or why it was not.
    pub how: ErrorSources,
}

impl ErrorSummary {
    /// Nothing was estimated, for this reason.
    pub fn not_estimated(reason: &str) -> Self {
        let how = ErrorSources {
            discretisation: format!("not estimated: {reason}"),
            wear_step: format!("not estimated: {reason}"),
            surface_model: format!("not estimated: {reason}"),
            volume_balance: String::new(),
            severe_switch: format!("not estimated: {reason}"),
            severe_limit: format!("not estimated: {reason}"),
        };
        Self { how, ..Self::default() }
    }
}

/// How the error estimates were obtained.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "named as in ErrorSummary")]
pub struct ErrorSources {
    pub discretisation: String,
    pub wear_step: String,
    pub surface_model: String,
    pub volume_balance: String,
    pub severe_switch: String,
    #[serde(default)]
    pub severe_limit: String,
}

/// Wear with other limits of severe wear (`wear.severe.above_MPa`).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SevereLimit {
    /// With the lower one: the greater wear.
    pub low: WearAtLimit,
    /// With the higher one.
    pub high: WearAtLimit,
}

/// Wear with another limit of severe wear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WearAtLimit {
    /// The limit over that of the scene.
    pub limit_factor: f64,
    /// Of the pinion.
    pub pinion: WearOfGearAtLimit,
    /// Of the wheel.
    pub wheel: WearOfGearAtLimit,
}

/// Wear of a gear with another limit of severe wear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[allow(non_snake_case, reason = "names end in their unit as engineers write it")]
pub struct WearOfGearAtLimit {
    /// Maximum wear of the active profile, µm.
    pub peak_wear_um: f64,
    /// Wear at the pitch circle, µm.
    pub pitch_wear_um: f64,
}
