//! Interference of the tip of one gear with the fillet of the other.
//!
//! Above the form circle two involutes never overlap. Below it the tip of the mate may overlap the root
//! trochoid, which undercut teeth have instead of the lower involute. The tip corner at radius r_a of the mate, with the radius of
//! curvature ρ_a, is followed through the space of the gear. With the theoretical contact point at ρ on the gear and at
//! ρ' = T1T2 − ρ on its mate, it is at (along, drop) in the mate's tangent frame, and relative to the gear's axis at
//!
//! ```text
//! q = (r_b − along, −ρ − drop)        r = |q|        φ = ∠q + ρ/r_b − ψ_b + π/z
//! ```
//!
//! with φ the angle from the middle of the space towards the working flank. The trochoid is at the angle φ_f(r), and the gap is
//! r (φ_f − |φ|), along the circle through the corner. A rounding of the tip edge is followed at several points of its arc.
//!
//! Source: F. L. Litvin, *Gear Geometry and Applied Theory* (2004), sections 6.5 and 13: interference as overlap of the generated shapes.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::{Gear, GearPair, tooth::Tooth};

/// Number of points of the trochoid.
const FILLET_POINTS: usize = 400;
/// Number of positions of the mate's tip below the form circle.
const PLACES: usize = 200;
/// Number of points of the arc of a rounding.
const ARC_POINTS: usize = 5;
/// Points on a chamfer.
const CHAMFER_POINTS: usize = 4;
/// Iterations of the search for the least gap between two positions.
const REFINEMENTS: usize = 40;

/// Fillet of a space as angle from its middle over the radius, from the root circle up.
struct FilletRoom {
    radius_mm: Vec<f64>,
    angle_rad: Vec<f64>,
}

impl FilletRoom {
    fn new(tooth: &Tooth) -> Self {
        let (mut radius_mm, mut angle_rad) = (Vec::new(), Vec::new());
        for k in 0..=FILLET_POINTS {
            let t = FRAC_PI_2 + (tooth.fillet_end_angle_rad - FRAC_PI_2) * k as f64 / FILLET_POINTS as f64;
            let point = tooth.trochoid.point_mm(t);
            let (radius, angle) = tooth.polar(point);
            radius_mm.push(radius);
            angle_rad.push(angle);
        }
        Self { radius_mm, angle_rad }
    }

    /// Angle φ_f at a radius between root circle and form circle.
    fn at(&self, radius_mm: f64) -> f64 {
        let after = self.radius_mm.partition_point(|&r| r <= radius_mm).clamp(1, FILLET_POINTS);
        let [low, high] = [self.radius_mm[after - 1], self.radius_mm[after]];
        let weight = ((radius_mm - low) / (high - low)).clamp(0.0, 1.0);
        self.angle_rad[after - 1] + weight * (self.angle_rad[after] - self.angle_rad[after - 1])
    }
}

/// Tip of the mate in a space of a gear.
struct TipInSpace<'a> {
    gear: &'a Tooth,
    mate: &'a Tooth,
    line_of_action_mm: f64,
    tip_radius_mm: f64,
    rounding_mm: f64,
    room: FilletRoom,
}

