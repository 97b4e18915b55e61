//! What the element types of a mesh say about the problem: plane strain, plane stress, axisymmetric, or something that the solver has no
//! elements for. It is obeyed where the file says nothing, and refused where they differ; it is never dropped.

use std::collections::BTreeSet;

use super::file::FemProblemFile;
use super::groups::Groups;
use crate::scene::findings::Findings;
use gearwear_fem::problem::ThirdDirection;
use gearwear_mesh::{Formulation, Mesh};

/// Analysis of a problem on `mesh`, with elements that no body can use refused, and others that none uses in warnings.
pub(super) fn analysis(file: &FemProblemFile, mesh: &Mesh, findings: &mut Findings) -> ThirdDirection {
    left_out(file, mesh, findings);
    let groups = Groups::new(mesh);
    let mut said: Option<(ThirdDirection, usize)> = None;
    for (i, body) in file.body.iter().enumerate() {
        for (formulation, name) in types(mesh, &groups, &body.group) {
            let key = format!("body[{i}].group");
            let elements = format!("{:?}, whose elements are of type {name} ({formulation})", body.group);
            match (meant(formulation), file.analysis) {
                (Meant::Analysis(own), Some(given)) if own != given && given.in_plane().is_some() => {
                    let found = format!("{} for the body {elements}", super::in_quotes(given));
                    let allowed = format!("{}, or elements of that analysis", super::in_quotes(own));
                    findings.not_allowed("analysis", found, allowed);
                }
                (Meant::Analysis(own), None) => match said {
                    Some((other, first)) if other != own => {
                        let first = &file.body[first].group;
                        let allowed =
                            format!("elements of one analysis; those of {first:?} are of {}", super::in_quotes(other));
                        findings.not_allowed(&key, elements, allowed);
                    }
                    _ if own == ThirdDirection::Axisymmetric => {
                        let said = format!("{}, as the body {elements}", super::in_quotes(own));
                        findings.missing(&["analysis"], &said);
                    }
                    _ => said = Some((own, i)),
                },
                (Meant::Sheet, None) => {
                    let allowed = format!(
                        "for the body {elements}: \"plane-stress\" or \"plane-strain\", as they are to be solved"
                    );
                    findings.missing(&["analysis"], &allowed);
                }
                (Meant::Sheet, Some(given)) if given.in_plane().is_some() => {
                    findings
                        .warnings
                        .push(format!("body {elements}: solved with analysis = {}", super::in_quotes(given)));
                }
                (Meant::Other, _) => {
                    let allowed = "elements of plane strain (CPE), plane stress (CPS), bodies of revolution (CAX), or hexahedra (C3D8, C3D20)";
                    findings.not_allowed(&key, elements, allowed);
                }
                _ => {}
            }
        }
    }
    file.analysis.or(said.map(|(own, _)| own)).unwrap_or_default()
}

/// What a formulation means for a plane problem.
enum Meant {
    /// This analysis.
    Analysis(ThirdDirection),
    /// A sheet in space, which may lie in the plane: the file says how it is solved.
    Sheet,
    /// What the solver has no elements for.
    Other,
}

fn meant(formulation: Formulation) -> Meant {
    match formulation {
        Formulation::PlaneStrain => Meant::Analysis(ThirdDirection::PlaneStrain),
        Formulation::PlaneStress => Meant::Analysis(ThirdDirection::PlaneStress),
        Formulation::Axisymmetric => Meant::Analysis(ThirdDirection::Axisymmetric),
        Formulation::Membrane | Formulation::Shell | Formulation::Rigid => Meant::Sheet,
        Formulation::GeneralizedPlaneStrain
        | Formulation::Truss
        | Formulation::Beam
        | Formulation::Fluid
        | Formulation::Heat => Meant::Other,
    }
}

/// Formulations of the cells of a group, with their element types.
fn types(mesh: &Mesh, groups: &Groups<'_>, group: &str) -> BTreeSet<(Formulation, String)> {
    let cells = groups.get(group).into_iter().flat_map(|group| group.cells.iter().flatten());
    let blocks: BTreeSet<usize> = cells.map(|&(block, _)| block).collect();
    let blocks = blocks.into_iter().map(|block| &mesh.cells[block]);
    blocks.filter_map(|block| Some((block.formulation?, block.element_type()?))).collect()
}

/// Refuses bodies with elements that the mesh has no cells for; warns of the others.
fn left_out(file: &FemProblemFile, mesh: &Mesh, findings: &mut Findings) {
    for left in &mesh.left_out {
        let elements = if left.count == 1 { "element" } else { "elements" };
        let what = format!("{} {elements} of type {} (line {} of the mesh)", left.count, left.element_type, left.line);
        let mut bodies = file.body.iter().enumerate().filter(|(_, body)| left.sets.contains(&body.group)).peekable();
        if bodies.peek().is_none() {
            findings.warnings.push(format!("{what}: left out, as no body has them"));
        }
        for (i, body) in bodies {
            let found = format!("{:?}, which holds {what}", body.group);
            let allowed = "a group of triangles or quadrilaterals, in three dimensions of hexahedra";
            findings.not_allowed(&format!("body[{i}].group"), found, allowed);
        }
    }
}
