//! Displacement and stress of the teeth that may touch, at their places in the mesh.
//!
//! Each tooth's displacement follows from the forces on its flank and from those of its cuts, in the tooth's own frame; the
//! pinion besides turns by δ/r_b1, which closes the flanks. TeethInMesh side by side share the nodes of the cut between them.

use nalgebra::{Rotation2, Vector2};

use crate::results::fem_pair::{ContactPlace, PairSolution};
use crate::results::fem_problem::NodalStress;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::model::{MeshedGear, solid};
use gearwear_bodies::gear_fem::placement::{in_place_mm, tooth_angle_rad};
use gearwear_bodies::gear_fem::position::PositionContact;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::element::ElementError;
use gearwear_fem::solid::{Element, Solid};
use gearwear_fem::stress::StressRecovery;

/// Nodes and elements of both gears' teeth at their places, with the displacement of each node.
#[derive(Default)]
struct TeethInMesh {
    solid: Solid,
    pair_of_element: Vec<i32>,
    displacement_mm: Vec<Vector2<f64>>,
}

/// Solution at the position of `found`.
pub(super) fn solution(
    model: &CondensedPair<'_>,
    meshed: &PerGear<MeshedGear>,
    material: &PerGear<Elastic>,
    found: &PositionContact,
) -> Result<PairSolution, ElementError> {
    let mut teeth = TeethInMesh::default();
    let mut contacts = Vec::new();
    for (gear, material) in Gear::BOTH.into_iter().zip(0..) {
        let numbers = teeth.add(model, &meshed[gear], material, found);
        if gear == Gear::Pinion {
            contacts = contact_places(model, &teeth, &numbers, found);
        }
    }
    let displacement: Vec<f64> = teeth.displacement_mm.iter().flat_map(|u| [u.x, u.y]).collect();
    let materials = [material.pinion, material.wheel];
    let stress = StressRecovery::new(&teeth.solid, &materials, Analysis::PlaneStrain)?
        .nodal_stresses(&displacement)?
        .into_iter()
        .map(|stress| NodalStress {
            components_MPa: [stress.sigma_x_mpa, stress.sigma_y_mpa, stress.sigma_z_mpa, stress.tau_xy_mpa],
            von_mises_MPa: stress.von_mises_mpa(),
        })
        .collect();
    Ok(PairSolution {
        position_mm: found.position_mm,
        points_mm: teeth.solid.points_mm.iter().map(|p| [p.x, p.y]).collect(),
        elements: teeth.solid.elements,
        pair_of_element: teeth.pair_of_element,
        displacement_mm: teeth.displacement_mm.iter().map(|u| [u.x, u.y]).collect(),
        stress,
        contacts,
    })
}

impl TeethInMesh {
    /// Adds the fine teeth of a gear, clockwise to anticlockwise; returns for each the numbers of its sector's nodes here.
    fn add(
        &mut self,
        model: &CondensedPair<'_>,
        meshed: &MeshedGear,
        material: u16,
        found: &PositionContact,
    ) -> Vec<Vec<u32>> {
        let gear = meshed.gear;
        let (compliance, forces) = (&model.gears[gear], &found.forces[gear]);
        let sector = solid(&meshed.fine);
        let mut numbers: Vec<Vec<u32>> = Vec::new();
        for tooth in 0..compliance.teeth() {
            let pair = pair_of_tooth(gear, tooth, compliance.teeth());
            let turn = Rotation2::new(tooth_angle_rad(model.pair, gear, found.position_mm, pair));
            let cuts = compliance.cut_displacement_mm(tooth, forces);
            let moved = compliance.sector.displacement_mm(&forces[tooth], &cuts);
            let mut own: Vec<Option<u32>> = vec![None; sector.points_mm.len()];
            if let Some(before) = numbers.last() {
                for (&right, &left) in meshed.fine.right_cut.iter().zip(&meshed.fine.left_cut) {
                    own[right as usize] = Some(before[left as usize]);
                }
            }
            let own: Vec<u32> = own
                .into_iter()
                .enumerate()
                .map(|(node, number)| {
                    number.unwrap_or_else(|| {
                        let point = in_place_mm(model.pair, gear, found.position_mm, pair, sector.points_mm[node]);
                        let elastic = turn * Vector2::new(moved[2 * node], moved[2 * node + 1]);
                        self.push(point, elastic + rigid(model, gear, point, found.transmission_error_mm))
                    })
                })
                .collect();
            for element in &sector.elements {
                let nodes: Vec<u32> = element.nodes().iter().map(|&node| own[node as usize]).collect();
                self.solid.elements.push(Element::new(element.kind, &nodes, material));
                self.pair_of_element.push(pair);
            }
            numbers.push(own);
        }
        numbers
    }

