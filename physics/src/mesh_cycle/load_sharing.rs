//! Equilibrium of all tooth pairs in mesh.
//!
//! The gears approach each other by the transmission error δ along the line of action; each pair i is the spring k_i of
//! its teeth in series with its contact surface, whose approach s_i carries the load w_i(s_i):
//!
//! ```text
//! s_i + w_i(s_i)/k_i = δ  for every pair          Σ w_i(s_i) = F
//! ```
//!
//! w_i grows and steepens with s_i, so Newton's method, all unknowns together, converges from any start above the
//! solution without damping. With c_i = w_i'/(1 + w_i'/k_i), the tangent stiffness of a pair, one step is
//!
//! ```text
//! δ   ← (F − Σ w_i + Σ c_i (s_i + w_i/k_i)) / Σ c_i
//! s_i ← s_i + (δ − s_i − w_i/k_i) / (1 + w_i'/k_i)
//! ```
//!
//! Where Newton's method does not converge (a gap so rough that rounding errors decide), both equations are solved by bisection, as both are
//! monotonic.

use super::Work;
use super::tip_contact::OnLever;
use crate::contact::{PairContact, Response};
use gearwear_bodies::gear::{PerGear, normal_section::Obliquity};
use gearwear_fem::active_set::ActiveSetError;

/// Greatest imbalance, relative to the load, at which an equilibrium is accepted.
pub const TOLERANCE: f64 = 1e-11;
/// Greatest imbalance, relative to the load, at which a result is accepted where rounding errors prevent [`TOLERANCE`].
pub(crate) const GREATEST_IMBALANCE: f64 = 1e-10;
/// Newton steps before bisection takes over; three to five are usual.
const NEWTON_LIMIT: u64 = 40;
/// Bisections of an interval: far below any rounding error of its ends.
const BISECTION_LIMIT: usize = 100;

/// Reason why there is no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EquilibriumError {
    /// A load or stiffness was not a number.
    #[error("the load of a tooth pair is not a number at position {position_mm:.4} mm")]
    NotFinite {
        /// Position of the reference pair.
        position_mm: f64,
    },
    /// The finite-element contact at a position was not found.
    #[error("at position {position_mm:.4} mm: {source}")]
    Contact {
        /// Position of the reference pair.
        position_mm: f64,
        /// Failure of the solver.
        source: ActiveSetError,
    },
    /// The user stops the run.
    #[error("interrupted")]
    Interrupted,
    /// Finite elements of teeth in space, corrected for their local error, have a negative compliance, and the load has come to contacts where they do.
    #[error(
        "at position {position_mm:.4} mm the load comes to tip edges where the corrected compliance of the teeth in space is negative, as their elements are too \
         coarse there: use helical.coupling = \"slicing\", less load, or tip relief"
    )]
    NegativeCompliance {
        /// Position of the reference pair.
        position_mm: f64,
    },
    /// Neither Newton's method nor bisection met the tolerance.
    #[error(
        "the loads of the tooth pairs do not balance at position {position_mm:.4} mm: \
         relative residual {residual:.1e} after {evaluations} evaluations"
    )]
    NotConverged {
        /// Position of the reference pair.
        position_mm: f64,
        /// Imbalance over load.
        residual: f64,
        /// Contact evaluations spent.
        evaluations: u64,
    },
}

/// A pair in mesh with its state from one wear step to the next.
pub struct MeshedPair<'a> {
    /// Contact of its flanks.
    pub contact: Box<dyn PairContact + 'a>,
    /// Response to the last indentation.
    pub response: Response,
    /// Approach of the bodies beyond that indentation, and its derivative by the load.
    further: (f64, f64),
    teeth_n_per_mm2: f64,
    /// Lever of the load on the pinion over the base radius.
    lever_ratio: f64,
    /// Approach at which the flanks first touch, mm.
    pub(super) touch_mm: f64,
    /// Approach of the flanks beyond their first touch, mm.
    pub(super) indentation_mm: f64,
    /// Indentations at the last three equilibria, the newest first: the next iteration starts from their extrapolation.
    history_mm: [Option<f64>; 3],
}

/// Equilibrium of the pairs in mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PairEquilibrium {
    /// δ.
    pub transmission_error_mm: f64,
    /// dF/dδ of all pairs together, N/mm².
    pub n_per_mm2: f64,
    /// Newton steps taken.
    pub iterations: u64,
    /// Evaluations of a pair's contact.
    pub pair_evaluations: u64,
}

