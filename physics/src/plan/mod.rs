//! The stages a scene needs and those it does not, decided here alone and from the scene alone.

pub mod calibration;
pub mod cost;
pub mod fem_pair;
mod work;

use serde::{Serialize, Serializer};

use crate::contact::settings::{Foundation, SurfaceKind};
use crate::mesh_cycle::settings::{Coupling, MOST_SLICES_IN_SPACE, SliceSettings};
use crate::operation::Scene;
use crate::simulation::settings::{Operation, Phase, Stepping};
use crate::stiffness::settings::StiffnessSettings;
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_mesh::settings::{Body, SpaceResolution};

/// Phases that are listed one by one.
const PHASES_LISTED: usize = 8;
/// Matrices that couple 100 slices with each other at 400 positions, GB.
const COUPLED_GB: f64 = 0.5;

/// A stage of the work, in the order of the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum StageKind {
    /// Everything that follows from the data of the pair.
    Geometry,
    /// Both gears meshed, and condensed onto their flanks.
    FiniteElementModel,
    /// K/H and tooth stiffness from finite elements.
    FiniteElementCalibration,
    /// K/H from Hertz.
    ContactMatch,
    /// The stiffness of the teeth along the path of contact.
    ToothStiffness,
    /// One sector of each gear in three-dimensional finite elements, condensed onto its flank.
    TeethInSpace,
    /// Slices over the face width.
    HelicalSlices,
    /// Longest stable wear step of Euler's method.
    StepBound,
    /// The wear run.
    Simulation,
    /// Temperatures of the contact, new and worn.
    ContactTemperature,
    /// Films of oil along the path of contact, new and worn.
    Film,
    /// Friction and losses of the mesh, new and worn.
    Losses,
    /// Transmission error over torque, new and worn.
    TorqueCurve,
    /// Coarser companion runs.
    ErrorEstimates,
    /// Wear simulation on finite elements, as a verification.
    Verification,
    /// The output folder.
    Report,
}

impl StageKind {
    /// All stages, in the order of the work.
    pub const ALL: [StageKind; 16] = [
        StageKind::Geometry,
        StageKind::FiniteElementModel,
        StageKind::FiniteElementCalibration,
        StageKind::ContactMatch,
        StageKind::ToothStiffness,
        StageKind::TeethInSpace,
        StageKind::HelicalSlices,
        StageKind::StepBound,
        StageKind::Simulation,
        StageKind::ContactTemperature,
        StageKind::Film,
        StageKind::Losses,
        StageKind::TorqueCurve,
        StageKind::ErrorEstimates,
        StageKind::Verification,
        StageKind::Report,
    ];

    /// Name in `summary.json` and on the terminal.
    pub fn name(self) -> &'static str {
        match self {
            StageKind::Geometry => "geometry",
            StageKind::FiniteElementCalibration => "finite-element-calibration",
            StageKind::FiniteElementModel => "finite-element-model",
            StageKind::ContactMatch => "contact-match",
            StageKind::ToothStiffness => "tooth-stiffness",
            StageKind::TeethInSpace => "teeth-in-space",
            StageKind::HelicalSlices => "helical-slices",
            StageKind::StepBound => "step-bound",
            StageKind::ContactTemperature => "contact-temperature",
            StageKind::Film => "film",
            StageKind::Losses => "losses",
            StageKind::TorqueCurve => "torque-curve",
            StageKind::Simulation => "simulation",
            StageKind::ErrorEstimates => "error-estimates",
            StageKind::Verification => "verification",
            StageKind::Report => "report",
        }
    }
}

impl Serialize for StageKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// A stage with the reason why it is in the plan, or why it is not.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlannedStage {
    /// Kind of stage.
    #[serde(rename = "name")]
    pub kind: StageKind,
    /// Why.
    pub reason: String,
}

/// Stages of a run, and those left out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Plan {
    /// The stages the scene needs, in order.
    pub stages: Vec<PlannedStage>,
    /// The stages it does not need.
    pub left_out: Vec<PlannedStage>,
}

