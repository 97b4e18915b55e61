//! A finite-element problem of one's own: the file, its checks, and what it asks of its mesh.
//!
//! A problem file is checked twice. [`FemProblem::from_toml`] reads it by itself: names, types, ranges, and what keys say about
//! each other. [`FemProblem::on`] then looks for its groups in the mesh and makes of both what the solver takes
//! ([`gearwear_fem::problem::Problem`]), [`FemProblem::in_space_on`] of three-dimensional problems
//! ([`gearwear_fem::space::problem::SpaceProblem`]), after checks that need both: elements that belong to no body or to two, contact
//! edges inside a body, supports that contradict each other, bodies that nothing holds. Each step reports all that is wrong, at
//! its key.

mod axis;
mod bodies;
mod element_types;
mod file;
mod floating;
mod floating_in_space;
mod groups;
mod loads;
mod meshed_groups;
mod owned_cells;
mod sides;
mod size;
mod space_bodies;
mod surfaces;

use std::sync::OnceLock;

use serde_json::Value;

use super::findings::Findings;
use super::problem::{Problem, ProblemKind, number};
use super::schema::{Node, schema_of};
use super::shape::{self, FileShape};
use super::{short_hash, text, unit_slip};
use gearwear_fem as fem;
use gearwear_fem::elastic::Analysis;
use gearwear_fem::problem::ThirdDirection;
use gearwear_mesh::Mesh;
use meshed_groups::MeshedBodies;

pub use file::{Component, FemProblemFile, LoadFile};

/// Remedy for a third direction in the plane.
const IN_SPACE: &str = "z is a direction of analysis = \"three-dimensional\"";

/// The JSON schema of a problem file.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(schema_of::<FemProblemFile>)
}

/// A problem file without its mesh, checked, every default filled in.
#[derive(Debug, Clone, PartialEq)]
pub struct FemProblem {
    /// Contents of the file.
    pub file: FemProblemFile,
    /// Likely slips of unit.
    pub warnings: Vec<String>,
    /// The text it was read from, for messages about its keys.
    text: String,
}

/// A problem on its mesh: what the solver takes, and the names that go with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Posed<P> {
    /// For the solver. Its nodes are those of the mesh that belong to a body, in the mesh's order.
    pub problem: P,
    /// Groups of the bodies, numbered as the elements' materials are.
    pub bodies: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
}

impl FemProblem {
    /// Reads the text of a problem file, without its mesh.
    pub fn from_toml(text: &str) -> Result<Self, Vec<Problem>> {
        let (table, mut findings) = text::parse(text)?;
        let format = FileShape { root: Node::root(schema()), of_other_files: &[] };
        let sound = shape::check(format, &table, &mut findings);
        let file = text::typed::<FemProblemFile>(sound, &mut findings);
        match file.filter(|_| findings.problems.is_empty()) {
            Some(file) => {
                let file = choose(file, &mut findings);
                if findings.problems.is_empty() {
                    return Ok(Self { file, warnings: findings.warnings, text: text.to_owned() });
                }
                Err(findings.in_order())
            }
            None => Err(findings.in_order()),
        }
    }

    /// The problem with the analysis that the element types of `mesh` stand for, where it gives none.
    pub fn for_mesh(&self, mesh: &Mesh) -> Result<Self, Vec<Problem>> {
        let (_, mut findings) = text::parse(&self.text)?;
        let analysis = element_types::analysis(&self.file, mesh, &mut findings);
        if !findings.problems.is_empty() {
            return Err(findings.in_order());
        }
        let mut problem = self.clone();
        problem.file.analysis = Some(analysis);
        problem.warnings.append(&mut findings.warnings);
        Ok(problem)
    }

    /// A plane problem on its mesh.
    pub fn on(&self, mesh: &Mesh) -> Result<Posed<fem::problem::Problem>, Vec<Problem>> {
        self.posed(|findings| pose(&self.file, mesh, findings))
    }

    /// A three-dimensional problem on its mesh.
    pub fn in_space_on(&self, mesh: &Mesh) -> Result<Posed<fem::space::problem::SpaceProblem>, Vec<Problem>> {
        self.posed(|findings| pose_in_space(&self.file, mesh, findings))
    }

