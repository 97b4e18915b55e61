//! A wear law for each gear: on flanks that wear too little to change the contact, each gear's depth is its own coefficient times what
//! the contact gives, dh = k p ds (Archard), whatever the mate wears by.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

/// One Euler step: all of it is worn on the unworn flanks.
const ONE_STEP: &str = "pinion_revolutions = 100.0\nsnapshots_revolutions = [100.0]\n";
const SURFACES: [&str; 5] = ["hertz-mean", "hertz", "winkler", "half-space", "fem"];
const BOTH: &str = "law = \"archard\"\ncoefficient_m2_per_N = 1e-17\n";

fn scene(operation: &str, surface: &str, wear: &str, numerics: &str) -> String {
    let stiffness = match surface {
        "fem" => "",
        _ => "[stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n",
    };
    format!(
        "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\n{operation}\
         [contact]\nsurface = \"{surface}\"\n{stiffness}[wear]\n{wear}\
         [numerics]\nflank_points = 120\npositions = 60\nerror_estimate = false\nverify = false\n{numerics}\n"
    )
}

fn run(text: &str) -> RunRecord {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}"));
    let again = Resolved::from_toml(&resolved.to_toml()).unwrap_or_else(|problems| panic!("{problems:?}"));
    assert_eq!(again.scene, resolved.scene, "{}", resolved.to_toml());
    runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap()
}

/// Each wear depth of `gear` is that of `other`, times `factor`, bit for bit.
fn assert_times(what: &str, record: &RunRecord, other: &RunRecord, gear: Gear, factor: f64) {
    let (own, reference) = (&record.flanks[gear].wear_um, &other.flanks[gear].wear_um);
    assert_eq!(own.len(), reference.len());
    assert!(reference.iter().any(|depth| *depth > 0.0));
    for (own, reference) in own.iter().zip(reference) {
        assert_eq!(*own, factor * reference, "{what}, {}", gear.name());
    }
}

/// Closed forms of one step, k twice as great, k = 0, and the same law written for each gear; powers of two leave all bits.
fn check_closed_forms(what: &str, run: &dyn Fn(&str) -> RunRecord) {
    let one = run(BOTH);
    let twice = run(&format!("{BOTH}pinion.coefficient_m2_per_N = 2e-17\n"));
    assert_times(what, &twice, &one, Gear::Pinion, 2.0);
    assert_times(what, &twice, &one, Gear::Wheel, 1.0);
    for still in Gear::BOTH {
        let record = run(&format!("{BOTH}{}.coefficient_m2_per_N = 0.0\n", still.name()));
        assert!(record.flanks[still].wear_um.iter().all(|depth| *depth == 0.0), "{what}");
        assert_times(what, &record, &one, still.mate(), 1.0);
        let balance = &record.summary.wear_balance;
        assert_eq!((balance.new, balance.worn), (None, None));
        assert!(balance.not_compared.as_ref().unwrap().contains(&format!("the {} does not wear", still.name())));
    }
    let each = "law = \"archard\"\ncoefficient_m2_per_N = 1e-17";
    let each = format!("[wear.pinion]\n{each}\n[wear.wheel]\n{each}\n");
    let alike = run(&each);
    for gear in Gear::BOTH {
        assert_times(what, &alike, &one, gear, 1.0);
    }
    assert_eq!(alike.summary.wear, one.summary.wear);
    assert_eq!(alike.mesh_cycle, one.mesh_cycle);

    // The balance compares what each coefficient predicts.
    let [of_one, of_twice] = [&one, &twice].map(|record| record.summary.wear_balance.new.unwrap());
    assert!((of_one - of_twice).abs() < 1e-12, "{what}: {of_one} {of_twice}");
    assert!(twice.summary.warnings.iter().all(|warning| !warning.contains("lose volumes")) || of_one > 0.02);
    assert_eq!((&twice.summary.wear, twice.summary.phases[0].coefficient_m2_per_N), (&None, None));
    let of = PerGear { pinion: 2e-8, wheel: 1e-8 };
    for gear in Gear::BOTH {
        let law = &twice.summary.wear_of_gear[gear];
        assert!((law.effective_coefficient_new_mm3_per_Nm / of[gear] - 1.0).abs() < 1e-12);
    }
}

#[test]
fn ver_each_gear_wears_by_its_own_coefficient_on_every_surface() {
    for surface in SURFACES {
        check_closed_forms(surface, &|wear| run(&scene(ONE_STEP, surface, wear, "step = { revolutions = 100.0 }")));
    }
}

