//! What is asked of a comparison, checked against the run and the measured file before anything is computed.

use super::run_folder::RunFolder;
use crate::data_table::DataTableError;
use crate::gear::{Gear, GearPair, slices::Slices};
use crate::measurement::file::{HeightFrom, MeasuredFile, Moment, ValueKind};
use crate::measurement::form::Form;
use crate::measurement::profile::MeasuredProfile;
use crate::scene::Resolved;

/// Times beyond the end by less than this part are the end.
const SAME_TIME: f64 = 1e-9;
/// Points that a fit needs beyond the values it finds.
const SPARE_POINTS: usize = 2;

/// What is fitted: the values of `--fit`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum FitKind {
    /// Nothing but the place along the flank.
    None,
    /// The wear coefficient.
    K,
    /// The factor of severe wear.
    Severe,
    /// Both.
    Both,
}

impl FitKind {
    pub(crate) fn coefficient(self) -> bool {
        matches!(self, FitKind::K | FitKind::Both)
    }

    pub(crate) fn severe(self) -> bool {
        matches!(self, FitKind::Severe | FitKind::Both)
    }
}

/// What the user asks beside the files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Asked {
    /// Which gear; `None`: as the file says.
    pub gear: Option<Gear>,
    /// What is taken for the form; `None`: a cubic of heights, nothing of wear depths.
    pub form: Option<Form>,
    pub fit: FitKind,
    /// How far the profile may be shifted along the flank, mm; 0: not at all.
    pub shift_within_mm: f64,
}

/// What does not fit together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum QuestionError {
    #[error(transparent)]
    File(#[from] DataTableError),
    #[error("gear is missing; allowed: a line \"# gear = pinion\" or \"# gear = wheel\", or --gear")]
    NoGear,
    #[error("gear: found {file} in the file and --gear {command}; allowed: the same")]
    OtherGear { file: &'static str, command: &'static str },
    #[error("line {line}: hours: found {hours}; allowed: revolutions, since the scene of the run gives no speed")]
    NoSpeed { line: usize, hours: f64 },
    #[error("line {line}: {key}: found {found}; allowed: more than 0 and at most {end}, the end of the run")]
    Time { line: usize, key: &'static str, found: f64, end: f64 },
    #[error("width_mm is missing; allowed: a line \"# width_mm = …\", 0 to {face_width_mm}, since the run has slices")]
    NoWidth { face_width_mm: f64 },
    #[error("line {line}: width_mm: found {found}; allowed: 0 to {face_width_mm}, the face width")]
    Width { line: usize, found: f64, face_width_mm: f64 },
    #[error("found {found} points; allowed: at least {least}, for {needs}")]
    TooFewPoints { found: usize, least: usize, needs: String },
    /// The curvature of a tooth taken for wear.
    #[error(
        "--form: found none with heights from a line; allowed: cubic or involute, which take the tooth's curvature away"
    )]
    LineWithoutForm,
    #[error("--fit: found {found}, but the scene of the run has no wear.severe; allowed: none or k")]
    NoSevereWear { found: &'static str },
    #[error(
        "--fit: the wear coefficient of the {gear} is 0 in the scene of the run, so that it does not wear; allowed: none"
    )]
    DoesNotWear { gear: &'static str },
}

/// A comparison that can be made.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Question {
    /// What was measured, on its flank.
    pub profile: MeasuredProfile,
    /// When, in pinion revolutions.
    pub revolutions: f64,
    /// Where over the face width; `None` where all sections are alike.
    pub width_mm: Option<f64>,
    /// Standard deviation of a height, as the file says.
    pub uncertainty_um: Option<f64>,
    pub form: Form,
    pub fit: FitKind,
    /// How far the profile may be shifted along the flank, mm.
    pub shift_within_mm: f64,
    /// Wear of the run itself at that time, slice after slice, where it kept that state.
    pub as_run_um: Option<Vec<f64>>,
}

