//! What every element must do exactly: rigid motions without force, constant strain on any mesh.

use gearwear::fem::elastic::{Analysis, Elastic};
use gearwear::fem::factor::Factor;
use gearwear::fem::solid::{ElementKind, Solid};
use gearwear::fem::stiffness::Stiffness;
use nalgebra::Vector2;

use crate::meshes::{Block, KINDS, block, push_corners};

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
const RUBBER: Elastic = Elastic { young_modulus_mpa: 10.0, poisson_ratio: 0.499 };
const ANALYSES: [Analysis; 2] = [Analysis::PlaneStrain, Analysis::PlaneStress];

/// Distorted by a quarter of a cell.
fn distorted(kind: ElementKind) -> Block {
    let mut block = block(kind, 4, 3, |u, v| Vector2::new(4.0 * u, 3.0 * v));
    push_corners(&mut block, 0.25);
    block
}

fn field(solid: &Solid, of: impl Fn(Vector2<f64>) -> Vector2<f64>) -> Vec<f64> {
    solid.points_mm.iter().flat_map(|x| <[f64; 2]>::from(of(*x))).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

#[test]
fn ver_rigid_motions_give_no_force() {
    for kind in KINDS {
        for analysis in ANALYSES {
            for material in [STEEL, RUBBER] {
                let solid = distorted(kind).solid;
                let stiffness = Stiffness::new(&solid, &[material], analysis).unwrap();
                let scale = largest(stiffness.lower().data());
                let motions = [
                    field(&solid, |_| Vector2::new(1.0, 0.0)),
                    field(&solid, |_| Vector2::new(0.0, 1.0)),
                    field(&solid, |x| Vector2::new(-x.y, x.x)),
                ];
                for motion in motions {
                    let force = largest(&stiffness.multiply(&motion));
                    assert!(force < 1e-12 * scale * largest(&motion), "{kind:?} {analysis:?} {force:e} of {scale:e}");
                }
            }
        }
    }
}

/// A linear field given on the border must come out inside.
#[test]
fn ver_constant_strain_from_given_displacements() {
    for kind in KINDS {
        for analysis in ANALYSES {
            for material in [STEEL, RUBBER] {
                let block = distorted(kind);
                let solid = &block.solid;
                let exact = field(solid, |x| Vector2::new(1e-3 * x.x + 4e-4 * x.y, -2e-4 * x.x + 7e-4 * x.y));
                let stiffness = Stiffness::new(solid, &[material], analysis).unwrap();
                let mut held = vec![false; solid.dofs()];
                for edge in block.sides.iter().flatten() {
                    for node in edge.ends.into_iter().chain(edge.middle) {
                        held[2 * node as usize] = true;
                        held[2 * node as usize + 1] = true;
                    }
                }
                let given: Vec<(u32, f64)> =
                    (0..).zip(&exact).zip(&held).filter(|(_, held)| **held).map(|((dof, u), _)| (dof, *u)).collect();
                assert!(given.len() < solid.dofs(), "nothing is left to solve for");
                let factor = Factor::new(&stiffness, &held).unwrap();
                let mut u = vec![0.0; solid.dofs()];
                factor.subtract_held(&stiffness, &given, &mut u);
                factor.solve(1, &mut u);
                for (dof, value) in &given {
                    u[*dof as usize] = *value;
                }
                let error = u.iter().zip(&exact).map(|(u, e)| (u - e).abs()).fold(0.0, f64::max);
                assert!(error < 1e-12 * largest(&exact), "{kind:?} {analysis:?} {material:?} {error:e}");
            }
        }
    }
}
