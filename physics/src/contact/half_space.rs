//! Elastic half-planes against the real, modified and worn gap.
//!
//! Each body is an elastic half-plane where it touches: pressure at one place lowers the surface everywhere. On unmodified
//! involutes this is Hertz's contact; it holds for worn flanks too, with the elasticity that the independent springs of
//! [`winkler`](super::winkler) lack. Displacements are measured relative to the tooth's centre line
//! along the line of action ([`half_plane`](gearwear_bodies::reference::half_plane)), so that the load follows from the approach by
//! itself, and agrees with the closed-form flattening of plain flanks.
//!
//! The pressure is uniform on evenly spaced cells ([`ElasticCells`]). There are at least [`CELLS_PER_HALF_WIDTH`] of them in
//! the half-width of the plain contact under the whole load: the peak pressure of a parabolic gap is then within 0.1 % of
//! Hertz's and the half-width within 0.5 % from a half of the load on. A flank point's pressure is the mean of the field
//! ([`SweptField`]) over the stretch that the point moves while the contact stands for one loading position.
//!
//! Cells do not resolve waves of wear shorter than twice their width. So that such waves never grow,
//! material removed counts in the gap of a cell with the same weights with which the pressure of the cell counts at flank
//! points: linear to its neighbours, here ¼, ½, ¼ at the cell's ends and centre. Crests then never wear less than troughs.
//!
//! Unevenly worn flanks may touch a second time beside the contact: a tip edge on the ridge in which its mate's wear ends below the start of active
//! profile. The window reaches as far as that can be, by the geometric gap, the least loss of both flanks there, and the displacement of both surfaces
//! at its end.
//!
//! Limits: the half-planes go on beyond a tip edge, as if the tooth did not end there. Towards a sharp edge the pressure grows
//! without bound, and what is given there is the mean of the outermost cell.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), sections 2.5 and 5.9.

use super::{
    ContactSurface, Effort, Flanks, Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep,
    elastic_cells::ElasticCells,
    flank_motion::PressureMotion,
    growing_window::{GrowingWindow, Sampled},
    hertz,
    strip::{ContactWindow, Strip, gaps_beside_mm, least_removed_mm, point_distance_mm},
    swept_field::SweptField,
};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use gearwear_bodies::material::Material;
use gearwear_bodies::reference::{
    flattening::Flattening,
    half_plane::{cell_compliance_at_mm_per_mpa, cell_compliance_mm_per_mpa, line_loads_primitive},
};

/// Elastic half-planes as a contact surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    /// Material of each gear.
    pub material: PerGear<Material>,
    /// Load for which the first window and the cells are cut, N/mm.
    pub expected_line_load_n_per_mm: f64,
}

/// Fewest cells in the half-width of the plain contact under the expected load.
pub(crate) const CELLS_PER_HALF_WIDTH: f64 = 16.0;
/// Most cells in that half-width, where the flank points are finer.
const FINEST_CELLS_PER_HALF_WIDTH: f64 = 40.0;
/// Width of cells in flank points, within those limits.
const POINTS_PER_CELL: f64 = 2.0;
/// Half-length of the first window over the half-width of the plain contact under the expected load.
const FIRST_WINDOW: f64 = 1.25;
/// Cells without pressure at an end of the window where no flank ends.
const FREE_CELLS: usize = 2;
/// Part of the gap at the end of a window below which the least loss of the flanks is taken as 0.
const LITTLE_REMOVED: f64 = 0.05;
/// Fewest cells in a window.
const LEAST_CELLS: usize = 4;
/// Most cells in a window: a longer window has wider cells.
const MOST_CELLS: f64 = 320.0;
/// Rounding error per cell, in cells.
const CELL_ROUND_OFF: f64 = 1e-9;
/// Effort measured on the preset `fzg-c`, rounded.
const EFFORT: Effort = Effort { of_equilibrium: 20.0, of_clean_start: 15.0 };

