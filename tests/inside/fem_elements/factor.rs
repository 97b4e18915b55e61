//! Factorisation: the same bits again, and supports that do not hold.

use gearwear::fem::elastic::{Analysis, Elastic};
use gearwear::fem::factor::{Factor, FactorError};
use gearwear::fem::solid::{Element, ElementKind, Solid};
use gearwear::fem::stiffness::Stiffness;
use nalgebra::Vector2;

use super::common::{STEEL, nodes_of};
use super::meshes::{bent_square, block};

const BRASS: Elastic = Elastic { young_modulus_mpa: 100e3, poisson_ratio: 0.35 };

#[test]
fn ver_new_values_reuse_the_analysis_and_give_the_same_bits() {
    let block = block(ElementKind::Quad8, 12, 9, bent_square);
    let mut held = vec![false; block.solid.dofs()];
    for node in nodes_of(&block.sides[0]) {
        held[2 * node as usize] = true;
        held[2 * node as usize + 1] = true;
    }
    let fresh = Stiffness::new(&block.solid, &[BRASS], Analysis::PlaneStrain).unwrap();
    let mut again = Stiffness::new(&block.solid, &[STEEL], Analysis::PlaneStrain).unwrap();
    let mut reused = Factor::new(&again, &held).unwrap();
    again.reassemble(&block.solid, &[BRASS]).unwrap();
    assert_eq!(again.lower(), fresh.lower());
    reused.refactor(&again).unwrap();
    let new = Factor::new(&fresh, &held).unwrap();
    assert_eq!((reused.analyses(), reused.factorisations()), (1, 2));
    let force: Vec<f64> = (0..3 * block.solid.dofs()).map(|i| (i as f64).sin()).collect();
    let (mut u, mut v) = (force.clone(), force);
    reused.solve(3, &mut u);
    new.solve(3, &mut v);
    assert_eq!(u, v);
}

#[test]
fn bodies_that_can_move_are_refused() {
    let block = block(ElementKind::Quad4, 3, 3, |u, v| Vector2::new(1e3 + u, v));
    let stiffness = Stiffness::new(&block.solid, &[STEEL], Analysis::PlaneStress).unwrap();
    let held_at = |dofs: &[usize]| {
        let mut held = vec![false; block.solid.dofs()];
        for dof in dofs {
            held[*dof] = true;
        }
        Factor::new(&stiffness, &held).map(|factor| factor.free_dofs())
    };
    assert_eq!(held_at(&[]).unwrap_err(), FactorError::Unsupported { node: 0, held: 0 });
    // A pin alone: it turns. Three rollers through one point, or all along one direction: it turns or slides.
    assert_eq!(held_at(&[0, 1]).unwrap_err(), FactorError::Unsupported { node: 0, held: 2 });
    assert_eq!(held_at(&[1, 3, 5, 7]).unwrap_err(), FactorError::Unsupported { node: 0, held: 4 });
    assert_eq!(held_at(&[0, 1, 3]).unwrap(), 29);
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
    assert_eq!(Factor::new(&stiffness, &held).map(|factor| factor.free_dofs()).ok(), Some(9));
}

/// Right-hand sides of few entries give what full ones give, and their compliance what their product is.
#[test]
fn ver_sparse_right_hand_sides_agree_with_full_ones() {
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

    let wanted: Vec<u32> = (0..dofs as u32).rev().step_by(3).collect();
    let sparse = factor.solve_sparse(&columns, &wanted);
    let compliance = factor.compliance(&columns);
    for (j, x) in full.chunks(dofs).enumerate() {
        for (i, dof) in wanted.iter().enumerate() {
            assert!((sparse[(i, j)] - x[*dof as usize]).abs() < 1e-12 * scale);
        }
        for (i, column) in columns.iter().enumerate() {
            let along: f64 =
                column.iter().filter(|(dof, _)| !held[*dof as usize]).map(|(dof, f)| f * x[*dof as usize]).sum();
            assert!((compliance[(i, j)] - along).abs() < 1e-12 * scale, "{i} {j}");
            assert_eq!(compliance[(i, j)], compliance[(j, i)]);
        }
    }
}
