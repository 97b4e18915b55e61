//! Gear body joined from condensed sectors.
//!
//! The teeth that may touch are fine sectors, side by side; all others are coarse ones, of which only the stiffness on the
//! two outer cuts of the fine group matters. Neighbouring sectors are joined by elimination of the cut between them:
//!
//! ```text
//! [A_ll A_lm; A_ml A_mm + B_mm, B_mr; B_rm B_rr]   →   minus  (·_m) (A_mm + B_mm)⁻¹ (·_m)ᵀ
//! ```
//!
//! With F the inverse of the joined stiffness of the fine group's cuts (coarse chain included), forces on tooth q move
//! the candidates of tooth p by
//!
//! ```text
//! C_pq = δ_pq C + Ψ F_pq Ψᵀ
//! ```
//!
//! exactly as in the finite-element model of the whole gear, at the cost of one fine and one coarse sector. What cuts carry is smooth on the
//! flank: a few shapes U span Ψ = U R to round-off, and Ψ F_pq Ψᵀ = U (R F_pq Rᵀ) Uᵀ.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::sync::Arc;

use faer::linalg::matmul::{
    matmul,
    triangular::{self, BlockStructure},
};
use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, Col, Mat, MatRef, Par, Scale, Side};

use super::sector::{CondensedSector, SectorMatrices};
use crate::gear_mesh::settings::RimPins;
use gearwear_fem::active_set::ActiveSetError;

/// Forces on the candidates of one tooth: column and N/mm, by increasing column.
pub type ToothForce = Vec<(usize, f64)>;

/// Surroundings of the fine group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surroundings {
    /// All other teeth of the gear, which close the ring.
    Ring {
        /// Number of coarse teeth.
        coarse: usize,
    },
    /// All other teeth of a gear that pins hold and whose sectors are free below; coarse ones are needed.
    PinnedRing {
        /// Number of coarse teeth.
        coarse: usize,
        /// Pins.
        pins: RimPins,
    },
    /// More teeth on either side, with free outer sides.
    FreeSector {
        /// Number of coarse teeth on each side.
        coarse: usize,
    },
    /// More teeth on either side, with the outer sides held.
    ClampedSector {
        /// Number of coarse teeth on each side.
        coarse: usize,
    },
}

impl Surroundings {
    /// Number of coarse teeth in a row.
    pub fn coarse(self) -> usize {
        match self {
            Self::Ring { coarse }
            | Self::PinnedRing { coarse, .. }
            | Self::FreeSector { coarse }
            | Self::ClampedSector { coarse } => coarse,
        }
    }

    /// Cuts with a pin beside `teeth` fine teeth, rising from the clockwise cut of the first on: those above `teeth` are between coarse ones.
    fn pinned_cuts(self, teeth: usize) -> Vec<usize> {
        let Self::PinnedRing { coarse, pins } = self else { return Vec::new() };
        let all = teeth + coarse;
        let mut cuts: Vec<usize> =
            pins.cuts(all as u32).into_iter().map(|cut| (cut as usize + teeth / 2) % all).collect();
        cuts.sort_unstable();
        cuts
    }
}

/// Neighbouring sectors, from clockwise to anticlockwise, joined to their surroundings.
pub(crate) struct JoinedSectors {
    /// Compliance F of the group's cuts: displacements of all per force on the known ones.
    cut_compliance: Mat<f64>,
    /// Cuts whose columns of F are known.
    known: RangeInclusive<usize>,
    cut_dofs: usize,
}

