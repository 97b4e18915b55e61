//! How the slices of a pair yield together, fitted to its teeth in space.
//!
//! Slices that are thin teeth, or hold each other as plates ([`crate::mesh_cycle::slice_coupling`]), take from the transverse section what it
//! tells. The rest is fitted: how much softer oblique teeth and their end faces are, how far a deflection reaches along a tooth, how much
//! less teeth resist twisting where they end, and what all teeth in mesh share. What counts are the loads. At some phases of the mesh,
//! contacts with the compliance c of their flattening share the load of aligned and of tilted axes,
//!
//! ```text
//! (U + C) w = δ (1 + g t)          g = 0, ±½          t = −1 … 1 over the face width
//! ```
//!
//! Teeth that yield by u = U_plates w instead of U w share the same load otherwise, to first order by
//!
//! ```text
//! Δw = −[A − A 1 1ᵀA/(1ᵀA 1)] (U_plates − U) w          Δδ = 1ᵀA (U_plates − U) w/(1ᵀA 1)          A = (U + C)⁻¹
//! ```
//!
//! and the parameters are those with the least sum of squares of Δw over the mean load, of Δδ/δ, and of U_plates − U on single lines of
//! contact that are loaded evenly, by Levenberg and Marquardt's method from the closed forms. What none of them tells stays there.
//!
//! Source: D. W. Marquardt, *J. SIAM* 11 (1963) 431–441.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::STIFFNESS_POSITIONS;
use super::identity::same;
use crate::contact::{half_space::HalfSpace, hertz};
use crate::gear::{GearPair, PerGear, slices::Slices};
use crate::material::Material;
use crate::mesh_cycle::pair_in_space::PairInSpace;
use crate::mesh_cycle::slice_coupling::{Factors, Reach, SliceCompliance};
use crate::mesh_cycle::sliced::SpringAlongPath;
use crate::mesh_cycle::sliced_positions::{SliceContact, SliceEnds, sliced_positions};
use crate::stiffness::settings::StiffnessSettings;
use crate::stiffness::{SpringParts, StiffnessError, TeethSpring, curve::PairCompliance};

/// Slices of the fit.
pub const SLICES: usize = 20;
/// Positions from A to E.
const POSITIONS: usize = 16;
/// Unknowns of the fit: teeth, both ends, both reaches, bodies, length of the ends, resistance to twisting at both.
const UNKNOWNS: usize = 9;
/// How the approach varies over the face width, and the weight of the loads: they are aligned first of all.
const APPROACHES: [(f64, f64); 3] = [(0.0, 1.0), (0.5, 0.1), (-0.5, 0.1)];
/// Weight of the approach itself over that of a load, which are dozens.
const APPROACH_WEIGHT: f64 = 60.0;
/// Weight of the deflection of single lines of contact.
const SINGLE_LINE_WEIGHT: f64 = 0.1;
/// Weight of the closed forms.
const CLOSED_FORM_WEIGHT: f64 = 0.002;
/// What end faces take from the resistance to twisting where the fit begins.
const END_TWIST: f64 = 3.0;
/// Over which length that decays, in transverse modules: what it is within the first third of a module, none or little, the fit can tell; how sharply it
/// rises then it cannot.
const END_TWIST_MODULES: f64 = 0.1;
/// Steps at the most; ten are usual.
const MOST_STEPS: usize = 60;
/// Step of the difference quotients.
const DIFFERENCE: f64 = 1e-6;
/// Decrease of the sum of squares, relative, that ends the fit.
const SETTLED: f64 = 1e-9;

/// What slices have from the teeth in space of one pair.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliceFit {
    /// β of the pair it was made of.
    pub helix_angle_deg: f64,
    /// b.
    pub face_width_mm: f64,
    /// The parameters.
    pub compliance: SliceCompliance,
    /// Root mean square of the differences in load on aligned axes, over the mean load; in files of before, of differences in deflection.
    pub residual: f64,
}

impl SliceFit {
    /// Whether it is of `pair`, whose transverse section it is known to have.
    pub fn is_of(&self, pair: &GearPair) -> bool {
        let spec = &pair.spec;
        same(self.helix_angle_deg, spec.helix_angle_rad.to_degrees()) && same(self.face_width_mm, spec.face_width_mm)
    }
}

/// Contacts of one tooth at a phase.
struct LineOfContact {
    first: usize,
    slices: Vec<usize>,
    /// Compliance of the section where each touches, mm²/N.
    mm2_per_n: Vec<f64>,
}

/// A load of a phase, and what it deflects.
struct LoadCase {
    n_per_mm: DVector<f64>,
    deflection_mm: DVector<f64>,
    /// What counts of a difference in deflection; on aligned axes, first the loads.
    reads: DMatrix<f64>,
    is_aligned: bool,
}

struct Phase {
    lines: Vec<LineOfContact>,
    cases: Vec<LoadCase>,
}

