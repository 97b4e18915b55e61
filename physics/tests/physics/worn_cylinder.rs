//! A cylinder that a flat wears, from Hertz's contact to the late stage: the program's own surfaces against the closed form.

use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid, involute::TangentFramePoint};
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_bodies::reference::worn_cylinder::WornCylinder;
use gearwear_physics::contact::{
    ContactSurface, Flanks, PositionCell,
    foundation::matched_mpa_per_mm,
    half_space::HalfSpace,
    hertz,
    settings::MatchCriterion,
    winkler::{Winkler, WinklerFoundation},
};
use gearwear_physics::mesh_cycle::{LineOfActionCycle, LoadingPosition, MeshCycle, PairInMesh};
use gearwear_physics::wear::{WearModel, settings::WearSettings};

use super::common::{assert_close, steel};

/// A cylinder (the pinion) in the middle of a flat (the wheel) that slides; positions are sliding distances around 0, and what the
/// contact moves meanwhile on either surface is far less than the distance of points.
struct CylinderOnFlat;

const RADIUS_MM: PerGear<f64> = PerGear { pinion: 20.0, wheel: 1e9 };
const MIDDLE_MM: f64 = 2.5;
/// Of the contact over either surface, per sliding distance.
const SPEED: f64 = 1e-3;
/// Sliding distance of one evaluation.
const CELL_MM: f64 = 1e-3;

impl ConjugateFlanks for CylinderOnFlat {
    fn contact_coordinate_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        match gear {
            Gear::Pinion => MIDDLE_MM + SPEED * position_mm,
            Gear::Wheel => MIDDLE_MM - SPEED * position_mm,
        }
    }

    fn position_at_mm(&self, gear: Gear, coordinate_mm: f64) -> f64 {
        match gear {
            Gear::Pinion => (coordinate_mm - MIDDLE_MM) / SPEED,
            Gear::Wheel => (MIDDLE_MM - coordinate_mm) / SPEED,
        }
    }

    fn in_tangent_frame(&self, gear: Gear, coordinate_mm: f64, position_mm: f64) -> TangentFramePoint {
        let radius = RADIUS_MM[gear];
        let angle = (coordinate_mm - self.contact_coordinate_mm(gear, position_mm)) / radius;
        TangentFramePoint { along_mm: radius * angle.sin(), drop_mm: 2.0 * radius * (0.5 * angle).sin().powi(2) }
    }

    fn at_along(&self, gear: Gear, along_mm: f64, position_mm: f64) -> (f64, f64) {
        let radius = RADIUS_MM[gear];
        let angle = (along_mm / radius).asin();
        let coordinate = self.contact_coordinate_mm(gear, position_mm) + radius * angle;
        (coordinate, 2.0 * radius * (0.5 * angle).sin().powi(2))
    }

    fn flank_limits_mm(&self, _gear: Gear) -> (f64, f64) {
        (0.0, 2.0 * MIDDLE_MM)
    }

    fn curvature_radius_mm(&self, gear: Gear, _position_mm: f64) -> f64 {
        RADIUS_MM[gear]
    }

    fn rolling_ratio(&self, _gear: Gear, _position_mm: f64) -> f64 {
        SPEED
    }

    fn sliding_mm(&self, from_mm: f64, to_mm: f64) -> f64 {
        to_mm - from_mm
    }

    fn depth_mm(&self, _gear: Gear, _position_mm: f64) -> f64 {
        5.0
    }
}

const CYLINDER: WornCylinder =
    WornCylinder { radius_mm: RADIUS_MM.pinion, line_load_n_per_mm: 100.0, coefficient_mm2_per_n: 1e-11 };

/// A stage of the wear.
struct Stage {
    sliding_mm: f64,
    half_width_mm: f64,
    worn_area_mm2: f64,
    middle_mpa: f64,
}