impl JoinedSectors {
    /// Joins `teeth` sectors with their surroundings, and finds the compliance of the cuts of `sectors`; the cut stiffness of a `coarse` sector is
    /// needed where the surroundings have teeth.
    pub(crate) fn new(
        fine: &SectorMatrices,
        coarse: Option<&Mat<f64>>,
        teeth: usize,
        surroundings: Surroundings,
        sectors: RangeInclusive<usize>,
    ) -> Result<Self, ActiveSetError> {
        let n = fine.cut_stiffness.nrows() / 2;
        let cuts = Cuts::new(teeth, surroundings);
        let mut joined = CutBlocks::new(n);
        for tooth in 0..teeth {
            cuts.add(&mut joined, &fine.cut_stiffness, &[tooth, tooth + 1]);
        }
        let pinned = surroundings.pinned_cuts(teeth);
        if let (Some(coarse), count @ 1..) = (coarse, surroundings.coarse()) {
            let on_pins: Vec<usize> = pinned.iter().filter(|cut| **cut > teeth).map(|cut| cut - teeth).collect();
            let chain = chain_on_pins(coarse, count, &on_pins)?;
            match surroundings {
                // The chain's clockwise cut is the group's anticlockwise one.
                Surroundings::Ring { .. } | Surroundings::PinnedRing { .. } => {
                    cuts.add(&mut joined, &chain, &[teeth, 0])
                }
                Surroundings::FreeSector { .. } => {
                    cuts.add(&mut joined, &eliminated(&chain, 0, n)?, &[0]);
                    cuts.add(&mut joined, &eliminated(&chain, n, n)?, &[teeth]);
                }
                Surroundings::ClampedSector { .. } => {
                    cuts.add(&mut joined, &chain.get(n.., n..).to_owned(), &[0]);
                    cuts.add(&mut joined, &chain.get(..n, ..n).to_owned(), &[teeth]);
                }
            }
        }
        let of_fine: Vec<usize> = pinned.into_iter().filter(|cut| *cut <= teeth).collect();
        for &cut in &of_fine {
            joined.pin(cut);
        }
        let known = *sectors.start()..=sectors.end() + 1;
        let mut cut_compliance = cuts.compliance(joined, &known)?;
        for row in of_fine.iter().flat_map(|cut| PIN_DOFS.map(|dof| n * cut + dof)) {
            cut_compliance.row_mut(row).fill(0.0);
        }
        Ok(Self { cut_compliance, known, cut_dofs: n })
    }

    /// Displacements of all cuts per force on both cuts of sector `p`, whose compliance is known.
    fn by_sector(&self, p: usize) -> MatRef<'_, f64> {
        let (n, place) = (self.cut_dofs, p - self.known.start());
        self.cut_compliance.get(.., n * place..n * (place + 2))
    }

    /// Compliances C_pq for all q of `others`: displacements of the candidates of sector p, whose compliance is known, per force on those of sector
    /// q.
    pub(crate) fn blocks(
        &self,
        fine: &SectorMatrices,
        p: usize,
        others: RangeInclusive<usize>,
    ) -> impl Iterator<Item = Mat<f64>> {
        let n = self.cut_dofs;
        let carried = &fine.carried * self.by_sector(p).transpose();
        others.map(move |q| {
            let mut block = carried.get(.., n * q..n * (q + 2)) * fine.carried.transpose();
            if p == q {
                block += &fine.compliance;
            }
            block
        })
    }

    /// Displacements of both cuts of sector `p`, whose compliance is known, under candidate forces on all sectors.
    pub(crate) fn cut_displacement_mm(&self, fine: &SectorMatrices, p: usize, forces: &[ToothForce]) -> Vec<f64> {
        let n = self.cut_dofs;
        let mut load = vec![0.0; self.cut_compliance.nrows()];
        for (tooth, force) in forces.iter().enumerate() {
            for &(c, f) in force {
                for b in 0..2 * n {
                    load[n * tooth + b] += fine.carried[(c, b)] * f;
                }
            }
        }
        let load = faer::Col::from_iter(load);
        let moved = self.by_sector(p).transpose() * load;
        moved.iter().copied().collect()
    }
}

/// Relative size of what shapes of the flank leave of the displacements by cuts.
const SHAPE_ROUND_OFF: f64 = 1e-12;

/// Displacements of the candidates by forces on cuts, in few shapes.
struct CarriedShapes {
    /// Displacements Uᵀ of the candidates, a column for each.
    shapes: Mat<f64>,
    /// Products R F_pq Rᵀ, row by row.
    compliance: Vec<Mat<f64>>,
    teeth: usize,
}

impl CarriedShapes {
    fn new(fine: &SectorMatrices, joined: &JoinedSectors, teeth: usize) -> Self {
        let (shapes, by_cut) = spanned(&fine.carried);
        let (n, by_cut) = (joined.cut_dofs, &by_cut);
        let compliance = (0..teeth * teeth).map(|pq| {
            let (p, q) = (pq / teeth, pq % teeth);
            by_cut * joined.cut_compliance.get(n * p..n * (p + 2), n * q..n * (q + 2)) * by_cut.transpose()
        });
        Self { shapes: shapes.transpose().to_owned(), compliance: compliance.collect(), teeth }
    }
}

