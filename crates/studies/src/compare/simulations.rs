//! Runs of the scene with other wear coefficients, and other factors of severe wear.
//!
//! Depth grows with k p ds in every law, and pressure knows nothing of k: under one load and speed, wear depends on the
//! coefficients and the revolutions n only through k₁ n and k₂ n, those of the pinion and of the wheel. Thus one run that goes on for c times
//! as long holds the wear of all coefficients up to c k₁ and c k₂ of one ratio, at its snapshots; its wear steps are as long as the
//! scene's up to c = 4, and longer beyond. Where loads or speeds follow one another in phases that is not so, and each coefficient is a run
//! of its own.
//!
//! Where the coefficients of both gears are fitted, each to its own value, such a run is made for some ratios k₂/k₁, and the wear of a gear
//! under its own coefficient is interpolated between them: what the mate's coefficient does to it, through the pressure on the worn
//! flanks, is little beside what its own does. It is the same for factors of severe wear.
//!
//! Where the gears wear by different laws and one of them was measured, its coefficient is fitted, and the mate's stays as it is: each
//! coefficient is then a run of its own too, unless the mate does not wear at all.
//!
//! Whatever lies between such profiles is interpolated; what is fitted in the end is checked by a run with just those coefficients.

use std::f64::consts::LN_2;

use super::question::{ComparisonQuestion, FittedGears, scale_coefficients};
use super::wear_by_coefficient::WearByCoefficient;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::assessment::RunError;
use gearwear_physics::observer::{Observer, PartOf};
use gearwear_physics::operation::Scene;
use gearwear_physics::results::run::StopReason;
use gearwear_physics::simulation::settings::LifeLimits;

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompareError {
    #[error(transparent)]
    Run(#[from] RunError),
    #[error("interrupted")]
    Interrupted,
}

/// Snapshots of the run that holds all coefficients, at squares of even steps: dense where little is worn.
const SNAPSHOTS: u32 = 40;
/// Number of simulations where each is a run of its own.
const SEPARATE_RUNS: u32 = 6;
/// Factor on the duration up to which the number of wear steps rises with it.
const AS_FINE_UP_TO: f64 = 4.0;
/// Factor by which a curve reaches beyond the factor asked for.
const AHEAD: f64 = 2.0;
/// Logarithmic spacing of the factors of severe wear, or ratios of the coefficients, for which curves are computed; between them it is interpolated.
const STEP: f64 = LN_2;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CoefficientChange {
    /// On the wear coefficient of each gear.
    pub coefficient_factor: PerGear<f64>,
    /// The factor of severe wear; `None`: the scene's.
    pub severe_factor: Option<f64>,
}

impl CoefficientChange {
    pub(super) const NOTHING: Self =
        Self { coefficient_factor: PerGear { pinion: 1.0, wheel: 1.0 }, severe_factor: None };
}

/// Wear as a function of the factor on the wear coefficients, at one factor of severe wear and one ratio of the coefficients.
struct Course {
    /// Number of the curve: its factor of severe wear, or ratio of the wheel's coefficient to the pinion's, is the scene's times 2ⁿ.
    n: i32,
    /// Greatest factor of the curve.
    reach: f64,
    /// Wear of each profile.
    wear: Vec<WearByCoefficient>,
}

/// Wear of the flank points of each profile.
struct ProfileSnapshot {
    revolutions: f64,
    wear_um: Vec<Vec<f64>>,
}

/// Runs of one scene until the profiles were measured.
pub(super) struct Simulations<'a> {
    given: &'a LoadedScene,
    question: &'a ComparisonQuestion,
    /// The scene, ending when the last profile was measured, without error estimates.
    until_measured: Scene,
    observer: &'a dyn Observer,
    courses: Vec<Course>,
    /// What its runs are called for the observer, before their number.
    pub name: &'static str,
    pub runs: u64,
    /// Mesh cycles evaluated in them.
    pub mesh_cycles: u64,
}

impl<'a> Simulations<'a> {
    /// Runs of `given` up to the time of each profile of `question`.
    pub(super) fn new(given: &'a LoadedScene, question: &'a ComparisonQuestion, observer: &'a dyn Observer) -> Self {
        let last = question.last_revolutions();
        let mut scene = given.resolved.scene.clone();
        (scene.numerics.error_estimate, scene.verify) = (false, false);
        let operation = &mut scene.operation;
        operation.phases.truncate(operation.phase_at(last) + 1);
        if let Some(phase) = operation.phases.last_mut() {
            phase.end_revolutions = last;
        }
        operation.pinion_revolutions = last;
        operation.stop = LifeLimits::default();
        // Snapshots of the scene are kept: steps end at them.
        let snapshots = &mut operation.snapshots_revolutions;
        snapshots.retain(|&at| at < last);
        snapshots.extend(question.profiles.iter().map(|of| of.revolutions));
        snapshots.sort_by(f64::total_cmp);
        snapshots.dedup();
        Self {
            given,
            question,
            until_measured: scene,
            observer,
            courses: Vec::new(),
            name: "run",
            runs: 0,
            mesh_cycles: 0,
        }
    }

