//! Tolerances of flanks from the tolerance class of a drawing.
//!
//! Slopes of profile and helix, in µm, of a gear of reference diameter d, normal module m_n and face width b in mm, class A from 1 to 11:
//!
//! ```text
//! f_HαT = (0.4 m_n + 0.001 d + 4) (√2)^(A − 5)
//! f_HβT = (0.05 √d + 0.35 √b + 4) (√2)^(A − 5)
//! ```
//!
//! rounded to whole µm above 10 µm, to 0.5 µm from 5 µm on, and to 0.1 µm below.
//!
//! Source: ISO 1328-1:2013, profile and helix slope tolerances, and its rules of rounding.

/// Range of reference diameters of the standard, mm.
pub const DIAMETERS_MM: [f64; 2] = [5.0, 15_000.0];
/// Range of face widths of the standard, mm.
pub const WIDTHS_MM: [f64; 2] = [4.0, 1200.0];

/// Classes of the standard.
pub const CLASSES: std::ops::RangeInclusive<u32> = 1..=11;
/// Class that the formulae are written for.
pub const CLASS_OF_FORMULAE: f64 = 5.0;

/// f_HαT of class 5, not rounded, µm.
pub fn profile_slope_of_class_5_um(normal_module_mm: f64, reference_diameter_mm: f64) -> f64 {
    0.4 * normal_module_mm + 0.001 * reference_diameter_mm + 4.0
}

/// f_HβT of class 5, not rounded, µm.
pub fn helix_slope_of_class_5_um(reference_diameter_mm: f64, face_width_mm: f64) -> f64 {
    0.05 * reference_diameter_mm.sqrt() + 0.35 * face_width_mm.sqrt() + 4.0
}

/// Tolerance of a class that is `of_class_5_um` in class 5, rounded, µm.
pub fn of_class_um(class: u32, of_class_5_um: f64) -> f64 {
    rounded_um(of_class_5_um * 2.0_f64.powf(0.5 * (f64::from(class) - CLASS_OF_FORMULAE)))
}

/// Helix slope tolerance f_HβT, µm.
pub fn helix_slope_um(class: u32, reference_diameter_mm: f64, face_width_mm: f64) -> f64 {
    of_class_um(class, helix_slope_of_class_5_um(reference_diameter_mm, face_width_mm))
}

/// Profile slope tolerance f_HαT, µm.
pub fn profile_slope_um(class: u32, normal_module_mm: f64, reference_diameter_mm: f64) -> f64 {
    of_class_um(class, profile_slope_of_class_5_um(normal_module_mm, reference_diameter_mm))
}

fn rounded_um(tolerance_um: f64) -> f64 {
    let steps_in_um = match tolerance_um {
        tolerance_um if tolerance_um > 10.0 => 1.0,
        tolerance_um if tolerance_um >= 5.0 => 2.0,
        _ => 10.0,
    };
    (tolerance_um * steps_in_um).round() / steps_in_um
}

#[cfg(test)]
mod tests {
    use super::*;

    /// d = 100 mm, b = 16 mm: 0.5 + 1.4 + 4 = 5.9 µm in class 5, twice that two classes on, half of it two before. d = 400 mm, b = 100 mm:
    /// 1 + 3.5 + 4 = 8.5 µm in class 5.
    #[test]
    fn val_helix_slope_is_the_formula_of_the_standard() {
        for (class, d, b, expected) in [
            (5, 100.0, 16.0, 6.0),
            (7, 100.0, 16.0, 12.0),
            (3, 100.0, 16.0, 3.0),
            (1, 100.0, 16.0, 1.5),
            (5, 400.0, 100.0, 8.5),
            (6, 400.0, 100.0, 12.0),
            (11, 400.0, 100.0, 68.0),
        ] {
            assert_eq!(helix_slope_um(class, d, b), expected, "class {class}, d = {d}, b = {b}");
        }
    }

    /// m_n = 3 mm, d = 100 mm: 1.2 + 0.1 + 4 = 5.3 µm in class 5, twice that in class 7.
    #[test]
    fn val_profile_slope_is_the_formula_of_the_standard() {
        for (class, expected) in [(5, 5.5), (7, 11.0), (3, 2.7)] {
            assert_eq!(profile_slope_um(class, 3.0, 100.0), expected, "class {class}");
        }
    }

    #[test]
    fn rounding_is_finer_for_small_tolerances() {
        for (exact, rounded) in
            [(10.4, 10.0), (10.6, 11.0), (9.8, 10.0), (9.7, 9.5), (5.2, 5.0), (4.96, 5.0), (1.475, 1.5)]
        {
            assert_eq!(rounded_um(exact), rounded, "{exact}");
        }
    }
}
