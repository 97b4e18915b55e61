//! Collection of wear, work and the first failure over the positions of a group.
//!
//! Groups run independently of each other; their collections are added in order, so that sums always run the same way.

use super::Work;
use super::load_sharing::EquilibriumError;
use gearwear_bodies::gear::{Gear, PerGear};

/// The collection of one group.
pub(super) struct Collected {
    /// Depth that each flank point wears in one mesh, mm.
    pub depth_mm: PerGear<Vec<f64>>,
    work: Work,
    failure: Option<EquilibriumError>,
}

impl Collected {
    /// An empty collection for flanks of so many points.
    pub(super) fn new(points: PerGear<usize>) -> Self {
        Self { depth_mm: points.map(|points| vec![0.0; points]), work: Work::default(), failure: None }
    }

    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        for gear in Gear::BOTH {
            self.depth_mm[gear].fill(0.0);
        }
        self.keep();
    }

    /// Forgets everything but these depths.
    pub(super) fn begin_from(&mut self, depth_mm: &PerGear<Vec<f64>>) {
        for gear in Gear::BOTH {
            self.depth_mm[gear].copy_from_slice(&depth_mm[gear]);
        }
        self.keep();
    }

    /// Keeps the depths, and forgets the work.
    pub(super) fn keep(&mut self) {
        (self.work, self.failure) = (Work::default(), None);
    }

    /// Takes the work of a position, or its failure. Returns whether to go on.
    pub(super) fn take(&mut self, solved: Result<Work, EquilibriumError>) -> bool {
        match solved {
            Ok(work) => self.work += work,
            Err(failure) => self.failure = Some(failure),
        }
        self.failure.is_none()
    }

    /// Greatest depth of any flank point, mm.
    pub(super) fn deepest_mm(&self) -> f64 {
        Gear::BOTH.into_iter().flat_map(|gear| &self.depth_mm[gear]).copied().fold(0.0, f64::max)
    }

    /// Fills `depth_mm` with the depths of all groups together. Returns the work of one mesh cycle.
    pub(super) fn sum<'a>(
        groups: impl Iterator<Item = &'a Self>,
        depth_mm: &mut PerGear<Vec<f64>>,
    ) -> Result<Work, EquilibriumError> {
        let mut work = Work { mesh_cycles: 1, ..Work::default() };
        for gear in Gear::BOTH {
            depth_mm[gear].fill(0.0);
        }
        for group in groups {
            if let Some(failure) = &group.failure {
                return Err(failure.clone());
            }
            work += group.work;
            for gear in Gear::BOTH {
                depth_mm[gear].iter_mut().zip(&group.depth_mm[gear]).for_each(|(sum, part)| *sum += part);
            }
        }
        Ok(work)
    }
}
