//! Discretisation and wear step, from coarser wear runs.
//!
//! On the line of action two companions take a quarter of the wear steps S; one of them also half of the flank points and
//! positions N. With the orders that the methods have (Euler: first in the step; flank and path of contact: second in their
//! spacing, first with the discontinuous pressure of `hertz-mean`),
//!
//! ```text
//! wear step        |h(N, S) − h(N, S/4)| / (4 − 1) / h
//! discretisation   |h(N, S/4) − h(N/2, S/4)| / (2ᵖ − 1) / h
//! ```
//!
//! On finite elements short waves of wear bound Euler's steps, and a companion on the same mesh M with four times the step
//! may swing. Most companions are therefore on a mesh with elements twice as long, on which an equilibrium takes about half
//! the time and steps may be twice as long; that mesh also tells the error of the size of the elements, which is what the
//! contact surface has of it:
//!
//! ```text
//! wear step        |h(M/2, N/4, S/2) − h(M/2, N/4, S/4)| / 2 / h
//! discretisation   |h(M/2, N, S/4) − h(M/2, N/2, S/4)| / (2² − 1) / h
//! surface model    |h(M, N/4, S/2) − h(M/2, N/4, S/2)| / (2² − 1) / h
//! ```
//!
//! Source: L. F. Richardson (1911); P. J. Roache, *Verification and Validation in Computational Science* (1998).

use super::{Companion, Estimate, LEAST_POINTS, peak_wear_mm};
use crate::contact::settings::SurfaceKind;
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
    /// On finite elements alone.
    pub surface_model: Option<Estimate>,
    pub cost: f64,
}

/// A coarser run in comparison to the run itself.
#[derive(Clone, Copy)]
struct Coarser {
    /// Points and positions are divided by this.
    spacing: usize,
    /// The wear step is multiplied by this.
    step: f64,
}

/// Runs companions of one run.
struct Companions<'a> {
    model: &'a Model<'a>,
    operation: Operation,
    observer: &'a dyn Progress,
    /// Cost so far, in equilibria of the run itself.
    cost: f64,
}

/// Error of the peak wear in mm with how it was obtained, or why it was not.
type Difference = Result<(f64, String), String>;

impl<'a> Companions<'a> {
    fn numerics(&self, Coarser { spacing, step }: Coarser) -> Numerics {
        let fine = self.model.scene.numerics;
        Numerics {
            flank_points: fine.flank_points / spacing,
            positions: fine.positions / spacing,
            step_revolutions: step * fine.step_revolutions,
            ..fine
        }
    }

    /// Whether so few points and positions can still say something.
    fn allow(&self, spacing: usize) -> bool {
        let fine = self.model.scene.numerics;
        fine.flank_points.min(fine.positions) / spacing >= LEAST_POINTS
    }

    /// "750 and 375 flank points, 400 and 200 positions".
    fn spacings(&self) -> String {
        let (fine, half) = (self.model.scene.numerics, self.numerics(Coarser { spacing: 2, step: 1.0 }));
        format!(
            "{} and {} flank points, {} and {} positions",
            fine.flank_points, half.flank_points, fine.positions, half.positions
        )
    }

