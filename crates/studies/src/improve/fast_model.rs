//! Model that designs are searched on.
//!
//! A spur pair on finite elements is searched on elastic half-planes, which take a seventh of the time, with the stiffness of its teeth by the same finite
//! elements. That stiffness is of the unmodified teeth: where the free keys are modifications it is computed once, else for each design. Other scenes are
//! searched on their own contact surface. The resolution is coarse: at most [`POSITIONS`], [`FLANK_POINTS`] and [`SLICES`] and wear
//! steps within [`TOLERANCE_UM`].

use gearwear::evaluate::output::SummaryOutput;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear::varied_scene::{VariedPair, in_words, one_line};
use gearwear_physics::assessment::calibrate::{CalibrateError, CalibrationExtent};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::calibration::identity::CalibrationIdentity;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::observer::Observer;
use gearwear_physics::operation::Scene;
use gearwear_physics::results::run::StopReason;
use gearwear_physics::simulation::settings::Stepping;
use gearwear_physics::stiffness::settings::StiffnessSettings;

use super::asked::ImproveError;
use super::free_key::FreeKey;

/// Most positions from A to E: of sections that are alike, and of slices.
pub const POSITIONS: [usize; 2] = [100, 60];
/// Most points of a flank, likewise.
pub const FLANK_POINTS: [usize; 2] = [250, 200];
/// Most slices over the face width.
pub const SLICES: usize = 8;
/// Least error of the wear depth that adaptive steps may make, µm.
pub const TOLERANCE_UM: f64 = 0.2;

/// Figures of a design, or on one line why there are none.
pub type Figures = Result<Vec<Option<f64>>, String>;

/// Fast model of a scene.
pub struct FastModel {
    varied: VariedPair,
    /// Whether files that the scene names belong to all designs.
    keeps_the_pair: bool,
    /// What it is, in a sentence.
    pub how: String,
}

impl FastModel {
    /// Fast model of designs of `scene`, in which `free` keys change; none are reliefs. It finds the transmission error over torque where that is
    /// asked for.
    ///
    /// # Errors
    /// An interrupt, or a scene whose text cannot be read again.
    pub fn of(
        scene: &LoadedScene,
        free: &[FreeKey],
        torque_curve: bool,
        observer: &dyn Observer,
    ) -> Result<Self, ImproveError> {
        let keeps_the_teeth = keeps_the_teeth(scene, free);
        let half_space = scene.scene().contact.surface == SurfaceKind::Fem && scene.scene().slices.is_none();
        let sliced = scene.scene().slices.or_else(|| slices_of_designs(scene, free));
        let coarse =
            |surface: Option<SurfaceKind>| scene.with_all(changes(scene.scene(), sliced, surface, keeps_the_teeth));
        // Where the pair cannot be on half-planes it stays where it is.
        let on_half_space = half_space.then(|| coarse(Some(SurfaceKind::HalfSpace))).and_then(Result::ok);
        let fast = match on_half_space {
            Some(fast) => fast,
            None => coarse(None).map_err(|error| ImproveError::Base(one_line(&error.to_string())))?,
        };
        let surface = fast.scene().contact.surface.name();
        let calibrates = fast.scene().stiffness == StiffnessSettings::Fem && fast.files.calibration.is_none();
        let (fast, teeth) = match (calibrates, keeps_the_teeth) {
            (true, true) => match calibrated(&fast, observer)? {
                Some(calibrated) => (calibrated, ", the stiffness of its teeth by finite elements once"),
                None => (fast, ""),
            },
            (true, false) => (fast, ", the stiffness of its teeth by finite elements for each design"),
            (false, _) => (fast, ""),
        };
        let of = &fast.scene();
        let slices = of.slices.map_or_else(String::new, |slices| {
            format!(", {} slices (coupling {})", slices.count, slices.coupling.name())
        });
        let how = format!(
            "contact surface {surface}{teeth}, {} positions, {} points a flank{slices}",
            of.numerics.positions, of.numerics.flank_points
        );
        let varied = VariedPair::new(&fast, false).map_err(|problems| scene.given.refused(problems))?;
        let varied = varied.with_torque_curve(torque_curve);
        Ok(Self { varied, keeps_the_pair: keeps_the_teeth, how })
    }

