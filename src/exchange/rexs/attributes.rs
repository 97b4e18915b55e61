//! Attributes of the format for figures of a run: id, unit and component by the format's database (database.rexs.info), versions 1.4
//! to 2.0. An attribute that belongs to a standard or guideline stands for a figure only where the run computes it by that one.
//!
//! What the database has no attribute for stands under an id that begins with `custom_`, then the name of the program, as the specification
//! has it (spec.rexs.info, versions 1.4 and 1.6, section "Extensibility of the interface").

use std::borrow::Cow;

use super::document::RexsDocument;
use super::same_loads::Loads;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::figures::{self, FigureValues, MainFigure, RexsAttribute, RexsId, STATED_ERRORS};

/// The beginning of ids that are not in the database.
pub(super) const CUSTOM: &str = "custom_gearwear_";
/// The beginning of ids of figures under the greatest load, where the file has other loads too.
const CUSTOM_GREATEST_LOAD: &str = "custom_gearwear_greatest_load_";

/// The component that an attribute belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum On {
    /// `cylindrical_stage`.
    Stage,
    /// `cylindrical_gear`, of each gear.
    Gear,
    /// `cylindrical_stage_gear_data`, of each gear: what is of a gear in this stage.
    GearInStage,
}

/// Reach of a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// The pair, whatever its load.
    Pair,
    /// The load of the reference phase, the greatest.
    Load,
    /// The load of the reference phase, and proportional to the torque, so that the figure is known of every load.
    Torque,
    /// Each phase.
    Phase,
    /// The whole run.
    Life,
}

/// An attribute for a figure.
#[derive(Debug, Clone, Copy)]
pub(super) struct AttributeKind {
    pub of: Of,
    pub on: On,
    /// Unit as the database writes it.
    unit: &'static str,
    /// In the database, in some versions.
    standard: &'static [RexsId],
    /// Behind [`CUSTOM`] in a version without a standard attribute; None where the figure then has none.
    custom: Option<&'static str>,
}

/// A figure of the summary and its attribute.
#[derive(Debug, Clone)]
pub(super) struct FigureAttribute {
    /// In `summary.json`; `{gear}` is each gear, `{phase}` the number of the phase.
    pub path: Cow<'static, str>,
    pub attribute: AttributeKind,
}

impl FigureAttribute {
    /// A value of the summary in the unit of the attribute.
    pub(super) fn in_unit(&self, value: f64) -> f64 {
        if self.path.ends_with("_um") && self.attribute.unit == "mm" { 1e-3 * value } else { value }
    }
}

/// How the attributes of a file are named.
#[derive(Debug, Clone, Copy)]
pub(super) struct Naming<'a> {
    version: &'a str,
    loads: Loads,
}

impl<'a> Naming<'a> {
    pub(super) fn of(document: &'a RexsDocument, loads: Loads) -> Self {
        Self { version: &document.version, loads }
    }

    /// Whether ids have to say that a figure is of the greatest load.
    fn says_greatest_load(&self, of: Of) -> bool {
        match of {
            Of::Load => self.loads != Loads::One,
            Of::Torque => self.loads == Loads::Different,
            Of::Pair | Of::Phase | Of::Life => false,
        }
    }

    /// The id of an attribute; None where this version has none for it.
    pub(super) fn id(&self, attribute: &AttributeKind) -> Option<String> {
        let mut known = attribute.standard.iter();
        let standard = known.find(|standard| (standard.versions[0]..=standard.versions[1]).contains(&self.version));
        let standard = standard.map(|standard| standard.id);
        match (standard, self.says_greatest_load(attribute.of)) {
            (Some(id), false) => Some(id.to_owned()),
            (None, false) => attribute.custom.map(|name| format!("{CUSTOM}{name}")),
            (_, true) => standard.or(attribute.custom).map(|name| format!("{CUSTOM_GREATEST_LOAD}{name}")),
        }
    }

    /// The unit of an attribute. Stresses are in N / mm^2 up to version 1.7 and in MPa from 2.0 on.
    pub(super) fn unit(&self, attribute: &AttributeKind) -> &'static str {
        if attribute.unit == "MPa" && self.version < "2.0" { "N / mm^2" } else { attribute.unit }
    }
}

