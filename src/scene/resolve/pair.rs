//! The pair as given, in normal-section terms.
//!
//! With β at the reference cylinder: m_n = m_t cos β, tan α_n = tan α_t cos β, and every factor of the transverse module
//! becomes x_n = x_t / cos β, because x_n m_n = x_t m_t is the same length.

use crate::gear::modification::{EndRelief, Modification, Relief};
use crate::gear::root_trochoid::greatest_fillet_radius_factor;
use crate::gear::shaft::Shaft;
use crate::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};
use crate::gear::{Gear, GearPair, PerGear};
use crate::scene::file::{AxisParallelismFile, BasicRackFile, GearFile, PairFile, ReliefFile, ShaftFile};
use crate::scene::findings::Findings;
use crate::scene::problem::number;

const UM: f64 = 1e-3;
const PRESET: &str = "pair.preset";

/// Chooses what `[pair]` leaves open; `None` where something needed is missing or contradictory.
pub(super) fn choose(file: &mut PairFile, findings: &mut Findings) -> Option<PairSpec> {
    let helix_angle_rad = file.helix_angle_deg.get_or_insert(0.0).to_radians();
    let cos_beta = helix_angle_rad.cos();

    let normal_module_mm = module(file, cos_beta, findings);
    let factor_scale = if file.transverse_module_mm.is_some() { 1.0 / cos_beta } else { 1.0 };
    let normal_pressure_angle_rad = pressure_angle(file, cos_beta, findings);
    let positive = "a number greater than 0";
    let centre_distance_mm = required(file.centre_distance_mm, "pair.centre_distance_mm", positive, findings);
    let face_width_mm = required(file.face_width_mm, "pair.face_width_mm", positive, findings);
    let rack = rack(file.basic_rack.get_or_insert_default(), factor_scale, normal_pressure_angle_rad, findings);
    let pinion = gear(file.pinion.get_or_insert_default(), Gear::Pinion, factor_scale, findings);
    let wheel = gear(file.wheel.get_or_insert_default(), Gear::Wheel, factor_scale, findings);
    let axis_parallelism = face_width_mm
        .zip(file.axis_parallelism.as_mut())
        .map(|(face_width_mm, axes)| axis_parallelism(axes, face_width_mm));
    let spec = PairSpec {
        normal_module_mm: normal_module_mm?,
        normal_pressure_angle_rad: normal_pressure_angle_rad?,
        helix_angle_rad,
        centre_distance_mm: centre_distance_mm?,
        face_width_mm: face_width_mm?,
        rack,
        axis_parallelism: axis_parallelism.unwrap_or_default(),
        gears: PerGear { pinion: pinion?, wheel: wheel? },
    };
    lengths_from_starts(file, spec, findings)
}

/// Gives reliefs that are said by where they begin the roll length from there to their end of the flank.
fn lengths_from_starts(file: &mut PairFile, mut spec: PairSpec, findings: &mut Findings) -> Option<PairSpec> {
    let mut bare = spec.clone();
    for gear in Gear::BOTH {
        bare.gears[gear].modification = Modification::default();
    }
    // A pair that cannot exist is found, and said, by whoever makes it next.
    let Ok(pair) = GearPair::new(&bare) else { return Some(spec) };
    let mut are_sound = true;
    for (gear, file) in [(Gear::Pinion, file.pinion.as_mut()), (Gear::Wheel, file.wheel.as_mut())] {
        let Some(file) = file else { continue };
        let tooth = &pair.teeth[gear];
        let (sap_rho, tip_rho) = (pair.active_start_rho_mm(gear), tooth.tip_rho_mm());
        let base_mm = tooth.involute.base_radius_mm;
        let Modification { tip_relief, root_relief, .. } = &mut spec.gears[gear].modification;
        let reliefs = [
            ("tip_relief", file.tip_relief.as_mut(), tip_relief),
            ("root_relief", file.root_relief.as_mut(), root_relief),
        ];
        for (name, file, relief) in reliefs {
            let (Some(file), Some(relief)) = (file, relief) else { continue };
            let diameter_of = |rho: f64| 2.0 * tooth.involute.radius_mm(rho);
            let angle_of = |rho: f64| (rho / base_mm).to_degrees();
            let (key, found, rho, ends) =
                match (file.begins_at_diameter_mm.take(), file.begins_at_roll_angle_deg.take()) {
                    (Some(diameter_mm), _) => {
                        let rho = (0.25 * diameter_mm * diameter_mm - base_mm * base_mm).max(0.0).sqrt();
                        ("begins_at_diameter_mm", diameter_mm, rho, [sap_rho, tip_rho].map(diameter_of))
                    }
                    (None, Some(angle_deg)) => (
                        "begins_at_roll_angle_deg",
                        angle_deg,
                        base_mm * angle_deg.to_radians(),
                        [sap_rho, tip_rho].map(angle_of),
                    ),
                    (None, None) => continue,
                };
            if !(sap_rho..=tip_rho).contains(&rho) || rho == if name == "tip_relief" { tip_rho } else { sap_rho } {
                let [sap, tip] = ends.map(|end| (end * 1e4).round() / 1e4);
                findings.not_allowed(
                    &format!("pair.{}.{name}.{key}", gear.name()),
                    number(found),
                    format!("between the start of active profile, {sap}, and the tip circle, {tip}"),
                );
                are_sound = false;
                continue;
            }
            relief.length_mm = if name == "tip_relief" { tip_rho - rho } else { rho - sap_rho };
            file.length_mm = Some(relief.length_mm);
        }
    }
    are_sound.then_some(spec)
}

