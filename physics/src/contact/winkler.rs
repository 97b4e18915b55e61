//! An elastic foundation of independent springs against the real, modified and worn gap.
//!
//! With the approach δ of the surfaces and the gap g(x), each spring carries
//!
//! ```text
//! p(x) = (K/H) max(0, δ − g(x))          w = ∫ p dx          dw/dδ = (K/H) · length in contact
//! ```
//!
//! The load is summed over cells of evenly spaced samples, the same in windows of all lengths, divided where a modification has a kink at a flank point. In a cell the penetration
//! u = δ − g is a straight line between its samples, raised by Δ²/(12 R), the mean of what the curvature of the gap adds to it; its positive part
//! integrates exactly. So the ends of the contact are found between samples, and the load is a smooth, ever steeper
//! function of δ.
//!
//! A flank point's pressure is averaged over the stretch the contact moves on while it stands for one loading position,
//! exactly for the parabola that the point's penetration follows: few positions suffice for the narrowest contact,
//! and load and wear agree.
//!
//! K/H is one constant, or a curve by position and load ([`WinklerFoundation`]): it then is the same for all springs of a contact, and
//! follows the load of the contact by a power law, for which the load still has a closed form. A foundation with the
//! half-width or the peak pressure of elastic bodies approaches by a third or half as much as they do; a calibration has the foundation with
//! their approach too, and the difference under a contact's load is added to the approach of the gears: flattening
//! is softer under light load, where a tip edge begins to touch, which no spring of the teeth can represent. Where a tip edge
//! touches the gap has another curvature, and both foundations follow from half-planes on that gap ([`edge_foundation`](super::edge_foundation)).
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.3; the thesis, section 3.2.

use super::{
    ContactSurface, Flanks, Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep,
    edge_foundation::{EdgeFoundations, EdgeStiffness},
    flank_motion::PressureMotion,
    foundation::{FoundationCurve, FoundationStiffness, mean_positive},
    gap_at_points::GapAtPoints,
    growing_window::{GrowingWindow, Sampled},
    observed_points::ObservedPoints,
    strip::{ContactWindow, Strip, gaps_beside_mm, least_removed_mm, point_distance_mm},
    swept_field::SweptField,
};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};

/// The springs of a foundation: one K/H everywhere, or a curve of it.
#[derive(Debug, Clone, PartialEq)]
pub enum WinklerFoundation {
    /// One K/H at every position and load.
    Uniform {
        /// K/H, MPa/mm.
        mpa_per_mm: f64,
    },
    /// K/H by position and load.
    Curve {
        /// Foundation of the pressure.
        pressure: FoundationCurve,
        /// Foundation with the approach of the elastic bodies.
        approach: FoundationCurve,
        /// Foundations where tip edges touch, if they are followed into contact.
        edges: Option<EdgeFoundations>,
    },
}

impl WinklerFoundation {
    /// Springs at one position with the approach of the elastic bodies, where a curve has them.
    pub(crate) fn approach_at(&self, position_mm: f64) -> Option<FoundationStiffness> {
        match self {
            Self::Uniform { .. } => None,
            Self::Curve { approach, .. } => Some(approach.springs_at(position_mm)),
        }
    }

    /// Springs at one position where a tip edge touches, if a curve has them.
    pub fn at_edge(&self, position_mm: f64) -> Option<EdgeStiffness> {
        match self {
            Self::Curve { edges: Some(edges), .. } => edges.at(position_mm),
            _ => None,
        }
    }

    /// Springs at one position.
    pub fn at(&self, position_mm: f64) -> FoundationStiffness {
        match self {
            Self::Uniform { mpa_per_mm } => FoundationStiffness::new(*mpa_per_mm, 0.0, 1.0),
            Self::Curve { pressure, .. } => pressure.springs_at(position_mm),
        }
    }
}

/// Winkler foundation as a contact surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Winkler {
    /// K/H.
    pub foundation: WinklerFoundation,
    /// Load for which the first window is cut, N/mm; a greater one only costs a widening.
    pub expected_line_load_n_per_mm: f64,
}

