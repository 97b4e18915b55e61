//! Three-dimensional model of the teeth of a gear, condensed onto the loads along their lines of contact.
//!
//! One pitch of the gear over its whole face width is condensed onto the nodes of its working flank, each with the force of
//! frictionless contact as its one degree of freedom, and onto its cuts; sectors are joined to the ring as in two dimensions
//! (`gear_fem::ring`). Displacements that are even and odd under half a turn of the tooth are condensed one after the other (`gear_fem::half_turn`). With
//! r the nodal forces of a total load of 1 N along a segment of a line of contact,
//!
//! ```text
//! u_a = r_aᵀ C_pq r_b · F_b
//! ```
//!
//! is the deflection of segment a of tooth p, the mean over its length along the transverse line of action, under the force F_b on
//! segment b of tooth q. Forces are transverse components: the flank's normal has tan β_b times as much along
//! the axis, so that displacements along it are those along the transverse line of action.
//!
//! The elements are coarse: the local deflection near a load is that of the elements, the same as in plane strain. The same section with
//! the same elements in plane strain ([`PlaneSection`]) gives it, and there it is replaced by a closed form.

use std::collections::BTreeMap;
use std::ops::Range;

use faer::{Mat, Scale};
use nalgebra::{Rotation2, Vector2, Vector3, Vector6};

use super::half_turn::Part;
use super::ring::{JoinedSectors, Surroundings, ToothForce};
use super::sector::{Sector, SectorMatrices};
use crate::gear::tooth::Tooth;
use crate::gear_mesh::tooth_section::{ExtrudedTooth, ToothSection};
use gearwear_fem::active_set::ActiveSetError;
use gearwear_fem::dissection::dissected;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::{Factor, FactorError, SymbolicFactor};
use gearwear_fem::node_matrix::NodeMatrix;
use gearwear_fem::shape::{Shape, along_edge};
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_fem::space::{FoldedHexahedron, Hexahedron, nodal_stresses_mpa, stiffness_of};

