//! Hertz's elliptic pressure on the nominal curvature of the flanks.
//!
//! Load and approach follow the closed-form flattening, shifted by the material removed at the theoretical contact
//! point; the pressure is Hertz's ellipse, swept over the flank points. At a tip edge only the part of the strip that
//! lies on both flanks carries: the ellipse is that of the load w* whose carrying part is the pair's load,
//!
//! ```text
//! w = w* [Φ(u₂) − Φ(u₁)]        Φ(u) = ½ + (u √(1 − u²) + asin u) / π,   u = x/a(w*)
//! ```
//!
//! A flank point's pressure is averaged over the stretch the contact moves on while it stands for one loading position,
//! by the same Φ, so that the load is conserved exactly however few the positions.
//!
//! Limits: wear does not change the curvature, as it does on the Winkler surface.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.2; the thesis, section 3.2 (papers C and E).

use std::f64::consts::PI;

use super::{
    ContactSurface, Flanks, Footprint, PairContact, PointContact, PositionCell, PressedCell, Response, Sweep,
    growing_window::{GrowingWindow, Sampled},
    observed_points::ObservedPoints,
    strip::ContactWindow,
};
use gearwear_bodies::gear::{Gear, PerGear, conjugate::ConjugateFlanks};
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_bodies::reference::{
    flattening::{Flattening, HalfPlane},
    hertz_line::HertzLine,
};

/// Hertz's distributed pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// Material of each gear.
    pub material: PerGear<Material>,
    /// Load for which the first window is cut, N/mm.
    pub expected_line_load_n_per_mm: f64,
}

/// Closed-form contact of two flanks at `position_mm`, with the flattening down to the teeth's centre lines.
pub fn flattening(geometry: &dyn ConjugateFlanks, material: &PerGear<Material>, position_mm: f64) -> Flattening {
    Flattening {
        contact: HertzLine::of_relative_radius(
            geometry.relative_radius_mm(position_mm),
            contact_modulus_mpa(material.map(Material::elastic)),
        ),
        bodies: Gear::BOTH.map(|gear| HalfPlane {
            elastic: material[gear].elastic(),
            depth_mm: geometry.depth_mm(gear, position_mm),
        }),
    }
}

/// Half-length of the first window over the half-width under twice the expected load, which one of two slices may carry exactly: rounding errors must not
/// decide whether its window suffices.
const AMPLE: f64 = 1.0001;
/// Cells of pressure of an ellipse.
const CELLS_OF_ELLIPSE: usize = 80;

/// Load against approach of a pair in closed form, for `hertz` and `hertz-mean`.
pub(super) struct ClosedFormPair<'a> {
    pub flanks: Flanks<'a>,
    position_mm: f64,
    pub flattening: Flattening,
    /// Material removed at the theoretical contact point of both flanks together, mm.
    removed_mm: f64,
    /// Load at the last indentation, N/mm.
    pub line_load: f64,
}

impl<'a> ClosedFormPair<'a> {
    pub(super) fn new(flanks: Flanks<'a>, material: &PerGear<Material>, position_mm: f64) -> Self {
        let flattening = flattening(&flanks.geometry, material, position_mm);
        Self { flanks, position_mm, flattening, removed_mm: 0.0, line_load: 0.0 }
    }

    pub(super) fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        let [pinion, wheel] = Gear::BOTH.map(|gear| {
            let coordinate = self.flanks.geometry.contact_coordinate_mm(gear, self.position_mm);
            self.flanks.grid[gear].value_at(removed_mm[gear], coordinate)
        });
        self.removed_mm = pinion + wheel;
    }

    pub(super) fn touch_mm(&self) -> f64 {
        self.removed_mm
    }

    pub(super) fn load_at(&mut self, indentation_mm: f64) -> Response {
        self.line_load = self.flattening.line_load_n_per_mm(indentation_mm);
        let (_, compliance) = self.flattening.approach_and_compliance(self.line_load);
        Response { line_load_n_per_mm: self.line_load, stiffness_n_per_mm2: 1.0 / compliance }
    }

    pub(super) fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.flattening.approach_mm(line_load_n_per_mm)
    }
}

impl ContactSurface for Hertz {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        let closed_form = ClosedFormPair::new(flanks, &self.material, position_mm);
        let extent = ContactWindow::new(flanks, position_mm, f64::INFINITY);
        let widest = closed_form.flattening.contact.loaded(2.0 * self.expected_line_load_n_per_mm).half_width_mm;
        let window = GrowingWindow::new(PassedCell { flanks, cell }, AMPLE * widest);
        Box::new(HertzPair { closed_form, extent, window, strip_load: 0.0, half_width_mm: 0.0 })
    }

    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        flattening(geometry, &self.material, position_mm).approach_mm(line_load_n_per_mm)
    }
}

/// Flanks while the contact moves through a cell.
struct PassedCell<'a> {
    flanks: Flanks<'a>,
    cell: Option<PositionCell>,
}

impl Sampled for PassedCell<'_> {
    /// Points of each flank that may touch, with their motion through the cell.
    type Samples = Option<PerGear<(ObservedPoints, Vec<[f64; 2]>)>>;

    fn sample(&self, half_length_mm: f64) -> Self::Samples {
        self.cell.map(|cell| {
            let window = ContactWindow::new(self.flanks, cell.position_mm, half_length_mm);
            PerGear::from_fn(|gear| {
                let points = ObservedPoints::new(self.flanks, gear, window, cell);
                let shifts = points.shifts_to_ends_mm();
                (points, shifts)
            })
        })
    }
}