impl<'a> MeshedPair<'a> {
    /// A pair that has not carried load yet.
    pub fn new(contact: Box<dyn PairContact + 'a>, teeth_n_per_mm2: f64) -> Self {
        Self {
            contact,
            response: Response::default(),
            further: (0.0, 0.0),
            teeth_n_per_mm2,
            lever_ratio: 1.0,
            touch_mm: 0.0,
            indentation_mm: 0.0,
            history_mm: [None; 3],
        }
    }

    /// A pair that has not carried load yet, whose load has a lever on the pinion of `ratio` base radii, 1 on the line of action, and an oblique
    /// normal.
    pub(crate) fn on_lever(
        contact: Box<dyn PairContact + 'a>,
        teeth_n_per_mm2: f64,
        ratio: f64,
        obliquity: Obliquity,
    ) -> Self {
        if ratio == 1.0 && obliquity == Obliquity::SPUR {
            return Self::new(contact, teeth_n_per_mm2);
        }
        // The spring of the teeth is pressed along the same normal.
        let on_lever = OnLever { contact, approach: obliquity.normal_mm(ratio), load: ratio };
        let pressed = Self::new(Box::new(on_lever), ratio * ratio * teeth_n_per_mm2);
        Self { lever_ratio: ratio, ..pressed }
    }

    /// Normal load of the flanks, N per mm of the line of contact; the load of the response is the torque of this one over the base radius.
    pub(super) fn normal_load_n_per_mm(&self) -> f64 {
        self.response.line_load_n_per_mm / self.lever_ratio
    }

    /// Takes the material removed from both flanks.
    pub fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        self.contact.set_removed(removed_mm);
        self.touch_mm = self.contact.touch_mm();
    }

    /// Returns to the state of a pair that has not carried load yet.
    pub(super) fn reset(&mut self) {
        self.contact.reset();
        (self.response, self.further) = (Response::default(), (0.0, 0.0));
        (self.touch_mm, self.indentation_mm) = (0.0, 0.0);
        self.history_mm = [None; 3];
    }

    /// Keeps the present indentation as a start for later.
    fn remember(&mut self) {
        self.history_mm = [Some(self.indentation_mm), self.history_mm[0], self.history_mm[1]];
    }

    pub(super) fn load_at(&mut self, indentation_mm: f64) {
        self.indentation_mm = indentation_mm;
        self.response = self.contact.load_at(indentation_mm);
        self.further = self.contact.further_approach_mm(self.response.line_load_n_per_mm);
    }

    pub(super) fn start_mm(&self, line_load: f64) -> f64 {
        match self.history_mm {
            [Some(last), Some(before), Some(first)] => 3.0 * (last - before) + first,
            [Some(last), Some(before), None] => 2.0 * last - before,
            [Some(last), ..] => last,
            [None, ..] => self.contact.ample_indentation_mm(line_load),
        }
    }

    /// Approach of the whole pair beyond the first touch of its flanks, teeth included.
    pub(super) fn beyond_touch_mm(&self) -> f64 {
        self.indentation_mm + self.response.line_load_n_per_mm / self.teeth_n_per_mm2 + self.further.0
    }

    /// Presses the pair until it has approached by `whole_mm` beyond its first touch. Returns the number of evaluations.
    pub(super) fn press_to(&mut self, whole_mm: f64) -> u64 {
        self.load_at(whole_mm);
        let mut evaluations = 1;
        // The indentation is the whole approach less that of teeth and bodies.
        let beside = self.beyond_touch_mm() - whole_mm;
        let (mut low, mut high) = (whole_mm - beside.max(0.0), whole_mm);
        while self.beyond_touch_mm() < whole_mm && evaluations < 2 + BISECTION_LIMIT as u64 {
            (low, high) = (high, high + 2.0 * (whole_mm - self.beyond_touch_mm()));
            self.load_at(high);
            evaluations += 1;
        }
        for _ in 0..BISECTION_LIMIT {
            let lacks = whole_mm - self.beyond_touch_mm();
            if lacks.abs() <= self.least_step_mm() {
                break;
            }
            if lacks > 0.0 {
                low = self.indentation_mm;
            } else {
                high = self.indentation_mm;
            }
            // Newton's step, or bisection where that leads out of the interval.
            let step = self.indentation_mm + lacks / self.series();
            let next = if step > low && step < high { step } else { low.midpoint(high) };
            if next <= low || next >= high {
                break;
            }
            self.load_at(next);
            evaluations += 1;
        }
        evaluations
    }

    /// Approach of the whole pair.
    pub(super) fn whole_approach_mm(&self) -> f64 {
        self.touch_mm + self.beyond_touch_mm()
    }

    /// Least change of indentation above rounding errors: that of the parts, which may nearly cancel in their sum.
    pub(super) fn least_step_mm(&self) -> f64 {
        8.0 * f64::EPSILON * self.touch_mm.abs().max(self.indentation_mm.abs()).max(self.beyond_touch_mm().abs())
    }

    /// Approach of this pair less that of `other`, without loss of digits where both touch at the same approach.
    fn ahead_of(&self, other: &Self) -> f64 {
        (self.touch_mm - other.touch_mm) + (self.beyond_touch_mm() - other.beyond_touch_mm())
    }

    /// c = w'/(1 + w'/k).
    pub(super) fn tangent_n_per_mm2(&self) -> f64 {
        self.response.stiffness_n_per_mm2 / self.series()
    }

    /// 1 + w'/k.
    pub(super) fn series(&self) -> f64 {
        1.0 + self.response.stiffness_n_per_mm2 * (1.0 / self.teeth_n_per_mm2 + self.further.1)
    }
}