impl Plan {
    /// The plan of a scene.
    pub fn of(scene: &Scene) -> Self {
        let (mut stages, mut left_out) = (Vec::new(), Vec::new());
        for kind in StageKind::ALL {
            match decide(kind, scene) {
                Ok(reason) => stages.push(PlannedStage { kind, reason }),
                Err(reason) => left_out.push(PlannedStage { kind, reason }),
            }
        }
        Self { stages, left_out }
    }

    /// Why it does not have this stage; `None` where it has.
    pub fn left_out_because(&self, kind: StageKind) -> Option<&str> {
        self.left_out.iter().find(|stage| stage.kind == kind).map(|stage| stage.reason.as_str())
    }

    /// Whether the plan has this stage.
    pub fn has(&self, kind: StageKind) -> bool {
        self.stages.iter().any(|stage| stage.kind == kind)
    }
}

/// Whether the difference from the verification stands for the error of the elements, so that the estimates need no run of their own.
fn is_estimated_by_verification(scene: &Scene) -> bool {
    let is_adaptive = matches!(scene.numerics.stepping, Stepping::Adaptive { .. });
    scene.verify && is_adaptive && scene.contact.surface == SurfaceKind::Fem && !scene.wear.may_be_severe()
}

/// Why `kind` is needed (`Ok`) or left out (`Err`).
fn decide(kind: StageKind, scene: &Scene) -> Result<String, String> {
    match kind {
        StageKind::Geometry => Ok("everything that follows from the data of the pair".to_owned()),
        StageKind::FiniteElementCalibration => calibration(scene),
        StageKind::FiniteElementModel => finite_element_model(scene),
        StageKind::ContactMatch => contact_match(scene),
        StageKind::ToothStiffness => tooth_stiffness(scene),
        StageKind::TeethInSpace => teeth_in_space(scene),
        StageKind::HelicalSlices => helical_slices(scene),
        StageKind::StepBound => step_bound(scene),
        StageKind::ContactTemperature => contact_temperature(scene),
        StageKind::Film => film(scene),
        StageKind::Losses => losses(scene),
        StageKind::TorqueCurve => torque_curve(scene),
        StageKind::Simulation => Ok(simulation(scene)),
        StageKind::ErrorEstimates if scene.numerics.error_estimate && is_estimated_by_verification(scene) => {
            Ok("numerics.error_estimate: of the wear step; the verification tells that of the elements".to_owned())
        }
        StageKind::ErrorEstimates if scene.numerics.error_estimate => {
            Ok("numerics.error_estimate: Richardson extrapolation from coarser runs; at most half of the run's work"
                .to_owned())
        }
        StageKind::ErrorEstimates => Err("numerics.error_estimate is false".to_owned()),
        StageKind::Verification => verification(scene),
        StageKind::Report => Ok("the output folder: data, summary, page".to_owned()),
    }
}

fn calibration(scene: &Scene) -> Result<String, String> {
    match (&scene.calibration_file, scene.contact.surface, scene.stiffness) {
        (_, SurfaceKind::Fem, _) => Err("contact.surface = \"fem\" is the finite-element model itself".to_owned()),
        (Some(file), ..) => Err(format!("{file} is given")),
        (None, _, StiffnessSettings::Fem) => {
            Ok("the tooth stiffness of finite elements, as no calibration is given".to_owned())
        }
        (None, ..) => {
            Err("contact and tooth stiffness are given or in closed form, no calibration file is asked for".to_owned())
        }
    }
}

/// Verification by finite elements, where they can be made.
fn verification(scene: &Scene) -> Result<String, String> {
    if !scene.verify {
        return Err("numerics.verify is false: the error against finite elements is unknown".to_owned());
    }
    if let Some(slices) = scene.slices {
        return verification_in_space(scene, slices);
    }
    if scene.contact.surface == SurfaceKind::Fem {
        return Ok("numerics.verify: the same wear simulation on coarser finite elements".to_owned());
    }
    // A pair that cannot be is refused before any stage.
    GearPair::new(&scene.pair).map_or(Ok(()), |pair| scene.check_contact_can_be_meshed(&pair))?;
    Ok("numerics.verify: the same wear simulation with finite elements, which gives error.total".to_owned())
}

