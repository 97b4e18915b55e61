//! Two numbers with elementwise arithmetic: contacts are computed side by side.
//!
//! Arrays as wide as the vector registers that every processor of the target has, so that the compiler makes one instruction of each operator.
//! Comparisons choose without branching.

use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// Count of numbers in a vector.
pub(crate) const LANES: usize = 2;

/// Two numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Lanes(pub [f64; LANES]);

impl Lanes {
    /// Two equal numbers.
    #[inline(always)]
    pub(crate) fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn with(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        let ([a, b], [e, f]) = (self.0, other.0);
        Self([of(a, e), of(b, f)])
    }

    /// `of` each number.
    #[inline(always)]
    pub(crate) fn map(self, of: impl Fn(f64) -> f64) -> Self {
        let [a, b] = self.0;
        Self([of(a), of(b)])
    }

    /// Square roots.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The greater one in every place.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if a > b { a } else { b })
    }

    /// Absolute values.
    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Own numbers where `condition` is above zero, those of `other` elsewhere.
    #[inline(always)]
    pub(crate) fn where_positive(self, condition: Self, other: Self) -> Self {
        let ([a, b], [e, f]) = (self.0, other.0);
        let [c, d] = condition.0;
        Self([if c > 0.0 { a } else { e }, if d > 0.0 { b } else { f }])
    }

    /// The sum of both.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        let [a, b] = self.0;
        a + b
    }

    /// The greater of both.
    #[inline(always)]
    pub(crate) fn greatest(self) -> f64 {
        let [a, b] = self.0;
        a.max(b)
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
