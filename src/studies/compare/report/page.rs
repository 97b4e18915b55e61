//! `report.html` of a comparison with a measured profile.

use maud::{Markup, html};

use super::figures;
use crate::measurement::fit::FitStop;
use crate::report::html::number::{figure, given, hours, revolutions, significant};
use crate::report::html::page::{Page, Plots, section, sources_list};
use crate::report::html::reading::capitalised;
use crate::report::html::table::{NONE, row, table};
use crate::results::run::ReportedBy;
use crate::studies::compare::record::{CompareRecord, Estimate};

const DATA_FILES: [(&str, &str); 2] = [
    ("compare.json", "the figures and what was fitted"),
    ("compare.csv", "measured and simulated profile, point by point"),
];

pub(super) fn page(record: &CompareRecord) -> String {
    let sources = sources_list(&DATA_FILES, "The resolved scene of the run", &record.scene_toml);
    let plots = Plots::default();
    Page {
        kind: "Measured profile against a run",
        title: &format!("{} – {}", record.title, record.measured),
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(record),
        interruption: None,
        warnings: &record.warnings,
        main: html! {
            (section("fit", "What the profile says", tables(record)))
            (section("plots", "Profiles", plots.show(&figures::all(record))))
            (section("sources", "Data and scene", sources))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

fn answer(record: &CompareRecord) -> String {
    let when = match record.hours {
        Some(time) => format!("{} h", hours(time)),
        None => format!("{} pinion revolutions", revolutions(record.revolutions)),
    };
    let whose = format!("The {}’s profile after {when}", record.gear.name());
    let difference = figure(record.figures.difference_um);
    match record.fit.stopped {
        FitStop::MaxIterations | FitStop::NotFinite => {
            return format!("{whose} was compared, but the fit did not converge.");
        }
        FitStop::AtBound | FitStop::Undetermined if record.fit.blamed.as_deref() != Some("the shift") => {
            return format!("{whose} does not give what was to be fitted to it.");
        }
        _ => {}
    }
    let of = |estimate: &Option<Estimate>, what: &str| {
        let e = estimate.as_ref()?;
        Some(format!("{what} of {}{}", significant(e.value, 3), interval(e)))
    };
    let found: Vec<String> = [
        of(&record.fit.coefficient_m2_per_N, "a wear coefficient k (in m²/N)"),
        of(&record.fit.severe_factor, "a severe factor"),
    ]
    .into_iter()
    .flatten()
    .collect();
    if found.is_empty() {
        return format!("{whose} differs from the simulated one by {difference} µm (root mean square).");
    }
    format!("{whose} is fitted best by {}; the residual is {difference} µm (root mean square).", found.join(" and "))
}

/// ", 95 % interval … to …".
fn interval(estimate: &Estimate) -> String {
    match (estimate.low, estimate.high) {
        (Some(low), Some(high)) => {
            format!(", 95 % interval {} to {}", significant(low, 3), significant(high, 3))
        }
        _ => ", without an interval".to_owned(),
    }
}

fn tables(record: &CompareRecord) -> Markup {
    let (fit, f) = (&record.fit, &record.figures);
    let cells = |e: &Estimate| {
        let end = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), |value| significant(value, 4));
        [significant(e.of_run, 4), significant(e.value, 4), end(e.low), end(e.high)]
    };
    let fitted: Vec<Markup> = [
        ("wear coefficient k", "m²/N", &fit.coefficient_m2_per_N),
        ("factor on the scene’s coefficients", "", &fit.coefficient_factor),
        ("factor of severe wear", "", &fit.severe_factor),
        ("shift of the profile towards the tip", "mm", &fit.shift_mm),
    ]
    .into_iter()
    .filter_map(|(name, unit, estimate)| Some(row(name, unit, cells(estimate.as_ref()?))))
    .collect();
    let profile = [
        row("arithmetic mean deviation, measured", "µm", [f.mean_deviation_um]),
        row("the same, simulated", "µm", [f.simulated_mean_deviation_um]),
        row(format!("Ra, cutoff {} mm, measured", given(f.cutoff_mm)), "µm", [f.roughness_um]),
        row("difference as run, root mean square", "µm", [f.as_run_difference_um]),
        row("difference after the fit", "µm", [f.difference_um]),
        row("runs of the scene", "", [fit.runs]),
        row("mesh cycles in them", "", [fit.mesh_cycles]),
    ];
    html! {
        @if !fitted.is_empty() { (table("Fitted", &["run", "fitted", "from", "to"], fitted)) }
        p { (capitalised(&fit.how)) "." }
        (table(format!("Profile, form removed ({})", record.form), &[""], profile))
    }
}
