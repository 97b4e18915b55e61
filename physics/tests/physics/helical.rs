//! Pairs with slices over the face width: geometry, lines of contact, equilibrium, wear.

use std::f64::consts::PI;

use gearwear_bodies::gear::{
    Gear, GearPair, PairError,
    conjugate::ConjugateFlanks,
    lines_of_contact::least_and_greatest_over_width,
    modification::{EndRelief, Modification, ReliefShape},
    removed_material::lead_removed_mm,
    slices::Slices,
    spec::PairSpec,
};
use gearwear_physics::mesh_cycle::{
    settings::{Coupling, SliceSettings},
    sliced_positions::{SliceContact, SliceEnds, sliced_positions},
};
use gearwear_physics::simulation::figures::WearFigures;
use gearwear_physics::simulation::wear_run::Outcome;
use gearwear_physics::stiffness::settings::StiffnessSettings;
use proptest::prelude::*;

use super::common::{Scene, assert_close, fzg_c, fzg_c_scene, fzg_c_with_helix, pair, preset};

fn slices(count: usize, coupling: Coupling) -> Option<SliceSettings> {
    Some(SliceSettings { count, coupling })
}

/// The preset `helical`, coarse, for one step; 302 N·m.
fn helical_scene(surface: &'static str, count: usize, coupling: Coupling) -> Scene {
    Scene {
        pair: preset("thesis-helical"),
        revolutions: 6e5,
        surface,
        stiffness: StiffnessSettings::WeberBanaschek,
        flank_points: 400,
        positions: 200,
        steps: 1.0,
        slices: slices(count, coupling),
        ..fzg_c_scene()
    }
}

/// The public FEUP pairs: full tip clearance kept (d_a = d + 2 m_n (1 + x − k), k = Σx − (a − a_d)/m_n, ISO 21771), profile shifts
/// of the normal module; overlap ratios from b sin β/(π m_n). H951 has its face width for an overlap of 1, and a transverse
/// contact ratio below 1.
#[test]
fn val_feup_pairs() {
    for (name, module, teeth, shifts, width) in [
        ("h501", 3.5, [20.0, 30.0], [0.1809, 0.0891], 23.0),
        ("h701", 2.5, [28.0, 42.0], [0.2290, 0.1489], 17.0),
        ("h951", 1.75, [38.0, 57.0], [1.6915, 2.0003], 21.2418),
    ] {
        let pair = pair(&preset(name));
        let beta = 15f64.to_radians();
        let reference = teeth.map(|z| module * z / beta.cos());
        let shortening = shifts[0] + shifts[1] - (91.5 - 0.5 * (reference[0] + reference[1])) / module;
        for (k, gear) in Gear::BOTH.into_iter().enumerate() {
            let tip = reference[k] + 2.0 * module * (1.0 + shifts[k] - shortening);
            assert_close(&format!("{name} {gear:?} tip diameter"), 2.0 * pair.teeth[gear].tip_radius_mm, tip, 1e-12);
            assert_close(&format!("{name} {gear:?} tip clearance"), pair.tip_clearance_mm[gear], 0.25 * module, 1e-9);
        }
        assert_close(&format!("{name} overlap"), pair.overlap_ratio(), width * beta.sin() / (PI * module), 1e-12);
        // Working pressure angle from the profile shifts: inv α_wt = inv α_t + 2 tan α_n Σx/Σz. The published shifts leave next to no
        // backlash at 91.5 mm, so both ways agree.
        let alpha_t = (20f64.to_radians().tan() / beta.cos()).atan();
        let inv = |a: f64| a.tan() - a;
        let from_shifts =
            inv(alpha_t) + 2.0 * 20f64.to_radians().tan() * (shifts[0] + shifts[1]) / (teeth[0] + teeth[1]);
        assert_close(&format!("{name} inv α_wt"), inv(pair.working_pressure_angle_rad), from_shifts, 2e-3);
    }
    assert_close("H951 overlap", pair(&preset("h951")).overlap_ratio(), 1.0, 1e-5);
    assert!(pair(&preset("h951")).path.contact_ratio() < 1.0);
}

