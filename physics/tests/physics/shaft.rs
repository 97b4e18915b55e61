//! Twist of what carries the teeth, against a printed calculation.

use gearwear_bodies::gear::shaft::{EndFace, Shaft};
use gearwear_bodies::gear::slices::Slices;

use crate::common::assert_close;

/// RIKOR's test 001 (FVA, its public listing of results): 8962.5 N·m on a pinion of 127 mm with d_T = 102.37 mm, 1319.34 N/mm; its twist
/// r_b (T/2) b/(G J) is printed as 35.0 µm and is 34.96 µm with E = 210 GPa and ν = 0.3.
#[test]
fn val_twist_of_a_pinion() {
    let shaft = Shaft { diameter_mm: 102.37, bore_diameter_mm: 0.0, driven_at: EndFace::End };
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
