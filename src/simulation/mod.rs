//! The wear run and what it leaves behind.

pub mod fem_pair_record;
pub mod figures;
pub mod record;
pub mod settings;
pub mod wear_run;
