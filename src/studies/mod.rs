//! Questions that take many runs: each with its record and its report in one place.

pub mod accuracy;
pub mod compare;
pub mod sweep;
pub mod validation;
