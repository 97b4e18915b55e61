//! Finished runs side by side: what differs between their scenes, what between their figures, and whether that is more than the errors that
//! the runs state of themselves.

pub mod finished_run;
pub mod record;
pub mod report;
