//! Error against run time, one plot for each quantity, with its Pareto front.
//!
//! Colours and shapes are the surfaces; of pairs with slices, full marks are coupled slices and open ones uncoupled.

use crate::report::chart::{
    AxisType, DashType, ExponentFormat, HoverInfo, HoverMode, Marker, MarkerSymbol, Mode, Plot,
};

use crate::report::html::number::{percent, significant};
use crate::report::html::theme::{Figure, MUTED, axis, curve, layout, line};
use crate::studies::accuracy::record::{AccuracyRecord, Quantity, VariantRecord};

/// Errors below this are drawn at it: a logarithmic axis knows no zero.
const LEAST_SHOWN: f64 = 1e-5;

/// Marks of the error axis: a whole decade and its third, as in engineering plots.
const TICKS: [(f64, &str); 12] = [
    (1e-5, "0.001 %"),
    (3e-5, "0.003 %"),
    (1e-4, "0.01 %"),
    (3e-4, "0.03 %"),
    (1e-3, "0.1 %"),
    (3e-3, "0.3 %"),
    (0.01, "1 %"),
    (0.03, "3 %"),
    (0.1, "10 %"),
    (0.3, "30 %"),
    (1.0, "100 %"),
    (3.0, "300 %"),
];

/// A kind of run as the plots tell them apart.
struct Kind {
    name: &'static str,
    colour: &'static str,
    /// With coupled slices, or without slices; with uncoupled ones.
    symbols: fn() -> [MarkerSymbol; 2],
    holds: fn(&VariantRecord) -> bool,
}

const KINDS: [Kind; 6] = [
    Kind {
        name: "hertz-mean",
        colour: "var(--new)",
        symbols: || [MarkerSymbol::Circle, MarkerSymbol::CircleOpen],
        holds: |v| v.settings.surface == "hertz-mean",
    },
    Kind {
        name: "hertz",
        colour: "var(--wheel)",
        symbols: || [MarkerSymbol::Square, MarkerSymbol::SquareOpen],
        holds: |v| v.settings.surface == "hertz",
    },
    Kind {
        name: "winkler, one K/H",
        colour: "var(--pinion)",
        symbols: || [MarkerSymbol::TriangleDown, MarkerSymbol::TriangleDownOpen],
        holds: |v| v.settings.surface == "winkler" && !v.settings.calibrated,
    },
    Kind {
        name: "winkler, calibrated",
        colour: "var(--pinion)",
        symbols: || [MarkerSymbol::Diamond, MarkerSymbol::DiamondOpen],
        holds: |v| v.settings.surface == "winkler" && v.settings.calibrated,
    },
    Kind {
        name: "half-space",
        colour: "var(--path)",
        symbols: || [MarkerSymbol::TriangleUp, MarkerSymbol::TriangleUpOpen],
        holds: |v| v.settings.surface == "half-space",
    },
    Kind {
        name: "fem",
        colour: "var(--worn)",
        symbols: || [MarkerSymbol::Cross, MarkerSymbol::CrossOpen],
        holds: |v| v.settings.surface == "fem",
    },
];

/// One plot for each quantity.
pub fn all(record: &AccuracyRecord) -> Vec<Figure> {
    let measured = |quantity: &Quantity| record.variants.iter().any(|v| v.errors.contains_key(quantity));
    Quantity::ALL.into_iter().filter(measured).map(|quantity| front(record, quantity)).collect()
}

