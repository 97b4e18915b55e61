//! Modifications of the flanks, as drawings give them.
//!
//! A tip or root relief begins at a roll length from its end, at a diameter or at a roll angle:
//!
//! ```text
//! ρ = √((d/2)² − r_b²) = r_b φ       L = ρ_a − ρ at the tip       L = ρ − ρ_Nf at the root
//! ```
//!
//! with ρ_a at the tip circle and ρ_Nf at the start of active profile (SAP). A helix slope is a deviation, or the whole tolerance of a class.

use crate::measured_flank::initial::default_cutoff_mm;
use crate::scene::file::PairFile;
use crate::scene::findings::Findings;
use crate::scene::gear_file::{EndReliefFile, GearFile, ReliefFile};
use crate::scene::problem::number;
use gearwear_bodies::gear::flank_edge::LEAST_ROUNDING_MODULES;
use gearwear_bodies::gear::modification::{EndRelief, Modification, Relief};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::{Gear, GearPair, tolerance};

const UM: f64 = 1e-3;

/// The end of the flank that a relief runs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FlankEnd {
    Tip,
    Root,
}

/// Sets the modifications of both gears of `spec`; `None` where one is contradictory.
pub(super) fn choose(file: &mut PairFile, spec: &mut PairSpec, findings: &mut Findings) -> Option<()> {
    let begins =
        |relief: &ReliefFile| relief.begins_at_diameter_mm.is_some() || relief.begins_at_roll_angle_deg.is_some();
    let gears = [&file.pinion, &file.wheel].into_iter().flatten();
    let is_needed = gears.into_iter().any(|gear| {
        gear.initial_flank.is_some() || [&gear.tip_relief, &gear.root_relief].into_iter().flatten().any(begins)
    });
    // An impossible pair is reported later; reliefs then have no position.
    let pair = is_needed.then(|| GearPair::new(spec).ok()).flatten();
    let [pinion, wheel] = [(&mut file.pinion, Gear::Pinion), (&mut file.wheel, Gear::Wheel)]
        .map(|(file, gear)| of_gear(file.get_or_insert_default(), gear, spec, pair.as_ref(), findings));
    spec.gears.pinion.modification = pinion?;
    spec.gears.wheel.modification = wheel?;
    Some(())
}

fn of_gear(
    file: &mut GearFile,
    gear: Gear,
    spec: &PairSpec,
    pair: Option<&GearPair>,
    findings: &mut Findings,
) -> Option<Modification> {
    let table = format!("pair.{}", gear.name());
    let [tip_relief, root_relief] =
        [(&mut file.tip_relief, "tip_relief", FlankEnd::Tip), (&mut file.root_relief, "root_relief", FlankEnd::Root)]
            .map(|(file, name, end)| match file {
                Some(file) => relief(file, &format!("{table}.{name}"), gear, end, pair, findings),
                None => Some(None),
            });
    if let (Some(flank), Some(pair)) = (&mut file.initial_flank, pair) {
        flank.cutoff_mm.get_or_insert_with(|| default_cutoff_mm(pair, gear));
    }
    let helix_slope_um = helix_slope_um(file, gear, spec, findings);
    let tip_rounding_mm = *file.tip_rounding_mm.get_or_insert(0.0);
    let least_mm = LEAST_ROUNDING_MODULES * spec.normal_module_mm;
    if tip_rounding_mm > 0.0 && tip_rounding_mm < least_mm {
        findings.warnings.push(format!(
            "{table}.tip_rounding_mm: {} mm is less than {} mm, a thousandth of the module, and as rough as a ground surface: the tip edge \
             counts as sharp",
            number(tip_rounding_mm),
            number((least_mm * 1e7).round() / 1e7),
        ));
    }
    if let Some(height_mm) = file.tip_chamfer_mm.filter(|&height_mm| height_mm > 0.0 && height_mm < least_mm) {
        findings.warnings.push(format!(
            "{table}.tip_chamfer_mm: {} mm is less than {} mm, a thousandth of the module: it counts as none",
            number(height_mm),
            number((least_mm * 1e7).round() / 1e7),
        ));
    }
    Some(Modification {
        tip_relief: tip_relief?,
        root_relief: root_relief?,
        profile_crowning_mm: UM * *file.profile_crowning_um.get_or_insert(0.0),
        profile_slope_mm: UM * *file.profile_slope_deviation_um.get_or_insert(0.0),
        tip_rounding_mm,
        lead_crowning_mm: UM * *file.lead_crowning_um.get_or_insert(0.0),
        end_relief: file.end_relief.as_mut().map(end_relief),
        helix_slope_mm: UM * helix_slope_um?,
    })
}

