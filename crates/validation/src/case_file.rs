//! `case.toml`: a validation case as its author writes it.
//!
//! A case is data. It names runs of the program (scenes, with keys exchanged, alone or in families), quantities as expressions
//! over what the runs left behind ([`super::expression`]), and what each quantity is held against, with source, uncertainty and
//! the reason for the tolerance. Numbers may be written as expressions wherever a reference follows from a closed form.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::record::{CaseKind, CurveStyle, RunOutcome, Standing, Tier};

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    pub title: String,
    /// The group it is shown in.
    pub group: String,
    /// One sentence: what must be so.
    pub requirement: String,
    pub kind: CaseKind,
    /// The first tier that holds it.
    pub tier: Tier,
    /// The targets it speaks to, such as `S1`.
    #[serde(default)]
    pub targets: Vec<String>,
    /// Statement of the source, in the project's own words.
    pub says: Option<String>,
    /// Estimates it rests on.
    #[serde(default)]
    pub rests_on: Vec<String>,
    #[serde(default)]
    pub run: Vec<RunSpec>,
    /// Files of numbers beside the case.
    #[serde(default)]
    pub data: Vec<DataSpec>,
    /// Names for expressions that are used more than once, in order.
    #[serde(default)]
    pub define: Vec<Definition>,
    pub quantity: Vec<QuantitySpec>,
    #[serde(default)]
    pub plot: Vec<PlotSpec>,
    #[serde(default)]
    pub work_precision: Vec<WorkPrecisionSpec>,
    #[serde(default)]
    pub stability: Vec<StabilitySpec>,
}

/// A run, or a family of runs.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSpec {
    /// Name in expressions.
    pub name: String,
    #[serde(default)]
    pub command: CaseCommand,
    /// A preset, or a file beside the case; with `invariants` the word `random`.
    pub scene: String,
    /// With `fem` of a gear pair: the one position; without it the mesh cycle.
    pub position_mm: Option<f64>,
    /// With `fem` of a gear pair: the whole model without condensation beside it.
    #[serde(default)]
    pub full: bool,
    /// Keys of the scene, as paths with dots, and their values.
    #[serde(default)]
    pub set: toml::Table,
    /// Keys of the scene that are taken away, so that their defaults hold.
    #[serde(default)]
    pub unset: Vec<String>,
    /// A run with the command `calibrate` whose calibration this one reads.
    pub calibration: Option<String>,
    /// Keys that are varied: every combination is a member of the family.
    #[serde(default)]
    pub vary: Vec<VarySpec>,
    /// Members one by one.
    #[serde(default)]
    pub each: Vec<MemberSpec>,
    /// Members drawn from ranges.
    pub sample: Option<SampleSpec>,
    /// Expected outcome, unless a member of `each` has its own.
    #[serde(default)]
    pub expect: RunOutcome,
    /// Further accepted outcomes, where it is not known beforehand which members are refused.
    #[serde(default)]
    pub accept: Vec<RunOutcome>,
    /// Expressions for every member of a family, in which `run` is the member; each becomes a column of the family.
    #[serde(default)]
    pub take: BTreeMap<String, String>,
}

impl RunSpec {
    pub fn is_family(&self) -> bool {
        !self.vary.is_empty() || !self.each.is_empty() || self.sample.is_some()
    }
}

