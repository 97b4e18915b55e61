//! The plots of runs side by side: wear of both flanks, pressure, load share and transmission error over the mesh cycle.

use crate::variants::finished_run::FinishedRun;
use gearwear::report::chart::{Chart, Dash, colour_between_gears, padded};
use gearwear::report::html::number::{figure, significant};
use gearwear::report::html::reading::greatest;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;

const DASHES: [Dash; 4] = [Dash::Solid, Dash::Dashed, Dash::Dot, Dash::Mixed];

pub(super) fn all(runs: &[FinishedRun]) -> Vec<Chart> {
    let mut charts: Vec<Chart> = Gear::BOTH.into_iter().map(|gear| wear(runs, gear)).collect();
    charts.extend([
        over_mesh(runs, "pressure-new", "Maximum pressure, new", "pressure, MPa", "peak_pressure_new_MPa"),
        over_mesh(runs, "pressure-worn", "Maximum pressure, worn", "pressure, MPa", "peak_pressure_worn_MPa"),
        over_mesh(runs, "load-share-new", "Load share, new", "load share", "load_share_new"),
        over_mesh(runs, "load-share-worn", "Load share, worn", "load share", "load_share_worn"),
        over_mesh(runs, "te-new", "Transmission error, new", "transmission error, µm", "transmission_error_new_um"),
        over_mesh(runs, "te-worn", "Transmission error, worn", "transmission error, µm", "transmission_error_worn_um"),
    ]);
    charts
}

/// Colour, width and dash of the run at a place among `count`.
fn stroke(place: usize, count: usize) -> (String, f64, Dash) {
    (colour_between_gears(place as f64 / (count - 1).max(1) as f64), 2.0, DASHES[place % DASHES.len()])
}

fn wear(runs: &[FinishedRun], gear: Gear) -> Chart {
    let profiles: Vec<(Vec<f64>, Vec<f64>)> = runs.iter().map(|run| run.wear_profile(gear)).collect();
    // The flank below the first point that wears is empty.
    let points = profiles.iter().flat_map(|(radii, wear)| radii.iter().zip(wear));
    let [low, high] = extent(points.filter(|(_, wear)| **wear > 0.0).map(|(radius, _)| *radius));
    let deepest = profiles.iter().flat_map(|(_, wear)| wear.iter().copied()).fold(0.0, f64::max);
    let words = runs.iter().zip(&profiles).filter_map(|(run, (radii, wear))| {
        let at = greatest(wear)?;
        Some(format!("{} {} µm at {} mm", run.name, figure(at.value), significant(radii[at.index], 4)))
    });
    let words: Vec<String> = words.collect();
    let mut chart = Chart::new(format!("wear-{}", gear.name()), format!("Wear depth of the {}", gear.name()))
        .wide()
        .height(460)
        .reading(format!(
            "Maximum over the face width at each radius. Maximum, tip edges included: {}.",
            words.join(", ")
        ))
        .x(&format!("radius on the {}, mm", gear.name()))
        .x_range(padded(low, high))
        .x_format(".3f")
        .y("wear depth, µm")
        .y_down_to(deepest);
    for (place, (run, (radii, wear))) in runs.iter().zip(profiles).enumerate() {
        chart = chart.line(&run.name, radii, wear, stroke(place, runs.len()), "%{y:.3f} µm");
    }
    chart
}

fn over_mesh(runs: &[FinishedRun], id: &str, title: &str, axis: &str, column: &str) -> Chart {
    let [low, high] = extent(runs.iter().flat_map(|run| run.mesh_cycle.get("position_mm").iter().copied()));
    let words = runs.iter().filter_map(|run| {
        let most = greatest(run.mesh_cycle.get(column))?.value;
        Some(format!("{} {}", run.name, figure(most)))
    });
    let words: Vec<String> = words.collect();
    let mut chart = Chart::new(id, title)
        .reading(format!(
            "Maximum{}: {}.",
            axis.rsplit_once(", ").map_or_else(String::new, |(_, unit)| format!(", {unit}")),
            words.join(", ")
        ))
        .x("contact position, mm")
        .x_range(padded(low, high))
        .x_format(".3f")
        .y(axis);
    for (place, run) in runs.iter().enumerate() {
        let positions = run.mesh_cycle.get("position_mm").to_vec();
        chart = chart.line(
            &run.name,
            positions,
            run.mesh_cycle.get(column).to_vec(),
            stroke(place, runs.len()),
            "%{y:.4g}",
        );
    }
    chart
}
