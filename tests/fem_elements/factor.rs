//! Factorisation: the same bits again, and supports that do not hold.

use gearwear::fem::elastic::{Analysis, Elastic};
use gearwear::fem::factor::{Factor, FactorError};
use gearwear::fem::solid::ElementKind;
use gearwear::fem::stiffness::Stiffness;
use nalgebra::Vector2;

use crate::meshes::{bent_square, block};

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
const BRASS: Elastic = Elastic { young_modulus_mpa: 100e3, poisson_ratio: 0.35 };

#[test]
fn ver_new_values_reuse_the_analysis_and_give_the_same_bits() {
    let block = block(ElementKind::Quad8, 12, 9, bent_square);
    let mut held = vec![false; block.solid.dofs()];
    for edge in &block.sides[0] {
        for node in edge.ends {
            held[2 * node as usize] = true;
            held[2 * node as usize + 1] = true;
        }
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
