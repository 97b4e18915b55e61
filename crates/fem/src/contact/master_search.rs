//! Search for the parts of a slave edge that face each master edge.
//!
//! A slave point x_s(ξ) is projected onto the master along the slave's normal field n(ξ). The end p of a master edge is the projection of
//! the point of the slave edge where
//!
//! ```text
//! (x_s(ξ) − p) × n(ξ) = 0
//! ```
//!
//! and the slave edge faces the master edge between these points of its two ends. The left-hand side falls with ξ as
//! long as normals do not cross between the surfaces, so its signs at the ends of the slave edge show without iteration
//! whether such a point lies on the edge. On a master edge the point that is met is the root of a polynomial of second degree.

use nalgebra::Vector2;
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::surface::{Surface, SurfaceEdge};

/// Least cosine between a normal and the opposite of the other for surfaces that face each other.
pub const LEAST_FACING: f64 = 0.1;
/// Least length in ξ, and least norm of a normal.
const PARALLEL: f64 = 1e-12;

/// Stretch of a slave edge that faces one master edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacingSegment {
    /// Number of the slave edge.
    pub slave: usize,
    /// Beginning ξ on the slave edge.
    pub from: f64,
    /// End ξ on the slave edge.
    pub to: f64,
    /// Number of the master edge.
    pub master: usize,
}

/// Point of a slave edge, and the unit normal there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlavePoint {
    pub point_mm: Vector2<f64>,
    pub normal: Vector2<f64>,
}

/// Projection of a slave point onto a master edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Meeting {
    /// Coordinate η on the master edge.
    pub eta: f64,
    /// Gap n · (x_m − x_s), mm, negative where the surfaces penetrate.
    pub gap_mm: f64,
}

/// Edges of a master surface with a bounding volume hierarchy.
pub(crate) struct MasterSearch<'a> {
    /// Master surface.
    pub master: &'a Surface,
    boxes: Bvh,
}

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

fn aabb((low, high): (Vector2<f64>, Vector2<f64>)) -> Aabb {
    Aabb::new(Vector::new(low.x, low.y), Vector::new(high.x, high.y))
}

/// Root between −1 and 1 of a function that falls from the positive value `first` to the negative one `last`, by Newton's method with
/// bisection from where a straight line has it; `f` gives value and derivative.
fn falling_root(f: impl Fn(f64) -> (f64, f64), [first, last]: [f64; 2]) -> f64 {
    let (mut low, mut high, mut xi) = (-1.0, 1.0, (first + last) / (first - last));
    for _ in 0..60 {
        let (value, slope) = f(xi);
        if value > 0.0 {
            low = xi;
        } else {
            high = xi;
        }
        let newton = xi - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let step = next - xi;
        xi = next;
        if step.abs() < 1e-14 {
            break;
        }
    }
    xi
}

impl<'a> MasterSearch<'a> {
    /// Search among the edges of `master`.
    pub(crate) fn new(master: &'a Surface) -> Self {
        let boxes: Vec<Aabb> = master.edges.iter().map(|edge| aabb(master.edge_box(edge))).collect();
        Self { master, boxes: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
    }

    /// Stretches of slave edge `number` that face the master within `reach_mm` on either side, by increasing ξ and
    /// without overlap: of several master edges the nearest is taken.
    pub(crate) fn segments(&self, slave: &Surface, number: usize, reach_mm: f64) -> Vec<FacingSegment> {
        let edge = &slave.edges[number];
        let mut found: Vec<(f64, FacingSegment)> = self
            .boxes
            .intersect_aabb(&aabb(swept_box(slave, edge, reach_mm)))
            .filter_map(|master| self.segment(slave, edge, number, master as usize, reach_mm))
            .collect();
        // The result does not depend on the order of the tree.
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.master.cmp(&b.1.master)));
        let mut taken: Vec<FacingSegment> = Vec::with_capacity(found.len());
        for (_, segment) in found {
            taken.extend(what_is_free(&taken, segment));
        }
        taken.sort_by(|a, b| a.from.total_cmp(&b.from));
        taken
    }

    fn segment(
        &self,
        slave: &Surface,
        edge: &SurfaceEdge,
        number: usize,
        master: usize,
        reach_mm: f64,
    ) -> Option<(f64, FacingSegment)> {
        let ends = &self.master.edges[master].nodes()[..2];
        let [a, b] = [ends[0], ends[1]].map(|node| project_onto_slave(slave, edge, self.master.points_mm[node]));
        let (from, to) = (a.min(b), a.max(b));
        if to - from < PARALLEL {
            return None;
        }
        let middle = SlavePoint::new(slave, edge, 0.5 * (from + to))?;
        let meeting = self.meet(middle, master)?;
        (meeting.gap_mm.abs() <= reach_mm)
            .then_some((meeting.gap_mm.abs(), FacingSegment { slave: number, from, to, master }))
    }

    /// Projection along the normal of a slave point onto a master edge; `None` where that faces away.
    pub(crate) fn meet(&self, SlavePoint { point_mm, normal }: SlavePoint, master: usize) -> Option<Meeting> {
        let edge = &self.master.edges[master];
        // The offset to the right of the normal rises along the master, which runs the other way; its opposite falls.
        let offset = |node: usize| -cross(self.master.points_mm[node] - point_mm, normal);
        let eta = falling_polynomial_root(edge.nodes().iter().map(|&node| offset(node)));
        let (place, tangent) = self.master.point_and_tangent(edge, eta);
        let facing = -super::edge::outward(tangent).dot(&normal) / tangent.norm();
        (facing > LEAST_FACING).then(|| Meeting { eta, gap_mm: (place - point_mm).dot(&normal) })
    }
}

