//! Discretisation and wear step, from coarser wear runs.
//!
//! On the line of action two companions take a quarter of the wear steps S; one of them also half of the flank points and
//! positions N. Their cost is 1/4 + 1/16·… of the run. With the orders that the methods have (Euler: first in the step;
//! flank and path of contact: second in their spacing),
//!
//! ```text
//! wear step        |h(N, S) − h(N, S/4)| / (4 − 1) / h
//! discretisation   |h(N, S/4) − h(N/2, S/4)| / (4 − 1) / h
//! ```
//!
//! On finite elements short waves of wear bound Euler's steps, and a companion on the same mesh M with four times the step
//! may swing. All three companions are therefore on a mesh with elements twice as long, on which an equilibrium takes about
//! half the time and steps may be twice as long:
//!
//! ```text
//! wear step        |h(M/2, N/2, S/2) − h(M/2, N/2, S/4)| / 2 / h
//! discretisation   |h(M/2, N, S/4) − h(M/2, N/2, S/4)| / (4 − 1) / h
//! ```
//!
//! Source: L. F. Richardson (1911); P. J. Roache, *Verification and Validation in Computational Science* (1998).

use super::{Companion, Estimate, LEAST_POINTS, peak_wear_mm};
use crate::fem::gear::position::CondensedPair;
use crate::pipeline::Model;
use crate::simulation::settings::{Numerics, Operation};
use crate::simulation::wear_run::{MeshContact, Outcome, Progress, SimulationError, WearRun};

/// Cost of an equilibrium on finite elements twice as long.
const COST_ON_COARSE_MESH: f64 = 0.5;

/// What the wear runs say, and their cost over that of the run.
pub(super) struct FromRuns {
    pub discretisation: Estimate,
    pub wear_step: Estimate,
    pub cost: f64,
}

/// A coarser run in comparison to the run itself.
#[derive(Clone, Copy)]
struct Coarser {
    spacing: usize,
    step: f64,
}

/// Runs companions of one run.
struct Companions<'a> {
    model: &'a Model<'a>,
    contact: MeshContact<'a>,
    operation: Operation,
    observer: &'a dyn Progress,
    equilibria: u64,
}

impl Companions<'_> {
    /// The peak wear with half of the points and positions, where enough are left.
    fn halved(&mut self, share: (f64, f64)) -> Result<f64, String> {
        let numerics = self.numerics(HALF_SPACING);
        if numerics.flank_points.min(numerics.positions) < LEAST_POINTS {
            return Err("too few flank points or positions to halve".to_owned());
        }
        self.peak_mm(HALF_SPACING, share)
    }

    /// "750 and 375 flank points, 400 and 200 positions".
    fn spacings(&self) -> String {
        let (fine, half) = (self.model.scene.numerics, self.numerics(HALF_SPACING));
        format!(
            "{} and {} flank points, {} and {} positions",
            fine.flank_points, half.flank_points, fine.positions, half.positions
        )
    }

    fn numerics(&self, Coarser { spacing, step }: Coarser) -> Numerics {
        let fine = self.model.scene.numerics;
        Numerics {
            flank_points: fine.flank_points / spacing,
            positions: fine.positions / spacing,
            step_revolutions: step * fine.step_revolutions,
            ..fine
        }
    }

    /// The pinion's peak wear by a coarser run, which is this share of the companions' work; where it does not come to its end,
    /// why.
    fn peak_mm(&mut self, coarser: Coarser, share: (f64, f64)) -> Result<f64, String> {
        let numerics = self.numerics(coarser);
        let run = WearRun { contact: self.contact, numerics, operation: &self.operation, ..self.model.wear_run() };
        let failed = |error: SimulationError| format!("a companion run failed: {error}");
        let outcome = run.run(&Companion { observer: self.observer, share }).map_err(failed)?;
        self.equilibria += outcome.work.equilibria;
        match outcome.failure.clone() {
            Some(error) => Err(failed(error)),
            None => Ok(peak_wear_mm(self.model, &outcome)),
        }
    }
}

