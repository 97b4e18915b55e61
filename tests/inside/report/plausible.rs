//! A run that never happened but looks like one: an FZG type C pair with a made-up wear that grows with time.

use gearwear_bodies::gear::{Gear, PerGear, flank_surface::FlankSurface, flank_zones::FlankZones};
use gearwear_physics::results::chemistry::WearLawSummary;
use gearwear_physics::results::error::*;
use gearwear_physics::results::root_stress::{RootSectionSummary, RootStressSummary};
use gearwear_physics::results::run::*;
use gearwear_physics::wear::regime::Regime;

const HOURS: [f64; 9] = [0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75];
const REVOLUTIONS_PER_HOUR: f64 = 9000.0;
const CURVATURE: PathPoints = PathPoints { A: 4.4723, B: 10.2848, C: 13.9701, D: 17.7569, E: 23.5694 };
const LINE_OF_ACTION_MM: f64 = 34.9252;
const BASE_RADIUS_MM: [f64; 2] = [33.8289, 50.7434];
const POINTS: usize = 750;
const POSITIONS: usize = 400;

/// The finished run.
pub fn run() -> RunRecord {
    let flanks = PerGear { pinion: flank(Gear::Pinion), wheel: flank(Gear::Wheel) };
    let history: Vec<HistoryRow> = HOURS.iter().map(|&hours| history_row(hours)).collect();
    RunRecord {
        summary: summary(),
        inputs: Vec::new(),
        scene_toml: SCENE.into(),
        flanks,
        history,
        mesh_cycle: mesh_cycle(),
        film: Vec::new(),
        surface: PerGear::from_fn(surface),
        slices: None,
        drawing: drawing(),
        torque_curve: Vec::new(),
    }
}

/// The same run, stopped before its first snapshot.
pub fn interrupted() -> RunRecord {
    let mut record = run();
    record.history.clear();
    for flank in [&mut record.flanks.pinion, &mut record.flanks.wheel] {
        flank.snapshot_wear_um.clear();
        flank.snapshot_pressure_MPa.clear();
        flank.wear_um.fill(0.0);
    }
    let s = &mut record.summary;
    (s.stopped, s.hours, s.revolutions) = (StopReason::Interrupted, Some(0.0), 0.0);
    s.worn = s.new.clone();
    for wear in [&mut s.pinion, &mut s.wheel] {
        *wear = WearSummary {
            peak_wear_radius_mm: wear.peak_wear_radius_mm,
            tip_edge_wear_radius_mm: wear.tip_edge_wear_radius_mm,
            below_sap_wear_radius_mm: wear.below_sap_wear_radius_mm,
            normal_tip_thickness_mm: wear.normal_tip_thickness_mm,
            ..WearSummary::default()
        };
    }
    record
}

const SCENE: &str = "title = \"<b>FZG</b> type C & \\\"128\\\" hours\"\n\n[pair]\npreset = \"fzg-c\"\n\n[operation]\npinion_torque_Nm = 302.0\nhours = 127.75\n";

fn surface(gear: Gear) -> FlankSurface {
    let (axis_y_mm, tangent_point_rad) = [(0.0, 1.18), (91.5, -1.96)][gear as usize];
    FlankSurface {
        gear,
        base_radius_mm: base(gear),
        base_helix_tangent: 0.0,
        face_width_mm: 14.0,
        axis_y_mm,
        tangent_point_rad,
        line_of_action_mm: LINE_OF_ACTION_MM,
    }
}

fn base(gear: Gear) -> f64 {
    BASE_RADIUS_MM[gear as usize]
}

/// Radius of curvature of the gear's flank where the pinion's is `rho_1`.
fn curvature(gear: Gear, rho_1: f64) -> f64 {
    match gear {
        Gear::Pinion => rho_1,
        Gear::Wheel => LINE_OF_ACTION_MM - rho_1,
    }
}

fn path_points(gear: Gear) -> PathPoints {
    let radius = |rho_1| base(gear).hypot(curvature(gear, rho_1));
    let PathPoints { A, B, C, D, E } = CURVATURE;
    PathPoints { A: radius(A), B: radius(B), C: radius(C), D: radius(D), E: radius(E) }
}

