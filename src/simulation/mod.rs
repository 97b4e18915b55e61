//! The wear run: its state, its steps, its checkpoints.

pub(crate) mod advance;
pub(crate) mod checkpoint;
pub(crate) mod figures;
pub(crate) mod heat_observation;
pub(crate) mod life;
pub(crate) mod mesh_contact;
pub(crate) mod settings;
pub(crate) mod stability;
pub(crate) mod wear_run;
