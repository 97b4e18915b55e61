//! Measured profiles of a flank: read, freed of their form, and fitted.
//!
//! A stylus trace, or one of a replica, is a row of heights along the flank. To see wear in it, the form of the unworn flank is
//! taken away first, by a least-squares cubic as in the thesis (section 4.2) or by the nominal involute. Whatever is taken from
//! the measured profile is taken from the simulated one in the same way: a cubic takes a part of the wear with it.
//!
//! | module | what it does |
//! |---|---|
//! | [`mod@file`] | the CSV file with its header |
//! | [`profile`] | its points on the flank of a gear |
//! | [`form`] | form removal as a projection |
//! | [`roughness`] | arithmetic mean deviation, before and after a Gaussian filter |
//! | [`fit`] | nonlinear least squares in a few parameters |
//! | [`interval`] | what the residuals say of the parameters |

pub(crate) mod file;
pub(crate) mod fit;
pub(crate) mod form;
pub(crate) mod interval;
pub(crate) mod profile;
pub(crate) mod roughness;
