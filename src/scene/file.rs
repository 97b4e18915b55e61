//! The scene file, key by key: what a user may write.
//!
//! These structures are the one description of the file. Their JSON schema (`gearwear schema`) carries the doc comments
//! below and the ranges beside them, and a file is checked against that same schema, so that an editor and
//! the program say the same. Every key that has a unit ends in it; the contract's key names are kept as they are.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fem_file::FemFile;
use super::gear_file::GearFile;
use super::improve_file::ImproveFile;
use super::lubrication_file::{FrictionFile, LoadFactorsFile, LubricantFile};
use super::presets;
use super::wear_file::{GearWearFile, TemperatureFile, WearFile};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::gear::flank::PointSpacing;
use gearwear_physics::contact::settings::{MatchCriterion, SurfaceKind};
use gearwear_physics::mesh_cycle::settings::Coupling;

/// A gear pair, its load and how its wear is to be computed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "gearwear scene")]
pub struct SceneFile {
    /// Title of the report. Default: the numbers of teeth.
    pub title: Option<String>,
    /// Author, company and date, shown on pages and in workbooks.
    pub report: Option<ReportFile>,
    /// The gear pair.
    pub pair: PairFile,
    /// Material of both gears, or of each. Default: steel.
    pub material: Option<MaterialFile>,
    /// Load, speed and duration.
    pub operation: OperationFile,
    /// Contact of the flanks. Default: finite elements; elastic half-planes where sections differ over the face width.
    pub contact: Option<ContactFile>,
    /// Stiffness of the teeth. Default: by finite elements.
    pub stiffness: Option<StiffnessFile>,
    /// Finite-element bodies of both gears. Default: whole rings.
    pub fem: Option<FemFile>,
    /// Contact temperatures, which need the speed. Default: computed only where the wear law reads them.
    pub temperature: Option<TemperatureFile>,
    /// The oil: gives films and losses, and needs the speed and the roughness of both gears. Default: no films.
    pub lubricant: Option<LubricantFile>,
    /// Friction of the mesh: gives losses, and needs the speed. Default: with [lubricant] the mean value of ISO/TS 6336-22, otherwise no
    /// losses.
    pub friction: Option<FrictionFile>,
    /// Load factors of ISO 6336-1 for films and figures of standards. Default: 1 each.
    pub load_factors: Option<LoadFactorsFile>,
    /// The wear law.
    pub wear: WearFile,
    /// Slices over the face width, used where sections differ: helix angle, modification over the width, twisting shaft, axes out of parallel.
    pub helical: Option<HelicalFile>,
    /// Resolution in space and time.
    pub numerics: Option<NumericsFile>,
    /// What gearwear improve may change, and what for.
    pub improve: Option<ImproveFile>,
}

/// Who reports, and when.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReportFile {
    /// Author of the calculation. Default: none.
    pub author: Option<String>,
    /// Company or customer. Default: none.
    pub company: Option<String>,
    /// Date, as text. Default: none.
    pub date: Option<String>,
}

