//! Wear laws: how fast a flank point loses material under pressure and sliding.

pub mod archard;
pub mod settings;

/// A local wear law: depth worn from a surface point by sliding under pressure.
///
/// Working on whole rows of points keeps the law out of the inner loop's way.
pub trait WearLaw: Sync {
    /// Adds to each point's depth (mm) what it loses under its pressure (MPa) over its sliding distance (mm).
    fn add_depth(&self, pressure_mpa: &[f64], sliding_mm: &[f64], depth_mm: &mut [f64]);

    /// The greatest rate of depth per sliding distance and pressure the law can give, mm²/N: bounds the stable wear step.
    fn greatest_coefficient_mm2_per_n(&self) -> f64;
}
