//! `report.html` of a comparison of models.

use gearwear::report::output_files;
use maud::{Markup, html};

use super::{LAST, PROFILES, RECOMMENDED, RUNS, front_figures, profile_figures, run_tables};
use crate::accuracy::record::{AccuracyRecord, CALIBRATION_FILE, ComparedQuantity, OVER_WIDTH_FILE};
use gearwear::report::html::number::{percent, significant};
use gearwear::report::html::page::{Page, Plots, section, sources_list};
use gearwear_physics::results::run::{ReportedBy, StopReason};

/// The data files named in the page, which lie beside it.
const DATA_FILES: [(&str, &str); 7] = [
    (LAST, "everything: the reference, every run with its errors, the recommendations"),
    (RUNS, "one row per run: settings, times, work, errors, fronts"),
    (PROFILES, "wear over both flanks, reference and runs of the finest resolution"),
    (OVER_WIDTH_FILE, "root wear over the face width, reference and runs of the finest resolution"),
    (output_files::SCENE, "the resolved scene"),
    (RECOMMENDED, "the scene of the recommended run of the wear profile"),
    (CALIBRATION_FILE, "the calibration that the runs read"),
];

pub(super) fn page(record: &AccuracyRecord) -> String {
    let mut charts = front_figures::all(record);
    charts.splice(1..1, profile_figures::all(record));
    let recommendation = html! {
        (reference(record))
        (run_tables::recommendations(record))
        @for of in &record.comparisons { (run_tables::comparison(of)) }
        (run_tables::deep_runs(record))
    };
    let runs = html! { (run_tables::runs(record)) (run_tables::left_out(record)) };
    let input = "The resolved scene, every default filled in";
    let plots = Plots::default();
    Page {
        kind: "Error against run time",
        title: &record.title,
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(record),
        interruption: (record.stopped != StopReason::Completed)
            .then(|| format!("The comparison was interrupted after {} runs; those are shown.", record.variants.len()))
            .as_deref(),
        warnings: &record.warnings,
        main: html! {
            (section("recommendation", "Recommendation", recommendation))
            (section("plots", "Error against run time", plots.show(&charts)))
            (section("runs", "All runs", runs))
            (section("sources", "Data and scene", sources_list(&data_files(record), input, &record.scene_toml)))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

fn reference(record: &AccuracyRecord) -> Markup {
    html! {
        p {
            "The reference is " (record.reference.how) "."
            @if let Some(open) = &record.reference.does_not_tell { " " (open) }
            " Run times are wall times of the wear run alone on " (record.threads) " thread"
            @if record.threads != 1 { "s" }
            ", each run by itself; a short run is repeated and its shortest time counts."
        }
    }
}

/// The files that are there.
fn data_files(record: &AccuracyRecord) -> Vec<(&'static str, &'static str)> {
    let written = DATA_FILES.into_iter().filter(|&(name, _)| match name {
        OVER_WIDTH_FILE => record.has_slices(),
        CALIBRATION_FILE => record.calibration_json.is_some(),
        RECOMMENDED => record.recommended_toml.is_some(),
        _ => true,
    });
    written.collect()
}

/// Recommendation, in a sentence or two.
fn answer(record: &AccuracyRecord) -> String {
    if let Some(not) = record.not_ranked(ComparedQuantity::WearProfile) {
        return format!(
            "No ranking by wear profile, and no recommendation: the reference itself is uncertain by {}, more than the {} wanted. \
             To converge, it needs: {}.",
            percent(not.uncertainty),
            percent(record.within),
            not.remedy
        );
    }
    let Some((is_within, variant, error, wall_s)) = record.recommended(ComparedQuantity::WearProfile) else {
        return "No run could be compared with the reference.".to_owned();
    };
    let reference = record.variants.first().and_then(|finest| finest.simulation_s);
    let against = reference.map_or_else(String::new, |reference_s| {
        format!(
            " The finest {} takes {} s, {} times as long.",
            if record.has_slices() { "run, that the reference begins with," } else { "finite-element run" },
            significant(reference_s, 3),
            significant(reference_s / wall_s, 2)
        )
    });
    let within = percent(record.within);
    let found = format!("{}: {} off in {} s.{against}", variant.name, percent(error), significant(wall_s, 3));
    if is_within {
        format!("The fastest run whose wear profile is within {within} of the reference on both gears is {found}")
    } else {
        format!("No run has a wear profile within {within} of the reference on both gears; the closest is {found}")
    }
}
