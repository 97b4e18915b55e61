//! Load of every slice while the tooth goes through the mesh, new and worn.

use super::raster::SlicedRaster;
use super::sliced_run::{SlicedRun, slice_name};
use crate::report::chart::{Chart, Trace};
use crate::report::html::number::{figure, significant};
use crate::report::html::reading::greatest;

/// Two maps with one scale of colours.
pub(super) fn new_and_worn(run: SlicedRun<'_>) -> Vec<Chart> {
    let loads = [&run.slices.line_load_new_N_per_mm, &run.slices.line_load_worn_N_per_mm];
    let top = loads.map(|loads| greatest(loads).map_or(0.0, |peak| peak.value)).into_iter().fold(0.0, f64::max);
    [("new", loads[0]), ("worn", loads[1])].map(|(when, loads)| map(run, when, loads, top)).into()
}

fn map(run: SlicedRun<'_>, when: &str, loads: &[f64], top: f64) -> Chart {
    let slices = run.slices;
    let count = slices.width_mm.len();
    let raster = SlicedRaster::of_path(&slices.position_mm, &slices.width_mm, run.record.surface.pinion.face_width_mm);
    let values = raster.columns(|position, slice| loads[position * count + slice]);
    let colours = Trace::heat_map("N/mm", &raster.along.edges, &raster.across.edges, values)
        .colours_up_to(top)
        .hover("position %{x:.3f} mm, width %{y:.2f} mm<br>%{z:.4~g} N/mm<extra></extra>");
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
    Chart::new(format!("slice-load-{when}"), format!("Load of each slice over the mesh of one tooth, {when}"))
        .height(360)
        .legend(false)
        .read_nearest()
        .x("position of the tooth, mm")
        .y("face width, mm")
        .without_grid()
        .add(colours)
        .mark_path_points(&run.record.summary.geometry.curvature_radius_mm)
        .reading(reading)
}