const fn until_1_7(id: &'static str) -> RexsId {
    RexsId { id, versions: [RexsId::FIRST, "1.7"] }
}

const fn since_1_5(id: &'static str) -> RexsId {
    RexsId { id, versions: ["1.5", RexsId::LAST] }
}

const fn since_1_7(id: &'static str) -> RexsId {
    RexsId { id, versions: ["1.7", RexsId::LAST] }
}

const fn since_2_0(id: &'static str) -> RexsId {
    RexsId { id, versions: ["2.0", RexsId::LAST] }
}

/// An attribute that is in no version.
const fn only_custom(of: Of, on: On, unit: &'static str, name: &'static str) -> AttributeKind {
    AttributeKind { of, on, unit, standard: &[], custom: Some(name) }
}

/// A figure that no version has an attribute for.
const fn custom(of: Of, on: On, path: &'static str, unit: &'static str, name: &'static str) -> FigureAttribute {
    FigureAttribute { path: Cow::Borrowed(path), attribute: only_custom(of, on, unit, name) }
}

/// A figure that some versions have an attribute for, and others may have none.
const fn standard(
    of: Of,
    on: On,
    path: &'static str,
    unit: &'static str,
    standard: &'static [RexsId],
    custom: Option<&'static str>,
) -> FigureAttribute {
    FigureAttribute { path: Cow::Borrowed(path), attribute: AttributeKind { of, on, unit, standard, custom } }
}

/// Mesh stiffness at each position of one pitch, of all pairs in contact over the whole face width.
pub(super) const MESH_STIFFNESS: AttributeKind = AttributeKind {
    of: Of::Load,
    on: On::Stage,
    unit: "N / mm",
    standard: &[since_1_5("meshing_stiffness_characteristic")],
    custom: None,
};
/// Rotation of a gear at each of these positions.
pub(super) const MESH_POSITIONS: AttributeKind = AttributeKind {
    of: Of::Load,
    on: On::GearInStage,
    unit: "deg",
    standard: &[since_1_5("rotational_meshing_position")],
    custom: None,
};
/// Mean over the pitch per mm of face width, new and worn: c_γ as the mean of the slope dF/dδ, not that of ISO 6336-1 Method B.
pub(super) const MEAN_MESH_STIFFNESS: [AttributeKind; 2] = [
    only_custom(Of::Load, On::Stage, "N / (mm mum)", "mean_mesh_stiffness_new"),
    only_custom(Of::Load, On::Stage, "N / (mm mum)", "mean_mesh_stiffness_worn"),
];
/// Wear depth from root to tip, the maximum over the face width.
pub(super) const WEAR_DEPTH: AttributeKind = only_custom(Of::Life, On::GearInStage, "mum", "wear_depth");
/// The diameters at which it stands.
pub(super) const WEAR_DEPTH_DIAMETERS: AttributeKind =
    only_custom(Of::Life, On::GearInStage, "mm", "wear_depth_diameters");
/// Version of the program.
pub(super) const PROGRAM_VERSION: AttributeKind = only_custom(Of::Life, On::Stage, "none", "version");
/// Hash of the run's scene.
pub(super) const SCENE_HASH: AttributeKind = only_custom(Of::Life, On::Stage, "none", "scene_hash");

/// Under what the run was, which is written first.
static OF_OPERATION: [FigureAttribute; 4] = [
    custom(Of::Life, On::Stage, "hours", "h", "running_time"),
    custom(Of::Life, On::Stage, "revolutions", "none", "pinion_revolutions"),
    custom(Of::Load, On::Stage, "phases.{phase}.pinion_torque_Nm", "N m", "pinion_torque"),
    custom(Of::Load, On::Stage, "phases.{phase}.pinion_speed_rpm", "1 / min", "pinion_speed"),
];

