//! Figures of pressure that converge: of the flanks between their tip-edge zones, and of the tip edges.
//!
//! The greatest pressure of a mesh at a single point does not converge: towards a tip edge it grows with every refinement of the
//! edge's contact, and where a linear relief begins the flank has a kink, to which the pressure of elastic bodies rises with the logarithm
//! of the distance. Both are narrow spikes, whose load and whose mean over a length do converge:
//!
//! ```text
//! flank pressure        max over positions and places of  (1/l) ∫_l p dx,   l wholly between the tip-edge zones of both flanks
//! tip-edge load         max of the line load of a contact that reaches a tip edge or its rounding
//! tip-edge pressure     max over those contacts of  (1/0.04 mm) ∫ p dx  in the tip-edge zones
//! ```
//!
//! with l = min(0.04 mm, 0.4 a_C) ([`FlankZones::pressure_length_mm`]): a mean over it lies by l²/(24 a²), at most 0.7 %, below the peak of
//! a Hertz ellipse. A place lies in a tip-edge zone where it does so on either flank; opposite the flank of one gear below its start of active profile
//! lies the tip-edge zone of the other.

use serde::{Deserialize, Serialize};

use super::flank_motion::on_tangent;
use crate::contact::PressedCell;
use gearwear_bodies::gear::{
    Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank_zones::FlankZones, slices::greatest_over_width,
};

/// Length over which the pressure of a tip edge is a mean, mm.
pub const TIP_EDGE_MEAN_OVER_MM: f64 = 0.04;
/// Distance from a tip edge within which a contact reaches it, mm.
const AT_EDGE_MM: f64 = 1e-6;

/// Figures of the pressure over a mesh cycle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PressureFigures {
    /// Greatest pressure between the tip-edge zones, MPa.
    pub flank_mpa: f64,
    /// Greatest line load of a contact that reaches a tip edge, N/mm; 0 where none does.
    pub tip_edge_line_load_n_per_mm: f64,
    /// Greatest pressure of such a contact as a mean over [`TIP_EDGE_MEAN_OVER_MM`], MPa.
    pub tip_edge_mean_mpa: f64,
}

impl PressureFigures {
    /// Takes the figures of another contact into account.
    pub(crate) fn note(&mut self, other: Self) {
        self.flank_mpa = self.flank_mpa.max(other.flank_mpa);
        self.tip_edge_line_load_n_per_mm = self.tip_edge_line_load_n_per_mm.max(other.tip_edge_line_load_n_per_mm);
        self.tip_edge_mean_mpa = self.tip_edge_mean_mpa.max(other.tip_edge_mean_mpa);
    }

    /// Takes into account the figures of all slices over the face width, in their order.
    pub(crate) fn note_slices(&mut self, of_slices: &[Self]) {
        let figures: [fn(&Self) -> f64; 3] =
            [|slice| slice.flank_mpa, |slice| slice.tip_edge_line_load_n_per_mm, |slice| slice.tip_edge_mean_mpa];
        let [flank_mpa, tip_edge_line_load_n_per_mm, tip_edge_mean_mpa] =
            figures.map(|figure| greatest_over_width(&of_slices.iter().map(figure).collect::<Vec<_>>()));
        self.note(Self { flank_mpa, tip_edge_line_load_n_per_mm, tip_edge_mean_mpa });
    }
}

/// Limits of the zones of both flanks, by coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankParts {
    /// Start of active profile, begin of the tip-edge zone, begin of the edge or its rounding, mm.
    coordinates_mm: PerGear<[f64; 3]>,
    /// Length over which the pressure of the flank is a mean, mm.
    flank_mean_over_mm: f64,
}

impl FlankParts {
    /// Limits of the zones of a pair.
    pub fn new(pair: &GearPair, zones: &PerGear<FlankZones>) -> Self {
        let coordinates_mm = PerGear::from_fn(|gear| {
            let (involute, own) = (pair.teeth[gear].involute, &zones[gear]);
            [own.active_start_radius_mm, own.tip_edge_radius_mm, own.tip_end_radius_mm]
                .map(|radius_mm| involute.curvature_radius_mm(radius_mm))
        });
        Self { coordinates_mm, flank_mean_over_mm: zones.pinion.pressure_length_mm }
    }

    /// Takes a contact with its theoretical contact point at `position_mm` into account.
    pub(crate) fn note(
        &self,
        geometry: &dyn ConjugateFlanks,
        position_mm: f64,
        cells: &[PressedCell],
        figures: &mut PressureFigures,
    ) {
        let [pinion, wheel] = Gear::BOTH.map(|gear| {
            self.coordinates_mm[gear]
                .map(|at_mm| on_tangent(gear, geometry.in_tangent_frame(gear, at_mm, position_mm).along_mm))
        });
        let (from_mm, to_mm) = (pinion[0].max(wheel[1]), pinion[1].min(wheel[0]));
        let parts = ContactParts {
            flank_mm: [from_mm, to_mm.max(from_mm)],
            edges_mm: [wheel[2], pinion[2]],
            flank_mean_over_mm: self.flank_mean_over_mm,
        };
        parts.note(cells, figures);
    }
}