    /// The factor of severe wear of the measured gears in the scene; 1 where there is none.
    pub(super) fn severe_factor(&self) -> f64 {
        let measured = self.question.profiles.first().and_then(|of| self.until_measured.wear[of.profile.gear].severe);
        measured.map_or(1.0, |severe| severe.factor)
    }

    /// Wear of the flank points of each profile, by a run with just this change, µm.
    pub(super) fn exactly(&mut self, change: CoefficientChange) -> Result<Vec<Vec<f64>>, CompareError> {
        let snapshots = self.run(self.changed(change))?;
        let measured = self.question.profiles.iter().enumerate().map(|(index, of)| {
            let away = snapshots.iter().map(|snapshot| ((snapshot.revolutions - of.revolutions).abs(), snapshot));
            let nearest = away.min_by(|(a, _), (b, _)| a.total_cmp(b));
            nearest.map(|(_, snapshot)| snapshot.wear_um[index].clone()).unwrap_or_default()
        });
        Ok(measured.collect())
    }

    /// Wear profiles interpolated between computed ones, which are computed when first needed.
    pub(super) fn about(&mut self, change: CoefficientChange) -> Result<Vec<Vec<f64>>, CompareError> {
        let profiles = &self.question.profiles;
        let mut sums = vec![Vec::new(); profiles.len()];
        for (n, weight) in self.courses_around(change) {
            // Coefficients of the course at factor 1, and the factor of the change on it for each gear.
            let once = self.on_course(n, 1.0).coefficient_factor;
            let own = PerGear::from_fn(|gear| change.coefficient_factor[gear] / once[gear]);
            let factors: Vec<f64> = profiles.iter().map(|of| own[of.profile.gear]).collect();
            let course = self.course(n, factors.iter().copied().fold(0.0, f64::max))?;
            for (sum, (wear, factor)) in sums.iter_mut().zip(course.wear.iter().zip(factors)) {
                let wear = wear.at(factor);
                sum.resize(wear.len(), 0.0);
                sum.iter_mut().zip(&wear).for_each(|(sum, wear)| *sum += weight * wear);
            }
        }
        Ok(sums)
    }

    /// The courses that a change lies between, with their weights.
    fn courses_around(&self, change: CoefficientChange) -> Vec<(i32, f64)> {
        let ratio = change.coefficient_factor.wheel / change.coefficient_factor.pinion;
        match (self.question.fitted, change.severe_factor) {
            (FittedGears::Each, _) => {
                let place = ratio.ln() / STEP;
                lagrange(place, place.round() as i32 - 1, 3)
            }
            (_, Some(severe)) => {
                let place = (severe / self.severe_factor()).ln() / STEP;
                lagrange(place, place.floor() as i32 - 1, 4)
            }
            (_, None) => vec![(0, 1.0)],
        }
    }

    /// The change of the course `n` at a factor.
    fn on_course(&self, n: i32, factor: f64) -> CoefficientChange {
        let [less, more, whole] = [-0.5, 0.5, 1.0].map(|by| (by * f64::from(n) * STEP).exp());
        match self.question.fitted {
            FittedGears::Each => CoefficientChange {
                coefficient_factor: PerGear { pinion: factor * less, wheel: factor * more },
                severe_factor: None,
            },
            fitted => CoefficientChange {
                coefficient_factor: PerGear::from_fn(|gear| if fitted.has(gear) { factor } else { 1.0 }),
                severe_factor: (n != 0).then(|| self.severe_factor() * whole),
            },
        }
    }

    /// The course `n`, up to this factor at least.
    fn course(&mut self, n: i32, up_to: f64) -> Result<&Course, CompareError> {
        let known = self.courses.iter().position(|course| course.n == n);
        let index = match known {
            Some(index) if self.courses[index].reach >= up_to => index,
            Some(index) => {
                self.courses[index] = self.compute(n, AHEAD * up_to)?;
                index
            }
            None => {
                let reach = self.courses.iter().map(|course| course.reach).fold(AHEAD * up_to, f64::max);
                let course = self.compute(n, reach)?;
                self.courses.push(course);
                self.courses.len() - 1
            }
        };
        Ok(&self.courses[index])
    }

