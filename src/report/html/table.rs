//! Tables of a page: each row begins with its name.

use maud::{Markup, Render, html};

use super::number::{count, figure};

/// What stands where there is no number.
pub const NONE: &str = "–";

/// What stands in a cell: a result as a number with its digits, a count, a text, or markup.
pub struct Cell {
    content: Markup,
    /// A sentence, in a column of its own kind.
    is_sentence: bool,
}

impl Cell {
    /// A text that may take several lines.
    pub fn sentence(text: impl Render) -> Self {
        Self { is_sentence: true, ..html! { (text) }.into() }
    }
}

impl From<Markup> for Cell {
    fn from(content: Markup) -> Self {
        Self { content, is_sentence: false }
    }
}

macro_rules! cell_from {
    ($($kind:ty: $value:ident => $text:expr),* $(,)?) => { $(
        impl From<$kind> for Cell {
            fn from($value: $kind) -> Self {
                html! { ($text) }.into()
            }
        }
    )* };
}

cell_from! {
    &str: text => text,
    String: text => text,
    f64: value => figure(value),
    Option<f64>: value => value.map_or_else(|| NONE.to_owned(), figure),
    Option<String>: text => text.as_deref().unwrap_or(NONE),
    u32: number => count(u64::from(number)),
    u64: number => count(number),
    usize: number => count(number as u64),
    bool: is_so => if is_so { "yes" } else { "no" },
}

#[doc(hidden)]
#[macro_export]
macro_rules! cells {
    ($($value:expr),* $(,)?) => { [$($crate::report::html::table::Cell::from($value)),*] };
}
pub use crate::cells;

fn data(cell: impl Into<Cell>) -> Markup {
    let Cell { content, is_sentence } = cell.into();
    html! { td class=[is_sentence.then_some("how")] { (content) } }
}

/// A row of figures: what it is, its unit, and one figure for each column.
pub fn row(label: impl Into<Cell>, unit: &str, cells: impl IntoIterator<Item = impl Into<Cell>>) -> Markup {
    html! {
        tr { th scope="row" { (label.into().content) } @for cell in cells { (data(cell)) } td.unit { (unit) } }
    }
}

/// A row of cells, the first of which names it.
pub fn line(cells: impl IntoIterator<Item = impl Into<Cell>>) -> Markup {
    html! { tr { (inner(cells)) } }
}

pub fn inner(cells: impl IntoIterator<Item = impl Into<Cell>>) -> Markup {
    let mut cells = cells.into_iter();
    let name = cells.next().map(|cell| cell.into().content);
    html! { th scope="row" { @if let Some(name) = name { (name) } } @for cell in cells { (data(cell)) } }
}

/// A table of [`row`]s, with the names of its columns of figures.
pub fn table(caption: impl Render, columns: &[&str], rows: impl IntoIterator<Item = Markup>) -> Markup {
    let columns = [""].into_iter().chain(columns.iter().copied()).chain([""]);
    whole(None, Some(html! { (caption) }), columns, rows)
}

/// A table of [`line()`]s, with the names of all its columns.
pub fn list(
    caption: impl Render,
    columns: impl IntoIterator<Item = impl Into<Cell>>,
    rows: impl IntoIterator<Item = Markup>,
) -> Markup {
    whole(None, Some(html! { (caption) }), columns, rows)
}

/// A table with its class and caption, where it has them; a column without a name has no head. Where it is wider than its room it scrolls.
pub fn whole(
    class: Option<&str>,
    caption: Option<Markup>,
    columns: impl IntoIterator<Item = impl Into<Cell>>,
    rows: impl IntoIterator<Item = Markup>,
) -> Markup {
    html! {
        div.scroll {
            table class=[class] {
                @if let Some(caption) = caption { caption { span { (caption) } } }
                thead { tr { @for column in columns { (head(column.into())) } } }
                tbody { @for row in rows { (row) } }
            }
        }
    }
}

fn head(Cell { content, is_sentence }: Cell) -> Markup {
    html! {
        @if content.0.is_empty() { td {} } @else { th scope="col" class=[is_sentence.then_some("how")] { (content) } }
    }
}
