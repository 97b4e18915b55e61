//! Pressure along a contact, beside Hertz's.

use crate::report::chart::{DashType, Marker, Mode, Plot};

use crate::reference::hertz_line::LineContact;
use crate::report::html::number::{change, figure, significant};
use crate::report::html::theme::{Figure, MUTED, PATH, axis, curve, from_zero, layout, line};
use crate::results::fem_problem::{ContactCurve, ContactRow, ContactSummary};

/// Half-widths shown on either side.
const SHOWN: f64 = 1.8;
/// Points of Hertz's ellipse.
const ELLIPSE_POINTS: usize = 200;

/// The pressure along one contact, number `index` of `count`; none where nothing touches.
pub fn pressure(index: usize, count: usize, summary: &ContactSummary, contact: &ContactCurve) -> Option<Figure> {
    if summary.half_width_mm <= 0.0 {
        return None;
    }
    let reach_mm = SHOWN * summary.half_width_mm.max(summary.hertz.map_or(0.0, |hertz| hertz.half_width_mm));
    let from_middle = |row: &ContactRow| row.along_mm - contact.centre_along_mm;
    let shown: Vec<&ContactRow> = contact.rows.iter().filter(|row| from_middle(row).abs() <= reach_mm).collect();
    let [low, high] = shown
        .iter()
        .fold([0.0_f64, 0.0_f64], |[low, high], row| [low.min(from_middle(row)), high.max(from_middle(row))]);
    let mut plot = Plot::new();
    let nodes = curve(
        "finite elements",
        shown.iter().map(|row| from_middle(row)),
        shown.iter().map(|row| row.pressure_MPa),
        line(PATH, 2.0, DashType::Solid),
    );
    plot.add_trace(
        nodes.mode(Mode::LinesMarkers).marker(Marker::new().color(PATH).size(5)).hover_template("%{y:.1f} MPa"),
    );
    if let Some(hertz) = summary.hertz {
        let ellipse = LineContact { half_width_mm: hertz.half_width_mm, peak_pressure_mpa: hertz.peak_pressure_MPa };
        let places: Vec<f64> = (0..=ELLIPSE_POINTS)
            .map(|i| -(std::f64::consts::PI * i as f64 / ELLIPSE_POINTS as f64).cos() * hertz.half_width_mm)
            .filter(|s| (low..=high).contains(s))
            .collect();
        let pressures: Vec<f64> = places.iter().map(|&s| ellipse.pressure_mpa(s)).collect();
        plot.add_trace(
            curve("Hertz, same force", places, pressures, line(MUTED, 2.0, DashType::Dash))
                .hover_template("%{y:.1f} MPa"),
        );
    }
    let top =
        shown.iter().map(|row| row.pressure_MPa).fold(summary.hertz.map_or(0.0, |h| h.peak_pressure_MPa), f64::max);
    let x = axis("along the surface from the middle of the contact, mm").range(vec![low, high]).hover_format(".4~g");
    plot.set_layout(
        layout(420).show_legend(true).x_axis(x).y_axis(axis("contact pressure, MPa").range(from_zero(top).to_vec())),
    );
    let of_several = if count > 1 { format!(": {} on {}", summary.slave, summary.master) } else { String::new() };
    Some(Figure {
        id: format!("pressure-{index}"),
        title: format!("Contact pressure{of_several}"),
        reading: reading(summary),
        plot,
        wide: count == 1,
    })
}

fn reading(summary: &ContactSummary) -> String {
    let half =
        if summary.half_model { " The contact ends on a line of symmetry: the model holds half of it." } else { "" };
    let found = format!(
        "The pressure peaks with {} MPa over a half-width of {} mm.",
        figure(summary.peak_pressure_MPa),
        figure(summary.half_width_mm)
    );
    let compared = match summary.hertz {
        Some(hertz) => format!(
            " Hertz’s line contact of the same force and of the curvature of both surfaces, a relative radius of {} mm, has {} MPa ({}) \
             over {} mm ({}).",
            significant(hertz.relative_radius_mm, 4),
            figure(hertz.peak_pressure_MPa),
            deviation(hertz.peak_pressure_MPa, summary.peak_pressure_MPa),
            figure(hertz.half_width_mm),
            deviation(hertz.half_width_mm, summary.half_width_mm),
        ),
        None => {
            " The surfaces are not both round here, so there is no line contact of Hertz to compare with.".to_owned()
        }
    };
    format!("{found}{compared}{half}")
}

/// How far the finite elements are from Hertz.
fn deviation(hertz: f64, found: f64) -> String {
    format!("finite elements {}", change(hertz, found))
}
