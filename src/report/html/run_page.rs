//! The page of a wear run.

use crate::report::output_files;
use maud::{Markup, html};

use super::page::{Page, Plots, fold, note, sources_list, stages_table, warnings};
use super::sliced::raster::{MOST_ACROSS, MOST_ALONG};
use super::sliced::{self, sliced_run::SlicedRun};
use super::table::{cells, line, list};
use super::{
    cycle_plots, drawing_plot, figures_table, film_plot, flank_plots, history_plot, reading, temperature_plot,
};
use crate::report::chart::Chart;
use gearwear_physics::results::run::{ReportedBy, RunRecord, Summary};

/// The data files named in the page, which lie beside it; one more where sections differ.
const DATA_FILES: [(&str, &str); 9] = [
    (output_files::SUMMARY, "the main figures"),
    (output_files::PINION, "the pinion’s flank, point by point"),
    (output_files::WHEEL, "the wheel’s flank, point by point"),
    (output_files::HISTORY, "the snapshots"),
    (output_files::PROFILES, "both flanks at every snapshot"),
    (output_files::MESH_CYCLE, "the mesh cycle"),
    (output_files::FLANK, "both flanks in space, for ParaView"),
    (output_files::COLUMNS, "what the columns of these tables hold"),
    (output_files::SCENE, "the resolved scene"),
];
const FILM_FILE: (&str, &str) = (output_files::FILM, "films and friction along the path of contact");
const TORQUE_CURVE_FILE: (&str, &str) = (output_files::TORQUE_CURVE, "transmission error over torque");
const SLICES_FILE: (&str, &str) = (output_files::SLICES, "the load of every slice over the mesh");

/// What the plots of a pair have in common.
pub const NOTE: &str = "A to E are the points of the path of contact: contact begins at A and ends at E, a \
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

/// The plots of a run by their subjects, in the order of its page.
pub(super) struct RunPlots {
    /// Wear and pressure on both flanks: what one looks at first.
    pub first: Vec<Chart>,
    pub over_width: Vec<Chart>,
    pub mesh_cycle: Vec<Chart>,
    pub over_time: Vec<Chart>,
    pub temperatures: Vec<Chart>,
    pub films: Vec<Chart>,
    pub pair: Vec<Chart>,
}

impl RunPlots {
    fn of(record: &RunRecord) -> Self {
        match SlicedRun::of(record) {
            Some(run) => sliced::plots(run),
            None => Self::of_equal_sections(record),
        }
    }

    fn of_equal_sections(record: &RunRecord) -> Self {
        let mut pair = vec![drawing_plot::pair(record)];
        pair.extend(flank_plots::modifications(record));
        Self {
            first: [flank_plots::wear(record), flank_plots::pressure(record)].concat(),
            over_width: Vec::new(),
            mesh_cycle: cycle_plots::all(record),
            over_time: vec![history_plot::wear_against_time(record)],
            temperatures: temperature_plot::all(record),
            films: film_plot::all(record),
            pair,
        }
    }
}

/// First the answer, wear and pressure as pictures, and the figures that a run is asked for, which printed are one sheet; then all else by its
/// subject behind headings.
pub fn page(record: &RunRecord) -> String {
    let s = &record.summary;
    let shown = RunPlots::of(record);
    let plots = Plots::default();
    let legend = if record.slices.is_some() { sliced_note() } else { NOTE.to_owned() };
    let first = html! { div.first { (plots.show(&shown.first)) } };
    let subject = |id: &str, heading: &str, words: Markup, charts: &[Chart]| {
        let is_empty = words.0.is_empty() && charts.is_empty();
        html! { @if !is_empty { (fold(id, heading, html! { (words) @if !charts.is_empty() { (plots.show(charts)) } })) } }
    };
    let of_lubrication = s.lubrication.as_ref().map(|_| figures_table::films(s)).unwrap_or_default();
    let of_temperature = s.temperature.as_ref().map(|_| figures_table::temperatures(s)).unwrap_or_default();
    let main = html! {
        (first)
        (warnings(&s.warnings))
        section.figures aria-label="Main figures" {
            (figures_table::main_figures(s))
            (note(&reading::remarks(record)))
        }
        (subject("wear-law", "Wear over time, wear law", figures_table::wear_and_law(s), &shown.over_time))
        (subject("over-width", "Over the face width", figures_table::over_width(s), &shown.over_width))
        (subject("mesh-cycle", "Load, pressure and transmission error over the mesh", html! { (note(&legend)) (figures_table::mesh_cycle(s)) }, &shown.mesh_cycle))
        (subject("temperatures", "Temperatures", of_temperature, &shown.temperatures))
        (subject("films", "Oil, films, friction and losses", of_lubrication, &shown.films))
        (subject("gears", "Pair and gears: geometry, modifications, stiffness, root stress", figures_table::pair_and_gears(s), &shown.pair))
        (subject("errors", "Error of the result", figures_table::errors(&s.error), &[]))
        (subject("work", "How it was computed", work(s), &[]))
        (subject("sources", "Data and scene", sources(record), &[]))
    };
    Page {
        kind: "Wear of a gear pair",
        title: &s.title,
        byline: &s.report.as_ref().map(ReportedBy::line).unwrap_or_default(),
        answer: &reading::answer(record),
        interruption: reading::interruption(s).as_deref(),
        // They stand below the pictures.
        warnings: &[],
        main,
        plots,
        footer: &format!("gearwear {} · scene {}", s.program_version, s.scene_hash),
    }
    .html()
}

/// The plots of a run, in the order of its page.
pub fn charts(record: &RunRecord) -> Vec<Chart> {
    let RunPlots { first, over_width, mesh_cycle, over_time, temperatures, films, pair } = RunPlots::of(record);
    [first, over_time, over_width, mesh_cycle, temperatures, films, pair].concat()
}

/// How the run came about: stages with their times, work done, stages left out.
fn work(s: &Summary) -> Markup {
    let w = &s.work;
    let counts = [
        ("Wear steps", w.wear_steps),
        ("Rejected steps", w.rejected_steps),
        ("Mesh cycles for the stability of the wear step", w.jacobian_probes),
        ("Mesh cycles", w.mesh_cycles),
        ("Equilibria", w.equilibria),
        ("Newton iterations", w.newton_iterations),
        ("Contact evaluations", w.pair_evaluations),
    ];
    html! {
        div.tables {
            (stages_table(&s.stages, s.wall_s))
            (list("Computational work of the simulation", ["", "count"], counts.map(|(name, number)| line(cells![name, number]))))
            @if !s.left_out.is_empty() {
                div {
                    h3 { "Stages left out" }
                    dl { @for stage in &s.left_out { dt { (stage.name) } dd { (stage.reason) } } }
                }
            }
        }
    }
}

fn sources(record: &RunRecord) -> Markup {
    let mut files = DATA_FILES.to_vec();
    if record.slices.is_some() {
        files.push(SLICES_FILE);
    }
    if !record.film.is_empty() {
        files.push(FILM_FILE);
    }
    if !record.torque_curve.is_empty() {
        files.push(TORQUE_CURVE_FILE);
    }
    sources_list(&files, "The resolved scene, every default filled in", &record.scene_toml)
}
