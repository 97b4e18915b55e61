//! One tooth with its part of the body, condensed onto what the outside can touch.
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
//! and any stress that is a linear functional σ = pᵀ u of it likewise. K is factorised once for all of these. Cut
//! displacements are radial and circumferential components, so that a sector turned by a pitch is the same sector.
//!
//! Source: R. J. Guyan, *AIAA J.* 3 (1965) 380 (static condensation); exact here, for nothing is dynamic.

use faer::Mat;
use nalgebra::Vector2;

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::factor::Factor;
use gearwear_fem::solid::Solid;
use gearwear_fem::stiffness::Stiffness;

/// What a functional of the displacements of a condensed sector comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Per force on each candidate column.
    pub by_force: Vec<f64>,
    /// Per displacement of each cut column.
    pub by_cut: Vec<f64>,
}

/// A sparse linear functional of the displacements: degrees of freedom with their coefficients.
pub(crate) type Functional = Vec<(u32, f64)>;

/// One sector before condensation; the tooth's centre line is +y, the gear's axis the origin.
#[derive(Debug, Clone)]
pub struct Sector {
    /// Nodes and elements.
    pub solid: Solid,
    /// Nodes on the clamp circle.
    pub clamp: Vec<u32>,
    /// Nodes of the clockwise (x > 0) and of the anticlockwise (x < 0) cut, by increasing radius, without clamped ones.
    pub cuts: [Vec<u32>; 2],
    /// Half a pitch.
    pub half_angle_rad: f64,
    /// Nodes that contact forces may act on.
    pub candidates: Vec<u32>,
    /// Stresses wanted, MPa per mm.
    pub probes: Vec<Functional>,
    /// How many of them, the first ones, lie on the side of the working flank.
    pub working_side_probes: usize,
}

/// What a condensed sector is to those beside it: the matrices of the equations above.
#[derive(Debug, Clone)]
pub struct SectorMatrices {
    /// C.
    pub compliance: Mat<f64>,
    /// Ψ at the candidates.
    pub carried: Mat<f64>,
    /// S: of the clockwise cut, then of the anticlockwise one.
    pub cut_stiffness: Mat<f64>,
}

/// A condensed sector. Candidate columns are `2 · place in candidates + component`, cut columns `2 · place + component`
/// (radial, circumferential) of the clockwise cut, then of the anticlockwise one.
pub struct CondensedSector {
    /// The sector itself.
    pub sector: Sector,
    stiffness: Stiffness,
    factor: Factor,
    /// C in mm per N/mm, Ψ at the candidates, S in N/mm per mm.
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
    /// Elements that are none, bodies that are not held.
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
        // Two directions of each node, and as many degrees of freedom.
        let cut_dofs: Vec<u32> = directions.iter().step_by(2).flat_map(|(node, _)| [2 * node, 2 * node + 1]).collect();
        let held_columns = stiffness.matrix().columns(&cut_dofs);
        let along = |a: usize| [(a - a % 2, directions[a].1.x), (a - a % 2 + 1, directions[a].1.y)];
        let mut moved = vec![0.0; dofs * cuts];
        for (a, column) in moved.chunks_exact_mut(dofs).enumerate() {
            for (held, part) in along(a) {
                held_columns[held].iter().for_each(|(dof, value)| column[*dof as usize] -= part * value);
            }
        }
        factor.solve(cuts, &mut moved);
        for ((node, direction), column) in directions.iter().zip(moved.chunks_exact_mut(dofs)) {
            for (dof, value) in given(*node, *direction) {
                column[dof as usize] += value;
            }
        }
        let candidate_dof = |c: usize| 2 * self.candidates[c / 2] as usize + c % 2;
        let candidates = 2 * self.candidates.len();
        let carried = Mat::from_fn(candidates, cuts, |c, b| moved[b * dofs + candidate_dof(c)]);
        let probe_by_cut = Mat::from_fn(self.probes.len(), cuts, |p, b| {
            self.probes[p].iter().map(|&(dof, value)| value * moved[b * dofs + dof as usize]).sum()
        });
        let mut cut_stiffness = Mat::zeros(cuts, cuts);
        for (b, column) in moved.chunks_exact(dofs).enumerate() {
            let force =
                |row: &Vec<(u32, f64)>| -> f64 { row.iter().map(|(dof, value)| value * column[*dof as usize]).sum() };
            let force: Vec<f64> = held_columns.iter().map(force).collect();
            for a in 0..cuts {
                cut_stiffness[(a, b)] = along(a).iter().map(|&(held, part)| part * force[held]).sum();
            }
        }
        let columns: Vec<Functional> =
            (0..candidates).map(|c| vec![(candidate_dof(c) as u32, 1.0)]).chain(self.probes.iter().cloned()).collect();
        let all = factor.compliance(&columns);
        let compliance = all.get(..candidates, ..candidates).to_owned();
        let probe_by_force = all.get(candidates.., ..candidates).to_owned();
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

/// A displacement of one node as held degrees of freedom.
fn given(node: u32, displacement: Vector2<f64>) -> [(u32, f64); 2] {
    [(2 * node, displacement.x), (2 * node + 1, displacement.y)]
}

/// Without the round-off that sets a matrix apart from its transpose.
pub(super) fn symmetric(matrix: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]))
}

impl CondensedSector {
    /// Displacement of every node of the sector under forces on the candidates and displacements of the cuts, mm.
    pub fn displacement_mm(&self, candidate_force: &[(usize, f64)], cut_mm: &[f64]) -> Vec<f64> {
        let mut field = vec![0.0; self.sector.solid.dofs()];
        // Directions come in pairs, radial and circumferential, of one node each.
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

    /// How a functional p of the displacements answers to forces on the candidates and displacements of the cuts. With
    /// λ = K_ii⁻¹ p_i it is λ_c and p_b − K_bi λ: one solution, whatever the number of forces.
    pub fn answer(&self, functional: &Functional) -> Answer {
        let mut lambda = vec![0.0; self.sector.solid.dofs()];
        for &(dof, value) in functional {
            lambda[dof as usize] += value;
        }
        let own = lambda.clone();
        self.factor.solve(1, &mut lambda);
        let reaction = self.stiffness.matrix().multiply(&lambda);
        let by_cut = self
            .sector
            .cut_directions()
            .iter()
            .map(|&(node, direction)| {
                let dof = 2 * node as usize;
                direction.x * (own[dof] - reaction[dof]) + direction.y * (own[dof + 1] - reaction[dof + 1])
            })
            .collect();
        let by_force =
            self.sector.candidates.iter().flat_map(|&node| [0, 1].map(|i| lambda[2 * node as usize + i])).collect();
        Answer { by_force, by_cut }
    }
}
