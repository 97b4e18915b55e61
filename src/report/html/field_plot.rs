//! The von Mises stress over the bodies, as a picture that can be zoomed and read point by point.
//!
//! The values at the nodes are sampled on a raster of small squares. Over the raster lie the bodies' outlines and, where they can be told apart,
//! the sides of the elements.

use super::number::to_digits;
use crate::report::chart::{Chart, Dash, INK, Rows, Trace};
use gearwear_fem::field_raster::{Bodies, Raster, Window, sides};

/// Significant digits of a value in the picture.
const DIGITS: usize = 4;
/// Sides of elements that a picture shows at the most: beyond, they are too fine to be seen and too many to be drawn.
const MOST_SIDES: usize = 20_000;
/// Width over height of a picture on a wide screen.
pub const WIDTH_OVER_HEIGHT: f64 = 1.75;
const HEIGHT_PX: usize = 600;

/// Draws the von Mises stress at the nodes within `window`.
pub fn von_mises(chart: Chart, bodies: Bodies<'_>, stress_mpa: &[f64], window: Window) -> Chart {
    let raster = Raster::sample(bodies, stress_mpa, window);
    let shown = |value: Option<f64>| value.map_or(f64::NAN, |value| to_digits(value, DIGITS));
    let values: Rows = raster.values.into_iter().map(|row| row.into_iter().map(shown).collect()).collect();
    let colours = Trace::heat_map("σᵥ, MPa", &raster.x_mm, &raster.y_mm, values)
        .hover("x %{x:.5~g} mm, y %{y:.5~g} mm<br>%{z:.4~g} MPa<extra></extra>");
    let (inner, outline) = side_lines(bodies, window, ("rgba(255,255,255,0.28)", 0.6), ("outline", INK, 1.2));
    to_scale(chart.wide().add(colours).add_all(inner).add(outline), window).legend(false)
}

/// The sides between elements, unless they are too many, and those around the bodies.
pub fn side_lines(
    bodies: Bodies<'_>,
    window: Window,
    (inner_colour, inner_px): (&str, f64),
    (name, colour, width_px): (&str, &str, f64),
) -> (Option<Trace>, Trace) {
    let (outline, inner) = sides(bodies, window);
    let between = || segments("elements", bodies, &inner, inner_colour, inner_px);
    ((inner.len() <= MOST_SIDES).then(between), segments(name, bodies, &outline, colour, width_px))
}

/// The chart as a picture at its true proportions that shows `window` to begin with.
pub fn to_scale(chart: Chart, window: Window) -> Chart {
    let pixels = HEIGHT_PX as f64 * WIDTH_OVER_HEIGHT * window.height_mm() / window.width_mm();
    let height = (pixels.clamp(0.45 * HEIGHT_PX as f64, HEIGHT_PX as f64) + 80.0) as usize;
    chart
        .height(height)
        .read_nearest()
        .x("x, mm")
        .y("y, mm")
        .x_range(window.x_mm)
        .y_range(window.y_mm)
        .without_grid()
        .drawn_to_scale()
}

/// Sides of elements as one line with gaps.
pub fn segments(name: &str, bodies: Bodies<'_>, sides: &[Vec<u32>], colour: &str, width_px: f64) -> Trace {
    let along = |axis: usize| {
        let place = move |node: &u32| Some(bodies.points_mm[*node as usize][axis]);
        sides.iter().flat_map(move |side| side.iter().map(place).chain([None]))
    };
    Trace::line(name, along(0), along(1), (colour, width_px, Dash::Solid))
}