/// Equilibrium, by `balance`, of `pairs` on flanks that have lost `removed_mm` of each; windows that prove too short are widened.
pub fn settled<'a, 'r>(
    pairs: &mut [MeshedPair<'a>],
    removed_mm: impl Fn(usize) -> PerGear<&'r [f64]>,
    mut balance: impl FnMut(&mut [MeshedPair<'a>]) -> Result<PairEquilibrium, EquilibriumError>,
) -> Result<(PairEquilibrium, Work), EquilibriumError> {
    let mut work = Work { equilibria: 1, ..Work::default() };
    for (k, pair) in pairs.iter_mut().enumerate() {
        pair.set_removed(removed_mm(k));
    }
    loop {
        let equilibrium = balance(pairs)?;
        work.newton_iterations += equilibrium.iterations;
        work.pair_evaluations += equilibrium.pair_evaluations;
        let mut held = true;
        for (k, pair) in pairs.iter_mut().enumerate() {
            if !pair.contact.window_suffices(removed_mm(k)) {
                pair.contact.widen();
                pair.set_removed(removed_mm(k));
                held = false;
            }
        }
        if held {
            pairs.iter_mut().for_each(MeshedPair::remember);
            return Ok((equilibrium, work));
        }
    }
}

/// A Newton step of all pairs together.
struct NewtonStep {
    /// Σ w_i, N/mm.
    line_load_n_per_mm: f64,
    /// Σ c_i, N/mm².
    n_per_mm2: f64,
    /// δ less the approach of the first pair, mm.
    beyond_first_mm: f64,
}

impl NewtonStep {
    /// Approaches are counted from that of the first pair: a light load on a deep relief keeps its digits.
    fn new(pairs: &[MeshedPair<'_>], line_load: f64) -> Self {
        let (mut load, mut stiffness, mut ahead) = (0.0, 0.0, 0.0);
        for pair in pairs {
            let tangent = pair.tangent_n_per_mm2();
            load += pair.response.line_load_n_per_mm;
            stiffness += tangent;
            ahead += tangent * pair.ahead_of(&pairs[0]);
        }
        let beyond_first_mm = (line_load - load + ahead) / stiffness;
        Self { line_load_n_per_mm: load, n_per_mm2: stiffness, beyond_first_mm }
    }

    /// Change of the indentation of `pair`, mm.
    fn deeper_mm(&self, pair: &MeshedPair<'_>, first: &MeshedPair<'_>) -> f64 {
        (self.beyond_first_mm - pair.ahead_of(first)) / pair.series()
    }

    /// Whether loads balance and no pair would change its load.
    fn is_settled(&self, pairs: &[MeshedPair<'_>], line_load: f64) -> bool {
        let settled = pairs.iter().all(|pair| {
            let step = self.deeper_mm(pair, &pairs[0]).abs();
            step * pair.teeth_n_per_mm2.max(pair.response.stiffness_n_per_mm2) <= TOLERANCE * line_load
                || step <= pair.least_step_mm().max(pairs[0].least_step_mm())
        });
        settled && (self.line_load_n_per_mm - line_load).abs() <= TOLERANCE * line_load
    }
}

/// Presses each pair to where the iteration starts, where it should carry `expected` N/mm. Returns the number of evaluations.
pub(super) fn press_to_start(pairs: &mut [MeshedPair<'_>], expected: f64) -> u64 {
    for pair in pairs.iter_mut() {
        let start = pair.start_mm(expected);
        pair.load_at(start);
    }
    pairs.len() as u64
}

/// Presses each pair, where none touches, so deep that it carries at least `expected` N/mm. Returns the number of evaluations.
pub(super) fn press_amply(pairs: &mut [MeshedPair<'_>], expected: f64) -> u64 {
    for pair in pairs.iter_mut() {
        let ample = pair.contact.ample_indentation_mm(expected);
        pair.load_at(ample);
    }
    pairs.len() as u64
}

/// Finds the equilibrium of `pairs` (at least one) under `line_load` (> 0).
pub fn balance(
    pairs: &mut [MeshedPair<'_>],
    line_load: f64,
    position_mm: f64,
) -> Result<PairEquilibrium, EquilibriumError> {
    // Expected load of a pair: of a few pairs all, of many slices twice the mean.
    let expected = line_load * (2.0 / pairs.len() as f64).min(1.0);
    let mut pair_evaluations = press_to_start(pairs, expected);
    for iterations in 1..=NEWTON_LIMIT {
        let step = NewtonStep::new(pairs, line_load);
        if !step.line_load_n_per_mm.is_finite() {
            return Err(EquilibriumError::NotFinite { position_mm });
        }
        if step.n_per_mm2 <= 0.0 {
            pair_evaluations += press_amply(pairs, expected);
            continue;
        }
        if step.is_settled(pairs, line_load) {
            let transmission_error_mm = pairs[0].whole_approach_mm() + step.beyond_first_mm;
            return Ok(PairEquilibrium {
                transmission_error_mm,
                n_per_mm2: step.n_per_mm2,
                iterations,
                pair_evaluations,
            });
        }
        let (first, others) = pairs.split_at_mut(1);
        for pair in others {
            let deeper = pair.indentation_mm + step.deeper_mm(pair, &first[0]);
            pair.load_at(deeper);
        }
        let deeper = first[0].indentation_mm + step.beyond_first_mm / first[0].series();
        first[0].load_at(deeper);
        pair_evaluations += pairs.len() as u64;
    }
    bisect(pairs, line_load, position_mm, pair_evaluations)
}

/// Finds the equilibrium by bisection of δ, and of every indentation within it.
fn bisect(
    pairs: &mut [MeshedPair<'_>],
    line_load: f64,
    position_mm: f64,
    mut evaluations: u64,
) -> Result<PairEquilibrium, EquilibriumError> {
    let mut low = pairs.iter().map(|pair| pair.touch_mm).fold(f64::INFINITY, f64::min);
    let ample = pairs.iter().map(|pair| pair.touch_mm + pair.contact.ample_indentation_mm(line_load));
    let mut high = ample.fold(low, f64::max);
    let mut carried = load_at_approach(pairs, high, &mut evaluations);
    for _ in 0..BISECTION_LIMIT {
        if carried >= line_load {
            break;
        }
        high += 2.0 * (high - low) + f64::MIN_POSITIVE;
        carried = load_at_approach(pairs, high, &mut evaluations);
    }
    for _ in 0..BISECTION_LIMIT {
        let middle = low.midpoint(high);
        if (carried - line_load).abs() <= TOLERANCE * line_load || middle <= low || middle >= high {
            break;
        }
        carried = load_at_approach(pairs, middle, &mut evaluations);
        if carried > line_load {
            high = middle;
        } else {
            low = middle;
        }
    }
    let residual = (carried / line_load - 1.0).abs();
    // Bisection ends at neighbouring floating-point numbers.
    if residual > GREATEST_IMBALANCE {
        return Err(EquilibriumError::NotConverged { position_mm, residual, evaluations });
    }
    Ok(PairEquilibrium {
        transmission_error_mm: low.midpoint(high),
        n_per_mm2: pairs.iter().map(MeshedPair::tangent_n_per_mm2).sum(),
        iterations: NEWTON_LIMIT,
        pair_evaluations: evaluations,
    })
}

/// Sum of the loads of all pairs at the approach `delta_mm`, each found by bisection of its indentation.
fn load_at_approach(pairs: &mut [MeshedPair<'_>], delta_mm: f64, evaluations: &mut u64) -> f64 {
    pairs
        .iter_mut()
        .map(|pair| {
            // The indentation lies between none of δ and all of it.
            let whole = delta_mm - pair.touch_mm;
            let (mut low, mut high) = (whole.min(0.0), whole);
            pair.load_at(high);
            *evaluations += 1;
            for _ in 0..BISECTION_LIMIT {
                let middle = low.midpoint(high);
                if middle <= low || middle >= high {
                    break;
                }
                pair.load_at(middle);
                *evaluations += 1;
                if pair.beyond_touch_mm() > whole {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            pair.response.line_load_n_per_mm
        })
        .sum()
}
