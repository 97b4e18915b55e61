//! `report.html` of a study of uncertainty.

use crate::report::output_files;
use maud::{Markup, html};

use super::{LAST, SAMPLES, figures};
use crate::journal;
use crate::report::html::number::{count, figure, fixed, percent, significant};
use crate::report::html::page::{Page, Plots, fold, note, section, sources_list};
use crate::report::html::table::{Cell, NONE, cells, line, list};
use crate::uncertainty::record::UncertaintyRecord;
use gearwear_bodies::reference::sobol_indices::Index;

const DATA_FILES: &[(&str, &str)] = &[
    (SAMPLES, "one row per sample: values of the keys, figures, whether it was run, errors"),
    (LAST, "distributions, quantiles, indices, bands"),
    (output_files::SCENE, "the scene as given"),
    (journal::FILE_NAME, "the runs as they were finished; a restart reads it"),
];

pub(super) fn page(record: &UncertaintyRecord) -> String {
    let plots = Plots::default();
    let shown = figures::of(record);
    let interruption = (record.runs < record.runs_asked).then(|| {
        format!(
            "Figures of the first {} of {} samples: the study goes on, or was interrupted.",
            count(record.runs as u64),
            count(record.runs_asked as u64)
        )
    });
    let warnings: Vec<String> = record
        .first_failure
        .iter()
        .map(|first| {
            let (failed, runs) = (count(record.failed as u64), count(record.runs as u64));
            format!("{failed} of {runs} samples failed and are in none of the figures; the first: {first}")
        })
        .collect();
    Page {
        kind: "Uncertainty",
        title: &record.title,
        byline: "",
        answer: &answer(record),
        interruption: interruption.as_deref(),
        warnings: &warnings,
        main: html! {
            @if !shown.first.is_empty() { div.first { (plots.show(&shown.first)) } }
            (section("figures", "Main figures", quantiles(record)))
            (fold("uncertain", "What is uncertain", uncertain(record)))
            (fold("indices", "What the scatter comes from: Sobol indices", html! { (plots.show(&shown.indices)) (indices(record)) }))
            @if !shown.others.is_empty() { (fold("plots", "Distributions of the other figures, wear over the flanks", plots.show(&shown.others))) }
            (fold("work", "How it was computed", work(record)))
            (fold("sources", "Data and scene", sources_list(DATA_FILES, "The scene as given", &record.scene_toml)))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

fn answer(record: &UncertaintyRecord) -> String {
    let ranges = record.outputs.iter().take(2).filter_map(|output| {
        let (p05, p95) = (output.quantiles.p05?, output.quantiles.p95?);
        (p95 > p05).then(|| format!("{}: {} to {} {}", output.meaning, figure(p05), figure(p95), output.unit))
    });
    let ranges: Vec<String> = ranges.collect();
    let most = record.outputs.iter().find_map(|output| {
        let most = output.indices.as_ref()?.iter().max_by(|a, b| a.total.value.total_cmp(&b.total.value))?;
        Some(format!(" Most of the scatter of the first comes from {}.", most.factor))
    });
    let quantiles = match ranges.as_slice() {
        [] => "No figure has quantiles.".to_owned(),
        _ => format!("{} (nine of ten samples).", ranges.join("; ")),
    };
    format!("{quantiles}{}", most.unwrap_or_default())
}

fn uncertain(record: &UncertaintyRecord) -> Markup {
    let rows = record.uncertain.iter().map(|one| line(cells![one.key.as_str(), one.given.as_str()]));
    html! {
        (list("Uncertain keys", ["key", "distribution"], rows))
        @if let Some(matrix) = &record.correlation {
            (list(
                "Correlation of their normal scores",
                [""].into_iter().chain(record.uncertain.iter().map(|one| one.key.as_str())),
                record.uncertain.iter().zip(matrix).map(|(one, row)| {
                    line([Cell::from(one.key.as_str())].into_iter().chain(row.iter().map(|r| Cell::from(significant(*r, 3)))))
                }),
            ))
        }
        (note(&format!("Error of the scene as given: {}.", record.model_error_how.trim_end_matches('.'))))
        (note(&format!("Contact surface of the samples: {}, as {}.", record.surface.surface, record.surface.because)))
    }
}

fn quantiles(record: &UncertaintyRecord) -> Markup {
    let rows = record.outputs.iter().map(|output| {
        let [p05, p25, p50, p75, p95] = output.quantiles.all();
        let [model_error, difference, longer] = [output.model_error, output.surface_difference, output.censored]
            .map(|share| share.map_or_else(|| NONE.to_owned(), percent));
        line(cells![
            output.meaning.as_str(),
            output.nominal,
            p05,
            p25,
            p50,
            p75,
            p95,
            output.mean,
            output.standard_deviation,
            model_error,
            difference,
            longer,
            output.unit.as_str(),
        ])
    });
    let columns = [
        "",
        "as given",
        "5 %",
        "25 %",
        "50 %",
        "75 %",
        "95 %",
        "mean",
        "st. dev.",
        "error ±",
        "fast model ±",
        "longer",
        "unit",
    ];
    html! {
        (list("Quantiles", columns, rows))
        (note(
            "A quantile of 95 % is the value that 95 % of the samples stay below. Longer: part of the samples whose life is longer than their \
             duration; a quantile among these is not known. Error: the relative difference to finite elements on the scene as given. Fast model: the \
             relative difference that the contact surface of the samples makes with the keys low or high, at most, once it is corrected by that as given. The samples vary the figure uniformly within the sum of both."
        ))
    }
}

fn with_interval(index: &Index) -> String {
    let [value, low, high] = [index.value, index.low, index.high].map(|share| fixed(share, 3));
    format!("{value} ({low} to {high})")
}

fn indices(record: &UncertaintyRecord) -> Markup {
    let rows = record.outputs.iter().flat_map(|output| match (&output.indices, &output.no_indices_because) {
        (Some(indices), _) => indices
            .iter()
            .map(|one| {
                let [first, total] = [&one.first, &one.total].map(with_interval);
                line(cells![output.meaning.as_str(), one.factor.as_str(), first, total])
            })
            .collect(),
        (None, because) => {
            let because = because.as_deref().unwrap_or_default();
            vec![line([output.meaning.as_str().into(), Cell::sentence(because), NONE.into(), NONE.into()])]
        }
    });
    html! {
        (list("Indices with 95 % intervals", ["figure", "factor", "first order", "total"], rows))
        (note(
            "First order: the part of the variance that would go if this factor alone were known. Total: the part that would stay if all others \
             were known, so its interactions count too; a factor with a total near 0 may be fixed without loss. First orders that add up to less \
             than 1 leave the rest to interactions."
        ))
    }
}

/// Which samples were run.
fn read_off(record: &UncertaintyRecord) -> String {
    let Some(of) = record.response_surface else {
        let because = record.no_response_surface_because.as_deref().unwrap_or_default();
        return format!("All samples were run: {because}.");
    };
    let errors = record.outputs.iter().filter_map(|output| output.response_surface_error);
    format!(
        "{} samples were run; the other {} were read off a response surface of them, a polynomial in the keys (in the logarithm of lognormal ones) of total \
         degree {}. Samples that are left out of its fit it misses by at most {} of the standard deviation of any figure (root mean square); the wear \
         over the flanks has one of degree {}.",
        count(of.run as u64),
        count(of.read_off as u64),
        of.degree,
        percent(errors.fold(0.0, f64::max)),
        of.wear_degree
    )
}

fn work(record: &UncertaintyRecord) -> Markup {
    html! {
        p {
            (count(record.samples as u64)) " points of a scrambled Sobol sequence (seed " (record.seed) ") gave " (count(record.runs as u64))
            " samples of the scene in " (significant(record.wall_s, 3)) " s on "
            (if record.threads == 1 { "one thread".to_owned() } else { format!("{} threads", record.threads) })
            ". "
            (read_off(record))
            " Verification, error estimates and snapshots were left out of the samples; the scene as given was run and verified once, unless it \
             turns verification off. Quantiles are those of two independent samples a point."
        }
    }
}
