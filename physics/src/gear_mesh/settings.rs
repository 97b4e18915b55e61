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
const ROUNDING_HALF_WIDTH: f64 = 0.3;

/// Length of the elements on a tip rounding, where these are no shorter than any may be, mm; divided by `refinement`
/// ([`BodySettings::rounding_refinement`]).
pub fn rounding_element_mm(rounding_mm: f64, elements_per_half_width: f64, refinement: f64) -> f64 {
    ROUNDING_HALF_WIDTH * rounding_mm / (elements_per_half_width * refinement)
}

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
    /// Webs that carry rims, in space only: plane elements are as wide as the teeth.
    pub web: PerGear<Option<Web>>,
    /// Elements in the local half-width of contact under the whole load.
    pub elements_per_half_width: f64,
    /// Elements on tip roundings, and where these touch the mate, over those in as long a contact elsewhere: 1; more for tip edges that are hardly worn in,
    /// whose contact is narrower.
    pub rounding_refinement: f64,
}

impl BodySettings {
    /// The bodies of teeth in space.
    pub fn in_space(&self) -> PerGear<SpaceBody> {
        PerGear::from_fn(|gear| SpaceBody { clamp_radius_mm: self.clamp_radius_mm[gear], web: self.web[gear] })
    }
}

/// A body of teeth in space, from its outline to where it is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceBody {
    /// Where it is held.
    pub clamp_radius_mm: f64,
    /// What carries its rim; none: it is a disc as wide as the teeth.
    pub web: Option<Web>,
}

/// A web that carries a rim as wide as the teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Web {
    /// b_s, at most the face width.
    pub thickness_mm: f64,
    /// s_R, from the root circle to where the web begins.
    pub rim_thickness_mm: f64,
    /// Its middle from that of the face width, positive towards greater z.
    pub offset_mm: f64,
}

/// Two discs as wide as the teeth.
pub const NO_WEBS: PerGear<Option<Web>> = PerGear { pinion: None, wheel: None };

impl Web {
    /// Where it begins and ends over a face width, from z = 0 on.
    pub fn from_to_mm(&self, face_width_mm: f64) -> [f64; 2] {
        [-0.5, 0.5].map(|side| 0.5 * face_width_mm + self.offset_mm + side * self.thickness_mm)
    }
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
pub fn greatest_clamp_mm(root_radius_mm: f64, normal_module_mm: f64) -> f64 {
    root_radius_mm - LEAST_BODY_MODULES * normal_module_mm
}

/// Least thickness of a rim on a web, in normal modules: the rows of elements between the fillets sag into a thinner one.
const LEAST_RIM_MODULES: f64 = 0.25;

/// Least and greatest thickness of a rim on a web that leaves as much below it as a body must have below its root circle; where they cross, there
/// is room for none.
pub fn rim_thickness_limits_mm(root_radius_mm: f64, clamp_radius_mm: f64, normal_module_mm: f64) -> [f64; 2] {
    let left_mm = greatest_clamp_mm(root_radius_mm, normal_module_mm) - clamp_radius_mm;
    [LEAST_RIM_MODULES * normal_module_mm, left_mm]
}

/// Least thickness of a web along the axis: a tenth of a module.
pub fn least_web_mm(normal_module_mm: f64) -> f64 {
    LEAST_BODY_MODULES * normal_module_mm
}

/// A clamp radius chosen where none is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefaultClamp {
    /// The radius.
    pub radius_mm: f64,
    /// Whether the gear is too small for the usual depth of 2.5 modules below the root circle.
    pub small_gear: bool,
}

/// The clamp radius of a gear where none is given: the root radius less 2.5 transverse modules, so that pairs of the same transverse section
/// have the same bodies, or 0.4 of the root radius where that would leave less than 0.2 of it.
pub fn default_clamp(root_radius_mm: f64, transverse_module_mm: f64) -> DefaultClamp {
    let radius_mm = root_radius_mm - BODY_MODULES * transverse_module_mm;
    if radius_mm > LEAST_OVER_ROOT * root_radius_mm {
        DefaultClamp { radius_mm, small_gear: false }
    } else {
        DefaultClamp { radius_mm: SMALL_OVER_ROOT * root_radius_mm, small_gear: true }
    }
}

