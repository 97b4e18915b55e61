//! The main figures of a run, as a table for the terminal.

use crate::report::headline;
use crate::results::error::{ErrorPerGear, ErrorSummary, TotalError, WearAtLimit};
use crate::results::run::{HelicalSummary, OverWidthSummary, Summary, WearSummary};

pub(super) fn table(summary: &Summary) -> String {
    let (new, worn) = (&summary.new, &summary.worn);
    let mut text = [headline(summary), details(summary)].concat();
    let sharp = [new.sharp_edge_pressure_MPa, worn.sharp_edge_pressure_MPa];
    if sharp.iter().any(Option::is_some) {
        let [new, worn] = sharp.map(|pressure| pressure.map_or_else(|| "–".to_owned(), digits));
        text.push_str(&row("at sharp tip edges (not defined), MPa", [&new, &worn]));
    }
    text.push_str(&over_the_width(summary.helical.as_ref()));
    text.push_str(&verified(&summary.error.total));
    text.push_str(&estimated_errors(&summary.error));
    text.push_str(&at_other_limits(&summary.error));
    if let Some(balance) = summary.error.volume_balance {
        text.push_str(&format!("\n  worn volumes of pinion and wheel differ by {} %\n", two_digits(100.0 * balance)));
    }
    let hours = summary.hours.map_or_else(String::new, |hours| format!(" ({} h)", digits(hours)));
    let run = format!("{} pinion revolutions{hours}", digits(summary.revolutions));
    if let Some(life) = &summary.life {
        text.push_str(&format!("\n{}\n", life.in_words(&run)));
    }
    text.push_str(&format!("\n{run}, computed in {:.2} s\n", summary.wall_s));
    text
}

/// What is asked first: wear and how far it is known, flank pressure, transmission error, and what to do about the tip edges.
fn headline(summary: &Summary) -> String {
    let (new, worn, total) = (&summary.new, &summary.worn, &summary.error.total);
    let scatter = format!("± {}", headline::scatter_percent());
    let scatters = |wear: &WearSummary| if wear.peak_wear_um > 0.0 { scatter.as_str() } else { "–" };
    let off =
        |error: Option<f64>| error.map_or_else(|| "–".to_owned(), |error| format!("± {}", two_digits(100.0 * error)));
    let errors = |name, [one, other]: [Option<f64>; 2]| row(name, [&off(one), &off(other)]);
    let te = [&new.transmission_error_um, &worn.transmission_error_um].map(|te| te.peak_to_peak);
    let is_verified = total.peak_wear.pinion.or(total.peak_wear.wheel).is_some();
    let of_computation = "  error of the computation, %";
    let mut text = [
        format!("{}\n\n{}", summary.title, row("", ["pinion", "wheel"])),
        figures("maximum wear, µm", [summary.pinion.peak_wear_um, summary.wheel.peak_wear_um]),
        row("  scatter of k in repeated tests, %", [scatters(&summary.pinion), scatters(&summary.wheel)]),
    ]
    .concat();
    if is_verified {
        text.push_str(&errors(of_computation, [total.peak_wear.pinion, total.peak_wear.wheel]));
    }
    text.push_str(&row("", ["new", "worn"]));
    text.push_str(&figures("flank pressure, MPa", [new.flank_pressure_MPa, worn.flank_pressure_MPa]));
    if is_verified {
        text.push_str(&errors(of_computation, [total.flank_pressure.new, total.flank_pressure.worn]));
    }
    text.push_str(&figures("transmission error, peak to peak, µm", te));
    if is_verified {
        text.push_str(&errors(of_computation, [None, total.transmission_error_peak_to_peak]));
    }
    if let Some(tips) = headline::tip_edges(summary) {
        text.push_str(&format!("\n  {}\n", tips.replacen(". ", ".\n  ", 1)));
    }
    text
}

/// More of the wear of both flanks.
fn details(summary: &Summary) -> String {
    let (pinion, wheel) = (&summary.pinion, &summary.wheel);
    [
        format!("\n{}", row("", ["pinion", "wheel"])),
        figures("radius of the maximum wear, mm", [pinion.peak_wear_radius_mm, wheel.peak_wear_radius_mm]),
        figures("wear of the tip edge, µm", [pinion.tip_edge_wear_um, wheel.tip_edge_wear_um]),
        figures("wear below the active profile, µm", [pinion.below_sap_wear_um, wheel.below_sap_wear_um]),
        figures("wear of the root zone, µm", [pinion.root_wear_um, wheel.root_wear_um]),
        figures("wear at the pitch circle, µm", [pinion.pitch_wear_um, wheel.pitch_wear_um]),
        figures("worn mass, mg", [pinion.worn_mass_mg, wheel.worn_mass_mg]),
        row("", ["new", "worn"]),
        figures("pressure at the pitch point, MPa", [summary.new.pitch_pressure_MPa, summary.worn.pitch_pressure_MPa]),
    ]
    .concat()
}