fn required<T>(value: Option<T>, key: &str, allowed: &str, findings: &mut Findings) -> Option<T> {
    if value.is_none() {
        findings.missing(&[key, PRESET], allowed);
    }
    value
}

fn module(file: &PairFile, cos_beta: f64, findings: &mut Findings) -> Option<f64> {
    let keys = ["pair.normal_module_mm", "pair.transverse_module_mm"];
    match (file.normal_module_mm, file.transverse_module_mm) {
        (Some(normal), None) => Some(normal),
        (None, Some(transverse)) => Some(transverse * cos_beta),
        (Some(_), Some(_)) => {
            findings.said_twice(&keys.map(|key| (key, true)));
            None
        }
        (None, None) => {
            findings.missing(&[keys[0], keys[1], PRESET], "a number greater than 0");
            None
        }
    }
}

fn pressure_angle(file: &PairFile, cos_beta: f64, findings: &mut Findings) -> Option<f64> {
    let keys = ["pair.pressure_angle_deg", "pair.transverse_pressure_angle_deg"];
    match (file.pressure_angle_deg, file.transverse_pressure_angle_deg) {
        (Some(normal), None) => Some(normal.to_radians()),
        (None, Some(transverse)) if cos_beta == 1.0 => Some(transverse.to_radians()),
        (None, Some(transverse)) => Some((transverse.to_radians().tan() * cos_beta).atan()),
        (Some(_), Some(_)) => {
            findings.said_twice(&keys.map(|key| (key, true)));
            None
        }
        (None, None) => {
            findings.missing(&[keys[0], keys[1], PRESET], "a number at least 5 and at most 45");
            None
        }
    }
}

fn rack(
    file: &mut BasicRackFile,
    factor_scale: f64,
    normal_pressure_angle_rad: Option<f64>,
    findings: &mut Findings,
) -> BasicRack {
    let standard = BasicRack::default();
    let addendum_factor = factor_scale * *file.addendum_factor.get_or_insert(standard.addendum_factor);
    let dedendum_factor = factor_scale * *file.dedendum_factor.get_or_insert(standard.dedendum_factor);
    let fillet = file.fillet_radius_factor.unwrap_or_else(|| {
        // The standard's rounding of a transverse module does not fit into the normal section of a steep helix.
        let room = normal_pressure_angle_rad.map_or(f64::INFINITY, |alpha| {
            greatest_fillet_radius_factor(alpha, dedendum_factor) / factor_scale
        });
        if factor_scale == 1.0 || room >= standard.fillet_radius_factor || room <= 0.0 {
            return standard.fillet_radius_factor;
        }
        let fits = (1e3 * room).floor() / 1e3;
        findings.warnings.push(format!(
            "pair.basic_rack.fillet_radius_factor: {} of the transverse module does not fit into the normal section of the rack; \
             {fits} is used",
            standard.fillet_radius_factor
        ));
        fits
    });
    file.fillet_radius_factor = Some(fillet);
    BasicRack { addendum_factor, dedendum_factor, fillet_radius_factor: factor_scale * fillet }
}

