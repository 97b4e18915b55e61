//! What points of a flank feel of the contact at one position.
//!
//! The pressure lives on the nodes of one of the two flanks, and between them it is a parabola on each edge, whose integral is
//! the load of the edge's multipliers. A point of that flank reads it where it is; a point of the mate reads it where it faces
//! that flank. Both slide on each other at
//!
//! ```text
//! ds/dξ = (1/r_b1 + 1/r_b2) |(x − C) · n|
//! ```
//!
//! with C the pitch point and n the flank's normal: on the line of action (x − C)·n = ξ − ξ_C, and outside it, where a tip
//! edge touches early, it is the true relative velocity of the bodies along the tangent.

use nalgebra::{Rotation2, Vector2};

use super::facing::Facing;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::position::CondensedPair;
use crate::fem::contact::edge::{MOST_NODES, interpolate, shape};
use crate::fem::contact::surface::{Surface, SurfaceEdge};
use crate::gear::{Gear, PerGear};

/// Consecutive points of one flank, from root to tip, and how each reads the pressure.
#[derive(Debug, Clone, Default)]
pub struct ObservedFlank {
    /// Number of the first of them on the flank.
    pub first_point: usize,
    /// For each point: rows of the position's multipliers and their weights; weight 0 where there is none.
    pressure: Vec<[(usize, f64); MOST_NODES]>,
    /// (x − C)·n of each point at the position, mm; NaN where it faces nothing.
    lever_mm: Vec<f64>,
}

/// Where a point lies on a surface.
#[derive(Debug, Clone, Copy)]
struct Place {
    edge: usize,
    xi: f64,
}

impl ObservedFlank {
    /// Pressure of each point under the forces of the position's multipliers, MPa.
    pub fn pressure_mpa<'a>(&'a self, nodal_mpa: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let at = |weights: &[(usize, f64); MOST_NODES]| -> f64 {
            let sum: f64 = weights.iter().map(|&(row, weight)| weight * nodal_mpa[row]).sum();
            sum.max(0.0)
        };
        self.pressure.iter().map(at)
    }

    /// How far each point slides while the theoretical contact point passes `length_mm` around the position, mm: the mean of
    /// |(x − C)·n| over the stretch, on which it changes as ξ does.
    pub fn sliding_mm(&self, curvature_sum_per_mm: f64, length_mm: f64) -> Vec<f64> {
        let half = 0.5 * length_mm;
        let mean =
            |lever: f64| if lever.abs() >= half { lever.abs() } else { (lever * lever + half * half) / length_mm };
        let slid = |&lever: &f64| if lever.is_nan() { 0.0 } else { curvature_sum_per_mm * length_mm * mean(lever) };
        self.lever_mm.iter().map(slid).collect()
    }
}

