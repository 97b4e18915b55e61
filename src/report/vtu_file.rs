//! Files for ParaView: meshes with numbers at their points.

use std::io::{self, Write};

use gearwear_fem::nodal_fields::add_nodal_fields;
use gearwear_mesh::vtu::VtuEncoding;
use gearwear_mesh::{Format, Mesh, to_bytes};
use gearwear_physics::results::fem_problem::NodalStress;

/// Adds a plane solution.
pub(super) fn add_solution(mesh: &mut Mesh, displacement_mm: &[[f64; 2]], stress: &[NodalStress]) {
    let tensor = |[x, y, z, xy]: [f64; 4]| [x, y, z, xy, 0.0, 0.0];
    let displacement_mm = displacement_mm.iter().map(|&[x, y]| [x, y, 0.0]);
    let stress_mpa = stress.iter().map(|stress| tensor(stress.components_MPa));
    add_nodal_fields(mesh, displacement_mm, stress_mpa, stress.iter().map(|stress| stress.von_mises_MPa));
}

/// Writes a mesh in the form ParaView reads.
pub(super) fn write(out: &mut dyn Write, mesh: &Mesh) -> io::Result<()> {
    let bytes = to_bytes(mesh, Format::Vtu(VtuEncoding::default())).map_err(io::Error::other)?;
    out.write_all(&bytes)
}
