//! Speeds and loads of a gear unit's shafts, as far as they follow from those that are given.
//!
//! Shafts that engaged couplings join turn as one. Gears on fixed axes hand the speed on by their teeth; without losses, the power that enters a shaft leaves it:
//!
//! ```text
//! n2 = ∓ n1 z1/z2          Σ T n of the loads on a shaft + Σ P of its meshes = 0          T = P / n
//! ```
//!
//! so that a shaft on which one mesh alone is unknown gives its power. Meshes of one gear with mates of the same number of teeth, as of a sun with its
//! planets, share alike. Planets turn about an axis that moves: speeds and powers are not followed through them, and the torque of a sun or ring is that of
//! its shaft.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::RexsError;
use super::document::{KW, NM, NONE, RPM, RexsComponent, RexsDocument, RexsRelation, Units};

/// N·m/min of a kW.
const PER_KW: f64 = 6e4 / TAU;

/// Shafts that turn as one, loads on them, and the meshes between. A group whose shafts another took in is empty.
#[derive(Debug)]
pub(super) struct Drivetrain<'a> {
    document: &'a RexsDocument,
    /// Index of the group that a shaft is of, by its id.
    group_of: BTreeMap<&'a str, usize>,
    groups: Vec<ShaftGroup<'a>>,
    pub meshes: Vec<TrainMesh<'a>>,
}

#[derive(Debug, Default)]
struct ShaftGroup<'a> {
    shafts: Vec<&'a RexsComponent>,
    loads: Vec<&'a RexsComponent>,
    /// Meshes and the side of them that is on these shafts.
    meshes: Vec<(usize, usize)>,
    /// Planets, whose axes move.
    is_planet: bool,
}

/// Two gears of a stage.
#[derive(Debug)]
pub(super) struct TrainMesh<'a> {
    pub stage: &'a RexsComponent,
    pub gears: [&'a RexsComponent; 2],
    groups: [Option<usize>; 2],
    teeth: [Option<f64>; 2],
}

/// What a load case says, before what the components themselves say.
#[derive(Debug, Clone, Copy)]
pub(super) struct CaseView<'a> {
    pub document: &'a RexsDocument,
    /// Components as the case has them.
    pub said: &'a [RexsComponent],
}

impl<'a> CaseView<'a> {
    fn of(&self, id: &str) -> impl Iterator<Item = &'a RexsComponent> {
        let (id, said) = (id.to_owned(), self.said);
        said.iter().find(|component| component.id == id).into_iter().chain(self.document.component(&id))
    }

    pub(super) fn number(&self, id: &str, attribute: &str, units: Units) -> Result<Option<f64>, RexsError> {
        self.of(id).map(|component| component.number(attribute, units)).find_map(Result::transpose).transpose()
    }

    fn word(&self, id: &str, attribute: &str) -> Option<&'a str> {
        self.of(id).find_map(|component| component.text(attribute))
    }
}

/// Speeds and powers in a load case.
#[derive(Debug)]
pub(super) struct Flow {
    /// Of each group, 1/min, with its sense.
    speed_rpm: Vec<Option<f64>>,
    /// From the first gear of each mesh into the second, N·m/min.
    power: Vec<Option<f64>>,
    /// Whether speeds are only those of shafts over one another, since the file has none: torques are right, and nothing is known of senses.
    is_relative: bool,
}

/// A load on a shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ShaftLoad {
    /// Power that it brings in.
    Known(f64),
    Unknown,
}

impl<'a> Drivetrain<'a> {
    pub(super) fn of(document: &'a RexsDocument) -> Self {
        let mut train = Self { document, group_of: BTreeMap::new(), groups: Vec::new(), meshes: Vec::new() };
        for shaft in document.components.iter().filter(|component| component.kind == "shaft") {
            train.group_of.insert(&shaft.id, train.groups.len());
            train.groups.push(ShaftGroup { shafts: vec![shaft], ..ShaftGroup::default() });
        }
        for relation in &document.relations {
            train.join(relation);
        }
        for relation in &document.relations {
            match relation.kind.as_str() {
                "assembly" | "ordered_assembly" => train.add_load(relation.member("assembly"), relation.member("part")),
                "planet_shaft" => {
                    if let Some(&group) = relation.member("shaft").and_then(|shaft| train.group_of.get(shaft)) {
                        train.groups[group].is_planet = true;
                    }
                }
                _ => {}
            }
        }
        // In the order of the stages' components, by which they are counted.
        for stage in document.components.iter().filter(|component| component.is_stage()) {
            let Some(relation) = document.relation("stage", &[("stage", &stage.id)]) else { continue };
            let gears = ["gear_1", "gear_2"].map(|role| document.component(relation.member(role)?));
            if let [Some(first), Some(second)] = gears {
                let mesh = train.mesh(stage, [first, second]);
                for (side, group) in mesh.groups.into_iter().enumerate() {
                    if let Some(group) = group {
                        train.groups[group].meshes.push((train.meshes.len(), side));
                    }
                }
                train.meshes.push(mesh);
            }
        }
        train
    }

