//! Profile shifts that a file leaves out, from what else it says of the pair.
//!
//! ```text
//! x1 + x2 = (inv α_wt − inv α_t) (z1 + z2) / (2 tan α_n)          cos α_wt = a_d cos α_t / a          without backlash
//! x1 − x2 = (d_a1 − d_1 − d_a2 + d_2) / (2 m_n)                   both tips of one basic rack, shortened alike
//! ```
//!
//! Source: ISO 21771, section 5.

use super::stage::{Figure, NormalSection};
use gearwear_bodies::gear::involute::inv;

/// No shift is greater.
const GREATEST: f64 = 3.0;

/// What is known of one gear.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub teeth: f64,
    pub tip_diameter_mm: Option<f64>,
}

/// Fills in the shifts that are missing and determined.
pub(super) fn complete(
    section: &NormalSection,
    centre_distance_mm: f64,
    known: [Known; 2],
    shifts: [Option<Figure>; 2],
) -> [Option<Figure>; 2] {
    let Some(sum) = sum(section, centre_distance_mm, known[0].teeth + known[1].teeth) else { return shifts };
    let derived = |value: f64, how: &str| {
        // Sums of inverse angles leave rounding where there is no shift.
        let value = (1e9 * value).round() / 1e9;
        (value.abs() <= GREATEST).then(|| Figure::derived(value, how))
    };
    const OF_MATE: &str = "from the centre distance and the other gear's, without backlash";
    const OF_TIPS: &str = "from the tip diameters and the centre distance, without backlash";
    match shifts {
        [Some(one), None] => {
            let other = derived(sum - one.value, OF_MATE);
            [Some(one), other]
        }
        [None, Some(other)] => [derived(sum - other.value, OF_MATE), Some(other)],
        [None, None] => {
            let above_mm = known.map(|gear| Some(gear.tip_diameter_mm? - section.reference_diameter_mm(gear.teeth)));
            let [Some(one_mm), Some(other_mm)] = above_mm else { return [None, None] };
            let difference = (one_mm - other_mm) / (2.0 * section.normal_module_mm);
            [derived(0.5 * (sum + difference), OF_TIPS), derived(0.5 * (sum - difference), OF_TIPS)]
        }
        both => both,
    }
}

/// x1 + x2 of a pair without backlash; None where no involutes meet. Centre distance and sum of teeth are negative with an internal wheel (DIN 3960).
pub(super) fn sum(section: &NormalSection, centre_distance_mm: f64, teeth: f64) -> Option<f64> {
    let transverse = section.transverse_pressure_angle_rad();
    let working_cos = 0.5 * section.reference_diameter_mm(teeth) * transverse.cos() / centre_distance_mm;
    let rise = inv((0.0..1.0).contains(&working_cos).then_some(working_cos)?.acos()) - inv(transverse);
    Some(rise * teeth / (2.0 * section.pressure_angle_deg.to_radians().tan()))
}
