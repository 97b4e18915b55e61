//! The samples: Saltelli's scheme over a scrambled Sobol sequence, and the Gaussian copula of correlated keys.
//!
//! A point of a Sobol sequence of 2d dimensions gives two samples of d uncertain factors, one from each half:
//!
//! ```text
//! A_j = (u_j1 … u_jd)          B_j = (u_j,d+1 … u_j,2d)          AB_j^i = A_j with its factor i from B_j
//! ```
//!
//! The sequence is Joe and Kuo's with Owen's scrambling, which the seed sets (crate `sobol_burley`: 2¹⁶ points of 256 dimensions, each
//! number to 2⁻²⁴; half of that is added, so that no number is 0 or 1). Factors with correlated normal scores:
//!
//! ```text
//! z = Φ⁻¹(u)          u' = Φ(L z)          C = L Lᵀ        (Cholesky)
//! ```
//!
//! Source: A. Saltelli et al., *Variance based sensitivity analysis of model output*, Computer Physics Communications 181 (2010)
//! 259–270; A. B. Owen, *Scrambling Sobol' and Niederreiter–Xing points*, Journal of Complexity 14 (1998) 466–489.

use nalgebra::DMatrix;

use super::distribution::{normal_quantile, normal_share};

/// Greatest number of points of the sequence.
pub const MOST_SAMPLES: usize = 1 << 16;
/// Greatest number of factors: half of the dimensions of the sequence.
pub const MOST_FACTORS: usize = sobol_burley::NUM_DIMENSIONS as usize / 2;
const HALF_A_BIT: f64 = 1.0 / (1 << 25) as f64;

/// Sample of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matrix {
    A,
    B,
    /// Sample A with this factor taken from B.
    Mixed(usize),
}

#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    pub factors: usize,
    pub seed: u32,
    /// Lower triangular matrix L of the first factors; the others are independent.
    pub correlation: Option<DMatrix<f64>>,
}

/// Faults of correlations.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CorrelationError {
    #[error(
        "found {given:?}; allowed: KEY:KEY=R, such as pair.pinion.tip_rounding_mm:pair.wheel.tip_rounding_mm=0.8, with R above -1 and below 1"
    )]
    Form { given: String },
    #[error("found the key {key}; allowed: one of the uncertain keys: {known}")]
    Key { key: String, known: String },
    #[error("found the correlation of {key} and {other} twice; allowed: once")]
    Twice { key: String, other: String },
    #[error("the correlations contradict one another: their matrix is not positive definite; allowed: weaker ones")]
    NotPositiveDefinite,
}

/// Correlation of the normal scores of the uncertain keys.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreCorrelation {
    /// R.
    pub matrix: DMatrix<f64>,
    /// L of R = L Lᵀ.
    pub lower: DMatrix<f64>,
}

/// Correlation of `keys` as `given`; none where nothing is correlated.
pub fn correlation(keys: &[&str], given: &[String]) -> Result<Option<ScoreCorrelation>, CorrelationError> {
    if given.is_empty() {
        return Ok(None);
    }
    let mut matrix = DMatrix::identity(keys.len(), keys.len());
    for text in given {
        let read = text.rsplit_once('=').and_then(|(pair, value)| {
            let (key, other) = pair.split_once(':')?;
            let value: f64 = value.trim().parse().ok()?;
            Some((key.trim(), other.trim(), value)).filter(|(key, other, value)| value.abs() < 1.0 && key != other)
        });
        let (key, other, value) = read.ok_or_else(|| CorrelationError::Form { given: text.clone() })?;
        let (i, j) = (place(keys, key)?, place(keys, other)?);
        if matrix[(i, j)] != 0.0 {
            return Err(CorrelationError::Twice { key: key.to_owned(), other: other.to_owned() });
        }
        matrix[(i, j)] = value;
        matrix[(j, i)] = value;
    }
    let lower = matrix.clone().cholesky().ok_or(CorrelationError::NotPositiveDefinite)?.l();
    Ok(Some(ScoreCorrelation { matrix, lower }))
}

fn place(keys: &[&str], key: &str) -> Result<usize, CorrelationError> {
    let place = keys.iter().position(|known| *known == key);
    place.ok_or_else(|| CorrelationError::Key { key: key.to_owned(), known: keys.join(", ") })
}

impl Design {
    /// The factors of a sample of the point `number`, each between 0 and 1.
    pub fn sample(&self, number: usize, matrix: Matrix) -> Vec<f64> {
        let dimensions = (0..self.factors).map(|factor| match matrix {
            Matrix::A => factor,
            Matrix::Mixed(mixed) if factor != mixed => factor,
            Matrix::B | Matrix::Mixed(_) => self.factors + factor,
        });
        let mut u: Vec<f64> = dimensions
            .map(|dimension| f64::from(sobol_burley::sample(number as u32, dimension as u32, self.seed)) + HALF_A_BIT)
            .collect();
        if let Some(lower) = &self.correlation {
            let z: Vec<f64> = u.iter().take(lower.nrows()).map(|&u| normal_quantile(u)).collect();
            for (row, u) in u.iter_mut().enumerate().take(lower.nrows()) {
                *u = normal_share((0..=row).map(|column| lower[(row, column)] * z[column]).sum());
            }
        }
        u
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each half of the sequence has one point in each of N intervals of every dimension: a (0, m, 1) net in one dimension.
    #[test]
    fn ver_the_sequence_is_stratified_in_every_dimension() {
        let (points, factors) = (256, 5);
        let design = Design { factors, seed: 7, correlation: None };
        for matrix in [Matrix::A, Matrix::B] {
            for factor in 0..factors {
                let mut hit = vec![0; points];
                (0..points).for_each(|n| hit[(design.sample(n, matrix)[factor] * points as f64) as usize] += 1);
                assert!(hit.iter().all(|&count| count == 1), "{matrix:?} {factor}");
            }
        }
        let (a, b, mixed) =
            (design.sample(3, Matrix::A), design.sample(3, Matrix::B), design.sample(3, Matrix::Mixed(2)));
        assert_eq!(mixed, [a[0], a[1], b[2], a[3], a[4]]);
    }

    /// The correlation of the normal scores is the one asked for.
    #[test]
    fn ver_correlated_factors_have_their_correlation() {
        let given = ["a:b=0.8".to_owned()];
        let ScoreCorrelation { lower, .. } = correlation(&["a", "b"], &given).unwrap().unwrap();
        let design = Design { factors: 3, seed: 1, correlation: Some(lower) };
        let samples: Vec<Vec<f64>> = (0..4096).map(|n| design.sample(n, Matrix::A)).collect();
        for (other, expected, within) in [(1, 0.8, 0.01), (2, 0.0, 0.02)] {
            let products = samples.iter().map(|u| normal_quantile(u[0]) * normal_quantile(u[other]));
            let found = products.sum::<f64>() / 4096.0;
            assert!((found - expected).abs() < within, "{found}");
        }
    }

    #[test]
    fn contradictions_are_refused() {
        for (given, said) in [
            (&["a:b=0.9", "b:c=0.9", "a:c=-0.9"][..], "not positive definite"),
            (&["a:d=0.9"], "a, b, c"),
            (&["a:b=1.5"], "KEY:KEY=R"),
            (&["a:a=0.5"], "KEY:KEY=R"),
            (&["a:b=0.5", "b:a=0.5"], "twice"),
        ] {
            let given: Vec<String> = given.iter().map(|text| (*text).to_owned()).collect();
            let message = correlation(&["a", "b", "c"], &given).unwrap_err().to_string();
            assert!(message.contains(said), "{message}");
        }
    }
}
