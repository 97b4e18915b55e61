//! Stresses at the nodes.
//!
//! Stresses are sampled at the optimal points of an element: the 2 × 2 Gauss points of quadrilaterals, three points of the
//! quadratic triangle, the middle of the linear one. They are extrapolated to the nodes by the (bi)linear function
//! through them, and averaged over the elements of one material around a node, as stresses may jump across an
//! interface.
//!
//! ```text
//! σ(node) = 1/n Σₑ Σ_g w_g(node) σ_g        σ_g = D B_g uₑ
//! ```
//!
//! Strains are those of the element formulation: enhanced in the bilinear quadrilateral (`enhanced_quad`); in plane strain with the
//! projected volume strain of quadratic elements (`projected_volume`) and the mean volume strain around the node of linear triangles
//! (`nodal_triangle`); of bodies of revolution those of `axisymmetric`. A stress is linear in the displacements, a row of coefficients: solving for that row as a load (K λ = row) gives the
//! stress under every load F as λ · F.
//!
//! Source: J. Barlow, *International Journal for Numerical Methods in Engineering* 10 (1976) 243–251 (optimal points);
//! E. Hinton and J. S. Campbell, same journal 8 (1974) 461–480 (extrapolation and averaging).

use nalgebra::{Matrix3, Matrix4x3, SMatrix, Vector2, Vector4};

use super::axisymmetric::RingElement;
use super::elastic::{Analysis, Elastic};
use super::element::{ElementError, Fold, MOST_DOFS};
use super::enhanced_quad::EnhancedQuad;
use super::nodal_triangle::NodePatch;
use super::projected_volume::ProjectedVolume;
use super::quadrature::GAUSS_2;
use super::shape::Shape;
use super::solid::{ElementKind, Solid};
use super::stiffness::{averaged_patches, check_references};

/// Component of stress in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressComponent {
    /// Normal stress σ_x.
    X,
    /// Normal stress σ_y.
    Y,
    /// Shear stress τ_xy.
    Xy,
}

/// Stress at a node, in the elements of one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodalStress {
    /// Number of the node.
    pub node: u32,
    /// Number of the material.
    pub material: u16,
    /// σ_x, MPa.
    pub sigma_x_mpa: f64,
    /// σ_y, MPa.
    pub sigma_y_mpa: f64,
    /// τ_xy, MPa.
    pub tau_xy_mpa: f64,
    /// σ_z across the plane, of bodies of revolution the hoop stress, MPa.
    pub sigma_z_mpa: f64,
}

impl NodalStress {
    /// Von Mises stress, MPa.
    pub fn von_mises_mpa(&self) -> f64 {
        von_mises_mpa([self.sigma_x_mpa, self.sigma_y_mpa, self.sigma_z_mpa, self.tau_xy_mpa, 0.0, 0.0])
    }
}

/// Von Mises stress √(½ [(σ_x − σ_y)² + (σ_y − σ_z)² + (σ_z − σ_x)²] + 3 (τ_xy² + τ_yz² + τ_zx²)) of (x, y, z, xy, yz, zx), MPa.
pub fn von_mises_mpa([x, y, z, xy, yz, zx]: [f64; 6]) -> f64 {
    let squares = (x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2);
    (0.5 * squares + 3.0 * (xy.powi(2) + yz.powi(2) + zx.powi(2))).sqrt()
}

/// Recovery of nodal stresses from displacements of one solid.
pub struct StressRecovery<'a> {
    solid: &'a Solid,
    materials: &'a [Elastic],
    analysis: Analysis,
    /// (node, material, element, place of the node in the element), in rising order.
    around: Vec<(u32, u16, u32, u8)>,
    /// Patches of averaged triangles, by node and material.
    patches: Vec<NodePatch>,
}

/// Stress (σ_x, σ_y, τ_xy, σ_z) at one point of an element per displacement of its nodes, MPa/mm.
type StressMatrix = SMatrix<f64, 4, MOST_DOFS>;

impl<'a> StressRecovery<'a> {
    /// Recovery for `solid`, whose elements refer to `materials` by number.
    pub fn new(solid: &'a Solid, materials: &'a [Elastic], analysis: Analysis) -> Result<Self, ElementError> {
        check_references(solid, materials)?;
        let mut around = Vec::new();
        for (number, element) in (0..).zip(&solid.elements) {
            around.extend((0..).zip(element.nodes()).map(|(a, node)| (*node, element.material, number, a)));
        }
        around.sort_unstable();
        let patches = averaged_patches(solid, analysis);
        Ok(Self { solid, materials, analysis, around, patches })
    }

