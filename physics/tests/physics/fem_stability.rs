//! The contact solver far from the comfortable: stiff on soft, nearly incompressible, other units, floating bodies, sharp
//! edges, hollows, and problems without an answer. Each case prints a row.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use gearwear_bodies::reference::hertz_line::{HertzLine, LineContact};
use gearwear_bodies::reference::persson::Persson;
use gearwear_fem::problem::{Problem, Solution};
use gearwear_fem::solid::{ElementKind, Solid};
use gearwear_fem::{SolveError, solve};
use nalgebra::{Rotation2, Vector2};

use super::common::fe_case::{even, graded_around, hold, in_units, nearest, pair, press, problem, renumbered, weld};
use super::common::grid::{CylinderOnBlock, Grid, graded};

const EVERYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const KINDS: [ElementKind; 5] =
    [ElementKind::Triangle3, ElementKind::Quad4, ElementKind::Triangle6, ElementKind::Quad8, ElementKind::Quad9];

fn row(case: &str, solution: &Solution, errors: &str) {
    let peak = solution.contacts.iter().map(|contact| contact.peak_pressure_mpa).fold(0.0, f64::max);
    println!(
        "{case:44} {:3} its, {} cycles, residual {:.0e}, balance {:.0e}, p {peak:.5e}, {errors}",
        solution.work.iterations, solution.work.cycles_broken, solution.residual, solution.force_balance
    );
}

/// Forces balance, and nothing pulls.
fn assert_sound(case: &str, solution: &Solution, tolerance: f64) {
    assert!(solution.residual < tolerance, "{case}: residual {}", solution.residual);
    assert!(solution.force_balance < 1e-8, "{case}: balance {}", solution.force_balance);
    for contact in &solution.contacts {
        for node in &contact.nodes {
            assert!(node.pressure_mpa >= -1e-9 * contact.peak_pressure_mpa, "{case}: {node:?}");
        }
    }
}

/// Errors within these bounds; the linear triangle's peak, which is on a symmetry line, is only printed.
fn assert_close(case: &str, kind: ElementKind, [peak, half_width]: [f64; 2], bounds: [f64; 2]) {
    assert!(peak.abs() < bounds[0] || kind == ElementKind::Triangle3, "{case} {kind:?}: peak off by {peak}");
    assert!(half_width.abs() < bounds[1], "{case} {kind:?}: half-width off by {half_width}");
}

fn contact_modulus(young_modulus_mpa: [f64; 2], nu: f64) -> f64 {
    1.0 / young_modulus_mpa.iter().map(|e| (1.0 - nu * nu) / e).sum::<f64>()
}

/// A cylinder on a block graded for the half-width that Hertz gives it.
fn regraded(case: CylinderOnBlock) -> (CylinderOnBlock, LineContact) {
    let modulus = contact_modulus(case.young_modulus_mpa, case.poisson_ratio);
    let hertz = HertzLine::of_relative_radius(case.radius_mm, modulus).loaded(2.0 * case.force_n_per_mm);
    (CylinderOnBlock { half_width_mm: hertz.half_width_mm, ..case }, hertz)
}

/// The NAFEMS cylinder under the load that gives Hertz a half-width of `half_width_mm`.
fn cylinder(kind: ElementKind, young_modulus_mpa: [f64; 2], nu: f64, half_width_mm: f64) -> CylinderOnBlock {
    let nafems = CylinderOnBlock::nafems(kind, 8.0);
    let force = PI * contact_modulus(young_modulus_mpa, nu) * half_width_mm.powi(2) / (4.0 * nafems.radius_mm);
    CylinderOnBlock { young_modulus_mpa, poisson_ratio: nu, force_n_per_mm: 0.5 * force, half_width_mm, ..nafems }
}

