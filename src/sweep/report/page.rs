//! `report.html` of a sweep.

use crate::report::output_files;
use maud::{Markup, html};

#[cfg(feature = "parquet")]
use super::PARQUET;
use super::best_tables::shown_value;
use super::section_plane::{differs, varied};
use super::{COMBINATIONS, LAST, best_tables, contour_figures, line_figures};
use crate::evaluate::figure::{self, StudyFigure};
use crate::journal;
use crate::report::chart::Chart;
use crate::report::html::number::{count, figure as shown_number, given, significant};
use crate::report::html::page::{Page, Plots, fold, section, sources_list};
use crate::sweep::record::SweepRecord;
use crate::sweep::verification::SweepVerification;
use gearwear_bodies::reference::steel_yield;
use gearwear_physics::results::run::ReportedBy;

const DATA_FILES: &[(&str, &str)] = &[
    (COMBINATIONS, "one row per combination: varied values, figures, times, errors, verification"),
    #[cfg(feature = "parquet")]
    (PARQUET, "the same table as Parquet"),
    (LAST, "the sweep, its counts and the best combinations"),
    (journal::FILE_NAME, "the rows as they were finished; a restart reads it"),
    (output_files::SCENE, "the scene as given"),
];

/// Plots at the beginning of the page.
const SHOWN_FIRST: usize = 4;

/// Figures whose least value is given at the top of the page, where there is one.
const HEADLINES: [&str; 3] = ["helical.wear.pinion.root_tip_variation", "pinion.peak_wear_um", "sun.peak_wear_um"];

pub(super) fn page(record: &SweepRecord) -> String {
    let charts = figures(record);
    let (first, others) = charts.split_at(charts.len().min(SHOWN_FIRST));
    let identity = &record.identity;
    let sources = sources_list(DATA_FILES, "The scene as given", &record.scene_toml);
    let plots = Plots::default();
    Page {
        kind: "Sweep",
        title: &identity.title,
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(record),
        interruption: None,
        warnings: &pressure_warning(record).into_iter().collect::<Vec<_>>(),
        main: html! {
            @if !first.is_empty() { div.first { (plots.show(first)) } }
            @if let Some(optimum) = record.optimum() { (section("optimum", "Optimum", best_tables::optimum(identity.kind, &optimum))) }
            (fold("figures", "Each figure, and where its minimum is", best_tables::best(record)))
            @if record.failed() > 0 { (fold("failed", "Combinations without a result", best_tables::failed(record))) }
            @if let Some(verification) = record.verification() { (verified(record, &verification)) }
            @if !others.is_empty() { (fold("plots", "Plots of the other figures", plots.show(others))) }
            (fold("work", "How it was computed", work(record)))
            (fold("sources", "Data and scene", sources))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", identity.program_version, identity.scene_hash),
    }
    .html()
}

/// Figures to minimise that are not constant, those of the first words of a run before the others.
fn shown(record: &SweepRecord) -> impl Iterator<Item = &'static StudyFigure> + use<> {
    let all = figure::in_sweeps(record.identity.kind).iter();
    let mut shown: Vec<&StudyFigure> =
        all.filter(|figure| figure.less_is_better() && differs(record, figure)).collect();
    // Those that a run begins with come first.
    shown.sort_by_key(|figure| !figure.in_headline());
    shown.into_iter()
}

fn figures(record: &SweepRecord) -> Vec<Chart> {
    match varied(record).as_slice() {
        [] => Vec::new(),
        [x] => shown(record).filter_map(|figure| line_figures::along(record, figure, x)).collect(),
        [x, y, ..] => shown(record).filter_map(|figure| contour_figures::contour(record, figure, x, y)).collect(),
    }
}