    /// Stresses at all nodes under `displacement_mm`, by node and then material.
    ///
    /// # Panics
    /// Where there is not one displacement for each degree of freedom.
    pub fn nodal_stresses(&self, displacement_mm: &[f64]) -> Result<Vec<NodalStress>, ElementError> {
        assert_eq!(displacement_mm.len(), self.solid.dofs(), "one displacement for each degree of freedom");
        // Extrapolated stress by element and node.
        let mut of_elements: Vec<[Vector4<f64>; 9]> = Vec::with_capacity(self.solid.elements.len());
        for (number, element) in self.solid.elements.iter().enumerate() {
            let mut u = SMatrix::<f64, MOST_DOFS, 1>::zeros();
            for (a, node) in element.nodes().iter().enumerate() {
                u[2 * a] = displacement_mm[2 * *node as usize];
                u[2 * a + 1] = displacement_mm[2 * *node as usize + 1];
            }
            let samples: Vec<Vector4<f64>> = self.sample_stresses(number)?.iter().map(|s| s * u).collect();
            let mut stresses = [Vector4::zeros(); 9];
            for (a, stress) in stresses.iter_mut().enumerate().take(element.nodes().len()) {
                let weights = to_node(element.kind, a);
                *stress = samples.iter().zip(weights).map(|(s, w)| s * w).sum();
            }
            of_elements.push(stresses);
        }
        let groups = self.around.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1));
        let mut stresses: Vec<NodalStress> = Vec::new();
        for group in groups {
            let (node, material) = (group[0].0, group[0].1);
            let sum: Vector4<f64> = group.iter().map(|(_, _, e, a)| of_elements[*e as usize][usize::from(*a)]).sum();
            let mut mean = sum / group.len() as f64;
            if let Some((row, weight_mpa)) = self.volume_row(group) {
                let theta: f64 = row.iter().map(|(dof, c)| c * displacement_mm[*dof as usize]).sum();
                mean += VOLUME * (weight_mpa * theta);
            }
            let [sigma_x_mpa, sigma_y_mpa, tau_xy_mpa, sigma_z_mpa] = mean.into();
            stresses.push(NodalStress { node, material, sigma_x_mpa, sigma_y_mpa, tau_xy_mpa, sigma_z_mpa });
        }
        Ok(stresses)
    }

    /// One component of the stress at `node` in `material` as (degree of freedom, MPa/mm), in rising order; empty where no
    /// element of that material has the node.
    pub fn nodal_stress_row(
        &self,
        node: u32,
        material: u16,
        component: StressComponent,
    ) -> Result<Vec<(u32, f64)>, ElementError> {
        let first = self.around.partition_point(|entry| (entry.0, entry.1) < (node, material));
        let count = self.around[first..].partition_point(|entry| (entry.0, entry.1) == (node, material));
        let group = &self.around[first..first + count];
        let mut row: Vec<(u32, f64)> = Vec::new();
        for (_, _, number, a) in group {
            let element = &self.solid.elements[*number as usize];
            let samples = self.sample_stresses(*number as usize)?;
            let weights = to_node(element.kind, usize::from(*a));
            let stress: StressMatrix = samples.iter().zip(weights).map(|(s, w)| s * w).sum();
            let coefficients = stress.row(component as usize);
            let dofs = element.nodes().iter().flat_map(|node| [2 * node, 2 * node + 1]);
            row.extend(dofs.zip(coefficients.iter()).map(|(dof, c)| (dof, c / group.len() as f64)));
        }
        if component != StressComponent::Xy
            && let Some((volume, weight_mpa)) = self.volume_row(group)
        {
            row.extend(volume.into_iter().map(|(dof, c)| (dof, c * weight_mpa)));
        }
        // A stable sort keeps the order of summation.
        row.sort_by_key(|entry| entry.0);
        Ok(row.chunk_by(|p, q| p.0 == q.0).map(|same| (same[0].0, same.iter().map(|entry| entry.1).sum())).collect())
    }

    /// Mean volume strain of averaged triangles around a node as a row, and κ times the fraction of triangles among the elements there.
    fn volume_row(&self, group: &[(u32, u16, u32, u8)]) -> Option<(Vec<(u32, f64)>, f64)> {
        let (node, material, ..) = *group.first()?;
        let found = self.patches.binary_search_by_key(&(node, material), |patch| (patch.node, patch.material));
        let patch = &self.patches[found.ok()?];
        let (row, _) = patch.mean_volume_strain(self.solid);
        let dofs = patch.nodes.iter().flat_map(|node| [2 * node, 2 * node + 1]);
        let share = patch.triangles.len() as f64 / group.len() as f64;
        let weight_mpa = share * self.materials[usize::from(material)].bulk_modulus_mpa();
        Some((dofs.zip(row.into_iter().flatten()).collect(), weight_mpa))
    }

    /// Stress at the sample points of an element; of averaged triangles the deviatoric part.
    fn sample_stresses(&self, number: usize) -> Result<Vec<StressMatrix>, ElementError> {
        let element = &self.solid.elements[number];
        let kind = element.kind;
        let nodes_mm: Vec<Vector2<f64>> =
            element.nodes().iter().map(|node| self.solid.points_mm[*node as usize]).collect();
        let distorted =
            |Fold { at_mm, determinant_mm2 }| ElementError::Distorted { element: number, kind, at_mm, determinant_mm2 };
        let material = &self.materials[usize::from(element.material)];
        let points = sample_points(kind);
        if self.analysis == Analysis::Axisymmetric {
            let ring = RingElement::new(kind, &nodes_mm).map_err(distorted)?;
            let stresses = points.iter().map(|at| ring.stress(material, &Shape::at(kind, *at)).map_err(distorted));
            return stresses.collect();
        }
        if kind == ElementKind::Quad4 {
            let d = material.stiffness_mpa(self.analysis);
            let quad = EnhancedQuad::new(&nodes_mm, &d).map_err(distorted)?;
            let law = law(&d, self.analysis);
            let stresses = points.iter().map(|at| {
                let mut stress = StressMatrix::zeros();
                stress.fixed_view_mut::<4, 8>(0, 0).copy_from(&(law * quad.strain_matrix(*at)));
                stress
            });
            return Ok(stresses.collect());
        }
        let plane_strain = self.analysis == Analysis::PlaneStrain;
        let volume = if plane_strain && ProjectedVolume::serves(kind) {
            Some(ProjectedVolume::new(kind, &nodes_mm).map_err(distorted)?)
        } else {
            None
        };
        let d = if plane_strain { material.deviatoric_mpa() } else { material.stiffness_mpa(self.analysis) };
        let law = law(&d, self.analysis);
        let stresses = points.iter().map(|at| {
            let shape = Shape::at(kind, *at);
            let (gradients, determinant_mm2) = shape.gradients(&nodes_mm);
            let at_mm = shape.point(&nodes_mm);
            if determinant_mm2.is_nan() || determinant_mm2 <= 0.0 {
                return Err(distorted(Fold { at_mm, determinant_mm2 }));
            }
            let mut b = SMatrix::<f64, 3, MOST_DOFS>::zeros();
            for (a, [gx, gy]) in gradients.iter().enumerate() {
                b[(0, 2 * a)] = *gx;
                b[(1, 2 * a + 1)] = *gy;
                b[(2, 2 * a)] = *gy;
                b[(2, 2 * a + 1)] = *gx;
            }
            let mut stress = law * b;
            if let Some(volume) = &volume {
                stress += VOLUME * volume.row(at_mm).transpose() * material.bulk_modulus_mpa();
            }
            Ok(stress)
        });
        stresses.collect()
    }
}

