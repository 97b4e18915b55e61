//! The parameters with which the simulated profiles fit the measured ones best.
//!
//! ```text
//! χ² = Σ w_p² |r_p|²,          r_p = P [z − z₀(s + d_p) + h(s + d_p; κ k, C)]
//! ```
//!
//! with the residuals r_p of each profile ([`Comparison`]). Parameters, where they are fitted: ln κ, the logarithm of the factor on the wear
//! coefficient (one for each gear where both are fitted); ln C, that of the factor of severe wear; d_p, the shift of each profile along its flank. Of
//! several profiles each has the weight w_p = 1/σ_p, with the standard deviation σ_p of its residuals when it is fitted alone, times the root of the
//! number of points that are correlated ([`crate::measurement::interval`]). Waves that are found in the residuals of that fit are fitted along
//! ([`crate::measurement::waviness`]). χ² is minimised over profiles interpolated between runs
//! ([`Simulations::about`]), then by Gauss–Newton steps on the residuals of exact runs until convergence. The result is the best exact run; the
//! derivatives are those of the interpolation, updated after each exact run (Broyden). Where wear is not a smooth function of the coefficient (an
//! abrupt transition to severe wear, wear steps beyond the stable one), exact runs scatter: steps of up to half a standard deviation then remain, and
//! are reported.

use super::comparison::{Beginning, Comparison, root_mean_square};
use super::question::{ComparisonQuestion, FitKind, FittedGears};
use super::simulations::{CoefficientChange, CompareError, Simulations};
use super::unknown::Unknown;
use crate::measurement::fit::{FitStop, Parameter, broyden_update, gauss_newton_step, least_squares};
use crate::measurement::form::FormRemoval;
use crate::measurement::interval::{FitUncertainty, ProfilePart, uncertainty};
use crate::measurement::waviness::{self, Wave};
use gearwear_bodies::gear::{Gear, PerGear};

/// Least factor on the wear coefficient.
const LEAST_FACTOR: f64 = 1e-3;
/// Greatest factor of severe wear; the least is 1.
const MOST_SEVERE: f64 = 1e4;
/// Width of the finite differences of logarithms.
const LOG_WIDTH: f64 = 0.02;
/// Width of the finite differences of the shift, mm.
const SHIFT_WIDTH_MM: f64 = 5e-3;
/// Step, in standard deviations of a parameter, below which the search has converged.
const NEGLIGIBLE: f64 = 0.02;
/// The same of a fit that is made again.
const NEGLIGIBLE_AGAIN: f64 = 0.1;
/// Step, in standard deviations, that is accepted where the scatter of exact runs prevents a shorter one.
const TOLERABLE: f64 = 0.5;
/// Step, in widths of the finite differences, below which the search has converged.
const SMALL_STEP: f64 = 5e-3;
/// Greatest number of exact runs at the end.
const MOST_EXACT_RUNS: usize = 6;
/// Least scatter of a profile for its weight, µm.
const LEAST_SCATTER_UM: f64 = 1e-6;

/// Result of the search.
#[derive(Clone)]
pub(super) struct FittedCoefficients {
    pub unknowns: Vec<Unknown>,
    parameters: Vec<f64>,
    pub stop: FitStop,
    /// Coefficient that kept the search from converging.
    pub blamed: Option<Unknown>,
    /// Uncertainty from the residuals; `None` where nothing was fitted or too few points count.
    pub uncertainty: Option<FitUncertainty>,
    /// Wear depth of the flank points of each profile.
    pub wear_um: Vec<Vec<f64>>,
    /// Waves of each profile that are fitted along.
    pub waves: Vec<Vec<Wave>>,
    /// Last step in standard deviations, where it is above the limit of convergence.
    pub unsettled: Option<f64>,
    /// Derivatives of the residuals, parameter by parameter.
    jacobian: Vec<Vec<f64>>,
    bounds: Vec<Parameter>,
    weights: Vec<f64>,
    removals: Vec<FormRemoval>,
}

impl FittedCoefficients {
    fn index(&self, unknown: Unknown) -> Option<usize> {
        self.unknowns.iter().position(|&own| own == unknown)
    }

    /// The value of a parameter and half the width of its interval.
    pub(super) fn of(&self, unknown: Unknown) -> Option<(f64, Option<f64>)> {
        let index = self.index(unknown)?;
        Some((self.parameters[index], self.uncertainty.as_ref().map(|u| u.half_widths[index])))
    }

    /// Difference of two parameters and half the width of its interval.
    pub(super) fn difference(&self, one: Unknown, other: Unknown) -> Option<(f64, Option<f64>)> {
        let (i, j) = (self.index(one)?, self.index(other)?);
        let half_width = self.uncertainty.as_ref().map(|u| u.half_width_of_difference(i, j));
        Some((self.parameters[i] - self.parameters[j], half_width))
    }
}

