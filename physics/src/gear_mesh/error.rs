//! Why a tooth cannot be meshed.

/// What stands in the way of a mesh; lengths in mm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ToothMeshError {
    /// The clamp circle leaves no body below the teeth, or is none.
    #[error(
        "clamp radius {clamp_radius_mm:.4} mm: it must be above 0 and at most {greatest_mm:.4} mm, below the teeth"
    )]
    ClampRadius {
        /// As given.
        clamp_radius_mm: f64,
        /// Largest possible.
        greatest_mm: f64,
    },
    /// A length or count the mesh is to have is not positive and finite.
    #[error("{what} is {value}: it must be a positive number")]
    NotPositive {
        /// What was asked for.
        what: &'static str,
        /// As given.
        value: f64,
    },
    /// The elements asked for on the flank are no lengths, or shorter than can be meshed.
    #[error(
        "elements of {value_mm} mm are asked for where the flank's radius of curvature is {rho_mm:.4} mm: at least {least_mm:.2e} mm"
    )]
    ElementLength {
        /// As asked for.
        value_mm: f64,
        /// Where.
        rho_mm: f64,
        /// Shortest allowed.
        least_mm: f64,
    },
    /// The resolution asked for needs more nodes than is reasonable.
    #[error("the outline needs {elements} elements, more than the {greatest} a tooth may have")]
    TooFine {
        /// Along the whole outline.
        elements: usize,
        /// What is allowed.
        greatest: usize,
    },
    /// The removed material reaches beyond the flank's centre of curvature where the involute begins.
    #[error("{removed_mm:.4} mm are removed where the involute begins with radius of curvature {rho_mm:.4} mm")]
    ReliefBeyondCurvature {
        /// Removed there.
        removed_mm: f64,
        /// ρ of the root form circle.
        rho_mm: f64,
    },
    /// Relieved flanks leave no tip land.
    #[error("the relieved flanks meet below the tip circle of radius {tip_radius_mm:.4} mm")]
    PointedTip {
        /// r_a.
        tip_radius_mm: f64,
    },
    /// No circle of the rounding's radius fits between flank and tip circle, or the roundings of both sides overlap.
    #[error("a tip rounding of radius {radius_mm:.4} mm does not fit between the relieved flanks and the tip circle")]
    TipRounding {
        /// As given.
        radius_mm: f64,
    },
    /// Pieces of the outline cross, so that there is no body between them.
    #[error("the outline crosses itself near ({:.4}, {:.4}) mm", .at_mm[0], .at_mm[1])]
    CrossedOutline {
        /// Where, the tooth's centre line on +y.
        at_mm: [f64; 2],
    },
    /// An element came out inverted.
    #[error("element {cell} near ({:.4}, {:.4}) mm is inverted", .at_mm[0], .at_mm[1])]
    Inverted {
        /// Its number.
        cell: usize,
        /// Its first node, the tooth's centre line on +y.
        at_mm: [f64; 2],
    },
    /// A sector cannot be cut from the gear as asked.
    #[error("a sector of {sector_teeth} teeth of {teeth}: it must be an odd number, at most that of the gear")]
    SectorTeeth {
        /// As given.
        sector_teeth: u32,
        /// z.
        teeth: u32,
    },
}
