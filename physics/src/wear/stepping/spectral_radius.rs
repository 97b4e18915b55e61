//! Spectral radius of the Jacobian of a rate, by a nonlinear power iteration.
//!
//! ```text
//! J v ≈ (f(y + ε v) − f(y))/ε            v ← J v/‖J v‖            ρ ≈ ‖J v‖/‖v‖
//! ```
//!
//! each iteration one evaluation of f within a step, in which slow sources of f stay as they were, or of a part of f that decays as fast
//! ([`Rate::choose_part`]). The first probe is noise, in proportion to the rate: it has a part of every wave,
//! where wear is. The vector found is kept, so that a renewal takes two or three.
//!
//! ε is no round-off but a depth that matters: waves lower than that may do what they like. So a rate that jumps (the hard
//! switch to severe wear) has a finite radius, jump/ε, and steps are long enough to be worth their stages. Over such a depth severe wear is not
//! linear, and the iteration may wander. The values of a linear rate rise: where one has fallen, and they do not settle in eight, the greatest of them
//! counts, and another estimate costs as much.
//!
//! Source: Sommeijer, Shampine and Verwer (1997), section 3; B. Lindberg (1974) for the factor of safety.

use serde::{Deserialize, Serialize};

use super::{Noise, Rate, greatest};

/// Greatest number of iterations.
const MOST_ITERATIONS: usize = 20;
/// Greatest number of iterations where a value has fallen.
const MOST_WANDERING: u64 = 8;
/// Relative change that ends the iteration.
const CONVERGED: f64 = 0.05;
/// Factor of safety on the estimate, which approaches the radius from below.
const SAFETY: f64 = 1.2;
/// Factor of safety where the rate is steep: its radius changes from step to step, and is greater than waves as high as the probe show. With a radius too small
/// waves grow until the rate bounds them, and errors fall no faster than steps are shortened: severe wear takes half as many steps again with 1.2.
const SAFETY_OF_STEEP: f64 = 1.8;

