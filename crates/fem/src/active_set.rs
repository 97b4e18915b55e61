//! Complementarity problem of contact, solved by a primal–dual active set method.
//!
//! Condensed onto its n multipliers, a contact of linear elastic bodies is
//!
//! ```text
//! g = g⁰ + C f + G α ≥ 0,    f ≥ 0,    f_i g_i = 0,    Gᵀ f = q
//! ```
//!
//! f: forces of the multipliers, C their compliance (symmetric, positive definite on any active set), α the amplitudes of
//! the m free rigid motions, q the loads along them. For an estimate A of the active set,
//!
//! ```text
//! S α = −Gᵀ C⁻¹ g⁰ − q,   S = Gᵀ C⁻¹ G,     C f = −g⁰ − G α        all restricted to A
//! ```
//!
//! and the next estimate drops every member in tension and adds every other that penetrates. That is Newton's method for the
//! nonsmooth equation f = max(0, f − c g), which converges in a few steps from a sensible start but may cycle. When
//! the number of wrong signs has not fallen for some steps, a dual method that cannot cycle takes over (module `dual`).
//!
//! A solution on gaps that have hardly changed tries the active set of the last one first ([`Condensed::solve_again`]): it asks for the gaps of the members and
//! of a few multipliers beside them alone, and is the whole solution unless the surfaces come to touch elsewhere.
//!
//! Source: M. Hintermüller, K. Ito and K. Kunisch, *SIAM J. Optim.* 13 (2003) 865–888.

mod dual;

use faer::linalg::solvers::{Llt, Solve};
use faer::{ColRef, Mat, MatRef, Side};
use pulp::Arch;

use crate::weighted_sum::weighted_sum;

/// Multipliers to either side of an active one, by number, that a solution with the same active set watches.
const WATCHED: usize = 4;
/// Number of full exchanges without fewer wrong signs before the dual method.
const PATIENCE: usize = 8;
/// Greatest number of exchanges.
const MOST_ITERATIONS: usize = 2000;
/// Round-off over the greatest force or gap.
const ROUND_OFF: f64 = 1e-12;
/// Relative resistance of the contact below which a motion is not held. Contact on curved
/// surfaces of elements resists rotation about their centre by about 1e-10, which is round-off.
const SINGULAR: f64 = 1e-9;
/// Relative stiffness of an elastic foundation for motions that an intermediate active set does not hold.
const SOFT_GROUND: f64 = 1e-6;

/// Condensed contact problem.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// Compliance C, mm per N/mm.
    pub compliance: Mat<f64>,
    /// Initial gaps g⁰, mm.
    pub gap_mm: Vec<f64>,
    /// Change G of the gaps per free rigid motion.
    pub rigid: Mat<f64>,
    /// Load q along each free rigid motion.
    pub rigid_load: Vec<f64>,
}

/// Solution of a condensed contact problem.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactEquilibrium {
    /// Forces f, N/mm.
    pub force: Vec<f64>,
    /// Gaps g, mm.
    pub gap_mm: Vec<f64>,
    /// Amplitudes α of the rigid motions.
    pub rigid: Vec<f64>,
    /// Stiffness S against the rigid motions with this active set, row by row.
    pub resistance: Vec<f64>,
    /// Active set, from which the next problem can start.
    pub active: Vec<bool>,
    /// Iterations.
    pub log: ActiveSetLog,
}

/// Counts of the active set iteration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ActiveSetLog {
    /// Size of the active set and number of wrong signs of each iteration.
    pub steps: Vec<(usize, usize)>,
    /// Number of members that entered or left in all iterations.
    pub changes: usize,
    /// Number of changes to the dual method.
    pub cycles_broken: usize,
    /// Number of active sets factorised.
    pub factorisations: usize,
}

impl ActiveSetLog {
    /// Appends `later`, which is empty then.
    pub fn append(&mut self, later: &mut ActiveSetLog) {
        let ActiveSetLog { mut steps, changes, cycles_broken, factorisations } = std::mem::take(later);
        self.steps.append(&mut steps);
        self.changes += changes;
        self.cycles_broken += cycles_broken;
        self.factorisations += factorisations;
    }
}

