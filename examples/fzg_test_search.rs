//! Searches what the thesis's text leaves open of its FZG wear test (torque, speed, stiffness of the contact) for settings that meet
//! D1, D2 and D3 together: the tables of docs/fzg-test.md. Takes minutes.

#[path = "../tests/inside/common/fzg_test.rs"]
mod fzg_test;

use fzg_test::{Estimate, Verdict};
use rayon::prelude::*;

const SPEEDS_RPM: [f64; 5] = [100.0, 150.0, 200.0, 250.0, 300.0];
const TORQUES_NM: [f64; 16] =
    [300.0, 310.0, 320.0, 330.0, 340.0, 350.0, 360.0, 372.6, 382.0, 390.0, 400.0, 410.0, 420.0, 430.0, 440.0, 450.0];

fn main() {
    let band_mpa = std::env::args().nth(1).map_or(100.0, |band| band.parse().expect("a width of the transition, MPa"));
    let contacts = [
        "surface = \"winkler\"\nmatch = \"half-width\"",
        "surface = \"winkler\"\nmatch = \"peak-pressure\"",
        "surface = \"winkler\"\nmatch = \"half-width\"\ntip_contact = true",
        "surface = \"winkler\"\nmatch = \"peak-pressure\"\ntip_contact = true",
        "surface = \"half-space\"",
        "surface = \"half-space\"\ntip_contact = true",
    ];
    let mut estimates = Vec::new();
    for contact in contacts {
        for torque_nm in TORQUES_NM {
            estimates.push(Estimate {
                torque_nm,
                contact: contact.to_owned(),
                numerics: "step = \"adaptive\"\ntolerance_um = 0.05".to_owned(),
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
