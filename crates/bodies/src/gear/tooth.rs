//! Circles and generated tooth of one gear.
//!
//! With the generating profile shift x_E = x + E_sn / (2 m_n tan α_n) (E_sn the tooth thickness allowance), the tooth
//! is 2ψ(r) wide in angle at radius r:
//!
//! ```text
//! ψ(r) = (π/2 + 2 x_E tan α_n) / z + inv α_t − inv α(r)
//! ```
//!
//! On an internal gear z and all radii and angles of the tooth are negative (sign convention of DIN 3960): "above" is towards the tip on both.
//!
//! Source: ISO 21771, sections 4 and 5; the lower end of the involute from the rack's rounding ([`RootTrochoid`]), and
//! where the rack undercuts the flank from the intersection of trochoid and involute.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::{
    Gear, PairError,
    fillet::Fillet,
    internal_error::InternalError,
    involute::{Involute, inv, inverse_inv},
    ring_fillet::RingFillet,
    root_trochoid::{RackTip, RootTrochoid, greatest_dedendum_factor, greatest_fillet_radius_factor},
    spec::PairSpec,
    tip_chamfer::TipChamfer,
};

/// Circles and tooth of one gear; radii in mm, transverse, negative on an internal gear.
#[derive(Debug, Clone, PartialEq)]
pub struct Tooth {
    /// Number of teeth z.
    pub teeth: u32,
    /// Reference radius r.
    pub reference_radius_mm: f64,
    /// Involute of the flank.
    pub involute: Involute,
    /// Tip radius r_a.
    pub tip_radius_mm: f64,
    /// Chamfer of its tip edges.
    pub tip_chamfer: Option<TipChamfer>,
    /// Root radius r_f.
    pub root_radius_mm: f64,
    /// Root form radius r_Ff, where the involute begins.
    pub root_form_radius_mm: f64,
    /// Whether the tooth is undercut.
    pub undercut: bool,
    /// Root fillet.
    pub trochoid: Fillet,
    /// Normal angle of the rack at the end of the fillet.
    pub fillet_end_angle_rad: f64,
    /// Half angle ψ_b of the tooth at the base circle.
    pub base_half_angle_rad: f64,
}

impl Tooth {
    /// Generates the tooth of `gear` with a tip radius.
    ///
    /// # Errors
    /// [`PairError::RackPointed`], [`PairError::RackTipPointed`], [`PairError::NoTooth`],
    /// [`PairError::TipBelowForm`], [`PairError::PointedTooth`], [`PairError::TipChamferTooLarge`], [`PairError::TipChamferAngle`], [`PairError::BoreTooLarge`], [`PairError::Internal`].
    pub fn new(spec: &PairSpec, gear: Gear, tip_radius_mm: f64) -> Result<Self, PairError> {
        let own = &spec.gears[gear];
        let (m_n, alpha_n) = (spec.normal_module_mm, spec.normal_pressure_angle_rad);
        let alpha_t = spec.transverse_pressure_angle_rad();
        let reference_radius_mm = spec.reference_radius_mm(gear);
        let involute = Involute { base_radius_mm: reference_radius_mm * alpha_t.cos() };

        let rack = RackTip {
            normal_module_mm: m_n,
            normal_pressure_angle_rad: alpha_n,
            helix_angle_rad: spec.helix_angle_rad,
            dedendum_factor: spec.rack.dedendum_factor,
            fillet_radius_factor: spec.rack.fillet_radius_factor,
        };
        let greatest = greatest_fillet_radius_factor(alpha_n, rack.dedendum_factor);
        if greatest < 0.0 {
            return Err(PairError::RackPointed { greatest_dedendum_factor: greatest_dedendum_factor(alpha_n) });
        }
        if rack.fillet_radius_factor > greatest {
            return Err(PairError::RackTipPointed { greatest });
        }
        let generating_shift_mm = spec.generating_shift_mm(gear);
        let trochoid = match &own.ring {
            Some(ring) => Fillet::Ring(RingFillet::new(spec, ring)?),
            None => Fillet::Rack(RootTrochoid::new(&rack, reference_radius_mm, generating_shift_mm)),
        };
        let root_radius_mm = trochoid.root_radius_mm();
        let base_half_angle_rad = spec.base_half_angle_rad(gear);

        let tooth = Self {
            teeth: own.teeth,
            reference_radius_mm,
            involute,
            tip_radius_mm,
            tip_chamfer: spec.tip_chamfer(gear),
            root_radius_mm,
            root_form_radius_mm: 0.0,
            undercut: false,
            trochoid,
            fillet_end_angle_rad: trochoid.first_angle_rad(),
            base_half_angle_rad,
        };
        tooth.check(gear, own.bore_diameter_mm)?;
        let tooth = tooth.with_root_form(gear, alpha_t)?;
        tooth.check_chamfer(gear)?;
        Ok(tooth)
    }