    fn posed<P>(&self, pose: impl FnOnce(&mut Findings) -> Option<P>) -> Result<Posed<P>, Vec<Problem>> {
        let (_, mut findings) = text::parse(&self.text)?;
        match pose(&mut findings) {
            Some(problem) if findings.problems.is_empty() => {
                let bodies = self.file.body.iter().map(|body| body.group.clone()).collect();
                Ok(Posed { problem, bodies, warnings: findings.warnings })
            }
            _ => Err(findings.in_order()),
        }
    }

    /// The problem that the mesh file cannot be read, because of `reason`.
    pub fn mesh_unreadable(&self, reason: &str) -> Vec<Problem> {
        match text::parse(&self.text) {
            Ok((_, mut findings)) => {
                let allowed = "a mesh file beside this one: Gmsh 4.1 or 2.2 (.msh), VTU (.vtu) or Abaqus (.inp)";
                findings.not_allowed("mesh.file", reason, allowed);
                findings.in_order()
            }
            Err(problems) => problems,
        }
    }

    /// The resolved problem as TOML.
    pub fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// First 16 hexadecimal digits of the SHA-256 of [`Self::to_toml`].
    pub fn hash(&self) -> String {
        short_hash(self.to_toml().as_bytes())
    }
}

/// Makes every choice the file leaves open, and checks what keys say about each other.
fn choose(mut file: FemProblemFile, findings: &mut Findings) -> FemProblemFile {
    file.title.get_or_insert_with(|| file.mesh.file.clone());
    let third = file.third_direction();
    if file.body.is_empty() {
        findings.missing(&["body"], "at least one [[body]] with group, young_modulus_GPa, poisson_ratio");
    }
    for (i, body) in file.body.iter().enumerate() {
        let slip = unit_slip::young_modulus(&format!("body[{i}].young_modulus_GPa"), body.young_modulus_GPa);
        findings.warnings.extend(slip.map(|slip| slip.warning()));
    }
    for (i, fixed) in file.fixed.iter_mut().enumerate() {
        components(&mut fixed.components, third, &format!("fixed[{i}].components"), findings);
    }
    for (i, load) in file.load.iter_mut().enumerate() {
        choose_load(load, third, &format!("load[{i}]"), findings);
    }
    if third.in_plane().is_none() && !file.contact.is_empty() {
        findings.not_allowed("contact", "a contact", "none: three-dimensional problems have no contact");
        findings.help("bodies that share nodes are joined");
    }
    for (i, contact) in file.contact.iter_mut().enumerate() {
        let friction = *contact.friction.get_or_insert(0.0);
        if friction != 0.0 {
            let found = format!("friction ({})", number(friction));
            findings.problem(ProblemKind::NotAvailable, &format!("contact[{i}].friction"), found, "0, no friction");
        }
        if contact.slave == contact.master {
            let found = format!("{:?}, which is the slave too", contact.master);
            findings.not_allowed(&format!("contact[{i}].master"), found, "the surface opposite the slave's");
        }
    }
    file
}

fn choose_load(load: &mut LoadFile, third: ThirdDirection, key: &str, findings: &mut Findings) {
    let displacement = format!("{key}.displacement_mm");
    // The force of such a problem, that of the others and whether it is given, and what a vector is.
    let (force, (other, is_given), vector) = match third.in_plane() {
        Some(Analysis::Axisymmetric) => {
            ("force_N", ("force_N_per_mm", load.force_N_per_mm.is_some()), "two numbers, [radial, axial]")
        }
        Some(_) => ("force_N_per_mm", ("force_N", load.force_N.is_some()), "two numbers, [x, y]"),
        None => ("force_N", ("force_N_per_mm", load.force_N_per_mm.is_some()), "three numbers, [x, y, z]"),
    };
    if is_given {
        let found = format!("{other} in a problem with analysis = {}", in_quotes(third));
        findings.not_allowed(&format!("{key}.{other}"), found, format!("{force}, {vector}"));
        if other == "force_N" {
            findings.help("forces in N are those of analysis = \"axisymmetric\" or \"three-dimensional\"");
        }
    }
    match (load.force(), &load.displacement_mm) {
        (Some((key_of_force, given)), None) => {
            if given.len() != third.directions() && key_of_force == force {
                let found = format!("a list of {} in a problem with analysis = {}", given.len(), in_quotes(third));
                findings.not_allowed(&format!("{key}.{force}"), found, vector);
            }
            if load.components.is_some() {
                findings.not_allowed(
                    &format!("{key}.components"),
                    "components of a force",
                    "components beside displacement_mm; a force that does not act has the component 0",
                );
            }
        }
        (None, Some(given)) => {
            if given.len() != third.directions() {
                let found = format!("a list of {} in a problem with analysis = {}", given.len(), in_quotes(third));
                findings.not_allowed(&displacement, found, vector);
                if given.len() == ThirdDirection::ThreeDimensional.directions() {
                    findings.help(IN_SPACE);
                }
            }
            components(&mut load.components, third, &format!("{key}.components"), findings);
        }
        (Some((force, _)), Some(_)) => {
            findings.not_allowed(
                &displacement,
                format!("a displacement beside {force}"),
                "one of the two: where the displacement is given, the force follows",
            );
        }
        (None, None) => findings.missing(&[&format!("{key}.{force}"), &displacement], vector),
    }
}

