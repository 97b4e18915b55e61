//! Zones of pressure on a surface.
//!
//! A zone is a run of nodes under pressure along a surface. It ends between the last node under pressure
//! and the first without, where p² falls to zero: at a smooth edge of contact the pressure is proportional to the square root
//! of the distance, so p² is smooth there and a parabola in Hertz's contact. The parabola is fitted to the nodes before the last
//! (whose own multiplier represents a partly loaded stretch), and is exact for Hertz's ellipse. At a sharp edge,
//! where p² rises outwards, the zone ends at the first node without pressure, and at the end of the surface it ends there.

use nalgebra::{Matrix3, Vector3};

/// Greatest number of nodes to which the parabola is fitted: enough to average middle and end nodes of quadratic edges.
const MOST_SAMPLES: usize = 6;

/// Run of nodes under pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// First and last node under pressure.
    pub nodes: (usize, usize),
    /// Beginning along the surface, mm.
    pub from_mm: f64,
    /// End along the surface, mm.
    pub to_mm: f64,
    /// Whether it begins and ends at the ends of the surface.
    pub at_end: (bool, bool),
}

impl Zone {
    /// Length, mm.
    pub fn width_mm(&self) -> f64 {
        self.to_mm - self.from_mm
    }
}

/// Zones of `pressure` at nodes at `along_mm`, both in the order of the surface.
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

/// End of the pressure beyond node `end` in the direction `step`; `other` is the zone's other end.
fn edge_mm(along_mm: &[f64], pressure: &[f64], end: usize, other: usize, step: isize) -> f64 {
    let beyond = along_mm[end.wrapping_add_signed(step)];
    // Nodes from the end inwards.
    let inwards: Vec<usize> =
        (0..=end.abs_diff(other).min(MOST_SAMPLES)).map(|k| end.wrapping_add_signed(-step * k as isize)).collect();
    if inwards.len() == 1 {
        return 0.5 * (along_mm[end] + beyond);
    }
    // Outward distance from the node before the last, and p².
    let origin_mm = along_mm[inwards[if inwards.len() == 2 { 0 } else { 1 }]];
    let outward = (beyond - origin_mm).signum();
    let samples: Vec<(f64, f64)> =
        inwards.iter().map(|&node| (outward * (along_mm[node] - origin_mm), pressure[node].powi(2))).collect();
    let root = match samples[..] {
        [first, second] => line_root([first, second]),
        [_, first, second] => line_root([first, second]),
        _ => {
            // In units of the distance to the next node, for the condition of the fit.
            let unit = (origin_mm - along_mm[inwards[2]]).abs();
            let root = parabola_root(samples[1..].iter().map(|(t, q)| (t / unit, *q)));
            root.map(|t| t * unit).or_else(|| line_root([samples[1], samples[2]]))
        }
    };
    // The stretch of the last node begins halfway to the node before it.
    let nearest = if inwards.len() == 2 { along_mm[end] } else { 0.5 * (along_mm[end] + origin_mm) };
    let extrapolated = root.map_or(beyond, |t| origin_mm + outward * t);
    extrapolated.clamp(nearest.min(beyond), nearest.max(beyond))
}

/// Zero of the line through two samples (t, q), the first at t = 0 with q > 0.
fn line_root([(_, q0), (t1, q1)]: [(f64, f64); 2]) -> Option<f64> {
    let slope = (q1 - q0) / t1;
    (slope < 0.0).then(|| -q0 / slope)
}

/// Zero beyond t = 0 of the least-squares parabola through the samples (t, q).
fn parabola_root(samples: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let (mut gram, mut side) = (Matrix3::zeros(), Vector3::zeros());
    for (t, q) in samples {
        let row = Vector3::new(1.0, t, t * t);
        gram += row * row.transpose();
        side += q * row;
    }
    let fit = gram.cholesky()?.solve(&side);
    let (a, b, c) = (fit.x, fit.y, fit.z);
    // Root of a + b t + c t² without cancellation.
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