/// Verification where sections differ over the face width.
fn verification_in_space(scene: &Scene, slices: SliceSettings) -> Result<String, String> {
    if scene.fem.body != Body::Ring {
        return Err("fem.body is \"sector\": three-dimensional teeth need whole rings".to_owned());
    }
    if slices.count > MOST_SLICES_IN_SPACE {
        return Err(format!(
            "{} slices: at most {MOST_SLICES_IN_SPACE} are coupled by three-dimensional finite elements",
            slices.count
        ));
    }
    let other = if is_finest_in_space(scene) { ", on other slices" } else { "" };
    Ok(format!(
        "numerics.verify: the same wear simulation with elastic half-planes coupled by three-dimensional finite elements{other}, which gives error.total"
    ))
}

/// Whether a run with slices is itself of the kind that others are verified by.
pub fn is_finest_in_space(scene: &Scene) -> bool {
    let coupling = scene.slices.map(|slices| slices.coupling);
    scene.contact.surface == SurfaceKind::HalfSpace && scene.contact.tip_contact && coupling == Some(Coupling::Fem)
}

fn finite_element_model(scene: &Scene) -> Result<String, String> {
    let stiffness = calibration(scene).is_ok();
    // With slices, all that is read of it is a curve that a calibration has too.
    let verified = verification(scene).is_ok() && (scene.slices.is_none() || scene.calibration_file.is_none());
    let of = match (scene.contact.surface, stiffness, verified) {
        (SurfaceKind::Fem, ..) => "the surface fem",
        (_, true, true) => "the stiffness of the teeth and the verification",
        (_, true, false) => "the stiffness of the teeth",
        (_, false, true) => "the verification",
        (surface, false, false) => {
            return Err(format!("the surface {} has none, and nothing else asks for it", surface.name()));
        }
    };
    Ok(format!("{of}: both gears meshed, and condensed onto their flanks"))
}

fn contact_temperature(scene: &Scene) -> Result<String, String> {
    let names = scene.wear.as_ref().map(|own| own.law.name());
    let law = match names.pinion == names.wheel {
        true => names.pinion.to_owned(),
        false => format!("{} of the pinion or {} of the wheel", names.pinion, names.wheel),
    };
    let reads_temperature = [&scene.wear.pinion, &scene.wear.wheel].iter().any(|own| own.law.reads_temperature());
    match (scene.heat, reads_temperature) {
        (None, _) => Err(format!("the wear law {law} asks for no temperature, and neither does the scene")),
        (Some(heat), reads) => {
            let why = match reads {
                false => "[temperature] asks for it".to_owned(),
                true => {
                    format!("the wear law {law} takes it with the sliding speed at every point during the simulation")
                }
            };
            let follows = |gear: Gear| scene.modulus[gear].is_some() || scene.wear[gear].warm.is_some();
            let tooth = match heat.tooth.is_some() {
                true if Gear::BOTH.into_iter().any(follows) => {
                    "; of the teeth by VDI 2736-2, which modulus or wear follow"
                }
                true => "; of the teeth by VDI 2736-2",
                false => "",
            };
            Ok(format!("{why}; by all methods, new and worn{tooth}"))
        }
    }
}

fn film(scene: &Scene) -> Result<String, String> {
    match scene.lubrication.as_ref().map(|lubrication| lubrication.lubricant) {
        None => Err("there is no [lubricant]".to_owned()),
        Some(None) => Err("there is no [lubricant], only a constant friction".to_owned()),
        Some(Some(_)) => {
            let read = match Gear::BOTH.into_iter().any(|gear| scene.wear[gear].film.is_some()) {
                true => "; wear takes it at every contact during the simulation",
                false => "",
            };
            Ok(format!(
                "[lubricant]: thickness, λ and flash temperature along the path of contact, new and worn, and by ISO/TS 6336-22 \
                 Method B; scuffing temperatures{read}"
            ))
        }
    }
}