/// Least total length of the lines of contact (AGMA 908-B89, with n_a, n_r the fractional parts of ε_α, ε_β and p_x = π m_n/sin β):
/// (ε_α b − n_a n_r p_x)/cos β_b where n_r ≤ 1 − n_a, else (ε_α b − (1 − n_a)(1 − n_r) p_x)/cos β_b.
fn least_length_mm(pair: &GearPair) -> f64 {
    let (alpha, beta) = (pair.path.contact_ratio(), pair.overlap_ratio());
    let (n_a, n_r) = (alpha.fract(), beta.fract());
    let axial_pitch = PI * pair.spec.normal_module_mm / pair.spec.helix_angle_rad.sin();
    let missing = if n_r <= 1.0 - n_a { n_a * n_r } else { (1.0 - n_a) * (1.0 - n_r) };
    (alpha * pair.spec.face_width_mm - missing * axial_pitch) / pair.base_helix_angle_rad().cos()
}

/// The stretches of every slice cover A–E without gap, so that all together have the length ε_α b / cos β_b of the lines of contact
/// to round-off; the least length at any phase is the closed form's, as far as slices tell.
#[test]
fn ver_lines_of_contact_have_their_length() {
    for name in ["helical", "h501", "h701", "h951"] {
        let pair = pair(&preset(name));
        let (path, cos) = (&pair.path, pair.base_helix_angle_rad().cos());
        for (count, positions) in [(1, 50), (7, 37), (20, 400), (50, 23)] {
            if path.contact_ratio() + pair.overlap_ratio() * (1.0 - 1.0 / count as f64) < 1.0 {
                continue;
            }
            let slices = Slices::new(&pair, count);
            let phases = sliced_positions(path, &slices, positions, SliceEnds::AtOnce);
            let cells = || phases.iter().flat_map(|phase| &phase.contacts);
            let stretch: f64 = cells().map(|contact| contact.cell.upper_mm - contact.cell.lower_mm).sum();
            let length = stretch * slices.slice_width_mm / path.base_pitch_mm / cos;
            let expected = path.contact_ratio() * pair.spec.face_width_mm / cos;
            assert_close(&format!("{name} {count} {positions}"), length, expected, 1e-12);

            for slice in 0..count {
                let mut own: Vec<_> = cells().filter(|contact| contact.slice == slice).map(|c| c.cell).collect();
                own.sort_by(|a, b| a.lower_mm.total_cmp(&b.lower_mm));
                assert!((own[0].lower_mm - path.start_mm).abs() < 1e-9);
                assert!((own[own.len() - 1].upper_mm - path.end_mm).abs() < 1e-9);
                assert!(own.windows(2).all(|two| (two[0].upper_mm - two[1].lower_mm).abs() < 1e-9), "{name} {slice}");
                assert!(own.iter().all(|cell| cell.lower_mm <= cell.upper_mm));
            }
            let spacing = path.base_pitch_mm / phases.len() as f64;
            assert!(spacing <= (path.end_mm - path.start_mm) / (positions - 1) as f64 * (1.0 + 1e-9));
        }
        let fine = Slices::new(&pair, 400);
        let phases = sliced_positions(path, &fine, 800, SliceEnds::AtOnce);
        let least = phases.iter().map(|phase| phase.contacts.len()).min().unwrap();
        let least_mm = least as f64 * fine.slice_width_mm / cos;
        // Every end of a line may cut one slice.
        let allowed = 4.0 * fine.slice_width_mm / cos;
        let closed_form = least_length_mm(&pair);
        assert!((least_mm - closed_form).abs() <= allowed, "{name}: {least_mm} {closed_form}");
    }
}

