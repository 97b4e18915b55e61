//! Conjugate flanks in rolling and sliding contact, as contact models use them.
//!
//! A *position* is that of the theoretical contact point on its path; a *coordinate* is that of a point on one flank. For gears
//! these are the pinion's radius of curvature and each flank's own radius of curvature
//! ([`GearPair`]). In the tangent frame of a position, `along` is measured on the common
//! tangent towards increasing coordinate and `drop` is the distance of the surface behind the tangent: the gap between the
//! flanks is the sum of both drops, exact at any distance.

use super::{Gear, GearPair, involute::TangentFramePoint};

/// Two surfaces in rolling and sliding line contact.
pub trait ConjugateFlanks: Sync {
    /// Coordinate of a gear's flank at the theoretical contact point.
    fn contact_coordinate_mm(&self, gear: Gear, position_mm: f64) -> f64;

    /// Position at which a flank point is the theoretical contact point.
    fn position_at_mm(&self, gear: Gear, coordinate_mm: f64) -> f64;

    /// Flank point in the tangent frame of `position_mm`.
    fn in_tangent_frame(&self, gear: Gear, coordinate_mm: f64, position_mm: f64) -> TangentFramePoint;

    /// Coordinate and drop of the flank point at `along_mm` in the tangent frame of `position_mm`.
    fn at_along(&self, gear: Gear, along_mm: f64, position_mm: f64) -> (f64, f64);

    /// First and last coordinate of a gear's flank.
    fn flank_limits_mm(&self, gear: Gear) -> (f64, f64);

    /// Radius of curvature of a gear's flank at the theoretical contact point.
    fn curvature_radius_mm(&self, gear: Gear, position_mm: f64) -> f64;

    /// Ratio of the speed of the contact point over a gear's flank to that of the position.
    fn rolling_ratio(&self, gear: Gear, position_mm: f64) -> f64;

    /// Sliding distance ∫ |v_s| dt while the contact moves from one position to another.
    fn sliding_mm(&self, from_mm: f64, to_mm: f64) -> f64;

    /// Distance from the flank to the tooth's centre line along the normal of the contact.
    fn depth_mm(&self, gear: Gear, position_mm: f64) -> f64;

    /// Relative radius of curvature R: 1/R = 1/ρ1 + 1/ρ2.
    fn relative_radius_mm(&self, position_mm: f64) -> f64 {
        let rho = Gear::BOTH.map(|gear| self.curvature_radius_mm(gear, position_mm));
        rho[0] * rho[1] / (rho[0] + rho[1])
    }
}

impl ConjugateFlanks for GearPair {
    fn contact_coordinate_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.rho_on_flank_mm(gear, position_mm)
    }

    fn position_at_mm(&self, gear: Gear, coordinate_mm: f64) -> f64 {
        // The relation ρ1 + ρ2 = T1T2 is symmetric.
        self.path.rho_mm(gear, coordinate_mm)
    }

    fn in_tangent_frame(&self, gear: Gear, coordinate_mm: f64, position_mm: f64) -> TangentFramePoint {
        self.path.involute[gear].in_tangent_frame(coordinate_mm, self.path.rho_mm(gear, position_mm))
    }

    fn at_along(&self, gear: Gear, along_mm: f64, position_mm: f64) -> (f64, f64) {
        let point = self.path.involute[gear].at_along(along_mm, self.path.rho_mm(gear, position_mm));
        (point.rho_mm, point.drop_mm)
    }

    fn flank_limits_mm(&self, gear: Gear) -> (f64, f64) {
        (self.teeth[gear].root_form_rho_mm(), self.teeth[gear].tip_rho_mm())
    }

    fn curvature_radius_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.rho_on_flank_mm(gear, position_mm)
    }

    fn rolling_ratio(&self, gear: Gear, position_mm: f64) -> f64 {
        self.rho_on_flank_mm(gear, position_mm) / self.path.involute[gear].base_radius_mm
    }

    fn sliding_mm(&self, from_mm: f64, to_mm: f64) -> f64 {
        // ∫ |ξ − C| dξ = ½ (ξ − C) |ξ − C|
        let [to, from] = [to_mm, from_mm].map(|x| 0.5 * (x - self.path.pitch_point_mm) * self.path.sliding_ratio(x));
        to - from
    }

    fn depth_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.touch(position_mm).load_line[gear].depth_mm
    }
}
