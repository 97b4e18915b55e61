//! Twist of what carries the teeth, and axes that are not parallel.

use gearwear::{LoadedScene, RunRecord, Unwatched};

use super::common::{assert_close, fzg_c, pair};

fn run(changes: &[(&str, toml::Value)]) -> RunRecord {
    let coarse = [
        ("operation.snapshots_h", toml::Value::Array(vec![0.1.into()])),
        ("operation.hours", 0.1.into()),
        ("numerics.flank_points", 120.into()),
        ("numerics.positions", 31.into()),
        ("numerics.error_estimate", false.into()),
        ("numerics.verify", false.into()),
        ("helical.slices", 12.into()),
    ];
    let scene = LoadedScene::preset("fzg-c").unwrap();
    let scene = coarse.iter().chain(changes).fold(scene, |scene, (key, value)| scene.with(key, value.clone()).unwrap());
    gearwear::run(&scene, &Unwatched).unwrap().complete().unwrap()
}

fn shaft(diameter_mm: f64, driven_at: &str) -> toml::Value {
    toml::Value::Table(toml::toml! { diameter_mm = diameter_mm driven_at = driven_at })
}

/// A shaft too thick to twist changes nothing, however the slices are coupled: all contacts in one matrix are the teeth one by one.
#[test]
fn ver_thick_shafts_change_nothing() {
    let slope = ("pair.pinion.helix_slope_deviation_um", toml::Value::from(10.0));
    for coupling in ["none", "slicing", "fem"] {
        let given = [slope.clone(), ("contact.tip_contact", false.into()), ("helical.coupling", coupling.into())];
        let without = run(&given);
        let with = run(&[&given[..], &[("pair.pinion.shaft", shaft(1400.0, "start"))]].concat());
        assert_close(
            coupling,
            with.summary.new.transmission_error_um.max,
            without.summary.new.transmission_error_um.max,
            1e-5,
        );
        let k_h_beta = |run: &RunRecord| run.summary.helical.as_ref().unwrap().K_Hbeta_new;
        assert_close(coupling, k_h_beta(&with), k_h_beta(&without), 1e-5);
    }
}

/// The driven end carries most, and either end may be driven: the pair is its own mirror image.
#[test]
fn ver_the_driven_end_carries_most() {
    let loads = |driven_at: &str| {
        let record = run(&[("pair.pinion.shaft", shaft(40.0, driven_at))]);
        record.slices.as_ref().unwrap().line_load_new_N_per_mm.chunks_exact(12).fold([0.0; 12], |mut sum, row| {
            sum.iter_mut().zip(row).for_each(|(sum, load)| *sum += load);
            sum
        })
    };
    let (start, end) = (loads("start"), loads("end"));
    assert!(start[1] > 1.02 * start[10], "{start:?}");
    for (i, load) in start.iter().enumerate() {
        assert_close("mirror image", *load, end[11 - i], 1e-3);
    }
}

/// Axes out of parallel are a helix slope of f_Σδ sin α_wt + f_Σβ cos α_wt over the face width (ISO/TR 10064-3).
#[test]
fn ver_axes_are_a_helix_slope() {
    let given = pair(&fzg_c());
    let (sin, cos) = given.working_pressure_angle_rad.sin_cos();
    let coupling = ("helical.coupling", toml::Value::from("none"));
    let axes = toml::Value::Table(toml::toml! { in_plane_um = 30.0 out_of_plane_um = 20.0 over_length_mm = 28.0 });
    let of_axes = run(&[coupling.clone(), ("pair.axis_parallelism", axes)]);
    let slope = ("pair.pinion.helix_slope_deviation_um", toml::Value::from(15.0 * sin + 10.0 * cos));
    let of_slope = run(&[coupling, slope]);
    let [a, b] = [&of_axes, &of_slope].map(|run| run.summary.new.transmission_error_um.max);
    assert_close("transmission error", a, b, 1e-9);
}
