//! Error against run time: every model that fits a scene, against the finest finite-element solution.
//!
//! A setting (contact surface, tooth stiffness, resolution) is a scene like any other: the user's file with some keys
//! changed. Each is carried out by [`crate::pipeline`], alone, so that its wall time means something, and its result is
//! compared with the [`mod@reference`], which is extrapolated from finite-element runs at two resolutions. Where sections
//! differ over the face width there are no finite elements to compare with, and the truest of the other models takes their
//! place.
//!
//! | module | what it does |
//! |---|---|
//! | [`settings`] | a setting, and the scene it stands for |
//! | [`selection`] | which settings are run, which are not, and why |
//! | `sliced_selection` | the same where sections differ over the face width |
//! | `timed_run` | one setting, run for its result and its time |
//! | [`observed`] | the curves of a run that errors are measured on |
//! | [`over_width`] | those over the face width, and different numbers of slices at common widths |
//! | [`measure`] | errors of these curves |
//! | [`mod@reference`] | the reference by Richardson's extrapolation, and what remains uncertain of it |
//! | [`front`] | the Pareto front of error and run time, and what to recommend |
//! | [`comparison`] | runs that differ in one respect only, side by side |
//! | `sliced_comparison` | the same where sections differ over the face width |
//! | `deep_runs` | the models run to a greater depth, and whether they stay stable |
//! | [`study`] | all of it, in order |

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
