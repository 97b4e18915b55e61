//! The teeth of a gear in space, condensed onto the loads along their lines of contact.
//!
//! One pitch of the gear over its whole face width is condensed onto the nodes of its working flank, each with the one force that
//! contact without friction exerts on it, and onto its cuts; the sectors join to the ring as in the plane (`gear_fem::ring`). A line
//! load of 1 N in all along a piece of a line of contact is the row r of forces at the nodes around it, and
//!
//! ```text
//! u_a = r_aᵀ C_pq r_b · F_b
//! ```
//!
//! is how far a piece a of tooth p yields, on average over its length and along the transverse line of action, under the force F_b on
//! piece b of tooth q. Forces are counted by their transverse component: the flank's normal carries tan β_b times as much along
//! the axis, so that displacements along it are those of the transverse line of action.
//!
//! The elements are coarse. What they make of the neighbourhood of a load is the same as in the plane: the same section with the same
//! elements in plane strain ([`PlaneSection`]) tells it, and it is exchanged there for what is known of it.

use std::collections::BTreeMap;

use faer::Mat;
use nalgebra::{Rotation2, Vector2, Vector3, Vector6};

use super::ring::{JoinedSectors, Surroundings, ToothForce};
use super::sector::{Sector, SectorMatrices, symmetric};
use crate::gear::tooth::Tooth;
use crate::gear_mesh::tooth_section::{ExtrudedTooth, ToothSection};
use gearwear_fem::active_set::ActiveSetError;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::{Factor, FactorError};
use gearwear_fem::shape::{Shape, along_edge};
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_fem::space::{FoldedHexahedron, Hexahedron, nodal_stresses_mpa, stiffness};

