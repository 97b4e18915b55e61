//! Inverse of a symmetric positive definite Toeplitz matrix, kept as one column.
//!
//! Levinson's recursion solves T a = E e₀ with a₀ = 1, one row of T after the other, and by Gohberg and Semencul a tells all of the inverse:
//!
//! ```text
//! T⁻¹ = (L(a) L(a)ᵀ − L(b) L(b)ᵀ)/E          b = (0, a_{n−1}, …, a₁)
//! ```
//!
//! with L(·) the lower triangular Toeplitz matrix of a column. Both take n² operations, and memory in proportion to n.
//!
//! Source: G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. (2013), section 4.7; I. Gohberg and A. Semencul, *Mat. Issled.* 7 (1972)
//! 201–223.

use std::cell::RefCell;

use pulp::Arch;

/// Diagonals that are taken together.
const TOGETHER: usize = 4;

thread_local! {
    /// Memory of products, used again.
    static WORK: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
}

/// The inverse.
pub(super) struct ToeplitzInverse {
    /// Number of rows.
    count: usize,
    /// a, then zeros up to a multiple of [`TOGETHER`].
    forward: Vec<f64>,
    /// 1/E.
    per_error: f64,
}

impl ToeplitzInverse {
    /// Inverse of the matrix of `count` rows whose entries depend on their distance from the diagonal alone; none of a matrix that is not
    /// positive definite.
    pub(super) fn new(by_distance: &[f64], count: usize) -> Option<Self> {
        let mut forward = vec![0.0; count.next_multiple_of(TOGETHER)];
        let by_distance = &by_distance[..count];
        let error = Arch::new().dispatch(
            #[inline(always)]
            || recursion(by_distance, &mut forward[..count]),
        )?;
        Some(Self { count, forward, per_error: 1.0 / error })
    }

    /// Number of rows.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Fills `product` with the inverse times `side`.
    pub(super) fn times(&self, side: &[f64], product: &mut [f64]) {
        let (count, more) = (self.count, TOGETHER - 1);
        product.fill(0.0);
        WORK.with_borrow_mut(|work| {
            // Zeros after the side, and before what the transposed factors make of it.
            work.clear();
            work.resize(3 * (count + more) + self.forward.len(), 0.0);
            let (backward, work) = work.split_at_mut(self.forward.len());
            backward[1..count].iter_mut().zip(self.forward[1..count].iter().rev()).for_each(|(to, from)| *to = *from);
            let (padded, of_factors) = work.split_at_mut(count + more);
            padded[..count].copy_from_slice(side);
            let (of_forward, of_backward) = of_factors.split_at_mut(count + more);
            Arch::new().dispatch(
                #[inline(always)]
                || {
                    let transposed = [&mut of_forward[more..], &mut of_backward[more..]];
                    transposed_times(&self.forward, backward, padded, transposed);
                    times(&self.forward, backward, [of_forward, of_backward], product);
                },
            );
            product.iter_mut().for_each(|x| *x *= self.per_error);
        });
    }
}

/// Fills `products` with those with `x` of rows of a Toeplitz matrix beside those of `x`: of so many `before` it, then of those after it.
pub(super) fn beside(by_distance: &[f64], x: &[f64], before: usize, products: &mut [f64]) {
    let (of_before, of_after) = products.split_at_mut(before);
    WORK.with_borrow_mut(|reversed| {
        reversed.clear();
        reversed.extend(x.iter().rev());
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for (distance, value) in (1..=before).rev().zip(of_before) {
                    *value = product(&by_distance[distance..][..x.len()], x);
                }
                for (distance, value) in (1..).zip(of_after) {
                    *value = product(&by_distance[distance..][..x.len()], reversed);
                }
            },
        );
    });
}

/// Levinson's recursion: fills in a, and gives E.
#[inline(always)]
fn recursion(by_distance: &[f64], a: &mut [f64]) -> Option<f64> {
    let count = a.len();
    let reversed: Vec<f64> = by_distance.iter().rev().copied().collect();
    let mut error = *by_distance.first()?;
    *a.first_mut()? = 1.0;
    for order in 1..count {
        if error.is_nan() || error <= 0.0 {
            return None;
        }
        let from = count - 1 - order;
        let reflection = -product(&reversed[from..from + order], &a[..order]) / error;
        let (lower, upper) = a[..=order].split_at_mut(order.div_ceil(2));
        for (low, high) in lower.iter_mut().zip(upper.iter_mut().rev()) {
            (*low, *high) = (*low + reflection * *high, *high + reflection * *low);
        }
        if order % 2 == 0 {
            upper[0] *= 1.0 + reflection;
        }
        error *= 1.0 - reflection * reflection;
    }
    (error > 0.0).then_some(error)
}

