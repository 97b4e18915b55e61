//! Contact of the flanks of a pair on the line of action, or at a tip edge outside it.
//!
//! Between A and E two involutes touch at the theoretical contact point, and the normal is the line of action. Where that point
//! is beyond the flank of one gear, its tip edge touches, an arc of radius ρ_k (0 where it is sharp). The
//! shortest distance between the mate's involute and the arc is along the normal of the involute through the arc's centre O, which
//! is a tangent of the mate's base circle. With the line of action as reference, T the point where it touches the mate's
//! base circle (radius r_b, axis M), and d = |MO|,
//!
//! ```text
//! L = √(d² − r_b²)            length of that tangent from the base circle to O
//! ε = ∠TMO − acos(r_b/d)      rotation of the normal from the line of action
//! ρ' = ρ + r_b ε              radius of curvature of the mate at the contact point
//! g = L − ρ' − ρ_k            gap along the normal
//! ε' = ε + Δρ_e/r_be          rotation of the normal from that of the flank at the beginning of the rounding, in its own tooth
//! ```
//!
//! with Δρ_e the distance of the theoretical contact point beyond the beginning of the rounding. Rotations are positive for a
//! contact that moves towards the tip: ε' turns the load of a tip edge towards the axis of its own tooth.
//!
//! The normal is tangent to the mate's base circle, so that its lever there is r_b; on the gear with the
//! tip edge it is
//!
//! ```text
//! l = (r_b1 + r_b2) cos ε − T1T2 sin ε − r_b
//! ```
//!
//! Where the form circle ends the path instead ([`super::flank_edge`]), the corner there touches the mate in the same way, with ρ_k = 0.
//!
//! Valid for unworn flanks without relief: the effect of a relief of some hundredths of a millimetre on the normal of an edge is negligible.
//!
//! Source: geometry; R. G. Munro, L. Morrish and D. Palmer, *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for sharp
//! edges.

use nalgebra::Vector2;

use super::conjugate::ConjugateFlanks;
use super::flank_edge::{FlankEdge, PathEnd};
use super::{Gear, GearPair, PerGear, removed_material, tooth::LoadLine};

/// Upper bound of the approach of flanks, in units of line load over E*: at the pitch point of type C 7.4 units for steel, 4.8 for plastic
/// on a rigid pinion.
const AMPLE_APPROACH: f64 = 15.0;
/// Lower bound of the radius of curvature of a flank over that at its start of active profile: the theoretical contact point of a
/// tip edge may be beyond T1 or T2, where the mate has no involute, while the edge touches it farther up.
const LEAST_CURVATURE: f64 = 0.05;
/// Steps along the path per base pitch.
const STEPS_IN_PITCH: f64 = 1000.0;
/// Positions per base pitch for modifications.
const PLACES_IN_PITCH: usize = 100;

/// Contact of the flanks at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankTouch {
    /// Gear that touches with its edge (tip edge, rounding or corner at the form circle); `None` where both involutes touch.
    pub edge_of: Option<Gear>,
    /// Rotation ε of the normal from the line of action, rad.
    pub turned_rad: f64,
    /// Gap along the normal, mm.
    pub gap_mm: f64,
    /// Radius of curvature of each flank at the contact; at the beginning of the rounding for the gear that touches with its edge.
    pub rho_mm: PerGear<f64>,
    /// Line of the load through each tooth.
    pub load_line: PerGear<LoadLine>,
}

impl GearPair {
    /// Contact of the flanks with the theoretical contact point at `position_mm`.
    pub fn touch(&self, position_mm: f64) -> FlankTouch {
        let rho_mm = PerGear::from_fn(|gear| self.path.rho_mm(gear, position_mm));
        let mut edges = PathEnd::BOTH.into_iter().map(|end| self.edge(end));
        let passed = edges.find(|edge| {
            let rho_mm = rho_mm[edge.gear];
            if edge.at_root { rho_mm < edge.rho_mm } else { rho_mm > edge.rho_mm }
        });
        match passed {
            Some(edge) => self.touch_at_edge(edge, position_mm),
            None => {
                let load_line = PerGear::from_fn(|gear| self.teeth[gear].load_line(rho_mm[gear]));
                FlankTouch { edge_of: None, turned_rad: 0.0, gap_mm: 0.0, rho_mm, load_line }
            }
        }
    }