/// Reason why there is no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ActiveSetError {
    /// The surfaces never touch.
    #[error("the surfaces do not touch under this load: the smallest gap is {least_gap_mm:.3e} mm")]
    NoContact {
        /// Smallest gap found, mm.
        least_gap_mm: f64,
    },
    /// Contact does not hold the bodies against a rigid motion.
    #[error("neither supports nor contact hold the bodies against a rigid motion: no equilibrium exists")]
    Floating {
        /// Free motion, as an amplitude of each rigid motion of the problem.
        amplitudes: Vec<f64>,
    },
    /// The multipliers are not independent.
    #[error("the contact compliance is not positive definite at multiplier {index}")]
    NotPositiveDefinite {
        /// Number of the multiplier.
        index: usize,
    },
    /// The greatest number of iterations is reached.
    #[error("the contact has not converged in {iterations} iterations: {wrong} nodes still pull or penetrate")]
    MaxIterations {
        /// Number of iterations.
        iterations: usize,
        /// Number of wrong signs.
        wrong: usize,
    },
    /// Inputs are infinite or not a number.
    #[error("the contact problem holds numbers that are not finite")]
    NotFinite,
}

/// Solves L Lᵀ x = b in place; faster than a blocked solution for one right-hand side and few unknowns.
fn solve_in_place(factor: &Llt<f64>, b: &mut [f64]) {
    let l = factor.L();
    Arch::new().dispatch(
        #[inline(always)]
        || {
            for j in 0..b.len() {
                let column = column(l, j);
                b[j] /= column[j];
                let x = b[j];
                for (b, l) in b[j + 1..].iter_mut().zip(&column[j + 1..]) {
                    *b -= l * x;
                }
            }
            for j in (0..b.len()).rev() {
                let column = column(l, j);
                b[j] = (b[j] - weighted_sum(&column[j + 1..], &b[j + 1..])) / column[j];
            }
        },
    );
}

/// Results that solutions with the same compliance and rigid motions share.
#[derive(Debug, Clone)]
pub struct ReusableFactor {
    /// Resistance of independent springs, [`Condensed::springs`], to each rigid motion.
    resistance: Vec<f64>,
    factored: Option<FactoredSet>,
}

/// Active set and the Cholesky factor of its compliance.
#[derive(Debug, Clone)]
struct FactoredSet {
    active: Vec<bool>,
    members: Vec<usize>,
    factor: Llt<f64>,
    /// Product C⁻¹ G.
    by_motion: Mat<f64>,
    /// Other multipliers, and their rows of C for the members.
    others: Vec<usize>,
    others_compliance: Mat<f64>,
    /// Multipliers beside the members, from their first use on.
    watched: Option<Watched>,
}

/// Multipliers beside the members of an active set.
#[derive(Debug, Clone)]
struct Watched {
    rows: Vec<usize>,
    /// Rows of C for the members, one after another.
    compliance: Vec<f64>,
    /// Whether each multiplier is one of these or a member.
    asked: Vec<bool>,
}

/// Forces of the members of an active set.
struct MemberForces {
    force: Vec<f64>,
    rigid: nalgebra::DVector<f64>,
    resistance: nalgebra::DMatrix<f64>,
    /// Motion that the active set does not hold.
    loose: Option<Vec<f64>>,
}

impl ReusableFactor {
    /// Multipliers whose gaps [`Condensed::solve_again`] asks for with the active set `active`; `None` where the last solution had another.
    pub fn asked(&mut self, compliance: MatRef<'_, f64>, active: &[bool]) -> Option<&[bool]> {
        let set = self.factored.as_mut().filter(|set| set.active == active)?;
        let FactoredSet { members, watched, .. } = set;
        Some(&watched.get_or_insert_with(|| Watched::new(compliance, active, members)).asked)
    }
}

