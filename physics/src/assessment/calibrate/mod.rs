//! Carries out a calibration: finite elements of the scene's pair, and all that the fast model and the reader take from
//! them ([`crate::calibration`]).

mod wear_reference;

use std::time::Instant;

use crate::assessment::stage_clock::StageClock;
use crate::calibration::bodies::Setup;
use crate::calibration::identity::CalibrationIdentity;
use crate::calibration::single_contact::SingleContact;
use crate::calibration::slice_fit::SliceFit;
use crate::calibration::tooth_stiffness::LoadedPair;
use crate::calibration::{
    Calibration, CalibrationError, STIFFNESS_POSITIONS, foundation_fit, single_contact, slice_fit, stiffness_variation,
    tooth_family,
};
use crate::gear::modification::Modification;
use crate::gear::{Gear, GearPair, PairError};
use crate::gear_fem::{condensed_pair::CondensedPair, model::much_memory};
use crate::gear_mesh::settings::Body;
use crate::material::Material;
use crate::mesh_cycle::load_sharing::EquilibriumError;
use crate::mesh_cycle::pair_in_space::KeptInSpace;
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::calibration::CalibrationStage;
use crate::results::run::StageTime;
use crate::stiffness::{StiffnessError, curve::PairCompliance, iso6336};

/// The memory of a calibration at its peak over that of its own pair of bodies: finer meshes and other rims stand beside it. 1.3 to 1.7 on FZG type
/// C with tip roundings of 0.1 and 0.001 mm.
const BODIES_AT_ONCE: f64 = 1.7;

/// Why there is no calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// Finite elements gave none.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The flattening of the surfaces alone is more than the whole pair yields.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// The mesh cycle of unworn flanks has no equilibrium.
    #[error("mesh cycle under {line_load_n_per_mm:.2} N/mm: {source}")]
    Cycle {
        /// w.
        line_load_n_per_mm: f64,
        /// Why.
        source: EquilibriumError,
    },
    /// The user stopped it.
    #[error("interrupted")]
    Interrupted,
}

/// A calibration and how it came about.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibrated {
    /// The calibration, hash filled in.
    pub calibration: Calibration,
    /// Stages with their times.
    pub stages: Vec<StageTime>,
    /// All of them together, s.
    pub wall_s: f64,
}

/// Listens to the observer between the stages.
struct Stages<'a>(StageClock<'a>);

impl Stages<'_> {
    fn run<T, E: Into<CalibrateError>>(
        &mut self,
        stage: CalibrationStage,
        work: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, CalibrateError> {
        if self.0.observer.interrupted() {
            return Err(CalibrateError::Interrupted);
        }
        self.0.run(stage.name(), work).map_err(Into::into)
    }
}

/// How much of a calibration is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of it.
    Whole,
    /// What the fast model reads; the tables of other bodies and other teeth stay empty.
    FastModel,
}

