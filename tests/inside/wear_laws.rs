//! The wear laws that read temperatures, in whole runs: targets S7 and S8, and that every contact model wears by them alike.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::presets;
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::{RunRecord, Summary};
use gearwear_physics::wear::regime::Regime;

use super::common::loaded;

/// Lines exchanged in a preset that runs an hour in one step, with `more` at its end.
fn run_preset(preset: &str, edits: &[(&str, &str)], more: &str) -> RunRecord {
    let mut text = presets::find(preset).unwrap().text.to_owned();
    for (from, to) in edits {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let resolved = Resolved::from_toml(&format!("{text}\n{more}")).unwrap_or_else(|problems| panic!("{problems:?}"));
    runs::run(&loaded(&resolved), &Unwatched).unwrap().record
}

const LAW: (&str, &str) = ("law = \"archard\"", "law = \"adsorption\"");
const NO_ESTIMATE: (&str, &str) = ("error_estimate = true", "error_estimate = false\nverify = false");
const HOURS: &str = "hours = 127.75 ";
const STEP: &str = "step = { revolutions = 7665.0 }";

/// S7, Fig 20: the adsorption law at 150 and 300 rpm beside the linear law, all below 6e-4 mm. The film's constants are the
/// typical ones and k_r 1e-13 m²/N, so that the depth at the root is of the order of the linear law's with k = 1e-17 m²/N; the
/// duration, not in the text, is such that this stays below 6e-4 mm. At twice the speed the flanks slide as far in half the
/// time: less of the film is lost, though it is hotter.
#[test]
fn val_s7_adsorption_beside_the_linear_law() {
    let revolutions = "pinion_revolutions = 4e4 ";
    let run = |law: &str, k: &str, rpm: &str| {
        let edits = [
            (LAW.0, law),
            ("coefficient_m2_per_N = 1e-17 ", k),
            ("pinion_speed_rpm = 150.0", rpm),
            (HOURS, revolutions),
            (STEP, "step = { revolutions = 266.6666666666667 }"),
            ("snapshots_h", "# snapshots_h"),
            NO_ESTIMATE,
        ];
        run_preset("thesis-spur", &edits, "")
    };
    let linear = run(LAW.0, "coefficient_m2_per_N = 1e-17 ", "pinion_speed_rpm = 150.0");
    let adsorption =
        ["150.0", "300.0"].map(|rpm| run(LAW.1, "coefficient_m2_per_N = 1e-13 ", &format!("pinion_speed_rpm = {rpm}")));
    let peak = |record: &RunRecord| record.summary.pinion.peak_wear_um;
    println!(
        "peak wear in µm: linear {:.3}, adsorption {:.3} at 150 and {:.3} at 300 rpm",
        peak(&linear),
        peak(&adsorption[0]),
        peak(&adsorption[1])
    );
    for record in [&linear, &adsorption[0], &adsorption[1]] {
        assert!((0.05..0.6).contains(&peak(record)), "{}", peak(record));
        assert_eq!(record.summary.pinion.peak_wear_um, record.summary.pinion.root_wear_um);
    }
    for (slow, fast) in adsorption[0].flanks.pinion.wear_um.iter().zip(&adsorption[1].flanks.pinion.wear_um) {
        assert!(slow >= fast && (*slow == 0.0 || *fast > 0.4 * slow), "{slow} {fast}");
    }
    // The film is lost also where the flanks hardly slide: α v tends to X/t₀ exp(−E/(R T)).
    let pitch_part = |record: &RunRecord| record.summary.pinion.pitch_wear_um / peak(record);
    assert!(
        pitch_part(&adsorption[0]) > 1.5 * pitch_part(&linear),
        "{} {}",
        pitch_part(&adsorption[0]),
        pitch_part(&linear)
    );
    let law = adsorption[0].summary.wear.as_ref().unwrap();
    let k = law.effective_coefficient_new_mm3_per_Nm;
    println!("effective k {k:.2e} mm³/(N·m), regime {}", law.irg_regime.name());
    assert!((1e-9..1e-7).contains(&k), "{k}");
    assert_eq!(linear.summary.wear_of_gear.pinion.irg_regime, Regime::Two);
    assert!(
        adsorption[0]
            .summary
            .warnings
            .iter()
            .any(|warning| warning.contains("heat_of_adsorption_kJ_per_mol: typical values"))
    );
}

/// S8: oxidation holds for contact temperatures of about 200 to 400 °C; at 150 rpm and 90 °C no work at all is done there, and the
/// run says so. With the gears at 250 °C all of it is.
#[test]
fn val_s8_oxidation_outside_its_temperatures() {
    let edits = [
        ("law = \"archard\"", "law = \"oxidation\""),
        ("coefficient_m2_per_N = 1e-17", "coefficient_m2_per_N = 1.5e-10"),
        (HOURS, "hours = 1.0 "),
        (STEP, "step = { revolutions = 600.0 }"),
        ("snapshots_h", "# snapshots_h"),
        NO_ESTIMATE,
    ];
    let law = |of: &Summary| of.wear.clone().unwrap();
    let cool = run_preset("thesis-spur", &edits, "").summary;
    assert_eq!((law(&cool).work_outside_validity_new, law(&cool).work_outside_validity_worn), (Some(1.0), Some(1.0)));
    let warning = cool.warnings.iter().find(|warning| warning.contains("200 to 400 °C")).unwrap();
    assert!(warning.contains("100.0 % of the sliding work"), "{warning}");

    let hot = run_preset("thesis-spur", &edits, "[temperature]\nbulk_temperature_C = 250.0\n").summary;
    assert_eq!(law(&hot).work_outside_validity_new, Some(0.0));
    assert!(hot.warnings.iter().all(|warning| !warning.contains("200 to 400 °C")));
    assert!(hot.pinion.peak_wear_um > 1e3 * cool.pinion.peak_wear_um);

    // Around the lower bound it is the part that flash temperatures leave below it.
    let some = run_preset("thesis-spur", &edits, "[temperature]\nbulk_temperature_C = 185.0\n").summary;
    let part = law(&some).work_outside_validity_new.unwrap();
    println!("at 185 °C {:.1} % of the work is below 200 °C", 100.0 * part);
    assert!((0.05..0.95).contains(&part), "{part}");
}

/// In one step, the worn volume over ∫ p v_s dt is the work-weighted mean coefficient, on every contact surface and by every method, though the
/// one comes from the pressures at the flank points and the other from loads and half-widths seen from outside.
#[test]
fn ver_every_surface_wears_by_the_mean_coefficient() {
    let quick = [
        ("positions = 400 ", "positions = 200 "),
        ("snapshots_h", "# snapshots_h"),
        NO_ESTIMATE,
        (HOURS, "pinion_revolutions = 10.0 "),
        (STEP, "step = { revolutions = 10.0 }"),
    ];
    for (surface, method, allowed) in [
        ("winkler", "tian-kennedy", 0.005),
        // Its pressure is a parabola, and what is seen from outside Hertz's ellipse.
        ("winkler", "heat-equation", 0.06),
        ("half-space", "williams", 0.005),
        ("half-space", "heat-equation", 0.005),
        ("hertz", "heat-equation", 0.005),
        ("hertz-mean", "williams", 0.005),
    ] {
        let surface_line = format!("surface = \"{surface}\"");
        let run = |law: (&str, &str)| {
            let edits = [quick.as_slice(), &[law, ("surface = \"winkler\"", &surface_line)]].concat();
            run_preset("thesis-spur", &edits, &format!("[temperature]\nmethod = \"{method}\"\n"))
        };
        check_mean_coefficient(&format!("{surface}, {method}"), &run((LAW.0, LAW.0)), &run(LAW), allowed);
    }
}

/// The same of slices, also where their wear is kept at the contact points.
#[test]
fn ver_slices_wear_by_the_mean_coefficient() {
    for (surface, method, allowed) in [("hertz", "heat-equation", 0.005), ("hertz-mean", "tian-kennedy", 0.005)] {
        let surface_line = format!("surface = \"{surface}\"");
        let run = |law: (&str, &str)| {
            let edits = [
                law,
                ("surface = \"half-space\"", &surface_line),
                ("# [stiffness] ", "[stiffness] "),
                ("# model = \"weber-banaschek\"", "model = \"weber-banaschek\""),
                ("# coupling = \"slicing\" ", "coupling = \"none\" "),
                ("pinion_revolutions = 6e5", "pinion_revolutions = 10.0"),
                ("flank_points = 750 ", "flank_points = 300 "),
                ("step = \"adaptive\" ", "step = { revolutions = 10.0 } "),
                ("tolerance_um", "# tolerance_um"),
                ("error_estimate = true ", "error_estimate = false "),
                ("verify = true ", "verify = false "),
            ];
            run_preset("h951", &edits, &format!("[temperature]\nmethod = \"{method}\"\n"))
        };
        check_mean_coefficient(&format!("slices, {surface}, {method}"), &run((LAW.0, LAW.0)), &run(LAW), allowed);
    }
}

/// The same of finite elements, with tips relieved by more than the teeth bend: what touches before A and after E is no position of the
/// path, and slides faster.
#[test]
fn ver_finite_elements_wear_by_the_mean_coefficient() {
    let run = |law: (&str, &str)| {
        let edits = [
            law,
            ("positions = 400 ", "positions = 60 "),
            ("snapshots_h", "# snapshots_h"),
            NO_ESTIMATE,
            (HOURS, "pinion_revolutions = 10.0 "),
            (STEP, "step = { revolutions = 10.0 }"),
            ("surface = \"winkler\"", "surface = \"fem\""),
            ("tip_contact = false", "tip_contact = true"),
            (
                "[pair.pinion] ",
                "[pair.pinion]\ntip_relief = { amount_um = 60.0, length_mm = 5.0, shape = \"parabolic\" } ",
            ),
            ("[pair.wheel]", "[pair.wheel]\ntip_relief = { amount_um = 60.0, length_mm = 5.0, shape = \"parabolic\" }"),
        ];
        run_preset("thesis-spur", &edits, "[fem]\nelements_per_half_width = 4\n")
    };
    check_mean_coefficient("finite elements", &run((LAW.0, LAW.0)), &run(LAW), 0.03);
}

fn check_mean_coefficient(what: &str, linear: &RunRecord, adsorption: &RunRecord, allowed: f64) {
    let mean = adsorption.summary.wear.as_ref().unwrap().effective_coefficient_new_mm3_per_Nm;
    let k = linear.summary.wear.as_ref().unwrap().effective_coefficient_new_mm3_per_Nm;
    let volume = |record: &RunRecord| record.summary.pinion.worn_volume_mm3 + record.summary.wheel.worn_volume_mm3;
    let found = k * volume(adsorption) / volume(linear);
    println!("{what}: {found:.4e} by the flanks, {mean:.4e} by the contacts");
    assert!((found / mean - 1.0).abs() < allowed, "{what}: {found} {mean}");
    assert!(Gear::BOTH.iter().all(|&gear| adsorption.flanks[gear].wear_um.iter().all(|wear| wear.is_finite())));
}