/// Wears the cylinder alone by Euler's method until the half-width is `until` times the unworn one, `unworn_mm`; stages are those
/// after each hundredth of the steps. `stiffness` is what a short wave meets, MPa/mm: it bounds the step.
fn wear(
    surface: &dyn ContactSurface,
    unworn_mm: f64,
    until: f64,
    points_per_half_width: f64,
    stiffness_mpa_per_mm: f64,
) -> Vec<Stage> {
    let load = CYLINDER.line_load_n_per_mm;
    let spacing = unworn_mm / points_per_half_width;
    let count = (2.0 * MIDDLE_MM / spacing) as usize;
    let arcs: Vec<f64> = (0..=count).map(|i| 2.0 * MIDDLE_MM * i as f64 / count as f64).collect();
    let grid = FlankGrid { coordinate_mm: arcs.clone(), arc_mm: arcs };
    let flanks = Flanks::new(&CylinderOnFlat, PerGear { pinion: &grid, wheel: &grid });
    let positions = [LoadingPosition {
        cell: PositionCell { position_mm: 0.0, lower_mm: -0.5 * CELL_MM, upper_mm: 0.5 * CELL_MM },
        pairs: vec![PairInMesh { position_mm: 0.0, teeth_n_per_mm2: 20e3, lever_ratio: 1.0 }],
        on_line_of_action: true,
    }];
    let mut cycle = LineOfActionCycle::new(flanks, surface, &positions, load);
    let law = gearwear_physics::wear::of(&WearSettings::archard(CYLINDER.coefficient_mm2_per_n));
    let zeros = vec![0.0; grid.len()];
    let mut worn = zeros.clone();
    let mut depth = PerGear { pinion: zeros.clone(), wheel: zeros.clone() };

    let whole = (until * unworn_mm).powi(3) / (1.5 * CYLINDER.radius_mm * load * CYLINDER.coefficient_mm2_per_n);
    // Half of Euler's bound, Δs k K < 2.
    let steps = (whole * CYLINDER.coefficient_mm2_per_n * stiffness_mpa_per_mm).ceil().max(2000.0) as usize;
    let step_mm = whole / steps as f64;
    let mut stages = Vec::new();
    for done in 0..=steps {
        let lost = PerGear { pinion: worn.as_slice(), wheel: zeros.as_slice() };
        cycle.evaluate(lost, &WearModel::cold(law.as_ref()), &mut depth, &|| false).unwrap();
        if done % (steps / 100) == 0 {
            let half_width_mm = cycle.observe(lost).unwrap().positions[0].footprint.half_width_mm;
            stages.push(Stage {
                sliding_mm: done as f64 * step_mm,
                half_width_mm,
                worn_area_mm2: grid.integral(&worn),
                middle_mpa: depth.pinion[count / 2] / (CYLINDER.coefficient_mm2_per_n * CELL_MM),
            });
        }
        worn.iter_mut().zip(&depth.pinion).for_each(|(worn, depth)| *worn += step_mm / CELL_MM * depth);
    }
    stages
}

/// Independent springs: exact at every stage, and rigid bodies within 1 % from four half-widths on.
#[test]
fn val_a_flat_wears_a_cylinder_on_winklers_bed() {
    let load = CYLINDER.line_load_n_per_mm;
    let at = hertz::flattening(&CylinderOnFlat, &steel(), 0.0);
    let bed = matched_mpa_per_mm(MatchCriterion::HalfWidth, &at, load);
    let surface =
        Winkler { foundation: WinklerFoundation::Uniform { mpa_per_mm: bed }, expected_line_load_n_per_mm: load };
    let unworn = at.contact.loaded(load).half_width_mm;
    let stages = wear(&surface, unworn, 8.0, 60.0, bed);
    let mut late = 0;
    for stage in &stages {
        let Stage { sliding_mm, half_width_mm, worn_area_mm2, middle_mpa } = *stage;
        let at = format!("after {sliding_mm:.3e} mm");
        assert_close(&format!("{at}, bed"), half_width_mm, CYLINDER.half_width_on_foundation_mm(sliding_mm, bed), 5e-3);
        if sliding_mm > 0.0 {
            assert_close(&format!("{at}, area"), worn_area_mm2, CYLINDER.worn_area_mm2(sliding_mm), 1e-3);
        }
        if half_width_mm > 4.0 * unworn {
            late += 1;
            assert_close(&format!("{at}, rigid"), half_width_mm, CYLINDER.half_width_mm(sliding_mm), 1e-2);
            let by_pressure = load / (2.0 * middle_mpa);
            assert_close(&format!("{at}, pressure"), by_pressure, CYLINDER.half_width_mm(sliding_mm), 1e-2);
        }
    }
    assert!(late > 50, "{late} late stages");
}

