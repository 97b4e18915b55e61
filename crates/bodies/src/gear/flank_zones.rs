//! Zones of a flank, for figures of wear and pressure, in these terms:
//!
//! ```text
//! below the active profile    base circle … SAP: strips of contact reach it, and the mate's tip edge before A or after E
//! active profile              SAP … tip-edge zone
//! tip-edge zone               from  l = min(3 a_C, 0.15 m)  below the tip edge, or below where its rounding begins, to the tip circle
//! root zone                   first 2 mm of radius above the SAP
//! tip zone                    last 2 mm of radius below the tip circle
//! ```
//!
//! l is measured along the flank; a_C is Hertz's half-width at the pitch point under the whole load, m the normal module. Contact that
//! reaches the tip edge is cut off there, and its pressure and wear depend on the edge: on its rounding, and its resolution.
//! Three half-widths from it the active profile is free of that, and has figures of its own.

use serde::{Deserialize, Serialize};

use super::{Gear, GearPair, PerGear};

/// Height of the root zone in radius, from the start of active profile (SAP) upward, mm.
const ROOT_MM: f64 = 2.0;
/// Height of the tip zone in radius, from the tip circle downward, mm.
const TIP_MM: f64 = 2.0;
/// Length of the tip-edge zone below the edge or its rounding, in Hertz half-widths at the pitch point.
const TIP_EDGE_HALF_WIDTHS: f64 = 3.0;
/// Greatest length of the tip-edge zone, in normal modules.
const MOST_TIP_EDGE_MODULES: f64 = 0.15;
/// Length over which a flank's pressure is averaged: in Hertz half-widths at the pitch point, and at most, mm.
const PRESSURE_LENGTH: (f64, f64) = (0.4, 0.04);

/// Zone of a flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankZone {
    /// Below the active profile.
    BelowActive,
    /// Active profile.
    Active,
    /// Tip-edge zone.
    TipEdge,
}

/// Radii of the zones of one flank.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FlankZones {
    /// Start of active profile (SAP).
    pub active_start_radius_mm: f64,
    /// Beginning of the tip-edge zone.
    pub tip_edge_radius_mm: f64,
    /// Beginning of the tip edge or its rounding.
    pub tip_end_radius_mm: f64,
    /// Tip circle.
    pub tip_radius_mm: f64,
    /// Length over which the pressure of the flank is averaged: 0.04 mm, at most 0.4 of Hertz's half-width at the pitch point.
    pub pressure_length_mm: f64,
}

impl FlankZones {
    /// Zones of `gear`'s flank with Hertz's half-width `half_width_mm` at the pitch point under the whole load, or the greatest of several.
    pub fn new(pair: &GearPair, gear: Gear, half_width_mm: f64) -> Self {
        let (tooth, spec) = (&pair.teeth[gear], &pair.spec);
        let rounding_mm = tooth.tip_rounding_length_mm(spec.gears[gear].modification.tip_rounding_mm);
        let length_mm = (TIP_EDGE_HALF_WIDTHS * half_width_mm).min(MOST_TIP_EDGE_MODULES * spec.normal_module_mm);
        let start = pair.active_start_rho_mm(gear);
        // On a short flank the tip-edge zone begins at the start of active profile.
        let [tip_edge_radius_mm, tip_end_radius_mm] = [rounding_mm + length_mm, rounding_mm].map(|length_mm| {
            let arc_mm = tooth.involute.arc_mm(tooth.edge_rho_mm()) - length_mm;
            tooth.involute.radius_mm(tooth.involute.rho_at_arc_mm(arc_mm).max(start))
        });
        let (of_half_widths, most_mm) = PRESSURE_LENGTH;
        Self {
            active_start_radius_mm: pair.active_start_radius_mm(gear),
            tip_edge_radius_mm,
            tip_end_radius_mm,
            tip_radius_mm: tooth.tip_radius_mm,
            pressure_length_mm: (of_half_widths * half_width_mm).min(most_mm),
        }
    }

    /// Zones of both flanks.
    pub fn of_pair(pair: &GearPair, half_width_mm: f64) -> PerGear<Self> {
        PerGear::from_fn(|gear| Self::new(pair, gear, half_width_mm))
    }

    /// Zone at a radius.
    pub fn at(&self, radius_mm: f64) -> FlankZone {
        if radius_mm < self.active_start_radius_mm {
            FlankZone::BelowActive
        } else if radius_mm < self.tip_edge_radius_mm {
            FlankZone::Active
        } else {
            FlankZone::TipEdge
        }
    }

    /// Whether a radius is in the root zone.
    pub fn is_root(&self, radius_mm: f64) -> bool {
        (self.active_start_radius_mm..=self.active_start_radius_mm + ROOT_MM).contains(&radius_mm)
    }

    /// Whether a radius is in the tip zone.
    pub fn is_tip(&self, radius_mm: f64) -> bool {
        radius_mm >= self.tip_radius_mm - TIP_MM
    }
}
