//! Plots of the contact's temperature and of its Peclet numbers over the mesh cycle, new.

use super::number::{figure, significant};
use crate::report::chart::{Chart, Dash, MUTED, PATH, WORN, gear_colour};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::chemistry::{HeatVelocity, TemperatureMethod};
use gearwear_physics::results::path_points::among;
use gearwear_physics::results::run::{MeshCycleRow, RunRecord};

type Column = fn(&MeshCycleRow) -> Option<f64>;

/// Rises by all methods, with their colour and dash.
const METHODS: [(TemperatureMethod, Column, &str, Dash); 3] = [
    (TemperatureMethod::HeatEquation, |row| row.temperature_rise_heat_equation_K, WORN, Dash::Solid),
    (TemperatureMethod::Williams, |row| row.temperature_rise_williams_K, MUTED, Dash::Dashed),
    (TemperatureMethod::TianKennedy, |row| row.temperature_rise_tian_kennedy_K, PATH, Dash::Solid),
];

/// Both plots; none where no temperature was asked for.
pub(super) fn all(record: &RunRecord) -> Vec<Chart> {
    if record.summary.temperature.is_none() || record.mesh_cycle.is_empty() {
        return Vec::new();
    }
    vec![rises(record), peclet(record)]
}

fn rises(record: &RunRecord) -> Chart {
    let path = &record.summary.geometry.curvature_radius_mm;
    let mut chart =
        Chart::new("temperature", "Contact temperature, new").y("maximum temperature rise, K").over_path(path);
    let (mut top, mut words) = (0.0_f64, Vec::new());
    for (method, rise, colour, dash) in METHODS {
        let (x, y) = values(&record.mesh_cycle, rise);
        let greatest = y.iter().zip(&x).fold((0.0, f64::NAN), |best, (&y, &x)| if y > best.0 { (y, x) } else { best });
        top = top.max(greatest.0);
        words.push(format!("{} K by {}, {}", figure(greatest.0), name(method), among(&path.named(), greatest.1)));
        chart = chart.line(method.title(), x, y, (colour, 2.2, dash), "%{y:.1f} K");
    }
    let bulk = record.summary.temperature.as_ref().map_or(0.0, |temperature| temperature.bulk_temperature_C);
    chart.y_up_to(top).reading(format!(
        "The temperature of the contact rises above the {} °C of the gears by up to {}. At C, where the flanks do not slide, it does not rise.",
        significant(bulk, 4),
        words.join("; ")
    ))
}

fn peclet(record: &RunRecord) -> Chart {
    let path = &record.summary.geometry.curvature_radius_mm;
    let mut chart = Chart::new("peclet", "Peclet number, new").y("Peclet number").over_path(path);
    let mut top = 0.0_f64;
    let columns: [(Gear, Column, Dash); 2] =
        [(Gear::Pinion, |row| row.peclet_pinion, Dash::Solid), (Gear::Wheel, |row| row.peclet_wheel, Dash::Dashed)];
    for (gear, value, dash) in columns {
        let (x, y) = values(&record.mesh_cycle, value);
        top = y.iter().copied().fold(top, f64::max);
        chart = chart.line(gear.name(), x, y, (gear_colour(gear), 2.2, dash), "%{y:.2f}");
    }
    let with = match record.summary.temperature.as_ref().map(|temperature| temperature.velocity) {
        Some(HeatVelocity::Surface) => "each body’s own surface velocity",
        _ => "the sliding velocity",
    };
    chart.y_up_to(top).reading(format!(
        "With {with} the Peclet number reaches {}. Williams and the one-dimensional heat equation hold above about 5; \
         below, heat also flows sideways and they overestimate the temperature.",
        significant(top, 3)
    ))
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