/// Warns where the pressure of any combination is above the hardness of steel, of the one where it is greatest.
fn pressure_warning(record: &SweepRecord) -> Option<String> {
    let figures = figure::in_sweeps(record.identity.kind).iter();
    let pressures = figures.filter_map(|figure| {
        let when = figure.name.strip_suffix(".flank_pressure_MPa")?;
        Some((figure, when.rsplit('.').next().unwrap_or(when)))
    });
    let pressures = pressures.flat_map(|(figure, when)| {
        record.rows.iter().filter_map(move |row| Some((row.figure(figure)?, when, row.index)))
    });
    let (pressure_mpa, when, index) = pressures.max_by(|a, b| a.0.total_cmp(&b.0))?;
    steel_yield::warning(pressure_mpa, &format!("{when}, combination {index}"))
}

fn answer(record: &SweepRecord) -> String {
    let identity = &record.identity;
    let keys: Vec<String> = identity
        .axes
        .iter()
        .map(|axis| match axis.count {
            1 => axis.name_and_value(&shown_value(axis, axis.from)),
            _ if axis.words().is_some() => axis.name_and_value(&axis.words().unwrap_or_default().join(" or ")),
            n => {
                let (name, unit) = axis.name_and_unit();
                let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
                format!("{name} from {} to {}{unit} ({n} values)", given(axis.from), given(axis.to))
            }
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
        .filter(|figure| HEADLINES.contains(&figure.name.as_str()))
        .filter_map(|figure| record.least(figure).map(|(row, least)| (figure, row, least)))
    {
        let place: Vec<String> = identity
            .axes
            .iter()
            .zip(&row.values)
            .map(|(axis, &value)| axis.name_and_value(&shown_value(axis, value)))
            .collect();
        text.push_str(&format!(
            " Lowest {}: {}{}{}, at {}.",
            figure.heading,
            shown_number(least),
            if figure.unit().is_empty() { "" } else { " " },
            figure.unit(),
            place.join(" and ")
        ));
    }
    if let Some(goal) = &identity.goal
        && record.optimum().is_none()
    {
        text.push_str(&format!(" No combination has {}.", goal.in_words()));
    }
    text.push_str(&verification_sentence(record));
    text
}

/// Result of the verification by finite elements, in a sentence.
fn verification_sentence(record: &SweepRecord) -> String {
    let Some(verification) = record.verification() else {
        return " None of them is verified by finite elements.".to_owned();
    };
    match (verification.verified, verification.worst_of_peak_wear()) {
        (0, _) | (_, None) => " Finite elements verify none of them.".to_owned(),
        (n, Some(worst)) => format!(
            " Finite elements verified {} of them: the maximum wear of each is within {}.",
            count(n as u64),
            best_tables::within(worst)
        ),
    }
}

fn verified(record: &SweepRecord, verification: &SweepVerification<'_>) -> Markup {
    let SweepVerification { intention, chosen, verified, open, .. } = verification;
    let content = html! {
        p {
            "Finite elements verify " (intention) ". Of the " (chosen) " chosen, " (verified) " have an answer."
            @if *open > 0 {
                " " (open) " are not verified yet: gearwear sweep of the same scene and keys, with the folder of this page as --out, \
                 does it."
            }
        }
        @if !verification.rows.is_empty() { (best_tables::verified(record, verification)) }
    };
    fold("verification", "Verification by finite elements", content)
}

fn work(record: &SweepRecord) -> Markup {
    let summary = record.summary();
    let threads = match record.threads {
        0 => "It was run elsewhere, by several processes or in parts.".to_owned(),
        1 => format!("The last start took {} s on one thread.", significant(record.wall_s, 3)),
        n => format!("The last start took {} s on {n} threads.", significant(record.wall_s, 3)),
    };
    let estimates = if record.identity.error_estimate {
        "Errors were estimated in each."
    } else {
        "Error estimates and snapshots were left out; gearwear run of one combination has them."
    };
    let verification = match &summary.verification {
        Some(verification) => format!("The verifications took {} s together.", significant(verification.wall_s, 3)),
        None => "No combination was verified by finite elements; numerics.verify = true in the scene has the best and the corners \
                 verified, and gearwear run any one of them."
            .to_owned(),
    };
    html! {
        p {
            "Each combination is the scene with the varied values exchanged, run by itself on one thread; together they took "
            (significant(summary.combinations_wall_s, 3)) " s. " (verification) " " (threads) " " (estimates)
        }
    }
}
