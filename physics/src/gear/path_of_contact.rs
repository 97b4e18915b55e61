//! The path of contact: where on the line of action two involute flanks touch.
//!
//! The line of action touches both base circles, in T1 and T2. The pinion's radius of curvature ξ = ρ1 at the theoretical
//! contact point is the coordinate along it; the wheel's is ρ2 = T1T2 − ξ. From A, where the wheel's tip circle cuts
//! the line, to E, where the pinion's does, a tooth pair is in contact; a base pitch p_bt later the next one follows:
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

/// Points A–E by the radius of curvature of the pinion's flank, and what goes with them; mm, transverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathOfContact {
    /// T1T2.
    pub line_of_action_mm: f64,
    /// p_bt.
    pub base_pitch_mm: f64,
    /// A: the wheel's tip, or the pinion's form circle ([`super::flank_edge`]).
    pub start_mm: f64,
    /// C: the pitch point.
    pub pitch_point_mm: f64,
    /// E: the pinion's tip, or the wheel's form circle.
    pub end_mm: f64,
    /// Flanks in contact.
    pub involute: PerGear<Involute>,
}

impl PathOfContact {
    /// B: the pair ahead leaves at E.
    pub fn lower_single_contact_mm(&self) -> f64 {
        self.end_mm - self.base_pitch_mm
    }

    /// D: the pair behind enters at A.
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

    /// `count` (≥ 2) places that divide A–E evenly, both included.
    pub fn evenly_mm(&self, count: usize) -> Vec<f64> {
        let at = |j: usize| self.start_mm + (self.end_mm - self.start_mm) * j as f64 / (count - 1) as f64;
        (0..count).map(at).collect()
    }

    /// Place between A and E whose mirror image at the nearer of them is `position_mm`; itself between both.
    pub fn folded_mm(&self, position_mm: f64) -> f64 {
        let nearer = position_mm.clamp(self.start_mm, self.end_mm);
        (2.0 * nearer - position_mm).clamp(self.start_mm, self.end_mm)
    }

    /// ε_α.
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

    /// 1/r_b1 + 1/r_b2: angle by which the gears turn against each other while the contact point moves by a unit of length.
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
        let speed = |g: Gear| self.rho_mm(g, position_mm) / self.involute[g].base_radius_mm;
        1.0 - speed(gear.mate()) / speed(gear)
    }
}
