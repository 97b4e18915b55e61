//! Uncertainty: what a run's figures are worth where some of its keys are known only as distributions.
//!
//! The scene is run for samples of its uncertain keys. Quantiles give the scatter of the figures, Sobol indices the contribution of each key to it.
//! The error of the fast model, as found by finite elements on the scene as given, is one more uncertain factor.
//!
//! | module | what it does |
//! |---|---|
//! | [`asked`] | a study as it is asked for, checked |
//! | [`distribution`] | an uncertain key as the user writes it |
//! | `usual` | what is usual, by a word |
//! | [`design`] | samples from a Sobol sequence, correlations |
//! | `sampling` | their numbers |
//! | [`sampled_run`] | a run of the scene with some values of its keys |
//! | [`fast_model`] | the contact surface of the samples |
//! | `shared_runs` | samples that share a run |
//! | `response_surface` | samples that are read off a response surface of the others |
//! | [`kept`] | finished runs, kept in a journal |
//! | [`study`] | runs them on all threads |
//! | `bands` | quantiles of the wear over the flanks |
//! | [`life`] | when wear comes to a limit |
//!
//! Quantiles and Sobol indices of any values are in [`gearwear_bodies::reference`].

pub mod asked;
mod bands;
pub mod design;
pub mod distribution;
pub mod fast_model;
pub mod kept;
pub mod life;
pub mod record;
pub mod report;
mod response_surface;
pub mod sampled_run;
mod sampling;
mod shared_runs;
pub mod study;
mod usual;
