//! Settings of a wear run: operation and numerical resolution.

use crate::wear::settings::SevereTransition;
use gearwear_bodies::gear::{GearPair, PerGear, flank::PointSpacing};

/// Wear steps of a run where nothing else is asked for.
const STEPS: f64 = 150.0;

/// Phase of the load spectrum, under constant load and speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// Torque on the pinion, N·mm.
    pub pinion_torque_n_mm: f64,
    /// Speed of the pinion, 1/min, where given.
    pub pinion_speed_rpm: Option<f64>,
    /// Each gear's own wear coefficient, mm²/N; `None`: that of its wear law.
    pub coefficient_mm2_per_n: PerGear<Option<f64>>,
    /// Temperature of each gear's flanks, °C; none where nothing follows it.
    pub flank_c: PerGear<Option<f64>>,
    /// Young's modulus of each gear, MPa; none where that of the scene holds.
    pub young_modulus_mpa: Option<PerGear<f64>>,
    /// When it ends, in revolutions of the pinion from the beginning of the run.
    pub end_revolutions: f64,
}

/// Limits of the service life; a run ends at the first it reaches.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LifeLimits {
    /// Greatest wear depth on the active profile of either gear, mm.
    pub wear_mm: Option<f64>,
    /// Least normal tooth thickness at the tip of either gear, mm.
    pub tip_thickness_mm: Option<f64>,
}

impl LifeLimits {
    /// Whether there is any limit.
    pub fn are_set(&self) -> bool {
        self.wear_mm.is_some() || self.tip_thickness_mm.is_some()
    }
}

/// Load, speed and duration.
#[derive(Debug, Clone, PartialEq)]
pub struct Operation {
    /// Torque on the pinion, N·mm: of a run in phases, that of phases which name none, and of everything that looks at one load
    /// only (calibration, meshes of finite elements).
    pub pinion_torque_n_mm: f64,
    /// Speed of the pinion, 1/min, where given; of a run in phases, that of phases which name none.
    pub pinion_speed_rpm: Option<f64>,
    /// Duration of the run, in revolutions of the pinion.
    pub pinion_revolutions: f64,
    /// When the state is kept, in revolutions of the pinion: increasing, the last is the end of the run. The ends of phases are
    /// among them.
    pub snapshots_revolutions: Vec<f64>,
    /// The phases of the run, one at least; the last ends with the run.
    pub phases: Vec<Phase>,
    /// Limits that end the run early.
    pub stop: LifeLimits,
    /// Meshes of each tooth in one revolution of its own gear: the number of mates that run on the same flanks under the same load.
    pub meshes_per_revolution: PerGear<f64>,
    /// Torques on the pinion, rising, at which the new and the worn pair are observed, N·mm; none where nobody asks for the curve.
    pub torque_curve_n_mm: Vec<f64>,
}

impl Operation {
    /// One mate for each gear.
    pub const ONE_MATE: PerGear<f64> = PerGear { pinion: 1.0, wheel: 1.0 };

    /// Operation under one load and speed.
    pub fn steady(
        pinion_torque_n_mm: f64,
        pinion_speed_rpm: Option<f64>,
        pinion_revolutions: f64,
        snapshots_revolutions: Vec<f64>,
    ) -> Self {
        let phase = Phase {
            pinion_torque_n_mm,
            pinion_speed_rpm,
            coefficient_mm2_per_n: PerGear::default(),
            flank_c: PerGear::default(),
            young_modulus_mpa: None,
            end_revolutions: pinion_revolutions,
        };
        Self {
            pinion_torque_n_mm,
            pinion_speed_rpm,
            pinion_revolutions,
            snapshots_revolutions,
            phases: vec![phase],
            stop: LifeLimits::default(),
            meshes_per_revolution: Self::ONE_MATE,
            torque_curve_n_mm: Vec::new(),
        }
    }

    /// Meshes of each tooth of both gears in one revolution of the pinion: z1/z2 of the wheel where each gear has one mate.
    pub fn meshes_per_pinion_turn(&self, pair: &GearPair) -> PerGear<f64> {
        let PerGear { pinion, wheel } = self.meshes_per_revolution;
        PerGear { pinion, wheel: wheel * pair.wheel_turns_per_pinion_turn() }
    }