    /// The pinion's peak wear by a coarser run on `contact`, an equilibrium of which costs `weight`; where it does not come to
    /// its end, why. Companions from `begin` on are still to come, as a share of all their work.
    fn peak_mm(
        &mut self,
        coarser: Coarser,
        (contact, weight): (MeshContact<'a>, f64),
        (begin, end): (f64, f64),
    ) -> Result<f64, String> {
        if !self.allow(coarser.spacing) {
            return Err("too few flank points or positions to leave some out".to_owned());
        }
        let numerics = self.numerics(coarser);
        let run = WearRun { contact, numerics, operation: &self.operation, ..self.model.wear_run() };
        let failed = |error: SimulationError| format!("a companion run failed: {error}");
        let share = (begin, end - begin);
        let outcome = run.run(&Companion { observer: self.observer, share }).map_err(failed)?;
        self.cost += weight * outcome.work.equilibria as f64;
        match outcome.failure.clone() {
            Some(error) => Err(failed(error)),
            None => Ok(peak_wear_mm(self.model, &outcome)),
        }
    }
}

/// Estimates from coarser runs; `coarse_elements` are those of a run on finite elements.
pub(super) fn estimate<'a>(
    model: &'a Model<'a>,
    outcome: &Outcome,
    coarse_elements: Option<&'a CondensedPair<'a>>,
    observer: &'a dyn Progress,
) -> FromRuns {
    let operation = Operation { snapshots_revolutions: Vec::new(), ..model.scene.operation.clone() };
    let mut companions = Companions { model, operation, observer, cost: 0.0 };
    let reference_mm = peak_wear_mm(model, outcome);
    // Where nothing wears there is nothing to be wrong about.
    let relative = |difference: f64| if reference_mm > 0.0 { difference.abs() / reference_mm } else { 0.0 };
    let estimate = |difference: Difference| match difference {
        Ok((difference_mm, how)) => Estimate { relative: Some(relative(difference_mm)), how },
        Err(reason) => Estimate::none(&reason),
    };
    let ([discretisation, wear_step], surface_model) = match (model.contact, coarse_elements) {
        (MeshContact::LineOfAction { .. }, _) => (on_the_line_of_action(&mut companions, reference_mm), None),
        (MeshContact::FiniteElements(_), Some(coarse)) => {
            let [discretisation, wear_step, elements] = on_finite_elements(&mut companions, coarse);
            ([discretisation, wear_step], Some(elements))
        }
        (MeshContact::FiniteElements(_), None) => {
            let reason = || Err("the elements cannot be made twice as long".to_owned());
            ([reason(), reason()], Some(reason()))
        }
    };
    FromRuns {
        discretisation: estimate(discretisation),
        wear_step: estimate(wear_step),
        surface_model: surface_model.map(estimate),
        cost: companions.cost / outcome.work.equilibria as f64,
    }
}

/// Discretisation and wear step.
fn on_the_line_of_action(companions: &mut Companions<'_>, reference_mm: f64) -> [Difference; 2] {
    let own = (companions.model.contact, 1.0);
    let stepped = companions.peak_mm(Coarser { spacing: 1, step: 4.0 }, own, (0.0, 0.6));
    let discretisation = stepped.clone().and_then(|stepped| {
        let spaced = companions.peak_mm(Coarser { spacing: 2, step: 4.0 }, own, (0.6, 0.9))?;
        let (order, divisor) = match companions.model.scene.contact.surface {
            SurfaceKind::HertzMean => ("first", 1.0),
            _ => ("second", 3.0),
        };
        let how = format!("Richardson, {order} order, from companion runs with {}", companions.spacings());
        Ok(((stepped - spaced) / divisor, how))
    });
    let how = "Richardson, first order, from a companion run with wear steps four times as long";
    [discretisation, stepped.map(|stepped| ((reference_mm - stepped) / 3.0, how.to_owned()))]
}

/// Discretisation, wear step, and size of the elements.
fn on_finite_elements<'a>(companions: &mut Companions<'a>, coarse: &'a CondensedPair<'a>) -> [Difference; 3] {
    let (own, coarse) = ((companions.model.contact, 1.0), (MeshContact::FiniteElements(coarse), COST_ON_COARSE_MESH));
    let on_mesh = "on a mesh with elements twice as long";
    let few = if companions.allow(4) { 4 } else { 2 };
    let points = format!("one in {few} of the points and positions");

    let short = companions.peak_mm(Coarser { spacing: few, step: 2.0 }, coarse, (0.0, 0.15));
    let wear_step = short.clone().and_then(|short| {
        let long = companions.peak_mm(Coarser { spacing: few, step: 4.0 }, coarse, (0.15, 0.22))?;
        let how = format!(
            "Richardson, first order, from companion runs with wear steps twice and four times as long, {points}, {on_mesh}"
        );
        Ok(((short - long) / 2.0, how))
    });
    let elements = short.and_then(|short| {
        let fine = companions.peak_mm(Coarser { spacing: few, step: 2.0 }, own, (0.22, 0.55))?;
        let how = format!(
            "the surface is the finite-element one, whose error is the size of its elements: Richardson, second order, from \
             companion runs with {points} and wear steps twice as long, on this mesh and {on_mesh}"
        );
        Ok(((fine - short) / 3.0, how))
    });
    let discretisation = companions.peak_mm(Coarser { spacing: 1, step: 4.0 }, coarse, (0.55, 0.85)).and_then(|fine| {
        let half = companions.peak_mm(Coarser { spacing: 2, step: 4.0 }, coarse, (0.85, 1.0))?;
        let how = format!("Richardson, second order, from companion runs with {} {on_mesh}", companions.spacings());
        Ok(((fine - half) / 3.0, how))
    });
    [discretisation, wear_step, elements]
}
