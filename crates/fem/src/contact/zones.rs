//! Where on a surface the pressure is, and how far it reaches.
//!
//! Along the nodes of a surface a zone is a run of nodes under pressure. Its end lies between the last node under pressure
//! and the first without, where p² falls to zero: against a smooth edge of contact the pressure goes with the square root
//! of the distance, so p² is smooth there and a parabola in Hertz's contact. It is fitted to the nodes next to the last
//! (whose own multiplier stands for a partly loaded stretch), and is exact for Hertz's ellipse. Against a sharp edge,
//! where p² rises outwards, the zone reaches to the first node without pressure. Where the zone reaches the end of the
//! surface, that is its end.

use nalgebra::{Matrix3, Vector3};

/// Nodes that the parabola is fitted to at most: enough to even out the middle and end nodes of quadratic edges.
const MOST_SAMPLES: usize = 6;

/// One run of nodes under pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// First and last node under pressure.
    pub nodes: (usize, usize),
    /// From, along the surface, mm.
    pub from_mm: f64,
    /// To, mm.
    pub to_mm: f64,
    /// Whether it begins and ends at the surface's own ends.
    pub at_end: (bool, bool),
}

impl Zone {
    /// Its length, mm.
    pub fn width_mm(&self) -> f64 {
        self.to_mm - self.from_mm
    }
}

/// The zones of pressure `pressure` at nodes at `along_mm`, both in the order of the surface.
pub fn zones(along_mm: &[f64], pressure: &[f64]) -> Vec<Zone> {
    let n = pressure.len();
    let mut zones = Vec::new();
    let mut i = 0;
    while i < n {
        if pressure[i] <= 0.0 {
            i += 1;
            continue;
        }
        let first = i;
        while i + 1 < n && pressure[i + 1] > 0.0 {
            i += 1;
        }
        let last = i;
        let from_mm = match first {
            0 => along_mm[0],
            _ => edge_mm(along_mm, pressure, first, last, -1),
        };
        let to_mm = if last + 1 == n { along_mm[n - 1] } else { edge_mm(along_mm, pressure, last, first, 1) };
        zones.push(Zone { nodes: (first, last), from_mm, to_mm, at_end: (first == 0, last + 1 == n) });
        i += 1;
    }
    zones
}

/// Where the pressure ends beyond node `end` in the direction `step`; `other` is the zone's other end.
fn edge_mm(along_mm: &[f64], pressure: &[f64], end: usize, other: usize, step: isize) -> f64 {
    let inward = |k: usize| end.wrapping_add_signed(-step * k as isize);
    let beyond = along_mm[end.wrapping_add_signed(step)];
    let inside = end.abs_diff(other);
    if inside == 0 {
        return 0.5 * (along_mm[end] + beyond);
    }
    // Outward distance from the node next to the last, and p².
    let origin = if inside == 1 { end } else { inward(1) };
    let outward = (beyond - along_mm[origin]).signum();
    let sample = |k: usize| (outward * (along_mm[inward(k)] - along_mm[origin]), pressure[inward(k)].powi(2));
    let root = match inside {
        1 => line_root([sample(0), sample(1)]),
        2 => line_root([sample(1), sample(2)]),
        _ => {
            // In units of the distance to the next node, for the sake of the fit.
            let unit = (along_mm[origin] - along_mm[inward(2)]).abs();
            let samples = (1..=inside.min(MOST_SAMPLES)).map(|k| (sample(k).0 / unit, sample(k).1));
            parabola_root(samples).map(|t| t * unit).or_else(|| line_root([sample(1), sample(2)]))
        }
    };
    // The last node's own share begins halfway to the node before it.
    let nearest = if inside == 1 { along_mm[end] } else { 0.5 * (along_mm[end] + along_mm[inward(1)]) };
    let extrapolated = root.map_or(beyond, |t| along_mm[origin] + outward * t);
    extrapolated.clamp(nearest.min(beyond), nearest.max(beyond))
}

/// Where the line through two samples (t, q), the first at t = 0 with q > 0, falls to zero.
fn line_root([(_, q0), (t1, q1)]: [(f64, f64); 2]) -> Option<f64> {
    let slope = (q1 - q0) / t1;
    (slope < 0.0).then(|| -q0 / slope)
}

/// Where the parabola that fits the samples (t, q) best falls to zero beyond t = 0.
fn parabola_root(samples: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (mut gram, mut side) = (Matrix3::zeros(), Vector3::zeros());
    for (t, q) in samples {
        let row = Vector3::new(1.0, t, t * t);
        gram += row * row.transpose();
        side += q * row;
    }
    let fit = gram.cholesky()?.solve(&side);
    let (a, b, c) = (fit.x, fit.y, fit.z);
    // a + b t + c t² = 0, written so that nothing cancels.
    let discriminant = b * b - 4.0 * a * c;
    let below = discriminant.max(0.0).sqrt() - b;
    (a > 0.0 && discriminant >= 0.0 && below > 0.0).then(|| 2.0 * a / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hertz's ellipse of half-width 1 around 0.03 sampled at distances of 0.1 gives back its ends to round-off.
    #[test]
    fn ver_ends_of_an_ellipse() {
        let along: Vec<f64> = (-20..=20).map(|i| 0.1 * f64::from(i)).collect();
        let pressure: Vec<f64> = along.iter().map(|s| (1.0 - (s - 0.03_f64).powi(2)).max(0.0).sqrt()).collect();
        let found = zones(&along, &pressure);
        assert_eq!(found.len(), 1);
        assert!((found[0].from_mm + 0.97).abs() < 1e-12 && (found[0].to_mm - 1.03).abs() < 1e-12, "{found:?}");
        assert_eq!(found[0].at_end, (false, false));
    }

    #[test]
    fn two_zones_and_a_zone_at_the_end() {
        let found = zones(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &[2.0, 1.0, 0.0, 0.0, 0.0, 4.0]);
        assert_eq!(found.iter().map(|zone| zone.nodes).collect::<Vec<_>>(), [(0, 1), (5, 5)]);
        assert!(found[0].at_end.0 && found[1].at_end.1);
        assert_eq!(found[1].from_mm, 4.5);
    }
}
