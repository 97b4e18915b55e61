//! What a user may write of the gear bodies as finite elements: `[fem]` of the scene file.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear_mesh::settings::SectorSides;

/// The gear bodies as finite elements.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FemFile {
    /// How much of each gear is meshed. Default: ring.
    pub body: Option<BodyKind>,
    /// Teeth of a sector, 1 to 9999, odd. Default 3.
    #[schemars(range(min = 1, max = 9999))]
    pub sector_teeth: Option<u32>,
    /// Support of the cut sides of a sector. Default: free.
    pub sector_sides: Option<SectorSides>,
    /// Radii at which the bodies are held or turned rigidly.
    pub clamp_radius_mm: Option<ClampRadiusFile>,
    /// Webs that carry the rims: the pair is taken in slices, and finite elements in space see the web. Default: discs as wide as the teeth.
    pub web: Option<WebsFile>,
    /// Elements in the half-width of contact, 2 to 60. Default 10; in a wear run 3, of internal pairs 4, with severe wear 5.
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
    /// Clamp radius of the pinion in mm, > 0. Default: 2.5 transverse modules below the root circle, or the bore where that is larger.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion: Option<f64>,
    /// Clamp radius of the wheel in mm, > 0. Default: likewise.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wheel: Option<f64>,
}

/// A web for each gear that has one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WebsFile {
    /// Web of the pinion.
    pub pinion: Option<WebFile>,
    /// Web of the wheel.
    pub wheel: Option<WebFile>,
}

impl WebsFile {
    /// Whether a gear has one.
    pub fn has_one(&self) -> bool {
        self.pinion.is_some() || self.wheel.is_some()
    }
}

/// What carries a rim as wide as the teeth: a disc that is held at fem.clamp_radius_mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WebFile {
    /// Thickness b_s of the web in mm, > 0: from a tenth of a module to the face width.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness_mm: f64,
    /// Thickness s_R of the rim below the root circle in mm, > 0: at least a quarter of a module; a tenth of a module of web must remain above
    /// fem.clamp_radius_mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rim_thickness_mm: f64,
    /// Axial offset of the middle of the web from that of the teeth in mm. Default 0.
    pub offset_mm: Option<f64>,
}
