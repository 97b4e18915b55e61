//! The parameters with which the simulated profile fits the measured one best.
//!
//! ```text
//! r = P [z − z₀(s + d) + h(s + d; κ k, C)]
//! ```
//!
//! with the measured heights z at arc lengths s, the unworn flank z₀, the simulated wear depth h, the projection P that removes
//! the form, and as parameters, where they are asked for, ln κ and ln C, the logarithms of the factor on the wear coefficient and of
//! the factor of severe wear, and the shift d along the flank. |r|² is least over profiles interpolated between runs
//! ([`Simulations::about`]); then runs with just the parameters found take the place of the interpolation, and Gauss–Newton
//! steps on their residuals go on until they no longer matter. The result is that of the exact runs, the best of them; only the
//! derivatives are interpolated. Where wear does not change smoothly with the coefficient (an abrupt transition to severe wear, wear steps
//! beyond the stable one), exact runs scatter: steps of up to half a standard deviation are then left, and reported.

use super::question::Question;
use super::simulations::{Change, CompareError, Simulations};
use crate::gear::GearPair;
use crate::measurement::fit::{FitStop, Parameter, gauss_newton_step, least_squares};
use crate::measurement::form::FormRemoval;
use crate::measurement::interval::{Uncertainty, uncertainty};

/// The factor on the wear coefficient lies between this and its inverse.
const LEAST_FACTOR: f64 = 1e-3;
/// Greatest factor of severe wear; the least is 1.
const MOST_SEVERE: f64 = 1e4;
/// Differences of logarithms.
const LOG_WIDTH: f64 = 0.02;
/// Differences of the shift, mm.
const SHIFT_WIDTH_MM: f64 = 5e-3;
/// Shifts tried to begin with, to either side.
const SHIFTS_TRIED: i32 = 15;
/// A step shorter than this part of a parameter's standard deviation no longer matters.
const NEGLIGIBLE: f64 = 0.02;
/// One shorter than this part of it is left where exact runs go on to scatter.
const TOLERABLE: f64 = 0.5;
/// Nor does one shorter than this part of the width of its differences.
const SMALL_STEP: f64 = 5e-3;
/// Most exact runs at the end.
const MOST_EXACT_RUNS: usize = 6;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unknown {
    /// ln κ.
    Coefficient,
    /// ln C.
    Severe,
    /// d, mm.
    Shift,
}

/// Measured heights, and what is compared with them.
pub(super) struct Comparison<'a> {
    question: &'a Question,
    pair: &'a GearPair,
    removal: FormRemoval,
    /// Arc length of each point of the wear profiles.
    grid_arc_mm: Vec<f64>,
    /// P z.
    pub measured_um: Vec<f64>,
}

/// What the search found.
pub(super) struct FittedCoefficients {
    pub unknowns: Vec<Unknown>,
    parameters: Vec<f64>,
    pub stop: FitStop,
    /// Which is to blame, where one is.
    pub blamed: Option<Unknown>,
    /// What the residuals say; `None` where nothing was fitted or too few points count.
    pub uncertainty: Option<Uncertainty>,
    /// Wear depth of the row of flank points.
    pub wear_um: Vec<f64>,
    /// The last step in standard deviations, where exact runs still ask for one.
    pub unsettled: Option<f64>,
}

impl FittedCoefficients {
    /// The value of a parameter and half the width of its interval.
    pub(super) fn of(&self, unknown: Unknown) -> Option<(f64, Option<f64>)> {
        let index = self.unknowns.iter().position(|&own| own == unknown)?;
        Some((self.parameters[index], self.uncertainty.as_ref().map(|u| u.half_widths[index])))
    }

    /// The shift, mm.
    pub(super) fn shift_mm(&self) -> f64 {
        self.of(Unknown::Shift).map_or(0.0, |(shift, _)| shift)
    }
}

