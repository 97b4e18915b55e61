//! Sums of products in independent lanes.

/// Numbers of sums that run beside each other, for vector instructions: as long as a sum is long, and then once in a short one.
const LANES: usize = 8;
const FEWER_LANES: usize = 4;

/// Sum Σ m_k h_k over the weights.
#[inline(always)]
pub fn weighted_sum(weights: &[f64], values: &[f64]) -> f64 {
    let values = &values[..weights.len()];
    let (weights, values) = (weights.as_chunks::<LANES>(), values.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (m, h) in weights.0.iter().zip(values.0) {
        for k in 0..LANES {
            sums[k] += m[k] * h[k];
        }
    }
    let (weights, values) = (weights.1.as_chunks::<FEWER_LANES>(), values.1.as_chunks::<FEWER_LANES>());
    for (m, h) in weights.0.iter().zip(values.0) {
        for k in 0..FEWER_LANES {
            sums[k] += m[k] * h[k];
        }
    }
    for (sum, (m, h)) in sums[FEWER_LANES..].iter_mut().zip(weights.1.iter().zip(values.1)) {
        *sum += m * h;
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}
