//! What the comparison of models by error and run time leaves behind, as plain data in the units of the output files.
//!
//! Field names are the key names of `accuracy.json`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::record::{PathPoints, StopReason, WorkSummary};
use crate::gear::PerGear;

/// Name of the calibration beside the results.
pub const CALIBRATION_FILE: &str = "calibration.json";

/// A finished (or interrupted) comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AccuracyRecord {
    /// The scene's title.
    pub title: String,
    /// Version of the program.
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the resolved scene.
    pub scene_hash: String,
    /// Why it ended.
    pub stopped: StopReason,
    /// Wall time of everything until the report is written, s.
    pub wall_s: f64,
    /// Wall time of the calibration, s; `None` where the scene brings one, or none could be made.
    pub calibration_s: Option<f64>,
    /// Threads that every run could use.
    pub threads: usize,
    /// The relative error that the recommendations ask for.
    pub within: f64,
    /// What the others are measured against.
    pub reference: ReferenceRecord,
    /// Every run, in the order of the work.
    pub variants: Vec<VariantRecord>,
    /// What was not run, and why.
    pub left_out: Vec<LeftOut>,
    /// The cheapest setting for each quantity.
    pub recommendations: Vec<Recommendation>,
    /// Runs that differ in one respect only, side by side.
    pub comparisons: Vec<Comparison>,
    /// What the user should know.
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

/// What errors are measured of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Depth over both flanks: the larger of both gears' errors.
    WearProfile,
    /// Depth over the pinion's flank.
    PinionWearProfile,
    /// Depth over the wheel's flank.
    WheelWearProfile,
    /// Greatest depth on the pinion.
    PinionPeakWear,
    /// Greatest depth on the wheel.
    WheelPeakWear,
    /// Greatest pressure of the unworn pair, at rounded tip edges too.
    PeakPressure,
    /// Greatest pressure of the unworn pair away from tip edges.
    FlankPressure,
    /// Half-width of the unworn contact where one pair carries the load alone.
    HalfWidth,
    /// Loaded transmission error of the unworn pair over the path of contact.
    TransmissionError,
    /// Its peak-to-peak value.
    TransmissionErrorPeakToPeak,
    /// Loaded transmission error of the worn pair over the path of contact.
    WornTransmissionError,
    /// Its peak-to-peak value.
    WornTransmissionErrorPeakToPeak,
}

impl Quantity {
    /// All of them, in the order of the tables.
    pub const ALL: [Self; 12] = [
        Self::WearProfile,
        Self::PinionWearProfile,
        Self::WheelWearProfile,
        Self::PinionPeakWear,
        Self::WheelPeakWear,
        Self::PeakPressure,
        Self::FlankPressure,
        Self::HalfWidth,
        Self::TransmissionError,
        Self::TransmissionErrorPeakToPeak,
        Self::WornTransmissionError,
        Self::WornTransmissionErrorPeakToPeak,
    ];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::WearProfile => "wear_profile",
            Self::PinionWearProfile => "pinion_wear_profile",
            Self::WheelWearProfile => "wheel_wear_profile",
            Self::PinionPeakWear => "pinion_peak_wear",
            Self::WheelPeakWear => "wheel_peak_wear",
            Self::PeakPressure => "peak_pressure",
            Self::FlankPressure => "flank_pressure",
            Self::HalfWidth => "half_width",
            Self::TransmissionError => "transmission_error",
            Self::TransmissionErrorPeakToPeak => "transmission_error_peak_to_peak",
            Self::WornTransmissionError => "worn_transmission_error",
            Self::WornTransmissionErrorPeakToPeak => "worn_transmission_error_peak_to_peak",
        }
    }

    /// What it is, for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::WearProfile => "Wear profile, both gears",
            Self::PinionWearProfile => "Wear profile, pinion",
            Self::WheelWearProfile => "Wear profile, wheel",
            Self::PinionPeakWear => "Greatest wear, pinion",
            Self::WheelPeakWear => "Greatest wear, wheel",
            Self::PeakPressure => "Greatest pressure, new",
            Self::FlankPressure => "Greatest pressure away from tip edges, new",
            Self::HalfWidth => "Half-width in single contact, new",
            Self::TransmissionError => "Transmission error, new",
            Self::TransmissionErrorPeakToPeak => "Transmission error peak to peak, new",
            Self::WornTransmissionError => "Transmission error, worn",
            Self::WornTransmissionErrorPeakToPeak => "Transmission error peak to peak, worn",
        }
    }

    /// How its error is measured.
    pub fn measure(self) -> &'static str {
        match self {
            Self::WearProfile => {
                "the larger of both gears' relative L2 errors of the depth over the flank's arc length"
            }
            Self::PinionWearProfile | Self::WheelWearProfile => {
                "relative L2 error of the depth over the flank's arc length, √(∫(h − h_ref)² ds / ∫h_ref² ds)"
            }
            Self::PinionPeakWear | Self::WheelPeakWear => "relative difference of the greatest depth on the flank",
            Self::PeakPressure => {
                "relative difference of the greatest pressure over the path of contact, without the \
                                   positions at a sharp tip edge"
            }
            Self::FlankPressure => {
                "relative difference of the greatest pressure over the path of contact, without the positions at a tip edge, \
                 sharp or rounded"
            }
            Self::HalfWidth => "relative L2 error of the half-width over the path from B to D",
            Self::TransmissionError | Self::WornTransmissionError => {
                "relative L2 error of the transmission error over the path from A to E"
            }
            Self::TransmissionErrorPeakToPeak | Self::WornTransmissionErrorPeakToPeak => {
                "relative difference of the peak-to-peak value over the path from A to E"
            }
        }
    }
}

