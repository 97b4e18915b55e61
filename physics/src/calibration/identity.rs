//! Identity of a calibration: every number that shapes the section of the pair, its material, and the radii at which its bodies are held.
//!
//! Names and units are those of the scene's keys, so that messages can name a difference. The face width is
//! not among them, as everything is per mm of it, nor is the helix angle by itself: pairs of one transverse section share their calibrations.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use gearwear_bodies::gear::modification::Modification;
use gearwear_bodies::gear::modification::{Relief, ReliefShape};
use gearwear_bodies::gear::ring_fillet::ShaperCutter;
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_mesh::settings::{Body, BodySettings, NO_WEBS, RimPins, SectorSides, ToothOnPins, Web};
use gearwear_bodies::material::Material;

/// Relative difference of two numbers below which they are the same: round-off of units.
const SAME: f64 = 1e-9;

/// Whether two numbers are the same but for round-off of units.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// Pair, material and bodies that a calibration belongs to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CalibrationIdentity {
    /// Geometry of the pair.
    pub pair: PairIdentity,
    /// Material of each gear.
    pub material: PerGear<MaterialIdentity>,
    /// Bodies of both gears.
    pub fem: BodyIdentity,
}

/// Geometry of a pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairIdentity {
    /// m_n.
    pub normal_module_mm: f64,
    /// α_n.
    pub pressure_angle_deg: f64,
    /// β.
    pub helix_angle_deg: f64,
    /// a.
    pub centre_distance_mm: f64,
    /// Basic rack.
    pub basic_rack: RackIdentity,
    /// The pinion.
    pub pinion: GearIdentity,
    /// The wheel.
    pub wheel: GearIdentity,
}

/// Factors of the basic rack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RackIdentity {
    /// h_aP*.
    pub addendum_factor: f64,
    /// h_fP*.
    pub dedendum_factor: f64,
    /// ρ_fP*.
    pub fillet_radius_factor: f64,
}

/// Geometry of one gear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GearIdentity {
    /// z.
    pub teeth: u32,
    /// x.
    pub profile_shift: f64,
    /// d_a, given or derived.
    pub tip_diameter_mm: f64,
    /// E_sn, µm.
    pub tooth_thickness_allowance_um: f64,
    /// Crowning, µm.
    pub profile_crowning_um: f64,
    /// Profile-slope deviation, µm.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub profile_slope_deviation_um: f64,
    /// d_f of an internal gear, given or derived.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root_diameter_mm: Option<f64>,
    /// Thickness of the rim of an internal gear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim_thickness_mm: Option<f64>,
    /// Pins that hold the rim of an internal gear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim_pins: Option<PinsIdentity>,
    /// Shaper cutter of an internal gear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutter: Option<CutterIdentity>,
    /// Tip rounding.
    pub tip_rounding_mm: f64,
    /// Radial height of the tip chamfer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_chamfer_mm: Option<f64>,
    /// Angle of the tip chamfer to the radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_chamfer_deg: Option<f64>,
    /// Tip relief.
    pub tip_relief: Option<ReliefIdentity>,
    /// Root relief.
    pub root_relief: Option<ReliefIdentity>,
}

/// Pins of a ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PinsIdentity {
    /// Number of pins.
    pub count: u32,
    /// Place of the tooth in mesh.
    pub tooth: ToothOnPins,
}

/// A shaper cutter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CutterIdentity {
    /// z_0.
    pub teeth: u32,
    /// x_0.
    pub profile_shift: f64,
    /// h_a0*.
    pub addendum_factor: f64,
    /// Radius of its tip edge, in modules.
    pub tip_rounding_factor: f64,
}

/// A relief.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReliefIdentity {
    /// Amount, µm.
    pub amount_um: f64,
    /// Length.
    pub length_mm: f64,
    /// Shape.
    pub shape: ReliefShape,
}

/// Elastic constants of one gear.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialIdentity {
    /// E, GPa.
    #[serde(rename = "young_modulus_GPa")]
    pub young_modulus_gpa: f64,
    /// ν.
    pub poisson_ratio: f64,
}

/// Modelled part of each gear, and the radius at which it is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyIdentity {
    /// `ring` or `sector`.
    pub body: String,
    /// Teeth of a sector.
    pub sector_teeth: Option<u32>,
    /// Sides of a sector.
    pub sector_sides: Option<SectorSides>,
    /// Radius of the rim or bore.
    pub clamp_radius_mm: PerGear<f64>,
    /// Web of each gear that has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub web: Option<PerGear<Option<WebIdentity>>>,
}

