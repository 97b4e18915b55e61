//! The table of a run's phases; none where there is only one.

use super::number::{figure, significant};
use crate::results::run::{PhaseSummary, Summary};

/// Phases that are shown one by one.
const MOST_SHOWN: usize = 60;

/// The table: under what each phase ran, and what it wore off.
pub fn table(s: &Summary) -> String {
    if s.phases.len() < 2 {
        return String::new();
    }
    let heads = [
        "hours",
        "pinion revolutions",
        "pinion torque, N·m",
        "speed, 1/min",
        "Hertz pressure at C, MPa",
        "wear coefficient, m²/N",
        "temperature rise, K",
        "pinion, greatest added, µm",
        "wheel, greatest added, µm",
        "pinion, volume added, mm³",
    ];
    let head: String = heads.iter().map(|name| format!("<th scope=\"col\">{name}</th>")).collect();
    let rows: String = s.phases.iter().take(MOST_SHOWN).map(row).collect();
    let more = match s.phases.len().saturating_sub(MOST_SHOWN) {
        0 => String::new(),
        more => format!("<p class=\"legend-note\">{more} more phases are in summary.json.</p>\n"),
    };
    format!(
        "<div class=\"phases\">\n<table>\n<caption>Phases of the operation</caption>\n<thead><tr><td>phase</td>{head}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table>\n</div>\n{more}<p class=\"legend-note\">New is the unworn pair under the load of the first \
         phase, worn the worn pair under that of the last. Line load, K/H, Hertz pressure and the temperatures of a new pair are those of the first \
         phase; all are in summary.json.</p>\n"
    )
}

fn row(phase: &PhaseSummary) -> String {
    let given = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), figure);
    let cells = [
        given(phase.hours),
        figure(phase.revolutions),
        figure(phase.pinion_torque_Nm),
        given(phase.pinion_speed_rpm),
        figure(phase.hertz_peak_pressure_MPa),
        format!("{:e}", phase.coefficient_m2_per_N),
        given(phase.greatest_rise_K),
        significant(phase.pinion.greatest_depth_um, 3),
        significant(phase.wheel.greatest_depth_um, 3),
        significant(phase.pinion.worn_volume_mm3, 3),
    ];
    let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
    format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", phase.number)
}
