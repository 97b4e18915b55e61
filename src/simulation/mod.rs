//! The wear run, and the plain records that runs leave behind.

pub mod accuracy_quantity;
pub mod accuracy_record;
pub mod advance;
pub mod checkpoint;
pub mod chemistry_record;
pub mod compare_record;
pub mod error_record;
pub mod fem_pair_record;
pub mod fem_problem_record;
pub mod figures;
pub mod heat_observation;
pub mod mesh_contact;
pub mod record;
pub mod settings;
pub mod simplified;
pub mod stability;
pub mod sweep_figures;
pub mod sweep_record;
pub mod sweep_verification;
pub mod validation_record;
pub mod wear_run;
pub mod wearing_pair;
