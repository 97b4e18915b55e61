//! REXS, the exchange format of gear units of the FVA (Forschungsvereinigung Antriebstechnik): components with attributes, which relations
//! join. What is read is a cylindrical stage: the gears of its relation `stage`, their flanks, the modifications, tools and materials that
//! further relations name, and the load spectrum. Names and units of attributes are those of the format's database, versions 1.0 to 2.0
//! (rexs.info); an attribute in a unit that is not listed here is refused, not guessed.
//!
//! The scene is text, so that whoever reads it sees what came from the file (without remark), what follows from it (derived), and what did not come from it
//! (ASSUMED, or REQUIRED in a line that begins with #). A stage that is in the model always gives a scene.

#![allow(non_snake_case, reason = "names end in their unit as engineers write it")]

mod attributes;
mod axes;
pub mod container;
mod document;
mod drivetrain;
mod json;
mod load;
pub mod mesh_stiffness;
mod modifications;
mod places;
mod planetary_unit;
mod profile_shift;
pub mod results;
mod roles;
mod same_loads;
mod same_pair;
mod scene_text;
mod stage;
mod xml;

#[cfg(test)]
mod planetary_tests;
#[cfg(test)]
mod reading_tests;
#[cfg(test)]
mod results_tests;
#[cfg(test)]
mod tests;

use std::path::Path;

use crate::scene::loaded::{LoadError, SceneError, SceneText};
use crate::scene::planetary::PlanetaryScene;
use document::RexsDocument;
use drivetrain::Drivetrain;
pub use scene_text::Provenance;
use stage::RexsStage;

/// Scene from a file.
#[derive(Debug)]
pub struct FromRexs {
    /// The scene file.
    pub text: String,
    /// Where its values come from.
    pub provenance: Provenance,
    /// Parts of the stage that a scene cannot say, or that were left out, and why.
    pub warnings: Vec<String>,
}

/// The scene of the `number`-th cylindrical stage, from 1, or of the planetary stage whose mesh of sun and planet it is, of a REXS file of this text, XML or JSON; of the only one without a number.
///
/// # Errors
///
/// No REXS, a version that is not known, no such stage, or attributes that make no pair of external cylindrical gears.
pub fn scene(text: &str, number: Option<usize>) -> Result<FromRexs, RexsError> {
    let document = RexsDocument::parse(text)?;
    let mut warnings = Vec::new();
    let stage = RexsStage::find(&document, number, &mut warnings)?;
    let train = Drivetrain::of(&document);
    let gears = stage.gears(&document, &train, &mut warnings)?;
    let load = load::of(&document, &train, &stage, &gears, &mut warnings)?;
    let mut planetary = planetary_unit::of(&document, &stage, &gears, &mut warnings)?;
    let before = warnings.len();
    let (mut text, mut provenance) =
        scene_text::of(&document, &stage, (&gears, planetary.as_ref()), &load, &mut warnings)?;
    if let Some(unit) = &mut planetary
        && let Some(found) = refused_ring_tip(&text)
    {
        warnings.truncate(before);
        warnings.push(format!(
            "{}: tip_diameter is left out, and the ring’s tips are shortened: {found}",
            unit.ring.component.label()
        ));
        unit.ring.tip_diameter_mm = None;
        (text, provenance) = scene_text::of(&document, &stage, (&gears, planetary.as_ref()), &load, &mut warnings)?;
    }
    Ok(FromRexs { text, provenance, warnings })
}

/// Why the stage of this text is refused at the tip circle of its ring, as where the fillets that the basic rack generates on the planets reach
/// farther than those of the unit's tools; `None` where it is not.
fn refused_ring_tip(text: &str) -> Option<String> {
    const TIP: &str = "planetary.ring.tip_diameter_mm";
    let given = SceneText { name: String::new(), text: text.to_owned() };
    match PlanetaryScene::from_text(given, Path::new("")) {
        Err(LoadError::Scene(SceneError { problems, .. })) => {
            problems.into_iter().find(|problem| problem.key == TIP).map(|problem| problem.found)
        }
        _ => None,
    }
}

/// Versions whose attributes are known.
const VERSIONS: [&str; 10] = ["1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "2.0", "2.0.0"];

/// Why a file gives no scene. `line` counts from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RexsError {
    /// No model in a form that is read: `found` says what it is instead.
    #[error(
        "line {line}: found {found}; allowed: a REXS model in XML (.rexs) or JSON (.rexsj), or an archive of one (.rexsz, .zip)"
    )]
    NoModel { line: usize, found: String },
    #[error(
        "line 1: found the JSON form of REXS (.rexsj); allowed: the XML form (.rexs), into which results are written"
    )]
    OnlyXml,
    #[error("found more than {most_mb} MB, or no end; allowed: a REXS model of up to {most_mb} MB")]
    TooLarge { most_mb: usize },
    #[error("line {line}: version: found {found:?}; allowed: {allowed}")]
    Version { line: usize, found: String, allowed: &'static str },
    /// `stages` describes those there are, `others` those that are not in the model.
    #[error("--stage: found {}; allowed: {}{}", asked.map_or("none".to_owned(), |n| n.to_string()),
        if stages.is_empty() { "nothing, for the file has no stage of two cylindrical gears".to_owned() } else { stages.join("; ") },
        others.iter().map(|other| format!("; {other}")).collect::<String>())]
    Stage { asked: Option<usize>, stages: Vec<String>, others: Vec<String> },
    #[error("line {line}: {component}: {attribute} is missing, which the scene needs")]
    Missing { line: usize, component: String, attribute: &'static str },
    #[error("line {line}: {component}: {attribute}: found {found}; allowed: {allowed}")]
    Value { line: usize, component: String, attribute: String, found: String, allowed: String },
    /// A run of another pair than that of the stage.
    #[error("RUN: {what}: found {found}; allowed: {allowed}, that of {stage}")]
    OtherPair { what: String, found: String, allowed: String, stage: String },
    /// A run of a planetary stage for a pair that is none of one.
    #[error("RUN: found that of a planetary stage; allowed: that of {stage}, whose gears meet no ring")]
    NoRing { stage: String },
    #[error("line {line}: found a second load_spectrum; allowed: one, as the format has it")]
    SecondSpectrum { line: usize },
}

impl RexsError {
    fn unreadable(line: usize, error: &quick_xml::Error) -> Self {
        Self::NoModel { line, found: format!("XML that cannot be read ({error})") }
    }
}