/// A web.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WebIdentity {
    /// b_s.
    pub thickness_mm: f64,
    /// s_R.
    pub rim_thickness_mm: f64,
    /// Distance from the middle of the face width.
    pub offset_mm: f64,
}

impl CalibrationIdentity {
    /// Identity of the pair of `spec` without its modifications, on which the stiffness of teeth hardly depends; `None` where it cannot exist.
    pub fn of_unmodified(spec: &PairSpec, material: &PerGear<Material>, bodies: &BodySettings) -> Option<Self> {
        let mut spec = spec.clone();
        for gear in Gear::BOTH {
            spec.gears[gear].modification = Modification::default();
        }
        GearPair::new(&spec).ok().map(|pair| Self::of(&pair, material, bodies))
    }

    /// Identity of a pair with its material and bodies.
    pub fn of(pair: &GearPair, material: &PerGear<Material>, bodies: &BodySettings) -> Self {
        let spec = &pair.spec;
        let (body, sector_teeth, sector_sides) = match bodies.body {
            Body::Ring => ("ring", None, None),
            Body::Sector { teeth, sides } => ("sector", Some(teeth), Some(sides)),
        };
        Self {
            pair: PairIdentity {
                normal_module_mm: spec.normal_module_mm,
                pressure_angle_deg: spec.normal_pressure_angle_rad.to_degrees(),
                helix_angle_deg: spec.helix_angle_rad.to_degrees(),
                centre_distance_mm: spec.centre_distance_mm.abs(),
                basic_rack: RackIdentity {
                    addendum_factor: spec.rack.addendum_factor,
                    dedendum_factor: spec.rack.dedendum_factor,
                    fillet_radius_factor: spec.rack.fillet_radius_factor,
                },
                pinion: GearIdentity::of(pair, Gear::Pinion, bodies),
                wheel: GearIdentity::of(pair, Gear::Wheel, bodies),
            },
            material: material.map(|own| MaterialIdentity {
                young_modulus_gpa: 1e-3 * own.young_modulus_mpa,
                poisson_ratio: own.poisson_ratio,
            }),
            fem: BodyIdentity {
                body: body.to_owned(),
                sector_teeth,
                sector_sides,
                clamp_radius_mm: bodies.clamp_radius_mm.map(f64::abs),
                web: (bodies.web != NO_WEBS).then(|| bodies.web.map(|web| web.map(WebIdentity::of))),
            },
        }
    }

