//! A line load on one tooth of a condensed gear, and the displacement of the teeth.
//!
//! The load is Hertz's ellipse in the direction of the line of action, the inward normal of the involute at the loaded
//! point. With x = a sin θ along the flank
//!
//! ```text
//! p dx = (2w/π) cos²θ dθ        f_i = Σ_k N_i(s + a sin θ_k) (2w/π) cos²θ_k Δθ
//! ```
//!
//! and the midpoint rule in θ, which is exact for the load itself; N are the shape functions of the flank's edges, so
//! that the forces do the work of the pressure. The same shape functions give the displacement of any flank point, and
//! those of the elements that of a point inside the tooth.
//!
//! The displacement at the point inside, where the load's line crosses the tooth's centre line, is **bending** of tooth and body; its
//! difference from the displacement at the loaded point is **flattening**, which a contact surface has itself. The split is that of Weber and
//! Banaschek's closed form ([`gearwear_bodies::reference::flattening`]), so that nothing is counted twice.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use gearwear_bodies::gear::tooth::{LoadLine, Tooth};
use gearwear_bodies::gear_fem::flank_surface::MeshedFlank;
use gearwear_bodies::gear_fem::ring::{GearCompliance, ToothForce};
use gearwear_bodies::gear_fem::sector::{Answer, Functional};
use gearwear_fem::locate::locate;

/// Number of forces in place of the ellipse.
const SAMPLES: usize = 240;

/// An edge of the mesh on the flank.
struct InvoluteEdge {
    /// Arc length of the involute from the base circle at the end nearer the root, the middle and the end nearer the tip.
    arc_mm: [f64; 3],
    /// Local nodes there.
    nodes: [usize; 3],
}

/// The working flank of a condensed gear, ready to be loaded.
pub struct LoadedTooth<'a> {
    tooth: &'a Tooth,
    body: &'a GearCompliance,
    flank: &'a MeshedFlank,
    /// From root to tip, the involute part of the resolved flank.
    edges: Vec<InvoluteEdge>,
    /// Index of each local flank node among the gear's candidates.
    candidate: Vec<Option<usize>>,
}

impl<'a> LoadedTooth<'a> {
    /// The flank of a gear with teeth as `tooth`.
    pub fn new(tooth: &'a Tooth, body: &'a GearCompliance, flank: &'a MeshedFlank) -> Self {
        let candidates = &body.sector.sector.candidates;
        let candidate =
            flank.surface.mesh_nodes.iter().map(|node| candidates.iter().position(|own| own == node)).collect();
        Self { tooth, body, flank, edges: flank_edges(tooth, flank), candidate }
    }

    /// Least and greatest ρ at which an ellipse of half-width `half_width_mm` lies wholly on the resolved involute.
    pub(crate) fn limits_mm(&self, half_width_mm: f64) -> Option<(f64, f64)> {
        limits_mm(self.tooth, self.flank, half_width_mm)
    }

    /// Forces of `line_load_n_per_mm` on the tooth as an ellipse of half-width `half_width_mm` around ρ.
    pub fn ellipse(&self, rho_mm: f64, half_width_mm: f64, line_load_n_per_mm: f64) -> Option<ToothForce> {
        let (centre_mm, direction) = (self.tooth.involute.arc_mm(rho_mm), direction(&self.tooth.load_line(rho_mm)));
        let mut forces = vec![0.0; 2 * self.body.sector.sector.candidates.len()];
        let step = PI / SAMPLES as f64;
        for k in 0..SAMPLES {
            let (sin, cos) = ((k as f64 + 0.5) * step - FRAC_PI_2).sin_cos();
            let force = 2.0 * line_load_n_per_mm / PI * cos * cos * step;
            for (column, weight) in self.along(centre_mm + half_width_mm * sin, direction)? {
                forces[column] += force * weight;
            }
        }
        Some(forces.into_iter().enumerate().filter(|(_, force)| *force != 0.0).collect())
    }

