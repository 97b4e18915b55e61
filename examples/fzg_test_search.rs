//! Searches what the thesis's text leaves open of its FZG wear test (torque, speed, stiffness of the contact) for settings that meet
//! D1, D2 and D3 together: the tables of docs/fzg-test.md. Takes minutes. The width of the transition, MPa, may be given, and after it the number of
//! flank points (half as many positions) and what the contact's lines must contain.

#[path = "../tests/inside/common/fzg_test.rs"]
mod fzg_test;

use fzg_test::{Estimate, Verdict};
use rayon::prelude::*;

const SPEEDS_RPM: [f64; 5] = [100.0, 150.0, 200.0, 250.0, 300.0];
const TORQUES_NM: [f64; 16] =
    [300.0, 310.0, 320.0, 330.0, 340.0, 350.0, 360.0, 372.6, 382.0, 390.0, 400.0, 410.0, 420.0, 430.0, 440.0, 450.0];

fn main() {
    let mut given = std::env::args().skip(1);
    let band_mpa = given.next().map_or(100.0, |band| band.parse().expect("a width of the transition, MPa"));
    let flank_points: usize = given.next().map_or(750, |points| points.parse().expect("a number of flank points"));
    let within = given.next().unwrap_or_default();
    let contacts = [
        "surface = \"winkler\"\nmatch = \"half-width\"",
        "surface = \"winkler\"\nmatch = \"peak-pressure\"",
        "surface = \"winkler\"\nmatch = \"half-width\"\ntip_contact = true",
        "surface = \"winkler\"\nmatch = \"peak-pressure\"\ntip_contact = true",
        "surface = \"half-space\"",
    ];
    let mut estimates = Vec::new();
    for contact in contacts.into_iter().filter(|contact| contact.contains(&within)) {
        for torque_nm in TORQUES_NM {
            estimates.push(Estimate {
                torque_nm,
                contact: contact.to_owned(),
                numerics: format!(
                    "step = \"adaptive\"\ntolerance_um = 0.05\nflank_points = {flank_points}\npositions = {}",
                    flank_points / 2
                ),
                band_mpa,
                speeds_rpm: SPEEDS_RPM.to_vec(),
            });
        }
    }
    println!(
        "| contact | T1 N·m | rpm | root µm 1e-17, 2e-17 | fast start | peak at mm, µm (1e-17; 2e-17) | root, tip, B, C, D µm | holds |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let rows: Vec<Vec<(f64, Verdict)>> = estimates
        .par_iter()
        .map(|estimate| {
            let run = estimate.run();
            SPEEDS_RPM.map(|rpm| (rpm, run.verdict(rpm))).to_vec()
        })
        .collect();
    for (estimate, verdicts) in estimates.iter().zip(rows) {
        for (rpm, verdict) in verdicts {
            print_row(estimate, rpm, &verdict);
        }
    }
}

fn print_row(estimate: &Estimate, rpm: f64, verdict: &Verdict) {
    let holds: Vec<&str> = [(verdict.d1(), "D1"), (verdict.d2(), "D2"), (verdict.d3(), "D3")]
        .into_iter()
        .filter_map(|(holds, name)| holds.then_some(name))
        .collect();
    let peaks =
        verdict.peak.map(|peak| peak.map_or("none".to_owned(), |(at, um)| format!("{at:.2}, {um:.1}"))).join("; ");
    let numbers = |values: &[f64]| values.iter().map(|value| format!("{value:.1}")).collect::<Vec<_>>().join(", ");
    println!(
        "| {} | {} | {rpm} | {} | {} | {peaks} | {} | {} |",
        estimate.contact.replace('\n', ", "),
        estimate.torque_nm,
        numbers(&verdict.root_um),
        numbers(&verdict.fast_start),
        numbers(&verdict.places_um),
        holds.join(" ")
    );
}
