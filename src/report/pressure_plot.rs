//! Pressure of finite elements beside Hertz's.

use std::f64::consts::PI;

use super::chart::{Chart, Dash, MUTED, PATH, Trace};
use gearwear_bodies::reference::hertz_line::LineContact;

/// Points of Hertz's ellipse.
const ELLIPSE_POINTS: usize = 200;

/// Draws the pressure at `nodes` (place in mm, MPa) and Hertz's, within the range of places.
pub(super) fn beside_hertz(
    chart: Chart,
    nodes: &[(f64, f64)],
    hertz_name: &str,
    hertz: Option<LineContact>,
    [low, high]: [f64; 2],
) -> Chart {
    const HOVER: &str = "%{y:.1f} MPa";
    let (along, pressures) = (nodes.iter().map(|(s, _)| *s), nodes.iter().map(|(_, p)| *p));
    let found = Trace::line("finite elements", along, pressures, (PATH, 2.0, Dash::Solid)).with_points("circle", 5);
    let chart = chart.x_range([low, high]).x_format(".4~g").y("contact pressure, MPa").add(found.hover(HOVER));
    let Some(hertz) = hertz else { return chart };
    let place = |i| -(PI * i as f64 / ELLIPSE_POINTS as f64).cos() * hertz.half_width_mm;
    let places: Vec<f64> = (0..=ELLIPSE_POINTS).map(place).filter(|s| (low..=high).contains(s)).collect();
    let pressures: Vec<f64> = places.iter().map(|&s| hertz.pressure_mpa(s)).collect();
    chart.line(hertz_name, places, pressures, (MUTED, 2.0, Dash::Dashed), HOVER)
}
