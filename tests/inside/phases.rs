//! A load spectrum: phases that follow each other, against plain runs and what physics says, and what is refused.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

const OPERATION: &str = "pinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\n";
const NUMERICS: &str = "flank_points = 120\npositions = 40\nstep = { revolutions = 10000.0 }\n";

fn scene(operation: &str, contact: &str, coefficient: f64, more: &str) -> String {
    let pair = if more.contains("[helical]") { "helical" } else { "fzg-c" };
    let stiffness = if more.contains("coupling = \"fem\"") { "fem" } else { "weber-banaschek" };
    format!(
        "[pair]\npreset = \"{pair}\"\n[operation]\n{operation}\n[contact]\n{contact}\n[stiffness]\nmodel = \"{stiffness}\"\n[wear]\nlaw = \"archard\"\n\
         coefficient_m2_per_N = {coefficient:e}\n[numerics]\nerror_estimate = false\nverify = false\n{NUMERICS}{more}\n"
    )
}

fn run(text: &str) -> RunRecord {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert_eq!(done.failure, None);
    done.record
}

/// `[[operation.phases]]` with these lines.
fn phases(of: &[&str]) -> String {
    of.iter().map(|lines| format!("[[operation.phases]]\n{lines}\n")).collect()
}

fn spectrum(of: &[&str], contact: &str, coefficient: f64, more: &str) -> RunRecord {
    run(&scene(&format!("{OPERATION}{}", phases(of)), contact, coefficient, more))
}

fn assert_close(what: &str, value: f64, expected: f64, relative: f64) {
    assert!((value / expected - 1.0).abs() <= relative, "{what}: {value} instead of {expected}");
}

const WINKLER: &str = "surface = \"winkler\"\ntip_contact = false";
/// So little wear that no pressure changes by it.
const NEGLIGIBLE: f64 = 1e-24;

#[test]
fn ver_one_phase_is_the_plain_run_to_the_bit() {
    let snapshots = "snapshots_revolutions = [150000.0, 400000.0]\n";
    let plain = run(&scene(&format!("{OPERATION}pinion_revolutions = 4e5\n{snapshots}"), WINKLER, 2e-17, ""));
    let one = format!("{OPERATION}{snapshots}{}", phases(&["pinion_revolutions = 4e5"]));
    let one = run(&scene(&one, WINKLER, 2e-17, ""));
    assert!(plain.flanks == one.flanks && plain.history == one.history && plain.mesh_cycle == one.mesh_cycle);
    assert_eq!(plain.summary.phases, one.summary.phases);
    assert_eq!(plain.summary.phases.len(), 1);
}

