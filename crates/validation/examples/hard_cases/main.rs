//! Processor time, wall time and peak memory of hard cases beside easy ones, each in a process of its own: `hard_cases` prints a table of all,
//! `hard_cases NAME …` of those whose names begin so.

#[path = "../common/mod.rs"]
mod common;

use std::error::Error;
use std::time::Instant;

use gearwear::sweep::{Sweep, SweepQuestion, UnfinishedSweep};
use gearwear::{LoadedScene, UncertaintyQuestion, Unwatched};
use gearwear_studies::accuracy::{selection::AccuracyOptions, study};

type Found<T> = Result<T, Box<dyn Error>>;

/// A case, its number of threads, and what carries it out.
struct Case {
    name: &'static str,
    threads: usize,
    carry_out: fn() -> Found<()>,
}

const CASES: &[Case] = &[
    Case { name: "fem, rounding 0.1 mm", threads: 1, carry_out: || run(&rounded(0.1)?) },
    Case { name: "fem, rounding 0.03 mm", threads: 1, carry_out: || run(&rounded(0.03)?) },
    Case { name: "fem, rounding 0.01 mm", threads: 1, carry_out: || run(&rounded(0.01)?) },
    Case { name: "fem, rounding 0.002 mm", threads: 1, carry_out: || run(&rounded(0.002)?) },
    Case { name: "default, fem with check", threads: 1, carry_out: || run(&LoadedScene::preset("fzg-c")?) },
    Case {
        name: "default, half-planes with check",
        threads: 1,
        carry_out: || run(&LoadedScene::preset("fzg-c")?.with("contact.surface", "half-space")?),
    },
    Case {
        name: "severe, fem",
        threads: 1,
        carry_out: || run(&severe("fem", 372.6, "factor = 100.0\nband_MPa = 100.0")?),
    },
    Case {
        name: "severe, half-planes",
        threads: 1,
        carry_out: || run(&severe("half-space", 372.6, "factor = 100.0\nband_MPa = 100.0")?),
    },
    Case {
        name: "abrupt, fem",
        threads: 1,
        carry_out: || run(&severe("fem", 405.0, "factor = 60.0\nband_MPa = 0.0")?),
    },
    Case {
        name: "abrupt, half-planes",
        threads: 1,
        carry_out: || run(&severe("half-space", 405.0, "factor = 60.0\nband_MPa = 0.0")?),
    },
    Case { name: "worn in relief, fem with check", threads: 1, carry_out: || run(&LoadedScene::from_toml(IN_RELIEF)?) },
    Case { name: "helical", threads: 2, carry_out: || run(&LoadedScene::preset("helical")?) },
    Case { name: "h501", threads: 2, carry_out: || run(&LoadedScene::preset("h501")?) },
    Case { name: "h701", threads: 2, carry_out: || run(&LoadedScene::preset("h701")?) },
    Case { name: "h951", threads: 2, carry_out: || run(&LoadedScene::preset("h951")?) },
    Case { name: "new pair, h501 on 60 positions", threads: 2, carry_out: || run(&new_pair("h501", 60)?) },
    Case { name: "calibrate", threads: 2, carry_out: calibrate },
    Case { name: "accuracy", threads: 2, carry_out: accuracy },
    Case { name: "uncertainty", threads: 2, carry_out: || uncertainty(&LoadedScene::preset("fzg-c")?) },
    Case {
        name: "worn by 25 µm, uncertainty",
        threads: 2,
        carry_out: || uncertainty(&LoadedScene::from_toml(DEEPLY_WORN)?),
    },
    Case { name: "sweep", threads: 2, carry_out: sweep },
];

/// A pair of module 5 under 1310 MPa, worn by 15 µm with linear relief on both gears.
const IN_RELIEF: &str = r#"
[pair]
normal_module_mm = 5.0
pressure_angle_deg = 20.0
centre_distance_mm = 190.0
face_width_mm = 25.0
pinion = { teeth = 19, profile_shift = 0.2, tip_rounding_mm = 0.1, tip_relief = { amount_um = 25.0, length_mm = 2.5 } }
wheel = { teeth = 57, profile_shift = -0.2, tip_rounding_mm = 0.1, tip_relief = { amount_um = 25.0, length_mm = 2.5 } }
[material]
young_modulus_GPa = 206.0
poisson_ratio = 0.3
[operation]
pinion_torque_Nm = 650.0
pinion_speed_rpm = 500.0
hours = 200.0
[wear]
law = "archard"
coefficient_m2_per_N = 0.9e-17
"#;

