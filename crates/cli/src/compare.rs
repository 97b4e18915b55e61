//! `gearwear compare`: measured flank profiles against a finished run, or runs side by side ([`super::variants`]).

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::builder::PossibleValuesParser;
use gearwear::measured_flank::file::FlankSide;
use gearwear::measured_flank::teeth::{ChosenBy, TraceChoice};
use gearwear::report;
use gearwear::scene::loaded::SceneText;
use gearwear_bodies::gear::Gear;
use gearwear_physics::assessment::RunError;
use gearwear_studies::compare::asked::{CompareFault, PreparedComparison};
use gearwear_studies::compare::in_words::INTERVAL;
use gearwear_studies::compare::question::{CompareOptions, FitKind};
use gearwear_studies::compare::record::{
    CoefficientCorrelation, CompareFigures, CompareRecord, FittedValue, ProfileRecord,
};
use gearwear_studies::compare::study::CompareError;
use gearwear_studies::compare::unknown::Unknown;
use gearwear_studies::measurement::fit::FitStop;
use gearwear_studies::measurement::form::Form;
use gearwear_studies::remaining_life::asked::LifeOptions;
use gearwear_studies::remaining_life::limit::WearLimit;
use gearwear_studies::remaining_life::other_gear::OtherCoefficient;
use gearwear_studies::remaining_life::regime::CoefficientPrior;

use super::failure::{Failure, InputError};
use super::figures::{digits, or_dash};
use super::progress::Progress;
use super::remaining_life::{self, LifeQuestion};
use super::run::{pool, watch_for_interrupt};
use super::variants::{self, MOST_RUNS, Variants, is_run};
use super::{print, say, warn};

/// Longest shift along the flank, where nothing else is asked, mm.
const SHIFT_WITHIN_MM: f64 = 0.1;

/// Description of a measured file.
const FILE_HELP: &str = "\
The measured file is a table, or the text export of curves (.mka) of a P40 gear measuring machine. In a table, lines that begin with # come
first and say what is measured:
  # gear = pinion                        or wheel
  # hours = 31.75                        or revolutions (of the pinion); left out: the end of the run
  # width_mm = 7.0                       place over the face width; only for runs with slices
  # uncertainty_um = 0.3                 of a height, one standard deviation
  # arc_from = start-of-active-profile   with arc_mm: or base-circle, or tip (towards the root)
  # height_from = involute               or line: heights of a stylus, with the curvature of the tooth
Then column names with units, in any order: radius_mm, diameter_mm, roll_length_mm, roll_angle_deg or arc_mm, and
height_um or height_mm (falls where material is gone) or wear_um or wear_mm (rises there); then a row for each point,
from root to tip. Columns are apart by ; tabs or commas, and may have German names: Wälzlänge [mm];Höhe [µm]. The
columns tooth and flank (left, right) make a file of several teeth, whose mean is compared.";