impl ContactSurface for HalfSpace {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        let flattening = hertz::flattening(&flanks.geometry, &self.material, position_mm);
        let half_width = flattening.contact.loaded(self.expected_line_load_n_per_mm).half_width_mm;
        let stretch = HalfSpaceStretch {
            flanks,
            position_mm,
            motion: cell.map(|cell| PressureMotion::new(flanks, cell, half_width)),
            flattening,
            cell_mm: self.cell_width_mm(flanks, position_mm),
        };
        Box::new(HalfSpacePair {
            window: GrowingWindow::new(stretch, FIRST_WINDOW * half_width),
            gap: Vec::new(),
            touch: 0.0,
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
    /// Width of two flank points, within the limits of the contact.
    fn cell_width_mm(&self, flanks: Flanks<'_>, position_mm: f64) -> f64 {
        let contact = hertz::flattening(&flanks.geometry, &self.material, position_mm).contact;
        let half_width = contact.loaded(self.expected_line_load_n_per_mm).half_width_mm;
        (POINTS_PER_CELL * point_distance_mm(flanks, position_mm))
            .clamp(half_width / FINEST_CELLS_PER_HALF_WIDTH, half_width / CELLS_PER_HALF_WIDTH)
    }
}

/// Flanks of a pair on half-planes, at a position.
struct HalfSpaceStretch<'a> {
    flanks: Flanks<'a>,
    position_mm: f64,
    motion: Option<PressureMotion>,
    flattening: Flattening,
    cell_mm: f64,
}

/// Samples in a window.
struct SampledStretch {
    strip: Strip,
    cells: ElasticCells,
    swept: SweptField,
}

impl Sampled for HalfSpaceStretch<'_> {
    type Samples = SampledStretch;

    fn sample(&self, half_length_mm: f64) -> SampledStretch {
        let window = ContactWindow::new(self.flanks, self.position_mm, half_length_mm);
        let (window, count) = in_cells(window, self.cell_mm);
        let width = window.length_mm() / count as f64;
        // Rise of the weighted gap of a parabola above that at the centre: Δ²/16R.
        let rise = width * width / (16.0 * self.flattening.contact.relative_radius_mm());
        let strip = Strip::new(self.flanks, self.position_mm, window, window.evenly_mm(2 * count), self.motion);
        let strip = strip.over_cells(self.flanks.grid.map(|grid| grid.len()), rise);
        let compliance = cell_compliance_mm_per_mpa(&self.flattening.bodies, width, count);
        let swept = SweptField::new(self.flanks, window, width, self.motion);
        SampledStretch { strip, cells: ElasticCells::new(width, compliance), swept }
    }
}

/// The window in whole cells, about `cell_mm` wide, and their number.
///
/// Where a flank ends at one end, cells are exactly as wide and begin there, and the other end is moved: the cells over an edge under load then
/// follow the load without jumps, and a rounding error adds no cell.
fn in_cells(window: ContactWindow, cell_mm: f64) -> (ContactWindow, usize) {
    let widest = cell_mm.max(window.length_mm() / MOST_CELLS);
    let cells = window.length_mm() / widest;
    let whole = (cells * (1.0 + CELL_ROUND_OFF)).floor();
    let free_lower_mm = window.upper_mm - whole * widest;
    let free_upper_mm = window.lower_mm + whole * widest;
    match window.ends_are_real {
        [true, false] if whole >= LEAST_CELLS as f64 => {
            (ContactWindow { upper_mm: free_upper_mm, ..window }, whole as usize)
        }
        [false, true] if whole >= LEAST_CELLS as f64 => {
            (ContactWindow { lower_mm: free_lower_mm, ..window }, whole as usize)
        }
        _ => (window, ((cells * (1.0 - CELL_ROUND_OFF)).ceil() as usize).max(LEAST_CELLS)),
    }
}

/// One tooth pair on half-planes.
struct HalfSpacePair<'a> {
    window: GrowingWindow<HalfSpaceStretch<'a>>,
    /// Real gap of each cell less the least of them, mm.
    gap: Vec<f64>,
    /// Least gap, mm.
    touch: f64,
}

impl HalfSpacePair<'_> {
    /// Whether flanks that have lost `removed_mm` may touch beyond an end of the window where no flank ends.
    fn may_touch_beyond(&self, removed_mm: PerGear<&[f64]>) -> bool {
        let SampledStretch { strip, cells, .. } = &self.window.samples;
        let (approach_mm, sunk_mm) = (self.touch + cells.indentation_mm(), cells.sunk_at_ends_mm());
        let may_touch = |removed_mm| strip.may_touch_beyond(approach_mm, removed_mm, sunk_mm);
        may_touch(0.0) && may_touch(self.removed_everywhere_mm(removed_mm))
    }

    /// Least loss of both flanks together where they may touch, mm; 0 where it is little.
    fn removed_everywhere_mm(&self, removed_mm: PerGear<&[f64]>) -> f64 {
        let HalfSpaceStretch { flanks, position_mm, flattening, .. } = &self.window.flanks;
        let half_length_mm = self.window.half_length_mm;
        let at_end = half_length_mm * half_length_mm / (2.0 * flattening.contact.relative_radius_mm());
        match self.touch > LITTLE_REMOVED * at_end {
            true => least_removed_mm(*flanks, *position_mm, self.touch + at_end, removed_mm),
            false => 0.0,
        }
    }
}

