//! Equilibrium of all slices in contact whose teeth hold their slices together.
//!
//! As in [`super::load_sharing`], but the teeth are no single springs ([`super::coupled_teeth`]). With t_i the first touch of a contact,
//! s_i its indentation, f_i what its bodies approach beside that, and u_i the deflection of its tooth,
//!
//! ```text
//! t_i + s_i + f_i(w_i) + u_i = δ          Σ w_i(s_i) = F          c_i = w_i'/(1 + w_i' f_i')
//! ```
//!
//! Only the contacts are nonlinear. Where all are ever steeper with their indentation, Newton converges from any start that carries too
//! much, as for single springs. Springs that soften under load are not: w ~ U^{1/(1+m)}, and where the first touch is between two samples
//! of a strip, U grows in proportion to the indentation, so that w is steepest at the first touch. There Newton may go to and fro between
//! touch and none for ever, and after some steps they are shortened. With a_i = s_i + f_i, in which every w_i grows, and l_i the loads that
//! the teeth are bent by, the equilibrium is the minimum of a convex function of δ and u:
//!
//! ```text
//! Σ ∫ w_i da_i + ½ Σ l_i u_i − F δ        its slope along a step:  Σ (w_i − l_i) Δa_i    where  Σ l_i = F
//! ```
//!
//! Where it rises at the end of a step by more than half as steeply as it fell at the beginning, the step ends before.

use super::bent_tooth::{Bend, ContactTangent};
use super::coupled_teeth::CoupledTeeth;
use super::load_sharing::{Equilibrium, EquilibriumError, GREATEST_IMBALANCE, MeshedPair, TOLERANCE};

/// Newton steps before giving up; three to six are usual.
const NEWTON_LIMIT: u64 = 80;
/// Steps after which they are shortened where need be.
const WHOLE_STEPS: u64 = 12;
/// How steep the convex function may be where a shortened step ends, over how steeply it falls at the beginning.
const GREATEST_RISE: f64 = 0.5;
/// Halvings of a step.
const HALVINGS: usize = 30;

/// Where a step leads: a_i of each contact and the load l_i that its tooth is bent by.
type Bent = Vec<(f64, f64)>;

/// Approach of a pair beyond `base_mm`, the first touch of any: nothing is lost where a light load meets a deep relief.
fn approach_mm(pair: &MeshedPair<'_>, base_mm: f64) -> f64 {
    (pair.touch_mm - base_mm) + pair.beyond_touch_mm()
}

