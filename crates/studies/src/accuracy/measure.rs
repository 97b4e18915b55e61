//! Errors of one run's curves against another's.
//!
//! Curves are compared in the relative L2 norm over their coordinate, by the trapezoidal rule at the reference's points,
//!
//! ```text
//! e = √( ∫ (y − y_ref)² dx / ∫ y_ref² dx ),
//! ```
//!
//! depths over the whole flank in the same norm over its area, arc length times face width, and single figures by their
//! relative difference |y − y_ref|/|y_ref|. Where the reference is zero everywhere the error is zero if the other is zero too,
//! and infinite otherwise.
//!
//! The pressure at a sharp tip edge is singular: its peak grows with every refinement and has no value that a model
//! could meet. Positions within [`EDGE_HALF_WIDTHS`] Hertz half-widths of A or E are left out of the comparison of peak
//! pressures where the tip edge that ends contact there is sharp, and out of that of pressures away from tip edges always.

use std::collections::BTreeMap;

use super::observed::{ObservedCycle, ObservedFlank, ObservedRun};
use super::over_width::OverWidth;
use crate::accuracy::record::ComparedQuantity;
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::run::PathPoints;

/// Length of the path of contact at a sharp tip edge without a comparable pressure, in half-widths of Hertz at the pitch
/// point.
pub const EDGE_HALF_WIDTHS: f64 = 3.0;

/// Where on the path of contact the quantities are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Windows {
    /// A to E without the neighbourhood of sharp tip edges.
    pub pressure_mm: [f64; 2],
    /// A to E without the neighbourhood of all tip edges.
    pub flank_mm: [f64; 2],
    /// Single contact, B to D.
    pub single_contact_mm: [f64; 2],
}

impl Windows {
    /// Windows of a pair with these points A–E and sharp tip edges; `half_width_mm` is Hertz's at the pitch point.
    pub fn new(points: &PathPoints, sharp: PerGear<bool>, half_width_mm: f64) -> Self {
        let edge_mm = EDGE_HALF_WIDTHS * half_width_mm;
        let [at_a, at_e] = [sharp.wheel, sharp.pinion].map(|sharp| if sharp { edge_mm } else { 0.0 });
        let single = if points.B < points.D { [points.B, points.D] } else { [points.A, points.E] };
        Self {
            pressure_mm: [points.A + at_a, points.E - at_e],
            flank_mm: [points.A + edge_mm, points.E - edge_mm],
            single_contact_mm: single,
        }
    }
}

/// Errors of `observed`, at the coordinates of `reference`, in every quantity.
pub fn errors(observed: &ObservedRun, reference: &ObservedRun, windows: &Windows) -> BTreeMap<ComparedQuantity, f64> {
    let flanks = PerGear::from_fn(|gear| [&observed.flanks[gear], &reference.flanks[gear]]);
    let profile = PerGear::from_fn(|gear| profile_error(flanks[gear][0], flanks[gear][1]));
    let peak = PerGear::from_fn(|gear| flanks[gear].map(ObservedFlank::peak_wear_um));
    let tip_edge = PerGear::from_fn(|gear| flanks[gear].map(ObservedFlank::tip_edge_wear_um));
    let cycles = [&observed.cycle, &reference.cycle];
    let x = &reference.cycle.position_mm;
    let new = cycles.map(|cycle| &cycle.transmission_error_um[..]);
    let worn = cycles.map(|cycle| &cycle.worn_transmission_error_um[..]);
    let mut errors = BTreeMap::from([
        (ComparedQuantity::WearProfile, profile.pinion.max(profile.wheel)),
        (ComparedQuantity::PinionWearProfile, profile.pinion),
        (ComparedQuantity::WheelWearProfile, profile.wheel),
        (ComparedQuantity::PinionPeakWear, difference_of(peak.pinion)),
        (ComparedQuantity::WheelPeakWear, difference_of(peak.wheel)),
        (ComparedQuantity::PinionTipEdgeWear, difference_of(tip_edge.pinion)),
        (ComparedQuantity::WheelTipEdgeWear, difference_of(tip_edge.wheel)),
        (
            ComparedQuantity::PeakPressure,
            difference_of(cycles.map(|cycle| greatest_within(cycle, windows.pressure_mm))),
        ),
        (ComparedQuantity::FlankPressure, difference_of(cycles.map(|cycle| greatest_within(cycle, windows.flank_mm)))),
        (ComparedQuantity::TransmissionError, relative_l2(x, new[0], new[1])),
        (ComparedQuantity::TransmissionErrorPeakToPeak, difference_of(new.map(peak_to_peak))),
        (ComparedQuantity::WornTransmissionError, relative_l2(x, worn[0], worn[1])),
        (ComparedQuantity::WornTransmissionErrorPeakToPeak, difference_of(worn.map(peak_to_peak))),
    ]);
    match (&observed.over_width, &reference.over_width) {
        (Some(own), Some(of_reference)) => errors.extend(errors_over_width(own, of_reference)),
        // Where the slices of one pair enter while others leave, there is no single contact.
        _ => {
            let [own, other] = cycles.map(|cycle| within(x, &cycle.half_width_mm, windows.single_contact_mm));
            let half_width = relative_l2(&within(x, x, windows.single_contact_mm), &own, &other);
            errors.extend([(ComparedQuantity::HalfWidth, half_width)]);
        }
    }
    errors
}

/// Relative difference of the first value from the second.
fn difference_of([value, reference]: [f64; 2]) -> f64 {
    relative_difference(value, reference)
}