impl SlavePoint {
    /// Point at ξ of an edge; `None` where that has no normal.
    pub(crate) fn new(slave: &Surface, edge: &SurfaceEdge, xi: f64) -> Option<Self> {
        let (normal, _) = slave.normal_and_derivative(edge, xi);
        let (point_mm, _) = slave.point_and_tangent(edge, xi);
        normal.try_normalize(PARALLEL).map(|normal| Self { point_mm, normal })
    }
}

/// The nearer end where a falling function has no root between −1 and 1, by its values there.
fn end_without_root([first, last]: [f64; 2]) -> Option<f64> {
    if first <= 0.0 {
        Some(-1.0)
    } else if last >= 0.0 {
        Some(1.0)
    } else {
        None
    }
}

/// Root between −1 and 1, or the nearer end, of a falling polynomial of first or second degree, by its values at −1, 1 and, of the second, 0.
fn falling_polynomial_root(mut values: impl Iterator<Item = f64>) -> f64 {
    let [first, last] = [values.next(), values.next()].map(|value| value.expect("an edge has two ends"));
    end_without_root([first, last]).unwrap_or_else(|| {
        let mean = first.midpoint(last);
        let (slope, middle) = (last.midpoint(-first), values.next().unwrap_or(mean));
        // The root where it falls, in the form without cancellation: c + b η + a η² = 0 with b < 0.
        2.0 * middle / ((slope * slope - 4.0 * (mean - middle) * middle).max(0.0).sqrt() - slope)
    })
}

/// Coordinate ξ on the slave edge, from −1 to 1, whose normal passes nearest to `point`.
fn project_onto_slave(slave: &Surface, edge: &SurfaceEdge, point: Vector2<f64>) -> f64 {
    let at_node = |node: usize| cross(slave.points_mm[node] - point, slave.normals[node]);
    let ends = [edge.nodes()[0], edge.nodes()[1]].map(at_node);
    end_without_root(ends).unwrap_or_else(|| {
        let offset = |xi: f64| {
            let (place, tangent) = slave.point_and_tangent(edge, xi);
            let (normal, normal_slope) = slave.normal_and_derivative(edge, xi);
            (cross(place - point, normal), cross(tangent, normal) + cross(place - point, normal_slope))
        };
        falling_root(offset, ends)
    })
}

/// Box that an edge sweeps when moved by `reach_mm` along its normals, both ways.
fn swept_box(slave: &Surface, edge: &SurfaceEdge, reach_mm: f64) -> (Vector2<f64>, Vector2<f64>) {
    let (mut low, mut high) = slave.edge_box(edge);
    for &node in edge.nodes() {
        for reach in [-reach_mm, reach_mm] {
            let point = slave.points_mm[node] + reach * slave.normals[node];
            low = low.inf(&point);
            high = high.sup(&point);
        }
    }
    (low, high)
}

/// Parts of a segment outside `taken` ones.
fn what_is_free(taken: &[FacingSegment], segment: FacingSegment) -> Vec<FacingSegment> {
    let mut free = vec![segment];
    for other in taken {
        free = free
            .into_iter()
            .flat_map(|piece| {
                [
                    FacingSegment { to: piece.to.min(other.from), ..piece },
                    FacingSegment { from: piece.from.max(other.to), ..piece },
                ]
            })
            .filter(|piece| piece.to - piece.from > PARALLEL)
            .collect();
    }
    free
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falling_polynomials_have_one_root_or_end_before_it() {
        let root = |values: &[f64]| falling_polynomial_root(values.iter().copied());
        // 1 − 3 η, (0.3 − η)(η + 5) and (0.3 − η)(5 − η).
        let inside = [(&[4.0, -2.0][..], 1.0 / 3.0), (&[5.2, -4.2, 1.5], 0.3), (&[7.8, -2.8, 1.5], 0.3)];
        for (values, expected) in inside {
            assert!((root(values) - expected).abs() < 1e-15, "{values:?}");
        }
        assert_eq!([root(&[-1.0, -2.0]), root(&[3.0, 1.0, 2.2])], [-1.0, 1.0]);
    }
}