    /// Displacement at ρ of tooth `p` in the direction of a load there, under `force` on tooth `q`, mm.
    pub(crate) fn surface_mm(&self, p: usize, rho_mm: f64, q: usize, force: &ToothForce) -> Option<f64> {
        let point = self.along(self.tooth.involute.arc_mm(rho_mm), direction(&self.tooth.load_line(rho_mm)))?;
        Some(self.body.displacement_along_mm(p, &point, q, force))
    }

    /// The points inside where loads at these ρ cross the tooth's centre line, with their displacements along those loads; none where that is outside
    /// the tooth.
    pub fn inside(&self, rho_mm: &[f64]) -> Vec<Option<Inside>> {
        self.inside_along(&rho_mm.iter().map(|&rho_mm| self.tooth.load_line(rho_mm)).collect::<Vec<_>>())
    }

    /// The points inside where loads along `lines` cross the centre line, with their displacements along those loads: all solved together.
    fn inside_along(&self, lines: &[LoadLine]) -> Vec<Option<Inside>> {
        let functionals: Vec<Option<Functional>> = lines.iter().map(|line| self.displacement_inside(line)).collect();
        let known: Vec<Functional> = functionals.iter().flatten().cloned().collect();
        let mut answers = self.body.sector.answers(&known).into_iter();
        let found = lines.iter().zip(functionals).map(|(line, functional)| {
            functional.and_then(|_| Some(Inside { depth_mm: line.depth_mm, answer: answers.next()? }))
        });
        found.collect()
    }

    /// Displacement of the point where `line` crosses the centre line, along it.
    fn displacement_inside(&self, line: &LoadLine) -> Option<Functional> {
        let direction = direction(line);
        let place = locate(&self.body.sector.sector.solid, Vector2::new(0.0, line.centre_line_mm))?;
        let of_node =
            |&(node, weight): &(u32, f64)| [(2 * node, weight * direction.x), (2 * node + 1, weight * direction.y)];
        Some(place.weights.iter().flat_map(of_node).collect())
    }

    /// Displacement of the point inside tooth `p`, in the direction of its load, under forces on the fine teeth, mm.
    pub fn inside_mm(&self, inside: &Inside, p: usize, forces: &[ToothForce]) -> f64 {
        let own: f64 = forces[p].iter().map(|&(column, f)| inside.answer.by_force[column] * f).sum();
        let cuts = self.body.cut_displacement_mm(p, forces);
        self.body.softness() * (own + cuts.iter().zip(&inside.answer.by_cut).map(|(u, by)| u * by).sum::<f64>())
    }

    /// Displacement over load of the points inside where lines cross the centre line, each under a concentrated load along its line at ρ,
    /// mm²/N. How a load is spread over the flank does not matter there, so that it may act on an edge; ρ counts up to where a
    /// rounding begins.
    pub fn bending_mm2_per_n(&self, loads: &[(f64, LoadLine)]) -> Vec<Option<f64>> {
        let lines: Vec<LoadLine> = loads.iter().map(|(_, line)| *line).collect();
        let inside = self.inside_along(&lines).into_iter();
        let bent = loads.iter().zip(inside).map(|((rho_mm, line), inside)| {
            let mut forces = vec![ToothForce::new(); self.teeth()];
            forces[self.middle()] = self.concentrated(*rho_mm, line)?;
            Some(self.inside_mm(&inside?, self.middle(), &forces))
        });
        bent.collect()
    }

    /// Forces of a unit load along `line` at ρ.
    fn concentrated(&self, rho_mm: f64, line: &LoadLine) -> Option<ToothForce> {
        let (first, last) = (self.edges.first()?, self.edges.last()?);
        let arc_mm = self.tooth.involute.arc_mm(rho_mm).clamp(first.arc_mm[0], last.arc_mm[2]);
        let mut force = self.along(arc_mm, direction(line))?;
        force.sort_by_key(|&(column, _)| column);
        Some(force)
    }