fn end_relief(file: &mut EndReliefFile) -> EndRelief {
    EndRelief { amount_mm: UM * file.amount_um, length_mm: file.length_mm, shape: *file.shape.get_or_insert_default() }
}

/// Chooses the relief at `key`, its length written into the file; `Some(None)` where there is no pair to find it on.
fn relief(
    file: &mut ReliefFile,
    key: &str,
    gear: Gear,
    end: FlankEnd,
    pair: Option<&GearPair>,
    findings: &mut Findings,
) -> Option<Option<Relief>> {
    let keys = ["length_mm", "begins_at_diameter_mm", "begins_at_roll_angle_deg"].map(|name| format!("{key}.{name}"));
    let [length, diameter, roll_angle] = keys.each_ref().map(String::as_str);
    let given = [
        (length, file.length_mm.is_some()),
        (diameter, file.begins_at_diameter_mm.is_some()),
        (roll_angle, file.begins_at_roll_angle_deg.is_some()),
    ];
    if findings.said_twice(&given) {
        return None;
    }
    let length_mm = match (file.length_mm, file.begins_at_diameter_mm, file.begins_at_roll_angle_deg) {
        (Some(length_mm), ..) => length_mm,
        (_, None, None) => {
            findings.missing(&[length, diameter, roll_angle], "a number greater than 0");
            return None;
        }
        (_, begins_at_diameter_mm, begins_at_roll_angle_deg) => {
            let Some(pair) = pair else { return Some(None) };
            let flank = &pair.teeth[gear].involute;
            let [start, tip] = [pair.active_start_rho_mm(gear), pair.teeth[gear].edge_rho_mm()];
            let (begins_mm, key, found, [least, most], unit) = match (begins_at_diameter_mm, begins_at_roll_angle_deg) {
                (Some(diameter_mm), _) => {
                    let ends = [start, tip].map(|rho| 2.0 * flank.radius_mm(rho).abs());
                    (flank.curvature_radius_mm(0.5 * diameter_mm), diameter, diameter_mm, ends, "mm")
                }
                (None, angle_deg) => {
                    let angle_deg = angle_deg.unwrap_or_default();
                    let ends = [start, tip].map(|rho| flank.roll_angle_rad(rho).to_degrees());
                    (flank.base_radius_mm * angle_deg.to_radians(), roll_angle, angle_deg, ends, "°")
                }
            };
            if !(start < begins_mm && begins_mm < tip) {
                let allowed = format!(
                    "between {least:.4} {unit} at the start of active profile (SAP) and {most:.4} {unit} at the tip circle"
                );
                findings.not_allowed(key, number(found), allowed);
                return None;
            }
            match end {
                FlankEnd::Tip => tip - begins_mm,
                FlankEnd::Root => begins_mm - start,
            }
        }
    };
    (file.length_mm, file.begins_at_diameter_mm, file.begins_at_roll_angle_deg) = (Some(length_mm), None, None);
    Some(Some(Relief { amount_mm: UM * file.amount_um, length_mm, shape: *file.shape.get_or_insert_default() }))
}

/// The helix-slope deviation, written into the file, or the tolerance of its class.
fn helix_slope_um(file: &mut GearFile, gear: Gear, spec: &PairSpec, findings: &mut Findings) -> Option<f64> {
    let [deviation, class] =
        ["helix_slope_deviation_um", "helix_slope_class"].map(|name| format!("pair.{}.{name}", gear.name()));
    let given = [(&*deviation, file.helix_slope_deviation_um.is_some()), (&*class, file.helix_slope_class.is_some())];
    if findings.said_twice(&given) {
        return None;
    }
    if let Some(number_of_class) = file.helix_slope_class.take() {
        let [diameter_mm, width_mm] = [2.0 * spec.reference_radius_mm(gear).abs(), spec.face_width_mm];
        for (what, value, [least, most]) in [
            ("a reference diameter", diameter_mm, tolerance::DIAMETERS_MM),
            ("a face width", width_mm, tolerance::WIDTHS_MM),
        ] {
            if !(least..=most).contains(&value) {
                findings.warnings.push(format!(
                    "{class}: {what} of {} mm lies outside what ISO 1328-1 has tolerances for, {least} to {most} mm",
                    (value * 1e4).round() / 1e4
                ));
            }
        }
        file.helix_slope_deviation_um = Some(tolerance::helix_slope_um(number_of_class, diameter_mm, width_mm));
    }
    Some(*file.helix_slope_deviation_um.get_or_insert(0.0))
}
