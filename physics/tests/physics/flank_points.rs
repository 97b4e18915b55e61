//! Where flank points lie.

use gearwear_bodies::gear::{
    Gear, GearPair, PerGear,
    flank::{FlankGrid, PointSpacing},
    flank_zones::FlankZones,
    modification::{Modification, Relief, ReliefShape},
    removed_material::{modifications_mm, without_tip_edge_mm},
    slices::Slices,
    spec::PairSpec,
};
use gearwear_physics::contact::{
    ContactSurface, Flanks, PositionCell, Sweep,
    winkler::{Winkler, WinklerFoundation},
};

use super::common::{fzg_c, gear, pair, spur};

fn rounded(tip_rounding_mm: f64) -> GearPair {
    let gears = fzg_c().gears.map(|mut gear| {
        gear.modification.tip_rounding_mm = tip_rounding_mm;
        gear
    });
    pair(&PairSpec { gears, ..fzg_c() })
}

fn rack_of_10000_teeth() -> GearPair {
    pair(&spur(2.0, 10018.0, 10.0, gear(18, 0.0, None), gear(10000, 0.0, None)))
}

fn grids(pair: &GearPair, gear: Gear, count: usize) -> [FlankGrid; 2] {
    [PointSpacing::Even, PointSpacing::Graded].map(|spacing| FlankGrid::new(pair, gear, count, spacing))
}

/// The angle of a kink is the slope of what is removed along the flank on one side, which is none on the other, to the first order in the distance; a parabolic relief has none.
#[test]
fn ver_kinks_are_where_the_removed_material_turns() {
    let relieved = |shape| {
        let gears = fzg_c().gears.map(|mut gear| {
            let relief = |amount_mm, length_mm| Some(Relief { amount_mm, length_mm, shape });
            let (tip_relief, root_relief) = (relief(0.02, 2.0), relief(0.012, 1.5));
            gear.modification = Modification { tip_relief, root_relief, ..gear.modification };
            gear
        });
        pair(&PairSpec { gears, ..fzg_c() })
    };
    let [linear, parabolic] = [ReliefShape::Linear, ReliefShape::Parabolic].map(relieved);
    for gear in Gear::BOTH {
        assert_eq!((linear.kinks(gear).count(), parabolic.kinks(gear).count()), (2, 0));
        for kink in linear.kinks(gear) {
            let involute = linear.path.involute[gear];
            let slopes = [-1e-3, 1e-3].map(|beside_mm| {
                let removed_mm = without_tip_edge_mm(&linear, gear, 0.0, kink.rho_mm + beside_mm);
                let along_mm = involute.arc_mm(kink.rho_mm + beside_mm) - involute.arc_mm(kink.rho_mm);
                (removed_mm / along_mm).abs()
            });
            assert!(slopes.into_iter().fold(f64::INFINITY, f64::min) < 1e-12, "{slopes:?}");
            let found = slopes.into_iter().fold(0.0, f64::max);
            assert!((kink.angle_rad / found - 1.0).abs() < 1e-3, "{kink:?} {found}");
        }
    }
}

/// Both spacings lead from the base circle to the tip circle with as many points, rising, and ∫ ds is the flank's length.
#[test]
fn ver_graded_points_cover_the_same_flank() {
    for pair in [rounded(0.1), rounded(0.0), rack_of_10000_teeth()] {
        for gear in Gear::BOTH {
            for count in [20, 101, 750, 3000] {
                let [even, graded] = grids(&pair, gear, count);
                assert_eq!(graded.len(), count + 1);
                assert!(graded.arc_mm.windows(2).all(|two| two[1] > two[0]), "{gear:?} {count}");
                assert!(graded.coordinate_mm[0] == 0.0);
                let (last, tip) = (graded.coordinate_mm[count], pair.teeth[gear].tip_rho_mm());
                assert!((last / tip - 1.0).abs() < 1e-14);
                let ones = vec![1.0; count + 1];
                let lengths = [&even, &graded].map(|grid| grid.integral(&ones));
                assert!((lengths[1] / lengths[0] - 1.0).abs() < 1e-12, "{lengths:?}");
            }
        }
    }
}

/// Twenty-four intervals on a rounding of a tenth of a millimetre where 750 even ones leave it nine or ten; half as many points are twice as
/// far apart there; and neighbouring distances differ by a tenth.
#[test]
fn ver_points_crowd_on_tip_roundings() {
    let pair = rounded(0.1);
    for gear in Gear::BOTH {
        let tooth = &pair.teeth[gear];
        let begins = tooth.involute.arc_mm(tooth.tip_rho_mm()) - tooth.tip_rounding_length_mm(0.1);
        let within = |grid: &FlankGrid| grid.arc_mm.iter().filter(|arc| **arc > begins).count();
        let [even, graded] = grids(&pair, gear, 750);
        let [_, coarse] = grids(&pair, gear, 375);
        assert!(within(&graded) >= 20, "{}", within(&graded));
        assert!(2 * within(&even) < within(&graded), "{} {}", within(&even), within(&graded));
        assert!(within(&graded).abs_diff(2 * within(&coarse)) <= 2);
        let distances: Vec<f64> = graded.arc_mm.windows(2).map(|two| two[1] - two[0]).collect();
        assert!(distances.windows(2).all(|two| (two[1] / two[0]).ln().abs() < 0.13));
    }
}

