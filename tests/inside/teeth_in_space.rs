//! Runs with slices that are coupled by teeth in space, against an independent calculation.
//!
//! The independent one: Hex20 sectors condensed to the flank, the whole ring by block-circulant coupling, line contact in Galerkin form,
//! complementarity over all lines; its own uncertainty is 0.5 % in transmission error and 1 % in load away from the end faces.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use gearwear::{LoadedScene, RunRecord, Unwatched};
use gearwear_bodies::gear::{GearPair, PerGear};
use gearwear_physics::assessment::RunError;
use gearwear_physics::assessment::calibrate::{self, CalibrationExtent};

use super::common::assert_close;

/// The plane that the physics' `ver_plane_strain_from_three_dimensions` holds space to: 26.606 µm at the pitch point under 446.4 N/mm by the independent calculation,
/// whose own uncertainty is 0.5 %.
#[test]
fn val_transmission_error_in_plane_strain() {
    let wide = [
        ("pair.face_width_mm", toml::Value::from(20.0)),
        ("pair.pinion.tip_rounding_mm", 0.0.into()),
        ("pair.wheel.tip_rounding_mm", 0.0.into()),
    ];
    let scene = changed(LoadedScene::preset("fzg-c").unwrap(), &wide);
    let pitch_point_mm = GearPair::new(&scene.scene().pair).unwrap().path.pitch_point_mm;
    let found = gearwear::fem_pair(&scene, Some(pitch_point_mm), &Unwatched).unwrap().complete().unwrap();
    let at_c = &found.mesh_cycle[0];
    assert_close("line load", at_c.line_load_N_per_mm, 446.4, 1e-3);
    assert_close("transmission error", at_c.transmission_error_um, 26.606, 0.005);
}

/// The preset `helical` with new flanks, coupled in space, changed by `changes`; bodies are held 2.5 normal modules below the root circles.
fn new_flanks(helix_deg: f64, changes: &[(&str, toml::Value)]) -> RunRecord {
    let mut scene = LoadedScene::preset("helical").unwrap().with("pair.helix_angle_deg", helix_deg).unwrap();
    let depth_mm = 2.5 * scene.scene().pair.normal_module_mm;
    let clamp_mm = PerGear::from_fn(|gear| scene.scene().pair.root_radius_mm(gear) - depth_mm);
    let first = toml::toml! {
        step = { revolutions = 10.0 }
    };
    for (key, value) in [
        ("fem.clamp_radius_mm.pinion", clamp_mm.pinion.into()),
        ("fem.clamp_radius_mm.wheel", clamp_mm.wheel.into()),
        ("operation.snapshots_revolutions", toml::Value::Array(vec![10.0.into()])),
        ("operation.pinion_revolutions", 10.0.into()),
        ("numerics.step", first["step"].clone()),
        ("numerics.error_estimate", false.into()),
        ("numerics.verify", false.into()),
        ("numerics.flank_points", 250.into()),
        ("numerics.positions", 120.into()),
    ] {
        scene = scene.with(key, value).unwrap();
    }
    for (key, value) in changes {
        scene = scene.with(key, value.clone()).unwrap();
    }
    gearwear::run(&scene, &Unwatched).unwrap().complete().unwrap()
}

/// The same as it is, at 15° and at 30°.
static AT_15_DEG: LazyLock<RunRecord> = LazyLock::new(|| new_flanks(15.0, &[]));
static AT_30_DEG: LazyLock<RunRecord> = LazyLock::new(|| new_flanks(30.0, &[]));

