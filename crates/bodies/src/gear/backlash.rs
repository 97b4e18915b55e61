//! Centre distance for a given backlash.
//!
//! The transverse circumferential backlash j_wt is the pitch on the working circles less both tooth thicknesses; perpendicular to the flanks it is
//! the normal backlash j_bn:
//!
//! ```text
//! j_wt = (2a/Z) (Z inv α_wt − Σ z ψ_b + π)      cos α_wt = (r_b1 + r_b2)/a,  Z = z1 + z2
//! j_bn = j_wt cos α_wt cos β_b
//! ```
//!
//! with ψ_b half the angle of a tooth at its base circle, thickness allowance included. Without backlash and allowances
//!
//! ```text
//! inv α_wt = inv α_t + 2 tan α_n (x1 + x2)/(z1 + z2)
//! ```
//!
//! The normal backlash gives inv α_wt directly, as a cos α_wt is known; for the circumferential one, which increases with α_wt, or decreases on an
//! internal pair, the angle is found by bisection.
//!
//! Source: ISO 21771, sections 5.2 (working pressure angle) and 5.5 (backlash).

use std::f64::consts::{FRAC_PI_2, PI};

use super::involute::{inv, inverse_inv};
use super::{
    Gear, PerGear,
    spec::{GearSpec, PairSpec},
};

/// Backlash as given on a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Backlash {
    /// Circumferential backlash j_wt along the working circles, in the transverse section, mm.
    Circumferential(f64),
    /// Normal backlash j_bn, the shortest distance between the rear flanks, mm.
    Normal(f64),
}

/// Error for a backlash that the teeth have at no centre distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoSuchBacklash {
    /// Thin teeth have more at any centre distance.
    TeethTooThin {
        /// Least backlash of the given kind, mm.
        least_mm: f64,
    },
    /// An internal pair has less at any centre distance: its backlash is greatest where the base circles touch.
    TeethTooThick {
        /// Greatest backlash of the given kind, mm.
        greatest_mm: f64,
    },
}

impl PairSpec {
    /// Centre distance for a backlash, mm, independent of the given centre distance.
    pub fn centre_distance_with_mm(&self, backlash: Backlash) -> Result<f64, NoSuchBacklash> {
        let teeth = self.gears.as_ref().map(GearSpec::z);
        let alpha_t = self.transverse_pressure_angle_rad();
        let base_radii_mm = PerGear::from_fn(|gear| self.reference_radius_mm(gear) * alpha_t.cos()).sum();
        // Both teeth fill the pitch where Z inv α = Σ z ψ_b − π.
        let filled =
            (PerGear::from_fn(|gear: Gear| teeth[gear] * self.base_half_angle_rad(gear)).sum() - PI) / teeth.sum();
        let cos_base_helix = (self.helix_angle_rad.tan() * alpha_t.cos()).atan().cos();
        let angle = match backlash {
            Backlash::Normal(normal_mm) => {
                let scale = 2.0 * base_radii_mm * cos_base_helix;
                let involute = filled + normal_mm / scale;
                if involute <= 0.0 {
                    return Err(self.no_such_backlash(-scale * filled));
                }
                inverse_inv(involute)
            }
            Backlash::Circumferential(transverse_mm) => {
                let backlash_mm = |alpha: f64| 2.0 * base_radii_mm / alpha.cos() * (inv(alpha) - filled);
                // The backlash of an internal pair falls with the angle.
                let rising = base_radii_mm.signum();
                if rising * backlash_mm(0.0) >= rising * transverse_mm {
                    return Err(self.no_such_backlash(backlash_mm(0.0)));
                }
                bisect(|alpha| rising * (backlash_mm(alpha) - transverse_mm), [0.0, FRAC_PI_2])
            }
        };
        Ok(base_radii_mm / angle.cos())
    }

    /// Error with the limit of the backlash, where the base circles touch.
    fn no_such_backlash(&self, limit_mm: f64) -> NoSuchBacklash {
        match self.is_internal() {
            true => NoSuchBacklash::TeethTooThick { greatest_mm: limit_mm },
            false => NoSuchBacklash::TeethTooThin { least_mm: limit_mm },
        }
    }
}

/// Zero of an increasing function, to the last bit.
fn bisect(rising: impl Fn(f64) -> f64, [mut below, mut above]: [f64; 2]) -> f64 {
    loop {
        let middle = 0.5 * (below + above);
        if middle <= below || middle >= above {
            return below;
        }
        if rising(middle) < 0.0 {
            below = middle;
        } else {
            above = middle;
        }
    }
}
