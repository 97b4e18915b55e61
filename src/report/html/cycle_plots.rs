//! Plots over the mesh cycle of the reference pair, from A to E: load sharing, transmission error, pressure.

use crate::report::chart::Plot;

use super::number::{change, figure, percent, significant};
use super::reading::{Extreme, among, defined_pressures, greatest, tip_edge_note};
use super::theme::{Figure, axis, from_zero, layout, mark_path_points, named, new_and_worn, padded};
use crate::results::run::{MeshCycleRow, PathPoints, RunRecord};

/// A pair that carries at least this share of the load counts as carrying it alone.
pub const ALONE: f64 = 0.9995;

/// Load share, transmission error and greatest pressure over the cycle, new and worn.
pub fn all(record: &RunRecord) -> Vec<Figure> {
    vec![load_sharing(record), transmission_error(record), pressure(record)]
}

fn load_sharing(record: &RunRecord) -> Figure {
    let rows = &record.mesh_cycle;
    let reading = match (rows.first(), alone(rows, |r| r.load_share_new), alone(rows, |r| r.load_share_worn)) {
        (None, ..) => NOT_COMPUTED.into(),
        (Some(first), new, worn) => format!(
            "At A the entering pair takes {} of the load new and {} worn; it carries all of it {} new and {} worn.",
            percent(first.load_share_new),
            percent(first.load_share_worn),
            stretch(new),
            stretch(worn),
        ),
    };
    over_cycle(
        record,
        Words { id: "load-sharing", title: "Load sharing", y: "share of the load", hover: "%{y:.3f}" },
        [|r| r.load_share_new, |r| r.load_share_worn],
        Some(1.0),
        reading,
    )
}

/// Loaded transmission error.
pub fn transmission_error(record: &RunRecord) -> Figure {
    let (new, worn) = (&record.summary.new.transmission_error_um, &record.summary.worn.transmission_error_um);
    let reading = if record.mesh_cycle.is_empty() {
        NOT_COMPUTED.into()
    } else {
        format!(
            "Over the cycle the wheel lags {} to {} µm along the line of action new and {} to {} µm worn: peak to peak \
             {} and {} µm.",
            figure(new.min),
            figure(new.max),
            figure(worn.min),
            figure(worn.max),
            figure(new.peak_to_peak),
            figure(worn.peak_to_peak),
        )
    };
    over_cycle(
        record,
        Words {
            id: "transmission-error",
            title: "Loaded transmission error",
            y: "transmission error, µm",
            hover: "%{y:.3f} µm",
        },
        [|r| r.transmission_error_new_um, |r| r.transmission_error_worn_um],
        None,
        reading,
    )
}

fn pressure(record: &RunRecord) -> Figure {
    let rows = &record.mesh_cycle;
    let column = |value: fn(&MeshCycleRow) -> (f64, bool)| greatest(&defined_pressures(rows, value));
    let place = |at: Extreme| {
        let position = rows[at.index].position_mm;
        let points = named(&record.summary.geometry.curvature_radius_mm);
        format!("at {} mm, {}", significant(position, 4), among(&points, position))
    };
    let reading = match (
        column(|r| (r.peak_pressure_new_MPa, r.at_sharp_edge_new)),
        column(|r| (r.peak_pressure_worn_MPa, r.at_sharp_edge_worn)),
    ) {
        (Some(new), Some(worn)) => format!(
            "New, the pressure peaks {} with {} MPa; worn, {} with {} MPa ({}).{}",
            place(new),
            figure(new.value),
            place(worn),
            figure(worn.value),
            change(new.value, worn.value),
            tip_edge_note(&named(&record.summary.geometry.curvature_radius_mm), rows[worn.index].position_mm),
        ),
        _ => NOT_COMPUTED.into(),
    };
    let top = rows.iter().flat_map(|r| [r.peak_pressure_new_MPa, r.peak_pressure_worn_MPa]).fold(0.0, f64::max);
    over_cycle(
        record,
        Words {
            id: "cycle-pressure",
            title: "Greatest pressure over the cycle",
            y: "greatest pressure, MPa",
            hover: "%{y:.1f} MPa",
        },
        [|r| r.peak_pressure_new_MPa, |r| r.peak_pressure_worn_MPa],
        Some(top),
        reading,
    )
}

/// What to say of a run without a mesh cycle.
pub const NOT_COMPUTED: &str = "The run ended before a mesh cycle was evaluated.";

/// What a plot over the cycle is called.
struct Words {
    id: &'static str,
    title: &'static str,
    y: &'static str,
    hover: &'static str,
}

/// A plot of a quantity new and worn over the cycle; its axis starts at zero where `top` says how far it goes.
fn over_cycle(
    record: &RunRecord,
    words: Words,
    new_worn: [fn(&MeshCycleRow) -> f64; 2],
    top: Option<f64>,
    reading: String,
) -> Figure {
    let rows = &record.mesh_cycle;
    let position: Vec<f64> = rows.iter().map(|r| r.position_mm).collect();
    let [new, worn] = new_worn.map(|value| rows.iter().map(value).collect());
    let mut plot = Plot::new();
    new_and_worn(&mut plot, &position, new, worn, words.hover);
    let points: &PathPoints = &record.summary.geometry.curvature_radius_mm;
    let y = match top {
        Some(top) => axis(words.y).range(from_zero(top).to_vec()),
        None => axis(words.y),
    };
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    plot.set_layout(mark_path_points(layout(380).show_legend(true).x_axis(x).y_axis(y), points));
    Figure { id: words.id.into(), title: words.title.into(), reading, plot, wide: false }
}

/// First and last position where the pair carries the whole load.
fn alone(rows: &[MeshCycleRow], share: fn(&MeshCycleRow) -> f64) -> Option<[f64; 2]> {
    let mut carrying = rows.iter().filter(|r| share(r) >= ALONE).map(|r| r.position_mm);
    let first = carrying.next()?;
    Some([first, carrying.next_back().unwrap_or(first)])
}

fn stretch(alone: Option<[f64; 2]>) -> String {
    match alone {
        Some([from, to]) => format!("from {} to {} mm", significant(from, 4), significant(to, 4)),
        None => "nowhere".into(),
    }
}
