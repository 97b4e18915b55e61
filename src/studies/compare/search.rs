//! The parameters with which the simulated profiles fit the measured ones best.
//!
//! ```text
//! χ² = Σ w_p² |r_p|²,          r_p = P [z − z₀(s + d_p) + h(s + d_p; κ k, C)]
//! ```
//!
//! with the residuals r_p of each profile ([`Comparison`]) and as parameters, where they are asked for, ln κ and ln C, the logarithms of
//! the factor on the wear coefficient, or of one on that of each gear, and of the factor of severe wear, and the shift d_p of each profile
//! along its flank. Of several profiles each has the weight w_p = 1/(σ_p √τ_p), with the standard deviation of the residuals that it has when
//! it is fitted alone, and how many neighbouring points say what one says ([`crate::measurement::interval`]): what the model does not
//! describe of a profile lessens its weight, what it does not share with the other one does not. χ² is least over profiles interpolated between runs ([`Simulations::about`]); then runs with just the parameters found
//! take the place of the interpolation, and Gauss–Newton steps on their residuals go on until they no longer matter. The result is that
//! of the exact runs, the best of them; the derivatives are those of the interpolation, mended by what each exact run says of the last step. Where wear does not change smoothly with the coefficient (an
//! abrupt transition to severe wear, wear steps beyond the stable one), exact runs scatter: steps of up to half a standard deviation are
//! then left, and reported.

use super::comparison::{Beginning, Comparison};
use super::question::{FitKind, Fitted, Question};
use super::simulations::{Change, CompareError, Simulations};
use super::unknown::Unknown;
use crate::gear::{Gear, PerGear};
use crate::measurement::fit::{FitStop, Parameter, broyden_update, gauss_newton_step, least_squares};
use crate::measurement::interval::{FitUncertainty, ProfilePart, uncertainty};

/// Least factor on the wear coefficient.
const LEAST_FACTOR: f64 = 1e-3;
/// Greatest factor of severe wear; the least is 1.
const MOST_SEVERE: f64 = 1e4;
/// Differences of logarithms.
const LOG_WIDTH: f64 = 0.02;
/// Differences of the shift, mm.
const SHIFT_WIDTH_MM: f64 = 5e-3;
/// A step shorter than this part of a parameter's standard deviation no longer matters.
const NEGLIGIBLE: f64 = 0.02;
/// One shorter than this part of it is left where exact runs go on to scatter.
const TOLERABLE: f64 = 0.5;
/// Nor does one shorter than this part of the width of its differences.
const SMALL_STEP: f64 = 5e-3;
/// Most exact runs at the end.
const MOST_EXACT_RUNS: usize = 6;
/// Least scatter that weights are made of, µm.
const LEAST_SCATTER_UM: f64 = 1e-6;
/// What the search found.
pub(super) struct FittedCoefficients {
    pub unknowns: Vec<Unknown>,
    parameters: Vec<f64>,
    pub stop: FitStop,
    /// Which is to blame, where one is.
    pub blamed: Option<Unknown>,
    /// What the residuals say; `None` where nothing was fitted or too few points count.
    pub uncertainty: Option<FitUncertainty>,
    /// Wear depth of the flank points of each profile.
    pub wear_um: Vec<Vec<f64>>,
    /// The last step in standard deviations, where exact runs still ask for one.
    pub unsettled: Option<f64>,
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

    /// One parameter less another, and half the width of the interval of that.
    pub(super) fn difference(&self, one: Unknown, other: Unknown) -> Option<(f64, Option<f64>)> {
        let (i, j) = (self.index(one)?, self.index(other)?);
        let half_width = self.uncertainty.as_ref().map(|u| u.half_width_of_difference(i, j));
        Some((self.parameters[i] - self.parameters[j], half_width))
    }
}

/// Wear of the flank points of each profile under some parameters.
type Wear<'a, S> = dyn FnMut(&S, &[f64]) -> Result<Vec<Vec<f64>>, CompareError> + 'a;

