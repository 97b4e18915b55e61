//! How the gear bodies are meshed, as plain data.

use serde::{Deserialize, Serialize};

use crate::gear::PerGear;

/// Elements along each fillet of a tooth that is resolved.
pub(crate) const FILLET_ELEMENTS: u32 = 24;
/// Half-widths of contact below the start of active profile where the resolved part of a flank begins.
pub(crate) const MARGIN_HALF_WIDTHS: f64 = 3.0;
/// Depth of the structured layer under a flank, in half-widths of contact.
pub(crate) const DEPTH_HALF_WIDTHS: f64 = 1.0;

/// Half-width of contact on a rounded tip edge over its radius, for the length of elements there.
pub(crate) const ROUNDING_HALF_WIDTH: f64 = 0.3;

/// Depth of the body below the root circle, in normal modules, where nothing else is given.
const BODY_MODULES: f64 = 2.5;
/// Least clamp radius that leaves, over the root radius; what is taken where it leaves less.
const LEAST_OVER_ROOT: f64 = 0.2;
const SMALL_OVER_ROOT: f64 = 0.4;

/// The bodies of a gear pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodySettings {
    /// How much of each gear.
    pub body: Body,
    /// Where each body is held or turned rigidly: its rim or bore.
    pub clamp_radius_mm: PerGear<f64>,
    /// Elements in the local half-width of contact under the whole load.
    pub elements_per_half_width: f64,
}

/// How much of a gear is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// All teeth; the ones that touch are resolved.
    Ring,
    /// Some teeth, centred on the one in mesh.
    Sector {
        /// Odd.
        teeth: u32,
        /// What holds the cuts.
        sides: SectorSides,
    },
}

/// What holds the cut sides of a sector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SectorSides {
    /// Nothing.
    #[default]
    Free,
    /// They move with the clamp circle.
    Clamped,
}

/// Body that must be left below the root circle, in normal modules.
const LEAST_BODY_MODULES: f64 = 0.1;

/// Greatest clamp radius of a gear: a tenth of a module below its root circle.
pub(crate) fn greatest_clamp_mm(root_radius_mm: f64, normal_module_mm: f64) -> f64 {
    root_radius_mm - LEAST_BODY_MODULES * normal_module_mm
}

/// A clamp radius chosen where none is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DefaultClamp {
    /// The radius.
    pub radius_mm: f64,
    /// Whether the gear is too small for the usual depth of 2.5 modules below the root circle.
    pub small_gear: bool,
}

/// The clamp radius of a gear where none is given: the root radius less 2.5 transverse modules, so that pairs of the same transverse section
/// have the same bodies, or 0.4 of the root radius where that would leave less than 0.2 of it.
pub(crate) fn default_clamp(root_radius_mm: f64, transverse_module_mm: f64) -> DefaultClamp {
    let radius_mm = root_radius_mm - BODY_MODULES * transverse_module_mm;
    if radius_mm > LEAST_OVER_ROOT * root_radius_mm {
        DefaultClamp { radius_mm, small_gear: false }
    } else {
        DefaultClamp { radius_mm: SMALL_OVER_ROOT * root_radius_mm, small_gear: true }
    }
}
