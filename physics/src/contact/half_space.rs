//! Elastic half-planes against the real, modified and worn gap.
//!
//! Each body is an elastic half-plane where it touches: pressure at one place lowers the surface everywhere. On plain
//! involutes this is Hertz's contact; on worn ones it is what Hertz's theory cannot know, with the elasticity that the
//! independent springs of [`winkler`](super::winkler) lack. Displacements are measured relative to the tooth's centre line
//! along the line of action ([`half_plane`](crate::reference::half_plane)), so that the load follows from the approach by
//! itself, and agrees with the closed-form flattening of plain flanks.
//!
//! The pressure is uniform on evenly spaced cells ([`ElasticCells`]). There are at least [`CELLS_PER_HALF_WIDTH`] of them in
//! the half-width of the plain contact under the whole load: the peak pressure of a parabolic gap is then within 0.1 % of
//! Hertz's and the half-width within 0.5 % from a half of the load on. A flank point's pressure is the mean of the field
//! ([`SweptField`]) over the stretch that the point moves while the contact stands for one loading position.
//!
//! Cells do not see waves of wear shorter than twice their width for what they are. So that such waves are never driven up,
//! material removed counts in the gap of a cell with the same weights with which the pressure of the cell counts at flank
//! points: the tent of straight lines to its neighbours, here ¼, ½, ¼ at the cell's ends and centre. Whatever the wave, what
//! stands up then never wears less than what lies low.
//!
//! Where neighbouring stretches have lost more than others, flanks may touch a second time beside the contact: a tip edge on the ridge that
//! its mate's wear ends in below the active profile. The window reaches as far as that can be, from the geometric gap, what both have lost
//! at least there, and how far the pressure lowers both surfaces at its end.
//!
//! Limits: the half-planes go on beyond a tip edge, as if the tooth did not end there. Towards a sharp edge the pressure grows
//! without bound, and what is given there is the mean of the outermost cell.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), sections 2.5 and 5.9.

use super::{
    ContactSurface, Effort, Flanks, Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep,
    elastic_cells::ElasticCells,
    growing_window::{GrowingWindow, Sampled},
    hertz,
    strip::{Strip, Window, gaps_beside_mm, least_removed_mm, point_distance_mm},
    swept_field::SweptField,
};
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use crate::material::Material;
use crate::reference::{
    flattening::Flattening,
    half_plane::{cell_compliance_at_mm_per_mpa, cell_compliance_mm_per_mpa},
};

/// The surface: elastic constants and the load that contacts are expected to carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Of each gear.
    pub material: PerGear<Material>,
    /// Load that the first window and the cells are cut for, N/mm.
    pub expected_line_load_n_per_mm: f64,
}

/// Fewest cells in the half-width of the plain contact under the expected load.
pub(crate) const CELLS_PER_HALF_WIDTH: f64 = 16.0;
/// As many at most, where the flank points are finer.
const FINEST_CELLS_PER_HALF_WIDTH: f64 = 40.0;
/// Cells are no wider than this many flank points, within those limits.
const POINTS_PER_CELL: f64 = 2.0;
/// Half-length of the first window over the half-width of the plain contact under the expected load.
const FIRST_WINDOW: f64 = 1.25;
/// Cells at an end of the window that is not real which must stay without pressure.
const FREE_CELLS: usize = 2;
/// Removed everywhere, less than this part of the gap at the end of a window is not looked for.
const LITTLE_REMOVED: f64 = 0.05;
/// Fewest cells in a window.
const LEAST_CELLS: usize = 4;
/// Most cells in a window: those of a window that has grown beyond are wider.
const MOST_CELLS: f64 = 320.0;
/// Part of a cell that is rounding, per cell.
const CELL_ROUND_OFF: f64 = 1e-9;
/// Measured on the preset `fzg-c`, rounded.
const EFFORT: Effort = Effort { of_equilibrium: 20.0, of_clean_start: 15.0 };

impl ContactSurface for HalfSpace {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        let flattening = hertz::flattening(&flanks.geometry, &self.material, position_mm);
        let half_width = flattening.contact.loaded(self.expected_line_load_n_per_mm).half_width_mm;
        let stretch =
            ObservedStretch { flanks, position_mm, cell, flattening, cell_mm: self.cell_width_mm(flanks, position_mm) };
        Box::new(HalfSpacePair {
            window: GrowingWindow::new(stretch, FIRST_WINDOW * half_width),
            samples: Vec::new(),
            gap: Vec::new(),
            touch: 0.0,
            removed_everywhere: 0.0,
        })
    }

    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        hertz::flattening(geometry, &self.material, position_mm).approach_mm(line_load_n_per_mm)
    }

    fn effort(&self) -> Effort {
        EFFORT
    }
}