/// Half-length of the first window over the half-width of the unworn contact.
const FIRST_WINDOW: f64 = 1.25;
/// Distance of the samples in points of the pinion's flank. The load needs less resolution than the wear: its geometric
/// part is exact to the gap's curvature, and the worn part is smooth over several points.
const POINTS_PER_SAMPLE: f64 = 2.0;
/// Part of the plain contact's indentation by which the samples may miss a kink of a modification; otherwise it is a sample of its own.
const LITTLE_MISSED: f64 = 1e-3;
/// Fewest intervals between samples.
const LEAST_INTERVALS: f64 = 8.0;
/// Fewest intervals between samples where a tip edge touches.
const LEAST_INTERVALS_AT_EDGE: usize = 200;
/// Cells of pressure in an interval between samples.
const CELLS_PER_INTERVAL: usize = 4;

impl ContactSurface for Winkler {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        let radius_mm = flanks.geometry.relative_radius_mm(position_mm);
        let stiffness = self.foundation.at(position_mm);
        let half_width = stiffness.half_width_mm(radius_mm, self.expected_line_load_n_per_mm);
        let edge = self.foundation.at_edge(position_mm);
        let indentation_mm = half_width * half_width / (2.0 * radius_mm);
        let first_half_length_mm = FIRST_WINDOW * half_width;
        let stretch =
            WinklerStretch { flanks, position_mm, cell, at_edge: edge.is_some(), indentation_mm, first_half_length_mm };
        let first_foundation = stiffness.mpa_per_mm(self.expected_line_load_n_per_mm);
        Box::new(WinklerPair {
            stiffness,
            bodies: self.foundation.approach_at(position_mm),
            edge,
            foundation: first_foundation,
            first_foundation,
            radius_mm,
            window: GrowingWindow::new(stretch, first_half_length_mm),
            gap: Vec::new(),
            touch: 0.0,
            indentation_mm: 0.0,
            extent_mm: (0.0, 0.0),
        })
    }

    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let radius = geometry.relative_radius_mm(position_mm);
        let stiffness = self.foundation.approach_at(position_mm).unwrap_or_else(|| self.foundation.at(position_mm));
        stiffness.approach_and_compliance(radius, line_load_n_per_mm).0
    }
}

/// Points of each flank that may touch.
enum ObservedFlanks {
    /// Points with the gap they face.
    Facing(PerGear<(ObservedPoints, GapAtPoints)>),
    /// Points that move through a pressure that stands still: an edge under load stands on one place of its tooth and slides over the mate,
    /// so that no gap is a parabola of the position.
    Swept(SweptField),
}

/// Flanks of a pair on the foundation, at a position.
struct WinklerStretch<'a> {
    flanks: Flanks<'a>,
    position_mm: f64,
    cell: Option<PositionCell>,
    /// Whether a tip edge touches.
    at_edge: bool,
    /// Indentation of the plain contact under the expected load.
    indentation_mm: f64,
    /// Half-length of the first window.
    first_half_length_mm: f64,
}

impl Sampled for WinklerStretch<'_> {
    type Samples = (Strip, Option<ObservedFlanks>);

    fn sample(&self, half_length_mm: f64) -> Self::Samples {
        let Self { flanks, position_mm, cell, .. } = *self;
        let distance_mm = POINTS_PER_SAMPLE * point_distance_mm(flanks, position_mm);
        if self.at_edge {
            let window = ContactWindow::new(flanks, position_mm, half_length_mm);
            let intervals = ((window.length_mm() / distance_mm).ceil() as usize).max(LEAST_INTERVALS_AT_EDGE);
            let motion = cell.map(|cell| PressureMotion::new(flanks, cell, self.first_half_length_mm));
            let strip = Strip::new(flanks, position_mm, window, window.evenly_mm(intervals), motion);
            let swept = SweptField::new(flanks, window, strip.spacing_mm(), motion);
            return (strip, Some(ObservedFlanks::Swept(swept)));
        }
        // One spacing in windows of all lengths, which are whole multiples of it.
        let spacing_mm = distance_mm.min(2.0 * self.first_half_length_mm / LEAST_INTERVALS);
        let half_length_mm = (half_length_mm / spacing_mm).ceil() * spacing_mm;
        let window = ContactWindow::new(flanks, position_mm, half_length_mm);
        let places_mm = window.with_kinks_mm(flanks, position_mm, spacing_mm, LITTLE_MISSED * self.indentation_mm);
        let strip = Strip::new(flanks, position_mm, window, places_mm, None);
        let observed = self.cell.map(|cell| {
            ObservedFlanks::Facing(PerGear::from_fn(|gear| {
                let points = ObservedPoints::new(flanks, gear, window, cell);
                let gap = GapAtPoints::new(flanks, gear, &points, position_mm);
                (points, gap)
            }))
        });
        (strip, observed)
    }
}

