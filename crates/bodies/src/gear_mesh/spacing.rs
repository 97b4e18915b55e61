//! Division of the outline into elements of wanted, smoothed lengths.
//!
//! A run is a stretch of outline between two required nodes (a corner, a change of curve, a kink). Along it the
//! wanted length h(s) is sampled; lengths of neighbouring elements stay within a factor because h grows at a
//! limited rate g along the outline,
//!
//! ```text
//! h(s) ≤ h(s') + g |s − s'|          N = ⌈∫ ds / h(s)⌉ elements, nodes at equal shares of the integral
//! ```
//!
//! Nodes between samples are found on the true curve: the samples interpolate the curve's parameter, not its points.

use nalgebra::Vector2;

use super::profile::{Piece, Profile};

/// ToothSide of the tooth; the working flank is on the left, anticlockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ToothSide {
    /// x > 0.
    Right,
    /// x < 0.
    Left,
}

/// Point of the outline by its parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct OutlinePoint {
    pub side: ToothSide,
    pub piece: Piece,
    /// Parameter of the piece.
    pub u: f64,
}

/// OutlinePart of the outline that a run belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OutlinePart {
    RootArc,
    Fillet,
    Flank,
    /// Rounding and chamfer of the tip edge.
    TipEdge,
    Land,
}

#[derive(Debug, Clone, Copy)]
struct Sample {
    place: OutlinePoint,
    point_mm: Vector2<f64>,
    /// Arc length from the beginning of the run.
    s_mm: f64,
    /// Wanted element length.
    length_mm: f64,
}

/// Stretch of outline between two required nodes.
#[derive(Debug, Clone)]
pub(super) struct OutlineRun {
    pub side: ToothSide,
    pub part: OutlinePart,
    samples: Vec<Sample>,
}

/// Node of the outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct OutlineNode {
    pub place: OutlinePoint,
    pub point_mm: Vector2<f64>,
    /// Wanted element length.
    pub length_mm: f64,
}

impl Profile<'_> {
    /// Coordinates of `place`.
    pub(super) fn at_mm(&self, place: OutlinePoint) -> Vector2<f64> {
        let point = self.point_mm(place.piece, place.u);
        match place.side {
            ToothSide::Right => point,
            ToothSide::Left => Vector2::new(-point.x, point.y),
        }
    }
}

impl OutlineRun {
    /// OutlineRun through `stretches`, each a piece on a side with its first and last parameter, sampled with `per_stretch` intervals each.
    pub(super) fn new(
        profile: &Profile,
        part: OutlinePart,
        stretches: &[(ToothSide, Piece, [f64; 2])],
        per_stretch: usize,
    ) -> Self {
        let mut samples: Vec<Sample> = Vec::with_capacity(stretches.len() * (per_stretch + 1));
        let mut s_mm = 0.0;
        for &(side, piece, [first, last]) in stretches {
            for k in 0..=per_stretch {
                let place = OutlinePoint { side, piece, u: first + (last - first) * k as f64 / per_stretch as f64 };
                let point_mm = profile.at_mm(place);
                s_mm += samples.last().map_or(0.0, |before| (point_mm - before.point_mm).norm());
                samples.push(Sample { place, point_mm, s_mm, length_mm: f64::INFINITY });
            }
        }
        let side = stretches.first().map_or(ToothSide::Right, |stretch| stretch.0);
        Self { side, part, samples }
    }

