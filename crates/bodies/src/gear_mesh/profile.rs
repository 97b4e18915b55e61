//! Exact curves of the outline of one tooth, from the cut in the middle of a space to the tip.
//!
//! Half with x > 0, the tooth's centre line on +y; the other half is its mirror image. Angles θ run clockwise from
//! the centre line. An internal tooth has negative radii and angles, and its centre line on −y: its tip points to +y too. From root to tip the
//! pieces are the arc of the root circle, the fillet, the flank, and rounding and chamfer of the tip edge:
//!
//! ```text
//! flank      P(ρ) = T + (ρ − c(ρ)) n       T = r_b (sin θ_T, cos θ_T),   n = (cos θ_T, −sin θ_T),   θ_T = ψ_b − ρ/r_b
//! tip        ρ − c(ρ) = ρ_a                where the flank with its material c removed along the normal reaches r_a, or r_Fa of a chamfer
//! rounding   |P − r_k N| = r_a − r_k       N: outward normal of the relieved flank; the circle touches both
//!            (P − r_k N − K) n_K = −r_k    on a chamfer from K with the outward normal n_K
//! ```
//!
//! Where material is removed at the end of the involute, the fillet is shifted there by the same amount along the flank's normal, fading
//! smoothly to nothing on the root circle.
//!
//! Source: the string construction of the involute, ISO 21771 section 4; [`crate::gear::removed_material`].

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::ToothMeshError;
use crate::gear::{modification::Modification, removed_material::removed_mm, tip_chamfer::TipChamfer, tooth::Tooth};

/// Curve of the outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Piece {
    /// Arc of the root circle, from the cut.
    RootArc,
    /// Root trochoid.
    Fillet,
    /// Involute less the removed material.
    Flank,
    /// Rounding of the tip edge.
    Rounding,
    /// Chamfer of the tip edge.
    Chamfer,
    /// Half of the tip circle's arc, to the centre line.
    Land,
}

/// Straight line from the flank to the tip circle.
#[derive(Debug, Clone, Copy)]
struct Chamfer {
    /// End of the flank, or of the rounding.
    from_mm: Vector2<f64>,
    /// End of the tip land.
    to_mm: Vector2<f64>,
}

impl Chamfer {
    /// The chamfer of a tooth whose relieved flank ends at `edge_mm`.
    fn new(tooth: &Tooth, edge_mm: Vector2<f64>) -> Option<Self> {
        let (TipChamfer { angle_rad, .. }, length_mm) = tooth.tip_chamfer.zip(tooth.chamfer_length_mm())?;
        let (sin, cos) = (tooth.polar(edge_mm).1 - angle_rad).sin_cos();
        Some(Self { from_mm: edge_mm, to_mm: edge_mm + length_mm * Vector2::new(sin, cos) })
    }

    /// Outward normal.
    fn normal(&self) -> Vector2<f64> {
        let along = (self.to_mm - self.from_mm).normalize();
        Vector2::new(along.y, -along.x)
    }
}

/// The circle tangent to flank and tip circle, or chamfer.
#[derive(Debug, Clone, Copy)]
struct Rounding {
    centre_mm: Vector2<f64>,
    radius_mm: f64,
    /// Direction from the centre to the end of the flank, anticlockwise from +x.
    first_rad: f64,
    sweep_rad: f64,
}

/// The curves of one tooth.
#[derive(Debug, Clone)]
pub(super) struct Profile<'a> {
    tooth: &'a Tooth,
    modification: Modification,
    active_start_rho_mm: f64,
    /// ρ where the flank ends: on the tip circle or where rounding or chamfer begin.
    flank_end_rho_mm: f64,
    rounding: Option<Rounding>,
    chamfer: Option<Chamfer>,
    /// Half angle of the tip land.
    land_rad: f64,
}

impl<'a> Profile<'a> {
    /// Curves of `tooth` with `modification`, its active profile beginning at `active_start_rho_mm`.
    pub(super) fn new(
        tooth: &'a Tooth,
        modification: &Modification,
        active_start_rho_mm: f64,
    ) -> Result<Self, ToothMeshError> {
        let mut profile = Self {
            tooth,
            modification: *modification,
            active_start_rho_mm,
            flank_end_rho_mm: 0.0,
            rounding: None,
            chamfer: None,
            land_rad: 0.0,
        };
        // Beyond the end of the plain involute the removed material is constant.
        profile.flank_end_rho_mm = tooth.edge_rho_mm() + profile.removed_mm(tooth.edge_rho_mm());
        // The flank is most curved where it is nearest to its base circle: at the tip of an internal tooth.
        let curved_rho = if tooth.is_internal() { tooth.edge_rho_mm() } else { tooth.root_form_rho_mm() };
        let (rho_mm, removed_mm) = (curved_rho.abs(), profile.removed_mm(curved_rho));
        if removed_mm > 0.5 * rho_mm && removed_mm > 0.0 {
            return Err(ToothMeshError::ReliefBeyondCurvature { removed_mm, rho_mm });
        }
        let corner = profile.flank_mm(profile.flank_end_rho_mm);
        profile.chamfer = Chamfer::new(tooth, corner);
        profile.land_rad = tooth.polar(profile.chamfer.map_or(corner, |chamfer| chamfer.to_mm)).1;
        if profile.land_mm() <= 0.0 {
            return Err(ToothMeshError::PointedTip { tip_radius_mm: tooth.tip_radius_mm });
        }
        Ok(profile)
    }

