//! Tooth stiffness against Weber and Banaschek's formulae evaluated independently.

use gearwear_bodies::gear::Gear;
use gearwear_physics::contact::{
    hertz,
    winkler::{Winkler, WinklerFoundation},
};
use gearwear_physics::stiffness::{TeethSpring, settings::StiffnessSettings, weber_banaschek::ToothCompliance};

use super::common::{STEEL, assert_close, fzg_c, pair, steel};

/// Independent evaluation for the project with w = 400 N/mm: E·δ/w of pinion, wheel and flattening, pair in N/(µm·mm).
const WEBER_BANASCHEK: [[f64; 4]; 5] = [
    [3.24, 12.33, 4.04, 10.51],
    [3.71, 6.26, 4.02, 14.73],
    [4.58, 4.46, 3.99, 15.81],
    [6.30, 3.37, 3.94, 15.14],
    [12.71, 2.52, 3.63, 10.92],
];

#[test]
fn val_weber_banaschek_terms_of_fzg_c() {
    let pair = pair(&fzg_c());
    let tooth = |g: Gear| ToothCompliance::new(&pair.teeth[g], &STEEL);
    let (pinion, wheel) = (tooth(Gear::Pinion), tooth(Gear::Wheel));
    assert_close("s_F1", pinion.root_chord_mm, 8.910, 1e-4);
    assert_close("s_F2", wheel.root_chord_mm, 9.399, 1e-4);
    for (row, position) in WEBER_BANASCHEK.iter().zip(pair.path.points_mm()) {
        let e = STEEL.young_modulus_mpa;
        let terms = [
            e * pinion.mm2_per_n(pair.path.rho_mm(Gear::Pinion, position)),
            e * wheel.mm2_per_n(pair.path.rho_mm(Gear::Wheel, position)),
            e * hertz::flattening(&pair, &steel(), position).approach_mm(400.0) / 400.0,
        ];
        for (term, expected) in terms.iter().zip(row) {
            // The table has two decimals, the last one not always rounded.
            assert!((term - expected).abs() < 0.008, "{terms:?} against {row:?}");
        }
        let stiffness = e / terms.iter().sum::<f64>() / 1e3;
        assert!((stiffness - row[3]).abs() < 0.012, "{stiffness} against {}", row[3]);
    }
}

/// Whatever the surface, spring and surface together have the model's compliance at the reference load.
#[test]
fn ver_the_split_keeps_the_whole_compliance() {
    let pair = pair(&fzg_c());
    let bed =
        Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm: 5.4e5 }, expected_line_load_n_per_mm: 400.0 };
    let on_bed = TeethSpring::new(StiffnessSettings::WeberBanaschek, None, &pair, &steel(), &bed, 400.0).unwrap();
    for (row, position) in WEBER_BANASCHEK.iter().zip(pair.path.points_mm()) {
        let whole = on_bed.pair_n_per_mm2(position).unwrap() / 1e3;
        assert!((whole - row[3]).abs() < 0.012, "{whole} against {}", row[3]);
    }
}

#[test]
fn a_surface_softer_than_the_pair_is_refused() {
    let pair = pair(&fzg_c());
    let bed =
        Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm: 1e3 }, expected_line_load_n_per_mm: 400.0 };
    let spring = TeethSpring::new(StiffnessSettings::WeberBanaschek, None, &pair, &steel(), &bed, 400.0).unwrap();
    assert!(spring.n_per_mm2(pair.path.pitch_point_mm).is_err());
}

/// A stiffness that is stated from A to E alone goes on beyond it as Weber and Banaschek's teeth do, which are stated everywhere.
#[test]
fn ver_beyond_a_and_e_teeth_yield_as_weber_and_banascheks() {
    let pair = pair(&fzg_c());
    // It flattens as the model has it, so that the spring is that of the teeth.
    let hertz = hertz::Hertz { material: steel(), expected_line_load_n_per_mm: 400.0 };
    let [stated, everywhere] = [StiffnessSettings::Iso6336, StiffnessSettings::WeberBanaschek]
        .map(|model| TeethSpring::new(model, None, &pair, &steel(), &hertz, 400.0).unwrap());
    let beyond_mm = 0.2 * pair.path.base_pitch_mm;
    for (end_mm, beyond_mm) in
        [(pair.path.start_mm, pair.path.start_mm - beyond_mm), (pair.path.end_mm, pair.path.end_mm + beyond_mm)]
    {
        let [found, expected] = [&stated, &everywhere]
            .map(|spring| spring.n_per_mm2(end_mm).unwrap() / spring.n_per_mm2(beyond_mm).unwrap());
        assert_close("spring beyond the path", found, expected, 1e-9);
        assert!((expected - 1.0).abs() > 0.01, "{expected}");
    }
}
