//! Equilibrium of all slices in contact whose teeth hold their slices together.
//!
//! As in [`super::load_sharing`], but the teeth are no single springs: the deflections u of the slices of one tooth follow from all
//! loads on it through the operator K of [`super::slice_coupling`], K v = √q w with u = √q v. For every slice in contact
//!
//! ```text
//! s_i + u_i + w_i(s_i)-further = δ          K v = √q w(s)  for every tooth          Σ w_i = F
//! ```
//!
//! Newton's method with all unknowns together: with c_i = w_i'/(1 + w_i' f_i'), and h_i = s_i + u_i + …, the approach that a
//! slice has so far,
//!
//! ```text
//! (K + diag(q c)) Δv = √q w − K v + √q c (δ − h)          Σ w + Σ c (δ − h − √q Δv) = F
//! ```
//!
//! The matrix has two bands beside its diagonal, so that an iteration costs no more than pressing the contacts once. Only the contacts are
//! nonlinear, ever steeper with their depth: Newton converges from any start that carries too much, as for single springs.

use std::ops::Range;

use super::load_sharing::{Equilibrium, EquilibriumError, GREATEST_IMBALANCE, MeshedPair, TOLERANCE};
use super::slice_coupling::SliceCoupling;

/// Newton steps before giving up; three to six are usual.
const NEWTON_LIMIT: u64 = 80;

/// The slices of one tooth in contact.
pub struct ToothInMesh {
    /// Which of the contacts are its own.
    pub contacts: Range<usize>,
    /// The slice of each.
    pub slice: Vec<usize>,
    /// √q of each: q is the compliance of the teeth, mm²/N.
    pub root_compliance: Vec<f64>,
    /// v = u/√q of every slice, in contact or not.
    v: Vec<f64>,
    scratch: Scratch,
}

/// What an iteration works on, one value a slice.
#[derive(Default)]
struct Scratch {
    diagonal: Vec<f64>,
    /// Change of v at δ = 0.
    fixed: Vec<f64>,
    /// Change of v with δ.
    with_approach: Vec<f64>,
}

impl ToothInMesh {
    /// A tooth of so many slices, not yet bent.
    pub fn new(contacts: Range<usize>, slice: Vec<usize>, root_compliance: Vec<f64>, slices: usize) -> Self {
        let zeros = || vec![0.0; slices];
        let scratch = Scratch { diagonal: zeros(), fixed: zeros(), with_approach: zeros() };
        Self { contacts, slice, root_compliance, v: zeros(), scratch }
    }

    /// Deflection of the teeth at each contact, mm.
    fn deflection_mm(&self, contact: usize) -> f64 {
        self.root_compliance[contact] * self.v[self.slice[contact]]
    }

