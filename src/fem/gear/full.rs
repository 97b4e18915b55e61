//! The pair without condensation: both whole gears as one finite-element model, as a check on the condensed one.
//!
//! All sectors are placed and joined node by node, the whole stiffness matrix is factorised, and contact is coupled in the
//! common frame. Nothing is shared with the condensed solution but elements, mortar and active set; both must agree to
//! round-off.

use faer::Mat;
use nalgebra::Vector2;

use super::model::{MeshedGear, solid};
use super::placement::{axis_mm, in_place_mm};
use super::position::PositionContact;
use super::ring::Surroundings;
use crate::fem::active_set::Condensed;
use crate::fem::contact::{mortar::Coupling, surface::Surface};
use crate::fem::elastic::{Analysis, Elastic};
use crate::fem::equilibrium::SolveError;
use crate::fem::factor::Factor;
use crate::fem::problem::Edge;
use crate::fem::solid::{Element, Solid};
use crate::fem::stiffness::Stiffness;
use crate::gear::{Gear, GearPair, PerGear};
use crate::mesh::tooth::ToothSector;

/// How far from the places loaded in the condensed solution multipliers are put, in units of the loaded half-width.
const WINDOW: f64 = 3.0;

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
    /// Active sets tried.
    pub iterations: usize,
}

/// Both gears in one.
struct Whole {
    solid: Solid,
    held: Vec<bool>,
    /// Edges of the fine teeth's working flanks, from the tip, by gear and place among the fine teeth.
    flanks: PerGear<Vec<Vec<Edge>>>,
    /// The pinion's nodes come before it.
    first_wheel_node: u32,
}

impl Whole {
    fn new(pair: &GearPair, meshed: &PerGear<MeshedGear>, position_mm: f64) -> Self {
        let mut whole =
            Self { solid: Solid::default(), held: Vec::new(), flanks: PerGear::default(), first_wheel_node: 0 };
        for (gear, material) in Gear::BOTH.into_iter().zip(0..) {
            if gear == Gear::Wheel {
                whole.first_wheel_node = whole.solid.points_mm.len() as u32;
            }
            whole.add(pair, &meshed[gear], material, position_mm);
        }
        whole
    }

    fn add(&mut self, pair: &GearPair, gear: &MeshedGear, material: u16, position_mm: f64) {
        let middle = gear.fine_teeth as i32 / 2;
        // Places in anticlockwise order, from the most clockwise tooth of the model.
        let (first, count) = match gear.surroundings {
            Surroundings::Ring { coarse } => (0, gear.fine_teeth as i32 + coarse as i32),
            Surroundings::FreeSector { coarse } | Surroundings::ClampedSector { coarse } => {
                (-(coarse as i32), gear.fine_teeth as i32 + 2 * coarse as i32)
            }
        };
        let mut first_cut = Vec::new();
        let mut last_cut: Vec<u32> = Vec::new();
        for place in first..first + count {
            let fine = (0..gear.fine_teeth as i32).contains(&place);
            let Some(mesh) = (if fine { Some(&gear.fine) } else { gear.coarse.as_ref() }) else { continue };
            let closes = matches!(gear.surroundings, Surroundings::Ring { .. }) && place + 1 == first + count;
            // The wheel's pairs are numbered clockwise.
            let tooth = if gear.gear == Gear::Pinion { place - middle } else { middle - place };
            let put = |point| in_place_mm(pair, gear.gear, position_mm, tooth, point);
            let closing: &[u32] = if closes { &first_cut } else { &[] };
            let joined = [(&mesh.right_cut[..], &last_cut[..]), (&mesh.left_cut[..], closing)];
            let numbers = self.add_sector(mesh, material, joined, put);
            let of = |nodes: &[u32]| nodes.iter().map(|&node| numbers[node as usize]).collect::<Vec<u32>>();
            if fine {
                let chain = of(mesh.working_flank.resolved_nodes().0);
                self.flanks[gear.gear].push(super::flank_surface::edges(&chain));
            }
            let clamped = matches!(gear.surroundings, Surroundings::ClampedSector { .. });
            if place == first {
                first_cut = of(&mesh.right_cut);
            }
            last_cut = of(&mesh.left_cut);
            let mut hold = of(&mesh.clamp);
            if clamped && place == first {
                hold.extend_from_slice(&first_cut);
            }
            if clamped && place + 1 == first + count {
                hold.extend_from_slice(&last_cut);
            }
            self.held.resize(self.solid.dofs(), false);
            for node in hold {
                self.held[2 * node as usize] = true;
                self.held[2 * node as usize + 1] = true;
            }
        }
    }

    /// Adds a sector whose cuts lie on nodes that are there already; returns the number of each of its nodes.
    fn add_sector(
        &mut self,
        mesh: &ToothSector,
        material: u16,
        joined: [(&[u32], &[u32]); 2],
        put: impl Fn(Vector2<f64>) -> Vector2<f64>,
    ) -> Vec<u32> {
        let mut numbers = vec![u32::MAX; mesh.points_mm.len()];
        for (cut, there) in joined {
            for (own, other) in cut.iter().zip(there) {
                numbers[*own as usize] = *other;
            }
        }
        for (number, point) in numbers.iter_mut().zip(&mesh.points_mm) {
            if *number == u32::MAX {
                *number = self.solid.points_mm.len() as u32;
                self.solid.points_mm.push(put(*point));
            }
        }
        for element in &solid(mesh).elements {
            let nodes: Vec<u32> = element.nodes().iter().map(|&node| numbers[node as usize]).collect();
            self.solid.elements.push(Element::new(element.kind, &nodes, material));
        }
        numbers
    }
}

/// Solves the whole model where `condensed` was solved, under the same load.
///
/// # Errors
/// As the condensed model.
pub fn solve(
    pair: &GearPair,
    meshed: &PerGear<MeshedGear>,
    material: &PerGear<Elastic>,
    line_load_n_per_mm: f64,
    condensed: &PositionContact,
) -> Result<FullContact, SolveError> {
    let whole = Whole::new(pair, meshed, condensed.position_mm);
    let materials = [material.pinion, material.wheel];
    let stiffness = Stiffness::new(&whole.solid, &materials, Analysis::PlaneStrain)?;
    let factor = Factor::new(&stiffness, &whole.held)?;
    let interfaces = whole.interfaces(pair, meshed, condensed);

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
    let inner = stiffness.multiply(&displacement);
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
    fn interfaces(&self, pair: &GearPair, meshed: &PerGear<MeshedGear>, condensed: &PositionContact) -> Vec<Interface> {
        let middle = meshed.pinion.fine_teeth as i32 / 2;
        condensed
            .pairs
            .iter()
            .map(|contact| {
                let edges = PerGear {
                    pinion: &self.flanks.pinion[(middle + contact.pair) as usize],
                    wheel: &self.flanks.wheel[(middle - contact.pair) as usize],
                };
                let surface = |gear: Gear| Surface::new(edges[gear], &self.solid.points_mm);
                let (slave, master) = (surface(Gear::Pinion), surface(Gear::Wheel));
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
