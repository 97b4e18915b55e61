//! Compliance between all contacts at a position, u = U w: of thin slices, of plates ([`super::slice_coupling`]) or of teeth in space
//! ([`super::pair_in_space`]), and of the shafts ([`gearwear_bodies::gear::shaft`]).

use super::sliced_positions::SliceContact;

/// Compliance between the contacts at a position.
pub struct Influence {
    /// Compliance between all of them by line load, mm²/N, row by row.
    pub mm2_per_n: Vec<f64>,
    /// Diagonal of the teeth alone, mm²/N: in space, that of their finite elements.
    pub of_teeth: Vec<f64>,
}

impl Influence {
    /// Uncoupled thin slices with the compliance `mm2_per_n` at a contact.
    pub(crate) fn of_thin_slices(contacts: &[SliceContact], mm2_per_n: impl Fn(&SliceContact) -> f64) -> Self {
        let count = contacts.len();
        let of_teeth: Vec<f64> = contacts.iter().map(mm2_per_n).collect();
        let mut coupling = vec![0.0; count * count];
        of_teeth.iter().enumerate().for_each(|(k, own)| coupling[k * (count + 1)] = *own);
        Self { mm2_per_n: coupling, of_teeth }
    }

    /// Adds a compliance by two contacts, mm²/N.
    pub fn add(&mut self, mm2_per_n: impl Fn(usize, usize) -> f64) {
        let count = self.of_teeth.len();
        self.mm2_per_n.iter_mut().enumerate().for_each(|(k, own)| *own += mm2_per_n(k / count, k % count));
    }
}