/// One tooth pair on the foundation.
struct WinklerPair<'a> {
    stiffness: FoundationStiffness,
    /// Springs with the approach of the elastic bodies, where known.
    bodies: Option<FoundationStiffness>,
    /// Springs in place of both where a tip edge touches.
    edge: Option<EdgeStiffness>,
    /// K/H under the last load, MPa/mm.
    foundation: f64,
    /// K/H before any load, MPa/mm.
    first_foundation: f64,
    radius_mm: f64,
    window: GrowingWindow<WinklerStretch<'a>>,
    /// Real gap at the samples of the strip less the least of them, mm.
    gap: Vec<f64>,
    /// Least gap, mm.
    touch: f64,
    /// Last indentation, mm.
    indentation_mm: f64,
    /// Outermost places in contact at equilibrium, along the tangent.
    extent_mm: (f64, f64),
}

impl PairContact for WinklerPair<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        let touch = self.window.samples.0.gap_mm(removed_mm, &mut self.gap);
        // Counted from the first touch: a light load on a deep relief keeps its digits.
        self.gap.iter_mut().for_each(|gap| *gap -= touch);
        self.touch = touch;
    }

    fn touch_mm(&self) -> f64 {
        self.touch
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        self.indentation_mm = indentation_mm;
        // Integrals of the penetration, and of its derivative, the length in contact.
        let (mut penetration, mut contact) = (0.0, 0.0);
        for (ends, gaps) in self.strip().along_mm.windows(2).zip(self.gap.windows(2)) {
            let length = ends[1] - ends[0];
            let raised = indentation_mm + self.raised_mm(length);
            let (mean, fraction) = mean_positive([raised - gaps[0], raised - gaps[1]]);
            penetration += length * mean;
            contact += length * fraction;
        }
        let (load, stiffness) = match &self.edge {
            Some(edge) => edge.load_and_stiffness(penetration, contact),
            None => self.stiffness.load_and_stiffness(penetration, contact),
        };
        if load > 0.0 {
            self.foundation = match &self.edge {
                Some(edge) => edge.mpa_per_mm(load),
                None => self.stiffness.mpa_per_mm(load),
            };
        }
        Response { line_load_n_per_mm: load, stiffness_n_per_mm2: stiffness }
    }

    fn further_approach_mm(&self, line_load_n_per_mm: f64) -> (f64, f64) {
        if let Some(edge) = &self.edge {
            return edge.further_approach_mm(line_load_n_per_mm);
        }
        let Some(bodies) = self.bodies else { return (0.0, 0.0) };
        let [whole, own] = [bodies, self.stiffness]
            .map(|stiffness| stiffness.approach_and_compliance(self.radius_mm, line_load_n_per_mm));
        (whole.0 - own.0, whole.1 - own.1)
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        // At a tip edge half of the strip carries the load, as if it were twice as large.
        let a = self.stiffness.half_width_mm(self.radius_mm, 2.0 * line_load_n_per_mm);
        a * a / (2.0 * self.radius_mm)
    }

    fn window_suffices(&mut self, removed_mm: PerGear<&[f64]>) -> bool {
        self.extent_mm = self.extent_in_contact_mm();
        if let Some(ObservedFlanks::Swept(swept)) = &mut self.window.samples.1 {
            let (gap, indentation_mm, foundation) = (&self.gap, self.indentation_mm, self.foundation);
            swept.field.fill(|pressure| {
                pressure.clear();
                pressure
                    .extend(gap.windows(2).map(|ends| {
                        foundation * mean_positive([indentation_mm - ends[0], indentation_mm - ends[1]]).0
                    }));
            });
        }
        // The rise of the penetration by the curvature may reach into the next cell.
        let along_mm = &self.strip().along_mm;
        let raised_mm = [along_mm[1] - along_mm[0], along_mm[along_mm.len() - 1] - along_mm[along_mm.len() - 2]]
            .map(|length_mm| self.raised_mm(length_mm).max(0.0));
        let approach_mm = self.touch + self.indentation_mm;
        let sunk_mm = raised_mm.map(|raised_mm| -raised_mm);
        let may_touch = |removed_mm| self.strip().may_touch_beyond(approach_mm, removed_mm, sunk_mm);
        !(may_touch(0.0) && may_touch(self.removed_everywhere_mm(removed_mm)))
    }

    fn widen(&mut self) {
        self.window.widen();
    }

    fn overlap_beside_mm(&self, removed_mm: PerGear<&[f64]>) -> Option<f64> {
        let WinklerStretch { flanks, position_mm, .. } = self.window.flanks;
        let approach_mm = self.touch + self.indentation_mm;
        let beside = gaps_beside_mm(flanks, position_mm, self.strip().window, approach_mm, removed_mm);
        Some(beside.into_iter().map(|(_, gap)| approach_mm - gap).fold(0.0, f64::max))
    }

    fn reset(&mut self) {
        self.window.reset();
        self.foundation = self.first_foundation;
    }

    fn sweep(&self, gear: Gear, removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        let (points, faced) = match &self.window.samples.1 {
            None => return sweep.begin(0, &[]),
            Some(ObservedFlanks::Swept(swept)) => return swept.sweep(gear, sweep),
            Some(ObservedFlanks::Facing(facing)) => &facing[gear],
        };
        // All points of the window: one between two samples may touch where neither sample does.
        sweep.begin(points.first_point, &points.sliding_mm);
        let approach_mm = self.touch + self.indentation_mm;
        for (pressure, faced) in sweep.pressure_mpa.iter_mut().zip(faced.faced(points, gear, removed_mm)) {
            *pressure = self.foundation * faced.mean_penetration(approach_mm).0;
        }
    }

    fn contact_of_points(&self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        let (points, faced) = match &self.window.samples.1 {
            None => return Vec::new(),
            Some(ObservedFlanks::Swept(swept)) => return swept.contact_of_points(gear),
            Some(ObservedFlanks::Facing(facing)) => &facing[gear],
        };
        let approach_mm = self.touch + self.indentation_mm;
        faced
            .faced(points, gear, removed_mm)
            .map(|faced| PointContact {
                pressure_mpa: self.foundation * faced.greatest_penetration_mm(approach_mm).max(0.0),
                contact_fraction: faced.mean_penetration(approach_mm).1,
            })
            .collect()
    }

    fn footprint(&self) -> Footprint {
        let penetration = (self.indentation_mm - least(&self.strip().along_mm, &self.gap, self.radius_mm)).max(0.0);
        let half_width_mm = 0.5 * (self.extent_mm.1 - self.extent_mm.0);
        let at_ends = [self.gap.first(), self.gap.last()].map(|gap| gap.is_some_and(|gap| *gap < self.indentation_mm));
        let at_sharp_edge = self.strip().window.is_sharp_where(at_ends);
        let peak_pressure_mpa = self.foundation * penetration;
        Footprint { peak_pressure_mpa, half_width_mm, equivalent_half_width_mm: half_width_mm, at_sharp_edge }
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        let parts = CELLS_PER_INTERVAL as f64;
        let cells = self.strip().along_mm.windows(2).zip(self.gap.windows(2)).flat_map(|(places, ends)| {
            let length_mm = places[1] - places[0];
            // Between two samples the gap is a parabola of the contact's curvature through both, and a straight line between its places.
            let sagitta = length_mm * length_mm / (2.0 * self.radius_mm);
            let bulge = sagitta / (6.0 * parts * parts);
            let penetrations: [f64; CELLS_PER_INTERVAL + 1] = std::array::from_fn(|k| {
                let part = k as f64 / parts;
                self.indentation_mm - ends[0] - part * (ends[1] - ends[0]) + sagitta * part * (1.0 - part) + bulge
            });
            let pressures = penetrations.windows(2).map(|ends| self.foundation * mean_positive([ends[0], ends[1]]).0);
            PressedCell::evenly(places[0], length_mm / parts, pressures)
        });
        cells.collect()
    }
}

