//! Equilibrium of all slices in contact whose teeth couple their slices.
//!
//! As in [`super::load_sharing`], but with coupled teeth ([`super::coupled_teeth`]) in place of single springs. With the first touch t_i of a contact,
//! its indentation s_i, the approach f_i of its bodies beyond that, and the deflection u_i of its tooth,
//!
//! ```text
//! t_i + s_i + f_i(w_i) + u_i = δ          Σ w_i(s_i) = F          c_i = w_i'/(1 + w_i' f_i')
//! ```
//!
//! Only the contacts are nonlinear. Where all steepen with their indentation, Newton's method converges from any start that carries too
//! much, as for single springs. Springs that soften under load do not: w ~ U^{1/(1+m)}, and where the first touch is between two samples
//! of a strip, U grows in proportion to the indentation, so that w is steepest at the first touch. There Newton's method may alternate between
//! touch and none for ever, and its steps are shortened after some of them. With a_i = s_i + f_i, in which every w_i grows, and the loads l_i that
//! bend the teeth, the equilibrium is the minimum of a convex function of δ and u:
//!
//! ```text
//! Σ ∫ w_i da_i + ½ Σ l_i u_i − F δ        its slope along a step:  Σ (w_i − l_i) Δa_i    where  Σ l_i = F
//! ```
//!
//! Where it rises at the end of a step by more than half as steeply as it fell at the beginning, the step ends before.

use super::bent_tooth::{Bend, ContactTangent};
use super::coupled_teeth::CoupledTeeth;
use super::load_sharing::{
    EquilibriumError, GREATEST_IMBALANCE, MeshedPair, PairEquilibrium, TOLERANCE, press_amply, press_to_start,
};

/// Newton steps before giving up; three to six are usual.
const NEWTON_LIMIT: u64 = 80;
/// Steps from which on they are shortened where need be.
const WHOLE_STEPS: u64 = 12;
/// Greatest slope of the convex function at the end of a shortened step, over that at its beginning.
const GREATEST_RISE: f64 = 0.5;
/// Greatest number of bisections of a step.
const HALVINGS: usize = 30;

/// End of a step: a_i of each contact and the load l_i that bends its tooth.
type Bent = Vec<(f64, f64)>;

/// A Newton step on the bent teeth.
struct BentStep {
    /// First touch of any contact, mm: approaches are counted from it, so that a light load on a deep relief keeps its digits.
    base_mm: f64,
    /// δ from there on, mm.
    delta_mm: f64,
}

/// Approach of a pair beyond `base_mm`.
fn approach_mm(pair: &MeshedPair<'_>, base_mm: f64) -> f64 {
    (pair.touch_mm - base_mm) + pair.beyond_touch_mm()
}

impl BentStep {
    /// Change of the indentation of a contact where its tooth is bent by `deflection_mm`.
    fn deeper_mm(&self, pair: &MeshedPair<'_>, deflection_mm: f64) -> f64 {
        (self.delta_mm - approach_mm(pair, self.base_mm) - deflection_mm) / pair.series()
    }