/// Function that gives the wear of the flank points of each profile for some parameters.
type Wear<'a, S> = dyn FnMut(&S, &[f64]) -> Result<Vec<Vec<f64>>, CompareError> + 'a;

/// Measured profiles, and how their parameters are found.
pub(super) struct CoefficientSearch<'a> {
    question: &'a ComparisonQuestion,
    comparisons: &'a [Comparison<'a>],
    unknowns: Vec<Unknown>,
    /// w_p.
    weights: Vec<f64>,
    /// Removal of the form of each profile and of its waves.
    removals: Vec<FormRemoval>,
    /// Waves of each profile.
    waves: Vec<Vec<Wave>>,
}

impl<'a> CoefficientSearch<'a> {
    /// Search for the parameters of `question`, with a comparison for each of its profiles.
    pub(super) fn new(question: &'a ComparisonQuestion, comparisons: &'a [Comparison<'a>]) -> Self {
        let mut unknowns = Vec::new();
        match question.fit {
            FitKind::Each => unknowns.extend(Gear::BOTH.map(|gear| Unknown::Coefficient(Some(gear)))),
            fit if fit.coefficient() => unknowns.push(Unknown::Coefficient(None)),
            _ => {}
        }
        if question.fit.severe() {
            unknowns.push(Unknown::Severe);
        }
        if question.shift_within_mm > 0.0 {
            unknowns.extend(comparisons.iter().map(|one| question.shift_of(one.of.profile.gear)));
        }
        let removals = comparisons.iter().map(|one| one.removal.clone()).collect();
        let (weights, waves) = (vec![1.0; comparisons.len()], vec![Vec::new(); comparisons.len()]);
        Self { question, comparisons, unknowns, weights, removals, waves }
    }

    /// Parameters of the best fit, starting from the run's own wear.
    pub(super) fn run(
        mut self,
        as_run_um: &[Vec<f64>],
        simulations: &mut Simulations<'_>,
    ) -> Result<FittedCoefficients, CompareError> {
        let fit = self.question.fit;
        let most: Vec<f64> =
            self.comparisons.iter().zip(as_run_um).map(|(one, wear)| one.greatest_factor(wear)).collect();
        let begun = self.comparisons.iter().zip(as_run_um).zip(&most).map(|((one, wear), &most)| {
            one.begin(wear, self.question.shift_within_mm, fit.coefficient().then_some([LEAST_FACTOR, most]))
        });
        let begun: Vec<Beginning> = begun.collect();
        let mut parameters = self.parameters(&begun, &most, simulations.severe_factor());
        let needs_runs = fit.coefficient() || fit.severe();
        let mut wear = |search: &Self, theta: &[f64]| match needs_runs {
            true => simulations.about(search.change(theta)),
            false => Ok(as_run_um.to_vec()),
        };
        self.fit_alone(&mut parameters, &mut wear)?;
        let mut residuals = |theta: &[f64]| Ok(self.residuals(&wear(&self, theta)?, theta));
        let fitted = least_squares::<CompareError>(&parameters, &mut residuals)?;
        let mut found = FittedCoefficients {
            blamed: fitted.blamed.map(|index| self.unknowns[index]),
            uncertainty: uncertainty(&fitted.jacobian, &fitted.residuals, &self.parts()),
            wear_um: as_run_um.to_vec(),
            stop: fitted.stop,
            unsettled: None,
            parameters: fitted.parameters,
            jacobian: fitted.jacobian,
            bounds: parameters,
            unknowns: self.unknowns.clone(),
            waves: self.waves.clone(),
            weights: self.weights.clone(),
            removals: self.removals.clone(),
        };
        if needs_runs {
            self.settle(&mut found, NEGLIGIBLE, simulations)?;
        }
        // A value at the end of its range has no interval.
        found.uncertainty = found.uncertainty.filter(|_| found.stop == FitStop::Converged);
        Ok(found)
    }

    /// The same fit with runs of another scene, from what was found on: by exact runs alone, with the weights and waves that were found.
    pub(super) fn again(
        question: &'a ComparisonQuestion,
        comparisons: &'a [Comparison<'a>],
        before: &FittedCoefficients,
        simulations: &mut Simulations<'_>,
    ) -> Result<FittedCoefficients, CompareError> {
        let search = Self {
            question,
            comparisons,
            unknowns: before.unknowns.clone(),
            weights: before.weights.clone(),
            removals: before.removals.clone(),
            waves: before.waves.clone(),
        };
        let mut found = FittedCoefficients { unsettled: None, ..before.clone() };
        search.settle(&mut found, NEGLIGIBLE_AGAIN, simulations)?;
        found.uncertainty = found.uncertainty.filter(|_| found.stop == FitStop::Converged);
        Ok(found)
    }

