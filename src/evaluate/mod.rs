//! Outputs of a scene's run for rows of values of its keys: what sensitivity analyses, optimisers and samplers call.
//!
//! ```text
//! y_ij = output j of the scene with keys k_1 … k_d = x_i1 … x_id
//! ```
//!
//! An output is named by its path in `summary.json` ([`output`]). What the outputs do not need is left out of the runs: snapshots always,
//! the error estimates and the verification by finite elements unless an output lies below `error`. Wear steps are shortened to hit
//! snapshots, so that a run with snapshots differs by a fraction of its wear-step error. A row that cannot be run gives no
//! numbers and says why; it is no error of the others. Rows are run one a thread, and no number of threads changes a bit of them.

pub mod figure;
pub mod output;

use crate::scene::draft::Draft;
use crate::scene::key::{self, as_whole, is_key, linked_keys, takes_whole_numbers};
use crate::scene::loaded::SceneError;
use crate::scene::opened::{OpenedScene, SceneKind};
use crate::scene::table::other_ways_to_say;
use crate::spread::spread;
use crate::varied_scene::{VariedScene, in_words, missing_phase, one_line};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::run::StopReason;
use output::{OutputError, SummaryOutput};

/// Outcome of each row.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The outputs of each row, in their order; NaN where there is none.
    pub values: Vec<Vec<f64>>,
    /// Why a row has a NaN, on one line; `None` where it has none.
    pub reasons: Vec<Option<String>>,
}

/// Fault of the question; a row that cannot be run is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EvaluateError {
    /// No scene has the key.
    #[error("unknown key {key}; allowed: a key of the scene, such as pair.face_width_mm{}", did_you_mean(.nearest))]
    UnknownKey {
        /// Key as given.
        key: String,
        /// Key that was probably meant.
        nearest: Option<String>,
    },
    /// A phase that the scene does not have.
    #[error("found {key}; allowed: a phase that the scene has, numbered from 1")]
    NoPhase {
        /// Key as given.
        key: String,
    },
    /// A key twice, or two that say the same in different ways.
    #[error("found {key} and {other}, which say the same thing; allowed: one of the two")]
    SaidTwice {
        /// The first.
        key: String,
        /// The second.
        other: String,
    },
    /// No summary has the output.
    #[error("unknown output {output}; allowed: the path of a number in summary.json, such as pinion.peak_wear_um{}", did_you_mean(.nearest))]
    UnknownOutput {
        /// Output as given.
        output: String,
        /// Output that was probably meant.
        nearest: Option<String>,
    },
    /// A row of another length than the keys.
    #[error("row {row}: found {found} values; allowed: {expected}, one for each key")]
    RowLength {
        /// Number of the row, from 0.
        row: usize,
        /// How many it has.
        found: usize,
        /// How many keys there are.
        expected: usize,
    },
    /// A value that is no number.
    #[error("row {row}, {key}: found {found}; allowed: a finite number")]
    NotFinite {
        /// Number of the row, from 0.
        row: usize,
        /// Whose value.
        key: String,
        /// The value.
        found: f64,
    },
    /// The scene itself cannot be read again.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |nearest| format!("; did you mean {nearest}?"))
}

impl From<OutputError> for EvaluateError {
    fn from(OutputError { output, nearest }: OutputError) -> Self {
        Self::UnknownOutput { output, nearest }
    }
}

/// Runs `scene` once for each of `rows`, which hold a value for each of `keys`, on `threads` threads, and keeps `outputs`.
///
/// Keys are paths in the scene, of several that have the same value with alternatives: `pair.{pinion,wheel}.tip_rounding_mm`; items of
/// lists are numbered from 1 (`operation.phases.2.hours`). Outputs are paths of numbers in `summary.json`: `pinion.peak_wear_um`,
/// `new.transmission_error_um.peak_to_peak`, `error.total.peak_wear.pinion`, `helical.width_mm.1`. Where the observer interrupts it, the rows
/// that are not finished say so.
///
/// Snapshots are left out, and error estimates and verification unless an output lies below `error`. Wear steps are shortened to hit snapshots: a
/// run with others than its end differs by a fraction of its wear-step error.
///
/// # Errors
/// Keys or outputs that do not exist, rows that do not fit the keys.
pub fn evaluate<S>(
    scene: &S,
    keys: &[impl AsRef<str>],
    rows: &[Vec<toml::Value>],
    outputs: &[impl AsRef<str>],
    threads: usize,
    observer: &dyn Observer,
) -> Result<Evaluation, EvaluateError>
where
    for<'s> &'s S: Into<OpenedScene>,
{
    let keys: Vec<&str> = keys.iter().map(AsRef::as_ref).collect();
    let scene = &scene.into();
    let outputs = self::outputs(scene.kind(), outputs)?;
    let draft = Draft::parse(&scene.given().text).map_err(|problems| scene.refused(problems))?;
    check_keys(&keys, &draft)?;
    check_rows(&keys, rows)?;
    let of_error = outputs.iter().any(SummaryOutput::is_of_error);
    let estimates = scene.each().all().iter().any(|pair| pair.scene().numerics.error_estimate);
    let varied = VariedScene::new(scene, of_error && estimates);
    let varied = varied.map_err(|problems| scene.refused(problems))?;
    let varied = varied.with_torque_curve(outputs.iter().any(SummaryOutput::is_of_torque_curve));
    let whole = keys.iter().map(|key| takes_whole_numbers(key)).collect();
    let verify = of_error && scene.verifies();
    let asked = AskedRows { varied, keys, whole, outputs, verify };

    let mut found = Evaluation {
        values: vec![vec![f64::NAN; asked.outputs.len()]; rows.len()],
        reasons: vec![Some("interrupted".to_owned()); rows.len()],
    };
    let mut done = 0;
    let tasks: Vec<usize> = (0..rows.len()).collect();
    spread(
        &tasks,
        threads.max(1),
        observer,
        |&row, within| Some((row, asked.carry_out(&rows[row], within)?)),
        |(row, result)| {
            done += 1;
            observer.counted(done, rows.len(), "rows", "");
            match result {
                Ok(values) => {
                    found.reasons[row] = asked.without_number(&values);
                    found.values[row] = values;
                }
                Err(reason) => found.reasons[row] = Some(reason),
            }
            true
        },
    );
    Ok(found)
}

