//! `solution.vtu`: the teeth in contact with displacement and stress at their nodes.

use std::io::{self, Write};

use nalgebra::Vector2;

use crate::fem::solid::Solid;
use crate::mesh::vtu::VtuEncoding;
use crate::mesh::{DataArray, Format, Mesh, Values, to_bytes};
use crate::results::fem_pair::PairSolution;

/// Writes the mesh in the form ParaView reads.
pub fn write(out: &mut dyn Write, solution: &PairSolution) -> io::Result<()> {
    let bytes = to_bytes(&mesh(solution), Format::Vtu(VtuEncoding::default())).map_err(io::Error::other)?;
    out.write_all(&bytes)
}

/// The solution as a mesh with data.
fn mesh(solution: &PairSolution) -> Mesh {
    let solid = Solid {
        points_mm: solution.points_mm.iter().map(|p| Vector2::from(*p)).collect(),
        elements: solution.elements.clone(),
    };
    let mut mesh = solid.to_mesh();
    let mut add = |name: &str, components: usize, values: Vec<f64>| {
        mesh.point_data.insert(name.to_owned(), DataArray { components, values: Values::Reals(values) });
    };
    let stress = &solution.stress;
    // A symmetric tensor in VTK's order: xx, yy, zz, xy, yz, xz.
    let tensor = |[x, y, z, xy]: [f64; 4]| [x, y, z, xy, 0.0, 0.0];
    add("displacement_mm", 3, solution.displacement_mm.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect());
    add("stress_MPa", 6, stress.iter().flat_map(|stress| tensor(stress.components_MPa)).collect());
    add("von_mises_MPa", 1, stress.iter().map(|stress| stress.von_mises_MPa).collect());
    mesh
}
