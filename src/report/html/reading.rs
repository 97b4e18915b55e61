//! Words for places and moments: the sentences that say what the numbers mean.

use super::number::{change, figure, hours, percent, revolutions, significant};
use crate::report::headline;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::steel_yield;
use gearwear_physics::results::path_points::among;
use gearwear_physics::results::run::{FlankRecord, MeshCycleRow, RunRecord, StopReason, Summary, WearSummary};

/// The greatest of some values and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    pub index: usize,
    pub value: f64,
}

/// The first of the greatest finite values.
pub fn greatest(values: &[f64]) -> Option<Extreme> {
    values.iter().enumerate().filter(|(_, v)| v.is_finite()).fold(None, |best, (index, &value)| match best {
        Some(Extreme { value: most, .. }) if value <= most => best,
        _ => Some(Extreme { index, value }),
    })
}

/// "at 34.12 mm radius, close to A", "at 37.40 mm radius, between C and D".
pub fn place_on_flank(flank: &FlankRecord, radius_mm: f64) -> String {
    format!("at {} mm radius, {}", significant(radius_mm, 4), among(&flank.path_point_radius_mm.named(), radius_mm))
}

/// What to say of a pressure that is greatest at A or E, where one flank ends in its tip edge; empty elsewhere.
pub fn tip_edge_note(places: &[(&str, f64)], at: f64) -> &'static str {
    match among(places, at).as_str() {
        "close to A" | "close to E" | "outside the active flank" => {
            " This is at a tip edge, where the maximum at a point depends on the resolution; pairs are compared by the flank pressure."
        }
        _ => "",
    }
}

/// What to say of a pressure that steel hardly bears elastically; empty below. The warning says when steel flows.
pub fn yield_note(pressure_mpa: f64) -> &'static str {
    if steel_yield::is_exceeded(pressure_mpa) {
        " Steel of 300 HV would flow: the pressure is that of a material which stays elastic."
    } else {
        ""
    }
}

/// "127.75 h (1.15 million pinion revolutions)".
pub fn duration(summary: &Summary) -> String {
    let turns = format!("{} pinion revolutions", revolutions(summary.revolutions));
    match summary.hours {
        Some(time) => format!("{} h ({turns})", hours(time)),
        None => turns,
    }
}

/// The run in three sentences: how much each gear has lost, where, how well that is known, and what it did to pressure and transmission error.
pub fn answer(record: &RunRecord) -> String {
    let s = &record.summary;
    let lost = match (s.pinion.peak_wear_um > 0.0, s.wheel.peak_wear_um > 0.0) {
        (false, false) => "neither flank has worn".into(),
        (true, false) => format!("the pinion has lost {}; the wheel has not worn", depth(record, Gear::Pinion)),
        (false, true) => format!("the wheel has lost {}; the pinion has not worn", depth(record, Gear::Wheel)),
        (true, true) => {
            format!("the pinion has lost {}, and the wheel {}", depth(record, Gear::Pinion), depth(record, Gear::Wheel))
        }
    };
    let life = s.life.as_ref().map_or_else(String::new, |life| format!("{} ", life.in_words(&duration(s))));
    let mut text = format!("{life}After {} {lost}.{}", duration(s), how_well_known(s));
    if record.history.is_empty() {
        return text;
    }
    let total = &s.error.total;
    let with_error = |value: f64, off: Option<f64>| within(figure(value), value, off);
    text.push_str(&format!(
        " The flank pressure went from {} to {} MPa ({}); the transmission error peak to peak from {} to {} µm.",
        with_error(s.new.flank_pressure_MPa, total.flank_pressure.new),
        with_error(s.worn.flank_pressure_MPa, total.flank_pressure.worn),
        change(s.new.flank_pressure_MPa, s.worn.flank_pressure_MPa),
        with_error(s.new.transmission_error_um.peak_to_peak, total.transmission_error_peak_to_peak_new),
        with_error(s.worn.transmission_error_um.peak_to_peak, total.transmission_error_peak_to_peak),
    ));
    text
}

/// What follows from the figures: about the load of tip edges, steel that would flow, and wear over the face width.
pub fn remarks(record: &RunRecord) -> String {
    let s = &record.summary;
    let mut text = headline::tip_edges(s).unwrap_or_default();
    text.push_str(yield_note(s.new.flank_pressure_MPa.max(s.worn.flank_pressure_MPa)));
    if let Some(helical) = &s.helical {
        let wear = &helical.wear.pinion;
        text.push_str(&format!(
            " Over the face width the pinion’s root wear varies by {} of its mean and its tip wear by {}; the face load factor \
             went from {} to {}.",
            percent(wear.root_variation),
            percent(wear.tip_variation),
            figure(helical.K_Hbeta_new),
            figure(helical.K_Hbeta_worn),
        ));
    }
    text
}

