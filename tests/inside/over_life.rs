//! Transmission error over the life of a pair: the mean over all wear steps is that of closely kept states, of each phase under its own load.

use gearwear::Unwatched;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

const MODELS: [&str; 3] = [
    "[contact]\nsurface = \"fem\"\n",
    "[contact]\nsurface = \"half-space\"\n[stiffness]\nmodel = \"weber-banaschek\"\n",
    "[contact]\nsurface = \"half-space\"\n[stiffness]\nmodel = \"weber-banaschek\"\n[helical]\nslices = 4\ncoupling = \"slicing\"\n",
];

fn run(operation: &str, model: &str) -> RunRecord {
    let preset = if model.contains("slices") { "helical" } else { "fzg-c" };
    let text = format!(
        "[pair]\npreset = \"{preset}\"\n[operation]\n{operation}{model}[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
         [numerics]\nflank_points = 300\npositions = 80\nerror_estimate = false\nverify = false\n"
    );
    let resolved = Resolved::from_toml(&text).unwrap_or_else(|problems| panic!("{problems:?}"));
    runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap()
}

fn mean_um(record: &RunRecord) -> f64 {
    record.summary.transmission_error_over_life.unwrap().mean_um
}

/// Mean by the trapezoidal rule over the kept states.
fn mean_of_history_um(record: &RunRecord) -> f64 {
    let new = (0.0, record.summary.new.transmission_error_um.peak_to_peak);
    let kept = record.history.iter().map(|row| (row.revolutions, row.transmission_error_peak_to_peak_um));
    let states: Vec<(f64, f64)> = [new].into_iter().chain(kept).collect();
    let areas = states.windows(2).map(|pair| (pair[1].0 - pair[0].0) * pair[0].1.midpoint(pair[1].1));
    areas.sum::<f64>() / states.last().unwrap().0
}

/// On every model, whatever is kept: the mean is that of twenty states, and the maximum none less than that of any.
#[test]
fn ver_the_mean_is_that_of_closely_kept_states() {
    for model in MODELS {
        let kept: Vec<String> = (1..=20).map(|index| format!("{}e4", 5 * index)).collect();
        let operation = |kept: &str| {
            format!("pinion_torque_Nm = 302.0\npinion_revolutions = 1e6\nsnapshots_revolutions = [{kept}]\n")
        };
        let close = run(&operation(&kept.join(", ")), model);
        let of_history = mean_of_history_um(&close);
        assert!((mean_um(&close) / of_history - 1.0).abs() < 2e-3, "{model}: {} and {of_history}", mean_um(&close));
        let sparse = run(&operation("1e6"), model);
        assert!((mean_um(&sparse) / of_history - 1.0).abs() < 5e-3, "{model}: {} and {of_history}", mean_um(&sparse));
        let greatest = close.history.iter().map(|row| row.transmission_error_peak_to_peak_um).fold(0.0, f64::max);
        assert!(close.summary.transmission_error_over_life.unwrap().max_um > 0.999 * greatest, "{model}");
    }
}

/// Two loads without wear to speak of: the mean is that of both by their revolutions.
#[test]
fn ver_each_load_of_a_spectrum_counts_by_its_revolutions() {
    let phase = |torque_nm: f64, revolutions: f64| {
        format!("[[operation.phases]]\npinion_torque_Nm = {torque_nm}\npinion_revolutions = {revolutions}\n")
    };
    let one = |torque_nm: f64| run(&format!("pinion_torque_Nm = {torque_nm}\npinion_revolutions = 10.0\n"), MODELS[1]);
    let both = run(&[phase(302.0, 10.0), phase(135.0, 30.0)].concat(), MODELS[1]);
    let by_hand = 0.25 * mean_um(&one(302.0)) + 0.75 * mean_um(&one(135.0));
    assert!((mean_um(&both) / by_hand - 1.0).abs() < 1e-5, "{} and {by_hand}", mean_um(&both));
}