/// The finite-element solution that the errors are measured against.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReferenceRecord {
    /// How it was obtained.
    pub how: String,
    /// What remains uncertain of each quantity, relative: errors below this are not told apart.
    pub uncertainty: BTreeMap<Quantity, f64>,
    /// The runs it was extrapolated from; indices of `variants`.
    pub runs: Vec<usize>,
    /// Greatest wear depth of each gear, µm.
    pub peak_wear_um: PerGear<f64>,
    /// Greatest pressure of the unworn pair away from sharp tip edges, MPa.
    #[serde(rename = "peak_pressure_MPa")]
    pub peak_pressure_mpa: f64,
    /// Peak-to-peak transmission error, new and worn, µm.
    pub transmission_error_peak_to_peak_um: [f64; 2],
    /// Both flanks.
    #[serde(skip)]
    pub flanks: PerGear<ReferenceFlank>,
}

/// The reference's wear over one flank.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReferenceFlank {
    /// Distance from the gear's axis, mm.
    pub radius_mm: Vec<f64>,
    /// Wear depth, µm.
    pub wear_um: Vec<f64>,
    /// Radii of the points A–E.
    pub path_point_radius_mm: Option<PathPoints>,
}

/// A run: what it was made of, what it took, and how far it is from the reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantRecord {
    /// What it is called in tables and plots.
    pub name: String,
    /// What it is made of.
    pub settings: VariantSettings,
    /// Wall time of the wear run alone, s: the least of the repeats.
    pub simulation_s: Option<f64>,
    /// Wall time of everything before it (meshing, condensation, calibration, stiffness), s.
    pub setup_s: Option<f64>,
    /// How often it was run for its time.
    pub repeats: u32,
    /// Work done by the wear run.
    pub work: Option<WorkSummary>,
    /// Greatest wear depth of each gear, µm.
    pub peak_wear_um: Option<PerGear<f64>>,
    /// Error of each quantity.
    pub errors: BTreeMap<Quantity, MeasuredError>,
    /// Why there is no result, where there is none.
    pub failure: Option<String>,
    /// Whether the reference was extrapolated from it.
    pub part_of_reference: bool,
    /// Wear depth at the reference's radii, µm; kept where it is shown.
    #[serde(skip)]
    pub wear_um: Option<PerGear<Vec<f64>>>,
}

/// What a run was made of.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantSettings {
    /// Name of the contact surface.
    pub surface: String,
    /// What K/H shares with Hertz or the calibration; `None` where the surface has no K/H.
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
    /// Intervals of a flank.
    pub flank_points: usize,
    /// Loading positions.
    pub positions: usize,
    /// Pinion revolutions a wear step.
    pub step_revolutions: f64,
    /// The scene's numbers of flank points and positions over these.
    pub spacing_coarsening: u32,
    /// This wear step over the scene's.
    pub step_coarsening: u32,
}

/// An error and what it means beside run time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasuredError {
    /// Relative.
    pub relative: f64,
    /// Whether no faster run has a smaller error, the reference's uncertainty considered.
    pub on_front: bool,
}

/// Something that was not run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// What.
    pub what: String,
    /// Why.
    pub reason: String,
}

/// The cheapest setting whose error is within the one wanted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Recommendation {
    /// Of what.
    pub quantity: Quantity,
    /// Index of the run in `variants`; the one with the least error where none is within.
    pub variant: usize,
    /// Whether its error is within the one wanted.
    pub is_within: bool,
}

/// Runs that differ in one respect only.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// What they differ in.
    pub title: String,
    /// What they have in common.
    pub common: String,
    /// Name of the run that the others are compared with.
    pub baseline: String,
    /// The others.
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
