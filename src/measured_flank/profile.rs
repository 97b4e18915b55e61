//! A measured profile on the flank of a gear.
//!
//! Points are arc lengths s = ρ²/(2 r_b) from the base circle, increasing towards the tip, with heights that fall where material
//! is gone. The simulated height of the same points is
//!
//! ```text
//! z(s) = z₀(s) − h(s)/cos β_b
//! ```
//!
//! with the wear depth h normal to the flank (of a measured wear depth without cos β_b) and the height z₀ of the unworn flank: 0 for a measured wear
//! depth, − modifications, or what was measured before the run, for a height from the nominal involute, and less the sag of the involute for a
//! height from a straight line. The line is the tangent at the middle of the profile; another one differs from it by an offset and a tilt, which
//! form removal takes away (to first order in the angle between them: level the trace to a few degrees).

use super::file::{ArcFrom, HeightFrom, MeasuredFile, PlaceColumn, Trace, ValueKind};
use gearwear_bodies::gear::{Gear, GearPair, involute::Involute, removed_material::whole_profile_mm};
use gearwear_files::data_table::{DataTableError, not_allowed};

const UM_PER_MM: f64 = 1e3;
/// Part of the flank's height by which a point may lie outside it: files give few decimals.
const OUTSIDE: f64 = 1e-3;

/// A measured profile on a flank.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredProfile {
    /// Gear of the flank.
    pub gear: Gear,
    /// Arc lengths from the base circle, increasing.
    pub arc_mm: Vec<f64>,
    /// Height at each, falling where material is gone.
    pub height_um: Vec<f64>,
    /// Kind of the heights.
    pub kind: ValueKind,
    /// Reference of the heights.
    pub height_from: HeightFrom,
    /// Leads of the same flanks.
    pub leads: Vec<Trace>,
    /// Heights of each tooth at the points less their mean, where it is one of several.
    pub teeth_um: Vec<Vec<f64>>,
}

impl MeasuredProfile {
    /// Puts the points of a file on the flank of `gear`.
    ///
    /// # Errors
    /// A point that does not lie on the flank.
    pub fn on_flank(file: &MeasuredFile, pair: &GearPair, gear: Gear) -> Result<Self, DataTableError> {
        let flank = FlankArc::new(pair, gear);
        let FlankArc { first, last, .. } = flank;
        let margin = OUTSIDE * (last - first);
        let mut points = Vec::with_capacity(file.rows.len());
        for (index, row) in file.rows.iter().enumerate() {
            let at = flank.arc_mm(file, row.place);
            // Below the base circle there is no involute, and no arc length that tells.
            let base = flank.involute.base_radius_mm;
            let is_below = match file.place {
                PlaceColumn::RadiusMm => row.place < base,
                PlaceColumn::DiameterMm => row.place < 2.0 * base,
                PlaceColumn::RollAngleDeg | PlaceColumn::RollLengthMm => row.place < 0.0,
                PlaceColumn::ArcMm => false,
            };
            if is_below || at < first - margin || at > last + margin {
                let (a, b) = (flank.place(file, first), flank.place(file, last));
                let allowed = format!("{:.4} to {:.4}, the {}'s flank", a.min(b), a.max(b), gear.name());
                return Err(not_allowed(row.line, &file.place_name, row.place, allowed));
            }
            points.push((at.clamp(first, last), index));
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let of_points = |values: &dyn Fn(usize) -> f64| points.iter().map(|&(_, index)| values(index)).collect();
        Ok(Self {
            gear,
            arc_mm: points.iter().map(|&(arc, _)| arc).collect(),
            height_um: of_points(&|index| file.rows[index].height_um),
            kind: file.kind,
            height_from: file.height_from,
            leads: file.leads.clone(),
            teeth_um: file.teeth_um.iter().map(|own| of_points(&|index| own[index])).collect(),
        })
    }

    /// Lengths along the flank, and roll lengths.
    pub fn places_mm(&self, pair: &GearPair) -> [Vec<f64>; 2] {
        let involute = pair.teeth[self.gear].involute;
        let roll = self.arc_mm.iter().map(|&arc| involute.rho_at_arc_mm(arc)).collect();
        [self.arc_mm.clone(), roll]
    }

    /// Radius of each point.
    pub fn radius_mm(&self, pair: &GearPair) -> Vec<f64> {
        let involute = pair.teeth[self.gear].involute;
        self.arc_mm.iter().map(|&arc| involute.radius_mm(involute.rho_at_arc_mm(arc))).collect()
    }

    /// Scale of the heights: along the transverse line of action over normal to the flank, as wear depths are. Heights of a transverse section are
    /// 1/cos β_b times what they are normal to a helical flank (ISO 1328-1:2013, 3.4).
    pub fn over_normal(&self, pair: &GearPair) -> f64 {
        match self.kind {
            ValueKind::Height => pair.obliquity().transverse_mm(1.0),
            ValueKind::Wear => 1.0,
        }
    }

    /// z₀: height of the unworn flank at each point, moved by `shift_mm` towards the tip.
    pub fn unworn_um(&self, pair: &GearPair, shift_mm: f64) -> Vec<f64> {
        let tooth = &pair.teeth[self.gear];
        let involute = tooth.involute;
        let (tip, start) = (tooth.tip_rho_mm(), pair.active_start_rho_mm(self.gear));
        let middle = match (self.arc_mm.first(), self.arc_mm.last()) {
            (Some(first), Some(last)) => involute.rho_at_arc_mm(0.5 * (first + last)),
            _ => start,
        };
        if self.kind == ValueKind::Wear {
            return vec![0.0; self.arc_mm.len()];
        }
        let rhos = self.arc_mm.iter().map(|&arc| involute.rho_at_arc_mm(arc + shift_mm).min(tip));
        rhos.map(|rho| {
            let modified = whole_profile_mm(pair, self.gear, rho);
            UM_PER_MM
                * match self.height_from {
                    HeightFrom::Involute => -modified,
                    HeightFrom::Line => -modified - involute.in_tangent_frame(rho, middle).drop_mm,
                }
        })
        .collect()
    }
}

/// Arc lengths of a flank from the base circle, mm.
struct FlankArc {
    involute: Involute,
    /// At the root form circle.
    first: f64,
    /// At the start of active profile.
    active_start: f64,
    /// At the tip.
    last: f64,
}

impl FlankArc {
    fn new(pair: &GearPair, gear: Gear) -> Self {
        let tooth = &pair.teeth[gear];
        let involute = tooth.involute;
        let [first, active_start, last] =
            [tooth.root_form_rho_mm(), pair.active_start_rho_mm(gear), tooth.tip_rho_mm()]
                .map(|rho| involute.arc_mm(rho));
        Self { involute, first, active_start, last }
    }

