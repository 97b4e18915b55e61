//! Question of a comparison, checked against the run and the measured files before anything is computed.

use std::path::Path;

use super::run_folder::RunFolder;
use super::unknown::Unknown;
use crate::measurement::form::Form;
use gearwear::measured_flank::file::{HeightFrom, MachineGear, MeasuredFile, Moment, ValueKind};
use gearwear::measured_flank::profile::MeasuredProfile;
use gearwear::measured_flank::teeth::TraceChoice;
use gearwear::scene::Resolved;
use gearwear_bodies::gear::{Gear, GearPair, slices::Slices};
use gearwear_files::data_table::DataTableError;
use gearwear_physics::operation::Scene;
use gearwear_physics::wear::settings::WearOfPair;

/// Relative tolerance on the end of the run.
const SAME_TIME: f64 = 1e-9;
/// Least degrees of freedom of a fit.
const SPARE_POINTS: usize = 2;
/// Most profiles that are fitted together: one of each gear.
pub const MOST_PROFILES: usize = 2;

/// Coefficients to fit: the values of `--fit`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum FitKind {
    /// Nothing but the place along the flank.
    None,
    /// The wear coefficient; with two profiles one factor on those of both gears.
    K,
    /// The wear coefficients of pinion and wheel, each to its own value, with two profiles.
    Each,
    /// The factor of severe wear.
    Severe,
    /// The wear coefficient as `k`, and the factor of severe wear.
    Both,
}

impl FitKind {
    /// Default for this number of profiles.
    fn of(profiles: usize) -> Self {
        if profiles > 1 { FitKind::Each } else { FitKind::K }
    }

    pub fn coefficient(self) -> bool {
        matches!(self, FitKind::K | FitKind::Each | FitKind::Both)
    }

    pub fn severe(self) -> bool {
        matches!(self, FitKind::Severe | FitKind::Both)
    }

    /// Name on the command line.
    fn name(self) -> &'static str {
        match self {
            FitKind::None => "none",
            FitKind::K => "k",
            FitKind::Each => "each",
            FitKind::Severe => "severe",
            FitKind::Both => "both",
        }
    }
}

/// Gears whose coefficients are fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FittedGears {
    /// Coefficients of both gears, by one factor.
    Together,
    /// Coefficients of the measured gear alone, whose law is not that of its mate.
    Alone(Gear),
    /// Coefficients of both gears, each by a factor of its own.
    Each,
}

impl FittedGears {
    /// Whether coefficients of `gear` are fitted.
    pub fn has(self, gear: Gear) -> bool {
        self != FittedGears::Alone(gear.mate())
    }
}

/// Options beside the files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompareOptions {
    /// Measured gear; `None`: as the file says.
    pub gear: Option<Gear>,
    /// Form to remove; `None`: a cubic of heights, nothing of wear depths.
    pub form: Option<Form>,
    /// Coefficients to fit; `None`: the wear coefficient of each measured gear.
    pub fit: Option<FitKind>,
    /// How far a profile may be shifted along the flank, mm; 0: not at all.
    pub shift_within_mm: f64,
    /// Traces of a file with several.
    pub traces: TraceChoice,
    /// Whether to fit again with the profile slopes that are found in the scene.
    pub tries_slopes: bool,
}

/// Inconsistent inputs.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QuestionError {
    #[error(transparent)]
    File(#[from] DataTableError),
    #[error("gear is missing; allowed: a line \"# gear = pinion\" or \"# gear = wheel\", or --gear")]
    NoGear,
    #[error("line {line}: number of teeth: found {found}; allowed: {allowed}")]
    OtherTeeth { line: usize, found: u32, allowed: String },
    #[error(
        "line {line}: base radius, mm: found {found:.4}, by module, teeth and angles; allowed: {allowed:.4}, that of the {gear} of the run"
    )]
    OtherGearSize { line: usize, found: f64, allowed: f64, gear: &'static str },
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
    /// A form removal that leaves the curvature of the tooth, which would count as wear.
    #[error(
        "--form: found none with heights from a line; allowed: cubic or involute, which take the tooth's curvature away"
    )]
    LineWithoutForm,
    #[error("--fit: found {found}, but the scene of the run has no wear.severe; allowed: {allowed}")]
    NoSevereWear { found: &'static str, allowed: &'static str },
    #[error(
        "--fit: found {found}, but the severe wear of pinion and wheel differs in the scene of the run; allowed: none, k or each"
    )]
    TwoKindsOfSevereWear { found: &'static str },
    #[error(
        "--fit: found each with the profile of one gear; allowed: none, k, severe or both, or a profile of the {missing} too"
    )]
    OneProfile { missing: &'static str },
    #[error("gear: found {gear}, as in {first}; allowed: profiles of different gears")]
    SameGear { gear: &'static str, first: String },
    #[error("--gear: found beside two measured profiles; allowed: a line \"# gear = …\" in each of them")]
    GearOfTwo,
    #[error("found {found} measured profiles; allowed: one, or one of the pinion and one of the wheel")]
    TooManyProfiles { found: usize },
    #[error(
        "--fit: the wear coefficient of the {gear} is 0 in the scene of the run, so that it does not wear; allowed: none"
    )]
    DoesNotWear { gear: &'static str },
}