/// Load share at a position: a third at A, rising to the whole load at B.
fn share(rho_1: f64, worn: bool) -> f64 {
    let at_a = if worn { 0.31 } else { 0.41 };
    let PathPoints { A, B, D, E, .. } = CURVATURE;
    if rho_1 < B {
        at_a + (0.6 - at_a) * (rho_1 - A) / (B - A)
    } else if rho_1 <= D {
        1.0
    } else {
        0.6 - (0.6 - at_a) * (rho_1 - D) / (E - D)
    }
}

fn pressure(rho_1: f64, worn: bool) -> f64 {
    let relative = rho_1 * (LINE_OF_ACTION_MM - rho_1) / LINE_OF_ACTION_MM;
    let at_c = CURVATURE.C * (LINE_OF_ACTION_MM - CURVATURE.C) / LINE_OF_ACTION_MM;
    1655.8 * (share(rho_1, worn) * at_c / relative).sqrt()
}

fn wear(gear: Gear, rho_1: f64, hours: f64) -> f64 {
    let sliding = (rho_1 / CURVATURE.C - 1.0).abs() * CURVATURE.C / curvature(gear, rho_1).max(1.0);
    let per_mesh = [1.0, 0.62][gear as usize];
    1.9 * per_mesh * share(rho_1, false) * sliding * (hours / 127.75).powf(0.92)
}

fn flank(gear: Gear) -> FlankRecord {
    let tip = [41.23, 59.18][gear as usize];
    let r_b = base(gear);
    let radius_mm: Vec<f64> = (0..POINTS).map(|i| r_b + (tip - r_b) * i as f64 / (POINTS - 1) as f64).collect();
    let rho: Vec<f64> = radius_mm.iter().map(|r| (r * r - r_b * r_b).max(0.0).sqrt()).collect();
    let position = |rho: f64| if gear == Gear::Pinion { rho } else { LINE_OF_ACTION_MM - rho };
    let within = |value: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let in_contact = |p: f64| (CURVATURE.A..=CURVATURE.E).contains(&p);
        rho.iter().map(|&r| if in_contact(position(r)) { value(position(r)) } else { 0.0 }).collect()
    };
    FlankRecord {
        roll_angle_deg: rho.iter().map(|r| (r / r_b).to_degrees()).collect(),
        width_mm: vec![7.0],
        removed_um: radius_mm.iter().map(|r| (20.0 * (r - (tip - 2.0)) / 2.0).max(0.0)).collect(),
        sliding_mm_per_mesh: within(&|p| 0.4 * (p / CURVATURE.C - 1.0).abs()),
        wear_um: within(&|p| wear(gear, p, 127.75)),
        verified_wear_um: Some(within(&|p| 1.03 * wear(gear, p, 127.75))),
        pressure_new_MPa: within(&|p| pressure(p, false)),
        pressure_worn_MPa: within(&|p| pressure(p, true)),
        snapshot_wear_um: HOURS.iter().map(|&hours| within(&|p| wear(gear, p, hours))).collect(),
        snapshot_pressure_MPa: HOURS.iter().map(|_| within(&|p| pressure(p, true))).collect(),
        path_point_radius_mm: path_points(gear),
        zones: FlankZones {
            active_start_radius_mm: [34.123, 51.998][gear as usize],
            tip_edge_radius_mm: tip - 0.4,
            tip_end_radius_mm: tip - 0.1,
            tip_radius_mm: tip,
            pressure_length_mm: 0.04,
        },
        radius_mm,
    }
}

fn history_row(hours: f64) -> HistoryRow {
    let peak = wear(Gear::Pinion, CURVATURE.A, hours);
    HistoryRow {
        hours: Some(hours),
        revolutions: hours * REVOLUTIONS_PER_HOUR,
        pinion_peak_wear_um: peak,
        pinion_root_wear_um: peak,
        pinion_pitch_wear_um: 0.0,
        wheel_peak_wear_um: wear(Gear::Wheel, CURVATURE.E, hours),
        peak_pressure_MPa: 1655.8 + hours,
        transmission_error_peak_to_peak_um: 8.0 + hours / 100.0,
        pinion_peak_wear_radius_mm: path_points(Gear::Pinion).A,
        pinion_sap_wear_um: peak,
        pinion_sap_wear_rate_um_per_Mrev: peak / (hours * REVOLUTIONS_PER_HOUR) * 1e6,
        phase: 1,
        sharp_edge_pressure_MPa: None,
        pinion_tip_edge_wear_um: 0.0,
        wheel_tip_edge_wear_um: 0.0,
        pinion_below_sap_wear_um: 0.0,
        wheel_below_sap_wear_um: 0.0,
        flank_pressure_MPa: 1655.8,
        tip_edge_line_load_N_per_mm: 260.0,
    }
}

