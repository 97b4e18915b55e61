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
use super::flank_surface::Place;
use super::placement::{axis_mm, in_place_mm, tooth_angle_rad};
use super::position::CondensedPair;
use crate::fem::contact::edge::{interpolate, shape};
use crate::fem::contact::surface::{Surface, SurfaceEdge};
use crate::gear::Gear;

/// Consecutive points of one flank, from root to tip, and how each reads the pressure.
#[derive(Debug, Clone, Default)]
pub struct ObservedFlank {
    /// Number of the first of them on the flank.
    pub first_point: usize,
    /// Rows of the position's multipliers that points read, with their weights; one point after the other.
    reads: Vec<(usize, f64)>,
    /// Where the reads of each point end.
    ends: Vec<usize>,
    /// (x − C)·n of each point at the position, mm; NaN where it faces nothing.
    lever_mm: Vec<f64>,
}

/// Where the points of a flank are, and where its nodes are among them.
#[derive(Debug, Clone, Copy)]
pub struct FlankPoints<'a> {
    /// Radius of each point on the nominal flank, increasing, mm.
    pub radius_mm: &'a [f64],
    /// The same of each local node ([`CondensedPair::nominal_radius_mm`]).
    pub node_radius_mm: &'a [f64],
}

/// Most places at which one point's pressure is sampled within a position's stretch.
const MOST_SAMPLES: usize = 32;

impl ObservedFlank {
    /// Mean pressure of each point over the stretch for the pressures `nodal_mpa` at the position's multipliers, MPa.
    pub fn pressure_mpa<'a>(&'a self, nodal_mpa: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let reads = &self.reads[std::mem::replace(&mut start, end)..end];
            let sum: f64 = reads.iter().map(|&(row, weight)| weight * nodal_mpa[row]).sum();
            // Parabolas dip below zero beside the end of contact.
            sum.max(0.0)
        })
    }

    /// Greatest pressure that each point feels within the stretch, MPa: that of the nodes it reads.
    pub fn greatest_mpa<'a>(&'a self, nodal_mpa: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let reads = &self.reads[std::mem::replace(&mut start, end)..end];
            reads.iter().map(|&(row, _)| nodal_mpa[row]).fold(0.0, f64::max)
        })
    }

    /// How far each point slides while the theoretical contact point passes `length_mm` around the position, mm: the mean of
    /// |(x − C)·n| over the stretch, on which it changes as ξ does.
    pub fn sliding_mm(&self, relative_turn_per_mm: f64, length_mm: f64) -> Vec<f64> {
        let half = 0.5 * length_mm;
        let mean =
            |lever: f64| if lever.abs() >= half { lever.abs() } else { (lever * lever + half * half) / length_mm };
        let slid = |&lever: &f64| if lever.is_nan() { 0.0 } else { relative_turn_per_mm * length_mm * mean(lever) };
        self.lever_mm.iter().map(slid).collect()
    }

    /// Adds a point that reads `reads` evenly `samples` times.
    fn push(&mut self, mut reads: Vec<(usize, f64)>, samples: usize, lever_mm: f64) {
        reads.sort_unstable_by_key(|(row, _)| *row);
        let first = self.reads.len();
        for (row, weight) in reads {
            match self.reads[first..].last_mut() {
                Some((last, sum)) if *last == row => *sum += weight / samples as f64,
                _ => self.reads.push((row, weight / samples as f64)),
            }
        }
        self.ends.push(self.reads.len());
        self.lever_mm.push(lever_mm);
    }
}

