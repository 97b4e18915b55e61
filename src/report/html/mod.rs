//! `report.html`: one page that holds everything it needs, and asks the network for nothing.
//!
//! The page is its words and tables in plain HTML, one JSON description per plot, plotly.js, and a short script
//! (`page.js`) that draws the plots in the colours of the style sheet (`page.css`) for light, dark and paper.

mod cycle_plots;
mod drawing_plot;
mod figures_table;
mod flank_plots;
mod history_plot;
mod number;
mod reading;
mod theme;

use plotly::Plot;

use self::theme::Figure;
use crate::simulation::record::{RunRecord, Summary};

/// The data files named in the page, which lie beside it.
const DATA_FILES: [(&str, &str); 7] = [
    ("summary.json", "the main figures"),
    ("pinion.csv", "the pinion’s flank, point by point"),
    ("wheel.csv", "the wheel’s flank, point by point"),
    ("history.csv", "the snapshots"),
    ("profiles.csv", "both flanks at every snapshot"),
    ("mesh_cycle.csv", "the working cycle"),
    ("scene.toml", "the resolved scene"),
];

/// The whole page.
pub fn page(record: &RunRecord) -> String {
    let s = &record.summary;
    let title = escape(&s.title);
    let mut figures = vec![drawing_plot::pair(record)];
    figures.extend(flank_plots::wear(record));
    figures.extend(flank_plots::pressure(record));
    figures.extend(cycle_plots::all(record));
    figures.push(history_plot::wear_against_time(record));
    figures.extend(flank_plots::modifications(record));
    let shown: String = figures.iter().enumerate().map(|(i, figure)| figure_html(i + 1, figure)).collect();
    [
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n",
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
        "<meta name=\"color-scheme\" content=\"light dark\">\n",
        &format!("<title>{title} – gearwear</title>\n<style>\n{}</style>\n</head>\n<body>\n", include_str!("page.css")),
        &format!("<header>\n<p class=\"kind\">Wear of a gear pair</p>\n<h1>{title}</h1>\n"),
        &format!("<p class=\"answer\">{}</p>\n</header>\n<main>\n", escape(&reading::bound(&reading::answer(record)))),
        &notices(s),
        "<section aria-labelledby=\"figures\">\n<h2 id=\"figures\">Main figures</h2>\n<div class=\"tables\">\n",
        &figures_table::tables(record),
        "</div>\n",
        &figures_table::errors(&s.error),
        "</section>\n<section aria-labelledby=\"plots\">\n<h2 id=\"plots\">Plots</h2>\n",
        "<p class=\"legend-note\">A to E are the points of the path of contact: contact begins at A and ends at E, a \
         tooth pair carries the load alone between B and D where no more than two pairs share it, and C is the pitch \
         point. The contact position is the radius of curvature of the pinion’s flank at the theoretical contact \
         point.</p>\n",
        "<noscript><p class=\"notice\">The plots need JavaScript; all their numbers are in the data files.</p></noscript>\n",
        &format!("<div class=\"plots\">\n{shown}</div>\n</section>\n"),
        &work(s),
        &sources(record),
        "</main>\n",
        &format!(
            "<footer>gearwear {} · scene {}</footer>\n",
            escape(&s.program_version),
            escape(&s.scene_hash)
        ),
        &format!("<script>{}</script>\n<script>\n{}</script>\n", plotly_js(), include_str!("page.js")),
        "</body>\n</html>\n",
    ]
    .concat()
}

/// What the reader must know first: an interruption, then the warnings.
fn notices(s: &Summary) -> String {
    let mut html = String::new();
    if let Some(text) = reading::interruption(s) {
        html.push_str(&format!(
            "<p class=\"notice interrupted\" role=\"alert\"><strong>Not the whole run.</strong> {}</p>\n",
            escape(&text)
        ));
    }
    if !s.warnings.is_empty() {
        let items: String = s.warnings.iter().map(|w| format!("<li>{}</li>\n", escape(w))).collect();
        html.push_str(&format!(
            "<section class=\"notice\" aria-labelledby=\"warnings\">\n<h2 id=\"warnings\">Warnings</h2>\n<ul>\n{items}</ul>\n</section>\n"
        ));
    }
    html
}

