//! Edges at both ends of the path of contact.
//!
//! A flank extends from its form circle to its tip circle. Contact begins at A with the tip edge of the wheel, unless the pinion's involute
//! begins above the contact with that edge, as on undercut teeth; then it begins at the form circle of the pinion:
//!
//! ```text
//! A = max(T1T2 − ρ_a2, ρ_Ff1)        E = min(ρ_a1, T1T2 − ρ_Ff2)
//! ```
//!
//! with ρ_a where the flank ends towards the tip: on the tip circle, or at the beginning of a chamfer ([`super::tip_chamfer`]).
//!
//! On an undercut tooth fillet and involute meet in a corner, which is a sharp edge like that of a tip without rounding.
//!
//! Source: ISO 21771, section 5.4 (start of active profile: the larger of form circle and circle of the contact with the mate's tip).

use super::{Gear, GearPair, PerGear, spec::PairSpec, tip_chamfer::TipChamfer};

/// Least tip rounding and chamfer, in normal modules; smaller ones are of the size of roughness, and the edge counts as sharp.
pub const LEAST_ROUNDING_MODULES: f64 = 1e-3;

impl PairSpec {
    /// Radius of the rounding of the tip edge of `gear`, mm; 0 below 10⁻³ normal modules, where the edge counts as sharp.
    pub fn tip_rounding_mm(&self, gear: Gear) -> f64 {
        let given_mm = self.gears[gear].modification.tip_rounding_mm;
        if given_mm < LEAST_ROUNDING_MODULES * self.normal_module_mm { 0.0 } else { given_mm }
    }

    /// Tip chamfer of `gear`; none below 10⁻³ normal modules.
    pub fn tip_chamfer(&self, gear: Gear) -> Option<TipChamfer> {
        let least_mm = LEAST_ROUNDING_MODULES * self.normal_module_mm;
        self.gears[gear].tip_chamfer.filter(|chamfer| chamfer.height_mm >= least_mm)
    }

    /// Whether the tip edge of `gear` is sharp.
    pub fn is_tip_sharp(&self, gear: Gear) -> bool {
        self.tip_rounding_mm(gear) == 0.0
    }
}

/// End of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathEnd {
    /// Point A.
    Start,
    /// Point E.
    End,
}

/// Edge of a flank at an end of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankEdge {
    /// Gear with the edge.
    pub gear: Gear,
    /// Whether the edge is at the form circle instead of the tip.
    pub at_root: bool,
    /// Radius of curvature of the flank at the edge, or at the beginning of its rounding, mm.
    pub rho_mm: f64,
    /// Radius of the rounding, mm.
    pub rounding_mm: f64,
    /// Whether the pressure is singular: at a tip without rounding, or a corner of undercut.
    pub is_sharp: bool,
}

impl PathEnd {
    /// Both ends, in the order of the path.
    pub const BOTH: [Self; 2] = [Self::Start, Self::End];

    /// Gear whose addendum is in contact at this end.
    pub fn addendum_of(self) -> Gear {
        match self {
            Self::Start => Gear::Wheel,
            Self::End => Gear::Pinion,
        }
    }
}

impl GearPair {
    /// Edge at an end of the path.
    pub fn edge(&self, end: PathEnd) -> FlankEdge {
        let tip_of = end.addendum_of();
        let root_of = tip_of.mate();
        let form_rho_mm = self.teeth[root_of].root_form_rho_mm();
        if self.path.rho_mm(tip_of, self.path.rho_mm(root_of, form_rho_mm)) < self.teeth[tip_of].edge_rho_mm() {
            let is_sharp = self.teeth[root_of].undercut;
            return FlankEdge { gear: root_of, at_root: true, rho_mm: form_rho_mm, rounding_mm: 0.0, is_sharp };
        }
        FlankEdge {
            gear: tip_of,
            at_root: false,
            rho_mm: self.rounding_start_rho_mm(tip_of),
            rounding_mm: self.spec.tip_rounding_mm(tip_of),
            is_sharp: self.spec.is_tip_sharp(tip_of),
        }
    }

    /// Position of the theoretical contact point beyond which the edge touches, mm.
    pub fn edge_position_mm(&self, end: PathEnd) -> f64 {
        let edge = self.edge(end);
        self.path.rho_mm(edge.gear, edge.rho_mm)
    }

    /// Whether the root end of each flank is a corner of undercut.
    pub fn undercut_corners(&self) -> PerGear<bool> {
        self.teeth.as_ref().map(|tooth| tooth.undercut)
    }

    /// Radius r_Na of the end of the active profile towards the tip, mm: at the tip circle or the edge of a chamfer, or below it where the
    /// contact ends at the mate's form circle.
    pub fn active_end_radius_mm(&self, gear: Gear) -> f64 {
        let end_mm = match gear {
            Gear::Pinion => self.path.end_mm,
            Gear::Wheel => self.path.start_mm,
        };
        self.radius_at_mm(gear, end_mm)
    }
}
