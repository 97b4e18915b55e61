//! Measured profiles of a flank: read, freed of their form, and fitted.
//!
//! A stylus trace, or one of a replica, is a row of heights along the flank. To show the wear, the form of the unworn flank is
//! removed first, a least-squares cubic as in the thesis (section 4.2) or the nominal involute. The form of the simulated profile is removed in the
//! same way: a cubic takes a part of the wear with it.
//!
//! | module | what it does |
//! |---|---|
//! | [`mod@file`] | the file with its header, in the formats [`table`] and [`mka`] |
//! | `mka_export` | a profile as such an export |
//! | [`teeth`] | mean of the profiles of some teeth |
//! | [`mod@undefined`] | points without a height |
//! | [`profile`] | points on the flank of a gear |
//! | [`form`] | form removal as a projection |
//! | [`roughness`] | arithmetic mean deviation, before and after a Gaussian filter |
//! | [`fit`] | nonlinear least squares in a few parameters |
//! | [`deviations`] | deviations and tolerance class after ISO 1328-1 |
//! | [`waviness`] | waves in the residuals |
//! | `correlation` | spectrum of the residuals |
//! | [`interval`] | uncertainty of the parameters, from the residuals |

mod correlation;
pub mod deviations;
pub mod file;
pub mod fit;
pub mod form;
pub mod interval;
pub mod mka;
pub(crate) mod mka_export;
pub mod profile;
pub mod roughness;
pub mod table;
pub mod teeth;
pub mod undefined;
pub mod waviness;
