//! Designs finished so far, which the journal keeps.

use serde::{Deserialize, Serialize};

use gearwear::journal::Kept;
use gearwear_physics::results::error::TotalError;

/// Why a design was run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DesignRole {
    /// On the fast model, by the search.
    Search,
    /// As `gearwear run` runs it, with its error.
    Verify,
    /// On the fast model, at the tolerance of a key of a proposal.
    Tolerance,
}

impl DesignRole {
    pub fn name(self) -> &'static str {
        match self {
            Self::Search => "search",
            Self::Verify => "verify",
            Self::Tolerance => "tolerance",
        }
    }
}

/// A finished design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptDesign {
    /// Number in the order in which the study asks for designs, from 0.
    pub number: usize,
    pub role: DesignRole,
    /// Value of each free key, of words their place; none: the scene as given.
    pub values: Option<Vec<f64>>,
    /// Figures, in the order of the study; or on one line why there are none.
    pub figures: Result<Vec<Option<f64>>, String>,
    /// Error of a verified design.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub total: Option<TotalError>,
    pub wall_s: f64,
}

/// Study that a journal keeps the designs of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImproveIdentity {
    pub program_version: String,
    /// Hash of the scene file as given.
    pub given_hash: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene as given, resolved.
    pub scene_hash: String,
    /// Hash of the files that the scene names.
    pub inputs_hash: String,
    pub free: Vec<String>,
    pub goals: Vec<String>,
    pub limits: Vec<String>,
    pub evaluations: usize,
    pub seed: u32,
    /// Paths of the figures of a design.
    pub figures: Vec<String>,
}

impl ImproveIdentity {
    /// Parts of the identity with their names.
    fn said(&self) -> [(&'static str, String); 10] {
        [
            ("program version", self.program_version.clone()),
            ("free keys", self.free.join("; ")),
            ("goals", self.goals.join(", ")),
            ("limits", self.limits.join(", ")),
            ("evaluations", self.evaluations.to_string()),
            ("seed", self.seed.to_string()),
            ("scene", self.given_hash.clone()),
            ("the resolved scene", self.scene_hash.clone()),
            ("files that the scene names", self.inputs_hash.clone()),
            ("figures of a design", self.figures.join(" ")),
        ]
    }
}

impl Kept for ImproveIdentity {
    type Row = KeptDesign;
    const KIND: &'static str = "study of improvement";
    const COMMAND: &'static str = "gearwear improve";

    fn number(&self, row: &KeptDesign) -> usize {
        row.number
    }

    fn refuses(&self, row: &KeptDesign) -> Option<String> {
        let has_values = row.values.as_ref().is_none_or(|values| values.len() == self.free.len());
        let has_figures = row.figures.as_ref().ok().is_none_or(|figures| figures.len() == self.figures.len());
        let fits = has_values && has_figures;
        (!fits).then(|| format!("design {} of another study", row.number))
    }

    fn differences(&self, wanted: &Self) -> Vec<String> {
        let both = self.said().into_iter().zip(wanted.said());
        // What follows from the scene differs wherever it does.
        let follows = |what: &str| what == "the resolved scene" && self.given_hash != wanted.given_hash;
        both.filter(|((what, mine), (_, theirs))| mine != theirs && !follows(what))
            .map(|((what, mine), (_, theirs))| format!("{what}: {mine} and {theirs}"))
            .collect()
    }
}
