//! A helical pair in slices: how load and wear are distributed over the face width.
//!
//! `cargo run --release --example 02_helical`

use gearwear::{LoadedScene, Unwatched};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene =
        LoadedScene::preset("helical")?.with("helical.coupling", "slicing")?.with("numerics.error_estimate", false)?;
    let run = gearwear::run(&scene, &Unwatched)?.complete()?;
    let helical = run.summary.helical.as_ref().ok_or("a helical pair has slices")?;
    println!(
        "total contact ratio {:.3}, K_Hβ {:.3} new, {:.3} worn",
        helical.total_contact_ratio, helical.K_Hbeta_new, helical.K_Hbeta_worn
    );
    println!("{:>9} {:>12} {:>12}", "width mm", "root µm", "tip µm");
    let pinion = &helical.wear.pinion;
    for ((width_mm, root_um), tip_um) in helical.width_mm.iter().zip(&pinion.root_wear_um).zip(&pinion.tip_wear_um) {
        println!("{width_mm:9.2} {root_um:12.3} {tip_um:12.3}");
    }
    // Fields over the whole flank stand slice after slice, the points of each from root to tip.
    let flank = &run.flanks.pinion;
    let points = flank.radius_mm.len();
    for (width_mm, wear_um) in flank.width_mm.iter().zip(flank.wear_um.chunks_exact(points)).step_by(5) {
        let greatest = wear_um.iter().copied().fold(0.0, f64::max);
        println!("at {width_mm:.2} mm of the width the pinion has lost up to {greatest:.2} µm");
    }
    Ok(())
}
