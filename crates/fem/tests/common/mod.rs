//! Plane problems that several tests solve.
#![allow(dead_code, unreachable_pub, reason = "each test uses its own part")]

pub mod fe_case;
pub mod grid;

/// Asserts that `value` is within the part `relative` of `expected`.
pub fn assert_close(what: &str, value: f64, expected: f64, relative: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= relative, "{what}: {value} instead of {expected} (off by {error:.2e}, allowed {relative:.0e})");
}