/// Why the teeth of a gear cannot be condensed in space.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpaceError {
    /// The mesh has an element without volume.
    #[error(transparent)]
    Folded(#[from] FoldedHexahedron),
    /// The stiffness cannot be factorised.
    #[error(transparent)]
    Factor(#[from] FactorError),
    /// The section in the plane.
    #[error(transparent)]
    Plane(#[from] SolveError),
    /// The sectors cannot be joined.
    #[error(transparent)]
    Join(#[from] ActiveSetError),
}

/// Forces at nodes of a working flank, by their place there, as parts of the load.
pub type FlankForces = Vec<(u32, f64)>;

/// The teeth of a gear in space.
pub struct TeethInSpace {
    mesh: ExtrudedTooth,
    /// Place of each node among those of the flank, by place over the face width and node along the flank.
    places: Vec<Vec<Option<u32>>>,
    /// C of a tooth on itself, on its neighbour, and so on.
    by_distance: Vec<Mat<f64>>,
}

/// A tooth under load, by the nodes of its mesh.
pub struct DeformedTooth {
    /// Displacement against the clamp circle, mm.
    pub displacement_mm: Vec<Vector3<f64>>,
    /// x, y, z, xy, yz, zx, MPa.
    pub stress_mpa: Vec<Vector6<f64>>,
}

/// The section of a gear in plane strain on the elements that the teeth in space have.
pub struct PlaneSection {
    section: ToothSection,
    /// Compliance of the flank's nodes, mm per N/mm.
    compliance: Mat<f64>,
    /// Load at each node of the flank by component.
    directions: Vec<Vector2<f64>>,
}

/// The direction of a load on the working flank (x < 0) at a radius, in the tooth's frame.
fn load_direction(tooth: &Tooth, radius_mm: f64) -> Vector2<f64> {
    let load_angle = tooth.load_line(tooth.involute.curvature_radius_mm(radius_mm)).load_angle_rad;
    Vector2::new(load_angle.cos(), -load_angle.sin())
}

/// Radii of the nodes of a flank.
fn flank_radii_mm(section: &ToothSection) -> impl Iterator<Item = f64> {
    let ([first, last], intervals) = (section.flank_radius_mm, (section.flank.len() - 1) as f64);
    (0..section.flank.len()).map(move |k| first + (last - first) * k as f64 / intervals)
}

impl PlaneSection {
    /// Of a gear with such teeth.
    pub fn new(tooth: &Tooth, section: &ToothSection, material: Elastic) -> Result<Self, SpaceError> {
        let element = |nodes: &[u32; 8]| Element::new(ElementKind::Quad8, nodes, 0);
        let solid =
            Solid { points_mm: section.points_mm.clone(), elements: section.quads.iter().map(element).collect() };
        let free = |cut: &Vec<u32>| cut.iter().copied().filter(|node| !section.clamp.contains(node)).collect();
        let sector = Sector {
            solid,
            clamp: section.clamp.clone(),
            cuts: section.cuts.each_ref().map(free),
            half_angle_rad: std::f64::consts::PI / f64::from(tooth.teeth),
            candidates: section.flank.clone(),
            probes: Vec::new(),
            working_side_probes: 0,
        };
        let matrices = sector.condense(material, Analysis::PlaneStrain)?.matrices;
        let joined = joined(&matrices, 1, ring(tooth.teeth, 1))?;
        let compliance = joined.blocks(&matrices, 0, 0..=0).next().expect("one sector");
        let directions = flank_radii_mm(section).map(|radius_mm| load_direction(tooth, radius_mm)).collect();
        Ok(Self { section: section.clone(), compliance, directions })
    }

    /// Compliance of a tooth under a line load at a radius of its flank, where it acts and along it, mm²/N.
    pub fn mm2_per_n(&self, radius_mm: f64) -> f64 {
        let (first, s) = self.section.on_flank(radius_mm);
        let ([start, end, middle], _) = along_edge(true, s);
        let forces = [(first, start), (first + 1, middle), (first + 2, end)];
        let forces = forces.map(|(k, part)| (k, self.directions[k] * part));
        let mut sum = 0.0;
        for (i, f) in &forces {
            for (j, g) in &forces {
                for (r, f_r) in f.iter().enumerate() {
                    for (c, g_c) in g.iter().enumerate() {
                        sum += f_r * self.compliance[(2 * i + r, 2 * j + c)] * g_c;
                    }
                }
            }
        }
        sum
    }
}

/// What surrounds the first `teeth` of a ring of `all`.
fn ring(all: u32, teeth: usize) -> Surroundings {
    Surroundings::Ring { coarse: all as usize - teeth }
}

/// So many `teeth` among others like them.
fn joined(
    matrices: &SectorMatrices,
    teeth: usize,
    surroundings: Surroundings,
) -> Result<JoinedSectors, ActiveSetError> {
    JoinedSectors::new(matrices, Some(&matrices.cut_stiffness), teeth, surroundings)
}

impl TeethInSpace {
    /// Condenses the teeth of a gear, `teeth` of which (at most all of them) may be loaded together.
    pub fn new(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic, teeth: usize) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::new(tooth, &mesh, material, false)?.matrices;
        Self::joined(mesh, &matrices, teeth, ring(tooth.teeth, teeth))
    }

    /// The same in plane strain: the end faces stay in their planes.
    pub fn in_plane_strain(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::new(tooth, &mesh, material, true)?.matrices;
        Self::joined(mesh, &matrices, 1, ring(tooth.teeth, 1))
    }

    /// Two teeth in a row with `beside` more on either side, its outer cuts held.
    pub fn in_a_row(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic, beside: usize) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::new(tooth, &mesh, material, false)?.matrices;
        Self::joined(mesh, &matrices, 2, Surroundings::ClampedSector { coarse: beside })
    }

    fn joined(
        mesh: ExtrudedTooth,
        matrices: &SectorMatrices,
        teeth: usize,
        surroundings: Surroundings,
    ) -> Result<Self, SpaceError> {
        let mut next = 0..;
        let mut places_at =
            |k: usize| mesh.section.flank.iter().map(|node| mesh.node(*node, k).and_then(|_| next.next())).collect();
        let places = (0..mesh.z_mm.len()).map(&mut places_at).collect();
        let joined = joined(matrices, teeth, surroundings)?;
        Ok(Self { by_distance: joined.blocks(matrices, 0, 0..=teeth - 1).collect(), mesh, places })
    }

    /// Where elements over the face width end, from z = 0 on.
    pub fn layer_ends_mm(&self) -> Vec<f64> {
        self.mesh.layer_ends_mm()
    }

    /// Loads at points of the working flank, each its radius, its place over the face width and its part of the whole.
    pub fn load(&self, points: impl IntoIterator<Item = (f64, f64, f64)>) -> FlankForces {
        let mut forces = FlankForces::new();
        points.into_iter().for_each(|(radius_mm, z_mm, part)| self.add_load(radius_mm, z_mm, part, &mut forces));
        // Neighbouring points load the same nodes.
        forces.sort_by_key(|(node, _)| *node);
        forces.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|(_, part)| part).sum())).collect()
    }

    fn add_load(&self, radius_mm: f64, z_mm: f64, part: f64, forces: &mut FlankForces) {
        let (first, s) = self.mesh.section.on_flank(radius_mm);
        let (layer, t) = self.mesh.across_width(z_mm);
        let shape = Shape::at(ElementKind::Quad8, [s, t]);
        let nodes = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)];
        for ((along, across), value) in nodes.into_iter().zip(shape.values) {
            if let Some(node) = self.places[2 * layer + across][first + along] {
                forces.push((node, part * value));
            }
        }
    }

    /// Displacement of all nodes of a tooth of gear `tooth`, mm, and the stress there (x, y, z, xy, yz, zx), MPa, in its own frame under loads,
    /// N, on it and on teeth so many pitches anticlockwise of it.
    ///
    /// The sector is condensed anew: what this takes in memory is not kept for runs that do not ask.
    pub fn deformed(
        &self,
        tooth: &Tooth,
        material: Elastic,
        loads: &[(i32, f64, FlankForces)],
    ) -> Result<DeformedTooth, SpaceError> {
        let pitches = || loads.iter().map(|(pitches, ..)| *pitches).chain([0]);
        let (first, last) = (pitches().min().unwrap_or(0), pitches().max().unwrap_or(0));
        let teeth = (last - first + 1) as usize;
        let mut forces: Vec<ToothForce> = vec![Vec::new(); teeth];
        for (pitches, load_n, parts) in loads {
            let of_tooth = &mut forces[(pitches - first) as usize];
            of_tooth.extend(parts.iter().map(|(node, part)| (*node as usize, load_n * part)));
        }
        let sector = SectorInSpace::new(tooth, &self.mesh, material, false)?;
        let joined = joined(&sector.matrices, teeth, ring(tooth.teeth, teeth))?;
        let shown = -first as usize;
        let cuts_mm = joined.cut_displacement_mm(&sector.matrices, shown, &forces);
        let displacement_mm = sector.displacement_mm(&forces[shown], &cuts_mm);
        let stress_mpa = nodal_stresses_mpa(&self.mesh.points_mm, elements(&self.mesh, &material), &displacement_mm)?;
        let displacement_mm = displacement_mm.chunks_exact(3).map(|u| Vector3::new(u[0], u[1], u[2])).collect();
        Ok(DeformedTooth { displacement_mm, stress_mpa })
    }

    /// How far a load `of` on one tooth yields under the load `under` on a tooth so many pitches anticlockwise of it (clockwise where
    /// negative), mm/N.
    pub fn mm_per_n(&self, of: &FlankForces, under: &FlankForces, pitches: i32) -> f64 {
        let block = &self.by_distance[pitches.unsigned_abs() as usize];
        let (rows, columns) = if pitches >= 0 { (of, under) } else { (under, of) };
        rows.iter()
            .map(|(i, f)| f * columns.iter().map(|(j, g)| block[(*i as usize, *j as usize)] * g).sum::<f64>())
            .sum()
    }
}

