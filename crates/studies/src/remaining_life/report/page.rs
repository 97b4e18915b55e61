//! `report.html` of wear coefficient and remaining life.

use maud::{Markup, html};

use super::{LAST, LIVES, PREDICTIONS, figures};
use crate::remaining_life::record::{GearLife, INTERVAL_OF_K, Interval, LifeRecord, LifeUpdate};
use crate::remaining_life::wear_table::WearKind;
use gearwear::report::html::number::{fixed, hours, percent, revolutions, significant};
use gearwear::report::html::page::{Page, Plots, note, section, sources_list};
use gearwear::report::html::table::{Cell, NONE, cells, line, list};
use gearwear_physics::results::run::ReportedBy;

const DATA_FILES: [(&str, &str); 3] = [
    (LAST, "all figures"),
    (LIVES, "coefficient and remaining life after each measurement"),
    (PREDICTIONS, "every measurement as those before it predict it"),
];

/// How to read intervals.
const INTERVALS: &str = "Intervals hold 95 %. They stand for the scatter of measurements, wear that wanders, and what was known of the coefficient before; \
                         not for another load, oil or wear regime, or a wear law that does not hold.";

pub(super) fn page(record: &LifeRecord) -> String {
    let plots = Plots::default();
    let sources = sources_list(&DATA_FILES, "The resolved scene of the run", &record.scene_toml);
    let charts: Vec<_> = record.gears.iter().flat_map(figures::of_gear).collect();
    Page {
        kind: "Wear coefficient and remaining life by measurements",
        title: &record.headline(),
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(record),
        interruption: None,
        warnings: &record.warnings,
        main: html! {
            (section("plots", "Wear, coefficient, remaining life", plots.show(&charts)))
            (section("updates", "After each measurement", tables(record)))
            (section("sources", "Data and scene", sources))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

fn answer(record: &LifeRecord) -> String {
    let sentences: Vec<String> = record.gears.iter().filter_map(|of| Some(of_gear(of, of.updates.last()?))).collect();
    sentences.join(" ")
}

fn of_gear(of: &GearLife, last: &LifeUpdate) -> String {
    let gear = of.gear.name();
    let k = last.coefficient_m2_per_N;
    let found = format!(
        "After {} the {gear} has a wear coefficient (in m²/N) of {}, 95 % interval {} to {}",
        when(last.hours, last.revolutions),
        significant(k.median, 3),
        significant(k.low, 3),
        significant(k.high, 3)
    );
    let Some(life) = last.life else { return format!("{found}.") };
    if life.passed > 0.5 {
        return format!("{found}; it has passed its limit with a probability of {} %.", fixed(100.0 * life.passed, 0));
    }
    let time = |interval: Interval, shown: fn(f64) -> String, unit: &str| {
        format!("{} {unit} (95 % {} to {})", shown(interval.median), shown(interval.low), shown(interval.high))
    };
    let [left, total] = match (life.remaining_hours, life.total_hours) {
        (Some(left), Some(total)) => [left, total].map(|interval| time(interval, figure, "h")),
        _ => [life.remaining_revolutions, life.total_revolutions]
            .map(|interval| time(interval, revolutions, "pinion revolutions")),
    };
    format!("{found}; {left} are left until its limit, {total} is its life in all.")
}

fn figure(value: f64) -> String {
    significant(value, 3)
}

fn when(time: Option<f64>, at: f64) -> String {
    time.map_or_else(|| format!("{} pinion revolutions", revolutions(at)), |time| format!("{} h", hours(time)))
}

fn tables(record: &LifeRecord) -> Markup {
    html! {
        @for of in &record.gears {
            (list(format!("Measurements of the {}", of.gear.name()), MEASUREMENT_COLUMNS, measurements(of)))
            (list(format!("Wear coefficient k of the {}", of.gear.name()), UPDATE_COLUMNS, updates(of)))
            @if of.limit.is_some() {
                (list(format!("Life of the {}, {}", of.gear.name(), unit(of)), LIFE_COLUMNS, lives(of)))
            }
            p { (prior(of)) }
        }
        p { (INTERVAL_OF_K) }
        @if let Some(other) = &record.other_gear { p { (other.in_words(&figure(other.coefficient_m2_per_N))) } }
        (note(INTERVALS))
    }
}

const MEASUREMENT_COLUMNS: [&str; 8] = ["", "time", "kind", "found", "σ known", "predicted before", "95 % from", "to"];

fn measurements(of: &GearLife) -> Vec<Markup> {
    let rows = of.measurements.iter().enumerate().map(|(index, found)| {
        let predicted = of.updates[index].later.first().filter(|_| index > 0);
        let shown = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), figure);
        let unit = if found.kind == WearKind::Mass { "mg" } else { "µm" };
        let of_teeth = if found.count > 1 { format!(", mean of {}", found.count) } else { String::new() };
        let sigma = if found.sigma > 0.0 { figure(found.sigma) } else { NONE.to_owned() };
        line(cells![
            format!("{}", index + 1),
            when(found.hours, found.revolutions),
            format!("{}, {unit}{of_teeth}", found.kind.name()),
            figure(found.value),
            sigma,
            shown(predicted.and_then(|one| one.median)),
            shown(predicted.and_then(|one| one.low)),
            shown(predicted.and_then(|one| one.high)),
        ])
    });
    rows.collect()
}

const UPDATE_COLUMNS: [&str; 6] = ["after", "k, m²/N", "95 % from", "to", "wander", "scatter"];

fn updates(of: &GearLife) -> Vec<Markup> {
    let rows = of.updates.iter().map(|update| {
        let k = update.coefficient_m2_per_N;
        line(cells![
            after(update),
            figure(k.median),
            figure(k.low),
            figure(k.high),
            percent(update.wander),
            percent(update.scatter)
        ])
    });
    rows.collect()
}

/// Number of measurements.
fn after(update: &LifeUpdate) -> String {
    if update.measurements == 0 { "none".to_owned() } else { update.measurements.to_string() }
}

const LIFE_COLUMNS: [&str; 8] = ["after", "left", "95 % from", "to", "in all", "95 % from", "to", "limit passed"];

/// Unit of the lives of a gear.
fn unit(of: &GearLife) -> &'static str {
    let has_speed = of.updates.iter().filter_map(|update| update.life).all(|life| life.total_hours.is_some());
    if has_speed { "h" } else { "pinion revolutions" }
}