fn gear(file: &mut GearFile, which: Gear, factor_scale: f64, findings: &mut Findings) -> Option<GearSpec> {
    let key = |name: &str| format!("pair.{}.{name}", which.name());
    let teeth = required(file.teeth, &key("teeth"), "a whole number at least 5 and at most 10000", findings);
    let shift =
        required(file.profile_shift, &key("profile_shift"), "a number at least -5 and at most 5 (0: none)", findings);
    let mut read = |file: Option<&mut ReliefFile>, name: &str| {
        file.map_or(Some(None), |file| relief(file, &key(name), findings).map(Some))
    };
    let tip_relief = read(file.tip_relief.as_mut(), "tip_relief");
    let root_relief = read(file.root_relief.as_mut(), "root_relief");
    let (tip_relief, root_relief) = (tip_relief?, root_relief?);
    Some(GearSpec {
        teeth: teeth?,
        profile_shift: factor_scale * shift?,
        tip_diameter_mm: file.tip_diameter_mm,
        tooth_thickness_allowance_mm: UM * *file.tooth_thickness_allowance_um.get_or_insert(0.0),
        bore_diameter_mm: file.bore_diameter_mm,
        modification: Modification {
            tip_relief,
            root_relief,
            profile_crowning_mm: UM * *file.profile_crowning_um.get_or_insert(0.0),
            tip_rounding_mm: *file.tip_rounding_mm.get_or_insert(0.0),
            lead_crowning_mm: UM * *file.lead_crowning_um.get_or_insert(0.0),
            end_relief: file.end_relief.as_mut().map(|relief| EndRelief {
                amount_mm: UM * relief.amount_um,
                length_mm: relief.length_mm,
                shape: *relief.shape.get_or_insert_default(),
            }),
            helix_slope_mm: UM * *file.helix_slope_deviation_um.get_or_insert(0.0),
        },
        shaft: file.shaft.as_mut().and_then(|file| shaft(file, &key("shaft"), findings)),
    })
}

fn shaft(file: &mut ShaftFile, key: &str, findings: &mut Findings) -> Option<Shaft> {
    let bore_diameter_mm = *file.bore_diameter_mm.get_or_insert(0.0);
    if bore_diameter_mm >= file.diameter_mm {
        findings.not_allowed(
            &format!("{key}.bore_diameter_mm"),
            bore_diameter_mm.to_string(),
            format!("less than {key}.diameter_mm, {} mm", file.diameter_mm),
        );
        return None;
    }
    let driven_at = *file.driven_at.get_or_insert_default();
    Some(Shaft { diameter_mm: file.diameter_mm, bore_diameter_mm, driven_at })
}

fn axis_parallelism(file: &mut AxisParallelismFile, face_width_mm: f64) -> AxisParallelism {
    let over_face_width = UM * face_width_mm / *file.over_length_mm.get_or_insert(face_width_mm);
    AxisParallelism {
        in_plane_mm: over_face_width * *file.in_plane_um.get_or_insert(0.0),
        out_of_plane_mm: over_face_width * *file.out_of_plane_um.get_or_insert(0.0),
    }
}

/// A relief, whose length is not known yet where it is said by its start.
fn relief(file: &mut ReliefFile, key: &str, findings: &mut Findings) -> Option<Relief> {
    let keys = ["length_mm", "begins_at_diameter_mm", "begins_at_roll_angle_deg"].map(|name| format!("{key}.{name}"));
    let keys = keys.each_ref().map(String::as_str);
    let given =
        [file.length_mm, file.begins_at_diameter_mm, file.begins_at_roll_angle_deg].map(|value| value.is_some());
    if given == [false; 3] {
        findings.missing(&keys, "a number greater than 0");
        return None;
    }
    let [length, diameter, angle] = [0, 1, 2].map(|i| (keys[i], given[i]));
    if findings.said_twice(&[length, diameter, angle]) {
        return None;
    }
    let length_mm = file.length_mm.unwrap_or(0.0);
    Some(Relief { amount_mm: UM * file.amount_um, length_mm, shape: *file.shape.get_or_insert_default() })
}
