//! What every report page is made of: the page itself, its sections, its charts.

use std::cell::Cell;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::number::fixed;
use super::reading::bound;
use super::table::{inner, line, list};
use super::terms::terms;
use crate::report::chart::{Chart, Trace};
use crate::report::control::Control;
use crate::report::figure::in_page::{self, Entry, InPage};
use gearwear_physics::results::run::StageTime;

/// The script of plots.
const SCRIPTS: [&str; 3] = [include_str!("axis.js"), include_str!("surface.js"), include_str!("page.js")];

pub struct Page<'a> {
    /// What kind of report it is, above the title.
    pub kind: &'a str,
    pub title: &'a str,
    /// Who reports, and when; empty where that is not said.
    pub byline: &'a str,
    /// The result in a sentence or two.
    pub answer: &'a str,
    /// Why this is not the whole, where it is not.
    pub interruption: Option<&'a str>,
    /// What the reader should know.
    pub warnings: &'a [String],
    pub main: Markup,
    /// Those that `main` shows.
    pub plots: Plots,
    /// Program and input.
    pub footer: &'a str,
}

impl Page<'_> {
    pub fn html(&self) -> String {
        self.html_with("", "")
    }

    /// The same with rules after those of the common style sheet and a script after the one that draws the charts.
    pub fn html_with(&self, style: &str, script: &str) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    title { (self.title) " – gearwear" }
                    style { (PreEscaped(include_str!("page.css"))) (PreEscaped(style)) }
                }
                body {
                    header {
                        p.kind { (self.kind) }
                        h1 { (self.title) }
                        @if !self.byline.is_empty() { p.kind { (self.byline) } }
                        p.answer { (bound(self.answer)) }
                    }
                    main {
                        @if let Some(text) = self.interruption {
                            p.notice.interrupted role="alert" { strong { "Incomplete run." } " " (text) }
                        }
                        (warnings(self.warnings))
                        (self.main)
                        (terms())
                    }
                    footer { (self.footer) }
                    @if self.plots.shown.get() > 0 {
                        script { @for part in SCRIPTS { (PreEscaped(part)) } }
                    }
                    @if !script.is_empty() { script { (PreEscaped(script)) } }
                }
            }
        };
        page.into_string()
    }
}

/// What the reader should know; nothing where there is nothing.
pub fn warnings(warnings: &[String]) -> Markup {
    html! {
        @if !warnings.is_empty() {
            section.notice aria-labelledby="warnings" {
                h2 #warnings { "Warnings" }
                ul { @for warning in warnings { li { (warning) } } }
            }
        }
    }
}

/// A part of the page behind its heading, which opens it.
pub fn fold(id: &str, heading: &str, content: Markup) -> Markup {
    html! { details.fold id=(id) { summary { h2 { (heading) } } (content) } }
}

pub fn section(id: &str, heading: &str, content: Markup) -> Markup {
    html! { section aria-labelledby=(id) { h2 id=(id) { (heading) } (content) } }
}

/// A remark on what is shown.
pub fn note(text: &str) -> Markup {
    html! { p.legend-note { (text) } }
}

/// Tables beside one another where there is room.
pub fn tables(tables: impl IntoIterator<Item = Markup>) -> Markup {
    html! { div.tables { @for table in tables { (table) } } }
}

/// The plots of a page, shown group by group.
#[derive(Default)]
pub struct Plots {
    shown: Cell<usize>,
}

impl Plots {
    /// The charts, numbered on from those before.
    pub fn show(&self, charts: &[Chart]) -> Markup {
        let first = self.shown.get() + 1;
        self.shown.set(self.shown.get() + charts.len());
        html! {
            @if first == 1 {
                noscript { p.notice { "Without JavaScript plots cannot be enlarged or read point by point; all their numbers are in the data files." } }
            }
            div.plots { @for (number, chart) in (first..).zip(charts) { (plot(number, chart)) } }
        }
    }
}

fn plot(number: usize, chart: &Chart) -> Markup {
    let id = &chart.id;
    let InPage { svg, legend, data } = in_page::of(chart);
    // Nothing in the data may end the element in which they stand.
    let data = data.replace('<', "\\u003c");
    let is_surface = chart.traces.iter().any(Trace::is_surface);
    html! {
        figure class=[chart.is_wide.then_some("wide")] {
            h3 id={ (id) "-title" } { (chart.title) }
            div.plot id=(id) role="img" aria-labelledby={ (id) "-title" } aria-describedby={ (id) "-reading" } {
                @if is_surface { canvas height=(chart.height_px) {} } @else { (PreEscaped(svg)) }
            }
            @if !legend.is_empty() { div.legend { @for entry in &legend { (legend_entry(entry)) } } }
            @if let Some(control) = &chart.control { (slider(control)) }
            figcaption id={ (id) "-reading" } { b { "Figure " (number) "." } " " (bound(&chart.reading)) }
            script type="application/json" id={ (id) "-data" } { (PreEscaped(data)) }
        }
    }
}

/// A trace in the legend, which shows and hides it.
fn legend_entry(entry: &Entry) -> Markup {
    let pressed = if entry.is_shown { "true" } else { "false" };
    html! { button type="button" aria-pressed=(pressed) data-trace=(entry.trace) { (PreEscaped(&entry.sign)) (entry.name) } }
}

/// The slider of a chart, which the page's script fills and moves.
fn slider(control: &Control) -> Markup {
    let name = match control {
        Control::Steps { name, .. } => name,
        Control::Mesh(_) => "contact position, mm",
    };
    html! {
        div.slider hidden {
            button type="button" aria-label="play" { "▶" }
            input type="range" aria-label=(name);
            output {}
        }
    }
}

/// The stages carried out, each with its time.
pub fn stages_table(stages: &[StageTime], wall_s: f64) -> Markup {
    let stage = |name: &str, wall_s: f64| [name.to_owned(), fixed(wall_s, 4)];
    let total = html! { tr.total { (inner(stage("until this report", wall_s))) } };
    let rows = stages.iter().map(|done| line(stage(&done.name, done.wall_s))).chain([total]);
    list("Stages carried out", ["", "time, s"], rows)
}

/// The data files beside the page, each with what it holds.
pub fn files_list(files: &[(&str, &str)]) -> Markup {
    html! { ul.files { @for (name, what) in files { li { a href=(name) { (name) } " " (what) } } } }
}

pub fn sources_list(files: &[(&str, &str)], input_name: &str, input: &str) -> Markup {
    html! { (files_list(files)) details { summary { (input_name) } pre { (input) } } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_text_is_defused() {
        let section = section("id", "<b a='1'>\"&", html! {}).into_string();
        assert!(section.contains("&lt;b a='1'&gt;&quot;&amp;"), "{section}");
    }
}
