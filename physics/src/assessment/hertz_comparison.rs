//! Hertz's line contact to compare a contact with: of the same force, and of the curvature of the two surfaces, fitted to
//! their nodes around the contact.
//!
//! In the frame of the contact (s along the surface, h along the resultant, both from the middle of the contact) a circle
//! or a straight line is
//!
//! ```text
//! h = γ + β s + ½ κ' (s² + h²)          curvature κ = κ' / √(1 + β² − 2 γ κ')
//! ```
//!
//! which is linear in γ, β, κ': least squares recover a circle from its nodes exactly, whatever part of it they cover.
//! A body of revolution touches on its axis in a circle: Hertz's point contact of a load F and a relative radius R,
//!
//! ```text
//! a = (¾ F R/E*)^⅓        p₀ = 3 F/(2π a²)        K. L. Johnson, Contact Mechanics (1985), section 4.2
//! ```
//!
//! Surfaces that are not round are left out, and so are contacts that end at a corner, where Hertz does not apply.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Vector2};

use crate::results::fem_problem::HertzSummary;
use gearwear_bodies::reference::hertz_line::HertzLine;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::problem::{ContactPair, Edge, Problem};

/// Half-widths on either side over which surfaces must be round.
const REACH: f64 = 2.0;
/// Deviation from the fitted arc, relative to its height over that reach, up to which a surface is round.
const ROUND: f64 = 0.02;

/// Place, size and load of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPatch {
    /// The middle of the contact, mm.
    pub centre_mm: Vector2<f64>,
    /// Half-width a, mm.
    pub half_width_mm: f64,
    /// Resultant on the slave, N/mm.
    pub force_n_per_mm: Vector2<f64>,
    /// Whether the model holds one half of it.
    pub half_model: bool,
}

/// An arc fitted to nodes of a surface.
struct Arc {
    curvature_per_mm: f64,
    slope: f64,
    /// Root mean square deviation, mm.
    deviation_mm: f64,
}

/// Hertz's contact of the same force and curvature, where there is one.
pub fn hertz(problem: &Problem, pair: &ContactPair, patch: ContactPatch) -> Option<HertzSummary> {
    let force = patch.force_n_per_mm.norm();
    if !(patch.half_width_mm > 0.0 && force > 0.0) {
        return None;
    }
    let slave = arc(problem, &pair.slave, patch)?;
    let master = arc(problem, &pair.master, patch)?;
    // Heights count along the force on the slave, into the slave: a round slave rises, a round master falls.
    let curvature_per_mm = slave.curvature_per_mm - master.curvature_per_mm;
    let reach_mm = REACH * patch.half_width_mm;
    let height_mm = 0.5 * curvature_per_mm * reach_mm * reach_mm;
    let round = slave.deviation_mm.max(master.deviation_mm) <= ROUND * height_mm;
    if !round {
        return None;
    }
    let modulus_mpa = contact_modulus_mpa(problem, pair, patch)?;
    if problem.analysis == Analysis::Axisymmetric {
        let relative_radius_mm = 1.0 / curvature_per_mm;
        let half_width_mm = (0.75 * force * relative_radius_mm / modulus_mpa).cbrt();
        let peak_pressure_mpa = 1.5 * force / (PI * half_width_mm * half_width_mm);
        let on_axis = patch.centre_mm.x == 0.0;
        return on_axis.then_some(HertzSummary {
            relative_radius_mm,
            half_width_mm,
            peak_pressure_MPa: peak_pressure_mpa,
        });
    }
    // The resultant of one half leans towards the other; their sum stands on the surface.
    let whole = if patch.half_model { 2.0 / (1.0 + slave.slope * slave.slope).sqrt() } else { 1.0 };
    let hertz = HertzLine::of_relative_radius(1.0 / curvature_per_mm, modulus_mpa);
    let contact = hertz.loaded(whole * force);
    Some(HertzSummary {
        relative_radius_mm: hertz.relative_radius_mm(),
        half_width_mm: contact.half_width_mm,
        peak_pressure_MPa: contact.peak_pressure_mpa,
    })
}

