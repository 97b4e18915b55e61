//! Pressure along a contact, beside Hertz's.

use crate::report::chart::Chart;
use crate::report::html::number::{change, figure, significant};
use crate::report::pressure_plot::beside_hertz;
use gearwear_bodies::reference::hertz_line::LineContact;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::fem_problem::{ContactCurve, ContactRow, FemContactSummary};

/// Half-widths shown on either side.
const SHOWN: f64 = 1.8;

/// The pressure along one contact, number `index` of `count`; none where nothing touches.
pub(super) fn pressure(
    index: usize,
    count: usize,
    summary: &FemContactSummary,
    contact: &ContactCurve,
) -> Option<Chart> {
    if summary.half_width_mm <= 0.0 {
        return None;
    }
    let hertz = summary
        .hertz
        .map(|hertz| LineContact { half_width_mm: hertz.half_width_mm, peak_pressure_mpa: hertz.peak_pressure_MPa });
    let reach_mm = SHOWN * summary.half_width_mm.max(hertz.map_or(0.0, |hertz| hertz.half_width_mm));
    let place = |row: &ContactRow| (row.along_mm - contact.centre_along_mm, row.pressure_MPa);
    let shown: Vec<(f64, f64)> = contact.rows.iter().map(place).filter(|(s, _)| s.abs() <= reach_mm).collect();
    let range = extent(shown.iter().map(|(s, _)| *s).chain([0.0]));
    let top = shown.iter().map(|(_, p)| *p).fold(hertz.map_or(0.0, |hertz| hertz.peak_pressure_mpa), f64::max);
    let of_several = if count > 1 { format!(": {} on {}", summary.slave, summary.master) } else { String::new() };
    let chart = Chart::new(format!("pressure-{index}"), format!("Contact pressure{of_several}"))
        .wide_if(count == 1)
        .height(420)
        .x("distance from the middle of the contact, mm")
        .reading(reading(summary));
    Some(beside_hertz(chart, &shown, "Hertz, same force", hertz, range).y_up_to(top))
}

fn reading(summary: &FemContactSummary) -> String {
    let half =
        if summary.half_model { " The contact ends on a line of symmetry: the model holds half of it." } else { "" };
    let found = format!(
        "The pressure peaks with {} MPa over a half-width of {} mm.",
        figure(summary.peak_pressure_MPa),
        figure(summary.half_width_mm)
    );
    let compared = match summary.hertz {
        Some(hertz) => format!(
            " Hertz’s contact of the same force and of the curvature of both surfaces, a relative radius of {} mm, has {} MPa ({}) \
             over {} mm ({}).",
            significant(hertz.relative_radius_mm, 4),
            figure(hertz.peak_pressure_MPa),
            deviation(hertz.peak_pressure_MPa, summary.peak_pressure_MPa),
            figure(hertz.half_width_mm),
            deviation(hertz.half_width_mm, summary.half_width_mm),
        ),
        None => " The surfaces are not both round here, so there is no contact of Hertz to compare with.".to_owned(),
    };
    format!("{found}{compared}{half}")
}

fn deviation(hertz: f64, found: f64) -> String {
    format!("finite elements {}", change(hertz, found))
}
