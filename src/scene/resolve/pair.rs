//! The pair as given, in normal-section terms.
//!
//! With β at the reference cylinder: m_n = m_t cos β, tan α_n = tan α_t cos β, and every factor of the transverse module
//! becomes x_n = x_t / cos β, because x_n m_n = x_t m_t is the same length.

use super::{centre_distance, modifications};
use crate::scene::file::{AxisParallelismFile, BasicRackFile, PairFile};
use crate::scene::findings::Findings;
use crate::scene::gear_file::{CutterFile, GearFile, ShaftFile};
use crate::scene::presets;
use gearwear_bodies::gear::modification::Modification;
use gearwear_bodies::gear::ring_fillet::{RingSpec, ShaperCutter};
use gearwear_bodies::gear::root_trochoid::greatest_fillet_radius_factor;
use gearwear_bodies::gear::shaft::Shaft;
use gearwear_bodies::gear::shaft_bearings::ShaftBearings;
use gearwear_bodies::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};
use gearwear_bodies::gear::tip_chamfer::TipChamfer;
use gearwear_bodies::gear::{Gear, PerGear};

const UM: f64 = 1e-3;

/// Chooses what `[pair]` leaves open; `None` where something needed is missing or contradictory.
pub(super) fn choose(file: &mut PairFile, findings: &mut Findings) -> Option<PairSpec> {
    let helix_angle_rad = file.helix_angle_deg.get_or_insert(0.0).to_radians();
    let cos_beta = helix_angle_rad.cos();

    let normal_module_mm = module(file, cos_beta, findings);
    let factor_scale = if file.transverse_module_mm.is_some() { 1.0 / cos_beta } else { 1.0 };
    let normal_pressure_angle_rad = pressure_angle(file, cos_beta, findings);
    let centre_distance = centre_distance::given(file, findings);
    let face_width_mm = required(file.face_width_mm, "pair.face_width_mm", "a number greater than 0", findings);
    let rack = rack(file.basic_rack.get_or_insert_default(), factor_scale, normal_pressure_angle_rad, findings);
    let pinion = gear(file.pinion.get_or_insert_default(), Gear::Pinion, factor_scale, findings);
    let wheel = gear(file.wheel.get_or_insert_default(), Gear::Wheel, factor_scale, findings);
    let axis_parallelism = face_width_mm
        .zip(file.axis_parallelism.as_mut())
        .map(|(face_width_mm, axes)| axis_parallelism(axes, face_width_mm));
    let mut spec = PairSpec {
        normal_module_mm: normal_module_mm?,
        normal_pressure_angle_rad: normal_pressure_angle_rad?,
        helix_angle_rad,
        centre_distance_mm: f64::NAN,
        face_width_mm: face_width_mm?,
        rack,
        axis_parallelism: axis_parallelism.unwrap_or_default(),
        gears: PerGear { pinion: pinion?, wheel: wheel? },
    };
    spec.centre_distance_mm = centre_distance::choose(centre_distance?, file, &spec, findings)?;
    shorten_ring_tip(file, &mut spec, findings);
    modifications::choose(file, &mut spec, findings)?;
    Some(spec)
}

/// Shortens the tips of an internal wheel that follow from the rack and would interfere with the pinion.
fn shorten_ring_tip(file: &mut PairFile, spec: &mut PairSpec, findings: &mut Findings) {
    let (Some(tip_mm), Some(wheel)) = (spec.shortened_ring_tip_mm(), &mut file.wheel) else { return };
    // As it is written into the file.
    let tip_mm = (tip_mm.abs() * 1e4).round() / 1e4;
    findings.warnings.push(format!(
        "pair.wheel.tip_diameter_mm: {tip_mm} mm instead of the rack's {:.4} mm, whose tips would interfere with the pinion",
        2.0 * spec.tip_radius_mm(Gear::Wheel).abs()
    ));
    spec.gears.wheel.tip_diameter_mm = Some(-tip_mm);
    wheel.tip_diameter_mm = Some(tip_mm);
}

fn required<T>(value: Option<T>, key: &str, allowed: &str, findings: &mut Findings) -> Option<T> {
    if value.is_none() {
        findings.missing(&[key, presets::KEY], allowed);
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
            findings.missing(&[keys[0], keys[1], presets::KEY], "a number greater than 0");
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
            findings.missing(&[keys[0], keys[1], presets::KEY], "a number at least 5 and at most 45");
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
        // The standard's rounding does not fit into a rack of great pressure angle or dedendum, nor that of a transverse module into the
        // normal section of a steep helix. Where no rounding fits, the rack itself is refused.
        let room = normal_pressure_angle_rad
            .map_or(f64::INFINITY, |alpha| greatest_fillet_radius_factor(alpha, dedendum_factor) / factor_scale);
        if room >= standard.fillet_radius_factor || room < 0.0 {
            return standard.fillet_radius_factor;
        }
        let fits = (1e4 * room).floor() / 1e4;
        let why = if factor_scale == 1.0 {
            "the default does not fit between the flanks of the rack at this pressure angle and dedendum"
        } else {
            "that much of the transverse module, the default, does not fit into the normal section of the rack"
        };
        findings.warnings.push(format!(
            "pair.basic_rack.fillet_radius_factor: {fits} instead of {}, as {why}",
            standard.fillet_radius_factor
        ));
        fits
    });
    file.fillet_radius_factor = Some(fillet);
    BasicRack { addendum_factor, dedendum_factor, fillet_radius_factor: factor_scale * fillet }
}