fn losses(scene: &Scene) -> Result<String, String> {
    match &scene.lubrication {
        None => Err("there is neither [friction] nor [lubricant]".to_owned()),
        Some(lubrication) => Ok(format!(
            "friction {} along the path of contact, loss factors, mesh power loss, new and worn",
            lubrication.friction.model.name()
        )),
    }
}

fn torque_curve(scene: &Scene) -> Result<String, String> {
    match scene.operation.torque_curve_n_mm.len() {
        0 => Err("operation.torque_curve_Nm names no torques".to_owned()),
        count => Ok(format!("operation.torque_curve_Nm: transmission error under {count} torques, new and worn")),
    }
}

/// Stiffness of the teeth as springs.
fn tooth_stiffness(scene: &Scene) -> Result<String, String> {
    if scene.contact.surface == SurfaceKind::Fem {
        return Err("the finite-element model has the compliance of the teeth itself".to_owned());
    }
    match scene.stiffness {
        StiffnessSettings::Constant { pair_n_per_mm2 } => {
            Err(format!("the stiffness is given: {} N/(mm·µm) for every tooth pair", pair_n_per_mm2 / 1e3))
        }
        StiffnessSettings::WeberBanaschek => {
            Ok("Weber and Banaschek's terms, integrated on the generated profile".to_owned())
        }
        StiffnessSettings::Iso6336 => Ok("the single stiffness c' of ISO 6336-1".to_owned()),
        StiffnessSettings::Fem => Ok("the curve of the finite-element calibration".to_owned()),
        StiffnessSettings::Simon | StiffnessSettings::WangCheng => {
            Ok(format!("the curve of {}", scene.stiffness_curve_file.as_deref().unwrap_or_default()))
        }
    }
}

/// Number of different loads of the phases of `scene`.
fn loads(scene: &Scene) -> f64 {
    let phases = &scene.operation.phases;
    let is_first = |(at, phase): &(usize, &Phase)| {
        phases[..*at].iter().all(|earlier| earlier.pinion_torque_n_mm != phase.pinion_torque_n_mm)
    };
    phases.iter().enumerate().filter(is_first).count() as f64
}

/// Elements over the face width of the three-dimensional finite elements of `scene`.
fn layers_in_space(scene: &Scene) -> usize {
    let count = scene.slices.map_or(1, |slices| slices.count);
    SpaceResolution::of_slices(count).layers(&scene.pair, &scene.fem.in_space())
}

/// Memory of the three-dimensional finite elements of `scene`, GB: their sectors while they are condensed, and for each of its loads the matrices that couple
/// its slices afterwards.
fn memory_in_space_gb(scene: &Scene) -> [f64; 2] {
    let loads = loads(scene);
    let count = scene.slices.map_or(1, |slices| slices.count);
    let (slices, positions) = (count as f64 / 100.0, scene.numerics.positions as f64 / 400.0);
    let sectors = SpaceResolution::of_slices(count).memory_gb(&scene.pair, &scene.fem.in_space());
    [sectors, loads * COUPLED_GB * slices * slices * positions]
}

fn teeth_in_space(scene: &Scene) -> Result<String, String> {
    let needs = |what: &str| {
        let [sectors, _] = memory_in_space_gb(scene);
        Ok(format!("{what}: one sector of each gear over the whole face width, condensed in some {sectors:.1} GB"))
    };
    match scene.slices.map(|slices| slices.coupling) {
        None => Err("all sections are alike".to_owned()),
        Some(Coupling::Fem) => needs("helical.coupling"),
        Some(_) if verification(scene).is_ok() => needs("the verification"),
        Some(coupling) => Err(format!("the coupling {} of the slices has none", coupling.name())),
    }
}

fn helical_slices(scene: &Scene) -> Result<String, String> {
    let Some(slices) = scene.slices else {
        return Err("no helix angle, no modification over the face width and no web: all sections are alike".to_owned());
    };
    let coupling = match slices.coupling {
        Coupling::None => "independent thin slices on a common hub",
        Coupling::Slicing => "coupled by plate theory through the bending of the tooth",
        Coupling::Fem => "coupled by three-dimensional finite elements of both gears",
    };
    Ok(format!("{} slices over the face width, {coupling}", slices.count))
}

