//! The sun of a planetary stage, weighed until it failed, predicted from the first half of its measurements.
//!
//! Zhao, Tian, Liang and Xie, IEEE Trans. Reliability 67 (2018) 316–327, doi 10.1109/TR.2017.2781147: 19, 31 and 81 teeth, module 3.2 mm, 20°, face width
//! 38.1 mm, four planets, 2825 N·m on the sun, E 210 GPa, k about 1.27e-15 m²/N before any measurement. Profile shifts are not given: none. The
//! scene is the external pair of sun and planet with a quarter of the torque, in the frame of the planets, in which the sun turns
//! 81/(19 + 81) as often. Its mass is almost proportional to revolutions, 1 % less at the end than a straight line through the beginning, on
//! `half-space` and `hertz-mean` alike. On finite elements (the default surface; two minutes a run) predictions are 0.7 to 1.3 % higher than on half-planes: with
//! the regime's prior −3.5 to +8.1 %, without one +10.3 % at 23.14 g, where the scatter is greatest, and at most 2.9 % elsewhere.

use std::fs;
use std::path::Path;

use gearwear::report;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::SceneText;
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_studies::remaining_life::asked::{LifeOptions, PreparedLife};
use gearwear_studies::remaining_life::record::LifeRecord;

use crate::common::loaded;

const SCENE: &str = "title = \"Sun and planet of a planetary stage\"\n\
    [pair]\nnormal_module_mm = 3.2\npressure_angle_deg = 20.0\ncentre_distance_mm = 80.0\nface_width_mm = 38.1\n\
    [pair.pinion]\nteeth = 19\nprofile_shift = 0.0\n[pair.wheel]\nteeth = 31\nprofile_shift = 0.0\n\
    [material]\nyoung_modulus_GPa = 210.0\npoisson_ratio = 0.3\ndensity_kg_per_m3 = 7830.0\n\
    [operation]\npinion_torque_Nm = 706.25\npinion_revolutions = 1e6\nmeshes_per_revolution = { pinion = 4, wheel = 1 }\n\
    [contact]\nsurface = \"half-space\"\ntip_contact = false\n\
    [stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n\
    [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1.27e-15\n\
    [numerics]\nflank_points = 200\npositions = 100\nerror_estimate = false\nverify = false\n";

/// Cycles of the sun, and g.
const WEIGHED: [(f64, f64); 10] = [
    (89_600.0, 1.40),
    (268_800.0, 4.45),
    (358_400.0, 8.12),
    (448_000.0, 10.90),
    (582_400.0, 13.81),
    (716_800.0, 17.00),
    (868_000.0, 20.13),
    (1_100_000.0, 23.14),
    (1_136_800.0, 26.04),
    (1_271_200.0, 28.71),
];
/// Turns of the sun against the planets' carrier, of one turn.
const AGAINST_CARRIER: f64 = 81.0 / 100.0;

fn evaluated(run: &Path, prior: Option<&str>) -> LifeRecord {
    let rows: String = WEIGHED.iter().map(|(cycles, g)| format!("{},{g}\n", AGAINST_CARRIER * cycles)).collect();
    let table = SceneText { name: "sun.csv".to_owned(), text: format!("revolutions,mass_loss_g\n{rows}") };
    let asked = LifeOptions {
        gear: Some(Gear::Pinion),
        prior: prior.map(|prior| prior.parse().unwrap()),
        limits: vec!["pinion.worn_mass_mg = 28710".parse().unwrap()],
        ..LifeOptions::default()
    };
    PreparedLife::open(run, &table, &asked).unwrap().carry_out(&Unwatched).unwrap()
}

/// Bounds of the requirement: the second half from the first within 10 % each, and within the 95 % interval.
#[test]
fn val_the_second_half_is_predicted_from_the_first() {
    let run = tempfile::tempdir().unwrap();
    let resolved = Resolved::from_toml(SCENE).unwrap();
    let record = runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap();
    report::write_data(&record, run.path()).unwrap();
    report::write_summary(&record.summary, run.path()).unwrap();
    fs::write(run.path().join("scene.toml"), resolved.to_toml()).unwrap();
    for prior in [None, Some("regime-2")] {
        let found = evaluated(run.path(), prior);
        let of = &found.gears[0];
        let half = &of.updates[5];
        for later in &half.later {
            let [median, low, high] = [later.median, later.low, later.high].map(|value| 1e-3 * value.unwrap());
            let (_, g) = WEIGHED[later.measurement - 1];
            println!(
                "{prior:?}: {g} g, predicted {median:.2} ({:+.1} %), {low:.2} to {high:.2}",
                100.0 * (median / g - 1.0)
            );
            assert!((median / g - 1.0).abs() <= 0.10, "{g} g: {median}");
            assert!((low..=high).contains(&g), "{g} g: {low} to {high}");
        }
        // What was left to the limit, which was reached with the last measurement.
        let left = half.life.unwrap().remaining_revolutions;
        let truth = AGAINST_CARRIER * (WEIGHED[9].0 - WEIGHED[4].0);
        println!("{prior:?}: left {:.0}, {:.0} to {:.0}; it was {truth:.0}", left.median, left.low, left.high);
        assert!((left.low..=left.high).contains(&truth), "{left:?} {truth}");
        for update in &of.updates[1..9] {
            let life = update.life.unwrap().remaining_revolutions;
            let truth = AGAINST_CARRIER * WEIGHED[9].0 - update.revolutions;
            assert!((life.low..=life.high).contains(&truth), "{} measurements: {life:?} {truth}", update.measurements);
        }
    }
}
