//! Graded spacing of the points along a flank, finer where wear varies more.
//!
//! With s the arc length of the involute from the base circle and m the normal module, the spacing is proportional to
//!
//! ```text
//! h(s) = min over features ( h_f + g |s − feature| )          at most h_0 = 0.003 m
//! h(s) = h_0 + g₀ (s_0 − s)                                    below  s_0 = s_SAP − 0.1 m, where there is hardly any contact
//!
//! tip rounding, and as far below it         h_f = 1/24 of its length, h_0/8 at least; h_0/4 at a sharp tip edge
//! start of active profile, ± 0.05 m         h_f = h_0/3: end of the contact of the mate's tip edge
//! beginning of a relief                     h_f = h_0/3: kink of the flank
//! ```
//!
//! The number of points up to s is proportional to the integral of 1/h: with half of the points the spacing is twice as large
//! everywhere. Below the flank in contact the spacing grows as a geometric series, so that even a rack, whose base circle is
//! a hundred tooth heights below the teeth, has few points there.

use super::{Gear, GearPair, tooth::Tooth};

/// Greatest spacing h_0, in modules.
const WIDEST_MODULES: f64 = 0.003;
/// Growth g of the spacing with the distance from a feature.
const GROWTH: f64 = 0.1;
/// Growth g₀ below the flank in contact.
const GROWTH_BELOW: f64 = 0.05;
/// Distance of s_0 below the start of active profile, in modules.
const TOUCHED_BELOW_MODULES: f64 = 0.1;
/// Points on a tip rounding with h_0 elsewhere.
const ON_ROUNDING: f64 = 24.0;
/// Least h_f of a rounding, over h_0.
const FINEST: f64 = 1.0 / 8.0;
/// Spacing h_f at a sharp tip edge, over h_0.
const AT_SHARP_EDGE: f64 = 1.0 / 4.0;
/// Spacing h_f at the start of active profile and at reliefs, over h_0.
const AT_KINK: f64 = 1.0 / 3.0;
/// Half-length of the feature at the start of active profile, in modules.
const ABOUT_START_MODULES: f64 = 0.05;
/// Length over which h is linear, over h.
const PIECE: f64 = 0.25;

/// Stretch of flank with closer points.
#[derive(Debug, Clone, Copy)]
struct Feature {
    from_mm: f64,
    to_mm: f64,
    /// Spacing h_f, mm.
    distance_mm: f64,
}

/// Arc length at a radius of curvature, of the first point of the row where it is below that.
fn arc_on_flank_mm(tooth: &Tooth, rho_mm: f64) -> f64 {
    tooth.involute.arc_mm(rho_mm.max(tooth.first_rho_mm()))
}

/// Spacing h of the points along a flank, but for a factor.
struct Distances {
    features: Vec<Feature>,
    /// Greatest spacing h_0, mm.
    widest_mm: f64,
    /// Arc length s_0, mm.
    touched_from_mm: f64,
}

impl Distances {
    fn new(pair: &GearPair, gear: Gear) -> Self {
        let (tooth, module_mm) = (&pair.teeth[gear], pair.spec.normal_module_mm);
        let [edge_mm, start_mm] =
            [tooth.edge_rho_mm(), pair.active_start_rho_mm(gear)].map(|rho_mm| arc_on_flank_mm(tooth, rho_mm));
        let widest_mm = WIDEST_MODULES * module_mm;
        let rounding_mm = tooth.tip_rounding_length_mm(pair.spec.tip_rounding_mm(gear));
        let at_tip = match rounding_mm > 0.0 {
            true => (rounding_mm / ON_ROUNDING).clamp(FINEST * widest_mm, widest_mm),
            false => AT_SHARP_EDGE * widest_mm,
        };
        // The rounding of a chamfer's edge ends as far beyond it as it begins below it.
        let beyond_mm = if tooth.tip_chamfer.is_some() { 2.0 * rounding_mm } else { 0.0 };
        let about_mm = ABOUT_START_MODULES * module_mm;
        let mut features = vec![
            Feature { from_mm: edge_mm - 2.0 * rounding_mm, to_mm: edge_mm + beyond_mm, distance_mm: at_tip },
            Feature { from_mm: start_mm - about_mm, to_mm: start_mm + about_mm, distance_mm: AT_KINK * widest_mm },
        ];
        features.extend(pair.begins_of_reliefs(gear).map(|(rho_mm, _)| {
            let at_mm = arc_on_flank_mm(tooth, rho_mm);
            Feature { from_mm: at_mm, to_mm: at_mm, distance_mm: AT_KINK * widest_mm }
        }));
        Self { features, widest_mm, touched_from_mm: start_mm - TOUCHED_BELOW_MODULES * module_mm }
    }

    /// Spacing h(s).
    fn at_mm(&self, arc_mm: f64) -> f64 {
        let below_mm = (self.touched_from_mm - arc_mm).max(0.0);
        let widest_mm = self.widest_mm + GROWTH_BELOW * below_mm;
        self.features.iter().fold(widest_mm, |least, feature| {
            let away_mm = (feature.from_mm - arc_mm).max(arc_mm - feature.to_mm).max(0.0);
            least.min(feature.distance_mm + GROWTH * away_mm)
        })
    }
}

/// Arc lengths of `flank_points + 1` points, the first on the base circle, or the form circle of an internal tooth, and the last on the tip circle.
pub(super) fn arcs_mm(pair: &GearPair, gear: Gear, flank_points: usize) -> Vec<f64> {
    let tooth = &pair.teeth[gear];
    let [first_mm, tip_mm] = [tooth.first_rho_mm(), tooth.tip_rho_mm()].map(|rho_mm| tooth.involute.arc_mm(rho_mm));
    let distances = Distances::new(pair, gear);
    // Ends of pieces with linear h from the tip down, and the number of points up to each.
    let (mut ends_mm, mut points_to) = (vec![tip_mm], vec![0.0]);
    let (mut at_mm, mut points) = (tip_mm, 0.0);
    while at_mm > first_mm {
        let next_mm = (at_mm - PIECE * distances.at_mm(at_mm)).max(first_mm);
        // Simpson's rule of 1/h.
        let per_distance = [at_mm, at_mm.midpoint(next_mm), next_mm].map(|at_mm| 1.0 / distances.at_mm(at_mm));
        points += (at_mm - next_mm) * (per_distance[0] + 4.0 * per_distance[1] + per_distance[2]) / 6.0;
        at_mm = next_mm;
        ends_mm.push(at_mm);
        points_to.push(points);
    }
    let mut piece = 1;
    let mut arcs_mm: Vec<f64> = (0..=flank_points)
        .map(|from_tip| {
            let wanted = points * from_tip as f64 / flank_points as f64;
            while piece + 1 < points_to.len() && points_to[piece] < wanted {
                piece += 1;
            }
            let [before, after] = [points_to[piece - 1], points_to[piece]];
            let part = if after > before { ((wanted - before) / (after - before)).clamp(0.0, 1.0) } else { 0.0 };
            ends_mm[piece - 1] + part * (ends_mm[piece] - ends_mm[piece - 1])
        })
        .collect();
    arcs_mm.reverse();
    arcs_mm[0] = first_mm;
    arcs_mm[flank_points] = tip_mm;
    arcs_mm
}
