//! Record of wear coefficient and remaining life: `remaining_life.json`, and the source of the other files.

use schemars::JsonSchema;
use serde::Serialize;

use super::limit::WearLimit;
use super::other_gear::OtherGear;
use super::regime::CoefficientPrior;
use super::wear_curve::WearQuantity;
use super::wear_table::WearKind;
use gearwear_bodies::gear::Gear;

/// What the measurements of a table say.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LifeRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene of the run.
    pub scene_hash: String,
    /// Name of the table.
    pub measured: String,
    /// Each measured gear.
    pub gears: Vec<GearLife>,
    /// Gear that was not measured.
    pub other_gear: Option<OtherGear>,
    /// Runs of the scene that it took.
    pub runs: u64,
    pub mesh_cycles: u64,
    pub warnings: Vec<String>,
    #[serde(skip)]
    pub scene_toml: String,
}

/// What is known of a gear.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearLife {
    pub gear: Gear,
    pub coefficient_of_run_m2_per_N: f64,
    /// Of the coefficient, before any measurement.
    pub prior: CoefficientPrior,
    /// Limit that is reached first; null where none is given.
    pub limit: Option<WearLimit>,
    /// In the order of their times.
    pub measurements: Vec<MeasurementRecord>,
    /// Before any measurement, and after each.
    pub updates: Vec<LifeUpdate>,
    /// Quantity of the band.
    #[serde(skip)]
    pub shown: WearQuantity,
    /// Wear after the last measurement.
    #[serde(skip)]
    pub band: Vec<BandPoint>,
    /// Simulated wear with the median coefficient up to the last measurement: revolutions and wear.
    #[serde(skip)]
    pub simulated: Vec<(f64, Option<f64>)>,
}

/// A measurement: the mean of its teeth, or repetitions.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasurementRecord {
    /// Lines of the table.
    pub lines: Vec<usize>,
    pub hours: Option<f64>,
    /// Of the pinion.
    pub revolutions: f64,
    pub kind: WearKind,
    /// mg of a mass, µm of a depth; of a profile the maximum depth of the fitted wear, µm.
    pub value: f64,
    /// Known standard deviation of the value after all measurements: as given, and the scatter of the teeth; 0 where nothing is known.
    pub sigma: f64,
    /// Number of teeth or repetitions.
    pub count: usize,
    /// Mean wear coefficient from the beginning up to this measurement.
    pub mean_coefficient_m2_per_N: f64,
    /// The value in the quantity of the plot.
    #[serde(skip)]
    pub shown: Option<f64>,
}

/// Median and ends of the 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    pub median: f64,
    pub low: f64,
    pub high: f64,
}

/// What is known after some measurements.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LifeUpdate {
    /// Number of measurements; 0: before any.
    pub measurements: usize,
    /// Time of the last of them.
    pub hours: Option<f64>,
    pub revolutions: f64,
    pub coefficient_m2_per_N: Interval,
    /// Ends of the 50 % interval.
    pub coefficient_quartiles_m2_per_N: [f64; 2],
    /// Median relative standard deviation of the wear after the revolutions of the run, beside its mean: c.
    pub wander: f64,
    /// Median relative standard deviation of a measurement, beside what is known of it: r.
    pub scatter: f64,
    /// Null where no limit is given.
    pub life: Option<RemainingLife>,
    /// Of the measurements after these.
    pub later: Vec<Prediction>,
}

/// How long the wear stays below the limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RemainingLife {
    /// Probability that the limit has been passed.
    pub passed: f64,
    /// From the last measurement, in revolutions of the pinion; 0 where the limit has been passed.
    pub remaining_revolutions: Interval,
    /// Null where the scene gives no speed.
    pub remaining_hours: Option<Interval>,
    /// From the beginning; where the limit has been passed, up to the last measurement.
    pub total_revolutions: Interval,
    pub total_hours: Option<Interval>,
}

/// A later measurement as it is expected, in the unit of its value; null where the run does not come to such wear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Prediction {
    /// Number of the measurement, from 1.
    pub measurement: usize,
    pub median: Option<f64>,
    pub low: Option<f64>,
    pub high: Option<f64>,
    /// Probability of a value up to the one that was found.
    pub below_found: f64,
}

/// Wear at some revolutions; none where the run does not come to such wear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandPoint {
    pub revolutions: f64,
    pub low: Option<f64>,
    pub median: Option<f64>,
    pub high: Option<f64>,
}