/// Limits of the zones along a contact, towards the pinion's tip, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactParts {
    /// Both ends of the flank between the tip-edge zones.
    pub flank_mm: [f64; 2],
    /// Begin of the tip edge or its rounding: the wheel's, below, and the pinion's, above.
    pub edges_mm: [f64; 2],
    /// Length over which the pressure of the flank is a mean.
    pub flank_mean_over_mm: f64,
}

impl ContactParts {
    /// Takes a contact into account, of cells in their order. A mean is no greater than the greatest pressure: where that is no greater than the mean of
    /// another contact, none is looked for.
    pub(crate) fn note(&self, cells: &[PressedCell], figures: &mut PressureFigures) {
        let mut pressed = cells.iter().filter(|cell| cell.pressure_mpa > 0.0);
        let Some(first) = pressed.next() else { return };
        let last = pressed.next_back().unwrap_or(first);
        let peak_mpa = cells.iter().map(|cell| cell.pressure_mpa).fold(0.0, f64::max);
        let [from_mm, to_mm] = self.flank_mm;
        if peak_mpa > figures.flank_mpa {
            let mean_mpa = greatest_mean_mpa(cells, self.flank_mean_over_mm, self.flank_mm, self.flank_mm);
            figures.flank_mpa = figures.flank_mpa.max(mean_mpa);
        }
        let [wheel_edge_mm, pinion_edge_mm] = self.edges_mm;
        if first.lower_mm > wheel_edge_mm + AT_EDGE_MM && last.upper_mm < pinion_edge_mm - AT_EDGE_MM {
            return;
        }
        let load_n_per_mm = cells.iter().map(PressedCell::line_load_n_per_mm).sum();
        figures.tip_edge_line_load_n_per_mm = figures.tip_edge_line_load_n_per_mm.max(load_n_per_mm);
        if peak_mpa <= figures.tip_edge_mean_mpa {
            return;
        }
        let anywhere = [first.lower_mm - TIP_EDGE_MEAN_OVER_MM, last.upper_mm + TIP_EDGE_MEAN_OVER_MM];
        let sides = [[f64::NEG_INFINITY, from_mm], [to_mm, f64::INFINITY]];
        figures.tip_edge_mean_mpa = sides
            .into_iter()
            .map(|side| greatest_mean_mpa(cells, TIP_EDGE_MEAN_OVER_MM, anywhere, side))
            .fold(figures.tip_edge_mean_mpa, f64::max);
    }
}

/// Greatest mean of the pressure over a length that lies wholly `within_mm`, where only the load within `counted_mm` counts.
fn greatest_mean_mpa(cells: &[PressedCell], length_mm: f64, within_mm: [f64; 2], counted_mm: [f64; 2]) -> f64 {
    let [from_mm, to_mm] = [within_mm[0], within_mm[1] - length_mm];
    if to_mm < from_mm {
        return 0.0;
    }
    let counted: Vec<PressedCell> = cells.iter().filter_map(|cell| cell.within(counted_mm)).collect();
    let mut below_cells = Vec::with_capacity(counted.len());
    let mut sum = 0.0;
    for cell in &counted {
        below_cells.push(sum);
        sum += cell.line_load_n_per_mm();
    }
    // The mean grows with the place as long as the pressure at the one end is above that at the other: it turns where a cell begins or ends.
    let ends = counted.iter().flat_map(|cell| [cell.lower_mm, cell.upper_mm]);
    ends.flat_map(|end_mm| [end_mm, end_mm - length_mm])
        .map(|begin_mm| {
            let begin_mm = begin_mm.clamp(from_mm, to_mm);
            let [after, before] =
                [begin_mm + length_mm, begin_mm].map(|at_mm| load_below_n_per_mm(&counted, &below_cells, at_mm));
            (after - before) / length_mm
        })
        .fold(0.0, f64::max)
}

