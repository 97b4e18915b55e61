//! Wear of both gears against revolutions under the run's own coefficients: one run of the scene, as long as what was measured and the limits ask for.
//!
//! Depth grows with k p ds in every wear law, and pressure knows nothing of k. Under one load and speed wear is a function of k n alone, where the
//! coefficients of both gears change alike: the wear of a gear with κ times its coefficient after n revolutions is that of the run after κ n.
//! Phases of several loads are no such case.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank::FlankGrid};
use gearwear_bodies::reference::linear_means::value_at;
use gearwear_physics::assessment::RunError;
use gearwear_physics::observer::{Observer, PartOf};
use gearwear_physics::results::run::{RunRecord, StopReason};
use gearwear_physics::simulation::settings::LifeLimits;

use super::wear_table::WearKind;
use crate::compare::study::CompareError;

/// Snapshots of the run, at squares of even steps: dense where little is worn.
const SNAPSHOTS: u32 = 60;
/// Factor on the duration up to which the number of wear steps rises with it.
const AS_FINE_UP_TO: f64 = 4.0;
/// Factor by which a curve reaches beyond the wear asked for.
const AHEAD: f64 = 1.7;
/// Longest run, over the run of the scene.
pub const LONGEST: f64 = 50.0;
/// Shortest run, over the run of the scene.
const SHORTEST: f64 = 0.02;
/// Runs until the wear asked for is reached.
const MOST_RUNS: usize = 4;

/// A quantity of worn gears that can be measured or limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WearQuantity {
    /// Maximum depth on the active profile, its tip edge apart, µm.
    PeakDepth,
    /// Mass lost by the whole gear, mg.
    Mass,
    /// Volume lost by the whole gear, mm³.
    Volume,
}

impl WearQuantity {
    /// Quantity that a measurement of a kind gives; none of a profile, which gives the coefficient.
    pub fn of_kind(kind: WearKind) -> Option<Self> {
        match kind {
            WearKind::Mass => Some(WearQuantity::Mass),
            WearKind::Depth => Some(WearQuantity::PeakDepth),
            WearKind::Profile => None,
        }
    }

    /// Main figure of a gear.
    pub fn figure(self) -> &'static str {
        match self {
            WearQuantity::PeakDepth => "peak_wear_um",
            WearQuantity::Mass => "worn_mass_mg",
            WearQuantity::Volume => "worn_volume_mm3",
        }
    }

    /// Name with its unit.
    pub fn words(self) -> &'static str {
        match self {
            WearQuantity::PeakDepth => "maximum wear depth, µm",
            WearQuantity::Mass => "worn mass, mg",
            WearQuantity::Volume => "worn volume, mm³",
        }
    }
}

/// Wear of one gear at rising revolutions of the pinion, nothing at 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WearCurve {
    pub revolutions: Vec<f64>,
    pub peak_depth_um: Vec<f64>,
    pub mass_mg: Vec<f64>,
    pub volume_mm3: Vec<f64>,
}

impl WearCurve {
    pub fn values(&self, quantity: WearQuantity) -> &[f64] {
        match quantity {
            WearQuantity::PeakDepth => &self.peak_depth_um,
            WearQuantity::Mass => &self.mass_mg,
            WearQuantity::Volume => &self.volume_mm3,
        }
    }

    /// Last revolutions of the curve.
    pub fn end(&self) -> f64 {
        self.revolutions.last().copied().unwrap_or_default()
    }

    /// Wear after `revolutions`; `None` beyond the end of the curve.
    pub fn value_at(&self, quantity: WearQuantity, revolutions: f64) -> Option<f64> {
        let is_inside = (0.0..=self.end()).contains(&revolutions) && self.revolutions.len() > 1;
        is_inside.then(|| value_at(&self.revolutions, self.values(quantity), revolutions))
    }

    /// Revolutions, or exposure, after which the wear is `value` (above 0); `None` where the curve does not come to it.
    pub fn exposure_of(&self, quantity: WearQuantity, value: f64) -> Option<f64> {
        let values = self.values(quantity);
        let after = values.iter().position(|&reached| reached >= value)?.max(1);
        let (low, high) = (values[after - 1], values[after]);
        let (from, to) = (self.revolutions[after - 1], self.revolutions[after]);
        Some(from + (to - from) * (value - low) / (high - low))
    }