    /// Prepares Δv as fixed + δ · with_approach.
    fn linearise(&mut self, coupling: &SliceCoupling, pairs: &[MeshedPair<'_>], base_mm: f64) {
        let Scratch { diagonal, fixed, with_approach } = &mut self.scratch;
        diagonal.fill(0.0);
        with_approach.fill(0.0);
        coupling.apply(&self.v, fixed);
        fixed.iter_mut().for_each(|value| *value = -*value);
        for (k, pair) in pairs[self.contacts.clone()].iter().enumerate() {
            let (root, slice) = (self.root_compliance[k], self.slice[k]);
            let tangent = pair.response.stiffness_n_per_mm2 / pair.series();
            let approach = approach_mm(pair, base_mm) + root * self.v[slice];
            diagonal[slice] = root * root * tangent;
            with_approach[slice] = root * tangent;
            fixed[slice] += root * (pair.response.line_load_n_per_mm - tangent * approach);
        }
        let factors = coupling.factorise(diagonal);
        factors.solve(fixed);
        factors.solve(with_approach);
    }
}

/// Approach of a pair beyond `base_mm`, the first touch of any: nothing is lost where a light load meets a deep relief.
fn approach_mm(pair: &MeshedPair<'_>, base_mm: f64) -> f64 {
    (pair.touch_mm - base_mm) + pair.whole_depth_mm()
}

/// Finds the equilibrium of `pairs`, whose own springs are infinitely stiff, on the teeth that they belong to, under the sum of
/// line loads `line_load` (> 0).
///
/// # Errors
/// [`EquilibriumError`].
pub fn balance_on_teeth(
    pairs: &mut [MeshedPair<'_>],
    teeth: &mut [ToothInMesh],
    coupling: &SliceCoupling,
    line_load: f64,
    position_mm: f64,
) -> Result<Equilibrium, EquilibriumError> {
    let mut evaluations = 0;
    let base_mm = pairs.iter().map(|pair| pair.touch_mm).fold(f64::INFINITY, f64::min);
    let expected = line_load / pairs.len() as f64;
    for pair in pairs.iter_mut() {
        let start = pair.start_mm(expected);
        pair.press(start);
        evaluations += 1;
    }
    let mut residual = f64::INFINITY;
    for iterations in 1..=NEWTON_LIMIT {
        // Where rounding stands in the way, what a result may have is accepted.
        let tolerance = if 2 * iterations > NEWTON_LIMIT { GREATEST_IMBALANCE } else { TOLERANCE };
        let load: f64 = pairs.iter().map(|pair| pair.response.line_load_n_per_mm).sum();
        if !load.is_finite() {
            return Err(EquilibriumError::NotFinite { position_mm });
        }
        // Σ w + Σ c (δ − h − √q Δv) = F, collected by δ.
        let (mut carried, mut stiffness) = (load, 0.0);
        for tooth in teeth.iter_mut() {
            tooth.linearise(coupling, pairs, base_mm);
            for (k, pair) in pairs[tooth.contacts.clone()].iter().enumerate() {
                let (root, slice) = (tooth.root_compliance[k], tooth.slice[k]);
                let tangent = pair.response.stiffness_n_per_mm2 / pair.series();
                let approach = approach_mm(pair, base_mm) + tooth.deflection_mm(k);
                carried -= tangent * (approach + root * tooth.scratch.fixed[slice]);
                stiffness += tangent * (1.0 - root * tooth.scratch.with_approach[slice]);
            }
        }
        if stiffness <= 0.0 {
            // No slice touches: begin again from where each would carry its part.
            for pair in pairs.iter_mut() {
                let ample = pair.contact.ample_depth_mm(expected);
                pair.press(ample);
                evaluations += 1;
            }
            continue;
        }
        let delta = (line_load - carried) / stiffness;
        let mut settled = (load - line_load).abs() <= tolerance * line_load;
        let mut greatest = 0.0_f64;
        for tooth in teeth.iter_mut() {
            for (k, pair) in pairs[tooth.contacts.clone()].iter().enumerate() {
                let step = tooth.step_mm(k, pair, delta, base_mm);
                let stiffest = pair.response.stiffness_n_per_mm2.max(1.0 / tooth.root_compliance[k].powi(2));
                let least = 8.0 * f64::EPSILON * approach_mm(pair, base_mm).abs().max(delta.abs());
                settled &= step.abs() * stiffest <= tolerance * line_load || step.abs() <= least;
                greatest = greatest.max(step.abs() * stiffest);
            }
        }
        if settled {
            let transmission_error_mm = base_mm + delta;
            return Ok(Equilibrium { transmission_error_mm, iterations, pair_evaluations: evaluations });
        }
        residual = greatest / line_load;
        for tooth in teeth.iter_mut() {
            for k in 0..tooth.slice.len() {
                let pair = &mut pairs[tooth.contacts.start + k];
                let deeper = pair.depth_mm + tooth.step_mm(k, pair, delta, base_mm);
                pair.press(deeper);
                evaluations += 1;
            }
            let Scratch { fixed, with_approach, .. } = &tooth.scratch;
            for ((v, fixed), with_approach) in tooth.v.iter_mut().zip(fixed).zip(with_approach) {
                *v += fixed + delta * with_approach;
            }
        }
    }
    Err(EquilibriumError::NotConverged { position_mm, residual, evaluations })
}

impl ToothInMesh {
    /// Change of the depth of a contact in this iteration, with the gears `delta_mm` together beyond `base_mm`.
    fn step_mm(&self, contact: usize, pair: &MeshedPair<'_>, delta_mm: f64, base_mm: f64) -> f64 {
        let (root, slice) = (self.root_compliance[contact], self.slice[contact]);
        let bends = self.scratch.fixed[slice] + delta_mm * self.scratch.with_approach[slice];
        let lacks = delta_mm - approach_mm(pair, base_mm) - root * (self.v[slice] + bends);
        lacks / pair.series()
    }
}
