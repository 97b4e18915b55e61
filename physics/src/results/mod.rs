//! Plain records of what was found, in the units of the output files: what reports, tables and tests read.
//!
//! The records of the studies (accuracy, sweep, compare, validation) are with them in `studies`.

pub mod chemistry;
pub(crate) mod drawing;
pub mod error;
pub mod fem_pair;
pub mod fem_problem;
pub mod figures;
pub mod invariant;
pub mod iso_stiffness;
pub mod life;
pub mod lubrication;
pub mod path_points;
pub mod provenance;
pub mod reported_by;
pub mod root_stress;
pub mod run;
pub mod torque_curve;
pub mod worn_pair;