fn lives(of: &GearLife) -> Vec<Markup> {
    let rows = of.updates.iter().skip(1).filter_map(|update| {
        let life = update.life?;
        let [left, total] = match (life.remaining_hours, life.total_hours) {
            (Some(left), Some(total)) => [left, total].map(|of| [of.low, of.median, of.high].map(figure)),
            _ => [life.remaining_revolutions, life.total_revolutions].map(|of| [of.low, of.median, of.high].map(long)),
        };
        let mut cells: Vec<Cell> = vec![Cell::from(after(update))];
        for [low, median, high] in [left, total] {
            cells.extend([median, low, high].map(Cell::from));
        }
        cells.push(Cell::from(format!("{}\u{202f}%", fixed(100.0 * life.passed, 1))));
        Some(line(cells))
    });
    rows.collect()
}

/// Revolutions, which may be more than any gear does.
fn long(value: f64) -> String {
    if value < 1e12 { revolutions(value) } else { figure(value) }
}

fn prior(of: &GearLife) -> String {
    let name = match of.prior.name.as_str() {
        "run" => "about the coefficient of the run".to_owned(),
        "range" => "as given".to_owned(),
        regime => format!("of the regime {regime}"),
    };
    format!(
        "Before any measurement the coefficient is expected, {name}, within {} to {} m²/N (95 %). Wander: relative standard deviation of the wear at the end \
         of the run; scatter: of a measurement, beside what is known of it.",
        figure(of.prior.low_m2_per_N),
        figure(of.prior.high_m2_per_N)
    )
}
