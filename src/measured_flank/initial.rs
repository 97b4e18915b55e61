//! The measured flank with which a run begins.
//!
//! Heights of a profile are those of the whole flank, modifications included; the material missing is
//!
//! ```text
//! e(ρ) = max z̄ − z̄(ρ) − rounding(ρ)
//! ```
//!
//! with the maximum between start of active profile and tip form circle, since turning the gear by a constant changes nothing, and without the rounding of
//! the tip edge, which the scene gives. Depths of wear are taken as they are, beside the modifications of the scene. Heights are along the
//! transverse line of action (ISO 1328-1:2013, 3.4), depths of wear normal to the flank.
//!
//! z̄ is the profile after a Gaussian filter, at each point the value there of the line that fits its neighbours best, weighted with
//!
//! ```text
//! w(u) = exp(−π (u/(α λ))²),   α = √(ln 2/π)
//! ```
//!
//! over the roll length u, so that lines stay lines up to their ends. The cutoff λ is by default L/30, at least 0.05 mm, with the roll length L from
//! start of active profile to tip, as profiles are filtered for ISO 1328-1.
//!
//! Source: ISO 1328-1:2013 (cutoff); ISO 16610-31 (Gaussian regression filter).

use std::f64::consts::{LN_2, PI};

use gearwear_bodies::gear::measured_flank::MeasuredFlank;
use gearwear_bodies::gear::{Gear, GearPair, removed_material};
use gearwear_files::data_table::{DataTableError, missing, not_allowed};
use gearwear_files::text::decode;

use super::file::{self, HeightFrom, MeasuredFile, ValueKind};
use super::profile::MeasuredProfile;
use super::teeth::TraceChoice;

const MM_PER_UM: f64 = 1e-3;
/// Cutoffs in the roll length that is evaluated.
const CUTOFFS: f64 = 30.0;
/// Least default cutoff, mm.
const LEAST_CUTOFF_MM: f64 = 0.05;
/// Reach of the filter in cutoffs: beyond it, weights are below 1e-6.
const REACH: f64 = 1.0;
/// Part of the roll length of the active profile by which a profile may end before its ends.
const UNCOVERED: f64 = 0.02;

/// A measured flank on its gear.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialFlank {
    /// Material missing.
    pub flank: MeasuredFlank,
    /// Kind of the heights of the file.
    pub kind: ValueKind,
    /// Ends of the profile, roll lengths in mm.
    pub from_to_mm: [f64; 2],
}

/// Default cutoff λ on a gear's flank, mm.
pub fn default_cutoff_mm(pair: &GearPair, gear: Gear) -> f64 {
    ((pair.teeth[gear].edge_rho_mm() - pair.active_start_rho_mm(gear)) / CUTOFFS).max(LEAST_CUTOFF_MM)
}

/// Flank of `gear` in a measured file, filtered with `cutoff_mm`; 0: not at all.
///
/// # Errors
/// The first thing that is wrong with the file; heights from a line, whose slope nobody knows; a file of another gear.
pub fn read(
    bytes: &[u8],
    choice: &TraceChoice,
    cutoff_mm: f64,
    pair: &GearPair,
    gear: Gear,
) -> Result<InitialFlank, DataTableError> {
    let file = file::parse(&decode(bytes), choice)?;
    check_gear(&file, pair, gear)?;
    if file.kind == ValueKind::Height && file.height_from == HeightFrom::Line {
        let allowed = "heights from the involute, as a gear measuring machine has them".to_owned();
        return Err(not_allowed(1, "height_from", "line", allowed));
    }
    let profile = MeasuredProfile::on_flank(&file, pair, gear)?;
    let [_, places_mm] = profile.places_mm(pair);
    // Points that lie a little beyond an end of the flank are at that end together.
    let mut points: Vec<(f64, f64)> = places_mm.into_iter().zip(profile.height_um).collect();
    points.dedup_by(|point, before| point.0 <= before.0);
    let (rho_mm, height_um): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
    let removed_mm: Vec<f64> = match file.kind {
        ValueKind::Wear => {
            let filtered_um = filtered(&rho_mm, &height_um, cutoff_mm);
            filtered_um.iter().map(|z| pair.obliquity().transverse_mm(-MM_PER_UM * z)).collect()
        }
        ValueKind::Height => from_heights(pair, gear, &rho_mm, &height_um, cutoff_mm),
    };
    let from_to_mm = [rho_mm.first(), rho_mm.last()].map(|end| end.copied().unwrap_or_default());
    let flank = MeasuredFlank::new(&pair.teeth[gear].involute, rho_mm, removed_mm);
    let flank = flank.ok_or_else(|| missing("the profile", "at least two points at different places".to_owned()))?;
    Ok(InitialFlank { flank, kind: file.kind, from_to_mm })
}

