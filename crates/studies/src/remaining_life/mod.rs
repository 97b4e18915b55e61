//! Wear coefficient and remaining life of gears, by wear measured at several times.
//!
//! The scene is run once with its own coefficients, as long as is needed ([`wear_curve`]); the wear of another coefficient is that after as many times the
//! revolutions. A measurement of mass, depth or profile thus is an *exposure*, the revolutions after which the run has worn as much. From exposures at some
//! times the probabilities of the coefficient, of later wear and of the revolutions to a limit follow by Bayes' theorem ([`wear_process`]), anew after each
//! measurement.
//!
//! | module | what it does |
//! |---|---|
//! | [`wear_table`] | reader of the table of measurements |
//! | [`asked`] | run, table and options, read and checked |
//! | [`measurement`] | teeth of one time together |
//! | [`regime`], [`limit`] | coefficient before any measurement; wear that ends the life |
//! | [`other_gear`] | coefficient of the gear that was not measured |
//! | [`wear_curve`] | simulated wear against revolutions |
//! | [`wear_process`] | scatter, and what measurements say in spite of it |
//! | [`study`] | all of it, in order |
//! | [`record`], [`report`] | what was found, and its files |

pub mod asked;
pub mod limit;
pub mod measurement;
pub mod other_gear;
pub mod record;
pub mod regime;
pub mod report;
pub mod study;
pub mod wear_curve;
pub mod wear_process;
pub mod wear_table;
