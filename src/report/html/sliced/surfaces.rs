//! Wear and pressure as surfaces over the flank, to be turned and read; buttons choose which one is shown.

use crate::report::chart::{
    Anchor, AspectMode, Axis, Button, ButtonMethod, Camera, ColorBar, ColorScale, DragMode, Font, LayoutScene, Margin,
    Pad, Plot, Title, Trace, UpdateMenu, UpdateMenuDirection, UpdateMenuType, Visible,
};
use serde_json::{Value, json};

use super::SlicedRun;
use super::raster::SlicedRaster;
use crate::gear::Gear;
use crate::report::html::number::{figure, plotted};
use crate::report::html::reading::greatest;
use crate::report::html::theme::{Figure, layout};

/// One of the surfaces.
struct Shown<'a> {
    /// On its button.
    label: &'static str,
    /// At its axis.
    axis: &'static str,
    unit: &'static str,
    values: &'a [f64],
    top: f64,
}

/// Wear, pressure new and pressure worn.
pub fn wear_and_pressure(run: SlicedRun<'_>, gear: Gear) -> Figure {
    let flank = &run.record.flanks[gear];
    let top = |field: &[f64]| greatest(field).map_or(0.0, |peak| peak.value);
    let pressure = top(&flank.pressure_new_MPa).max(top(&flank.pressure_worn_MPa));
    let shown = [
        ("wear", "wear, µm", "µm", &flank.wear_um, top(&flank.wear_um)),
        ("pressure, new", "pressure, MPa", "MPa", &flank.pressure_new_MPa, pressure),
        ("pressure, worn", "pressure, MPa", "MPa", &flank.pressure_worn_MPa, pressure),
    ]
    .map(|(label, axis, unit, values, top)| Shown {
        label,
        axis,
        unit,
        values,
        top: if top > 0.0 { top } else { 1.0 },
    });
    let mut plot = Plot::new();
    for (i, shown) in shown.iter().enumerate() {
        plot.add_trace(surface(run, gear, shown, i == 0));
    }
    let scene = LayoutScene::new()
        .x_axis(scene_axis("face width, mm"))
        .y_axis(scene_axis("radius, mm"))
        .z_axis(scene_axis(shown[0].axis).range(vec![0.0, shown[0].top]))
        .aspect_mode(AspectMode::Manual)
        .aspect_ratio([1.7, 1.2, 0.55])
        .camera(Camera::new().center([0.0, 0.0, -0.15]).eye([-0.95, -1.55, 1.5]))
        .drag_mode(DragMode::Turntable);
    plot.set_layout(
        layout(560)
            .margin(Margin::new().left(4).right(4).top(36).bottom(8))
            .show_legend(false)
            .scene(scene)
            .update_menus(vec![buttons(&shown)]),
    );
    Figure {
        id: format!("surface-{}", gear.name()),
        title: format!("Wear and pressure over the {}’s flank", gear.name()),
        reading: format!(
            "Height and colour are the wear ({} µm at most) or the greatest pressure during one mesh ({} MPa at most new, {} MPa worn); \
             drag to turn. Each cell shows the greatest of the flank points it stands for.",
            figure(top(&flank.wear_um)),
            figure(top(&flank.pressure_new_MPa)),
            figure(top(&flank.pressure_worn_MPa)),
        ),
        plot,
        wide: true,
    }
}

/// The surface, drawn on to both end faces with the values of the first and the last slice.
fn surface(run: SlicedRun<'_>, gear: Gear, shown: &Shown<'_>, visible: bool) -> Trace {
    let flank = &run.record.flanks[gear];
    let face_width = run.slices.surface[gear].face_width_mm;
    let raster = SlicedRaster::of_flank(flank, face_width);
    let points = flank.radius_mm.len();
    let to_ends = |row: Vec<f64>| -> Vec<f64> {
        let (first, last) = (row.first().copied(), row.last().copied());
        first.into_iter().chain(row).chain(last).collect()
    };
    let values = raster.rows(|point, slice| shown.values[slice * points + point]).into_iter().map(to_ends).collect();
    let width = std::iter::once(0.0).chain(raster.across.middles()).chain([face_width]);
    let unit = shown.unit;
    let radius = raster.along.middles().into_iter().map(plotted).collect();
    Trace::surface(width.map(plotted).collect(), radius, values)
        .name(shown.label)
        .visible(if visible { Visible::True } else { Visible::False })
        .cmin(0.0)
        .cmax(shown.top)
        .color_scale(ColorScale::Viridis)
        .color_bar(ColorBar::new().title(Title::new().text(unit).font(Font::new().size(12))).thickness(12))
        .hover_template(format!("width %{{x:.2f}} mm, radius %{{y:.2f}} mm<br>%{{z:.4~g}} {unit}<extra></extra>"))
}

fn scene_axis(title: &str) -> Axis {
    Axis::new().title(Title::new().text(title).font(Font::new().size(12))).grid_color("var(--rule)").zero_line(false)
}

fn buttons(shown: &[Shown<'_>]) -> UpdateMenu {
    let button = |chosen: usize| {
        let visible: Vec<bool> = (0..shown.len()).map(|i| i == chosen).collect();
        let layout: Value = json!({
            "scene.zaxis.title.text": shown[chosen].axis,
            "scene.zaxis.range": [0.0, shown[chosen].top],
        });
        Button::new()
            .label(shown[chosen].label)
            .method(ButtonMethod::Update)
            .args(json!([{ "visible": visible }, layout]))
    };
    UpdateMenu::new()
        .type_(UpdateMenuType::Buttons)
        .direction(UpdateMenuDirection::Right)
        .buttons((0..shown.len()).map(button).collect::<Vec<_>>())
        .background_color("var(--panel)")
        .border_color("var(--rule)")
        .font(Font::new().size(12).color("var(--ink)"))
        .pad(Pad::new().top(0).bottom(0).left(0))
        .x(0.0)
        .x_anchor(Anchor::Left)
        .y(1.0)
        .y_anchor(Anchor::Bottom)
}
