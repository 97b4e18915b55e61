//! Contact of flanks that wear has tilted.
//!
//! Wear h turns a flank by θ = dh/ds, s from root to tip, and with it the direction of the load: its lever on the gears, and the direction of
//! the deflection. With B⊥ the coupling along the flank and B that across it,
//!
//! ```text
//! B(θ) = B + Θ B⊥      B(θ) C B(θ)ᵀ = B C Bᵀ + Θ B⊥ C Bᵀ + (Θ B⊥ C Bᵀ)ᵀ + Θ B⊥ C B⊥ᵀ Θ      B(θ) r = B r + Θ B⊥ r
//! ```
//!
//! Θ is the same for all multipliers of a contact, the mean of the tilt under its load, whatever waves of wear there are in it. A tooth pair
//! that touches in two places, on the line of action and on a ridge, has a tilt in each. B⊥ C Bᵀ and B⊥ C B⊥ᵀ are calculated once for a
//! position, and only where the tilt matters.

use std::f64::consts::FRAC_PI_2;

use faer::Mat;
use nalgebra::Rotation2;

use super::condensed_pair::CondensedPair;
use super::facing_teeth::{FacingTeeth, turned};
use super::prepared::{PreparedPosition, Sideways};
use super::sandwich::{CarriedRows, ToothRows, mirror_below};
use crate::gear::{Gear, PerGear};

/// Wear of both flanks.
#[derive(Debug, Clone, Copy)]
pub struct Worn<'a> {
    /// Depth h at the nodes, from root to tip, mm.
    pub depth_mm: PerGear<&'a [f64]>,
    /// Tilt dh/ds at the nodes, rad.
    pub tilt_rad: &'a PerGear<Vec<f64>>,
}

impl CondensedPair<'_> {
    /// Sets the tilt of the flanks at each multiplier; the active set stays.
    pub fn tilt(&self, prepared: &mut PreparedPosition, tilt_rad: Vec<f64>) {
        if prepared.sideways.is_none() {
            prepared.sideways = Some(self.sideways(prepared));
        }
        let Some(Sideways { compliance, level_and_along, along_diagonal, level_rigid }) = &prepared.sideways else {
            return;
        };
        let of_rows = &tilt_rad;
        let condensed = &mut prepared.condensed;
        for j in 0..of_rows.len() {
            for i in j..of_rows.len() {
                let turned = of_rows[i] * compliance[(i, j)] + of_rows[j] * compliance[(j, i)];
                let along = if i == j { along_diagonal[j] } else { level_and_along[(j, i)] };
                condensed.compliance[(i, j)] = level_and_along[(i, j)] + turned + of_rows[i] * along * of_rows[j];
            }
            condensed.rigid[(j, 0)] = level_rigid[(j, 0)] + of_rows[j] * prepared.along_rotation[j];
        }
        mirror_below(&mut condensed.compliance);
        (prepared.tilt_rad, prepared.kept) = (tilt_rad, None);
    }

    fn sideways(&self, prepared: &PreparedPosition) -> Sideways {
        let rows = prepared.along_rotation.len();
        let (mut compliance, mut along) = (Mat::zeros(rows, rows), Mat::zeros(rows, rows));
        for gear in Gear::BOTH {
            let across = self.tooth_rows(&prepared.facings, gear);
            let along_flank = |facing: &FacingTeeth| {
                CarriedRows::new(&self.gears[gear], &turned(&facing.operator[gear], Rotation2::new(-FRAC_PI_2)))
            };
            let carried: Vec<CarriedRows> = prepared.facings.iter().map(along_flank).collect();
            let turned: Vec<ToothRows<'_>> = prepared
                .facings
                .iter()
                .zip(&carried)
                .map(|(facing, carried)| {
                    ToothRows::new(&self.gears[gear], facing.tooth[gear], facing.first_row, carried)
                })
                .collect();
            for (a, own) in turned.iter().enumerate() {
                across.iter().for_each(|other| own.add_carried_product(other, &mut compliance));
                turned[..=a].iter().for_each(|other| own.add_carried_product(other, &mut along));
                ToothRows::held_products(&[&across[a], own], &mut |kinds, [i, j], entry| match kinds {
                    [1, 0] => compliance[(i, j)] += entry,
                    [0, 1] if i != j => compliance[(j, i)] += entry,
                    [1, 1] => along[(i, j)] += entry,
                    _ => {}
                });
            }
        }
        let along_diagonal = (0..rows).map(|k| along[(k, k)]).collect();
        mirror_below(&mut along);
        along.copy_from_triangular_lower(&prepared.condensed.compliance);
        let level_rigid = prepared.condensed.rigid.clone();
        Sideways { compliance, level_and_along: along, along_diagonal, level_rigid }
    }
}

impl PreparedPosition {
    /// Tilt of the flanks at a multiplier, rad.
    pub fn tilt_rad(&self, row: usize) -> f64 {
        self.tilt_rad.get(row).copied().unwrap_or(0.0)
    }

    /// Mean tilt at each multiplier under `force`, from `tilt_rad` at the local nodes of a gear's flank, rad.
    pub fn mean_tilts(&self, force: &[f64], tilt_rad: impl Fn(Gear, usize) -> f64) -> Vec<f64> {
        let mut of_rows = vec![0.0; force.len()];
        for facing in &self.facings {
            facing.set_mean_tilts(force, |node| tilt_rad(facing.slave, node), &mut of_rows);
        }
        of_rows
    }

