//! The stages of finite-element contact of a gear pair: in this order for every scene.

/// A stage of `gearwear fem` with a gear pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FemPairStage {
    /// Everything that follows from the data of the pair.
    Geometry,
    /// The teeth of both gears as finite elements.
    Meshing,
    /// Both gears factorised and condensed onto the nodes of their working flanks.
    Condensation,
    /// Contact at the positions of the mesh cycle, or at the one asked for.
    Cycle,
    /// Contact at the points A–E, of a mesh cycle alone.
    PathPoints,
    /// The whole model without condensation, where asked for.
    FullModel,
    /// Displacement and stress of the teeth at one position.
    Stresses,
    /// The output folder.
    Report,
}

impl FemPairStage {
    /// Name in `summary.json` and on the terminal.
    pub fn name(self) -> &'static str {
        match self {
            FemPairStage::Geometry => "geometry",
            FemPairStage::Meshing => "meshing",
            FemPairStage::Condensation => "condensation",
            FemPairStage::Cycle => "cycle",
            FemPairStage::PathPoints => "path-points",
            FemPairStage::FullModel => "full-model",
            FemPairStage::Stresses => "stresses",
            FemPairStage::Report => "report",
        }
    }
}