    /// Refuses a tooth without flank, without tip land or without body.
    fn check(&self, gear: Gear, bore_diameter_mm: Option<f64>) -> Result<(), PairError> {
        if self.is_internal() {
            self.check_ring()?;
        } else if self.root_radius_mm <= 0.0 || self.base_half_angle_rad <= 0.0 {
            return Err(PairError::NoTooth { gear });
        }
        // Not a number below the base circle, which the form circle's check refuses.
        let tip_thickness_mm = self.thickness_mm(self.tip_radius_mm);
        if tip_thickness_mm <= 0.0 {
            let pointed = self.involute.base_radius_mm / inverse_inv(self.base_half_angle_rad).cos();
            return Err(PairError::PointedTooth {
                gear,
                tip_thickness_mm,
                tip_diameter_mm: 2.0 * self.tip_radius_mm,
                pointed_diameter_mm: 2.0 * pointed,
            });
        }
        match bore_diameter_mm {
            Some(bore) if !self.is_internal() && bore >= 2.0 * self.root_radius_mm => Err(PairError::BoreTooLarge {
                gear,
                bore_diameter_mm: bore,
                root_diameter_mm: 2.0 * self.root_radius_mm,
            }),
            _ => Ok(()),
        }
    }

    /// Refuses a ring without involute at its tip.
    fn check_ring(&self) -> Result<(), InternalError> {
        let tip_diameter_mm = 2.0 * self.tip_radius_mm.abs();
        let base_diameter_mm = 2.0 * self.involute.base_radius_mm.abs();
        if tip_diameter_mm < base_diameter_mm {
            return Err(InternalError::TipInsideBase { tip_diameter_mm, base_diameter_mm });
        }
        let Fillet::Ring(fillet) = &self.trochoid else { return Ok(()) };
        match fillet.least_tip_diameter_mm() {
            Some(least_mm) if tip_diameter_mm < least_mm => {
                Err(InternalError::CutterCutsTips { tip_diameter_mm, least_mm })
            }
            _ => Ok(()),
        }
    }

    /// Sets the root form circle, where fillet and involute meet.
    fn with_root_form(mut self, gear: Gear, alpha_t: f64) -> Result<Self, PairError> {
        if let Some(rho) = self.trochoid.involute_end_rho_mm(alpha_t) {
            self.root_form_radius_mm = self.involute.radius_mm(rho);
        } else {
            self.undercut = true;
            self.fillet_end_angle_rad = self.undercut_angle_rad().ok_or(PairError::NoTooth { gear })?;
            self.root_form_radius_mm = self.trochoid.point_mm(self.fillet_end_angle_rad).norm();
        }
        if self.root_form_radius_mm < self.tip_radius_mm {
            return Ok(self);
        }
        let (tip_diameter_mm, form_diameter_mm) = (2.0 * self.tip_radius_mm, 2.0 * self.root_form_radius_mm);
        if self.is_internal() {
            let [tip_diameter_mm, form_diameter_mm] = [tip_diameter_mm, form_diameter_mm].map(f64::abs);
            return Err(InternalError::TipBeyondForm { tip_diameter_mm, form_diameter_mm }.into());
        }
        Err(PairError::TipBelowForm { gear, tip_diameter_mm, form_diameter_mm })
    }

    /// Angle by which the fillet point `t` lies inside the involute; `None` below the base circle.
    fn fillet_inside_rad(&self, t: f64) -> Option<f64> {
        let point = self.trochoid.point_mm(t);
        let radius = point.norm();
        (radius >= self.involute.base_radius_mm).then(|| point.x.atan2(point.y) - self.space_half_angle_rad(radius))
    }

    /// Normal angle of the rack where the fillet of an undercut tooth intersects the involute.
    fn undercut_angle_rad(&self) -> Option<f64> {
        const SAMPLES: usize = 2000;
        let (first, last) = (FRAC_PI_2, self.trochoid.first_angle_rad());
        let (mut inside, mut before) = (None, first);
        for k in 0..=SAMPLES {
            let t = first + (last - first) * k as f64 / SAMPLES as f64;
            match self.fillet_inside_rad(t) {
                Some(angle) if angle > 0.0 => inside = Some(t),
                Some(_) => {
                    // Bisection between the last point inside the tooth and this one outside, to round-off.
                    let (mut a, mut b) = (inside.unwrap_or(before), t);
                    for _ in 0..80 {
                        let middle = 0.5 * (a + b);
                        match self.fillet_inside_rad(middle) {
                            Some(angle) if angle <= 0.0 => b = middle,
                            _ => a = middle,
                        }
                    }
                    return Some(b);
                }
                None => {}
            }
            before = t;
        }
        None
    }

    /// Number of teeth z with the sign of ISO 21771, negative on an internal gear.
    pub fn z(&self) -> f64 {
        self.involute.signed(f64::from(self.teeth))
    }

