//! A gear pair, its operation and how it is modelled, with every choice made: what a plan is decided from and an assessment carried out on.
//! Types of physics alone: which file says it, and how, is decided above.

mod phase_conditions;

use std::ops::RangeInclusive;

use crate::contact::hertz;
use crate::contact::settings::{ContactSettings, SurfaceKind};
use crate::lubrication::settings::LubricationSettings;
use crate::mesh_cycle::settings::SliceSettings;
use crate::simulation::settings::{Numerics, Operation};
use crate::stiffness::settings::StiffnessSettings;
use crate::thermal::settings::HeatSettings;
use crate::thermal::tooth::TemperatureCurve;
use crate::wear::settings::WearSettings;
use gearwear_bodies::gear::{GearPair, PerGear, spec::PairSpec};
use gearwear_bodies::gear_mesh::settings::BodySettings;
use gearwear_bodies::material::Material;
pub use phase_conditions::mean_friction;

/// Least half-width of contact at the pitch point that is meshed, in modules: the flank then has some thousand nodes.
pub(crate) const LEAST_HALF_WIDTH_MODULES: f64 = 0.015;
/// Least load, over the greatest of all phases, whose contact the wearing elements are meshed for: half as wide as that of the greatest. Phases
/// under less load have fewer elements in contact, and little wear.
const LEAST_MESHED_LOAD: f64 = 0.25;
/// Positions from A to E of the verification of other surfaces than finite elements.
pub(crate) const VERIFIED_POSITIONS: usize = 400;
/// Length of elements and distance of positions of the verification of a run on finite elements, over those of the run.
pub(crate) const COARSER: f64 = 1.5;
/// Tolerance of the wear depth in the steps of a verification, over the greatest depth.
pub(crate) const VERIFIED_TOLERANCE: f64 = 0.03;
/// Wear of a tip edge over the bulge of an element of its rounding, below which it is hardly worn and a verification refines the elements there.
pub(crate) const HARDLY_WORN_BULGES: f64 = 10.0;
/// Refinement of the elements of hardly worn roundings.
pub(crate) const ON_HARDLY_WORN_EDGES: f64 = 3.0;
/// Refinement of the elements of tip roundings of an internal pair that wears: with 1 they moved the wear of the wheel's tip edge by up to 6 %, now up and
/// now down.
const ON_ROUNDINGS_INSIDE: f64 = 1.5;

/// A scene with every choice made: what plan and assessment work from.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The gear pair as given.
    pub pair: PairSpec,
    /// Material of each gear, its modulus at the temperature of its teeth where it follows that.
    pub material: PerGear<Material>,
    /// Young's modulus of each as a curve of that temperature, MPa; none where it is constant.
    pub modulus: PerGear<Option<TemperatureCurve>>,
    /// Load, speed, duration.
    pub operation: Operation,
    /// Contact surface.
    pub contact: ContactSettings,
    /// Whether the scene leaves the contact surface open.
    pub surface_by_default: bool,
    /// Calibration file, as named by the scene.
    pub calibration_file: Option<String>,
    /// Tooth stiffness.
    pub stiffness: StiffnessSettings,
    /// Whether the scene leaves the model of the stiffness open.
    pub stiffness_by_default: bool,
    /// Data file of the stiffness, as named by the scene.
    pub stiffness_curve_file: Option<String>,
    /// Bodies of finite elements, where any are used.
    pub fem: BodySettings,
    /// Elements in the half-width of contact of a wear run on them.
    pub wear_elements_per_half_width: f64,
    /// Slices over the face width; none where all sections are alike.
    pub slices: Option<SliceSettings>,
    /// Whether the scene leaves their coupling open.
    pub coupling_by_default: bool,
    /// Contact temperatures; none where nothing asks for them.
    pub heat: Option<HeatSettings>,
    /// Films, friction and losses; none where nothing asks for them.
    pub lubrication: Option<LubricationSettings>,
    /// Wear law of each gear.
    pub wear: PerGear<WearSettings>,
    /// Resolution.
    pub numerics: Numerics,
    /// Whether the run is checked by finite elements.
    pub verify: bool,
}

