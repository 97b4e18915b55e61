//! Comparison of the condensed model with the whole model without condensation.

use std::time::Instant;

use super::FemPairError;
use crate::assessment::UM_PER_MM;
use crate::results::fem_pair::FullModelSummary;
use gearwear_bodies::gear::{GearPair, PerGear};
use gearwear_bodies::gear_fem::full;
use gearwear_bodies::gear_fem::model::MeshedGear;
use gearwear_bodies::gear_fem::position::PositionContact;
use gearwear_fem::elastic::Elastic;

/// Whole model of both gears.
pub(super) struct WholeModel<'a> {
    pub pair: &'a GearPair,
    pub meshed: &'a PerGear<MeshedGear>,
    pub material: &'a PerGear<Elastic>,
    pub line_load_n_per_mm: f64,
}

impl WholeModel<'_> {
    /// Solves at the position of `condensed`, and compares.
    pub(super) fn against(&self, condensed: &PositionContact) -> Result<FullModelSummary, FemPairError> {
        let start = Instant::now();
        let position_mm = condensed.position_mm;
        let found = full::solve(self.pair, self.meshed, self.material, self.line_load_n_per_mm, condensed)
            .map_err(|source| FemPairError::Full { position_mm, source: Box::new(source) })?;
        let (mut load, mut pressure) = (0.0_f64, 0.0_f64);
        for contact in &condensed.pairs {
            load = load.max((value_of(&found.line_load_n_per_mm, contact.pair) - contact.line_load_n_per_mm).abs());
            let ratio = value_of(&found.peak_pressure_mpa, contact.pair) / contact.peak_pressure_mpa;
            pressure = pressure.max((ratio - 1.0).abs());
        }
        Ok(FullModelSummary {
            position_mm,
            dofs: found.dofs,
            transmission_error_um: found.transmission_error_mm * UM_PER_MM,
            transmission_error_difference: found.transmission_error_mm / condensed.transmission_error_mm - 1.0,
            line_load_difference: load / self.line_load_n_per_mm,
            peak_pressure_difference: pressure,
            residual: found.residual,
            iterations: found.iterations,
            wall_s: start.elapsed().as_secs_f64(),
        })
    }
}

/// Value of a pair in the whole model; 0 where that does not load it.
fn value_of(values: &[(i32, f64)], pair: i32) -> f64 {
    values.iter().find(|(number, _)| *number == pair).map_or(0.0, |(_, value)| *value)
}