    /// Whether the teeth are internal.
    pub fn is_internal(&self) -> bool {
        self.involute.base_radius_mm < 0.0
    }

    /// Radius and angle from +y of a point in the frame of a space or tooth with its centre line on the axis y, both negative on an internal gear.
    pub fn polar(&self, point_mm: Vector2<f64>) -> (f64, f64) {
        let sign = self.involute.signed(1.0);
        (self.involute.signed(point_mm.norm()), (sign * point_mm.x).atan2(sign * point_mm.y))
    }

    /// Half angle ψ(r) of the tooth at `radius_mm` (≥ base radius), rad.
    pub fn half_angle_rad(&self, radius_mm: f64) -> f64 {
        let rho = self.involute.curvature_radius_mm(radius_mm);
        self.base_half_angle_rad - inv(self.involute.pressure_angle_rad(rho))
    }

    /// Half angle of the space between two teeth at `radius_mm`, rad.
    pub fn space_half_angle_rad(&self, radius_mm: f64) -> f64 {
        PI / self.z() - self.half_angle_rad(radius_mm)
    }

    /// Transverse tooth thickness on the circle of `radius_mm`, mm of arc.
    pub fn thickness_mm(&self, radius_mm: f64) -> f64 {
        2.0 * radius_mm * self.half_angle_rad(radius_mm)
    }

    /// Length along the flank of a tip rounding of this radius, ρ_k tan(γ/2) with the angle γ between flank and tip circle or chamfer.
    pub fn tip_rounding_length_mm(&self, rounding_mm: f64) -> f64 {
        rounding_mm * (0.5 * self.edge_turn_rad()).tan()
    }

    /// Radius of curvature at the tip circle, to which the involute goes on where a chamfer removes it.
    pub fn tip_rho_mm(&self) -> f64 {
        self.involute.curvature_radius_mm(self.tip_radius_mm)
    }

    /// Radius of curvature at the first point of a row along the flank: on the base circle, or at the form circle of an internal tooth.
    pub fn first_rho_mm(&self) -> f64 {
        if self.is_internal() { self.root_form_rho_mm() } else { 0.0 }
    }

    /// Radius of curvature at the root form circle.
    pub fn root_form_rho_mm(&self) -> f64 {
        self.involute.curvature_radius_mm(self.root_form_radius_mm)
    }
}

/// Line of a load through a tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadLine {
    /// Load angle α_F = α − ψ to the perpendicular of the tooth's centre line.
    pub load_angle_rad: f64,
    /// Distance of the intersection with the centre line from the gear's axis.
    pub centre_line_mm: f64,
    /// Distance from the flank to the centre line along the line of the load.
    pub depth_mm: f64,
}

impl LoadLine {
    /// Line turned by `turn_rad` towards the tooth's axis about its point at the depth `about_mm`: that of a load on a rounding of this
    /// radius that begins at the flank point of the line.
    pub fn turned(&self, about_mm: f64, turn_rad: f64) -> Self {
        // Height of the point above the intersection with the centre line, and its distance from that line.
        let (sin, cos) = self.load_angle_rad.sin_cos();
        let (above_mm, beside_mm) = ((self.depth_mm - about_mm) * sin, (self.depth_mm - about_mm) * cos);
        let load_angle_rad = self.load_angle_rad + turn_rad;
        Self {
            load_angle_rad,
            centre_line_mm: self.centre_line_mm + above_mm - beside_mm * load_angle_rad.tan(),
            depth_mm: about_mm + beside_mm / load_angle_rad.cos(),
        }
    }
}

impl Tooth {
    /// Radius of the nominal flank point whose normal passes through `point_mm` of the modified profile, mm, in the tooth's own frame with its
    /// centre line on +y and the flank at x < 0. Normals of an
    /// involute are tangents of the base circle: that through the point touches it at the roll angle of the flank point.
    pub fn nominal_radius_mm(&self, point_mm: Vector2<f64>) -> f64 {
        let base = self.involute.base_radius_mm;
        let (radius, angle) = self.polar(point_mm);
        let beyond_base = (base / radius).min(1.0).acos();
        let from_centre_line = -angle;
        let roll_angle = self.base_half_angle_rad - from_centre_line + beyond_base;
        self.involute.radius_mm(base * roll_angle.max(0.0))
    }

    /// Line of a load along the flank's normal at radius of curvature `rho_mm`.
    pub fn load_line(&self, rho_mm: f64) -> LoadLine {
        let radius = self.involute.radius_mm(rho_mm);
        let half_angle = self.half_angle_rad(radius);
        let load_angle_rad = self.involute.pressure_angle_rad(rho_mm) - half_angle;
        let half_chord = radius * half_angle.sin();
        LoadLine {
            load_angle_rad,
            centre_line_mm: radius * half_angle.cos() - half_chord * load_angle_rad.tan(),
            depth_mm: half_chord / load_angle_rad.cos(),
        }
    }
}