/// On Hertz's ellipse the pressure does not answer to short waves of wear, so that no step makes them grow.
fn step_bound(scene: &Scene) -> Result<String, String> {
    match (scene.numerics.stepping, scene.contact.surface) {
        (Stepping::Adaptive { .. }, _) => Err("adaptive steps keep to the stability limit by themselves".to_owned()),
        (_, SurfaceKind::Hertz | SurfaceKind::HertzMean) => {
            Err(format!("the surface {} sets no limit on the step", scene.contact.surface.name()))
        }
        (Stepping::Fixed { .. }, _) => {
            Ok("how long a step of Euler's method may be: the spectral radius of the mesh cycle".to_owned())
        }
    }
}

fn contact_match(scene: &Scene) -> Result<String, String> {
    match (scene.contact.surface, scene.contact.foundation) {
        (SurfaceKind::Winkler, Foundation::Matched(criterion)) => {
            let same = criterion.name();
            Ok(format!("K/H of the foundation such that it has Hertz's {same} at the pitch point under the whole load"))
        }
        (SurfaceKind::Winkler, Foundation::Given { foundation_mpa_per_mm }) => {
            Err(format!("K/H is given: {foundation_mpa_per_mm} MPa/mm"))
        }
        (SurfaceKind::Winkler, Foundation::Calibrated(criterion)) => {
            Err(format!("K/H for every position and load is in the calibration, matched on {}", criterion.name()))
        }
        (surface, _) => Err(format!("the surface {} has no foundation K/H", surface.name())),
    }
}

fn simulation(scene: &Scene) -> String {
    let (operation, numerics) = (&scene.operation, &scene.numerics);
    let steps = match numerics.stepping {
        Stepping::Fixed { revolutions } => {
            format!("about {} wear steps", (operation.pinion_revolutions / revolutions).ceil())
        }
        Stepping::Adaptive { tolerance_mm } => {
            format!("adaptive wear steps (Runge–Kutta–Chebyshev) within {} µm", 1e3 * tolerance_mm)
        }
    };
    let stop = operation.stop;
    let limits = [
        stop.wear_mm.map(|limit| format!("{} µm of wear", 1e3 * limit)),
        stop.tip_thickness_mm.map(|limit| format!("{limit} mm left of a tip")),
    ];
    let limits: Vec<String> = limits.into_iter().flatten().collect();
    let ends = if limits.is_empty() { String::new() } else { format!(", ends at {}", limits.join(" or at ")) };
    let tip_edges = if scene.contact.tip_contact { ", contact at tip edges before A and after E" } else { "" };
    let PerGear { pinion, wheel } = operation.meshes_per_revolution;
    let mates = match operation.meshes_per_revolution == Operation::ONE_MATE {
        true => String::new(),
        false => format!(", {pinion} meshes a revolution of the pinion and {wheel} of the wheel"),
    };
    format!(
        "{steps}{ends}, {} positions, {} points a flank, {} snapshots{tip_edges}{mates}{}",
        numerics.positions,
        numerics.flank_points,
        operation.snapshots_revolutions.len(),
        phases(operation)
    )
}

/// The first phases with their durations and loads; nothing where there is only one.
fn phases(operation: &Operation) -> String {
    let count = operation.phases.len();
    if count == 1 {
        return String::new();
    }
    let mut begin = 0.0;
    let listed: Vec<String> = operation
        .phases
        .iter()
        .take(PHASES_LISTED)
        .enumerate()
        .map(|(index, phase)| {
            let duration = phase.end_revolutions - std::mem::replace(&mut begin, phase.end_revolutions);
            let unit = if index == 0 { " revolutions" } else { "" };
            format!("{duration:.0}{unit} under {} N·m", 1e-3 * phase.pinion_torque_n_mm)
        })
        .collect();
    let more = if count > PHASES_LISTED { ", …" } else { "" };
    format!("; {count} phases: {}{more}", listed.join(", "))
}
