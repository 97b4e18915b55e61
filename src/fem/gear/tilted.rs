//! Flanks that wear has tilted.
//!
//! Wear h turns a flank by θ = dh/ds, s from root to tip, and with it the direction in which the flanks press on each other: the lever of
//! the load on the gears, and where the teeth give way to. With B⊥ the coupling along the flank where B is that across it,
//!
//! ```text
//! B(θ) = B + Θ B⊥      B(θ) C B(θ)ᵀ = B C Bᵀ + Θ B⊥ C Bᵀ + (Θ B⊥ C Bᵀ)ᵀ      B(θ) r = B r + Θ B⊥ r
//! ```
//!
//! but for θ², with Θ the tilt at every multiplier. B⊥ C Bᵀ is found once for a position, and only where the tilt matters.

use std::f64::consts::FRAC_PI_2;

use faer::Mat;
use nalgebra::Rotation2;

use super::facing::{Facing, turned};
use super::position::CondensedPair;
use super::prepared::{Prepared, add_sandwich};
use crate::gear::{Gear, PerGear};

/// What flanks have lost and how that tilts them.
#[derive(Debug, Clone, Copy)]
pub struct Worn<'a> {
    /// Depth at the nodes, from root to tip, mm.
    pub depth_mm: PerGear<&'a [f64]>,
    /// dh/ds there, rad.
    pub tilt_rad: &'a PerGear<Vec<f64>>,
}

/// A position along the flanks, and as it was before it was tilted.
pub(super) struct Sideways {
    /// B⊥ C Bᵀ.
    compliance: Mat<f64>,
    level_compliance: Mat<f64>,
    level_rigid: Mat<f64>,
}

impl CondensedPair<'_> {
    /// Takes the flanks with the multipliers to be tilted by `tilt_rad`, by gear and local node; contact goes on from where it is.
    pub fn tilt(&self, prepared: &mut Prepared, tilt_rad: impl Fn(Gear, usize) -> f64) {
        let rows =
            prepared.facings.iter().flat_map(|facing| facing.coupling.nodes.iter().map(|&node| (facing.slave, node)));
        let tilt_rad: Vec<f64> = rows.map(|(slave, node)| tilt_rad(slave, node)).collect();
        if prepared.sideways.is_none() {
            prepared.sideways = Some(self.sideways(prepared));
        }
        let Some(Sideways { compliance, level_compliance, level_rigid }) = &prepared.sideways else { return };
        let condensed = &mut prepared.condensed;
        for j in 0..tilt_rad.len() {
            for i in 0..tilt_rad.len() {
                let turned = tilt_rad[i] * compliance[(i, j)] + tilt_rad[j] * compliance[(j, i)];
                condensed.compliance[(i, j)] = level_compliance[(i, j)] + turned;
            }
            condensed.rigid[(j, 0)] = level_rigid[(j, 0)] + tilt_rad[j] * prepared.along_rotation[j];
        }
        (prepared.tilt_rad, prepared.kept) = (tilt_rad, None);
    }

    fn sideways(&self, prepared: &Prepared) -> Sideways {
        let rows = prepared.along_rotation.len();
        let mut compliance = Mat::zeros(rows, rows);
        for gear in Gear::BOTH {
            for facing in &prepared.facings {
                let along = turned(&facing.operator[gear], Rotation2::new(-FRAC_PI_2));
                for other in &prepared.facings {
                    let between = self.gears[gear].between(other.tooth[gear], facing.tooth[gear]);
                    let places = (facing.first_row, other.first_row);
                    add_sandwich(&mut compliance, places, &along, between, &other.operator[gear], false);
                }
            }
        }
        Sideways {
            compliance,
            level_compliance: prepared.condensed.compliance.clone(),
            level_rigid: prepared.condensed.rigid.clone(),
        }
    }
}

impl Prepared {
    /// Is again as if its flanks had never been tilted, and never been solved.
    pub(super) fn level(&mut self) {
        (self.active, self.kept) = (None, None);
        if let Some(Sideways { level_compliance, level_rigid, .. }) = &self.sideways {
            self.condensed.compliance.copy_from(level_compliance);
            self.condensed.rigid.copy_from(level_rigid);
            self.tilt_rad.clear();
        }
    }

    /// How much the levers of the tooth pairs' loads change on the pinion under `force` where the flanks tilt to `tilt_rad`, by gear and local node, each
    /// over itself and times the part of the load that the others carry: where one pair carries all, nothing changes but its lever.
    pub fn lever_change(&self, force: &[f64], tilt_rad: impl Fn(Gear, usize) -> f64) -> f64 {
        let known = |row: usize| self.tilt_rad.get(row).unwrap_or(&0.0);
        let of_pair = |facing: &Facing| {
            let (mut own, mut change) = (0.0, 0.0);
            for (i, &node) in facing.coupling.nodes.iter().enumerate() {
                let row = facing.first_row + i;
                if force[row] > 0.0 {
                    own -= force[row] * self.condensed.rigid[(row, 0)];
                    change -= force[row] * (tilt_rad(facing.slave, node) - known(row)) * self.along_rotation[row];
                }
            }
            (own, change)
        };
        let pairs: Vec<(f64, f64)> = self.facings.iter().map(of_pair).collect();
        let whole: f64 = pairs.iter().map(|(own, _)| own).sum();
        let shared =
            pairs.iter().filter(|(own, _)| *own > 0.0).map(|(own, change)| (change / own).abs() * (1.0 - own / whole));
        shared.fold(0.0, f64::max)
    }
}
