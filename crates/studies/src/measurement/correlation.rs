//! Correlation of the residuals of a profile, by their spectrum.
//!
//! Residuals at n points are divided into cosines, c_k(i) = cos(π k (i + ½)/n), in which stationary noise is independent: the part y_k has
//! the variance σ² S_k. Either all S_k are 1, white noise, or long waves are stronger,
//!
//! ```text
//! S_k = 1 + a/(1 + (k/k₀)²)^p
//! ```
//!
//! beside white noise: with p = 1 as of noise whose correlation decays exponentially along the flank, with p = 3 as of what is smooth, which a simulation
//! does not describe. Of each triple (a, k₀, p) on a grid the restricted likelihood is, with the
//! columns X that were fitted,
//!
//! ```text
//! L = |S|^(−1/2) |Xᵀ S⁻¹ X|^(−1/2) R^(−(n − q)/2),      R = least yᵀ S⁻¹ y after X
//! ```
//!
//! and its part of all likelihoods is its probability, with equal priors of white noise and of all spectra of one p. A parameter with the influence w
//! has the variance R/(n − q) Σ w_k² S_k of each pair. Profiles of more than [`MOST_POINTS`] points are averaged over neighbours first.
//!
//! Sources: H. D. Patterson and R. Thompson, *Recovery of inter-block information when block sizes are unequal*, Biometrika 58 (1971) 545–554;
//! P. J. Brockwell and R. A. Davis, *Time Series: Theory and Methods* (1991), chapter 10.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::fit::dot;

/// Probability of white noise above which residuals are that.
pub(super) const IS_WHITE: f64 = 0.5;
/// Most points that are divided into cosines.
const MOST_POINTS: usize = 512;
/// p and a.
const STRENGTHS: [(i32, [f64; 9]); 2] =
    [(1, [0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3]), (3, [1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8])];
/// k₀.
const CORNERS: [f64; 7] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
/// Length of a column, less what others have of it, below which it is one of them.
const IN_OTHERS: f64 = 1e-6;

/// Residuals of a profile in cosines, with the columns that were fitted to them.
#[derive(Debug, Clone)]
pub(super) struct Cosines {
    /// y_k.
    pub values: Vec<f64>,
    /// Orthonormal.
    columns: Vec<Vec<f64>>,
}

/// A spectrum and how well it fits.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FittedSpectrum {
    /// S_k.
    pub shape: Vec<f64>,
    /// Whether it is one of what is smooth, p = 3.
    pub is_smooth: bool,
    /// Logarithm of the restricted likelihood and the prior.
    pub restricted: f64,
    /// Logarithm of the greatest likelihood and the prior.
    pub greatest: f64,
    /// R/(n − q).
    pub variance: f64,
}

/// The values of a profile averaged over neighbours where there are many, so that white noise keeps its deviation.
pub(super) fn averaged(values: &[f64]) -> Vec<f64> {
    let block = values.len().div_ceil(MOST_POINTS).max(1);
    values.chunks(block).map(|some| some.iter().sum::<f64>() / (some.len() as f64).sqrt()).collect()
}

/// The values at averaged points that have these cosines.
pub(super) fn from_cosines(parts: &[f64]) -> Vec<f64> {
    let n = parts.len();
    let angle = 0.5 * PI / n as f64;
    let table: Vec<f64> = (0..4 * n).map(|j| (angle * j as f64).cos()).collect();
    let norm = |k: usize| (if k == 0 { 1.0 } else { 2.0 } / n as f64).sqrt();
    let value =
        |i: usize| parts.iter().enumerate().map(|(k, part)| norm(k) * part * table[(2 * i + 1) * k % (4 * n)]).sum();
    (0..n).map(value).collect()
}