fn figure_html(number: usize, figure: &Figure) -> String {
    let Figure { id, title, reading, plot, wide } = figure;
    let class = if *wide { " class=\"wide\"" } else { "" };
    let (title, reading) = (escape(title), escape(&reading::bound(reading)));
    format!(
        "<figure{class}>\n<h3 id=\"{id}-title\">{title}</h3>\n\
         <div class=\"plot\" id=\"{id}\" role=\"img\" aria-labelledby=\"{id}-title\" aria-describedby=\"{id}-reading\"></div>\n\
         <figcaption id=\"{id}-reading\"><b>Figure {number}.</b> {reading}</figcaption>\n\
         <script type=\"application/json\" id=\"{id}-data\">{}</script>\n</figure>\n",
        plot_json(plot)
    )
}

/// The plot as JSON that may stand inside a script element: nothing in it can end that element.
fn plot_json(plot: &Plot) -> String {
    let mut plot = plot.clone();
    plot.set_configuration(theme::configuration());
    plot.to_json().replace('<', "\\u003c")
}

/// How the run came about: stages with their times, stages left out, work done.
fn work(s: &Summary) -> String {
    let seconds = |wall_s: f64| number::fixed(wall_s, 4);
    let stages: String = s
        .stages
        .iter()
        .map(|stage| {
            format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(&stage.name), seconds(stage.wall_s))
        })
        .collect();
    let left_out: String = s
        .left_out
        .iter()
        .map(|stage| format!("<dt>{}</dt><dd>{}</dd>\n", escape(&stage.name), escape(&stage.reason)))
        .collect();
    let left_out = if left_out.is_empty() {
        String::new()
    } else {
        format!("<div><h3>Stages left out</h3>\n<dl>\n{left_out}</dl></div>\n")
    };
    let w = &s.work;
    let counts: String = [
        ("Wear steps", w.wear_steps),
        ("Working cycles", w.mesh_cycles),
        ("Equilibria", w.equilibria),
        ("Newton iterations", w.newton_iterations),
        ("Contact evaluations", w.pair_evaluations),
    ]
    .map(|(name, count)| format!("<tr><th scope=\"row\">{name}</th><td>{}</td></tr>\n", number::count(count)))
    .concat();
    format!(
        "<section aria-labelledby=\"work\">\n<h2 id=\"work\">How it was computed</h2>\n<div class=\"tables\">\n\
         <table>\n<caption>Stages carried out</caption>\n<thead><tr><td></td><th scope=\"col\">time, s</th></tr></thead>\n\
         <tbody>\n{stages}<tr class=\"total\"><th scope=\"row\">until this report</th><td>{}</td></tr>\n</tbody>\n</table>\n\
         <table>\n<caption>Work of the simulation</caption>\n<thead><tr><td></td><th scope=\"col\">count</th></tr></thead>\n\
         <tbody>\n{counts}</tbody>\n</table>\n{left_out}</div>\n</section>\n",
        seconds(s.wall_s)
    )
}

/// The data files and the scene.
fn sources(record: &RunRecord) -> String {
    let files: String =
        DATA_FILES.map(|(name, what)| format!("<li><a href=\"{name}\">{name}</a> {what}</li>\n")).concat();
    format!(
        "<section aria-labelledby=\"sources\">\n<h2 id=\"sources\">Data and scene</h2>\n<ul class=\"files\">\n{files}</ul>\n\
         <details>\n<summary>The resolved scene, every default filled in</summary>\n<pre>{}</pre>\n</details>\n</section>\n",
        escape(&record.scene_toml)
    )
}

/// Text as HTML text or attribute value.
fn escape(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => html.push_str("&amp;"),
            '<' => html.push_str("&lt;"),
            '>' => html.push_str("&gt;"),
            '"' => html.push_str("&quot;"),
            '\'' => html.push_str("&#39;"),
            _ => html.push(c),
        }
    }
    html
}

/// plotly.js alone. The `plotly` crate hands out its scripts as elements one after another, MathJax among them, which
/// this page does not need.
fn plotly_js() -> String {
    Plot::offline_js_sources()
        .split("</script>")
        .filter_map(|element| element.split_once('>'))
        .map(|(_, script)| script)
        .find(|script| is_plotly(script))
        .unwrap_or_default()
        .to_owned()
}

/// Whether a script is plotly.js: it says so in the comment at its head.
fn is_plotly(script: &str) -> bool {
    script.lines().take(5).any(|line| line.contains("plotly.js v"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plotly_is_found_whole_and_without_mathjax() {
        let script = plotly_js();
        assert!(script.len() > 3_000_000, "{} bytes", script.len());
        assert!(script.trim_end().ends_with(';') || script.trim_end().ends_with('}'), "cut short");
        assert!(!script.contains("<script"));
    }

    #[test]
    fn markup_in_text_is_defused() {
        assert_eq!(escape("<b a='1'>\"&"), "&lt;b a=&#39;1&#39;&gt;&quot;&amp;");
    }
}
