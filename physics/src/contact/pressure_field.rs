//! The pressure along a contact, from the uniform pressures of its cells.
//!
//! The field is linear from the centre of one cell to the next, and constant in the outer halves of the outermost
//! cells: it carries the load of the cells exactly. Its integral P(x) is kept at the centres; a flank point that moves from x₁ to x₂ feels (P(x₂) − P(x₁))/(x₂ − x₁) on average.
//!
//! Between A and E the field is mirrored at an end under pressure with which it does not go ([`super::flank_motion`]): within the cell of a position the edge moves to either side of its place,
//! uncovers as much on the one side as it covers on the other, and the flank feels the load of the cells on average. At A and E, where the edge only
//! moves away, and before A and after E, where the field goes with it, there is no pressure beyond it.
//!
//! Where a contact ends by itself, pressure begins as √s with the distance s from its end, and the load within s as s^{3/2}.
//! So P^{2/3} is a straight line there, and its zero, from the loads of the two and of the three outermost cells, is the end
//! of the contact: to second order in the width of the cells, though the cells themselves know it to half a width only.

use super::standard_deviation::{HALF_WIDTH_OF_ELLIPSE, standard_deviation_mm};
use super::{Footprint, PressedCell};

/// Number of cells whose loads determine the end of a contact.
const END_CELLS: usize = 3;

/// Pressure on evenly spaced cells.
#[derive(Debug, Clone, Default)]
pub(crate) struct PressureField {
    /// Begin of the first cell, mm.
    lower_mm: f64,
    width_mm: f64,
    /// Whether the field is mirrored at an edge.
    mirrored: bool,
    pressure_mpa: Vec<f64>,
    /// Load from the beginning to the centre of each cell, N/mm.
    load_below: Vec<f64>,
    /// First and last cell under pressure.
    pressed: Option<(usize, usize)>,
    /// Outermost places under pressure; both 0 without pressure.
    extent_mm: (f64, f64),
    /// Greatest pressure, between the cells' centres.
    peak_mpa: f64,
}

impl PressureField {
    /// Cells of `width_mm` from `lower_mm` on without pressure; `mirrored` at an edge under pressure or not.
    pub(crate) fn new(lower_mm: f64, width_mm: f64, mirrored: bool) -> Self {
        Self { lower_mm, width_mm, mirrored, ..Self::default() }
    }

    /// Exchanges the pressures: the function fills a vector with that of each cell, two at least.
    pub(crate) fn fill(&mut self, pressure_mpa: impl FnOnce(&mut Vec<f64>)) {
        pressure_mpa(&mut self.pressure_mpa);
        self.load_below.clear();
        let mut load = 0.0;
        let mut before = None;
        for &pressure in &self.pressure_mpa {
            load += match before {
                None => 0.5 * self.width_mm * pressure,
                Some(before) => 0.5 * self.width_mm * (before + pressure),
            };
            before = Some(pressure);
            self.load_below.push(load);
        }
        let is_pressed = |pressure: &f64| *pressure > 0.0;
        let first = self.pressure_mpa.iter().position(is_pressed);
        self.pressed = first.zip(self.pressure_mpa.iter().rposition(is_pressed));
        (self.extent_mm, self.peak_mpa) = (self.found_extent_mm(), self.found_peak_mpa());
    }

    /// Pressure of each cell, MPa.
    pub(crate) fn cells_mpa(&self) -> &[f64] {
        &self.pressure_mpa
    }

    /// First and last cell under pressure.
    pub(crate) fn pressed(&self) -> Option<(usize, usize)> {
        self.pressed
    }

    /// Pressure at `x_mm`.
    pub(crate) fn at_mpa(&self, x_mm: f64) -> f64 {
        let (k, weight) = self.place(x_mm);
        let weight = weight.clamp(0.0, 1.0);
        self.pressure_mpa[k] + weight * (self.pressure_mpa[k + 1] - self.pressure_mpa[k])
    }

    /// Mean pressure from one place to another; at the place itself where they are the same.
    pub(crate) fn mean_mpa(&self, [from_mm, to_mm]: [f64; 2]) -> f64 {
        let length = to_mm - from_mm;
        if length.abs() <= 1e-9 * self.width_mm {
            return self.at_mpa(0.5 * (from_mm + to_mm));
        }
        (self.load_below(to_mm) - self.load_below(from_mm)) / length
    }