/// 15°, 20 mm: 20.2 to 31.1 µm in contact from A to E, 20.2 to 30.8 µm with tip edges, K_Hβ 1.03.
#[test]
fn val_transmission_error_of_a_helical_pair() {
    let between_a_and_e = new_flanks(15.0, &[("contact.surface", toml::Value::from("hertz"))]);
    for (surface, run, greatest_um) in [("hertz", &between_a_and_e, 31.1), ("half-space", &AT_15_DEG, 30.8)] {
        let (new, helical) = (&run.summary.new, run.summary.helical.as_ref().unwrap());
        assert_close(surface, new.transmission_error_um.min, 20.2, 0.01);
        assert_close(surface, new.transmission_error_um.max, greatest_um, 0.01);
        assert_close(surface, helical.K_Hbeta_new, 1.03, 0.015);
    }
}

/// With tip edges followed, slices come into contact one by one, each without load: the transmission error has kinks and no steps, so that its
/// second differences fall with the distance of positions, and more slices do not make them greater.
#[test]
fn ver_transmission_error_with_tip_edges_has_no_steps() {
    let greatest = |slices: i64, positions: i64| {
        let run = new_flanks(15.0, &[("helical.slices", slices.into()), ("numerics.positions", positions.into())]);
        let error: Vec<f64> = run.mesh_cycle.iter().map(|row| row.transmission_error_new_um).collect();
        let second = error.windows(3).map(|of| (of[0] - 2.0 * of[1] + of[2]).abs()).fold(0.0, f64::max);
        second / run.summary.new.transmission_error_um.peak_to_peak
    };
    let [coarse, fine, more_slices] = [greatest(8, 200), greatest(8, 400), greatest(16, 400)];
    println!("{coarse} {fine} {more_slices}");
    assert!(fine <= 0.7 * coarse && more_slices <= fine, "{coarse} {fine} {more_slices}");
}

/// Least and greatest load of an end slice, over the mean of the tooth's, while its middle is between B and D.
fn end_loads(run: &RunRecord) -> [f64; 2] {
    let (slices, path) = (run.slices.as_ref().unwrap(), &run.summary.geometry.curvature_radius_mm);
    let count = slices.width_mm.len();
    let of_tooth = slices.position_mm.iter().zip(slices.line_load_new_N_per_mm.chunks_exact(count));
    let alone = of_tooth.filter(|(position, _)| (path.B..=path.D).contains(*position));
    let ends = alone.flat_map(|(_, load)| {
        let loaded = load.iter().filter(|load| **load > 0.0).count();
        let mean = load.iter().sum::<f64>() / loaded as f64;
        [load[0] / mean, load[count - 1] / mean]
    });
    ends.filter(|load| *load > 0.0).fold([f64::INFINITY, 0.0], |[least, most], load| [least.min(load), most.max(load)])
}

/// End faces are free: at them an aligned spur pair of 14 mm carries 0.90 of the mean, one of 15° 0.75, and the acute corner of 30°
/// half of it. At which position the independent calculation says that is not known, and a slice is not the end face itself.
#[test]
fn val_loads_at_end_faces() {
    // What makes slices of a spur pair, and no more.
    let aligned =
        [("pair.face_width_mm", toml::Value::from(14.0)), ("pair.pinion.helix_slope_deviation_um", 1e-9.into())];
    let [least, most] = end_loads(&new_flanks(0.0, &aligned));
    assert!(least > 0.90 && most < 0.95, "{least} {most}");
    for (run, load) in [(&AT_15_DEG, 0.75), (&AT_30_DEG, 0.5)] {
        let [least, most] = end_loads(run);
        assert!(least <= load && load <= most, "{load}, {least} to {most}");
    }
}

/// Spur gears of 14 mm with a helix slope deviation of 20 µm: K_Hβ 1.52; 30° at 20 mm: 1.08 to 1.09. The greatest load over the width is that of a
/// piece of it: the independent calculation has 14.
#[test]
fn val_face_load_factor() {
    let misaligned = new_flanks(
        0.0,
        &[
            ("helical.slices", 14.into()),
            ("pair.face_width_mm", 14.0.into()),
            ("pair.pinion.helix_slope_deviation_um", 20.0.into()),
        ],
    );
    for (what, run, factor) in [("14 mm, 0°", &misaligned, 1.52), ("20 mm, 30°", &AT_30_DEG, 1.085)] {
        assert_close(what, run.summary.helical.as_ref().unwrap().K_Hbeta_new, factor, 0.01);
    }
}

