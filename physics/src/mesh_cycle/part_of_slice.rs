//! The contact of a slice that the line of contact has entered in part.
//!
//! The part f of the width carries its own line load w, under its own pressure and half-width. Loads and wear of slices are counted over
//! their whole width:
//!
//! ```text
//! W = f w          dW/ds = f dw/ds          depth = f k ∫ p ds
//! ```

use super::sliced_positions::ContactPart;
use crate::contact::{Footprint, PairContact, PointContact, PressedCell, Response, Sweep};
use gearwear_bodies::gear::{Gear, PerGear};

/// Contact of a part of a slice, counted over the width of the slice.
pub(crate) struct PartOfSlice<'a> {
    contact: Box<dyn PairContact + 'a>,
    part: ContactPart,
}

impl<'a> PartOfSlice<'a> {
    /// Contact of this `part` of a slice.
    pub(crate) fn of(contact: Box<dyn PairContact + 'a>, part: ContactPart) -> Box<dyn PairContact + 'a> {
        if part == ContactPart::WHOLE { contact } else { Box::new(PartOfSlice { contact, part }) }
    }
}

impl PairContact for PartOfSlice<'_> {
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>) {
        self.contact.set_removed(removed_mm);
    }

    fn touch_mm(&self) -> f64 {
        self.contact.touch_mm()
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        let Response { line_load_n_per_mm, stiffness_n_per_mm2 } = self.contact.load_at(indentation_mm);
        let part = self.part.of_width;
        Response { line_load_n_per_mm: part * line_load_n_per_mm, stiffness_n_per_mm2: part * stiffness_n_per_mm2 }
    }

    fn further_approach_mm(&self, line_load_n_per_mm: f64) -> (f64, f64) {
        let (approach, compliance) = self.contact.further_approach_mm(line_load_n_per_mm / self.part.of_width);
        (approach, compliance / self.part.of_width)
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.contact.ample_indentation_mm(line_load_n_per_mm)
    }

    fn window_suffices(&mut self, removed_mm: PerGear<&[f64]>) -> bool {
        self.contact.window_suffices(removed_mm)
    }

    fn widen(&mut self) {
        self.contact.widen();
    }

    fn overlap_beside_mm(&self, removed_mm: PerGear<&[f64]>) -> Option<f64> {
        self.contact.overlap_beside_mm(removed_mm)
    }

    fn reset(&mut self) {
        self.contact.reset();
    }

    fn sweep(&self, gear: Gear, removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        self.contact.sweep(gear, removed_mm, sweep);
        sweep.sliding_mm.iter_mut().for_each(|sliding| *sliding *= self.part.of_passage);
    }

    fn sweeps_across(&self) -> bool {
        self.contact.sweeps_across()
    }

    fn contact_of_points(&self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        self.contact.contact_of_points(gear, removed_mm)
    }

    fn footprint(&self) -> Footprint {
        self.contact.footprint()
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        self.contact.pressed_cells()
    }
}
