//! Supports, given displacements and forces, on the nodes of their groups.

use std::collections::{BTreeMap, BTreeSet};

use super::file::{Component, FemProblemFile, LoadFile};
use super::meshed_groups::{MeshedBodies, MeshedGroups};
use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_fem::problem::Held;

/// Given displacements by degree of freedom, each with the table that gives it.
struct Given<'a, B> {
    by_dof: BTreeMap<u32, (f64, String)>,
    place: MeshedGroups<'a, B>,
}

/// All supports and given displacements, no degree of freedom twice.
pub(super) fn held(
    file: &FemProblemFile,
    place: MeshedGroups<'_, impl MeshedBodies>,
    findings: &mut Findings,
) -> Vec<Held> {
    let mut given = Given { by_dof: BTreeMap::new(), place };
    for (i, fixed) in file.fixed.iter().enumerate() {
        let nodes = place.nodes(&fixed.group, &format!("fixed[{i}].group"), findings);
        let components = fixed.components.as_deref().unwrap_or_default();
        given.add(&nodes, components, &[0.0; 3], &format!("fixed[{i}]"), findings);
    }
    for (i, load) in file.load.iter().enumerate() {
        let Some(displacement_mm) = &load.displacement_mm else { continue };
        let nodes = place.nodes(&load.group, &format!("load[{i}].group"), findings);
        let components = load.components.as_deref().unwrap_or_default();
        given.add(&nodes, components, displacement_mm, &format!("load[{i}]"), findings);
    }
    given.by_dof.into_iter().map(|(dof, (displacement_mm, _))| Held { dof, displacement_mm }).collect()
}

impl<B: MeshedBodies> Given<'_, B> {
    /// Adds the displacement of the nodes of `table`; reports a different one from another table.
    fn add(
        &mut self,
        nodes: &[u32],
        components: &[Component],
        displacement_mm: &[f64],
        table: &str,
        findings: &mut Findings,
    ) {
        for &node in nodes {
            for component in components {
                let value = displacement_mm[component.index()];
                let dof = dof::<B>(node, *component);
                match self.by_dof.get(&dof) {
                    Some((other, earlier)) if *other != value => {
                        let found = format!(
                            "the displacement {} mm along {} at the node {}, to which {earlier} gives {} mm",
                            number(value),
                            component.name(),
                            self.place.place(node),
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

/// The degree of freedom of a node along `component`.
fn dof<B: MeshedBodies>(node: u32, component: Component) -> u32 {
    B::DIRECTIONS as u32 * node + component.index() as u32
}

/// Nodal forces of all loads, one for each degree of freedom: N/mm in the plane, N in space.
pub(super) fn forces<B: MeshedBodies>(
    file: &FemProblemFile,
    place: MeshedGroups<'_, B>,
    held: &[Held],
    findings: &mut Findings,
) -> Vec<f64> {
    let held: BTreeSet<u32> = held.iter().map(|held| held.dof).collect();
    let mut forces = vec![0.0; B::DIRECTIONS * place.bodies.nodes().points_mm.len()];
    for (i, load) in file.load.iter().enumerate() {
        let Some((key, force)) = load.force() else { continue };
        let Some(shares) = shares(load, &format!("load[{i}].group"), place, findings) else { continue };
        for (&component, &force) in Component::ALL.iter().zip(force) {
            let is_held = |node: &u32| held.contains(&dof::<B>(*node, component));
            let lost: f64 = shares.iter().filter(|(node, _)| is_held(node)).map(|(_, share)| share).sum();
            if force != 0.0 {
                let all = shares.keys().all(is_held);
                say_what_is_lost(load, &format!("load[{i}]"), key, (component, lost, all), findings);
            }
            for (&node, share) in &shares {
                forces[dof::<B>(node, component) as usize] += share * force;
            }
        }
    }
    forces
}

/// Reports forces on held nodes, which go into the support: an error where all of the force does, else a warning.
fn say_what_is_lost(
    load: &LoadFile,
    table: &str,
    key: &str,
    (component, lost, all): (Component, f64, bool),
    findings: &mut Findings,
) {
    let (group, along) = (&load.group, component.name());
    if all {
        let found = format!("a force along {along} on {group:?}, every node of which is held along {along}");
        let allowed = "a force on nodes that can move, or displacement_mm";
        findings.not_allowed(&format!("{table}.{key}"), found, allowed);
    } else if lost != 0.0 {
        findings.warnings.push(format!(
            "{table}: {:.2} % of the force along {along} acts on nodes of {group:?} that are held along {along}, and goes straight into \
             their support",
            100.0 * lost
        ));
    }
}

/// The share of the force that each node of the load's group takes; together 1.
fn shares<B: MeshedBodies>(
    load: &LoadFile,
    key: &str,
    place: MeshedGroups<'_, B>,
    findings: &mut Findings,
) -> Option<BTreeMap<u32, f64>> {
    let group = place.groups.find(&load.group, key, findings)?;
    let carriers = &group.cells[B::DIRECTIONS - 1];
    if carriers.is_empty() {
        let is_nothing = group.cells[0].is_empty() && group.nodes.is_empty();
        if is_nothing || group.cells[1..].iter().any(|cells| !cells.is_empty()) {
            let found = format!("{:?}, which holds {}", load.group, group.in_words());
            findings.not_allowed(key, found, format!("a group of {} or points for a force", B::CARRIER));
            return None;
        }
        let nodes = place.nodes(&load.group, key, findings);
        if nodes.len() > B::DIRECTIONS {
            findings.warnings.push(format!(
                "{key} {:?}: {} nodes share the force evenly, which is no uniform traction; a group of {} would make it one",
                load.group,
                nodes.len(),
                B::CARRIER
            ));
        }
        let share = 1.0 / nodes.len() as f64;
        return (!nodes.is_empty()).then(|| nodes.into_iter().map(|node| (node, share)).collect());
    }
    let shares = place.bodies.spread(carriers.iter().map(|&cell| place.groups.cell(cell).1));
    if shares.is_none() {
        let found = format!("{:?}, {} of which are the {} of no element of a body", load.group, B::CARRIER, B::PART);
        findings.not_allowed(key, found, B::PARTS);
    }
    shares
}
