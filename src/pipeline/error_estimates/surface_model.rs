//! The contact surface, from one mesh on a truer one.
//!
//! A whole wear run on the truer surface would cost more than the run itself. What one mesh wears, dh, shows the difference
//! at once, on the unworn flanks and on those the run has worn; wear in between is driven by something between the two.
//! With the pinion's greatest dh on the run's surface and on the truer one at the same resolution,
//!
//! ```text
//! surface model    max over new, worn of |dh − dh_true| / dh_true
//! ```
//!
//! An elastic half-plane stands in for finite elements here: it knows the real gap and the real elasticity near the contact.
//! The tooth stiffness is the same on both surfaces, and so is contact outside the line of action; neither is judged.
//!
//! On the finite-element surface itself what is left is the size of the elements: the mesh with elements twice as long
//! wears dh_coarse in one mesh, and |dh − dh_coarse|/(2² − 1) is the error of the finer one, of second order.

use super::{Companion, Estimate, LEAST_POINTS, relative_cost};
use crate::contact::half_space::HalfSpace;
use crate::contact::settings::SurfaceKind;
use crate::fem::gear::position::CondensedPair;
use crate::gear::{Gear, PerGear, flank::FlankGrid};
use crate::pipeline::Model;
use crate::simulation::settings::Numerics;
use crate::simulation::wear_run::{MeshContact, Outcome, Progress, SimulationError, Snapshot, WearRun};
use crate::stiffness::TeethSpring;

/// The run's points and positions over those of the companions, where enough are left.
const COARSENING: [usize; 3] = [4, 2, 1];

/// The estimate and its cost over that of the run.
pub(super) struct FromOneMesh {
    pub estimate: Estimate,
    pub cost: f64,
}

impl FromOneMesh {
    fn none(reason: &str) -> Self {
        Self { estimate: Estimate::none(reason), cost: 0.0 }
    }
}

/// Estimates within `budget`, a cost over that of the run.
pub(super) fn estimate(
    model: &Model<'_>,
    outcome: &Outcome,
    coarse_elements: Option<&CondensedPair<'_>>,
    budget: f64,
    observer: &dyn Progress,
) -> FromOneMesh {
    let found = match (model.contact, coarse_elements) {
        (MeshContact::FiniteElements(_), Some(coarse)) => elements(model, outcome, coarse, observer),
        (MeshContact::FiniteElements(_), None) => Ok(FromOneMesh::none("the elements cannot be made twice as long")),
        (MeshContact::LineOfAction { .. }, _) if model.scene.contact.surface == SurfaceKind::HalfSpace => {
            Ok(FromOneMesh::none(
                "only finite elements are truer than the elastic half-plane; gearwear accuracy compares them",
            ))
        }
        (MeshContact::LineOfAction { tip_contact, .. }, _) => half_plane(model, outcome, tip_contact, budget, observer),
    };
    found.unwrap_or_else(|error| FromOneMesh::none(&format!("the mesh on a truer surface failed: {error}")))
}

/// The greatest depth that one mesh takes off the pinion, on the unworn and on the worn flanks.
fn peaks_mm(
    run: &WearRun<'_>,
    outcome: &Outcome,
    observer: &dyn Progress,
) -> Result<([f64; 2], u64), SimulationError> {
    let mut equilibria = 0;
    let mut peak = |state: &Snapshot| -> Result<f64, SimulationError> {
        let grid = PerGear::from_fn(|gear| FlankGrid::new(run.pair, gear, run.numerics.flank_points));
        let at_points = PerGear::from_fn(|gear: Gear| {
            let places = grid[gear].coordinate_mm.iter();
            places.map(|&place| outcome.grid[gear].value_at(&state.wear_mm[gear], place)).collect::<Vec<f64>>()
        });
        let (depth_mm, work) = run.one_mesh(state.revolutions, &at_points, &|| observer.gives_up())?;
        equilibria += work.equilibria;
        Ok(depth_mm.pinion.iter().copied().fold(0.0, f64::max))
    };
    let peaks = [peak(&outcome.new)?, peak(&outcome.worn)?];
    Ok((peaks, equilibria))
}

