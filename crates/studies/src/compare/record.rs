//! Record of a comparison of measured profiles with a run: what its reports read.

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::profile_slope::{FitWithSlopes, ProfileSlope};
use super::unknown::Unknown;
use crate::measurement::deviations::Deviations;
use crate::measurement::fit::FitStop;
use crate::measurement::waviness::Wave;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::PathPoints;

/// A finished comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct CompareRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene of the run.
    pub scene_hash: String,
    pub fit: FitRecord,
    /// The fit with the slopes of `profiles` before wear in the scene, where they differ from the scene's.
    pub with_profile_slopes: Option<FitWithSlopes>,
    /// One, or that of the pinion and that of the wheel.
    pub profiles: Vec<ProfileRecord>,
    pub warnings: Vec<String>,
    pub scene_toml: String,
}

impl CompareRecord {
    /// The run and the measured files.
    pub fn headline(&self) -> String {
        let files: Vec<&str> = self.profiles.iter().map(|of| of.measured.as_str()).collect();
        format!("{} – {}", self.title, files.join(", "))
    }
}

/// A measured profile beside the simulated one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProfileRecord {
    pub measured: String,
    pub gear: Gear,
    /// Where over the face width; `None` where all sections are alike.
    pub width_mm: Option<f64>,
    /// When it was measured; `None` where the scene gives no speed.
    pub hours: Option<f64>,
    /// Time in pinion revolutions.
    pub revolutions: f64,
    /// Form removed: `cubic`, `involute`, `none`.
    pub form: String,
    /// Shift of the measured profile towards the tip; `None` where none was allowed.
    pub shift_mm: Option<FittedValue>,
    pub points: usize,
    /// Points that count, given the autocorrelation of the residuals; `None` where too few do for an interval.
    pub effective_points: Option<f64>,
    /// Independent points less the values fitted, form included.
    pub degrees_of_freedom: Option<f64>,
    pub figures: CompareFigures,
    /// Teeth whose mean the profile is.
    pub teeth: usize,
    /// Waves that are fitted along.
    pub waves: Vec<Wave>,
    /// Deviations after ISO 1328-1; `None` where the heights are not from the involute.
    pub deviations: Option<ProfileDeviations>,
    /// f_Hα before wear; `None` where it cannot be told.
    pub profile_slope: Option<ProfileSlope>,
    /// Those of the leads of the same flanks.
    pub leads: Vec<LeadDeviations>,
    /// Radii of the points A–E on the gear.
    pub path_point_radius_mm: PathPoints,
    /// The points; in `compare.csv`.
    #[serde(skip)]
    pub rows: Vec<CompareRow>,
}

/// Deviations of a profile after ISO 1328-1; `None` each where the evaluation range is not covered.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProfileDeviations {
    /// Of the profile as measured.
    pub measured: Option<Deviations>,
    /// Of the profile as measured, with the simulated wear after the fit put back: before wear, beside the scene's flank with its modifications.
    pub before_wear: Option<Deviations>,
    /// Of the simulated wear alone, after the fit.
    pub wear: Option<Deviations>,
}

/// Deviations of a lead after ISO 1328-1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LeadDeviations {
    pub tooth: Option<u32>,
    pub measured: Option<Deviations>,
}

/// A fitted value with its interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FittedValue {
    pub value: f64,
    /// Lower end of the 95 % interval; `None` where the residuals give none.
    pub low: Option<f64>,
    pub high: Option<f64>,
    /// The run's own value.
    pub of_run: f64,
}

/// A fitted wear coefficient.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coefficient {
    /// Whose it is; `None`: one law, which both gears wear by.
    pub gear: Option<Gear>,
    /// Factor on the wear coefficients of the scene.
    pub factor: FittedValue,
    /// The wear coefficient of the scene's law times that factor.
    pub coefficient_m2_per_N: FittedValue,
}

/// Correlation coefficients of the fitted values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoefficientCorrelation {
    /// Of the logarithms of coefficients and factors, and of shifts.
    pub parameters: Vec<Unknown>,
    /// Row by row.
    pub matrix: Vec<Vec<f64>>,
}

/// Fitted coefficients, and how they were found.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRecord {
    pub stopped: FitStop,
    /// Coefficient that kept the search from converging.
    pub blamed: Option<Unknown>,
    /// Of each gear that has its own; empty where none was fitted.
    pub coefficients: Vec<Coefficient>,
    /// The coefficient of the pinion over that of the wheel, where each was fitted.
    pub coefficient_ratio: Option<FittedValue>,
    /// Factor of severe wear; `None` where it was not fitted.
    pub severe_factor: Option<FittedValue>,
    /// `None` where there is no interval, or less than two values were fitted.
    pub correlation: Option<CoefficientCorrelation>,
    /// Runs of the scene it took.
    pub runs: u64,
    pub mesh_cycles: u64,
    /// How the interval was obtained, or why there is none.
    pub how: String,
}

impl FitRecord {
    /// Whether there is another simulated profile beside that of the run as it is.
    pub fn is_of_wear(&self) -> bool {
        !self.coefficients.is_empty() || self.severe_factor.is_some()
    }

