//! Deviations of a profile or a lead after ISO 1328-1, and the flank tolerance class that they keep.
//!
//! Over the evaluation range, with the trace z(x) of heights from the design profile or helix and its mean line by least squares, a + b x:
//!
//! ```text
//! F   = max z − min z                    total deviation
//! f_f = max (z − a − b x) − min (z − a − b x)    form deviation
//! f_H = b L                              slope deviation, positive where material rises towards the tip, or to the end of the face width
//! ```
//!
//! | | profile, x: roll length | lead, x: place over the face width |
//! |---|---|---|
//! | evaluation range | from the start of active profile over 95 % of the roll length to the tip form circle | the face width less 5 % or one module, whichever is smaller, at either end |
//! | L | from the start of active profile to the tip circle | the face width |
//!
//! The start of active profile stands for the profile control diameter, which drawings give. Traces are not filtered: what a machine's filter has left of
//! them is evaluated. A class A holds where F, f_f and f_H are within its tolerances, in µm with lengths in mm, not rounded:
//!
//! ```text
//! f_HαT = (0.4 m_n + 0.001 d + 4) (√2)^(A − 5)            f_HβT = (0.05 √d + 0.35 √b + 4) (√2)^(A − 5)
//! f_fαT = (0.55 m_n + 5) (√2)^(A − 5)                     f_fβT = (0.07 √d + 0.45 √b + 4) (√2)^(A − 5)
//! F_αT  = √(f_HαT² + f_fαT²)                              F_βT  = √(f_HβT² + f_fβT²)
//! ```
//!
//! Source: ISO 1328-1:2013, definitions of profile and helix deviations, formulae of their tolerances.

use std::f64::consts::PI;

use serde::Serialize;

use gearwear_bodies::gear::{Gear, GearPair, tolerance};
use gearwear_bodies::reference::statistics::mean;

/// Part of the roll length from start of active profile to tip form circle that is evaluated.
const EVALUATED: f64 = 0.95;
/// Part of the face width that is left out at either end, where a module is more.
const LEFT_OUT: f64 = 0.05;
/// Part of the evaluation range that a trace must cover at least.
const COVERED: f64 = 0.9;
/// Classes of the standard.
const CLASSES: [f64; 2] = [1.0, 11.0];

/// Deviations of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviations {
    /// F.
    pub total_um: f64,
    /// f_f.
    pub form_um: f64,
    /// f_H.
    pub slope_um: f64,
    /// Least class that all of them keep; `None` where none of 1 to 11 does.
    pub tolerance_class: Option<u32>,
}

/// Where a trace is evaluated, and by which tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evaluation {
    /// Evaluation range.
    from_mm: f64,
    to_mm: f64,
    /// L.
    length_mm: f64,
    /// f_HT and f_fT of class 5, µm.
    slope_tolerance_um: f64,
    form_tolerance_um: f64,
}

impl Evaluation {
    /// Of profiles of a gear, over roll lengths.
    pub fn of_profile(pair: &GearPair, gear: Gear) -> Self {
        let tooth = &pair.teeth[gear];
        let start = pair.active_start_rho_mm(gear);
        let form = tooth.involute.curvature_radius_mm(pair.tip_form_radius_mm(gear));
        let (module, diameter) = (pair.spec.normal_module_mm, 2.0 * tooth.reference_radius_mm);
        Self {
            from_mm: start,
            to_mm: start + EVALUATED * (form - start),
            length_mm: tooth.edge_rho_mm() - start,
            slope_tolerance_um: tolerance::profile_slope_of_class_5_um(module, diameter),
            form_tolerance_um: 0.55 * module + 5.0,
        }
    }

    /// Of leads of a gear, over the face width.
    pub fn of_lead(pair: &GearPair, gear: Gear) -> Self {
        let (width, module) = (pair.spec.face_width_mm, pair.spec.normal_module_mm);
        let diameter = 2.0 * pair.teeth[gear].reference_radius_mm;
        let left_out = (LEFT_OUT * width).min(module);
        Self {
            from_mm: left_out,
            to_mm: width - left_out,
            length_mm: width,
            slope_tolerance_um: tolerance::helix_slope_of_class_5_um(diameter, width),
            form_tolerance_um: 0.07 * diameter.sqrt() + 0.45 * width.sqrt() + 4.0,
        }
    }

