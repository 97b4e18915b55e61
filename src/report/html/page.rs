//! What every report page is made of: the page itself, its sections, its figures.

use crate::report::chart::{self, Plot};

use super::number;
use super::reading;
use super::theme::Figure;
use crate::results::run::StageTime;

/// A page.
pub struct Page<'a> {
    /// What kind of report it is, above the title.
    pub kind: &'a str,
    /// The title.
    pub title: &'a str,
    /// The result in a sentence or two.
    pub answer: &'a str,
    /// Why this is not the whole, where it is not.
    pub interruption: Option<&'a str>,
    /// What the reader should know.
    pub warnings: &'a [String],
    /// The sections, as HTML.
    pub main: &'a str,
    /// Program and input.
    pub footer: &'a str,
}

impl Page<'_> {
    /// The whole page, which holds everything it needs.
    pub fn html(&self) -> String {
        self.html_with("", "")
    }

    /// The same with rules after those of the common style sheet and a script after the one that draws the plots.
    pub fn html_with(&self, style: &str, script: &str) -> String {
        let title = escape(self.title);
        [
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n",
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
            "<meta name=\"color-scheme\" content=\"light dark\">\n",
            &format!(
                "<title>{title} – gearwear</title>\n<style>\n{}{style}</style>\n</head>\n<body>\n",
                include_str!("page.css")
            ),
            &format!("<header>\n<p class=\"kind\">{}</p>\n<h1>{title}</h1>\n", escape(self.kind)),
            &format!("<p class=\"answer\">{}</p>\n</header>\n<main>\n", escape(&reading::bound(self.answer))),
            &self.notices(),
            self.main,
            "</main>\n",
            &format!("<footer>{}</footer>\n", escape(self.footer)),
            &format!("<script>{}</script>\n<script>\n{}{script}</script>\n", chart::script(), include_str!("page.js")),
            "</body>\n</html>\n",
        ]
        .concat()
    }

    /// What the reader must know first: an interruption, then the warnings.
    fn notices(&self) -> String {
        let mut html = String::new();
        if let Some(text) = self.interruption {
            html.push_str(&format!(
                "<p class=\"notice interrupted\" role=\"alert\"><strong>Not the whole run.</strong> {}</p>\n",
                escape(text)
            ));
        }
        if !self.warnings.is_empty() {
            let items: String = self.warnings.iter().map(|w| format!("<li>{}</li>\n", escape(w))).collect();
            html.push_str(&format!(
                "<section class=\"notice\" aria-labelledby=\"warnings\">\n<h2 id=\"warnings\">Warnings</h2>\n<ul>\n{items}</ul>\n</section>\n"
            ));
        }
        html
    }
}

/// A section under a heading.
pub fn section(id: &str, heading: &str, html: &str) -> String {
    format!("<section aria-labelledby=\"{id}\">\n<h2 id=\"{id}\">{heading}</h2>\n{html}</section>\n")
}

/// The figures, numbered from 1.
pub fn plots(figures: &[Figure]) -> String {
    let shown: String = figures.iter().enumerate().map(|(i, figure)| figure_html(i + 1, figure)).collect();
    format!(
        "<noscript><p class=\"notice\">The plots need JavaScript; all their numbers are in the data files.</p></noscript>\n\
         <div class=\"plots\">\n{shown}</div>\n"
    )
}

/// The stages carried out, each with its time.
pub fn stages_table(stages: &[StageTime], wall_s: f64) -> String {
    let seconds = |wall_s: f64| number::fixed(wall_s, 4);
    let rows: String = stages
        .iter()
        .map(|stage| {
            format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(&stage.name), seconds(stage.wall_s))
        })
        .collect();
    format!(
        "<table>\n<caption>Stages carried out</caption>\n<thead><tr><td></td><th scope=\"col\">time, s</th></tr></thead>\n\
         <tbody>\n{rows}<tr class=\"total\"><th scope=\"row\">until this report</th><td>{}</td></tr>\n</tbody>\n</table>\n",
        seconds(wall_s)
    )
}

/// The data files beside the page, each with what it holds, and the resolved input.
pub fn sources_list(files: &[(&str, &str)], input_name: &str, input: &str) -> String {
    let files: String =
        files.iter().map(|(name, what)| format!("<li><a href=\"{name}\">{name}</a> {what}</li>\n")).collect();
    format!(
        "<ul class=\"files\">\n{files}</ul>\n<details>\n<summary>{input_name}</summary>\n<pre>{}</pre>\n</details>\n",
        escape(input)
    )
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
    plot.to_json().replace('<', "\\u003c")
}

/// Text as HTML text or attribute value.
pub fn escape(text: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_text_is_defused() {
        assert_eq!(escape("<b a='1'>\"&"), "&lt;b a=&#39;1&#39;&gt;&quot;&amp;");
    }
}
