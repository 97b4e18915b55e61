//! Failures of commands and their exit statuses.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::say;
use gearwear::EvaluateError;
use gearwear::exchange::rexs::RexsError;
use gearwear::journal::{JournalError, Kept};
use gearwear::report::ReportError;
use gearwear::resume::folder::FolderError;
use gearwear::resume::result::ResultError;
use gearwear::scene::blame::SceneFault;
use gearwear::scene::loaded::{LoadError, LoadedScene, SceneError, SceneText};
use gearwear::scene::{Problem, ProblemKind, presets};
use gearwear::stamped_file::StampedFileError;
use gearwear::sweep::asked::{SweepError, SweepFault};
use gearwear::sweep::axis::AxisError;
use gearwear::sweep::goal::GoalError;
use gearwear::sweep::merge::MergeError;
use gearwear::uncertainty::asked::UncertaintyFault;
use gearwear::uncertainty::design::CorrelationError;
use gearwear::uncertainty::distribution::FORMS;
use gearwear::uncertainty::kept::SampledStudy;
use gearwear_fem::SolveError;
use gearwear_mesh::MeshFileError;
use gearwear_physics::assessment::RunError;
use gearwear_physics::assessment::calibrate::CalibrateError;
use gearwear_physics::assessment::fem_scene::FemPairError;
use gearwear_physics::assessment::pair_mesh::PairMeshError;
use gearwear_studies::accuracy::study::AccuracyError;
use gearwear_studies::compare::question::Refused;
use gearwear_studies::compare::run_folder::RunFolderError;
use gearwear_studies::export::ExportError;
use gearwear_validation::library::LibraryError;
use miette::{Diagnostic, LabeledSpan, MietteDiagnostic, NamedSource, Report};

/// Greatest length of a line that is shown, bytes.
const LONGEST_SHOWN: usize = 500;
/// Greatest number of problems of a file that are shown.
const MOST_SHOWN: usize = 20;

