//! Record of the validation suite: the plain data that its reports are written from, and that a later run is compared with.
//!
//! Two judgements stand side by side. A quantity *holds* or does not, against its reference or bound: that is physics, and
//! it is computed. A case *passes* where every quantity stands as the case file says it does: that is what the exit status
//! reports. A statement that is known not to hold is thus shown as one, and a change of it, either way, is noticed.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The name of a variant, as files write it.
pub fn written(variant: impl Serialize) -> String {
    let name = serde_json::to_value(variant).unwrap_or_default();
    name.as_str().unwrap_or_default().to_owned()
}

/// The whole suite, or the part of it that was asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ValidationRecord {
    pub program_version: String,
    /// The tier that was asked for; `None` where cases were named.
    pub tier: Option<Tier>,
    /// Threads that runs were spread over; each run has one of its own.
    pub threads: usize,
    /// The cases, in the order of their names within their groups.
    pub cases: Vec<CaseRecord>,
    /// From the first run to the last verdict.
    pub wall_s: f64,
    /// Cases that an interrupt left out.
    pub not_run: Vec<String>,
}

/// How long a suite may take: each tier holds those before it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tier {
    /// Below three minutes on two cores: for every change.
    #[default]
    Smoke,
    /// Below fifteen minutes on two cores: for every release.
    Full,
    /// No limit.
    Long,
}

impl Tier {
    /// All of them, shortest first.
    pub const ALL: [Self; 3] = [Self::Smoke, Self::Full, Self::Long];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Smoke => "smoke",
            Self::Full => "full",
            Self::Long => "long",
        }
    }
}

/// Purpose of a case (after ASME V&V 10).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseKind {
    /// The equations are solved right: against closed forms and orders of convergence.
    #[default]
    CodeVerification,
    /// A solution is resolved: against finer ones.
    SolutionVerification,
    /// The right equations are solved: against a standard, a publication, another program, a measurement.
    Validation,
    /// A result has not changed: against our own earlier one.
    Regression,
}

impl CaseKind {
    pub fn title(self) -> String {
        written(self).replace('-', " ")
    }
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Name of its folder.
    pub name: String,
    pub title: String,
    /// The group it is shown in, such as `FZG test gears`.
    pub group: String,
    /// Targets, such as `S1`; may be empty.
    pub targets: Vec<String>,
    /// Requirement, one sentence.
    pub requirement: String,
    pub kind: CaseKind,
    /// The first tier that holds it.
    pub tier: Tier,
    /// Statement of the source in our own words, where there is something to compare by eye.
    pub says: Option<String>,
    /// Estimates in its inputs, such as a torque that no source gives.
    pub rests_on: Vec<String>,
    pub runs: Vec<CaseRun>,
    /// Quantities computed and judged.
    pub quantities: Vec<QuantityRecord>,
    /// Error against cost, of the cases that ask for it.
    pub work_precision: Vec<WorkPrecisionPoint>,
    /// Outcomes over a range of a parameter, of the cases that ask for it.
    pub stability: Vec<StabilityPoint>,
    /// Plots; not kept as JSON.
    #[serde(skip)]
    pub plots: Vec<CasePlot>,
    /// Reason why the case could not be completed: a failure, never a skip.
    pub failure: Option<String>,
    /// Wall time of its runs together: on several threads the suite takes less.
    pub wall_s: f64,
    /// Work of its runs together, by the name of what was counted.
    pub work: BTreeMap<String, u64>,
}

impl CaseRecord {
    /// Whether every outcome is as expected.
    pub fn passed(&self) -> bool {
        self.failure.is_none() && self.quantities.iter().all(QuantityRecord::as_expected)
    }

    /// Quantities of a target: those that name it, or else those without a target.
    pub fn speaking_to(&self, target: &str) -> Vec<&QuantityRecord> {
        let has_own = self.quantities.iter().any(|quantity| quantity.target.as_deref() == Some(target));
        let wanted = has_own.then_some(target);
        self.quantities.iter().filter(|quantity| quantity.target.as_deref() == wanted).collect()
    }
}

/// Outcome of a comparison.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    Holds,
    Fails,
    /// There is nothing to compare with.
    #[default]
    CannotBeCompared,
}

impl Standing {
    pub fn title(self) -> String {
        written(self).replace('-', " ")
    }
}

/// A run of a case, or a family of runs that differ in some keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseRun {
    pub name: String,
    /// The command that does the same, such as `run`, `fem`, `calibrate`.
    pub command: String,
    /// How many runs: 1, or the members of the family.
    pub members: usize,
    pub outcomes: BTreeMap<RunOutcome, usize>,
    pub wall_s: f64,
    /// Work of all together, by the name of what was counted.
    pub work: BTreeMap<String, u64>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RunOutcome {
    /// Complete, every number finite, no negative wear, every position in equilibrium.
    #[default]
    Sound,
    Refused,
    NotConverged,
    /// The wear came to the thickness of a tooth.
    WornThrough,
    /// Complete, but not sound.
    Unsound,
    /// A defect of the program.
    Panicked,
}

impl RunOutcome {
    /// Name in case files, expressions and style sheets.
    pub fn name(self) -> String {
        written(self)
    }

