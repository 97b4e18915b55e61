//! One tooth with its part of the body, condensed onto its flank and cuts.
//!
//! A sector is one pitch of a gear between two radial cuts through the middles of neighbouring spaces. Held at the clamp
//! circle, its displacement follows from the forces f_c on the candidate nodes of its flank and the displacements u_b of
//! its cuts:
//!
//! ```text
//! u_c = C f_c + Ψ u_b          C = (K_ii⁻¹)_cc        Ψ = −(K_ii⁻¹ K_ib)_c
//! f_b = S u_b − Ψᵀ f_c         S = K_bb − K_bi K_ii⁻¹ K_ib
//! ```
//!
//! and likewise any stress, a linear functional σ = pᵀ u of it. K is factorised once for all of these, and one compliance between forces on the candidates,
//! the functionals p and the columns of K_ib has all products with K_ii⁻¹. Cut
//! displacements are radial and circumferential components, so that a sector turned by a pitch has the same matrices.
//!
//! Source: R. J. Guyan, *AIAA J.* 3 (1965) 380 (static condensation); exact in statics.

use faer::Mat;
use nalgebra::Vector2;

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::{COLUMNS_AT_ONCE, Factor};
use gearwear_fem::solid::Solid;
use gearwear_fem::stiffness::Stiffness;

/// Value of a functional of the displacements of a condensed sector.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Value per force on each candidate column.
    pub by_force: Vec<f64>,
    /// Value per displacement of each cut column.
    pub by_cut: Vec<f64>,
}

/// Sparse linear functional of the displacements: degrees of freedom with their coefficients.
pub type Functional = Vec<(u32, f64)>;

/// One sector before condensation; the tooth's centre line is +y, the gear's axis the origin.
#[derive(Debug, Clone)]
pub struct Sector {
    /// Nodes and elements.
    pub solid: Solid,
    /// Nodes on the clamp circle.
    pub clamp: Vec<u32>,
    /// Nodes of the clockwise (x > 0) and of the anticlockwise (x < 0) cut, by increasing radius, without clamped ones.
    pub cuts: [Vec<u32>; 2],
    /// Half the pitch angle.
    pub half_angle_rad: f64,
    /// Nodes that contact forces may act on.
    pub candidates: Vec<u32>,
    /// Stresses at given points as functionals, MPa per mm.
    pub probes: Vec<Functional>,
    /// Number of probes, the first ones, on the side of the working flank.
    pub working_side_probes: usize,
}

/// Matrices of a condensed sector, as in the equations above.
#[derive(Debug, Clone)]
pub struct SectorMatrices {
    /// Compliance C of the candidates with the cuts held.
    pub compliance: Mat<f64>,
    /// Displacements Ψ of the candidates per displacement of the cuts.
    pub carried: Mat<f64>,
    /// Stiffness S of the clockwise, then of the anticlockwise cut.
    pub cut_stiffness: Mat<f64>,
}

/// Condensed sector. Candidate columns are `2 · place in candidates + component`, cut columns `2 · place + component`
/// (radial, circumferential) of the clockwise cut, then of the anticlockwise one.
pub struct CondensedSector {
    /// Sector before condensation.
    pub sector: Sector,
    stiffness: Stiffness,
    factor: Factor,
    /// Matrices C in mm per N/mm, Ψ and S in N/mm per mm.
    pub matrices: SectorMatrices,
    /// Stress of each probe per force on each candidate.
    pub probe_by_force: Mat<f64>,
    /// Stress of each probe per displacement of the cuts.
    pub probe_by_cut: Mat<f64>,
}

impl Sector {
    /// Cut nodes with their radial and circumferential directions: clockwise cut first.
    fn cut_directions(&self) -> Vec<(u32, Vector2<f64>)> {
        let mut directions = Vec::new();
        for (cut, angle) in self.cuts.iter().zip([-self.half_angle_rad, self.half_angle_rad]) {
            let (sin, cos) = angle.sin_cos();
            for &node in cut {
                directions.push((node, Vector2::new(-sin, cos)));
                directions.push((node, Vector2::new(-cos, -sin)));
            }
        }
        directions
    }

    /// Condenses the sector.
    ///
    /// # Errors
    /// Degenerate elements and bodies that are not held.
    pub fn condense(self, material: Elastic, analysis: Analysis) -> Result<CondensedSector, SolveError> {
        let dofs = self.solid.dofs();
        let mut held = vec![false; dofs];
        for &node in self.clamp.iter().chain(self.cuts.iter().flatten()) {
            held[2 * node as usize] = true;
            held[2 * node as usize + 1] = true;
        }
        let stiffness = Stiffness::new(&self.solid, &[material], analysis)?;
        let factor = Factor::new(&stiffness, &held)?;

        let directions = self.cut_directions();
        let cuts = directions.len();
        let by_cut = cut_columns(&stiffness, &directions);
        let candidate_dofs = self.candidates.iter().flat_map(|node| [2 * node, 2 * node + 1]);
        let unit_forces = candidate_dofs.map(|dof| vec![(dof, 1.0)]);
        let columns: Vec<Functional> =
            unit_forces.chain(self.probes.iter().cloned()).chain(by_cut.iter().cloned()).collect();
        let mut compliance = factor.compliance(&columns);
        let (candidates, first_cut) = (2 * self.candidates.len(), columns.len() - cuts);
        let carried = Mat::from_fn(candidates, cuts, |c, b| -compliance[(c, first_cut + b)]);
        let probe_by_cut = Mat::from_fn(self.probes.len(), cuts, |p, b| {
            along(&self.probes[p], directions[b]) - compliance[(candidates + p, first_cut + b)]
        });
        let cut_stiffness = Mat::from_fn(cuts, cuts, |a, b| {
            along(&by_cut[b], directions[a]) - compliance[(first_cut + a, first_cut + b)]
        });
        let probe_by_force = compliance.get(candidates..first_cut, ..candidates).to_owned();
        compliance.truncate(candidates, candidates);
        Ok(CondensedSector {
            stiffness,
            factor,
            matrices: SectorMatrices { compliance, carried, cut_stiffness: symmetric(&cut_stiffness) },
            probe_by_force,
            probe_by_cut,
            sector: self,
        })
    }
}