/// A row of `remaining_life.csv`.
#[allow(non_snake_case, reason = "names that end in their unit")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LifeRow {
    /// pinion or wheel
    pub gear: Gear,
    /// number of measurements; 0: before any
    pub measurements: usize,
    /// time of the last of them; empty where the scene gives no speed
    pub hours: Option<f64>,
    /// of the pinion
    pub revolutions: f64,
    /// wear coefficient, median
    pub coefficient_m2_per_N: f64,
    /// lower end of its 95 % interval
    pub coefficient_low_m2_per_N: f64,
    /// upper end
    pub coefficient_high_m2_per_N: f64,
    /// median relative standard deviation of the wear after the revolutions of the run
    pub wander: f64,
    /// median relative standard deviation of a measurement, beside what is known of it
    pub scatter: f64,
    /// probability that the limit has been passed; empty without a limit, as what follows
    pub passed: Option<f64>,
    /// revolutions of the pinion left until the limit, median
    pub remaining_revolutions: Option<f64>,
    /// lower end of their 95 % interval
    pub remaining_low_revolutions: Option<f64>,
    /// upper end
    pub remaining_high_revolutions: Option<f64>,
    /// revolutions of the pinion from the beginning until the limit, median
    pub total_revolutions: Option<f64>,
    /// lower end of their 95 % interval
    pub total_low_revolutions: Option<f64>,
    /// upper end
    pub total_high_revolutions: Option<f64>,
}

/// A row of `predictions.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct PredictionRow {
    /// pinion or wheel
    pub gear: Gear,
    /// number of measurements from which it is predicted
    pub measurements: usize,
    /// number of the predicted measurement, from 1
    pub predicted: usize,
    /// its time, in revolutions of the pinion
    pub revolutions: f64,
    /// mass, in mg, depth or profile, in µm
    pub kind: &'static str,
    /// value that was found
    pub found: f64,
    /// median of what was predicted; empty where the run does not come to such wear
    pub median: Option<f64>,
    /// lower end of its 95 % interval
    pub low: Option<f64>,
    /// upper end
    pub high: Option<f64>,
    /// predicted probability of a value up to the one found
    pub below_found: f64,
}

/// What the interval of k is for, and what that of a comparison is for.
pub const INTERVAL_OF_K: &str = "The interval of k is of the forecast: of the mean k over life, with wear that wanders from it and measurements that scatter. It is the \
                                 one for the life; to compare oils, materials or loads take that of one profile (gearwear compare RUN PROFILE), which is \
                                 narrower: it is of the fit alone.";

impl Interval {
    /// All of it longer.
    pub fn plus(self, by: f64) -> Self {
        Self { median: self.median + by, low: self.low + by, high: self.high + by }
    }
}

impl LifeRecord {
    /// The run and the table.
    pub fn headline(&self) -> String {
        format!("{} – {}", self.title, self.measured)
    }

    /// Rows of `remaining_life.csv`.
    pub fn rows(&self) -> impl Iterator<Item = LifeRow> + '_ {
        self.gears.iter().flat_map(|of| of.updates.iter().map(|update| update.row(of.gear)))
    }

    /// Rows of `predictions.csv`.
    pub fn predictions(&self) -> impl Iterator<Item = PredictionRow> + '_ {
        self.gears.iter().flat_map(|of| of.updates.iter().flat_map(move |update| update.predictions(of)))
    }
}

impl LifeUpdate {
    fn predictions<'a>(&'a self, of: &'a GearLife) -> impl Iterator<Item = PredictionRow> + 'a {
        self.later.iter().map(move |later| later.row(of, self.measurements))
    }

    fn row(&self, gear: Gear) -> LifeRow {
        let remaining = self.life.map(|life| life.remaining_revolutions);
        let total = self.life.map(|life| life.total_revolutions);
        LifeRow {
            gear,
            measurements: self.measurements,
            hours: self.hours,
            revolutions: self.revolutions,
            coefficient_m2_per_N: self.coefficient_m2_per_N.median,
            coefficient_low_m2_per_N: self.coefficient_m2_per_N.low,
            coefficient_high_m2_per_N: self.coefficient_m2_per_N.high,
            wander: self.wander,
            scatter: self.scatter,
            passed: self.life.map(|life| life.passed),
            remaining_revolutions: remaining.map(|of| of.median),
            remaining_low_revolutions: remaining.map(|of| of.low),
            remaining_high_revolutions: remaining.map(|of| of.high),
            total_revolutions: total.map(|of| of.median),
            total_low_revolutions: total.map(|of| of.low),
            total_high_revolutions: total.map(|of| of.high),
        }
    }
}

impl Prediction {
    fn row(&self, of: &GearLife, measurements: usize) -> PredictionRow {
        let found = &of.measurements[self.measurement - 1];
        PredictionRow {
            gear: of.gear,
            measurements,
            predicted: self.measurement,
            revolutions: found.revolutions,
            kind: found.kind.name(),
            found: found.value,
            median: self.median,
            low: self.low,
            high: self.high,
            below_found: self.below_found,
        }
    }
}
