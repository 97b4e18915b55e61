//! `report.html` of a study of improvement.

use maud::{Markup, html};

use super::super::kept::DesignRole;
use super::super::proposal::{ComparedFigure, Proposal};
use super::super::record::ImproveRecord;
use super::super::words::signed;
use super::{DESIGNS, FRONT, LAST, figures};
use gearwear::journal;
use gearwear::report::html::number::{count, figure as shown, percent, significant};
use gearwear::report::html::page::{Page, Plots, fold, note, section, sources_list};
use gearwear::report::html::reading::capitalised;
use gearwear::report::html::table::{Cell, NONE, line, list};
use gearwear::report::output_files;
use gearwear_physics::results::run::ReportedBy;

const LETTERS: [&str; 5] = ["A", "B", "C", "D", "E"];

pub(super) fn page(record: &ImproveRecord) -> String {
    let plots = Plots::default();
    let charts = figures::all(record);
    let scenes: Vec<(&str, String)> = record
        .proposals
        .iter()
        .map(|proposal| (proposal.file.as_str(), format!("scene of “{}”, which gearwear run takes", proposal.name)))
        .collect();
    let mut files: Vec<(&str, &str)> = scenes.iter().map(|(name, what)| (*name, what.as_str())).collect();
    files.extend([
        (DESIGNS, "every design that was run"),
        (FRONT, "verified designs"),
        (LAST, "question, proposals, bounds"),
        (output_files::SCENE, "the scene as given"),
        (journal::FILE_NAME, "the designs as they were finished; a restart reads it"),
    ]);
    Page {
        kind: "Improvement",
        title: &record.title,
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &record.answer(),
        interruption: None,
        warnings: &warnings(record),
        main: html! {
            @if !charts.is_empty() { (section("front", "Front", plots.show(&charts))) }
            (section("proposals", "Proposals", proposals(record)))
            @if record.proposals.iter().any(|proposal| !proposal.sensitivity.is_empty()) {
                (section("tolerances", "Tolerances", tolerances(record)))
            }
            (section("bounds", "What no design does", html! { ul { @for bound in &record.bounds { li { (bound) } } } }))
            (fold("verification", "Verified designs", verified(record)))
            (fold("work", "How it was computed", work(record)))
            (fold("sources", "Data and scene", sources_list(&files, "The scene as given", &record.scene_toml)))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", record.program_version, record.scene_hash),
    }
    .html()
}

/// Values on the ends of their ranges, each with the proposals that have it.
fn warnings(record: &ImproveRecord) -> Vec<String> {
    let mut warnings: Vec<(String, Vec<&str>)> = Vec::new();
    for proposal in &record.proposals {
        for edge in proposal.edges() {
            match warnings.iter_mut().find(|(other, _)| *other == edge) {
                Some((_, names)) => names.push(&proposal.name),
                None => warnings.push((edge, vec![&proposal.name])),
            }
        }
    }
    let said = warnings
        .into_iter()
        .map(|(edge, names)| format!("{edge} in “{}”: a wider range may have a better design.", names.join("” and “")));
    said.collect()
}

fn lettered(record: &ImproveRecord) -> Vec<String> {
    let proposals = record.proposals.iter().zip(LETTERS);
    proposals.map(|(proposal, letter)| format!("{letter} {}", proposal.name)).collect()
}

/// Values and figures of the proposals beside the scene as given.
fn proposals(record: &ImproveRecord) -> Markup {
    let head = || {
        let given = ["", "unit", "as given"].map(Cell::from);
        given.into_iter().chain(lettered(record).into_iter().map(Cell::from))
    };
    let Some(first) = record.proposals.first() else { return html! {} };
    let of_keys = record.keys.iter().enumerate().map(|(at, key)| {
        let values = record.proposals.iter().map(|proposal| {
            let value = &proposal.values[at];
            let edge = if value.edge.is_some() { " (end of range)" } else { "" };
            Cell::from(format!("{}{edge}", value.value))
        });
        let unit = gearwear::unit_of(key).unwrap_or_default();
        line([Cell::from(key.as_str()), unit.into(), NONE.into()].into_iter().chain(values))
    });
    let of_figures = first.figures.iter().map(|own| {
        let values = record.proposals.iter().map(|proposal| {
            let same = proposal.figures.iter().find(|figure| figure.figure == own.figure);
            same.map_or_else(|| NONE.into(), changed)
        });
        let heading = if own.is_goal {
            html! { b { (own.heading) } }
        } else {
            html! { (own.heading) }
        };
        line([Cell::from(heading), own.unit.as_str().into(), own.as_given.into()].into_iter().chain(values))
    });
    html! {
        ul {
            @for (proposal, letter) in record.proposals.iter().zip(LETTERS) {
                li { b { (letter) " " (proposal.name) } ". " (gains_and_costs(record, proposal)) }
            }
        }
        (list("Figures against the scene as given", head(), of_figures))
        (list("Free keys", head(), of_keys))
        (note("Bold: goals. ±: error against finite elements. A change in brackets is within the errors of both."))
    }
}

/// Value with its error and its change.
fn changed(figure: &ComparedFigure) -> Cell {
    let error = figure.error.map_or_else(String::new, |error| format!(" ± {}", percent(error)));
    let change = figure.change().map_or_else(String::new, signed);
    let change = if figure.is_changed() { change } else { format!("({change})") };
    Cell::from(html! { (shown(figure.value)) (error) br; span.unit { (change) } })
}

fn gains_and_costs(record: &ImproveRecord, proposal: &Proposal) -> String {
    let said = |figures: Vec<&ComparedFigure>| {
        let changes = figures.into_iter().map(|figure| match figure.change() {
            Some(change) => format!("{} {}", figure.heading, signed(change)),
            None => figure.in_words(),
        });
        changes.collect::<Vec<_>>().join(", ")
    };
    let (gains, costs) = (said(proposal.gains()), said(proposal.costs()));
    let gains = if gains.is_empty() { "Gains nothing".to_owned() } else { format!("Gains: {gains}") };
    let costs = if costs.is_empty() { "Costs: none".to_owned() } else { format!("Costs: {costs}") };
    let tolerance = proposal.tolerance();
    let tolerance = if tolerance.is_empty() { tolerance } else { format!(" {}.", capitalised(&tolerance)) };
    let first = record.proposals.first().filter(|first| first.name != proposal.name);
    let against = first.map_or_else(String::new, |first| format!(" {}.", capitalised(&proposal.against(first))));
    format!("{gains}. {costs}. {}.{tolerance}{against}", proposal.sureness())
}

fn tolerances(record: &ImproveRecord) -> Markup {
    let head = || {
        let fixed = ["proposal", "key", "tolerance ±"].map(Cell::from);
        fixed.into_iter().chain(record.goals.iter().map(|goal| Cell::from(goal.heading.as_str())))
    };
    let change = |change: &Option<f64>| change.map_or_else(|| NONE.to_owned(), signed);
    let rows = record.proposals.iter().zip(lettered(record)).flat_map(|(proposal, name)| {
        let together = [Cell::from(name.clone()), "all together, at worst".into(), NONE.into()];
        let together = together.into_iter().chain(proposal.tolerances_together.iter().map(|of| Cell::from(change(of))));
        let together = line(together);
        let each = proposal.sensitivity.iter().map(move |one| {
            let cells = [Cell::from(name.as_str()), one.key.as_str().into(), one.tolerance.into()];
            line(cells.into_iter().chain(one.changes.iter().map(|of| Cell::from(change(of)))))
        });
        each.chain([together]).collect::<Vec<_>>()
    });
    html! {
        (list("Greatest change of the goals for the worse", head(), rows))
        (note("On the fast model, each tolerance by itself and the others at their values; together: the sum."))
    }
}

/// Verified designs beside what the fast model says of them.
fn verified(record: &ImproveRecord) -> Markup {
    let head = [Cell::from("design")].into_iter();
    let goals = record.goals.iter().flat_map(|goal| [Cell::from(goal.with_unit()), "fast model".into()]);
    let rows = record.in_role(DesignRole::Verify).map(|(place, design)| {
        let proposal = record.proposals.iter().zip(LETTERS).find(|(proposal, _)| proposal.design == design.number);
        let name = match (proposal, &design.values) {
            (Some((proposal, letter)), _) => format!("{letter} {}", proposal.name),
            (None, None) => "as given".to_owned(),
            (None, Some(_)) => design.number.to_string(),
        };
        let fast = record.in_role(DesignRole::Search).find(|(_, other)| other.values == design.values);
        let cells = (0..record.goals.len()).flat_map(|goal| {
            let own = record.goals_of_designs[place].as_ref().map(|goals| goals[goal]);
            let fast = fast.and_then(|(place, _)| record.goals_of_designs[place].as_ref()).map(|goals| goals[goal]);
            [Cell::from(own), Cell::from(fast)]
        });
        line([Cell::from(name)].into_iter().chain(cells))
    });
    let differences = record
        .goals
        .iter()
        .zip(&record.greatest_difference)
        .filter_map(|(goal, difference)| Some(format!("{} {}", goal.heading, percent((*difference)?))));
    let differences: Vec<String> = differences.collect();
    html! {
        (list("Goals of the verified designs", head.chain(goals), rows))
        (note(&format!("Greatest difference of the fast model: {}.", differences.join(", "))))
    }
}

fn work(record: &ImproveRecord) -> Markup {
    let by_default = if record.is_free_by_default { " (chosen from the pair, as the scene names none)" } else { "" };
    html! {
        p {
            "Free keys" (by_default) ": " (record.free.join("; ")) ". "
            @if !record.limits.is_empty() { "Limits: " (record.limits.join("; ")) ". " }
            (count(record.searched as u64)) " designs of at most " (count(record.evaluations as u64))
            " were run on the fast model: " (record.fast_model) ". "
            @if record.failed > 0 { (count(record.failed as u64)) " have no result, the first: " (record.first_failure.as_deref().unwrap_or_default()) ". " }
            @if !record.limits.is_empty() { (count(record.within_limits as u64)) " keep to the limits. " }
            "The search ended as " (record.stopped) ": NSGA-II on radial basis functions (seed " (record.seed) "). "
            (count((record.in_role(DesignRole::Verify).count()) as u64)) " designs were run as verified: " (record.verified_on) ". "
            "All took " (significant(record.wall_s, 3)) " s on "
            (if record.threads == 1 { "one thread".to_owned() } else { format!("{} threads", record.threads) }) "."
        }
    }
}