    /// d ln(exposure)/d ln(wear) about an exposure on the curve.
    pub fn elasticity(&self, quantity: WearQuantity, exposure: f64) -> f64 {
        let after = self.revolutions.partition_point(|&at| at < exposure).clamp(1, self.revolutions.len() - 1);
        let values = self.values(quantity);
        let slope = (values[after] - values[after - 1]) / (self.revolutions[after] - self.revolutions[after - 1]);
        value_at(&self.revolutions, values, exposure) / (slope * exposure)
    }
}

/// Curves of both gears, and the runs that they took.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedWear {
    pub curves: PerGear<WearCurve>,
    pub runs: u64,
    pub mesh_cycles: u64,
}

/// Wear that a curve of a gear has to come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearNeeded {
    pub gear: Gear,
    pub quantity: WearQuantity,
    pub value: f64,
}

/// Why there is no curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WearCurveError {
    #[error(transparent)]
    Run(#[from] CompareError),
    #[error(
        "{gear}.{figure}: found {value}, which takes more than {longest:.3e} pinion revolutions under the coefficients of the run; allowed: up to {LONGEST} \
         times the run: a run with operation.pinion_revolutions that come nearer"
    )]
    BeyondRun { gear: &'static str, figure: &'static str, value: f64, longest: f64 },
}

/// Runs the scene until all of `needed` is reached and somewhat beyond, each with the wear at the end of the scene's own run beside it, and all
/// exposures up to `exposure`; with the coefficient of the wheel times `ratio`, whose curve is by exposure to its own coefficient all the same.
///
/// # Errors
/// A run that fails before, is interrupted, or would be too long.
pub fn simulated_wear(
    given: &LoadedScene,
    pair: &GearPair,
    ratio: f64,
    needed: &[(WearNeeded, f64)],
    exposure: f64,
    observer: &dyn Observer,
) -> Result<SimulatedWear, WearCurveError> {
    let duration = given.resolved.scene.operation.pinion_revolutions;
    let reaches = needed.iter().map(|(needed, of_run)| needed.value / of_run.max(f64::MIN_POSITIVE));
    let reach = reaches.fold(exposure / duration, f64::max);
    let mut reach = (AHEAD * reach * ratio.recip().max(1.0)).clamp(SHORTEST, LONGEST);
    let (mut runs, mut mesh_cycles) = (0, 0);
    loop {
        observer.stage("run");
        let done = longer(given, reach, ratio, observer)?;
        (runs, mesh_cycles) = (runs + 1, mesh_cycles + done.record.summary.work.mesh_cycles);
        let curves = PerGear::from_fn(|gear| {
            curve(&done.record, given, pair, gear, if gear == Gear::Wheel { ratio } else { 1.0 })
        });
        let lacking = needed.iter().map(|(needed, _)| needed).find(|needed| {
            let reached = curves[needed.gear].values(needed.quantity).last();
            reached.is_none_or(|&reached| reached < needed.value)
        });
        let Some(lacking) = lacking else { return Ok(SimulatedWear { curves, runs, mesh_cycles }) };
        if let Some(failure) = done.failure {
            return Err(CompareError::Run(failure).into());
        }
        let reached = curves[lacking.gear].values(lacking.quantity).last().copied().unwrap_or_default();
        if reach >= LONGEST || runs as usize >= MOST_RUNS {
            let WearNeeded { gear, quantity, value } = *lacking;
            let longest = reach * duration;
            return Err(WearCurveError::BeyondRun { gear: gear.name(), figure: quantity.figure(), value, longest });
        }
        reach = (AHEAD * reach * (lacking.value / reached.max(f64::MIN_POSITIVE)).max(AHEAD)).min(LONGEST);
    }
}