    /// Fills in the `weights` of the pressures of `cells` cells in the mean of [`Self::mean_mpa`], where the field is not mirrored. Returns the first
    /// cell with a weight.
    pub(crate) fn mean_weights(&self, cells: usize, [from_mm, to_mm]: [f64; 2], weights: &mut Vec<f64>) -> usize {
        let upper_mm = self.lower_mm + cells as f64 * self.width_mm;
        let place = |x_mm: f64| self.place_among(cells, x_mm);
        let length_mm = to_mm - from_mm;
        weights.clear();
        if length_mm.abs() <= 1e-9 * self.width_mm {
            let (k, weight) = place(0.5 * (from_mm + to_mm));
            let weight = weight.clamp(0.0, 1.0);
            weights.extend([1.0 - weight, weight]);
            return k;
        }
        let ends = [from_mm, to_mm].map(|end_mm| place(end_mm.clamp(self.lower_mm, upper_mm)));
        let first = ends[0].0.min(ends[1].0);
        weights.resize(ends[0].0.max(ends[1].0) + 2 - first, 0.0);
        for ((k, weight), sign) in ends.into_iter().zip([-1.0, 1.0]) {
            // P(x) is Σ of all cells before k, and these parts of the two around x.
            let (here, next) = if weight < 0.0 {
                (0.5 + weight, 0.0)
            } else if weight > 1.0 {
                (1.0, weight - 0.5)
            } else {
                (0.5 + weight - 0.5 * weight * weight, 0.5 * weight * weight)
            };
            let part = sign * self.width_mm / length_mm;
            weights[..k - first].iter_mut().for_each(|before| *before += part);
            weights[k - first] += part * here;
            weights[k + 1 - first] += part * next;
        }
        first
    }

    /// Whether the mean from one place to another depends on the field's being mirrored, where it has so many cells.
    pub(crate) fn may_be_mirrored(&self, cells: usize, ends_mm: [f64; 2]) -> bool {
        let upper_mm = self.lower_mm + cells as f64 * self.width_mm;
        self.mirrored && ends_mm.into_iter().any(|end_mm| !(self.lower_mm..=upper_mm).contains(&end_mm))
    }

    /// Greatest pressure from one place to another.
    pub(crate) fn greatest_mpa(&self, [from_mm, to_mm]: [f64; 2]) -> f64 {
        let [low, high] = [from_mm.min(to_mm), from_mm.max(to_mm)]
            .map(|x_mm| ((x_mm - self.lower_mm) / self.width_mm - 0.5).max(0.0));
        let (low, high) = (low.ceil() as usize, high as usize);
        let centres = self.pressure_mpa.iter().take(high + 1).skip(low).copied();
        centres.fold(self.at_mpa(from_mm).max(self.at_mpa(to_mm)), f64::max)
    }

    /// P(x), N/mm.
    fn load_below(&self, x_mm: f64) -> f64 {
        let upper_mm = self.lower_mm + self.pressure_mpa.len() as f64 * self.width_mm;
        let edge_mm = x_mm.clamp(self.lower_mm, upper_mm);
        let at_edge = self.load_within(edge_mm);
        if x_mm == edge_mm || !self.mirrored || self.at_mpa(edge_mm) <= 0.0 {
            return at_edge;
        }
        2.0 * at_edge - self.load_within(2.0 * edge_mm - x_mm)
    }

    /// P(x) within the cells, N/mm.
    fn load_within(&self, x_mm: f64) -> f64 {
        let (k, weight) = self.place(x_mm);
        let (here, next) = (self.pressure_mpa[k], self.pressure_mpa[k + 1]);
        let mean_times_weight = if weight < 0.0 {
            weight * here
        } else if weight > 1.0 {
            0.5 * (here + next) + (weight - 1.0) * next
        } else {
            weight * (here + 0.5 * weight * (next - here))
        };
        self.load_below[k] + self.width_mm * mean_times_weight
    }

    /// Centre before `x_mm`, and the distance from it in cells: 0 to 1, but below 0 before the first and above 1 after the
    /// last centre.
    fn place(&self, x_mm: f64) -> (usize, f64) {
        self.place_among(self.pressure_mpa.len(), x_mm)
    }

    fn place_among(&self, cells: usize, x_mm: f64) -> (usize, f64) {
        let from_first = (x_mm - self.lower_mm) / self.width_mm - 0.5;
        let k = (from_first.max(0.0) as usize).min(cells - 2);
        (k, from_first - k as f64)
    }

    /// Outermost places under pressure; both 0 without pressure.
    pub(crate) fn extent_mm(&self) -> (f64, f64) {
        self.extent_mm
    }

    fn found_extent_mm(&self) -> (f64, f64) {
        let p = &self.pressure_mpa;
        let Some((first, last)) = self.pressed else { return (0.0, 0.0) };
        // A contact that reaches the outermost cell ends where the surfaces end.
        let before = if first == 0 { 0.0 } else { inset(p[first..=last].iter()) };
        let after = if last + 1 == p.len() { 0.0 } else { inset(p[first..=last].iter().rev()) };
        let [lower, upper] =
            [first as f64 + before, (last + 1) as f64 - after].map(|cells| self.lower_mm + cells * self.width_mm);
        (lower, upper)
    }

    /// Greatest pressure, between the cells' centres, half the extent, and the half-width of Hertz's ellipse with the same second moment.
    pub(crate) fn footprint(&self) -> Footprint {
        let (lower, upper) = self.extent_mm;
        let cells = self.pressure_mpa.iter().zip(0..).map(|(&pressure_mpa, k)| {
            let lower_mm = f64::from(k) * self.width_mm;
            PressedCell { lower_mm, upper_mm: lower_mm + self.width_mm, pressure_mpa }
        });
        Footprint {
            peak_pressure_mpa: self.peak_mpa,
            half_width_mm: 0.5 * (upper - lower),
            equivalent_half_width_mm: HALF_WIDTH_OF_ELLIPSE * standard_deviation_mm(cells),
            at_sharp_edge: false,
        }
    }

