//! The face width cut into thin transverse slices.
//!
//! A helical tooth is a stack of thin spur teeth, each turned a little against the one before. In the transverse section of
//! slice i at the axial place z_i the theoretical contact point runs along the same path A–E as in every other, but is there
//! earlier or later: with ξ the position in the middle of the face width,
//!
//! ```text
//! ξ_i = ξ + (b/2 − z_i) tan β_b        tan β_b = tan β cos α_t        b tan β_b = ε_β p_bt
//! ```
//!
//! so that for a positive helix angle the slice at z = 0 enters the mesh first. At any moment the contact points of one tooth
//! lie on a straight line, oblique on the flank by β_b: its line of contact, l / cos β_b long where it spans the width l.
//!
//! All quantities of a slice are transverse ones.
//!
//! Source: ISO 21771, sections 5.4 and 5.5.

use super::GearPair;

/// Slices of the same width, from z = 0 to z = b.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Slices {
    /// Place of each over the face width: its middle.
    pub width_mm: Vec<f64>,
    /// How far its theoretical contact point is ahead of that in the middle of the face width, along the path of contact.
    pub ahead_mm: Vec<f64>,
    /// Width of each.
    pub slice_width_mm: f64,
    /// By how much the theoretical contact point of a section is further ahead at one side of a slice than at the other.
    pub ahead_varies_mm: f64,
}

impl Slices {
    /// `count` (≥ 1) slices over the face width of `pair`.
    pub(crate) fn new(pair: &GearPair, count: usize) -> Self {
        let face_width = pair.spec.face_width_mm;
        let slice_width_mm = face_width / count as f64;
        let width_mm: Vec<f64> = (0..count).map(|i| (i as f64 + 0.5) * slice_width_mm).collect();
        let tan_beta_b = pair.base_helix_angle_rad().tan();
        let ahead_mm = width_mm.iter().map(|z| (0.5 * face_width - z) * tan_beta_b).collect();
        Self { width_mm, ahead_mm, slice_width_mm, ahead_varies_mm: slice_width_mm * tan_beta_b.abs() }
    }

    /// How many.
    pub(crate) fn count(&self) -> usize {
        self.width_mm.len()
    }
}
