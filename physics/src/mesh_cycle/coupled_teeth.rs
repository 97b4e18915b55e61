//! Coupled teeth of a position in a Newton step: each as a plate ([`super::bent_tooth`]), or all together.
//!
//! In space, or on a shaft that twists, the contacts of all teeth are coupled by one matrix, u = U w ([`super::influence`]). With w the load of
//! a contact, c its tangent stiffness, h its approach so far without the deflection, and C the diagonal of the c, a Newton step with all
//! unknowns together is
//!
//! ```text
//! (I + √C U √C) y = (w − C h)/√c + δ √c          w⁺ = √C y          Σ w⁺ = F
//! ```

use faer::linalg::solvers::{Llt, PartialPivLu, Solve};
use faer::{Mat, Side};

use super::bent_tooth::{Bend, BentTooth, ContactTangent, bend};
use super::influence::Influence;
use super::slice_coupling::SliceCoupling;

/// Teeth of a position, with the coupling of their slices.
pub enum CoupledTeeth {
    /// Each tooth is a plate clamped at its root.
    Plates {
        /// Teeth.
        teeth: Vec<BentTooth>,
        /// Coupling of the slices of a tooth.
        coupling: SliceCoupling,
    },
    /// One matrix couples all teeth.
    Together(TeethTogether),
}

/// Teeth that one matrix couples.
pub struct TeethTogether {
    influence: Influence,
    deflection_mm: Vec<f64>,
}

impl TeethTogether {
    /// Teeth that are not yet bent.
    pub fn new(influence: Influence) -> Self {
        Self { deflection_mm: vec![0.0; influence.of_teeth.len()], influence }
    }

    fn bend(&mut self, line_load: f64, tangent: impl Fn(usize) -> ContactTangent) -> Option<Bend> {
        let (count, u) = (self.deflection_mm.len(), &self.influence.mm2_per_n);
        // Contacts without load do not take part in the step.
        let carrying: Vec<(usize, ContactTangent)> =
            (0..count).map(|k| (k, tangent(k))).filter(|(_, tangent)| tangent.n_per_mm2 > 0.0).collect();
        if carrying.is_empty() {
            return None;
        }
        let root: Vec<f64> = carrying.iter().map(|(_, tangent)| tangent.n_per_mm2.sqrt()).collect();
        let n = carrying.len();
        let matrix = Mat::from_fn(n, n, |i, j| {
            f64::from(u8::from(i == j)) + root[i] * u[carrying[i].0 * count + carrying[j].0] * root[j]
        });
        let given = Mat::from_fn(n, 2, |i, j| {
            let ContactTangent { line_load_n_per_mm: w, n_per_mm2: c, approach_mm } = carrying[i].1;
            if j == 0 { (w - c * approach_mm) / root[i] } else { root[i] }
        });
        // Positive definite unless elements and surface contradict each other locally, where a step is possible too.
        let solved = match Llt::new(matrix.as_ref(), Side::Lower) {
            Ok(factor) => factor.solve(&given),
            Err(_) => PartialPivLu::new(matrix.as_ref()).solve(&given),
        };
        let [carried, stiffness] = [0, 1].map(|j| (0..n).map(|i| root[i] * solved[(i, j)]).sum::<f64>());
        if stiffness <= 0.0 {
            return None;
        }
        let delta_mm = (line_load - carried) / stiffness;
        let load: Vec<f64> = (0..n).map(|i| root[i] * (solved[(i, 0)] + delta_mm * solved[(i, 1)])).collect();
        for (row, deflection) in u.chunks_exact(count).zip(&mut self.deflection_mm) {
            *deflection = carrying.iter().zip(&load).map(|((k, _), load)| row[*k] * load).sum();
        }
        Some(Bend { delta_mm, n_per_mm2: stiffness })
    }
}

impl CoupledTeeth {
    /// Straightens the teeth.
    pub(crate) fn straighten(&mut self) {
        match self {
            Self::Plates { teeth, .. } => teeth.iter_mut().for_each(BentTooth::straighten),
            Self::Together(teeth) => teeth.deflection_mm.fill(0.0),
        }
    }

    /// Bends the teeth by a Newton step towards a sum of line loads `line_load`, with the `tangent` of every contact by its number at
    /// the position; `None`, and nothing bent, where no contact carries.
    pub fn bend(&mut self, line_load: f64, tangent: impl Fn(usize) -> ContactTangent) -> Option<Bend> {
        match self {
            Self::Plates { teeth, coupling } => bend(teeth, coupling, line_load, tangent),
            Self::Together(teeth) => teeth.bend(line_load, tangent),
        }
    }

    /// Calls `take` for each contact with its number at the position, the compliance of the teeth there under its own load, mm²/N, and their
    /// deflection, mm.
    pub(crate) fn each_deflection_mm(&self, mut take: impl FnMut(usize, f64, f64)) {
        match self {
            Self::Plates { teeth, .. } => {
                teeth.iter().flat_map(BentTooth::deflections_mm).for_each(|(k, mm2_per_n, mm)| take(k, mm2_per_n, mm));
            }
            Self::Together(TeethTogether { influence, deflection_mm, .. }) => {
                let contacts = influence.of_teeth.iter().zip(deflection_mm).enumerate();
                contacts.for_each(|(k, (mm2_per_n, mm))| take(k, *mm2_per_n, *mm));
            }
        }
    }
}
