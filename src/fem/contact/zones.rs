//! Where on a surface the pressure is, and how far it reaches.
//!
//! Along the nodes of a surface a zone is a run of nodes under pressure. Its end lies between the last node under pressure
//! and the first without, where p² falls to zero: against a smooth edge of contact the pressure goes with the square root
//! of the distance, so p² is a straight line there, drawn through the two nodes next to the last (whose own multiplier
//! stands for a partly loaded stretch). Where the zone reaches the end of the surface, that is its end.

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
    let beyond = along_mm[end.wrapping_add_signed(step)];
    let inside = |k: isize| end.wrapping_add_signed(-step * k);
    let (near, far) = match end.abs_diff(other) {
        0 => return 0.5 * (along_mm[end] + beyond),
        1 => (end, inside(1)),
        _ => (inside(1), inside(2)),
    };
    let [q_near, q_far] = [near, far].map(|node| pressure[node] * pressure[node]);
    let extrapolated = if q_far > q_near {
        along_mm[near] + (along_mm[near] - along_mm[far]) * q_near / (q_far - q_near)
    } else {
        beyond
    };
    let (low, high) = (along_mm[end].min(beyond), along_mm[end].max(beyond));
    extrapolated.clamp(low, high)
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
        assert!((found[0].from_mm + 0.97).abs() < 6e-3 && (found[0].to_mm - 1.03).abs() < 6e-3, "{found:?}");
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
