//! Coupling of the slices of a tooth: the tooth as a plate that is clamped at its root.
//!
//! Haines and Ollerton cut a contact into strips and treat each as a plane contact of its own. Here the strips are the slices of
//! a tooth: contact is plane in each, but they belong to one tooth, and a loaded slice takes its neighbours along. The tooth is
//! a plate of thickness t(y) over the height y above its root and of infinite stiffness only there. With the shape f(y) that a
//! slice by itself bends to under a load at the height y_p, f(y_p) = 1, and the deflection u(z) of the loaded line as the
//! unknown (Kantorovich), the plate's energy becomes that of a beam on an elastic foundation that resists shear,
//!
//! ```text
//! ½ ∫ [k u² + T u'² + B u''²] dz − ∫ w u dz        D = E t³ / (12 (1 − ν²))
//! k = ∫ D f''² dy      T = 2 (1 − ν) ∫ D f'² dy − 2 ν ∫ D f f'' dy      B = ∫ D f² dy
//! k u − T u'' + B u'''' = w
//! ```
//!
//! with free ends. 1/k is the bending of a slice by itself; the other two say how far a deflection reaches along the tooth: ℓ₁² =
//! T/k, ℓ₂⁴ = B/k. Of the pair, both teeth's are averaged by their bending. The compliance itself stays that of the stiffness
//! model, q along the line of contact: with v = u/√q,
//!
//! ```text
//! v − ℓ₁² v'' + ℓ₂⁴ v'''' = √q w
//! ```
//!
//! which is symmetric, as Maxwell's theorem wants it, and for a load and a stiffness alike over the whole width gives u = q w, as if
//! there were no coupling. Over the slices the derivatives are differences, v + ℓ₁²/Δz² D₁ᵀD₁ v + ℓ₂⁴/Δz⁴ D₂ᵀD₂ v, with free ends.
//!
//! A tooth of finite thickness resists twisting less where it ends: what is loaded next to an end face is left more to itself than in a
//! plate. Where that is known of a pair ([`crate::calibration::slice_fit`]), ℓ₁² is there divided by 1 + t₀ e^(−z/ℓ) + t_b e^(−(b−z)/ℓ).
//!
//! Limits: a thin plate, so that a point load on a tooth as thick as high is spread a little too little; body and hub are taken
//! to spread a load as the tooth does. Against the exact plate of even thickness (ν = 0.3), a point load at the free edge deflects it by
//! 0.162 P l²/D instead of 0.1665.
//!
//! Source: D. J. Haines and E. Ollerton, *Proc. Inst. Mech. Eng.* 177 (1963) 95–114, for the strips; L. V. Kantorovich and V. I. Krylov,
//! *Approximate Methods of Higher Analysis* (1958), chapter IV; V. Z. Vlasov and N. N. Leont'ev, *Beams, Plates and Shells on
//! Elastic Foundations* (1966); S. Timoshenko and S. Woinowsky-Krieger, *Theory of Plates and Shells* (1959), for
//! the plate under a point load.

use serde::{Deserialize, Serialize};

use super::influence::Influence;
use super::sliced_positions::SliceContact;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, half_profile::half_profile, slices::Slices, tooth::Tooth};
use gearwear_bodies::material::Material;

/// Samples of the profile on fillet and flank each.
const SAMPLES: usize = 400;

/// Compliance of slices, relative to the transverse section of their pair.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliceCompliance {
    /// Compliance of the teeth of a slice over that of the section.
    pub teeth: f64,
    /// Part by which it is greater at either end face, z = 0 first.
    pub ends: [f64; 2],
    /// Loss of resistance to twisting at either end face: ℓ₁² is divided there by 1 plus this. Older calibrations have none, and keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_twist: Option<[f64; 2]>,
    /// Length over which that loss decays, mm; `end_length_mm` in older calibrations, which have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_twist_length_mm: Option<f64>,
    /// Length over which the compliance of end faces decays, mm.
    pub end_length_mm: f64,
    /// Reach of a deflection along the tooth.
    pub reach: Reach,
    /// Compliance that all pairs in mesh share over that of the section.
    pub bodies: f64,
}

