//! Error against run time: every model that fits a scene, against the finest finite-element solution.
//!
//! A setting (contact surface, tooth stiffness, resolution) is a scene like any other: the user's file with some keys
//! changed. Each is carried out by [`crate::pipeline`], alone, so that its wall time means something, and its result is
//! compared with the [`mod@reference`], which is extrapolated from finite-element runs at two resolutions. Where sections
//! differ over the face width there are no finite elements to compare with, and the truest of the other models takes their
//! place.

pub(crate) mod comparison;
mod deep_runs;
pub(crate) mod front;
pub(crate) mod measure;
pub(crate) mod observed;
pub(crate) mod over_width;
pub(crate) mod quantity;
pub(crate) mod record;
pub(crate) mod reference;
pub(crate) mod report;
pub(crate) mod selection;
pub(crate) mod settings;
mod sliced_comparison;
mod sliced_selection;
pub(crate) mod study;
mod timed_run;