impl PairContact for HalfSpacePair<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        let SampledStretch { strip, cells, .. } = &mut self.window.samples;
        let touch = strip.gap_mm(removed_mm, &mut self.gap);
        // Counted from the first touch: a light load on a deep relief keeps its digits.
        self.gap.iter_mut().for_each(|gap| *gap -= touch);
        self.touch = touch;
        cells.set_gap(&self.gap);
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

    fn window_suffices(&mut self, removed_mm: PerGear<&[f64]>) -> bool {
        let SampledStretch { strip, cells, swept } = &mut self.window.samples;
        swept.field.fill(|pressure| cells.pressure_mpa(pressure));
        let pressure = swept.field.cells_mpa();
        let cells = FREE_CELLS.min(pressure.len());
        let [free_below, free_above] =
            [&pressure[..cells], &pressure[pressure.len() - cells..]].map(|end| end.iter().all(|p| *p == 0.0));
        let [real_below, real_above] = strip.window.ends_are_real;
        (real_below || free_below) && (real_above || free_above) && !self.may_touch_beyond(removed_mm)
    }

    fn widen(&mut self) {
        self.window.widen();
    }

    fn overlap_beside_mm(&self, removed_mm: PerGear<&[f64]>) -> Option<f64> {
        let HalfSpaceStretch { flanks, position_mm, flattening, .. } = &self.window.flanks;
        let SampledStretch { strip, cells, .. } = &self.window.samples;
        let approach_mm = self.touch + cells.indentation_mm();
        let beside = gaps_beside_mm(*flanks, *position_mm, strip.window, approach_mm, removed_mm);
        let mut cells = self.pressed_cells();
        cells.retain(|cell| cell.pressure_mpa > 0.0);
        let least_sunk = LeastSunk::under(&cells);
        // Only where flanks would overlap that sink as little as they may.
        let overlapping =
            beside.into_iter().filter(|(at_mm, gap)| *gap + least_sunk.at_mm(flattening, *at_mm) < approach_mm);
        Some(overlapping.map(|(at_mm, gap)| approach_mm - gap - sunk_mm(flattening, &cells, at_mm)).fold(0.0, f64::max))
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
        let SampledStretch { strip, cells, swept } = &self.window.samples;
        let pressures_mpa = swept.field.cells_mpa().iter().copied();
        PressedCell::evenly(strip.window.lower_mm, cells.width_mm(), pressures_mpa)
    }
}

/// Least displacement of both surfaces beside a contact: as if all of its load were on its cell farthest away, for a load displaces the less the
/// farther away it is.
struct LeastSunk {
    /// Middles of the first and the last cell, mm.
    ends_mm: [f64; 2],
    width_mm: f64,
    /// Sum of the pressures, MPa.
    sum_mpa: f64,
}

impl LeastSunk {
    /// Displacement under the pressure of `cells`, all of one width.
    fn under(cells: &[PressedCell]) -> Self {
        let middle_mm = |cell: Option<&PressedCell>| cell.map_or(0.0, |cell| cell.lower_mm.midpoint(cell.upper_mm));
        Self {
            ends_mm: [cells.first(), cells.last()].map(middle_mm),
            width_mm: cells.first().map_or(0.0, |cell| cell.upper_mm - cell.lower_mm),
            sum_mpa: cells.iter().map(|cell| cell.pressure_mpa).sum(),
        }
    }

    /// Displacement at a place, mm.
    fn at_mm(&self, flattening: &Flattening, at_mm: f64) -> f64 {
        let [first, last] = self.ends_mm.map(|end_mm| (at_mm - end_mm).abs());
        self.sum_mpa * cell_compliance_at_mm_per_mpa(&flattening.bodies, self.width_mm, first.max(last))
    }
}

/// Displacement of both surfaces at a place under the pressure of `cells`, mm.
fn sunk_mm(flattening: &Flattening, cells: &[PressedCell], at_mm: f64) -> f64 {
    let primitive = |end_mm: f64| line_loads_primitive(&flattening.bodies, at_mm - end_mm);
    let (mut sunk, mut before) = (0.0, None);
    for cell in cells {
        // Cells beside each other share an end.
        let lower = before.filter(|(end_mm, _)| *end_mm == cell.lower_mm).map(|(_, of_end)| of_end);
        let (lower, upper) = (lower.unwrap_or_else(|| primitive(cell.lower_mm)), primitive(cell.upper_mm));
        sunk += cell.pressure_mpa * (lower - upper);
        before = Some((cell.upper_mm, upper));
    }
    sunk
}