    /// Arc length.
    pub(super) fn arc_mm(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.s_mm)
    }

    /// Limits the wanted length by `wanted`, a function of place and point.
    pub(super) fn want(&mut self, wanted: impl Fn(OutlinePoint, Vector2<f64>) -> f64) {
        for sample in &mut self.samples {
            sample.length_mm = sample.length_mm.min(wanted(sample.place, sample.point_mm));
        }
    }

    /// Limits the wanted length by `factor` times the radius of curvature, but not below `least_mm`.
    pub(super) fn follow_curvature(&mut self, factor: f64, least_mm: f64) {
        for k in 1..self.samples.len().saturating_sub(1) {
            let (before, after) = (
                self.samples[k].point_mm - self.samples[k - 1].point_mm,
                self.samples[k + 1].point_mm - self.samples[k].point_mm,
            );
            let (short, long) = (before.norm().min(after.norm()), before.norm().max(after.norm()));
            if short < 0.1 * long {
                // Coinciding samples at the joint of two curves.
                continue;
            }
            let turn = before.perp(&after).atan2(before.dot(&after)).abs();
            if turn > 0.0 {
                let radius = 0.5 * (before.norm() + after.norm()) / turn;
                let wanted = (factor * radius).max(least_mm);
                self.samples[k].length_mm = self.samples[k].length_mm.min(wanted);
            }
        }
    }

    /// ∫ ds/h up to each sample, exact for a piecewise linear length: Δs ln(h_b/h_a) / (h_b − h_a).
    fn integrated(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let mut elements = vec![0.0];
        for pair in self.samples.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            let growth = (b.length_mm - a.length_mm) / a.length_mm;
            let mean = if growth.abs() < 1e-6 { 1.0 - 0.5 * growth } else { growth.ln_1p() / growth };
            sum += (b.s_mm - a.s_mm) / a.length_mm * mean;
            elements.push(sum);
        }
        elements
    }

    /// Wanted number of elements, not rounded.
    pub(super) fn elements(&self) -> f64 {
        self.integrated().last().copied().unwrap_or(0.0)
    }

    /// Nodes of the run, ends and middles of elements alternately.
    pub(super) fn divide(&self, profile: &Profile) -> Vec<OutlineNode> {
        let elements = self.integrated();
        let sum = self.elements();
        let count = (sum - 1e-9).ceil().max(1.0) as usize;
        let mut ends: Vec<f64> = Vec::with_capacity(count + 1);
        let mut k = 0;
        for i in 0..=count {
            let target = sum * i as f64 / count as f64;
            while k + 2 < elements.len() && elements[k + 1] < target {
                k += 1;
            }
            let step = elements[k + 1] - elements[k];
            let part = if step > 0.0 { ((target - elements[k]) / step).clamp(0.0, 1.0) } else { 0.0 };
            let (a, b) = (&self.samples[k], &self.samples[k + 1]);
            // Inverse of the integral: h grows by equal factors over equal fractions of an element.
            let growth = (b.length_mm - a.length_mm) / a.length_mm;
            let weight = if growth.abs() < 1e-6 { part } else { (part * growth.ln_1p()).exp_m1() / growth };
            ends.push(a.s_mm + weight * (b.s_mm - a.s_mm));
        }
        if let Some(last) = ends.last_mut() {
            *last = self.arc_mm();
        }
        let mut nodes = Vec::with_capacity(2 * count + 1);
        let mut k = 0;
        for i in 0..=2 * count {
            let s = if i % 2 == 0 { ends[i / 2] } else { 0.5 * (ends[i / 2] + ends[i / 2 + 1]) };
            while k + 2 < self.samples.len() && self.samples[k + 1].s_mm < s {
                k += 1;
            }
            nodes.push(self.node(profile, k, s));
        }
        nodes
    }

    /// Node at arc length `s_mm`, in the interval after sample `k`.
    fn node(&self, profile: &Profile, k: usize, s_mm: f64) -> OutlineNode {
        let (a, b) = (&self.samples[k], &self.samples[k + 1]);
        let interval = b.s_mm - a.s_mm;
        let weight = if interval > 0.0 { ((s_mm - a.s_mm) / interval).clamp(0.0, 1.0) } else { 0.0 };
        // Two samples coincide where two curves meet; no node falls between them.
        let u = a.place.u + weight * (b.place.u - a.place.u);
        let place = if weight < 1.0 { OutlinePoint { u, ..a.place } } else { b.place };
        let length_mm = a.length_mm + weight * (b.length_mm - a.length_mm);
        OutlineNode { place, point_mm: profile.at_mm(place), length_mm }
    }
}

/// Limits the growth of the wanted length along the whole outline, whose ends may not exceed `at_ends_mm`.
pub(super) fn limit_growth(runs: &mut [OutlineRun], growth: f64, at_ends_mm: f64) {
    limit_growth_along(runs.iter_mut().flat_map(|run| run.samples.iter_mut()), growth, at_ends_mm);
    limit_growth_along(runs.iter_mut().rev().flat_map(|run| run.samples.iter_mut().rev()), growth, at_ends_mm);
}

/// Limits the growth of the wanted length in the order of `samples`, the first of which may not exceed `first_mm`.
fn limit_growth_along<'a>(samples: impl Iterator<Item = &'a mut Sample>, growth: f64, first_mm: f64) {
    let (mut length_mm, mut before): (f64, Option<Vector2<f64>>) = (first_mm, None);
    for sample in samples {
        let distance = before.map_or(0.0, |point| (sample.point_mm - point).norm());
        length_mm = (length_mm + growth * distance).min(sample.length_mm);
        sample.length_mm = length_mm;
        before = Some(sample.point_mm);
    }
}