    /// Whether no contact would change its load by more than `tolerance`, N/mm; and the greatest change, N/mm.
    fn settles(&self, pairs: &[MeshedPair<'_>], teeth: &CoupledTeeth, tolerance: f64) -> (bool, f64) {
        let (mut settled, mut greatest) = (true, 0.0_f64);
        teeth.each_deflection_mm(|k, mm2_per_n, deflection_mm| {
            let pair = &pairs[k];
            let step = self.deeper_mm(pair, deflection_mm).abs();
            let stiffest = pair.response.stiffness_n_per_mm2.max(1.0 / mm2_per_n);
            settled &= step * stiffest <= tolerance || step <= pair.least_step_mm();
            greatest = greatest.max(step * stiffest);
        });
        (settled, greatest)
    }

    /// End of the whole step.
    fn end(&self, pairs: &[MeshedPair<'_>], teeth: &CoupledTeeth) -> Bent {
        let mut end = vec![(0.0, 0.0); pairs.len()];
        teeth.each_deflection_mm(|k, _, deflection_mm| {
            let pair = &pairs[k];
            let bent_mm = (self.delta_mm - deflection_mm) - (pair.touch_mm - self.base_mm);
            let further = pair.tangent_n_per_mm2() * (bent_mm - pair.beyond_touch_mm());
            end[k] = (bent_mm, pair.response.line_load_n_per_mm + further);
        });
        end
    }
}

/// Finds the equilibrium of `pairs`, whose own springs are infinitely stiff, on the teeth that they belong to, under the sum of
/// line loads `line_load` (> 0).
pub fn balance_on_teeth(
    pairs: &mut [MeshedPair<'_>],
    teeth: &mut CoupledTeeth,
    line_load: f64,
    position_mm: f64,
) -> Result<PairEquilibrium, EquilibriumError> {
    let base_mm = pairs.iter().map(|pair| pair.touch_mm).fold(f64::INFINITY, f64::min);
    let expected = line_load / pairs.len() as f64;
    let mut evaluations = press_to_start(pairs, expected);
    let mut residual = f64::INFINITY;
    let mut before: Option<Bent> = None;
    let indefinite_before = teeth.indefinite_steps();
    for iterations in 1..=NEWTON_LIMIT {
        let tolerance = if 2 * iterations > NEWTON_LIMIT { GREATEST_IMBALANCE } else { TOLERANCE };
        let load: f64 = pairs.iter().map(|pair| pair.response.line_load_n_per_mm).sum();
        if !load.is_finite() {
            return Err(EquilibriumError::NotFinite { position_mm });
        }
        let bend = teeth.bend(line_load, |k| ContactTangent {
            line_load_n_per_mm: pairs[k].response.line_load_n_per_mm,
            n_per_mm2: pairs[k].tangent_n_per_mm2(),
            approach_mm: approach_mm(&pairs[k], base_mm),
        });
        let Some(Bend { delta_mm, n_per_mm2 }) = bend else {
            evaluations += press_amply(pairs, expected);
            before = None;
            continue;
        };
        let step = BentStep { base_mm, delta_mm };
        let (settled, greatest) = step.settles(pairs, teeth, tolerance * line_load);
        if settled && (load - line_load).abs() <= tolerance * line_load {
            let transmission_error_mm = base_mm + delta_mm;
            return Ok(PairEquilibrium { transmission_error_mm, n_per_mm2, iterations, pair_evaluations: evaluations });
        }
        residual = greatest / line_load;
        if iterations >= WHOLE_STEPS {
            let after = step.end(pairs, teeth);
            before = Some(shortened(pairs, before.as_ref(), after, &mut evaluations));
            continue;
        }
        teeth.each_deflection_mm(|k, _, deflection_mm| {
            let deeper = pairs[k].indentation_mm + step.deeper_mm(&pairs[k], deflection_mm);
            pairs[k].load_at(deeper);
            evaluations += 1;
        });
    }
    // No convex function then has its minimum at the equilibrium.
    match teeth.indefinite_steps() > indefinite_before {
        true => Err(EquilibriumError::NegativeCompliance { position_mm }),
        false => Err(EquilibriumError::NotConverged { position_mm, residual, evaluations }),
    }
}

/// Presses every contact to the end of a step from `before` towards `after`, shortened where need be, and gives that end; the whole step
/// without a `before`.
fn shortened(pairs: &mut [MeshedPair<'_>], before: Option<&Bent>, after: Bent, evaluations: &mut u64) -> Bent {
    let Some(before) = before else {
        press(pairs, &after, evaluations);
        return after;
    };
    let greatest = GREATEST_RISE * slope(pairs, before, [before, &after]).abs();
    let (mut low, mut high) = (0.0, 1.0);
    let mut part: f64 = 1.0;
    for _ in 0..HALVINGS {
        let steps = before.iter().zip(&after);
        let at = steps.map(|(from, to)| (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))).collect();
        press(pairs, &at, evaluations);
        let rise = slope(pairs, &at, [before, &after]);
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
    // Rounding errors decide.
    press(pairs, &after, evaluations);
    after
}

/// Slope of the convex function `at` a place of the step from one place to the other.
fn slope(pairs: &[MeshedPair<'_>], at: &Bent, [from, to]: [&Bent; 2]) -> f64 {
    let steps = from.iter().zip(to).map(|((from, _), (to, _))| to - from);
    let unbalanced = pairs.iter().zip(at).map(|(pair, (_, bent_by))| pair.response.line_load_n_per_mm - bent_by);
    unbalanced.zip(steps).map(|(load, step)| load * step).sum()
}

fn press(pairs: &mut [MeshedPair<'_>], to: &Bent, evaluations: &mut u64) {
    pairs.iter_mut().zip(to).for_each(|(pair, (beyond_touch_mm, _))| *evaluations += pair.press_to(*beyond_touch_mm));
}
