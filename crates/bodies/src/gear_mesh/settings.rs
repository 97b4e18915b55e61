//! Settings of the meshes of gear bodies.

use serde::{Deserialize, Serialize};

use crate::gear::{PerGear, spec::PairSpec};

/// Elements along each fillet of a tooth that is resolved.
pub(crate) const FILLET_ELEMENTS: u32 = 24;
/// Arc of flank that is resolved below the start of active profile, in half-widths of contact.
pub(crate) const MARGIN_HALF_WIDTHS: f64 = 3.0;
/// Depth of the structured layer under a flank, in half-widths of contact.
pub(crate) const DEPTH_HALF_WIDTHS: f64 = 1.0;

/// Element length where a linear relief begins, on either flank, over that elsewhere.
pub(crate) const AT_KINK: f64 = 1.0 / 3.0;

/// Half-width of contact on a rounded tip edge over its radius, for the length of elements there.
const ROUNDING_HALF_WIDTH: f64 = 0.3;

/// Element length on a tip rounding, mm, with a refinement ([`BodySettings::rounding_refinement`]).
pub fn rounding_element_mm(rounding_mm: f64, elements_per_half_width: f64, refinement: f64) -> f64 {
    ROUNDING_HALF_WIDTH * rounding_mm / (elements_per_half_width * refinement)
}

/// Element length at a kink of a flank, mm, in a contact of this half-width.
pub fn kink_element_mm(half_width_mm: f64, elements_per_half_width: f64) -> f64 {
    AT_KINK * half_width_mm / elements_per_half_width
}

/// Default depth of the body below the root circle, in transverse modules.
const BODY_MODULES: f64 = 2.5;
/// Default thickness of the rim of an internal wheel, in transverse modules.
const RING_MODULES: f64 = 3.5;
/// Least default clamp radius over the root radius.
const LEAST_OVER_ROOT: f64 = 0.2;
/// Clamp radius over the root radius of smaller gears.
const SMALL_OVER_ROOT: f64 = 0.4;

/// The bodies of a gear pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodySettings {
    /// Part of each gear that is meshed.
    pub body: Body,
    /// Radius at which each body is held or turned rigidly: rim or bore, or the outside of an internal wheel, negative as its radii.
    pub clamp_radius_mm: PerGear<f64>,
    /// Webs that carry rims, in three dimensions only: plane elements are as wide as the teeth.
    pub web: PerGear<Option<Web>>,
    /// Pins that hold an internal wheel; `None`: its outside is held all round.
    pub rim_pins: Option<RimPins>,
    /// Elements in the local half-width of contact under the whole load.
    pub elements_per_half_width: f64,
    /// Factor of refinement on tip roundings and where these touch the mate: 1; more for tip edges that are hardly worn in,
    /// whose contact is narrower.
    pub rounding_refinement: f64,
}

impl BodySettings {
    /// Whole rings on their clamp circles, without webs and pins.
    pub fn rings(clamp_radius_mm: PerGear<f64>, elements_per_half_width: f64) -> Self {
        Self {
            body: Body::Ring,
            clamp_radius_mm,
            web: NO_WEBS,
            rim_pins: None,
            elements_per_half_width,
            rounding_refinement: 1.0,
        }
    }

    /// Bodies of the three-dimensional tooth model.
    pub fn in_space(&self) -> PerGear<SpaceBody> {
        PerGear::from_fn(|gear| SpaceBody { clamp_radius_mm: self.clamp_radius_mm[gear], web: self.web[gear] })
    }
}

/// Body of the three-dimensional tooth model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceBody {
    /// Radius at which the body is held.
    pub clamp_radius_mm: f64,
    /// Web that carries the rim; `None` for a disc as wide as the teeth.
    pub web: Option<Web>,
}

/// Web that carries a rim as wide as the teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Web {
    /// Web thickness b_s, at most the face width.
    pub thickness_mm: f64,
    /// Rim thickness s_R below the root circle.
    pub rim_thickness_mm: f64,
    /// Offset of the middle of the web from that of the face width, positive towards greater z.
    pub offset_mm: f64,
}

/// Two discs as wide as the teeth.
pub const NO_WEBS: PerGear<Option<Web>> = PerGear { pinion: None, wheel: None };

impl Web {
    /// Faces of the web over a face width, from z = 0 on.
    pub fn from_to_mm(&self, face_width_mm: f64) -> [f64; 2] {
        [-0.5, 0.5].map(|side| 0.5 * face_width_mm + self.offset_mm + side * self.thickness_mm)
    }
}

