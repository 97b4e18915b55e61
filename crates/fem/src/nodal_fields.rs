//! Displacement and stress at the nodes of a mesh as its point data, with the names of the output files.

use gearwear_mesh::Mesh;

/// Adds displacement, mm, stress (a symmetric tensor in VTK's order: xx, yy, zz, xy, yz, xz) and von Mises stress, MPa, of every node.
pub fn add_nodal_fields(
    mesh: &mut Mesh,
    displacement_mm: impl Iterator<Item = [f64; 3]>,
    stress_mpa: impl Iterator<Item = [f64; 6]>,
    von_mises_mpa: impl Iterator<Item = f64>,
) {
    mesh.add_point_data("displacement_mm", 3, displacement_mm.flatten().collect());
    mesh.add_point_data("stress_MPa", 6, stress_mpa.flatten().collect());
    mesh.add_point_data("von_mises_MPa", 1, von_mises_mpa.collect());
}
