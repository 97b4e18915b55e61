//! Moving band of heat on a half-space.
//!
//! The uniform heat flux q enters the strip −a < x < a of the surface of a half-space whose material passes under the strip at
//! the speed U, entering it at −a. The steady state is a superposition of moving line sources:
//!
//! ```text
//! T(x) = q/(π K) ∫ exp(u) K₀(|u|) dx'        u = U (x − x')/(2κ),   x' from −a to a
//! ```
//!
//! The integral has a closed form, as d/dz [z e^{±z} (K₀ ± K₁)] = e^{±z} K₀. With Pe = a U/(2κ) and X = x/a,
//!
//! ```text
//! T(X) = q a/(π K Pe) · [F(Pe (1 + X)) + G(Pe (1 − X))]
//! F(z) = z e^z (K₀ + K₁) − 1                 G(z) = 1 + z e^{−z} (K₀ − K₁)
//! ```
//!
//! The modified Bessel functions K_ν(z) = ∫₀^∞ exp(−z cosh t) cosh(ν t) dt are integrated by the trapezoidal rule, which converges
//! faster than any power of its step for such integrands.
//!
//! Source: H. S. Carslaw and J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed. (1959), section 10.7; J. C. Jaeger,
//! *J. Proc. R. Soc. N.S.W.* 76 (1942) 203.

/// Greatest step of the trapezoidal rule, for an error below 1e-14.
const STEP: f64 = 0.1;
/// Step times the root of large arguments, with which the width of the integrand decreases.
const STEP_TIMES_ROOT: f64 = 0.5;
/// Negative logarithm of the integrand at which the integration ends.
const NEGLIGIBLE: f64 = 45.0;
/// Number of golden sections, after which the hottest place is known to 1e-8 of the strip.
const SECTIONS: usize = 40;

/// Scaled Bessel functions e^z K₀(z) and e^z K₁(z) for z > 0.
pub(crate) fn scaled_bessel_k(z: f64) -> [f64; 2] {
    let step = STEP.min(STEP_TIMES_ROOT / z.sqrt());
    let mut sums = [0.5, 0.5];
    for k in 1.. {
        let t = step * f64::from(k);
        let exponent = z * (t.cosh() - 1.0);
        if exponent - t > NEGLIGIBLE {
            break;
        }
        let weight = (-exponent).exp();
        sums[0] += weight;
        sums[1] += weight * t.cosh();
    }
    sums.map(|sum| step * sum)
}

/// Integral F(z) = ∫₀^z e^t K₀(t) dt.
fn behind(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    let [k0, k1] = scaled_bessel_k(z);
    z * (k0 + k1) - 1.0
}

/// Integral G(z) = ∫₀^z e^{−t} K₀(t) dt.
fn ahead(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    let [k0, k1] = scaled_bessel_k(z);
    1.0 + z * (-2.0 * z).exp() * (k0 - k1)
}

/// Temperature rise T K/(q a) at X = x/a within the band, −1 (where material enters) to 1, for a Peclet number a U/(2κ) > 0.
pub(crate) fn rise_at(peclet: f64, x: f64) -> f64 {
    (behind(peclet * (1.0 + x)) + ahead(peclet * (1.0 - x))) / (std::f64::consts::PI * peclet)
}

/// Greatest temperature rise T K/(q a) of the band, which is in its rear half.
pub fn greatest_rise(peclet: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..SECTIONS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if rise_at(peclet, a) < rise_at(peclet, b) { low = a } else { high = b }
    }
    rise_at(peclet, 0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, tables 9.8 and 9.9: K₀(0.1), K₀(1), K₁(1), e^10 K₀(10).
    #[test]
    fn val_bessel_functions() {
        let [k0, k1] = scaled_bessel_k(1.0);
        let e = std::f64::consts::E;
        assert!((k0 / e - 0.421_024_438_2).abs() < 1e-10 && (k1 / e - 0.601_907_230_2).abs() < 1e-10);
        assert!((scaled_bessel_k(0.1)[0] * (-0.1_f64).exp() - 2.427_069_024_7).abs() < 1e-9);
        assert!((scaled_bessel_k(10.0)[0] - 0.391_631_934_4).abs() < 1e-9);
    }

    /// The closed form against the midpoint rule on the integral of line sources, refined towards its logarithmic pole.
    #[test]
    fn ver_closed_form_is_the_integral_of_line_sources() {
        for (peclet, x) in [(0.1, 0.0), (1.0, 0.4), (10.0, -0.7)] {
            // x' = x ± s², so that dx' = 2 s ds removes the pole.
            let sides = [(1.0 + x, 1.0), (1.0 - x, -1.0)].map(|(length, sign): (f64, f64)| {
                let parts = 20_000;
                let step = length.sqrt() / f64::from(parts);
                (0..parts)
                    .map(|i| {
                        let s = step * (f64::from(i) + 0.5);
                        let u: f64 = peclet * s * s;
                        // Behind a line source (sign +1) exp(u) K₀(u), ahead of it exp(−u) K₀(u).
                        let k0 = scaled_bessel_k(u)[0] * if sign > 0.0 { 1.0 } else { (-2.0 * u).exp() };
                        2.0 * s * k0 * step
                    })
                    .sum::<f64>()
            });
            let integral = (sides[0] + sides[1]) / std::f64::consts::PI;
            assert!((rise_at(peclet, x) / integral - 1.0).abs() < 1e-6, "{peclet} {x}");
        }
    }

    /// At high speed, the half-space under constant flux: 2 q/K √(κ t/π) with t = 2 a/U at the rear.
    #[test]
    fn ver_limit_of_a_fast_band() {
        let peclet: f64 = 1e4;
        let fast = 2.0 / (std::f64::consts::PI * peclet).sqrt();
        assert!((greatest_rise(peclet) / fast - 1.0).abs() < 0.01);
    }
}
