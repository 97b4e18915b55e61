//! The unit of a quantity, which its name ends in, in an engineer's words.

use gearwear_physics::results::figures;

/// What the ends of names say of units, the longer before those that they end with.
const UNITS: [(&str, &str); 19] = [
    ("_um_per_Mrev", "µm per million revolutions"),
    ("_mm3_per_Nm", "mm³/(N·m)"),
    ("_m2_per_N", "m²/N"),
    ("_N_per_mm_um", "N/(mm·µm)"),
    ("_MPa_per_mm", "MPa/mm"),
    ("_N_per_mm", "N/mm"),
    ("_mm_per_mesh", "mm"),
    ("_mm3", "mm³"),
    ("_mm", "mm"),
    ("_um", "µm"),
    ("_mg", "mg"),
    ("_MPa", "MPa"),
    ("_Nm", "N·m"),
    ("_deg", "°"),
    ("_rpm", "1/min"),
    ("_K", "K"),
    ("_C", "°C"),
    ("_s", "s"),
    ("hours", "h"),
];

/// The unit of a main figure, or the one that a name ends with, also before `_new` and `_worn`.
pub fn of(name: &str) -> Option<&'static str> {
    if let Some(figure) = figures::find(name) {
        return Some(figure.unit()).filter(|unit| !unit.is_empty());
    }
    let name = name.strip_suffix("_new").or(name.strip_suffix("_worn")).unwrap_or(name);
    UNITS.into_iter().find(|(end, _)| name.ends_with(end)).map(|(_, unit)| unit)
}

#[cfg(test)]
mod tests {
    use super::of;

    #[test]
    fn units_are_read_from_names() {
        for (name, unit) in [
            ("peak_pressure_new_MPa", Some("MPa")),
            ("transmission_error_new_um", Some("µm")),
            ("hertz_half_width_mm", Some("mm")),
            ("coefficient_mm3_per_Nm", Some("mm³/(N·m)")),
            ("pair_at_pitch_N_per_mm_um", Some("N/(mm·µm)")),
            ("sliding_mm_per_mesh", Some("mm")),
            ("mesh_orders_new_um", Some("µm")),
            ("half_width_worn_mm", Some("mm")),
            ("hours", Some("h")),
            ("worn.transmission_error_um.peak_to_peak", Some("µm")),
            ("geometry.overlap_ratio", None),
            ("load_share_new", None),
            ("C", None),
        ] {
            assert_eq!(of(name), unit, "{name}");
        }
    }
}