/// A tooth whose base circle is six hundred millimetres below it, of four millimetres' height, has most of its points on it; evenly in
/// radius it has five.
#[test]
fn ver_a_rack_has_its_points_on_its_teeth() {
    let pair = rack_of_10000_teeth();
    let start = pair.active_start_rho_mm(Gear::Wheel);
    let on_tooth =
        grids(&pair, Gear::Wheel, 750).map(|grid| grid.coordinate_mm.iter().filter(|rho| **rho >= start).count());
    assert!(on_tooth[0] <= 8 && on_tooth[1] > 450, "{on_tooth:?}");
}

/// Where a relief begins, points are three times as close as far from it, by 1/h_f and 1/h_0; at the start of active profile too.
#[test]
fn ver_points_crowd_where_reliefs_begin() {
    let relief = Relief { amount_mm: 0.01, length_mm: 2.0, shape: ReliefShape::Linear };
    let modification = Modification { tip_relief: Some(relief), root_relief: Some(relief), ..Modification::default() };
    let gears = fzg_c().gears.map(|mut gear| {
        gear.modification = modification;
        gear
    });
    let pair = pair(&PairSpec { gears, ..fzg_c() });
    for gear in Gear::BOTH {
        let [even, graded] = grids(&pair, gear, 3000);
        let (start, tip) = (pair.active_start_rho_mm(gear), pair.teeth[gear].tip_rho_mm());
        let far = graded.distance_at_mm(0.5 * (start + 2.0 + tip - 2.0) + 0.2);
        for kink in [tip - 2.0, start + 2.0, start] {
            assert!((graded.distance_at_mm(kink) / far - 1.0 / 3.0).abs() < 0.05, "{gear:?} {kink}");
            // Evenly in radius, points know nothing of it.
            assert!((even.distance_at_mm(kink - 0.05) / even.distance_at_mm(kink + 0.05) - 1.0).abs() < 0.05);
        }
    }
}

/// The tip-edge zone reaches three Hertz half-widths from where the rounding begins, 0.15 modules at most, by length of the flank.
#[test]
fn ver_the_tip_edge_zone_is_as_long_as_it_is_said_to_be() {
    let pair = rounded(0.1);
    for gear in Gear::BOTH {
        let tooth = &pair.teeth[gear];
        let arc_mm = |radius_mm: f64| tooth.involute.arc_mm(tooth.involute.curvature_radius_mm(radius_mm));
        let begins_mm = arc_mm(tooth.tip_radius_mm) - tooth.tip_rounding_length_mm(0.1);
        for (half_width_mm, length_mm) in [(0.1, 0.3), (0.3, 0.15 * 4.5)] {
            let zones = FlankZones::new(&pair, gear, half_width_mm);
            assert!(
                (begins_mm - arc_mm(zones.tip_edge_radius_mm) - length_mm).abs() < 1e-9,
                "{gear:?} {half_width_mm}"
            );
        }
    }
}

/// What a pair on springs carries at an approach is a matter of its flanks alone, not of the load that its window is cut for, also where the kink of a
/// relief lies between samples: cells of a window of another length missed it by 10 % of the approach, and a greater torque could press the gears less.
#[test]
fn ver_load_at_a_kink_does_not_depend_on_the_window() {
    let mut spec = fzg_c();
    let relief = Relief { amount_mm: 0.03, length_mm: 1.1, shape: ReliefShape::Linear };
    spec.gears.wheel.modification.tip_relief = Some(relief);
    let pair = pair(&spec);
    let grid = PerGear::from_fn(|gear| FlankGrid::new(&pair, gear, 77, PointSpacing::Even));
    let modification_mm = PerGear::from_fn(|gear| modifications_mm(&pair, gear, &grid[gear], &Slices::new(&pair, 1)));
    let removed_mm = modification_mm.as_ref().map(Vec::as_slice);
    let flanks = Flanks { modification_mm: Some(removed_mm), ..Flanks::of_gears(&pair, grid.as_ref()) };
    // 3 µm of approach: some 150 N/mm.
    let load_at = |position_mm: f64, expected_line_load_n_per_mm: f64| {
        let foundation = WinklerFoundation::Uniform { mpa_per_mm: 3e5 };
        let mut contact = Winkler { foundation, expected_line_load_n_per_mm }.pair(flanks, position_mm, None);
        contact.set_removed(removed_mm);
        contact.load_at(3e-3 - contact.touch_mm()).line_load_n_per_mm
    };
    let (mut worst, mut least, mut greatest) = (0.0_f64, f64::INFINITY, 0.0_f64);
    for position_mm in pair.path.evenly_mm(400) {
        let loads = [200.0, 230.0, 260.0, 300.0].map(|expected| load_at(position_mm, expected));
        let [low, high] = [f64::min, f64::max].map(|of| loads.into_iter().reduce(of).unwrap());
        (least, greatest) = (least.min(low), greatest.max(high));
        worst = worst.max((high - low) / 150.0);
    }
    println!("{worst:.1e} of loads from {least:.1} to {greatest:.1} N/mm");
    assert!(greatest > 120.0 && least < 1.0, "{least} {greatest}");
    assert!(worst < 3e-3, "{worst}");
}