    /// Radius of curvature at the beginning of the rounding of a gear's tip edge; at a sharp edge, that of the edge.
    pub fn rounding_start_rho_mm(&self, gear: Gear) -> f64 {
        let (tooth, rounding_mm) = (&self.teeth[gear], self.spec.gears[gear].modification.tip_rounding_mm);
        if rounding_mm == 0.0 {
            return tooth.edge_rho_mm();
        }
        let arc_mm = tooth.involute.arc_mm(tooth.edge_rho_mm()) - tooth.tip_rounding_length_mm(rounding_mm);
        tooth.involute.rho_at_arc_mm(arc_mm)
    }

    /// Distance before A and after E within which the edge at that end of the path is inside its mate's tip circle, mm of path: an upper bound
    /// for contact.
    ///
    /// With r_e the radius of the edge, r_a' the tip radius of the mate, a the centre distance and α_e = acos(r_b/r_e), the edge turns from
    /// the intersection of its circle with the mate's tip circle to A or E by
    ///
    /// ```text
    /// acos((a² + r_e² − r_a'²)/(2 a r_e)) − |α_e − α_wt|
    /// ```
    pub fn farthest_touch_mm(&self) -> [f64; 2] {
        let centre_mm = self.spec.centre_distance_mm;
        PathEnd::BOTH.map(|end| {
            let FlankEdge { gear, .. } = self.edge(end);
            let involute = self.teeth[gear].involute;
            let rho_mm = self.outermost_rho_mm(end);
            let (own, mate) = (involute.radius_mm(rho_mm), self.teeth[gear.mate()].tip_radius_mm);
            let cos = (centre_mm * centre_mm + own * own - mate * mate) / (2.0 * centre_mm * own);
            let at_end_rad = (involute.pressure_angle_rad(rho_mm) - self.working_pressure_angle_rad).abs();
            (involute.base_radius_mm.abs() * (cos.clamp(-1.0, 1.0).acos() - at_end_rad)).max(0.0)
        })
    }

    /// Radius of curvature at the edge at an end of the path, where the flank ends towards the tip or on the form circle.
    fn outermost_rho_mm(&self, end: PathEnd) -> f64 {
        let FlankEdge { gear, at_root, rho_mm, .. } = self.edge(end);
        if at_root { rho_mm } else { self.teeth[gear].edge_rho_mm() }
    }