/// The parts of slices that the line of contact has entered have its length to round-off too, by load and by wear; and every place between A and
/// E is passed by the whole width of a slice, as far as positions tell f in place of its mean.
#[test]
fn ver_parts_of_slices_have_the_length_of_the_lines() {
    for name in ["helical", "h501", "h701", "h951"] {
        let pair = pair(&preset(name));
        let path = &pair.path;
        // With one slice the place of contact varies by more over its width than from A to E, so that it is folded at both.
        for (count, positions) in [(1, 400), (7, 100), (20, 400), (30, 600)] {
            let slices = Slices::new(&pair, count);
            let phases = sliced_positions(path, &slices, positions, SliceEnds::Gradual);
            let spacing = path.base_pitch_mm / phases.len() as f64;
            let contacts = || phases.iter().flat_map(|phase| &phase.contacts);
            let expected = (path.end_mm - path.start_mm) * count as f64;
            let loaded: f64 = contacts().map(|contact| contact.part.of_width * spacing).sum();
            let passage = |lower: f64, upper: f64, part: f64| part * (upper - lower);
            let worn: f64 = contacts().map(|c| passage(c.cell.lower_mm, c.cell.upper_mm, c.part.of_passage)).sum();
            assert_close(&format!("{name} {count} {positions}, load"), loaded, expected, 1e-9);
            assert_close(&format!("{name} {count} {positions}, wear"), worn, expected, 1e-9);
            let within = |at: f64| (path.start_mm - 1e-9..=path.end_mm + 1e-9).contains(&at);
            assert!(contacts().all(|c| within(c.cell.lower_mm) && within(c.cell.upper_mm)));
            assert!(contacts().all(|c| c.part.of_width > 0.0 && c.part.of_width <= 1.0));

            let allowed = spacing / slices.ahead_varies_mm;
            for k in 1..40 {
                let at = path.start_mm + (path.end_mm - path.start_mm) * f64::from(k) / 40.0;
                let covers = |c: &&SliceContact| c.slice == 0 && c.cell.lower_mm <= at && at < c.cell.upper_mm;
                let passed: f64 = contacts().filter(covers).map(|c| c.part.of_passage).sum();
                let near_end = (at - path.start_mm).min(path.end_mm - at) < spacing;
                assert!(near_end || (passed - 1.0).abs() <= allowed, "{name} {count} {positions} at {at}: {passed}");
            }
        }
    }
}

/// Greatest second difference of the transmission error over a base pitch, in parts of its peak to peak.
fn greatest_second_difference(scene: &Scene) -> f64 {
    let outcome = Scene { steps: 1.0, revolutions: 1.0, ..scene.clone() }.run();
    let errors = &outcome.new.cycle.slices.as_ref().unwrap().transmission_error_mm;
    let n = errors.len();
    let second = |k: usize| (errors[k] - 2.0 * errors[(k + 1) % n] + errors[(k + 2) % n]).abs();
    let (low, high) = errors.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), e| (low.min(*e), high.max(*e)));
    (0..n).map(second).fold(0.0, f64::max) / (high - low)
}

/// The transmission error has kinks where a line of contact comes to a corner of the flank, and no steps: its second differences fall with
/// the distance of positions, and fewer slices do not make them greater. As whole slices they were 0.07 (uncoupled) of the peak to peak
/// whatever the positions.
#[test]
fn ver_transmission_error_has_no_steps() {
    // Thin independent slices spread the kinks; coupled ones pass the whole load of a corner on within a few slices.
    for (coupling, greatest) in [(Coupling::None, 0.02), (Coupling::Slicing, 0.09)] {
        let at = |count, positions| {
            greatest_second_difference(&Scene { positions, ..helical_scene("hertz", count, coupling) })
        };
        let [coarse, fine, more_slices] = [at(20, 200), at(20, 400), at(40, 400)];
        assert!(fine <= 0.7 * coarse, "{coupling:?}: {coarse} {fine}");
        assert!(fine <= greatest, "{coupling:?}: {fine}");
        assert!((fine / more_slices - 1.0).abs() <= 0.05, "{coupling:?}: {fine} {more_slices}");
    }
}

/// Where no width is in contact at some position, the pair is refused; a transverse contact ratio below 1 alone is none.
#[test]
fn contact_everywhere_is_a_matter_of_both_ratios() {
    let narrow = PairSpec { face_width_mm: 1.0, ..preset("h951") };
    assert!(matches!(GearPair::new(&narrow), Err(PairError::ContactRatioBelowOne { .. })));
    assert!(GearPair::new(&PairSpec { face_width_mm: 2.0, ..preset("h951") }).is_ok());
}