    /// The correlation coefficient of the wear coefficients of both gears, where each was fitted.
    pub fn coefficient_correlation(&self) -> Option<f64> {
        let CoefficientCorrelation { parameters, matrix } = self.correlation.as_ref()?;
        let [pinion, wheel] =
            Gear::BOTH.map(|gear| parameters.iter().position(|&own| own == Unknown::Coefficient(Some(gear))));
        Some(matrix[pinion?][wheel?])
    }
}

/// Figures of the profiles, form removed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CompareFigures {
    /// Arithmetic mean deviation of the measured profile (of one trace; Sa where it stands for an area).
    pub mean_deviation_um: f64,
    /// Mean deviation of the simulated profile.
    pub simulated_mean_deviation_um: f64,
    /// Ra of the measured profile after a Gaussian filter; `None` where it is too short or its points too far apart.
    pub roughness_um: Option<f64>,
    /// λc of that filter.
    pub cutoff_mm: f64,
    /// Root mean square of measured less simulated, as the run has it (its place along the flank fitted, where allowed).
    pub as_run_difference_um: f64,
    /// Difference after the fit.
    pub difference_um: f64,
    /// Greatest absolute difference after the fit.
    pub greatest_difference_um: f64,
    /// Radius where it is.
    pub greatest_difference_radius_mm: f64,
    /// Standard deviation of a height, as the file says.
    pub uncertainty_um: Option<f64>,
}

/// A row of `compare.csv`: a measured point where it lies on the flank.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct CompareRow {
    /// distance from the gear's axis, shifted as fitted
    pub radius_mm: f64,
    /// length along the flank from the base circle, shifted as fitted
    pub arc_mm: f64,
    /// measured height, form removed
    pub measured_um: f64,
    /// simulated height after the fit, form removed in the same way
    pub simulated_um: f64,
    /// measured less simulated
    pub difference_um: f64,
    /// simulated height of the run as it is, form removed in the same way
    pub as_run_um: f64,
    /// simulated wear depth after the fit
    pub wear_um: f64,
    /// wear depth of the measured profile on the form of the simulation: wear_um less difference_um, normal to the flank
    pub measured_wear_um: f64,
    /// whose flank it is on
    pub gear: Gear,
}

/// Serialised as in `compare.json`: the first profile at the top, and all of them in `profiles`.
impl Serialize for CompareRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            title: &'a str,
            program_version: &'a str,
            scene_hash: &'a str,
            measured: &'a str,
            gear: Gear,
            width_mm: Option<f64>,
            hours: Option<f64>,
            revolutions: f64,
            form: &'a str,
            fit: WrittenFit<'a>,
            figures: &'a CompareFigures,
            path_point_radius_mm: PathPoints,
            warnings: &'a [String],
            profiles: &'a [ProfileRecord],
            with_profile_slopes: Option<&'a FitWithSlopes>,
        }
        let first = &self.profiles[0];
        Written {
            title: &self.title,
            program_version: &self.program_version,
            scene_hash: &self.scene_hash,
            measured: &first.measured,
            gear: first.gear,
            width_mm: first.width_mm,
            hours: first.hours,
            revolutions: first.revolutions,
            form: &first.form,
            fit: WrittenFit::new(&self.fit, &self.profiles),
            figures: &first.figures,
            path_point_radius_mm: first.path_point_radius_mm,
            warnings: &self.warnings,
            profiles: &self.profiles,
            with_profile_slopes: self.with_profile_slopes.as_ref(),
        }
        .serialize(serializer)
    }
}

/// The fit as `compare.json` has it; points and degrees of freedom are those of all profiles.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Serialize)]
struct WrittenFit<'a> {
    stopped: FitStop,
    blamed: Option<String>,
    coefficient_factor: Option<FittedValue>,
    coefficient_m2_per_N: Option<FittedValue>,
    severe_factor: Option<FittedValue>,
    shift_mm: Option<FittedValue>,
    points: usize,
    effective_points: Option<f64>,
    degrees_of_freedom: Option<f64>,
    runs: u64,
    mesh_cycles: u64,
    how: &'a str,
    coefficients: &'a [Coefficient],
    coefficient_ratio: Option<FittedValue>,
    correlation: Option<&'a CoefficientCorrelation>,
}

impl<'a> WrittenFit<'a> {
    fn new(fit: &'a FitRecord, profiles: &[ProfileRecord]) -> Self {
        let first = fit.coefficients.first();
        Self {
            stopped: fit.stopped,
            blamed: fit.blamed.map(Unknown::name),
            coefficient_factor: first.map(|of| of.factor),
            coefficient_m2_per_N: first.map(|of| of.coefficient_m2_per_N),
            severe_factor: fit.severe_factor,
            shift_mm: profiles.first().and_then(|of| of.shift_mm),
            points: profiles.iter().map(|of| of.points).sum(),
            effective_points: profiles.iter().map(|of| of.effective_points).sum(),
            degrees_of_freedom: profiles.iter().map(|of| of.degrees_of_freedom).sum(),
            runs: fit.runs,
            mesh_cycles: fit.mesh_cycles,
            how: &fit.how,
            coefficients: &fit.coefficients,
            coefficient_ratio: fit.coefficient_ratio,
            correlation: fit.correlation.as_ref(),
        }
    }
}
