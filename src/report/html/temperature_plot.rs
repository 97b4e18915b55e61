//! Plots of the contact's temperature and of its Peclet numbers over the mesh cycle, new.

use crate::report::chart::{Axis, DashType, Plot};

use super::number::{figure, significant};
use super::reading::among;
use super::theme::{
    Figure, MUTED, PATH, WORN, axis, curve, from_zero, gear_colour, layout, line, mark_path_points, named, padded,
};
use crate::gear::Gear;
use crate::results::chemistry::{HeatVelocity, TemperatureMethod};
use crate::results::run::{MeshCycleRow, RunRecord};

/// A column of the mesh cycle that may be empty.
type Column = fn(&MeshCycleRow) -> Option<f64>;

/// Rises by all methods, with their colour and dash.
const METHODS: [(TemperatureMethod, Column, &str, DashType); 3] = [
    (TemperatureMethod::HeatEquation, |row| row.temperature_rise_heat_equation_K, WORN, DashType::Solid),
    (TemperatureMethod::Williams, |row| row.temperature_rise_williams_K, MUTED, DashType::Dash),
    (TemperatureMethod::TianKennedy, |row| row.temperature_rise_tian_kennedy_K, PATH, DashType::Solid),
];

/// Both plots; none where no temperature was asked for.
pub fn all(record: &RunRecord) -> Vec<Figure> {
    if record.summary.temperature.is_none() || record.mesh_cycle.is_empty() {
        return Vec::new();
    }
    vec![rises(record), peclet(record)]
}

fn rises(record: &RunRecord) -> Figure {
    let rows = &record.mesh_cycle;
    let points = named(&record.summary.geometry.curvature_radius_mm);
    let (mut plot, mut top, mut words) = (Plot::new(), 0.0_f64, Vec::new());
    for (method, rise, colour, dash) in METHODS {
        let (x, y) = values(rows, rise);
        let greatest = y.iter().zip(&x).fold((0.0, f64::NAN), |best, (&y, &x)| if y > best.0 { (y, x) } else { best });
        top = top.max(greatest.0);
        words.push(format!("{} K by {}, {}", figure(greatest.0), name(method), among(&points, greatest.1)));
        plot.add_trace(curve(method.title(), x, y, line(colour, 2.2, dash)).hover_template("%{y:.1f} K"));
    }
    let bulk = record.summary.temperature.as_ref().map_or(0.0, |temperature| temperature.bulk_temperature_C);
    let reading = format!(
        "The contact rises above the {} °C of the gears by up to {}. It does not where the flanks stop sliding, at C.",
        significant(bulk, 4),
        words.join("; ")
    );
    let y = axis("greatest temperature rise, K").range(from_zero(top).to_vec());
    finish(record, plot, y, Words { id: "temperature", title: "Contact temperature, new", reading })
}

fn peclet(record: &RunRecord) -> Figure {
    let rows = &record.mesh_cycle;
    let (mut plot, mut top) = (Plot::new(), 0.0_f64);
    let velocity = record.summary.temperature.as_ref().map(|temperature| temperature.velocity);
    let columns: [(Gear, Column, DashType); 2] = [
        (Gear::Pinion, |row| row.peclet_pinion, DashType::Solid),
        (Gear::Wheel, |row| row.peclet_wheel, DashType::Dash),
    ];
    for (gear, value, dash) in columns {
        let (x, y) = values(rows, value);
        top = y.iter().copied().fold(top, f64::max);
        let trace = curve(gear.name(), x, y, line(gear_colour(gear), 2.2, dash));
        plot.add_trace(trace.hover_template("%{y:.2f}"));
    }
    let with = match velocity {
        Some(HeatVelocity::Surface) => "each body’s own surface velocity",
        _ => "the sliding velocity",
    };
    let reading = format!(
        "With {with} the Peclet number reaches {}. Williams and the one-dimensional heat equation are for numbers above about 5; \
         below, heat also flows sideways and they are too hot.",
        significant(top, 3)
    );
    let y = axis("Peclet number").range(from_zero(top).to_vec());
    finish(record, plot, y, Words { id: "peclet", title: "Peclet number, new", reading })
}

struct Words {
    id: &'static str,
    title: &'static str,
    reading: String,
}

fn finish(record: &RunRecord, mut plot: Plot, y: Axis, words: Words) -> Figure {
    let points = &record.summary.geometry.curvature_radius_mm;
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    plot.set_layout(mark_path_points(layout(380).show_legend(true).x_axis(x).y_axis(y), points));
    Figure { id: words.id.into(), title: words.title.into(), reading: words.reading, plot, wide: false }
}

fn values(rows: &[MeshCycleRow], of: Column) -> (Vec<f64>, Vec<f64>) {
    rows.iter().filter_map(|row| Some((row.position_mm, of(row)?))).unzip()
}

fn name(method: TemperatureMethod) -> &'static str {
    match method {
        TemperatureMethod::HeatEquation => "the heat equation",
        TemperatureMethod::Williams | TemperatureMethod::TianKennedy => method.title(),
    }
}