/// Calibrates the pair of `scene`, with teeth in space that are `kept` where they are its own. The files are left to the caller.
pub fn run(
    scene: &Scene,
    extent: Extent,
    kept: &KeptInSpace,
    observer: &dyn Observer,
) -> Result<Calibrated, CalibrateError> {
    use CalibrationStage as Stage;
    let start = Instant::now();
    let mut stages = Stages(StageClock::new(observer));
    let pair = stages.run(Stage::Geometry, || GearPair::new(&scene.pair))?;
    let setup = setup(scene, &pair);
    let w = setup.line_load_n_per_mm;
    let meshed = stages.run(Stage::Meshing, || setup.meshed())?;
    if let Some(warning) = much_memory(&meshed, BODIES_AT_ONCE).map_err(CalibrationError::from)? {
        observer.announcement(&warning);
    }
    let condensed = stages.run(Stage::Condensation, || setup.condensed(&meshed))?;
    let loaded = LoadedPair::new(&condensed, &scene.material);
    let deflection = stages.run(Stage::ToothStiffness, || loaded.along_the_path(STIFFNESS_POSITIONS, w))?;
    let path_points_mm = pair.path.points_mm();
    let single_contact = stages.run(Stage::Foundation, || on_plain_flanks(&setup, &condensed, &loaded))?;
    let ends_mm = (pair.path.start_mm, pair.path.end_mm);
    let (foundation, foundation_fit) = foundation_fit::all(&single_contact, w, ends_mm);
    let (mut convergence, mut rim_depth, mut neighbours, mut family) = Default::default();
    if extent == Extent::Whole {
        convergence = stages.run(Stage::Convergence, || setup.convergence())?;
        rim_depth = stages.run(Stage::RimDepth, || setup.rim_depths())?;
        neighbours = stages.run(Stage::Neighbours, || setup.neighbours())?;
        family = stages.run(Stage::ToothFamily, || tooth_family::family(&setup))?;
    }
    let pair_compliance = loaded.curve(&deflection, w);
    let in_slices = scene.slices.is_some() && scene.fem.body == Body::Ring;
    let slices = match in_slices {
        true => stages.run(Stage::Slices, || slices(scene, &pair, kept, (&pair_compliance, w), observer))?,
        false => None,
    };
    let stopped = || observer.interrupted();
    let wear_reference = stages.run(Stage::WearReference, || wear_reference::references(&condensed, w, &stopped))?;
    let mut calibration = Calibration {
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        hash: String::new(),
        belongs_to: CalibrationIdentity::of(&pair, &scene.material, &scene.fem),
        elements_per_half_width: scene.fem.elements_per_half_width,
        line_load_n_per_mm: w,
        path_points_mm,
        pair_compliance,
        foundation,
        foundation_fit,
        deflection_at_points: path_points_mm.map(|position_mm| loaded.deflection(position_mm, w)),
        iso6336_n_per_mm_um: 1e-3 * iso6336::single_stiffness_n_per_mm2(&scene.pair, &scene.material, w),
        courses: stiffness_variation::courses(&pair, &deflection),
        deflection,
        single_contact,
        convergence,
        rim_depth,
        neighbours,
        family,
        wear_reference,
        slices,
    };
    calibration.hash = calibration.content_hash();
    Ok(Calibrated { calibration, stages: stages.0.times, wall_s: start.elapsed().as_secs_f64() })
}

/// How the slices of the pair yield together; none, with a warning, where its teeth cannot be had in space.
fn slices(
    scene: &Scene,
    pair: &GearPair,
    kept: &KeptInSpace,
    (curve, line_load_n_per_mm): (&PairCompliance, f64),
    observer: &dyn Observer,
) -> Result<Option<SliceFit>, StiffnessError> {
    let elastic = scene.material.map(Material::elastic);
    match kept.condensed(pair, elastic, scene.fem.in_space(), slice_fit::SLICES, line_load_n_per_mm) {
        Ok(in_space) => slice_fit::fit(pair, &scene.material, &in_space, curve, line_load_n_per_mm).map(Some),
        Err(error) => {
            observer.warning(&format!(
                "{}: the teeth cannot be had in space ({error}), so that the calibration says nothing of slices",
                error.scene_key()
            ));
            Ok(None)
        }
    }
}

/// The pair alone in contact, without relief and crowning: K/H belongs to the curvature of the involute, and a relief changes
/// that where it begins. Tip roundings stay: they end the flank.
fn on_plain_flanks(
    setup: &Setup<'_>,
    condensed: &CondensedPair<'_>,
    loaded: &LoadedPair<'_>,
) -> Result<Vec<SingleContact>, CalibrateError> {
    let w = setup.line_load_n_per_mm;
    let mut spec = setup.pair.spec.clone();
    for gear in Gear::BOTH {
        let own = &mut spec.gears[gear].modification;
        *own = Modification { tip_rounding_mm: own.tip_rounding_mm, ..Modification::default() };
    }
    if spec == setup.pair.spec {
        return Ok(single_contact::solve(condensed, loaded, w)?);
    }
    let pair = GearPair::new(&spec)?;
    let plain = Setup { pair: &pair, ..*setup };
    let condensed = plain.condensed(&plain.meshed()?)?;
    Ok(single_contact::solve(&condensed, &LoadedPair::new(&condensed, &setup.material), w)?)
}

/// The scene's pair with what finite elements need to know of it.
pub(super) fn setup<'a>(scene: &Scene, pair: &'a GearPair) -> Setup<'a> {
    let line_load_n_per_mm = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
    Setup { pair, material: scene.material, bodies: scene.fem, line_load_n_per_mm }
}
