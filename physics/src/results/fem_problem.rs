//! Everything that a finite-element problem leaves behind, as plain data in the units of the output files: what its
//! report reads.
//!
//! Field names are the contract's column and key names, so that serialising a record is writing the file.

#![allow(non_snake_case, reason = "the contract's key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::run::StageTime;
use gearwear_fem::problem::{Problem, Stop, ThirdDirection, Work};
use gearwear_fem::space;
use gearwear_mesh::quality::MeshQuality;

/// A solved problem.
#[derive(Debug, Clone, PartialEq)]
pub struct FemRecord {
    /// Content of `summary.json`.
    pub summary: FemSummary,
    /// The resolved problem as TOML.
    pub problem_toml: String,
    /// Groups of the bodies.
    pub bodies: Vec<String>,
    /// Mesh that was solved, and what was found at its nodes.
    pub solution: FemSolution,
}

/// A problem with its fields.
#[derive(Debug, Clone, PartialEq)]
pub enum FemSolution {
    /// In the plane.
    Plane(PlaneSolution),
    /// In space.
    InSpace(SpaceSolution),
}

/// A plane problem with its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSolution {
    /// Bodies, supports, loads and surfaces as the solver took them; the material is the number of the body.
    pub problem: Problem,
    /// Displacement [x, y] of every node, mm.
    pub displacement_mm: Vec<[f64; 2]>,
    /// Stress of every node: the mean over the elements of its body, and over bodies that are joined there.
    pub stress: Vec<NodalStress>,
    /// The pressure along each contact, in the order of the summary.
    pub contacts: Vec<ContactCurve>,
}

/// A three-dimensional problem with its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceSolution {
    /// Bodies, supports and loads as the solver took them.
    pub problem: space::problem::SpaceProblem,
    /// The tables of supports and loads, in the order of the problem.
    pub boundary: Vec<BoundaryRow>,
    /// Displacement [x, y, z] of every node, mm.
    pub displacement_mm: Vec<[f64; 3]>,
    /// Stress of every node (xx, yy, zz, xy, yz, xz, the order of VTK), MPa: the mean over the elements of its body, and over bodies
    /// that are joined there.
    pub stress_MPa: Vec<[f64; 6]>,
    /// von Mises stress of every node, MPa.
    pub von_mises_MPa: Vec<f64>,
}

/// A support or a load.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryRow {
    /// Group of the mesh.
    pub group: String,
    /// Kind: held, displacement, force.
    pub what: &'static str,
    /// Unit of its values.
    pub unit: &'static str,
    /// Along x, y and z; none where the direction is free.
    pub along: [Option<f64>; 3],
}

impl FemRecord {
    /// The pressure along each contact, in the order of the summary; none in space.
    pub fn contacts(&self) -> &[ContactCurve] {
        match &self.solution {
            FemSolution::Plane(solution) => &solution.contacts,
            FemSolution::InSpace(_) => &[],
        }
    }
}

/// `summary.json` of a finite-element problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FemSummary {
    /// The user's title.
    pub title: String,
    /// Version of the program.
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved problem.
    pub problem_hash: String,
    /// The mesh.
    pub mesh: MeshSummary,
    /// Plane strain, plane stress, axisymmetric, or three-dimensional.
    pub analysis: ThirdDirection,
    /// Why the solver stopped.
    pub stopped: Stop,
    /// Degrees of freedom, supports included.
    pub dofs: usize,
    /// Elements.
    pub elements: usize,
    /// Active-set iterations; in space 1.
    pub iterations: usize,
    /// Largest unbalanced nodal force over the largest force that acts.
    pub residual: f64,
    /// Unbalance of all external forces, reactions included, over the largest of them; in space that of their moments too, over the sum of
    /// their sizes.
    pub force_balance: f64,
    /// Work done.
    pub work: Work,
    /// Stages carried out, with their times.
    pub stages: Vec<StageTime>,
    /// Time from the beginning to the end of the last stage, s.
    pub wall_s: f64,
    /// The contacts, in the order of the problem.
    pub contact: Vec<FemContactSummary>,
    /// Maximum von Mises stress at a node, MPa.
    pub peak_von_mises_MPa: f64,
    /// Further figures of three-dimensional problems.
    #[serde(flatten)]
    pub in_space: Option<InSpaceSummary>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// Where a three-dimensional problem has its greatest values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct InSpaceSummary {
    /// Where the von Mises stress is greatest, [x, y, z] in mm.
    pub peak_von_mises_at_mm: [f64; 3],
    /// Maximum displacement of a node, mm.
    pub greatest_displacement_mm: f64,
    /// Place of it, before deformation, [x, y, z] in mm.
    pub greatest_displacement_at_mm: [f64; 3],
}