fn gear(file: &mut GearFile, which: Gear, factor_scale: f64, findings: &mut Findings) -> Option<GearSpec> {
    let is_internal = file.internal == Some(true);
    // Diameters of internal gears are negative inside the model.
    let signed = |diameter_mm: f64| if is_internal { -diameter_mm } else { diameter_mm };
    let table = format!("pair.{}", which.name());
    let teeth =
        required(file.teeth, &format!("{table}.teeth"), "a whole number at least 5 and at most 10000", findings);
    let shift_key = format!("{table}.profile_shift");
    let shift = required(file.profile_shift, &shift_key, "a number at least -5 and at most 5 (0: none)", findings);
    let ring = is_internal.then(|| RingSpec {
        root_diameter_mm: file.root_diameter_mm.map(signed),
        cutter: file.cutter.as_mut().map(|cutter| shaper_cutter(cutter, factor_scale)),
    });
    Some(GearSpec {
        teeth: teeth?,
        profile_shift: factor_scale * shift?,
        tip_diameter_mm: file.tip_diameter_mm.map(signed),
        tip_chamfer: tip_chamfer(file),
        tooth_thickness_allowance_mm: UM * *file.tooth_thickness_allowance_um.get_or_insert(0.0),
        bore_diameter_mm: file.bore_diameter_mm,
        // Chosen where the whole pair is known.
        modification: Modification::default(),
        measured_flank: None,
        shaft: file.shaft.as_mut().and_then(|file| shaft(file, &format!("{table}.shaft"), findings)),
        ring,
    })
}

/// Angle of a tip chamfer to the radius, °.
const CHAMFER_DEG: f64 = 45.0;

fn tip_chamfer(file: &mut GearFile) -> Option<TipChamfer> {
    let height_mm = file.tip_chamfer_mm.filter(|&height_mm| height_mm > 0.0)?;
    Some(TipChamfer { height_mm, angle_rad: file.tip_chamfer_deg.get_or_insert(CHAMFER_DEG).to_radians() })
}

/// Addendum factor of a shaper cutter whose teeth reach as deep as those of the standard rack.
const CUTTER_ADDENDUM: f64 = 1.25;
/// Radius of a cutter's tip edge, in modules.
const CUTTER_TIP_ROUNDING: f64 = 0.2;

fn shaper_cutter(file: &mut CutterFile, factor_scale: f64) -> ShaperCutter {
    ShaperCutter {
        teeth: file.teeth,
        profile_shift: factor_scale * *file.profile_shift.get_or_insert(0.0),
        addendum_factor: factor_scale * *file.addendum_factor.get_or_insert(CUTTER_ADDENDUM),
        tip_rounding_factor: factor_scale * *file.tip_rounding_factor.get_or_insert(CUTTER_TIP_ROUNDING),
    }
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
    let bearings = bearings(file, key, findings)?;
    Some(Shaft { diameter_mm: file.diameter_mm, bore_diameter_mm, driven_at, bearings })
}

/// The bearings of a shaft; `Some(None)` without any.
fn bearings(file: &ShaftFile, key: &str, findings: &mut Findings) -> Option<Option<ShaftBearings>> {
    let [positions, stiffness] =
        ["bearing_positions_mm", "bearing_stiffness_N_per_mm"].map(|name| format!("{key}.{name}"));
    let (positions_mm, stiffness_n_per_mm) = match (file.bearing_positions_mm, file.bearing_stiffness_N_per_mm) {
        (None, None) => return Some(None),
        (Some(positions_mm), Some(stiffness_n_per_mm)) => (positions_mm, stiffness_n_per_mm),
        (Some(_), None) => {
            findings.missing(&[&stiffness], "two numbers greater than 0");
            return None;
        }
        (None, Some(_)) => {
            findings.missing(&[&positions], "two increasing numbers");
            return None;
        }
    };
    let listed = |[a, b]: [f64; 2]| format!("[{a}, {b}]");
    let is_increasing = positions_mm.iter().all(|x| x.is_finite()) && positions_mm[0] < positions_mm[1];
    if !is_increasing {
        findings.not_allowed(
            &positions,
            listed(positions_mm),
            "two increasing numbers, mm from the middle of the face width",
        );
    }
    let is_stiff = stiffness_n_per_mm.iter().all(|k| k.is_finite() && *k > 0.0);
    if !is_stiff {
        findings.not_allowed(&stiffness, listed(stiffness_n_per_mm), "two numbers greater than 0, N/mm");
    }
    (is_increasing && is_stiff).then_some(Some(ShaftBearings { positions_mm, stiffness_n_per_mm }))
}

fn axis_parallelism(file: &mut AxisParallelismFile, face_width_mm: f64) -> AxisParallelism {
    let over_face_width = UM * face_width_mm / *file.over_length_mm.get_or_insert(face_width_mm);
    AxisParallelism {
        in_plane_mm: over_face_width * *file.in_plane_um.get_or_insert(0.0),
        out_of_plane_mm: over_face_width * *file.out_of_plane_um.get_or_insert(0.0),
    }
}
