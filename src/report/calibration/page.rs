//! The page beside a calibration file.

use maud::html;

use super::{foundation_figures, stiffness_figures, tables, wear_figure};
use crate::report::html::number::{figure, percent};
use crate::report::html::page::{self, Page, Plots, section, sources_list, stages_table};
use crate::report::html::run_page::NOTE;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::contact::settings::MatchCriterion;
use gearwear_physics::results::run::StageTime;

/// The whole page; `file` is the name of the calibration file.
pub(super) fn page(calibration: &Calibration, stages: &[StageTime], [title, byline]: [&str; 2], file: &str) -> String {
    let mut charts = stiffness_figures::all(calibration);
    charts.extend(foundation_figures::all(calibration));
    charts.extend(wear_figure::all(calibration));
    let wall_s = stages.iter().map(|stage| stage.wall_s).sum();
    let belongs_to = serde_json::to_string_pretty(&calibration.belongs_to).unwrap_or_default();
    // As many digits of a hash as one compares by eye.
    let hash = calibration.hash.get(..16).unwrap_or(&calibration.hash);
    let files = [(file, "all numbers, as scenes read them")];
    let plots = Plots::default();
    Page {
        kind: "Calibration of a gear pair by finite elements",
        title,
        byline,
        answer: &answer(calibration),
        interruption: None,
        warnings: &[],
        main: html! {
            (section("figures", "Main figures", page::tables(tables::tables(calibration))))
            (section("plots", "Plots", html! { (page::note(NOTE)) (plots.show(&charts)) }))
            (section("work", "How it was computed", page::tables([stages_table(stages, wall_s)])))
            (section("sources", "Data", sources_list(&files, "What it belongs to", &belongs_to)))
        },
        plots,
        footer: &format!("gearwear {} · calibration {}", calibration.program_version, hash),
    }
    .html()
}

fn answer(calibration: &Calibration) -> String {
    let mut text = calibration.deflection_at_points[2].as_ref().map_or_else(String::new, |at| {
        format!(
            "At the pitch point the tooth pair has a stiffness of {} N/(mm·µm) under {} N/mm, flattening included. ",
            figure(at.pair_n_per_mm_um()),
            figure(calibration.line_load_n_per_mm)
        )
    });
    if let Some(fit) = calibration.foundation_fit.get(&MatchCriterion::HalfWidth) {
        text.push_str(&format!(
            "A Winkler foundation calibrated on the half-width meets that of finite elements within {} at positions and loads that \
             were held out, and its maximum pressure is {} too high.",
            percent(fit.held_out.worst_matched),
            percent(fit.held_out.mean_peak_pressure)
        ));
    }
    text
}
