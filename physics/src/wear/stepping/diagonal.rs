//! A diagonal that stands for the Jacobian of a rate, measured by a probe.
//!
//! Where a place is worn down, the pressure on it falls: that is the diagonal of the Jacobian, and the stiff part of it. With
//! signs v_i = ±1 drawn by lot,
//!
//! ```text
//! E[v_i (J v)_i] = J_ii            J v ≈ (f(y + ε v) − f(y))/ε
//! ```
//!
//! and the mean over the neighbours of a place takes most of the chance out of one probe. What wears in pairs, like the flanks
//! of two gears, feels the wear of the other as well as its own. Blocks are probed one by one, and each diagonal counts as
//! many times as there are blocks: for two flanks J = −[c₁ c₁; c₂ c₂] point by point and W = −2 diag(c₁, c₂), so that W⁻¹J has the
//! eigenvalues 0 and 1 whatever the ratio of c₁ to c₂, and W is stiff enough everywhere.
//!
//! The diagonal knows nothing of the load, which is given: waves longer than the contact are hardly stiff at all, and the method
//! damps them as if they were. That costs accuracy, not stability.
//!
//! Source: C. Bekas, E. Kokiopoulou and Y. Saad, *Appl. Numer. Math.* 57 (2007) 1214.

use super::{Noise, Rate};

/// Places on either side that a place is averaged with.
const NEIGHBOURS: usize = 8;

/// Fills `diagonal` with W (≤ 0) at `state`, where the rate is `slope`, from one probe of the height `probe` for each of the
/// `blocks`, given by their lengths. Answers the number of evaluations.
pub(crate) fn estimate<R: Rate + ?Sized>(
    rate: &mut R,
    (state, slope): (&[f64], &[f64]),
    blocks: &[usize],
    probe: f64,
    diagonal: &mut Vec<f64>,
) -> Result<u64, R::Error> {
    diagonal.clear();
    let mut noise = Noise::new(2);
    let mut probed = state.to_vec();
    let mut image = vec![0.0; state.len()];
    let mut local = Vec::new();
    let mut begin = 0;
    for &length in blocks {
        let block = begin..begin + length;
        let signs: Vec<f64> = (0..length).map(|_| noise.sign()).collect();
        probed.copy_from_slice(state);
        probed[block.clone()].iter_mut().zip(&signs).for_each(|(p, sign)| *p += probe * sign);
        rate.evaluate(&probed, &mut image)?;
        local.clear();
        let changes = image[block.clone()].iter().zip(&slope[block.clone()]);
        local.extend(changes.zip(&signs).map(|((image, f), sign)| sign * (image - f) / probe));
        let count = blocks.len() as f64;
        diagonal.extend((0..length).map(|i| {
            let near = &local[i.saturating_sub(NEIGHBOURS)..(i + NEIGHBOURS + 1).min(length)];
            count * (near.iter().sum::<f64>() / near.len() as f64).min(0.0)
        }));
        begin = block.end;
    }
    Ok(blocks.len() as u64)
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Two rows that wear in pairs, at rates of their own.
    struct Pairs;

    impl Rate for Pairs {
        type Error = Infallible;

        fn evaluate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
            let half = state.len() / 2;
            for i in 0..half {
                let gap = state[i] + state[half + i];
                (rate[i], rate[half + i]) = (5.0 - 3.0 * gap, 5.0 - 0.5 * gap);
            }
            Ok(())
        }

        fn may_succeed_nearer(&self, _: &Infallible) -> bool {
            false
        }
    }

    /// W = −2 diag(3, ½).
    #[test]
    fn ver_diagonal_of_what_wears_in_pairs() {
        let state = vec![0.1; 80];
        let mut slope = vec![0.0; 80];
        let Ok(()) = Pairs.evaluate(&state, &mut slope);
        let mut diagonal = Vec::new();
        let Ok(evaluations) = estimate(&mut Pairs, (&state, &slope), &[40, 40], 1e-3, &mut diagonal);
        assert_eq!(evaluations, 2);
        for (i, w) in diagonal.iter().enumerate() {
            let expected = if i < 40 { -6.0 } else { -1.0 };
            assert!((w - expected).abs() < 1e-9, "{i}: {w}");
        }
    }
}
