//! Which multipliers carry load: the complementarity problem of contact, by a primal–dual active set method.
//!
//! Condensed onto its n multipliers, a contact of linear elastic bodies reads
//!
//! ```text
//! g = g⁰ + C f + G α ≥ 0,    f ≥ 0,    f_i g_i = 0,    Gᵀ f = q
//! ```
//!
//! f: forces of the multipliers, C their compliance (symmetric, positive definite on any active set), α the amplitudes of
//! the m rigid motions that no support prevents, q the loads they carry. For a guess A of the active set,
//!
//! ```text
//! S α = −Gᵀ C⁻¹ g⁰ − q,   S = Gᵀ C⁻¹ G,     C f = −g⁰ − G α        all restricted to A
//! ```
//!
//! and the next guess drops every member that pulls and adds every other that overlaps. That is Newton's method for the
//! nonsmooth equation f = max(0, f − c g), and converges in a few steps from any sensible start; but it may cycle. When
//! the number of wrong signs has not fallen for a while, one member at a time is exchanged instead (the last wrong one, by
//! number), which cannot cycle; the full exchange takes over again once the number has fallen.
//!
//! Source: M. Hintermüller, K. Ito and K. Kunisch, *SIAM J. Optim.* 13 (2003) 865–888; J. Júdice and F. Pires, *Comput.
//! Oper. Res.* 21 (1994) 587–596 (block principal pivoting and its backup).

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

/// Full exchanges without a fall of the number of wrong signs before single exchanges take over.
const PATIENCE: usize = 8;
/// Exchanges in all before giving up.
const MOST_ITERATIONS: usize = 2000;
/// Signs within this part of the greatest force or gap are round-off.
const ROUND_OFF: f64 = 1e-12;
/// Below this part of its scale a pivot of S says that the active set does not hold the bodies.
const SINGULAR: f64 = 1e-12;

/// The condensed problem.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// C, mm per N/mm.
    pub compliance: Mat<f64>,
    /// g⁰, mm.
    pub gap_mm: Vec<f64>,
    /// G: change of the gaps with each free rigid motion.
    pub rigid: Mat<f64>,
    /// q: load along each free rigid motion.
    pub rigid_load: Vec<f64>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// f, N/mm.
    pub force: Vec<f64>,
    /// g, mm.
    pub gap_mm: Vec<f64>,
    /// α.
    pub rigid: Vec<f64>,
    /// The active set, to start the next problem from.
    pub active: Vec<bool>,
    /// Work and how it went.
    pub log: Log,
}

/// How the iteration went.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Log {
    /// Size of the active set and number of wrong signs, iteration by iteration.
    pub steps: Vec<(usize, usize)>,
    /// Members that entered or left, all together.
    pub changes: usize,
    /// Times that single exchanges had to take over.
    pub cycles_broken: usize,
}

/// Why there is no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ActiveSetError {
    /// Nothing ever touches.
    #[error("the surfaces do not touch under this load: the smallest gap is {least_gap_mm:.3e} mm")]
    NoContact {
        /// Smallest gap found, mm.
        least_gap_mm: f64,
    },
    /// Contact does not hold the bodies against a rigid motion.
    #[error("neither supports nor contact hold the bodies against {motions} rigid motion(s): a body floats for ever")]
    Floating {
        /// How many motions are free.
        motions: usize,
    },
    /// The multipliers are not independent.
    #[error("the contact compliance is not positive definite at multiplier {index}")]
    NotPositiveDefinite {
        /// Which.
        index: usize,
    },
    /// No end within the allowed number of exchanges.
    #[error("no active set has the right signs after {iterations} exchanges; {wrong} are wrong")]
    MaxIterations {
        /// Exchanges made.
        iterations: usize,
        /// Wrong signs left.
        wrong: usize,
    },
    /// Numbers that are none.
    #[error("the contact problem holds numbers that are not finite")]
    NotFinite,
}

struct Trial {
    force: Vec<f64>,
    gap_mm: Vec<f64>,
    rigid: Vec<f64>,
    /// Whether the active set holds every rigid motion.
    holds: bool,
}

impl Condensed {
    /// Solves from the active set `start`, or from the first touch.
    ///
    /// # Errors
    /// See [`ActiveSetError`].
    pub fn solve(&self, start: Option<&[bool]>) -> Result<Equilibrium, ActiveSetError> {
        let n = self.gap_mm.len();
        if !self.is_finite() {
            return Err(ActiveSetError::NotFinite);
        }
        let mut active = match start {
            Some(start) if start.len() == n && start.contains(&true) => start.to_vec(),
            _ => self.first_touch()?,
        };
        let mut log = Log::default();
        let (mut fewest, mut patience, mut one_by_one) = (usize::MAX, PATIENCE, false);
        for _ in 0..MOST_ITERATIONS {
            let trial = self.trial(&active)?;
            let wrong = self.wrong(&trial, &active);
            log.steps.push((active.iter().filter(|a| **a).count(), wrong.len()));
            if wrong.is_empty() {
                return self.finished(trial, active, log);
            }
            if wrong.len() < fewest {
                (fewest, patience, one_by_one) = (wrong.len(), PATIENCE, false);
            } else if patience > 0 {
                patience -= 1;
            } else if !one_by_one {
                one_by_one = true;
                log.cycles_broken += 1;
            }
            let exchanged = if one_by_one { &wrong[wrong.len() - 1..] } else { &wrong[..] };
            log.changes += exchanged.len();
            for &i in exchanged {
                active[i] = !active[i];
            }
        }
        let wrong = log.steps.last().map_or(0, |step| step.1);
        Err(ActiveSetError::MaxIterations { iterations: MOST_ITERATIONS, wrong })
    }

