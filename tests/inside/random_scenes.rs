//! Scenes drawn from physical ranges: a run never panics, no number is none, wear and pressure are never negative, and the
//! loads of the tooth pairs are the load to carry at every position.

use gearwear::runs;
use gearwear::scene::{Resolved, draft::Draft, presets};
use gearwear_bodies::gear::Gear;
use gearwear_physics::assessment::RunError;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::{RunRecord, StopReason};
use gearwear_physics::simulation::wear_run::SimulationError;

use super::common::loaded;
use proptest::prelude::*;

/// Greatest relative difference between the loads of the pairs together and the load to carry.
const MOST_IMBALANCE: f64 = 1e-6;

/// A number from `low` to `high`, evenly in its logarithm.
fn logarithmic(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Values of keys within what gears have; some scenes are impossible all the same, and must be refused then.
fn scene() -> impl Strategy<Value = Result<Resolved, String>> {
    let pair = (
        prop::sample::select(vec!["fzg-c", "fzg-a", "helical"]),
        prop::sample::select(vec![0.0, 15.0, -30.0]),
        logarithmic(1.0, 200.0),
        0.0..30.0,
        -20.0..20.0,
        17.0..24.0,
    );
    let load = (logarithmic(1e-3, 3e3), logarithmic(1e-20, 1e-14), logarithmic(1.0, 1e9));
    let elastic = (logarithmic(2.0, 500.0), 0.0..0.499, logarithmic(1.0, 500.0));
    let surface = prop::sample::select(vec!["winkler", "half-space", "hertz", "hertz-mean"]);
    let step = prop::sample::select(vec!["fixed", "adaptive"]);
    (pair, load, elastic, surface, step).prop_map(|(pair, load, elastic, surface, step)| {
        let (preset, helix_angle_deg, face_width_mm, relief_um, slope_um, pressure_angle_deg) = pair;
        let (torque_nm_per_mm, coefficient, revolutions) = load;
        let (modulus_gpa, poisson_ratio, stiffness) = elastic;
        let text = presets::find(preset).map(|preset| preset.text).unwrap_or_default();
        let mut draft = Draft::parse(text).map_err(|problems| problems[0].to_string())?;
        for key in ["operation.hours", "operation.snapshots_h", "operation.snapshots_revolutions", "numerics.step"] {
            draft.remove(key);
        }
        if preset == "helical" {
            draft.set("pair.helix_angle_deg", helix_angle_deg);
            draft.set("pair.pinion.helix_slope_deviation_um", slope_um);
            draft.set("helical.slices", 5);
            draft.set("helical.coupling", if relief_um > 25.0 { "slicing" } else { "none" });
        } else {
            draft.set("pair.pressure_angle_deg", pressure_angle_deg);
        }
        draft.set("pair.face_width_mm", face_width_mm);
        draft.set("pair.pinion.tip_relief.amount_um", relief_um);
        draft.set("pair.pinion.tip_relief.length_mm", 3.0);
        draft.set("operation.pinion_torque_Nm", torque_nm_per_mm / 14.0 * face_width_mm);
        draft.set("operation.pinion_revolutions", revolutions);
        draft.set("wear.coefficient_m2_per_N", coefficient);
        draft.set("material.young_modulus_GPa", modulus_gpa);
        draft.set("material.poisson_ratio", poisson_ratio);
        draft.set("stiffness.model", "constant");
        draft.set("stiffness.pair_N_per_mm_um", stiffness);
        draft.set("contact.surface", surface);
        draft.set("contact.tip_contact", false);
        match step {
            "adaptive" => {
                draft.set("numerics.step", "adaptive");
                // Of the wear there is, not of what there might be.
                draft.set("numerics.tolerance_um", (1e16 * coefficient * revolutions * 1e-6).clamp(1e-3, 1e3));
            }
            _ => draft.set("numerics.step.revolutions", revolutions / 4.0),
        }
        draft.set("numerics.flank_points", 60);
        draft.set("numerics.positions", 24);
        draft.set("numerics.error_estimate", false);
        let mut resolved = draft.resolve().map_err(|problems| problems[0].to_string())?;
        resolved.scene.verify = false;
        Ok(resolved)
    })
}

/// The first thing about a finished run that cannot be.
fn fault(record: &RunRecord) -> Option<String> {
    let is_wrong = |x: &f64| !(x.is_finite() && *x >= 0.0);
    for gear in Gear::BOTH {
        let flank = &record.flanks[gear];
        for (what, numbers) in [
            ("wear", &flank.wear_um),
            ("pressure, new", &flank.pressure_new_MPa),
            ("pressure, worn", &flank.pressure_worn_MPa),
        ] {
            if let Some(number) = numbers.iter().find(|x| is_wrong(x)) {
                return Some(format!("{}: {what} of {number}", gear.name()));
            }
        }
    }
    let cycles = [&record.summary.new, &record.summary.worn];
    let imbalance =
        cycles.iter().map(|cycle| cycle.load_imbalance).find(|&found| found.is_nan() || found > MOST_IMBALANCE);
    imbalance.map(|imbalance| format!("loads of the pairs differ from the load by {imbalance:e} of it"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn prop_random_scenes_run_sound_or_are_refused(scene in scene()) {
        match scene {
            // A message that names its key.
            Err(message) => prop_assert!(message.contains('.') && message.contains("allowed"), "{message}"),
            Ok(resolved) => {
                let done = runs::run(&loaded(&resolved), &Unwatched);
                let done = done.map_err(|error| TestCaseError::fail(error.to_string()))?;
                match done.record.summary.stopped {
                    // More worn off than a tooth has is said, not returned.
                    StopReason::WornThrough => {
                        let deeper = matches!(done.failure, Some(RunError::Simulation(SimulationError::WornThrough { .. })));
                        prop_assert!(deeper, "{:?}", done.failure);
                    }
                    stopped => {
                        prop_assert!(done.failure.is_none(), "{:?}", done.failure);
                        prop_assert_eq!(stopped, StopReason::Completed);
                    }
                }
                prop_assert_eq!(fault(&done.record), None);
            }
        }
    }
}