/// What the plates of all phases are held against.
struct Fit<'a> {
    pair: &'a GearPair,
    slices: Slices,
    phases: Vec<Phase>,
    /// Compliance of what pairs share, mm²/N.
    shared_mm2_per_n: f64,
    /// The closed forms.
    start: SliceCompliance,
}

/// Fits the slices of `pair`, of which `curve` tells the stiffness of the transverse section, under a line load.
pub fn fit(
    pair: &GearPair,
    material: &PerGear<Material>,
    in_space: &PairInSpace,
    curve: &PairCompliance,
    line_load_n_per_mm: f64,
) -> Result<SliceFit, StiffnessError> {
    let surface = HalfSpace { material: *material, expected_line_load_n_per_mm: line_load_n_per_mm };
    let teeth = TeethSpring::new(StiffnessSettings::Fem, Some(curve), pair, material, &surface, line_load_n_per_mm)?;
    let slices = Slices::new(pair, SLICES);
    // The whole spring, which teeth in space have beside the surface, and what slices have of it to themselves.
    let along = |spring: &dyn Fn(f64) -> Result<SpringParts, StiffnessError>| {
        SpringAlongPath::new(&pair.path, STIFFNESS_POSITIONS, [0.0; 2], spring)
    };
    let whole = along(&|at| teeth.oblique_parts(at))?;
    let own = along(&|at| teeth.own_parts(at))?;
    let section = pair.normal_section();
    let mut phases = Vec::new();
    for phase in sliced_positions(&pair.path, &slices, POSITIONS, SliceEnds::AtOnce) {
        let contacts = &phase.contacts;
        let at = |contact: &SliceContact| contact.cell.position_mm;
        let influence =
            in_space.influence(pair, &slices, contacts, |contact| whole.at(at(contact)).mm2_per_n(1.0)).mm2_per_n;
        let mut first = 0;
        let lines: Vec<LineOfContact> = contacts
            .chunk_by(|a, b| a.tooth == b.tooth)
            .map(|of_tooth| {
                let begins = first;
                first += of_tooth.len();
                let mm2_per_n = of_tooth.iter().map(|contact| own.at(at(contact)).teeth_mm2_per_n).collect();
                LineOfContact {
                    first: begins,
                    slices: of_tooth.iter().map(|contact| contact.slice).collect(),
                    mm2_per_n,
                }
            })
            .collect();
        let load_n_per_mm = line_load_n_per_mm * SLICES as f64 / contacts.len() as f64;
        let flattening = contacts
            .iter()
            .map(|contact| hertz::flattening(&section, material, at(contact)).approach_and_compliance(load_n_per_mm).1)
            .map(|along_normal| section.obliquity.transverse_mm(along_normal));
        let tilt: Vec<f64> = contacts
            .iter()
            .map(|contact| 2.0 * slices.width_mm[contact.slice] / pair.spec.face_width_mm - 1.0)
            .collect();
        let influence = DMatrix::from_row_slice(contacts.len(), contacts.len(), &influence);
        let cases = loads(&lines, &influence, &flattening.collect::<Vec<_>>(), &tilt);
        phases.push(Phase { cases, lines });
    }
    let start = SliceCompliance::of_plates(pair, material, true);
    let fit = Fit { pair, slices, phases, shared_mm2_per_n: teeth.shared_mm2_per_n(), start };
    let (compliance, residual) = fit.solve();
    let spec = &pair.spec;
    Ok(SliceFit {
        helix_angle_deg: spec.helix_angle_rad.to_degrees(),
        face_width_mm: spec.face_width_mm,
        compliance,
        residual,
    })
}

/// The loads of the approaches, aligned ones first, with a mean of 1 N/mm; then each line by itself.
fn loads(lines: &[LineOfContact], influence: &DMatrix<f64>, flattening: &[f64], tilt: &[f64]) -> Vec<LoadCase> {
    let count = flattening.len();
    let mut cases = Vec::new();
    let whole = influence + DMatrix::from_diagonal(&DVector::from_column_slice(flattening));
    // Loads that the surfaces cannot decide on tell nothing.
    if let Some(inverse) = whole.try_inverse() {
        let even = inverse.column_sum();
        let approach_mm = count as f64 / even.sum();
        let of_loads = &even * even.transpose() / even.sum() - &inverse;
        for (slope, weight) in APPROACHES {
            let mm = DVector::from_fn(count, |k, _| approach_mm * (1.0 + slope * tilt[k]));
            let n_per_mm = &inverse * mm;
            let mut reads = (weight * &of_loads).insert_row(count, 0.0);
            reads.set_row(count, &(even.transpose() * (weight * APPROACH_WEIGHT / count as f64)));
            cases.push(LoadCase { deflection_mm: influence * &n_per_mm, n_per_mm, reads, is_aligned: slope == 0.0 });
        }
    }
    cases.extend(lines.iter().map(|line| {
        let loaded = line.first..line.first + line.slices.len();
        let n_per_mm = DVector::from_fn(count, |k, _| f64::from(u8::from(loaded.contains(&k))));
        let deflection_mm = influence * &n_per_mm;
        let reads = DMatrix::from_diagonal_element(count, count, SINGLE_LINE_WEIGHT / deflection_mm.norm());
        LoadCase { n_per_mm, deflection_mm, reads, is_aligned: false }
    }));
    cases
}

