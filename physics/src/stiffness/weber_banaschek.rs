//! Deflection of a tooth and its body after Weber and Banaschek, plane strain.
//!
//! The tooth is a short cantilever of varying thickness 2x(y) on its generated profile, held where the fillets leave the
//! root circle (y = 0 there); the load crosses the centre line at y_p under the angle α_F to the tooth's transverse. Deflection at the load in its
//! direction, over the line load w:
//!
//! ```text
//! tooth  cos²α_F / E · { 12 (1 − ν²) ∫₀^{y_p} (y_p − y)²/(2x)³ dy + 2.4 (1 + ν)(1 + 0.294 tan²α_F) ∫₀^{y_p} dy/(2x) }
//! body   cos²α_F / E · { 5.2 (L/s_F)² + 1.0 (L/s_F) + 1.4 (1 + 0.294 tan²α_F) }
//! ```
//!
//! with s_F the chord where the fillet's tangent makes 30° with the centre line and L the height of y_p above it.
//! Flattening is [`gearwear_bodies::reference::flattening`].
//!
//! Source: C. Weber and K. Banaschek, *Formänderung und Profilrücknahme bei gerad- und schrägverzahnten Rädern* (1953).

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Rotation2, Vector2};

use gearwear_bodies::gear::half_profile::{half_profile, in_tooth_frame};
use gearwear_bodies::gear::tooth::{LoadLine, Tooth};
use gearwear_bodies::material::Material;

/// Samples of the profile on fillet and flank each; the trapezoidal rule is then exact to about 1e-6.
const SAMPLES: usize = 1500;

/// Compliance of a tooth for any load line.
#[derive(Debug, Clone)]
pub struct ToothCompliance {
    tooth: Tooth,
    material: Material,
    /// Foot of the tooth on its centre line, from the gear's axis, mm.
    foot_mm: f64,
    /// Height above the foot, increasing, mm.
    height_mm: Vec<f64>,
    /// Integrals ∫ dy/(2x), ∫ dy/(2x)³, ∫ y dy/(2x)³, ∫ y² dy/(2x)³ up to each height.
    integrals: Vec<[f64; 4]>,
    /// Root chord s_F.
    pub root_chord_mm: f64,
    /// Height of that chord above the foot.
    root_chord_height_mm: f64,
}

impl ToothCompliance {
    /// Integrates over the profile of `tooth`.
    pub fn new(tooth: &Tooth, material: &Material) -> Self {
        let profile = half_profile(tooth, SAMPLES);
        let mut height_mm = Vec::with_capacity(profile.len());
        let mut integrals = Vec::with_capacity(profile.len());
        let mut total = [0.0; 4];
        let foot_mm = profile[0].y;
        for point in &profile {
            let y = point.y - foot_mm;
            if let Some(&before) = height_mm.last() {
                let last: &Vector2<f64> = &profile[height_mm.len() - 1];
                let (dy, middle): (f64, f64) = (y - before, 0.5 * (y + before));
                let thickness = last.x + point.x;
                let cube = thickness.powi(3);
                // ∫ y² dy over a piece of constant thickness is middle² dy + dy³/12.
                let square = middle * middle + dy * dy / 12.0;
                for (sum, part) in
                    total.iter_mut().zip([dy / thickness, dy / cube, middle * dy / cube, square * dy / cube])
                {
                    *sum += part;
                }
            }
            height_mm.push(y);
            integrals.push(total);
        }
        let chord = thirty_degree_point(tooth);
        Self {
            tooth: tooth.clone(),
            material: *material,
            height_mm,
            integrals,
            root_chord_mm: 2.0 * chord.x,
            root_chord_height_mm: chord.y - foot_mm,
            foot_mm,
        }
    }

    /// Deflection of tooth and body over line load, for load on the flank point with radius of curvature `rho_mm`.
    pub fn mm2_per_n(&self, rho_mm: f64) -> f64 {
        self.along_mm2_per_n(&self.tooth.load_line(rho_mm))
    }

    /// Deflection of tooth and body over line load, for any load line.
    pub(crate) fn along_mm2_per_n(&self, load: &LoadLine) -> f64 {
        let y_p = load.centre_line_mm - self.foot_mm;
        let nu = self.material.poisson_ratio;
        let (cos2, tan2) = (load.load_angle_rad.cos().powi(2), load.load_angle_rad.tan().powi(2));
        let shear = 1.0 + 0.294 * tan2;

        let [area, cubic, first, second] = self.integrals_at(y_p);
        let bending = y_p * y_p * cubic - 2.0 * y_p * first + second;
        let tooth = 12.0 * (1.0 - nu * nu) * bending + 2.4 * (1.0 + nu) * shear * area;

        let lever = (y_p - self.root_chord_height_mm) / self.root_chord_mm;
        let body = 5.2 * lever * lever + lever + 1.4 * shear;
        cos2 / self.material.young_modulus_mpa * (tooth + body)
    }

    /// Integrals up to height `y_mm`; zeros at or below the foot.
    fn integrals_at(&self, y_mm: f64) -> [f64; 4] {
        let after = self.height_mm.partition_point(|&y| y <= y_mm).clamp(1, self.height_mm.len() - 1);
        let (low, high) = (self.height_mm[after - 1], self.height_mm[after]);
        let weight = ((y_mm - low) / (high - low)).clamp(0.0, 1.0);
        std::array::from_fn(|k| {
            let (a, b) = (self.integrals[after - 1][k], self.integrals[after][k]);
            a + weight * (b - a)
        })
    }
}

/// Angle of the fillet's tangent to the tooth's centre line less 30°, rad.
fn beyond_thirty_degrees(tooth: &Tooth, t: f64) -> f64 {
    let tangent = Rotation2::new(PI / tooth.z()) * tooth.trochoid.tangent(t);
    tangent.x.atan2(tangent.y) - 30f64.to_radians()
}

/// Point of the fillet with a tangent at 30° to the tooth's centre line, in the tooth's frame; the end of the fillet where
/// there is none.
fn thirty_degree_point(tooth: &Tooth) -> Vector2<f64> {
    let (mut flat, mut steep) = (FRAC_PI_2, tooth.fillet_end_angle_rad);
    if beyond_thirty_degrees(tooth, steep) < 0.0 {
        for _ in 0..80 {
            let middle = 0.5 * (flat + steep);
            if beyond_thirty_degrees(tooth, middle) > 0.0 {
                flat = middle;
            } else {
                steep = middle;
            }
        }
    }
    in_tooth_frame(tooth, tooth.trochoid.point_mm(steep))
}
