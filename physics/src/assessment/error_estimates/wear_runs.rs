//! Discretisation and wear step, from coarser wear runs.
//!
//! On the line of action two companions take an eighth of the wear steps S (on elastic half-planes, where short waves of wear
//! bound the step, a quarter); one of them also half of the flank points and positions N. With the orders that the methods
//! have (Euler: first in the step; flank and path of contact: second in their spacing, first with the discontinuous pressure
//! of `hertz-mean` and with slices, of which the latter companion has half as many too: the greatest depth lies at the outermost one,
//! which moves outwards, or where a line of contact ends),
//!
//! ```text
//! wear step        |h(N, S) − h(N, S/8)| / (8 − 1) / h
//! discretisation   |h(N, S/8) − h(N/2, S/8)| / (2ᵖ − 1) / h
//! ```
//!
//! The greatest depth lies on a curve that coarse points cut now here, now there. So that an estimate does not vanish where one
//! difference happens to change its sign, it is the larger of the pinion's and the wheel's.
//!
//! Adaptive steps estimate their own error: what they have accumulated where the wear is greatest. They need no companion for it,
//! and as their companions may have the same steps, a quarter of the points and positions gives the discretisation by itself,
//!
//! ```text
//! discretisation   |h(N) − h(N/4)| / (4ᵖ − 1) / h
//! ```
//!
//! with the same tolerance. On finite elements, whose nodes wear and whose positions follow the width of contact, the difference to the verification on
//! another mesh takes its place; without a verification there is a companion with fewer positions at tip edges. Where wear is severe there is no such
//! estimate: with fewer positions the transition is coarser, and adaptive steps take several times the work.
//!
//! Source: L. F. Richardson (1911); P. J. Roache, *Verification and Validation in Computational Science* (1998).

use super::{ErrorEstimate, LEAST_POINTS, greatest_difference, peak_wear_of_both_mm};
use crate::assessment::RunModel;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::observer::{Observer, PartOf};
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::Numerics;
use crate::simulation::wear_run::{Outcome, RunPhase, SimulationError, WearRun};
use gearwear_bodies::gear::PerGear;

/// Least ratio of two wear steps for an estimate.
const LEAST_STEP_RATIO: f64 = 1.5;

/// Estimates from wear runs, with the cost of these over that of the run.
pub(super) struct FromRuns {
    pub discretisation: ErrorEstimate,
    pub wear_step: ErrorEstimate,
    pub cost: f64,
}

/// Coarsening of a companion run.
#[derive(Clone, Copy)]
struct Coarser {
    /// Divisor of flank points and positions.
    spacing: usize,
    /// Factor of the wear step.
    step: f64,
}

/// Companion runs of one run.
struct CompanionRuns<'a> {
    model: &'a RunModel<'a>,
    observer: &'a dyn Observer,
    /// Half of the slices of a run with slices.
    coarse_slices: Option<&'a SlicedTeeth>,
    /// Wear step of the run over the longest stable one.
    step_over_safe: f64,
    /// Peak wear of the run itself, mm.
    peaks_mm: PerGear<f64>,
    /// Equilibria of the companions so far.
    cost: f64,
}

/// Relative error of the peak wear with how it was obtained, or why it was not.
type Difference = Result<(f64, String), String>;

impl<'a> CompanionRuns<'a> {
    fn numerics(&self, Coarser { spacing, step }: Coarser) -> Numerics {
        let fine = self.model.scene.numerics;
        Numerics {
            flank_points: fine.flank_points / spacing,
            positions: fine.positions / spacing,
            stepping: fine.stepping.coarser(step),
            ..fine
        }
    }

    /// Whether enough points and positions are left.
    fn allow(&self, spacing: usize) -> bool {
        let fine = self.model.scene.numerics;
        fine.flank_points.min(fine.positions) / spacing >= LEAST_POINTS
    }

