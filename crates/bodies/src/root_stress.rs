//! Nominal tooth root stress of ISO 6336-3 Method B and VDI 2736-2, without a contact analysis.
//!
//! The spur gear of the normal section has z_n = z/(cos² β_b cos β) teeth, and ε_αn = ε_α/cos² β_b. At the point of the generated fillet with a
//! tangent at 30° to the middle line of the tooth, with the generating profile shift x_E and lengths in m_n,
//!
//! ```text
//! G = ρ_fP − h_fP + x_E     E = π/4 − h_fP tan α_n − (1 − sin α_n) ρ_fP/cos α_n
//! θ = 2G/z_n tan θ − H      H = 2/z_n (π/2 − E) − π/3
//! s_Fn = z_n sin(π/3 − θ) + √3 (G/cos θ − ρ_fP)
//! ρ_F  = ρ_fP + 2G²/(cos θ (z_n cos² θ − 2G))
//! ```
//!
//! The load acts on the circle d_e: at the outer point of single pair contact (ISO 6336-3), d_en with
//! √(d_en² − d_bn²) = √(d_an² − d_bn²) − 2π m_n cos α_n (ε_αn − 1), or at the tip, d_an = z_n m_n + d_a − d (VDI 2736-2). With
//! cos α_e = d_bn/d_e, γ_e = (π/2 + 2 x_E tan α_n)/z_n + inv α_n − inv α_e and α_Fe = α_e − γ_e,
//!
//! ```text
//! h_F = ½ [(cos γ_e − sin γ_e tan α_Fe) d_e/m_n − z_n cos(π/3 − θ) − G/cos θ + ρ_fP]
//! Y_F = 6 h_F cos α_Fe/(s_Fn² cos α_n)
//! Y_S = (1.2 + 0.13 L) q_s^[1/(1.21 + 2.3/L)]       L = s_Fn/h_F   q_s = s_Fn/(2 ρ_F)
//! Y_β = 1 − ε_β β/120°                              ε_β ≤ 1, β ≤ 30°
//!
//! ISO 6336-3   σ_F0 = F_t/(b m_n) Y_F Y_S Y_β                        Y_B = Y_DT = 1
//! VDI 2736-2   σ_F  = F_t/(b m_n) Y_Fa Y_Sa Y_β (0.25 + 0.75/ε_αn)     K_F = 1
//! ```
//!
//! Without load factors, thin rims and grinding notches; undercut is included as far as the rack's rounding generates it. Y_S holds for
//! 1 ≤ q_s < 8. From ε_αn = 2 on there is no single pair contact, and no stress of ISO 6336-3.
//!
//! Sources: ISO 6336-3:2006, clauses 5 to 8, Method B (the edition of 2019 has one more factor f_ε); VDI 2736-2:2014, root stress.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};

use crate::gear::involute::inv;
use crate::gear::{Gear, GearPair};

/// Steps of Newton's method for θ, of which four or five are needed.
const STEPS: usize = 50;

/// Point at which a tooth carries the whole load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadedAt {
    /// Outer point of single pair contact.
    SinglePairContact,
    /// Tip.
    Tip,
}

/// Critical section of a tooth under that load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootSection {
    /// Bending moment arm h_F, mm.
    pub moment_arm_mm: f64,
    /// Chord s_Fn, mm.
    pub thickness_mm: f64,
    /// Fillet radius ρ_F, mm.
    pub fillet_radius_mm: f64,
    /// Load angle α_Fe, rad.
    pub load_angle_rad: f64,
    /// Form factor Y_F.
    pub form_factor: f64,
    /// Stress correction factor Y_S.
    pub stress_correction_factor: f64,
    /// Nominal stress under 1 N/mm of circumferential load F_t/b at the reference circle, MPa.
    pub stress_per_load_per_mm: f64,
}

/// Virtual contact ratio ε_αn.
fn virtual_contact_ratio(pair: &GearPair) -> f64 {
    pair.path.contact_ratio() / pair.base_helix_angle_rad().cos().powi(2)
}

