//! Reasons why the geometry of a gear pair is impossible.

use super::{internal_error::InternalError, per_gear::Gear};

/// Reason why the geometry of a pair is impossible; transverse diameters and lengths in mm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PairError {
    /// The base circles overlap, so that there is no line of action.
    #[error("the base circles overlap at centre distance {centre_distance_mm} mm: it must exceed {least_mm:.4} mm")]
    NoMesh {
        /// Centre distance.
        centre_distance_mm: f64,
        /// Sum of the base radii.
        least_mm: f64,
    },
    /// The teeth are together thicker than the pitch on the working circles.
    #[error("the teeth interfere: backlash is {backlash_mm:.4} mm at centre distance {centre_distance_mm} mm")]
    NegativeBacklash {
        /// Circumferential backlash on the working pitch circles.
        backlash_mm: f64,
        /// Centre distance.
        centre_distance_mm: f64,
        /// Centre distance without backlash.
        least_mm: f64,
    },
    /// A tooth pair leaves the mesh before the next one enters: at some position no part of the face width is in contact.
    #[error("{}", contact_ratio_message(*.contact_ratio, *.overlap_ratio))]
    ContactRatioBelowOne {
        /// Transverse contact ratio ε_α; 0 where the tip circles do not reach each other.
        contact_ratio: f64,
        /// Overlap ratio ε_β.
        overlap_ratio: f64,
    },
    /// The flanks meet below the tip circle.
    #[error("the {} tooth is pointed: its tip thickness is {tip_thickness_mm:.4} mm", .gear.name())]
    PointedTooth {
        /// Gear with the tooth.
        gear: Gear,
        /// Transverse thickness at the tip circle, negative where the flanks intersect below it.
        tip_thickness_mm: f64,
        /// Tip diameter.
        tip_diameter_mm: f64,
        /// Diameter at which the flanks meet.
        pointed_diameter_mm: f64,
    },
    /// The tip circle leaves no involute above the form circle.
    #[error("the {} tip circle ({tip_diameter_mm:.4} mm) lies inside the form circle ({form_diameter_mm:.4} mm)", .gear.name())]
    TipBelowForm {
        /// Gear with the tip circle.
        gear: Gear,
        /// Tip diameter.
        tip_diameter_mm: f64,
        /// Root form diameter d_Ff.
        form_diameter_mm: f64,
    },
    /// The mate's tip overlaps the fillet.
    #[error(
        "interference on the {}: the tip of the {} runs into its root fillet by {overlap_mm:.4} mm",
        .gear.name(),
        .gear.mate().name()
    )]
    Interference {
        /// Gear with the fillet.
        gear: Gear,
        /// Greatest overlap along the circle through the tip.
        overlap_mm: f64,
        /// Greatest tip diameter of the mate without overlap.
        greatest_tip_diameter_mm: f64,
    },
    /// The tip of one gear reaches into the root of the other.
    #[error("the {} tip runs into the root of its mate: tip clearance is {clearance_mm:.4} mm", .gear.name())]
    NoTipClearance {
        /// Gear with the tip.
        gear: Gear,
        /// Tip clearance, negative.
        clearance_mm: f64,
    },
    /// The pair is impossible as an internal one.
    #[error(transparent)]
    Internal(#[from] InternalError),
    /// The flanks of the generating rack meet above its dedendum.
    #[error(
        "the rack is pointed: at this pressure angle its flanks meet {greatest_dedendum_factor:.4} modules below the datum line, above the \
         dedendum"
    )]
    RackPointed {
        /// Greatest possible dedendum factor h_fP*.
        greatest_dedendum_factor: f64,
    },
    /// The fillet radius of the generating rack is too large.
    #[error("the rack's fillet radius factor is too large to fit between its flanks: at most {greatest:.4}")]
    RackTipPointed {
        /// Greatest possible fillet radius factor ρ_fP*.
        greatest: f64,
    },
    /// The rack cuts the whole flank away, or reaches the axis.
    #[error("no tooth is left on the {}: the rack reaches the axis or cuts the flank away", .gear.name())]
    NoTooth {
        /// Gear without a tooth.
        gear: Gear,
    },
    /// The bore cuts into the teeth.
    #[error("the {} bore ({bore_diameter_mm} mm) does not leave a body below the root circle ({root_diameter_mm:.4} mm)", .gear.name())]
    BoreTooLarge {
        /// Gear with the bore.
        gear: Gear,
        /// Bore diameter.
        bore_diameter_mm: f64,
        /// Root diameter d_f.
        root_diameter_mm: f64,
    },
    /// A relief is longer than the active profile, or than half of the face width.
    #[error("the {} {modification} is {length_mm:.4} mm long, more than the {available_mm:.4} mm there is", .gear.name())]
    ModificationTooLong {
        /// Gear with the modification.
        gear: Gear,
        /// `tip relief`, `root relief` or `end relief`.
        modification: &'static str,
        /// Roll length, or length over the face width.
        length_mm: f64,
        /// Greatest possible length.
        available_mm: f64,
    },
    /// A modification removes too much material.
    #[error("the {} {modification} removes {amount_mm:.4} mm: at most {greatest_mm:.4} mm leave a flank", .gear.name())]
    ModificationTooDeep {
        /// Gear with the modification.
        gear: Gear,
        /// Name of the modification.
        modification: &'static str,
        /// Amount removed along the normal.
        amount_mm: f64,
        /// Greatest possible amount.
        greatest_mm: f64,
    },
    /// The axes are too far from parallel.
    #[error(
        "axes that are not parallel make a helix slope of {slope_mm:.4} mm: at most {greatest_mm:.4} mm leave a flank"
    )]
    AxesTooFarFromParallel {
        /// Helix slope of the working flanks over the face width.
        slope_mm: f64,
        /// Greatest possible slope.
        greatest_mm: f64,
    },
    /// The rounding of the tip edge is larger than the flank or the tip land allows.
    #[error("the {} tip rounding has radius {radius_mm:.4} mm: at most {greatest_mm:.4} mm fit", .gear.name())]
    TipRoundingTooLarge {
        /// Gear with the rounding.
        gear: Gear,
        /// Radius of the rounding.
        radius_mm: f64,
        /// Greatest possible radius.
        greatest_mm: f64,
    },
    /// The tip chamfers leave no flank, or meet.
    #[error("the {} tip chamfer is {height_mm:.4} mm high: at most {greatest_mm:.4} mm leave flank and tip land", .gear.name())]
    TipChamferTooLarge {
        /// Gear with the chamfer.
        gear: Gear,
        /// Radial height.
        height_mm: f64,
        /// Greatest possible height.
        greatest_mm: f64,
    },
    /// The tip chamfer lies nearly along the flank or the tip circle.
    #[error("the {} tip chamfer is at {angle_deg:.2}° to the radius: at least {least_deg:.2}° and at most {greatest_deg:.2}° are possible", .gear.name())]
    TipChamferAngle {
        /// Gear with the chamfer.
        gear: Gear,
        /// Angle to the radius.
        angle_deg: f64,
        /// Least possible angle.
        least_deg: f64,
        /// Greatest possible angle.
        greatest_deg: f64,
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