/// `scene`, changed by `changes`.
fn changed(mut scene: LoadedScene, changes: &[(&str, toml::Value)]) -> LoadedScene {
    for (key, value) in changes {
        scene = scene.with(key, value.clone()).unwrap();
    }
    scene
}

/// A coarse scene of the preset `helical`, changed by `changes`. Its points do not resolve a rounded tip edge: it is sharp.
fn coarse(changes: &[(&str, toml::Value)]) -> LoadedScene {
    let coarse = [
        ("pair.pinion.tip_rounding_mm", toml::Value::from(0.0)),
        ("pair.wheel.tip_rounding_mm", 0.0.into()),
        ("operation.snapshots_revolutions", toml::Value::Array(vec![10.0.into()])),
        ("numerics.flank_points", 120.into()),
        ("numerics.positions", 45.into()),
        ("numerics.error_estimate", false.into()),
    ];
    changed(changed(LoadedScene::preset("helical").unwrap(), &coarse), changes)
}

fn completed(scene: &LoadedScene) -> RunRecord {
    gearwear::run(scene, &Unwatched).unwrap().complete().unwrap()
}

/// What a run says of its error is 0.9 to 2.5 times its difference to 32 slices in space, where that is above 2 %: the default run on few slices,
/// and thin ones with Hertz's pressure between A and E.
#[test]
fn val_slices_know_their_error() {
    // A third of the preset's wear. Points as coarse as those of the other tests are half of the claim, and the same in what it is held against.
    let scene = coarse(&[
        ("operation.pinion_revolutions", 2e5.into()),
        ("numerics.flank_points", 180.into()),
        ("numerics.positions", 100.into()),
    ]);
    let run_of = |changes: &[(&str, toml::Value)]| completed(&changed(scene.clone(), changes));
    let truth = run_of(&[("helical.slices", 32.into()), ("numerics.verify", false.into())]);
    let cheap: &[(&str, toml::Value)] = &[
        ("contact.surface", "hertz".into()),
        ("helical.coupling", "none".into()),
        ("stiffness.model", "weber-banaschek".into()),
        ("helical.slices", 18.into()),
    ];
    for (changes, least) in [(&[("helical.slices", toml::Value::from(12))][..], 0.0), (cheap, 0.05)] {
        let run = run_of(changes);
        let total = &run.summary.error.total;
        let peaks = |run: &RunRecord| [run.summary.pinion.peak_wear_um, run.summary.wheel.peak_wear_um];
        for ((own, there), claim) in
            peaks(&run).into_iter().zip(peaks(&truth)).zip([total.peak_wear.pinion, total.peak_wear.wheel])
        {
            let (off, claim) = ((own / there - 1.0).abs(), claim.expect(&total.how));
            assert!(off >= least, "{changes:?}: {off}");
            assert!(claim >= 0.9 * off && claim <= 2.5 * off.max(0.02), "{changes:?}: {off} {claim}");
        }
        let [own, there] = [&run, &truth].map(|run| run.summary.worn.transmission_error_um.peak_to_peak);
        let claim = total.transmission_error_peak_to_peak.unwrap();
        assert!(claim >= 0.9 * (own / there - 1.0).abs(), "{changes:?}: {own} {there} {claim}");
        assert!(total.profile.pinion.is_some() && total.pressure_between_tips.is_some(), "{total:?}");
    }
}

