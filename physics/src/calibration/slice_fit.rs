//! Compliance of the slices of a pair together, fitted to its teeth in space.
//!
//! Slices that are thin teeth, or joined as plates ([`crate::mesh_cycle::slice_coupling`]), have the compliance of the transverse section. The rest is
//! fitted: the softness of oblique teeth and of their end faces, the reach of a deflection along a tooth, the lesser resistance to twisting where teeth
//! end, and the compliance that all teeth in mesh share. The fit is to the loads: at some positions of the mesh, contacts with the compliance C of their
//! flattening share the load of aligned and of tilted axes,
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
//! contact that are loaded evenly ([`gearwear_bodies::reference::levenberg_marquardt`], from the closed forms). A parameter on which none of them depends stays
//! as in the closed form.

use std::convert::Infallible;

use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use serde::{Deserialize, Serialize};

use super::STIFFNESS_POSITIONS;
use super::identity::same;
use crate::contact::{half_space::HalfSpace, hertz};
use crate::mesh_cycle::pair_in_space::PairInSpace;
use crate::mesh_cycle::slice_coupling::{Factors, Reach, SliceCompliance};
use crate::mesh_cycle::sliced_positions::{SliceContact, SliceEnds, sliced_positions};
use crate::mesh_cycle::spring_along_path::SpringAlongPath;
use crate::stiffness::settings::StiffnessSettings;
use crate::stiffness::{StiffnessError, TeethSpring, curve::PairCompliance};
use gearwear_bodies::gear::{GearPair, PerGear, slices::Slices};
use gearwear_bodies::material::Material;
use gearwear_bodies::reference::levenberg_marquardt::{LeastSquares, LevenbergMarquardt};

/// Slices of the fit.
pub const SLICES: usize = 20;
/// Positions from A to E.
const POSITIONS: usize = 16;
/// Unknowns of the fit: teeth, both ends, both reaches, bodies, length of the ends, resistance to twisting at both.
const UNKNOWNS: usize = 9;
/// Variation of the approach over the face width, and weight of its loads: aligned loads count most.
const APPROACHES: [(f64, f64); 3] = [(0.0, 1.0), (0.5, 0.1), (-0.5, 0.1)];
/// Weight of the approach itself over that of a load, which are dozens.
const APPROACH_WEIGHT: f64 = 60.0;
/// Weight of the deflection of single lines of contact.
const SINGLE_LINE_WEIGHT: f64 = 0.1;
/// Weight of the closed forms.
const CLOSED_FORM_WEIGHT: f64 = 0.002;
/// Loss of resistance to twisting at an end face where the fit begins.
const END_TWIST: f64 = 3.0;
/// Length over which that loss decays, in transverse modules. The fit cannot tell it: only that the loss is within the first third of a module.
const END_TWIST_MODULES: f64 = 0.1;
/// Step of the difference quotients.
const DIFFERENCE: f64 = 1e-6;
/// Settings of the search; ten steps are usual.
const SEARCH: LevenbergMarquardt =
    LevenbergMarquardt { most_steps: 60, damping_decrease: 0.3, least_damping: 0.0, most_damping: 1e9, settled: 1e-9 };

/// Parameters of the slices of one pair, fitted to its teeth in space.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliceFit {
    /// β.
    pub helix_angle_deg: f64,
    /// b.
    pub face_width_mm: f64,
    /// The parameters.
    pub compliance: SliceCompliance,
    /// Root mean square of the differences in load on aligned axes, over the mean load; in older files, of the differences in deflection.
    pub residual: f64,
}

impl SliceFit {
    /// Whether the fit is of `pair`, whose transverse section it is known to have.
    pub fn is_of(&self, pair: &GearPair) -> bool {
        let spec = &pair.spec;
        same(self.helix_angle_deg, spec.helix_angle_rad.to_degrees()) && same(self.face_width_mm, spec.face_width_mm)
    }
}

/// Contacts of one tooth at a position of the mesh.
struct LineOfContact {
    first: usize,
    slices: Vec<usize>,
    /// Compliance of the section at each contact, mm²/N.
    mm2_per_n: Vec<f64>,
}

/// Loads of all contacts at a position, and their deflection.
struct SliceLoadCase {
    n_per_mm: DVector<f64>,
    deflection_mm: DVector<f64>,
    /// Residuals that a difference in deflection makes; on aligned axes, first those of the loads.
    reads: DMatrix<f64>,
    is_aligned: bool,
}

/// Lines of contact and load cases at a position of the mesh.
struct FitPosition {
    lines: Vec<LineOfContact>,
    cases: Vec<SliceLoadCase>,
}

/// Load cases of the teeth in space, and the parameters that are fitted to them.
struct SliceLoads<'a> {
    pair: &'a GearPair,
    slices: Slices,
    positions: Vec<FitPosition>,
    /// Compliance that all pairs in mesh share, mm²/N.
    shared_mm2_per_n: f64,
    /// The closed forms.
    start: SliceCompliance,
}

