//! The pair without condensation: both whole gears as one finite-element model, as a check on the condensed one.
//!
//! All sectors are placed and joined node by node, the whole stiffness matrix is factorised, and contact is coupled in the
//! common frame. Nothing is shared with the condensed solution but elements, mortar and active set; both must agree to
//! round-off.

use std::collections::BTreeMap;

use faer::Mat;
use nalgebra::Vector2;

use super::flank_surface::edges;
use super::model::{MeshedGear, element};
use super::placement::{axis_mm, in_place_mm};
use super::position::PositionContact;
use super::ring::Surroundings;
use crate::gear::{Gear, GearPair, PerGear};
use crate::gear_mesh::{ToothMeshError, gear_mesh};
use gearwear_fem::active_set::Condensed;
use gearwear_fem::contact::{mortar::Coupling, surface::Surface};
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::Factor;
use gearwear_fem::problem::Edge;
use gearwear_fem::solid::Solid;
use gearwear_fem::stiffness::Stiffness;

/// How far from the places loaded in the condensed solution multipliers are put, in units of the loaded half-width.
const WINDOW: f64 = 3.0;

/// Why the whole model has no answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FullError {
    /// The sectors do not make a gear.
    #[error(transparent)]
    Mesh(#[from] ToothMeshError),
    /// The whole model has no equilibrium.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// The whole model's answer.
#[derive(Debug, Clone, PartialEq)]
pub struct FullContact {
    /// Degrees of freedom of both gears.
    pub dofs: usize,
    /// δ, mm.
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

/// Both gears in one.
struct Whole {
    solid: Solid,
    held: Vec<bool>,
    /// Edges of the fine teeth's working flanks, from the tip, by the number of the tooth pair.
    flanks: PerGear<BTreeMap<i32, Vec<Edge>>>,
    /// The pinion's nodes come before it.
    first_wheel_node: u32,
}

impl Whole {
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
        let mesh = gear_mesh(gear, pair.teeth[gear].teeth, meshed.settings.body, &fine, sectors)?;
        let offset = self.solid.points_mm.len() as u32;
        let shifted = |nodes: &[u32]| nodes.iter().map(|node| node + offset).collect::<Vec<u32>>();
        let placed = mesh.points_mm.iter().map(|&point| in_place_mm(pair, gear, position_mm, 0, point));
        self.solid.points_mm.extend(placed);
        let elements = mesh.cells.iter().map(|cell| element(cell, &shifted(cell.nodes()), material));
        self.solid.elements.extend(elements);

        self.held.resize(self.solid.dofs(), false);
        let clamped_sides = match meshed.surroundings {
            Surroundings::ClampedSector { .. } => &mesh.sides[..],
            _ => &[],
        };
        for node in mesh.teeth.iter().map(|tooth| &tooth.clamp).chain(clamped_sides).flatten() {
            let dof = 2 * (node + offset) as usize;
            self.held[dof] = true;
            self.held[dof + 1] = true;
        }
        for tooth in mesh.teeth.iter().filter(|tooth| tooth.fine) {
            let chain = shifted(tooth.working_flank.resolved_nodes().0);
            self.flanks[gear].insert(tooth.index, edges(&chain));
        }
        Ok(())
    }
}

/// Solves the whole model where `condensed` was solved, under the same load.
pub fn solve(
    pair: &GearPair,
    meshed: &PerGear<MeshedGear>,
    material: &PerGear<Elastic>,
    line_load_n_per_mm: f64,
    condensed: &PositionContact,
) -> Result<FullContact, FullError> {
    let whole = Whole::new(pair, meshed, condensed.position_mm)?;
    Ok(equilibrium(&whole, pair, material, line_load_n_per_mm, condensed)?)
}

fn equilibrium(
    whole: &Whole,
    pair: &GearPair,
    material: &PerGear<Elastic>,
    line_load_n_per_mm: f64,
    condensed: &PositionContact,
) -> Result<FullContact, SolveError> {
    let materials = [material.pinion, material.wheel];
    let stiffness = Stiffness::new(&whole.solid, &materials, Analysis::PlaneStrain)?;
    let factor = Factor::new(&stiffness, &whole.held)?;
    let interfaces = whole.interfaces(pair, condensed);

    let columns: Vec<Vec<(u32, f64)>> = interfaces.iter().flat_map(Interface::columns).collect();
    let rotation = |dof: u32| whole.rotation(pair, dof);
    let rigid: Vec<f64> =
        columns.iter().map(|column| column.iter().map(|&(dof, value)| value * rotation(dof)).sum()).collect();
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

/// One tooth pair of the whole model.
struct Interface {
    pair: i32,
    slave: Surface,
    master: Surface,
    coupling: Coupling,
}

impl Whole {
    /// The pairs in contact in the condensed solution, coupled around the places loaded there.
    fn interfaces(&self, pair: &GearPair, condensed: &PositionContact) -> Vec<Interface> {
        condensed
            .pairs
            .iter()
            .map(|contact| {
                let surface = |gear: Gear| Surface::new(&self.flanks[gear][&contact.pair], &self.solid.points_mm);
                let (slave, master) = (surface(contact.slave), surface(contact.slave.mate()));
                let radius = |point: &Vector2<f64>| (point - axis_mm(pair, Gear::Pinion)).norm();
                let reach_mm = WINDOW * contact.half_width_mm;
                let near = |edge: usize| {
                    let node = slave.edges[edge].nodes()[0];
                    (radius(&slave.points_mm[node]) - contact.pinion_radius_mm).abs() < reach_mm
                };
                let window: Vec<usize> = (0..slave.edges.len()).filter(|&edge| near(edge)).collect();
                let (first, last) = (window.first().copied().unwrap_or(0), window.last().map_or(0, |edge| edge + 1));
                let slave = slave.part(first..last);
                let coupling = Coupling::new(&slave, &master, reach_mm);
                Interface { pair: contact.pair, slave, master, coupling }
            })
            .collect()
    }

    /// Displacement of a degree of freedom per transmission error: the pinion turns, the wheel does not.
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

impl Interface {
    /// Rows of B by the mesh's degrees of freedom.
    fn columns(&self) -> Vec<Vec<(u32, f64)>> {
        let side = |row: sprs::CsVecView<'_, f64>, surface: &Surface| -> Vec<(u32, f64)> {
            row.iter().map(|(column, value)| (2 * surface.mesh_nodes[column / 2] + column as u32 % 2, *value)).collect()
        };
        let (slave, master) = (self.coupling.slave.outer_iterator(), self.coupling.master.outer_iterator());
        slave
            .zip(master)
            .map(|(own, mate)| side(own, &self.slave).into_iter().chain(side(mate, &self.master)).collect())
            .collect()
    }
}
