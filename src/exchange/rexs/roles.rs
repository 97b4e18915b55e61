//! Which gear of a stage drives, and on how many mates each runs.
//!
//! The file says which one drives, or the power does that torque and speed of the shafts carry into the stage. Where neither tells, gear 1 is taken, with
//! a warning. Flanks that a gear drives with are others than those it is driven on: an idler, and a planet between sun and ring, runs on each of its
//! flanks once a revolution, a sun as often as it has planets.

use super::RexsError;
use super::document::RexsDocument;
use super::drivetrain::{CaseView, Drivetrain};
use super::stage::RexsStage;
use gearwear_bodies::gear::PerGear;

/// Mates of a gear in a scene, at most.
const MOST_MATES: usize = 20;

/// Who drives.
#[derive(Debug)]
pub(super) struct Roles {
    /// Place of the driving gear among those of the stage.
    pub pinion_side: usize,
    /// What says so, where the file does not.
    pub how: Option<String>,
    /// Whether nothing says so, and gear 1 is taken.
    pub is_assumed: bool,
    /// The mates of each gear on the same flanks.
    pub mates: PerGear<Vec<String>>,
    /// Whether an axis of the stage moves.
    pub is_planetary: bool,
}

/// What a stage's data of the gears and the loads tell.
struct Told {
    side: Option<usize>,
    how: Option<String>,
    warning: Option<String>,
}

impl Roles {
    pub(super) fn of(
        document: &RexsDocument,
        train: &Drivetrain,
        stage: &RexsStage,
        warnings: &mut Vec<String>,
    ) -> Result<Self, RexsError> {
        let driving = driving_sides(document, train)?;
        let told = told(document, stage, train.mesh_of(stage.component).and_then(|mesh| driving[mesh]));
        warnings.extend(told.warning);
        let pinion_side = told.side.unwrap_or(0);
        let mates = |side: usize| -> Vec<String> {
            let gear = stage.gears[side];
            let drives = side == pinion_side;
            let of_gear = train.meshes.iter().enumerate().filter_map(|(index, mesh)| {
                let own = mesh.gears.iter().position(|other| other.id == gear.id)?;
                let stage = RexsStage { component: mesh.stage, gears: mesh.gears };
                let side = self::told(document, &stage, driving[index]).side.unwrap_or(0);
                ((own == side) == drives).then(|| mesh.gears[1 - own].label())
            });
            of_gear.collect()
        };
        let mut mates = PerGear { pinion: mates(pinion_side), wheel: mates(1 - pinion_side) };
        for of_gear in [&mut mates.pinion, &mut mates.wheel] {
            if of_gear.len() > MOST_MATES {
                warnings.push(format!("{} mates run on one gear; a scene has {MOST_MATES} at most", of_gear.len()));
                of_gear.truncate(MOST_MATES);
            }
        }
        let is_planetary = train.mesh_of(stage.component).is_some_and(|mesh| train.is_planetary(mesh));
        Ok(Self { pinion_side, how: told.how, is_assumed: told.side.is_none(), mates, is_planetary })
    }
}

/// The side from which power enters each mesh, in the first load case that tells.
fn driving_sides(document: &RexsDocument, train: &Drivetrain) -> Result<Vec<Option<usize>>, RexsError> {
    let mut sides = vec![None; train.meshes.len()];
    let without = [Vec::new()];
    let cases = if document.load_cases.is_empty() { &without[..] } else { &document.load_cases[..] };
    for said in cases {
        let flow = train.flow(CaseView { document, said })?;
        for (mesh, side) in sides.iter_mut().enumerate() {
            *side = side.or(flow.driving_side(mesh));
        }
    }
    Ok(sides)
}

/// Who drives a stage; `by_power` is the side that torque and speed say.
fn told(document: &RexsDocument, stage: &RexsStage, by_power: Option<usize>) -> Told {
    let drives = stage.gears.map(|gear| {
        Some(document.word(stage.data_of(document, gear)?, "is_driving_gear")?.eq_ignore_ascii_case("true"))
    });
    let names = stage.gears.map(|gear| gear.label());
    let by_file = |side: usize| Told { side: Some(side), how: None, warning: None };
    match drives {
        [Some(true), Some(false) | None] | [None, Some(false)] => by_file(0),
        [Some(false), Some(true) | None] | [None, Some(true)] => by_file(1),
        [Some(one), Some(_)] => {
            let power = by_power
                .filter(|&side| side == 1)
                .map(|side| format!("; torque and speed of the shafts say that {} drives", names[side]));
            let warning = format!(
                "is_driving_gear is {one} for both gears: gear_1, {}, is taken as the driving one{}",
                names[0],
                power.unwrap_or_default()
            );
            let how = Some("gear_1: is_driving_gear is the same for both gears".to_owned());
            Told { side: None, how, warning: Some(warning) }
        }
        [None, None] => match by_power {
            Some(side) => {
                let how = "torque and speed of the shafts say that it drives";
                let warning = (side == 1).then(|| {
                    format!(
                        "the file does not say which gear drives: {}, gear_2, by torque and speed of the shafts",
                        names[1]
                    )
                });
                Told { side: Some(side), how: Some(how.to_owned()), warning }
            }
            None => Told {
                side: None,
                how: Some("gear_1: the file does not say which gear drives".to_owned()),
                warning: Some(format!("the file does not say which gear drives: {} is taken", names[0])),
            },
        },
    }
}
