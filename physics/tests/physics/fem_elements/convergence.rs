//! Orders of convergence in L2 on a manufactured solution: 2 for linear, 3 for quadratic elements, nearly incompressible or
//! not.
//!
//! The field is the curl of a stream function and a small part that changes volume,
//!
//! ```text
//! u = (sin πx cos πy, −cos πx sin πy) + (1 − 2ν)(x² y, x y²)        f = −div σ(u)
//! ```
//!
//! so that its pressure λ div u stays bounded as ν → ½; f follows by differentiation, with σ = λ div u I + 2 μ ε:
//! f = −(λ + μ) ∇ div u − μ Δu.

use std::f64::consts::PI;

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::loads::add_body_force;
use gearwear_fem::solid::ElementKind;
use nalgebra::Vector2;

use super::common::{field, figures, hold, l2_error, nodes_of, order, solve};
use super::meshes::{KINDS, bent_square, block, is_quadratic, push_corners};

fn exact(nu: f64, x: Vector2<f64>) -> Vector2<f64> {
    let (sx, cx, sy, cy) = ((PI * x.x).sin(), (PI * x.x).cos(), (PI * x.y).sin(), (PI * x.y).cos());
    let bulk = 1.0 - 2.0 * nu;
    Vector2::new(sx * cy + bulk * x.x * x.x * x.y, -cx * sy + bulk * x.x * x.y * x.y)
}

fn body_force(material: Elastic, x: Vector2<f64>) -> Vector2<f64> {
    let nu = material.poisson_ratio;
    let mu = material.young_modulus_mpa / (2.0 * (1.0 + nu));
    let lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
    let (sx, cx, sy, cy) = ((PI * x.x).sin(), (PI * x.x).cos(), (PI * x.y).sin(), (PI * x.y).cos());
    let bulk = 1.0 - 2.0 * nu;
    // div u = bulk · 4 x y; Δ of the curl part is −2π² times itself, of the other bulk · 2 (y, x).
    let gradient = Vector2::new(x.y, x.x) * (4.0 * bulk);
    let laplacian = Vector2::new(sx * cy, -cx * sy) * (-2.0 * PI * PI) + Vector2::new(x.y, x.x) * (2.0 * bulk);
    -gradient * (lambda + mu) - laplacian * mu
}

/// Error on a mesh of n × n cells, displacements given all round.
fn error(kind: ElementKind, n: usize, nu: f64, bent: bool) -> f64 {
    let material = Elastic { young_modulus_mpa: 200.0, poisson_ratio: nu };
    let mesh = if bent {
        block(kind, n, n, bent_square)
    } else {
        let mut mesh = block(kind, n, n, Vector2::new);
        push_corners(&mut mesh, 0.15 / n as f64);
        mesh
    };
    let solid = &mesh.solid;
    let mut forces = vec![0.0; solid.dofs()];
    add_body_force(solid, Analysis::PlaneStrain, |x| body_force(material, x), &mut forces);
    let nodal = field(solid, |x| exact(nu, x));
    let given = hold(&nodes_of(mesh.sides.iter().flatten()), &nodal);
    let u = solve(solid, material, Analysis::PlaneStrain, &given, forces);
    l2_error(solid, &u, |x| exact(nu, x))
}

fn check(nu: f64, bent: bool) {
    let mut failures = Vec::new();
    for kind in KINDS {
        let wanted = if is_quadratic(kind) { 3.0 } else { 2.0 };
        let errors: Vec<f64> = [8, 16, 32, 64].into_iter().map(|n| error(kind, n, nu, bent)).collect();
        let order = order(&errors);
        println!(
            "{kind:?} nu {nu} {}: order {order:.3}, errors {}",
            if bent { "bent" } else { "pushed" },
            figures(&errors)
        );
        // A slope over finite meshes comes near the order from either side.
        if order < wanted - 0.1 {
            failures.push(format!("{kind:?}: {order:.3}"));
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn ver_l2_order_on_smoothly_bent_meshes() {
    check(0.3, true);
}

#[test]
fn ver_l2_order_on_meshes_with_every_corner_pushed() {
    check(0.3, false);
}

#[test]
fn ver_l2_order_nearly_incompressible() {
    check(0.499, true);
}

#[test]
fn ver_l2_order_nearly_incompressible_with_every_corner_pushed() {
    check(0.499, false);
}
