//! How slices of a tooth hold each other: limit cases, and the plate that a tooth is taken for.

use gearwear_bodies::gear::slices::Slices;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::contact::{Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep};
use gearwear_physics::mesh_cycle::bent_tooth::BentTooth;
use gearwear_physics::mesh_cycle::coupled_teeth::CoupledTeeth;
use gearwear_physics::mesh_cycle::load_sharing::MeshedPair;
use gearwear_physics::mesh_cycle::slice_coupling::{Factors, Reach, SliceCompliance, SliceCoupling};
use gearwear_physics::mesh_cycle::sliced_positions::{ContactPart, SliceContact};
use gearwear_physics::mesh_cycle::sliced_sharing::balance_on_teeth;

use super::common::{assert_close, fzg_c, pair, steel};

const NU: f64 = 0.3;

/// Deflection of the free edge of a cantilever plate of infinite length, height l, at z from a point load on that edge, over P l²/D:
/// exact, by the Fourier integral over harmonic edge loads (M. Lévy's solution: S. Timoshenko and S. Woinowsky-Krieger, *Theory
/// of Plates and Shells*, 1959, section 48).
fn exact_plate(z: f64) -> f64 {
    // Of w = A (s cosh s − sinh s) + B s sinh s, s = α x: clamped at s = 0; no moment and the load as shear at s = α.
    let edge = |alpha: f64| {
        let (c, s) = (alpha.cosh(), alpha.sinh());
        let value = [alpha * c - s, alpha * s];
        let first = [alpha * s, s + alpha * c];
        let second = [s + alpha * c, 2.0 * c + alpha * s];
        let third = [2.0 * c + alpha * s, 3.0 * s + alpha * c];
        let moment = [second[0] - NU * value[0], second[1] - NU * value[1]];
        let shear = [third[0] - (2.0 - NU) * first[0], third[1] - (2.0 - NU) * first[1]];
        let determinant = moment[0] * shear[1] - moment[1] * shear[0];
        let load = -1.0 / alpha.powi(3);
        let (a, b) = (-load * moment[1] / determinant, load * moment[0] / determinant);
        a * value[0] + b * value[1]
    };
    // Simpson's rule; beyond 40 the integrand is below 1e-5 of its beginning and falls with α⁻³.
    let (steps, end) = (20_000, 40.0);
    let h = end / f64::from(steps);
    let weight = |k: i32| {
        if k == 0 || k == steps {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let at = |k: i32| f64::from(k).max(1e-3) * h;
    let sum: f64 = (0..=steps).map(|k| weight(k) * edge(at(k)) * (at(k) * z).cos()).sum();
    sum * h / 3.0 / std::f64::consts::PI
}

/// The reach of a plate of even thickness and height 1.
fn even_plate() -> Reach {
    let height: Vec<f64> = (0..=2000).map(|k| f64::from(k) / 2000.0).collect();
    Reach::of_plate(&height, &vec![0.1; height.len()], 1.0, NU).0
}

/// Deflection along `count` slices under a unit load on slice `loaded`, with unit compliance.
fn under_point_load(coupling: &SliceCoupling, count: usize, loaded: usize) -> Vec<f64> {
    let mut u = vec![0.0; count];
    u[loaded] = 1.0;
    let mut factors = Factors::default();
    coupling.factorise(&vec![0.0; count], &mut factors);
    factors.solve(&mut u);
    u
}

/// The even plate in closed form, with f = (3y² − y³)/2: k = 3 D, ∫f'² = 6/5, ∫f f'' = 3/10, ∫f² = 33/140.
#[test]
fn ver_reach_of_an_even_plate() {
    let reach = even_plate();
    assert_close("ℓ₁²", reach.twist_mm2, (2.0 * (1.0 - NU) * 1.2 - 2.0 * NU * 0.3) / 3.0, 1e-5);
    assert_close("ℓ₂⁴", reach.bending_mm4, 33.0 / 140.0 / 3.0, 1e-5);
}

/// One loaded slice of a long tooth deflects as the plate-like tooth does: a little less at the load, as every reduction to chosen
/// shapes is too stiff, and the deflection dies out over the same length.
#[test]
fn val_one_loaded_slice_decays_as_the_plate_does() {
    let (count, width) = (801, 0.0125);
    let coupling = SliceCoupling::new(even_plate(), count, width);
    let u = under_point_load(&coupling, count, count / 2);
    // u is of q w with w = P/Δz and q = l³/(3D).
    let reduced = |z: f64| u[count / 2 + (z / width).round() as usize] / width / 3.0;
    let at_load = reduced(0.0) / exact_plate(0.0);
    assert!((0.95..1.0).contains(&at_load), "{at_load}");
    for z in [0.25, 0.5, 1.0, 1.5] {
        let (reduced, exact) = (reduced(z), exact_plate(z));
        assert!((reduced - exact).abs() < 0.05 * exact_plate(0.0), "{z}: {reduced} {exact}");
    }
    assert!(u[count / 2 + 320].abs() < 0.01 * u[count / 2], "four heights away nothing is left");
}

/// A load alike over the whole width deflects as if there were no coupling, up to the free ends; the operator is symmetric and its
/// factors solve it, with a diagonal and without, also for very thin slices, and where teeth resist twisting less at their ends.
#[test]
fn ver_uniform_load_and_factors() {
    let pair = pair(&fzg_c());
    let plates = SliceCompliance::of_plates(&pair, &steel(), true);
    let softer = SliceCompliance { end_twist: Some([4.0, 2.0]), end_length_mm: 3.0, ..plates };
    let reach = plates.reach;
    for (compliance, count) in [plates, softer].into_iter().flat_map(|of| [1, 2, 3, 20, 2000].map(|count| (of, count)))
    {
        let coupling = compliance.coupling(&Slices::new(&pair, count));
        let mut uniform = vec![0.0; count];
        coupling.apply(&vec![1.7; count], &mut uniform);
        assert!(uniform.iter().all(|w| (w / 1.7 - 1.0).abs() < 1e-9), "{count}");

        let diagonal: Vec<f64> =
            (0..count).map(|i| if i % 3 == 0 { 0.0 } else { 0.5 + i as f64 / count as f64 }).collect();
        let v: Vec<f64> = (0..count).map(|i| (5.0 * i as f64 / count as f64).sin() + 2.0).collect();
        let mut load = vec![0.0; count];
        coupling.apply(&v, &mut load);
        load.iter_mut().zip(&diagonal).zip(&v).for_each(|((load, d), v)| *load += d * v);
        let mut factors = Factors::default();
        coupling.factorise(&diagonal, &mut factors);
        factors.solve(&mut load);
        let error = load.iter().zip(&v).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Rounding the bands is worth ε times the greatest eigenvalue, at most 16 ℓ₂⁴/Δz⁴ of bending; the least is 1.
        let greatest = 16.0 * reach.bending_mm4 * (count as f64 / 14.0).powi(4);
        assert!(error < 1e-11_f64.max(2.0 * f64::EPSILON * greatest), "{count}: {error:.1e}");
    }
    let influence = |of: &SliceCompliance| -> Vec<Vec<f64>> {
        let coupling = of.coupling(&Slices::new(&pair, 12));
        (0..12).map(|k| under_point_load(&coupling, 12, k)).collect()
    };
    for influence in [influence(&plates), influence(&softer)] {
        for (i, of_slice) in influence.iter().enumerate() {
            for (k, there) in of_slice.iter().enumerate() {
                assert!((there - influence[k][i]).abs() < 1e-13, "Maxwell: {i} {k}");
            }
        }
    }
    let ends = |of: &SliceCompliance| [influence(of)[0][0], influence(of)[11][11]];
    let ([first, last], [even_first, even_last]) = (ends(&softer), ends(&plates));
    assert!(first > last && last > even_last && (even_first - even_last).abs() < 1e-13, "{first} {last} {even_last}");
}

/// Files made before ends resisted twisting less are read, and written with the same bytes, which their hash is of.
#[test]
fn calibrated_slices_of_before_are_the_same_text() {
    let before = r#"{"teeth":1.2,"ends":[0.5,0.4],"end_length_mm":0.4,"reach":{"twist_mm2":24.0,"bending_mm4":190.0},"bodies":1.1}"#;
    let read: SliceCompliance = serde_json::from_str(before).unwrap();
    assert_eq!(read.end_twist, None);
    assert_eq!(serde_json::to_string(&read).unwrap(), before);
}

/// The teeth of FZG type C are about 10 mm high and nearly as thick at the root: a deflection reaches as far along them as a fraction
/// of their height.
#[test]
fn val_reach_of_fzg_teeth() {
    let pair = pair(&fzg_c());
    let reach = Reach::of_pair(&pair, &steel());
    let height = pair.teeth.pinion.tip_radius_mm - pair.teeth.pinion.root_radius_mm;
    let (twist, bending) = (reach.twist_mm2.sqrt() / height, reach.bending_mm4.sqrt().sqrt() / height);
    // Even plate as high as the load: 0.71 and 0.53 of the load's height, which is about half the tooth's at mid-path.
    assert!((0.25..0.71).contains(&twist), "{twist}");
    assert!((0.2..0.53).contains(&bending), "{bending}");
}

/// A contact that rises steepest at its first touch, w = C s^{2/3}: a whole cell of a calibrated foundation at once.
struct Softening {
    touch_mm: f64,
}

/// C, N/mm^{5/3}: about that of FZG type C.
const RISE: f64 = 5e3;

impl PairContact for Softening {
    fn set_removed(&mut self, _: PerGear<&[f64]>) {}

    fn touch_mm(&self) -> f64 {
        self.touch_mm
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        if indentation_mm <= 0.0 {
            return Response::default();
        }
        let line_load_n_per_mm = RISE * indentation_mm.powf(2.0 / 3.0);
        Response { line_load_n_per_mm, stiffness_n_per_mm2: 2.0 / 3.0 * line_load_n_per_mm / indentation_mm }
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        2.0 * (line_load_n_per_mm / RISE).powf(1.5)
    }

    fn sweep(&self, _: Gear, _: PerGear<&[f64]>, _: &mut Sweep) {}

    fn contact_of_points(&self, _: Gear, _: PerGear<&[f64]>) -> Vec<PointContact> {
        Vec::new()
    }

    fn footprint(&self) -> Footprint {
        Footprint::default()
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        Vec::new()
    }
}

/// Slices that soften with their load balance on their tooth however far apart they touch: the last in contact is on the verge of
/// it for some. Residuals of the equations, with the deflections solved anew from the loads.
#[test]
fn ver_softening_slices_balance() {
    let (count, mm2_per_n) = (20, 5e-5);
    let coupling = SliceCoupling::new(Reach::of_pair(&pair(&fzg_c()), &steel()), count, 2.0);
    let cell = PositionCell { position_mm: 0.0, lower_mm: 0.0, upper_mm: 0.0 };
    let contacts: Vec<SliceContact> =
        (0..count).map(|slice| SliceContact { tooth: 0, slice, cell, part: ContactPart::WHOLE }).collect();
    for (load, tilts) in [(2e3, 100), (20.0, 30)] {
        for tilt_mm in (1..=tilts).map(|n| 4e-5 * f64::from(n)) {
            let touch_mm = |slice: usize| tilt_mm * slice as f64;
            let mut pairs: Vec<MeshedPair<'_>> = (0..count)
                .map(|slice| MeshedPair::new(Box::new(Softening { touch_mm: touch_mm(slice) }), f64::INFINITY))
                .collect();
            pairs.iter_mut().for_each(|pair| pair.set_removed(PerGear::default()));
            let teeth = BentTooth::of_contacts(&contacts, count, |_| mm2_per_n);
            let mut teeth = CoupledTeeth::Plates { teeth, coupling: coupling.clone() };
            let found =
                balance_on_teeth(&mut pairs, &mut teeth, load, 0.0).unwrap_or_else(|e| panic!("{tilt_mm}: {e}"));
            assert!(found.iterations < 30, "{tilt_mm}: {}", found.iterations);

            let loads: Vec<f64> = pairs.iter().map(|pair| pair.response.line_load_n_per_mm).collect();
            assert_close("load", loads.iter().sum(), load, 1e-10);
            // u = √q K⁻¹ √q w.
            let mut bent: Vec<f64> = loads.iter().map(|w| mm2_per_n * w).collect();
            let mut factors = Factors::default();
            coupling.factorise(&vec![0.0; count], &mut factors);
            factors.solve(&mut bent);
            for (slice, (w, u)) in loads.iter().zip(&bent).enumerate() {
                let indentation_mm = found.transmission_error_mm - touch_mm(slice) - u;
                let lacks_mm = (w / RISE).powf(1.5) - indentation_mm;
                let holds = if *w > 0.0 { lacks_mm.abs() < 1e-12 } else { indentation_mm < 1e-12 };
                assert!(holds, "{tilt_mm} {slice}: {w} {lacks_mm:e}");
            }
        }
    }
}
