//! Settings of the slices over the face width.

use serde::{Deserialize, Serialize};

/// Most slices that are coupled each with each: 400 positions then take less than 0.5 GB.
pub const MOST_SLICES_IN_SPACE: usize = 100;

/// Coupling of the slices of a tooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Coupling {
    /// Not at all: thin independent teeth on one rigid hub.
    None,
    /// Through the tooth's bending: a loaded slice takes its neighbours along. Contact itself is still slice by slice, after
    /// Haines and Ollerton.
    Slicing,
    /// Through the compliance of both gears in three-dimensional finite elements, neighbouring teeth and free end faces included.
    Fem,
}

impl Coupling {
    /// Name in scenes and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Slicing => "slicing",
            Self::Fem => "fem",
        }
    }
}

/// The slices of a pair whose transverse sections differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SliceSettings {
    /// Number, 1 or more.
    pub count: usize,
    /// Coupling.
    pub coupling: Coupling,
}