impl CondensedPair<'_> {
    /// Radius of the nominal flank point that each local node of a gear's flank stands for, mm.
    pub fn nominal_radius_mm(&self, gear: Gear) -> Vec<f64> {
        let points = self.flanks[gear].surface.points_mm.iter();
        points.map(|&point| self.pair.teeth[gear].nominal_radius_mm(point)).collect()
    }

    /// How the points of `gear`'s flank at `points.radius_mm` read the pressure of a tooth pair at `position_mm`, which
    /// stands for `length_mm` of the path.
    pub(super) fn observed_flank(
        &self,
        position_mm: f64,
        length_mm: f64,
        facing: &Facing,
        gear: Gear,
        points: FlankPoints<'_>,
    ) -> ObservedFlank {
        let radius_mm = points.radius_mm;
        let slave = facing.slave;
        let (own, on) = (&self.flanks[gear], &self.flanks[slave]);
        let own_edges = &own.surface.edges[facing.edges[gear].clone()];
        // Edges run from tip to root: radii fall along them.
        let radius_at = |node: usize| points.node_radius_mm[node];
        let (Some(first), Some(last)) = (own_edges.first(), own_edges.last()) else { return ObservedFlank::default() };
        let (highest, lowest) = (radius_at(first.nodes()[0]), radius_at(last.nodes()[1]));
        let round_off = 1e-9 * highest;
        let first_point = radius_mm.partition_point(|&r| r < lowest - round_off);
        let end = radius_mm.partition_point(|&r| r <= highest + round_off);
        let row_of = facing.rows_of_nodes(on.surface.points_mm.len());
        let angle = |g| tooth_angle_rad(self.pair, g, position_mm, facing.pair);
        let pitch_point = Vector2::new(0.0, self.pair.working_pitch_radius_mm(Gear::Pinion));
        let moves_mm = self.contact_moves_mm(position_mm, length_mm, facing.pair, gear);
        let mut observed = ObservedFlank { first_point, ..ObservedFlank::default() };
        for &radius in &radius_mm[first_point..end.max(first_point)] {
            let own_place = place_at_radius(&own.surface, points.node_radius_mm, facing.edges[gear].clone(), radius);
            let point = point_at(&own.surface, own_place);
            let in_place = in_place_mm(self.pair, gear, position_mm, facing.pair, point);
            let place = if gear == slave {
                Some(own_place)
            } else {
                let in_slave = Rotation2::new(-angle(slave)) * (in_place - axis_mm(self.pair, slave));
                place_facing(&on.surface, facing.edges[slave].clone(), in_slave)
            };
            let Some(place) = place else {
                observed.push(Vec::new(), 1, f64::NAN);
                continue;
            };
            let edge = &on.surface.edges[place.edge];
            let (normal, _) = on.surface.normal_and_derivative(edge, place.xi);
            let normal = Rotation2::new(angle(slave)) * normal.normalize();
            let lever_mm = (in_place - pitch_point).dot(&normal);
            let samples = ((2.0 * moves_mm / on.node_distance_mm(place.edge)).ceil() as usize).clamp(1, MOST_SAMPLES);
            let here = on.from_tip_of_mm(place);
            let mut reads = Vec::new();
            for k in 0..samples {
                let along = here + moves_mm * ((k as f64 + 0.5) / samples as f64 - 0.5);
                let Some(place) = on.place_from_tip(facing.edges[slave].clone(), along) else { continue };
                let nodes = on.surface.edges[place.edge].nodes();
                for (weight, &node) in shape(nodes.len(), place.xi).into_iter().zip(nodes) {
                    reads.extend(row_of[node].map(|row| (row, weight)));
                }
            }
            observed.push(reads, samples, lever_mm);
        }
        observed
    }

    /// How far the contact of a tooth pair moves along `gear`'s flank while the theoretical contact point passes `length_mm`
    /// around `position_mm`, mm.
    fn contact_moves_mm(&self, position_mm: f64, length_mm: f64, pair: i32, gear: Gear) -> f64 {
        let path = &self.pair.path;
        let involute = path.involute[gear];
        let arc = |position_mm: f64| {
            let own_mm = position_mm + f64::from(pair) * path.base_pitch_mm;
            let (at_tip, at_mates_tip) = match gear {
                Gear::Pinion => (own_mm > path.end_mm, own_mm < path.start_mm),
                Gear::Wheel => (own_mm < path.start_mm, own_mm > path.end_mm),
            };
            if at_tip {
                involute.arc_mm(self.pair.teeth[gear].tip_rho_mm())
            } else if at_mates_tip {
                involute.arc_mm(self.rho_at_mates_tip_mm(gear, position_mm, pair))
            } else {
                involute.arc_mm(path.rho_mm(gear, own_mm))
            }
        };
        (arc(position_mm + 0.5 * length_mm) - arc(position_mm - 0.5 * length_mm)).abs()
    }
}

fn point_at(surface: &Surface, place: Place) -> Vector2<f64> {
    let edge = &surface.edges[place.edge];
    let corners = surface.corners(edge);
    let count = edge.nodes().len();
    interpolate(&shape(count, place.xi), &corners[..count])
}

/// Where among `edges` the nodes' radii `node_radius_mm` pass `radius_mm`.
fn place_at_radius(surface: &Surface, node_radius_mm: &[f64], edges: std::ops::Range<usize>, radius_mm: f64) -> Place {
    let radius = |node: usize| node_radius_mm[node];
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
