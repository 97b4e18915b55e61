//! The tables of the page: recommendations, all runs, runs that differ in one respect, runs to a greater depth, what was left out.

use crate::report::html::number::{count, fixed, percent, significant};
use crate::report::html::page::escape;
use crate::studies::accuracy::record::{AccuracyRecord, Comparison, DeepRun, Quantity, VariantRecord};

/// The quantities with a column of their own in the table of all runs, where they are measured.
const SHOWN: [(Quantity, &str); 9] = [
    (Quantity::WearProfile, "wear profile"),
    (Quantity::PinionPeakWear, "pinion’s peak wear"),
    (Quantity::PeakPressure, "peak pressure"),
    (Quantity::FlankPressure, "off the tips"),
    (Quantity::HalfWidth, "half-width"),
    (Quantity::TransmissionError, "transmission error"),
    (Quantity::WornTransmissionError, "the same, worn"),
    (Quantity::RootWear, "root wear"),
    (Quantity::WornFaceLoadFactor, "K_Hβ, worn"),
];

/// A table of text cells; the first column names the row.
fn table(caption: &str, columns: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let head: String = columns.iter().map(|name| format!("<th scope=\"col\">{}</th>", escape(name))).collect();
    let body: String = rows
        .into_iter()
        .map(|cells| {
            let mut cells = cells.iter().map(|cell| escape(cell));
            let name = cells.next().unwrap_or_default();
            let rest: String = cells.map(|cell| format!("<td>{cell}</td>")).collect();
            format!("<tr><th scope=\"row\">{name}</th>{rest}</tr>\n")
        })
        .collect();
    format!(
        "<table>\n<caption>{}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n",
        escape(caption)
    )
}

/// The cheapest setting for each quantity.
pub fn recommendations(record: &AccuracyRecord) -> String {
    let rows = record.recommendations.iter().filter_map(|r| {
        let variant = record.variants.get(r.variant)?;
        let error = variant.errors.get(&r.quantity)?.relative;
        let uncertainty = record.reference.uncertainty.get(&r.quantity).copied().unwrap_or(0.0);
        Some(vec![
            r.quantity.title().to_owned(),
            if r.is_within { variant.name.clone() } else { format!("none; closest {}", variant.name) },
            percent(error),
            seconds(variant.simulation_s),
            percent(uncertainty),
        ])
    });
    table(
        &format!("Cheapest run within {}", percent(record.within)),
        &["quantity", "run", "error", "time, s", "reference’s uncertainty"],
        rows,
    )
}

/// Every run, the most accurate wear profile first, those without a result last.
pub fn runs(record: &AccuracyRecord) -> String {
    let mut sorted: Vec<&VariantRecord> = record.variants.iter().collect();
    let error = |v: &VariantRecord| v.errors.get(&Quantity::WearProfile).map_or(f64::INFINITY, |e| e.relative);
    sorted.sort_by(|a, b| error(a).total_cmp(&error(b)));
    let mut columns = vec!["run", "time, s", "set-up, s", "equilibria"];
    let measured = |quantity: Quantity| record.variants.iter().any(|v| v.errors.contains_key(&quantity));
    let shown: Vec<(Quantity, &str)> = SHOWN.into_iter().filter(|&(quantity, _)| measured(quantity)).collect();
    columns.extend(shown.iter().map(|&(_, name)| name));
    let rows = sorted.into_iter().map(|v| {
        let mut cells = vec![
            match &v.failure {
                Some(failure) => format!("{}: {failure}", v.name),
                None => v.name.clone(),
            },
            seconds(v.simulation_s),
            v.setup_s.map_or_else(dash, |wall_s| fixed(wall_s, 2)),
            v.work.map_or_else(dash, |work| count(work.equilibria)),
        ];
        cells.extend(shown.iter().map(|(quantity, _)| {
            v.errors.get(quantity).map_or_else(dash, |error| {
                format!("{}{}", percent(error.relative), if error.on_front { " ●" } else { "" })
            })
        }));
        cells
    });
    let caption = "All runs, the best wear profile first; ● on the Pareto front of the quantity";
    table(caption, &columns, rows)
}