    /// `contact` with fewer slices where points and positions are fewer.
    fn with_spacing(&self, contact: MeshContact<'a>, spacing: usize) -> MeshContact<'a> {
        match contact {
            MeshContact::LineOfAction { surface, teeth, tip_contact, .. } if spacing > 1 => {
                MeshContact::LineOfAction { surface, teeth, tip_contact, sliced: self.coarse_slices }
            }
            MeshContact::Simplified { material, teeth, sliced } if spacing > 1 => {
                MeshContact::Simplified { material, teeth, sliced: self.coarse_slices.unwrap_or(sliced) }
            }
            other => other,
        }
    }

    /// Whether the error of the spacing is of first order.
    fn first_order(&self) -> bool {
        self.model.scene.contact.surface == SurfaceKind::HertzMean || self.model.sliced.is_some()
    }

    /// Resolutions in words: "750 and 375 flank points, 400 and 200 positions, 20 and 10 slices".
    fn spacings(&self) -> String {
        let (fine, half) = (self.model.scene.numerics, self.numerics(Coarser { spacing: 2, step: 1.0 }));
        let slices = self.model.sliced.zip(self.coarse_slices).map_or_else(String::new, |(fine, half)| {
            format!(", {} and {} slices", fine.settings.count, half.settings.count)
        });
        format!(
            "{} and {} flank points, {} and {} positions{slices}",
            fine.flank_points, half.flank_points, fine.positions, half.positions
        )
    }

    /// Larger of both gears' differences of the peak wear, over that of the run.
    fn relative(&self, one: PerGear<f64>, other: PerGear<f64>) -> f64 {
        greatest_difference(one, other, self.peaks_mm)
    }

    /// Peak wear of both gears by a coarser run, whose work is that from `begin` to `end` of all companions.
    ///
    /// # Errors
    /// Reason why it is not completed.
    fn peaks_mm(&mut self, coarser: Coarser, (begin, end): (f64, f64)) -> Result<PerGear<f64>, String> {
        if !self.allow(coarser.spacing) {
            return Err("too few flank points or positions to leave some out".to_owned());
        }
        if coarser.step * self.step_over_safe > 1.0 {
            return Err(format!(
                "a second run with wear steps {} times as long would be unstable, as they would be longer than the longest stable step",
                coarser.step
            ));
        }
        let numerics = self.numerics(coarser);
        let phases = self.model.phases.iter();
        let phases: Vec<RunPhase<'_>> = phases
            .map(|phase| RunPhase { contact: self.with_spacing(phase.contact, coarser.spacing), ..*phase })
            .collect();
        let run = WearRun { phases: &phases, numerics, snapshots_revolutions: &[], ..self.model.wear_run() };
        let part = PartOf { observer: self.observer, before: begin, share: end - begin, of: 1.0 };
        let outcome = run.run(&part).map_err(|error| failed(&error))?;
        self.cost += outcome.work.equilibria as f64;
        match &outcome.failure {
            Some(error) => Err(failed(error)),
            None => Ok(peak_wear_of_both_mm(self.model, &outcome)),
        }
    }
}

fn failed(error: &SimulationError) -> String {
    format!("a coarser run failed: {error}")
}

impl From<Difference> for ErrorEstimate {
    fn from(difference: Difference) -> Self {
        match difference {
            Ok((relative, how)) => Self { relative: Some(relative), how },
            Err(reason) => Self::none(&reason),
        }
    }
}

/// Estimates from coarser runs.
pub(super) fn estimate<'a>(
    model: &'a RunModel<'a>,
    outcome: &Outcome,
    coarse_slices: Option<&'a SlicedTeeth>,
    step_over_safe: f64,
    is_verified: bool,
    observer: &'a dyn Observer,
) -> FromRuns {
    let peaks_mm = peak_wear_of_both_mm(model, outcome);
    let mut companions = CompanionRuns { model, observer, coarse_slices, step_over_safe, peaks_mm, cost: 0.0 };
    let embedded = outcome.step_error_mm.map(|error_mm| of_the_steps(&companions, error_mm));
    let [discretisation, wear_step] = match embedded {
        Some(embedded) => {
            let first_order = companions.first_order();
            let few = match model.wears_severely(outcome) {
                true => Err("where wear is severe, fewer points take adaptive steps more work and not less".to_owned()),
                false if is_verified && model.scene.contact.surface == SurfaceKind::Fem => {
                    Err("left to the verification on other finite elements".to_owned())
                }
                false => companions.peaks_mm(Coarser { spacing: 4, step: 1.0 }, (0.0, 0.8)),
            };
            let discretisation = few.map(|few| {
                let (order, divisor) = if first_order { ("first", 3.0) } else { ("second", 15.0) };
                let how = format!(
                    "Richardson, {order} order, from a coarser run with one in four of the points and positions"
                );
                (companions.relative(peaks_mm, few) / divisor, how)
            });
            [discretisation, Ok(embedded)]
        }
        None => from_fixed_steps(&mut companions, peaks_mm),
    };
    FromRuns {
        discretisation: discretisation.into(),
        wear_step: wear_step.into(),
        cost: companions.cost / outcome.work.equilibria as f64,
    }
}

/// Error of the wear step of adaptive steps, as they estimated it themselves.
fn of_the_steps(companions: &CompanionRuns<'_>, error_mm: PerGear<f64>) -> (f64, String) {
    (
        companions.relative(error_mm, PerGear::default()),
        "sum of the estimated errors of all adaptive steps, its mean along the flank about the greatest wear"
            .to_owned(),
    )
}

/// Errors of the discretisation and of the wear step of Euler's method.
fn from_fixed_steps(companions: &mut CompanionRuns<'_>, reference: PerGear<f64>) -> [Difference; 2] {
    let surface = companions.model.scene.contact.surface;
    let longest = if surface == SurfaceKind::HalfSpace || surface == SurfaceKind::Fem { 4.0 } else { 8.0 };
    // Where steps eight times as long are unstable, four times as long are dearer but within the budget too.
    let step = if longest * companions.step_over_safe > 1.0 { 4.0 } else { longest };
    let stepped = companions.peaks_mm(Coarser { spacing: 1, step }, (0.0, 0.5));
    let discretisation = stepped.clone().and_then(|stepped| {
        let half = companions.peaks_mm(Coarser { spacing: 2, step }, (0.5, 0.75))?;
        let (order, divisor) = if companions.first_order() { ("first", 1.0) } else { ("second", 3.0) };
        let how = format!("Richardson, {order} order, from coarser runs with {}", companions.spacings());
        Ok((companions.relative(stepped, half) / divisor, how))
    });
    let duration = companions.model.duration();
    let ratio = step.min(duration / companions.model.scene.numerics.stepping.euler_revolutions(duration));
    let wear_step = stepped.and_then(|stepped| {
        if ratio < LEAST_STEP_RATIO {
            return Err("the run is hardly longer than one wear step".to_owned());
        }
        let how = format!("Richardson, first order, from a second run with wear steps {step} times as long");
        Ok((companions.relative(reference, stepped) / (ratio - 1.0), how))
    });
    [discretisation, wear_step]
}
