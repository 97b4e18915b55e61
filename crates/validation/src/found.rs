//! Studies for those who use the library: one call a study, with what the program's commands give.
//!
//! A [`Study`] is what was found: the record as JSON, as the command writes it, and the files themselves.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Serialize;

use crate::invariants;
use crate::invariants::study::{INVARIANTS, SceneRange};
use crate::library::{Library, LibraryError};
use crate::record::Tier;
use gearwear::measured_flank::file::FlankSide;
use gearwear::measured_flank::teeth::{ChosenBy, TraceChoice};
use gearwear::report::ReportError;
use gearwear::scene::loaded::{LoadError, LoadedScene, SceneError, SceneText};
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Observer;
use gearwear_studies::accuracy::selection;
use gearwear_studies::accuracy::study::AccuracyError;
use gearwear_studies::compare::asked::{CompareFault, PreparedComparison};
use gearwear_studies::compare::question;
use gearwear_studies::compare::run_folder::RunFolderError;
use gearwear_studies::compare::study::CompareError;
use gearwear_studies::improve::asked::ImproveError;
use gearwear_studies::remaining_life::asked::{LifeError, LifeFault, LifeOptions, PreparedLife};
use gearwear_studies::remaining_life::limit::LimitError;
use gearwear_studies::remaining_life::other_gear::OtherCoefficient;
use gearwear_studies::remaining_life::regime::PriorError;
use gearwear_studies::remaining_life::wear_curve::WearCurveError;
use gearwear_studies::variants::finished_run::FinishedRun;
use gearwear_studies::variants::record::VariantsRecord;
use gearwear_studies::{accuracy, compare, improve, remaining_life, variants};

type Write = dyn Fn(&Path) -> Result<(), ReportError> + Send + Sync;

/// Findings of a study.
pub struct Study {
    json: String,
    write: Box<Write>,
}

impl Study {
    fn new<R: Serialize + Send + Sync + 'static>(
        record: R,
        write: impl Fn(&R, &Path) -> Result<(), ReportError> + Send + Sync + 'static,
    ) -> Result<Self, StudyError> {
        let json = serde_json::to_string(&record).map_err(StudyFault::NoJson)?;
        Ok(Self { json, write: Box::new(move |folder| write(&record, folder)) })
    }

    /// The record, as the command writes it.
    pub fn json(&self) -> &str {
        &self.json
    }

    /// Writes what the command writes into `folder`, which is made if need be.
    ///
    /// # Errors
    /// [`ReportError`] where a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), ReportError> {
        (self.write)(folder)
    }
}

/// Error of a study.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct StudyError(#[from] StudyFault);

#[derive(Debug, thiserror::Error)]
enum StudyFault {
    #[error(transparent)]
    Accuracy(AccuracyError),
    #[error("within: found {found}; allowed: a share above 0 and at most 1")]
    Within { found: f64 },
    #[error("{key}: found {found:?}; allowed: {allowed}")]
    Word { key: &'static str, found: String, allowed: String },
    #[error("shift_within_mm: found {found}; allowed: a length in mm, 0 or more")]
    Shift { found: f64 },
    #[error("measured: found no profile; allowed: one, or one of the pinion and one of the wheel")]
    NoProfile,
    #[error(transparent)]
    Compare(CompareFault),
    #[error(transparent)]
    Comparison(CompareError),
    #[error("limit: {0}")]
    Limit(LimitError),
    #[error("prior: {0}")]
    Prior(PriorError),
    #[error(transparent)]
    Life(LifeFault),
    #[error(transparent)]
    Improve(ImproveError),
    #[error(transparent)]
    Lives(LifeError),
    #[error(transparent)]
    RunFolder(RunFolderError),
    #[error("found {found} runs; allowed: two or more")]
    TooFewRuns { found: usize },
    #[error(transparent)]
    Library(LibraryError),
    #[error(transparent)]
    NoJson(serde_json::Error),
}

impl StudyError {
    /// Fault of a file, if that is the reason.
    pub fn in_loading(&self) -> Option<&LoadError> {
        match &self.0 {
            StudyFault::Compare(CompareFault::Load(error)) | StudyFault::Life(LifeFault::Load(error)) => Some(error),
            _ => None,
        }
    }

    /// Fault of the scene, if that is the reason.
    pub fn in_the_scene(&self) -> Option<&SceneError> {
        if let StudyFault::Improve(ImproveError::Scene(error)) = &self.0 { Some(error) } else { None }
    }

