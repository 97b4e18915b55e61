//! Geometry of a pair from its data.
//!
//! The working transverse pressure angle follows from the centre distance, cos α_wt = (r_b1 + r_b2) / a; the pitch on the working circles less
//! both tooth thicknesses is the backlash.
//!
//! With an internal wheel, centre distance, T1T2 and the wheel's radii are negative, and the same equations hold.
//!
//! Source: ISO 21771, section 5.

use std::f64::consts::PI;

use super::modification::{Kink, Modification, Relief, ReliefShape};
use super::{
    Gear, PairError, PerGear, backlash::Backlash, internal_error::InternalError, path_of_contact::PathOfContact,
    spec::PairSpec, tooth::Tooth,
};

/// Negative backlash that rounded profile shifts and centre distances may have, in normal modules (4.5 µm for module 4.5).
const BACKLASH_ROUNDING_MODULES: f64 = 1e-3;

/// Overlap of tip and fillet that rounded data may have, in normal modules.
const OVERLAP_ROUNDING_MODULES: f64 = 1e-4;

/// Name of the deviation of a measured flank in errors.
pub const MEASURED_FLANK: &str = "measured flank";
/// Greatest amount of a modification, in modules.
const GREATEST_REMOVAL_MODULES: f64 = 0.25;

/// Gear pair with its derived geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct GearPair {
    /// Given data, without tip roundings and chamfers that count as sharp.
    pub spec: PairSpec,
    /// Circles and teeth.
    pub teeth: PerGear<Tooth>,
    /// Working transverse pressure angle α_wt, rad.
    pub working_pressure_angle_rad: f64,
    /// Path of contact.
    pub path: PathOfContact,
    /// Transverse circumferential backlash on the working circles, mm; zero where rounded data make it slightly negative.
    pub backlash_mm: f64,
    /// Distance of each gear's tip circle from its mate's root circle, mm.
    pub tip_clearance_mm: PerGear<f64>,
}

/// Refuses a wheel no larger than its pinion, and a centre distance at which the base circle of the pinion lies inside that of the internal wheel
/// (`base_radii_mm`: sum of the base radii).
fn check_sizes(spec: &PairSpec, base_radii_mm: f64) -> Result<(), InternalError> {
    let PerGear { pinion, wheel } = spec.gears.as_ref().map(|gear| gear.teeth);
    if wheel <= pinion {
        return Err(InternalError::Teeth { pinion, wheel });
    }
    let [centre_distance_mm, least_mm] = [spec.centre_distance_mm, base_radii_mm].map(f64::abs);
    if centre_distance_mm <= least_mm {
        return Err(InternalError::NoMesh { centre_distance_mm, least_mm });
    }
    Ok(())
}

impl GearPair {
    /// Transverse line load w = T₁/(r_b1 b) under a torque on the pinion, N/mm.
    pub fn line_load_n_per_mm(&self, pinion_torque_n_mm: f64) -> f64 {
        pinion_torque_n_mm / self.path.involute.pinion.base_radius_mm / self.spec.face_width_mm
    }

