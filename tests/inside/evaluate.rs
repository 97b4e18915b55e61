//! `evaluate`: rows as runs of their own, failed rows, bad questions.

use gearwear::{EvaluateError, LoadedScene, Unwatched, evaluate};
use toml::Value;

fn coarse_scene() -> LoadedScene {
    let scene = LoadedScene::preset("thesis-spur").unwrap();
    let values: [(&str, Value); 6] = [
        ("contact.surface", "hertz-mean".into()),
        ("numerics.flank_points", 60.into()),
        ("numerics.positions", 40.into()),
        ("numerics.error_estimate", false.into()),
        ("numerics.verify", false.into()),
        ("numerics.step.revolutions", 200_000.0.into()),
    ];
    let scene = values.into_iter().fold(scene, |scene, (key, value)| scene.with(key, value).unwrap());
    // As a row has it: the end alone.
    scene.with("operation.snapshots_h", vec![127.75]).unwrap()
}

/// A row has the bits of the run of the scene with its values, whatever the number of threads.
#[test]
fn rows_are_runs() {
    let scene = coarse_scene();
    let keys = [
        "operation.pinion_torque_Nm",
        "pair.{pinion,wheel}.tip_relief.amount_um",
        "contact.surface",
        "pair.wheel.teeth",
    ];
    let relief = || -> toml::Table { "amount_um = 1.0\nlength_mm = 2.0".parse().unwrap() };
    let relieved = scene.with("pair.pinion.tip_relief", relief()).unwrap();
    let relieved = relieved.with("pair.wheel.tip_relief", relief()).unwrap();
    let rows: Vec<Vec<Value>> =
        [(200.0, 5.0, "hertz-mean", 24.0), (300.0, 10.0, "hertz", 24.0), (250.0, 0.0, "hertz-mean", 24.0)]
            .map(|(torque, relief, surface, teeth)| vec![torque.into(), relief.into(), surface.into(), teeth.into()])
            .to_vec();
    let outputs = [
        "pinion.peak_wear_um",
        "worn.transmission_error_um.peak_to_peak",
        "geometry.gears.wheel.teeth",
        "phases.1.revolutions",
    ];
    let found = evaluate(&relieved, &keys, &rows, &outputs, 1, &Unwatched).unwrap();
    let again = evaluate(&relieved, &keys, &rows, &outputs, 2, &Unwatched).unwrap();
    assert_eq!(found, again);
    assert!(found.reasons.iter().all(Option::is_none), "{:?}", found.reasons);
    for (row, values) in rows.iter().zip(&found.values) {
        let amount = row[1].clone();
        let one = relieved.with(keys[0], row[0].clone()).unwrap().with(keys[2], row[2].clone()).unwrap();
        let one = one.with("pair.pinion.tip_relief.amount_um", amount.clone()).unwrap();
        let one = one.with("pair.wheel.tip_relief.amount_um", amount).unwrap();
        let summary = gearwear::run(&one, &Unwatched).unwrap().complete().unwrap().summary;
        let expected =
            [summary.pinion.peak_wear_um, summary.worn.transmission_error_um.peak_to_peak, 24.0, summary.revolutions];
        assert_eq!(values, &expected);
    }
}

#[test]
fn failed_rows_are_no_error_of_the_others() {
    let rows = [vec![Value::from(200.0)], vec![Value::from(-1.0)], vec![Value::from("much")]];
    let keys = ["operation.pinion_torque_Nm"];
    let outputs = ["pinion.peak_wear_um", "helical.K_Hbeta_new", "error.total.peak_wear.pinion"];
    let found = evaluate(&coarse_scene(), &keys, &rows, &outputs, 2, &Unwatched).unwrap();
    assert!(found.values[0][0] > 0.0 && found.values[0][1].is_nan() && found.values[0][2].is_nan());
    assert!(found.reasons[0].as_ref().unwrap().contains("helical.K_Hbeta_new"));
    for row in [1, 2] {
        assert!(found.values[row].iter().all(|value| value.is_nan()));
        assert!(found.reasons[row].as_ref().unwrap().contains("pinion_torque_Nm"), "{:?}", found.reasons[row]);
    }
}

#[test]
fn bad_questions_are_refused_by_name() {
    let scene = coarse_scene();
    let ask = |keys: &[&str], row: Vec<Value>, outputs: &[&str]| {
        evaluate(&scene, keys, &[row], outputs, 1, &Unwatched).unwrap_err()
    };
    let (key, output) = ("operation.pinion_torque_Nm", "pinion.peak_wear_um");
    let error = ask(&["operation.pinion_torque"], vec![1.0.into()], &[output]);
    assert!(error.to_string().contains("did you mean operation.pinion_torque_Nm?"), "{error}");
    let error = ask(&[key], vec![1.0.into()], &["pinion.peak_ware_um"]);
    assert!(error.to_string().contains("did you mean pinion.peak_wear_um?"), "{error}");
    assert!(matches!(ask(&[key], vec![], &[output]), EvaluateError::RowLength { row: 0, found: 0, expected: 1 }));
    assert!(matches!(ask(&[key], vec![f64::NAN.into()], &[output]), EvaluateError::NotFinite { row: 0, .. }));
    let hours = ["operation.hours", "operation.pinion_revolutions"];
    assert!(matches!(ask(&hours, vec![1.0.into(), 1.0.into()], &[output]), EvaluateError::SaidTwice { .. }));
    assert!(matches!(ask(&["operation.phases.3.hours"], vec![1.0.into()], &[output]), EvaluateError::NoPhase { .. }));
}
