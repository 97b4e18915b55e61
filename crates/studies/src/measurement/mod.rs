//! Measured profiles of a flank ([`gearwear::measured_flank`]): freed of their form, evaluated, and fitted.
//!
//! A stylus trace, or one of a replica, is a row of heights along the flank. To show the wear, the form of the unworn flank is
//! removed first, a least-squares cubic as in the thesis (section 4.2) or the nominal involute. The form of the simulated profile is removed in the
//! same way: a cubic takes a part of the wear with it.
//!
//! | module | what it does |
//! |---|---|
//! | [`form`] | form removal as a projection |
//! | [`roughness`] | arithmetic mean deviation, before and after a Gaussian filter |
//! | [`fit`] | nonlinear least squares in a few parameters |
//! | [`deviations`] | deviations and tolerance class after ISO 1328-1 |
//! | [`waviness`] | waves in the residuals |
//! | `correlation` | spectrum of the residuals |
//! | [`interval`] | uncertainty of the parameters, from the residuals |

mod correlation;
pub mod deviations;
pub mod fit;
pub mod form;
pub mod interval;
pub mod roughness;
pub mod waviness;