#[derive(Debug, clap::Args)]
#[command(after_help = FILE_HELP)]
pub(super) struct CompareArgs {
    /// The folder of a finished `gearwear run`; beside other runs a scene too, which is run first
    run: PathBuf,
    /// The measured profile, a table or .mka file (- reads standard input), or two, of pinion and wheel; or one to five more runs, to be
    /// shown side by side
    #[arg(value_name = "MEASURED|RUN", required_unless_present = "history", num_args = 1..MOST_RUNS)]
    with: Vec<PathBuf>,
    /// A table of wear measured at several times, for wear coefficient and remaining life after each: columns hours or
    /// revolutions (of the pinion), one of mass_loss_g, depth_um and profile (a file) in each row; gear, tooth, sigma
    #[arg(long, value_name = "TABLE", conflicts_with_all = ["with", "fit"])]
    history: Option<PathBuf>,
    /// With --history: wear that ends the life, such as pinion.peak_wear_um=50 or wheel.worn_mass_mg=1200; again for the other
    /// gear; default: operation.stop of the scene
    #[arg(long, value_name = "FIGURE=VALUE", requires = "history")]
    limit: Vec<WearLimit>,
    /// With --history: what is known of k before any measurement, mild, regime-1, regime-2, regime-3, plastic, dry, or its
    /// 95 % interval LOW:HIGH in m²/N; default: 100 times less to 100 times more than in the run
    #[arg(long, value_name = "REGIME", requires = "history")]
    prior: Option<CoefficientPrior>,
    /// With --history: k of the gear that the table does not have, a number in m²/N or the folder of a comparison with RUN that
    /// fitted it (RUN/compare/…); default: the k of the measured gear where the scene has one law for both, else that of the scene
    #[arg(long, value_name = "K|DIR", requires = "history")]
    other_k: Option<OtherCoefficient>,
    /// The gear that was measured, where the file does not say
    #[arg(long, value_name = "GEAR", value_parser = gear)]
    gear: Option<Gear>,
    /// The form removed from the measured and the simulated profile alike; default: cubic of heights, none of
    /// wear depths. With a form no slope counts as wear; what the flank had before wear is told beside the scene's flank, modifications
    /// and profile_slope_deviation_um in it
    #[arg(long, value_enum)]
    form: Option<Form>,
    /// Coefficients to fit; default: k, and each with two profiles
    #[arg(long, value_enum)]
    fit: Option<FitKind>,
    /// How far a profile may be shifted along the flank to where it fits best; 0: not at all
    #[arg(long, value_name = "MM", default_value_t = SHIFT_WITHIN_MM, value_parser = length)]
    shift_within: f64,
    /// The tooth to take of a file with several; default: the mean of all
    #[arg(long, value_name = "N")]
    tooth: Option<u32>,
    /// The flank to take of a file with both
    #[arg(long, value_name = "SIDE", value_parser = PossibleValuesParser::new(FlankSide::BOTH.map(FlankSide::name)))]
    flank: Option<String>,
    /// The place over the face width whose profile is taken of a file with several: the nearest
    #[arg(long, value_name = "MM", value_parser = length)]
    width: Option<f64>,
    /// The folder for the results; default: compare/NAME in RUN, with the names of the measured files or of the second run
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn gear(text: &str) -> Result<Gear, String> {
    let named = Gear::BOTH.into_iter().find(|gear| gear.name() == text);
    named.ok_or_else(|| "allowed: pinion or wheel".to_owned())
}

pub(super) fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("allowed: a length in mm, 0 or more".to_owned()),
    }
}

impl CompareArgs {
    /// The runs to be shown side by side; none where there are measured profiles.
    fn variants(&self) -> Result<Option<Variants<'_>>, InputError> {
        let Some(path) = self.with.iter().find(|path| !is_run(path)) else {
            let runs: Vec<&Path> = [&self.run].into_iter().chain(&self.with).map(PathBuf::as_path).collect();
            return Ok(Some(Variants { runs, out: self.out.as_deref(), threads: self.threads, quiet: self.quiet }));
        };
        match self.with.iter().any(|path| is_run(path)) {
            true => Err(InputError::ProfileBesideRuns { path: path.clone() }),
            false => Ok(None),
        }
    }

    /// Question about a table of measurements.
    fn life_question<'a>(&'a self, table: &'a Path, out: &'a Path) -> LifeQuestion<'a> {
        let options = LifeOptions {
            gear: self.gear,
            prior: self.prior.clone(),
            limits: self.limit.clone(),
            form: self.form,
            shift_within_mm: self.shift_within,
            traces: self.traces(),
            other_k: self.other_k.clone(),
        };
        LifeQuestion { run: &self.run, table, options, out, threads: self.threads, quiet: self.quiet }
    }

    /// Traces of a file with several.
    fn traces(&self) -> TraceChoice {
        let side = self.flank.as_deref().and_then(FlankSide::named);
        TraceChoice { tooth: self.tooth, side, width_mm: self.width, by: ChosenBy::Options }
    }

    /// Where the results go.
    fn out(&self) -> PathBuf {
        if let Some(out) = &self.out {
            return out.clone();
        }
        let stems = self.with.iter().chain(&self.history).map(|path| {
            let stem = path.file_stem().filter(|stem| *stem != "-").unwrap_or("measured".as_ref());
            stem.to_string_lossy().into_owned()
        });
        self.run.join("compare").join(stems.collect::<Vec<_>>().join("-"))
    }
}