/// Failure of a command.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    /// The scene or problem file is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Any other wrong input.
    #[error(transparent)]
    Input(#[from] InputError),
    #[error(transparent)]
    Run(#[from] RunError),
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// More memory than there is.
    #[error("{0}")]
    Memory(String),
    #[error(transparent)]
    FemPair(FemPairError),
    /// No reference for the comparison of models.
    #[error(transparent)]
    Accuracy(AccuracyError),
    #[error(transparent)]
    Calibrate(CalibrateError),
    /// The fit did not converge; the comparison is written.
    #[error("the fit failed: {why}")]
    NotFitted { why: String },
    /// No combination of a sweep has a result; its rows are written.
    #[error("none of {count} combinations has a result; the first says: {error}")]
    NoCombination { count: usize, error: String },
    /// No sample of a study of uncertainty has a result.
    #[error("none of {count} samples has a result; the first says: {error}")]
    NoSample { count: usize, error: String },
    /// No design of a study of improvement can be proposed; the designs are kept.
    #[error("{why}")]
    NoProposal { why: String },
    /// Cases of the validation suite that are not as expected; the reports are written.
    #[error("{} of the validation suite's cases missed: {}", cases.len(), cases.join(", "))]
    Missed { cases: Vec<String> },
    /// A run that contradicts statements which hold for every run; it is written all the same.
    #[error("the results are kept, and are not to be relied on: {}", violations.join("; "))]
    Violated { violations: Vec<String> },
    /// Random scenes that contradict statements which hold for every scene; the report is written.
    #[error("{count} of the statements on random scenes are violated: {names}")]
    InvariantsViolated { count: usize, names: String },
    /// The user interrupted the command; what is kept was printed.
    #[error("interrupted")]
    Interrupted,
    /// The standard output was closed.
    #[error("the output was closed")]
    Closed,
}

/// Failures of a command beside the scene's content.
#[derive(Debug, thiserror::Error, Diagnostic)]
pub(super) enum InputError {
    #[error(transparent)]
    ValidationCase(LibraryError),
    /// An option of random scenes beside cases.
    #[error("{option}: found beside cases; allowed: gearwear validate invariants {option} N")]
    #[diagnostic(help("leave {option} out, or give the word invariants alone"))]
    OnlyForInvariants { option: &'static str },
    /// An option of cases beside random scenes.
    #[error("{option}: found beside invariants; allowed: beside cases")]
    #[diagnostic(help("leave {option} out"))]
    NotForInvariants { option: &'static str },
    /// A file that is no record of the validation suite.
    #[error("{name}: line {line}: found {reason}; allowed: a validation.json that gearwear validate wrote")]
    NoValidationRecord {
        name: String,
        /// Line, from 1.
        line: usize,
        reason: String,
    },
    #[error("{0}")]
    #[diagnostic(help("{}", load_help(.0)))]
    Load(LoadError),
    #[error("{name} cannot be read: {reason}")]
    Unreadable { name: String, reason: io::Error },
    /// Not one combination of a sweep makes a scene.
    #[error("--vary: none of the combinations makes a scene; the first: {0}")]
    #[diagnostic(help("give the scene what the varied key needs beside it, or another range"))]
    NothingToVary(String),
    /// A file that is both a problem with its own mesh and a gear pair.
    #[error("{name}: found both [mesh] and [pair]; allowed: one of them")]
    #[diagnostic(help("a problem with its own mesh has [mesh]; a gear pair has [pair]"))]
    MeshAndPair { name: String },
    /// `fem` of a problem with an option that only a gear pair has.
    #[error(
        "{name}: found {option}, which a problem with its own mesh does not have; allowed with a gear pair, [pair]"
    )]
    #[diagnostic(help("leave {option} out"))]
    OnlyForPair { name: String, option: &'static str },
    /// A position where the reference pair does not touch.
    #[error("--position: found {found_mm}; allowed: {from_mm:.4} (A) to {to_mm:.4} (E), in mm")]
    #[diagnostic(help("positions are radii of curvature of the pinion"))]
    Position { found_mm: f64, from_mm: f64, to_mm: f64 },
    /// `calibrate` with an output file that cannot be one.
    #[error("--out: found {name}, {what}; allowed: a file name such as pair.calibration.json")]
    CalibrationOut { name: String, what: &'static str },
    /// A folder that is not that of a finished run.
    #[error("RUN: {0}")]
    #[diagnostic(help("gearwear run SCENE --out RUN makes one"))]
    RunFolder(RunFolderError),
    /// `compare` of runs with an option for measured profiles.
    #[error("{option}: found beside runs; allowed: beside a measured profile")]
    #[diagnostic(help("leave {option} out"))]
    OnlyForMeasured { option: &'static str },
    /// `compare` of scenes without a folder.
    #[error("--out: missing; needed where the first run is a scene, whose results need a folder")]
    #[diagnostic(help("gearwear compare A.toml B.toml --out DIR"))]
    NoOutForScenes,
    /// `compare` of runs with what is no run.
    #[error("{}: found a measured profile beside runs; allowed: folders of runs and scenes alone, or one run and its measured profiles", path.display())]
    #[diagnostic(help("a scene ends in .toml; a folder must be there"))]
    ProfileBesideRuns { path: PathBuf },
    /// A measured profile that cannot be compared with the run.
    #[error(transparent)]
    #[diagnostic(help("gearwear compare --help says what stands in a measured file"))]
    Measured(Refused),
    /// A table of measurements that cannot be evaluated with the run.
    #[error("{0}")]
    #[diagnostic(help(
        "gearwear compare RUN --history TABLE --limit pinion.peak_wear_um=50; docs/compare.md has an example"
    ))]
    WearTable(String),
    /// Wear, measured or a limit, that takes much longer than the run.
    #[error("{0}")]
    #[diagnostic(help("units of the table and of --limit: g or mg, µm; revolutions are of the pinion"))]
    WearBeyondRun(String),
    /// A flank that `export` cannot write.
    #[error(transparent)]
    #[diagnostic(help("gearwear export RUN --gear wheel --out FILE"))]
    Export(ExportError),
    /// `init` with a name that is no preset.
    #[error("unknown preset {name:?}; allowed: {}", presets::names().join(", "))]
    #[diagnostic(help("{}", presets::nearest(name).map_or_else(
        || "gearwear init prints the first of them".to_owned(), |near| format!("did you mean {near}?"))))]
    UnknownPreset { name: String },
    /// `init --from` with a file that gives no scene.
    #[error("{name}: {error}")]
    #[diagnostic(help("gearwear init --from FILE.rexs --stage N reads a pair of external cylindrical gears"))]
    Rexs { name: String, error: Box<RexsError> },
    /// `rexs` with a file that does not take the results.
    #[error("{name}: {error}")]
    #[diagnostic(help(
        "gearwear rexs RUN --into FILE.rexs --stage N takes the stage that the run's scene was made of"
    ))]
    IntoRexs { name: String, error: Box<RexsError> },
    /// `rexs` with a file in another encoding, which cannot be kept byte for byte.
    #[error(
        "{name}: line {line}: found bytes that are not UTF-8; allowed: a REXS model in UTF-8, as the format has it"
    )]
    NotUtf8 { name: String, line: usize },
    #[error("--out: {}", causes(.0))]
    #[diagnostic(help("choose a folder you may write to, or a name that is still free"))]
    Out(ReportError),
    #[error("--out: {}", causes(.0))]
    #[diagnostic(help("a folder you may write to, and a name that ends in .msh, .vtu, .inp or .json"))]
    MeshFile(MeshFileError),
    /// `--resume` of a folder that no run began in.
    #[error("--resume: {folder} has no scene.toml; allowed: a folder that gearwear run --out began")]
    #[diagnostic(help("give the scene too, and the run begins there: gearwear run SCENE --resume {folder}"))]
    NothingToResume { folder: String },
    /// `--resume` of a run that did not converge.
    #[error("--resume: the run in {folder} did not converge: nothing is left to do")]
    #[diagnostic(help(
        "what it finished lies in {folder}; gearwear run SCENE --out {folder} runs it again from the beginning"
    ))]
    NothingLeft { folder: String },
    #[error("--resume: {0}")]
    #[diagnostic(help("{}", resume_help(.0)))]
    Resume(Box<FolderError>),
    /// A run that cannot be read.
    #[error("{0}")]
    #[diagnostic(help("run the scene again"))]
    Result(Box<ResultError>),
    #[error("--vary: {0}")]
    #[diagnostic(help("{}", .0.help().unwrap_or_else(|| "for example --vary pair.face_width_mm=10:30:21".to_owned())))]
    Vary(AxisError),
    #[error("--best, --subject-to: {0}")]
    #[diagnostic(help("for example --best pinion.peak_wear_um --subject-to \"wheel.peak_wear_um<=8\""))]
    Goal(GoalError),
    #[error("--outputs: {0}")]
    #[diagnostic(help("summary.json of a run has all of them"))]
    Outputs(EvaluateError),
    /// `uncertainty` with a question that cannot be asked.
    #[error("{option}{0}", option = option_of(.0))]
    #[diagnostic(help("{}", uncertainty_help(.0)))]
    Uncertainty(UncertaintyFault),
    #[error("{option}: {error}")]
    #[diagnostic(help("{}", journal_help(error)))]
    Journal { option: &'static str, error: JournalError },
    #[error("{0}")]
    #[diagnostic(help("{}", merge_help(.0)))]
    Merge(MergeError),
    /// `merge` into the folder of a shard.
    #[error("--out: {name} is one of the folders to merge; allowed: a folder of its own for the whole sweep")]
    MergeIntoShard { name: String },
    /// None of the shards has the scene of the sweep beside its rows.
    #[error("no folder has the scene.toml of its sweep; allowed: folders as gearwear sweep wrote them")]
    MergeWithoutScene,
    #[error("standard output cannot be written: {0}")]
    Stdout(io::Error),
    /// `explore` on a port that cannot be had.
    #[error("--port: found {port}, which cannot be had: {error}; allowed: a port that is free")]
    #[diagnostic(help("leave it out for a free one"))]
    Port { port: u16, error: io::Error },
    /// `explore` without what it takes from the system.
    #[error("the page cannot be served: {0}")]
    Server(io::Error),
    /// `explore` of a scene that has no answer.
    #[error("the scene has no answer to begin with: {0}")]
    #[diagnostic(help("gearwear run SCENE says more"))]
    Explore(gearwear::explore::ExploreError),
    #[error("--threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Scene(error) => Failure::Scene(error),
            other => Failure::Input(InputError::Load(other)),
        }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        Failure::Input(InputError::Out(error))
    }
}

