//! How long all lines of contact are together while the gears turn.
//!
//! In the plane of action lines of contact are a transverse base pitch p_bt apart and oblique by β_b; teeth touch within its stretch A–E, ε_α p_bt
//! long and b wide. Where a line crosses the section at z, one of its place changes by ε_β p_bt over the face width. With n_α and n_β the
//! fractions of ε_α and ε_β, the number of lines in a section is ⌊ε_α⌋, and one more over the part n_α of every axial pitch p_x = b/ε_β. Over the
//! face width whole axial pitches have their share of that whatever the phase; what is left, n_β p_x, overlaps the part n_α of the circle of
//! one pitch by
//!
//! ```text
//! max(0, n_α + n_β − 1) p_x   at the least          min(n_α, n_β) p_x   at the most
//! l cos β_b = b ⌊ε_α⌋ + p_x (⌊ε_β⌋ n_α + overlap)     mean: ε_α b
//! ```
//!
//! The least is ε_α b − n_α n_β p_x where n_β ≤ 1 − n_α, and ε_α b − (1 − n_α)(1 − n_β) p_x elsewhere. Without overlap, ε_β = 0, all of a line
//! comes and goes at once. Contact outside A–E, at tip edges under load, is left out, as in the ratios themselves.
//!
//! Source: AGMA 908-B89, 4.6 (least length); ISO 21771:2007, 5.5; the greatest by the same geometry.

use super::GearPair;

/// Fractions below this are rounding of whole numbers.
const ROUND_OFF: f64 = 1e-12;

/// Length of all lines of contact together, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinesOfContact {
    /// At the phase where it is least.
    pub least_mm: f64,
    /// On average over the mesh.
    pub mean_mm: f64,
    /// At the phase where it is greatest.
    pub greatest_mm: f64,
}

/// Whole and fractional part of a contact ratio.
fn parts(ratio: f64) -> (f64, f64) {
    let whole = (ratio + ROUND_OFF).floor();
    (whole, (ratio - whole).max(0.0))
}

impl GearPair {
    /// Lengths of all lines of contact together, within A–E.
    pub fn lines_of_contact(&self) -> LinesOfContact {
        let along_line = |mm: f64| self.obliquity().along_line(mm);
        let width_mm = self.spec.face_width_mm;
        let (contact_ratio, overlap_ratio) = (self.path.contact_ratio(), self.overlap_ratio());
        let lengths =
            least_and_greatest_over_width(contact_ratio, overlap_ratio).map(|part| along_line(width_mm * part));
        let [least_mm, greatest_mm] = lengths;
        LinesOfContact { least_mm, mean_mm: along_line(contact_ratio * width_mm), greatest_mm }
    }
}

/// Least and greatest l cos β_b/b under these contact ratios ε_α and ε_β (≥ 0).
pub fn least_and_greatest_over_width(contact_ratio: f64, overlap_ratio: f64) -> [f64; 2] {
    let ((whole, part), (pitches, rest)) = (parts(contact_ratio), parts(overlap_ratio));
    if pitches == 0.0 && rest == 0.0 {
        return [whole, whole + if part > 0.0 { 1.0 } else { 0.0 }];
    }
    [(part + rest - 1.0).max(0.0), part.min(rest)].map(|overlap| whole + (pitches * part + overlap) / overlap_ratio)
}