fn mesh_cycle() -> Vec<MeshCycleRow> {
    (0..POSITIONS)
        .map(|i| {
            let position_mm = CURVATURE.A + (CURVATURE.E - CURVATURE.A) * i as f64 / (POSITIONS - 1) as f64;
            let alone = share(position_mm, false) == 1.0;
            let bend = ((position_mm - CURVATURE.C) / 10.0).powi(2);
            MeshCycleRow {
                position_mm,
                load_share_new: share(position_mm, false),
                load_share_worn: share(position_mm, true),
                peak_pressure_new_MPa: pressure(position_mm, false),
                peak_pressure_worn_MPa: pressure(position_mm, true),
                half_width_mm: 0.245,
                transmission_error_new_um: if alone { 38.0 } else { 24.0 } + 3.0 * bend,
                transmission_error_worn_um: if alone { 38.2 } else { 26.5 } + 3.4 * bend,
                temperature_rise_K: None,
                half_width_worn_mm: 0.251,
                temperature_rise_heat_equation_K: None,
                temperature_rise_williams_K: None,
                temperature_rise_tian_kennedy_K: None,
                peclet_pinion: None,
                peclet_wheel: None,
                at_sharp_edge_new: false,
                at_sharp_edge_worn: false,
                pinion_rotation_deg: position_mm - CURVATURE.C,
                mesh_stiffness_new_N_per_mm_um: Some(if alone { 15.0 } else { 21.0 }),
                mesh_stiffness_worn_N_per_mm_um: Some(if alone { 14.8 } else { 20.5 }),
            }
        })
        .collect()
}