/// Elements along each side of the grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SectionDivisions {
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
pub struct SpaceResolution {
    /// Elements of the section.
    pub section: SectionDivisions,
    /// Length of an element over the face width, in normal modules.
    pub layer_modules: f64,
    /// Least and greatest number of them.
    pub layers: [usize; 2],
    /// Slices over the face width that elements end with; none: elements are as long as each other.
    pub slices: Option<usize>,
}

impl SpaceResolution {
    /// What is enough for the compliance of a tooth beside its local flattening.
    pub const USUAL: Self = Self {
        section: SectionDivisions { across: 6, fillet: 2, flank: 8, land: 1, radial: 3 },
        layer_modules: 0.32,
        layers: [6, 24],
        slices: None,
    };

    /// The same for a pair in so many slices.
    pub fn of_slices(count: usize) -> Self {
        Self { slices: Some(count), ..Self::USUAL }
    }

    /// Memory that condensing the sectors of both gears of `pair` takes, GB: measured on the preset `helical` at 8 to 90 mm, where it grows with
    /// the square of the nodes on flank and cuts.
    pub fn memory_gb(&self, pair: &PairSpec, bodies: &PerGear<SpaceBody>) -> f64 {
        let layers = (self.layer_ends_mm(pair, bodies).len() - 1) as f64;
        0.2 + 0.0018 * layers * layers
    }

    /// Where elements over the face width of `pair` end, from z = 0 on: those at both end faces are divided, for there a load is left to itself over
    /// a distance that is short against a module, and those that a face of a web cuts.
    pub fn layer_ends_mm(&self, pair: &PairSpec, bodies: &PerGear<SpaceBody>) -> Vec<f64> {
        let even = self.even_layers(pair);
        let at = |place: f64| pair.face_width_mm * place / even as f64;
        let mut ends: Vec<f64> = (0..=even).map(|k| at(k as f64)).collect();
        if let Some(slices) = self.slices {
            // Slices in a layer: whole ones are left at the end face where there are some.
            let in_layer = slices / even;
            let first = if in_layer > 1 { (in_layer / 2) as f64 / in_layer as f64 } else { 0.5 };
            ends.insert(1, at(first));
            ends.insert(even + 1, at(even as f64 - first));
        }
        let webs = [bodies.pinion.web, bodies.wheel.web].into_iter().flatten();
        for face_mm in webs.flat_map(|web| web.from_to_mm(pair.face_width_mm)) {
            if ends.iter().all(|end| (end - face_mm).abs() > SAME_PLACE * pair.face_width_mm) {
                ends.insert(ends.partition_point(|end| *end < face_mm), face_mm);
            }
        }
        ends
    }

    /// Elements as long as each other over the face width of `pair`, before those at its end faces are divided.
    ///
    /// As many slices lie in each of them, or as many of them in each slice: what elements see of the load of a slice depends on where in an
    /// element it lies, and where that differs from slice to slice, so do their loads. Two slices in an element are resolved, and an element may
    /// be a quarter longer.
    pub fn even_layers(&self, pair: &PairSpec) -> usize {
        let [least, most] = self.layers;
        let wanted = (pair.face_width_mm / (self.layer_modules * pair.normal_module_mm)).ceil() as usize;
        let wanted = wanted.clamp(least, most);
        let Some(slices) = self.slices else { return wanted };
        let ideal = (0.8 * wanted as f64).max(0.5 * slices as f64).min(most as f64);
        let over = |layers: &usize| (*layers as f64 / ideal).ln().abs();
        let aligned = (least..=most).filter(|layers| slices % layers == 0 || layers % slices == 0);
        let nearest = aligned.min_by(|a, b| over(a).total_cmp(&over(b))).filter(|layers| over(layers) < MOST_OFF.ln());
        nearest.unwrap_or(wanted)
    }
}

/// Places over the face width that are no farther apart are one, in face widths.
const SAME_PLACE: f64 = 1e-6;

/// Elements over the face width that end with slices are at most so many times as many, or as few, as are wanted.
const MOST_OFF: f64 = 1.8;
