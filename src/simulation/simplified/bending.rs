//! The teeth of a phase where their slices hold each other.
//!
//! As in [`crate::working_cycle::sliced_sharing`], with the contacts of [`super::station`]: with √q v = u the deflection of the teeth at a
//! contact, and K the operator of [`crate::working_cycle::slice_coupling`],
//!
//! ```text
//! (K + diag(q c)) Δv = √q w − K v + √q c (δ − h)          Σ w + Σ c (δ − h − √q Δv) = F
//! ```
//!
//! K v = √q w then holds for the corrected loads exactly; only the contacts are nonlinear.

use super::lanes::LANES;
use super::station::{Pack, Tangent};
use crate::working_cycle::slice_coupling::{Factors, SliceCoupling};

/// The teeth of a phase.
#[derive(Debug, Clone)]
pub struct BentTeeth {
    teeth: Vec<BentTooth>,
    coupling: SliceCoupling,
}

/// A tooth.
#[derive(Debug, Clone)]
struct BentTooth {
    /// The first of its contacts among those of the phase.
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

impl BentTeeth {
    /// Teeth whose contacts, tooth by tooth, have slices and √q.
    pub fn new(contacts_of_teeth: Vec<Vec<(usize, f64)>>, slices: usize, coupling: &SliceCoupling) -> Self {
        let mut first = 0;
        let teeth = contacts_of_teeth.into_iter().map(|contacts| {
            let begins = first;
            first += contacts.len();
            let zeros = || vec![0.0; slices];
            let (v, diagonal, fixed, with_approach) = (zeros(), zeros(), zeros(), zeros());
            BentTooth { first: begins, contacts, v, diagonal, fixed, with_approach, factors: Factors::default() }
        });
        Self { teeth: teeth.collect(), coupling: coupling.clone() }
    }

    /// Bends the teeth for the Newton step of `tangents`, adds their deflection to its approaches, and gives δ.
    pub fn bend(&mut self, packs: &[Pack], tangents: &mut [Tangent], line_load: f64) -> f64 {
        // Σ w + Σ c (δ − h − √q Δv) = F, collected by δ.
        let (mut carried, mut stiffness) = (0.0, 0.0);
        for tooth in &mut self.teeth {
            tooth.linearise(&self.coupling, packs, tangents);
            for (k, &(slice, root)) in tooth.contacts.iter().enumerate() {
                let (pack, lane) = ((tooth.first + k) / LANES, (tooth.first + k) % LANES);
                let tangent = &tangents[pack];
                let (c, h) = (tangent.n_per_mm2.0[lane], tangent.approach_mm.0[lane] + root * tooth.v[slice]);
                carried += packs[pack].load.0[lane] - c * (h + root * tooth.fixed[slice]);
                stiffness += c * (1.0 - root * tooth.with_approach[slice]);
            }
        }
        let approach_mm = (line_load - carried) / stiffness;
        for tooth in &mut self.teeth {
            let changes = tooth.fixed.iter().zip(&tooth.with_approach);
            for (v, (fixed, with_approach)) in tooth.v.iter_mut().zip(changes) {
                *v += fixed + approach_mm * with_approach;
            }
            for (k, &(slice, root)) in tooth.contacts.iter().enumerate() {
                let at = tooth.first + k;
                tangents[at / LANES].approach_mm.0[at % LANES] += root * tooth.v[slice];
            }
        }
        approach_mm
    }
}

impl BentTooth {
    /// Prepares Δv as fixed + δ · with_approach.
    fn linearise(&mut self, coupling: &SliceCoupling, packs: &[Pack], tangents: &[Tangent]) {
        self.diagonal.fill(0.0);
        self.with_approach.fill(0.0);
        coupling.apply(&self.v, &mut self.fixed);
        self.fixed.iter_mut().for_each(|value| *value = -*value);
        for (k, &(slice, root)) in self.contacts.iter().enumerate() {
            let (pack, lane) = ((self.first + k) / LANES, (self.first + k) % LANES);
            let tangent = &tangents[pack];
            let (c, h) = (tangent.n_per_mm2.0[lane], tangent.approach_mm.0[lane] + root * self.v[slice]);
            self.diagonal[slice] = root * root * c;
            self.with_approach[slice] = root * c;
            self.fixed[slice] += root * (packs[pack].load.0[lane] - c * h);
        }
        coupling.factorise_into(&self.diagonal, &mut self.factors);
        self.factors.solve(&mut self.fixed);
        self.factors.solve(&mut self.with_approach);
    }
}
