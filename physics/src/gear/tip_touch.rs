//! Where the flanks of a pair touch, on the line of action or at a tip edge outside it.
//!
//! Between A and E two involutes touch at the theoretical contact point, and the normal is the line of action. Where that point
//! would lie beyond the flank of one gear, its tip edge touches: the arc of radius ρ_k that rounds it (ρ_k = 0: sharp). The
//! shortest way from the mate's involute to the arc leads through the arc's centre O, and as every normal of the mate's
//! involute it is a tangent of its base circle. With the line of action as reference, T the point where it touches the mate's
//! base circle (radius r_b, axis M), and d = |MO|,
//!
//! ```text
//! L = √(d² − r_b²)            from where that tangent touches the base circle to O
//! ε = ∠TMO − acos(r_b/d)      turn of the normal from the line of action
//! ρ' = ρ + r_b ε              radius of curvature of the mate where it is touched
//! g = L − ρ' − ρ_k            gap along the normal
//! ε' = ε + Δρ_e/r_be          turn of the normal from that of the flank where its rounding begins, seen in its own tooth
//! ```
//!
//! with Δρ_e by how much the theoretical contact point has passed the beginning of the rounding. Positive turns are those of a
//! contact that moves towards the tip: ε' turns the load of a tip edge towards the axis of its own tooth.
//!
//! The normal touches the mate's base circle as the line of action does, so that its lever there is r_b; on the gear with the
//! tip edge it is
//!
//! ```text
//! l = (r_b1 + r_b2) cos ε − T1T2 sin ε − r_b
//! ```
//!
//! Unworn flanks without relief: a relief of some hundredths of a millimetre moves an edge too little to turn its normal.
//!
//! Source: the geometry itself; R. G. Munro, L. Morrish and D. Palmer, *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for sharp
//! edges.

use nalgebra::Vector2;

use super::{Gear, GearPair, PerGear, removed_material::tip_rounding_length_mm, tooth::LoadLine};

/// Greatest part of a base pitch before A and after E at which flanks are looked at.
const MOST_BASE_PITCHES: f64 = 0.3;
/// Least distance from T1 and T2, as part of the curvature at A and E.
const LEAST_CURVATURE: f64 = 0.05;

/// How the flanks touch at some position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The gear whose tip edge, or the rounding of it, touches; none where both involutes do.
    pub edge_of: Option<Gear>,
    /// ε: turn of the normal from the line of action, rad.
    pub turned_rad: f64,
    /// Gap along the normal, mm.
    pub gap_mm: f64,
    /// Radius of curvature of each flank where it is touched; where a rounding begins, of the gear that touches with its edge.
    pub rho_mm: PerGear<f64>,
    /// How the normal passes through each tooth.
    pub load_line: PerGear<LoadLine>,
}

impl GearPair {
    /// How the flanks touch with the theoretical contact point at `position_mm`.
    pub fn touch(&self, position_mm: f64) -> Touch {
        let rho = |gear| self.path.rho_mm(gear, position_mm);
        let passed = |gear: &Gear| rho(*gear) > self.rounding_start_rho_mm(*gear);
        match [Gear::Wheel, Gear::Pinion].into_iter().find(passed) {
            Some(gear) => self.touch_at_edge(gear, position_mm),
            None => {
                let rho_mm = PerGear::from_fn(rho);
                let load_line = PerGear::from_fn(|gear| self.teeth[gear].load_line(rho_mm[gear]));
                Touch { edge_of: None, turned_rad: 0.0, gap_mm: 0.0, rho_mm, load_line }
            }
        }
    }

    /// Radius of curvature where the rounding of a gear's tip edge begins; at the edge itself where it is sharp.
    pub fn rounding_start_rho_mm(&self, gear: Gear) -> f64 {
        let (tooth, rounding_mm) = (&self.teeth[gear], self.spec.gears[gear].modification.tip_rounding_mm);
        if rounding_mm == 0.0 {
            return tooth.tip_rho_mm();
        }
        let arc_mm = tooth.involute.arc_mm(tooth.tip_rho_mm()) - tip_rounding_length_mm(rounding_mm, tooth);
        tooth.involute.rho_at_arc_mm(arc_mm)
    }

    /// How far before A and after E flanks are looked at, mm of path: the tangents end with the base circles.
    pub fn farthest_touch_mm(&self) -> [f64; 2] {
        let path = &self.path;
        let rooms = [path.start_mm, path.rho_mm(Gear::Wheel, path.end_mm)];
        rooms.map(|room| (MOST_BASE_PITCHES * path.base_pitch_mm).min((1.0 - LEAST_CURVATURE) * room))
    }

    fn touch_at_edge(&self, gear: Gear, position_mm: f64) -> Touch {
        let (own, mate) = (self.path.involute[gear], self.path.involute[gear.mate()]);
        let (own_rho, mate_rho) = (self.path.rho_mm(gear, position_mm), self.path.rho_mm(gear.mate(), position_mm));
        let rounding_mm = self.spec.gears[gear].modification.tip_rounding_mm;
        let start_rho = self.rounding_start_rho_mm(gear);
        let own_turn = (start_rho - own_rho) / own.base_radius_mm;
        // O in the tangent frame of the gear: along the inward normal (−sin, cos) from where the rounding begins.
        let start = own.in_tangent_frame(start_rho, own_rho);
        let centre =
            Vector2::new(start.along_mm, start.drop_mm) + rounding_mm * Vector2::new(-own_turn.sin(), own_turn.cos());
        // From the mate's axis, in the mate's frame, where T lies at (r_b, 0) from it.
        let from_axis = Vector2::new(mate.base_radius_mm, -mate_rho) - centre;
        let free_mm = mate.curvature_radius_mm(from_axis.norm());
        let turned_rad = from_axis.y.atan2(from_axis.x) + free_mm.atan2(mate.base_radius_mm);
        let touched_rho = mate_rho + mate.base_radius_mm * turned_rad;
        let rho_mm = PerGear::from_fn(|each| if each == gear { start_rho } else { touched_rho });
        Touch {
            edge_of: Some(gear),
            turned_rad,
            gap_mm: free_mm - touched_rho - rounding_mm,
            rho_mm,
            load_line: PerGear::from_fn(|each| {
                let line = self.teeth[each].load_line(rho_mm[each]);
                if each == gear { line.turned(rounding_mm, turned_rad - own_turn) } else { line }
            }),
        }
    }

    /// l/r_b1: lever on the pinion of a load along the normal of `touch` over that of one along the line of action.
    pub fn pinion_lever_ratio(&self, touch: &Touch) -> f64 {
        match touch.edge_of {
            Some(Gear::Pinion) => {
                let base = self.path.involute.map(|involute| involute.base_radius_mm);
                let (sin, cos) = touch.turned_rad.sin_cos();
                (base.sum() * cos - self.path.line_of_action_mm * sin - base.wheel) / base.pinion
            }
            Some(Gear::Wheel) | None => 1.0,
        }
    }
}
