//! λ of every slice where the contact is, along the path and over the face width, new and worn.

use super::raster::{MOST_ALONG, SlicedRaster};
use super::sliced_run::{SlicedRun, slice_name};
use crate::report::chart::{Chart, Trace};
use crate::report::html::number::{figure, significant};
use gearwear_bodies::reference::statistics::quantile;
use gearwear_physics::results::lubrication::FilmRow;
use gearwear_physics::results::path_points::among;

/// Part of the places whose λ the colours tell apart.
const WITHIN_COLOURS: f64 = 0.97;

type Column = fn(&FilmRow) -> Option<f64>;

/// Two maps with one scale of colours; none without oil.
pub(super) fn new_and_worn(run: SlicedRun<'_>) -> Vec<Chart> {
    let columns: [(&str, Column); 2] = [("new", |row| row.lambda_new), ("worn", |row| row.lambda_worn)];
    let mut all: Vec<f64> =
        run.record.film.iter().flat_map(|row| columns.iter().filter_map(|(_, of)| of(row))).collect();
    all.sort_by(f64::total_cmp);
    // The few places that carry next to nothing have thick films.
    let top = quantile(&all, WITHIN_COLOURS).unwrap_or_default();
    columns.into_iter().filter_map(|(when, of)| map(run, when, of, top)).collect()
}

fn map(run: SlicedRun<'_>, when: &str, of: Column, top: f64) -> Option<Chart> {
    let (rows, slices) = (&run.record.film, &run.slices.width_mm);
    let loaded = rows.iter().filter_map(|row| Some((row, of(row)?)));
    let (thinnest, least) = loaded.min_by(|one, two| one.1.total_cmp(&two.1))?;
    let points = &run.record.summary.geometry.curvature_radius_mm;
    let in_slice = |slice: usize| rows.iter().filter(move |row| row.slice == slice);
    // Slices have their places one base pitch and its parts apart from each other: cells as wide as these hold one of each slice.
    let fewest = (0..slices.len()).map(|slice| in_slice(slice).count()).min().unwrap_or(0).saturating_sub(1);
    let cells = fewest.clamp(1, MOST_ALONG);
    let width_mm = (points.E - points.A) / cells as f64;
    let middles: Vec<f64> = (0..cells).map(|cell| points.A + (cell as f64 + 0.5) * width_mm).collect();
    let mut lambda = vec![f64::INFINITY; cells * slices.len()];
    for row in rows {
        let cell = ((row.position_mm - points.A) / width_mm) as usize;
        let kept = &mut lambda[cell.min(cells - 1) * slices.len() + row.slice];
        *kept = kept.min(of(row).unwrap_or(f64::INFINITY));
    }
    let raster = SlicedRaster::of_path(&middles, slices, run.record.surface.pinion.face_width_mm);
    // The raster keeps the greatest of neighbours, and what matters of films are the least.
    let values = raster.columns(|along, slice| -lambda[along * slices.len() + slice]);
    let values: Vec<Vec<f64>> = values.into_iter().map(|row| row.into_iter().map(|value| -value).collect()).collect();
    let colours = Trace::heat_map("λ", &raster.along.edges, &raster.across.edges, values)
        .colours_up_to(top)
        .hover("contact at %{x:.3f} mm, width %{y:.2f} mm<br>λ %{z:.3~g}<extra></extra>");
    let reading = format!(
        "The minimum of λ {when} is {}, {}, {} with the contact at {} mm. Colours end at {}, above which are the few places that carry next to nothing; it is empty where no load is \
         carried.",
        figure(least),
        slice_name(&run.record.flanks.pinion, thinnest.slice),
        among(&points.named(), thinnest.position_mm),
        significant(thinnest.position_mm, 4),
        figure(top),
    );
    let chart = Chart::new(format!("slice-lambda-{when}"), format!("λ over path of contact and face width, {when}"))
        .height(360)
        .legend(false)
        .read_nearest()
        .x("position of the contact, mm")
        .y("face width, mm")
        .without_grid()
        .add(colours)
        .mark_path_points(points)
        .reading(reading);
    Some(chart)
}
