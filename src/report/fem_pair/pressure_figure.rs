//! Pressure along the flank beside Hertz's, at A to E or at the position asked for.

use crate::report::chart::{DashType, Marker, Mode, Plot};

use super::pressure_table::hertz;
use crate::report::html::number::{change, figure, percent, significant};
use crate::report::html::theme::{Figure, MUTED, PATH, axis, curve, from_zero, layout, line};
use crate::results::fem_pair::{FemPairRecord, PressureCurve};

/// Half-widths shown on either side.
const SHOWN: f64 = 1.6;
/// Points of Hertz's ellipse.
const ELLIPSE_POINTS: usize = 120;
/// Hertz's pressures shown at the most: a singular peak is cut off above.
const MOST_HERTZ: f64 = 2.0;

/// The reference pair's at A–E, every pair's at a position asked for.
pub fn all(record: &FemPairRecord) -> Vec<Figure> {
    record.pressure.iter().filter(|curve| curve.point.is_none() || curve.row.pair == 0).map(pressure).collect()
}

fn pressure(of: &PressureCurve) -> Figure {
    let hertz = hertz(of);
    let reach_mm = SHOWN * hertz.half_width_mm.max(of.row.half_width_mm);
    let shown: Vec<(f64, f64)> =
        of.along_mm.iter().copied().zip(of.pressure_MPa.iter().copied()).filter(|(s, _)| s.abs() <= reach_mm).collect();
    let mut plot = Plot::new();
    plot.add_trace(
        curve(
            "finite elements",
            shown.iter().map(|(s, _)| *s),
            shown.iter().map(|(_, p)| *p),
            line(PATH, 2.0, DashType::Solid),
        )
        .mode(Mode::LinesMarkers)
        .marker(Marker::new().color(PATH).size(4))
        .hover_template("%{y:.1f} MPa"),
    );
    let places: Vec<f64> = (0..=ELLIPSE_POINTS)
        .map(|i| -(std::f64::consts::PI * i as f64 / ELLIPSE_POINTS as f64).cos() * hertz.half_width_mm)
        .collect();
    let pressures: Vec<f64> = places.iter().map(|&s| hertz.pressure_mpa(s)).collect();
    plot.add_trace(
        curve("Hertz, same load", places, pressures, line(MUTED, 2.0, DashType::Dash)).hover_template("%{y:.1f} MPa"),
    );
    let top = of.row.peak_pressure_MPa.clamp(hertz.peak_pressure_mpa, MOST_HERTZ * hertz.peak_pressure_mpa);
    let x = axis("along the flank towards the pinion’s tip, mm").range(vec![-reach_mm, reach_mm]).hover_format(".4~g");
    plot.set_layout(
        layout(360).show_legend(true).x_axis(x).y_axis(axis("contact pressure, MPa").range(from_zero(top).to_vec())),
    );
    let (id, title) = match (of.point, of.row.pair) {
        (Some(point), _) => (format!("pressure-{}", point.to_lowercase()), format!("Contact pressure at {point}")),
        (None, 0) => ("pressure-reference".to_owned(), "Contact pressure of the reference pair".to_owned()),
        (None, pair) if pair > 0 => (format!("pressure-ahead-{pair}"), "Contact pressure of the pair ahead".to_owned()),
        (None, pair) => (format!("pressure-behind-{}", -pair), "Contact pressure of the pair behind".to_owned()),
    };
    Figure { id, title, reading: reading(of), plot, wide: false }
}

fn reading(of: &PressureCurve) -> String {
    let row = &of.row;
    let loaded =
        format!("At {} mm the pair carries {} of the load", significant(row.position_mm, 4), percent(row.load_share));
    if row.at_sharp_edge {
        return format!(
            "{loaded}; a sharp tip edge takes part of it. The peak of {} MPa there is singular: it grows with every \
             refinement and is cut off in this picture; Hertz, who knows no edge, has {} MPa.",
            figure(row.peak_pressure_MPa),
            figure(row.hertz_pressure_MPa)
        );
    }
    format!(
        "{loaded}. The pressure peaks with {} MPa over a half-width of {} mm; Hertz has {} MPa (finite elements {}) and {} mm.",
        figure(row.peak_pressure_MPa),
        figure(row.half_width_mm),
        figure(row.hertz_pressure_MPa),
        change(row.hertz_pressure_MPa, row.peak_pressure_MPa),
        figure(row.hertz_half_width_mm),
    )
}
