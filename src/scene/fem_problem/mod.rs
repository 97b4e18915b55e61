//! A finite-element problem of one's own: the file, its checks, and what it asks of its mesh.
//!
//! A problem file is checked twice. [`FemProblem::from_toml`] reads it by itself: names, types, ranges, and what keys say
//! about each other. [`FemProblem::on`] then looks for its groups in the mesh and makes of both what the solver takes
//! ([`crate::fem::problem::Problem`]), after checks that need both: elements that belong to no body or to two, contact
//! edges inside a body, supports that contradict each other, bodies that nothing holds.
//! Each step reports all that is wrong, at its key.

mod bodies;
mod file;
mod floating;
mod groups;
mod loads;
mod meshed_groups;
mod sides;
mod surfaces;

use std::sync::OnceLock;

use serde_json::Value;

use super::findings::Findings;
use super::problem::{Problem, ProblemKind, number};
use super::schema::{Node, schema_of};
use super::shape::{self, Format};
use super::{short_hash, text, unit_slip};
use crate::fem;
use crate::mesh::Mesh;

pub(crate) use file::{BodyFile, Component, FemProblemFile, LoadFile};

/// The JSON schema of a problem file.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(schema_of::<FemProblemFile>)
}

/// A problem file without its mesh: sound as far as that goes, every default filled in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FemProblem {
    /// What it says.
    pub file: FemProblemFile,
    /// Likely slips of unit.
    pub warnings: Vec<String>,
    /// The text it was read from, for messages about its keys.
    text: String,
}

/// A problem on its mesh: what the solver takes, and the names that go with it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Posed {
    /// For the solver. Its nodes are those of the mesh that belong to a body, in the mesh's order.
    pub problem: fem::problem::Problem,
    /// Groups of the bodies, numbered as the elements' materials are.
    pub bodies: Vec<String>,
    /// What the user should know although the problem can be solved.
    pub warnings: Vec<String>,
}

impl FemProblem {
    /// Reads the text of a problem file, without its mesh.
    pub(crate) fn from_toml(text: &str) -> Result<Self, Vec<Problem>> {
        let (table, mut findings) = text::parse(text)?;
        let format = Format { root: Node::root(schema()), of_other_files: &[] };
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

    /// The problem on its mesh.
    pub(crate) fn on(&self, mesh: &Mesh) -> Result<Posed, Vec<Problem>> {
        let (_, mut findings) = text::parse(&self.text)?;
        match pose(&self.file, mesh, &mut findings) {
            Some(posed) if findings.problems.is_empty() => Ok(Posed { warnings: findings.warnings, ..posed }),
            _ => Err(findings.in_order()),
        }
    }

    /// The problem that the mesh file cannot be read, because of `reason`.
    pub(crate) fn mesh_unreadable(&self, reason: &str) -> Vec<Problem> {
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
    pub(crate) fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// First 16 hexadecimal digits of the SHA-256 of [`Self::to_toml`].
    pub(crate) fn hash(&self) -> String {
        short_hash(self.to_toml().as_bytes())
    }
}

/// Makes every choice the file leaves open, and checks what keys say about each other.
fn choose(mut file: FemProblemFile, findings: &mut Findings) -> FemProblemFile {
    file.title.get_or_insert_with(|| file.mesh.file.clone());
    file.analysis.get_or_insert_default();
    if file.body.is_empty() {
        findings.missing(&["body"], "at least one [[body]] with group, young_modulus_GPa, poisson_ratio");
    }
    for (i, body) in file.body.iter().enumerate() {
        let slip = unit_slip::young_modulus(&format!("body[{i}].young_modulus_GPa"), body.young_modulus_GPa);
        findings.warnings.extend(slip.map(|slip| slip.warning()));
    }
    for (i, fixed) in file.fixed.iter_mut().enumerate() {
        components(&mut fixed.components, &format!("fixed[{i}].components"), findings);
    }
    for (i, load) in file.load.iter_mut().enumerate() {
        choose_load(load, &format!("load[{i}]"), findings);
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

fn choose_load(load: &mut LoadFile, key: &str, findings: &mut Findings) {
    let force = format!("{key}.force_N_per_mm");
    let displacement = format!("{key}.displacement_mm");
    match (load.force_N_per_mm, load.displacement_mm) {
        (Some(_), None) => {
            if load.components.is_some() {
                findings.not_allowed(
                    &format!("{key}.components"),
                    "components of a force",
                    "components beside displacement_mm; a force that does not act has the component 0",
                );
            }
        }
        (None, Some(_)) => components(&mut load.components, &format!("{key}.components"), findings),
        (Some(_), Some(_)) => {
            findings.not_allowed(
                &displacement,
                "a displacement beside force_N_per_mm",
                "one of the two: where the displacement is given, the force follows",
            );
        }
        (None, None) => findings.missing(&[&force, &displacement], "two numbers, [x, y]"),
    }
}

/// Fills in both directions; refuses none and repetitions.
fn components(given: &mut Option<Vec<Component>>, key: &str, findings: &mut Findings) {
    let given = given.get_or_insert_with(|| Component::BOTH.to_vec());
    let mut unique = given.clone();
    unique.sort();
    unique.dedup();
    if given.is_empty() || unique.len() != given.len() {
        let found = if given.is_empty() { "an empty list" } else { "a direction twice" };
        findings.not_allowed(key, found, r#"["x"], ["y"] or ["x", "y"]"#);
    }
}

/// Everything on the mesh; `None` where a body is in doubt, without which nothing else can be checked.
fn pose(file: &FemProblemFile, mesh: &Mesh, findings: &mut Findings) -> Option<Posed> {
    let groups = groups::Groups::new(mesh);
    let meshed = bodies::mesh_bodies(file, mesh, &groups, findings)?;
    let sides = sides::Sides::of(&meshed.solid);
    let place = meshed_groups::MeshedGroups { groups: &groups, meshed: &meshed, sides: &sides };
    let mut problem = fem::problem::Problem {
        analysis: file.analysis.unwrap_or_default(),
        contacts: surfaces::contacts(file, place, findings),
        held: loads::held(file, place, findings),
        ..Default::default()
    };
    problem.forces_n_per_mm = loads::forces(file, place, &problem.held, findings);
    problem.materials = bodies::materials(file);
    if findings.problems.is_empty() {
        floating::check(&problem, &meshed, findings);
    }
    problem.solid = meshed.solid;
    Some(Posed { problem, bodies: file.body.iter().map(|body| body.group.clone()).collect(), warnings: Vec::new() })
}
