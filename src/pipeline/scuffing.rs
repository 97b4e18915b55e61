//! Scuffing temperatures of the pair as the standards have them: from geometry and load factors, without the contact of the run.

use crate::contact::settings::Material;
use crate::gear::{Gear, PerGear};
use crate::lubrication::loss;
use crate::lubrication::running_pair::{OilInMesh, RunningPair};
use crate::lubrication::scuffing::{ScuffingConditions, approach_factor, contact_ratio_factor, tip_relief_factor};
use crate::results::lubrication::ScuffingSummary;
use crate::stiffness::iso6336::single_stiffness_n_per_mm2;

/// Places along the path at which the flash temperature is averaged.
const PLACES: usize = 400;
/// Part of the mean flash temperature by which teeth are warmer than the oil, ISO/TS 6336-20.
const MEAN_FLASH_TO_BULK: f64 = 0.47;
/// The same of the integral flash temperature, ISO/TS 6336-21.
const INTEGRAL_FLASH_TO_BULK: f64 = 0.7;
/// C₂ of the integral temperature.
const INTEGRAL_WEIGHT: f64 = 1.5;

pub(super) fn summary(running: &RunningPair<'_>, oil: &OilInMesh, material: &PerGear<Material>) -> ScuffingSummary {
    let (pair, path) = (running.pair, &running.pair.path);
    let spec = &pair.spec;
    let factors = &running.settings.load_factors;
    let thermal = oil.settings.thermal_contact_w_s05_per_m2_k;
    let transverse_angle_rad = spec.transverse_pressure_angle_rad();
    let tangential = running.line_load_n_per_mm * transverse_angle_rad.cos();
    // sin α_wn = sin α_wt cos β_b.
    let working_normal = pair.working_pressure_angle_rad.sin() * pair.base_helix_angle_rad().cos();
    let conditions = ScuffingConditions {
        reduced_modulus_mpa: running.bodies.reduced_modulus_mpa,
        thermal_contact_w_s05_per_m2_k: 0.5 * thermal.sum(),
        working_transverse_angle_rad: pair.working_pressure_angle_rad,
        working_normal_angle_rad: working_normal.asin(),
        transverse_angle_rad,
        tangential_load_n_per_mm: factors.product() * tangential,
        helical_load_factor: oil.mean.helical_factor,
        circumferential_speed_m_per_s: 1e-3
            * running.angular_speed_per_s.pinion
            * spec.reference_radius_mm(Gear::Pinion),
        centre_distance_mm: spec.centre_distance_mm,
        gear_ratio: 1.0 / pair.wheel_turns_per_pinion_turn(),
    };
    let flash_friction = oil.mean.iso_6336_20();
    let flash = |position_mm: f64| {
        let gamma = position_mm / path.pitch_point_mm - 1.0;
        conditions.flash_k(gamma, running.sharing.factor(position_mm), flash_friction)
    };
    let rises: Vec<f64> = path.evenly_mm(PLACES + 1).into_iter().map(flash).collect();
    let greatest_flash_k = rises.iter().copied().fold(0.0, f64::max);
    let ends = 0.5 * (rises[0] + rises[PLACES]);
    let mean_flash_k = (rises.iter().sum::<f64>() - ends) / PLACES as f64;
    let (oil_c, supply) = (oil.settings.temperature_c, oil.settings.supply.factor());

    let [after, before] = loss::contact_ratios(pair);
    let integral_friction = oil.mean.iso_6336_21();
    let relief_um = Gear::BOTH
        .map(|gear| spec.gears[gear].modification.tip_relief.map_or(0.0, |relief| 1e3 * relief.amount_mm))
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let single = single_stiffness_n_per_mm2(spec, material, running.line_load_n_per_mm);
    let mesh_stiffness = single * (0.75 * (after + before) + 0.25);
    let effective_um =
        1e3 * factors.application * running.line_load_n_per_mm * transverse_angle_rad.cos() / mesh_stiffness;
    let relief = tip_relief_factor(relief_um / effective_um, after.max(before));
    let radii = Gear::BOTH.map(|gear| path.rho_mm(gear, path.end_mm));
    let at_tip = conditions.flash_at_tip_k(radii, relief * approach_factor(before, after), integral_friction);
    let integral_flash_k = at_tip * contact_ratio_factor(after, before);
    let bulk = |rise: f64| oil.settings.bulk_temperature_c.unwrap_or(oil_c + supply * rise);
    ScuffingSummary {
        flash_friction,
        mean_flash_K: mean_flash_k,
        greatest_flash_K: greatest_flash_k,
        contact_temperature_C: bulk(MEAN_FLASH_TO_BULK * mean_flash_k) + greatest_flash_k,
        integral_friction,
        integral_flash_K: integral_flash_k,
        integral_temperature_C: bulk(INTEGRAL_FLASH_TO_BULK * integral_flash_k) + INTEGRAL_WEIGHT * integral_flash_k,
    }
}
