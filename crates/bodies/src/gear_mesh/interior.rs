//! Triangulation inside a closed boundary, whose edges are kept.
//!
//! Points are packed by an advancing front from the boundary inwards, shortest lengths first: every point offers six places around
//! itself, a wanted edge length away, and a place is taken where no point is nearer than a fraction of that length. Where
//! boundary edges are even, triangles are nearly equilateral. The points are joined by the constrained Delaunay
//! triangulation, gaps are filled at the centres of circumcircles that are too large, and points are moved to the mean
//! of their neighbours where that improves the worst triangle around them. The order is fixed: the same
//! boundary gives the same triangles, bit for bit.
//!
//! Sources: J. R. Shewchuk, *Delaunay refinement algorithms for triangular mesh generation*, Computational Geometry 22
//! (2002); L. A. Freitag, *On combining Laplacian and optimization-based mesh smoothing techniques* (1997).

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::f64::consts::FRAC_PI_3;

use nalgebra::{Rotation2, Vector2};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::boundary_circles::{BoundaryCircle, circles};
use super::{ToothMeshError, neighbours::Neighbours, size_field::SizeField};

/// Places per unit that points of the boundary are rounded to: 2³².
const PLACES: f64 = 4_294_967_296.0;
/// Least distance of packed points over the wanted length.
const NEAREST: f64 = 0.75;
/// Least distance of a packed point from an edge of the boundary over the wanted length: a little below the height of an equilateral triangle.
const NEAREST_TO_EDGE: f64 = 0.6;
/// Circumradius over wanted length beyond which a gap is filled; 1/√3 in an equilateral triangle.
const GAP: f64 = 0.8;
/// Rounds of filling gaps, triangulating and moving points.
const ROUNDS: usize = 5;
/// Sweeps of moving points in each round.
const SWEEPS: usize = 2;
/// Quality above which a triangle may become worse when a point moves.
const GOOD: f64 = 0.9;

/// Triangles inside a boundary.
#[derive(Debug)]
pub(super) struct Filling {
    /// Points of the boundary, then the new ones.
    pub points_mm: Vec<Vector2<f64>>,
    /// Corners, anticlockwise.
    pub triangles: Vec<[usize; 3]>,
}

/// Fills the closed boundary through `ring`, anticlockwise, with lengths up to `greatest_mm`.
pub(super) fn fill(ring: &[Vector2<f64>], growth: f64, greatest_mm: f64) -> Result<Filling, ToothMeshError> {
    // In units of the greatest length and without the last digits, so that ties are broken alike in any system of units.
    let dimensionless: Vec<Vector2<f64>> =
        ring.iter().map(|point| point.map(|x| (x / greatest_mm * PLACES).round() / PLACES)).collect();
    let mut filling = fill_dimensionless(&dimensionless, growth).map_err(|error| match error {
        ToothMeshError::CrossedOutline { at_mm: at } => {
            ToothMeshError::CrossedOutline { at_mm: at.map(|x| x * greatest_mm) }
        }
        other => other,
    })?;
    for (point, given) in filling.points_mm.iter_mut().zip(ring.iter().map(Some).chain(std::iter::repeat(None))) {
        *point = given.copied().unwrap_or(*point * greatest_mm);
    }
    Ok(filling)
}

fn fill_dimensionless(ring: &[Vector2<f64>], growth: f64) -> Result<Filling, ToothMeshError> {
    let boundary = Boundary { ring, circles: circles(ring), field: SizeField::of_boundary(ring, growth, 1.0) };
    let mut points_mm = boundary.pack();
    let mut triangles = boundary.triangulate(&points_mm)?;
    for round in 0..ROUNDS {
        if round < ROUNDS / 2 {
            boundary.fill_gaps(&mut points_mm, &triangles);
            triangles = boundary.triangulate(&points_mm)?;
        }
        boundary.smooth(&mut points_mm, &triangles);
        triangles = boundary.triangulate(&points_mm)?;
    }
    boundary.smooth(&mut points_mm, &triangles);
    Ok(Filling { points_mm, triangles })
}

/// Point of the advancing front, ordered by length, then by age.
#[derive(Debug, PartialEq)]
struct Front {
    length_mm: f64,
    number: usize,
    /// Point that offered the place.
    from: Vector2<f64>,
}

impl Eq for Front {}

impl PartialOrd for Front {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Front {
    fn cmp(&self, other: &Self) -> Ordering {
        self.length_mm.total_cmp(&other.length_mm).then(self.number.cmp(&other.number))
    }
}

struct Boundary<'a> {
    ring: &'a [Vector2<f64>],
    circles: Vec<BoundaryCircle>,
    field: SizeField,
}