/// Solves, prints, checks soundness; relative errors of peak pressure and half-width against Hertz.
fn against_hertz(name: &str, case: CylinderOnBlock) -> [f64; 2] {
    let (case, hertz) = regraded(case);
    let solution = solve(&case.problem()).expect("a cylinder on a block touches");
    let contact = &solution.contacts[0];
    let errors =
        [contact.peak_pressure_mpa / hertz.peak_pressure_mpa - 1.0, contact.half_width_mm / hertz.half_width_mm - 1.0];
    let name = format!("{:?} {name}", case.kind);
    row(&name, &solution, &format!("Hertz: p {:+.3} %, a {:+.3} %", 100.0 * errors[0], 100.0 * errors[1]));
    // Rounding of the stiff body's rigid displacement, times its stiffness, against forces that the soft one sets.
    let ratio = case.young_modulus_mpa[0] / case.young_modulus_mpa[1];
    // Likewise of the volume strain: bulk over shear modulus goes with 1/(1 − 2ν).
    let incompressible = 0.4 / (1.0 - 2.0 * case.poisson_ratio);
    assert_sound(&name, &solution, 1e-9 * ratio.max(1.0 / ratio).max(10.0) * incompressible.max(1.0));
    errors
}

#[test]
fn val_modulus_ratio() {
    for kind in KINDS {
        for ratio in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            let errors = against_hertz(&format!("E1/E2 = {ratio:e}"), cylinder(kind, [70e3 * ratio, 70e3], 0.3, 1.0));
            assert_close("modulus ratio", kind, errors, [0.005, 0.015]);
        }
    }
}

#[test]
fn val_nearly_incompressible() {
    for kind in KINDS {
        for nu in [0.3, 0.45, 0.49, 0.499, 0.4999] {
            let errors = against_hertz(&format!("nu = {nu}"), cylinder(kind, [210e3, 70e3], nu, 1.0));
            // Above, the peak of the quadratic triangle drifts away: see docs/fem-gear-pair.md.
            if nu <= 0.45 || !matches!(kind, ElementKind::Triangle3 | ElementKind::Triangle6) {
                assert_close("nearly incompressible", kind, errors, [0.005, 0.015]);
            }
        }
    }
}

#[test]
fn val_load() {
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for factor in [1e-4, 1e-2, 0.1, 1.0, 10.0] {
            let nafems = CylinderOnBlock::nafems(kind, 8.0);
            let case = CylinderOnBlock { force_n_per_mm: factor * nafems.force_n_per_mm, ..nafems };
            let errors = against_hertz(&format!("NAFEMS load x {factor:e}"), case);
            // Tenfold, the half-width is 0.4 R, where neither Hertz nor linear kinematics hold.
            if factor <= 1.0 {
                assert_close("load", kind, errors, [0.003, 0.01]);
            }
        }
    }
}

#[test]
fn val_mesh_ratio_and_sides() {
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for (mesh_ratio, elements_per_half_width) in [(1.0, 8.0), (20.0, 80.0), (0.05, 4.0)] {
            for cylinder_is_slave in [true, false] {
                let side = if cylinder_is_slave { "cylinder" } else { "block" };
                let case = CylinderOnBlock {
                    mesh_ratio,
                    elements_per_half_width,
                    cylinder_is_slave,
                    ..cylinder(kind, [210e3, 70e3], 0.3, 1.0)
                };
                let errors = against_hertz(&format!("block:cylinder mesh {mesh_ratio}, slave {side}"), case);
                // A linear slave twenty times finer than its master feels the master's facets: p peaks at each of its nodes.
                let finer = if cylinder_is_slave { mesh_ratio > 1.0 } else { mesh_ratio < 1.0 };
                if kind != ElementKind::Quad4 || !finer {
                    assert_close("mesh ratio", kind, errors, [0.01, 0.06]);
                }
            }
        }
    }
}

