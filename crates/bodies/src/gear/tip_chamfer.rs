//! Tip chamfer: a straight cut of the corner between flank and tip land, on both flanks of a tooth, in the transverse section.
//!
//! ```text
//! r_Fa = r_a − h_K                                 end of the flank, where the chamfer begins
//! γ    = δ − α_Fa                                  turn of the outline at this edge, cos α_Fa = r_b/r_Fa
//! t    = √(r_a² − r_Fa² sin² δ) − r_Fa cos δ       length of the chamfer
//! ψ_K  = ψ(r_Fa) − atan(t sin δ/(r_Fa + t cos δ))  half angle of the tip land that is left
//! ```
//!
//! with h_K the radial height of the chamfer and δ the angle between the chamfer and the radius through its beginning: the note "0.5 × 45°" of a
//! drawing is h_K = 0.5 mm, δ = 45°. Radii of an internal gear are negative; its chamfer goes outwards.
//!
//! A rounding of radius ρ_k of the edge between flank and chamfer is the circle tangent to both, from ρ_k tan(γ/2) below the edge on. Seen from the
//! involute, which goes on to the tip circle, rounding and chamfer are material removed ([`super::removed_material`]).
//!
//! Source: ISO 21771, section 4 (tip form diameter d_Fa = d_a − 2 h_K); the rest is plane geometry.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Gear, PairError, tooth::Tooth};

/// Least turn of the outline at the edge of a chamfer, rad: a flatter chamfer would carry load, as a relief does.
pub const LEAST_TURN_RAD: f64 = PI / 36.0;
/// Greatest angle of a chamfer to the radius, rad.
pub const GREATEST_ANGLE_RAD: f64 = 4.0 * PI / 9.0;

/// Halvings of a range for the greatest height.
const BISECTIONS: usize = 60;

/// Tip chamfer as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipChamfer {
    /// Radial height h_K, mm.
    pub height_mm: f64,
    /// Angle δ to the radius, rad.
    pub angle_rad: f64,
}

impl Tooth {
    /// Radius at which the flank ends, mm: that of the tip circle, or of the beginning of the chamfer; roundings apart.
    pub fn edge_radius_mm(&self) -> f64 {
        self.tip_radius_mm - self.tip_chamfer.map_or(0.0, |chamfer| chamfer.height_mm)
    }

    /// Radius of curvature where the flank ends, mm.
    pub fn edge_rho_mm(&self) -> f64 {
        self.involute.curvature_radius_mm(self.edge_radius_mm())
    }

    /// Angle γ by which the outline turns at the end of the flank, towards the chamfer or the tip circle, rad.
    pub fn edge_turn_rad(&self) -> f64 {
        let to_radius_rad = self.tip_chamfer.map_or(FRAC_PI_2, |chamfer| chamfer.angle_rad);
        to_radius_rad - self.involute.pressure_angle_rad(self.edge_rho_mm())
    }

    /// Length t of the chamfer, mm; `None` without one.
    pub fn chamfer_length_mm(&self) -> Option<f64> {
        let (sin, cos) = self.tip_chamfer?.angle_rad.sin_cos();
        let edge_mm = self.edge_radius_mm();
        Some(self.involute.signed((self.tip_radius_mm.powi(2) - (edge_mm * sin).powi(2)).sqrt()) - edge_mm * cos)
    }

    /// Half angle of the tip land, between the chamfers where there are any, rad; negative, or not a number, where they meet below the tip circle.
    pub fn land_half_angle_rad(&self) -> f64 {
        let edge_mm = self.edge_radius_mm();
        let turn_rad = self.tip_chamfer.zip(self.chamfer_length_mm()).map_or(0.0, |(chamfer, length_mm)| {
            let (sin, cos) = chamfer.angle_rad.sin_cos();
            (length_mm * sin / (edge_mm + length_mm * cos)).atan()
        });
        self.half_angle_rad(edge_mm) - turn_rad
    }

    /// Refuses a chamfer that leaves no flank or no tip land, and one nearly along the flank or the tip circle.
    pub(super) fn check_chamfer(&self, gear: Gear) -> Result<(), PairError> {
        let Some(TipChamfer { height_mm, angle_rad }) = self.tip_chamfer else { return Ok(()) };
        if !self.has_room_for_chamfer(height_mm) {
            let (mut fits, mut too_large) = (0.0, height_mm);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (fits + too_large);
                if self.has_room_for_chamfer(middle) { fits = middle } else { too_large = middle }
            }
            return Err(PairError::TipChamferTooLarge { gear, height_mm, greatest_mm: fits });
        }
        let least_rad = angle_rad - self.edge_turn_rad() + LEAST_TURN_RAD;
        if (least_rad..=GREATEST_ANGLE_RAD).contains(&angle_rad) {
            return Ok(());
        }
        let [angle_deg, least_deg, greatest_deg] = [angle_rad, least_rad, GREATEST_ANGLE_RAD].map(f64::to_degrees);
        Err(PairError::TipChamferAngle { gear, angle_deg, least_deg, greatest_deg })
    }

    /// Whether a chamfer of this height leaves some flank above the form circle, and some tip land.
    fn has_room_for_chamfer(&self, height_mm: f64) -> bool {
        let tip_chamfer = self.tip_chamfer.map(|own| TipChamfer { height_mm, ..own });
        let tooth = Self { tip_chamfer, ..self.clone() };
        tooth.edge_radius_mm() > tooth.root_form_radius_mm && tooth.tip_radius_mm * tooth.land_half_angle_rad() > 0.0
    }
}
