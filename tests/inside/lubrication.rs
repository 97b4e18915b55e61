//! Films, friction and losses: what scenes may say, and what a run writes.

use gearwear::runs;
use gearwear::scene::{Problem, Resolved, presets};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

use super::common::{assert_close, loaded};

const OIL: &str = "[lubricant]\nviscosity_class = 220\ntemperature_C = 80.0\n";

/// The thesis-spur scene on `hertz` over one wear step, with both gears rough, and `more` behind it.
fn scene(more: &str) -> Result<Resolved, Vec<Problem>> {
    let mut text = presets::find("thesis-spur").unwrap().text.to_owned();
    for (old, new) in [
        ("surface = \"winkler\"", "surface = \"hertz\""),
        ("[pair.pinion]", "[pair.pinion]\nroughness_Ra_um = 0.5"),
        ("[pair.wheel]", "[pair.wheel]\nroughness_Ra_um = 0.3\nroughness_run_in_Ra_um = 0.2"),
        ("hours = 127.75 ", "hours = 1.0 "),
        ("snapshots_h", "# snapshots_h"),
        ("step = { revolutions = 7665.0 }", "step = { revolutions = 9000.0 }"),
        ("error_estimate = true", "error_estimate = false\nverify = false"),
    ] {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    Resolved::from_toml(&format!("{text}\n{more}"))
}

fn run(more: &str) -> RunRecord {
    let resolved = scene(more).unwrap();
    runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap()
}

/// A tip edge is hotter by Blok's formula with its own load and half-width, not with the nominal radius: with p = 2w/(π a)
/// θ = √π/2 μ p |v₁ − v₂|/(B₁√v₁ + B₂√v₂) √(4 a), a at most that on the nominal radius.
#[test]
fn ver_flash_of_a_tip_edge_is_with_its_own_radius() {
    let mut text = presets::find("thesis-spur").unwrap().text.to_owned();
    for (old, new) in [
        ("surface = \"winkler\"", "surface = \"half-space\""),
        ("match = \"half-width\"", "# match"),
        ("tip_contact = false", "tip_contact = true"),
        ("[pair.pinion]", "[pair.pinion]\nroughness_Ra_um = 0.5\ntip_rounding_mm = 0.1"),
        ("[pair.wheel]", "[pair.wheel]\nroughness_Ra_um = 0.3\ntip_rounding_mm = 0.1"),
        ("hours = 127.75 ", "pinion_revolutions = 1.0 "),
        ("snapshots_h", "# snapshots_h"),
        ("step = { revolutions = 7665.0 }", "step = { revolutions = 1.0 }"),
        ("error_estimate = true", "error_estimate = false\nverify = false"),
    ] {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    let resolved =
        Resolved::from_toml(&format!("{text}\n{OIL}[friction]\nmodel = \"constant\"\ncoefficient = 0.05\n")).unwrap();
    let record = runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap();
    let film = record.summary.lubrication.as_ref().unwrap().film.as_ref().unwrap();
    let b = 46.0 / 1.2e-5f64.sqrt();
    let e_r = 206_000.0 / (1.0 - 0.09);
    let speed = std::f64::consts::TAU * 150.0 / 60.0;
    let tangents = 2.0 * record.summary.geometry.curvature_radius_mm.C * 1.25;
    let mut greatest = 0.0_f64;
    let mut edges = 0;
    for (row, at) in record.film.iter().zip(&record.mesh_cycle) {
        let (Some(flash), w, p) = (row.flash_new_K, row.line_load_new_N_per_mm, at.peak_pressure_new_MPa) else {
            continue;
        };
        let nominal = (e_r * w / (std::f64::consts::TAU * row.relative_radius_mm)).sqrt();
        let narrower = (at.half_width_mm / (2.0 * w / (std::f64::consts::PI * nominal))).max(nominal / p);
        let (rho, film_mpa) = match narrower < 1.0 {
            true => (row.relative_radius_mm * narrower * narrower, nominal / narrower),
            false => (row.relative_radius_mm, p),
        };
        let x = row
            .position_mm
            .clamp(record.summary.geometry.curvature_radius_mm.A, record.summary.geometry.curvature_radius_mm.E);
        let (v1, v2) = (1e-3 * speed * x, 1e-3 * speed / 1.5 * (tangents - x));
        let expected = std::f64::consts::PI.sqrt() / 2.0 * 0.05 * film_mpa * 1e6 * (v1 - v2).abs()
            / (b * (v1.sqrt() + v2.sqrt()))
            * (8.0 * rho * film_mpa / (1e3 * e_r)).sqrt();
        if p > 1.3 * nominal {
            edges += 1;
        }
        greatest = greatest.max(expected);
        assert!((flash - expected).abs() < 1e-6 * expected.max(1.0), "{} mm: {flash} {expected}", row.position_mm);
    }
    assert!(edges > 3, "the scene has tip edges under load");
    assert_close("greatest flash", film.greatest_flash_new_K, greatest, 1e-6);
    // λ of the headline is between the tip-edge zones, that of the edges apart.
    assert!(film.lambda_new.min > 0.0 && film.tip_edge_lambda_new.unwrap() < film.lambda_new.min);
}

/// ε_α of 2 and more: H_V in its general form, the standards' load sharing factor and what hangs on it null with the reason.
#[test]
fn what_the_standards_do_not_cover_is_null_with_its_reason() {
    let high = "[pair]\nnormal_module_mm = 2.0\npressure_angle_deg = 20.0\ncentre_distance_mm = 100.0\nface_width_mm = 20.0\n\
        basic_rack = { addendum_factor = 1.35, dedendum_factor = 1.55, fillet_radius_factor = 0.2 }\n\
        [pair.pinion]\nteeth = 50\nprofile_shift = 0.0\nroughness_Ra_um = 0.5\n[pair.wheel]\nteeth = 50\nprofile_shift = 0.0\nroughness_Ra_um = 0.5\n\
        [operation]\npinion_torque_Nm = 100.0\npinion_speed_rpm = 1000.0\npinion_revolutions = 1.0\n[contact]\nsurface = \"hertz-mean\"\n\
        [stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
        [numerics]\nstep = { revolutions = 1.0 }\nerror_estimate = false\nverify = false\n";
    let resolved = Resolved::from_toml(&format!("{high}{OIL}")).unwrap_or_else(|problems| panic!("{problems:?}"));
    let record = runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap();
    let ratio = record.summary.geometry.transverse_contact_ratio;
    assert!((2.0..3.0).contains(&ratio), "{ratio}");
    let of = record.summary.lubrication.unwrap();
    assert!(of.method_b.is_none() && of.method_b_null_because.unwrap().contains("below 2"));
    let scuffing = of.scuffing.unwrap();
    assert!(scuffing.contact_temperature_C.is_none() && scuffing.flash_null_because.is_some());
    assert!(scuffing.integral_temperature_C.is_some());
    // Even shares of a symmetric pair, e = ε/2 between 1 and 1.5: three pairs where another one is in mesh on both sides.
    let e = 0.5 * ratio;
    let (inner, edge) = (e - 1.0, 2.0 - e);
    let three = inner * inner / 2.0 / 3.0 + (e * e - edge * edge) / 2.0 / 3.0;
    let two = (edge * edge - inner * inner) / 2.0 / 2.0;
    assert_close(
        "H_V",
        of.losses.loss_factor_ohlendorf,
        std::f64::consts::TAU * (2.0 / 50.0) * 2.0 * (three + two),
        1e-9,
    );
}

#[test]
fn a_run_without_oil_or_friction_writes_nothing_of_them() {
    let record = run("");
    assert!(record.summary.lubrication.is_none() && record.film.is_empty());
    let left_out: Vec<&str> = record.summary.left_out.iter().map(|stage| stage.name.as_str()).collect();
    assert!(left_out.contains(&"film") && left_out.contains(&"losses"), "{left_out:?}");
}

#[test]
fn constant_friction_needs_no_oil_and_loses_by_the_loss_factor() {
    let record = run("[friction]\nmodel = \"constant\"\ncoefficient = 0.05\n");
    let of = record.summary.lubrication.unwrap();
    assert!(of.oil.is_none() && of.film.is_none() && of.method_b.is_none());
    assert_close("μ", of.friction.mean_new, 0.05, 1e-12);
    let expected = 0.05 * of.losses.loss_factor_local_new * of.losses.power_W;
    assert_close("loss", of.losses.mesh_power_loss_new_W, expected, 1e-12);
    // Half the load each where two pairs share it is near what elastic teeth do.
    assert_close("H_VL", of.losses.loss_factor_local_new, of.losses.loss_factor_ohlendorf, 0.05);
    assert!(record.film.iter().all(|row| row.lambda_new.is_none()));
}

#[test]
fn worn_flanks_have_a_film_of_their_own_over_their_own_roughness() {
    let record = run(&format!("{OIL}[friction]\nmodel = \"xu\"\n"));
    assert_eq!(record.film.len(), record.mesh_cycle.len());
    let of = record.summary.lubrication.unwrap();
    let film = of.film.unwrap();
    assert!(film.lambda_new.min > 0.0 && film.lambda_worn.min > 0.0);
    for row in record.film.iter().filter(|row| row.lambda_new.is_some()) {
        assert_close("λ new", row.lambda_new.unwrap(), row.local_film_new_um.unwrap() / 0.4, 1e-12);
        assert_close("λ worn", row.lambda_worn.unwrap(), row.local_film_worn_um.unwrap() / 0.35, 1e-12);
    }
    let frictions: Vec<f64> = record.film.iter().filter_map(|row| row.friction_new).collect();
    assert!(frictions.iter().all(|mu| (0.0..0.2).contains(mu)));
    assert_eq!([film.micropitting_safety_new, film.micropitting_safety_worn], [None, None]);
}

/// S_λ = λ_GF,min/λ_GFP (ISO/TS 6336-22), by both methods.
#[test]
fn ver_safety_against_micropitting() {
    let of = run(&format!("{OIL}permissible_lambda = 0.32\n")).summary.lubrication.unwrap();
    let (film, method_b) = (of.film.unwrap(), of.method_b.unwrap());
    for (safety, least) in [
        (film.micropitting_safety_new, film.lambda_new.min),
        (film.micropitting_safety_worn, film.lambda_worn.min),
        (method_b.micropitting_safety, method_b.least_lambda),
    ] {
        assert_close("S_λ", safety.unwrap(), least / 0.32, 1e-15);
    }
}

/// The scene that a run leaves behind says the same.
#[test]
fn a_resolved_scene_resolves_to_itself() {
    let resolved = scene(&format!("{OIL}[friction]\nmodel = \"schlenk\"\n")).unwrap();
    let again = Resolved::from_toml(&resolved.to_toml()).unwrap();
    assert_eq!(again.scene, resolved.scene);
    assert!(resolved.warnings.iter().any(|warning| warning.contains("viscosity index 95")), "{:?}", resolved.warnings);
}

#[test]
fn bad_input_is_told_with_key_and_what_is_allowed() {
    let two = "viscosity_40C_mm2_per_s = 50.0\nviscosity_100C_mm2_per_s = 80.0\ntemperature_C = 80.0\n";
    for (more, key, found) in [
        ("[lubricant]\ntemperature_C = 80.0\n".to_owned(), "lubricant.viscosity_class", "nothing"),
        ("[lubricant]\nviscosity_class = 220\n".to_owned(), "lubricant.temperature_C", "nothing"),
        ("[lubricant]\nviscosity_class = 221\ntemperature_C = 80.0\n".to_owned(), "lubricant.viscosity_class", "221"),
        (format!("[lubricant]\n{two}"), "lubricant.viscosity_100C_mm2_per_s", "80, with 50 at 40 °C"),
        (format!("{OIL}viscosity_40C_mm2_per_s = 220.0\n"), "lubricant.viscosity_40C_mm2_per_s", "and"),
        ("[friction]\nmodel = \"xu\"\n".to_owned(), "lubricant.temperature_C", "nothing"),
        ("[friction]\nmodel = \"constant\"\n".to_owned(), "friction.coefficient", "nothing"),
        ("[friction]\nmodel = \"coulomb\"\n".to_owned(), "friction.model", "coulomb"),
        (format!("{OIL}[load_factors]\napplication = 0.0\n"), "load_factors.application", "0"),
        (format!("{OIL}permissible_lambda = 0.0\n"), "lubricant.permissible_lambda", "0"),
    ] {
        let problems = scene(&more).unwrap_err();
        assert!(problems.iter().any(|p| p.key == key && p.found.contains(found)), "{more}: {problems:?}");
    }
}

/// A part of the wear law that does nothing is named with its figure; one that does something is not.
#[test]
fn a_law_that_changes_nothing_says_so() {
    let law = |film: &str, severe: &str| format!("{OIL}[wear.film]\n{film}\n[wear.severe]\n{severe}\n");
    let said = |more: &str, words: &str| run(more).summary.warnings.iter().any(|warning| warning.contains(words));
    let idle = law("lambda = [20.0, 30.0]\nfactor = [1.0, 0.0]", "above_MPa = 9000.0\nfactor = 10.0");
    let record = run(&idle);
    let warnings = &record.summary.warnings;
    let [film, severe] = ["wear.film changed nothing", "wear.severe changed nothing"]
        .map(|words| warnings.iter().filter(|warning| warning.starts_with(words)).collect::<Vec<_>>());
    assert_eq!([film.len(), severe.len()], [1, 1], "once for both gears: {warnings:?}");
    let greatest = record.summary.new.peak_pressure_MPa.max(record.summary.worn.peak_pressure_MPa);
    assert!(severe[0].contains(&format!("{greatest:.0} MPa at most")), "{severe:?}, {greatest}");
    // λ is told as the law reads it.
    let composite = run(&law(
        "ratio = \"composite\"\nlambda = [20.0, 30.0]\nfactor = [1.0, 0.0]",
        "above_MPa = 500.0\nfactor = 10.0",
    ));
    let film = composite.summary.lubrication.as_ref().and_then(|of| of.film.clone()).unwrap();
    let told = format!("λ is {:.2} at most on new flanks", film.composite_lambda_new.unwrap().max);
    assert!(told != format!("λ is {:.2} at most on new flanks", film.lambda_new.max));
    assert!(
        composite.summary.warnings.iter().any(|warning| warning.contains(&told)),
        "{told}: {:?}",
        composite.summary.warnings
    );
    let active = law("lambda = [0.001, 0.5]\nfactor = [1.0, 0.0]", "above_MPa = 500.0\nfactor = 10.0");
    assert!(!said(&active, "changed nothing"));
}
