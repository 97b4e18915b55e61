//! Wear coefficient and remaining life from measurements of wear at several times.

pub mod wear_process;
