//! Calibration of the scene's pair: its finite elements, and the curves and tables derived from them ([`crate::calibration`]).

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
use crate::mesh_cycle::load_sharing::EquilibriumError;
use crate::mesh_cycle::pair_in_space::KeptInSpace;
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::calibration::CalibrationStage;
use crate::results::run::StageTime;
use crate::stiffness::{StiffnessError, curve::PairCompliance, iso6336};
use gearwear_bodies::gear::modification::Modification;
use gearwear_bodies::gear::{Gear, GearPair, PairError};
use gearwear_bodies::gear_fem::{condensed_pair::CondensedPair, model::much_memory};
use gearwear_bodies::gear_mesh::settings::Body;
use gearwear_bodies::material::Material;

/// Peak memory of a calibration over that of the pair's own bodies: finer meshes and other rims are held beside them. 1.1 on FZG type C with tip
/// roundings of 0.6 mm.
const BODIES_AT_ONCE: f64 = 1.2;

/// Failure of a calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The finite elements failed.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The flattening of the surfaces alone exceeds the deflection of the whole pair.
    #[error(transparent)]
    Stiffness(#[from] StiffnessError),
    /// The mesh cycle of unworn flanks has no equilibrium.
    #[error("mesh cycle under {line_load_n_per_mm:.2} N/mm: {source}")]
    Cycle {
        /// Line load w, N/mm.
        line_load_n_per_mm: f64,
        /// Failure of the equilibrium.
        source: EquilibriumError,
    },
    /// Interrupted by the user.
    #[error("interrupted")]
    Interrupted,
}

/// Calibration with the times of its stages.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibrated {
    /// Calibration with its hash.
    pub calibration: Calibration,
    /// Wall time of each stage.
    pub stages: Vec<StageTime>,
    /// Wall time of the whole calibration, s.
    pub wall_s: f64,
}

/// Stages, between which an interrupt is heard.
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

/// Extent of a calibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CalibrationExtent {
    /// Everything, with the tables of other bodies and other teeth and the wear of unworn flanks.
    Whole,
    /// Curves of the fast model alone.
    FastModel,
}

/// Calibrates the pair of `scene`; three-dimensional finite elements are `kept` for other runs of the same pair. The files are left to the caller.
pub fn run(
    scene: &Scene,
    extent: CalibrationExtent,
    kept: &KeptInSpace,
    observer: &dyn Observer,
) -> Result<Calibrated, CalibrateError> {
    let start = Instant::now();
    let mut stages = Stages(StageClock::new(observer));
    let pair = stages.run(CalibrationStage::Geometry, || GearPair::new(&scene.pair))?;
    let setup = setup(scene, &pair);
    let w = setup.line_load_n_per_mm;
    let meshed = stages.run(CalibrationStage::Meshing, || setup.meshed())?;
    if let Some(warning) = much_memory(&meshed, BODIES_AT_ONCE).map_err(CalibrationError::from)? {
        observer.announcement(&warning);
    }
    let condensed = stages.run(CalibrationStage::Condensation, || setup.condensed(&meshed))?;
    let loaded = LoadedPair::new(&condensed, &scene.material);
    let deflection = stages.run(CalibrationStage::ToothStiffness, || loaded.along_the_path(STIFFNESS_POSITIONS, w))?;
    let points = loaded.deflections(&pair.path.points_mm(), w);
    let at_points = std::array::from_fn(|point| points[point]);
    let single_contact = stages.run(CalibrationStage::Foundation, || on_plain_flanks(&setup, &condensed, &loaded))?;
    let (foundation, foundation_fit) = foundation_fit::all(&single_contact, w, (pair.path.start_mm, pair.path.end_mm));
    let (mut convergence, mut rim_depth, mut neighbours, mut family, mut wear_reference) = Default::default();
    if extent == CalibrationExtent::Whole {
        let (rows, whole_rings) = stages.run(CalibrationStage::Neighbours, || setup.neighbours())?;
        neighbours = rows;
        convergence = stages.run(CalibrationStage::Convergence, || setup.convergence(&whole_rings))?;
        rim_depth = stages.run(CalibrationStage::RimDepth, || setup.rim_depths(&whole_rings))?;
        family = stages.run(CalibrationStage::ToothFamily, || tooth_family::family(&setup))?;
    }
    let pair_compliance = loaded.curve(&deflection, w);
    let slices = match scene.slices.is_some() && scene.fem.body == Body::Ring {
        true => stages.run(CalibrationStage::Slices, || slices(scene, &pair, kept, (&pair_compliance, w), observer))?,
        false => None,
    };
    if extent == CalibrationExtent::Whole {
        wear_reference = stages.run(CalibrationStage::WearReference, || {
            wear_reference::references(&condensed, w, &|| observer.interrupted())
        })?;
    }
    let mut calibration = Calibration {
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        hash: String::new(),
        belongs_to: CalibrationIdentity::of(&pair, &scene.material, &scene.fem),
        elements_per_half_width: scene.fem.elements_per_half_width,
        line_load_n_per_mm: w,
        path_points_mm: pair.path.points_mm(),
        pair_compliance,
        foundation,
        foundation_fit,
        deflection_at_points: at_points,
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

/// Compliance of coupled slices; none, with a warning, where three-dimensional finite elements of the teeth cannot be made.
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
                "{}: three-dimensional finite elements of the teeth cannot be made ({error}), so that the calibration has no compliance of slices",
                error.scene_key()
            ));
            Ok(None)
        }
    }
}

/// Contact of a single pair without relief and crowning: K/H belongs to the curvature of the involute, which a relief changes
/// where it begins. Tip roundings stay: they end the flank.
fn on_plain_flanks(
    setup: &Setup<'_>,
    condensed: &CondensedPair<'_>,
    loaded: &LoadedPair<'_>,
) -> Result<Vec<SingleContact>, CalibrateError> {
    let w = setup.line_load_n_per_mm;
    let mut spec = setup.pair.spec.clone();
    for gear in Gear::BOTH {
        let own = &mut spec.gears[gear];
        own.modification =
            Modification { tip_rounding_mm: own.modification.tip_rounding_mm, ..Modification::default() };
        own.measured_flank = None;
    }
    if spec == setup.pair.spec {
        return Ok(single_contact::solve(condensed, loaded, w)?);
    }
    let pair = GearPair::new(&spec)?;
    let plain = Setup { pair: &pair, ..*setup };
    let condensed = plain.condensed(&plain.meshed()?)?;
    Ok(single_contact::solve(&condensed, &LoadedPair::new(&condensed, &setup.material), w)?)
}

/// Setup of the scene's pair for plane finite elements.
pub(super) fn setup<'a>(scene: &Scene, pair: &'a GearPair) -> Setup<'a> {
    let line_load_n_per_mm = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
    Setup { pair, material: scene.material, bodies: scene.fem, line_load_n_per_mm }
}
