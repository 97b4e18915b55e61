//! Nominal root stress by the standards, beside what finite elements find.

use crate::results::root_stress::{RootSectionSummary, RootStressSummary};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::root_stress::{LoadedAt, section};

/// Nominal root stress of both gears under this line load at the base circle.
pub(super) fn summary(pair: &GearPair, line_load_n_per_mm: f64) -> PerGear<RootStressSummary> {
    let tangential = line_load_n_per_mm * pair.spec.transverse_pressure_angle_rad().cos();
    let of = |gear: Gear, at: LoadedAt| {
        let section = section(pair, gear, at)?;
        Some(RootSectionSummary {
            nominal_stress_MPa: tangential * section.stress_per_load_per_mm,
            form_factor: section.form_factor,
            stress_correction_factor: section.stress_correction_factor,
            moment_arm_mm: section.moment_arm_mm,
            thickness_mm: section.thickness_mm,
            fillet_radius_mm: section.fillet_radius_mm,
            load_angle_deg: section.load_angle_rad.to_degrees(),
        })
    };
    PerGear::from_fn(|gear| RootStressSummary {
        iso_6336_3: of(gear, LoadedAt::SinglePairContact),
        vdi_2736: of(gear, LoadedAt::Tip),
    })
}
