//! A gear body joined from condensed sectors.
//!
//! The teeth that may touch are fine sectors, side by side; all others are coarse ones, and only their stiffness on the
//! two outer cuts of the fine group matters. Sectors in a row join by elimination of the cut between them:
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
//! exactly what the whole gear's finite-element model gives, at the cost of one fine and one coarse sector.

use std::sync::Arc;

use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::{Mat, Side};

use super::sector::{CondensedSector, SectorMatrices};
use gearwear_fem::active_set::ActiveSetError;

/// Forces on the candidates of one tooth: column and N/mm, by increasing column.
pub(crate) type ToothForce = Vec<(usize, f64)>;

/// What bounds the fine group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surroundings {
    /// All other teeth of the gear: `coarse` of them close the ring.
    Ring {
        /// Number of coarse teeth.
        coarse: usize,
    },
    /// `coarse` more teeth on either side, with free outer sides.
    FreeSector {
        /// Number of coarse teeth on each side.
        coarse: usize,
    },
    /// The same with the outer sides held.
    ClampedSector {
        /// Number of coarse teeth on each side.
        coarse: usize,
    },
}

impl Surroundings {
    /// Number of coarse teeth in a row.
    pub fn coarse(self) -> usize {
        match self {
            Self::Ring { coarse } | Self::FreeSector { coarse } | Self::ClampedSector { coarse } => coarse,
        }
    }
}

/// Sectors side by side, from clockwise to anticlockwise, in what surrounds them.
pub(crate) struct JoinedSectors {
    /// F: displacements of the group's cuts per force on them.
    cut_compliance: Mat<f64>,
    cut_dofs: usize,
}

impl JoinedSectors {
    /// Joins `teeth` sectors with what surrounds them; the cut stiffness of a `coarse` one is needed where that has teeth.
    pub(crate) fn new(
        fine: &SectorMatrices,
        coarse: Option<&Mat<f64>>,
        teeth: usize,
        surroundings: Surroundings,
    ) -> Result<Self, ActiveSetError> {
        let n = fine.cut_stiffness.nrows() / 2;
        let cuts = Cuts::new(teeth, surroundings);
        let mut joined = Mat::<f64>::zeros(n * cuts.unknown, n * cuts.unknown);
        let mut add = |block: &Mat<f64>, at: &[usize]| {
            let place = |k: usize| cuts.unknowns[at[k / n]].map(|cut| n * cut + k % n);
            add_block(&mut joined, block, place);
        };
        for tooth in 0..teeth {
            add(&fine.cut_stiffness, &[tooth, tooth + 1]);
        }
        if let (Some(coarse), count @ 1..) = (coarse, surroundings.coarse()) {
            let chain = chain(coarse, count)?;
            match surroundings {
                // The chain's clockwise cut is the group's anticlockwise one.
                Surroundings::Ring { .. } => add(&chain, &[teeth, 0]),
                Surroundings::FreeSector { .. } => {
                    add(&eliminated(&chain, 0, n)?, &[0]);
                    add(&eliminated(&chain, n, n)?, &[teeth]);
                }
                Surroundings::ClampedSector { .. } => {
                    add(&chain.get(n.., n..).to_owned(), &[0]);
                    add(&chain.get(..n, ..n).to_owned(), &[teeth]);
                }
            }
        }
        let inverse = factor(&joined)?.inverse();
        let cut_compliance =
            Mat::from_fn(n * (teeth + 1), n * (teeth + 1), |i, j| match (cuts.unknowns[i / n], cuts.unknowns[j / n]) {
                (Some(row), Some(column)) => inverse[(n * row + i % n, n * column + j % n)],
                _ => 0.0,
            });
        Ok(Self { cut_compliance, cut_dofs: n })
    }

    /// C_pq for all q of `others`: displacements of the candidates of sector p per force on those of sector q.
    pub(crate) fn blocks(
        &self,
        fine: &SectorMatrices,
        p: usize,
        others: std::ops::RangeInclusive<usize>,
    ) -> impl Iterator<Item = Mat<f64>> {
        let n = self.cut_dofs;
        let carried = &fine.carried * self.cut_compliance.get(n * p..n * (p + 2), ..);
        others.map(move |q| {
            let mut block = carried.get(.., n * q..n * (q + 2)) * fine.carried.transpose();
            if p == q {
                block += &fine.compliance;
            }
            block
        })
    }

    /// Displacements of both cuts of sector `p` under candidate forces on all of them.
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
        let moved = self.cut_compliance.get(n * p..n * (p + 2), ..) * load;
        moved.iter().copied().collect()
    }
}

/// A gear as contact sees it: compliance between the candidate nodes of its fine teeth.
#[derive(Clone)]
pub struct GearCompliance {
    /// The fine sector; all fine teeth are alike. Its displacements are those of the modulus that it was condensed with.
    pub sector: Arc<CondensedSector>,
    teeth: usize,
    /// C_pq for q ≤ p, row by row.
    blocks: Arc<[Mat<f64>]>,
    joined: Arc<JoinedSectors>,
    /// Young's modulus that it was condensed with over its own.
    softness: f64,
}

