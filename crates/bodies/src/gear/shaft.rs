//! Elastic twist of a gear's shaft over the face width.
//!
//! The torque enters at one end face and leaves through the teeth along the face width. With s the distance from the driven end, F' the
//! force of all teeth per length and G J the torsional stiffness, the torque beyond s twists the shaft there, and the teeth are displaced along
//! the transverse line of action by
//!
//! ```text
//! u(s) = r_b²/(G J) ∫ min(s, t) F'(t) dt          J = π (d⁴ − d_i⁴)/32
//! ```
//!
//! which is r_b (T/2) b/(G J) at the far end under an even load. It is a symmetric addition to the compliance of the teeth.
//!
//! Source: torsion of round bars after Saint-Venant, S. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), chapter 10.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::{
    shaft_bearings::{ShaftBeam, ShaftBearings, ToothForceDirection},
    slices::Slices,
};

/// End face of a gear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EndFace {
    /// At width 0.
    #[default]
    Start,
    /// At the full face width.
    End,
}

/// Round shaft that carries the teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaft {
    /// Outer diameter d, mm.
    pub diameter_mm: f64,
    /// Bore diameter d_i, mm; 0 for none.
    pub bore_diameter_mm: f64,
    /// End face at which the torque enters.
    pub driven_at: EndFace,
    /// Bearings; `None` where they are left out, and the shaft stays straight and parallel.
    pub bearings: Option<ShaftBearings>,
}

impl Shaft {
    /// Polar moment J, mm⁴.
    pub fn polar_moment_mm4(&self) -> f64 {
        PI / 32.0 * (self.diameter_mm.powi(4) - self.bore_diameter_mm.powi(4))
    }

    /// The shaft as a beam on its bearings, of Young's modulus `young_modulus_mpa`; `None` without bearings.
    pub fn beam(&self, direction: ToothForceDirection, young_modulus_mpa: f64) -> Option<ShaftBeam> {
        // I = J/2.
        let bending_stiffness_n_mm2 = 0.5 * young_modulus_mpa * self.polar_moment_mm4();
        self.bearings.map(|bearings| ShaftBeam { bearings, bending_stiffness_n_mm2, direction })
    }

    /// Displacement r_b (T/2) b/(G J) of the teeth at the end that is not driven under an even line load, mm.
    pub fn twist_mm(
        &self,
        base_radius_mm: f64,
        shear_modulus_mpa: f64,
        face_width_mm: f64,
        line_load_n_per_mm: f64,
    ) -> f64 {
        let half_torque_n_mm = 0.5 * base_radius_mm * face_width_mm * line_load_n_per_mm;
        base_radius_mm * half_torque_n_mm * face_width_mm / (shear_modulus_mpa * self.polar_moment_mm4())
    }

    /// Mean displacement of the teeth in one slice per even line load in another, mm²/N, row by row, on a base circle
    /// of `base_radius_mm` and with the shear modulus `shear_modulus_mpa`.
    pub fn mm2_per_n(&self, base_radius_mm: f64, shear_modulus_mpa: f64, slices: &Slices) -> Vec<f64> {
        let width_mm = slices.slice_width_mm;
        let face_width_mm = width_mm * slices.count() as f64;
        let per_length = base_radius_mm.powi(2) / (shear_modulus_mpa * self.polar_moment_mm4());
        let from_driven_mm: Vec<f64> = (slices.width_mm.iter())
            .map(|z| if self.driven_at == EndFace::Start { *z } else { face_width_mm - z })
            .collect();
        let mut compliance = Vec::with_capacity(slices.count() * slices.count());
        for (i, s) in from_driven_mm.iter().enumerate() {
            for (j, t) in from_driven_mm.iter().enumerate() {
                // Mean of min(s, t) over both slices.
                let mean_min_mm = if i == j { s - width_mm / 6.0 } else { s.min(*t) };
                compliance.push(per_length * width_mm * mean_min_mm);
            }
        }
        compliance
    }
}