impl From<SweepFault> for Failure {
    fn from(fault: SweepFault) -> Self {
        Failure::Input(match fault {
            SweepFault::Scene(error) => return Failure::Scene(error),
            SweepFault::Axis(error) => InputError::Vary(error),
            SweepFault::Goal(error) => InputError::Goal(error),
            SweepFault::Output(error) => InputError::Outputs(error),
            SweepFault::NothingToVary(problems) => InputError::NothingToVary(problems),
            SweepFault::Journal(error) => InputError::Journal { option: "--out", error },
            SweepFault::Report(error) => InputError::Out(error),
        })
    }
}

impl From<SweepError> for Failure {
    fn from(SweepError(fault): SweepError) -> Self {
        fault.into()
    }
}

/// Remedy for a file that cannot be opened as a scene.
fn load_help(error: &LoadError) -> &'static str {
    match error {
        LoadError::NotUtf8 { .. } => "save the file as UTF-8",
        LoadError::Curve { .. } => {
            "the file that stiffness.curve of the scene names; gearwear schema says what stands in it"
        }
        LoadError::Unreadable { .. } | LoadError::Scene(_) => {
            "give the name of a file you may read, or - for standard input"
        }
    }
}

/// Remedy for a run that cannot go on.
fn resume_help(error: &FolderError) -> &'static str {
    match error {
        FolderError::OtherRun { .. } => "resume it with its own scene and files, or choose another folder with --out",
        FolderError::Checkpoint {
            source: StampedFileError::OtherVersion { .. } | StampedFileError::OtherFormat { .. },
            ..
        } => "resume it with the version that wrote it, or remove the checkpoint to begin anew",
        FolderError::Checkpoint { .. } => "remove the checkpoint to begin anew",
        FolderError::Unreadable { .. } => "choose a folder you may read",
    }
}

