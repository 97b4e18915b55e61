//! Load, speed, duration and snapshots, in revolutions of the pinion.

use crate::scene::file::OperationFile;
use crate::scene::findings::Findings;
use crate::scene::problem::{ProblemKind, number};
use crate::simulation::settings::Operation;

/// Snapshots this close to the end of the run, relatively, are the end: hours and revolutions round differently.
const SAME_TIME: f64 = 1e-9;

/// Default snapshots halve the duration this many times.
const HALVINGS: i32 = 6;

/// Chooses what `[operation]` leaves open.
pub fn choose(file: &mut OperationFile, findings: &mut Findings) -> Option<Operation> {
    let revolutions_per_hour = file.pinion_speed_rpm.map(|rpm| 60.0 * rpm);
    let pinion_revolutions = duration(file, revolutions_per_hour, findings)?;
    let snapshots_revolutions = snapshots(file, pinion_revolutions, revolutions_per_hour, findings)?;
    Some(Operation {
        pinion_torque_n_mm: 1e3 * file.pinion_torque_Nm,
        pinion_speed_rpm: file.pinion_speed_rpm,
        pinion_revolutions,
        snapshots_revolutions,
    })
}

fn duration(file: &OperationFile, revolutions_per_hour: Option<f64>, findings: &mut Findings) -> Option<f64> {
    let keys = ["operation.hours", "operation.pinion_revolutions"];
    let revolutions = match (file.hours, file.pinion_revolutions) {
        (Some(hours), None) => match revolutions_per_hour {
            Some(per_hour) => hours * per_hour,
            None => {
                speed_needed("operation.hours", findings);
                return None;
            }
        },
        (None, Some(revolutions)) => revolutions,
        (Some(_), Some(_)) => {
            findings.said_twice(&keys.map(|key| (key, true)));
            return None;
        }
        (None, None) => {
            findings.missing(&keys, "a number greater than 0");
            return None;
        }
    };
    // Only products of extreme numbers can fail here: each factor was checked by itself.
    if !revolutions.is_normal() {
        findings.problem(
            ProblemKind::NotAllowed,
            "operation.hours",
            number(revolutions),
            "a finite number of revolutions",
        );
        return None;
    }
    Some(revolutions)
}

fn snapshots(
    file: &mut OperationFile,
    duration: f64,
    revolutions_per_hour: Option<f64>,
    findings: &mut Findings,
) -> Option<Vec<f64>> {
    let keys = ["operation.snapshots_h", "operation.snapshots_revolutions"];
    let (key, given, per_unit) = match (&mut file.snapshots_h, &mut file.snapshots_revolutions) {
        (Some(_), Some(_)) => {
            findings.said_twice(&keys.map(|key| (key, true)));
            return None;
        }
        (Some(hours), None) => match revolutions_per_hour {
            Some(per_hour) => (keys[0], hours, per_hour),
            None => {
                speed_needed(keys[0], findings);
                return None;
            }
        },
        (None, Some(revolutions)) => (keys[1], revolutions, 1.0),
        (None, None) => {
            let halvings = |whole: f64| (0..=HALVINGS).rev().map(|n| whole * 0.5_f64.powi(n)).collect::<Vec<_>>();
            match file.hours {
                Some(hours) => file.snapshots_h = Some(halvings(hours)),
                None => file.snapshots_revolutions = Some(halvings(duration)),
            }
            return Some(halvings(duration));
        }
    };

    let mut snapshots: Vec<f64> = Vec::with_capacity(given.len() + 1);
    for (index, &time) in given.iter().enumerate() {
        let revolutions = time * per_unit;
        let at_end = (revolutions / duration - 1.0).abs() <= SAME_TIME;
        let revolutions = if at_end { duration } else { revolutions };
        if revolutions > duration || snapshots.last().is_some_and(|&last| revolutions <= last) {
            let allowed = format!("increasing times up to the duration, {}", number(duration / per_unit));
            findings.problem(ProblemKind::NotAllowed, &format!("{key}[{index}]"), number(time), allowed);
            return None;
        }
        snapshots.push(revolutions);
    }
    if snapshots.last() != Some(&duration) {
        given.push(file.hours.filter(|_| key == keys[0]).unwrap_or(duration / per_unit));
        snapshots.push(duration);
    }
    Some(snapshots)
}

fn speed_needed(key: &str, findings: &mut Findings) {
    findings.missing(&["operation.pinion_speed_rpm"], "a number greater than 0");
    findings.help(format!("{key} needs the speed"));
}
