//! Curves of tooth stiffness that a user supplies: what they mean, and what is refused.

use gearwear_bodies::gear::PerGear;
use gearwear_physics::contact::{hertz, hertz::Hertz};
use gearwear_physics::stiffness::{
    TeethSpring,
    curve::{PairCompliance, StandsFor},
    curve_file::{self, CurveFileError},
    settings::StiffnessSettings,
    weber_banaschek::ToothCompliance,
};

use super::common::{Scene, assert_close, fzg_c, fzg_c_scene, pair, steel};

fn parse(text: &str) -> Result<PairCompliance, CurveFileError> {
    curve_file::parse(text, &pair(&fzg_c()).path)
}

/// The same pair in three ways: its stiffness, its deflection under 400 N/mm, and Weber and Banaschek's terms themselves.
#[test]
fn ver_stiffness_and_deflection_say_the_same() {
    let pair = pair(&fzg_c());
    let tooth = PerGear::from_fn(|gear| ToothCompliance::new(&pair.teeth[gear], &steel()[gear]));
    let teeth = |at| PerGear::from_fn(|gear| tooth[gear].mm2_per_n(pair.path.rho_mm(gear, at))).sum();
    let flattening = |at| hertz::flattening(&pair, &steel(), at).approach_mm(400.0) / 400.0;
    let mut stiffness = String::from("# a remark\n#line_load_N_per_mm=400\n# flattening = included\n");
    let mut deflection = String::from("# line_load_N_per_mm = 400\n# flattening = excluded\n");
    stiffness += "position_mm,stiffness_N_per_mm_um\n";
    deflection += "gear, deflection_um , position_mm\n";
    for at in pair.path.points_mm() {
        stiffness += &format!("{at:?},{:?}\n", 1e-3 / (teeth(at) + flattening(at)));
        deflection += &format!("x, {:?}, {at:?}\r\n", 400e3 * teeth(at));
    }
    let [stiffness, deflection] = [stiffness, deflection].map(|text| parse(&text).unwrap());
    assert_eq!(stiffness.stands_for, StandsFor::WholePair { line_load_n_per_mm: 400.0 });
    assert_eq!(deflection.stands_for, StandsFor::Teeth);
    let surface = Hertz { material: steel(), expected_line_load_n_per_mm: 637.66 };
    let spring = |model, curve| TeethSpring::new(model, curve, &pair, &steel(), &surface, 637.66).unwrap();
    let own = spring(StiffnessSettings::WeberBanaschek, None);
    for at in pair.path.points_mm() {
        let expected = own.n_per_mm2(at).unwrap();
        for (model, curve) in [(StiffnessSettings::Simon, &stiffness), (StiffnessSettings::WangCheng, &deflection)] {
            assert_close(model.name(), spring(model, Some(curve)).n_per_mm2(at).unwrap(), expected, 1e-10);
        }
    }
    // Between A and B the compliance is a straight line.
    let (a, b) = (pair.path.start_mm, pair.path.lower_single_contact_mm());
    assert_close("halfway", deflection.at(a.midpoint(b)), 0.5 * (teeth(a) + teeth(b)), 1e-12);
}

/// Bodies that all pairs share, q_b of each pair's compliance, change nothing while one pair carries all; while two do, each
/// of them yields by q_b times the load of the other more.
#[test]
fn ver_shared_bodies_yield_under_the_load_of_every_pair() {
    let shared_mm2_per_n = 6.4e-6;
    let run = |shared_mm2_per_n| {
        let curve = PairCompliance {
            position_mm: vec![4.0, 24.0],
            mm2_per_n: vec![5e-5; 2],
            stands_for: StandsFor::Teeth,
            shared_mm2_per_n,
        };
        let scene = Scene { surface: "hertz", stiffness: StiffnessSettings::Fem, curve: Some(curve), ..fzg_c_scene() };
        let found = Scene { revolutions: 1.0, steps: 1.0, ..scene.clone() }.run().new.cycle;
        (found, scene.line_load())
    };
    let ((alone, _), (together, load)) = (run(0.0), run(shared_mm2_per_n));
    for (alone, together) in alone.positions.iter().zip(&together.positions) {
        let more = together.transmission_error_mm - alone.transmission_error_mm;
        if alone.load_share > 1.0 - 1e-9 {
            assert!(more.abs() < 1e-12, "{alone:?}");
        } else {
            // Exact for equal shares; the less compliant share is loaded a little more.
            let of_the_other = shared_mm2_per_n * load * 0.5;
            assert!((more / of_the_other - 1.0).abs() < 0.05, "{} {more}", alone.position_mm);
        }
    }
}

#[test]
fn what_is_no_curve_is_refused_with_its_place() {
    let good = "# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,10\n14,15\n23.6,11\n";
    assert!(parse(good).is_ok());
    assert!(parse(&format!("\u{feff}{good}")).is_ok());
    let cases: [(&str, &str, &[&str]); 16] = [
        ("# flattening = excluded\n", "", &["flattening of the flanks", "included", "excluded"]),
        ("excluded", "maybe", &["line 1", "flattening", "found maybe", "included or excluded"]),
        ("excluded", "included", &["line load of the flattening", "line_load_N_per_mm"]),
        ("stiffness_N_per_mm_um", "deflection_um", &["line load of the deflections", "line_load_N_per_mm"]),
        ("excluded", "included\n# line_load_N_per_mm = -3", &["line 2", "line_load_N_per_mm", "found -3"]),
        ("position_mm", "place", &["line 2", "column names", "found place,", "position_mm"]),
        ("stiffness_N_per_mm_um", "stiffness", &["line 2", "found position_mm,stiffness", "deflection_um"]),
        ("14,15", "14,abc", &["line 4", "stiffness_N_per_mm_um", "found abc", "a number greater than 0"]),
        ("14,15", "14", &["line 4", "stiffness_N_per_mm_um", "found nothing"]),
        ("14,15", "14,0", &["line 4", "found 0"]),
        ("14,15", "14,inf", &["line 4", "found inf"]),
        ("14,15", "NaN,15", &["line 4", "position_mm", "found NaN"]),
        ("14,15", "4.4,15", &["line 4", "position_mm", "found 4.4", "more than 4.4, the row before"]),
        ("4.4,10\n14,15\n23.6,11\n", "4.4,10\n", &["rows is missing", "at least two"]),
        ("23.6,11\n", "", &["found 4.4000 to 14.0000", "4.4723 (A)", "23.5694 (E)"]),
        (good, "", &["column names is missing"]),
    ];
    for (from, to, parts) in cases {
        let message = parse(&good.replace(from, to)).unwrap_err().to_string();
        for part in parts {
            assert!(message.contains(part), "no {part:?} in {message:?} ({from:?} -> {to:?})");
        }
    }
}