/// The command that does the same from a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseCommand {
    /// The wear simulation.
    #[default]
    Run,
    /// Finite-element contact, of a gear pair or of a problem with its own mesh.
    Fem,
    /// K/H and tooth stiffness from finite elements.
    Calibrate,
    /// Random scenes tested against statements that are true of every scene: `set` has `seed`, `first` and `count`.
    Invariants,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VarySpec {
    /// The key, or several that take the same value.
    pub key: OneOrMore,
    /// The column of its values in the family; default: the last part of the first key.
    pub name: Option<String>,
    /// List of values, or a range:
    pub values: Option<Vec<toml::Value>>,
    /// First value of a range.
    pub from: Option<f64>,
    /// Last value of the range.
    pub to: Option<f64>,
    /// Number of values of the range.
    pub count: Option<usize>,
    /// Even spacing of the logarithms.
    #[serde(default)]
    pub log: bool,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub enum OneOrMore {
    One(String),
    More(Vec<String>),
}

impl OneOrMore {
    pub fn all(&self) -> &[String] {
        match self {
            Self::One(one) => std::slice::from_ref(one),
            Self::More(more) => more,
        }
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MemberSpec {
    /// Name in plots and messages; default: the keys it sets.
    pub label: Option<String>,
    /// Place on an axis: the column `value` of the family.
    pub value: Option<f64>,
    /// Keys and values beside those of the run.
    #[serde(default)]
    pub set: toml::Table,
    /// Keys that are taken away.
    #[serde(default)]
    pub unset: Vec<String>,
    /// How it must end.
    pub expect: Option<RunOutcome>,
}

/// Members drawn from ranges, evenly (the points of Halton's sequence).
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleSpec {
    pub count: usize,
    /// Seed.
    #[serde(default)]
    pub seed: usize,
    pub of: Vec<VarySpec>,
}

/// A file of numbers beside the case: CSV with a line of column names.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataSpec {
    /// Name in expressions.
    pub name: String,
    pub file: String,
    /// The columns that it must have.
    pub columns: Vec<String>,
    /// Consequence of a missing file, where it may be missing.
    pub missing: Option<String>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    pub name: String,
    pub value: String,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Formula {
    Number(f64),
    Expression(String),
}

/// Tolerance or uncertainty of a reference.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ToleranceSize {
    /// A share of the reference.
    Relative(Formula),
    /// In the quantity's unit.
    Absolute(Formula),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuantitySpec {
    pub name: String,
    /// The one target of the case that it speaks to; without it, all of them.
    pub target: Option<String>,
    #[serde(default)]
    pub unit: String,
    pub value: Option<Formula>,
    /// Reference.
    pub near: Option<Formula>,
    /// Tolerance.
    pub within: Option<ToleranceSize>,
    /// Lower bound.
    pub at_least: Option<Formula>,
    /// Upper bound; with `at_least`, both hold.
    pub at_most: Option<Formula>,
    /// `true`: the expression is a statement that must be true.
    pub is_true: Option<bool>,
    /// Where reference or bound come from.
    #[serde(default)]
    pub source: String,
    /// Uncertainty of the reference.
    pub uncertainty: Option<ToleranceSize>,
    /// Contribution of the computation's resolution.
    pub discretisation: Option<ToleranceSize>,
    /// Why the tolerance or bound is what it is.
    pub because: Option<String>,
    /// Expected outcome; `fails`: known not to hold.
    pub stands: Option<Standing>,
    /// Why it is known not to hold, or why it cannot be compared.
    pub remark: Option<String>,
    /// The file of numbers without which it cannot be compared.
    pub needs: Option<String>,
    #[serde(default)]
    pub work: bool,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSpec {
    pub title: String,
    /// Description of what the plot shows, in a sentence.
    pub reading: String,
    /// Title of the abscissa, unit included.
    pub x: String,
    /// Title of the ordinate, unit included.
    pub y: String,
    #[serde(default)]
    pub log_x: bool,
    #[serde(default)]
    pub log_y: bool,
    pub curve: Vec<CurveSpec>,
    /// Lines across the plot.
    #[serde(default)]
    pub level: Vec<LineSpec>,
    /// Lines up the plot.
    #[serde(default)]
    pub mark: Vec<LineSpec>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CurveSpec {
    /// Name; with `each`, before the member's own.
    #[serde(default)]
    pub name: String,
    /// Expression for the abscissae.
    pub x: String,
    /// Expression for the ordinates.
    pub y: String,
    /// With `style = "band"`: expression for the upper edge; `y` is the lower one.
    pub upper: Option<String>,
    /// Expression for half the height of error bars.
    pub uncertainty: Option<String>,
    #[serde(default)]
    pub style: CurveStyle,
    /// A family: one curve a member, in whose expressions `run` is the member.
    pub each: Option<String>,
    /// The file of numbers without which it is left out.
    pub needs: Option<String>,
}

/// A line across or up a plot.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineSpec {
    pub name: String,
    pub at: Formula,
}

/// Error against cost of a family.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorkPrecisionSpec {
    pub family: String,
    /// The column of the family that names the curves.
    pub series: String,
    /// Addition to their names, such as `with tip edges`.
    #[serde(default)]
    pub name: String,
    /// Expression for the relative error of a member, `run`.
    pub error: String,
    /// Work count, as in the summary's `work`.
    pub counted: String,
}

/// Outcomes of a family over a range of a parameter.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilitySpec {
    pub family: String,
    /// The parameter, unit included.
    pub parameter: String,
    /// Column in the family.
    pub value: String,
}