impl SliceCompliance {
    /// Closed form. Teeth bend in the normal section: as plates, an oblique one is cos β times as thick and 1/cos β times as
    /// long, and yields 1/cos⁴ β times as much along the transverse line of action. That counts where `is_oblique`; other stiffness models
    /// are of the slices themselves.
    pub fn of_plates(pair: &GearPair, material: &PerGear<Material>, is_oblique: bool) -> Self {
        let teeth = if is_oblique { pair.spec.helix_angle_rad.cos().powi(-4) } else { 1.0 };
        let end_length_mm = pair.spec.transverse_module_mm();
        let reach = Reach::of_pair(pair, material);
        Self { teeth, ends: [0.0; 2], end_twist: None, end_length_mm, end_twist_length_mm: None, reach, bodies: 1.0 }
    }

    /// Compliance of the teeth of each slice over that of the section.
    pub fn of_slices(&self, pair: &GearPair, slices: &Slices) -> Vec<f64> {
        let face_width_mm = pair.spec.face_width_mm;
        let places = slices.width_mm.iter();
        places.map(|&z_mm| self.teeth * with_ends(self.ends, self.end_length_mm, z_mm, face_width_mm)).collect()
    }

    /// Coupling of the slices of a tooth.
    pub fn coupling(&self, slices: &Slices) -> SliceCoupling {
        let (count, slice_width_mm) = (slices.count(), slices.slice_width_mm);
        let mut coupling = SliceCoupling::new(self.reach, count, slice_width_mm);
        if let Some(ends) = self.end_twist {
            let face_width_mm = count as f64 * slice_width_mm;
            let length_mm = self.end_twist_length_mm.unwrap_or(self.end_length_mm);
            for (i, twist) in coupling.twist.iter_mut().enumerate() {
                *twist /= with_ends(ends, length_mm, (i + 1) as f64 * slice_width_mm, face_width_mm);
            }
        }
        coupling
    }
}

/// 1 plus the part of either end face, z = 0 first, which decays over a length, at z.
fn with_ends([first, last]: [f64; 2], length_mm: f64, z_mm: f64, face_width_mm: f64) -> f64 {
    let [from_first, from_last] = [z_mm, face_width_mm - z_mm].map(|distance_mm| (-distance_mm / length_mm).exp());
    1.0 + first * from_first + last * from_last
}

/// Reach of a deflection along a tooth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reach {
    /// ℓ₁² of twisting, mm².
    pub twist_mm2: f64,
    /// ℓ₂⁴ of bending along the tooth, mm⁴.
    pub bending_mm4: f64,
}

impl Reach {
    /// Reach in a plate of thickness `thickness_mm` at increasing heights `height_mm` above its clamped edge (both of the same
    /// length), loaded at the height `load_height_mm`; and E/k: the bending of a slice, dimensionless.
    pub fn of_plate(height_mm: &[f64], thickness_mm: &[f64], load_height_mm: f64, poisson_ratio: f64) -> (Self, f64) {
        let (mut slope, mut deflection) = (0.0, 0.0);
        let mut at_load = 0.0;
        let [mut k, mut twist, mut mixed, mut along] = [0.0; 4];
        for (y, t) in height_mm.windows(2).zip(thickness_mm.windows(2)) {
            let dy = y[1] - y[0];
            let middle = [0.5 * (y[0] + y[1]), 0.5 * (t[0] + t[1])];
            // f'' = (y_p − y)/t³ up to the load, zero above; not yet divided by f at the load.
            let bend = (load_height_mm - middle[0]).max(0.0) / middle[1].powi(3);
            let (slope_here, deflection_here) = (slope + 0.5 * dy * bend, deflection + 0.5 * dy * slope);
            let stiffness = middle[1].powi(3) / (12.0 * (1.0 - poisson_ratio * poisson_ratio));
            k += stiffness * bend * bend * dy;
            twist += stiffness * slope_here * slope_here * dy;
            mixed += stiffness * deflection_here * bend * dy;
            along += stiffness * deflection_here * deflection_here * dy;
            if (y[0]..=y[1]).contains(&load_height_mm) {
                at_load = deflection + (load_height_mm - y[0]) * slope_here;
            }
            deflection += dy * slope_here;
            slope += dy * bend;
        }
        let reach = Self {
            twist_mm2: (2.0 * (1.0 - poisson_ratio) * twist - 2.0 * poisson_ratio * mixed) / k,
            bending_mm4: along / k,
        };
        (reach, at_load * at_load / k)
    }