    /// Derives the geometry of a pair.
    ///
    /// # Errors
    /// [`PairError`] where the geometry is impossible.
    pub fn new(spec: &PairSpec) -> Result<Self, PairError> {
        let centre_distance_mm = spec.centre_distance_mm;
        let base_radii = PerGear::from_fn(|g| spec.reference_radius_mm(g) * spec.transverse_pressure_angle_rad().cos());
        let least_mm = base_radii.pinion + base_radii.wheel;
        if spec.is_internal() {
            check_sizes(spec, least_mm)?;
        } else if centre_distance_mm <= least_mm {
            return Err(PairError::NoMesh { centre_distance_mm, least_mm });
        }
        let teeth = PerGear {
            pinion: Tooth::new(spec, Gear::Pinion, spec.tip_radius_mm(Gear::Pinion))?,
            wheel: Tooth::new(spec, Gear::Wheel, spec.tip_radius_mm(Gear::Wheel))?,
        };
        let working_pressure_angle_rad = (least_mm / centre_distance_mm).acos();
        let line_of_action_mm =
            ((centre_distance_mm - least_mm) * (centre_distance_mm + least_mm)).sqrt().copysign(centre_distance_mm);
        let path = PathOfContact {
            line_of_action_mm,
            base_pitch_mm: 2.0 * PI * base_radii.pinion / f64::from(spec.gears.pinion.teeth),
            start_mm: (line_of_action_mm - teeth.wheel.edge_rho_mm()).max(teeth.pinion.root_form_rho_mm()),
            pitch_point_mm: base_radii.pinion * working_pressure_angle_rad.tan(),
            end_mm: teeth.pinion.edge_rho_mm().min(line_of_action_mm - teeth.wheel.root_form_rho_mm()),
            involute: teeth.as_ref().map(|tooth| tooth.involute),
        };
        let tip_clearance_mm =
            PerGear::from_fn(|g| centre_distance_mm - teeth[g].tip_radius_mm - teeth[g.mate()].root_radius_mm);
        let mut spec = spec.clone();
        for gear in Gear::BOTH {
            spec.gears[gear].modification.tip_rounding_mm = spec.tip_rounding_mm(gear);
            spec.gears[gear].tip_chamfer = spec.tip_chamfer(gear);
        }
        let mut pair = Self { spec, teeth, working_pressure_angle_rad, path, backlash_mm: 0.0, tip_clearance_mm };
        pair.backlash_mm = pair.checked_backlash_mm()?;
        pair.check_contact()?;
        pair.check_modifications()?;
        Ok(pair)
    }

    /// Radius of the working pitch circle.
    pub fn working_pitch_radius_mm(&self, gear: Gear) -> f64 {
        self.path.involute[gear].base_radius_mm / self.working_pressure_angle_rad.cos()
    }

    /// Helix slope of the working flanks over the face width due to axes that are not parallel, mm.
    pub fn slope_of_axes_mm(&self) -> f64 {
        let axes = self.spec.axis_parallelism;
        let (sin, cos) = self.working_pressure_angle_rad.sin_cos();
        axes.in_plane_mm * sin + axes.out_of_plane_mm * cos
    }