impl HalfSpace {
    /// About two flank points, within what the contact needs.
    fn cell_width_mm(&self, flanks: Flanks<'_>, position_mm: f64) -> f64 {
        let contact = hertz::flattening(&flanks.geometry, &self.material, position_mm).contact;
        let half_width = contact.loaded(self.expected_line_load_n_per_mm).half_width_mm;
        (POINTS_PER_CELL * point_distance_mm(flanks, position_mm))
            .clamp(half_width / FINEST_CELLS_PER_HALF_WIDTH, half_width / CELLS_PER_HALF_WIDTH)
    }
}

/// The flanks of a pair at its position.
struct ObservedStretch<'a> {
    flanks: Flanks<'a>,
    position_mm: f64,
    cell: Option<PositionCell>,
    flattening: Flattening,
    cell_mm: f64,
}

/// What is seen through a window.
struct SampledStretch {
    strip: Strip,
    cells: ElasticCells,
    swept: SweptField,
}

impl Sampled for ObservedStretch<'_> {
    type Samples = SampledStretch;

    fn sample(&self, half_length_mm: f64) -> SampledStretch {
        let window = Window::new(self.flanks, self.position_mm, half_length_mm);
        let (window, count) = in_cells(window, self.cell_mm);
        let strip = Strip::new(self.flanks, self.position_mm, window, window.evenly_mm(2 * count), self.cell);
        let width = 2.0 * strip.spacing_mm();
        let compliance = cell_compliance_mm_per_mpa(&self.flattening.bodies, width, count);
        let swept = SweptField::new(self.flanks, window, width, self.cell);
        SampledStretch { strip, cells: ElasticCells::new(width, compliance), swept }
    }
}

/// The window in whole cells, about `cell_mm` wide, and how many.
///
/// Where one end is a real one cells are as wide as that and begin there, and the free end gives way: how they lie over an edge under load then
/// follows the load without jumps, and a rounding in the last bit adds no cell.
fn in_cells(window: Window, cell_mm: f64) -> (Window, usize) {
    let widest = cell_mm.max(window.length_mm() / MOST_CELLS);
    let cells = window.length_mm() / widest;
    let whole = (cells * (1.0 + CELL_ROUND_OFF)).floor();
    let free_lower_mm = window.upper_mm - whole * widest;
    let free_upper_mm = window.lower_mm + whole * widest;
    match window.ends_are_real {
        [true, false] if whole >= LEAST_CELLS as f64 => (Window { upper_mm: free_upper_mm, ..window }, whole as usize),
        [false, true] if whole >= LEAST_CELLS as f64 => (Window { lower_mm: free_lower_mm, ..window }, whole as usize),
        _ => (window, ((cells * (1.0 - CELL_ROUND_OFF)).ceil() as usize).max(LEAST_CELLS)),
    }
}

/// One tooth pair on half-planes.
struct HalfSpacePair<'a> {
    window: GrowingWindow<ObservedStretch<'a>>,
    /// Real gap at the cells' boundaries and centres, mm.
    samples: Vec<f64>,
    /// Real gap of each cell less the least of them, mm.
    gap: Vec<f64>,
    /// The least gap, mm.
    touch: f64,
    /// The least that both flanks together have lost where they may touch, mm; 0 where that is little.
    removed_everywhere: f64,
}

impl HalfSpacePair<'_> {
    /// Whether the flanks may touch beyond an end of the window that is not real.
    fn may_touch_beyond(&self) -> bool {
        let SampledStretch { strip, cells, .. } = &self.window.samples;
        strip.may_touch_beyond(self.touch + cells.indentation_mm(), self.removed_everywhere, cells.sunk_at_ends_mm())
    }
}