    /// Reach in a tooth loaded where it touches at `rho_mm`, and its bending over line load, 1/MPa.
    fn of_tooth(tooth: &Tooth, material: &Material, rho_mm: f64) -> (Self, f64) {
        let profile = half_profile(tooth, SAMPLES);
        let height: Vec<f64> = profile.iter().map(|point| point.y - profile[0].y).collect();
        let thickness: Vec<f64> = profile.iter().map(|point| 2.0 * point.x).collect();
        let load_height = tooth.load_line(rho_mm).centre_line_mm - profile[0].y;
        let (reach, bending) = Self::of_plate(&height, &thickness, load_height, material.poisson_ratio);
        (reach, bending / material.young_modulus_mpa)
    }

    /// Reach in a pair whose teeth touch in the middle of the path of contact: mean of both teeth, weighted by their bending.
    pub fn of_pair(pair: &GearPair, material: &PerGear<Material>) -> Self {
        let middle = pair.path.start_mm.midpoint(pair.path.end_mm);
        let [(pinion, a), (wheel, b)] =
            Gear::BOTH.map(|gear| Self::of_tooth(&pair.teeth[gear], &material[gear], pair.path.rho_mm(gear, middle)));
        Self {
            twist_mm2: (a * pinion.twist_mm2 + b * wheel.twist_mm2) / (a + b),
            bending_mm4: (a * pinion.bending_mm4 + b * wheel.bending_mm4) / (a + b),
        }
    }
}

/// The operator on the slices of one tooth.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceCoupling {
    /// Reach of a deflection along the tooth.
    pub reach: Reach,
    count: usize,
    /// ℓ₁²/Δz² between each slice and the next.
    twist: Vec<f64>,
    /// ℓ₂⁴/Δz⁴.
    bending: f64,
}

impl SliceCoupling {
    /// Operator on `count` slices `slice_width_mm` wide.
    pub fn new(reach: Reach, count: usize, slice_width_mm: f64) -> Self {
        let square = slice_width_mm * slice_width_mm;
        let twist = vec![reach.twist_mm2 / square; count.saturating_sub(1)];
        Self { reach, count, twist, bending: reach.bending_mm4 / (square * square) }
    }

    /// Applies the operator to `v`, into `result`; by differences of differences, which keep digits where slices are thin.
    pub fn apply(&self, v: &[f64], result: &mut [f64]) {
        result.copy_from_slice(v);
        for i in 1..self.count {
            let difference = self.twist[i - 1] * (v[i] - v[i - 1]);
            result[i] += difference;
            result[i - 1] -= difference;
        }
        for i in 1..self.count.saturating_sub(1) {
            let bend = self.bending * ((v[i + 1] - v[i]) - (v[i] - v[i - 1]));
            result[i - 1] += bend;
            result[i] -= 2.0 * bend;
            result[i + 1] += bend;
        }
    }

