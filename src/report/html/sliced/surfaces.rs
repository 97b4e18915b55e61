//! Wear and pressure over the flank, to be turned and read; buttons choose which one is shown. Wear is taken off the flank, so that it stands there
//! as the grooves it is; pressure stands on it.

use super::raster::SlicedRaster;
use super::sliced_run::SlicedRun;
use crate::report::chart::{Chart, ColourScale, Drawn, Field, Rows, Surface, Trace, View};
use crate::report::html::number::{figure, plotted};
use crate::report::html::reading::greatest;
use gearwear_bodies::gear::Gear;

/// Wear is in µm, the flank in mm.
const MM_PER_UM: f64 = 1e-3;

struct ShownSurface<'a> {
    /// On its button.
    label: &'static str,
    /// At its axis.
    title: &'static str,
    unit: &'static str,
    values: &'a [f64],
    top: f64,
    /// Whether it is depth, below the unworn flank.
    is_depth: bool,
}

/// Lengths of the face width, of the flank from root to tip and of the greatest height as drawn.
const DRAWN: [f64; 3] = [1.7, 1.2, 0.55];

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
    .map(|(label, title, unit, values, top, is_depth)| ShownSurface {
        label,
        title,
        unit,
        values,
        top: up_to(top),
        is_depth,
    });
    let [width_drawn, _, height_drawn] = DRAWN;
    let exaggeration = height_drawn / (shown[0].top * MM_PER_UM) * run.record.surface[gear].face_width_mm / width_drawn;
    Chart::new(format!("surface-{}", gear.name()), format!("Wear and pressure over the {}’s flank", gear.name()))
        .wide()
        .height(560)
        .legend(false)
        .x("face width, mm")
        .y("radius, mm")
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
fn surface(run: SlicedRun<'_>, gear: Gear, shown: &ShownSurface<'_>, is_first: bool) -> Trace {
    let flank = &run.record.flanks[gear];
    let face_width = run.record.surface[gear].face_width_mm;
    let raster = SlicedRaster::of_flank(flank, face_width);
    let points = flank.radius_mm.len();
    let to_ends = |row: Vec<f64>| -> Vec<f64> {
        let (first, last) = (row.first().copied(), row.last().copied());
        first.into_iter().chain(row).chain(last).collect()
    };
    let values: Rows =
        raster.rows(|point, slice| shown.values[slice * points + point]).into_iter().map(to_ends).collect();
    let rise = if shown.is_depth { -1.0 } else { 1.0 };
    let width = std::iter::once(0.0).chain(raster.across.middles()).chain([face_width]).map(plotted);
    let radius = raster.along.middles().into_iter().map(plotted);
    let (unit, top) = (shown.unit, shown.top);
    let scale = ColourScale { unit: unit.to_owned(), range: Some([0.0, top]) };
    let view = View {
        label: shown.label,
        height_title: shown.title,
        height_range: if shown.is_depth { [-top, 0.0] } else { [0.0, top] },
        drawn: DRAWN,
    };
    let field = Field { x: width.collect(), y: radius.collect(), values, scale };
    let mut trace = Trace::new(Drawn::Surface(Surface { field, rise, view }), shown.label);
    trace.is_shown = is_first;
    trace.hover(format!("width %{{x:.2f}} mm, radius %{{y:.2f}} mm<br>%{{z:.4~g}} {unit}<extra></extra>"))
}