impl TipInSpace<'_> {
    /// Least gap of the tip's points below the form circle with the corner turned by `turn_rad` past the line of action.
    fn gap_mm(&self, turn_rad: f64) -> f64 {
        let (own, mate) = (&self.gear.involute, &self.mate.involute);
        let tip_rho = mate.curvature_radius_mm(self.tip_radius_mm);
        let mate_rho = tip_rho - mate.base_radius_mm * turn_rad;
        let own_rho = self.line_of_action_mm - mate_rho;
        let axis = Vector2::new(own.base_radius_mm, -own_rho);
        // Arc of the rounding, or the corner alone.
        let chamfer = self.mate.tip_chamfer;
        let edge_rho = mate.curvature_radius_mm(self.tip_radius_mm - chamfer.map_or(0.0, |chamfer| chamfer.height_mm));
        let length = self.mate.tip_rounding_length_mm(self.rounding_mm);
        let start_rho = mate.signed((edge_rho * edge_rho - 2.0 * mate.base_radius_mm * length).max(0.0).sqrt());
        let turn = (start_rho - mate_rho) / mate.base_radius_mm;
        let (sin, cos) = turn.sin_cos();
        let start = mate.in_tangent_frame(start_rho, mate_rho);
        let centre = Vector2::new(start.along_mm, start.drop_mm) + self.rounding_mm * Vector2::new(-sin, cos);
        let whole = chamfer.map_or(FRAC_PI_2, |chamfer| chamfer.angle_rad) - mate.pressure_angle_rad(start_rho);
        let points = if self.rounding_mm > 0.0 { ARC_POINTS } else { 1 };
        let of_arc = (0..points)
            .map(|k| {
                let (out, up) = (whole * k as f64 / (ARC_POINTS - 1) as f64).sin_cos();
                let point = centre + self.rounding_mm * (up * Vector2::new(sin, -cos) + out * Vector2::new(cos, sin));
                self.point_gap_mm(axis - point, own_rho)
            })
            .fold(f64::INFINITY, f64::min);
        let Some(length_mm) = self.mate.chamfer_length_mm() else { return of_arc };
        // The chamfer, turned by γ from the flank at its edge.
        let edge = mate.in_tangent_frame(edge_rho, mate_rho);
        let turned = (edge_rho - mate_rho) / mate.base_radius_mm + self.mate.edge_turn_rad();
        let direction = Vector2::new(turned.cos(), turned.sin());
        (1..=CHAMFER_POINTS)
            .map(|k| {
                let along_mm = length_mm * k as f64 / CHAMFER_POINTS as f64;
                let point = Vector2::new(edge.along_mm, edge.drop_mm) + along_mm * direction;
                self.point_gap_mm(axis - point, own_rho)
            })
            .fold(of_arc, f64::min)
    }

    /// Gap of a point of the tip, `seen` from the gear's axis; infinite above the form circle.
    fn point_gap_mm(&self, seen: Vector2<f64>, own_rho: f64) -> f64 {
        // Angles are counted from the tangent point of the line of action.
        let (radius, seen_rad) = self.gear.polar(Vector2::new(seen.y, seen.x));
        if radius >= self.gear.root_form_radius_mm {
            return f64::INFINITY;
        }
        let space = PI / self.gear.z();
        let rolled = own_rho / self.gear.involute.base_radius_mm;
        let from_middle = seen_rad + rolled - self.gear.base_half_angle_rad + space;
        radius * (self.room.at(radius) - self.gear.involute.signed(from_middle.abs()))
    }

    /// Least gap over all positions.
    fn least_gap_mm(&self, centre_distance_mm: f64, working_pressure_angle_rad: f64) -> f64 {
        let (a, tip, form) = (centre_distance_mm, self.tip_radius_mm, self.gear.root_form_radius_mm);
        let cosine = (a * a + tip * tip - form * form) / (2.0 * a * tip);
        if cosine >= 1.0 {
            return f64::INFINITY;
        }
        let reach = cosine.max(-1.0).acos();
        let on_line = (self.mate.involute.base_radius_mm / tip).min(1.0).acos() - working_pressure_angle_rad;
        let step = 2.0 * reach / PLACES as f64;
        let places = (0..=PLACES).map(|k| on_line - reach + step * k as f64);
        let gaps = places.map(|turn_rad| (turn_rad, self.gap_mm(turn_rad)));
        let Some((nearest, mut smallest)) = gaps.min_by(|(_, a), (_, b)| a.total_cmp(b)) else { return f64::INFINITY };
        let (mut low, mut high) = (nearest - step, nearest + step);
        for _ in 0..REFINEMENTS {
            let thirds = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            let [left, right] = thirds.map(|turn| self.gap_mm(turn));
            smallest = smallest.min(left).min(right);
            if left <= right { high = thirds[1] } else { low = thirds[0] }
        }
        smallest
    }
}

impl GearPair {
    /// Least gap between the fillet of `gear` and the tip of its mate for a tip radius of the mate, along the circle through the tip, mm;
    /// negative where they overlap, infinite where the tip stays above the form circle.
    pub fn fillet_gap_mm(&self, gear: Gear, mate_tip_radius_mm: f64) -> f64 {
        TipInSpace {
            gear: &self.teeth[gear],
            mate: &self.teeth[gear.mate()],
            line_of_action_mm: self.path.line_of_action_mm,
            tip_radius_mm: mate_tip_radius_mm,
            rounding_mm: self.spec.tip_rounding_mm(gear.mate()),
            room: FilletRoom::new(&self.teeth[gear]),
        }
        .least_gap_mm(self.spec.centre_distance_mm, self.working_pressure_angle_rad)
    }

    /// Greatest tip radius of the mate of `gear`, below its own, with a gap of `least_gap_mm` to the fillet.
    pub(super) fn greatest_mate_tip_radius_mm(&self, gear: Gear, least_gap_mm: f64) -> f64 {
        let mate = &self.teeth[gear.mate()];
        // An internal tooth has its base circle beyond its tip.
        let low = if mate.is_internal() { mate.root_form_radius_mm } else { mate.involute.base_radius_mm };
        let (mut free, mut overlapping) = (low, mate.tip_radius_mm);
        for _ in 0..60 {
            let middle = 0.5 * (free + overlapping);
            if self.fillet_gap_mm(gear, middle) >= least_gap_mm { free = middle } else { overlapping = middle }
        }
        free
    }
}