    /// The phase of the greatest load, the first of equals.
    pub fn heaviest_phase(&self) -> &Phase {
        &self.phases[first_greatest(self.phases.iter().map(|phase| phase.pinion_torque_n_mm))]
    }

    /// Least and greatest torque on the pinion of all phases, N·mm.
    pub fn torque_range_n_mm(&self) -> [f64; 2] {
        let torques = || self.phases.iter().map(|phase| phase.pinion_torque_n_mm);
        [torques().fold(f64::INFINITY, f64::min), torques().fold(0.0, f64::max)]
    }

    /// Running time after `revolutions` of the pinion, in hours; `None` without a speed.
    pub fn hours(&self, revolutions: f64) -> Option<f64> {
        let (mut begin, mut hours) = (0.0, 0.0);
        for phase in &self.phases {
            let end = phase.end_revolutions.min(revolutions);
            if end > begin {
                hours += (end - begin) / (60.0 * phase.pinion_speed_rpm?);
            }
            begin = phase.end_revolutions;
        }
        Some(hours)
    }

    /// Revolutions of the pinion after so many hours, beyond the end at the last speed; `None` without a speed.
    pub fn revolutions_after(&self, hours: f64) -> Option<f64> {
        let (mut begin, mut left) = (0.0, hours);
        for phase in &self.phases {
            let per_hour = 60.0 * phase.pinion_speed_rpm?;
            let takes = (phase.end_revolutions - begin) / per_hour;
            if left <= takes {
                return Some(begin + left * per_hour);
            }
            (begin, left) = (phase.end_revolutions, left - takes);
        }
        Some(begin + left * 60.0 * self.phases.last()?.pinion_speed_rpm?)
    }

    /// The phase that `revolutions` lie in, the earlier one at an end.
    pub fn phase_at(&self, revolutions: f64) -> usize {
        self.phases.partition_point(|phase| phase.end_revolutions < revolutions).min(self.phases.len() - 1)
    }
}

/// Index of the greatest, the first of equals; 0 of none.
pub(crate) fn first_greatest(loads: impl Iterator<Item = f64>) -> usize {
    let greater = |(best, most): (usize, f64), (index, load): (usize, f64)| {
        if load > most { (index, load) } else { (best, most) }
    };
    loads.enumerate().fold((0, f64::NEG_INFINITY), greater).0
}

/// Steps of the wear run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepping {
    /// Euler's method with steps of this many pinion revolutions.
    Fixed {
        /// Pinion revolutions a wear step.
        revolutions: f64,
    },
    /// Steps of the Runge–Kutta–Chebyshev method, as long as the error allows.
    Adaptive {
        /// Error of the wear depth that is allowed, mm.
        tolerance_mm: f64,
    },
}

impl Stepping {
    /// The step of Euler's method for a run of `duration` revolutions: the one that is set, or the default where none is.
    pub fn euler_revolutions(&self, duration: f64) -> f64 {
        match *self {
            Stepping::Fixed { revolutions } => revolutions,
            Stepping::Adaptive { .. } => duration / STEPS,
        }
    }

    /// A transition to severe wear as these steps follow it: Euler's method as it is, adaptive steps over a band at least.
    pub(crate) fn followed(&self, transition: SevereTransition) -> SevereTransition {
        match self {
            Stepping::Fixed { .. } => transition,
            Stepping::Adaptive { .. } => transition.continuous(),
        }
    }

    /// Steps `by` times as long, or with an error that many times as large.
    pub fn coarser(self, by: f64) -> Self {
        match self {
            Stepping::Fixed { revolutions } => Stepping::Fixed { revolutions: by * revolutions },
            Stepping::Adaptive { tolerance_mm } => Stepping::Adaptive { tolerance_mm: by * tolerance_mm },
        }
    }

    /// Euler's method with the default step for a run of `duration` revolutions.
    pub fn euler(duration: f64) -> Self {
        Stepping::Fixed { revolutions: duration / STEPS }
    }
}

/// Resolution in space and time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// Intervals of the flank between base circle (point 0) and tip circle (point `flank_points`).
    pub flank_points: usize,
    /// Spacing of the flank points.
    pub point_spacing: PointSpacing,
    /// Loading positions from A to E, evenly along the path of contact, both ends included.
    pub positions: usize,
    /// Steps in time.
    pub stepping: Stepping,
    /// Whether to estimate the errors of the answer from coarser companion runs.
    pub error_estimate: bool,
}