    /// The unknowns as parameters, each starting where its profile alone fits best.
    fn parameters(&self, begun: &[Beginning], most: &[f64], severe_factor: f64) -> Vec<Parameter> {
        let within = self.question.shift_within_mm;
        let parameters = self.unknowns.iter().map(|&unknown| {
            let own = self.comparisons.iter().zip(begun.iter().zip(most));
            let own = own.filter(|(one, _)| unknown.is_of(one.of.profile.gear)).map(|(_, begun)| begun);
            match unknown {
                Unknown::Coefficient(_) => {
                    let count = own.clone().count() as f64;
                    let start = own.clone().map(|(begun, _)| begun.factor.ln()).sum::<f64>() / count;
                    let greatest = own.map(|(_, most)| most.ln()).fold(f64::INFINITY, f64::min);
                    Parameter { start: start.min(greatest), least: LEAST_FACTOR.ln(), greatest, width: LOG_WIDTH }
                }
                Unknown::Severe => {
                    Parameter { start: severe_factor.ln(), least: 0.0, greatest: MOST_SEVERE.ln(), width: LOG_WIDTH }
                }
                Unknown::Shift(_) => {
                    let start = own.map(|(begun, _)| begun.shift_mm).sum();
                    Parameter { start, least: -within, greatest: within, width: SHIFT_WIDTH_MM }
                }
            }
        });
        parameters.collect()
    }

    /// Fits each profile alone, from `parameters` on: finds its waves, and its weight by the scatter that is left; the fit of all then starts from the
    /// results.
    fn fit_alone(&mut self, parameters: &mut [Parameter], wear: &mut Wear<'_, Self>) -> Result<(), CompareError> {
        let begun: Vec<f64> = parameters.iter().map(|parameter| parameter.start).collect();
        for index in 0..self.comparisons.len() {
            let one = &self.comparisons[index];
            let gear = one.of.profile.gear;
            let own: Vec<usize> = (0..begun.len()).filter(|&i| self.unknowns[i].is_of(gear)).collect();
            let of_own: Vec<Parameter> = own.iter().map(|&i| parameters[i]).collect();
            let mut fit = |search: &Self| {
                let mut residuals = |values: &[f64]| {
                    let mut theta = begun.clone();
                    own.iter().zip(values).for_each(|(&i, &value)| theta[i] = value);
                    let wear_um = wear(search, &theta)?;
                    Ok(search.residuals_of(index, &wear_um[index], &theta))
                };
                least_squares::<CompareError>(&of_own, &mut residuals)
            };
            let mut alone = fit(self)?;
            if alone.stop == FitStop::Converged {
                let columns = self.removals[index].columns().iter().chain(&alone.jacobian);
                let columns: Vec<&[f64]> = columns.map(Vec::as_slice).collect();
                let found = waviness::find(&alone.residuals, &columns, &one.of.profile.places_mm(one.pair));
                if !found.is_empty() {
                    let waves = found.iter().map(|one| one.wave).collect();
                    let of_waves = found.into_iter().flat_map(|one| one.columns);
                    self.removals[index] = one.removal.clone().and(of_waves);
                    let with_waves = fit(self)?;
                    // Waves after which the profile no longer gives what is fitted are wear.
                    if with_waves.stop == FitStop::Converged {
                        (self.waves[index], alone) = (waves, with_waves);
                    } else {
                        self.removals[index] = one.removal.clone();
                    }
                }
            }
            if self.comparisons.len() == 1 {
                return Ok(());
            }
            let found = uncertainty(&alone.jacobian, &alone.residuals, &[self.part(index)]);
            let deviation = match found {
                Some(found) => found.scatter[0].deviation,
                None => root_mean_square(alone.residuals.iter().copied()),
            };
            self.weights[index] = deviation.max(LEAST_SCATTER_UM).recip();
            for (&i, &value) in own.iter().zip(&alone.parameters) {
                if self.unknowns[i] == Unknown::Coefficient(Some(gear)) {
                    parameters[i].start = value;
                }
            }
        }
        Ok(())
    }

