//! What the finite-element model teaches the fast one: tooth stiffness and K/H along the path of contact.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::contact::{foundation::FoundationCurve, settings::MatchCriterion};
use crate::stiffness::curve::PairCompliance;

/// A calibration of one gear pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// Compliance of a tooth pair, flattening included.
    pub pair_compliance: PairCompliance,
    /// K/H for each criterion.
    pub foundation: BTreeMap<MatchCriterion, FoundationCurve>,
}