    /// Top of the parabola through the greatest pressure and its neighbours, or the pressure itself in an outermost cell.
    fn found_peak_mpa(&self) -> f64 {
        let p = &self.pressure_mpa;
        let Some(k) = (0..p.len()).max_by(|&a, &b| p[a].total_cmp(&p[b])) else { return 0.0 };
        match p.get(k.wrapping_sub(1)..k + 2) {
            Some(&[before, highest, after]) if before.min(after) > 0.0 && 2.0 * highest > before + after => {
                highest + (before - after).powi(2) / (8.0 * (2.0 * highest - before - after))
            }
            _ => p[k],
        }
    }
}

/// Distance of the end of a contact from the outer end of its outermost cell, in cells, by the loads of the cells from its end on.
fn inset<'a>(pressures: impl Iterator<Item = &'a f64>) -> f64 {
    let mut load = 0.0;
    let mut powers = [0.0; END_CELLS];
    let mut count = 0;
    for (power, pressure) in powers.iter_mut().zip(pressures) {
        load += pressure;
        *power = load.powf(2.0 / 3.0);
        count += 1;
    }
    if count < END_CELLS {
        return 0.0;
    }
    let [_, two, three] = powers;
    (2.0 - two / (three - two)).clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(pressures: &[f64]) -> PressureField {
        let mut field = PressureField::new(-0.3, 0.1, true);
        field.fill(|cells| cells.extend_from_slice(pressures));
        field
    }

    /// The field carries the load of the cells, Σ p Δ, whatever the pressures, also up to the ends of the surfaces.
    #[test]
    fn ver_the_field_carries_the_load_of_the_cells() {
        for pressures in [[0.0, 3.0, 5.0, 4.0, 0.0, 0.0], [7.0, 3.0, 0.0, 0.0, 2.0, 9.0]] {
            let field = field(&pressures);
            let load = field.mean_mpa([-0.3, 0.3]) * 0.6;
            assert!((load / (0.1 * pressures.iter().sum::<f64>()) - 1.0).abs() < 1e-14);
            // The mean over a stretch by the midpoint rule.
            let (from, to, parts) = (-0.29, 0.28, 1 << 14);
            let step = (to - from) / f64::from(parts);
            let sum: f64 = (0..parts).map(|i| field.at_mpa(from + (f64::from(i) + 0.5) * step)).sum();
            assert!((field.mean_mpa([from, to]) / (sum / f64::from(parts)) - 1.0).abs() < 1e-6);
            let greatest = (0..parts).map(|i| field.at_mpa(from + (f64::from(i) + 0.5) * step)).fold(0.0, f64::max);
            assert!((field.greatest_mpa([to, from]) / greatest - 1.0).abs() < 1e-3);
            // The mirror image beyond ends under pressure, nothing beyond others.
            for [within, beyond] in [[[-0.3, -0.18], [-0.42, -0.3]], [[0.17, 0.3], [0.3, 0.43]]] {
                let loaded = field.at_mpa(if within[0] < 0.0 { -0.3 } else { 0.3 }) > 0.0;
                let [within, beyond] = [within, beyond].map(|stretch| field.mean_mpa(stretch));
                assert!((beyond - if loaded { within } else { 0.0 }).abs() < 1e-12);
            }
        }
    }

    /// Means by weights of the cells are those of the field, from any place to any other, where it is not mirrored.
    #[test]
    fn ver_weights_of_cells_give_the_mean() {
        let pressures = [7.0, 3.0, 0.5, 0.0, 2.0, 9.0];
        let field = PressureField { mirrored: false, ..field(&pressures) };
        let places = (-40..=40).map(|k| 0.0101 * f64::from(k));
        let mut weights = Vec::new();
        for from in places.clone() {
            for to in places.clone().chain([from]) {
                let first = field.mean_weights(pressures.len(), [from, to], &mut weights);
                let by_weights: f64 = weights.iter().zip(&pressures[first..]).map(|(weight, p)| weight * p).sum();
                let mean = field.mean_mpa([from, to]);
                assert!((by_weights - mean).abs() < 1e-9, "{from} to {to}: {by_weights} {mean}");
            }
        }
    }

    /// √s from −0.17 on and to the end of the surfaces: the end of the contact within a hundredth of a cell, while cells alone
    /// know it to half of one.
    #[test]
    fn ver_a_contact_ends_between_cells() {
        let pressures = [0, 1, 2, 3, 4, 5].map(|k| {
            let from = -0.3 + 0.1 * f64::from(k) + 0.17;
            let [below, to_end] = [from, from + 0.1].map(|s: f64| s.max(0.0).powf(1.5));
            to_end - below
        });
        let (lower, upper) = field(&pressures).extent_mm();
        assert!((lower + 0.17).abs() < 1e-3, "{lower}");
        assert!((upper - 0.3).abs() < 1e-12, "{upper}");
    }
}