    /// Joins the shafts that a coupling joins.
    fn join(&mut self, relation: &RexsRelation) {
        let [one, other] = ["inner_part", "outer_part"].map(|role| self.group_of.get(relation.member(role)?).copied());
        let (Some(one), Some(other)) = (one, other) else { return };
        if one == other || !self.document.is_joint(relation) {
            return;
        }
        let shafts = std::mem::take(&mut self.groups[other].shafts);
        for shaft in shafts {
            self.group_of.insert(&shaft.id, one);
            self.groups[one].shafts.push(shaft);
        }
    }

    fn add_load(&mut self, shaft: Option<&str>, part: Option<&str>) {
        let load = part.and_then(|id| self.document.component(id)).filter(|part| part.kind == "external_load");
        let group = shaft.and_then(|shaft| self.group_of.get(shaft));
        if let (Some(load), Some(&group)) = (load, group) {
            self.groups[group].loads.push(load);
        }
    }

    fn mesh(&self, stage: &'a RexsComponent, gears: [&'a RexsComponent; 2]) -> TrainMesh<'a> {
        let groups = gears.map(|gear| self.group_of.get(self.document.shaft_of(gear)?.id.as_str()).copied());
        let teeth = gears.map(|gear| gear.number("number_of_teeth", NONE).ok().flatten().map(f64::abs));
        TrainMesh { stage, gears, groups, teeth: teeth.map(|teeth| teeth.filter(|&teeth| teeth > 0.0)) }
    }

    /// The mesh of a stage.
    pub(super) fn mesh_of(&self, stage: &RexsComponent) -> Option<usize> {
        self.meshes.iter().position(|mesh| std::ptr::eq(mesh.stage, stage))
    }

    /// Whether an axis of the mesh moves.
    pub(super) fn is_planetary(&self, mesh: usize) -> bool {
        self.meshes[mesh].groups.iter().flatten().any(|&group| self.groups[group].is_planet)
    }

    /// The mesh with that of its gear's other meshes that share the load with it: same gear on the same side, mates of as many teeth.
    pub(super) fn sharing(&self, mesh: usize, side: usize) -> Vec<usize> {
        let own = &self.meshes[mesh];
        let mate = 1 - side;
        let alike = |other: &TrainMesh| {
            let side_of_gear = other.gears.iter().position(|gear| gear.id == own.gears[side].id);
            let is_same = side_of_gear == Some(side) && other.teeth[mate] == own.teeth[mate];
            is_same && other.gears[mate].kind == own.gears[mate].kind
        };
        (0..self.meshes.len()).filter(|&index| alike(&self.meshes[index])).collect()
    }

    /// Whether the load of the mesh is read from the shaft of its gear on this side: nothing else is on it but loads that are given.
    pub(super) fn is_alone(&self, mesh: usize, side: usize) -> bool {
        let Some(group) = self.meshes[mesh].groups[side] else { return false };
        self.groups[group].shafts.len() == 1 && self.groups[group].meshes.len() == 1
    }

    /// Speeds and powers in a load case.
    pub(super) fn flow(&self, case: CaseView) -> Result<Flow, RexsError> {
        let mut speed_rpm = Vec::new();
        for group in &self.groups {
            let gears = group.meshes.iter().map(|&(mesh, side)| self.meshes[mesh].gears[side]);
            let mut said =
                group.shafts.iter().copied().chain(gears).map(|part| case.number(&part.id, "rotational_speed", RPM));
            speed_rpm.push(said.find_map(Result::transpose).transpose()?.filter(|&speed_rpm| speed_rpm != 0.0));
        }
        let is_relative = speed_rpm.iter().all(Option::is_none);
        if is_relative {
            for (index, group) in self.groups.iter().enumerate() {
                let torques = group.loads.iter().map(|load| case.number(&load.id, "torque_around_u_axis", NM));
                if torques.collect::<Result<Vec<_>, _>>()?.iter().any(Option::is_some) {
                    speed_rpm[index] = Some(1.0);
                    break;
                }
            }
        }
        self.hand_on(&mut speed_rpm);
        let mut flow = Flow { speed_rpm, power: vec![None; self.meshes.len()], is_relative };
        self.balance(case, &mut flow)?;
        Ok(flow)
    }

    /// Speeds through the meshes of fixed axes, until none is new.
    fn hand_on(&self, speed_rpm: &mut [Option<f64>]) {
        loop {
            let mut is_new = false;
            for (index, mesh) in self.meshes.iter().enumerate() {
                let ([Some(one), Some(other)], [Some(z1), Some(z2)]) = (mesh.groups, mesh.teeth) else { continue };
                if self.is_planetary(index) {
                    continue;
                }
                // Bevel gears have no sense in common; theirs is the first's.
                let sense = if mesh.stage.kind == "cylindrical_stage" { -1.0 } else { 1.0 };
                let found = match [speed_rpm[one], speed_rpm[other]] {
                    [Some(speed), None] => (other, sense * speed * z1 / z2),
                    [None, Some(speed)] => (one, sense * speed * z2 / z1),
                    _ => continue,
                };
                speed_rpm[found.0] = Some(found.1);
                is_new = true;
            }
            if !is_new {
                return;
            }
        }
    }

    /// Powers of meshes that are the only unknown on a shaft, until none is new.
    fn balance(&self, case: CaseView, flow: &mut Flow) -> Result<(), RexsError> {
        let mut loads = Vec::new();
        for (group, speed_rpm) in self.groups.iter().zip(&flow.speed_rpm) {
            let of_group = group.loads.iter().map(|load| shaft_load(case, load, *speed_rpm));
            let known: Vec<ShaftLoad> = of_group.filter_map(Result::transpose).collect::<Result<_, _>>()?;
            loads.push(known);
        }
        loop {
            let mut is_new = false;
            for (group, of_group) in loads.iter().enumerate() {
                if self.groups[group].is_planet || self.groups[group].meshes.is_empty() {
                    continue;
                }
                let (mut known, mut sum, mut unknown) = (0, 0.0, 0);
                for load in of_group {
                    match load {
                        ShaftLoad::Known(power) => (known, sum) = (known + 1, sum + power),
                        ShaftLoad::Unknown => unknown += 1,
                    }
                }
                let mut open: Vec<(usize, usize)> = Vec::new();
                for &(mesh, side) in &self.groups[group].meshes {
                    match flow.power[mesh] {
                        Some(power) => (known, sum) = (known + 1, sum + if side == 0 { -power } else { power }),
                        None => open.push((mesh, side)),
                    }
                }
                let Some(&(first, side)) = open.first() else { continue };
                let sharing = self.sharing(first, side);
                let is_one = open.iter().all(|(mesh, _)| sharing.contains(mesh));
                if known == 0 || unknown > 0 || !is_one {
                    continue;
                }
                for (mesh, side) in &open {
                    let power = sum / open.len() as f64;
                    flow.power[*mesh] = Some(if *side == 0 { power } else { -power });
                }
                is_new = true;
            }
            if !is_new {
                return Ok(());
            }
        }
    }
}

