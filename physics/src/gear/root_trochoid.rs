//! The root fillet that the rounded tip of the generating rack cuts.
//!
//! The rack of the tool is rounded with radius ρ_fP between its straight flank and its flat bottom. In the transverse
//! section the circle of the normal section is stretched to an ellipse by 1/cos β. A rack point (u across, v below the
//! datum line) with normal (n_u, n_v) touches the gear when that normal passes through the pitch point, that is, with
//! the pitch line at v = x m_n, after the rack has moved by
//!
//! ```text
//! s(t) = (v − x m_n) n_u / n_v − u
//! ```
//!
//! and then lies at ((v − x m_n) n_u/n_v, r − (v − x m_n)) seen from the gear's axis; turning back by s/r gives the
//! point on the gear. The parameter t is the normal's angle in the normal section: α_n where the rounding leaves the
//! straight flank, π/2 on the root circle.
//!
//! Source: F. L. Litvin, *Gear Geometry and Applied Theory* (2004), section 13 (generation by rack, undercut).

use nalgebra::{Rotation2, Vector2};

/// The fillet of one gear, in the frame where the space's centre line is the +y axis; the half with x > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootTrochoid {
    reference_radius_mm: f64,
    /// x m_n.
    shift_mm: f64,
    cos_beta: f64,
    /// Centre of the rounding in the normal section, from the tool tooth's centre line and from the datum line.
    centre_mm: Vector2<f64>,
    fillet_radius_mm: f64,
    /// α_n, where the rounding begins.
    pub first_angle_rad: f64,
}

/// What the generating rack needs to be known of for the fillet, in the normal section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RackTip {
    /// m_n.
    pub normal_module_mm: f64,
    /// α_n.
    pub normal_pressure_angle_rad: f64,
    /// β.
    pub helix_angle_rad: f64,
    /// h_fP* and ρ_fP*.
    pub dedendum_factor: f64,
    /// ρ_fP*.
    pub fillet_radius_factor: f64,
}

/// Largest ρ_fP* that still leaves a tip of a rack given by α_n and h_fP*: there the two roundings meet on the centre line. Negative where
/// the flanks meet above the dedendum, so that no rounding leaves one.
pub fn greatest_fillet_radius_factor(normal_pressure_angle_rad: f64, dedendum_factor: f64) -> f64 {
    let alpha = normal_pressure_angle_rad;
    (std::f64::consts::FRAC_PI_4 - dedendum_factor * alpha.tan()) / (1.0 / alpha.cos() - alpha.tan())
}

/// Largest h_fP* that leaves a rack of pressure angle α_n a tip, without rounding: there its flanks meet, (π/4)/tan α_n.
pub fn greatest_dedendum_factor(normal_pressure_angle_rad: f64) -> f64 {
    std::f64::consts::FRAC_PI_4 / normal_pressure_angle_rad.tan()
}

impl RootTrochoid {
    /// The fillet cut by `rack` at profile shift x m_n = `shift_mm` on a gear of transverse reference radius r.
    pub fn new(rack: &RackTip, reference_radius_mm: f64, shift_mm: f64) -> Self {
        let alpha = rack.normal_pressure_angle_rad;
        let radius = rack.fillet_radius_factor * rack.normal_module_mm;
        let depth = rack.dedendum_factor * rack.normal_module_mm - radius;
        let across = std::f64::consts::FRAC_PI_4 * rack.normal_module_mm - depth * alpha.tan() - radius / alpha.cos();
        Self {
            reference_radius_mm,
            shift_mm,
            cos_beta: rack.helix_angle_rad.cos(),
            centre_mm: Vector2::new(across, depth),
            fillet_radius_mm: radius,
            first_angle_rad: alpha,
        }
    }

    /// Rack point, transverse: (u, v − x m_n, n_u / n_v).
    fn rack_point(&self, t: f64) -> (f64, f64, f64) {
        let (sin, cos) = t.sin_cos();
        let u = (self.centre_mm.x + self.fillet_radius_mm * cos) / self.cos_beta;
        let below_pitch_line = self.centre_mm.y + self.fillet_radius_mm * sin - self.shift_mm;
        (u, below_pitch_line, cos * self.cos_beta / sin)
    }

    /// The generated point for normal angle `t` (from [`Self::first_angle_rad`] to π/2), mm.
    pub fn point_mm(&self, t: f64) -> Vector2<f64> {
        let (u, depth, slope) = self.rack_point(t);
        let displacement = depth * slope - u;
        Rotation2::new(displacement / self.reference_radius_mm)
            * Vector2::new(depth * slope, self.reference_radius_mm - depth)
    }

    /// Unit tangent of the fillet at `t`, pointing from the root towards the flank.
    ///
    /// The generated curve has the rack's own normal at the moment of contact, so the tangent is the rack's, turned.
    pub fn tangent(&self, t: f64) -> Vector2<f64> {
        let (u, depth, slope) = self.rack_point(t);
        let displacement = depth * slope - u;
        // Rack normal ∝ (n_u, −n_v) in the gear's axes; the tangent is perpendicular to it, outward.
        let along_rack = Vector2::new(1.0, slope).normalize();
        Rotation2::new(displacement / self.reference_radius_mm) * along_rack
    }

    /// Radius of the root circle.
    pub fn root_radius_mm(&self) -> f64 {
        self.reference_radius_mm + self.shift_mm - self.centre_mm.y - self.fillet_radius_mm
    }

    /// Radius of curvature ρ at which the straight flank of the rack ends on the line of action: the lower end of the
    /// generated involute; negative: the gear is undercut.
    pub fn involute_end_rho_mm(&self, transverse_pressure_angle_rad: f64) -> f64 {
        let (_, depth, _) = self.rack_point(self.first_angle_rad);
        let sin = transverse_pressure_angle_rad.sin();
        self.reference_radius_mm * sin - depth / sin
    }
}