    /// Deviations of the trace with these heights at rising places; `None` where it does not cover the evaluation range.
    pub fn deviations(&self, place_mm: &[f64], height_um: &[f64]) -> Option<Deviations> {
        let (first, last) = (*place_mm.first()?, *place_mm.last()?);
        let (from, to) = (self.from_mm.max(first), self.to_mm.min(last));
        if to - from < COVERED * (self.to_mm - self.from_mm) || place_mm.len() < 3 {
            return None;
        }
        let at = |x: f64| {
            let after = place_mm.partition_point(|&place| place <= x).clamp(1, place_mm.len() - 1);
            let t = (x - place_mm[after - 1]) / (place_mm[after] - place_mm[after - 1]);
            (x, height_um[after - 1] + t * (height_um[after] - height_um[after - 1]))
        };
        let inside = place_mm.iter().copied().zip(height_um.iter().copied()).filter(|&(x, _)| from < x && x < to);
        let points: Vec<(f64, f64)> = [at(from)].into_iter().chain(inside).chain([at(to)]).collect();
        // Each point stands for half of the way to its neighbours.
        let shares: Vec<f64> = (0..points.len())
            .map(|i| 0.5 * (points[(i + 1).min(points.len() - 1)].0 - points[i.saturating_sub(1)].0))
            .collect();
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            points.iter().zip(&shares).map(|(&(x, z), share)| share * of(x, z)).sum::<f64>() / (to - from)
        };
        let (mean_x, mean_z) = (mean(&|x, _| x), mean(&|_, z| z));
        let slope = mean(&|x, z| (x - mean_x) * (z - mean_z)) / mean(&|x, _| (x - mean_x).powi(2));
        let extent = |values: &mut dyn Iterator<Item = f64>| {
            let (least, greatest) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), z| (least.min(z), most.max(z)));
            greatest - least
        };
        let total_um = extent(&mut points.iter().map(|&(_, z)| z));
        let form_um = extent(&mut points.iter().map(|&(x, z)| z - slope * (x - mean_x)));
        let slope_um = slope * self.length_mm;
        let tolerance_class = self.class(total_um, form_um, slope_um);
        Some(Deviations { total_um, form_um, slope_um, tolerance_class })
    }

    /// Error of f_H by independent errors of 1 in the heights at these places: L/√Σ(x − x̄)² over the evaluation range.
    pub fn slope_per_height(&self, place_mm: &[f64]) -> f64 {
        let inside: Vec<f64> = place_mm.iter().copied().filter(|x| (self.from_mm..=self.to_mm).contains(x)).collect();
        let middle = mean(inside.iter().copied());
        self.length_mm / inside.iter().map(|x| (x - middle).powi(2)).sum::<f64>().sqrt()
    }

    /// Greatest error of f_H by a wave of amplitude 1 and this length: 6 λ/(π X) over a range X, times L/X.
    pub fn slope_per_wave(&self, length_mm: f64) -> f64 {
        let range_mm = self.to_mm - self.from_mm;
        6.0 * length_mm / (PI * range_mm) * self.length_mm / range_mm
    }

    fn class(&self, total_um: f64, form_um: f64, slope_um: f64) -> Option<u32> {
        let total_tolerance_um = self.slope_tolerance_um.hypot(self.form_tolerance_um);
        let worst = (total_um / total_tolerance_um)
            .max(form_um / self.form_tolerance_um)
            .max(slope_um.abs() / self.slope_tolerance_um);
        // From one class to the next, tolerances grow by √2.
        let class = (tolerance::CLASS_OF_FORMULAE + 2.0 * worst.log2()).ceil().max(CLASSES[0]);
        (class <= CLASSES[1]).then_some(class as u32)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const OF_TEST: Evaluation =
        Evaluation { from_mm: 6.0, to_mm: 20.0, length_mm: 16.0, slope_tolerance_um: 6.0, form_tolerance_um: 8.0 };

    /// A profile of known f_H and f_f: a line, and a whole number of cosines that are even about the middle.
    #[test]
    fn ver_known_deviations_come_back() {
        let places: Vec<f64> = (0..=4000).map(|i| 5.0 + 16.0 * (f64::from(i) / 4000.0).powf(0.8)).collect();
        let height = |x: f64| 7.0 + 0.35 * (x - 13.0) + 1.5 * (TAU * 3.0 * (x - 13.0) / 14.0).cos();
        let heights: Vec<f64> = places.iter().map(|&x| height(x)).collect();
        let found = OF_TEST.deviations(&places, &heights).unwrap();
        assert!((found.slope_um - 0.35 * 16.0).abs() < 1e-3 && (found.form_um - 3.0).abs() < 1e-3, "{found:?}");
        assert!(found.total_um > 3.0 && found.total_um < 3.0 + 0.35 * 14.0, "{found:?}");
        // 5.6 of 6 µm is class 5, twice that class 7; a slope of a hundred times is none.
        assert_eq!(found.tolerance_class, Some(5));
        let twice: Vec<f64> = heights.iter().map(|z| 2.0 * z).collect();
        assert_eq!(OF_TEST.deviations(&places, &twice).unwrap().tolerance_class, Some(7));
        let steep: Vec<f64> = heights.iter().map(|z| 100.0 * z).collect();
        assert_eq!(OF_TEST.deviations(&places, &steep).unwrap().tolerance_class, None);
        let level = vec![0.0; places.len()];
        assert_eq!(OF_TEST.deviations(&places, &level).unwrap().tolerance_class, Some(1));
        // What lies outside the range does not count, and a trace of half of it is none.
        let cut = places.iter().zip(&heights).map(|(&x, &z)| if (5.9..=20.1).contains(&x) { z } else { z - 50.0 });
        let cut = OF_TEST.deviations(&places, &cut.collect::<Vec<_>>()).unwrap();
        assert!((cut.form_um - found.form_um).abs() < 1e-9, "{cut:?}");
        assert_eq!(OF_TEST.deviations(&places[..2000], &heights[..2000]), None);
    }
}
