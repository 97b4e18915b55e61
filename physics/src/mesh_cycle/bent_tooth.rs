//! Teeth of a position as plates, in a Newton step.
//!
//! The deflections u of the slices of one tooth follow from all loads on it through the operator K of [`super::slice_coupling`], K v = √q w
//! with u = √q v. With w the load of a contact, c its tangent stiffness, and h its approach so far, deflection included, one step of
//! Newton's method with all unknowns together is
//!
//! ```text
//! (K + diag(q c)) Δv = √q w − K v + √q c (δ − h)          Σ w + Σ c (δ − h − √q Δv) = F
//! ```
//!
//! The matrix has two bands beside its diagonal, so that a step costs no more than pressing the contacts once. K v = √q w then holds for
//! the corrected loads exactly: only the contacts are nonlinear.

use super::slice_coupling::{Factors, SliceCoupling};
use super::sliced_positions::SliceContact;

/// A contact, linearised for a Newton step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactTangent {
    /// w.
    pub line_load_n_per_mm: f64,
    /// c; 0 without contact.
    pub n_per_mm2: f64,
    /// h without the deflection of the teeth, from any common approach.
    pub approach_mm: f64,
}

/// A tooth at a position.
#[derive(Debug, Clone)]
pub struct BentTooth {
    /// Number of its first contact among those of the position.
    first: usize,
    /// Slice and √q of each of its contacts.
    contacts: Vec<(usize, f64)>,
    /// v of every slice, in contact or not.
    v: Vec<f64>,
    diagonal: Vec<f64>,
    /// Change of v at δ = 0.
    fixed: Vec<f64>,
    /// Change of v with δ.
    with_approach: Vec<f64>,
    factors: Factors,
}

impl BentTooth {
    /// Teeth of `contacts`, tooth by tooth, not yet bent; each has so many `slices`, and the compliance `mm2_per_n` at a contact.
    pub fn of_contacts(
        contacts: &[SliceContact],
        slices: usize,
        mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Vec<Self> {
        let mut teeth: Vec<Self> = Vec::new();
        for of_tooth in contacts.chunk_by(|a, b| a.tooth == b.tooth) {
            let zeros = vec![0.0; slices];
            teeth.push(Self {
                first: teeth.last().map_or(0, |tooth| tooth.first + tooth.contacts.len()),
                contacts: of_tooth.iter().map(|contact| (contact.slice, mm2_per_n(contact).sqrt())).collect(),
                v: zeros.clone(),
                diagonal: zeros.clone(),
                fixed: zeros.clone(),
                with_approach: zeros,
                factors: Factors::default(),
            });
        }
        teeth
    }

    /// Straightens the tooth.
    pub(crate) fn straighten(&mut self) {
        self.v.fill(0.0);
    }

    /// Contacts by their number at the position, with the compliance of the tooth there, mm²/N, and its deflection, mm.
    pub(crate) fn deflections_mm(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let contacts = self.contacts.iter().enumerate();
        contacts.map(|(k, &(slice, root))| (self.first + k, root * root, root * self.v[slice]))
    }

    /// Prepares Δv as fixed + δ · with_approach, and adds the load of the contacts at δ = 0 and its derivative by δ.
    fn linearise(
        &mut self,
        coupling: &SliceCoupling,
        tangent: &impl Fn(usize) -> ContactTangent,
        (carried, stiffness): (&mut f64, &mut f64),
    ) {
        self.diagonal.fill(0.0);
        self.with_approach.fill(0.0);
        coupling.apply(&self.v, &mut self.fixed);
        self.fixed.iter_mut().for_each(|value| *value = -*value);
        for (k, &(slice, root)) in self.contacts.iter().enumerate() {
            let ContactTangent { line_load_n_per_mm: w, n_per_mm2: c, approach_mm } = tangent(self.first + k);
            self.diagonal[slice] = root * root * c;
            self.with_approach[slice] = root * c;
            self.fixed[slice] += root * (w - c * (approach_mm + root * self.v[slice]));
        }
        coupling.factorise(&self.diagonal, &mut self.factors);
        self.factors.solve(&mut self.fixed);
        self.factors.solve(&mut self.with_approach);
        for (k, &(slice, root)) in self.contacts.iter().enumerate() {
            let ContactTangent { line_load_n_per_mm: w, n_per_mm2: c, approach_mm } = tangent(self.first + k);
            *carried += w - c * (approach_mm + root * (self.v[slice] + self.fixed[slice]));
            *stiffness += c * (1.0 - root * self.with_approach[slice]);
        }
    }
}

/// Result of a Newton step.
pub struct Bend {
    /// δ, counted as the approaches of the contacts, mm.
    pub delta_mm: f64,
    /// dF/dδ at the beginning of the step, N/mm².
    pub n_per_mm2: f64,
}

/// Bends the teeth by a Newton step towards a sum of line loads `line_load`, with the `tangent` of every contact by its number at the
/// position; `None`, and nothing bent, where no contact carries.
pub fn bend(
    teeth: &mut [BentTooth],
    coupling: &SliceCoupling,
    line_load: f64,
    tangent: impl Fn(usize) -> ContactTangent,
) -> Option<Bend> {
    // Σ w + Σ c (δ − h − √q Δv) = F, collected by δ.
    let (mut carried, mut stiffness) = (0.0, 0.0);
    for tooth in &mut *teeth {
        tooth.linearise(coupling, &tangent, (&mut carried, &mut stiffness));
    }
    if stiffness <= 0.0 {
        return None;
    }
    let delta_mm = (line_load - carried) / stiffness;
    for tooth in teeth {
        let changes = tooth.fixed.iter().zip(&tooth.with_approach);
        for (v, (fixed, with_approach)) in tooth.v.iter_mut().zip(changes) {
            *v += fixed + delta_mm * with_approach;
        }
    }
    Some(Bend { delta_mm, n_per_mm2: stiffness })
}
