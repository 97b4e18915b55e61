//! The main figures of a run, as a table for the terminal.

use gearwear::report::headline;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::error::{ErrorPerGear, ErrorSummary, TotalError};
use gearwear_physics::results::figures::{FAMILIES, FigureFamily, FigureValues};
use gearwear_physics::results::run::Summary;

/// Room for the name of a row.
const NAME: usize = 44;

pub(super) fn table(summary: &Summary) -> String {
    let mut text = [
        headline(summary),
        details(summary),
        over_the_width(summary),
        films(summary),
        verified(&summary.error.total),
        estimated_errors(&summary.error),
        at_other_limits(&summary.error),
    ]
    .concat();
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

/// The two groups of figures, with the names of their columns.
const GROUPS: [[&str; 2]; 2] = [["pinion", "wheel"], ["new", "worn"]];

/// Families of a group that the terminal shows: of the gears, or of new and worn flanks.
fn shown([first, _]: [&str; 2]) -> impl Iterator<Item = &'static FigureFamily> {
    FAMILIES.iter().filter(move |family| {
        family.in_terminal
            && match family.values {
                FigureValues::Gears(_) => first == "pinion",
                FigureValues::States(_) => first == "new",
                FigureValues::Pair(_) => false,
            }
    })
}

/// Rows of some families, without those that the run has no values of.
fn rows(families: impl Iterator<Item = &'static FigureFamily>, summary: &Summary) -> String {
    let known = families.filter(|family| family.both(summary).iter().any(Option::is_some));
    known.map(|family| family_row(family, family.both(summary))).collect()
}

/// Row of a family; ratios of the gears in per cent.
fn family_row(family: &FigureFamily, values: [Option<f64>; 2]) -> String {
    let is_share = family.unit.is_empty() && matches!(family.values, FigureValues::Gears(_));
    let (unit, factor) = if is_share { ("%", 100.0) } else { (family.unit, 1.0) };
    let comma = if unit.is_empty() { "" } else { ", " };
    let [one, other] = values.map(|value| value.map_or_else(|| "–".to_owned(), |value| digits(factor * value)));
    main_row(&format!("{}{comma}{unit}", family.row()), [&one, &other])
}

/// First lines: wear and its uncertainty, flank pressure, transmission error, and advice on the tip edges.
fn headline(summary: &Summary) -> String {
    let total = &summary.error.total;
    let is_verified = total.peak_wear.pinion.or(total.peak_wear.wheel).is_some();
    let mut text = format!("{}\n\n", summary.title);
    for columns in GROUPS {
        text.push_str(&main_row("", columns));
        for family in shown(columns).filter(|family| family.in_headline) {
            let values = family.both(summary);
            text.push_str(&family_row(family, values));
            if matches!(family.values, FigureValues::Gears(_)) {
                text.push_str(&scatter(values));
            }
            if is_verified {
                text.push_str(&errors_of_computation(family.both_errors(total)));
            }
        }
    }
    if let Some(tips) = headline::tip_edges(summary) {
        text.push_str(&format!("\n  {}\n", tips.replacen(". ", ".\n  ", 1)));
    }
    text
}

/// Scatter of the wear coefficient where there is wear.
fn scatter(wear_um: [Option<f64>; 2]) -> String {
    let [one, other] = wear_um.map(|wear_um| match wear_um {
        Some(wear_um) if wear_um > 0.0 => format!("± {}", headline::scatter_percent()),
        _ => "–".to_owned(),
    });
    main_row("  scatter of k in repeated tests, %", [&one, &other])
}

fn errors_of_computation(errors: [Option<f64>; 2]) -> String {
    let [one, other] =
        errors.map(|error| error.map_or_else(|| "–".to_owned(), |error| format!("± {}", two_digits(100.0 * error))));
    main_row("  error of the computation, %", [&one, &other])
}