/// Load and moduli together, and lengths, only change the units of the answer.
#[test]
fn ver_units() {
    for kind in KINDS {
        let problem = cylinder(kind, [210e3, 70e3], 0.3, 1.0).problem();
        let reference = solve(&problem).expect("touches");
        // Stress × 1e±6 at the same lengths; then metres with N/m² and N/m.
        for (length, stress) in [(1.0, 1e6), (1.0, 1e-6), (1e-3, 1e6)] {
            let scaled = solve(&in_units(&problem, length, stress * length, stress)).expect("touches");
            let mut worst = 0.0_f64;
            let greatest = reference.displacement_mm.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
            for (a, b) in scaled.displacement_mm.iter().zip(&reference.displacement_mm) {
                worst = worst.max((a / length - b).abs() / greatest);
            }
            let (found, wanted) = (&scaled.contacts[0], &reference.contacts[0]);
            for (a, b) in found.nodes.iter().zip(&wanted.nodes) {
                worst = worst.max((a.pressure_mpa / stress - b.pressure_mpa).abs() / wanted.peak_pressure_mpa);
            }
            worst = worst.max((found.half_width_mm / length / wanted.half_width_mm - 1.0).abs());
            row(
                &format!("{kind:?} lengths x {length:e}, stress x {stress:e}"),
                &scaled,
                &format!("change {worst:.0e}"),
            );
            assert!(worst < 1e-9, "{kind:?} {length} {stress}: {worst}");
        }
    }
}

/// The right half of a disc of radius 50 mm around (0, `centre`) with a small hole, fine at the angles `fine` (from −π/2,
/// the bottom). Returns the grid: `right()` is its outside, `left_nodes()` the hole, `bottom_nodes()` and `top_nodes()` lie
/// on the line of symmetry.
fn half_disc(solid: &mut Solid, kind: ElementKind, material: u16, centre: f64, angles: &[f64], step: f64) -> Grid {
    const R: f64 = 50.0;
    let radii: Vec<f64> = graded(R, 0.02 * R, step, 4.0 * step, 1.3).into_iter().rev().collect();
    Grid::add(solid, kind, material, (&radii, angles), |r, angle| {
        Vector2::new(r * angle.cos(), centre + r * angle.sin())
    })
}

/// A disc of 50 mm in a hole of 50.5 and of 50.05 mm.
#[test]
fn val_nearly_conforming() {
    const E: f64 = 210e3;
    const NU: f64 = 0.3;
    for (clearance, half_angle) in [(0.5, 10.0_f64), (0.5, 30.0), (0.05, 30.0)] {
        let persson = Persson::of_half_angle(half_angle.to_radians());
        let load = E / (1.0 - NU * NU) * clearance / persson.stiffness_ratio();
        for kind in [ElementKind::Quad4, ElementKind::Quad8] {
            for n in [6.0, 12.0, 24.0] {
                let mut solid = Solid::default();
                let epsilon = half_angle.to_radians();
                let step = epsilon / n;
                let angles: Vec<f64> =
                    graded(0.0, PI, step, 1.3 * epsilon, 1.3).into_iter().map(|angle| angle - FRAC_PI_2).collect();
                let disc = half_disc(&mut solid, kind, 0, 50.0, &angles, 50.0 * step);
                let r = 50.0 + clearance;
                let radii = graded(r, 1000.0, r * step, 4.0 * r * step, 1.3);
                let plate = Grid::add(&mut solid, kind, 0, (&radii, &angles), |radius, angle| {
                    Vector2::new(radius * angle.cos(), r + radius * angle.sin())
                });
                let mut problem = problem(solid, &[(E, NU)]);
                for grid in [&disc, &plate] {
                    hold(&mut problem, &grid.bottom_nodes(), 0, 0.0);
                    hold(&mut problem, &grid.top_nodes(), 0, 0.0);
                }
                hold(&mut problem, &plate.right_nodes(), 1, 0.0);
                let hole = disc.left_nodes();
                for &node in &hole {
                    let share = Vector2::new(0.0, -0.5 * load / hole.len() as f64);
                    super::common::fe_case::push(&mut problem, node, share);
                }
                problem.contacts = vec![pair(&disc.right(), &plate.left())];
                let solution = solve(&problem).expect("the disc lies in the hole");
                let contact = &solution.contacts[0];
                let p = contact.peak_pressure_mpa / (persson.pressure_ratio(0.0) * load / 50.0) - 1.0;
                let a = contact.half_width_mm / (50.0 * epsilon) - 1.0;
                let name = format!("{kind:?} hollow {r}, {half_angle} deg, {n} elements");
                row(&name, &solution, &format!("Persson: p {:+.2} %, a {:+.2} %", 100.0 * p, 100.0 * a));
                assert_sound(&name, &solution, 1e-8);
                assert_close(&name, kind, [p, a], [0.01, 0.03]);
            }
        }
    }
}

