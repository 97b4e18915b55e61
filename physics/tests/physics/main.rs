//! Gear geometry, contact, stiffness and wear by the physics alone: no scene file, no report.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

#[path = "../common/mod.rs"]
mod common;

mod backlash;
mod calibration;
mod exact_wear;
mod fem_contact;
mod fem_elements;
mod fem_gear;
mod fem_stability;
mod fem_wear;
mod flank_ends;
mod flank_points;
mod flank_surface;
mod geometry;
mod half_space;
mod helical;
mod helical_convergence;
mod helical_targets;
mod internal_fem;
mod internal_gears;
mod lubrication;
mod ring_on_pins;
mod root_stress;
mod shaft;
mod simplified;
mod slice_coupling;
mod stepping_stability;
mod stiffness;
mod stiffness_curve;
mod targets;
mod teeth_in_space;
mod temperature;
mod tip_chamfer;
mod tip_contact;
mod tooth_mesh;
mod wear_run;
mod work_precision;
mod worn_cylinder;
