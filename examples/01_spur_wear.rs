//! Wear of a spur pair: the FZG test gears type C over 128 hours, with and without tip relief.
//!
//! `cargo run --release --example 01_spur_wear`

use gearwear::{LoadedScene, Observer, RunRecord};

/// Shows the stages on standard error.
struct Stages;

impl Observer for Stages {
    fn stage(&self, name: &str) {
        eprintln!("{name} …");
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plain = LoadedScene::preset("fzg-c")?;
    let relief: toml::Table = "amount_um = 20.0\nlength_mm = 2.0".parse()?;
    let relieved = plain.with("pair.pinion.tip_relief", relief.clone())?.with("pair.wheel.tip_relief", relief)?;
    for (name, scene) in [("without relief", plain), ("with 20 µm of tip relief", relieved)] {
        let run = gearwear::run(&scene, &Stages)?.complete()?;
        println!("\n{name}");
        show(&run);
    }
    Ok(())
}

fn show(run: &RunRecord) {
    let summary = &run.summary;
    for (gear, wear, flank) in
        [("pinion", &summary.pinion, &run.flanks.pinion), ("wheel", &summary.wheel, &run.flanks.wheel)]
    {
        let pressure = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        println!(
            "  {gear}: {:.2} µm at radius {:.2} mm, maximum pressure {:.0} MPa new, {:.0} MPa worn",
            wear.peak_wear_um,
            wear.peak_wear_radius_mm,
            pressure(&flank.pressure_new_MPa),
            pressure(&flank.pressure_worn_MPa),
        );
    }
    let share = run.mesh_cycle.iter().map(|row| row.load_share_new).fold(0.0, f64::max);
    println!(
        "  greatest load share {share:.3}, transmission error {:.2} µm peak to peak when new, {:.2} µm when worn",
        summary.new.transmission_error_um.peak_to_peak, summary.worn.transmission_error_um.peak_to_peak
    );
}