impl Question {
    /// Checks what is asked of the run in `folder`, whose scene is `resolved`, and of its `pair`.
    ///
    /// # Errors
    /// The first thing that does not fit together.
    pub(crate) fn new(
        asked: &Asked,
        file: &MeasuredFile,
        folder: &RunFolder,
        resolved: &Resolved,
        pair: &GearPair,
    ) -> Result<Self, QuestionError> {
        let scene = &resolved.scene;
        let gear = match (file.gear, asked.gear) {
            (Some(file), Some(command)) if file != command => {
                return Err(QuestionError::OtherGear { file: file.name(), command: command.name() });
            }
            (file, command) => file.or(command).ok_or(QuestionError::NoGear)?,
        };
        if asked.fit.severe() && scene.wear[gear].severe.is_none() {
            let found = if asked.fit == FitKind::Both { "both" } else { "severe" };
            return Err(QuestionError::NoSevereWear { found });
        }
        if asked.fit.coefficient() && scene.wear[gear].coefficient_mm2_per_n <= 0.0 {
            return Err(QuestionError::DoesNotWear { gear: gear.name() });
        }
        let of_kind = if file.kind == ValueKind::Wear { Form::None } else { Form::Cubic };
        let form = asked.form.unwrap_or(of_kind);
        if form == Form::None && file.kind == ValueKind::Height && file.height_from == HeightFrom::Line {
            return Err(QuestionError::LineWithoutForm);
        }
        let revolutions = revolutions(file, folder.summary.revolutions, resolved)?;
        let face_width_mm = scene.pair.face_width_mm;
        if let Some(found) = file.width_mm.filter(|width| !(0.0..=face_width_mm).contains(width)) {
            return Err(QuestionError::Width { line: file.width_line, found, face_width_mm });
        }
        let width_mm = match scene.slices {
            Some(_) => Some(file.width_mm.ok_or(QuestionError::NoWidth { face_width_mm })?),
            None => None,
        };
        let found = file.rows.len();
        let (least, needs) = points_needed(asked, form);
        if found < least {
            return Err(QuestionError::TooFewPoints { found, least, needs });
        }
        let profile = MeasuredProfile::on_flank(file, pair, gear)?;
        let slices = scene.slices.map_or(1, |settings| Slices::new(pair, settings.count).count());
        let values = (scene.numerics.flank_points + 1) * slices;
        let as_run_um = folder.wear_um(gear, revolutions).filter(|wear| wear.len() == values).map(<[f64]>::to_vec);
        Ok(Self {
            profile,
            revolutions,
            width_mm,
            uncertainty_um: file.uncertainty_um,
            form,
            fit: asked.fit,
            shift_within_mm: asked.shift_within_mm,
            as_run_um,
        })
    }
}

/// When the profile was measured, in pinion revolutions, of a run that ended after `end` of them.
fn revolutions(file: &MeasuredFile, end: f64, resolved: &Resolved) -> Result<f64, QuestionError> {
    let operation = &resolved.scene.operation;
    let line = file.moment_line;
    let (revolutions, key, found, shown_end) = match file.moment {
        Moment::End => return Ok(end),
        Moment::Revolutions(given) => (given, "revolutions", given, end),
        Moment::Hours(hours) => {
            let no_speed = || QuestionError::NoSpeed { line, hours };
            let at = operation.revolutions_after(hours).ok_or_else(no_speed)?;
            (at, "hours", hours, operation.hours(end).ok_or_else(no_speed)?)
        }
    };
    if revolutions > end * (1.0 + SAME_TIME) {
        return Err(QuestionError::Time { line, key, found, end: shown_end });
    }
    Ok(revolutions.min(end))
}

/// How many points it takes, and what for.
fn points_needed(asked: &Asked, form: Form) -> (usize, String) {
    let values = [
        (form.parameters(), format!("a form ({})", form.name())),
        (usize::from(asked.fit.coefficient()), "the wear coefficient".to_owned()),
        (usize::from(asked.fit.severe()), "the severe factor".to_owned()),
        (usize::from(asked.shift_within_mm > 0.0), "a shift".to_owned()),
    ];
    let least = values.iter().map(|(count, _)| count).sum::<usize>() + SPARE_POINTS;
    let needs: Vec<String> =
        values.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} of {what}")).collect();
    let needs = if needs.is_empty() { "a difference".to_owned() } else { needs.join(", ") };
    (least, format!("{needs}, and {SPARE_POINTS} to spare"))
}