/// The gear pair: a preset, or module, pressure angle, centre distance, face width and both gears.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairFile {
    /// Built-in pair; keys beside it override it. fzg-c, fzg-a: FZG types C (14 mm wide) and A (20 mm) of ISO 14635-1. thesis-spur, fzg-test,
    /// thesis-fzg-test: type C. helical, thesis-helical: type C with a helix of 15°, 20 mm wide. h501, h701, h951: helical pairs of FEUP.
    /// Default: none.
    #[schemars(extend("enum" = presets::names()))]
    pub preset: Option<String>,
    /// Normal module m_n in mm, > 0. Required without a preset, or transverse_module_mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub normal_module_mm: Option<f64>,
    /// Transverse module m_t in mm, > 0, instead of the normal one.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub transverse_module_mm: Option<f64>,
    /// Normal pressure angle α_n in degrees, 5 to 45. Required without a preset, or transverse_pressure_angle_deg.
    #[schemars(range(min = 5, max = 45))]
    pub pressure_angle_deg: Option<f64>,
    /// Transverse pressure angle α_t in degrees, 5 to 45, instead of the normal one.
    #[schemars(range(min = 5, max = 45))]
    pub transverse_pressure_angle_deg: Option<f64>,
    /// Helix angle β at the reference cylinder in degrees, −45 to 45. Positive: the slice at width 0 enters the mesh first.
    /// Default 0.
    #[schemars(range(min = -45, max = 45))]
    pub helix_angle_deg: Option<f64>,
    /// Working centre distance a in mm, > 0. Required without a preset, or backlash_um or normal_backlash_um.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub centre_distance_mm: Option<f64>,
    /// Circumferential backlash j_wt on the working circles in µm, 0 or more, instead of the centre distance.
    #[schemars(range(min = 0))]
    pub backlash_um: Option<f64>,
    /// Normal backlash j_bn in µm, 0 or more, instead of the centre distance.
    #[schemars(range(min = 0))]
    pub normal_backlash_um: Option<f64>,
    /// Common face width b in mm, > 0. Required without a preset.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub face_width_mm: Option<f64>,
    /// Basic rack of the teeth, in factors of the module that is given. Default: profile A of ISO 53.
    pub basic_rack: Option<BasicRackFile>,
    /// Deviations of the axes from parallel (ISO/TR 10064-3), positive where the working flanks come apart towards the full width. Default:
    /// parallel.
    pub axis_parallelism: Option<AxisParallelismFile>,
    /// The driving gear. Required without a preset.
    pub pinion: Option<GearFile>,
    /// The driven gear. Required without a preset.
    pub wheel: Option<GearFile>,
}

/// The basic rack (ISO 53), in factors of the module that is given.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BasicRackFile {
    /// Addendum factor h_aP*, > 0 to 3. Default 1.0.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 3))]
    pub addendum_factor: Option<f64>,
    /// Dedendum factor h_fP*, > 0 to 3. Default 1.25.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 3))]
    pub dedendum_factor: Option<f64>,
    /// Root fillet radius factor ρ_fP*, 0 to 1. Default 0.38, or less where the rack has no room for it.
    #[schemars(range(min = 0, max = 1))]
    pub fillet_radius_factor: Option<f64>,
}

/// Deviations from parallel of the axes (ISO/TR 10064-3), positive where the working flanks come apart towards the full width.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisParallelismFile {
    /// In-plane deviation f_Σδ in µm. Default 0.
    pub in_plane_um: Option<f64>,
    /// Out-of-plane deviation f_Σβ in µm. Default 0.
    pub out_of_plane_um: Option<f64>,
    /// Length over which the deviations are given in mm, > 0. Default: the face width.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub over_length_mm: Option<f64>,
}

/// Material of both gears, or `[material.pinion]` and `[material.wheel]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// Material of both gears by name, with its constants at room temperature (docs/materials.md). Default: steel.
    pub preset: Option<MaterialPreset>,
    /// Young's modulus E of both gears in GPa, > 0. Default 206.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_modulus_GPa: Option<f64>,
    /// Young's modulus over the temperature of the teeth, instead of young_modulus_GPa; needs [temperature.tooth].
    pub young_modulus_curve: Option<ModulusCurveFile>,
    /// Poisson's ratio ν of both gears, 0 to below 0.5. Default 0.3.
    #[schemars(range(min = 0), extend("exclusiveMaximum" = 0.5))]
    pub poisson_ratio: Option<f64>,
    /// Density of both gears in kg/m³, > 0; gives the worn mass. Default 7830.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_per_m3: Option<f64>,
    /// Thermal conductivity in W/(m·K), > 0, for contact temperatures. Default 46.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thermal_conductivity_W_per_mK: Option<f64>,
    /// Thermal diffusivity in m²/s, > 0, for contact temperatures. Default 1.2e-5.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thermal_diffusivity_m2_per_s: Option<f64>,
    /// Material of the pinion.
    pub pinion: Option<GearMaterialFile>,
    /// Material of the wheel.
    pub wheel: Option<GearMaterialFile>,
}

/// Young's modulus over temperature, as the data sheet of a plastic has it: straight between its points, and level beyond the first and the last. It is
/// taken at the mean of flank and root temperature of the gear in each phase; with slices or a calibration file in the phase of the greatest load for all.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModulusCurveFile {
    /// Temperatures in °C, −273 to 1000, rising. Required.
    #[schemars(length(min = 2), inner(range(min = -273, max = 1000)))]
    pub temperature_C: Option<Vec<f64>>,
    /// Young's modulus in GPa at each, 0.0001 to 1500. Required.
    #[schemars(length(min = 2), inner(range(min = 0.0001, max = 1500)))]
    pub young_modulus_GPa: Option<Vec<f64>>,
}