/// A flat rigid punch of half-width 1 on a half-plane: p = P/(π √(1 − x²)); Johnson (1985), section 2.8.
#[test]
fn val_flat_punch() {
    const P: f64 = 100.0;
    for kind in KINDS {
        for punch_is_slave in [true, false] {
            for n in [8.0, 16.0] {
                let mut solid = Solid::default();
                let h = 1.0 / n;
                let punch_u: Vec<f64> = graded(1.0, 0.0, h / 4.0, h, 1.2).into_iter().rev().collect();
                let punch = Grid::add(&mut solid, kind, 0, (&punch_u, &even(0.0, 1.0, 6)), Vector2::new);
                let across = {
                    // The corner of the punch falls inside an edge.
                    let mut lines: Vec<f64> = graded(1.0 + 0.1 * h, 0.0, h / 4.0, h, 1.2).into_iter().rev().collect();
                    lines.extend(graded(1.0 + 0.1 * h, 200.0, h / 4.0, h, 1.3).into_iter().skip(1));
                    lines
                };
                let down: Vec<f64> = graded(0.0, -200.0, h / 4.0, h, 1.3).into_iter().rev().collect();
                let block = Grid::add(&mut solid, kind, 1, (&across, &down), Vector2::new);
                let mut problem = problem(solid, &[(70e9, 0.3), (70e3, 0.3)]);
                hold(&mut problem, &punch.left_nodes(), 0, 0.0);
                hold(&mut problem, &block.left_nodes(), 0, 0.0);
                hold(&mut problem, &block.bottom_nodes(), 1, 0.0);
                press(&mut problem, &punch.top(), 0.5 * P, Vector2::x(), EVERYWHERE);
                let (low, high) = (block.top(), punch.bottom());
                problem.contacts = vec![if punch_is_slave { pair(&high, &low) } else { pair(&low, &high) }];
                let solution = solve(&problem).expect("the punch is pressed on");
                let contact = &solution.contacts[0];
                let at = |x: f64| interpolated(contact, x);
                let exact = |x: f64| P / (PI * (1.0 - x * x).sqrt());
                let name = format!("{kind:?} punch, slave {}, {n}", if punch_is_slave { "punch" } else { "block" });
                let errors = [0.0, 0.5].map(|x| 100.0 * (at(x) / exact(x) - 1.0));
                row(
                    &name,
                    &solution,
                    &format!(
                        "p(0) {:+.2} %, p(a/2) {:+.2} %, a {:.4}, edge singular",
                        errors[0], errors[1], contact.half_width_mm
                    ),
                );
                // As for a modulus ratio of 1e6.
                assert_sound(&name, &solution, 1e-3);
                if n == 16.0 {
                    assert!(errors.iter().all(|error| error.abs() < 1.5), "{name}: {errors:?}");
                }
            }
        }
    }
}

/// Pressure at x, drawn straight between the nodes.
fn interpolated(contact: &gearwear_fem::problem::ContactState, x: f64) -> f64 {
    let mut nodes: Vec<(f64, f64)> = contact.nodes.iter().map(|node| (node.at_mm.x, node.pressure_mpa)).collect();
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let after = nodes.partition_point(|node| node.0 < x).clamp(1, nodes.len() - 1);
    let [(x0, p0), (x1, p1)] = [nodes[after - 1], nodes[after]];
    p0 + (p1 - p0) * (x - x0) / (x1 - x0)
}