/// Orthonormal columns U and their factors R of `matrix` = U R to round-off, by Gram and Schmidt's method with the greatest column first.
fn spanned(matrix: &Mat<f64>) -> (Mat<f64>, Mat<f64>) {
    let mut left = matrix.clone();
    let mut columns: Vec<Col<f64>> = Vec::new();
    let mut least = 0.0;
    while columns.len() < matrix.ncols() {
        let sizes = (0..left.ncols()).map(|j| (j, left.col(j).norm_l2()));
        let Some((greatest, size)) = sizes.max_by(|(_, a), (_, b)| a.total_cmp(b)) else { break };
        if size <= least {
            break;
        }
        if columns.is_empty() {
            least = SHAPE_ROUND_OFF * size;
        }
        let mut unit = left.col(greatest) * Scale(1.0 / size);
        for column in &columns {
            let along = column.transpose() * &unit;
            unit -= column * Scale(along);
        }
        unit *= Scale(1.0 / unit.norm_l2());
        let factors = unit.transpose() * &left;
        left -= &unit * factors;
        columns.push(unit);
    }
    let shapes = Mat::from_fn(matrix.nrows(), columns.len(), |i, k| columns[k][i]);
    let factors = shapes.transpose() * matrix;
    (shapes, factors)
}

/// Compliance of a gear between the candidate nodes of its fine teeth.
#[derive(Clone)]
pub struct GearCompliance {
    /// Sector of all fine teeth, with the modulus of its condensation.
    pub sector: Arc<CondensedSector>,
    carried: Arc<CarriedShapes>,
    joined: Arc<JoinedSectors>,
    /// Young's modulus of the condensed sector over that of the gear.
    softness: f64,
}

impl GearCompliance {
    /// Joins `teeth` fine sectors, from clockwise to anticlockwise, with their surroundings; `coarse` is needed where these
    /// have teeth.
    pub fn new(
        fine: impl Into<Arc<CondensedSector>>,
        coarse: Option<&CondensedSector>,
        teeth: usize,
        surroundings: Surroundings,
    ) -> Result<Self, ActiveSetError> {
        let fine = fine.into();
        let coarse = coarse.map(|coarse| &coarse.matrices.cut_stiffness);
        let joined = JoinedSectors::new(&fine.matrices, coarse, teeth, surroundings, 0..=teeth - 1)?;
        let carried = CarriedShapes::new(&fine.matrices, &joined, teeth);
        Ok(Self { sector: fine, carried: Arc::new(carried), joined: Arc::new(joined), softness: 1.0 })
    }

    /// Gear of a material `by` times as soft, with the same Poisson's ratio: every displacement under the same forces is `by` times as great.
    pub fn softened(&self, by: f64) -> Self {
        Self { softness: by * self.softness, ..self.clone() }
    }

    /// Ratio of displacements to those of the condensed sector.
    pub fn softness(&self) -> f64 {
        self.softness
    }

    /// Number of fine teeth.
    pub fn teeth(&self) -> usize {
        self.carried.teeth
    }

    /// Displacement of tooth `p` along `direction`, candidate columns with weights, under `force` on tooth `q`, mm.
    pub fn displacement_along_mm(&self, p: usize, direction: &[(usize, f64)], q: usize, force: &[(usize, f64)]) -> f64 {
        let in_shapes = |columns: &[(usize, f64)]| {
            let mut sum = Col::<f64>::zeros(self.carried.shapes.nrows());
            columns.iter().for_each(|&(column, part)| sum += self.carried.shapes.col(column) * Scale(part));
            sum
        };
        let mut moved = in_shapes(direction).transpose() * (self.between_cuts(p, q) * in_shapes(force));
        if p == q {
            let by_force = force.iter().map(|&(column, force)| {
                let column = self.held().col(column);
                force * direction.iter().map(|&(row, part)| part * column[row]).sum::<f64>()
            });
            moved += by_force.sum::<f64>();
        }
        self.softness * moved
    }

    /// Compliance C of the candidates of a tooth with its cuts held, with the modulus of the condensation.
    pub(super) fn held(&self) -> &Mat<f64> {
        &self.sector.matrices.compliance
    }

    /// Displacements of the candidates in the shapes that cuts carry, a column for each.
    pub(super) fn shapes(&self) -> &Mat<f64> {
        &self.carried.shapes
    }

