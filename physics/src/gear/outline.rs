//! The whole transverse outline of a gear as the rack generates it.
//!
//! Going once round the gear, each pitch is: root arc, fillet, flank, tip arc, flank, fillet. Every piece is an exact
//! curve, not a polyline; neighbouring pieces share their end points, and where nothing is undercut the fillet is
//! tangent to the root circle and to the involute.
//!
//! Frame: origin on the axis, the centre line of space 0 is +y, angles θ run clockwise from there.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector2;

use super::tooth::Tooth;

/// Which curve a piece of the outline is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curve {
    /// Arc of the root circle, across the space.
    RootArc,
    /// Root trochoid.
    Fillet,
    /// Involute.
    Flank,
    /// Arc of the tip circle, across the tooth.
    TipArc,
}

/// One piece of the outline, run through from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment<'a> {
    tooth: &'a Tooth,
    /// What it is.
    pub curve: Curve,
    /// Centre line it belongs to: of the space, for the tip arc of the tooth.
    centre_rad: f64,
    /// On the anticlockwise side of the space, where the outline runs from tip to root.
    mirrored: bool,
}

/// The outline of the whole gear, in the order it is run through.
pub fn outline(tooth: &Tooth) -> Vec<Segment<'_>> {
    let pitch_rad = 2.0 * PI / f64::from(tooth.teeth);
    let mut segments = Vec::with_capacity(6 * tooth.teeth as usize);
    for k in 0..tooth.teeth {
        let space = f64::from(k) * pitch_rad;
        let next = f64::from(k + 1) * pitch_rad;
        let mut add = |curve, centre_rad, mirrored| segments.push(Segment { tooth, curve, centre_rad, mirrored });
        add(Curve::RootArc, space, false);
        add(Curve::Fillet, space, false);
        add(Curve::Flank, space, false);
        add(Curve::TipArc, space + 0.5 * pitch_rad, false);
        add(Curve::Flank, next, true);
        add(Curve::Fillet, next, true);
    }
    segments
}

/// Closed polyline of the outline with `per_segment` points on each fillet and flank (≥ 2) and a few on the arcs; the
/// first point is not repeated at the end.
pub fn polyline(tooth: &Tooth, per_segment: usize) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for segment in outline(tooth) {
        let n = match segment.curve {
            Curve::Fillet | Curve::Flank => per_segment.max(2),
            Curve::RootArc | Curve::TipArc => 4,
        };
        points.extend((0..n).map(|i| {
            let p = segment.point_mm(i as f64 / n as f64);
            [p.x, p.y]
        }));
    }
    points
}

impl Segment<'_> {
    /// Point at `tau` in [0, 1], mm.
    pub fn point_mm(&self, tau: f64) -> Vector2<f64> {
        let (radius, theta) = self.polar(tau);
        let theta = self.placed_rad(theta);
        Vector2::new(radius * theta.sin(), radius * theta.cos())
    }

    /// Unit tangent at `tau`, in the direction the outline is run through.
    pub fn tangent(&self, tau: f64) -> Vector2<f64> {
        let (_, theta) = self.polar(tau);
        // Components along the radius and clockwise, for the clockwise side of the space (root to tip).
        let (radial, clockwise) = match self.curve {
            Curve::RootArc | Curve::TipArc => (0.0, 1.0),
            Curve::Fillet => {
                let t = self.tooth.trochoid.tangent(self.fillet_angle_rad(tau));
                (t.x * theta.sin() + t.y * theta.cos(), t.x * theta.cos() - t.y * theta.sin())
            }
            Curve::Flank => {
                let alpha = self.tooth.involute.pressure_angle_rad(self.flank_rho_mm(tau));
                (alpha.cos(), alpha.sin())
            }
        };
        // Mirroring flips the clockwise component, running from tip to root flips both.
        let radial = if self.mirrored { -radial } else { radial };
        let theta = self.placed_rad(theta);
        Vector2::new(radial * theta.sin() + clockwise * theta.cos(), radial * theta.cos() - clockwise * theta.sin())
    }

    /// Radius and angle from the piece's own centre line, before mirroring.
    fn polar(&self, tau: f64) -> (f64, f64) {
        let tooth = self.tooth;
        match self.curve {
            Curve::RootArc => {
                let p = tooth.trochoid.point_mm(FRAC_PI_2);
                (tooth.root_radius_mm, p.x.atan2(p.y) * (2.0 * tau - 1.0))
            }
            Curve::TipArc => (tooth.tip_radius_mm, tooth.half_angle_rad(tooth.tip_radius_mm) * (2.0 * tau - 1.0)),
            Curve::Fillet => {
                let p = tooth.trochoid.point_mm(self.fillet_angle_rad(tau));
                (p.norm(), p.x.atan2(p.y))
            }
            Curve::Flank => {
                let radius = tooth.involute.radius_mm(self.flank_rho_mm(tau));
                (radius, tooth.space_half_angle_rad(radius))
            }
        }
    }

    fn placed_rad(&self, theta: f64) -> f64 {
        if self.mirrored { self.centre_rad - theta } else { self.centre_rad + theta }
    }

    /// From root to tip for the clockwise side, tip to root for the other.
    fn upward(&self, tau: f64) -> f64 {
        if self.mirrored { 1.0 - tau } else { tau }
    }

    fn fillet_angle_rad(&self, tau: f64) -> f64 {
        FRAC_PI_2 + (self.tooth.fillet_end_angle_rad - FRAC_PI_2) * self.upward(tau)
    }

    fn flank_rho_mm(&self, tau: f64) -> f64 {
        let (low, high) = (self.tooth.root_form_rho_mm(), self.tooth.tip_rho_mm());
        low + (high - low) * self.upward(tau)
    }
}