/// Part of a gear that is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// All teeth; those that touch are resolved.
    Ring,
    /// Some teeth, centred on the one in mesh.
    Sector {
        /// Number of teeth, odd.
        teeth: u32,
        /// Support of the cuts.
        sides: SectorSides,
    },
}

/// Pins that hold a ring at its outside circle, at even angles; each holds a point, about which the ring may turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RimPins {
    /// Number of pins.
    pub count: u32,
    /// Place of the tooth in mesh.
    pub tooth: ToothOnPins,
}

/// Place of the tooth in mesh on a ring that pins hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToothOnPins {
    /// Midway between two pins, to half a pitch.
    #[default]
    BetweenPins,
    /// Beside a pin, half a pitch from it.
    AtPin,
}

impl RimPins {
    /// Least number of pins that holds a ring.
    pub const LEAST: u32 = 2;

    /// Cuts between the sectors of a ring of `teeth` that have a pin, rising: cut s is on the clockwise side of the tooth s pitches anticlockwise of
    /// the one in mesh. Pins lie at the cuts nearest to even angles.
    pub fn cuts(&self, teeth: u32) -> Vec<u32> {
        let spacing = f64::from(teeth) / f64::from(self.count);
        let first = match self.tooth {
            ToothOnPins::AtPin => 1.0,
            ToothOnPins::BetweenPins => 0.5 * (spacing + 1.0),
        };
        let mut cuts: Vec<u32> =
            (0..self.count).map(|pin| (first + f64::from(pin) * spacing).round() as u32 % teeth).collect();
        cuts.sort_unstable();
        cuts.dedup();
        cuts
    }
}

/// Support of the cut sides of a sector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SectorSides {
    /// No support.
    #[default]
    Free,
    /// Rigid with the clamp circle.
    Clamped,
}

/// Least depth of the body below the root circle, in normal modules.
const LEAST_BODY_MODULES: f64 = 0.1;

/// Greatest clamp radius of a gear, a tenth of a module below its root circle, where radii of an internal gear are negative.
pub fn greatest_clamp_mm(root_radius_mm: f64, normal_module_mm: f64) -> f64 {
    root_radius_mm - LEAST_BODY_MODULES * normal_module_mm
}

/// Least thickness of a rim on a web, in normal modules: rows of elements between the fillets would sag through a thinner one.
const LEAST_RIM_MODULES: f64 = 0.25;

/// Least and greatest thickness of a rim on a web, below which the least depth of a body is left; where they cross, there is no room for a web.
pub fn rim_thickness_limits_mm(root_radius_mm: f64, clamp_radius_mm: f64, normal_module_mm: f64) -> [f64; 2] {
    let left_mm = greatest_clamp_mm(root_radius_mm, normal_module_mm) - clamp_radius_mm;
    [LEAST_RIM_MODULES * normal_module_mm, left_mm]
}

/// Default thickness of the rim of an internal wheel, 3.5 transverse modules.
pub fn default_ring_rim_mm(transverse_module_mm: f64) -> f64 {
    RING_MODULES * transverse_module_mm
}

/// Least thickness of the rim of an internal wheel.
pub fn least_ring_rim_mm(normal_module_mm: f64) -> f64 {
    LEAST_BODY_MODULES * normal_module_mm
}

/// Least thickness of a web along the axis, a tenth of a module.
pub fn least_web_mm(normal_module_mm: f64) -> f64 {
    LEAST_BODY_MODULES * normal_module_mm
}

/// Default clamp radius of a gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefaultClamp {
    /// Clamp radius.
    pub radius_mm: f64,
    /// Whether the gear is too small for the usual depth of 2.5 modules below the root circle.
    pub small_gear: bool,
}

/// Default clamp radius of a gear: the root radius less 2.5 transverse modules, so that pairs of the same transverse section
/// have the same bodies, or 0.4 of the root radius where that would leave less than 0.2 of it; of an internal wheel, 3.5 transverse modules outside it.
pub fn default_clamp(root_radius_mm: f64, transverse_module_mm: f64) -> DefaultClamp {
    if root_radius_mm < 0.0 {
        let radius_mm = root_radius_mm - default_ring_rim_mm(transverse_module_mm);
        return DefaultClamp { radius_mm, small_gear: false };
    }
    let radius_mm = root_radius_mm - BODY_MODULES * transverse_module_mm;
    if radius_mm > LEAST_OVER_ROOT * root_radius_mm {
        DefaultClamp { radius_mm, small_gear: false }
    } else {
        DefaultClamp { radius_mm: SMALL_OVER_ROOT * root_radius_mm, small_gear: true }
    }
}

/// Numbers of elements of a tooth section.
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