/// One sector of a gear, factorised with its cuts held, and condensed onto the loads on its working flank and onto its cuts.
struct SectorInSpace {
    factor: Factor,
    /// Forces by degree of freedom: under the load of 1 N at each node of the flank, and what holds the inner nodes against each
    /// displacement of the cuts.
    columns: Vec<Vec<(u32, f64)>>,
    /// Displacements of the cuts: at each of their nodes along the radius, around and along the axis.
    of_cuts: Vec<(u32, Vector3<f64>)>,
    matrices: SectorMatrices,
}

impl SectorInSpace {
    /// The end faces are free, or stay in their planes.
    fn new(tooth: &Tooth, mesh: &ExtrudedTooth, material: Elastic, ends_stay: bool) -> Result<Self, SpaceError> {
        let matrix = stiffness(&mesh.points_mm, || elements(mesh, &material))?;
        let mut held = vec![false; mesh.points_mm.len()];
        let clamp = mesh.over(&mesh.section.clamp);
        clamp.iter().for_each(|node| held[*node as usize] = true);
        let cut_nodes: Vec<u32> = mesh
            .section
            .cuts
            .iter()
            .flat_map(|cut| mesh.over(cut).into_iter().filter(|node| !held[*node as usize]).collect::<Vec<_>>())
            .collect();
        cut_nodes.iter().for_each(|node| held[*node as usize] = true);
        let ends = [0, mesh.z_mm.len() - 1].map(|k| mesh.z_mm[k]);
        let stays = |dof: usize| ends_stay && dof % 3 == 2 && ends.contains(&mesh.points_mm[dof / 3].z);
        let factor = Factor::of_held(&matrix, |dof| held[dof / 3] || stays(dof))?;

        let mut columns = flank_forces(tooth, mesh);
        let loads = columns.len();
        let mut of_cuts: Vec<(u32, Vector3<f64>)> = Vec::new();
        // For each node of a cut which displacements are its own.
        let mut of_node = BTreeMap::new();
        for node in &cut_nodes {
            let first = of_cuts.len();
            let radial = mesh.points_mm[*node as usize].xy().normalize();
            of_cuts.push((*node, Vector3::new(radial.x, radial.y, 0.0)));
            of_cuts.push((*node, Vector3::new(-radial.y, radial.x, 0.0)));
            if !stays(3 * *node as usize + 2) {
                of_cuts.push((*node, Vector3::z()));
            }
            of_node.insert(*node, first..of_cuts.len());
        }
        let cuts = of_cuts.len();
        let cut_dofs: Vec<u32> = cut_nodes.iter().flat_map(|node| [0, 1, 2].map(|k| 3 * node + k)).collect();
        let entries = matrix.columns(&cut_dofs);
        let mut own = Mat::<f64>::zeros(cuts, cuts);
        for (place, node) in cut_nodes.iter().enumerate() {
            for column in of_node[node].clone() {
                let (_, direction) = of_cuts[column];
                let mut inside = Vec::new();
                for (k, part) in direction.iter().enumerate().filter(|(_, part)| **part != 0.0) {
                    for &(dof, value) in &entries[3 * place + k] {
                        match of_node.get(&(dof / 3)) {
                            Some(rows) => {
                                for row in rows.clone() {
                                    own[(row, column)] += of_cuts[row].1[dof as usize % 3] * value * part;
                                }
                            }
                            None if !held[dof as usize / 3] => inside.push((dof, part * value)),
                            None => {}
                        }
                    }
                }
                columns.push(inside);
            }
        }
        let all = factor.compliance(&columns);
        let matrices = SectorMatrices {
            compliance: all.get(..loads, ..loads).to_owned(),
            carried: Mat::from_fn(loads, cuts, |i, j| -all[(i, loads + j)]),
            cut_stiffness: symmetric(&(own - all.get(loads.., loads..))),
        };
        Ok(Self { factor, columns, of_cuts, matrices })
    }

