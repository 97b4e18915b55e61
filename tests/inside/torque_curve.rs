//! Transmission error over torque: the run's own figures under its own torque, those of other runs under theirs, and the torque that a relief suits.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear::{Unwatched, evaluate};
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

const TORQUE_NM: f64 = 302.0;

/// A scene under [`TORQUE_NM`] with `pair` and other `keys` and these torques of the curve.
fn scene_under(torque_nm: f64, pair: &str, keys: &str, torques: &str, coefficient: f64) -> String {
    format!(
        "[pair]\npreset = \"fzg-c\"\n{pair}[operation]\npinion_torque_Nm = {torque_nm}\npinion_revolutions = 1e6\n\
         snapshots_revolutions = [1e6]\ntorque_curve_Nm = [{torques}]\n{keys}[wear]\nlaw = \"archard\"\n\
         coefficient_m2_per_N = {coefficient:e}\n[numerics]\nflank_points = 300\npositions = 80\nerror_estimate = false\nverify = false\n"
    )
}

fn run(text: &str) -> RunRecord {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}"));
    runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap()
}

/// Transmission errors of the new pair, torque by torque.
fn new_um(record: &RunRecord) -> Vec<f64> {
    record.torque_curve.iter().map(|row| row.transmission_error_peak_to_peak_new_um.unwrap()).collect()
}

const MODELS: [&str; 3] = [
    "[contact]\nsurface = \"fem\"\n",
    "[contact]\nsurface = \"half-space\"\n[stiffness]\nmodel = \"weber-banaschek\"\n",
    "[contact]\nsurface = \"half-space\"\n[stiffness]\nmodel = \"weber-banaschek\"\n[helical]\nslices = 4\ncoupling = \"slicing\"\n",
];

/// Under the torque of the run the curve has the run's own figures; so close to it that nothing changes, mesh cycles of its own come to the same, new
/// and worn. The gears are meshed, and the teeth condensed, once.
#[test]
fn the_curve_meets_the_run() {
    for (index, keys) in MODELS.into_iter().enumerate() {
        let text = scene_under(TORQUE_NM, "", keys, "301.999, 302.0", 1e-18);
        let record = run(&if index == 2 { text.replace("fzg-c", "helical") } else { text });
        let summary = &record.summary;
        let [near, own] = record.torque_curve.as_slice() else { panic!("{:?}", record.torque_curve) };
        let of_run = [&summary.new, &summary.worn];
        let pick = [
            [own.transmission_error_peak_to_peak_new_um, own.transmission_error_peak_to_peak_worn_um],
            [own.mesh_order_1_new_um, own.mesh_order_1_worn_um],
            [own.flank_pressure_new_MPa, own.flank_pressure_worn_MPa],
        ];
        assert_eq!(pick[0], of_run.map(|state| Some(state.transmission_error_um.peak_to_peak)), "{keys}");
        assert_eq!(pick[1], of_run.map(|state| state.mesh_orders_um.first().copied()), "{keys}");
        assert_eq!(pick[2], of_run.map(|state| Some(state.flank_pressure_MPa)), "{keys}");
        assert!(pick[0][0] != pick[0][1], "{keys}: nothing is worn");
        let beside = [near.transmission_error_peak_to_peak_new_um, near.transmission_error_peak_to_peak_worn_um];
        for (beside, own) in beside.into_iter().zip(pick[0]) {
            let difference = (beside.unwrap() / own.unwrap() - 1.0).abs();
            assert!(difference < 1e-4, "{keys}: {difference:e} from the run");
        }
        let stages = |name: &str| summary.stages.iter().filter(|stage| stage.name == name).count();
        assert_eq!((stages("finite-element-model"), stages("torque-curve")), (usize::from(index == 0), 1), "{keys}");
        let curve = summary.transmission_error_over_torque.as_ref().unwrap();
        assert_eq!(curve.new.max_um, new_um(&record).into_iter().reduce(f64::max), "{keys}");
    }
}

