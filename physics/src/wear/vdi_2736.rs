//! Mean wear of a plastic gear by VDI 2736-2, with which designers compare a permissible one.
//!
//! ```text
//! W_m = k_W 2π T N H_V / (b z l_Fl)          l_Fl = (r_a² − r_SAP²) / (2 r_b)
//! ```
//!
//! T and N torque and revolutions of either gear, N as often as mates run on it, H_V Ohlendorf's loss factor, l_Fl the length of the active flank. W_m is the mean over that length of
//! the depth by Archard's law on an unchanged flank whose load is shared by halves where two pairs are in mesh.
//!
//! Source: VDI 2736-2:2014; the report of `validation/plastic-pair`.

use std::f64::consts::TAU;

use crate::lubrication::loss;
use gearwear_bodies::gear::{Gear, GearPair};

/// A stretch of operation under constant torque with a constant wear coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyWear {
    /// k_W, mm²/N.
    pub coefficient_mm2_per_n: f64,
    /// N·mm.
    pub pinion_torque_n_mm: f64,
    /// Revolutions of the pinion, times the mates of the gear.
    pub revolutions: f64,
}

/// W_m of `gear` after stretches of steady wear, mm.
pub fn mean_wear_mm(pair: &GearPair, gear: Gear, stretches: impl Iterator<Item = SteadyWear>) -> f64 {
    let tooth = &pair.teeth[gear];
    let [tip, start] = [tooth.edge_radius_mm(), pair.active_start_radius_mm(gear)].map(|radius| radius.powi(2));
    let flank_mm = (tip - start) / (2.0 * tooth.involute.base_radius_mm);
    let volumes = stretches.map(|own| own.coefficient_mm2_per_n * TAU * own.pinion_torque_n_mm * own.revolutions);
    let volume_mm3 = loss::of_pair(pair) * volumes.sum::<f64>();
    volume_mm3 / (pair.spec.face_width_mm * f64::from(tooth.teeth) * flank_mm)
}
