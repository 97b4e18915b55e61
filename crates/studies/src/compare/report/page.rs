//! `report.html` of a comparison with measured profiles.

use maud::{Markup, html};

use super::{LAST, POINTS, figures};
use crate::compare::in_words::{INTERVAL, SlopeFinding};
use crate::compare::record::{CoefficientCorrelation, CompareRecord, FittedValue, ProfileRecord};
use crate::compare::unknown::Unknown;
use crate::measurement::deviations::Deviations;
use crate::measurement::fit::FitStop;
use gearwear::report::html::number::{figure, fixed, given, hours, revolutions, significant};
use gearwear::report::html::page::{Page, Plots, section, sources_list};
use gearwear::report::html::reading::capitalised;
use gearwear::report::html::table::{Cell, NONE, line, list, row, table};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::ReportedBy;

const DATA_FILES: [(&str, &str); 2] =
    [(LAST, "the figures and what was fitted"), (POINTS, "measured and simulated profile, point by point")];

pub(super) fn page(record: &CompareRecord) -> String {
    let sources = sources_list(&DATA_FILES, "The resolved scene of the run", &record.scene_toml);
    let plots = Plots::default();
    let correlated = figures::coefficients(record).map(|chart| plots.show(&[chart]));
    Page {
        kind: match record.profiles.len() {
            1 => "Measured profile against a run",
            _ => "Measured profiles of both gears against a run",
        },
        title: &record.headline(),
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(record),
        interruption: None,
        warnings: &record.warnings,
        main: html! {
            (section("fit", "What the measurement says", tables(record, correlated)))
            (section("plots", "Profiles", plots.show(&figures::of_profiles(record))))
            (section("sources", "Data and scene", sources))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

/// Time when a profile was measured.
fn when(of: &ProfileRecord) -> String {
    match of.hours {
        Some(time) => format!("{} h", hours(time)),
        None => format!("{} pinion revolutions", revolutions(of.revolutions)),
    }
}

fn answer(record: &CompareRecord) -> String {
    let (fit, profiles) = (&record.fit, &record.profiles);
    let (whose, are_many) = match &profiles[..] {
        [one] => (format!("The {}’s profile after {}", one.gear.name(), when(one)), false),
        several => {
            let mut times: Vec<String> = several.iter().map(when).collect();
            times.dedup();
            let gears: Vec<&str> = several.iter().map(|of| of.gear.name()).collect();
            (format!("The profiles of {} after {}", gears.join(" and "), times.join(" and ")), true)
        }
    };
    let [was, does, it, differs, simulated, residual, fitted] = match are_many {
        false => ["was", "does", "it", "differs", "one", "the residual is", "is fitted"],
        true => ["were", "do", "them", "differ", "ones", "the residuals are", "are fitted"],
    };
    match fit.stopped {
        FitStop::MaxIterations | FitStop::NotFinite => {
            return format!("{whose} {was} compared, but the fit did not converge.");
        }
        FitStop::AtBound | FitStop::Undetermined if !matches!(fit.blamed, Some(Unknown::Shift(_))) => {
            return format!("{whose} {does} not give what was to be fitted to {it}.");
        }
        _ => {}
    }
    let differences: Vec<String> = profiles.iter().map(|of| figure(of.figures.difference_um)).collect();
    let difference = differences.join(" and ");
    if !fit.is_of_wear() {
        return format!("{whose} {differs} from the simulated {simulated} by {difference} µm (root mean square).");
    }
    let mut found: Vec<String> = Vec::new();
    for own in &fit.coefficients {
        let whose = own.gear.filter(|_| are_many).map_or_else(String::new, |gear| format!(" of the {}", gear.name()));
        found.push(of_estimate(&format!("a wear coefficient k{whose} (in m²/N)"), &own.coefficient_m2_per_N));
    }
    found.extend(fit.severe_factor.map(|severe| of_estimate("a severe factor", &severe)));
    let correlated = fit.coefficient_correlation().map_or_else(String::new, |correlation| {
        format!(" The correlation coefficient of both coefficients is {}.", fixed(correlation, 2))
    });
    let slope = record.slope_headline().unwrap_or_default();
    format!(
        "{whose} {fitted} best by {}; {residual} {difference} µm (root mean square).{correlated}{slope}",
        found.join(" and ")
    )
}

/// "a wear coefficient of …, 95 % interval … to …".
fn of_estimate(what: &str, estimate: &FittedValue) -> String {
    format!("{what} of {}{}", significant(estimate.value, 3), figures::interval(estimate))
}

fn estimated(name: String, unit: &str, e: &FittedValue) -> Markup {
    let [low, high] = [e.low, e.high].map(|end| end.map_or_else(|| NONE.to_owned(), |end| significant(end, 4)));
    row(name, unit, [significant(e.of_run, 4), significant(e.value, 4), low, high])
}

fn of_gear(what: &str, gear: Option<Gear>) -> String {
    gear.map_or_else(|| what.to_owned(), |gear| format!("{what} of the {}", gear.name()))
}

/// The tables, and the plot of the coefficients.
fn tables(record: &CompareRecord, correlated: Option<Markup>) -> Markup {
    let (fit, profiles) = (&record.fit, &record.profiles);
    let several = profiles.len() > 1;
    let mut fitted = Vec::new();
    for own in &fit.coefficients {
        let name = of_gear("wear coefficient k", own.gear.filter(|_| several));
        fitted.push(estimated(name, "m²/N", &own.coefficient_m2_per_N));
    }
    for own in &fit.coefficients {
        let name = of_gear("factor on the scene’s coefficients", own.gear.filter(|_| several));
        fitted.push(estimated(name, "", &own.factor));
    }
    let ratio = fit.coefficient_ratio.iter();
    fitted
        .extend(ratio.map(|ratio| estimated("coefficient of the pinion over that of the wheel".to_owned(), "", ratio)));
    fitted.extend(fit.severe_factor.iter().map(|severe| estimated("factor of severe wear".to_owned(), "", severe)));
    for profile in profiles {
        let name = match several {
            true => format!("shift of the {}’s profile towards the tip", profile.gear.name()),
            false => "shift of the profile towards the tip".to_owned(),
        };
        fitted.extend(profile.shift_mm.iter().map(|shift| estimated(name.clone(), "mm", shift)));
    }
    let figures = profiles.iter().map(|of| &of.figures);
    let roughness = format!("Ra, cutoff {} mm, measured", given(profiles[0].figures.cutoff_mm));
    let of_profiles = [
        row("arithmetic mean deviation, measured", "µm", figures.clone().map(|of| of.mean_deviation_um)),
        row("the same, simulated", "µm", figures.clone().map(|of| of.simulated_mean_deviation_um)),
        row(roughness, "µm", figures.clone().map(|of| of.roughness_um)),
        row("difference as run, root mean square", "µm", figures.clone().map(|of| of.as_run_difference_um)),
        row("difference after the fit", "µm", figures.map(|of| of.difference_um)),
    ];
    let names: Vec<&str> = profiles.iter().map(|of| if several { of.gear.name() } else { "" }).collect();
    let mut forms: Vec<&str> = profiles.iter().map(|of| of.form.as_str()).collect();
    forms.dedup();
    let runs = [row("runs of the scene", "", [fit.runs]), row("mesh cycles in them", "", [fit.mesh_cycles])];
    html! {
        @if !fitted.is_empty() { (table("Fitted", &["run", "fitted", "from", "to"], fitted)) }
        p { (capitalised(&fit.how)) "." }
        @if fit.coefficients.iter().any(|own| own.factor.low.is_some()) { p { (INTERVAL) } }
        @if let Some(finding) = record.slope_finding() { (slopes(record, &finding)) }
        @if let Some(correlation) = &fit.correlation {
            (correlations(correlation))
        }
        (table(format!("Profile, form removed ({})", forms.join(", ")), &names, of_profiles))
        @for of in profiles {
            @if let Some(deviations) = deviations(of, several) { (deviations) }
        }
        (table("Runs", &[""], runs))
        @if let Some(plot) = correlated { (plot) }
    }
}

/// Slopes before wear, what to set in the scene, and what that moves.
fn slopes(record: &CompareRecord, finding: &SlopeFinding) -> Markup {
    let told = record.profiles.iter().filter_map(|of| Some((of.gear, of.profile_slope.as_ref()?.before_wear_um)));
    let rows = told.map(|(gear, slope)| {
        let ends = [slope.low, slope.high].map(|end| end.map_or_else(|| NONE.to_owned(), |um| fixed(um, 2)));
        let [low, high] = ends;
        row(gear.name(), "µm", [fixed(slope.of_run, 2), fixed(slope.value, 2), low, high])
    });
    html! {
        (table("Profile slope f_Hα before wear", &["scene", "found", "from", "to"], rows))
        p { (finding.sentences.join(" ")) }
        @if !finding.keys.is_empty() {
            p { @for (index, key) in finding.keys.iter().enumerate() { @if index > 0 { br; } code { (key) } } }
        }
        @if !finding.moved.is_empty() { p { (finding.moved.join(" ")) } }
    }
}

/// Deviations of a profile and of its leads after ISO 1328-1, where there are any.
fn deviations(of: &ProfileRecord, name_gear: bool) -> Option<Markup> {
    let profile = of.deviations.iter().flat_map(|of| {
        [
            ("as measured", of.measured),
            ("before wear (wear as fitted put back), beside the scene’s flank", of.before_wear),
            ("wear alone", of.wear),
        ]
    });
    let profile = profile.map(|(name, found)| (format!("profile, {name}"), found));
    let leads = of.leads.iter().map(|lead| {
        let tooth = lead.tooth.map_or_else(String::new, |tooth| format!(" of tooth {tooth}"));
        (format!("lead{tooth}"), lead.measured)
    });
    let rows: Vec<Markup> = profile
        .chain(leads)
        .filter_map(|(name, found)| {
            let Deviations { total_um, form_um, slope_um, tolerance_class } = found?;
            let class = tolerance_class.map_or_else(|| "above 11".to_owned(), |class| class.to_string());
            Some(row(name, "µm", [fixed(total_um, 2), fixed(form_um, 2), fixed(slope_um, 2), class]))
        })
        .collect();
    let whose = if name_gear { format!(" of the {}", of.gear.name()) } else { String::new() };
    let title = format!("Deviations{whose} after ISO 1328-1");
    (!rows.is_empty()).then(|| table(title, &["total F", "form f_f", "slope f_H", "tolerance class"], rows))
}

/// Rows of the correlations, each pair of fitted values once.
fn correlations(correlation: &CoefficientCorrelation) -> Markup {
    let names: Vec<String> = correlation.parameters.iter().map(|unknown| unknown.name()).collect();
    let count = names.len();
    let columns = [String::new()].into_iter().chain(names[..count - 1].iter().cloned());
    let rows = (1..count).map(|i| {
        let known = correlation.matrix[i][..i].iter().map(|r| fixed(*r, 2));
        let cells = known.chain((i..count - 1).map(|_| String::new()));
        line([capitalised(&names[i])].into_iter().chain(cells).map(Cell::from))
    });
    list("Correlation coefficients of the fitted values", columns, rows)
}