pub(super) fn run(args: &CompareArgs) -> Result<(), Failure> {
    if let Some(table) = &args.history {
        return remaining_life::run(&args.life_question(table, &args.out()));
    }
    if let Some(variants) = args.variants()? {
        let given = [
            ("--gear", args.gear.is_some()),
            ("--form", args.form.is_some()),
            ("--tooth", args.tooth.is_some()),
            ("--flank", args.flank.is_some()),
            ("--width", args.width.is_some()),
        ];
        return match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((option, _)) => Err(InputError::OnlyForMeasured { option }.into()),
            None => variants::run(&variants),
        };
    }
    let texts = args.with.iter().map(|path| SceneText::read_foreign(path)).collect::<Result<Vec<_>, _>>()?;
    let asked = CompareOptions {
        gear: args.gear,
        form: args.form,
        fit: args.fit,
        shift_within_mm: args.shift_within,
        traces: args.traces(),
        tries_slopes: true,
    };
    let prepared = PreparedComparison::open(&args.run, &texts, &asked)?;
    let out = args.out();
    report::writable(&out)?;

    let pool = pool(args.threads)?;
    let progress = Progress::new(args.quiet, Arc::clone(&watch_for_interrupt()));
    let done = pool.install(|| prepared.carry_out(&progress));
    progress.finish();
    let record = done.map_err(|error| match error {
        CompareError::Interrupted => {
            say("interrupted before the comparison was finished");
            Failure::Interrupted
        }
        CompareError::Run(error) => Failure::Run(error),
    })?;
    gearwear_studies::compare::report::write(&record, &out)?;
    if !args.quiet {
        let report = out.join(output_files::PAGE);
        print(&format!("{}report: {}\n", table(&record), report.display()))?;
    }
    if record.fit.stopped == FitStop::Converged {
        warn(&record.warnings);
        return Ok(());
    }
    let why = format!("{}; what was compared is kept in {}", record.warnings.join("; "), out.display());
    Err(Failure::NotFitted { why })
}

impl From<CompareFault> for Failure {
    fn from(fault: CompareFault) -> Self {
        match fault {
            CompareFault::Load(error) => error.into(),
            CompareFault::RunFolder(error) => InputError::RunFolder(error).into(),
            CompareFault::Measured(refused) => InputError::Measured(refused).into(),
            CompareFault::Pair(error) => Failure::Run(RunError::from(error)),
        }
    }
}

/// One of the figures of a profile, where it has it.
type Figure = fn(&CompareFigures) -> Option<f64>;

fn line(name: &str, cells: &[String]) -> String {
    let cells: String = cells.iter().map(|cell| format!("{cell:>12}")).collect();
    format!("  {name:44}{cells}\n")
}

/// Fitted values with their names.
fn estimates(record: &CompareRecord) -> Vec<(String, &FittedValue)> {
    let (fit, several) = (&record.fit, record.profiles.len() > 1);
    let mut estimates: Vec<(String, &FittedValue)> = Vec::new();
    for own in &fit.coefficients {
        let whose = own.gear.filter(|_| several).map_or_else(String::new, |gear| format!(" of the {}", gear.name()));
        estimates.push((format!("wear coefficient k{whose}, m²/N"), &own.coefficient_m2_per_N));
    }
    estimates
        .extend(fit.coefficient_ratio.iter().map(|ratio| ("k of the pinion over that of the wheel".to_owned(), ratio)));
    estimates.extend(fit.severe_factor.iter().map(|severe| ("factor of severe wear".to_owned(), severe)));
    for of in &record.profiles {
        let whose = if several { format!(" of the {}", of.gear.name()) } else { String::new() };
        estimates.extend(of.shift_mm.iter().map(|shift| (format!("shift{whose} towards the tip, mm"), shift)));
    }
    estimates
}