/// Runs that differ in one respect only.
pub fn comparisons(record: &AccuracyRecord) -> String {
    record.comparisons.iter().map(comparison).collect()
}

fn comparison(of: &Comparison) -> String {
    let heading = of.title.to_lowercase();
    let columns =
        [heading.as_str(), "profile, pinion", "profile, wheel", "peak wear, pinion", "peak wear, wheel", "time, s"];
    let rows = of.rows.iter().map(|row| {
        vec![
            row.name.clone(),
            percent(row.wear_profile.pinion),
            percent(row.wear_profile.wheel),
            signed(row.peak_wear.pinion),
            signed(row.peak_wear.wheel),
            significant(row.simulation_s, 3),
        ]
    });
    let caption = format!("{}: differences from {}, {}", of.title, of.baseline, of.common);
    table(&caption, &columns, rows)
}

/// The models run to a greater depth, and whether they stay stable.
pub fn deep_runs(record: &AccuracyRecord) -> String {
    let Some(deep) = &record.deep_runs else { return String::new() };
    let columns = [
        "model",
        "greatest wear, µm, pinion / wheel",
        "profile",
        "roughness",
        "steps",
        "time, s",
        "fewer steps",
        "time, s",
        "change of greatest wear",
        "roughness",
        "stable",
    ];
    let rows = deep.rows.iter().map(|row| {
        let name = row.failure.as_ref().map_or_else(|| row.name.clone(), |failure| format!("{}: {failure}", row.name));
        let of = |run: &Option<DeepRun>, cell: fn(&DeepRun) -> String| run.as_ref().map_or_else(dash, cell);
        let rough = |run: &DeepRun| percent(run.roughness.pinion.max(run.roughness.wheel));
        let steps = |run: &DeepRun| format!("{}{}", run.wear_steps, if run.warned { " (warned)" } else { "" });
        let time = |run: &DeepRun| significant(run.simulation_s, 3);
        let deepest = |run: &DeepRun| {
            format!("{} / {}", significant(run.peak_wear_um.pinion, 3), significant(run.peak_wear_um.wheel, 3))
        };
        vec![
            name,
            of(&row.usual, deepest),
            row.wear_profile.map_or_else(dash, percent),
            of(&row.usual, rough),
            of(&row.usual, steps),
            of(&row.usual, time),
            of(&row.fewer_steps, steps),
            of(&row.fewer_steps, time),
            row.peak_wear_change.map_or_else(dash, percent),
            of(&row.fewer_steps, rough),
            row.stable.map_or_else(dash, |stable| if stable { "yes" } else { "no" }.to_owned()),
        ]
    });
    let caption = format!(
        "To a greater depth: {}. Profile: difference from {}. Stable: with the fewer, longer wear steps the greatest wear of \
         neither gear changes by more than {}. Roughness: what of the depth jumps from point to point",
        deep.common,
        deep.baseline,
        percent(deep.stable_within)
    );
    table(&caption, &columns, rows)
}

/// What was not run, and why.
pub fn left_out(record: &AccuracyRecord) -> String {
    let rows: String = record
        .left_out
        .iter()
        .map(|left| format!("<dt>{}</dt><dd>{}</dd>\n", escape(&left.what), escape(&left.reason)))
        .collect();
    if rows.is_empty() { rows } else { format!("<h3>Not run</h3>\n<dl>\n{rows}</dl>\n") }
}

fn signed(share: f64) -> String {
    format!("{}{}", if share > 0.0 { "+" } else { "" }, percent(share))
}

fn seconds(wall_s: Option<f64>) -> String {
    wall_s.map_or_else(dash, |wall_s| significant(wall_s, 3))
}

fn dash() -> String {
    "–".to_owned()
}