/// Errors over the face width, at the same places.
fn errors_over_width(own: &OverWidth, reference: &OverWidth) -> [(ComparedQuantity, f64); 3] {
    let root = PerGear::from_fn(|gear| {
        relative_l2(&reference.width_mm, &own.root_wear_um[gear], &reference.root_wear_um[gear])
    });
    let both = [own, reference];
    [
        (ComparedQuantity::RootWear, root.pinion.max(root.wheel)),
        (ComparedQuantity::FaceLoadFactor, difference_of(both.map(|of| of.face_load_factor))),
        (ComparedQuantity::WornFaceLoadFactor, difference_of(both.map(|of| of.worn_face_load_factor))),
    ]
}

/// Relative L2 error of the depth over the whole flank; both at the same points and widths. Slices are as wide as each other.
pub fn profile_error(observed: &ObservedFlank, reference: &ObservedFlank) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    for (own, there) in observed.slices().zip(reference.slices()) {
        difference += integral(&reference.arc_mm, |i| (own[i] - there[i]).powi(2));
        size += integral(&reference.arc_mm, |i| there[i].powi(2));
    }
    ratio(difference.sqrt(), size.sqrt())
}

/// Greatest pressure away from sharp tip edges.
pub fn peak_pressure_mpa(cycle: &ObservedCycle, windows: &Windows) -> f64 {
    greatest_within(cycle, windows.pressure_mm)
}

fn greatest_within(cycle: &ObservedCycle, window_mm: [f64; 2]) -> f64 {
    within(&cycle.position_mm, &cycle.peak_pressure_mpa, window_mm).into_iter().fold(0.0, f64::max)
}

/// Peak-to-peak value.
pub fn peak_to_peak(values: &[f64]) -> f64 {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &y| (low.min(y), high.max(y)));
    if high >= low { high - low } else { 0.0 }
}

/// |y − y_ref|/|y_ref|.
pub fn relative_difference(value: f64, reference: f64) -> f64 {
    ratio((value - reference).abs(), reference.abs())
}

/// √(∫(y − y_ref)² dx / ∫y_ref² dx) by the trapezoidal rule.
pub fn relative_l2(x: &[f64], values: &[f64], reference: &[f64]) -> f64 {
    let difference = integral(x, |i| (values[i] - reference[i]).powi(2));
    ratio(difference.sqrt(), integral(x, |i| reference[i].powi(2)).sqrt())
}

/// ∫ y dx by the trapezoidal rule.
fn integral(x: &[f64], value: impl Fn(usize) -> f64) -> f64 {
    (1..x.len()).map(|i| 0.5 * (x[i] - x[i - 1]) * (value(i - 1) + value(i))).sum()
}

/// `difference` over `size`; 0 where both are 0.
pub fn ratio(difference: f64, size: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / size }
}

/// The values at places of `x` in the window.
fn within(x: &[f64], values: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
    x.iter().zip(values).filter(|(place, _)| (from..=to).contains(*place)).map(|(_, value)| *value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫₀¹(x − 1.1 x)² / ∫x² = 0.01: a curve off by a tenth everywhere has an error of a tenth.
    #[test]
    fn ver_a_curve_off_by_a_tenth_has_an_error_of_a_tenth() {
        let x: Vec<f64> = (0..=100).map(|i| f64::from(i) / 100.0).collect();
        let tenth: Vec<f64> = x.iter().map(|y| 1.1 * y).collect();
        assert!((relative_l2(&x, &tenth, &x) - 0.1).abs() < 1e-14);
    }

    /// ∫₀^π sin² = ∫₀^π cos² = π/2, sin and cos are orthogonal: ‖sin − cos‖/‖cos‖ = √2. The spacing is uneven on purpose.
    #[test]
    fn ver_the_norm_is_the_integrals() {
        let n = 4000;
        let x: Vec<f64> = (0..=n).map(|i| std::f64::consts::PI * (f64::from(i) / f64::from(n)).powf(1.5)).collect();
        let (sin, cos): (Vec<f64>, Vec<f64>) = x.iter().map(|x| x.sin_cos()).unzip();
        assert!((relative_l2(&x, &sin, &cos) - std::f64::consts::SQRT_2).abs() < 1e-5);
    }

    #[test]
    fn nothing_against_nothing_is_no_error() {
        assert_eq!(relative_l2(&[0.0, 1.0], &[0.0, 0.0], &[0.0, 0.0]), 0.0);
        assert_eq!(relative_difference(0.0, 0.0), 0.0);
        assert_eq!(relative_difference(1.0, 0.0), f64::INFINITY);
    }

    /// Only the ends with a sharp edge are left out: A where the wheel's tip is sharp, E where the pinion's is.
    #[test]
    fn sharp_edges_are_left_out_at_their_own_end() {
        let points = PathPoints { A: 4.0, B: 10.0, C: 14.0, D: 18.0, E: 24.0 };
        let windows = Windows::new(&points, PerGear { pinion: false, wheel: true }, 0.2);
        assert_eq!(windows.pressure_mm, [4.0 + 3.0 * 0.2, 24.0]);
        assert_eq!(windows.single_contact_mm, [10.0, 18.0]);
        assert_eq!(windows.flank_mm, [4.0 + 3.0 * 0.2, 24.0 - 3.0 * 0.2]);
        let cycle = ObservedCycle {
            position_mm: vec![4.0, 5.0, 24.0],
            peak_pressure_mpa: vec![9000.0, 1500.0, 2000.0],
            half_width_mm: vec![0.2; 3],
            transmission_error_um: vec![30.0; 3],
            worn_transmission_error_um: vec![30.0; 3],
        };
        assert_eq!(peak_pressure_mpa(&cycle, &windows), 2000.0);
    }
}
