//! Why a gear pair cannot exist or cannot run.

use super::per_gear::Gear;

/// What is wrong with the geometry of a pair; diameters and lengths in mm, transverse.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PairError {
    /// The base circles overlap: no line of action.
    #[error("the base circles overlap at centre distance {centre_distance_mm} mm: it must exceed {least_mm:.4} mm")]
    NoMesh {
        /// As given.
        centre_distance_mm: f64,
        /// Sum of the base radii.
        least_mm: f64,
    },
    /// The teeth interfere: together they are thicker than the pitch on the working circles.
    #[error("the teeth interfere: backlash is {backlash_mm:.4} mm at centre distance {centre_distance_mm} mm")]
    NegativeBacklash {
        /// Circumferential, on the working pitch circles.
        backlash_mm: f64,
        /// As given.
        centre_distance_mm: f64,
        /// Centre distance without backlash.
        least_mm: f64,
    },
    /// A tooth leaves the mesh before the next one enters: at some position no width is in contact.
    #[error("{}", contact_ratio_message(*.contact_ratio, *.overlap_ratio))]
    ContactRatioBelowOne {
        /// ε_α; 0 where the tip circles do not reach each other.
        contact_ratio: f64,
        /// ε_β.
        overlap_ratio: f64,
    },
    /// The flanks meet before the tip circle.
    #[error("the {} tooth is pointed: its tip thickness is {tip_thickness_mm:.4} mm", .gear.name())]
    PointedTooth {
        /// Which gear.
        gear: Gear,
        /// Transverse, at the tip circle; negative: the flanks cross below it.
        tip_thickness_mm: f64,
        /// Given or derived.
        tip_diameter_mm: f64,
        /// Where the flanks meet.
        pointed_diameter_mm: f64,
    },
    /// The tip circle leaves no involute above the form circle.
    #[error("the {} tip circle ({tip_diameter_mm:.4} mm) lies inside the form circle ({form_diameter_mm:.4} mm)", .gear.name())]
    TipBelowForm {
        /// Which gear.
        gear: Gear,
        /// Given or derived.
        tip_diameter_mm: f64,
        /// d_Ff.
        form_diameter_mm: f64,
    },
    /// The mate's tip runs into the fillet.
    #[error(
        "interference on the {}: the tip of the {} runs into its root fillet by {overlap_mm:.4} mm",
        .gear.name(),
        .gear.mate().name()
    )]
    Interference {
        /// Gear whose fillet it is.
        gear: Gear,
        /// Greatest overlap, along the circle through the tip.
        overlap_mm: f64,
        /// Greatest tip diameter of the mate that has room.
        greatest_tip_diameter_mm: f64,
    },
    /// The tip of one gear reaches into the root of the other.
    #[error("the {} tip runs into the root of its mate: tip clearance is {clearance_mm:.4} mm", .gear.name())]
    NoTipClearance {
        /// Whose tip.
        gear: Gear,
        /// Negative.
        clearance_mm: f64,
    },
    /// The flanks of the generating rack meet above its dedendum.
    #[error(
        "the rack is pointed: at this pressure angle its flanks meet {greatest_dedendum_factor:.4} modules below the datum line, above the \
         dedendum"
    )]
    RackPointed {
        /// Greatest possible h_fP*.
        greatest_dedendum_factor: f64,
    },
    /// The generating rack has no tip left: its fillet radius is too large.
    #[error("the rack's fillet radius factor is too large to fit between its flanks")]
    RackTipPointed {
        /// Greatest possible ρ_fP*.
        greatest: f64,
    },
    /// The rack cuts away the whole flank, or the root circle falls to nothing.
    #[error("no tooth is left on the {}: the rack reaches the axis or cuts the flank away", .gear.name())]
    NoTooth {
        /// Which gear.
        gear: Gear,
    },
    /// The bore cuts into the teeth.
    #[error("the {} bore ({bore_diameter_mm} mm) does not leave a body below the root circle ({root_diameter_mm:.4} mm)", .gear.name())]
    BoreTooLarge {
        /// Which gear.
        gear: Gear,
        /// As given.
        bore_diameter_mm: f64,
        /// d_f.
        root_diameter_mm: f64,
    },
    /// A relief is longer than the active profile, or the half of the face width, that it lies on.
    #[error("the {} {modification} is {length_mm:.4} mm long, more than the {available_mm:.4} mm there is", .gear.name())]
    ModificationTooLong {
        /// Which gear.
        gear: Gear,
        /// `tip relief`, `root relief` or `end relief`.
        modification: &'static str,
        /// Roll length, or length over the face width.
        length_mm: f64,
        /// What there is.
        available_mm: f64,
    },
    /// A relief or crowning takes away so much that the flank is no flank any more.
    #[error("the {} {modification} removes {amount_mm:.4} mm: at most {greatest_mm:.4} mm leave a flank", .gear.name())]
    ModificationTooDeep {
        /// Which gear.
        gear: Gear,
        /// Its key in words, without the unit.
        modification: &'static str,
        /// Removed along the normal.
        amount_mm: f64,
        /// What a flank may lose.
        greatest_mm: f64,
    },
    /// The axes are so far from parallel that the flanks hardly meet.
    #[error(
        "axes that are not parallel make a helix slope of {slope_mm:.4} mm: at most {greatest_mm:.4} mm leave a flank"
    )]
    AxesTooFarFromParallel {
        /// Of the working flanks over the face width.
        slope_mm: f64,
        /// What a flank may lose.
        greatest_mm: f64,
    },
    /// The rounding of the tip edge takes more of the flank or of the tip land than there is.
    #[error("the {} tip rounding has radius {radius_mm:.4} mm: at most {greatest_mm:.4} mm fit", .gear.name())]
    TipRoundingTooLarge {
        /// Which gear.
        gear: Gear,
        /// As given.
        radius_mm: f64,
        /// What fits.
        greatest_mm: f64,
    },
}

fn contact_ratio_message(contact_ratio: f64, overlap_ratio: f64) -> String {
    if overlap_ratio == 0.0 {
        return format!("transverse contact ratio is {contact_ratio:.4}: it must be at least 1");
    }
    format!(
        "transverse contact ratio is {contact_ratio:.4} and overlap ratio {overlap_ratio:.4}, so that no part of the face width \
         is in contact at some position: together they must be at least 1, the first above 0"
    )
}
