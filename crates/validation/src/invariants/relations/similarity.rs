//! Laws of similarity: sizes, moduli, widths.

use toml::Table;

use crate::invariants::comparison::{Bounds, Follows, compare};
use crate::invariants::relation::{RelationOutcome, SceneRelation, Subject};
use crate::invariants::scene_table::{gives, scaled};
use crate::invariants::traits_of_scene::{
    has_a_size, has_finite_elements, has_heat_or_oil, is_hard_severe, is_sliced, takes_stable_steps,
    tolerance_of_steps_um,
};
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::run::RunRecord;

/// Relative effect of the tolerance of the equilibria, amplified by steps.
const BOUNDS: Bounds = Bounds { volume: 1e-5, cycle: 1e-5, ..Bounds::all(1e-4) };
/// Factor on sizes: no power of two, so that the digits change.
const SIZE: f64 = 1.7;
const MODULUS: f64 = 1.9;
const WIDTH: f64 = 1.3;

pub(super) const RELATIONS: &[SceneRelation] = &[
    SceneRelation {
        name: "size",
        states: "All lengths times s and the torque times s³: the same pressures, s times the wear depth, s³ times the volume.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: size,
    },
    SceneRelation {
        name: "modulus and torque",
        states: "Young's moduli, torque and limits of pressure times c, wear coefficients over c: c times the pressure, the same deformation and wear.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: modulus,
    },
    SceneRelation {
        name: "face width",
        states: "Face width and torque of a pair without slices times c: the same in every section, c times the volume.",
        bound: "equilibria solved to 1e-10 of the load, which steps amplify: 1e-4 at a point, 1e-5 of volume and transmission error; \
                worn by as many adaptive steps 1 %, by another number of them numerics.tolerance_um, and no pressure",
        is_rare: false,
        check: width,
    },
];

/// Relative differences at the same number of adaptive steps, whose lengths depend on the last bits of an error estimate: seed 7, scene 6202 has 0.16
/// % of the depth, 5546 0.07 % of the pressure.
const OF_STEP_LENGTHS: f64 = 1e-2;

/// Bounds with adaptive steps. Their length follows from an estimate of the stiffness of the rate with a threshold, so that the last bits may change
/// the steps; one step more or less changes the depth by a part of the tolerance.
fn bounds(subject: &Subject<'_>, other: &RunRecord) -> Bounds {
    let [mine, theirs] = [subject.record, other].map(|record| &record.summary.work);
    let same_steps = mine.wear_steps == theirs.wear_steps && mine.rejected_steps == theirs.rejected_steps;
    match tolerance_of_steps_um(subject.table) {
        Some(_) if same_steps => Bounds { least_of_worn: OF_STEP_LENGTHS, ..BOUNDS },
        tolerance_um => Bounds { tolerance_um, ..BOUNDS },
    }
}

fn size(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if has_heat_or_oil(table)
        || is_hard_severe(table)
        || !takes_stable_steps(subject.record)
        || has_a_size(table, subject.record)
    {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| match key {
        "pinion_torque_Nm" => SIZE.powi(3),
        "foundation_MPa_per_mm" => 1.0 / SIZE,
        // N/mm per µm does not depend on the size.
        "pair_N_per_mm_um" => 1.0,
        key if key.ends_with("_mm") || key.ends_with("_um") => SIZE,
        _ => 1.0,
    });
    let depth = PerGear { pinion: SIZE, wheel: SIZE };
    let follows = Follows { depth, error: SIZE, area: SIZE * SIZE, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}

fn modulus(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    // Values from a preset of materials or a default cannot be scaled.
    if has_heat_or_oil(table)
        || is_hard_severe(table)
        || !says_its_moduli(table)
        || !takes_stable_steps(subject.record)
        || has_a_size(table, subject.record)
    {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| match key {
        "young_modulus_GPa"
        | "pinion_torque_Nm"
        | "above_MPa"
        | "band_MPa"
        | "foundation_MPa_per_mm"
        | "pair_N_per_mm_um" => MODULUS,
        "coefficient_m2_per_N" | "coefficient_mm3_per_Nm" => 1.0 / MODULUS,
        _ => 1.0,
    });
    let follows = Follows { pressure: MODULUS, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}

/// Whether the scene says both Young's moduli by number.
fn says_its_moduli(table: &Table) -> bool {
    gives(table, "material.young_modulus_GPa")
        || ["pinion", "wheel"].iter().all(|gear| gives(table, &format!("material.{gear}.young_modulus_GPa")))
}

fn width(subject: &Subject<'_>) -> RelationOutcome {
    let table = subject.table;
    if is_sliced(table)
        || has_heat_or_oil(table)
        || has_finite_elements(table)
        || is_hard_severe(table)
        || !takes_stable_steps(subject.record)
    {
        return RelationOutcome::NotOfThisScene;
    }
    let other = scaled(table, &|key| match key {
        "face_width_mm" | "pinion_torque_Nm" => WIDTH,
        _ => 1.0,
    });
    let follows = Follows { area: WIDTH, ..Follows::default() };
    subject.beside(other, |record| compare(subject.record, record, &follows, bounds(subject, record)))
}