/// The greater of both relative differences.
fn difference(of: [f64; 2], from: [f64; 2]) -> f64 {
    of.into_iter().zip(from).map(|(a, b)| if b > 0.0 { (a - b).abs() / b } else { 0.0 }).fold(0.0, f64::max)
}

/// Against the elastic half-plane with the same tooth stiffness.
fn half_plane(
    model: &Model<'_>,
    outcome: &Outcome,
    tip_contact: bool,
    budget: f64,
    observer: &dyn Progress,
) -> Result<FromOneMesh, SimulationError> {
    let fine = model.scene.numerics;
    let enough = |by: &usize| fine.flank_points.min(fine.positions) / by >= 2 * LEAST_POINTS;
    let Some(by) = COARSENING.into_iter().find(enough) else {
        return Ok(FromOneMesh::none("too few flank points or positions"));
    };
    let numerics = Numerics { flank_points: fine.flank_points / by, positions: fine.positions / by, ..fine };
    let own_cost = relative_cost(model.scene.contact.surface);
    let weight = relative_cost(SurfaceKind::HalfSpace) / own_cost;
    let cost = |own: u64, truer: u64| (own as f64 + weight * truer as f64) / outcome.work.equilibria as f64;
    let expected = 2 * numerics.positions as u64;
    if cost(expected, expected) > budget {
        return Ok(FromOneMesh::none("the run is too short for one mesh on an elastic half-plane to be cheap beside it"));
    }
    let surface =
        HalfSpace { material: model.scene.material, expected_line_load_n_per_mm: model.line_load_n_per_mm };
    let teeth = TeethSpring::new(
        model.scene.stiffness,
        model.stiffness_curve,
        model.pair,
        &model.scene.material,
        &surface,
        model.line_load_n_per_mm,
    );
    let contact = MeshContact::LineOfAction { surface: &surface, teeth: &teeth, tip_contact };
    let own = WearRun { numerics, ..model.wear_run() };
    let observer = Companion { observer, share: (0.9, 0.1) };
    let (own_mm, own_equilibria) = peaks_mm(&own, outcome, &observer)?;
    let (truer_mm, truer_equilibria) = peaks_mm(&WearRun { contact, ..own }, outcome, &observer)?;
    Ok(FromOneMesh {
        estimate: Estimate {
            relative: Some(difference(own_mm, truer_mm)),
            how: format!(
                "greatest depth of one mesh on the unworn and on the worn flanks against that on an elastic half-plane, {} \
                 flank points, {} positions; the half-plane stands in for finite elements, tooth stiffness and contact \
                 outside the line of action are not judged",
                numerics.flank_points, numerics.positions
            ),
        },
        cost: cost(own_equilibria, truer_equilibria),
    })
}

/// Against elements twice as long.
fn elements(
    model: &Model<'_>,
    outcome: &Outcome,
    coarse: &CondensedPair<'_>,
    observer: &dyn Progress,
) -> Result<FromOneMesh, SimulationError> {
    let greatest = |depth: &PerGear<Vec<f64>>| depth.pinion.iter().copied().fold(0.0, f64::max);
    let own_mm = [&outcome.new, &outcome.worn].map(|state| greatest(&state.depth_per_mesh_mm));
    let run = WearRun { contact: MeshContact::FiniteElements(coarse), ..model.wear_run() };
    let (coarse_mm, equilibria) = peaks_mm(&run, outcome, &Companion { observer, share: (0.9, 0.1) })?;
    Ok(FromOneMesh {
        estimate: Estimate {
            relative: Some(difference(coarse_mm, own_mm) / 3.0),
            how: "the surface is the finite-element one: Richardson, second order, from the greatest depth of one mesh on the \
                  unworn and on the worn flanks with elements twice as long"
                .to_owned(),
        },
        cost: equilibria as f64 / outcome.work.equilibria as f64,
    })
}
