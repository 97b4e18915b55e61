//! Contact of the pair over many positions.
//!
//! Positions are dealt into a fixed number of groups that run independently; within a group each position starts from the
//! active set of the one before, moved along the flank. Results do not depend on the number of threads.

use rayon::prelude::*;

use super::condensed_pair::CondensedPair;
use super::position::{PositionContact, WarmStart};
use gearwear_fem::active_set::ActiveSetError;

/// Groups that may run at the same time.
const GROUPS: usize = 8;

/// Position at which a cycle failed, and the reason.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("at position {position_mm:.4} mm: {source}")]
pub struct CycleError {
    /// Position ξ, mm.
    pub position_mm: f64,
    /// Reason.
    pub source: ActiveSetError,
}

/// Solves at each of `positions_mm` under `line_load_n_per_mm`.
pub fn cycle(
    pair: &CondensedPair<'_>,
    positions_mm: &[f64],
    line_load_n_per_mm: f64,
) -> Result<Vec<PositionContact>, CycleError> {
    let group = positions_mm.len().div_ceil(GROUPS).max(1);
    let groups: Vec<Result<Vec<PositionContact>, CycleError>> = positions_mm
        .par_chunks(group)
        .map(|positions| {
            let mut warm = WarmStart::default();
            let mut solved = Vec::with_capacity(positions.len());
            for &position_mm in positions {
                let found = pair
                    .at(position_mm, line_load_n_per_mm, &warm)
                    .map_err(|source| CycleError { position_mm, source })?;
                warm = found.warm.clone();
                solved.push(found);
            }
            Ok(solved)
        })
        .collect();
    let mut all = Vec::with_capacity(positions_mm.len());
    for solved in groups {
        all.extend(solved?);
    }
    Ok(all)
}
