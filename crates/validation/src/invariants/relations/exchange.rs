//! Gears exchanged, and the face width turned round.

use toml::{Table, Value};

use super::{ROUNDING, SOLVED};
use crate::invariants::comparison::{Bounds, Follows, compare, compare_new};
use crate::invariants::relation::{POSITIONS, RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{exchange_gears, number, scaled, with, word};
use crate::invariants::traits_of_scene::{
    follows_tip_edges, has_heat_or_oil, has_large_strains, is_hard_severe, is_on, is_severe, is_sliced,
    takes_stable_steps, tolerance_of_steps_um, touches_beyond_range,
};

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "roles exchanged",
        states: "A mesh without friction runs backwards as it runs forwards: driven by the other gear, each gear wears as before.",
        bound: "without slices, from A to E: a stretch of the path too short to hold a position goes to the one before it, seen from E to another, 0.2 % of \
                the volume and 0.1 % of the transmission error; where tip edges are followed, whose lever on the driving gear is by up to a \
                fifth another: 10 % of the volume and 3 % of the transmission error within as far on the path as that is great; two to four slices at other \
                positions: 15 % of it; worn by adaptive steps numerics.tolerance_um",
        is_rare: false,
        check: roles,
    },
    SceneRelation {
        name: "face width turned round",
        states: "With helix angle, slopes, shaft ends and axes turned round, wear over the face width is turned round.",
        bound: "solver tolerance; worn by adaptive steps numerics.tolerance_um",
        is_rare: false,
        check: mirror,
    },
];

fn roles(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    // Where loads jump at the end of the range of tip edges, the place of the jump depends on which gear drives. Where strains are large, so is the
    // difference between the lever arms of tip edges on the two gears.
    if touches_beyond_range(subject.record) || has_large_strains(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    // Heat and oil depend on which gear drives: approach and recess, and the ratio of speeds within a phase.
    if has_heat_or_oil(table) || is_severe(table) || is_on(table, "fem") || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let (Some(z1), Some(z2)) = (number(table, "pair.pinion.teeth"), number(table, "pair.wheel.teeth")) else {
        return RelationOutcome::NotOfThisScene;
    };
    // With as many teeth ISO 6336 takes the driving gear for its gear 1.
    if z1 == z2 && word(table, "stiffness.model") == Some("iso6336") {
        return RelationOutcome::NotOfThisScene;
    }
    // Positions are those of the driving gear; the driven one lags by the transmission error, and the tip edges of the two runs differ by as much.
    // With lever arms r_b1 both runs agree within 1e-14, with those of edges 2.4 mm outside within 0.80 of the lag (seed 19, 6456).
    let lags = follows_tip_edges(table);
    let follows = Follows { exchanged: true, lags, ..Follows::default() };
    let bounds = bounds_of_roles(table);
    subject.refined(
        &[POSITIONS],
        |table| backwards(table, z2 / z1),
        |one, other| match takes_stable_steps(one) && takes_stable_steps(other) {
            true => compare(one, other, &follows, bounds),
            // More positions need shorter wear steps; the new pair needs none.
            false => compare_new(one, other, &follows, bounds),
        },
    )
}

/// The scene with its gears exchanged; `u` is the gear ratio.
fn backwards(table: &Table, u: f64) -> Table {
    let mut other = scaled(table, &|key| match key {
        "pinion_torque_Nm" => u,
        "pinion_speed_rpm" | "pinion_revolutions" | "revolutions" | "snapshots_revolutions" => 1.0 / u,
        // In reverse, the slice that entered first enters last.
        "helix_angle_deg" => -1.0,
        _ => 1.0,
    });
    exchange_gears(&mut other);
    other
}

fn bounds_of_roles(table: &Table) -> Bounds {
    // Points in another order: adaptive steps take their probes as noise by the number of a point.
    let tolerance_um = tolerance_of_steps_um(table);
    let no_point = Bounds {
        wear: f64::INFINITY,
        volume: 0.1,
        pressure: f64::INFINITY,
        cycle: 0.03,
        tolerance_um,
        ..Bounds::all(0.0)
    };
    match (is_sliced(table), follows_tip_edges(table)) {
        // A slice enters with a jump, and a position at the jump may be on either side of it.
        (true, _) if is_on(table, "hertz-mean") => Bounds { cycle: f64::INFINITY, ..no_point },
        // Positions of a pair with slices lie over one base pitch, which differ between the directions; where there are few slices, one that enters
        // moves the transmission error by its share.
        (true, _) => Bounds { cycle: 0.15, ..no_point },
        (false, true) => no_point,
        (false, false) => {
            Bounds { wear: 0.02, volume: 2e-3, pressure: 0.2, cycle: 1e-3, tolerance_um, ..Bounds::all(0.0) }
        }
    }
}

fn mirror(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if !is_sliced(table) || is_hard_severe(table) || !takes_stable_steps(subject.record) {
        return RelationOutcome::NotOfThisScene;
    }
    let mut other = scaled(table, &|key| match key {
        "helix_angle_deg" | "helix_slope_deviation_um" | "in_plane_um" | "out_of_plane_um" => -1.0,
        _ => 1.0,
    });
    for gear in ["pinion", "wheel"] {
        let key = format!("pair.{gear}.shaft.driven_at");
        if let Some(face) = word(table, &key) {
            other = with(&other, &key, Value::from(if face == "start" { "end" } else { "start" }));
        }
    }
    let follows = Follows { mirrored: true, ..Follows::default() };
    let bounds = Bounds { cycle: SOLVED, tolerance_um: tolerance_of_steps_um(table), ..Bounds::all(1e3 * ROUNDING) };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds))
}
