//! `gearwear mesh`: the finite-element mesh of the tooth pair.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use gearwear::scene::Resolved;
use gearwear::scene::loaded::{LoadedScene, SceneText};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::gear_mesh::settings::{Body, SectorSides};
use gearwear_mesh::{self as mesh, CellKind, Format};
use gearwear_physics::assessment::deformed_teeth::deformed_teeth;
use gearwear_physics::assessment::pair_mesh::{self, PairMesh, SpaceMesh};
use gearwear_physics::results::provenance::Provenance;

use super::failure::{Failure, InputError, no_mesh};
use super::progress::Progress;
use super::{print, warn};

#[derive(Debug, clap::Args)]
pub(super) struct MeshArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// The mesh file; its ending says the format
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Where the teeth touch: radius of curvature of the pinion in mm, from A to E; default: the pitch point
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    position: Option<f64>,
    /// One pitch of each gear over the whole face width as hexahedra, as the coupling "fem" of slices has them
    #[arg(long)]
    three_dimensional: bool,
    /// With displacement and stress of the teeth under the scene's torque, on unworn flanks
    #[arg(long, requires = "three_dimensional")]
    loaded: bool,
}

pub(super) fn run(args: &MeshArgs) -> Result<(), Failure> {
    // The file ending is checked before the work.
    let format = Format::of_path(&args.out).map_err(InputError::MeshFile)?;
    if args.loaded {
        return loaded(args, format);
    }
    let text = SceneText::read(&args.scene)?;
    let resolved = text.resolve()?;
    warn(&resolved.warnings);
    if args.three_dimensional {
        let built = pair_mesh::in_space(&resolved.scene, args.position).map_err(|error| no_mesh(error, &text))?;
        mesh::write_as(&built.mesh, &args.out, format).map_err(InputError::MeshFile)?;
        return print(&text_in_space(&resolved, &built, &args.out));
    }
    warn(resolved.scene.plane_section_warning().as_slice());
    warn(resolved.scene.one_load_warning().as_slice());
    let built = pair_mesh::build(&resolved.scene, args.position).map_err(|error| no_mesh(error, &text))?;
    mesh::write_as(&built.mesh, &args.out, format).map_err(InputError::MeshFile)?;
    print(&described(&resolved, &built, &args.out))
}

/// The teeth in space under load.
fn loaded(args: &MeshArgs, format: Format) -> Result<(), Failure> {
    let scene = LoadedScene::open(&args.scene)?;
    warn(scene.warnings());
    let progress = Progress::new(false, Arc::default());
    let deformed = deformed_teeth(scene.inputs(&Provenance::default()), args.position, &progress);
    progress.finish();
    let deformed = deformed.map_err(|error| no_mesh(error, &scene.given))?;
    mesh::write_as(&deformed.space.mesh, &args.out, format).map_err(InputError::MeshFile)?;
    let mut text = text_in_space(&scene.resolved, &deformed.space, &args.out);
    let share = 100.0 * deformed.load_n / deformed.whole_load_n;
    text += &line("load", format!("{:.0} N, {share:.1} % of it on these teeth", deformed.whole_load_n));
    text += &line("transmission error", format!("{:.2} µm", deformed.transmission_error_um));
    for gear in Gear::BOTH {
        let (u, stress) = (deformed.greatest_displacement_um[gear], deformed.greatest_von_mises_mpa[gear]);
        text += &line(
            &format!("{} tooth", gear.name()),
            format!("displacement up to {u:.2} µm, von Mises stress up to {stress:.0} MPa"),
        );
    }
    print(&text)
}

fn line(name: &str, value: String) -> String {
    format!("{name:20}{value}\n")
}

/// Description of a mesh in space.
fn text_in_space(resolved: &Resolved, built: &SpaceMesh, out: &Path) -> String {
    let scene = &resolved.scene;
    let mut text = format!("{}\n\n", resolved.title());
    text += &line("bodies", format!("one pitch of each gear, {} elements over the face width", built.layers));
    text += &line("position", format!("{:.4} mm in the middle of the face width", built.position_mm));
    let nodes = built.mesh.points.len();
    text += &line("nodes", format!("{nodes}, {} degrees of freedom", 3 * nodes));
    let cells: usize = built.mesh.cells.iter().map(|block| block.len()).sum();
    text += &line("cells", format!("{cells} twenty-node hexahedra"));
    for gear in Gear::BOTH {
        text +=
            &line(&format!("{} clamp", gear.name()), format!("radius {:.4} mm", scene.fem.clamp_radius_mm[gear].abs()));
        let worst = &built.quality[gear].scaled_jacobian;
        text += &line(&format!("{} section", gear.name()), format!("minimum scaled Jacobian {:.3}", worst.value));
    }
    text += &line("mesh", out.display().to_string());
    text
}

/// Description of a plane mesh.
fn described(resolved: &Resolved, built: &PairMesh, out: &Path) -> String {
    let scene = &resolved.scene;
    let mut text = format!("{}\n\n", resolved.title());
    let body = match scene.fem.body {
        Body::Ring => "whole rings".to_owned(),
        Body::Sector { teeth, sides } => {
            let sides = match sides {
                SectorSides::Free => "free",
                SectorSides::Clamped => "clamped",
            };
            format!("sectors of {teeth} teeth, sides {sides}")
        }
    };
    let fine: Vec<String> = built.fine_teeth.iter().map(|index| index.to_string()).collect();
    text += &line("bodies", format!("{body}; teeth {} resolved", fine.join(", ")));
    text += &line("position", format!("{:.4} mm", built.position_mm));
    for gear in Gear::BOTH {
        let radius = scene.fem.clamp_radius_mm[gear].abs();
        text += &line(&format!("{} clamp", gear.name()), format!("radius {radius:.4} mm"));
    }
    text += &line(
        "flank elements",
        format!(
            "{:.5} mm at the pitch point, {} in Hertz's half-width of {:.4} mm",
            built.element_mm, scene.fem.elements_per_half_width, built.half_width_mm
        ),
    );
    let nodes = built.mesh.points.len();
    let (triangles, quads) = (built.count(CellKind::Triangle6), built.count(CellKind::Quad8));
    text += &line("nodes", format!("{nodes}, {} degrees of freedom", 2 * nodes));
    text += &line(
        "cells",
        format!("{} ({triangles} six-node triangles, {quads} eight-node quadrilaterals)", triangles + quads),
    );
    for gear in Gear::BOTH {
        let (fine, coarse) = (built.fine_dofs[gear], built.coarse_dofs[gear]);
        text += &line(&format!("{} tooth", gear.name()), format!("{fine} degrees of freedom resolved, {coarse} not"));
    }
    let quality = &built.quality;
    for (name, worst, unit) in [
        ("minimum angle", &quality.least_angle_deg, "°"),
        ("maximum angle", &quality.greatest_angle_deg, "°"),
        ("scaled Jacobian", &quality.scaled_jacobian, ""),
        ("Jacobian ratio", &quality.jacobian_ratio, ""),
        ("aspect ratio", &quality.aspect_ratio, ""),
    ] {
        text += &line(name, format!("{:.3}{unit} at ({:.3}, {:.3}) mm", worst.value, worst.at_mm[0], worst.at_mm[1]));
    }
    text += &line("mesh", out.display().to_string());
    text
}