impl Boundary<'_> {
    fn edge(&self, k: usize) -> [Vector2<f64>; 2] {
        [self.ring[k], self.ring[(k + 1) % self.ring.len()]]
    }

    fn edge_length(&self, k: usize) -> f64 {
        let [a, b] = self.edge(k);
        (b - a).norm()
    }

    /// Error for an outline that crosses itself at point `k` of the boundary.
    fn crossed(&self, k: usize) -> ToothMeshError {
        ToothMeshError::CrossedOutline { at_mm: self.ring[k % self.ring.len()].into() }
    }

    /// Whether `point` lies inside, at least `distance_mm` from every edge.
    fn holds(&self, point: Vector2<f64>, distance_mm: f64) -> bool {
        let least = distance_mm * distance_mm;
        let mut inside = false;
        for circle in &self.circles {
            let away = circle.distance(point);
            for k in circle.nodes.clone() {
                let [a, b] = self.edge(k);
                let (along, to) = (b - a, point - a);
                // With a reserve for rounding errors.
                if away <= 1.001 * distance_mm {
                    let t = (to.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                    if (to - t * along).norm_squared() < least {
                        return false;
                    }
                }
                if (a.y > point.y) != (b.y > point.y) && to.x < along.x * (to.y / along.y) {
                    inside = !inside;
                }
            }
        }
        inside
    }

    /// Points of the boundary and those packed inside.
    fn pack(&self) -> Vec<Vector2<f64>> {
        let mut packing = Packing {
            boundary: self,
            points_mm: self.ring.to_vec(),
            taken: Neighbours::default(),
            front: BinaryHeap::new(),
        };
        for &point in self.ring {
            packing.taken.add(point, self.field.at_mm(point));
        }
        let mut edges: Vec<usize> = (0..self.ring.len()).collect();
        edges.sort_by(|a, b| self.edge_length(*a).total_cmp(&self.edge_length(*b)).then(a.cmp(b)));
        for k in edges {
            let [a, b] = self.edge(k);
            let inward = Vector2::new(a.y - b.y, b.x - a.x).normalize();
            let guess = self.field.at_mm(0.5 * (a + b));
            packing.offer(0.5 * (a + b) + 0.75f64.sqrt() * guess * inward, a);
        }
        while let Some(Reverse(front)) = packing.front.pop() {
            let at = packing.points_mm[front.number];
            let back = (front.from - at).normalize();
            for sixth in 0..6 {
                let direction = Rotation2::new(f64::from(sixth) * FRAC_PI_3) * back;
                // Mean of the wanted lengths at both ends, to first order.
                let near = at + front.length_mm * direction;
                let distance = 0.5 * (front.length_mm + self.field.at_mm(near));
                packing.offer(at + distance * direction, at);
            }
        }
        packing.points_mm
    }

    /// Triangles of the constrained Delaunay triangulation that lie inside.
    fn triangulate(&self, points_mm: &[Vector2<f64>]) -> Result<Vec<[usize; 3]>, ToothMeshError> {
        let vertices = points_mm.iter().map(|p| Point2::new(p.x, p.y)).collect();
        let n = self.ring.len();
        let edges = (0..n).map(|k| [k, (k + 1) % n]).collect();
        let mut conflict = None;
        let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(vertices, edges, |edge| {
            conflict = conflict.or(Some(edge[0]));
        })
        .map_err(|_| self.crossed(0))?;
        if let Some(k) = conflict {
            return Err(self.crossed(k));
        }
        if cdt.num_vertices() != points_mm.len() {
            // Coinciding points: the outline touches itself.
            let twin = (0..n).find(|&k| self.ring[..k].contains(&self.ring[k])).unwrap_or(0);
            return Err(self.crossed(twin));
        }
        // Flood fill from the left of the boundary edges, where the body is.
        let mut inside = vec![false; cdt.num_all_faces()];
        let mut pending = Vec::new();
        for k in 0..n {
            let ends = [k, (k + 1) % n].map(FixedVertexHandle::from_index);
            let edge = cdt.get_edge_from_neighbors(ends[0], ends[1]).ok_or_else(|| self.crossed(k))?;
            pending.extend(edge.face().as_inner());
        }
        while let Some(face) = pending.pop() {
            if !std::mem::replace(&mut inside[face.index()], true) {
                let open = face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge());
                pending.extend(open.filter_map(|edge| edge.rev().face().as_inner()));
            }
        }
        let inner = cdt.inner_faces().filter(|face| inside[face.index()]);
        Ok(inner.map(|face| face.vertices().map(|vertex| vertex.index())).collect())
    }

    /// Adds points at the centres of circumcircles that are too large.
    fn fill_gaps(&self, points_mm: &mut Vec<Vector2<f64>>, triangles: &[[usize; 3]]) {
        let mut taken = Neighbours::default();
        for &point in points_mm.iter() {
            taken.add(point, self.field.at_mm(point));
        }
        for triangle in triangles {
            let [a, b, c] = triangle.map(|k| points_mm[k]);
            let Some((centre, radius)) = circumcircle(a, b, c) else { continue };
            let length_mm = self.field.at_mm(centre);
            if radius > GAP * length_mm
                && !taken.crowds(centre, length_mm, 0.9 * NEAREST)
                && self.holds(centre, 0.8 * NEAREST_TO_EDGE * length_mm)
            {
                taken.add(centre, length_mm);
                points_mm.push(centre);
            }
        }
    }

    /// Moves inner points to the mean of their neighbours where that improves the worst triangle around them.
    fn smooth(&self, points_mm: &mut [Vector2<f64>], triangles: &[[usize; 3]]) {
        let around = Around::of(points_mm.len(), triangles);
        for _ in 0..SWEEPS {
            for point in self.ring.len()..points_mm.len() {
                let star = around.triangles(point);
                if star.is_empty() {
                    continue;
                }
                let (old, before) = (points_mm[point], worst_quality(star, triangles, points_mm));
                // Every neighbour is a corner of two triangles of the star.
                let sum = star.iter().flat_map(|&t| triangles[t]).filter(|&k| k != point);
                let sum: Vector2<f64> = sum.map(|k| points_mm[k]).sum();
                points_mm[point] = sum / (2 * star.len()) as f64;
                if worst_quality(star, triangles, points_mm) < before.min(GOOD) {
                    points_mm[point] = old;
                }
            }
        }
    }
}