    /// Displacement of every degree of freedom under loads on its flank and displacements of its cuts, mm.
    fn displacement_mm(&self, loads: &[(usize, f64)], cuts_mm: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.factor.dofs()];
        let mut add = |column: usize, part: f64| {
            self.columns[column].iter().for_each(|(dof, force)| u[*dof as usize] += part * force);
        };
        loads.iter().for_each(|(node, load)| add(*node, *load));
        let of_loads = self.columns.len() - self.of_cuts.len();
        cuts_mm.iter().enumerate().for_each(|(k, cut)| add(of_loads + k, -cut));
        self.factor.solve(1, &mut u);
        for ((node, direction), cut) in self.of_cuts.iter().zip(cuts_mm) {
            (0..3).for_each(|k| u[3 * *node as usize + k] += cut * direction[k]);
        }
        u
    }
}

/// The elements of a sector.
fn elements<'a>(mesh: &'a ExtrudedTooth, material: &'a Elastic) -> impl Iterator<Item = Hexahedron<'a>> {
    mesh.hexahedra.iter().map(move |nodes| Hexahedron { nodes, material })
}

/// The force at each node of the working flank whose transverse component is 1 N: along the flank's normal, which carries no load along
/// the helix, F · (ẑ × x θ' + ẑ) = 0.
pub fn flank_forces(tooth: &Tooth, mesh: &ExtrudedTooth) -> Vec<Vec<(u32, f64)>> {
    let mut forces = Vec::new();
    for k in 0..mesh.z_mm.len() {
        for (node, radius_mm) in mesh.section.flank.iter().zip(flank_radii_mm(&mesh.section)) {
            let Some(node) = mesh.node(*node, k) else { continue };
            let turned = Rotation2::new(mesh.turn_rad(k)) * load_direction(tooth, radius_mm);
            let point = mesh.points_mm[node as usize];
            let along_axis = -mesh.twist_rad_per_mm * point.xy().perp(&turned);
            forces.push(vec![(3 * node, turned.x), (3 * node + 1, turned.y), (3 * node + 2, along_axis)]);
        }
    }
    forces
}
