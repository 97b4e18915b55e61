//! Record of the comparison of models by error and run time, in the units of the output files.
//!
//! Field names are the key names of `accuracy.json`.

use std::collections::BTreeMap;

use serde::Serialize;

pub use super::quantity::ComparedQuantity;
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::run::{PathPoints, StopReason, WorkSummary};

/// Name of the calibration beside the results.
pub const CALIBRATION_FILE: &str = "calibration.json";

/// Name of the table of root wear over the face width; of pairs with slices.
pub const OVER_WIDTH_FILE: &str = "over_width.csv";

/// A finished (or interrupted) comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AccuracyRecord {
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene.
    pub scene_hash: String,
    pub stopped: StopReason,
    /// Wall time of everything until the report is written, s.
    pub wall_s: f64,
    /// Wall time of the calibration, s; `None` where the scene brings one, or none could be made.
    pub calibration_s: Option<f64>,
    /// Threads that every run could use.
    pub threads: usize,
    /// Relative error that the recommendations stay within.
    pub within: f64,
    /// Reference that the others are measured against.
    pub reference: ReferenceRecord,
    /// Every run, in the order of the work.
    pub variants: Vec<VariantRecord>,
    pub left_out: Vec<LeftOut>,
    /// The cheapest setting for each quantity that can be ranked.
    pub recommendations: Vec<Recommendation>,
    /// The quantities in which the reference is too uncertain for a ranking.
    pub not_ranked: Vec<NotRanked>,
    pub comparisons: Vec<SettingComparison>,
    /// Runs to a greater depth; `None` where the scene has no slices.
    pub deep_runs: Option<DeepRuns>,
    pub warnings: Vec<String>,
    /// The resolved scene as TOML.
    #[serde(skip)]
    pub scene_toml: String,
    /// The scene of the recommended run of the wear profile, with errors estimated again.
    #[serde(skip)]
    pub recommended_toml: Option<String>,
    /// The calibration that the runs were made with, as its file.
    #[serde(skip)]
    pub calibration_json: Option<String>,
}

impl AccuracyRecord {
    /// Whether the pair was cut into slices over the face width.
    pub fn has_slices(&self) -> bool {
        self.variants.iter().any(|variant| variant.settings.slices.is_some())
    }

    /// The run recommended for `quantity`: whether it is within the error wanted, the run, its error and its run time, s.
    pub fn recommended(&self, quantity: ComparedQuantity) -> Option<(bool, &VariantRecord, f64, f64)> {
        let chosen = self.recommendations.iter().find(|r| r.quantity == quantity)?;
        let variant = self.variants.get(chosen.variant)?;
        Some((chosen.is_within, variant, variant.errors.get(&quantity)?.relative, variant.simulation_s?))
    }

    /// Why no run is ranked by `quantity`, where none is.
    pub fn not_ranked(&self, quantity: ComparedQuantity) -> Option<&NotRanked> {
        self.not_ranked.iter().find(|one| one.quantity == quantity)
    }

    /// Whether any run has an error of `quantity`.
    pub fn measures(&self, quantity: ComparedQuantity) -> bool {
        self.variants.iter().any(|variant| variant.errors.contains_key(&quantity))
    }
}

/// The solution that the errors are measured against.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReferenceRecord {
    pub how: String,
    /// Limits of the reference that errors against it do not show; `None` where it is a finite-element solution of the whole pair.
    pub does_not_tell: Option<String>,
    /// Relative uncertainty of each quantity of the reference: errors below it are not told apart.
    pub uncertainty: BTreeMap<ComparedQuantity, f64>,
    /// The runs it was extrapolated from; indices of `variants`.
    pub runs: Vec<usize>,
    /// Greatest wear depth of each gear, µm.
    pub peak_wear_um: PerGear<f64>,
    /// Greatest pressure of the unworn pair away from sharp tip edges, MPa.
    #[serde(rename = "peak_pressure_MPa")]
    pub peak_pressure_mpa: f64,
    /// Peak-to-peak transmission error, new and worn, µm.
    pub transmission_error_peak_to_peak_um: [f64; 2],
    #[serde(skip)]
    pub flanks: PerGear<ReferenceFlank>,
}

/// The reference's wear over one flank.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReferenceFlank {
    /// Distance from the gear's axis, mm.
    pub radius_mm: Vec<f64>,
    /// Place of each slice over the face width, mm: one where all sections are alike.
    pub width_mm: Vec<f64>,
    /// Wear depth, slice after slice, µm.
    pub wear_um: Vec<f64>,
    /// Greatest depth in the root zone of each slice, µm; empty where all sections are alike.
    pub root_wear_um: Vec<f64>,
    pub path_point_radius_mm: Option<PathPoints>,
}

impl ReferenceFlank {
    /// The slices that stand for all: the first, the middle and the last.
    pub fn shown_slices(&self) -> Vec<usize> {
        let last = self.width_mm.len().saturating_sub(1);
        let mut shown = vec![0, self.width_mm.len() / 2, last];
        shown.dedup();
        shown
    }

    /// The values of `field`, given slice after slice at the points of this flank, on one slice.
    pub fn slice<'a>(&self, field: &'a [f64], slice: usize) -> &'a [f64] {
        let points = self.radius_mm.len();
        field.get(slice * points..(slice + 1) * points).unwrap_or_default()
    }
}