    fn finished(&self, trial: Trial, active: Vec<bool>, log: Log) -> Result<Equilibrium, ActiveSetError> {
        if !active.contains(&true) {
            let least_gap_mm = trial.gap_mm.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(ActiveSetError::NoContact { least_gap_mm });
        }
        if !trial.holds {
            return Err(ActiveSetError::Floating { motions: self.rigid_load.len() });
        }
        Ok(Equilibrium { force: trial.force, gap_mm: trial.gap_mm, rigid: trial.rigid, active, log })
    }

    fn is_finite(&self) -> bool {
        let finite = |matrix: &Mat<f64>| matrix.col_iter().all(|column| column.iter().all(|v| v.is_finite()));
        finite(&self.compliance)
            && finite(&self.rigid)
            && self.gap_mm.iter().chain(&self.rigid_load).all(|value| value.is_finite())
    }

    /// The multipliers that touch first when the loads move the free bodies.
    fn first_touch(&self) -> Result<Vec<bool>, ActiveSetError> {
        let n = self.gap_mm.len();
        let least_gap_mm = self.gap_mm.iter().copied().fold(f64::INFINITY, f64::min);
        // Direction in which the loads push: α along −q, for Gᵀ f = q means that contact pushes back by q.
        let closing: Vec<f64> =
            (0..n).map(|i| self.rigid_load.iter().enumerate().map(|(k, q)| self.rigid[(i, k)] * q).sum()).collect();
        let path = |i: usize| self.gap_mm[i].max(0.0) / closing[i];
        let first = (0..n).filter(|&i| closing[i] > 0.0).map(path).fold(f64::INFINITY, f64::min);
        let moved: Vec<f64> = match (first.is_finite(), self.rigid_load.is_empty()) {
            (true, _) => (0..n).map(|i| self.gap_mm[i] - first * closing[i]).collect(),
            (false, true) => self.gap_mm.clone(),
            (false, false) => return Err(ActiveSetError::NoContact { least_gap_mm }),
        };
        let touching: Vec<bool> = (0..n).map(|i| moved[i] <= ROUND_OFF * (1.0 + self.gap_mm[i].abs())).collect();
        if touching.contains(&true) { Ok(touching) } else { Err(ActiveSetError::NoContact { least_gap_mm }) }
    }

    /// Forces and gaps if exactly the `active` multipliers carry load.
    fn trial(&self, active: &[bool]) -> Result<Trial, ActiveSetError> {
        let members: Vec<usize> = (0..active.len()).filter(|&i| active[i]).collect();
        let (k, m) = (members.len(), self.rigid_load.len());
        let c = Mat::from_fn(k, k, |i, j| self.compliance[(members[i], members[j])]);
        let factor = Llt::new(c.as_ref(), Side::Lower).map_err(|error| {
            let faer::linalg::solvers::LltError::NonPositivePivot { index } = error;
            ActiveSetError::NotPositiveDefinite { index: members[index.min(k - 1)] }
        })?;
        // C⁻¹ applied to −g⁰ and to the columns of G.
        let mut sides = Mat::from_fn(k, m + 1, |i, j| match j {
            0 => -self.gap_mm[members[i]],
            _ => self.rigid[(members[i], j - 1)],
        });
        factor.solve_in_place(sides.as_mut());
        let product = |j: usize, a: usize| -> f64 { (0..k).map(|i| self.rigid[(members[i], a)] * sides[(i, j)]).sum() };
        let s = nalgebra::DMatrix::from_fn(m, m, |a, b| product(b + 1, a));
        let load = nalgebra::DVector::from_fn(m, |a, _| product(0, a) - self.rigid_load[a]);
        let (alpha, holds) = held_motion(&s, &load);
        let mut force = vec![0.0; active.len()];
        for (i, &member) in members.iter().enumerate() {
            force[member] = sides[(i, 0)] - (0..m).map(|a| sides[(i, a + 1)] * alpha[a]).sum::<f64>();
        }
        let mut gap_mm = self.gap_mm.clone();
        for &member in &members {
            let f = force[member];
            for (gap, c) in gap_mm.iter_mut().zip(self.compliance.col(member).iter()) {
                *gap += c * f;
            }
        }
        for (a, alpha) in alpha.iter().enumerate() {
            for (gap, g) in gap_mm.iter_mut().zip(self.rigid.col(a).iter()) {
                *gap += g * alpha;
            }
        }
        for &member in &members {
            gap_mm[member] = 0.0;
        }
        Ok(Trial { force, gap_mm, rigid: alpha.iter().copied().collect(), holds })
    }

    /// Active multipliers that pull and others that overlap.
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

/// Solves S α = load by eigenvectors; motions that S does not hold get a soft ground instead, and `false` is told.
fn held_motion(s: &nalgebra::DMatrix<f64>, load: &nalgebra::DVector<f64>) -> (nalgebra::DVector<f64>, bool) {
    if load.is_empty() {
        return (load.clone(), true);
    }
    let eigen = s.clone().symmetric_eigen();
    let greatest = eigen.eigenvalues.amax();
    let soft = SINGULAR * greatest;
    let holds = eigen.eigenvalues.iter().all(|value| *value > soft);
    let ground = if holds { 0.0 } else { 1e-6 * greatest };
    let mut alpha = eigen.eigenvectors.tr_mul(load);
    for (a, value) in alpha.iter_mut().zip(eigen.eigenvalues.iter()) {
        *a /= value + ground;
    }
    (&eigen.eigenvectors * alpha, holds)
}