/// Least gap of flanks with the relative radius `radius`, from `samples` at `places`: the bottom of the parabola through the lowest sample and its
/// neighbours, but no lower than with the geometric curvature between two samples, as where a kink is the lowest.
fn least(places: &[f64], samples: &[f64], radius: f64) -> f64 {
    let Some(k) = (0..samples.len()).min_by(|&a, &b| samples[a].total_cmp(&samples[b])) else { return f64::INFINITY };
    let Some(&[before, lowest, after]) = samples.get(k.wrapping_sub(1)..k + 2) else { return samples[k] };
    let lengths = [places[k] - places[k - 1], places[k + 1] - places[k]];
    let rises = [(before - lowest) / lengths[0], (after - lowest) / lengths[1]];
    if rises == [0.0; 2] {
        return lowest;
    }
    let slope = (rises[1] * lengths[0] - rises[0] * lengths[1]) / (lengths[0] + lengths[1]);
    let below = slope * slope * (lengths[0] + lengths[1]) / (4.0 * (rises[0] + rises[1]));
    let beside = [0, 1].map(|side| (0.5 * lengths[side] - rises[side] * radius).max(0.0).powi(2) / (2.0 * radius));
    lowest - below.min(beside[0].max(beside[1]))
}

impl WinklerPair<'_> {
    fn strip(&self) -> &Strip {
        &self.window.samples.0
    }

    /// Least loss of both flanks together where they may touch, mm; 0 where it is little. Where much is removed everywhere, as by a helix-slope
    /// deviation, the window need not reach as far as that is deep.
    fn removed_everywhere_mm(&self, removed_mm: PerGear<&[f64]>) -> f64 {
        let WinklerStretch { flanks, position_mm, .. } = self.window.flanks;
        let at_end = self.window.half_length_mm * self.window.half_length_mm / (2.0 * self.radius_mm);
        match self.touch > 0.25 * at_end {
            true => least_removed_mm(flanks, position_mm, self.touch + at_end, removed_mm),
            false => 0.0,
        }
    }

    /// Mean rise Δ²/12R of the penetration above the straight line between two samples, by the curvature of the gap.
    fn raised_mm(&self, cell_mm: f64) -> f64 {
        cell_mm * cell_mm / (12.0 * self.radius_mm)
    }

    /// Outermost places in contact, found between samples; both 0 without contact.
    fn extent_in_contact_mm(&self) -> (f64, f64) {
        let mut in_contact = (0..self.gap.len()).filter(|&k| self.gap[k] < self.indentation_mm);
        let Some(first) = in_contact.next() else { return (0.0, 0.0) };
        let last = in_contact.next_back().unwrap_or(first);
        let along_mm = &self.strip().along_mm;
        let lower_mm = if first > 0 { self.end_between_mm(first, first - 1) } else { along_mm[0] };
        let upper_mm = if last + 1 < self.gap.len() { self.end_between_mm(last, last + 1) } else { along_mm[last] };
        (lower_mm, upper_mm)
    }

    /// End of the contact between the outermost sample in contact and the next one, where the gap is as wide as the indentation.
    fn end_between_mm(&self, inside: usize, outside: usize) -> f64 {
        let along_mm = &self.strip().along_mm;
        let [u, beyond] = [inside, outside].map(|k| self.indentation_mm - self.gap[k]);
        along_mm[inside] + u / (u - beyond) * (along_mm[outside] - along_mm[inside])
    }
}