/// A block that stands on its sharp lower corner, tilted by 10 degrees, and is pushed down by a hundredth of a mm.
#[test]
fn contact_starts_at_a_corner() {
    for kind in KINDS {
        let mut forces = Vec::new();
        for n in [1, 2, 4] {
            let mut solid = Solid::default();
            let turn = Rotation2::new(10.0_f64.to_radians());
            let lines: Vec<f64> = graded(0.0, 10.0, 0.02 / n as f64, 0.2, 1.3);
            let upper = Grid::add(&mut solid, kind, 0, (&lines, &lines), |u, v| turn * Vector2::new(u, v));
            let across = graded_around(-20.0, 20.0, 0.0, 0.023 / n as f64, 0.2);
            let down: Vec<f64> = graded(0.0, -20.0, 0.023 / n as f64, 0.1, 1.3).into_iter().rev().collect();
            let lower = Grid::add(&mut solid, kind, 0, (&across, &down), Vector2::new);
            let mut problem = problem(solid, &[(210e3, 0.3)]);
            for component in [0, 1] {
                hold(&mut problem, &lower.bottom_nodes(), component, 0.0);
            }
            hold(&mut problem, &upper.top_nodes(), 0, 0.0);
            hold(&mut problem, &upper.top_nodes(), 1, -0.01);
            let mut slave = upper.left();
            slave.extend(upper.bottom());
            problem.contacts = vec![pair(&slave, &lower.top())];
            let solution = solve(&problem).expect("the corner touches");
            let force = solution.contacts[0].force_n_per_mm;
            let name = format!("{kind:?} corner, {n}");
            row(&name, &solution, &format!("force {:.4} {:.4}", force.x, force.y));
            assert_sound(&name, &solution, 1e-8);
            forces.push(force.y);
        }
    }
}

/// A body with two bumps 20 mm apart on a block: the loads on each by the lever rule.
#[test]
fn val_two_zones_share_by_the_lever() {
    const LOAD: f64 = 100.0;
    for kind in KINDS {
        for offset in [0.0, 4.0, -7.0] {
            let mut solid = Solid::default();
            let mut lines = graded_around(-20.0, 0.0, -10.0, 0.1, 0.6);
            lines.extend(graded_around(0.0, 20.0, 10.0, 0.1, 0.6).into_iter().skip(1));
            let bump = |u: f64| 0.5 * (1.0 + (PI * u / 10.0).cos());
            let upper = Grid::add(&mut solid, kind, 0, (&lines, &graded(0.0, 8.0, 0.1, 0.3, 1.4)), |u, v| {
                Vector2::new(u, v + bump(u) * (1.0 - v / 8.0))
            });
            let down: Vec<f64> = graded(0.0, -20.0, 0.1, 0.3, 1.4).into_iter().rev().collect();
            let lower = Grid::add(&mut solid, kind, 0, (&lines, &down), |u, v| Vector2::new(1.001 * u, v));
            let mut problem = problem(solid, &[(210e3, 0.3)]);
            for component in [0, 1] {
                hold(&mut problem, &lower.bottom_nodes(), component, 0.0);
            }
            let loaded = nearest(&problem.solid, Vector2::new(offset, 8.0));
            let at = problem.solid.points_mm[loaded as usize];
            hold(&mut problem, &[loaded], 0, 0.0);
            super::common::fe_case::push(&mut problem, loaded, Vector2::new(0.0, -LOAD));
            let bottom = upper.bottom();
            let (left, right) = bottom.split_at(bottom.len() / 2);
            problem.contacts = vec![pair(left, &lower.top()), pair(right, &lower.top())];
            let solution = solve(&problem).expect("two bumps stand");
            let [a, b] = [0, 1].map(|k| &solution.contacts[k]);
            let lever = LOAD * (b.centre_mm.x - at.x) / (b.centre_mm.x - a.centre_mm.x);
            let error = a.force_n_per_mm.y / lever - 1.0;
            let name = format!("{kind:?} two bumps, load at {:.2}", at.x);
            row(&name, &solution, &format!("left {:.5}, lever {error:+.1e}", a.force_n_per_mm.y));
            assert_sound(&name, &solution, 1e-8);
            assert!(error.abs() < 1e-3, "{name}: {error}");
            assert!((a.force_n_per_mm.y + b.force_n_per_mm.y - LOAD).abs() < 1e-7 * LOAD);
        }
    }
}

