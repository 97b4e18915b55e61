//! Factorisation: compliances, and supports that do not hold.

use gearwear_fem::elastic::Analysis;
use gearwear_fem::factor::{Factor, FactorError};
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_fem::stiffness::Stiffness;
use nalgebra::Vector2;

use super::common::{STEEL, nodes_of};
use super::meshes::{bent_square, block};

#[test]
fn bodies_that_can_move_are_refused() {
    let block = block(ElementKind::Quad4, 3, 3, |u, v| Vector2::new(1e3 + u, v));
    let stiffness = Stiffness::new(&block.solid, &[STEEL], Analysis::PlaneStress).unwrap();
    let held_at = |dofs: &[usize]| {
        let mut held = vec![false; block.solid.dofs()];
        for dof in dofs {
            held[*dof] = true;
        }
        Factor::new(&stiffness, &held).map(|_| ())
    };
    assert_eq!(held_at(&[]).unwrap_err(), FactorError::Unsupported { node: 0, held: 0 });
    // A pin alone: it turns. Three rollers through one point, or all along one direction: it turns or slides.
    assert_eq!(held_at(&[0, 1]).unwrap_err(), FactorError::Unsupported { node: 0, held: 2 });
    assert_eq!(held_at(&[1, 3, 5, 7]).unwrap_err(), FactorError::Unsupported { node: 0, held: 4 });
    held_at(&[0, 1, 3]).unwrap();
}

/// Two squares that share one corner: held alone, the first leaves the second to turn about it.
#[test]
fn a_hinge_is_not_a_support() {
    let points_mm = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]];
    let solid = Solid {
        points_mm: points_mm.map(|x| Vector2::new(x[0], x[1])).to_vec(),
        elements: vec![
            Element::new(ElementKind::Quad4, &[0, 1, 2, 3], 0),
            Element::new(ElementKind::Quad4, &[2, 4, 5, 6], 0),
        ],
    };
    let stiffness = Stiffness::new(&solid, &[STEEL], Analysis::PlaneStrain).unwrap();
    let mut held = vec![false; solid.dofs()];
    held[..4].fill(true);
    assert_eq!(Factor::new(&stiffness, &held).err(), Some(FactorError::Unsupported { node: 0, held: 4 }));
    held[2 * 5] = true;
    assert!(Factor::new(&stiffness, &held).is_ok());
}

/// The compliance of forces with few entries is what full solutions make of them.
#[test]
fn ver_compliance_agrees_with_full_solutions() {
    let block = block(ElementKind::Quad8, 14, 11, bent_square);
    let dofs = block.solid.dofs();
    let mut held = vec![false; dofs];
    for node in nodes_of(&block.sides[0]) {
        held[2 * node as usize] = true;
        held[2 * node as usize + 1] = true;
    }
    let stiffness = Stiffness::new(&block.solid, &[STEEL], Analysis::PlaneStrain).unwrap();
    let factor = Factor::new(&stiffness, &held).unwrap();
    // Single forces, couples of distant nodes, one entry twice, one on a held node, one column of nothing.
    let surface = nodes_of(block.sides[1].iter().chain(&block.sides[2]));
    let mut columns: Vec<Vec<(u32, f64)>> = Vec::new();
    for (k, node) in surface.iter().enumerate() {
        columns.push(vec![(2 * node, 1.0)]);
        let other = surface[(7 * k + 3) % surface.len()];
        columns.push(vec![(2 * node + 1, 0.5), (2 * other, -0.25), (2 * node + 1, 0.5)]);
    }
    columns.push(vec![(2 * block.sides[0][0].ends[0], 1.0), (2 * surface[0], 1.0)]);
    columns.push(vec![]);
    assert!(columns.len() > 64, "{}", columns.len());
    let mut full = vec![0.0; columns.len() * dofs];
    for (column, x) in columns.iter().zip(full.chunks_mut(dofs)) {
        for (dof, force) in column {
            x[*dof as usize] += force;
        }
    }
    factor.solve(columns.len(), &mut full);
    let scale = super::common::largest(&full);
    let compliance = factor.compliance(&columns);
    for (j, x) in full.chunks(dofs).enumerate() {
        for (i, column) in columns.iter().enumerate() {
            let along: f64 =
                column.iter().filter(|(dof, _)| !held[*dof as usize]).map(|(dof, f)| f * x[*dof as usize]).sum();
            assert!((compliance[(i, j)] - along).abs() < 1e-12 * scale, "{i} {j}");
            assert_eq!(compliance[(i, j)], compliance[(j, i)]);
        }
    }
}