/// Load of `cells` below a place, of which `below_cells` lies below each of them.
fn load_below_n_per_mm(cells: &[PressedCell], below_cells: &[f64], at_mm: f64) -> f64 {
    let after = cells.partition_point(|cell| cell.lower_mm <= at_mm);
    let Some(cell) = after.checked_sub(1).map(|k| &cells[k]) else { return 0.0 };
    below_cells[after - 1] + cell.pressure_mpa * (at_mm.min(cell.upper_mm) - cell.lower_mm)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hertz's ellipse of half-width `a` about 0 as means over 400 cells.
    fn ellipse(a_mm: f64, peak_mpa: f64) -> Vec<PressedCell> {
        (0..400)
            .map(|k| {
                let [lower, upper] = [k, k + 1].map(|k| (f64::from(k) / 200.0 - 1.0).min(1.0));
                let [below, to_end] = [lower, upper].map(|u: f64| 0.5 * (u * (1.0 - u * u).max(0.0).sqrt() + u.asin()));
                let mean = (to_end - below) / (upper - lower);
                PressedCell { lower_mm: a_mm * lower, upper_mm: a_mm * upper, pressure_mpa: peak_mpa * mean }
            })
            .collect()
    }

    fn figures_of(parts: ContactParts, cells: &[PressedCell]) -> PressureFigures {
        let mut figures = PressureFigures::default();
        parts.note(cells, &mut figures);
        figures
    }

    /// Closed form: the mean of an ellipse over ±h about its middle is p₀ (√(1 − u²) + asin(u)/u)/2 with u = h/a, whether at the flank or at an
    /// edge; the load is π a p₀/2.
    #[test]
    fn ver_means_over_an_ellipse() {
        let (a, peak) = (0.1, 1200.0);
        let cells = ellipse(a, peak);
        let [flank_mean, tip_mean] = [0.03, TIP_EDGE_MEAN_OVER_MM].map(|length| {
            let u: f64 = 0.5 * length / a;
            0.5 * peak * ((1.0 - u * u).sqrt() + u.asin() / u)
        });
        let away = ContactParts { flank_mm: [-1.0, 1.0], edges_mm: [-2.0, 2.0], flank_mean_over_mm: 0.03 };
        let figures = figures_of(away, &cells);
        assert!((figures.flank_mpa / flank_mean - 1.0).abs() < 1e-4, "{figures:?}");
        assert_eq!(figures.tip_edge_line_load_n_per_mm, 0.0);
        assert_eq!(figures.tip_edge_mean_mpa, 0.0);
        // At the wheel's tip edge, and at the pinion's.
        for (flank_mm, edges_mm) in [([0.5, 1.0], [-0.05, 2.0]), ([-1.0, -0.5], [-2.0, 0.05])] {
            let at_edge = figures_of(ContactParts { flank_mm, edges_mm, flank_mean_over_mm: 0.03 }, &cells);
            let load = 0.5 * std::f64::consts::PI * a * peak;
            assert_eq!(at_edge.flank_mpa, 0.0);
            assert!((at_edge.tip_edge_line_load_n_per_mm / load - 1.0).abs() < 1e-9, "{at_edge:?}");
            assert!((at_edge.tip_edge_mean_mpa / tip_mean - 1.0).abs() < 1e-4, "{at_edge:?}");
        }
        // A zone that begins in the contact: only the flank beyond it counts, and its greatest pressure is where the zone ends.
        let cut = ContactParts { flank_mm: [0.05, 1.0], edges_mm: [-2.0, 2.0], flank_mean_over_mm: 1e-6 };
        let at_end = peak * (1.0_f64 - 0.25).sqrt();
        assert!((figures_of(cut, &cells).flank_mpa / at_end - 1.0).abs() < 5e-3);
    }

    /// The greatest of two contacts does not depend on their order.
    #[test]
    fn ver_lesser_contacts_are_passed_over() {
        let parts = ContactParts { flank_mm: [-1.0, 0.0], edges_mm: [-2.0, 0.02], flank_mean_over_mm: 0.03 };
        let (lesser, greater) = (ellipse(0.12, 900.0), ellipse(0.1, 1200.0));
        let mut figures = figures_of(parts, &lesser);
        parts.note(&greater, &mut figures);
        let mut in_other_order = figures_of(parts, &greater);
        parts.note(&lesser, &mut in_other_order);
        assert_eq!(figures, in_other_order);
        let of_greater = figures_of(parts, &greater);
        assert_eq!(
            [figures.flank_mpa, figures.tip_edge_mean_mpa],
            [of_greater.flank_mpa, of_greater.tip_edge_mean_mpa]
        );
    }

    /// A contact narrower than the length has its load over the length as mean, however sharp its peak.
    #[test]
    fn ver_a_spike_counts_with_its_load() {
        for a in [0.01, 0.001] {
            let cells = ellipse(a, 80.0 / a);
            let parts = ContactParts { flank_mm: [0.5, 1.0], edges_mm: [0.0, 2.0], flank_mean_over_mm: 0.03 };
            let expected = 0.5 * std::f64::consts::PI * 80.0 / TIP_EDGE_MEAN_OVER_MM;
            assert!((figures_of(parts, &cells).tip_edge_mean_mpa / expected - 1.0).abs() < 1e-9);
        }
    }
}
