//! Interferences of an internal pair outside the path of contact, and its radial assembly.
//!
//! ```text
//! involute interference      |r_a2| ≥ √(r_b2² + T1T2²)      the wheel's tip touches no lower than T1:  z1/|z2| ≥ 1 − tan α_a2/tan α_wt
//!
//! trochoidal interference    the tips cross where both are on the tip circles: seen from the pinion at θ1, from the wheel at θ2,
//!                            cos θ1 = (r_a2² − r_a1² − a²)/(2 |a| r_a1)      cos θ2 = (a² + r_a2² − r_a1²)/(2 |a| |r_a2|)
//!                            clearance  |r_a2| [(θ1 + inv α_a1 − inv α_wt) z1/|z2| + inv α_wt − inv α_a2 − θ2]
//!
//! radial assembly            tips pass each other while the pinion moves out along the line of centres, if
//!                            (θ1 + inv α_a1 − inv α_wt) z1/|z2| ≥ θ2 + inv α_a2 − inv α_wt   with
//!                            sin² θ1 = [1 − (cos α_a1/cos α_a2)²]/[1 − (z1/z2)²]      sin² θ2 = [(cos α_a2/cos α_a1)² − 1]/[(z2/z1)² − 1]
//! ```
//!
//! Where the first is not met, the wheel's tip is followed through the pinion's fillet ([`super::interference`]), and refused where they overlap.
//!
//! All three are of teeth without backlash and with sharp tips. A pair that fails the last one is assembled along its axis.
//!
//! Sources: DIN 3993-1 (internal pairs, interferences); KHK, *Gear Technical Reference*, section 4.2 (equations and an example).

use super::{Gear, GearPair, PairError, internal_error::InternalError, involute::inv, spec::PairSpec};

/// Figures of involute interference: the wheel's tip would touch below the pinion's base circle. Teeth whose root fillet leaves room for that tip, as on an
/// undercut pinion, bear it; others overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InvoluteInterference {
    /// Tip diameter of the wheel, mm.
    pub tip_diameter_mm: f64,
    /// Least tip diameter without interference, mm.
    pub least_tip_diameter_mm: f64,
    /// z1/|z2|.
    pub ratio: f64,
    /// 1 − tan α_a2/tan α_wt, which the ratio is less than.
    pub limit: f64,
}

/// Bisections of a limiting tip radius.
const BISECTIONS: usize = 60;
/// Most interferences that a ring's tip is shortened for, one after the other.
const MOST_SHORTENINGS: usize = 4;
/// Most by which a ring's tip is shortened for tips that meet outside the path of contact, in normal modules.
const MOST_SHORTENED_MODULES: f64 = 1.0;
/// Last digit of a shortened tip diameter, mm.
const LAST_DIGIT_MM: f64 = 1e-4;

impl PairSpec {
    /// Tip diameter of an internal wheel, negative, where that of the rack would interfere with the pinion, or has no involute: the one that is allowed;
    /// `None` where there is nothing to shorten, or where shortening does not help.
    pub fn shortened_ring_tip_mm(&self) -> Option<f64> {
        if !self.is_internal() || self.gears.wheel.tip_diameter_mm.is_some() {
            return None;
        }
        let mut spec = self.clone();
        for _ in 0..MOST_SHORTENINGS {
            let diameter_mm = match GearPair::new(&spec) {
                Ok(_) => return spec.gears.wheel.tip_diameter_mm,
                Err(error) => spec.tip_without_interference_mm(&error)?,
            };
            spec.gears.wheel.tip_diameter_mm = Some((diameter_mm / LAST_DIGIT_MM).floor() * LAST_DIGIT_MM);
        }
        None
    }

    /// Tip diameter of the internal wheel without the interference `error`, negative; `None` where it is none of that tip.
    fn tip_without_interference_mm(&self, error: &PairError) -> Option<f64> {
        match *error {
            PairError::Internal(InternalError::TipInsideBase { base_diameter_mm, .. }) => Some(-base_diameter_mm),
            PairError::Internal(InternalError::CutterCutsTips { least_mm, .. }) => Some(-least_mm),
            PairError::Internal(InternalError::InvoluteInterference { of, .. }) => Some(-of.least_tip_diameter_mm),
            PairError::Internal(InternalError::TrochoidalInterference { .. }) => self.tip_beside_tips_mm(),
            PairError::Interference { gear: Gear::Pinion, greatest_tip_diameter_mm, .. } => {
                Some(greatest_tip_diameter_mm)
            }
            _ => None,
        }
    }

    /// Greatest tip diameter of the internal wheel, negative, whose tips pass beside those of the pinion.
    fn tip_beside_tips_mm(&self) -> Option<f64> {
        let meets = |diameter_mm: f64| {
            let mut spec = self.clone();
            spec.gears.wheel.tip_diameter_mm = Some(diameter_mm);
            matches!(GearPair::new(&spec), Err(PairError::Internal(InternalError::TrochoidalInterference { .. })))
        };
        let mut overlapping = 2.0 * self.tip_radius_mm(Gear::Wheel);
        let mut free = overlapping - 2.0 * MOST_SHORTENED_MODULES * self.normal_module_mm;
        if meets(free) {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (free + overlapping);
            if meets(middle) { overlapping = middle } else { free = middle }
        }
        Some(free)
    }
}