/// Forces K_b on all degrees of freedom by a unit displacement of each cut node in each of its directions.
fn cut_columns(stiffness: &Stiffness, directions: &[(u32, Vector2<f64>)]) -> Vec<Functional> {
    let cut_dofs: Vec<u32> = directions.iter().step_by(2).flat_map(|(node, _)| [2 * node, 2 * node + 1]).collect();
    let of_dofs = stiffness.matrix().columns(&cut_dofs);
    let columns = directions.iter().enumerate().map(|(k, (_, direction))| {
        let parts = [(k - k % 2, direction.x), (k - k % 2 + 1, direction.y)];
        let entries =
            parts.into_iter().flat_map(|(k, part)| of_dofs[k].iter().map(move |(dof, force)| (*dof, part * force)));
        entries.collect()
    });
    columns.collect()
}

/// Value of a functional of the displacements where one node moves by a direction.
fn along(functional: &Functional, (node, direction): (u32, Vector2<f64>)) -> f64 {
    let moved = given(node, direction);
    let products = functional
        .iter()
        .map(|(dof, value)| value * moved.iter().filter(|(other, _)| other == dof).map(|(_, part)| part).sum::<f64>());
    products.sum()
}

/// Product of a sparse column with values of all degrees of freedom.
fn product(column: &Functional, values: &[f64]) -> f64 {
    column.iter().map(|&(dof, entry)| entry * values[dof as usize]).sum()
}

/// Displacement of one node by degree of freedom.
fn given(node: u32, displacement: Vector2<f64>) -> [(u32, f64); 2] {
    [(2 * node, displacement.x), (2 * node + 1, displacement.y)]
}

/// Symmetric part of a matrix, which differs from its transpose by round-off.
fn symmetric(matrix: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]))
}

impl CondensedSector {
    /// Displacement of every node of the sector under forces on the candidates and displacements of the cuts, mm.
    pub fn displacement_mm(&self, candidate_force: &[(usize, f64)], cut_mm: &[f64]) -> Vec<f64> {
        let mut field = vec![0.0; self.sector.solid.dofs()];
        // Radial and circumferential directions of each node.
        let held: Vec<(u32, f64)> = self
            .sector
            .cut_directions()
            .chunks_exact(2)
            .zip(cut_mm.chunks_exact(2))
            .flat_map(|(pair, u)| given(pair[0].0, pair[0].1 * u[0] + pair[1].1 * u[1]))
            .collect();
        for &(c, force) in candidate_force {
            field[2 * self.sector.candidates[c / 2] as usize + c % 2] = force;
        }
        self.factor.subtract_held(self.stiffness.matrix(), &held, &mut field);
        self.factor.solve(1, &mut field);
        for (dof, value) in held {
            field[dof as usize] += value;
        }
        field
    }

    /// Values of functionals p of the displacements per force on the candidates and displacement of the cuts, λ_c and p_b − K_bi λ
    /// with λ = K_ii⁻¹ p_i: one solution each, whatever the number of forces, and many at once.
    pub fn answers(&self, functionals: &[Functional]) -> Vec<Answer> {
        let directions = self.sector.cut_directions();
        let by_cut = cut_columns(&self.stiffness, &directions);
        let dofs = self.sector.solid.dofs();
        let mut answers = Vec::with_capacity(functionals.len());
        for functionals in functionals.chunks(COLUMNS_AT_ONCE) {
            let mut lambda = vec![0.0; dofs * functionals.len()];
            for (functional, lambda) in functionals.iter().zip(lambda.chunks_exact_mut(dofs)) {
                functional.iter().for_each(|&(dof, value)| lambda[dof as usize] += value);
            }
            self.factor.solve(functionals.len(), &mut lambda);
            let solved = functionals.iter().zip(lambda.chunks_exact(dofs));
            answers.extend(solved.map(|(functional, lambda)| {
                Answer {
                    by_force: self.at_candidates(lambda),
                    by_cut: directions
                        .iter()
                        .zip(&by_cut)
                        .map(|(direction, column)| along(functional, *direction) - product(column, lambda))
                        .collect(),
                }
            }));
        }
        answers
    }

    /// Displacements of the candidate columns.
    fn at_candidates(&self, displacement_mm: &[f64]) -> Vec<f64> {
        let dofs = self.sector.candidates.iter().flat_map(|&node| [2 * node as usize, 2 * node as usize + 1]);
        dofs.map(|dof| displacement_mm[dof]).collect()
    }
}
