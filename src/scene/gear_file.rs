//! What a user may write of one gear: `[pair.pinion]` and `[pair.wheel]` of the scene file.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::measured_flank::file::FlankSide;
use gearwear_bodies::gear::modification::ReliefShape;
use gearwear_bodies::gear::shaft::EndFace;
use gearwear_bodies::gear_mesh::settings::ToothOnPins;

/// What carries the teeth of a gear and twists under the torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShaftFile {
    /// Diameter that twists in mm, > 0; on a pinion shaft about the root diameter.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub diameter_mm: f64,
    /// Bore diameter in mm, 0 or more. Default 0.
    #[schemars(range(min = 0))]
    pub bore_diameter_mm: Option<f64>,
    /// End face at which the torque enters. Default: start.
    pub driven_at: Option<EndFace>,
    /// Coordinates of two bearings along the axis from the middle of the face width in mm, increasing. Default: none, the shaft stays straight.
    pub bearing_positions_mm: Option<[f64; 2]>,
    /// Radial stiffness of each bearing with its housing in N/mm, above 0.
    pub bearing_stiffness_N_per_mm: Option<[f64; 2]>,
}

/// Shaper cutter of internal teeth; factors of the module that is given.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutterFile {
    /// Number of teeth z_0, 5 to 10000, less than the wheel's.
    #[schemars(range(min = 5, max = 10000))]
    pub teeth: u32,
    /// Profile shift coefficient x_0, −5 to 5. Default 0.
    #[schemars(range(min = -5, max = 5))]
    pub profile_shift: Option<f64>,
    /// Addendum factor h_a0*, > 0 to 3. Default 1.25.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 3))]
    pub addendum_factor: Option<f64>,
    /// Radius of its tip edge, 0 to 1. Default 0.2.
    #[schemars(range(min = 0, max = 1))]
    pub tip_rounding_factor: Option<f64>,
}

/// Pins that hold a ring at its outside, at the tooth spaces nearest to even angles; rigid, and the ring may turn about each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RimPinsFile {
    /// Number of pins, at most half the number of teeth.
    #[schemars(range(min = 2))]
    pub count: u32,
    /// Place of the tooth in mesh. Default: between-pins.
    pub tooth: Option<ToothOnPins>,
}

