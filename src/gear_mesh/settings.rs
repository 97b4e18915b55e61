//! How the gear bodies are meshed, as plain data.

use serde::{Deserialize, Serialize};

use crate::gear::{PerGear, spec::PairSpec};

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

/// Elements along each side of the grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SectionDivisions {
    /// Across the tooth.
    pub across: usize,
    /// Along the upper half of a fillet.
    pub fillet: usize,
    /// Along a flank.
    pub flank: usize,
    /// Along the outline from a cut to the middle of the fillet.
    pub land: usize,
    /// From the outline to the clamp circle.
    pub radial: usize,
}

/// How finely teeth are meshed in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpaceResolution {
    /// Elements of the section.
    pub section: SectionDivisions,
    /// Length of an element over the face width, in normal modules.
    pub layer_modules: f64,
    /// Least and greatest number of them.
    pub layers: [usize; 2],
}

impl SpaceResolution {
    /// What is enough for the compliance of a tooth beside its local flattening.
    pub(crate) const USUAL: Self = Self {
        section: SectionDivisions { across: 6, fillet: 2, flank: 8, land: 1, radial: 3 },
        layer_modules: 0.32,
        layers: [6, 24],
    };

    /// Memory that condensing the sectors of both gears of `pair` takes, GB: measured on the preset `helical` at 8 to 90 mm, where it grows with
    /// the square of the nodes on flank and cuts.
    pub(crate) fn memory_gb(&self, pair: &PairSpec) -> f64 {
        let layers = self.layers_over(pair) as f64;
        0.2 + 0.0018 * layers * layers
    }

    /// Elements over the face width of `pair`.
    pub(super) fn layers_over(&self, pair: &PairSpec) -> usize {
        let wanted = (pair.face_width_mm / (self.layer_modules * pair.normal_module_mm)).ceil() as usize;
        wanted.clamp(self.layers[0], self.layers[1])
    }
}
