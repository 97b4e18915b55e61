//! Finite-element contact of a scene's gear pair: mesh, condense, solve the positions, record.
//!
//! Each gear is factorised and condensed once; a position then is a small contact problem ([`gearwear_bodies::gear_fem`]). The
//! positions are solved in batches of fixed size, between which progress is reported and an interrupt heard, without effect on the results.

mod field;
mod recording;
mod whole;

use std::time::Instant;

use recording::RecordSource;
use whole::WholeModel;

use crate::assessment::Done;
use crate::assessment::stage_clock::StageClock;
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::fem_pair::FemPairStage;
use crate::results::fem_pair::{FemPairRecord, FullModelSummary};
use crate::results::provenance::Provenance;
use crate::results::run::StopReason;
use gearwear_bodies::gear::path_of_contact::PathOfContact;
use gearwear_bodies::gear::{Gear, GearPair, PairError, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::cycle::{CycleError, cycle};
use gearwear_bodies::gear_fem::full::FullError;
use gearwear_bodies::gear_fem::model::{MeshedGear, ModelError, much_memory};
use gearwear_bodies::gear_fem::position::PositionContact;
use gearwear_bodies::material::Material;
use gearwear_fem::element::ElementError;
use gearwear_mesh::quality::QualityError;

/// Positions solved between two questions to the observer.
const BATCH: usize = 64;

/// Failure of a finite-element contact.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FemPairError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The position asked for lies outside the path of contact.
    #[error("position {given_mm} mm lies outside the path of contact, from A at {from_mm:.4} to E at {to_mm:.4} mm")]
    Position {
        /// Position asked for.
        given_mm: f64,
        /// Position of A.
        from_mm: f64,
        /// Position of E.
        to_mm: f64,
    },
    /// A gear cannot be modelled.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A mesh came out unfit.
    #[error("{}: {source}", gear.name())]
    Quality {
        /// Gear of the mesh.
        gear: Gear,
        /// Fault of the mesh.
        source: QualityError,
    },
    /// The contact at a position was not found.
    #[error(transparent)]
    Contact(#[from] CycleError),
    /// The whole model has no solution.
    #[error("whole model at position {position_mm:.4} mm: {source}")]
    Full {
        /// Position on the path of contact.
        position_mm: f64,
        /// Failure of the solver.
        source: Box<FullError>,
    },
    /// Stresses cannot be computed.
    #[error(transparent)]
    Stress(#[from] ElementError),
}

/// Question to the model of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FemPairRequest {
    /// Position to solve, mm; `None`: the mesh cycle.
    pub position_mm: Option<f64>,
    /// Whether to solve the whole model without condensation too, at that position or at A to E.
    pub full: bool,
}

/// Solved positions.
struct Solved {
    /// Contacts at the positions, in order.
    positions: Vec<PositionContact>,
    /// Contacts at A to E; none where one position was asked for.
    points: Option<[PositionContact; 5]>,
    full: Option<Vec<FullModelSummary>>,
    stop: StopReason,
}

/// Solves the contact. The report is left to the caller, who knows where it goes.
///
/// A run that is interrupted or does not converge gives the record of what it had finished, and its failure in the latter case.
///
/// # Errors
/// [`FemPairError`] where no position was solved.
pub fn run(
    scene: &Scene,
    provenance: &Provenance,
    request: FemPairRequest,
    observer: &dyn Observer,
) -> Result<Done<FemPairRecord, FemPairError>, FemPairError> {
    let start = Instant::now();
    let mut stages = StageClock::new(observer);

    let pair = stages.run(FemPairStage::Geometry.name(), || GearPair::new(&scene.pair))?;
    let position_mm = request.position_mm.map(|given_mm| on_path(&pair.path, given_mm)).transpose()?;
    let line_load_n_per_mm = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
    let material = scene.material.map(Material::elastic);
    let meshed = stages.run(FemPairStage::Meshing.name(), || {
        PerGear::try_in_parallel(|gear| MeshedGear::new(&pair, gear, &material, line_load_n_per_mm, &scene.fem))
    })?;
    if let Some(warning) = much_memory(&meshed, 1.0)? {
        observer.announcement(&warning);
    }
    let gears = stages.run(FemPairStage::Condensation.name(), || {
        PerGear::try_in_parallel(|gear| meshed[gear].condense(&pair, material[gear]))
    })?;
    let model = CondensedPair::new(&pair, &material, gears);
    let source = RecordSource { scene, provenance, model: &model, meshed: &meshed, line_load_n_per_mm, position_mm };

    let (mut solved, mut failure) = solve(&source, &mut stages)?;
    if solved.stop == StopReason::Completed && position_mm.is_none() {
        match stages.run(FemPairStage::PathPoints.name(), || cycle(&model, &pair.path.points_mm(), line_load_n_per_mm))
        {
            Ok(found) => solved.points = <[PositionContact; 5]>::try_from(found).ok(),
            Err(error) => (failure, solved.stop) = (Some(error.into()), StopReason::NotConverged),
        }
    }
    if request.full && solved.stop == StopReason::Completed {
        let at: &[PositionContact] = solved.points.as_ref().map_or(&solved.positions, |points| points);
        let whole = WholeModel { pair: &pair, meshed: &meshed, material: &material, line_load_n_per_mm };
        let full = stages.run(FemPairStage::FullModel.name(), || {
            at.iter().map(|condensed| whole.against(condensed)).collect::<Result<Vec<_>, _>>()
        });
        solved.full = Some(full?);
    }
    let solution = solved
        .shown(position_mm)
        .map(|shown| stages.run(FemPairStage::Stresses.name(), || field::solution(&model, &meshed, &material, shown)));
    let mut record = recording::record(source, &solved, solution.transpose()?)?;
    record.summary.wall_per_position_s = wall_per_position_s(&stages, solved.positions.len());
    record.summary.stages = stages.times;
    record.summary.wall_s = start.elapsed().as_secs_f64();
    Ok(Done { record, failure })
}

impl Solved {
    /// Contact whose displacements and stresses are shown: at C, or at the one position asked for.
    fn shown(&self, position_mm: Option<f64>) -> Option<&PositionContact> {
        match &self.points {
            Some([_, _, at_c, ..]) => Some(at_c),
            None => self.positions.first().filter(|_| position_mm.is_some()),
        }
    }
}

/// Mean wall time of a position of the mesh cycle, s; none without positions.
fn wall_per_position_s(stages: &StageClock<'_>, positions: usize) -> Option<f64> {
    let cycle = stages.times.iter().find(|stage| stage.name == FemPairStage::Cycle.name())?;
    (positions > 0).then(|| cycle.wall_s / positions as f64)
}

/// Position on the path of contact, whose ends are printed with four decimals and may be given as printed.
fn on_path(path: &PathOfContact, given_mm: f64) -> Result<f64, FemPairError> {
    const ROUNDING_MM: f64 = 1e-4;
    let (from_mm, to_mm) = (path.start_mm, path.end_mm);
    if (from_mm - ROUNDING_MM..=to_mm + ROUNDING_MM).contains(&given_mm) {
        Ok(given_mm.clamp(from_mm, to_mm))
    } else {
        Err(FemPairError::Position { given_mm, from_mm, to_mm })
    }
}

/// Solves the position asked for or those of the mesh cycle, batch by batch until one fails or the user interrupts.
///
/// # Errors
/// Failure before any position was solved.
fn solve(
    source: &RecordSource<'_>,
    stages: &mut StageClock<'_>,
) -> Result<(Solved, Option<FemPairError>), FemPairError> {
    let observer = stages.observer;
    let positions_mm = match source.position_mm {
        Some(position_mm) => vec![position_mm],
        None => source.model.pair.path.evenly_mm(source.scene.numerics.positions),
    };
    let mut positions = Vec::with_capacity(positions_mm.len());
    let failure = stages.run(FemPairStage::Cycle.name(), || {
        for batch in positions_mm.chunks(BATCH) {
            if observer.interrupted() {
                break;
            }
            match cycle(source.model, batch, source.line_load_n_per_mm) {
                Ok(found) => positions.extend(found),
                Err(error) => return Some(FemPairError::from(error)),
            }
            observer.progress(positions.len() as f64, positions_mm.len() as f64);
        }
        None
    });
    let stop = match &failure {
        Some(error) if positions.is_empty() => return Err(error.clone()),
        Some(_) => StopReason::NotConverged,
        None if positions.len() == positions_mm.len() => StopReason::Completed,
        None => StopReason::Interrupted,
    };
    Ok((Solved { positions, points: None, full: None, stop }, failure))
}
