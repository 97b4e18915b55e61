//! What the thesis says of deep wear of helical gears (H6, paper E), in whole runs of the preset `thesis-helical`.

use gearwear::runs;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

use super::common::loaded;

/// A run of the preset `helical` on a surface, ten times as long as that of H1–H4, in so many wear steps.
fn deep_run(surface: &str, steps: f64) -> RunRecord {
    let mut text = gearwear::scene::presets::find("thesis-helical").unwrap().text.to_owned();
    let step = format!("step = {{ revolutions = {:?} }}", 6e6 / steps);
    for (from, to) in [
        ("surface = \"hertz\" ", format!("surface = \"{surface}\" ")),
        ("pinion_revolutions = 6e5", "pinion_revolutions = 6e6".to_owned()),
        ("snapshots_revolutions = [1e4, 3e4, 1e5, 3e5, 6e5]", "snapshots_revolutions = [6e6]".to_owned()),
        ("step = { revolutions = 10000.0 }", step),
        ("flank_points = 750 ", "flank_points = 375 ".to_owned()),
        ("positions = 400 ", "positions = 200 ".to_owned()),
        ("slices = 20 ", "slices = 10 ".to_owned()),
        ("error_estimate = true", "error_estimate = false\nverify = false".to_owned()),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, &to);
    }
    let resolved = gearwear::scene::Resolved::from_toml(&text).unwrap();
    runs::run(&loaded(&resolved), &Unwatched).unwrap().record
}

/// H6, paper E: the simplified model runs to greater depths without instability, and loses some boundary effects. To 26 µm in 6 steps it
/// says the same as in 60; springs against the worn gap do not, and warn. What it loses: nothing wears below the start of active profile,
/// where half of the strip reaches.
#[test]
fn val_h6_the_simplified_model_is_stable_at_depth() {
    let [[simplified, coarse], [springs, swinging]] =
        ["hertz-mean", "winkler"].map(|surface| [deep_run(surface, 60.0), deep_run(surface, 6.0)]);
    let peak = |record: &RunRecord| record.summary.pinion.peak_wear_um;
    let change = |fine: &RunRecord, coarse: &RunRecord| (peak(coarse) / peak(fine) - 1.0).abs();
    assert!(peak(&simplified) > 20.0, "{}", peak(&simplified));
    assert!(change(&simplified, &coarse) < 0.05, "{}", change(&simplified, &coarse));
    assert!(change(&springs, &swinging) > 0.2, "{}", change(&springs, &swinging));
    let warned =
        |record: &RunRecord| record.summary.warnings.iter().any(|warning| warning.starts_with("numerics.step"));
    assert!(warned(&swinging) && !warned(&coarse));

    let below_start = |record: &RunRecord| {
        let flank = &record.flanks.pinion;
        let start_mm = flank.path_point_radius_mm.A;
        let below = flank.radius_mm.iter().zip(&flank.wear_um).filter(|(radius, _)| **radius < start_mm - 0.01);
        below.map(|(_, wear)| *wear).fold(0.0, f64::max)
    };
    assert!(below_start(&simplified) == 0.0 && below_start(&springs) > 0.5, "{}", below_start(&springs));
    // Work tells the speed: two Newton iterations an equilibrium, on some tens of bytes a contact; springs take nearly four.
    let (work, of_springs) = (&simplified.summary.work, &springs.summary.work);
    assert_eq!(work.equilibria, of_springs.equilibria);
    assert!(work.newton_iterations < 2 * work.equilibria, "{work:?}");
    assert!(10 * work.newton_iterations < 6 * of_springs.newton_iterations, "{work:?} {of_springs:?}");
}
