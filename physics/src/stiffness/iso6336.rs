//! Single stiffness c' of ISO 6336-1, the greatest stiffness of one tooth pair per mm of face width, flattening included.
//!
//! ```text
//! q'    = C1 + C2/z_n1 + C3/z_n2 + C4 x1 + C5 x1/z_n1 + C6 x2 + C7 x2/z_n2 + C8 x1² + C9 x2²     (µm·mm/N)
//! c'_th = 1/q'
//! c'    = c'_th C_M C_R C_B cos β · E/E_St     C_M = 0.8, C_R = 1 (solid discs)
//! C_B   = [1 + 0.5 (1.2 − h_fP/m_n)] [1 − 0.02 (20° − α_n)]
//! ```
//!
//! The mesh stiffness of all pairs is c_γα = c' (0.75 ε_α + 0.25), and c_γβ = 0.85 c_γα for the load distribution over the face width.
//!
//! Gear 1 is the pinion, the gear with fewer teeth, whichever drives. Of an internal wheel z_n2 is infinite.
//!
//! Below 100 N/mm of line load c' is proportional to the fourth root of the load. The value is constant along the path of contact.
//!
//! Source: ISO 6336-1, section on tooth stiffness (method B).

use gearwear_bodies::gear::{Gear, PerGear, spec::PairSpec};
use gearwear_bodies::material::Material;

/// Coefficients C1 … C9.
const C: [f64; 9] = [0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182];
/// Young's modulus of the standard's steel, MPa.
const STEEL_MPA: f64 = 206e3;
/// Correction for the difference between measured and calculated deflection.
const MEASURED: f64 = 0.8;

/// Theoretical single stiffness c'_th in N/(mm·µm).
pub(crate) fn theoretical_single_stiffness_n_per_mm_um(spec: &PairSpec) -> f64 {
    let smaller = if spec.gears.pinion.teeth <= spec.gears.wheel.teeth { Gear::Pinion } else { Gear::Wheel };
    let (x1, x2) = (spec.gears[smaller].profile_shift, spec.gears[smaller.mate()].profile_shift);
    let base_helix = (spec.helix_angle_rad.sin() * spec.normal_pressure_angle_rad.cos()).asin();
    let virtual_teeth =
        |gear: Gear| f64::from(spec.gears[gear].teeth) / (base_helix.cos().powi(2) * spec.helix_angle_rad.cos());
    let z1 = virtual_teeth(smaller);
    let z2 = if spec.is_internal() { f64::INFINITY } else { virtual_teeth(smaller.mate()) };
    let terms = [1.0, 1.0 / z1, 1.0 / z2, x1, x1 / z1, x2, x2 / z2, x1 * x1, x2 * x2];
    1.0 / C.iter().zip(terms).map(|(c, term)| c * term).sum::<f64>()
}

/// Ratio c_γα/c' for a transverse contact ratio of at least 1.
pub fn mesh_over_single(transverse_contact_ratio: f64) -> f64 {
    0.75 * transverse_contact_ratio + 0.25
}

/// Ratio c_γβ/c_γα of the mesh stiffness for misalignment (K_Hβ) to that for dynamics and load sharing.
pub const MISALIGNED_OVER_MESH: f64 = 0.85;

/// Single stiffness c' in N per mm of approach and mm of face width.
pub fn single_stiffness_n_per_mm2(spec: &PairSpec, material: &PerGear<Material>, line_load_n_per_mm: f64) -> f64 {
    let rack = (1.0 + 0.5 * (1.2 - spec.rack.dedendum_factor))
        * (1.0 - 0.02 * (20.0 - spec.normal_pressure_angle_rad.to_degrees()));
    let (e1, e2) = (material.pinion.young_modulus_mpa, material.wheel.young_modulus_mpa);
    let modulus = 2.0 * e1 * e2 / (e1 + e2) / STEEL_MPA;
    let light_load = (line_load_n_per_mm / 100.0).min(1.0).powf(0.25);
    1e3 * theoretical_single_stiffness_n_per_mm_um(spec)
        * MEASURED
        * rack
        * spec.helix_angle_rad.cos()
        * modulus
        * light_load
}
