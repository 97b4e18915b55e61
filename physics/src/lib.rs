//! What the library [gearwear](https://docs.rs/gearwear) calculates with: gear geometry, meshes and finite elements, contact, heat,
//! wear laws and the wear run over them. It knows no scene, no report and no command; users of the library take `gearwear`, which opens
//! scenes, runs them and hands over what is found.

#![allow(
    rustdoc::private_intra_doc_links,
    reason = "its documentation is read by those who work on it, private items with it"
)]

pub mod assessment;
pub mod calibration;
pub mod contact;
pub mod lubrication;
pub mod mesh_cycle;
pub mod observer;
pub mod operation;
pub mod plan;
pub mod results;
pub mod simulation;
pub mod stiffness;
pub mod thermal;
pub mod wear;