    /// Greatest relative change of the levers on the pinion of the tooth pairs' loads `force` where the flanks tilt to `tilt_rad` at the
    /// multipliers, times the fraction of the load on the other pairs: with one loaded pair a tilt changes no load.
    pub fn lever_change(&self, force: &[f64], tilt_rad: &[f64]) -> f64 {
        let mut pairs: Vec<(f64, f64)> = Vec::with_capacity(self.facings.len());
        for facing in &self.facings {
            let (mut own, mut change) = (0.0, 0.0);
            for row in facing.first_row..facing.first_row + facing.coupling.len() {
                own -= force[row] * self.condensed.rigid[(row, 0)];
                change -= force[row] * (tilt_rad[row] - self.tilt_rad(row)) * self.along_rotation[row];
            }
            pairs.push((own, change));
        }
        let whole: f64 = pairs.iter().map(|(own, _)| own).sum();
        let loaded = pairs.iter().filter(|(own, _)| *own > 0.0);
        loaded.map(|(own, change)| (change / own).abs() * (1.0 - own / whole)).fold(0.0, f64::max)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::gear::GearPair;
    use crate::gear::modification::Modification;
    use crate::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};
    use crate::gear_mesh::settings::{BodySettings, default_clamp};
    use gearwear_fem::elastic::Elastic;

    /// FZG type A gears with sharp tips (DIN 51354-1).
    pub(in crate::gear_fem) fn fzg_a() -> GearPair {
        let gears = PerGear { pinion: (16, 0.8635), wheel: (24, -0.5103) }.map(|(teeth, profile_shift)| GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: None,
            tooth_thickness_allowance_mm: 0.0,
            bore_diameter_mm: None,
            modification: Modification::default(),
            measured_flank: None,
            shaft: None,
            ring: None,
            tip_chamfer: None,
        });
        let spec = PairSpec {
            normal_module_mm: 4.5,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 0.0,
            centre_distance_mm: 91.5,
            face_width_mm: 20.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears,
        };
        GearPair::new(&spec).expect("the pair of the test exists")
    }

    const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };

    /// Both gears of steel, under 300 N/mm, with two elements in a half-width.
    pub(in crate::gear_fem) fn condensed_fzg_a(pair: &GearPair) -> CondensedPair<'_> {
        let clamp_radius_mm = PerGear::from_fn(|gear| {
            default_clamp(pair.teeth[gear].root_radius_mm, pair.spec.normal_module_mm).radius_mm
        });
        let settings = BodySettings::rings(clamp_radius_mm, 2.0);
        let material = PerGear { pinion: STEEL, wheel: STEEL };
        let model = CondensedPair::build(pair, &material, 300.0, &settings, &|_| {});
        model.expect("the pair of the test can be condensed")
    }

    /// Tilting gives the compliance B(θ) C B(θ)ᵀ of the tilted coupling, C being that of the teeth by their cuts, also of a softer gear; what cuts carry
    /// is spanned by few shapes.
    #[test]
    fn the_compliance_is_that_of_the_tilted_coupling() {
        let pair = fzg_a();
        let line_load_n_per_mm = 300.0;
        let material = PerGear { pinion: STEEL, wheel: STEEL };
        let soft = PerGear { pinion: Elastic { young_modulus_mpa: 2e3, ..STEEL }, wheel: STEEL };
        let model = condensed_fzg_a(&pair).with_moduli(&material, &soft);
        let mut prepared = model.prepare(pair.path.start_mm + 2.0, line_load_n_per_mm);
        let tilt_rad: Vec<f64> = (0..prepared.along_rotation.len()).map(|row| 0.3 * (row as f64).sin()).collect();
        model.tilt(&mut prepared, tilt_rad.clone());
        let mut expected = Mat::zeros(tilt_rad.len(), tilt_rad.len());
        for gear in Gear::BOTH {
            let compliance = &model.gears[gear];
            assert!(compliance.shapes().nrows() < 60, "{} shapes", compliance.shapes().nrows());
            let rows = prepared.facings.iter().map(|facing| {
                let (across, candidates) = (&facing.operator[gear], compliance.shapes().ncols());
                let along = turned(across, Rotation2::new(-FRAC_PI_2));
                let mut rows = Mat::zeros(across.rows(), candidates);
                for row in 0..across.rows() {
                    let tilt_rad = tilt_rad[facing.first_row + row];
                    for (operator, part) in [(across, 1.0), (&along, tilt_rad)] {
                        let entries = operator.outer_view(row).expect("there is one");
                        entries.iter().for_each(|(column, value)| rows[(row, column)] += part * value);
                    }
                }
                rows
            });
            let rows: Vec<Mat<f64>> = rows.collect();
            for (one, own) in prepared.facings.iter().zip(&rows) {
                for (other, others) in prepared.facings.iter().zip(&rows) {
                    let product =
                        own * compliance.between_teeth(one.tooth[gear], other.tooth[gear]) * others.transpose();
                    let mut part = expected.get_mut(one.rows(), other.rows());
                    part += product;
                }
            }
        }
        assert!(prepared.facings.len() > 1, "two pairs are in contact");
        let off = (&prepared.condensed.compliance - &expected).norm_max();
        assert!(off < 1e-10 * expected.norm_max(), "{off} of {}", expected.norm_max());
    }
}