    fn push(&mut self, point_mm: Vector2<f64>, displacement_mm: Vector2<f64>) -> u32 {
        self.solid.points_mm.push(point_mm);
        self.displacement_mm.push(displacement_mm);
        (self.solid.points_mm.len() - 1) as u32
    }
}

/// Number of the pair of a fine tooth, teeth counted from clockwise to anticlockwise: the pair ahead is the next anticlockwise
/// tooth of the pinion, and the next clockwise one of the wheel.
fn pair_of_tooth(gear: Gear, tooth: usize, teeth: usize) -> i32 {
    let from_middle = tooth as i32 - (teeth / 2) as i32;
    match gear {
        Gear::Pinion => from_middle,
        Gear::Wheel => -from_middle,
    }
}

/// Displacement by the pinion's rotation; the wheel is held.
fn rigid(model: &CondensedPair<'_>, gear: Gear, point_mm: Vector2<f64>, transmission_error_mm: f64) -> Vector2<f64> {
    match gear {
        Gear::Pinion => {
            let r_b = model.pair.path.involute.pinion.base_radius_mm;
            Vector2::new(-point_mm.y, point_mm.x) * (transmission_error_mm / r_b)
        }
        Gear::Wheel => Vector2::zeros(),
    }
}

/// Contact of each pair, where its resultant acts on the deformed pinion.
fn contact_places(
    model: &CondensedPair<'_>,
    teeth: &TeethInMesh,
    numbers: &[Vec<u32>],
    found: &PositionContact,
) -> Vec<ContactPlace> {
    let contacts = found.pairs.iter();
    contacts
        .filter_map(|contact| {
            Some(ContactPlace {
                pair: contact.pair,
                at_mm: resultant_mm(model, teeth, numbers, found, contact.pair)?.into(),
                half_width_mm: contact.half_width_mm,
                peak_pressure_MPa: contact.peak_pressure_mpa,
                at_sharp_edge: contact.at_sharp_edge,
            })
        })
        .collect()
}

/// Point of action of a pair's resultant on the deformed pinion, mm; none without load.
fn resultant_mm(
    model: &CondensedPair<'_>,
    teeth: &TeethInMesh,
    numbers: &[Vec<u32>],
    found: &PositionContact,
    pair: i32,
) -> Option<Vector2<f64>> {
    let compliance = &model.gears.pinion;
    let tooth = usize::try_from(pair + (compliance.teeth() / 2) as i32).ok()?;
    let candidates = &compliance.sector.sector.candidates;
    let (mut sum, mut moment) = (0.0, Vector2::zeros());
    for force in found.forces.pinion.get(tooth)?.chunk_by(|a, b| a.0 / 2 == b.0 / 2) {
        let number = numbers.get(tooth)?[candidates[force[0].0 / 2] as usize] as usize;
        let size = force.iter().fold(0.0_f64, |size, (_, f)| size.hypot(*f));
        sum += size;
        moment += size * (teeth.solid.points_mm[number] + teeth.displacement_mm[number]);
    }
    (sum > 0.0).then(|| moment / sum)
}
