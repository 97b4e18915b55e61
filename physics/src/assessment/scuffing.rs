//! Scuffing temperatures of the pair as the standards have them, and the safeties: from geometry and load factors, without the contact of the
//! run.

use crate::lubrication::friction::lubricant_factor;
use crate::lubrication::loss;
use crate::lubrication::running_pair::{OilInMesh, RunningPair};
use crate::lubrication::scuffing::{
    ScuffingConditions, approach_factor, contact_ratio_factor, flash_approach_factor, integral_scuffing_temperature_c,
    run_in_factor, scuffing_temperature_c, tip_relief_factor,
};
use crate::results::lubrication::{FlashPoint, ScuffingSummary};
use crate::stiffness::iso6336::{mesh_over_single, single_stiffness_n_per_mm2};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::material::Material;

/// Reason why figures with the standards' load sharing factor are missing.
pub(super) const NO_SHARING_FACTOR: &str =
    "the standards have a load sharing factor for transverse contact ratios below 2 alone";
/// Reason why figures of internal pairs are missing.
const INTERNAL: &str = "the geometry factors here are those of external pairs";
/// Places along the path at which the flash temperature is averaged.
const PLACES: usize = 400;
/// Part of the mean flash temperature by which teeth are warmer than the oil, ISO/TS 6336-20.
const MEAN_FLASH_TO_BULK: f64 = 0.47;
/// Part of the integral flash temperature by which teeth are warmer than the oil, ISO/TS 6336-21.
const INTEGRAL_FLASH_TO_BULK: f64 = 0.7;
/// C₂ of the integral temperature.
const INTEGRAL_WEIGHT: f64 = 1.5;
/// Contact ratio up to which ISO/TS 6336-21 has a factor X_ε.
const GREATEST_CONTACT_RATIO: f64 = 3.0;

/// The pair with its oil, and what both temperatures share.
struct Scuffing<'a> {
    running: &'a RunningPair<'a>,
    oil: &'a OilInMesh,
    conditions: ScuffingConditions,
    /// Amount of tip relief of each gear, µm.
    relief_um: PerGear<f64>,
    /// C_eff, µm.
    effective_um: f64,
}

/// Flash temperatures by ISO/TS 6336-20, for contact ratios below 2.
struct Flash {
    friction: f64,
    mean_k: f64,
    greatest_k: f64,
    bulk_c: f64,
    points: Vec<FlashPoint>,
}

/// Integral temperature by ISO/TS 6336-21.
struct Integral {
    friction: f64,
    flash_k: f64,
    bulk_c: f64,
    run_in_factor: f64,
}

pub(super) fn summary(running: &RunningPair<'_>, oil: &OilInMesh, material: &PerGear<Material>) -> ScuffingSummary {
    let of = Scuffing::new(running, oil, material);
    let (flash, integral) = (of.flash(), of.integral());
    let settings = &oil.settings;
    let asked = settings.scuffing;
    let limit_c = asked.fzg_load_stage.map(|stage| {
        let own = oil.mean.viscosity_milli_pa_s.powf(-0.05) * oil.mean.lubricant_factor;
        scuffing_temperature_c(stage, asked.structural_factor, own)
    });
    let integral_limit_c = asked.fzg_load_stage.map(|stage| {
        let base = settings.lubricant_factor.unwrap_or_else(|| lubricant_factor(oil.oil.base()));
        integral_scuffing_temperature_c(stage, asked.structural_factor, base, settings.oil.viscosity_40c_mm2_per_s)
    });
    let contact_c = flash.as_ref().map(|flash| flash.bulk_c + flash.greatest_k);
    let integral_c = integral.as_ref().map(|own| own.bulk_c + INTEGRAL_WEIGHT * own.flash_k);
    let over_oil = |celsius: f64| celsius - settings.temperature_c;
    let has_flash = flash.is_some();
    let missing = |external: &str| (if running.pair.spec.is_internal() { INTERNAL } else { external }).to_owned();
    ScuffingSummary {
        flash_friction: flash.as_ref().map(|flash| flash.friction),
        mean_flash_K: flash.as_ref().map(|flash| flash.mean_k),
        greatest_flash_K: flash.as_ref().map(|flash| flash.greatest_k),
        flash_bulk_temperature_C: flash.as_ref().map(|flash| flash.bulk_c),
        contact_temperature_C: contact_c,
        scuffing_temperature_C: limit_c,
        scuffing_safety: limit_c.zip(contact_c).map(|(limit, contact)| over_oil(limit) / over_oil(contact)),
        flash_points: flash.map_or_else(Vec::new, |flash| flash.points),
        flash_null_because: (!has_flash).then(|| missing(NO_SHARING_FACTOR)),
        run_in_factor: integral.as_ref().map(|own| own.run_in_factor),
        integral_friction: integral.as_ref().map(|own| own.friction),
        integral_flash_K: integral.as_ref().map(|own| own.flash_k),
        integral_bulk_temperature_C: integral.as_ref().map(|own| own.bulk_c),
        integral_temperature_C: integral_c,
        integral_scuffing_temperature_C: integral_limit_c,
        integral_scuffing_safety: integral_limit_c.zip(integral_c).map(|(limit, found)| limit / found),
        integral_null_because: integral_c
            .is_none()
            .then(|| missing("ISO/TS 6336-21 has no contact ratio factor from a transverse contact ratio of 3 on")),
        safeties_null_because: limit_c.is_none().then(|| "lubricant.fzg_scuffing_load_stage is not given".to_owned()),
    }
}

