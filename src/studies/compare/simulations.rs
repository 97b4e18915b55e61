//! Runs of the scene with other wear coefficients, and other factors of severe wear.
//!
//! Depth grows with k p ds in every law, and pressure knows nothing of k: under one load and speed, wear depends on the
//! coefficient k and the revolutions n only through k n. Thus one run that goes on for c times as long holds the wear of every
//! coefficient up to c k, at its snapshots; its wear steps are as long as the scene's up to c = 4, and longer beyond. Where loads or
//! speeds follow one another in phases that is not so, and each coefficient is a run of its own.
//!
//! Where the gears wear by different laws, what is fitted is that of the measured gear, and the mate's stays as it is: each coefficient
//! is then a run of its own too, unless the mate does not wear at all.
//!
//! Whatever lies between such profiles is interpolated; what is fitted in the end is checked by a run with just that coefficient.

use std::f64::consts::LN_2;

use super::wear_by_coefficient::WearByCoefficient;
use crate::gear::Gear;
use crate::observer::{Observer, PartOf};
use crate::pipeline::{self, RunError};
use crate::results::run::StopReason;
use crate::scene::loaded::LoadedScene;
use crate::scene::{Resolved, Scene};
use crate::simulation::settings::LifeLimits;

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum CompareError {
    #[error(transparent)]
    Run(#[from] RunError),
    #[error("interrupted")]
    Interrupted,
}

/// Snapshots of the run that holds all coefficients, at squares of even steps: dense where little is worn.
const SNAPSHOTS: u32 = 40;
/// The same where each is a run of its own.
const SEPARATE_RUNS: u32 = 6;
/// Longer runs have no more wear steps than one of this factor.
const AS_FINE_UP_TO: f64 = 4.0;
/// A curve reaches this much further than the factor it is made for.
const AHEAD: f64 = 2.0;
/// Factors of severe wear whose curves are computed are this far apart, as a logarithm; between them it is interpolated.
const SEVERE_STEP: f64 = LN_2;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Change {
    /// On the wear coefficient.
    pub coefficient_factor: f64,
    /// The factor of severe wear; `None`: the scene's.
    pub severe_factor: Option<f64>,
}

impl Change {
    pub(super) const NOTHING: Self = Self { coefficient_factor: 1.0, severe_factor: None };
}

/// Runs of one scene until the profile was measured.
pub(super) struct Simulations<'a> {
    given: &'a LoadedScene,
    gear: Gear,
    width_mm: Option<f64>,
    /// The scene, ending when the profile was measured, without error estimates.
    until_measured: Scene,
    observer: &'a dyn Observer,
    /// Courses of the scene's factor of severe wear times 2ⁿ, by n.
    courses: Vec<(i32, WearByCoefficient)>,
    pub runs: u64,
    /// Mesh cycles evaluated in them.
    pub mesh_cycles: u64,
}

impl<'a> Simulations<'a> {
    /// Runs of `given` for `revolutions` of the pinion, of which the wear of `gear` at `width_mm` is wanted.
    pub(super) fn new(
        given: &'a LoadedScene,
        gear: Gear,
        width_mm: Option<f64>,
        revolutions: f64,
        observer: &'a dyn Observer,
    ) -> Self {
        let mut scene = given.resolved.scene.clone();
        (scene.numerics.error_estimate, scene.verify) = (false, false);
        let operation = &mut scene.operation;
        operation.phases.truncate(operation.phase_at(revolutions) + 1);
        if let Some(last) = operation.phases.last_mut() {
            last.end_revolutions = revolutions;
        }
        operation.pinion_revolutions = revolutions;
        operation.stop = LifeLimits::default();
        // Those of the scene stay: steps end at them.
        operation.snapshots_revolutions.retain(|&at| at < revolutions);
        operation.snapshots_revolutions.push(revolutions);
        Self { given, gear, width_mm, until_measured: scene, observer, courses: Vec::new(), runs: 0, mesh_cycles: 0 }
    }

    /// The factor of severe wear of the gear in the scene; 1 where there is none.
    pub(super) fn severe_factor(&self) -> f64 {
        self.until_measured.wear[self.gear].severe.map_or(1.0, |severe| severe.factor)
    }

    /// Wear of one row of flank points, by a run with just this change, µm.
    pub(super) fn exactly(&mut self, change: Change) -> Result<Vec<f64>, CompareError> {
        let scene = changed(&self.until_measured, self.gear, change);
        let wear = self.run(scene)?.pop();
        Ok(wear.map(|(_, wear)| wear).unwrap_or_default())
    }

    /// The same, interpolated between profiles that are computed where they are first needed.
    pub(super) fn about(&mut self, change: Change) -> Result<Vec<f64>, CompareError> {
        let factor = change.coefficient_factor;
        let Some(severe) = change.severe_factor else { return Ok(self.course(0, factor)?.at(factor)) };
        let place = (severe / self.severe_factor()).ln() / SEVERE_STEP;
        let before = place.floor();
        // Lagrange's cubic through the curves at −1, 0, 1 and 2.
        let t = place - before;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let mut sum: Vec<f64> = Vec::new();
        for (step, weight) in (-1..).zip(weights) {
            let wear = self.course(before as i32 + step, factor)?.at(factor);
            sum.resize(wear.len(), 0.0);
            sum.iter_mut().zip(&wear).for_each(|(sum, wear)| *sum += weight * wear);
        }
        Ok(sum)
    }