/// One tooth pair with Hertz's ellipse.
struct HertzPair<'a> {
    closed_form: ClosedFormPair<'a>,
    /// Extent of both flanks.
    extent: ContactWindow,
    window: GrowingWindow<PassedCell<'a>>,
    /// w*: load of the whole ellipse, N/mm.
    strip_load: f64,
    /// a(w*).
    half_width_mm: f64,
}

impl PairContact for HertzPair<'_> {
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

    fn window_suffices(&mut self, _removed_mm: PerGear<&[f64]>) -> bool {
        (self.strip_load, self.half_width_mm) = self.strip(self.closed_form.line_load);
        self.half_width_mm <= self.window.half_length_mm
    }

    fn widen(&mut self) {
        self.window.resize(1.5 * self.half_width_mm);
    }

    fn reset(&mut self) {
        self.window.reset();
    }

    fn sweep(&self, gear: Gear, _removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        let Some(observed) = &self.window.samples else { return sweep.begin(0, &[]) };
        let (points, shifts) = &observed[gear];
        sweep.begin(points.first_point, &points.sliding_mm);
        let (load, a) = (self.strip_load, self.half_width_mm);
        let courses = points.at[1..].iter().zip(shifts);
        for (pressure, (point, shift)) in sweep.pressure_mpa.iter_mut().zip(courses) {
            let [from, to] = shift.map(|shift| (point.along_mm + shift) / a);
            *pressure = if load > 0.0 && from != to {
                load * (carried_below(to) - carried_below(from)) / ((to - from) * a)
            } else {
                0.0
            };
        }
    }

    fn contact_of_points(&self, gear: Gear, _removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        let Some(observed) = &self.window.samples else { return Vec::new() };
        let (points, shifts) = &observed[gear];
        let (a, ellipse) = (self.half_width_mm, self.closed_form.flattening.contact.loaded(self.strip_load));
        let courses = points.at[1..].iter().zip(shifts);
        courses
            .map(|(point, shift)| {
                let [low, high] = [shift[0].min(shift[1]), shift[0].max(shift[1])];
                if self.strip_load <= 0.0 || low == high {
                    return PointContact::default();
                }
                let [from, to] = [low, high].map(|shift| (point.along_mm + shift).clamp(-a, a));
                let nearest_to_centre = 0.0_f64.clamp(point.along_mm + low, point.along_mm + high);
                PointContact {
                    pressure_mpa: ellipse.pressure_mpa(nearest_to_centre),
                    contact_fraction: (to - from) / (high - low),
                }
            })
            .collect()
    }

    fn footprint(&self) -> Footprint {
        let a = self.half_width_mm;
        let half_width_mm = 0.5 * (self.extent.upper_mm.min(a) - self.extent.lower_mm.max(-a));
        let peak_pressure_mpa = self.closed_form.flattening.contact.loaded(self.strip_load).peak_pressure_mpa;
        Footprint { peak_pressure_mpa, half_width_mm, equivalent_half_width_mm: half_width_mm, at_sharp_edge: false }
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        let a = self.half_width_mm;
        if a == 0.0 {
            return Vec::new();
        }
        let (lower, upper) = ((self.extent.lower_mm / a).max(-1.0), (self.extent.upper_mm / a).min(1.0));
        let width = (upper - lower) / CELLS_OF_ELLIPSE as f64;
        let means = (0..CELLS_OF_ELLIPSE).map(|k| {
            let [below, to_end] = [k, k + 1].map(|k| carried_below(lower + k as f64 * width));
            self.strip_load * (to_end - below) / (width * a)
        });
        PressedCell::evenly(lower * a, width * a, means)
    }
}

impl HertzPair<'_> {
    /// Load w* and half-width of the ellipse whose part on both flanks carries `line_load`, by Newton's method.
    fn strip(&self, line_load: f64) -> (f64, f64) {
        let contact = &self.closed_form.flattening.contact;
        let mut whole = line_load;
        let mut a = contact.loaded(whole).half_width_mm;
        for _ in 0..50 {
            let (lower, upper) = (self.extent.lower_mm / a, self.extent.upper_mm / a);
            if a == 0.0 || (lower <= -1.0 && upper >= 1.0) {
                break;
            }
            let carrying = carried_below(upper) - carried_below(lower);
            // d carrying / d ln w* = −½ [u Φ'(u)], as a ∝ √w*.
            let slope = -0.5 * (upper * density(upper) - lower * density(lower));
            let step = (line_load - whole * carrying) / (carrying + slope);
            whole += step;
            a = contact.loaded(whole).half_width_mm;
            if step.abs() <= 1e-13 * whole {
                break;
            }
        }
        (whole, a)
    }
}

/// Φ(u): part of the load of an ellipse below u = x/a.
fn carried_below(u: f64) -> f64 {
    let u = u.clamp(-1.0, 1.0);
    0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / PI
}

/// Φ'(u) = (2/π) √(1 − u²).
fn density(u: f64) -> f64 {
    2.0 / PI * (1.0 - u * u).max(0.0).sqrt()
}
