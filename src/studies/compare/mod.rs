//! A measured profile against a run: the difference, and the wear coefficient that explains it best.
//!
//! The form is removed from the measured and the simulated profile alike ([`crate::measurement::form`]), the profile is shifted
//! along the flank to where it fits best, and what is asked for, the wear coefficient, the severe factor or both, is
//! fitted by least squares. Runs are carried out by [`crate::pipeline`].
//!
//! | module | what it does |
//! |---|---|
//! | [`run_folder`] | what a finished run left behind |
//! | [`asked`] | a comparison as it is asked for: run and measured file read |
//! | [`question`] | what is asked, checked against the run and the measured file |
//! | `simulations` | runs of the scene with other coefficients |
//! | `wear_by_coefficient` | wear profiles in between |
//! | `search` | the parameters that fit best |
//! | [`study`] | all of it, in order |

pub(crate) mod asked;
pub(crate) mod question;
pub(crate) mod record;
pub(crate) mod report;
pub(crate) mod run_folder;
mod search;
mod simulations;
pub(crate) mod study;
mod wear_by_coefficient;