/// Remedy for rows that cannot be kept.
fn journal_help(error: &JournalError) -> &'static str {
    match error {
        JournalError::OtherStudy { .. } | JournalError::Damaged { .. } | JournalError::Foreign { .. } => {
            "choose another folder, or remove this one to begin anew"
        }
        JournalError::InUse { .. } => "wait for it to end, or choose another folder; each shard needs its own",
        JournalError::NoStudy { kind, .. } if *kind == SampledStudy::KIND => {
            "leave --resume out, and the study begins there"
        }
        JournalError::NoStudy { .. } => "give the folders that gearwear sweep --shard wrote",
        JournalError::Write { .. } | JournalError::Removed { .. } => "the same command continues with the missing rows",
        JournalError::Open { .. } | JournalError::Lost { .. } => "choose a folder you may write to",
    }
}

/// Remedy for shards that do not make a sweep.
fn merge_help(error: &MergeError) -> String {
    match error {
        MergeError::Journal(error) => journal_help(error).to_owned(),
        MergeError::OtherSweep { .. } => "merge shards of one scene, varied in the same way".to_owned(),
        MergeError::Contradiction { .. } => "leave the folder out that is wrong, or run both anew".to_owned(),
        MergeError::Incomplete { unfinished, .. } if unfinished.is_empty() => {
            "give the folders of all shards; run the shards that were not".to_owned()
        }
        MergeError::Incomplete { unfinished, .. } => {
            format!("not finished: {}; the command of a shard continues where it was", unfinished.join(", "))
        }
    }
}

