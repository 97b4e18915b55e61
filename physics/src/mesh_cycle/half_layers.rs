//! Loads on any number of slices, projected on the elements over the face width.
//!
//! A load within an element is shared by its nodes, and its deflection interpolated between them: both depend on its place in the
//! element. Elements are quadratic over the width, and resolve no more than their halves, which are alike by symmetry. So loads
//! act on halves of layers, and deflections are those of halves. With z the places of a slice a, cut where halves h end, into pieces p of the
//! width b_p with their middle at z_p,
//!
//! ```text
//! T_ha = Σ_p b_p/b_a N_h(z_p)       N_h: linear between the middles of halves, and on beyond the outermost; of a piece that is a whole half, 1 there
//! F_h = Σ_a T_ha F_a                u_a = Σ_h T_ha u_h
//! ```
//!
//! Σ_h T_ha = 1 and Σ_h z_h T_ha = z_a: force and moment are kept, and so are linear deflections. The same T both ways keeps
//! compliances symmetric.
//!
//! With N the quadratic shape functions of the layers, M = ∫ N Nᵀ dz, and m_h the mean of N over a half, the projection on N of a load w(z) that is
//! even in each half is (P w)_g = Σ_h S_gh b_h w_h.

use nalgebra::DMatrix;

use gearwear_fem::quadrature::GAUSS_3;
use gearwear_fem::shape::along_edge;

/// Halves of layers of elements over the face width.
#[derive(Clone)]
pub(super) struct HalfLayers {
    /// Ends of the halves, mm, from z = 0 on.
    ends_mm: Vec<f64>,
    /// S, 1/mm, row by row.
    seen_per_mm: Vec<f64>,
}

impl HalfLayers {
    /// Halves of layers that end at these places.
    pub(super) fn new(layer_ends_mm: &[f64]) -> Self {
        let mut ends_mm: Vec<f64> =
            layer_ends_mm.windows(2).flat_map(|ends| [ends[0], ends[0].midpoint(ends[1])]).collect();
        ends_mm.extend(layer_ends_mm.last());
        let seen_per_mm = projection_per_mm(layer_ends_mm);
        Self { ends_mm, seen_per_mm }
    }

    /// Number of halves.
    pub(super) fn count(&self) -> usize {
        self.ends_mm.len() - 1
    }

    /// Middle of a half.
    pub(super) fn middle_mm(&self, half: usize) -> f64 {
        self.ends_mm[half].midpoint(self.ends_mm[half + 1])
    }

    /// Points of integration of a half: place over the face width, mm, and weight, 1 in all.
    pub(super) fn points(&self, half: usize) -> [(f64, f64); 3] {
        let (from, to) = (self.ends_mm[half], self.ends_mm[half + 1]);
        GAUSS_3.map(|(s, weight)| (0.5 * ((from + to) + (to - from) * s), 0.5 * weight))
    }

    /// T of a slice: its parts of halves, in order.
    pub(super) fn parts(&self, from_mm: f64, to_mm: f64) -> Vec<(usize, f64)> {
        let mut parts = vec![0.0; self.count()];
        // Rounding errors make no piece.
        let round_off = 1e-9 * (to_mm - from_mm);
        for (half, ends) in self.ends_mm.windows(2).enumerate() {
            let (begin, end) = (from_mm.max(ends[0]), to_mm.min(ends[1]));
            let width = end - begin;
            if width <= round_off {
                continue;
            }
            let part = width / (to_mm - from_mm);
            if width >= (ends[1] - ends[0]) - round_off {
                parts[half] += part;
                continue;
            }
            let (before, weight) = self.between(begin.midpoint(end));
            parts[before] += part * (1.0 - weight);
            parts[before + 1] += part * weight;
        }
        parts.into_iter().enumerate().filter(|(_, part)| *part != 0.0).collect()
    }

    /// The half before `at_mm` in linear interpolation between the middles of halves, and the weight of the next one, beyond 0 to 1 next to the
    /// end faces.
    fn between(&self, at_mm: f64) -> (usize, f64) {
        let middles = (0..self.count()).filter(|half| self.middle_mm(*half) <= at_mm).count();
        let before = middles.saturating_sub(1).min(self.count() - 2);
        let (low, high) = (self.middle_mm(before), self.middle_mm(before + 1));
        (before, (at_mm - low) / (high - low))
    }

