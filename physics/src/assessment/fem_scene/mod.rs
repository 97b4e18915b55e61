//! Carries out finite-element contact of a scene's gear pair: mesh, condense, solve the positions, record.
//!
//! Each gear is factorised and condensed once; a position then is a small contact problem ([`crate::gear_fem`]). The
//! positions are solved in batches of fixed size, so that progress is told and an interrupt heard between them without
//! any effect on the results.

mod field;
mod recording;
mod whole;

use std::time::Instant;

use self::whole::WholeModel;

use crate::assessment::Done;
use crate::assessment::stage_clock::StageClock;
use crate::gear::path_of_contact::PathOfContact;
use crate::gear::{Gear, GearPair, PairError, PerGear};
use crate::gear_fem::condensed_pair::CondensedPair;
use crate::gear_fem::cycle::{CycleError, cycle};
use crate::gear_fem::full::FullError;
use crate::gear_fem::model::{MeshedGear, ModelError, much_memory};
use crate::gear_fem::position::PositionContact;
use crate::material::Material;
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::fem_pair::FemPairStage;
use crate::results::fem_pair::{FemPairRecord, FullModelSummary};
use crate::results::provenance::Provenance;
use crate::results::run::StopReason;
use gearwear_fem::element::ElementError;
use gearwear_mesh::quality::QualityError;

/// Positions solved before the observer is asked again.
const BATCH: usize = 64;

/// Why there is no result, or not the whole.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FemPairError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The position asked for lies outside the path of contact.
    #[error("position {given_mm} mm lies outside the path of contact, from A at {from_mm:.4} to E at {to_mm:.4} mm")]
    Position {
        /// As asked for.
        given_mm: f64,
        /// A.
        from_mm: f64,
        /// E.
        to_mm: f64,
    },
    /// A gear cannot be modelled.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A mesh came out unfit.
    #[error("{}: {source}", gear.name())]
    Quality {
        /// Whose.
        gear: Gear,
        /// Why.
        source: QualityError,
    },
    /// The contact at a position was not found.
    #[error(transparent)]
    Contact(#[from] CycleError),
    /// The whole model has no solution.
    #[error("whole model at position {position_mm:.4} mm: {source}")]
    Full {
        /// Where.
        position_mm: f64,
        /// Why.
        source: Box<FullError>,
    },
    /// Stresses cannot be computed.
    #[error(transparent)]
    Stress(#[from] ElementError),
}

/// What is asked beside the scene.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Asked {
    /// The one position to solve; `None`: the mesh cycle.
    pub position_mm: Option<f64>,
    /// Whether to solve the whole model without condensation too, at that position or at A–E.
    pub full: bool,
}

/// What was solved.
struct Solved {
    /// The positions, in order.
    positions: Vec<PositionContact>,
    /// A–E; none where one position was asked for.
    points: Option<[PositionContact; 5]>,
    full: Option<Vec<FullModelSummary>>,
    stop: StopReason,
}

