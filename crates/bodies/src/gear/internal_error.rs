//! Reasons why an internal pair is impossible; diameters and lengths as magnitudes.

use super::internal::InvoluteInterference;

/// Reason why an internal pair is impossible; diameters in mm.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum InternalError {
    /// The wheel has no more teeth than the pinion.
    #[error("an internal wheel with {wheel} teeth does not hold a pinion with {pinion}")]
    Teeth {
        /// Number of teeth of the pinion.
        pinion: u32,
        /// Number of teeth of the wheel.
        wheel: u32,
    },
    /// The base circle of the pinion lies inside that of the wheel, so that there is no line of action.
    #[error(
        "the base circles have no common tangent at centre distance {centre_distance_mm} mm of an internal pair: it must exceed {least_mm:.4} mm"
    )]
    NoMesh {
        /// Centre distance.
        centre_distance_mm: f64,
        /// Difference of the base radii.
        least_mm: f64,
    },
    /// The teeth are together thicker than the pitch on the working circles.
    #[error(
        "the teeth interfere: backlash is {backlash_mm:.4} mm at centre distance {centre_distance_mm} mm of an internal pair"
    )]
    NegativeBacklash {
        /// Circumferential backlash on the working pitch circles, negative.
        backlash_mm: f64,
        /// Centre distance.
        centre_distance_mm: f64,
        /// Centre distance without backlash.
        greatest_mm: f64,
    },
    /// The tip circle leaves no involute inside the form circle.
    #[error("the wheel's tip circle ({tip_diameter_mm:.4} mm) lies outside its form circle ({form_diameter_mm:.4} mm)")]
    TipBeyondForm {
        /// Tip diameter.
        tip_diameter_mm: f64,
        /// Root form diameter.
        form_diameter_mm: f64,
    },
    /// The ring has no involute inside its base circle.
    #[error("the wheel's tip circle ({tip_diameter_mm:.4} mm) lies inside its base circle ({base_diameter_mm:.4} mm)")]
    TipInsideBase {
        /// Tip diameter.
        tip_diameter_mm: f64,
        /// Base diameter.
        base_diameter_mm: f64,
    },
    /// The wheel's tip touches below the pinion's base circle, and overlaps its fillet.
    #[error(
        "involute interference: the wheel's tip circle ({:.4} mm) reaches past the point where the line of action touches the pinion's base circle, and \
         into its root fillet by {overlap_mm:.4} mm; z1/z2 = {:.4} is less than 1 − tan α_a2/tan α_wt = {:.4}",
        .of.tip_diameter_mm, .of.ratio, .of.limit
    )]
    InvoluteInterference {
        /// Figures of the interference.
        of: InvoluteInterference,
        /// Greatest overlap along the circle through the tip.
        overlap_mm: f64,
    },
    /// Tips of pinion and ring meet outside the path of contact.
    #[error(
        "trochoidal interference: tips of pinion and wheel overlap by {overlap_mm:.4} mm outside the path of contact (tip interference of DIN 3993)"
    )]
    TrochoidalInterference {
        /// Overlap along the ring's tip circle.
        overlap_mm: f64,
        /// Greatest tip diameter of the pinion without overlap.
        greatest_pinion_tip_mm: f64,
    },
    /// The cutter has as many teeth as the ring.
    #[error("a shaper cutter with {teeth} teeth does not fit into the wheel: at most {most}")]
    CutterTeeth {
        /// Number of teeth of the cutter.
        teeth: u32,
        /// Greatest number.
        most: u32,
    },
    /// Cutter and ring have no mesh without backlash.
    #[error("a shaper cutter with profile shift {profile_shift} has no mesh with the wheel: at most {greatest:.4}")]
    CutterShift {
        /// Profile shift of the cutter.
        profile_shift: f64,
        /// Greatest possible shift.
        greatest: f64,
    },
    /// The rounding of the cutter's tip edge does not fit on its tip.
    #[error("the cutter's tip edge of {tip_rounding_factor} modules does not fit on its tip: at most {greatest:.4}")]
    CutterTip {
        /// Radius of the tip edge, in normal modules.
        tip_rounding_factor: f64,
        /// Greatest possible radius.
        greatest: f64,
    },
    /// The rounding of the cutter's tip edge begins inside its pitch circle.
    #[error(
        "the cutter's tip of radius {tip_radius_mm:.4} mm does not reach beyond its pitch circle by its edge: at least {least_mm:.4} mm"
    )]
    CutterAddendum {
        /// Tip radius of the cutter, mm.
        tip_radius_mm: f64,
        /// Least tip radius, mm.
        least_mm: f64,
        /// Addendum factor.
        addendum_factor: f64,
        /// Least addendum factor.
        least_factor: f64,
    },
    /// The cutter cuts the ring's tips below its own involute.
    #[error("the cutter's involute ends at its base circle and leaves none on the wheel inside {least_mm:.4} mm")]
    CutterCutsTips {
        /// Tip diameter of the ring.
        tip_diameter_mm: f64,
        /// Least tip diameter.
        least_mm: f64,
    },
    /// The root circle leaves no space between the flanks.
    #[error("the wheel's root circle of {root_diameter_mm:.4} mm lies outside {least_mm:.4} to {greatest_mm:.4} mm")]
    Root {
        /// Root diameter.
        root_diameter_mm: f64,
        /// Base diameter.
        least_mm: f64,
        /// Diameter at which the flanks of a space meet.
        greatest_mm: f64,
    },
}
