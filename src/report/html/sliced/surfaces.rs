//! Wear and pressure over the flank, to be turned and read; buttons choose which one is shown. Wear is taken off the flank, so that it stands there
//! as the grooves it is; pressure stands on it.

use serde_json::{Value, json};

use super::raster::SlicedRaster;
use super::sliced_run::SlicedRun;
use crate::gear::Gear;
use crate::report::chart::{Chart, Trace, TraceKind};
use crate::report::html::number::{figure, plotted};
use crate::report::html::reading::greatest;

/// Wear is in µm, the flank in mm.
const MM_PER_UM: f64 = 1e-3;

struct ShownSurface<'a> {
    /// On its button.
    label: &'static str,
    /// At its axis.
    axis: &'static str,
    unit: &'static str,
    values: &'a [f64],
    top: f64,
    /// Whether it is depth, below the unworn flank.
    is_depth: bool,
}

impl ShownSurface<'_> {
    /// Of the axis that it is drawn along.
    fn range(&self) -> [f64; 2] {
        if self.is_depth { [-self.top, 0.0] } else { [0.0, self.top] }
    }
}

/// Length of the face width and of the greatest height as drawn.
const DRAWN: [f64; 2] = [1.7, 0.55];

pub(super) fn wear_and_pressure(run: SlicedRun<'_>, gear: Gear) -> Chart {
    let flank = &run.record.flanks[gear];
    let top = |field: &[f64]| greatest(field).map_or(0.0, |peak| peak.value);
    let pressure = top(&flank.pressure_new_MPa).max(top(&flank.pressure_worn_MPa));
    let up_to = |top: f64| if top > 0.0 { top } else { 1.0 };
    let shown = [
        ("wear", "worn flank, µm", "µm", &flank.wear_um, top(&flank.wear_um), true),
        ("pressure, new", "pressure, MPa", "MPa", &flank.pressure_new_MPa, pressure, false),
        ("pressure, worn", "pressure, MPa", "MPa", &flank.pressure_worn_MPa, pressure, false),
    ]
    .map(|(label, axis, unit, values, top, is_depth)| ShownSurface {
        label,
        axis,
        unit,
        values,
        top: up_to(top),
        is_depth,
    });
    let [width_drawn, height_drawn] = DRAWN;
    let exaggeration = height_drawn / (shown[0].top * MM_PER_UM) * run.record.surface[gear].face_width_mm / width_drawn;
    let mut height = scene_axis(shown[0].axis);
    height["range"] = json!(shown[0].range());
    height["nticks"] = json!(4);
    let scene = json!({
        "xaxis": scene_axis("face width, mm"),
        "yaxis": scene_axis("radius, mm"),
        "zaxis": height,
        "aspectmode": "manual",
        "aspectratio": { "x": width_drawn, "y": 1.2, "z": height_drawn },
        "camera": { "center": { "x": 0.0, "y": 0.0, "z": -0.15 }, "eye": { "x": -0.95, "y": -1.55, "z": 1.5 } },
        "dragmode": "turntable",
    });
    Chart::new(format!("surface-{}", gear.name()), format!("Wear and pressure over the {}’s flank", gear.name()))
        .wide()
        .height(560)
        .legend(false)
        .set("margin", json!({ "l": 4, "r": 4, "t": 36, "b": 8 }))
        .set("scene", scene)
        .set("updatemenus", json!([buttons(&shown)]))
        .add_all(shown.iter().enumerate().map(|(i, shown)| surface(run, gear, shown, i == 0)))
        .reading(format!(
            "Wear ({} µm at most) is taken off the unworn flank at 0, which is drawn flat: grooves point down, {} times as deep as the face \
             width is drawn to scale. Pressure stands up: the maximum during one mesh ({} MPa at most new, {} MPa worn). Colour is the same \
             quantity; drag to turn. Each cell shows the maximum of the flank points it stands for.",
            figure(top(&flank.wear_um)),
            figure(exaggeration),
            figure(top(&flank.pressure_new_MPa)),
            figure(top(&flank.pressure_worn_MPa)),
        ))
}

/// The surface, drawn on to both end faces with the values of the first and the last slice.
fn surface(run: SlicedRun<'_>, gear: Gear, shown: &ShownSurface<'_>, visible: bool) -> Trace {
    let flank = &run.record.flanks[gear];
    let face_width = run.record.surface[gear].face_width_mm;
    let raster = SlicedRaster::of_flank(flank, face_width);
    let points = flank.radius_mm.len();
    let to_ends = |row: Vec<f64>| -> Vec<f64> {
        let (first, last) = (row.first().copied(), row.last().copied());
        first.into_iter().chain(row).chain(last).collect()
    };
    let values: Vec<Vec<f64>> =
        raster.rows(|point, slice| shown.values[slice * points + point]).into_iter().map(to_ends).collect();
    let sign = if shown.is_depth { -1.0 } else { 1.0 };
    let height: Vec<Vec<f64>> = values.iter().map(|row| row.iter().map(|value| sign * value).collect()).collect();
    let width = std::iter::once(0.0).chain(raster.across.middles()).chain([face_width]).map(plotted);
    let radius = raster.along.middles().into_iter().map(plotted);
    let unit = shown.unit;
    Trace::new(TraceKind::Surface, shown.label)
        .set("x", width.collect::<Vec<f64>>())
        .set("y", radius.collect::<Vec<f64>>())
        .set("z", height)
        .set("surfacecolor", values)
        .set("visible", visible)
        .set("cmin", 0.0)
        .set("cmax", shown.top)
        .colour_bar(unit)
        .hover(format!("width %{{x:.2f}} mm, radius %{{y:.2f}} mm<br>%{{z:.4~g}} {unit}<extra></extra>"))
}

fn scene_axis(title: &str) -> Value {
    json!({ "title": { "text": title, "font": { "size": 12 } }, "gridcolor": "var(--rule)", "zeroline": false })
}

fn buttons(shown: &[ShownSurface<'_>]) -> Value {
    let button = |chosen: usize| {
        let visible: Vec<bool> = (0..shown.len()).map(|i| i == chosen).collect();
        let ShownSurface { label, axis, .. } = &shown[chosen];
        let layout = json!({ "scene.zaxis.title.text": axis, "scene.zaxis.range": shown[chosen].range() });
        json!({ "label": label, "method": "update", "args": [{ "visible": visible }, layout] })
    };
    json!({
        "type": "buttons",
        "direction": "right",
        "buttons": (0..shown.len()).map(button).collect::<Vec<_>>(),
        "bgcolor": "var(--panel)",
        "bordercolor": "var(--rule)",
        "font": { "size": 12, "color": "var(--ink)" },
        "pad": { "t": 0, "b": 0, "l": 0 },
        "x": 0.0,
        "xanchor": "left",
        "y": 1.0,
        "yanchor": "bottom",
    })
}