impl Watched {
    fn new(compliance: MatRef<'_, f64>, active: &[bool], members: &[usize]) -> Self {
        let mut asked = active.to_vec();
        for &member in members {
            asked[member.saturating_sub(WATCHED)..(member + WATCHED + 1).min(active.len())].fill(true);
        }
        let rows: Vec<usize> = (0..active.len()).filter(|&i| asked[i] && !active[i]).collect();
        let compliance =
            rows.iter().flat_map(|&i| members.iter().map(move |&member| compliance[(i, member)])).collect();
        Self { rows, compliance, asked }
    }
}

/// Solution of one active set.
struct Trial {
    force: Vec<f64>,
    gap_mm: Vec<f64>,
    rigid: Vec<f64>,
    resistance: Vec<f64>,
    /// Motion that the active set does not hold.
    loose: Option<Vec<f64>>,
}

impl Condensed {
    /// Solves from the active set `start`, or from the first touch.
    pub fn solve(&self, start: Option<&[bool]>) -> Result<ContactEquilibrium, ActiveSetError> {
        self.solve_with(start, &mut None)
    }

    /// Solves as [`Self::solve`] does, reusing the factor of an earlier solution with the same compliance and rigid motions where the active
    /// set is the same; `kept` is updated.
    pub fn solve_with(
        &self,
        start: Option<&[bool]>,
        kept: &mut Option<ReusableFactor>,
    ) -> Result<ContactEquilibrium, ActiveSetError> {
        let n = self.gap_mm.len();
        if self.gap_mm.iter().chain(&self.rigid_load).any(|value| !value.is_finite()) {
            return Err(ActiveSetError::NotFinite);
        }
        let ReusableFactor { resistance, factored } = match kept {
            Some(kept) => kept,
            None => kept.insert(self.checked()?),
        };
        let mut active = match start {
            Some(start) if start.len() == n && start.contains(&true) => start.to_vec(),
            _ => self.first_touch()?,
        };
        let mut log = ActiveSetLog::default();
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        while log.steps.len() < MOST_ITERATIONS {
            let trial = self.trial(&active, resistance, factored, &mut log)?;
            let wrong = self.wrong(&trial, &active);
            log.steps.push((active.iter().filter(|a| **a).count(), wrong.len()));
            if wrong.is_empty() {
                return self.finished(trial, active, log);
            }
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), PATIENCE);
            } else if patience > 0 {
                patience -= 1;
            } else if log.cycles_broken == 0 {
                log.cycles_broken = 1;
                self.let_pulling_go(&mut active, resistance, factored, &mut log)?;
                continue;
            } else {
                break;
            }
            log.changes += wrong.len();
            wrong.into_iter().for_each(|i| active[i] = !active[i]);
        }
        let wrong = log.steps.last().map_or(0, |step| step.1);
        Err(ActiveSetError::MaxIterations { iterations: log.steps.len(), wrong })
    }

    fn finished(
        &self,
        trial: Trial,
        active: Vec<bool>,
        log: ActiveSetLog,
    ) -> Result<ContactEquilibrium, ActiveSetError> {
        if !active.contains(&true) {
            let least_gap_mm = trial.gap_mm.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(ActiveSetError::NoContact { least_gap_mm });
        }
        if let Some(amplitudes) = trial.loose {
            return Err(ActiveSetError::Floating { amplitudes });
        }
        let Trial { force, gap_mm, rigid, resistance, .. } = trial;
        Ok(ContactEquilibrium { force, gap_mm, rigid, resistance, active, log })
    }

    /// Checks compliance and rigid motions, which are the same for all solutions.
    fn checked(&self) -> Result<ReusableFactor, ActiveSetError> {
        let is_finite = [&self.compliance, &self.rigid].into_iter().all(|matrix| {
            (0..matrix.ncols()).all(|j| column(matrix.as_ref(), j).iter().all(|value| value.is_finite()))
        });
        if !is_finite {
            return Err(ActiveSetError::NotFinite);
        }
        let resistance: Vec<f64> = (0..self.rigid_load.len()).map(|a| self.springs(a, a)).collect();
        match self.never_held(&resistance) {
            Some(amplitudes) => Err(ActiveSetError::Floating { amplitudes }),
            None => Ok(ReusableFactor { resistance, factored: None }),
        }
    }

    /// Stiffness Σ G_ia G_ib/C_ii of independent springs at all multipliers against two rigid motions, the measure of S.
    fn springs(&self, a: usize, b: usize) -> f64 {
        let springs = (0..self.gap_mm.len()).map(|i| self.rigid[(i, a)] * self.rigid[(i, b)] / self.compliance[(i, i)]);
        springs.sum()
    }

    /// Combination of rigid motions that changes no gap.
    fn never_held(&self, resistance: &[f64]) -> Option<Vec<f64>> {
        let m = resistance.len();
        let greatest = resistance.iter().copied().fold(0.0, f64::max);
        if let Some(a) = (0..m).find(|&a| resistance[a] <= SINGULAR * SINGULAR * greatest) {
            return Some((0..m).map(|b| if a == b { 1.0 } else { 0.0 }).collect());
        }
        let s = nalgebra::DMatrix::from_fn(m, m, |a, b| self.springs(a, b));
        held_motion(&s, &nalgebra::DVector::zeros(m), resistance).1
    }

    /// Multipliers that touch first when the loads move the free bodies.
    fn first_touch(&self) -> Result<Vec<bool>, ActiveSetError> {
        let n = self.gap_mm.len();
        let least_gap_mm = self.gap_mm.iter().copied().fold(f64::INFINITY, f64::min);
        // The loads move along −q, as Gᵀ f = q is the reaction of the contact.
        let closing: Vec<f64> =
            (0..n).map(|i| self.rigid_load.iter().enumerate().map(|(k, q)| self.rigid[(i, k)] * q).sum()).collect();
        let paths = closing.iter().zip(&self.gap_mm).filter(|(closing, _)| **closing > 0.0);
        let first = paths.map(|(closing, gap)| gap.max(0.0) / closing).fold(f64::INFINITY, f64::min);
        let moved: Vec<f64> = match first.is_finite() {
            true => (0..n).map(|i| self.gap_mm[i] - first * closing[i]).collect(),
            false => self.gap_mm.clone(),
        };
        let scale = moved.iter().chain(&self.gap_mm).fold(0.0_f64, |most, gap| most.max(gap.abs()));
        let touching: Vec<bool> = moved.iter().map(|gap| *gap <= ROUND_OFF * scale).collect();
        if touching.contains(&true) { Ok(touching) } else { Err(ActiveSetError::NoContact { least_gap_mm }) }
    }

    /// Forces and gaps if the `active` multipliers carry the load.
    fn trial(
        &self,
        active: &[bool],
        resistance: &[f64],
        factored: &mut Option<FactoredSet>,
        log: &mut ActiveSetLog,
    ) -> Result<Trial, ActiveSetError> {
        let kept = factored.take().filter(|kept| kept.active == active);
        let set = match kept {
            Some(kept) => kept,
            None => {
                log.factorisations += 1;
                self.factored(active)?
            }
        };
        let set = &*factored.insert(set);
        Ok(self.response(set, (&self.gap_mm, &self.rigid_load), resistance))
    }

    /// Forces and gaps per opening of the gap at a `member`, without loads.
    fn by_opening(&self, set: &FactoredSet, member: usize, resistance: &[f64]) -> Trial {
        let mut gap_mm = vec![0.0; self.gap_mm.len()];
        gap_mm[member] = -1.0;
        self.response(set, (&gap_mm, &vec![0.0; self.rigid_load.len()]), resistance)
    }

    /// Forces and gaps if the members of a set carry the loads `q` on initial gaps `gap_mm`.
    fn response(&self, set: &FactoredSet, (gap_mm, q): (&[f64], &[f64]), resistance: &[f64]) -> Trial {
        let MemberForces { force: of_members, rigid: alpha, resistance: s, loose } =
            self.member_forces(set, (gap_mm, q), resistance);
        let mut force = vec![0.0; gap_mm.len()];
        set.members.iter().zip(&of_members).for_each(|(&member, own)| force[member] = *own);
        let gap_mm = self.gaps_mm(set, gap_mm, &of_members, alpha.as_slice());
        // S is symmetric, so that columns are rows.
        Trial { force, gap_mm, rigid: alpha.iter().copied().collect(), resistance: s.data.into(), loose }
    }

    /// Solves again with the active set of `found`, if the last solution with `kept` had that one too, and no sign is wrong among the members and the multipliers
    /// beside them, whose gaps alone are asked for ([`ReusableFactor::asked`]). Then `found` has the new forces and motions, and its old gaps; otherwise it stays.
    pub fn solve_again(&self, found: &mut ContactEquilibrium, kept: &ReusableFactor) -> bool {
        let Some(set) = kept.factored.as_ref().filter(|set| set.active == found.active) else { return false };
        let Some(Watched { rows, compliance, .. }) = &set.watched else { return false };
        let MemberForces { force, rigid, loose, .. } =
            self.member_forces(set, (&self.gap_mm, &self.rigid_load), &kept.resistance);
        let greatest_force = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        // NaN is no force.
        let holds = force.iter().all(|f| *f >= -ROUND_OFF * greatest_force);
        if !holds || loose.is_some() {
            return false;
        }
        let gap_mm = rows.iter().zip(compliance.chunks_exact(force.len())).map(|(&row, compliance)| {
            let by_motion = rigid.iter().enumerate().map(|(a, amplitude)| self.rigid[(row, a)] * amplitude);
            self.gap_mm[row] + weighted_sum(compliance, &force) + by_motion.sum::<f64>()
        });
        let gap_mm: Vec<f64> = gap_mm.collect();
        let greatest_gap = gap_mm.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        if !gap_mm.iter().all(|gap| *gap >= -ROUND_OFF * greatest_gap) {
            return false;
        }
        set.members.iter().zip(&force).for_each(|(&member, own)| found.force[member] = *own);
        found.rigid.copy_from_slice(rigid.as_slice());
        found.log = ActiveSetLog { steps: vec![(force.len(), 0)], ..ActiveSetLog::default() };
        true
    }

    /// Forces if the members of a set carry the loads `q` on initial gaps `gap_mm`.
    fn member_forces(&self, set: &FactoredSet, (gap_mm, q): (&[f64], &[f64]), resistance: &[f64]) -> MemberForces {
        let FactoredSet { members, factor, by_motion, .. } = set;
        let m = q.len();
        let mut by_gap: Vec<f64> = members.iter().map(|&member| -gap_mm[member]).collect();
        solve_in_place(factor, &mut by_gap);
        let s = nalgebra::DMatrix::from_fn(m, m, |a, b| self.along_motion(a, members, column(by_motion.as_ref(), b)));
        let load = nalgebra::DVector::from_fn(m, |a, _| self.along_motion(a, members, &by_gap) - q[a]);
        let (alpha, loose) = held_motion(&s, &load, resistance);
        let mut force = by_gap;
        for (a, alpha) in alpha.iter().enumerate() {
            add_scaled(&mut force, column(by_motion.as_ref(), a), -alpha);
        }
        MemberForces { force, rigid: alpha, resistance: s, loose }
    }

    /// Gaps from `initial_mm` under the forces of the members of a set and amplitudes of the rigid motions.
    fn gaps_mm(&self, set: &FactoredSet, initial_mm: &[f64], force: &[f64], amplitudes: &[f64]) -> Vec<f64> {
        let mut gap_mm = vec![0.0; initial_mm.len()];
        let yields_mm = &set.others_compliance * ColRef::from_slice(force);
        for (&other, yields_mm) in set.others.iter().zip(yields_mm.iter()) {
            let by_motion = amplitudes.iter().enumerate().map(|(a, amplitude)| self.rigid[(other, a)] * amplitude);
            gap_mm[other] = initial_mm[other] + yields_mm + by_motion.sum::<f64>();
        }
        gap_mm
    }

    /// Product of column `a` of G with forces of `members`.
    fn along_motion(&self, a: usize, members: &[usize], force: &[f64]) -> f64 {
        members.iter().zip(force).map(|(&member, force)| self.rigid[(member, a)] * force).sum()
    }

    /// Factorised compliance of the `active` multipliers.
    fn factored(&self, active: &[bool]) -> Result<FactoredSet, ActiveSetError> {
        let (members, others): (Vec<usize>, Vec<usize>) = (0..active.len()).partition(|&i| active[i]);
        let k = members.len();
        let mut c = Mat::<f64>::zeros(k, k);
        let mut others_compliance = Mat::<f64>::zeros(others.len(), k);
        for (j, &member) in members.iter().enumerate() {
            let whole = column(self.compliance.as_ref(), member);
            // Only the lower triangle is read.
            for (entry, &i) in column_mut(&mut c, j)[j..].iter_mut().zip(&members[j..]) {
                *entry = whole[i];
            }
            for (entry, &i) in column_mut(&mut others_compliance, j).iter_mut().zip(&others) {
                *entry = whole[i];
            }
        }
        let factor = Llt::new(c.as_ref(), Side::Lower).map_err(|error| {
            let faer::linalg::solvers::LltError::NonPositivePivot { index } = error;
            ActiveSetError::NotPositiveDefinite { index: members[index.min(k - 1)] }
        })?;
        let mut by_motion = Mat::from_fn(k, self.rigid_load.len(), |i, a| self.rigid[(members[i], a)]);
        factor.solve_in_place(by_motion.as_mut());
        Ok(FactoredSet {
            active: active.to_vec(),
            members,
            factor,
            by_motion,
            others,
            others_compliance,
            watched: None,
        })
    }

    /// Active multipliers in tension and others that penetrate.
    fn wrong(&self, trial: &Trial, active: &[bool]) -> Vec<usize> {
        let greatest_force = trial.force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        let greatest_gap = trial.gap_mm.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        (0..active.len())
            .filter(|&i| match active[i] {
                true => trial.force[i] < -ROUND_OFF * greatest_force,
                false => trial.gap_mm[i] < -ROUND_OFF * greatest_gap,
            })
            .collect()
    }
}