    /// Gauss–Newton steps on the residuals of exact runs until convergence.
    /// A step of less than `negligible` standard deviations is the last.
    fn settle(
        &self,
        found: &mut FittedCoefficients,
        negligible: f64,
        simulations: &mut Simulations<'_>,
    ) -> Result<(), CompareError> {
        let parameters = found.bounds.clone();
        let mut jacobian = std::mem::take(&mut found.jacobian);
        let mut theta = found.parameters.clone();
        let converges = found.stop == FitStop::Converged;
        let parts = self.parts();
        let mut least: Option<f64> = None;
        let mut last_step = 0.0;
        let mut before: Option<(Vec<f64>, Vec<f64>)> = None;
        for _ in 0..MOST_EXACT_RUNS {
            let wear_um = simulations.exactly(self.change(&theta))?;
            let r = self.residuals(&wear_um, &theta);
            let square: f64 = r.iter().map(|r| r * r).sum();
            if let Some((theta_before, r_before)) = before.take() {
                let [step, change] = [(&theta, theta_before), (&r, r_before)]
                    .map(|(now, before)| now.iter().zip(before).map(|(now, before)| now - before).collect::<Vec<_>>());
                broyden_update(&mut jacobian, &parameters, &step, &change);
            }
            let step = converges.then(|| gauss_newton_step(&jacobian, &r)).flatten();
            let uncertainty = uncertainty(&jacobian, &r, &parts);
            let deviations = uncertainty.as_ref().map(|u| u.deviations.clone());
            if least.is_none_or(|least| square < least) {
                least = Some(square);
                found.parameters.clone_from(&theta);
                (found.wear_um, found.uncertainty) = (wear_um, uncertainty);
            }
            let Some(step) = step else { break };
            // Steps in standard deviations; those below [`SMALL_STEP`] count as 0.
            last_step = (0..step.len())
                .filter(|&i| step[i].abs() > SMALL_STEP * parameters[i].width)
                .map(|i| step[i].abs() / deviations.as_ref().map_or(0.0, |all| all[i]))
                .fold(0.0, f64::max);
            if last_step <= negligible {
                break;
            }
            before = Some((theta.clone(), r));
            for ((value, by), p) in theta.iter_mut().zip(&step).zip(&parameters) {
                *value = (*value + by).clamp(p.least, p.greatest);
            }
        }
        found.jacobian = jacobian;
        if converges && last_step > negligible {
            found.unsettled = Some(last_step);
            found.stop = if last_step <= TOLERABLE { FitStop::Converged } else { FitStop::MaxIterations };
        }
        Ok(())
    }

    /// The weighted residuals of all profiles, with the wear at the flank points of each.
    fn residuals(&self, wear_um: &[Vec<f64>], theta: &[f64]) -> Vec<f64> {
        (0..self.comparisons.len()).flat_map(|index| self.residuals_of(index, &wear_um[index], theta)).collect()
    }

    /// Those of one profile.
    fn residuals_of(&self, index: usize, wear_um: &[f64], theta: &[f64]) -> Vec<f64> {
        let one = &self.comparisons[index];
        let mut residuals = one.residuals_um(wear_um, self.shift_mm(one, theta));
        self.removals[index].remove(&mut residuals);
        residuals.iter_mut().for_each(|r| *r *= self.weights[index]);
        residuals
    }

    /// The part of each profile in the residuals.
    fn parts(&self) -> Vec<ProfilePart> {
        (0..self.comparisons.len()).map(|index| self.part(index)).collect()
    }

    fn part(&self, index: usize) -> ProfilePart {
        let (one, removal, weight) = (&self.comparisons[index], &self.removals[index], self.weights[index]);
        let tooth = |own: &Vec<f64>| {
            let mut own = own.clone();
            removal.remove(&mut own);
            own.iter().map(|deviation| weight * deviation).collect()
        };
        ProfilePart {
            points: one.measured_um.len(),
            also_fitted: removal.columns().to_vec(),
            teeth: one.of.profile.teeth_um.iter().map(tooth).collect(),
        }
    }

    /// Change of the scene for these parameters.
    fn change(&self, theta: &[f64]) -> CoefficientChange {
        CoefficientChange {
            coefficient_factor: PerGear::from_fn(|gear| {
                let of_gear = match self.question.fitted {
                    FittedGears::Each => Some(gear),
                    fitted if fitted.has(gear) => None,
                    _ => return 1.0,
                };
                self.value(Unknown::Coefficient(of_gear), theta).map_or(1.0, f64::exp)
            }),
            severe_factor: self.value(Unknown::Severe, theta).map(f64::exp),
        }
    }

    fn shift_mm(&self, one: &Comparison<'_>, theta: &[f64]) -> f64 {
        self.value(self.question.shift_of(one.of.profile.gear), theta).unwrap_or(0.0)
    }

    fn value(&self, unknown: Unknown, theta: &[f64]) -> Option<f64> {
        self.unknowns.iter().position(|&own| own == unknown).map(|index| theta[index])
    }
}
