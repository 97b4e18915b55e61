//! What is asked of the run: operation and numerical resolution.

/// Load, speed and duration.
#[derive(Debug, Clone, PartialEq)]
pub struct Operation {
    /// Torque on the pinion, N·mm.
    pub pinion_torque_n_mm: f64,
    /// Speed of the pinion, 1/min, where given.
    pub pinion_speed_rpm: Option<f64>,
    /// How long the pair runs, in revolutions of the pinion.
    pub pinion_revolutions: f64,
    /// When the state is kept, in revolutions of the pinion: increasing, the last is the end of the run.
    pub snapshots_revolutions: Vec<f64>,
}

impl Operation {
    /// Running time after `revolutions` of the pinion, in hours; `None` without a speed.
    pub fn hours(&self, revolutions: f64) -> Option<f64> {
        self.pinion_speed_rpm.map(|rpm| revolutions / (60.0 * rpm))
    }
}

/// Resolution in space and time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// Intervals of the flank between base circle (point 0) and tip circle (point `flank_points`), evenly in radius.
    pub flank_points: usize,
    /// Loading positions from A to E, evenly along the path of contact, both ends included.
    pub positions: usize,
    /// Pinion revolutions a wear step.
    pub step_revolutions: f64,
    /// Whether to estimate the errors of the answer from coarser companion runs.
    pub error_estimate: bool,
}
