//! Record of random scenes and the statements held against them.

use schemars::JsonSchema;
use serde::Serialize;

/// The whole study: `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InvariantsRecord {
    pub program_version: String,
    pub seed: u64,
    /// Number of the first scene.
    pub first: u64,
    /// Scenes asked for.
    pub count: u64,
    /// Scenes drawn before the study was done, or interrupted.
    pub drawn: u64,
    /// Of these: run to their end, refused with a message, worn through.
    pub ran: u64,
    pub refused: u64,
    pub worn_through: u64,
    /// Runs in all, other scenes of relations included.
    pub runs: u64,
    /// Statements found violated.
    pub violations: Vec<Violation>,
    pub statements: Vec<StatementRow>,
    /// Messages of refused scenes, with how many there are of each kind and the number of the first.
    pub refusals: Vec<Refusal>,
    pub threads: usize,
    pub wall_s: f64,
}

/// A row of `invariants.csv`: a statement over all scenes it was held against.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct StatementRow {
    /// what is stated
    pub statement: String,
    /// invariant of each run, or relation of two scenes
    pub kind: String,
    /// scenes it was held against
    pub scenes: u64,
    /// scenes that violate it
    pub violated: u64,
    /// scenes of which the other scene was refused or worn through
    pub not_compared: u64,
    /// greatest deviation, over what is allowed
    pub worst_used: f64,
    /// this deviation, relative
    pub worst_value: f64,
    /// what is allowed there
    pub worst_bound: f64,
    /// the figure that deviates, or the place
    pub worst_figure: String,
    /// number of the scene; empty where there is none
    pub worst_scene: Option<u64>,
    /// the statement in words
    pub states: String,
    /// why the bound is what it is
    pub reason: String,
}

/// A statement that a scene violates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Violation {
    /// Number of the scene.
    pub scene: u64,
    pub statement: String,
    /// Figure that deviates, or the message.
    pub figure: String,
    pub value: Option<f64>,
    pub bound: Option<f64>,
    /// The scene's text, and that of the other scene of a relation.
    #[serde(skip)]
    pub text: String,
    #[serde(skip)]
    pub other: Option<String>,
}

/// Refusals of a kind: messages that differ in their numbers alone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refusal {
    pub message: String,
    pub count: u64,
    pub first_scene: u64,
}