impl CondensedPair<'_> {
    /// How the points of both flanks at `radius_mm` (increasing) read the pressure of a tooth pair at `position_mm`.
    pub(super) fn observed(
        &self,
        position_mm: f64,
        facing: &Facing,
        radius_mm: PerGear<&[f64]>,
    ) -> PerGear<ObservedFlank> {
        PerGear::from_fn(|gear| self.observed_flank(position_mm, facing, gear, radius_mm[gear]))
    }

    fn observed_flank(&self, position_mm: f64, facing: &Facing, gear: Gear, radius_mm: &[f64]) -> ObservedFlank {
        let slave = facing.slave;
        let (own, on) = (&self.flanks[gear].surface, &self.flanks[slave].surface);
        let own_edges = &own.edges[facing.edges[gear].clone()];
        // Edges run from tip to root: radii fall along them.
        let radius_at = |node: usize| own.points_mm[node].norm();
        let (Some(first), Some(last)) = (own_edges.first(), own_edges.last()) else { return ObservedFlank::default() };
        let (highest, lowest) = (radius_at(first.nodes()[0]), radius_at(last.nodes()[1]));
        let round_off = 1e-9 * highest;
        let first_point = radius_mm.partition_point(|&r| r < lowest - round_off);
        let end = radius_mm.partition_point(|&r| r <= highest + round_off);
        let row_of = facing.rows_of_nodes(on.points_mm.len());
        let angle = |g| tooth_angle_rad(self.pair, g, position_mm, facing.pair);
        let pitch_point = Vector2::new(0.0, self.pair.working_pitch_radius_mm(Gear::Pinion));
        let mut observed = ObservedFlank { first_point, ..ObservedFlank::default() };
        for &radius in &radius_mm[first_point..end.max(first_point)] {
            let own_place = place_at_radius(own, facing.edges[gear].clone(), radius);
            let point = point_at(own, own_place);
            let in_place = in_place_mm(self.pair, gear, position_mm, facing.pair, point);
            let place = if gear == slave {
                Some(own_place)
            } else {
                let in_slave = Rotation2::new(-angle(slave)) * (in_place - axis_mm(self.pair, slave));
                place_facing(on, facing.edges[slave].clone(), in_slave)
            };
            let Some(place) = place else {
                observed.pressure.push([(0, 0.0); MOST_NODES]);
                observed.lever_mm.push(f64::NAN);
                continue;
            };
            let edge = &on.edges[place.edge];
            let weights = shape(edge.nodes().len(), place.xi);
            let mut read = [(0, 0.0); MOST_NODES];
            for ((entry, weight), &node) in read.iter_mut().zip(weights).zip(edge.nodes()) {
                if let Some(row) = row_of[node] {
                    *entry = (row, weight);
                }
            }
            observed.pressure.push(read);
            let (normal, _) = on.normal_and_derivative(edge, place.xi);
            let normal = Rotation2::new(angle(slave)) * normal.normalize();
            observed.lever_mm.push((in_place - pitch_point).dot(&normal));
        }
        observed
    }
}

fn point_at(surface: &Surface, place: Place) -> Vector2<f64> {
    let edge = &surface.edges[place.edge];
    let corners = surface.corners(edge);
    let count = edge.nodes().len();
    interpolate(&shape(count, place.xi), &corners[..count])
}

/// Where a flank has the distance `radius_mm` from the gear's axis, among `edges`.
fn place_at_radius(surface: &Surface, edges: std::ops::Range<usize>, radius_mm: f64) -> Place {
    let radius = |node: usize| surface.points_mm[node].norm();
    let ends = |edge: &SurfaceEdge| [radius(edge.nodes()[0]), radius(edge.nodes()[1])];
    let within = &surface.edges[edges.clone()];
    let number = within.partition_point(|edge| ends(edge)[1] > radius_mm).min(within.len() - 1);
    let edge = &within[number];
    let [high, low] = ends(edge);
    let middle = edge.nodes().get(2).map_or(0.5 * (high + low), |&node| radius(node));
    // In straight lines between the ends and the middle: off by far less than a node's distance.
    let xi = if radius_mm >= middle {
        -(radius_mm - middle) / (high - middle)
    } else {
        (middle - radius_mm) / (middle - low)
    };
    Place { edge: edges.start + number, xi: xi.clamp(-1.0, 1.0) }
}

/// The place of `edges` that a point near the surface faces; none beyond their ends.
fn place_facing(surface: &Surface, edges: std::ops::Range<usize>, point: Vector2<f64>) -> Option<Place> {
    // Beyond an end of the stretch by more than round-off of a foot point a point faces nothing.
    const BEYOND: f64 = 1e-6;
    let mut nearest: Option<(f64, Place)> = None;
    for number in edges {
        let [from, to, _] = surface.corners(&surface.edges[number]);
        let chord = to - from;
        let t = (point - from).dot(&chord) / chord.norm_squared();
        if !(-BEYOND..=1.0 + BEYOND).contains(&t) {
            continue;
        }
        let distance = (point - from - t * chord).norm();
        if nearest.is_none_or(|(least, _)| distance < least) {
            nearest = Some((distance, Place { edge: number, xi: (2.0 * t - 1.0).clamp(-1.0, 1.0) }));
        }
    }
    nearest.map(|(_, place)| place)
}
