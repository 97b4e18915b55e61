//! Sobol indices of functions whose indices are known.

use std::f64::consts::PI;

use gearwear::uncertainty::design::{Design, Matrix};
use gearwear::uncertainty::distribution::Distribution;
use gearwear_bodies::reference::sobol_indices::{Index, Indices, indices};

fn of(distributions: &[Distribution], samples: usize, f: impl Fn(&[f64]) -> f64) -> Indices {
    let factors = distributions.len();
    let design = Design { factors, seed: 1, correlation: None };
    let values = |matrix: Matrix| -> Vec<f64> {
        let value = |n: usize| {
            let u = design.sample(n, matrix);
            f(&u.iter().zip(distributions).map(|(&u, one)| one.quantile(u)).collect::<Vec<_>>())
        };
        (0..samples).map(value).collect()
    };
    let mixed: Vec<Vec<f64>> = (0..factors).map(|factor| values(Matrix::Mixed(factor))).collect();
    indices(&values(Matrix::A), &values(Matrix::B), &mixed, 1).unwrap()
}

fn hold(found: &[Index], expected: &[f64], within: f64) {
    for (index, expected) in found.iter().zip(expected) {
        assert!(index.low <= expected + 5e-4 && expected - 5e-4 <= index.high, "{index:?} for {expected}");
        assert!((index.value - expected).abs() < within, "{index:?} for {expected}");
    }
}

/// f = sin x₁ + a sin² x₂ + b x₃⁴ sin x₁ over ±π, a = 7, b = 0.1; T. Ishigami and T. Homma, *An importance quantification technique
/// in uncertainty analysis for computer models* (ISUMA 1990). The indices, to three digits, follow from the variances in closed form:
/// V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = 8 b²π⁸/225.
#[test]
fn ver_ishigami() {
    let x = Distribution::Uniform { low: -PI, high: PI };
    let f = |x: &[f64]| x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin();
    let found = of(&[x; 3], 4096, f);
    hold(&found.first, &[0.314, 0.442, 0.0], 0.02);
    hold(&found.total, &[0.558, 0.442, 0.244], 0.02);
}

/// Wear that is linear in k and in the number of meshes, both uncertain and independent: y = k n. With the variation coefficients
/// c = σ/μ, V/(μ_k μ_n)² = c_k² + c_n² + c_k² c_n², of which the first two are the parts of one factor alone. A lognormal k has
/// c² = exp(σ²) − 1, a uniform n within ±p has c² = p²/3.
#[test]
fn ver_a_product_in_closed_form() {
    let k = Distribution::Lognormal { median: 1e-17, factor: 1.5 };
    let n = Distribution::Uniform { low: 0.7e6, high: 1.3e6 };
    let (c_k, c_n) = ((1.5_f64.ln().powi(2)).exp() - 1.0, 0.09 / 3.0);
    let variance = c_k + c_n + c_k * c_n;
    let found = of(&[k, n], 4096, |x| x[0] * x[1]);
    hold(&found.first, &[c_k / variance, c_n / variance], 0.02);
    hold(&found.total, &[c_k * (1.0 + c_n) / variance, c_n * (1.0 + c_k) / variance], 0.02);
    // One factor alone explains all.
    let alone = of(&[k], 1024, |x| 3e11 * x[0]);
    hold(&alone.first, &[1.0], 0.02);
    hold(&alone.total, &[1.0], 0.02);
}

#[test]
fn what_does_not_vary_has_no_indices() {
    assert_eq!(indices(&[3.0; 4], &[3.0; 4], &[vec![3.0; 4]], 1), None);
    assert_eq!(indices(&[0.0; 4], &[0.0; 4], &[vec![0.0; 4]], 1), None);
}
