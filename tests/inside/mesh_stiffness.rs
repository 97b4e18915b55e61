//! What a run gives beside wear of the load that it finds: the mesh stiffness k = dF/dδ, and the work ∫ F ds that wears both flanks.
//!
//! Runs under other loads have the same teeth only where their compliance is a closed form or that of the elements: a Winkler foundation, and
//! the split of a given stiffness between teeth and contact, are matched to each load anew.

use std::f64::consts::{PI, TAU};

use gearwear::report::html::active_flank::ActiveFlank;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::{CycleSummary, MeshCycleRow, RunRecord};

use super::common::loaded;

const TORQUE_NM: f64 = 302.0;
/// A part of the torque.
const STEP: f64 = 0.01;

fn run(torque_nm: f64, preset: &str, keys: &str) -> RunRecord {
    let text = format!(
        "[pair]\npreset = \"{preset}\"\n[operation]\npinion_torque_Nm = {torque_nm}\npinion_revolutions = 100.0\n\
         snapshots_revolutions = [100.0]\n{keys}[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
         [numerics]\nflank_points = 400\npositions = 120\nerror_estimate = false\nverify = false\n"
    );
    let resolved = Resolved::from_toml(&text).unwrap_or_else(|problems| panic!("{problems:?}"));
    runs::run(&loaded(&resolved), &Unwatched).unwrap().complete().unwrap()
}

/// The stiffness is the difference of two loads over that of the transmission errors that other runs find under them; and what both
/// flanks lose in one mesh is k ∫ F ds.
fn check(what: &str, preset: &str, keys: &str, scatter: f64) {
    let [less, here, more] = [1.0 - STEP, 1.0, 1.0 + STEP].map(|part| run(part * TORQUE_NM, preset, keys));
    let step_n_per_mm = 2.0 * STEP * here.summary.contact.line_load_N_per_mm;
    let rows = here.mesh_cycle.iter().zip(&less.mesh_cycle).zip(&more.mesh_cycle);
    let differences: Vec<f64> = rows
        .map(|((here, less), more)| {
            let secant = step_n_per_mm / (more.transmission_error_new_um - less.transmission_error_new_um);
            here.mesh_stiffness_new_N_per_mm_um.unwrap() / secant - 1.0
        })
        .collect();
    let mean = |of: fn(f64) -> f64| differences.iter().copied().map(of).sum::<f64>() / differences.len() as f64;
    let (bias, spread) = (mean(|d| d), mean(f64::abs));
    println!("{what}: stiffness {bias:.1e}, {spread:.1e}");
    // Where a pair comes into contact or leaves it the secant is of both sides.
    assert!(bias.abs() < 3e-3 && spread < scatter, "{what}: the mesh stiffness is {bias:e} off, {differences:?}");
    let balance = &here.summary.wear_balance;
    let work = balance.work_new.unwrap();
    assert!(work < 1.5e-3, "{what}: volume against work {work:e}");
}

#[test]
fn ver_stiffness_and_work_of_a_spur_pair() {
    for surface in ["hertz", "half-space"] {
        let keys = format!("[contact]\nsurface = \"{surface}\"\n[stiffness]\nmodel = \"weber-banaschek\"\n");
        check(surface, "fzg-c", &keys, 5e-3);
    }
    // As the load grows, nodes come into contact one by one.
    check("fem", "fzg-c", "[contact]\nsurface = \"fem\"\n", 1.5e-2);
}

#[test]
fn ver_stiffness_and_work_of_slices() {
    let keys = |coupling: &str| {
        format!(
            "[contact]\nsurface = \"half-space\"\n[stiffness]\nmodel = \"weber-banaschek\"\n[helical]\nslices = 6\n\
             coupling = \"{coupling}\"\n"
        )
    };
    check("thin slices", "helical", &keys("none"), 5e-3);
    check("plates", "helical", &keys("slicing"), 5e-3);
}

/// Transmission error at a position, µm.
type Error = fn(&MeshCycleRow) -> f64;

/// Mesh orders are the Fourier amplitudes of the transmission error over any base pitch: over that from A on, by the trapezoidal rule on the rows of
/// `mesh_cycle.csv`, they are those of the summary, which takes another one.
#[test]
fn ver_mesh_orders_of_a_spur_pair() {
    let record = run(TORQUE_NM, "fzg-c", "[contact]\nsurface = \"hertz\"\n[stiffness]\nmodel = \"weber-banaschek\"\n");
    let pitch_mm = record.summary.geometry.base_pitch_mm;
    let rows = &record.mesh_cycle;
    let first_mm = rows[0].position_mm;
    let of: [(Error, &CycleSummary); 2] = [
        (|row| row.transmission_error_new_um, &record.summary.new),
        (|row| row.transmission_error_worn_um, &record.summary.worn),
    ];
    for (error_um, summary) in of {
        for order in 1..=3 {
            let wave = |row: &MeshCycleRow| {
                let (sin, cos) = (TAU * f64::from(order) * (row.position_mm - first_mm) / pitch_mm).sin_cos();
                [error_um(row) * cos, error_um(row) * sin]
            };
            let mut sum = [0.0; 2];
            for pair in rows.windows(2) {
                let [from, to] = [&pair[0], &pair[1]];
                let end = (first_mm + pitch_mm).min(to.position_mm);
                let length = (end - from.position_mm).max(0.0);
                let [one, other] = [wave(from), wave(to)];
                (0..2).for_each(|part| sum[part] += 0.5 * length * (one[part] + other[part]));
            }
            let amplitude_um = 2.0 / pitch_mm * sum[0].hypot(sum[1]);
            let found = summary.mesh_orders_um[order as usize - 1];
            let greatest = summary.mesh_orders_um[0];
            assert!((found - amplitude_um).abs() < 0.02 * greatest, "order {order}: {found} {amplitude_um}");
        }
        // The least peak-to-peak value of a curve with this first order is that of a square wave, π/2 of its amplitude.
        let peak_to_peak = summary.transmission_error_um.peak_to_peak;
        assert!(summary.mesh_orders_um[0] < 2.0 / PI * peak_to_peak && summary.mesh_orders_um[0] > 0.2 * peak_to_peak);
    }
}

/// The shaded part of a flank that the mate's tip edge touches ends at the distance of that point of the line of action from the gear's axis: the
/// third side of a triangle of the centre distance and the radius at which the mate's tip-edge zone begins.
#[test]
fn ver_tip_edges_on_the_mating_flank() {
    let keys = "[contact]\nsurface = \"hertz\"\ntip_contact = false\n[stiffness]\nmodel = \"weber-banaschek\"\n";
    let record = run(TORQUE_NM, "fzg-c", keys);
    let working_rad = record.summary.geometry.working_pressure_angle_deg.to_radians();
    let centre_distance_mm = 91.5;
    for gear in Gear::BOTH {
        let [own_mm, mate_mm] = ActiveFlank::tip_edges_mm(&record, gear);
        assert_eq!(own_mm, record.flanks[gear].zones.tip_edge_radius_mm);
        let radius_mm = record.flanks[gear.mate()].zones.tip_edge_radius_mm;
        let angle_rad = (record.drawing.circles_mm[gear.mate()].base / radius_mm).acos() - working_rad;
        let squared = centre_distance_mm * centre_distance_mm + radius_mm * radius_mm
            - 2.0 * centre_distance_mm * radius_mm * angle_rad.cos();
        assert!((mate_mm - squared.sqrt()).abs() < 1e-9, "{mate_mm} {}", squared.sqrt());
    }
}
