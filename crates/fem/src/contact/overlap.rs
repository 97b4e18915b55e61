//! Pointwise penetration of two surfaces in contact.
//!
//! A multiplier closes the weighted mean of the gap. At the integration points ξ_q the linearised gap
//!
//! ```text
//! g(ξ_q) = g⁰(ξ_q) + n · (u_m(η_q) − u_s(ξ_q))
//! ```
//!
//! varies around zero. The most negative value measures the error of discretisation, and falls with the
//! size of the elements.

use nalgebra::Vector2;

use super::dual_basis::gauss_points;
use super::edge::{interpolate, shape};
use super::master_search::{MasterSearch, SlavePoint};
use super::surface::Surface;

/// Surface with the displacements of its local nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moved<'a> {
    /// Surface before deformation.
    pub surface: &'a Surface,
    /// Displacement of each local node, mm.
    pub displacement_mm: &'a [Vector2<f64>],
}

impl Moved<'_> {
    fn at(&self, nodes: &[usize], xi: f64) -> Vector2<f64> {
        let mut values = [Vector2::zeros(); super::edge::MOST_NODES];
        for (value, &node) in values.iter_mut().zip(nodes) {
            *value = self.displacement_mm[node];
        }
        interpolate(&shape(nodes.len(), xi), &values[..nodes.len()])
    }
}

/// Greatest penetration of `slave` and `master` at the integration points, mm, or zero. Surfaces
/// farther apart than `reach_mm` do not face each other.
pub(crate) fn largest_overlap_mm(slave: Moved<'_>, master: Moved<'_>, reach_mm: f64) -> f64 {
    let facing = MasterSearch::new(master.surface);
    let mut largest_mm = 0.0_f64;
    for (number, edge) in slave.surface.edges.iter().enumerate() {
        for segment in facing.segments(slave.surface, number, reach_mm) {
            let mate = master.surface.edges[segment.master];
            for (xi, _) in gauss_points(segment.from, segment.to) {
                let Some(point) = SlavePoint::new(slave.surface, edge, xi) else { continue };
                let Some(meeting) = facing.meet(point, segment.master) else { continue };
                let relative = master.at(mate.nodes(), meeting.eta) - slave.at(edge.nodes(), xi);
                largest_mm = largest_mm.max(-(meeting.gap_mm + point.normal.dot(&relative)));
            }
        }
    }
    largest_mm
}