/// Measured profiles, and how their parameters are found.
pub(super) struct Search<'a> {
    question: &'a Question,
    comparisons: &'a [Comparison<'a>],
    unknowns: Vec<Unknown>,
    /// w_p.
    weights: Vec<f64>,
}

impl<'a> Search<'a> {
    /// Of what `question` asks, with a comparison for each of its profiles.
    pub(super) fn new(question: &'a Question, comparisons: &'a [Comparison<'a>]) -> Self {
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
        Self { question, comparisons, unknowns, weights: vec![1.0; comparisons.len()] }
    }

    /// The parameters that fit best, beginning with the run's own wear.
    pub(super) fn run(
        mut self,
        as_run_um: &[Vec<f64>],
        simulations: &mut Simulations<'_>,
    ) -> Result<FittedCoefficients, CompareError> {
        let fit = self.question.fit;
        let most: Vec<f64> =
            self.comparisons.iter().zip(as_run_um).map(|(one, wear)| one.greatest_factor(wear)).collect();
        let begin = |((one, wear), &most): ((&Comparison<'_>, &Vec<f64>), &f64)| {
            one.begin(wear, self.question.shift_within_mm, fit.coefficient().then_some([LEAST_FACTOR, most]))
        };
        let begun: Vec<Beginning> = self.comparisons.iter().zip(as_run_um).zip(&most).map(begin).collect();
        let mut parameters = self.parameters(&begun, &most, simulations.severe_factor());
        let needs_runs = fit.coefficient() || fit.severe();
        let mut wear = |search: &Self, theta: &[f64]| match needs_runs {
            true => simulations.about(search.change(theta)),
            false => Ok(as_run_um.to_vec()),
        };
        if begun.len() > 1 {
            self.weigh(&mut parameters, &mut wear)?;
        }
        let mut residuals = |theta: &[f64]| Ok(self.residuals(&wear(&self, theta)?, theta));
        let fitted = least_squares::<CompareError>(&parameters, &mut residuals)?;
        let mut found = FittedCoefficients {
            blamed: fitted.blamed.map(|index| self.unknowns[index]),
            uncertainty: uncertainty(&fitted.jacobian, &fitted.residuals, &self.parts()),
            wear_um: as_run_um.to_vec(),
            stop: fitted.stop,
            unsettled: None,
            parameters: fitted.parameters,
            unknowns: self.unknowns.clone(),
        };
        if needs_runs {
            self.settle(&mut found, &parameters, fitted.jacobian, simulations)?;
        }
        // Beside the best value that was searched no interval means anything.
        found.uncertainty = found.uncertainty.filter(|_| found.stop == FitStop::Converged);
        Ok(found)
    }

    /// The unknowns as parameters that begin where each profile alone would.
    fn parameters(&self, begun: &[Beginning], most: &[f64], severe_factor: f64) -> Vec<Parameter> {
        let within = self.question.shift_within_mm;
        let of_gear = |gear: Option<Gear>| {
            let profiles = self.comparisons.iter().zip(begun.iter().zip(most));
            let own = profiles.filter(move |(one, _)| gear.is_none_or(|gear| one.of.profile.gear == gear));
            own.map(|(_, begun)| begun)
        };
        let parameter = |unknown: &Unknown| match *unknown {
            Unknown::Coefficient(gear) => {
                let count = of_gear(gear).count() as f64;
                let start = of_gear(gear).map(|(begun, _)| begun.factor.ln()).sum::<f64>() / count;
                let greatest = of_gear(gear).map(|(_, most)| most.ln()).fold(f64::INFINITY, f64::min);
                Parameter { start: start.min(greatest), least: LEAST_FACTOR.ln(), greatest, width: LOG_WIDTH }
            }
            Unknown::Severe => {
                Parameter { start: severe_factor.ln(), least: 0.0, greatest: MOST_SEVERE.ln(), width: LOG_WIDTH }
            }
            Unknown::Shift(gear) => {
                let start = of_gear(gear).map(|(begun, _)| begun.shift_mm).sum();
                Parameter { start, least: -within, greatest: within, width: SHIFT_WIDTH_MM }
            }
        };
        self.unknowns.iter().map(parameter).collect()
    }

    /// Gives each profile its weight: fitted alone, from where `parameters` begin, which then begin there.
    fn weigh(&mut self, parameters: &mut [Parameter], wear: &mut Wear<'_, Self>) -> Result<(), CompareError> {
        let begun: Vec<f64> = parameters.iter().map(|parameter| parameter.start).collect();
        for (index, part) in self.parts().into_iter().enumerate() {
            let one = &self.comparisons[index];
            let own: Vec<usize> = (0..begun.len()).filter(|&i| self.unknowns[i].is_of(one.of.profile.gear)).collect();
            let mut residuals = |values: &[f64]| {
                let mut theta = begun.clone();
                own.iter().zip(values).for_each(|(&i, &value)| theta[i] = value);
                let wear_um = wear(self, &theta)?;
                Ok(one.residuals_um(&wear_um[index], self.shift_mm(one, &theta)))
            };
            let of_own: Vec<Parameter> = own.iter().map(|&i| parameters[i]).collect();
            let alone = least_squares::<CompareError>(&of_own, &mut residuals)?;
            let found = uncertainty(&alone.jacobian, &alone.residuals, &[part]);
            let root_mean_square =
                || (alone.residuals.iter().map(|r| r * r).sum::<f64>() / alone.residuals.len() as f64).sqrt();
            let deviation = found.map_or_else(root_mean_square, |found| found.scatter[0].deviation);
            self.weights[index] = deviation.max(LEAST_SCATTER_UM).recip();
            for (&i, &value) in own.iter().zip(&alone.parameters) {
                if self.unknowns[i] == Unknown::Coefficient(Some(one.of.profile.gear)) {
                    parameters[i].start = value;
                }
            }
        }
        Ok(())
    }

    /// Gauss–Newton steps on the residuals of exact runs, until they no longer matter.
    fn settle(
        &self,
        found: &mut FittedCoefficients,
        parameters: &[Parameter],
        mut jacobian: Vec<Vec<f64>>,
        simulations: &mut Simulations<'_>,
    ) -> Result<(), CompareError> {
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
                broyden_update(&mut jacobian, parameters, &step, &change);
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
            // Steps in standard deviations; those that are nothing beside the differences count for nothing.
            last_step = (0..step.len())
                .filter(|&i| step[i].abs() > SMALL_STEP * parameters[i].width)
                .map(|i| step[i].abs() / deviations.as_ref().map_or(0.0, |all| all[i]))
                .fold(0.0, f64::max);
            if last_step <= NEGLIGIBLE {
                break;
            }
            before = Some((theta.clone(), r));
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

    /// The weighted residuals of all profiles, with the wear at the flank points of each.
    fn residuals(&self, wear_um: &[Vec<f64>], theta: &[f64]) -> Vec<f64> {
        let mut all = Vec::new();
        for (one, (wear_um, weight)) in self.comparisons.iter().zip(wear_um.iter().zip(&self.weights)) {
            all.extend(one.residuals_um(wear_um, self.shift_mm(one, theta)).into_iter().map(|r| weight * r));
        }
        all
    }

    /// How the residuals of all profiles are made up.
    fn parts(&self) -> Vec<ProfilePart> {
        let part =
            |one: &Comparison<'_>| ProfilePart { points: one.measured_um.len(), also_fitted: one.of.form.parameters() };
        self.comparisons.iter().map(part).collect()
    }

    /// The change of the scene that the parameters stand for.
    fn change(&self, theta: &[f64]) -> Change {
        let factor = |gear: Gear| {
            let of_gear = match self.question.fitted {
                Fitted::Each => Some(gear),
                fitted if fitted.has(gear) => None,
                _ => return 1.0,
            };
            self.value(Unknown::Coefficient(of_gear), theta).map_or(1.0, f64::exp)
        };
        Change {
            coefficient_factor: PerGear::from_fn(factor),
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
