//! Load, speed, duration and snapshots, in revolutions of the pinion.

use super::wear::coefficient_mm2_per_n;
use crate::scene::file::{GearPhaseFile, MeshesFile, OperationFile, PhaseFile, StopFile};
use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_physics::simulation::settings::{LifeLimits, Operation, Phase};

/// Relative tolerance of snapshots at the end of the run: hours and revolutions round differently.
const SAME_TIME: f64 = 1e-9;

/// Number of default snapshots, each at half the duration of the next.
const HALVINGS: i32 = 6;

/// Chooses what `[operation]` leaves open.
pub(super) fn choose(file: &mut OperationFile, findings: &mut Findings) -> Option<Operation> {
    let of_phases = file.phases.iter().flatten().map(|phase| phase.pinion_torque_Nm);
    let greatest = of_phases.reduce(|greatest, torque| Some(greatest?.max(torque?))).flatten();
    file.pinion_torque_Nm = file.pinion_torque_Nm.or(greatest);
    let is_loaded = file.pinion_torque_Nm.is_some();
    if !is_loaded {
        let allowed = "a number greater than 0, or a pinion_torque_Nm in each of operation.phases";
        findings.missing(&["operation.pinion_torque_Nm"], allowed);
    }
    let of_whole = Phase {
        // Any load serves to find the other problems.
        pinion_torque_n_mm: 1e3 * file.pinion_torque_Nm.unwrap_or(1.0),
        pinion_speed_rpm: file.pinion_speed_rpm,
        coefficient_mm2_per_n: PerGear::default(),
        flank_c: PerGear::default(),
        young_modulus_mpa: None,
        end_revolutions: 0.0,
    };
    let phases = match &file.phases {
        None => {
            let keys = ["operation.hours", "operation.pinion_revolutions"];
            let duration = duration(keys, file.hours, file.pinion_revolutions, file.pinion_speed_rpm, findings)?;
            vec![Phase { end_revolutions: duration, ..of_whole }]
        }
        Some(given) => {
            let phases = phases(given, of_whole, findings)?;
            add_up(file, &phases, findings)?;
            phases
        }
    };
    let pinion_revolutions = phases.last()?.end_revolutions;
    let StopFile { wear_um, tip_thickness_mm } = file.stop.clone().unwrap_or_default();
    let stop = LifeLimits { wear_mm: wear_um.map(|limit| 1e-3 * limit), tip_thickness_mm };
    if file.stop.is_some() && !stop.are_set() {
        findings.missing(&["operation.stop.wear_um", "operation.stop.tip_thickness_mm"], "a number greater than 0");
        return None;
    }
    let mut operation = Operation {
        pinion_torque_n_mm: of_whole.pinion_torque_n_mm,
        pinion_speed_rpm: of_whole.pinion_speed_rpm,
        pinion_revolutions,
        snapshots_revolutions: Vec::new(),
        phases,
        stop,
        meshes_per_revolution: meshes_per_revolution(file.meshes_per_revolution.as_ref()),
        torque_curve_n_mm: Vec::new(),
    };
    operation.torque_curve_n_mm = torque_curve_n_mm(file, &operation, findings)?;
    operation.snapshots_revolutions = snapshots(file, &operation, findings)?;
    for phase in &operation.phases {
        let end = phase.end_revolutions;
        match operation.snapshots_revolutions.iter().position(|other| (other / end - 1.0).abs() <= SAME_TIME) {
            // Hours and revolutions round differently: the end of the phase is meant.
            Some(index) => operation.snapshots_revolutions[index] = end,
            None => operation.snapshots_revolutions.push(end),
        }
    }
    operation.snapshots_revolutions.sort_by(f64::total_cmp);
    is_loaded.then_some(operation)
}

/// Torques of the curve, N·mm.
fn torque_curve_n_mm(file: &OperationFile, operation: &Operation, findings: &mut Findings) -> Option<Vec<f64>> {
    let [_, greatest_n_mm] = operation.torque_range_n_mm();
    let torques = file.torque_curve_Nm.as_deref().unwrap_or_default();
    if let Some(index) = (1..torques.len()).find(|&index| torques[index] <= torques[index - 1]) {
        let key = format!("operation.torque_curve_Nm[{index}]");
        findings.not_allowed(&key, number(torques[index]), "increasing torques".to_owned());
        return None;
    }
    // The torque of the run itself is not computed twice.
    let same = |torque_n_mm: f64| (torque_n_mm / greatest_n_mm - 1.0).abs() <= SAME_TIME;
    Some(
        torques
            .iter()
            .map(|torque| 1e3 * torque)
            .map(|torque| if same(torque) { greatest_n_mm } else { torque })
            .collect(),
    )
}