/// Fits the slices of `pair`, whose transverse section has the stiffness of `curve`, under a line load.
pub fn fit(
    pair: &GearPair,
    material: &PerGear<Material>,
    in_space: &PairInSpace,
    curve: &PairCompliance,
    line_load_n_per_mm: f64,
) -> Result<SliceFit, StiffnessError> {
    let surface = HalfSpace { material: *material, expected_line_load_n_per_mm: line_load_n_per_mm };
    let teeth = TeethSpring::new(StiffnessSettings::Fem, Some(curve), pair, material, &surface, line_load_n_per_mm)?;
    let path = &pair.path;
    let springs = Springs {
        whole: SpringAlongPath::new(path, STIFFNESS_POSITIONS, [0.0; 2], |at| teeth.oblique_parts(at))?,
        own: SpringAlongPath::new(path, STIFFNESS_POSITIONS, [0.0; 2], |at| teeth.own_parts(at))?,
    };
    let slices = Slices::new(pair, SLICES);
    let positions = sliced_positions(path, &slices, POSITIONS, SliceEnds::AtOnce)
        .iter()
        .map(|at| FitPosition::new(pair, material, in_space, &springs, &slices, &at.contacts, line_load_n_per_mm))
        .collect();
    let start = SliceCompliance::of_plates(pair, material, true);
    let mut loads = SliceLoads { pair, slices, positions, shared_mm2_per_n: teeth.shared_mm2_per_n(), start };
    let Ok(minimum) = SEARCH.minimise(&mut loads, vec![0.0; UNKNOWNS]);
    let spec = &pair.spec;
    Ok(SliceFit {
        helix_angle_deg: spec.helix_angle_rad.to_degrees(),
        face_width_mm: spec.face_width_mm,
        compliance: loads.compliance(&minimum.theta),
        residual: loads.rms_of_aligned_loads(minimum.residuals),
    })
}

/// Springs of the transverse section along the path of contact.
struct Springs {
    /// Compliance beside the surface, which teeth in space have too.
    whole: SpringAlongPath,
    /// Part of it that a slice has to itself.
    own: SpringAlongPath,
}

impl FitPosition {
    fn new(
        pair: &GearPair,
        material: &PerGear<Material>,
        in_space: &PairInSpace,
        springs: &Springs,
        slices: &Slices,
        contacts: &[SliceContact],
        line_load_n_per_mm: f64,
    ) -> Self {
        let count = contacts.len();
        let influence =
            in_space.influence(pair, slices, contacts, |at| springs.whole.at(at.cell.position_mm).mm2_per_n(1.0));
        let mut lines: Vec<LineOfContact> = Vec::new();
        for of_tooth in contacts.chunk_by(|a, b| a.tooth == b.tooth) {
            lines.push(LineOfContact {
                first: lines.last().map_or(0, |line| line.first + line.slices.len()),
                slices: of_tooth.iter().map(|contact| contact.slice).collect(),
                mm2_per_n: of_tooth.iter().map(|at| springs.own.at(at.cell.position_mm).teeth_mm2_per_n).collect(),
            });
        }
        let section = pair.normal_section();
        let load_n_per_mm = line_load_n_per_mm * SLICES as f64 / count as f64;
        let flattening: Vec<f64> = contacts
            .iter()
            .map(|contact| hertz::flattening(&section, material, contact.cell.position_mm))
            .map(|flattening| section.obliquity.transverse_mm(flattening.approach_and_compliance(load_n_per_mm).1))
            .collect();
        let tilt: Vec<f64> = contacts
            .iter()
            .map(|contact| 2.0 * slices.width_mm[contact.slice] / pair.spec.face_width_mm - 1.0)
            .collect();
        let influence = DMatrix::from_row_slice(count, count, &influence.mm2_per_n);
        Self { cases: load_cases(&lines, &influence, &flattening, &tilt), lines }
    }
}

/// Loads of the approaches, aligned ones first, with a mean of 1 N/mm; then each line by itself.
fn load_cases(
    lines: &[LineOfContact],
    influence: &DMatrix<f64>,
    flattening: &[f64],
    tilt: &[f64],
) -> Vec<SliceLoadCase> {
    let count = flattening.len();
    let mut cases = Vec::new();
    let whole = influence + DMatrix::from_diagonal(&DVector::from_column_slice(flattening));
    // Loads that the surfaces cannot decide on are left out.
    if let Some(inverse) = whole.try_inverse() {
        let even = inverse.column_sum();
        let approach_mm = count as f64 / even.sum();
        let of_loads = &even * even.transpose() / even.sum() - &inverse;
        for (slope, weight) in APPROACHES {
            let mm = DVector::from_fn(count, |k, _| approach_mm * (1.0 + slope * tilt[k]));
            let n_per_mm = &inverse * mm;
            let mut reads = (weight * &of_loads).insert_row(count, 0.0);
            reads.set_row(count, &(even.transpose() * (weight * APPROACH_WEIGHT / count as f64)));
            cases.push(SliceLoadCase {
                deflection_mm: influence * &n_per_mm,
                n_per_mm,
                reads,
                is_aligned: slope == 0.0,
            });
        }
    }
    cases.extend(lines.iter().map(|line| {
        let loaded = line.first..line.first + line.slices.len();
        let n_per_mm = DVector::from_fn(count, |k, _| f64::from(u8::from(loaded.contains(&k))));
        let deflection_mm = influence * &n_per_mm;
        let reads = DMatrix::from_diagonal_element(count, count, SINGLE_LINE_WEIGHT / deflection_mm.norm());
        SliceLoadCase { n_per_mm, deflection_mm, reads, is_aligned: false }
    }));
    cases
}