/// What the slices tell; nothing where all sections are alike.
fn over_the_width(helical: Option<&HelicalSummary>) -> String {
    let Some(helical) = helical else { return String::new() };
    let per_cent =
        |of: fn(&OverWidthSummary) -> f64| [&helical.wear.pinion, &helical.wear.wheel].map(|w| 100.0 * of(w));
    let orders = [&helical.mesh_orders_new_um, &helical.mesh_orders_worn_um];
    [
        figures("face load factor K_Hbeta", [helical.K_Hbeta_new, helical.K_Hbeta_worn]),
        figures("first mesh order, µm", orders.map(|orders| orders.first().copied().unwrap_or_default())),
        row("over the face width", ["pinion", "wheel"]),
        figures("variation of root wear, %", per_cent(|w| w.root_variation)),
        figures("variation of tip wear, %", per_cent(|w| w.tip_variation)),
        figures("variation of both together, %", per_cent(|w| w.root_tip_variation)),
    ]
    .concat()
}

/// How far the run is from finite elements, or why that is not known.
fn verified(total: &TotalError) -> String {
    let within = |error: Option<f64>| error.map_or_else(|| "–".to_owned(), |error| two_digits(100.0 * error));
    let both = |name, errors: &ErrorPerGear| row(name, [&within(errors.pinion), &within(errors.wheel)]);
    let one = |name, error| format!("  {name:38}{:>12}\n", within(error));
    if total.peak_wear.pinion.or(total.peak_wear.wheel).is_none() {
        return format!("\n  {}\n", total.how);
    }
    [
        row("difference from finite elements", ["pinion", "wheel"]),
        both("wear of the tip edge, %", &total.tip_edge_wear),
        both("wear over the flank (rms), %", &total.profile),
        one("pressure between the tip edges (rms), %", total.pressure_between_tips),
    ]
    .concat()
}

/// The error estimates of the maximum wear; nothing where none was made.
fn estimated_errors(error: &ErrorSummary) -> String {
    let parts: Vec<String> = [
        ("points and positions", error.discretisation),
        ("wear step", error.wear_step),
        ("contact surface", error.surface_model),
        ("abrupt against smoothed transition", error.severe_switch),
    ]
    .into_iter()
    .filter_map(|(name, estimate)| Some(format!("{name} {} %", two_digits(100.0 * estimate?))))
    .collect();
    if parts.is_empty() {
        return String::new();
    }
    format!("\n  estimated error of the maximum wear: {}\n", parts.join(", "))
}

/// The maximum wear with limits of severe wear a tenth lower and higher; nothing where it is not known.
fn at_other_limits(error: &ErrorSummary) -> String {
    let Some(limit) = &error.severe_limit else { return String::new() };
    let peaks = |at: &WearAtLimit| [at.pinion.peak_wear_um, at.wheel.peak_wear_um];
    [
        format!("\n{}", row("maximum wear, µm, with", ["pinion", "wheel"])),
        figures("a limit of severe wear 10 % lower", peaks(&limit.low)),
        figures("a limit of severe wear 10 % higher", peaks(&limit.high)),
    ]
    .concat()
}

/// An estimate with two significant digits: more it does not have.
pub(super) fn two_digits(value: f64) -> String {
    let magnitude = value.abs();
    let decimals = if magnitude > 0.0 { (1 - magnitude.log10().floor() as i32).clamp(0, 4) as usize } else { 0 };
    format!("{value:.decimals$}")
}

fn figures(name: &str, values: [f64; 2]) -> String {
    let [one, other] = values.map(digits);
    row(name, [&one, &other])
}

/// A line of the table: a name and two values.
pub(super) fn row(name: &str, values: [&str; 2]) -> String {
    format!("  {name:38}{:>12}{:>12}\n", values[0], values[1])
}

/// A figure with four significant digits, or all digits of a large whole one.
pub(super) fn digits(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-3..1e9).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let decimals = if magnitude == 0.0 { 0 } else { (3 - magnitude.log10().floor() as i32).max(0) as usize };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_have_two_digits() {
        assert_eq!([0.0, 0.0557, 0.3154, 6.975, 69.75].map(two_digits), ["0", "0.056", "0.32", "7.0", "70"]);
    }

    #[test]
    fn figures_have_four_digits() {
        let values = [0.0, 12.345_67, 1656.4, 1_149_750.0, 0.012_344, 1.234e-7];
        assert_eq!(values.map(digits), ["0", "12.35", "1656", "1149750", "0.01234", "1.234e-7"]);
    }
}