/// Other figures of both flanks and of the mesh.
fn details(summary: &Summary) -> String {
    let groups = GROUPS.map(|columns| {
        let families = shown(columns).filter(|family| !family.in_headline && !family.is_of_slices());
        format!("{}{}", main_row("", columns), rows(families, summary))
    });
    format!("\n{}", groups.concat())
}

/// Variation over the face width; nothing where all sections are alike.
fn over_the_width(summary: &Summary) -> String {
    if summary.helical.is_none() {
        return String::new();
    }
    let [gears, states] = GROUPS.map(|columns| rows(shown(columns).filter(|family| family.is_of_slices()), summary));
    format!("{states}{}{gears}", main_row("over the face width", GROUPS[0]))
}

/// Films, friction and losses; nothing without oil.
fn films(summary: &Summary) -> String {
    let Some(of) = &summary.lubrication else { return String::new() };
    let mut text = main_row("films and losses", GROUPS[1]);
    if let Some(film) = &of.film {
        text.push_str(&figures("minimum of λ (film over mean roughness)", [film.lambda_new.min, film.lambda_worn.min]));
        if let (Some(new), Some(worn)) = (film.wear_factor_new, film.wear_factor_worn) {
            for gear in Gear::BOTH {
                let name = format!("factor of the film on k of the {}", gear.name());
                text.push_str(&figures(&name, [new[gear], worn[gear]]));
            }
        }
    }
    let (friction, losses) = (&of.friction, &of.losses);
    text.push_str(&figures("mean coefficient of friction", [friction.mean_new, friction.mean_worn]));
    text.push_str(&figures("mesh power loss, W", [losses.mesh_power_loss_new_W, losses.mesh_power_loss_worn_W]));
    let efficiency = [losses.efficiency_new, losses.efficiency_worn];
    text.push_str(&figures("efficiency of the mesh, %", efficiency.map(|share| 100.0 * share)));
    text
}

/// Difference of the run from finite elements, or why it is not known.
fn verified(total: &TotalError) -> String {
    if total.peak_wear.pinion.or(total.peak_wear.wheel).is_none() {
        return format!("\n  {}\n", total.how);
    }
    [
        main_row("difference from finite elements", ["pinion", "wheel"]),
        of_both_gears("wear of the tip edge, %", &total.tip_edge_wear),
        of_both_gears("wear over the flank (rms), %", &total.profile),
        main_row("pressure between the tip edges (rms), %", [&in_percent(total.pressure_between_tips), ""]),
    ]
    .concat()
}

fn of_both_gears(name: &str, errors: &ErrorPerGear) -> String {
    main_row(name, [&in_percent(errors.pinion), &in_percent(errors.wheel)])
}

fn in_percent(error: Option<f64>) -> String {
    error.map_or_else(|| "–".to_owned(), |error| two_digits(100.0 * error))
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
    let [low, high] = [&limit.low, &limit.high].map(|at| [at.pinion.peak_wear_um, at.wheel.peak_wear_um]);
    [
        format!("\n{}", main_row("maximum wear, µm, with", ["pinion", "wheel"])),
        figures("a limit of severe wear 10 % lower", low),
        figures("a limit of severe wear 10 % higher", high),
    ]
    .concat()
}

/// Estimate with two significant digits.
pub(super) fn two_digits(value: f64) -> String {
    let magnitude = value.abs();
    let decimals = if magnitude > 0.0 { (1 - magnitude.log10().floor() as i32).clamp(0, 4) as usize } else { 0 };
    format!("{value:.decimals$}")
}

fn figures(name: &str, values: [f64; 2]) -> String {
    let [one, other] = values.map(digits);
    main_row(name, [&one, &other])
}

/// Line of the run's table: a name and two values.
fn main_row(name: &str, values: [&str; 2]) -> String {
    format!("{}\n", format!("  {name:NAME$}{:>12}{:>12}", values[0], values[1]).trim_end())
}

/// Line of other commands' tables: a shorter name and two values.
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

/// A figure, or a dash where there is none.
pub(super) fn or_dash(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), digits)
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