/// The values of a profile in cosines, averaged first.
pub(super) fn in_cosines(values: &[f64]) -> Vec<f64> {
    let averaged = averaged(values);
    let n = averaged.len();
    let table: Vec<f64> = (0..4 * n).map(|j| (0.5 * PI * j as f64 / n as f64).cos()).collect();
    let part = |k: usize| {
        let (mut at, mut sum) = (k, 0.0);
        for value in &averaged {
            sum += value * table[at];
            at += 2 * k;
            if at >= 4 * n {
                at -= 4 * n;
            }
        }
        sum * (if k == 0 { 1.0 } else { 2.0 } / n as f64).sqrt()
    };
    (0..n).map(part).collect()
}

impl Cosines {
    /// Of residuals and the columns fitted to them.
    pub(super) fn new<'a>(residuals: &[f64], columns: impl IntoIterator<Item = &'a [f64]>) -> Self {
        let mut cosines = Self { values: in_cosines(residuals), columns: Vec::new() };
        columns.into_iter().for_each(|column| cosines.fit_too(in_cosines(column)));
        cosines
    }

    /// Fits another column, given in cosines; one that is made of the others adds nothing.
    pub(super) fn fit_too(&mut self, mut column: Vec<f64>) {
        let length = dot(&column, &column).sqrt();
        for _ in 0..2 {
            for other in &self.columns {
                let part = dot(other, &column);
                column.iter_mut().zip(other).for_each(|(value, other)| *value -= part * other);
            }
        }
        let rest = dot(&column, &column).sqrt();
        if rest > IN_OTHERS * length {
            column.iter_mut().for_each(|value| *value /= rest);
            self.columns.push(column);
        }
    }

    /// n − q.
    pub(super) fn freedom(&self) -> f64 {
        self.values.len() as f64 - self.columns.len() as f64
    }

    /// S⁻¹ times what the columns leave of the values, and of other ones.
    pub(super) fn left_by(&self, shape: &[f64], values: &[f64]) -> Option<Vec<f64>> {
        let weighted: Vec<f64> = values.iter().zip(shape).map(|(value, s)| value / s).collect();
        let q = self.columns.len();
        let normal = DMatrix::from_fn(q, q, |i, j| {
            let products = self.columns[i].iter().zip(&self.columns[j]).zip(shape);
            products.map(|((a, b), s)| a * b / s).sum()
        });
        let along = DVector::from_fn(q, |i, _| dot(&self.columns[i], &weighted));
        let parts = normal.cholesky()?.solve(&along);
        let left = values.iter().enumerate().map(|(k, value)| {
            let fitted: f64 = self.columns.iter().zip(parts.iter()).map(|(column, part)| part * column[k]).sum();
            (value - fitted) / shape[k]
        });
        Some(left.collect())
    }

    /// Every spectrum, white noise first; none where nothing is left of the values, or too little to tell.
    pub(super) fn spectra(&self) -> Vec<FittedSpectrum> {
        let (n, q, freedom) = (self.values.len(), self.columns.len(), self.freedom());
        if freedom < 1.0 {
            return Vec::new();
        }
        let corners: Vec<f64> = CORNERS.into_iter().filter(|&corner| 2.0 * corner <= n as f64).collect();
        let strengths = STRENGTHS.iter().flat_map(|(power, all)| all.map(|strength| (strength, *power)));
        let grid: Vec<(f64, i32, f64)> =
            strengths.flat_map(|(a, power)| corners.iter().map(move |&corner| (a, power, corner))).collect();
        let of_each = (0.5 * STRENGTHS.len() as f64 / grid.len().max(1) as f64).ln();
        let all = [((0.0, 1, 1.0), 0.5f64.ln())].into_iter().chain(grid.into_iter().map(|one| (one, of_each)));
        // Products of columns and values, a row for each k.
        let pairs: Vec<(usize, usize)> = (0..=q).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        let column = |i: usize| if i < q { &self.columns[i] } else { &self.values };
        let products: Vec<Vec<f64>> =
            pairs.iter().map(|&(i, j)| column(i).iter().zip(column(j)).map(|(a, b)| a * b).collect()).collect();
        let fitted = all.filter_map(|((strength, power, corner), prior)| {
            let shape = (0..n).map(|k| 1.0 + strength / (1.0 + (k as f64 / corner).powi(2)).powi(power));
            let shape: Vec<f64> = shape.collect();
            let inverse: Vec<f64> = shape.iter().map(|s| 1.0 / s).collect();
            let mut sums = DMatrix::zeros(q + 1, q + 1);
            for (&(i, j), product) in pairs.iter().zip(&products) {
                let sum = dot(product, &inverse);
                (sums[(i, j)], sums[(j, i)]) = (sum, sum);
            }
            // Of Cholesky's factor of all, the last element is √R.
            let factor = sums.cholesky()?.unpack();
            let left = factor[(q, q)].powi(2);
            let columns: f64 = (0..q).map(|i| factor[(i, i)].ln()).sum();
            let spectrum: f64 = 0.5 * shape.iter().map(|s| s.ln()).sum::<f64>();
            Some(FittedSpectrum {
                restricted: prior - spectrum - columns - 0.5 * freedom * left.ln(),
                greatest: prior - spectrum - 0.5 * n as f64 * left.ln(),
                variance: left / freedom,
                is_smooth: power > 1,
                shape,
            })
        });
        fitted.filter(|fitted| fitted.restricted.is_finite()).collect()
    }
}

