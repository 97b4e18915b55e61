//! A measured profile on the flank of a gear.
//!
//! Points are arc lengths s = ρ²/(2 r_b) from the base circle, increasing towards the tip, with heights that fall where material
//! is gone. What the simulation says of the same points is
//!
//! ```text
//! z(s) = z₀(s) − h(s)
//! ```
//!
//! with the wear depth h and what the unworn flank would show: nothing of a measured wear depth, − modifications of a height from
//! the nominal involute, and, of a height from a straight line, the sag of the involute besides. The line is the tangent at the
//! middle of the profile; another one differs from it by an offset and a tilt, which form removal takes away (to first order in
//! the angle between them: level the trace to a few degrees).

use super::file::{ArcFrom, HeightFrom, MeasuredFile, PlaceColumn, ValueKind};
use crate::data_table::{DataTableError, not_allowed};
use crate::gear::{Gear, GearPair, involute::Involute, removed_material::removed_mm};

const UM_PER_MM: f64 = 1e3;
/// Part of the flank's height by which a point may lie outside it: files give few decimals.
const OUTSIDE: f64 = 1e-3;

/// A measured profile on a flank.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeasuredProfile {
    /// Whose flank.
    pub gear: Gear,
    /// Arc lengths from the base circle, increasing.
    pub arc_mm: Vec<f64>,
    /// Height at each, falling where material is gone.
    pub height_um: Vec<f64>,
    /// What the heights are.
    pub kind: ValueKind,
    /// What they are measured from.
    pub height_from: HeightFrom,
}

impl MeasuredProfile {
    /// Puts the points of a file on the flank of `gear`.
    ///
    /// # Errors
    /// A point that does not lie on the flank.
    pub(crate) fn on_flank(file: &MeasuredFile, pair: &GearPair, gear: Gear) -> Result<Self, DataTableError> {
        let tooth = &pair.teeth[gear];
        let involute = tooth.involute;
        let arc_at = |rho: f64| involute.arc_mm(rho);
        let (first, last) = (arc_at(tooth.root_form_rho_mm()), arc_at(tooth.tip_rho_mm()));
        let active_start = arc_at(pair.active_start_rho_mm(gear));
        let arc = |place: f64| match (file.place, file.arc_from) {
            (PlaceColumn::RadiusMm, _) => arc_at(involute.curvature_radius_mm(place)),
            (PlaceColumn::RollAngleDeg, _) => arc_at(place.to_radians() * involute.base_radius_mm),
            (PlaceColumn::ArcMm, Some(ArcFrom::Tip)) => last - place,
            (PlaceColumn::ArcMm, Some(ArcFrom::ActiveStart)) => active_start + place,
            (PlaceColumn::ArcMm, _) => place,
        };
        let margin = OUTSIDE * (last - first);
        let mut points = Vec::with_capacity(file.rows.len());
        for row in &file.rows {
            let at = arc(row.place);
            // Below the base circle there is no involute, and no arc that says so.
            let is_below = file.place == PlaceColumn::RadiusMm && row.place < involute.base_radius_mm
                || file.place == PlaceColumn::RollAngleDeg && row.place < 0.0;
            if is_below || at < first - margin || at > last + margin {
                let allowed = limits(file, &involute, [first, active_start, last], gear);
                return Err(not_allowed(row.line, file.place.name(), row.place, allowed));
            }
            points.push((at.clamp(first, last), row.height_um));
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (arc_mm, height_um) = points.into_iter().unzip();
        Ok(Self { gear, arc_mm, height_um, kind: file.kind, height_from: file.height_from })
    }

    /// Radius of each point.
    pub(crate) fn radius_mm(&self, pair: &GearPair) -> Vec<f64> {
        let involute = pair.teeth[self.gear].involute;
        self.arc_mm.iter().map(|&arc| involute.radius_mm(rho_mm(&involute, arc))).collect()
    }

    /// z₀: what the unworn flank would show at each point if it lay `shift_mm` further towards the tip.
    pub(crate) fn unworn_um(&self, pair: &GearPair, shift_mm: f64) -> Vec<f64> {
        let tooth = &pair.teeth[self.gear];
        let involute = tooth.involute;
        let (tip, start) = (tooth.tip_rho_mm(), pair.active_start_rho_mm(self.gear));
        let modification = &pair.spec.gears[self.gear].modification;
        let middle = match (self.arc_mm.first(), self.arc_mm.last()) {
            (Some(first), Some(last)) => rho_mm(&involute, 0.5 * (first + last)),
            _ => start,
        };
        let at = |&arc: &f64| {
            let rho = rho_mm(&involute, arc + shift_mm).min(tip);
            let modified = || removed_mm(modification, tooth, start, rho);
            let sag = || involute.in_tangent_frame(rho, middle).drop_mm;
            UM_PER_MM
                * match (self.kind, self.height_from) {
                    (ValueKind::Wear, _) => 0.0,
                    (ValueKind::Height, HeightFrom::Involute) => -modified(),
                    (ValueKind::Height, HeightFrom::Line) => -modified() - sag(),
                }
        };
        self.arc_mm.iter().map(at).collect()
    }
}

/// ρ at an arc length from the base circle; 0 below it.
fn rho_mm(involute: &Involute, arc_mm: f64) -> f64 {
    involute.rho_at_arc_mm(arc_mm)
}

/// What places are allowed, in the unit of the file.
fn limits(file: &MeasuredFile, involute: &Involute, [first, active_start, last]: [f64; 3], gear: Gear) -> String {
    let place = |arc: f64| match (file.place, file.arc_from) {
        (PlaceColumn::RadiusMm, _) => involute.radius_mm(rho_mm(involute, arc)),
        (PlaceColumn::RollAngleDeg, _) => involute.roll_angle_rad(rho_mm(involute, arc)).to_degrees(),
        (PlaceColumn::ArcMm, Some(ArcFrom::Tip)) => last - arc,
        (PlaceColumn::ArcMm, Some(ArcFrom::ActiveStart)) => arc - active_start,
        (PlaceColumn::ArcMm, _) => arc,
    };
    let (a, b) = (place(first), place(last));
    format!("{:.4} to {:.4}, the {}'s flank", a.min(b), a.max(b), gear.name())
}