    /// Whether the question was sound and the runs failed.
    pub fn is_of_the_runs(&self) -> bool {
        matches!(
            self.0,
            StudyFault::Accuracy(_)
                | StudyFault::Comparison(_)
                | StudyFault::Improve(
                    ImproveError::Base(_)
                        | ImproveError::NoDesign { .. }
                        | ImproveError::NotWithinLimits { .. }
                        | ImproveError::Interrupted
                )
                | StudyFault::Lives(LifeError::Curve(WearCurveError::Run(_)) | LifeError::Profile { .. })
        )
    }
}

/// The error of every model that fits the scene against its run time, as `gearwear accuracy`: `within` is the relative error that
/// recommendations stay
/// within, `quick` leaves the scene's own resolution out.
///
/// # Errors
/// A reference that fails or is interrupted.
pub fn accuracy(scene: &LoadedScene, within: f64, quick: bool, observer: &dyn Observer) -> Result<Study, StudyError> {
    if !(within > 0.0 && within <= 1.0) {
        return Err(StudyFault::Within { found: within }.into());
    }
    let record = accuracy::study::run(scene, selection::AccuracyOptions { within, quick }, observer)
        .map_err(StudyFault::Accuracy)?;
    Study::new(record, |record, folder| accuracy::report::write(record, folder).map(drop))
}

/// Better designs of a scene, as `gearwear improve`; with a folder finished designs are kept there.
///
/// # Errors
/// What is wrong with its table `[improve]`; runs that fail or are interrupted.
pub fn improve(
    scene: &LoadedScene,
    folder: Option<&Path>,
    threads: usize,
    observer: &dyn Observer,
) -> Result<Study, StudyError> {
    let record = improve::study::improve(scene, folder, threads, observer).map_err(StudyFault::Improve)?;
    Study::new(record, improve::report::write)
}

/// Options of a comparison with measured profiles, in the words of the command line.
#[derive(Debug, Clone, PartialEq)]
pub struct CompareQuestion {
    /// Measured gear; `None`: as the file says.
    pub gear: Option<String>,
    /// Form to remove: cubic, involute or none; `None`: cubic of heights, none of wear depths.
    pub form: Option<String>,
    /// Coefficients to fit: none, k, each, severe or both; `None`: k of one profile, each of two.
    pub fit: Option<String>,
    /// How far a profile may be shifted along the flank, mm; 0: not at all.
    pub shift_within_mm: f64,
    /// Tooth to take of a file with several; `None`: the mean of all.
    pub tooth: Option<u32>,
    /// Flank to take of a file with both: left or right.
    pub flank: Option<String>,
    /// Place over the face width whose profile is taken of a file with several.
    pub width_mm: Option<f64>,
}

/// The measured profiles in the texts `measured`, one or those of pinion and wheel, against the finished run in the folder `run`, as
/// `gearwear compare`.
///
/// # Errors
/// A folder without a finished run, a profile that does not fit it, runs that fail.
pub fn compare(
    run: &Path,
    measured: &[SceneText],
    question: &CompareQuestion,
    observer: &dyn Observer,
) -> Result<Study, StudyError> {
    let gear = question.gear.as_deref().map(gear_named);
    let side = question
        .flank
        .as_deref()
        .map(|name| FlankSide::named(name).ok_or_else(|| word("flank", name, "left, right".to_owned())));
    if !(question.shift_within_mm >= 0.0 && question.shift_within_mm.is_finite()) {
        return Err(StudyFault::Shift { found: question.shift_within_mm }.into());
    }
    let asked = question::CompareOptions {
        gear: gear.transpose()?,
        form: question.form.as_deref().map(|name| one_of("form", name)).transpose()?,
        fit: question.fit.as_deref().map(|name| one_of("fit", name)).transpose()?,
        shift_within_mm: question.shift_within_mm,
        traces: TraceChoice {
            tooth: question.tooth,
            side: side.transpose()?,
            width_mm: question.width_mm,
            by: ChosenBy::Options,
        },
        tries_slopes: true,
    };
    if measured.is_empty() {
        return Err(StudyFault::NoProfile.into());
    }
    let prepared = PreparedComparison::open(run, measured, &asked).map_err(StudyFault::Compare)?;
    let record = prepared.carry_out(observer).map_err(StudyFault::Comparison)?;
    Study::new(record, compare::report::write)
}

/// One of the words that an option takes.
fn one_of<E: ValueEnum>(key: &'static str, name: &str) -> Result<E, StudyFault> {
    E::from_str(name, false).map_err(|_| {
        let words = E::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        word(key, name, words.map(|word| word.get_name().to_owned()).collect::<Vec<_>>().join(", "))
    })
}

fn word(key: &'static str, found: &str, allowed: String) -> StudyFault {
    StudyFault::Word { key, found: found.to_owned(), allowed }
}

/// Options of remaining life by measurements at several times, in the words of the command line.
#[derive(Debug, Clone, PartialEq)]
pub struct LifeQuestion {
    /// Measured gear; `None`: as the table says.
    pub gear: Option<String>,
    /// Limits of wear, `FIGURE=VALUE` each; none: those of the scene.
    pub limits: Vec<String>,
    /// Regime, or LOW:HIGH in m²/N; `None`: about the coefficient of the run.
    pub prior: Option<String>,
    /// Form to remove from profiles.
    pub form: Option<String>,
    /// How far a profile may be shifted along the flank, mm.
    pub shift_within_mm: f64,
    /// Coefficient of the gear that the table does not have, in m²/N, or the folder of a comparison that fitted it.
    pub other_k: Option<String>,
}

/// Wear coefficient and remaining life by the measurements of `table`, beside which the files of profiles lie, and the finished run in the folder `run`, as
/// `gearwear compare --history`.
///
/// # Errors
/// A folder without a finished run, a table that does not fit it, runs that fail.
pub fn remaining_life(
    run: &Path,
    table: &SceneText,
    question: &LifeQuestion,
    observer: &dyn Observer,
) -> Result<Study, StudyError> {
    if !(question.shift_within_mm >= 0.0 && question.shift_within_mm.is_finite()) {
        return Err(StudyFault::Shift { found: question.shift_within_mm }.into());
    }
    let limits = question.limits.iter().map(|limit| limit.parse().map_err(StudyFault::Limit));
    let asked = LifeOptions {
        gear: question.gear.as_deref().map(gear_named).transpose()?,
        prior: question.prior.as_deref().map(|prior| prior.parse().map_err(StudyFault::Prior)).transpose()?,
        limits: limits.collect::<Result<_, _>>()?,
        form: question.form.as_deref().map(|name| one_of("form", name)).transpose()?,
        shift_within_mm: question.shift_within_mm,
        traces: TraceChoice::default(),
        other_k: question.other_k.as_deref().map(OtherCoefficient::named),
    };
    let prepared = PreparedLife::open(run, table, &asked).map_err(StudyFault::Life)?;
    let record = prepared.carry_out(observer).map_err(StudyFault::Lives)?;
    Study::new(record, remaining_life::report::write)
}

fn gear_named(name: &str) -> Result<Gear, StudyFault> {
    let named = Gear::BOTH.into_iter().find(|gear| gear.name() == name);
    named.ok_or_else(|| word("gear", name, "pinion, wheel".to_owned()))
}

/// Finished runs side by side, as `gearwear compare RUN RUN …`: their folders, each with what it is called.
///
/// # Errors
/// A folder without a finished run.
pub fn compare_runs(runs: &[(PathBuf, String)]) -> Result<Study, StudyError> {
    if runs.len() < 2 {
        return Err(StudyFault::TooFewRuns { found: runs.len() }.into());
    }
    let runs: Result<Vec<_>, _> = runs.iter().map(|(folder, name)| FinishedRun::read(folder, name.clone())).collect();
    let runs = runs.map_err(StudyFault::RunFolder)?;
    Study::new(VariantsRecord::new(&runs), move |record, folder| variants::report::write(record, &runs, folder))
}

/// The validation suite, as `gearwear validate`: cases by name or folder, none: all, of the `tier` smoke, full or long. The word `invariants` alone:
/// random scenes, a hundred of the tier smoke, a thousand otherwise.
///
/// # Errors
/// Cases or tiers that do not exist. A case that misses its bound is none: the record says it.
pub fn validate(
    cases: &[String],
    tier: Option<&str>,
    threads: usize,
    observer: &dyn Observer,
) -> Result<Study, StudyError> {
    let tier = tier.map(|name| {
        let named = Tier::ALL.into_iter().find(|tier| tier.name() == name);
        named.ok_or_else(|| word("tier", name, Tier::ALL.map(Tier::name).join(", ")))
    });
    let tier = tier.transpose()?;
    if cases == [INVARIANTS] {
        let record = invariants::study::run(SceneRange::of_tier(tier), threads, observer);
        return Study::new(record, invariants::report::write);
    }
    let library = Library::open(cases).map_err(StudyFault::Library)?;
    let tier = library.tier(tier, cases.is_empty()).map_err(StudyFault::Library)?;
    let record = crate::run(&library.cases, tier, threads, observer);
    Study::new(record, |record, folder| crate::report::write(record, None, folder).map(drop))
}
