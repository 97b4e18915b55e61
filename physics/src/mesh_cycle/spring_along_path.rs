//! Compliance of the teeth along the path of contact, interpolated.

use crate::stiffness::SpringParts;
use gearwear_bodies::gear::path_of_contact::PathOfContact;

/// Compliance of the teeth along the path of contact, evaluated once for all slices.
pub struct SpringAlongPath {
    start_mm: f64,
    spacing_mm: f64,
    /// Compliance at evenly spaced places.
    parts: Vec<SpringParts>,
}

impl SpringAlongPath {
    /// Compliance at places as far apart as `count` (≥ 2) from A to E, going on at least `beyond_mm` before A and after E.
    pub fn new<E>(
        path: &PathOfContact,
        count: usize,
        beyond_mm: [f64; 2],
        parts: impl FnMut(f64) -> Result<SpringParts, E>,
    ) -> Result<Self, E> {
        let spacing_mm = (path.end_mm - path.start_mm) / (count - 1) as f64;
        let [before, after] = beyond_mm.map(|beyond| (beyond / spacing_mm).ceil() as usize);
        let start_mm = path.start_mm - before as f64 * spacing_mm;
        let places = (0..before + count + after).map(|j| path.start_mm + spacing_mm * (j as f64 - before as f64));
        let parts = places.map(parts).collect::<Result<_, E>>()?;
        Ok(Self { start_mm, spacing_mm, parts })
    }

    /// Compliance with the theoretical contact point at `position_mm`; beyond the outermost places, theirs.
    pub fn at(&self, position_mm: f64) -> SpringParts {
        let last = self.parts.len() - 1;
        let place = ((position_mm - self.start_mm) / self.spacing_mm).clamp(0.0, last as f64);
        let before = (place as usize).min(last - 1);
        let weight = place - before as f64;
        let [here, next] = [self.parts[before], self.parts[before + 1]];
        let (surface, next_surface) = (here.left_by_surface_mm2_per_n, next.left_by_surface_mm2_per_n);
        SpringParts {
            teeth_mm2_per_n: here.teeth_mm2_per_n + weight * (next.teeth_mm2_per_n - here.teeth_mm2_per_n),
            left_by_surface_mm2_per_n: surface + weight * (next_surface - surface),
        }
    }
}