/// Findings for the terminal.
fn table(record: &CompareRecord) -> String {
    let (fit, profiles) = (&record.fit, &record.profiles);
    let several = profiles.len() > 1;
    let estimates = estimates(record);
    let mut text = format!("{}\n\n", record.headline());
    if !estimates.is_empty() {
        text.push_str(&line("", &["run", "fitted", "95 % from", "to"].map(str::to_owned)));
    }
    for (name, e) in estimates {
        text.push_str(&line(&name, &[digits(e.of_run), digits(e.value), or_dash(e.low), or_dash(e.high)]));
    }
    if let Some(correlation) = &fit.correlation {
        text.push_str(&correlations(correlation));
    }
    text.push_str(&format!("\n  {}\n", fit.how));
    if fit.coefficients.iter().any(|own| own.factor.low.is_some()) {
        text.push_str(&format!("  {INTERVAL}\n"));
    }
    text.push('\n');
    if several {
        text.push_str(&line("", &profiles.iter().map(|of| of.gear.name().to_owned()).collect::<Vec<_>>()));
    }
    let figures: [(&str, Figure); 5] = [
        ("arithmetic mean deviation, measured, µm", |f| Some(f.mean_deviation_um)),
        ("  the same, simulated", |f| Some(f.simulated_mean_deviation_um)),
        ("Ra, cutoff 0.8 mm, measured, µm", |f| f.roughness_um),
        ("difference as run, root mean square, µm", |f| Some(f.as_run_difference_um)),
        ("  after the fit", |f| Some(f.difference_um)),
    ];
    for (name, value) in figures {
        text.push_str(&line(name, &profiles.iter().map(|of| or_dash(value(&of.figures))).collect::<Vec<_>>()));
    }
    text.push_str(&deviations(profiles));
    text.push_str(&slopes(record));
    let runs = if fit.runs == 1 { "run" } else { "runs" };
    let mut forms: Vec<&str> = profiles.iter().map(|of| of.form.as_str()).collect();
    forms.dedup();
    let with_slopes = record.with_profile_slopes.as_ref();
    let more = with_slopes.map_or_else(String::new, |with| format!(", {} more with the profile slope", with.runs));
    text.push_str(&format!(
        "\nform {}, {} {runs} of the scene ({} mesh cycles){more}\n",
        forms.join(" and "),
        fit.runs,
        fit.mesh_cycles
    ));
    text
}

/// One of the deviations of a profile, where it has it.
type Deviation = fn(&ProfileRecord) -> Option<f64>;

/// Deviations of the profiles after ISO 1328-1, as measured and before wear.
fn deviations(profiles: &[ProfileRecord]) -> String {
    let rows: [(&str, Deviation); 9] = [
        ("as measured, total deviation F_α", |of| Some(of.deviations?.measured?.total_um)),
        ("  form deviation f_fα", |of| Some(of.deviations?.measured?.form_um)),
        ("  slope deviation f_Hα", |of| Some(of.deviations?.measured?.slope_um)),
        ("before wear, beside the scene’s flank, F_α", |of| Some(of.deviations?.before_wear?.total_um)),
        ("  form deviation f_fα", |of| Some(of.deviations?.before_wear?.form_um)),
        ("  slope deviation f_Hα", |of| Some(of.deviations?.before_wear?.slope_um)),
        ("f_Hα before wear, that of the scene in it", |of| Some(of.profile_slope.as_ref()?.before_wear_um.value)),
        ("  95 % from", |of| of.profile_slope.as_ref()?.before_wear_um.low),
        ("  to", |of| of.profile_slope.as_ref()?.before_wear_um.high),
    ];
    let known = rows.into_iter().filter(|(_, value)| profiles.iter().any(|of| value(of).is_some()));
    let rows: String = known
        .map(|(name, value)| {
            let cells = profiles.iter().map(|of| value(of).map_or_else(|| "–".to_owned(), |um| format!("{um:.2}")));
            line(name, &cells.collect::<Vec<_>>())
        })
        .collect();
    if rows.is_empty() { rows } else { format!("\n  deviations after ISO 1328-1, µm\n{rows}") }
}

/// What was done with the slope of the profiles, and what to set.
fn slopes(record: &CompareRecord) -> String {
    let Some(finding) = record.slope_finding() else { return String::new() };
    let sentences = finding.sentences.iter().map(|sentence| format!("  {sentence}\n"));
    let keys = finding.keys.iter().map(|key| format!("    {key}\n"));
    let moved = finding.moved.iter().map(|sentence| format!("  {sentence}\n"));
    ["\n".to_owned()].into_iter().chain(sentences).chain(keys).chain(moved).collect()
}

/// Least correlation coefficient that the terminal shows; `compare.json` and the page have all.
const SHOWN_CORRELATION: f64 = 0.3;

/// The correlation coefficient of each pair of fitted values that is of the coefficients or matters, a line for each.
fn correlations(correlation: &CoefficientCorrelation) -> String {
    let (parameters, matrix) = (&correlation.parameters, &correlation.matrix);
    let mut text = String::new();
    for i in 0..parameters.len() {
        for j in i + 1..parameters.len() {
            let is_of_shift = [i, j].into_iter().any(|index| matches!(parameters[index], Unknown::Shift(_)));
            if is_of_shift && matrix[i][j].abs() < SHOWN_CORRELATION {
                continue;
            }
            let pair = format!("{} and {}", parameters[i].key(), parameters[j].key());
            text.push_str(&format!("  {:44}{:>12.3}\n", format!("correlation of {pair}"), matrix[i][j]));
        }
    }
    text
}