    /// The profile with its tip edge rounded.
    pub(super) fn rounded(mut self, radius_mm: f64) -> Result<Self, ToothMeshError> {
        if radius_mm <= 0.0 {
            return Ok(self);
        }
        let error = ToothMeshError::TipRounding { radius_mm };
        let (mut low, mut high) = (self.active_start_rho_mm, self.flank_end_rho_mm);
        if self.beyond_tip_mm(low, radius_mm) >= 0.0 || self.beyond_tip_mm(high, radius_mm) <= 0.0 {
            return Err(error);
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.beyond_tip_mm(middle, radius_mm) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let normal = self.normal(low);
        let centre_mm = self.flank_mm(low) - radius_mm * normal;
        let first_rad = normal.y.atan2(normal.x);
        let outwards =
            self.chamfer.map_or_else(|| self.tooth.involute.signed(1.0) * centre_mm, |chamfer| chamfer.normal());
        let sweep_rad = outwards.y.atan2(outwards.x) - first_rad;
        match &mut self.chamfer {
            Some(chamfer) => chamfer.from_mm = centre_mm + radius_mm * outwards,
            None => self.land_rad = outwards.x.atan2(outwards.y),
        }
        let is_beyond_chamfer = self.chamfer.is_some_and(|Chamfer { from_mm, to_mm }| to_mm.y < from_mm.y);
        if sweep_rad <= 0.0 || self.land_mm() < 0.0 || is_beyond_chamfer {
            return Err(error);
        }
        self.flank_end_rho_mm = low;
        self.rounding = Some(Rounding { centre_mm, radius_mm, first_rad, sweep_rad });
        Ok(self)
    }

    /// Distance by which a circle tangent to the flank at ρ from inside reaches beyond the tip circle or the chamfer, mm.
    fn beyond_tip_mm(&self, rho_mm: f64, radius_mm: f64) -> f64 {
        let centre_mm = self.flank_mm(rho_mm) - radius_mm * self.normal(rho_mm);
        if let Some(chamfer) = &self.chamfer {
            return (centre_mm - chamfer.from_mm).dot(&chamfer.normal()) + radius_mm;
        }
        let (centre_radius_mm, _) = self.tooth.polar(centre_mm);
        centre_radius_mm - (self.tooth.tip_radius_mm - radius_mm)
    }

    /// Point of `piece` at `u`, from 0 at its root end to 1.
    pub(super) fn point_mm(&self, piece: Piece, u: f64) -> Vector2<f64> {
        match piece {
            Piece::RootArc => {
                let cut = PI / self.tooth.z();
                let theta = cut - u * self.root_arc_rad();
                self.tooth.root_radius_mm * Vector2::new(theta.sin(), theta.cos())
            }
            Piece::Fillet => self.fillet_mm(u),
            Piece::Flank => self.flank_mm(self.rho_mm(u)),
            Piece::Rounding => match self.rounding {
                Some(rounding) => {
                    let (sin, cos) = (rounding.first_rad + u * rounding.sweep_rad).sin_cos();
                    rounding.centre_mm + rounding.radius_mm * Vector2::new(cos, sin)
                }
                None => self.flank_mm(self.flank_end_rho_mm),
            },
            Piece::Chamfer => match self.chamfer {
                Some(Chamfer { from_mm, to_mm }) => from_mm.lerp(&to_mm, u),
                None => self.flank_mm(self.flank_end_rho_mm),
            },
            Piece::Land => {
                let theta = (1.0 - u) * self.land_rad;
                self.tooth.tip_radius_mm * Vector2::new(theta.sin(), theta.cos())
            }
        }
    }

    /// Radius of curvature of the involute at `u` on the flank, evenly spaced in arc length.
    pub(super) fn rho_mm(&self, u: f64) -> f64 {
        let (first, last) = (self.tooth.root_form_rho_mm(), self.flank_end_rho_mm);
        self.tooth.involute.signed((first * first + u * (last - first) * (last + first)).max(0.0).sqrt())
    }

    /// Parameter of the flank at a radius of curvature; inverse of [`Self::rho_mm`].
    pub(super) fn at_rho(&self, rho_mm: f64) -> f64 {
        let (first, last) = (self.tooth.root_form_rho_mm(), self.flank_end_rho_mm);
        ((rho_mm - first) * (rho_mm + first) / ((last - first) * (last + first))).clamp(0.0, 1.0)
    }

    /// Outward normal of the plain involute at `rho_mm`.
    pub(super) fn involute_normal(&self, rho_mm: f64) -> Vector2<f64> {
        let (sin, cos) = self.string_rad(rho_mm).sin_cos();
        Vector2::new(cos, -sin)
    }

    /// Radii of curvature between the ends of the flank where the removed material has a kink.
    pub(super) fn kinks_rho_mm(&self) -> Vec<f64> {
        let Modification { tip_relief, root_relief, profile_crowning_mm, profile_slope_mm, .. } = self.modification;
        let mut kinks = Vec::new();
        kinks.extend(tip_relief.map(|relief| self.tooth.edge_rho_mm() - relief.length_mm));
        kinks.extend(root_relief.map(|relief| self.active_start_rho_mm + relief.length_mm));
        if root_relief.is_some() || profile_crowning_mm > 0.0 || profile_slope_mm != 0.0 {
            kinks.push(self.active_start_rho_mm);
        }
        kinks.sort_by(f64::total_cmp);
        kinks
    }

    /// Half angle of the root circle's arc between two fillets.
    pub(super) fn root_arc_rad(&self) -> f64 {
        let (sign, foot) = (self.tooth.involute.signed(1.0), self.tooth.trochoid.point_mm(FRAC_PI_2));
        sign * (sign * self.tooth.polar(foot).1).max(0.0)
    }

    /// Half of the arc of the tip land.
    pub(super) fn land_mm(&self) -> f64 {
        self.land_rad * self.tooth.tip_radius_mm
    }

    /// Radius of the tip rounding; 0 where the edge is sharp.
    pub(super) fn rounding_mm(&self) -> f64 {
        self.rounding.map_or(0.0, |rounding| rounding.radius_mm)
    }

    /// Whether the tip edge has a chamfer.
    pub(super) fn has_chamfer(&self) -> bool {
        self.chamfer.is_some()
    }

    /// ρ where the flank ends.
    pub(super) fn flank_end_rho_mm(&self) -> f64 {
        self.flank_end_rho_mm
    }

    fn removed_mm(&self, rho_mm: f64) -> f64 {
        removed_mm(&self.modification, self.tooth, self.active_start_rho_mm, rho_mm)
    }

    /// Angle θ_T at which the string leaves the base circle.
    fn string_rad(&self, rho_mm: f64) -> f64 {
        self.tooth.base_half_angle_rad - rho_mm / self.tooth.involute.base_radius_mm
    }

    fn flank_mm(&self, rho_mm: f64) -> Vector2<f64> {
        let (sin, cos) = self.string_rad(rho_mm).sin_cos();
        let free = rho_mm - self.removed_mm(rho_mm);
        self.tooth.involute.base_radius_mm * Vector2::new(sin, cos) + free * Vector2::new(cos, -sin)
    }

    /// Outward normal of the relieved flank: dP/dρ = (ρ − c)/r_b T/r_b − c' n is its tangent.
    fn normal(&self, rho_mm: f64) -> Vector2<f64> {
        let step = 1e-6 * self.tooth.tip_rho_mm();
        let slope = (self.removed_mm(rho_mm + step) - self.removed_mm(rho_mm - step)) / (2.0 * step);
        let along = (rho_mm - self.removed_mm(rho_mm)) / self.tooth.involute.base_radius_mm;
        let n = self.involute_normal(rho_mm);
        (along * n + slope * Vector2::new(-n.y, n.x)).normalize()
    }

    fn fillet_mm(&self, u: f64) -> Vector2<f64> {
        let t = FRAC_PI_2 + (self.tooth.fillet_end_angle_rad - FRAC_PI_2) * u;
        let in_space = self.tooth.trochoid.point_mm(t);
        // Anticlockwise from the centre line of the space to that of the tooth.
        let (radius_mm, from_space_rad) = self.tooth.polar(in_space);
        let theta = PI / self.tooth.z() - from_space_rad;
        let point = radius_mm * Vector2::new(theta.sin(), theta.cos());
        let form_rho = self.tooth.root_form_rho_mm();
        let fading = u * u * (3.0 - 2.0 * u);
        point - fading * self.removed_mm(form_rho) * self.involute_normal(form_rho)
    }
}