    /// Figures of the design with these values; `None` where it was interrupted.
    pub fn figures<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, toml::Value)>,
        figures: &[SummaryOutput],
        observer: &dyn Observer,
    ) -> Option<Figures> {
        let summary = guarded(|| {
            let resolved = self.varied.resolved(values).map_err(|problems| in_words(&problems))?;
            if !self.keeps_the_pair {
                self.varied.inputs_belong_to(&resolved)?;
            }
            self.varied.carry_out(resolved, observer, runs::summarise)
        });
        let summary = summary.unwrap_or_else(|said| Err(format!("a defect of the program: {said}")));
        match summary {
            Ok(summary) if summary.stopped == StopReason::Interrupted => None,
            Ok(summary) => Some(figures_of(&summary, figures)),
            Err(_) if observer.interrupted() => None,
            Err(reason) => Some(Err(one_line(&reason))),
        }
    }

    /// Why the design with these values is no scene; `None` where it is one.
    pub fn fault<'a>(&self, values: impl IntoIterator<Item = (&'a str, toml::Value)>) -> Option<String> {
        self.varied.resolved(values).err().map(|problems| one_line(&in_words(&problems)))
    }
}

/// Figures of a summary; a life that is longer than the run is its duration.
pub fn figures_of(summary: &impl serde::Serialize, figures: &[SummaryOutput]) -> Figures {
    let summary = serde_json::to_value(summary).map_err(|error| error.to_string())?;
    let value = |figure: &SummaryOutput| {
        let value = figure.of(&summary).or_else(|| figure.at_least(&summary));
        value.filter(|value| value.is_finite())
    };
    Ok(figures.iter().map(value).collect())
}

/// Changes of the scene to a coarse one.
fn changes(
    scene: &Scene,
    sliced: Option<SliceSettings>,
    surface: Option<SurfaceKind>,
    keeps_the_teeth: bool,
) -> Vec<(String, Option<toml::Value>)> {
    let numerics = &scene.numerics;
    let least = |own: usize, most: usize| Some(toml::Value::Integer(own.min(most) as i64));
    let kind = usize::from(sliced.is_some());
    let mut changes = vec![
        ("improve".to_owned(), None),
        ("numerics.verify".to_owned(), Some(false.into())),
        ("numerics.error_estimate".to_owned(), Some(false.into())),
        ("numerics.positions".to_owned(), least(numerics.positions, POSITIONS[kind])),
        ("numerics.flank_points".to_owned(), least(numerics.flank_points, FLANK_POINTS[kind])),
    ];
    if let Stepping::Adaptive { tolerance_mm } = numerics.stepping {
        changes.push(("numerics.tolerance_um".to_owned(), Some((1e3 * tolerance_mm).max(TOLERANCE_UM).into())));
    }
    if let Some(surface) = surface {
        changes.push(("contact.surface".to_owned(), Some(surface.name().into())));
    }
    if let Some(slices) = sliced {
        changes.push(("helical.slices".to_owned(), least(slices.count, SLICES)));
        if slices.coupling == Coupling::Fem && !keeps_the_teeth {
            changes.push(("helical.coupling".to_owned(), Some(Coupling::Slicing.name().into())));
        }
    }
    changes
}

/// The scene with the stiffness of its teeth; `None` where finite elements cannot be made.
fn calibrated(scene: &LoadedScene, observer: &dyn Observer) -> Result<Option<LoadedScene>, ImproveError> {
    observer.stage("calibration of the fast model");
    match guarded(|| runs::calibrate(scene, CalibrationExtent::FastModel, observer)) {
        Ok(Ok(calibrated)) => Ok(scene.with_calibration(calibrated.calibration).ok()),
        Ok(Err(CalibrateError::Interrupted)) => Err(ImproveError::Interrupted),
        Ok(Err(_)) | Err(_) => Ok(None),
    }
}

/// Whether all designs have the teeth of the scene but for their modifications, tried with all free keys at either end.
fn keeps_the_teeth(scene: &LoadedScene, free: &[FreeKey]) -> bool {
    let Ok(varied) = VariedPair::new(scene, false) else { return false };
    let own = teeth(scene.scene());
    let at = |share: f64| varied.resolved(free.iter().map(|one| (one.key.as_str(), one.in_scene(one.value(share)))));
    let is_own = |resolved: &Resolved| teeth(&resolved.scene) == own;
    // An end that is no scene tells nothing.
    own.is_some() && [0.0, 0.5, 1.0].into_iter().all(|share| at(share).as_ref().ok().is_none_or(is_own))
}

/// Slices of designs of a spur pair that vary over the face width.
fn slices_of_designs(scene: &LoadedScene, free: &[FreeKey]) -> Option<SliceSettings> {
    let varied = VariedPair::new(scene, false).ok()?;
    let greatest = free.iter().map(|one| (one.key.as_str(), one.in_scene(one.value(1.0))));
    varied.resolved(greatest).ok()?.scene.slices
}

/// Unmodified teeth with their material, width and load.
fn teeth(scene: &Scene) -> Option<(CalibrationIdentity, f64, String)> {
    let teeth = CalibrationIdentity::of_unmodified(&scene.pair, &scene.material, &scene.fem)?;
    Some((teeth, scene.pair.face_width_mm, format!("{:?}", scene.operation.torque_range_n_mm())))
}
