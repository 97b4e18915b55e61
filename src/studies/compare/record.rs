//! What a comparison of a measured profile with a run leaves behind, as plain data: what its reports read.

use schemars::JsonSchema;
use serde::Serialize;

use crate::gear::Gear;
use crate::measurement::fit::FitStop;
use crate::results::run::PathPoints;

/// A finished comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct CompareRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene of the run.
    pub scene_hash: String,
    pub measured: String,
    pub gear: Gear,
    /// Where over the face width; `None` where all sections are alike.
    pub width_mm: Option<f64>,
    /// When it was measured; `None` where the scene gives no speed.
    pub hours: Option<f64>,
    /// The same in pinion revolutions.
    pub revolutions: f64,
    /// What was taken for the form: `cubic`, `involute`, `none`.
    pub form: String,
    pub fit: FitRecord,
    pub figures: CompareFigures,
    /// Radii of the points A–E on the gear.
    pub path_point_radius_mm: PathPoints,
    pub warnings: Vec<String>,
    /// The points; in `compare.csv`.
    #[serde(skip)]
    pub rows: Vec<CompareRow>,
    #[serde(skip)]
    pub scene_toml: String,
}

/// A fitted value with its interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Estimate {
    pub value: f64,
    /// Lower end of the 95 % interval; `None` where the residuals give none.
    pub low: Option<f64>,
    pub high: Option<f64>,
    /// The run's own value.
    pub of_run: f64,
}

/// What was fitted, and how.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct FitRecord {
    pub stopped: FitStop,
    /// What is to blame where it did not converge.
    pub blamed: Option<String>,
    /// Factor on the wear coefficients of the scene; `None` where it was not fitted.
    pub coefficient_factor: Option<Estimate>,
    /// The wear coefficient of the scene's law times that factor.
    pub coefficient_m2_per_N: Option<Estimate>,
    /// Factor of severe wear; `None` where it was not fitted.
    pub severe_factor: Option<Estimate>,
    /// Shift of the measured profile towards the tip; `None` where none was allowed.
    pub shift_mm: Option<Estimate>,
    pub points: usize,
    /// Points that count, given the autocorrelation of the residuals; `None` where too few do for an interval.
    pub effective_points: Option<f64>,
    /// Those less the values fitted, form included.
    pub degrees_of_freedom: Option<f64>,
    /// Runs of the scene it took.
    pub runs: u64,
    pub mesh_cycles: u64,
    /// How the interval was obtained, or why there is none.
    pub how: String,
}

/// Figures of the profiles, form removed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct CompareFigures {
    /// Arithmetic mean deviation of the measured profile (of one trace; Sa where it stands for an area).
    pub mean_deviation_um: f64,
    /// That of the simulated profile.
    pub simulated_mean_deviation_um: f64,
    /// Ra of the measured profile after a Gaussian filter; `None` where it is too short or its points too far apart.
    pub roughness_um: Option<f64>,
    /// λc of that filter.
    pub cutoff_mm: f64,
    /// Root mean square of measured less simulated, as the run has it (its place along the flank fitted, where allowed).
    pub as_run_difference_um: f64,
    /// The same after the fit.
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
pub(crate) struct CompareRow {
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
    /// wear depth of the measured profile on the form of the simulation: wear_um less difference_um
    pub measured_wear_um: f64,
}