impl PairContact for HalfSpacePair<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        let SampledStretch { strip, cells, .. } = &mut self.window.samples;
        strip.gap_mm(removed_mm, &mut self.samples);
        // What the weights add to the parabola at the centre: Δ²/16R.
        let rise = strip.spacing_mm().powi(2) / (4.0 * self.window.flanks.flattening.contact.relative_radius_mm());
        let of_cell = |ends: &[f64]| 0.25 * (ends[0] + ends[2]) + 0.5 * ends[1] - rise;
        self.gap.clear();
        self.gap.extend(self.samples.windows(3).step_by(2).map(of_cell));
        let touch = self.gap.iter().copied().fold(f64::INFINITY, f64::min);
        // From the first touch on, nothing is lost where a light load meets a deep relief.
        self.gap.iter_mut().for_each(|gap| *gap -= touch);
        self.touch = touch;
        cells.set_gap(&self.gap);
        let ObservedStretch { flanks, position_mm, flattening, .. } = &self.window.flanks;
        let half_length_mm = self.window.half_length_mm;
        let at_end = half_length_mm * half_length_mm / (2.0 * flattening.contact.relative_radius_mm());
        self.removed_everywhere = match touch > LITTLE_REMOVED * at_end {
            true => least_removed_mm(*flanks, *position_mm, touch + at_end, removed_mm),
            false => 0.0,
        };
    }

    fn touch_mm(&self) -> f64 {
        self.touch
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        self.window.samples.cells.load_at(indentation_mm)
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        // At a tip edge half of the strip carries the load, as if it were twice as large.
        self.window.flanks.flattening.approach_mm(2.0 * line_load_n_per_mm)
    }

    fn window_suffices(&mut self) -> bool {
        let SampledStretch { strip, cells, swept } = &mut self.window.samples;
        swept.field.fill(|pressure| cells.pressure_mpa(pressure));
        let pressure = swept.field.cells_mpa();
        let free = |end: &[f64]| end.iter().all(|p| *p == 0.0);
        let cells = FREE_CELLS.min(pressure.len());
        let [real_below, real_above] = strip.window.ends_are_real;
        (real_below || free(&pressure[..cells]))
            && (real_above || free(&pressure[pressure.len() - cells..]))
            && !self.may_touch_beyond()
    }

    fn widen(&mut self) {
        self.window.widen();
    }

    fn overlap_beside_mm(&self, removed_mm: PerGear<&[f64]>) -> Option<f64> {
        let ObservedStretch { flanks, position_mm, flattening, .. } = &self.window.flanks;
        let SampledStretch { strip, cells, .. } = &self.window.samples;
        let approach_mm = self.touch + cells.indentation_mm();
        let beside = gaps_beside_mm(*flanks, *position_mm, strip.window, approach_mm, removed_mm);
        let mut cells = self.pressed_cells();
        cells.retain(|cell| cell.pressure_mpa > 0.0);
        let sunk_mm = |at_mm: f64| -> f64 {
            let by_cell = |cell: &PressedCell| {
                let (width_mm, distance_mm) =
                    (cell.upper_mm - cell.lower_mm, at_mm - cell.lower_mm.midpoint(cell.upper_mm));
                cell.pressure_mpa * cell_compliance_at_mm_per_mpa(&flattening.bodies, width_mm, distance_mm)
            };
            cells.iter().map(by_cell).sum()
        };
        // Where rigid flanks would not overlap nothing needs to yield.
        let overlapping = beside.into_iter().filter(|(_, gap)| *gap < approach_mm);
        Some(overlapping.map(|(at_mm, gap)| approach_mm - gap - sunk_mm(at_mm)).fold(0.0, f64::max))
    }

    fn reset(&mut self) {
        self.window.reset();
        self.window.samples.cells.reset();
    }

    fn sweep(&self, gear: Gear, _removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        self.window.samples.swept.sweep(gear, sweep);
    }

    fn contact_of_points(&self, gear: Gear, _removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        self.window.samples.swept.contact_of_points(gear)
    }

    fn footprint(&self) -> Footprint {
        let field = &self.window.samples.swept.field;
        let at_ends = [field.cells_mpa().first(), field.cells_mpa().last()].map(|end| end.is_some_and(|p| *p > 0.0));
        Footprint { at_sharp_edge: self.window.samples.strip.window.is_sharp_where(at_ends), ..field.footprint() }
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        let SampledStretch { strip, swept, .. } = &self.window.samples;
        let pressures_mpa = swept.field.cells_mpa().iter().copied();
        PressedCell::evenly(strip.window.lower_mm, 2.0 * strip.spacing_mm(), pressures_mpa)
    }
}