/// Once a window is long enough, a longer one changes nothing, whatever the flanks have lost: neither the load nor the pressure of any point, also far before A, where
/// flanks are as curved as the contact is wide. Windows grow with what a run has been through, and two halves of it have not been through the same.
#[test]
fn ver_longer_windows_change_nothing() {
    let small = spur(1.037, 33.2, 5.8, gear(13, 0.0, None), gear(51, -0.03309, None));
    for (spec, mpa_per_mm, greatest_mm) in [(fzg_c(), 3e5, 6e-3), (small, 5e4, 4.3e-3)] {
        for worn in [0.0, 1.0] {
            // Also where a contact ends at a sample.
            let approaches_mm = (50..=100).map(|k| 0.01 * f64::from(k) * greatest_mm);
            let of_each =
                approaches_mm.map(|approach_mm| of_longer_windows(&pair(&spec), worn, mpa_per_mm, approach_mm));
            let (worst, loaded) = of_each.fold((0.0, 0), |(worst, all), (one, loaded)| (one.max(worst), all + loaded));
            assert!(worst < 1e-9 && loaded > 500, "{worst} of {loaded} contacts");
        }
    }
}

/// Greatest relative difference of load and of pressure at a point between windows that are longer and longer, and how many contacts carried load.
fn of_longer_windows(pair: &GearPair, worn: f64, mpa_per_mm: f64, approach_mm: f64) -> (f64, u32) {
    let grid = PerGear::from_fn(|gear| FlankGrid::new(pair, gear, 150, PointSpacing::Graded));
    let flanks = Flanks::of_gears(pair, grid.as_ref());
    let worn_mm = PerGear::from_fn(|gear| {
        let depth_mm =
            |(k, rho): (usize, &f64)| worn * (1e-3 * (1.0 + (7.0 * rho).sin()) + 3e-4 * ((k * k) % 7) as f64);
        grid[gear].coordinate_mm.iter().enumerate().map(depth_mm).collect::<Vec<f64>>()
    });
    let removed_mm = worn_mm.as_ref().map(Vec::as_slice);
    let surface = Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm }, expected_line_load_n_per_mm: 150.0 };
    let (path, mut worst, mut loaded) = (&pair.path, 0.0_f64, 0);
    let first_mm = path.start_mm - 0.2 * path.base_pitch_mm;
    for k in 0..=40 {
        let position_mm = first_mm + (path.end_mm - first_mm) * f64::from(k) / 40.0;
        let cell = PositionCell { position_mm, lower_mm: position_mm - 0.1, upper_mm: position_mm + 0.1 };
        let mut contact = surface.pair(flanks, position_mm, Some(cell));
        let mut of_windows = Vec::new();
        for _ in 0..15 {
            contact.set_removed(removed_mm);
            let load = contact.load_at(approach_mm - contact.touch_mm()).line_load_n_per_mm;
            if contact.window_suffices(removed_mm) {
                let pressures_mpa = Gear::BOTH.map(|gear| {
                    let (mut sweep, mut all) = (Sweep::default(), vec![0.0; grid[gear].len()]);
                    contact.sweep(gear, removed_mm, &mut sweep);
                    all[sweep.first_point..][..sweep.pressure_mpa.len()].copy_from_slice(&sweep.pressure_mpa);
                    all
                });
                of_windows.push((load, pressures_mpa));
            }
            if of_windows.len() == 3 {
                break;
            }
            contact.widen();
        }
        let ((load, pressures_mpa), longer) = of_windows.split_first().expect("some window suffices");
        loaded += u32::from(*load > 1.0);
        for (longer_load, longer_pressures_mpa) in longer {
            worst = worst.max((longer_load - load).abs() / load.max(1.0));
            let points = pressures_mpa.iter().flatten().zip(longer_pressures_mpa.iter().flatten());
            worst = points.map(|(a, b)| (a - b).abs() / a.max(1.0)).fold(worst, f64::max);
        }
    }
    (worst, loaded)
}
