//! The wear run: its state, its steps, its checkpoints.

pub mod advance;
pub mod checkpoint;
pub mod figures;
pub mod heat_observation;
pub mod left_out_contact;
pub(crate) mod life;
pub mod mesh_contact;
pub mod settings;
pub mod stability;
pub mod torque_curve;
pub mod wear_run;