    /// Compliance between the shapes of tooth `p` and those of tooth `q`, with the modulus of the condensation.
    pub(super) fn between_cuts(&self, p: usize, q: usize) -> &Mat<f64> {
        &self.carried.compliance[p * self.carried.teeth + q]
    }

    /// Compliance between the candidates of tooth `p` and those of tooth `q`, from the compliance of the cuts itself.
    #[cfg(test)]
    pub(super) fn between_teeth(&self, p: usize, q: usize) -> Mat<f64> {
        let block = self.joined.blocks(&self.sector.matrices, p, q..=q).next().expect("there is one");
        block * Scale(self.softness)
    }

    /// Displacements of both cuts of tooth `p` under candidate forces on the fine teeth, with the modulus of the condensation, mm.
    pub fn cut_displacement_mm(&self, p: usize, forces: &[ToothForce]) -> Vec<f64> {
        self.joined.cut_displacement_mm(&self.sector.matrices, p, forces)
    }

    /// Stress of each probe of tooth `p` under candidate forces on the fine teeth, MPa.
    pub(crate) fn probed_mpa(&self, p: usize, forces: &[ToothForce]) -> Vec<f64> {
        let cuts = self.cut_displacement_mm(p, forces);
        let sector = &self.sector;
        (0..sector.probe_by_cut.nrows())
            .map(|k| {
                let own: f64 = forces[p].iter().map(|&(c, f)| sector.probe_by_force[(k, c)] * f).sum();
                own + cuts.iter().enumerate().map(|(b, u)| sector.probe_by_cut[(k, b)] * u).sum::<f64>()
            })
            .collect()
    }
}

/// Unknowns of the fine group's cuts: in a ring without coarse teeth the last cut is the first, and clamped ones have none.
struct Cuts {
    unknowns: Vec<Option<usize>>,
    unknown: usize,
}

impl Cuts {
    /// Adds the stiffness `block` of the cuts `at` to that of all unknown ones.
    fn add(&self, joined: &mut CutBlocks, block: &Mat<f64>, at: &[usize]) {
        let n = joined.dofs;
        for (a, row) in at.iter().enumerate() {
            for (b, column) in at.iter().enumerate() {
                if let (Some(row), Some(column)) = (self.unknowns[*row], self.unknowns[*column]) {
                    joined.add((row, column), block.get(n * a..n * (a + 1), n * b..n * (b + 1)));
                }
            }
        }
    }

    /// Compliance of all cuts under forces on the `known` ones, with the stiffness `joined`.
    fn compliance(&self, joined: CutBlocks, known: &RangeInclusive<usize>) -> Result<Mat<f64>, ActiveSetError> {
        let n = joined.dofs;
        let loaded: BTreeSet<usize> = known.clone().filter_map(|cut| self.unknowns[cut]).collect();
        let place: BTreeMap<usize, usize> = loaded.iter().copied().zip(0..).collect();
        let of_unknowns = joined.compliance(&loaded, self.unknown)?;
        let mut compliance = Mat::zeros(n * self.unknowns.len(), n * (known.end() - known.start() + 1));
        for (row, cut) in self.unknowns.iter().enumerate() {
            for (column, force) in known.clone().enumerate() {
                if let (Some(cut), Some(force)) = (cut, self.unknowns[force]) {
                    let block = of_unknowns[*cut].get(.., n * place[&force]..n * (place[&force] + 1));
                    compliance.get_mut(n * row..n * (row + 1), n * column..n * (column + 1)).copy_from(block);
                }
            }
        }
        Ok(compliance)
    }

    fn new(teeth: usize, surroundings: Surroundings) -> Self {
        match surroundings {
            Surroundings::Ring { coarse: 0 } => {
                Self { unknowns: (0..=teeth).map(|cut| Some(cut % teeth)).collect(), unknown: teeth }
            }
            Surroundings::ClampedSector { coarse: 0 } => {
                let inner = (0..=teeth).map(|cut| (cut > 0 && cut < teeth).then(|| cut - 1));
                Self { unknowns: inner.collect(), unknown: teeth - 1 }
            }
            _ => Self { unknowns: (0..=teeth).map(Some).collect(), unknown: teeth + 1 },
        }
    }
}

/// Unknowns of a cut that a pin holds: those of its first node, on the outside circle.
const PIN_DOFS: [usize; 2] = [0, 1];