/// A disc between two blocks, all floating but for the lower one; the blocks `gap` away.
fn disc_between_blocks(kind: ElementKind, gap: f64) -> Problem {
    const FORCE: f64 = 500.0;
    let mut solid = Solid::default();
    let step = 0.1;
    let mut angles = graded(-FRAC_PI_2, 0.0, step / 50.0, 1.5 / 50.0, 1.3);
    angles.extend(graded(FRAC_PI_2, 0.0, step / 50.0, 1.5 / 50.0, 1.3).into_iter().rev().skip(1));
    let disc = half_disc(&mut solid, kind, 0, 50.0, &angles, step);
    let across = graded(0.0, 100.0, step, 1.5, 1.3);
    let down: Vec<f64> = graded(0.0, -100.0, step, 0.5, 1.3).into_iter().rev().collect();
    let up = graded(0.0, 100.0, step, 0.5, 1.3);
    let lower = Grid::add(&mut solid, kind, 0, (&across, &down), |u, v| Vector2::new(u, v - gap));
    let upper = Grid::add(&mut solid, kind, 0, (&across, &up), |u, v| Vector2::new(u, 100.0 + gap + v));
    let mut problem = problem(solid, &[(210e3, 0.3)]);
    for nodes in [disc.bottom_nodes(), disc.top_nodes(), lower.left_nodes(), upper.left_nodes()] {
        hold(&mut problem, &nodes, 0, 0.0);
    }
    hold(&mut problem, &lower.bottom_nodes(), 1, 0.0);
    press(&mut problem, &upper.top(), FORCE / 100.0, Vector2::x(), EVERYWHERE);
    problem.contacts = vec![pair(&disc.right(), &lower.top()), pair(&disc.right(), &upper.bottom())];
    problem
}

#[test]
fn val_disc_floats_between_blocks() {
    for kind in KINDS {
        for gap in [1.0, 0.0, -1e-3] {
            let solution = solve(&disc_between_blocks(kind, gap)).expect("the blocks close on the disc");
            let hertz = HertzLine::of_relative_radius(50.0, contact_modulus([210e3; 2], 0.3)).loaded(1000.0);
            let errors: Vec<f64> = solution
                .contacts
                .iter()
                .map(|contact| 100.0 * (contact.peak_pressure_mpa / hertz.peak_pressure_mpa - 1.0))
                .collect();
            let name = format!("{kind:?} disc between blocks, gap {gap}");
            row(&name, &solution, &format!("Hertz: p {:+.2} %, {:+.2} %", errors[0], errors[1]));
            assert_sound(&name, &solution, 1e-8);
            // Linear kinematics turn no normals: closing the gap costs a relative error of the order of gap/R.
            let bound = if gap > 0.0 { 3.0 } else { 0.3 };
            assert!(errors.iter().all(|error| error.abs() < bound) || kind == ElementKind::Triangle3, "{name}");
            for contact in &solution.contacts {
                assert!(
                    (contact.force_n_per_mm.y.abs() / 500.0 - 1.0).abs() < 1e-7,
                    "{name}: {:?}",
                    contact.force_n_per_mm
                );
            }
        }
    }
}

