//! Record of a study of uncertainty: `uncertainty.json`, and the source of the other files.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::distribution::Uncertain;
use super::fast_model::SampledSurface;
use super::life::DepthLimit;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::sobol_indices::Index;

/// Name of the factor for the error of the fast model.
pub const MODEL_ERROR: &str = "error of the fast model";

/// A finished study, or one that was interrupted, of the points that were finished.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct UncertaintyRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene as given, resolved.
    pub scene_hash: String,
    pub uncertain: Vec<Uncertain>,
    pub limits: Vec<DepthLimit>,
    /// Correlation of the normal scores of the uncertain keys, in their order; null where they are independent.
    pub correlation: Option<Vec<Vec<f64>>>,
    pub seed: u32,
    /// Points of the Sobol sequence that were asked for.
    pub samples_asked: usize,
    /// Number of runs of all of them.
    pub runs_asked: usize,
    /// Points that were finished: each gives two independent samples, on which the quantiles stand.
    pub samples: usize,
    /// Samples of these points that were run or read off, and how many of them failed.
    pub runs: usize,
    pub failed: usize,
    /// Why the first of them failed.
    pub first_failure: Option<String>,
    /// Source of the error of the fast model, or the reason why it is not known.
    pub model_error_how: String,
    pub outputs: Vec<OutputRecord>,
    /// Wear over the active flanks.
    pub bands: Bands,
    pub threads: usize,
    pub wall_s: f64,
    /// Contact surface of the samples.
    pub surface: SampledSurface,
    /// Samples that were read off a response surface of the others; null where all were run, as `no_response_surface_because` says.
    pub response_surface: Option<ReadOffSamples>,
    pub no_response_surface_because: Option<String>,
    /// The scene, as the user gave it.
    #[serde(skip)]
    pub scene_toml: String,
    /// In `samples.csv`.
    #[serde(skip)]
    pub rows: Vec<SampleRow>,
}

impl UncertaintyRecord {
    /// `uncertainty.json`.
    ///
    /// # Errors
    /// None that is known.
    pub fn summary_json(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

/// Samples that were run, and those that were read off a response surface of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct ReadOffSamples {
    pub run: usize,
    pub read_off: usize,
    /// Total degree of the polynomial of the figures, and of that of the wear over the flanks.
    pub degree: usize,
    pub wear_degree: usize,
}

/// A figure of the runs.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct OutputRecord {
    /// Path in `summary.json`, or of the depth that ends the life.
    pub output: String,
    pub meaning: String,
    pub unit: String,
    /// Value of the scene as given.
    pub nominal: Option<f64>,
    /// Relative error that finite elements find of it there; null where it is not known. It is varied evenly within this and `surface_difference`
    /// together.
    pub model_error: Option<f64>,
    /// Samples that have it.
    pub samples: usize,
    /// Part of the samples whose life is longer than their duration; null for figures other than lives.
    pub censored: Option<f64>,
    pub mean: Option<f64>,
    pub standard_deviation: Option<f64>,
    pub quantiles: Quantiles,
    /// Null where `no_indices_because` says why.
    pub indices: Option<Vec<FactorIndices>>,
    pub no_indices_because: Option<String>,
    /// Factor to the figures on the contact surface of the samples: that of the scene as given, over that there; null where they are on the surface of
    /// the scene.
    pub surface_correction: Option<f64>,
    /// Greatest relative difference that the contact surface of the samples makes to it with the keys low or high, so corrected; null likewise.
    pub surface_difference: Option<f64>,
    /// Root mean square of what the response surface misses samples by that are left out of its fit, over the standard deviation, of a life that of the depth at the
    /// end; null where all were run.
    pub response_surface_error: Option<f64>,
    /// All values, rising.
    #[serde(skip)]
    pub sorted: Vec<f64>,
}

/// Null where a quantile lies among lives that are longer than their duration, or there are no values.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Quantiles {
    pub p05: Option<f64>,
    pub p25: Option<f64>,
    pub p50: Option<f64>,
    pub p75: Option<f64>,
    pub p95: Option<f64>,
}

impl Quantiles {
    pub fn all(&self) -> [Option<f64>; 5] {
        [self.p05, self.p25, self.p50, self.p75, self.p95]
    }
}

/// Sensitivity of a figure to a factor.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct FactorIndices {
    /// The key, or [`MODEL_ERROR`].
    pub factor: String,
    /// Part of the variance that it explains alone.
    pub first: Index,
    /// Index with all interactions.
    pub total: Index,
}

/// Wear over each flank of the scene, as a table by the flanks' paths in `summary.json`.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands(pub Vec<FlankBand>);

/// Wear over a flank.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankBand {
    /// Path of the flank in `summary.json`.
    pub flank: &'static str,
    /// The same in words.
    pub in_words: &'static str,
    /// Gear of its pair.
    pub gear: Gear,
    pub band: Band,
}

impl Serialize for Bands {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|one| map.serialize_entry(one.flank, &one.band))?;
        map.end()
    }
}

/// Quantiles of wear, place by place; empty where nothing was worn.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize)]
pub struct Band {
    /// Places on the flank of the scene as given.
    pub radius_mm: Vec<f64>,
    /// Wear depth of the scene as given.
    pub nominal_um: Vec<f64>,
    /// Quantiles of 5, 25, 50, 75 and 95 %.
    pub quantiles_um: [Vec<f64>; 5],
}

/// A sample.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleRow {
    /// Number of the point of the sequence, from 0.
    pub point: usize,
    /// `A`, `B`, or the key that an A has from B.
    pub matrix: String,
    /// Values of the uncertain keys.
    pub values: Vec<f64>,
    /// Whether it was read off a response surface.
    pub is_read_off: bool,
    /// Error of the fast model as a share of its bound, -1 to 1; `None` where it is not known.
    pub model_error: Option<f64>,
    /// The figures, and after them the lives.
    pub outputs: Vec<Option<f64>>,
    pub error: Option<String>,
}