/// Stress components of a volume strain: σ_x, σ_y and σ_z.
const VOLUME: Vector4<f64> = Vector4::new(1.0, 1.0, 0.0, 1.0);

/// Elasticity matrix D with a row for σ_z: λ (ε_x + ε_y) in plane strain, with λ = D₁₂ also for a deviatoric D.
fn law(d_mpa: &Matrix3<f64>, analysis: Analysis) -> Matrix4x3<f64> {
    let across = if analysis == Analysis::PlaneStrain { d_mpa.m12 } else { 0.0 };
    let mut law = Matrix4x3::zeros();
    law.fixed_view_mut::<3, 3>(0, 0).copy_from(d_mpa);
    law[(3, 0)] = across;
    law[(3, 1)] = across;
    law
}

/// Gauss abscissa 1/√3.
const GAUSS: f64 = GAUSS_2[1].0;

/// Optimal points for stresses, in the order of the corners.
fn sample_points(kind: ElementKind) -> &'static [[f64; 2]] {
    match kind {
        ElementKind::Triangle3 => &[[1.0 / 3.0, 1.0 / 3.0]],
        ElementKind::Triangle6 => &[[1.0 / 6.0, 1.0 / 6.0], [2.0 / 3.0, 1.0 / 6.0], [1.0 / 6.0, 2.0 / 3.0]],
        ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9 => {
            &[[-GAUSS, -GAUSS], [GAUSS, -GAUSS], [GAUSS, GAUSS], [-GAUSS, GAUSS]]
        }
    }
}

/// Weights of the sample points for the value at a node: linear shape functions of the cell whose corners they are.
fn to_node(kind: ElementKind, node: usize) -> [f64; 4] {
    let [xi, eta] = super::shape::reference_nodes(kind)[node];
    let shape = match kind {
        ElementKind::Triangle3 => return [1.0, 0.0, 0.0, 0.0],
        ElementKind::Triangle6 => Shape::at(ElementKind::Triangle3, [xi, eta].map(|x| 2.0 * (x - 1.0 / 6.0))),
        _ => Shape::at(ElementKind::Quad4, [xi, eta].map(|x| x / GAUSS)),
    };
    [shape.values[0], shape.values[1], shape.values[2], shape.values[3]]
}
