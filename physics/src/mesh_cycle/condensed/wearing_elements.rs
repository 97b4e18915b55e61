//! Finite elements with the positions that were prepared on them.
//!
//! Cycles of as many positions under the same load differ in nothing but what has been lost since. So a run, its phases of other speeds and its
//! lives with other limits of severe wear take over the positions of the cycle before.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::stretches::BasePitch;
use super::{CondensedCycle, CondensedGroup, CondensedPosition};
use crate::mesh_cycle::{GROUPS, MeshCycle};
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_nodes::FlankNodes;

/// Finite elements whose flanks wear, with the positions of the last cycle on them.
pub struct WearingElements<'a> {
    /// Both gears, condensed onto their flanks.
    pub model: CondensedPair<'a>,
    idle: Mutex<Option<IdlePositions>>,
    prepared: AtomicU64,
}

/// Positions that no cycle uses.
pub(super) struct IdlePositions {
    /// Number of positions asked for, and load in N/mm.
    pub asked: (usize, f64),
    pub groups: Vec<CondensedGroup>,
    pub after_jumps: Vec<usize>,
}

impl IdlePositions {
    /// Positions on unworn flanks.
    pub(super) fn prepare(model: &CondensedPair<'_>, asked: (usize, f64), nodes: PerGear<&FlankNodes>) -> Self {
        let (positions, line_load_n_per_mm) = asked;
        let base_pitch = BasePitch::of(model, positions, line_load_n_per_mm);
        let stretches = base_pitch.stretches_mm();
        let groups = stretches
            .par_chunks(stretches.len().div_ceil(GROUPS))
            .map(|stretches| {
                let positions = stretches.iter();
                let positions =
                    positions.map(|&stretch| CondensedPosition::new(model, stretch, line_load_n_per_mm, nodes));
                CondensedGroup { loaded_positions: positions.collect(), ..CondensedGroup::new(nodes) }
            })
            .collect();
        Self { asked, groups, after_jumps: base_pitch.after_jumps(&stretches) }
    }
}

impl<'a> WearingElements<'a> {
    /// Elements without prepared positions.
    pub fn new(model: CondensedPair<'a>) -> Self {
        Self { model, idle: Mutex::default(), prepared: AtomicU64::new(0) }
    }

    /// A cycle on unworn flanks, of positions about as close as `positions` from A to E. To the last bit it is that of [`CondensedCycle::new`].
    pub fn cycle(&'a self, positions: usize, line_load_n_per_mm: f64) -> CondensedCycle<'a> {
        // Others are dropped before new ones are prepared.
        let idle = self.take().filter(|idle| idle.asked == (positions, line_load_n_per_mm));
        let is_new = idle.is_none();
        let mut cycle = CondensedCycle::with(&self.model, positions, line_load_n_per_mm, idle);
        if is_new {
            self.prepared.fetch_add(cycle.positions() as u64, Ordering::Relaxed);
        } else {
            cycle.reset();
        }
        cycle.elements = Some(self);
        cycle
    }

    /// Drops the positions that no cycle uses.
    pub fn drop_idle(&self) {
        drop(self.take());
    }

    /// How many positions were prepared for all cycles so far, those that widened their window and are prepared anew for the next cycle counted once.
    pub fn prepared_positions(&self) -> u64 {
        self.prepared.load(Ordering::Relaxed)
    }

    fn take(&self) -> Option<IdlePositions> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Keeps the positions of a cycle for the next one.
    pub(super) fn keep(&self, positions: IdlePositions) {
        *self.idle.lock().unwrap_or_else(PoisonError::into_inner) = Some(positions);
    }
}