/// Finds the equilibrium of `pairs`, whose own springs are infinitely stiff, on the teeth that they belong to, under the sum of
/// line loads `line_load` (> 0).
pub fn balance_on_teeth(
    pairs: &mut [MeshedPair<'_>],
    teeth: &mut CoupledTeeth,
    line_load: f64,
    position_mm: f64,
) -> Result<Equilibrium, EquilibriumError> {
    let mut evaluations = 0;
    let base_mm = pairs.iter().map(|pair| pair.touch_mm).fold(f64::INFINITY, f64::min);
    let expected = line_load / pairs.len() as f64;
    for pair in pairs.iter_mut() {
        let start = pair.start_mm(expected);
        pair.load_at(start);
        evaluations += 1;
    }
    let mut residual = f64::INFINITY;
    let mut before: Option<Bent> = None;
    for iterations in 1..=NEWTON_LIMIT {
        // Where rounding stands in the way, what a result may have is accepted.
        let tolerance = if 2 * iterations > NEWTON_LIMIT { GREATEST_IMBALANCE } else { TOLERANCE };
        let load: f64 = pairs.iter().map(|pair| pair.response.line_load_n_per_mm).sum();
        if !load.is_finite() {
            return Err(EquilibriumError::NotFinite { position_mm });
        }
        let tangent = |k: usize| ContactTangent {
            line_load_n_per_mm: pairs[k].response.line_load_n_per_mm,
            n_per_mm2: pairs[k].tangent_n_per_mm2(),
            approach_mm: approach_mm(&pairs[k], base_mm),
        };
        let Some(Bend { delta_mm, n_per_mm2 }) = teeth.bend(line_load, tangent) else {
            // No slice touches: begin again from where each would carry its part.
            for pair in pairs.iter_mut() {
                let ample = pair.contact.ample_indentation_mm(expected);
                pair.load_at(ample);
                evaluations += 1;
            }
            before = None;
            continue;
        };
        // What the indentation of a contact on the bent teeth lacks.
        let step = |pair: &MeshedPair<'_>, deflection_mm: f64| {
            (delta_mm - approach_mm(pair, base_mm) - deflection_mm) / pair.series()
        };
        let mut settled = (load - line_load).abs() <= tolerance * line_load;
        let mut greatest = 0.0_f64;
        teeth.each_deflection_mm(|k, mm2_per_n, deflection_mm| {
            let pair = &pairs[k];
            let step = step(pair, deflection_mm).abs();
            let stiffest = pair.response.stiffness_n_per_mm2.max(1.0 / mm2_per_n);
            settled &= step * stiffest <= tolerance * line_load || step <= pair.least_step_mm();
            greatest = greatest.max(step * stiffest);
        });
        if settled {
            let transmission_error_mm = base_mm + delta_mm;
            return Ok(Equilibrium { transmission_error_mm, n_per_mm2, iterations, pair_evaluations: evaluations });
        }
        residual = greatest / line_load;
        if iterations >= WHOLE_STEPS {
            let mut after = vec![(0.0, 0.0); pairs.len()];
            teeth.each_deflection_mm(|k, _, deflection_mm| {
                let pair = &pairs[k];
                let bent_mm = (delta_mm - deflection_mm) - (pair.touch_mm - base_mm);
                let further = pair.tangent_n_per_mm2() * (bent_mm - pair.beyond_touch_mm());
                after[k] = (bent_mm, pair.response.line_load_n_per_mm + further);
            });
            before = Some(shortened(pairs, before.as_ref(), after, &mut evaluations));
            continue;
        }
        teeth.each_deflection_mm(|k, _, deflection_mm| {
            let deeper = pairs[k].indentation_mm + step(&pairs[k], deflection_mm);
            pairs[k].load_at(deeper);
            evaluations += 1;
        });
    }
    Err(EquilibriumError::NotConverged { position_mm, residual, evaluations })
}

/// Presses every contact to where a step from `before`, where they are, ends on its way to `after`, and gives that place; the whole step
/// where they are not at any yet.
fn shortened(pairs: &mut [MeshedPair<'_>], before: Option<&Bent>, after: Bent, evaluations: &mut u64) -> Bent {
    let Some(before) = before else {
        press(pairs, &after, evaluations);
        return after;
    };
    let slope = |pairs: &[MeshedPair<'_>], at: &Bent| -> f64 {
        let steps = before.iter().zip(&after).map(|((from, _), (to, _))| to - from);
        let unbalanced = pairs.iter().zip(at).map(|(pair, (_, bent_by))| pair.response.line_load_n_per_mm - bent_by);
        unbalanced.zip(steps).map(|(load, step)| load * step).sum()
    };
    let greatest = GREATEST_RISE * slope(pairs, before).abs();
    let (mut low, mut high) = (0.0, 1.0);
    let mut part: f64 = 1.0;
    for _ in 0..HALVINGS {
        let between = |from: f64, to: f64| from + part * (to - from);
        let at = before.iter().zip(&after).map(|(from, to)| (between(from.0, to.0), between(from.1, to.1))).collect();
        press(pairs, &at, evaluations);
        let rise = slope(pairs, &at);
        if rise.abs() <= greatest || rise < 0.0 && part == 1.0 {
            return at;
        }
        if rise > 0.0 {
            high = part;
        } else {
            low = part;
        }
        part = 0.5 * (low + high);
    }
    // Rounding decides.
    press(pairs, &after, evaluations);
    after
}

fn press(pairs: &mut [MeshedPair<'_>], to: &Bent, evaluations: &mut u64) {
    pairs.iter_mut().zip(to).for_each(|(pair, (beyond_touch_mm, _))| *evaluations += pair.press_to(*beyond_touch_mm));
}