/// What the curve has under a torque is what a run under that torque finds on new flanks, to the bit where its teeth are a closed form.
#[test]
fn ver_the_curve_is_runs_under_other_torques() {
    let of_curve = new_um(&run(&scene_under(TORQUE_NM, "", MODELS[1], "75.5, 151.0", 1e-20)));
    for (torque_nm, on_curve) in [75.5, 151.0].into_iter().zip(of_curve) {
        let alone = run(&scene_under(torque_nm, "", MODELS[1], "", 1e-20));
        assert_eq!(alone.summary.new.transmission_error_um.peak_to_peak, on_curve, "{torque_nm} N·m");
        assert!(alone.torque_curve.is_empty() && alone.summary.transmission_error_over_torque.is_none());
        assert!(alone.summary.left_out.iter().any(|stage| stage.name == "torque-curve"));
    }
}

/// Springs of a constant stiffness, on a Winkler foundation whose springs go with the load as Hertz's half-width has it: what every tooth pair gives way by
/// is proportional to its load, and without modifications so is the transmission error to the torque.
const STRAIGHT: &str = "[contact]\nsurface = \"winkler\"\nmatch = \"half-width\"\ntip_contact = false\n\
                        [stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 15.2\n";

#[test]
fn ver_constant_stiffness_makes_a_straight_line() {
    let record = run(&scene_under(TORQUE_NM, "", STRAIGHT, "75.5, 151.0, 302.0, 604.0", 1e-22));
    let um = new_um(&record);
    for (row, um) in record.torque_curve.iter().zip(&um) {
        let expected = record.summary.new.transmission_error_um.peak_to_peak * row.pinion_torque_Nm / TORQUE_NM;
        assert!((um / expected - 1.0).abs() < 5e-4, "{} N·m: {um} instead of {expected}", row.pinion_torque_Nm);
    }
}

/// Linear tip reliefs C that begin at D and B. Without them one pair gives way by δ₁ and two by δ₂, both proportional to the torque; with them two pairs
/// in mesh together lack C all along, and the wheel lags by δ₂ + C/2. Where that is δ₁ the transmission error is least (Harris, 1958).
#[test]
fn ver_a_long_relief_suits_one_torque() {
    let plain = run(&scene_under(TORQUE_NM, "", STRAIGHT, "", 1e-22)).summary.new.transmission_error_um;
    let amount_um = 25.0;
    let suited_nm = TORQUE_NM * 0.5 * amount_um / plain.peak_to_peak;
    let relief = format!("tip_relief = {{ amount_um = {amount_um}, length_mm = 5.8, shape = \"linear\" }}\n");
    let pair = format!("[pair.pinion]\n{relief}[pair.wheel]\n{relief}");
    let torques = [0.4, 0.7, 1.0, 1.3, 1.6].map(|part| (part * suited_nm).to_string()).join(", ");
    let um = new_um(&run(&scene_under(TORQUE_NM, &pair, STRAIGHT, &torques, 1e-22)));
    assert!(um.iter().all(|value| *value >= um[2]) && um[0] > 3.0 * um[2] && um[4] > 3.0 * um[2], "{um:?}");
}

/// Torques that do not rise are refused at their place; studies have the curve only where an output is of it.
#[test]
fn torques_rise_and_studies_ask() {
    let problems = Resolved::from_toml(&scene_under(TORQUE_NM, "", MODELS[1], "100.0, 50.0", 1e-20)).unwrap_err();
    assert!(
        problems.iter().any(|problem| problem.to_string().contains("operation.torque_curve_Nm[1]")),
        "{problems:?}"
    );
    let scene = LoadedScene::from_toml(&scene_under(TORQUE_NM, "", MODELS[1], "151.0, 302.0", 1e-20)).unwrap();
    let rows = vec![vec![toml::Value::Float(1e6)]];
    let outputs =
        ["transmission_error_over_torque.new.mean_um", "transmission_error_over_torque.new.peak_to_peak_um.2"];
    let keys = ["operation.pinion_revolutions"];
    let found = evaluate(&scene, &keys, &rows, &outputs, 1, &Unwatched).unwrap();
    let expected = new_um(&gearwear::run(&scene, &Unwatched).unwrap().complete().unwrap());
    assert_eq!(found.values[0][1], expected[1]);
    assert!((found.values[0][0] - 0.5 * (expected[0] + expected[1])).abs() < 1e-9);
}