fn summary() -> Summary {
    let gear = |teeth, reference, pitch, tip, root, base, sap| GearSummary {
        teeth,
        reference_diameter_mm: reference,
        base_diameter_mm: base,
        working_pitch_diameter_mm: pitch,
        tip_diameter_mm: tip,
        root_diameter_mm: root,
        root_form_diameter_mm: base + 0.07,
        start_of_active_profile_diameter_mm: sap,
        tooth_thickness_mm: 7.66,
        tip_thickness_mm: 2.73,
        tip_clearance_mm: 1.12,
        undercut: false,
        tip_form_diameter_mm: tip,
        end_of_active_profile_diameter_mm: tip,
        specific_sliding_at_root: Some(-3.5),
        span_teeth: Some(3),
        span_mm: Some(34.9),
        ball_diameter_mm: Some(7.776),
        dimension_over_balls_mm: Some(tip + 1.7),
    };
    let cycle = |peak, te_min: f64, te_max: f64| CycleSummary {
        mesh_orders_um: vec![0.4 * (te_max - te_min), 0.1 * (te_max - te_min)],
        peak_pressure_MPa: peak,
        flank_pressure_MPa: 0.98 * peak,
        tip_edge_line_load_N_per_mm: 260.0,
        tip_edge_mean_pressure_MPa: 3000.0,
        pitch_pressure_MPa: 1655.8,
        load_imbalance: 1e-12,
        transmission_error_um: RangeSummary { min: te_min, max: te_max, peak_to_peak: te_max - te_min },
        ..CycleSummary::default()
    };
    let worn = |gear, at: f64| WearSummary {
        peak_wear_um: wear(gear, at, 127.75),
        peak_wear_radius_mm: base(gear).hypot(curvature(gear, at)),
        tip_edge_wear_um: 0.5,
        tip_edge_wear_radius_mm: [41.2, 59.1][gear as usize],
        below_sap_wear_um: 0.25,
        below_sap_wear_radius_mm: [34.1, 51.9][gear as usize],
        root_wear_um: wear(gear, at, 127.75),
        pitch_wear_um: 0.002,
        worn_volume_mm3: 4.87,
        worn_mass_mg: 38.1,
        normal_tip_thickness_mm: [2.1, 2.3][gear as usize],
        ..WearSummary::default()
    };
    let stage = |name: &str, wall_s| StageTime { name: name.into(), wall_s };
    Summary {
        title: "<b>FZG</b> type C & \"128\" hours".into(),
        report: None,
        program_version: "0.1.0".into(),
        scene_hash: "0123456789abcdef".into(),
        stopped: StopReason::Completed,
        hours: Some(127.75),
        revolutions: 127.75 * REVOLUTIONS_PER_HOUR,
        life: None,
        stages: vec![
            stage("geometry", 0.0004),
            stage("stiffness", 0.0021),
            stage("simulation", 0.083),
            stage("error-estimate", 0.31),
        ],
        left_out: vec![
            StageLeftOut { name: "temperature".into(), reason: "the law archard does not depend on it".into() },
            StageLeftOut { name: "calibration".into(), reason: "K/H follows from match = \"half-width\"".into() },
        ],
        wall_s: 0.397,
        geometry: GeometrySummary {
            transverse_contact_ratio: 1.4375,
            overlap_ratio: 0.0,
            base_pitch_mm: 13.2846,
            working_pressure_angle_deg: 22.4388,
            curvature_radius_mm: CURVATURE,
            pitch_point_index: 281.0,
            line_of_action_mm: LINE_OF_ACTION_MM,
            backlash_mm: -6e-5,
            gears: PerGear {
                pinion: gear(16, 72.0, 73.2, 82.46, 62.386, 67.6578, 68.2466),
                wheel: gear(24, 108.0, 109.8, 118.36, 98.294, 101.4868, 103.997),
            },
        },
        helical: None,
        contact: ContactSummary {
            surface: "winkler".into(),
            line_load_N_per_mm: 637.66,
            foundation_MPa_per_mm: Some(5.4e5),
            hertz_half_width_mm: 0.2452,
            hertz_peak_pressure_MPa: 1655.8,
        },
        reference_phase: 1,
        phases: Vec::new(),
        stiffness: Some(StiffnessSummary {
            model: "constant".into(),
            reference_line_load_N_per_mm: 637.66,
            pair_at_pitch_N_per_mm_um: 15.2,
            teeth_at_pitch_N_per_mm_um: 20.0,
            split_remainder_at_half_load: Some(0.012),
        }),
        stiffness_iso_6336_1: None,
        root_stress: PerGear::from_fn(|_| root_stress()),
        wear: Some(law()),
        wear_of_gear: PerGear::from_fn(|_| law()),
        temperature: None,
        lubrication: None,
        new: cycle(1880.0, 24.0, 38.4),
        worn: cycle(1702.0, 26.5, 38.9),
        transmission_error_over_life: Some(OverLifeSummary { mean_um: 12.1, max_um: 14.4 }),
        transmission_error_over_torque: None,
        pinion: worn(Gear::Pinion, CURVATURE.A),
        wheel: worn(Gear::Wheel, CURVATURE.E),
        wear_balance: WearBalance::default(),
        invariants: Vec::new(),
        error: ErrorSummary {
            total: TotalError {
                profile: ErrorPerGear { pinion: Some(0.03), wheel: Some(0.03) },
                peak_wear: ErrorPerGear { pinion: Some(0.031), wheel: Some(0.029) },
                tip_edge_wear: ErrorPerGear { pinion: Some(0.034), wheel: Some(0.041) },
                transmission_error_peak_to_peak: Some(0.012),
                transmission_error_peak_to_peak_new: Some(0.011),
                transmission_error_over_life: Some(0.013),
                pressure_between_tips: Some(0.04),
                flank_pressure: ErrorNewAndWorn { new: Some(0.02), worn: Some(0.03) },
                how: "the same wear simulation with finite elements".into(),
            },
            companions_cost: Some(0.31),
            discretisation: Some(0.0021),
            wear_step: Some(0.0008),
            surface_model: None,
            volume_balance: Some(0.003),
            severe_switch: None,
            severe_limit: None,
            how: ErrorSources {
                discretisation: "run again with half the points and positions; the difference over three".into(),
                wear_step: "run again with twice the step; the difference".into(),
                surface_model: "needs a calibration file".into(),
                volume_balance: "worn volumes of the whole gears".into(),
                severe_switch: "the scene has no transition to severe wear".into(),
                severe_limit: "the scene has no transition to severe wear".into(),
            },
        },
        work: WorkSummary {
            wear_steps: 150,
            rejected_steps: 0,
            stages: 150,
            jacobian_probes: 0,
            stability_probes: 9,
            mesh_cycles: 161,
            equilibria: 64_400,
            newton_iterations: 201_331,
            pair_evaluations: 512_004,
        },
        warnings: vec!["pinion_speed_rpm <150> is below what the law was fitted for".into()],
    }
}

