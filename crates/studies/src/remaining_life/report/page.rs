//! `report.html` of wear coefficient and remaining life.

use maud::{Markup, html};

use super::{LAST, LIVES, PREDICTIONS, figures};
use crate::remaining_life::record::{GearLife, LifeRecord, LifeUpdate};
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
    let left = match life.remaining_hours {
        Some(left) => format!("{} h, {} to {}", figure(left.median), figure(left.low), figure(left.high)),
        None => {
            let left = life.remaining_revolutions;
            format!(
                "{} pinion revolutions, {} to {}",
                revolutions(left.median),
                revolutions(left.low),
                revolutions(left.high)
            )
        }
    };
    format!("{found}; its limit is {left} (95 %), away.")
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
            (list(format!("Known of the {}", of.gear.name()), update_columns(of), updates(of)))
            p { (prior(of)) }
        }
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

fn update_columns(of: &GearLife) -> Vec<&'static str> {
    let mut columns = vec!["after", "k, m²/N", "95 % from", "to", "wander", "scatter"];
    if of.limit.is_some() {
        columns.extend(["revolutions left", "95 % from", "to", "limit passed"]);
    }
    columns
}

fn updates(of: &GearLife) -> Vec<Markup> {
    let rows = of.updates.iter().map(|update| {
        let k = update.coefficient_m2_per_N;
        let name = if update.measurements == 0 { "none".to_owned() } else { update.measurements.to_string() };
        let mut cells: Vec<Cell> = cells![
            name,
            figure(k.median),
            figure(k.low),
            figure(k.high),
            percent(update.wander),
            percent(update.scatter)
        ]
        .into();
        if let Some(life) = update.life {
            let left = life.remaining_revolutions;
            cells.extend([left.median, left.low, left.high].map(|value| Cell::from(long(value))));
            cells.push(Cell::from(format!("{}\u{202f}%", fixed(100.0 * life.passed, 1))));
        }
        line(cells)
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