/// The mesh of a problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshSummary {
    /// File, as the problem names it.
    pub file: String,
    /// First 16 hexadecimal digits of the SHA-256 of that file.
    pub hash: String,
    /// Nodes that belong to a body.
    pub nodes: usize,
    /// Worst elements; none in space.
    pub quality: Option<MeshQuality>,
}

/// Figures of one contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FemContactSummary {
    /// Group of the surface that carries the pressure.
    pub slave: String,
    /// Group of the surface opposite.
    pub master: String,
    /// Maximum pressure, MPa.
    pub peak_pressure_MPa: f64,
    /// Half-width a of the widest zone, mm.
    pub half_width_mm: f64,
    /// Length of surface under pressure in the modelled part, mm.
    pub contact_width_mm: f64,
    /// Resultant of the pressure on the slave in the modelled part, [x, y] in N/mm; in plane strain and plane stress.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_N_per_mm: Option<[f64; 2]>,
    /// Resultant of the pressure on the slave over the whole circumference, [0, along the axis] in N; of bodies of revolution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_N: Option<[f64; 2]>,
    /// Largest penetration that is left, µm.
    pub max_penetration_um: f64,
    /// Where the resultant acts, [x, y] in mm.
    pub centre_mm: [f64; 2],
    /// Whether the zone ends on a line of symmetry, so that the model holds half of it.
    pub half_model: bool,
    /// Edges of the slave along a; none where there is no contact.
    pub elements_per_half_width: Option<f64>,
    /// Hertz's line contact of the same force and curvature, on the axis of bodies of revolution his point contact; none where the surfaces
    /// are not round there.
    pub hertz: Option<HertzSummary>,
}

/// Hertz's contact that a contact compares with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HertzSummary {
    /// Relative radius of curvature R of the surfaces, fitted to their nodes, mm.
    pub relative_radius_mm: f64,
    /// a, mm.
    pub half_width_mm: f64,
    /// p₀, MPa.
    pub peak_pressure_MPa: f64,
}

/// A row of `contact.csv`: a node of a slave surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ContactRow {
    /// place of the node before deformation
    pub x_mm: f64,
    /// place of the node before deformation
    pub y_mm: f64,
    /// gap to the other surface after deformation, weighted as the contact condition is; empty where none faces the node
    pub gap_mm: Option<f64>,
    /// contact pressure
    pub pressure_MPa: f64,
    /// tangential traction: 0, the contact is frictionless
    pub traction_MPa: f64,
    #[allow(rustdoc::broken_intra_doc_links, reason = "the table of a problem file, as CSV files show it")]
    /// which [[contact]] of the problem, from 0
    pub contact: usize,
    /// place along the surface before deformation, from its first node
    pub along_mm: f64,
    /// of the node
    pub displacement_x_mm: f64,
    /// of the node
    pub displacement_y_mm: f64,
    /// number of the node in solution.vtu, from 0
    pub node: u32,
}

/// The pressure along a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactCurve {
    /// Nodes of the slave in the order of its surface.
    pub rows: Vec<ContactRow>,
    /// Place of the middle of the contact along the surface: the line of symmetry in a half model, mm.
    pub centre_along_mm: f64,
}

/// Stress at a node.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct NodalStress {
    /// σ_x, σ_y, σ_z (across the plane, of bodies of revolution the hoop stress) and τ_xy, MPa.
    pub components_MPa: [f64; 4],
    /// von Mises, MPa.
    pub von_mises_MPa: f64,
}