/// Estimates both from coarser runs; `coarse_elements` are those of a run on finite elements.
pub(super) fn estimate(
    model: &Model<'_>,
    outcome: &Outcome,
    coarse_elements: Option<&CondensedPair<'_>>,
    observer: &dyn Progress,
) -> FromRuns {
    let operation = Operation { snapshots_revolutions: Vec::new(), ..model.scene.operation.clone() };
    let contact = coarse_elements.map_or(model.contact, MeshContact::FiniteElements);
    let mut companions = Companions { model, contact, operation, observer, equilibria: 0 };
    let reference = peak_wear_mm(model, outcome);
    // Where nothing wears there is nothing to be wrong about.
    let relative = |difference: f64| if reference > 0.0 { difference.abs() / reference } else { 0.0 };
    let found = match (model.contact, coarse_elements) {
        (MeshContact::LineOfAction { .. }, _) => on_the_line_of_action(&mut companions, reference),
        (MeshContact::FiniteElements(_), Some(_)) => on_finite_elements(&mut companions),
        (MeshContact::FiniteElements(_), None) => {
            let reason = || Err("the elements cannot be made twice as long".to_owned());
            Differences { discretisation: reason(), wear_step: reason() }
        }
    };
    let weight = if coarse_elements.is_some() { COST_ON_COARSE_MESH } else { 1.0 };
    let estimate = |difference: Result<(f64, String), String>| match difference {
        Ok((difference_mm, how)) => Estimate { relative: Some(relative(difference_mm)), how },
        Err(reason) => Estimate::none(&reason),
    };
    FromRuns {
        discretisation: estimate(found.discretisation),
        wear_step: estimate(found.wear_step),
        cost: weight * companions.equilibria as f64 / outcome.work.equilibria as f64,
    }
}

/// Errors of the peak wear in mm, each with how it was obtained, or why it was not.
struct Differences {
    discretisation: Result<(f64, String), String>,
    wear_step: Result<(f64, String), String>,
}

const LONG_STEPS: Coarser = Coarser { spacing: 1, step: 4.0 };
const HALF_SPACING: Coarser = Coarser { spacing: 2, step: 4.0 };

fn on_the_line_of_action(companions: &mut Companions<'_>, reference_mm: f64) -> Differences {
    let stepped = companions.peak_mm(LONG_STEPS, (0.0, 0.7));
    let discretisation = stepped.clone().and_then(|stepped| {
        let spaced = companions.halved((0.7, 0.2))?;
        let how = format!("Richardson, second order, from companion runs with {}", companions.spacings());
        Ok(((stepped - spaced) / 3.0, how))
    });
    let how = "Richardson, first order, from a companion run with wear steps four times as long";
    Differences { discretisation, wear_step: stepped.map(|stepped| ((reference_mm - stepped) / 3.0, how.to_owned())) }
}

fn on_finite_elements(companions: &mut Companions<'_>) -> Differences {
    let on_mesh = "on a mesh with elements twice as long";
    let long = companions.halved((0.0, 0.2));
    let wear_step = long.clone().and_then(|long| {
        let short = companions.peak_mm(Coarser { spacing: 2, step: 2.0 }, (0.2, 0.35))?;
        let how = format!(
            "Richardson, first order, from companion runs with wear steps twice and four times as long, half of the points \
             and positions, {on_mesh}"
        );
        Ok(((short - long) / 2.0, how))
    });
    let discretisation = long.and_then(|long| {
        let fine = companions.peak_mm(LONG_STEPS, (0.55, 0.35))?;
        let how = format!("Richardson, second order, from companion runs with {} {on_mesh}", companions.spacings());
        Ok(((fine - long) / 3.0, how))
    });
    Differences { discretisation, wear_step }
}
