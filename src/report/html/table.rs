//! Tables of figures: a name, a number for each column, a unit.

/// A row: what it is, its unit, and one figure per column.
pub struct Row {
    label: String,
    unit: &'static str,
    cells: Vec<String>,
}

/// A row of `N` figures.
pub fn row<const N: usize>(label: impl Into<String>, unit: &'static str, cells: [String; N]) -> Row {
    Row { label: label.into(), unit, cells: cells.into() }
}

/// A table with its caption and the heads of its columns of figures.
pub fn table(caption: &str, columns: &[&str], rows: &[Row]) -> String {
    let head: String = columns.iter().map(|name| format!("<th scope=\"col\">{name}</th>")).collect();
    let body: String = rows
        .iter()
        .map(|Row { label, unit, cells }| {
            let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
            format!("<tr><th scope=\"row\">{label}</th>{cells}<td class=\"unit\">{unit}</td></tr>\n")
        })
        .collect();
    format!(
        "<table>\n<caption>{caption}</caption>\n<thead><tr><td></td>{head}<td></td></tr></thead>\n\
         <tbody>\n{body}</tbody>\n</table>\n"
    )
}
