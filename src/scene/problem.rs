//! What is wrong with a scene file, where, and what to do about it.

use std::fmt;
use std::ops::Range;

use super::locate::Locator;
use crate::calibration::CalibrationError;
use crate::fem::SolveError;
use crate::gear::{Gear, PairError};
use crate::gear_mesh::ToothMeshError;
use crate::mesh::quality::QualityError;
use crate::mesh_cycle::pair_in_space::PairInSpaceError;
use crate::stiffness::StiffnessError;

/// The nature of a problem.
#[derive(Debug, Clone, PartialEq)]
pub enum ProblemKind {
    /// The text is not TOML.
    Syntax,
    /// A key that no scene has.
    UnknownKey,
    /// A value of another type than the key takes.
    WrongType,
    /// A value outside what the key allows.
    NotAllowed,
    /// A key that must be given.
    Missing,
    /// Two keys that say the same thing.
    SaidTwice,
    /// Something of the scene format that this version does not have.
    NotAvailable,
    /// Values that are allowed one by one, but make no gear pair.
    Geometry(PairError),
    /// Values that are allowed one by one, but make no tooth stiffness.
    Stiffness(StiffnessError),
}

/// One thing that is wrong with a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Its nature.
    pub kind: ProblemKind,
    /// Path of the key, such as `pair.pinion.teeth`; empty where the file as a whole is meant.
    pub key: String,
    /// What the file says.
    pub found: String,
    /// What it may say.
    pub allowed: String,
    /// What to do about it.
    pub help: Option<String>,
    /// Where it says it, in bytes from the beginning of the file.
    pub span: Option<Range<usize>>,
}

impl Problem {
    /// The contact surface of the scene in `text` leaves nothing for the teeth of its stiffness model.
    pub(crate) fn of_stiffness(text: &str, error: &StiffnessError) -> Self {
        let locator = Locator::new(text).unwrap_or_default();
        let by_hand = "contact.foundation_MPa_per_mm";
        let key = if locator.key(by_hand).is_some() { by_hand } else { "contact.match" };
        let span = locator.nearest(key);
        Self {
            kind: ProblemKind::Stiffness(error.clone()),
            key: key.to_owned(),
            found: text.get(span.clone()).unwrap_or_default().to_owned(),
            allowed: "a stiffer foundation, or another stiffness.model".to_owned(),
            help: Some(
                "the spring of the teeth is what the contact surface leaves of the pair's compliance".to_owned(),
            ),
            span: Some(span),
        }
    }

    /// The sectors of the scene in `text` have fewer than the `least` teeth that touch.
    pub(crate) fn of_sector_teeth(text: &str, teeth: u32, least: u32) -> Self {
        let key = "fem.sector_teeth";
        let span = Locator::new(text).unwrap_or_default().nearest(key);
        Self {
            kind: ProblemKind::NotAllowed,
            key: key.to_owned(),
            found: teeth.to_string(),
            allowed: format!("an odd number, at least {least}: so many teeth touch over the mesh cycle"),
            help: Some("body = \"ring\" has all teeth".to_owned()),
            span: Some(span),
        }
    }

    /// A tooth of the scene in `text` cannot be meshed, of `gear` where one of them alone is to blame.
    pub(crate) fn of_tooth_mesh(text: &str, gear: Option<Gear>, error: &ToothMeshError) -> Self {
        let below = |table: &str, key: &str| {
            let gear = gear.map(|gear| format!(".{}", gear.name())).unwrap_or_default();
            if table == "pair" { format!("pair{gear}{key}") } else { format!("{table}{gear}") }
        };
        let (key, allowed) = match error {
            ToothMeshError::ClampRadius { .. } => (below("fem.clamp_radius_mm", ""), "a circle below the teeth"),
            ToothMeshError::SectorTeeth { .. } => ("fem.sector_teeth".to_owned(), "an odd number, at most all teeth"),
            ToothMeshError::NotPositive { .. }
            | ToothMeshError::ElementLength { .. }
            | ToothMeshError::TooFine { .. } => return Self::of_elements(text, error.to_string()),
            ToothMeshError::ReliefBeyondCurvature { .. } => (below("pair", ".root_relief"), "less relief at the root"),
            ToothMeshError::PointedTip { .. } => (below("pair", ".tip_relief"), "relief that leaves a tip land"),
            ToothMeshError::TipRounding { .. } => {
                (below("pair", ".tip_rounding_mm"), "a rounding that fits on the tip")
            }
            ToothMeshError::CrossedOutline { .. } | ToothMeshError::Inverted { .. } => {
                (below("pair", ""), "a tooth with a body between its flanks")
            }
        };
        Self::of_body(text, key, format!("a pair that cannot be meshed ({error})"), allowed, BODIES_HELP)
    }

    /// The elements of the scene in `text` are too many, or none; `found` says so.
    pub(crate) fn of_elements(text: &str, found: String) -> Self {
        let (key, allowed) = ("fem.elements_per_half_width".to_owned(), "another number");
        let help = "elements grow with the load and shrink with this number";
        Self::of_body(text, key, format!("a pair that cannot be meshed ({found})"), allowed, help)
    }

    /// The mesh of `gear`, or of both, is no good.
    pub(crate) fn of_mesh_quality(text: &str, gear: Option<Gear>, error: &QualityError) -> Self {
        let found = format!("a pair that cannot be meshed ({error})");
        Self::of_body(text, clamp_key(gear), found, "a body whose section can be meshed", BODIES_HELP)
    }

