//! `report.html` of a sweep.

use super::section_plane::{differs, varied};
use super::{best_tables, contour_figures, line_figures};
use crate::report::html::number::{count, figure as shown_number, given, significant};
use crate::report::html::page::{Page, escape, plots, section, sources_list};
use crate::report::html::theme::Figure;
use crate::simulation::sweep_figures::{FIGURES, SweepFigure};
use crate::simulation::sweep_record::SweepRecord;

/// The data files named in the page, which lie beside it.
const DATA_FILES: &[(&str, &str)] = &[
    ("sweep.csv", "one row per combination: varied values, figures, times, errors"),
    #[cfg(feature = "parquet")]
    ("sweep.parquet", "the same table as Parquet"),
    ("sweep.json", "the sweep, its counts and the best combinations"),
    ("rows.jsonl", "the rows as they were finished; a restart reads it"),
    ("scene.toml", "the scene as given"),
];

/// Figures whose least value is said at the top of the page, where there is one.
const HEADLINES: [&str; 2] = ["pinion_root_tip_wear_variation", "pinion_peak_wear_um"];

/// The whole page.
pub fn page(record: &SweepRecord) -> String {
    let figures = figures(record);
    let drawn = if figures.is_empty() { String::new() } else { section("plots", "Plots", &plots(&figures)) };
    let identity = &record.identity;
    let sections = [
        section("figures", "Main figures", &[best_tables::best(record), best_tables::failed(record)].concat()),
        drawn,
        section("work", "How it was computed", &work(record)),
        section("sources", "Data and scene", &sources_list(DATA_FILES, "The scene as given", &record.scene_toml)),
    ];
    Page {
        kind: "Sweep",
        title: &identity.title,
        answer: &answer(record),
        interruption: None,
        warnings: &[],
        main: &sections.concat(),
        footer: &format!("gearwear {} · scene {}", identity.program_version, identity.scene_hash),
    }
    .html()
}

/// The figures that one wants to be small and that are not the same everywhere.
fn shown(record: &SweepRecord) -> impl Iterator<Item = &'static SweepFigure> + '_ {
    FIGURES.iter().filter(|figure| figure.less_is_better && differs(record, figure))
}

fn figures(record: &SweepRecord) -> Vec<Figure> {
    match varied(record).as_slice() {
        [] => Vec::new(),
        [x] => shown(record).filter_map(|figure| line_figures::along(record, figure, x)).collect(),
        [x, y, ..] => shown(record).filter_map(|figure| contour_figures::contour(record, figure, x, y)).collect(),
    }
}

fn answer(record: &SweepRecord) -> String {
    let identity = &record.identity;
    let keys: Vec<String> = identity
        .axes
        .iter()
        .map(|axis| match axis.count {
            1 => format!("{} = {}", axis.key, given(axis.from)),
            n => format!("{} from {} to {} ({n} values)", axis.key, given(axis.from), given(axis.to)),
        })
        .collect();
    let failed = record.failed();
    let without = match failed {
        0 => String::new(),
        _ => format!(", {} of them without a result", count(failed as u64)),
    };
    let mut text =
        format!("{} combinations of {}{without}.", count(identity.combinations() as u64), keys.join(" and "));
    for (figure, row, least) in shown(record)
        .filter(|figure| HEADLINES.contains(&figure.name))
        .filter_map(|figure| record.least(figure).map(|(row, least)| (figure, row, least)))
    {
        let place: Vec<String> = identity
            .axes
            .iter()
            .zip(&row.values)
            .map(|(axis, &value)| format!("{} = {}", axis.key, given(value)))
            .collect();
        text.push_str(&format!(
            " The {} is least, {}{}{}, at {}.",
            figure.title,
            shown_number(least),
            if figure.unit.is_empty() { "" } else { " " },
            figure.unit,
            place.join(" and ")
        ));
    }
    text
}

fn work(record: &SweepRecord) -> String {
    let summary = record.summary();
    let threads = match record.threads {
        0 => "It was merged from parts that were run elsewhere.".to_owned(),
        1 => format!("The last start took {} s on one thread.", significant(record.wall_s, 3)),
        n => format!("The last start took {} s on {n} threads.", significant(record.wall_s, 3)),
    };
    let estimates = if record.identity.error_estimate {
        "Errors were estimated in each."
    } else {
        "Error estimates and snapshots were left out; gearwear run of one combination has them."
    };
    format!(
        "<p>Each combination is the scene with the varied values exchanged, run by itself on one thread; together they took {} s. \
         {threads} {}</p>\n",
        significant(summary.combinations_wall_s, 3),
        escape(estimates)
    )
}