/// Refuses a limit that `pair` has passed already.
pub(super) fn check_stop(stop: &LifeLimits, pair: &GearPair, findings: &mut Findings) {
    let new = Gear::BOTH.map(|gear| (gear, pair.normal_tip_thickness_mm(gear, 0.0)));
    let [(gear, thickness_mm), other] = new;
    let (gear, thickness_mm) = if other.1 < thickness_mm { other } else { (gear, thickness_mm) };
    if let Some(limit_mm) = stop.tip_thickness_mm.filter(|&limit_mm| limit_mm >= thickness_mm) {
        let allowed = format!("less than {thickness_mm:.4}, the normal tip thickness of the new {} in mm", gear.name());
        findings.not_allowed("operation.stop.tip_thickness_mm", number(limit_mm), allowed);
    }
}

/// Meshes of each gear as given, otherwise one.
fn meshes_per_revolution(file: Option<&MeshesFile>) -> PerGear<f64> {
    let MeshesFile { pinion, wheel } = file.cloned().unwrap_or_default();
    PerGear { pinion, wheel }.map(|meshes| f64::from(meshes.unwrap_or(1)))
}

/// Duration given by one of two keys, in revolutions of the pinion.
fn duration(
    keys: [&str; 2],
    hours: Option<f64>,
    revolutions: Option<f64>,
    speed_rpm: Option<f64>,
    findings: &mut Findings,
) -> Option<f64> {
    let revolutions = match (hours, revolutions) {
        (Some(hours), None) => match speed_rpm {
            Some(rpm) => 60.0 * rpm * hours,
            None => {
                speed_needed(keys[0], findings);
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
        findings.not_allowed(keys[0], number(revolutions), "a finite number of revolutions");
        return None;
    }
    Some(revolutions)
}

/// The phases one after the other, with what they leave open as of the whole.
fn phases(given: &[PhaseFile], of_whole: Phase, findings: &mut Findings) -> Option<Vec<Phase>> {
    if given.is_empty() {
        findings.not_allowed("operation.phases", "no phase", "at least one [[operation.phases]]");
        return None;
    }
    let (mut phases, mut end_revolutions) = (Vec::with_capacity(given.len()), 0.0);
    for (index, phase) in given.iter().enumerate() {
        let table = format!("operation.phases[{index}]");
        let pinion_speed_rpm = phase.pinion_speed_rpm.or(of_whole.pinion_speed_rpm);
        let durations = ["hours", "pinion_revolutions"].map(|name| format!("{table}.{name}"));
        let [hours, revolutions] = durations.each_ref().map(String::as_str);
        end_revolutions +=
            duration([hours, revolutions], phase.hours, phase.pinion_revolutions, pinion_speed_rpm, findings)?;
        let of_both = coefficient(&table, phase.coefficient_m2_per_N, phase.coefficient_mm3_per_Nm, findings)?;
        let [pinion, wheel] = [("pinion", &phase.pinion), ("wheel", &phase.wheel)].map(|(gear, own)| {
            let GearPhaseFile { coefficient_m2_per_N, coefficient_mm3_per_Nm } = own.clone().unwrap_or_default();
            coefficient(&format!("{table}.{gear}"), coefficient_m2_per_N, coefficient_mm3_per_Nm, findings)
        });
        let coefficient_mm2_per_n = PerGear { pinion: pinion?.or(of_both), wheel: wheel?.or(of_both) };
        phases.push(Phase {
            pinion_torque_n_mm: phase.pinion_torque_Nm.map_or(of_whole.pinion_torque_n_mm, |torque| 1e3 * torque),
            pinion_speed_rpm,
            coefficient_mm2_per_n,
            flank_c: PerGear::default(),
            young_modulus_mpa: None,
            end_revolutions,
        });
    }
    Some(phases)
}

/// Coefficient given in `table`, mm²/N; `Some(None)` where it gives none.
fn coefficient(table: &str, in_m2: Option<f64>, in_mm3: Option<f64>, findings: &mut Findings) -> Option<Option<f64>> {
    let keys = ["coefficient_m2_per_N", "coefficient_mm3_per_Nm"].map(|name| format!("{table}.{name}"));
    coefficient_mm2_per_n(keys.each_ref().map(String::as_str), in_m2, in_mm3, findings)
}

/// Checks that the duration of the whole, where it is given, is that of its phases.
fn add_up(file: &OperationFile, phases: &[Phase], findings: &mut Findings) -> Option<()> {
    let keys = ["operation.hours", "operation.pinion_revolutions"];
    if findings.said_twice(&[(keys[0], file.hours.is_some()), (keys[1], file.pinion_revolutions.is_some())]) {
        return None;
    }
    let end = phases.last()?.end_revolutions;
    let (key, given, sum) = match (file.hours, file.pinion_revolutions) {
        (Some(hours), _) => {
            let whole = Operation { phases: phases.to_vec(), ..Operation::steady(0.0, None, end, Vec::new()) };
            let Some(sum) = whole.hours(end) else {
                speed_needed(keys[0], findings);
                return None;
            };
            (keys[0], hours, sum)
        }
        (_, Some(revolutions)) => (keys[1], revolutions, end),
        _ => return Some(()),
    };
    if (given / sum - 1.0).abs() <= SAME_TIME {
        return Some(());
    }
    findings.not_allowed(key, number(given), format!("{}, the sum of operation.phases", number(sum)));
    findings.help(format!("{key} may be left out where there are phases"));
    None
}

/// Snapshots in revolutions of the pinion, the end of the run included.
fn snapshots(file: &mut OperationFile, operation: &Operation, findings: &mut Findings) -> Option<Vec<f64>> {
    let keys = ["operation.snapshots_h", "operation.snapshots_revolutions"];
    let duration = operation.pinion_revolutions;
    let in_hours = match (&file.snapshots_h, &file.snapshots_revolutions) {
        (Some(_), Some(_)) => {
            findings.said_twice(&keys.map(|key| (key, true)));
            return None;
        }
        (Some(_), None) => true,
        (None, Some(_)) => false,
        (None, None) => {
            // In hours of different speeds the halves would be none of the revolutions.
            match file.hours.filter(|_| file.phases.is_none()) {
                Some(hours) => file.snapshots_h = Some(halvings(hours)),
                None => file.snapshots_revolutions = Some(halvings(duration)),
            }
            return Some(halvings(duration));
        }
    };
    let (key, given) = match in_hours {
        true => (keys[0], &mut file.snapshots_h),
        false => (keys[1], &mut file.snapshots_revolutions),
    };
    let given = given.get_or_insert_default();
    let whole = match (in_hours, operation.hours(duration)) {
        (false, _) => duration,
        (true, Some(hours)) => file.hours.unwrap_or(hours),
        (true, None) => {
            speed_needed(key, findings);
            return None;
        }
    };

    let mut snapshots: Vec<f64> = Vec::with_capacity(given.len() + 1);
    for (index, &time) in given.iter().enumerate() {
        let revolutions = if in_hours { operation.revolutions_after(time)? } else { time };
        let at_end = (revolutions / duration - 1.0).abs() <= SAME_TIME;
        let revolutions = if at_end { duration } else { revolutions };
        if revolutions > duration || snapshots.last().is_some_and(|&last| revolutions <= last) {
            let allowed = format!("increasing times up to the duration, {}", number(whole));
            findings.not_allowed(&format!("{key}[{index}]"), number(time), allowed);
            if index > 0 && time <= given[index - 1] {
                findings.help("commas separate times, decimals stand after a point");
            }
            return None;
        }
        snapshots.push(revolutions);
    }
    if snapshots.last() != Some(&duration) {
        given.push(whole);
        snapshots.push(duration);
    }
    Some(snapshots)
}

/// Times that halve `whole` again and again, rising.
fn halvings(whole: f64) -> Vec<f64> {
    (0..=HALVINGS).rev().map(|n| whole * 0.5_f64.powi(n)).collect()
}

fn speed_needed(key: &str, findings: &mut Findings) {
    findings.missing(&["operation.pinion_speed_rpm"], "a number greater than 0");
    findings.help(format!("{key} needs the speed"));
}