/// Lead crowning C (2z/b − 1)², end relief over its length, helix slope from one end to the other.
#[test]
fn ver_modifications_over_the_width() {
    let at = |modification: &Modification, z: f64| lead_removed_mm(modification, 20.0, z);
    let crowned = Modification { lead_crowning_mm: 0.01, ..Modification::default() };
    for (z, expected) in [(0.0, 0.01), (5.0, 0.0025), (10.0, 0.0), (20.0, 0.01)] {
        assert!((at(&crowned, z) - expected).abs() < 1e-15);
    }
    let end = EndRelief { amount_mm: 0.02, length_mm: 4.0, shape: ReliefShape::Parabolic };
    let relieved = Modification { end_relief: Some(end), ..Modification::default() };
    for (z, expected) in [(0.0, 0.02), (2.0, 0.005), (4.0, 0.0), (10.0, 0.0), (18.0, 0.005), (20.0, 0.02)] {
        assert!((at(&relieved, z) - expected).abs() < 1e-15);
    }
    for (slope, first, last) in [(0.008, 0.0, 0.008), (-0.008, 0.008, 0.0)] {
        let skew = Modification { helix_slope_mm: slope, ..Modification::default() };
        assert!((at(&skew, 0.0) - first).abs() < 1e-15 && (at(&skew, 20.0) - last).abs() < 1e-15);
    }
}

/// ∫ w v_s dt of one slice over the first mesh, by the loads that were observed.
fn sliding_work(pair: &GearPair, outcome: &Outcome, positions: usize, ends: SliceEnds, slice: usize) -> f64 {
    let mesh = outcome.new.cycle.slices.as_ref().unwrap();
    let spacing = mesh.base_pitch_mm / mesh.transmission_error_mm.len() as f64;
    sliced_positions(&pair.path, &outcome.slices, positions, ends)
        .iter()
        .flat_map(|phase| phase.contacts.iter().map(move |contact| (phase.position_mm, contact)))
        .filter(|(_, contact)| contact.slice == slice)
        .map(|(phase_mm, contact)| {
            let at = phase_mm + f64::from(contact.tooth) * mesh.base_pitch_mm;
            let row = ((at - mesh.position_mm[0]) / spacing).round() as usize;
            let load = mesh.line_load_n_per_mm[row * mesh.slices + slice];
            // Of the part in contact, in parts of the slice.
            let passing = load * contact.part.of_passage / contact.part.of_width;
            passing * pair.sliding_mm(contact.cell.lower_mm, contact.cell.upper_mm)
        })
        .sum()
}

/// The flank integral of every slice's first wear is k ∫ w v_s dt of its own loads, on both gears; all loads together are the torque.
#[test]
fn val_exact_wear_of_every_slice() {
    for surface in ["winkler", "hertz", "half-space"] {
        for coupling in [Coupling::None, Coupling::Slicing] {
            let scene = Scene { flank_points: 750, positions: 400, ..helical_scene(surface, 6, coupling) };
            let outcome = scene.run();
            let pair = pair(&scene.pair);
            let mesh = outcome.new.cycle.slices.as_ref().unwrap();
            assert!(mesh.load_imbalance <= 1e-10, "{surface} {coupling:?}: {:.1e}", mesh.load_imbalance);
            let worn = outcome.worn.cycle.slices.as_ref().unwrap();
            assert!(worn.load_imbalance <= 1e-10, "{surface} {coupling:?}: {:.1e}", worn.load_imbalance);
            for gear in Gear::BOTH {
                let grid = &outcome.grid[gear];
                for (slice, depth) in outcome.new.depth_per_mesh_mm[gear].chunks_exact(grid.len()).enumerate() {
                    let expected = 1e-11 * sliding_work(&pair, &outcome, scene.positions, SliceEnds::Gradual, slice);
                    let what = format!("{surface} {coupling:?} {gear:?} slice {slice}");
                    assert_close(&what, grid.integral(depth), expected, 1e-3);
                }
            }
        }
    }
}