impl Scene {
    /// Bodies of finite elements that wear.
    pub fn wear_bodies(&self) -> BodySettings {
        let rounding_refinement =
            if self.pair.is_internal() { ON_ROUNDINGS_INSIDE } else { self.fem.rounding_refinement };
        BodySettings { elements_per_half_width: self.wear_elements_per_half_width, rounding_refinement, ..self.fem }
    }

    /// The scene on elastic half-planes, for a pair of which finite elements, the default surface, cannot be made.
    pub fn on_half_planes(&self) -> Self {
        let contact = ContactSettings { surface: SurfaceKind::HalfSpace, ..self.contact };
        Self { contact, ..self.clone() }
    }

    /// Checks that contact at the pitch point is wide enough under the greatest load for finite elements of a reasonable size.
    ///
    /// # Errors
    /// What is too narrow.
    pub fn check_contact_can_be_meshed(&self, pair: &GearPair) -> Result<(), String> {
        let [_, greatest_n_mm] = self.operation.torque_range_n_mm();
        let half_width_mm = self.half_width_at_pitch_mm(pair, greatest_n_mm);
        let least_mm = LEAST_HALF_WIDTH_MODULES * self.pair.normal_module_mm;
        if half_width_mm >= least_mm {
            return Ok(());
        }
        Err(format!(
            "the contact is too narrow to be meshed: its half-width at the pitch point is {half_width_mm:.2e} mm, at least {least_mm:.2e} mm is \
             wanted, for narrower contact takes too many elements"
        ))
    }

    /// Torque on the pinion that finite elements which wear are meshed for, N mm.
    pub(crate) fn meshed_torque_n_mm(&self) -> f64 {
        let [least_n_mm, greatest_n_mm] = self.operation.torque_range_n_mm();
        least_n_mm.max(LEAST_MESHED_LOAD * greatest_n_mm)
    }

    /// Half-width of Hertz's contact at C under a torque on the pinion, mm.
    fn half_width_at_pitch_mm(&self, pair: &GearPair, torque_n_mm: f64) -> f64 {
        let at_pitch = hertz::flattening(&pair.normal_section(), &self.material, pair.path.pitch_point_mm);
        at_pitch.contact.loaded(pair.line_load_n_per_mm(torque_n_mm)).half_width_mm
    }

    /// Number of positions from A to E that are `half_widths` half-widths of Hertz's contact at C apart, under the least load of all phases, within
    /// `bounds`: a contact must not move much farther than it is wide.
    pub fn positions_apart(&self, pair: &GearPair, half_widths: f64, bounds: RangeInclusive<usize>) -> usize {
        let [least_n_mm, _] = self.operation.torque_range_n_mm();
        let apart_mm = half_widths * self.half_width_at_pitch_mm(pair, least_n_mm);
        let intervals = (pair.path.end_mm - pair.path.start_mm) / apart_mm;
        // A half-width of 0 or none asks for as many as there may be.
        let most = *bounds.end();
        if intervals < most as f64 { (intervals.ceil() as usize + 1).clamp(*bounds.start(), most) } else { most }
    }

    /// Warning of a command under one load alone that a scene has phases under others.
    pub fn one_load_warning(&self) -> Option<String> {
        let own = self.operation.pinion_torque_n_mm;
        let [least, greatest] = self.operation.torque_range_n_mm();
        let (least, greatest) = (least.min(own), greatest.max(own));
        (least < greatest).then(|| {
            let n_m = 1e-3;
            format!(
                "this command looks at operation.pinion_torque_Nm, {} N·m, alone; the phases run under {} to {} N·m",
                n_m * own,
                n_m * least,
                n_m * greatest
            )
        })
    }

    /// Warning of plane finite elements that the sections of a pair differ over the face width.
    pub fn plane_section_warning(&self) -> Option<String> {
        self.slices.is_some().then(|| {
            "finite elements are plane: they stand for one transverse section per mm of face width, without the helix and \
             without modifications over the face width"
                .to_owned()
        })
    }
}