/// Elastic half-planes: Hertz's half-width to begin with, then that of uniform pressure as far as cells tell: pressure and wear go
/// on to the middle of the next cell, so that the extent is up to a cell and a half too long at either end. The pressure in the
/// middle knows the half-width better, w/(2a), and is that of rigid bodies within 1 % from four half-widths on.
#[test]
fn val_a_flat_wears_a_cylinder_of_elastic_half_planes() {
    let load = CYLINDER.line_load_n_per_mm;
    let unworn = hertz::flattening(&CylinderOnFlat, &steel(), 0.0).contact.loaded(load).half_width_mm;
    let surface = HalfSpace { material: steel(), expected_line_load_n_per_mm: load };
    // Two points a cell; half-planes are stiffest against the shortest wave of cells.
    let cell = unworn / 16.0;
    let stiffness = std::f64::consts::PI * contact_modulus_mpa(steel().map(Material::elastic)) / (2.0 * cell);
    let stages = wear(&surface, unworn, 7.0, 32.0, stiffness);
    assert_close("unworn", stages[0].half_width_mm, unworn, 1e-2);
    let mut late = 0;
    for stage in &stages[1..] {
        let Stage { sliding_mm, half_width_mm, worn_area_mm2, middle_mpa } = *stage;
        let at = format!("after {sliding_mm:.3e} mm");
        assert_close(&format!("{at}, area"), worn_area_mm2, CYLINDER.worn_area_mm2(sliding_mm), 1e-3);
        let elastic = CYLINDER.late_half_width_mm(sliding_mm, unworn);
        if half_width_mm > 4.0 * unworn {
            let off = (half_width_mm - elastic) / cell;
            assert!((-0.1..1.5).contains(&off), "{at}: {half_width_mm} instead of {elastic}, off by {off:.2} cells");
        }
        if half_width_mm > 4.0 * unworn {
            late += 1;
            let by_pressure = load / (2.0 * middle_mpa);
            assert_close(&format!("{at}, rigid"), by_pressure, CYLINDER.half_width_mm(sliding_mm), 1e-2);
        }
    }
    assert!(late > 50, "{late} late stages");
}

/// The load of a cylinder pressed onto the flat by `approach_mm` after it has lost `worn_mm` at its points, in a window as long as it takes.
fn settled_load(surface: &dyn ContactSurface, grid: &FlankGrid, worn_mm: &[f64], approach_mm: f64) -> f64 {
    let zeros = vec![0.0; grid.len()];
    let flanks = Flanks::new(&CylinderOnFlat, PerGear { pinion: grid, wheel: grid });
    let mut pair = surface.pair(flanks, 0.0, None);
    loop {
        let removed_mm = PerGear { pinion: worn_mm, wheel: zeros.as_slice() };
        pair.set_removed(removed_mm);
        let load = pair.load_at(approach_mm - pair.touch_mm()).line_load_n_per_mm;
        if pair.window_suffices(removed_mm) {
            return load;
        }
        pair.widen();
    }
}

/// A cylinder worn hollow touches on both shoulders of the hollow, half a millimetre beside the place that is looked at first: the load is that of a
/// window which holds them from the beginning on, and the hollow carries none of it.
#[test]
fn ver_shoulders_beside_a_hollow_are_found() {
    let count = 2000;
    let arcs: Vec<f64> = (0..=count).map(|i| 2.0 * MIDDLE_MM * f64::from(i) / f64::from(count)).collect();
    let worn: Vec<f64> =
        arcs.iter().map(|arc| 0.02 * (1.0 - ((arc - MIDDLE_MM) / 0.6).powi(2)).max(0.0).powi(2)).collect();
    let grid = FlankGrid { coordinate_mm: arcs.clone(), arc_mm: arcs };
    let bed = WinklerFoundation::Uniform { mpa_per_mm: 4e5 };
    let half_planes = |load| HalfSpace { material: steel(), expected_line_load_n_per_mm: load };
    let springs = |load| Winkler { foundation: bed.clone(), expected_line_load_n_per_mm: load };
    for approach_mm in [0.010, 0.014, 0.018] {
        let [narrow, wide] = [1.0, 30.0].map(|load| settled_load(&half_planes(load), &grid, &worn, approach_mm));
        println!("half-planes, {approach_mm} mm: {narrow} and {wide} N/mm");
        assert!(wide > 1.0 && (narrow / wide - 1.0).abs() < 0.02, "half-planes, {approach_mm} mm: {narrow} and {wide}");
        let [narrow, wide] = [1.0, 30.0].map(|load| settled_load(&springs(load), &grid, &worn, approach_mm));
        println!("springs, {approach_mm} mm: {narrow} and {wide} N/mm");
        assert!(wide > 1.0 && (narrow / wide - 1.0).abs() < 0.02, "springs, {approach_mm} mm: {narrow} and {wide}");
    }
}
