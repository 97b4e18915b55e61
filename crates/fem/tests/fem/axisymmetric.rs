//! Bodies of revolution against closed forms.

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::loads::add_traction;
use gearwear_fem::problem::{Held, Problem};
use gearwear_fem::solid::{ElementKind, Solid};
use gearwear_fem::stress::{NodalStress, StressRecovery};
use gearwear_fem::{SolveError, solve};
use nalgebra::Vector2;

use super::common::assert_close;
use super::common::grid::{CylinderOnBlock, Grid};

const KINDS: [ElementKind; 5] =
    [ElementKind::Triangle3, ElementKind::Triangle6, ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9];

fn lines(from: f64, to: f64, count: u32) -> Vec<f64> {
    (0..=count).map(|k| from + (to - from) * f64::from(k) / f64::from(count)).collect()
}

fn held(nodes: Vec<u32>, component: u32, displacement_mm: f64) -> impl Iterator<Item = Held> {
    nodes.into_iter().map(move |node| Held { dof: 2 * node + component, displacement_mm })
}

fn stresses(problem: &Problem, displacement_mm: &[f64]) -> Vec<NodalStress> {
    let recovery = StressRecovery::new(&problem.solid, &problem.materials, problem.analysis).unwrap();
    recovery.nodal_stresses(displacement_mm).unwrap()
}

/// A thick cylinder from a = 10 to b = 20 mm under p = 100 MPa inside, its ends held along the axis:
///
/// ```text
/// A = p a²/(b² − a²)    σ_r = A (1 − b²/r²)    σ_θ = A (1 + b²/r²)    u = (1 + ν)/E · A ((1 − 2ν) r + b²/r)
/// ```
///
/// S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity* (1970), section 28 (Lamé).
#[test]
fn val_thick_cylinder_of_lame() {
    let (a, b, p, e) = (10.0, 20.0, 100.0, 210e3);
    let scale = p * a * a / (b * b - a * a);
    for kind in KINDS {
        for nu in [0.3, 0.4999] {
            // Linear triangles lock as ν → ½.
            if kind == ElementKind::Triangle3 && nu > 0.4 {
                continue;
            }
            let mut solid = Solid::default();
            let grid = Grid::add(&mut solid, kind, 0, (&lines(a, b, 24), &lines(0.0, 2.0, 4)), Vector2::new);
            let mut forces = vec![0.0; solid.dofs()];
            add_traction(&solid, &grid.left(), Analysis::Axisymmetric, |_, n| -n * p, &mut forces);
            let total: f64 = forces.iter().step_by(2).sum();
            assert_close("pressure on the whole bore", total, p * 2.0 * std::f64::consts::PI * a * 2.0, 1e-12);
            let ends = held(grid.bottom_nodes(), 1, 0.0).chain(held(grid.top_nodes(), 1, 0.0));
            let problem = Problem {
                analysis: Analysis::Axisymmetric,
                materials: vec![Elastic { young_modulus_mpa: e, poisson_ratio: nu }],
                held: ends.collect(),
                forces_n_per_mm: forces,
                solid,
                ..Problem::default()
            };
            let found = solve(&problem).unwrap();
            assert!(found.force_balance < 1e-9 && found.residual < 1e-8, "{kind:?} {nu}");
            let displacement = |r: f64| (1.0 + nu) / e * scale * ((1.0 - 2.0 * nu) * r + b * b / r);
            for (nodes, r) in [(grid.left_nodes(), a), (grid.right_nodes(), b)] {
                for node in nodes {
                    let moved = found.displacement_mm[2 * node as usize];
                    assert_close(&format!("{kind:?} nu {nu} u({r})"), moved, displacement(r), 2e-3);
                }
            }
            let quadratic = !matches!(kind, ElementKind::Triangle3 | ElementKind::Quad4);
            let tolerance = if quadratic && nu < 0.4 {
                0.004
            } else if quadratic {
                0.03
            } else {
                0.06
            };
            for stress in stresses(&problem, &found.displacement_mm) {
                let r = problem.solid.points_mm[stress.node as usize].x;
                let radial = scale * (1.0 - b * b / (r * r));
                let hoop = scale * (1.0 + b * b / (r * r));
                let off = (stress.sigma_x_mpa - radial).abs().max((stress.sigma_z_mpa - hoop).abs());
                assert!(off < tolerance * hoop.max(p), "{kind:?} nu {nu} at {r}: {stress:?}, not {radial} and {hoop}");
            }
        }
    }
}

