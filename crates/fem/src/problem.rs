//! Static problem of elastic bodies in contact, and its solution.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::elastic::{Analysis, Elastic};
use super::solid::Solid;

/// Assumption about the third direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ThirdDirection {
    /// No strain across the plane: a long body, a wide gear.
    #[default]
    PlaneStrain,
    /// No stress across the plane: a thin sheet.
    PlaneStress,
    /// Half section of a body of revolution: x the radius, y the axis.
    Axisymmetric,
    /// Three-dimensional bodies of hexahedra, without contact.
    ThreeDimensional,
}

/// Edge of an element on the surface of a body, the body on its left; linear (two nodes) or quadratic (ends, middle).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// First and last node.
    pub ends: [u32; 2],
    /// Middle node of a quadratic edge.
    pub middle: Option<u32>,
}

impl ThirdDirection {
    /// Plane analysis; `None` in three dimensions.
    pub fn in_plane(self) -> Option<Analysis> {
        match self {
            Self::PlaneStrain => Some(Analysis::PlaneStrain),
            Self::PlaneStress => Some(Analysis::PlaneStress),
            Self::Axisymmetric => Some(Analysis::Axisymmetric),
            Self::ThreeDimensional => None,
        }
    }

    /// Number of degrees of freedom of a node.
    pub fn directions(self) -> usize {
        if self == Self::ThreeDimensional { 3 } else { 2 }
    }
}

/// Two surfaces that may touch; the slave has the multipliers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactPair {
    /// Edges with the contact pressure, the finer or softer surface.
    pub slave: Vec<Edge>,
    /// Edges that these may touch.
    pub master: Vec<Edge>,
}

/// Degree of freedom with a given displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// Degree of freedom `d · node + component`, with d = 2 or 3 dimensions.
    pub dof: u32,
    /// Given displacement, mm.
    pub displacement_mm: f64,
}

/// Bodies, supports, loads and contacts; forces are per mm of thickness, of bodies of revolution those of the whole circumference.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Problem {
    /// Plane strain, plane stress or axisymmetric.
    pub analysis: Analysis,
    /// Elastic bodies.
    pub solid: Solid,
    /// Materials, as numbered by the elements.
    pub materials: Vec<Elastic>,
    /// Supports and given displacements; no degree of freedom twice.
    pub held: Vec<Held>,
    /// Nodal forces, one for each degree of freedom, N/mm.
    pub forces_n_per_mm: Vec<f64>,
    /// Surfaces that may touch.
    pub contacts: Vec<ContactPair>,
}

/// Node of a slave surface in the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNode {
    /// Number of the node.
    pub node: u32,
    /// Coordinates before deformation, mm.
    pub at_mm: Vector2<f64>,
    /// Weighted gap of the multiplier, mm; NaN where the node does not face the master.
    pub gap_mm: f64,
    /// Contact pressure, the multiplier, MPa.
    pub pressure_mpa: f64,
}

/// Contact of one pair of surfaces in the solution.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactState {
    /// Nodes of the slave in the order of its surface.
    pub nodes: Vec<ContactNode>,
    /// Resultant of the pressure on the slave, N/mm; of bodies of revolution its part along the axis, N.
    pub force_n_per_mm: Vector2<f64>,
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Length of surface under pressure, mm; the sum of several zones.
    pub contact_width_mm: f64,
    /// Half-width a of the widest zone: half its length, or its whole length where it ends on a symmetry line.
    pub half_width_mm: f64,
    /// Point of action of the resultant on the surface, mm.
    pub centre_mm: Vector2<f64>,
    /// Greatest penetration of the deformed surfaces at an integration point, mm; it falls with the size of the elements.
    pub max_penetration_mm: f64,
}

/// Reason why the solver stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stop {
    /// Every multiplier and every gap has the right sign.
    Converged,
    /// Converged after a cycle of active sets was broken.
    ConvergedAfterCycle,
}

/// Counts of the work done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Work {
    /// Active-set iterations.
    pub iterations: usize,
    /// Nodes that entered or left the active set in all iterations.
    pub active_set_changes: usize,
    /// Cycles of the active set that were broken.
    pub cycles_broken: usize,
    /// Sparse factorisations.
    pub factorisations: usize,
    /// Right-hand sides.
    pub right_hand_sides: usize,
}

/// Solution of a problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Displacement of every degree of freedom, mm.
    pub displacement_mm: Vec<f64>,
    /// Contacts, one for each pair of surfaces.
    pub contacts: Vec<ContactState>,
    /// Reason why the solver stopped.
    pub stop: Stop,
    /// Work done.
    pub work: Work,
    /// Largest unbalanced nodal force over the largest nodal force.
    pub residual: f64,
    /// Unbalance of all external forces, reactions included, over the largest of them.
    pub force_balance: f64,
}
