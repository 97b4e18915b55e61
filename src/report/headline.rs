//! The first words of a run, alike in the terminal and on the page: what is known of the wear coefficient, and what to do about tip edges
//! that carry load.

use gearwear_physics::results::run::Summary;

/// Scatter of the wear coefficient between repeated twin-disc and gear tests under the same conditions, relative: from and to.
const SCATTER_OF_COEFFICIENT: [f64; 2] = [0.4, 0.6];
/// Least load of a tip edge over the line load that asks for a relief. With enough relief a contact still grazes the edge where it begins.
const LEAST_TIP_LOAD: f64 = 0.05;
/// Contact ratio from which more than one pair is always in contact: then the transmission error is not that of one pair.
const ALWAYS_TWO_PAIRS: f64 = 2.0;

/// The scatter in per cent: "40–60".
pub fn scatter_percent() -> String {
    let [from, to] = SCATTER_OF_COEFFICIENT.map(|part| format!("{:.0}", 100.0 * part));
    format!("{from}–{to}")
}

/// How much tip edges carry, and the tip relief that keeps them apart; none where they carry next to nothing.
///
/// A pair that comes to A while the others carry the whole load finds its flanks overlapping by the transmission error, which is greatest
/// where one pair is alone: tips relieved by that touch nothing before A and after E.
pub fn tip_edges(summary: &Summary) -> Option<String> {
    let (new, worn) = (&summary.new, &summary.worn);
    if new.tip_edge_line_load_N_per_mm < LEAST_TIP_LOAD * summary.contact.line_load_N_per_mm {
        return None;
    }
    let carried = format!(
        "The tip edges carry up to {:.0} N/mm new and {:.0} N/mm worn, as a mean over 0.04 mm under {:.0} and {:.0} MPa.",
        new.tip_edge_line_load_N_per_mm,
        worn.tip_edge_line_load_N_per_mm,
        new.tip_edge_mean_pressure_MPa,
        worn.tip_edge_mean_pressure_MPa
    );
    let alone = summary.helical.is_none() && summary.geometry.transverse_contact_ratio < ALWAYS_TWO_PAIRS;
    let remedy = if alone {
        let least_um = new.transmission_error_um.max.ceil();
        format!("A tip relief of {least_um:.0} µm or more on both gears keeps them out of contact at this torque.")
    } else {
        "Tip relief on both gears takes it off them.".to_owned()
    };
    Some(format!("{carried} {remedy}"))
}
