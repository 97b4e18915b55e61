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
    Together(Box<TeethTogether>),
}

/// Teeth that one matrix couples.
pub struct TeethTogether {
    influence: Influence,
    deflection_mm: Vec<f64>,
    /// Matrix of the last step.
    kept: Option<FactoredStep>,
    /// Number of matrices factorised so far.
    factorisations: u64,
    /// Number of steps so far whose matrix was not positive definite.
    indefinite: u64,
}

/// Factorised matrix of a Newton step.
struct FactoredStep {
    /// Contacts that carry.
    carrying: Vec<usize>,
    /// √c of each.
    root: Vec<f64>,
    factor: StepFactor,
    /// Product of the inverse with √c.
    by_approach: Vec<f64>,
}

/// Factor of I + √C U √C.
enum StepFactor {
    /// Positive definite.
    Definite(Llt<f64>),
    /// Elements and surface contradict each other locally; a step is possible too.
    Indefinite(PartialPivLu<f64>),
}

impl StepFactor {
    fn solve(&self, side: impl ExactSizeIterator<Item = f64>) -> Vec<f64> {
        let mut column = Mat::zeros(side.len(), 1);
        column.col_mut(0).iter_mut().zip(side).for_each(|(to, from)| *to = from);
        match self {
            Self::Definite(factor) => factor.solve_in_place(column.as_mut()),
            Self::Indefinite(factor) => factor.solve_in_place(column.as_mut()),
        }
        column.col(0).iter().copied().collect()
    }
}

impl FactoredStep {
    fn new(influence: &Influence, carrying: Vec<usize>, root: Vec<f64>) -> Self {
        let (n, count, u) = (carrying.len(), influence.of_teeth.len(), &influence.mm2_per_n);
        let matrix = Mat::from_fn(n, n, |i, j| {
            f64::from(u8::from(i == j)) + root[i] * u[carrying[i] * count + carrying[j]] * root[j]
        });
        let factor = match Llt::new(matrix.as_ref(), Side::Lower) {
            Ok(factor) => StepFactor::Definite(factor),
            Err(_) => StepFactor::Indefinite(PartialPivLu::new(matrix.as_ref())),
        };
        let by_approach = factor.solve(root.iter().copied());
        Self { carrying, root, factor, by_approach }
    }
}

impl TeethTogether {
    /// Teeth that are not yet bent.
    pub fn new(influence: Influence) -> Self {
        Self {
            deflection_mm: vec![0.0; influence.of_teeth.len()],
            influence,
            kept: None,
            factorisations: 0,
            indefinite: 0,
        }
    }

    /// Number of matrices factorised so far.
    pub fn factorisations(&self) -> u64 {
        self.factorisations
    }

    fn bend(&mut self, line_load: f64, tangent: impl Fn(usize) -> ContactTangent) -> Option<Bend> {
        let (count, u) = (self.deflection_mm.len(), &self.influence.mm2_per_n);
        // Contacts without load do not take part in the step.
        let (carrying, tangents): (Vec<usize>, Vec<ContactTangent>) =
            (0..count).map(|k| (k, tangent(k))).filter(|(_, tangent)| tangent.n_per_mm2 > 0.0).unzip();
        if carrying.is_empty() {
            return None;
        }
        let root: Vec<f64> = tangents.iter().map(|tangent| tangent.n_per_mm2.sqrt()).collect();
        // As long as no cell enters or leaves a contact, the tangents stay the same.
        let kept = self.kept.take().filter(|kept| kept.carrying == carrying && kept.root == root);
        let step = kept.unwrap_or_else(|| {
            self.factorisations += 1;
            FactoredStep::new(&self.influence, carrying, root)
        });
        self.indefinite += u64::from(matches!(step.factor, StepFactor::Indefinite(_)));
        let FactoredStep { carrying, root, factor, by_approach } = &*self.kept.insert(step);
        let given = tangents
            .iter()
            .zip(root)
            .map(|(tangent, root)| (tangent.line_load_n_per_mm - tangent.n_per_mm2 * tangent.approach_mm) / root);
        let by_load = factor.solve(given);
        let [carried, stiffness] =
            [&by_load, by_approach].map(|of| root.iter().zip(of).map(|(root, value)| root * value).sum::<f64>());
        if stiffness <= 0.0 {
            return None;
        }
        let delta_mm = (line_load - carried) / stiffness;
        let load = root.iter().zip(by_load.iter().zip(by_approach));
        let load: Vec<f64> =
            load.map(|(root, (by_load, by_approach))| root * (by_load + delta_mm * by_approach)).collect();
        for (row, deflection) in u.chunks_exact(count).zip(&mut self.deflection_mm) {
            *deflection = carrying.iter().zip(&load).map(|(k, load)| row[*k] * load).sum();
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

    /// Number of steps so far whose matrix was not positive definite, so that some loads would have grown by giving way.
    pub(crate) fn indefinite_steps(&self) -> u64 {
        match self {
            Self::Plates { .. } => 0,
            Self::Together(teeth) => teeth.indefinite,
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
            Self::Together(teeth) => {
                let contacts = teeth.influence.of_teeth.iter().zip(&teeth.deflection_mm).enumerate();
                contacts.for_each(|(k, (mm2_per_n, mm))| take(k, *mm2_per_n, *mm));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps with the same tangents factorise one matrix, others a new one; the loads of both balance on the bent teeth.
    #[test]
    fn ver_a_matrix_is_factorised_once_for_the_same_tangents() {
        let count = 5;
        let coupling = |k: usize| 1e-5 * (-((k / count).abs_diff(k % count) as f64)).exp();
        let mm2_per_n: Vec<f64> = (0..count * count).map(coupling).collect();
        let mut teeth = TeethTogether::new(Influence { mm2_per_n: mm2_per_n.clone(), of_teeth: vec![1e-5; count] });
        let mut bend = |line_load: f64, n_per_mm2: f64| {
            let tangent = |k: usize| ContactTangent {
                line_load_n_per_mm: 100.0 + 10.0 * k as f64,
                n_per_mm2: if k == 3 { 0.0 } else { n_per_mm2 },
                approach_mm: 1e-3,
            };
            let Bend { delta_mm, .. } = teeth.bend(line_load, tangent).unwrap();
            let loads: Vec<f64> = (0..count)
                .map(|k| {
                    let ContactTangent { line_load_n_per_mm, n_per_mm2, approach_mm } = tangent(k);
                    let further = n_per_mm2 * (delta_mm - approach_mm - teeth.deflection_mm[k]);
                    if n_per_mm2 > 0.0 { line_load_n_per_mm + further } else { 0.0 }
                })
                .collect();
            assert!((loads.iter().sum::<f64>() / line_load - 1.0).abs() < 1e-12);
            for (row, deflection_mm) in mm2_per_n.chunks_exact(count).zip(&teeth.deflection_mm) {
                let bent_mm: f64 = row.iter().zip(&loads).map(|(u, load)| u * load).sum();
                assert!((bent_mm / deflection_mm - 1.0).abs() < 1e-12, "{bent_mm} {deflection_mm}");
            }
            teeth.factorisations()
        };
        let counts =
            [(500.0, 1e5), (700.0, 1e5), (700.0, 2e5), (650.0, 2e5), (650.0, 1e5)].map(|(load, c)| bend(load, c));
        assert_eq!(counts, [1, 1, 2, 2, 3]);
    }
}