/// The pressure of each row, and NaN where it is that of a sharp tip edge, which is not defined.
pub fn defined_pressures(rows: &[MeshCycleRow], of: fn(&MeshCycleRow) -> (f64, bool)) -> Vec<f64> {
    rows.iter().map(of).map(|(pressure, at_sharp_edge)| defined_pressure(pressure, at_sharp_edge)).collect()
}

fn defined_pressure(pressure_mpa: f64, at_sharp_edge: bool) -> f64 {
    if at_sharp_edge { f64::NAN } else { pressure_mpa }
}

/// How far the wear is known: by its coefficient first, then by the computation.
fn how_well_known(s: &Summary) -> String {
    let wear = &s.error.total.peak_wear;
    let errors: Vec<String> = [("pinion", wear.pinion), ("wheel", wear.wheel)]
        .into_iter()
        .filter_map(|(gear, error)| Some(format!("± {} % ({gear})", significant(100.0 * error?, 2))))
        .collect();
    let wears = s.pinion.peak_wear_um.max(s.wheel.peak_wear_um) > 0.0;
    let mut text = String::new();
    if wears {
        text.push_str(&format!(
            " In repeated tests the wear coefficient scatters by ± {} %, and wear with it",
            headline::scatter_percent()
        ));
        text.push_str(&match errors.as_slice() {
            [] => ".".to_owned(),
            errors => format!("; the error of the computation is {}, against finite elements.", errors.join(" and ")),
        });
    }
    text
}

/// The wear of one gear.
pub fn gear_wear(summary: &Summary, gear: Gear) -> &WearSummary {
    match gear {
        Gear::Pinion => &summary.pinion,
        Gear::Wheel => &summary.wheel,
    }
}

fn depth(record: &RunRecord, gear: Gear) -> String {
    let (wear, flank) = (gear_wear(&record.summary, gear), &record.flanks[gear]);
    format!(
        "up to {} µm of its active profile {}",
        significant(wear.peak_wear_um, 3),
        place_on_flank(flank, wear.peak_wear_radius_mm)
    )
}

/// A figure with its error in one digit, where that is known.
fn within(figure: String, value: f64, relative: Option<f64>) -> String {
    match relative.map(|relative| relative * value).filter(|error| *error > 0.0) {
        Some(error) => {
            let place = 10f64.powf(error.log10().floor());
            format!("{figure} ± {}", significant((error / place).round() * place, 1))
        }
        None => figure,
    }
}

/// What to say above everything else where the run did not reach its end.
pub fn interruption(summary: &Summary) -> Option<String> {
    let how = match summary.stopped {
        StopReason::Completed | StopReason::LimitReached => return None,
        StopReason::Interrupted => "was interrupted",
        StopReason::NotConverged => "did not converge; its last state kept is that",
        StopReason::WornThrough => "ended with a tooth worn through; its last state kept is that",
    };
    Some(format!(
        "The run {how} after {}. What was finished until then is shown; it is not the whole duration asked for.",
        duration(summary)
    ))
}

/// The text with every number bound to the unit and to the ± after it, so that no line ends between them.
pub fn bound(text: &str) -> String {
    const UNITS: [&str; 9] = ["µm", "mm", "mm³", "MPa", "h", "%", "K", "°C", "N/mm"];
    let mut bound = String::with_capacity(text.len());
    for word in text.split_inclusive(' ') {
        let unit = word.trim_end_matches([' ', ',', '.', ';', ':']);
        let after_number = bound.ends_with(' ') && bound.trim_end().ends_with(|c: char| c.is_ascii_digit());
        if after_number && (UNITS.contains(&unit) || unit == "±") || bound.ends_with("± ") {
            bound.pop();
            bound.push('\u{a0}');
        }
        bound.push_str(word);
    }
    bound.replace("\u{2009}×\u{2009}", "\u{202f}×\u{202f}")
}

pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greatest_passes_over_what_is_not_a_number() {
        assert_eq!(greatest(&[f64::NAN, 1.0, 3.0, 3.0]), Some(Extreme { index: 2, value: 3.0 }));
        assert_eq!(greatest(&[]), None);
        assert_eq!(greatest(&[f64::NAN]), None);
    }

    #[test]
    fn numbers_hold_on_to_their_units() {
        assert_eq!(
            bound("up to 1.65 ± 0.2 µm at 34 mm, or more mm. ± is"),
            "up to 1.65\u{a0}±\u{a0}0.2\u{a0}µm at 34\u{a0}mm, or more mm. ±\u{a0}is"
        );
    }
}
