//! Question as it is asked, on the command line and in the library alike: the run, the table, and whether they fit together.

use std::path::{Path, PathBuf};

use super::limit::WearLimit;
use super::measurement::{WearMeasurement, in_order};
use super::other_gear::{OtherCoefficient, OtherCoefficientError};
use super::record::LifeRecord;
use super::regime::CoefficientPrior;
use super::study::{self, LifeQuestion};
use super::wear_curve::{WearCurveError, WearQuantity};
use super::wear_table::{self, WearRow, WearTime, WearValue};
use crate::compare::asked::{CompareFault, PreparedComparison};
use crate::compare::question::{CompareOptions, FitKind, QuestionError, Refused, scale_coefficients};
use crate::compare::run_folder::{RunFolder, RunFolderError};
use crate::measurement::form::Form;
use gearwear::measured_flank::file::{self, Moment};
use gearwear::measured_flank::teeth::TraceChoice;
use gearwear::scene::loaded::{LoadError, LoadedScene, SceneText};
use gearwear_bodies::gear::error::PairError;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_files::data_table::DataTableError;
use gearwear_physics::observer::Observer;

/// Options beside run and table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LifeOptions {
    /// Measured gear, where the table does not say it.
    pub gear: Option<Gear>,
    /// Of the coefficient of each measured gear; `None`: about that of the run.
    pub prior: Option<CoefficientPrior>,
    /// Of either gear; none: those of `operation.stop` of the scene.
    pub limits: Vec<WearLimit>,
    /// Form to remove from profiles; `None`: a cubic of heights, nothing of wear depths.
    pub form: Option<Form>,
    /// How far a profile may be shifted along the flank, mm.
    pub shift_within_mm: f64,
    /// Traces of profile files with several.
    pub traces: TraceChoice,
    /// Coefficient of the gear that the table does not have; `None`: as the scene has it, beside the measured one's.
    pub other_k: Option<OtherCoefficient>,
}

