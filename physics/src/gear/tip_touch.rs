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
//! Where the form circle ends the path instead ([`super::flank_edge`]), the corner there touches the mate in the same way, with ρ_k = 0.
//!
//! Unworn flanks without relief: a relief of some hundredths of a millimetre moves an edge too little to turn its normal.
//!
//! Source: the geometry itself; R. G. Munro, L. Morrish and D. Palmer, *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for sharp
//! edges.

use nalgebra::Vector2;

use super::conjugate::ConjugateFlanks;
use super::flank_edge::{FlankEdge, PathEnd};
use super::{
    Gear, GearPair, PerGear,
    removed_material::{self, tip_rounding_length_mm},
    tooth::LoadLine,
};

/// An approach that no pair's flanks exceed, in units of line load over E*: steel on type C approaches by 7.4 of these at the pitch point, plastic
/// on a rigid pinion by 4.8.
const AMPLE_APPROACH: f64 = 15.0;
/// Least radius of curvature that a flank is taken to have, as part of that at its start of active profile: the theoretical contact point of a
/// tip edge may lie beyond T1 or T2, where the mate has no involute, while the edge touches it farther up.
const LEAST_CURVATURE: f64 = 0.05;
/// Steps in which the path is walked, per base pitch.
const STEPS_IN_PITCH: f64 = 1000.0;
/// Places per base pitch at which modifications are asked for.
const PLACES_IN_PITCH: usize = 100;

/// How the flanks touch at some position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The gear whose edge touches: the tip edge or its rounding, or the corner at the form circle; none where both involutes do.
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
        let edges = PathEnd::BOTH.map(|end| self.edge(end));
        let passed = |edge: &FlankEdge| (rho(edge.gear) > edge.rho_mm) != edge.at_root;
        match edges.into_iter().find(|edge| rho(edge.gear) != edge.rho_mm && passed(edge)) {
            Some(edge) => self.touch_at_edge(edge, position_mm),
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

    /// How far before A and after E the edge in which the path ends there is within its mate's tip circle, mm of path: farther out
    /// nothing can touch.
    ///
    /// With r_e the radius of the edge, r_a' the tip radius of the mate, a the centre distance and α_e = acos(r_b/r_e), the edge turns from
    /// where its circle meets the mate's tip circle to A or E by
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
            (involute.base_radius_mm * (cos.clamp(-1.0, 1.0).acos() - at_end_rad)).max(0.0)
        })
    }

    /// ρ of the edge in which the path ends: at the tip circle, where it is of the tip, and at the form circle.
    fn outermost_rho_mm(&self, end: PathEnd) -> f64 {
        let FlankEdge { gear, at_root, rho_mm, .. } = self.edge(end);
        if at_root { rho_mm } else { self.teeth[gear].tip_rho_mm() }
    }

    /// ρ of a gear's flank at the theoretical contact point, kept from going to nothing before A and after E.
    pub(super) fn rho_on_flank_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.path.rho_mm(gear, position_mm).max(LEAST_CURVATURE * self.active_start_rho_mm(gear))
    }

    /// How far before A and after E the tip edges of unworn, unmodified flanks are nearer to the mate than `approach_mm`, mm of
    /// path.
    pub fn tip_reach_mm(&self, approach_mm: f64) -> [f64; 2] {
        let path = &self.path;
        let [before, after] = self.farthest_touch_mm();
        let ends = [(PathEnd::Start, path.start_mm, -1.0, before), (PathEnd::End, path.end_mm, 1.0, after)];
        ends.map(|(end, end_mm, outwards, most)| {
            let step = path.base_pitch_mm / STEPS_IN_PITCH;
            let steps = (most / step) as usize;
            let touches = |k: &usize| self.edge_gap_mm(end, end_mm + outwards * *k as f64 * step) <= approach_mm;
            (1..=steps).take_while(touches).last().unwrap_or(0) as f64 * step
        })
    }

    /// [`Self::tip_reach_mm`] of an approach that unworn flanks under `line_load_n_per_mm` do not exceed on bodies with the contact modulus E*.
    pub fn ample_tip_reach_mm(&self, line_load_n_per_mm: f64, contact_modulus_mpa: f64) -> [f64; 2] {
        self.tip_reach_mm(AMPLE_APPROACH * line_load_n_per_mm / contact_modulus_mpa + self.unloaded_approach_mm())
    }

    /// What modifications add at the most to the transmission error of loaded, unworn flanks, mm.
    ///
    /// Springs k_i behind gaps g_i carry F = Σ k_i max(δ − g_i, 0) ≥ Σ k_i (δ − g_i), so that δ ≤ F/Σ k_i + Σ k_i g_i/Σ k_i: the elastic approach without
    /// gaps, and the mean gap. Over the face width that is the mean of what both flanks lack; over the tooth pairs of a phase, that of the one that
    /// has lost least of its profiles, as it could carry the load alone. The greatest over all phases counts.
    pub fn unloaded_approach_mm(&self) -> f64 {
        let path = &self.path;
        let of_profiles = |position_mm: f64| {
            Gear::BOTH
                .map(|gear| removed_material::of_profile_mm(self, gear, path.rho_mm(gear, position_mm)))
                .iter()
                .sum::<f64>()
        };
        let step_mm = path.base_pitch_mm / PLACES_IN_PITCH as f64;
        let places = ((path.end_mm - path.start_mm) / step_mm) as usize;
        // Of each phase, the tooth pair that has lost least.
        let mut least_mm = [f64::INFINITY; PLACES_IN_PITCH];
        for k in 0..=places {
            let least = &mut least_mm[k % PLACES_IN_PITCH];
            *least = least.min(of_profiles(path.start_mm + k as f64 * step_mm));
        }
        let of_profiles_mm = least_mm.into_iter().filter(|least| least.is_finite()).fold(0.0, f64::max);
        of_profiles_mm + Gear::BOTH.map(|gear| removed_material::mean_over_width_mm(self, gear)).iter().sum::<f64>()
    }

    /// Gap between the edge in which the path ends and the mate's flank, along the line of action, with the theoretical contact point at
    /// `position_mm`.
    pub fn edge_gap_mm(&self, end: PathEnd, position_mm: f64) -> f64 {
        let gear = self.edge(end).gear;
        let edge = self.in_tangent_frame(gear, self.outermost_rho_mm(end), position_mm);
        edge.drop_mm + self.at_along(gear.mate(), -edge.along_mm, position_mm).1
    }

    fn touch_at_edge(&self, edge: FlankEdge, position_mm: f64) -> Touch {
        let FlankEdge { gear, rho_mm: start_rho, rounding_mm, .. } = edge;
        let (own, mate) = (self.path.involute[gear], self.path.involute[gear.mate()]);
        let (own_rho, mate_rho) = (self.path.rho_mm(gear, position_mm), self.path.rho_mm(gear.mate(), position_mm));
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
