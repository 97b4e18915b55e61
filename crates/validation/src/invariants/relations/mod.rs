//! The relations of the suite, by what they exchange.

mod direction;
mod exchange;
mod neutral;
mod resolution;
mod similarity;
mod superposition;
mod time;

use super::relation::SceneRelation;

/// All relations, in the order in which they are reported.
pub(crate) fn all() -> Vec<SceneRelation> {
    [
        exchange::RELATIONS,
        similarity::RELATIONS,
        time::RELATIONS,
        superposition::RELATIONS,
        neutral::RELATIONS,
        direction::RELATIONS,
        resolution::RELATIONS,
    ]
    .concat()
}

/// Differences of a calculation that takes the same steps in another order of rounding: 1e-16 a step, raised by the condition of contact
/// problems (1e4) and by a hundred steps.
const ROUNDING: f64 = 1e-9;
/// Differences of equilibria that are solved to 1e-10 of the load, through the steps of a run.
const SOLVED: f64 = 1e-6;
