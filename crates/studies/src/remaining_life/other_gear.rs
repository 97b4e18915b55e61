//! Wear coefficient of the gear that a table does not have: its wear shares the load, so that the life of the measured gear depends on it.

use std::convert::Infallible;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::Serialize;
use serde_json::Value;

use gearwear_bodies::gear::Gear;
use gearwear_files::size_limit::SizeLimit;

/// File of a comparison that has its coefficients.
const COMPARISON: &str = "compare.json";
/// Folder of a run's comparisons.
const COMPARISONS: &str = "compare";
const COMPARISON_SIZE: SizeLimit = SizeLimit { of: "a comparison", megabytes: 256 };

/// Coefficient as it is asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum OtherCoefficient {
    /// m²/N.
    Given(f64),
    /// Folder of a comparison of profiles with the same run, which fitted it.
    Comparison(PathBuf),
}

impl FromStr for OtherCoefficient {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self::named(text))
    }
}

/// Faults of such a coefficient.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OtherCoefficientError {
    #[error("--other-k: found {found}; allowed: a number above 0, in m²/N, or the folder of a comparison")]
    NotPositive { found: f64 },
    #[error(
        "--other-k: found it beside measurements of both gears; allowed: for the gear that the table does not have"
    )]
    BothMeasured,
    #[error(
        "--other-k: found it, but the wear coefficient of the {gear} is 0 in the run; allowed: for a gear that wears"
    )]
    DoesNotWear { gear: &'static str },
    #[error("--other-k: {}: {found}; allowed: the folder of a gearwear compare RUN PROFILE …", path.display())]
    NoComparison { path: PathBuf, found: String },
    #[error("--other-k: {}: found a comparison with the scene {found}; allowed: {allowed}, that of the run", path.display())]
    OtherScene { path: PathBuf, found: String, allowed: String },
    #[error("--other-k: {}: found no fitted k of the {gear}; allowed: a comparison that has its profile and converged", path.display())]
    NotFitted { path: PathBuf, gear: &'static str },
}

/// Where the coefficient of a gear comes from that was not measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CoefficientSource {
    /// `--other-k`.
    Given,
    /// The law of both gears: as the measured one's.
    MeasuredGear,
    /// The scene of the run.
    Run,
}

/// Gear that was not measured.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OtherGear {
    pub gear: Gear,
    pub coefficient_m2_per_N: f64,
    pub source: CoefficientSource,
}

impl OtherCoefficient {
    /// A number is a coefficient, anything else a folder.
    pub fn named(text: &str) -> Self {
        text.parse().map_or_else(|_| Self::Comparison(text.into()), Self::Given)
    }

    /// The coefficient of `gear`, m²/N, for a run of the scene with this hash.
    ///
    /// # Errors
    /// A comparison that has none.
    pub(super) fn of(&self, gear: Gear, scene_hash: &str) -> Result<f64, OtherCoefficientError> {
        let folder = match self {
            Self::Given(found) if *found > 0.0 && found.is_finite() => return Ok(*found),
            Self::Given(found) => return Err(OtherCoefficientError::NotPositive { found: *found }),
            Self::Comparison(folder) => folder,
        };
        let path = folder.join(COMPARISON);
        let none = |found: String| OtherCoefficientError::NoComparison { path: path.clone(), found };
        let text = COMPARISON_SIZE.read_to_string(&path).map_err(|error| none(format!("cannot be read: {error}")))?;
        let record: Value = serde_json::from_str(&text).map_err(|error| none(error.to_string()))?;
        let found = record["scene_hash"].as_str().unwrap_or_default();
        if found != scene_hash {
            let (found, allowed) = (found.to_owned(), scene_hash.to_owned());
            return Err(OtherCoefficientError::OtherScene { path, found, allowed });
        }
        let fit = &record["fit"];
        let own = fit["coefficients"].as_array().and_then(|all| all.iter().find(|own| own["gear"] == gear.name()));
        let k =
            own.filter(|_| fit["stopped"] == "converged").and_then(|own| own["coefficient_m2_per_N"]["value"].as_f64());
        k.filter(|k| *k > 0.0).ok_or(OtherCoefficientError::NotFitted { path, gear: gear.name() })
    }
}

/// Folders of comparisons in that of the `run` of a scene with this hash that fitted the coefficient of `gear`, by their names.
pub fn comparisons_in(run: &Path, gear: Gear, scene_hash: &str) -> Vec<PathBuf> {
    let folders = fs::read_dir(run.join(COMPARISONS)).into_iter().flatten().filter_map(Result::ok);
    let mut fitted: Vec<PathBuf> = folders
        .map(|entry| entry.path())
        .filter(|folder| OtherCoefficient::Comparison(folder.clone()).of(gear, scene_hash).is_ok())
        .collect();
    fitted.sort();
    fitted
}

impl OtherGear {
    /// Sentence on it, with what changes it.
    pub fn in_words(&self, k: &str) -> String {
        let (gear, mate) = (self.gear.name(), self.gear.mate().name());
        let how = "--other-k takes another one, a number or the folder of a comparison that fitted it";
        match self.source {
            CoefficientSource::Given => {
                format!("The {gear}, not measured, wears with k = {k} m²/N, as --other-k says.")
            }
            CoefficientSource::MeasuredGear => format!(
                "The {gear}, not measured, wears with the k of the {mate}, {k} m²/N, since the scene has one law for both; {how}."
            ),
            CoefficientSource::Run => format!(
                "The {gear}, not measured, wears with the run’s k, {k} m²/N (wear.{gear}.coefficient_m2_per_N of the scene); {how}."
            ),
        }
    }
}