/// Symmetric matrix of blocks, one for each two cuts that are joined: row ≥ column.
struct CutBlocks {
    /// Degrees of freedom of a cut.
    dofs: usize,
    blocks: BTreeMap<(usize, usize), Mat<f64>>,
}

/// A cut that is eliminated: with K = L Lᵀ its own stiffness and B its coupling with `neighbours`, L and L⁻¹ B.
struct EliminatedCut {
    cut: usize,
    factor: Llt<f64>,
    neighbours: Vec<(usize, Mat<f64>)>,
}

impl CutBlocks {
    fn new(dofs: usize) -> Self {
        Self { dofs, blocks: BTreeMap::new() }
    }

    /// Adds `block` to that of two cuts; those above the diagonal are not kept.
    fn add(&mut self, (row, column): (usize, usize), block: MatRef<'_, f64>) {
        if row >= column {
            let dofs = self.dofs;
            *self.blocks.entry((row, column)).or_insert_with(|| Mat::zeros(dofs, dofs)) += block;
        }
    }

    /// Holds a cut on a pin: the unknowns there are without coupling, and of stiffness 1.
    fn pin(&mut self, cut: usize) {
        for ((row, column), block) in &mut self.blocks {
            for dof in PIN_DOFS {
                if *row == cut {
                    block.row_mut(dof).fill(0.0);
                }
                if *column == cut {
                    block.col_mut(dof).fill(0.0);
                }
                if *row == cut && *column == cut {
                    block[(dof, dof)] = 1.0;
                }
            }
        }
    }

    /// Eliminates the free `cut`.
    fn eliminate(&mut self, cut: usize) -> Result<EliminatedCut, ActiveSetError> {
        let own = self.blocks.remove(&(cut, cut)).unwrap_or_else(|| Mat::zeros(self.dofs, self.dofs));
        let factor = factor(&own)?;
        let mut neighbours = Vec::new();
        let joined: Vec<(usize, usize)> =
            self.blocks.keys().copied().filter(|(row, column)| *row == cut || *column == cut).collect();
        for (row, column) in joined {
            let block = self.blocks.remove(&(row, column)).expect("a key of the map");
            let (neighbour, mut block) = if row == cut { (column, block) } else { (row, block.transpose().to_owned()) };
            solve_lower_triangular_in_place(factor.L(), block.as_mut(), Par::Seq);
            neighbours.push((neighbour, block));
        }
        for (row, of_row) in &neighbours {
            for (column, of_column) in &neighbours {
                if row >= column {
                    let dofs = self.dofs;
                    let block = self.blocks.entry((*row, *column)).or_insert_with(|| Mat::zeros(dofs, dofs));
                    matmul(block.as_mut(), Accum::Add, of_row.transpose(), of_column.as_ref(), -1.0, Par::Seq);
                }
            }
        }
        Ok(EliminatedCut { cut, factor, neighbours })
    }

    /// Displacements of each of `count` cuts per force on the `loaded` ones.
    fn compliance(mut self, loaded: &BTreeSet<usize>, count: usize) -> Result<Vec<Mat<f64>>, ActiveSetError> {
        let n = self.dofs;
        let free = (0..count).rev().filter(|cut| !loaded.contains(cut));
        let eliminated: Vec<EliminatedCut> = free.map(|cut| self.eliminate(cut)).collect::<Result<_, _>>()?;
        let mut own = Mat::<f64>::zeros(n * loaded.len(), n * loaded.len());
        let place: BTreeMap<usize, usize> = loaded.iter().copied().zip(0..).collect();
        for ((row, column), block) in self.blocks {
            let (row, column) = (n * place[&row], n * place[&column]);
            own.get_mut(row..row + n, column..column + n).copy_from(block);
        }
        // Only the lower half is read.
        let inverse = factor(&own)?.inverse();
        let mut compliance = vec![Mat::new(); count];
        for (cut, place) in place {
            compliance[cut] = inverse.get(n * place..n * (place + 1), ..).to_owned();
        }
        for EliminatedCut { cut, factor, neighbours } in eliminated.into_iter().rev() {
            let mut moved = Mat::zeros(n, n * loaded.len());
            for (neighbour, coupling) in &neighbours {
                matmul(moved.as_mut(), Accum::Add, coupling, &compliance[*neighbour], -1.0, Par::Seq);
            }
            solve_upper_triangular_in_place(factor.L().transpose(), moved.as_mut(), Par::Seq);
            compliance[cut] = moved;
        }
        Ok(compliance)
    }
}