impl Fit<'_> {
    fn compliance(&self, x: &SVector<f64, UNKNOWNS>) -> SliceCompliance {
        let start = &self.start;
        SliceCompliance {
            teeth: start.teeth * x[0].exp(),
            ends: [x[1].exp_m1(), x[2].exp_m1()],
            reach: Reach {
                twist_mm2: start.reach.twist_mm2 * x[3].exp(),
                bending_mm4: start.reach.bending_mm4 * x[4].exp(),
            },
            bodies: x[5].exp(),
            end_length_mm: start.end_length_mm * x[6].exp(),
            end_twist_length_mm: Some(END_TWIST_MODULES * self.pair.spec.transverse_module_mm()),
            end_twist: Some([x[7], x[8]].map(|part| END_TWIST * part.exp())),
        }
    }

    /// What is left of all phases and loads, and of the closed forms.
    fn residuals(&self, x: &SVector<f64, UNKNOWNS>) -> DVector<f64> {
        let compliance = self.compliance(x);
        let softness = compliance.of_slices(self.pair, &self.slices);
        let count = self.slices.count();
        let mut factors = Factors::default();
        compliance.coupling(&self.slices).factorise(&vec![0.0; count], &mut factors);
        let bodies = compliance.bodies * self.shared_mm2_per_n / count as f64;
        let mut residuals: Vec<f64> = x.iter().map(|part| CLOSED_FORM_WEIGHT * part).collect();
        for Phase { lines, cases } in &self.phases {
            for LoadCase { n_per_mm, deflection_mm, reads, .. } in cases {
                let mut differs_mm = deflection_mm.map(|mm| bodies * n_per_mm.sum() - mm);
                for line in lines {
                    let root = |k: usize| (line.mm2_per_n[k] * softness[line.slices[k]]).sqrt();
                    let mut v = vec![0.0; count];
                    for (k, slice) in line.slices.iter().enumerate() {
                        v[*slice] = root(k) * n_per_mm[line.first + k];
                    }
                    factors.solve(&mut v);
                    for (k, slice) in line.slices.iter().enumerate() {
                        differs_mm[line.first + k] += root(k) * v[*slice];
                    }
                }
                residuals.extend((reads * differs_mm).iter());
            }
        }
        DVector::from_vec(residuals)
    }

    /// Root mean square of what the loads on aligned axes differ by, of all `residuals`.
    fn of_aligned_loads(&self, residuals: &DVector<f64>) -> f64 {
        let (mut first, mut square, mut count) = (UNKNOWNS, 0.0, 0);
        for LoadCase { n_per_mm, reads, is_aligned, .. } in self.phases.iter().flat_map(|phase| &phase.cases) {
            if *is_aligned {
                square += residuals.rows(first, n_per_mm.len()).norm_squared();
                count += n_per_mm.len();
            }
            first += reads.nrows();
        }
        (square / count.max(1) as f64).sqrt()
    }

    fn solve(&self) -> (SliceCompliance, f64) {
        let mut x = SVector::<f64, UNKNOWNS>::zeros();
        let mut residuals = self.residuals(&x);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let mut jacobian = DMatrix::zeros(residuals.len(), UNKNOWNS);
            for k in 0..UNKNOWNS {
                let mut moved = x;
                moved[k] += DIFFERENCE;
                jacobian.set_column(k, &((self.residuals(&moved) - &residuals) / DIFFERENCE));
            }
            let square = jacobian.transpose() * &jacobian;
            let mut normal = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::from_fn(|i, j| square[(i, j)]);
            let gradient = jacobian.transpose() * &residuals;
            let gradient = SVector::<f64, UNKNOWNS>::from_fn(|i, _| gradient[i]);
            for k in 0..UNKNOWNS {
                normal[(k, k)] *= 1.0 + damping;
            }
            let Some(step) = normal.cholesky().map(|factor| factor.solve(&gradient)) else { break };
            let candidate = x - step.map(|part| part.clamp(-1.0, 1.0));
            let there = self.residuals(&candidate);
            let (before, after) = (residuals.norm_squared(), there.norm_squared());
            if after < before {
                (x, residuals, damping) = (candidate, there, 0.3 * damping);
                if before - after <= SETTLED * before {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1e9 {
                    break;
                }
            }
        }
        (self.compliance(&x), self.of_aligned_loads(&residuals))
    }
}
