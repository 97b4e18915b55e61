//! The tables of the page: recommendations, all runs, runs that differ in one respect, runs to a greater depth, what was left out.

use maud::{Markup, html};

use crate::accuracy::record::{AccuracyRecord, ComparedQuantity, DeepRun, SettingComparison, VariantRecord};
use gearwear::report::html::number::{count, fixed, percent, significant};
use gearwear::report::html::table::{Cell, cells, line, list};

/// The quantities with a column of their own in the table of all runs, where they are measured.
const SHOWN: [(ComparedQuantity, &str); 10] = [
    (ComparedQuantity::WearProfile, "wear profile"),
    (ComparedQuantity::PinionPeakWear, "maximum wear, pinion"),
    (ComparedQuantity::PinionTipEdgeWear, "its tip edge"),
    (ComparedQuantity::FlankPressure, "flank pressure"),
    (ComparedQuantity::PeakPressure, "maximum at a point"),
    (ComparedQuantity::HalfWidth, "half-width"),
    (ComparedQuantity::TransmissionError, "transmission error"),
    (ComparedQuantity::WornTransmissionError, "the same, worn"),
    (ComparedQuantity::RootWear, "root wear"),
    (ComparedQuantity::WornFaceLoadFactor, "K_Hβ, worn"),
];

/// The cheapest setting for each quantity.
pub(super) fn recommendations(record: &AccuracyRecord) -> Markup {
    let rows = record.recommendations.iter().filter_map(|r| {
        let variant = record.variants.get(r.variant)?;
        let error = variant.errors.get(&r.quantity)?.relative;
        let uncertainty = record.reference.uncertainty.get(&r.quantity).copied().unwrap_or(0.0);
        Some(line(cells![
            r.quantity.title(),
            Cell::sentence(if r.is_within { variant.name.clone() } else { format!("none; closest {}", variant.name) }),
            percent(error),
            variant.simulation_s.map(seconds),
            percent(uncertainty),
        ]))
    });
    let columns = cells!["quantity", Cell::sentence("run"), "error", "time, s", "reference’s uncertainty"];
    html! {
        (list(format!("Fastest run within {}", percent(record.within)), columns, rows))
        (not_ranked(record))
    }
}

/// Quantities without a ranking, and the remedy.
fn not_ranked(record: &AccuracyRecord) -> Markup {
    if record.not_ranked.is_empty() {
        return Markup::default();
    }
    let rows = record
        .not_ranked
        .iter()
        .map(|one| line(cells![one.quantity.title(), percent(one.uncertainty), Cell::sentence(&one.remedy)]));
    let caption = format!(
        "Not ranked: the uncertainty of the reference is above the {} wanted, so that no run is known to be better than another",
        percent(record.within)
    );
    list(
        caption,
        cells!["quantity", "reference’s uncertainty", Cell::sentence("needed for the reference to converge")],
        rows,
    )
}

fn profile_error(run: &VariantRecord) -> f64 {
    run.errors.get(&ComparedQuantity::WearProfile).map_or(f64::INFINITY, |error| error.relative)
}

/// Every run, the most accurate wear profile first, those without a result last.
pub(super) fn runs(record: &AccuracyRecord) -> Markup {
    let mut sorted: Vec<&VariantRecord> = record.variants.iter().collect();
    sorted.sort_by(|a, b| profile_error(a).total_cmp(&profile_error(b)));
    let shown: Vec<(ComparedQuantity, &str)> =
        SHOWN.into_iter().filter(|&(quantity, _)| record.measures(quantity)).collect();
    let columns = ["run", "time, s", "set-up, s", "equilibria"].into_iter().chain(shown.iter().map(|&(_, name)| name));
    let rows = sorted.into_iter().map(|v| {
        let errors = shown.iter().map(|(quantity, _)| {
            let error = v.errors.get(quantity);
            Cell::from(error.map(|error| percent(error.relative) + if error.on_front { " ●" } else { "" }))
        });
        let run = cells![
            named(&v.name, &v.failure),
            v.simulation_s.map(seconds),
            v.setup_s.map(|wall_s| fixed(wall_s, 2)),
            v.work.map(|work| count(work.equilibria)),
        ];
        line(run.into_iter().chain(errors))
    });
    list("All runs, the best wear profile first; ● on the Pareto front of the quantity", columns, rows)
}

/// Runs that differ in one respect only.
pub(super) fn comparison(of: &SettingComparison) -> Markup {
    let columns = ["profile, pinion", "profile, wheel", "maximum wear, pinion", "maximum wear, wheel", "time, s"];
    let rows = of.rows.iter().map(|row| {
        line(cells![
            &*row.name,
            percent(row.wear_profile.pinion),
            percent(row.wear_profile.wheel),
            signed(row.peak_wear.pinion),
            signed(row.peak_wear.wheel),
            seconds(row.simulation_s),
        ])
    });
    let caption = format!("{}: differences from {}, {}", of.title, of.baseline, of.common);
    list(caption, [&*of.title.to_lowercase()].into_iter().chain(columns), rows)
}

/// The models run to a greater depth, and whether they stay stable.
pub(super) fn deep_runs(record: &AccuracyRecord) -> Markup {
    let Some(deep) = &record.deep_runs else { return Markup::default() };
    let columns = [
        "model",
        "maximum wear, µm, pinion / wheel",
        "profile",
        "roughness",
        "steps",
        "time, s",
        "fewer steps",
        "time, s",
        "change of maximum wear",
        "roughness",
        "stable",
    ];
    let rows = deep.rows.iter().map(|row| {
        let (usual, fewer_steps) = (row.usual.as_ref(), row.fewer_steps.as_ref());
        line(cells![
            named(&row.name, &row.failure),
            usual.map(peak_wear),
            row.wear_profile.map(percent),
            usual.map(roughness),
            usual.map(steps),
            usual.map(|run| seconds(run.simulation_s)),
            fewer_steps.map(steps),
            fewer_steps.map(|run| seconds(run.simulation_s)),
            row.peak_wear_change.map(percent),
            fewer_steps.map(roughness),
            row.stable.map(|stable| if stable { "yes" } else { "no" }.to_owned()),
        ])
    });
    let caption = format!(
        "To a greater depth: {}. Profile: difference from {}. Stable: with the fewer, longer wear steps the maximum wear of \
         neither gear changes by more than {}. Roughness: part of the depth that alternates from point to point",
        deep.common,
        deep.baseline,
        percent(deep.stable_within)
    );
    list(caption, columns, rows)
}

fn peak_wear(run: &DeepRun) -> String {
    format!("{} / {}", significant(run.peak_wear_um.pinion, 3), significant(run.peak_wear_um.wheel, 3))
}

fn roughness(run: &DeepRun) -> String {
    percent(run.roughness.pinion.max(run.roughness.wheel))
}

fn steps(run: &DeepRun) -> String {
    format!("{}{}", run.wear_steps, if run.warned { " (warned)" } else { "" })
}

pub(super) fn left_out(record: &AccuracyRecord) -> Markup {
    html! {
        @if !record.left_out.is_empty() {
            h3 { "Not run" }
            dl { @for left in &record.left_out { dt { (left.what) } dd { (left.reason) } } }
        }
    }
}

/// The name of a run, with the reason where it has no result.
fn named(name: &str, failure: &Option<String>) -> String {
    failure.as_ref().map_or_else(|| name.to_owned(), |failure| format!("{name}: {failure}"))
}

fn signed(share: f64) -> String {
    format!("{}{}", if share > 0.0 { "+" } else { "" }, percent(share))
}

fn seconds(wall_s: f64) -> String {
    significant(wall_s, 3)
}