/// Two flat faces at ±45 degrees, fixed, that meet in the origin: a groove. Returns the faces.
fn groove(solid: &mut Solid, kind: ElementKind, held: &mut Vec<u32>) -> [Vec<gearwear_fem::problem::Edge>; 2] {
    [-FRAC_PI_4, FRAC_PI_4].map(|angle| {
        let turn = Rotation2::new(angle);
        // Along the face, away from the origin on either side, and the depth below it.
        let lines = graded_around(0.01, 100.0, 50.0, 0.2, 3.0);
        let lines: Vec<f64> = if angle < 0.0 { lines.iter().rev().map(|u| -u).collect() } else { lines };
        let down: Vec<f64> = graded(0.0, -40.0, 0.2, 1.0, 1.3).into_iter().rev().collect();
        let grid = Grid::add(solid, kind, 0, (&lines, &down), |u, v| turn * Vector2::new(u, v));
        held.extend(grid.bottom_nodes());
        grid.top()
    })
}

/// A square with one corner down in the groove, pushed down off its middle: W/√2 on each face.
#[test]
fn val_square_in_a_groove() {
    for kind in KINDS {
        let mut solid = Solid::default();
        let mut held = Vec::new();
        let [left, right] = groove(&mut solid, kind, &mut held);
        let turn = Rotation2::new(FRAC_PI_4);
        let lines = even(0.0, 60.0, 40);
        // Its lower sides lie 1e-3 mm above the faces.
        let square = Grid::add(&mut solid, kind, 0, (&lines, &lines), |u, v| {
            turn * Vector2::new(u, v) + Vector2::new(0.0, 1e-3)
        });
        let mut problem = problem(solid, &[(210e3, 0.3)]);
        for component in [0, 1] {
            hold(&mut problem, &held, component, 0.0);
        }
        let loaded = nearest(&problem.solid, Vector2::new(5.0, 50.0));
        super::common::fe_case::push(&mut problem, loaded, Vector2::new(0.0, -1000.0));
        problem.contacts = vec![pair(&square.left(), &left), pair(&square.bottom(), &right)];
        let solution = solve(&problem).expect("the groove holds the square");
        let wanted = 500.0;
        let [a, b] = [0, 1].map(|k| solution.contacts[k].force_n_per_mm);
        let name = format!("{kind:?} square in a groove");
        row(&name, &solution, &format!("forces {:.6?} {:.6?}", a.as_slice(), b.as_slice()));
        assert_sound(&name, &solution, 1e-8);
        for (found, sign) in [(a, 1.0), (b, -1.0)] {
            assert!((found - Vector2::new(sign * wanted, wanted)).norm() < 1e-6 * wanted, "{name}: {found:?}");
        }
    }
}

/// A whole disc around (0, `centre`), fine at the bottom between the angles ± `fine`; its outside edges.
fn disc(solid: &mut Solid, kind: ElementKind, centre: f64, fine: &[f64]) -> Vec<gearwear_fem::problem::Edge> {
    let radii: Vec<f64> = graded(50.0, 5.0, 0.2, 1.0, 1.3).into_iter().rev().collect();
    let grid =
        Grid::add(solid, kind, 0, (&radii, fine), |r, angle| Vector2::new(r * angle.sin(), centre - r * angle.cos()));
    let edges = grid.right();
    let number = weld(solid, 1e-9);
    renumbered(&edges, &number)
}

