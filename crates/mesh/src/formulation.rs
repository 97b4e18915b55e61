//! What the name of an element type says beyond its nodes.

use std::fmt;

use serde::{Deserialize, Serialize};

/// State of the third direction, or the physics, that the element type of a file stands for; solids and cells of files that do not say
/// it have none. Numbers are those in VTU files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[repr(u8)]
pub enum Formulation {
    /// No strain across the plane, `CPE`.
    PlaneStrain = 1,
    /// No stress across the plane, `CPS`.
    PlaneStress = 2,
    /// Half section of a body of revolution, `CAX`.
    Axisymmetric = 3,
    /// Uniform strain across the plane, `CPEG`.
    GeneralizedPlaneStrain = 4,
    /// Membrane, `M3D`.
    Membrane = 5,
    /// Shell, `S`.
    Shell = 6,
    /// Part of a rigid body, `R3D`.
    Rigid = 7,
    /// Truss in space, `T3D`.
    Truss = 8,
    /// Beam, `B2` and `B3`.
    Beam = 9,
    /// Fluid, `F3D` and `AC3D`.
    Fluid = 10,
    /// Heat conduction alone, `DC`.
    Heat = 11,
}

impl Formulation {
    /// All formulations.
    pub const ALL: [Formulation; 11] = [
        Formulation::PlaneStrain,
        Formulation::PlaneStress,
        Formulation::Axisymmetric,
        Formulation::GeneralizedPlaneStrain,
        Formulation::Membrane,
        Formulation::Shell,
        Formulation::Rigid,
        Formulation::Truss,
        Formulation::Beam,
        Formulation::Fluid,
        Formulation::Heat,
    ];

    /// The formulation with this number, `None` for 0 and others.
    pub(crate) fn numbered(number: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|own| *own as i64 == number)
    }
}

impl fmt::Display for Formulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Formulation::PlaneStrain => "plane strain",
            Formulation::PlaneStress => "plane stress",
            Formulation::Axisymmetric => "axisymmetric",
            Formulation::GeneralizedPlaneStrain => "generalized plane strain",
            Formulation::Membrane => "membrane",
            Formulation::Shell => "shell",
            Formulation::Rigid => "rigid body",
            Formulation::Truss => "truss",
            Formulation::Beam => "beam",
            Formulation::Fluid => "fluid",
            Formulation::Heat => "heat conduction",
        })
    }
}
