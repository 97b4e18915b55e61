//! Three-dimensional working flank of a tooth in mesh.
//!
//! Frame: the pinion's axis is z, the wheel's is parallel to it through (0, a); z runs from 0 to the face width b. The pinion
//! turns anticlockwise about z, the wheel clockwise, and the line of action runs from T1 to T2:
//!
//! ```text
//! T1 = r_b1 (sin α_wt, cos α_wt)        T2 = (0, a) − r_b2 (sin α_wt, cos α_wt)
//! ```
//!
//! A section at z is an involute: a string of length ρ unwound anticlockwise from the base circle. At the contact with
//! the mate the string lies on the line of action, at the polar angle θ_T of T1 or T2; the string of every other point is turned by its
//! difference in length,
//!
//! ```text
//! P(ρ, z) = axis + r_b e_r(θ) + ρ e_t(θ)        θ = θ_T − (ρ − ρ_c(z)) / r_b        θ_T1 = π/2 − α_wt,  θ_T2 = −π/2 − α_wt
//! ρ_c1(z) = ξ + (b/2 − z) tan β_b               ρ_c2(z) = T1T2 − ρ_c1(z)
//! ```
//!
//! with e_r, e_t the radial and the tangential unit vector at θ, and ξ the position of the tooth in the middle of the face
//! width. e_t is the section's normal out of the tooth. For a positive helix angle sections at larger z follow behind those at
//! z = 0 (see [`super::slices`]): the pinion's teeth are left-handed and the wheel's right-handed.
//!
//! Source: ISO 21771, sections 4.3 and 5.5.

use std::f64::consts::FRAC_PI_2;

use serde::{Deserialize, Serialize};

use super::{Gear, GearPair};

/// Working flank of a tooth of one gear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlankSurface {
    /// Gear of the tooth.
    pub gear: Gear,
    /// Base radius r_b.
    pub base_radius_mm: f64,
    /// Tangent of the base helix angle β_b.
    pub base_helix_tangent: f64,
    /// Face width b.
    pub face_width_mm: f64,
    /// Coordinate y of the gear's axis, 0 or a.
    pub axis_y_mm: f64,
    /// Polar angle θ_T at which the line of action touches the base circle.
    pub tangent_point_rad: f64,
    /// Length T1T2.
    pub line_of_action_mm: f64,
}

/// Unit vectors along the radius and across it, anticlockwise, at a polar angle.
fn unit_vectors(angle_rad: f64) -> [[f64; 2]; 2] {
    let (sin, cos) = angle_rad.sin_cos();
    [[cos, sin], [-sin, cos]]
}

impl FlankSurface {
    /// Working flank of `gear`.
    pub fn new(pair: &GearPair, gear: Gear) -> Self {
        let (axis_y_mm, below) = match gear {
            Gear::Pinion => (0.0, FRAC_PI_2),
            Gear::Wheel => (pair.spec.centre_distance_mm, -FRAC_PI_2),
        };
        Self {
            gear,
            base_radius_mm: pair.path.involute[gear].base_radius_mm,
            base_helix_tangent: pair.base_helix_angle_rad().tan(),
            face_width_mm: pair.spec.face_width_mm,
            axis_y_mm,
            tangent_point_rad: below - pair.working_pressure_angle_rad,
            line_of_action_mm: pair.path.line_of_action_mm,
        }
    }

    /// Radius of curvature ρ_c of this flank on the line of contact at z = `width_mm`, with the tooth at `position_mm` in
    /// the middle of the face width.
    pub fn contact_rho_mm(&self, position_mm: f64, width_mm: f64) -> f64 {
        let pinion = position_mm + (0.5 * self.face_width_mm - width_mm) * self.base_helix_tangent;
        match self.gear {
            Gear::Pinion => pinion,
            Gear::Wheel => self.line_of_action_mm - pinion,
        }
    }

    /// Polar angle at which the string of a point touches the base circle.
    fn string_rad(&self, rho_mm: f64, width_mm: f64, position_mm: f64) -> f64 {
        self.tangent_point_rad - (rho_mm - self.contact_rho_mm(position_mm, width_mm)) / self.base_radius_mm
    }

    /// Point with radius of curvature `rho_mm` at z = `width_mm`, with the tooth at `position_mm`.
    pub fn point_mm(&self, rho_mm: f64, width_mm: f64, position_mm: f64) -> [f64; 3] {
        let [radial, tangential] = unit_vectors(self.string_rad(rho_mm, width_mm, position_mm));
        let [x, y] = [0, 1].map(|axis| self.base_radius_mm * radial[axis] + rho_mm * tangential[axis]);
        [x, self.axis_y_mm + y, width_mm]
    }

    /// Unit normal of the transverse section at that point, out of the tooth, along which wear and modifications are measured.
    pub fn transverse_normal(&self, rho_mm: f64, width_mm: f64, position_mm: f64) -> [f64; 3] {
        let [_, [x, y]] = unit_vectors(self.string_rad(rho_mm, width_mm, position_mm));
        [x, y, 0.0]
    }

    /// Radius of curvature at `radius_mm`.
    pub fn rho_mm(&self, radius_mm: f64) -> f64 {
        super::involute::Involute { base_radius_mm: self.base_radius_mm }.curvature_radius_mm(radius_mm)
    }
}
