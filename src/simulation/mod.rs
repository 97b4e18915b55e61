//! The wear run, and the plain records that runs leave behind.

pub mod accuracy_record;
pub mod fem_pair_record;
pub mod fem_problem_record;
pub mod figures;
pub mod record;
pub mod settings;
pub mod simplified;
pub mod wear_run;
pub mod wearing_pair;
