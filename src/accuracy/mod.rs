//! Error against run time: every model that fits a scene, against the finest finite-element solution.
//!
//! A setting (contact surface, tooth stiffness, resolution) is a scene like any other: the user's file with some keys
//! changed. Each is carried out by [`crate::pipeline`], alone, so that its wall time means something, and its result is
//! compared with the [`mod@reference`], which is extrapolated from finite-element runs at two resolutions.
//!
//! | module | what it does |
//! |---|---|
//! | [`settings`] | a setting, and the scene it stands for |
//! | [`selection`] | which settings are run, which are not, and why |
//! | [`observed`] | the curves of a run that errors are measured on |
//! | [`measure`] | errors of these curves |
//! | [`mod@reference`] | the reference by Richardson's extrapolation, and what remains uncertain of it |
//! | [`front`] | the Pareto front of error and run time, and what to recommend |
//! | [`comparison`] | runs that differ in one respect only, side by side |
//! | [`study`] | all of it, in order |

pub mod comparison;
pub mod front;
pub mod measure;
pub mod observed;
pub mod reference;
pub mod selection;
pub mod settings;
pub mod study;