/// A run: what it was made of, what it took, and how far it is from the reference.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct VariantRecord {
    /// Name in tables and plots.
    pub name: String,
    pub settings: VariantSettings,
    /// Wall time of the wear run alone, s: the least of the repeats.
    pub simulation_s: Option<f64>,
    /// Wall time of everything before it (meshing, condensation, calibration, stiffness), s.
    pub setup_s: Option<f64>,
    /// How often it was run for its time.
    pub repeats: u32,
    pub work: Option<WorkSummary>,
    /// Greatest wear depth of each gear, µm.
    pub peak_wear_um: Option<PerGear<f64>>,
    pub errors: BTreeMap<ComparedQuantity, MeasuredError>,
    /// Why there is no result, where there is none.
    pub failure: Option<String>,
    /// Whether the reference was extrapolated from it.
    pub part_of_reference: bool,
    /// Wear depth at the reference's radii and widths, slice after slice, µm; kept where it is shown.
    #[serde(skip)]
    pub wear_um: Option<PerGear<Vec<f64>>>,
    /// Greatest depth in the root zone at the reference's widths, µm; kept where it is shown.
    #[serde(skip)]
    pub root_wear_um: Option<PerGear<Vec<f64>>>,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct VariantSettings {
    pub surface: String,
    /// Quantity in which K/H matches Hertz or the calibration; `None` where the surface has no K/H.
    #[serde(rename = "match")]
    pub match_criterion: Option<String>,
    /// Whether K/H is the calibration's, for every position and load.
    pub calibrated: bool,
    /// Whether a tip edge is followed into contact before A and after E.
    pub tip_contact: bool,
    /// Name of the stiffness model; `None` for `fem`, which has none.
    pub stiffness: Option<String>,
    /// Elements in the half-width of contact, of surface `fem`.
    pub elements_per_half_width: Option<f64>,
    /// Slices over the face width; `None` where all sections are alike.
    pub slices: Option<usize>,
    pub coupling: Option<String>,
    /// Intervals of a flank.
    pub flank_points: usize,
    pub positions: usize,
    /// Pinion revolutions a wear step.
    pub step_revolutions: f64,
    /// The scene's numbers of flank points and positions over these.
    pub spacing_coarsening: u32,
    /// Ratio of the wear step to the scene's.
    pub step_coarsening: u32,
}

/// An error and what it means beside run time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasuredError {
    pub relative: f64,
    /// Whether no faster run has a smaller error, the reference's uncertainty considered; never of a quantity that is not ranked.
    pub on_front: bool,
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    pub what: String,
    pub reason: String,
}

/// The cheapest setting whose error is within the one wanted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Recommendation {
    pub quantity: ComparedQuantity,
    /// Index of the run in `variants`; the one with the least error where none is within.
    pub variant: usize,
    /// Whether its error is within the one wanted.
    pub is_within: bool,
}

/// A quantity whose reference is more uncertain than the error asked for: runs are not ranked by it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotRanked {
    pub quantity: ComparedQuantity,
    /// Of the reference, relative.
    pub uncertainty: f64,
    /// Change of the scene that reduces the uncertainty, its largest part first.
    pub remedy: String,
}

/// Runs that differ in one respect only.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SettingComparison {
    /// Setting that differs between them.
    pub title: String,
    /// Settings in common.
    pub common: String,
    /// Name of the run that the others are compared with.
    pub baseline: String,
    pub rows: Vec<ComparisonRow>,
}

/// A run beside the baseline.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparisonRow {
    /// The setting in which it differs.
    pub name: String,
    /// Relative L2 difference of the wear profile of each gear.
    pub wear_profile: PerGear<f64>,
    /// Relative difference of the greatest depth of each gear, signed.
    pub peak_wear: PerGear<f64>,
    /// Wall time of the wear run, s.
    pub simulation_s: f64,
}

/// The models run to a greater depth, once with the scene's number of wear steps and once with fewer: a model whose wear
/// oscillates from step to step then finds other depths, one that does not hardly notices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeepRuns {
    /// Settings in common.
    pub common: String,
    /// Factor on the scene's revolutions.
    pub revolutions_factor: f64,
    /// The run that the profiles are compared with.
    pub baseline: String,
    /// Greatest relative change of the greatest depth of a stable run.
    pub stable_within: f64,
    pub rows: Vec<DeepRow>,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct DeepRow {
    pub name: String,
    /// With the scene's number of wear steps.
    pub usual: Option<DeepRun>,
    /// With fewer wear steps.
    pub fewer_steps: Option<DeepRun>,
    /// Relative L2 difference of the wear profile from the baseline's, the larger of both gears'; `None` for the baseline.
    pub wear_profile: Option<f64>,
    /// Relative change of the greatest depth by the longer steps, the larger of both gears'.
    pub peak_wear_change: Option<f64>,
    /// Whether that is within the limit of stable runs.
    pub stable: Option<bool>,
    /// Why there is no result, where there is none.
    pub failure: Option<String>,
}

impl DeepRow {
    /// A model that has not run yet.
    pub fn of(name: String) -> Self {
        Self { name, ..Self::default() }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeepRun {
    pub wear_steps: u64,
    /// Wall time of the wear run, s.
    pub simulation_s: f64,
    /// Greatest depth of each gear, µm.
    pub peak_wear_um: PerGear<f64>,
    /// ‖h − S h‖/‖h‖ of each gear, where S averages each point with its neighbours (1/4, 1/2, 1/4): what of the depth jumps
    /// from point to point.
    pub roughness: PerGear<f64>,
    /// Whether the run warned of its wear step.
    pub warned: bool,
}
