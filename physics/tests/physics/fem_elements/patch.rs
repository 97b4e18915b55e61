//! What every element must do exactly: rigid motions without force, constant strain on any mesh.

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::loads::add_traction;
use gearwear_fem::solid::ElementKind;
use gearwear_fem::stiffness::Stiffness;
use gearwear_fem::stress::StressRecovery;
use nalgebra::{Vector2, Vector3};

use super::common::{STEEL, field, hold, largest, nodes_of, solve};
use super::meshes::{Block, KINDS, block, push_corners};

const RUBBER: Elastic = Elastic { young_modulus_mpa: 10.0, poisson_ratio: 0.499 };
const ANALYSES: [Analysis; 2] = [Analysis::PlaneStrain, Analysis::PlaneStress];

/// Distorted by a quarter of a cell.
fn distorted(kind: ElementKind) -> Block {
    let mut block = block(kind, 4, 3, |u, v| Vector2::new(4.0 * u, 3.0 * v));
    push_corners(&mut block, 0.25);
    block
}

#[test]
fn ver_rigid_motions_give_no_force() {
    for kind in KINDS {
        for analysis in ANALYSES {
            for material in [STEEL, RUBBER] {
                let solid = distorted(kind).solid;
                let stiffness = Stiffness::new(&solid, &[material], analysis).unwrap();
                let scale = largest(stiffness.matrix().lower().data());
                let motions = [
                    field(&solid, |_| Vector2::new(1.0, 0.0)),
                    field(&solid, |_| Vector2::new(0.0, 1.0)),
                    field(&solid, |x| Vector2::new(-x.y, x.x)),
                ];
                for motion in motions {
                    let force = largest(&stiffness.matrix().multiply(&motion));
                    assert!(force < 1e-12 * scale * largest(&motion), "{kind:?} {analysis:?} {force:e} of {scale:e}");
                }
            }
        }
    }
}

/// u = H x with strains of about 1e-3.
fn linear(x: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(1e-3 * x.x + 4e-4 * x.y, -2e-4 * x.x + 7e-4 * x.y)
}

/// (ε_x, ε_y, γ_xy) of [`linear`].
const STRAIN: Vector3<f64> = Vector3::new(1e-3, 7e-4, 2e-4);

/// Every kind, analysis and material, on the distorted mesh.
fn each(mut check: impl FnMut(&Block, Analysis, Elastic, &str)) {
    for kind in KINDS {
        let block = distorted(kind);
        for analysis in ANALYSES {
            for material in [STEEL, RUBBER] {
                check(&block, analysis, material, &format!("{kind:?} {analysis:?} nu {}", material.poisson_ratio));
            }
        }
    }
}

fn assert_same(u: &[f64], exact: &[f64], tolerance: f64, name: &str) {
    let error = u.iter().zip(exact).map(|(u, e)| (u - e).abs()).fold(0.0, f64::max) / largest(exact);
    println!("{name}: {error:.1e}");
    assert!(error < tolerance, "{name}: {error:e}");
}

/// A linear field given on the border must come out inside, with its stress at every node.
#[test]
fn ver_constant_strain_from_given_displacements() {
    each(|block, analysis, material, name| {
        let solid = &block.solid;
        let exact = field(solid, linear);
        let given = hold(&nodes_of(block.sides.iter().flatten()), &exact);
        assert!(given.len() < solid.dofs(), "nothing is left to solve for");
        let u = solve(solid, material, analysis, &given, vec![0.0; solid.dofs()]);
        assert_same(&u, &exact, 1e-12, name);

        let stress = material.stiffness_mpa(analysis) * STRAIN;
        let across = material.across_mpa(analysis, stress.x, stress.y);
        let materials = [material];
        let recovery = StressRecovery::new(solid, &materials, analysis).unwrap();
        for own in recovery.nodal_stresses(&u).unwrap() {
            let own = [own.sigma_x_mpa, own.sigma_y_mpa, own.tau_xy_mpa, own.sigma_z_mpa];
            let exact = [stress.x, stress.y, stress.z, across];
            let error = largest(&[0, 1, 2, 3].map(|i| own[i] - exact[i])) / largest(&exact);
            // At nu = 0.499 the pressure is 1/(1 - 2 nu) = 500 times the strain's rounding.
            let tolerance = if material == STEEL { 1e-12 } else { 1e-10 };
            assert!(error < tolerance, "{name}: {own:?} {exact:?} {error:e}");
        }
    });
}

/// The same with the stress of the field as traction on the border, and supports that only keep the block in place. For
/// rubber rounding in the solution grows with 1/(1 − 2ν) = 500, so the forces are compared instead.
#[test]
fn ver_constant_strain_from_given_tractions() {
    each(|block, analysis, material, name| {
        let solid = &block.solid;
        let exact = field(solid, linear);
        let stress = material.stiffness_mpa(analysis) * STRAIN;
        let traction =
            |_, n: Vector2<f64>| Vector2::new(stress.x * n.x + stress.z * n.y, stress.z * n.x + stress.y * n.y);
        let mut forces = vec![0.0; solid.dofs()];
        for side in &block.sides {
            add_traction(solid, side, analysis, traction, &mut forces);
        }
        let stiffness = Stiffness::new(solid, &[material], analysis).unwrap();
        let scale = largest(stiffness.matrix().lower().data()) * largest(&exact);
        let unbalanced: Vec<f64> =
            stiffness.matrix().multiply(&exact).iter().zip(&forces).map(|(own, f)| own - f).collect();
        assert!(largest(&unbalanced) < 1e-12 * scale, "{name}: {:e}", largest(&unbalanced) / scale);

        if material == STEEL {
            let first = block.sides[0][0].ends[0];
            let last = block.sides[0][block.sides[0].len() - 1].ends[1];
            let given = [2 * first, 2 * first + 1, 2 * last + 1].map(|dof| (dof, exact[dof as usize]));
            let u = solve(solid, material, analysis, &given, forces);
            assert_same(&u, &exact, 1e-12, name);
        }
    });
}

/// The same steel block in mm, N, MPa and in m, N, Pa: displacements differ by the factor alone.
#[test]
fn ver_units_do_not_matter() {
    for kind in KINDS {
        let of = |unit: f64| {
            let mut block = distorted(kind);
            for point in &mut block.solid.points_mm {
                *point *= unit;
            }
            let solid = &block.solid;
            // Force per length: N/mm to N/m; modulus: N/mm2 to N/m2.
            let material = Elastic { young_modulus_mpa: STEEL.young_modulus_mpa / (unit * unit), ..STEEL };
            let mut forces = vec![0.0; solid.dofs()];
            let traction = Vector2::new(20.0, -100.0) / (unit * unit);
            add_traction(solid, &block.sides[1], Analysis::PlaneStrain, |_, _| traction, &mut forces);
            let given = hold(&nodes_of(&block.sides[3]), &vec![0.0; solid.dofs()]);
            solve(solid, material, Analysis::PlaneStrain, &given, forces)
        };
        let (mm, m) = (of(1.0), of(1e-3));
        let scaled: Vec<f64> = m.iter().map(|u| u * 1e3).collect();
        assert_same(&scaled, &mm, 1e-9, &format!("{kind:?}"));
    }
}
