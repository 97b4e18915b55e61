//! The pieces of HTML that the parts of the page share: tables that scroll by themselves, verdicts, margin bars, links.

use super::verdict::Verdict;
use super::words;
use crate::report::html::page::escape;
use crate::studies::validation::record::CaseRecord;

/// A table whose cells are HTML already; the first cell of each row names it. It scrolls in a box of its own.
pub(super) fn table(class: &str, columns: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let body: String = rows.into_iter().map(|cells| row("", &cells)).collect();
    scrolling(class, columns, &body)
}

/// A table in its box, of rows that are HTML already.
pub(super) fn scrolling(class: &str, columns: &[&str], body: &str) -> String {
    let head: String = columns.iter().map(|name| format!("<th scope=\"col\">{}</th>", escape(name))).collect();
    format!(
        "<div class=\"scrolls\" tabindex=\"0\" role=\"region\" aria-label=\"table, scrolls\"><table class=\"{class}\">\n<thead><tr>{head}</tr></thead>\n\
         <tbody>\n{body}</tbody>\n</table></div>\n"
    )
}

/// A row of cells that are HTML already; `attributes` begin with a space, or are empty.
pub(super) fn row(attributes: &str, cells: &[String]) -> String {
    let mut cells = cells.iter();
    let name = cells.next().map_or("", String::as_str);
    let rest: String = cells.map(|cell| format!("<td>{cell}</td>")).collect();
    format!("<tr{attributes}><th scope=\"row\">{name}</th>{rest}</tr>\n")
}

/// A verdict as sign and word, in its colour.
pub(super) fn badge(verdict: Verdict) -> String {
    format!(
        "<span class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> {}</span>",
        verdict.class(),
        verdict.sign(),
        verdict.word()
    )
}

/// The share of a tolerance as a bar with its number; nothing drawn where there is none.
pub(super) fn margin_bar(share: Option<f64>) -> String {
    let Some(used) = share.filter(|share| share.is_finite()) else { return words::NONE.to_owned() };
    let over = if used > 1.0 { " over" } else { "" };
    format!(
        "<span class=\"bar{over}\" aria-hidden=\"true\"><i style=\"width:{:.1}%\"></i></span> {}",
        100.0 * used.clamp(0.0, 1.0),
        words::share(share)
    )
}

/// The identifier of a case's section.
pub(super) fn anchor(case: &CaseRecord) -> String {
    format!("case-{}", identifier(&case.name))
}

/// A link to a case's section.
pub(super) fn link(case: &CaseRecord, text: &str) -> String {
    format!("<a href=\"#{}\">{}</a>", anchor(case), escape(text))
}

/// Letters, digits and hyphens of a name.
pub(super) fn identifier(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect()
}