impl GearCompliance {
    /// Joins `teeth` fine sectors, from clockwise to anticlockwise, with what surrounds them; `coarse` is needed where that
    /// has teeth.
    pub fn new(
        fine: CondensedSector,
        coarse: Option<&CondensedSector>,
        teeth: usize,
        surroundings: Surroundings,
    ) -> Result<Self, ActiveSetError> {
        let coarse = coarse.map(|coarse| &coarse.matrices.cut_stiffness);
        let joined = JoinedSectors::new(&fine.matrices, coarse, teeth, surroundings)?;
        let blocks = (0..teeth).flat_map(|p| joined.blocks(&fine.matrices, p, 0..=p)).collect();
        Ok(Self { sector: Arc::new(fine), teeth, blocks, joined: Arc::new(joined), softness: 1.0 })
    }

    /// The same gear of a material `by` times as soft, with the same Poisson's ratio: every displacement under the same forces is that much greater.
    pub fn softened(&self, by: f64) -> Self {
        Self { softness: by * self.softness, ..self.clone() }
    }

    /// By how much its displacements are greater than those of its sector.
    pub fn softness(&self) -> f64 {
        self.softness
    }

    /// Number of fine teeth.
    pub fn teeth(&self) -> usize {
        self.teeth
    }

    /// Displacement of candidate column `row` of tooth `p` per force on candidate column `column` of tooth `q`.
    pub fn between(&self, p: usize, q: usize) -> Between<'_> {
        let (low, high) = (p.min(q), p.max(q));
        Between { block: &self.blocks[high * (high + 1) / 2 + low], turned: q > p, softness: self.softness }
    }

    /// Displacements of both cuts of tooth `p` under candidate forces on the fine teeth, as the sector was condensed, mm.
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

/// A view of C_pq.
#[derive(Clone, Copy)]
pub struct Between<'a> {
    block: &'a Mat<f64>,
    turned: bool,
    softness: f64,
}

impl Between<'_> {
    /// The entries of `rows` × `columns`, column by column.
    pub(crate) fn gathered(&self, rows: &[usize], columns: &[usize]) -> Vec<f64> {
        let height = rows.len();
        let mut entries = vec![0.0; height * columns.len()];
        // Along the block's own columns, whichever way they run.
        if self.turned {
            for (i, &row) in rows.iter().enumerate() {
                let stored = self.block.col(row);
                for (j, &column) in columns.iter().enumerate() {
                    entries[j * height + i] = stored[column];
                }
            }
        } else {
            for (j, &column) in columns.iter().enumerate() {
                let stored = self.block.col(column);
                for (i, &row) in rows.iter().enumerate() {
                    entries[j * height + i] = stored[row];
                }
            }
        }
        if self.softness != 1.0 {
            entries.iter_mut().for_each(|entry| *entry *= self.softness);
        }
        entries
    }
}

/// Which cuts of the fine group are unknowns: in a ring without coarse teeth the last is the first again, clamped ones
/// are none.
struct Cuts {
    unknowns: Vec<Option<usize>>,
    unknown: usize,
}

impl Cuts {
    fn new(teeth: usize, surroundings: Surroundings) -> Self {
        match surroundings {
            Surroundings::Ring { coarse: 0 } => {
                Self { unknowns: (0..=teeth).map(|cut| Some(cut % teeth)).collect(), unknown: teeth }
            }
            Surroundings::ClampedSector { coarse: 0 } => {
                let inner = |cut: usize| (cut > 0 && cut < teeth).then(|| cut - 1);
                Self { unknowns: (0..=teeth).map(inner).collect(), unknown: teeth - 1 }
            }
            _ => Self { unknowns: (0..=teeth).map(Some).collect(), unknown: teeth + 1 },
        }
    }
}

fn add_block(sum: &mut Mat<f64>, block: &Mat<f64>, place: impl Fn(usize) -> Option<usize>) {
    for j in 0..block.ncols() {
        for i in 0..block.nrows() {
            if let (Some(row), Some(column)) = (place(i), place(j)) {
                sum[(row, column)] += block[(i, j)];
            }
        }
    }
}

/// A row of `count` (≥ 1) sectors with cut stiffness `one`, on its two outer cuts: rows of 1, 2, 4 … of them, joined as the binary digits
/// of the number say.
fn chain(one: &Mat<f64>, count: usize) -> Result<Mat<f64>, ActiveSetError> {
    let n = one.nrows() / 2;
    let beside = |first: &Mat<f64>, second: &Mat<f64>| {
        let mut three = Mat::zeros(3 * n, 3 * n);
        add_block(&mut three, first, Some);
        add_block(&mut three, second, |k| Some(n + k));
        eliminated(&three, n, n)
    };
    let mut row: Option<Mat<f64>> = None;
    let mut power = one.clone();
    for digit in 0..=count.ilog2() {
        if digit > 0 {
            power = beside(&power, &power)?;
        }
        if count >> digit & 1 == 1 {
            row = Some(match row {
                Some(row) => beside(&row, &power)?,
                None => power.clone(),
            });
        }
    }
    Ok(row.unwrap_or(power))
}

/// `stiffness` without the `count` free unknowns from `first` on.
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