/// Error with its causes, on one line.
fn causes(error: &dyn std::error::Error) -> String {
    let chain = std::iter::successors(error.source(), |cause| cause.source());
    chain.fold(error.to_string(), |text, cause| format!("{text}: {cause}"))
}

impl Failure {
    pub(super) fn print(self) {
        match self {
            Failure::Scene(scene) => print_problems(scene),
            Failure::Input(error) => say(&format!("{:?}", Report::new(error))),
            Failure::Interrupted | Failure::Closed => {}
            failed => say(&format!("{:?}", Report::msg(failed))),
        }
    }

    /// The exit status of the program, as the contract fixes it.
    pub(super) fn exit_status(&self) -> u8 {
        match self {
            Failure::Scene(_) | Failure::Input(_) => super::WRONG_INPUT,
            Failure::Missed { .. } | Failure::Violated { .. } | Failure::InvariantsViolated { .. } => 1,
            Failure::Interrupted => 130,
            Failure::Closed => 0,
            Failure::Run(_) | Failure::Solve(_) | Failure::Memory(_) | Failure::FemPair(_) | Failure::Accuracy(_) => 3,
            Failure::Calibrate(_)
            | Failure::NotFitted { .. }
            | Failure::NoCombination { .. }
            | Failure::NoProposal { .. }
            | Failure::NoSample { .. } => 3,
        }
    }
}

/// Whether `text` is shown around the place of a problem, which takes the lines there and beside it whole.
fn is_shown(text: &str, problem: &Problem) -> bool {
    let Some(span) = &problem.span else { return true };
    let (Some(before), Some(after)) = (text.get(..span.start), text.get(span.end..)) else { return false };
    let longest = before.rsplit('\n').take(2).chain(after.split('\n').take(2)).map(str::len).max();
    longest.unwrap_or(0).max(span.len()) <= LONGEST_SHOWN
}

/// Prints every problem of a scene with its place in the text.
fn print_problems(error: SceneError) {
    let count = error.problems.len();
    let source = Arc::new(NamedSource::new(&error.given.name, error.given.text.clone()));
    for problem in error.problems.iter().take(MOST_SHOWN) {
        say(&format!("{:?}", reported(problem, &error, &source)));
    }
    if count > 1 {
        say(&format!("{count} problems in {}", error.given.name));
    }
}

/// One of the problems of `error`, with the text around it, or its line alone.
fn reported(problem: &Problem, error: &SceneError, source: &Arc<NamedSource<String>>) -> Report {
    let help = problem.help.clone();
    if is_shown(&error.given.text, problem) {
        let said = MietteDiagnostic::new(problem.to_string()).with_labels(label(problem));
        return Report::new(MietteDiagnostic { help, ..said }).with_source_code(Arc::clone(source));
    }
    let said = format!("{}, line {}: {problem}", error.given.name, error.line_of(problem));
    Report::new(MietteDiagnostic { help, ..MietteDiagnostic::new(said) })
}

/// The place of the problem, marked with what is found there.
fn label(problem: &Problem) -> Option<LabeledSpan> {
    let text = match problem.kind {
        ProblemKind::Missing => format!("{} is missing", problem.key),
        ProblemKind::NotAvailable => "not available in this version".to_owned(),
        ProblemKind::Geometry(_) => "here".to_owned(),
        _ => format!("found {}", problem.found),
    };
    problem.span.clone().map(|span| LabeledSpan::new_primary_with_span(Some(text), span))
}

/// Failure of a mesh at its key or option.
pub(super) fn no_mesh(error: PairMeshError, text: &SceneText) -> Failure {
    let refused = error.in_the_scene(text);
    match error {
        PairMeshError::Position { position_mm: found_mm, from_mm, to_mm } => {
            InputError::Position { found_mm, from_mm, to_mm }.into()
        }
        PairMeshError::Run(error) => refused.map_or(Failure::Run(error), Failure::Scene),
        PairMeshError::Pair(_) | PairMeshError::Tooth(_) | PairMeshError::Quality { .. } => {
            refused.expect("a fault of the pair has its key").into()
        }
    }
}