/// A material by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum MaterialPreset {
    /// Case-hardened steel: the default.
    #[serde(rename = "steel")]
    Steel,
    /// Nodular cast iron EN-GJS-500-7.
    #[serde(rename = "cast-iron")]
    CastIron,
    /// Polyoxymethylene, unfilled.
    #[serde(rename = "POM")]
    Pom,
    /// Polyamide 66, unfilled, conditioned.
    #[serde(rename = "PA66")]
    Pa66,
    /// Polyamide 46, unfilled, dry.
    #[serde(rename = "PA46")]
    Pa46,
    /// Polybutylene terephthalate, unfilled.
    #[serde(rename = "PBT")]
    Pbt,
    /// Polyether ether ketone, unfilled.
    #[serde(rename = "PEEK")]
    Peek,
}

/// Material of one gear.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GearMaterialFile {
    /// Material of the gear by name. Default: steel.
    pub preset: Option<MaterialPreset>,
    /// Young's modulus E in GPa, > 0. Default 206.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_modulus_GPa: Option<f64>,
    /// Young's modulus over the temperature of the teeth, instead of young_modulus_GPa; needs [temperature.tooth].
    pub young_modulus_curve: Option<ModulusCurveFile>,
    /// Poisson's ratio ν, 0 to below 0.5. Default 0.3.
    #[schemars(range(min = 0), extend("exclusiveMaximum" = 0.5))]
    pub poisson_ratio: Option<f64>,
    /// Density in kg/m³, > 0; gives the worn mass. Default 7830.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_per_m3: Option<f64>,
    /// Thermal conductivity in W/(m·K), > 0. Default 46.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thermal_conductivity_W_per_mK: Option<f64>,
    /// Thermal diffusivity in m²/s, > 0. Default 1.2e-5.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thermal_diffusivity_m2_per_s: Option<f64>,
}

/// Load, speed and duration; the pinion drives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperationFile {
    /// Torque on the pinion in N·m, > 0. Required, unless every phase gives its own.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_torque_Nm: Option<f64>,
    /// Speed of the pinion in revolutions per minute, > 0; needed with hours, snapshots_h and temperatures.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_speed_rpm: Option<f64>,
    /// Duration of the run in hours, > 0. Required, or pinion_revolutions.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hours: Option<f64>,
    /// Duration of the run in revolutions of the pinion, > 0. Required, or hours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_revolutions: Option<f64>,
    /// Times in hours at which the state is kept, increasing. Default: 1/64, 1/32, … 1/2 and the whole of the duration.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }))]
    pub snapshots_h: Option<Vec<f64>>,
    /// The same times in revolutions of the pinion.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }))]
    pub snapshots_revolutions: Option<Vec<f64>>,
    /// Meshes of each gear per revolution, as of a sun with planets. Default: one each.
    pub meshes_per_revolution: Option<MeshesFile>,
    /// Torques on the pinion in N·m, increasing, under which the transmission error of new and worn flanks is found. Default: none.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0 }))]
    pub torque_curve_Nm: Option<Vec<f64>>,
    /// Limits that end the run; the life until then is a result. Default: none.
    pub stop: Option<StopFile>,
    /// Load spectrum or running-in: phases one after the other, whose durations add up to that of the run. Default: one phase.
    pub phases: Option<Vec<PhaseFile>>,
}

/// Meshes per revolution of each gear. The torque is that of one mesh; wear, life and the heat of plastic teeth are those of all.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshesFile {
    /// Mates on the pinion's working flanks, 1 to 20. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub pinion: Option<u32>,
    /// Mates on the wheel's working flanks, 1 to 20. Default 1.
    #[schemars(range(min = 1, max = 20))]
    pub wheel: Option<u32>,
}

/// Limits that end the life of the pair: one at least.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopFile {
    /// Maximum wear depth of the active profile of either gear in µm, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub wear_um: Option<f64>,
    /// Minimum normal tooth thickness at the tip of either gear in mm, > 0, below that of the new gears.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tip_thickness_mm: Option<f64>,
}

