//! An elastic foundation of independent springs against the real, modified and worn gap.
//!
//! With the approach δ of the surfaces and the gap g(x), each spring carries
//!
//! ```text
//! p(x) = (K/H) max(0, δ − g(x))          w = ∫ p dx          dw/dδ = (K/H) · length in contact
//! ```
//!
//! The load is summed over cells of evenly spaced samples. In a cell the penetration u = δ − g is a straight line
//! between its samples, whose positive part integrates exactly to (Δ/2) P²/U with P = max(u₀, 0) + max(u₁, 0) and
//! U = |u₀| + |u₁|: the ends of the contact are found between samples, and the load is a smooth function of δ. The
//! curvature of the geometric gap, which the straight line misses, is added back: Δ³/(12 R) a cell.
//!
//! A flank point's pressure is averaged over the stretch the contact moves on while it stands for one loading position,
//! by the same formula: so few positions suffice, and load and wear agree.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), section 4.3; the thesis, section 3.2.

use super::{
    ContactSurface, Flanks, Footprint, PairContact, PositionCell, Response, Sweep, foundation,
    strip::{GapAtPoints, ObservedPoints, Strip, Window},
};
use crate::gear::{Gear, PerGear, conjugate::ConjugateFlanks};

/// The surface: K/H and the load that contacts are expected to carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Winkler {
    /// K/H, MPa/mm.
    pub foundation_mpa_per_mm: f64,
    /// Load that the first window is cut for; a greater one only costs a widening, N/mm.
    pub expected_line_load_n_per_mm: f64,
}

/// Half-length of the first window over the half-width of the unworn contact.
const FIRST_WINDOW: f64 = 1.25;

impl ContactSurface for Winkler {
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a> {
        let radius_mm = flanks.geometry.relative_radius_mm(position_mm);
        let half_width =
            foundation::half_width_mm(self.foundation_mpa_per_mm, radius_mm, self.expected_line_load_n_per_mm);
        let site = Site { flanks, position_mm, cell, half_window_mm: FIRST_WINDOW * half_width };
        let (strip, observed) = site.look();
        Box::new(WinklerPair {
            foundation: self.foundation_mpa_per_mm,
            radius_mm,
            site,
            strip,
            observed,
            gap: Vec::new(),
            approach: 0.0,
            extent_mm: (0.0, 0.0),
            observed_gap: Vec::new(),
            pressure: Vec::new(),
            greatest_pressure: Vec::new(),
            contact_fraction: Vec::new(),
        })
    }

    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let radius = geometry.relative_radius_mm(position_mm);
        let a = foundation::half_width_mm(self.foundation_mpa_per_mm, radius, line_load_n_per_mm);
        a * a / (2.0 * radius)
    }
}

/// The points of each flank that may touch, with the gap they face.
type Observed = PerGear<(ObservedPoints, GapAtPoints)>;

/// Where a pair is, and how much of its flanks it looks at.
struct Site<'a> {
    flanks: Flanks<'a>,
    position_mm: f64,
    cell: Option<PositionCell>,
    half_window_mm: f64,
}

impl Site<'_> {
    /// Samples the flanks over the window.
    fn look(&self) -> (Strip, Option<Observed>) {
        let window = Window::new(self.flanks, self.position_mm, self.half_window_mm);
        let strip = Strip::new(self.flanks, self.position_mm, window);
        let observed = self.cell.map(|cell| {
            PerGear::from_fn(|gear| {
                let points = ObservedPoints::new(self.flanks, gear, window, cell);
                let gap = GapAtPoints::new(self.flanks, gear, &points, self.position_mm);
                (points, gap)
            })
        });
        (strip, observed)
    }
}

/// One tooth pair on the foundation.
struct WinklerPair<'a> {
    foundation: f64,
    radius_mm: f64,
    site: Site<'a>,
    strip: Strip,
    observed: Option<Observed>,
    /// Real gap at the strip's samples, mm.
    gap: Vec<f64>,
    /// The last approach pressed, mm.
    approach: f64,
    /// Outermost places in contact at equilibrium, along the tangent.
    extent_mm: (f64, f64),
    /// Real gap at the observed points of one flank, mm.
    observed_gap: Vec<f64>,
    /// Pressure at the observed points of one flank, MPa.
    pressure: Vec<f64>,
    greatest_pressure: Vec<f64>,
    contact_fraction: Vec<f64>,
}