/// A file that does not fit, by its name.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{name}: {error}")]
pub struct Refused {
    pub name: String,
    pub error: QuestionError,
}

/// A measured profile that can be compared.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileQuestion {
    /// Name of its file.
    pub measured: String,
    /// Measured profile, on its flank.
    pub profile: MeasuredProfile,
    /// Time of the measurement, in pinion revolutions.
    pub revolutions: f64,
    /// Place over the face width; `None` where all sections are alike.
    pub width_mm: Option<f64>,
    /// Standard deviation of a height, as the file says.
    pub uncertainty_um: Option<f64>,
    pub form: Form,
    /// Wear of the run itself at that time, slice after slice, where it kept that state.
    pub as_run_um: Option<Vec<f64>>,
}

/// A comparison that can be made.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonQuestion {
    /// One profile, or one of each gear.
    pub profiles: Vec<ProfileQuestion>,
    pub fit: FitKind,
    pub fitted: FittedGears,
    /// How far a profile may be shifted along the flank, mm.
    pub shift_within_mm: f64,
    /// Whether to fit again with the profile slopes that are found in the scene.
    pub tries_slopes: bool,
}

impl ComparisonQuestion {
    /// Checks the options and files against the run in `folder`, whose scene is `resolved` and whose pair is `pair`; files go by their names.
    ///
    /// # Errors
    /// The first thing that does not fit together.
    pub fn new(
        asked: &CompareOptions,
        files: &[(String, MeasuredFile)],
        folder: &RunFolder,
        resolved: &Resolved,
        pair: &GearPair,
    ) -> Result<Self, Refused> {
        let scene = &resolved.scene;
        let fit = asked.fit.unwrap_or(FitKind::of(files.len()));
        let mut profiles: Vec<ProfileQuestion> = Vec::new();
        for (name, file) in files {
            let of_file = match (files.len(), asked.gear) {
                (found, _) if found > MOST_PROFILES => Err(QuestionError::TooManyProfiles { found }),
                (2.., Some(_)) => Err(QuestionError::GearOfTwo),
                _ => ProfileQuestion::new(name, file, asked, fit, (folder, resolved, pair)),
            };
            let of_file = of_file.and_then(|of_file| {
                let gear = of_file.profile.gear;
                if let Some(first) = profiles.iter().find(|first| first.profile.gear == gear) {
                    return Err(QuestionError::SameGear { gear: gear.name(), first: first.measured.clone() });
                }
                check_fit(fit, gear, files.len(), scene)?;
                Ok(of_file)
            });
            profiles.push(of_file.map_err(|error| Refused { name: name.clone(), error })?);
        }
        profiles.sort_by_key(|of| of.profile.gear);
        let fitted = match &profiles[..] {
            _ if fit == FitKind::Each => FittedGears::Each,
            [one] if !is_of_both(scene) => FittedGears::Alone(one.profile.gear),
            _ => FittedGears::Together,
        };
        let (shift_within_mm, tries_slopes) = (asked.shift_within_mm, asked.tries_slopes);
        Ok(Self { profiles, fit, fitted, shift_within_mm, tries_slopes })
    }

    /// The shift of the profile of `gear` among the unknowns.
    pub(super) fn shift_of(&self, gear: Gear) -> Unknown {
        Unknown::Shift((self.profiles.len() > 1).then_some(gear))
    }

    /// When the last profile was measured, in pinion revolutions.
    pub fn last_revolutions(&self) -> f64 {
        self.profiles.iter().map(|of| of.revolutions).fold(0.0, f64::max)
    }
}

impl ProfileQuestion {
    /// Question about `file`, with the user's options.
    fn new(
        name: &str,
        file: &MeasuredFile,
        asked: &CompareOptions,
        fit: FitKind,
        (folder, resolved, pair): (&RunFolder, &Resolved, &GearPair),
    ) -> Result<Self, QuestionError> {
        let scene = &resolved.scene;
        let gear = match (file.gear, asked.gear) {
            (Some(file), Some(command)) if file != command => {
                return Err(QuestionError::OtherGear { file: file.name(), command: command.name() });
            }
            (file, command) => file.or(command),
        };
        let gear = match file.machine_gear {
            Some(machine) => Some(of_machine(machine, gear, pair)?),
            None => gear,
        };
        let gear = gear.ok_or(QuestionError::NoGear)?;
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
        let (least, needs) = points_needed(fit, asked.shift_within_mm, form);
        if found < least {
            return Err(QuestionError::TooFewPoints { found, least, needs });
        }
        let profile = MeasuredProfile::on_flank(file, pair, gear)?;
        let slices = scene.slices.map_or(1, |settings| Slices::new(pair, settings.count).count());
        let values = (scene.numerics.flank_points + 1) * slices;
        let as_run_um = folder.wear_um(gear, revolutions).filter(|wear| wear.len() == values).map(<[f64]>::to_vec);
        let file_name = Path::new(name).file_name();
        let measured = file_name.map_or_else(|| name.to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self { measured, profile, revolutions, width_mm, uncertainty_um: file.uncertainty_um, form, as_run_um })
    }
}