/// A phase of the run under constant load and speed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PhaseFile {
    /// Duration of the phase in hours, > 0. Required, or pinion_revolutions.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hours: Option<f64>,
    /// Duration of the phase in revolutions of the pinion, > 0. Required, or hours.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_revolutions: Option<f64>,
    /// Torque on the pinion in N·m, > 0. Default: operation.pinion_torque_Nm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_torque_Nm: Option<f64>,
    /// Speed of the pinion in revolutions per minute, > 0. Default: operation.pinion_speed_rpm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pinion_speed_rpm: Option<f64>,
    /// Wear coefficient of both gears in m²/N, > 0; refused where `[wear.pinion]` and `[wear.wheel]` differ. Default: that of the wear law.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_m2_per_N: Option<f64>,
    /// The same in mm³/(N·m), > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub coefficient_mm3_per_Nm: Option<f64>,
    /// Wear of the pinion in this phase. Default: as for both.
    pub pinion: Option<GearPhaseFile>,
    /// Wear of the wheel in this phase. Default: as for both.
    pub wheel: Option<GearPhaseFile>,
}

/// What a phase says of one gear.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GearPhaseFile {
    /// Wear coefficient of this gear in m²/N, 0 or more; not 0 for both. Default: that of the phase, or of the wear law.
    #[schemars(range(min = 0))]
    pub coefficient_m2_per_N: Option<f64>,
    /// The same in mm³/(N·m), 0 or more.
    #[schemars(range(min = 0))]
    pub coefficient_mm3_per_Nm: Option<f64>,
}

/// Contact of the flanks.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactFile {
    /// Model of the surfaces in contact. Default: fem; half-space where sections differ over the face width, a tooth stiffness is given, tip_contact
    /// is false or finite elements cannot be made; winkler where a calibration or K/H is given or matched.
    pub surface: Option<SurfaceKind>,
    /// Quantity of Hertz's contact at the pitch point that winkler reproduces. With half-width its peak pressure is 1.178 times Hertz's.
    /// Default: half-width.
    #[serde(rename = "match")]
    pub match_criterion: Option<MatchCriterion>,
    /// Stiffness K/H of the Winkler foundation in MPa/mm, > 0, instead of match.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub foundation_MPa_per_mm: Option<f64>,
    /// File of gearwear calibrate for this pair, relative to the scene: K/H of winkler and tooth stiffness. Default: none.
    pub calibration: Option<String>,
    /// Contact of tip edges before A and after E on winkler and half-space; fem always has it. Default true; false is the thesis's model.
    pub tip_contact: Option<bool>,
}

/// Stiffness of the teeth.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StiffnessFile {
    /// Stiffness of a tooth pair, except with contact.surface = "fem". Default: fem, or weber-banaschek with a warning where finite elements
    /// cannot be made.
    pub model: Option<StiffnessModel>,
    /// Stiffness of a tooth pair per face width in N/(mm·µm), > 0, without contact flattening. Required with model = "constant".
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pair_N_per_mm_um: Option<f64>,
    /// Data file (CSV) relative to the scene: columns position_mm (radius of curvature of the pinion, from A to E) and stiffness_N_per_mm_um or
    /// deflection_um, under lines "# flattening = included" (or excluded) and, with flattening or deflections, "# line_load_N_per_mm = …";
    /// "# shared_um_mm_per_N = …": the part that all pairs in mesh share.
    /// Required with model = "simon" or "wang-cheng".
    pub curve: Option<String>,
}

impl StiffnessFile {
    /// Whether any key is given.
    pub(crate) fn says_anything(&self) -> bool {
        self.model.is_some() || self.pair_N_per_mm_um.is_some() || self.curve.is_some()
    }
}

/// Model of the stiffness of a tooth pair along the path of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StiffnessModel {
    /// The value of pair_N_per_mm_um everywhere.
    Constant,
    /// Weber and Banaschek's tooth and body terms on the generated profile, varying along the path of contact.
    #[default]
    WeberBanaschek,
    /// The single stiffness c' of ISO 6336-1, one value.
    Iso6336,
    /// From finite elements: the calibration's, or computed where none is given.
    Fem,
    /// The user's data of stiffness.curve, after Simon.
    Simon,
    /// The user's data of stiffness.curve, after Wang and Cheng.
    WangCheng,
}

