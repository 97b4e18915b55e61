//! The axis of a body of revolution: no node has a negative radius, and nodes on the axis stay there.

use nalgebra::Vector2;

use super::file::Component;
use super::meshed_groups::place;
use crate::scene::findings::Findings;
use gearwear_fem::problem::Held;
use gearwear_fem::solid::Solid;

/// Moves nodes within `tolerance_mm` of the axis onto it; refuses those beyond.
pub(super) fn check(points_mm: &mut [Vector2<f64>], tolerance_mm: f64, findings: &mut Findings) {
    for point in points_mm.iter_mut().filter(|point| point.x.abs() <= tolerance_mm) {
        point.x = 0.0;
    }
    if let Some(beyond) = points_mm.iter().find(|point| point.x < 0.0) {
        let found = format!("a node at {}", place(beyond.as_slice()));
        findings.not_allowed(
            "mesh.file",
            found,
            "x ≥ 0, which is the radius in a problem with analysis = \"axisymmetric\"",
        );
    }
}

/// Holds nodes on the axis along the radius; refuses other displacements of them.
pub(super) fn hold(solid: &Solid, held: &mut Vec<Held>, findings: &mut Findings) {
    let on_axis = (0..).zip(&solid.points_mm).filter(|(_, point)| point.x == 0.0);
    for (node, point) in on_axis {
        let dof = 2 * node + Component::X.index() as u32;
        match held.binary_search_by_key(&dof, |held| held.dof) {
            Ok(at) if held[at].displacement_mm != 0.0 => {
                let found = format!("a displacement along x of the node at {}, on the axis", place(point.as_slice()));
                findings.not_allowed("load", found, "none: a body of revolution has no hole that opens there");
                return;
            }
            Ok(_) => {}
            Err(at) => held.insert(at, Held { dof, displacement_mm: 0.0 }),
        }
    }
}