/// The gear that a machine measured: `asked`, or the one with its number of teeth.
fn of_machine(machine: MachineGear, asked: Option<Gear>, pair: &GearPair) -> Result<Gear, QuestionError> {
    let MachineGear { line, teeth: found, base_radius_mm } = machine;
    let fits = |&gear: &Gear| machine.has_teeth_of(pair, gear);
    let gear = match (asked, &Gear::BOTH.into_iter().filter(fits).collect::<Vec<_>>()[..]) {
        (Some(asked), fitting) if fitting.contains(&asked) => asked,
        (None, &[one]) => one,
        (None, [_, _]) => return Err(QuestionError::NoGear),
        (asked, _) => {
            let of = |gear: Gear| format!("{}, of the {}", pair.spec.gears[gear].teeth, gear.name());
            let allowed = asked.map_or_else(|| Gear::BOTH.map(of).join(", or "), of);
            return Err(QuestionError::OtherTeeth { line, found, allowed });
        }
    };
    if machine.has_size_of(pair, gear) {
        return Ok(gear);
    }
    let allowed = pair.teeth[gear].involute.base_radius_mm;
    Err(QuestionError::OtherGearSize { line, found: base_radius_mm, allowed, gear: gear.name() })
}

/// Whether `fit` can be asked of a profile of `gear`, one of so many.
fn check_fit(fit: FitKind, gear: Gear, profiles: usize, scene: &Scene) -> Result<(), QuestionError> {
    if fit == FitKind::Each && profiles == 1 {
        return Err(QuestionError::OneProfile { missing: gear.mate().name() });
    }
    if fit.severe() && scene.wear[gear].severe.is_none() {
        let allowed = if profiles > 1 { "none, k or each" } else { "none or k" };
        return Err(QuestionError::NoSevereWear { found: fit.name(), allowed });
    }
    if fit.severe() && profiles > 1 && scene.wear.pinion.severe != scene.wear.wheel.severe {
        return Err(QuestionError::TwoKindsOfSevereWear { found: fit.name() });
    }
    if fit.coefficient() && scene.wear[gear].coefficient_mm2_per_n <= 0.0 {
        return Err(QuestionError::DoesNotWear { gear: gear.name() });
    }
    Ok(())
}

/// Multiplies the wear coefficients of `gear` in all phases.
pub(crate) fn scale_coefficients(scene: &mut Scene, gear: Gear, factor: f64) {
    scene.wear[gear].coefficient_mm2_per_n *= factor;
    for phase in &mut scene.operation.phases {
        let own = &mut phase.coefficient_mm2_per_n[gear];
        *own = own.map(|own| own * factor);
    }
}

/// Whether both gears wear by one law in all phases.
pub(crate) fn is_of_both(scene: &Scene) -> bool {
    scene.operation.phases.iter().all(|phase| scene.wear_in(phase).are_alike())
}

/// When the profile was measured, in pinion revolutions, of a run that ended after `end` of them.
fn revolutions(file: &MeasuredFile, end: f64, resolved: &Resolved) -> Result<f64, QuestionError> {
    let operation = &resolved.scene.operation;
    let line = file.moment_line;
    let (revolutions, key, found, shown_end) = match file.moment {
        Moment::End => return Ok(end),
        Moment::Revolutions(given) => (given, "revolutions", given, end),
        Moment::Hours(hours) => {
            let both = operation.revolutions_after(hours).zip(operation.hours(end));
            let (at, end_hours) = both.ok_or(QuestionError::NoSpeed { line, hours })?;
            (at, "hours", hours, end_hours)
        }
    };
    if revolutions > end * (1.0 + SAME_TIME) {
        return Err(QuestionError::Time { line, key, found, end: shown_end });
    }
    Ok(revolutions.min(end))
}

/// How many points it takes, and what for.
fn points_needed(fit: FitKind, shift_within_mm: f64, form: Form) -> (usize, String) {
    let values = [
        (form.parameters(), format!("a form ({})", form.name())),
        (usize::from(fit.coefficient()), "the wear coefficient".to_owned()),
        (usize::from(fit.severe()), "the severe factor".to_owned()),
        (usize::from(shift_within_mm > 0.0), "a shift".to_owned()),
    ];
    let least = values.iter().map(|(count, _)| count).sum::<usize>() + SPARE_POINTS;
    let needs: Vec<String> =
        values.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} of {what}")).collect();
    let needs = if needs.is_empty() { "a difference".to_owned() } else { needs.join(", ") };
    (least, format!("{needs}, and {SPARE_POINTS} to spare"))
}
