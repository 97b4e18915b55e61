//! Plots of the film of oil, of λ and of the friction along the path of contact, new and worn.

use super::number::{figure, significant};
use crate::report::chart::Chart;
use gearwear_physics::results::lubrication::{FilmRow, LubricationSummary};
use gearwear_physics::results::path_points::among;
use gearwear_physics::results::run::RunRecord;

type Column = fn(&FilmRow) -> Option<f64>;

/// All of them; none where nobody asks for films or losses.
pub(super) fn all(record: &RunRecord) -> Vec<Chart> {
    let Some(summary) = &record.summary.lubrication else { return Vec::new() };
    let rows = in_the_middle(record);
    if rows.is_empty() {
        return Vec::new();
    }
    let films = summary.film.is_some().then(|| [film(record, &rows), lambda(record, summary, &rows)]);
    films.into_iter().flatten().chain([friction(record, summary, &rows)]).collect()
}

/// Rows of the slice in the middle of the face width, or of the whole width where all sections are alike.
fn in_the_middle(record: &RunRecord) -> Vec<&FilmRow> {
    let last = record.film.iter().map(|row| row.slice).max().unwrap_or(0);
    record.film.iter().filter(|row| row.slice == last / 2).collect()
}

/// Where over the face width the curves are.
fn where_over_width(record: &RunRecord, rows: &[&FilmRow]) -> String {
    match record.slices {
        Some(_) => format!(" Curves are of the slice at width {} mm.", significant(rows[0].width_mm, 3)),
        None => String::new(),
    }
}

fn over_path(record: &RunRecord, chart: Chart, rows: &[&FilmRow], columns: [Column; 2], hover: &str) -> Chart {
    let x: Vec<f64> = rows.iter().map(|row| row.position_mm).collect();
    let top = rows.iter().flat_map(|row| columns.map(|of| of(row).unwrap_or(0.0))).fold(0.0, f64::max);
    let [new, worn] = columns.map(|of| rows.iter().map(|row| of(row).unwrap_or(f64::NAN)).collect());
    chart.over_path(&record.summary.geometry.curvature_radius_mm).y_up_to(top).new_and_worn(&x, new, worn, hover)
}

fn film(record: &RunRecord, rows: &[&FilmRow]) -> Chart {
    let chart = Chart::new("film", "Local film thickness").y("film thickness, µm").reading(format!(
        "The local film of ISO/TS 6336-22 under the load and pressure of the run’s own contact.{}",
        where_over_width(record, rows)
    ));
    over_path(record, chart, rows, [|row| row.local_film_new_um, |row| row.local_film_worn_um], "%{y:.4f} µm")
}

fn lambda(record: &RunRecord, summary: &LubricationSummary, rows: &[&FilmRow]) -> Chart {
    let points = record.summary.geometry.curvature_radius_mm.named();
    let reading = summary.film.as_ref().map_or_else(String::new, |film| {
        format!(
            "The minimum of λ, film over mean roughness, is {} new, {}, and {} worn, {}. Below about 1 the asperities carry part of the load; above \
             about 2 the film carries it.{}",
            figure(film.lambda_new.min),
            among(&points, film.least_lambda_new_position_mm),
            figure(film.lambda_worn.min),
            among(&points, film.least_lambda_worn_position_mm),
            where_over_width(record, rows)
        )
    });
    let chart = Chart::new("lambda", "Film over roughness λ").y("λ").reading(reading);
    over_path(record, chart, rows, [|row| row.lambda_new, |row| row.lambda_worn], "%{y:.3f}")
}

/// Pressure up to which Xu's regression holds, MPa.
const XU_HOLDS_TO_MPA: f64 = 2500.0;

/// What to say where the friction of Xu's regression is that of a pressure above those it was fitted to.
fn limit_of_xu(record: &RunRecord, summary: &LubricationSummary) -> String {
    let pressure = record.summary.new.peak_pressure_MPa.max(record.summary.worn.peak_pressure_MPa);
    if summary.friction.model != "xu" || pressure <= XU_HOLDS_TO_MPA {
        return String::new();
    }
    format!(
        " Xu’s regression holds up to {} MPa: at the tip edges the pressure is higher, and the low friction there is outside its range.",
        figure(XU_HOLDS_TO_MPA)
    )
}

fn friction(record: &RunRecord, summary: &LubricationSummary, rows: &[&FilmRow]) -> Chart {
    let (friction, losses) = (&summary.friction, &summary.losses);
    let chart = Chart::new("friction", "Coefficient of friction").y("coefficient of friction").reading(format!(
        "By friction.model = \"{}\", {} on average over the work of sliding new, {} worn. The mesh loses {} W of {} W new and {} W worn.{}{}",
        friction.model,
        significant(friction.mean_new, 3),
        significant(friction.mean_worn, 3),
        figure(losses.mesh_power_loss_new_W),
        figure(losses.power_W),
        figure(losses.mesh_power_loss_worn_W),
        limit_of_xu(record, summary),
        where_over_width(record, rows)
    ));
    over_path(record, chart, rows, [|row| row.friction_new, |row| row.friction_worn], "%{y:.4f}")
}
