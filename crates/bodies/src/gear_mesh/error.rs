//! Reasons why a tooth cannot be meshed.

/// Reason why a tooth cannot be meshed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ToothMeshError {
    /// The clamp radius is not positive or leaves no body below the teeth.
    #[error(
        "clamp radius {:.4} mm: it must {} {:.4} mm, below the teeth",
        .clamp_radius_mm.abs(),
        if *.greatest_mm < 0.0 { "be at least" } else { "be above 0 and at most" },
        .greatest_mm.abs()
    )]
    ClampRadius {
        /// Given radius.
        clamp_radius_mm: f64,
        /// Greatest possible radius, negative of an internal gear.
        greatest_mm: f64,
    },
    /// A setting of the mesh is not positive and finite.
    #[error("{what} is {value}: it must be a positive number")]
    NotPositive {
        /// Name of the setting.
        what: &'static str,
        /// Given value.
        value: f64,
    },
    /// The element length on the flank is not finite, or too short to be meshed.
    #[error(
        "elements of {value_mm} mm on the flank where its radius of curvature is {rho_mm:.4} mm: they must be at least {least_mm:.2e} mm long; fewer elements per half-width are longer"
    )]
    ElementLength {
        /// Wanted length.
        value_mm: f64,
        /// Radius of curvature of the flank there.
        rho_mm: f64,
        /// Shortest allowed length.
        least_mm: f64,
    },
    /// The outline needs too many elements.
    #[error(
        "the outline of a tooth needs {elements} elements, more than {greatest}: take fewer elements per half-width"
    )]
    TooFine {
        /// Number along the whole outline.
        elements: usize,
        /// Greatest number allowed.
        greatest: usize,
    },
    /// The modification at the root form circle is more than half the involute's radius of curvature.
    #[error(
        "{removed_mm:.4} mm are removed from the flank where the involute begins: less than half of its radius of curvature there, {rho_mm:.4} mm, can be meshed"
    )]
    ReliefBeyondCurvature {
        /// Material removed at the root form circle.
        removed_mm: f64,
        /// ρ at the root form circle.
        rho_mm: f64,
    },
    /// The relieved flanks leave no tip land.
    #[error("the relieved flanks meet below the tip circle of radius {tip_radius_mm:.4} mm")]
    PointedTip {
        /// Tip radius r_a.
        tip_radius_mm: f64,
    },
    /// No circle of the rounding's radius fits between flank and tip circle, or the roundings of both sides overlap.
    #[error("a tip rounding of radius {radius_mm:.4} mm does not fit between the relieved flanks and the tip circle")]
    TipRounding {
        /// Radius of the rounding.
        radius_mm: f64,
    },
    /// The outline crosses itself.
    #[error("the outline crosses itself near ({:.4}, {:.4}) mm", .at_mm[0], .at_mm[1])]
    CrossedOutline {
        /// Point near the crossing, the tooth's centre line on +y.
        at_mm: [f64; 2],
    },
    /// An element is inverted.
    #[error("element {cell} near ({:.4}, {:.4}) mm is inverted", .at_mm[0], .at_mm[1])]
    Inverted {
        /// Number of the element.
        cell: usize,
        /// First node of the element, the tooth's centre line on +y.
        at_mm: [f64; 2],
    },
    /// The sector's number of teeth is even, or more than the gear has.
    #[error("a sector of {sector_teeth} teeth of {teeth}: it must be an odd number, at most that of the gear")]
    SectorTeeth {
        /// Teeth of the sector.
        sector_teeth: u32,
        /// Teeth of the gear.
        teeth: u32,
    },
}