/// The outputs at these paths of the summary of a kind of scene.
///
/// # Errors
/// A path that no summary has.
pub fn outputs(kind: SceneKind, paths: &[impl AsRef<str>]) -> Result<Vec<SummaryOutput>, EvaluateError> {
    Ok(paths.iter().map(|path| SummaryOutput::of_kind(kind, path.as_ref())).collect::<Result<_, OutputError>>()?)
}

/// Question that all rows share.
struct AskedRows<'a> {
    varied: VariedScene,
    keys: Vec<&'a str>,
    /// Whether each key takes whole numbers alone.
    whole: Vec<bool>,
    outputs: Vec<SummaryOutput>,
    verify: bool,
}

impl AskedRows<'_> {
    /// The outputs of a row, NaN where the run has none, or on one line why there are none; `None` where the run was interrupted.
    fn carry_out(&self, row: &[toml::Value], within: &dyn Observer) -> Option<Result<Vec<f64>, String>> {
        match guarded(|| self.outputs_of(row, within)) {
            Ok(Ok(values)) => values.map(Ok),
            Ok(Err(_)) | Err(_) if within.interrupted() => None,
            Ok(Err(reason)) => Some(Err(one_line(&reason))),
            Err(said) => Some(Err(one_line(&format!("a defect of the program: {said}")))),
        }
    }

    fn outputs_of(&self, row: &[toml::Value], within: &dyn Observer) -> Result<Option<Vec<f64>>, String> {
        let values = row.iter().zip(&self.whole);
        let values = values.map(|(value, &whole)| if whole { as_whole(value) } else { value.clone() });
        let exchanged = self.keys.iter().copied().zip(values);
        let mut scene = self.varied.resolved(exchanged).map_err(|problems| in_words(&problems))?;
        if self.verify {
            self.varied.verify_as_given(&mut scene);
        }
        self.varied.inputs_belong_to(&scene)?;
        let run = self.varied.run(&scene, within)?;
        if run.summary().stopped() == StopReason::Interrupted {
            return Ok(None);
        }
        let summary = serde_json::to_value(run.summary()).map_err(|error| error.to_string())?;
        Ok(Some(self.outputs.iter().map(|output| output.of(&summary).unwrap_or(f64::NAN)).collect()))
    }

    /// The first output of a row that is no number; `None` where all are.
    fn without_number(&self, values: &[f64]) -> Option<String> {
        let (output, _) = self.outputs.iter().zip(values).find(|(_, value)| !value.is_finite())?;
        Some(format!("{}: the run has no such figure", output.path))
    }
}

fn check_keys(keys: &[&str], draft: &Draft) -> Result<(), EvaluateError> {
    let mut before: Vec<String> = Vec::new();
    for key in keys.iter().flat_map(|key| linked_keys(key)) {
        if !is_key(&key) {
            return Err(EvaluateError::UnknownKey { nearest: key::nearest_key(&key), key });
        }
        let ways = other_ways_to_say(&key);
        if let Some(other) = before.iter().find(|other| **other == key || ways.contains(other)) {
            return Err(EvaluateError::SaidTwice { key: other.clone(), other: key });
        }
        before.push(key);
    }
    missing_phase(before, draft).map_or(Ok(()), |key| Err(EvaluateError::NoPhase { key }))
}

fn check_rows(keys: &[&str], rows: &[Vec<toml::Value>]) -> Result<(), EvaluateError> {
    for (row, values) in rows.iter().enumerate() {
        if values.len() != keys.len() {
            return Err(EvaluateError::RowLength { row, found: values.len(), expected: keys.len() });
        }
        let mut numbers = keys.iter().zip(values).filter_map(|(key, value)| Some((key, value.as_float()?)));
        if let Some((key, found)) = numbers.find(|(_, value)| !value.is_finite()) {
            return Err(EvaluateError::NotFinite { row, key: (*key).to_owned(), found });
        }
    }
    Ok(())
}
