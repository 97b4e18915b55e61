//! Inspection dimensions of a gear: span over teeth, and diametral dimension over balls or pins.
//!
//! With the generating profile shift x_E, which includes the tooth thickness allowance, and ψ_b half the tooth's angle at the base circle:
//!
//! ```text
//! W_k  = m_n cos α_n [(k − ½) π + z inv α_t] + 2 x_E m_n sin α_n          k teeth spanned; touches at ρ = ½ W_k cos β_b
//! k    ≈ (z/π) [tan α_Vt / cos² β_b − 2 x_E tan α_n / z − inv α_t] + ½     α_Vt: pressure angle on d_V = d + 2 x_E m_n
//!
//! inv α_Kt = D_M/(d_b cos β_b) − (π/z − ψ_b)                               D_M: ball diameter; touches at ρ = r_b tan α_Kt − ½ D_M cos β_b
//! M_dK = d_b/cos α_Kt · (1, or cos(π/2z) of an odd number of teeth) + D_M
//! ```
//!
//! On spur gears, and on helical gears with an even number of teeth, the dimension over pins M_dR is the same.
//!
//! Source: ISO 21771, sections 6.2 (span) and 6.4 (balls and pins); ball diameters 1.728 m_n and, of long addenda, 1.92 m_n after Van Keuren.

use std::f64::consts::PI;

use super::involute::{inv, inverse_inv};
use super::{Gear, GearPair};

/// Ball diameters in normal modules; the first that extends beyond the tip circle and touches the flanks is taken.
const BALLS_MODULES: [f64; 2] = [1.728, 1.92];

/// Span measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Number of spanned teeth k.
    pub teeth: u32,
    /// Span W_k, mm.
    pub span_mm: f64,
}

/// Diametral dimension over two balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverBalls {
    /// Ball diameter D_M, mm.
    pub ball_diameter_mm: f64,
    /// Diametral dimension M_dK, mm.
    pub dimension_mm: f64,
}

impl GearPair {
    /// Span W_k over the number of teeth with contact nearest to the middle of the flanks; `None` where no span touches both flanks
    /// between form circle and tip circle, or the face width is too small for the helix (b < W_k sin β_b).
    pub fn span(&self, gear: Gear) -> Option<Span> {
        let (spec, tooth) = (&self.spec, &self.teeth[gear]);
        let z = tooth.z();
        let (m_n, alpha_n, alpha_t) =
            (spec.normal_module_mm, spec.normal_pressure_angle_rad, spec.transverse_pressure_angle_rad());
        let (sin_base_helix, cos_base_helix) = self.base_helix_angle_rad().sin_cos();
        let shift_mm = spec.generating_shift_mm(gear);
        let middle_rho_mm = tooth.involute.curvature_radius_mm(tooth.reference_radius_mm + shift_mm);
        let tan_middle = middle_rho_mm / tooth.involute.base_radius_mm;
        let wanted = z / PI
            * (tan_middle / cos_base_helix.powi(2) - 2.0 * shift_mm / m_n * alpha_n.tan() / z - inv(alpha_t))
            + 0.5;
        let nearest = wanted.round().max(1.0) as u32;
        let candidates = [nearest, nearest + 1, nearest.saturating_sub(1)];
        candidates.into_iter().filter(|teeth| (1..tooth.teeth).contains(teeth)).find_map(|teeth| {
            let span_mm = m_n * alpha_n.cos() * ((f64::from(teeth) - 0.5) * PI + z * inv(alpha_t))
                + 2.0 * shift_mm * alpha_n.sin();
            let rho_mm = 0.5 * span_mm * cos_base_helix;
            let touches = (tooth.root_form_rho_mm()..=tooth.edge_rho_mm()).contains(&rho_mm)
                && spec.face_width_mm >= span_mm * sin_base_helix.abs();
            touches.then_some(Span { teeth, span_mm })
        })
    }

    /// Dimension M_dK over balls of 1.728, else 1.92 normal modules; `None` where neither touches the flanks between form circle and tip
    /// circle and extends beyond the latter. Between internal teeth it is negative.
    pub fn over_balls(&self, gear: Gear) -> Option<OverBalls> {
        BALLS_MODULES.into_iter().find_map(|modules| {
            let ball_diameter_mm = modules * self.spec.normal_module_mm;
            let dimension_mm = self.dimension_over_balls_mm(gear, ball_diameter_mm)?;
            Some(OverBalls { ball_diameter_mm, dimension_mm })
        })
    }

    /// Dimension M_dK over balls of a diameter, mm, negative between internal teeth; `None` where they do not touch the flanks between form circle and
    /// tip circle or do not extend beyond the latter.
    pub fn dimension_over_balls_mm(&self, gear: Gear, ball_diameter_mm: f64) -> Option<f64> {
        let tooth = &self.teeth[gear];
        let base_mm = tooth.involute.base_radius_mm;
        let cos_base_helix = self.base_helix_angle_rad().cos();
        let half_pitch = PI / tooth.z();
        let odd = if tooth.teeth % 2 == 1 { (0.5 * half_pitch).cos() } else { 1.0 };
        let involute = 0.5 * ball_diameter_mm / (base_mm * cos_base_helix) - (half_pitch - tooth.base_half_angle_rad);
        let alpha = inverse_inv(involute);
        let rho_mm = base_mm * alpha.tan() - 0.5 * ball_diameter_mm * cos_base_helix;
        let centre_mm = base_mm / alpha.cos();
        let touches = involute > 0.0
            && (tooth.root_form_rho_mm()..=tooth.edge_rho_mm()).contains(&rho_mm)
            && centre_mm + 0.5 * ball_diameter_mm > tooth.tip_radius_mm;
        touches.then_some(2.0 * centre_mm * odd + ball_diameter_mm)
    }

    /// Tip form radius d_Fa/2, at the tip circle or where chamfer or rounding of the edge begin, mm.
    pub fn tip_form_radius_mm(&self, gear: Gear) -> f64 {
        self.teeth[gear].involute.radius_mm(self.rounding_start_rho_mm(gear))
    }

    /// Specific sliding ζ_f at the start of active profile; `None` where that lies on the base circle.
    pub fn specific_sliding_at_root(&self, gear: Gear) -> Option<f64> {
        let position_mm = self.path.rho_mm(gear, self.active_start_rho_mm(gear));
        Some(self.path.specific_sliding(gear, position_mm)).filter(|sliding| sliding.is_finite())
    }
}
