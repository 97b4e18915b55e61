//! Contact of a tooth pair at a tip edge, before A and after E (as far as [`GearPair::tip_reach_mm`]).
//!
//! Under load the pairs in mesh yield, the gears approach each other by the transmission error δ, and the next pair touches
//! before its theoretical contact point has reached A: at its mate's tip edge, beside the line of action. After E the same
//! happens at the pinion's tip edge. With the theoretical contact point a distance s before A, the tangent frame of that
//! place still holds both involutes; only the wheel's flank begins at its tip edge, at
//!
//! ```text
//! along  ≈ s ρ₂/r_b2          gap there ≈ along²/(2R)          contact where the gap < δ
//! ```
//!
//! so that contact at a tip edge needs no model of its own: it is contact at the end of the strip, with the true gap, tip
//! rounding, relief and wear included.
//!
//! The contact's normal is that of the mate's flank where the edge touches it, turned from the line of action by ε
//! (`gear::tip_touch`). Before A it is a tangent of the pinion's base circle like any other, and the load's lever on the
//! pinion is r_b1. After E it is a tangent of the wheel's base circle, and with its lever l on the pinion
//!
//! ```text
//! δ = (approach along the normal) r_b1/l          torque = F l
//! ```
//!
//! some hundredths less than r_b1 ([`OnLever`]). Gaps of the tangent frame are measured along the line of action, and are by 1/cos ε
//! wider than along the normal ([`approach_ratio`]). For sliding, the component along the tangent is (ω₁ + ω₂)(C − ξ) at every place of
//! the frame, and that along the turned flank differs from it by along²/(ρ (C − ξ)) − ½ (along/ρ)², less than one hundredth.
//!
//! Source: R. G. Munro, L. Morrish and D. Palmer, "Gear transmission error outside the normal path of contact due to corner
//! and top contact", *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for the phenomenon.

use crate::contact::{Footprint, PairContact, PointContact, PressedCell, Response, Sweep};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};

/// l/(r_b1 cos ε): approach in the tangent frame over transmission error with the theoretical contact point at `position_mm`.
pub(crate) fn approach_ratio(pair: &GearPair, position_mm: f64) -> f64 {
    let touch = pair.touch(position_mm);
    pair.pinion_lever_ratio(&touch) / touch.turned_rad.cos()
}

/// A contact whose load has another lever on the pinion than r_b1, or whose normal is oblique to the transverse plane, with approach and load as
/// transmission error and load along the transverse line of action.
pub(crate) struct OnLever<'a> {
    /// The contact along its own normal.
    pub contact: Box<dyn PairContact + 'a>,
    /// Approach along the normal ([`gearwear_bodies::gear::normal_section`]) over transmission error, [`approach_ratio`].
    pub approach: f64,
    /// Load by the torque over load along the normal, [`approach_ratio`] without obliquity.
    pub load: f64,
}

impl PairContact for OnLever<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        self.contact.set_removed(removed_mm);
    }

    fn touch_mm(&self) -> f64 {
        self.contact.touch_mm() / self.approach
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        let along_normal = self.contact.load_at(self.approach * indentation_mm);
        Response {
            line_load_n_per_mm: self.load * along_normal.line_load_n_per_mm,
            stiffness_n_per_mm2: self.load * self.approach * along_normal.stiffness_n_per_mm2,
        }
    }

    fn further_approach_mm(&self, line_load_n_per_mm: f64) -> (f64, f64) {
        let (approach, compliance) = self.contact.further_approach_mm(line_load_n_per_mm / self.load);
        (approach / self.approach, compliance / (self.load * self.approach))
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.contact.ample_indentation_mm(line_load_n_per_mm / self.load) / self.approach
    }

    fn window_suffices(&mut self, removed_mm: PerGear<&[f64]>) -> bool {
        self.contact.window_suffices(removed_mm)
    }

    fn widen(&mut self) {
        self.contact.widen();
    }

    fn overlap_beside_mm(&self, removed_mm: PerGear<&[f64]>) -> Option<f64> {
        self.contact.overlap_beside_mm(removed_mm).map(|along_normal| along_normal / self.approach)
    }

    fn reset(&mut self) {
        self.contact.reset();
    }

    fn sweep(&self, gear: Gear, removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        self.contact.sweep(gear, removed_mm, sweep);
    }

    fn contact_of_points(&self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        self.contact.contact_of_points(gear, removed_mm)
    }

    fn footprint(&self) -> Footprint {
        self.contact.footprint()
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        self.contact.pressed_cells()
    }
}
