//! Hexahedra of eight and of twenty nodes: shape functions, rigid motions, patches, a thick cylinder, bending, nearly incompressible materials.

use gearwear_fem::elastic::Elastic;
use gearwear_fem::factor::Factor;
use gearwear_fem::node_matrix::NodeMatrix;
use gearwear_fem::space::hexahedron::{HexahedronKind, HexahedronShape};
use gearwear_fem::space::{Hexahedron, nodal_stresses_mpa, stiffness};
use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3, Vector6};

use super::common::assert_close;

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
const KINDS: [HexahedronKind; 2] = [HexahedronKind::Eight, HexahedronKind::Twenty];

/// Elements of one kind and one material.
struct Solid {
    points_mm: Vec<Vector3<f64>>,
    elements: Vec<Vec<u32>>,
}

impl Solid {
    /// A box of cells [0, nx] × [0, ny] × [0, nz], each point moved by `to`.
    fn of_box(kind: HexahedronKind, [nx, ny, nz]: [usize; 3], to: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Self {
        let mut reference: Vec<Vector3<f64>> = Vec::new();
        let mut elements = Vec::new();
        for cell in 0..nx * ny * nz {
            let corner = [cell % nx, cell / nx % ny, cell / nx / ny].map(|k| k as f64);
            let node = |at: &[f64; 3]| {
                let point = Vector3::from_fn(|k, _| corner[k] + 0.5 * (at[k] + 1.0));
                let known = reference.iter().position(|other: &Vector3<f64>| (other - point).norm() < 1e-9);
                known.unwrap_or_else(|| {
                    reference.push(point);
                    reference.len() - 1
                }) as u32
            };
            elements.push(kind.reference_nodes().iter().map(node).collect());
        }
        Self { points_mm: reference.into_iter().map(to).collect(), elements }
    }

    fn elements<'a>(&'a self, material: &'a Elastic) -> impl Iterator<Item = Hexahedron<'a>> {
        self.elements.iter().map(move |nodes| Hexahedron { nodes, material })
    }

    fn stiffness(&self, material: &Elastic) -> NodeMatrix {
        stiffness(&self.points_mm, || self.elements(material)).unwrap()
    }

    /// Displacements under `force_n` where those of some degrees of freedom are given.
    fn solved(&self, material: &Elastic, given: impl Fn(usize) -> Option<f64>, force_n: &[f64]) -> Vec<f64> {
        let matrix = self.stiffness(material);
        let factor = Factor::of_held(&matrix, |dof| given(dof).is_some()).unwrap();
        let held: Vec<(u32, f64)> =
            (0..force_n.len()).filter_map(|dof| given(dof).map(|value| (dof as u32, value))).collect();
        let mut found = force_n.to_vec();
        factor.subtract_held(&matrix, &held, &mut found);
        factor.solve(1, &mut found);
        held.iter().for_each(|(dof, value)| found[*dof as usize] = *value);
        found
    }

    fn stresses_mpa(&self, material: &Elastic, displacement_mm: &[f64]) -> Vec<Vector6<f64>> {
        nodal_stresses_mpa(&self.points_mm, self.elements(material), displacement_mm).unwrap()
    }

    /// A displacement at every node.
    fn field(&self, of: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vec<f64> {
        self.points_mm.iter().flat_map(|point| <[f64; 3]>::from(of(point))).collect()
    }
}

/// No edge parallel to another, turned in space; edges are straight.
fn distorted(x: Vector3<f64>) -> Vector3<f64> {
    let turn = Rotation3::from_euler_angles(0.3, -0.4, 0.7);
    // Trilinear in each cell: only the corners' places count.
    let bump =
        |k: f64| 0.11 * (2.3 * x.x + 1.7 * k + 0.9).sin() * (1.3 * x.y + 0.4 * k).cos() + 0.06 * (2.9 * x.z + k).sin();
    turn * (Vector3::new(x.x, 0.8 * x.y, 1.1 * x.z) + Vector3::new(bump(0.0), bump(1.0), bump(2.0)))
}

/// The box with its corners distorted and the middles of edges halfway between them.
fn distorted_box(kind: HexahedronKind, cells: [usize; 3]) -> Solid {
    let mut solid = Solid::of_box(kind, cells, distorted);
    if kind == HexahedronKind::Twenty {
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
        for nodes in &solid.elements {
            for (k, ends) in ends.iter().enumerate() {
                let [a, b] = ends.map(|end| solid.points_mm[nodes[end] as usize]);
                solid.points_mm[nodes[8 + k] as usize] = 0.5 * (a + b);
            }
        }
    }
    solid
}

#[test]
fn ver_shape_functions_are_one_at_their_node_and_their_slopes_are_derivatives() {
    const H: f64 = 1e-5;
    for kind in KINDS {
        for (a, at) in kind.reference_nodes().iter().enumerate() {
            for (b, value) in HexahedronShape::at(kind, *at).values.iter().enumerate() {
                assert_eq!(*value, f64::from(u8::from(a == b)), "{kind:?} {a} {b}");
            }
        }
        let at = [0.21, 0.34, -0.47];
        let shape = HexahedronShape::at(kind, at);
        assert_close("sum", shape.values.iter().sum::<f64>(), 1.0, 1e-14);
        for k in 0..3 {
            let (mut ahead, mut behind) = (at, at);
            ahead[k] += H;
            behind[k] -= H;
            let (ahead, behind) = (HexahedronShape::at(kind, ahead), HexahedronShape::at(kind, behind));
            for (a, slope) in shape.slopes.iter().enumerate() {
                let difference = (ahead.values[a] - behind.values[a]) / (2.0 * H);
                assert!((difference - slope[k]).abs() < 1e-9, "{kind:?} {a} {k}");
            }
        }
    }
}

/// The six rigid motions need no force, and nothing else does without: no other motion is soft.
#[test]
fn ver_rigid_motions_and_no_others_need_no_force() {
    for kind in KINDS {
        for poisson_ratio in [0.0, 0.3, 0.4999] {
            let solid = distorted_box(kind, [1, 1, 1]);
            let matrix = solid.stiffness(&Elastic { poisson_ratio, ..STEEL });
            let dofs = matrix.dofs();
            let columns: Vec<Vec<f64>> = (0..dofs)
                .map(|dof| {
                    let mut unit = vec![0.0; dofs];
                    unit[dof] = 1.0;
                    matrix.multiply(&unit)
                })
                .collect();
            let dense = DMatrix::from_fn(dofs, dofs, |i, j| columns[j][i]);
            let mut eigenvalues: Vec<f64> = dense.symmetric_eigenvalues().iter().copied().collect();
            eigenvalues.sort_by(f64::total_cmp);
            let greatest = eigenvalues[dofs - 1];
            assert!(eigenvalues[5].abs() < 1e-12 * greatest, "{kind:?} {poisson_ratio}: {eigenvalues:?}");
            assert!(eigenvalues[6] > 1e-6 * greatest, "{kind:?} {poisson_ratio}: {eigenvalues:?}");
            for k in 0..3 {
                let along = Vector3::ith(k, 1.0);
                for motion in [solid.field(|_| along), solid.field(|x| along.cross(x))] {
                    let most = matrix.multiply(&motion).into_iter().fold(0.0_f64, |most, f| most.max(f.abs()));
                    assert!(most < 1e-12 * greatest, "{kind:?} {poisson_ratio} {k}: {most:.1e}");
                }
            }
        }
    }
}

/// Where the displacements of the surface are linear, so are those inside, and the stress is even, whatever the elements' shape.
#[test]
fn ver_patch_of_distorted_hexahedra() {
    let gradient = Matrix3::new(1.0, 0.3, -0.2, 0.0, -0.5, 0.2, 0.4, 0.1, 0.7) * 1e-3;
    for kind in KINDS {
        for poisson_ratio in [0.0, 0.3, 0.499] {
            let material = Elastic { poisson_ratio, ..STEEL };
            let cells = [3, 2, 2];
            let solid = distorted_box(kind, cells);
            let flat = Solid::of_box(kind, cells, |x| x);
            let on_surface = |node: usize| {
                (0..3).any(|k| flat.points_mm[node][k] < 1e-9 || flat.points_mm[node][k] > cells[k] as f64 - 1e-9)
            };
            assert!((0..flat.points_mm.len()).any(|node| !on_surface(node)), "nodes inside");
            let exact = solid.field(|x| gradient * x);
            let given = |dof: usize| on_surface(dof / 3).then(|| exact[dof]);
            let found = solid.solved(&material, given, &vec![0.0; exact.len()]);
            let most = found.iter().zip(&exact).map(|(u, exact)| (u - exact).abs()).fold(0.0, f64::max);
            assert!(most < 1e-11, "{kind:?} {poisson_ratio}: {most:.1e}");
            let strain = 0.5 * (gradient + gradient.transpose());
            let (mu, lambda) =
                (material.shear_modulus_mpa(), material.bulk_modulus_mpa() - 2.0 / 3.0 * material.shear_modulus_mpa());
            let stress = strain * (2.0 * mu) + Matrix3::identity() * (lambda * strain.trace());
            let even = Vector6::new(stress.m11, stress.m22, stress.m33, stress.m12, stress.m23, stress.m13);
            for at in solid.stresses_mpa(&material, &found) {
                assert!((at - even).amax() < 1e-8 * even.amax(), "{kind:?} {poisson_ratio}: {at} {even}");
            }
        }
    }
}

/// A thick cylinder between given displacements of its inner and outer surface in plane strain, u = A r + B/r (S. P. Timoshenko and
/// J. N. Goodier, *Theory of Elasticity*, 1970, section 28): what is between follows, also for a nearly incompressible material, and
/// with the order of the elements.
#[test]
fn ver_thick_cylinder() {
    let error = |kind: HexahedronKind, [rings, sectors]: [usize; 2], poisson_ratio: f64| {
        let (inner, outer) = (1.0, 2.0);
        let solid = Solid::of_box(kind, [rings, sectors, 1], |x| {
            let radius = inner + (outer - inner) * x.x / rings as f64;
            let angle = std::f64::consts::FRAC_PI_2 * x.y / sectors as f64;
            Vector3::new(radius * angle.cos(), radius * angle.sin(), x.z)
        });
        // Without a change of volume the field is B/r alone.
        let (a, b) = if poisson_ratio > 0.4 { (0.0, 1e-3) } else { (4e-4, 1e-3) };
        let exact = solid.field(|point| {
            let radius = point.xy().norm();
            let u = a * radius + b / radius;
            Vector3::new(u * point.x / radius, u * point.y / radius, 0.0)
        });
        let given = |dof: usize| {
            let (point, radius) = (solid.points_mm[dof / 3], solid.points_mm[dof / 3].xy().norm());
            let on_surface = (radius - inner).abs() < 1e-9 || (radius - outer).abs() < 1e-9;
            let held = on_surface
                || dof % 3 == 2
                || (dof.is_multiple_of(3) && point.x < 1e-9)
                || (dof % 3 == 1 && point.y < 1e-9);
            held.then(|| exact[dof])
        };
        let found = solid.solved(&Elastic { poisson_ratio, ..STEEL }, given, &vec![0.0; exact.len()]);
        found.iter().zip(&exact).map(|(u, exact)| (u - exact).abs()).fold(0.0, f64::max) / b
    };
    for poisson_ratio in [0.3, 0.4999] {
        let quadratic = error(HexahedronKind::Twenty, [3, 6], poisson_ratio);
        assert!(quadratic < 4e-4, "{poisson_ratio}: {quadratic:.2e}");
        let linear = [[3, 6], [6, 12]].map(|cells| error(HexahedronKind::Eight, cells, poisson_ratio));
        assert!(linear[1] < 4e-3 && linear[1] < linear[0] / 3.0, "{poisson_ratio}: {linear:?}");
    }
}

/// A beam of one element over its height under bending moments: σ = M y/I and the curvature M/(E I), exactly where elements are
/// rectangular, for both kinds.
#[test]
fn ver_pure_bending() {
    let (length, height, width, curvature) = (10.0, 1.0, 0.8, 1e-5);
    for kind in KINDS {
        for poisson_ratio in [0.0, 0.3, 0.499] {
            let material = Elastic { poisson_ratio, ..STEEL };
            let solid = Solid::of_box(kind, [5, 1, 1], |x| {
                Vector3::new(length / 5.0 * x.x, height * (x.y - 0.5), width * (x.z - 0.5))
            });
            // The ends stay plane and turn; what holds the rest of the body lies on the axes.
            let exact = |point: &Vector3<f64>| {
                let (x, y, z) = (point.x, point.y, point.z);
                let across = 0.5 * curvature * (x * x + poisson_ratio * (y * y - z * z));
                Vector3::new(-curvature * x * y, across, poisson_ratio * curvature * y * z)
            };
            let whole = solid.field(exact);
            let given = |dof: usize| {
                let point = solid.points_mm[dof / 3];
                let at_end = point.x < 1e-9 || point.x > length - 1e-9;
                // Across and along the width at the first end, where a corner holds each.
                let at_start = point.x < 1e-9 && point.y < 0.0 && point.z.abs() > 0.3 * width;
                let held = match dof % 3 {
                    0 => at_end,
                    1 => at_start,
                    _ => at_start && point.z < 0.0,
                };
                held.then(|| whole[dof])
            };
            let found = solid.solved(&material, given, &vec![0.0; whole.len()]);
            let end = |u: &[f64]| {
                let node = solid.points_mm.iter().position(|x| x.x > length - 1e-9 && x.y > 0.4 * height).unwrap();
                u[3 * node + 1] - u[1]
            };
            assert_close(&format!("{kind:?} {poisson_ratio}"), end(&found), end(&whole), 1e-9);
            for (stress, point) in solid.stresses_mpa(&material, &found).iter().zip(&solid.points_mm) {
                let sigma = -material.young_modulus_mpa * curvature * point.y;
                let expected = Vector6::new(sigma, 0.0, 0.0, 0.0, 0.0, 0.0);
                let scale = 0.5 * material.young_modulus_mpa * curvature * height;
                assert!((stress - expected).amax() < 1e-7 * scale, "{kind:?} {poisson_ratio} {point}: {stress}");
            }
        }
    }
}

/// A square plate, simply supported, under an even load, against Navier's series with the shear of the plate (S. P. Timoshenko and
/// S. Woinowsky-Krieger, *Theory of Plates and Shells*, 1959, sections 28 and 39): a quarter of it, one and two elements through the
/// thickness.
#[test]
fn ver_bending_of_a_plate() {
    let (side, thickness, load_mpa): (f64, f64, f64) = (20.0, 1.0, 0.1);
    let rigidity = STEEL.young_modulus_mpa * thickness.powi(3) / (12.0 * (1.0 - STEEL.poisson_ratio.powi(2)));
    let shear = 5.0 / 6.0 * STEEL.shear_modulus_mpa() * thickness;
    let odd = || (0..40).map(|k| f64::from(2 * k + 1));
    let series = odd().flat_map(|m| odd().map(move |n| (m, n))).map(|(m, n): (f64, f64)| {
        let wave = (std::f64::consts::PI / side).powi(2) * (m * m + n * n);
        let sign = (0.5 * std::f64::consts::PI * m).sin() * (0.5 * std::f64::consts::PI * n).sin();
        let of_load = 16.0 * load_mpa / (std::f64::consts::PI.powi(2) * m * n);
        sign * of_load / (rigidity * wave * wave) * (1.0 + rigidity * wave / shear)
    });
    let exact: f64 = series.sum();
    for (kind, cells, allowed) in
        [(HexahedronKind::Eight, [10, 10, 2], 0.01), (HexahedronKind::Twenty, [5, 5, 1], 0.005)]
    {
        let [nx, ny, nz] = cells.map(|count| count as f64);
        let scale = Vector3::new(0.5 * side / nx, 0.5 * side / ny, thickness / nz);
        let solid = Solid::of_box(kind, cells, |x| x.component_mul(&scale));
        let given = |dof: usize| {
            let point = solid.points_mm[dof / 3];
            let at = |k: usize| point[k] < 1e-9;
            let symmetry =
                (dof.is_multiple_of(3) && point.x > 0.5 * side - 1e-9) || (dof % 3 == 1 && point.y > 0.5 * side - 1e-9);
            let supported = match dof % 3 {
                0 => at(1),
                1 => at(0),
                _ => at(0) || at(1),
            };
            (symmetry || supported).then_some(0.0)
        };
        // Lumped evenly over the volume: the load acts through the whole thickness.
        let mut forces = vec![0.0; 3 * solid.points_mm.len()];
        for nodes in &solid.elements {
            let corners: Vec<Vector3<f64>> = nodes.iter().map(|node| solid.points_mm[*node as usize]).collect();
            for point in kind.rule() {
                let volume = point.weight * point.shape.gradients(&corners).1;
                for (node, value) in nodes.iter().zip(point.shape.values) {
                    forces[3 * *node as usize + 2] += load_mpa / thickness * volume * value;
                }
            }
        }
        let found = solid.solved(&STEEL, given, &forces);
        let middle = solid
            .points_mm
            .iter()
            .position(|x| x.x > 0.5 * side - 1e-9 && x.y > 0.5 * side - 1e-9 && x.z < 1e-9)
            .unwrap();
        assert_close(&format!("{kind:?}"), found[3 * middle + 2], exact, allowed);
    }
}