/// Reason why the three-dimensional teeth of a gear cannot be condensed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpaceError {
    /// The mesh has an element without volume.
    #[error(transparent)]
    Folded(#[from] FoldedHexahedron),
    /// The stiffness cannot be factorised.
    #[error(transparent)]
    Factor(#[from] FactorError),
    /// The section in plane strain cannot be solved.
    #[error(transparent)]
    Plane(#[from] SolveError),
    /// The sectors cannot be joined.
    #[error(transparent)]
    Join(#[from] ActiveSetError),
}

/// Nodes of a working flank, counted along it, and their fractions of a load.
pub type FlankForces = Vec<(u32, f64)>;

/// Three-dimensional model of the teeth of a gear.
pub struct TeethInSpace {
    mesh: ExtrudedTooth,
    /// Number of each node among those of the flank, by place over the face width and along the flank.
    places: Vec<Vec<Option<u32>>>,
    /// Compliance C_pq by distance: of a tooth under its own load, under that of its neighbour, and so on.
    by_distance: Vec<Mat<f64>>,
}

/// Displacement and stress of a loaded tooth at the nodes of its mesh.
pub struct DeformedTooth {
    /// Displacement against the clamp circle, mm.
    pub displacement_mm: Vec<Vector3<f64>>,
    /// Stress components x, y, z, xy, yz, zx, MPa.
    pub stress_mpa: Vec<Vector6<f64>>,
}

/// Section of a gear in plane strain with the elements of the three-dimensional tooth model.
pub struct PlaneSection {
    section: ToothSection,
    /// Compliance of the flank's nodes, mm per N/mm.
    compliance: Mat<f64>,
    /// Direction of the load at each node of the flank.
    directions: Vec<Vector2<f64>>,
}

/// Direction of a load on the working flank (x < 0) at a radius, in the tooth's frame.
fn load_direction(tooth: &Tooth, radius_mm: f64) -> Vector2<f64> {
    let load_angle = tooth.load_line(tooth.involute.curvature_radius_mm(radius_mm)).load_angle_rad;
    Vector2::new(load_angle.cos(), -load_angle.sin())
}

/// `nodes` without those that are held.
fn free_of(nodes: &[u32], is_held: impl Fn(&u32) -> bool) -> Vec<u32> {
    nodes.iter().copied().filter(|node| !is_held(node)).collect()
}

/// Radii of the nodes of a flank.
fn flank_radii_mm(section: &ToothSection) -> impl Iterator<Item = f64> {
    let ([first, last], intervals) = (section.flank_radius_mm, (section.flank.len() - 1) as f64);
    (0..section.flank.len()).map(move |k| first + (last - first) * k as f64 / intervals)
}

impl PlaneSection {
    /// Condensed section of a gear with teeth of this shape.
    pub fn new(tooth: &Tooth, section: &ToothSection, material: Elastic) -> Result<Self, SpaceError> {
        let elements = section.quads.iter().map(|nodes| Element::new(ElementKind::Quad8, nodes, 0)).collect();
        let sector = Sector {
            solid: Solid { points_mm: section.points_mm.clone(), elements },
            clamp: section.clamp.clone(),
            cuts: section.cuts.each_ref().map(|cut| free_of(cut, |node| section.clamp.contains(node))),
            half_angle_rad: std::f64::consts::PI / tooth.z(),
            candidates: section.flank.clone(),
            probes: Vec::new(),
            working_side_probes: 0,
        };
        let matrices = sector.condense(material, Analysis::PlaneStrain)?.matrices;
        let joined = joined(&matrices, 1, ring(tooth.teeth, 1), 0)?;
        let compliance = joined.blocks(&matrices, 0, 0..=0).next().expect("one sector");
        let directions = flank_radii_mm(section).map(|radius_mm| load_direction(tooth, radius_mm)).collect();
        Ok(Self { section: section.clone(), compliance, directions })
    }

    /// Compliance of a tooth under a line load at a radius of its flank: displacement of the point of action along the load, mm²/N.
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

/// Surroundings of `teeth` neighbouring teeth in a ring of `all`.
fn ring(all: u32, teeth: usize) -> Surroundings {
    Surroundings::Ring { coarse: all as usize - teeth }
}

/// Joins `teeth` loaded teeth with others of the same mesh, and finds the compliance of the cuts of one of them.
fn joined(
    matrices: &SectorMatrices,
    teeth: usize,
    surroundings: Surroundings,
    of: usize,
) -> Result<JoinedSectors, ActiveSetError> {
    JoinedSectors::new(matrices, Some(&matrices.cut_stiffness), teeth, surroundings, of..=of)
}

impl TeethInSpace {
    /// Condenses the teeth of a gear, of which `teeth` may be loaded together.
    pub fn new(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic, teeth: usize) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::matrices(tooth, &mesh, material, false)?;
        Self::joined(mesh, &matrices, teeth, ring(tooth.teeth, teeth))
    }

    /// Condenses one tooth in plane strain: without axial displacement of the end faces.
    pub fn in_plane_strain(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::matrices(tooth, &mesh, material, true)?;
        Self::joined(mesh, &matrices, 1, ring(tooth.teeth, 1))
    }

    /// Condenses two neighbouring teeth with `beside` more on either side, the outer cuts held.
    pub fn in_a_row(tooth: &Tooth, mesh: ExtrudedTooth, material: Elastic, beside: usize) -> Result<Self, SpaceError> {
        let matrices = SectorInSpace::matrices(tooth, &mesh, material, false)?;
        Self::joined(mesh, &matrices, 2, Surroundings::ClampedSector { coarse: beside })
    }

    fn joined(
        mesh: ExtrudedTooth,
        matrices: &SectorMatrices,
        teeth: usize,
        surroundings: Surroundings,
    ) -> Result<Self, SpaceError> {
        let (mut next, mut places) = (0.., Vec::with_capacity(mesh.z_mm.len()));
        for k in 0..mesh.z_mm.len() {
            places.push(mesh.section.flank.iter().map(|node| mesh.node(*node, k).and_then(|_| next.next())).collect());
        }
        let joined = joined(matrices, teeth, surroundings, 0)?;
        Ok(Self { by_distance: joined.blocks(matrices, 0, 0..=teeth - 1).collect(), mesh, places })
    }

    /// Ends of the layers of elements over the face width, from z = 0 on.
    pub fn layer_ends_mm(&self) -> Vec<f64> {
        self.mesh.layer_ends_mm()
    }

    /// Nodal forces of loads at points of the working flank, each given by radius, z and fraction of the whole load.
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

    /// Displacement and stress of a tooth in its own frame under `loads`: for each loaded tooth its distance in pitches anticlockwise, the load
    /// in N and the nodal forces.
    ///
    /// The sector is condensed again, so that its factor need not be kept in memory.
    pub fn deformed(
        &self,
        tooth: &Tooth,
        material: Elastic,
        loads: &[(i32, f64, FlankForces)],
    ) -> Result<DeformedTooth, SpaceError> {
        let first = loads.iter().map(|(pitches, ..)| *pitches).fold(0, i32::min);
        let last = loads.iter().map(|(pitches, ..)| *pitches).fold(0, i32::max);
        let teeth = (last - first + 1) as usize;
        let mut forces: Vec<ToothForce> = vec![Vec::new(); teeth];
        for (pitches, load_n, parts) in loads {
            let of_tooth = &mut forces[(pitches - first) as usize];
            of_tooth.extend(parts.iter().map(|(node, part)| (*node as usize, load_n * part)));
        }
        let sector = SectorInSpace::new(tooth, &self.mesh, material, false);
        let mut parts = Vec::new();
        let matrices = sector.condensed(|part| parts.push(part))?;
        let shown = -first as usize;
        let joined = joined(&matrices, teeth, ring(tooth.teeth, teeth), shown)?;
        let cuts_mm = joined.cut_displacement_mm(&matrices, shown, &forces);
        let displacement_mm = sector.displacement_mm(&parts, &forces[shown], &cuts_mm);
        let stress_mpa = nodal_stresses_mpa(&self.mesh.points_mm, elements(&self.mesh, &material), &displacement_mm)?;
        let displacement_mm = displacement_mm.chunks_exact(3).map(|u| Vector3::new(u[0], u[1], u[2])).collect();
        Ok(DeformedTooth { displacement_mm, stress_mpa })
    }

    /// Deflection at the load `of` on one tooth under the load `under` on a tooth `pitches` anticlockwise of it (clockwise where
    /// negative), mm/N.
    pub fn mm_per_n(&self, of: &FlankForces, under: &FlankForces, pitches: i32) -> f64 {
        let block = &self.by_distance[pitches.unsigned_abs() as usize];
        let (rows, columns) = if pitches >= 0 { (of, under) } else { (under, of) };
        rows.iter()
            .map(|(i, f)| f * columns.iter().map(|(j, g)| block[(*i as usize, *j as usize)] * g).sum::<f64>())
            .sum()
    }
}

/// One sector of a gear with the loads on its working flank and the displacements of its cuts.
struct SectorInSpace<'a> {
    mesh: &'a ExtrudedTooth,
    material: Elastic,
    /// Whether the end faces have no axial displacement.
    plane_strain: bool,
    /// Forces of a load of 1 N at each node of the flank.
    loads: Vec<Vec<(u32, f64)>>,
    cuts: CutDisplacements,
    /// Whether each node is clamped.
    clamped: Vec<bool>,
}

/// Displacements of a sector of one parity, factorised with its cuts held.
struct CondensedPart {
    part: Part,
    factor: Factor,
    /// Forces by degree of freedom: of the loads, then K_ib, the forces on inner nodes per displacement of the cuts.
    columns: Vec<Vec<(u32, f64)>>,
    /// Displacements of the cuts that represent all.
    cuts: CutDisplacements,
    /// Those by which each displacement of the sector's cuts is known, and its sign there.
    of_cuts: Vec<(usize, f64)>,
}

/// Unit displacements of the cuts: radial, circumferential and axial at each of their nodes.
struct CutDisplacements {
    nodes: Vec<u32>,
    units: Vec<(u32, Vector3<f64>)>,
    /// Unit displacements of each node.
    of_node: BTreeMap<u32, Range<usize>>,
}

impl CutDisplacements {
    /// Unit displacements of `nodes`; only those for which `moves_axially` move along the axis.
    fn new(mesh: &ExtrudedTooth, nodes: Vec<u32>, moves_axially: impl Fn(u32) -> bool) -> Self {
        let (mut units, mut of_node) = (Vec::new(), BTreeMap::new());
        for &node in &nodes {
            let first = units.len();
            let radial = mesh.points_mm[node as usize].xy().normalize();
            units.push((node, Vector3::new(radial.x, radial.y, 0.0)));
            units.push((node, Vector3::new(-radial.y, radial.x, 0.0)));
            if moves_axially(node) {
                units.push((node, Vector3::z()));
            }
            of_node.insert(node, first..units.len());
        }
        Self { nodes, units, of_node }
    }

    /// K_bb, and the columns of K_ib on nodes that are not `held`.
    fn stiffness(&self, matrix: &NodeMatrix, held: &[bool]) -> (Mat<f64>, Vec<Vec<(u32, f64)>>) {
        let dofs: Vec<u32> = self.nodes.iter().flat_map(|node| [0, 1, 2].map(|k| 3 * node + k)).collect();
        let entries = matrix.columns(&dofs);
        let mut own = Mat::<f64>::zeros(self.units.len(), self.units.len());
        let mut columns = Vec::with_capacity(self.units.len());
        for (place, node) in self.nodes.iter().enumerate() {
            for column in self.of_node[node].clone() {
                let (_, direction) = self.units[column];
                let mut inside = Vec::new();
                for (k, part) in direction.iter().enumerate().filter(|(_, part)| **part != 0.0) {
                    for &(dof, value) in &entries[3 * place + k] {
                        if let Some(rows) = self.of_node.get(&(dof / 3)) {
                            for row in rows.clone() {
                                own[(row, column)] += self.units[row].1[dof as usize % 3] * value * part;
                            }
                        } else if !held[dof as usize / 3] {
                            inside.push((dof, part * value));
                        }
                    }
                }
                columns.push(inside);
            }
        }
        (own, columns)
    }
}

impl<'a> SectorInSpace<'a> {
    /// Sector with free end faces or, in plane strain, without axial displacement of these.
    fn new(tooth: &Tooth, mesh: &'a ExtrudedTooth, material: Elastic, plane_strain: bool) -> Self {
        let mut clamped = vec![false; mesh.points_mm.len()];
        mesh.over(&mesh.section.clamp).iter().for_each(|node| clamped[*node as usize] = true);
        let of_cuts = mesh.section.cuts.iter().flat_map(|cut| free_of(&mesh.over(cut), |node| clamped[*node as usize]));
        let stays = |node: u32| plane_strain && is_on_end_face(mesh, node);
        let cuts = CutDisplacements::new(mesh, of_cuts.collect(), |node| !stays(node));
        Self { loads: flank_forces(tooth, mesh), mesh, material, plane_strain, cuts, clamped }
    }

    /// Matrices of a sector.
    fn matrices(
        tooth: &Tooth,
        mesh: &ExtrudedTooth,
        material: Elastic,
        plane_strain: bool,
    ) -> Result<SectorMatrices, SpaceError> {
        SectorInSpace::new(tooth, mesh, material, plane_strain).condensed(drop)
    }

    /// Condenses the sector part by part, and gives each part to `take` before the next one is begun.
    fn condensed(&self, mut take: impl FnMut(CondensedPart)) -> Result<SectorMatrices, SpaceError> {
        let (loads, units) = (self.loads.len(), self.cuts.units.len());
        let mut matrices = SectorMatrices {
            compliance: Mat::zeros(loads, loads),
            carried: Mat::zeros(loads, units),
            cut_stiffness: Mat::zeros(units, units),
        };
        for part in Part::of(self.mesh) {
            let share = part.share();
            let (condensed, own) = CondensedPart::new(self, part)?;
            matrices.compliance += Scale(share) * own.compliance;
            for (j, (q, of_column)) in condensed.of_cuts.iter().enumerate() {
                for i in 0..loads {
                    matrices.carried[(i, j)] += share * of_column * own.carried[(i, *q)];
                }
                for (i, (p, of_row)) in condensed.of_cuts.iter().enumerate() {
                    matrices.cut_stiffness[(i, j)] += share * of_row * of_column * own.cut_stiffness[(*p, *q)];
                }
            }
            take(condensed);
        }
        Ok(matrices)
    }

    /// Displacement of every degree of freedom under loads on the flank and displacements of the cuts, mm.
    fn displacement_mm(&self, parts: &[CondensedPart], loads: &[(usize, f64)], cuts_mm: &[f64]) -> Vec<f64> {
        let mut displacement_mm = vec![0.0; 3 * self.mesh.points_mm.len()];
        for condensed in parts {
            let of_part = condensed.displacement_mm(self.loads.len(), loads, cuts_mm);
            condensed.part.add_unfolded(&of_part, &mut displacement_mm);
        }
        displacement_mm
    }
}

impl CondensedPart {
    /// Condenses a part of the displacements of `sector`.
    fn new(sector: &SectorInSpace<'_>, part: Part) -> Result<(Self, SectorMatrices), SpaceError> {
        let SectorInSpace { mesh, material, plane_strain, .. } = sector;
        let of_part = || part.elements.iter().map(|element| &mesh.hexahedra[*element]);
        let hexahedra = || of_part().map(|nodes| Hexahedron { nodes, material });
        let matrix = stiffness_of(&mesh.points_mm, hexahedra, |node| part.representative(node))?;
        let cut_nodes = free_of(&sector.cuts.nodes, |node| !part.represents_itself(*node));
        let mut held = sector.clamped.clone();
        cut_nodes.iter().for_each(|node| held[*node as usize] = true);
        let stays = |node: u32| *plane_strain && is_on_end_face(mesh, node);
        let cuts = CutDisplacements::new(mesh, cut_nodes, |node| !stays(node));
        let of_cuts = sector.cuts.nodes.iter().flat_map(|node| {
            let represented = cuts.of_node[&part.representative(*node).node].clone();
            represented.enumerate().map(|(k, unit)| (unit, part.sign_on_cut(*node, k)))
        });
        let of_cuts: Vec<(usize, f64)> = of_cuts.collect();
        let mut columns: Vec<Vec<(u32, f64)>> = sector.loads.iter().map(|forces| part.folded(forces)).collect();
        let loads = columns.len();
        let (own, per_displacement) = cuts.stiffness(&matrix, &held);
        columns.extend(per_displacement);
        let elements: Vec<[u32; 20]> =
            of_part().map(|nodes| nodes.map(|node| part.representative(node).node)).collect();
        let order = dissected(&mesh.points_mm, &elements, |node| held[node as usize]);
        let is_held =
            |dof: usize| held[dof / 3] || !part.is_independent(dof) || dof % 3 == 2 && stays((dof / 3) as u32);
        let symbolic = SymbolicFactor::in_order(&matrix, is_held, &order)?;
        // The factor is as large as all else together.
        drop(matrix);
        let factor = symbolic.factorised()?;
        let all = factor.compliance(&columns);
        let units = cuts.units.len();
        let matrices = SectorMatrices {
            compliance: all.get(..loads, ..loads).to_owned(),
            carried: Mat::from_fn(loads, units, |i, j| -all[(i, loads + j)]),
            cut_stiffness: Mat::from_fn(units, units, |i, j| {
                0.5 * (own[(i, j)] + own[(j, i)]) - all[(loads + i, loads + j)]
            }),
        };
        Ok((Self { part, factor, columns, cuts, of_cuts }, matrices))
    }

    /// Displacement of the nodes that represent all under loads on the flank and displacements of the cuts, mm.
    fn displacement_mm(&self, of_loads: usize, loads: &[(usize, f64)], cuts_mm: &[f64]) -> Vec<f64> {
        let share = self.part.share();
        let mut units_mm = vec![0.0; self.cuts.units.len()];
        self.of_cuts.iter().zip(cuts_mm).for_each(|((unit, sign), mm)| units_mm[*unit] += share * sign * mm);
        let mut u = vec![0.0; self.factor.dofs()];
        let of_loads_themselves = loads.iter().map(|(load, force)| (*load, share * force));
        let of_units = units_mm.iter().enumerate().map(|(k, mm)| (of_loads + k, -mm));
        for (column, part) in of_loads_themselves.chain(of_units) {
            self.columns[column].iter().for_each(|(dof, force)| u[*dof as usize] += part * force);
        }
        self.factor.solve(1, &mut u);
        for ((node, direction), mm) in self.cuts.units.iter().zip(&units_mm) {
            (0..3).for_each(|k| u[3 * *node as usize + k] += mm * direction[k]);
        }
        u
    }
}

/// Whether a node lies on an end face.
fn is_on_end_face(mesh: &ExtrudedTooth, node: u32) -> bool {
    let z_mm = mesh.points_mm[node as usize].z;
    z_mm == mesh.z_mm[0] || z_mm == mesh.z_mm[mesh.z_mm.len() - 1]
}

/// Elements of a sector.
fn elements<'a>(mesh: &'a ExtrudedTooth, material: &'a Elastic) -> impl Iterator<Item = Hexahedron<'a>> {
    mesh.hexahedra.iter().map(move |nodes| Hexahedron { nodes, material })
}

/// Force at each node of the working flank with a transverse component of 1 N, along the flank's normal: perpendicular to the helix,
/// F · (ẑ × x θ' + ẑ) = 0.
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
