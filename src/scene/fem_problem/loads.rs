//! Supports, given displacements and forces, on the nodes of their groups.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector2;

use super::file::{Component, FemProblemFile, LoadFile};
use super::meshed_groups::MeshedGroups;
use crate::fem::loads::add_spread_force;
use crate::fem::problem::{Edge, Held};
use crate::scene::findings::Findings;
use crate::scene::problem::number;

/// Given displacements by degree of freedom, each with the table that gives it.
struct Given<'a> {
    by_dof: BTreeMap<u32, (f64, String)>,
    place: MeshedGroups<'a>,
}

/// All supports and given displacements, no degree of freedom twice.
pub(super) fn held(file: &FemProblemFile, place: MeshedGroups<'_>, findings: &mut Findings) -> Vec<Held> {
    let mut given = Given { by_dof: BTreeMap::new(), place };
    for (i, fixed) in file.fixed.iter().enumerate() {
        let nodes = place.nodes(&fixed.group, &format!("fixed[{i}].group"), findings);
        let components = fixed.components.as_deref().unwrap_or(&Component::BOTH);
        given.add(&nodes, components, [0.0; 2], &format!("fixed[{i}]"), findings);
    }
    for (i, load) in file.load.iter().enumerate() {
        let Some(displacement_mm) = load.displacement_mm else { continue };
        let nodes = place.nodes(&load.group, &format!("load[{i}].group"), findings);
        let components = load.components.as_deref().unwrap_or(&Component::BOTH);
        given.add(&nodes, components, displacement_mm, &format!("load[{i}]"), findings);
    }
    given.by_dof.into_iter().map(|(dof, (displacement_mm, _))| Held { dof, displacement_mm }).collect()
}

impl Given<'_> {
    /// Gives the nodes of `table` their displacement; reported where another table gives another one.
    fn add(
        &mut self,
        nodes: &[u32],
        components: &[Component],
        displacement_mm: [f64; 2],
        table: &str,
        findings: &mut Findings,
    ) {
        for &node in nodes {
            for component in components {
                let value = displacement_mm[component.index()];
                let dof = 2 * node + component.index() as u32;
                match self.by_dof.get(&dof) {
                    Some((other, earlier)) if *other != value => {
                        let at = self.place.meshed.solid.points_mm[node as usize];
                        let found = format!(
                            "the displacement {} mm along {} at the node x = {}, y = {}, to which {earlier} gives {} mm",
                            number(value),
                            component.name(),
                            number(at.x),
                            number(at.y),
                            number(*other),
                        );
                        let allowed = "one displacement for each node and direction";
                        findings.not_allowed(table, found, allowed);
                        findings.help("components leaves a direction out");
                    }
                    Some(_) => {}
                    None => {
                        self.by_dof.insert(dof, (value, table.to_owned()));
                    }
                }
            }
        }
    }
}

/// Nodal forces of all loads, N/mm, one for each degree of freedom.
pub(super) fn forces(
    file: &FemProblemFile,
    place: MeshedGroups<'_>,
    held: &[Held],
    findings: &mut Findings,
) -> Vec<f64> {
    let held: BTreeSet<u32> = held.iter().map(|held| held.dof).collect();
    let mut forces = vec![0.0; place.meshed.solid.dofs()];
    for (i, load) in file.load.iter().enumerate() {
        let Some(force_n_per_mm) = load.force_N_per_mm else { continue };
        let Some(shares) = shares(load, &format!("load[{i}].group"), place, findings) else { continue };
        for component in Component::BOTH {
            let force = force_n_per_mm[component.index()];
            let dof = |node: u32| 2 * node + component.index() as u32;
            let lost: f64 = shares.iter().filter(|(node, _)| held.contains(&dof(**node))).map(|(_, share)| share).sum();
            if force != 0.0 {
                say_what_is_lost(
                    load,
                    i,
                    component,
                    lost,
                    shares.keys().all(|&node| held.contains(&dof(node))),
                    findings,
                );
            }
            for (&node, share) in &shares {
                forces[dof(node) as usize] += share * force;
            }
        }
    }
    forces
}

/// A force on a held node goes straight into the support: an error where all of it does, else worth knowing.
fn say_what_is_lost(
    load: &LoadFile,
    index: usize,
    component: Component,
    lost: f64,
    all: bool,
    findings: &mut Findings,
) {
    let (group, along) = (&load.group, component.name());
    if all {
        let found = format!("a force along {along} on {group:?}, every node of which is held along {along}");
        let allowed = "a force on nodes that can move, or displacement_mm";
        findings.not_allowed(&format!("load[{index}].force_N_per_mm"), found, allowed);
    } else if lost > 0.0 {
        findings.warnings.push(format!(
            "load[{index}]: {:.2} % of the force along {along} acts on nodes of {group:?} that are held along {along}, and goes straight into \
             their support",
            100.0 * lost
        ));
    }
}

/// The share of the force that each node of the load's group takes; together 1.
fn shares(load: &LoadFile, key: &str, place: MeshedGroups<'_>, findings: &mut Findings) -> Option<BTreeMap<u32, f64>> {
    let group = place.groups.find(&load.group, key, findings)?;
    let [points, lines, surfaces, _] = &group.cells;
    if lines.is_empty() && (!surfaces.is_empty() || points.is_empty() && group.nodes.is_empty()) {
        let found = format!("{:?}, which holds {}", load.group, group.in_words());
        findings.not_allowed(key, found, "a group of lines or points for a force");
        return None;
    }
    if lines.is_empty() {
        let nodes = place.nodes(&load.group, key, findings);
        if nodes.len() > 2 {
            findings.warnings.push(format!(
                "{key} {:?}: {} nodes share the force evenly, which is no uniform traction; a group of lines would make it one",
                load.group,
                nodes.len()
            ));
        }
        let share = 1.0 / nodes.len() as f64;
        return (!nodes.is_empty()).then(|| nodes.into_iter().map(|node| (node, share)).collect());
    }
    let sides: Option<BTreeMap<[u32; 2], Edge>> = lines
        .iter()
        .map(|&line| place.line_side(place.groups.cell(line).1).map(|side| (side.edge.ends, side.edge)))
        .collect();
    let Some(sides) = sides else {
        let found = format!("{:?}, lines of which are the side of no element of a body", load.group);
        findings.not_allowed(key, found, "lines along the elements of a body");
        return None;
    };
    let edges: Vec<Edge> = sides.into_values().collect();
    let mut unit = vec![0.0; place.meshed.solid.dofs()];
    add_spread_force(&place.meshed.solid, &edges, Vector2::x(), &mut unit);
    Some(edges.iter().flat_map(|edge| edge.nodes()).map(|node| (node, unit[2 * node as usize])).collect())
}