    /// Radius of the contact point on a gear's flank at `position_mm` of the path of contact.
    pub fn radius_at_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.path.involute[gear].radius_mm(self.path.rho_mm(gear, position_mm))
    }

    /// Radius of curvature of a gear's flank at the start of its active profile (SAP).
    pub fn active_start_rho_mm(&self, gear: Gear) -> f64 {
        match gear {
            Gear::Pinion => self.path.start_mm,
            Gear::Wheel => self.path.line_of_action_mm - self.path.end_mm,
        }
    }

    /// Radii of curvature where the reliefs of a gear's flank begin; without reliefs of zero amount.
    pub fn begins_of_reliefs(&self, gear: Gear) -> impl Iterator<Item = (f64, Relief)> + use<> {
        let Modification { tip_relief, root_relief, .. } = self.spec.gears[gear].modification;
        let (edge_rho_mm, start_rho_mm) = (self.teeth[gear].edge_rho_mm(), self.active_start_rho_mm(gear));
        let of_tip = tip_relief.map(|relief| (edge_rho_mm - relief.length_mm, relief));
        let of_root = root_relief.map(|relief| (start_rho_mm + relief.length_mm, relief));
        of_tip.into_iter().chain(of_root).filter(|(_, relief)| relief.amount_mm > 0.0)
    }

    /// Kinks of a gear's flank, where its linear reliefs begin.
    pub fn kinks(&self, gear: Gear) -> impl Iterator<Item = Kink> + use<> {
        let base_radius_mm = self.path.involute[gear].base_radius_mm;
        let linear = self.begins_of_reliefs(gear).filter(|(_, relief)| relief.shape == ReliefShape::Linear);
        linear.map(move |(rho_mm, relief)| Kink {
            rho_mm,
            // Along the flank, s grows by ρ/r_b of the roll length.
            angle_rad: relief.amount_mm / relief.length_mm * (base_radius_mm / rho_mm).abs(),
        })
    }

    /// Radius r_Nf of the start of active profile (SAP): that of the contact with the mate's tip, or the form circle where it is larger.
    pub fn active_start_radius_mm(&self, gear: Gear) -> f64 {
        self.path.involute[gear].radius_mm(self.active_start_rho_mm(gear))
    }

    /// Overlap ratio ε_β = b |sin β| / (π m_n).
    pub fn overlap_ratio(&self) -> f64 {
        self.spec.overlap_ratio()
    }

    /// Base helix angle β_b: tan β_b = tan β cos α_t.
    pub fn base_helix_angle_rad(&self) -> f64 {
        (self.spec.helix_angle_rad.tan() * self.spec.transverse_pressure_angle_rad().cos()).atan()
    }

    /// Normal tooth thickness s_an at the tip cylinder after wear of `lost_mm` of one flank there along its transverse normal:
    /// (s_a − h/cos α_a) cos β_a, with tan β_a = tan β r_a/r; without reliefs, roundings and chamfers. Source: ISO 21771, sections 4 and 5.
    pub fn normal_tip_thickness_mm(&self, gear: Gear, lost_mm: f64) -> f64 {
        let tooth = &self.teeth[gear];
        let tip_radius = tooth.tip_radius_mm;
        let cos_alpha = tooth.involute.base_radius_mm / tip_radius;
        let helix_angle = (self.spec.helix_angle_rad.tan() * tip_radius / tooth.reference_radius_mm).atan();
        (tooth.thickness_mm(tip_radius) - lost_mm / cos_alpha) * helix_angle.cos()
    }

    /// Turns of the wheel per turn of the pinion, z_driving / z_driven.
    pub fn wheel_turns_per_pinion_turn(&self) -> f64 {
        f64::from(self.spec.gears.pinion.teeth) / f64::from(self.spec.gears.wheel.teeth)
    }

    fn checked_backlash_mm(&self) -> Result<f64, PairError> {
        let [pinion_mm, wheel_mm] =
            Gear::BOTH.map(|gear| self.teeth[gear].thickness_mm(self.working_pitch_radius_mm(gear)));
        let pitch_mm = self.path.base_pitch_mm / self.working_pressure_angle_rad.cos();
        let backlash_mm = pitch_mm - pinion_mm - wheel_mm;
        if backlash_mm < -BACKLASH_ROUNDING_MODULES * self.spec.normal_module_mm {
            let centre_distance_mm = self.spec.centre_distance_mm;
            let tight = self.spec.centre_distance_with_mm(Backlash::Normal(0.0));
            let least_mm = tight.unwrap_or(centre_distance_mm);
            if self.spec.is_internal() {
                let [centre_distance_mm, greatest_mm] = [centre_distance_mm, least_mm].map(f64::abs);
                return Err(InternalError::NegativeBacklash { backlash_mm, centre_distance_mm, greatest_mm }.into());
            }
            return Err(PairError::NegativeBacklash { backlash_mm, centre_distance_mm, least_mm });
        }
        Ok(backlash_mm.max(0.0))
    }

    fn check_contact(&self) -> Result<(), PairError> {
        let (contact_ratio, overlap_ratio) = (self.path.contact_ratio(), self.overlap_ratio());
        if contact_ratio <= 0.0 || contact_ratio + overlap_ratio < 1.0 {
            return Err(PairError::ContactRatioBelowOne { contact_ratio: contact_ratio.max(0.0), overlap_ratio });
        }
        for gear in Gear::BOTH {
            let clearance_mm = self.tip_clearance_mm[gear];
            if clearance_mm < 0.0 {
                return Err(PairError::NoTipClearance { gear, clearance_mm });
            }
        }
        if self.spec.is_internal() {
            self.check_tips()?;
        }
        for gear in Gear::BOTH {
            let least_mm = -OVERLAP_ROUNDING_MODULES * self.spec.normal_module_mm;
            let gap_mm = self.fillet_gap_mm(gear, self.teeth[gear.mate()].tip_radius_mm);
            if gap_mm < least_mm {
                if let Some(of) = self.involute_interference().filter(|_| gear == Gear::Pinion) {
                    return Err(InternalError::InvoluteInterference { of, overlap_mm: -gap_mm }.into());
                }
                return Err(PairError::Interference {
                    gear,
                    overlap_mm: -gap_mm,
                    greatest_tip_diameter_mm: 2.0 * self.greatest_mate_tip_radius_mm(gear, least_mm),
                });
            }
        }
        Ok(())
    }

    fn check_modifications(&self) -> Result<(), PairError> {
        let available_mm = self.path.end_mm - self.path.start_mm;
        let greatest_mm = GREATEST_REMOVAL_MODULES * self.spec.normal_module_mm;
        let slope_mm = self.slope_of_axes_mm();
        if slope_mm.abs() > greatest_mm {
            return Err(PairError::AxesTooFarFromParallel { slope_mm, greatest_mm });
        }
        for gear in Gear::BOTH {
            let modification = &self.spec.gears[gear].modification;
            let reliefs = [("tip relief", modification.tip_relief), ("root relief", modification.root_relief)];
            let amounts = reliefs.map(|(name, relief)| (name, relief.map_or(0.0, |relief| relief.amount_mm)));
            for (name, relief) in reliefs {
                match relief {
                    Some(relief) if relief.length_mm > available_mm => {
                        let length_mm = relief.length_mm;
                        return Err(PairError::ModificationTooLong {
                            gear,
                            modification: name,
                            length_mm,
                            available_mm,
                        });
                    }
                    _ => {}
                }
            }
            let over_width = [
                ("lead crowning", modification.lead_crowning_mm),
                ("end relief", modification.end_relief.map_or(0.0, |relief| relief.amount_mm)),
                ("helix slope deviation", modification.helix_slope_mm.abs()),
            ];
            let measured_mm = self.spec.gears[gear].measured_flank.as_ref().map_or(0.0, |flank| flank.greatest_mm());
            let of_profile = [
                ("profile crowning", modification.profile_crowning_mm),
                ("profile slope deviation", modification.profile_slope_mm.abs()),
                (MEASURED_FLANK, measured_mm),
            ];
            for (name, amount_mm) in amounts.into_iter().chain(of_profile).chain(over_width) {
                if amount_mm > greatest_mm {
                    return Err(PairError::ModificationTooDeep { gear, modification: name, amount_mm, greatest_mm });
                }
            }
            let half_width_mm = 0.5 * self.spec.face_width_mm;
            if let Some(end) = modification.end_relief
                && end.length_mm > half_width_mm
            {
                return Err(PairError::ModificationTooLong {
                    gear,
                    modification: "end relief",
                    length_mm: end.length_mm,
                    available_mm: half_width_mm,
                });
            }
            self.check_tip_rounding(gear, modification.tip_rounding_mm)?;
        }
        Ok(())
    }

    /// Refuses a rounding that leaves no active flank, or no room on its chamfer or, beside that of the other flank, on the tip land.
    fn check_tip_rounding(&self, gear: Gear, radius_mm: f64) -> Result<(), PairError> {
        let tooth = &self.teeth[gear];
        let [edge_mm, start_mm] =
            [tooth.edge_rho_mm(), self.active_start_rho_mm(gear)].map(|rho_mm| tooth.involute.arc_mm(rho_mm));
        let beyond_edge_mm = tooth.chamfer_length_mm().unwrap_or_else(|| 0.5 * tooth.thickness_mm(tooth.tip_radius_mm));
        let room_mm = (edge_mm - start_mm).min(beyond_edge_mm);
        let greatest_mm = room_mm / tooth.tip_rounding_length_mm(1.0);
        if radius_mm <= greatest_mm {
            Ok(())
        } else {
            Err(PairError::TipRoundingTooLarge { gear, radius_mm, greatest_mm })
        }
    }
}
