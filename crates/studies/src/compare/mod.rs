//! Measured profiles against a run: the difference, and the wear coefficients that explain them best.
//!
//! One profile, or one of the pinion and one of the wheel. The form is removed from a measured profile and from the simulated one alike
//! ([`crate::measurement::form`]), the profile is shifted along the flank to where it fits best, and what is asked for, the wear
//! coefficient or that of each gear, the severe factor, is fitted by least squares to all profiles at once. Runs are carried out by
//! [`gearwear_physics::assessment`].
//!
//! | module | what it does |
//! |---|---|
//! | [`run_folder`] | reader of the folder of a finished run |
//! | [`asked`] | a comparison as it is asked for: run and measured files read |
//! | [`question`] | what is asked, checked against the run and the measured files |
//! | `simulations` | runs of the scene with other coefficients |
//! | `wear_by_coefficient` | wear profiles in between |
//! | `comparison` | a measured profile beside simulated ones |
//! | [`unknown`] | what is fitted, by name |
//! | `search` | the parameters that fit best |
//! | [`profile_slope`] | the slope before wear, and the fit with it in the scene |
//! | [`in_words`] | its findings on slope and interval in sentences |
//! | [`study`] | all of it, in order |

pub mod asked;
mod comparison;
pub mod in_words;
pub mod profile_slope;
pub mod question;
pub mod record;
pub mod report;
pub mod run_folder;
mod search;
mod simulations;
pub mod study;
pub mod unknown;
mod wear_by_coefficient;
