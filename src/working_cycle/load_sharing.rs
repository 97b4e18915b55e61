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
//! Where Newton does not settle (a gap so rough that rounding decides), both equations are solved by bisection instead,
//! which their monotony allows.

use crate::contact::{PairContact, Response};

/// Greatest imbalance, relative to the load, at which an equilibrium is accepted.
pub const TOLERANCE: f64 = 1e-11;
/// Newton steps before bisection takes over; three to five are usual.
const NEWTON_LIMIT: u64 = 40;

/// Why there is no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EquilibriumError {
    /// A load or stiffness was not a number.
    #[error("the load of a tooth pair is not a number at position {position_mm:.4} mm")]
    NotFinite {
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
    /// Its contact surface.
    pub contact: Box<dyn PairContact + 'a>,
    /// Its answer to the last approach.
    pub response: Response,
    teeth_n_per_mm2: f64,
    approach_mm: f64,
    /// Approaches at the last three equilibria, the newest first: the next one starts from their continuation.
    history_mm: [Option<f64>; 3],
}

/// The solution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Equilibrium {
    /// δ.
    pub transmission_error_mm: f64,
    /// Newton steps taken.
    pub iterations: u64,
    /// Evaluations of a pair's contact.
    pub pair_evaluations: u64,
}

impl<'a> MeshedPair<'a> {
    /// A pair that has not carried load yet.
    pub fn new(contact: Box<dyn PairContact + 'a>, teeth_n_per_mm2: f64) -> Self {
        Self { contact, response: Response::default(), teeth_n_per_mm2, approach_mm: 0.0, history_mm: [None; 3] }
    }

    /// Keeps the present approach as a start for later.
    pub fn remember(&mut self) {
        self.history_mm = [Some(self.approach_mm), self.history_mm[0], self.history_mm[1]];
    }

    fn press(&mut self, approach_mm: f64) {
        self.approach_mm = approach_mm;
        self.response = self.contact.press(approach_mm);
    }

    fn start_mm(&self, line_load: f64) -> f64 {
        match self.history_mm {
            [Some(last), Some(before), Some(first)] => 3.0 * (last - before) + first,
            [Some(last), Some(before), None] => 2.0 * last - before,
            [Some(last), ..] => last,
            [None, ..] => self.contact.ample_approach_mm(line_load),
        }
    }

    /// Approach of the whole pair, teeth included.
    fn whole_approach_mm(&self) -> f64 {
        self.approach_mm + self.response.line_load_n_per_mm / self.teeth_n_per_mm2
    }

    /// 1 + w'/k.
    fn series(&self) -> f64 {
        1.0 + self.response.stiffness_n_per_mm2 / self.teeth_n_per_mm2
    }
}

/// Finds the equilibrium of `pairs` under `line_load` (> 0).
///
/// # Errors
/// [`EquilibriumError`].
pub fn balance(
    pairs: &mut [MeshedPair<'_>],
    line_load: f64,
    position_mm: f64,
) -> Result<Equilibrium, EquilibriumError> {
    let mut evaluations = 0;
    for pair in pairs.iter_mut() {
        let start = pair.start_mm(line_load);
        pair.press(start);
        evaluations += 1;
    }
    for iterations in 1..=NEWTON_LIMIT {
        let (mut load, mut stiffness, mut reached) = (0.0, 0.0, 0.0);
        for pair in pairs.iter() {
            let tangent = pair.response.stiffness_n_per_mm2 / pair.series();
            load += pair.response.line_load_n_per_mm;
            stiffness += tangent;
            reached += tangent * pair.whole_approach_mm();
        }
        if !load.is_finite() {
            return Err(EquilibriumError::NotFinite { position_mm });
        }
        if stiffness <= 0.0 {
            // No pair touches: begin again from where each would carry the load alone.
            for pair in pairs.iter_mut() {
                let ample = pair.contact.ample_approach_mm(line_load);
                pair.press(ample);
                evaluations += 1;
            }
            continue;
        }
        let transmission_error_mm = (line_load - load + reached) / stiffness;
        let out_of_balance = pairs.iter().fold((load - line_load).abs(), |worst: f64, pair| {
            let step = (transmission_error_mm - pair.whole_approach_mm()) / pair.series();
            worst.max((step * pair.teeth_n_per_mm2.max(pair.response.stiffness_n_per_mm2)).abs())
        });
        if out_of_balance <= TOLERANCE * line_load {
            return Ok(Equilibrium { transmission_error_mm, iterations, pair_evaluations: evaluations });
        }
        for pair in pairs.iter_mut() {
            let step = (transmission_error_mm - pair.whole_approach_mm()) / pair.series();
            pair.press(pair.approach_mm + step);
            evaluations += 1;
        }
    }
    bisect(pairs, line_load, position_mm, evaluations)
}

/// The equilibrium by bisection of δ, and of every s_i within it.
fn bisect(
    pairs: &mut [MeshedPair<'_>],
    line_load: f64,
    position_mm: f64,
    mut evaluations: u64,
) -> Result<Equilibrium, EquilibriumError> {
    let mut total = |pairs: &mut [MeshedPair<'_>], delta: f64| -> f64 {
        pairs
            .iter_mut()
            .map(|pair| {
                // s ≤ δ, and the pair's load cannot exceed what keeps δ − s at the whole load.
                let (mut low, mut high) = (delta - 2.0 * line_load / pair.teeth_n_per_mm2, delta);
                pair.press(high);
                evaluations += 1;
                while high - low > 4.0 * f64::EPSILON * (high.abs() + low.abs()) && pair.whole_approach_mm() != delta {
                    if pair.whole_approach_mm() > delta {
                        high = pair.approach_mm;
                    } else {
                        low = pair.approach_mm;
                    }
                    let middle = low.midpoint(high);
                    if middle <= low || middle >= high {
                        break;
                    }
                    pair.press(middle);
                    evaluations += 1;
                }
                pair.response.line_load_n_per_mm
            })
            .sum()
    };
    let ample = |pair: &MeshedPair<'_>| pair.contact.ample_approach_mm(line_load) + line_load / pair.teeth_n_per_mm2;
    let mut high = pairs.iter().map(ample).fold(f64::NEG_INFINITY, f64::max);
    let mut low = pairs.iter().map(|pair| pair.contact.ample_approach_mm(0.0)).fold(f64::INFINITY, f64::min);
    let mut carried = 0.0;
    for _ in 0..200 {
        let middle = low.midpoint(high);
        carried = total(pairs, middle);
        if (carried - line_load).abs() <= TOLERANCE * line_load || middle <= low || middle >= high {
            break;
        }
        if carried > line_load {
            high = middle;
        } else {
            low = middle;
        }
    }
    let residual = (carried / line_load - 1.0).abs();
    // Bisection ends where neighbouring floating-point numbers do; what rounding leaves then is accepted.
    if residual <= 100.0 * TOLERANCE {
        let transmission_error_mm = low.midpoint(high);
        return Ok(Equilibrium { transmission_error_mm, iterations: NEWTON_LIMIT, pair_evaluations: evaluations });
    }
    Err(EquilibriumError::NotConverged { position_mm, residual, evaluations })
}
