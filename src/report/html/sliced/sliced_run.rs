//! A run with slices.

use crate::report::html::number::given;
use gearwear_physics::results::run::{FlankRecord, HelicalSummary, RunRecord, SliceRecord};

/// A run with slices: the whole record, and the parts of it that are there.
#[derive(Clone, Copy)]
pub(crate) struct SlicedRun<'a> {
    pub record: &'a RunRecord,
    /// The mesh of one tooth slice by slice.
    pub slices: &'a SliceRecord,
    pub helical: &'a HelicalSummary,
}

impl<'a> SlicedRun<'a> {
    /// None where all sections of `record` are alike.
    pub(crate) fn of(record: &'a RunRecord) -> Option<Self> {
        let (slices, helical) = (record.slices.as_ref()?, record.summary.helical.as_ref()?);
        Some(Self { record, slices, helical })
    }
}

/// "slice 3 (2.5 mm)": its number from 1 on and its place over the face width.
pub(crate) fn slice_name(flank: &FlankRecord, slice: usize) -> String {
    format!("slice {} ({} mm)", slice + 1, given((flank.width_mm[slice] * 1e3).round() / 1e3))
}