/// Points packed so far.
struct Packing<'a> {
    boundary: &'a Boundary<'a>,
    points_mm: Vec<Vector2<f64>>,
    taken: Neighbours,
    front: BinaryHeap<Reverse<Front>>,
}

impl Packing<'_> {
    /// Adds `place`, offered by the point at `from`, where there is room.
    fn offer(&mut self, place: Vector2<f64>, from: Vector2<f64>) {
        let length_mm = self.boundary.field.at_mm(place);
        if self.taken.crowds(place, length_mm, NEAREST) || !self.boundary.holds(place, NEAREST_TO_EDGE * length_mm) {
            return;
        }
        self.taken.add(place, length_mm);
        self.front.push(Reverse(Front { length_mm, number: self.points_mm.len(), from }));
        self.points_mm.push(place);
    }
}

/// The triangles around every point.
struct Around {
    starts: Vec<usize>,
    triangles: Vec<usize>,
}

impl Around {
    fn of(points: usize, triangles: &[[usize; 3]]) -> Self {
        let mut starts = vec![0; points + 1];
        for corner in triangles.iter().flatten() {
            starts[corner + 1] += 1;
        }
        for k in 0..points {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut around = vec![0; 3 * triangles.len()];
        for (t, corners) in triangles.iter().enumerate() {
            for &corner in corners {
                around[next[corner]] = t;
                next[corner] += 1;
            }
        }
        Self { starts, triangles: around }
    }

    fn triangles(&self, point: usize) -> &[usize] {
        &self.triangles[self.starts[point]..self.starts[point + 1]]
    }
}

/// Least quality of the triangles numbered in `star`.
fn worst_quality(star: &[usize], triangles: &[[usize; 3]], points: &[Vector2<f64>]) -> f64 {
    star.iter().map(|&t| quality(triangles[t].map(|k| points[k]))).fold(f64::INFINITY, f64::min)
}

/// Quality of a triangle, 4√3 area / Σ length²: 1 for the equilateral triangle, 0 for a flat one, negative for an inverted one.
fn quality([a, b, c]: [Vector2<f64>; 3]) -> f64 {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let lengths = ab.norm_squared() + bc.norm_squared() + ca.norm_squared();
    2.0 * 3f64.sqrt() * ab.perp(&(c - a)) / lengths
}

/// Centre and radius of the circumcircle; `None` for a flat triangle.
fn circumcircle(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>) -> Option<(Vector2<f64>, f64)> {
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.perp(&v);
    let (uu, vv) = (u.norm_squared(), v.norm_squared());
    let to_centre = Vector2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / twice;
    to_centre.iter().all(|x| x.is_finite()).then(|| (a + to_centre, to_centre.norm()))
}
