//! Error against run time, one plot for each quantity, with its Pareto front.
//!
//! Colours and shapes are the surfaces; of pairs with slices, full marks are slices coupled by plate theory, those with a dot in
//! space, open ones uncoupled.

use crate::accuracy::record::{AccuracyRecord, ComparedQuantity, VariantRecord, VariantSettings};
use gearwear::report::chart::{Chart, Dash, MUTED, Trace};
use gearwear::report::html::number::{percent, significant};
use gearwear_bodies::reference::statistics::extent;

/// Least error shown; smaller ones are drawn here, on the logarithmic axis.
const LEAST_SHOWN: f64 = 1e-5;

/// Ticks of the error axis: 1 and 3 of each decade.
const TICKS: [f64; 12] = [1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
const TICK_TEXTS: [&str; 12] =
    ["0.001 %", "0.003 %", "0.01 %", "0.03 %", "0.1 %", "0.3 %", "1 %", "3 %", "10 %", "30 %", "100 %", "300 %"];

type IsKind = fn(&VariantSettings) -> bool;

/// The kinds of runs that the plots tell apart: name, colour, symbol, and which runs they are.
const KINDS: [(&str, &str, &str, IsKind); 6] = [
    ("Hertz, mean pressure", "var(--new)", "circle", |s| s.surface == "hertz-mean"),
    ("Hertz", "var(--wheel)", "square", |s| s.surface == "hertz"),
    ("Winkler, one K/H", "var(--pinion)", "triangle-down", |s| s.surface == "winkler" && !s.calibrated),
    ("Winkler, K/H calibrated", "var(--pinion)", "diamond", |s| s.surface == "winkler" && s.calibrated),
    ("elastic half-planes", "var(--path)", "triangle-up", |s| s.surface == "half-space"),
    ("finite elements", "var(--worn)", "cross", |s| s.surface == "fem"),
];

/// Couplings of slices, `None` without slices, with what they add to the name and to the symbol of a kind.
const COUPLINGS: [(Option<&str>, &str, &str); 4] = [
    (None, "", ""),
    (Some("fem"), ", coupled by three-dimensional finite elements", "-dot"),
    (Some("slicing"), ", coupled by plate theory", ""),
    (Some("none"), ", uncoupled", "-open"),
];

pub(super) fn all(record: &AccuracyRecord) -> Vec<Chart> {
    ComparedQuantity::ALL.into_iter().filter(|q| record.measures(*q)).map(|quantity| front(record, quantity)).collect()
}

fn front(record: &AccuracyRecord, quantity: ComparedQuantity) -> Chart {
    let runs = record.variants.iter().filter_map(|v| {
        let error = v.errors.get(&quantity).filter(|error| error.relative.is_finite())?;
        Some((v, v.simulation_s?, error.relative, error.on_front))
    });
    let uncertainty = record.reference.uncertainty.get(&quantity).copied().unwrap_or(0.0);
    let id = format!("front-{}", quantity.to_string().to_lowercase().replace('_', "-"));
    let mut chart = Chart::new(id, quantity.title())
        .wide_if(quantity == ComparedQuantity::WearProfile)
        .height(430)
        .read_nearest()
        .x("wall time of the wear run, s")
        .x_logarithmic()
        .y("relative error")
        .y_logarithmic()
        .y_ticks(TICKS.into_iter().zip(TICK_TEXTS))
        .reading(reading(record, quantity, uncertainty));
    let mut on_front: Vec<(f64, f64)> =
        runs.clone().filter(|run| run.3).map(|(_, wall_s, error, _)| (wall_s, shown(error))).collect();
    on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (wall_s, errors): (Vec<f64>, Vec<f64>) = on_front.into_iter().unzip();
    chart = chart.add(Trace::line("Pareto front", wall_s, errors, (MUTED, 8.0, Dash::Solid)).opacity(0.35));
    for (kind, colour, symbol, holds) in KINDS {
        for (coupling, how, open) in COUPLINGS {
            let of_coupling = runs.clone().filter(|(v, ..)| v.settings.coupling.as_deref() == coupling);
            let of_kind: Vec<_> = of_coupling.filter(|(v, ..)| holds(&v.settings)).collect();
            if of_kind.is_empty() {
                continue;
            }
            let text = of_kind
                .iter()
                .map(|(v, wall_s, error, _)| format!("{}: {}, {} s", v.name, percent(*error), significant(*wall_s, 3)));
            let sizes = of_kind.iter().map(|(v, ..)| size(v)).collect();
            let (x, y) = (of_kind.iter().map(|run| run.1), of_kind.iter().map(|run| shown(run.2)));
            let points = Trace::points(format!("{kind}{how}"), x, y, (colour, &format!("{symbol}{open}"), 0));
            chart = chart.add(points.sizes(sizes).hover_texts(text.collect()));
        }
    }
    let ends = extent(runs.map(|run| run.1));
    for (name, level, dash) in
        [("error wanted", record.within, Dash::Dashed), ("the reference’s own uncertainty", uncertainty, Dash::Dot)]
    {
        if ends[0] < ends[1] && level > 0.0 {
            chart = chart.line(name, ends, [shown(level); 2], (MUTED, 1.4, dash), "%{y:.3~%}");
        }
    }
    chart
}

fn shown(error: f64) -> f64 {
    error.max(LEAST_SHOWN)
}

/// Size of the mark: the finer the run, the larger.
fn size(variant: &VariantRecord) -> f64 {
    match variant.settings.spacing_coarsening.max(variant.settings.step_coarsening) {
        1 => 13.0,
        2 => 10.0,
        _ => 7.0,
    }
}

fn reading(record: &AccuracyRecord, quantity: ComparedQuantity, uncertainty: f64) -> String {
    let found = record.recommended(quantity).map_or_else(String::new, |(is_within, variant, error, wall_s)| {
        let within = percent(record.within);
        let found = format!("{}: {} in {} s.", variant.name, percent(error), significant(wall_s, 3));
        if is_within {
            format!(" The fastest run within {within} is {found}")
        } else {
            format!(" No run is within {within}; the closest is {found}")
        }
    });
    let told_apart = match record.not_ranked(quantity) {
        Some(not) => format!(
            " No ranking: the reference itself is uncertain by {}, more than the {} wanted. To converge, it needs: {}.",
            percent(uncertainty),
            percent(record.within),
            not.remedy
        ),
        None => format!(" Errors below {} cannot be distinguished.", percent(uncertainty)),
    };
    format!("Error: {}.{found}{told_apart} Smaller marks are coarser runs.", quantity.measure())
}
