//! The simplified surface: Hertz's mean pressure and sliding distances in closed form.
//!
//! A flank point feels the mean pressure of the strip while it slides the distance that the mate's surface gains on it
//! over the strip's width (Andersson):
//!
//! ```text
//! p_m = w / (2 a)          s = 2 a |v_s| / v          h = k p_m s = k w |ζ|
//! ```
//!
//! with v the point's own surface velocity and ζ its specific sliding, all taken with the theoretical contact point at
//! the flank point. Only points between A and E wear, and the wear jumps with the load where the number of pairs
//! changes, unlike on surfaces that integrate the pressure over the strip.
//!
//! Source: S. Andersson (1975) and the thesis, section 3.4 and appendix 1 (papers A's comparison and E).

use super::{
    ContactSurface, Flanks, Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep,
    hertz::ClosedFormPair,
};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use gearwear_bodies::material::Material;

/// Hertz's mean pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzMean {
    /// Material of each gear.
    pub material: PerGear<Material>,
}

impl ContactSurface for HertzMean {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        Box::new(HertzMeanPair {
            closed_form: ClosedFormPair::new(flanks, &self.material, position_mm),
            passed: cell.map(|cell| PerGear::from_fn(|gear| PassedPoints::new(flanks, gear, cell))),
        })
    }

    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        super::hertz::flattening(geometry, &self.material, position_mm).approach_mm(line_load_n_per_mm)
    }

    fn touches_in_points(&self) -> bool {
        true
    }
}

/// Points that the theoretical contact point passes while it moves through a cell.
struct PassedPoints {
    first_point: usize,
    /// |ζ| of each point, times the part of its share of the flank that is passed.
    specific_sliding: Vec<f64>,
}

impl PassedPoints {
    fn new(flanks: Flanks<'_>, gear: Gear, cell: PositionCell) -> Self {
        let (geometry, grid) = (flanks.geometry, flanks.grid[gear]);
        let [a, b] = [cell.lower_mm, cell.upper_mm].map(|position| geometry.contact_coordinate_mm(gear, position));
        let first_point = grid.place(a.min(b)).index;
        let last = (grid.place(a.max(b)).index + 1).min(grid.len() - 1);
        let specific_sliding = (first_point..=last)
            .map(|i| {
                // The share of a point reaches halfway to its neighbours.
                let [begin, end] = [i.saturating_sub(1), i].map(|i| {
                    let next = grid.coordinate_mm[(i + 1).min(grid.len() - 1)];
                    geometry.position_at_mm(gear, 0.5 * (grid.coordinate_mm[i] + next))
                });
                let begin = if i == 0 { geometry.position_at_mm(gear, grid.coordinate_mm[0]) } else { begin };
                let (from, to) = (begin.min(end).max(cell.lower_mm), begin.max(end).min(cell.upper_mm));
                if from < to { geometry.sliding_mm(from, to) / grid.share_mm(i) } else { 0.0 }
            })
            .collect();
        Self { first_point, specific_sliding }
    }
}

/// One tooth pair with Hertz's mean pressure.
struct HertzMeanPair<'a> {
    closed_form: ClosedFormPair<'a>,
    passed: Option<PerGear<PassedPoints>>,
}

impl PairContact for HertzMeanPair<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        self.closed_form.set_removed(removed_mm);
    }

    fn touch_mm(&self) -> f64 {
        self.closed_form.touch_mm()
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        self.closed_form.load_at(indentation_mm)
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.closed_form.ample_indentation_mm(line_load_n_per_mm)
    }

    fn sweep(&self, gear: Gear, _removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        let Some(passed) = &self.passed else { return sweep.begin(0, &[]) };
        let points = &passed[gear];
        let Footprint { peak_pressure_mpa, half_width_mm, .. } = self.footprint();
        sweep.begin(points.first_point, &points.specific_sliding);
        sweep.sliding_mm.iter_mut().for_each(|zeta| *zeta *= 2.0 * half_width_mm);
        sweep.pressure_mpa.fill(peak_pressure_mpa);
    }

    fn sweeps_across(&self) -> bool {
        false
    }

    fn contact_of_points(&self, gear: Gear, _removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        let points = self.passed.as_ref().map_or(0, |passed| passed[gear].specific_sliding.len());
        vec![PointContact { pressure_mpa: self.footprint().peak_pressure_mpa, contact_fraction: 1.0 }; points]
    }

    fn footprint(&self) -> Footprint {
        let half_width_mm = self.closed_form.flattening.contact.loaded(self.closed_form.line_load).half_width_mm;
        let mean = if half_width_mm > 0.0 { self.closed_form.line_load / (2.0 * half_width_mm) } else { 0.0 };
        Footprint {
            peak_pressure_mpa: mean,
            half_width_mm,
            equivalent_half_width_mm: half_width_mm,
            at_sharp_edge: false,
        }
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        let Footprint { peak_pressure_mpa, half_width_mm, .. } = self.footprint();
        PressedCell::even(half_width_mm, peak_pressure_mpa)
    }
}