/// Solves what is asked. The report is left to the caller, who knows where
/// it goes.
///
/// What is interrupted or does not converge gives the record of what was finished, and the failure in the latter case.
pub fn run(
    scene: &Scene,
    provenance: &Provenance,
    asked: Asked,
    observer: &dyn Observer,
) -> Result<Done<FemPairRecord, FemPairError>, FemPairError> {
    let start = Instant::now();
    let mut stages = StageClock::new(observer);

    let pair = stages.run(FemPairStage::Geometry.name(), || GearPair::new(&scene.pair))?;
    let path = &pair.path;
    let position_mm = asked.position_mm.map(|given_mm| on_path(path, given_mm)).transpose()?;
    let line_load_n_per_mm = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
    let material = scene.material.map(Material::elastic);
    let meshed = stages.run(FemPairStage::Meshing.name(), || {
        let mesh = |gear| MeshedGear::new(&pair, gear, &material, line_load_n_per_mm, &scene.fem);
        PerGear::try_in_parallel(mesh)
    })?;
    if let Some(warning) = much_memory(&meshed, 1.0)? {
        observer.announcement(&warning);
    }
    let gears = stages.run(FemPairStage::Condensation.name(), || {
        PerGear::try_in_parallel(|gear| meshed[gear].condense(&pair, material[gear]))
    })?;
    let model = CondensedPair::new(&pair, &material, gears);

    let positions_mm = match position_mm {
        Some(position_mm) => vec![position_mm],
        None => path.evenly_mm(scene.numerics.positions),
    };
    let (positions, mut failure) =
        stages.run(FemPairStage::Cycle.name(), || solve(&model, &positions_mm, line_load_n_per_mm, observer));
    let mut stop = match (&failure, positions.len() == positions_mm.len()) {
        (Some(_), _) => StopReason::NotConverged,
        (None, true) => StopReason::Completed,
        (None, false) => StopReason::Interrupted,
    };
    if let (Some(error), true) = (&failure, positions.is_empty()) {
        return Err(error.clone());
    }
    let mut points = None;
    if stop == StopReason::Completed && position_mm.is_none() {
        match stages.run(FemPairStage::PathPoints.name(), || cycle(&model, &path.points_mm(), line_load_n_per_mm)) {
            Ok(found) => points = <[PositionContact; 5]>::try_from(found).ok(),
            Err(error) => {
                failure = Some(error.into());
                stop = StopReason::NotConverged;
            }
        }
    }
    let mut full = None;
    if asked.full && stop == StopReason::Completed {
        let at: &[PositionContact] = points.as_ref().map_or(&positions, |points| points);
        let whole = WholeModel { pair: &pair, meshed: &meshed, material: &material, line_load_n_per_mm };
        full = Some(stages.run(FemPairStage::FullModel.name(), || {
            at.iter().map(|condensed| whole.against(condensed)).collect::<Result<Vec<_>, _>>()
        })?);
    }
    let shown = match &points {
        Some([_, _, at_c, ..]) => Some(at_c),
        None => positions.first().filter(|_| position_mm.is_some()),
    };
    let solution = match shown {
        Some(found) => {
            Some(stages.run(FemPairStage::Stresses.name(), || field::solution(&model, &meshed, &material, found))?)
        }
        None => None,
    };
    let solved = Solved { positions, points, full, stop };
    let parts = recording::Parts {
        scene,
        provenance,
        bodies: &scene.fem,
        model: &model,
        meshed: &meshed,
        line_load_n_per_mm,
        position_mm,
    };
    let mut record = recording::record(parts, &solved, solution)?;
    record.summary.wall_per_position_s = stages
        .times
        .iter()
        .find(|stage| stage.name == FemPairStage::Cycle.name())
        .filter(|_| !solved.positions.is_empty())
        .map(|stage| stage.wall_s / solved.positions.len() as f64);
    record.summary.stages = stages.times;
    record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(Done { record, failure })
}

/// A position on the path of contact. Its ends are printed with four decimals and may be given as printed.
fn on_path(path: &PathOfContact, given_mm: f64) -> Result<f64, FemPairError> {
    const ROUNDING_MM: f64 = 1e-4;
    let (from_mm, to_mm) = (path.start_mm, path.end_mm);
    if (from_mm - ROUNDING_MM..=to_mm + ROUNDING_MM).contains(&given_mm) {
        Ok(given_mm.clamp(from_mm, to_mm))
    } else {
        Err(FemPairError::Position { given_mm, from_mm, to_mm })
    }
}

/// The positions batch by batch, until one fails or the user interrupts.
fn solve(
    model: &CondensedPair<'_>,
    positions_mm: &[f64],
    line_load_n_per_mm: f64,
    observer: &dyn Observer,
) -> (Vec<PositionContact>, Option<FemPairError>) {
    let mut solved = Vec::with_capacity(positions_mm.len());
    for batch in positions_mm.chunks(BATCH) {
        if observer.interrupted() {
            break;
        }
        match cycle(model, batch, line_load_n_per_mm) {
            Ok(found) => solved.extend(found),
            Err(error) => return (solved, Some(error.into())),
        }
        observer.progress(solved.len() as f64, positions_mm.len() as f64);
    }
    (solved, None)
}