impl PairContact for WinklerPair<'_> {
    fn read(&mut self, removed_mm: PerGear<&[f64]>) {
        self.strip.gap_mm(removed_mm, &mut self.gap);
    }

    fn press(&mut self, approach_mm: f64) -> Response {
        self.approach = approach_mm;
        // Sums over cells of mean penetration, fraction in contact, and how fast that fraction grows with the approach.
        let (mut penetration, mut contact, mut growth) = (0.0, 0.0, 0.0);
        let mut before = approach_mm - self.gap[0];
        for gap in &self.gap[1..] {
            let here = approach_mm - gap;
            if before >= 0.0 && here >= 0.0 {
                penetration += 0.5 * (before + here);
                contact += 1.0;
            } else if before > 0.0 || here > 0.0 {
                let across = before.abs() + here.abs();
                let fraction = before.max(here) / across;
                penetration += 0.5 * fraction * before.max(here);
                contact += fraction;
                growth += 1.0 / across;
            }
            before = here;
        }
        let curvature = self.strip.spacing_mm * self.strip.spacing_mm / (12.0 * self.radius_mm);
        let foundation = self.foundation * self.strip.spacing_mm;
        Response {
            line_load_n_per_mm: foundation * (penetration + curvature * contact),
            stiffness_n_per_mm2: foundation * (contact + curvature * growth),
        }
    }

    fn ample_approach_mm(&self, line_load_n_per_mm: f64) -> f64 {
        // At a tip edge half of the strip carries the load, as if it were twice as large.
        let a = foundation::half_width_mm(self.foundation, self.radius_mm, 2.0 * line_load_n_per_mm);
        let least_gap = self.gap.iter().copied().fold(f64::INFINITY, f64::min);
        least_gap + a * a / (2.0 * self.radius_mm)
    }

    fn settle(&mut self) -> bool {
        self.extent_mm = self.extent_mm();
        !self.strip.may_touch_beyond(self.approach)
    }

    fn widen(&mut self) {
        self.site.half_window_mm *= 1.5;
        (self.strip, self.observed) = self.site.look();
    }

    fn sweep(&mut self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Sweep<'_> {
        let Some(observed) = &self.observed else { return Sweep::NOTHING };
        let (points, gap) = &observed[gear];
        let (lower, upper) = match gear {
            Gear::Pinion => self.extent_mm,
            Gear::Wheel => (-self.extent_mm.1, -self.extent_mm.0),
        };
        let near = points.between(lower, upper);
        gap.gap_mm(points, gear, removed_mm, near.clone(), &mut self.observed_gap);
        for felt in [&mut self.pressure, &mut self.greatest_pressure, &mut self.contact_fraction] {
            felt.resize(near.len(), 0.0);
        }
        let (approach, foundation) = (self.approach, self.foundation);
        let [to_begin, to_end] = &gap.change_to_ends_mm;
        let course = to_begin[near.clone()].iter().zip(&to_end[near.clone()]).zip(&gap.sag_mm[near.clone()]);
        let felt = self.pressure.iter_mut().zip(&mut self.greatest_pressure).zip(&mut self.contact_fraction);
        for (((pressure, greatest), fraction), (gap, ((begin, end), sag))) in
            felt.zip(self.observed_gap.iter().zip(course))
        {
            // The approach is that of the loading position: there, or as near to it as the point faces the mate.
            let nearest = begin.min(*end).max(0.0).min(begin.max(*end));
            *greatest = foundation * (approach - gap - nearest).max(0.0);
            let u = approach - gap - sag;
            let (u0, u1) = (u - begin, u - end);
            let positive = u0.max(0.0) + u1.max(0.0);
            *fraction = positive / (u0.abs() + u1.abs() + f64::MIN_POSITIVE);
            *pressure = 0.5 * foundation * positive * *fraction;
        }
        Sweep {
            first_point: points.first_point + near.start,
            pressure_mpa: &self.pressure,
            greatest_pressure_mpa: &self.greatest_pressure,
            sliding_mm: &points.sliding_mm[near],
            contact_fraction: &self.contact_fraction,
        }
    }

    fn footprint(&self) -> Footprint {
        let penetration = (self.approach - least(&self.gap)).max(0.0);
        let half_width_mm = 0.5 * (self.extent_mm.1 - self.extent_mm.0);
        Footprint { peak_pressure_mpa: self.foundation * penetration, half_width_mm }
    }
}

/// The least of evenly spaced samples: the bottom of the parabola through the lowest and its neighbours, or the lowest
/// itself at an end.
fn least(samples: &[f64]) -> f64 {
    let Some(k) = (0..samples.len()).min_by(|&a, &b| samples[a].total_cmp(&samples[b])) else { return f64::INFINITY };
    match samples.get(k.wrapping_sub(1)..k + 2) {
        Some(&[before, lowest, after]) if before + after > 2.0 * lowest => {
            lowest - (before - after).powi(2) / (8.0 * (before + after - 2.0 * lowest))
        }
        _ => samples[k],
    }
}

impl WinklerPair<'_> {
    /// Outermost places in contact, found between samples; empty at 0 without contact.
    fn extent_mm(&self) -> (f64, f64) {
        let u = |k: usize| self.approach - self.gap[k];
        let touches = |gap: &f64| *gap < self.approach;
        let (Some(first), Some(last)) = (self.gap.iter().position(touches), self.gap.iter().rposition(touches)) else {
            return (0.0, 0.0);
        };
        // The gap passes through the approach between the outermost sample in contact and the next one.
        let before = if first > 0 { u(first) / (u(first) - u(first - 1)) } else { 0.0 };
        let after = if last + 1 < self.gap.len() { u(last) / (u(last) - u(last + 1)) } else { 0.0 };
        let place = |sample: f64| self.strip.window.lower_mm + sample * self.strip.spacing_mm;
        (place(first as f64 - before), place(last as f64 + after))
    }
}
