//! Where a record comes from: the scene as a file says it.

use super::reported_by::ReportedBy;
use super::run::InputFile;

/// The scene file behind a record, as the record quotes it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Provenance {
    /// Title of the scene.
    pub title: String,
    /// Who reports, and when; none where the scene does not say it.
    pub report: Option<ReportedBy>,
    /// The resolved scene as TOML.
    pub scene_toml: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene.
    pub scene_hash: String,
    /// Copies of the files that the scene names.
    pub inputs: Vec<InputFile>,
    /// Warnings about the scene itself.
    pub warnings: Vec<String>,
}
