//! The load spectrum, as far as the file says or determines it for the driving gear.
//!
//! A torque is that of the gear in its stage, otherwise that on the gear or on its shaft, over the meshes that share it, otherwise what the loads on other
//! shafts leave for it ([`super::drivetrain`]).

use super::RexsError;
use super::document::{HOURS, NM, PERCENT, RPM, RexsComponent, RexsDocument};
use super::drivetrain::{CaseView, Drivetrain};
use super::stage::{Figure, Gears, RexsStage};

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
    pub torque_Nm: Option<Figure>,
    pub speed_rpm: Option<Figure>,
    /// Part of the whole time, all together 1.
    pub fraction: f64,
}

/// What says something of the load of the driving gear.
struct Sources<'a> {
    train: &'a Drivetrain<'a>,
    gears: &'a Gears<'a>,
    /// The stage in the train, and the side of the driving gear.
    mesh: Option<usize>,
    unit: Option<&'a RexsComponent>,
}

/// What a load case says; torque and speed with what they are derived from.
struct Said {
    torque_Nm: Option<Figure>,
    speed_rpm: Option<Figure>,
    fraction: Option<f64>,
}

const WITHOUT_LOSSES: &str = "from the loads on other shafts, without losses";

impl Sources<'_> {
    fn case(&self, case: CaseView) -> Result<Said, RexsError> {
        let (pinion, side) = (&self.gears.pinion, self.gears.roles.pinion_side);
        let flow = self.train.flow(case)?;
        let is_alone = self.mesh.is_some_and(|mesh| self.train.is_alone(mesh, side));
        let shared = |torque_Nm: f64| self.shared(torque_Nm);

        let mut torque_Nm = match pinion.in_stage {
            Some(data) => case.number(&data.id, "torque", NM)?.map(Figure::of_file),
            None => None,
        };
        if torque_Nm.is_none() {
            torque_Nm = case.number(&pinion.component.id, "torque_acting_on_shaft_u", NM)?.map(shared);
        }
        if let (None, Some(mesh)) = (&torque_Nm, self.mesh) {
            let found = flow.torque_Nm(self.train, mesh, side);
            let mates = self.gears.roles.mates.pinion.len();
            torque_Nm = found.map(|torque_Nm| match (is_alone, mates) {
                (true, _) => Figure::of_file(torque_Nm),
                (false, 0 | 1) => Figure::derived(torque_Nm, WITHOUT_LOSSES),
                (false, _) => {
                    Figure::derived(torque_Nm, &format!("the shaft's over {mates} meshes that share it alike"))
                }
            });
        }
        if let (None, Some(data)) = (&torque_Nm, self.gears.wheel.in_stage) {
            let ratio =
                self.gears.pinion.teeth.zip(self.gears.wheel.teeth).map(|(z1, z2)| f64::from(z1) / f64::from(z2));
            let of_wheel = case.number(&data.id, "torque", NM)?.zip(ratio);
            torque_Nm = of_wheel
                .map(|(torque_Nm, ratio)| Figure::derived(torque_Nm * ratio, "that of the other gear, without losses"));
        }

        let shaft = case.document.shaft_of(pinion.component);
        let mut speed_rpm = case.number(&pinion.component.id, "rotational_speed", RPM)?.map(Figure::of_file);
        if let (None, Some(shaft)) = (&speed_rpm, shaft) {
            speed_rpm = case.number(&shaft.id, "rotational_speed", RPM)?.map(Figure::of_file);
        }
        if let (None, Some(mesh)) = (&speed_rpm, self.mesh) {
            let found = flow.speed_rpm(self.train, mesh, side);
            speed_rpm = found.map(|speed_rpm| Figure::derived(speed_rpm, "from the speed of another shaft"));
        }
        let fraction = match self.unit {
            Some(unit) => case.number(&unit.id, "operating_time_fraction", PERCENT)?,
            None => None,
        };
        let size = |figure: Figure| Figure { value: figure.value.abs(), ..figure };
        Ok(Said { torque_Nm: torque_Nm.map(size), speed_rpm: speed_rpm.map(size), fraction })
    }

    /// The torque of one mesh, of that on the gear.
    fn shared(&self, torque_Nm: f64) -> Figure {
        match self.gears.roles.mates.pinion.len() {
            0 | 1 => Figure::of_file(torque_Nm),
            mates => Figure::derived(
                torque_Nm / mates as f64,
                &format!("that on the gear over {mates} meshes that share it alike"),
            ),
        }
    }
}

/// The load of the driving gear in one mesh.
pub(super) fn of<'a>(
    document: &'a RexsDocument,
    train: &'a Drivetrain<'a>,
    stage: &RexsStage,
    gears: &'a Gears<'a>,
    warnings: &mut Vec<String>,
) -> Result<Load, RexsError> {
    let unit = document.components.iter().find(|component| component.kind == "gear_unit");
    let sources = Sources { train, gears, mesh: train.mesh_of(stage.component), unit };
    let without = [Vec::new()];
    let said = if document.load_cases.is_empty() { &without[..] } else { &document.load_cases[..] };
    let mut cases = Vec::new();
    for (index, said) in said.iter().enumerate() {
        let Said { torque_Nm, speed_rpm, fraction } = sources.case(CaseView { document, said })?;
        let is_zero = |figure: &Option<Figure>| figure.as_ref().is_some_and(|figure| figure.value == 0.0);
        if is_zero(&torque_Nm) || is_zero(&speed_rpm) || fraction.is_some_and(|part| part <= 0.0) {
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
    let hours = match unit {
        Some(unit) => unit.number("operating_time", HOURS)?.filter(|&hours| hours > 0.0),
        None => None,
    };
    Ok(Load { cases, hours })
}