/// Attributes beside those of main figures: phases, films, root stress and temperatures, and such as differ from version to version.
static OTHERS: &[FigureAttribute] = &[
    standard(
        Of::Load,
        On::Stage,
        "helical.K_Hbeta_new",
        "none",
        &[until_1_7("face_load_factor_flank"), since_2_0("face_load_factor_contact_stress")],
        None,
    ),
    custom(Of::Load, On::Stage, "helical.K_Hbeta_worn", "none", "face_load_factor_worn"),
    standard(
        Of::Pair,
        On::Stage,
        "lubrication.losses.loss_factor_ohlendorf",
        "none",
        &[until_1_7("degree_of_tooth_loss_vdi_2736_2014"), since_2_0("tooth_loss_factor_vdi_2736_2014")],
        None,
    ),
    custom(Of::Load, On::Stage, "lubrication.losses.mesh_power_loss_new_W", "W", "mesh_power_loss_new"),
    custom(Of::Load, On::Stage, "lubrication.losses.mesh_power_loss_worn_W", "W", "mesh_power_loss_worn"),
    custom(Of::Load, On::Stage, "lubrication.losses.efficiency_new", "none", "mesh_efficiency_new"),
    custom(Of::Load, On::Stage, "lubrication.losses.efficiency_worn", "none", "mesh_efficiency_worn"),
    custom(Of::Load, On::Stage, "lubrication.friction.mean_new", "none", "mean_coefficient_of_friction_new"),
    custom(Of::Load, On::Stage, "lubrication.friction.mean_worn", "none", "mean_coefficient_of_friction_worn"),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.minimum_film_new_um.min",
        "mum",
        "minimum_lubricant_film_thickness_new",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.minimum_film_worn_um.min",
        "mum",
        "minimum_lubricant_film_thickness_worn",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.lambda_new.min",
        "none",
        "minimum_specific_lubricant_film_thickness_new",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.lambda_worn.min",
        "none",
        "minimum_specific_lubricant_film_thickness_worn",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.micropitting_safety_new",
        "none",
        "safety_factor_micropitting_method_a_new",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.film.micropitting_safety_worn",
        "none",
        "safety_factor_micropitting_method_a_worn",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.method_b.micropitting_safety",
        "none",
        "safety_factor_micropitting_method_b",
    ),
    custom(Of::Load, On::Stage, "lubrication.film.greatest_flash_new_K", "K", "maximum_flash_temperature_new"),
    custom(Of::Load, On::Stage, "lubrication.film.greatest_flash_worn_K", "K", "maximum_flash_temperature_worn"),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.scuffing.contact_temperature_C",
        "C",
        "maximum_contact_temperature_iso_ts_6336_20",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.scuffing.integral_temperature_C",
        "C",
        "integral_temperature_iso_ts_6336_21",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.scuffing.scuffing_safety",
        "none",
        "safety_factor_scuffing_iso_ts_6336_20",
    ),
    custom(
        Of::Load,
        On::Stage,
        "lubrication.scuffing.integral_scuffing_safety",
        "none",
        "safety_factor_scuffing_iso_ts_6336_21",
    ),
    custom(Of::Load, On::Stage, "temperature.greatest_rise_new_K", "K", "maximum_contact_temperature_rise_new"),
    custom(Of::Load, On::Stage, "temperature.greatest_rise_worn_K", "K", "maximum_contact_temperature_rise_worn"),
    custom(Of::Phase, On::Stage, "phases.{phase}.line_load_N_per_mm", "N / mm", "line_load"),
    custom(Of::Phase, On::Stage, "phases.{phase}.hertz_peak_pressure_MPa", "MPa", "hertzian_pressure_at_pitch_point"),
    custom(Of::Phase, On::Stage, "phases.{phase}.greatest_rise_K", "K", "maximum_contact_temperature_rise"),
    standard(
        Of::Load,
        On::Gear,
        "lubrication.oil.bulk_temperature_C",
        "C",
        &[RexsId::always("bulk_temperature")],
        None,
    ),
    custom(Of::Phase, On::GearInStage, "phases.{phase}.{gear}.greatest_depth_um", "mum", "maximum_wear_depth"),
    custom(Of::Phase, On::GearInStage, "phases.{phase}.{gear}.tip_edge_depth_um", "mum", "maximum_wear_depth_tip_edge"),
    custom(
        Of::Phase,
        On::GearInStage,
        "phases.{phase}.{gear}.below_sap_depth_um",
        "mum",
        "maximum_wear_depth_below_start_of_active_profile",
    ),
    standard(
        Of::Torque,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.nominal_stress_MPa",
        "MPa",
        &[since_1_7("nominal_tooth_root_stress_iso_6336_2006")],
        Some("nominal_tooth_root_stress_iso_6336_2006"),
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.form_factor",
        "none",
        &[since_1_7("form_factor_tooth_root_iso_6336_2006")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.stress_correction_factor",
        "none",
        &[since_1_7("stress_correction_factor_tooth_root_iso_6336_2006")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.moment_arm_mm",
        "mm",
        &[since_1_7("bending_moment_arm_tooth_root_stress_iso_6336_2006")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.thickness_mm",
        "mm",
        &[since_1_7("tooth_root_chord_critical_section_iso_6336_2006")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.fillet_radius_mm",
        "mm",
        &[since_1_7("tooth_root_radius_critical_section_iso_6336_2006")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.iso_6336_3.load_angle_deg",
        "deg",
        &[since_1_7("load_direction_angle_bending_moment_iso_6336_2006")],
        None,
    ),
    // σ_F of the guideline has K_F in it, which this one has not.
    custom(
        Of::Torque,
        On::GearInStage,
        "root_stress.{gear}.vdi_2736.nominal_stress_MPa",
        "MPa",
        "nominal_tooth_root_stress_vdi_2736_2014",
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.vdi_2736.form_factor",
        "none",
        &[until_1_7("form_factor_vdi_2736_2014"), since_2_0("form_factor_tooth_root_vdi_2736_2014")],
        None,
    ),
    standard(
        Of::Pair,
        On::GearInStage,
        "root_stress.{gear}.vdi_2736.stress_correction_factor",
        "none",
        &[
            until_1_7("stress_correction_factor_notch_effect_vdi_2736_2014"),
            since_2_0("stress_correction_factor_tooth_root_vdi_2736_2014"),
        ],
        None,
    ),
    standard(
        Of::Load,
        On::GearInStage,
        "temperature.tooth.{gear}.flank_C",
        "C",
        &[
            until_1_7("flank_temperature_characteristic_vdi_2736_2014"),
            since_2_0("tooth_flank_temperature_characteristic_vdi_2736_2014"),
        ],
        None,
    ),
    standard(
        Of::Load,
        On::GearInStage,
        "temperature.tooth.{gear}.root_C",
        "C",
        &[RexsId::always("root_temperature_vdi_2736_2014")],
        None,
    ),
];

/// All figures that are one number, in the order in which they are written.
pub(super) fn figures() -> impl Iterator<Item = FigureAttribute> {
    let main = figures::all().iter().flat_map(of_main_figure);
    OF_OPERATION.iter().cloned().chain(main).chain(OTHERS.iter().cloned())
}

/// The attributes that the catalogue of main figures names: of a figure, and of the errors that are stated of it. Both gears' are one.
fn of_main_figure(figure: &'static MainFigure) -> Vec<FigureAttribute> {
    let family = figure.family;
    let (of, on, path) = match family.values {
        FigureValues::Gears(_) => (Of::Life, On::GearInStage, family.path),
        FigureValues::Pair(_) | FigureValues::States(_) => (Of::Load, On::Stage, figure.name.as_str()),
    };
    if figure.gear() == Some(Gear::Wheel) {
        return Vec::new();
    }
    let own = match family.rexs {
        Some(RexsAttribute::Own(_)) => Some(custom(of, on, path, unit(family.unit), &figure.own_attribute)),
        Some(RexsAttribute::Database { ids, unit }) => Some(standard(of, on, path, unit, ids, None)),
        None => None,
    };
    let has_own = own.is_some();
    let errors = STATED_ERRORS.iter().filter(|error| figure.error_paths().any(|path| path == error.name));
    let errors = errors.filter(|error| has_own && !error.rexs.is_empty());
    let of_errors = errors.map(|error| FigureAttribute {
        path: Cow::Owned(error.name.replace("pinion", "{gear}")),
        attribute: only_custom(of, on, "none", error.rexs),
    });
    own.into_iter().chain(of_errors).collect()
}

/// A unit as the database writes it.
fn unit(unit: &'static str) -> &'static str {
    match unit {
        "" => "none",
        "µm" => "mum",
        "N/mm" => "N / mm",
        other => other,
    }
}
