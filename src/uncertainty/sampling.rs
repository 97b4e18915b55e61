//! The samples of a question with their numbers: of each point A and B, then A with each key from B.

use super::design::{Design, Matrix};
use super::sampled_run::SampledQuestion;
use super::shared_runs;
use crate::varied_scene::VariedScene;

/// Samples of a point that are independent: A and B, from which quantiles are.
pub(super) const INDEPENDENT: usize = 2;

pub(super) struct Sampling<'a> {
    pub question: &'a SampledQuestion,
    pub design: Design,
    /// Samples of a point.
    pub matrices: Vec<Matrix>,
}

impl<'a> Sampling<'a> {
    pub(super) fn of(question: &'a SampledQuestion) -> Self {
        let keys = question.uncertain.len();
        let mixed = if question.correlation.is_some() { 0 } else { keys };
        let correlation = question.correlation.as_ref().map(|correlation| correlation.lower.clone());
        // One more for the error of the model, whether it is known or not: no run depends on that.
        let design = Design { factors: keys + 1, seed: question.seed, correlation };
        let matrices = [Matrix::A, Matrix::B].into_iter().chain((0..mixed).map(Matrix::Mixed)).collect();
        Self { question, design, matrices }
    }

    /// Number of all samples.
    pub(super) fn total(&self) -> usize {
        self.question.samples * self.matrices.len()
    }

    /// Numbers of the samples of a point.
    pub(super) fn of_point(&self, point: usize) -> std::ops::Range<usize> {
        let first = point * self.matrices.len();
        first..first + self.matrices.len()
    }

    /// Point and matrix of a sample.
    pub(super) fn of_number(&self, number: usize) -> (usize, Matrix) {
        (number / self.matrices.len(), self.matrices[number % self.matrices.len()])
    }

    /// Whether a sample is A or B of one of the first `points`.
    pub(super) fn is_independent(&self, number: usize, points: usize) -> bool {
        number / self.matrices.len() < points && number % self.matrices.len() < INDEPENDENT
    }

    /// Values of the uncertain keys.
    pub(super) fn values(&self, number: usize) -> Vec<f64> {
        let (point, matrix) = self.of_number(number);
        let u = self.design.sample(point, matrix);
        self.question.uncertain.iter().zip(u).map(|(one, u)| one.distribution.quantile(u)).collect()
    }

    /// Numbers of the samples, in groups that share a run.
    pub(super) fn groups(&self, varied: &VariedScene) -> Vec<Vec<usize>> {
        let coefficient = shared_runs::coefficient_key(varied, self.question);
        shared_runs::groups(self.question.samples, self.matrices.len(), coefficient, |number| self.values(number))
    }
}
