//! Finite-element model of both whole gears without condensation, as a check on the condensed one.
//!
//! All sectors are placed and joined node by node, the whole stiffness matrix is factorised, and contact is coupled in the
//! common frame. Only elements, mortar and active set are shared with the condensed solution; both agree to round-off.

use std::collections::BTreeMap;

use faer::Mat;

use super::flank_surface::edges;
use super::model::{MeshedGear, element};
use super::placement::{axis_mm, in_place_mm};
use super::position::PositionContact;
use super::ring::Surroundings;
use crate::gear::{Gear, GearPair, PerGear};
use crate::gear_mesh::{GearMesh, ToothMeshError, gear_mesh};
use gearwear_fem::active_set::Condensed;
use gearwear_fem::contact::{mortar::MortarCoupling, surface::Surface};
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::Factor;
use gearwear_fem::problem::Edge;
use gearwear_fem::solid::Solid;
use gearwear_fem::stiffness::Stiffness;

/// Extent of the multipliers around the contact of the condensed solution, in half-widths.
const WINDOW: f64 = 3.0;

/// Reason why the whole model has no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FullError {
    /// The sectors cannot be joined to a gear.
    #[error(transparent)]
    Mesh(#[from] ToothMeshError),
    /// The whole model has no equilibrium.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// Solution of the whole model.
#[derive(Debug, Clone, PartialEq)]
pub struct FullContact {
    /// Degrees of freedom of both gears.
    pub dofs: usize,
    /// Transmission error δ, mm.
    pub transmission_error_mm: f64,
    /// Number and line load of each pair, N/mm.
    pub line_load_n_per_mm: Vec<(i32, f64)>,
    /// Number and greatest pressure of each pair, MPa.
    pub peak_pressure_mpa: Vec<(i32, f64)>,
    /// Largest unbalanced nodal force over the largest nodal force.
    pub residual: f64,
    /// Active-set iterations.
    pub iterations: usize,
}

/// Mesh of both gears.
struct WholePair {
    solid: Solid,
    held: Vec<bool>,
    /// Edges of the fine teeth's working flanks from tip to root, by the number of the tooth pair.
    flanks: PerGear<BTreeMap<i32, Vec<Edge>>>,
    /// First node of the wheel, after those of the pinion.
    first_wheel_node: u32,
}

impl WholePair {
    fn new(pair: &GearPair, meshed: &PerGear<MeshedGear>, position_mm: f64) -> Result<Self, ToothMeshError> {
        let mut whole =
            Self { solid: Solid::default(), held: Vec::new(), flanks: PerGear::default(), first_wheel_node: 0 };
        for (gear, material) in Gear::BOTH.into_iter().zip(0..) {
            if gear == Gear::Wheel {
                whole.first_wheel_node = whole.solid.points_mm.len() as u32;
            }
            whole.add(pair, &meshed[gear], material, position_mm)?;
        }
        Ok(whole)
    }

    fn add(
        &mut self,
        pair: &GearPair,
        meshed: &MeshedGear,
        material: u16,
        position_mm: f64,
    ) -> Result<(), ToothMeshError> {
        let gear = meshed.gear;
        let reach = meshed.fine_teeth as i32 / 2;
        let fine: Vec<i32> = (-reach..=reach).collect();
        let sectors = [&meshed.fine, meshed.coarse.as_ref().unwrap_or(&meshed.fine)];
        let mesh = gear_mesh(gear, pair.teeth[gear].z(), meshed.settings.body, &fine, sectors)?;
        let offset = self.solid.points_mm.len() as u32;
        let placed = mesh.points_mm.iter().map(|&point| in_place_mm(pair, gear, position_mm, 0, point));
        self.solid.points_mm.extend(placed);
        let elements = mesh.cells.iter().map(|cell| element(cell, &shifted(cell.nodes(), offset), material));
        self.solid.elements.extend(elements);

        self.held.resize(self.solid.dofs(), false);
        for node in held_nodes(&mesh, meshed.surroundings) {
            let dof = 2 * (node + offset) as usize;
            self.held[dof] = true;
            self.held[dof + 1] = true;
        }
        for tooth in mesh.teeth.iter().filter(|tooth| tooth.fine) {
            let chain = shifted(tooth.working_flank.resolved_nodes().0, offset);
            self.flanks[gear].insert(tooth.index, edges(&chain));
        }
        Ok(())
    }
}

/// Nodes at which a gear is held.
fn held_nodes(mesh: &GearMesh, surroundings: Surroundings) -> Vec<u32> {
    let clamped_sides = match surroundings {
        Surroundings::PinnedRing { pins, .. } => {
            // The tooth in mesh is in the middle of the row.
            let (count, middle) = (mesh.teeth.len(), (mesh.teeth.len() - 1) / 2);
            let cuts = pins.cuts(count as u32).into_iter().map(|cut| (cut as usize + middle) % count);
            return cuts.filter_map(|place| mesh.teeth[place].clamp.last().copied()).collect();
        }
        Surroundings::ClampedSector { .. } => &mesh.sides[..],
        Surroundings::Ring { .. } | Surroundings::FreeSector { .. } => &[],
    };
    mesh.teeth.iter().map(|tooth| &tooth.clamp).chain(clamped_sides).flatten().copied().collect()
}

/// Node numbers increased by `offset`.
fn shifted(nodes: &[u32], offset: u32) -> Vec<u32> {
    nodes.iter().map(|node| node + offset).collect()
}

/// Solves the whole model at the position of `condensed`, under the same load.
pub fn solve(
    pair: &GearPair,
    meshed: &PerGear<MeshedGear>,
    material: &PerGear<Elastic>,
    line_load_n_per_mm: f64,
    condensed: &PositionContact,
) -> Result<FullContact, FullError> {
    let whole = WholePair::new(pair, meshed, condensed.position_mm)?;
    Ok(equilibrium(&whole, pair, material, line_load_n_per_mm, condensed)?)
}

fn equilibrium(
    whole: &WholePair,
    pair: &GearPair,
    material: &PerGear<Elastic>,
    line_load_n_per_mm: f64,
    condensed: &PositionContact,
) -> Result<FullContact, SolveError> {
    let materials = [material.pinion, material.wheel];
    let stiffness = Stiffness::new(&whole.solid, &materials, Analysis::PlaneStrain)?;
    let factor = Factor::new(&stiffness, &whole.held)?;
    let interfaces = whole.interfaces(pair, condensed);

    let columns: Vec<Vec<(u32, f64)>> = interfaces.iter().flat_map(CoupledPair::columns).collect();
    let rigid: Vec<f64> = columns
        .iter()
        .map(|column| column.iter().map(|&(dof, value)| value * whole.rotation(pair, dof)).sum())
        .collect();
    let problem = Condensed {
        compliance: factor.compliance(&columns),
        gap_mm: interfaces.iter().flat_map(|interface| interface.coupling.gap_mm.iter().copied()).collect(),
        rigid: Mat::from_fn(columns.len(), 1, |i, _| rigid[i]),
        rigid_load: vec![-line_load_n_per_mm],
    };
    let found = problem.solve(None)?;

    let mut load = vec![0.0; whole.solid.dofs()];
    for (column, force) in columns.iter().zip(&found.force) {
        for &(dof, value) in column {
            load[dof as usize] += value * force;
        }
    }
    let mut displacement = load.clone();
    factor.solve(1, &mut displacement);
    let inner = stiffness.matrix().multiply(&displacement);
    let free = (0..load.len()).filter(|&dof| !whole.held[dof]);
    let unbalanced = free.fold(0.0_f64, |most, dof| most.max((inner[dof] - load[dof]).abs()));
    let greatest = inner.iter().chain(&load).fold(0.0_f64, |most, force| most.max(force.abs()));

    let mut contact = FullContact {
        dofs: whole.solid.dofs(),
        transmission_error_mm: found.rigid[0],
        line_load_n_per_mm: Vec::new(),
        peak_pressure_mpa: Vec::new(),
        residual: unbalanced / greatest,
        iterations: found.log.steps.len(),
    };
    let mut first = 0;
    for interface in &interfaces {
        let rows = first..first + interface.coupling.len();
        first = rows.end;
        let carried = rows.clone().map(|row| -rigid[row] * found.force[row]).sum();
        let pressure = found.force[rows].iter().zip(&interface.coupling.weight_mm).map(|(f, w)| f / w);
        contact.line_load_n_per_mm.push((interface.pair, carried));
        contact.peak_pressure_mpa.push((interface.pair, pressure.fold(0.0, f64::max)));
    }
    Ok(contact)
}

/// Coupled tooth pair of the whole model.
struct CoupledPair {
    pair: i32,
    slave: Surface,
    master: Surface,
    coupling: MortarCoupling,
}

impl WholePair {
    /// Tooth pairs in contact in the condensed solution, coupled around their contact there.
    fn interfaces(&self, pair: &GearPair, condensed: &PositionContact) -> Vec<CoupledPair> {
        condensed
            .pairs
            .iter()
            .map(|contact| {
                let [slave, master] = [contact.slave, contact.slave.mate()]
                    .map(|gear| Surface::new(&self.flanks[gear][&contact.pair], &self.solid.points_mm));
                let reach_mm = WINDOW * contact.half_width_mm;
                let mut window = (0..slave.edges.len()).filter(|&edge| {
                    let point = slave.points_mm[slave.edges[edge].nodes()[0]];
                    let radius_mm = (point - axis_mm(pair, Gear::Pinion)).norm();
                    (radius_mm - contact.pinion_radius_mm).abs() < reach_mm
                });
                let (first, last) =
                    window.next().map_or((0, 0), |first| (first, window.next_back().unwrap_or(first) + 1));
                let slave = slave.part(first..last);
                let coupling = MortarCoupling::new(&slave, &master, reach_mm, Analysis::PlaneStrain);
                CoupledPair { pair: contact.pair, slave, master, coupling }
            })
            .collect()
    }

    /// Displacement of a degree of freedom per transmission error, by which the pinion turns.
    fn rotation(&self, pair: &GearPair, dof: u32) -> f64 {
        let point = self.solid.points_mm[dof as usize / 2];
        let r_b = pair.path.involute.pinion.base_radius_mm;
        match (self.is_pinion(dof), dof % 2) {
            (false, _) => 0.0,
            (true, 0) => -point.y / r_b,
            (true, _) => point.x / r_b,
        }
    }

    fn is_pinion(&self, dof: u32) -> bool {
        dof / 2 < self.first_wheel_node
    }
}

impl CoupledPair {
    /// Rows of the coupling matrix B by the mesh's degrees of freedom.
    fn columns(&self) -> Vec<Vec<(u32, f64)>> {
        let (slave, master) = (self.coupling.slave.outer_iterator(), self.coupling.master.outer_iterator());
        slave.zip(master).map(|(own, mate)| [by_dof(own, &self.slave), by_dof(mate, &self.master)].concat()).collect()
    }
}

/// Row of B on one surface by the mesh's degrees of freedom.
fn by_dof(row: sprs::CsVecView<'_, f64>, surface: &Surface) -> Vec<(u32, f64)> {
    row.iter().map(|(column, value)| (2 * surface.mesh_nodes[column / 2] + column as u32 % 2, *value)).collect()
}
