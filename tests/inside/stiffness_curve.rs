//! Curves of tooth stiffness that a user supplies, in whole runs.

use gearwear::runs;
use gearwear::scene::loaded::NamedFiles;
use gearwear::scene::{Resolved, presets};
use gearwear_physics::contact::hertz;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::stiffness::curve_file;

use super::common::{assert_close, fzg_c, loaded_with, pair, steel};

/// The figure of a run with a curve: C at 13.9701, between 4.4 and 14: the compliance is a straight line from 1/10 to 1/20 µm mm/N, to
/// which Hertz's flattening adds.
#[test]
fn ver_a_run_states_the_stiffness_of_its_curve() {
    let text = presets::find("thesis-spur").unwrap().text;
    let text = text.replace("model = \"constant\"", "model = \"simon\"\ncurve = \"teeth.csv\"");
    let text = text.replace("pair_N_per_mm_um", "# pair_N_per_mm_um").replace("positions = 400 ", "positions = 40 ");
    let text = text
        .replace("revolutions = 7665.0", "revolutions = 200000.0")
        .replace("error_estimate = true", "verify = false");
    let resolved = Resolved::from_toml(&text).unwrap_or_else(|problems| panic!("{problems:?}"));
    let gears = pair(&fzg_c());
    let curve = "# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,10\n14,20\n23.6,11\n";
    let curve = curve_file::parse(curve, &gears.path).unwrap();
    let files = NamedFiles { stiffness_curve: Some(curve), ..NamedFiles::default() };
    let summary = runs::run(&loaded_with(&resolved, files), &Unwatched).unwrap().record.summary;
    let load = summary.contact.line_load_N_per_mm;
    let flattening_um = 1e3 * hertz::flattening(&gears, &steel(), gears.path.pitch_point_mm).approach_mm(load);
    let teeth = 0.1 + (13.9701 - 4.4) / 9.6 * (0.05 - 0.1);
    let whole = summary.stiffness.unwrap().pair_at_pitch_N_per_mm_um;
    assert_close("pair", whole, 1.0 / (teeth + flattening_um / load), 1e-5);
}

/// What is written is read as the same curve, the part that all pairs in mesh share included.
#[test]
fn a_curve_is_read_as_it_is_written() {
    let path = pair(&fzg_c()).path;
    let text = "# flattening = excluded\n# shared_um_mm_per_N = 0.0625\nposition_mm,stiffness_N_per_mm_um\n4.0,16.0\n24.0,8.0\n";
    let curve = curve_file::parse(text, &path).unwrap();
    assert_eq!((curve.shared_mm2_per_n, curve.at(24.0)), (0.0625e-3, 1.0 / 8e3));
    assert_eq!(curve_file::to_text(&curve), text);
    let whole = text.replace("excluded", "included\n# line_load_N_per_mm = 500.0");
    let curve = curve_file::parse(&whole, &path).unwrap();
    assert_eq!(curve_file::to_text(&curve), whole);
}