/// With a vanishing helix angle every slice is the spur pair: load sharing, transmission error, wear.
#[test]
fn val_without_helix_it_is_the_spur_pair() {
    for surface in ["winkler", "hertz"] {
        for coupling in [Coupling::None, Coupling::Slicing] {
            let spur = Scene {
                steps: 4.0,
                stiffness: StiffnessSettings::WeberBanaschek,
                surface,
                positions: 400,
                flank_points: 400,
                ..fzg_c_scene()
            };
            let pair_spec = PairSpec { helix_angle_rad: 1e-6, ..fzg_c() };
            let helical = Scene { pair: pair_spec, slices: slices(5, coupling), ..spur.clone() };
            let (spur, helical) = (spur.run(), helical.run());
            let spec = pair(&fzg_c());
            for gear in Gear::BOTH {
                let a = WearFigures::at(&spec, gear, &spur, &spur.worn);
                for slice in WearFigures::at(&spec, gear, &helical, &helical.worn).slices {
                    assert_close(&format!("{surface} {coupling:?} {gear:?} area"), slice.area_mm2, a.area_mm2, 1e-3);
                    assert_close(&format!("{surface} {coupling:?} {gear:?} root"), slice.root_mm, a.root_mm, 5e-3);
                }
            }
            let (a, b) = (spur.new.cycle.transmission_error_mm(), helical.new.cycle.transmission_error_mm());
            // Slices enter and leave one after the other by less than round-off tells; rows lie between phases.
            assert_close(&format!("{surface} {coupling:?} least transmission error"), b.0, a.0, 2e-3);
            assert_close(&format!("{surface} {coupling:?} greatest transmission error"), b.1, a.1, 2e-3);
        }
    }
}

/// Where slices come one after the other between two phases, the row at A is no jump: half a degree of helix, against 2000 positions.
#[test]
fn val_slices_that_come_one_by_one_are_no_jump() {
    let pair_spec = PairSpec { helix_angle_rad: 0.5_f64.to_radians(), ..fzg_c() };
    let scene =
        Scene { pair: pair_spec, steps: 1.0, surface: "hertz", slices: slices(7, Coupling::None), ..fzg_c_scene() };
    let at_a = [60, 200, 2000].map(|positions| {
        Scene { positions, flank_points: 100, ..scene.clone() }.run().new.cycle.positions[0].load_share
    });
    println!("{at_a:?}");
    assert!((at_a[0] - at_a[2]).abs() < 0.1 && (at_a[1] - at_a[2]).abs() < 0.05, "{at_a:?}");
}

/// Where all slices of a tooth come and go at once the rows show the jump as sharp as the pair without slices has it, at A and E and between. A row beside a
/// jump is level with the phase next to it.
#[test]
fn val_slices_that_come_at_once_jump_as_the_spur_pair() {
    let spur = Scene { steps: 1.0, surface: "hertz", positions: 100, flank_points: 400, ..fzg_c_scene() };
    let sliced = Scene { slices: slices(3, Coupling::None), ..spur.clone() };
    let rows = [spur, sliced].map(|scene| scene.run().new.cycle.positions);
    assert_eq!(rows[0].len(), rows[1].len());
    let [first, last] = [rows[0][0].load_share, rows[0][99].load_share];
    // FZG type C on springs of one stiffness: half of the load, but for other radii.
    assert!((0.4..0.6).contains(&first) && (0.4..0.6).contains(&last), "{first} {last}");
    for (a, b) in rows[0].iter().zip(&rows[1]) {
        let at = format!("{:.3} mm", a.position_mm);
        assert!((a.load_share - b.load_share).abs() < 5e-3, "{at}: {} {}", a.load_share, b.load_share);
        let errors = [a, b].map(|row| row.transmission_error_mm);
        assert_close(&format!("{at} transmission error"), errors[1], errors[0], 5e-3);
    }
}

