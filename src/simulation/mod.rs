//! The wear run.

pub mod record;
pub mod settings;