impl<'a> Scuffing<'a> {
    fn new(running: &'a RunningPair<'a>, oil: &'a OilInMesh, material: &PerGear<Material>) -> Self {
        let pair = running.pair;
        let spec = &pair.spec;
        let factors = &running.settings.load_factors;
        let transverse_angle_rad = spec.transverse_pressure_angle_rad();
        let tangential = running.line_load_n_per_mm * transverse_angle_rad.cos();
        // sin α_wn = sin α_wt cos β_b.
        let working_normal = pair.working_pressure_angle_rad.sin() * pair.base_helix_angle_rad().cos();
        let conditions = ScuffingConditions {
            reduced_modulus_mpa: running.bodies.reduced_modulus_mpa,
            thermal_contact_w_s05_per_m2_k: 0.5 * oil.settings.thermal_contact_w_s05_per_m2_k.sum(),
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
        let relief_um = PerGear::from_fn(|gear| {
            spec.gears[gear].modification.tip_relief.map_or(0.0, |relief| 1e3 * relief.amount_mm)
        });
        let [after, before] = loss::contact_ratios(pair);
        let over_single = if spec.helix_angle_rad == 0.0 { 1.0 } else { mesh_over_single(after + before) };
        let stiffness = over_single * single_stiffness_n_per_mm2(spec, material, running.line_load_n_per_mm);
        let effective_um = 1e3 * factors.application * tangential / stiffness;
        Self { running, oil, conditions, relief_um, effective_um }
    }

    /// θ_M of either standard, °C.
    fn bulk_c(&self, rise_k: f64) -> f64 {
        let settings = &self.oil.settings;
        settings.bulk_temperature_c.unwrap_or(settings.temperature_c + settings.supply.factor() * rise_k)
    }

    fn flash(&self) -> Option<Flash> {
        let path = &self.running.pair.path;
        let sharing = &self.running.sharing;
        if !sharing.is_of_standard() || self.running.pair.spec.is_internal() {
            return None;
        }
        let friction = self.oil.mean.iso_6336_20();
        let gamma = |position_mm: f64| position_mm / path.pitch_point_mm - 1.0;
        let ends = [gamma(path.start_mm), gamma(path.end_mm)];
        let deflection_um = self.effective_um - self.relief_um.wheel;
        let flash = |position_mm: f64| {
            let at = gamma(position_mm);
            flash_approach_factor(deflection_um, at, ends)
                * self.conditions.flash_k(at, sharing.factor(position_mm), friction)
        };
        let rises: Vec<f64> = path.evenly_mm(PLACES + 1).into_iter().map(flash).collect();
        let mean_k = (rises.iter().sum::<f64>() - 0.5 * (rises[0] + rises[PLACES])) / PLACES as f64;
        let points = ["A", "B", "C", "D", "E"].into_iter().zip(path.points_mm());
        Some(Flash {
            friction,
            mean_k,
            greatest_k: rises.iter().copied().fold(0.0, f64::max),
            bulk_c: self.bulk_c(MEAN_FLASH_TO_BULK * mean_k),
            points: points
                .map(|(name, at)| FlashPoint { name: name.to_owned(), position_mm: at, flash_K: flash(at) })
                .collect(),
        })
    }

    fn integral(&self) -> Option<Integral> {
        let (pair, mean) = (self.running.pair, &self.oil.mean);
        let [after, before] = loss::contact_ratios(pair);
        if after + before >= GREATEST_CONTACT_RATIO || pair.spec.is_internal() {
            return None;
        }
        let friction = mean.iso_6336_21();
        let run_in_factor = run_in_factor(mean.relative_run_in, mean.ra_um, mean.relative_radius_mm);
        let relief_um = self.relief_um.pinion.min(self.relief_um.wheel);
        let relief = tip_relief_factor(relief_um / self.effective_um, after.max(before));
        let radii = Gear::BOTH.map(|gear| pair.path.rho_mm(gear, pair.path.end_mm));
        let at_tip =
            self.conditions.flash_at_tip_k(radii, friction) * run_in_factor / (approach_factor(before, after) * relief);
        let flash_k = at_tip * contact_ratio_factor(after, before);
        Some(Integral { friction, flash_k, bulk_c: self.bulk_c(INTEGRAL_FLASH_TO_BULK * flash_k), run_in_factor })
    }
}
