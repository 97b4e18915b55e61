//! What finite elements teach the fast model, and the fast model with it: a Winkler foundation calibrated by position and load.
//!
//! `cargo run --release --example 04_calibrate`

use gearwear::{LoadedScene, Unwatched};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plain = LoadedScene::preset("fzg-c")?.with("contact.surface", "winkler")?;
    let calibrated = gearwear::calibrate(&plain, &Unwatched)?;
    let calibration = calibrated.calibration;
    println!("calibrated in {:.2} s", calibrated.wall_s);
    for (criterion, fit) in &calibration.foundation_fit {
        println!(
            "  K/H by the {}: {:.2} % off where it was held out",
            criterion.name(),
            100.0 * fit.held_out.worst_matched
        );
    }
    println!("pair stiffness, N/(mm·µm):");
    for (point, at) in ["A", "B", "C", "D", "E"].iter().zip(&calibration.deflection_at_points) {
        if let Some(at) = at {
            println!("  at {point}: {:.2}", at.pair_n_per_mm_um());
        }
    }
    let fast = plain.with("contact.match", "half-width")?.with("numerics.verify", true)?;
    for (name, scene) in [("matched to Hertz", fast.clone()), ("calibrated", fast.with_calibration(calibration)?)] {
        let run = gearwear::run(&scene, &Unwatched)?.complete()?;
        let error = run.summary.error.total.peak_wear.pinion;
        println!(
            "{name}: maximum wear of the pinion {:.2} µm, off by {} against finite elements",
            run.summary.pinion.peak_wear_um,
            error.map_or("?".to_owned(), |error| format!("{:.1} %", 100.0 * error))
        );
    }
    Ok(())
}