fn front(record: &AccuracyRecord, quantity: Quantity) -> Figure {
    let mut plot = Plot::new();
    let runs = |holds: fn(&VariantRecord) -> bool| {
        record.variants.iter().filter(move |v| holds(v)).filter_map(move |v| {
            let error = v.errors.get(&quantity).filter(|error| error.relative.is_finite())?;
            Some((v, v.simulation_s?, error.relative, error.on_front))
        })
    };
    let mut on_front: Vec<(f64, f64)> =
        runs(|_| true).filter(|run| run.3).map(|(_, wall_s, error, _)| (wall_s, error)).collect();
    on_front.sort_by(|a, b| a.0.total_cmp(&b.0));
    plot.add_trace(
        curve(
            "Pareto front",
            on_front.iter().map(|run| run.0),
            on_front.iter().map(|run| shown(run.1)),
            line(MUTED, 8.0, DashType::Solid),
        )
        .opacity(0.35)
        .hover_info(HoverInfo::Skip),
    );
    for kind in &KINDS {
        let [coupled, uncoupled] = (kind.symbols)();
        let groups = [(None, coupled), (Some("slicing"), coupled), (Some("none"), uncoupled)];
        for (coupling, symbol) in groups {
            let of_kind: Vec<_> =
                runs(kind.holds).filter(|(v, ..)| v.settings.coupling.as_deref() == coupling).collect();
            if of_kind.is_empty() {
                continue;
            }
            let text: Vec<String> = of_kind
                .iter()
                .map(|(v, wall_s, error, _)| format!("{}: {}, {} s", v.name, percent(*error), significant(*wall_s, 3)))
                .collect();
            let sizes: Vec<usize> = of_kind.iter().map(|(v, ..)| size(v)).collect();
            let name = match coupling {
                None => kind.name.to_owned(),
                Some("slicing") => format!("{}, coupled", kind.name),
                Some(_) => format!("{}, uncoupled", kind.name),
            };
            plot.add_trace(
                curve(
                    &name,
                    of_kind.iter().map(|run| run.1),
                    of_kind.iter().map(|run| shown(run.2)),
                    line(kind.colour, 1.0, DashType::Solid),
                )
                .mode(Mode::Markers)
                .marker(Marker::new().color(kind.colour).symbol(symbol).size(sizes))
                .hover_text_array(text)
                .hover_template("%{hovertext}<extra></extra>"),
            );
        }
    }
    let times: Vec<f64> = runs(|_| true).map(|run| run.1).collect();
    let ends = [times.iter().copied().fold(f64::INFINITY, f64::min), times.iter().copied().fold(0.0, f64::max)];
    let uncertainty = record.reference.uncertainty.get(&quantity).copied().unwrap_or(0.0);
    for (name, level, dash) in [
        ("error wanted", record.within, DashType::Dash),
        ("the reference’s own uncertainty", uncertainty, DashType::Dot),
    ] {
        if ends[0] < ends[1] && level > 0.0 {
            plot.add_trace(curve(name, ends, [shown(level); 2], line(MUTED, 1.4, dash)).hover_template("%{y:.3~%}"));
        }
    }
    let logarithmic = |title: &str| axis(title).type_(AxisType::Log).exponent_format(ExponentFormat::Power);
    plot.set_layout(
        layout(430)
            .show_legend(true)
            .hover_mode(HoverMode::Closest)
            .x_axis(logarithmic("wall time of the wear run, s"))
            .y_axis(
                logarithmic("relative error")
                    .tick_values(TICKS.map(|(level, _)| level))
                    .tick_text(TICKS.map(|(_, text)| text.to_owned())),
            ),
    );
    Figure {
        id: format!("front-{}", quantity.name().to_lowercase().replace('_', "-")),
        title: quantity.title().to_owned(),
        reading: reading(record, quantity, uncertainty),
        plot,
        wide: quantity == Quantity::WearProfile,
    }
}

fn shown(error: f64) -> f64 {
    error.max(LEAST_SHOWN)
}

/// The finer, the larger.
fn size(variant: &VariantRecord) -> usize {
    match variant.settings.spacing_coarsening.max(variant.settings.step_coarsening) {
        1 => 13,
        2 => 10,
        _ => 7,
    }
}

fn reading(record: &AccuracyRecord, quantity: Quantity, uncertainty: f64) -> String {
    let chosen = record.recommendations.iter().find(|r| r.quantity == quantity);
    let chosen = chosen.and_then(|r| {
        let variant = record.variants.get(r.variant)?;
        Some((r, variant, variant.errors.get(&quantity)?.relative, variant.simulation_s?))
    });
    let measured = format!("Error: {}.", quantity.measure());
    let found = match chosen {
        Some((r, variant, error, wall_s)) if r.is_within => format!(
            " The cheapest run within {} is {}: {} in {} s.",
            percent(record.within),
            variant.name,
            percent(error),
            significant(wall_s, 3)
        ),
        Some((_, variant, error, wall_s)) => format!(
            " No run is within {}; the closest is {}: {} in {} s.",
            percent(record.within),
            variant.name,
            percent(error),
            significant(wall_s, 3)
        ),
        None => String::new(),
    };
    format!(
        "{measured}{found} Below {} errors are not told apart. Smaller marks are coarser runs.",
        percent(uncertainty)
    )
}
