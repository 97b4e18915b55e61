//! The load spectrum, as far as the file says it for the driving gear.

use super::RexsError;
use super::document::{HOURS, NM, PERCENT, RPM, RexsComponent, RexsDocument};
use super::stage::GearData;

/// Load of the stage over its life.
#[derive(Debug)]
pub(super) struct Load {
    /// At least one.
    pub cases: Vec<LoadOfCase>,
    /// Hours of the whole.
    pub hours: Option<f64>,
}

/// One load case; what the file does not say is None.
#[derive(Debug)]
pub(super) struct LoadOfCase {
    pub torque_Nm: Option<f64>,
    pub speed_rpm: Option<f64>,
    /// Part of the whole time, all together 1.
    pub fraction: f64,
}

/// The components that say something of the load of the driving gear.
struct Sources<'a> {
    document: &'a RexsDocument,
    gear_id: &'a str,
    /// The gear in its stage.
    in_stage: Option<&'a RexsComponent>,
    shaft: Option<&'a RexsComponent>,
    /// Ids of the external loads on the shaft, where it carries no other gear.
    external_loads: Vec<String>,
    unit: Option<&'a RexsComponent>,
}

impl<'a> Sources<'a> {
    fn new(document: &'a RexsDocument, pinion: &GearData<'a>) -> Self {
        let shaft = document.shaft_of(pinion.component);
        let alone = shaft.filter(|shaft| parts(document, shaft, "cylindrical_gear").len() == 1);
        Self {
            document,
            gear_id: &pinion.component.id,
            in_stage: pinion.in_stage,
            shaft,
            external_loads: alone.map(|shaft| parts(document, shaft, "external_load")).unwrap_or_default(),
            unit: document.components.iter().find(|component| component.kind == "gear_unit"),
        }
    }

    /// Torque in N·m, speed in 1/min and part of the time of a load case that says the components `said`.
    fn case(&self, said: &[RexsComponent]) -> Result<[Option<f64>; 3], RexsError> {
        // What the case says stands before what the component itself says.
        let number = |id: &str, attribute: &str, units| -> Result<Option<f64>, RexsError> {
            let said = said.iter().find(|component| component.id == id).into_iter().chain(self.document.component(id));
            said.map(|component| component.number(attribute, units)).find_map(Result::transpose).transpose()
        };
        let mut torque_Nm = match self.in_stage {
            Some(data) => number(&data.id, "torque", NM)?,
            None => None,
        };
        if torque_Nm.is_none() {
            torque_Nm = number(self.gear_id, "torque_acting_on_shaft_u", NM)?;
        }
        if torque_Nm.is_none() {
            for load in &self.external_loads {
                if let Some(part_Nm) = number(load, "torque_around_u_axis", NM)? {
                    torque_Nm = Some(torque_Nm.unwrap_or(0.0) + part_Nm);
                }
            }
        }
        let mut speed_rpm = number(self.gear_id, "rotational_speed", RPM)?;
        if let (None, Some(shaft)) = (speed_rpm, self.shaft) {
            speed_rpm = number(&shaft.id, "rotational_speed", RPM)?;
        }
        let mut fraction = None;
        if let Some(unit) = self.unit {
            fraction = number(&unit.id, "operating_time_fraction", PERCENT)?;
            if fraction.is_none() {
                // As Bearinx writes it.
                fraction = number(&unit.id, "load_duration_fraction", PERCENT)?;
            }
        }
        Ok([torque_Nm.map(f64::abs), speed_rpm.map(f64::abs), fraction])
    }
}

/// Ids of the parts of a shaft that are of a kind.
fn parts(document: &RexsDocument, shaft: &RexsComponent, kind: &str) -> Vec<String> {
    let parts = document.related("assembly", ("assembly", &shaft.id), "part");
    parts.filter(|part| part.kind == kind).map(|part| part.id.clone()).collect()
}

/// The load of the driving gear. Its torque is that of the gear itself, or the sum of the external loads on its shaft where that carries no
/// other gear; a shaft between two stages would need the equilibrium of the gear unit.
pub(super) fn of(document: &RexsDocument, pinion: &GearData, warnings: &mut Vec<String>) -> Result<Load, RexsError> {
    let sources = Sources::new(document, pinion);
    let without = [Vec::new()];
    let said = if document.load_cases.is_empty() { &without[..] } else { &document.load_cases[..] };
    let mut cases = Vec::new();
    for (index, said) in said.iter().enumerate() {
        let [torque_Nm, speed_rpm, fraction] = sources.case(said)?;
        let idle = torque_Nm == Some(0.0) || speed_rpm == Some(0.0) || fraction.is_some_and(|part| part <= 0.0);
        if idle {
            warnings.push(format!("load case {} has no torque, speed or time and is left out", index + 1));
        } else {
            cases.push(LoadOfCase { torque_Nm, speed_rpm, fraction: fraction.unwrap_or(1.0) });
        }
    }
    if cases.is_empty() {
        cases.push(LoadOfCase { torque_Nm: None, speed_rpm: None, fraction: 1.0 });
    }
    let sum: f64 = cases.iter().map(|case| case.fraction).sum();
    cases.iter_mut().for_each(|case| case.fraction /= sum);
    let hours = match sources.unit {
        Some(unit) => unit.number("operating_time", HOURS)?.filter(|&hours| hours > 0.0),
        None => None,
    };
    Ok(Load { cases, hours })
}