    pub fn title(self) -> &'static str {
        match self {
            Self::Sound => "sound",
            Self::Refused => "refused with a message",
            Self::NotConverged => "did not converge and says so",
            Self::WornThrough => "worn through and says so",
            Self::Unsound => "unsound",
            Self::Panicked => "panicked",
        }
    }
}

/// A number with its reference or bound.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct QuantityRecord {
    pub name: String,
    /// Target of the quantity; `None`: all of its case.
    pub target: Option<String>,
    /// Unit; empty for a ratio.
    pub unit: String,
    /// The number; `None` where it could not be computed.
    pub value: Option<f64>,
    pub criterion: Criterion,
    /// Where reference or bound come from.
    pub source: String,
    /// Uncertainty of the reference, in the quantity's unit.
    pub uncertainty: Option<f64>,
    /// Contribution of the computation's resolution, in the quantity's unit.
    pub discretisation: Option<f64>,
    /// Why the tolerance or the bound is what it is.
    pub because: Option<String>,
    /// |value − reference|, in the quantity's unit.
    pub error: Option<f64>,
    /// Error over |reference|.
    pub relative_error: Option<f64>,
    /// Share of the tolerance that the error uses: at most 1 where it holds.
    pub share: Option<f64>,
    /// Outcome of the comparison.
    pub standing: Standing,
    /// Outcome that the case expects.
    pub expected: Standing,
    /// Why it is not expected to hold, or what is missing to compare it.
    pub remark: Option<String>,
    /// Whether it counts work: iterations, factorisations, mesh cycles.
    pub counts_work: bool,
}

impl QuantityRecord {
    /// A quantity that is expected to hold, without a value and compared with nothing yet.
    pub fn named(name: &str) -> Self {
        Self { name: name.to_owned(), expected: Standing::Holds, ..Self::default() }
    }

    /// Whether the outcome is as expected.
    pub fn as_expected(&self) -> bool {
        self.standing == self.expected
    }
}

/// Reference or bound of a quantity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "is")]
pub enum Criterion {
    /// Within a tolerance of a reference, in the quantity's unit.
    Near {
        reference: f64,
        tolerance: f64,
    },
    AtLeast {
        bound: f64,
    },
    AtMost {
        bound: f64,
    },
    /// Ends included.
    Between {
        low: f64,
        high: f64,
    },
    /// A statement: 1 where it is true, 0 where it is not.
    True,
    /// Nothing: it is only reported, or there is nothing to compare with.
    #[default]
    Reported,
}

/// A setting of a scene with its error and cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorkPrecisionPoint {
    /// The curve it belongs to, such as the contact surface.
    pub series: String,
    /// The setting, such as `200 positions, 40 steps`.
    pub setting: String,
    /// Relative.
    pub error: f64,
    pub wall_s: f64,
    /// Work, in what the case counts.
    pub work: f64,
    pub counted: String,
}

/// Outcome at one value of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StabilityPoint {
    /// The parameter, unit included.
    pub parameter: String,
    /// Value on an axis.
    pub value: f64,
    /// The value as text, with whatever goes with it.
    pub setting: String,
    pub outcome: RunOutcome,
    pub expected: RunOutcome,
    /// Message of the program, where it refused or did not converge, or what is unsound.
    pub said: Option<String>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct CasePlot {
    pub title: String,
    /// Description of what the plot shows, in a sentence.
    pub reading: String,
    /// Title of the abscissa, unit included.
    pub x: String,
    /// Title of the ordinate, unit included.
    pub y: String,
    /// Whether the abscissa is logarithmic.
    pub log_x: bool,
    /// Whether the ordinate is logarithmic.
    pub log_y: bool,
    pub curves: Vec<PlotCurve>,
    /// Lines across the plot at a value of the ordinate, with their names: references and bounds.
    pub levels: Vec<(String, f64)>,
    /// Lines up the plot at a value of the abscissa, with their names.
    pub marks: Vec<(String, f64)>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct PlotCurve {
    pub name: String,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Half the height of error bars, one for each point; empty: none.
    pub uncertainty: Vec<f64>,
    pub style: CurveStyle,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CurveStyle {
    #[default]
    Line,
    /// A dashed line: a reference.
    Dashed,
    /// Points: single results or measurements.
    Points,
    /// Lower and upper edge of a band: the ordinates are the lower edges in the order of the abscissae, then the upper ones
    /// in the opposite order, so that the points go round it.
    Band,
}

/// Changes of the suite since an earlier run of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// Version of the program that made the earlier record.
    pub against_version: String,
    /// Changes for the worse: of a verdict, an error, work.
    pub worse: Vec<Change>,
    pub better: Vec<Change>,
    /// Cases that only the new record has.
    pub added: Vec<String>,
    /// Names of cases that only the old record has.
    pub gone: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Change {
    pub case: String,
    /// Name of a quantity or of a work count, or `verdict`.
    pub what: String,
    pub before: ComparedState,
    pub now: ComparedState,
}

/// Property that is compared between two records.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ComparedState {
    /// Whether the case could be carried out.
    Ran(bool),
    Absent,
    /// Outcome of a comparison.
    Stands(Standing),
    Ended(RunOutcome),
    /// The share of its tolerance that a quantity uses.
    Uses(f64),
    /// The value of a quantity, with its unit.
    Is(Option<f64>, String),
    /// The error of a quantity, with its unit.
    Errs(f64, String),
    Against(Criterion),
    Counted(u64),
}