/// Slices that come into contact by first touch stand where their tooth is, also in the first and the last stretch: half of one deeper, a tip edge would carry
/// what it has not come to yet.
#[test]
fn ver_slices_by_first_touch_stand_where_their_tooth_is() {
    let pair = pair(&preset("thesis-helical"));
    let slices = Slices::new(&pair, 3);
    let (pitch, mut contacts) = (pair.path.base_pitch_mm, 0);
    for phase in sliced_positions(&pair.path, &slices, 24, SliceEnds::Beyond([1.1, 1.3])) {
        for SliceContact { tooth, slice, cell, .. } in phase.contacts {
            let at_mm = phase.position_mm + f64::from(tooth) * pitch + slices.ahead_mm[slice];
            assert!((cell.position_mm - at_mm).abs() < 1e-12 * pitch, "{tooth} {slice}");
            assert!(cell.lower_mm <= at_mm && at_mm <= cell.upper_mm, "{tooth} {slice}");
            contacts += 1;
        }
    }
    assert!(contacts > 40, "{contacts}");
}

/// A negative helix angle is the mirror image: the last slice enters first.
#[test]
fn val_negative_helix_mirrors_the_width() {
    let right = helical_scene("hertz", 6, Coupling::Slicing);
    let helix_angle_rad = -right.pair.helix_angle_rad;
    let left = Scene { pair: PairSpec { helix_angle_rad, ..right.pair.clone() }, ..right.clone() };
    let (right, left) = (right.run(), left.run());
    for gear in Gear::BOTH {
        let points = right.grid[gear].len();
        let peak = right.new.depth_per_mesh_mm[gear].iter().copied().fold(0.0, f64::max);
        for slice in 0..6 {
            let a = &right.new.depth_per_mesh_mm[gear][slice * points..(slice + 1) * points];
            let b = &left.new.depth_per_mesh_mm[gear][(5 - slice) * points..(6 - slice) * points];
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-7 * peak), "{gear:?} {slice}");
        }
    }
}

/// The same bits on one thread and on two.
#[test]
fn ver_threads_do_not_change_a_bit() {
    let scene = helical_scene("winkler", 5, Coupling::Slicing);
    let on =
        |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| scene.run());
    let (one, two) = (on(1), on(2));
    for gear in Gear::BOTH {
        let bits = |outcome: &Outcome| outcome.worn.wear_mm[gear].iter().map(|h| h.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&one), bits(&two));
    }
    assert_eq!(one.worn.cycle, two.worn.cycle);
}

