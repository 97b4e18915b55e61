//! Root fillet of a tooth: of a rack on external teeth, of a shaper cutter or a circular arc on internal ones.
//!
//! Points and tangents are those of the half with x > 0 in the frame with the space's centre line on the axis y, at positive y on external teeth and
//! at negative y on internal ones, whose radii are negative.

use nalgebra::Vector2;

use super::{ring_fillet::RingFillet, root_trochoid::RootTrochoid};

/// Fillet between the root circle and the involute, with a parameter t from π/2 on the root circle to [`Self::first_angle_rad`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fillet {
    /// Trochoid of the rounded tip of a rack.
    Rack(RootTrochoid),
    /// Fillet of an internal tooth.
    Ring(RingFillet),
}

impl Fillet {
    /// Point at `t`, mm.
    pub fn point_mm(&self, t: f64) -> Vector2<f64> {
        match self {
            Self::Rack(trochoid) => trochoid.point_mm(t),
            Self::Ring(fillet) => fillet.point_mm(t),
        }
    }

    /// Unit tangent at `t`, from the root towards the flank.
    pub fn tangent(&self, t: f64) -> Vector2<f64> {
        match self {
            Self::Rack(trochoid) => trochoid.tangent(t),
            Self::Ring(fillet) => fillet.tangent(t),
        }
    }

    /// Parameter at the end of the tool's rounding; fillets of undercut teeth end before.
    pub fn first_angle_rad(&self) -> f64 {
        match self {
            Self::Rack(trochoid) => trochoid.first_angle_rad,
            Self::Ring(_) => 0.0,
        }
    }

    /// Radius of the root circle, negative on an internal gear.
    pub fn root_radius_mm(&self) -> f64 {
        match self {
            Self::Rack(trochoid) => trochoid.root_radius_mm(),
            Self::Ring(fillet) => fillet.root_radius_mm(),
        }
    }

    /// Radius of curvature of the involute where the fillet ends; `None` where the rack undercuts the tooth.
    pub fn involute_end_rho_mm(&self, transverse_pressure_angle_rad: f64) -> Option<f64> {
        match self {
            Self::Rack(trochoid) => {
                Some(trochoid.involute_end_rho_mm(transverse_pressure_angle_rad)).filter(|&rho_mm| rho_mm >= 0.0)
            }
            Self::Ring(fillet) => Some(fillet.involute_end_rho_mm()),
        }
    }
}