/// A pair of module 4, whose pinion is worn by 25 µm.
const DEEPLY_WORN: &str = r#"
[pair]
normal_module_mm = 4.0
pressure_angle_deg = 20.0
centre_distance_mm = 152.0
face_width_mm = 20.0
pinion = { teeth = 19, profile_shift = 0.2, tip_rounding_mm = 0.1 }
wheel = { teeth = 57, profile_shift = -0.2, tip_rounding_mm = 0.1 }
[material]
young_modulus_GPa = 206.0
poisson_ratio = 0.3
[operation]
pinion_torque_Nm = 350.0
pinion_speed_rpm = 500.0
hours = 200.0
[wear]
law = "archard"
coefficient_m2_per_N = 1.852e-17
"#;

/// The new pair of a preset: one revolution, without check.
fn new_pair(preset: &str, positions: i64) -> Found<LoadedScene> {
    let scene = LoadedScene::preset(preset)?.with("numerics.positions", positions)?;
    let scene = scene.with("numerics.error_estimate", false)?.with("numerics.verify", false)?;
    let scene = scene.with("operation.snapshots_revolutions", vec![1.0])?;
    Ok(scene.with("operation.pinion_revolutions", 1.0)?)
}

fn run(scene: &LoadedScene) -> Found<()> {
    gearwear::run(scene, &Unwatched)?.complete()?;
    Ok(())
}

fn alone() -> Found<LoadedScene> {
    let scene = LoadedScene::preset("fzg-c")?.with("numerics.error_estimate", false)?;
    Ok(scene.with("numerics.verify", false)?)
}

/// FZG type C on finite elements, with these tip roundings.
fn rounded(rounding_mm: f64) -> Found<LoadedScene> {
    let scene = alone()?.with("contact.surface", "fem")?;
    Ok(scene.with("pair.pinion.tip_rounding_mm", rounding_mm)?.with("pair.wheel.tip_rounding_mm", rounding_mm)?)
}

/// FZG type C with severe wear above 2000 MPa.
fn severe(surface: &str, torque_nm: f64, more: &str) -> Found<LoadedScene> {
    let law: toml::Table = format!("above_MPa = 2000.0\n{more}").parse()?;
    let scene = alone()?.with("contact.surface", surface)?.with("operation.pinion_torque_Nm", torque_nm)?;
    Ok(scene.with("wear.severe", law)?)
}

fn calibrate() -> Found<()> {
    gearwear::calibrate(&LoadedScene::preset("fzg-c")?, &Unwatched)?;
    Ok(())
}

fn accuracy() -> Found<()> {
    let options = AccuracyOptions { within: 0.05, quick: false };
    study::run(&LoadedScene::preset("fzg-c")?, options, &Unwatched)?;
    Ok(())
}

fn uncertainty(scene: &LoadedScene) -> Found<()> {
    let uncertain = ["wear.coefficient_m2_per_N=lognormal:1.5", "operation.pinion_torque_Nm=normal:5%"];
    let question =
        UncertaintyQuestion { uncertain: uncertain.map(str::to_owned).to_vec(), ..UncertaintyQuestion::default() };
    gearwear::uncertainty(scene, &question, None, 2, &Unwatched)?;
    Ok(())
}

/// 144 combinations of tip relief, without verification.
fn sweep() -> Found<()> {
    let mut scene = alone()?;
    for gear in ["pinion", "wheel"] {
        let relief: toml::Table = "length_mm = 2.0\namount_um = 20.0".parse()?;
        scene = scene.with(&format!("pair.{gear}.tip_relief"), relief)?;
    }
    let vary = ["pinion", "wheel"].map(|gear| format!("pair.{gear}.tip_relief.amount_um=0:40:12")).to_vec();
    let sweep = Sweep::of(&scene, &SweepQuestion { vary, ..SweepQuestion::default() })?;
    UnfinishedSweep::begin(&sweep, None)?.run(2, &Unwatched)?;
    Ok(())
}

fn main() -> Found<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let [one, name] = &args[..]
        && one == "--one"
    {
        let case = CASES.iter().find(|case| case.name == name).ok_or("no such case")?;
        let start = Instant::now();
        (case.carry_out)()?;
        println!("{}", common::cost_since(start));
        return Ok(());
    }
    println!("| case | threads | processor, s | wall, s | memory, GB |\n|---|---|---|---|---|");
    let asked = |case: &&Case| args.is_empty() || args.iter().any(|name| case.name.starts_with(name.as_str()));
    for case in CASES.iter().filter(asked) {
        let found = common::in_its_own_process(&["--one", case.name], case.threads)?;
        let [processor, wall, memory] =
            ["processor_s", "wall_s", "memory_GB"].map(|what| found[what].as_f64().unwrap_or(f64::NAN));
        println!("| {} | {} | {processor:.2} | {wall:.2} | {memory:.2} |", case.name, case.threads);
    }
    Ok(())
}