/// Misalignment of a spur pair: with teeth so soft that flattening does not count, the load grows linearly over the width,
/// K_Hβ = 1 + c f/(2 w_m) (ISO 6336-1, 7.2, where the whole width carries), with c the stiffness of all pairs in mesh; the mean over the mesh has
/// ε_α pairs. Slices tell it at their middles, (1 − 1/n) of the way out.
#[test]
fn val_face_load_factor_of_a_misaligned_spur_pair() {
    let (stiffness, slope_mm, count) = (200.0, 0.4, 20);
    let mut spec = fzg_c();
    spec.gears.pinion.modification.helix_slope_mm = slope_mm;
    let scene = |coupling| Scene {
        pair: spec.clone(),
        surface: "hertz",
        stiffness: StiffnessSettings::Constant { pair_n_per_mm2: stiffness },
        slices: slices(count, coupling),
        steps: 1.0,
        positions: 400,
        flank_points: 100,
        ..fzg_c_scene()
    };
    let factor = |scene: &Scene| scene.run().new.cycle.slices.unwrap().face_load_factor();
    let uncoupled = scene(Coupling::None);
    let pair = pair(&spec);
    let outwards = 1.0 - 1.0 / count as f64;
    let expected = 1.0 + outwards * pair.path.contact_ratio() * stiffness * slope_mm / (2.0 * uncoupled.line_load());
    assert_close("K_Hβ", factor(&uncoupled), expected, 5e-3);
    // A tooth that holds its slices together resists the twist that the misalignment asks of it: its ends carry more.
    let coupled = factor(&scene(Coupling::Slicing));
    assert!(coupled > factor(&uncoupled), "{coupled}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any helix, width, load and modification over the width: the loads balance, none pulls, and nothing but wear comes out.
    #[test]
    fn prop_slices_find_their_equilibrium(
        degrees in -45.0..45.0_f64,
        width_mm in 2.0..60.0_f64,
        log_torque in 0.0..7.0_f64,
        crowning_um in 0.0..300.0_f64,
        slope_um in -300.0..300.0_f64,
        count in 1_usize..25,
        coupled in any::<bool>(),
        surface in prop::sample::select(vec!["hertz", "winkler", "hertz-mean"]),
    ) {
        let mut spec = fzg_c_with_helix(degrees, width_mm);
        spec.gears.pinion.modification.lead_crowning_mm = 1e-3 * crowning_um;
        spec.gears.wheel.modification.helix_slope_mm = 1e-3 * slope_um;
        let scene = Scene {
            pair: spec,
            torque_n_mm: 10f64.powf(log_torque),
            surface,
            revolutions: 10.0,
            flank_points: 60,
            positions: 25,
            steps: 2.0,
            slices: slices(count, if coupled { Coupling::Slicing } else { Coupling::None }),
            ..helical_scene("hertz", 1, Coupling::None)
        };
        let outcome = scene.run();
        prop_assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
        for snapshot in [&outcome.new, &outcome.worn] {
            let mesh = snapshot.cycle.slices.as_ref().unwrap();
            prop_assert!(mesh.load_imbalance <= 1e-10, "{:.1e}", mesh.load_imbalance);
            prop_assert!(mesh.line_load_n_per_mm.iter().all(|load| *load >= 0.0 && load.is_finite()));
            prop_assert!(mesh.transmission_error_mm.iter().all(|error| error.is_finite()));
            for gear in Gear::BOTH {
                prop_assert!(snapshot.wear_mm[gear].iter().all(|wear| *wear >= 0.0 && wear.is_finite()));
            }
        }
    }
}

/// Sum of the lengths of all lines within a rectangle of `contact_ratio` pitches by the face width, at `phase` (in pitches), in face widths.
fn clipped_lines(contact_ratio: f64, overlap_ratio: f64, phase: f64) -> f64 {
    let reach = (contact_ratio + overlap_ratio).ceil() as i32 + 1;
    (-reach..=reach)
        .map(|line| {
            // The line is at `at` in the section z = 0 and at `at + overlap_ratio` in z = b.
            let at = phase + f64::from(line);
            let (from, to) = ((-at / overlap_ratio).max(0.0), ((contact_ratio - at) / overlap_ratio).min(1.0));
            (to - from).max(0.0)
        })
        .sum()
}

proptest! {
    /// Clipping every line at many phases, and where one enters or leaves, which is where the sum has its extremes, finds the closed form.
    #[test]
    fn prop_lengths_of_lines_of_contact_are_those_of_lines_clipped_one_by_one(
        contact_ratio in 1.0..3.2_f64,
        overlap_ratio in 0.01..4.3_f64,
    ) {
        let kinks = [0.0, contact_ratio, -overlap_ratio, contact_ratio - overlap_ratio];
        let phases = (0..200).map(|k| f64::from(k) / 200.0).chain(kinks);
        let lengths: Vec<f64> = phases.map(|phase| clipped_lines(contact_ratio, overlap_ratio, phase)).collect();
        let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = lengths.iter().copied().fold(0.0, f64::max);
        let mean = lengths[..200].iter().sum::<f64>() / 200.0;
        let [low, high] = least_and_greatest_over_width(contact_ratio, overlap_ratio);
        prop_assert!((low - least).abs() < 1e-9, "{low} {least}");
        prop_assert!((high - greatest).abs() < 1e-9, "{high} {greatest}");
        prop_assert!((contact_ratio - mean).abs() < 1e-2);
    }
}

/// Whole ratios leave nothing that changes; spur gears change by a whole line.
#[test]
fn ver_lines_of_contact_of_whole_ratios_have_the_mean_always() {
    for (found, expected) in [
        (least_and_greatest_over_width(1.6, 2.0), 1.6),
        (least_and_greatest_over_width(2.0, 0.7), 2.0),
        (least_and_greatest_over_width(1.3, 1.0), 1.3),
    ] {
        found.iter().for_each(|length| assert!((length - expected).abs() < 1e-9, "{found:?}"));
    }
    assert_eq!(least_and_greatest_over_width(1.6, 0.0), [1.0, 2.0]);
    assert_eq!(least_and_greatest_over_width(2.0, 0.0), [2.0, 2.0]);
}
