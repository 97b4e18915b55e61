//! What a user may write of the gear bodies as finite elements: `[fem]` of the scene file.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::gear_mesh::settings::SectorSides;

/// The gear bodies as finite elements.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FemFile {
    /// How much of each gear is meshed. Default: ring.
    pub body: Option<BodyKind>,
    /// Teeth of a sector, an odd number from 1; read with body = "sector". Default 3.
    #[schemars(range(min = 1, max = 9999))]
    pub sector_teeth: Option<u32>,
    /// What holds the cut sides of a sector; read with body = "sector". Default: free.
    pub sector_sides: Option<SectorSides>,
    /// Radii at which the bodies are held or turned rigidly, rim or bore. Default: root radius less 2.5 transverse modules,
    /// or the bore where that is larger.
    pub clamp_radius_mm: Option<ClampRadiusFile>,
    /// Webs that carry the rims of the gears. A pair with one is taken in slices over the face width; finite elements in space see it, plane ones
    /// do not. Default: none; bodies are discs as wide as the teeth.
    pub web: Option<WebsFile>,
    /// Elements in the half-width of contact under the whole load, 2 to 60: the resolution. Default 10, and 3 in a wear
    /// run (5 with severe wear), which resolve its wear as well.
    #[schemars(range(min = 2, max = 60))]
    pub elements_per_half_width: Option<f64>,
}

/// How much of a gear is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum BodyKind {
    /// All teeth; the ones that touch are resolved.
    #[default]
    Ring,
    /// Some teeth, centred on the one in mesh.
    Sector,
}

/// A clamp radius for each gear.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClampRadiusFile {
    /// Of the pinion in mm, > 0. Default: root radius less 2.5 transverse modules, or the bore where that is larger.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion: Option<f64>,
    /// Of the wheel in mm, > 0. Default: root radius less 2.5 transverse modules, or the bore where that is larger.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheel: Option<f64>,
}

/// A web for each gear that has one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WebsFile {
    /// Of the pinion.
    pub pinion: Option<WebFile>,
    /// Of the wheel.
    pub wheel: Option<WebFile>,
}

impl WebsFile {
    /// Whether a gear has one.
    pub(crate) fn has_one(&self) -> bool {
        self.pinion.is_some() || self.wheel.is_some()
    }
}

/// What carries a rim as wide as the teeth: a disc that is held at fem.clamp_radius_mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WebFile {
    /// Thickness b_s of the web along the axis in mm, > 0: at least a tenth of a module, and at most the face width.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness_mm: f64,
    /// Thickness s_R of the rim from the root circle to where the web begins in mm, > 0: at least a quarter of a module. It leaves a tenth of a module of
    /// web above fem.clamp_radius_mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rim_thickness_mm: f64,
    /// Place of its middle over the face width from that of the teeth in mm, positive towards greater z. Default 0.
    pub offset_mm: Option<f64>,
}
