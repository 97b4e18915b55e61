//! Elastic limit of the pressure of a line contact of steel.
//!
//! ```text
//! first yield       p_0 = 1.67 Y        (below the surface, plane strain, von Mises)
//! fully plastic     p_m ≈ 2.8 Y ≈ H
//! ```
//!
//! p_0 maximum pressure, p_m mean pressure, Y yield stress, H hardness, MPa. Source: K. L. Johnson, *Contact Mechanics*, 1985, sections 6.1
//! to 6.3. Steel of 300 HV has H = 2940 MPa, which is rounded to 3000 MPa here; case-hardened steel of 700 HV (Y ≈ 2450 MPa) begins to
//! yield at some 4100 MPa. Pressures of contact models above are those of a material that stays elastic.

/// Fully plastic pressure of steel of 300 HV, MPa.
pub(crate) const FLOW_PRESSURE_MPA: f64 = 3000.0;

/// Explanation of the warning.
const REASON: &str = "steel of 300 HV flows at some 3000 MPa, and case-hardened steel of 700 HV begins to yield at some 4100 MPa: above, \
                      the pressure is that of a material which stays elastic";

/// Whether a pressure exceeds the elastic limit of most steels.
pub fn is_exceeded(pressure_mpa: f64) -> bool {
    pressure_mpa > FLOW_PRESSURE_MPA
}

/// Warning for a pressure above the limit, with its place; `None` below.
pub fn warning(pressure_mpa: f64, place: &str) -> Option<String> {
    is_exceeded(pressure_mpa).then(|| {
        format!("the maximum pressure, {pressure_mpa:.0} MPa ({place}), is above the hardness of steel: {REASON}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 300 HV = 300 kgf/mm² = 300 · 9.80665 MPa = 2942 MPa.
    #[test]
    fn ver_the_limit_is_the_hardness_of_steel_of_300_hv() {
        assert!((FLOW_PRESSURE_MPA / (300.0 * 9.806_65) - 1.0).abs() < 0.02);
    }

    #[test]
    fn only_pressures_above_the_limit_are_warned_of() {
        assert_eq!(warning(2999.0, "new"), None);
        let text = warning(3251.4, "worn, close to A").unwrap();
        assert!(text.contains("3251 MPa (worn, close to A)"), "{text}");
    }
}
