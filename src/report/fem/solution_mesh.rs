//! `solution.vtu`: the bodies with displacement, stress and contact pressure at their nodes.

use std::io::{self, Write};

use crate::mesh::vtu::VtuEncoding;
use crate::mesh::{DataArray, Format, Mesh, Values, to_bytes};
use crate::results::fem_problem::FemRecord;

/// Writes the mesh in the form ParaView reads.
pub fn write(out: &mut dyn Write, record: &FemRecord) -> io::Result<()> {
    let bytes = to_bytes(&mesh(record), Format::Vtu(VtuEncoding::default())).map_err(io::Error::other)?;
    out.write_all(&bytes)
}

/// The solution as a mesh with data.
fn mesh(record: &FemRecord) -> Mesh {
    let mut mesh = record.problem.solid.to_mesh();
    let mut add = |name: &str, components: usize, values: Vec<f64>| {
        mesh.point_data.insert(name.to_owned(), DataArray { components, values: Values::Reals(values) });
    };
    let stress = &record.stress;
    // A symmetric tensor in VTK's order: xx, yy, zz, xy, yz, xz.
    let tensor = |[x, y, z, xy]: [f64; 4]| [x, y, z, xy, 0.0, 0.0];
    add("displacement_mm", 3, record.displacement_mm.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect());
    add("stress_MPa", 6, stress.iter().flat_map(|stress| tensor(stress.components_MPa)).collect());
    add("von_mises_MPa", 1, stress.iter().map(|stress| stress.von_mises_MPa).collect());
    let mut pressure_mpa = vec![0.0; mesh.points.len()];
    for row in record.contacts.iter().flat_map(|contact| &contact.rows) {
        pressure_mpa[row.node as usize] = row.pressure_MPa;
    }
    mesh.point_data.insert("pressure_MPa".to_owned(), DataArray { components: 1, values: Values::Reals(pressure_mpa) });
    mesh
}