impl SliceLoads<'_> {
    fn compliance(&self, x: &[f64]) -> SliceCompliance {
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

    /// Residuals of all positions and load cases, and of the closed forms.
    fn residuals_at(&self, x: &[f64]) -> Vec<f64> {
        let compliance = self.compliance(x);
        let softness = compliance.of_slices(self.pair, &self.slices);
        let count = self.slices.count();
        let mut factors = Factors::default();
        compliance.coupling(&self.slices).factorise(&vec![0.0; count], &mut factors);
        let bodies = compliance.bodies * self.shared_mm2_per_n / count as f64;
        let mut residuals: Vec<f64> = x.iter().map(|part| CLOSED_FORM_WEIGHT * part).collect();
        for FitPosition { lines, cases } in &self.positions {
            for SliceLoadCase { n_per_mm, deflection_mm, reads, .. } in cases {
                let mut differs_mm = deflection_mm.map(|mm| bodies * n_per_mm.sum() - mm);
                for line in lines {
                    let roots: Vec<f64> = line
                        .slices
                        .iter()
                        .zip(&line.mm2_per_n)
                        .map(|(&slice, mm2_per_n)| (mm2_per_n * softness[slice]).sqrt())
                        .collect();
                    let mut v = vec![0.0; count];
                    for (k, slice) in line.slices.iter().enumerate() {
                        v[*slice] = roots[k] * n_per_mm[line.first + k];
                    }
                    factors.solve(&mut v);
                    for (k, slice) in line.slices.iter().enumerate() {
                        differs_mm[line.first + k] += roots[k] * v[*slice];
                    }
                }
                residuals.extend((reads * differs_mm).iter());
            }
        }
        residuals
    }

    /// Root mean square of the `residuals` that are differences of loads on aligned axes.
    fn rms_of_aligned_loads(&self, residuals: Vec<f64>) -> f64 {
        let residuals = DVector::from_vec(residuals);
        let (mut first, mut square, mut count) = (UNKNOWNS, 0.0, 0);
        for SliceLoadCase { n_per_mm, reads, is_aligned, .. } in self.positions.iter().flat_map(|at| &at.cases) {
            if *is_aligned {
                square += residuals.rows(first, n_per_mm.len()).norm_squared();
                count += n_per_mm.len();
            }
            first += reads.nrows();
        }
        (square / count.max(1) as f64).sqrt()
    }
}

impl LeastSquares for SliceLoads<'_> {
    type Error = Infallible;
    type Jacobian = DMatrix<f64>;

    fn residuals(&mut self, x: &[f64]) -> Result<Vec<f64>, Infallible> {
        Ok(self.residuals_at(x))
    }

    fn jacobian(&mut self, x: &[f64], residuals: &[f64]) -> Result<DMatrix<f64>, Infallible> {
        let mut columns = Vec::with_capacity(UNKNOWNS * residuals.len());
        for k in 0..UNKNOWNS {
            let mut moved = x.to_vec();
            moved[k] += DIFFERENCE;
            columns.extend(
                self.residuals_at(&moved).iter().zip(residuals).map(|(there, here)| (there - here) / DIFFERENCE),
            );
        }
        Ok(DMatrix::from_vec(residuals.len(), UNKNOWNS, columns))
    }

    fn damped_step(&self, x: &[f64], residuals: &[f64], jacobian: &DMatrix<f64>, damping: f64) -> Option<Vec<f64>> {
        let transposed = jacobian.transpose();
        let square = &transposed * jacobian;
        let mut normal = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::from_fn(|i, j| square[(i, j)]);
        for k in 0..UNKNOWNS {
            normal[(k, k)] *= 1.0 + damping;
        }
        let gradient = transposed * DVector::from_column_slice(residuals);
        let step = normal.cholesky()?.solve(&SVector::<f64, UNKNOWNS>::from_fn(|i, _| gradient[i]));
        Some(x.iter().zip(&step).map(|(value, by)| value - by.clamp(-1.0, 1.0)).collect())
    }
}
