//! Record of a study of improvement: `summary.json`, and the source of the other files.

use serde::Serialize;

use super::kept::{DesignRole, KeptDesign};
use super::proposal::Proposal;

/// What a study found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImproveRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene as given, resolved.
    pub scene_hash: String,
    /// Always "complete": a study that is not writes nothing.
    pub status: &'static str,
    /// Free keys, as the user may write them.
    pub free: Vec<String>,
    /// Whether the scene names no free keys.
    pub is_free_by_default: bool,
    pub goals: Vec<GoalRecord>,
    pub limits: Vec<String>,
    pub seed: u32,
    /// Greatest number of designs of the search.
    pub evaluations: usize,
    /// Designs of the search.
    pub searched: usize,
    /// Of these those without a result.
    pub failed: usize,
    /// Reason of the first; null where all have one.
    pub first_failure: Option<String>,
    /// Designs of the search that keep to the limits.
    pub within_limits: usize,
    /// Why the search ended.
    pub stopped: String,
    /// Model of the search.
    pub fast_model: String,
    /// Model of the verified designs.
    pub verified_on: String,
    pub proposals: Vec<Proposal>,
    /// Greatest relative difference of a goal of a verified design between fast and verified model.
    pub greatest_difference: Vec<Option<f64>>,
    /// What no design does.
    pub bounds: Vec<String>,
    /// Paths of the figures of a design.
    pub figures: Vec<String>,
    /// Designs on the front of the search, by their numbers.
    pub front: Vec<usize>,
    pub threads: usize,
    pub wall_s: f64,
    /// All designs, in the order of their numbers.
    #[serde(skip)]
    pub designs: Vec<KeptDesign>,
    /// Names of the free keys.
    #[serde(skip)]
    pub keys: Vec<String>,
    /// Values of a design as text.
    #[serde(skip)]
    pub said: Vec<Option<Vec<String>>>,
    /// Goals of each design; none where it has no result.
    #[serde(skip)]
    pub goals_of_designs: Vec<Option<Vec<f64>>>,
    /// Scene as given.
    #[serde(skip)]
    pub scene_toml: String,
}

/// A goal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GoalRecord {
    pub goal: String,
    pub heading: String,
    pub unit: String,
    /// Whether more is better.
    pub is_raised: bool,
}

impl GoalRecord {
    pub fn with_unit(&self) -> String {
        if self.unit.is_empty() { self.heading.clone() } else { format!("{}, {}", self.heading, self.unit) }
    }
}

impl ImproveRecord {
    /// Designs in a role, with their places.
    pub fn in_role(&self, role: DesignRole) -> impl Iterator<Item = (usize, &KeptDesign)> {
        self.designs.iter().enumerate().filter(move |(_, design)| design.role == role)
    }

    /// Place of the scene as given, verified.
    pub fn as_given(&self) -> Option<usize> {
        self.in_role(DesignRole::Verify).find(|(_, design)| design.values.is_none()).map(|(place, _)| place)
    }
}