/// `scene` with slices as plates that its calibration tells, and in space.
fn as_plates_and_in_space(scene: &LoadedScene) -> [RunRecord; 2] {
    let calibrated = calibrate::run(scene.scene(), CalibrationExtent::FastModel, &scene.teeth_in_space, &Unwatched)
        .unwrap()
        .calibration;
    let fit = calibrated.slices.expect("a pair with slices");
    let ends = fit.compliance.ends.into_iter().chain(fit.compliance.end_twist.unwrap());
    assert!(fit.residual < 0.1 && fit.compliance.teeth > 1.1 && ends.into_iter().all(|end| end > 0.0), "{fit:?}");
    let plates = scene.with_calibration(calibrated).unwrap().with("helical.coupling", "slicing").unwrap();
    assert!(plates.warnings().iter().all(|warning| !warning.contains("has no slices")), "{:?}", plates.warnings());
    [completed(&plates.with("contact.surface", "half-space").unwrap()), completed(scene)]
}

/// Slices as plates with the calibration of their pair against those in space, new flanks: mean transmission error within 1 %, its range within
/// 5 %, loads within 0.06 of their mean (root mean square); worn ones, root wear of every slice within 8 %, but for
/// those at the end faces: 12 % of the least worn one at 30°, 1.6 % of the maximum; 8 % held before slices acted on halves of layers.
#[test]
fn val_calibrated_slices() {
    assert_calibrated_slices(30.0, 20.0, 302.0);
}

/// The same at the preset's angle, and new flanks of narrow teeth at a large one.
#[test]
fn val_calibrated_slices_at_other_angles() {
    assert_calibrated_slices(15.0, 20.0, 302.0);
    assert_calibrated_slices(35.0, 12.0, 181.2);
}

fn assert_calibrated_slices(helix_deg: f64, width_mm: f64, torque_nm: f64) {
    let mut changes = vec![
        ("operation.pinion_torque_Nm", toml::Value::from(torque_nm)),
        ("pair.face_width_mm", width_mm.into()),
        ("pair.helix_angle_deg", helix_deg.into()),
        ("numerics.verify", false.into()),
        ("fem.elements_per_half_width", 3.0.into()),
    ];
    let wears = helix_deg < 35.0;
    // A third of the preset's wear.
    changes.push(("operation.pinion_revolutions", if wears { 2e5.into() } else { 10.0.into() }));
    if helix_deg > 15.0 {
        // At so few positions range and wear would hang on when a sharp edge enters.
        changes.extend([("pair.pinion.tip_rounding_mm", 0.1.into()), ("pair.wheel.tip_rounding_mm", 0.1.into())]);
    }
    if helix_deg == 30.0 {
        changes.extend([("numerics.positions", 120.into()), ("numerics.flank_points", 250.into())]);
    }
    let [plates, space] = as_plates_and_in_space(&coarse(&changes));
    let errors = |run: &RunRecord| {
        let error = &run.summary.new.transmission_error_um;
        [0.5 * (error.min + error.max), error.peak_to_peak]
    };
    for ((own, there), allowed) in errors(&plates).into_iter().zip(errors(&space)).zip([0.01, 0.05]) {
        assert_close(&format!("transmission error at {helix_deg}°"), own, there, allowed);
    }
    // Where a tooth touches first and last differs between the two, and with it the positions; what one lacks is without load there.
    let loads = |run: &RunRecord| -> BTreeMap<(i64, usize), f64> {
        let of = run.slices.as_ref().unwrap();
        let slices = of.width_mm.len();
        let place = |i: usize| ((1e6 * of.position_mm[i / slices]).round() as i64, i % slices);
        of.line_load_new_N_per_mm.iter().enumerate().map(|(i, load)| (place(i), *load)).collect()
    };
    let (own, there) = (loads(&plates), loads(&space));
    let count = there.values().filter(|load| **load > 0.0).count() as f64;
    let mean = there.values().sum::<f64>() / count;
    let places: BTreeSet<_> = own.keys().chain(there.keys()).collect();
    let at = |loads: &BTreeMap<_, f64>, place| loads.get(place).copied().unwrap_or(0.0);
    let square: f64 = places.into_iter().map(|place| (at(&own, place) - at(&there, place)).powi(2)).sum();
    let off = (square / count).sqrt() / mean;
    println!("{helix_deg}°: loads {off:.4}");
    assert!(off < 0.06, "{helix_deg}°: {off}");
    // Elements end with slices; of two slices in an element each carries 1 % more or less for where in it it lies, at the greatest angle.
    let (mut over_width, sum) = ([0.0; 20], there.values().sum::<f64>());
    there.iter().for_each(|((_, slice), load)| over_width[*slice] += load * 20.0 / sum);
    let uneven = over_width.windows(3).map(|of| (of[1] - 0.5 * (of[0] + of[2])).abs());
    let uneven = uneven.skip(2).take(14).fold(0.0, f64::max);
    assert!(uneven < if wears { 0.02 } else { 0.025 }, "{helix_deg}°: {uneven} {over_width:?}");
    if wears {
        let root = |run: &RunRecord| {
            let wear = &run.summary.helical.as_ref().unwrap().wear;
            [wear.pinion.root_wear_um.clone(), wear.wheel.root_wear_um.clone()].concat()
        };
        for (k, (own, there)) in root(&plates).into_iter().zip(root(&space)).enumerate() {
            let at_end_face = [0, 19].contains(&(k % 20));
            assert_close("root wear of a slice", own, there, if at_end_face { 0.13 } else { 0.08 });
        }
    }
}

