//! Files for ParaView: meshes with numbers at their points.

use std::io::{self, Write};

use crate::mesh::vtu::VtuEncoding;
use crate::mesh::{DataArray, Format, Mesh, Values, to_bytes};
use crate::results::fem_problem::NodalStress;

pub(super) fn add(mesh: &mut Mesh, name: &str, components: usize, values: Vec<f64>) {
    mesh.point_data.insert(name.to_owned(), DataArray { components, values: Values::Reals(values) });
}

pub(super) fn add_solution(mesh: &mut Mesh, displacement_mm: &[[f64; 2]], stress: &[NodalStress]) {
    // A symmetric tensor in VTK's order: xx, yy, zz, xy, yz, xz.
    let tensor = |[x, y, z, xy]: [f64; 4]| [x, y, z, xy, 0.0, 0.0];
    add(mesh, "displacement_mm", 3, displacement_mm.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect());
    add(mesh, "stress_MPa", 6, stress.iter().flat_map(|stress| tensor(stress.components_MPa)).collect());
    add(mesh, "von_mises_MPa", 1, stress.iter().map(|stress| stress.von_mises_MPa).collect());
}

/// Writes a mesh in the form ParaView reads.
pub(super) fn write(out: &mut dyn Write, mesh: &Mesh) -> io::Result<()> {
    let bytes = to_bytes(mesh, Format::Vtu(VtuEncoding::default())).map_err(io::Error::other)?;
    out.write_all(&bytes)
}
