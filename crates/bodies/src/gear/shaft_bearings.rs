//! Tilt and bending of a gear's shaft on two bearings.
//!
//! The shaft is a beam of the bending stiffness E I on two springs k_1, k_2 at x_1 < x_2, coordinates along the axis from the middle of the face
//! width. A unit force at t has the reactions R_1 = (x_2 − t)/(x_2 − x_1), R_2 = 1 − R_1 and bends the shaft by the moment
//!
//! ```text
//! m_t(x) = R_1 ⟨x − x_1⟩ + R_2 ⟨x − x_2⟩ − ⟨x − t⟩        ⟨u⟩ = max(u, 0)
//! ```
//!
//! and the shaft gives way at s by (unit-load theorem)
//!
//! ```text
//! G(s, t) = (s − x_c)(t − x_c)/k_r + ∫ m_s m_t dx/(E I)      x_c = Σ k_i x_i/Σ k_i,  k_r = Σ k_i (x_i − x_c)²,  I = π (d⁴ − d_i⁴)/64
//! ```
//!
//! without 1/Σ k_i, by which all teeth give way alike, as by a turn of the gear. The transverse force of the teeth acts along the line of action,
//! with cos α_wt across the plane of the axes and sin α_wt in it; there the axial force F tan β_b at the working pitch radius r_w is a moment, and
//! its point moves with the slope of the shaft:
//!
//! ```text
//! H = cos² α_wt G + (sin α_wt + κ ∂/∂s)(sin α_wt + κ ∂/∂t) G         κ = ∓ r_w tan β_b of pinion and wheel
//! ```
//!
//! H is symmetric and adds to the compliance of the teeth, as the twist does ([`super::shaft`]). Limits: shear of the shaft, other forces on it and
//! play of the bearings are left out.
//!
//! Source: S. Timoshenko, *Strength of Materials*, part I (1955), on beams with overhangs and on Castigliano's theorem.

use super::{Gear, GearPair, slices::Slices};

/// Place of the points of Gauss in half an interval, 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;
/// Places over the face width for the misalignment under an even load.
const PLACES: usize = 200;

/// Two radial bearings of a shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftBearings {
    /// Coordinates x_1 < x_2 along the axis from the middle of the face width, mm.
    pub positions_mm: [f64; 2],
    /// Radial stiffnesses k_1, k_2, N/mm.
    pub stiffness_n_per_mm: [f64; 2],
}

/// How the forces of the teeth act on the shaft of a gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothForceDirection {
    /// Working transverse pressure angle α_wt, rad.
    pub working_pressure_angle_rad: f64,
    /// κ, mm.
    pub axial_lever_mm: f64,
}

impl GearPair {
    /// Direction of the forces of the teeth on the shaft of `gear`.
    pub fn tooth_force_direction(&self, gear: Gear) -> ToothForceDirection {
        let sign = match gear {
            Gear::Pinion => -1.0,
            Gear::Wheel => 1.0,
        };
        ToothForceDirection {
            working_pressure_angle_rad: self.working_pressure_angle_rad,
            axial_lever_mm: sign * self.working_pitch_radius_mm(gear) * self.base_helix_angle_rad().tan(),
        }
    }
}

/// A force `force` and a moment `couple_mm` per force at `at_mm`.
#[derive(Debug, Clone, Copy)]
struct BeamLoad {
    at_mm: f64,
    force: f64,
    couple_mm: f64,
}

/// A shaft on its bearings.
#[derive(Debug, Clone, Copy)]
pub struct ShaftBeam {
    /// Bearings.
    pub bearings: ShaftBearings,
    /// Bending stiffness E I, N mm².
    pub bending_stiffness_n_mm2: f64,
    /// Direction of the forces.
    pub direction: ToothForceDirection,
}

impl ShaftBeam {
    /// Bending moment of a load at `x_mm`.
    fn moment_mm(&self, load: &BeamLoad, x_mm: f64) -> f64 {
        let [first, second] = self.bearings.positions_mm;
        let span = second - first;
        let reactions = [
            (load.force * (second - load.at_mm) - load.couple_mm) / span,
            (load.force * (load.at_mm - first) + load.couple_mm) / span,
        ];
        let of_couple = if x_mm > load.at_mm { load.couple_mm } else { 0.0 };
        reactions[0] * (x_mm - first).max(0.0) + reactions[1] * (x_mm - second).max(0.0)
            - load.force * (x_mm - load.at_mm).max(0.0)
            + of_couple
    }

    /// Work of one load on the displacement by another, mm/N.
    fn shared_mm_per_n(&self, one: &BeamLoad, other: &BeamLoad) -> f64 {
        let ([first, second], [k_1, k_2]) = (self.bearings.positions_mm, self.bearings.stiffness_n_per_mm);
        let centre = (k_1 * first + k_2 * second) / (k_1 + k_2);
        let tilting = k_1 * (first - centre).powi(2) + k_2 * (second - centre).powi(2);
        let [lever, other_lever] = [one, other].map(|load| load.force * (load.at_mm - centre) + load.couple_mm);
        let mut breaks = [first, second, one.at_mm, other.at_mm];
        breaks.sort_by(f64::total_cmp);
        // Moments are linear between, and their products exact by two points of Gauss.
        let bending: f64 = breaks
            .windows(2)
            .map(|ends| {
                let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
                let at = [middle - GAUSS * half, middle + GAUSS * half];
                half * at.map(|x| self.moment_mm(one, x) * self.moment_mm(other, x)).iter().sum::<f64>()
            })
            .sum();
        lever * other_lever / tilting + bending / self.bending_stiffness_n_mm2
    }

    /// H(s, t): how far the teeth at `s_mm` give way along the line of action under a unit force at `t_mm`, mm/N.
    pub fn gives_way_mm_per_n(&self, s_mm: f64, t_mm: f64) -> f64 {
        let (sin, cos) = self.direction.working_pressure_angle_rad.sin_cos();
        let along = [(cos, 0.0), (sin, self.direction.axial_lever_mm)];
        let of = |(force, couple_mm)| {
            let [one, other] = [s_mm, t_mm].map(|at_mm| BeamLoad { at_mm, force, couple_mm });
            self.shared_mm_per_n(&one, &other)
        };
        along.map(of).iter().sum()
    }

    /// How much farther the teeth give way at the full width than at width 0 under an even line load, mm.
    pub fn misalignment_mm(&self, face_width_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let (half, step) = (0.5 * face_width_mm, face_width_mm / PLACES as f64);
        let places = (0..PLACES).map(|k| (k as f64 + 0.5) * step - half);
        let per_load: f64 = places.map(|t| self.gives_way_mm_per_n(half, t) - self.gives_way_mm_per_n(-half, t)).sum();
        line_load_n_per_mm * step * per_load
    }

    /// Displacement of the teeth in one slice per even line load in another, mm²/N, row by row.
    pub fn mm2_per_n(&self, slices: &Slices) -> Vec<f64> {
        let half = 0.5 * slices.slice_width_mm * slices.count() as f64;
        let at_mm: Vec<f64> = slices.width_mm.iter().map(|z| z - half).collect();
        let rows = at_mm.iter().flat_map(|s| at_mm.iter().map(move |t| (*s, *t)));
        rows.map(|(s, t)| slices.slice_width_mm * self.gives_way_mm_per_n(s.min(t), s.max(t))).collect()
    }
}
