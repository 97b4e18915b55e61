//! Dual active set method, for contacts that full exchanges run round in circles on.
//!
//! Forces minimise ½ fᵀ C f + g⁰ᵀ f under f ≥ 0 and Gᵀ f = q. Once no multiplier outside the active set penetrates, the members that pull are let go one
//! by one: the gap at one is opened until it carries nothing, and others whose gaps close on the way enter. The minimum over each set rises with
//! every opening, so that no set comes twice.
//!
//! Source: D. Goldfarb and A. Idnani, *Math. Program.* 27 (1983) 1–33.

use super::{ActiveSetError, ActiveSetLog, Condensed, FactoredSet, MOST_ITERATIONS, SINGULAR};

impl Condensed {
    /// Changes `active` to the active set of the equilibrium, as far as round-off and the greatest number of iterations allow.
    pub(super) fn let_pulling_go(
        &self,
        active: &mut [bool],
        resistance: &[f64],
        factored: &mut Option<FactoredSet>,
        log: &mut ActiveSetLog,
    ) -> Result<(), ActiveSetError> {
        while log.steps.len() < MOST_ITERATIONS {
            let trial = self.trial(active, resistance, factored, log)?;
            let wrong = self.wrong(&trial, active);
            log.steps.push((active.iter().filter(|a| **a).count(), wrong.len()));
            let (pulling, penetrating): (Vec<usize>, Vec<usize>) = wrong.into_iter().partition(|&i| active[i]);
            if !penetrating.is_empty() {
                log.changes += penetrating.len();
                penetrating.into_iter().for_each(|i| active[i] = true);
                continue;
            }
            // By the gap that its force closes.
            let pull_mm = |i: usize| trial.force[i] * self.compliance[(i, i)];
            let most = pulling.into_iter().min_by(|&a, &b| pull_mm(a).total_cmp(&pull_mm(b)));
            let Some(most) = most else { break };
            if !self.let_go(most, active, resistance, factored, log)? {
                break;
            }
        }
        Ok(())
    }

    /// Opens the gap at a member that pulls until it carries nothing; multipliers whose gaps close on the way enter. Returns whether it left.
    fn let_go(
        &self,
        member: usize,
        active: &mut [bool],
        resistance: &[f64],
        factored: &mut Option<FactoredSet>,
        log: &mut ActiveSetLog,
    ) -> Result<bool, ActiveSetError> {
        let mut opened_mm = 0.0;
        loop {
            let closed = self.trial(active, resistance, factored, log)?;
            let Some(set) = factored else { return Ok(false) };
            let per_mm = self.by_opening(set, member, resistance);
            let is_held = per_mm.force[member] * self.compliance[(member, member)] > SINGULAR;
            let until_mm = if is_held { -closed.force[member] / per_mm.force[member] } else { f64::INFINITY };
            let next = (0..active.len())
                .filter(|&i| !active[i] && per_mm.gap_mm[i] < 0.0)
                .map(|i| (i, (-closed.gap_mm[i] / per_mm.gap_mm[i]).max(opened_mm)))
                .min_by(|(_, a), (_, b)| a.total_cmp(b))
                .filter(|(_, closes_mm)| *closes_mm < until_mm);
            log.changes += 1;
            match next {
                Some((entering, closes_mm)) => {
                    active[entering] = true;
                    opened_mm = closes_mm;
                }
                None => {
                    active[member] = !is_held;
                    return Ok(is_held);
                }
            }
        }
    }
}
