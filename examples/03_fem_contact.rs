//! Finite-element contact: a cylinder on a block, on a mesh of one's own, against Hertz; then the FZG pair at its pitch point.
//!
//! `cargo run --release --example 03_fem_contact`

use std::path::Path;

use gearwear::{LoadedScene, Unwatched};
use gearwear_bodies::material::{Elastic, contact_modulus_mpa};
use gearwear_bodies::reference::hertz_line::HertzLine;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A steel cylinder of radius 50 mm on an aluminium block under 35 kN per mm: half of it is meshed.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes");
    let problem = std::fs::read_to_string(folder.join("cylinder-on-block.toml"))?;
    let solved = gearwear::fem_problem(&problem, &folder, &Unwatched)?;
    let contact = &solved.summary.contact[0];
    let modulus_mpa =
        contact_modulus_mpa([210e3, 70e3].map(|young_modulus_mpa| Elastic { young_modulus_mpa, poisson_ratio: 0.3 }));
    let hertz = HertzLine::of_relative_radius(50.0, modulus_mpa).loaded(35e3);
    println!("cylinder on block: {:.1} MPa, Hertz {:.1} MPa", contact.peak_pressure_MPa, hertz.peak_pressure_mpa);

    let scene = LoadedScene::preset("fzg-c")?;
    let whole = gearwear::fem_pair(&scene, None, &Unwatched)?.complete()?;
    let cycle = &whole.summary.new;
    println!(
        "FZG type C: transmission error {:.2} to {:.2} µm over {} positions, {} degrees of freedom",
        cycle.transmission_error_um.min, cycle.transmission_error_um.max, whole.summary.positions, whole.summary.dofs
    );
    for row in whole.mesh_cycle.iter().step_by(whole.mesh_cycle.len() / 8) {
        println!("  at {:.2} mm: load share {:.3}", row.position_mm, row.load_share);
    }
    Ok(())
}