impl Flow {
    /// Torque in N·m of a gear in one mesh.
    pub(super) fn torque_Nm(&self, train: &Drivetrain, mesh: usize, side: usize) -> Option<f64> {
        let speed_rpm = self.speed_rpm[train.meshes[mesh].groups[side]?]?;
        Some((self.power[mesh]? / speed_rpm).abs())
    }

    /// Speed of a gear, 1/min.
    pub(super) fn speed_rpm(&self, train: &Drivetrain, mesh: usize, side: usize) -> Option<f64> {
        self.speed_rpm[train.meshes[mesh].groups[side]?].filter(|_| !self.is_relative).map(f64::abs)
    }

    /// Side of the gear that drives by the senses of torque and speed.
    pub(super) fn driving_side(&self, mesh: usize) -> Option<usize> {
        let power = self.power[mesh].filter(|&power| power != 0.0 && !self.is_relative)?;
        Some(usize::from(power < 0.0))
    }
}

/// What a load brings into its shaft; None of forces alone.
fn shaft_load(case: CaseView, load: &RexsComponent, speed_rpm: Option<f64>) -> Result<Option<ShaftLoad>, RexsError> {
    let torque_Nm = case.number(&load.id, "torque_around_u_axis", NM)?;
    let power_kW = case.number(&load.id, "power", KW)?;
    Ok(match (torque_Nm, power_kW, speed_rpm) {
        (Some(torque_Nm), _, Some(speed_rpm)) => Some(ShaftLoad::Known(torque_Nm * speed_rpm)),
        (None, Some(power_kW), _) => Some(ShaftLoad::Known(PER_KW * power_kW)),
        (Some(_), ..) => Some(ShaftLoad::Unknown),
        (None, None, _) => (case.word(&load.id, "transmits_torque") == Some("true")).then_some(ShaftLoad::Unknown),
    })
}