impl GearPair {
    /// Refuses trochoidal interference of an internal pair.
    pub(super) fn check_tips(&self) -> Result<(), InternalError> {
        let clearance_mm = self.tip_to_tip_clearance_mm(self.teeth.pinion.tip_radius_mm);
        if clearance_mm < 0.0 {
            return Err(InternalError::TrochoidalInterference {
                overlap_mm: -clearance_mm,
                greatest_pinion_tip_mm: 2.0 * self.greatest_tip_beside_tips_mm(),
            });
        }
        Ok(())
    }

    /// Condition for involute interference of an internal pair; `None` where the wheel's tip touches above the pinion's base circle.
    pub fn involute_interference(&self) -> Option<InvoluteInterference> {
        let tip_radius_mm = self.teeth.wheel.tip_radius_mm.abs();
        let least_mm = self.teeth.wheel.involute.base_radius_mm.hypot(self.path.line_of_action_mm);
        (self.spec.is_internal() && tip_radius_mm < least_mm).then(|| InvoluteInterference {
            tip_diameter_mm: 2.0 * tip_radius_mm,
            least_tip_diameter_mm: 2.0 * least_mm,
            ratio: self.wheel_turns_per_pinion_turn(),
            limit: 1.0 - self.tip_pressure_angle_rad(Gear::Wheel).tan() / self.working_pressure_angle_rad.tan(),
        })
    }

    /// Pressure angle at a gear's tip circle.
    fn tip_pressure_angle_rad(&self, gear: Gear) -> f64 {
        let tooth = &self.teeth[gear];
        tooth.involute.pressure_angle_rad(tooth.tip_rho_mm())
    }

    /// Clearance of the tips of pinion and internal wheel outside the path of contact, along the wheel's tip circle, for a tip radius of the pinion,
    /// mm; infinite where the tip circles do not cross.
    pub fn tip_to_tip_clearance_mm(&self, pinion_tip_radius_mm: f64) -> f64 {
        let (a, r_a1) = (self.spec.centre_distance_mm.abs(), pinion_tip_radius_mm);
        let r_a2 = self.teeth.wheel.tip_radius_mm.abs();
        let cos_pinion = (r_a2 * r_a2 - r_a1 * r_a1 - a * a) / (2.0 * a * r_a1);
        let cos_wheel = (a * a + r_a2 * r_a2 - r_a1 * r_a1) / (2.0 * a * r_a2);
        if cos_pinion.abs() > 1.0 || cos_wheel.abs() > 1.0 {
            return f64::INFINITY;
        }
        let involute = self.teeth.pinion.involute;
        let alpha_a1 = involute.pressure_angle_rad(involute.curvature_radius_mm(r_a1));
        let (inv_w, inv_a2) = (inv(self.working_pressure_angle_rad), inv(self.tip_pressure_angle_rad(Gear::Wheel)));
        let turned = (cos_pinion.acos() + inv(alpha_a1) - inv_w) * self.wheel_turns_per_pinion_turn();
        r_a2 * (turned + inv_w - inv_a2 - cos_wheel.acos())
    }

    /// Greatest tip radius of the pinion beside which the tips of the internal wheel pass, mm.
    fn greatest_tip_beside_tips_mm(&self) -> f64 {
        let pinion = &self.teeth.pinion;
        let (mut free, mut overlapping) = (pinion.root_form_radius_mm, pinion.tip_radius_mm);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (free + overlapping);
            if self.tip_to_tip_clearance_mm(middle) >= 0.0 { free = middle } else { overlapping = middle }
        }
        free
    }

    /// Clearance of the tips during radial assembly of an internal pair, along the wheel's tip circle, mm: negative where the pinion can be put in along
    /// its axis alone. `None` of external pairs, and where the tips do not pass each other.
    pub fn radial_assembly_clearance_mm(&self) -> Option<f64> {
        let [alpha_a1, alpha_a2] = Gear::BOTH.map(|gear| self.tip_pressure_angle_rad(gear));
        let cosines = alpha_a1.cos() / alpha_a2.cos();
        if !self.spec.is_internal() || cosines >= 1.0 {
            return None;
        }
        let ratio = self.wheel_turns_per_pinion_turn();
        let sin_pinion = ((1.0 - cosines.powi(2)) / (1.0 - ratio * ratio)).sqrt();
        let sin_wheel = ((cosines.powi(-2) - 1.0) / (ratio.powi(-2) - 1.0)).sqrt();
        if sin_pinion > 1.0 || sin_wheel > 1.0 {
            return None;
        }
        let inv_w = inv(self.working_pressure_angle_rad);
        let of_pinion = (sin_pinion.asin() + inv(alpha_a1) - inv_w) * ratio;
        let of_wheel = sin_wheel.asin() + inv(alpha_a2) - inv_w;
        Some(self.teeth.wheel.tip_radius_mm.abs() * (of_pinion - of_wheel))
    }
}