/// Sum, in partial sums.
pub(super) fn sum(values: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let chunks = values.chunks_exact(LANES);
    let rest: f64 = chunks.remainder().iter().sum();
    chunks.for_each(|chunk| sums.iter_mut().zip(chunk).for_each(|(sum, value)| *sum += value));
    sums.iter().sum::<f64>() + rest
}

/// Scalar product, in partial sums.
#[inline(always)]
fn product(one: &[f64], other: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let (ones, others) = (one.chunks_exact(LANES), other.chunks_exact(LANES));
    let rest: f64 = ones.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in ones.zip(others) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.iter().sum::<f64>() + rest
}

/// L(a)ᵀ x and L(b)ᵀ x, for x with `TOGETHER − 1` zeros at its end.
#[inline(always)]
fn transposed_times(a: &[f64], b: &[f64], x: &[f64], [by_a, by_b]: [&mut [f64]; 2]) {
    let count = by_a.len();
    for (block, (a, b)) in a.chunks_exact(TOGETHER).zip(b.chunks_exact(TOGETHER)).enumerate() {
        let (first, length) = (TOGETHER * block, count - TOGETHER * block);
        let x: [&[f64]; TOGETHER] = std::array::from_fn(|q| &x[first + q..][..length]);
        let (by_a, by_b) = (&mut by_a[..length], &mut by_b[..length]);
        for i in 0..length {
            by_a[i] += (a[0] * x[0][i] + a[1] * x[1][i]) + (a[2] * x[2][i] + a[3] * x[3][i]);
            by_b[i] += (b[0] * x[0][i] + b[1] * x[1][i]) + (b[2] * x[2][i] + b[3] * x[3][i]);
        }
    }
}

/// L(a) x − L(b) y, for x and y with `TOGETHER − 1` zeros at their beginning.
#[inline(always)]
fn times(a: &[f64], b: &[f64], [x, y]: [&[f64]; 2], difference: &mut [f64]) {
    let count = difference.len();
    for (block, (a, b)) in a.chunks_exact(TOGETHER).zip(b.chunks_exact(TOGETHER)).enumerate() {
        let (first, length) = (TOGETHER * block, count - TOGETHER * block);
        let [x, y]: [[&[f64]; TOGETHER]; 2] =
            [x, y].map(|of| std::array::from_fn(|q| &of[TOGETHER - 1 - q..][..length]));
        let difference = &mut difference[first..];
        for i in 0..length {
            difference[i] += ((a[0] * x[0][i] + a[1] * x[1][i]) + (a[2] * x[2][i] + a[3] * x[3][i]))
                - ((b[0] * y[0][i] + b[1] * y[1][i]) + (b[2] * y[2][i] + b[3] * y[3][i]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// T (T⁻¹ x) = x, for matrices of 1 to 40 rows whose entries fall like the logarithm of the distance, as those of half-planes do.
    #[test]
    fn ver_the_product_with_the_matrix_is_the_side() {
        let by_distance: Vec<f64> = (0..40).map(|k| 6.0 - (0.3 + f64::from(k)).ln()).collect();
        for count in 1..=by_distance.len() {
            let inverse = ToeplitzInverse::new(&by_distance, count).unwrap();
            let side: Vec<f64> = (0..count).map(|i| (1.0 + i as f64).sin()).collect();
            let mut product = vec![0.0; count];
            inverse.times(&side, &mut product);
            for (i, side) in side.iter().enumerate() {
                let there: f64 = product.iter().enumerate().map(|(j, x)| by_distance[i.abs_diff(j)] * x).sum();
                assert!((there - side).abs() < 1e-12, "{count} rows: {there} {side}");
            }
        }
    }

    /// Rows before and after, one by one.
    #[test]
    fn ver_rows_beside_are_those_of_the_matrix() {
        let by_distance: Vec<f64> = (0..30).map(|k| 6.0 - (0.3 + f64::from(k)).ln()).collect();
        let x: Vec<f64> = (0..21).map(|i| (1.0 + f64::from(i)).sin()).collect();
        let mut products = [0.0; 9];
        beside(&by_distance, &x, 4, &mut products);
        let rows = (0..4_usize).chain(25..30);
        for (row, found) in rows.zip(&products) {
            let there: f64 = x.iter().enumerate().map(|(j, x)| by_distance[row.abs_diff(4 + j)] * x).sum();
            assert!((there - found).abs() < 1e-12, "row {row}: {there} {found}");
        }
    }

    /// A matrix that is not positive definite has none.
    #[test]
    fn no_inverse_of_an_indefinite_matrix() {
        assert!(ToeplitzInverse::new(&[1.0, 2.0], 2).is_none());
        assert!(ToeplitzInverse::new(&[-1.0], 1).is_none());
        assert!(ToeplitzInverse::new(&[1.0, f64::NAN, 0.5], 3).is_none());
    }
}