/// One gear.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GearFile {
    /// Number of teeth z, 5 to 10000. Required without a preset.
    #[schemars(range(min = 5, max = 10000))]
    pub teeth: Option<u32>,
    /// Internal teeth, of the wheel alone. Default false.
    pub internal: Option<bool>,
    /// Root diameter d_f of internal teeth in mm, > 0. Default: that of basic rack or cutter.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub root_diameter_mm: Option<f64>,
    /// Thickness of the rim of internal teeth in mm, > 0: from the root circle to the outside, where the ring is held; at least a tenth of a module.
    /// Default: 3.5 transverse modules.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rim_thickness_mm: Option<f64>,
    /// Pins that hold the rim of internal teeth. Default: none, it is held all round its outside.
    pub rim_pins: Option<RimPinsFile>,
    /// Shaper cutter of internal teeth. Default: none, a circular fillet.
    pub cutter: Option<CutterFile>,
    /// Profile shift coefficient x of the module that is given, −5 to 5. Required without a preset.
    #[schemars(range(min = -5, max = 5))]
    pub profile_shift: Option<f64>,
    /// Tip diameter d_a in mm, > 0. Default: d + 2 m (x + h_aP*), shortened where the tip clearance asks for it, and of a ring where it would interfere.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tip_diameter_mm: Option<f64>,
    /// Tooth thickness allowance E_sn in the normal section in µm; negative thins the tooth. Default 0.
    pub tooth_thickness_allowance_um: Option<f64>,
    /// Bore diameter in mm, > 0: lower limit of the clamp radius. Default: none.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bore_diameter_mm: Option<f64>,
    /// Profile crowning in µm, 0 or more: a parabola over the active profile. Default 0.
    #[schemars(range(min = 0))]
    pub profile_crowning_um: Option<f64>,
    /// Profile-slope deviation f_Hα over the active profile in µm (ISO 1328-1); positive: material is missing at its start, negative: at the tip.
    /// Default 0.
    pub profile_slope_deviation_um: Option<f64>,
    /// Lead crowning in µm, 0 or more: a parabola over the face width. Default 0.
    #[schemars(range(min = 0))]
    pub lead_crowning_um: Option<f64>,
    /// Helix-slope deviation over the face width in µm, misalignment included; positive: material is missing at the full width. Default 0.
    pub helix_slope_deviation_um: Option<f64>,
    /// Flank tolerance class of ISO 1328-1:2013, 1 to 11, instead of the helix-slope deviation, which becomes the tolerance f_HβT.
    #[schemars(range(min = 1, max = 11))]
    pub helix_slope_class: Option<u32>,
    /// Radius of the tip edge in mm, 0 or more; below a thousandth of the module it counts as sharp. Default 0.
    #[schemars(range(min = 0))]
    pub tip_rounding_mm: Option<f64>,
    /// Radial height h_K of the tip chamfer in mm, 0 or more: the flank ends at the tip form diameter d_a − 2 h_K, of a ring d_a + 2 h_K. Default 0.
    #[schemars(range(min = 0))]
    pub tip_chamfer_mm: Option<f64>,
    /// Transverse angle of the tip chamfer to the radius in degrees, 5 to 80. Default 45.
    #[schemars(range(min = 5, max = 80))]
    pub tip_chamfer_deg: Option<f64>,
    /// Arithmetic mean roughness Ra in µm, 0.0001 to 50; needed by films and friction. Default: none.
    #[schemars(range(min = 0.0001, max = 50))]
    pub roughness_Ra_um: Option<f64>,
    /// Ra of run-in and worn flanks in µm, 0.0001 to 50. Default: that of the new ones.
    #[schemars(range(min = 0.0001, max = 50))]
    pub roughness_run_in_Ra_um: Option<f64>,
    /// Root mean square roughness Rq in µm, 0.0001 to 60. Default: 1.2533 Ra.
    #[schemars(range(min = 0.0001, max = 60))]
    pub roughness_Rq_um: Option<f64>,
    /// Relief towards the tip. Default: none.
    pub tip_relief: Option<ReliefFile>,
    /// Relief towards the root. Default: none.
    pub root_relief: Option<ReliefFile>,
    /// Relief towards both ends of the face width. Default: none.
    pub end_relief: Option<EndReliefFile>,
    /// Flank as it was measured, with which the run begins. Default: none, the design profile.
    pub initial_flank: Option<InitialFlankFile>,
    /// Elastic twist over the face width under the torque, with at most 100 slices. Default: none.
    pub shaft: Option<ShaftFile>,
}

/// Measured profile of a gear's flank, in the formats that compare reads. Heights stand for the whole flank, in place of tip_relief, root_relief and
/// profile_crowning_um; depths of wear come beside them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialFlankFile {
    /// Name of the file, beside the scene.
    pub file: String,
    /// Flank, left or right, of a file with both. Default: the one there is.
    pub flank: Option<FlankSide>,
    /// Tooth of a file with several. Default: the mean of all.
    #[schemars(range(min = 1))]
    pub tooth: Option<u32>,
    /// Place over the face width in mm, of a file with several profiles; the nearest is taken. Default: the one there is.
    #[schemars(range(min = 0))]
    pub width_mm: Option<f64>,
    /// Cutoff of the Gaussian filter in mm of roll length, 0 or more; 0: none. Default: a thirtieth of the active profile, at least 0.05.
    #[schemars(range(min = 0))]
    pub cutoff_mm: Option<f64>,
}

/// Tip or root relief; where it begins is said in one of three ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReliefFile {
    /// Material removed at the end of the flank along its normal in µm, 0 or more.
    #[schemars(range(min = 0))]
    pub amount_um: f64,
    /// Roll length of the relief along the path of contact in mm, > 0. Required, or begins_at_diameter_mm or begins_at_roll_angle_deg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_mm: Option<f64>,
    /// Diameter at which the relief begins in mm, > 0, instead of its length.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub begins_at_diameter_mm: Option<f64>,
    /// Roll angle from the base circle at which it begins in degrees, > 0, instead of its length.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub begins_at_roll_angle_deg: Option<f64>,
    /// Growth of the relief from its start. Default: linear.
    pub shape: Option<ReliefShape>,
}

/// End relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EndReliefFile {
    /// Material removed at the end faces along the normal of the flank in µm, 0 or more.
    #[schemars(range(min = 0))]
    pub amount_um: f64,
    /// Length of the relief along the face width at either end in mm, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_mm: f64,
    /// Growth of the relief from its start. Default: linear.
    pub shape: Option<ReliefShape>,
}
