//! Load of every slice while the tooth goes through the mesh, new and worn.

use crate::report::chart::{ColorBar, ColorScale, Font, HoverMode, Plot, Title, Trace};

use super::raster::SlicedRaster;
use super::{SlicedRun, slice_name};
use crate::report::html::number::{figure, plotted, significant};
use crate::report::html::reading::greatest;
use crate::report::html::theme::{Figure, axis, layout, mark_path_points};

/// Two maps with one scale of colours.
pub fn new_and_worn(run: SlicedRun<'_>) -> Vec<Figure> {
    let loads = [&run.slices.line_load_new_N_per_mm, &run.slices.line_load_worn_N_per_mm];
    let top = loads.map(|loads| greatest(loads).map_or(0.0, |peak| peak.value)).into_iter().fold(0.0, f64::max);
    [("new", loads[0]), ("worn", loads[1])].map(|(when, loads)| map(run, when, loads, top)).into()
}

fn map(run: SlicedRun<'_>, when: &str, loads: &[f64], top: f64) -> Figure {
    let slices = run.slices;
    let count = slices.width_mm.len();
    let raster = SlicedRaster::of_path(&slices.position_mm, &slices.width_mm, slices.surface.pinion.face_width_mm);
    let values = raster.columns(|position, slice| loads[position * count + slice]);
    let edges = |edges: &[f64]| edges.iter().map(|&edge| plotted(edge)).collect::<Vec<f64>>();
    let mut plot = Plot::new();
    plot.add_trace(
        Trace::heat_map(edges(&raster.along.edges), edges(&raster.across.edges), values)
            .zmin(0.0)
            .zmax(if top > 0.0 { top } else { 1.0 })
            .color_scale(ColorScale::Viridis)
            .color_bar(ColorBar::new().title(Title::new().text("N/mm").font(Font::new().size(12))).thickness(12))
            .hover_template("position %{x:.3f} mm, width %{y:.2f} mm<br>%{z:.4~g} N/mm<extra></extra>"),
    );
    plot.set_layout(mark_path_points(
        layout(360)
            .show_legend(false)
            .hover_mode(HoverMode::Closest)
            .x_axis(axis("position of the tooth, mm").show_grid(false))
            .y_axis(axis("face width, mm").show_grid(false)),
        &run.record.summary.geometry.curvature_radius_mm,
    ));
    let reading = match greatest(loads) {
        Some(peak) => format!(
            "A slice carries at most {} N per mm of face width {when}, {} with the tooth at {} mm; the whole torque over \
             the face width is {} N/mm. Contact crosses the map obliquely: slices enter and leave one after the other.",
            figure(peak.value),
            slice_name(&run.record.flanks.pinion, peak.index % count),
            significant(slices.position_mm[peak.index / count], 4),
            figure(run.record.summary.contact.line_load_N_per_mm),
        ),
        None => "The run ended before a mesh cycle was evaluated.".into(),
    };
    Figure {
        id: format!("slice-load-{when}"),
        title: format!("Load of each slice over the mesh of one tooth, {when}"),
        reading,
        plot,
        wide: false,
    }
}
