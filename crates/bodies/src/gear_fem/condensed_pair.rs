//! Gear pair whose gears are condensed onto the flanks that may touch.

use super::flank_surface::MeshedFlank;
use super::ring::GearCompliance;
use crate::gear::{GearPair, PerGear};
use crate::material::contact_modulus_mpa;
use crate::reference::hertz_line::HertzLine;
use gearwear_fem::elastic::Elastic;

/// Gear pair with both gears condensed.
pub struct CondensedPair<'a> {
    /// Geometry.
    pub pair: &'a GearPair,
    /// Both gears.
    pub gears: PerGear<GearCompliance>,
    /// Working flanks of both gears.
    pub flanks: PerGear<MeshedFlank>,
    /// Contact modulus E*, MPa.
    pub contact_modulus_mpa: f64,
}

impl CondensedPair<'_> {
    /// Beginning of the base pitch that represents the mesh cycle: half of it before the middle of A–E, so that the loads stay as near to the
    /// middle tooth of a sector as possible.
    pub fn first_position_mm(&self) -> f64 {
        let path = &self.pair.path;
        path.start_mm.midpoint(path.end_mm) - 0.5 * path.base_pitch_mm
    }

    /// Range before A and after E in which contact is found in that base pitch, mm of path: limited by the tip circles and by the number of
    /// fine teeth.
    pub fn range_mm(&self) -> [f64; 2] {
        let (path, beside) = (&self.pair.path, (self.gears.pinion.teeth().min(self.gears.wheel.teeth()) / 2) as f64);
        let of_teeth_mm = (beside + 0.5 - 0.5 * path.contact_ratio()) * path.base_pitch_mm;
        self.pair.farthest_touch_mm().map(|farthest_mm| farthest_mm.min(of_teeth_mm))
    }

    /// Pair with other Young's moduli and the same Poisson's ratios, by scaling.
    pub fn with_moduli(&self, condensed: &PerGear<Elastic>, own: &PerGear<Elastic>) -> Self {
        let softness = PerGear::from_fn(|gear| condensed[gear].young_modulus_mpa / own[gear].young_modulus_mpa);
        Self {
            pair: self.pair,
            gears: PerGear::from_fn(|gear| self.gears[gear].softened(softness[gear])),
            flanks: self.flanks.clone(),
            contact_modulus_mpa: contact_modulus_mpa(*own),
        }
    }
}

/// Hertz half-width under the whole load at `position_mm`, before A and after E that at A and E.
pub fn hertz_half_width_mm(
    pair: &GearPair,
    contact_modulus_mpa: f64,
    line_load_n_per_mm: f64,
    position_mm: f64,
) -> f64 {
    let position_mm = position_mm.clamp(pair.path.start_mm, pair.path.end_mm);
    let rho = PerGear::from_fn(|gear| pair.path.rho_mm(gear, position_mm));
    let relative_radius_mm = rho.pinion * rho.wheel / rho.sum();
    HertzLine::of_relative_radius(relative_radius_mm, contact_modulus_mpa).loaded(line_load_n_per_mm).half_width_mm
}