/// An analysis as the file writes it.
fn in_quotes(third: ThirdDirection) -> String {
    serde_json::to_string(&third).unwrap_or_default()
}

/// Fills in all directions; refuses none, repetitions, and in the plane z.
fn components(given: &mut Option<Vec<Component>>, third: ThirdDirection, key: &str, findings: &mut Findings) {
    let all = &Component::ALL[..third.directions()];
    let given = given.get_or_insert_with(|| all.to_vec());
    for (i, component) in given.iter().enumerate().filter(|(_, component)| !all.contains(component)) {
        let found = format!("{:?} in a problem with analysis = {}", component.name(), in_quotes(third));
        let names: Vec<String> = all.iter().map(|component| format!("{:?}", component.name())).collect();
        findings.not_allowed(&format!("{key}[{i}]"), found, names.join(" or "));
        findings.help(IN_SPACE);
    }
    let mut unique = given.clone();
    unique.sort();
    unique.dedup();
    if given.is_empty() || unique.len() != given.len() {
        let found = if given.is_empty() { "an empty list" } else { "a direction twice" };
        let allowed = match third.in_plane() {
            Some(_) => r#"["x"], ["y"] or ["x", "y"]"#,
            None => r#"one or more of "x", "y", "z""#,
        };
        findings.not_allowed(key, found, allowed);
    }
}

/// Problem on the mesh; `None` where a body is faulty, without which nothing else can be checked.
fn pose(file: &FemProblemFile, mesh: &Mesh, findings: &mut Findings) -> Option<fem::problem::Problem> {
    let groups = groups::Groups::new(mesh);
    let bodies = bodies::mesh_bodies(file, mesh, &groups, findings)?;
    let place = meshed_groups::MeshedGroups { groups: &groups, bodies: &bodies };
    size::check(file, &bodies.nodes().points_mm, findings);
    let mut problem = fem::problem::Problem {
        analysis: file.third_direction().in_plane().unwrap_or_default(),
        contacts: surfaces::contacts(file, place, findings),
        held: loads::held(file, place, findings),
        ..Default::default()
    };
    if problem.analysis == Analysis::Axisymmetric {
        axis::hold(&bodies.solid, &mut problem.held, findings);
    }
    problem.forces_n_per_mm = loads::forces(file, place, &problem.held, findings);
    problem.materials = bodies::materials(file);
    if findings.problems.is_empty() {
        floating::check(&problem, &bodies.solid, findings);
    }
    problem.solid = bodies.solid;
    Some(problem)
}

/// Problem in space.
fn pose_in_space(
    file: &FemProblemFile,
    mesh: &Mesh,
    findings: &mut Findings,
) -> Option<fem::space::problem::SpaceProblem> {
    let groups = groups::Groups::new(mesh);
    let bodies = space_bodies::mesh_bodies(file, mesh, &groups, findings)?;
    let place = meshed_groups::MeshedGroups { groups: &groups, bodies: &bodies };
    size::check(file, &bodies.nodes().points_mm, findings);
    let held = loads::held(file, place, findings);
    let forces_n = loads::forces(file, place, &held, findings);
    if findings.problems.is_empty() {
        floating_in_space::check(&bodies, &held, findings);
    }
    Some(fem::space::problem::SpaceProblem { materials: bodies::materials(file), solid: bodies.solid, held, forces_n })
}
