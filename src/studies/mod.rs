//! Studies of many runs, each with its record and report.

#[cfg(feature = "program")]
pub(crate) mod accuracy;
#[cfg(feature = "program")]
pub(crate) mod compare;
pub(crate) mod evaluate;
#[cfg(feature = "program")]
pub(crate) mod found;
#[cfg(feature = "program")]
pub(crate) mod invariants;
pub(crate) mod spread;
#[cfg(feature = "program")]
pub(crate) mod sweep;
#[cfg(feature = "program")]
pub(crate) mod uncertainty;
#[cfg(feature = "program")]
pub(crate) mod validation;
#[cfg(feature = "program")]
pub(crate) mod variants;
pub(crate) mod varied_scene;