/// Column of a matrix, all of which are stored by columns.
#[inline(always)]
fn column(matrix: MatRef<'_, f64>, j: usize) -> &[f64] {
    matrix.col(j).try_as_col_major().map_or(&[], |column| column.as_slice())
}

fn column_mut(matrix: &mut Mat<f64>, j: usize) -> &mut [f64] {
    matrix.col_mut(j).try_as_col_major_mut().map_or(&mut [], |column| column.as_slice_mut())
}

/// Adds factor · values to `sum`.
fn add_scaled(sum: &mut [f64], values: &[f64], factor: f64) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += value * factor;
    }
}

/// Solves S α = load by eigenvectors, S and α scaled by the greatest `resistance` to each motion. A motion that S does not hold is
/// returned and supported by a soft foundation.
fn held_motion(
    s: &nalgebra::DMatrix<f64>,
    load: &nalgebra::DVector<f64>,
    resistance: &[f64],
) -> (nalgebra::DVector<f64>, Option<Vec<f64>>) {
    let unit = nalgebra::DVector::from_iterator(load.len(), resistance.iter().map(|r| 1.0 / r.sqrt()));
    if load.is_empty() {
        return (unit, None);
    }
    // One motion is its own eigenvector.
    if load.len() == 1 && s[0] * unit[0] * unit[0] > SINGULAR {
        return (load / s[0], None);
    }
    let scaled = nalgebra::DMatrix::from_fn(load.len(), load.len(), |a, b| s[(a, b)] * unit[a] * unit[b]);
    let eigen = scaled.symmetric_eigen();
    let weakest = eigen.eigenvalues.imin();
    let holds = eigen.eigenvalues[weakest] > SINGULAR;
    let ground = if holds { 0.0 } else { SOFT_GROUND };
    let mut alpha = eigen.eigenvectors.tr_mul(&load.component_mul(&unit));
    for (a, value) in alpha.iter_mut().zip(eigen.eigenvalues.iter()) {
        *a /= value.max(0.0) + ground;
    }
    let alpha = (&eigen.eigenvectors * alpha).component_mul(&unit);
    (alpha, (!holds).then(|| eigen.eigenvectors.column(weakest).component_mul(&unit).iter().copied().collect()))
}