/// Resolution of the three-dimensional tooth model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceResolution {
    /// Elements of the transverse section.
    pub section: SectionDivisions,
    /// Length of an element over the face width, in normal modules.
    pub layer_modules: f64,
    /// Least and greatest number of elements over the face width.
    pub layers: [usize; 2],
    /// Number of slices over the face width, with whose ends those of elements coincide; `None` for even elements.
    pub slices: Option<usize>,
}

impl SpaceResolution {
    /// Resolution that is enough for the compliance of a tooth beside the local contact flattening.
    pub const USUAL: Self = Self {
        section: SectionDivisions { across: 6, fillet: 2, flank: 8, land: 1, radial: 3 },
        layer_modules: 0.32,
        layers: [6, 24],
        slices: None,
    };

    /// Usual resolution for a pair in `count` slices.
    pub fn of_slices(count: usize) -> Self {
        Self { slices: Some(count), ..Self::USUAL }
    }

    /// Memory for condensing the sectors of both gears of `pair`, GB: measured on the presets `helical` and `h501`, quadratic in the number of nodes on
    /// flank and cuts.
    pub fn memory_gb(&self, pair: &PairSpec, bodies: &PerGear<SpaceBody>) -> f64 {
        0.03 + 0.00043 * (self.layers(pair, bodies) as f64).powi(2)
    }

    /// Number of elements over the face width of `pair`.
    pub fn layers(&self, pair: &PairSpec, bodies: &PerGear<SpaceBody>) -> usize {
        self.layer_ends_mm(pair, bodies).len() - 1
    }

    /// Ends of elements over the face width of `pair`, from z = 0 on. Elements at both end faces, near which the compliance changes over less than
    /// a module, and those that a face of a web cuts are divided.
    pub fn layer_ends_mm(&self, pair: &PairSpec, bodies: &PerGear<SpaceBody>) -> Vec<f64> {
        let even = self.even_layers(pair);
        let mut places: Vec<f64> = (0..=even).map(|k| k as f64).collect();
        if let Some(slices) = self.slices {
            // A layer of several slices is divided between two of them.
            let in_layer = slices / even;
            let first = if in_layer > 1 { (in_layer / 2) as f64 / in_layer as f64 } else { 0.5 };
            places.insert(1, first);
            places.insert(even + 1, even as f64 - first);
        }
        let mut ends: Vec<f64> = places.into_iter().map(|place| pair.face_width_mm * place / even as f64).collect();
        let webs = [bodies.pinion.web, bodies.wheel.web].into_iter().flatten();
        for face_mm in webs.flat_map(|web| web.from_to_mm(pair.face_width_mm)) {
            if ends.iter().all(|end| (end - face_mm).abs() > SAME_PLACE * pair.face_width_mm) {
                ends.insert(ends.partition_point(|end| *end < face_mm), face_mm);
            }
        }
        ends
    }

    /// Number of even elements over the face width of `pair`, before those at its end faces are divided.
    ///
    /// Each has the same number of slices, or each slice the same number of elements: the work of a slice's load on an element depends on its
    /// place in the element, and would otherwise differ from slice to slice. Two slices in an element are resolved, and an element may
    /// be two thirds longer, for those at the end faces are divided.
    pub fn even_layers(&self, pair: &PairSpec) -> usize {
        let [least, most] = self.layers;
        let wanted = (pair.face_width_mm / (self.layer_modules * pair.normal_module_mm)).ceil() as usize;
        let wanted = wanted.clamp(least, most);
        let Some(slices) = self.slices else { return wanted };
        // Where the overlap ratio is about one or more, the transmission error is small, and a ripple of the elements would be a large part of it.
        let part = if pair.overlap_ratio() < WIDE_OVERLAP { BETWEEN_SLICES } else { 1.0 };
        let ideal = (part * wanted as f64).max(0.5 * slices as f64).min(most as f64);
        let aligned = (least..=most).filter(|layers| slices % layers == 0 || layers % slices == 0);
        let nearest = aligned
            .map(|layers| (layers, (layers as f64 / ideal).ln().abs()))
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
            .filter(|(_, off)| *off < MOST_OFF.ln());
        nearest.map_or(wanted, |(layers, _)| layers)
    }
}

/// Part of the usual number of layers that is enough between slices.
const BETWEEN_SLICES: f64 = 0.6;
/// Overlap ratio from which all of them are needed.
const WIDE_OVERLAP: f64 = 0.8;

/// Least distance of two ends of elements, in face widths.
pub(super) const SAME_PLACE: f64 = 1e-6;

/// Greatest ratio, either way, of the number of elements aligned with slices to the wanted one.
const MOST_OFF: f64 = 1.8;