/// Probability of each spectrum.
pub(super) fn probabilities(spectra: &[FittedSpectrum]) -> Vec<f64> {
    let greatest = spectra.iter().map(|of| of.restricted).fold(f64::NEG_INFINITY, f64::max);
    let relative: Vec<f64> = spectra.iter().map(|of| (of.restricted - greatest).exp()).collect();
    let sum: f64 = relative.iter().sum();
    relative.iter().map(|part| part / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cosines are orthonormal: lengths and products stay.
    #[test]
    fn ver_lengths_and_products_stay() {
        let a: Vec<f64> = (0..37).map(|i| (f64::from(i) * 1.3).sin()).collect();
        let b: Vec<f64> = (0..37).map(|i| f64::from(i % 5)).collect();
        assert!((dot(&in_cosines(&a), &in_cosines(&b)) - dot(&a, &b)).abs() < 1e-12);
        assert!(from_cosines(&in_cosines(&a)).iter().zip(&a).all(|(x, y)| (x - y).abs() < 1e-13));
        // A cosine is one of them.
        let third: Vec<f64> = (0..37).map(|i| (PI * 3.0 * (f64::from(i) + 0.5) / 37.0).cos()).collect();
        let parts = in_cosines(&third);
        assert!((parts[3] - (37.0f64 / 2.0).sqrt()).abs() < 1e-12 && parts[4].abs() < 1e-12);
        // Averages keep the scatter of white noise, and the length of what is smooth.
        let smooth = vec![1.0; 2000];
        assert!((dot(&in_cosines(&smooth), &in_cosines(&smooth)) / 2000.0 - 1.0).abs() < 1e-12);
    }

    /// White noise is told from noise of a correlation length.
    #[test]
    fn ver_white_noise_is_told_from_correlated_noise() {
        let mut state = 7u32;
        let white: Vec<f64> = (0..300)
            .map(|_| {
                let sum: f64 = (0..12)
                    .map(|_| {
                        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                        f64::from(state >> 8) / f64::from(1u32 << 24)
                    })
                    .sum();
                sum - 6.0
            })
            .collect();
        let mut last = 0.0;
        let correlated: Vec<f64> = white
            .iter()
            .map(|e| {
                last = 0.9 * last + e;
                last
            })
            .collect();
        let of_white = |values: &[f64]| probabilities(&Cosines::new(values, [&vec![1.0; 300][..]]).spectra())[0];
        assert!(of_white(&white) > 0.5 && of_white(&correlated) < 1e-6);
    }
}