    /// Factorises the operator with `diagonal` (≥ 0) added, into `factors`, whose memory is used again.
    pub fn factorise(&self, diagonal: &[f64], factors: &mut Factors) {
        let n = self.count;
        let Factors { per_pivot, first, second } = factors;
        for row in [&mut *per_pivot, first, second] {
            row.resize(n, 0.0);
        }
        // Row by row with a, b, d of the matrix beside and on the diagonal, and L D Lᵀ: L₂ = a/D₋₂, f = b − a L₁₋₁, L₁ = f/D₋₁,
        // D = d − f L₁ − a L₂.
        let (mut per_before, mut per_second, mut first_before) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let [d, b, a] = self.row(i);
            let (l_2, f) = (a * per_second, b - a * first_before);
            let l_1 = f * per_before;
            let per_own = 1.0 / (d + diagonal[i] - f * l_1 - a * l_2);
            (per_pivot[i], first[i], second[i]) = (per_own, l_1, l_2);
            (per_second, per_before, first_before) = (per_before, per_own, l_1);
        }
    }

    /// Coupling of `contacts`, tooth by tooth, where the pair has the compliance `mm2_per_n` at a contact.
    pub fn influence(&self, contacts: &[SliceContact], mm2_per_n: impl Fn(&SliceContact) -> f64) -> Influence {
        let mut influence = Influence::of_thin_slices(contacts, mm2_per_n);
        let root: Vec<f64> = influence.of_teeth.iter().map(|own| own.sqrt()).collect();
        let mut factors = Factors::default();
        self.factorise(&vec![0.0; self.count], &mut factors);
        let count = contacts.len();
        let mut bent = vec![0.0; self.count];
        for (a, loaded) in contacts.iter().enumerate() {
            bent.fill(0.0);
            bent[loaded.slice] = root[a];
            factors.solve(&mut bent);
            for (b, other) in contacts.iter().enumerate().filter(|(_, other)| other.tooth == loaded.tooth) {
                influence.mm2_per_n[b * count + a] = root[b] * bent[other.slice];
            }
        }
        influence
    }

    /// Row i of the operator: on the diagonal, one and two places before it.
    fn row(&self, i: usize) -> [f64; 3] {
        let (n, bending) = (self.count, self.bending);
        let twist_before = if i > 0 { self.twist[i - 1] } else { 0.0 };
        let twist_after = if i + 1 < n { self.twist[i] } else { 0.0 };
        // Second differences with their middle here, and with an end here.
        let middle = f64::from(u8::from(i > 0 && i + 1 < n));
        let ends = f64::from(u8::from(i >= 2) + u8::from(i + 2 < n));
        let before = f64::from(u8::from(i > 0 && i + 1 < n) + u8::from(i >= 2));
        [
            1.0 + twist_before + twist_after + (4.0 * middle + ends) * bending,
            if i > 0 { -twist_before - 2.0 * before * bending } else { 0.0 },
            if i >= 2 { bending } else { 0.0 },
        ]
    }
}

/// L D Lᵀ of a symmetric matrix with two bands beside the diagonal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Factors {
    /// 1/D.
    per_pivot: Vec<f64>,
    /// L beside the diagonal.
    first: Vec<f64>,
    /// L two places beside it.
    second: Vec<f64>,
}

impl Factors {
    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.per_pivot.len();
        let (mut before, mut second_before) = (0.0, 0.0);
        for (x, (first, second)) in x.iter_mut().zip(self.first.iter().zip(&self.second)) {
            *x -= first * before + second * second_before;
            (second_before, before) = (before, *x);
        }
        // Backwards with the rows that follow: L₁ and L₂ of row i + 1 and i + 2.
        let (mut after, mut second_after) = (0.0, 0.0);
        for i in (0..n).rev() {
            let first = if i + 1 < n { self.first[i + 1] } else { 0.0 };
            let second = if i + 2 < n { self.second[i + 2] } else { 0.0 };
            x[i] = x[i] * self.per_pivot[i] - first * after - second * second_after;
            (second_after, after) = (after, x[i]);
        }
    }
}