/// Table or options that do not fit the run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    #[error(transparent)]
    Table(#[from] DataTableError),
    #[error("line {line}: gear: found none; allowed: a column gear, a line \"# gear = pinion\", or --gear")]
    NoGear { line: usize },
    #[error("line {line}: gear: found {found}, and --gear {command}; allowed: the same")]
    OtherGear { line: usize, found: &'static str, command: &'static str },
    #[error("line {line}: hours: found {hours}; allowed: revolutions, since the scene of the run gives no speed")]
    NoSpeed { line: usize, hours: f64 },
    #[error("line {line}: gear: found {gear}, whose wear coefficient is 0 in the run; allowed: a gear that wears")]
    DoesNotWear { line: usize, gear: &'static str },
    #[error(
        "line {line}: profile: found at {found:.6e} revolutions; allowed: up to {end:.6e}, the end of the run: a run with operation.pinion_revolutions of \
         at least as many"
    )]
    ProfileAfterRun { line: usize, found: f64, end: f64 },
    #[error("line {line}: profile: {error}")]
    Profile { line: usize, error: String },
    #[error(
        "operation.phases of the run: found {found}; allowed: one, since wear under several is no function of k times revolutions"
    )]
    Phases { found: usize },
    #[error(
        "line {line}: found wear for which a coefficient some {factor:.0e} times that of the run is needed; allowed: within a factor of {MOST_FACTOR:.0e}"
    )]
    FarFromRun { line: usize, factor: f64 },
    #[error("line {line}: found {found} times of the {gear}; allowed: at most {MOST_TIMES}")]
    TooManyTimes { line: usize, found: usize, gear: &'static str },
    #[error(transparent)]
    OtherCoefficient(#[from] OtherCoefficientError),
    #[error("--limit: found {figure}; allowed: a figure of a measured gear: {measured}")]
    LimitOfOther { figure: String, measured: String },
}

/// Why no life can be told.
#[derive(Debug, thiserror::Error)]
pub enum LifeFault {
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    RunFolder(#[from] RunFolderError),
    #[error("{name}: {error}")]
    Table { name: String, error: TableError },
    #[error(transparent)]
    Pair(#[from] PairError),
}

/// Failure of what was asked rightly.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LifeError {
    #[error(transparent)]
    Curve(#[from] WearCurveError),
    #[error("{file} gives no wear coefficient: {why}")]
    Profile { file: String, why: String },
}

/// Measurements that can be evaluated.
#[derive(Debug)]
pub struct PreparedLife {
    folder: RunFolder,
    scene: LoadedScene,
    pair: GearPair,
    question: LifeQuestion,
}

impl PreparedLife {
    /// Of the finished run in the folder `run` and the table `table`, beside which files of profiles lie.
    ///
    /// # Errors
    /// The first thing that does not fit together.
    pub fn open(run: &Path, table: &SceneText, asked: &LifeOptions) -> Result<Self, LifeFault> {
        let named = |error: TableError| LifeFault::Table { name: table.name.clone(), error };
        let rows = wear_table::parse(&table.text).map_err(|error| named(error.into()))?;
        let folder = RunFolder::open(run)?;
        let mut scene = LoadedScene::open(folder.scene_path())?;
        folder.check_scene(&scene.resolved)?;
        let pair = GearPair::new(&scene.resolved.scene.pair)?;
        let found = scene.resolved.scene.operation.phases.len();
        if found != 1 {
            return Err(named(TableError::Phases { found }));
        }
        let places = rows.iter().map(|row| placed(row, asked, &scene)).collect::<Result<Vec<_>, _>>().map_err(named)?;
        let other = other_gear(asked, &places, &folder, &scene).map_err(|error| named(error.into()))?;
        if let Some((gear, factor)) = other {
            scale_coefficients(&mut scene.resolved.scene, gear, factor);
        }
        let mut measurements = Vec::with_capacity(rows.len());
        for (row, (gear, revolutions)) in rows.iter().zip(places) {
            let profile = match &row.value {
                WearValue::Profile(file) => {
                    let path = beside(&table.name, file);
                    let end = folder.summary.revolutions;
                    if revolutions > end * (1.0 + SAME_TIME) {
                        return Err(named(TableError::ProfileAfterRun { line: row.line, found: revolutions, end }));
                    }
                    let opened = profile(run, &path, gear, revolutions.min(end), asked);
                    let opened = opened.map_err(|error| named(TableError::Profile { line: row.line, error }))?;
                    Some(other.into_iter().fold(opened, |opened, (mate, factor)| opened.with_mate(mate, factor)))
                }
                _ => None,
            };
            measurements.push(WearMeasurement::new(row, gear, revolutions, profile));
        }
        let measurements = in_order(measurements);
        check_sizes(&measurements, &folder).map_err(named)?;
        let limits = limits(&measurements, asked, &scene).map_err(named)?;
        let measured = file_name(&table.name);
        let has_other_k = other.is_some();
        let question = LifeQuestion { measured, measurements, limits, prior: asked.prior.clone(), has_other_k };
        Ok(Self { folder, scene, pair, question })
    }

    /// # Errors
    /// Runs that fail or are interrupted, a profile that gives no coefficient.
    pub fn carry_out(&self, observer: &dyn Observer) -> Result<LifeRecord, LifeError> {
        study::run(&self.question, &self.folder, &self.scene, &self.pair, observer)
    }
}

/// Greatest factor between a measured coefficient and that of the run, about.
const MOST_FACTOR: f64 = 1e6;
/// Most times of a gear that are evaluated.
const MOST_TIMES: usize = 100;
/// mm²/N to m²/N.
const M2_PER_MM2: f64 = 1e-6;
/// Relative tolerance on the end of the run.
const SAME_TIME: f64 = 1e-9;

/// Gear and revolutions of a row.
fn placed(row: &WearRow, asked: &LifeOptions, scene: &LoadedScene) -> Result<(Gear, f64), TableError> {
    let line = row.line;
    let gear = match (row.gear, asked.gear) {
        (Some(found), Some(command)) if found != command => {
            return Err(TableError::OtherGear { line, found: found.name(), command: command.name() });
        }
        (found, command) => found.or(command).ok_or(TableError::NoGear { line })?,
    };
    let scene = &scene.resolved.scene;
    let phase = &scene.operation.phases[0];
    if scene.wear_in(phase)[gear].coefficient_mm2_per_n <= 0.0 {
        return Err(TableError::DoesNotWear { line, gear: gear.name() });
    }
    let revolutions = match row.time {
        WearTime::Revolutions(revolutions) => revolutions,
        WearTime::Hours(hours) => {
            let rpm = phase.pinion_speed_rpm.ok_or(TableError::NoSpeed { line, hours })?;
            60.0 * rpm * hours
        }
    };
    Ok((gear, revolutions))
}

/// The gear that no row of the table is of, and the factor on its coefficient that was asked for.
fn other_gear(
    asked: &LifeOptions,
    places: &[(Gear, f64)],
    folder: &RunFolder,
    scene: &LoadedScene,
) -> Result<Option<(Gear, f64)>, OtherCoefficientError> {
    let Some(other_k) = &asked.other_k else { return Ok(None) };
    let gear = Gear::BOTH.into_iter().find(|&gear| places.iter().all(|(measured, _)| *measured != gear));
    let gear = gear.ok_or(OtherCoefficientError::BothMeasured)?;
    let scene = &scene.resolved.scene;
    let of_run = scene.wear_in(&scene.operation.phases[0])[gear].coefficient_mm2_per_n;
    if of_run <= 0.0 {
        return Err(OtherCoefficientError::DoesNotWear { gear: gear.name() });
    }
    let k = other_k.of(gear, &folder.summary.scene_hash)?;
    Ok(Some((gear, k / (M2_PER_MM2 * of_run))))
}

/// Checks the number of times, and that wear is not of another order than in the run.
fn check_sizes(measurements: &[WearMeasurement], folder: &RunFolder) -> Result<(), TableError> {
    for gear in Gear::BOTH {
        let of_gear: Vec<&WearMeasurement> = measurements.iter().filter(|of| of.gear == gear).collect();
        if let Some(first) = of_gear.get(MOST_TIMES) {
            let found = of_gear.len();
            return Err(TableError::TooManyTimes { line: first.lines[0], found, gear: gear.name() });
        }
    }
    for of in measurements {
        let Some(quantity) = WearQuantity::of_kind(of.kind) else { continue };
        let of_run = folder.number(&format!("{}.{}", of.gear.name(), quantity.figure())).unwrap_or(0.0);
        for (&value, &line) in of.values.iter().zip(&of.lines) {
            let factor = value / of.revolutions / (of_run / folder.summary.revolutions);
            if !(1.0 / MOST_FACTOR..=MOST_FACTOR).contains(&factor) {
                return Err(TableError::FarFromRun { line, factor });
            }
        }
    }
    Ok(())
}

/// Comparison of one profile with the run, for its wear coefficient.
fn profile(
    run: &Path,
    path: &Path,
    gear: Gear,
    revolutions: f64,
    asked: &LifeOptions,
) -> Result<PreparedComparison, String> {
    let text = SceneText::read_foreign(path).map_err(|error| format!("{error}; allowed: a file beside the table"))?;
    let options = CompareOptions {
        gear: Some(gear),
        form: asked.form,
        fit: Some(FitKind::K),
        shift_within_mm: asked.shift_within_mm,
        traces: asked.traces,
        tries_slopes: false,
    };
    let refused = |error: QuestionError| Refused { name: text.name.clone(), error }.to_string();
    let file = file::parse(&text.text, &asked.traces).map_err(|error| refused(error.into()))?;
    let file = file::MeasuredFile { moment: Moment::Revolutions(revolutions), ..file };
    PreparedComparison::of_files(run, &[(text.name.clone(), file)], &options)
        .map_err(|fault: CompareFault| fault.to_string())
}

/// Path of a file that a table names.
fn beside(table: &str, file: &str) -> PathBuf {
    Path::new(table).parent().unwrap_or(Path::new("")).join(file)
}

fn file_name(name: &str) -> String {
    Path::new(name).file_name().map_or_else(|| name.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// Limits that were asked for, or those of the scene.
fn limits(
    measurements: &[WearMeasurement],
    asked: &LifeOptions,
    scene: &LoadedScene,
) -> Result<Vec<WearLimit>, TableError> {
    let is_measured = |gear: Gear| measurements.iter().any(|of| of.gear == gear);
    let gears = || Gear::BOTH.into_iter().filter(|&gear| is_measured(gear));
    if let Some(other) = asked.limits.iter().find(|limit| !is_measured(limit.gear)) {
        let measured = gears().map(|gear| format!("{}.peak_wear_um", gear.name())).collect::<Vec<_>>().join(" or ");
        return Err(TableError::LimitOfOther { figure: other.figure.clone(), measured });
    }
    if !asked.limits.is_empty() {
        return Ok(asked.limits.clone());
    }
    let of_scene = scene.resolved.scene.operation.stop.wear_mm;
    Ok(of_scene
        .map(|wear_mm| gears().map(|gear| WearLimit::new(gear, WearQuantity::PeakDepth, 1e3 * wear_mm)).collect())
        .unwrap_or_default())
}