impl<'a> Comparison<'a> {
    /// Of what `question` asks, with wear profiles at points of these arc lengths.
    pub(super) fn new(question: &'a Question, pair: &'a GearPair, grid_arc_mm: Vec<f64>) -> Self {
        let removal = FormRemoval::new(question.form, &question.profile.arc_mm);
        let mut measured_um = question.profile.height_um.clone();
        removal.remove(&mut measured_um);
        Self { question, pair, removal, grid_arc_mm, measured_um }
    }

    /// Wear depth at the measured points, shifted.
    pub(super) fn wear_at_points_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let grid = &self.grid_arc_mm;
        let at = |&arc: &f64| {
            let after = grid.partition_point(|&s| s <= arc + shift_mm).clamp(1, grid.len() - 1);
            let t = ((arc + shift_mm - grid[after - 1]) / (grid[after] - grid[after - 1])).clamp(0.0, 1.0);
            wear_um[after - 1] + t * (wear_um[after] - wear_um[after - 1])
        };
        self.question.profile.arc_mm.iter().map(at).collect()
    }

    /// P (z₀ − h): the simulated profile, form removed.
    pub(super) fn simulated_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let mut heights = self.question.profile.unworn_um(self.pair, shift_mm);
        let wear = self.wear_at_points_um(wear_um, shift_mm);
        heights.iter_mut().zip(&wear).for_each(|(height, wear)| *height -= wear);
        self.removal.remove(&mut heights);
        heights
    }

    /// r.
    pub(super) fn residuals_um(&self, wear_um: &[f64], shift_mm: f64) -> Vec<f64> {
        let simulated = self.simulated_um(wear_um, shift_mm);
        self.measured_um.iter().zip(simulated).map(|(measured, simulated)| measured - simulated).collect()
    }

    /// The shift with which `wear_um`, times a factor where that is open, fits best, and that factor.
    fn begin(&self, wear_um: &[f64], factor_is_open: bool) -> (f64, f64) {
        let within = self.question.shift_within_mm;
        let tried = if within > 0.0 { SHIFTS_TRIED } else { 0 };
        let nothing = vec![0.0; wear_um.len()];
        let mut best = (f64::INFINITY, 0.0, 1.0);
        for step in -tried..=tried {
            let shift = within * f64::from(step) / f64::from(tried.max(1));
            // r = a + κ b: with nothing worn, and what the wear adds.
            let (a, whole) = (self.residuals_um(&nothing, shift), self.residuals_um(wear_um, shift));
            let b: Vec<f64> = whole.iter().zip(&a).map(|(w, a)| w - a).collect();
            let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
            let factor = match factor_is_open {
                true => (-dot(&a, &b) / dot(&b, &b)).clamp(LEAST_FACTOR, 1.0 / LEAST_FACTOR),
                false => 1.0,
            };
            let factor = if factor.is_finite() { factor } else { 1.0 };
            let square = dot(&a, &a) + 2.0 * factor * dot(&a, &b) + factor * factor * dot(&b, &b);
            // Of equals, the least shift.
            if square < best.0 * (1.0 - 1e-12) || square <= best.0 && shift.abs() < f64::abs(best.1) {
                best = (square, shift, factor);
            }
        }
        (best.1, best.2)
    }

    /// The parameters that fit best, beginning with the run's own wear.
    pub(super) fn search(
        &self,
        as_run_um: &[f64],
        simulations: &mut Simulations<'_>,
    ) -> Result<FittedCoefficients, CompareError> {
        let (fit, within) = (self.question.fit, self.question.shift_within_mm);
        let (shift, factor) = self.begin(as_run_um, fit.coefficient());
        let mut unknowns = Vec::new();
        let mut parameters = Vec::new();
        let mut add = |unknown, parameter| {
            unknowns.push(unknown);
            parameters.push(parameter);
        };
        let most = -LEAST_FACTOR.ln();
        if fit.coefficient() {
            let parameter = Parameter { start: factor.ln(), least: -most, greatest: most, width: LOG_WIDTH };
            add(Unknown::Coefficient, parameter);
        }
        if fit.severe() {
            let start = simulations.severe_factor().ln();
            add(Unknown::Severe, Parameter { start, least: 0.0, greatest: MOST_SEVERE.ln(), width: LOG_WIDTH });
        }
        if within > 0.0 {
            let parameter = Parameter { start: shift, least: -within, greatest: within, width: SHIFT_WIDTH_MM };
            add(Unknown::Shift, parameter);
        }
        let needs_runs = fit.coefficient() || fit.severe();
        let mut residuals = |theta: &[f64]| {
            let wear_um = match needs_runs {
                true => simulations.about(change(&unknowns, theta))?,
                false => as_run_um.to_vec(),
            };
            Ok(self.residuals_um(&wear_um, shift_of(&unknowns, theta)))
        };
        let fitted = least_squares::<CompareError>(&parameters, &mut residuals)?;
        let also = self.question.form.parameters();
        let mut found = FittedCoefficients {
            blamed: fitted.blamed.map(|index| unknowns[index]),
            uncertainty: uncertainty(&fitted.jacobian, &fitted.residuals, also),
            wear_um: as_run_um.to_vec(),
            stop: fitted.stop,
            unsettled: None,
            parameters: fitted.parameters,
            unknowns,
        };
        if needs_runs {
            self.settle(&mut found, &parameters, &fitted.jacobian, simulations)?;
        }
        // Beside the best value that was searched no interval means anything.
        found.uncertainty = found.uncertainty.filter(|_| found.stop == FitStop::Converged);
        Ok(found)
    }

    /// Gauss–Newton steps on the residuals of exact runs, until they no longer matter.
    fn settle(
        &self,
        found: &mut FittedCoefficients,
        parameters: &[Parameter],
        jacobian: &[Vec<f64>],
        simulations: &mut Simulations<'_>,
    ) -> Result<(), CompareError> {
        let mut theta = found.parameters.clone();
        let converges = found.stop == FitStop::Converged;
        let also = self.question.form.parameters();
        let mut least: Option<f64> = None;
        let mut last_step = 0.0;
        for _ in 0..MOST_EXACT_RUNS {
            let wear_um = simulations.exactly(change(&found.unknowns, &theta))?;
            let r = self.residuals_um(&wear_um, shift_of(&found.unknowns, &theta));
            let square: f64 = r.iter().map(|r| r * r).sum();
            let step = converges.then(|| gauss_newton_step(jacobian, &r)).flatten();
            let uncertainty = uncertainty(jacobian, &r, also);
            let deviations = uncertainty.as_ref().map(|u| u.deviations.clone());
            if least.is_none_or(|least| square < least) {
                least = Some(square);
                found.parameters.clone_from(&theta);
                (found.wear_um, found.uncertainty) = (wear_um, uncertainty);
            }
            let Some(step) = step else { break };
            // Steps in standard deviations; those that are nothing beside the differences count for nothing.
            last_step = (0..step.len())
                .filter(|&i| step[i].abs() > SMALL_STEP * parameters[i].width)
                .map(|i| step[i].abs() / deviations.as_ref().map_or(0.0, |all| all[i]))
                .fold(0.0, f64::max);
            if last_step <= NEGLIGIBLE {
                break;
            }
            for ((value, by), p) in theta.iter_mut().zip(&step).zip(parameters) {
                *value = (*value + by).clamp(p.least, p.greatest);
            }
        }
        if converges && last_step > NEGLIGIBLE {
            found.unsettled = Some(last_step);
            found.stop = if last_step <= TOLERABLE { FitStop::Converged } else { FitStop::MaxIterations };
        }
        Ok(())
    }
}

/// The change of the scene that the parameters stand for.
fn change(unknowns: &[Unknown], theta: &[f64]) -> Change {
    let value = |unknown| unknowns.iter().position(|&own| own == unknown).map(|index| theta[index]);
    Change {
        coefficient_factor: value(Unknown::Coefficient).map_or(1.0, f64::exp),
        severe_factor: value(Unknown::Severe).map(f64::exp),
    }
}

fn shift_of(unknowns: &[Unknown], theta: &[f64]) -> f64 {
    unknowns.iter().position(|&own| own == Unknown::Shift).map_or(0.0, |index| theta[index])
}