/// A disc that nothing but the groove holds against shifts, and one support against turning.
#[test]
fn val_disc_in_a_groove() {
    for kind in KINDS {
        for (supported, disc_is_slave) in [(true, true), (true, false), (false, true), (false, false)] {
            let mut solid = Solid::default();
            let angles = {
                let mut lines = graded_around(-PI, 0.0, -FRAC_PI_4, 0.004, 0.06);
                lines.extend(graded_around(0.0, PI, FRAC_PI_4, 0.004, 0.06).into_iter().skip(1));
                lines
            };
            let outside = disc(&mut solid, kind, 50.0 * std::f64::consts::SQRT_2 + 0.1, &angles);
            let mut held = Vec::new();
            let faces = groove(&mut solid, kind, &mut held);
            let mut problem = problem(solid, &[(210e3, 0.3)]);
            for component in [0, 1] {
                hold(&mut problem, &held, component, 0.0);
            }
            // Above the centre a shift to the side is held: it holds the disc's turning, the groove its shifts.
            let top = nearest(&problem.solid, Vector2::new(0.0, 50.0 * std::f64::consts::SQRT_2 + 50.1));
            if supported {
                hold(&mut problem, &[top], 0, 0.0);
            }
            super::common::fe_case::push(&mut problem, top, Vector2::new(0.0, -1000.0));
            problem.contacts = faces
                .iter()
                .map(|face| if disc_is_slave { pair(&outside, face) } else { pair(face, &outside) })
                .collect();
            let name = format!("{kind:?} disc in a groove, support {supported}, slave disc {disc_is_slave}");
            match solve(&problem) {
                Ok(solution) => {
                    let [a, b] = [0, 1].map(|k| solution.contacts[k].force_n_per_mm);
                    row(&name, &solution, &format!("forces {:.4?} {:.4?}", a.as_slice(), b.as_slice()));
                    assert_sound(&name, &solution, 1e-8);
                    assert!((a.y.abs() / 500.0 - 1.0).abs() < 1e-5 && (b.y.abs() / 500.0 - 1.0).abs() < 1e-5, "{name}");
                    // The normals of the disc do not turn while it sinks by 0.14 mm.
                    assert!((a.x.abs() / 500.0 - 1.0).abs() < 0.005, "{name}");
                }
                Err(error) => {
                    println!("{name}: {error}");
                    // All normals of the disc go through its centre.
                    assert!(
                        !supported && disc_is_slave && error.to_string().contains("turns freely"),
                        "{name}: {error}"
                    );
                }
            }
        }
    }
}

/// A whole disc on a plane that nothing holds to the side, nor against turning.
#[test]
fn a_body_that_floats_for_ever_is_named() {
    for kind in KINDS {
        for disc_is_slave in [true, false] {
            for sideways in [0.0, 100.0] {
                let mut solid = Solid::default();
                let outside = disc(&mut solid, kind, 50.1, &graded_around(-PI, PI, 0.0, 0.004, 0.06));
                let across = graded_around(-100.0, 100.0, 0.0, 0.2, 3.0);
                let down: Vec<f64> = graded(0.0, -100.0, 0.2, 1.0, 1.3).into_iter().rev().collect();
                let block = Grid::add(&mut solid, kind, 0, (&across, &down), Vector2::new);
                let mut problem = problem(solid, &[(210e3, 0.3)]);
                for component in [0, 1] {
                    hold(&mut problem, &block.bottom_nodes(), component, 0.0);
                }
                let top = nearest(&problem.solid, Vector2::new(0.0, 100.1));
                super::common::fe_case::push(&mut problem, top, Vector2::new(sideways, -1000.0));
                problem.contacts =
                    vec![if disc_is_slave { pair(&outside, &block.top()) } else { pair(&block.top(), &outside) }];
                let error = solve(&problem).expect_err("nothing holds the disc");
                println!("{kind:?} slave disc {disc_is_slave} sideways {sideways}: {error}");
                let named = matches!(error, SolveError::Floating { .. });
                // Facets of linear elements resist turning just enough for the active set to hunt instead.
                let hunts =
                    disc_is_slave && sideways != 0.0 && matches!(kind, ElementKind::Triangle3 | ElementKind::Quad4);
                assert!(named || hunts, "{kind:?}: {error}");
            }
        }
    }
}

#[test]
fn no_contact_at_all_is_an_error() {
    let mut apart = CylinderOnBlock::nafems(ElementKind::Quad4, 3.0).problem();
    for force in &mut apart.forces_n_per_mm {
        *force = -*force;
    }
    match solve(&apart) {
        Err(error @ SolveError::Contact(_)) => println!("{error}"),
        other => panic!("a cylinder that is pulled off: {other:?}"),
    }
}
