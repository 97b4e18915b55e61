//! Finer resolutions give the same result.

use crate::invariants::comparison::{Measured, difference, worn_volume_mm3};
use crate::invariants::relation::{POINTS, POSITIONS, RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{gives, number, with};
use crate::invariants::traits_of_scene::{follows_tip_edges, has_heat_or_oil, is_severe, takes_stable_steps};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::RunRecord;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "finer flanks",
        states: "Twice the flank points come to the same worn volumes and transmission error.",
        bound: "60 to 120 points of a flank, some three in a contact: 15 % of the volume, 3 % of the transmission error; where they are too few, four or \
                sixteen times as many",
        is_rare: false,
        check: finer_points,
    },
    SceneRelation {
        name: "finer positions",
        states: "Twice the positions come to the same worn volumes and transmission error.",
        bound: "24 to 160 positions, of second order where loads change steadily: 15 % of the volume, 15 % of the transmission error; where \
                they are too few for narrow contacts, four or sixteen times as many",
        is_rare: false,
        check: finer_positions,
    },
];

const OF_VOLUME: f64 = 0.15;

fn finer_points(subject: &Subject<'_>) -> RelationOutcome {
    finer(subject, POINTS, 2.0, 0.03)
}

fn finer_positions(subject: &Subject<'_>) -> RelationOutcome {
    // Both ends remain positions, and the new positions lie halfway between the old ones.
    finer(subject, POSITIONS, 2.0, 0.15)
}

fn finer(subject: &Subject<'_>, key: &str, by: f64, of_error: f64) -> RelationOutcome {
    let table = subject.table;
    // Temperatures and pressure limits make wear depend on further resolutions. Where contact is cut off, the rounding of a tip removes the wear of
    // the nearest flank points only.
    if !follows_tip_edges(table) || is_severe(table) || has_heat_or_oil(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    if !gives(table, key) {
        return RelationOutcome::NotOfThisScene;
    }
    subject.refined(
        &[key],
        |table| with(table, key, (by * number(table, key).unwrap_or_default()) as i64),
        |one, other| volumes_and_error(one, other, of_error),
    )
}

/// Worn volumes and transmission error; no volumes where a run takes steps that are too long for it: twice the points halve the stable one.
pub(super) fn volumes_and_error(first: &RunRecord, other: &RunRecord, of_error: f64) -> Vec<Measured> {
    let is_stable = takes_stable_steps(first) && takes_stable_steps(other);
    let worn = Gear::BOTH.into_iter().filter(|_| is_stable);
    let mut found: Vec<Measured> = worn
        .map(|gear| {
            let [mine, theirs] = [first, other].map(|record| worn_volume_mm3(&record.summary, gear));
            Measured::new(format!("worn volume of the {}", gear.name()), difference(&[mine], &[theirs], 1.0), OF_VOLUME)
        })
        .collect();
    let [mine, theirs] = [first, other].map(|record| record.summary.new.transmission_error_um);
    for (name, mine, theirs) in [("least", mine.min, theirs.min), ("greatest", mine.max, theirs.max)] {
        found.push(Measured::new(
            format!("{name} new transmission error"),
            difference(&[mine], &[theirs], 1.0),
            of_error,
        ));
    }
    found
}