/// Refuses the file of another gear.
fn check_gear(file: &MeasuredFile, pair: &GearPair, gear: Gear) -> Result<(), DataTableError> {
    if let Some(other) = file.gear.filter(|&other| other != gear) {
        return Err(not_allowed(
            1,
            "gear",
            other.name(),
            format!("{}, for which the scene names the file", gear.name()),
        ));
    }
    let Some(machine) = file.machine_gear else { return Ok(()) };
    let allowed = |value: String| format!("{value}, that of the {}", gear.name());
    if !machine.has_teeth_of(pair, gear) {
        let teeth = pair.spec.gears[gear].teeth.to_string();
        return Err(not_allowed(machine.line, "number of teeth", machine.teeth, allowed(teeth)));
    }
    if !machine.has_size_of(pair, gear) {
        let base = format!("{:.4}", pair.teeth[gear].involute.base_radius_mm);
        let found = format!("{:.4}, by module, teeth and angles", machine.base_radius_mm);
        return Err(not_allowed(machine.line, "base radius, mm", found, allowed(base)));
    }
    Ok(())
}

/// e(ρ) of heights.
fn from_heights(pair: &GearPair, gear: Gear, rho_mm: &[f64], height_um: &[f64], cutoff_mm: f64) -> Vec<f64> {
    let (tooth, rounding_mm) = (&pair.teeth[gear], pair.spec.gears[gear].modification.tip_rounding_mm);
    let rounding = |rho: f64| removed_material::tip_edge_mm(rounding_mm, tooth, rho);
    let without_rounding: Vec<f64> =
        rho_mm.iter().zip(height_um).map(|(&rho, z)| MM_PER_UM * z + rounding(rho)).collect();
    let filtered_mm = filtered(rho_mm, &without_rounding, cutoff_mm);
    let form_rho = tooth.involute.curvature_radius_mm(pair.tip_form_radius_mm(gear));
    let active = pair.active_start_rho_mm(gear)..=form_rho;
    let greatest = |inside: &dyn Fn(f64) -> bool| {
        let inside = rho_mm.iter().zip(&filtered_mm).filter(|&(&rho, _)| inside(rho));
        inside.map(|(_, &z)| z).fold(f64::NEG_INFINITY, f64::max)
    };
    let of_active = greatest(&|rho| active.contains(&rho));
    let highest = if of_active.is_finite() { of_active } else { greatest(&|_| true) };
    filtered_mm.iter().map(|z| highest - z).collect()
}

/// Values at increasing places after the filter.
fn filtered(place_mm: &[f64], values: &[f64], cutoff_mm: f64) -> Vec<f64> {
    if cutoff_mm <= 0.0 {
        return values.to_vec();
    }
    let last = place_mm.len().saturating_sub(1);
    let share_mm = |i: usize| 0.5 * (place_mm[(i + 1).min(last)] - place_mm[i.saturating_sub(1)]);
    let at = |i: usize| {
        let x = place_mm[i];
        let first = place_mm.partition_point(|&other| other < x - REACH * cutoff_mm);
        let end = place_mm.partition_point(|&other| other <= x + REACH * cutoff_mm);
        let mut sums = [0.0; 5];
        for j in first..end {
            let u = (place_mm[j] - x) / cutoff_mm;
            let weight = (-PI * PI * u * u / LN_2).exp() * share_mm(j);
            let terms = [1.0, u, u * u, values[j], u * values[j]];
            sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += weight * term);
        }
        let [w, u, uu, z, uz] = sums;
        let determinant = w * uu - u * u;
        // A point alone, or with neighbours whose weights vanish, stays.
        if determinant > f64::EPSILON * w * w { (z * uu - u * uz) / determinant } else { values[i] }
    };
    (0..place_mm.len()).map(at).collect()
}

impl InitialFlank {
    /// The ends of the active profile that the profile does not reach, in words; none where it reaches both.
    pub fn uncovered(&self, pair: &GearPair, gear: Gear) -> Option<String> {
        let [start, form] = [pair.active_start_radius_mm(gear), pair.tip_form_radius_mm(gear)];
        let involute = pair.teeth[gear].involute;
        let [start_rho, form_rho] = [start, form].map(|radius| involute.curvature_radius_mm(radius));
        let tolerated = UNCOVERED * (form_rho - start_rho);
        let [from, to] = self.from_to_mm;
        let of = |rho: f64, what: &str, end: f64| {
            format!("{:.3} mm, where {what} has {:.3} mm", 2.0 * involute.radius_mm(rho).abs(), 2.0 * end.abs())
        };
        let mut ends = Vec::new();
        if from > start_rho + tolerated {
            ends.push(format!("begins at {}", of(from, "the start of active profile (SAP)", start)));
        }
        if to < form_rho - tolerated {
            ends.push(format!("ends at {}", of(to, "the tip form circle", form)));
        }
        (!ends.is_empty()).then(|| ends.join(" and "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines stay lines up to their ends, at uneven places; a wave of the length of the cutoff keeps half its height (ISO 16610-21).
    #[test]
    fn ver_lines_stay_and_the_cutoff_passes_half() {
        let places: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i) + 0.003 * (f64::from(i) * 1.7).sin()).collect();
        let line: Vec<f64> = places.iter().map(|x| 3.0 - 2.0 * x).collect();
        assert!(filtered(&places, &line, 0.3).iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-9));
        let even: Vec<f64> = (0..4000).map(|i| 1e-3 * f64::from(i)).collect();
        let wave: Vec<f64> = even.iter().map(|x| (2.0 * PI * x / 0.4).cos()).collect();
        let middle = filtered(&even, &wave, 0.4)[2000];
        assert!((middle / wave[2000] - 0.5).abs() < 1e-3, "{middle}");
        assert_eq!(filtered(&even, &wave, 0.0), wave);
    }
}