    /// Radius of curvature of a gear's flank at the theoretical contact point, with a lower bound before A and after E.
    pub(super) fn rho_on_flank_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        let sign = self.path.involute[gear].signed(1.0);
        sign * (sign * self.path.rho_mm(gear, position_mm)).max(LEAST_CURVATURE * sign * self.active_start_rho_mm(gear))
    }

    /// Distance before A and after E within which the gap at tip edges of unworn, unmodified flanks is at most `approach_mm`, mm of
    /// path.
    pub fn tip_reach_mm(&self, approach_mm: f64) -> [f64; 2] {
        let path = &self.path;
        let [before, after] = self.farthest_touch_mm();
        let ends = [(PathEnd::Start, path.start_mm, -1.0, before), (PathEnd::End, path.end_mm, 1.0, after)];
        ends.map(|(end, end_mm, outwards, most)| {
            let step = path.base_pitch_mm / STEPS_IN_PITCH;
            let steps = (most / step) as usize;
            let touching =
                (1..=steps).take_while(|&k| self.edge_gap_mm(end, end_mm + outwards * k as f64 * step) <= approach_mm);
            touching.last().unwrap_or(0) as f64 * step
        })
    }

    /// Distance before A and after E at which load comes in or leaves at once, mm of path: there the tip circles part
    /// ([`Self::farthest_touch_mm`]) while the gap of unworn flanks is still at most `approach_mm`; none where the flanks part before.
    pub fn tips_meet_mm(&self, approach_mm: f64) -> [Option<f64>; 2] {
        let [before, after] = self.farthest_touch_mm();
        let ends = [(PathEnd::Start, self.path.start_mm - before), (PathEnd::End, self.path.end_mm + after)];
        let touch = ends.map(|(end, position_mm)| self.edge_gap_mm(end, position_mm) <= approach_mm);
        [touch[0].then_some(before), touch[1].then_some(after)]
    }

    /// [`Self::tip_reach_mm`] of an upper bound of the approach of unworn flanks under `line_load_n_per_mm` with the contact modulus E*.
    pub fn ample_tip_reach_mm(&self, line_load_n_per_mm: f64, contact_modulus_mpa: f64) -> [f64; 2] {
        self.tip_reach_mm(AMPLE_APPROACH * line_load_n_per_mm / contact_modulus_mpa + self.unloaded_approach_mm())
    }

    /// Upper bound of the part of modifications in the transmission error of loaded, unworn flanks, mm.
    ///
    /// Springs k_i behind gaps g_i carry F = Σ k_i max(δ − g_i, 0) ≥ Σ k_i (δ − g_i), so that δ ≤ F/Σ k_i + Σ k_i g_i/Σ k_i: the elastic approach without
    /// gaps, and the mean gap. Over the face width that is the mean material removed from both flanks; of the tooth pairs in mesh, the least
    /// material removed by profile modifications, as that pair could carry the load alone. The greatest over the mesh cycle is taken.
    pub fn unloaded_approach_mm(&self) -> f64 {
        let path = &self.path;
        let step_mm = path.base_pitch_mm / PLACES_IN_PITCH as f64;
        let places = ((path.end_mm - path.start_mm) / step_mm) as usize;
        // Least material removed from the tooth pairs in mesh at each position.
        let mut least_mm = [f64::INFINITY; PLACES_IN_PITCH];
        for k in 0..=places {
            let position_mm = path.start_mm + k as f64 * step_mm;
            let removed_mm = Gear::BOTH
                .map(|gear| removed_material::of_profile_mm(self, gear, path.rho_mm(gear, position_mm)))
                .iter()
                .sum();
            let least = &mut least_mm[k % PLACES_IN_PITCH];
            *least = least.min(removed_mm);
        }
        let of_profiles_mm = least_mm.into_iter().filter(|least| least.is_finite()).fold(0.0, f64::max);
        of_profiles_mm + Gear::BOTH.map(|gear| removed_material::mean_over_width_mm(self, gear)).iter().sum::<f64>()
    }

    /// Gap along the line of action between the edge at an end of the path and the mate's flank, with the theoretical contact point at
    /// `position_mm`.
    pub fn edge_gap_mm(&self, end: PathEnd, position_mm: f64) -> f64 {
        let gear = self.edge(end).gear;
        let edge = self.in_tangent_frame(gear, self.outermost_rho_mm(end), position_mm);
        edge.drop_mm + self.at_along(gear.mate(), -edge.along_mm, position_mm).1
    }

    fn touch_at_edge(&self, edge: FlankEdge, position_mm: f64) -> FlankTouch {
        let FlankEdge { gear, rho_mm: start_rho, rounding_mm, .. } = edge;
        let (own, mate) = (self.path.involute[gear], self.path.involute[gear.mate()]);
        let (own_rho, mate_rho) = (self.path.rho_mm(gear, position_mm), self.path.rho_mm(gear.mate(), position_mm));
        let own_turn = (start_rho - own_rho) / own.base_radius_mm;
        // O in the tangent frame of the gear, along the inward normal (−sin, cos) from the beginning of the rounding.
        let start = own.in_tangent_frame(start_rho, own_rho);
        let centre =
            Vector2::new(start.along_mm, start.drop_mm) + rounding_mm * Vector2::new(-own_turn.sin(), own_turn.cos());
        // Vector from the mate's axis in the mate's frame, where that to T is (r_b, 0).
        let from_axis = Vector2::new(mate.base_radius_mm, -mate_rho) - centre;
        let free_mm = mate.curvature_radius_mm(from_axis.norm());
        let sign = mate.signed(1.0);
        let turned_rad =
            (sign * from_axis.y).atan2(sign * from_axis.x) + (sign * free_mm).atan2(sign * mate.base_radius_mm);
        let touched_rho = mate_rho + mate.base_radius_mm * turned_rad;
        let rho_mm = PerGear::from_fn(|each| if each == gear { start_rho } else { touched_rho });
        FlankTouch {
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

    /// Ratio l/r_b1 of the lever on the pinion of a load along the normal of `touch` to that of a load along the line of action.
    pub fn pinion_lever_ratio(&self, touch: &FlankTouch) -> f64 {
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
