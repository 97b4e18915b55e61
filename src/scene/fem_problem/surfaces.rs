//! The two surfaces of each `[[contact]]`: edges of elements with their body on the left.

use std::collections::{BTreeMap, BTreeSet};

use super::bodies::PlaneBodies;
use super::file::FemProblemFile;
use super::meshed_groups::{MeshedBodies, MeshedGroups};
use super::sides::BodySide;
use crate::scene::findings::Findings;
use gearwear_fem::problem::{ContactPair, Edge};

/// All pairs of surfaces.
pub(super) fn contacts(
    file: &FemProblemFile,
    place: MeshedGroups<'_, PlaneBodies>,
    findings: &mut Findings,
) -> Vec<ContactPair> {
    let mut slaves: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (i, contact) in file.contact.iter().enumerate() {
        let (slave_key, master_key) = (format!("contact[{i}].slave"), format!("contact[{i}].master"));
        let slave = surface(&contact.slave, &slave_key, place, findings);
        let master = surface(&contact.master, &master_key, place, findings);
        let [of_slave, of_master] =
            [&slave, &master].map(|edges| edges.iter().flat_map(|edge| edge.ends).collect::<BTreeSet<u32>>());
        let common = of_slave.intersection(&of_master).count();
        if common > 0 {
            let found = format!("{:?}, which shares {common} nodes with the slave {:?}", contact.master, contact.slave);
            let allowed = "a surface without nodes of the slave: bodies that may slide or part have nodes of their own";
            findings.not_allowed(&master_key, found, allowed);
        }
        if let Some(other) = slave.iter().find_map(|edge| slaves.get(&edge.ends)) {
            let found = format!("{:?}, edges of which are the slave of contact[{other}] too", contact.slave);
            let allowed = "edges that carry one contact pressure; they may be master several times";
            findings.not_allowed(&slave_key, found, allowed);
        }
        slaves.extend(slave.iter().map(|edge| (edge.ends, i)));
        pairs.push(ContactPair { slave, master });
    }
    pairs
}

/// The edges of the group that `key` names: its lines, or, of a set of nodes, the sides on the surface all of whose nodes
/// it holds.
fn surface(name: &str, key: &str, place: MeshedGroups<'_, PlaneBodies>, findings: &mut Findings) -> Vec<Edge> {
    let Some(group) = place.groups.find(name, key, findings) else { return Vec::new() };
    let lines = &group.cells[1];
    if lines.is_empty() {
        let held: BTreeSet<u32> = group.nodes.iter().filter_map(|&node| place.bodies.nodes().node(node)).collect();
        let edges = place.bodies.sides.surface().map(|side| side.edge);
        let edges: Vec<Edge> =
            edges.filter(|edge| edge.ends.iter().chain(&edge.middle).all(|node| held.contains(node))).collect();
        if edges.is_empty() {
            let found = format!("{name:?}, which holds {}", group.in_words());
            let allowed = "a group of lines, or a set of nodes that holds whole edges of a surface";
            findings.not_allowed(key, found, allowed);
        }
        return edges;
    }
    let mut edges: BTreeMap<[u32; 2], Edge> = BTreeMap::new();
    let (mut nowhere, mut inside) = (0, None);
    for &line in lines {
        match place.bodies.line_side(place.groups.cell(line).1) {
            None => nowhere += 1,
            Some(side) if !side.is_on_surface() => inside = Some((side, inside.map_or(0, |(_, count)| count) + 1)),
            Some(side) => {
                edges.insert(side.edge.ends, side.edge);
            }
        }
    }
    let allowed = "lines along the surface of a body";
    if nowhere > 0 {
        let found = format!("{name:?}, of which {nowhere} lines are the side of no element of a body");
        findings.not_allowed(key, found, allowed);
    }
    if let Some((side, count)) = inside {
        let found = format!("{name:?}, of which {count} lines lie {}", where_inside(side, place));
        findings.not_allowed(key, found, allowed);
        findings.help("bodies that may slide or part have nodes of their own along their surfaces");
    }
    edges.into_values().collect()
}

/// Inside which body a side lies, or between which two.
fn where_inside(side: &BodySide, place: MeshedGroups<'_, PlaneBodies>) -> String {
    match side.elements.map(|element| element.map(|number| place.bodies.solid.elements[number].material)) {
        [Some(one), Some(other)] if one != other => "between bodies that are joined there".to_owned(),
        _ => "inside a body".to_owned(),
    }
}
