//! Keys and units of other programs that the model does not have, with messages in words of the field.

use super::problem::number;

/// 1 lbf·in in N·m.
const NEWTON_METRES_IN_POUND_INCH: f64 = 0.112_984_829;

/// Reason why a value of `key` outside its range is not modelled.
pub(super) fn reason(key: &str, value: f64) -> Option<&'static str> {
    match key {
        "pair.pinion.teeth" if value < 0.0 => {
            Some("a negative number of teeth is that of an internal gear (ISO 21771), which is the wheel of a pair")
        }
        "pair.wheel.teeth" if value < 0.0 => {
            Some("an internal wheel is said by internal = true in [pair.wheel] and a positive number of teeth here")
        }
        "pair.helix_angle_deg" if value.abs() > 45.0 => Some(
            "helix angles beyond 45° are those of gears on crossed axes: crossed helical and worm gears are not in the model, axes are \
             parallel",
        ),
        _ => None,
    }
}

/// Reason why the model has no key of this name.
pub(super) fn reason_of_key(name: &str) -> Option<&'static str> {
    match name {
        "shaft_angle_deg" | "axis_angle_deg" | "crossing_angle_deg" => Some(
            "axes that cross are not in the model: they are parallel, but for the deviations of pair.axis_parallelism",
        ),
        "cone_angle_deg" | "pitch_angle_deg" | "reference_cone_angle_deg" => Some("bevel gears are not in the model"),
        "drive_pressure_angle_deg"
        | "coast_pressure_angle_deg"
        | "left_pressure_angle_deg"
        | "right_pressure_angle_deg" => Some(
            "asymmetric teeth are not in the model: write the angle of the flank that wears as pair.pressure_angle_deg",
        ),
        "planets" | "ring" | "sun" => Some(
            "planetary stages are not in the model as a whole: a scene is one pair, such as sun and planet, or planet and ring",
        ),
        _ => None,
    }
}

/// A key in units of inches and pounds: the key to give instead, and how the value is converted.
pub(super) struct Converted {
    /// Name of the key in units of the scene.
    pub name: String,
    /// Sentence that names the key, the value where it is a number, and the conversion.
    pub sentence: String,
}

/// Value given in inches or pounds, in the units of a scene.
pub(super) fn converted(name: &str, value: Option<f64>) -> Option<Converted> {
    let module = match name {
        "diametral_pitch" | "normal_diametral_pitch" | "DP" => Some("normal_module_mm"),
        "transverse_diametral_pitch" => Some("transverse_module_mm"),
        _ => None,
    };
    if let Some(module) = module {
        let module_mm = value.filter(|&pitch| pitch > 0.0).map(|pitch| 25.4 / pitch);
        let by = "module in mm = 25.4/diametral pitch (m = 25.4/DP)";
        return Some(Converted::new(module.to_owned(), module_mm, by));
    }
    let units = [
        (&["_in", "_inch", "_inches"][..], "_mm", 25.4, "1 in = 25.4 mm"),
        (
            &["_lbin", "_lbfin", "_lb_in", "_lbf_in", "_inlb", "_in_lb", "_in_lbf"][..],
            "_Nm",
            NEWTON_METRES_IN_POUND_INCH,
            "1 lbf·in = 0.112985 N·m",
        ),
        (
            &["_lbft", "_lbfft", "_lb_ft", "_lbf_ft", "_ftlb", "_ft_lb", "_ft_lbf"][..],
            "_Nm",
            12.0 * NEWTON_METRES_IN_POUND_INCH,
            "1 lbf·ft = 1.355818 N·m",
        ),
        (&["_psi"][..], "_MPa", 0.006_894_757, "1 psi = 0.00689476 MPa"),
        (&["_ksi"][..], "_MPa", 6.894_757, "1 ksi = 6.89476 MPa"),
        (&["_Mpsi", "_Msi"][..], "_GPa", 6.894_757, "10⁶ psi = 6.89476 GPa"),
    ];
    // The longest suffix counts: `_lb_in` is not a length.
    let endings =
        units.iter().flat_map(|(endings, unit, factor, by)| endings.iter().map(move |e| (*e, *unit, *factor, *by)));
    let (ending, unit, factor, by) =
        endings.filter(|(ending, ..)| name.ends_with(ending)).max_by_key(|(ending, ..)| ending.len())?;
    let target = format!("{}{unit}", &name[..name.len() - ending.len()]);
    Some(Converted::new(target, value.map(|value| factor * value), by))
}

impl Converted {
    fn new(name: String, in_scene: Option<f64>, by: &str) -> Self {
        let equals = in_scene.map(|x| format!(" = {}", number(six_digits(x)))).unwrap_or_default();
        let sentence = format!("write {name}{equals}: {by}");
        Self { name, sentence }
    }
}

/// Value with six significant digits.
fn six_digits(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// m = 25.4/DP; 1 in = 25.4 mm; 1 lbf·in = 4.4482216 N · 0.0254 m = 0.1129848 N·m (NIST SP 811, appendix B).
    #[test]
    fn ver_inches_and_pounds_are_converted() {
        for (name, value, key, in_scene) in [
            ("diametral_pitch", 8.0, "normal_module_mm", "3.175"),
            ("centre_distance_in", 3.5, "centre_distance_mm", "88.9"),
            ("pinion_torque_lbin", 635.0, "pinion_torque_Nm", "71.7454"),
            ("pinion_torque_lb_in", 635.0, "pinion_torque_Nm", "71.7454"),
            ("pinion_torque_lbft", 100.0, "pinion_torque_Nm", "135.582"),
            ("above_ksi", 290.0, "above_MPa", "1999.48"),
        ] {
            let found = converted(name, Some(value)).unwrap();
            assert_eq!(found.name, key);
            assert!(found.sentence.starts_with(&format!("write {key} = {in_scene}: ")), "{}", found.sentence);
        }
        assert!(converted("face_width_mm", Some(1.0)).is_none());
    }
}
