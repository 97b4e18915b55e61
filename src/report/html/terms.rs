//! Symbols and terms at the foot of every page: those of the glossary in `docs`.

use maud::{Markup, html};

const GLOSSARY: &str = include_str!("../../../docs/glossary.md");

/// What stands in the first two columns of the glossary's tables: symbol, "–" where there is none, and term.
fn rows() -> impl Iterator<Item = (&'static str, String)> {
    GLOSSARY.lines().filter_map(|line| {
        let mut cells = line.strip_prefix("| ")?.split(" | ");
        let (symbol, term) = (cells.next()?, cells.next()?);
        (symbol != "symbol").then(|| (symbol, term.replace(['*', '`'], "")))
    })
}

pub(super) fn terms() -> Markup {
    html! {
        details.terms {
            summary { "Symbols and terms" }
            dl {
                @for (symbol, term) in rows() {
                    div { dt { @if symbol != "–" { (symbol) } } dd { (term) } }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_of_the_glossary_are_read() {
        let rows: Vec<_> = rows().collect();
        assert!(rows.len() > 45, "{}", rows.len());
        assert!(
            rows.iter()
                .any(|(symbol, term)| *symbol == "K_Hβ" && term.starts_with("face load factor: maximum over mean"))
        );
        assert!(
            rows.iter().all(|(symbol, term)| !symbol.contains('`') && !term.contains(['*', '`', '|', ']'])),
            "{rows:?}"
        );
    }
}
