//! Laws of similarity: sizes, moduli, widths.

use toml::Table;

use crate::gear::PerGear;
use crate::results::run::RunRecord;
use crate::studies::invariants::comparison::{Bounds, Follows, compare};
use crate::studies::invariants::relation::{Relation, Subject, Verdict};
use crate::studies::invariants::scene_table::{gives, scaled};
use crate::studies::invariants::traits_of_scene::{
    has_a_size, has_finite_elements, has_heat_or_oil, is_hard_severe, is_severe, is_sliced, takes_stable_steps,
    tolerance_of_steps_um,
};

/// What steps make of the tolerance of the equilibria.
const BOUNDS: Bounds = Bounds { volume: 1e-5, cycle: 1e-5, ..Bounds::all(1e-4) };
/// No power of two, so that digits change.
const SIZE: f64 = 1.7;
const MODULUS: f64 = 1.9;
const WIDTH: f64 = 1.3;
/// A power of two, which changes no digits.
const DOUBLE: f64 = 2.0;

pub(super) const RELATIONS: &[Relation] = &[
    Relation {
        name: "size",
        states: "All lengths times s and the torque times s³: the same pressures, s times the wear depth, s³ times the volume.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: size,
    },
    Relation {
        name: "modulus and torque",
        states: "Young's moduli, torque and limits of pressure times c, wear coefficients over c: c times the pressure, the same deformation and wear.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: modulus,
    },
    Relation {
        name: "face width",
        states: "Face width and torque of a pair without slices times c: the same in every section, c times the volume.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: width,
    },
];

/// Worn by as many adaptive steps, whose lengths follow the last bits of an estimate: seed 7, 6202 has 0.16 % of the depth, 5546 0.07 % of the pressure.
const OF_STEP_LENGTHS: f64 = 1e-2;

/// Adaptive steps are chosen by the stiffness of the rate, whose estimate ends at a threshold: the last bits may decide on other steps, of which one more or
/// less moves the depth by a part of what they promise.
fn bounds(subject: &Subject<'_>, other: &RunRecord) -> Bounds {
    let steps = |record: &RunRecord| (record.summary.work.wear_steps, record.summary.work.rejected_steps);
    match tolerance_of_steps_um(subject.table) {
        Some(_) if steps(subject.record) == steps(other) => Bounds { least_of_worn: OF_STEP_LENGTHS, ..BOUNDS },
        tolerance_um => Bounds { tolerance_um, ..BOUNDS },
    }
}

/// The factor by which a scene is made similar. Adaptive steps do not keep their tolerance through the transition to severe wear, where wear goes with a high
/// power of the pressure: last bits that choose other steps, 312 or 267 of them, make 0.75 µm of 13 µm at a tolerance of 0.31 µm, either run being 1.8 to 2.1 µm
/// off 64,000 short steps (seed 19, 14364; 5e-3 µm at a tolerance of 0.03 µm, 3e-4 µm at 0.01 µm). There the digits must be the same.
fn similar_by(table: &Table, by: f64) -> f64 {
    if tolerance_of_steps_um(table).is_some() && is_severe(table) { DOUBLE } else { by }
}

fn size(subject: &Subject<'_>) -> Verdict {
    let table = subject.table;
    if has_heat_or_oil(table)
        || is_hard_severe(table)
        || !takes_stable_steps(subject.record)
        || has_a_size(table, subject.record)
    {
        return Verdict::NotOfThisScene;
    }
    let size = similar_by(table, SIZE);
    let other = scaled(table, &|key| match key {
        "pinion_torque_Nm" => size.powi(3),
        "foundation_MPa_per_mm" => 1.0 / size,
        // N/mm for every µm: as great at any size.
        "pair_N_per_mm_um" => 1.0,
        key if key.ends_with("_mm") || key.ends_with("_um") => size,
        _ => 1.0,
    });
    let depth = PerGear { pinion: size, wheel: size };
    let follows = Follows { depth, error: size, area: size * size, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}

fn modulus(subject: &Subject<'_>) -> Verdict {
    let table = subject.table;
    // What a preset of materials or a default gives cannot be raised.
    if has_heat_or_oil(table)
        || is_hard_severe(table)
        || !says_its_moduli(table)
        || !takes_stable_steps(subject.record)
        || has_a_size(table, subject.record)
    {
        return Verdict::NotOfThisScene;
    }
    let modulus = similar_by(table, MODULUS);
    let other = scaled(table, &|key| match key {
        "young_modulus_GPa"
        | "pinion_torque_Nm"
        | "above_MPa"
        | "band_MPa"
        | "foundation_MPa_per_mm"
        | "pair_N_per_mm_um" => modulus,
        "coefficient_m2_per_N" | "coefficient_mm3_per_Nm" => 1.0 / modulus,
        _ => 1.0,
    });
    let follows = Follows { pressure: modulus, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}

/// Whether the scene says both Young's moduli by number.
fn says_its_moduli(table: &Table) -> bool {
    gives(table, "material.young_modulus_GPa")
        || ["pinion", "wheel"].iter().all(|gear| gives(table, &format!("material.{gear}.young_modulus_GPa")))
}

fn width(subject: &Subject<'_>) -> Verdict {
    let table = subject.table;
    if is_sliced(table)
        || has_heat_or_oil(table)
        || has_finite_elements(table)
        || is_hard_severe(table)
        || !takes_stable_steps(subject.record)
    {
        return Verdict::NotOfThisScene;
    }
    let width = similar_by(table, WIDTH);
    let other = scaled(table, &|key| match key {
        "face_width_mm" | "pinion_torque_Nm" => width,
        _ => 1.0,
    });
    let follows = Follows { area: width, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}
