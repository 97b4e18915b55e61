//! The problem file, key by key: a mesh, and what its named groups are.
//!
//! As with the scene, these structures are the one description of the file: `gearwear schema --problem` prints their JSON
//! schema, and a file is checked against it. In the plane forces are per mm of thickness; coordinates of the mesh are in mm.

#![allow(non_snake_case, reason = "key names end in their unit as engineers write it")]

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_fem::problem::ThirdDirection;

/// Elastic bodies on a mesh of one's own, their supports, loads and contacts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "gearwear finite-element problem")]
pub struct FemProblemFile {
    /// Title of the report. Default: the name of the mesh file.
    pub title: Option<String>,
    /// What the third direction does. Default: what the mesh says (CPE, CPS), else plane-strain.
    pub analysis: Option<ThirdDirection>,
    /// The mesh.
    pub mesh: MeshFile,
    /// The bodies: every element belongs to one of them.
    pub body: Vec<BodyFile>,
    /// Where a body is held.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fixed: Vec<FixedFile>,
    /// Forces and given displacements.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub load: Vec<LoadFile>,
    /// Surfaces that may touch, in plane problems.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contact: Vec<ContactFile>,
}

/// The mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// Its file, relative to the folder of this one: Gmsh 4.1 or 2.2 (.msh), VTU or Abaqus (.inp); coordinates in mm, in
    /// plane problems z = 0.
    pub file: String,
}

/// A body: a group of elements of one material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyFile {
    /// Physical group or element set of the mesh: triangles or quadrilaterals, linear or quadratic; in three dimensions hexahedra of 8
    /// or 20 nodes.
    pub group: String,
    /// Young's modulus E in GPa, > 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub young_modulus_GPa: f64,
    /// Poisson's ratio ν, above −1 and below 0.5.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: f64,
}

/// Where a body is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixedFile {
    /// Group of the mesh: points, lines or surfaces, or a set of nodes.
    pub group: String,
    /// Directions that are held. Default: all.
    pub components: Option<Vec<Component>>,
}

/// A direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Component {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z, in three dimensions.
    Z,
}

/// A force or a given displacement: one of the two.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadFile {
    /// Group of the mesh: lines, in three dimensions quadrilaterals that are faces of elements, or points for a force; any group for a
    /// displacement.
    pub group: String,
    /// Resultant force [x, y] over the group in N per mm of thickness, in plane problems: spread evenly over its lines as a uniform
    /// traction, or shared evenly by its points.
    pub force_N_per_mm: Option<[f64; 2]>,
    /// Resultant force [x, y, z] over the group in N, in three dimensions: spread evenly over its quadrilaterals as a uniform
    /// traction, or shared evenly by its points. Axisymmetric: [radial, axial], whole circumference.
    #[schemars(length(min = 2, max = 3))]
    pub force_N: Option<Vec<f64>>,
    /// Displacement of the whole group in mm: [x, y], in three dimensions [x, y, z].
    #[schemars(length(min = 2, max = 3))]
    pub displacement_mm: Option<Vec<f64>>,
    /// Directions in which the displacement is given; the others stay free. Default: all.
    pub components: Option<Vec<Component>>,
}

/// Two surfaces that may touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactFile {
    /// Group of lines, or set of nodes, on the surface that carries the contact pressure: the finer or softer one.
    pub slave: String,
    /// Group of lines, or set of nodes, on the surface it may touch.
    pub master: String,
    /// Coefficient of friction. This version knows frictionless contact only: 0. Default 0.
    #[schemars(range(min = 0))]
    pub friction: Option<f64>,
}

impl Component {
    /// All, in the order of their numbers.
    pub const ALL: [Component; 3] = [Component::X, Component::Y, Component::Z];

    /// 0 along x, 1 along y, 2 along z.
    pub fn index(self) -> usize {
        match self {
            Component::X => 0,
            Component::Y => 1,
            Component::Z => 2,
        }
    }

    /// `x`, `y` or `z`.
    pub fn name(self) -> &'static str {
        match self {
            Component::X => "x",
            Component::Y => "y",
            Component::Z => "z",
        }
    }
}

impl LoadFile {
    /// The force with its key; `None` where a displacement is given.
    pub fn force(&self) -> Option<(&'static str, &[f64])> {
        let plane = self.force_N_per_mm.as_ref().map(|force| ("force_N_per_mm", &force[..]));
        plane.or(self.force_N.as_ref().map(|force| ("force_N", &force[..])))
    }
}

impl FemProblemFile {
    /// State of stress or strain in the third direction.
    pub fn third_direction(&self) -> ThirdDirection {
        self.analysis.unwrap_or_default()
    }

    /// The problem as TOML text.
    pub fn to_toml(&self) -> String {
        // Plain structs with text keys: nothing in them that TOML could not express.
        toml::to_string(self).expect("a problem file is always expressible in TOML")
    }
}