/// The same of slices, also where their wear is kept at the contact points and where plates couple them.
#[test]
fn ver_each_gear_wears_by_its_own_coefficient_in_slices() {
    for (surface, coupling) in [("hertz-mean", "none"), ("hertz", "none"), ("half-space", "slicing")] {
        let sliced = |wear: &str| {
            let text = scene(ONE_STEP, surface, wear, "step = { revolutions = 100.0 }")
                .replace("preset = \"fzg-c\"\n", "preset = \"helical\"\n");
            run(&format!("{text}[helical]\nslices = 6\ncoupling = \"{coupling}\"\n"))
        };
        check_closed_forms(&format!("{surface}, {coupling}"), &sliced);
    }
}

/// A phase's own coefficient of one gear: three times as much in the second phase, as long as the first.
#[test]
fn ver_a_phase_has_a_coefficient_for_each_gear() {
    let phases = "[[operation.phases]]\npinion_revolutions = 1e5\n[[operation.phases]]\npinion_revolutions = 1e5\n\
                  wheel.coefficient_m2_per_N = 3e-24\n";
    let tiny = "law = \"archard\"\ncoefficient_m2_per_N = 1e-24\npinion.coefficient_mm3_per_Nm = 2e-15\n";
    let record = run(&scene(phases, "winkler", tiny, "step = { revolutions = 1e5 }"));
    for (gear, ratio) in [(Gear::Pinion, 1.0), (Gear::Wheel, 3.0)] {
        let of = |phase: usize| {
            let phase = &record.summary.phases[phase];
            if gear == Gear::Pinion { phase.pinion } else { phase.wheel }
        };
        let found = of(1).greatest_depth_um / of(0).greatest_depth_um;
        // The wear changes the contact by parts of 1e-7 (some 1e-9 µm beside an approach of some 10 µm).
        assert!((found / ratio - 1.0).abs() < 1e-6, "{}: {found}", gear.name());
        assert!((of(1).coefficient_m2_per_N / of(0).coefficient_m2_per_N / ratio - 1.0).abs() < 1e-12);
    }
}

/// A law that reads temperatures for one gear leaves the wear of its mate as it is, and a transition acts on the gear that has one.
#[test]
fn ver_laws_of_different_kinds() {
    let one_step = |wear: &str| run(&scene(ONE_STEP, "hertz", wear, "step = { revolutions = 100.0 }"));
    let one = one_step(BOTH);
    let adsorbed = |of: &str| format!("{of}law = \"adsorption\"\n{of}coefficient_m2_per_N = 1e-13\n");
    let both = one_step(&adsorbed(""));
    let mixed = one_step(&format!("{BOTH}{}", adsorbed("wheel.")));
    assert_times("adsorption of the wheel", &mixed, &one, Gear::Pinion, 1.0);
    assert_times("adsorption of the wheel", &mixed, &both, Gear::Wheel, 1.0);
    let laws = &mixed.summary.wear_of_gear;
    assert_eq!((laws.pinion.law.as_str(), laws.wheel.law.as_str()), ("archard", "adsorption"));
    assert_eq!(mixed.summary.wear_balance.not_compared.as_deref(), Some("the gears wear by different laws"));
    let typical = |warning: &String| warning.contains("[wear.wheel.adsorption]");
    assert!(mixed.summary.warnings.iter().any(typical), "{:?}", mixed.summary.warnings);

    // Above no pressure at all, and so everywhere.
    let severe = one_step(&format!("{BOTH}pinion.severe = {{ above_MPa = 1e-9, factor = 4.0 }}\n"));
    assert_times("severe wear of the pinion", &severe, &one, Gear::Pinion, 4.0);
    assert_times("severe wear of the pinion", &severe, &one, Gear::Wheel, 1.0);
}

/// Many steps, adaptive ones too, with a gear that does not wear, and the error estimates of such a run.
#[test]
fn ver_a_gear_without_wear_through_a_life() {
    let still = format!("{BOTH}wheel.coefficient_m2_per_N = 0.0\n");
    for step in ["step = \"adaptive\"\ntolerance_um = 0.5", "step = { revolutions = 5e4 }"] {
        let text = scene("pinion_revolutions = 1e6\n", "winkler", &still, step)
            .replace("error_estimate = false", "error_estimate = true")
            .replace("positions = 60", "positions = 100");
        let record = run(&text);
        assert_eq!(record.summary.wheel.peak_wear_um, 0.0);
        assert!(record.summary.pinion.peak_wear_um > 1.0, "{}", record.summary.pinion.peak_wear_um);
        let both = run(&text.replace("wheel.coefficient_m2_per_N = 0.0\n", ""));
        let [own, of_both] =
            [&record, &both].map(|record| [record.summary.error.discretisation, record.summary.error.wear_step]);
        assert_eq!(
            own.map(|error| error.is_some()),
            of_both.map(|error| error.is_some()),
            "{:?}",
            record.summary.error.how
        );
        assert!(own.into_iter().flatten().all(f64::is_finite), "{own:?}");
    }
}
