//! `report.html` of a comparison of models.

use super::{OVER_WIDTH, front_figures, has_slices, profile_figures, run_tables};
use crate::report::html::number::{percent, significant};
use crate::report::html::page::{Page, escape, plots, section, sources_list};
use crate::results::run::StopReason;
use crate::studies::accuracy::record::{AccuracyRecord, CALIBRATION_FILE, Quantity};

/// The data files named in the page, which lie beside it.
const DATA_FILES: [(&str, &str); 7] = [
    ("accuracy.json", "everything: the reference, every run with its errors, the recommendations"),
    ("accuracy.csv", "one row per run: settings, times, work, errors, fronts"),
    ("wear_profiles.csv", "wear over both flanks, reference and runs of the finest resolution"),
    (OVER_WIDTH, "root wear over the face width, reference and runs of the finest resolution"),
    ("scene.toml", "the resolved scene"),
    ("recommended.toml", "the scene of the recommended run of the wear profile"),
    ("calibration.json", "the calibration that the runs read"),
];

/// The whole page.
pub fn page(record: &AccuracyRecord) -> String {
    let mut figures = front_figures::all(record);
    figures.splice(1..1, profile_figures::all(record));
    let reference = format!(
        "<p>The reference is {}.{} Run times are wall times of the wear run alone on {} thread{}, each run by itself; a short \
         run is repeated and its least time counts.</p>\n",
        escape(&record.reference.how),
        record.reference.does_not_tell.as_ref().map_or_else(String::new, |open| format!(" {}", escape(open))),
        record.threads,
        if record.threads == 1 { "" } else { "s" }
    );
    let sections = [
        section(
            "recommendation",
            "Recommendation",
            &[
                reference,
                run_tables::recommendations(record),
                run_tables::comparisons(record),
                run_tables::deep_runs(record),
            ]
            .concat(),
        ),
        section("plots", "Error against run time", &plots(&figures)),
        section("runs", "All runs", &[run_tables::runs(record), run_tables::left_out(record)].concat()),
        section(
            "sources",
            "Data and scene",
            &sources_list(&data_files(record), "The resolved scene, every default filled in", &record.scene_toml),
        ),
    ];
    Page {
        kind: "Error against run time",
        title: &record.title,
        answer: &answer(record),
        interruption: (record.stopped != StopReason::Completed)
            .then(|| format!("The comparison was interrupted after {} runs; those are shown.", record.variants.len()))
            .as_deref(),
        warnings: &record.warnings,
        main: &sections.concat(),
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

/// The files that are there.
fn data_files(record: &AccuracyRecord) -> Vec<(&'static str, &'static str)> {
    let missing = |name: &str| {
        name == OVER_WIDTH && !has_slices(record)
            || name == CALIBRATION_FILE && record.calibration_json.is_none()
            || name == "recommended.toml" && record.recommended_toml.is_none()
    };
    DATA_FILES.into_iter().filter(|(name, _)| !missing(name)).collect()
}

/// What to use, in a sentence or two.
fn answer(record: &AccuracyRecord) -> String {
    let chosen = record.recommendations.iter().find(|r| r.quantity == Quantity::WearProfile);
    let chosen = chosen.and_then(|r| {
        let variant = record.variants.get(r.variant)?;
        Some((r.is_within, variant, variant.errors.get(&Quantity::WearProfile)?.relative, variant.simulation_s?))
    });
    let Some((is_within, variant, error, wall_s)) = chosen else {
        return "No run could be compared with the reference.".to_owned();
    };
    let reference = record.variants.first().and_then(|finest| finest.simulation_s);
    let against = reference.map_or_else(String::new, |reference_s| {
        format!(
            " The finest {} takes {} s, {} times as long.",
            if has_slices(record) { "run, that the reference begins with," } else { "finite-element run" },
            significant(reference_s, 3),
            significant(reference_s / wall_s, 2)
        )
    });
    if is_within {
        format!(
            "The cheapest run whose wear profile is within {} of the reference on both gears is {}: {} off in {} s.{against}",
            percent(record.within),
            variant.name,
            percent(error),
            significant(wall_s, 3)
        )
    } else {
        format!(
            "No run has a wear profile within {} of the reference on both gears; the closest is {}: {} off in {} s.{against}",
            percent(record.within),
            variant.name,
            percent(error),
            significant(wall_s, 3)
        )
    }
}
