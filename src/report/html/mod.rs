//! `report.html`: one page that holds everything it needs, and asks the network for nothing.
//!
//! The page is its words and tables in plain HTML, one JSON description per plot, plotly.js, and a short script
//! (`page.js`) that draws the plots in the colours of the style sheet (`page.css`) for light, dark and paper.

pub mod active_flank;
mod cycle_plots;
mod drawing_plot;
pub mod field_plot;
pub mod figures_table;
mod flank_plots;
mod history_plot;
pub mod law_table;
pub mod number;
pub mod page;
mod phase_table;
pub mod reading;
mod sliced;
pub mod table;
mod temperature_plot;
pub mod theme;

use self::page::{Page, escape, plots, section, sources_list, stages_table};
use self::sliced::SlicedRun;
use self::sliced::raster::{MOST_ACROSS, MOST_ALONG};
use self::theme::Figure;
use crate::results::run::{RunRecord, Summary};

/// The data files named in the page, which lie beside it; two more where sections differ.
const DATA_FILES: [(&str, &str); 7] = [
    ("summary.json", "the main figures"),
    ("pinion.csv", "the pinion’s flank, point by point"),
    ("wheel.csv", "the wheel’s flank, point by point"),
    ("history.csv", "the snapshots"),
    ("profiles.csv", "both flanks at every snapshot"),
    ("mesh_cycle.csv", "the mesh cycle"),
    ("scene.toml", "the resolved scene"),
];
const SLICED_FILES: [(&str, &str); 2] =
    [("slices.csv", "the load of every slice over the mesh"), ("flank.vtu", "both flanks in space, for ParaView")];

/// What the plots of a pair have in common.
const NOTE: &str = "A to E are the points of the path of contact: contact begins at A and ends at E, a \
     tooth pair carries the load alone between B and D where no more than two pairs share it, and C is the pitch \
     point. The contact position is the radius of curvature of the pinion’s flank at the theoretical contact \
     point.";

/// The same where the sections differ.
fn sliced_note() -> String {
    format!(
        "A to E are the points of the path of contact in a transverse section: contact of a slice begins at A and ends at E, and C is \
         the pitch point. The contact position is the radius of curvature of the pinion’s flank at the theoretical contact point; \
         where that differs between slices, it is the one in the middle of the face width. With a positive helix angle a tooth enters \
         the mesh at width 0. Maps and surfaces show at most {MOST_ALONG} cells from root to tip and {MOST_ACROSS} over the face \
         width, each with the greatest of its values; the data files hold every point."
    )
}

/// The whole page.
pub fn page(record: &RunRecord) -> String {
    let s = &record.summary;
    let figures = match SlicedRun::of(record) {
        Some(run) => sliced::figures(run),
        None => figures_of_equal_sections(record),
    };
    let note = if record.slices.is_some() { sliced_note() } else { NOTE.to_owned() };
    let sections = [
        section(
            "figures",
            "Main figures",
            &format!(
                "<div class=\"tables\">\n{}</div>\n{}{}{}",
                figures_table::tables(record),
                phase_table::table(s),
                law_table::note(s),
                figures_table::errors(&s.error)
            ),
        ),
        section("plots", "Plots", &format!("<p class=\"legend-note\">{note}</p>\n{}", plots(&figures))),
        work(s),
        sources(record),
    ];
    Page {
        kind: "Wear of a gear pair",
        title: &s.title,
        answer: &reading::answer(record),
        interruption: reading::interruption(s).as_deref(),
        warnings: &s.warnings,
        main: &sections.concat(),
        footer: &format!("gearwear {} · scene {}", s.program_version, s.scene_hash),
    }
    .html()
}

/// The plots of a pair whose sections are all alike.
fn figures_of_equal_sections(record: &RunRecord) -> Vec<Figure> {
    let mut figures = vec![drawing_plot::pair(record)];
    figures.extend(flank_plots::wear(record));
    figures.extend(flank_plots::pressure(record));
    figures.extend(cycle_plots::all(record));
    figures.extend(temperature_plot::all(record));
    figures.push(history_plot::wear_against_time(record));
    figures.extend(flank_plots::modifications(record));
    figures
}

/// How the run came about: stages with their times, stages left out, work done.
fn work(s: &Summary) -> String {
    let left_out: String = s
        .left_out
        .iter()
        .map(|stage| format!("<dt>{}</dt><dd>{}</dd>\n", escape(&stage.name), escape(&stage.reason)))
        .collect();
    let left_out = if left_out.is_empty() {
        String::new()
    } else {
        format!("<div><h3>Stages left out</h3>\n<dl>\n{left_out}</dl></div>\n")
    };
    let w = &s.work;
    let counts: String = [
        ("Wear steps", w.wear_steps),
        ("Rejected steps", w.rejected_steps),
        ("Mesh cycles to learn the stiffness", w.jacobian_probes),
        ("Mesh cycles", w.mesh_cycles),
        ("Equilibria", w.equilibria),
        ("Newton iterations", w.newton_iterations),
        ("Contact evaluations", w.pair_evaluations),
    ]
    .map(|(name, count)| format!("<tr><th scope=\"row\">{name}</th><td>{}</td></tr>\n", number::count(count)))
    .concat();
    let tables = format!(
        "<div class=\"tables\">\n{}\
         <table>\n<caption>Work of the simulation</caption>\n<thead><tr><td></td><th scope=\"col\">count</th></tr></thead>\n\
         <tbody>\n{counts}</tbody>\n</table>\n{left_out}</div>\n",
        stages_table(&s.stages, s.wall_s)
    );
    section("work", "How it was computed", &tables)
}

/// The data files and the scene.
fn sources(record: &RunRecord) -> String {
    let mut files = DATA_FILES.to_vec();
    if record.slices.is_some() {
        files.extend(SLICED_FILES);
    }
    section(
        "sources",
        "Data and scene",
        &sources_list(&files, "The resolved scene, every default filled in", &record.scene_toml),
    )
}