/// The arc through the nodes of the edges within reach of the contact; `None` where they are no arc.
fn arc(problem: &Problem, edges: &[Edge], patch: ContactPatch) -> Option<Arc> {
    let h_axis = patch.force_n_per_mm.normalize();
    let s_axis = Vector2::new(h_axis.y, -h_axis.x);
    let reach_mm = REACH * patch.half_width_mm;
    let local = |node: u32| {
        let from_centre = (problem.solid.points_mm[node as usize] - patch.centre_mm) / reach_mm;
        Vector2::new(from_centre.dot(&s_axis), from_centre.dot(&h_axis))
    };
    let within = |edge: &&Edge| {
        let [a, b] = edge.ends.map(local);
        let overlaps = a.x.min(b.x) <= 1.0 && a.x.max(b.x) >= -1.0;
        overlaps && a.y.abs().min(b.y.abs()) <= 1.0
    };
    let mut nodes: Vec<u32> =
        edges.iter().filter(within).flat_map(|edge| edge.ends.into_iter().chain(edge.middle)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let points: Vec<Vector2<f64>> = nodes.into_iter().map(local).collect();
    let columns = if points.len() > 3 { 3 } else { 2 };
    if points.len() < 2 {
        return None;
    }
    let matrix = DMatrix::from_fn(points.len(), columns, |row, column| match column {
        0 => 1.0,
        1 => points[row].x,
        _ => 0.5 * points[row].norm_squared(),
    });
    let height = DVector::from_iterator(points.len(), points.iter().map(|p| p.y));
    let fit = matrix.clone().svd(true, true).solve(&height, 1e-12).ok()?;
    let deviation = (&matrix * &fit - &height).norm() / (points.len() as f64).sqrt();
    let (gamma, beta) = (fit[0], fit[1]);
    let kappa = if columns == 3 { fit[2] } else { 0.0 };
    let stretch = 1.0 + beta * beta - 2.0 * gamma * kappa;
    (stretch > 0.0).then(|| Arc {
        curvature_per_mm: kappa / stretch.sqrt() / reach_mm,
        slope: beta,
        deviation_mm: deviation * reach_mm,
    })
}

/// E* of the bodies behind both surfaces, MPa.
fn contact_modulus_mpa(problem: &Problem, pair: &ContactPair, patch: ContactPatch) -> Option<f64> {
    let slave = material(problem, &pair.slave, patch)?;
    let master = material(problem, &pair.master, patch)?;
    Some(problem.analysis.contact_modulus_mpa([*slave, *master]))
}

/// The material behind the edge nearest to the contact.
fn material<'a>(problem: &'a Problem, edges: &[Edge], patch: ContactPatch) -> Option<&'a Elastic> {
    let points = &problem.solid.points_mm;
    let distance = |edge: &&Edge| {
        edge.ends.iter().map(|&node| (points[node as usize] - patch.centre_mm).norm_squared()).sum::<f64>()
    };
    let nearest = edges.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let mut elements = problem.solid.elements.iter();
    let element = elements.find(|element| nearest.ends.iter().all(|end| element.nodes().contains(end)))?;
    problem.materials.get(usize::from(element.material))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_fem::solid::{Element, ElementKind, Solid};

    /// Points of two circles that touch in (3, 4), the slave above, from angle `from` to `to` around the contact; and one
    /// element behind an edge of each.
    fn circles(radius: [f64; 2], from: f64, to: f64) -> (Problem, ContactPair) {
        let mut points = Vec::new();
        let mut pair = ContactPair::default();
        for (edges, r) in [(&mut pair.slave, radius[0]), (&mut pair.master, -radius[1])] {
            let start = points.len() as u32;
            for i in 0..=20 {
                let angle = from + (to - from) * f64::from(i) / 20.0;
                points.push(Vector2::new(3.0 + r * angle.sin(), 4.0 + r * (1.0 - angle.cos())));
            }
            edges.extend((start..start + 20).map(|a| Edge { ends: [a, a + 1], middle: None }));
        }
        let elements = vec![
            Element::new(ElementKind::Triangle3, &[9, 10, 11], 0),
            Element::new(ElementKind::Triangle3, &[30, 31, 32], 1),
            Element::new(ElementKind::Triangle3, &[0, 1, 2], 0),
            Element::new(ElementKind::Triangle3, &[21, 22, 23], 1),
        ];
        let materials = [210e3, 70e3].map(|e| Elastic { young_modulus_mpa: e, poisson_ratio: 0.3 }).to_vec();
        let solid = Solid { points_mm: points, elements };
        (Problem { solid, materials, ..Problem::default() }, pair)
    }

    fn patch(force: [f64; 2], half_model: bool) -> ContactPatch {
        ContactPatch {
            centre_mm: Vector2::new(3.0, 4.0),
            half_width_mm: 6.0,
            force_n_per_mm: Vector2::from(force),
            half_model,
        }
    }

    /// Radii 50 and −200 mm: R = 1/(1/50 − 1/200) = 66.67 mm, from the whole arc and from one half of it alone.
    #[test]
    fn ver_circles_give_back_their_curvature() {
        for (from, to, half) in [(-0.3, 0.3, false), (0.0, 0.3, true)] {
            let (problem, pair) = circles([50.0, -200.0], from, to);
            let hertz = hertz(&problem, &pair, patch([-700.0, 35e3], half)).unwrap();
            assert!((hertz.relative_radius_mm / (200.0 / 3.0) - 1.0).abs() < 1e-9, "{hertz:?}");
        }
    }

    /// The NAFEMS cylinder, R 50 mm on a block, 35 kN/mm: 3585 MPa and 6.21 mm (NAFEMS R0094, Advanced finite element
    /// contact benchmarks, 2006, case 1, there from Hertz's formulas).
    #[test]
    fn val_nafems_cylinder_on_a_block() {
        let (problem, pair) = circles([50.0, 1e9], -0.3, 0.3);
        let flat = |node: u32| node >= 21;
        let mut problem = problem;
        for node in 0..problem.solid.points_mm.len() {
            if flat(node as u32) {
                problem.solid.points_mm[node] = Vector2::new(3.0 + (node as f64 - 31.0), 4.0);
            }
        }
        let hertz = hertz(&problem, &pair, patch([0.0, 35e3], false)).unwrap();
        assert!((hertz.peak_pressure_MPa / 3585.4 - 1.0).abs() < 1e-4, "{hertz:?}");
        assert!((hertz.half_width_mm / 6.215 - 1.0).abs() < 1e-4, "{hertz:?}");
    }

    /// A flat punch has no curvature, and a surface with a corner is no arc.
    #[test]
    fn surfaces_that_are_not_round_are_left_out() {
        let (mut problem, pair) = circles([50.0, -50.0], -0.3, 0.3);
        assert_eq!(hertz(&problem, &pair, patch([0.0, 35e3], false)), None);
        for point in &mut problem.solid.points_mm[..21] {
            point.y = 4.0 + 0.3 * (point.x - 3.0).abs();
        }
        assert_eq!(hertz(&problem, &pair, patch([0.0, 35e3], false)), None);
    }
}
