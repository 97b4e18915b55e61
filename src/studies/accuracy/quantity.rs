//! Quantities whose errors are compared.

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ComparedQuantity {
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

impl ComparedQuantity {
    /// All of them, in the order of the tables; the last three are of pairs with slices, half-width is of the others.
    pub(crate) const ALL: [Self; 17] = [
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
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::WearProfile => "Wear profile, both gears",
            Self::PinionWearProfile => "Wear profile, pinion",
            Self::WheelWearProfile => "Wear profile, wheel",
            Self::PinionPeakWear => "Maximum wear, pinion",
            Self::WheelPeakWear => "Maximum wear, wheel",
            Self::PinionTipEdgeWear => "Maximum wear, pinion’s tip edge",
            Self::WheelTipEdgeWear => "Maximum wear, wheel’s tip edge",
            Self::PeakPressure => "Maximum pressure at a point, new",
            Self::FlankPressure => "Flank pressure, new",
            Self::HalfWidth => "Half-width in single contact, new",
            Self::TransmissionError => "Transmission error, new",
            Self::TransmissionErrorPeakToPeak => "Transmission error peak to peak, new",
            Self::WornTransmissionError => "Transmission error, worn",
            Self::WornTransmissionErrorPeakToPeak => "Transmission error peak to peak, worn",
            Self::RootWear => "Root wear over the face width, both gears",
            Self::FaceLoadFactor => "Face load factor K_Hβ, new",
            Self::WornFaceLoadFactor => "Face load factor K_Hβ, worn",
        }
    }

    /// How its error is measured.
    pub(crate) fn measure(self) -> &'static str {
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
