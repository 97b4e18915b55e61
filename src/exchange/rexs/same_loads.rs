//! Whether a run is under the loads that a file describes.

use serde_json::Value;

use super::document::RexsDocument;
use super::load::Load;

/// Loads this close to each other, relatively, are the same: scenes from REXS have twelve digits.
const SAME: f64 = 1e-6;

/// How the loads of a file and of a run go together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Loads {
    /// One, the same.
    One,
    /// Several, a phase of the run for each load case.
    PhaseForEach,
    Different,
}

/// Load of the driving gear in a phase of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadOfPhase {
    pub torque_Nm: Option<f64>,
    pub speed_rpm: Option<f64>,
}

impl LoadOfPhase {
    /// The phases of the pinion in a run's summary.
    pub(super) fn all_of(summary: &Value) -> Vec<Self> {
        let of = |phase: &Value| Self {
            torque_Nm: phase["pinion_torque_Nm"].as_f64(),
            speed_rpm: phase["pinion_speed_rpm"].as_f64(),
        };
        summary["phases"].as_array().map_or_else(Vec::new, |phases| phases.iter().map(of).collect())
    }
}

/// Whether two values agree; what one of them leaves open does not contradict the other.
fn same(given: Option<f64>, run: Option<f64>) -> bool {
    given.zip(run).is_none_or(|(given, run)| (given / run - 1.0).abs() <= SAME)
}

impl Loads {
    /// Compares torque and speed of the driving gear, as far as the file says them, with those of the phases of a run.
    pub(super) fn of(document: &RexsDocument, load: &Load, phases: &[LoadOfPhase]) -> Self {
        let given = document.load_cases.len().max(1);
        let agree = load.cases.len() == given
            && phases.len() == given
            && load.cases.iter().zip(phases).all(|(case, phase)| {
                same(case.torque_Nm.as_ref().map(|torque| torque.value), phase.torque_Nm)
                    && same(case.speed_rpm.as_ref().map(|speed| speed.value), phase.speed_rpm)
            });
        match (agree, given) {
            (false, _) => Self::Different,
            (true, 1) => Self::One,
            (true, _) => Self::PhaseForEach,
        }
    }
}