    /// Arc length at a place in the unit of the file.
    fn arc_mm(&self, file: &MeasuredFile, place: f64) -> f64 {
        let involute = &self.involute;
        match (file.place, file.arc_from) {
            (PlaceColumn::RadiusMm, _) => involute.arc_mm(involute.curvature_radius_mm(place)),
            (PlaceColumn::DiameterMm, _) => involute.arc_mm(involute.curvature_radius_mm(0.5 * place)),
            (PlaceColumn::RollAngleDeg, _) => involute.arc_mm(place.to_radians() * involute.base_radius_mm),
            (PlaceColumn::RollLengthMm, _) => involute.arc_mm(place),
            (PlaceColumn::ArcMm, Some(ArcFrom::Tip)) => self.last - place,
            (PlaceColumn::ArcMm, Some(ArcFrom::ActiveStart)) => self.active_start + place,
            (PlaceColumn::ArcMm, _) => place,
        }
    }

    /// Place at an arc length, in the unit of the file.
    fn place(&self, file: &MeasuredFile, arc: f64) -> f64 {
        let involute = &self.involute;
        match (file.place, file.arc_from) {
            // Places are positive, of internal gears too.
            (PlaceColumn::RadiusMm, _) => involute.radius_mm(involute.rho_at_arc_mm(arc)).abs(),
            (PlaceColumn::DiameterMm, _) => 2.0 * involute.radius_mm(involute.rho_at_arc_mm(arc)).abs(),
            (PlaceColumn::RollAngleDeg, _) => involute.roll_angle_rad(involute.rho_at_arc_mm(arc)).to_degrees(),
            (PlaceColumn::RollLengthMm, _) => involute.rho_at_arc_mm(arc).abs(),
            (PlaceColumn::ArcMm, Some(ArcFrom::Tip)) => self.last - arc,
            (PlaceColumn::ArcMm, Some(ArcFrom::ActiveStart)) => arc - self.active_start,
            (PlaceColumn::ArcMm, _) => arc,
        }
    }
}