/// Where teeth cannot be had in space, a scene that does not ask for them by name runs on plates, and is told.
#[test]
fn plates_stand_in_for_teeth_in_space() {
    let wide = [
        ("pair.face_width_mm", 900.0.into()),
        ("operation.pinion_torque_Nm", 13_590.0.into()),
        ("operation.pinion_revolutions", 10.0.into()),
    ];
    let run = completed(&coarse(&wide));
    assert_eq!(run.summary.helical.as_ref().unwrap().coupling, "slicing");
    assert!(run.summary.warnings.iter().any(|warning| warning.starts_with("helical.coupling: \"slicing\"")));
    assert!(run.summary.error.total.how.contains("teeth may touch together"), "{}", run.summary.error.total.how);
    let asked = coarse(&wide).with("helical.coupling", "fem").unwrap();
    assert!(matches!(gearwear::run(&asked, &Unwatched), Err(RunError::TeethInSpace(_))));
}

/// Heavily loaded plastics, whose tip edges carry where the corrected compliance of the teeth in space is negative: the run says so, and what does without them.
#[test]
fn a_negative_compliance_is_said_with_what_helps() {
    let scene = r#"
[pair]
backlash_um = 42.11
face_width_mm = 5.225
helix_angle_deg = 22.95
normal_module_mm = 1.035
pressure_angle_deg = 20.0
[pair.pinion]
teeth = 16
profile_shift = 0.0
[pair.wheel]
teeth = 39
profile_shift = -0.07181
[material.pinion]
preset = "PA46"
young_modulus_GPa = 5.534
[material.wheel]
preset = "POM"
young_modulus_GPa = 1.154
[operation]
pinion_torque_Nm = 0.5304
pinion_speed_rpm = 116.2
pinion_revolutions = 1000.0
[wear]
law = "archard"
coefficient_m2_per_N = 3.6e-16
[numerics]
verify = false
error_estimate = false
positions = 60
flank_points = 200
"#;
    let ends = |scene: &str| {
        gearwear::run(&LoadedScene::from_toml(scene).unwrap(), &Unwatched).map(|done| done.complete().is_ok())
    };
    let said = ends(scene).unwrap_err().to_string();
    assert!(said.contains("compliance of the teeth in space is negative"), "{said}");
    assert!(said.contains("helical.coupling = \"slicing\""), "{said}");
    let sliced = scene.replace("[numerics]", "[helical]\ncoupling = \"slicing\"\n[numerics]");
    assert!(ends(&sliced).unwrap());
}