/// Stiffness of two neighbouring sectors or rows on their outer cuts, with a pin at the cut between them or without.
fn beside(first: &Mat<f64>, second: &Mat<f64>, is_pinned: bool) -> Result<Mat<f64>, ActiveSetError> {
    let n = first.nrows() / 2;
    let mut inner = first.get(n.., n..) + second.get(..n, ..n);
    let mut coupling = Mat::zeros(n, 2 * n);
    coupling.get_mut(.., ..n).copy_from(first.get(n.., ..n));
    coupling.get_mut(.., n..).copy_from(second.get(..n, n..));
    for dof in PIN_DOFS.into_iter().filter(|_| is_pinned) {
        inner.row_mut(dof).fill(0.0);
        inner.col_mut(dof).fill(0.0);
        inner[(dof, dof)] = 1.0;
        coupling.row_mut(dof).fill(0.0);
    }
    let factor = factor(&inner)?;
    solve_lower_triangular_in_place(factor.L(), coupling.as_mut(), Par::Seq);
    let mut outer = Mat::zeros(2 * n, 2 * n);
    outer.get_mut(..n, ..n).copy_from(first.get(..n, ..n));
    outer.get_mut(n.., n..).copy_from(second.get(n.., n..));
    let (lower, whole) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
    triangular::matmul(
        outer.as_mut(),
        lower,
        Accum::Add,
        coupling.transpose(),
        whole,
        coupling.as_ref(),
        whole,
        -1.0,
        Par::Seq,
    );
    for j in 1..2 * n {
        for i in 0..j {
            outer[(i, j)] = outer[(j, i)];
        }
    }
    Ok(outer)
}

/// Stiffness of a row of `count` (≥ 1) sectors with cut stiffness `one` on its two outer cuts: rows of 1, 2, 4 … sectors are joined by the
/// binary digits of the number.
fn chain(one: &Mat<f64>, count: usize) -> Result<Mat<f64>, ActiveSetError> {
    let mut row: Option<Mat<f64>> = None;
    let mut power = one.clone();
    for digit in 0..=count.ilog2() {
        if digit > 0 {
            power = beside(&power, &power, false)?;
        }
        if count >> digit & 1 == 1 {
            row = Some(match row {
                Some(row) => beside(&row, &power, false)?,
                None => power.clone(),
            });
        }
    }
    Ok(row.unwrap_or(power))
}

/// Stiffness as of [`chain`], with pins at the cuts `on_pins` of the row, counted from its clockwise one, rising.
fn chain_on_pins(one: &Mat<f64>, count: usize, on_pins: &[usize]) -> Result<Mat<f64>, ActiveSetError> {
    let mut from = 0;
    let mut row: Option<Mat<f64>> = None;
    for &to in on_pins.iter().chain([&count]) {
        let next = chain(one, to - from)?;
        row = Some(match row {
            Some(row) => beside(&row, &next, true)?,
            None => next,
        });
        from = to;
    }
    Ok(row.expect("the end of the row is a cut"))
}

/// Schur complement of `stiffness` without the `count` free unknowns from `first` on.
fn eliminated(stiffness: &Mat<f64>, first: usize, count: usize) -> Result<Mat<f64>, ActiveSetError> {
    let kept: Vec<usize> = (0..stiffness.nrows()).filter(|k| !(first..first + count).contains(k)).collect();
    let inner = stiffness.get(first..first + count, first..first + count).to_owned();
    let coupling = Mat::from_fn(count, kept.len(), |i, j| stiffness[(first + i, kept[j])]);
    let solved = factor(&inner)?.solve(&coupling);
    let taken = coupling.transpose() * solved;
    Ok(Mat::from_fn(kept.len(), kept.len(), |i, j| stiffness[(kept[i], kept[j])] - taken[(i, j)]))
}

fn factor(stiffness: &Mat<f64>) -> Result<Llt<f64>, ActiveSetError> {
    Llt::new(stiffness.as_ref(), Side::Lower).map_err(|error| {
        let faer::linalg::solvers::LltError::NonPositivePivot { index } = error;
        ActiveSetError::NotPositiveDefinite { index }
    })
}