/// Option that caused the error.
fn option_of(fault: &UncertaintyFault) -> &'static str {
    match fault {
        UncertaintyFault::Uncertain(_) | UncertaintyFault::Count { .. } => "--uncertain: ",
        UncertaintyFault::Correlation(_) => "--correlation: ",
        UncertaintyFault::Limit(_) => "--limit: ",
        UncertaintyFault::Output(_) => "--outputs: ",
        UncertaintyFault::Samples { .. } => "--samples: ",
        UncertaintyFault::Scene(_) | UncertaintyFault::Study(_) | UncertaintyFault::Journal(_) => "",
    }
}

/// Remedy.
fn uncertainty_help(fault: &UncertaintyFault) -> String {
    match fault {
        UncertaintyFault::Output(_) => "summary.json of a run has all of them".to_owned(),
        UncertaintyFault::Correlation(CorrelationError::NotPositiveDefinite) => {
            "keys that are both close to a third are close to one another".to_owned()
        }
        UncertaintyFault::Samples { .. } => "powers of two are the most even".to_owned(),
        UncertaintyFault::Study(_) | UncertaintyFault::Scene(_) => "gearwear run SCENE says more".to_owned(),
        _ => format!("KEY=DISTRIBUTION with one of {FORMS}"),
    }
}

/// Failure of a run, at the key of the scene that causes it, if one does.
pub(super) fn in_the_scene(error: RunError, scene: &LoadedScene) -> Failure {
    error.in_the_scene(&scene.given).map_or(Failure::Run(error), Failure::Scene)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::Gear;
    use gearwear_bodies::gear_fem::model::ModelError;
    use gearwear_fem::factor::FactorError;
    use gearwear_mesh::quality::QualityError;
    use gearwear_physics::calibration::CalibrationError;
    use gearwear_physics::stiffness::StiffnessError;

    const SCENE: &str = "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\n[fem]\nclamp_radius_mm = { pinion = 19.9, wheel = 37.9 }\n";

    fn text() -> SceneText {
        SceneText { name: "scene.toml".to_owned(), text: SCENE.to_owned() }
    }

    /// The one problem of a failure: its key, and the text at its place.
    fn place(failure: Failure) -> (String, &'static str) {
        assert_eq!(failure.exit_status(), 2);
        let Failure::Scene(SceneError { problems, .. }) = failure else { panic!("{failure}") };
        assert_eq!(problems.len(), 1);
        (problems[0].key.clone(), &SCENE[problems[0].span.clone().unwrap()])
    }

    /// Errors that no known scene causes have a key too.
    #[test]
    fn every_refusal_of_a_model_has_its_key_and_place() {
        let [of_wheel, of_pair] = [Some(Gear::Wheel), None]
            .map(|gear| no_mesh(PairMeshError::Quality { gear, source: QualityError::NoPlaneCells }, &text()));
        assert_eq!(place(of_wheel), ("fem.clamp_radius_mm.wheel".to_owned(), "37.9"));
        let (key, at) = place(of_pair);
        assert!(key == "fem.clamp_radius_mm" && at.contains("pinion = 19.9"), "{key} {at}");
        let condense =
            ModelError::Condense { gear: Gear::Pinion, source: SolveError::Factor(FactorError::OutOfMemory) };
        let condense = RunError::FiniteElements(condense).in_the_scene(&text()).unwrap();
        assert_eq!(place(condense.into()), ("fem.clamp_radius_mm.pinion".to_owned(), "19.9"));
        for strip in [
            CalibrationError::NoClearPosition { line_load_n_per_mm: 1e6 },
            CalibrationError::OffTheFlank { gear: Gear::Pinion, position_mm: 12.0 },
        ] {
            let strip = RunError::Calibration(strip).in_the_scene(&text()).unwrap();
            assert_eq!(place(strip.into()), ("operation.pinion_torque_Nm".to_owned(), "302.0"));
        }
        let soft = StiffnessError::SurfaceTooSoft { position_mm: 12.0, surface_um: 2.0, pair_um: 1.0 };
        assert_eq!(Problem::of_stiffness(SCENE, &soft).key, "contact.match");
    }
}
