//! Total length of the lines of contact over the mesh.
//!
//! In the plane of action the lines of contact have the distance of a transverse base pitch p_bt and the angle β_b; teeth touch within A–E, ε_α p_bt
//! long and b wide. The position of a line changes by ε_β p_bt over the face width. With n_α and n_β the
//! fractional parts of ε_α and ε_β, the number of lines in a section is ⌊ε_α⌋, and one more over the fraction n_α of every axial pitch p_x = b/ε_β.
//! Whole axial pitches contribute the same at any position; the remaining width n_β p_x overlaps the fraction n_α of
//! one pitch by
//!
//! ```text
//! max(0, n_α + n_β − 1) p_x   at the least          min(n_α, n_β) p_x   at the most
//! l cos β_b = b ⌊ε_α⌋ + p_x (⌊ε_β⌋ n_α + overlap)     mean: ε_α b
//! ```
//!
//! The least is ε_α b − n_α n_β p_x where n_β ≤ 1 − n_α, and ε_α b − (1 − n_α)(1 − n_β) p_x elsewhere. For ε_β = 0 lines begin and end over the
//! whole face width at once. Contact outside A–E, at tip edges under load, is not included, as in the contact ratios.
//!
//! Source: AGMA 908-B89, 4.6 (least length); ISO 21771:2007, 5.5; the greatest length by the same geometry.

use super::GearPair;

/// Round-off of contact ratios that are whole numbers.
const ROUND_OFF: f64 = 1e-12;

/// Total length of the lines of contact, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinesOfContact {
    /// Least length over the mesh.
    pub least_mm: f64,
    /// Mean length over the mesh.
    pub mean_mm: f64,
    /// Greatest length over the mesh.
    pub greatest_mm: f64,
}

/// Whole and fractional part of a contact ratio.
fn parts(ratio: f64) -> (f64, f64) {
    let whole = (ratio + ROUND_OFF).floor();
    (whole, (ratio - whole).max(0.0))
}

impl GearPair {
    /// Total length of the lines of contact within A–E.
    pub fn lines_of_contact(&self) -> LinesOfContact {
        let width_mm = self.spec.face_width_mm;
        let (contact_ratio, overlap_ratio) = (self.path.contact_ratio(), self.overlap_ratio());
        let [least, greatest] = least_and_greatest_over_width(contact_ratio, overlap_ratio);
        let [least_mm, mean_mm, greatest_mm] = [width_mm * least, contact_ratio * width_mm, width_mm * greatest]
            .map(|over_width_mm| self.obliquity().along_line(over_width_mm));
        LinesOfContact { least_mm, mean_mm, greatest_mm }
    }
}

/// Least and greatest l cos β_b/b for the contact ratios ε_α and ε_β (≥ 0).
pub fn least_and_greatest_over_width(contact_ratio: f64, overlap_ratio: f64) -> [f64; 2] {
    let ((whole, part), (pitches, rest)) = (parts(contact_ratio), parts(overlap_ratio));
    if pitches == 0.0 && rest == 0.0 {
        return [whole, whole + if part > 0.0 { 1.0 } else { 0.0 }];
    }
    [(part + rest - 1.0).max(0.0), part.min(rest)].map(|overlap| whole + (pitches * part + overlap) / overlap_ratio)
}
