//! REXS, the exchange format of gear units of the FVA (Forschungsvereinigung Antriebstechnik): components with attributes, which relations
//! join. What is read is a cylindrical stage: the gears of its relation `stage`, their flanks, the modifications, tools and materials that
//! further relations name, and the load spectrum. Names and units of attributes are those of the format's database, versions 1.4 to 2.0
//! (rexs.info); an attribute in a unit that is not listed here is refused, not guessed.
//!
//! The scene is text, so that whoever reads it sees what came from the file (without remark) and what did not (ASSUMED, or a line that begins
//! with #).

#![allow(non_snake_case, reason = "names end in their unit as engineers write it")]

mod attributes;
mod document;
mod load;
pub mod mesh_stiffness;
mod modifications;
mod places;
pub mod results;
mod same_loads;
mod same_pair;
mod scene_text;
mod stage;

#[cfg(test)]
mod results_tests;
#[cfg(test)]
mod tests;

use document::RexsDocument;
use stage::RexsStage;

/// Scene from a file.
#[derive(Debug)]
pub struct FromRexs {
    /// The scene file.
    pub text: String,
    /// Parts of the stage that a scene cannot say, or that were left out, and why.
    pub warnings: Vec<String>,
}

/// The scene of the `number`-th cylindrical stage, from 1, of a REXS file of this text; of the only one without a number.
///
/// # Errors
///
/// No REXS, a version that is not known, no such stage, or attributes that make no pair of external cylindrical gears.
pub fn scene(text: &str, number: Option<usize>) -> Result<FromRexs, RexsError> {
    let document = RexsDocument::parse(text)?;
    let mut warnings = Vec::new();
    let stage = RexsStage::find(&document, number)?;
    let gears = stage.gears(&document, &mut warnings)?;
    let load = load::of(&document, &gears.pinion, &mut warnings)?;
    let text = scene_text::of(&document, &stage, &gears, &load, &mut warnings)?;
    Ok(FromRexs { text, warnings })
}

/// Versions whose attributes are known.
const VERSIONS: [&str; 6] = ["1.4", "1.5", "1.6", "1.7", "2.0", "2.0.0"];

/// Why a file gives no scene. `line` counts from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RexsError {
    /// Not the XML form of the format: `found` says what it is instead.
    #[error("line {line}: found {found}; allowed: a REXS model in XML (.rexs)")]
    NoXml { line: usize, found: String },
    #[error("line {line}: version: found {found:?}; allowed: 1.4 to 1.7 and 2.0")]
    Version { line: usize, found: String },
    /// `stages` describes those there are.
    #[error("--stage: found {}; allowed: {}", asked.map_or("none".to_owned(), |n| n.to_string()),
        if stages.is_empty() { "nothing, for the file has no stage of two cylindrical gears".to_owned() } else { stages.join("; ") })]
    Stage { asked: Option<usize>, stages: Vec<String> },
    #[error("line {line}: {component}: {attribute} is missing, which the scene needs")]
    Missing { line: usize, component: String, attribute: &'static str },
    #[error("line {line}: {component}: {attribute}: found {found}; allowed: {allowed}")]
    Value { line: usize, component: String, attribute: String, found: String, allowed: String },
    /// A run of another pair than that of the stage.
    #[error("RUN: {what}: found {found}; allowed: {allowed}, that of {stage}")]
    OtherPair { what: String, found: String, allowed: String, stage: String },
    #[error("line {line}: found a second load_spectrum; allowed: one, as the format has it")]
    SecondSpectrum { line: usize },
}

impl RexsError {
    fn unreadable(line: usize, error: &quick_xml::Error) -> Self {
        Self::NoXml { line, found: format!("XML that cannot be read ({error})") }
    }
}