    fn compute(&mut self, n: i32, reach: f64) -> Result<Course, CompareError> {
        let profiles = &self.question.profiles;
        // Factor of each snapshot and its wear, profile by profile.
        let mut rows: Vec<(Vec<f64>, Vec<Vec<f64>>)> = Vec::new();
        if self.until_measured.operation.phases.len() > 1 || !self.scales_with_time() {
            for factor in squares(reach, SEPARATE_RUNS) {
                rows.push((vec![factor; profiles.len()], self.exactly(self.on_course(n, factor))?));
            }
        } else {
            let mut scene = self.changed(self.on_course(n, 1.0));
            let duration = scene.operation.pinion_revolutions;
            let operation = &mut scene.operation;
            operation.pinion_revolutions = reach * duration;
            operation.phases.iter_mut().for_each(|phase| phase.end_revolutions = reach * duration);
            operation.snapshots_revolutions = squares(reach, SNAPSHOTS).map(|factor| factor * duration).collect();
            scene.numerics.stepping = scene.numerics.stepping.coarser((reach / AS_FINE_UP_TO).max(1.0));
            for ProfileSnapshot { revolutions, wear_um } in self.run(scene)? {
                rows.push((profiles.iter().map(|of| revolutions / of.revolutions).collect(), wear_um));
            }
        }
        let of_profile =
            |index: usize| WearByCoefficient::new(rows.iter().map(|(at, wear)| (at[index], wear[index].clone())));
        Ok(Course { n, reach, wear: (0..profiles.len()).map(of_profile).collect() })
    }

    /// Whether wear of greater coefficients equals that of a longer run: the coefficients of both gears change alike, or the mate does not wear.
    fn scales_with_time(&self) -> bool {
        let scene = &self.until_measured;
        Gear::BOTH.into_iter().all(|gear| {
            let mut phases = scene.operation.phases.iter();
            self.question.fitted.has(gear)
                || phases.all(|phase| scene.wear_in(phase)[gear].coefficient_mm2_per_n <= 0.0)
        })
    }

    /// Runs a scene; the wear of each profile's flank points at each snapshot.
    fn run(&mut self, scene: Scene) -> Result<Vec<ProfileSnapshot>, CompareError> {
        self.runs += 1;
        self.observer.stage(&format!("{} {}", self.name, self.runs));
        let resolved = Resolved { scene, file: self.given.resolved.file.clone(), warnings: Vec::new() };
        let scene = LoadedScene { resolved, ..self.given.clone() }.without_torque_curve();
        let done = runs::run(&scene, &PartOf::whole(self.observer));
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
        let record = &done.record;
        let profiles = &self.question.profiles;
        let kept = profiles.iter().map(|of| record.flanks[of.profile.gear].snapshot_wear_um.len()).min();
        let snapshots = record.history.iter().take(kept.unwrap_or(0)).enumerate().map(|(index, row)| {
            let wear_um = profiles.iter().map(|of| {
                let flank = &record.flanks[of.profile.gear];
                over_width(&flank.snapshot_wear_um[index], &flank.width_mm, flank.radius_mm.len(), of.width_mm)
            });
            ProfileSnapshot { revolutions: row.revolutions, wear_um: wear_um.collect() }
        });
        Ok(snapshots.collect())
    }

    /// The scene with a change.
    fn changed(&self, change: CoefficientChange) -> Scene {
        let mut scene = self.until_measured.clone();
        for gear in Gear::BOTH {
            scale_coefficients(&mut scene, gear, change.coefficient_factor[gear]);
            let severe = scene.wear[gear].severe.as_mut().filter(|_| self.question.fitted.has(gear));
            if let (Some(severe), Some(factor)) = (severe, change.severe_factor) {
                severe.factor = factor;
            }
        }
        scene
    }
}

/// Wear at `width_mm`, linear between the middles of the slices at `slices_mm`; beyond them that of the outermost slice.
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

/// Weights at `place` of Lagrange's polynomial through `count` courses from `first` on.
fn lagrange(place: f64, first: i32, count: i32) -> Vec<(i32, f64)> {
    let nodes = first..first + count;
    let weights = nodes.clone().map(|n| {
        let others = nodes.clone().filter(|&other| other != n).map(f64::from);
        (n, others.map(|other| (place - other) / (f64::from(n) - other)).product())
    });
    weights.collect()
}

/// Factors up to `reach`, evenly in their square roots.
fn squares(reach: f64, count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(move |i| reach * (f64::from(i) / f64::from(count)).powi(2))
}
