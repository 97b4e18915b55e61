//! What a run gives beside wear of the load that it finds: the mesh stiffness k = dF/dδ, and the work ∫ F ds that wears both flanks.
//!
//! Runs under other loads have the same teeth only where their compliance is a closed form or that of the elements: a Winkler foundation, and
//! the split of a given stiffness between teeth and contact, are matched to each load anew.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::RunRecord;

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