    /// Differences of `scene`, as `key: calibration …, scene …`; the bodies are compared where `bodies_too`.
    pub fn differences(&self, scene: &CalibrationIdentity, bodies_too: bool) -> Vec<String> {
        let mut found = Vec::new();
        let (own, other) = match self.pair.helix_angle_deg == scene.pair.helix_angle_deg {
            true => (json(&self.pair), json(&scene.pair)),
            false => (self.pair.transverse_section(), scene.pair.transverse_section()),
        };
        compare("pair", &own, &other, &mut found);
        compare("material", &json(&self.material), &json(&scene.material), &mut found);
        if bodies_too {
            compare("fem", &json(&self.fem), &json(&scene.fem), &mut found);
        }
        found
    }
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl GearIdentity {
    fn of(pair: &GearPair, gear: Gear, bodies: &BodySettings) -> Self {
        let root_radius_mm = pair.teeth[gear].root_radius_mm;
        let spec = &pair.spec.gears[gear];
        let modification = &spec.modification;
        Self {
            teeth: spec.teeth,
            profile_shift: spec.profile_shift,
            tip_diameter_mm: 2.0 * pair.teeth[gear].tip_radius_mm.abs(),
            tooth_thickness_allowance_um: 1e3 * spec.tooth_thickness_allowance_mm,
            profile_crowning_um: 1e3 * modification.profile_crowning_mm,
            profile_slope_deviation_um: 1e3 * modification.profile_slope_mm,
            root_diameter_mm: spec.ring.map(|_| 2.0 * root_radius_mm.abs()),
            rim_thickness_mm: spec.ring.map(|_| root_radius_mm - bodies.clamp_radius_mm[gear]),
            rim_pins: bodies
                .rim_pins
                .filter(|_| spec.ring.is_some())
                .map(|RimPins { count, tooth }| PinsIdentity { count, tooth }),
            cutter: spec.ring.and_then(|ring| ring.cutter).map(|cutter| CutterIdentity::of(&cutter)),
            tip_rounding_mm: modification.tip_rounding_mm,
            tip_chamfer_mm: spec.tip_chamfer.map(|chamfer| chamfer.height_mm),
            tip_chamfer_deg: spec.tip_chamfer.map(|chamfer| chamfer.angle_rad.to_degrees()),
            tip_relief: modification.tip_relief.map(ReliefIdentity::of),
            root_relief: modification.root_relief.map(ReliefIdentity::of),
        }
    }

    /// The gear in the transverse section, where β has the cosine `cos`.
    fn in_transverse_section(&self, cos: f64) -> Self {
        Self {
            profile_shift: self.profile_shift * cos,
            tooth_thickness_allowance_um: self.tooth_thickness_allowance_um / cos,
            cutter: self.cutter.as_ref().map(|cutter| cutter.in_transverse_section(cos)),
            ..self.clone()
        }
    }
}

impl PairIdentity {
    /// Transverse section, as the scene's transverse keys would give it.
    fn transverse_section(&self) -> Value {
        let cos = self.helix_angle_deg.to_radians().cos();
        let RackIdentity { addendum_factor, dedendum_factor, fillet_radius_factor } = self.basic_rack;
        serde_json::json!({
            "transverse_module_mm": self.normal_module_mm / cos,
            "transverse_pressure_angle_deg": (self.pressure_angle_deg.to_radians().tan() / cos).atan().to_degrees(),
            "centre_distance_mm": self.centre_distance_mm,
            "basic_rack": RackIdentity {
                addendum_factor: addendum_factor * cos,
                dedendum_factor: dedendum_factor * cos,
                fillet_radius_factor: fillet_radius_factor * cos,
            },
            "pinion": self.pinion.in_transverse_section(cos),
            "wheel": self.wheel.in_transverse_section(cos),
        })
    }
}

impl CutterIdentity {
    fn of(cutter: &ShaperCutter) -> Self {
        let ShaperCutter { teeth, profile_shift, addendum_factor, tip_rounding_factor } = *cutter;
        Self { teeth, profile_shift, addendum_factor, tip_rounding_factor }
    }

    /// The cutter by factors of the transverse module, where β has the cosine `cos`.
    fn in_transverse_section(&self, cos: f64) -> Self {
        Self {
            teeth: self.teeth,
            profile_shift: self.profile_shift * cos,
            addendum_factor: self.addendum_factor * cos,
            tip_rounding_factor: self.tip_rounding_factor * cos,
        }
    }
}

impl ReliefIdentity {
    fn of(relief: Relief) -> Self {
        Self { amount_um: 1e3 * relief.amount_mm, length_mm: relief.length_mm, shape: relief.shape }
    }
}

impl WebIdentity {
    fn of(web: Web) -> Self {
        Self { thickness_mm: web.thickness_mm, rim_thickness_mm: web.rim_thickness_mm, offset_mm: web.offset_mm }
    }
}

fn json(part: &impl Serialize) -> Value {
    // Plain structures with text keys, which JSON always expresses.
    serde_json::to_value(part).unwrap_or_default()
}

fn compare(key: &str, calibration: &Value, scene: &Value, found: &mut Vec<String>) {
    match (calibration, scene) {
        (Value::Object(own), Value::Object(other)) => {
            // A key that one of them lacks counts as null.
            let names = own.keys().chain(other.keys().filter(|name| !own.contains_key(*name)));
            for name in names {
                let [own, other] = [own, other].map(|object| object.get(name).unwrap_or(&Value::Null));
                compare(&format!("{key}.{name}"), own, other, found);
            }
        }
        (Value::Number(own), Value::Number(other)) => {
            let (own, other) = (own.as_f64().unwrap_or(f64::NAN), other.as_f64().unwrap_or(f64::NAN));
            if !same(own, other) {
                found.push(format!("{key}: calibration {own}, scene {other}"));
            }
        }
        _ if calibration == scene => {}
        _ => found.push(format!("{key}: calibration {}, scene {}", words(calibration), words(scene))),
    }
}

/// A value in words.
fn words(value: &Value) -> String {
    match value {
        Value::Null => "none".to_owned(),
        Value::Object(parts) => {
            let parts: Vec<String> = parts.iter().map(|(name, value)| format!("{name} {}", words(value))).collect();
            parts.join(", ")
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
