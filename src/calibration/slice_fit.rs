//! How the slices of a pair yield together, fitted to its teeth in space.
//!
//! Slices that are thin teeth, or hold each other as plates ([`crate::mesh_cycle::slice_coupling`]), take from the transverse section what it
//! tells. The rest is fitted: how much softer oblique teeth and their end faces are, how far a deflection reaches along a tooth, and what all
//! teeth in mesh share. At some phases of the mesh, lines of contact that are loaded evenly, over one half or on one tooth alone deflect the
//! teeth in space by u = U w; the parameters are those whose plates come closest,
//!
//! ```text
//! Σ over phases and loads  ‖u_plates − u‖²/‖u‖²  →  min
//! ```
//!
//! by Levenberg and Marquardt's method from the closed forms.
//!
//! Source: D. W. Marquardt, *J. SIAM* 11 (1963) 431–441.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::STIFFNESS_POSITIONS;
use super::identity::same;
use crate::contact::{half_space::HalfSpace, settings::Material};
use crate::gear::{GearPair, PerGear, slices::Slices};
use crate::mesh_cycle::pair_in_space::PairInSpace;
use crate::mesh_cycle::slice_coupling::{Factors, Reach, SliceCompliance, SliceCoupling};
use crate::mesh_cycle::sliced::SpringAlongPath;
use crate::mesh_cycle::sliced_positions::{SliceContact, SliceEnds, sliced_positions};
use crate::stiffness::settings::StiffnessSettings;
use crate::stiffness::{StiffnessError, TeethSpring, curve::PairCompliance};

/// Slices of the fit.
const SLICES: usize = 20;
/// Positions from A to E.
const POSITIONS: usize = 16;
/// Unknowns of the fit: teeth, both ends, both reaches, bodies, length of the ends.
const UNKNOWNS: usize = 7;
/// Weight of lines that are loaded evenly, which is what they nearly are on new flanks.
const EVEN_WEIGHT: f64 = 3.0;
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
    /// Root mean square of what is left, over that of the deflections.
    pub residual: f64,
}

impl SliceFit {
    /// Whether it is of `pair`, whose transverse section it is known to have.
    pub(crate) fn is_of(&self, pair: &GearPair) -> bool {
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
    n_per_mm: Vec<f64>,
    deflection_mm: Vec<f64>,
    weight: f64,
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
pub(crate) fn fit(
    pair: &GearPair,
    material: &PerGear<Material>,
    in_space: &PairInSpace,
    curve: &PairCompliance,
    line_load_n_per_mm: f64,
) -> Result<SliceFit, StiffnessError> {
    let surface = HalfSpace { material: *material, expected_line_load_n_per_mm: line_load_n_per_mm };
    let teeth = TeethSpring::new(StiffnessSettings::Fem, Some(curve), pair, material, &surface, line_load_n_per_mm)?;
    let (slices, base_helix) = (Slices::new(pair, SLICES), pair.base_helix_angle_rad());
    let seen = in_space.seen(SLICES);
    // The whole spring, which teeth in space have beside the surface, and what slices have of it to themselves.
    let along = |spring: &dyn Fn(f64) -> Result<f64, StiffnessError>| {
        SpringAlongPath::new(&pair.path, STIFFNESS_POSITIONS, [0.0; 2], spring)
    };
    let whole = along(&|at| teeth.oblique_n_per_mm2(at, base_helix))?;
    let own = along(&|at| teeth.slice_n_per_mm2(at, base_helix))?;
    let mut phases = Vec::new();
    for phase in sliced_positions(&pair.path, &slices, POSITIONS, SliceEnds::AtOnce) {
        let contacts = &phase.contacts;
        let at = |contact: &SliceContact| contact.cell.position_mm;
        let influence =
            in_space.influence(pair, &slices, &seen, contacts, |contact| whole.mm2_per_n(at(contact))).mm2_per_n;
        let mut first = 0;
        let lines: Vec<LineOfContact> = contacts
            .chunk_by(|a, b| a.tooth == b.tooth)
            .map(|of_tooth| {
                let begins = first;
                first += of_tooth.len();
                let mm2_per_n = of_tooth.iter().map(|contact| own.mm2_per_n(at(contact))).collect();
                LineOfContact {
                    first: begins,
                    slices: of_tooth.iter().map(|contact| contact.slice).collect(),
                    mm2_per_n,
                }
            })
            .collect();
        let count = contacts.len();
        let cases = loads(&lines, count).map(|(n_per_mm, weight)| {
            let row = |i: usize| (0..count).map(|j| influence[i * count + j] * n_per_mm[j]).sum::<f64>();
            LoadCase { deflection_mm: (0..count).map(row).collect(), n_per_mm, weight }
        });
        phases.push(Phase { cases: cases.collect(), lines });
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

/// All lines evenly; then each by itself, evenly and on either half.
fn loads(lines: &[LineOfContact], count: usize) -> impl Iterator<Item = (Vec<f64>, f64)> {
    let on =
        move |first: usize, last: usize| (0..count).map(|k| f64::from(u8::from((first..last).contains(&k)))).collect();
    let each = lines.iter().flat_map(move |line| {
        let (first, count) = (line.first, line.slices.len());
        let middle = first + count / 2;
        [(first, first + count), (first, middle), (middle, first + count)]
    });
    let each: Vec<(usize, usize)> = each.filter(|(first, last)| first < last).collect();
    std::iter::once((vec![1.0; count], EVEN_WEIGHT))
        .chain(each.into_iter().map(move |(first, last)| (on(first, last), 1.0)))
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
        }
    }

    /// u_plates − u over the size of u, all phases and loads.
    fn residuals(&self, x: &SVector<f64, UNKNOWNS>) -> DVector<f64> {
        let compliance = self.compliance(x);
        let softness = compliance.of_slices(self.pair, &self.slices);
        let count = self.slices.count();
        let plate = SliceCoupling::new(compliance.reach, count, self.slices.slice_width_mm);
        let mut factors = Factors::default();
        plate.factorise(&vec![0.0; count], &mut factors);
        let bodies = compliance.bodies * self.shared_mm2_per_n / count as f64;
        let mut residuals = Vec::new();
        for Phase { lines, cases } in &self.phases {
            for LoadCase { n_per_mm, deflection_mm, weight } in cases {
                let shared = bodies * n_per_mm.iter().sum::<f64>();
                let size = deflection_mm.iter().map(|u| u * u).sum::<f64>().sqrt();
                for line in lines {
                    let root = |k: usize| (line.mm2_per_n[k] * softness[line.slices[k]]).sqrt();
                    let mut v = vec![0.0; count];
                    for (k, slice) in line.slices.iter().enumerate() {
                        v[*slice] = root(k) * n_per_mm[line.first + k];
                    }
                    factors.solve(&mut v);
                    residuals.extend(line.slices.iter().enumerate().map(|(k, slice)| {
                        weight * (root(k) * v[*slice] + shared - deflection_mm[line.first + k]) / size
                    }));
                }
            }
        }
        DVector::from_vec(residuals)
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
                // What the loads do not tell stays as it is: a spur pair without shared bodies.
                normal[(k, k)] += f64::MIN_POSITIVE + 1e-9;
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
        let loads: f64 = self.phases.iter().flat_map(|phase| &phase.cases).map(|case| case.weight.powi(2)).sum();
        (self.compliance(&x), (residuals.norm_squared() / loads).sqrt())
    }
}