/// The scene `reach` times as long, with snapshots all along, without limits, estimates of errors and verification.
fn longer(
    given: &LoadedScene,
    reach: f64,
    ratio: f64,
    observer: &dyn Observer,
) -> Result<gearwear_physics::assessment::Done, CompareError> {
    let mut scene = given.resolved.scene.clone();
    (scene.numerics.error_estimate, scene.verify) = (false, false);
    scene.wear.wheel.coefficient_mm2_per_n *= ratio;
    let operation = &mut scene.operation;
    for phase in &mut operation.phases {
        let own = &mut phase.coefficient_mm2_per_n.wheel;
        *own = own.map(|own| own * ratio);
    }
    let duration = reach * operation.pinion_revolutions;
    operation.pinion_revolutions = duration;
    operation.phases.iter_mut().for_each(|phase| phase.end_revolutions = duration);
    operation.stop = LifeLimits::default();
    let squares = (1..=SNAPSHOTS).map(|i| duration * (f64::from(i) / f64::from(SNAPSHOTS)).powi(2));
    operation.snapshots_revolutions = squares.collect();
    scene.numerics.stepping = scene.numerics.stepping.coarser((reach / AS_FINE_UP_TO).max(1.0));
    let resolved = Resolved { scene, file: given.resolved.file.clone(), warnings: Vec::new() };
    let scene = LoadedScene { resolved, ..given.clone() }.without_torque_curve();
    let done = runs::run(&scene, &PartOf::whole(observer))?;
    if observer.interrupted() || done.record.summary.stopped == StopReason::Interrupted {
        return Err(CompareError::Interrupted);
    }
    Ok(done)
}

/// Wear of a gear at the snapshots of a run with `factor` times its coefficient.
fn curve(record: &RunRecord, given: &LoadedScene, pair: &GearPair, gear: Gear, factor: f64) -> WearCurve {
    let scene = &given.resolved.scene;
    let flank = &record.flanks[gear];
    let grid = FlankGrid::new(pair, gear, scene.numerics.flank_points, scene.numerics.point_spacing);
    let volume = |wear_um: &[f64]| {
        let slices = wear_um.chunks_exact(grid.len());
        let count = slices.len() as f64;
        1e-3 * pair.over_all_flanks(gear, slices.map(|slice| grid.integral(slice)).sum::<f64>() / count)
    };
    // Finite elements count what is lost at their nodes, which is told of the end alone.
    let summary = [&record.summary.pinion, &record.summary.wheel][gear as usize];
    let at_end = volume(&flank.wear_um);
    let exact = if at_end > 0.0 { summary.worn_volume_mm3 / at_end } else { 1.0 };
    let density_mg_per_mm3 = 1e-3 * scene.material[gear].density_kg_per_m3;
    let mut curve =
        WearCurve { revolutions: vec![0.0], peak_depth_um: vec![0.0], mass_mg: vec![0.0], volume_mm3: vec![0.0] };
    for (row, wear_um) in record.history.iter().zip(&flank.snapshot_wear_um) {
        let volume_mm3 = exact * volume(wear_um);
        curve.revolutions.push(factor * row.revolutions);
        curve.peak_depth_um.push(match gear {
            Gear::Pinion => row.pinion_peak_wear_um,
            Gear::Wheel => row.wheel_peak_wear_um,
        });
        curve.volume_mm3.push(volume_mm3);
        curve.mass_mg.push(density_mg_per_mm3 * volume_mm3);
    }
    curve
}

impl From<RunError> for WearCurveError {
    fn from(error: RunError) -> Self {
        CompareError::Run(error).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// h = √n at the squares, where interpolation is exact; d ln n/d ln h = 2, by differences over a fine curve.
    #[test]
    fn ver_exposures_are_the_inverse_of_wear() {
        let depths: Vec<f64> = (0..=400).map(|i| 0.01 * f64::from(i)).collect();
        let squares: Vec<f64> = depths.iter().map(|depth| depth * depth).collect();
        let curve = WearCurve { revolutions: squares, peak_depth_um: depths, ..WearCurve::default() };
        for depth in [0.01, 1.0, 2.5, 4.0] {
            let exposure = curve.exposure_of(WearQuantity::PeakDepth, depth).unwrap();
            assert!((exposure - depth * depth).abs() < 1e-12, "{depth}: {exposure}");
            assert_eq!(
                curve.value_at(WearQuantity::PeakDepth, exposure).map(|found| (found - depth).abs() < 1e-12),
                Some(true)
            );
        }
        let elasticity = curve.elasticity(WearQuantity::PeakDepth, 4.0);
        assert!((elasticity - 2.0).abs() < 0.02, "{elasticity}");
        assert_eq!(curve.exposure_of(WearQuantity::PeakDepth, 4.01), None);
        assert_eq!(curve.value_at(WearQuantity::PeakDepth, 16.01), None);
    }
}