    /// The finite elements of `gear` have no solution.
    pub(crate) fn of_condensation(text: &str, gear: Gear, error: &SolveError) -> Self {
        let found = format!("a body that cannot be condensed ({error})");
        let allowed = "a body that its clamp holds";
        Self::of_body(text, clamp_key(Some(gear)), found, allowed, BODIES_HELP)
    }

    /// The load of the scene in `text` asks for a strip of contact that the flanks do not have; `None` for errors of the solver.
    pub(crate) fn of_contact_strip(text: &str, error: &CalibrationError) -> Option<Self> {
        if !matches!(error, CalibrationError::OffTheFlank { .. } | CalibrationError::NoClearPosition { .. }) {
            return None;
        }
        let locator = Locator::new(text).unwrap_or_default();
        let (whole, phase) = ("operation.pinion_torque_Nm", "operation.phases[0].pinion_torque_Nm");
        let key = if locator.key(whole).is_none() && locator.key(phase).is_some() { phase } else { whole };
        let found = format!("a load under which the pair cannot be calibrated ({error})");
        let help = "the strip widens with the load, and with softer materials; a greater face width makes it narrower";
        Some(Self::of_body(text, key.to_owned(), found, "a load whose strip of contact lies on the flanks", help))
    }

    /// The pair of the scene in `text` that a command makes of it cannot exist.
    pub(crate) fn of_pair(text: &str, error: &PairError) -> Self {
        let help = "without modifications, as calibrate takes the pair, other limits hold";
        Self::of_body(text, "pair".to_owned(), format!("a pair that cannot exist ({error})"), "other gears", help)
    }

    fn of_body(text: &str, key: String, found: String, allowed: &str, help: &str) -> Self {
        Self {
            kind: ProblemKind::NotAllowed,
            span: Some(Locator::new(text).unwrap_or_default().nearest(&key)),
            key,
            found,
            allowed: allowed.to_owned(),
            help: Some(help.to_owned()),
        }
    }

    /// The teeth of the scene in `text` cannot be had in space: its face width asks for too many of them, or its body cannot be meshed.
    pub(crate) fn of_teeth_in_space(text: &str, error: &PairInSpaceError) -> Self {
        let key = error.scene_key();
        let allowed = match error {
            PairInSpaceError::TooFewTeeth { .. } => "fewer teeth in mesh than a gear has",
            PairInSpaceError::Gear { .. } => "a body whose section can be meshed",
        };
        Self {
            kind: ProblemKind::NotAllowed,
            span: Some(Locator::new(text).unwrap_or_default().nearest(&key)),
            key,
            found: format!("a pair whose teeth cannot be had in space ({error})"),
            allowed: allowed.to_owned(),
            help: Some("helical.coupling = \"slicing\" couples them by plate theory".to_owned()),
        }
    }

    /// The file that `key` of the scene in `text` names is not what it should be: `found` says how, after its name.
    pub(crate) fn of_named_file(text: &str, key: &str, found: String, allowed: &str, help: &str) -> Self {
        Self {
            kind: ProblemKind::NotAllowed,
            key: key.to_owned(),
            found,
            allowed: allowed.to_owned(),
            help: Some(help.to_owned()),
            span: Some(Locator::new(text).unwrap_or_default().nearest(key)),
        }
    }

    /// Adds a sentence to the help.
    pub(crate) fn add_help(&mut self, sentence: &str) {
        match &mut self.help {
            Some(help) => {
                help.push_str("; ");
                help.push_str(sentence);
            }
            None => self.help = Some(sentence.to_owned()),
        }
    }
}

/// What decides whether a body can be meshed.
const BODIES_HELP: &str =
    "what the gears and their modifications are decides, and fem.clamp_radius_mm where their bodies end";

/// The key that says where the body of `gear` ends, or of both.
fn clamp_key(gear: Option<Gear>) -> String {
    gear.map_or_else(|| "fem.clamp_radius_mm".to_owned(), |gear| format!("fem.clamp_radius_mm.{}", gear.name()))
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Problem { kind, key, found, allowed, .. } = self;
        match kind {
            ProblemKind::Syntax => write!(f, "not TOML: {found}; allowed: {allowed}"),
            ProblemKind::UnknownKey => write!(f, "unknown key {key}; allowed: {allowed}"),
            ProblemKind::Missing => write!(f, "{key} is missing; allowed: {allowed}"),
            ProblemKind::SaidTwice => write!(f, "{key}: found {found}, which say the same thing; allowed: {allowed}"),
            ProblemKind::NotAvailable => {
                write!(f, "{key}: {found} is not available in this version; allowed: {allowed}")
            }
            ProblemKind::Stiffness(error) => write!(f, "{key}: {error}; found: {found}; allowed: {allowed}"),
            ProblemKind::Geometry(error) => write!(f, "{key}: {error}; found: {found}; allowed: {allowed}"),
            ProblemKind::WrongType | ProblemKind::NotAllowed => write!(f, "{key}: found {found}; allowed: {allowed}"),
        }
    }
}

impl std::error::Error for Problem {}

/// A number as one would write it into the file: `4`, `0.0045`, `1e-17`.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// A value of the file in an engineer's words.
pub(crate) fn words(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => format!("the text {text:?}"),
        toml::Value::Integer(value) => value.to_string(),
        toml::Value::Float(value) => format!("{value:?}"),
        toml::Value::Boolean(value) => value.to_string(),
        toml::Value::Datetime(_) => "a date".to_owned(),
        toml::Value::Array(_) => "a list".to_owned(),
        toml::Value::Table(_) => "a table".to_owned(),
    }
}