/// Slices over the face width.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HelicalFile {
    /// Slices over the face width, 1 to 2000. Default 20.
    #[schemars(range(min = 1, max = 2000))]
    pub slices: Option<u32>,
    /// Coupling of neighbouring slices of a tooth. Default: fem (at most 100 slices, whole rings and stiffness model fem), otherwise slicing.
    pub coupling: Option<Coupling>,
}

/// Resolution in space and time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumericsFile {
    /// Intervals of a flank from base to tip circle, 20 to 100000. Default 750.
    #[schemars(range(min = 20, max = 100000))]
    pub flank_points: Option<u32>,
    /// Spacing of the flank points. Default: graded with contact.tip_contact, otherwise even.
    pub flank_point_spacing: Option<PointSpacing>,
    /// Loading positions, evenly from A to E, 20 to 1000000. Default 400, of half-planes in slices 150 to 200, half a half-width of contact apart.
    #[schemars(range(min = 20, max = 1000000))]
    pub positions: Option<u32>,
    /// Estimates of the numerical errors, which cost extra runs. Default true.
    pub error_estimate: Option<bool>,
    /// Verification by the same duration on finite elements: error.total of the summary. Default true; in a sweep false.
    pub verify: Option<bool>,
    /// Wear step: a table for Euler's method, or "adaptive", which is stable in any case. Default: "adaptive" on half-space and fem, with
    /// severe wear and with operation.stop, otherwise 1/150 of the duration.
    pub step: Option<StepFile>,
    /// Permitted error of the wear depth in adaptive steps in µm, > 0, at least 0.0001, as a mean over up to 0.02 mm of flank; beyond 50 µm of
    /// wear it grows in proportion. Default 0.05.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance_um: Option<f64>,
    /// Integration of the wear in adaptive steps. Default: runge-kutta-chebyshev.
    pub method: Option<AdaptiveMethod>,
}

/// Method of adaptive wear steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AdaptiveMethod {
    /// Stabilised explicit, of second order: Runge–Kutta–Chebyshev.
    #[default]
    RungeKuttaChebyshev,
}

/// Steps of the wear run: a table for Euler's method, or a word.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum StepFile {
    /// Of a fixed length.
    Fixed(FixedStepFile),
    /// As long as the error allows.
    Named(NamedStep),
}

/// A fixed length of the wear step, by Euler's method.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixedStepFile {
    /// Length of a wear step in revolutions of the pinion, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub revolutions: f64,
}

/// A wear step that is not given by its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NamedStep {
    /// As long as the error allows.
    Adaptive,
}

impl StepFile {
    /// A fixed length.
    pub fn fixed(revolutions: f64) -> Self {
        StepFile::Fixed(FixedStepFile { revolutions })
    }
}

impl PairFile {
    /// Table of a gear.
    pub fn gear(&self, gear: Gear) -> Option<&GearFile> {
        match gear {
            Gear::Pinion => self.pinion.as_ref(),
            Gear::Wheel => self.wheel.as_ref(),
        }
    }

    /// The same, to be changed.
    pub fn gear_mut(&mut self, gear: Gear) -> Option<&mut GearFile> {
        match gear {
            Gear::Pinion => self.pinion.as_mut(),
            Gear::Wheel => self.wheel.as_mut(),
        }
    }
}

impl SceneFile {
    /// The scene as TOML text.
    pub fn to_toml(&self) -> String {
        // Plain structs with text keys: nothing in them that TOML could not express.
        let text = toml::to_string(self).expect("a scene file is always expressible in TOML");
        // TOML's writer knows no exponents, and nobody reads a wear coefficient of sixteen zeros.
        let key = "coefficient_m2_per_N = ";
        let of_gear = |gear: &Option<GearWearFile>| gear.as_ref().and_then(|gear| gear.coefficient_m2_per_N);
        let coefficients = [self.wear.coefficient_m2_per_N, of_gear(&self.wear.pinion), of_gear(&self.wear.wheel)];
        // The tables of the wear law are the last that have any, the pinion's before the wheel's.
        let (mut before, mut after) = (text, String::new());
        for k in coefficients.into_iter().rev().flatten() {
            if let Some((earlier, later)) = before.rsplit_once(&format!("{key}{k}\n")) {
                after = format!("{key}{k:?}\n{later}{after}");
                before = earlier.to_owned();
            }
        }
        before + &after
    }
}