/// Gears with trapezoidal teeth: enough to look at.
fn drawing() -> PairDrawing {
    let axis = PerGear { pinion: [0.0, 0.0], wheel: [0.0, 91.5] };
    let outline = PerGear {
        pinion: gear_outline(16, axis.pinion, [31.193, 36.6, 41.23], 90.0),
        wheel: gear_outline(24, axis.wheel, [49.147, 54.9, 59.18], 90.0 + 180.0 / 24.0),
    };
    // T1 and T2 from the base radii and the working pressure angle.
    let alpha = 22.4388_f64.to_radians();
    let t1 = [BASE_RADIUS_MM[0] * alpha.sin(), BASE_RADIUS_MM[0] * alpha.cos()];
    let t2 = [-BASE_RADIUS_MM[1] * alpha.sin(), 91.5 - BASE_RADIUS_MM[1] * alpha.cos()];
    let on_line = |rho: f64| [0, 1].map(|i| t1[i] + (t2[i] - t1[i]) * rho / LINE_OF_ACTION_MM);
    let PathPoints { A, B, C, D, E } = CURVATURE;
    PairDrawing {
        outline,
        axis,
        bore_radius_mm: PerGear { pinion: Some(15.0), wheel: None },
        circles_mm: PerGear {
            pinion: GearCircles { base: 33.8289, working_pitch: 36.6, tip: 41.23 },
            wheel: GearCircles { base: 50.7434, working_pitch: 54.9, tip: 59.18 },
        },
        line_of_action: [t1, t2],
        path_of_contact: [("A", A), ("B", B), ("C", C), ("D", D), ("E", E)].map(|(n, r)| (n.into(), on_line(r))).into(),
        rim_radius_mm: None,
    }
}

fn gear_outline(teeth: u32, axis: [f64; 2], [root, pitch, tip]: [f64; 3], first_deg: f64) -> Vec<[f64; 2]> {
    let half_pitch = 180.0 / f64::from(teeth);
    let corners = [(-0.85, root), (-0.5, pitch), (-0.2, tip), (0.2, tip), (0.5, pitch), (0.85, root)];
    (0..teeth)
        .flat_map(|tooth| corners.map(|(at, radius)| (first_deg + half_pitch * (2.0 * f64::from(tooth) + at), radius)))
        .map(|(deg, radius)| {
            let (sin, cos) = deg.to_radians().sin_cos();
            [axis[0] + radius * cos, axis[1] + radius * sin]
        })
        .collect()
}

/// As of the pinion of FZG-C.
#[allow(non_snake_case, reason = "names that end in their unit")]
fn root_stress() -> RootStressSummary {
    let section = |nominal_stress_MPa: f64| RootSectionSummary {
        nominal_stress_MPa,
        form_factor: 1.6,
        stress_correction_factor: 2.0,
        moment_arm_mm: 4.6,
        thickness_mm: 9.2,
        fillet_radius_mm: 2.1,
        load_angle_deg: 27.0,
    };
    RootStressSummary { iso_6336_3: Some(section(430.0)), vdi_2736: None }
}

fn law() -> WearLawSummary {
    WearLawSummary {
        law: "archard".into(),
        coefficient_mm3_per_Nm: 1e-8,
        effective_coefficient_new_mm3_per_Nm: 1e-8,
        effective_coefficient_worn_mm3_per_Nm: 1e-8,
        irg_regime: Regime::Two,
        severe_coefficient_mm3_per_Nm: None,
        irg_regime_severe: None,
        typical_constants: Vec::new(),
        valid_temperature_C: None,
        work_outside_validity_new: None,
        work_outside_validity_worn: None,
    }
}