    /// S g S b between the halves `range`, row by row, with g of each half over the whole width.
    pub(super) fn seen_of(&self, of_halves: &[f64], range: std::ops::Range<usize>) -> Vec<f64> {
        let count = self.count();
        let rows: Vec<&[f64]> = self.seen_per_mm.chunks_exact(count).collect();
        let widths = self.ends_mm.windows(2).map(|ends| ends[1] - ends[0]);
        let weights: Vec<f64> = of_halves.iter().zip(widths).map(|(value, width)| value * width).collect();
        let mut products = Vec::with_capacity(range.len() * range.len());
        for half in range.clone() {
            let own: Vec<f64> = rows[half].iter().zip(&weights).map(|(s, g)| s * g).collect();
            products
                .extend(rows[range.clone()].iter().map(|row| own.iter().zip(*row).map(|(a, b)| a * b).sum::<f64>()));
        }
        products
    }
}

/// Quadratic shape functions of a layer at s = −1 … 1, in the order of their nodes.
fn shape_functions(s: f64) -> [f64; 3] {
    let ([start, end, middle], _) = along_edge(true, s);
    [start, middle, end]
}

/// S between the halves of layers that end at these places.
fn projection_per_mm(layer_ends_mm: &[f64]) -> Vec<f64> {
    let layers = layer_ends_mm.len() - 1;
    let (nodes, halves) = (2 * layers + 1, 2 * layers);
    let mut mass = DMatrix::<f64>::zeros(nodes, nodes);
    let mut means = DMatrix::<f64>::zeros(nodes, halves);
    for layer in 0..layers {
        let length_mm = layer_ends_mm[layer + 1] - layer_ends_mm[layer];
        for (s, weight) in GAUSS_3 {
            let at = shape_functions(s);
            for (i, f) in at.iter().enumerate() {
                for (j, g) in at.iter().enumerate() {
                    mass[(2 * layer + i, 2 * layer + j)] += 0.5 * length_mm * weight * f * g;
                }
            }
            for half in 0..2 {
                let within = 0.5 * (s - 1.0) + half as f64;
                for (i, value) in shape_functions(within).into_iter().enumerate() {
                    means[(2 * layer + i, 2 * layer + half)] += 0.5 * weight * value;
                }
            }
        }
    }
    // The mass of independent functions is positive definite.
    let solved = mass.cholesky().expect("the functions are independent").solve(&means);
    let product = means.transpose() * solved;
    (0..halves * halves).map(|k| product[(k / halves, k % halves)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENDS_MM: [f64; 6] = [0.0, 1.0, 3.0, 5.0, 7.0, 8.0];

    /// Slices of any number keep force and moment, and are halves where they end with them.
    #[test]
    fn ver_slices_keep_force_and_moment() {
        let halves = HalfLayers::new(&ENDS_MM);
        for count in [1, 2, 3, 5, 7, 8, 16, 33, 100] {
            let width = 8.0 / f64::from(count);
            for slice in 0..count {
                let (from, to) = (f64::from(slice) * width, f64::from(slice + 1) * width);
                let parts = halves.parts(from, to);
                let force: f64 = parts.iter().map(|(_, part)| part).sum();
                let moment: f64 = parts.iter().map(|(half, part)| part * halves.middle_mm(*half)).sum();
                assert!((force - 1.0).abs() < 1e-12, "{count}, {slice}: {force}");
                assert!((moment - 0.5 * (from + to)).abs() < 1e-12, "{count}, {slice}: {moment}");
            }
        }
        assert_eq!(halves.parts(2.0, 3.0), [(3, 1.0)]);
        assert_eq!(halves.parts(0.0, 1.0), [(0, 0.5), (1, 0.5)]);
    }

    /// The projection of an even load is the load, S b 1 = 1, whatever the lengths of the layers.
    #[test]
    fn ver_even_loads_are_seen_whole() {
        let halves = HalfLayers::new(&ENDS_MM);
        let count = halves.count();
        for row in halves.seen_per_mm.chunks_exact(count) {
            let seen: f64 = row.iter().zip(halves.ends_mm.windows(2)).map(|(s, ends)| s * (ends[1] - ends[0])).sum();
            assert!((seen - 1.0).abs() < 1e-12);
        }
        // P is a projection but for parts finer than a half: P g P of g = 1 is no more than P.
        let squared = halves.seen_of(&vec![1.0; count], 0..count);
        for half in 0..count {
            assert!(squared[half * (count + 1)] <= halves.seen_per_mm[half * (count + 1)] + 1e-12);
        }
    }
}
