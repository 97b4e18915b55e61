//! Path of contact of two involute flanks on the line of action.
//!
//! The line of action is tangent to both base circles at T1 and T2. The pinion's radius of curvature ξ = ρ1 at the theoretical
//! contact point is the coordinate along it; the wheel's is ρ2 = T1T2 − ξ. A tooth pair is in contact from A, on the wheel's tip circle,
//! to E, on the pinion's; the next pair follows a base pitch p_bt later:
//!
//! ```text
//! A = max(T1T2 − √(r_a2² − r_b2²), ρ_Ff1)     E = min(√(r_a1² − r_b1²), T1T2 − ρ_Ff2)     C = r_b1 tan α_wt
//! B = E − p_bt                    D = A + p_bt             ε_α = (E − A) / p_bt
//! ```
//!
//! ρ_Ff is the radius of curvature at the form circle: no flank reaches below it.
//!
//! The flanks slide on each other with v_s = (ω1 + ω2) |ξ − C|, and dξ = r_b1 ω1 dt.
//!
//! Source: ISO 21771, section 5.

use super::{Gear, PerGear, involute::Involute};

/// Path of contact with points A–E by the radius of curvature of the pinion's flank; mm, transverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathOfContact {
    /// Length T1T2.
    pub line_of_action_mm: f64,
    /// Transverse base pitch p_bt.
    pub base_pitch_mm: f64,
    /// Point A, at the wheel's tip or the pinion's form circle ([`super::flank_edge`]).
    pub start_mm: f64,
    /// Pitch point C.
    pub pitch_point_mm: f64,
    /// Point E, at the pinion's tip or the wheel's form circle.
    pub end_mm: f64,
    /// Involutes of both flanks.
    pub involute: PerGear<Involute>,
}

impl PathOfContact {
    /// Point B, where the pair ahead leaves the mesh at E.
    pub fn lower_single_contact_mm(&self) -> f64 {
        self.end_mm - self.base_pitch_mm
    }

    /// Point D, where the pair behind enters the mesh at A.
    pub fn upper_single_contact_mm(&self) -> f64 {
        self.start_mm + self.base_pitch_mm
    }

    /// Points A–E in the order of their names, which for some gears is not their order on the line.
    pub fn points_mm(&self) -> [f64; 5] {
        [
            self.start_mm,
            self.lower_single_contact_mm(),
            self.pitch_point_mm,
            self.upper_single_contact_mm(),
            self.end_mm,
        ]
    }

    /// Positions that divide A–E evenly, `count` (≥ 2) with both ends.
    pub fn evenly_mm(&self, count: usize) -> Vec<f64> {
        (0..count).map(|j| self.start_mm + (self.end_mm - self.start_mm) * j as f64 / (count - 1) as f64).collect()
    }

    /// Mirror image of a position outside A–E at the nearer end; positions between A and E are returned unchanged.
    pub fn folded_mm(&self, position_mm: f64) -> f64 {
        let nearer = position_mm.clamp(self.start_mm, self.end_mm);
        (2.0 * nearer - position_mm).clamp(self.start_mm, self.end_mm)
    }

    /// Transverse contact ratio ε_α.
    pub fn contact_ratio(&self) -> f64 {
        (self.end_mm - self.start_mm) / self.base_pitch_mm
    }

    /// Radius of curvature of a gear's flank where the pinion's is `position_mm`.
    pub fn rho_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        match gear {
            Gear::Pinion => position_mm,
            Gear::Wheel => self.line_of_action_mm - position_mm,
        }
    }

    /// Relative rotation of the gears per displacement of the contact point, 1/r_b1 + 1/r_b2.
    pub fn relative_turn_per_mm(&self) -> f64 {
        self.involute.map(|flank| 1.0 / flank.base_radius_mm).sum()
    }

    /// Sliding velocity over the speed dξ/dt of the contact point along the line of action:
    /// |ξ − C| (1 + r_b1/r_b2) / r_b1.
    pub fn sliding_ratio(&self, position_mm: f64) -> f64 {
        (position_mm - self.pitch_point_mm).abs() * self.relative_turn_per_mm()
    }

    /// Specific sliding ζ = 1 − v_mate / v_own of a gear's flank at `position_mm`, v the surface velocities along the
    /// flank (ISO 21771): negative below the gear's pitch circle, positive above it.
    pub fn specific_sliding(&self, gear: Gear, position_mm: f64) -> f64 {
        let [mate, own] =
            [gear.mate(), gear].map(|gear| self.rho_mm(gear, position_mm) / self.involute[gear].base_radius_mm);
        1.0 - mate / own
    }
}