    /// The curve with 2ⁿ times the scene's factor of severe wear, up to this factor at least.
    fn course(&mut self, n: i32, up_to: f64) -> Result<&WearByCoefficient, CompareError> {
        let known = self.courses.iter().position(|(of, _)| *of == n);
        let index = match known {
            Some(index) if self.courses[index].1.reach() >= up_to => index,
            _ => {
                let longest = self.courses.iter().map(|(_, course)| course.reach()).fold(AHEAD * up_to, f64::max);
                let reach = if known.is_some() { AHEAD * up_to } else { longest };
                let course = self.compute(n, reach)?;
                match known {
                    Some(index) => {
                        self.courses[index].1 = course;
                        index
                    }
                    None => {
                        self.courses.push((n, course));
                        self.courses.len() - 1
                    }
                }
            }
        };
        Ok(&self.courses[index].1)
    }

    fn compute(&mut self, n: i32, reach: f64) -> Result<WearByCoefficient, CompareError> {
        let severe_factor = (n != 0).then(|| self.severe_factor() * (f64::from(n) * SEVERE_STEP).exp());
        let squares = |count: u32| (1..=count).map(move |i| reach * (f64::from(i) / f64::from(count)).powi(2));
        if self.until_measured.operation.phases.len() > 1 || !scales_with_time(&self.until_measured, self.gear) {
            let mut profiles = Vec::new();
            for coefficient_factor in squares(SEPARATE_RUNS) {
                profiles.push((coefficient_factor, self.exactly(Change { coefficient_factor, severe_factor })?));
            }
            return Ok(WearByCoefficient::new(profiles));
        }
        let mut scene = changed(&self.until_measured, self.gear, Change { coefficient_factor: 1.0, severe_factor });
        let duration = scene.operation.pinion_revolutions;
        let operation = &mut scene.operation;
        operation.pinion_revolutions = reach * duration;
        operation.phases.iter_mut().for_each(|phase| phase.end_revolutions = reach * duration);
        operation.snapshots_revolutions = squares(SNAPSHOTS).map(|factor| factor * duration).collect();
        scene.numerics.stepping = scene.numerics.stepping.coarser((reach / AS_FINE_UP_TO).max(1.0));
        let profiles = self.run(scene)?;
        Ok(WearByCoefficient::new(profiles.into_iter().map(|(revolutions, wear)| (revolutions / duration, wear))))
    }

    /// Carries a scene out: the wear of the row of points at each snapshot.
    fn run(&mut self, scene: Scene) -> Result<Vec<(f64, Vec<f64>)>, CompareError> {
        self.runs += 1;
        self.observer.stage(&format!("run {}", self.runs));
        let resolved = Resolved { scene, file: self.given.resolved.file.clone(), warnings: Vec::new() };
        let scene = LoadedScene { resolved, ..self.given.clone() };
        let done = pipeline::run(&scene, &PartOf::whole(self.observer));
        if self.observer.interrupted() {
            return Err(CompareError::Interrupted);
        }
        let done = done?;
        if let Some(failure) = done.failure {
            return Err(failure.into());
        }
        if done.record.summary.stopped != StopReason::Completed {
            return Err(CompareError::Interrupted);
        }
        self.mesh_cycles += done.record.summary.work.mesh_cycles;
        let flank = &done.record.flanks[self.gear];
        let rows = done.record.history.iter().zip(&flank.snapshot_wear_um);
        let at_width = |wear_um: &[f64]| over_width(wear_um, &flank.width_mm, flank.radius_mm.len(), self.width_mm);
        Ok(rows.map(|(row, wear_um)| (row.revolutions, at_width(wear_um))).collect())
    }
}

/// The row of `points` at `width_mm` out of rows in slices at `slices_mm`: between their middles by straight lines, outside them
/// that of the outermost.
pub(super) fn over_width(wear_um: &[f64], slices_mm: &[f64], points: usize, width_mm: Option<f64>) -> Vec<f64> {
    let rows: Vec<&[f64]> = wear_um.chunks_exact(points.max(1)).collect();
    let (Some(width), true) = (width_mm, rows.len() > 1) else {
        return rows.first().map(|row| row.to_vec()).unwrap_or_default();
    };
    let after = slices_mm.partition_point(|&middle| middle <= width).clamp(1, rows.len() - 1);
    let (low, high) = (slices_mm[after - 1], slices_mm[after]);
    let t = ((width - low) / (high - low)).clamp(0.0, 1.0);
    rows[after - 1].iter().zip(rows[after]).map(|(a, b)| a + t * (b - a)).collect()
}

/// Whether both gears wear by one law in all phases: its coefficient is then fitted, and otherwise that of the measured gear alone.
pub(super) fn is_of_both(scene: &Scene) -> bool {
    scene.operation.phases.iter().all(|phase| scene.wear_in(phase).are_alike())
}

/// Whether a longer run holds the wear of greater coefficients: where both change in the same way, or the mate does not wear.
fn scales_with_time(scene: &Scene, gear: Gear) -> bool {
    is_of_both(scene)
        || scene.operation.phases.iter().all(|phase| scene.wear_in(phase)[gear.mate()].coefficient_mm2_per_n <= 0.0)
}

/// `scene` with other coefficients, of both gears where they wear by one law, otherwise of `gear` alone.
fn changed(scene: &Scene, gear: Gear, change: Change) -> Scene {
    let both = is_of_both(scene);
    let mut scene = scene.clone();
    for gear in Gear::BOTH.into_iter().filter(|&other| both || other == gear) {
        let wear = &mut scene.wear[gear];
        wear.coefficient_mm2_per_n *= change.coefficient_factor;
        if let (Some(severe), Some(factor)) = (&mut wear.severe, change.severe_factor) {
            severe.factor = factor;
        }
        for phase in &mut scene.operation.phases {
            let own = &mut phase.coefficient_mm2_per_n[gear];
            *own = own.map(|own| own * change.coefficient_factor);
        }
    }
    scene
}
