//! Quantities whose errors are compared.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use gearwear::report::html::reading::capitalised;
use gearwear_physics::results::figures;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ComparedQuantity {
    /// relative L2 error of the depth over the whole flank, the larger of both gears'
    WearProfile,
    /// relative L2 error of the depth over the pinion's flank
    PinionWearProfile,
    /// relative L2 error of the depth over the wheel's flank
    WheelWearProfile,
    /// relative difference of the pinion's greatest depth
    PinionPeakWear,
    /// relative difference of the wheel's greatest depth
    WheelPeakWear,
    /// relative difference of the greatest depth at the pinion's tip edge
    PinionTipEdgeWear,
    /// relative difference of the greatest depth at the wheel's tip edge
    WheelTipEdgeWear,
    /// relative difference of the greatest pressure, new, away from sharp tip edges
    PeakPressure,
    /// relative difference of the greatest pressure, new, away from all tip edges
    FlankPressure,
    /// relative L2 error of the half-width in single contact, new; without slices
    HalfWidth,
    /// relative L2 error of the transmission error, new
    TransmissionError,
    /// relative difference of its peak-to-peak value, new
    TransmissionErrorPeakToPeak,
    /// relative L2 error of the transmission error, worn
    WornTransmissionError,
    /// relative difference of its peak-to-peak value, worn
    WornTransmissionErrorPeakToPeak,
    /// relative L2 error of the root wear over the face width, the larger of both gears'; with slices
    RootWear,
    /// relative difference of the face load factor, new; with slices
    #[serde(rename = "K_Hbeta")]
    FaceLoadFactor,
    /// relative difference of the face load factor, worn; with slices
    #[serde(rename = "worn_K_Hbeta")]
    WornFaceLoadFactor,
}

/// Name in results.
impl fmt::Display for ComparedQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// Heading of a main figure.
fn heading(name: &str) -> String {
    figures::find(name).map_or_else(|| name.to_owned(), |figure| capitalised(&figure.heading))
}

impl ComparedQuantity {
    /// All of them, in the order of the tables; the last three are of pairs with slices, half-width is of the others.
    pub const ALL: [Self; 17] = [
        Self::WearProfile,
        Self::PinionWearProfile,
        Self::WheelWearProfile,
        Self::PinionPeakWear,
        Self::WheelPeakWear,
        Self::PinionTipEdgeWear,
        Self::WheelTipEdgeWear,
        Self::PeakPressure,
        Self::FlankPressure,
        Self::HalfWidth,
        Self::TransmissionError,
        Self::TransmissionErrorPeakToPeak,
        Self::WornTransmissionError,
        Self::WornTransmissionErrorPeakToPeak,
        Self::RootWear,
        Self::FaceLoadFactor,
        Self::WornFaceLoadFactor,
    ];

    /// Title for readers.
    pub fn title(self) -> String {
        match self {
            Self::WearProfile => "Wear profile, both gears".to_owned(),
            Self::PinionWearProfile => "Wear profile, pinion".to_owned(),
            Self::WheelWearProfile => "Wear profile, wheel".to_owned(),
            Self::PinionPeakWear => heading("pinion.peak_wear_um"),
            Self::WheelPeakWear => heading("wheel.peak_wear_um"),
            Self::PinionTipEdgeWear => heading("pinion.tip_edge_wear_um"),
            Self::WheelTipEdgeWear => heading("wheel.tip_edge_wear_um"),
            Self::PeakPressure => heading("new.peak_pressure_MPa"),
            Self::FlankPressure => heading("new.flank_pressure_MPa"),
            Self::HalfWidth => "Half-width in single contact, new".to_owned(),
            Self::TransmissionError => "Transmission error, new".to_owned(),
            Self::TransmissionErrorPeakToPeak => heading("new.transmission_error_um.peak_to_peak"),
            Self::WornTransmissionError => "Transmission error, worn".to_owned(),
            Self::WornTransmissionErrorPeakToPeak => heading("worn.transmission_error_um.peak_to_peak"),
            Self::RootWear => "Root wear over the face width, both gears".to_owned(),
            Self::FaceLoadFactor => heading("helical.K_Hbeta_new"),
            Self::WornFaceLoadFactor => heading("helical.K_Hbeta_worn"),
        }
    }

    /// How its error is measured.
    pub fn measure(self) -> &'static str {
        match self {
            Self::WearProfile => "the larger of both gears' relative L2 errors of the depth over the whole flank",
            Self::PinionWearProfile | Self::WheelWearProfile => {
                "relative L2 error of the depth over the whole flank, √(∫(h − h_ref)² dA / ∫h_ref² dA)"
            }
            Self::PinionPeakWear | Self::WheelPeakWear => {
                "relative difference of the maximum depth on the active profile"
            }
            Self::PinionTipEdgeWear | Self::WheelTipEdgeWear => {
                "relative difference of the maximum depth at the tip edge"
            }
            Self::PeakPressure => {
                "relative difference of the maximum pressure over the path of contact, without the positions at a sharp \
                 tip edge"
            }
            Self::FlankPressure => {
                "relative difference of the maximum pressure over the path of contact, without the positions at a tip edge, \
                 sharp or rounded"
            }
            Self::HalfWidth => "relative L2 error of the half-width over the path from B to D",
            Self::TransmissionError | Self::WornTransmissionError => {
                "relative L2 error of the transmission error over the path from A to E"
            }
            Self::TransmissionErrorPeakToPeak | Self::WornTransmissionErrorPeakToPeak => {
                "relative difference of the peak-to-peak value over the path from A to E"
            }
            Self::RootWear => {
                "the larger of both gears' relative L2 errors, over the face width, of the maximum depth within 2 mm of radius \
                 above the start of active profile"
            }
            Self::FaceLoadFactor | Self::WornFaceLoadFactor => {
                "relative difference of the maximum over the mean load of the slices, each averaged over the mesh"
            }
        }
    }
}
