//! Error against run time: every model that fits a scene, against the finest finite-element solution.
//!
//! A setting (contact surface, tooth stiffness, resolution) is a scene like any other: the user's file with some keys
//! changed. Each is carried out by [`gearwear_physics::assessment`], alone, so that its wall time means something, and its result is
//! compared with the [`mod@reference`], which is extrapolated from finite-element runs at two resolutions. Where sections
//! differ over the face width there are no finite elements to compare with, and the truest of the other models takes their
//! place.

pub mod comparison;
mod deep_runs;
pub mod front;
pub mod measure;
pub mod observed;
pub mod over_width;
pub mod quantity;
pub mod record;
pub mod reference;
pub mod report;
pub mod selection;
pub mod settings;
mod sliced_comparison;
mod sliced_selection;
pub mod study;
mod timed_run;