    /// Number of the tooth of the reference pair.
    pub fn middle(&self) -> usize {
        self.body.teeth() / 2
    }

    /// Number of fine teeth.
    pub fn teeth(&self) -> usize {
        self.body.teeth()
    }

    /// Candidate columns and weights of the displacement along `direction` at an arc length.
    fn along(&self, arc_mm: f64, direction: Vector2<f64>) -> Option<Vec<(usize, f64)>> {
        let after = self.edges.partition_point(|edge| edge.arc_mm[2] < arc_mm);
        let edge = self.edges.get(after).filter(|edge| edge.arc_mm[0] <= arc_mm)?;
        let mut columns = Vec::with_capacity(6);
        for (node, weight) in edge.nodes.into_iter().zip(edge.weights(arc_mm)) {
            let place = self.candidate[node]?;
            columns.push((2 * place, weight * direction.x));
            columns.push((2 * place + 1, weight * direction.y));
        }
        Some(columns)
    }
}

/// Unit vector of a load along `line` in the tooth's frame: into the tooth, whose working flank lies at x < 0.
fn direction(line: &LoadLine) -> Vector2<f64> {
    let (sin, cos) = line.load_angle_rad.sin_cos();
    Vector2::new(cos, -sin)
}

/// A point inside a tooth.
pub struct Inside {
    /// Depth below the flank, mm.
    pub depth_mm: f64,
    answer: Answer,
}

/// Least and greatest ρ at which an ellipse of half-width `half_width_mm` lies wholly on the resolved involute of `flank`.
pub(crate) fn limits_mm(tooth: &Tooth, flank: &MeshedFlank, half_width_mm: f64) -> Option<(f64, f64)> {
    let edges = flank_edges(tooth, flank);
    let (low, high) = (edges.first()?.arc_mm[0] + half_width_mm, edges.last()?.arc_mm[2] - half_width_mm);
    (low < high).then(|| (tooth.involute.rho_at_arc_mm(low), tooth.involute.rho_at_arc_mm(high)))
}

/// Nodes of the mesh under an ellipse around ρ: the candidates of such a load.
pub(crate) fn nodes_under(tooth: &Tooth, flank: &MeshedFlank, rho_mm: f64, half_width_mm: f64) -> Vec<u32> {
    let centre_mm = tooth.involute.arc_mm(rho_mm);
    let mut nodes: Vec<u32> = flank_edges(tooth, flank)
        .iter()
        .filter(|s| s.arc_mm[2] >= centre_mm - half_width_mm && s.arc_mm[0] <= centre_mm + half_width_mm)
        .flat_map(|s| s.nodes.map(|node| flank.surface.mesh_nodes[node]))
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Edges of the involute part of a flank, from root to tip.
fn flank_edges(tooth: &Tooth, flank: &MeshedFlank) -> Vec<InvoluteEdge> {
    flank
        .surface
        .edges
        .iter()
        .rev()
        .filter_map(|edge| {
            let &[tip, root, middle] = edge.nodes() else { return None };
            let nodes = [root, middle, tip];
            // ρ is NaN on a tip rounding.
            nodes
                .iter()
                .all(|&node| flank.rho_mm[node].is_finite())
                .then(|| InvoluteEdge { arc_mm: nodes.map(|node| tooth.involute.arc_mm(flank.rho_mm[node])), nodes })
        })
        .collect()
}

impl InvoluteEdge {
    /// Shape functions of the nodes at an arc length within the edge.
    fn weights(&self, arc_mm: f64) -> [f64; 3] {
        let [low, middle, high] = self.arc_mm;
        let (slope, curve) = (0.5 * (high - low), 0.5 * (low + high) - middle);
        // middle + slope t + curve t² = arc, with |curve| ≪ slope.
        let mut t = (arc_mm - middle) / slope;
        for _ in 0..4 {
            t -= (middle + slope * t + curve * t * t - arc_mm) / (slope + 2.0 * curve * t);
        }
        [0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)]
    }
}
