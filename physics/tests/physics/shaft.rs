//! Twist of what carries the teeth, against a printed calculation, and its tilt on bearings, against beams of textbooks.

use gearwear_bodies::gear::shaft::{EndFace, Shaft};
use gearwear_bodies::gear::shaft_bearings::{ShaftBeam, ShaftBearings, ToothForceDirection};
use gearwear_bodies::gear::slices::Slices;

use crate::common::assert_close;

/// RIKOR's test 001 (FVA, its public listing of results): 8962.5 N·m on a pinion of 127 mm with d_T = 102.37 mm, 1319.34 N/mm; its twist
/// r_b (T/2) b/(G J) is printed as 35.0 µm and is 34.96 µm with E = 210 GPa and ν = 0.3.
#[test]
fn val_twist_of_a_pinion() {
    let shaft = Shaft { diameter_mm: 102.37, bore_diameter_mm: 0.0, driven_at: EndFace::End, bearings: None };
    let (line_load, face_width_mm) = (1319.34, 127.0);
    let base_radius_mm = 8962.5e3 / (line_load * face_width_mm);
    let whole = shaft.twist_mm(base_radius_mm, 210e3 / 2.6, face_width_mm, line_load);
    assert_close("closed form", 1e3 * whole, 34.96, 2e-4);
    for count in [1, 7, 2000] {
        let slice_width_mm = face_width_mm / count as f64;
        let width_mm = (0..count).map(|i| (i as f64 + 0.5) * slice_width_mm).collect();
        let slices = Slices { width_mm, ahead_mm: vec![0.0; count], slice_width_mm, ahead_varies_mm: 0.0 };
        let coupling = shaft.mm2_per_n(base_radius_mm, 210e3 / 2.6, &slices);
        let twist_um: Vec<f64> =
            coupling.chunks_exact(count).map(|row| 1e3 * line_load * row.iter().sum::<f64>()).collect();
        // On average ⅔ of the far end's, in however many slices.
        assert_close("mean", twist_um.iter().sum::<f64>() / count as f64, 34.96 / 1.5, 2e-4);
        if count == 2000 {
            assert_close("far end", twist_um[0], 34.96, 2e-4);
            assert!(twist_um[count - 1] < 0.03, "the driven end gives way by {} µm", twist_um[count - 1]);
        }
        for (a, row) in coupling.chunks_exact(count).enumerate() {
            assert!(row.iter().enumerate().all(|(b, value)| *value == coupling[b * count + a]), "row {a}");
        }
    }
}

fn beam(positions_mm: [f64; 2], stiffness_n_per_mm: [f64; 2], axial_lever_mm: f64) -> ShaftBeam {
    ShaftBeam {
        bearings: ShaftBearings { positions_mm, stiffness_n_per_mm },
        bending_stiffness_n_mm2: 206e3 * std::f64::consts::PI / 64.0 * 40f64.powi(4),
        direction: ToothForceDirection { working_pressure_angle_rad: 22f64.to_radians(), axial_lever_mm },
    }
}

/// A force P at the distances a and b from rigid supports L apart turns the beam there by P a b (b − a)/(3 E I L), and sinks by P a² b²/(3 E I L);
/// at the end of an overhang c beside the span L it sinks by P c² (L + c)/(3 E I) and turns by P c (2 L + 3 c)/(6 E I). Springs add the tilt of a
/// rigid bar on the reactions: (R_2/k_2 − R_1/k_1)/L (Timoshenko, Strength of Materials, part I; Roark's table of beams).
#[test]
fn ver_shafts_tilt_as_beams_on_springs() {
    let turn = |beam: &ShaftBeam| {
        let h = 1e-3;
        (beam.gives_way_mm_per_n(h, 0.0) - beam.gives_way_mm_per_n(-h, 0.0)) / (2.0 * h)
    };
    let e_i = beam([-1.0, 1.0], [1.0; 2], 0.0).bending_stiffness_n_mm2;
    let rigid = [1e15; 2];
    let (a, b) = (40.0, 60.0);
    let between = beam([-a, b], rigid, 0.0);
    assert_close("sinks", between.gives_way_mm_per_n(0.0, 0.0), a * a * b * b / (3.0 * e_i * (a + b)), 1e-8);
    assert_close("turns", turn(&between), a * b * (b - a) / (3.0 * e_i * (a + b)), 1e-5);
    let (l, c) = (80.0, 30.0);
    let overhung = beam([-c - l, -c], rigid, 0.0);
    assert_close("overhang sinks", overhung.gives_way_mm_per_n(0.0, 0.0), c * c * (l + c) / (3.0 * e_i), 1e-8);
    assert_close("overhang turns", turn(&overhung), c * (2.0 * l + 3.0 * c) / (6.0 * e_i), 1e-5);
    // Springs: R_1 = −c/L, R_2 = (L + c)/L.
    let (k_1, k_2) = (2e5, 3e5);
    let sprung = beam([-c - l, -c], [k_1, k_2], 0.0);
    let of_springs = ((l + c) / l / k_2 + c / l / k_1) / l;
    assert_close("springs turn", turn(&sprung) - turn(&overhung), of_springs, 1e-5);
    // Over a face width of 20 mm under 100 N/mm, the tilt of the middle and hardly more.
    let misalignment = sprung.misalignment_mm(20.0, 100.0);
    assert_close("misalignment", misalignment, 20.0 * 2000.0 * turn(&sprung), 0.01);
}

/// A spur gear in the middle between equal bearings does not tilt; the axial force of a helix tilts it by M/k_r and M (a² − a b + b²)/(3 E I L).
#[test]
fn ver_gears_between_equal_bearings_do_not_tilt_without_an_axial_force() {
    let (a, k) = (50.0, 1e5);
    let spur = beam([-a, a], [k; 2], 0.0);
    assert!(spur.misalignment_mm(20.0, 100.0).abs() < 1e-12, "{}", spur.misalignment_mm(20.0, 100.0));
    let lever = 12.0;
    let helical = beam([-a, a], [k; 2], lever);
    let sin = 22f64.to_radians().sin();
    let per_moment = 1.0 / (2.0 * k * a * a) + a * a / (3.0 * spur.bending_stiffness_n_mm2 * 2.0 * a);
    let turn = (helical.gives_way_mm_per_n(1e-3, 0.0) - helical.gives_way_mm_per_n(-1e-3, 0.0)) / 2e-3;
    // The point of the axial force follows the slope, which the force itself changes by −P L/(4 E I) per length.
    let curvature = -0.5 * a / spur.bending_stiffness_n_mm2;
    assert_close("moment", turn, sin * lever * (per_moment + curvature), 1e-4);
    let slices = Slices {
        width_mm: vec![2.5, 7.5, 12.5, 17.5],
        ahead_mm: vec![0.0; 4],
        slice_width_mm: 5.0,
        ahead_varies_mm: 0.0,
    };
    let matrix = helical.mm2_per_n(&slices);
    for (i, row) in matrix.chunks_exact(4).enumerate() {
        assert!(row.iter().enumerate().all(|(j, value)| *value == matrix[4 * j + i]), "row {i}");
    }
}
