//! What the finite-element model teaches the fast one: tooth stiffness and K/H along the path of contact.

pub mod bodies;
pub mod foundation_fit;
pub mod loaded_tooth;
pub mod single_contact;
pub mod tooth_stiffness;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::contact::{foundation::FoundationCurve, settings::MatchCriterion};
use crate::fem::active_set::ActiveSetError;
use crate::fem::gear::model::ModelError;
use crate::gear::Gear;
use crate::stiffness::curve::PairCompliance;

/// Why there is no calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// A gear cannot be modelled.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The contact of the pair alone was not found.
    #[error("contact at position {position_mm:.4} mm under {line_load_n_per_mm:.2} N/mm: {source}")]
    Contact {
        /// ξ.
        position_mm: f64,
        /// w.
        line_load_n_per_mm: f64,
        /// Why.
        source: ActiveSetError,
    },
    /// The strip of contact is wider than the flank.
    #[error("{}: the contact strip at position {position_mm:.4} mm does not fit on the flank", gear.name())]
    OffTheFlank {
        /// Whose.
        gear: Gear,
        /// ξ.
        position_mm: f64,
    },
    /// The strip of contact is as wide as the whole path.
    #[error("under {line_load_n_per_mm:.2} N/mm no contact strip keeps clear of the tip edges")]
    NoClearPosition {
        /// w.
        line_load_n_per_mm: f64,
    },
}

/// A calibration of one gear pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// Compliance of a tooth pair, flattening included.
    pub pair_compliance: PairCompliance,
    /// K/H for each criterion.
    pub foundation: BTreeMap<MatchCriterion, FoundationCurve>,
}