/// Two equal phases are one run, on every kind of contact: the steps divide the phases, and only the starts of equilibria differ. Finite
/// elements also follow the tilt of the flanks from where the second phase begins, which they know to 1e-3 of the levers.
#[test]
fn ver_two_equal_phases_are_one_run() {
    let half = "pinion_revolutions = 200000.0";
    let fem = "[fem]\nbody = \"sector\"\nsector_teeth = 5\nelements_per_half_width = 3";
    let cases = [
        (WINKLER, ""),
        ("surface = \"hertz\"", ""),
        ("surface = \"half-space\"\ntip_contact = false", ""),
        ("surface = \"fem\"", fem),
        (WINKLER, "[helical]\nslices = 4"),
        ("surface = \"hertz-mean\"", "[helical]\nslices = 4"),
        ("surface = \"hertz-mean\"", "[helical]\nslices = 4\ncoupling = \"slicing\""),
        ("surface = \"half-space\"", "[helical]\nslices = 4\ncoupling = \"fem\""),
    ];
    for (contact, more) in cases {
        let plain = format!("{OPERATION}pinion_revolutions = 4e5\nsnapshots_revolutions = [2e5, 4e5]\n");
        let plain = run(&scene(&plain, contact, 2e-17, more));
        let two = format!("{OPERATION}snapshots_revolutions = [2e5, 4e5]\n{}", phases(&[half, half]));
        let two = run(&scene(&two, contact, 2e-17, more));
        assert_eq!(two.summary.work.wear_steps, plain.summary.work.wear_steps, "{contact} {more}");
        let wear = |record: &RunRecord| record.flanks.pinion.wear_um.clone();
        let greatest = plain.summary.pinion.peak_wear_um;
        let differs = wear(&plain).iter().zip(wear(&two)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Equilibria are found to 1e-11 of the load (load_sharing::TOLERANCE, the simplified model to 2e-10), and pressure to that.
        let known = if contact.contains("fem") { 1e-3 } else { 1e-8 };
        assert!(differs <= known * greatest, "{contact} {more}: {differs} of {greatest}");
        assert!(greatest > 0.1, "{contact} {more}: {greatest}");
    }
}

/// Phases of different loads wear the same nodes of finite elements: they run to their end, and wear more than the first alone.
#[test]
fn ver_phases_of_different_loads_on_finite_elements() {
    let fem = "[fem]\nbody = \"sector\"\nsector_teeth = 5\nelements_per_half_width = 3";
    let of = |torques: &[f64]| {
        let each = torques.iter().map(|torque| format!("pinion_revolutions = 1e5\npinion_torque_Nm = {torque:?}"));
        let each: Vec<String> = each.collect();
        let each: Vec<&str> = each.iter().map(String::as_str).collect();
        run(&scene(&format!("{OPERATION}{}", phases(&each)), "surface = \"fem\"", 2e-17, fem))
            .summary
            .pinion
            .peak_wear_um
    };
    let (light, both) = (of(&[100.0]), of(&[100.0, 300.0]));
    assert!(both > 2.0 * light && light > 0.1, "{light} {both}");
}

/// While wear changes no pressure, depths add up: k Δn of each phase, whatever their order; volume in proportion to k n.
#[test]
fn ver_negligible_wear_adds_up_whatever_the_order() {
    let (one, other) = (
        "pinion_revolutions = 1e5\npinion_torque_Nm = 100.0\ncoefficient_m2_per_N = 1e-24",
        "pinion_revolutions = 3e5\npinion_torque_Nm = 400.0\ncoefficient_mm3_per_Nm = 2e-15",
    );
    let forwards = spectrum(&[one, other], WINKLER, NEGLIGIBLE, "");
    let backwards = spectrum(&[other, one], WINKLER, NEGLIGIBLE, "");
    let alone = |phase: &str| spectrum(&[phase], WINKLER, NEGLIGIBLE, "");
    let (first, second) = (alone(one), alone(other));
    let places = forwards.flanks.pinion.wear_um.iter().zip(&backwards.flanks.pinion.wear_um);
    let sums = first.flanks.pinion.wear_um.iter().zip(&second.flanks.pinion.wear_um).map(|(a, b)| a + b);
    let greatest = forwards.summary.pinion.peak_wear_um;
    assert!(greatest > 0.0);
    for ((forwards, backwards), sum) in places.zip(sums) {
        assert!((forwards - sum).abs() <= 1e-6 * greatest && (backwards - sum).abs() <= 1e-6 * greatest);
    }
    let added: f64 = forwards.summary.phases.iter().map(|phase| phase.pinion.worn_volume_mm3).sum();
    assert_close("volumes of the phases", added, forwards.summary.pinion.worn_volume_mm3, 1e-12);
    // The same load, k and duration twice those of another phase.
    let twice = spectrum(
        &["pinion_revolutions = 1e5", "pinion_revolutions = 2e5\ncoefficient_m2_per_N = 2e-24"],
        WINKLER,
        NEGLIGIBLE,
        "",
    );
    let [one, two] = &twice.summary.phases[..] else { panic!() };
    assert_close("2 k, 2 n", two.wheel.worn_volume_mm3 / one.wheel.worn_volume_mm3, 4.0, 1e-6);
    assert_close("2 k", two.coefficient_m2_per_N.unwrap() / one.coefficient_m2_per_N.unwrap(), 2.0, 1e-12);
}

/// Each phase runs under its own load with the K/H and the stiffness that belong to it; new and worn are both under the greatest load.
#[test]
fn val_each_phase_has_the_contact_of_its_own_load() {
    let at = |torque: &str| format!("pinion_revolutions = 1e5\npinion_torque_Nm = {torque}");
    let (light, heavy) = (at("100.0"), at("400.0"));
    let both = spectrum(&[&light, &heavy], WINKLER, NEGLIGIBLE, "");
    let backwards = spectrum(&[&heavy, &light], WINKLER, NEGLIGIBLE, "");
    assert_eq!([&both, &backwards].map(|record| record.summary.reference_phase), [2, 1]);
    let of_heavy = spectrum(&[&heavy], WINKLER, NEGLIGIBLE, "");
    for record in [&both, &backwards] {
        for (what, own) in [("new", &record.summary.new), ("worn", &record.summary.worn)] {
            let alone = &of_heavy.summary.new;
            assert_close(what, own.pitch_pressure_MPa, alone.pitch_pressure_MPa, 1e-6);
            assert_close(what, own.transmission_error_um.max, alone.transmission_error_um.max, 1e-6);
        }
        assert_eq!(record.summary.contact, of_heavy.summary.contact);
    }
    // What is worn lowers the pressure under the load that made it, whichever phase was the last: the load is the same.
    let worn = spectrum(&[&heavy, &light], WINKLER, 2e-17, "").summary;
    assert_close("new", worn.new.pitch_pressure_MPa, of_heavy.summary.new.pitch_pressure_MPa, 1e-6);
    let loads = [&worn.new, &worn.worn].map(|cycle| cycle.transmission_error_um.max);
    assert!((loads[1] / loads[0] - 1.0).abs() < 0.1, "{loads:?}");
    let [first, second] = &both.summary.phases[..] else { panic!() };
    // Hertz: p₀ ∝ √w, a ∝ √w; K/H of equal half-width ∝ 1/a (K. L. Johnson, Contact Mechanics, sections 4.2 and 4.3).
    assert_close("line load", second.line_load_N_per_mm / first.line_load_N_per_mm, 4.0, 1e-12);
    assert_close("p₀", second.hertz_peak_pressure_MPa / first.hertz_peak_pressure_MPa, 2.0, 1e-12);
    let foundation = |phase: usize| both.summary.phases[phase].foundation_MPa_per_mm.unwrap();
    assert_close("K/H", foundation(1) / foundation(0), 0.5, 1e-9);
    assert_eq!(both.summary.contact.line_load_N_per_mm, second.line_load_N_per_mm);
}

/// Where every phase has its own torque and speed, none is needed outside; one that has none is refused.
#[test]
fn phases_need_no_load_outside() {
    let of = |list: &[&str]| scene(&phases(list), WINKLER, NEGLIGIBLE, "");
    let own =
        |hours: f64, torque: f64| format!("hours = {hours:?}\npinion_torque_Nm = {torque:?}\npinion_speed_rpm = 150.0");
    let (light, heavy) = (own(10.0, 100.0), own(1.0, 400.0));
    let alone = run(&of(&[&light, &heavy]));
    let beside = run(&scene(&format!("{OPERATION}{}", phases(&[&light, &heavy])), WINKLER, NEGLIGIBLE, ""));
    assert_eq!((&alone.flanks, alone.summary.reference_phase), (&beside.flanks, 2));
    let problems = Resolved::from_toml(&of(&[&light, "hours = 1.0\npinion_speed_rpm = 150.0"])).unwrap_err();
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert!(
        said.len() == 1
            && said[0].contains("operation.pinion_torque_Nm")
            && said[0].contains("each of operation.phases"),
        "{said:?}"
    );
}

/// Hours count at the speed of their phase, snapshots in hours too; the phase at its end is that which ends.
#[test]
fn hours_over_phases_of_different_speed() {
    let operation = format!(
        "{OPERATION}hours = 15.0\nsnapshots_h = [5.0, 12.0]\n{}",
        phases(&["hours = 10.0\npinion_speed_rpm = 100.0", "hours = 5.0\npinion_speed_rpm = 200.0"])
    );
    let record = run(&scene(&operation, WINKLER, 1e-18, ""));
    let rows: Vec<_> = record.history.iter().map(|row| (row.hours.unwrap(), row.revolutions, row.phase)).collect();
    // 60 · 100 revolutions an hour, then 60 · 200.
    let expected = [(5.0, 30e3, 1), (10.0, 60e3, 1), (12.0, 84e3, 2), (15.0, 120e3, 2)];
    assert_eq!(rows.len(), expected.len());
    for ((hours, revolutions, phase), (h, n, number)) in rows.into_iter().zip(expected) {
        assert!((hours - h).abs() < 1e-9 && (revolutions - n).abs() < 1e-6 && phase == number, "{hours} {revolutions}");
    }
    let summary = &record.summary;
    assert_close("hours", summary.hours.unwrap(), 15.0, 1e-12);
    assert_eq!(summary.phases.iter().map(|phase| phase.hours.unwrap().round()).collect::<Vec<_>>(), [10.0, 5.0]);
}

/// The example of the documentation is a scene.
#[test]
fn the_documented_spectrum_is_a_scene() {
    let page = include_str!("../../docs/runs.md");
    let text = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let scene = Resolved::from_toml(text).unwrap().scene;
    assert_eq!(scene.operation.phases.len(), 4);
    // 100 hours at 1500 rpm, then 20 000 revolutions.
    assert!((scene.operation.pinion_revolutions - 9_020_000.0).abs() < 1e-3);
    assert_eq!(scene.operation.snapshots_revolutions.len(), 4 + 4 - 1);
}
