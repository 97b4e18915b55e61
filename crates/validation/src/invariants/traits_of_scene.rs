//! Properties of a scene that relations depend on.

use toml::{Table, Value};

use gearwear_physics::results::run::RunRecord;

use super::scene_table::{gives, number, phases, value, word};

/// Whether some gear's wear law has a transition at `severe.above_MPa` without a band: its rate is discontinuous there.
pub(super) fn is_hard_severe(table: &Table) -> bool {
    ["wear", "wear.pinion", "wear.wheel"].iter().any(|whose| {
        gives(table, &format!("{whose}.severe"))
            && number(table, &format!("{whose}.severe.band_MPa")).unwrap_or(0.0) == 0.0
    })
}

/// Whether anything depends on time or temperature: speeds, oil, heat.
pub(super) fn has_heat_or_oil(table: &Table) -> bool {
    let laws = ["wear.law", "wear.pinion.law", "wear.wheel.law"];
    let is_thermal = laws.iter().any(|law| word(table, law).is_some_and(|law| law != "archard"));
    is_thermal || ["temperature", "lubricant", "friction"].iter().any(|key| gives(table, key))
}

/// Whether steps are of a fixed length, so that two runs take the same ones.
pub(super) fn has_fixed_steps(table: &Table) -> bool {
    gives(table, "numerics.step.revolutions")
}

/// Tolerance of adaptive steps, where the scene asks for them and says it.
pub(super) fn tolerance_of_steps_um(table: &Table) -> Option<f64> {
    number(table, "numerics.tolerance_um").filter(|_| !has_fixed_steps(table))
}

/// Whether both gears have one coefficient in all phases.
pub(super) fn has_one_coefficient(table: &Table) -> bool {
    !["wear.pinion", "wear.wheel"].iter().any(|whose| gives(table, whose))
        && !phases(table).is_some_and(|phases| phases.iter().any(|phase| phase.get("coefficient_m2_per_N").is_some()))
}

/// Whether sections differ over the face width, so that the run has slices.
pub(super) fn is_sliced(table: &Table) -> bool {
    let over_width = ["lead_crowning_um", "helix_slope_deviation_um", "end_relief", "shaft"];
    number(table, "pair.helix_angle_deg").is_some_and(|angle| angle != 0.0)
        || gives(table, "pair.axis_parallelism")
        || ["pinion", "wheel"].into_iter().any(|gear| {
            let mut keys = over_width.iter();
            keys.any(|key| gives(table, &format!("pair.{gear}.{key}")))
        })
}

pub(super) fn is_on(table: &Table, surface: &str) -> bool {
    word(table, "contact.surface") == Some(surface)
}

/// Whether three-dimensional or plane finite elements are part of the model.
pub(super) fn has_finite_elements(table: &Table) -> bool {
    is_on(table, "fem")
        || word(table, "stiffness.model") == Some("fem")
        || word(table, "helical.coupling") == Some("fem")
}

/// Whether the run follows tip edges into contact outside A to E.
pub(super) fn follows_tip_edges(table: &Table) -> bool {
    let is_cut_off = value(table, "contact.tip_contact").and_then(Value::as_bool) == Some(false);
    is_on(table, "fem") || (!is_cut_off && !is_on(table, "hertz") && !is_on(table, "hertz-mean"))
}

/// Whether any gear wears severely anywhere by its law.
pub(super) fn is_severe(table: &Table) -> bool {
    ["wear", "wear.pinion", "wear.wheel"].iter().any(|whose| gives(table, &format!("{whose}.severe")))
}

/// Whether no wear step is longer than what is stable: longer ones amplify the last bits.
pub(super) fn takes_stable_steps(record: &RunRecord) -> bool {
    !record.summary.warnings.iter().any(|warning| warning.starts_with("numerics.step"))
}

/// Whether teeth touch farther outside A to E than the run follows them: there loads jump.
pub(super) fn touches_beyond_range(record: &RunRecord) -> bool {
    record.summary.warnings.iter().any(|warning| warning.starts_with("loaded teeth touch farther"))
}

/// Whether contacts are so wide that the run calls its result unreliable.
pub(super) fn has_large_strains(record: &RunRecord) -> bool {
    record.summary.warnings.iter().any(|warning| warning.contains("strains are not small"))
}

/// Whether the stiffness model is not similar: c' of ISO 6336 falls with the line load below 100 N/mm.
pub(super) fn has_a_size(table: &Table, record: &RunRecord) -> bool {
    let loads = record.summary.phases.iter().map(|phase| phase.line_load_N_per_mm);
    word(table, "stiffness.model") == Some("iso6336") && loads.fold(f64::INFINITY, f64::min) < 100.0
}
