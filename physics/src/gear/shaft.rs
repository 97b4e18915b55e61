//! Elastic twist of what carries the teeth of a gear, over the face width.
//!
//! The torque enters at one end face and leaves through the teeth along the face width. With s the distance from the driven end, F' the
//! force of all teeth per length and G J the torsional stiffness, what lies beyond s twists the body there, and the teeth give way along
//! the transverse line of action, wherever on it they touch, by
//!
//! ```text
//! u(s) = r_b²/(G J) ∫ min(s, t) F'(t) dt          J = π (d⁴ − d_i⁴)/32
//! ```
//!
//! r_b (T/2) b/(G J) at the far end under an even load. It adds to the compliance of the teeth, and is symmetric as that is.
//!
//! Source: torsion of round bars after Saint-Venant, S. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), chapter 10.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::slices::Slices;

/// An end face of a gear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EndFace {
    /// At width 0.
    #[default]
    Start,
    /// At the full face width.
    End,
}

/// The round body that carries the teeth and twists.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaft {
    /// Diameter d that twists, mm.
    pub diameter_mm: f64,
    /// Diameter d_i of its bore, mm; 0 for none.
    pub bore_diameter_mm: f64,
    /// Where the torque enters.
    pub driven_at: EndFace,
}

impl Shaft {
    /// J, mm⁴.
    pub fn polar_moment_mm4(&self) -> f64 {
        PI / 32.0 * (self.diameter_mm.powi(4) - self.bore_diameter_mm.powi(4))
    }

    /// How far the teeth give way at the end that is not driven under an even line load, mm: r_b (T/2) b/(G J).
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

    /// How far the teeth give way on average in one slice under a line load that is even in another, mm²/N, row by row, on a base circle
    /// of `base_radius_mm` and with the shear modulus `shear_modulus_mpa`.
    pub fn mm2_per_n(&self, base_radius_mm: f64, shear_modulus_mpa: f64, slices: &Slices) -> Vec<f64> {
        let width_mm = slices.slice_width_mm;
        let face_width_mm = width_mm * slices.count() as f64;
        let per_length = base_radius_mm.powi(2) / (shear_modulus_mpa * self.polar_moment_mm4());
        let from_driven_mm = |i: usize| match self.driven_at {
            EndFace::Start => slices.width_mm[i],
            EndFace::End => face_width_mm - slices.width_mm[i],
        };
        let count = slices.count();
        let mean_min = |i: usize, j: usize| match i == j {
            // The mean of min(s, t) where both lie in the same slice.
            true => from_driven_mm(i) - width_mm / 6.0,
            false => from_driven_mm(i).min(from_driven_mm(j)),
        };
        let of_pair = |place: usize| per_length * width_mm * mean_min(place / count, place % count);
        (0..count * count).map(of_pair).collect()
    }
}