/// A full cylinder, drawn out by 0.001 along its axis: σ_z = E ε and nothing else, also on the axis; u_r = −ν ε r.
#[test]
fn ver_uniform_tension_is_exact_up_to_the_axis() {
    for kind in KINDS {
        let mut solid = Solid::default();
        let grid = Grid::add(&mut solid, kind, 0, (&lines(0.0, 3.0, 3), &lines(0.0, 2.0, 2)), Vector2::new);
        let held = held(grid.bottom_nodes(), 1, 0.0).chain(held(grid.top_nodes(), 1, 0.002));
        let held = held.chain(self::held(grid.left_nodes(), 0, 0.0));
        let problem = Problem {
            analysis: Analysis::Axisymmetric,
            materials: vec![Elastic { young_modulus_mpa: 210e3, poisson_ratio: 0.3 }],
            held: held.collect(),
            forces_n_per_mm: vec![0.0; solid.dofs()],
            solid,
            ..Problem::default()
        };
        let found = solve(&problem).unwrap();
        for node in grid.right_nodes() {
            assert_close("contraction", found.displacement_mm[2 * node as usize], -0.3 * 0.001 * 3.0, 1e-9);
        }
        for stress in stresses(&problem, &found.displacement_mm) {
            assert_close("tension", stress.sigma_y_mpa, 210.0, 1e-9);
            let rest = [stress.sigma_x_mpa, stress.sigma_z_mpa, stress.tau_xy_mpa].map(f64::abs);
            assert!(rest.into_iter().fold(0.0, f64::max) < 1e-7, "{kind:?}: {stress:?}");
        }
    }
}

/// A ball of R = 50 mm (210 GPa) on a block (70 GPa):
///
/// ```text
/// a = (¾ F R/E*)^⅓        p₀ = 3 F/(2π a²)        p(r) = p₀ √(1 − r²/a²)
/// ```
///
/// K. L. Johnson, *Contact Mechanics* (1985), section 4.2.
#[test]
fn val_ball_on_a_block_of_hertz() {
    let force = 40e3;
    let modulus = 1.0 / (0.91 / 210e3 + 0.91 / 70e3);
    let a = f64::cbrt(0.75 * force * 50.0 / modulus);
    let peak = 1.5 * force / (std::f64::consts::PI * a * a);
    for kind in KINDS {
        for cylinder_is_slave in [true, false] {
            let mut case = CylinderOnBlock::nafems(kind, 10.0);
            case.half_width_mm = a;
            case.cylinder_is_slave = cylinder_is_slave;
            let mut problem = case.problem();
            problem.analysis = Analysis::Axisymmetric;
            let top: Vec<_> = {
                let r = |node: u32| problem.solid.points_mm[node as usize];
                let edges = if cylinder_is_slave { &problem.contacts[0].slave } else { &problem.contacts[0].master };
                edges.iter().flat_map(|edge| edge.ends).filter(|&node| (r(node).y - 50.0).abs() < 1e-9).collect()
            };
            problem.forces_n_per_mm.fill(0.0);
            // A ring load at the rim of the hemisphere, far from the contact.
            problem.forces_n_per_mm[2 * top[0] as usize + 1] = -force;
            let found = solve(&problem).unwrap();
            let contact = &found.contacts[0];
            let name = format!("{kind:?} {cylinder_is_slave}");
            let linear = matches!(kind, ElementKind::Triangle3 | ElementKind::Quad4);
            let (of_pressure, of_width) = if linear { (0.05, 0.015) } else { (0.004, 0.01) };
            assert_close(&format!("force {name}"), contact.force_n_per_mm.y.abs(), force, 1e-9);
            assert_close(&format!("pressure {name}"), contact.peak_pressure_mpa, peak, of_pressure);
            assert_close(&format!("half-width {name}"), contact.half_width_mm, a, of_width);
            assert!(found.force_balance < 1e-9);
            for node in &contact.nodes {
                let exact = peak * (1.0 - (node.at_mm.x / a).powi(2)).max(0.0).sqrt();
                let inside = (node.at_mm.x / a - 1.0).abs() > 0.15;
                assert!(!inside || (node.pressure_mpa - exact).abs() < 0.05 * peak, "{name}: {node:?}, not {exact}");
            }
        }
    }
}

/// Along the radius nothing needs a support, along the axis it does.
#[test]
fn only_the_motion_along_the_axis_needs_a_support() {
    let mut solid = Solid::default();
    Grid::add(&mut solid, ElementKind::Quad4, 0, (&lines(1.0, 2.0, 1), &lines(0.0, 1.0, 1)), Vector2::new);
    let problem = Problem {
        analysis: Analysis::Axisymmetric,
        materials: vec![Elastic { young_modulus_mpa: 210e3, poisson_ratio: 0.3 }],
        forces_n_per_mm: vec![0.0; solid.dofs()],
        solid,
        ..Problem::default()
    };
    let Err(SolveError::Floating { motion }) = solve(&problem) else { panic!("it floats") };
    assert!(motion.contains("moves freely along (0.000, 1.000)"), "{motion}");
    let held = Problem { held: held(vec![0], 1, 0.5).collect(), ..problem };
    let found = solve(&held).unwrap();
    // It moves as a whole, without forces to balance.
    assert_eq!((found.force_balance, found.residual), (0.0, 0.0));
    assert!(found.displacement_mm.iter().skip(1).step_by(2).all(|v| (v - 0.5).abs() < 1e-12));
}
