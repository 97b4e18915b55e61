//! The stages of a calibration: in this order for every scene.

/// A stage of `gearwear calibrate`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CalibrationStage {
    /// Everything that follows from the data of the pair.
    Geometry,
    /// The teeth of both gears as finite elements.
    Meshing,
    /// Both gears factorised and condensed onto the nodes of their working flanks.
    Condensation,
    /// Deflection of the teeth along the path of contact.
    ToothStiffness,
    /// The pair alone in contact, and K/H fitted to it.
    Foundation,
    /// The stiffness at C at other resolutions.
    Convergence,
    /// The stiffness at C with the bodies held elsewhere.
    RimDepth,
    /// The stiffness at C with other neighbours.
    Neighbours,
    /// Gears of other numbers of teeth.
    ToothFamily,
    /// The slices of a pair whose sections differ, fitted to its teeth in space.
    Slices,
    /// One mesh of unworn flanks.
    WearReference,
    /// The files.
    Report,
}

impl CalibrationStage {
    /// Name on the terminal.
    pub fn name(self) -> &'static str {
        match self {
            Self::Geometry => "geometry",
            Self::Meshing => "meshing",
            Self::Condensation => "condensation",
            Self::ToothStiffness => "tooth-stiffness",
            Self::Foundation => "foundation",
            Self::Convergence => "convergence",
            Self::RimDepth => "rim-depth",
            Self::Neighbours => "neighbours",
            Self::ToothFamily => "tooth-family",
            Self::Slices => "slices",
            Self::WearReference => "wear-reference",
            Self::Report => "report",
        }
    }
}
