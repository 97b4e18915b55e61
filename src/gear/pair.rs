//! Everything that follows from the data of a pair.

use super::{PairError, spec::PairSpec};

/// A gear pair with all that is derived from its data.
#[derive(Debug, Clone, PartialEq)]
pub struct GearPair {
    /// The data it was built from.
    pub spec: PairSpec,
}

impl GearPair {
    /// Derives the pair.
    ///
    /// # Errors
    /// Whatever makes it impossible, see [`PairError`].
    pub fn new(spec: &PairSpec) -> Result<Self, PairError> {
        Ok(Self { spec: spec.clone() })
    }
}
