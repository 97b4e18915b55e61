//! Contact temperatures: only where the wear law reads them or the scene asks for them.

use crate::gear::{Gear, PerGear};
use crate::scene::file::{OperationFile, PhaseFile};
use crate::scene::findings::Findings;
use crate::scene::wear_file::TemperatureFile;
use crate::thermal::settings::{ABSOLUTE_ZERO_C, HeatSettings, ThermalMaterial};
use crate::wear::settings::LawSettings;

const FRICTION_COEFFICIENT: f64 = 0.1;
const BULK_TEMPERATURE_C: f64 = 90.0;

/// Chooses what `[temperature]` leaves open; `Some(None)` where nobody asks for temperatures.
pub(super) fn choose(
    file: &mut Option<TemperatureFile>,
    material: Option<PerGear<ThermalMaterial>>,
    laws: Option<PerGear<LawSettings>>,
    operation: &OperationFile,
    findings: &mut Findings,
) -> Option<Option<HeatSettings>> {
    let (material, laws) = (material?, laws?);
    let reads = Gear::BOTH.into_iter().find(|&gear| laws[gear].reads_temperature());
    if file.is_none() && reads.is_none() {
        return Some(None);
    }
    let asked_for_by = match reads {
        Some(_) if laws.pinion.name() == laws.wheel.name() => format!("wear.law = {:?}", laws.pinion.name()),
        Some(gear) => format!("wear.{}.law = {:?}", gear.name(), laws[gear].name()),
        None => "[temperature]".to_owned(),
    };
    if !speed_is_given(operation) {
        findings.missing(&["operation.pinion_speed_rpm"], "a number greater than 0");
        findings.help(format!("{asked_for_by} needs the speed"));
        return None;
    }
    let file = file.get_or_insert_default();
    Some(Some(HeatSettings {
        method: *file.method.get_or_insert_default(),
        velocity: *file.velocity.get_or_insert_default(),
        partition: *file.partition.get_or_insert_default(),
        friction_coefficient: *file.friction_coefficient.get_or_insert(FRICTION_COEFFICIENT),
        bulk_temperature_k: *file.bulk_temperature_C.get_or_insert(BULK_TEMPERATURE_C) - ABSOLUTE_ZERO_C,
        material,
    }))
}

/// Whether every phase has a speed.
pub(super) fn speed_is_given(operation: &OperationFile) -> bool {
    let of_phases = |phases: &Vec<PhaseFile>| phases.iter().all(|phase| phase.pinion_speed_rpm.is_some());
    operation.pinion_speed_rpm.is_some() || operation.phases.as_ref().is_some_and(of_phases)
}
