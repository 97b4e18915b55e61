//! Four numbers that are worked on together: contacts go through the arithmetic side by side.
//!
//! Plain arrays with elementwise operators; the compiler makes vector instructions of them. Comparisons choose without branching.

use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// How many numbers go together.
pub const LANES: usize = 4;

/// Four numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lanes(pub [f64; LANES]);

impl Lanes {
    /// The same number four times.
    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    /// The four numbers of `row` from four times `quad` on.
    #[inline(always)]
    pub fn read(row: &[f64], quad: usize) -> Self {
        let own = &row[LANES * quad..LANES * (quad + 1)];
        Self([own[0], own[1], own[2], own[3]])
    }

    /// Puts them into `row` there.
    #[inline(always)]
    pub fn write(self, row: &mut [f64], quad: usize) {
        row[LANES * quad..LANES * (quad + 1)].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([of(a, e), of(b, f), of(c, g), of(d, h)])
    }

    /// `of` each number.
    #[inline(always)]
    pub fn map(self, of: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([of(a), of(b), of(c), of(d)])
    }

    /// Square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The greater of both, in every place.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if a > b { a } else { b })
    }

    /// Absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Its own numbers where `condition` is above zero, those of `other` elsewhere.
    #[inline(always)]
    pub fn where_positive(self, condition: Self, other: Self) -> Self {
        let mut chosen = other;
        for k in 0..LANES {
            chosen.0[k] = if condition.0[k] > 0.0 { self.0[k] } else { other.0[k] };
        }
        chosen
    }

    /// The sum of the four.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let [a, b, c, d] = self.0;
        (a + b) + (c + d)
    }

    /// The greatest of the four.
    #[inline(always)]
    pub fn greatest(self) -> f64 {
        let [a, b, c, d] = self.0;
        a.max(b).max(c.max(d))
    }
}

macro_rules! elementwise {
    ($($operator:ident $function:ident $sign:tt),*) => {$(
        impl $operator for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                self.with(other, |a, b| a $sign b)
            }
        }

        impl $operator<f64> for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                self.with(Self::splat(other), |a, b| a $sign b)
            }
        }
    )*};
}

elementwise!(Add add +, Sub sub -, Mul mul *, Div div /);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
