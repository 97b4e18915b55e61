//! Questions that take many runs: each with its record and its report in one place.

pub(crate) mod accuracy;
pub(crate) mod compare;
pub(crate) mod sweep;
pub(crate) mod validation;
pub(crate) mod variants;
