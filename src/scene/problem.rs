//! Problems of a scene file: where they are, and what to do about them.

use std::fmt;
use std::ops::Range;

use super::locate::Locator;
use gearwear_bodies::gear::{Gear, PairError};
use gearwear_bodies::gear_mesh::ToothMeshError;
use gearwear_fem::SolveError;
use gearwear_mesh::quality::QualityError;
use gearwear_physics::calibration::CalibrationError;
use gearwear_physics::mesh_cycle::pair_in_space::PairInSpaceError;
use gearwear_physics::stiffness::StiffnessError;

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
    /// A feature that this version does not have.
    NotAvailable,
    /// Values that are allowed individually, but do not make a gear pair.
    Geometry(PairError),
    /// Values that are allowed individually, but do not make a tooth stiffness.
    Stiffness(StiffnessError),
}

/// A problem of a scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Kind of problem.
    pub kind: ProblemKind,
    /// Path of the key, such as `pair.pinion.teeth`; empty where the file as a whole is meant.
    pub key: String,
    /// Value in the file.
    pub found: String,
    /// Values allowed.
    pub allowed: String,
    /// Remedy.
    pub help: Option<String>,
    /// Place in the file, in bytes from its beginning.
    pub span: Option<Range<usize>>,
}

impl Problem {
    /// Problem: the contact surface leaves nothing for the teeth of the stiffness model.
    pub fn of_stiffness(text: &str, error: &StiffnessError) -> Self {
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

    /// Problem: the sectors have fewer than the `least` teeth that touch.
    pub fn of_sector_teeth(text: &str, teeth: u32, least: u32) -> Self {
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

    /// Problem: a tooth cannot be meshed, of `gear` where only one cannot.
    pub fn of_tooth_mesh(text: &str, gear: Option<Gear>, error: &ToothMeshError) -> Self {
        let of_gear = gear.map_or_else(|| "pair".to_owned(), |gear| format!("pair.{}", gear.name()));
        let (key, allowed) = match error {
            ToothMeshError::ClampRadius { greatest_mm, .. } if *greatest_mm < 0.0 => {
                ("pair.wheel.rim_thickness_mm".to_owned(), "a rim of a tenth of a module")
            }
            ToothMeshError::ClampRadius { .. } => (clamp_key(gear), "a circle below the teeth"),
            ToothMeshError::SectorTeeth { .. } => ("fem.sector_teeth".to_owned(), "an odd number, at most all teeth"),
            ToothMeshError::NotPositive { .. }
            | ToothMeshError::ElementLength { .. }
            | ToothMeshError::TooFine { .. } => return Self::of_elements(text, error.to_string()),
            ToothMeshError::ReliefBeyondCurvature { .. } => {
                (format!("{of_gear}.root_relief"), "less relief at the root")
            }
            ToothMeshError::PointedTip { .. } => (format!("{of_gear}.tip_relief"), "relief that leaves a tip land"),
            ToothMeshError::TipRounding { .. } => {
                (format!("{of_gear}.tip_rounding_mm"), "a rounding that fits on the tip")
            }
            ToothMeshError::CrossedOutline { .. } | ToothMeshError::Inverted { .. } => {
                (of_gear, "a tooth with a body between its flanks")
            }
        };
        Self::of_body(text, key, format!("a pair that cannot be meshed ({error})"), allowed, BODIES_HELP)
    }

    /// Problem: too many elements, or none; `found` is the message.
    pub fn of_elements(text: &str, found: String) -> Self {
        let (key, allowed) = ("fem.elements_per_half_width".to_owned(), "another number");
        let help = "elements grow with the load and shrink with this number";
        Self::of_body(text, key, format!("a pair that cannot be meshed ({found})"), allowed, help)
    }

    /// Problem: the mesh of `gear`, or of both, has poor quality.
    pub fn of_mesh_quality(text: &str, gear: Option<Gear>, error: &QualityError) -> Self {
        let found = format!("a pair that cannot be meshed ({error})");
        Self::of_body(text, clamp_key(gear), found, "a body whose section can be meshed", BODIES_HELP)
    }

    /// Problem: the finite elements of `gear` have no solution.
    pub fn of_condensation(text: &str, gear: Gear, error: &SolveError) -> Self {
        let found = format!("a body that cannot be condensed ({error})");
        let allowed = "a body that its clamp holds";
        Self::of_body(text, clamp_key(Some(gear)), found, allowed, BODIES_HELP)
    }

    /// Problem: the load needs a wider strip of contact than the flanks have; `None` for errors of the solver.
    pub fn of_contact_strip(text: &str, error: &CalibrationError) -> Option<Self> {
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

    /// Problem: the pair is impossible.
    pub fn of_pair(text: &str, error: &PairError) -> Self {
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

    /// Problem: the gears cannot be meshed in three dimensions, for the number of teeth or the body.
    pub fn of_teeth_in_space(text: &str, error: &PairInSpaceError) -> Self {
        let key = error.scene_key();
        let allowed = match error {
            PairInSpaceError::TooFewTeeth { .. } => "fewer teeth in mesh than a gear has",
            PairInSpaceError::Gear { .. } => "a body whose section can be meshed",
        };
        Self {
            kind: ProblemKind::NotAllowed,
            span: Some(Locator::new(text).unwrap_or_default().nearest(&key)),
            key,
            found: format!("a pair that cannot be meshed in three dimensions ({error})"),
            allowed: allowed.to_owned(),
            help: Some("helical.coupling = \"slicing\" couples them by plate theory".to_owned()),
        }
    }

    /// Problem: the value of `key` is not allowed; of a file that it names `found` says how, after its name.
    pub fn at_key(text: &str, key: &str, found: String, allowed: &str, help: &str) -> Self {
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
    pub fn add_help(&mut self, sentence: &str) {
        match &mut self.help {
            Some(help) => {
                help.push_str("; ");
                help.push_str(sentence);
            }
            None => self.help = Some(sentence.to_owned()),
        }
    }
}

/// Remedy for bodies that cannot be meshed.
const BODIES_HELP: &str = "change the teeth or their modifications in [pair], or fem.clamp_radius_mm, the radius at which the bodies are held";

/// Key of the radius at which the body of `gear` is held, or of both.
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

/// Number in its shortest form, as in a file: `4`, `0.0045`, `1e-17`.
pub fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// Value of the file in a message.
pub fn words(value: &toml::Value) -> String {
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
