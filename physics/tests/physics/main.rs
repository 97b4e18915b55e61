//! Gear geometry, contact, stiffness and wear by the physics alone: no scene file, no report.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

#[path = "../common/mod.rs"]
mod common;

mod exact_wear;
mod fem_contact;
mod fem_elements;
mod fem_gear;
mod fem_stability;
mod flank_points;
mod flank_surface;
mod geometry;
mod half_space;
mod root_stress;
mod slice_coupling;
mod stepping_stability;
mod stiffness;
mod targets;
mod tip_contact;
mod tooth_mesh;
mod wear_run;
mod work_precision;
mod worn_cylinder;