/// Helix angle factor Y_β.
fn helix_factor(pair: &GearPair) -> f64 {
    1.0 - pair.overlap_ratio().min(1.0) * pair.spec.helix_angle_rad.abs().to_degrees().min(30.0) / 120.0
}

/// Critical section of `gear`; `None` where the formulas do not hold, and of internal teeth, whose fillet no rack generates.
pub fn section(pair: &GearPair, gear: Gear, at: LoadedAt) -> Option<RootSection> {
    let spec = &pair.spec;
    if spec.gears[gear].ring.is_some() {
        return None;
    }
    let (m_n, alpha) = (spec.normal_module_mm, spec.normal_pressure_angle_rad);
    let (rack, shift) = (spec.rack, spec.generating_shift_mm(gear) / m_n);
    let (rho, contact_ratio) = (rack.fillet_radius_factor, virtual_contact_ratio(pair));
    let teeth =
        f64::from(spec.gears[gear].teeth) / (pair.base_helix_angle_rad().cos().powi(2) * spec.helix_angle_rad.cos());

    let g = rho - rack.dedendum_factor + shift;
    let e = FRAC_PI_4 - rack.dedendum_factor * alpha.tan() - (1.0 - alpha.sin()) * rho / alpha.cos();
    let h = 2.0 / teeth * (FRAC_PI_2 - e) - FRAC_PI_3;
    let mut theta = FRAC_PI_6;
    for _ in 0..STEPS {
        let slope = 1.0 - 2.0 * g / teeth / theta.cos().powi(2);
        theta -= (theta - 2.0 * g / teeth * theta.tan() + h) / slope;
    }
    let thickness = teeth * (FRAC_PI_3 - theta).sin() + 3f64.sqrt() * (g / theta.cos() - rho);
    let fillet_radius = rho + 2.0 * g * g / (theta.cos() * (teeth * theta.cos().powi(2) - 2.0 * g));

    // Radii in m_n.
    let base = 0.5 * teeth * alpha.cos();
    let tip = 0.5 * teeth + (pair.teeth[gear].edge_radius_mm() - spec.reference_radius_mm(gear)) / m_n;
    let at_tip = (tip * tip - base * base).sqrt();
    let (length, contact_ratio_factor) = match at {
        LoadedAt::SinglePairContact if contact_ratio >= 2.0 => return None,
        LoadedAt::SinglePairContact => (at_tip - PI * alpha.cos() * (contact_ratio - 1.0).max(0.0), 1.0),
        LoadedAt::Tip => (at_tip, 0.25 + 0.75 / contact_ratio),
    };
    let loaded_angle = length.atan2(base);
    let gamma = (FRAC_PI_2 + 2.0 * shift * alpha.tan()) / teeth + inv(alpha) - inv(loaded_angle);
    let load_angle = loaded_angle - gamma;
    let above = (gamma.cos() - gamma.sin() * load_angle.tan()) * 2.0 * base.hypot(length);
    let moment_arm = 0.5 * (above - teeth * (FRAC_PI_3 - theta).cos() - g / theta.cos() + rho);

    let form_factor = 6.0 * moment_arm * load_angle.cos() / (thickness.powi(2) * alpha.cos());
    let (slenderness, notch) = (thickness / moment_arm, 0.5 * thickness / fillet_radius);
    let stress_correction_factor = (1.2 + 0.13 * slenderness) * notch.powf(1.0 / (1.21 + 2.3 / slenderness));
    let is_tooth = length > 0.0 && thickness > 0.0 && moment_arm > 0.0;
    let holds = (0.0..FRAC_PI_2).contains(&theta) && is_tooth && (1.0..8.0).contains(&notch);
    holds.then(|| RootSection {
        moment_arm_mm: m_n * moment_arm,
        thickness_mm: m_n * thickness,
        fillet_radius_mm: m_n * fillet_radius,
        load_angle_rad: load_angle,
        form_factor,
        stress_correction_factor,
        stress_per_load_per_mm: form_factor * stress_correction_factor * helix_factor(pair) * contact_ratio_factor
            / m_n,
    })
}