/// Estimate of the spectral radius.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpectralRadius {
    vector: Vec<f64>,
    value: Option<f64>,
    /// Whether the last estimate did not settle.
    wanders: bool,
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl SpectralRadius {
    /// Estimate with the factor of safety for a rate that `is_steep` ([`Rate::is_steep`]) or is not; none before there is one.
    pub(crate) fn bound(&self, is_steep: bool) -> Option<f64> {
        self.value.map(|found| found * if is_steep { SAFETY_OF_STEEP } else { SAFETY })
    }

    /// Estimate without the factor of safety, which approaches the radius from below; 0 where there is none.
    pub(crate) fn found(&self) -> f64 {
        self.value.unwrap_or_default()
    }

    /// Whether the last estimate did not settle.
    pub(crate) fn wanders(&self) -> bool {
        self.wanders
    }

    /// Drops the estimate; the vector is kept.
    pub(crate) fn reset(&mut self) {
        self.value = None;
    }

    /// Estimates the radius at `state`, where the rate is `slope`, with probes of the height `probe`. Returns the number of evaluations.
    pub(crate) fn estimate<R: Rate + ?Sized>(
        &mut self,
        rate: &mut R,
        (state, slope): (&[f64], &[f64]),
        probe: f64,
    ) -> Result<u64, R::Error> {
        let part = rate.choose_part(state)?;
        let slope = part.as_deref().unwrap_or(slope);
        if self.vector.len() != state.len() {
            let mut noise = Noise::new(1);
            self.vector = slope.iter().map(|f| f * noise.next()).collect();
        }
        let mut probed = vec![0.0; state.len()];
        let mut image = vec![0.0; state.len()];
        let (mut radius, mut greatest_found, mut evaluations): (f64, f64, u64) = (0.0, 0.0, 0);
        let mut has_fallen = false;
        // Where it wanders, for a rate that is not linear over the probe, no smaller radius than the greatest found is safe.
        self.wanders = true;
        for _ in 0..MOST_ITERATIONS {
            let height = greatest(&self.vector);
            if !(height > 0.0 && height.is_finite()) {
                // Nothing wears, or nothing changes with wear.
                self.vector.clear();
                self.wanders = false;
                break;
            }
            // The probe is normalised: without that repeated application of J takes it out of the range of numbers.
            self.vector.iter_mut().for_each(|v| *v *= probe / height);
            probed.iter_mut().zip(state.iter().zip(&self.vector)).for_each(|(p, (y, v))| *p = y + v);
            match &part {
                Some(_) => rate.evaluate_part(&probed, &mut image)?,
                None => rate.evaluate_stage(&probed, &mut image)?,
            }
            evaluations += 1;
            image.iter_mut().zip(slope).for_each(|(image, f)| *image -= f);
            let (before, found) = (radius, norm(&image) / norm(&self.vector));
            std::mem::swap(&mut self.vector, &mut image);
            radius = found;
            // The first image is of noise.
            greatest_found = if evaluations > 1 { greatest_found.max(found) } else { 0.0 };
            if evaluations > 1 && (found - before).abs() <= CONVERGED * found {
                self.wanders = false;
                break;
            }
            has_fallen |= evaluations > 2 && found < before;
            if has_fallen && evaluations >= MOST_WANDERING {
                break;
            }
        }
        self.value = Some(if self.wanders { greatest_found } else { radius });
        Ok(evaluations)
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// y' = −A y with the matrix [−1 2 −1] of the heat equation, whose greatest eigenvalue is 4 sin²(π n/(2 n + 2)) ≈ 4.
    struct Heat;

    impl Rate for Heat {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            for (i, rate) in rate.iter_mut().enumerate() {
                let before = i.checked_sub(1).map_or(0.0, |before| state[before]);
                *rate = before - 2.0 * state[i] + state.get(i + 1).unwrap_or(&0.0);
            }
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// The estimate is not below the radius and not far above it; the second takes few evaluations.
    #[test]
    fn ver_radius_of_the_heat_equation() {
        let state: Vec<f64> = (0..200).map(|i| (0.1 * f64::from(i)).sin() + 2.0).collect();
        let mut slope = vec![0.0; 200];
        let Ok(()) = Heat.evaluate(&state, &mut slope);
        let mut radius = SpectralRadius::default();
        let Ok(first) = radius.estimate(&mut Heat, (&state, &slope), 1e-3);
        let found = radius.bound(false).unwrap();
        assert!((4.0..1.25 * 4.0).contains(&found), "{found} after {first}");
        assert_eq!(radius.bound(true), Some(SAFETY_OF_STEEP * radius.found()));
        let Ok(second) = radius.estimate(&mut Heat, (&state, &slope), 1e-3);
        assert!(second <= 3 && first <= 20, "{first}, {second}");
    }

    /// Two rods that do not touch, of which one stands for both.
    #[derive(Default)]
    struct TwoRods {
        of_both: u32,
        of_one: u32,
    }

    impl Rate for TwoRods {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            self.of_both += 1;
            let rods = state.len() / 2;
            let Ok(()) = Heat.evaluate(&state[..rods], &mut rate[..rods]);
            Heat.evaluate(&state[rods..], &mut rate[rods..])
        }

        fn choose_part(&mut self, state: &[f64]) -> Result<Option<Vec<f64>>, Infallible> {
            let mut rate = vec![0.0; state.len()];
            self.evaluate_part(state, &mut rate).map(|()| Some(rate))
        }

        fn evaluate_part(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            self.of_one += 1;
            let rods = state.len() / 2;
            rate[rods..].fill(0.0);
            Heat.evaluate(&state[..rods], &mut rate[..rods])
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// A part that decays as fast as the whole is all that is evaluated.
    #[test]
    fn ver_radius_of_a_part() {
        let state: Vec<f64> = (0..400).map(|i| (0.1 * f64::from(i)).sin() + 2.0).collect();
        let (mut rods, mut slope) = (TwoRods::default(), vec![0.0; 400]);
        let Ok(()) = rods.evaluate(&state, &mut slope);
        let mut radius = SpectralRadius::default();
        let Ok(probes) = radius.estimate(&mut rods, (&state, &slope), 1e-3);
        let found = radius.bound(false).unwrap();
        assert!((4.0..1.25 * 4.0).contains(&found), "{found} after {probes}");
        assert_eq!((rods.of_both, u64::from(rods.of_one)), (1, 1 + probes));
    }

    /// y₀' = 1 + 3 (y₁ − 1), y₁' = 1 − (y₀ − 1): the eigenvalues are imaginary, and the iteration turns for ever.
    struct Wandering;

    impl Rate for Wandering {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            rate.copy_from_slice(&[1.0 + 3.0 * (state[1] - 1.0), 1.0 - (state[0] - 1.0)]);
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// An estimate that does not settle says so, and is the greatest value found; one that settles says the other.
    #[test]
    fn ver_a_radius_that_wanders_is_the_greatest_found() {
        let mut radius = SpectralRadius::default();
        let Ok(evaluations) = radius.estimate(&mut Wandering, (&[1.0, 1.0], &[1.0, 1.0]), 1e-3);
        assert_eq!((evaluations, radius.wanders()), (MOST_WANDERING, true));
        // |J v|/|v| swings about √3, between 1 and 3.
        assert!((3.0_f64.sqrt()..=3.0).contains(&radius.found()), "{}", radius.found());
        let state: Vec<f64> = (0..200).map(|i| (0.1 * f64::from(i)).sin() + 2.0).collect();
        let mut slope = vec![0.0; 200];
        let Ok(()) = Heat.evaluate(&state, &mut slope);
        let Ok(_) = radius.estimate(&mut Heat, (&state, &slope), 1e-3);
        assert!(!radius.wanders());
    }

    /// Nothing wears: no radius, and no endless loop.
    #[test]
    fn ver_no_radius_without_a_rate() {
        let mut radius = SpectralRadius::default();
        let Ok(evaluations) = radius.estimate(&mut Heat, (&[0.0; 5], &[0.0; 5]), 1e-3);
        assert_eq!((evaluations, radius.bound(false)), (0, Some(0.0)));
    }
}
